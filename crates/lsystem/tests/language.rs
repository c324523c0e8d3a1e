//! Derivation with contexts, parameters and chance, compared with the naive reference.

use crate::naive;
use crate::naive::systems::{Features, system};
use lsystem::derive::{Fault, Letter, Rewriter};
use lsystem::{Limits, System};
use proptest::prelude::*;

/// Checks that the core derives the same generations as the naive reference, until the words get long.
fn check(system: &System, piece: usize) -> Result<(), TestCaseError> {
    let plain = |n: u32| naive::modules(&system.grammar, system.seed, n);
    let mut rewriter = match Rewriter::new(system.rules.clone(), system.seed, Limits::default()) {
        Ok(rewriter) => rewriter,
        Err(fault) => {
            prop_assert_eq!((fault, plain(0)), (Fault::NotFinite(None), None));
            return Ok(());
        }
    };
    for n in 0..6 {
        let expected = plain(n);
        let word = rewriter.word();
        let expected = expected.ok_or_else(|| TestCaseError::fail("a number is not finite"))?;
        let letters = word.letters.iter().map(|&letter| rewriter.rules().letters[usize::from(letter)]);
        let own = expected.iter().map(|m| Letter { symbol: m.symbol, arity: m.arguments.len() as u8 });
        prop_assert_eq!(letters.collect::<Vec<_>>(), own.collect::<Vec<_>>());
        let arguments: Vec<f64> = expected.into_iter().flat_map(|module| module.arguments).collect();
        prop_assert_eq!(&word.arguments, &arguments);
        if word.letters.len() > 600 {
            break;
        }
        loop {
            match rewriter.step(piece) {
                Ok(true) => break,
                Ok(false) => {}
                Err(fault) => {
                    prop_assert!(matches!(fault, Fault::NotFinite(Some(_))), "{:?}", fault);
                    prop_assert_eq!(plain(n + 1), None);
                    return Ok(());
                }
            }
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(test_effort::config())]

    #[test]
    fn context_sensitive_systems(system in system(Features { contexts: true, ..Features::default() }), piece in 1_usize..9) {
        check(&system, piece)?;
    }

    #[test]
    fn parametric_systems(system in system(Features { contexts: true, parameters: true, ..Features::default() }), piece in 1_usize..9) {
        check(&system, piece)?;
    }

    #[test]
    fn systems_that_cut_branches(
        system in any::<(bool, bool)>().prop_flat_map(|(contexts, parameters)| {
            system(Features { contexts, parameters, weights: true, images: false, cuts: true })
        }),
        piece in 1_usize..9,
    ) {
        check(&system, piece)?;
    }

    #[test]
    fn stochastic_systems(system in system(Features { contexts: true, parameters: true, weights: true, images: false, cuts: false }), piece in 1_usize..9) {
        check(&system, piece)?;
    }
}
