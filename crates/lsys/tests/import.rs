//! Files of other programs, as a user of `lsys` reads and converts them.

use crate::program;

use expect_test::expect;
use program::{command, outputs};
use std::path::Path;

const TWO: &str = "Koch {\n angle 6\n axiom f--f--f\n f=f+f--f+f\n}\nBush {\n angle 8\n axiom f\n f=f[+f]\n what\n}\n";

/// Runs `lsys` in a folder. Returns the exit code, standard output and standard error.
fn lsys(folder: &Path, line: &str) -> (Option<i32>, String, String) {
    outputs(&mut command(folder, line.split(' ')))
}

fn files(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> = entries.map(|e| e.expect("an entry").file_name().to_string_lossy().into()).collect();
    names.sort();
    names
}

#[test]
fn systems_of_other_programs_are_drawn() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    std::fs::write(path.join("old.l"), TWO).expect("written");
    let (code, out, error) = lsys(path, "expand old.l --entry koch -n 1");
    assert_eq!((code, out.as_str()), (Some(0), "F+F--F+F--F+F--F+F--F+F--F+F\n"));
    expect![[r#"
        warning: old.l:1: The text gives no number of iterations; 5 is chosen by the size
    "#]]
    .assert_eq(&error);
    let (code, out, error) = lsys(path, "draw old.l out --entry Bush");
    assert_eq!((code, out.as_str()), (Some(1), ""));
    expect![[r#"
        error: old.l:10: Fractint cannot read this line: `what`
    "#]]
    .assert_eq(&error);
    assert_eq!(lsys(path, "draw old.l out --entry 1 --format svg").0, Some(0));
    assert_eq!(files(path), ["old.l", "out.svg"]);
    for line in ["info old.l", "info old.l --entry Fern"] {
        let (code, _, error) = lsys(path, line);
        assert_eq!(code, Some(1));
        assert!(error.contains("Koch, Bush"), "{error}");
    }
}

#[test]
fn files_of_surfaces_beside_a_system_are_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    std::fs::create_dir(path.join("in")).expect("a folder");
    let row = |y: u32| (0..4).map(|x| format!("{x} {y} 0 ")).collect::<String>();
    let leaf = format!(
        "0 3 0 3 0 0\nCONTACT POINT X: 0 Y: 0 Z: 0\nHEADING X: 0 Y: 1 Z: 0\nUP X: 0 Y: 0 Z: 1\nSIZE: 1\npatch\n{}",
        (0..4).map(|y| row(y) + "\n").collect::<String>()
    );
    let files_in = [
        ("plant.l", "lsystem: 1\nderivation length: 1\naxiom: A\nA --> F~l(2)\nendlsystem\n"),
        ("plant.v", "angle factor: 8\nsurface: l leaf.s 1\n"),
        ("leaf.s", &*leaf),
    ];
    for (name, text) in files_in {
        std::fs::write(path.join("in").join(name), text).expect("written");
    }
    let (code, out, error) = lsys(path, "import in --to out");
    assert_eq!((code, &*out, &*error), (Some(0), "1 file read, 0 without a system; 1 converted, 0 refused\n", ""));
    let json = std::fs::read_to_string(path.join("out/plant.json")).expect("written");
    assert!(json.contains("\"surfaces\": \"l: 0 0 0 0 -1 0"), "{json}");
    // Without the other files, the remark names what is missing.
    std::fs::write(path.join("alone.l"), files_in[0].1).expect("written");
    assert!(lsys(path, "import alone.l --to out").2.contains("its file is not given"));
}

#[test]
fn folders_are_converted() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    std::fs::create_dir_all(path.join("in/deep")).expect("a folder");
    let files_in = [
        ("a.l", TWO),
        ("deep/b.txt", "axiom: F\nangle: 25\nn: 3\nF -> FF"),
        ("deep/c.json", r#"{"initial": "F", "rules": ["F -> FF"], "turtle": {}}"#),
        ("deep/koch.l", TWO),
        ("noise.txt", "nothing at all"),
    ];
    for (name, text) in files_in {
        std::fs::write(path.join("in").join(name), text).expect("written");
    }
    let (code, out, error) = lsys(path, "import in --to out");
    expect![[r#"
        5 files read, 1 without a system; 4 converted, 2 refused
    "#]]
    .assert_eq(&out);
    assert_eq!(code, Some(1));
    assert!(error.contains("in/noise.txt: no L-system in a known notation"), "{error}");
    assert_eq!(files(&path.join("out")), ["Koch-2.json", "Koch.json", "b.json", "c.json"]);
    for name in files(&path.join("out")) {
        assert_eq!(lsys(&path.join("out"), &format!("info {name}")).0, Some(0), "{name}");
    }
    assert_eq!(lsys(path, "import in/deep/b.txt --to out").0, Some(0));
    assert_eq!(lsys(path, "import missing.l --to out").0, Some(1));
    std::fs::write(path.join("broken.json"), r#"{"initial": "F", "rules": {"F" "FF"}}"#).expect("written");
    std::fs::write(path.join("huge.l"), "Koch {\n Angle 6\n Axiom F\n F=F+F\n}\n".repeat(40_000)).expect("written");
    let (_, out, error) = lsys(path, "import broken.json huge.l in/a.l --to out");
    assert!(error.contains("broken.json: A colon is missing"), "{error}");
    assert!(error.contains("huge.l: longer than 1024 KiB"), "{error}");
    assert!(out.starts_with("3 files read, 2 without a system; 1 converted"), "{out}");
}
