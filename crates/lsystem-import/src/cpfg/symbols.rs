//! Words of cpfg and L-Py in our notation: names and symbols of several characters become single symbols.

use super::arithmetic::Arithmetic;
use super::macros::{arguments, is_part};
use super::{Kind, Places};
use crate::draft::{Draft, FreeSymbols};
use core::ops::Range;
use lsystem_base::{number::number, say, word, words::said};
use lsystem_syntax::Query;
use std::collections::{BTreeMap, BTreeSet};

/// What a name or a symbol of several characters is here.
#[derive(Clone, Copy)]
enum Meaning {
    /// One of our symbols.
    Symbol(char),
    /// A disc, by its diameter or by its radius; whether it is a sphere there.
    Disc { radius: bool, sphere: bool },
    /// A part of a tube, in the words of custom symbols.
    Tube(&'static str),
    /// A surface of the definition.
    Surface(char),
    /// A module without an action.
    Plain,
    /// A module whose action is left out, for this reason.
    LeftOut(&'static str),
    /// A module that is left out with one number and has no equal with several.
    Switch { left_out: &'static str, refused: &'static str },
    /// It has no equal, for this reason.
    Refused(&'static str),
}
use Meaning::{Disc, LeftOut, Plain, Refused, Surface, Switch, Symbol, Tube};

const CYLINDER: &str = word!("How the width of generalized cylinders changes between two places has no equal here");
const TANGENTS: &str = word!("How far generalized cylinders swing out between two places is left out: they are smooth");
const WIDTHS: &str = word!("The width of generalized cylinders changes evenly between two places here");
const SIDES: &str = word!("The number of sides of round shapes is not used");
const ROUND: &str = word!("The number of strips of a generalized cylinder is not used: every part has 8");
const SMOOTH: &str = word!("In a text with generalized cylinders, all lines are drawn as smooth tubes");
const BENDS: &str = word!("How branches bend stands in cpfg's view file; this is left out");
const SCALE: &str = word!("This changes the scale of the turtle, which has no equal here");
const PLACE: &str = word!("This moves the turtle to a place of its own, which has no equal here");
const FRAME: &str = word!("This sets the turtle's heading in space, which has no equal here");
const ASKS: &str = word!("This asks for the state of the turtle, which rules do not know here");
const SHAPE: &str = word!("This shape is not drawn");
const GUIDE: &str = word!("Curves that guide the turtle have no equal here");
const LOOK: &str = word!("This changes only how surfaces look; it is left out");
const TROPISM: &str = word!("Tropisms that begin inside the word have no equal here");

/// The symbols of several characters of cpfg, a row for each meaning.
const CPFG: &[(&str, Meaning)] = &[
    ("@v", Symbol('$')),
    ("@o @c", Disc { radius: false, sphere: false }),
    ("@O", Disc { radius: false, sphere: true }),
    ("@bo @bc", Symbol('○')),
    ("@L", LeftOut(word!("The label is not drawn"))),
    ("@S", LeftOut(word!("Commands of the system are never run"))),
    ("@; @, @# @Tx @mo", LeftOut(LOOK)),
    ("@Ti @Td @Ts @Tf", LeftOut(BENDS)),
    ("@T", Refused(word!("This turns the turtle by the twist of its way, which has no equal here"))),
    ("@P @PS @PC @PD", LeftOut(word!("This patch of a surface is not drawn"))),
    ("@Gs", Tube("open tube")),
    ("@Gc", Tube("tube point")),
    ("@Ge", Tube("close tube")),
    ("@Gr", Switch { left_out: WIDTHS, refused: CYLINDER }),
    ("@Gt", LeftOut(TANGENTS)),
    ("@!", LeftOut(SIDES)),
    ("@D", Refused(SCALE)),
    ("@M", Refused(PLACE)),
    ("@R", Refused(FRAME)),
    ("?P", Symbol('Ⓟ')),
    ("?H", Symbol('Ⓗ')),
    ("?L", Symbol('Ⓛ')),
    ("?U", Symbol('Ⓤ')),
    ("?Q", Refused(ASKS)),
    ("?E", Refused(word!("This asks another program for the environment, which has no equal here"))),
];

/// The names of L-Py's library, a row for each meaning.
const LPY: &[(&str, Meaning)] = &[
    ("SB", Symbol('[')),
    ("EB", Symbol(']')),
    ("BP", Symbol('{')),
    ("EP", Symbol('}')),
    ("PP", Symbol('.')),
    ("nF", Symbol('F')),
    ("Left", Symbol('+')),
    ("Right", Symbol('-')),
    ("Up", Symbol('^')),
    ("Down", Symbol('&')),
    ("RollL iRollL", Symbol('/')),
    ("RollR iRollR", Symbol('\\')),
    ("TurnAround", Symbol('|')),
    ("RollToVert @v @V", Symbol('$')),
    ("IncWidth SetWidth", Symbol('_')),
    ("DecWidth", Symbol('!')),
    ("IncColor SetColor", Symbol(';')),
    ("DecColor", Symbol(',')),
    ("Sphere @O", Disc { radius: true, sphere: true }),
    ("Circle @o", Disc { radius: true, sphere: false }),
    ("Frame Box @B Quad @b PglShape @g", LeftOut(SHAPE)),
    ("Label @L", LeftOut(word!("The label is not drawn"))),
    ("Surface", LeftOut(word!("The surface is not drawn"))),
    ("StartGC @Gc EndGC @Ge", Tube("open tube")),
    (
        "SetContour SectionResolution InterpolateColors TextureScale TextureUScale TextureVScale TextureTranslation TextureRotation TextureTransformation",
        LeftOut(LOOK),
    ),
    ("SetScale @D DivScale @Dd MultScale @Di", Refused(SCALE)),
    ("MoveTo @M MoveRel LineTo LineRel OLineTo OLineRel", Refused(PLACE)),
    ("Pinpoint PinpointRel SetHead @R EulerAngles RollToHorizontal @h", Refused(FRAME)),
    ("Sweep", Refused(word!("Sweeps along a curve have no equal here"))),
    ("SetGuide EndGuide PositionOnGuide", Refused(GUIDE)),
    ("Tropism @Tp Elasticity @Ts", Refused(TROPISM)),
    ("?P GetPos", Symbol('Ⓟ')),
    ("?H GetHead", Symbol('Ⓗ')),
    ("?U GetUp", Symbol('Ⓤ')),
    ("?L GetLeft", Symbol('Ⓛ')),
    ("?R ?F GetRight GetFrame", Refused(ASKS)),
];

/// The most symbols with a remark.
const MAX_REMARKS: usize = 600;

/// A part of a production.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Role {
    /// The axiom or a successor, with arithmetic.
    Word,
    /// A predecessor and its contexts, with names of parameters.
    Head,
}

/// The translation of words.
pub(super) struct Symbols<'p> {
    arithmetic: &'p Arithmetic,
    places: Places<'p>,
    meanings: BTreeMap<String, Meaning>,
    /// The number of bytes of the longest name.
    longest: usize,
    pub(super) free: FreeSymbols,
    told: BTreeSet<String>,
    /// Whether a tube was read.
    pub(super) has_tubes: bool,
    /// Symbols that are not drawn: those whose arguments are left out, and those that rules replace.
    bare: BTreeMap<String, Range<usize>>,
    replaced: BTreeSet<String>,
}

impl<'p> Symbols<'p> {
    /// `names` are those that the text declares or replaces.
    pub(super) fn new(
        arithmetic: &'p Arithmetic,
        places: Places<'p>,
        names: &BTreeSet<String>,
        surfaces: &[(char, char)],
    ) -> Self {
        let library = if arithmetic.kind == Kind::Cpfg { CPFG } else { LPY };
        let row =
            |&(names, meaning): &(&'static str, Meaning)| names.split(' ').map(move |name| (name.to_owned(), meaning));
        let mut meanings: BTreeMap<String, Meaning> = library.iter().flat_map(row).collect();
        // An own name counts before the library's.
        meanings.extend(names.iter().map(|name| (name.clone(), Plain)));
        meanings.extend(surfaces.iter().map(|&(known, own)| (format!("~{known}"), Surface(own))));
        let longest = meanings.keys().map(String::len).max().unwrap_or_default();
        Self {
            arithmetic,
            places,
            meanings,
            longest,
            free: FreeSymbols::default(),
            told: BTreeSet::new(),
            has_tubes: false,
            bare: BTreeMap::new(),
            replaced: BTreeSet::new(),
        }
    }

    /// A word in our notation. `place` is where it stands if it is no part of the text.
    pub(super) fn read(&mut self, text: &str, role: Role, place: &Range<usize>, draft: &mut Draft<'_>) -> String {
        let mut out = String::new();
        let mut rest = text;
        while let Some(ch) = rest.chars().next() {
            if ch.is_whitespace() {
                rest = rest.trim_start();
                out.push(' ');
                continue;
            }
            let length = self.symbol(rest).unwrap_or(ch.len_utf8());
            let (symbol, behind) = rest.split_at(length);
            let at = self.places.or(symbol, place);
            let opened = behind.trim_start();
            let behind = if self.arithmetic.kind == Kind::Cpfg && opened.starts_with('(') { opened } else { behind };
            let Some((inside, behind)) = parenthesised(behind) else {
                draft.refuse_at(at, say!("A parenthesis behind this symbol is not closed"));
                break;
            };
            rest = behind;
            self.module(symbol, inside, role, &at, draft, &mut out);
        }
        out.trim().to_owned()
    }

    /// The number of bytes of the name or the symbol of several characters at the start; `None` for a single character.
    fn symbol(&self, text: &str) -> Option<usize> {
        let mut chars = text.chars();
        let (first, second) = (chars.next()?, chars.next());
        if first == '~' {
            return second.filter(|c| !c.is_whitespace() && *c != '(').map(|second| 1 + second.len_utf8());
        }
        if first == '@' || first == '?' || first.is_alphabetic() {
            let parts = text.char_indices().skip(1).find(|&(at, c)| at >= self.longest || !is_part(c));
            let longest = if first.is_alphabetic() { parts.map_or(text.len(), |(at, _)| at) } else { 4 };
            let longest = self.longest.min(longest).min(text.len());
            let known = |end: &usize| text.get(..*end).is_some_and(|name| self.meanings.contains_key(name));
            if let Some(end) = (2..=longest).rev().find(known) {
                return Some(end);
            }
        }
        let is_function = matches!(first, '@' | '?') && self.arithmetic.kind == Kind::Cpfg;
        second.filter(|c| is_function && !c.is_whitespace() && *c != '(').map(|second| 1 + second.len_utf8())
    }

    /// Writes a module in our notation.
    fn module(
        &mut self,
        symbol: &str,
        inside: Option<&str>,
        role: Role,
        place: &Range<usize>,
        draft: &mut Draft<'_>,
        out: &mut String,
    ) {
        let is_surface = matches!(self.meanings.get(symbol), Some(Surface(_)));
        let is_drawn =
            (is_surface || !symbol.starts_with('~')) && !matches!(self.meanings.get(symbol), Some(LeftOut(_)));
        if role == Role::Head && !is_drawn {
            self.replaced.insert(symbol.to_owned());
        }
        let mut inside = match inside {
            Some(inside) if role == Role::Head => Some(inside.trim().to_owned()),
            Some(inside) => match self.arithmetic.read(inside) {
                Ok(inside) => Some(inside),
                Err(_) if !is_drawn => {
                    self.bare.insert(symbol.to_owned(), place.clone());
                    None
                }
                Err(why) => return draft.refuse_at(self.places.or(inside, place), why),
            },
            None => None,
        };
        let meaning = match self.meanings.get(symbol).copied() {
            Some(Switch { refused, .. }) if inside.as_ref().is_some_and(|inside| inside.contains(',')) => {
                Some(Refused(refused))
            }
            Some(Switch { left_out, .. }) => Some(LeftOut(left_out)),
            other => other,
        };
        match meaning {
            Some(Symbol(own)) if self.asks_lpy(own) && inside.is_some() => {
                // The axes of L-Py's turtle are others: its z is ours upwards.
                let turned = inside.as_deref().and_then(turned);
                if turned.is_none() {
                    return draft.refuse_at(place.clone(), say!("A query of L-Py is read with three numbers"));
                }
                inside = turned;
                out.push_str(&Query::of_symbol(own).map_or(String::new(), |query| query.to_string()));
            }
            Some(Symbol(symbol)) => match Query::of_symbol(symbol).filter(|_| inside.is_some()) {
                Some(query) => out.push_str(&query.to_string()),
                None => out.push(symbol),
            },
            Some(Disc { radius, sphere }) => {
                if radius && role == Role::Head && inside.is_some() {
                    return draft
                        .refuse_at(place.clone(), say!("A rule that replaces a disc by its radius is not read"));
                }
                let note = match inside {
                    None => Some(say!("This disc is as large as the line is wide; here it is as large as a step")),
                    Some(_) if sphere => Some(say!("A sphere is drawn as a disc")),
                    Some(_) => None,
                };
                if let Some(note) = note {
                    self.tell(symbol, place, note, draft);
                }
                if let Some(number) = inside.as_mut().filter(|_| radius) {
                    *number = doubled(number);
                }
                out.push('●');
            }
            Some(Plain) => {
                let own = self.free.get(symbol);
                let note = say!("The name `{}` becomes the symbol `{}`", symbol, own);
                self.tell(symbol, place, note, draft);
                out.push(own);
            }
            Some(Surface(name)) => {
                let own = self.free.get(symbol);
                draft.meaning(own, format!("surface {name}"));
                out.push(own);
            }
            Some(Tube(actions)) => {
                let own = self.free.get(symbol);
                match self.arithmetic.kind {
                    Kind::Cpfg if inside.is_some() => self.tell("@G", place, said(ROUND), draft),
                    Kind::Cpfg => {}
                    Kind::LPy => self.tell("@G", place, said(SMOOTH), draft),
                }
                self.has_tubes = true;
                draft.meaning(own, actions);
                out.push(own);
            }
            Some(LeftOut(why)) => {
                self.tell(symbol, place, said(why), draft);
                out.push(self.free.get(symbol));
            }
            Some(Refused(why) | Switch { refused: why, .. }) => return draft.refuse_at(place.clone(), said(why)),
            None => self.other(symbol, inside.as_deref(), place, draft, out),
        }
        if let Some(inside) = inside {
            out.extend(["(", &inside, ")"]);
        }
    }

    /// Whether a symbol of ours is a query of L-Py.
    fn asks_lpy(&self, symbol: char) -> bool {
        self.arithmetic.kind == Kind::LPy && Query::of_symbol(symbol).is_some()
    }

    /// Writes a symbol that no table names.
    fn other(
        &mut self,
        symbol: &str,
        inside: Option<&str>,
        place: &Range<usize>,
        draft: &mut Draft<'_>,
        out: &mut String,
    ) {
        let is_cpfg = self.arithmetic.kind == Kind::Cpfg;
        match symbol {
            _ if self.told.len() > MAX_REMARKS => {
                return draft.refuse_at(place.clone(), say!("So many different symbols are not read"));
            }
            _ if symbol.starts_with('~') && symbol.len() > 1 => {
                self.tell(symbol, place, say!("The surface `{}` is not drawn: its file is not given", symbol), draft);
                return out.push(self.free.get(symbol));
            }
            "?" if is_cpfg => {
                return draft.refuse_at(place.clone(), say!("`?` begins a sub-L-system, which has no equal here"));
            }
            _ if symbol.starts_with(['@', '?']) && symbol.len() > 1 => {
                let why = say!("The function `{}` of cpfg has no equal here", symbol);
                return draft.refuse_at(place.clone(), why);
            }
            "$" if is_cpfg => {
                let why = say!(
                    "`$` rolls upright, as in ABOP; newer versions of cpfg write `@v` and end a sub-L-system with `$`"
                );
                self.tell(symbol, place, why, draft);
            }
            "$" => return out.push(self.free.get(symbol)),
            "_" if is_cpfg => self.tell(symbol, place, said(BENDS), draft),
            "!" | "#" | "_" if inside.is_none() => {
                let why = match is_cpfg {
                    true => {
                        say!("By how much this changes the width stands in cpfg's view file; here it is a factor of √2")
                    }
                    false => say!("By how much this changes the width is a setting of L-Py; here it is a factor of √2"),
                };
                self.tell(symbol, place, why, draft);
            }
            "{" | "}" if is_cpfg && inside.is_some_and(|inside| inside != "0") => {
                return draft
                    .refuse_at(place.clone(), say!("Curves through points, with numbers at `{{`, have no equal here"));
            }
            "F" if !is_cpfg && inside.is_some_and(|inside| inside.contains(',')) => {
                self.tell(symbol, place, say!("The width at the end of `F` is not carried over"), draft);
            }
            "`" => return out.push_str("```"),
            _ => {}
        }
        out.push_str(symbol);
    }

    /// Refuses the system if a rule replaces a symbol whose arguments are left out.
    pub(super) fn check_bare(&self, draft: &mut Draft<'_>) {
        let wrong = self.bare.iter().filter(|(symbol, _)| self.replaced.contains(*symbol));
        wrong.for_each(|(symbol, place)| {
            draft.refuse_at(place.clone(), say!("The arguments of `{}`, which a rule replaces, are not read", symbol));
        });
    }

    /// The symbols that stand for surfaces, sorted.
    pub(super) fn surfaces(&self) -> BTreeSet<char> {
        self.free.given().filter(|(name, _)| name.starts_with('~')).map(|(_, symbol)| symbol).collect()
    }

    /// The letters of surfaces in cpfg, with the symbols that stand for them.
    pub(super) fn surface_letters(&self) -> impl Iterator<Item = (char, char)> {
        let letter = |name: &str| name.strip_prefix('~')?.chars().next();
        let is_cpfg = self.arithmetic.kind == Kind::Cpfg;
        self.free.given().filter(move |_| is_cpfg).filter_map(move |(name, own)| Some((letter(name)?, own)))
    }

    /// Adds a remark at the first place of a symbol.
    fn tell(&mut self, symbol: &str, place: &Range<usize>, message: String, draft: &mut Draft<'_>) {
        if self.told.insert(format!("{symbol} {message}")) {
            draft.note_at(place.clone(), message);
        }
    }
}

/// The text in the parentheses at the start, if there are any, and the text behind; `None` if they are not closed.
pub(super) fn parenthesised(text: &str) -> Option<(Option<&str>, &str)> {
    let Some(inside) = text.strip_prefix('(') else { return Some((None, text)) };
    let (_, behind) = arguments(inside)?;
    Some((Some(&inside[..inside.len() - behind.len() - 1]), behind))
}

/// The three arguments of a query of L-Py in our order.
fn turned(text: &str) -> Option<String> {
    let closed = format!("{text})");
    match *arguments(&closed)?.0 {
        [x, y, z] => Some(format!("{},{},{}", y.trim(), z.trim(), x.trim())),
        _ => None,
    }
}

/// Twice the first of these arguments, and the others.
fn doubled(text: &str) -> String {
    let closed = format!("{text})");
    let first = arguments(&closed).and_then(|(all, _)| all.first().copied()).unwrap_or(text);
    let rest = &text[first.len()..];
    match first.trim().parse::<f64>() {
        Ok(value) => format!("{}{rest}", number(2.0 * value)),
        Err(_) => format!("2*({}){rest}", first.trim()),
    }
}
