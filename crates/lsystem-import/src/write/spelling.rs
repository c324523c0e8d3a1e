//! The symbols of a system spelt with the symbols of another notation.

use super::Refusal;
use super::source::{Need, Source, Symbol};
use lsystem_base::say;
use lsystem_base::sorted::sort;
use lsystem_syntax::{Action, Module};

/// The symbols of a notation for words of plain symbols, for one system.
pub(super) struct Alphabet<'a> {
    /// The name of the notation.
    pub(super) label: &'a str,
    /// Symbols without an action, the best first.
    pub(super) idle: &'a str,
    /// Whether the notation has upper case only.
    pub(super) is_upper: bool,
    /// The symbols that draw one step, and those that move one step.
    pub(super) steps: [&'static str; 2],
    /// The symbols that have exactly this action; `[` and `]` are branches.
    pub(super) own: &'a dyn Fn(Action) -> &'static str,
    /// A word with the effect of this action.
    pub(super) code: &'a dyn Fn(Action) -> Option<String>,
    /// Symbols in words of `code` that may have productions.
    pub(super) mortal: &'a str,
    /// Symbols that cannot have productions.
    pub(super) fixed: &'a str,
}

impl Alphabet<'_> {
    /// The symbols for an action that every notation here has.
    fn usual(&self, source: &Source<'_>, action: Action) -> Option<&'static str> {
        match action {
            Action::Draw(length) if source.length(length) == 1.0 => Some(self.steps[0]),
            Action::Move(length) if source.length(length) == 1.0 => Some(self.steps[1]),
            Action::Push => Some("["),
            Action::Pop => Some("]"),
            _ => None,
        }
    }

    /// The symbols that have exactly these actions.
    fn own(&self, source: &Source<'_>, actions: &[Action]) -> &'static str {
        let &[action] = actions else { return "" };
        self.usual(source, action).unwrap_or_else(|| (self.own)(action))
    }

    /// A word with the effect of these actions.
    fn code(&self, source: &Source<'_>, actions: &[Action]) -> Option<String> {
        let one = |&action: &Action| match self.usual(source, action) {
            Some(symbols) => Some(symbols[..1].to_owned()),
            None => (self.code)(action),
        };
        actions.iter().map(one).collect()
    }
}

/// How symbols are spelt.
#[derive(Debug, Default)]
pub(super) struct Spelling {
    words: Vec<(char, String)>,
    names: Vec<(char, char)>,
    /// Symbols that vanish at the next derivation step, because every symbol that makes them makes them again.
    pub(super) vanishing: Vec<char>,
    /// Symbols without a production of the system that make a word again, and this word.
    pub(super) repeated: Vec<(char, String)>,
}

impl Spelling {
    /// Spells the symbols of a system.
    ///
    /// # Errors
    /// A symbol that the notation cannot express.
    pub(super) fn new(source: &Source<'_>, alphabet: &Alphabet<'_>) -> Result<Self, Refusal> {
        // No notation has so many, and the work grows with the square.
        const MAX: usize = 500;
        if source.symbols.len() > MAX {
            return Err(alphabet.is_full());
        }
        Self::direct(source, alphabet).or_else(|refusal| {
            let is_plain = !source.needs(Need::Contexts) && !source.needs(Need::Parameters);
            if is_plain { Self::split(source, alphabet) } else { Err(refusal) }
        })
    }

    /// The productions in the symbols of this spelling, with those that it needs itself: weights and words.
    pub(super) fn rules(&self, source: &Source<'_>) -> Vec<(char, Vec<(f64, String)>)> {
        let own = source.plain_rules();
        let own = own.iter().map(|rule| {
            let successors = rule.successors.iter().map(|(weight, successor)| (*weight, self.word(successor)));
            (self.name_of(rule.symbol), successors.collect())
        });
        let repeated = self.repeated.iter().map(|(name, word)| (*name, vec![(1.0, word.clone())]));
        let vanishing = self.vanishing.iter().map(|name| (*name, vec![(1.0, String::new())]));
        own.chain(repeated).chain(vanishing).collect()
    }

    /// The first successors as `F=FF`.
    pub(super) fn equations(&self, source: &Source<'_>) -> Vec<String> {
        let word = |list: &[(f64, String)]| list.first().map_or(String::new(), |(_, word)| word.clone());
        self.rules(source).iter().map(|(name, list)| format!("{name}={}", word(list))).collect()
    }

    /// Spells each symbol by one symbol with the same actions, or constant symbols by a word.
    fn direct(source: &Source<'_>, alphabet: &Alphabet<'_>) -> Result<Self, Refusal> {
        let mut speller = Speller::new(source, alphabet);
        let mut codes = Vec::new();
        for symbol in &source.symbols {
            let shape = symbol.shape();
            if speller.has(symbol.symbol) {
                continue;
            }
            let own = if shape.is_empty() { alphabet.idle } else { alphabet.own(source, &shape) };
            if let Some(name) = own.chars().find(|name| speller.may_be(symbol, *name)) {
                speller.name(symbol, name);
                continue;
            }
            let code = alphabet.code(source, &shape).filter(|code| symbol.is_constant() && !code.is_empty());
            match code {
                Some(code) => {
                    codes.push((symbol, code.clone()));
                    speller.spelling.words.push((symbol.symbol, code));
                }
                None => return Err(alphabet.lacks(symbol)),
            }
        }
        speller.spelling.sort();
        // A word for a constant symbol must stay.
        match codes.iter().find(|(_, code)| !speller.spelling.stays(source, code)) {
            Some((symbol, _)) => Err(alphabet.lacks(symbol)),
            None => Ok(speller.spelling),
        }
    }

    /// Splits symbols that are replaced and act: an idle symbol carries the production, and the symbols behind it act
    /// and vanish. `A -> B` becomes `a -> bF`, with `aF` for `A` and nothing for `F`.
    fn split(source: &Source<'_>, alphabet: &Alphabet<'_>) -> Result<Self, Refusal> {
        let mut speller = Speller::new(source, alphabet);
        let acts = |symbol: &Symbol| !symbol.shape().is_empty();
        let is_mortal = |code: &str| code.chars().any(|c| alphabet.mortal.contains(c));
        // Symbols that act get other names than those that the first attempt kept.
        let kept: Vec<char> = source.symbols.iter().filter(|own| acts(own)).map(|own| own.symbol).collect();
        speller.forget(&kept);
        for symbol in &source.symbols {
            if speller.has(symbol.symbol) {
                continue;
            }
            let shape = symbol.shape();
            let code = if shape.is_empty() { Some(String::new()) } else { alphabet.code(source, &shape) };
            let code = code.ok_or_else(|| alphabet.lacks(symbol))?;
            if !symbol.is_replaced && !shape.is_empty() && !is_mortal(&code) {
                speller.spelling.words.push((symbol.symbol, code));
                continue;
            }
            if !code.chars().all(|c| alphabet.mortal.contains(c)) {
                return Err(alphabet.lacks(symbol));
            }
            let name = alphabet.idle.chars().find(|name| speller.may_be(symbol, *name));
            let name = name.ok_or_else(|| alphabet.is_full())?;
            for c in code.chars().filter(|_| !shape.is_empty()) {
                if !speller.spelling.vanishing.contains(&c) {
                    speller.spelling.vanishing.push(c);
                }
            }
            let word = format!("{name}{code}");
            speller.taken.push(name);
            speller.spelling.names.push((symbol.symbol, name));
            speller.spelling.words.push((symbol.symbol, word.clone()));
            if !symbol.is_replaced && !code.is_empty() {
                speller.spelling.repeated.push((name, word));
            }
        }
        speller.spelling.sort();
        Ok(speller.spelling)
    }

    /// Sorts the symbols for fast look-up.
    fn sort(&mut self) {
        sort(&mut self.words);
        sort(&mut self.names);
    }

    /// Whether no production changes a word or looks at it.
    pub(super) fn stays(&self, source: &Source<'_>, word: &str) -> bool {
        !source.symbols.iter().any(|own| !own.is_constant() && word.contains(self.name_of(own.symbol)))
    }

    /// The symbol that productions of `symbol` replace.
    pub(super) fn name_of(&self, symbol: char) -> char {
        self.names.binary_search_by_key(&symbol, |(own, _)| *own).map_or(symbol, |at| self.names[at].1)
    }

    /// The word for a symbol.
    pub(super) fn word_of(&self, symbol: char) -> &str {
        self.words.binary_search_by_key(&symbol, |(own, _)| *own).map_or("", |at| &self.words[at].1)
    }

    /// A word of plain symbols.
    pub(super) fn word(&self, modules: &[Module]) -> String {
        modules.iter().map(|module| self.word_of(module.symbol)).collect()
    }
}

impl Alphabet<'_> {
    fn lacks(&self, symbol: &Symbol) -> Refusal {
        let Symbol { symbol, is_replaced, .. } = symbol;
        let label = self.label;
        Refusal(if *is_replaced {
            say!("{} has no symbol that is replaced and does what `{}` does", label, symbol)
        } else {
            say!("{} has no symbols that do what `{}` does", label, symbol)
        })
    }

    fn is_full(&self) -> Refusal {
        Refusal(say!("{} has too few symbols", self.label))
    }
}

/// Symbols on their way to a spelling.
struct Speller<'a> {
    alphabet: &'a Alphabet<'a>,
    taken: Vec<char>,
    spelling: Spelling,
}

impl<'a> Speller<'a> {
    /// Keeps the symbols that have the same actions in the notation.
    fn new(source: &Source<'_>, alphabet: &'a Alphabet<'a>) -> Self {
        let mut speller = Self { alphabet, taken: Vec::new(), spelling: Spelling::default() };
        for symbol in &source.symbols {
            let shape = symbol.shape();
            let own = if shape.is_empty() { alphabet.idle } else { alphabet.own(source, &shape) };
            let name = if alphabet.is_upper { symbol.symbol.to_ascii_uppercase() } else { symbol.symbol };
            if own.contains(name) && speller.may_be(symbol, name) {
                speller.name(symbol, name);
            }
        }
        speller
    }

    fn has(&self, symbol: char) -> bool {
        self.spelling.words.iter().any(|(own, _)| *own == symbol)
    }

    /// Takes back the names of these symbols.
    fn forget(&mut self, symbols: &[char]) {
        let (taken, spelling) = (&mut self.taken, &mut self.spelling);
        let names = &spelling.names;
        taken.retain(|name| !names.iter().any(|(own, of)| of == name && symbols.contains(own)));
        spelling.names.retain(|(own, _)| !symbols.contains(own));
        spelling.words.retain(|(own, _)| !symbols.contains(own));
    }

    /// Whether a symbol may have this name, which no other symbol has.
    fn may_be(&self, symbol: &Symbol, name: char) -> bool {
        let is_fixed = symbol.is_replaced && self.alphabet.fixed.contains(name);
        !self.taken.contains(&name) && !is_fixed
    }

    fn name(&mut self, symbol: &Symbol, name: char) {
        self.taken.push(name);
        self.spelling.names.push((symbol.symbol, name));
        self.spelling.words.push((symbol.symbol, name.to_string()));
    }
}

/// A word of turns by `left` and `right` degrees that turns by `degrees`, all counter-clockwise but `right`.
pub(super) fn turns(degrees: f64, left: (f64, char), right: (f64, char)) -> Option<String> {
    const MAX: u32 = 36;
    let is_whole = |angle: f64| {
        let rounds = angle / 360.0;
        (rounds - rounds.round()).abs() < 1e-12
    };
    (0..=MAX).find_map(|count| {
        let by = |(angle, symbol): (f64, char), sign: f64| {
            let reached = is_whole(sign * angle * f64::from(count) - degrees);
            reached.then(|| symbol.to_string().repeat(count as usize))
        };
        by(left, 1.0).or_else(|| by(right, -1.0))
    })
}
