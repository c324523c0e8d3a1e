//! `lsys FILE`: the playground with the file's system, in the browser. The page follows the file, and can save into it.

mod followed;
mod server;

use crate::cli::{Changes, ViewOptions};
use crate::{CommandFailure, language, pages, print, say};
use followed::Followed;
use notify_debouncer_mini::new_debouncer;
use notify_debouncer_mini::notify::RecursiveMode;
use server::Site;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

/// Changes within this time are one: editors write a file in several steps.
const PAUSE: Duration = Duration::from_millis(100);

/// Serves the page until the program is stopped.
///
/// # Errors
/// [`CommandFailure`] if the file cannot be read, its system has errors, there is no page, or the port is taken.
pub(crate) fn view(file: &Path, options: &ViewOptions, changes: &Changes) -> Result<(), CommandFailure> {
    let words = |words: String| CommandFailure::Words(words);
    if file.as_os_str() == "-" {
        return Err(words(say!("standard input cannot be followed: give a file")));
    }
    // The file to which a link leads is followed and written.
    let path = file.canonicalize().map_err(|error| CommandFailure::io(file.display(), &error))?;
    let followed = Followed::new(path, changes.clone())?;
    let page = pages::PLAYGROUND.html(options.page.as_deref())?;
    let page = language::page_words().and_then(|words| words.give_to(&page, "")).unwrap_or(page);
    let wanted = options.port.unwrap_or(0);
    let listener = server::bind(wanted)
        .map_err(|error| words(say!("port {}: {}; leave out --port for a free one", wanted, error)))?;
    let port = listener.local_addr().map_err(|error| CommandFailure::io(say!("the server"), &error))?.port();
    let site = Site::new(&page, token()?, port, followed).map_err(words)?;
    let site = Arc::new(site);
    let _watch = watch(&site)?;
    let address = site.address();
    print(|out| writeln!(out, "{address}"))?;
    say(&format!("{}\n", say!("{} is shown at this address. Ctrl+C ends the program.", file.display())));
    if !options.no_browser && open::that_detached(&address).is_err() {
        say(&format!("{}\n", say!("note: no browser was found: open the address yourself")));
    }
    match site.run(listener) {
        Err(error) => Err(words(say!("the server: {}", error))),
    }
}

/// Reads the file again after each change, as long as the returned value lives. The folder is watched, since editors put
/// a new file in place of the old one.
fn watch(site: &Arc<Site>) -> Result<impl Sized + use<>, CommandFailure> {
    let failed = |error| CommandFailure::Words(say!("the folder cannot be watched: {}", error));
    let own = site.clone();
    let mut debouncer = new_debouncer(PAUSE, move |events: notify_debouncer_mini::DebounceEventResult| {
        let name = own.file().path().file_name();
        if events.is_err() || events.iter().flatten().any(|event| event.path.file_name() == name) {
            own.file().refresh();
        }
    })
    .map_err(failed)?;
    let folder = site.file().path().parent().unwrap_or(Path::new("/"));
    debouncer.watcher().watch(folder, RecursiveMode::NonRecursive).map_err(failed)?;
    Ok(debouncer)
}

/// 128 random bits, so that no other page or program guesses the address.
fn token() -> Result<String, CommandFailure> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes).map_err(|error| CommandFailure::Words(say!("no random number: {}", error)))?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}
