use super::*;
use crate::rules::ContextPattern;
use crate::{Letter, LetterId, Rule, Rules, Template};
use lsystem_base::{LimitName, Limits};
use lsystem_syntax::Code;
use lsystem_syntax::Operator;
use std::sync::Arc;

/// Rules from `left, strict, right, successor` in single characters; `ignored` letters are not seen.
fn rules(axiom: &str, productions: &[(&str, char, &str, &str)], ignored: &str) -> Rules {
    let mut symbols: Vec<char> = axiom.chars().collect();
    for (left, strict, right, successor) in productions {
        symbols.extend(left.chars().chain([*strict]).chain(right.chars()).chain(successor.chars()));
    }
    symbols.sort_unstable();
    symbols.dedup();
    let letters: Vec<Letter> = symbols.iter().map(|&symbol| Letter { symbol, arity: 0 }).collect();
    let id = |symbol: char| symbols.binary_search(&symbol).unwrap() as LetterId;
    let word = |text: &str| Template { letters: text.chars().map(id).collect(), arguments: vec![] };
    let mut by_letter = vec![vec![]; letters.len()];
    for (production, (left, strict, right, successor)) in productions.iter().enumerate() {
        by_letter[usize::from(id(*strict))].push(Rule {
            production,
            left: left.chars().map(id).collect(),
            right: (right.chars())
                .map(|symbol| match symbol {
                    '[' => ContextPattern::Open,
                    ']' => ContextPattern::Close,
                    _ => ContextPattern::Letter(id(symbol)),
                })
                .collect(),
            condition: None,
            weight: None,
            successor: word(successor),
        });
    }
    for rules in &mut by_letter {
        rules.sort_by_key(|rule| !rule.is_context_sensitive());
    }
    let considered = symbols.iter().map(|&symbol| !ignored.contains(symbol)).collect();
    let images = vec![vec![]; letters.len()];
    let cuts = symbols.iter().map(|&symbol| symbol == '%').collect();
    Rules {
        letters,
        considered,
        cuts,
        by_letter,
        images,
        rewrites: vec![],
        axiom: word(axiom),
        spans: vec![],
        plain: false,
        interpreter: None,
    }
}

fn derive(rules: Rules, n: u32, piece: usize) -> Rewriter {
    let mut rewriter = Rewriter::new(Arc::new(rules), 0, Limits::default()).unwrap();
    while rewriter.generation() < n {
        rewriter.step(piece).unwrap();
    }
    rewriter
}

fn text(rewriter: &Rewriter) -> String {
    rewriter.word().letters.iter().map(|&id| rewriter.rules().letters[usize::from(id)].symbol).collect()
}

/// ABOP, figure 1.31, after Hogeweg and Hesper: successors for the contexts 000, 001, ... 111.
fn hogeweg_hesper(successors: [&'static str; 8]) -> Rules {
    let context = |i: usize| ["0", "1"][i];
    let mut productions = vec![];
    for (index, successor) in successors.into_iter().enumerate() {
        let strict = ['0', '1'][index >> 1 & 1];
        productions.push((context(index >> 2), strict, context(index & 1), successor));
    }
    productions.push(("", '+', "", "-"));
    productions.push(("", '-', "", "+"));
    rules("F1F1F1", &productions, "+-F")
}

#[test]
fn figure_1_31a_has_the_published_size() {
    let figure = || hogeweg_hesper(["0", "1[+F1F1]", "1", "1", "0", "1F1", "0", "0"]);
    assert_eq!(derive(figure(), 30, usize::MAX).word().letters.len(), 6_910);
    assert_eq!(derive(figure(), 30, 7).word().letters.len(), 6_910);
}

/// How many of a word's modules `strict` become `!` with the contexts given.
fn matches(word: &str, left: &str, strict: char, right: &str, ignored: &str) -> usize {
    let rules = rules(word, &[(left, strict, right, "!")], ignored);
    text(&derive(rules, 1, 3)).matches('!').count()
}

#[test]
fn contexts_respect_branches() {
    // ABOP, section 1.8: BC < S > G[H]M matches S in ABC[DE][SG[HI[JK]L]MNO].
    let word = "ABC[DE][SG[HI[JK]L]MNO]";
    assert_eq!(matches(word, "BC", 'S', "G[H]M", ""), 1);
    assert_eq!(matches(word, "C", 'S', "GM", ""), 1);
    assert_eq!(matches(word, "BC", 'S', "G[I]M", ""), 0);
    assert_eq!(matches(word, "E", 'S', "", ""), 0);
    assert_eq!(matches(word, "", 'E', "S", ""), 0);
    assert_eq!(matches(word, "", 'C', "D", ""), 0);
    assert_eq!(matches(word, "", 'C', "[D]", ""), 1);
    assert_eq!(matches(word, "", 'C', "[S]", ""), 1);
    assert_eq!(matches(word, "", 'C', "[DE][S]", ""), 1);
    assert_eq!(matches(word, "", 'O', "A", ""), 0);
    assert_eq!(matches("A++B-[+C]A", "A", 'B', "A", "+-"), 1);
    assert_eq!(matches("A++B-[+C]A", "A", 'B', "[C]A", "+-"), 1);
    assert_eq!(matches("A[B]C[D", "A", 'C', "[D]", ""), 1);
    assert_eq!(matches("A]B", "A", 'B', "", ""), 0);
}

#[test]
fn branches_are_cut_in_the_next_step() {
    let derived = |axiom: &str, productions: &[(&str, char, &str, &str)], n, piece| {
        text(&derive(rules(axiom, productions, ""), n, piece))
    };
    for piece in [1, 2, 99] {
        assert_eq!(derived("A[B%C[D]E]F[G]%H", &[], 0, piece), "A[B%C[D]E]F[G]%H");
        assert_eq!(derived("A[B%C[D]E]F[G]%H", &[], 1, piece), "A[B]F[G]");
        assert_eq!(derived("A%B]C%D]%", &[], 1, piece), "A]C]");
        assert_eq!(derived("[[%A]B%C[", &[], 1, piece), "[[]B");
        // What is cut off is no context, and what a symbol that cuts would become does not come into being.
        assert_eq!(derived("A%B", &[("", 'A', "B", "C"), ("", '%', "", "D")], 1, piece), "A");
        assert_eq!(derived("A", &[("", 'A', "", "B%A"), ("", 'B', "", "A")], 2, piece), "A");
        assert_eq!(derived("A", &[("", 'A', "", "B%A"), ("", 'B', "", "A")], 3, piece), "B%A");
    }
}

#[test]
fn parameters_grow_and_conditions_hold() {
    // A(x) : x < 3 -> F(x)A(x + 1), as module counts and arguments.
    let letters = vec![Letter { symbol: 'A', arity: 1 }, Letter { symbol: 'F', arity: 1 }];
    let rule = Rule {
        production: 0,
        left: vec![],
        right: vec![],
        condition: Some(Code::Postfix(vec![
            lsystem_syntax::Op::Slot(0),
            lsystem_syntax::Op::Number(3.0),
            lsystem_syntax::Op::Binary(Operator::Less),
        ])),
        weight: None,
        successor: Template { letters: vec![1, 0], arguments: vec![Code::Slot(0), Code::Shifted(0, 1.0)] },
    };
    let axiom = Template { letters: vec![0], arguments: vec![Code::Constant(1.0)] };
    let (by_letter, images) = (vec![vec![rule], vec![]], vec![vec![]; 2]);
    let rules = Rules {
        letters,
        considered: vec![true; 2],
        cuts: vec![false; 2],
        by_letter,
        images,
        rewrites: vec![],
        axiom,
        spans: vec![],
        plain: false,
        interpreter: None,
    };
    let rewriter = derive(rules.clone(), 5, 2);
    assert_eq!(rewriter.word().letters, [1, 1, 0]);
    assert_eq!(rewriter.word().arguments, [1.0, 2.0, 3.0]);

    let mut endless = rules;
    endless.by_letter[0][0].condition = None;
    endless.by_letter[0][0].successor.arguments[1] = Code::Scaled(0, 1e200);
    let mut rewriter = Rewriter::new(Arc::new(endless), 0, Limits::default()).unwrap();
    assert_eq!(rewriter.step(9), Ok(true));
    assert_eq!(rewriter.step(9), Err(Fault::NotFinite(Some(0))));
}

#[test]
fn limits_stop_it() {
    let doubling = || rules("A", &[("", 'A', "", "AA")], "");
    let mut rewriter = Rewriter::new(Arc::new(doubling()), 0, Limits { modules: 1000, ..Limits::default() }).unwrap();
    let fault = loop {
        if let Err(fault) = rewriter.step(100) {
            break fault;
        }
    };
    assert_eq!((fault, rewriter.generation()), (Fault::Limit(LimitName::Modules), 9));
}
