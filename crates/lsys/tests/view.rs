//! `lsys FILE` and `lsys link` as a user and as hostile pages meet them. The browser's side: `www/test/e2e/served.test.mjs`.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdout, Command, Output, Stdio};
use std::thread::ScopedJoinHandle;
use tempfile::TempDir;

const PLANT: &str =
    r#"{"name": "p", "initial": "F", "rules": ["F -> F[+F]F"], "angle_deg": 25, "num_iters": 3, "turtle": {}}"#;
const LINK: &str = "#v=1&axiom=F&rules=F%20-%3E%20F%5B+F%5DF&n=3&angle=25&name=p";
/// What the program needs of a playground in a single file.
pub(crate) const PAGE: &str = "<!doctype html>\n<html><head><meta http-equiv=\"Content-Security-Policy\" \
                    content=\"default-src 'none'; img-src blob:\"></head><body></body></html>";

fn program(words: &[&Path]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lsys"));
    command.env("LC_ALL", "C");
    command.args(words).stdin(Stdio::null());
    command
}

/// A file, and the program that shows it.
struct Shown {
    folder: TempDir,
    program: Child,
    /// Kept open, as a closed pipe would end the program.
    _out: BufReader<ChildStdout>,
    port: u16,
    token: String,
}

impl Shown {
    fn new(name: &str, text: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let [file, page] = [name, "page.html"].map(|name| folder.path().join(name));
        fs::write(&file, text).unwrap();
        fs::write(&page, PAGE).unwrap();
        Self::of(folder, &file, &page)
    }

    fn of(folder: TempDir, file: &Path, page: &Path) -> Self {
        Self::started(&mut program(&[file, Path::new("--no-browser"), Path::new("--page"), page]), folder)
    }

    fn started(command: &mut Command, folder: TempDir) -> Self {
        let mut program = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap();
        let mut out = BufReader::new(program.stdout.take().unwrap());
        let mut line = String::new();
        out.read_line(&mut line).unwrap();
        let (port, token) = line.trim().strip_prefix("http://127.0.0.1:").unwrap().split_once('/').unwrap();
        let token = token.strip_suffix('/').unwrap().to_owned();
        Self { port: port.parse().unwrap(), token, folder, program, _out: out }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Sends a request as it is, and returns the status and the whole answer.
    fn send(&self, request: &str) -> (u16, String) {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        // The server may answer and close before it has read everything.
        let _ = stream.write_all(request.as_bytes());
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        let answer = String::from_utf8_lossy(&answer).into_owned();
        let status = answer.split(' ').nth(1).and_then(|status| status.parse().ok());
        (status.unwrap_or_else(|| panic!("no status: {answer:?}")), answer)
    }

    /// Requests a path below the token, with these headers.
    fn ask(&self, method: &str, path: &str, headers: &str, body: &str) -> (u16, String) {
        let Self { port, token, .. } = self;
        let length = body.len();
        self.send(&format!(
            "{method} /{token}{path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nConnection: close\r\n{headers}\
             Content-Length: {length}\r\n\r\n{body}"
        ))
    }

    /// Saves as the page does, over this version.
    fn save(&self, link: &str, version: &str) -> (u16, String) {
        self.save_to("/file", link, version)
    }

    fn save_to(&self, path: &str, link: &str, version: &str) -> (u16, String) {
        let origin = format!("Origin: http://127.0.0.1:{}\r\nIf-Match: \"{version}\"\r\n", self.port);
        self.ask("PUT", path, &origin, link)
    }

    fn state(&self) -> serde_json::Value {
        state(&self.ask("GET", "/file", "", "").1)
    }

    fn version(&self) -> String {
        self.state()["version"].as_str().unwrap().to_owned()
    }
}

impl Drop for Shown {
    fn drop(&mut self) {
        let _ = self.program.kill();
        let _ = self.program.wait();
    }
}

/// The JSON in an answer.
fn state(answer: &str) -> serde_json::Value {
    let (_, body) = answer.split_once("\r\n\r\n").unwrap();
    let json = &body[body.find('{').unwrap()..=body.rfind('}').unwrap()];
    serde_json::from_str(json).unwrap_or_else(|error| panic!("{error}: {answer}"))
}

#[test]
fn the_page_names_the_file_and_may_ask_its_own_server_only() {
    let shown = Shown::new("a & \"b\".json", PLANT);
    let (status, answer) = shown.ask("GET", "/", "", "");
    assert_eq!(status, 200);
    for part in [
        "content=\"default-src 'none'; connect-src 'self'; img-src blob:\"",
        "<meta name=\"lsys-file\" content=\"a &amp; &quot;b&quot;.json\" data-version=\"",
        &format!("data-link=\"{}\">\n</head>", LINK.replace('&', "&amp;")),
        "referrer-policy: no-referrer\r\n",
        "x-frame-options: DENY\r\n",
        "cache-control: no-store\r\n",
    ] {
        assert!(answer.contains(part), "{part}\n{answer}");
    }
    assert!(!answer.to_lowercase().contains("access-control"), "no other page may read answers");
    assert_eq!(shown.state()["link"], LINK);
}

#[test]
fn only_the_whole_address_is_answered() {
    let shown = Shown::new("plant.json", PLANT);
    let Shown { port, token, .. } = &shown;
    let get = |path: &str, host: &str| shown.send(&format!("GET {path} HTTP/1.1\r\n{host}Connection: close\r\n\r\n")).0;
    let own = format!("Host: 127.0.0.1:{port}\r\n");
    assert_eq!(get(&format!("/{token}/"), &own), 200);
    assert_eq!(get(&format!("/{token}/?a=b"), &own), 200);
    assert_eq!(get(&format!("/{token}/"), &format!("Host: localhost:{port}\r\n")), 200);
    let wrong = format!("/{}/", "0".repeat(32));
    let paths = ["", "..", "file/", "page.html", "plant.json", "../page.html", "%2e%2e/page.html", "..%2fpage.html"];
    let inside = paths.iter().skip(1).map(|path| format!("/{token}/{path}"));
    let outside = ["/", "/file", "//", "/plant.json", "/../page.html", "/%2e%2e/page.html", &wrong];
    let near = [format!("/{token}"), format!("/{token}x/"), format!("/{}", &token[1..])];
    for path in inside.chain(outside.map(str::to_owned)).chain(near) {
        assert_eq!(get(&path, &own), 404, "{path}");
    }
    for host in [
        String::new(),
        "Host: evil.example\r\n".to_owned(),
        format!("Host: evil.example:{port}\r\n"),
        "Host: 127.0.0.1\r\n".to_owned(),
        format!("Host: 127.0.0.1:{port}.evil.example\r\n"),
        format!("{own}Host: evil.example\r\n"),
    ] {
        assert_eq!(get(&format!("/{token}/"), &host), 403, "{host}");
    }
    for method in ["POST", "DELETE", "HEAD", "OPTIONS", "PATCH", "HOP"] {
        assert_eq!(shown.ask(method, "/file", "", "").0, 405, "{method}");
    }
    assert_eq!(shown.ask("PUT", "/", "", "").0, 405);
    // Other addresses of this machine are not bound.
    assert!(TcpStream::connect(("127.0.0.2", *port)).is_err());
}

#[test]
fn only_the_page_saves_and_only_systems() {
    let shown = Shown::new("plant.json", PLANT);
    let (port, version) = (shown.port, shown.version());
    let tag = format!("If-Match: \"{version}\"\r\n");
    for origin in [
        String::new(),
        "Origin: null\r\n".to_owned(),
        "Origin: https://evil.example\r\n".to_owned(),
        format!("Origin: http://127.0.0.1:{}\r\n", port ^ 1),
        format!("Origin: http://localhost:{port}\r\n"),
    ] {
        assert_eq!(shown.ask("PUT", "/file", &format!("{origin}{tag}"), LINK).0, 403, "{origin}");
    }
    let own = format!("Origin: http://127.0.0.1:{port}\r\n");
    assert_eq!(shown.ask("PUT", "/file", &own, LINK).0, 428);
    for (body, status) in [("", 400), ("hello", 400), ("{}", 400), ("#v=1&n=x", 400), ("#v=1&z=abc", 400)] {
        assert_eq!(shown.save(body, &version).0, status, "{body}");
    }
    let long = format!("#v=1&axiom={}", "F".repeat(8 << 20));
    assert_eq!(shown.save(&long, &version).0, 413);
    let chunk = format!("{own}{tag}Transfer-Encoding: chunked\r\n");
    let body = format!("{:x}\r\n{long}\r\n0\r\n\r\n", long.len());
    assert_eq!(shown.ask("PUT", "/file", &chunk, &body).0, 413);
    assert_eq!(fs::read_to_string(shown.path("plant.json")).unwrap(), PLANT);

    let (status, answer) = shown.save(&LINK.replace("n=3", "n=5"), &version);
    assert_eq!((status, state(&answer)["link"].as_str()), (200, Some(&*LINK.replace("n=3", "n=5"))));
    // Only the new value is written.
    assert_eq!(fs::read_to_string(shown.path("plant.json")).unwrap(), PLANT.replace(": 3", ": 5"));
    assert_eq!(names(&shown), ["page.html", "plant.json"]);
}

#[test]
fn a_change_elsewhere_is_never_overwritten_unseen() {
    let shown = Shown::new("plant.json", PLANT);
    let file = shown.path("plant.json");
    let version = shown.version();
    let other = PLANT.replace("25", "70");
    fs::write(&file, &other).unwrap();
    let (status, answer) = shown.save(LINK, &version);
    assert_eq!(status, 412);
    assert_eq!(state(&answer)["link"], LINK.replace("25", "70"));
    assert_eq!(fs::read_to_string(&file).unwrap(), other);

    fs::remove_file(&file).unwrap();
    let gone = shown.state();
    assert_eq!((&gone["version"], &gone["problems"]), (&"missing".into(), &"plant.json is not there any more.".into()));
    assert_eq!(shown.save(LINK, &version).0, 412);
    assert!(!file.exists());
    assert_eq!(shown.save(LINK, "missing").0, 200);
    assert_eq!(shown.state()["link"], LINK);
}

#[test]
fn those_who_wait_hear_of_the_next_change() {
    let shown = Shown::new("plant.json", PLANT);
    let version = shown.version();
    // A known version without waiting, and an unknown one with it, are answered at once.
    let wait =
        |version: &str| shown.ask("GET", "/file", &format!("If-None-Match: \"{version}\"\r\nPrefer: wait=25\r\n"), "");
    assert_eq!(state(&wait("other").1)["version"].as_str(), Some(&*version));
    for text in [PLANT.replace("25", "30"), "{".to_owned(), PLANT.to_owned()] {
        let before = shown.version();
        let heard = std::thread::scope(|scope| {
            let heard = scope.spawn(|| wait(&before).1);
            // As editors save: a new file in place of the old one.
            fs::write(shown.path("plant.json~"), &text).unwrap();
            fs::rename(shown.path("plant.json~"), shown.path("plant.json")).unwrap();
            state(&heard.join().unwrap())
        });
        assert_ne!(heard["version"].as_str(), Some(&*before));
        let problems = heard["problems"].as_str().unwrap();
        assert_eq!(problems.contains("--> plant.json:1:"), text == "{", "{problems}");
        assert_eq!(heard["link"].is_null(), text == "{");
    }
}

#[test]
fn files_that_cannot_be_written_say_so() {
    let shown = Shown::new("koch.l", "Koch {\n angle 6\n axiom F\n F=F+F--F+F\n}\n");
    assert!(shown.state()["refusal"].as_str().unwrap().contains("another program"));
    let (status, answer) = shown.save(LINK, &shown.version());
    assert!(status == 500 && answer.contains("save a JSON file"), "{answer}");

    let shown = Shown::new("plant.json", PLANT);
    let file = shown.path("plant.json");
    let mut permissions = fs::metadata(&file).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&file, permissions).unwrap();
    let (status, answer) = shown.save(LINK, &shown.version());
    assert!(status == 500 && answer.contains("plant.json: this file is read-only"), "{answer}");
    assert_eq!(fs::read_to_string(&file).unwrap(), PLANT);
}

#[cfg(unix)]
#[test]
fn a_link_is_kept_and_its_file_written() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("real.json");
    fs::write(&file, PLANT).unwrap();
    let shown = {
        let link = folder.path().join("link.json");
        std::os::unix::fs::symlink(&file, &link).unwrap();
        let page = folder.path().join("page.html");
        fs::write(&page, PAGE).unwrap();
        Shown::of(folder, &link, &page)
    };
    assert_eq!(shown.save(&LINK.replace("n=3", "n=4"), &shown.version()).0, 200);
    assert!(fs::read_to_string(&file).unwrap().contains("\"num_iters\": 4"));
    assert!(shown.path("link.json").is_symlink());
}

/// The most memory that a program has had, in KiB.
#[cfg(target_os = "linux")]
fn peak(shown: &Shown) -> u64 {
    let status = fs::read_to_string(format!("/proc/{}/status", shown.program.id())).unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap();
    line.split_whitespace().next().unwrap().parse().unwrap()
}

/// What another user of the machine can send without the token.
#[cfg(target_os = "linux")]
#[test]
fn endless_requests_take_no_memory() {
    let shown = Shown::new("plant.json", PLANT);
    let before = peak(&shown);
    let get = format!("GET / HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n", shown.port);
    let piece = "x".repeat(1 << 20);
    let fields = "a: b\r\n".repeat(1 << 17);
    for (head, piece) in [
        (&*get, &*fields),
        ("GET /", &piece),
        (&format!("{get}a: "), &piece),
        (&format!("{get}a"), &piece),
        ("", &piece),
        (&get.replace("GET", "PUT").replace("1.1\r\n", "1.1\r\nTransfer-Encoding: chunked\r\n\r\nffffff\r\n"), &piece),
    ] {
        let mut stream = TcpStream::connect(("127.0.0.1", shown.port)).unwrap();
        let _ = stream.write_all(head.as_bytes());
        let sent = (0..64).take_while(|_| stream.write_all(piece.as_bytes()).is_ok()).count();
        assert!(sent < 64, "{head} goes on without end");
    }
    let silent: Vec<_> = (0..150).map(|_| TcpStream::connect(("127.0.0.1", shown.port)).unwrap()).collect();
    silent.iter().for_each(|mut stream| drop(stream.write_all(get.as_bytes())));
    // Those who say nothing more lose their places.
    assert_eq!(shown.ask("GET", "/", "", "").0, 200);
    let more = peak(&shown) - before;
    assert!(more < 32 << 10, "{more} KiB more");
}

/// Files and saves with the address, within 512 MiB of addresses.
#[cfg(target_os = "linux")]
#[test]
fn the_worst_files_and_saves_take_no_more_than_they_may() {
    let packed = |text: &str| format!("#v=1&z={}", lsystem::files::packed::pack(text.as_bytes()));
    let saves = [
        format!("#v=1&{}", "a=&".repeat(666_000)),
        packed(&"a=&".repeat(1_390_000)),
        packed(&format!("axiom={}", "F".repeat(1 << 20))),
        packed(&format!("axiom=F&rules={}", "a -> b%0A".repeat(100_000))),
        "\u{1f33f}".repeat(4 << 20),
    ];
    const MAX: usize = (4 << 20) - 200;
    let with = |more: String| PLANT.replace("\"p\"", &format!("\"p\", {more}"));
    for file in [
        PLANT.to_owned(),
        format!("{}{PLANT}", "//\n".repeat(MAX / 3)),
        with(format!("\"a\": [{}0]", "0,".repeat(MAX / 2))),
        with(format!("{}\"a\": 0", "\"a\":[],".repeat(MAX / 7))),
    ] {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("plant.json"), &file).unwrap();
        fs::write(folder.path().join("page.html"), PAGE).unwrap();
        let script = "ulimit -v 524288; exec \"$0\" plant.json --no-browser --page page.html";
        let mut command = Command::new("sh");
        command.args(["-c", script, env!("CARGO_BIN_EXE_lsys")]).current_dir(folder.path());
        let shown = Shown::started(command.env("LC_ALL", "C").stdin(Stdio::null()), folder);
        for save in saves.iter().map(String::as_str).chain([LINK]) {
            for path in ["/file", "/file?whole"] {
                let (status, answer) = shown.save_to(path, save, &shown.version());
                assert!([200, 400, 409, 413].contains(&status), "{answer}");
            }
        }
        assert_eq!(shown.state()["link"], LINK);
    }
}

/// Requests of any pieces: the program goes on, and the file has a system.
#[test]
fn random_requests_leave_the_program_and_the_file() {
    use proptest::collection::vec;
    use proptest::prelude::*;
    use proptest::sample::select;
    let shown = Shown::new("plant.json", PLANT);
    let Shown { port, token, .. } = &shown;
    let pieces: Vec<String> = [
        "GET ",
        "PUT ",
        "POST ",
        "/",
        "/file",
        "/file?whole",
        " HTTP/1.1\r\n",
        " HTTP/1.0\r\n",
        " HTTP/9\r\n",
        "\r\n",
        "\n",
        "\0",
        "Connection: close\r\n",
        "Connection: upgrade\r\nUpgrade: h2c\r\n",
        "Content-Length: 5\r\n",
        "Content-Length: -1\r\n",
        "Content-Length: 99999999999999999999\r\n",
        "Transfer-Encoding: chunked\r\n",
        "5\r\nhello\r\n",
        "0\r\n\r\n",
        "ffffffffffffffff\r\n",
        "If-Match: \"x\"\r\n",
        "If-None-Match: \"\r\n",
        "Prefer: wait=99999999999\r\n",
        "Expect: 100-continue\r\n",
        "a: \u{e9}\r\n",
        ": \r\n",
        " folded\r\n",
        "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n",
        LINK,
    ]
    .map(str::to_owned)
    .into_iter()
    .chain([
        format!("/{token}/file"),
        format!("/{token}/"),
        format!("http://127.0.0.1:{port}/{token}/"),
        format!("Host: 127.0.0.1:{port}\r\n"),
        format!("Origin: http://127.0.0.1:{port}\r\n"),
        format!("PUT /{token}/file?whole HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nOrigin: http://127.0.0.1:{port}\r\n"),
        format!("If-Match: \"{}\"\r\nContent-Length: {}\r\n\r\n{LINK}", shown.version(), LINK.len()),
        "y".repeat(20_000),
    ])
    .collect();
    let requests = (vec(select(pieces), 1..12), vec((any::<prop::sample::Index>(), any::<u8>()), 0..2));
    let config =
        ProptestConfig { cases: test_effort::cases() / 2, failure_persistence: None, ..ProptestConfig::default() };
    let tried = proptest::test_runner::TestRunner::new(config).run(&requests, |(pieces, damage)| {
        let mut request = pieces.concat().into_bytes();
        for (place, byte) in damage {
            let place = place.index(request.len());
            request[place] = byte;
        }
        let mut stream = TcpStream::connect(("127.0.0.1", *port)).unwrap();
        let _ = stream.write_all(&request);
        let _ = stream.shutdown(std::net::Shutdown::Write);
        let _ = stream.read_to_end(&mut Vec::new());
        prop_assert!(shown.state()["link"].is_string());
        Ok(())
    });
    tried.unwrap();
}

/// The names in the folder.
fn names(shown: &Shown) -> Vec<String> {
    let entries = fs::read_dir(shown.folder.path()).unwrap();
    let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_file_that_cannot_be_edited_is_told_first_and_kept() {
    let text = PLANT.replace("[\"F -> F[+F]F\"]", "{\"F\": [{\"p\": 1, /* always */ \"e\": \"FF\"}]}");
    let shown = Shown::new("plant.json", &text);
    let file = shown.path("plant.json");
    let version = shown.version();
    let link = LINK.replace("F%5B+F%5DF", "F%282%29");
    let (status, answer) = shown.save(&link, &version);
    assert!(status == 409 && answer.contains("A copy of the former file"), "{answer}");
    assert_eq!(fs::read_to_string(&file).unwrap(), text);
    assert_eq!(names(&shown), ["page.html", "plant.json"]);

    fs::write(shown.path("plant.json.before-1"), "of somebody else").unwrap();
    let (status, answer) = shown.save_to("/file?whole", &link, &version);
    assert_eq!((status, state(&answer)["kept"].as_str()), (200, Some("plant.json.before-2")));
    assert_eq!(fs::read_to_string(shown.path("plant.json.before-1")).unwrap(), "of somebody else");
    assert_eq!(fs::read_to_string(shown.path("plant.json.before-2")).unwrap(), text);
    assert_eq!(state(&answer)["link"], link);

    // Broken files, too.
    fs::write(&file, "{\"initial\": \"F\", ").unwrap();
    let version = shown.version();
    assert_eq!(shown.save(LINK, &version).0, 409);
    assert_eq!(shown.save_to("/file?whole", LINK, &version).0, 200);
    assert_eq!(fs::read_to_string(shown.path("plant.json.before-3")).unwrap(), "{\"initial\": \"F\", ");
    assert_eq!(names(&shown).len(), 5);
}

#[test]
fn a_file_that_is_too_long_is_never_replaced() {
    let shown = Shown::new("plant.json", PLANT);
    let file = shown.path("plant.json");
    let long = format!("{PLANT}{}", " ".repeat((8 << 20) + 100));
    fs::write(&file, &long).unwrap();
    let found = shown.state();
    assert!(found["refusal"].as_str().unwrap().contains("too long"), "{found}");
    let version = found["version"].as_str().unwrap();
    for path in ["/file", "/file?whole"] {
        assert_eq!(shown.save_to(path, LINK, version).0, 500);
    }
    assert!(fs::read(&file).unwrap() == long.as_bytes());
    // One byte more, behind what is read.
    fs::write(&file, long + " ").unwrap();
    assert_ne!(shown.version(), version);
}

/// A full disk, as far as a program can tell: no file may be longer than a block.
#[cfg(unix)]
#[test]
fn without_space_the_former_file_stays() {
    let folder = tempfile::tempdir().unwrap();
    let [file, page] = ["plant.json", "page.html"].map(|name| folder.path().join(name));
    fs::write(&file, PLANT).unwrap();
    fs::write(&page, PAGE).unwrap();
    let mut command = Command::new("sh");
    command.args(["-c", "ulimit -f 1; exec \"$0\" \"$@\"", env!("CARGO_BIN_EXE_lsys")]);
    let shown = Shown::started(command.args([&file, Path::new("--no-browser"), Path::new("--page"), &page]), folder);
    let notes = format!("{LINK}&notes={}", "long%20".repeat(500));
    let (status, answer) = shown.save(&notes, &shown.version());
    assert!(status == 500 && answer.contains("plant.json: "), "{answer}");
    assert_eq!(fs::read_to_string(&file).unwrap(), PLANT);
    assert_eq!(names(&shown), ["page.html", "plant.json"]);
    assert_eq!(shown.save(&LINK.replace("n=3", "n=4"), &shown.version()).0, 200);
}

/// Two programs that show one file, in a folder with the page.
fn two() -> (PathBuf, [Shown; 2]) {
    let folder = tempfile::tempdir().unwrap();
    let [file, page] = ["plant.json", "page.html"].map(|name| folder.path().join(name));
    fs::write(&file, PLANT).unwrap();
    fs::write(&page, PAGE).unwrap();
    let other = Shown::of(tempfile::tempdir().unwrap(), &file, &page);
    (file.clone(), [other, Shown::of(folder, &file, &page)])
}

/// Saves one more than the count in the file. Returns whether that was possible.
fn count(shown: &Shown) -> bool {
    let state = shown.state();
    let link = state["link"].as_str().unwrap();
    let seed = link.split('&').find_map(|part| part.strip_prefix("seed="));
    let next = seed.map_or(1, |seed| seed.parse::<u32>().unwrap() + 1);
    let others: Vec<&str> = link.split('&').filter(|part| !part.starts_with("seed=")).collect();
    let (status, answer) = shown.save(&format!("{}&seed={next}", others.join("&")), state["version"].as_str().unwrap());
    assert!(matches!(status, 200 | 412), "{answer}");
    status == 200
}

/// How often each of four tabs saves.
fn rounds() -> usize {
    if test_effort::is_thorough() { 250 } else { 20 }
}

#[test]
fn programs_that_save_at_once_lose_nothing() {
    let (file, programs) = two();
    let saved: usize = std::thread::scope(|scope| {
        let tabs = programs.iter().cycle().take(4);
        let tabs: Vec<_> = tabs.map(|tab| scope.spawn(|| (0..rounds()).filter(|_| count(tab)).count())).collect();
        tabs.into_iter().map(|tab| tab.join().unwrap()).sum()
    });
    let text = fs::read_to_string(file).unwrap();
    assert!(saved > 0 && text.contains(&format!("\"seed\": {saved}")), "{saved} saved: {text}");
}

/// An editor that puts a new file in place of the old one, as most do.
#[test]
fn what_an_editor_saves_is_never_replaced_unseen() {
    let (file, programs) = two();
    let new = programs[0].path("new");
    std::thread::scope(|scope| {
        let tabs = programs.iter().cycle().take(4);
        let tabs: Vec<_> = tabs.map(|tab| scope.spawn(|| (0..rounds()).for_each(|_| _ = count(tab)))).collect();
        let mut former = "\"p\"".to_owned();
        for number in 0..10 * rounds() {
            // A program that finds that it may not save may rest before it puts the editor's file back. After the last
            // answer it is there.
            let text = loop {
                let are_done = tabs.iter().all(ScopedJoinHandle::is_finished);
                let text = fs::read_to_string(&file).unwrap();
                if text.contains(&former) {
                    break text;
                }
                assert!(!are_done, "{former} is gone: {text}");
            };
            let next = format!("\"{number}\"");
            fs::write(&new, text.replace(&former, &next)).unwrap();
            fs::rename(&new, &file).unwrap();
            former = next;
        }
    });
}

/// Runs the program, which must end by itself, without output.
fn fails(words: &[&Path]) -> String {
    let Output { stdout, stderr, status } = program(words).output().unwrap();
    assert_eq!((stdout, status.code()), (vec![], Some(1)), "{words:?}");
    String::from_utf8(stderr).unwrap()
}

#[test]
fn what_cannot_be_shown_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let [file, page, broken, absent] =
        ["a.json", "page.html", "broken.json", "absent.json"].map(|name| folder.path().join(name));
    fs::write(&file, PLANT).unwrap();
    fs::write(&page, PAGE).unwrap();
    fs::write(&broken, "{\"initial\": \"F\"").unwrap();
    let [quiet, with, at] = ["--no-browser", "--page", "--port"].map(Path::new);
    let failure = |file: &Path| fails(&[file, quiet, with, &page]);
    assert!(failure(&absent).contains("absent.json: No such file") || cfg!(windows));
    assert!(failure(folder.path()).contains("this is not a file"));
    assert!(failure(&broken).contains("broken.json:1:"), "{}", failure(&broken));
    assert_eq!(failure(Path::new("-")), "error: standard input cannot be followed: give a file\n");
    assert!(fails(&[&file, quiet, with, &file]).contains("this is not playground.html"));
    fs::write(&page, "<!doctype html><html><head></head></html>").unwrap();
    assert_eq!(failure(&file), "error: the page is not the playground in a single file\n");
    fs::write(&page, PAGE).unwrap();
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    let words = fails(&[&file, quiet, with, &page, at, Path::new(&port)]);
    assert!(words.starts_with(&format!("error: port {port}: ")) && words.contains("leave out --port"), "{words}");
    // A release build may carry the page.
    if cfg!(debug_assertions) {
        assert!(fails(&[&file, quiet]).contains("built without its pages: build it by `cargo xtask program`"));
    }
}

#[test]
fn links_are_printed() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.json");
    fs::write(&file, PLANT).unwrap();
    let print = |words: &[&str]| {
        let words: Vec<&Path> = ["link"].iter().chain(words).map(Path::new).collect();
        let output = program(&words).arg(&file).output().unwrap();
        assert_eq!((&*output.stderr, output.status.code()), (&b""[..], Some(0)));
        String::from_utf8(output.stdout).unwrap()
    };
    assert_eq!(print(&[]), format!("{LINK}\n"));
    assert_eq!(print(&["-n", "5"]), format!("{}\n", LINK.replace("n=3", "n=5")));
    assert_eq!(print(&["--page", "https://example.org/l/#x"]), format!("https://example.org/l/{LINK}\n"));
}
