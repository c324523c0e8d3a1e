//! A long list in pieces. A full piece never moves, so that growth neither copies the list nor holds it twice.

use crate::room::{bytes_for, bytes_of, reserve};
use core::ops::{Index, Range};

/// The number of elements in a piece; a piece of one longer run has more.
const PIECE: usize = 1 << SHIFT;
const SHIFT: usize = 15;

/// Elements in runs; each run is a slice. The numbers of elements are not consecutive: each piece starts at a multiple
/// of 32,768.
#[derive(Clone, Debug)]
pub struct Chunks<T> {
    pieces: Vec<Vec<T>>,
    /// By an element's number divided by [`PIECE`]: the index of the piece with the element. A longer piece has several
    /// entries.
    owners: Vec<u32>,
    /// The number of the first element of each piece.
    starts: Vec<u32>,
    /// The bytes of all pieces.
    bytes: u64,
}

impl<T> Chunks<T> {
    pub(crate) const fn new() -> Self {
        Self { pieces: vec![], owners: vec![], starts: vec![], bytes: 0 }
    }

    /// The bytes that the list occupies.
    pub(crate) fn bytes(&self) -> u64 {
        self.bytes + bytes_of(&self.pieces) + bytes_of(&self.owners) + bytes_of(&self.starts)
    }

    /// The bytes that appending `run` elements allocates for them; 0 if the last piece has room.
    pub(crate) fn bytes_for(&self, run: usize) -> u64 {
        match self.open(run) {
            Some(piece) => bytes_for(piece, run),
            None => (self.room(run) * size_of::<T>()) as u64,
        }
    }

    /// Appends a run. Returns the numbers of its elements.
    pub(crate) fn push(&mut self, run: impl ExactSizeIterator<Item = T>) -> Range<u32> {
        let count = run.len();
        if self.open(count).is_none() {
            let (start, room) = (self.owners.len() << SHIFT, self.room(count));
            self.owners.resize(self.owners.len() + count.div_ceil(PIECE).max(1), self.pieces.len() as u32);
            self.starts.push(start as u32);
            self.pieces.push(Vec::with_capacity(room));
            self.bytes += (room * size_of::<T>()) as u64;
        }
        let Some((piece, start)) = self.pieces.last_mut().zip(self.starts.last()) else { return 0..0 };
        let before = bytes_of(piece);
        reserve(piece, count);
        self.bytes += bytes_of(piece) - before;
        let first = start + piece.len() as u32;
        piece.extend(run);
        first..first + count as u32
    }

    /// The last piece, if `run` more elements stay within [`PIECE`].
    fn open(&self, run: usize) -> Option<&Vec<T>> {
        self.pieces.last().filter(|piece| piece.len() + run <= PIECE)
    }

    /// The capacity of a new piece. The first piece starts small and grows, so that a short list takes little memory.
    fn room(&self, run: usize) -> usize {
        if self.pieces.is_empty() { run } else { run.max(PIECE) }
    }

    /// Frees the unused capacity of the last piece.
    pub(crate) fn shrink(&mut self) {
        if let Some(piece) = self.pieces.last_mut() {
            let before = bytes_of(piece);
            piece.shrink_to_fit();
            self.bytes -= before - bytes_of(piece);
        }
    }

    /// All elements in order.
    pub fn iter(&self) -> impl Iterator<Item = &T> {
        self.pieces.iter().flatten()
    }

    /// The element with this number, if any.
    pub(crate) fn get_mut(&mut self, number: usize) -> Option<&mut T> {
        let owner = *self.owners.get(number >> SHIFT)? as usize;
        self.pieces[owner].get_mut(number - self.starts[owner] as usize)
    }

    /// The element with this number, if any.
    #[must_use]
    pub fn get(&self, number: usize) -> Option<&T> {
        let owner = *self.owners.get(number >> SHIFT)? as usize;
        self.pieces[owner].get(number - self.starts[owner] as usize)
    }
}

impl<T> Index<usize> for Chunks<T> {
    type Output = T;

    #[inline]
    fn index(&self, number: usize) -> &T {
        let owner = self.owners[number >> SHIFT] as usize;
        &self.pieces[owner][number - self.starts[owner] as usize]
    }
}

impl<T> Index<Range<usize>> for Chunks<T> {
    type Output = [T];

    /// Elements of one run.
    #[inline]
    fn index(&self, Range { start, end }: Range<usize>) -> &[T] {
        let Some(&owner) = self.owners.get(start >> SHIFT).filter(|_| start < end) else { return &[] };
        let (piece, first) = (&self.pieces[owner as usize], self.starts[owner as usize] as usize);
        &piece[start - first..end - first]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_of_any_length_are_slices() {
        let mut chunks = Chunks::new();
        let mut next = 0_u32;
        let mut runs = vec![];
        for length in [3, 0, PIECE - 4, 2, 1, 3 * PIECE + 7, 1, PIECE, PIECE + 1, 5, 0, 9] {
            let run = next..next + length as u32;
            next = run.end;
            let (before, taken) = (chunks.bytes, chunks.bytes_for(length));
            runs.push((chunks.push(run.clone()), run));
            assert!(chunks.bytes - before <= taken, "{length}");
        }
        for (numbers, run) in runs {
            let range = numbers.start as usize..numbers.end as usize;
            assert!(chunks[range.clone()].iter().copied().eq(run.clone()));
            assert!(
                range.zip(run).all(|(number, value)| chunks[number] == value && chunks.get(number) == Some(&value))
            );
        }
        assert!(chunks.iter().copied().eq(0..next));
        chunks.shrink();
        assert!(chunks.bytes >= u64::from(next) * 4);
        assert_eq!(chunks.get(usize::MAX >> 1), None);
    }
}
