//! `cargo xtask serve`: build, then serve on this machine.

use crate::workspace::Workspace;
use crate::{build, server};
use anyhow::{Context, Result};
use std::net::TcpListener;

/// Serves until the program is stopped.
pub(crate) fn serve(workspace: &Workspace, port: Option<u16>) -> Result<()> {
    build::build(workspace)?;
    let listener = listen(port)?;
    println!("http://{}/", listener.local_addr()?);
    server::run(&listener, &workspace.dist(), "/");
    Ok(())
}

/// Binds the port asked for, or the first free one from 8080 on.
fn listen(port: Option<u16>) -> Result<TcpListener> {
    let bind = |port| TcpListener::bind(("127.0.0.1", port)).with_context(|| format!("listening on port {port}"));
    match port {
        Some(port) => bind(port),
        None => (8080..8180).find_map(|port| bind(port).ok()).context("no port from 8080 to 8179 is free"),
    }
}
