//! A sketch for p5.js. The readers do not take it for an object with rules or for a text: it has no such word and no
//! arrow.

use super::Refusal;
use super::program::Data;
use super::source::Source;
use core::fmt::Write;
use lsystem_base::say;

pub(super) fn write(source: &Source<'_>) -> Result<String, Refusal> {
    let data = Data::new(source, &say!("A sketch"))?;
    let title = source.title(&[]);
    let title = if title.is_empty() { "An L-system" } else { &title };
    let mut text = format!("// {title}: an L-system, as a sketch for https://editor.p5js.org\n\n");
    text += &data.constants(source, ["//", "const ", ";"]);
    if data.is_random {
        let _ = writeln!(text, "const SEED = {};", source.definition.seed);
    }
    text.push('\n');
    if data.in_context.is_empty() {
        text.push_str(if data.is_random { RANDOM } else { PLAIN });
    } else {
        let is_seen = if data.seen.1 { "!IGNORED.includes(symbol)" } else { "CONSIDERED.includes(symbol)" };
        text.push_str(&CONTEXTS.replace("IS_SEEN", is_seen));
    }
    text.push_str(&DRAW.replace("SEEDING", if data.is_random { "    randomSeed(SEED);\n" } else { "" }));
    Ok(text)
}

const PLAIN: &str = r"function successor(word, at) {
    return SUCCESSORS[word[at]] ?? word[at];
}

";

const RANDOM: &str = r#"function successor(word, at) {
    const choice = SUCCESSORS[word[at]] ?? word[at];
    if (typeof choice === "string") return choice;
    let sum = 0;
    for (const [weight] of choice) sum += weight;
    let left = random(sum);
    for (const [weight, result] of choice) {
        left -= weight;
        if (left < 0) return result;
    }
    return choice[choice.length - 1][1];
}

"#;

const CONTEXTS: &str = r#"// The place of the next symbol along the branch, to the left (-1) or to the right (1); -1 if there is none.
function neighbour(word, at, step) {
    const [opens, closes] = step > 0 ? "[]" : "][";
    let depth = 0;
    for (at += step; at >= 0 && at < word.length; at += step) {
        const symbol = word[at];
        if (symbol === opens) depth += 1;
        else if (symbol === closes) {
            if (depth === 0 && step > 0) return -1;
            depth = Math.max(depth - 1, 0);
        } else if (depth === 0 && IS_SEEN) return at;
    }
    return -1;
}

function fits(word, at, context, step) {
    const wanted = [...context];
    if (step < 0) wanted.reverse();
    for (const symbol of wanted) {
        at = neighbour(word, at, step);
        if (at < 0 || word[at] !== symbol) return false;
    }
    return true;
}

function successor(word, at) {
    for (const [left, symbol, right, result] of SUCCESSORS) {
        if (word[at] === symbol && fits(word, at, left, -1) && fits(word, at, right, 1)) return result;
    }
    return word[at];
}

"#;

const DRAW: &str = r#"function derive() {
    let word = [...AXIOM];
    for (let n = 0; n < ITERATIONS; n++) {
        const next = [];
        for (let at = 0; at < word.length; at++) next.push(...successor(word, at));
        word = next;
    }
    return word;
}

// The lines of a word: x and y of both ends, with y down.
function trace(word) {
    let turtle = { x: 0, y: 0, heading: HEADING, size: 1, sign: 1 };
    const saved = [];
    const found = [];
    for (const symbol of word) {
        for (const [command, number] of ACTIONS[symbol] ?? []) {
            const { x, y, heading, size, sign } = turtle;
            if (command === "draw" || command === "move") {
                const angle = (heading * Math.PI) / 180;
                turtle.x = x + number * size * Math.cos(angle);
                turtle.y = y - number * size * Math.sin(angle);
                if (command === "draw") found.push([x, y, turtle.x, turtle.y]);
            } else if (command === "turn") turtle.heading = (heading + sign * number) % 360;
            else if (command === "push") {
                saved.push({ ...turtle });
                turtle.size = size * number;
            } else if (command === "pop") turtle = saved.pop() ?? turtle;
            else if (command === "scale") turtle.size = size * number;
            else if (command === "swap") turtle.sign = -sign;
        }
    }
    return found;
}

function setup() {
    createCanvas(800, 800);
    noLoop();
}

function draw() {
SEEDING    const lines = trace(derive());
    let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity];
    for (const [x0, y0, x1, y1] of lines) {
        [left, right] = [Math.min(left, x0, x1), Math.max(right, x0, x1)];
        [top, bottom] = [Math.min(top, y0, y1), Math.max(bottom, y0, y1)];
    }
    // The drawing fills the canvas.
    const scale = (0.9 * width) / Math.max(right - left, bottom - top);
    const [x, y] = [(left + right) / 2, (top + bottom) / 2];
    background(255);
    translate(width / 2 - scale * x, height / 2 - scale * y);
    for (const [x0, y0, x1, y1] of lines) line(scale * x0, scale * y0, scale * x1, scale * y1);
}
"#;
