//! The pictures as a visitor may have them: clean, blurred, noisy, compressed, in a frame.

use crate::cases::Case;
use lsystem_base::{Limits, Progress};
use lsystem_drawing::{Plane, System, draw};
use lsystem_find::Picture;
use lsystem_render::{Detail, Renderer, View, Viewport};
use lsystem_syntax::{Colour, ColourBy, Definition, Ink, Style};
use std::sync::Arc;

/// Levels of grey, with the width and the height.
type Grey = (Vec<u8>, usize, usize);

/// The picture of a case.
pub(crate) fn picture(case: &Case, input: &str) -> Result<Picture, &'static str> {
    let definition = match &case.lines {
        Some(lines) if !lines.is_empty() => polyline(lines),
        _ => case.definition.clone(),
    };
    let side = match input {
        "small" => 256,
        "large" => 1400,
        _ => 700,
    };
    let (grey, width, height) = rendered(&definition, side)?;
    let (grey, width, height) = match input {
        "blur" => (blurred(&grey, width, height), width, height),
        "noise" => (noisy(&grey), width, height),
        "jpeg" => (compressed(&grey, width, height), width, height),
        "frame" => framed(&grey, width, height),
        "light" => (grey.iter().map(|at| 255 - at).collect(), width, height),
        _ => (grey, width, height),
    };
    Picture::new(&grey, width, height)
}

/// The picture of a definition, `side` pixels wide and high.
pub(crate) fn clean(definition: &Definition, side: usize) -> Result<Picture, &'static str> {
    let (grey, width, height) = rendered(definition, side)?;
    Picture::new(&grey, width, height)
}

/// A system whose first generation is these lines, each drawn from the origin.
fn polyline(lines: &[[f64; 4]]) -> Definition {
    let line = |[x, y, u, v]: &[f64; 4]| {
        let (far, length) = (libm::hypot(*x, *y), libm::hypot(u - x, v - y));
        let (to, along) = (libm::atan2(*y, *x).to_degrees(), libm::atan2(v - y, u - x).to_degrees());
        format!("[+({to:.6})f({far:.6})-({to:.6})+({along:.6})F({length:.6})]")
    };
    let axiom = lines.iter().map(line).collect();
    Definition { axiom, heading: 0.0, iterations: 0, ..Definition::default() }
}

fn rendered(definition: &Definition, side: usize) -> Result<Grey, &'static str> {
    // Lines of one width, as pictures of textbooks have.
    let mut thin = definition.clone();
    (thin.style.width, thin.style.width_factor) = (0.0, 1.0);
    let system = System::new(&thin).ok().ok_or("the system is wrong")?;
    let limits = Limits::default();
    let drawing = draw::<Plane>(&system, definition.iterations, &limits).map_err(|_| "the drawing is too large")?;
    let mut renderer = Renderer::light();
    renderer.load(Arc::new(drawing));
    let style = Style {
        palette: vec![Colour { rgb: [0; 3] }],
        background: Colour { rgb: [255; 3] },
        colour_by: ColourBy::Single,
        ink: Ink::Solid,
        min_width: 1.5,
        width: 0.0,
        hue: 0.0,
        ..Style::default()
    };
    let viewport = Viewport { width: side as u32, height: side as u32, ratio: 1.0 };
    renderer.begin_with(&style, viewport, View::default(), Detail::Fine, None);
    while renderer.step(usize::MAX) == Progress::More {}
    Ok((renderer.pixels().chunks_exact(4).map(|pixel| pixel[0]).collect(), side, side))
}

/// The mean of three times three pixels, twice.
fn blurred(grey: &[u8], width: usize, height: usize) -> Vec<u8> {
    (0..2).fold(grey.to_vec(), |from, _| {
        let mean = |at: usize| {
            let (x, y) = (at % width, at / width);
            let rows = y.saturating_sub(1)..=(y + 1).min(height - 1);
            let (mut sum, mut count) = (0, 0);
            for y in rows {
                for x in x.saturating_sub(1)..=(x + 1).min(width - 1) {
                    sum += u32::from(from[y * width + x]);
                    count += 1;
                }
            }
            (sum / count) as u8
        };
        (0..from.len()).map(mean).collect()
    })
}

/// Each pixel is up to 40 of 255 levels off; one of 2,000 is black or white.
fn noisy(grey: &[u8]) -> Vec<u8> {
    let mut state = 5_u32;
    let mut random = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as i32
    };
    grey.iter()
        .map(|&at| match random() % 2000 {
            0 => (random() % 2 * 255) as u8,
            _ => (i32::from(at) + random() % 81 - 40).clamp(0, 255) as u8,
        })
        .collect()
}

/// Blocks of eight times eight pixels whose cosine transform is rounded, coarser for higher frequencies, as JPEG does.
fn compressed(grey: &[u8], width: usize, height: usize) -> Vec<u8> {
    let cosine = |at: usize, wave: usize| {
        let scale = if wave == 0 { libm::sqrt(0.125) } else { 0.5 };
        scale * libm::cos((2 * at + 1) as f64 * wave as f64 * std::f64::consts::PI / 16.0)
    };
    let table: Vec<Vec<f64>> = (0..8).map(|at| (0..8).map(|wave| cosine(at, wave)).collect()).collect();
    let mut into = grey.to_vec();
    for top in (0..height).step_by(8) {
        for left in (0..width).step_by(8) {
            let at = |x: usize, y: usize| (top + y).min(height - 1) * width + (left + x).min(width - 1);
            let mut waves = [[0.0; 8]; 8];
            for (v, row) in waves.iter_mut().enumerate() {
                for (u, wave) in row.iter_mut().enumerate() {
                    for y in 0..8 {
                        *wave += (0..8).map(|x| f64::from(grey[at(x, y)]) * table[x][u] * table[y][v]).sum::<f64>();
                    }
                    let coarse = 16.0 + 6.0 * (u + v) as f64;
                    *wave = (*wave / coarse).round() * coarse;
                }
            }
            for y in 0..8 {
                for x in 0..8 {
                    let sum = |v: usize| (0..8).map(|u| waves[v][u] * table[x][u] * table[y][v]).sum::<f64>();
                    into[at(x, y)] = (0..8).map(sum).sum::<f64>().clamp(0.0, 255.0) as u8;
                }
            }
        }
    }
    into
}

/// A screenshot: a margin, a frame two pixels wide around, and a line of small marks below, as of a caption.
fn framed(grey: &[u8], width: usize, height: usize) -> Grey {
    let (margin, below) = (30, 70);
    let (wide, high) = (width + 2 * margin, height + margin + below);
    let mut into = vec![255; wide * high];
    for y in 0..height {
        into[(y + margin) * wide + margin..][..width].copy_from_slice(&grey[y * width..][..width]);
    }
    let mut put = |x: usize, y: usize| into[y * wide + x] = 0;
    for at in 0..2 {
        (8..wide - 8).for_each(|x| [8 + at, high - 50 + at].into_iter().for_each(|y| put(x, y)));
        (8..high - 49).for_each(|y| [8 + at, wide - 10 + at].into_iter().for_each(|x| put(x, y)));
    }
    for letter in 0..30 {
        for stroke in 0..8 {
            put(40 + letter * 12 + stroke % 3, high - 30 + stroke);
            put(40 + letter * 12 + stroke, high - 26);
        }
    }
    (into, wide, high)
}
