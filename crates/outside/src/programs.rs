//! The programs that open files.

use crate::{Options, output};
use anyhow::{Context, Result};
use fs_err as fs;
use serde_json::Value;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Programs of the system, the outputs that they open, and their packages in Debian. They are used where they are
/// installed.
const OPTIONAL: [(&str, &str, &str); 8] = [
    ("ffprobe", "frames of films", "ffmpeg"),
    ("pdftoppm", "ink of PDF and of TikZ pictures", "poppler-utils"),
    ("pdflatex", "TikZ pictures and systems in LaTeX", "texlive-latex-recommended texlive-pictures"),
    ("bibtex", "BibTeX entries", "texlive-binaries"),
    ("pandoc", "fences in books of Quarto", "pandoc"),
    ("prusa-slicer", "layers of prints", "prusa-slicer"),
    ("openscad", "unions of prints in pieces", "openscad"),
    ("kpsewhich", "whether LaTeX has TikZ", "texlive-binaries"),
];

/// The installed programs.
pub(crate) struct Programs {
    folder: PathBuf,
    python: PathBuf,
    optional: Vec<(&'static str, Option<PathBuf>)>,
    has_tikz: bool,
}

impl Programs {
    /// Finds the programs, and installs the libraries of Python.
    pub(crate) fn get(options: &Options) -> Result<Self> {
        let folder = options.scripts();
        let python = python(options)?;
        let optional: Vec<_> = OPTIONAL.iter().map(|&(name, ..)| (name, which::which(name).ok())).collect();
        let mut programs = Self { folder, python, optional, has_tikz: false };
        // A LaTeX without its libraries is as good as none.
        programs.has_tikz = programs.optional("kpsewhich").is_some_and(|program| {
            let needed = ["tikz.sty", "tikzlibrarylindenmayersystems.code.tex", "amsmath.sty", "array.sty"];
            needed.iter().all(|file| output(Command::new(program).arg(file)).is_ok())
        });
        Ok(programs)
    }

    /// Python, with the libraries of `requirements.txt`.
    pub(crate) fn python(&self) -> &Path {
        &self.python
    }

    /// A program of the system, if it is installed.
    pub(crate) fn optional(&self, name: &str) -> Option<&Path> {
        self.optional.iter().find(|(own, _)| *own == name)?.1.as_deref()
    }

    /// LaTeX with TikZ, if it is installed.
    pub(crate) fn latex(&self) -> Option<&Path> {
        self.optional("pdflatex").filter(|_| self.has_tikz)
    }

    /// What is not checked because a program is missing, a line for each.
    pub(crate) fn missing(&self) -> Vec<String> {
        let is_missing = |name: &str| match name {
            "pdflatex" => self.latex().is_none(),
            // Only there to look for the libraries of LaTeX.
            "kpsewhich" => false,
            _ => self.optional(name).is_none(),
        };
        let missing = OPTIONAL.iter().filter(|(name, ..)| is_missing(name));
        missing
            .map(|(name, what, package)| format!("{what}: {name} is missing (Debian: apt-get install {package})"))
            .collect()
    }

    /// The answers of `look.py` to these questions.
    pub(crate) fn look(&self, questions: &[Value]) -> Result<Vec<Value>> {
        let mut command = Command::new(&self.python);
        command.arg(self.folder.join("look.py")).stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().context("starting Python")?;
        // Python reads all questions before it answers, so neither waits for the other. The pipe is closed at once.
        child.stdin.take().context("Python's input")?.write_all(&serde_json::to_vec(questions)?)?;
        let done = child.wait_with_output()?;
        serde_json::from_slice(&done.stdout).context("look.py gave no answers")
    }

    /// The reports of the glTF validator about these files.
    pub(crate) fn validate_gltf(&self, files: &[PathBuf]) -> Result<Vec<Value>> {
        let mut command = Command::new("node");
        Ok(serde_json::from_str(&output(command.arg(self.folder.join("look.mjs")).args(files))?)?)
    }
}

/// The Python of a virtual environment with the libraries of `requirements.txt`. A copy of the
/// installed list shows whether this has been done.
pub(crate) fn python(options: &Options) -> Result<PathBuf> {
    let list = options.scripts().join("requirements.txt");
    let wanted = fs::read(&list)?;
    let environment = options.folder.join("venv");
    let python = environment.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    let installed = environment.join("installed.txt");
    if installed.is_file() && fs::read(&installed)? == wanted {
        return Ok(python);
    }
    let system = ["python3", "python"].iter().find_map(|name| which::which(name).ok()).context(
        "files are checked with libraries of Python 3.11 or newer, and it is not on the PATH (Debian: apt-get install \
         python3 python3-venv)",
    )?;
    output(Command::new(system).args(["-m", "venv", "--clear"]).arg(&environment))
        .context("making a virtual environment of Python (Debian: apt-get install python3-venv)")?;
    let words = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--only-binary=:all:"];
    output(Command::new(&python).args(words).arg("--require-hashes").arg("--requirement").arg(&list)).context(
        "installing vpype, trimesh, Pillow, maturin, nbclient and others, which needs PyPI and Python 3.11 or newer",
    )?;
    fs::write(&installed, wanted)?;
    Ok(python)
}
