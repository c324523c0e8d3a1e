//! Lists that grow within a memory limit.

/// The bytes that a list occupies.
pub(crate) fn bytes_of<T>(list: &Vec<T>) -> u64 {
    (list.capacity() * size_of::<T>()) as u64
}

/// The capacity that a list needs for `more` elements; `None` if the present capacity is enough. Short lists double;
/// long lists grow by an eighth, so that little memory stays unused.
fn grown<T>(list: &Vec<T>, more: usize) -> Option<usize> {
    const SHORT: usize = 1 << 14;
    let len = list.len();
    let more_than_asked = if len < SHORT { len } else { len / 8 };
    (list.capacity() - len < more).then(|| len.saturating_add(more.max(more_than_asked)))
}

/// The bytes that [`reserve`] allocates for `more` elements; 0 if the present capacity is enough.
pub(crate) fn bytes_for<T>(list: &Vec<T>, more: usize) -> u64 {
    grown(list, more).map_or(0, |elements| elements.saturating_mul(size_of::<T>()) as u64)
}

/// Grows the list's capacity for `more` elements.
pub(crate) fn reserve<T>(list: &mut Vec<T>, more: usize) {
    if let Some(elements) = grown(list, more) {
        list.reserve_exact(elements - list.len());
    }
}
