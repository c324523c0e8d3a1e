//! The values of options.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use lsystem::base::fixed::Fixed;
use lsystem::base::words::said;
use lsystem::base::{MAX_PICTURE_SIDE, decimal, say};
use lsystem::course::ScormStandard;
use lsystem::drawing::Origin;
use lsystem::files::{FORMATS, Format};
use lsystem::film::{Easing, Ending};
use lsystem::import::write::{NOTATIONS, Notation};
use lsystem::render::{MAX_ZOOM, TilePlace, TileShare};
use std::str::FromStr;

/// A magnification as `--zoom` reads it.
pub(super) fn magnification(text: &str) -> Result<f64, String> {
    let zoom = decimal::read(text).filter(|zoom| (1e-2..=MAX_ZOOM).contains(zoom));
    zoom.ok_or_else(|| say!("a number from 0.01 to 1e301 is expected"))
}

/// A place on a segment, from the segment's number from 1.
pub(super) fn segment(text: &str) -> Result<Origin, String> {
    Origin::read(text).ok_or_else(|| say!("expected a number of a segment, from 1"))
}

/// The first and the last level of a pyramid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Levels(pub(crate) u32, pub(crate) u32);

impl FromStr for Levels {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let levels = text.split_once("..").and_then(|(from, to)| Some(Self(from.parse().ok()?, to.parse().ok()?)));
        let is_possible = |levels: &Self| levels.0 <= levels.1 && levels.1 <= TilePlace::MAX_LEVEL;
        levels.filter(is_possible).ok_or_else(|| say!("expected levels such as 0..8, at most {}", TilePlace::MAX_LEVEL))
    }
}

/// The names of a pyramid's files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Scheme {
    Deepzoom,
    Xyz,
}

impl Scheme {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Deepzoom => "deepzoom",
            Self::Xyz => "xyz",
        }
    }
}

/// A part of a pyramid.
pub(super) fn share(text: &str) -> Result<TileShare, String> {
    let share = text.split_once('/').and_then(|(part, of)| TileShare::new(part.parse().ok()?, of.parse().ok()?));
    share.ok_or_else(|| say!("expected a part such as 0/4, the first of four"))
}

/// The tile that all tiles to make are above or below.
pub(super) fn tile(text: &str) -> Result<TilePlace, String> {
    let mut parts = text.split('/').map(str::parse::<u64>);
    let mut next = || parts.next()?.ok();
    let tile = (|| TilePlace::new(next()?.try_into().ok()?, next()?, next()?))();
    tile.filter(|_| parts.next().is_none()).ok_or_else(|| {
        say!("expected a tile such as 3/0/7: the level, at most {}, the column and the row", TilePlace::MAX_LEVEL)
    })
}

pub(super) fn tile_size(text: &str) -> Result<u32, String> {
    let size = text.parse().ok().filter(|size| matches!(size, 256 | 512));
    size.ok_or_else(|| say!("expected 256 or 512"))
}

/// The segment at the end of a dive, from 1; `None` for the one in the middle.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Dive(pub(crate) Option<Fixed>);

impl FromStr for Dive {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text.is_empty() {
            return Ok(Self(None));
        }
        segment(text).map(|origin| Self(Some(origin.segment)))
    }
}

/// An [`Ending`] by its name.
pub(super) fn ending(text: &str) -> Result<Ending, String> {
    Ending::named(text).ok_or_else(|| say!("expected one of {}", Ending::NAMES.join(", ")))
}

/// An [`Easing`] by its name.
pub(super) fn easing(text: &str) -> Result<Easing, String> {
    Easing::named(text).ok_or_else(|| say!("expected one of {}", Easing::NAMES.join(", ")))
}

/// A parser for the names of [`FORMATS`].
pub(super) fn formats() -> impl TypedValueParser<Value = &'static Format> {
    let values = FORMATS.iter().map(|format| PossibleValue::new(format.name).help(said(format.help)));
    PossibleValuesParser::new(values).try_map(|name| Format::named(&name).ok_or("there is no such format"))
}

/// A parser for the names of [`ScormStandard::ALL`].
pub(super) fn standards() -> impl TypedValueParser<Value = ScormStandard> {
    let names = PossibleValuesParser::new(ScormStandard::ALL.map(ScormStandard::name));
    names.try_map(|name| ScormStandard::named(&name).ok_or("there is no such standard"))
}

pub(super) fn notations() -> impl TypedValueParser<Value = &'static Notation> {
    let values = NOTATIONS.iter().map(|notation| PossibleValue::new(notation.name).help(said(notation.help)));
    PossibleValuesParser::new(values).try_map(|name| Notation::named(&name).ok_or("there is no such notation"))
}

/// The size of a picture, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PictureSize {
    pub(crate) width: u32,
    pub(crate) height: u32,
}

impl FromStr for PictureSize {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let sides = text.split_once('x').and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
        let (width, height) = sides.ok_or_else(|| say!("expected a width and a height such as 1600x1200"))?;
        let sides = 1..=MAX_PICTURE_SIDE;
        if !sides.contains(&width) || !sides.contains(&height) {
            return Err(say!("expected 1 to {} pixels each way", MAX_PICTURE_SIDE));
        }
        Ok(Self { width, height })
    }
}

pub(crate) fn whole(text: &str, most: u32) -> Result<u32, String> {
    let number = text.parse().ok().filter(|&number| number <= most);
    number.ok_or_else(|| say!("expected a whole number from 0 to {}", most))
}

pub(super) fn setting(text: &str) -> Result<(String, String), String> {
    let (name, value) = text.split_once('=').ok_or_else(|| say!("expected a name and a value such as angle_deg=30"))?;
    Ok((name.to_owned(), value.to_owned()))
}
