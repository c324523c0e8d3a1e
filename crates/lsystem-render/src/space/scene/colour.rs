//! The colours of nodes.

use super::*;
use crate::ink::pigment;
use lsystem_syntax::Ink;

impl Scene {
    /// Goes on making the mean colours for a style.
    pub(in crate::space) fn dye(&mut self, style: &Style, meter: &mut Meter) -> Progress {
        let choice = Choice::new(style, &self.styles);
        let colours = choice.colours;
        // Pigments of additive ink, so that means are those of mixed ink.
        let additive = style.ink == Ink::Density;
        let colour =
            |ink| if additive { pigment(style.ink(ink), style.background) } else { style.ink(ink).rgb.map(f32::from) };
        let palette: Vec<[f32; 3]> = (0..choice.inks()).map(|number| colour(choice.ink(number))).collect();
        if choice != self.choice || palette != self.palette || self.means.is_empty() && !self.along {
            (self.choice, self.palette) = (choice, palette);
            // Unfolded drawings enter each node once, so one mean for each node is enough.
            let few = !self.memoised || self.whole[0].saturating_mul(colours as usize) > MAX_MEANS;
            // Colours along the path need no means.
            self.along = !style.colour_by.source().is_shared();
            self.entries = if self.along {
                0
            } else if few {
                1
            } else {
                colours
            };
            self.means.clear();
            self.means.reserve_exact(self.nodes.len() * self.entries as usize);
        }
        while additive && self.wholes.len() < self.nodes.len() {
            if meter.is_spent() {
                return Progress::More;
            }
            let node = &self.nodes[self.wholes.len()];
            meter.charge(1 + u64::from(node.links + node.lines) / 4);
            self.wholes.push(self.summed(node));
        }
        let known = self.means.len() / self.entries.max(1) as usize;
        for node in self.nodes.get(known..).unwrap_or_default().iter().filter(|_| self.entries > 0) {
            if meter.is_spent() {
                return Progress::More;
            }
            meter.charge(1 + u64::from(self.entries) * u64::from(node.links + node.lines) / 4);
            for entry in 0..self.entries {
                let (mut sum, mut weight) = ([0.0_f32; 3], 0.0_f32);
                let mut add = |colour: [f32; 3], length: f32| {
                    // A content without length counts only if there is no other.
                    let length = length.max(1e-30);
                    weight += length;
                    sum.iter_mut().zip(colour).for_each(|(sum, c)| *sum += length * c);
                };
                for link in &self.links[node.first_link as usize..][..usize::from(node.links)] {
                    let shade = self.choice.then(Shade { number: entry, fixed: true }, self.shade(link.style));
                    add(self.mean(link.node, shade, Stretch::default()), link.length);
                }
                for line in &self.lines[node.first_line as usize..][..usize::from(node.lines)] {
                    let shade = self.choice.then(Shade { number: entry, fixed: true }, self.shade(line.style));
                    add(self.ink(shade, Stretch::default(), 0.0), norm(line.way()) as f32);
                }
                let mean = if weight.is_finite() {
                    sum.map(|c| c / weight)
                } else {
                    self.ink(Shade { number: entry, fixed: true }, Stretch::default(), 0.0)
                };
                self.means.push(mean);
            }
        }
        Progress::Done
    }

    /// The length of a node's strokes and the area of its triangles. Those of the nodes inside are known.
    fn summed(&self, node: &SceneNode) -> [Amount; 2] {
        let mut whole = [Amount::default(); 2];
        for link in &self.links[node.first_link as usize..][..usize::from(node.links)] {
            let scale = if link.same { 1.0 } else { norm(link.axes[0]) };
            let [length, area] = self.whole_of(link.node);
            whole = [whole[0].plus(length.times(scale)), whole[1].plus(area.times(scale).times(scale))];
        }
        for line in &self.lines[node.first_line as usize..][..usize::from(node.lines)] {
            match line.corner {
                Some(_) => whole[1] = whole[1].plus(Amount::new(line.area().into())),
                None => whole[0] = whole[0].plus(Amount::new(norm(line.way()))),
            }
        }
        whole
    }

    /// The length of a node's strokes and the area of its triangles, for additive ink.
    pub(in crate::space) fn whole_of(&self, node: u32) -> [Amount; 2] {
        self.wholes.get(node as usize).copied().unwrap_or_default()
    }

    /// The only ink of a picture; `None` if there may be several.
    pub(in crate::space) fn only_ink(&self) -> Option<[f32; 3]> {
        self.palette.first().copied().filter(|_| self.palette.len() == 1)
    }

    /// The shade of a style.
    #[inline]
    pub(in crate::space) fn shade(&self, style: u32) -> Shade {
        self.choice.shade(&self.styles[style as usize])
    }

    /// The mean colour of a node that is entered with a shade and has a stretch of the path.
    #[inline]
    pub(in crate::space) fn mean(&self, node: u32, shade: Shade, path: Stretch) -> [f32; 3] {
        if self.along {
            return path.mean(&self.palette);
        }
        let entry = shade.number;
        let entry = if entry < self.entries { entry } else { 0 };
        self.means.get((node * self.entries + entry) as usize).copied().unwrap_or_default()
    }

    /// The colour of a stroke with a shade; `before` is the part of the node's stretch that comes before the stroke.
    #[inline]
    pub(in crate::space) fn ink(&self, shade: Shade, path: Stretch, before: f64) -> [f32; 3] {
        let entry = if self.along { Stretch { size: self.one, ..path.part(before, 0.0) }.ink() } else { shade.number };
        self.palette.get(entry as usize).copied().unwrap_or_default()
    }
}
