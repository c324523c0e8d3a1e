//! Drawings as bodies in millimetres that a printer in space can make: no wall is too thin, all stand on the ground, a
//! foot carries them, and no layer between the ground and the top is empty.

use crate::FileOptions;
use lsystem_base::words::{grouped, shown};
use lsystem_base::{counted, say};
use lsystem_drawing::{Drawing, Figure, Mesh, MeshForm, MeshOptions, MeshParts, Solid, Space};
use lsystem_syntax::{Diagnostic, Halt, Style, Work};

/// The longest side, if no height is asked for.
const LONGEST: f64 = 100.0;
/// The thinnest wall by default: two lines of a nozzle of 0.4 mm.
pub(crate) const THINNEST: f64 = 0.8;
/// The reach of the foot by default.
pub(crate) const FOOT: f64 = 5.0;
/// The height of the foot, and the width of its slanted rim.
const FOOT_HEIGHT: f64 = 1.0;
const RIM: f64 = 0.5;
/// The height at which the section is told: the middle of a first layer.
const FIRST_LAYER: f32 = 0.1;
/// The least gap between bodies, upwards, that gets a post; its width, and its depth in the bodies.
const GAP: f32 = 0.02;
const POST: f64 = 1.2;
const DEPTH: f64 = 0.3;
/// The most strokes whose widths are read before a file is made.
const STROKES: u128 = 500_000;
/// The units of work for a triangle.
const WORK: u64 = 2;

type Corner = [f32; 3];

/// Closed bodies in millimetres, z up, on z = 0. Bodies in pieces may reach below, which their file cuts off.
#[derive(Clone, Debug, Default)]
pub struct Print {
    /// The corners: x, y, z. Some belong to no triangle.
    pub corners: Vec<Corner>,
    /// The indices of three corners each, counter-clockwise as seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// The index of each body's first triangle.
    pub bodies: Vec<u32>,
    /// The area of the section in the middle of the first layer, in square millimetres. Overlaps count twice.
    pub section: f64,
    /// A warning about strokes that are made thicker.
    pub remark: Option<Diagnostic>,
}

impl Print {
    /// The bodies of a drawing: a chain of strokes is one body, or with `in_pieces` each stroke and each triangle of a
    /// polygon is a convex body.
    ///
    /// # Errors
    /// As [`MeshParts::new`].
    pub fn new(
        drawing: &Drawing<Solid>,
        style: &Style,
        options: &FileOptions,
        in_pieces: bool,
        work: &mut dyn Work,
    ) -> Result<Self, Halt> {
        let &FileOptions { most, memory, height, thinnest, finest, foot, .. } = options;
        let [low, high] = drawing.bounds().unwrap_or_default();
        let sides = [0, 1, 2].map(|axis| high[axis] - low[axis]);
        let longest = sides.into_iter().fold(0.0, f64::max);
        let height = Some(height).filter(|&height| height > 0.0 && sides[1] > 0.0);
        let (wanted, side) = height.map_or((LONGEST, longest), |height| (height, sides[1]));
        // The width in the model. Tubes reach beyond their axes, at joints by up to three quarters of their width.
        let among_wide = (side + 1.5 * drawing.widest_stroke()) / wanted;
        let among_thin = side / (wanted - 2.5 * thinnest).max(0.5 * wanted);
        let thin = thinnest * among_wide.max(among_thin);
        let thinnest_part = if longest > 0.0 { finest.max(thin / longest) } else { 0.0 };
        let form = MeshForm::Printed { in_pieces };
        let options = MeshOptions { form, most, memory, thinnest: thinnest_part, whole: 0 };
        let parts = MeshParts::new(drawing, style, &options, work)?;
        let ((count, width), ground) = (parts.thin, parts.ground);
        let Mesh { positions: corners, triangles, .. } = parts.into_first();
        let mut print = Self { corners, triangles, ..Self::default() };
        let scale = print.stand(ground, height, in_pieces);
        print.find_bodies(work)?;
        print.join(work)?;
        print.carry(foot, work)?;
        if count > 0 && thinnest > 0.0 {
            let [message, hint] = thin_words(count, thinnest, print.bounds()[2][1] * thinnest / (width * scale));
            print.remark = Some(Diagnostic::warning(message).hint(hint));
        }
        Ok(print)
    }

    /// The least and the greatest x, y and z.
    fn bounds(&self) -> [[f64; 2]; 3] {
        let mut bounds = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
        for corner in self.triangles.iter().flatten().map(|&corner| self.corners[corner as usize]) {
            for (bound, value) in bounds.iter_mut().zip(corner.map(f64::from)) {
                *bound = [bound[0].min(value), bound[1].max(value)];
            }
        }
        bounds
    }

    /// The print in words.
    #[must_use]
    pub fn words(&self) -> String {
        let [x, y, z] = [0, 1, 2].map(|axis| {
            let [least, most] = self.bounds()[axis];
            let least = if axis == 2 { 0.0 } else { least };
            shown(&format!("{:.1}", (most - least).max(0.0)))
        });
        let area = shown(&format!("{:.1}", self.section));
        say!("print of {} x {} x {} mm, stands on {} mm² (section at 0.1 mm)", x, y, z, area)
    }

    /// Turns y up to z up, and gives the bodies their size: the height, or the longest side. What lies below the ground is
    /// pressed flat, but not of bodies in pieces. Returns the scale.
    fn stand(&mut self, ground: f64, height: Option<f64>, in_pieces: bool) -> f64 {
        let bound = |axis: usize, start: f32, pick: fn(f32, f32) -> f32| {
            f64::from(self.corners.iter().map(|corner| corner[axis]).fold(start, pick))
        };
        let high = [0, 1, 2].map(|axis| bound(axis, f32::NEG_INFINITY, f32::max));
        let low = [bound(0, f32::INFINITY, f32::min), ground, bound(2, f32::INFINITY, f32::min)];
        let scale = |axis: usize, side: f64| side / (high[axis] - low[axis]);
        let scale = match height {
            Some(height) => scale(1, height),
            None => [0, 1, 2].map(|axis| scale(axis, LONGEST)).into_iter().fold(f64::INFINITY, f64::min),
        };
        let least = if in_pieces { f64::NEG_INFINITY } else { 0.0 };
        for corner in &mut self.corners {
            let [x, y, z] = corner.map(f64::from);
            let placed = [(x - low[0]) * scale, (high[2] - z) * scale, ((y - low[1]) * scale).max(least)];
            *corner = placed.map(|c| c as f32);
        }
        scale
    }

    /// Finds the bodies: they have no corner in common, and their corners follow each other.
    fn find_bodies(&mut self, work: &mut dyn Work) -> Result<(), Halt> {
        let mut next = 0;
        for (at, triangle) in self.triangles.iter().enumerate() {
            work.charge(WORK)?;
            if triangle.iter().all(|&corner| corner >= next) {
                self.bodies.push(at as u32);
            }
            next = triangle.iter().fold(next, |next, &corner| next.max(corner + 1));
        }
        Ok(())
    }

    /// A triangle that crosses a height, beginning with the corner that is alone on its side, and whether that side is
    /// above.
    fn odd_first(&self, triangle: [u32; 3], height: f32) -> Option<(bool, [u32; 3])> {
        let above = triangle.map(|corner| self.corners[corner as usize][2] > height);
        let is_above = above.iter().filter(|&&is_above| is_above).count() == 1;
        let at = above.iter().position(|&side| side == is_above)?;
        (above[0] != above[1] || above[1] != above[2])
            .then(|| (is_above, [0, 1, 2].map(|corner| triangle[(at + corner) % 3])))
    }

    /// The point of an edge at a height.
    fn crossing(&self, from: u32, to: u32, height: f32) -> Corner {
        let [from, to] = [from, to].map(|corner| self.corners[corner as usize]);
        let part = (height - from[2]) / (to[2] - from[2]);
        [from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1]), height]
    }

    /// Puts a post into each gap between bodies, so that no layer is empty.
    fn join(&mut self, work: &mut dyn Work) -> Result<(), Halt> {
        let mut ends: Vec<[Corner; 2]> = vec![];
        for (body, &start) in self.bodies.iter().enumerate() {
            let end = self.bodies.get(body + 1).map_or(self.triangles.len(), |&end| end as usize);
            let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
            for triangle in &self.triangles[start as usize..end] {
                work.charge(WORK)?;
                for at in triangle.map(|corner| self.corners[corner as usize]) {
                    low = if at[2] < low[2] { at } else { low };
                    high = if at[2] > high[2] { at } else { high };
                }
            }
            ends.push([low, high]);
        }
        ends.sort_by(|[a, _], [b, _]| a[2].total_cmp(&b[2]));
        let mut top = ends.first().map_or([0.0; 3], |&[[x, y, _], _]| [x, y, 0.0]);
        for [low, high] in ends {
            if low[2] > top[2] + GAP {
                let [from, to] = [top, low].map(|corner| corner.map(f64::from));
                let side = [POST, POST];
                self.block([
                    ([from[0], from[1]], side, (from[2] - DEPTH).max(0.0)),
                    ([to[0], to[1]], side, to[2] + DEPTH),
                ]);
            }
            top = if high[2] > top[2] { high } else { top };
        }
        Ok(())
    }

    /// Puts a foot under bodies that touch the ground with less than half of its area. It reaches beyond them, but not
    /// beyond the longest side.
    fn carry(&mut self, reach: f64, work: &mut dyn Work) -> Result<(), Halt> {
        let (mut twice, mut low, mut high) = (0.0, [f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for &triangle in &self.triangles {
            work.charge(WORK)?;
            let Some((is_above, [a, b, c])) = self.odd_first(triangle, FIRST_LAYER) else { continue };
            let [p, q] =
                [self.crossing(a, b, FIRST_LAYER), self.crossing(c, a, FIRST_LAYER)].map(|at| at.map(f64::from));
            let area = p[0] * q[1] - p[1] * q[0];
            twice += if is_above { area } else { -area };
            for axis in 0..2 {
                low[axis] = low[axis].min(p[axis]).min(q[axis]);
                high[axis] = high[axis].max(p[axis]).max(q[axis]);
            }
        }
        self.section = 0.5 * f64::abs(twice);
        let bounds = self.bounds();
        let sides = [0, 1].map(|axis| {
            let [least, most] = bounds[axis];
            // A thin model stands on a broader foot.
            let edge = if most - least > 2.0 * reach { [least, most] } else { [f64::NEG_INFINITY, f64::INFINITY] };
            [(low[axis] - reach).max(edge[0]), (high[axis] + reach).min(edge[1])]
        });
        let [middle, sides] = [sides.map(|[from, to]| 0.5 * (from + to)), sides.map(|[from, to]| to - from)];
        let area = sides[0] * sides[1];
        if reach > 0.0 && area.is_finite() && self.section < 0.5 * area {
            let top = sides.map(|side| side - 2.0 * RIM.min(0.25 * side));
            self.block([(middle, sides, 0.0), (middle, top, FOOT_HEIGHT)]);
            self.section = area;
        }
        Ok(())
    }

    /// Adds a body between two rectangles, the lower one first: the middle, the sides and the height of each.
    fn block(&mut self, ends: [([f64; 2], [f64; 2], f64); 2]) {
        let first = self.corners.len() as u32;
        for ([x, y], sides, z) in ends {
            let [dx, dy] = sides.map(|side| 0.5 * side);
            let round = [[-dx, -dy], [dx, -dy], [dx, dy], [-dx, dy]];
            self.corners.extend(round.map(|[dx, dy]| [x + dx, y + dy, z].map(|c| c as f32)));
        }
        self.bodies.push(self.triangles.len() as u32);
        let walls = (0..4).flat_map(|at| [[at, (at + 1) % 4, (at + 1) % 4 + 4], [at, (at + 1) % 4 + 4, at + 4]]);
        let all = walls.chain([[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7]]);
        self.triangles.extend(all.map(|triangle| triangle.map(|corner| first + corner)));
    }
}

/// The strokes of a drawing that are too thin for a print of the usual size, in words; `None` if there is none, or if the
/// drawing is too large for a print.
#[must_use]
pub fn thin_strokes(figure: &Figure) -> Option<String> {
    fn of<S: Space>(drawing: &Drawing<S>, least: f64) -> (u64, f64) {
        let widths = drawing.segments().map(|segment| segment.width.min(segment.end_width));
        widths
            .filter(|&width| width < least)
            .fold((0, f64::INFINITY), |(count, least), width| (count + 1, least.min(width)))
    }
    let [low, high] = figure.bounds().filter(|_| figure.segment_count() <= STROKES)?;
    let sides = || low.iter().zip(&high).map(|(low, high)| high - low);
    let unit = sides().fold(0.0, f64::max) / LONGEST;
    let (count, width) = match figure {
        Figure::Plane(drawing) => of(drawing, THINNEST * unit),
        Figure::Space(drawing) => of(drawing, THINNEST * unit),
    };
    let height = sides().nth(1)? / unit;
    (count > 0).then(|| thin_words(count, THINNEST, height * THINNEST * unit / width).join(". "))
}

/// Words about strokes that are made thicker, and the height in millimetres from which on none is.
fn thin_words(count: u64, thinnest: f64, height: f64) -> [String; 2] {
    let message = counted!(
        count,
        "{} stroke would be thinner than {} mm and is made thicker",
        "{} strokes would be thinner than {} mm and are made thicker",
        shown(&thinnest.to_string())
    );
    let height = if height < 1e6 { grouped(&format!("{:.0}", libm::ceil(height))) } else { "∞".into() };
    [message, say!("From a height of {} mm on, none would be.", height)]
}
