//! Labels of a line, and what stands behind them.

use super::line::{label_at, weak};
use super::{Label, QUOTES, Reader, Section};
use crate::angle::{NoAngle, angle};
use crate::assembly::{Angle, Said};
use crate::rules::ARROWS;
use crate::vocabulary::{Key, letter_of};
use core::ops::Range;
use lsystem_base::{decimal, say};

impl Reader<'_> {
    /// The labels of a line, in order.
    pub(super) fn labels(&self, line: &Range<usize>, text: &str) -> Vec<Label> {
        let mut found: Vec<Label> = Vec::new();
        let mut at = 0;
        let mut before = ' ';
        while let Some(ch) = text[at..].chars().next() {
            let begins = ch.is_alphabetic() && !(before.is_alphanumeric() || before == '_');
            if begins && let Some((length, key, word, value)) = label_at(&text[at..], before) {
                found.push(Label { start: line.start + at, value: line.start + at + value, key, word });
                at += length.max(1);
                before = 'x';
                // What follows is a value: it begins with the label's own sign.
                at = at.max(value + at - length);
                continue;
            }
            // A word is passed as a whole, so that the work stays in proportion to the text.
            let skipped = if begins || ch.is_alphanumeric() {
                text[at..].find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len() - at)
            } else {
                ch.len_utf8()
            };
            before = text[at..at + skipped].chars().next_back().unwrap_or(' ');
            at += skipped;
        }
        found
    }

    /// The angle at the start of a text. Inkscape's are in degrees.
    fn angle(&self, text: &str) -> Result<(f64, bool, usize), NoAngle> {
        let degrees = decimal::read(text).filter(|_| self.is_inkscape);
        degrees.map_or_else(|| angle(text), |degrees| Ok((degrees, false, text.len())))
    }

    /// Reads what stands behind a label.
    pub(super) fn labelled(&mut self, label: &Label, value: Range<usize>, is_last: bool) {
        let whole = label.start..value.end;
        let mut inner = self.trimmed(&value, &QUOTES);
        if !is_last {
            inner.end = inner.start + self.text(&inner).trim_end_matches([';', ',', ' ', '|']).len();
        }
        let text = self.text(&inner).to_owned();
        match label.key {
            Key::Axiom => {
                self.section = Section::None;
                let mut value = self.trimmed(&value, &[]);
                // `axiom: ω = F`
                let text = self.text(&value);
                let named = text.split_once('=').filter(|(name, _)| {
                    name.trim().chars().count() < 3 && name.trim().chars().all(char::is_alphabetic)
                });
                value.start = value.end - named.map_or(text, |(_, word)| word).len();
                self.axiom(label, &value);
            }
            Key::Rules | Key::Rule => {
                self.section = Section::Rules;
                let letter = letter_of(&label.word);
                let has_arrow = ARROWS.iter().any(|arrow| text.contains(arrow));
                let (word, _) = self.word(&inner);
                let text = if letter.is_some() { self.text(&word).to_owned() } else { text };
                match letter.filter(|_| !has_arrow && weak(&text).is_none() && !text.is_empty()) {
                    Some(letter) => self.push_rule(&letter.to_string(), &text, None, &whole),
                    None if self.pending.is_some() && !has_arrow && !text.is_empty() => {
                        let (from, chance) = (self.pending.clone().unwrap_or_default(), self.chance.take());
                        self.push_rule(&from, &text, chance, &whole);
                    }
                    None => self.region(&inner, Section::Rules, true),
                }
                let head = label.start..inner.start.min(label.value.max(label.start));
                self.cover(&head);
            }
            Key::Meanings => {
                self.section = if label.word.eq_ignore_ascii_case("draw") && text.is_empty() {
                    Section::Images
                } else {
                    Section::Meanings
                };
                self.cover(&(label.start..label.value));
                self.region(&inner, Section::Meanings, true);
            }
            Key::Angle | Key::LeftAngle | Key::RightAngle => match self.angle(&text) {
                Ok((degrees, radians, end)) => {
                    let span = self.span(&(label.start..inner.start + end));
                    self.extent(&span);
                    let said = Said::new(Angle::Degrees(degrees), span.clone());
                    if radians && !text[..end].contains(['π', 'p', 'P', 'r']) {
                        self.said.note(span.clone(), say!("This angle is read as radians"));
                    }
                    self.said.say_angle(label.key, &label.word, said);
                    let rest = inner.start + end..value.end;
                    self.rest(&rest, is_last);
                }
                Err(why) if text.chars().any(|c| c.is_ascii_digit()) || why == NoAngle::Unclear => {
                    let span = self.span(&whole);
                    self.extent(&span);
                    let why = match why {
                        NoAngle::Unclear => {
                            say!("This angle may be meant in degrees or in radians; the text does not say which")
                        }
                        NoAngle::NoNumber => say!("This angle cannot be read"),
                    };
                    self.said.refuse(span, why);
                }
                Err(_) => {}
            },
            Key::Iterations => {
                let end = text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
                if end > 0 && end < 8 {
                    let span = self.span(&(label.start..inner.start + end));
                    self.extent(&span);
                    if self.said.iterations.is_none() {
                        self.said.iterations = Some(Said::new(text[..end].to_owned(), span));
                    }
                    let rest = inner.start + end..value.end;
                    self.rest(&rest, is_last);
                }
            }
            Key::Name if !text.is_empty() && self.said.name.is_empty() => {
                self.said.name.clone_from(&text);
                let span = self.span(&whole);
                self.extent(&span);
                self.said.names.push(Said::new(text, span));
            }
            Key::LengthFactor | Key::Heading => {
                let number = angle(&text).ok().map(|(number, ..)| number);
                let plain = decimal::read(&text.trim().replace(',', "."));
                let span = self.span(&whole);
                match (label.key, plain, number) {
                    (Key::LengthFactor, Some(factor), _) => self.said.factor = Some(Said::new(factor, span.clone())),
                    (Key::Heading, _, Some(degrees)) => self.said.heading = Some(Said::new(degrees, span.clone())),
                    _ => self.said.note(span.clone(), say!("This cannot be read")),
                }
                self.extent(&span);
            }
            Key::Ignore => {
                let span = self.span(&whole);
                self.extent(&span);
                self.said.lines.push(Said::new(format!("ignore: {text}"), span));
            }
            Key::Step if text.starts_with(|c: char| c.is_ascii_digit() || c == '.') => {
                let span = self.span(&whole);
                self.said.note(span, say!("The length of a step changes only the size, which is fitted"));
            }
            // Other rows are no labels.
            _ => {}
        }
    }
}
