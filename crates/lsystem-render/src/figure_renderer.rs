//! Pictures of figures: as a whole, or in bands from top to bottom, so that memory does not grow with the picture.

use crate::{Detail, Effort, Pane, Pass, Quality, Renderer, SolidRenderer, Spent, Vantage, Viewport};
use lsystem_base::Progress;
use lsystem_drawing::Figure;
use lsystem_syntax::{Ink, Style};

/// The side of a cell, in pixels. Panes that begin at multiples of this have the same subsamples as the whole picture.
const CELL: u32 = 16;

/// A picture to be made.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureOptions {
    /// The colours and strokes.
    pub style: Style,
    /// The size.
    pub viewport: Viewport,
    /// The place from which the drawing is seen.
    pub vantage: Vantage,
    /// If given, only the first `upto` segments are shown.
    pub upto: Option<u128>,
    /// The detail. In the plane all qualities up to [`Quality::MOVING`] are [`Detail::Coarse`], and the others
    /// [`Detail::Fine`]. A picture in several bands has all detail.
    pub quality: Quality,
    /// The most pixels that are painted at a time. A pixel takes up to [`BAND_PIXEL`] bytes. The choice changes some
    /// pixels by one subsample where a larger picture in the plane is painted in several bands.
    pub band: u32,
}

/// The most bytes that a pixel takes while it is painted: in the plane 18 1/4 bytes for the subsamples of the largest
/// palette and 4 for the amount of ink, or 16 for sums of ink; and 4 of its colour. Tiles and the parts of bottom-up pictures take as much in
/// pictures of any size.
pub const BAND_PIXEL: u64 = 28;

/// The outcome of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Painted {
    /// There are no new pixels yet.
    Nothing,
    /// The next rows, below those before.
    Rows,
    /// The whole picture: there are no more rows.
    All,
}

/// Makes pictures of figures, one after the other, in the same memory.
#[derive(Default)]
pub struct FigureRenderer {
    plane: Renderer,
    space: SolidRenderer,
    /// Whether the figure lies in space.
    is_solid: bool,
    picture: Option<PictureOptions>,
    /// The panes of the picture and their passes, in order. In space the panes share a budget, which is found in rounds
    /// of [`Pass::Count`].
    parts: Vec<(Pane, Pass)>,
    /// The part being made.
    next: usize,
    is_begun: bool,
    effort: Effort,
    /// The work of the panes of a round so far.
    spent: Spent,
    /// The pixels of a row of panes, if panes are not as wide as the picture.
    rows: Vec<u8>,
}

impl FigureRenderer {
    /// A renderer without a figure.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The renderer of pictures without the background, as [`Renderer::transparent`] and [`SolidRenderer::transparent`].
    #[must_use]
    pub fn transparent(self) -> Self {
        Self { plane: self.plane.transparent(), space: self.space.transparent(), ..self }
    }

    /// Takes the figure of the next pictures, and gives up a picture in the making. The steps of the first picture
    /// prepare the drawing.
    pub fn load(&mut self, figure: &Figure) {
        self.is_solid = figure.is_solid();
        match figure {
            Figure::Plane(drawing) => self.plane.load(drawing.clone()),
            Figure::Space(drawing) => self.space.load(drawing.clone()),
        }
        self.parts.clear();
    }

    /// Starts a picture of the loaded figure. An unfinished picture is given up.
    pub fn begin(&mut self, picture: PictureOptions) {
        self.parts = parts(&picture, self.is_solid);
        (self.next, self.is_begun) = (0, false);
        self.effort = Effort::new(picture.quality, picture.viewport);
        self.spent = Spent::default();
        self.rows.clear();
        if self.is_solid {
            self.space.play(picture.upto);
        }
        self.picture = Some(picture);
    }

    /// Goes on with the picture for about `work` units, as [`Meter`](lsystem_base::Meter) counts them, and for at most
    /// [`Meter::PIECE`](lsystem_base::Meter::PIECE) more.
    pub fn step(&mut self, work: u64) -> Painted {
        let (Some(&(pane, pass)), Some(picture)) = (self.parts.get(self.next), &self.picture) else {
            return Painted::All;
        };
        let width = picture.viewport.width;
        if !self.is_begun {
            self.begin_part(pane, pass);
        }
        let work = usize::try_from(work).unwrap_or(usize::MAX);
        let progress = if self.is_solid { self.space.step(work) } else { self.plane.step(work) };
        if progress == Progress::More {
            return Painted::Nothing;
        }
        self.is_begun = false;
        self.next += 1;
        if !pass.shows() {
            self.measure();
            return Painted::Nothing;
        }
        if pane.width < width {
            self.put(pane, width);
        }
        if pane.x + pane.width == width { Painted::Rows } else { Painted::Nothing }
    }

    fn begin_part(&mut self, pane: Pane, pass: Pass) {
        let Some(PictureOptions { style, viewport, vantage, upto, quality, .. }) = &self.picture else { return };
        self.is_begun = true;
        match (self.is_solid, pass) {
            (true, Pass::Only) => self.space.begin(style, *viewport, &vantage.camera, *quality),
            (true, _) => {
                self.space.begin_pane(style, *viewport, &vantage.camera, (pane, pass), self.effort.budget());
            }
            (false, Pass::Only) => {
                let detail = if *quality > Quality::MOVING { Detail::Fine } else { Detail::Coarse };
                self.plane.begin_with(style, *viewport, vantage.view, detail, *upto);
            }
            (false, _) => self.plane.begin_pane(style, *viewport, vantage.view, *upto, (pane, pass)),
        }
    }

    /// Adds the work of a pane in space. After a round of all panes the budget is found, or it grows for another round.
    fn measure(&mut self) {
        if !self.is_solid {
            return;
        }
        self.spent.add(self.space.effort_spent());
        let is_last = self.parts.get(self.next).is_none_or(|&(_, pass)| pass.shows());
        if is_last && self.effort.is_too_small(core::mem::take(&mut self.spent)) {
            self.next = 0;
        }
    }

    /// Copies the pixels of a pane into its row of panes; `width` is that of the picture.
    fn put(&mut self, pane: Pane, width: u32) {
        let [width, pane_width, x] = [width, pane.width, pane.x].map(|side| 4 * side as usize);
        self.rows.resize(width * pane.height as usize, 0);
        let rows = self.space.pixels().chunks_exact(pane_width.max(1));
        for (row, pixels) in self.rows.chunks_exact_mut(width.max(1)).zip(rows) {
            row[x..x + pane_width].copy_from_slice(pixels);
        }
    }

    /// The rows painted last: RGBA, 8 bits each, opaque unless [`transparent`](Self::transparent), from the left upper
    /// corner row by row.
    #[must_use]
    pub fn pixels(&self) -> &[u8] {
        match (self.rows.is_empty(), self.is_solid) {
            (false, _) => &self.rows,
            (true, true) => self.space.pixels(),
            (true, false) => self.plane.pixels(),
        }
    }

    /// The units of work of all steps so far.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.plane.spent() + self.space.spent()
    }
}

/// The panes of a picture and their passes: the whole picture, or bands in the plane and tiles in space.
fn parts(picture: &PictureOptions, is_solid: bool) -> Vec<(Pane, Pass)> {
    let &PictureOptions { ref style, viewport, band, .. } = picture;
    let Viewport { width, height, .. } = viewport;
    if u64::from(width) * u64::from(height) <= u64::from(band) {
        return vec![(Pane::whole(viewport), Pass::Only)];
    }
    if !is_solid {
        return Pass::all(style.ink, viewport, [width, (band / width / CELL * CELL).max(CELL)]);
    }
    let panes = SolidRenderer::panes(viewport);
    let round = |pass| panes.iter().map(move |&pane| (pane, pass));
    let survey = (style.ink == Ink::Density).then(|| (Pane::whole(viewport), Pass::Survey));
    survey.into_iter().chain(round(Pass::Count)).chain(round(Pass::Show)).collect()
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use lsystem_base::{Limits, MAX_PALETTE};
    use lsystem_drawing::{System, draw};
    use lsystem_syntax::{Colour, Definition};

    /// All rows of a picture.
    pub(crate) fn paint(renderer: &mut FigureRenderer, picture: PictureOptions) -> Vec<u8> {
        renderer.begin(picture);
        let mut pixels = vec![];
        loop {
            match renderer.step(10_000) {
                Painted::Nothing => {}
                Painted::Rows => pixels.extend_from_slice(renderer.pixels()),
                Painted::All => return pixels,
            }
        }
    }

    #[test]
    fn bands_are_the_picture_of_the_first_segments() {
        let viewport = Viewport { width: 600, height: 300, ratio: 1.0 };
        let mut renderer = FigureRenderer::new();
        // The same renderer paints figures in both spaces.
        for rules in ["A -> F[+FA][-FA]", "A -> F[&FA]/[&FA]", "A -> F[+FA]-A"] {
            let definition =
                Definition { axiom: "A".into(), rules: rules.into(), angle: 40.0, ..Definition::default() };
            let figure = Figure::draw(&System::new(&definition).unwrap(), 7, &Limits::default()).unwrap();
            renderer.load(&figure);
            let mut paint = |upto, band| {
                let (style, vantage, quality) = (Style::default(), Vantage::default(), Quality::BEST);
                paint(&mut renderer, PictureOptions { style, viewport, vantage, upto, quality, band })
            };
            let (all, part) = (paint(None, u32::MAX), paint(Some(60), u32::MAX));
            assert!(all != part && all.len() == 4 * 600 * 300, "{rules}");
            for (upto, whole) in [(None, all), (Some(60), part)] {
                let bands = paint(upto, 600 * 48);
                let differ = bands.iter().zip(&whole).filter(|(a, b)| a != b).count();
                // In the plane bands round the places of strokes in another way: some strokes are off by a subsample.
                let allowed = if figure.is_solid() { 0 } else { whole.len() / 500 };
                assert!(bands.len() == whole.len() && differ <= allowed, "{rules} {upto:?}: {differ}");
            }
        }
    }

    #[test]
    fn a_pixel_takes_no_more_than_its_share() {
        let definition = Definition { axiom: "F".into(), rules: "F -> F+F".into(), ..Definition::default() };
        let drawing = draw(&System::new(&definition).unwrap(), 5, &Limits::default()).unwrap();
        let [small, large] = [[2048, 64], [2048, 1088]].map(|[width, height]| Viewport { width, height, ratio: 1.0 });
        let each = Ink::ALL.map(|ink| {
            let palette = vec![Colour { rgb: [0; 3] }; MAX_PALETTE];
            let style = Style { palette, ink, ..Style::default() };
            let [small, large] =
                [small, large].map(|viewport| Renderer::most_bytes(&drawing, &style, viewport, Detail::Fine));
            (large - small).div_ceil(2048 * 1024)
        });
        assert!(each.iter().all(|each| (BAND_PIXEL - 8..=BAND_PIXEL).contains(each)), "{each:?}");
        assert!(each.contains(&(BAND_PIXEL - 1)), "{each:?}");
    }
}
