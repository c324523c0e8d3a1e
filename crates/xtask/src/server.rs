//! A local web server for a folder of static files: no caching, no access outside the folder.

use percent_encoding::percent_decode_str;
use std::fs;
use std::io::Cursor;
use std::path::{Component, Path, PathBuf};
use std::sync::{Condvar, Mutex, PoisonError};
use std::thread;
use tiny_http::{Header, Method, Response, StatusCode};

/// A server of the files below `folder` at the addresses below `mount`, which starts and ends with `/`.
pub(crate) struct Server {
    pub(crate) folder: PathBuf,
    pub(crate) mount: &'static str,
    /// Counts the builds, if browsers shall reload after each.
    pub(crate) version: Option<Version>,
}

/// The number of a build, for which browsers wait.
#[derive(Default)]
pub(crate) struct Version {
    number: Mutex<u64>,
    changed: Condvar,
}

impl Version {
    /// Wakes all that wait.
    pub(crate) fn next(&self) {
        *self.number.lock().unwrap_or_else(PoisonError::into_inner) += 1;
        self.changed.notify_all();
    }

    /// Waits for the next build.
    fn wait(&self) {
        let number = self.number.lock().unwrap_or_else(PoisonError::into_inner);
        let before = *number;
        drop(self.changed.wait_while(number, |number| *number == before));
    }
}

/// The address at which a request waits for the next build, below the mount.
const RELOAD: &str = "reload.js";
/// The script that reloads the page after the next build. The answer comes when there is one.
const RELOADER: &str = "location.reload();\n";
/// What is added to pages that shall reload. A script and not a request of the page, since pages may forbid requests.
const RELOADING: &str = "<script src=\"/reload.js\" async></script>";
/// In place of the worker that keeps the page offline: it would answer with the files of an older build.
const FORGETTING: &str = "self.addEventListener('install', () => self.skipWaiting());\n\
                          self.addEventListener('activate', () => self.registration.unregister());\n";

type Answer = Response<Cursor<Vec<u8>>>;

impl Server {
    /// Serves without end.
    pub(crate) fn run(&self, socket: &tiny_http::Server) {
        thread::scope(|scope| {
            for request in socket.incoming_requests() {
                scope.spawn(move || {
                    let answer = self.respond(request.method(), request.url());
                    // Errors are ignored: browsers often close a connection early.
                    _ = request.respond(answer);
                });
            }
        });
    }

    fn respond(&self, method: &Method, target: &str) -> Answer {
        if !matches!(method, Method::Get | Method::Head) {
            return refusal(405, Some(("Allow", "GET, HEAD")));
        }
        let path = target.split(['?', '#']).next().unwrap_or_default();
        let below = path.strip_prefix(self.mount);
        if let (Some(version), Some(RELOAD)) = (&self.version, below) {
            version.wait();
            return answer("text/javascript", RELOADER);
        }
        let Some(mut file) = below.and_then(|path| locate(&self.folder, path)) else {
            return refusal(404, None);
        };
        if file.is_dir() {
            if !path.ends_with('/') {
                // The address of a folder must end in `/`, because relative addresses in the page start from there.
                return refusal(301, Some(("Location", &format!("{path}/"))));
            }
            file.push("index.html");
        }
        let Ok(body) = fs::read(&file) else { return refusal(404, None) };
        let kind = mime_guess::from_path(&file).first_or_octet_stream();
        let charset = if kind.type_() == "text" { "; charset=utf-8" } else { "" };
        let body = if self.version.is_some() { reloading(&file, body) } else { body };
        answer(&format!("{kind}{charset}"), body)
    }
}

/// A file for a browser that reloads after each build. Pages whose policy names their scripts by hash stay as they are.
fn reloading(file: &Path, body: Vec<u8>) -> Vec<u8> {
    if file.ends_with("service-worker.js") {
        return FORGETTING.into();
    }
    if file.extension().is_none_or(|ending| ending != "html") {
        return body;
    }
    String::from_utf8_lossy(&body).replacen("</head>", &format!("{RELOADING}</head>"), 1).into()
}

fn answer(media_type: &str, body: impl Into<Vec<u8>>) -> Answer {
    let headers = [("Content-Type", media_type), ("Cache-Control", "no-cache"), ("X-Content-Type-Options", "nosniff")];
    headers.into_iter().fold(Response::from_data(body), with_header)
}

fn refusal(status: u16, header: Option<(&str, &str)>) -> Answer {
    let status = StatusCode(status);
    let words = answer("text/plain; charset=utf-8", status.default_reason_phrase()).with_status_code(status);
    header.into_iter().fold(words, with_header)
}

/// Adds a header. One that is not ASCII is left out.
fn with_header(answer: Answer, (name, value): (&str, &str)) -> Answer {
    match Header::from_bytes(name, value) {
        Ok(header) => answer.with_header(header),
        Err(()) => answer,
    }
}

/// The file at an address without its leading slash; `None` unless the address is a plain path inside the folder.
fn locate(folder: &Path, address: &str) -> Option<PathBuf> {
    let address = percent_decode_str(address).decode_utf8().ok()?;
    let is_plain = |part| matches!(part, Component::Normal(name) if !name.as_encoded_bytes().starts_with(b"."));
    Path::new(&*address).components().all(is_plain).then(|| folder.join(&*address))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{self, Read as _, Write as _};
    use std::net::TcpStream;

    fn check(request: &str, status: &str, contains: &str) {
        let folder = tempfile::tempdir().unwrap();
        let site = folder.path().join("site");
        crate::files::write(&folder.path().join("secret"), "secret").unwrap();
        crate::files::write(&site.join(".hidden"), "secret").unwrap();
        crate::files::write(&site.join("index.html"), "<p>start").unwrap();
        crate::files::write(&site.join("lsystem.wasm"), b"\0asm").unwrap();
        crate::files::write(&site.join("a b/ä.txt"), "far").unwrap();
        let (method, target) = request.split_once(' ').unwrap();
        let server = Server { folder: site, mount: "/sub/path/", version: None };
        let mut answer = vec![];
        server
            .respond(&method.parse().unwrap(), target)
            .raw_print(&mut answer, (1, 1).into(), &[], method == "HEAD", None)
            .unwrap();
        let answer = String::from_utf8(answer).unwrap();
        assert!(answer.starts_with(&format!("HTTP/1.1 {status}")), "{request}: {answer}");
        assert!(answer.contains(contains), "{request}: {answer}");
        assert!(!answer.contains("secret"), "{request}: {answer}");
    }

    #[test]
    fn serves_files_with_their_types() {
        check("GET /sub/path/", "200", "<p>start");
        check("GET /sub/path/?x=1", "200", "Content-Type: text/html; charset=utf-8\r\n");
        check("GET /sub/path/lsystem.wasm", "200", "Content-Type: application/wasm\r\n");
        check("GET /sub/path/lsystem.wasm", "200", "Content-Length: 4\r\n");
        check("GET /sub/path/a%20b/%C3%A4.txt", "200", "far");
        check("HEAD /sub/path/index.html", "200", "Cache-Control: no-cache");
    }

    #[test]
    fn says_where_folders_are() {
        check("GET /sub/path/a%20b", "301", "Location: /sub/path/a%20b/\r\n");
        check("GET /sub/path/a%20b/", "404", "");
    }

    #[test]
    fn refuses_everything_else() {
        for target in ["", "/", "/index.html", "/sub/path/none", "/sub/path/../secret", "/sub/path/%2e%2e/secret"] {
            check(&format!("GET {target}"), "404", "");
        }
        for target in ["..%2fsecret", "a/..%5csecret", ".hidden", "%2ehidden", "%", "%zz", "%ff", "%00", "/../secret"] {
            check(&format!("GET /sub/path/{target}"), "404", "");
        }
        check("POST /sub/path/", "405", "Allow: GET, HEAD\r\n");
    }

    #[test]
    fn answers_over_a_socket() -> io::Result<()> {
        let folder = tempfile::tempdir()?;
        fs::write(folder.path().join("index.html"), "hello")?;
        let socket = tiny_http::Server::http("127.0.0.1:0").unwrap();
        let address = socket.server_addr().to_ip().unwrap();
        // The thread serves until the test process ends.
        let server = Server { folder: folder.path().to_owned(), mount: "/", version: None };
        thread::spawn(move || server.run(&socket));
        for _ in 0..3 {
            let mut stream = TcpStream::connect(address)?;
            stream.write_all(b"GET / HTTP/1.1\r\nHost: here\r\nConnection: close\r\n\r\n")?;
            let mut answer = String::new();
            stream.read_to_string(&mut answer)?;
            assert!(answer.starts_with("HTTP/1.1 200 OK\r\n") && answer.ends_with("\r\n\r\nhello"), "{answer}");
        }
        Ok(())
    }

    #[test]
    fn pages_reload_after_the_next_build() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("index.html"), "<head></head>").unwrap();
        fs::write(folder.path().join("service-worker.js"), "keep()").unwrap();
        let server = Server { folder: folder.path().to_owned(), mount: "/", version: Some(Version::default()) };
        let text = |target| io::read_to_string(server.respond(&Method::Get, target).into_reader()).unwrap();
        assert_eq!(text("/"), format!("<head>{RELOADING}</head>"));
        assert_eq!(text("/service-worker.js"), FORGETTING);
        thread::scope(|scope| {
            let waiting = scope.spawn(|| text("/reload.js"));
            // The request may begin to wait after a build; a later one wakes it.
            while !waiting.is_finished() {
                server.version.as_ref().unwrap().next();
                thread::yield_now();
            }
            assert_eq!(waiting.join().unwrap(), RELOADER);
        });
    }
}
