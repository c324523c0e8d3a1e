//! Random command lines, with the flags that the help of each command lists: the program ends with one of its codes,
//! without a panic, and leaves alone what nobody named.
#![cfg(unix)]

use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::LazyLock;

/// Runs `lsys` in a folder, with a limit of its processor time and memory.
fn lsys(folder: &Path, words: &[String]) -> Output {
    let mut command = Command::new("sh");
    command.env("LC_ALL", "C");
    command.args(["-c", "ulimit -t 60; ulimit -f 200000; exec \"$@\"", "sh", env!("CARGO_BIN_EXE_lsys")]);
    command.args(words).current_dir(folder).stdin(Stdio::null()).output().expect("lsys starts")
}

/// The flags of each command.
static FLAGS: LazyLock<Vec<(String, Vec<String>)>> = LazyLock::new(|| {
    let help = |words: &[&str]| {
        let words: Vec<String> = words.iter().map(|&word| word.to_owned()).chain(["--help".to_owned()]).collect();
        String::from_utf8(lsys(Path::new("."), &words).stdout).expect("UTF-8")
    };
    let whole = help(&[]);
    let commands = whole.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    let names: Vec<&str> = commands.filter_map(|line| line.split_whitespace().next()).collect();
    assert!(names.contains(&"draw") && names.contains(&"mark"), "{names:?}");
    let flags = |name: &str| {
        let help = help(&[name]);
        let words = help.split(|c: char| !(c.is_ascii_lowercase() || c == '-')).filter(|word| word.starts_with("--"));
        words.map(str::to_owned).collect::<BTreeSet<_>>().into_iter().collect()
    };
    names.iter().map(|name| ((*name).to_owned(), flags(name))).collect()
});

const VALUES: [&str; 42] = [
    "0",
    "1",
    "-1",
    "3",
    "40",
    "1000",
    "1001",
    "1e9",
    "-0.5",
    "nan",
    "inf",
    "99999999999999999999",
    "",
    "x",
    "64x64",
    "1x32768",
    "0x0",
    "a4",
    "300x400",
    "png",
    "svg",
    "stl",
    "midi",
    "length",
    "glb",
    "txt",
    "zoomify",
    "dzi",
    "xyz",
    "1/3",
    "2/2",
    "64m",
    "1k",
    "angle=90",
    "rules=F -> FF",
    "axiom=",
    "style.palette=#ff0000",
    "cpfg",
    "ABAABABA",
    "A",
    "🌿",
    "--",
];
const FILES: [&str; 16] = [
    "koch.json",
    "plant.json",
    "solid.json",
    "odd.json",
    "damaged.json",
    "empty",
    "noise",
    "link",
    "answers.csv",
    "picture.png",
    "text.l",
    "folder",
    "missing.json",
    "folder/out",
    "out",
    "-",
];

/// The folder that a command line is tried in.
fn filled() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str, bytes: &[u8]| fs::write(folder.path().join(name), bytes).expect("a file");
    file("koch.json", br#"{"initial": "F", "rules": ["F -> F+F--F+F"], "angle_deg": 60, "num_iters": 3}"#);
    file(
        "plant.json",
        br#"{"initial": "A(1)", "rules": ["A(x) : x > 0.2 -> F(x)[+A(x/2)] : 0.5", "A(x) -> F"], "num_iters": 4}"#,
    );
    file(
        "solid.json",
        br#"{"initial": "X", "rules": ["X -> F[&X]/X"], "num_iters": 4, "turtle": {"dialect": "abop"}}"#,
    );
    file("odd.json", br#"{"initial": "F]]}", "rules": ["F -> {F.+F.", "nothing"], "num_iters": 1000}"#);
    file("damaged.json", br#"{"initial": "F", "rules": ["#);
    file("empty", b"");
    file("noise", &(0..5000_u32).map(|at| (at.wrapping_mul(2_654_435_761) >> 13) as u8).collect::<Vec<_>>());
    file("link", b"https://example.org/#v=1&axiom=F&rules=F%20-%3E%20F+F&n=3&angle=90");
    file("answers.csv", b"name,answer\nAda,#v=1&axiom=F&n=1&by=Eve\n=1+1,none\n");
    file("text.l", b"lsystem: 1\nderivation length: 2\naxiom: F\nF --> F+F\nendlsystem\n");
    fs::create_dir(folder.path().join("folder")).expect("a folder");
    fs::write(folder.path().join("folder/kept.txt"), "kept").expect("a file");
    fs::create_dir(folder.path().join(".lsys-mine")).expect("a folder");
    fs::write(folder.path().join(".lsys-mine/kept.txt"), "kept").expect("a file");
    let words = ["draw", "koch.json", "picture", "--format", "png", "--size", "32x32"].map(str::to_owned);
    assert!(lsys(folder.path(), &words).status.success());
    folder
}

/// All files below a folder.
fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let all = walk(folder).into_iter().map(|path| {
        let name = path.strip_prefix(folder).expect("inside").to_owned();
        (name, fs::read(&path).expect("readable"))
    });
    all.collect()
}

fn walk(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("readable").flatten().map(|entry| entry.path());
    entries.flat_map(|path| if path.is_dir() { walk(&path) } else { vec![path] }).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: test_effort::cases() / 4, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_command_line(command: prop::sample::Index, shape in prop::collection::vec((0..8_u8, any::<prop::sample::Index>()), 0..9)) {
        let folder = filled();
        let before = files(folder.path());
        let (name, flags) = command.get(&FLAGS);
        let mut words = vec![name.clone()];
        for (kind, at) in &shape {
            words.push(match kind {
                0..=3 => (*at.get(&FILES)).to_owned(),
                4 | 5 if !flags.is_empty() => at.get(flags).clone(),
                _ => (*at.get(&VALUES)).to_owned(),
            });
        }
        let output = lsys(folder.path(), &words);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        prop_assert!(matches!(output.status.code(), Some(0..=2)), "{words:?}: {:?} {said}", output.status);
        prop_assert!(!said.contains("panicked"), "{words:?}: {said}");
        prop_assert!(output.status.success() || !said.is_empty(), "{words:?} fails without a word");
        let after = files(folder.path());
        for (path, bytes) in &before {
            let name = path.display().to_string();
            let is_named = words.iter().any(|word| name.starts_with(word.as_str()) && !word.is_empty());
            prop_assert!(is_named || after.get(path) == Some(bytes), "{words:?} changed {name}");
        }
        let rest = after.keys().find(|path| path.display().to_string().contains(".tmp") || path.ends_with("lock"));
        prop_assert_eq!(rest, None, "{:?} leaves a file", words);
    }
}
