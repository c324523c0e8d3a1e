//! The memory of a derivation, counted before it is allocated.

/// The capacity for at least `needed` elements: a power of two, or the midpoint of two powers of two. Fixed sizes make
/// a limit on memory stop at the same module, whatever the budgets of the steps are.
pub(super) fn room_for(needed: usize) -> usize {
    let top = needed.max(LEAST).next_power_of_two();
    let half = top / 4 * 3;
    if needed <= half { half } else { top }
}

/// The least capacity is three quarters of this number of elements.
const LEAST: usize = 1 << 14;

/// The memory during growth of a word to `bytes`: the old memory, at most three quarters of the new, is held until its
/// content has moved.
pub(super) fn while_growing(bytes: u64) -> u64 {
    bytes + bytes / 4 * 3
}

/// Empties a list and makes room for `needed` elements.
pub(super) fn renew<T>(list: &mut Vec<T>, needed: usize) {
    list.clear();
    if list.capacity() < needed {
        // Frees the old memory first.
        *list = Vec::new();
        list.reserve_exact(room_for(needed));
    }
}

/// The bytes of a list's memory.
pub(super) fn held<T>(list: &Vec<T>) -> u64 {
    (list.capacity() * size_of::<T>()) as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn room_is_enough_and_not_much_more() {
        for needed in [0, 1, LEAST, LEAST + 1, 100_000, 1 << 20, (1 << 20) + 1] {
            let room = room_for(needed);
            assert!(room >= needed && (room <= LEAST || room <= needed / 2 * 3), "{needed}: {room}");
        }
    }

    #[test]
    fn room_that_is_enough_is_kept() {
        let mut list = vec![1_u8; 1 << 20];
        renew(&mut list, 100);
        assert!(list.is_empty() && list.capacity() >= 1 << 20);
        renew(&mut list, 2 << 20);
        assert!(list.capacity() >= 2 << 20);
    }
}
