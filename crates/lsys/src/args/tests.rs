use super::*;
use crate::cli::{Changes, TileOptions};
use expect_test::{Expect, expect};

fn check(line: &str, expected: &Expect) {
    let with = |Changes { iterations, seed, settings, memory, entry }| {
        let set = if settings.is_empty() { String::new() } else { format!(" set {settings:?}") };
        let memory = memory.map_or_else(String::new, |bytes| format!(" memory {bytes}"));
        let entry = entry.map_or_else(String::new, |name| format!(" entry {name}"));
        format!("n {iterations:?} seed {seed:?}{set}{memory}{entry}")
    };
    let text = match parse(line.split_whitespace().map(OsString::from)) {
        Ok(Verb::Expand { file, changes }) => format!("expand {file:?} {}", with(changes)),
        Ok(Verb::Info { files, json, changes, .. }) => format!("info {files:?} json {json} {}", with(changes)),
        Ok(Verb::Draw { files, out_dir, look, changes }) => {
            let jobs = jobs(&files, out_dir.as_deref(), &look).expect("the arguments are checked");
            let Look { flags, compact, .. } = look;
            let jobs: Vec<String> = jobs.iter().map(|job| format!("{:?} to {:?}", job.file, job.target)).collect();
            let size = flags.options().size.map_or_else(String::new, |[width, height]| format!(" {width} by {height}"));
            let compact = if compact { " compact" } else { "" };
            format!("draw {}{size}{compact} {}", jobs.join(", "), with(changes))
        }
        Ok(Verb::Tiles { file, dir, options, changes }) => {
            let TileOptions { levels, scheme, size, part, under, .. } = options;
            format!("tiles {file:?} to {dir:?} {levels:?} {scheme:?} {size} {part:?} {under:?} {}", with(changes))
        }
        Ok(Verb::Animate { file, to, film, .. }) => {
            format!("animate {file:?} to {to:?} dive {:?} track {:?}", film.dive, film.track)
        }
        Ok(Verb::Import { files, to: Some(to), .. }) => format!("import {files:?} to {to:?}"),
        Ok(Verb::Import { files, .. }) => format!("account of {files:?}"),
        Ok(Verb::Export { file, notation, list, changes }) => {
            let name = notation.map(|notation| notation.name);
            format!("export {file:?} as {name:?} list {list} {}", with(changes))
        }
        Ok(Verb::Check { file, output, changes }) => format!("check {file:?} {output:?} {}", with(changes)),
        Err(Stop::Print(text)) => format!("print {}", text.lines().next().unwrap_or_default()),
        Ok(Verb::Find { text, known, json }) => format!("find {text} {known:?} json {json}"),
        Ok(Verb::Mark { exercise, answers, csv, html }) => {
            format!("mark {exercise} {answers:?} csv {csv} {html:?}")
        }
        Ok(Verb::View { file, options, entry }) => format!("view {file:?} {options:?} entry {entry:?}"),
        Ok(Verb::Link { file, page, changes }) => format!("link {file:?} {page:?} {}", with(changes)),
        Ok(
            verb @ (Verb::Shape { .. }
            | Verb::Surprise { .. }
            | Verb::Breed { .. }
            | Verb::Exhibit { .. }
            | Verb::Scorm { .. }
            | Verb::Completions { .. }),
        ) => {
            format!("{verb:?}")
        }
        Err(Stop::Wrong(error)) => error.split("\n\n").next().unwrap_or_default().to_owned(),
    };
    expected.assert_eq(&text);
}

#[test]
fn commands() {
    check(
        "a.json",
        &expect![[r#"view "a.json" ViewOptions { port: None, no_browser: false, page: None } entry None"#]],
    );
    for same in ["view a.json", "-- a.json"] {
        assert_eq!(parse(same.split(' ').map(OsString::from)), parse(["a.json".into()]));
    }
    check(
        "--port 8080 a.l --entry Bush --no-browser --page p.html",
        &expect![[
            r#"view "a.l" ViewOptions { port: Some(8080), no_browser: true, page: Some("p.html") } entry Some("Bush")"#
        ]],
    );
    check(
        "link a.json -n 3 --page https://example.org/",
        &expect![[r#"link "a.json" Some("https://example.org/") n Some(3) seed None"#]],
    );
    check("surprise --seed 7", &expect![["Surprise { seed: Some(7) }"]]);
    check(
        "breed a.json - --to out --count 4",
        &expect![[r#"Breed { files: ["a.json", "-"], to: "out", seed: None, count: 4 }"#]],
    );
    check("breed - - --to out", &expect![["error: standard input (-) can be read only once"]]);
    check("expand a.json -n 3", &expect![[r#"expand "a.json" n Some(3) seed None"#]]);
    check(
        "animate --dive a.json --to a.gif --track angle=0:-20,5:30",
        &expect![[r#"animate "a.json" to "a.gif" dive Some(Dive(None)) track ["angle=0:-20,5:30"]"#]],
    );
    check("a.json out", &expect![[r#"draw "a.json" to Write("out", [txt, svg]) n None seed None"#]]);
    check("draw a.json", &expect![[r#"draw "a.json" to Write("a", [txt, svg]) n None seed None"#]]);
    check(
        "draw some/1.24d.json --seed=7",
        &expect![[r#"draw "some/1.24d.json" to Write("1.24d", [txt, svg]) n None seed Some(7)"#]],
    );
    check("draw --format csv a.json", &expect![[r#"draw "a.json" to Print(csv) n None seed None"#]]);
    check("draw a.json out --format csv", &expect![[r#"draw "a.json" to Write("out", [csv]) n None seed None"#]]);
    check(
        "draw a.json b.json --out-dir pictures",
        &expect![[
            r#"draw "a.json" to Write("pictures/a", [txt, svg]), "b.json" to Write("pictures/b", [txt, svg]) n None seed None"#
        ]],
    );
    check(
        "--to d draw x/a.json y/a.json",
        &expect![[
            r#"draw "x/a.json" to Write("d/x-a", [txt, svg]), "y/a.json" to Write("d/y-a", [txt, svg]) n None seed None"#
        ]],
    );
    check("mark #x=a b.csv c --csv", &expect![[r##"mark #x=a ["b.csv", "c"] csv true None"##]]);
    check("info a.json b.json --json", &expect![[r#"info ["a.json", "b.json"] json true n None seed None"#]]);
    check("info -- -n", &expect![[r#"info ["-n"] json false n None seed None"#]]);
    check("draw - --format svg", &expect![[r#"draw "-" to Print(svg) n None seed None"#]]);
    check("draw a --size 40x30 --format png", &expect![[r#"draw "a" to Print(png) 40 by 30 n None seed None"#]]);
    check(
        "draw a --set x=1 --set y=a=b",
        &expect![[r#"draw "a" to Write("a", [txt, svg]) n None seed None set [("x", "1"), ("y", "a=b")]"#]],
    );
    check(
        "info a --set x",
        &expect!["error: invalid value 'x' for '--set <NAME=VALUE>': expected a name and a value such as angle_deg=30"],
    );
    check("info a --memory 2M", &expect![[r#"info ["a"] json false n None seed None memory 2097152"#]]);
    check("draw a --compact", &expect![[r#"draw "a" to Write("a", [txt, svg-compact]) compact n None seed None"#]]);
    check("draw a --compact --format svg", &expect![[r#"draw "a" to Print(svg-compact) compact n None seed None"#]]);
    check("-n 3 --json info a", &expect![[r#"info ["a"] json true n Some(3) seed None"#]]);
    check("--seed=4 a.json -n3 out", &expect![[r#"draw "a.json" to Write("out", [txt, svg]) n Some(3) seed Some(4)"#]]);
    check("-- draw out", &expect![[r#"draw "draw" to Write("out", [txt, svg]) n None seed None"#]]);
    check(
        "tiles a.json d --levels 2..9 --scheme xyz --size 512 --part 1/3 --under 4/15/0",
        &expect![[
            r#"tiles "a.json" to "d" Levels(2, 9) Xyz 512 TileShare { part: 1, of: 3, level: 4 } TilePlace { level: 4, x: 15, y: 0 } n None seed None"#
        ]],
    );
    for (option, words) in [
        ("--levels 3..2", "expected levels such as 0..8, at most 60"),
        ("--levels 0..61", "expected levels such as 0..8, at most 60"),
        ("--part 3/3", "expected a part such as 0/4, the first of four"),
        ("--under 2/4/0", "expected a tile such as 3/0/7: the level, at most 60, the column and the row"),
        ("--size 100", "expected 256 or 512"),
    ] {
        let line = format!("tiles a d {option}");
        let told = parse(line.split_whitespace().map(OsString::from)).unwrap_err();
        let told = format!("{told:?}");
        assert!(told.contains(words), "{told}");
    }
    check("draw a --dpi 300", &expect!["error: --dpi needs --format png"]);
    check("expand a -n 3 -n 4", &expect![[r#"expand "a" n Some(4) seed None"#]]);
    check(
        "expand a --set tropism=-1 --set -x",
        &expect![
            "error: invalid value '-x' for '--set <NAME=VALUE>': expected a name and a value such as angle_deg=30"
        ],
    );
    check("draw a --format csv out", &expect![[r#"draw "a" to Write("out", [csv]) n None seed None"#]]);
    check("--help nonsense", &expect!["print Derives, draws and inspects L-systems"]);
    check("a out -h", &expect!["print Write or print pictures, meshes, segments and strings"]);
    check("info a -V", &expect!["print lsys 0.1.0"]);
    check(
        "draw old.l out --entry Bush",
        &expect![[r#"draw "old.l" to Write("out", [txt, svg]) n None seed None entry Bush"#]],
    );
    check("import a.l --account", &expect![[r#"account of ["a.l"]"#]]);
    check("export --as cpfg a.l", &expect![[r#"export Some("a.l") as Some("cpfg") list false n None seed None"#]]);
    check("export --list", &expect!["export None as None list true n None seed None"]);
    check("import a.l folder --to out", &expect![[r#"import ["a.l", "folder"] to "out""#]]);
    check("check a.json out.txt -n 3", &expect![[r#"check "a.json" "out.txt" n Some(3) seed None"#]]);
    check("help draw", &expect!["print Write or print pictures, meshes, segments and strings"]);
}

#[test]
fn wrong_usage() {
    check("", &expect!["Derives, draws and inspects L-systems"]);
    check("a.json --port 0", &expect!["error: invalid value '0' for '--port <N>': 0 is not in 1..=65535"]);
    check("a.json --format csv", &expect!["error: unexpected argument '--format' found"]);
    check(
        "expand",
        &expect![[r#"
            error: the following required arguments were not provided:
              <FILE>"#]],
    );
    check("expand a b", &expect!["error: unexpected argument 'b' found"]);
    check(
        "expand a -n -1",
        &expect!["error: invalid value '-1' for '--iterations <N>': expected a whole number from 0 to 1000"],
    );
    check(
        "expand a -n 1001",
        &expect!["error: invalid value '1001' for '--iterations <N>': expected a whole number from 0 to 1000"],
    );
    check("expand a -n", &expect!["error: a value is required for '--iterations <N>' but none was supplied"]);
    check(
        "expand a --seed x",
        &expect!["error: invalid value 'x' for '--seed <SEED>': expected a whole number from 0 to 4294967295"],
    );
    check(
        "info a --memory 2",
        &expect![
            "error: invalid value '2' for '--memory <SIZE>': expected a whole number with K, M, G or T, such as 512M or 2G"
        ],
    );
    check("expand a --json", &expect!["error: unexpected argument '--json' found"]);
    check("expand a --format svg", &expect!["error: unexpected argument '--format' found"]);
    check(
        "draw a --format gif",
        &expect![[r#"
                error: invalid value 'gif' for '--format <FORMAT>'
                  [possible values: svg, svg-compact, plotter, png, pdf, tikz, tikz-library, latex, markdown, bibtex, midi, json, txt, csv, obj, glb, stl, scad]"#]],
    );
    check("draw a --size 10x10", &expect!["error: --size needs --format png"]);
    check("draw a --pen 0.5", &expect!["error: --pen needs --format plotter"]);
    check(
        "draw a --format plotter --sheet b9",
        &expect![
            "error: invalid value 'b9' for '--sheet <SIZE>': expected `a5`, `a4`, `a3`, `a2`, `a1`, `letter`, `legal`, `tabloid`, or a width and a height such as 300x400, with 10 to 10,000 mm each way"
        ],
    );
    check("draw a --compact --format csv", &expect!["error: --compact needs --format svg or no --format"]);
    check("info a --compact", &expect!["error: unexpected argument '--compact' found"]);
    check(
        "draw a --format png --size 10",
        &expect![
            "error: invalid value '10' for '--size <WxH>': expected a width and a height such as 1600x1200, with 1 to 32,768 pixels each way"
        ],
    );
    check(
        "draw a --format png --size 0x10",
        &expect![
            "error: invalid value '0x10' for '--size <WxH>': expected a width and a height such as 1600x1200, with 1 to 32,768 pixels each way"
        ],
    );
    check(
        "draw a --format png --size 4000000000x4000000000",
        &expect![
            "error: invalid value '4000000000x4000000000' for '--size <WxH>': expected a width and a height such as 1600x1200, with 1 to 32,768 pixels each way"
        ],
    );
    check("draw a.json b.json", &expect!["error: OUT_BASE b.json looks like a system; use --out-dir for many files"]);
    check("draw a b c", &expect!["error: draw takes one FILE and one OUT_BASE; use --out-dir for many files"]);
    check("draw a /", &expect!["error: OUT_BASE `/` must end in a file name"]);
    check("draw a pictures/", &expect!["error: OUT_BASE `pictures/` must end in a file name"]);
    check("draw a ..", &expect!["error: OUT_BASE `..` must end in a file name"]);
    check("draw -", &expect!["error: give an OUT_BASE or a --format"]);
    check("draw a.json a.json --out-dir d", &expect!["error: a.json and a.json would both be written to d/a"]);
    check("info - -", &expect!["error: standard input (-) can be read only once"]);
    check(
        "completions tcsh",
        &expect![[r#"
            error: invalid value 'tcsh' for '<SHELL>'
              [possible values: bash, elvish, fish, powershell, zsh]"#]],
    );
    check("info a --loud", &expect!["error: unexpected argument '--loud' found"]);
}
