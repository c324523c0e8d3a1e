//! Segments brought to a common place and size.

/// A segment: both ends. In the plane the third coordinate is 0.
pub type Ends = [[f64; 3]; 2];

/// A map of points to a common place and size.
#[derive(Clone, Copy)]
pub(crate) struct Fit {
    pub(crate) at: [f64; 3],
    pub(crate) size: f64,
}

/// The least and the greatest coordinates.
pub(crate) fn extent(segments: &[Ends]) -> [[f64; 3]; 2] {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for point in segments.iter().flatten() {
        for axis in 0..3 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }
    [low, high]
}

impl Fit {
    /// Puts the centre of the extent to the origin and makes its longest side 1.
    pub(crate) fn whole(segments: &[Ends]) -> Self {
        Self::of(extent(segments))
    }

    /// Puts the centre of an extent to the origin and makes its longest side 1.
    pub(crate) fn of([low, high]: [[f64; 3]; 2]) -> Self {
        let at = [0, 1, 2].map(|axis| low[axis] / 2.0 + high[axis] / 2.0);
        let size = (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max);
        Self { at, size }.usable()
    }

    /// Puts the start of the first segment to the origin and makes its length 1.
    pub(crate) fn first(segments: &[Ends]) -> Self {
        let Some(first) = segments.iter().find(|segment| length(segment) > 0.0) else { return Self::whole(segments) };
        Self { at: first[0], size: length(first) }.usable()
    }

    fn usable(self) -> Self {
        let size = if self.size.is_normal() { self.size } else { 1.0 };
        Self { at: self.at.map(|value| if value.is_finite() { value } else { 0.0 }), size }
    }

    pub(crate) fn place(&self, segment: &Ends) -> Ends {
        segment.map(|point| [0, 1, 2].map(|axis| (point[axis] - self.at[axis]) / self.size))
    }
}

pub(crate) fn length([from, to]: &Ends) -> f64 {
    libm::sqrt((0..3).map(|axis| (to[axis] - from[axis]) * (to[axis] - from[axis])).sum())
}
