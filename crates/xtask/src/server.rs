//! A local web server for a folder of static files: one thread per connection, no caching, no access outside the
//! folder. Not tiny_http: its pool of threads may leave a connection waiting while browsers keep others open.

use percent_encoding::percent_decode_str;
use std::fs;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::{Component, Path, PathBuf};
use std::sync::{Condvar, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

/// The most bytes of a request line and headers; browsers send fewer to a static server.
const LONGEST_REQUEST: u64 = 64 << 10;
/// The longest silence of a connection.
const PATIENCE: Duration = Duration::from_secs(10);

/// A server of the files below `folder` at the addresses below `mount`, which starts and ends with `/`.
pub(crate) struct Server {
    pub(crate) folder: PathBuf,
    pub(crate) mount: &'static str,
    /// Before the first one, requests for missing files wait.
    pub(crate) builds: Builds,
    /// Whether browsers reload after each build.
    pub(crate) reloads: bool,
}

/// Counts builds, and lets threads wait for them.
#[derive(Default)]
pub(crate) struct Builds {
    number: Mutex<u64>,
    changed: Condvar,
}

impl Builds {
    /// After the first build.
    pub(crate) fn done() -> Self {
        Self { number: Mutex::new(1), ..Self::default() }
    }

    /// Wakes all that wait.
    pub(crate) fn next(&self) {
        *self.number.lock().unwrap_or_else(PoisonError::into_inner) += 1;
        self.changed.notify_all();
    }

    /// Waits for the first build, or for the next one after it.
    fn wait(&self, for_next: bool) {
        let number = self.number.lock().unwrap_or_else(PoisonError::into_inner);
        let before = if for_next { (*number).max(1) } else { 0 };
        drop(self.changed.wait_while(number, |number| *number <= before));
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

impl Server {
    /// Serves without end.
    pub(crate) fn run(&self, listener: &TcpListener) {
        thread::scope(|scope| {
            for stream in listener.incoming().flatten() {
                // Errors are ignored: browsers often close a connection early.
                scope.spawn(move || self.answer(&stream).ok());
            }
        });
    }

    fn answer(&self, stream: &TcpStream) -> io::Result<()> {
        stream.set_read_timeout(Some(PATIENCE))?;
        stream.set_write_timeout(Some(PATIENCE))?;
        let mut lines = BufReader::new(stream.take(LONGEST_REQUEST)).lines();
        let request = lines.next().unwrap_or_else(|| Ok(String::new()))?;
        for line in lines {
            if line?.is_empty() {
                break;
            }
        }
        let mut words = request.split(' ');
        let (method, target) = (words.next().unwrap_or_default(), words.next().unwrap_or_default());
        let (head, body) = self.respond(method, target);
        let mut stream = stream;
        stream.write_all(head.as_bytes())?;
        if method != "HEAD" {
            stream.write_all(&body)?;
        }
        stream.flush()
    }

    /// The head and the body of the answer.
    fn respond(&self, method: &str, target: &str) -> (String, Vec<u8>) {
        let plain = |status: &str, more: &str| {
            (head(status, "text/plain; charset=utf-8", status.len(), more), status.as_bytes().to_vec())
        };
        if method != "GET" && method != "HEAD" {
            return plain("405 Method Not Allowed", "Allow: GET, HEAD\r\n");
        }
        let path = target.split(['?', '#']).next().unwrap_or_default();
        let below = path.strip_prefix(self.mount);
        if self.reloads && below == Some(RELOAD) {
            self.builds.wait(true);
            return (head("200 OK", "text/javascript", RELOADER.len(), ""), RELOADER.as_bytes().to_vec());
        }
        let Some(mut file) = below.and_then(|path| locate(&self.folder, path)) else {
            return plain("404 Not Found", "");
        };
        if !file.exists() {
            self.builds.wait(false);
        }
        if file.is_dir() {
            if !path.ends_with('/') {
                // The address of a folder must end in `/`, because relative addresses in the page start from there.
                return plain("301 Moved Permanently", &format!("Location: {path}/\r\n"));
            }
            file.push("index.html");
        }
        match fs::read(&file) {
            Ok(body) => {
                let body = if self.reloads { reloading(&file, body) } else { body };
                (head("200 OK", &media_type(&file), body.len(), ""), body)
            }
            Err(_) => plain("404 Not Found", ""),
        }
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

fn head(status: &str, media_type: &str, length: usize, more: &str) -> String {
    format!(
        "HTTP/1.1 {status}\r\nContent-Type: {media_type}\r\nContent-Length: {length}\r\nCache-Control: no-cache\r\n\
         X-Content-Type-Options: nosniff\r\nConnection: close\r\n{more}\r\n"
    )
}

/// The file at an address without its leading slash; `None` unless the address is a plain path inside the folder.
fn locate(folder: &Path, address: &str) -> Option<PathBuf> {
    let address = percent_decode_str(address).decode_utf8().ok()?;
    let is_plain = |part| matches!(part, Component::Normal(name) if !name.as_encoded_bytes().starts_with(b"."));
    Path::new(&*address).components().all(is_plain).then(|| folder.join(&*address))
}

fn media_type(file: &Path) -> String {
    let kind = mime_guess::from_path(file).first_or_octet_stream();
    let charset = if kind.type_() == "text" { "; charset=utf-8" } else { "" };
    format!("{kind}{charset}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(request: &str, status: &str, contains: &str) {
        let folder = tempfile::tempdir().unwrap();
        let site = folder.path().join("site");
        crate::files::write(&folder.path().join("secret"), "secret").unwrap();
        crate::files::write(&site.join(".hidden"), "secret").unwrap();
        crate::files::write(&site.join("index.html"), "<p>start").unwrap();
        crate::files::write(&site.join("lsystem.wasm"), b"\0asm").unwrap();
        crate::files::write(&site.join("a b/ä.txt"), "far").unwrap();
        let (method, target) = request.split_once(' ').unwrap();
        let server = Server { folder: site, mount: "/sub/path/", builds: Builds::done(), reloads: false };
        let (head, body) = server.respond(method, target);
        let answer = format!("{head}{}", String::from_utf8(body).unwrap());
        assert!(head.starts_with(&format!("HTTP/1.1 {status}")), "{request}: {head}");
        assert!(answer.contains(contains), "{request}: {answer}");
        assert!(!answer.contains("secret"), "{request}: {answer}");
    }

    #[test]
    fn serves_files_with_their_types() {
        check("GET /sub/path/", "200", "<p>start");
        check("GET /sub/path/?x=1", "200", "Content-Type: text/html; charset=utf-8\r\n");
        check("GET /sub/path/lsystem.wasm", "200", "Content-Type: application/wasm\r\nContent-Length: 4\r\n");
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
        let listener = TcpListener::bind("127.0.0.1:0")?;
        let address = listener.local_addr()?;
        // The thread serves until the test process ends.
        let server = Server { folder: folder.path().to_owned(), mount: "/", builds: Builds::done(), reloads: false };
        thread::spawn(move || server.run(&listener));
        for _ in 0..3 {
            let mut stream = TcpStream::connect(address)?;
            stream.write_all(b"GET / HTTP/1.1\r\nHost: here\r\n\r\n")?;
            let mut answer = String::new();
            stream.read_to_string(&mut answer)?;
            assert!(answer.starts_with("HTTP/1.1 200 OK\r\n") && answer.ends_with("\r\n\r\nhello"), "{answer}");
        }
        Ok(())
    }

    #[test]
    fn files_that_are_still_being_made_are_waited_for() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("gallery.json");
        let server = Server { folder: folder.path().to_owned(), mount: "/", builds: Builds::default(), reloads: false };
        thread::scope(|scope| {
            let waiting = scope.spawn(|| [server.respond("GET", "/gallery.json"), server.respond("GET", "/none")]);
            fs::write(&file, "[]").unwrap();
            server.builds.next();
            let [found, missing] = waiting.join().unwrap();
            assert!(found.1 == b"[]" && missing.0.starts_with("HTTP/1.1 404"));
        });
    }

    #[test]
    fn pages_reload_after_the_next_build() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("index.html"), "<head></head>").unwrap();
        fs::write(folder.path().join("service-worker.js"), "keep()").unwrap();
        let server = Server { folder: folder.path().to_owned(), mount: "/", builds: Builds::done(), reloads: true };
        let text = |target| String::from_utf8(server.respond("GET", target).1).unwrap();
        assert_eq!(text("/"), format!("<head>{RELOADING}</head>"));
        assert_eq!(text("/service-worker.js"), FORGETTING);
        thread::scope(|scope| {
            let waiting = scope.spawn(|| text("/reload.js"));
            // The request may begin to wait after a build; a later one wakes it.
            while !waiting.is_finished() {
                server.builds.next();
                thread::yield_now();
            }
            assert_eq!(waiting.join().unwrap(), RELOADER);
        });
    }
}
