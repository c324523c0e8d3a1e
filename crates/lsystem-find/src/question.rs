//! What the asker knows of a system.

/// The known properties of a system; `None` stands for an unknown one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Question {
    /// Letters, turns and branches.
    pub axiom: Option<String>,
    /// In degrees.
    pub angle: Option<f64>,
    /// The first heading, in degrees counter-clockwise from the right.
    pub heading: Option<f64>,
    /// The number of derivation steps.
    pub n: Option<u32>,
    /// The letters that draw.
    pub draws: Option<String>,
}
