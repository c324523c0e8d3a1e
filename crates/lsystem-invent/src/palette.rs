//! Colours that go together: steps of hue, lightness and chroma in OKLCH (Ottosson, 2020), on dark or light paper.

use crate::dice::Dice;
use lsystem_syntax::Colour;

/// Colours of strokes, and the paper behind them.
pub(crate) struct Palette {
    pub colours: Vec<Colour>,
    pub paper: Colour,
    /// The hue of the strongest colour, in degrees.
    pub hue: f64,
}

/// A colour by lightness (0 to 1), chroma (0 to about 0.3) and hue in degrees. A chroma that sRGB does not have is
/// lowered until it does.
pub(crate) fn oklch(lightness: f64, chroma: f64, hue: f64) -> Colour {
    let (sin, cos) = (libm::sin(hue.to_radians()), libm::cos(hue.to_radians()));
    let mut chroma = chroma;
    loop {
        let linear = linear_of(lightness, chroma * cos, chroma * sin);
        if chroma < 1e-3 || linear.iter().all(|part| (-1e-4..=1.0001).contains(part)) {
            return Colour { rgb: linear.map(|part| libm::round(255.0 * companded(part.clamp(0.0, 1.0))) as u8) };
        }
        chroma *= 0.95;
    }
}

/// Linear sRGB from Oklab.
fn linear_of(l: f64, a: f64, b: f64) -> [f64; 3] {
    let cube = |root: f64| root * root * root;
    let long = cube(l + 0.396_337_777_4 * a + 0.215_803_757_3 * b);
    let medium = cube(l - 0.105_561_345_8 * a - 0.063_854_172_8 * b);
    let short = cube(l - 0.089_484_177_5 * a - 1.291_485_548 * b);
    [
        4.076_741_662_1 * long - 3.307_711_591_3 * medium + 0.230_969_929_2 * short,
        -1.268_438_004_6 * long + 2.609_757_401_1 * medium - 0.341_319_396_5 * short,
        -0.004_196_086_3 * long - 0.703_418_614_7 * medium + 1.707_614_701 * short,
    ]
}

/// The transfer curve of sRGB.
fn companded(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055 }
}

/// The least contrast of a colour with the paper behind it.
const CONTRAST: f64 = 4.0;
/// The most steps towards white or black: enough for any colour on any paper.
const STEPS: usize = 60;

impl Palette {
    /// Colours on paper: those with too little contrast become lighter on dark paper, and darker on light paper.
    fn new(mut colours: Vec<Colour>, paper: Colour, hue: f64) -> Self {
        let away = if luminance(paper) < 0.18 { 255.0 } else { 0.0 };
        for colour in &mut colours {
            for _ in 0..STEPS {
                if contrast(*colour, paper) >= CONTRAST {
                    break;
                }
                colour.rgb =
                    colour.rgb.map(|part| libm::round(f64::from(part) + 0.04 * (away - f64::from(part))) as u8);
            }
        }
        Self { colours, paper, hue }
    }
}

/// The contrast of two colours as WCAG 2 defines it, from 1 to 21.
fn contrast(a: Colour, b: Colour) -> f64 {
    let [a, b] = [a, b].map(luminance);
    (a.max(b) + 0.05) / (a.min(b) + 0.05)
}

fn luminance(colour: Colour) -> f64 {
    let linear = |part: u8| {
        let part = f64::from(part) / 255.0;
        if part <= 0.040_45 { part / 12.92 } else { libm::pow((part + 0.055) / 1.055, 2.4) }
    };
    let [r, g, b] = colour.rgb.map(linear);
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

/// Paper of a hue: dark, or light.
fn paper(dice: &mut Dice, is_dark: bool, hue: f64) -> Colour {
    if is_dark {
        oklch(dice.between(0.16, 0.25), dice.between(0.015, 0.06), hue)
    } else {
        oklch(dice.between(0.955, 0.98), dice.between(0.006, 0.02), hue)
    }
}

/// Steps from one hue to another, lighter on dark paper than on light paper.
pub(crate) fn gradient(dice: &mut Dice, steps: usize) -> Palette {
    let is_dark = dice.chance(0.6);
    let hue = dice.between(0.0, 360.0);
    let sweep = dice.one([-1.0, 1.0]) * dice.between(40.0, 130.0);
    let lightness = if is_dark { [dice.between(0.5, 0.62), dice.between(0.82, 0.93)] } else { [0.36, 0.62] };
    let chroma = dice.between(0.1, 0.19);
    let colours = (0..steps).map(|step| {
        let part = step as f64 / (steps - 1).max(1) as f64;
        let [from, to] = lightness;
        oklch(from + part * (to - from), chroma * (1.0 - 0.35 * part), hue + part * sweep)
    });
    let colours = colours.collect();
    let aside = dice.one([0.0, 30.0, 180.0]);
    Palette::new(colours, paper(dice, is_dark, hue + aside), hue + 0.4 * sweep)
}

/// One colour.
pub(crate) fn single(dice: &mut Dice) -> Palette {
    let is_dark = dice.chance(0.6);
    let hue = dice.between(0.0, 360.0);
    let [lightness, chroma] = if is_dark { [0.84, 0.1] } else { [0.42, 0.12] };
    Palette::new(vec![oklch(lightness, chroma, hue)], paper(dice, is_dark, hue + 20.0), hue)
}

/// Wood, then `leaves` colours of leaves or blossoms.
pub(crate) fn plant(dice: &mut Dice, leaves: usize) -> Palette {
    let is_dark = dice.chance(0.3);
    let wood = dice.between(40.0, 75.0);
    let hue = dice.one([125.0, 135.0, 145.0, 118.0, 105.0, 70.0, 45.0, 5.0, 350.0, 320.0]) + dice.between(-8.0, 8.0);
    let (stem, lightness) = if is_dark { (0.66, 0.76) } else { (0.36, 0.6) };
    let mut colours = vec![oklch(stem, 0.045, wood)];
    colours.extend((0..leaves).map(|at| {
        let part = at as f64 / leaves.max(1) as f64;
        oklch(lightness + 0.12 * part, dice.between(0.11, 0.16), hue - 14.0 * part)
    }));
    // Warm white paper, or a night.
    let behind =
        if is_dark { dice.one([255.0, 215.0, 290.0, 170.0]) } else { dice.one([95.0, 95.0, 120.0, 250.0, 60.0]) };
    Palette::new(colours, paper(dice, is_dark, behind), hue)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_those_of_the_paper_on_oklab() {
        // White, black, and sRGB's red: lightness 0.628, chroma 0.2577, hue 29.23 degrees.
        assert_eq!(oklch(1.0, 0.0, 0.0).rgb, [255; 3]);
        assert_eq!(oklch(0.0, 0.0, 0.0).rgb, [0; 3]);
        let [r, g, b] = oklch(0.627_955, 0.257_683, 29.234).rgb;
        assert!(r >= 254 && g <= 2 && b <= 2, "{r} {g} {b}");
    }

    #[test]
    fn strokes_stand_out_from_the_paper() {
        let mut dice = Dice::new(1);
        for turn in 0..200 {
            let palette = match turn % 3 {
                0 => gradient(&mut dice, 6),
                1 => single(&mut dice),
                _ => plant(&mut dice, 3),
            };
            for colour in &palette.colours {
                let contrast = contrast(*colour, palette.paper);
                assert!(contrast >= CONTRAST, "{colour:?} on {:?}: {contrast:.2}", palette.paper);
            }
        }
    }
}
