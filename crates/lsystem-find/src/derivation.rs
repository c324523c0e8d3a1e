//! The search: a derivation that learns its rules from the string.

use crate::{Found, printed};
use lsystem_base::Limits;
use lsystem_base::sorted;
use lsystem_base::word;
use lsystem_drawing::{System, expand};
use lsystem_syntax::Definition;
use std::sync::Arc;

/// The most symbols of the string.
const MAX_TEXT: usize = 1 << 16;
/// The most letters with rules.
const MAX_LETTERS: usize = 8;
/// The most different symbols, and the most derivation steps.
const MAX_ALPHABET: usize = 60;
const MAX_STEPS: u32 = 30;
/// The most systems that are kept.
const MAX_FOUND: usize = 100;
/// The number of symbols that a task reads before the next task's turn.
const SHARE: u64 = 4096;
/// The most symbols of one successor.
const MAX_SUCCESSOR: usize = 64;

/// The state of a search after a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Searched {
    /// There is more to search.
    More,
    /// All rules up to the largest number of symbols were searched.
    All,
}

/// A search for the rules of a string, in steps. It can be dropped at any time.
///
/// Each set of letters that may have rules is searched by itself, with one symbol more in all successors in each round,
/// so its shortest rules are found first. Sets with fewer letters get more of the work.
#[derive(Clone, Debug)]
pub struct Search {
    tasks: Vec<Task>,
    found: Vec<Found>,
}

/// The problem that all tasks share.
#[derive(Debug)]
struct Problem {
    axiom: Vec<u8>,
    text: Vec<u8>,
    /// The characters; a symbol is an index here.
    alphabet: Vec<char>,
    n: usize,
    /// The most symbols of all successors.
    most: usize,
}

/// The search of one set of letters.
#[derive(Clone, Debug)]
struct Task {
    problem: Arc<Problem>,
    /// The symbols that have rules, and their number.
    letters: Vec<bool>,
    size: usize,
    /// The number of symbols of all successors in this round.
    round: usize,
    /// The steps so far.
    spent: u64,
    state: State,
}

/// The known beginning of a rule.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Rule {
    successor: Vec<u8>,
    is_ended: bool,
}

/// A place in the derivation: the next symbol of a successor, or of the axiom.
#[derive(Clone, Copy, Debug)]
struct Level {
    /// The letter whose successor is read; `None` for the axiom.
    of: Option<u8>,
    at: usize,
    /// The derivation steps that are left for its symbols.
    depth: usize,
}

#[derive(Clone, Debug, Default)]
struct State {
    rules: Vec<Option<Rule>>,
    /// The number of symbols in all successors so far.
    used: usize,
    read: usize,
    stack: Vec<Level>,
    /// The choices to come back to.
    choices: Vec<Choice>,
}

/// A choice with what was before it.
#[derive(Clone, Debug)]
struct Choice {
    of: u8,
    /// The next option to try: 0 ends the rule, others are symbols.
    option: usize,
    length: usize,
    used: usize,
    read: usize,
    stack: Vec<Level>,
    /// The letters that had no rule yet.
    unknown: Vec<u8>,
    ended: Vec<u8>,
}

impl Search {
    /// A search for rules that derive `text` from `axiom` in `n` steps, with at most `most` symbols in all successors.
    /// Symbols of `constants`, such as brackets and turns, have no rules. White space is left out.
    ///
    /// # Errors
    /// A sentence if the search cannot begin.
    pub fn new(axiom: &str, text: &str, n: u32, constants: &str, most: usize) -> Result<Self, &'static str> {
        let symbols = |text: &str| text.chars().filter(|c| !c.is_whitespace()).collect::<Vec<char>>();
        let (axiom, text) = (symbols(axiom), symbols(text));
        if text.is_empty() || text.len() > MAX_TEXT {
            return Err(word!("The string must have 1 to 65,536 symbols."));
        }
        if n == 0 || n > MAX_STEPS {
            return Err(word!("There must be 1 to 30 derivation steps."));
        }
        let mut alphabet: Vec<char> = axiom.iter().chain(&text).copied().collect();
        sorted::sort(&mut alphabet);
        alphabet.dedup();
        if alphabet.len() > MAX_ALPHABET {
            return Err(word!("The string has more than 60 different symbols."));
        }
        if !alphabet.iter().all(|&symbol| is_plain(symbol, !constants.contains(symbol))) {
            return Err(word!(
                "Strings with parentheses, or with other symbols that have a meaning in rules, are not searched."
            ));
        }
        let letters: Vec<usize> = (0..alphabet.len()).filter(|&at| !constants.contains(alphabet[at])).collect();
        if letters.len() > MAX_LETTERS {
            return Err(word!("More than 8 letters could have rules."));
        }
        let index = |symbol: &char| alphabet.binary_search(symbol).map_or(0, |at| at as u8);
        let (axiom, text) = (axiom.iter().map(index).collect(), text.iter().map(index).collect());
        let size = alphabet.len();
        let problem = Arc::new(Problem { axiom, text, alphabet, n: n as usize, most });
        let task = |set: usize| {
            let mut has_rule = vec![false; size];
            let chosen = letters.iter().enumerate().filter(|(at, _)| set >> at & 1 == 1);
            chosen.for_each(|(_, &letter)| has_rule[letter] = true);
            let mut task = Task {
                problem: Arc::clone(&problem),
                size: has_rule.iter().filter(|has| **has).count(),
                letters: has_rule,
                round: 0,
                spent: 0,
                state: State::default(),
            };
            task.begin();
            task
        };
        Ok(Self { tasks: (1..1_usize << letters.len()).map(task).collect(), found: Vec::new() })
    }

    /// The rules found so far, those with the fewest symbols first.
    #[must_use]
    pub fn found(&self) -> &[Found] {
        &self.found
    }

    /// For each number of letters with rules, from 1 on: up to how many symbols in all successors everything was
    /// searched.
    #[must_use]
    pub fn searched(&self) -> Vec<usize> {
        let largest = self.tasks.iter().map(|task| task.size).max().unwrap_or(0);
        let of = |size: usize| self.tasks.iter().filter(move |task| task.size == size).map(|task| task.round).min();
        (1..=largest).map(|size| of(size).unwrap_or(0).saturating_sub(1)).collect()
    }

    /// Searches for about `work` symbols.
    pub fn step(&mut self, work: usize) -> Searched {
        let mut left = work as u64;
        while left > 0 {
            // The cheapest task so far. Each further letter multiplies the cost of a step by 4.
            let open = self.tasks.iter_mut().filter(|task| task.round <= task.problem.most);
            let Some(task) = open.min_by_key(|task| task.spent << (2 * task.size)) else { return Searched::All };
            let share = left.min(SHARE);
            let before = task.spent;
            while task.spent - before < share && task.round <= task.problem.most {
                task.spent += 1;
                let is_over = match task.advance() {
                    Advance::More => false,
                    Advance::Found(found, is_over) => {
                        let at = self.found.partition_point(|other| other.symbols() <= found.symbols());
                        self.found.insert(at, found);
                        self.found.truncate(MAX_FOUND);
                        is_over
                    }
                    Advance::Done => true,
                };
                if is_over {
                    task.round += 1;
                    task.begin();
                }
            }
            left -= (task.spent - before).min(left);
        }
        Searched::More
    }
}

/// Whether a symbol stands for itself in strings and rules, and leaves the symbols after it alone.
fn is_plain(symbol: char, has_rule: bool) -> bool {
    // Brackets need a partner.
    if ['[', ']'].contains(&symbol) || symbol.is_alphanumeric() {
        return true;
    }
    let derives = |axiom: &str, rules: String, expected: &str| {
        let system = System::new(&Definition { axiom: printed(axiom), rules, ..Definition::default() });
        system.is_ok_and(|system| expand(&system, 1, &Limits::default()).as_deref() == Ok(expected))
    };
    let [alone, between, last] = [format!("{symbol}"), format!("F{symbol}F"), format!("F{symbol}")];
    printed(&alone) == alone
        && derives(&between, String::new(), &between)
        && derives("F", format!("F -> {symbol}"), &alone)
        && (!has_rule || derives(&last, format!("{symbol} -> F"), "FF"))
}

/// The result of a step of a task.
enum Advance {
    More,
    /// Rules were found; the flag says whether the round is over.
    Found(Found, bool),
    /// The round is over.
    Done,
}

impl Task {
    fn begin(&mut self) {
        self.state = State {
            rules: vec![None; self.letters.len()],
            stack: vec![Level { of: None, at: 0, depth: self.problem.n }],
            ..State::default()
        };
    }

    /// Reads one symbol.
    fn advance(&mut self) -> Advance {
        let Some(&Level { of, at, depth }) = self.state.stack.last() else {
            let is_whole = self.state.read == self.problem.text.len();
            // A round uses exactly `round` symbols, so no rules are found twice.
            let found = (is_whole && self.state.used == self.round && self.uses_all()).then(|| self.rules());
            let next = self.back();
            let is_over = matches!(next, Advance::Done);
            return found.map_or(next, |found| Advance::Found(found, is_over));
        };
        let symbol = match of {
            None => self.problem.axiom.get(at).copied(),
            Some(letter) => {
                let rule = self.state.rules[usize::from(letter)].get_or_insert_default();
                match rule.successor.get(at) {
                    Some(&symbol) => Some(symbol),
                    None if rule.is_ended => None,
                    None => return self.choose(letter),
                }
            }
        };
        let Some(symbol) = symbol else {
            self.state.stack.pop();
            return Advance::More;
        };
        if let Some(level) = self.state.stack.last_mut() {
            level.at += 1;
        }
        if self.take(symbol, depth) { Advance::More } else { self.back() }
    }

    /// Derives a symbol `depth` more steps. Returns whether that fits the string.
    fn take(&mut self, symbol: u8, depth: usize) -> bool {
        if depth > 0 && self.letters[usize::from(symbol)] {
            self.state.stack.push(Level { of: Some(symbol), at: 0, depth: depth - 1 });
            return true;
        }
        let fits = self.problem.text.get(self.state.read) == Some(&symbol);
        self.state.read += usize::from(fits);
        fits
    }

    /// Chooses the next symbol of a rule, or its end.
    fn choose(&mut self, of: u8) -> Advance {
        let length = self.state.rules[usize::from(of)].as_ref().map_or(0, |rule| rule.successor.len());
        let unknown = (0..self.letters.len() as u8).filter(|&letter| self.state.rules[usize::from(letter)].is_none());
        let ended = (0..self.letters.len() as u8)
            .filter(|&letter| self.state.rules[usize::from(letter)].as_ref().is_some_and(|rule| rule.is_ended));
        let (unknown, ended) = (unknown.collect(), ended.collect());
        let State { used, read, ref stack, .. } = self.state;
        self.state.choices.push(Choice { of, option: 0, length, used, read, stack: stack.clone(), unknown, ended });
        self.back()
    }

    /// Tries the next option of the last choice that has one.
    fn back(&mut self) -> Advance {
        while let Some(mut choice) = self.state.choices.pop() {
            self.restore(&choice);
            let option = choice.option;
            if option > self.letters.len() {
                continue;
            }
            choice.option += 1;
            let of = usize::from(choice.of);
            let used = choice.used;
            self.state.choices.push(choice);
            let Some(rule) = self.state.rules[of].as_mut() else { continue };
            if option == 0 {
                rule.is_ended = true;
                return Advance::More;
            }
            if used >= self.round || rule.successor.len() >= MAX_SUCCESSOR {
                continue;
            }
            let symbol = (option - 1) as u8;
            // A symbol without a rule must be the next one of the string.
            let is_next = self.problem.text.get(self.state.read) == Some(&symbol);
            let is_last = self.state.stack.last().is_some_and(|level| level.depth == 0);
            if (is_last || !self.letters[usize::from(symbol)]) && !is_next {
                continue;
            }
            rule.successor.push(symbol);
            self.state.used = used + 1;
            return Advance::More;
        }
        Advance::Done
    }

    /// Restores the state from before a choice.
    fn restore(&mut self, choice: &Choice) {
        let Choice { of, length, used, read, ref stack, ref unknown, ref ended, .. } = *choice;
        self.state.used = used;
        self.state.read = read;
        self.state.stack.clone_from(stack);
        for (letter, rule) in self.state.rules.iter_mut().enumerate() {
            if unknown.contains(&(letter as u8)) {
                *rule = None;
            } else if let Some(rule) = rule {
                rule.is_ended = ended.contains(&(letter as u8));
            }
        }
        if let Some(rule) = &mut self.state.rules[usize::from(of)] {
            rule.successor.truncate(length);
        }
    }

    /// Whether each letter of the set has a rule that changes it: otherwise a smaller set has the same rules.
    fn uses_all(&self) -> bool {
        let changes = |letter: usize| {
            let rule = self.state.rules[letter].as_ref();
            rule.is_some_and(|rule| rule.successor != [letter as u8])
        };
        (0..self.letters.len()).all(|letter| !self.letters[letter] || changes(letter))
    }

    fn rules(&self) -> Found {
        let symbol = |index: u8| self.problem.alphabet[usize::from(index)];
        let rules = self.state.rules.iter().enumerate().filter_map(|(letter, rule)| {
            let successor = rule.as_ref()?.successor.iter().map(|&index| symbol(index)).collect();
            Some((symbol(letter as u8), successor))
        });
        Found { rules: rules.collect(), n: self.problem.n as u32 }
    }
}
