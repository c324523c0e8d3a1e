//! The worst inputs of each kind: within 512 MiB of addresses, and within counted work. What is refused is told.

#![cfg(target_os = "linux")]

use crate::program;

use lsystem::course::{Exercise, Given};
use lsystem::files::packed::pack;
use program::outputs;
use std::fs;
use std::path::Path;
use std::process::Command;

/// Runs `lsys` with at most 512 MiB of addresses. Returns the exit code, standard output and standard error.
fn lsys(folder: &Path, words: &str) -> (Option<i32>, String, String) {
    let script = format!("ulimit -v 524288; exec {} {words}", env!("CARGO_BIN_EXE_lsys"));
    outputs(Command::new("sh").args(["-c", &script]).env("LC_ALL", "C").current_dir(folder))
}

/// Runs `lsys shape` with a file of this content.
fn shape(name: &str, content: &[u8]) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join(name), content).expect("written");
    let (code, _, words) = lsys(folder.path(), &format!("shape {name}"));
    assert_eq!(code, Some(1), "{words}");
    words
}

/// A GLB without a binary chunk.
fn glb(json: &str) -> Vec<u8> {
    let length = (json.len() as u32).to_le_bytes();
    [b"glTF\x02\0\0\0\0\0\0\0", &length[..], b"JSON", json.as_bytes()].concat()
}

#[test]
fn meshes_take_no_more_than_they_may() {
    let zeros = |count| vec!["0"; count].join(",");
    for (json, why) in [
        // Nodes with many children, and with themselves among them.
        (format!(r#"{{"nodes":[{{"children":[{}]}},{{"children":[0]}}]}}"#, zeros(2000)), "more than 10000 nodes"),
        (format!(r#"{{"nodes":[{{"children":[{}]}},{{"children":[0]}}]}}"#, zeros(9999)), "more than 10000 nodes"),
        (r#"{"nodes":[{"children":[1]},{"children":[1]},{"children":[1]}]}"#.to_owned(), "more than 10000 nodes"),
        (format!(r#"{{"nodes":[{{}}{}]}}"#, ",{}".repeat(300_000)), "at most 10000 items"),
        // Parts of meshes that many nodes share.
        (
            format!(
                r#"{{"nodes":[{{"children":[{}]}},{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{}},"mode":1}}{}]}}]}}"#,
                vec!["1"; 9000].join(","),
                r#",{"attributes":{},"mode":1}"#.repeat(5000)
            ),
            "more than 10000 nodes",
        ),
        // What is not read takes no memory.
        (format!(r#"{{"extras":[{{}}{}]}}"#, r#",{"":0}"#.repeat(1_100_000)), "no triangles"),
        (format!(r#"{{"extras":{}{}}}"#, "[".repeat(9000), "]".repeat(9000)), "no triangles"),
    ] {
        let words = shape("a.glb", &glb(&json));
        assert!(words.contains(why), "{words}: {}", &json[..60]);
    }
    let face = format!("v 0 0 0\nf{}\n", " 1".repeat(4_000_000));
    assert!(shape("a.obj", face.as_bytes()).contains("make it simpler"));
    assert!(shape("a.obj", "v 0 0 0\n".repeat(1_000_000).as_bytes()).contains("with a mesh"));
}

/// Marks a table of answers. The exercise stands in its last row, with a right answer.
fn mark(rows: &str) -> String {
    let target =
        lsystem::Definition { axiom: "F".into(), rules: "F -> FF".into(), iterations: 2, ..Default::default() };
    let exercise = Exercise { target, n: Given::Free, ..Exercise::default() }.write();
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("exercise.txt"), format!("#v=1&x={exercise}")).expect("written");
    let last = format!("Noether,#v=1&x={exercise}&n=2&rules=F%20-%3E%20FF");
    fs::write(folder.path().join("answers.csv"), format!("{rows}\n{last}\n")).expect("written");
    let (code, table, words) = lsys(folder.path(), "mark exercise.txt answers.csv --html page.html");
    assert_eq!((code, &*words), (Some(0), ""));
    let noether = table.lines().find(|line| line.starts_with("Noether")).expect("the last row");
    assert!(noether.contains("yes"), "the others are marked: {noether}");
    table
}

#[test]
fn a_students_share_of_a_class_is_bounded() {
    // Links that unpack to megabytes, of which a few kilobytes are handed in.
    let large = format!("#v=1&z={}", pack(format!("by={}", "A".repeat(4_190_000)).as_bytes()));
    let table = mark(&format!("Ada,{large}\n").repeat(600));
    assert_eq!(table.matches("larger than anything that is needed").count(), 600, "told in each row");
    let long = format!("#v=1&z={}", pack(format!("axiom={}", "F".repeat(60_000)).as_bytes()));
    mark(&format!("Ada,{long}\n").repeat(300));
    // Rules as long as a link: each change of one of their symbols was a copy of them.
    mark(&format!("Ada,#v=1&n=2&rules=F%20-%3E%20{}\n", "F+".repeat(20_000)).repeat(3));
    // Many links in one cell, cells in one row, and quotes that never end.
    assert!(mark(&format!("Ada,\"{}\"", "#v=1&k=0\n".repeat(300_000))).contains("Noether"));
    mark(&",".repeat(8 << 20));
    mark(&"\" ".repeat(4 << 20));
    mark(&format!("aaa#{}", ",".repeat(8 << 20)));
}

/// Runs a command on a system in the file a.json.
fn with(system: &str, words: &str) -> (Option<i32>, String, String) {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("a.json"), system).expect("written");
    lsys(folder.path(), words)
}

/// A system with these rules.
fn system(axiom: &str, rules: &str, n: u32) -> String {
    let rules: Vec<&str> = rules.lines().collect();
    let turtle = serde_json::json!({ "dialect": "abop" });
    serde_json::json!({ "initial": axiom, "rules": rules, "num_iters": n, "angle_deg": 90, "turtle": turtle })
        .to_string()
}

#[test]
fn breeding_ends() {
    for (axiom, rules, n) in [
        ("A(1)".to_owned(), "A(x) : x < 1e9 -> A(x+1)F(x)A(x*1.1)", 1000),
        ("A".to_owned(), "A -> F?C(1,1)[+A][-A]", 30),
        ("F".repeat(900_000), "F -> FF", 1),
        ("A".to_owned(), "A -> F[+A]FA", 1000),
    ] {
        let (code, _, words) = with(&system(&axiom, rules, n), "breed a.json --seed 1 --count 4 --to children");
        assert!(matches!(code, Some(0 | 1)), "{rules}: {code:?} {words}");
    }
}

#[test]
fn counting_ends() {
    let rules = |count: u32, length: u32| -> String {
        let letter = |at: u32| char::from_u32(0x4e00 + at % count).expect("a letter");
        let body = |at: u32| (0..length).map(|place| letter(at * 7 + place * 13)).collect::<String>();
        (0..count).map(|at| format!("{} -> {}\n", letter(at), body(at))).collect()
    };
    for (count, length) in [(60, 60), (1500, 25), (200, 200), (4000, 3)] {
        let (code, text, words) = with(&system("一", &rules(count, length), 1000), "info a.json");
        assert_eq!(code, Some(0), "{words}");
        assert!(text.contains("symbols"), "{text}");
    }
}

#[test]
fn hiding_what_lies_at_one_place_ends() {
    for (rules, n, why) in [
        ("A -> [{F+F+F+F}]AA", 13, ""),
        ("A -> [{F+F+F+F}]+AA", 12, ""),
        ("A -> [{F-F-F-F}][{F+F+F+F}]f(0.001)AA", 9, ""),
        ("A -> [{F+F+F+F}]f(2)AA", 14, ""),
        // Each polygon and each broad stroke shows beside all the others.
        ("A -> [{F+F+F+F}]f(0.001)AA", 15, "comparisons"),
        ("A -> [#(9)F+F+F+F]f(0.002)AA", 15, "comparisons"),
        ("A -> [#(99)F][{F+F+F+F}]f(0.02)+(0.1)AA", 14, ""),
    ] {
        let (code, _, words) = with(&system("A", rules, n), "draw a.json a --format plotter --hide");
        assert_eq!(code, Some(i32::from(!why.is_empty())), "{rules}: {words}");
        assert!(words.contains(why), "{rules}: {words}");
    }
}

/// As many copies as fit into this number of bytes.
fn repeated(text: &str, bytes: usize) -> String {
    text.repeat(bytes / text.len())
}

/// Texts from numbers, together just longer than this number of bytes.
fn numbered(each: impl Fn(u32) -> String, bytes: usize) -> String {
    let mut text = String::new();
    for number in 0.. {
        if text.len() > bytes {
            break;
        }
        text += &each(number);
    }
    text
}

/// One of 20,000 letters.
fn letter(number: u32) -> char {
    char::from_u32(0x4e00 + number % 20_000).expect("a letter")
}

#[test]
fn texts_of_others_are_read_once() {
    const LONG: usize = 400_000;
    let cpfg = |code: &str| format!("Lsystem: 1\n{code}\nderivation length: 2\nAxiom: F\nF --> FF\nendlsystem\n");
    let object = |rules: String| format!(r#"{{"axiom":"F","theta":1,"alpha":1,"rules":{{{rules}}}}}"#);
    let branches = numbered(|at| format!("if (c == \"{}\") {{ forward(1); }}\n", letter(at)), LONG / 3);
    for text in [
        // Rules on one line: what follows each sign was copied.
        format!("Axiom: F\nRules: {}", repeated("F=a,", LONG)),
        format!("axiom = F\n{}", repeated("F=FF;", LONG)),
        format!("Axiom: F\nRules: {}", repeated("F(a)=b;", LONG)),
        // Assignments at every step: each was compared with all others.
        cpfg(&format!("StartEach: {{{}}}", numbered(|at| format!("a{at}={at};"), LONG))),
        cpfg(&format!("EndEach: {{{}}}", numbered(|at| format!("a{at}={at};"), LONG))),
        cpfg(&numbered(|at| format!("StartEach: {{a{at}={at};}}\n"), LONG)),
        // Branches of a program: each of its systems got all of them, one by one.
        repeated("axiom=\"F\"; rules={\"F\":\"FF\"};\n", LONG / 2) + &branches,
        repeated("s = LSystem(\"F\", {\"F\": \"F+F\"}, 90)\n", LONG / 2) + &branches,
        repeated("{\"axiom\":\"F\",\"rules\":{\"F\":\"FF\"},\"actions\":{}},\n", LONG / 2) + &branches,
        // Letters without rules: each was looked for in all rules.
        object(numbered(|at| format!("\"{}\":\"F{}\",", letter(at), letter(at + 1)), LONG)),
        object(numbered(
            |at| (1..5).fold("\"A\":\"F".to_owned(), |rule, next| format!("{rule}{}", letter(at + next))) + "\",",
            LONG,
        )),
        format!("Axiom: F\nF -> FF\n{}", numbered(|at| format!("{}: forward\n", letter(at)), LONG)),
    ] {
        let (code, _, words) = with(&text, "import a.json --account");
        assert!(matches!(code, Some(0 | 1)), "{code:?} {words} {}", &text[..60]);
    }
}

#[test]
fn every_reader_stays_within_its_memory() {
    const MAX: usize = 16 << 20;
    let plain = system("F", "F -> F+F", 2);
    let z = |text: &str| format!("#v=1&z={}", pack(text.as_bytes()));
    let path = |part: &str| format!("<svg xmlns=\"http://www.w3.org/2000/svg\"><path d=\"M0 0{part}\"/></svg>");
    for (name, content, words) in [
        // What programs print.
        ("b.csv", repeated("0,0,1,0\n", MAX), "check a.json b.csv"),
        ("b.csv", repeated("0 0 0 1 0 0\n", MAX), "check a.json b.csv"),
        ("b.csv", format!("x0,y0,x1,y1{}", ",".repeat(MAX)), "check a.json b.csv"),
        ("b.svg", path(&repeated("h1", MAX)), "check a.json b.svg"),
        ("b.svg", repeated("<g transform=\"scale(1)\">", MAX), "check a.json b.svg"),
        ("b.txt", "F".repeat(MAX), "check a.json b.txt"),
        ("b.txt", "F+".repeat(MAX / 2), "find b.txt"),
        // Pictures of strokes whose rules are searched.
        ("b.svg", path(&repeated("h1", MAX)), "find b.svg --seconds 0"),
        ("b.svg", path(&repeated("h1v1z", MAX)).replace("/></svg>", "/><use/></svg>"), "find b.svg --seconds 0"),
        ("b.svg", format!("<svg>{}<use/></svg>", repeated("<path d=\"M0 0h1\"/>", MAX - 99)), "find b.svg --seconds 0"),
        ("b.svg", repeated("<g transform=\"scale(2)\">", MAX), "find b.svg --seconds 0"),
        ("b.svg", format!("<svg><style>{}</style></svg>", repeated("a{b:c}", MAX - 99)), "find b.svg --seconds 0"),
        ("b.svg", format!("<svg>{}</svg>", repeated("<use href=\"#a\"/>", MAX - 99)), "find b.svg --seconds 0"),
        ("b.csv", repeated("0,0,1,1\n", MAX), "find b.csv --seconds 0"),
        // Systems and links.
        ("b.json", format!("{{\"initial\":\"F\",\"rules\":[{}\"\"]}}", repeated("\"\",", MAX / 5)), "info b.json"),
        ("b.json", format!("{{\"initial\":\"F\",\"a\":[{}0]}}", repeated("0,", MAX / 5)), "info b.json"),
        ("b.json", format!("{{{}\"a\":0}}", repeated("\"a\":{},", MAX / 5)), "info b.json"),
        ("b.txt", format!("#v=1&{}", repeated("a=&", 2_000_000)), "info b.txt"),
        ("b.txt", z(&repeated("a=&", 4 << 20)), "info b.txt"),
        ("b.txt", z(&format!("axiom={}", "F".repeat(1 << 20))), "info b.txt"),
        ("b.svg", repeated("<metadata id=\"L-system\">{", MAX), "info b.svg"),
        // Outlines.
        ("b.svg", path(&repeated("h1v1z", 8 << 20)), "shape b.svg"),
        ("b.svg", path(&repeated("c1 1 1 1 1 1", 8 << 20)), "shape b.svg"),
        ("b.svg", format!("<svg>{}</svg>", repeated("<g a=\"\" b=\"\">", 8 << 20)), "shape b.svg"),
        // Scripts of films.
        ("b.txt", format!("1;{}", repeated("n=0:0;", 900_000)), "animate a.json --film b.txt --to a.gif --size 16x16"),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join("a.json"), &plain).expect("written");
        fs::write(folder.path().join(name), &content).expect("written");
        let (code, _, said) = lsys(folder.path(), words);
        assert!(matches!(code, Some(0 | 1)), "{words}: {code:?} {said} {}", &content[..content.len().min(60)]);
    }
}

/// A PNG of zeros, with a comment of zeros.
fn png([width, height]: [u32; 2], color: png::ColorType, depth: png::BitDepth, comment: usize) -> Vec<u8> {
    let mut bytes = vec![];
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(color);
    encoder.set_depth(depth);
    encoder.set_compression(png::Compression::Fastest);
    encoder.add_ztxt_chunk("Comment".into(), "0".repeat(comment)).expect("a comment");
    let mut writer = encoder.write_header().expect("a header");
    let row = (width as usize * color.samples() * depth as usize).div_ceil(8);
    writer.write_image_data(&vec![0; row * height as usize]).expect("pixels");
    writer.finish().expect("a picture");
    bytes
}

/// A JPEG of zeros: of the kind 0, or in passes, of kind 2.
fn jpeg(kind: u8, side: u16) -> Vec<u8> {
    let [high, low] = side.to_be_bytes();
    let table = |class| [&[0xff, 0xc4, 0, 20, class, 1][..], &[0; 16]].concat();
    let frame = [0xff, 0xc0 + kind, 0, 17, 8, high, low, high, low, 3, 1, 0x22, 0, 2, 0x11, 0, 3, 0x11, 0];
    let scan = [0xff, 0xda, 0, 12, 3, 1, 0, 2, 0, 3, 0, 0, if kind == 2 { 0 } else { 63 }, 0];
    let start = [0xff, 0xd8, 0xff, 0xdb, 0, 67, 0];
    [&start[..], &[1; 64], &frame, &table(0), &table(0x10), &scan, &vec![0; 16 << 20], &[0xff, 0xd9]].concat()
}

/// A GIF whose frame may be larger than its screen.
fn gif(screen: u16, frame: u16) -> Vec<u8> {
    let [screen, frame] = [screen, frame].map(|side| [side.to_le_bytes(), side.to_le_bytes()].concat());
    let data = [&[255][..], &[0x44; 255]].concat().repeat((16 << 20) / 256);
    [b"GIF89a", &screen[..], b"\0\0\0,\0\0\0\0", &frame, &[0x80, 0, 0, 0, 255, 255, 255, 2], &data, b"\0;"].concat()
}

/// A WebP without loss, or with a canvas of its own around many frames.
fn webp(side: u32, canvas: bool) -> Vec<u8> {
    let chunk = |name: &[u8], content: &[u8]| [name, &(content.len() as u32).to_le_bytes(), content].concat();
    let least = side - 1;
    let size = (least.min(0x3fff) | least.min(0x3fff) << 14).to_le_bytes();
    let pixels = chunk(b"VP8L", &[&[0x2f][..], &size, &[0; 4095]].concat());
    let three = &least.to_le_bytes()[..3];
    let frame = chunk(b"ANMF", &[&[0; 6][..], three, three, &[0; 4], &pixels].concat());
    let frames = [chunk(b"ANIM", &[0; 6]), frame.repeat((16 << 20) / frame.len())].concat();
    let all = [chunk(b"VP8X", &[&[2, 0, 0, 0][..], three, three].concat()), frames].concat();
    chunk(b"RIFF", &[b"WEBP", &(if canvas { all } else { pixels })[..]].concat())
}

#[test]
fn pictures_are_searched_within_their_memory() {
    use png::{BitDepth::*, ColorType::*};
    let folder = tempfile::tempdir().expect("a folder");
    for (name, picture) in [
        ("grey", png([4000, 4000], Grayscale, One, 0)),
        ("16 bits", png([1000, 4000], Grayscale, Sixteen, 0)),
        ("colours", png([8000, 8000], Rgb, Eight, 0)),
        ("transparent", png([2000, 4000], Rgba, Eight, 0)),
        ("a row", png([4_000_000, 1], Rgba, Eight, 0)),
        ("a column", png([1, 1_000_000], Rgb, Sixteen, 0)),
        ("a comment", png([2, 2], Rgb, Eight, 1 << 28)),
        ("JPEG", jpeg(0, 1000)),
        ("JPEG in passes", jpeg(2, 8000)),
        ("a large JPEG", jpeg(2, u16::MAX)),
        ("GIF", gif(8000, 8000)),
        ("a GIF that is larger than its screen", gif(1, u16::MAX)),
        ("a small frame", gif(u16::MAX, 1)),
        ("WebP", webp(8000, false)),
        ("a large WebP", webp(16_384, false)),
        ("WebP in frames", webp(8000, true)),
        ("a large canvas", webp(1 << 24, true)),
    ] {
        fs::write(folder.path().join("picture"), picture).expect("written");
        let (code, _, said) = lsys(folder.path(), "find picture --seconds 0");
        assert!(code == Some(1) && !said.is_empty(), "{name}: {code:?} {said}");
    }
}
