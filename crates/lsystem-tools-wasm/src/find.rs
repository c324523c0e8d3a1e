//! The search for the rules of a picture or a string.

use lsystem_base::words::said;
use lsystem_find::{Drawn, FOUND, Finder, Named, Photograph, Picture, Question, Searched, Share, StringFinder};
use lsystem_js::{from_js, to_js};
use lsystem_svg::SvgPicture;
use lsystem_syntax::Definition;
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use ts_rs::TS;
use wasm_bindgen::prelude::*;

/// The known properties of a system; missing or null ones are unknown.
#[derive(Deserialize, TS)]
pub(crate) struct FindQuestion {
    axiom: Option<String>,
    angle: Option<f64>,
    heading: Option<f64>,
    n: Option<u32>,
    draws: Option<String>,
}

impl FindQuestion {
    fn read(value: JsValue) -> Result<Question, JsValue> {
        let Self { axiom, angle, heading, n, draws } = from_js(value)?;
        Ok(Question { axiom, angle, heading, n, draws })
    }
}

/// A system that is tried before all others, with its name.
#[derive(Deserialize)]
pub(crate) struct NamedSystem {
    name: String,
    definition: Definition,
}

/// The form of a picture.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Form {
    width: usize,
    height: usize,
    is_straight: bool,
}

/// The result of a search so far.
#[derive(Serialize, TS)]
pub(crate) struct FindReport {
    candidates: Vec<Candidate>,
    searched: String,
}

/// A system that was found, or that comes close.
#[derive(Serialize, TS)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Candidate {
    definition: Definition,
    /// The name, if it is one of the systems with names that the search was given.
    name: Option<String>,
    /// Two candidates with equal keys are the same system.
    key: String,
    /// The symbols of its rules, with their predecessors.
    symbols: usize,
    /// The rank among systems that agree as well, smallest first.
    rank: usize,
    /// From 0 to 1; 1 only for the same picture.
    agreement: f64,
    is_found: bool,
}

/// The outline in an SVG as a shape in the notation, as [`lsystem_svg::outline_of_svg`]; undefined if it is no outline.
#[wasm_bindgen(js_name = outlineOfSvg)]
#[must_use]
pub fn outline_of_svg(bytes: &[u8]) -> Option<String> {
    lsystem_svg::outline_of_svg(bytes).ok()
}

/// A picture that is read for the search, as levels of grey.
#[wasm_bindgen]
pub struct GreyPicture {
    grey: Vec<u8>,
    width: usize,
    height: usize,
    left_out: String,
}

#[wasm_bindgen]
impl GreyPicture {
    /// Draws an SVG file, with counted work.
    ///
    /// # Errors
    /// Throws a sentence if it is not drawn.
    #[wasm_bindgen(js_name = ofSvg)]
    pub fn of_svg(bytes: &[u8]) -> Result<Self, JsValue> {
        let SvgPicture { grey, width, height, left_out, .. } =
            lsystem_svg::draw_svg(bytes).map_err(|error| error.message)?;
        Ok(Self { grey, width, height, left_out: left_out.into_iter().map(said).collect::<Vec<_>>().join(", ") })
    }

    /// Straightens a photograph, as [`Photograph::straightened`]; undefined if the picture is none.
    #[wasm_bindgen(js_name = ofPhotograph)]
    #[must_use]
    pub fn of_photograph(grey: &[u8], width: usize, height: usize) -> Option<Self> {
        let Photograph { grey, width, height } = Photograph::straightened(grey, width, height)?;
        Some(Self { grey, width, height, left_out: String::new() })
    }

    /// The levels of grey, row by row from above; 0 is black.
    #[must_use]
    pub fn grey(&self) -> Vec<u8> {
        self.grey.clone()
    }

    /// In pixels.
    #[wasm_bindgen(getter)]
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// In pixels.
    #[wasm_bindgen(getter)]
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// The names of what was not drawn, with commas; empty if all was.
    #[wasm_bindgen(getter, js_name = leftOut)]
    #[must_use]
    pub fn left_out(&self) -> String {
        self.left_out.clone()
    }
}

/// A search in the making.
#[wasm_bindgen]
pub struct RuleFinder {
    search: Search,
}

enum Search {
    Picture(Box<Finder>, Arc<Picture>),
    String(StringFinder),
}

#[wasm_bindgen]
impl RuleFinder {
    /// A search for the rules of a picture of levels of grey, row by row from above; 0 is black. `form` is `{width, height,
    /// isStraight}`: whether it is the ink of what [`GreyPicture::of_photograph`] gave. `part` is the index of this search, from 0, among `parts` that run in parallel. `question` is `{axiom, angle,
    /// heading, n, draws}`. `named` are the systems that are tried first, as `{name, definition}`; all searches are given the
    /// same ones.
    ///
    /// # Errors
    /// Throws a sentence if this cannot be searched.
    #[wasm_bindgen(js_name = ofPicture)]
    pub fn of_picture(
        grey: &[u8],
        form: JsValue,
        question: JsValue,
        part: u32,
        parts: u32,
        named: JsValue,
    ) -> Result<Self, JsValue> {
        let question = FindQuestion::read(question)?;
        let named: Vec<NamedSystem> = from_js(named)?;
        let Form { width, height, is_straight } = from_js(form)?;
        let picture = match is_straight {
            true => Photograph { grey: grey.to_vec(), width, height }.picture(),
            false => Picture::new(grey, width, height),
        };
        let picture = Arc::new(picture.map_err(said)?);
        let mut finder =
            Finder::new(&picture, &question, Share { index: part.into(), count: parts.max(1).into() }).map_err(said)?;
        finder.try_first(named.into_iter().map(|NamedSystem { name, definition }| Named { name, definition }));
        Ok(Self { search: Search::Picture(Box::new(finder), picture) })
    }

    /// A search for the rules of a string. `question` is as for pictures.
    ///
    /// # Errors
    /// Throws a sentence if this cannot be searched.
    #[wasm_bindgen(js_name = ofString)]
    pub fn of_string(text: &str, question: JsValue) -> Result<Self, JsValue> {
        let finder = StringFinder::new(text, &FindQuestion::read(question)?).map_err(said)?;
        Ok(Self { search: Search::String(finder) })
    }

    /// Tries about `work` systems, or reads about `work` symbols. Returns whether there is more to search.
    pub fn step(&mut self, work: u32) -> bool {
        let searched = match &mut self.search {
            Search::Picture(finder, _) => finder.step(work.into()),
            Search::String(finder) => finder.step(work as usize),
        };
        searched == Searched::More
    }

    /// The number of systems tried so far by all parallel searches of a picture, if each is as far as this one.
    #[must_use]
    pub fn tried(&self) -> f64 {
        match &self.search {
            Search::Picture(finder, _) => finder.tried() as f64,
            Search::String(_) => 0.0,
        }
    }

    /// Where the searched picture and the drawing of a system differ: a code for each pixel of 512 times 512, row by row
    /// from above: 1 for ink of both, 2 for ink of the picture only, 4 for ink of the system only. Nothing if the search is
    /// not of a picture, or if the system cannot be laid on it.
    ///
    /// # Errors
    /// Throws only if the definition cannot be translated.
    pub fn compared(&self, definition: JsValue) -> Result<Option<Vec<u8>>, JsValue> {
        let definition: Definition = from_js(definition)?;
        match &self.search {
            Search::Picture(_, picture) => Ok(picture.compared(&definition)),
            Search::String(_) => Ok(None),
        }
    }

    /// The candidates and the extent of the search so far, as `FindReport`.
    ///
    /// # Errors
    /// Throws only if the result cannot be translated.
    pub fn report(&self) -> Result<JsValue, JsValue> {
        let (found, searched) = match &self.search {
            Search::Picture(finder, _) => (finder.found().to_vec(), finder.searched()),
            Search::String(finder) => (finder.found(), finder.searched()),
        };
        let candidate = |drawn: &Drawn| Candidate {
            definition: drawn.definition(),
            name: drawn.named.as_ref().map(|named| named.name.clone()),
            key: drawn.key(),
            symbols: drawn.symbols(),
            rank: drawn.rank(),
            agreement: drawn.agreement,
            is_found: drawn.agreement >= FOUND,
        };
        let report = FindReport { candidates: found.iter().map(candidate).collect(), searched };
        to_js(&report)
    }
}
