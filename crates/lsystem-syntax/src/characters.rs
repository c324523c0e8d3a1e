//! Characters that are read as white space or as other characters.

/// Whether a character is white space: a separator, never a symbol.
pub(crate) fn is_blank(ch: char) -> bool {
    ch.is_whitespace() || ch == '\u{feff}'
}

/// Whether a character is invisible or only formats its neighbours. Such characters are read as white space.
pub(crate) fn is_invisible(ch: char) -> bool {
    matches!(ch, '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}')
        || (ch.is_control() && !ch.is_whitespace())
}

/// The plain character for a typographic look-alike, as word processors and papers use; `None` for all other
/// characters.
pub fn look_alike(ch: char) -> Option<char> {
    Some(match ch {
        '\u{2010}'..='\u{2015}' | '\u{2212}' | '\u{2796}' | '\u{2d7}' | '\u{fe58}' | '\u{fe63}' => '-',
        '\u{2795}' | '\u{fe62}' => '+',
        '\u{2018}' | '\u{2019}' | '\u{201b}' | '\u{2032}' | '\u{b4}' | '\u{2b9}' | '\u{2bc}' => '\'',
        '\u{201c}'..='\u{201f}' | '\u{2033}' => '"',
        '\u{2c6}' | '\u{2038}' => '^',
        '\u{2215}' | '\u{2044}' => '/',
        '\u{2216}' | '\u{fe68}' => '\\',
        '\u{2223}' | '\u{a6}' | '\u{2758}' => '|',
        '\u{2217}' | '\u{22c6}' | '\u{fe61}' => '*',
        '\u{27e8}' | '\u{2329}' | '\u{3008}' | '\u{2039}' | '\u{fe64}' => '<',
        '\u{27e9}' | '\u{232a}' | '\u{3009}' | '\u{203a}' | '\u{fe65}' => '>',
        '\u{201a}' => ',',
        '\u{2236}' | '\u{a789}' | '\u{fe55}' => ':',
        '\u{27f6}' | '\u{21d2}' | '\u{27f9}' | '\u{2794}' | '\u{279c}' | '\u{279d}' | '\u{21a6}' | '\u{27fc}' => '→',
        '\u{3f5}' | '\u{25b}' => 'ε',
        // The full-width forms of ASCII.
        '\u{ff01}'..='\u{ff5e}' => char::from_u32(u32::from(ch) - 0xfee0)?,
        // Files often start with a byte order mark, so no warning is due.
        '\u{feff}' => return None,
        _ if is_invisible(ch) => ' ',
        _ => return None,
    })
}

/// The symbol for `@` followed by this ASCII character. In cpfg, `@c` and `@o` fill a disc around the turtle.
pub(crate) fn disc(after: char) -> Option<char> {
    matches!(after, 'c' | 'o').then_some('●')
}
