//! Programs that Cargo does not provide: each is found, installed if that is safe, or named with instructions.

use crate::workspace::{Workspace, output};
use anyhow::{Context, Result, bail};
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use std::process::Command;

pub(crate) const WASM_TARGET: &str = "wasm32-unknown-unknown";

/// Makes sure that the compiler in use can compile for [`WASM_TARGET`].
pub(crate) fn wasm_target() -> Result<()> {
    let mut ask = Command::new("rustc");
    let libraries = output(ask.args(["--print=target-libdir", "--target", WASM_TARGET]))?;
    if Path::new(libraries.trim()).is_dir() {
        return Ok(());
    }
    println!("adding the compiler's libraries for {WASM_TARGET}: rustup target add {WASM_TARGET}");
    output(Command::new("rustup").args(["target", "add", WASM_TARGET])).map(drop).with_context(|| {
        format!("this Rust has no libraries for {WASM_TARGET}; with rustup: `rustup target add {WASM_TARGET}`")
    })
}

pub(crate) fn node() -> Result<PathBuf> {
    which::which("node").context(NO_NODE)
}

pub(crate) fn npm() -> Result<PathBuf> {
    which::which("npm").context(NO_NODE)
}

/// The subcommand `cargo NAME` at one version. If it is missing, it is installed into Cargo's target folder.
pub(crate) fn cargo_tool(workspace: &Workspace, name: &str, version: &str) -> Result<PathBuf> {
    let (program, folder) = (format!("cargo-{name}"), workspace.target.join("tools"));
    let own = folder.join("bin").join(&program).with_extension(std::env::consts::EXE_EXTENSION);
    for file in [own.clone(), program.clone().into()] {
        let said = output(Command::new(&file).args([name, "--version"]));
        if said.is_ok_and(|said| said.split_whitespace().last() == Some(version)) {
            return Ok(file);
        }
    }
    println!("installing {program} {version} into {}, once", folder.display());
    let install = ["install", &program, "--locked", "--version", version, "--root"];
    workspace.run(workspace.cargo(install).arg(&folder)).with_context(|| {
        format!("{program} {version} is missing: `cargo install {program} --locked --version {version}`")
    })?;
    Ok(own)
}

const NO_NODE: &str = "the page is built and checked with Node.js 20 or newer and npm, and they are not on the PATH: \
                       get them from nodejs.org or your system's packages (Debian: apt-get install nodejs npm)";

/// The browser for tests, and the driver that controls it in the wasm tests.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Browser {
    pub(crate) chromium: PathBuf,
    pub(crate) driver: PathBuf,
}

/// Finds Chromium and its driver. Installs them if this runs as root on Debian.
pub(crate) fn browser() -> Result<Browser> {
    let here = Surroundings::here();
    let found = find_browser(&here);
    if !here.can_install() || found.is_ok() && here.find(None, &[SHELL]).is_some() {
        return found;
    }
    let installed = install(&[SHELL, "chromium-driver"]);
    // A failed installation of the headless shell is ignored if there is another Chromium; tests only take longer.
    if found.is_err() {
        installed?;
    }
    find_browser(&here)
}

/// Finds Firefox, for the tests of the page's core. Installs it if this runs as root on Debian.
pub(crate) fn firefox() -> Option<PathBuf> {
    let here = Surroundings::here();
    let variable = std::env::var_os("FIREFOX").filter(|value| !value.is_empty());
    let find = || here.find(variable.as_deref(), &[FIREFOX, "firefox"]);
    find().or_else(|| {
        let may = here.can_install() && variable.is_none();
        (may && install(&[FIREFOX]).is_ok()).then(find)?
    })
}

/// Debian's package of Firefox.
pub(crate) const FIREFOX: &str = "firefox-esr";

fn install(packages: &[&str]) -> Result<()> {
    println!("installing with apt-get: {}", packages.join(" "));
    let apt = || {
        let mut command = Command::new("apt-get");
        command.env("DEBIAN_FRONTEND", "noninteractive");
        command
    };
    output(apt().arg("update"))?;
    output(apt().args(["install", "--yes", "--no-install-recommends"]).args(packages)).map(drop)
}

/// Chromium without a user interface: it opens a page in half the time, with a third of the processor time.
const SHELL: &str = "chromium-headless-shell";

/// Finds both programs. The error names the missing program and how to get it.
fn find_browser(here: &Surroundings) -> Result<Browser> {
    let names = [SHELL, "chromium", "chromium-browser", "google-chrome", "chrome"];
    let chromium = here.find(here.chromium.as_deref(), &names);
    let driver = here.find(here.driver.as_deref(), &["chromedriver", "chromium.chromedriver"]);
    let missing = match (chromium, driver) {
        (Some(chromium), Some(driver)) => return Ok(Browser { chromium, driver }),
        (None, None) => "Chromium and ChromeDriver are",
        (None, Some(_)) => "Chromium is",
        (Some(_), None) => "ChromeDriver is",
    };
    bail!(
        "the browser tests need Chromium (or Chrome) and ChromeDriver of the same version; {missing} missing. \
         Debian: `apt-get install {SHELL} chromium-driver` as root; elsewhere: put `chromium` and `chromedriver` on \
         the PATH, or set CHROMIUM and CHROMEDRIVER to where they are"
    )
}

/// The environment in which programs are searched.
struct Surroundings {
    path: OsString,
    /// The variable CHROMIUM.
    chromium: Option<OsString>,
    /// The variable CHROMEDRIVER.
    driver: Option<OsString>,
    /// Whether the system is Debian, by its release file.
    debian: bool,
    root: bool,
}

impl Surroundings {
    fn here() -> Self {
        let variable = |name| std::env::var_os(name).filter(|value| !value.is_empty());
        let release = std::fs::read_to_string("/etc/os-release").unwrap_or_default();
        Self {
            path: variable("PATH").unwrap_or_default(),
            chromium: variable("CHROMIUM"),
            driver: variable("CHROMEDRIVER"),
            debian: is_debian(&release),
            root: output(Command::new("id").arg("-u")).is_ok_and(|id| id.trim() == "0"),
        }
    }

    /// The program named by a variable, or else the first of `names` on the PATH.
    fn find(&self, variable: Option<&OsStr>, names: &[&str]) -> Option<PathBuf> {
        if let Some(file) = variable {
            return Some(PathBuf::from(file)).filter(|file| file.is_file());
        }
        names.iter().find_map(|name| which::which_in_global(name, Some(&self.path)).ok()?.next())
    }

    /// Whether programs may be installed: only as root on Debian, as in a fresh container, and only if no variable
    /// names another program.
    fn can_install(&self) -> bool {
        let chosen = self.chromium.is_some() || self.driver.is_some();
        self.debian && self.root && !chosen && self.find(None, &["apt-get"]).is_some()
    }
}

fn is_debian(release: &str) -> bool {
    release.lines().any(|line| line == "ID=debian")
}

#[cfg(test)]
mod tests {
    use super::*;
    use tempfile::TempDir;

    fn install(program: &Path) {
        crate::files::write(program, "").unwrap();
        #[cfg(unix)]
        std::fs::set_permissions(program, std::os::unix::fs::PermissionsExt::from_mode(0o755)).unwrap();
    }

    /// An environment with a PATH of two folders; the second contains these programs.
    fn with(programs: &[&str]) -> (TempDir, Surroundings) {
        let folder = tempfile::tempdir().unwrap();
        programs.iter().for_each(|program| install(&folder.path().join("bin").join(program)));
        let path = std::env::join_paths([folder.path().join("none"), folder.path().join("bin")]).unwrap();
        (folder, Surroundings { path, chromium: None, driver: None, debian: true, root: true })
    }

    #[test]
    fn finds_both_programs_on_the_path() {
        let (folder, here) = with(&["chromium", "google-chrome", "chromedriver"]);
        let bin = folder.path().join("bin");
        let expected = Browser { chromium: bin.join("chromium"), driver: bin.join("chromedriver") };
        assert_eq!(find_browser(&here).unwrap(), expected);
        install(&bin.join(SHELL));
        assert_eq!(find_browser(&here).unwrap().chromium, bin.join(SHELL));
    }

    #[test]
    fn names_what_is_missing() {
        for (programs, missing) in [
            (&["chromium"][..], "ChromeDriver is missing"),
            (&["chromedriver"], "Chromium is missing"),
            (&[], "Chromium and ChromeDriver are missing"),
        ] {
            let error = find_browser(&with(programs).1).unwrap_err().to_string();
            assert!(
                error.contains(missing) && error.contains("apt-get install chromium-headless-shell chromium-driver"),
                "{error}"
            );
        }
    }

    #[test]
    fn variables_come_first_and_must_be_right() {
        let (folder, mut here) = with(&["chromium", "chromedriver", "mine"]);
        let mine = folder.path().join("bin/mine");
        here.chromium = Some(mine.clone().into());
        assert_eq!(find_browser(&here).unwrap().chromium, mine);
        here.chromium = Some(folder.path().join("gone").into());
        assert!(find_browser(&here).is_err());
    }

    #[test]
    fn installs_only_as_root_on_debian_with_apt() {
        let (_folder, mut here) = with(&["apt-get"]);
        assert!(here.can_install());
        here.root = false;
        assert!(!here.can_install());
        (here.root, here.debian) = (true, false);
        assert!(!here.can_install());
        (here.debian, here.chromium) = (true, Some("/opt/chromium".into()));
        assert!(!here.can_install());
        assert!(!with(&[]).1.can_install());
    }

    #[test]
    fn knows_debian_from_its_relatives() {
        assert!(is_debian("NAME=\"Debian GNU/Linux\"\nID=debian\n"));
        assert!(!is_debian("ID=ubuntu\nID_LIKE=debian\n"));
    }
}
