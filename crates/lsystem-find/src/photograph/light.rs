//! Even light: each pixel beside the paper around it.

/// The half side of the neighbourhood of a pixel, as a part of the longer side of the picture: wider than a line, and
/// narrower than a shadow.
const NEAR: usize = 32;
/// How often the level of the paper is told anew, from what is nearer to it than to the ink.
const ROUNDS: usize = 2;

/// Levels of grey, row by row from above.
#[derive(Clone, Debug)]
pub(super) struct Grey {
    pub(super) levels: Vec<u8>,
    pub(super) width: usize,
    pub(super) height: usize,
}

impl Grey {
    /// The picture on fewer pixels: each is the mean of a square of `by` times `by`.
    pub(super) fn smaller(&self, by: usize) -> Self {
        let (width, height) = (self.width / by, self.height / by);
        let mean = |at: usize| {
            let (left, top) = (at % width * by, at / width * by);
            let row = |y: usize| &self.levels[y * self.width + left..y * self.width + left + by];
            let sum: usize = (top..top + by).flat_map(row).map(|&level| usize::from(level)).sum();
            (sum / (by * by)) as u8
        };
        Self { levels: (0..width * height).map(mean).collect(), width, height }
    }

    pub(super) fn inverted(mut self) -> Self {
        self.levels.iter_mut().for_each(|level| *level = 255 - *level);
        self
    }

    /// The level at a place between the middles of pixels; the outermost pixels go on outside.
    pub(super) fn at(&self, x: f64, y: f64) -> f64 {
        let inside = |at: f64, side: usize| (at - 0.5).clamp(0.0, side.saturating_sub(1) as f64);
        let (x, y) = (inside(x, self.width), inside(y, self.height));
        let (left, top) = (x as usize, y as usize);
        let (right, below) = ((left + 1).min(self.width - 1), (top + 1).min(self.height - 1));
        let level = |x: usize, y: usize| f64::from(self.levels[y * self.width + x]);
        let (across, down) = (x - left as f64, y - top as f64);
        let mixed = |a: f64, b: f64, part: f64| a + (b - a) * part;
        mixed(
            mixed(level(left, top), level(right, top), across),
            mixed(level(left, below), level(right, below), across),
            down,
        )
    }
}

/// Sums over rectangles in the same time for any size (Crow, "Summed-area tables for texture mapping", 1984).
struct Sums {
    sums: Vec<u32>,
    counts: Vec<u32>,
    width: usize,
    height: usize,
}

impl Sums {
    /// The sums of those pixels that are counted.
    fn of(grey: &Grey, is_counted: impl Fn(usize, u8) -> bool) -> Self {
        let row = grey.width + 1;
        let (mut sums, mut counts) = (vec![0_u32; row * (grey.height + 1)], vec![0_u32; row * (grey.height + 1)]);
        for y in 0..grey.height {
            let (mut sum, mut count) = (0, 0);
            for x in 0..grey.width {
                let at = y * grey.width + x;
                if is_counted(at, grey.levels[at]) {
                    sum += u32::from(grey.levels[at]);
                    count += 1;
                }
                let to = (y + 1) * row + x + 1;
                // Differences of sums are right where the sums themselves overflow.
                sums[to] = sums[to - row].wrapping_add(sum);
                counts[to] = counts[to - row].wrapping_add(count);
            }
        }
        Self { sums, counts, width: grey.width, height: grey.height }
    }

    /// The mean of the counted pixels that are at most `far` from a pixel each way.
    fn mean(&self, at: usize, far: usize) -> Option<f32> {
        let (x, y) = (at % self.width, at / self.width);
        let row = self.width + 1;
        let (left, right) = (x.saturating_sub(far), (x + far + 1).min(self.width));
        let (top, below) = (y.saturating_sub(far) * row, (y + far + 1).min(self.height) * row);
        let within = |of: &[u32]| {
            of[below + right].wrapping_sub(of[below + left]).wrapping_sub(of[top + right]).wrapping_add(of[top + left])
        };
        let count = within(&self.counts);
        (count > 0).then(|| within(&self.sums) as f32 / count as f32)
    }
}

/// Whether the lines are lighter than what is around them: fewer pixels, which differ more from their neighbourhood, so
/// that the third moment of the differences tells.
pub(super) fn is_light_on_dark(grey: &Grey) -> bool {
    let (far, sums) = (near(grey), Sums::of(grey, |_, _| true));
    let off = |at: usize| f64::from(f32::from(grey.levels[at]) - sums.mean(at, far).unwrap_or_default());
    (0..grey.levels.len()).map(|at| off(at) * off(at) * off(at)).sum::<f64>() > 0.0
}

/// Dark lines as parts of the paper around them: paper is white, however much light falls on it. The paper's level is the
/// mean of what is lighter than the middle between the lighter and the darker pixels of a neighbourhood.
pub(super) fn evened(grey: &Grey) -> Grey {
    let far = near(grey);
    let all = Sums::of(grey, |_, _| true);
    let mut middles: Vec<f32> = (0..grey.levels.len()).map(|at| all.mean(at, far).unwrap_or_default()).collect();
    let mut paper = middles.clone();
    for _ in 0..ROUNDS {
        let light = Sums::of(grey, |at, level| f32::from(level) >= middles[at]);
        let dark = Sums::of(grey, |at, level| f32::from(level) < middles[at]);
        for at in 0..grey.levels.len() {
            paper[at] = light.mean(at, far).unwrap_or(paper[at]);
            middles[at] = (paper[at] + dark.mean(at, far).unwrap_or(paper[at])) / 2.0;
        }
    }
    let part = |(&level, paper): (&u8, &f32)| (f32::from(level) / paper.max(1.0) * 255.0).min(255.0) as u8;
    Grey { levels: grey.levels.iter().zip(&paper).map(part).collect(), ..*grey }
}

fn near(grey: &Grey) -> usize {
    (grey.width.max(grey.height) / NEAR).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture with levels by chance.
    fn speckled(width: usize, height: usize) -> Grey {
        let mut state = 7_u32;
        let mut level = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 24) as u8
        };
        Grey { levels: (0..width * height).map(|_| level()).collect(), width, height }
    }

    #[test]
    fn means_are_those_of_all_pixels_nearby() {
        let grey = speckled(23, 17);
        let is_counted = |level: u8| level > 90;
        let sums = Sums::of(&grey, |_, level| is_counted(level));
        for (at, far) in (0_usize..23 * 17).flat_map(|at| [0, 1, 4, 40].map(|far| (at, far))) {
            let near = (0_usize..23 * 17)
                .filter(|other| (other % 23).abs_diff(at % 23) <= far && (other / 23).abs_diff(at / 23) <= far);
            let near: Vec<u32> =
                near.filter(|&at| is_counted(grey.levels[at])).map(|at| u32::from(grey.levels[at])).collect();
            let mean = (!near.is_empty()).then(|| near.iter().sum::<u32>() as f32 / near.len() as f32);
            assert_eq!(sums.mean(at, far), mean, "{at} {far}");
        }
    }

    #[test]
    fn paper_is_white_in_any_light() {
        // Lines of half the paper's light, which falls off to a third.
        let (width, height) = (320, 200);
        let is_ink = |at: usize| at % width % 40 < 3;
        let level = |at: usize| {
            let light = 240.0 - 160.0 * (at % width) as f64 / width as f64;
            (light * if is_ink(at) { 0.5 } else { 1.0 }) as u8
        };
        let grey = Grey { levels: (0..width * height).map(level).collect(), width, height };
        assert!(!is_light_on_dark(&grey) && is_light_on_dark(&grey.clone().inverted()));
        for (at, &level) in evened(&grey).levels.iter().enumerate() {
            assert!(if is_ink(at) { level < 160 } else { level > 215 }, "{at} {level}");
        }
    }
}
