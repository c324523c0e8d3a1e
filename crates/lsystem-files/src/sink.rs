//! The way of a file's bytes to their owner.

use lsystem_syntax::{Diagnostic, Halt, Work};

/// The units of work after which the owner learns of them, and gets the text written so far: well under a millisecond.
const SHARE: u64 = 1 << 14;

/// Remarks on a written file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Notes {
    /// A warning about the file.
    pub remark: Option<Diagnostic>,
    /// Facts about the file, as a line of text.
    pub summary: Option<String>,
}

/// The result of writing a file.
pub type WriteResult = Result<Notes, Halt>;

/// The owner of a file in the making: takes the bytes piece by piece, and may stop the work.
pub trait Owner {
    /// Takes the next bytes of the file. Pieces of texts are whole characters.
    ///
    /// # Errors
    /// [`Halt::Stopped`] if the owner wants no more.
    fn piece(&mut self, bytes: &[u8]) -> Result<(), Halt>;

    /// Learns of further units of work: about 16,384 at a time.
    ///
    /// # Errors
    /// [`Halt::Stopped`] if the owner wants no more.
    fn spent(&mut self, _units: u64) -> Result<(), Halt> {
        Ok(())
    }

    /// Learns how many rows of `all` rows of a picture are written.
    fn rows(&mut self, _done: u32, _all: u32) {}
}

/// Collects a file.
impl Owner for Vec<u8> {
    fn piece(&mut self, bytes: &[u8]) -> Result<(), Halt> {
        self.extend_from_slice(bytes);
        Ok(())
    }
}

/// Collects a text.
impl Owner for String {
    fn piece(&mut self, bytes: &[u8]) -> Result<(), Halt> {
        self.push_str(&String::from_utf8_lossy(bytes));
        Ok(())
    }
}

/// Takes the text or the bytes of a file and counts the work for them.
pub struct Sink<'o> {
    /// The text that the owner has not got yet.
    pub text: String,
    owner: &'o mut dyn Owner,
    /// The units of work that the owner does not know yet.
    units: u64,
}

impl<'o> Sink<'o> {
    /// Calls `write` with a sink of this owner, who then has the whole file.
    ///
    /// # Errors
    /// As `write`, and if the owner stops the work.
    pub fn to<T>(owner: &'o mut dyn Owner, write: impl FnOnce(&mut Self) -> Result<T, Halt>) -> Result<T, Halt> {
        let mut sink = Self { text: String::new(), owner, units: 0 };
        let result = write(&mut sink)?;
        sink.hand_on()?;
        Ok(result)
    }

    /// Appends bytes.
    ///
    /// # Errors
    /// If the owner stops the work.
    pub fn bytes(&mut self, bytes: &[u8]) -> Result<(), Halt> {
        self.hand_on()?;
        self.owner.piece(bytes)
    }

    /// Tells the owner how many rows of a picture are written.
    pub(crate) fn rows(&mut self, done: u32, all: u32) {
        self.owner.rows(done, all);
    }

    fn hand_on(&mut self) -> Result<(), Halt> {
        if !self.text.is_empty() {
            self.owner.piece(self.text.as_bytes())?;
            self.text.clear();
        }
        Ok(())
    }
}

impl Work for Sink<'_> {
    fn charge(&mut self, units: u64) -> Result<(), Halt> {
        self.units = self.units.saturating_add(units);
        if self.units < SHARE {
            return Ok(());
        }
        self.hand_on()?;
        self.owner.spent(core::mem::take(&mut self.units))
    }
}

impl core::fmt::Debug for Sink<'_> {
    fn fmt(&self, out: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        out.debug_struct("Sink").field("text", &self.text).field("units", &self.units).finish_non_exhaustive()
    }
}

/// The whole file that `write` makes, and its result.
///
/// # Errors
/// As `write`.
pub fn collect<O: Owner + Default, T>(
    write: impl FnOnce(&mut Sink<'_>) -> Result<T, Halt>,
) -> Result<(O, T), Diagnostic> {
    let mut file = O::default();
    let result = Sink::to(&mut file, write).map_err(Halt::diagnostic)?;
    Ok((file, result))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Stops when it has this many bytes.
    struct Few(usize, Vec<u8>);

    impl Owner for Few {
        fn piece(&mut self, bytes: &[u8]) -> Result<(), Halt> {
            self.1.extend(bytes);
            Ok(())
        }

        fn spent(&mut self, units: u64) -> Result<(), Halt> {
            assert!((SHARE..SHARE + 100).contains(&units));
            if self.1.len() < self.0 { Ok(()) } else { Err(Halt::Stopped) }
        }
    }

    fn write(sink: &mut Sink<'_>) -> Result<(), Halt> {
        for _ in 0..1000 {
            sink.charge(100)?;
            sink.text.push_str("a line\n");
        }
        sink.bytes(b"end")
    }

    #[test]
    fn owners_get_pieces_and_may_stop_the_work() {
        let (whole, ()) = collect::<String, _>(write).unwrap();
        assert!(whole.len() == 7003 && whole.ends_with("a line\nend"));
        assert_eq!(collect::<Vec<u8>, _>(write).unwrap().0, whole.as_bytes());
        let mut few = Few(2000, vec![]);
        assert_eq!(Sink::to(&mut few, write), Err(Halt::Stopped));
        assert!((2000..4000).contains(&few.1.len()) && whole.as_bytes().starts_with(&few.1));
    }
}
