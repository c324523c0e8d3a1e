//! The server of the page: it answers programs of this machine that know its token, and gives and takes one file.
//!
//! Whoever does not know the token costs a few kilobytes for a few seconds, as connections, headers and time are limited.

use super::followed::{FileState, Followed, NotSaved};
use hyper::body::{Body, Incoming};
use hyper::header::{HeaderName, HeaderValue};
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper::{Method, Request, Response};
use hyper_util::rt::{TokioIo, TokioTimer};
use lsystem::base::say;
use std::convert::Infallible;
use std::future::poll_fn;
use std::io;
use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::pin::Pin;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::Semaphore;
use tokio::time::{sleep, timeout};

/// The longest link that is taken, in bytes: the page reads links up to 2,000,000 UTF-16 units.
const MAX_BODY: usize = 8 << 20;
/// The most bytes that are read of a longer link: its sender listens only after sending.
const MAX_READ: usize = 4 * MAX_BODY;
/// The most saves at once, as each holds a link.
const MAX_SAVES: usize = 4;
/// The most bytes and the most fields of a request's head. Browsers send about 1 KiB and 20 fields, and the cookies of all
/// servers of this machine.
const MAX_HEAD: usize = 64 << 10;
const MAX_FIELDS: usize = 64;
/// The most connections; more wait in the system's queue.
const MAX_CONNECTIONS: usize = 128;
/// The most threads that read and write the file.
const MAX_THREADS: usize = 4;
/// The longest time until an answer about an unchanged file, in seconds.
const MAX_WAIT: u64 = 25;
/// The longest time until a request's head is there, and until a connection ends.
const HEAD_TIME: Duration = Duration::from_secs(3);
const MAX_TIME: Duration = Duration::from_secs(120);
/// The pause when no connection can be taken, as without free descriptors.
const PAUSE: Duration = Duration::from_millis(100);

/// The page on an address of this machine.
pub(super) struct Site {
    /// The page's HTML, without what [`Site::page`] adds.
    page: String,
    token: String,
    port: u16,
    file: Followed,
    saves: Semaphore,
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
        Ok(Self { page, token, port, file, saves: Semaphore::new(MAX_SAVES) })
    }

    pub(super) fn address(&self) -> String {
        format!("http://127.0.0.1:{}/{}/", self.port, self.token)
    }

    pub(super) fn file(&self) -> &Followed {
        &self.file
    }

    /// Answers requests until the program ends.
    ///
    /// # Errors
    /// As the system's.
    pub(super) fn run(self: &Arc<Self>, listener: TcpListener) -> io::Result<Infallible> {
        let mut runtime = tokio::runtime::Builder::new_current_thread();
        let runtime = runtime.enable_all().max_blocking_threads(MAX_THREADS).build()?;
        runtime.block_on(async {
            listener.set_nonblocking(true)?;
            let listener = tokio::net::TcpListener::from_std(listener)?;
            let places = Arc::new(Semaphore::new(MAX_CONNECTIONS));
            loop {
                let place = places.clone().acquire_owned().await.map_err(io::Error::other)?;
                let Ok((stream, _)) = listener.accept().await else {
                    sleep(PAUSE).await;
                    continue;
                };
                let site = self.clone();
                tokio::spawn(async move {
                    let service = service_fn(|request| async { Ok::<_, Infallible>(site.respond(request).await) });
                    let mut http = http1::Builder::new();
                    http.timer(TokioTimer::new()).header_read_timeout(HEAD_TIME);
                    http.max_buf_size(MAX_HEAD).max_headers(MAX_FIELDS).keep_alive(false);
                    // A reader who is gone is no failure.
                    let _ = timeout(MAX_TIME, http.serve_connection(TokioIo::new(stream), service)).await;
                    drop(place);
                });
            }
        })
    }

    async fn respond(self: &Arc<Self>, request: Request<Incoming>) -> Response<String> {
        let Answer(status, kind, text) = self.answer(request).await;
        let headers = [
            ("content-type", kind),
            ("cache-control", "no-store"),
            // The token stays here.
            ("referrer-policy", "no-referrer"),
            ("x-content-type-options", "nosniff"),
            // No other page may show this one.
            ("x-frame-options", "DENY"),
            ("cross-origin-resource-policy", "same-origin"),
            ("cross-origin-opener-policy", "same-origin"),
        ];
        let mut response = Response::new(text);
        *response.status_mut() = status.try_into().unwrap_or_default();
        let headers = headers.map(|(name, value)| (HeaderName::from_static(name), HeaderValue::from_static(value)));
        response.headers_mut().extend(headers);
        response
    }

    async fn answer(self: &Arc<Self>, request: Request<Incoming>) -> Answer {
        // Another name for this machine is a page elsewhere whose name was redirected here (DNS rebinding).
        let hosts = [format!("127.0.0.1:{}", self.port), format!("localhost:{}", self.port)];
        let host = only(&request, "host").filter(|host| hosts.contains(host) && request.uri().authority().is_none());
        let Some(host) = host else { return Answer::words(403, say!("this server answers only on its own address")) };
        let place = request.uri().path().strip_prefix('/').and_then(|path| path.strip_prefix(&self.token));
        match (request.method(), place) {
            (&Method::GET, Some("/")) => self.work(|site| Answer(200, "text/html; charset=utf-8", site.page())).await,
            (&Method::GET, Some("/file")) => self.state(&request).await,
            (&Method::PUT, Some("/file")) => match only(&request, "origin") {
                Some(origin) if origin == format!("http://{host}") => self.save(request).await,
                _ => Answer::words(403, say!("only the page itself may save")),
            },
            (_, Some("/" | "/file")) => Answer::words(405, say!("this method is not known here")),
            _ => Answer::words(404, say!("there is nothing here: open the whole address that lsys printed")),
        }
    }

    /// Does work with files in another thread.
    async fn work(self: &Arc<Self>, work: impl FnOnce(&Self) -> Answer + Send + 'static) -> Answer {
        let site = self.clone();
        let done = tokio::task::spawn_blocking(move || work(&site)).await;
        done.unwrap_or_else(|error| Answer::words(500, error.to_string()))
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
    async fn state(self: &Arc<Self>, request: &Request<Incoming>) -> Answer {
        let known = unquoted(&only(request, "if-none-match").unwrap_or_default());
        // The preference `wait` of RFC 7240.
        let wait = only(request, "prefer").and_then(|prefer| prefer.strip_prefix("wait=")?.parse().ok());
        // Folders on a network report no changes.
        let now = self.work(|site| Answer::state(200, &site.file.refresh())).await;
        match wait.unwrap_or(0).min(MAX_WAIT) {
            0 => now,
            wait => Answer::state(200, &self.file.after(&known, Duration::from_secs(wait)).await),
        }
    }

    async fn save(self: &Arc<Self>, request: Request<Incoming>) -> Answer {
        let Some(known) = only(&request, "if-match") else {
            return Answer::words(428, say!("the version of the file is missing: If-Match"));
        };
        let whole = request.uri().query() == Some("whole");
        let Ok(_place) = self.saves.acquire().await else { return Answer::words(503, String::new()) };
        let link = match body_of(request.into_body()).await {
            Ok(link) => link,
            Err(answer) => return answer,
        };
        let save = move |site: &Self| match site.file.save(&link, &unquoted(&known), whole) {
            Ok(state) => Answer::state(200, &state),
            Err(NotSaved::Changed(state)) => Answer::state(412, &state),
            Err(NotSaved::Whole(words)) => Answer::words(409, words),
            Err(NotSaved::Wrong(words)) => Answer::words(400, words),
            Err(NotSaved::Refused(words)) => Answer::words(500, words),
        };
        self.work(save).await
    }
}

/// The text in a request.
async fn body_of(mut body: Incoming) -> Result<String, Answer> {
    let (mut bytes, mut length) = (Vec::new(), 0);
    while length <= MAX_READ
        && let Some(frame) = poll_fn(|context| Pin::new(&mut body).poll_frame(context)).await
    {
        let frame = frame.map_err(|error| Answer::words(400, error.to_string()))?;
        let data = frame.into_data().unwrap_or_default();
        length += data.len();
        if length <= MAX_BODY {
            bytes.extend_from_slice(&data);
        }
    }
    match length {
        ..=MAX_BODY => String::from_utf8(bytes).map_err(|_| Answer::words(400, say!("this is no text"))),
        _ => Err(Answer::words(413, say!("this is too long"))),
    }
}

/// The value of a header that stands exactly once.
fn only(request: &Request<Incoming>, name: &'static str) -> Option<String> {
    let mut values = request.headers().get_all(name).iter();
    let value = values.next()?.to_str().ok()?.to_owned();
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
