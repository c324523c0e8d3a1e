//! What becomes of each element of a list, so that as many as possible stay.

use core::ops::Range;

/// What becomes of a list.
pub(super) struct Plan {
    pub(super) slots: Vec<Slot>,
    /// The new elements before all others.
    pub(super) first: Vec<String>,
}

/// What becomes of an element, and the new elements after it.
#[derive(Default)]
pub(super) struct Slot {
    pub(super) fate: Fate,
    pub(super) after: Vec<String>,
}

#[derive(Default)]
pub(super) enum Fate {
    #[default]
    Stays,
    /// The element is written anew.
    Becomes(String),
    /// These parts of the element are written anew.
    Changes(Vec<(Range<usize>, String)>),
    Goes,
}

/// The most comparisons; longer lists are compared at their ends only.
const MAX: usize = 1 << 20;

impl Plan {
    /// The plan that changes nothing in a list of `count` elements.
    pub(super) fn unchanged(count: usize) -> Self {
        Self { slots: (0..count).map(|_| Slot::default()).collect(), first: Vec::new() }
    }

    /// The plan that makes the lines `new` from `old`, where an element may hold any number of lines.
    pub(super) fn new(old: &[Vec<String>], new: &[String]) -> Self {
        let mut plan = Self::unchanged(old.len());
        let (mut element, mut line) = (0, 0);
        for (kept, kept_line) in kept(old, new).into_iter().chain([(old.len(), new.len())]) {
            plan.replace(element..kept, &new[line..kept_line]);
            (element, line) = (kept + 1, kept_line + old.get(kept).map_or(0, Vec::len));
        }
        plan
    }

    /// Puts new lines in place of elements.
    fn replace(&mut self, elements: Range<usize>, new: &[String]) {
        let paired = elements.len().min(new.len());
        for (slot, line) in self.slots[elements.clone()].iter_mut().zip(new) {
            slot.fate = Fate::Becomes(line.clone());
        }
        for slot in &mut self.slots[elements.start + paired..elements.end] {
            slot.fate = Fate::Goes;
        }
        let place = match (elements.start + paired).checked_sub(1) {
            Some(before) => &mut self.slots[before].after,
            None => &mut self.first,
        };
        place.extend_from_slice(&new[paired..]);
    }
}

/// The elements that stay, each with its first line in `new`: as many as possible.
fn kept(old: &[Vec<String>], new: &[String]) -> Vec<(usize, usize)> {
    let mut kept = Vec::new();
    let (mut start, mut line) = (0, 0);
    while start < old.len() && new[line..].starts_with(&old[start]) {
        kept.push((start, line));
        line += old[start].len();
        start += 1;
    }
    let mut ends = Vec::new();
    let (mut end, mut last) = (old.len(), new.len());
    while end > start && new[line..last].ends_with(&old[end - 1]) {
        end -= 1;
        last -= old[end].len();
        ends.push((end, last));
    }
    // The longest common subsequence: the most elements that stay from each pair of places on.
    let (height, width) = (end - start, last - line);
    let mut most = vec![0_u32; if height.saturating_mul(width) < MAX { (height + 1) * (width + 1) } else { 0 }];
    if !most.is_empty() {
        let matches = |y: usize, x: usize| new[line + x..last].starts_with(&old[start + y]);
        let at = |y: usize, x: usize| y * (width + 1) + x;
        for y in (0..height).rev() {
            for x in (0..=width).rev() {
                let skipped = if x < width { most[at(y, x + 1)] } else { 0 }.max(most[at(y + 1, x)]);
                let taken = if matches(y, x) { 1 + most[at(y + 1, x + old[start + y].len())] } else { 0 };
                most[at(y, x)] = skipped.max(taken);
            }
        }
        let (mut y, mut x) = (0, 0);
        while y < height {
            if matches(y, x) && most[at(y, x)] == 1 + most[at(y + 1, x + old[start + y].len())] {
                kept.push((start + y, line + x));
                x += old[start + y].len();
                y += 1;
            } else if x < width && most[at(y, x)] == most[at(y, x + 1)] {
                x += 1;
            } else {
                y += 1;
            }
        }
    }
    kept.extend(ends.into_iter().rev());
    kept
}
