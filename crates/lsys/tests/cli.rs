//! The program as a user runs it.

use crate::program;

use expect_test::{Expect, expect};
use program::{command, output, root};
use std::ffi::OsStr;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// Runs `lsys` in the repository's root.
fn lsys(arguments: &[impl AsRef<OsStr>]) -> Output {
    command(root(), arguments).output().expect("lsys starts")
}

/// Runs `lsys` with the words of `line`, which must succeed with empty standard error.
fn good(line: &str) -> String {
    let output = output(&root(), line);
    assert_eq!((text(&output.stderr), output.status.code()), (String::new(), Some(0)), "{line}");
    text(&output.stdout)
}

/// Runs `lsys` with the words of `line`, which must fail with `code` and this message.
fn bad(line: &str, code: i32, expected: &Expect) {
    let output = output(&root(), line);
    expected.assert_eq(&text(&output.stderr));
    assert_eq!((text(&output.stdout), output.status.code()), (String::new(), Some(code)), "{line}");
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

/// A temporary folder for one test, removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).expect("a folder for tests");
        Self(path)
    }

    fn base(&self, name: &str) -> String {
        self.0.join(name).display().to_string()
    }

    fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.0.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(&self.0).expect("readable").flatten();
        let mut names: Vec<String> = entries.map(|entry| entry.file_name().display().to_string()).collect();
        names.sort();
        names
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// All files of the gallery.
fn gallery() -> Vec<String> {
    let mut files = Vec::new();
    for folder in std::fs::read_dir(root().join("data_in")).expect("data_in").flatten() {
        for file in std::fs::read_dir(folder.path()).expect("a folder").flatten() {
            let path = Path::new("data_in").join(folder.file_name()).join(file.file_name());
            files.push(path.display().to_string());
        }
    }
    files.sort();
    assert!(files.len() > 60, "{files:?}");
    files
}

#[test]
fn expand_prints_the_string_and_a_newline() {
    assert_eq!(good("expand data_in/assignment-8/plant_01.json -n 1"), "F[+X]F[-X]+X\n");
    assert_eq!(good("expand data_in/assignment-8/plant_01.json -n 0"), "X\n");
    assert_eq!(good("expand data_in/focs-lsystems/readme-a-b.json"), "ABAABABA\n");
}

#[test]
fn a_seed_decides_and_decides_alike() {
    let [a, b, again] = [1, 2, 1].map(|seed| good(&format!("expand data_in/abop/1.27.json --seed {seed}")));
    assert_eq!(a, again);
    assert_ne!(a, b);
}

#[test]
fn strings_beyond_memory_stream_until_the_reader_has_enough() {
    let mut child = command(root(), ["expand", "data_in/curves/koch-snowflake.json", "-n", "1000"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("lsys starts");
    let mut start = vec![0; 1 << 20];
    let mut out = child.stdout.take().expect("piped");
    std::io::Read::read_exact(&mut out, &mut start).expect("a megabyte");
    assert!(start.starts_with(b"F+F--F+F+F+F--F+F--F+F--F+F+F+F--F+F"));
    drop(out);
    let output = child.wait_with_output().expect("lsys ends");
    assert_eq!((text(&output.stderr), output.status.code()), (String::new(), Some(0)));
}

#[test]
fn draw_writes_the_string_and_the_picture() {
    let folder = Folder::new("draw");
    let base = folder.base("1.24d");
    for line in [format!("data_in/abop/1.24d.json {base}"), format!("draw data_in/abop/1.24d.json {base} -n 7")] {
        good(&line);
        assert_eq!(folder.names(), ["1.24d.svg", "1.24d.txt"]);
        assert_eq!(folder.read("1.24d.txt").len(), 13956 + 1);
        let svg = folder.read("1.24d.svg");
        assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"), "{}", &svg[..80]);
        assert_eq!(svg, good("draw data_in/abop/1.24d.json --format svg"));
        std::fs::remove_file(format!("{base}.svg")).expect("is there");
    }
}

#[test]
fn a_format_is_written_alone() {
    let folder = Folder::new("format");
    good(&format!("draw data_in/abop/1.24a.json {} --format csv", folder.base("weed")));
    assert_eq!(folder.names(), ["weed.csv"]);
}

#[test]
fn many_files_go_into_a_folder() {
    let folder = Folder::new("many");
    let files = "data_in/abop/1.24a.json data_in/abop/1.24b.json";
    good(&format!("draw {files} --out-dir {} -n 2", folder.0.display()));
    assert_eq!(folder.names(), ["1.24a.svg", "1.24a.txt", "1.24b.svg", "1.24b.txt"]);
}

#[test]
fn csv_has_a_line_for_each_segment() {
    let csv = good("draw data_in/practical-1/text-example.json --format csv -n 1");
    expect![[r#"
        x0,y0,x1,y1,level,colour
        0,0,0,1,0,0
        0,1,0,2,0,0
    "#]]
    .assert_eq(&csv);
    assert_eq!(good("draw data_in/assignment-8/plant_02.json --format csv").lines().count(), 3125 + 1);
}

#[test]
fn what_leaves_the_plane_is_drawn_as_it_is_seen() {
    let csv = good("draw data_in/practical-1/tree3d1.json --format csv -n 1");
    assert_eq!(csv.lines().next(), Some("x0,y0,z0,x1,y1,z1,level,colour"));
    assert_eq!(csv.lines().count(), 10 + 1);
    let obj = good("draw data_in/practical-1/tree3d1.json --format obj -n 1");
    assert_eq!(obj.lines().filter(|line| line.starts_with("o ")).count(), 1, "{obj}");
    let folder = Folder::new("glb");
    good(&format!("draw data_in/curves/koch-snowflake.json {} --format glb -n 2", folder.base("koch")));
    assert!(std::fs::read(folder.0.join("koch.glb")).expect("is there").starts_with(b"glTF"));
    let svg = good("draw data_in/abop/2.7a.json -n 4 --format svg");
    assert!(svg.contains("<path") && !svg.contains("NaN"), "{svg}");
    expect![[r#"
        Hilbert curve in space
          file        data_in/abop/1.19.json
          kind        deterministic, memoised, blocks: 5
          iterations  2
          symbols     271
          segments    63
          bounds      x 0 to 3, y 0 to 3, z -3 to 0
          growth      symbols x 9.344828, segments x 9.000000 in the last step
    "#]]
    .assert_eq(&good("info data_in/abop/1.19.json"));
}

#[test]
fn pictures_have_the_size_that_is_asked_for() {
    let folder = Folder::new("png");
    let line = format!("draw data_in/curves/koch-snowflake.json {} --format png", folder.base("koch"));
    for (more, size) in [("", (887, 1024)), (" --size 300x200 -n 40", (300, 200)), (" --size 50x60 -n 1000", (50, 60))]
    {
        good(&format!("{line}{more}"));
        let file = std::fs::File::open(folder.0.join("koch.png")).expect("is there");
        let mut reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("fits")];
        reader.next_frame(&mut pixels).expect("an image");
        assert_eq!((reader.info().width, reader.info().height), size);
        let corner = [0x0d, 0x21, 0x37];
        let drawn = pixels.chunks_exact(3).filter(|pixel| *pixel != corner).count();
        assert_eq!(pixels[..3], corner, "background at {more}");
        assert!(drawn > 200 && drawn < pixels.len() / 6, "{drawn} pixels drawn at {more}");
    }
}

#[test]
fn counts_are_known_where_the_drawing_is_too_large() {
    let told = good("info data_in/abop/1.31a.json -n 60 --memory 150M");
    assert!(told.contains("limit       "), "{told}");
    assert!(told.contains("symbols     9239061"), "{told}");
    assert!(!told.contains("unknown"), "{told}");
}

#[test]
fn info_tells_what_is_known() {
    expect![[r#"
        Alternating twigs
          file        data_in/abop/1.24d.json
          kind        deterministic, memoised, blocks: 14
          iterations  7
          symbols     13956
          segments    4118
          bounds      x -70.10220768553427 to 70.10220768553427, y 0 to 248.93418014601684
          growth      symbols x 3.029303, segments x 3.096241 in the last step
          print       4,118 strokes would be thinner than 0.8 mm and are made thicker. From a height of 222 mm on, none would be.
    "#]]
    .assert_eq(&good("info data_in/abop/1.24d.json"));
    expect![[r#"
        {
          "file": "data_in/curves/koch-island.json",
          "name": "koch-island",
          "title": "Quadratic Koch island",
          "kind": "deterministic",
          "iterations": 100,
          "seed": 0,
          "symbols": "15132267252770468069422739399612523482096622352946955004725614766632546798241929817362380507",
          "segments": "8148143905337944345073782753637512644205873574663745002544561797417525199053346824733589504",
          "bounds": [
            -5.35646014753012e+59,
            -5.35646014753012e+59,
            2.1425840590120023e+60,
            2.1425840590120023e+60
          ],
          "growth": {
            "symbols": 8.0,
            "segments": 8.0
          },
          "memoised": true,
          "blocks": 101,
          "print": null,
          "limit": null
        }
    "#]]
    .assert_eq(&good("info data_in/curves/koch-island.json -n 100 --json"));
    expect![[r#"
        Random weed
          file        data_in/abop/1.27.json
          kind        stochastic, not memoised, blocks: 1
          iterations  5
          seed        5
          symbols     1201
          segments    481
          bounds      x -10.841477114688587 to 4.164995452362973, y 0 to 53
          growth      symbols x 3.741433, segments x 3.728682 in the last step
          print       481 strokes would be thinner than 0.8 mm and are made thicker. From a height of 142 mm on, none would be.
    "#]]
    .assert_eq(&good("info data_in/abop/1.27.json --seed 5"));
    let nothing = lsys(&["info", "data_in/focs-lsystems/readme-s-to-ss.json", "-n", "0"]);
    assert!(text(&nothing.stderr).starts_with("warning: No symbol of this system draws"));
    expect![[r#"
        Doubling
          file        data_in/focs-lsystems/readme-s-to-ss.json
          kind        deterministic, memoised, blocks: 0
          iterations  0
          symbols     1
          segments    0
    "#]]
    .assert_eq(&text(&nothing.stdout));
}

#[test]
fn facts_are_known_at_any_generation() {
    let files = gallery();
    let facts = |n: &str, files: &[String]| -> Vec<serde_json::Value> {
        let mut arguments = vec!["info", "--json", "-n", n];
        arguments.extend(files.iter().map(String::as_str));
        let output = lsys(&arguments);
        // Systems that draw nothing are named.
        let said = text(&output.stderr);
        let is_reason =
            |line: &str| line.starts_with(" --> ") || line.starts_with("warning: ") && line.contains("draw");
        assert!(said.lines().all(is_reason) && output.status.code() == Some(0), "{said}");
        serde_json::from_slice(&output.stdout).expect("JSON")
    };
    let first = facts("1", &files);
    assert_eq!(first.len(), files.len());
    let is_deterministic = |facts: &serde_json::Value| facts["kind"] == "deterministic";
    let (mut deterministic, mut stochastic) = (Vec::new(), Vec::new());
    for (facts, file) in first.iter().zip(files) {
        assert!(facts["limit"].is_null() && facts["symbols"].is_string() && facts["segments"].is_string(), "{facts}");
        if is_deterministic(facts) { &mut deterministic } else { &mut stochastic }.push(file);
    }
    assert!(deterministic.len() > 60 && stochastic.len() > 4);
    for facts in facts("1000", &deterministic) {
        assert!(facts["limit"].is_null() && facts["symbols"].is_string() && facts["segments"].is_string(), "{facts}");
        assert!(facts["memoised"] == true, "{facts}");
    }
    for facts in facts("9", &stochastic) {
        assert!(facts["symbols"].is_string() == facts["limit"].is_null(), "{facts}");
    }
}

const NOTHING: &str = "No symbol of this system draws: use one that does (F in most dialects), or give one a meaning \
                       such as `X: draw`.";

#[test]
fn an_empty_drawing_is_explained() {
    let said = |axiom: &str, rules: &str, format: &str| {
        let text_of = format!(r#"{{"initial": "{axiom}", "rules": ["{rules}"], "turtle": {{"dialect": "abop"}}}}"#);
        let mut child = command(root(), ["draw", "-", "--format", format])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("starts");
        child.stdin.take().expect("piped").write_all(text_of.as_bytes()).expect("taken");
        text(&child.wait_with_output().expect("ends").stderr)
    };
    let file = "\n --> standard input\n";
    assert_eq!(said("X", "X -> XX", "svg"), format!("warning: {NOTHING}{file}"));
    assert_eq!(said("X", "X -> XX", "txt"), "");
    assert_eq!(said("XY", "X -> XX", "svg"), format!("warning: Write a rule for Y: nothing replaces it.{file}"));
    assert_eq!(
        said("f", "f -> f+f", "csv"),
        format!("warning: f moves without a line: write a capital F to draw.{file}")
    );
    assert_eq!(said("{f+f+f}", "F -> F", "svg").matches("draw").count(), 0);
    assert_eq!(said("●", "● -> ●", "png"), "");
}

#[test]
fn every_file_of_the_gallery_is_drawn() {
    for file in gallery() {
        // Additive ink is only for pixels, and its generations have too many strokes for an SVG file.
        if std::fs::read_to_string(root().join(&file)).expect("a text").contains(r#""ink": "density""#) {
            let picture = lsys(&["draw", &file, "--format", "png", "--size", "160x100"]);
            assert!(picture.status.success() && picture.stdout.starts_with(b"\x89PNG"), "{file}");
            continue;
        }
        let output = lsys(&["draw", &file, "--format", "svg"]);
        // Two systems of the courses are only about strings.
        let empty = ["readme-s-to-ss", "lri-prose-rule"].iter().any(|name| file.contains(name));
        let said = if empty { format!("warning: {NOTHING}\n --> {file}\n") } else { String::new() };
        assert_eq!((text(&output.stderr), output.status.code()), (said, Some(0)), "{file}");
        let svg = text(&output.stdout);
        assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"), "{file}");
    }
}

#[test]
fn standard_input_is_read() {
    let mut child =
        command(root(), ["expand", "-"]).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("starts");
    child.stdin.take().expect("piped").write_all(br#"{"initial": "F", "rules": {"F": "F+F"}}"#).expect("taken");
    assert_eq!(text(&child.wait_with_output().expect("ends").stdout), "F+F\n");
}

#[test]
fn broken_files_are_explained() {
    let file = |name: &str| format!("expand crates/lsys/tests/broken/{name}.json");
    bad(
        &file("empty"),
        1,
        &expect![[r#"
        error: The file holds nothing
         --> crates/lsys/tests/broken/empty.json
          = help: It must hold an object: {"initial": "F"}.
    "#]],
    );
    bad(
        &file("unclosed"),
        1,
        &expect![[r#"
        error: This object is never closed
         --> crates/lsys/tests/broken/unclosed.json:1:1
          |
        1 | { "initial": "F", "rules": { "F": "FF" }
          | ^
          = help: Add `}`.
    "#]],
    );
    bad(
        &file("wrong_types"),
        1,
        &expect![[r#"
            error: `angle_deg` must be a number, not a string
             --> crates/lsys/tests/broken/wrong_types.json:3:16
              |
            3 |   "angle_deg": "ninety",
              |                ^^^^^^^^
            error: `num_iters` must be a whole number from 0 to 1,000
             --> crates/lsys/tests/broken/wrong_types.json:4:16
              |
            4 |   "num_iters": -1,
              |                ^^
            error: `rules` must be an outcome {"p": 0.5, "e": "F+F"}, not a string
             --> crates/lsys/tests/broken/wrong_types.json:5:19
              |
            5 |   "rules": {"F": ["FF"]},
              |                   ^^^^
            error: `dialect` must be one of `abop`, `every-letter`, `practical`, `lowercase`, `axes`
             --> crates/lsys/tests/broken/wrong_types.json:6:25
              |
            6 |   "turtle": {"dialect": "logo", "overrides": {"G": "jump"}}
              |                         ^^^^^^
        "#]],
    );
    bad(
        &file("wrong_rules"),
        1,
        &expect![[r#"
        error: `=` gives a constant its value, and `FF` is not a number
         --> crates/lsys/tests/broken/wrong_rules.json, rules:1:3
          |
        1 | F = FF
          |   ^
          = help: For a rule write `F -> FF`.
        error: This backquote is never closed
         --> crates/lsys/tests/broken/wrong_rules.json, rules:2:6
          |
        2 | F -> `F
          |      ^
          = help: Backquotes make one character a symbol: `:`. The backquote itself is ```.
        error: 0 cannot be a weight
         --> crates/lsys/tests/broken/wrong_rules.json, rules:3:10
          |
        3 | G -> F : 0
          |          ^
          = help: A weight is a number above zero, from 1e-100 to 1e100.
    "#]],
    );
    bad(
        &file("not_text"),
        1,
        &expect![[r#"
            error: Line 1 is not UTF-8 text
             --> crates/lsys/tests/broken/not_text.json
        "#]],
    );
    bad(
        &file("array"),
        1,
        &expect![[r#"
        error: The file must hold an object, not a list
         --> crates/lsys/tests/broken/array.json:1:1
          |
        1 | [1, 2, 3]
          | ^^^^^^^^^
    "#]],
    );
    bad(
        &file("too_many"),
        1,
        &expect![[r#"
            error: `num_iters` must be a whole number from 0 to 1,000
             --> crates/lsys/tests/broken/too_many.json:3:16
              |
            3 |   "num_iters": 2000,
              |                ^^^^
        "#]],
    );
    bad(
        &file("is_missing"),
        1,
        &expect![[r#"
        error: crates/lsys/tests/broken/is_missing.json: No such file or directory (os error 2)
    "#]],
    );
    bad(
        "expand data_in",
        1,
        &expect![[r#"
        error: data_in: Is a directory (os error 21)
    "#]],
    );
}

#[test]
fn warnings_do_not_stop_the_work() {
    let output = lsys(&["expand", "crates/lsys/tests/broken/doubtful.json"]);
    expect![[r#"
        warning: Unknown key `angel_deg`
         --> crates/lsys/tests/broken/doubtful.json:4:3
          |
        4 |   "angel_deg": 20,
          |   ^^^^^^^^^^^
          = help: Did you mean `angle_deg`?
        warning: This `]` closes no branch and is ignored in the drawing
         --> crates/lsys/tests/broken/doubtful.json, axiom:1:2
          |
        1 | F]
          |  ^
          = help: Remove it, or open the branch before it.
        warning: `Y` never occurs, so this rule never applies
         --> crates/lsys/tests/broken/doubtful.json, rules:2:1
          |
        2 | Y -> F
          | ^
          = help: Use the symbol in the axiom or in a rule that applies, or remove this one.
    "#]]
    .assert_eq(&text(&output.stderr));
    assert_eq!((text(&output.stdout).as_str(), output.status.code()), ("F+F+F+F]\n", Some(0)));
}

#[test]
fn limits_name_themselves() {
    let folder = Folder::new("limits");
    bad(
        &format!("data_in/curves/koch-snowflake.json {} -n 1000", folder.base("koch")),
        1,
        &expect![[r#"
        error: The string would be longer than 268,435,456 symbols
         --> data_in/curves/koch-snowflake.json
          = help: Up to 12 iterations fit.
    "#]],
    );
    bad(
        "expand data_in/abop/1.27.json -n 100",
        1,
        &expect![[r#"
            error: Deriving it would pass through more than 100,000,000 symbols
             --> data_in/abop/1.27.json
              = help: Up to 13 iterations fit.
        "#]],
    );
    bad(
        "draw data_in/curves/koch-snowflake.json --format csv -n 40",
        1,
        &expect![[r#"
        error: The drawing would have more than 2,000,000 segments
         --> data_in/curves/koch-snowflake.json
    "#]],
    );
    assert_eq!(folder.names(), [""; 0], "nothing is left behind");
}

#[test]
fn what_cannot_be_written_is_said() {
    let output = lsys(&["draw", "data_in/abop/1.24a.json", "no/such/folder/weed"]);
    expect![[r#"
        error: no/such/folder/weed.txt: No such file or directory (os error 2)
    "#]]
    .assert_eq(&text(&output.stderr));
    assert_eq!(output.status.code(), Some(1));
}

#[cfg(target_os = "linux")]
#[test]
fn full_disks_are_said() {
    for line in
        ["expand data_in/abop/1.24a.json", "draw data_in/abop/1.24a.json --format svg", "info data_in/abop/1.24a.json"]
    {
        let full = std::fs::File::create("/dev/full").expect("a device of Linux");
        let output = command(root(), line.split(' ')).stdout(full).output().expect("lsys starts");
        assert_eq!(text(&output.stderr), "error: standard output: No space left on device (os error 28)\n");
        assert_eq!(output.status.code(), Some(1));
    }
}

#[cfg(unix)]
#[test]
fn names_need_not_be_unicode() {
    use std::os::unix::ffi::OsStrExt;
    let folder = Folder::new("names");
    let file = folder.0.join(OsStr::from_bytes(b"\xff.json"));
    std::fs::copy(root().join("data_in/abop/1.24a.json"), &file).expect("copied");
    let output = lsys(&[OsStr::new("draw"), file.as_os_str(), OsStr::new("--out-dir"), folder.0.as_os_str()]);
    assert_eq!((text(&output.stderr), output.status.code()), (String::new(), Some(0)));
    assert!(folder.0.join(OsStr::from_bytes(b"\xff.svg")).exists());
}

#[test]
fn good_files_are_done_beside_bad_ones() {
    let folder = Folder::new("beside");
    let files = "crates/lsys/tests/broken/empty.json data_in/abop/1.24a.json";
    bad(
        &format!("draw {files} --to {}/new/one -n 1", folder.0.display()),
        1,
        &expect![[r#"
            error: The file holds nothing
             --> crates/lsys/tests/broken/empty.json
              = help: It must hold an object: {"initial": "F"}.
        "#]],
    );
    let made = ["1.24a.svg", "1.24a.txt"].map(|name| folder.0.join("new/one").join(name).is_file());
    assert_eq!(made, [true, true]);
    let output = lsys(&format!("info {files} --json").split(' ').collect::<Vec<_>>());
    assert!(text(&output.stdout).contains("1.24a") && output.status.code() == Some(1));
}

#[test]
fn many_files_give_what_each_gives_alone() {
    // One file exceeds a limit, one has an error, one has a warning, and one needs more than half of the memory.
    let files = [
        "data_in/curves/koch-snowflake.json",
        "crates/lsys/tests/broken/empty.json",
        "data_in/abop/1.27.json",
        "crates/lsys/tests/broken/doubtful.json",
        "data_in/abop/2.7a.json",
        "data_in/abop/1.24a.json",
    ];
    let run = |command: &str, files: &[&str], options: &str| {
        let line = format!("{command} {} -n 10 --memory 20M {options}", files.join(" "));
        let output = lsys(&line.split_whitespace().collect::<Vec<_>>());
        (text(&output.stdout), text(&output.stderr), output.status.code())
    };
    for format in ["svg", "svg --compact", "png --size 90x60", "txt"] {
        let [together, alone] = ["together", "alone"].map(Folder::new);
        let options = |folder: &Folder| format!("--format {format} --out-dir {}", folder.0.display());
        let (out, err, code) = run("draw", &files, &options(&together));
        let each = files.map(|file| run("draw", &[file], &options(&alone)).1);
        assert_eq!((out, err, code), (String::new(), each.concat(), Some(1)), "{format}");
        assert_eq!(together.names(), alone.names(), "{format}");
        assert!(together.names().len() >= 3, "{format}: {:?}", together.names());
        for name in together.names() {
            let [one, other] = [&together, &alone].map(|folder| std::fs::read(folder.0.join(&name)).expect("readable"));
            assert!(one == other, "{format}: {name}");
        }
    }
    let (out, err, code) = run("info", &files, "");
    let each = files.map(|file| run("info", &[file], ""));
    let facts: Vec<&str> = each.iter().map(|(out, ..)| out.as_str()).filter(|out| !out.is_empty()).collect();
    let errors = each.iter().map(|(_, err, _)| err.as_str()).collect::<String>();
    assert_eq!((out, err, code), (facts.join("\n"), errors, Some(1)));
}

#[test]
fn usage() {
    bad(
        "expand",
        2,
        &expect![[r#"
        error: the following required arguments were not provided:
          <FILE>

        Usage: lsys expand <FILE>

        For more information, try '--help'.
    "#]],
    );
    bad(
        "draw data_in/abop/1.24a.json --format gif",
        2,
        &expect![[r#"
            error: invalid value 'gif' for '--format <FORMAT>'
              [possible values: svg, svg-compact, plotter, png, pdf, tikz, tikz-library, latex, markdown, bibtex, midi, json, txt, csv, obj, glb, stl, scad]

            For more information, try '--help'.
        "#]],
    );
    bad(
        "draw data_in/abop/1.24a.json --size 10x10",
        2,
        &expect![[r#"
        error: --size needs --format png

        Usage: lsys draw [OPTIONS] FILE [OUT_BASE]
               lsys draw [OPTIONS] FILE... --out-dir DIR

        For more information, try '--help'.
    "#]],
    );
    assert!(good("--help").contains("lsys FILE OUT_BASE"));
    assert!(good("draw --help").contains("lsys draw [OPTIONS] FILE... --out-dir DIR"));
    assert_eq!(good("--version"), format!("lsys {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn completions_are_printed_for_every_shell() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = good(&format!("completions {shell}"));
        assert!(["expand", "info", "out-dir"].iter().all(|word| script.contains(word)), "{shell}: {script}");
    }
    assert!(good("completions zsh").starts_with("#compdef lsys\n"));
}

#[cfg(unix)]
#[test]
fn bash_completes_options() {
    let script = format!(
        "{}\nCOMP_WORDS=(lsys draw --out); COMP_CWORD=2; _lsys lsys --out draw; echo \"${{COMPREPLY[*]}}\"",
        good("completions bash")
    );
    let output = Command::new("bash").args(["-c", &script]).output().expect("bash starts");
    assert_eq!(text(&output.stdout), "--out-dir\n", "{}", text(&output.stderr));
}

#[test]
fn pictures_are_files_too() {
    let folder = Folder::new("reopened");
    let json = "data_in/abop/1.24f.json";
    let [one, two] = [folder.base("one"), folder.base("two")];
    let expected = good(&format!("expand {json} -n 3"));
    for (options, ending) in [("svg", "svg"), ("svg --compact", "svg"), ("png --size 40x30", "png")] {
        good(&format!("draw {json} {one} -n 3 --format {options}"));
        assert_eq!(good(&format!("expand {one}.{ending}")), expected, "{options}");
        // The system inside a picture gives the same picture, byte for byte.
        good(&format!("draw {one}.{ending} {two} --format {options}"));
        let [first, second] = [&one, &two].map(|base| std::fs::read(format!("{base}.{ending}")).expect("a picture"));
        assert_eq!(first, second, "{options}");
    }
    let foreign = folder.base("foreign.svg");
    std::fs::write(&foreign, "<svg xmlns='http://www.w3.org/2000/svg'/>").expect("a file");
    let output = lsys(&["info", &foreign]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).starts_with("error: This SVG holds no L-system\n"));
}

#[test]
fn compact_pictures_stay_small_and_say_what_they_cost() {
    let [flat, compact] =
        ["", " --compact"].map(|form| good(&format!("draw data_in/abop/1.24f.json -n 6 --format svg{form}")));
    assert!(flat.len() > 10 * compact.len(), "{} {}", flat.len(), compact.len());
    let output = lsys(&["draw", "data_in/abop/1.24c.json", "-n", "40", "--format", "svg", "--compact"]);
    assert!(output.stdout.len() < 200_000 && output.status.success());
    assert!(text(&output.stderr).starts_with("warning: This file may open slowly ("));
}
