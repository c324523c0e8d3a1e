//! Numbers as text.

/// The shortest decimal that reads back as `value`, with an exponent below 1e-6 and from 1e15 on.
#[must_use]
pub fn number(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || (1e-6..1e15).contains(&size) { format!("{value}") } else { format!("{value:e}") }
}
