//! Pixels without the background, for ink that adds up.

/// The least opaque pixel, but at least as opaque as `least`, that shows `colour` over `paper`, to a level of each channel.
/// Ink that adds up takes another part
/// of each channel's light, and a pixel has one opacity: so the pixel is exact over this paper only.
pub(crate) fn least_opaque(colour: [u8; 3], paper: [u8; 3], least: u8) -> [u8; 4] {
    let channels = [0, 1, 2].map(|channel| (i32::from(colour[channel]), i32::from(paper[channel])));
    // The opacity at which the channel of the pixel would be 0 or 255.
    let needed = channels.map(|(colour, paper)| {
        let change = colour - paper;
        let range = if change < 0 { paper } else { 255 - paper };
        if change == 0 { 0 } else { (change.abs() * 255 + range - 1) / range }
    });
    let opacity = needed.into_iter().fold(i32::from(least), i32::max);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_over_their_paper_have_their_colour() {
        for paper in [[255; 3], [0; 3], [250, 240, 200], [20, 30, 128]] {
            for at in 0..4096_u32 {
                let colour = [at & 15, at >> 4 & 15, at >> 8].map(|part| (part * 17) as u8);
                let [r, g, b, opacity] = least_opaque(colour, paper, 0).map(i32::from);
                for (channel, ink) in [r, g, b].into_iter().enumerate() {
                    let over = (ink * opacity + i32::from(paper[channel]) * (255 - opacity) + 127) / 255;
                    assert!((over - i32::from(colour[channel])).abs() <= 1, "{colour:?} {paper:?}");
                }
            }
        }
        assert_eq!(least_opaque([9, 9, 9], [9, 9, 9], 0), [0; 4]);
        assert_eq!(least_opaque([0, 0, 0], [255; 3], 0), [0, 0, 0, 255]);
        assert_eq!(least_opaque([155, 255, 255], [255; 3], 200), [127, 255, 255, 200]);
    }
}
