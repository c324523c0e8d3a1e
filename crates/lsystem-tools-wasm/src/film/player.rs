//! A film whose frames are made in steps.

use super::words;
use lsystem_base::Progress;
use lsystem_drawing::Origin;
use lsystem_film::{Film, GifWriter, LIMITS, Painter, PaletteMaker, Script, Subject, palette_samples};
use lsystem_js::{from_js, to_js};
use lsystem_render::{Detail, PageCamera, PageView, Vantage};
use lsystem_syntax::{Definition, Diagnostic};
use serde::Serialize;
use wasm_bindgen::prelude::*;

/// The frames whose colours make a palette: their numbers and their size in pixels.
#[derive(Serialize)]
struct Samples {
    numbers: Vec<u32>,
    width: u32,
    height: u32,
}

/// A GIF in the making.
enum Gif {
    None,
    /// Frames whose colours make the palette.
    Colours(PaletteMaker),
    Frames(Box<GifWriter>, lsystem_film::Palette),
}

/// A film, and its frame in the making.
#[wasm_bindgen]
pub struct FilmPlayer {
    film: Film,
    /// The place on a segment that is the origin of the view with which the film begins.
    segment: Option<Origin>,
    painter: Painter,
    gif: Gif,
}

/// A problem of a frame in words.
fn problem(error: &Diagnostic) -> JsValue {
    let hint = error.hint.as_ref().map_or_else(String::new, |hint| format!(" {hint}"));
    format!("{}{hint}", error.message).into()
}

/// The script of a text. The first view is about `segment`, unless the script has views of its own.
fn script(text: &str, segment: Option<&Origin>) -> Result<Script, JsValue> {
    let mut script: Script = text.parse().map_err(words)?;
    if script.segment.is_none() && script.tracks.iter().all(|track| track.subject != Subject::View) {
        script.segment = segment.cloned();
    }
    Ok(script)
}

#[wasm_bindgen]
impl FilmPlayer {
    /// A film of a definition, which begins with a view and a camera (null for the usual ones), by its text.
    ///
    /// # Errors
    /// Throws the words of the first problem.
    #[wasm_bindgen(constructor)]
    pub fn new(definition: JsValue, view: JsValue, camera: JsValue, text: &str) -> Result<Self, JsValue> {
        let definition: Definition = from_js(definition)?;
        let view = from_js::<Option<PageView>>(view)?;
        let segment = view.as_ref().and_then(PageView::origin);
        let view = view.map(Into::into).unwrap_or_default();
        let camera = from_js::<Option<PageCamera>>(camera)?.map(Into::into).unwrap_or_default();
        let script = script(text, segment.as_ref())?;
        let film = Film::new(script, definition, Vantage { view, camera }).map_err(words)?;
        Ok(Self { film, segment, painter: Painter::new(LIMITS), gif: Gif::None })
    }

    /// Changes the film's text, and keeps the drawing.
    ///
    /// # Errors
    /// As [`FilmPlayer::new`].
    pub fn change(&mut self, text: &str) -> Result<(), JsValue> {
        let script = script(text, self.segment.as_ref())?;
        self.film = self.film.with(script).map_err(words)?;
        Ok(())
    }

    /// Starts a frame of `width` x `height` pixels, in coarse detail for a preview of large drawings.
    ///
    /// # Errors
    /// Throws the words of the first error of the frame's system.
    pub fn begin(&mut self, number: u32, width: u32, height: u32, is_coarse: bool) -> Result<(), JsValue> {
        let detail = if is_coarse { Detail::Coarse } else { Detail::Fine };
        let frame = self.film.frame(number);
        self.painter.begin(&frame, [width, height], detail).map_err(|error| problem(&error))
    }

    /// Goes on with the frame for about `work` units. Returns whether it is finished.
    ///
    /// # Errors
    /// Throws the words of the limit that the frame's drawing exceeds.
    pub fn step(&mut self, work: u32) -> Result<bool, JsValue> {
        let progress = self.painter.step(u64::from(work)).map_err(|error| problem(&error))?;
        Ok(progress == Progress::Done)
    }

    /// The pixels of the finished frame: RGBA, row by row.
    #[must_use]
    pub fn pixels(&self) -> Vec<u8> {
        self.painter.pixels().to_vec()
    }

    /// The text of a film with a dive in place of its presets: to a view of the finished frame's drawing about a segment,
    /// or to the segment in the middle if the view is null. Null if the drawing has no such segment.
    ///
    /// # Errors
    /// Throws the words of the first problem of the text.
    pub fn dive(&self, text: &str, view: JsValue) -> Result<Option<String>, JsValue> {
        let script: Script = text.parse().map_err(words)?;
        let view = from_js::<Option<PageView>>(view)?;
        let Some(figure) = self.painter.figure() else { return Ok(None) };
        let segment = view.as_ref().and_then(PageView::origin);
        let script = script.with_dive(figure, segment, view.map(Into::into), &self.film.frame(0).vantage);
        Ok(script.map(|script| script.to_string()))
    }

    /// The frames to count before the first one is added to a GIF: `{numbers, width, height}`.
    ///
    /// # Errors
    /// Throws only if the result cannot be translated.
    #[wasm_bindgen(js_name = paletteSamples)]
    pub fn palette_samples(&self) -> Result<JsValue, JsValue> {
        let (numbers, [width, height]) = palette_samples(self.film.script());
        to_js(&Samples { numbers, width, height })
    }

    /// Begins a GIF: counts the colours of the finished frame, one of [`FilmPlayer::palette_samples`].
    #[wasm_bindgen(js_name = countColours)]
    pub fn count_colours(&mut self) {
        if !matches!(self.gif, Gif::Colours(_)) {
            self.gif = Gif::Colours(PaletteMaker::default());
        }
        if let Gif::Colours(maker) = &mut self.gif {
            maker.add(self.painter.pixels());
        }
    }

    /// Adds the finished frame to the GIF, and returns the next bytes of the file.
    ///
    /// # Errors
    /// Throws if the frame has another size.
    #[wasm_bindgen(js_name = addToGif)]
    pub fn add_to_gif(&mut self, number: u32) -> Result<Vec<u8>, JsValue> {
        let script = self.film.script();
        self.gif = match core::mem::replace(&mut self.gif, Gif::None) {
            Gif::Colours(maker) => {
                let palette = maker.finish();
                let writer = GifWriter::new(script.size, script.ending, palette.clone()).map_err(words)?;
                Gif::Frames(Box::new(writer), palette)
            }
            other => other,
        };
        let Gif::Frames(writer, palette) = &mut self.gif else { return Err("no colours are counted".into()) };
        writer.add(&palette.index(self.painter.pixels()), script.delay_of(number)).map_err(words)?;
        Ok(writer.take())
    }

    /// Ends the GIF, and returns its last bytes.
    ///
    /// # Errors
    /// Throws only if memory is full.
    #[wasm_bindgen(js_name = endGif)]
    pub fn end_gif(&mut self) -> Result<Vec<u8>, JsValue> {
        match core::mem::replace(&mut self.gif, Gif::None) {
            Gif::Frames(writer, _) => writer.finish().map_err(words),
            _ => Ok(Vec::new()),
        }
    }
}
