//! The shape of a drawing in a few numbers, to know it again.

use std::sync::LazyLock;

/// The shapes of the gallery's drawings in the plane, a line each, sorted. `tests/gallery.rs` writes the file.
static GALLERY: LazyLock<Vec<Moments>> =
    LazyLock::new(|| include_str!("gallery.txt").lines().filter_map(Moments::read).collect());

/// The number of segments, and the moments of their middles about their centre: numbers that stay as they are when a
/// drawing is turned, mirrored, moved or scaled. Drawings that differ hardly ever agree in all of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments {
    /// Segments.
    pub count: usize,
    /// The mean square of the distance from the centre, in squares of the mean length of segments.
    pub spread: f64,
    /// The mean fourth power of the distance, in squares of the mean square.
    pub tail: f64,
}

impl Moments {
    /// The shape of lines, at least one of which has a length.
    #[must_use]
    pub fn of(lines: &[[[f64; 2]; 2]]) -> Self {
        let count = lines.len().max(1) as f64;
        let middles = || lines.iter().map(|[a, b]| [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]);
        let centre = [0, 1].map(|i| middles().map(|middle| middle[i]).sum::<f64>() / count);
        let square = |[x, y]: [f64; 2]| (x - centre[0]) * (x - centre[0]) + (y - centre[1]) * (y - centre[1]);
        let mean = middles().map(square).sum::<f64>() / count;
        let fourth = middles().map(|middle| square(middle) * square(middle)).sum::<f64>() / count;
        let length = lines.iter().map(|[a, b]| libm::hypot(b[0] - a[0], b[1] - a[1])).sum::<f64>() / count;
        Self { count: lines.len(), spread: mean / (length * length), tail: fourth / (mean * mean) }
    }

    /// Whether both are shapes of one drawing.
    #[must_use]
    pub fn is_like(&self, other: &Self) -> bool {
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-3 * a.abs().max(b.abs());
        self.count == other.count && near(self.spread, other.spread) && near(self.tail, other.tail)
    }

    /// Whether the gallery has such a drawing.
    pub(crate) fn is_in_gallery(&self) -> bool {
        let from = GALLERY.partition_point(|known| known.count < self.count);
        GALLERY[from..].iter().take_while(|known| known.count == self.count).any(|known| known.is_like(self))
    }

    /// As a line of text: the numbers, divided by spaces.
    #[must_use]
    pub fn line(&self) -> String {
        format!("{} {:.6e} {:.6}\n", self.count, self.spread, self.tail)
    }

    fn read(line: &str) -> Option<Self> {
        let mut words = line.split(' ');
        let count = words.next()?.parse().ok()?;
        let (spread, tail) = (words.next()?.parse().ok()?, words.next()?.parse().ok()?);
        Some(Self { count, spread, tail })
    }
}
