//! The scripts of `docs/marking.md`, run as the systems for courses run them.
#![cfg(unix)]

use lsystem::course::Exercise;
use lsystem::{Definition, write_json};
use serde_json::Value;
use std::fs;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

const PLANT: &str = r#"{"initial": "X", "angle_deg": 20, "num_iters": 4, "rules": {"X": "F[+X]F[-X]+X", "F": "FF"}}"#;
/// The student's program: it writes what is asked for, or draws with another angle.
const RIGHT: &str = "#!/bin/sh\nexec lsys draw \"$1\" \"$2\"\n";
const WRONG: &str = "#!/bin/sh\nexec lsys draw \"$1\" \"$2\" --set angle_deg=33\n";

fn page() -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    fs::read_to_string(root.join("docs/marking.md")).unwrap()
}

/// The text of a code block in the page whose first lines contain `sign`.
fn block(language: &str, sign: &str) -> String {
    let page = page();
    let fence = format!("```{language}\n");
    let mut blocks = page.split(&fence).skip(1).filter_map(|rest| rest.split("```").next());
    let is_it = |block: &&str| block.lines().take(2).any(|line| line.contains(sign));
    blocks.find(is_it).unwrap_or_else(|| panic!("no block {sign}")).to_owned()
}

/// A folder with files, and `lsys` on the path.
struct Place(TempDir);

impl Place {
    fn new() -> Self {
        let place = Self(tempfile::tempdir().unwrap());
        fs::create_dir(place.path("bin")).unwrap();
        symlink(env!("CARGO_BIN_EXE_lsys"), place.path("bin/lsys")).unwrap();
        place
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn put(&self, name: &str, text: &str) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, text).unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    fn json(&self, name: &str) -> Value {
        serde_json::from_str(&self.read(name)).unwrap_or_else(|error| panic!("{error}: {}", self.read(name)))
    }

    /// Runs a command of a shell in a folder. Returns whether it succeeds, and all that it prints.
    fn run(&self, folder: &str, line: &str) -> (bool, String) {
        let path = format!("{}:{}", self.path("bin").display(), std::env::var("PATH").unwrap());
        let mut command = Command::new("sh");
        command.env("LC_ALL", "C");
        command.args(["-c", line]).current_dir(self.path(folder)).env("PATH", path).stdin(Stdio::null());
        command.env("testWorkingDirectory", "tests").env("studentParentWorkingDirectoryName", "assignment");
        let Output { status, stdout, stderr } = command.output().unwrap();
        (status.success(), String::from_utf8([stdout, stderr].concat()).unwrap())
    }
}

#[test]
fn programs_and_systems_are_compared() {
    let place = Place::new();
    place.put("check.sh", &block("sh", "check.sh FILE"));
    place.put("draws.sh", &block("sh", "draws.sh ANSWER"));
    place.put("plant.json", PLANT);
    place.put("answer.json", &PLANT.replace("+X\"", "-X\""));
    for (program, is_right, words) in [
        (RIGHT, true, "same order"),
        (WRONG, false, "Segment 9 is the first"),
        ("exit 3", false, "ended with an error"),
    ] {
        place.put("lsystem", program);
        let (done, told) = place.run(".", "sh check.sh plant.json");
        assert!(done == is_right && told.contains(words), "{told}");
    }
    assert!(place.run(".", "sh draws.sh plant.json plant.json").0);
    let (done, told) = place.run(".", "sh draws.sh answer.json plant.json");
    assert!(!done && told.contains("differs"), "{told}");
}

#[test]
fn github_classroom() {
    let text = block("yaml", "classroom.yml");
    let line = text.lines().find_map(|line| line.trim().strip_prefix("command: ")).unwrap();
    let place = Place::new();
    fs::rename(place.path("bin"), place.path(".github")).unwrap();
    place.put(".github/check.sh", &block("sh", "check.sh FILE"));
    place.put("data/plant.json", PLANT);
    place.put("lsystem", RIGHT);
    assert!(place.run(".", line).0);
    place.put("lsystem", WRONG);
    let (done, told) = place.run(".", line);
    assert!(!done && told.contains("Segment 9 is the first"), "{told}");
}

#[test]
fn artemis() {
    let place = Place::new();
    place.put("tests/check.sh", &block("sh", "check.sh FILE"));
    place.put("tests/a plant.json", PLANT);
    place.put("tests/line.json", r#"{"initial": "F", "angle_deg": 20, "num_iters": 0, "rules": []}"#);
    place.put("assignment/lsystem", WRONG);
    place.put("build.sh", &block("sh", "build.sh"));
    assert!(place.run(".", "sh build.sh").0);
    let xml = place.read("results/lsys.xml");
    let (cases, failures) = (xml.matches("<testcase name=").count(), xml.matches("<failure><![CDATA[").count());
    assert_eq!((cases, failures), (2, 1), "{xml}");
    let failed = xml.split("<testcase name=\"a plant\">").nth(1).unwrap();
    assert!(failed.contains("Segment 9 is the first") && failed.contains("]]></failure>\n</testcase>"), "{xml}");
    place.put("assignment/lsystem", RIGHT);
    assert!(place.run(".", "sh build.sh").0);
    assert!(!place.read("results/lsys.xml").contains("failure"));
}

#[test]
fn prairielearn() {
    let _: Value = serde_json::from_str(&block("json", "{")).unwrap();
    let place = Place::new();
    let grade = place.path("grade").display().to_string();
    place.put("grade/tests/plant.json", PLANT);
    place.put("grade/tests/run.sh", &block("sh", "run.sh:").replace("/grade", &grade));
    let result = |answer: &str| {
        place.put("grade/student/plant.json", answer);
        assert_eq!(place.run(".", "sh grade/tests/run.sh"), (true, String::new()));
        place.json("grade/results/results.json")
    };
    let right = result(PLANT);
    assert_eq!((&right["gradable"], &right["score"]), (&true.into(), &1.into()));
    // The first generation is the same.
    let partly = result(&PLANT.replace("\"FF\"", "\"F\""));
    assert_eq!(partly["score"], 0.25);
    let tests = partly["tests"].as_array().unwrap();
    assert_eq!((tests.len(), &tests[1]["points"], &tests[1]["name"]), (4, &0.into(), &"Generation 2".into()));
    assert!(tests[1]["output"].as_str().unwrap().contains("differs"), "{partly}");
    let broken = result("{\"initial\": \"\\\\\"");
    assert_eq!(broken["gradable"], false);
    assert!(broken["format_errors"].as_str().unwrap().contains("--> "), "{broken}");
}

#[test]
fn dodona() {
    let place = Place::new();
    place.put("judge/run", &block("sh", "run: compares"));
    place.put("evaluation/target.json", PLANT);
    place.put("work/input", "");
    let at = |name: &str| place.path(name).display().to_string();
    let input = serde_json::json!({
        "memory_limit": 1000, "source": at("work/source code"), "resources": at("evaluation"), "judge": at("judge"),
        "workdir": at("work"), "programming_language": "json",
    });
    place.put("input.json", &serde_json::to_string_pretty(&input).unwrap());
    let wrong = PLANT.replace("20", "21");
    for (answer, status, words) in [
        (PLANT, "correct", "same order"),
        (&wrong, "wrong", "is the first that differs"),
        ("{", "compilation error", "^"),
    ] {
        place.put("work/source code", answer);
        assert_eq!(place.run(".", "judge/run < input.json > output.json"), (true, String::new()));
        let output = place.json("output.json");
        assert_eq!((&output["status"], &output["accepted"]), (&status.into(), &(status == "correct").into()));
        let told = output["messages"][0]["description"].as_str().unwrap();
        assert!(told.contains(words), "{told}");
    }
}

#[test]
fn answers_to_exercises() {
    let target = Definition {
        axiom: "F".into(),
        rules: "F -> F+F--F+F".into(),
        angle: 60.0,
        iterations: 3,
        ..Definition::default()
    };
    let exercise = Exercise { target: target.clone(), ..Exercise::default() };
    let place = Place::new();
    place.put("solved.sh", &block("sh", "solved.sh"));
    place.put("exercise.txt", &format!("#v=1&x={}", exercise.write()));
    place.put("right.json", &write_json(&target));
    place.put("wrong.json", &write_json(&Definition { rules: "F -> F-F++F-F".into(), ..target }));
    assert!(place.run(".", "sh solved.sh exercise.txt right.json").0);
    let (done, told) = place.run(".", "sh solved.sh exercise.txt wrong.json");
    assert!(!done && told.contains("mirror image"), "{told}");
    assert!(!place.run(".", "sh solved.sh exercise.txt absent.json").0);
}
