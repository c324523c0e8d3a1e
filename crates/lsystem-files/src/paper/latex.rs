//! Systems typeset for LaTeX, as in The Algorithmic Beauty of Plants.

use super::facts::{self, Fact, Unit};
use super::tex;
use core::fmt::Write;
use lsystem_drawing::System;
use lsystem_syntax::grammar::{NamedCurve, NamedShape};
use lsystem_syntax::{Definition, Expr, Function, Module, Operator, Pattern, Production};

/// The most characters of a successor before a line may break.
const LINE: usize = 40;

/// The first line of the table.
pub const LATEX_START: &str =
    "\\begin{tabular}{@{}r@{\\enspace}>{\\raggedright\\arraybackslash}p{0.8\\linewidth}@{}}\n";

/// A system for a LaTeX document with the packages `amsmath` and `array`: a table with the numbers, constants, axiom
/// and productions. Long successors break between branches.
#[must_use]
pub fn latex(definition: &Definition, system: &System) -> String {
    let grammar = &system.grammar;
    let mut text = format!(
        "% {}\n% For documents with \\usepackage{{amsmath}} and \\usepackage{{array}}.\n",
        definition.label().replace(|c: char| c.is_control(), " ")
    );
    text.push_str(LATEX_START);
    row(&mut text, "", &facts::facts(definition, system).iter().map(fact).collect::<Vec<_>>().join(", "));
    let constants = grammar.constants.iter().map(|c| format!("${} = {}$", tex::name(&c.name), tex::decimal(c.value)));
    row(&mut text, "", &constants.collect::<Vec<_>>().join(", "));
    for NamedShape { name, shape } in &grammar.shapes {
        row(&mut text, "", &format!("${}$ is the shape {}.", tex::name(name), tex::text(&shape.to_string())));
    }
    for NamedCurve { name, curve } in &grammar.curves {
        row(&mut text, "", &format!("${}$ is the curve through ${curve}$.", tex::name(name)));
    }
    if let Some((word, symbols)) = facts::seen(grammar) {
        let symbols: String = symbols.iter().map(|&c| tex::symbol(c)).collect();
        row(&mut text, "", &format!("{word}: ${symbols}$"));
    }
    row(&mut text, "$\\omega$ :", &format!("${}$", successor(&grammar.axiom)));
    productions(&mut text, "p", &grammar.productions);
    if !grammar.images.is_empty() {
        row(&mut text, "", "homomorphism:");
        productions(&mut text, "h", &grammar.images);
    }
    remarks(&mut text, definition, system);
    text.push_str("\\end{tabular}\n");
    text
}

/// Writes a row, unless it has no content.
fn row(text: &mut String, label: &str, content: &str) {
    if !content.is_empty() {
        // Writing to a `String` cannot fail.
        let _ = writeln!(text, "{label}{}& {content} \\\\", if label.is_empty() { "" } else { " " });
    }
}

fn fact(fact: &Fact) -> String {
    let unit = match fact.unit {
        Unit::None => "",
        Unit::Degrees => "^\\circ",
        Unit::Percent => "\\,\\%",
    };
    format!("${} = {}{unit}$", fact.tex, fact.value(tex::decimal))
}

fn productions(text: &mut String, letter: &str, productions: &[Production]) {
    for (at, production) in productions.iter().enumerate() {
        row(text, &format!("${letter}_{{{}}}$ :", at + 1), &format!("${}$", rule(production)));
    }
}

/// The rows behind the productions, in words.
fn remarks(text: &mut String, definition: &Definition, system: &System) {
    if facts::has_free_weights(&system.grammar) {
        row(text, "", "Numbers over arrows are weights: probabilities are in proportion to them.");
    }
    for words in facts::meanings(definition) {
        row(text, "", &tex::text(&words));
    }
    for (symbol, actions) in facts::custom(definition) {
        row(text, "", &format!("${}$: {}", tex::symbol(symbol), tex::text(actions)));
    }
}

fn rule(production: &Production) -> String {
    let mut text = String::new();
    if !production.left.is_empty() {
        text = format!("{} < ", patterns(&production.left));
    }
    text.push_str(&patterns(core::slice::from_ref(&production.predecessor)));
    if !production.right.is_empty() {
        text.push_str(&format!(" > {}", patterns(&production.right)));
    }
    if let Some(condition) = &production.condition {
        text.push_str(" : ");
        expression(condition, 0, &mut text);
    }
    match &production.weight {
        None => text.push_str(" \\to "),
        Some(weight) => {
            text.push_str(" \\xrightarrow{");
            expression(weight, 0, &mut text);
            text.push_str("} ");
        }
    }
    text.push_str(&successor(&production.successor));
    text
}

fn patterns(patterns: &[Pattern]) -> String {
    let pattern = |pattern: &Pattern| {
        let symbol = tex::symbol(pattern.symbol);
        match &pattern.parameters[..] {
            [] => symbol,
            names => format!("{symbol}({})", names.iter().map(|name| tex::name(name)).collect::<Vec<_>>().join(",")),
        }
    };
    patterns.iter().map(pattern).collect()
}

/// The modules of an axiom or a successor.
fn successor(modules: &[Module]) -> String {
    if modules.is_empty() {
        return "\\varepsilon".into();
    }
    let (mut text, mut line) = (String::new(), 0);
    for module in modules {
        let start = text.len();
        if line > 2 * LINE || line > LINE && module.symbol == '[' {
            text.push_str("\\allowbreak ");
            line = 0;
        }
        text.push_str(&tex::symbol(module.symbol));
        for (at, argument) in module.arguments.iter().enumerate() {
            text.push(if at == 0 { '(' } else { ',' });
            expression(argument, 0, &mut text);
        }
        if !module.arguments.is_empty() {
            text.push(')');
        }
        // A module without arguments is about one character wide, whatever its command.
        line += if module.arguments.is_empty() { 1 } else { text.len() - start };
    }
    text
}

/// The precedence of signs and of what needs no parentheses; those of operators are below or between.
const SIGN: u8 = 6;
const ATOM: u8 = 8;

/// Writes an expression, in parentheses if it binds less tightly than `outer`.
fn expression(expr: &Expr, outer: u8, text: &mut String) {
    let own = match expr {
        Expr::Number(value) if value.is_sign_negative() => SIGN,
        Expr::Number(_) | Expr::Name(_) | Expr::Call(..) | Expr::Curve(..) => ATOM,
        Expr::Negative(_) | Expr::Not(_) => SIGN,
        Expr::Binary(operator, ..) => operator.precedence(),
    };
    if own < outer {
        text.push('(');
        expression(expr, 0, text);
        text.push(')');
        return;
    }
    match expr {
        Expr::Number(value) => text.push_str(&tex::decimal(*value)),
        Expr::Name(name) => text.push_str(&tex::name(name)),
        Expr::Negative(operand) | Expr::Not(operand) => {
            text.push_str(if matches!(expr, Expr::Not(_)) { "\\lnot " } else { "-" });
            expression(operand, SIGN, text);
        }
        // The exponent stands higher, so it needs no parentheses.
        Expr::Binary(Operator::Power, base, exponent) => {
            text.push('{');
            expression(base, ATOM, text);
            text.push_str("}^{");
            expression(exponent, 0, text);
            text.push('}');
        }
        Expr::Binary(operator, a, b) => {
            // Comparisons do not chain; the other operators group to the left.
            expression(a, if operator.is_comparison() { own + 1 } else { own }, text);
            text.push_str(mark(*operator));
            expression(b, own + 1, text);
        }
        Expr::Call(function, arguments) => call(*function, arguments, text),
        Expr::Curve(name, argument) => {
            text.push_str(&tex::name(name));
            text.push('(');
            expression(argument, 0, text);
            text.push(')');
        }
    }
}

/// An operator, as in the book: products without spaces.
fn mark(operator: Operator) -> &'static str {
    match operator {
        Operator::Or => " \\lor ",
        Operator::And => " \\land ",
        Operator::Equal => " = ",
        Operator::NotEqual => " \\neq ",
        Operator::Less => " < ",
        Operator::LessOrEqual => " \\leq ",
        Operator::Greater => " > ",
        Operator::GreaterOrEqual => " \\geq ",
        Operator::Add => "+",
        Operator::Subtract => "-",
        Operator::Multiply => "{*}",
        Operator::Divide => "/",
        Operator::Remainder => " \\bmod ",
        Operator::Power => "^",
    }
}

fn call(function: Function, arguments: &[Expr], text: &mut String) {
    let named;
    let (open, close) = match function {
        Function::Sqrt => ("\\sqrt{", "}"),
        Function::Abs => ("\\lvert ", "\\rvert "),
        Function::Floor => ("\\lfloor ", "\\rfloor "),
        Function::Ceil => ("\\lceil ", "\\rceil "),
        Function::Asin => ("\\arcsin(", ")"),
        Function::Acos => ("\\arccos(", ")"),
        Function::Atan => ("\\arctan(", ")"),
        Function::Sin
        | Function::Cos
        | Function::Tan
        | Function::Exp
        | Function::Ln
        | Function::Min
        | Function::Max => {
            named = format!("\\{}(", function.name());
            (named.as_str(), ")")
        }
        Function::Atan2 | Function::Random | Function::NormalRandom | Function::Inside | Function::Distance => {
            named = format!("\\operatorname{{{}}}(", function.name());
            (named.as_str(), ")")
        }
    };
    text.push_str(open);
    for (at, argument) in arguments.iter().enumerate() {
        text.push_str(if at == 0 { "" } else { ", " });
        expression(argument, 0, text);
    }
    text.push_str(close);
}

#[cfg(test)]
mod tests {
    use super::*;
    use expect_test::{Expect, expect};

    fn check(definition: &Definition, expected: &Expect) {
        expected.assert_eq(&latex(definition, &System::new(definition).unwrap()));
    }

    #[test]
    fn stochastic() {
        check(
            &Definition {
                title: "Random weed".into(),
                axiom: "F".into(),
                rules: "F -> F[+F]F[-F]F : 0.33\nF -> F[+F]F : 0.33\nF -> * : 0.34".into(),
                angle: 25.7,
                iterations: 5,
                seed: 8,
                ..Definition::default()
            },
            &expect![[r#"
                % Random weed
                % For documents with \usepackage{amsmath} and \usepackage{array}.
                \begin{tabular}{@{}r@{\enspace}>{\raggedright\arraybackslash}p{0.8\linewidth}@{}}
                & $n = 5$, $\delta = 25.7^\circ$, $\text{seed} = 8$ \\
                $\omega$ : & $F$ \\
                $p_{1}$ : & $F \xrightarrow{0.33} F[{+}F]F[{-}F]F$ \\
                $p_{2}$ : & $F \xrightarrow{0.33} F[{+}F]F$ \\
                $p_{3}$ : & $F \xrightarrow{0.34} \varepsilon$ \\
                \end{tabular}
            "#]],
        );
    }

    #[test]
    fn contexts_parameters_and_images() {
        check(
            &Definition {
                name: "signal".into(),
                axiom: "!(1)A(1, 10)$".into(),
                rules: "r1 = 0.9\nlw = 1e-9\nignore: +-\nA(x) < B(y) > [C]D : x^2 > -(y + 1) && sqrt(x) != 3 -> F((x + y)*r1/2)[&(lw)B(x - (y - 1))] : 2\nA(x, y) -> B(x%2)\ndraw:\nA -> {.}%".into(),
                angle: 90.0,
                right_angle: Some(60.0),
                heading: 0.0,
                elasticity: 0.22,
                overrides: "G: move\n_: turn left 90, draw 5".into(),
                ..Definition::default()
            },
            &expect![[r#"
                % signal
                % For documents with \usepackage{amsmath} and \usepackage{array}.
                \begin{tabular}{@{}r@{\enspace}>{\raggedright\arraybackslash}p{0.8\linewidth}@{}}
                & $n = 1$, $\delta = 90^\circ$, $\delta_{\text{right}} = 60^\circ$, $\text{start heading} = 0^\circ$, $\vec{T} = (0, -1, 0)$, $e = 0.22$, $\text{seed} = 0$ \\
                & $r_{1} = 0.9$, $\mathit{lw} = 1\cdot10^{-9}$ \\
                & ignore: ${+}{-}$ \\
                $\omega$ : & ${!}(1)A(1,10)\$$ \\
                $p_{1}$ : & $A(x) < B(y) > [C]D : {x}^{2} > -(y+1) \land \sqrt{x} \neq 3 \xrightarrow{2} F((x+y){*}r_{1}/2)[\&(\mathit{lw})B(x-(y-1))]$ \\
                $p_{2}$ : & $A(x,y) \to B(x \bmod 2)$ \\
                & homomorphism: \\
                $h_{1}$ : & $A \to \{{.}\}\%$ \\
                & $G$: move \\
                & $\_$: turn left 90, draw 5 \\
                \end{tabular}
            "#]],
        );
    }

    #[test]
    fn long_successors_may_break() {
        let rules = format!("F -> {}", "F[+F]".repeat(30));
        let definition = Definition { axiom: "F".into(), rules, ..Definition::default() };
        let text = latex(&definition, &System::new(&definition).unwrap());
        assert_eq!(text.matches("\\allowbreak [").count(), 3, "{text}");
    }
}
