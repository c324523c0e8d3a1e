//! Sorting in steps.

use core::cmp::Ordering;
use lsystem_syntax::{Meter, Progress};

/// The length of the runs that are sorted first.
const RUN: usize = 256;
/// The elements merged between two checks of the meter.
const PIECE: usize = 1024;

/// A merge sort that can be interrupted.
#[derive(Clone, Debug)]
pub(super) struct Sort<T> {
    order: fn(&T, &T) -> Ordering,
    from: Vec<T>,
    to: Vec<T>,
    /// The length of the sorted runs in `from`; 0 while the first runs are sorted.
    run: usize,
    /// The start of the pair of runs being merged, or of the first run to sort.
    start: usize,
    /// The next element of each of the two runs.
    next: [usize; 2],
}

impl<T: Copy> Sort<T> {
    /// Prepares the sorting of `list`.
    pub(super) fn new(list: Vec<T>, order: fn(&T, &T) -> Ordering) -> Self {
        Self { order, from: list, to: Vec::new(), run: 0, start: 0, next: [0; 2] }
    }

    /// Continues until the meter is spent.
    pub(super) fn step(&mut self, meter: &mut Meter) -> Progress {
        while !meter.is_spent() {
            if self.run == 0 {
                let end = (self.start + RUN).min(self.from.len());
                self.from[self.start..end].sort_by(self.order);
                meter.charge((end - self.start) as u64);
                self.start = end;
                if end == self.from.len() {
                    self.run = RUN;
                    self.begin(0);
                }
            } else if self.run >= self.from.len() {
                self.to = Vec::new();
                return Progress::Done;
            } else {
                self.merge();
                meter.charge(PIECE as u64 / 4);
            }
        }
        Progress::More
    }

    /// The sorted list, after all steps.
    pub(super) fn finish(self) -> Vec<T> {
        self.from
    }

    fn begin(&mut self, start: usize) {
        self.start = start;
        self.next = [start, (start + self.run).min(self.from.len())];
    }

    /// Merges up to [`PIECE`] elements of two runs.
    fn merge(&mut self) {
        let length = self.from.len();
        if self.to.capacity() < length {
            self.to.reserve_exact(length - self.to.len());
        }
        let [middle, end] = [self.run, 2 * self.run].map(|part| (self.start + part).min(length));
        for _ in 0..PIECE {
            let [left, right] = self.next;
            let takes_left = match (left < middle, right < end) {
                (true, true) => (self.order)(&self.from[right], &self.from[left]) != Ordering::Less,
                (false, false) => break,
                (has_left, _) => has_left,
            };
            self.to.push(self.from[if takes_left { left } else { right }]);
            self.next[usize::from(!takes_left)] += 1;
        }
        if self.next == [middle, end] {
            if end == length {
                core::mem::swap(&mut self.from, &mut self.to);
                self.to.clear();
                self.run *= 2;
                self.begin(0);
            } else {
                self.begin(end);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_of_any_size_sort_like_the_standard_library() {
        for length in [0, 1, 2, 255, 256, 257, 5000, 70_001] {
            let list: Vec<u32> = (0..length).map(|at: u32| at.wrapping_mul(2_654_435_761) % 1000).collect();
            let mut pairs: Vec<(u32, usize)> = list.iter().copied().zip(0..).collect();
            let mut sort = Sort::new(pairs.clone(), |a, b| a.0.cmp(&b.0));
            while sort.step(&mut Meter::new(700)) == Progress::More {}
            pairs.sort_by_key(|pair| pair.0);
            assert_eq!(sort.finish(), pairs, "{length}");
        }
    }
}
