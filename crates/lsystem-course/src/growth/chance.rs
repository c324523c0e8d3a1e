//! Expected numbers and their spread, with rules of chance: a branching process of several types (Harris 1963).

use crate::growth::process::Process;

/// The expected number and its standard deviation in each generation.
pub(crate) fn moments(process: &Process, weights: &[u32], most: usize) -> Vec<[f64; 2]> {
    let axiom = || process.axiom.iter().map(|&count| f64::from(count));
    // By letter: the mean and the variance of what one letter becomes.
    let mut mean: Vec<f64> = weights.iter().map(|&weight| f64::from(weight)).collect();
    let mut variance = vec![0.0; process.letters()];
    let mut all = Vec::with_capacity(most + 1);
    for _ in 0..=most {
        let sum = |of: &[f64]| {
            axiom().zip(of).map(|(count, value)| if count > 0.0 { count * value } else { 0.0 }).sum::<f64>()
        };
        all.push([sum(&mean), libm::sqrt(sum(&variance))]);
        let mut next = (vec![0.0; process.letters()], vec![0.0; process.letters()]);
        for (letter, outcomes) in process.outcomes.iter().enumerate() {
            let sums = outcomes.iter().map(|outcome| {
                let of =
                    |list: &[f64]| outcome.made.iter().map(|&(to, count)| f64::from(count) * list[to]).sum::<f64>();
                (outcome.chance, of(&mean), of(&variance))
            });
            let sums: Vec<(f64, f64, f64)> = sums.collect();
            let expected: f64 = sums.iter().map(|(chance, mean, _)| chance * mean).sum();
            next.0[letter] = expected;
            // The spread inside each outcome, and between the outcomes.
            let spread = |(chance, mean, variance): &(f64, f64, f64)| {
                chance * (variance + (mean - expected) * (mean - expected))
            };
            next.1[letter] = sums.iter().map(spread).sum();
        }
        (mean, variance) = next;
    }
    all
}
