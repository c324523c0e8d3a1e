//! The program with malicious files, and with outputs that cannot be written.

use crate::program;

use program::{command, output, root};
use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use tempfile::TempDir;

/// Runs `script` in a shell; `$lsys` is the program.
#[cfg(unix)]
fn shell(script: &str) -> Output {
    let mut command = Command::new("sh");
    command.env("LC_ALL", "C");
    command
        .args(["-c", script])
        .env("LC_ALL", "C")
        .env("lsys", env!("CARGO_BIN_EXE_lsys"))
        .current_dir(root())
        .stdin(Stdio::null());
    command.output().expect("a shell")
}

/// The signals that end the program, by name and number.
#[cfg(unix)]
const SIGNALS: [(&str, i32); 4] = [("HUP", 1), ("INT", 2), ("QUIT", 3), ("TERM", 15)];

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

pub(crate) fn names(folder: &Path) -> Vec<String> {
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
        let output = output(&root(), &format!("{line} {file}"));
        assert_eq!(output.status.code(), Some(1), "{line}");
        assert!(text(&output.stderr).contains('␛'), "{line}");
        assert_harmless(&text(&output.stderr));
        assert_harmless(&text(&output.stdout));
    }
    let good = folder.path().join("good.json");
    let system = serde_json::json!({"name": ORDERS, "title": ORDERS, "initial": "F"});
    fs::write(&good, system.to_string()).expect("a file");
    let facts = output(&root(), &format!("info {}", good.display()));
    assert!(text(&facts.stdout).starts_with("␛]0;owned␇␈␍␡\u{fffd}31m"), "{}", text(&facts.stdout));
    assert_harmless(&text(&facts.stdout));
    // In JSON the title keeps every character.
    let facts = output(&root(), &format!("info --json {}", good.display()));
    assert_harmless(&text(&facts.stdout));
    let facts: serde_json::Value = serde_json::from_slice(&facts.stdout).expect("JSON");
    assert_eq!(facts["title"], ORDERS);
}

#[test]
fn escape_sequences_of_arguments_are_shown() {
    for line in
        ["info \u{1b}[2J\u{202e}.json", "draw \u{9b}.json --format \u{1b}c", "info x --set \u{1b}", "info -n \u{7}"]
    {
        let output = output(&root(), line);
        assert_ne!(output.status.code(), Some(0), "{line:?}");
        assert_harmless(&text(&output.stderr));
    }
}

#[test]
fn settings_that_make_no_sense_are_shown() {
    let output = output(&root(), "info data_in/abop/1.24a.json --set width=\u{1b}[31m");
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
        let output = output(&root(), &format!("info {}", path.display()));
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
        assert_eq!(
            command(root(), words.split(' ')).stdout(null).status().expect("lsys starts").code(),
            Some(0),
            "{words}"
        );
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

/// Gives programs that are started from now on the default signals. Those that this test run ignores, as under `nohup`,
/// are caught here: a program ignores only what its parent ignores.
#[cfg(unix)]
pub(crate) fn catch_ignored_signals() {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:")).map_or("0", str::trim);
    let ignored = u64::from_str_radix(mask, 16).expect("a mask of signals");
    for (_, signal) in SIGNALS.into_iter().filter(|(_, signal)| ignored >> (signal - 1) & 1 == 1) {
        signal_hook::flag::register(signal, std::sync::Arc::default()).expect("a signal that can be caught");
    }
}

/// Starts `lsys` with the default signals.
#[cfg(unix)]
fn start(folder: &Path, line: &str) -> Child {
    catch_ignored_signals();
    command(folder, line.split(' ')).stderr(Stdio::null()).spawn().expect("lsys starts")
}

/// Waits until something has been written by a program, which must still run then.
#[cfg(unix)]
fn wait_for(child: &mut Child, is_written: impl Fn() -> bool) {
    while !is_written() {
        assert_eq!(child.try_wait().expect("a state"), None, "the program has ended");
        std::thread::yield_now();
    }
}

/// Ends a program by a signal. Returns the signal of its exit status, which lets a shell stop its loop.
#[cfg(unix)]
fn end(mut child: Child, name: &str) -> Option<i32> {
    use std::os::unix::process::ExitStatusExt;
    let kill = Command::new("kill").args(["-s", name, &child.id().to_string()]).status().expect("kill");
    assert!(kill.success());
    child.wait().expect("ends").signal()
}

#[cfg(unix)]
#[test]
fn signals_leave_nothing() {
    for (name, number) in SIGNALS {
        let folder = tempfile::tempdir().expect("a folder");
        let base = folder.path().join("koch").display().to_string();
        // The string is written quickly; the picture takes long.
        let mut child = start(&root(), &format!("draw data_in/curves/koch-snowflake.json {base} -n 9"));
        wait_for(&mut child, || !names(folder.path()).is_empty());
        assert_eq!(end(child, name), Some(number), "{name}");
        assert_eq!(names(folder.path()), [""; 0], "{name}");
    }
}

#[cfg(unix)]
#[test]
fn a_signal_leaves_only_whole_files_of_many() {
    let folder = tempfile::tempdir().expect("a folder");
    let base = folder.path().display();
    let line = format!("draw data_in/curves/koch-snowflake.json data_in/abop/1.27.json --out-dir {base} -n 9");
    let mut child = start(&root(), &line);
    wait_for(&mut child, || !names(folder.path()).is_empty());
    assert_eq!(end(child, "TERM"), Some(15));
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
        output(&root(), &format!("draw data_in/abop/1.27.json {} --format svg -n 8 --memory {memory}", to.display()))
    };
    let refused = draw("1M");
    assert_eq!(refused.status.code(), Some(1));
    assert!(text(&refused.stderr).contains("memory"), "{}", text(&refused.stderr));
    assert!(names(folder.path()).is_empty());
    assert_eq!(draw("1G").status.code(), Some(0));
}

/// A folder with a system, an exercise and two answers.
pub(crate) fn desk() -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let put = |name: &str, text: &str| fs::write(folder.path().join(name), text).expect("written");
    put("a.json", r#"{"initial": "F", "angle_deg": 60, "num_iters": 2, "rules": {"F": "F+F--F+F"}}"#);
    let target = lsystem::Definition { axiom: "F".into(), rules: "F -> F+F".into(), ..lsystem::Definition::default() };
    let exercise = lsystem::course::Exercise { target, ..lsystem::course::Exercise::default() }.write();
    put("exercise.txt", &format!("#v=1&x={exercise}\n"));
    put("answers.csv", &format!("Ada,#v=1&x={exercise}&rules=F\nMary,#v=1&x={exercise}&rules=F+F\n"));
    folder
}

/// Runs `script` in a shell in `folder`; `$lsys` is the program.
#[cfg(unix)]
pub(crate) fn shell_in(folder: &TempDir, script: &str) -> (Option<i32>, String) {
    let mut command = Command::new("bash");
    let command = command
        .args(["-c", script])
        .env("LC_ALL", "C")
        .env("lsys", env!("CARGO_BIN_EXE_lsys"))
        .current_dir(folder.path());
    let Output { status, stderr, .. } = command.stdin(Stdio::null()).output().expect("a shell");
    (status.code(), text(&stderr))
}

/// All files and links below a folder: their paths and what is in them.
pub(crate) fn contents(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut all = Vec::new();
    for entry in fs::read_dir(folder).expect("readable").flatten() {
        let path = entry.path();
        match fs::read_link(&path) {
            Ok(target) => all.push((path, target.into_os_string().into_encoded_bytes())),
            Err(_) if path.is_dir() => all.extend(contents(&path)),
            Err(_) if path.is_file() => all.push((path.clone(), fs::read(&path).expect("readable"))),
            Err(_) => all.push((path, Vec::new())),
        }
    }
    all.sort();
    all
}

#[cfg(unix)]
#[test]
fn files_of_others_stay_as_they_are() {
    for (prepare, run, why) in [
        // Its own inputs, by other spellings, links and standard input.
        ("", "mark exercise.txt answers.csv --html answers.csv", "is read by the same command"),
        ("", "mark exercise.txt answers.csv --html ./../$(basename $PWD)/answers.csv", "is read by the same command"),
        ("", "mark exercise.txt answers.csv --html exercise.txt", "is read by the same command"),
        ("ln answers.csv hard", "mark exercise.txt answers.csv --html hard", "is read by the same command"),
        ("ln -s answers.csv soft", "mark exercise.txt soft --html answers.csv", "is read by the same command"),
        ("$lsys draw a.json a", "draw a.svg a --format svg", "is read by the same command"),
        ("$lsys draw a.json a", "draw a.svg --out-dir . --format svg", "is read by the same command"),
        ("$lsys draw a.json a", "draw - a --format svg < a.svg", "is read by the same command"),
        ("echo '1;n=0:0,1:2' > f.gif", "animate a.json --film f.gif --to f.gif", "is read by the same command"),
        ("echo 'a {\n axiom F\n F=FF\n}' > b.l", "import . --to .", "is read by the same command"),
        // Links, also to nowhere; what is no file; and files that nobody may write.
        ("ln -s a.json page", "mark exercise.txt answers.csv --html page", "symbolic link"),
        ("ln -s nowhere page", "mark exercise.txt answers.csv --html page", "symbolic link"),
        ("ln -s a.json a.gif", "animate a.json --to a.gif --size 16x16", "symbolic link"),
        ("ln -s exercise.txt a.svg", "draw a.json a", "symbolic link"),
        ("mkdir page", "mark exercise.txt answers.csv --html page", "not a file"),
        ("mkfifo page", "mark exercise.txt answers.csv --html page", "not a file"),
        ("echo old > page; chmod 444 page", "mark exercise.txt answers.csv --html page", "read-only"),
        // Folders that are no pyramids.
        ("mkdir p; echo home > p/index.html", "tiles a.json p --levels 0..0", "there is index.html, but no pyramid"),
        ("mkdir -p p/3", "tiles a.json p --levels 0..0 --scheme xyz", "there is 3, but no pyramid"),
        ("mkdir p; ln -s /dev/zero p/pyramid.json", "tiles a.json p --levels 0..0", "another pyramid"),
        ("mkdir p; mkfifo p/pyramid.json", "tiles a.json p --levels 0..0", "another pyramid"),
        ("mkdir p; ln -s ../a.json p/index.html", "tiles a.json p --levels 0..0", "there is index.html"),
    ] {
        let folder = desk();
        let (code, said) = shell_in(&folder, prepare);
        assert_eq!((code, said.as_str()), (Some(0), ""), "{prepare}");
        let before = contents(folder.path());
        let (code, said) = shell_in(&folder, &format!("$lsys {run}"));
        assert_eq!(code, Some(1), "{prepare}; {run}: {said}");
        assert!(said.contains(why), "{prepare}; {run}: {said}");
        let after = contents(folder.path());
        // The import of a folder writes what replaces nothing.
        let is_whole = before.iter().all(|file| after.contains(file));
        assert!(is_whole && (run.starts_with("import") || before == after), "{prepare}; {run}");
    }
}

#[cfg(unix)]
#[test]
fn folders_that_are_called_like_ours_stay() {
    let folder = desk();
    let (code, said) = shell_in(
        &folder,
        "mkdir -p p/.lsys-notes .lsys-notes; echo work | tee p/.lsys-notes/thesis.txt > .lsys-notes/thesis.txt
         $lsys tiles a.json p --levels 0..0 > /dev/null && $lsys draw a.json a && $lsys tiles a.json p --levels 0..0 > /dev/null",
    );
    assert_eq!((code, said.as_str()), (Some(0), ""));
    for file in ["p/.lsys-notes/thesis.txt", ".lsys-notes/thesis.txt"] {
        assert_eq!(fs::read_to_string(folder.path().join(file)).expect("is there"), "work\n");
    }
}

#[cfg(unix)]
#[test]
fn signals_leave_nothing_of_ours_in_a_pyramid() {
    for (name, number) in SIGNALS {
        let folder = desk();
        let mut child = start(folder.path(), "tiles a.json p --levels 0..20 -n 9");
        wait_for(&mut child, || folder.path().join("p/tiles_files/9").exists());
        assert_eq!(end(child, name), Some(number), "{name}");
        let mut left = names(&folder.path().join("p"));
        left.sort();
        assert_eq!(left, ["index.html", "pyramid.json", "tiles.dzi", "tiles_files"], "{name}");
    }
}

#[cfg(unix)]
#[test]
fn what_a_killed_program_left_is_removed_by_the_next() {
    let folder = desk();
    let mut child = start(folder.path(), "animate a.json --to a.gif -n 9");
    let rest = || names(folder.path()).into_iter().find(|name| name.starts_with(".lsys-"));
    wait_for(&mut child, || rest().is_some_and(|rest| names(&folder.path().join(rest)).len() >= 2));
    // Beside a living program others leave its folder alone.
    assert_eq!(shell_in(&folder, "$lsys draw a.json a"), (Some(0), String::new()));
    assert!(rest().is_some());
    child.kill().expect("killed");
    child.wait().expect("ends");
    assert!(rest().is_some());
    assert_eq!(shell_in(&folder, "$lsys draw a.json a"), (Some(0), String::new()));
    assert_eq!(rest(), None);
}

#[cfg(target_os = "linux")]
#[test]
fn every_input_is_read_to_a_bound() {
    for (run, code, why) in [
        ("$lsys animate a.json --film /dev/urandom --to a.gif", 1, "no text"),
        ("$lsys animate a.json --film /dev/zero --to a.gif", 1, "longer than"),
        ("$lsys animate a.json --film . --to a.gif", 1, "directory"),
        ("$lsys animate a.json --film <(yes) --to a.gif", 1, "longer than"),
        ("$lsys animate a.json --film <(echo '1;0.2s;n=0:0') --to a.gif --size 16x16", 0, ""),
        ("$lsys mark /dev/zero answers.csv", 1, "longer than"),
        ("$lsys mark exercise.txt /dev/zero", 1, "longer than"),
        ("$lsys mark exercise.txt <(yes ,)", 1, "longer than"),
        ("$lsys mark exercise.txt <(cat answers.csv) > /dev/null", 0, ""),
        ("$lsys mark exercise.txt . ", 1, "directory"),
        ("$lsys check a.json /dev/zero", 1, "more than"),
        ("$lsys check a.json <($lsys expand a.json) > /dev/null", 0, ""),
        ("$lsys find /dev/zero", 1, "longer than"),
        ("$lsys find <(echo FFFF) --axiom F -n 1 > /dev/null", 0, ""),
        ("$lsys import /dev/zero --to all", 1, "longer than"),
        ("$lsys import /dev/zero --account", 1, "longer than"),
        ("mkdir in; mkfifo in/pipe; cp a.json in; $lsys import in --to all > /dev/null", 0, ""),
        ("$lsys export /dev/zero --as fractint", 1, ""),
        ("$lsys info --growth /dev/zero", 1, ""),
        ("$lsys tiles /dev/zero p", 1, ""),
    ] {
        let folder = desk();
        let (found, said) = shell_in(&folder, &format!("ulimit -v 2000000; {run}"));
        assert_eq!(found, Some(code), "{run}: {said}");
        assert!(said.contains(why), "{run}: {said}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn work_that_needs_more_memory_than_there_is_is_refused() {
    for (kib, run, code) in [
        (60_000, "animate a.json --to a.gif --size 4096x2048", 1),
        (60_000, "animate a.json --to frames --size 4096x2048", 1),
        (70_000, "animate random.json --to a.gif --size 64x48 --seconds 0.1 --track drawn=0:1", 1),
        (60_000, "draw a.json a --format png --size 10000x10000", 1),
        (60_000, "draw random.json random --format svg", 1),
        (60_000, "draw a.json random.json --out-dir . --format png --size 10000x10000", 1),
        (30_000, "tiles a.json p --levels 0..0", 1),
        // There are no more threads and renderers than cores.
        (500_000, "tiles a.json p --levels 0..1 --threads 60000 > /dev/null", 0),
    ] {
        let folder = desk();
        let random = r#"{"initial": "F", "num_iters": 11, "rules": {"F": [{"p": 0.5, "e": "F+F--F+F"}, {"p": 0.5, "e": "F+FF"}]}}"#;
        fs::write(folder.path().join("random.json"), random).expect("written");
        let (found, said) = shell_in(&folder, &format!("ulimit -v {kib}; $lsys {run}"));
        assert_eq!(found, Some(code), "{run}: {said}");
        assert!(code == 0 || said.starts_with("error: ") && said.contains("memory"), "{run}: {said}");
        assert!(!names(folder.path()).iter().any(|name| name.starts_with(".lsys")), "{run}");
    }
}
