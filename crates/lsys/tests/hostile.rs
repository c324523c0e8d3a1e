//! The program with malicious files, and with outputs that cannot be written.

use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The command `lsys` with the words of `line`, in the repository's root.
fn command(line: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lsys"));
    command.args(line.split(' ')).current_dir(root()).stdin(Stdio::null());
    command
}

/// Runs `script` in a shell; `$lsys` is the program.
#[cfg(unix)]
fn shell(script: &str) -> Output {
    let mut command = Command::new("sh");
    command.args(["-c", script]).env("lsys", env!("CARGO_BIN_EXE_lsys")).current_dir(root()).stdin(Stdio::null());
    command.output().expect("a shell")
}

fn run(line: &str) -> Output {
    command(line).output().expect("lsys starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("readable").flatten();
    entries.map(|entry| entry.file_name().display().to_string()).collect()
}

/// Control characters of terminals, and characters that change the direction of text.
const ORDERS: &str = "\u{1b}]0;owned\u{7}\u{8}\r\u{7f}\u{9b}31m\u{85}\u{202e}\u{2066}\u{200f}\u{2028}";

/// Checks that `text` has no character of [`ORDERS`].
fn assert_harmless(text: &str) {
    let harm = text.chars().find(|&ch| ch != '\n' && (ch.is_control() || ORDERS[ORDERS.len() - 14..].contains(ch)));
    assert_eq!(harm, None, "{text:?}");
}

/// A file with [`ORDERS`] in every text.
fn hostile_file(folder: &TempDir) -> String {
    let file = folder.path().join("hostile.json");
    let orders = ORDERS;
    let system = serde_json::json!({
        "name": orders, "title": orders, "source": orders, "notes": orders,
        "initial": format!("F`\u{1b}``\u{9b}`]"),
        "rules": ["F -> F+F", format!("`\u{7}` -> F"), format!("{orders} nothing")],
        orders: 1,
        "turtle": {"dialect": orders, "overrides": {"\u{1b}": "draw", "G": orders}},
        "style": {"palette": [orders], "colour_by": orders},
    });
    fs::write(&file, system.to_string()).expect("a file");
    file.display().to_string()
}

#[test]
fn escape_sequences_of_a_file_reach_no_terminal() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = hostile_file(&folder);
    for line in ["info", "expand", "draw --format svg", "info --json"] {
        let output = run(&format!("{line} {file}"));
        assert_eq!(output.status.code(), Some(1), "{line}");
        assert!(text(&output.stderr).contains('␛'), "{line}");
        assert_harmless(&text(&output.stderr));
        assert_harmless(&text(&output.stdout));
    }
    let good = folder.path().join("good.json");
    let system = serde_json::json!({"name": ORDERS, "title": ORDERS, "initial": "F"});
    fs::write(&good, system.to_string()).expect("a file");
    let facts = run(&format!("info {}", good.display()));
    assert!(text(&facts.stdout).starts_with("␛]0;owned␇␈␍␡\u{fffd}31m"), "{}", text(&facts.stdout));
    assert_harmless(&text(&facts.stdout));
    // In JSON the title keeps every character.
    let facts = run(&format!("info --json {}", good.display()));
    assert_harmless(&text(&facts.stdout));
    let facts: serde_json::Value = serde_json::from_slice(&facts.stdout).expect("JSON");
    assert_eq!(facts["title"], ORDERS);
}

#[test]
fn escape_sequences_of_arguments_are_shown() {
    for line in
        ["info \u{1b}[2J\u{202e}.json", "draw \u{9b}.json --format \u{1b}c", "info x --set \u{1b}", "info -n \u{7}"]
    {
        let output = run(line);
        assert_ne!(output.status.code(), Some(0), "{line:?}");
        assert_harmless(&text(&output.stderr));
    }
}

#[test]
fn settings_that_make_no_sense_are_shown() {
    let output = run("info data_in/abop/1.24a.json --set width=\u{1b}[31m");
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("␛[31m"));
    assert_harmless(&text(&output.stderr));
}

#[test]
fn files_of_any_size_are_refused_soon() {
    let folder = tempfile::tempdir().expect("a folder");
    // A sparse file of ten gigabytes takes no disk space.
    for start in ["", "{\"initial\": \"F\"", "<svg", "\u{89}PNG"] {
        let path = folder.path().join("large");
        let mut file = File::create(&path).expect("a file");
        file.write_all(start.as_bytes()).expect("written");
        file.set_len(10 << 30).expect("a file with holes");
        let output = run(&format!("info {}", path.display()));
        assert_eq!(output.status.code(), Some(1), "{start}");
        assert!(output.stdout.is_empty() && text(&output.stderr).starts_with("error: "), "{start}");
        assert_harmless(&text(&output.stderr));
    }
}

#[cfg(target_os = "linux")]
#[test]
fn streams_without_end_are_refused_soon() {
    for (script, what) in [
        ("$lsys info /dev/zero", "a device"),
        ("$lsys info - < /dev/zero", "standard input"),
        ("yes '[[[[' | $lsys info -", "a pipe"),
        ("ulimit -v 1000000; (printf '<svg>'; cat /dev/zero) | $lsys info -", "a picture"),
    ] {
        let output = shell(script);
        assert_eq!(output.status.code(), Some(1), "{what}: {}", text(&output.stderr));
        assert!(text(&output.stderr).starts_with("error: "), "{what}");
    }
}

#[cfg(unix)]
#[test]
fn closed_output_is_a_failure() {
    for words in ["info data_in/abop/1.24d.json", "expand data_in/abop/1.24d.json -n 1", "--help"] {
        let output = shell(&format!("$lsys {words} >&-"));
        assert_eq!(text(&output.stderr), "error: standard output: closed\n", "{words}");
        assert_eq!(output.status.code(), Some(1), "{words}");
        // Output to `/dev/null` on purpose is no failure.
        for nowhere in [shell(&format!("$lsys {words} > /dev/null")), shell(&format!("$lsys {words} | head -c 1"))] {
            assert_eq!((text(&nowhere.stderr), nowhere.status.code()), (String::new(), Some(0)), "{words}");
        }
        // Python and Node.js open `/dev/null` so for a program whose output is discarded.
        let null = File::options().read(true).write(true).open("/dev/null").expect("a device");
        assert_eq!(command(words).stdout(null).status().expect("lsys starts").code(), Some(0), "{words}");
    }
    // A command that prints nothing needs no standard output.
    let folder = tempfile::tempdir().expect("a folder");
    let base = folder.path().join("weed").display().to_string();
    assert_eq!(shell(&format!("$lsys draw data_in/abop/1.24a.json {base} >&-")).status.code(), Some(0));
}

#[cfg(unix)]
#[test]
fn files_over_the_limit_of_the_shell_leave_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let base = folder.path().join("weed").display().to_string();
    fs::write(format!("{base}.txt"), "as it was").expect("a file");
    let output = shell(&format!("ulimit -f 8; $lsys draw data_in/abop/1.24d.json {base}"));
    assert!(text(&output.stderr).starts_with(&format!("error: {base}.txt: ")), "{}", text(&output.stderr));
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(names(folder.path()), ["weed.txt"]);
    assert_eq!(fs::read_to_string(format!("{base}.txt")).expect("a text"), "as it was");
    let printed = folder.path().join("printed").display().to_string();
    let output = shell(&format!("ulimit -f 8; $lsys expand data_in/abop/1.24d.json -n 9 > {printed}"));
    assert!(text(&output.stderr).starts_with("error: standard output: "), "{}", text(&output.stderr));
    assert_eq!(output.status.code(), Some(1));
}

#[cfg(unix)]
#[test]
fn signals_leave_nothing() {
    use std::os::unix::process::ExitStatusExt;
    // The program also ignores a signal that this test run was started to ignore, as by `nohup`.
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:")).map_or("0", str::trim);
    let ignored = u64::from_str_radix(mask, 16).expect("a mask of signals");
    let all = [("HUP", 1), ("INT", 2), ("QUIT", 3), ("TERM", 15)];
    for (name, number) in all.into_iter().filter(|(_, number)| ignored >> (number - 1) & 1 == 0) {
        let folder = tempfile::tempdir().expect("a folder");
        let base = folder.path().join("koch").display().to_string();
        // The string is written quickly; the picture takes long.
        let line = format!("draw data_in/curves/koch-snowflake.json {base} -n 9");
        let mut child = command(&line).stderr(Stdio::null()).spawn().expect("lsys starts");
        while names(folder.path()).is_empty() {
            std::thread::yield_now();
        }
        let kill = Command::new("kill").args(["-s", name, &child.id().to_string()]).status().expect("kill");
        assert!(kill.success());
        // The exit status names the signal, so that a shell can stop its loop.
        assert_eq!(child.wait().expect("ends").signal(), Some(number), "{name}");
        assert_eq!(names(folder.path()), [""; 0], "{name}");
    }
}

#[cfg(unix)]
#[test]
fn a_signal_leaves_only_whole_files_of_many() {
    use std::os::unix::process::ExitStatusExt;
    let folder = tempfile::tempdir().expect("a folder");
    let base = folder.path().display();
    let line = format!("draw data_in/curves/koch-snowflake.json data_in/abop/1.27.json --out-dir {base} -n 9");
    let mut child = command(&line).stderr(Stdio::null()).spawn().expect("lsys starts");
    while names(folder.path()).is_empty() {
        std::thread::yield_now();
    }
    let kill = Command::new("kill").args(["-s", "TERM", &child.id().to_string()]).status().expect("kill");
    assert!(kill.success());
    assert_eq!(child.wait().expect("ends").signal(), Some(15));
    assert!(!names(folder.path()).iter().any(|name| name.ends_with(".tmp")), "{:?}", names(folder.path()));
}

#[cfg(target_os = "linux")]
#[test]
fn ignored_signals_stay_ignored() {
    let folder = tempfile::tempdir().expect("a folder");
    let base = folder.path().join("koch").display().to_string();
    let script = format!(
        "trap '' HUP; $lsys draw data_in/curves/koch-snowflake.json {base} -n 8 & \
         while [ -z \"$(ls -A {})\" ]; do :; done; kill -s HUP $!; wait $!",
        folder.path().display()
    );
    assert_eq!(shell(&script).status.code(), Some(0));
    assert_eq!(names(folder.path()).len(), 2);
}

#[cfg(unix)]
#[test]
fn files_have_the_usual_permissions() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().expect("a folder");
    let base = folder.path().join("weed").display().to_string();
    assert_eq!(
        shell(&format!("umask 027; $lsys draw data_in/abop/1.24a.json {base} --format csv")).status.code(),
        Some(0)
    );
    let mode = fs::metadata(format!("{base}.csv")).expect("is there").permissions().mode();
    assert_eq!(mode & 0o777, 0o640);
}

#[test]
fn a_drawing_stays_within_the_memory_that_it_may_take() {
    let folder = tempfile::tempdir().expect("a folder");
    let draw = |memory: &str| {
        let to = folder.path().join("tree");
        run(&format!("draw data_in/abop/1.27.json {} --format svg -n 8 --memory {memory}", to.display()))
    };
    let refused = draw("1M");
    assert_eq!(refused.status.code(), Some(1));
    assert!(text(&refused.stderr).contains("memory"), "{}", text(&refused.stderr));
    assert!(names(folder.path()).is_empty());
    assert_eq!(draw("1G").status.code(), Some(0));
}
