//! The search for the rules of a picture.

use crate::Found;
use crate::Searched;
use crate::collage::{Collage, Collected, Step};
use crate::hull::{Fit, Hulls, System, Target};
use crate::picture::Picture;
use crate::strokes::Strokes;
use crate::words::{Alphabet, Symbol, Words};
use lsystem_drawing::draw;
use lsystem_syntax::{Definition, Dialect, Limits};
use std::iter::once;
use std::sync::Arc;

/// From this agreement on a system is told as found.
pub const FOUND: f64 = 0.985;
/// A system that agrees less is not kept.
const NEAR: f64 = 0.8;
/// The most systems that are kept.
const MAX_KEPT: usize = 20;
/// The most symbols of the successors.
const MAX_SYMBOLS: usize = 24;
/// The most symbols of the axiom, and the most derivation steps.
const MAX_AXIOM: usize = 200;
const MAX_STEPS: u32 = 12;
/// The most segments of a drawing that is drawn again to confirm a system.
const MAX_CONFIRMED: u64 = 100_000;
/// The number of systems that a family tries before the next family's turn.
const SHARE: u64 = 256;
/// The sizes of the copies in collages.
const RATIOS: [f64; 4] = [1.0 / 2.0, 1.0 / 3.0, 1.0 / 4.0, 1.0 / 5.0];
/// Other letters that draw, and letters that do not.
const DRAWN: [char; 2] = ['F', 'G'];
const UNDRAWN: [char; 2] = ['X', 'Y'];

/// What is known of a picture's system.
#[derive(Clone, Debug, PartialEq)]
pub struct Known {
    /// Letters, turns and branches.
    pub axiom: String,
    /// In degrees.
    pub angle: f64,
    /// The first headings to try, in degrees counter-clockwise from the right.
    pub headings: Vec<f64>,
    /// The numbers of derivation steps to try, in ascending order.
    pub steps: Vec<u32>,
    /// The letters that draw, if they are known.
    pub draws: Option<String>,
}

/// A system that draws the picture, or nearly.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// What its derivation begins with.
    pub axiom: String,
    /// Its rules and the number of derivation steps.
    pub found: Found,
    /// The letters that draw.
    pub draws: String,
    /// In degrees.
    pub angle: f64,
    /// The first heading, in degrees counter-clockwise from the right.
    pub heading: f64,
    /// How much of the ink agrees, from 0 to 1.
    pub agreement: f64,
}

impl Drawn {
    /// The system as a definition that draws the picture.
    #[must_use]
    pub fn definition(&self) -> Definition {
        let usual = |letter: char| !Dialect::default().actions(letter).is_empty();
        let letters =
            self.axiom.chars().chain(self.found.rules.iter().flat_map(|(from, to)| once(*from).chain(to.chars())));
        let mut letters: Vec<char> = letters.filter(char::is_ascii_alphabetic).collect();
        letters.sort_unstable();
        letters.dedup();
        let line = |&letter: &char| match (self.draws.contains(letter), usual(letter)) {
            (true, _) if !['F', 'G'].contains(&letter) => Some(format!("{letter}: draw")),
            (false, true) => Some(format!("{letter}: nothing")),
            _ => None,
        };
        Definition {
            axiom: self.axiom.clone(),
            rules: self.found.text(),
            iterations: self.found.n,
            angle: self.angle,
            heading: self.heading,
            overrides: letters.iter().filter_map(line).collect::<Vec<_>>().join("\n"),
            ..Definition::default()
        }
    }

    /// Measures the agreement once more, with the drawing of the definition, unless that has too many segments.
    fn confirm(&mut self, target: &Target, picture: &Picture, fit: Fit) {
        let limits = Limits { segments: MAX_CONFIRMED, ..Limits::default() };
        let Some(system) = lsystem_drawing::System::new(&self.definition()).0 else {
            self.agreement = 0.0;
            return;
        };
        let Ok(drawing) = draw(&system, self.found.n, &limits) else { return };
        if drawing.segment_count() <= u128::from(MAX_CONFIRMED) {
            let segments = drawing.segments().map(|segment| [segment.from, segment.to]);
            self.agreement = Strokes::of_segments(segments, target).agreement(target, picture, fit);
        }
    }
}

/// A search for the rules of a picture, in steps. It can be dropped at any time.
///
/// Each family of systems is searched by itself, with one symbol more in each round, so its shortest systems are found
/// first.
#[derive(Clone, Debug)]
pub struct PictureSearch {
    picture: Arc<Picture>,
    /// The picture as seen with each heading.
    targets: Vec<Target>,
    known: Known,
    families: Vec<Family>,
    /// Successors that the picture itself tells, each with its family.
    collages: Vec<(usize, Collage)>,
    hulls: Hulls,
    /// The successors of the present system.
    words: Vec<Vec<Symbol>>,
    kept: Vec<Drawn>,
    /// Which of how many searches beside each other this one is.
    part: (u64, u64),
}

/// How the rule of a letter is found.
#[derive(Clone, Debug, PartialEq)]
enum Rule {
    /// All successors are tried.
    Free,
    /// All successors are tried that have no other letters.
    Own,
    Fixed(Vec<Symbol>),
    /// The successor of the first letter with both letters exchanged, as a mirror shows it; also from its end.
    Mirrored {
        is_reversed: bool,
    },
}

/// Systems with the same letters.
#[derive(Clone, Debug)]
struct Family {
    name: String,
    letters: Vec<(char, bool, Rule)>,
    draws: Vec<bool>,
    axiom: Vec<Symbol>,
    alphabet: Alphabet,
    /// The symbols of all free successors in this round.
    round: usize,
    /// The successors of the free letters.
    words: Vec<Words>,
    tried: u64,
    /// A family gets a part of the work that is smaller by this factor than that of the most usual ones.
    rank: u64,
}

impl PictureSearch {
    /// `part` is which of how many searches beside each other this one is, such as (0, 1).
    ///
    /// # Errors
    /// Why this cannot be searched.
    pub fn new(picture: Arc<Picture>, known: Known, part: (u64, u64)) -> Result<Self, &'static str> {
        if !(known.angle >= 0.01 && known.angle <= 360.0 && known.headings.iter().all(|heading| heading.is_finite())) {
            return Err("an angle from 0.01 to 360 degrees is expected");
        }
        if known.steps.is_empty() || known.steps.iter().any(|&n| n == 0 || n > MAX_STEPS) {
            return Err("1 to 12 derivation steps are expected");
        }
        let targets =
            known.headings.iter().map(|&heading| Target::new(&picture, known.angle, heading)).collect::<Vec<_>>();
        let Some(first) = targets.first() else { return Err("a first heading is expected") };
        let mut families = families(&known.axiom, first.headings.order())?;
        if let Some(draws) = &known.draws {
            families.retain(|family| family.letters.iter().all(|(letter, drawn, _)| *drawn == draws.contains(*letter)));
            if families.is_empty() {
                return Err("the letters that draw are expected to be in the axiom, or F or G");
            }
        }
        let collages = collages(&picture, &known, &families, part);
        Ok(Self {
            picture,
            targets,
            known,
            families,
            collages,
            hulls: Hulls::default(),
            words: Vec::new(),
            kept: Vec::new(),
            part,
        })
    }

    /// Tries about `systems` systems.
    pub fn step(&mut self, systems: u64) -> Searched {
        let is_collected = self.collages.iter().all(|(_, collage)| collage.is_done());
        if !is_collected {
            self.collect();
        }
        for _ in 0..systems.div_ceil(SHARE) {
            let open = self.families.iter().enumerate().filter(|(_, family)| family.round <= MAX_SYMBOLS);
            let Some((at, _)) = open.min_by_key(|(_, family)| family.tried * family.rank) else {
                return if is_collected { Searched::All } else { Searched::More };
            };
            for _ in 0..SHARE {
                if self.families[at].round > MAX_SYMBOLS {
                    break;
                }
                self.families[at].advance();
                if self.families[at].tried % self.part.1 == self.part.0 {
                    self.test(at);
                }
            }
        }
        Searched::More
    }

    /// Goes on with the collages, one after the other.
    fn collect(&mut self) {
        let mut collages = std::mem::take(&mut self.collages);
        if let Some((family, collage)) = collages.iter_mut().find(|(_, collage)| !collage.is_done())
            && let Collected::Word(word) = collage.advance()
        {
            let rules = self.families[*family].letters.iter().enumerate().map(|(at, (_, _, rule))| match rule {
                Rule::Fixed(word) => word.clone(),
                _ if at == 0 => word.clone(),
                _ => vec![at as Symbol],
            });
            let words: Vec<Vec<Symbol>> = rules.collect();
            self.compare(*family, &words);
        }
        self.collages = collages;
    }

    /// The systems that draw the picture or nearly do, best first.
    #[must_use]
    pub fn found(&self) -> &[Drawn] {
        &self.kept
    }

    /// What was searched: each family, and up to how many symbols of its successors.
    #[must_use]
    pub fn searched(&self) -> Vec<(String, usize)> {
        self.families.iter().map(|family| (family.name.clone(), family.round - 1)).collect()
    }

    /// Compares the present system of a family with the picture.
    fn test(&mut self, at: usize) {
        let mut words = std::mem::take(&mut self.words);
        if self.families[at].set_successors(&mut words) {
            self.compare(at, &words);
        }
        self.words = words;
    }

    /// Compares the system of a family that has these successors with the picture.
    fn compare(&mut self, at: usize, words: &[Vec<Symbol>]) {
        let family = &self.families[at];
        let system = System { alphabet: family.alphabet, axiom: &family.axiom, words, draws: &family.draws };
        let (targets, picture) = (&self.targets, &self.picture);
        let mut best: Option<(f64, u32, usize, Fit)> = None;
        self.hulls.search(targets, system, &self.known.steps, |hulls, n, at, fit| {
            let target = &targets[at];
            let Some(strokes) = Strokes::on_ink(system, hulls, n, target, picture, fit) else { return };
            let agreement = strokes.agreement(target, picture, fit);
            if agreement >= NEAR && best.is_none_or(|(most, ..)| agreement > most) {
                best = Some((agreement, n, at, fit));
            }
        });
        let Some((agreement, n, at, fit)) = best else { return };
        let text = |word: &[Symbol]| word.iter().map(|&symbol| family.character(symbol)).collect::<String>();
        let is_constant = |at: usize| words[at] == [at as Symbol];
        let rules = (0..words.len())
            .filter(|&at| !is_constant(at))
            .map(|at| (family.letters[at].0, text(&words[at])))
            .collect();
        let draws = family.letters.iter().filter(|(_, draws, _)| *draws).map(|(letter, ..)| *letter).collect();
        let axiom = self.known.axiom.clone();
        let (angle, heading) = (self.known.angle, self.known.headings[at]);
        let mut drawn = Drawn { axiom, found: Found { rules, n }, draws, angle, heading, agreement };
        if agreement >= FOUND {
            drawn.confirm(&targets[at], picture, fit);
        }
        keep(&mut self.kept, drawn);
    }
}

/// Adds a system to those that are kept, best first.
pub(crate) fn keep(kept: &mut Vec<Drawn>, drawn: Drawn) {
    let is_same = |other: &Drawn| {
        let names = |drawn: &Drawn| (drawn.axiom.clone(), drawn.found.clone(), drawn.draws.clone());
        names(other) == names(&drawn) && other.angle == drawn.angle
    };
    if kept.iter().any(is_same) {
        return;
    }
    kept.push(drawn);
    kept.sort_by(|a, b| {
        let found = |drawn: &Drawn| drawn.agreement >= FOUND;
        let by_size = a.found.symbols().cmp(&b.found.symbols());
        let by_agreement = b.agreement.total_cmp(&a.agreement);
        let order = if found(a) { by_size.then(by_agreement) } else { by_agreement.then(by_size) };
        found(b).cmp(&found(a)).then(order).then_with(|| a.found.text().cmp(&b.found.text()))
    });
    kept.truncate(MAX_KEPT);
}

impl Family {
    fn character(&self, symbol: Symbol) -> char {
        match self.letters.get(usize::from(symbol)) {
            Some((letter, ..)) => *letter,
            None => ['+', '-', '[', ']'][usize::from(symbol - self.alphabet.letters)],
        }
    }

    /// Goes to the next system. The first word changes first, so that the blocks of the other one are used again.
    fn advance(&mut self) {
        self.tried += 1;
        while self.round <= MAX_SYMBOLS {
            if self.words[0].advance() {
                return;
            }
            if self.words.len() > 1 && self.words[1].advance() {
                self.words[0] = self.words[0].again();
            } else {
                self.share();
            }
        }
    }

    /// Moves one symbol from the second word to the first one, or begins the next round.
    fn share(&mut self) {
        let first = match &self.words[..] {
            [first, second] if second.length() > 1 => first.length() + 1,
            _ => {
                self.round += 1;
                1
            }
        };
        let second = self.letters.iter().position(|(_, _, rule)| *rule == Rule::Own).unwrap_or(0);
        let free = self.letters.iter().filter(|(_, _, rule)| matches!(rule, Rule::Free | Rule::Own)).count();
        self.words = match free {
            1 => vec![Words::new(self.alphabet, self.round)],
            _ => {
                let rest = Words::new(self.alphabet, self.round.saturating_sub(first)).from(second as Symbol);
                vec![Words::new(self.alphabet, first), rest]
            }
        };
        if let [_, rest] = &mut self.words[..] {
            rest.advance();
        }
    }

    /// Writes the successors of all letters. Whether the system is worth a try: all letters with rules that are searched
    /// are used.
    fn set_successors(&self, all: &mut Vec<Vec<Symbol>>) -> bool {
        let mut free = self.words.iter();
        let Some(first) = self.words.first().map(Words::word) else { return false };
        let abc = self.alphabet;
        all.resize(self.letters.len(), Vec::new());
        for (at, ((_, _, rule), word)) in self.letters.iter().zip(&mut *all).enumerate() {
            let is_used = self.axiom.contains(&(at as Symbol)) || first.contains(&(at as Symbol));
            if !is_used {
                return false;
            }
            word.clear();
            let swap = |&symbol: &Symbol| match symbol {
                0 => 1,
                1 => 0,
                turn if turn == abc.left() => abc.right(),
                turn if turn == abc.right() => abc.left(),
                other => other,
            };
            match rule {
                Rule::Free | Rule::Own => word.extend_from_slice(free.next().map_or(&[], Words::word)),
                Rule::Fixed(fixed) => word.extend_from_slice(fixed),
                Rule::Mirrored { is_reversed: true } => word.extend(first.iter().rev().map(swap)),
                Rule::Mirrored { is_reversed: false } => word.extend(first.iter().map(swap)),
            }
            // A letter that becomes itself is no rule, and another family has it.
            if word.len() == 1 && matches!(rule, Rule::Free | Rule::Own) {
                return false;
            }
        }
        true
    }
}

/// The collages for an axiom of one letter that draws, or of one that does not with another letter that is doubled.
fn collages(picture: &Arc<Picture>, known: &Known, families: &[Family], part: (u64, u64)) -> Vec<(usize, Collage)> {
    let mut collages = Vec::new();
    for (at, family) in families.iter().enumerate() {
        let (step, ratios) = match &family.letters[..] {
            [(_, true, Rule::Free)] => (Step::Copy, &RATIOS[..]),
            [(_, false, Rule::Free), (_, true, Rule::Fixed(word))] if word.len() == 2 => (Step::Stalk, &RATIOS[..1]),
            _ => continue,
        };
        if family.axiom != [0] || !family.alphabet.has_branches {
            continue;
        }
        for &heading in &known.headings {
            for &ratio in ratios {
                let collage = Collage::new(picture, step, ratio, family.alphabet, heading, known.angle);
                collages.extend(collage.map(|collage| (at, collage)));
            }
        }
    }
    // Each of the searches beside each other has its part of them.
    let parts = collages.into_iter().zip(0_u64..).filter(|(_, number)| number % part.1 == part.0);
    parts.map(|(collage, _)| collage).collect()
}

/// The families of systems with an axiom.
fn families(axiom: &str, order: usize) -> Result<Vec<Family>, &'static str> {
    let mut letters: Vec<char> = Vec::new();
    for symbol in axiom.chars().filter(|symbol| !symbol.is_whitespace()) {
        match symbol {
            '+' | '-' | '[' | ']' => {}
            _ if symbol.is_ascii_alphabetic() && !letters.contains(&symbol) => letters.push(symbol),
            _ if symbol.is_ascii_alphabetic() => {}
            _ => return Err("an axiom of letters, turns + and -, and branches [ ] is expected"),
        }
    }
    let depths = axiom.chars().scan(0, |depth, at| {
        *depth += i32::from(at == '[') - i32::from(at == ']');
        Some(*depth)
    });
    if depths.clone().any(|depth| depth < 0) || depths.last().is_some_and(|depth| depth != 0) || axiom.len() > MAX_AXIOM
    {
        return Err("an axiom of at most 200 symbols whose branches are closed is expected");
    }
    let other = |names: [char; 2]| names.into_iter().find(|name| !letters.contains(name)).unwrap_or('Z');
    let (drawn, undrawn) = (other(DRAWN), other(UNDRAWN));
    let mut families = Vec::new();
    let mut add = |rank: u64, name: String, letters: Vec<(char, bool, Rule)>, has_branches: bool| {
        let alphabet = Alphabet { letters: letters.len() as u8, has_branches, order };
        let symbol = |at: char| match letters.iter().position(|(letter, ..)| *letter == at) {
            Some(letter) => letter as Symbol,
            None => alphabet.letters + "+-[]".find(at).unwrap_or(0) as Symbol,
        };
        let axiom = axiom.chars().filter(|at| !at.is_whitespace()).map(symbol).collect();
        families.push(Family {
            name,
            draws: letters.iter().map(|(_, draws, _)| *draws).collect(),
            letters,
            axiom,
            alphabet,
            round: 1,
            words: vec![Words::new(alphabet, 0)],
            tried: 0,
            rank,
        });
    };
    let (constant, doubled) = (|at| Rule::Fixed(vec![at]), |at| Rule::Fixed(vec![at, at]));
    match letters[..] {
        [a] => {
            if DRAWN.contains(&a) || !UNDRAWN.contains(&a) {
                let rank = if DRAWN.contains(&a) { 1 } else { 3 };
                add(rank, format!("one rule for {a}"), vec![(a, true, Rule::Free)], true);
                // Without branches there are so few successors that much longer ones are reached.
                add(rank, format!("one rule for {a} without branches"), vec![(a, true, Rule::Free)], false);
                for is_reversed in [false, true] {
                    let from = if is_reversed { " from its end" } else { "" };
                    let pair = vec![(a, true, Rule::Free), (drawn, true, Rule::Mirrored { is_reversed })];
                    add(2 * rank, format!("a rule for {a} and its mirror image{from} for {drawn}"), pair, false);
                }
                let pair = vec![(a, true, Rule::Free), (drawn, true, Rule::Free)];
                add(2 * rank, format!("rules for {a} and {drawn}"), pair, true);
            }
            if !DRAWN.contains(&a) {
                for draws in [false, true] {
                    let (kind, rank) = if draws { (", which draws", 4) } else { ("", 1) };
                    let pair = vec![(a, draws, Rule::Free), (drawn, true, doubled(1))];
                    add(rank, format!("{drawn} -> {drawn}{drawn} and a rule for {a}{kind}"), pair, true);
                    let pair = vec![(a, draws, Rule::Free), (drawn, true, constant(1))];
                    add(2 * rank, format!("a rule for {a}{kind}, with {drawn}"), pair, true);
                }
                let pair = vec![(a, false, Rule::Free), (drawn, true, Rule::Own)];
                add(1, format!("rules for {a} and {drawn}, {a} without drawing, {drawn} without {a}"), pair, true);
                let pair = vec![(a, false, Rule::Free), (drawn, true, Rule::Free)];
                add(3, format!("rules for {a} and {drawn}, {a} without drawing"), pair, true);
                for is_reversed in [false, true] {
                    let from = if is_reversed { " from its end" } else { "" };
                    let mirrored = (undrawn, false, Rule::Mirrored { is_reversed });
                    let three = vec![(a, false, Rule::Free), mirrored, (drawn, true, constant(2))];
                    let name = format!("a rule for {a} and its mirror image{from} for {undrawn}, with {drawn}");
                    add(2, name, three, false);
                }
            }
        }
        [a, b] => {
            let (f, x) = if DRAWN.contains(&b) { (b, a) } else { (a, b) };
            let draws = DRAWN.contains(&x);
            let pair = |rule: Rule| vec![(x, draws, Rule::Free), (f, true, rule)];
            add(2, format!("a rule for {x}, with {f}"), pair(constant(1)), true);
            add(1, format!("{f} -> {f}{f} and a rule for {x}"), pair(doubled(1)), true);
            add(1, format!("rules for {f} and {x}, {f} without {x}"), pair(Rule::Own), true);
            add(2, format!("rules for {f} and {x}"), pair(Rule::Free), true);
            if !draws {
                for is_reversed in [false, true] {
                    let from = if is_reversed { " from its end" } else { "" };
                    let mirrored = (undrawn, false, Rule::Mirrored { is_reversed });
                    let three = vec![(x, false, Rule::Free), mirrored, (f, true, constant(2))];
                    add(2, format!("a rule for {x} and its mirror image{from} for {undrawn}, with {f}"), three, false);
                }
            }
        }
        _ => return Err("an axiom with one or two letters is expected"),
    }
    Ok(families)
}
