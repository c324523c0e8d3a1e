//! `cargo xtask serve`: build quickly, then serve on this machine; with `--watch`, build again after each change.

use crate::server::{Builds, Server};
use crate::workspace::{Kind, Workspace};
use crate::{build, files};
use anyhow::{Context, Result};
use std::net::TcpListener;
use std::thread;
use std::time::{Duration, Instant, SystemTime};

/// How often files are looked at.
const PAUSE: Duration = Duration::from_millis(200);

/// The options of the command.
#[derive(clap::Args)]
pub(crate) struct ServeOptions {
    /// The port; 8080 or the next free one if none is named
    #[arg(long)]
    port: Option<u16>,
    /// Build again after each change, and let the browser reload
    #[arg(long)]
    watch: bool,
}

/// Serves until the program is stopped. What takes longer to build than the page and its engine is built while the page is
/// served already: requests for other files wait for it.
pub(crate) fn serve(workspace: &Workspace, options: &ServeOptions) -> Result<()> {
    let before = Times::now(workspace)?;
    build::first(workspace)?;
    let listener = listen(options.port)?;
    println!("http://{}/", listener.local_addr()?);
    let server =
        Server { folder: Kind::Draft.folder(workspace), mount: "/", builds: Builds::default(), reloads: options.watch };
    thread::scope(|scope| {
        scope.spawn(|| server.run(&listener));
        let start = Instant::now();
        let built = build::build(workspace, Kind::Draft, None);
        server.builds.next();
        match built {
            Ok(()) => println!("tools, gallery and documents: {:.0} s later", start.elapsed().as_secs_f64()),
            Err(error) => eprintln!("error: {error:#}"),
        }
        if options.watch { watch(workspace, &server.builds, before) } else { Ok(()) }
    })
}

/// Builds after each change, without end. A build that fails is told, and the last page stays.
fn watch(workspace: &Workspace, builds: &Builds, mut built: Times) -> Result<()> {
    loop {
        let now = Times::now(workspace)?;
        if now == built {
            thread::sleep(PAUSE);
            continue;
        }
        let start = Instant::now();
        let made = match now.crates == built.crates {
            true => build::bundle(workspace, Kind::Draft, None),
            false => build::build(workspace, Kind::Draft, None),
        };
        built = now;
        match made {
            Ok(()) => {
                println!("built in {:.1} s", start.elapsed().as_secs_f64());
                builds.next();
            }
            Err(error) => eprintln!("error: {error:#}"),
        }
    }
}

/// The times of the last changes.
#[derive(Clone, Copy, PartialEq)]
struct Times {
    /// Of what is compiled.
    crates: SystemTime,
    /// Of all else that the page is made of.
    page: SystemTime,
}

impl Times {
    fn now(workspace: &Workspace) -> Result<Self> {
        let crates = newest(workspace, &["crates", "Cargo.toml", "Cargo.lock"])?;
        Ok(Self { crates, page: newest(workspace, &["www", "data_in", "docs"])? })
    }
}

/// The time of the last change below these files and folders.
fn newest(workspace: &Workspace, names: &[&str]) -> Result<SystemTime> {
    let mut newest = SystemTime::UNIX_EPOCH;
    for path in names.iter().map(|name| workspace.root.join(name)) {
        let found = files::list(&path, |below| !below.ends_with("node_modules"))?;
        // A file may vanish while an editor writes it anew.
        let times = found.iter().filter_map(|file| file.metadata().ok()?.modified().ok());
        newest = times.fold(newest, Ord::max);
    }
    Ok(newest)
}

/// Binds the port asked for, or the first free one from 8080 on.
fn listen(port: Option<u16>) -> Result<TcpListener> {
    let mut ports = port.map_or(8080..=8179, |port| port..=port);
    let bound = ports.find_map(|port| TcpListener::bind(("127.0.0.1", port)).ok());
    bound.context("no port is free, of the one asked for or of 8080 to 8179")
}
