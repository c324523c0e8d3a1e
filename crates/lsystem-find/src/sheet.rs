//! The ink of a picture at a finer resolution than that of the mask: here twigs show that the mask does not resolve.

use crate::brush::{PIXELS, for_runs};
use lsystem_render::mask::put_run;

/// The pixels around the ink of a mask.
pub(crate) const MARGIN: usize = 4;
/// The longer side is at most this many pixels, so that a sheet has at most 512 KiB.
pub(crate) const MAX: usize = 2048;
/// One in this many pixels of ink lies on a line of at most the usual width.
const USUAL: usize = 3;
/// The least distance, in pixels, by which a stroke may lie beside the ink: half a pixel for the fit, and half for the
/// places of pixels.
const OFF: f64 = 1.0;
/// The changes of the place and the size, in pixels, by which strokes are moved onto the ink.
const CHANGES: [f64; 4] = [2.0, 1.0, 0.5, 0.25];
/// The most times that each change is applied while it improves the place.
const MAX_ROUNDS: usize = 4;

/// The ink of a picture, one bit a pixel.
#[derive(Clone, Debug)]
pub(crate) struct Sheet {
    width: usize,
    height: usize,
    /// The words of a row.
    row: usize,
    bits: Vec<u64>,
    /// The pixels of the sheet for one pixel of the mask.
    scale: f64,
    /// Half the usual width of a line, in pixels.
    stroke: f64,
}

/// A change of strokes that are laid on a sheet: around the middle of the sheet, and then to the right and down.
#[derive(Clone, Copy, Debug)]
struct Shift {
    grown: f64,
    x: f64,
    y: f64,
}

impl Sheet {
    /// A sheet without ink; its sides are at most [`MAX`]. `scale` is the number of its pixels for one pixel of the mask.
    pub(crate) fn new(width: usize, height: usize, scale: f64) -> Self {
        let row = width.div_ceil(64);
        Self { width, height, row, bits: vec![0; row * height], scale, stroke: 0.5 }
    }

    /// Gives the pixel ink, if it is on the sheet.
    pub(crate) fn put(&mut self, x: usize, y: usize) {
        if x < self.width && y < self.height {
            self.bits[y * self.row + x / 64] |= 1 << (x % 64);
        }
    }

    /// Gives a stroke ink, given in pixels of the sheet.
    pub(crate) fn put_stroke(&mut self, stroke: [[f64; 2]; 2], reach: f64) {
        let row = self.row;
        for_runs([self.width, self.height], stroke, reach, |y, first, last| {
            put_run(&mut self.bits[y * row..(y + 1) * row], first, last);
        });
    }

    /// The sheet whose ink is complete: the width of its lines is measured.
    pub(crate) fn finished(mut self) -> Self {
        self.stroke = half_width(self.width, self.height, |x, y| self.has(x, y));
        self
    }

    fn has(&self, x: usize, y: usize) -> bool {
        self.bits[y * self.row + x / 64] >> (x % 64) & 1 == 1
    }

    /// The work of [`Sheet::agrees`], in systems that are unlike the picture.
    pub(crate) fn work(&self) -> u64 {
        (self.width * self.height) as u64 / PIXELS
    }

    /// Whether strokes, given in pixels of the mask, are the skeleton of the ink: all of them lie on the ink or at most
    /// half a stroke width beside it, and no ink is further from them than a stroke width. So nothing is left over on
    /// either side.
    pub(crate) fn agrees(&self, strokes: impl Iterator<Item = [[f64; 2]; 2]>) -> bool {
        let place = |[x, y]: [f64; 2]| [(x - MARGIN as f64) * self.scale, (y - MARGIN as f64) * self.scale];
        let strokes: Vec<[[f64; 2]; 2]> = strokes.map(|ends| ends.map(place)).collect();
        if strokes.iter().flatten().flatten().any(|at| !at.is_finite()) {
            return false;
        }
        let Some(shift) = self.laid(&strokes) else { return false };
        let mut reached = Self::new(self.width, self.height, self.scale);
        let reach = (2.0 * self.stroke).max(self.stroke + OFF);
        strokes.iter().for_each(|ends| reached.put_stroke(ends.map(|at| self.shifted(at, shift)), reach));
        self.bits.iter().zip(&reached.bits).all(|(ink, reached)| ink & !reached == 0)
    }

    /// The change that lays all strokes on the ink, if there is one.
    fn laid(&self, strokes: &[[[f64; 2]; 2]]) -> Option<Shift> {
        let mut best = Shift { grown: 0.0, x: 0.0, y: 0.0 };
        let mut least = self.beside(strokes, best, usize::MAX);
        let size = self.width.max(self.height) as f64 / 2.0;
        for change in CHANGES {
            for _ in 0..MAX_ROUNDS {
                let before = least;
                for by in [change, -change] {
                    let near = [
                        Shift { x: best.x + by, ..best },
                        Shift { y: best.y + by, ..best },
                        Shift { grown: best.grown + by / size, ..best },
                    ];
                    for shift in near {
                        if least == 0 {
                            return Some(best);
                        }
                        let beside = self.beside(strokes, shift, least);
                        if beside < least {
                            (best, least) = (shift, beside);
                        }
                    }
                }
                if least == before {
                    break;
                }
            }
        }
        (least == 0).then_some(best)
    }

    fn shifted(&self, [x, y]: [f64; 2], shift: Shift) -> [f64; 2] {
        let middle = [self.width as f64 / 2.0, self.height as f64 / 2.0];
        [x + (x - middle[0]) * shift.grown + shift.x, y + (y - middle[1]) * shift.grown + shift.y]
    }

    /// How many places of the strokes, a pixel apart, lie further beside the ink than half a stroke width; counted up to
    /// `most`.
    fn beside(&self, strokes: &[[[f64; 2]; 2]], shift: Shift, most: usize) -> usize {
        let reach = self.stroke.max(OFF);
        let mut beside = 0;
        for ends in strokes {
            let [[x1, y1], [x2, y2]] = ends.map(|at| self.shifted(at, shift));
            // A stroke that is longer than both sides leaves the sheet at once.
            let steps = libm::hypot(x2 - x1, y2 - y1).ceil().clamp(1.0, 2.0 * MAX as f64);
            for step in 0..=steps as usize {
                let along = step as f64 / steps;
                let at = [x1 + (x2 - x1) * along, y1 + (y2 - y1) * along];
                beside += usize::from(!self.is_near(at, reach));
                if beside >= most {
                    return beside;
                }
            }
        }
        beside
    }

    /// Whether a pixel of ink has its centre within `reach` of a place, or the place lies in it.
    fn is_near(&self, [x, y]: [f64; 2], reach: f64) -> bool {
        let on = |x: f64, y: f64| {
            x >= 0.0 && y >= 0.0 && x < self.width as f64 && y < self.height as f64 && self.has(x as usize, y as usize)
        };
        if on(x, y) {
            return true;
        }
        let far = reach.ceil() as i32;
        (-far..=far).any(|dy| {
            (-far..=far).any(|dx| {
                let centre = [x.floor() + f64::from(dx) + 0.5, y.floor() + f64::from(dy) + 0.5];
                on(centre[0], centre[1]) && libm::hypot(centre[0] - x, centre[1] - y) <= reach
            })
        })
    }
}

/// Half the usual width of a line: where lines are apart, the shorter run of ink through a pixel is the line's width.
pub(crate) fn half_width(width: usize, height: usize, has: impl Fn(usize, usize) -> bool) -> f64 {
    let mut runs = vec![0_u16; width * height];
    for y in 0..height {
        let mut x = 0;
        while x < width {
            let run = (x..width).take_while(|&x| has(x, y)).count();
            runs[y * width + x..y * width + x + run].fill(run.min(usize::from(u16::MAX)) as u16);
            x += run + 1;
        }
    }
    let mut counts = vec![0_usize; width.max(height) + 1];
    for x in 0..width {
        let mut y = 0;
        while y < height {
            let run = (y..height).take_while(|&y| has(x, y)).count();
            for y in y..y + run {
                counts[run.min(usize::from(runs[y * width + x]))] += 1;
            }
            y += run + 1;
        }
    }
    let all: usize = counts.iter().sum();
    let mut left = all / USUAL;
    for (run, &count) in counts.iter().enumerate().skip(1) {
        if left < count {
            return run as f64 / 2.0;
        }
        left -= count;
    }
    0.5
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The shorter run through each pixel, one after the other.
    fn naive_half_width(sheet: &Sheet) -> f64 {
        let run = |x: usize, y: usize, across: bool| {
            let side = if across { sheet.width } else { sheet.height };
            let inked = |at: &usize| if across { sheet.has(*at, y) } else { sheet.has(x, *at) };
            let at = if across { x } else { y };
            (at..side).take_while(inked).count() + (0..at).rev().take_while(inked).count()
        };
        let places = (0..sheet.width * sheet.height).map(|at| (at % sheet.width, at / sheet.width));
        let inked = places.filter(|&(x, y)| sheet.has(x, y));
        let mut widths: Vec<usize> = inked.map(|(x, y)| run(x, y, true).min(run(x, y, false))).collect();
        widths.sort_unstable();
        widths.get(widths.len() / USUAL).map_or(0.5, |&width| width as f64 / 2.0)
    }

    fn sheet(strokes: &[[[f64; 2]; 2]], reach: f64) -> Sheet {
        let mut sheet = Sheet::new(300, 200, 1.0);
        strokes.iter().for_each(|ends| sheet.put_stroke(*ends, reach));
        sheet.finished()
    }

    #[test]
    fn the_usual_width_is_that_of_the_runs() {
        let strokes = [[[10.0, 20.0], [280.0, 30.0]], [[30.0, 180.0], [200.0, 25.0]], [[9.0, 9.0], [9.0, 190.0]]];
        for reach in [0.5, 1.0, 2.5, 7.0] {
            let sheet = sheet(&strokes, reach);
            assert_eq!(sheet.stroke, naive_half_width(&sheet), "{reach}");
        }
        assert_eq!(Sheet::new(9, 9, 1.0).finished().stroke, 0.5);
        assert_eq!(Sheet::new(0, 0, 1.0).finished().stroke, 0.5);
    }

    #[test]
    fn nothing_may_be_left_over_on_either_side() {
        let plant = [[[150.0, 190.0], [150.0, 10.0]], [[150.0, 100.0], [60.0, 40.0]], [[150.0, 60.0], [240.0, 20.0]]];
        let of_mask = |strokes: &[[[f64; 2]; 2]], by: f64| {
            let moved = |[x, y]: [f64; 2]| [x + MARGIN as f64 + by, y + MARGIN as f64];
            strokes.iter().map(|ends| ends.map(moved)).collect::<Vec<_>>()
        };
        for reach in [1.0, 1.5, 3.0] {
            let sheet = sheet(&plant, reach);
            for by in [0.0, 0.4, -1.5] {
                assert!(sheet.agrees(of_mask(&plant, by).into_iter()), "{reach} {by}");
            }
            // A twig is missing; one is curled by more than a stroke width; one is too many.
            let twig = |x: f64, y: f64| [[60.0, 40.0], [60.0 + x, 40.0 + y]];
            let far = 3.0 * reach + 3.0;
            assert!(!sheet.agrees(of_mask(&plant[..2], 0.0).into_iter()), "{reach}");
            for twig in [twig(0.0, -far), twig(-far, 0.0), twig(far, -far)] {
                let all: Vec<_> = plant.iter().copied().chain([twig]).collect();
                assert!(!sheet.agrees(of_mask(&all, 0.0).into_iter()), "{reach} {twig:?}");
            }
        }
        assert!(!sheet(&plant, 1.0).agrees([[[f64::NAN, 0.0], [f64::INFINITY, 9.0]]].into_iter()));
    }
}
