//! Texts, symbols and numbers in LaTeX.
//!
//! The output needs no packages except `amsmath`, and compiles with pdfLaTeX in its default encodings.

use lsystem_base::number::number;
use lsystem_syntax::Query;

/// A text in LaTeX. Characters that pdfLaTeX does not have become their numbers, as in `[U+1F33F]`.
pub(super) fn text(text: &str) -> String {
    text.chars().map(character).collect()
}

fn character(c: char) -> String {
    match c {
        '\\' => r"\textbackslash{}".into(),
        '^' => r"\textasciicircum{}".into(),
        '~' => r"\textasciitilde{}".into(),
        // BibTeX counts braces even behind a backslash.
        '{' => r"\textbraceleft{}".into(),
        '}' => r"\textbraceright{}".into(),
        '#' | '$' | '%' | '&' | '_' => format!("\\{c}"),
        '<' => r"\textless{}".into(),
        '>' => r"\textgreater{}".into(),
        '|' => r"\textbar{}".into(),
        // The packages of some languages give this character another meaning.
        '"' => "''".into(),
        c if c.is_whitespace() => " ".into(),
        ' '..='~' => c.into(),
        c if is_typeset(c) => c.into(),
        c => match glyph(c) {
            Some(glyph) => format!("${glyph}$"),
            None => unknown(c),
        },
    }
}

/// A symbol of a system in LaTeX's math mode, as a letter: without the spaces around operators.
pub(super) fn symbol(c: char) -> String {
    if let Some(query) = Query::of_symbol(c) {
        return format!("{{{query}}}");
    }
    match c {
        '^' => r"{\wedge}".into(),
        '~' => r"{\sim}".into(),
        '\\' => r"{\backslash}".into(),
        '{' | '}' | '#' | '$' | '%' | '&' | '_' => format!("\\{c}"),
        '"' => r"\text{''}".into(),
        '\'' | '`' => format!("\\text{{{c}}}"),
        '[' | ']' => c.into(),
        c if c.is_ascii_alphanumeric() => c.into(),
        ' ' => r"\text{\textvisiblespace}".into(),
        '!'..='~' => format!("{{{c}}}"),
        c => match glyph(c) {
            Some(glyph) => format!("{{{glyph}}}"),
            None if is_typeset(c) => format!("\\text{{{c}}}"),
            None => format!("\\text{{{}}}", unknown(c)),
        },
    }
}

/// The name of a parameter or a constant in math mode: `r1` and `r_1` have a lower index.
pub(super) fn name(name: &str) -> String {
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let (stem, index) = if stem.is_empty() { (name, "") } else { (stem, &name[stem.len()..]) };
    let stem = if index.is_empty() { stem } else { stem.strip_suffix('_').filter(|s| !s.is_empty()).unwrap_or(stem) };
    let letters: String = stem.chars().map(symbol).collect();
    let letters = if stem.chars().nth(1).is_some() { format!("\\mathit{{{letters}}}") } else { letters };
    if index.is_empty() { letters } else { format!("{letters}_{{{index}}}") }
}

/// A number in math mode.
pub(super) fn decimal(value: f64) -> String {
    let text = number(value);
    match text.split_once('e') {
        Some((digits, exponent)) => format!("{digits}\\cdot10^{{{exponent}}}"),
        None => text,
    }
}

/// Whether pdfLaTeX has a character in its default encodings. Found by trying all characters up to U+017F.
fn is_typeset(c: char) -> bool {
    const LACKING: &str = "«»ÐÞðþĄąĐđĘęĦħĮįĸĿŀŉŊŋŦŧŲųſ\u{ad}";
    matches!(c, '¡'..='ſ' if !LACKING.contains(c))
        || matches!(c, '‐'..='―' | '‘' | '’' | '“' | '”' | '†'..='•' | '…' | '€' | '™')
}

/// A character as a command of math mode.
fn glyph(c: char) -> Option<&'static str> {
    if c == '\u{2212}' {
        return Some("-");
    }
    GLYPHS.iter().find(|(own, _)| *own == c).map(|(_, command)| *command)
}

/// A character that LaTeX cannot print, by its number.
fn unknown(c: char) -> String {
    format!("[U+{:04X}]", u32::from(c))
}

/// Characters that are commands of math mode.
const GLYPHS: [(char, &str); 48] = [
    ('α', r"\alpha"),
    ('β', r"\beta"),
    ('γ', r"\gamma"),
    ('δ', r"\delta"),
    ('ε', r"\varepsilon"),
    ('ζ', r"\zeta"),
    ('η', r"\eta"),
    ('θ', r"\theta"),
    ('ι', r"\iota"),
    ('κ', r"\kappa"),
    ('λ', r"\lambda"),
    ('μ', r"\mu"),
    ('ν', r"\nu"),
    ('ξ', r"\xi"),
    ('π', r"\pi"),
    ('ρ', r"\rho"),
    ('ς', r"\varsigma"),
    ('σ', r"\sigma"),
    ('τ', r"\tau"),
    ('υ', r"\upsilon"),
    ('φ', r"\varphi"),
    ('χ', r"\chi"),
    ('ψ', r"\psi"),
    ('ω', r"\omega"),
    ('Γ', r"\Gamma"),
    ('Δ', r"\Delta"),
    ('Θ', r"\Theta"),
    ('Λ', r"\Lambda"),
    ('Ξ', r"\Xi"),
    ('Π', r"\Pi"),
    ('Σ', r"\Sigma"),
    ('Υ', r"\Upsilon"),
    ('Φ', r"\Phi"),
    ('Ψ', r"\Psi"),
    ('Ω', r"\Omega"),
    ('→', r"\to"),
    ('←', r"\leftarrow"),
    ('↑', r"\uparrow"),
    ('↓', r"\downarrow"),
    ('○', r"\bigcirc"),
    ('●', r"\bullet"),
    ('∧', r"\wedge"),
    ('∨', r"\vee"),
    ('≤', r"\leq"),
    ('≥', r"\geq"),
    ('≠', r"\neq"),
    ('∞', r"\infty"),
    ('∗', r"\ast"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_are_escaped() {
        assert_eq!(
            text("50% of {a_b} & #1 <x> C:\\~^|\"ω🌿é−-\n$"),
            "50\\% of \\textbraceleft{}a\\_b\\textbraceright{} \\& \\#1 \\textless{}x\\textgreater{} C:\\textbackslash{}\\textasciitilde{}\\textasciicircum{}\\textbar{}''$\\omega$[U+1F33F]é$-$- \\$"
        );
        let word: String = "F+[&^\\/!']{.}$%#_~ 0é●🌿".chars().map(symbol).collect();
        assert_eq!(
            word,
            "F{+}[\\&{\\wedge}{\\backslash}{/}{!}\\text{'}]\\{{.}\\}\\$\\%\\#\\_{\\sim}\\text{\\textvisiblespace}0\\text{é}{\\bullet}\\text{[U+1F33F]}"
        );
    }

    #[test]
    fn names_and_numbers() {
        let names = ["r", "r1", "r_1", "lr", "lr2", "_", "_1", "a_b", "δ"];
        let expected = [
            "r",
            "r_{1}",
            "r_{1}",
            r"\mathit{lr}",
            r"\mathit{lr}_{2}",
            r"\_",
            r"\__{1}",
            r"\mathit{a\_b}",
            r"{\delta}",
        ];
        assert_eq!(names.map(name), expected);
        assert_eq!([0.5, -2.0, 1.5e20, 1e-9].map(decimal), ["0.5", "-2", r"1.5\cdot10^{20}", r"1\cdot10^{-9}"]);
    }
}
