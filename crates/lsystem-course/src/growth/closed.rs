//! Closed forms of recurrences whose roots are whole numbers and at most one pair of real square roots.

use crate::growth::fraction::{Fraction, solve};
use crate::growth::recurrence::Recurrence;

/// The largest whole root that is looked for.
const MAX_ROOT: i128 = 1_000;
/// The longest recurrence with a closed form that is still read by people.
const MAX_ORDER: usize = 8;

/// The roots of `x^2 = p x + q`: `(p ± k √d) / 2`, where no square divides `d`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Pair {
    pub(crate) p: i128,
    pub(crate) q: i128,
    pub(crate) k: i128,
    pub(crate) d: i128,
}

impl Pair {
    fn new(p: i128, q: i128) -> Option<Self> {
        let mut d = p.checked_mul(p)?.checked_add(q.checked_mul(4)?)?;
        if !(1..1 << 40).contains(&d) {
            return None;
        }
        let mut k = 1;
        let mut factor = 2;
        while factor * factor <= d {
            while d % (factor * factor) == 0 {
                d /= factor * factor;
                k *= factor;
            }
            factor += 1;
        }
        Some(Self { p, q, k, d })
    }

    /// The larger root.
    pub(crate) fn value(self) -> f64 {
        (self.p as f64 + self.k as f64 * libm::sqrt(self.d as f64)) / 2.0
    }
}

/// A part of a closed form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Term {
    /// `factor * n^power * root^n`.
    Whole { factor: Fraction, power: u32, root: i128 },
    /// `(u + v √d) ((p + k √d) / 2)^n + (u - v √d) ((p - k √d) / 2)^n`.
    Pair { u: Fraction, v: Fraction, pair: Pair },
}

/// The roots of a recurrence's polynomial.
pub(crate) struct Roots {
    /// Whole roots, largest first, with how often each occurs.
    pub(crate) whole: Vec<(i128, u32)>,
    pub(crate) pair: Option<Pair>,
    /// Whether these are all roots.
    pub(crate) are_all: bool,
}

/// The roots other than 0.
pub(crate) fn roots(recurrence: &Recurrence) -> Roots {
    // From the highest power down: x^L - c[0] x^(L-1) - ...
    let mut polynomial: Vec<i128> = [1].into_iter().chain(recurrence.coefficients.iter().map(|c| -c)).collect();
    let mut whole = Vec::new();
    for root in (1..=MAX_ROOT).rev().flat_map(|root| [root, -root]) {
        let mut times = 0;
        while polynomial.len() > 1
            && let Some(quotient) = divided(&polynomial, root)
        {
            polynomial = quotient;
            times += 1;
        }
        if times > 0 {
            whole.push((root, times));
        }
    }
    let pair = match polynomial[..] {
        [1, a, b] => Pair::new(-a, -b),
        _ => None,
    };
    let are_all = polynomial.len() == 1 || pair.is_some();
    Roots { whole, pair, are_all }
}

/// The polynomial divided by `x - root`, if that leaves nothing (Horner).
fn divided(polynomial: &[i128], root: i128) -> Option<Vec<i128>> {
    let mut quotient = Vec::with_capacity(polynomial.len());
    let mut rest: i128 = 0;
    for &coefficient in polynomial {
        rest = rest.checked_mul(root)?.checked_add(coefficient)?;
        quotient.push(rest);
    }
    (quotient.pop() == Some(0)).then_some(quotient)
}

/// The closed form of a sequence with these first values, from the generation where the recurrence begins to hold
/// without its roots 0. `None` if its roots are of other kinds.
pub(crate) fn closed(recurrence: &Recurrence, roots: &Roots, values: &[i128]) -> Option<(Vec<Term>, usize)> {
    let order = recurrence.coefficients.len();
    let from = recurrence.from - order;
    if !roots.are_all || order > MAX_ORDER || values.len() < from + order + 2 {
        return None;
    }
    let mut kinds: Vec<(u32, i128)> = Vec::new();
    for (root, times) in &roots.whole {
        kinds.extend((0..*times).rev().map(|power| (power, *root)));
    }
    let row = |n: usize| -> Option<Vec<Fraction>> {
        let exponent = u32::try_from(n).ok()?;
        let mut row = Vec::new();
        for (power, root) in &kinds {
            row.push(Fraction::whole((n as i128).checked_pow(*power)?.checked_mul(root.checked_pow(exponent)?)?));
        }
        if let Some(pair) = roots.pair {
            // With ((p + k √d) / 2)^n = (a + b √d) / 2, the pair adds u a + v b d.
            let (a, b) = powers(pair, n)?;
            row.extend([Fraction::whole(a), Fraction::whole(b.checked_mul(pair.d)?)]);
        }
        Some(row)
    };
    let with_value = |n: usize| {
        let mut row = row(n)?;
        row.push(Fraction::whole(values[n]));
        Some(row)
    };
    let found = solve((from..from + order).map(with_value).collect::<Option<_>>()?)?;
    let mut terms: Vec<Term> = (kinds.iter().zip(&found))
        .filter(|(_, factor)| !factor.is_zero())
        .map(|(&(power, root), &factor)| Term::Whole { factor, power, root })
        .collect();
    if let (Some(pair), [.., u, v]) = (roots.pair, &found[..]) {
        terms.insert(0, Term::Pair { u: *u, v: *v, pair });
    }
    Some((terms, from))
}

/// `a` and `b` of `((p + k √d) / 2)^n = (a + b √d) / 2`.
fn powers(pair: Pair, n: usize) -> Option<(i128, i128)> {
    let Pair { p, q, k, .. } = pair;
    let (mut last, mut now) = ((2, 0), (p, k));
    if n == 0 {
        return Some(last);
    }
    for _ in 1..n {
        let next = |now: i128, last: i128| p.checked_mul(now)?.checked_add(q.checked_mul(last)?);
        (last, now) = (now, (next(now.0, last.0)?, next(now.1, last.1)?));
    }
    Some(now)
}
