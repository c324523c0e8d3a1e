//! Output of students' programs, as `lsys check` compares it.

use crate::program;

use expect_test::{Expect, expect};
use program::command;
use std::io::Write;
use std::path::Path;
use std::process::Stdio;

const FILE: &str =
    r#"{"name": "dragon", "initial": "X", "angle_deg": 90, "num_iters": 3, "rules": {"X": "X+Y", "Y": "X-Y"}}"#;

/// Compares an output with the dragon curve. `line` is the command; the output stands in `out`.
fn told(line: &str, output: &str, code: i32, expected: &Expect) {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("dragon.json"), FILE).expect("written");
    std::fs::write(folder.path().join("out"), output).expect("written");
    let (found, words) = lsys(folder.path(), line, output);
    expected.assert_eq(&words);
    assert_eq!(found, Some(code), "{line}");
}

/// Runs `lsys` in a folder, with a text as standard input. Returns the exit code and all that is printed.
fn lsys(folder: &Path, line: &str, input: &str) -> (Option<i32>, String) {
    let mut command = command(folder, line.split(' '));
    let mut child =
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("lsys starts");
    // A program that reads no input closes the pipe.
    let _ = child.stdin.take().expect("a pipe").write_all(input.as_bytes());
    let output = child.wait_with_output().expect("lsys ends");
    let text = [output.stdout, output.stderr].concat();
    (output.status.code(), String::from_utf8(text).expect("UTF-8"))
}

#[test]
fn outputs_are_compared() {
    let right = "X+Y+X-Y+X+Y-X-Y";
    told(
        "check dragon.json out",
        right,
        0,
        &expect![[r#"
        The string is that of generation 3: 15 symbols.
    "#]],
    );
    told(
        "check dragon.json -",
        right,
        0,
        &expect![[r#"
        The string is that of generation 3: 15 symbols.
    "#]],
    );
    told(
        "check dragon.json out -n 2",
        right,
        1,
        &expect![[r#"
        The output is generation 3, not generation 2. The output has 15 symbols; generation 2 has 7.
    "#]],
    );
    told(
        "check dragon.json out",
        "X+Y+X-Y+X+Y+X-Y",
        1,
        &expect![[r#"
        Symbol 12 is the first that differs from generation 3.
          expected: X+Y+X-Y+X+Y-X-Y
          found:    X+Y+X-Y+X+Y+X-Y
                               ^
        Step 2 makes the expected symbol by Y -> X-Y
        Both have 15 symbols.
    "#]],
    );
    told(
        "check dragon.json out -n 1",
        "<svg><path d='M5 5V0H0'/></svg>",
        0,
        &expect![[r#"
        The segments are those of generation 1, in the same order: 2 segments.
    "#]],
    );
    told(
        "check dragon.json out -n 1",
        "0,0,0,1\n0,1,1,1\n",
        1,
        &expect![[r#"
            The picture is that of generation 1, but mirrored left to right.
        "#]],
    );
    told(
        "check dragon.json out -n 1",
        "<svg><path d='M5 5C0 0 0 0 0 0'/></svg>",
        1,
        &expect![[r#"
        error: out: line 1: curves (`C` in a path) are not read
    "#]],
    );
    told(
        "check dragon.json missing",
        "",
        1,
        &expect![[r#"
        error: missing: No such file or directory (os error 2)
    "#]],
    );
    told(
        "check missing.json out",
        "",
        1,
        &expect![[r#"
        error: missing.json: No such file or directory (os error 2)
    "#]],
    );
    told(
        "check - -",
        "",
        2,
        &expect![[r#"
        error: standard input (-) can be read only once

        Usage: lsys check [OPTIONS] <FILE> <OUTPUT>

        For more information, try '--help'.
    "#]],
    );
}
