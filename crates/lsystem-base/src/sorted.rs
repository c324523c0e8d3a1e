//! Sorting with small compiled code, for lists that are sorted once and then searched.
//!
//! The standard library's sorts take several kilobytes of wasm for each type of element and each comparison.

use core::cmp::Ordering;

/// Sorts by a comparison. Equal elements keep their order.
pub fn sort_by<T>(list: &mut [T], compare: impl Fn(&T, &T) -> Ordering) {
    let order = order(list.len(), &|one, other| compare(&list[one], &list[other]));
    arrange(list, order);
}

/// Sorts by a key, which is made once for each element. Elements of equal keys keep their order.
pub fn sort_by_key<T, K: Ord>(list: &mut [T], key: impl FnMut(&T) -> K) {
    let keys: Vec<K> = list.iter().map(key).collect();
    arrange(list, order(keys.len(), &|one, other| keys[one].cmp(&keys[other])));
}

/// The indices of so many elements, sorted: one sort for all types.
fn order(count: usize, compare: &dyn Fn(usize, usize) -> Ordering) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|&one, &other| compare(one, other));
    order
}

/// Puts the element at `order[at]` at each place `at`.
fn arrange<T>(list: &mut [T], mut order: Vec<usize>) {
    for start in 0..list.len() {
        let mut at = start;
        loop {
            let from = core::mem::replace(&mut order[at], at);
            if from == start {
                break;
            }
            list.swap(at, from);
            at = from;
        }
    }
}

/// Sorts in place without allocating: a heap sort (Williams, 1964). The sort is not stable.
pub fn sort<T: Ord>(list: &mut [T]) {
    let len = list.len();
    // The first len / 2 steps build a heap with the largest element on top; each further step removes the top.
    for step in (0..len + len / 2).rev() {
        let (mut parent, end) = match step.checked_sub(len) {
            Some(parent) => (parent, len),
            None => {
                list.swap(0, step);
                (0, step)
            }
        };
        loop {
            let mut child = 2 * parent + 1;
            if child + 1 < end && list[child] < list[child + 1] {
                child += 1;
            }
            if child >= end || list[child] <= list[parent] {
                break;
            }
            list.swap(parent, child);
            parent = child;
        }
    }
}

/// The distinct elements, sorted.
pub fn set<T: Ord>(elements: impl IntoIterator<Item = T>) -> Vec<T> {
    let mut list: Vec<T> = elements.into_iter().collect();
    sort(&mut list);
    list.dedup();
    list
}

/// For each key, whether the same key stands earlier in the list.
pub fn repeated<K: Ord>(keys: impl IntoIterator<Item = K>) -> Vec<bool> {
    let mut list: Vec<(K, usize)> = keys.into_iter().enumerate().map(|(at, key)| (key, at)).collect();
    sort(&mut list);
    let mut repeated = vec![false; list.len()];
    for pair in list.windows(2) {
        repeated[pair[1].1] = pair[0].0 == pair[1].0;
    }
    repeated
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn equal_elements_keep_their_order(list in prop::collection::vec(any::<(u8, i16)>(), 0..200)) {
            let expected = {
                let mut list = list.clone();
                list.sort_by_key(|(key, _)| *key);
                list
            };
            let (mut by, mut by_key) = (list.clone(), list);
            sort_by(&mut by, |(one, _), (other, _)| one.cmp(other));
            sort_by_key(&mut by_key, |(key, _)| *key);
            prop_assert_eq!(&by, &expected);
            prop_assert_eq!(&by_key, &expected);
        }

        #[test]
        fn sorts_as_the_standard_library(mut list in prop::collection::vec(any::<(u8, i16)>(), 0..200)) {
            let mut expected = list.clone();
            expected.sort_unstable();
            sort(&mut list);
            prop_assert_eq!(&list, &expected);
            expected.dedup();
            prop_assert_eq!(set(list), expected);
        }

        #[test]
        fn finds_what_is_repeated(keys in prop::collection::vec(0_u8..20, 0..40)) {
            let expected: Vec<bool> = (0..keys.len()).map(|at| keys[..at].contains(&keys[at])).collect();
            prop_assert_eq!(repeated(keys), expected);
        }
    }
}
