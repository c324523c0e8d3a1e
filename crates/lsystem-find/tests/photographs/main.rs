//! The rules of photographs: of pages, slides, scans and boards, with tilt, shadow, grain, blur and JPEG.

mod camera;

use camera::{Faults, HEIGHT, SCENES, WIDTH};
use lsystem_base::Limits;
use lsystem_drawing::{Plane, System, draw};
use lsystem_files::read_link;
use lsystem_find::{Drawn, Finder, Named, Photograph, Picture, Question, Searched, Share};
use lsystem_syntax::Definition;
use std::sync::Arc;

/// The axiom, the rules, the angle, the first heading and the number of steps of a figure.
type Figure = (&'static str, &'static str, f64, f64, u32);

/// Figures whose lines are some pixels long in the photographs. The first ones are in the gallery or in books.
const FIGURES: [Figure; 25] = [
    ("F", "F -> F+F--F+F", 60.0, 0.0, 3),
    ("F", "F -> F[+F]F", 60.0, 90.0, 5),
    ("F--F--F", "F -> F+F--F+F", 60.0, 0.0, 3),
    ("F-F-F-F", "F -> F-F+F+FF-F-F+F", 90.0, 90.0, 2),
    ("X", "X -> F[+X][-X]FX\nF -> FF", 25.7, 90.0, 6),
    ("X", "X -> +YF-XFX-FY+\nY -> -XF+YFY+FX-", 90.0, 90.0, 5),
    ("F", "F -> F[+F]F[-F]", 25.7, 90.0, 4),
    ("F", "F -> F+F-F-F+F", 90.0, 0.0, 3),
    ("F", "F -> F+G\nG -> F-G", 90.0, 90.0, 9),
    ("F", "F -> F[+F]F[-F]F", 25.7, 90.0, 4),
    ("F", "F -> F[+F]F[-F][F]", 20.0, 90.0, 4),
    ("F", "F -> F+G++G-F--FF-G+\nG -> -F+GG++G+F--F-G", 60.0, 90.0, 3),
    ("X", "X -> F[-X][+X]\nF -> FF", 30.0, 90.0, 6),
    ("F", "F -> +F--F+", 45.0, 0.0, 8),
    ("F", "F -> G+F+G\nG -> F-G-F", 60.0, 90.0, 6),
    ("F", "F -> FF-[-F+F+F]+[+F-F-F]", 22.5, 90.0, 3),
    ("T", "T -> F[+T][-T]\nF -> FF\nT: draw", 120.0, 90.0, 5),
    ("X", "X -> F[+X]F[-X]+X\nF -> FF", 20.0, 90.0, 6),
    ("F", "F -> F+F-F", 120.0, 0.0, 5),
    ("F", "F -> F[-F]F[+F]", 45.0, 90.0, 4),
    ("F-F-F-F-F", "F -> F-F-F++F+F-F", 72.0, 90.0, 2),
    ("X", "X -> F-[[X]+X]+F[+FX]-X\nF -> FF", 22.5, 90.0, 5),
    ("F+F+F+F", "F -> FF+F+F+F+FF", 90.0, 90.0, 3),
    ("F-G-G", "F -> F-G+F+G-F\nG -> GG", 120.0, 0.0, 4),
    ("X", "X -> XFYFX+F+YFXFY-F-XFYFX\nY -> YFXFY-F-XFYFX+F+YFXFY", 90.0, 90.0, 3),
];
/// Systems that are tried at most.
const MOST: u64 = 300_000;

fn definition((axiom, rules, angle, heading, n): Figure) -> Definition {
    let (rules, overrides) = rules.split_once("\nT:").map_or((rules, ""), |(rules, _)| (rules, "T: draw"));
    Definition {
        axiom: axiom.to_owned(),
        rules: rules.to_owned(),
        iterations: n,
        angle,
        heading,
        overrides: overrides.to_owned(),
        ..Definition::default()
    }
}

fn segments(definition: &Definition) -> Vec<[f64; 4]> {
    let system = System::new(definition).0.expect("a system");
    let drawing = draw::<Plane>(&system, definition.iterations, &Limits::default()).expect("a drawing");
    drawing.segments().map(|at| [at.from[0], at.from[1], at.to[0], at.to[1]]).collect()
}

/// The systems of the gallery, as the program tries them.
fn gallery() -> Vec<Named> {
    let read = |line: &str| {
        let (path, link) = line.split_once('\t')?;
        Some(Named { name: path.to_owned(), definition: read_link(link)?.definition })
    };
    include_str!("../../../lsys/src/find/gallery.txt").lines().filter_map(read).collect()
}

fn save(name: &str, grey: &[u8], width: usize, height: usize) {
    if let Ok(folder) = std::env::var("PHOTOGRAPHS_TO") {
        let file = [format!("P5\n{width} {height}\n255\n").as_bytes(), grey].concat();
        std::fs::write(format!("{folder}/{name}.pgm"), file).expect("saved");
    }
}

/// What came of a search.
struct Outcome {
    best: Option<Drawn>,
    is_exact: bool,
    systems: u64,
}

fn searched(number: usize, grey: &[u8], figure: &[[f64; 4]]) -> Outcome {
    let none = Outcome { best: None, is_exact: false, systems: 0 };
    let Some(Photograph { grey, width, height }) = Photograph::straightened(grey, WIDTH, HEIGHT) else { return none };
    save(&format!("straight{number}"), &grey, width, height);
    if std::env::var("LOOK").is_ok() {
        return none;
    }
    let Ok(picture) = Picture::new(&grey, width, height) else { return none };
    let mut finder = Finder::new(&Arc::new(picture), &Question::default(), Share::WHOLE).expect("a search");
    finder.try_first(gallery());
    let mut left = MOST;
    while left > 0 && !finder.is_found() && finder.step(10_000) == Searched::More {
        left = left.saturating_sub(10_000);
    }
    let best = finder.found().first().cloned();
    let own = Picture::of_segments(figure).expect("lines");
    // The same figure, whatever its rules: drawn naively beside it.
    let is_figure = |drawn: &Drawn| {
        Picture::of_segments(&segments(&drawn.definition())).is_ok_and(|again| own.agreement(&again) > 0.999)
    };
    let is_exact = finder.is_found() && best.as_ref().is_some_and(is_figure);
    Outcome { best, is_exact, systems: finder.tried() }
}

/// Fifty photographs: each figure in two scenes.
#[test]
fn rules_of_photographs_are_found() {
    let only = std::env::var("PHOTOGRAPHS").ok();
    let is_tilted = std::env::var("UPRIGHT").is_err();
    let mut table = vec![(0, 0); SCENES.len()];
    for number in 0..2 * FIGURES.len() {
        let (at, scene) = (number % FIGURES.len(), (number + number / FIGURES.len()) % SCENES.len());
        if only.as_ref().is_some_and(|only| !only.split(',').any(|one| one.parse() == Ok(number))) {
            continue;
        }
        let mut faults = Faults::of(SCENES[scene], number as u64 + 1);
        if !is_tilted {
            (faults.tilt, faults.roll) = (0.0, 0.0);
        }
        let figure = segments(&definition(FIGURES[at]));
        let grey = faults.photograph(&figure);
        save(&number.to_string(), &grey, WIDTH, HEIGHT);
        let begin = std::time::Instant::now();
        let Outcome { best, is_exact, systems } = searched(number, &grey, &figure);
        table[scene].0 += usize::from(is_exact);
        table[scene].1 += 1;
        let said = best.map(|best| {
            let name = best.named.as_ref().map_or("", |named| &named.name).to_owned();
            (best.rules().replace('\n', "; "), best.angle, best.heading, best.found.n, best.percent(), name)
        });
        let figure = (FIGURES[at].0, FIGURES[at].1.replace('\n', "; "), FIGURES[at].2, FIGURES[at].4);
        println!("{number:2} {:?} {is_exact} {:.1?} {systems} {figure:?}: {said:?}", SCENES[scene], begin.elapsed());
    }
    println!("{:?}", SCENES.iter().zip(&table).collect::<Vec<_>>());
}
