//! Standard output, failures of what writes to it, and the escaping of control characters for a terminal.

use crate::CommandFailure;
use lsystem::syntax::visible;
use std::io::{self, BufWriter, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};

/// Writes the output of `write` to standard output, buffered. A terminal gets visible symbols instead of control
/// characters; a file or a pipe gets every byte.
///
/// # Errors
/// As the writer; [`io::ErrorKind::BrokenPipe`] if the reader has closed the pipe; an error if standard output is
/// closed.
pub(crate) fn print(write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    if CLOSED.load(Ordering::Relaxed) {
        return Err(io::Error::other("closed"));
    }
    let stdout = io::stdout();
    let looking = stdout.is_terminal();
    let mut out = BufWriter::with_capacity(1 << 16, stdout.lock());
    if looking {
        let mut shown = Shown { out };
        write(&mut shown)?;
        return shown.flush();
    }
    write(&mut out)?;
    out.flush()
}

/// Runs `work` as the writer of an output, and returns its failure unless the output itself fails.
pub(crate) fn within<T>(
    output: impl FnOnce(&mut dyn FnMut(&mut dyn Write) -> io::Result<()>) -> Result<T, CommandFailure>,
    mut work: impl FnMut(&mut dyn Write) -> Result<(), CommandFailure>,
) -> Result<T, CommandFailure> {
    let mut failure = None;
    let done = output(&mut |out| {
        work(out).map_err(|error| {
            failure = Some(error);
            io::Error::other("stopped")
        })
    });
    failure.map_or(done, Err)
}

/// Writes text with control characters replaced by [`visible`], except line ends. Each call must hold whole characters.
struct Shown<W: Write> {
    out: W,
}

impl<W: Write> Write for Shown<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.out.write_all(visible_lines(&String::from_utf8_lossy(bytes)).as_bytes())?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// A text of several lines with control characters replaced by [`visible`].
pub(crate) fn visible_lines(text: &str) -> String {
    text.split('\n').map(visible).collect::<Vec<_>>().join("\n")
}

/// JSON with every control character escaped. The value stays the same, because such characters occur only in strings.
pub(crate) fn escape_json(json: &str) -> String {
    let mut out = String::with_capacity(json.len());
    let mut units = [0; 2];
    for ch in json.chars() {
        if ch == '\n' || visible(ch.encode_utf8(&mut [0; 4])).starts_with(ch) {
            out.push(ch);
        } else {
            ch.encode_utf16(&mut units).iter().for_each(|unit| out.push_str(&format!("\\u{unit:04x}")));
        }
    }
    out
}

/// Whether the program was started with standard output closed (`>&-`).
static CLOSED: AtomicBool = AtomicBool::new(false);

/// Checks whether standard output is closed, by two system calls. The check runs before `main`, because Rust then opens
/// `/dev/null` in place of a closed stream, and writing would seem to succeed.
#[cfg(unix)]
#[ctor::ctor]
fn look_at_output() {
    use std::os::fd::AsFd;
    CLOSED.store(io::stdout().as_fd().try_clone_to_owned().is_err(), Ordering::Relaxed);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terminals_get_nothing_to_obey() {
        let mut shown = Shown { out: Vec::new() };
        shown.write_all("F\u{1b}]0;title\u{7}\u{9b}31m\n\u{202e}G\u{f6}\n".as_bytes()).unwrap();
        assert_eq!(String::from_utf8(shown.out).unwrap(), "F␛]0;title␇\u{fffd}31m\n\u{fffd}Gö\n");
    }

    #[test]
    fn json_stays_the_same_value() {
        let text = "a\u{1b}\u{7f}\u{9b}\u{202e}\u{2028}ö\u{1f331}\n";
        let json = serde_json::to_string(text).unwrap();
        let escaped = escape_json(&json);
        assert_eq!(escaped, r#""a\u001b\u007f\u009b\u202e\u2028ö🌱\n""#);
        assert_eq!(serde_json::from_str::<String>(&escaped).unwrap(), text);
    }
}
