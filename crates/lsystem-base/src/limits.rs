//! Limits on work and memory.

/// The limits, by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LimitName {
    /// Symbols of a string held in memory ([`Limits::symbols`](crate::Limits::symbols)).
    Symbols,
    /// Modules of one generation held in memory ([`Limits::modules`](crate::Limits::modules)).
    Modules,
    /// Segments of a drawing ([`Limits::segments`](crate::Limits::segments)).
    Segments,
    /// Symbols derived for a drawing without shared blocks ([`Limits::work`](crate::Limits::work)).
    Work,
    /// Strokes of a file for plotters ([`Limits::segments`](crate::Limits::segments)).
    PlotStrokes,
    /// Parts of a drawing that are read for a plotter ([`MAX_PLOT_BLOCKS`](crate::MAX_PLOT_BLOCKS)).
    PlotBlocks,
    /// Comparisons of lines with what may hide them ([`MAX_COMPARISONS`](crate::MAX_COMPARISONS)).
    Comparisons,
    /// Segments and vertices of polygons that a mesh writes out.
    Mesh,
    /// Segments and vertices of polygons that a viewer of a mesh draws, copies included.
    MeshCopies,
    /// Bytes of a drawing under construction, or of a derivation ([`Limits::memory`](crate::Limits::memory)).
    Memory,
    /// Iterations (1,000).
    Iterations,
    /// Bytes of a text ([`MAX_TEXT`](crate::MAX_TEXT)).
    Text,
    /// Different symbols in a system (65,536).
    Letters,
    /// Parameters of a module ([`MAX_PARAMETERS`](crate::MAX_PARAMETERS)).
    Parameters,
    /// Modules in a context ([`MAX_CONTEXT`]).
    Context,
    /// Actions of a symbol ([`MAX_ACTIONS`](crate::MAX_ACTIONS)).
    Actions,
}

/// The limits that a caller may set. Each is checked before the allocation that it guards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Symbols of a string held in memory.
    pub symbols: u64,
    /// Modules of one generation held in memory, and the numbers in them.
    pub modules: u64,
    /// Segments of a drawing without shared blocks. In a drawing of shared blocks: strokes and placed blocks, counted
    /// as the symbols of the successors that make them.
    pub segments: u64,
    /// Symbols derived for a drawing without shared blocks, summed over all generations. A symbol without a production
    /// counts once; each open branch counts 32 more.
    pub work: u64,
    /// Bytes of a drawing under construction together with its derivation, or of a derivation together with its
    /// history.
    pub memory: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { symbols: 256 << 20, modules: 32 << 20, segments: 2_000_000, work: 100_000_000, memory: 1 << 30 }
    }
}

impl Limits {
    /// The limits of the page: a string that a browser can hold, and a drawing within its share of an instance's memory.
    pub const PAGE: Self =
        Self { symbols: 64 << 20, modules: 16 << 20, segments: u32::MAX as u64, work: 100_000_000, memory: 70 << 20 };

    /// The value of the limit called `name`.
    #[must_use]
    pub fn value(&self, name: LimitName) -> u64 {
        match name {
            LimitName::Symbols => self.symbols,
            LimitName::Modules => self.modules,
            LimitName::Segments | LimitName::PlotStrokes | LimitName::Mesh => self.segments,
            LimitName::MeshCopies => MAX_MESH_COPIES,
            LimitName::PlotBlocks => MAX_PLOT_BLOCKS,
            LimitName::Comparisons => MAX_COMPARISONS,
            LimitName::Work => self.work,
            LimitName::Memory => self.memory,
            LimitName::Iterations => u64::from(MAX_ITERATIONS),
            LimitName::Text => MAX_TEXT as u64,
            LimitName::Letters => MAX_LETTERS as u64,
            LimitName::Parameters => MAX_PARAMETERS as u64,
            LimitName::Context => MAX_CONTEXT as u64,
            LimitName::Actions => MAX_ACTIONS as u64,
        }
    }
}

/// The most derivation steps of a system.
pub const MAX_ITERATIONS: u32 = 1_000;
/// The most digits of the number of a segment: those of a successor with a thousand symbols after 1,000 steps.
pub const MAX_SEGMENT_DIGITS: usize = 3_001;

/// The most segments and vertices of polygons that a viewer of a mesh draws, copies of shared parts included. A segment
/// has 16 to 32 triangles, and viewers turn some ten million triangles smoothly.
pub const MAX_MESH_COPIES: u64 = 1_000_000;

/// The most bytes of a text: an axiom, rules, overrides, or a text in a foreign notation.
pub const MAX_TEXT: usize = 1 << 20;

/// The most predefined surfaces of a system.
pub const MAX_SURFACES: usize = 32;

/// The most bytes of the text of all surfaces.
pub const MAX_SURFACES_TEXT: usize = 20_000;

/// The most Bezier patches of a surface.
pub const MAX_SURFACE_PATCHES: usize = 16;

/// The most bytes of a system as JSON. The longest texts fit, even if every character is escaped.
pub const MAX_FILE: usize = 4 << 20;

/// The most colours in a palette.
pub const MAX_PALETTE: usize = 256;

/// The most bytes that counting takes for its intermediate numbers.
pub const MAX_COUNTING: u64 = 16 << 20;

/// The most pixels along a side of a picture. The program's PNG has this limit alone, because the picture is painted in
/// panes while it is written.
pub const MAX_PICTURE_SIDE: u32 = 1 << 15;

/// The most pixels that are painted at a time: of a whole picture, as on the page, or of a pane. They take up to 2 GB.
pub const MAX_PICTURE_PIXELS: u32 = 100_000_000;

/// The most blocks of a drawing that are read for a plotter: some seconds.
pub const MAX_PLOT_BLOCKS: u64 = 100_000_000;

/// The most comparisons of a plot's lines with what may hide them: some seconds, and ten times as
/// many as a large tree of broad strokes takes.
pub const MAX_COMPARISONS: u64 = 300_000_000;

/// The most different symbols in a system: a letter's number has 16 bits.
pub const MAX_LETTERS: usize = 1 << 16;

/// The most parameters of a module.
pub const MAX_PARAMETERS: usize = 8;

/// The most modules in a left or a right context, including brackets.
pub const MAX_CONTEXT: usize = 64;

/// The most actions of a symbol. One piece of work executes all actions of a symbol, so their number is bounded.
pub const MAX_ACTIONS: usize = 256;
