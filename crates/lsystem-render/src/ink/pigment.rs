//! The effect of inks on the paper's light.

use lsystem_syntax::Colour;

/// The colour of ink: how much one layer darkens red, green and blue ([`pigment`]).
pub(crate) type Pigment = [f32; 3];

/// The least part of light that a channel reflects: half of one of 256 levels, because the logarithm of 0 is infinite.
const LEAST_LIGHT: f64 = 1.0 / 512.0;

/// How much one layer of ink darkens each channel (Beer's law): the natural logarithm of the paper's light over the
/// ink's light. For an ink lighter than the paper: minus the logarithm of the ratio of the light that each lacks.
pub(crate) fn pigment(ink: Colour, paper: Colour) -> Pigment {
    [0, 1, 2].map(|channel| {
        let [ink, paper] = [ink, paper].map(|colour| f64::from(colour.rgb[channel]) / 255.0);
        let part = |ink: f64, paper: f64| libm::log(paper.max(LEAST_LIGHT) / ink.max(LEAST_LIGHT));
        (if ink <= paper { part(ink, paper) } else { -part(1.0 - ink, 1.0 - paper) }) as f32
    })
}

/// The light that a channel of the paper reflects under an amount of pigment, as a part of full light.
pub(crate) fn light(paper: u8, pigment: f64) -> f64 {
    let paper = f64::from(paper) / 255.0;
    if pigment >= 0.0 { paper * libm::exp(-pigment) } else { 1.0 - (1.0 - paper) * libm::exp(pigment) }
}
