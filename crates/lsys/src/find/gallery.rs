//! The systems of the gallery, which a search of a picture tries before all others.

use lsystem::files::read_link;
use lsystem::find::Named;

/// The gallery: on each line the path of a system, a tab, and the system as a link without its style. It is written from
/// `data_in` by a test (`tests/gallery.rs`).
const GALLERY: &str = include_str!("gallery.txt");

/// The systems with their titles.
pub(super) fn systems() -> impl Iterator<Item = Named> {
    let read = |line: &str| {
        let (path, link) = line.split_once('\t')?;
        let definition = read_link(link)?.definition;
        Some(Named { name: format!("{} ({path})", definition.label()), definition })
    };
    GALLERY.lines().filter_map(read)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_is_a_system() {
        let systems: Vec<Named> = systems().collect();
        assert_eq!(systems.len(), GALLERY.lines().count());
        let koch = systems.iter().find(|named| named.name.ends_with("(focs-lsystems/koch-curve)"));
        assert!(koch.is_some_and(|named| !named.definition.rules.is_empty()), "{koch:?}");
    }
}
