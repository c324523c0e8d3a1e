//! The progress of resumable work.

/// The result of one step of resumable work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress {
    /// More steps are needed.
    More,
    /// The work is complete.
    Done,
}
