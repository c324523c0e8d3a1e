//! `lsys FILE` and `lsys link` as a user and as hostile pages meet them. The browser's side: `www/test/e2e/served.test.mjs`.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdout, Command, Output, Stdio};
use tempfile::TempDir;

const PLANT: &str =
    r#"{"name": "p", "initial": "F", "rules": ["F -> F[+F]F"], "angle_deg": 25, "num_iters": 3, "turtle": {}}"#;
const LINK: &str = "#v=1&axiom=F&rules=F%20-%3E%20F%5B+F%5DF&n=3&angle=25&name=p";
/// What the program needs of a playground in a single file.
const PAGE: &str = "<!doctype html>\n<html><head><meta http-equiv=\"Content-Security-Policy\" \
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
        let mut command = program(&[file, Path::new("--no-browser"), Path::new("--page"), page]);
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
        let origin = format!("Origin: http://127.0.0.1:{}\r\nIf-Match: \"{version}\"\r\n", self.port);
        self.ask("PUT", "/file", &origin, link)
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
        "Referrer-Policy: no-referrer\r\n",
        "X-Frame-Options: DENY\r\n",
        "Cache-Control: no-store\r\n",
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
    let outside = ["/", "/file", "//", "/plant.json", "/../page.html", "/%2e%2e/page.html", &wrong, &token[1..]];
    for path in inside.chain(outside.map(str::to_owned)).chain([format!("/{token}"), format!("/{token}x/")]) {
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
    let mut names: Vec<_> =
        fs::read_dir(shown.folder.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["page.html", "plant.json"]);
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
