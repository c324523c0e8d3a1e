//! The outlines that a symbol can fill: a disc, and leaves.

/// The number of sides of a circle and of a disc. With 32 sides, the sides stay within half a pixel of a true circle
/// with a diameter of up to 200 pixels.
pub const CIRCLE_SIDES: u32 = 32;

/// A shape that the turtle fills in the plane of its heading and its left.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Outline {
    /// A disc around the turtle, with [`CIRCLE_SIDES`] corners; its size is the diameter.
    Disc,
    /// A leaf ahead of the turtle that is widest below its middle, like a willow's; the size of all leaves is their
    /// length.
    Lance,
    /// A leaf with two lobes beside its stalk, like a lime's.
    Heart,
    /// A leaf with round lobes along both sides.
    Oak,
    /// A needle.
    Needle,
    /// A petal: widest near its end, which is notched.
    Petal,
}

/// The right side of a leaf from its base to its tip: parts of the length ahead and aside.
type Side = &'static [[f64; 2]];

impl Outline {
    /// All outlines.
    pub const ALL: [Self; 6] = [Self::Disc, Self::Lance, Self::Heart, Self::Oak, Self::Needle, Self::Petal];

    /// The number of corners.
    #[must_use]
    pub fn sides(self) -> u32 {
        match self.side() {
            Some(side) => 2 * side.len() as u32 + 1,
            None => CIRCLE_SIDES,
        }
    }

    /// The corners of a leaf of length 1, counter-clockwise from its base, which is at the origin: ahead and to the
    /// left. `None` for a disc.
    pub fn leaf(self) -> Option<impl Iterator<Item = [f64; 2]>> {
        let side = self.side()?;
        let right = side.iter().map(|&[ahead, aside]| [ahead, -aside]);
        Some(core::iter::once([0.0; 2]).chain(right).chain(side.iter().rev().copied()))
    }

    fn side(self) -> Option<Side> {
        Some(match self {
            Self::Disc => return None,
            Self::Lance => {
                &[[0.07, 0.05], [0.18, 0.105], [0.32, 0.135], [0.48, 0.13], [0.65, 0.1], [0.82, 0.056], [1.0, 0.003]]
            }
            Self::Heart => &[
                [-0.08, 0.08],
                [-0.11, 0.2],
                [-0.07, 0.32],
                [0.06, 0.41],
                [0.24, 0.43],
                [0.44, 0.37],
                [0.64, 0.26],
                [0.82, 0.13],
                [1.0, 0.004],
            ],
            Self::Oak => &[
                [0.1, 0.03],
                [0.15, 0.11],
                [0.22, 0.13],
                [0.28, 0.07],
                [0.34, 0.11],
                [0.39, 0.21],
                [0.47, 0.23],
                [0.52, 0.12],
                [0.58, 0.14],
                [0.63, 0.25],
                [0.72, 0.26],
                [0.76, 0.14],
                [0.82, 0.17],
                [0.89, 0.19],
                [0.96, 0.11],
                [1.0, 0.03],
            ],
            Self::Needle => &[[0.03, 0.015], [0.3, 0.022], [0.8, 0.016], [1.0, 0.002]],
            Self::Petal => &[
                [0.12, 0.035],
                [0.3, 0.12],
                [0.5, 0.22],
                [0.68, 0.29],
                [0.83, 0.3],
                [0.94, 0.23],
                [1.0, 0.11],
                [0.95, 0.012],
            ],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leaves_are_simple_outlines_of_length_one() {
        for outline in Outline::ALL {
            let Some(corners) = outline.leaf() else { continue };
            let corners: Vec<[f64; 2]> = corners.collect();
            assert_eq!(corners.len() as u32, outline.sides(), "{outline:?}");
            assert!(corners.len() <= 64);
            let far = corners.iter().map(|corner| corner[0]).fold(0.0, f64::max);
            assert!((far - 1.0).abs() < 1e-12, "{outline:?}");
            // No two sides cross, and the outline goes counter-clockwise.
            let side = |at: usize| [corners[at], corners[(at + 1) % corners.len()]];
            let turn =
                |a: [f64; 2], b: [f64; 2], c: [f64; 2]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            let area: f64 = (0..corners.len()).map(|at| turn([0.0; 2], side(at)[0], side(at)[1]) / 2.0).sum();
            assert!(area > 0.01, "{outline:?}: {area}");
            for first in 0..corners.len() {
                for second in first + 2..corners.len() {
                    if first == 0 && second + 1 == corners.len() {
                        continue;
                    }
                    let ([a, b], [c, d]) = (side(first), side(second));
                    let crosses = turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0;
                    assert!(!crosses, "{outline:?}: {first} {second}");
                }
            }
        }
    }
}
