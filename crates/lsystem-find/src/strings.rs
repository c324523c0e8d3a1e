//! The search for the rules of a string, of whose system some properties are known.

use crate::{Drawn, Found, Question, Search, Searched};
use lsystem_base::sorted;
use lsystem_base::{say, word};

/// The numbers of derivation steps that are tried where theirs is not known.
const STEPS: [u32; 8] = [1, 2, 3, 4, 5, 6, 7, 8];
/// The most letters of a string that are tried as axioms where none is known.
const MAX_AXIOMS: usize = 8;
/// The most symbols of all successors.
const MAX: usize = 60;
/// The number of symbols that a search reads before the next search's turn.
const SHARE: usize = 4096;
/// The most systems that are kept.
const MAX_KEPT: usize = 20;
/// The angle of a drawing whose angle is not known, in degrees.
const ANGLE: f64 = 90.0;
/// The letters that draw by themselves.
const USUAL: [char; 2] = ['F', 'G'];

/// A search for the rules of a string, in steps. It can be dropped at any time.
///
/// Each axiom with each number of derivation steps is searched by itself, with equal work.
#[derive(Clone, Debug)]
pub struct StringFinder {
    searches: Vec<Part>,
    question: Question,
    /// The letters that draw.
    draws: String,
}

/// The search from one axiom with one number of derivation steps.
#[derive(Clone, Debug)]
struct Part {
    axiom: String,
    n: u32,
    search: Search,
    spent: usize,
    is_done: bool,
}

impl StringFinder {
    /// A search for rules that derive `text`. Letters may have rules, other symbols have none. White space is left out.
    ///
    /// # Errors
    /// A sentence if the search cannot begin.
    pub fn new(text: &str, question: &Question) -> Result<Self, &'static str> {
        if question.angle.is_some_and(|angle| !(-360.0..=360.0).contains(&angle)) {
            return Err(word!("The angle must be from -360 to 360 degrees."));
        }
        if question.heading.is_some_and(|heading| !heading.is_finite()) {
            return Err(word!("The first heading must be a number."));
        }
        let is_letter = |symbol: &char| symbol.is_alphanumeric();
        let axiom = question.axiom.as_deref().map(|axiom| axiom.split_whitespace().collect::<String>());
        let axiom = axiom.filter(|axiom| !axiom.is_empty());
        let all = || text.chars().chain(axiom.iter().flat_map(|axiom| axiom.chars()));
        let sorted = |mut symbols: Vec<char>| {
            sorted::sort(&mut symbols);
            symbols.dedup();
            symbols
        };
        let letters = sorted(all().filter(is_letter).collect());
        let constants: String = sorted(all().filter(|symbol| !is_letter(symbol)).collect()).into_iter().collect();
        if letters.is_empty() {
            return Err(word!("The string has no letters."));
        }
        let axioms = match axiom {
            Some(axiom) => vec![axiom],
            None => letters.iter().take(MAX_AXIOMS).map(char::to_string).collect(),
        };
        let draws = question.draws.clone().unwrap_or_else(|| {
            let usual: String = letters.iter().filter(|letter| USUAL.contains(letter)).collect();
            if usual.is_empty() { letters.iter().collect() } else { usual }
        });
        let mut searches = Vec::new();
        for n in question.n.map_or(STEPS.to_vec(), |n| vec![n]) {
            for axiom in &axioms {
                let search = Search::new(axiom, text, n, &constants, MAX)?;
                searches.push(Part { axiom: axiom.clone(), n, search, spent: 0, is_done: false });
            }
        }
        Ok(Self { searches, question: question.clone(), draws })
    }

    /// Searches for about `work` symbols.
    pub fn step(&mut self, work: usize) -> Searched {
        for _ in 0..work.div_ceil(SHARE) {
            let open = self.searches.iter_mut().filter(|part| !part.is_done);
            let Some(part) = open.min_by_key(|part| part.spent) else { return Searched::All };
            part.spent += SHARE;
            part.is_done = part.search.step(SHARE) == Searched::All;
        }
        Searched::More
    }

    /// The systems that derive the string, those with the fewest symbols first.
    #[must_use]
    pub fn found(&self) -> Vec<Drawn> {
        let each = |part: &Part| part.search.found().iter().map(|found| (part.axiom.clone(), found.clone())).collect();
        let mut all: Vec<(String, Found)> = self.searches.iter().flat_map(|part| -> Vec<_> { each(part) }).collect();
        sorted::sort_by_key(&mut all, |(axiom, found)| (found.symbols(), axiom.len(), found.n));
        all.truncate(MAX_KEPT);
        let drawn = |(axiom, found)| Drawn {
            axiom,
            found,
            draws: self.draws.clone(),
            angle: self.question.angle.unwrap_or(ANGLE),
            heading: self.question.heading.unwrap_or(ANGLE),
            agreement: 1.0,
            named: None,
        };
        all.into_iter().map(drawn).collect()
    }

    /// The extent of the search, in words.
    #[must_use]
    pub fn searched(&self) -> String {
        let mut axioms: Vec<(&str, Vec<u32>, Vec<usize>)> = Vec::new();
        for part in self.searches.iter().filter(|part| part.spent > 0) {
            let searched = part.search.searched();
            match axioms.iter_mut().find(|(axiom, ..)| *axiom == part.axiom) {
                Some((_, steps, least)) => {
                    steps.push(part.n);
                    least.iter_mut().zip(searched).for_each(|(least, most)| *least = most.min(*least));
                }
                None => axioms.push((&part.axiom, vec![part.n], searched)),
            }
        }
        let rules = |(&most, letters): (&usize, usize)| {
            let rules = if letters == 1 { say!("one rule") } else { say!("{} rules", letters) };
            say!("{} with up to {} symbols", rules, most)
        };
        let words = axioms.iter().map(|(axiom, steps, least)| {
            let steps: Vec<String> = steps.iter().map(u32::to_string).collect();
            let least: Vec<String> = least.iter().zip(1..).map(rules).collect();
            say!("from {}, n = {}: {}", axiom, steps.join(", "), least.join(", "))
        });
        let words: Vec<String> = words.collect();
        if words.is_empty() { say!("nothing yet") } else { words.join("; ") }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(text: &str, question: &Question) -> StringFinder {
        let mut finder = StringFinder::new(text, question).expect("a search");
        for _ in 0..40 {
            if finder.step(50_000) == Searched::All {
                break;
            }
        }
        finder
    }

    #[test]
    fn axioms_and_steps_are_found_out() {
        let finder = found("ABAABABAABAAB", &Question::default());
        let definition = finder.found()[0].definition();
        assert_eq!(
            (definition.axiom.as_str(), definition.rules.as_str(), definition.iterations),
            ("A", "A -> AB\nB -> A", 5)
        );
        assert_eq!(definition.overrides, "A: draw\nB: draw");
        assert!(finder.searched().contains("from A, n = 1, 2, 3"), "{}", finder.searched());
    }

    #[test]
    fn what_is_known_is_kept() {
        let known = |axiom: &str, n| Question {
            axiom: Some(axiom.to_owned()),
            n: Some(n),
            angle: Some(60.0),
            ..Question::default()
        };
        let finder = found("F-F++F-F-F-F++F-F++F-F++F-F-F-F++F-F", &known("F", 2));
        let definition = finder.found()[0].definition();
        assert_eq!((definition.rules.as_str(), definition.angle, definition.iterations), ("F -> F-F++F-F", 60.0, 2));
        let empty = found("εy-", &known("ε", 1));
        assert_eq!(empty.found()[0].definition().rules, "`ε` -> εy-", "a letter, not an empty word");
        for (text, question, said) in [
            ("+-+", Question::default(), "no letters"),
            ("", Question::default(), "no letters"),
            ("F", known("F", 31), "1 to 30"),
            ("ABCDEFGHIJKL", known("A", 2), "More than 8"),
            ("AB", Question { angle: Some(f64::NAN), ..Question::default() }, "angle"),
            ("AB", Question { heading: Some(f64::INFINITY), ..Question::default() }, "heading"),
        ] {
            let told = StringFinder::new(text, &question);
            assert!(told.as_ref().is_err_and(|why| why.contains(said)), "{text} {:?}", told.err());
        }
    }
}
