//! Marks compared with brute force: every one-symbol edit of ten systems, and other rules with the same picture. Hints
//! compared with the edits that caused them.

use crate::naive;

use lsystem_base::Limits;
use naive::is_same;
use naive::systems::{one_symbol_edits, rewritings, systems};

/// The reference accepts what must be the same by construction, and rejects most edits.
#[test]
fn the_reference_is_right() {
    let mut accepted = 0;
    for system in systems() {
        let target = system.segments().unwrap();
        for (kind, other) in rewritings(&system) {
            assert!(is_same(&target, &other.segments().unwrap()), "{}: {kind}: {other:?}", system.name);
            accepted += 1;
        }
        let edits = one_symbol_edits(&system.rules[0].1, &system.alphabet());
        let is_right = |edit: &&String| {
            let segments = system.with_rule(0, edit.to_string()).segments();
            segments.is_some_and(|segments| is_same(&target, &segments))
        };
        let right = edits.iter().filter(is_right).count();
        assert!(edits.len() >= 48 && right < edits.len() / 3, "{}: {right} of {}", system.name, edits.len());
    }
    assert!(accepted >= 200, "{accepted}");
}

/// The reference draws what the library draws, also of edits with unmatched brackets.
#[test]
fn the_reference_draws_as_the_library() {
    for system in systems() {
        let edits = one_symbol_edits(&system.rules[0].1, &system.alphabet());
        let edited = edits.iter().step_by(5).map(|edit| system.with_rule(0, edit.clone()));
        for system in std::iter::once(system.clone()).chain(edited) {
            let Some(expected) = system.segments() else { continue };
            let definition = system.definition();
            let compiled = lsystem_drawing::System::new(&definition).expect("edits stay readable");
            let drawing = lsystem_drawing::draw::<lsystem_drawing::Plane>(&compiled, system.n, &Limits::default())
                .expect("a small drawing");
            let found: Vec<_> = drawing.segments().map(|segment| [segment.from, segment.to]).collect();
            assert_eq!(found.len(), expected.len(), "{system:?}");
            let ends = found.iter().flatten().flatten().zip(expected.iter().flatten().flatten());
            assert!(ends.into_iter().all(|(a, b)| (a - b).abs() < 1e-9), "{system:?}");
        }
    }
}

/// The library agrees with the reference on every edit and every rewriting.
#[test]
fn the_same_pictures_as_brute_force() {
    let in_space = |segments: Vec<[[f64; 2]; 2]>| -> Vec<lsystem_course::Ends> {
        segments.into_iter().map(|segment| segment.map(|[x, y]| [x, y, 0.0])).collect()
    };
    for system in systems() {
        let target = system.segments().unwrap();
        let edits = one_symbol_edits(&system.rules[0].1, &system.alphabet());
        let edited = edits.into_iter().map(|edit| ("edit", system.with_rule(0, edit)));
        for (kind, other) in edited.chain(rewritings(&system)) {
            let Some(segments) = other.segments() else { continue };
            let expected = is_same(&target, &segments);
            let found = lsystem_course::is_same_picture(&in_space(target.clone()), &in_space(segments));
            assert_eq!(found, expected, "{}: {kind}: {other:?}", system.name);
        }
    }
}
