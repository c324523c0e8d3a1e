//! The search for smaller inputs with the same fault.
use crate::{Source, Target, once};

/// Makes an input smaller while it fails in the same place: removes pieces, or replaces them by zeros. A zero means the
/// first choice.
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

/// The place of a fault, without values. Two findings with the same place are the same.
pub(crate) fn place(message: &str) -> &str {
    let line = message.lines().next().unwrap_or_default();
    line.match_indices(": ").next().map_or(line, |(at, _)| &line[..at])
}
