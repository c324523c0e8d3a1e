//! What readers of a derivation are told. Numbers that may be large are decimal digits; all numbers count from 0.

use serde::Serialize;
use ts_rs::TS;

/// A place relative to the origin of the view, usually the fitted centre, in fitted extents. In the plane: right, up, and a small correction of each. In
/// space: along the three axes of the model.
pub type Place = Vec<f64>;

/// A page of a generation's string.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct StringPage {
    /// The number of symbols of the generation; null if the number is not known.
    pub length: Option<String>,
    /// The symbols of the page; null if the generation is too long to derive.
    pub text: Option<String>,
    /// Whether each symbol ends with a line end, because some have arguments or names in backquotes.
    pub apart: bool,
}

/// One link of the chain from the axiom to a symbol.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct AncestryLink {
    /// The generation of the symbol.
    pub generation: u32,
    /// The symbol, with its arguments in parentheses, if any.
    pub symbol: String,
    /// The position of the symbol in its generation.
    pub index: String,
    /// The production that made the symbol; null if the symbol was copied or stands in the axiom.
    pub production: Option<usize>,
    /// The position in the successor, or in the axiom.
    pub position: usize,
}

/// The descendants of a symbol in a later generation, as half-open ranges.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct Descendants {
    /// The positions of the symbols.
    pub symbols: [String; 2],
    /// The numbers of the segments.
    pub segments: [String; 2],
    /// In the plane the corners of a convex outline of the segments; in space the ends of a single segment.
    pub outline: Vec<Place>,
}

/// A symbol's ancestors, and its descendants in the shown generation.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct SymbolFacts {
    /// The chain from the axiom; empty if the derivation is too long to be remembered.
    pub ancestry: Vec<AncestryLink>,
    /// Null if the derivation is too long to be remembered.
    pub part: Option<Descendants>,
    /// The first segment of the part.
    pub stroke: Option<SegmentFacts>,
}

/// A segment, and the turtle there.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
#[serde(rename_all = "camelCase")]
pub struct SegmentFacts {
    /// The start, in model units.
    pub from: Vec<f64>,
    /// The end, in model units.
    pub to: Vec<f64>,
    /// The start.
    pub fitted_from: Place,
    /// The end.
    pub fitted_to: Place,
    /// The direction from start to end.
    pub heading: Direction,
    /// The branch level.
    pub level: u32,
    /// The colour index, not wrapped to the palette.
    pub colour: i32,
}

/// A heading.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, TS)]
#[serde(untagged)]
pub enum Direction {
    /// In the plane: degrees counter-clockwise from the right.
    Degrees(f64),
    /// In space: a unit vector.
    Vector([f64; 3]),
}

/// A polygon.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct PolygonFacts {
    /// The vertices.
    pub outline: Vec<Place>,
    /// The branch level.
    pub level: u32,
    /// The colour index, not wrapped to the palette.
    pub colour: i32,
}

/// The mark under the pointer; all null or empty if there is none.
#[derive(Clone, Debug, Default, PartialEq, Serialize, TS)]
pub struct Picked {
    /// The number of the segment, if the mark is a segment.
    pub segment: Option<String>,
    /// The number of the polygon, if the mark is a polygon.
    pub polygon: Option<String>,
    /// The position of the symbol that draws the segment or opens the polygon; null if the generation cannot be read.
    pub symbol: Option<String>,
    /// The chain from the axiom to the symbol.
    pub ancestry: Vec<AncestryLink>,
    /// The segment.
    pub stroke: Option<SegmentFacts>,
    /// The polygon.
    pub filled: Option<PolygonFacts>,
}

/// A place on a segment as the origin of views.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct Anchor {
    /// The segment's number, from 1, and decimals for the part of the segment before the place.
    pub at: String,
    /// The place, from the origin of the present view.
    pub place: Place,
}

/// The turtle after the shown segments.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct Pose {
    /// Its place, in model units.
    pub at: Vec<f64>,
    /// Its place.
    pub fitted: Place,
    /// Its heading.
    pub heading: Direction,
    /// The branch level.
    pub level: u32,
}
