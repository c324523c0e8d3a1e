//! Sheets of paper: sizes, margins and the place of a drawing on them.

/// Millimetres of an inch.
pub const INCH: f64 = 25.4;
/// The least part of a sheet's side that is left between the margins.
const LEAST: f64 = 0.1;

/// A sheet of paper. All lengths are in millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sheet {
    /// From left to right.
    pub width: f64,
    /// From top to bottom.
    pub height: f64,
    /// On every side.
    pub margin: f64,
}

/// The named sizes in portrait, in millimetres: ISO 216, and the sizes of North America (ANSI/ASME Y14.1).
pub const SHEETS: [(&str, f64, f64); 8] = [
    ("a5", 148.0, 210.0),
    ("a4", 210.0, 297.0),
    ("a3", 297.0, 420.0),
    ("a2", 420.0, 594.0),
    ("a1", 594.0, 841.0),
    ("letter", 215.9, 279.4),
    ("legal", 215.9, 355.6),
    ("tabloid", 279.4, 431.8),
];

impl Default for Sheet {
    /// A4 in portrait, with margins of 10 mm.
    fn default() -> Self {
        Self { width: 210.0, height: 297.0, margin: 10.0 }
    }
}

impl Sheet {
    /// The sheet with this name in portrait, such as `a4`, with margins of 10 mm.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let (_, width, height) = SHEETS.into_iter().find(|(own, ..)| *own == name)?;
        Some(Self { width, height, ..Self::default() })
    }

    /// The same sheet turned by 90 degrees.
    #[must_use]
    pub fn turned(self) -> Self {
        Self { width: self.height, height: self.width, ..self }
    }

    /// The width and the height between the margins: at least a tenth of the sheet.
    #[must_use]
    pub fn inner(&self) -> (f64, f64) {
        let side = |side: f64| (side - 2.0 * self.margin).max(side * LEAST);
        (side(self.width), side(self.height))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sheets_have_margins() {
        assert_eq!(Sheet::named("a4"), Some(Sheet::default()));
        assert_eq!(Sheet::default().turned().inner(), (277.0, 190.0));
        let (width, height) = Sheet { margin: 500.0, ..Sheet::default() }.inner();
        assert!((width - 21.0).abs() < 1e-9 && (height - 29.7).abs() < 1e-9);
        assert_eq!(Sheet::named("a99"), None);
    }
}
