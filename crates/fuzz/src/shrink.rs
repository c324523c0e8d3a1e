//! Smaller inputs that fail alike.

use crate::{Source, Target, once};

/// Makes an input smaller as long as it fails in the same place: cuts pieces out, and puts zeros in, which are the first of
/// all choices.
#[must_use]
pub fn shrink(target: &Target, bytes: &[u8]) -> Vec<u8> {
    let fault = |bytes: &[u8]| once(target, &mut Source::new(bytes)).1.err().map(|message| place(&message).to_owned());
    let (wanted, mut best) = (fault(bytes), bytes.to_vec());
    if wanted.is_none() {
        return best;
    }
    let mut size = best.len();
    while size > 0 {
        let mut at = 0;
        while at < best.len() {
            let end = (at + size).min(best.len());
            let cut = [&best[..at], &best[end..]].concat();
            let zeros = [&best[..at], &vec![0; end - at], &best[end..]].concat();
            if fault(&cut) == wanted {
                best = cut;
                continue;
            }
            if zeros != best && fault(&zeros) == wanted {
                best = zeros;
            }
            at = end;
        }
        size /= 2;
    }
    best
}

/// Where something went wrong, without the values: what makes two findings the same.
pub(crate) fn place(message: &str) -> &str {
    let line = message.lines().next().unwrap_or_default();
    line.match_indices(": ").next().map_or(line, |(at, _)| &line[..at])
}
