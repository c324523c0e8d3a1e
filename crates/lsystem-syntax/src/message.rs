//! The words of all diagnostics, in English, in one place.

use crate::curve::MOST_POINTS;
use crate::{Diagnostic, Expected, Function, JsonError, Kind, MOST_SIDES, Role, SurfaceProblem, TikzObstacle};
use lsystem_base::number::number;
use lsystem_base::{LimitName, MAX_PALETTE, MAX_SURFACE_PATCHES, MAX_SURFACES};

impl Diagnostic {
    /// The problem, as one English sentence.
    #[must_use]
    pub fn message(&self) -> String {
        words(&self.kind).0
    }

    /// A remedy, as one English sentence; `None` if there is no hint.
    #[must_use]
    pub fn hint(&self) -> Option<String> {
        words(&self.kind).1
    }
}

/// The thing that TikZ's library lacks, after "has no".
fn missing_in_tikz(obstacle: TikzObstacle) -> String {
    match obstacle {
        TikzObstacle::Random => "seeded random choices".into(),
        TikzObstacle::Contexts => "contexts".into(),
        TikzObstacle::Parameters => "parameters and conditions".into(),
        TikzObstacle::Images => "rules for drawing".into(),
        TikzObstacle::Symbol(symbol) => format!("symbol `{symbol}`"),
        TikzObstacle::Action(symbol) => format!("action for what `{symbol}` does"),
        TikzObstacle::Branches => "brackets across rules".into(),
        TikzObstacle::Nesting => "room for so many branches in branches".into(),
        TikzObstacle::Colours => "colours within one drawing".into(),
        TikzObstacle::Levels => "widths or lengths by branch level".into(),
        TikzObstacle::Tropism => "tropism and sway".into(),
        TikzObstacle::Growth => "partly grown steps".into(),
    }
}

/// The hint for marks without a meaning.
const CUSTOM: &str = "A custom symbol of one character can mean this, as in `K: turn left 90, draw 5`.";

/// The message and the hint of a diagnostic.
fn words(kind: &Kind) -> (String, Option<String>) {
    let said = |text: String| (text, None);
    let hinted = |text: String, hint: String| (text, Some(hint));
    match kind {
        Kind::Limit { limit, value, largest } => {
            let mebibytes = grouped(&(value >> 20).to_string());
            let value = grouped(&value.to_string());
            let text = match limit {
                LimitName::Modules => format!("A generation would have more than {value} modules"),
                LimitName::Symbols => format!("The string would be longer than {value} symbols"),
                LimitName::Segments => format!("The drawing would have more than {value} segments"),
                LimitName::Work => format!("Deriving it would pass through more than {value} symbols"),
                LimitName::PlotStrokes => format!("The plot would have more than {value} strokes"),
                LimitName::PlotBlocks => format!("The plot would be made of more than {value} parts of the drawing"),
                LimitName::Mesh => format!("The mesh would have more than {value} segments and vertices of polygons"),
                LimitName::MeshCopies => {
                    format!("Viewers would draw more than {value} segments and vertices of polygons")
                }
                LimitName::Memory => format!("The drawing would take more than {mebibytes} MiB of memory"),
                LimitName::Iterations => format!("There can be at most {value} iterations"),
                LimitName::Text => format!("The text is longer than {value} bytes"),
                LimitName::Letters => format!("There can be at most {value} different symbols"),
                LimitName::Parameters => format!("A module can have at most {value} parameters"),
                LimitName::Context => format!("A context can have at most {value} modules"),
                LimitName::Actions => format!("A symbol can have at most {value} actions"),
            };
            let hint = match limit {
                LimitName::PlotStrokes | LimitName::PlotBlocks => {
                    Some("A broader pen, a smaller sheet or fewer iterations make fewer.".into())
                }
                LimitName::Mesh | LimitName::MeshCopies => {
                    Some("Fewer iterations or a larger finest part make fewer.".into())
                }
                _ => largest.map(|n| format!("Up to {n} iterations fit.")),
            };
            (text, hint)
        }
        Kind::NotText { line } => said(format!("Line {line} is not UTF-8 text")),
        Kind::NoSystem { picture } => hinted(
            format!("This {picture} holds no L-system"),
            format!("Only {picture} files that were saved here carry the system they show."),
        ),
        Kind::Instances { count } => hinted(
            format!("This file may open slowly ({} shapes)", grouped(&count.to_string())),
            "Fewer iterations or a smaller size make fewer.".into(),
        ),
        Kind::CoveringInk => hinted(
            "This format has no additive blending: strokes cover each other in the file".into(),
            "PNG keeps the blending.".into(),
        ),
        Kind::NotInTikz { obstacle } => hinted(
            format!("TikZ's library lindenmayersystems has no {}", missing_in_tikz(*obstacle)),
            "The TikZ picture holds any drawing, as paths.".into(),
        ),
        Kind::More { left_out } => said(format!("And {left_out} more")),

        Kind::LookAlike { found, read_as } if *read_as == ' ' => {
            said(format!("An invisible character ({}) is read as white space", code(*found)))
        }
        Kind::LookAlike { found, read_as } => hinted(
            format!("`{found}` ({}) is read as `{read_as}`", code(*found)),
            format!("For the character itself as a symbol write {}.", literal(*found)),
        ),
        Kind::LiteralLength => hinted(
            "Backquotes hold exactly one character".into(),
            "Write each symbol in its own backquotes, or by its number, as in `U+0A`.".into(),
        ),
        Kind::LiteralUnclosed => hinted(
            "This backquote is never closed".into(),
            "Backquotes make one character a symbol: `:`. The backquote itself is ```.".into(),
        ),
        Kind::ParenthesisUnclosed => {
            hinted("This `(` is never closed".into(), "Add `)`, or write `(` in backquotes to use it as a symbol.".into())
        }
        Kind::ParenthesisSymbol { symbol } => hinted(
            format!("`{symbol}` is read as a symbol here"),
            "Arguments follow their symbol without a space; write the parenthesis in backquotes if a symbol is meant."
                .into(),
        ),

        Kind::ParenthesesEmpty => {
            hinted("There is nothing between these parentheses".into(), "Leave them out, or write arguments.".into())
        }
        Kind::NoArrow { suggestion } => hinted(
            "This line is neither a rule nor a constant".into(),
            match suggestion {
                Some(production) => format!("Write `{production}`."),
                None => "Write a rule as `F -> FF`, a constant as `r = 0.9`, a comment after `//`.".into(),
            },
        ),
        Kind::EqualsForArrow { left, right } => hinted(
            format!("`=` gives a constant its value, and `{right}` is not a number"),
            format!("For a rule write `{left} -> {right}`."),
        ),
        Kind::OtherField { word } => hinted(
            format!("`{word}` does not belong among the rules"),
            match word.as_str() {
                "endlsystem" | "lsystem" | "seed" => "Leave this line out.".into(),
                "axiom" | "initial" | "start" | "omega" | "ω" => "The axiom has a field of its own.".into(),
                "angle" | "delta" | "δ" => "The angle has a field of its own.".into(),
                _ => "The axiom, the angle and the number of iterations have fields of their own.".into(),
            },
        ),
        Kind::NoPredecessor => hinted(
            "There is no symbol before the arrow".into(),
            "Write the symbol to be replaced first, as in `F -> FF`; `<`, `>`, `:` and a `-` right before the arrow need \
             backquotes or a space."
                .into(),
        ),
        Kind::LongPredecessor { text } => hinted(
            format!("A rule replaces one symbol, not `{text}`"),
            match text.chars().next() {
                Some(first) if first.is_alphabetic() => {
                    format!("Write one rule for each symbol, as in `{first} -> ...`.")
                }
                _ => "Write one rule for each symbol, without quotes, bullets or numbers.".into(),
            },
        ),
        Kind::ParameterName { text } => hinted(
            format!("`{text}` cannot be the name of a parameter"),
            match text.chars().next() {
                Some(first) if first.is_alphabetic() => {
                    "Before the arrow parentheses hold names only, as in `A(l, w)`; compute after the arrow.".into()
                }
                Some(_) => format!("Write a name and a condition, as in `A(x) : x == {text} -> ...`."),
                None => "Write a name, as in `A(l, w)`.".into(),
            },
        ),
        Kind::ParameterTwice { name } => hinted(
            format!("Two parameters are called `{name}`"),
            format!("Give them different names; compare them in a condition, as in `: {name} == {name}1`."),
        ),
        Kind::ContextOrder => hinted(
            "A rule has one left and one right context at most".into(),
            "Write it as `A < B > C -> D`; conditions come after `:`, and the symbols `<` and `>` in backquotes.".into(),
        ),
        Kind::ContextMissing { mark } => hinted(
            format!("There is no context {} `{mark}`", if *mark == '<' { "before" } else { "after" }),
            format!("Write `*` for any context, or leave `{mark}` out."),
        ),
        Kind::ContextForCondition => hinted(
            "This is read as a context, not as a comparison".into(),
            "Conditions come after `:`, as in `A(x) : x < 3 -> B`; write the digits in backquotes if they are symbols."
                .into(),
        ),
        Kind::ConditionBehind => hinted(
            "`if` and what follows are read as symbols".into(),
            "A condition stands before the arrow, as in `A(x) : x < 3 -> B`.".into(),
        ),
        Kind::CommentBehind => hinted(
            "This comment is read as symbols".into(),
            "A comment needs a line of its own, or stands between `/*` and `*/`.".into(),
        ),
        Kind::CommentUnclosed => hinted("This comment is never closed".into(), "Add `*/`.".into()),
        Kind::Quotes { inside } => hinted(
            "These quotes are read as symbols".into(),
            format!("Strings need no quotes: write `{inside}`."),
        ),
        Kind::CommaBehind => {
            hinted("This comma is read as a symbol".into(), "Lines need no comma at the end.".into())
        }
        Kind::DigitsBehind { symbol, digits } => hinted(
            format!("The digits after {} are read as symbols", named(*symbol)),
            match symbol {
                '@' | '~' | '?' => CUSTOM.into(),
                _ => format!("A number stands in parentheses, as in `{symbol}({digits})`."),
            },
        ),
        Kind::TwoCharacters { second } => hinted(
            format!("`@{second}` is read as two symbols"),
            CUSTOM.into(),
        ),
        Kind::ParenthesesForBranch { inside } => hinted(
            "Parentheses hold numbers, not symbols".into(),
            format!("A branch stands in brackets: write `[{inside}]`."),
        ),
        Kind::WeightOfSymbols => hinted(
            "This number is read as symbols".into(),
            "A weight stands at the end of the line, as in `F -> FF : 0.5`.".into(),
        ),
        Kind::ContextBracketLeft => hinted(
            "A left context has no brackets: it is read along the way to the root".into(),
            "Leave out finished branches and the `[` of the branch itself.".into(),
        ),
        Kind::ContextBracket => hinted(
            "Brackets in a right context come in pairs and have no parameters".into(),
            "Write a branch as in `B > C[D]E`.".into(),
        ),
        Kind::ContextUnseen { symbol } => hinted(
            format!("Contexts do not see {}, so this rule never applies", named(*symbol)),
            "Take it out of the context, or change `ignore:` or `consider:`.".into(),
        ),
        Kind::DrawContext => hinted(
            "Rules below `draw:` have no contexts".into(),
            "Let a rule above `draw:` make another symbol there, and draw that.".into(),
        ),
        Kind::IgnoreAndConsider => hinted(
            "There is `ignore:` as well as `consider:`".into(),
            "Keep one of them: `ignore:` lists what contexts skip, `consider:` all that they see.".into(),
        ),
        Kind::ArrowForComparison => hinted(
            "This is read as an arrow".into(),
            "For at least write `>=`.".into(),
        ),
        Kind::SecondArrow => hinted(
            "There is a second arrow in this line".into(),
            "Write each rule on a line of its own.".into(),
        ),
        Kind::ArrowInAxiom => {
            hinted("There is an arrow in the axiom".into(), "Rules belong below the axiom, not in it.".into())
        }
        Kind::NeverApplies { symbol, conditional } => hinted(
            format!("This rule never applies: there is one for {} above", named(*symbol)),
            if *conditional {
                "Move it above the one without a condition.".into()
            } else {
                "Give both a weight to choose between them at random, as in `F -> FF : 0.5`.".into()
            },
        ),
        Kind::MixedWeights { symbol, weighted } => hinted(
            format!(
                "This rule never applies: the first one for {} has {} weight",
                named(*symbol),
                if *weighted { "a" } else { "no" }
            ),
            format!("Give all rules for {} a weight, or none.", named(*symbol)),
        ),

        Kind::WeightRange { value } => {
            hinted(format!("{} cannot be a weight", number(*value)), "A weight is a number above zero, from 1e-100 to 1e100.".into())
        }
        Kind::NumberExpected => said("A number is missing here".into()),
        Kind::NumberMalformed { text } => {
            hinted(format!("`{text}` is not a number"), "Write numbers as 2, 0.5 or 1e-3.".into())
        }
        Kind::NumberRange { text } => {
            hinted(format!("`{text}` is too large a number"), "Numbers can be up to 1e308.".into())
        }
        Kind::ArithmeticUnexpected { found, role } => hinted(
            format!("{} has no place in arithmetic", named(*found)),
            match found {
                ')' => "Nothing is open there: leave it out, or add `(`.".into(),
                '&' if *role == Role::Condition => "Where both must hold write `&&` or `and`.".into(),
                '|' if *role == Role::Condition => "Where one of both is enough write `||` or `or`.".into(),
                ',' if *role == Role::Condition => {
                    "Where both must hold write `&&` or `and`; write decimals with a point, as in 0.33.".into()
                }
                letter if *role == Role::Condition && letter.is_alphabetic() => {
                    "Conditions are joined by `and`, `or` and `not` in small letters, or by `&&`, `||` and `!`.".into()
                }
                ',' if *role == Role::Weight => {
                    "Each outcome has a line of its own, as in `F -> FF : 0.33`; write decimals with a point.".into()
                }
                ',' => "Write decimals with a point, as in 0.33.".into(),
                '#' => "A comment needs a line of its own.".into(),
                '%' => "Write percentages as fractions, as in 0.33.".into(),
                '[' | ']' | '{' | '}' => "Group with parentheses.".into(),
                _ => match role {
                    Role::Weight => "The weight starts after the last `:`; write the symbol `:` in backquotes.".into(),
                    Role::Constant => "A value is made of numbers, constants, functions and + - * / % ^ ( ).".into(),
                    Role::Argument | Role::Axiom => {
                        "Write products with `*`, as in `2*x`, and separate arguments by commas.".into()
                    }
                    Role::Condition => "A condition compares values, as in `x > 1 && y <= 2`.".into(),
                },
            },
        ),
        Kind::ArithmeticUnclosed => hinted("This `(` is never closed".into(), "Add `)`.".into()),
        Kind::ArithmeticDepth => hinted(
            "The arithmetic is too long or nested too deeply".into(),
            "Name a part of it, as in `r = 0.9 * 0.7`.".into(),
        ),
        Kind::ArithmeticRange => {
            hinted("The result is not a finite number".into(), "Is something divided by zero?".into())
        }
        Kind::UnknownConstant { name, similar, below, role } => hinted(
            match role {
                Role::Constant | Role::Weight | Role::Axiom => {
                    format!("There is no constant `{name}`{}", if *below { " above this line" } else { "" })
                }
                Role::Condition | Role::Argument => format!("There is no parameter or constant `{name}`"),
            },
            match (similar, role) {
                _ if *below => format!("Move the definition of `{name}` up."),
                (_, Role::Condition) if name == "if" => {
                    "A condition needs no `if`: write it right after the colon, as in `A(x) : x < 3 -> B`.".into()
                }
                (_, Role::Condition) if name == "true" => "Leave out a condition that always holds.".into(),
                _ if matches!(name.as_str(), "pi" | "PI" | "Pi" | "π") => {
                    format!("Define it, as in `{name} = 3.14159265`; angles are in degrees.")
                }
                (Some(similar), _) => format!("Did you mean `{similar}`?"),
                (None, Role::Weight) => {
                    format!("Define it, as in `{name} = 0.5`, or write the symbol `:` in backquotes.")
                }
                (None, Role::Constant) => format!("Define it above, as in `{name} = 0.5`."),
                (None, Role::Axiom) => format!("Define it in the rules, as in `{name} = 0.5`."),
                (None, Role::Condition | Role::Argument) => {
                    format!("Give it to the predecessor, as in `A({name})`, or define it, as in `{name} = 0.5`.")
                }
            },
        ),
        Kind::UnknownFunction { name, similar } => hinted(
            format!("There is no function `{name}`"),
            match similar {
                _ if matches!(name.as_str(), "pow" | "power") => "For a power write `x^y`.".into(),
                _ if matches!(name.as_str(), "mod" | "fmod") => "For a remainder write `x % y`.".into(),
                _ if matches!(name.as_str(), "log" | "log10") => "The natural logarithm is `ln(x)`.".into(),
                _ if matches!(name.as_str(), "rand" | "rnd") => {
                    "A random number between two others is `random(0, 1)`.".into()
                }
                _ if matches!(name.as_str(), "round" | "int" | "trunc") => "To round write `floor(x + 0.5)`.".into(),
                Some(similar) => format!("Did you mean `{similar}`?"),
                None => {
                    let names: Vec<&str> = Function::ALL.iter().map(|f| f.name()).collect();
                    format!("The functions are {}.", names.join(", "))
                }
            },
        ),
        Kind::NotAFunction { name } => {
            hinted(format!("`{name}` is not a function"), format!("For a product write `{name}*(...)`."))
        }
        Kind::FunctionBare { name } => {
            hinted(format!("`{name}` needs its argument in parentheses"), format!("Write it as in `{name}(30)`."))
        }
        Kind::FunctionArity { function, expected, found } => hinted(
            format!("`{}` takes {}, not {found}", function.name(), plural(*expected, "argument")),
            match function {
                Function::Random => "`random(a, b)` is a number from a up to b.".into(),
                Function::NormalRandom => "`nran(m, s)` has the mean m and the standard deviation s.".into(),
                Function::Atan2 => "`atan2(y, x)` is the angle of the point (x, y).".into(),
                Function::Inside | Function::Distance => {
                    format!("Write it as in `{}(crown, x, y, z)`.", function.name())
                }
                _ if *expected == 2 => format!("Write it as in `{}(a, b)`.", function.name()),
                _ => format!("Write it as in `{}(a)`.", function.name()),
            },
        ),
        Kind::ShapeExpected { found } => hinted(
            if found.is_empty() {
                "The name of a shape is missing".into()
            } else {
                format!("`{found}` is not the name of a shape")
            },
            "Define one in a line above, as in `shape crown = ball(0, 10, 0, 5)`.".into(),
        ),
        Kind::ShapeUnused { name } => {
            hinted(format!("Nothing uses the shape `{name}`"), format!("Use it as in `inside({name}, x, y, z)`."))
        }
        Kind::CurveUnused { name } => {
            hinted(format!("Nothing uses the curve `{name}`"), format!("Use it as in `{name}(x)`."))
        }
        Kind::CurvePoint { found } => hinted(
            format!("`{found}` is not a point of a curve"),
            "Write each point with x and y, as in `(0, 1) (0.5, 2)`.".into(),
        ),
        Kind::CurveBack => {
            hinted("This point lies to the left of the point before it".into(), "x must not decrease along a curve.".into())
        }
        Kind::CurveCount { found } => hinted(
            format!("This curve has {}", plural(*found, "point")),
            format!("A curve has 2 to {MOST_POINTS} points, and the last is to the right of the first."),
        ),
        Kind::SolidExpected { found } => hinted(
            if found.is_empty() { "A solid is missing".into() } else { format!("`{found}` is not a solid with its numbers") },
            "Solids are ball(x, y, z, r), box, cylinder, cone, half, outline and mesh, joined by +, - or &.".into(),
        ),
        Kind::SolidNumbers { name, expected, found } => hinted(
            match expected {
                Some(expected) => format!("`{name}` takes {}, not {found}", plural(*expected, "number")),
                None if *name == "mesh" => format!("`mesh` takes nine numbers for each of 4 to {MOST_SIDES} triangles"),
                None => format!("`{name}` takes two numbers for each of 3 to {MOST_SIDES} corners"),
            },
            match *name {
                "ball" => "`ball(x, y, z, r)` has a centre and a radius.".into(),
                "box" => "`box(x, y, z, x, y, z)` has two opposite corners.".into(),
                "cylinder" | "cone" => format!("`{name}(x, y, z, x, y, z, r)` has two ends and a radius."),
                "half" => "`half(x, y, z, a, b, c)` has a point of its plane, and a direction out of it.".into(),
                "mesh" => "`mesh(x, y, z, x, y, z, x, y, z, ...)` has the corners of its triangles.".into(),
                _ => "`outline(x, y, x, y, x, y)` has its corners in order.".into(),
            },
        ),
        Kind::ComparisonChain => hinted(
            "Comparisons cannot be chained".into(),
            "Write them one by one, as in `0 < x && x < 5`.".into(),
        ),
        Kind::WeightCondition => hinted(
            "This compares values, and a weight is a number".into(),
            "Conditions come before the arrow, as in `A(x) : x > 1 -> B`.".into(),
        ),
        Kind::ConditionConstant { holds } => hinted(
            format!("This condition is always {}", if *holds { "true" } else { "false" }),
            "A weight stands at the end of the line, as in `F -> FF : 0.5`.".into(),
        ),
        Kind::ConstantRandom => hinted(
            "A constant has the same value everywhere, so it cannot be random".into(),
            "Use `random` in the arguments of a rule.".into(),
        ),
        Kind::ConstantName { text } if text.is_empty() => {
            hinted("The constant has no name".into(), "Write it as `r = 0.9`.".into())
        }
        Kind::ConstantName { text } => hinted(
            format!("`{text}` cannot be the name of a constant"),
            "A name is a letter followed by letters, digits or `_`; a rule needs an arrow, as in `F -> FF`.".into(),
        ),
        Kind::ConstantTwice { name } => {
            hinted(format!("`{name}` is defined already"), "Give one of them another name.".into())
        }
        Kind::ConstantUnused { name, value } => hinted(
            format!("Nothing uses the constant `{name}`"),
            if matches!(name.as_str(), "angle" | "delta" | "δ" | "n" | "iterations" | "depth" | "generations" | "order") {
                "The angle and the number of iterations have fields of their own.".into()
            } else if name.chars().nth(1).is_none() {
                format!("If a rule is meant, write `{name} -> {value}`.")
            } else {
                "Use it in a rule, or remove it.".into()
            },
        ),

        Kind::OverrideColon { suggestion } => hinted(
            "There is no `:` after the symbol".into(),
            format!("Write `{}`.", suggestion.as_deref().unwrap_or("G: move")),
        ),
        Kind::OverrideSymbol { text } if text.is_empty() => {
            hinted("There is no symbol before the `:`".into(), "Write one, as in `G: move`.".into())
        }
        Kind::OverrideSymbol { text } => hinted(
            format!("`{text}` is not one symbol"),
            "Give each symbol a line of its own, as in `G: move`.".into(),
        ),
        Kind::OverrideTwice { symbol } => said(format!("This replaces the line for {} above", named(*symbol))),
        Kind::UnknownAction { text, similar } => hinted(
            if text.is_empty() { "An action is missing here".into() } else { format!("`{text}` is not an action") },
            match similar {
                Some(similar) => format!("Did you mean `{similar}`?"),
                None => "Actions are draw, move, draw unmarked, move unmarked, turn left, turn right, turn round, pitch \
                         down, pitch up, roll left, roll right, roll upright, open branch, close branch, cut branch, \
                         open polygon, vertex, close polygon, open tube, tube point, close tube, colour 2, next colour, previous colour, width 2, width \
                         times 0.5, thicker, thinner, length times 0.5, swap turns, circle, disc, leaf lance, leaf heart, \
                         leaf oak, leaf needle, leaf petal, surface l, nothing."
                    .into(),
            },
        ),
        Kind::NothingElse => {
            hinted("`nothing` stands together with other actions".into(), "Leave `nothing` out, or the others.".into())
        }
        Kind::ActionNumber { expected: Expected::Nothing } => said("This action takes no number".into()),
        Kind::ActionNumber { expected } => said(format!("This action needs {}", expected_words(*expected))),

        Kind::EmptyAxiom => hinted(
            "The axiom is empty, so there is nothing to derive".into(),
            "Write the symbols to start from, as in `F`.".into(),
        ),
        Kind::UnmatchedClose { symbol } => hinted(
            format!("This {} closes no branch and is ignored in the drawing", named(*symbol)),
            "Remove it, or open the branch before it.".into(),
        ),
        Kind::UnmatchedOpen { symbol } => hinted(
            format!("This {} is never closed", named(*symbol)),
            "Close the branch where it ends.".into(),
        ),
        Kind::ArrowOfSymbols => hinted(
            "This arrow is read as two symbols".into(),
            "Write each rule on a line of its own.".into(),
        ),
        Kind::NeverOccurs { symbol } => hinted(
            format!("{} never occurs, so this rule never applies", named(*symbol)),
            "Use the symbol in the axiom or in a rule that applies, or remove this one.".into(),
        ),
        Kind::OtherArity { symbol, parameters, found } => hinted(
            format!(
                "This rule never applies: {} occurs with {} only",
                named(*symbol),
                if *found == 0 { "no parameters".into() } else { plural(*found, "parameter") }
            ),
            format!("A symbol with {} is another letter: give it as many everywhere.", plural(*parameters, "parameter")),
        ),
        Kind::NoRuleForArity { symbol, parameters, found } => hinted(
            format!(
                "No rule applies to this: those for {} have {}",
                named(*symbol),
                if *found == 0 { "no parameters".into() } else { plural(*found, "parameter") }
            ),
            match parameters {
                2 => "Write decimals with a point, as in A(0.5); a comma separates arguments.".into(),
                _ => "A symbol with another number of parameters is another letter.".into(),
            },
        ),
        Kind::NotFinite { step } => hinted(
            match step {
                0 => "An argument of the axiom is not a finite number".into(),
                _ => format!("An argument that this rule computes in step {step} is not a finite number"),
            },
            "Is something divided by zero, or does it grow without end? A condition can stop it.".into(),
        ),
        Kind::NoCloseup => hinted(
            "This drawing cannot be seen from near that segment".into(),
            "Segments are counted from 0. The system must be in the plane, without chance, contexts and tropism.".into(),
        ),
        Kind::Surface { line, problem } => hinted(
            format!("Line {line} of the surfaces: {}", surface_words(*problem)),
            "A surface is a letter, a colon, and 48 numbers for each patch.".into(),
        ),
        Kind::UnknownSurface { name } => {
            hinted(format!("There is no surface `{name}`"), format!("Add the line of `{name}` to the surfaces."))
        }
        Kind::Range { label, expected } => said(format!("{label} must be {}", expected_words(*expected))),

        Kind::Json(error) => json(*error),
        Kind::WrongType { key, expected, found } if key.is_empty() => {
            said(format!("The file must hold {}, not {found}", expected_words(*expected)))
        }
        Kind::WrongType { key, expected, found } => {
            said(format!("`{key}` must be {}, not {found}", expected_words(*expected)))
        }
        Kind::WrongValue { key, expected } => said(format!("`{key}` must be {}", expected_words(*expected))),
        Kind::UnknownKey { key, similar } => {
            (format!("Unknown key `{key}`"), similar.map(|s| format!("Did you mean `{s}`?")))
        }
        Kind::DuplicateKey { key } => said(format!("`{key}` stands here a second time; this one counts")),
        Kind::MissingKey { key } => {
            hinted(format!("`{key}` is missing"), "An outcome is written as {\"p\": 0.5, \"e\": \"F+F\"}.".into())
        }
        Kind::RuleKey { key } if key.is_empty() => said("The key is empty; it must be one symbol".into()),
        Kind::RuleKey { key } => said(format!("`{key}` must be one symbol")),
        Kind::SpaceSymbol => hinted(
            "White space is a symbol here".into(),
            "In this form of rules each character is a symbol; remove the space if it is not meant.".into(),
        ),
        Kind::ProbabilitySum { sum } => hinted(
            format!("The probabilities sum to {}, not to 1", rounded(*sum)),
            "They are read as weights: each is divided by the sum.".into(),
        ),
        Kind::NoOutcome => hinted(
            "None of these outcomes can happen".into(),
            "Write a string, or outcomes as {\"p\": 0.5, \"e\": \"F+F\"}.".into(),
        ),
        Kind::ProbabilityZero => said("An outcome with probability 0 never happens".into()),
    }
}

/// What is wrong with a line of surfaces.
fn surface_words(problem: SurfaceProblem) -> String {
    match problem {
        SurfaceProblem::Name => "it does not begin with a letter and a colon".into(),
        SurfaceProblem::Twice(name) => format!("the surface `{name}` stands twice"),
        SurfaceProblem::Number => "a word is no number between -1,000,000 and 1,000,000".into(),
        SurfaceProblem::Count(found) => format!("{found} numbers are no multiple of 48"),
        SurfaceProblem::Patches => format!("a surface has at most {MAX_SURFACE_PATCHES} patches"),
        SurfaceProblem::Surfaces => format!("a system has at most {MAX_SURFACES} surfaces"),
    }
}

fn json(error: JsonError) -> (String, Option<String>) {
    let hint = |text: &str| Some(text.to_owned());
    match error {
        JsonError::Empty => ("The file holds nothing".into(), hint("It must hold an object: {\"initial\": \"F\"}.")),
        JsonError::NoSystem => (
            "This is no L-system: it has neither an axiom nor rules".into(),
            hint("A system has the keys `initial` and `rules`."),
        ),
        JsonError::Unexpected => ("This has no place in JSON".into(), hint("Is a quote or a comma missing before it?")),
        JsonError::UnclosedString => ("This string is never closed".into(), hint("Add the closing quote.")),
        JsonError::UnclosedComment => ("This comment is never closed".into(), hint("Add `*/`.")),
        JsonError::UnclosedObject => ("This object is never closed".into(), hint("Add `}`.")),
        JsonError::UnclosedArray => ("This list is never closed".into(), hint("Add `]`.")),
        JsonError::MissingComma => ("A comma is missing".into(), None),
        JsonError::MissingColon => ("A colon is missing after the key".into(), None),
        JsonError::Escape => {
            ("This escape is not known".into(), hint("A backslash in a string is written twice: \"\\\\\"."))
        }
        JsonError::Number => ("This is not a number".into(), None),
        JsonError::Depth => ("The file is nested too deeply".into(), None),
    }
}

/// The expected type and range of a value, as a noun phrase.
pub fn expected_words(expected: Expected) -> String {
    match expected {
        Expected::Nothing => "nothing".into(),
        Expected::Number => "a number".into(),
        Expected::Between(least, most) => format!("a number from {} to {}", bound(least), bound(most)),
        Expected::PositiveUpTo(most) => format!("a number above 0, at most {}", bound(most)),
        Expected::Whole(least, most) => {
            format!("a whole number from {} to {}", bound(least as f64), bound(most as f64))
        }
        Expected::Boolean => "true or false".into(),
        Expected::String => "a string".into(),
        Expected::Text(most) => format!("a text of at most {} characters", bound(most as f64)),
        Expected::Word(words) => {
            let words: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
            format!("one of {}", words.join(", "))
        }
        Expected::Object => "an object".into(),
        Expected::Each(count, each) => format!("a list of {count} values, each {}", expected_words(*each)),
        Expected::Record(members) => {
            let members: Vec<&str> = members.iter().map(|(name, _)| *name).collect();
            format!("an object of {}", members.join(", "))
        }
        Expected::Rules | Expected::Overrides => "an object or a list of lines".into(),
        Expected::Successor => "a string or a list of outcomes".into(),
        Expected::Outcome => "an outcome {\"p\": 0.5, \"e\": \"F+F\"}".into(),
        Expected::Colour => "a colour such as \"#1f5c3a\"".into(),
        Expected::Palette => format!("a list of 1 to {MAX_PALETTE} colours such as \"#1f5c3a\""),
    }
}

/// A bound of a range; whole numbers with their digits in groups of three.
fn bound(value: f64) -> String {
    let digits = number(value.abs());
    let digits = if digits.bytes().all(|byte| byte.is_ascii_digit()) { grouped(&digits) } else { digits };
    if value < 0.0 { format!("-{digits}") } else { digits }
}

fn plural(count: usize, word: &str) -> String {
    format!("{count} {word}{}", if count == 1 { "" } else { "s" })
}

/// A symbol as shown in a sentence.
fn named(symbol: char) -> String {
    match symbol {
        ' ' => "The space".into(),
        _ if symbol.is_whitespace() || symbol.is_control() => code(symbol),
        _ => format!("`{symbol}`"),
    }
}

fn code(ch: char) -> String {
    format!("U+{:04X}", u32::from(ch))
}

fn literal(ch: char) -> String {
    let mut out = String::new();
    crate::print::symbol(ch, true, &mut out);
    out
}

/// A number with at most six decimals.
fn rounded(value: f64) -> String {
    if value.abs() < 1e9 { number(libm::round(value * 1e6) / 1e6) } else { number(value) }
}

/// Digits in groups of three, separated by commas.
pub fn grouped(digits: &str) -> String {
    let mut out = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}
