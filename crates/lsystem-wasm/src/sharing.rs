//! A picture that several workers make together: who makes which pane of it, here and at the mates.

use core::sync::atomic::{AtomicU32, Ordering};
use lsystem::{Pane, Spent, Viewport};

/// The number of the newest round of panes.
static ROUNDS: AtomicU32 = AtomicU32::new(0);

/// Panes that are to be made in one round, each by whoever is free.
#[derive(Default)]
pub(crate) struct Sharing {
    /// Which round: what is made in another is of no use any more.
    pub(crate) round: u32,
    panes: Vec<Pane>,
    /// Those that nobody makes yet, the next one last.
    open: Vec<usize>,
    /// Those that mates make, in the order in which they were handed out.
    out: Vec<usize>,
    /// The one that is made here.
    own: Option<usize>,
    spent: Spent,
    /// Whether fine detail is left out of any.
    rough: bool,
}

/// What is to be done here.
#[derive(Debug, PartialEq)]
pub(crate) enum Turn {
    /// Begin this pane.
    Begin(Pane),
    /// Go on with the one that was begun.
    GoOn,
    /// Nothing: all panes are there.
    Done,
}

impl Sharing {
    /// Starts a round: those in the middle of the picture first, where mostly there is most to do.
    pub(crate) fn start(&mut self, viewport: Viewport, panes: Vec<Pane>) {
        let aside = |&number: &usize| {
            let Pane { x, y, width, height } = panes[number];
            let [x, y] = [(2 * x + width).abs_diff(viewport.width), (2 * y + height).abs_diff(viewport.height)];
            core::cmp::Reverse(x.max(y))
        };
        let mut open: Vec<usize> = (0..panes.len()).collect();
        open.sort_by_key(aside);
        let round = ROUNDS.fetch_add(1, Ordering::Relaxed) + 1;
        *self = Self { round, panes, open, ..Self::default() };
    }

    /// The same panes once more.
    pub(crate) fn start_again(&mut self, viewport: Viewport) {
        let panes = core::mem::take(&mut self.panes);
        self.start(viewport, panes);
    }

    /// The next pane for a mate, if nobody makes it yet.
    pub(crate) fn hand_out(&mut self) -> Option<(usize, Pane)> {
        let number = self.open.pop()?;
        self.out.push(number);
        Some((number, self.panes[number]))
    }

    /// A mate has made a pane. Whether it was wanted.
    pub(crate) fn take_in(&mut self, number: usize, spent: Spent, rough: bool) -> bool {
        let Some(at) = self.out.iter().position(|&out| out == number) else { return false };
        self.out.remove(at);
        if self.own == Some(number) {
            self.own = None;
        }
        self.spent.add(spent);
        self.rough |= rough;
        true
    }

    /// What to do here: what mates have not answered when nothing else is left is made here as well, what they were
    /// handed last first.
    pub(crate) fn turn(&mut self) -> Turn {
        if self.own.is_some() {
            return Turn::GoOn;
        }
        let open = self.open.pop();
        self.out.extend(open);
        self.own = open.or(self.out.last().copied());
        self.own.map_or(Turn::Done, |number| Turn::Begin(self.panes[number]))
    }

    /// The pane that is made here is there; which one that is.
    pub(crate) fn finish(&mut self, spent: Spent, rough: bool) -> Option<Pane> {
        let number = self.own?;
        self.take_in(number, spent, rough);
        Some(self.panes[number])
    }

    /// What all panes have taken that are there.
    pub(crate) fn spent(&self) -> Spent {
        self.spent
    }

    /// Whether fine detail is left out of any of those.
    pub(crate) fn is_rough(&self) -> bool {
        self.rough
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const VIEWPORT: Viewport = Viewport { width: 64, height: 160, ratio: 1.0 };

    fn sharing() -> Sharing {
        let mut sharing = Sharing::default();
        sharing.start(VIEWPORT, Pane::all(VIEWPORT, [64, 32]));
        sharing
    }

    fn number(turn: &Turn) -> u32 {
        match turn {
            Turn::Begin(pane) => pane.y / 32,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn alone_all_panes_are_made_here_the_middle_first() {
        let mut sharing = sharing();
        let mut made = vec![];
        while let turn @ Turn::Begin(_) = sharing.turn() {
            made.push(number(&turn));
            assert_eq!(sharing.turn(), Turn::GoOn);
            sharing.finish(Spent { work: 2.0, poor: made.len() == 3 }, made.len() == 4);
        }
        assert_eq!(made[0], 2);
        made.sort_unstable();
        assert_eq!(made, [0, 1, 2, 3, 4]);
        assert_eq!(sharing.spent(), Spent { work: 10.0, poor: true });
        assert!(sharing.is_rough());
        assert_eq!(sharing.turn(), Turn::Done);
    }

    #[test]
    fn mates_make_what_they_are_handed() {
        let mut sharing = sharing();
        let handed: Vec<usize> = core::iter::from_fn(|| Some(sharing.hand_out()?.0)).collect();
        assert_eq!(handed.len(), 5);
        for number in handed {
            assert!(sharing.take_in(number, Spent::default(), false));
            assert!(!sharing.take_in(number, Spent::default(), false), "twice");
        }
        assert_eq!(sharing.turn(), Turn::Done);
        assert!(!sharing.take_in(77, Spent::default(), false));
    }

    #[test]
    fn what_mates_do_not_answer_is_made_here() {
        let mut sharing = sharing();
        let lost = sharing.hand_out().unwrap().0;
        let slow = sharing.hand_out().unwrap().0;
        for _ in 0..3 {
            assert!(matches!(sharing.turn(), Turn::Begin(_)));
            sharing.finish(Spent::default(), false);
        }
        assert_eq!(number(&sharing.turn()) as usize, slow);
        // It answers after all, while the pane is made here.
        assert!(sharing.take_in(slow, Spent::default(), false));
        assert_eq!(number(&sharing.turn()) as usize, lost);
        assert_eq!(sharing.finish(Spent::default(), false).map(|pane| pane.y as usize / 32), Some(lost));
        assert!(!sharing.take_in(lost, Spent::default(), false), "too late");
        assert_eq!(sharing.turn(), Turn::Done);
    }

    #[test]
    fn rounds_are_told_apart() {
        let (mut sharing, other) = (sharing(), sharing());
        let before = sharing.round;
        sharing.hand_out();
        sharing.start_again(VIEWPORT);
        assert!(before < other.round && other.round < sharing.round);
        assert_eq!(sharing.open.len(), 5);
        sharing.start(Viewport { width: 0, ..VIEWPORT }, vec![]);
        assert_eq!(sharing.turn(), Turn::Done);
        assert_eq!(sharing.hand_out(), None);
    }
}
