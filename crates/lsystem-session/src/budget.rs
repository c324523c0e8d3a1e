//! The memory budget of one instance.
//!
//! | MiB | for |
//! |---|---|
//! | 70 | the shown drawing; in space, with its scene |
//! | 70 | one at a time: the drawing in the making; a remembered derivation with the counts for reading a string ([`HISTORY`], 24 and 16); a small picture with its drawing ([`SMALL`]) |
//! | 16 | counts of any size ([`lsystem::base::MAX_COUNTING`]) |
//! | 84 | pictures, plus the rest of the shown drawing's share ([`picture_room`]); also the second scene of a drawing in space that is shown in part |
//! | 16 | texts, compiled systems and messages |

use lsystem::{Limits, Viewport};

const MIB: u64 = 1 << 20;

/// The most bytes of one instance.
#[cfg(test)]
const INSTANCE: u64 = 256 * MIB;
/// The bytes for pictures while the largest drawing is shown.
const PICTURES: u64 = 84 * MIB;
/// The bytes for texts, compiled systems and messages.
#[cfg(test)]
const REST: u64 = 16 * MIB;
/// Smaller pictures, in pixels, are not reduced: most of their memory does not depend on the number of pixels.
const FEWEST: u32 = 1 << 18;
/// The bytes of a segment in [`SegmentArrays`](lsystem::SegmentArrays): four coordinates, a colour, a level.
const ARRAY_SEGMENT: u64 = 4 * 4 + 4 + 2;

/// The limits of the page.
pub(crate) const LIMITS: Limits = Limits::PAGE;

/// The limits of a remembered derivation. A string that is read by counts takes at most 16 MiB more.
pub(crate) const HISTORY: Limits = Limits { memory: 24 * MIB, ..LIMITS };

/// The limits of a small picture's drawing. The rest of its 70 MiB is for pixels and tiles.
pub(crate) const SMALL: Limits = Limits { memory: 32 * MIB, ..LIMITS };

/// The most segments in arrays: 352 MiB, and as much again while JavaScript copies them. Such arrays are not for the page,
/// but for programs, whose instance holds nothing else.
pub(crate) const ARRAY_SEGMENTS: u64 = 16 << 20;
const _: () = assert!(ARRAY_SEGMENTS * ARRAY_SEGMENT == 352 * MIB);

/// The bytes for pictures of a drawing of `drawing` bytes.
pub(crate) fn picture_room(drawing: u64) -> u64 {
    (PICTURES + LIMITS.memory).saturating_sub(drawing)
}

/// The viewport with as many pixels as fit the budget: the sides shrink by an eighth until the picture fits.
pub(crate) fn affordable(viewport: Viewport, drawing: u64, bytes: impl Fn(Viewport) -> u64) -> Viewport {
    let mut viewport = viewport;
    while bytes(viewport) > picture_room(drawing) && viewport.width.saturating_mul(viewport.height) > FEWEST {
        let Viewport { width, height, ratio } = viewport;
        viewport = Viewport { width: width - width / 8, height: height - height / 8, ratio: ratio * 7.0 / 8.0 };
    }
    viewport
}

/// The viewport of the same picture with half the width and height.
pub(crate) fn halved(Viewport { width, height, ratio }: Viewport) -> Viewport {
    Viewport { width: width.div_ceil(2), height: height.div_ceil(2), ratio: 0.5 * ratio }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lsystem::render::Detail;
    use lsystem::syntax::Ink;
    use lsystem::{Definition, Plane, Renderer, SolidRenderer, Style, System, draw};

    const SCREENS: [[u32; 2]; 6] = [[300, 200], [1280, 800], [1920, 1080], [2560, 1440], [3840, 2160], [7680, 4320]];

    // The shares of an instance add up.
    const _: () = assert!(2 * LIMITS.memory + PICTURES + lsystem::base::MAX_COUNTING + REST <= INSTANCE);
    const _: () = assert!(HISTORY.memory + 16 * MIB <= LIMITS.memory);

    #[test]
    fn pictures_of_any_screen_stay_within_their_share() {
        let definition = Definition { axiom: "F".into(), rules: "F -> F+F".into(), ..Definition::default() };
        let system = System::new(&definition).unwrap();
        let drawing = draw::<Plane>(&system, 10, &LIMITS).unwrap();
        for [width, height] in SCREENS {
            let viewport = Viewport { width, height, ratio: 1.0 };
            for bytes in [drawing.bytes(), LIMITS.memory] {
                for ink in Ink::ALL {
                    for colours in [1, 2, 16, 256] {
                        let palette = vec![lsystem::syntax::Colour { rgb: [0; 3] }; colours];
                        let style = Style { palette, ink, ..Style::default() };
                        let most = |viewport| {
                            let most = |detail| Renderer::most_bytes(&drawing, &style, viewport, detail);
                            most(Detail::Fine) + most(Detail::Sketch)
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
