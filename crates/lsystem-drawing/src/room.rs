//! Lists that grow within a limit of memory.

/// The bytes that a list takes.
pub(crate) fn bytes_of<T>(list: &Vec<T>) -> u64 {
    (list.capacity() * size_of::<T>()) as u64
}

/// How many elements a list has after it has got room for `more`; `None` where it has that already. Short lists
/// double; long ones grow by an eighth, so that little stays unused.
fn grown<T>(list: &Vec<T>, more: usize) -> Option<usize> {
    const SHORT: usize = 1 << 14;
    let len = list.len();
    let more_than_asked = if len < SHORT { len } else { len / 8 };
    (list.capacity() - len < more).then(|| len.saturating_add(more.max(more_than_asked)))
}

/// The bytes that are taken when a list gets room for `more` elements; 0 where it has that already.
pub(crate) fn bytes_for<T>(list: &Vec<T>, more: usize) -> u64 {
    grown(list, more).map_or(0, |elements| elements.saturating_mul(size_of::<T>()) as u64)
}

/// Makes room for `more` elements.
pub(crate) fn reserve<T>(list: &mut Vec<T>, more: usize) {
    if let Some(elements) = grown(list, more) {
        list.reserve_exact(elements - list.len());
    }
}
