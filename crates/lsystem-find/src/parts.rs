//! The parts of a picture that belong to its drawing: no frame around it, no caption, no specks.

/// The largest gap, in pixels, between two runs of ink of the same part. Thin lines may have gaps.
const GAP: u32 = 2;
/// The least share of a frame's ink that lies near the sides of the frame's box.
const FRAME: f64 = 0.9;
/// The width of a frame, as a part of its box.
const FRAME_WIDTH: f64 = 0.02;
/// The smallest sides of a frame, in pixels.
const SMALLEST_FRAME: u32 = 40;
/// Parts beside the largest one are left out if they have less than this part of its ink.
const SMALL: f64 = 0.02;
/// Parts beside the largest one on a photographed page are left out if their box has less than this part of its area.
const SMALL_BOX: f64 = 0.25;
/// The most pixels of a speck, if the largest part has at least a thousand times as many.
const SPECK: u32 = 6;
/// The most runs of ink, at 40 bytes each. Drawings of lines have fewer: a thousand in each of 4,000 rows.
const MAX_RUNS: usize = 1 << 22;

/// Ink side by side in one row of pixels, from `left` to before `right`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Run {
    pub(crate) y: u32,
    pub(crate) left: u32,
    pub(crate) right: u32,
}

/// Ink that hangs together.
#[derive(Clone, Copy, Debug)]
struct Part {
    ink: u32,
    left: u32,
    top: u32,
    right: u32,
    bottom: u32,
    /// The ink near the sides of its box.
    at_sides: u32,
}

impl Part {
    fn area(&self) -> u64 {
        u64::from(self.right.saturating_sub(self.left)) * u64::from(self.bottom.saturating_sub(self.top))
    }
}

/// The runs of ink that belong to the drawing; `None` if there are more than [`MAX_RUNS`] or if a side has more than
/// 2^32 - 1 pixels. On a page, the drawing is the largest piece of ink: words stand beside it.
pub(crate) fn drawing(
    width: usize,
    height: usize,
    is_page: bool,
    is_ink: impl Fn(usize, usize) -> bool,
) -> Option<Vec<Run>> {
    let size = [width, height].map(u32::try_from);
    let [Ok(width), Ok(height)] = size else { return None };
    let runs = runs(width, height, is_ink)?;
    let owners = joined(&runs, height as usize);
    let empty = Part { ink: 0, left: u32::MAX, top: u32::MAX, right: 0, bottom: 0, at_sides: 0 };
    let mut parts = vec![empty; runs.len()];
    for (run, &owner) in runs.iter().zip(&owners) {
        let part = &mut parts[owner as usize];
        part.ink += run.right - run.left;
        (part.left, part.right) = (part.left.min(run.left), part.right.max(run.right));
        (part.top, part.bottom) = (part.top.min(run.y), part.bottom.max(run.y + 1));
    }
    for (run, &owner) in runs.iter().zip(&owners) {
        let part = &mut parts[owner as usize];
        let wide = ((f64::from(part.right - part.left) * FRAME_WIDTH) as u32).max(3);
        let high = ((f64::from(part.bottom - part.top) * FRAME_WIDTH) as u32).max(3);
        let is_at_side = run.y < part.top + high || run.y + high >= part.bottom;
        let inner = run.right.min(part.right.saturating_sub(wide)).saturating_sub(run.left.max(part.left + wide));
        part.at_sides += run.right - run.left - if is_at_side { 0 } else { inner };
    }
    let is_frame = |part: &Part| {
        let is_large = part.ink > 0 && (part.right - part.left).min(part.bottom - part.top) > SMALLEST_FRAME;
        is_large && f64::from(part.at_sides) >= f64::from(part.ink) * FRAME
    };
    let size = |part: &&Part| if is_page { part.area() } else { u64::from(part.ink) };
    let Some(largest) = parts.iter().filter(|part| part.ink > 0 && !is_frame(part)).max_by_key(size).copied() else {
        return Some(runs);
    };
    // A drawing that is a frame itself, such as a square, has nothing of its size inside.
    let whole: u64 = parts.iter().map(|part| size(&part)).sum();
    if (size(&&largest) as f64) < whole as f64 * 0.1 {
        return Some(runs);
    }
    let is_kept = |part: &Part| {
        let is_beside = part.right < largest.left
            || part.left > largest.right
            || part.bottom < largest.top
            || part.top > largest.bottom;
        let is_small = f64::from(part.ink) < f64::from(largest.ink) * SMALL
            || is_page && (part.area() as f64) < largest.area() as f64 * SMALL_BOX;
        let is_speck = part.ink <= SPECK && largest.ink >= 1000 * part.ink;
        !(is_frame(part) || is_speck || is_beside && is_small)
    };
    let kept = runs.iter().zip(&owners).filter(|(_, owner)| is_kept(&parts[**owner as usize]));
    Some(kept.map(|(run, _)| *run).collect())
}

fn runs(width: u32, height: u32, is_ink: impl Fn(usize, usize) -> bool) -> Option<Vec<Run>> {
    let is_ink = |x: u32, y: u32| is_ink(x as usize, y as usize);
    let mut runs = Vec::new();
    for y in 0..height {
        let mut x = 0;
        while x < width {
            if !is_ink(x, y) {
                x += 1;
                continue;
            }
            let left = x;
            while x < width && is_ink(x, y) {
                x += 1;
            }
            if runs.len() == MAX_RUNS {
                return None;
            }
            runs.push(Run { y, left, right: x });
        }
    }
    Some(runs)
}

/// For each run the first run of its part.
fn joined(runs: &[Run], height: usize) -> Vec<u32> {
    let mut owners: Vec<u32> = (0..runs.len() as u32).collect();
    let mut rows = vec![runs.len(); height + 1];
    (0..runs.len()).rev().for_each(|at| rows[runs[at].y as usize] = at);
    // Rows without runs begin where the next row does.
    (0..height).rev().for_each(|y| rows[y] = rows[y].min(rows[y + 1]));
    for (at, run) in runs.iter().enumerate() {
        for y in (run.y.saturating_sub(GAP)..=run.y).map(|y| y as usize) {
            let end = rows[y + 1].min(at);
            let row = &runs[rows[y].min(end)..end];
            let first = rows[y].min(end) + row.partition_point(|other| other.right + GAP < run.left);
            let near = runs[first..end].iter().take_while(|other| other.left <= run.right + GAP);
            for other in first..first + near.count() {
                let (a, b) = (root(&mut owners, at), root(&mut owners, other));
                owners[a.max(b)] = a.min(b) as u32;
            }
        }
    }
    (0..runs.len()).map(|at| root(&mut owners, at) as u32).collect()
}

/// The first run of the part, with a shorter way there from now on.
fn root(owners: &mut [u32], mut at: usize) -> usize {
    while owners[at] as usize != at {
        owners[at] = owners[owners[at] as usize];
        at = owners[at] as usize;
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_a_caption_and_specks_are_left_out() {
        let mut ink = vec![false; 200 * 200];
        let mut put = |x: usize, y: usize| ink[y * 200 + x] = true;
        for at in 5..195 {
            [(at, 5), (at, 194), (5, at), (194, at)].into_iter().for_each(|(x, y)| put(x, y));
        }
        // The drawing: two crossing lines, one with a gap.
        for at in 40..140 {
            [at, at + 1].into_iter().filter(|x| *x != 90).for_each(|x| put(x, at));
            (0..12).for_each(|wide| put(at + wide.min(1), 180 - at));
        }
        (60..63).for_each(|x| put(x, 170));
        let count = |ink: &[bool]| {
            let runs = drawing(200, 200, false, |x, y| ink[y * 200 + x]).unwrap();
            (runs.iter().map(|run| run.right - run.left).sum::<u32>(), runs.iter().all(|run| run.y < 150))
        };
        let (own, is_alone) = count(&ink);
        assert!(is_alone && (350..420).contains(&own), "{own}");
        // A square is a drawing if nothing else is there.
        let square: Vec<bool> = (0..200 * 200)
            .map(|at| {
                let (x, y) = (at % 200, at / 200);
                (50..150).contains(&x) && (50..150).contains(&y) && ([50, 149].contains(&x) || [50, 149].contains(&y))
            })
            .collect();
        assert_eq!(count(&square).0, 396);
    }

    #[test]
    fn on_a_page_the_words_beside_the_largest_piece_are_left_out() {
        // A zigzag with bars for lines of words above and below it, which have more ink.
        let zigzag = |x: usize, y: usize| (100..300).contains(&x) && (y == 100 + (x % 100).abs_diff(50));
        let is_bar = |x: usize, y: usize| {
            (60..340).contains(&x) && [30, 45, 200, 215].iter().any(|top| (*top..top + 8).contains(&y))
        };
        for (is_page, rows) in [(true, 100..151), (false, 30..223)] {
            let runs = drawing(400, 260, is_page, |x, y| zigzag(x, y) || is_bar(x, y)).unwrap();
            let (top, bottom) = (runs.iter().map(|run| run.y).min(), runs.iter().map(|run| run.y + 1).max());
            assert_eq!((top, bottom), (Some(rows.start), Some(rows.end)));
        }
        // Two pieces of one size are one drawing.
        let twins = drawing(400, 260, true, |x, y| zigzag(x, y) || zigzag(x, y.wrapping_sub(90))).unwrap();
        assert!(twins.iter().any(|run| run.y > 190));
    }

    #[test]
    fn no_more_runs_are_held_than_drawings_have() {
        assert!(drawing(8000, 8000, false, |x, _| x % 2 == 0).is_none());
        assert_eq!(drawing(2000, 100, false, |x, _| x % 2 == 0).map(|runs| runs.len()), Some(100_000));
    }
}
