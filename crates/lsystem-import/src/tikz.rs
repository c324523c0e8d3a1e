//! TikZ's library `lindenmayersystems`.
//!
//! ```text
//! \pgfdeclarelindenmayersystem{Koch}{\rule{F -> F-F++F-F}}
//! \draw [l-system={Koch, axiom=F++F++F, order=3, angle=60}] lindenmayer system;
//! \draw [rotate=90, l-system={rule set={F -> FF}, axiom=F}] lindenmayer system;
//! ```
//!
//! The turtle starts to the right. Angles are 90 degrees where they are missing. `F` draws, `f` moves,
//! `+ - [ ]` turn and branch; `\symbol` gives other symbols one of these actions. Rotations of the path and of the
//! environments around it turn the heading.

use crate::draft::{Draft, production, turtle};
use crate::rules::split_rule;
use crate::source::Source;
use crate::value::whole_number;
use core::ops::Range;
use lsystem_base::{decimal, number::number, say, sorted, word, words::said};
use lsystem_syntax::{Grammar, Module, look_alike};
use std::collections::{HashMap, HashSet};

/// A declared system.
struct Declared<'a> {
    name: &'a str,
    body: &'a str,
    /// The whole declaration.
    span: Range<usize>,
}

/// The library's commands, in the words of custom symbols.
const COMMANDS: [(&str, &str); 6] = [
    ("\\pgflsystemdrawforward", "draw"),
    ("\\pgflsystemmoveforward", "move"),
    ("\\pgflsystemturnleft", "turn left"),
    ("\\pgflsystemturnright", "turn right"),
    ("\\pgflsystemsavestate", "open branch"),
    ("\\pgflsystemrestorestate", "close branch"),
];

/// The most declarations and the most uses that are read.
const MAX: usize = 500;
/// The most bytes that are searched for the end of a group or a statement.
const FAR: usize = 10_000;
/// The keys of a system.
const KEYS: [&str; 2] = ["l-system", "lindenmayer system"];
/// The commands that begin a path.
const PATHS: [&str; 7] = ["\\draw", "\\path", "\\fill", "\\shade", "\\clip", "\\node", "\\pattern"];

pub(super) fn read<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let text = source.text;
    if !["l-system", "lindenmayer"].iter().any(|word| text.contains(word)) {
        return None;
    }
    let tex = Tex::new(source);
    let mut declared = Vec::new();
    for (at, mark) in tex.matches(text, "\\pgfdeclarelindenmayersystem").take(MAX) {
        let Some((name, after)) = tex.group(&text[at + mark.len()..]) else { continue };
        let Some((body, rest)) = tex.group(after) else { continue };
        declared.push(Declared { name: name.trim(), body, span: at..text.len() - rest.len() });
    }
    let by_name: HashMap<&str, &Declared<'_>> = declared.iter().map(|one| (one.name, one)).collect();
    let environments = tex.environments();
    let mut drafts = Vec::new();
    // The declarations whose bytes have marks already.
    let mut used: HashSet<&str> = HashSet::new();
    for key in KEYS {
        for (at, mark) in tex.matches(text, key).take(MAX) {
            let rest = text[at + mark.len()..].trim_start();
            let Some((options, _)) = rest.strip_prefix('=').and_then(|rest| tex.group(rest)) else { continue };
            let mut draft = Draft::new(source, "", source.line_of(at));
            system(&tex, options, &by_name, &mut used, &mut draft);
            tex.surroundings(at, &environments, &mut draft);
            drafts.push((at, draft));
        }
    }
    // A name in a style or in a path may stand without options.
    for one in declared.iter().filter(|one| !used.contains(one.name)).take(100) {
        let at = source.place(one.body).unwrap_or_default().start;
        let mut draft = Draft::new(source, one.name, source.line_of(at));
        draft.covers(one.span.clone());
        draft.pass(one.span.clone());
        draft.refuse_at(draft.place(one.name), say!("The text gives no axiom for this system"));
        drafts.push((at, draft));
    }
    sorted::sort_by_key(&mut drafts, |(at, _)| *at);
    let mut drafts: Vec<Draft<'_>> = drafts.into_iter().map(|(_, draft)| draft).collect();
    for command in ["\\pgftransform", "\\rotatebox", "\\reflectbox", "\\scalebox", "\\tikzset"] {
        for (at, mark) in tex.matches(text, command).take(1) {
            let place = at..at + mark.len();
            drafts.iter_mut().take(1).for_each(|draft| draft.note_at(place.clone(), say!("This is not carried over")));
        }
    }
    (!drafts.is_empty()).then_some(drafts)
}

/// A text in TeX, with its comments.
struct Tex<'a> {
    source: Source<'a>,
    /// The comments without their line ends, in order.
    comments: Vec<Range<usize>>,
}

impl<'a> Tex<'a> {
    fn new(source: Source<'a>) -> Self {
        let mut comments = Vec::new();
        let mut bytes = source.text.bytes().enumerate();
        while let Some((at, byte)) = bytes.next() {
            match byte {
                b'\\' => drop(bytes.next()),
                b'%' => {
                    let end = bytes.find(|(_, byte)| *byte == b'\n').map_or(source.text.len(), |(end, _)| end);
                    comments.push(at..end);
                }
                _ => {}
            }
        }
        Self { source, comments }
    }

    /// The end of the comment that a place of the text lies in.
    fn comment(&self, at: usize) -> Option<usize> {
        let next = self.comments.partition_point(|comment| comment.end <= at);
        self.comments.get(next).filter(|comment| comment.start <= at).map(|comment| comment.end)
    }

    /// Passes over the comments in a part of the text.
    fn pass_comments(&self, part: &str, draft: &mut Draft<'_>) {
        let start = self.start(part);
        let first = self.comments.partition_point(|comment| comment.start < start);
        let inside = self.comments.iter().skip(first).take_while(|comment| comment.start < start + part.len());
        inside.for_each(|comment| draft.pass(comment.clone()));
    }

    /// The place of a part of the text in the text.
    fn start(&self, part: &str) -> usize {
        self.source.place(part).unwrap_or_default().start
    }

    /// The places of a word in a part of the text, in bytes of the part, outside comments.
    fn matches<'b>(&'b self, part: &'b str, word: &'b str) -> impl Iterator<Item = (usize, &'b str)> {
        let start = self.start(part);
        part.match_indices(word).filter(move |(at, _)| self.comment(start + at).is_none())
    }

    /// The text in the braces at the start of a text, and the text behind.
    fn group(&self, text: &'a str) -> Option<(&'a str, &'a str)> {
        self.closed(text, '{', '}')
    }

    /// The text between brackets at the start of a text, and the text behind. Comments do not count.
    fn closed(&self, text: &'a str, open: char, close: char) -> Option<(&'a str, &'a str)> {
        let mut text = text.trim_start();
        while let Some(end) = self.comment(self.start(text)).filter(|_| text.starts_with('%')) {
            text = text.get(end - self.start(text)..)?.trim_start();
        }
        let inside = text.strip_prefix(open)?;
        let start = self.start(inside);
        let (mut depth, mut braces) = (1_usize, 0_usize);
        for (at, ch) in inside.char_indices().take(FAR) {
            if !matches!(ch, '{' | '}' | '[' | ']') || self.comment(start + at).is_some() {
                continue;
            }
            match ch {
                _ if ch == open && braces == 0 => depth += 1,
                _ if ch == close && braces == 0 => depth -= 1,
                '{' => braces += 1,
                '}' => braces = braces.checked_sub(1)?,
                _ => {}
            }
            if depth == 0 {
                return Some((&inside[..at], &inside[at + 1..]));
            }
        }
        None
    }

    /// The options between commas outside braces, without comments around them.
    fn options(&self, text: &'a str) -> Vec<&'a str> {
        let start = self.start(text);
        let (mut found, mut depth, mut own): (Vec<&str>, usize, Option<Range<usize>>) = (Vec::new(), 0, None);
        let mut behind_comment = 0;
        for (at, ch) in text.char_indices() {
            if ch == '%' && at >= behind_comment {
                behind_comment = self.comment(start + at).map_or(at, |end| end - start);
            }
            if at < behind_comment {
                continue;
            }
            match ch {
                '{' => depth += 1,
                '}' => depth = depth.saturating_sub(1),
                ',' if depth == 0 => {
                    found.extend(own.take().and_then(|own| text.get(own)));
                    continue;
                }
                _ if ch.is_whitespace() => continue,
                _ => {}
            }
            let end = at + ch.len_utf8();
            own = Some(own.map_or(at, |own| own.start)..end);
        }
        found.extend(own.and_then(|own| text.get(own)));
        found
    }

    /// The environments, those inside before those around them.
    fn environments(&self) -> Vec<Environment<'a>> {
        let text = self.source.text;
        let (mut found, mut open): (Vec<Environment<'_>>, Vec<Environment<'_>>) = (Vec::new(), Vec::new());
        let begins = self.matches(text, "\\begin{").map(|(at, mark)| (at + mark.len(), true));
        let mut marks: Vec<_> = begins.chain(self.matches(text, "\\end{").map(|(at, _)| (at, false))).collect();
        sorted::sort(&mut marks);
        let mut searched = 0;
        for (at, begins) in marks {
            if !begins {
                found.extend(open.pop().map(|one| Environment { inside: one.inside.start..at, ..one }));
                continue;
            }
            let name = text[at..].bytes().take(100).position(|byte| byte == b'}');
            let rest = name.map_or("", |end| text[at + end + 1..].trim_start());
            let is_open = rest.starts_with('[') && searched < MAX;
            searched += usize::from(is_open);
            let options = is_open.then(|| self.closed(rest, '[', ']')).flatten().map_or("", |(options, _)| options);
            let mut turned = open.last().map_or(Ok(0.0), |outer| outer.turned);
            for option in self.options(options).into_iter().filter_map(transform) {
                turned = turned.and_then(|turned| Ok(turned + option?));
            }
            open.push(Environment { inside: at..text.len(), options, turned });
        }
        found.extend(open.into_iter().rev());
        found
    }

    /// Reads the options of the path that a system at this place belongs to, and of the environments around it.
    fn surroundings(&self, at: usize, environments: &[Environment<'a>], draft: &mut Draft<'a>) {
        if let Some(inner) = environments.iter().find(|one| one.inside.contains(&at)) {
            turn(inner.turned, draft.place(inner.options), draft);
        }
        let before = self.near(at.saturating_sub(FAR), at);
        let from = self.matches(before, ";").last().map_or(0, |(end, _)| end + 1);
        let before = &before[from..];
        let Some(path) = PATHS.iter().filter_map(|path| Some(self.matches(before, path).last()?.0)).max() else {
            return;
        };
        let outer = self.matches(&before[..path], "\\tikz").last().map(|(at, mark)| &before[at + mark.len()..]);
        if let Some((options, _)) = outer.and_then(|rest| self.closed(rest, '[', ']')) {
            for option in self.options(options) {
                transform(option).into_iter().for_each(|turned| turn(turned, draft.place(option), draft));
            }
        }
        // The groups of options on the path, as far as its semicolon.
        let from = self.start(&before[path..]);
        let mut rest = self.near(from, from + FAR);
        rest = &rest[..self.matches(rest, ";").find(|(end, _)| from + end > at).map_or(rest.len(), |(end, _)| end)];
        while let Some((options, behind)) = rest.find('[').and_then(|open| self.closed(&rest[open..], '[', ']')) {
            draft.covers(draft.place(options));
            self.pass_comments(options, draft);
            for option in self.options(options) {
                let place = draft.place(option);
                match transform(option) {
                    Some(turned) => turn(turned, place, draft),
                    // A system, whose options have marks of their own.
                    None if place.contains(&at) || KEYS.iter().any(|key| option.starts_with(key)) => draft.pass(place),
                    None => draft.note_at(place, say!("How the path is drawn is not carried over")),
                }
            }
            rest = behind;
        }
    }

    /// The text between two places, which are moved to the ends of characters.
    fn near(&self, from: usize, to: usize) -> &'a str {
        let text = self.source.text;
        let to = to.min(text.len());
        let ends = |from: usize| (from..=to).find(|at| text.is_char_boundary(*at)).unwrap_or(to);
        let mut end = to;
        while !text.is_char_boundary(end) {
            end -= 1;
        }
        text.get(ends(from)..end).unwrap_or_default()
    }
}

/// An environment, and what its options and those around it do to a path.
struct Environment<'a> {
    inside: Range<usize>,
    options: &'a str,
    turned: Turned,
}

/// Degrees counter-clockwise; or the reason why an option cannot be followed.
type Turned = Result<f64, &'static str>;

/// What an option does that moves or turns the whole path; `None` for other options.
fn transform(option: &str) -> Option<Turned> {
    let (key, value) = option.split_once('=').map_or((option, ""), |(key, value)| (key.trim(), value.trim()));
    let turned = match key {
        "rotate" => whole_number(value),
        "rotate around" => whole_number(value.trim_start_matches('{').split(':').next().unwrap_or_default()),
        "scale" => {
            whole_number(value).filter(|factor| *factor != 0.0).map(|factor| if factor < 0.0 { 180.0 } else { 0.0 })
        }
        "shift" | "xshift" | "yshift" => Some(0.0),
        "xscale" | "yscale" | "xslant" | "yslant" | "cm" => {
            return Some(Err(word!("This stretches or mirrors the drawing, which has no equal here")));
        }
        _ => return None,
    };
    Some(turned.ok_or(word!("The rotation or the factor is not a number")))
}

/// Turns the heading, as the options at this place say.
fn turn(turned: Turned, place: Range<usize>, draft: &mut Draft<'_>) {
    match turned {
        Ok(0.0) => draft.pass(place),
        Ok(turned) => {
            let heading = draft.definition.heading + turned;
            draft.definition.heading = heading - 360.0 * libm::floor(heading / 360.0);
            draft.read(place, say!("heading {}", number(draft.definition.heading)));
        }
        Err(message) => draft.refuse_at(place, said(message)),
    }
}

/// A length of TeX in points.
fn points(text: &str) -> Option<f64> {
    let unit = text.find(|c: char| c.is_ascii_alphabetic())?;
    let points = match text[unit..].trim() {
        "pt" => 1.0,
        "mm" => 72.27 / 25.4,
        "cm" => 72.27 / 2.54,
        "in" => 72.27,
        _ => return None,
    };
    decimal::read(text[..unit].trim()).map(|number| number * points).filter(|step| step.is_finite() && *step > 0.0)
}

/// Reads the options of a system. `used` holds the names of the declarations that have marks.
fn system<'a>(
    tex: &Tex<'a>,
    text: &'a str,
    declared: &HashMap<&str, &Declared<'a>>,
    used: &mut HashSet<&'a str>,
    draft: &mut Draft<'a>,
) {
    let mut grammar = Grammar::default();
    let definition = &mut draft.definition;
    (definition.heading, definition.angle) = (0.0, 90.0);
    draft.others = Some("");
    turtle("TikZ").for_each(|(symbol, actions)| draft.meaning(symbol, actions));
    draft.covers(draft.place(text));
    tex.pass_comments(text, draft);
    let line = draft.line;
    let (mut angle_percent, mut step_percent, mut step) = (0.0, 0.0, 5.0);
    for option in tex.options(text) {
        let (key, value) = option.split_once('=').map_or((option, ""), |(key, value)| (key.trim(), value.trim()));
        let value = tex.group(value).map_or(value, |(inside, _)| inside.trim());
        let place = draft.place(option);
        let number_of = |draft: &mut Draft<'_>| {
            let found = whole_number(value);
            match found {
                Some(found) => draft.read(place.clone(), format!("{key} {}", number(found))),
                None => draft.refuse_at(place.clone(), say!("This is not a number")),
            }
            found.unwrap_or_default()
        };
        match key {
            "axiom" => {
                draft.read(place, say!("axiom {}", value));
                grammar.axiom = draft.symbols(value).into_iter().map(Module::from).collect();
            }
            "order" => {
                draft.iterations(draft.source.line_of(place.start), value);
                draft.read(place, format!("n {}", draft.definition.iterations));
            }
            "angle" => {
                draft.definition.angle = number_of(draft);
                draft.definition.right_angle = None;
            }
            "left angle" => {
                let right = draft.definition.right_angle.unwrap_or(draft.definition.angle);
                draft.definition.angle = number_of(draft);
                draft.definition.right_angle = Some(right);
            }
            "right angle" => draft.definition.right_angle = Some(number_of(draft)),
            "randomize angle percent" => angle_percent = number_of(draft),
            "randomize step percent" => step_percent = number_of(draft),
            "rule set" => {
                draft.pass(place);
                tex.options(value).into_iter().for_each(|rule| add_rule(rule, &mut grammar, draft));
            }
            // The size and the place of the whole drawing.
            "step" | "anchor" => {
                draft.pass(place);
                step = points(value).filter(|_| key == "step").unwrap_or(step);
            }
            _ if value.is_empty() => match declared.get(key) {
                Some(_) if !draft.definition.name.is_empty() => {
                    draft.refuse_at(place, say!("A second system is named here"));
                }
                Some(one) => {
                    draft.definition.name = key.chars().take(200).collect();
                    draft.read(place, say!("name {}", key));
                    if used.insert(one.name) {
                        draft.covers(draft.place(one.body));
                        draft.pass(one.span.start..draft.place(one.body).start);
                    }
                    body(tex, one.body, &mut grammar, draft);
                }
                None => draft.refuse_at(place, say!("The text does not declare this system")),
            },
            _ => draft.note_at(place, say!("This option is not carried over")),
        }
    }
    if grammar.axiom.is_empty() {
        draft.refuse(line, "", say!("The text gives no axiom for this system"));
    }
    // The library varies degrees and points by a twentieth of these numbers, whatever the angle and the step are.
    let share = |percent: f64, of: f64| {
        if percent == 0.0 { 0.0 } else { libm::round(percent / (20.0 * of.abs()) * 1e8) / 1e6 }
    };
    let definition = &mut draft.definition;
    let widest = definition.right_angle.unwrap_or(definition.angle).abs().max(definition.angle.abs());
    (definition.angle_variation, definition.length_variation) =
        (share(angle_percent, widest), share(step_percent, step));
    draft.grammar(&grammar);
}

/// Reads the body of a declaration.
fn body<'a>(tex: &Tex<'a>, text: &'a str, grammar: &mut Grammar, draft: &mut Draft<'a>) {
    let from = tex.start(text);
    tex.pass_comments(text, draft);
    for (at, mark) in tex.matches(text, "\\rule") {
        draft.pass(from + at..from + at + mark.len());
        match tex.group(&text[at + mark.len()..]) {
            Some((rule, _)) => add_rule(rule, grammar, draft),
            None => draft.refuse_at(from + at..from + at + mark.len(), say!("This rule has no braces")),
        }
    }
    for (at, mark) in tex.matches(text, "\\symbol") {
        let rest = &text[at + mark.len()..];
        let parts = tex.group(rest).and_then(|(symbol, rest)| Some((symbol.trim(), tex.group(rest)?)));
        let Some((symbol, (code, behind))) = parts else {
            draft.refuse_at(from + at..from + at + mark.len(), say!("This symbol has no two groups of braces"));
            continue;
        };
        let place = from + at..from + text.len() - behind.len();
        let Some(actions) = actions(tex, code) else {
            draft.refuse_at(draft.place(code.trim()), say!("The code of this symbol is not run"));
            draft.pass(place.start..draft.place(code.trim()).start);
            continue;
        };
        match symbol.chars().next() {
            Some(symbol) => {
                let symbol = look_alike(symbol).unwrap_or(symbol);
                draft.read(place, format!("{symbol}: {}", if actions.is_empty() { "nothing" } else { &actions }));
                draft.meaning(symbol, actions);
            }
            None => draft.refuse_at(place, say!("This symbol has no character")),
        }
    }
}

/// The actions of a code of known commands, in the words of custom symbols; `None` for other code.
fn actions(tex: &Tex<'_>, code: &str) -> Option<String> {
    let mut found = Vec::new();
    let mut rest = code.trim();
    while !rest.is_empty() {
        if let Some((angle, behind)) = rest.strip_prefix("\\pgftransformrotate").and_then(|rest| tex.group(rest)) {
            let angle = decimal::read(angle.trim()).filter(|angle| angle.is_finite())?;
            let side = if angle < 0.0 { "right" } else { "left" };
            found.push(format!("turn {side} {}", number(angle.abs())));
            rest = behind.trim_start();
            continue;
        }
        let (command, words) = COMMANDS.iter().find(|(command, _)| rest.starts_with(command))?;
        found.push((*words).to_owned());
        rest = rest[command.len()..].trim_start();
    }
    Some(found.join(", "))
}

fn add_rule(text: &str, grammar: &mut Grammar, draft: &mut Draft<'_>) {
    let (from, to) = split_rule(text).unwrap_or_default();
    let mut letters = from.chars();
    let place = draft.place(text.trim());
    match (letters.next(), letters.next()) {
        (Some(letter), None) => {
            let symbol = look_alike(letter).unwrap_or(letter);
            let before = grammar.productions.len();
            grammar.productions.retain(|rule| rule.predecessor.symbol != symbol);
            if grammar.productions.len() < before {
                draft.note_at(place.clone(), say!("This rule replaces an earlier one for the same symbol"));
            }
            draft.read(place, format!("{letter} -> {to}"));
            grammar.productions.push(production(symbol, draft.symbols(to)));
        }
        _ => draft.refuse_at(place, say!("This rule cannot be read")),
    }
}

#[cfg(test)]
mod tests;
