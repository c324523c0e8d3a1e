//! Pixels without the background, for ink that adds up, and mixtures of pixels.

/// The least opaque pixel that shows `colour` over `paper`, to a level of each channel. Ink that adds up takes another part
/// of each channel's light, and a pixel has one opacity: so the pixel is exact over this paper only.
pub(super) fn least_opaque(colour: [u8; 3], paper: [u8; 3]) -> [u8; 4] {
    let channels = [0, 1, 2].map(|channel| (i32::from(colour[channel]), i32::from(paper[channel])));
    // The opacity at which the channel of the pixel would be 0 or 255.
    let needed = channels.map(|(colour, paper)| {
        let change = colour - paper;
        let range = if change < 0 { paper } else { 255 - paper };
        if change == 0 { 0 } else { (change.abs() * 255 + range - 1) / range }
    });
    let opacity = needed.into_iter().fold(0, i32::max);
    if opacity == 0 {
        return [0; 4];
    }
    let [r, g, b] = channels.map(|(colour, paper)| {
        let change = (colour - paper) * 255;
        let half = opacity / 2 * change.signum();
        (paper + (change + half) / opacity).clamp(0, 255) as u8
    });
    [r, g, b, opacity as u8]
}

/// The mixture of two pixels with `part` (0 to 1) of the second. Transparent pixels count by their opacity.
pub(super) fn mixed(first: [u8; 4], second: [u8; 4], part: f32) -> [u8; 4] {
    let between = |a: f32, b: f32| a + part * (b - a);
    let [first_opacity, second_opacity] = [first[3], second[3]].map(f32::from);
    let opacity = between(first_opacity, second_opacity);
    let level = |channel: usize| {
        let [first, second] = [first[channel], second[channel]].map(f32::from);
        if first_opacity == second_opacity {
            return (between(first, second) + 0.5) as u8;
        }
        (between(first * first_opacity, second * second_opacity) / opacity.max(f32::MIN_POSITIVE) + 0.5) as u8
    };
    [level(0), level(1), level(2), (opacity + 0.5) as u8]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_over_their_paper_have_their_colour() {
        for paper in [[255; 3], [0; 3], [250, 240, 200], [20, 30, 128]] {
            for at in 0..4096_u32 {
                let colour = [at & 15, at >> 4 & 15, at >> 8].map(|part| (part * 17) as u8);
                let [r, g, b, opacity] = least_opaque(colour, paper).map(i32::from);
                for (channel, ink) in [r, g, b].into_iter().enumerate() {
                    let over = (ink * opacity + i32::from(paper[channel]) * (255 - opacity) + 127) / 255;
                    assert!((over - i32::from(colour[channel])).abs() <= 1, "{colour:?} {paper:?}");
                }
            }
        }
        assert_eq!(least_opaque([9, 9, 9], [9, 9, 9]), [0; 4]);
        assert_eq!(least_opaque([0, 0, 0], [255; 3]), [0, 0, 0, 255]);
    }
}
