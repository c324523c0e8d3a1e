//! A local web server for a folder of static files: one thread per connection, no caching, no access outside the
//! folder.

use std::fs;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;

/// The most bytes of a request line and headers; browsers send fewer to a static server.
const LONGEST_REQUEST: u64 = 64 << 10;
/// The longest silence of a connection.
const PATIENCE: Duration = Duration::from_secs(10);

/// Serves the files below `folder` at the addresses below `mount`, without end. `mount` starts and ends with `/`.
pub(crate) fn run(listener: &TcpListener, folder: &Path, mount: &str) {
    thread::scope(|scope| {
        for stream in listener.incoming().flatten() {
            // Errors are ignored: browsers often close a connection early.
            scope.spawn(move || answer(&stream, folder, mount).ok());
        }
    });
}

fn answer(stream: &TcpStream, folder: &Path, mount: &str) -> io::Result<()> {
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
    let (head, body) = respond(method, target, folder, mount);
    let mut stream = stream;
    stream.write_all(head.as_bytes())?;
    if method != "HEAD" {
        stream.write_all(&body)?;
    }
    stream.flush()
}

/// The head and the body of the answer.
fn respond(method: &str, target: &str, folder: &Path, mount: &str) -> (String, Vec<u8>) {
    let plain = |status: &str, more: &str| {
        (head(status, "text/plain; charset=utf-8", status.len(), more), status.as_bytes().to_vec())
    };
    if method != "GET" && method != "HEAD" {
        return plain("405 Method Not Allowed", "Allow: GET, HEAD\r\n");
    }
    let path = target.split(['?', '#']).next().unwrap_or_default();
    let Some(mut file) = path.strip_prefix(mount).and_then(|path| locate(folder, path)) else {
        return plain("404 Not Found", "");
    };
    if file.is_dir() {
        if !path.ends_with('/') {
            // The address of a folder must end in `/`, because relative addresses in the page start from there.
            return plain("301 Moved Permanently", &format!("Location: {path}/\r\n"));
        }
        file.push("index.html");
    }
    match fs::read(&file) {
        Ok(body) => (head("200 OK", media_type(&file), body.len(), ""), body),
        Err(_) => plain("404 Not Found", ""),
    }
}

fn head(status: &str, media_type: &str, length: usize, more: &str) -> String {
    format!(
        "HTTP/1.1 {status}\r\nContent-Type: {media_type}\r\nContent-Length: {length}\r\nCache-Control: no-cache\r\n\
         X-Content-Type-Options: nosniff\r\nConnection: close\r\n{more}\r\n"
    )
}

/// The file at an address without its leading slash; `None` unless the address is a plain path inside the folder.
fn locate(folder: &Path, address: &str) -> Option<PathBuf> {
    let mut path = folder.to_owned();
    for part in address.split('/').filter(|part| !part.is_empty()) {
        let part = decode(part)?;
        // Refuse hidden files, the parent folder, and characters with a special meaning on Windows or in terminals.
        if part.starts_with('.') || part.contains(['/', '\\', ':']) || part.contains(char::is_control) {
            return None;
        }
        path.push(part);
    }
    Some(path)
}

/// Undoes percent encoding; `None` if the encoding is broken or not UTF-8.
fn decode(text: &str) -> Option<String> {
    let mut bytes = vec![];
    let mut rest = text.bytes();
    while let Some(byte) = rest.next() {
        let mut digit = || char::from(rest.next()?).to_digit(16);
        bytes.push(if byte == b'%' { (digit()? << 4 | digit()?) as u8 } else { byte });
    }
    String::from_utf8(bytes).ok()
}

fn media_type(file: &Path) -> &'static str {
    match file.extension().and_then(|ending| ending.to_str()).unwrap_or_default() {
        "html" => "text/html; charset=utf-8",
        "js" | "mjs" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "json" => "application/json",
        "webmanifest" => "application/manifest+json",
        "wasm" => "application/wasm",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "ico" => "image/x-icon",
        "woff2" => "font/woff2",
        "txt" => "text/plain; charset=utf-8",
        _ => "application/octet-stream",
    }
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
        let (head, body) = respond(method, target, &site, "/sub/path/");
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
        thread::spawn(move || run(&listener, folder.path(), "/"));
        for _ in 0..3 {
            let mut stream = TcpStream::connect(address)?;
            stream.write_all(b"GET / HTTP/1.1\r\nHost: here\r\n\r\n")?;
            let mut answer = String::new();
            stream.read_to_string(&mut answer)?;
            assert!(answer.starts_with("HTTP/1.1 200 OK\r\n") && answer.ends_with("\r\n\r\nhello"), "{answer}");
        }
        Ok(())
    }
}
