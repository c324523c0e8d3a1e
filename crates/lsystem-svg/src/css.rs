//! The rules of `style` elements whose selectors are an element, classes and an id, such as `path.twig, #trunk`.

use crate::SvgError;
use crate::work::{Kind, Work};
use crate::xml::Element;
use lsystem_base::sorted;
use std::collections::BTreeMap;

/// The units of a selector that is read, and of one that is compared.
const READ: u64 = 1000;
const COMPARED: u64 = 40;

/// The rules of all sheets.
#[derive(Default)]
pub(crate) struct Sheet {
    /// By the id, else by the first class, else by the element; `*` has no key.
    rules: BTreeMap<String, Vec<Rule>>,
    bodies: Vec<String>,
}

struct Rule {
    element: String,
    /// `.class` and `#id`.
    marks: Vec<String>,
    /// The specificity.
    weight: usize,
    body: usize,
}

impl Sheet {
    /// Rules with other selectors are left out.
    ///
    /// # Errors
    /// A sentence if there are too many.
    pub(crate) fn read(text: &str, work: &mut Work) -> Result<Self, SvgError> {
        let mut sheet = Self::default();
        let text = without_comments(text);
        let mut rest = text.as_str();
        while let Some((head, after)) = rest.split_once('{') {
            // Rules of other kinds end with a semicolon or have rules inside, which apply to some media only.
            let head = head.rsplit(';').next().unwrap_or_default().trim().trim_start_matches('}');
            if head.trim_start().starts_with('@') {
                rest = after_block(after);
                continue;
            }
            let (body, after) = after.split_once('}').unwrap_or((after, ""));
            rest = after;
            for selector in head.split(',') {
                work.charge(Kind::Styles, 1, READ)?;
                let Some(rule) = Rule::read(selector.trim(), sheet.bodies.len()) else { continue };
                sheet.rules.entry(rule.key().to_owned()).or_default().push(rule);
            }
            sheet.bodies.push(body.to_owned());
        }
        Ok(sheet)
    }

    /// The declarations for an element, the strongest last.
    pub(crate) fn bodies(&self, element: &Element, work: &mut Work) -> Result<Vec<&str>, SvgError> {
        let mut found = Vec::new();
        if self.rules.is_empty() {
            return Ok(found);
        }
        let id = element.get("id").map(|id| format!("#{}", id.trim()));
        let classes =
            element.get("class").unwrap_or_default().split_ascii_whitespace().map(|class| format!(".{class}"));
        let marks: Vec<String> = classes.chain(id).collect();
        let keys = marks.iter().map(String::as_str).chain([element.name, "*"]);
        let mut matching = Vec::new();
        for key in keys {
            let rules = self.rules.get(key).map_or(&[][..], Vec::as_slice);
            work.charge(Kind::Styles, rules.len() * (1 + marks.len()), COMPARED)?;
            matching.extend(rules.iter().filter(|rule| {
                (rule.element == "*" || rule.element == element.name)
                    && rule.marks.iter().all(|mark| marks.contains(mark))
            }));
        }
        sorted::sort_by_key(&mut matching, |rule| (rule.weight, rule.body));
        for rule in matching {
            let body = self.bodies[rule.body].as_str();
            work.charge(Kind::Styles, body.len(), 8)?;
            found.push(body);
        }
        Ok(found)
    }
}

impl Rule {
    fn read(selector: &str, body: usize) -> Option<Self> {
        let is_part = |symbol: char| symbol.is_alphanumeric() || "-_*.#".contains(symbol) || symbol > '\x7f';
        if selector.is_empty() || !selector.chars().all(is_part) {
            return None;
        }
        let starts: Vec<usize> = selector.match_indices(['.', '#']).map(|(at, _)| at).collect();
        let ends = starts.iter().skip(1).copied().chain([selector.len()]);
        let marks: Vec<String> = starts.iter().zip(ends).map(|(&from, to)| selector[from..to].to_owned()).collect();
        let element = &selector[..starts.first().copied().unwrap_or(selector.len())];
        let element = if element.is_empty() { "*" } else { element }.to_owned();
        let each = |mark: &String| if mark.starts_with('#') { 10_000 } else { 100 };
        let weight = marks.iter().map(each).sum::<usize>() + usize::from(element != "*");
        Some(Self { element, marks, weight, body })
    }

    fn key(&self) -> &str {
        let id = self.marks.iter().find(|mark| mark.starts_with('#'));
        id.or(self.marks.first()).unwrap_or(&self.element)
    }
}

/// The name and the value of each declaration.
pub(crate) fn declarations(body: &str) -> impl Iterator<Item = (&str, &str)> {
    let value = |value: &str| value.len() - value.trim_end().trim_end_matches("!important").len();
    body.split(';').filter_map(|each| each.split_once(':')).map(move |(name, text)| {
        let kept = text.len() - value(text);
        (name.trim(), text[..kept].trim())
    })
}

/// The text after a block that has begun, with the blocks inside.
fn after_block(text: &str) -> &str {
    let mut depth = 1;
    for (at, brace) in text.match_indices(['{', '}']) {
        depth = if brace == "{" { depth + 1 } else { depth - 1 };
        if depth == 0 {
            return &text[at + 1..];
        }
    }
    ""
}

fn without_comments(text: &str) -> String {
    let mut kept = String::new();
    for (at, part) in text.split("/*").enumerate() {
        kept.push_str(if at == 0 { part } else { part.split_once("*/").map_or("", |(_, rest)| rest) });
    }
    kept
}
