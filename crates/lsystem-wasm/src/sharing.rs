//! A picture in space that several workers make together: who makes which pane of it, here and at the mates.

use core::sync::atomic::{AtomicU32, Ordering};
use lsystem::render::{Pane, Spent};

/// The number of the newest round of panes.
static ROUNDS: AtomicU32 = AtomicU32::new(0);

/// When there is nothing else to do, mates are waited for so long without any news, in milliseconds.
const PATIENCE: f64 = 150.0;

/// Panes that are to be made in one round, each by whoever is free.
#[derive(Default)]
pub(crate) struct Sharing {
    /// Which round: what is made in another is of no use any more.
    pub(crate) round: u32,
    panes: Vec<Pane>,
    /// By pane: the work that it took the last time.
    work: Vec<f64>,
    /// Those that nobody makes yet, the next one last.
    open: Vec<usize>,
    /// Those that mates make, in the order in which they were handed out.
    out: Vec<usize>,
    /// The one that is made here.
    own: Option<usize>,
    /// Since when there is nothing to do but to wait.
    waiting: Option<f64>,
    /// Whether mates are not waited for any more.
    alone: bool,
    spent: Spent,
}

/// What is to be done here.
#[derive(Debug, PartialEq)]
pub(crate) enum Turn {
    /// Begin this pane.
    Begin(Pane),
    /// Go on with the one that was begun.
    GoOn,
    /// Wait for mates.
    Wait,
    /// Nothing: all panes are there.
    Done,
}

impl Sharing {
    /// Starts a round: what took most the last time is made first, and what is in the middle where nothing is known.
    pub(crate) fn start(&mut self, panes: Vec<Pane>) {
        let count = panes.len();
        // 0, 4, 1, 3, 2 for five.
        let mut open: Vec<usize> = (0..count).map(|at| if at % 2 == 0 { at / 2 } else { count - 1 - at / 2 }).collect();
        let mut work = core::mem::take(&mut self.work);
        if panes != self.panes {
            work.clear();
            work.resize(count, 0.0);
        }
        for i in 1..count {
            let mut j = i;
            while j > 0 && work[open[j - 1]] > work[open[j]] {
                open.swap(j - 1, j);
                j -= 1;
            }
        }
        let round = ROUNDS.fetch_add(1, Ordering::Relaxed) + 1;
        *self = Self { round, panes, work, open, ..Self::default() };
    }

    /// The same panes once more.
    pub(crate) fn start_again(&mut self) {
        self.start(self.panes.clone());
    }

    /// The next pane for a mate, if nobody makes it yet. One that is not begun at once is only handed out while there
    /// are more than `kept`.
    pub(crate) fn hand_out(&mut self, kept: usize) -> Option<(usize, Pane)> {
        if self.open.len() <= kept {
            return None;
        }
        let number = self.open.pop()?;
        self.out.push(number);
        Some((number, self.panes[number]))
    }

    /// A mate has made a pane. Whether it was wanted.
    pub(crate) fn take_in(&mut self, number: usize, spent: Spent) -> bool {
        let Some(at) = self.out.iter().position(|&out| out == number) else { return false };
        self.out.remove(at);
        if self.own == Some(number) {
            self.own = None;
        }
        self.waiting = None;
        self.work[number] = spent.work;
        self.spent.add(spent);
        true
    }

    /// What to do here, at a time in milliseconds. What mates do not answer is made here as well when they have been
    /// waited for, what they were handed last first.
    pub(crate) fn turn(&mut self, now: f64) -> Turn {
        if self.own.is_some() {
            return Turn::GoOn;
        }
        let next = self.open.pop();
        if let Some(number) = next {
            self.out.push(number);
        }
        let Some(&last) = self.out.last() else { return Turn::Done };
        if next.is_none() {
            self.alone |= now - *self.waiting.get_or_insert(now) > PATIENCE;
            if !self.alone {
                return Turn::Wait;
            }
        }
        self.own = Some(last);
        Turn::Begin(self.panes[last])
    }

    /// Whether there is nothing to do but to wait.
    pub(crate) fn is_waiting(&self) -> bool {
        self.waiting.is_some() && self.own.is_none()
    }

    /// The pane that is made here is there; which one that is.
    pub(crate) fn finish(&mut self, spent: Spent) -> Option<Pane> {
        let number = self.own?;
        self.take_in(number, spent);
        Some(self.panes[number])
    }

    /// What all panes have taken that are there.
    pub(crate) fn spent(&self) -> Spent {
        self.spent
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lsystem::Viewport;

    const VIEWPORT: Viewport = Viewport { width: 64, height: 160, ratio: 1.0 };

    fn sharing() -> Sharing {
        let mut sharing = Sharing::default();
        sharing.start(Pane::all(VIEWPORT, [64, 32]));
        sharing
    }

    fn number(turn: &Turn) -> u32 {
        match turn {
            Turn::Begin(pane) => pane.y / 32,
            other => panic!("{other:?}"),
        }
    }

    /// Makes all panes here, with so much work each; in which order.
    fn make(sharing: &mut Sharing, work: [f64; 5]) -> Vec<u32> {
        let mut made = vec![];
        while let turn @ Turn::Begin(_) = sharing.turn(0.0) {
            made.push(number(&turn));
            assert_eq!(sharing.turn(0.0), Turn::GoOn);
            let spent = Spent { work: work[number(&turn) as usize], poor: made.len() == 3 };
            sharing.finish(spent);
        }
        assert_eq!(sharing.turn(0.0), Turn::Done);
        made
    }

    #[test]
    fn alone_all_panes_are_made_here_in_a_good_order() {
        let mut sharing = sharing();
        assert_eq!(make(&mut sharing, [5.0, 1.0, 2.0, 3.0, 4.0]), [2, 3, 1, 4, 0]);
        assert_eq!(sharing.spent(), Spent { work: 15.0, poor: true });
        sharing.start_again();
        assert_eq!(make(&mut sharing, [1.0; 5]), [0, 4, 3, 2, 1]);
        sharing.start(Pane::all(VIEWPORT, [32, 80]));
        assert_eq!(sharing.hand_out(0).unwrap().0, 2);
    }

    #[test]
    fn mates_make_what_they_are_handed() {
        let mut sharing = sharing();
        let handed: Vec<usize> = core::iter::from_fn(|| Some(sharing.hand_out(2)?.0)).collect();
        assert_eq!(handed, [2, 3, 1], "some are kept for who is free first");
        let rest: Vec<usize> = core::iter::from_fn(|| Some(sharing.hand_out(0)?.0)).collect();
        for number in handed.into_iter().chain(rest) {
            assert!(sharing.take_in(number, Spent::default()));
            assert!(!sharing.take_in(number, Spent::default()), "twice");
        }
        assert_eq!(sharing.turn(0.0), Turn::Done);
        assert!(!sharing.take_in(77, Spent::default()));
    }

    #[test]
    fn what_mates_do_not_answer_is_made_here() {
        let mut sharing = sharing();
        let [lost, slow, late] = [0; 3].map(|_| sharing.hand_out(0).unwrap().0);
        for _ in 0..2 {
            assert!(matches!(sharing.turn(0.0), Turn::Begin(_)));
            sharing.finish(Spent::default());
        }
        assert_eq!(sharing.turn(10.0), Turn::Wait);
        assert!(sharing.is_waiting());
        assert!(sharing.take_in(late, Spent::default()));
        assert!(!sharing.is_waiting());
        assert_eq!(sharing.turn(100.0), Turn::Wait);
        assert_eq!(sharing.turn(240.0), Turn::Wait, "there were news");
        assert_eq!(number(&sharing.turn(260.0)) as usize, slow);
        assert!(!sharing.is_waiting());
        // It answers after all, while the pane is made here.
        assert!(sharing.take_in(slow, Spent::default()));
        assert_eq!(number(&sharing.turn(270.0)) as usize, lost, "nobody waits twice");
        assert_eq!(sharing.finish(Spent::default()).map(|pane| pane.y as usize / 32), Some(lost));
        assert!(!sharing.take_in(lost, Spent::default()), "too late");
        assert_eq!(sharing.turn(280.0), Turn::Done);
    }

    #[test]
    fn rounds_are_told_apart() {
        let (mut sharing, other) = (sharing(), sharing());
        let before = sharing.round;
        sharing.hand_out(0);
        sharing.start_again();
        assert!(before < other.round && other.round < sharing.round);
        assert_eq!(sharing.open.len(), 5);
        sharing.start(vec![]);
        assert_eq!(sharing.turn(0.0), Turn::Done);
        assert_eq!(sharing.hand_out(0), None);
    }
}
