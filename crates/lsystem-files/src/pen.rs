//! Names of colours, to distinguish pens.

/// The names of twelve hues, from red on, 30 degrees apart.
const HUES: [&str; 12] =
    ["red", "orange", "yellow", "lime", "green", "sea green", "cyan", "azure", "blue", "violet", "magenta", "pink"];
/// The chroma below which a colour is a grey, of 255.
const GREY: i32 = 24;

/// A name for a colour, such as `dark sea green #1f5c3a`.
pub(super) fn name(rgb: [u8; 3]) -> String {
    let [r, g, b] = rgb;
    format!("{} #{r:02x}{g:02x}{b:02x}", words(rgb))
}

fn words(rgb: [u8; 3]) -> String {
    let [r, g, b] = rgb.map(i32::from);
    let (high, low) = (r.max(g).max(b), r.min(g).min(b));
    let chroma = high - low;
    let light = (high + low) / 2;
    if chroma < GREY {
        return match light {
            0..32 => "black",
            32..104 => "dark grey",
            104..160 => "grey",
            160..232 => "light grey",
            _ => "white",
        }
        .to_owned();
    }
    // The hue in degrees, as in CSS.
    let hue = match high {
        _ if high == r => 60 * (g - b) / chroma,
        _ if high == g => 120 + 60 * (b - r) / chroma,
        _ => 240 + 60 * (r - g) / chroma,
    };
    let hue = HUES[((hue.rem_euclid(360) + 15) / 30 % 12) as usize];
    match (hue, light) {
        ("orange", 0..90) => "brown".to_owned(),
        (_, 0..90) => format!("dark {hue}"),
        (_, 176..) => format!("light {hue}"),
        _ => hue.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_have_plain_names() {
        let colours = [
            ([0, 0, 0], "black #000000"),
            ([0xff, 0, 0], "red #ff0000"),
            ([0x1f, 0x5c, 0x3a], "dark sea green #1f5c3a"),
            ([0xb5, 0x8b, 0x1e], "orange #b58b1e"),
            ([0x66, 0x33, 0], "brown #663300"),
            ([0xc8, 0xc8, 0xff], "light blue #c8c8ff"),
            ([0xff, 0, 0x10], "red #ff0010"),
            ([0xff; 3], "white #ffffff"),
        ];
        for (rgb, expected) in colours {
            assert_eq!(name(rgb), expected);
        }
    }
}
