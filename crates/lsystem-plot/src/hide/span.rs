//! Stretches of a line, and what clips them.

/// A stretch of a line between two of its places: 0 is the line's start, and 1 its end. Empty unless `low < high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Span {
    pub(super) low: f64,
    pub(super) high: f64,
}

impl Span {
    /// The whole of the line, prolonged on both sides.
    pub(super) const ALL: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };
    /// Nothing.
    pub(super) const NONE: Self = Self { low: f64::INFINITY, high: f64::NEG_INFINITY };

    /// The part where `start + place * slope <= 0`.
    pub(super) fn below(self, start: f64, slope: f64) -> Self {
        let Self { low, high } = self;
        if slope > 0.0 {
            Self { low, high: high.min(-start / slope) }
        } else if slope < 0.0 {
            Self { low: low.max(-start / slope), high }
        } else if start <= 0.0 {
            self
        } else {
            Self::NONE
        }
    }

    /// Where `a * place^2 + 2 * b * place + c <= 0`, for `a` above 0.
    pub(super) fn quadratic(a: f64, b: f64, c: f64) -> Self {
        let root = b * b - a * c;
        if root > 0.0 {
            let root = root.sqrt();
            Self { low: (-b - root) / a, high: (-b + root) / a }
        } else {
            Self::NONE
        }
    }

    /// The least stretch with both.
    pub(super) fn with(self, other: Self) -> Self {
        if other.is_empty() {
            return self;
        }
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// The part between two places.
    pub(super) fn within(self, low: f64, high: f64) -> Self {
        Self { low: self.low.max(low), high: self.high.min(high) }
    }

    pub(super) fn is_empty(self) -> bool {
        self.low.partial_cmp(&self.high) != Some(core::cmp::Ordering::Less)
    }
}

/// The rest of a line that is hidden in these stretches, in order. The stretches are sorted.
pub(super) fn rest(hidden: &mut [Span]) -> impl Iterator<Item = Span> {
    /// A shorter rest is a rounding error.
    const LEAST: f64 = 1e-9;
    hidden.sort_unstable_by(|a, b| a.low.total_cmp(&b.low));
    let mut at = 0.0_f64;
    let end = Span { low: 1.0, high: 1.0 };
    hidden.iter().copied().chain([end]).filter_map(move |span| {
        let visible = Span { low: at, high: span.low };
        at = at.max(span.high);
        (visible.high - visible.low > LEAST).then_some(visible)
    })
}
