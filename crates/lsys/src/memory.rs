//! Memory sizes for `--memory`, and whether there is as much memory.

use crate::CommandFailure;
use lsystem::base::say;

/// The least memory limit, in bytes.
const LEAST: u64 = 1 << 20;

/// Reads a size such as `512M` or `2G`, in powers of 1,024. Returns bytes.
///
/// # Errors
/// A message if the text is not such a size.
pub(crate) fn parse(text: &str) -> Result<u64, String> {
    let digits = text.len() - text.trim_start_matches(|ch: char| ch.is_ascii_digit()).len();
    let (number, unit) = text.split_at(digits);
    let unit: u64 = match unit.to_ascii_lowercase().as_str() {
        "k" | "kb" | "kib" => 1 << 10,
        "m" | "mb" | "mib" => 1 << 20,
        "g" | "gb" | "gib" => 1 << 30,
        "t" | "tb" | "tib" => 1 << 40,
        _ => return Err(say!("expected a whole number with K, M, G or T, such as 512M or 2G")),
    };
    let bytes = number.parse::<u64>().ok().and_then(|number| number.checked_mul(unit));
    match bytes {
        Some(bytes) if bytes >= LEAST => Ok(bytes),
        Some(_) => Err(say!("expected 1M or more")),
        None if number.is_empty() => Err(say!("expected a number before the unit, such as 512M")),
        None => Err(say!("the size is too large")),
    }
}

/// Checks that there is memory for work that takes about `bytes`. The system would end the program in the middle of the
/// work otherwise.
///
/// # Errors
/// [`CommandFailure::Limit`] if there is less.
pub(crate) fn check(bytes: u64) -> Result<(), CommandFailure> {
    match is_free(bytes) {
        true => Ok(()),
        false => {
            let words =
                format!("{}\n", say!("error: not enough memory: this takes about {} MiB", bytes.div_ceil(1 << 20)));
            Err(CommandFailure::Limit(words))
        }
    }
}

/// The bytes of memory that growing data may take: `wanted`, if there is as much, or else half of what there is, because
/// data is copied when it grows.
pub(crate) fn at_most(wanted: u64) -> u64 {
    let is_enough = |bytes: &u64| *bytes <= LEAST || is_free(*bytes);
    let free = core::iter::successors(Some(wanted), |bytes| Some(bytes / 8 * 7)).find(is_enough).unwrap_or(LEAST);
    if free == wanted { wanted } else { free / 2 }
}

fn is_free(bytes: u64) -> bool {
    usize::try_from(bytes).is_ok_and(|bytes| Vec::<u8>::new().try_reserve_exact(bytes).is_ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes() {
        assert_eq!(parse("512M"), Ok(512 << 20));
        assert_eq!(parse("2G"), Ok(2 << 30));
        assert_eq!(parse("2gib"), Ok(2 << 30));
        assert_eq!(parse("1024KB"), Ok(1 << 20));
        for wrong in
            ["", "2", "M", "-1M", "1.5G", "2 G", "2X", "0M", "1023K", "99999999999T", "99999999999999999999G", "٣M"]
        {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }
}
