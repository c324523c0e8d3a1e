//! What systems of other programs draw: segments by number and place.

use crate::{Imported, import};
use lsystem_base::Limits;
use lsystem_drawing::{Figure, System, expand};
use lsystem_syntax::Definition;

/// The only system in a text.
#[track_caller]
fn definition(text: &str) -> Definition {
    let Some(Imported { entries, .. }) = import(text) else { panic!("not recognised: {text}") };
    let [entry] = &entries[..] else { panic!("{entries:?}") };
    entry.definition.clone().unwrap_or_else(|| panic!("{entry:?}"))
}

/// The segments of the only system in a text after n steps: x, y and z of both ends, in steps, rounded.
#[track_caller]
fn segments(text: &str, n: u32) -> Vec<[f64; 6]> {
    let definition = definition(text);
    let system = System::new(&definition).unwrap();
    let near = |value: f64| (value / definition.step * 1e4).round() / 1e4 + 0.0;
    match Figure::draw(&system, n, &Limits::default()).unwrap() {
        Figure::Plane(plane) => {
            let flat = |[x, y]: [f64; 2]| [near(x), near(y), 0.0];
            plane.segments().map(|segment| join(flat(segment.from), flat(segment.to))).collect()
        }
        Figure::Space(space) => {
            space.segments().map(|segment| join(segment.from.map(near), segment.to.map(near))).collect()
        }
    }
}

fn join([a, b, c]: [f64; 3], [d, e, f]: [f64; 3]) -> [f64; 6] {
    [a, b, c, d, e, f]
}

/// The string of the only system in a text after n steps.
#[track_caller]
fn string(text: &str, n: u32) -> String {
    expand(&System::new(&definition(text)).unwrap(), n, &Limits::default()).unwrap()
}

/// All remarks on the only system in a text.
#[track_caller]
fn remarks(text: &str) -> String {
    let imported = import(text).unwrap();
    let remarks = imported.entries.iter().flat_map(|entry| &entry.remarks);
    remarks.map(|remark| format!("{}: {}\n", remark.text, remark.message)).collect()
}

#[test]
fn fractint_reads_look_alikes() {
    let text = "P {\n angle 4\n axiom F−F\n F=FF\n}\n";
    assert_eq!(string(text, 0), "F-F");
    assert!(remarks(text).contains("−: Read as `-`"), "{}", remarks(text));
    assert_eq!(string("Q {\n angle 6\n axiom ＦｘＦ\n F＝F＋F––F＋F\u{200b}\n x=\n}\n", 1), "F+F--F+FF+F--F+F");
}

#[test]
fn anvaka_and_tikz_read_look_alikes() {
    let anvaka = "axiom: F−F\nrules:\n F => F＋F\nactions:\n − => rotate(-30)\n";
    let tikz = "\\draw[l-system={axiom=F–F,rule set={F -> F＋F}, order=1}] l-system;";
    for text in [anvaka, tikz] {
        assert_eq!(string(text, 1), "F+F-F+F", "{text}");
        assert!(remarks(text).contains("Read as `-`") && remarks(text).contains("Read as `+`"), "{}", remarks(text));
    }
}

#[test]
fn fractint_has_all_colours() {
    let palette = definition("P {\n angle 4\n axiom c32FC255F\n}\n").style.palette;
    let part = |at: usize| palette[at].rgb;
    assert_eq!((palette.len(), part(15), part(31), part(255)), (256, [252; 3], [252; 3], [0; 3]));
    // Blue, magenta, red, yellow, green and cyan.
    let hues = [32, 36, 40, 44, 48, 52].map(part);
    assert_eq!(hues, [[0, 0, 252], [252, 0, 252], [252, 0, 0], [252, 252, 0], [0, 252, 0], [0, 252, 252]]);
    assert_eq!((part(33), part(55), part(56)), ([64, 0, 252], [0, 64, 252], [124, 124, 252]));
    assert_eq!(definition("P {\n angle 4\n axiom c14F\n}\n").style.palette.len(), 16);
}

#[test]
fn fractint_tells_what_has_no_effect() {
    let text = "P {\n angle 4\n angle 6\n axiom F\n axiom G\n G=GF\n H=F\n}\n";
    let told = remarks(text);
    assert_eq!((string(text, 1).as_str(), definition(text).angle), ("GF", 60.0));
    for part in ["angle 4: A later Angle", "axiom F: A later Axiom", "H=F: The axiom never becomes this letter"] {
        assert!(told.contains(part), "{told}");
    }
    assert!(remarks("axiom F\nangle 30\nF=F+F").contains("360/30 = 12 degrees"));
    assert!(remarks("P {\n angle 4\n axiom F\n F=F&#8722;F\n}").contains("name in HTML"));
    assert_eq!(import("{angle 4\n axiom F}{angle 4\n axiom G}").unwrap().entries.len(), 2);
}

#[test]
fn anvaka_colours_and_directions() {
    assert_eq!(segments("axiom: cF\nrules:\n F => FF\nactions:\n c => setColor(\"green\")\nangle: 60\n", 2).len(), 4);
    let oblique = segments("axiom: F\nrules:\n F => F+F\nangle: 60\ndirection: [0, 1, 0.5]\n", 2);
    let flat = segments("axiom: F\nrules:\n F => F+F\nangle: 60\ndirection: [0, 1]\n", 2);
    assert_eq!((oblique.len(), &oblique), (4, &flat));
    assert!(remarks("axiom: F\nrules:\n F => F+F\ndirection: [0, 1, 0.5]").contains("rises along z"));
    assert!(remarks("axiom: F\nrules:\n F => F+F\ndirection: [0, 0, 1]").contains("nothing is drawn in the plane"));
}

/// As on that page: the number at the start of the depth, and the first rule's symbol.
#[test]
fn anvaka_defaults() {
    let text = "rules:\n X => X+F\n F => FF\ndepth: 1.5 steps\n";
    assert_eq!((definition(text).iterations, string(text, 1).as_str()), (2, "X+F"));
    assert!(remarks(text).contains("X => X+F: There is no axiom"));
    let calls = "axiom: F\nrules:\n F => FF\nactions:\n F => draw(5); rotate(7);\n";
    assert!(remarks(calls).contains("; rotate(7): That page reads only the first call"), "{}", remarks(calls));
}

/// `rotateX(a)` turns y towards z, and `rotateY(a)` turns x towards z.
#[test]
fn anvaka_turns_about_one_axis() {
    let about = |axis: &str, direction: &str| {
        let text = format!("axiom: F&F\nrules:\n X => X\ndirection: {direction}\nactions:\n & => rotate{axis}(30)\n");
        segments(&text, 0)[1][3..].to_vec()
    };
    assert_eq!(about("X", "[0, 1, 0]"), [0.0, 1.866, 0.5]);
    assert_eq!(about("X", "[0, -1, 0]"), [0.0, -1.866, -0.5]);
    assert_eq!(about("Y", "[1, 0, 0]"), [1.866, 0.0, 0.5]);
    assert_eq!(about("Y", "[-2, 0, 0]"), [-1.866, 0.0, -0.5]);
    assert_eq!(about("Z", "[1, 0, 0]"), [1.866, 0.5, 0.0]);
    assert_eq!(about("X", "[1, 0, 0]"), [2.0, 0.0, 0.0]);
    for (axes, direction, why) in [
        ("rotateX(30)\n ^ => rotateY(20)", "[1, 0, 0]", "other symbols about another one"),
        ("rotateX(30)\n ^ => rotate(20)", "[1, 0, 0]", "other symbols about another one"),
        ("rotateX(30)\n ^ => rotateX(20)", "[1, 1, 0]", "the direction is oblique"),
    ] {
        let text = format!("axiom: F&F^F\nrules:\n X => X\ndirection: {direction}\nactions:\n & => {axes}\n");
        assert!(remarks(&text).contains(why), "{}", remarks(&text));
    }
}

#[test]
fn anvaka_links() {
    let link = "https://anvaka.github.io/lsystem/?code=axiom%3A%20F%0Arules%3A%0A%20F%20%3D%3E%20F%2BF%0Aangle%3A%2060%0Adepth%3A%203";
    for text in [format!("{link}\n"), format!("[Cog]({link})"), format!("see <{link}&x=1>, by nobody")] {
        assert_eq!((segments(&text, 3).len(), definition(&text).iterations), (8, 3), "{text}");
        assert_eq!(remarks(&text), "", "{text}");
    }
    let blanks = link.replace("%20", "+");
    assert_eq!((string(&blanks, 1).as_str(), segments(&blanks, 3).len()), ("F+F", 8));
    assert_eq!(import(&format!("[a]({link}), [b]({link})")).unwrap().entries.len(), 2);
    assert!(remarks(&link.replace("%20F", "%2")).contains("damaged"), "{}", remarks(&link.replace("%20F", "%2")));
    assert!(remarks(&link.replace("angle%3A%2060", "noise")).contains("noise: This line cannot be read"));
}

#[test]
fn racket_definitions() {
    let text = |code: &str| {
        format!(
            "#lang lindenmayer racket\n## axiom ##\nF - G\n## rules ##\nG -> G G\n## variables ##\nn=1\nθ=90\n======\n(require \
             lindenmayer/turtle)\n(provide (all-from-out lindenmayer/turtle) G)\n{code}\n"
        )
    };
    let same = text("(define G F)");
    assert_eq!((segments(&same, 0).len(), segments(&same, 1).len(), remarks(&same)), (2, 3, String::new()));
    let moved = text("; no move\n(define (G turtles variables) ; nothing\n  turtles)");
    assert!(remarks(&text("(define (G turtles variables) (draw 5 turtles))")).contains("decides what `G` does"));
    assert_eq!((segments(&moved, 1).len(), remarks(&moved)), (1, String::new()));
    let nothing = text("(define (G turtles variables) turtles)");
    assert_eq!((segments(&nothing, 1).len(), remarks(&nothing)), (1, String::new()));
    assert!(remarks(&text("(define G F)\n(display 1)")).contains("(display 1): This Racket code is not run"));
    assert!(remarks(&text("(define G H)\n(define H G)")).contains("decides what `G` does"));
}

/// The numbers of `!` are units, of which a step has 2.
#[test]
fn racket_widths() {
    let text = "#lang lindenmayer racket\n## axiom ##\nF!(3)F\n## rules ##\nX -> X\n## variables ##\nn=0\nθ=180/4\n";
    assert_eq!((string(text, 0).as_str(), definition(text).angle), ("F!(1.5)F", 45.0));
    assert!(remarks(&text.replace("180/4", "half")).contains("The angle is not a number"));
}

#[test]
fn tikz_rotations() {
    let heading = |text: &str| definition(text).heading;
    let system = "l-system={rule set={F -> F+F}, axiom=F, order=2, angle=60}";
    for (text, degrees) in [
        (format!("\\draw [{system}] l-system;"), 0.0),
        (format!("\\draw[rotate=90] [{system}] l-system;"), 90.0),
        (format!("\\draw [rotate=45, {system}, rotate=-90] (0,0) l-system;"), 315.0),
        (format!("\\draw [rotate=10] (1,1); \\draw (0,0) [rotate around={{30:(1,1)}}] l-system [{system}];"), 30.0),
        (format!("\\begin{{tikzpicture}}[rotate=20]\\draw[{system}] l-system;\\end{{tikzpicture}}"), 20.0),
        (
            format!(
                "\\begin{{tikzpicture}}[rotate=20]\\begin{{scope}}[scale=-2]\\end{{scope}}\\begin{{scope}}[rotate=5]\n\
                 \\draw[{system}] l-system;\\end{{scope}}\\end{{tikzpicture}}"
            ),
            25.0,
        ),
        (format!("\\tikz[rotate=7] \\draw[scale=-1, {system}] l-system;"), 187.0),
        (format!("% \\draw[rotate=3]\n\\draw[%rotate=3,\n{system}] l-system;"), 0.0),
    ] {
        assert_eq!(heading(&text), degrees, "{text}");
        assert_eq!(remarks(&text), "", "{text}");
    }
    assert_eq!(segments(&format!("\\draw[rotate=90] [{system}] l-system;"), 0), [[0.0, 0.0, 0.0, 0.0, 1.0, 0.0]]);
    for (option, why) in [("xscale=-1", "mirrors"), ("rotate=\\a", "not a number"), ("red", "is not carried over")] {
        let text = format!("\\draw[{option}] [{system}] l-system;");
        assert!(remarks(&text).contains(why), "{}", remarks(&text));
    }
}

#[test]
fn tikz_comments_are_no_rules() {
    let text = "\\pgfdeclarelindenmayersystem{K}{%\n  % \\rule{F -> F}\n  \\rule{F -> FF} % {\n}\n\\draw[l-system={K, % name\n axiom=F, order=1}] l-system;";
    assert_eq!((string(text, 1).as_str(), remarks(text)), ("FF", String::new()));
}

#[test]
fn houdini_tells_numbers_with_another_meaning() {
    let of = |premise: &str| remarks(&format!("Premise: {premise}\nRule 1: A=F\nAngle: 30°\nGenerations: 1"));
    assert_eq!(of("F+(20)F"), "");
    assert!(of("F!(0.5)F").contains("is a factor in Houdini"));
    assert!(of("F(1,2)F").contains("Only the first number"));
    let twice = "Premise: F\nPremise: FF\nRule 1: A=F\nGenerations: 1";
    assert!(remarks(twice).contains("Premise: F: A later line") && string(twice, 0) == "FF");
}
