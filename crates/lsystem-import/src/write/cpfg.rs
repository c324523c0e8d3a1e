//! The files of cpfg, and what those of L-Py share with them: see the reader in `cpfg.rs`.
//!
//! Angles stand as numbers in the words, because cpfg has them in another file. A symbol that acts as in neither program
//! gets its actions from a homomorphism, or is written as the symbols that act so.

use super::Refusal;
use super::expression::{Arithmetic, COMMON, PYTHON};
use super::queries;
use super::source::{Need, Source, Symbol, plain_number};
use super::symbol_words::{Kind, Words, numbered, without_arguments};
use crate::cpfg::{function_file, surface_file};
use core::f64::consts::FRAC_1_SQRT_2;
use core::fmt::Write;
use lsystem_base::number::number;
use lsystem_base::say;
use lsystem_base::sorted;
use lsystem_base::sorted::set;
use lsystem_syntax::grammar::Values;
use lsystem_syntax::{
    Action, Expr, Function, Module, Outline, Pattern, Production, Query, Seen, Surface, Vocabulary, parse_surfaces,
};

/// The parts of systems that cpfg expresses in one file.
pub(super) const SPEAKS: &[Need] = &[
    Need::Contexts,
    Need::Parameters,
    Need::Conditions,
    Need::Chance,
    Need::Images,
    Need::Space,
    Need::Acts(Vocabulary::Polygons),
    Need::Acts(Vocabulary::Circles),
    Need::Acts(Vocabulary::Tubes),
    Need::Acts(Vocabulary::Surfaces),
    Need::Acts(Vocabulary::Cuts),
    Need::Queries,
];

pub(super) fn write_cpfg(source: &Source<'_>) -> Result<String, Refusal> {
    let file = File::new(source, Kind::Cpfg)?;
    let mut text = String::from("lsystem: 1\n");
    let title = source.title(&['*', '/']);
    if !title.is_empty() {
        let _ = writeln!(text, "/* {title} */");
    }
    for constant in file.constants() {
        let _ = writeln!(text, "#define {} {}", constant.name, number(constant.value));
    }
    if source.needs(Need::Chance) {
        let _ = writeln!(text, "seed: {}", source.definition.seed);
    }
    let _ = writeln!(text, "derivation length: {}", source.definition.iterations);
    text.push_str(&file.seen()?);
    let _ = writeln!(text, "axiom: {}", file.axiom()?);
    file.productions("homomorphism", &mut text)?;
    text.push_str("endlsystem\n");
    let surfaces = parse_surfaces(&source.definition.surfaces).unwrap_or_default();
    let drawn = |name: char| source.acts(|action| matches!(action, Action::Surface(own, _) if own == name));
    let surfaces: Vec<_> = surfaces.into_iter().filter(|surface| drawn(surface.name)).collect();
    let curves = &source.grammar.curves;
    if !surfaces.is_empty() || !curves.is_empty() {
        text.push_str("\n==> view.v <==\n");
    }
    // As many values are computed as cpfg's own models have.
    for at in 1..=curves.len() {
        let _ = writeln!(text, "function: f{at}.func 100");
    }
    for Surface { name, .. } in &surfaces {
        let _ = writeln!(text, "surface: {name} {name}.s 1");
    }
    for (at, curve) in curves.iter().enumerate() {
        let _ = write!(text, "\n==> f{}.func <==\n{}", at + 1, function_file(&curve.curve));
    }
    for surface in &surfaces {
        let _ = write!(text, "\n==> {}.s <==\n{}", surface.name, surface_file(surface));
    }
    Ok(text)
}

/// A system with the names of its symbols.
pub(super) struct File<'a> {
    source: &'a Source<'a>,
    kind: Kind,
    label: &'static str,
    /// Whether lengths count, and not only their proportions to the one length of a step.
    has_lengths: bool,
    names: Vec<(char, char)>,
    values: Values<'a>,
}

/// More symbols that are replaced or in contexts have no names.
const MAX_NAMED: usize = 80;

impl<'a> File<'a> {
    pub(super) fn new(source: &'a Source<'a>, kind: Kind) -> Result<Self, Refusal> {
        let label = if kind == Kind::Cpfg { "cpfg" } else { "L-Py" };
        if kind == Kind::Cpfg && source.acts(|action| matches!(action, Action::Circle(_))) {
            return Err(Refusal::new(say!("cpfg cannot express circles that are not filled")));
        }
        if source.acts(|action| matches!(action, Action::Fill(outline, _) if outline != Outline::Disc)) {
            return Err(Refusal::new(say!("{} cannot express the outlines of leaves", label)));
        }
        if kind == Kind::LPy {
            queries::check_for_lpy(source)?;
        }
        let lengths = |action: &Action| action.length().is_some_and(|own| own.is_some());
        let is_length = |action: &&Action| action.length().is_some();
        let made = source.grammar.made().chain(source.grammar.images.iter().flat_map(|image| &image.successor));
        let first = |symbol: char| source.symbol(symbol).and_then(|own| own.actions.first());
        // Places are measured in lengths.
        let has_lengths = source.needs(Need::Queries)
            || source.symbols.iter().any(|own| own.actions.iter().any(lengths))
            || made
                .into_iter()
                .any(|module| !module.arguments.is_empty() && first(module.symbol).filter(is_length).is_some());
        let mut file = Self { source, kind, label, has_lengths, names: Vec::new(), values: source.grammar.values() };
        file.name_all()?;
        Ok(file)
    }

    /// Whether a symbol of a name does what its own actions are, without an argument or with one.
    fn is_own(&self, name: char, symbol: &Symbol, has_argument: bool) -> bool {
        let is_step = self.source.definition.step == 1.0 || !self.has_lengths;
        let lpy = self.kind == Kind::LPy;
        match (name, symbol.actions.as_slice()) {
            ('F', [Action::Draw(None)]) | ('f', [Action::Move(None)]) => is_step || has_argument,
            ('G', [Action::Draw(None) | Action::DrawUnmarked(None)]) if !lpy => is_step || has_argument,
            ('g', [Action::Move(None) | Action::MoveUnmarked(None)]) if !lpy => is_step || has_argument,
            ('+', [Action::TurnLeft(_)])
            | ('-', [Action::TurnRight(_)])
            | ('&', [Action::PitchDown(_)])
            | ('^', [Action::PitchUp(_)]) => has_argument,
            ('\\', [Action::RollLeft(_)]) | ('/', [Action::RollRight(_)]) => has_argument && !lpy,
            ('/', [Action::RollLeft(_)]) | ('\\', [Action::RollRight(_)]) => has_argument && lpy,
            ('|', [Action::TurnRound])
            | ('[', [Action::Push])
            | (']', [Action::Pop])
            | ('%', [Action::Cut])
            | ('!', [Action::ScaleWidth(FRAC_1_SQRT_2)])
            | (';', [Action::AddColour(1)])
            | (',', [Action::AddColour(-1)]) => true,
            ('{', [Action::OpenPolygon]) | ('.', [Action::Vertex]) | ('}', [Action::ClosePolygon]) => !lpy,
            (name, []) => self.is_idle(name) || Query::of_symbol(name).is_some(),
            _ => false,
        }
    }

    /// Whether the program does nothing at a symbol of this name. `x` is special in L-Py, and `G` may be.
    fn is_idle(&self, name: char) -> bool {
        let acting = if self.kind == Kind::Cpfg { "FfGg" } else { "FfGgx" };
        name.is_ascii_alphabetic() && !acting.contains(name)
    }

    /// Names the symbols that are replaced, or are in contexts, or do nothing.
    fn name_all(&mut self) -> Result<(), Refusal> {
        let bound: Vec<char> =
            self.source.symbols.iter().filter(|own| !own.is_constant()).map(|own| own.symbol).collect();
        let is_full = || Refusal(say!("{} has too few symbols", self.label));
        if bound.len() > MAX_NAMED {
            return Err(is_full());
        }
        // The symbols for a constant symbol must stay, too.
        let changes = |code: &str| bound.iter().any(|symbol| code.contains(*symbol));
        let code = |own: &Symbol| self.code(own, None).map_or(String::new(), |code| without_arguments(&code));
        let stays = |own: &Symbol| {
            !own.is_constant() || own.shape().is_empty() || !self.is_own(own.symbol, own, false) && changes(&code(own))
        };
        let is_usable = |file: &Self, own: &Symbol| {
            let symbol = own.symbol;
            file.is_own(symbol, own, true)
                || (file.is_idle(symbol) || matches!(symbol, 'F' | 'f')) && !own.is_constant()
        };
        let (kept, others): (Vec<&Symbol>, Vec<&Symbol>) =
            self.source.symbols.iter().filter(|own| stays(own)).partition(|own| is_usable(self, own));
        self.names = kept.iter().map(|own| (own.symbol, own.symbol)).collect();
        for own in others {
            let cuts = own.actions == [Action::Cut];
            let free = ('A'..='Z').chain('a'..='z').find(|c| {
                // Names of constants and letters that words of actions use are no names of symbols.
                self.is_idle(*c) && self.names.iter().all(|(_, name)| name != c)
            });
            let name = if cuts { Some('%') } else { free };
            let name = name.ok_or_else(is_full)?;
            self.names.push((own.symbol, name));
        }
        sorted::sort(&mut self.names);
        let cut = |own: &Symbol| own.actions.contains(&Action::Cut) && own.actions.len() > 1;
        match self.source.symbols.iter().find(|own| cut(own)) {
            Some(own) => Err(Refusal(say!("{} has no symbol that does what `{}` does", self.label, own.symbol))),
            None => Ok(()),
        }
    }

    fn name_of(&self, symbol: char) -> Option<char> {
        self.names.binary_search_by_key(&symbol, |(own, _)| *own).ok().map(|at| self.names[at].1)
    }

    /// Constants whose names are no words of symbols; cpfg replaces them everywhere.
    pub(super) fn constants(&self) -> impl Iterator<Item = &lsystem_syntax::Constant> {
        self.source.grammar.constants.iter().filter(|constant| self.has_constant(&constant.name))
    }

    fn has_constant(&self, name: &str) -> bool {
        let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
        name.chars().all(is_name) && name.contains(|c: char| c.is_ascii_digit() || c == '_')
    }

    fn expression(&self, expr: &Expr) -> Result<String, Refusal> {
        let value = |name: &str| match self.values.of(name) {
            Some(value) if !self.has_constant(name) => number(value),
            _ => name.to_owned(),
        };
        let random = match expr {
            Expr::Call(Function::Random, arguments) if self.kind == Kind::Cpfg => arguments.as_slice(),
            _ => &[],
        };
        if let [Expr::Number(0.0), most] = random {
            return Ok(format!("ran({})", self.expression(most)?));
        }
        let functions: &[_] = match self.kind {
            Kind::Cpfg => &[COMMON, &[(Function::NormalRandom, "nran")]].concat(),
            Kind::LPy => PYTHON,
        };
        let curve = |name: &str, argument: &str| self.curve(name, argument);
        let is_python = self.kind == Kind::LPy;
        Arithmetic { label: self.label, name: &value, functions, curve: &curve, is_python }.write(expr)
    }

    /// The value of a curve, whose file has x from 0 to 1.
    fn curve(&self, name: &str, argument: &str) -> Option<String> {
        let curves = &self.source.grammar.curves;
        let at = curves.iter().position(|curve| curve.name == name).filter(|_| self.kind == Kind::Cpfg)?;
        let [first, .., last] = *curves[at].curve.points() else { return None };
        Some(match (first[0], last[0] - first[0]) {
            (0.0, 1.0) => format!("func({},{argument})", at + 1),
            (from, width) => format!("func({},(({argument})-({}))/{})", at + 1, number(from), number(width)),
        })
    }

    /// The line with the symbols that contexts see.
    pub(super) fn seen(&self) -> Result<String, Refusal> {
        let (word, list) = match &self.source.grammar.seen {
            Seen::Except(list) => ("ignore", list),
            Seen::Only(list) => ("consider", list),
            Seen::All => return Ok(String::new()),
        };
        if !self.source.needs(Need::Contexts) {
            return Ok(String::new());
        }
        let list = set(list.iter().copied());
        // Constant symbols became other symbols.
        let (mut listed, mut others) = (Vec::new(), Vec::new());
        for own in &self.source.symbols {
            let names = match self.name_of(own.symbol) {
                Some(name) => name.to_string(),
                None if self.is_own(own.symbol, own, false) => own.symbol.to_string(),
                None => without_arguments(&self.code(own, None)?),
            };
            (if list.binary_search(&own.symbol).is_ok() { &mut listed } else { &mut others }).extend(names.chars());
        }
        // Brackets always delimit branches.
        listed.retain(|name| !"[]".contains(*name));
        sorted::sort(&mut listed);
        listed.dedup();
        if listed.iter().any(|name| others.contains(name)) {
            return Err(Refusal(say!("{} cannot express which symbols contexts see", self.label)));
        }
        let listed: String = listed.into_iter().map(|name| numbered(name, &[])).collect();
        Ok(if listed.is_empty() && word == "ignore" { String::new() } else { format!("{word}: {listed}\n") })
    }

    /// Symbols with the actions of a symbol, the first of them with an argument.
    fn code(&self, symbol: &Symbol, argument: Option<&str>) -> Result<String, Refusal> {
        let mut text = String::new();
        let lpy = self.kind == Kind::LPy;
        let definition = self.source.definition;
        let angle = definition.angle;
        let [down, roll] = [definition.pitch_down, definition.roll_left];
        for (at, action) in symbol.actions.iter().enumerate() {
            let argument = argument.filter(|_| at == 0);
            let turn = |sign: char, own: f64| match argument {
                Some(argument) => format!("{sign}({argument})"),
                None => format!("{sign}({})", plain_number(own)),
            };
            let line = |letter: &str, own: Option<f64>| match (argument, own) {
                (Some(argument), _) => format!("{letter}({argument})"),
                (None, None) if !self.has_lengths => letter.to_owned(),
                (None, own) => format!("{letter}({})", plain_number(own.unwrap_or(definition.step))),
            };
            let [left, right] = if lpy { ['/', '\\'] } else { ['\\', '/'] };
            let [draw, go] = if lpy { ["F", "f"] } else { ["G", "g"] };
            text.push_str(&match *action {
                Action::Draw(own) => line("F", own),
                Action::Move(own) => line("f", own),
                Action::DrawUnmarked(own) => line(draw, own),
                Action::MoveUnmarked(own) => line(go, own),
                Action::TurnLeft(own) => turn('+', own.unwrap_or(angle)),
                Action::TurnRight(own) => turn('-', own.unwrap_or(self.source.right_angle())),
                Action::PitchDown(own) => turn('&', own.or(down).unwrap_or(angle)),
                Action::PitchUp(own) => turn('^', own.or(definition.pitch_up).or(down).unwrap_or(angle)),
                Action::RollLeft(own) => turn(left, own.or(roll).unwrap_or(angle)),
                Action::RollRight(own) => turn(right, own.or(definition.roll_right).or(roll).unwrap_or(angle)),
                Action::TurnRound => "|".to_owned(),
                Action::RollUpright => "@v".to_owned(),
                Action::Push => "[".to_owned(),
                Action::Pop => "]".to_owned(),
                Action::Cut => "%".to_owned(),
                Action::OpenPolygon => "{".to_owned(),
                Action::Vertex => ".".to_owned(),
                Action::ClosePolygon => "}".to_owned(),
                Action::OpenTube => "@Gs".to_owned(),
                Action::TubePoint => "@Gc".to_owned(),
                Action::CloseTube => "@Ge".to_owned(),
                Action::Fill(_, own) => line("@o", Some(own.unwrap_or(definition.step))),
                Action::Surface(name, own) => line(&format!("~{name}"), Some(own.unwrap_or(definition.step))),
                Action::SetColour(index) => format!(";({})", argument.map_or_else(|| index.to_string(), str::to_owned)),
                Action::AddColour(_) if argument.is_some() => format!(";({})", argument.unwrap_or_default()),
                Action::AddColour(by) => (if by < 0 { "," } else { ";" })
                    .repeat(usize::try_from(by.unsigned_abs().min(20)).unwrap_or_default()),
                Action::SetWidth(own) => format!("!({})", argument.map_or_else(|| plain_number(own), str::to_owned)),
                Action::ScaleWidth(_) if argument.is_some() => format!("!({})", argument.unwrap_or_default()),
                // Only looks, which are left out.
                Action::ScaleWidth(own) => if own == FRAC_1_SQRT_2 { "!" } else { "" }.to_owned(),
                _ => {
                    let symbol = symbol.symbol;
                    return Err(Refusal(say!("{} has no symbol that does what `{}` does", self.label, symbol)));
                }
            });
        }
        Ok(text)
    }

    fn arguments(&self, module: &Module) -> Result<Vec<String>, Refusal> {
        module.arguments.iter().map(|argument| self.expression(argument)).collect()
    }

    /// A word of a generation.
    fn word(&self, modules: &[Module]) -> Result<String, Refusal> {
        let mut text = Words::new(self.kind);
        for module in modules {
            let arguments = self.arguments(module)?;
            match (self.name_of(module.symbol), self.source.symbol(module.symbol)) {
                (None, Some(own)) if !self.is_own(own.symbol, own, !arguments.is_empty()) => {
                    text.push(&self.code(own, arguments.first().map(String::as_str))?);
                }
                (name, _) => text.push(&self.module(name.unwrap_or(module.symbol), &arguments, &|_, _| "0".to_owned())),
            }
        }
        Ok(text.text)
    }

    /// A word that is drawn, and not derived further.
    fn drawn(&self, modules: &[Module]) -> Result<String, Refusal> {
        let mut text = Words::new(self.kind);
        for module in modules {
            let arguments = self.arguments(module)?;
            if let Some(symbol) = self.source.symbol(module.symbol) {
                text.push(&self.code(symbol, arguments.first().map(String::as_str))?);
            }
        }
        Ok(text.text)
    }

    pub(super) fn axiom(&self) -> Result<String, Refusal> {
        let heading = self.source.definition.heading - 90.0;
        let start = if heading == 0.0 { String::new() } else { format!("+({})", plain_number(heading)) };
        let matched = |own: &Symbol| own.symbol == '+' && !own.is_constant();
        if heading != 0.0 && self.source.symbols.iter().any(matched) {
            return Err(Refusal(say!("{} starts upwards, and productions look at the turns", self.label)));
        }
        let place = match self.source.definition.start {
            [x, y] if self.kind == Kind::Cpfg && [x, y] != [0.0, 0.0] => {
                format!("@M({},{},0)", plain_number(x), plain_number(y))
            }
            _ => String::new(),
        };
        Ok(format!("{place}{start}{}", self.word(&self.source.grammar.axiom)?))
    }

    fn pattern(&self, pattern: &Pattern) -> String {
        // A name that no other parameter of the rule has.
        let third = |x: &str, y: &str| format!("{x}_{y}");
        self.module(self.name_of(pattern.symbol).unwrap_or(pattern.symbol), &pattern.parameters, &third)
    }

    /// A symbol with arguments; `third` makes the argument that a query in the plane lacks.
    fn module(&self, symbol: char, arguments: &[String], third: &dyn Fn(&str, &str) -> String) -> String {
        match Query::of_symbol(symbol) {
            Some(_) if self.kind == Kind::LPy => numbered(symbol, &queries::of_lpy(arguments, third)),
            _ => numbered(symbol, arguments),
        }
    }

    fn production(&self, rule: &Production, successor: &str) -> Result<String, Refusal> {
        let context = |list: &[Pattern]| {
            let mut words = Words::new(self.kind);
            list.iter().for_each(|own| words.push(&self.pattern(own)));
            words.text
        };
        let mut text = String::new();
        if !rule.left.is_empty() {
            text = format!("{} < ", context(&rule.left));
        }
        text.push_str(&self.pattern(&rule.predecessor));
        if !rule.right.is_empty() {
            let _ = write!(text, " > {}", context(&rule.right));
        }
        let condition = rule.condition.as_ref().map(|condition| self.expression(condition)).transpose()?;
        let successor = if successor.is_empty() { "*" } else { successor };
        if let Some(condition) = condition {
            if self.kind == Kind::LPy {
                return Ok(format!("{text}:\n  if {condition}: produce {successor}"));
            }
            let _ = write!(text, " : {condition}");
        }
        let _ = write!(text, " --> {successor}");
        if let Some(weight) = rule.weight.as_ref().filter(|_| self.kind == Kind::Cpfg) {
            let _ = write!(text, " : {}", self.expression(weight)?);
        }
        Ok(text)
    }

    /// Writes the productions, and what symbols do.
    pub(super) fn productions(&self, heading: &str, text: &mut String) -> Result<(), Refusal> {
        for rule in &self.source.grammar.productions {
            let _ = writeln!(text, "{}", self.production(rule, &self.word(&rule.successor)?)?);
        }
        let mut images = Vec::new();
        for image in &self.source.grammar.images {
            images.push(self.production(image, &self.drawn(&image.successor)?)?);
        }
        images.extend(self.meanings()?);
        if !images.is_empty() {
            let _ = writeln!(text, "{heading}\nmaximum depth: 1\n{}", images.join("\n"));
        }
        Ok(())
    }

    /// Productions for drawing that give symbols their actions.
    fn meanings(&self) -> Result<Vec<String>, Refusal> {
        let mut found = Vec::new();
        let letters = self.source.system.rules.letters.iter();
        for letter in letters {
            let (symbol, arity) = (letter.symbol, usize::from(letter.arity));
            let (Some(name), Some(own)) = (self.name_of(symbol), self.source.symbol(symbol)) else { continue };
            let mut same = self
                .source
                .grammar
                .images
                .iter()
                .filter(|image| image.predecessor.symbol == symbol && image.predecessor.parameters.len() == arity);
            if self.is_own(name, own, arity > 0) || same.clone().any(|image| image.condition.is_none()) {
                continue;
            }
            if same.any(|image| image.weight.is_some()) {
                return Err(Refusal(say!("{} cannot express the random drawings of `{}`", self.label, symbol)));
            }
            let parameters: Vec<String> = (1..=arity).map(|at| format!("p{at}")).collect();
            let code = self.code(own, parameters.first().map(String::as_str))?;
            let code = if code.is_empty() { "*" } else { &code };
            found.push(format!("{} --> {code}", numbered(name, &parameters)));
        }
        Ok(found)
    }
}
