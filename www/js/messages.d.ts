// The messages between JavaScript and Rust: written by `cargo xtask tables` from the types in Rust, not by hand.

/**
 * The exercise of a class, as a page shows it.
 */
export type AboutClass = { title: string, 
/**
 * The exercise, if it asks for programs, which the page runs; else empty.
 */
program: string, 
/**
 * The number of answers.
 */
answers: number, 
/**
 * The number of variants, with the target.
 */
variants: number, };

/**
 * The part of an exercise that a student sees.
 */
export type AboutExercise = { title: string, task: string, hints: Array<string>, asks: Asks, 
/**
 * The functions to write.
 */
program: string, 
/**
 * The number of variants besides the target: each student gets one.
 */
variants: number, axiom: Given, angle: Given, n: Given, turtle: Given, 
/**
 * Whether some rules count that the student does not see.
 */
hidesRules: boolean, asksForRules: boolean, shownRules: string, mostSymbols: number | null, tolerance: number | null, 
/**
 * The beginning of the string to derive, if the string is asked for.
 */
text: string | null, 
/**
 * The system with which the student starts.
 */
start: import('./tables.js').Definition, 
/**
 * The system without anything that the student found, and the fields, besides the rules, that the student has to
 * find. With them and the student's rules before the others, the system is whole. Its style is that in which the
 * target is shown.
 */
fixed: import('./tables.js').Definition, free: (keyof import('./tables.js').Definition)[], };

/**
 * One link of the chain from the axiom to a symbol.
 */
export type AncestryLink = { 
/**
 * The generation of the symbol.
 */
generation: number, 
/**
 * The symbol, with its arguments in parentheses, if any.
 */
symbol: string, 
/**
 * The position of the symbol in its generation.
 */
index: string, 
/**
 * The production that made the symbol; null if the symbol was copied or stands in the axiom.
 */
production: number | null, 
/**
 * The position in the successor, or in the axiom.
 */
position: number, };

/**
 * A place on a segment as the origin of views.
 */
export type Anchor = { 
/**
 * The segment's number, from 1, and decimals for the part of the segment before the place.
 */
at: string, 
/**
 * The place, from the origin of the present view.
 */
place: Array<number>, };

/**
 * The property in which an answer must equal the target.
 */
export type Asks = "picture" | "text" | "segments" | "statistics" | "program";

/**
 * A system that was found, or that comes close.
 */
export type Candidate = { definition: import('./tables.js').Definition, 
/**
 * The name, if it is one of the systems with names that the search was given.
 */
name: string | null, 
/**
 * Two candidates with equal keys are the same system.
 */
key: string, 
/**
 * The symbols of its rules, with their predecessors.
 */
symbols: number, 
/**
 * The rank among systems that agree as well, smallest first.
 */
rank: number, 
/**
 * From 0 to 1; 1 only for the same picture.
 */
agreement: number, isFound: boolean, };

/**
 * The result of a comparison.
 */
export type CheckReport = { isRight: boolean, 
/**
 * The result in words: a sentence, and lines that show the difference.
 */
words: string, 
/**
 * The place of the first symbol that differs, or that draws the first segment that differs: decimal digits.
 */
symbol: string | null, };

/**
 * The fields of a style that an automatic look chooses.
 */
export type ChosenLook = { 
/**
 * The choice in words.
 */
words: string, colourBy: string, paletteHolds: boolean, width: number, widthFactor: number, minWidth: number, maxWidth: number, };

/**
 * A named constant and the place of its value in the rules, in UTF-16 units.
 */
export type ConstantSpan = { 
/**
 * The name.
 */
name: string, 
/**
 * Null if the value is not valid.
 */
value: number | null, 
/**
 * The start of the value's text.
 */
start: number, 
/**
 * The end of the value's text.
 */
end: number, 
/**
 * Whether the value is one number, so that another number may replace it.
 */
number: boolean, };

/**
 * A number of any size.
 */
export type Count = { 
/**
 * Exact, in decimal digits; with chance, the expected value, rounded.
 */
digits: string, 
/**
 * The logarithm to base 10, for plots; null for 0.
 */
log10: number | null, };

/**
 * The descendants of a symbol in a later generation, as half-open ranges.
 */
export type Descendants = { 
/**
 * The positions of the symbols.
 */
symbols: [string, string], 
/**
 * The numbers of the segments.
 */
segments: [string, string], 
/**
 * In the plane the corners of a convex outline of the segments; in space the ends of a single segment.
 */
outline: Array<Array<number>>, };

/**
 * A heading.
 */
export type Direction = number | [number, number, number];

/**
 * The picture on the canvas.
 */
export type Drawn = { 
/**
 * Whether no finer picture follows.
 */
complete: boolean, 
/**
 * Device pixels per fitted extent at zoom 1.
 */
scale: number, 
/**
 * Whether the picture is the first one of a new view in space, made fast because the view is probably moving.
 */
moving: boolean, 
/**
 * Whether the picture is complete but not exact, because an exact one would take too long.
 */
rough: boolean, 
/**
 * Whether the picture is in space and took so long that mates would help.
 */
slow: boolean, 
/**
 * The one thing in a complete picture of a single colour.
 */
only: Only | null, 
/**
 * The turtle after the last shown segment; null if all segments are shown.
 */
pose: Pose | null, };

/**
 * An exercise.
 */
export type Exercise = { 
/**
 * The title.
 */
title: string, 
/**
 * The task in words.
 */
task: string, 
/**
 * Hints, shown one by one when the student asks.
 */
hints: Array<string>, 
/**
 * The system to find. Its look is that of the student's drawing, too.
 */
target: import('./tables.js').Definition, 
/**
 * Other targets of equal difficulty, with as many lines of rules: each student gets one of them or the target.
 */
variants: Array<import('./tables.js').Definition>, 
/**
 * The axiom.
 */
axiom: Given, 
/**
 * All angles of turns.
 */
angle: Given, 
/**
 * The derivation steps.
 */
n: Given, 
/**
 * The turtle: what symbols mean, and the heading at the start. Lengths and bending are given, unless the turtle is
 * hidden.
 */
turtle: Given, 
/**
 * Each line of the target's rules. Further lines are free.
 */
rules: Array<Given>, 
/**
 * Where the student starts.
 */
first: First, 
/**
 * The property in which an answer must equal the target.
 */
asks: Asks, 
/**
 * The functions to write, if a program is asked for: a ready-made set, or own ones with examples
 * (`www/js/programs/tasks.js` reads the text).
 */
program: string, 
/**
 * The most symbols that the student's rules may have.
 */
mostSymbols: number | null, 
/**
 * The agreement of the ink that counts as solved, from 0 to 1; `None` if only the same picture counts.
 */
tolerance: number | null, 
/**
 * Whether the target's rules are shown once the exercise is solved.
 */
showsAnswer: boolean, };

/**
 * The report on a finished file.
 */
export type ExportReport = { 
/**
 * Whether the whole file was written: no limit was exceeded, and the definition has no errors.
 */
complete: boolean, diagnostics: Array<Problem>, };

/**
 * A symbol with what it becomes.
 */
export type Family = { 
/**
 * The symbol, with its arguments.
 */
parent: string, 
/**
 * The successor, symbol by symbol.
 */
children: Array<string>, 
/**
 * How many symbols are not listed.
 */
more: string, 
/**
 * The place of the first of them in the next generation, 0-based.
 */
first: string, };

/**
 * The contents of a file.
 */
export type FileRead = { 
/**
 * Null if the file cannot be used.
 */
definition: import('./tables.js').Definition | null, 
/**
 * The problems of the file and of its definition.
 */
diagnostics: Array<Problem>, };

/**
 * The known properties of a system; missing or null ones are unknown.
 */
export type FindQuestion = { axiom: string | null, angle: number | null, heading: number | null, n: number | null, draws: string | null, };

/**
 * The result of a search so far.
 */
export type FindReport = { candidates: Array<Candidate>, searched: string, };

/**
 * The values with which a student starts, where they are free.
 */
export type First = { 
/**
 * The axiom.
 */
axiom: string, 
/**
 * The student's own rules.
 */
rules: string, 
/**
 * The angle of turns, in degrees.
 */
angle: number, 
/**
 * The derivation steps.
 */
n: number, };

/**
 * One generation.
 */
export type Generation = { 
/**
 * The number of steps.
 */
n: number, 
/**
 * All symbols.
 */
symbols: Count, 
/**
 * All segments.
 */
segments: Count, 
/**
 * Each listed letter.
 */
letters: Array<Count>, 
/**
 * With chance, the standard deviation of the number of segments.
 */
spread: number | null, 
/**
 * The width and height of the drawing in the plane, in model units; null where it is too large.
 */
size: [number, number] | null, 
/**
 * The length of all segments, in model units; null where lengths change on the way.
 */
length: number | null, 
/**
 * Without branches, the turning of the whole way in the plane: degrees counter-clockwise, from 0 up to 360.
 */
turning: number | null, };

/**
 * How much of a part of the target a student sees.
 */
export type Given = "shown" | "free" | "hidden";

/**
 * How a system grows.
 */
export type Growth = { 
/**
 * The listed letters, in the order in which the axiom reaches them.
 */
letters: Array<string>, 
/**
 * How many letters there are.
 */
letterCount: number, 
/**
 * Row by row: how many of each listed letter a letter becomes in one step; with chance, the expected numbers.
 */
matrix: Array<Array<number>>, 
/**
 * Whether chance chooses.
 */
isRandom: boolean, 
/**
 * The growth of all symbols.
 */
symbols: Series, 
/**
 * The growth of the segments.
 */
segments: Series, 
/**
 * The factor by which the curve's reach grows in each step, if there is one.
 */
stretch: number | null, 
/**
 * The similarity dimension: the logarithm of the segments' factor over that of the stretch.
 */
dimension: number | null, 
/**
 * The generations from 0 on.
 */
table: Array<Generation>, 
/**
 * The essence in a few sentences.
 */
sentences: Array<string>, };

/**
 * How a number grows in the long run.
 */
export type GrowthKind = "dying" | "bounded" | "polynomial" | "exponential";

export type GrowthReport = { 
/**
 * The growth, or why it is not known.
 */
growth: Growth | null, why: string, csv: string, latex: string, shown: number, };

/**
 * One of these systems.
 */
export type ImportEntry = { name: string, 
/**
 * Null if the system cannot be opened.
 */
definition: import('./tables.js').Definition | null, remarks: Array<ImportRemark>, };

/**
 * A part of the text, and what became of it.
 */
export type ImportPart = { 
/**
 * In UTF-16 units.
 */
length: number, 
/**
 * `passed`, `read`, `noted` or `refused`.
 */
fate: string, 
/**
 * The index of its system; null outside of all systems.
 */
entry: number | null, 
/**
 * What it became, or why it did not.
 */
words: string, };

/**
 * A remark on a part that was not carried over, with its line of the text, 1-based.
 */
export type ImportRemark = { line: number, text: string, message: string, };

/**
 * Systems in the notation of another program or of a paper.
 */
export type ImportReport = { notation: string, entries: Array<ImportEntry>, 
/**
 * The parts of the text in order, without gaps.
 */
account: Array<ImportPart>, };

/**
 * A key.
 */
export type KeyObject = { time: number, value: Array<number>, easing: string, };

/**
 * A symbol in use and its actions.
 */
export type Legend = { 
/**
 * The symbol, with the names of its parameters.
 */
symbol: string, 
/**
 * The turtle's actions, in words.
 */
actions: string, 
/**
 * Whether the turtle does nothing at the symbol.
 */
idle: boolean, 
/**
 * Whether a production replaces the symbol.
 */
rewritten: boolean, };

/**
 * A mark, as the page shows it.
 */
export type MarkReport = { isSolved: boolean, agreement: number, percent: string, isSame: boolean | null, symbols: number, words: string, 
/**
 * The beginning of the answer's string, if the string is asked for and nothing that makes it is hidden.
 */
text: string | null, 
/**
 * The errors of the answer.
 */
errors: Array<string>, };

/**
 * A marked answer, as a table shows it.
 */
export type MarkedAnswer = { name: string, 
/**
 * The name in the link.
 */
by: string, link: string | null, isSolved: boolean, 
/**
 * From 0 to 1.
 */
agreement: number, 
/**
 * Empty if there is nothing to mark.
 */
percent: string, symbols: number | null, 
/**
 * The axiom, if it was to be found, and the rules; only the beginning of long ones.
 */
rules: string, words: string, 
/**
 * From 1.
 */
variant: number, };

/**
 * A change of one field after which a system draws something.
 */
export type Mend = { "iterations": number } | { "dialect": string };

/**
 * A mistake with the numbers of the answers that have it.
 */
export type MistakeReport = { words: string, answers: Array<number>, };

/**
 * The texts as class letters ([`lsystem::syntax::Class`]), one for each UTF-16 unit, and the constants.
 */
export type Notation = { 
/**
 * The classes of the axiom.
 */
axiom: string, 
/**
 * The classes of the rules.
 */
rules: string, 
/**
 * The classes of the custom symbols.
 */
overrides: string, 
/**
 * The named constants of the rules.
 */
constants: Array<ConstantSpan>, };

/**
 * A note of a tune.
 */
export type Note = { 
/**
 * The start, in steps.
 */
start: number, 
/**
 * The length, in steps.
 */
length: number, 
/**
 * The pitch as a key of the MIDI standard: 60 is middle C.
 */
key: number, 
/**
 * The loudness, from 1 to 127.
 */
velocity: number, 
/**
 * The branch, or the branch level.
 */
voice: number, 
/**
 * From left (-1) to right (1).
 */
side: number, 
/**
 * The end of the line, as the page's marks take it; empty for notes in drawing order.
 */
fitted: Array<number>, };

/**
 * The one thing in a picture of a single colour.
 */
export type Only = "background" | "ink";

/**
 * The work spent on a pane.
 */
export type Outcome = { 
/**
 * The units of work.
 */
work: number, 
/**
 * Whether the pane left out detail, because its budget was too small.
 */
poor: boolean, };

/**
 * The mark under the pointer; all null or empty if there is none.
 */
export type Picked = { 
/**
 * The number of the segment, if the mark is a segment.
 */
segment: string | null, 
/**
 * The number of the polygon, if the mark is a polygon.
 */
polygon: string | null, 
/**
 * The position of the symbol that draws the segment or opens the polygon; null if the generation cannot be read.
 */
symbol: string | null, 
/**
 * The chain from the axiom to the symbol.
 */
ancestry: Array<AncestryLink>, 
/**
 * The segment.
 */
stroke: SegmentFacts | null, 
/**
 * The polygon.
 */
filled: PolygonFacts | null, };

/**
 * A polygon.
 */
export type PolygonFacts = { 
/**
 * The vertices.
 */
outline: Array<Array<number>>, 
/**
 * The branch level.
 */
level: number, 
/**
 * The colour index, not wrapped to the palette.
 */
colour: number, };

/**
 * The turtle after the shown segments.
 */
export type Pose = { 
/**
 * Its place, in model units.
 */
at: Array<number>, 
/**
 * Its place.
 */
fitted: Array<number>, 
/**
 * Its heading.
 */
heading: Direction, 
/**
 * The branch level.
 */
level: number, };

/**
 * A preset, as the page asks for it.
 */
export type PresetObject = { "kind": "growth", n: number, } | { "kind": "turtle" } | { "kind": "turntable", azimuth: number, } | { "kind": "sway", strength: number, } | { "kind": "dive", place: Array<number>, space: boolean, };

/**
 * A diagnostic in words, with its place in UTF-16 units.
 */
export type Problem = { 
/**
 * `axiom`, `rules`, `overrides`, `file` or `numbers`.
 */
field: 'axiom' | 'rules' | 'overrides' | 'file' | 'numbers', 
/**
 * `error` or `warning`.
 */
severity: 'error' | 'warning', 
/**
 * The problem, in a sentence.
 */
message: string, 
/**
 * A possible remedy.
 */
hint: string | null, 
/**
 * The text that is probably meant in place of the problem's; empty where that is to be removed.
 */
fix: string | null, 
/**
 * The start of the place in the field.
 */
start: number, 
/**
 * The end of the place in the field.
 */
end: number, };

/**
 * The properties of a definition and its problems. Counts are exact decimal strings, null while unknown.
 */
export type Report = { 
/**
 * Whether the definition has no errors.
 */
ok: boolean, 
/**
 * All errors and warnings, also about limits.
 */
diagnostics: Array<Problem>, 
/**
 * As [`lsystem::drawing::kind`].
 */
kind: string, 
/**
 * Whether the drawing depends on the seed.
 */
stochastic: boolean, 
/**
 * Whether the drawing leaves the plane.
 */
space: boolean, 
/**
 * Whether the drawing has branches, which can sway.
 */
branches: boolean, 
/**
 * Whether the drawing shares its blocks.
 */
memoised: boolean | null, 
/**
 * The number of symbols of the generation.
 */
symbols: string | null, 
/**
 * The number of segments of the drawing.
 */
segments: string | null, 
/**
 * The number of blocks of the drawing.
 */
blocks: number | null, 
/**
 * The width of a drawing in the plane over its height; null for a drawing without a height.
 */
aspect: number | null, 
/**
 * The azimuth, in degrees, from which a drawing in space is seen best.
 */
azimuth: number | null, 
/**
 * The largest number of iterations within the limits, if the drawing exceeds a limit.
 */
largest: number | null, 
/**
 * What an automatic look chose; null without one.
 */
look: ChosenLook | null, 
/**
 * The symbols in use.
 */
legend: Array<Legend>, 
/**
 * The reason why nothing is drawn.
 */
empty: string | null, 
/**
 * The change after which something is drawn, if nothing is.
 */
mend: Mend | null, 
/**
 * The picture's text alternative.
 */
description: string, };

/**
 * Some symbols of a generation, with what they become in the next one.
 */
export type Rows = { 
/**
 * The symbols.
 */
families: Array<Family>, 
/**
 * The place of the first of them, 0-based.
 */
start: string, 
/**
 * The numbers of symbols of this generation and of the next one.
 */
lengths: [string, string], };

/**
 * A script, as the page edits it.
 */
export type ScriptObject = { seconds: number, rate: number, width: number, height: number, ending: string, easing: string, fixed: boolean, frames: number, 
/**
 * The place on a segment that is the origin of views, as in links; empty for the fitted centre.
 */
segment: string, tracks: Array<TrackObject>, };

/**
 * A segment, and the turtle there.
 */
export type SegmentFacts = { 
/**
 * The start, in model units.
 */
from: Array<number>, 
/**
 * The end, in model units.
 */
to: Array<number>, 
/**
 * The start.
 */
fittedFrom: Array<number>, 
/**
 * The end.
 */
fittedTo: Array<number>, 
/**
 * The direction from start to end.
 */
heading: Direction, 
/**
 * The branch level.
 */
level: number, 
/**
 * The colour index, not wrapped to the palette.
 */
colour: number, };

/**
 * The growth of the symbols or of the segments.
 */
export type Series = { 
/**
 * How it grows.
 */
kind: GrowthKind, 
/**
 * The power of n beside the factor.
 */
degree: number, 
/**
 * The factor of each step in the long run: the dominant eigenvalue.
 */
factor: number, 
/**
 * The factor exactly, such as `4` or `(1 + √5)/2`, if it is known.
 */
exactFactor: string | null, 
/**
 * The recurrence, such as `s(n) = s(n-1) + s(n-2)`.
 */
recurrence: string | null, 
/**
 * The first generation for which the recurrence holds.
 */
from: number, 
/**
 * The closed form, such as `3 · 4^n`.
 */
closed: string | null, 
/**
 * The first generation for which the closed form holds.
 */
closedFrom: number, };

/**
 * A rectangle of the picture, in pixels of the canvas from the upper left corner, for a mate.
 */
export type SharedPane = { 
/**
 * The number of the pane in its round.
 */
number: number, 
/**
 * The left side.
 */
x: number, 
/**
 * The upper side.
 */
y: number, 
/**
 * The width.
 */
width: number, 
/**
 * The height.
 */
height: number, 
/**
 * The most work that may be spent on the pane.
 */
budget: number, };

/**
 * A string, and the place where the step to it replaced a symbol.
 */
export type Single = { 
/**
 * The beginning of the string.
 */
text: string, 
/**
 * The number of symbols.
 */
length: number, 
/**
 * Where the symbols are that replaced one: the place of the first, and their number. `None` for the axiom.
 */
made: [number, number] | null, };

/**
 * The place of a written module.
 */
export type Site = { 
/**
 * The number of the production (0-based); null for a module of the axiom.
 */
production: number | null, 
/**
 * The symbol that the production replaces; null for a module of the axiom.
 */
predecessor: string | null, 
/**
 * The number of the module in the successor or in the axiom (0-based).
 */
position: number, };

/**
 * The answer of [`Session::step`].
 */
export type StepAnswer = { 
/**
 * Null if nothing more is known than before.
 */
report: Report | null, 
/**
 * Null if the canvas shows the same as before.
 */
drawn: Drawn | null, 
/**
 * Whether nothing is left to do.
 */
idle: boolean, };

/**
 * A page of a generation's string.
 */
export type StringPage = { 
/**
 * The number of symbols of the generation; null if the number is not known.
 */
length: string | null, 
/**
 * The symbols of the page; null if the generation is too long to derive.
 */
text: string | null, 
/**
 * Whether each symbol ends with a line end, because some have arguments or names in backquotes.
 */
apart: boolean, };

/**
 * A number of a system that a track can change.
 */
export type SubjectObject = { name: string, label: string, 
/**
 * The present value; null if there is none.
 */
value: Array<number> | null, 
/**
 * The range in words.
 */
expected: string, };

/**
 * A symbol's ancestors, and its descendants in the shown generation.
 */
export type SymbolFacts = { 
/**
 * The chain from the axiom; empty if the derivation is too long to be remembered.
 */
ancestry: Array<AncestryLink>, 
/**
 * Null if the derivation is too long to be remembered.
 */
part: Descendants | null, 
/**
 * The first segment of the part.
 */
stroke: SegmentFacts | null, };

/**
 * The turtle's way through the beginning of a string.
 */
export type Trace = { 
/**
 * The state at the start: the symbol is empty.
 */
states: Array<TurtleState>, 
/**
 * The number of symbols of the whole string.
 */
length: string, 
/**
 * Whether the drawing leaves the plane.
 */
isSolid: boolean, 
/**
 * The symbols in use, with their parameters, and what they do in words.
 */
legend: Array<[string, string]>, };

/**
 * A track.
 */
export type TrackObject = { subject: string, keys: Array<KeyObject>, };

/**
 * A tune.
 */
export type Tune = { notes: Array<Note>, 
/**
 * The length, in steps.
 */
length: number, 
/**
 * The seconds of a step.
 */
step: number, 
/**
 * The facts in words.
 */
words: string, };

/**
 * The turtle's state after a symbol.
 */
export type TurtleState = { 
/**
 * The symbol, with its arguments.
 */
symbol: string, 
/**
 * The position, in model units.
 */
at: [number, number, number], 
/**
 * The heading, the left and the up of the turtle: unit vectors.
 */
axes: [[number, number, number], [number, number, number], [number, number, number]], 
/**
 * The number of stored states.
 */
depth: number, 
/**
 * The last stored positions, the newest first.
 */
stored: Array<[number, number, number]>, 
/**
 * The ends of the segment that the symbol draws.
 */
segment: [[number, number, number], [number, number, number]] | null, };

/**
 * An exercise for one student: its value of `x` and the number of the variant, from 1.
 */
export type VariantReport = { text: string, variant: number, };

/**
 * A property in which variants differ from the target.
 */
export type Varied = "mirrored" | "angle" | "letters" | "lengths" | "seed";

/**
 * A system in another notation, or the reason why there is none.
 */
export type WriteReport = { 
/**
 * Null if the notation cannot express the system.
 */
text: string | null, 
/**
 * Sentences: what is left out, or the reason.
 */
notes: Array<string>, };
