//! The distribution of a picture's panes among this worker and its mates.

use core::sync::atomic::{AtomicU32, Ordering};
use lsystem::render::{Pane, Spent};

/// The number of the newest round of panes.
static ROUNDS: AtomicU32 = AtomicU32::new(0);

/// The milliseconds to wait for an answer from mates when there is nothing else to do. A mate that works makes a pane in a
/// few steps; one that must first build the drawing is still faster than this worker alone. A wait of more than nine
/// frames would be seen where a mate was lost.
const PATIENCE: f64 = 150.0;

/// The panes of one round. Each is made by this worker or by a mate.
#[derive(Default)]
pub(crate) struct Sharing {
    /// The number of the round. Panes of other rounds are useless.
    pub(crate) round: u32,
    panes: Vec<Pane>,
    /// By pane: the units of work in the previous round.
    work: Vec<f64>,
    /// The panes that nobody has begun, the next one last.
    open: Vec<usize>,
    /// The panes in the making, here or at mates, in the order in which they were handed out.
    out: Vec<usize>,
    /// The pane in the making here.
    own: Option<usize>,
    /// The time, in milliseconds, at which waiting began.
    waiting: Option<f64>,
    /// Whether mates have taken too long and are no longer waited for.
    mates_are_late: bool,
    spent: Spent,
}

/// The next action of this worker.
#[derive(Debug, PartialEq)]
pub(crate) enum NextAction {
    /// Begin this pane.
    Begin(Pane),
    /// Continue the pane that was begun.
    Continue,
    /// Wait for mates.
    Wait,
    /// Nothing: all panes are complete.
    Done,
}

impl Sharing {
    /// Starts a round. The panes with the most work in the previous round come first; without a previous round, those
    /// in the middle of the picture.
    pub(crate) fn start(&mut self, panes: Vec<Pane>) {
        let count = panes.len();
        // For five panes: 0, 4, 1, 3, 2.
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

    /// Starts another round with the same panes.
    pub(crate) fn start_again(&mut self) {
        self.start(self.panes.clone());
    }

    /// The next pane for a mate, with its number, if more than `kept` panes are open. A pane that a busy mate would
    /// queue is better kept for the first free worker.
    pub(crate) fn hand_out(&mut self, kept: usize) -> Option<(usize, Pane)> {
        if self.open.len() <= kept {
            return None;
        }
        let number = self.open.pop()?;
        self.out.push(number);
        Some((number, self.panes[number]))
    }

    /// Records a finished pane. Returns whether the pane was still in the making.
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

    /// The next action here, at a time in milliseconds. If mates do not answer in time, their panes are made here, the
    /// last handed out first.
    pub(crate) fn next_action(&mut self, now: f64) -> NextAction {
        if self.own.is_some() {
            return NextAction::Continue;
        }
        let next = self.open.pop();
        if let Some(number) = next {
            self.out.push(number);
        }
        let Some(&last) = self.out.last() else { return NextAction::Done };
        if next.is_none() {
            self.mates_are_late |= now - *self.waiting.get_or_insert(now) > PATIENCE;
            if !self.mates_are_late {
                return NextAction::Wait;
            }
        }
        self.own = Some(last);
        NextAction::Begin(self.panes[last])
    }

    /// Whether there is nothing to do but wait for mates.
    pub(crate) fn is_waiting(&self) -> bool {
        self.waiting.is_some() && self.own.is_none()
    }

    /// Records that the pane in the making here is finished, and returns the pane.
    pub(crate) fn finish(&mut self, spent: Spent) -> Option<Pane> {
        let number = self.own?;
        self.take_in(number, spent);
        Some(self.panes[number])
    }

    /// The work of all finished panes.
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

    fn number(action: &NextAction) -> u32 {
        match action {
            NextAction::Begin(pane) => pane.y / 32,
            other => panic!("{other:?}"),
        }
    }

    /// Makes all panes here, with this work for each pane. Returns the order.
    fn make(sharing: &mut Sharing, work: [f64; 5]) -> Vec<u32> {
        let mut made = vec![];
        while let action @ NextAction::Begin(_) = sharing.next_action(0.0) {
            made.push(number(&action));
            assert_eq!(sharing.next_action(0.0), NextAction::Continue);
            let spent = Spent { work: work[number(&action) as usize], poor: made.len() == 3 };
            sharing.finish(spent);
        }
        assert_eq!(sharing.next_action(0.0), NextAction::Done);
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
        assert_eq!(handed, [2, 3, 1], "two panes are kept");
        let rest: Vec<usize> = core::iter::from_fn(|| Some(sharing.hand_out(0)?.0)).collect();
        for number in handed.into_iter().chain(rest) {
            assert!(sharing.take_in(number, Spent::default()));
            assert!(!sharing.take_in(number, Spent::default()), "twice");
        }
        assert_eq!(sharing.next_action(0.0), NextAction::Done);
        assert!(!sharing.take_in(77, Spent::default()));
    }

    #[test]
    fn what_mates_do_not_answer_is_made_here() {
        let mut sharing = sharing();
        let [lost, slow, late] = [0; 3].map(|_| sharing.hand_out(0).unwrap().0);
        for _ in 0..2 {
            assert!(matches!(sharing.next_action(0.0), NextAction::Begin(_)));
            sharing.finish(Spent::default());
        }
        assert_eq!(sharing.next_action(10.0), NextAction::Wait);
        assert!(sharing.is_waiting());
        assert!(sharing.take_in(late, Spent::default()));
        assert!(!sharing.is_waiting());
        assert_eq!(sharing.next_action(100.0), NextAction::Wait);
        assert_eq!(sharing.next_action(240.0), NextAction::Wait, "an answer restarts the waiting time");
        assert_eq!(number(&sharing.next_action(260.0)) as usize, slow);
        assert!(!sharing.is_waiting());
        // The slow mate answers while the pane is made here.
        assert!(sharing.take_in(slow, Spent::default()));
        assert_eq!(number(&sharing.next_action(270.0)) as usize, lost, "late mates are not waited for again");
        assert_eq!(sharing.finish(Spent::default()).map(|pane| pane.y as usize / 32), Some(lost));
        assert!(!sharing.take_in(lost, Spent::default()), "too late");
        assert_eq!(sharing.next_action(280.0), NextAction::Done);
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
        assert_eq!(sharing.next_action(0.0), NextAction::Done);
        assert_eq!(sharing.hand_out(0), None);
    }
}
