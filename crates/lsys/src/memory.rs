//! Parsing of memory sizes for `--memory`.

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
        _ => return Err("expected a whole number with K, M, G or T, such as 512M or 2G".to_owned()),
    };
    let bytes = number.parse::<u64>().ok().and_then(|number| number.checked_mul(unit));
    match bytes {
        Some(bytes) if bytes >= LEAST => Ok(bytes),
        Some(_) => Err("expected 1M or more".to_owned()),
        None if number.is_empty() => Err("expected a number before the unit, such as 512M".to_owned()),
        None => Err("the size is too large".to_owned()),
    }
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
