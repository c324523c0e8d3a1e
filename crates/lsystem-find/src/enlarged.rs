//! A small picture, enlarged: the greys of its soft edges tell places that are finer than its pixels.

/// The places before and after a pixel that its value depends on.
const REACH: isize = 2;

/// A picture of `width` times `height` levels, `factor` times as large, by cubic convolution (Keys, "Cubic convolution
/// interpolation for digital image processing", 1981). Beyond its sides it goes on as there.
pub(crate) fn enlarged(levels: &[f32], [width, height]: [usize; 2], factor: f64) -> (Vec<f32>, [usize; 2]) {
    let large = |side: usize| ((side as f64 * factor).round() as usize).max(1);
    let size = [large(width), large(height)];
    let (columns, rows) = (kernels(width, size[0]), kernels(height, size[1]));
    let sum = |kernel: &[(usize, f32)], level: &dyn Fn(usize) -> f32| {
        kernel.iter().map(|&(at, weight)| weight * level(at)).sum::<f32>()
    };
    let wide: Vec<f32> =
        levels.chunks(width).flat_map(|row| columns.iter().map(move |kernel| sum(kernel, &|at| row[at]))).collect();
    let of_row = |kernel: &Vec<(usize, f32)>| {
        (0..size[0]).map(|x| sum(kernel, &|at| wide[at * size[0] + x])).collect::<Vec<f32>>()
    };
    (rows.iter().flat_map(of_row).collect(), size)
}

/// For each new place along a side, the old places that it depends on, with their weights.
fn kernels(old: usize, new: usize) -> Vec<Vec<(usize, f32)>> {
    let kernel = |at: usize| {
        let place = (at as f64 + 0.5) * old as f64 / new as f64 - 0.5;
        let first = place.floor() as isize + 1 - REACH;
        let inside = |at: isize| at.clamp(0, old as isize - 1) as usize;
        (first..first + 2 * REACH).map(|at| (inside(at), weight((place - at as f64).abs()) as f32)).collect()
    };
    (0..new).map(kernel).collect()
}

/// The weight of a place so far away.
fn weight(far: f64) -> f64 {
    match far {
        far if far < 1.0 => (1.5 * far - 2.5) * far * far + 1.0,
        far if far < 2.0 => ((-0.5 * far + 2.5) * far - 4.0) * far + 2.0,
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_stay_straight() {
        let (width, height) = (7, 5);
        let levels: Vec<f32> = (0..width * height).map(|at| (3 * (at % width) + 2 * (at / width)) as f32).collect();
        let (large, size) = enlarged(&levels, [width, height], 3.0);
        assert_eq!(size, [21, 15]);
        for (x, y) in (6..15).flat_map(|x| (6..9).map(move |y| (x, y))) {
            let [u, v] = [x, y].map(|at| (at as f32 + 0.5) / 3.0 - 0.5);
            assert!((large[y * 21 + x] - 3.0 * u - 2.0 * v).abs() < 1e-4, "{x} {y}");
        }
        // The pixels' own places keep their levels.
        assert_eq!(enlarged(&levels, [width, height], 1.0), (levels, [width, height]));
        assert!(enlarged(&[4.0], [1, 1], 2.5).0.iter().all(|level| (level - 4.0).abs() < 1e-5));
    }
}
