//! How the memory of one instance is shared out.
//!
//! | MiB | for |
//! |---|---|
//! | 70 | the drawing that is shown; of one in space, with what its pictures are made from |
//! | 70 | one at a time: the drawing in the making; a file in the making; what is remembered of a derivation with the counts that a string is read by ([`HISTORY`], 24 and 16); a small picture with its drawing ([`SMALL`]) |
//! | 16 | counts of any size ([`lsystem::syntax::MAX_COUNTING`]) |
//! | 84 | pictures, and what the drawing that is shown leaves of its share ([`picture_room`]); what shows only a part of a drawing in space takes of it |
//! | 16 | texts, compiled systems and what is passed on |

use lsystem::{Limits, Viewport};

const MIB: u64 = 1 << 20;

/// What one instance may take.
#[cfg(test)]
const INSTANCE: u64 = 256 * MIB;
/// Pictures, while the largest drawing is shown.
const PICTURES: u64 = 84 * MIB;
/// Texts, compiled systems and what is passed on.
#[cfg(test)]
const REST: u64 = 16 * MIB;
/// Pictures of fewer pixels are painted as they are: what does not depend on pixels is most of what they take.
const FEWEST: u32 = 1 << 18;

/// What a page may spend: a string that a browser can still hold, a drawing that fits its share.
pub(crate) const LIMITS: Limits =
    Limits { symbols: 64 << 20, modules: 16 << 20, segments: u32::MAX as u64, work: 100_000_000, memory: 70 << 20 };

/// The same for a derivation that is remembered; a string that is read by counts takes 16 megabytes at most.
pub(crate) const HISTORY: Limits = Limits { memory: 24 * MIB, ..LIMITS };

/// The limits of a small picture's drawing. The rest of its 70 MiB is for pixels and tiles.
pub(crate) const SMALL: Limits = Limits { memory: 32 * MIB, ..LIMITS };

/// The bytes that pictures of a drawing may take.
pub(crate) fn picture_room(drawing: u64) -> u64 {
    (PICTURES + LIMITS.memory).saturating_sub(drawing)
}

/// The picture with as many of its pixels as there is room for: its sides are cut by an eighth until it fits.
pub(crate) fn affordable(viewport: Viewport, drawing: u64, bytes: impl Fn(Viewport) -> u64) -> Viewport {
    let mut viewport = viewport;
    while bytes(viewport) > picture_room(drawing) && viewport.width.saturating_mul(viewport.height) > FEWEST {
        let Viewport { width, height, ratio } = viewport;
        viewport = Viewport { width: width - width / 8, height: height - height / 8, ratio: ratio * 7.0 / 8.0 };
    }
    viewport
}

/// A quarter of the pixels, for the same picture.
pub(crate) fn halved(Viewport { width, height, ratio }: Viewport) -> Viewport {
    Viewport { width: width.div_ceil(2), height: height.div_ceil(2), ratio: 0.5 * ratio }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lsystem::render::Detail;
    use lsystem::syntax::Ink;
    use lsystem::{Definition, Renderer, SolidRenderer, Style, System, draw};

    const SCREENS: [[u32; 2]; 6] = [[300, 200], [1280, 800], [1920, 1080], [2560, 1440], [3840, 2160], [7680, 4320]];

    // The shares of an instance add up.
    const _: () = assert!(2 * LIMITS.memory + PICTURES + lsystem::syntax::MAX_COUNTING + REST <= INSTANCE);
    const _: () = assert!(HISTORY.memory + 16 * MIB <= LIMITS.memory);

    #[test]
    fn pictures_of_any_screen_stay_within_their_share() {
        let definition = Definition { axiom: "F".into(), rules: "F -> F+F".into(), ..Definition::default() };
        let system = System::new(&definition).0.unwrap();
        let drawing = draw(&system, 10, &LIMITS).unwrap();
        for [width, height] in SCREENS {
            let viewport = Viewport { width, height, ratio: 1.0 };
            for bytes in [drawing.bytes(), LIMITS.memory] {
                for ink in [Ink::Solid, Ink::Density] {
                    for colours in [1, 2, 16, 256] {
                        let palette = vec![lsystem::syntax::Colour { rgb: [0; 3] }; colours];
                        let style = Style { palette, ink, ..Style::default() };
                        let most = |viewport| {
                            let most = |detail| Renderer::most_bytes(&drawing, &style, viewport, detail);
                            most(Detail::Fine) + most(Detail::Coarse)
                        };
                        let painted = affordable(viewport, bytes, most);
                        println!("{width}x{height} {ink:?} {colours}: {} pixels wide", painted.width);
                        assert!(most(painted) <= picture_room(bytes), "{width}x{height} {ink:?} {colours}");
                    }
                }
                let painted = affordable(viewport, bytes, SolidRenderer::most_bytes);
                println!("{width}x{height} in space: {} pixels wide", painted.width);
                assert!(SolidRenderer::most_bytes(painted) <= picture_room(bytes), "{width}x{height}");
            }
        }
    }
}
