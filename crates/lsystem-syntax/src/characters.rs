//! Characters that are read as others, or not at all.

/// White space, which separates and is no symbol.
pub(crate) fn is_blank(ch: char) -> bool {
    ch.is_whitespace() || ch == '\u{feff}'
}

/// Characters that show nothing, or only change how others are shown: read as white space.
pub(crate) fn is_invisible(ch: char) -> bool {
    matches!(ch, '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}')
        || (ch.is_control() && !ch.is_whitespace())
}

/// What a character that word processors, papers and other scripts put in the place of a plain one is read as.
pub(crate) fn look_alike(ch: char) -> Option<char> {
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
        // A byte order mark at the start of a file is ordinary.
        '\u{feff}' => return None,
        _ if is_invisible(ch) => ' ',
        _ => return None,
    })
}
