//! New systems, as a user of `lsys` makes them.

use crate::program;

use lsystem::read_json;
use program::output;

#[test]
fn a_surprise_can_be_drawn() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let made = output(path, "surprise --seed 5");
    assert_eq!(made.stdout, output(path, "surprise --seed 5").stdout);
    assert_ne!(made.stdout, output(path, "surprise --seed 6").stdout);
    let text = String::from_utf8(made.stdout).expect("UTF-8");
    assert_eq!(read_json(&text).0.expect("a system").name, "surprise-5");
    std::fs::write(path.join("new.json"), text).expect("written");
    assert!(output(path, "draw new.json new").status.success());
    assert!(output(path, "surprise").status.success());
    assert_eq!(output(path, "surprise --seed x").status.code(), Some(2));
}

#[test]
fn children_are_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    for seed in [5, 9] {
        let made = output(path, &format!("surprise --seed {seed}"));
        std::fs::write(path.join(format!("{seed}.json")), made.stdout).expect("written");
    }
    let bred = output(path, "breed 5.json 9.json --to children --seed 3 --count 4");
    assert_eq!(String::from_utf8_lossy(&bred.stdout), "4 children in children, seed 3\n");
    for number in 1..=4 {
        let text = std::fs::read_to_string(path.join(format!("children/child-{number}.json"))).expect("a file");
        assert!(read_json(&text).0.is_some(), "{text}");
    }
    assert_eq!(output(path, "breed 5.json 9.json 5.json --to children").status.code(), Some(2));
    std::fs::write(path.join("empty.json"), r#"{"initial": "X", "rules": ["X -> XX"]}"#).expect("written");
    let none = output(path, "breed empty.json --to children");
    assert_eq!(none.status.code(), Some(1), "{none:?}");
}
