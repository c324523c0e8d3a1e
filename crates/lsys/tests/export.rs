//! Systems in the notations of other programs, as a user of `lsys` writes and reads them.

use crate::program;

use expect_test::{Expect, expect};
use program::{command, outputs};
use std::path::Path;

const BUSH: &str =
    "Koch {\n angle 6\n axiom f--f--f\n f=f+f--f+f\n}\nBush {\n angle 16\n axiom ++++f\n f=ff-[-f+f+f]+[+f-f-f]\n}\n";

/// Runs `lsys` in a folder. Returns the exit code, standard output and standard error.
fn lsys(folder: &Path, line: &str) -> (Option<i32>, String, String) {
    outputs(&mut command(folder, line.split(' ')))
}

/// Runs `lsys`, and compares standard output and standard error.
fn check(folder: &Path, line: &str, code: i32, out: &Expect, error: &Expect) {
    let (found, text, words) = lsys(folder, line);
    out.assert_eq(&text);
    error.assert_eq(&words);
    assert_eq!(found, Some(code), "{line}");
}

#[test]
fn systems_are_written_in_other_notations() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    std::fs::write(path.join("old.l"), BUSH).expect("written");
    check(
        path,
        "export old.l --entry bush --as cpfg -n 4",
        0,
        &expect![[r#"
        lsystem: 1
        /* Bush */
        derivation length: 4
        axiom: +(-90)+(22.5)+(22.5)+(22.5)+(22.5)F
        F --> FF-(22.5)[-(22.5)F+(22.5)F+(22.5)F]+(22.5)[+(22.5)F-(22.5)F-(22.5)F]
        endlsystem
    "#]],
        &expect![[r#"
        warning: old.l:6: The text gives no number of iterations; 4 is chosen by the size
    "#]],
    );
    check(
        path,
        "export old.l --entry Bush --as inkscape -n 3",
        0,
        &expect![[r#"
        Axiom: ----++++F
        Rules: F=FF-[-F+F+F]+[+F-F-F]
        Order: 3
        Step length (px): 10
        Left angle: 22.5
        Right angle: 22.5
    "#]],
        &expect![[r#"
        warning: old.l:6: The text gives no number of iterations; 4 is chosen by the size
    "#]],
    );
    check(
        path,
        "export old.l --entry Koch --as inkscape -n 3",
        1,
        &expect![""],
        &expect![[r#"
        warning: old.l:1: The text gives no number of iterations; 5 is chosen by the size
        error: old.l: Inkscape starts upwards, and turns by the two angles only
    "#]],
    );
    let system = r##"{"initial": "A(1)", "rules": ["A(x) -> F(x)[+A(x/2)]"], "angle_deg": 30, "num_iters": 3, "style": {"background": "#000000"}}"##;
    std::fs::write(path.join("tree.json"), system).expect("written");
    check(
        path,
        "export tree.json --as fractint",
        1,
        &expect![""],
        &expect![[r#"
        error: tree.json: Fractint: parameters cannot be expressed
    "#]],
    );
    check(
        path,
        "export tree.json --as lpy",
        0,
        &expect![[r#"
        Axiom: A(1)
        derivation length: 3
        production:
        A(x) --> F(x)[+(30)A(x/2)]
        interpretation:
        maximum depth: 1
        A(p1) --> F(p1)
        endlsystem
    "#]],
        &expect![[r#"
        warning: tree.json: Colours and line widths are left out.
    "#]],
    );
    check(
        path,
        "export missing.l --as lpy",
        1,
        &expect![""],
        &expect![[r#"
        error: missing.l: No such file or directory (os error 2)
    "#]],
    );
    let (code, out, _) = lsys(path, "export --list");
    assert_eq!(code, Some(0));
    assert!(out.contains("fractint") && out.contains("Sketch that derives"), "{out}");
    for line in ["export old.l", "export old.l --as nothing", "export --as cpfg"] {
        assert_eq!(lsys(path, line).0, Some(2), "{line}");
    }
}

#[test]
fn written_systems_are_read_by_the_program() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    std::fs::write(path.join("old.l"), BUSH).expect("written");
    let told = lsys(path, "expand old.l --entry Bush -n 2").1;
    for name in ["fractint", "cpfg", "lpy", "js", "anvaka", "text"] {
        let (code, text, error) = lsys(path, &format!("export old.l --entry Bush -n 2 --as {name}"));
        assert_eq!(code, Some(0), "{error}");
        std::fs::write(path.join("again"), text).expect("written");
        let (_, again, _) = lsys(path, "expand again -n 2");
        let lines = |word: &str| word.matches('F').count();
        assert_eq!(lines(&again), lines(&told), "{name}: {again}");
    }
}
