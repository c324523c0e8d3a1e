//! The memory of a derivation, counted before it is taken.

/// Room for at least `needed` elements, on a grid of sizes: powers of two and those halfway between them. The grid does
/// not depend on how a word is made, so a limit on memory is passed at the same module whatever the steps are.
pub(super) fn room_for(needed: usize) -> usize {
    let top = needed.max(LEAST).next_power_of_two();
    let half = top / 4 * 3;
    if needed <= half { half } else { top }
}

/// Words shorter than this take as much memory as one of this length.
const LEAST: usize = 1 << 14;

/// What `bytes` of a growing word take while it grows: the former room, at most three quarters of the new, is held
/// until all has been moved.
pub(super) fn while_growing(bytes: u64) -> u64 {
    bytes + bytes / 4 * 3
}

/// Makes room for `needed` elements in a list whose content does not matter.
pub(super) fn renew<T>(list: &mut Vec<T>, needed: usize) {
    list.clear();
    if list.capacity() < needed {
        // The old memory is given back first.
        *list = Vec::new();
        list.reserve_exact(room_for(needed));
    }
}

/// The bytes that a list holds.
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
