//! The growth factor and its kind, from the letters that make each other again.

use crate::growth::process::Process;

/// The most steps of the iteration that finds a growth factor.
const MAX_STEPS: usize = 20_000;
/// Factors that differ by less are equal.
const NEAR: f64 = 1e-9;

/// How a number of letters grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rate {
    /// The factor of one step in the long run; 0 if all letters die.
    pub(crate) factor: f64,
    /// The number grows like `n^degree * factor^n`.
    pub(crate) degree: u32,
}

/// The growth of what `counted` letters make up.
pub(crate) fn rate(process: &Process, counted: &[u32]) -> Rate {
    let matrix: Vec<Vec<(usize, f64)>> = (0..process.letters())
        .map(|from| process.expected(from).into_iter().enumerate().filter(|(_, count)| *count > 0.0).collect())
        .collect();
    let groups = groups(&matrix);
    // Groups are listed before those that make them.
    let mut group_of = vec![0; matrix.len()];
    groups.iter().enumerate().for_each(|(at, group)| group.iter().for_each(|&letter| group_of[letter] = at));
    let mut rates: Vec<Option<Rate>> = Vec::with_capacity(groups.len());
    for (at, group) in groups.iter().enumerate() {
        let own = perron(&matrix, group, &group_of, at);
        let made = group.iter().flat_map(|&letter| &matrix[letter]).map(|&(to, _)| group_of[to]);
        let best = made.filter(|&other| other != at).filter_map(|other| rates[other]).reduce(larger);
        let counts = group.iter().any(|&letter| counted[letter] > 0);
        rates.push(match best {
            None if counts => Some(Rate { factor: own, degree: 0 }),
            None => None,
            Some(best) if own > best.factor * (1.0 + NEAR) => Some(Rate { factor: own, degree: 0 }),
            Some(best) if own > 0.0 && own >= best.factor * (1.0 - NEAR) => {
                Some(Rate { degree: best.degree + 1, ..best })
            }
            best => best,
        });
    }
    let in_axiom = (0..matrix.len()).filter(|&letter| process.axiom[letter] > 0);
    in_axiom.filter_map(|letter| rates[group_of[letter]]).reduce(larger).unwrap_or(Rate { factor: 0.0, degree: 0 })
}

fn larger(a: Rate, b: Rate) -> Rate {
    match () {
        () if a.factor > b.factor * (1.0 + NEAR) => a,
        () if b.factor > a.factor * (1.0 + NEAR) => b,
        () if a.degree >= b.degree => a,
        () => b,
    }
}

/// The groups of letters that make each other, each before those that make it (Tarjan 1972, without recursion).
fn groups(matrix: &[Vec<(usize, f64)>]) -> Vec<Vec<usize>> {
    const NONE: usize = usize::MAX;
    let (mut found, mut low) = (vec![NONE; matrix.len()], vec![0; matrix.len()]);
    let (mut is_open, mut open, mut groups) = (vec![false; matrix.len()], Vec::new(), Vec::new());
    let mut count = 0;
    for start in 0..matrix.len() {
        if found[start] != NONE {
            continue;
        }
        let mut path = vec![(start, 0)];
        while let Some((letter, next)) = path.pop() {
            if next == 0 {
                (found[letter], low[letter]) = (count, count);
                count += 1;
                open.push(letter);
                is_open[letter] = true;
            }
            if let Some(&(to, _)) = matrix[letter].get(next) {
                path.push((letter, next + 1));
                if found[to] == NONE {
                    path.push((to, 0));
                } else if is_open[to] {
                    low[letter] = low[letter].min(found[to]);
                }
                continue;
            }
            if let Some(&(parent, _)) = path.last() {
                low[parent] = low[parent].min(low[letter]);
            }
            if low[letter] == found[letter] {
                let mut group = Vec::new();
                while let Some(member) = open.pop() {
                    is_open[member] = false;
                    group.push(member);
                    if member == letter {
                        break;
                    }
                }
                groups.push(group);
            }
        }
    }
    groups
}

/// The largest eigenvalue of the matrix inside a group. With 1 added to the diagonal the powers of the matrix converge,
/// and the least and the largest quotient enclose the eigenvalue (Collatz 1942).
fn perron(matrix: &[Vec<(usize, f64)>], group: &[usize], group_of: &[usize], at: usize) -> f64 {
    let inside = |letter: usize| matrix[letter].iter().filter(move |(to, _)| group_of[*to] == at);
    if let [letter] = group {
        return inside(*letter).map(|(_, count)| count).sum();
    }
    let mut place = vec![0; matrix.len()];
    group.iter().enumerate().for_each(|(index, &letter)| place[letter] = index);
    let mut vector = vec![1.0; group.len()];
    let (mut low, mut high) = (0.0, 0.0);
    for _ in 0..MAX_STEPS {
        let next: Vec<f64> = group
            .iter()
            .enumerate()
            .map(|(index, &letter)| {
                vector[index] + inside(letter).map(|&(to, count)| count * vector[place[to]]).sum::<f64>()
            })
            .collect();
        let quotients = || next.iter().zip(&vector).map(|(next, now)| next / now);
        (low, high) = (quotients().fold(f64::INFINITY, f64::min), quotients().fold(0.0, f64::max));
        let size = next.iter().copied().fold(0.0, f64::max);
        vector = next.into_iter().map(|value| value / size).collect();
        if high - low <= 1e-14 * high {
            break;
        }
    }
    f64::midpoint(low, high) - 1.0
}
