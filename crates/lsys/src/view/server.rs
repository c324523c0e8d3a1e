//! The server of the page: it answers programs of this machine that know its token, and gives and takes one file.

use super::followed::{FileState, Followed, NotSaved};
use lsystem::base::say;
use std::io::{self, Read};
use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;
use tiny_http::{Header, Method, Request, Response, Server};

/// The longest link that is taken, in bytes: the page reads links up to 2,000,000 UTF-16 units.
const MAX_BODY: usize = 8 << 20;
/// The longest time until an answer about an unchanged file, in seconds.
const MAX_WAIT: u64 = 25;
/// The most requests at once: a few tabs with a waiting request each.
const MAX_REQUESTS: usize = 32;

/// The page on an address of this machine.
pub(super) struct Site {
    /// The page's HTML, without what [`Site::page`] adds.
    page: String,
    token: String,
    port: u16,
    file: Followed,
    /// The number of requests in work.
    requests: AtomicUsize,
}

/// An answer: status, type and content.
struct Answer(u16, &'static str, String);

impl Answer {
    fn words(status: u16, words: String) -> Self {
        Self(status, "text/plain; charset=utf-8", words)
    }

    fn state(status: u16, state: &FileState) -> Self {
        match serde_json::to_string(state) {
            Ok(json) => Self(status, "application/json", json),
            Err(error) => Self::words(500, error.to_string()),
        }
    }
}

/// Binds a port of this machine; 0 for any free one.
///
/// # Errors
/// As the system's.
pub(super) fn bind(port: u16) -> io::Result<TcpListener> {
    TcpListener::bind(SocketAddr::from((Ipv4Addr::LOCALHOST, port)))
}

impl Site {
    /// The site for a page in a single file.
    ///
    /// # Errors
    /// Words if the page is no playground in a single file.
    pub(super) fn new(page: &str, token: String, port: u16, file: Followed) -> Result<Self, String> {
        // The page forbids itself all requests, as it needs none elsewhere.
        const POLICY: &str = "content=\"default-src 'none'; ";
        if page.matches(POLICY).count() != 1 || !page.contains("</head>") {
            return Err(say!("the page is not the playground in a single file"));
        }
        let page = page.replacen(POLICY, &format!("{POLICY}connect-src 'self'; "), 1);
        Ok(Self { page, token, port, file, requests: AtomicUsize::new(0) })
    }

    pub(super) fn address(&self) -> String {
        format!("http://127.0.0.1:{}/{}/", self.port, self.token)
    }

    pub(super) fn file(&self) -> &Followed {
        &self.file
    }

    /// Answers requests until the program ends.
    pub(super) fn run(self: &Arc<Self>, server: &Server) {
        for request in server.incoming_requests() {
            if self.requests.fetch_add(1, Ordering::Relaxed) >= MAX_REQUESTS {
                self.requests.fetch_sub(1, Ordering::Relaxed);
                respond(request, Answer::words(503, say!("too many requests at once")));
                continue;
            }
            let site = self.clone();
            let done = thread::Builder::new().spawn(move || {
                site.answer(request);
                site.requests.fetch_sub(1, Ordering::Relaxed);
            });
            if done.is_err() {
                self.requests.fetch_sub(1, Ordering::Relaxed);
            }
        }
    }

    fn answer(&self, mut request: Request) {
        let answer = self.answer_to(&mut request);
        respond(request, answer);
    }

    fn answer_to(&self, request: &mut Request) -> Answer {
        // Another name for this machine is a page elsewhere whose name was redirected here (DNS rebinding).
        let hosts = [format!("127.0.0.1:{}", self.port), format!("localhost:{}", self.port)];
        let host = only(request, "Host").filter(|host| hosts.contains(host));
        let Some(host) = host else { return Answer::words(403, say!("this server answers only on its own address")) };
        let path = request.url().split('?').next().unwrap_or_default();
        let place = path.strip_prefix('/').and_then(|path| path.strip_prefix(&self.token));
        match (request.method(), place) {
            (Method::Get, Some("/")) => Answer(200, "text/html; charset=utf-8", self.page()),
            (Method::Get, Some("/file")) => self.state(request),
            (Method::Put, Some("/file")) => match only(request, "Origin") {
                Some(origin) if origin == format!("http://{host}") => self.save(request),
                _ => Answer::words(403, say!("only the page itself may save")),
            },
            (_, Some("/" | "/file")) => Answer::words(405, say!("this method is not known here")),
            _ => Answer::words(404, say!("there is nothing here: open the whole address that lsys printed")),
        }
    }

    /// The page, with the file's name and its state.
    fn page(&self) -> String {
        let FileState { version, link, .. } = self.file.refresh();
        let name = attribute(&self.file.name());
        let link = attribute(&link.unwrap_or_default());
        let mark = format!(
            "<meta name=\"lsys-file\" content=\"{name}\" data-version=\"{version}\" data-link=\"{link}\">\n</head>"
        );
        self.page.replacen("</head>", &mark, 1)
    }

    /// The file's state; if the page knows it, then after the next change or when the time is up.
    fn state(&self, request: &Request) -> Answer {
        let known = only(request, "If-None-Match").unwrap_or_default();
        // The preference `wait` of RFC 7240.
        let wait = only(request, "Prefer").and_then(|prefer| prefer.strip_prefix("wait=")?.parse().ok());
        let state = self.file.after(&unquoted(&known), Duration::from_secs(wait.unwrap_or(0).min(MAX_WAIT)));
        Answer::state(200, &state)
    }

    fn save(&self, request: &mut Request) -> Answer {
        let Some(known) = only(request, "If-Match") else {
            return Answer::words(428, say!("the version of the file is missing: If-Match"));
        };
        if request.body_length().is_some_and(|length| length > MAX_BODY) {
            return Answer::words(413, say!("this is too long"));
        }
        let mut body = Vec::new();
        if let Err(error) = request.as_reader().take(MAX_BODY as u64 + 1).read_to_end(&mut body) {
            return Answer::words(400, error.to_string());
        }
        if body.len() > MAX_BODY {
            return Answer::words(413, say!("this is too long"));
        }
        let Ok(link) = String::from_utf8(body) else { return Answer::words(400, say!("this is no text")) };
        match self.file.save(&link, &unquoted(&known)) {
            Ok(state) => Answer::state(200, &state),
            Err(NotSaved::Changed(state)) => Answer::state(412, &state),
            Err(NotSaved::Wrong(words)) => Answer::words(400, words),
            Err(NotSaved::Refused(words)) => Answer::words(500, words),
        }
    }
}

/// The value of a header that stands exactly once.
fn only(request: &Request, name: &'static str) -> Option<String> {
    let mut values = request.headers().iter().filter(|header| header.field.equiv(name));
    let value = values.next()?.value.to_string();
    values.next().is_none().then_some(value)
}

/// An entity tag without its quotes.
fn unquoted(tag: &str) -> String {
    tag.trim_matches('"').to_owned()
}

/// A text as the value of an attribute in double quotes.
fn attribute(text: &str) -> String {
    text.replace('&', "&amp;").replace('"', "&quot;").replace('<', "&lt;")
}

/// Sends an answer. A reader who is gone is no failure.
fn respond(request: Request, Answer(status, kind, text): Answer) {
    let headers = [
        ("Content-Type", kind),
        ("Cache-Control", "no-store"),
        // The token stays here.
        ("Referrer-Policy", "no-referrer"),
        ("X-Content-Type-Options", "nosniff"),
        // No other page may show this one.
        ("X-Frame-Options", "DENY"),
        ("Cross-Origin-Resource-Policy", "same-origin"),
        ("Cross-Origin-Opener-Policy", "same-origin"),
    ];
    let mut response = Response::from_data(text.into_bytes()).with_status_code(status);
    for header in headers.into_iter().filter_map(|(name, value)| Header::from_bytes(name, value).ok()) {
        response.add_header(header);
    }
    let _ = request.respond(response);
}
