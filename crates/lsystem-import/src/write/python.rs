//! A program in Python that draws with the standard module `turtle`. The readers do not take it for an object with rules:
//! it has no such word.

use super::Refusal;
use super::program::Data;
use super::source::Source;
use core::fmt::Write;
use lsystem_base::say;

pub(super) fn write(source: &Source<'_>) -> Result<String, Refusal> {
    let data = Data::new(source, &say!("A Python program"))?;
    let title = source.title(&['"', '\\']);
    let title = if title.is_empty() { "An L-system" } else { &title };
    let mut text = format!("\"\"\"{title}: an L-system, drawn by turtle graphics.\"\"\"\n");
    text.push_str("import math\n");
    if data.is_random {
        text.push_str("import random\n");
    }
    text.push_str("import turtle\n\n");
    text += &data.constants(source, ["#", "", ""]);
    text.push_str("STEP = 10\n\n");
    if data.is_random {
        let _ = writeln!(text, "random.seed({})\n", source.definition.seed);
    }
    text.push('\n');
    if data.in_context.is_empty() {
        text.push_str(if data.is_random { RANDOM } else { PLAIN });
    } else {
        let is_seen = if data.seen.1 { "symbol not in IGNORED" } else { "symbol in CONSIDERED" };
        text.push_str(&CONTEXTS.replace("IS_SEEN", is_seen));
    }
    text.push_str(DERIVE);
    text.push_str(DRAW);
    Ok(text)
}

const PLAIN: &str = r#"def successor(word, at):
    return SUCCESSORS.get(word[at], word[at])


"#;

const RANDOM: &str = r#"def successor(word, at):
    choice = SUCCESSORS.get(word[at], word[at])
    if isinstance(choice, str):
        return choice
    weights = [weight for weight, _ in choice]
    return random.choices(choice, weights)[0][1]


"#;

const CONTEXTS: &str = r#"def neighbour(word, at, step):
    """The place of the next symbol along the branch, to the left (-1) or to the right (1)."""
    opens, closes = "[]" if step > 0 else "]["
    depth = 0
    while 0 <= at + step < len(word):
        at += step
        symbol = word[at]
        if symbol == opens:
            depth += 1
        elif symbol == closes:
            if depth == 0 and step > 0:
                return None
            depth = max(depth - 1, 0)
        elif depth == 0 and IS_SEEN:
            return at
    return None


def fits(word, at, context, step):
    for wanted in context[::step]:
        at = neighbour(word, at, step)
        if at is None or word[at] != wanted:
            return False
    return True


def successor(word, at):
    for left, symbol, right, result in SUCCESSORS:
        if word[at] == symbol and fits(word, at, left, -1) and fits(word, at, right, 1):
            return result
    return word[at]


"#;

const DERIVE: &str = r#"def derive():
    word = AXIOM
    for _ in range(ITERATIONS):
        word = "".join(successor(word, at) for at in range(len(word)))
    return word


"#;

const DRAW: &str = r#"def walk(word):
    """The points that the turtle reaches, and whether it draws on the way there."""
    x, y, heading, step, sign = 0, 0, HEADING, STEP, 1
    saved = []
    for symbol in word:
        for command, number in ACTIONS.get(symbol, []):
            if command in ("draw", "move"):
                x += step * number * math.cos(math.radians(heading))
                y += step * number * math.sin(math.radians(heading))
                yield x, y, command == "draw"
            elif command == "turn":
                heading += sign * number
            elif command == "push":
                saved.append((x, y, heading, step, sign))
                step *= number
            elif command == "pop" and saved:
                x, y, heading, step, sign = saved.pop()
                yield x, y, False
            elif command == "scale":
                step *= number
            elif command == "swap":
                sign = -sign


def main():
    points = list(walk(derive()))
    # The drawing fills the window, which is wider than tall by a third.
    xs, ys, _ = zip((0, 0, False), *points)
    half = 0.55 * max(max(xs) - min(xs), max(ys) - min(ys), STEP)
    x, y = (min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2
    screen = turtle.Screen()
    screen.setup(800, 600)
    screen.mode("world")
    screen.setworldcoordinates(x - half * 4 / 3, y - half, x + half * 4 / 3, y + half)
    screen.tracer(0)
    pen = turtle.Turtle(visible=False)
    pen.speed(0)
    for x, y, draws in points:
        if draws:
            pen.pendown()
        else:
            pen.penup()
        pen.setposition(x, y)
    screen.update()
    turtle.done()


if __name__ == "__main__":
    main()
"#;
