//! Fractions of machine numbers, with checked arithmetic.

/// A fraction in lowest terms with a positive denominator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Fraction {
    pub(crate) over: i128,
    pub(crate) under: i128,
}

impl Fraction {
    pub(crate) const ZERO: Self = Self { over: 0, under: 1 };

    pub(crate) fn new(over: i128, under: i128) -> Option<Self> {
        if under == 0 || over == i128::MIN || under == i128::MIN {
            return None;
        }
        let divisor = gcd(over.unsigned_abs(), under.unsigned_abs()).max(1) as i128;
        let sign = under.signum();
        Some(Self { over: sign * over / divisor, under: sign * under / divisor })
    }

    pub(crate) fn whole(value: i128) -> Self {
        Self { over: value, under: 1 }
    }

    pub(crate) fn is_zero(self) -> bool {
        self.over == 0
    }

    pub(crate) fn minus(self, other: Self) -> Option<Self> {
        let left = self.over.checked_mul(other.under)?;
        let right = other.over.checked_mul(self.under)?;
        Self::new(left.checked_sub(right)?, self.under.checked_mul(other.under)?)
    }

    pub(crate) fn times(self, other: Self) -> Option<Self> {
        // Reduced crosswise first, so that fewer products are too large.
        let (a, b) = (Self::new(self.over, other.under)?, Self::new(other.over, self.under)?);
        Self::new(a.over.checked_mul(b.over)?, a.under.checked_mul(b.under)?)
    }

    pub(crate) fn by(self, other: Self) -> Option<Self> {
        if other.is_zero() { None } else { self.times(Self::new(other.under, other.over)?) }
    }
}

fn gcd(a: u128, b: u128) -> u128 {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// Solves a system of linear equations; each row ends with its right side. `None` if there is no single solution or a
/// number becomes too large.
pub(crate) fn solve(mut rows: Vec<Vec<Fraction>>) -> Option<Vec<Fraction>> {
    let size = rows.len();
    for column in 0..size {
        let pivot = (column..size).find(|&row| !rows[row][column].is_zero())?;
        rows.swap(column, pivot);
        let divisor = rows[column][column];
        for value in &mut rows[column] {
            *value = value.by(divisor)?;
        }
        let main = rows[column].clone();
        for (at, row) in rows.iter_mut().enumerate() {
            let factor = row[column];
            if at == column || factor.is_zero() {
                continue;
            }
            for (value, part) in row.iter_mut().zip(&main) {
                *value = value.minus(part.times(factor)?)?;
            }
        }
    }
    rows.into_iter().map(|row| row.last().copied()).collect()
}
