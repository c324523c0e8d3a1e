//! New systems, as a user of `lsys` makes them.

use lsystem::read_json;
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn lsys(folder: &Path, line: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lsys"));
    command.env("LC_ALL", "C");
    command.args(line.split(' ')).current_dir(folder).stdin(Stdio::null()).output().expect("lsys starts")
}

#[test]
fn a_surprise_can_be_drawn() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let made = lsys(path, "surprise --seed 5");
    assert_eq!(made.stdout, lsys(path, "surprise --seed 5").stdout);
    assert_ne!(made.stdout, lsys(path, "surprise --seed 6").stdout);
    let text = String::from_utf8(made.stdout).expect("UTF-8");
    assert_eq!(read_json(&text).0.expect("a system").name, "surprise-5");
    std::fs::write(path.join("new.json"), text).expect("written");
    assert!(lsys(path, "draw new.json new").status.success());
    assert!(lsys(path, "surprise").status.success());
    assert_eq!(lsys(path, "surprise --seed x").status.code(), Some(2));
}

#[test]
fn children_are_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    for seed in [5, 9] {
        let made = lsys(path, &format!("surprise --seed {seed}"));
        std::fs::write(path.join(format!("{seed}.json")), made.stdout).expect("written");
    }
    let bred = lsys(path, "breed 5.json 9.json --to children --seed 3 --count 4");
    assert_eq!(String::from_utf8_lossy(&bred.stdout), "4 children in children, seed 3\n");
    for number in 1..=4 {
        let text = std::fs::read_to_string(path.join(format!("children/child-{number}.json"))).expect("a file");
        assert!(read_json(&text).0.is_some(), "{text}");
    }
    assert_eq!(lsys(path, "breed 5.json 9.json 5.json --to children").status.code(), Some(2));
    std::fs::write(path.join("empty.json"), r#"{"initial": "X", "rules": ["X -> XX"]}"#).expect("written");
    let none = lsys(path, "breed empty.json --to children");
    assert_eq!(none.status.code(), Some(1), "{none:?}");
}
