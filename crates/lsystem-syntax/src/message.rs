//! The words of all diagnostics, in one place.

use crate::curve::MOST_POINTS;
use crate::{Diagnostic, Expected, Function, JsonError, Kind, MOST_SIDES, Role, SurfaceProblem, TikzObstacle};
use lsystem_base::number::number;
pub use lsystem_base::words::grouped;
use lsystem_base::words::said;
use lsystem_base::{LimitName, MAX_PALETTE, MAX_SURFACE_PATCHES, MAX_SURFACES, counted, say, word};

impl Diagnostic {
    /// The problem, as one sentence.
    #[must_use]
    pub fn message(&self) -> String {
        words(&self.kind).0
    }

    /// A remedy, as one sentence; `None` if there is no hint.
    #[must_use]
    pub fn hint(&self) -> Option<String> {
        words(&self.kind).1
    }
}

/// The thing that TikZ's library lacks, after "has no".
fn missing_in_tikz(obstacle: TikzObstacle) -> String {
    match obstacle {
        TikzObstacle::Random => say!("seeded random choices"),
        TikzObstacle::Contexts => say!("contexts"),
        TikzObstacle::Parameters => say!("parameters and conditions"),
        TikzObstacle::Images => say!("rules for drawing"),
        TikzObstacle::Symbol(symbol) => say!("symbol `{}`", symbol),
        TikzObstacle::Action(symbol) => say!("action for what `{}` does", symbol),
        TikzObstacle::Branches => say!("brackets across rules"),
        TikzObstacle::Nesting => say!("room for so many branches in branches"),
        TikzObstacle::Colours => say!("colours within one drawing"),
        TikzObstacle::Levels => say!("widths or lengths by branch level"),
        TikzObstacle::Tropism => say!("tropism and sway"),
        TikzObstacle::Growth => say!("partly grown steps"),
    }
}

/// The hint for marks without a meaning.
const CUSTOM: &str = word!("A custom symbol of one character can mean this, as in `K: turn left 90, draw 5`.");

/// The message and the hint of a diagnostic.
fn words(kind: &Kind) -> (String, Option<String>) {
    let plain = |text: String| (text, None);
    let hinted = |text: String, hint: String| (text, Some(hint));
    match kind {
        Kind::Limit { limit, value, largest } => {
            let mebibytes = grouped(&(value >> 20).to_string());
            let value = grouped(&value.to_string());
            let text = match limit {
                LimitName::Modules => say!("A generation would have more than {} modules", value),
                LimitName::Symbols => say!("The string would be longer than {} symbols", value),
                LimitName::Segments => say!("The drawing would have more than {} segments", value),
                LimitName::Work => say!("Deriving it would pass through more than {} symbols", value),
                LimitName::PlotStrokes => say!("The plot would have more than {} strokes", value),
                LimitName::PlotBlocks => say!("The plot would be made of more than {} parts of the drawing", value),
                LimitName::Mesh => say!("The mesh would have more than {} segments and vertices of polygons", value),
                LimitName::MeshCopies => {
                    say!("Viewers would draw more than {} segments and vertices of polygons", value)
                }
                LimitName::Memory => say!("The drawing would take more than {} MiB of memory", mebibytes),
                LimitName::Iterations => say!("There can be at most {} iterations", value),
                LimitName::Text => say!("The text is longer than {} bytes", value),
                LimitName::Letters => say!("There can be at most {} different symbols", value),
                LimitName::Parameters => say!("A module can have at most {} parameters", value),
                LimitName::Context => say!("A context can have at most {} modules", value),
                LimitName::Actions => say!("A symbol can have at most {} actions", value),
            };
            let hint = match limit {
                LimitName::PlotStrokes | LimitName::PlotBlocks => {
                    Some(say!("A broader pen, a smaller sheet or fewer iterations make fewer."))
                }
                LimitName::Mesh | LimitName::MeshCopies => {
                    Some(say!("Fewer iterations or a larger finest part make fewer."))
                }
                _ => largest.map(|n| say!("Up to {} iterations fit.", n)),
            };
            (text, hint)
        }
        Kind::NotText { line } => plain(say!("Line {} is not UTF-8 text", line)),
        Kind::NoSystem { picture } => hinted(
            say!("This {} holds no L-system", picture),
            say!("Only {} files that were saved here carry the system they show.", picture),
        ),
        Kind::Instances { count } => hinted(
            say!("This file may open slowly ({} shapes)", grouped(&count.to_string())),
            say!("Fewer iterations or a smaller size make fewer."),
        ),
        Kind::CoveringInk => hinted(
            say!("This format has no additive blending: strokes cover each other in the file"),
            say!("PNG keeps the blending."),
        ),
        Kind::NotInTikz { obstacle } => hinted(
            say!("TikZ's library lindenmayersystems has no {}", missing_in_tikz(*obstacle)),
            say!("The TikZ picture holds any drawing, as paths."),
        ),
        Kind::More { left_out } => plain(say!("And {} more", left_out)),

        Kind::LookAlike { found, read_as } if *read_as == ' ' => {
            plain(say!("An invisible character ({}) is read as white space", code(*found)))
        }
        Kind::LookAlike { found, read_as } => hinted(
            say!("`{}` ({}) is read as `{}`", found, code(*found), read_as),
            say!("For the character itself as a symbol write {}.", literal(*found)),
        ),
        Kind::LiteralLength => hinted(
            say!("Backquotes hold exactly one character"),
            say!("Write each symbol in its own backquotes, or by its number, as in `U+0A`."),
        ),
        Kind::LiteralUnclosed => hinted(
            say!("This backquote is never closed"),
            say!("Backquotes make one character a symbol: `:`. The backquote itself is ```."),
        ),
        Kind::ParenthesisUnclosed => {
            hinted(say!("This `(` is never closed"), say!("Add `)`, or write `(` in backquotes to use it as a symbol."))
        }
        Kind::ParenthesisSymbol { symbol } => hinted(
            say!("`{}` is read as a symbol here", symbol),
            say!(
                "Arguments follow their symbol without a space; write the parenthesis in backquotes if a symbol is meant."
            ),
        ),

        Kind::ParenthesesEmpty => {
            hinted(say!("There is nothing between these parentheses"), say!("Leave them out, or write arguments."))
        }
        Kind::NoArrow { suggestion } => hinted(
            say!("This line is neither a rule nor a constant"),
            match suggestion {
                Some(production) => say!("Write `{}`.", production),
                None => say!("Write a rule as `F -> FF`, a constant as `r = 0.9`, a comment after `//`."),
            },
        ),
        Kind::EqualsForArrow { left, right } => hinted(
            say!("`=` gives a constant its value, and `{}` is not a number", right),
            say!("For a rule write `{} -> {}`.", left, right),
        ),
        Kind::OtherField { word } => hinted(
            say!("`{}` does not belong among the rules", word),
            match word.as_str() {
                "endlsystem" | "lsystem" | "seed" => say!("Leave this line out."),
                "axiom" | "initial" | "start" | "omega" | "ω" => say!("The axiom has a field of its own."),
                "angle" | "delta" | "δ" => say!("The angle has a field of its own."),
                _ => say!("The axiom, the angle and the number of iterations have fields of their own."),
            },
        ),
        Kind::NoPredecessor => hinted(
            say!("There is no symbol before the arrow"),
            say!(
                "Write the symbol to be replaced first, as in `F -> FF`; `<`, `>`, `:` and a `-` right before the arrow need \
             backquotes or a space."
            ),
        ),
        Kind::LongPredecessor { text } => hinted(
            say!("A rule replaces one symbol, not `{}`", text),
            match text.chars().next() {
                Some(first) if first.is_alphabetic() => {
                    say!("Write one rule for each symbol, as in `{} -> ...`.", first)
                }
                _ => say!("Write one rule for each symbol, without quotes, bullets or numbers."),
            },
        ),
        Kind::ParameterName { text } => hinted(
            say!("`{}` cannot be the name of a parameter", text),
            match text.chars().next() {
                Some(first) if first.is_alphabetic() => {
                    say!("Before the arrow parentheses hold names only, as in `A(l, w)`; compute after the arrow.")
                }
                Some(_) => say!("Write a name and a condition, as in `A(x) : x == {} -> ...`.", text),
                None => say!("Write a name, as in `A(l, w)`."),
            },
        ),
        Kind::ParameterTwice { name } => hinted(
            say!("Two parameters are called `{}`", name),
            say!("Give them different names; compare them in a condition, as in `: {} == {}1`.", name, name),
        ),
        Kind::ContextOrder => hinted(
            say!("A rule has one left and one right context at most"),
            say!("Write it as `A < B > C -> D`; conditions come after `:`, and the symbols `<` and `>` in backquotes."),
        ),
        Kind::ContextMissing { mark } => hinted(
            match mark {
                '<' => say!("There is no context before `<`"),
                _ => say!("There is no context after `{}`", mark),
            },
            say!("Write `*` for any context, or leave `{}` out.", mark),
        ),
        Kind::ContextForCondition => hinted(
            say!("This is read as a context, not as a comparison"),
            say!(
                "Conditions come after `:`, as in `A(x) : x < 3 -> B`; write the digits in backquotes if they are symbols."
            ),
        ),
        Kind::ConditionBehind => hinted(
            say!("`if` and what follows are read as symbols"),
            say!("A condition stands before the arrow, as in `A(x) : x < 3 -> B`."),
        ),
        Kind::CommentBehind => hinted(
            say!("This comment is read as symbols"),
            say!("A comment needs a line of its own, or stands between `/*` and `*/`."),
        ),
        Kind::CommentUnclosed => hinted(say!("This comment is never closed"), say!("Add `*/`.")),
        Kind::Quotes { inside } => {
            hinted(say!("These quotes are read as symbols"), say!("Strings need no quotes: write `{}`.", inside))
        }
        Kind::CommaBehind => hinted(say!("This comma is read as a symbol"), say!("Lines need no comma at the end.")),
        Kind::DigitsBehind { symbol, digits } => hinted(
            say!("The digits after {} are read as symbols", named(*symbol)),
            match symbol {
                '@' | '~' | '?' => said(CUSTOM),
                _ => say!("A number stands in parentheses, as in `{}({})`.", symbol, digits),
            },
        ),
        Kind::TwoCharacters { second } => hinted(say!("`@{}` is read as two symbols", second), said(CUSTOM)),
        Kind::ParenthesesForBranch { inside } => hinted(
            say!("Parentheses hold numbers, not symbols"),
            say!("A branch stands in brackets: write `[{}]`.", inside),
        ),
        Kind::WeightOfSymbols => hinted(
            say!("This number is read as symbols"),
            say!("A weight stands at the end of the line, as in `F -> FF : 0.5`."),
        ),
        Kind::ContextBracketLeft => hinted(
            say!("A left context has no brackets: it is read along the way to the root"),
            say!("Leave out finished branches and the `[` of the branch itself."),
        ),
        Kind::ContextBracket => hinted(
            say!("Brackets in a right context come in pairs and have no parameters"),
            say!("Write a branch as in `B > C[D]E`."),
        ),
        Kind::ContextUnseen { symbol } => hinted(
            say!("Contexts do not see {}, so this rule never applies", named(*symbol)),
            say!("Take it out of the context, or change `ignore:` or `consider:`."),
        ),
        Kind::DrawContext => hinted(
            say!("Rules below `draw:` have no contexts"),
            say!("Let a rule above `draw:` make another symbol there, and draw that."),
        ),
        Kind::IgnoreAndConsider => hinted(
            say!("There is `ignore:` as well as `consider:`"),
            say!("Keep one of them: `ignore:` lists what contexts skip, `consider:` all that they see."),
        ),
        Kind::ArrowForComparison => hinted(say!("This is read as an arrow"), say!("For at least write `>=`.")),
        Kind::SecondArrow => {
            hinted(say!("There is a second arrow in this line"), say!("Write each rule on a line of its own."))
        }
        Kind::ArrowInAxiom => {
            hinted(say!("There is an arrow in the axiom"), say!("Rules belong below the axiom, not in it."))
        }
        Kind::NeverApplies { symbol, conditional } => hinted(
            say!("This rule never applies: there is one for {} above", named(*symbol)),
            if *conditional {
                say!("Move it above the one without a condition.")
            } else {
                say!("Give both a weight to choose between them at random, as in `F -> FF : 0.5`.")
            },
        ),
        Kind::MixedWeights { symbol, weighted } => hinted(
            if *weighted {
                say!("This rule never applies: the first one for {} has a weight", named(*symbol))
            } else {
                say!("This rule never applies: the first one for {} has no weight", named(*symbol))
            },
            say!("Give all rules for {} a weight, or none.", named(*symbol)),
        ),

        Kind::WeightRange { value } => hinted(
            say!("{} cannot be a weight", number(*value)),
            say!("A weight is a number above zero, from 1e-100 to 1e100."),
        ),
        Kind::NumberExpected => plain(say!("A number is missing here")),
        Kind::NumberMalformed { text } => {
            hinted(say!("`{}` is not a number", text), say!("Write numbers as 2, 0.5 or 1e-3."))
        }
        Kind::NumberRange { text } => {
            hinted(say!("`{}` is too large a number", text), say!("Numbers can be up to 1e308."))
        }
        Kind::ArithmeticUnexpected { found, role } => hinted(
            say!("{} has no place in arithmetic", named(*found)),
            match found {
                ')' => say!("Nothing is open there: leave it out, or add `(`."),
                '&' if *role == Role::Condition => say!("Where both must hold write `&&` or `and`."),
                '|' if *role == Role::Condition => say!("Where one of both is enough write `||` or `or`."),
                ',' if *role == Role::Condition => {
                    say!("Where both must hold write `&&` or `and`; write decimals with a point, as in 0.33.")
                }
                letter if *role == Role::Condition && letter.is_alphabetic() => {
                    say!("Conditions are joined by `and`, `or` and `not` in small letters, or by `&&`, `||` and `!`.")
                }
                ',' if *role == Role::Weight => {
                    say!("Each outcome has a line of its own, as in `F -> FF : 0.33`; write decimals with a point.")
                }
                ',' => say!("Write decimals with a point, as in 0.33."),
                '#' => say!("A comment needs a line of its own."),
                '%' => say!("Write percentages as fractions, as in 0.33."),
                '[' | ']' | '{' | '}' => say!("Group with parentheses."),
                _ => match role {
                    Role::Weight => say!("The weight starts after the last `:`; write the symbol `:` in backquotes."),
                    Role::Constant => say!("A value is made of numbers, constants, functions and + - * / % ^ ( )."),
                    Role::Argument | Role::Axiom => {
                        say!("Write products with `*`, as in `2*x`, and separate arguments by commas.")
                    }
                    Role::Condition => say!("A condition compares values, as in `x > 1 && y <= 2`."),
                },
            },
        ),
        Kind::ArithmeticUnclosed => hinted(say!("This `(` is never closed"), say!("Add `)`.")),
        Kind::ArithmeticDepth => hinted(
            say!("The arithmetic is too long or nested too deeply"),
            say!("Name a part of it, as in `r = 0.9 * 0.7`."),
        ),
        Kind::ArithmeticRange => {
            hinted(say!("The result is not a finite number"), say!("Is something divided by zero?"))
        }
        Kind::UnknownConstant { name, similar, below, role } => hinted(
            match role {
                Role::Constant | Role::Weight | Role::Axiom => {
                    if *below {
                        say!("There is no constant `{}` above this line", name)
                    } else {
                        say!("There is no constant `{}`", name)
                    }
                }
                Role::Condition | Role::Argument => say!("There is no parameter or constant `{}`", name),
            },
            match (similar, role) {
                _ if *below => say!("Move the definition of `{}` up.", name),
                (_, Role::Condition) if name == "if" => {
                    say!("A condition needs no `if`: write it right after the colon, as in `A(x) : x < 3 -> B`.")
                }
                (_, Role::Condition) if name == "true" => say!("Leave out a condition that always holds."),
                _ if matches!(name.as_str(), "pi" | "PI" | "Pi" | "π") => {
                    say!("Define it, as in `{} = 3.14159265`; angles are in degrees.", name)
                }
                (Some(similar), _) => say!("Did you mean `{}`?", similar),
                (None, Role::Weight) => {
                    say!("Define it, as in `{} = 0.5`, or write the symbol `:` in backquotes.", name)
                }
                (None, Role::Constant) => say!("Define it above, as in `{} = 0.5`.", name),
                (None, Role::Axiom) => say!("Define it in the rules, as in `{} = 0.5`.", name),
                (None, Role::Condition | Role::Argument) => {
                    say!("Give it to the predecessor, as in `A({})`, or define it, as in `{} = 0.5`.", name, name)
                }
            },
        ),
        Kind::UnknownFunction { name, similar } => hinted(
            say!("There is no function `{}`", name),
            match similar {
                _ if matches!(name.as_str(), "pow" | "power") => say!("For a power write `x^y`."),
                _ if matches!(name.as_str(), "mod" | "fmod") => say!("For a remainder write `x % y`."),
                _ if matches!(name.as_str(), "log" | "log10") => say!("The natural logarithm is `ln(x)`."),
                _ if matches!(name.as_str(), "rand" | "rnd") => {
                    say!("A random number between two others is `random(0, 1)`.")
                }
                _ if matches!(name.as_str(), "round" | "int" | "trunc") => say!("To round write `floor(x + 0.5)`."),
                Some(similar) => say!("Did you mean `{}`?", similar),
                None => {
                    let names: Vec<&str> = Function::ALL.iter().map(|f| f.name()).collect();
                    say!("The functions are {}.", names.join(", "))
                }
            },
        ),
        Kind::NotAFunction { name } => {
            hinted(say!("`{}` is not a function", name), say!("For a product write `{}*(...)`.", name))
        }
        Kind::FunctionBare { name } => {
            hinted(say!("`{}` needs its argument in parentheses", name), say!("Write it as in `{}(30)`.", name))
        }
        Kind::FunctionArity { function, expected, found } => hinted(
            say!("`{}` takes {}, not {}", function.name(), counted!(*expected, "{} argument", "{} arguments"), found),
            match function {
                Function::Random => say!("`random(a, b)` is a number from a up to b."),
                Function::NormalRandom => say!("`nran(m, s)` has the mean m and the standard deviation s."),
                Function::Atan2 => say!("`atan2(y, x)` is the angle of the point (x, y)."),
                Function::Inside | Function::Distance => {
                    say!("Write it as in `{}(crown, x, y, z)`.", function.name())
                }
                _ if *expected == 2 => say!("Write it as in `{}(a, b)`.", function.name()),
                _ => say!("Write it as in `{}(a)`.", function.name()),
            },
        ),
        Kind::ShapeExpected { found } => hinted(
            if found.is_empty() {
                say!("The name of a shape is missing")
            } else {
                say!("`{}` is not the name of a shape", found)
            },
            say!("Define one in a line above, as in `shape crown = ball(0, 10, 0, 5)`."),
        ),
        Kind::ShapeUnused { name } => {
            hinted(say!("Nothing uses the shape `{}`", name), say!("Use it as in `inside({}, x, y, z)`.", name))
        }
        Kind::CurveUnused { name } => {
            hinted(say!("Nothing uses the curve `{}`", name), say!("Use it as in `{}(x)`.", name))
        }
        Kind::CurvePoint { found } => hinted(
            say!("`{}` is not a point of a curve", found),
            say!("Write each point with x and y, as in `(0, 1) (0.5, 2)`."),
        ),
        Kind::CurveBack => hinted(
            say!("This point lies to the left of the point before it"),
            say!("x must not decrease along a curve."),
        ),
        Kind::CurveCount { found } => hinted(
            counted!(*found, "This curve has {} point", "This curve has {} points"),
            say!("A curve has 2 to {} points, and the last is to the right of the first.", MOST_POINTS),
        ),
        Kind::SolidExpected { found } => hinted(
            if found.is_empty() {
                say!("A solid is missing")
            } else {
                say!("`{}` is not a solid with its numbers", found)
            },
            say!("Solids are ball(x, y, z, r), box, cylinder, cone, half, outline and mesh, joined by +, - or &."),
        ),
        Kind::SolidNumbers { name, expected, found } => hinted(
            match expected {
                Some(expected) => {
                    say!("`{}` takes {}, not {}", name, counted!(*expected, "{} number", "{} numbers"), found)
                }
                None if *name == "mesh" => say!("`mesh` takes nine numbers for each of 4 to {} triangles", MOST_SIDES),
                None => say!("`{}` takes two numbers for each of 3 to {} corners", name, MOST_SIDES),
            },
            match *name {
                "ball" => say!("`ball(x, y, z, r)` has a centre and a radius."),
                "box" => say!("`box(x, y, z, x, y, z)` has two opposite corners."),
                "cylinder" | "cone" => say!("`{}(x, y, z, x, y, z, r)` has two ends and a radius.", name),
                "half" => say!("`half(x, y, z, a, b, c)` has a point of its plane, and a direction out of it."),
                "mesh" => say!("`mesh(x, y, z, x, y, z, x, y, z, ...)` has the corners of its triangles."),
                _ => say!("`outline(x, y, x, y, x, y)` has its corners in order."),
            },
        ),
        Kind::ComparisonChain => {
            hinted(say!("Comparisons cannot be chained"), say!("Write them one by one, as in `0 < x && x < 5`."))
        }
        Kind::WeightCondition => hinted(
            say!("This compares values, and a weight is a number"),
            say!("Conditions come before the arrow, as in `A(x) : x > 1 -> B`."),
        ),
        Kind::ConditionConstant { holds } => hinted(
            if *holds { say!("This condition is always true") } else { say!("This condition is always false") },
            say!("A weight stands at the end of the line, as in `F -> FF : 0.5`."),
        ),
        Kind::ConstantRandom => hinted(
            say!("A constant has the same value everywhere, so it cannot be random"),
            say!("Use `random` in the arguments of a rule."),
        ),
        Kind::ConstantName { text } if text.is_empty() => {
            hinted(say!("The constant has no name"), say!("Write it as `r = 0.9`."))
        }
        Kind::ConstantName { text } => hinted(
            say!("`{}` cannot be the name of a constant", text),
            say!("A name is a letter followed by letters, digits or `_`; a rule needs an arrow, as in `F -> FF`."),
        ),
        Kind::ConstantTwice { name } => {
            hinted(say!("`{}` is defined already", name), say!("Give one of them another name."))
        }
        Kind::ConstantUnused { name, value } => hinted(
            say!("Nothing uses the constant `{}`", name),
            if matches!(name.as_str(), "angle" | "delta" | "δ" | "n" | "iterations" | "depth" | "generations" | "order")
            {
                say!("The angle and the number of iterations have fields of their own.")
            } else if name.chars().nth(1).is_none() {
                say!("If a rule is meant, write `{} -> {}`.", name, value)
            } else {
                say!("Use it in a rule, or remove it.")
            },
        ),

        Kind::OverrideColon { suggestion } => hinted(
            say!("There is no `:` after the symbol"),
            say!("Write `{}`.", suggestion.as_deref().unwrap_or("G: move")),
        ),
        Kind::OverrideSymbol { text } if text.is_empty() => {
            hinted(say!("There is no symbol before the `:`"), say!("Write one, as in `G: move`."))
        }
        Kind::OverrideSymbol { text } => {
            hinted(say!("`{}` is not one symbol", text), say!("Give each symbol a line of its own, as in `G: move`."))
        }
        Kind::OverrideTwice { symbol } => plain(say!("This replaces the line for {} above", named(*symbol))),
        Kind::UnknownAction { text, similar } => hinted(
            if text.is_empty() { say!("An action is missing here") } else { say!("`{}` is not an action", text) },
            match similar {
                Some(similar) => say!("Did you mean `{}`?", similar),
                None => say!(
                    "Actions are draw, move, draw unmarked, move unmarked, turn left, turn right, turn round, pitch \
                         down, pitch up, roll left, roll right, roll upright, open branch, close branch, cut branch, \
                         open polygon, vertex, close polygon, open tube, tube point, close tube, colour 2, next colour, previous colour, width 2, width \
                         times 0.5, thicker, thinner, length times 0.5, swap turns, circle, disc, leaf lance, leaf heart, \
                         leaf oak, leaf needle, leaf petal, surface l, nothing."
                ),
            },
        ),
        Kind::NothingElse => {
            hinted(say!("`nothing` stands together with other actions"), say!("Leave `nothing` out, or the others."))
        }
        Kind::ActionNumber { expected: Expected::Nothing } => plain(say!("This action takes no number")),
        Kind::ActionNumber { expected } => plain(say!("This action needs {}", expected_words(*expected))),

        Kind::EmptyAxiom => hinted(
            say!("The axiom is empty, so there is nothing to derive"),
            say!("Write the symbols to start from, as in `F`."),
        ),
        Kind::UnmatchedClose { symbol } => hinted(
            say!("This {} closes no branch and is ignored in the drawing", named(*symbol)),
            say!("Remove it, or open the branch before it."),
        ),
        Kind::UnmatchedOpen { symbol } => {
            hinted(say!("This {} is never closed", named(*symbol)), say!("Close the branch where it ends."))
        }
        Kind::ArrowOfSymbols => {
            hinted(say!("This arrow is read as two symbols"), say!("Write each rule on a line of its own."))
        }
        Kind::NeverOccurs { symbol } => hinted(
            say!("{} never occurs, so this rule never applies", named(*symbol)),
            say!("Use the symbol in the axiom or in a rule that applies, or remove this one."),
        ),
        Kind::OtherArity { symbol, parameters, found } => hinted(
            say!(
                "This rule never applies: {} occurs with {} only",
                named(*symbol),
                if *found == 0 { say!("no parameters") } else { arguments_of(*found) }
            ),
            say!("A symbol with {} is another letter: give it as many everywhere.", arguments_of(*parameters)),
        ),
        Kind::NoRuleForArity { symbol, parameters, found } => hinted(
            say!(
                "No rule applies to this: those for {} have {}",
                named(*symbol),
                if *found == 0 { say!("no parameters") } else { arguments_of(*found) }
            ),
            match parameters {
                2 => say!("Write decimals with a point, as in A(0.5); a comma separates arguments."),
                _ => say!("A symbol with another number of parameters is another letter."),
            },
        ),
        Kind::NotFinite { step } => hinted(
            match step {
                0 => say!("An argument of the axiom is not a finite number"),
                _ => say!("An argument that this rule computes in step {} is not a finite number", step),
            },
            say!("Is something divided by zero, or does it grow without end? A condition can stop it."),
        ),
        Kind::NoCloseup => hinted(
            say!("This drawing cannot be seen from near that segment"),
            say!("Segments are counted from 0. The system must be in the plane, without chance, contexts and tropism."),
        ),
        Kind::Surface { line, problem } => hinted(
            say!("Line {} of the surfaces: {}", line, surface_words(*problem)),
            say!("A surface is a letter, a colon, and 48 numbers for each patch."),
        ),
        Kind::UnknownSurface { name } => {
            hinted(say!("There is no surface `{}`", name), say!("Add the line of `{}` to the surfaces.", name))
        }
        Kind::Range { label, expected } => plain(say!("{} must be {}", said(label), expected_words(*expected))),

        Kind::Json(error) => json(*error),
        Kind::WrongType { key, expected, found } if key.is_empty() => {
            plain(say!("The file must hold {}, not {}", expected_words(*expected), said(found)))
        }
        Kind::WrongType { key, expected, found } => {
            plain(say!("`{}` must be {}, not {}", key, expected_words(*expected), said(found)))
        }
        Kind::WrongValue { key, expected } => plain(say!("`{}` must be {}", key, expected_words(*expected))),
        Kind::UnknownKey { key, similar } => {
            (say!("Unknown key `{}`", key), similar.map(|s| say!("Did you mean `{}`?", s)))
        }
        Kind::DuplicateKey { key } => plain(say!("`{}` stands here a second time; this one counts", key)),
        Kind::MissingKey { key } => {
            hinted(say!("`{}` is missing", key), say!("An outcome is written as {{\"p\": 0.5, \"e\": \"F+F\"}}."))
        }
        Kind::RuleKey { key } if key.is_empty() => plain(say!("The key is empty; it must be one symbol")),
        Kind::RuleKey { key } => plain(say!("`{}` must be one symbol", key)),
        Kind::SpaceSymbol => hinted(
            say!("White space is a symbol here"),
            say!("In this form of rules each character is a symbol; remove the space if it is not meant."),
        ),
        Kind::ProbabilitySum { sum } => hinted(
            say!("The probabilities sum to {}, not to 1", rounded(*sum)),
            say!("They are read as weights: each is divided by the sum."),
        ),
        Kind::NoOutcome => hinted(
            say!("None of these outcomes can happen"),
            say!("Write a string, or outcomes as {{\"p\": 0.5, \"e\": \"F+F\"}}."),
        ),
        Kind::ProbabilityZero => plain(say!("An outcome with probability 0 never happens")),
    }
}

/// What is wrong with a line of surfaces.
fn surface_words(problem: SurfaceProblem) -> String {
    match problem {
        SurfaceProblem::Name => say!("it does not begin with a letter and a colon"),
        SurfaceProblem::Twice(name) => say!("the surface `{}` stands twice", name),
        SurfaceProblem::Number => say!("a word is no number between -1,000,000 and 1,000,000"),
        SurfaceProblem::Count(found) => say!("{} numbers are no multiple of 48", found),
        SurfaceProblem::Patches => say!("a surface has at most {} patches", MAX_SURFACE_PATCHES),
        SurfaceProblem::Surfaces => say!("a system has at most {} surfaces", MAX_SURFACES),
    }
}

fn json(error: JsonError) -> (String, Option<String>) {
    let hint = |text: &str| Some(said(text));
    match error {
        JsonError::Empty => {
            (say!("The file holds nothing"), hint(word!("It must hold an object: {\"initial\": \"F\"}.")))
        }
        JsonError::NoSystem => (
            say!("This is no L-system: it has neither an axiom nor rules"),
            hint(word!("A system has the keys `initial` and `rules`.")),
        ),
        JsonError::Unexpected => {
            (say!("This has no place in JSON"), hint(word!("Is a quote or a comma missing before it?")))
        }
        JsonError::UnclosedString => (say!("This string is never closed"), hint(word!("Add the closing quote."))),
        JsonError::UnclosedComment => (say!("This comment is never closed"), hint(word!("Add `*/`."))),
        JsonError::UnclosedObject => (say!("This object is never closed"), hint(word!("Add `}`."))),
        JsonError::UnclosedArray => (say!("This list is never closed"), hint(word!("Add `]`."))),
        JsonError::MissingComma => (say!("A comma is missing"), None),
        JsonError::MissingColon => (say!("A colon is missing after the key"), None),
        JsonError::Escape => {
            (say!("This escape is not known"), hint(word!("A backslash in a string is written twice: \"\\\\\".")))
        }
        JsonError::Number => (say!("This is not a number"), None),
        JsonError::Depth => (say!("The file is nested too deeply"), None),
    }
}

/// The expected type and range of a value, as a noun phrase.
pub fn expected_words(expected: Expected) -> String {
    match expected {
        Expected::Nothing => say!("nothing"),
        Expected::Number => say!("a number"),
        Expected::Between(least, most) => say!("a number from {} to {}", bound(least), bound(most)),
        Expected::PositiveUpTo(most) => say!("a number above 0, at most {}", bound(most)),
        Expected::Whole(least, most) => {
            say!("a whole number from {} to {}", bound(least as f64), bound(most as f64))
        }
        Expected::Boolean => say!("true or false"),
        Expected::String => say!("a string"),
        Expected::Text(most) => say!("a text of at most {} characters", bound(most as f64)),
        Expected::Word(words) => {
            let words: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
            say!("one of {}", words.join(", "))
        }
        Expected::Object => say!("an object"),
        Expected::Each(count, each) => say!("a list of {} values, each {}", count, expected_words(*each)),
        Expected::Record(members) => {
            let members: Vec<&str> = members.iter().map(|(name, _)| *name).collect();
            say!("an object of {}", members.join(", "))
        }
        Expected::Rules | Expected::Overrides => say!("an object or a list of lines"),
        Expected::Successor => say!("a string or a list of outcomes"),
        Expected::Outcome => say!("an outcome {{\"p\": 0.5, \"e\": \"F+F\"}}"),
        Expected::Colour => say!("a colour such as \"#1f5c3a\""),
        Expected::Palette => say!("a list of 1 to {} colours such as \"#1f5c3a\"", MAX_PALETTE),
    }
}

/// A bound of a range; whole numbers with their digits in groups of three.
fn bound(value: f64) -> String {
    let digits = number(value.abs());
    let digits = if digits.bytes().all(|byte| byte.is_ascii_digit()) { grouped(&digits) } else { digits };
    if value < 0.0 { format!("-{digits}") } else { digits }
}

fn arguments_of(count: usize) -> String {
    counted!(count, "{} parameter", "{} parameters")
}

/// A symbol as shown in a sentence.
fn named(symbol: char) -> String {
    match symbol {
        ' ' => say!("The space"),
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
