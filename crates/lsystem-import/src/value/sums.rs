//! Arithmetic of numbers with units.

use super::{Unit, What};
use crate::tokens::{Kind, Node};
use crate::vocabulary::{Key, rows};

/// A number, if the parts are arithmetic.
pub(crate) fn arithmetic(part: &[Node]) -> What<'_> {
    let mut sums = Sums { nodes: part, at: 0, unit: Unit::Unknown, scale: 1.0, depth: 0, is_whole: true };
    match sums.sum() {
        Some(value) if value.is_finite() && sums.at == part.len() => What::Number(value * sums.scale, sums.unit),
        _ => What::Code,
    }
}

/// The product at the start of parts, its unit, and the place behind it. Words that are no unit do not belong to it.
pub(crate) fn leading(part: &[Node]) -> Option<(f64, Unit, usize)> {
    let mut sums = Sums { nodes: part, at: 0, unit: Unit::Unknown, scale: 1.0, depth: 0, is_whole: false };
    let value = sums.product().filter(|value| value.is_finite())?;
    let last = part.get(sums.at.checked_sub(1)?)?;
    let behind = match &last.kind {
        Kind::Number(_, unit) if unit_of(unit).is_none() => unit.len(),
        _ => 0,
    };
    Some((value * sums.scale, sums.unit, last.span.end - behind))
}

/// The unit that a word names, and what it is multiplied by.
fn unit_of(word: &str) -> Option<(f64, Unit)> {
    Some(match rows(word) {
        _ if word == "°" || word == "º" => (1.0, Unit::Degrees),
        found if found.has(Key::Degrees) => (1.0, Unit::Degrees),
        found if found.has(Key::Radians) => (1.0, Unit::Radians),
        found if found.has(Key::Turns) => (360.0, Unit::Degrees),
        _ => return None,
    })
}

struct Sums<'t> {
    nodes: &'t [Node],
    at: usize,
    unit: Unit,
    /// What the unit multiplies the whole by.
    scale: f64,
    depth: usize,
    /// Whether every part must be arithmetic.
    is_whole: bool,
}

impl Sums<'_> {
    fn eat(&mut self, mark: &str) -> bool {
        let found = self.nodes.get(self.at).is_some_and(|node| node.is(mark));
        self.at += usize::from(found);
        found
    }

    fn sum(&mut self) -> Option<f64> {
        let mut value = self.product()?;
        loop {
            if self.eat("+") {
                value += self.product()?;
            } else if self.eat("-") {
                value -= self.product()?;
            } else {
                return Some(value);
            }
        }
    }

    fn product(&mut self) -> Option<f64> {
        let mut value = self.factor()?;
        loop {
            if self.eat("*") {
                value *= self.factor()?;
            } else if self.eat("/") {
                value /= self.factor()?;
            } else {
                return Some(value);
            }
        }
    }

    pub(super) fn inside(&mut self, nodes: &[Node]) -> Option<f64> {
        if self.depth > 24 {
            return None;
        }
        let mut inner = Sums { nodes, at: 0, unit: Unit::Unknown, scale: 1.0, depth: self.depth + 1, is_whole: true };
        let value = inner.sum()?;
        if inner.unit != Unit::Unknown {
            (self.unit, self.scale) = (inner.unit, inner.scale);
        }
        (inner.at == nodes.len()).then_some(value)
    }

    fn factor(&mut self) -> Option<f64> {
        if self.eat("-") {
            return Some(-self.factor()?);
        }
        if self.eat("+") {
            return self.factor();
        }
        if self.eat("π") {
            self.unit = Unit::Radians;
            return Some(core::f64::consts::PI);
        }
        let node = self.nodes.get(self.at)?;
        self.at += 1;
        match &node.kind {
            Kind::Number(value, unit) => {
                let bare = matches!(&*unit.to_lowercase(), "" | "f" | "d" | "l" | "f32" | "f64" | "px" | "u32" | "i32");
                // `25.7°`, `90 Degree`
                let behind =
                    self.nodes.get(self.at).and_then(|node| if node.is("°") { Some("°") } else { node.name() });
                match unit_of(unit).or_else(|| unit_of(behind?).filter(|_| bare).inspect(|_| self.at += 1)) {
                    Some(found) => (self.scale, self.unit) = found,
                    None if !bare && self.is_whole => return None,
                    None => {}
                }
                if self.eat("π") {
                    self.unit = Unit::Radians;
                    return Some(value * core::f64::consts::PI);
                }
                // `25.0.to_radians()`
                if let Some([dot, name, call, ..]) = self.nodes.get(self.at..)
                    && dot.is(".")
                    && name.name() == Some("to_radians")
                    && call.group().is_some()
                {
                    self.at += 3;
                    self.unit = Unit::Degrees;
                }
                Some(*value)
            }
            Kind::Group('(', inside) => self.inside(inside),
            Kind::Name(_) => self.named(),
            _ => None,
        }
    }

    /// A constant or a call: `Math.PI`, `np.radians(25)`, `Mathf.Deg2Rad`. The last name counts.
    fn named(&mut self) -> Option<f64> {
        let mut name = self.nodes.get(self.at - 1)?.name()?;
        while (self.eat(".") || self.eat("::"))
            && let Some(next) = self.nodes.get(self.at).and_then(Node::name)
        {
            name = next;
            self.at += 1;
        }
        let lower = name.to_ascii_lowercase();
        let fraction = match lower.as_str() {
            "pi" | "m_pi" => 1.0,
            "two_pi" | "tau" => 2.0,
            "half_pi" | "frac_pi_2" => 0.5,
            "third_pi" | "frac_pi_3" => 1.0 / 3.0,
            "quarter_pi" | "frac_pi_4" => 0.25,
            "frac_pi_6" => 1.0 / 6.0,
            "frac_pi_8" => 0.125,
            _ => 0.0,
        };
        if fraction > 0.0 {
            self.unit = Unit::Radians;
            return Some(fraction * core::f64::consts::PI);
        }
        let inside = self.nodes.get(self.at).and_then(Node::group)?;
        self.at += 1;
        let value = self.inside(inside)?;
        match lower.as_str() {
            // Calls from degrees to radians: the argument is in degrees.
            "radians" | "toradians" | "deg2rad" | "degtorad" | "to_radians" | "rad" | "torad" | "degreestoradians" => {
                self.unit = Unit::Degrees;
            }
            "degrees" | "todegrees" | "rad2deg" => self.unit = Unit::Radians,
            "float" | "double" | "int" | "number" => {}
            _ => return None,
        }
        Some(value)
    }
}
