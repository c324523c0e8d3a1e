//! The shortest linear recurrence of a sequence of whole numbers (Berlekamp 1968, Massey 1969).
//!
//! Counts of a matrix of whole numbers obey a recurrence with whole coefficients. It is found modulo a prime, and
//! checked modulo another one.

use crate::growth::process::Process;

/// Two primes; a coefficient is below half of the first.
const PRIMES: [u64; 2] = [(1 << 61) - 1, (1 << 62) - 57];
/// The most letters for which a recurrence is looked for.
const MAX_LETTERS: usize = 120;
/// Larger coefficients are not readable.
const MAX_COEFFICIENT: i128 = 1 << 40;

/// `s(n) = c[0] s(n-1) + c[1] s(n-2) + ...`, from generation `from` on.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Recurrence {
    pub(crate) coefficients: Vec<i128>,
    pub(crate) from: usize,
}

/// The recurrence of the weighted number of letters; `None` if it is too long.
pub(crate) fn recurrence(process: &Process, weights: &[u32]) -> Option<Recurrence> {
    if process.is_random() || process.letters() > MAX_LETTERS {
        return None;
    }
    let terms = 2 * process.letters() + 6;
    let found = shortest(&sequence(process, weights, terms, PRIMES[0]), PRIMES[0]);
    let coefficients: Vec<i128> = found.iter().map(|&value| signed(value, PRIMES[0])).collect();
    if coefficients.iter().any(|value| value.abs() > MAX_COEFFICIENT) {
        return None;
    }
    let other = sequence(process, weights, terms, PRIMES[1]);
    let order = coefficients.len();
    let holds = (order..terms).all(|n| {
        let prime = i128::from(PRIMES[1]);
        let sum = (0..order).fold(0, |sum, back| {
            (sum + coefficients[back].rem_euclid(prime) * i128::from(other[n - 1 - back]) % prime) % prime
        });
        sum == i128::from(other[n])
    });
    if !holds {
        return None;
    }
    // Coefficients of 0 at the end mean that the recurrence begins later.
    let kept = order - coefficients.iter().rev().take_while(|value| **value == 0).count();
    Some(Recurrence { coefficients: coefficients[..kept].to_vec(), from: order })
}

fn sequence(process: &Process, weights: &[u32], terms: usize, prime: u64) -> Vec<u64> {
    let mut counts: Vec<u64> = process.axiom.iter().map(|&count| u64::from(count)).collect();
    let mut sequence = Vec::with_capacity(terms);
    for _ in 0..terms {
        let sum: u128 =
            counts.iter().zip(weights).map(|(&a, &b)| u128::from(a) * u128::from(b) % u128::from(prime)).sum();
        sequence.push((sum % u128::from(prime)) as u64);
        counts = process.next_modulo(&counts, prime);
    }
    sequence
}

fn signed(value: u64, prime: u64) -> i128 {
    if value > prime / 2 { i128::from(value) - i128::from(prime) } else { i128::from(value) }
}

/// Berlekamp-Massey modulo a prime.
fn shortest(sequence: &[u64], prime: u64) -> Vec<u64> {
    let times = |a: u64, b: u64| (u128::from(a) * u128::from(b) % u128::from(prime)) as u64;
    let minus = |a: u64, b: u64| if a >= b { a - b } else { a + (prime - b) };
    let inverse = |value: u64| {
        let (mut result, mut base, mut exponent) = (1, value, prime - 2);
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = times(result, base);
            }
            base = times(base, base);
            exponent >>= 1;
        }
        result
    };
    // Connection polynomials: 1 - c[0] x - c[1] x^2 - ...
    let (mut current, mut last) = (vec![1_u64], vec![1_u64]);
    let (mut order, mut gap, mut last_discrepancy) = (0_usize, 1_usize, 1_u64);
    for n in 0..sequence.len() {
        let discrepancy = (0..=order.min(current.len() - 1)).fold(0, |sum, at| {
            let sum = u128::from(sum) + u128::from(times(current[at], sequence[n - at]));
            (sum % u128::from(prime)) as u64
        });
        if discrepancy == 0 {
            gap += 1;
            continue;
        }
        let factor = times(discrepancy, inverse(last_discrepancy));
        let before = current.clone();
        if current.len() < last.len() + gap {
            current.resize(last.len() + gap, 0);
        }
        for (at, &value) in last.iter().enumerate() {
            current[at + gap] = minus(current[at + gap], times(factor, value));
        }
        if 2 * order <= n {
            (order, last, last_discrepancy, gap) = (n + 1 - order, before, discrepancy, 1);
        } else {
            gap += 1;
        }
    }
    current.resize(order + 1, 0);
    current[1..].iter().map(|&value| minus(0, value)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_recurrences_are_found() {
        let fibonacci = [1, 2, 3, 5, 8, 13, 21, 34];
        assert_eq!(shortest(&fibonacci, PRIMES[0]), [1, 1]);
        assert_eq!(
            shortest(&[1, 4, 9, 16, 25, 36, 49, 64], PRIMES[0])
                .iter()
                .map(|&c| signed(c, PRIMES[0]))
                .collect::<Vec<_>>(),
            [3, -3, 1]
        );
        assert_eq!(shortest(&[5, 0, 0, 0, 0], PRIMES[0]), [0]);
        assert!(shortest(&[0, 0, 0], PRIMES[0]).is_empty());
    }

    #[test]
    fn the_primes_are_prime() {
        // Fermat's test with several bases.
        for prime in PRIMES {
            for base in [2_u64, 3, 5, 7, 11, 13] {
                let (mut result, mut power, mut exponent) = (1_u128, u128::from(base), prime - 1);
                while exponent > 0 {
                    if exponent & 1 == 1 {
                        result = result * power % u128::from(prime);
                    }
                    power = power * power % u128::from(prime);
                    exponent >>= 1;
                }
                assert_eq!(result, 1, "{prime} {base}");
            }
        }
    }
}
