//! Figures and systems for papers.

use crate::asked::{Asked, numbers_in};
use crate::equal;
use crate::made::Made;
use crate::plane::{self, is_same, rendered};
use anyhow::{Context, Result, bail, ensure};
use fs_err as fs;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::Command;

/// A system that TikZ's library can draw, with rules that have signs and letters.
const SIMPLE: &str = "curves/hilbert";

pub(crate) fn ask(made: &Made<'_>, asked: &mut Asked<'_>) -> Result<()> {
    if asked.programs.latex().is_some() {
        for system in plane::SYSTEMS {
            picture(made, asked, system, "tikz", "\\usepackage{tikz}")?;
            typeset(made, asked, system)?;
        }
        let libraries = "\\usepackage{tikz}\\usetikzlibrary{lindenmayersystems}";
        picture(made, asked, SIMPLE, "tikz-library", libraries)?;
    }
    if let Some(program) = asked.programs.optional("bibtex").map(Path::to_owned) {
        for system in plane::SYSTEMS {
            let result = bibtex(made, &program, system);
            asked.note(format!("{system} as bibtex"), "bibtex", result);
        }
    }
    Ok(())
}

/// Sets a file with LaTeX. Returns the PDF.
fn latex(made: &Made<'_>, asked: &Asked<'_>, file: &Path, packages: &str) -> Result<PathBuf> {
    let name = file.file_stem().context("a name")?.to_string_lossy().into_owned();
    let folder = made.new_folder(&format!("{name}-latex"))?;
    let text = fs::read_to_string(file)?;
    let document = format!(
        "\\documentclass{{article}}\n\\usepackage[utf8]{{inputenc}}\n{packages}\n\\pagestyle{{empty}}\n\
         \\begin{{document}}\n\\hsize=200mm\\textwidth=200mm\\noindent\n{text}\n\\end{{document}}\n"
    );
    fs::write(folder.join("page.tex"), document)?;
    let program = asked.programs.latex().context("LaTeX")?;
    let words = ["-interaction=nonstopmode", "-halt-on-error", "page.tex"];
    let done = Command::new(program).args(words).current_dir(&folder).output()?;
    if !done.status.success() {
        let said = String::from_utf8_lossy(&done.stdout).into_owned();
        let wrong: Vec<&str> = said.lines().filter(|line| line.starts_with('!')).collect();
        bail!("LaTeX refuses {}: {}", file.display(), wrong.join(" "));
    }
    Ok(folder.join("page.pdf"))
}

/// A picture that LaTeX draws, against the PNG.
fn picture(made: &Made<'_>, asked: &mut Asked<'_>, system: &str, format: &str, packages: &str) -> Result<()> {
    let (file, _) = made.draw(system, format, &[])?;
    let page = match latex(made, asked, &file, packages) {
        Ok(page) => page,
        Err(error) => {
            asked.note(format!("{system} as {format}"), "pdflatex", Err(error));
            return Ok(());
        }
    };
    let renamed = made.path(&format!("{}-set.pdf", file.file_stem().context("a name")?.to_string_lossy()));
    fs::write(&renamed, fs::read(&page)?)?;
    let mut questions = vec![json!({"look": "pdf", "file": renamed})];
    if let Some(page) = rendered(asked, made, &renamed)? {
        questions.push(json!({"look": "same", "file": page, "other": made.draw(system, "png", &[])?.0}));
    }
    asked.look(format!("{system} as {format}"), "pdflatex, pdftoppm, Pillow", questions, |answers| {
        equal("pages", answers[0]["sizes"].as_array().map(Vec::len), Some(1))?;
        Ok(format!("a page, {}", answers.get(1).map_or(Ok("its ink is not looked at".to_owned()), is_same)?))
    });
    Ok(())
}

/// A typeset system: the text of the page has the axiom, the number of steps and every production.
fn typeset(made: &Made<'_>, asked: &mut Asked<'_>, system: &str) -> Result<()> {
    let (file, _) = made.draw(system, "latex", &[])?;
    let packages = "\\usepackage{amsmath}\\usepackage{array}";
    let page = match latex(made, asked, &file, packages) {
        Ok(page) => page,
        Err(error) => {
            asked.note(format!("{system} as latex"), "pdflatex", Err(error));
            return Ok(());
        }
    };
    let source: Value = serde_json::from_slice(&fs::read(made.source(system))?)?;
    asked.look(
        format!("{system} as latex"),
        "pdflatex, pypdf",
        [json!({"look": "pdf", "file": page})],
        move |answers| {
            // Minus signs and arrows of mathematics, and no blanks.
            let bare = |text: &str| -> String {
                let text = text.replace("->", "→").replace('-', "−");
                text.chars().filter(|letter| !letter.is_whitespace()).collect()
            };
            let text = bare(answers[0]["text"].as_str().unwrap_or_default());
            let rules = source["rules"].as_array().context("rules")?;
            for rule in rules.iter().filter_map(Value::as_str).map(bare) {
                ensure!(text.contains(&rule), "the page has no {rule}: {text}");
            }
            ensure!(text.contains(&format!("n={}", source["num_iters"])), "the page has no number of steps: {text}");
            Ok(format!("{} productions", rules.len()))
        },
    );
    Ok(())
}

/// The entries of a file without a warning.
fn bibtex(made: &Made<'_>, program: &Path, system: &str) -> Result<String> {
    let (file, _) = made.draw(system, "bibtex", &[])?;
    let entries = fs::read_to_string(&file)?.lines().filter(|line| line.starts_with('@')).count();
    let name = file.file_stem().context("a name")?.to_string_lossy().into_owned();
    let folder = made.new_folder(&format!("{name}-bibtex"))?;
    fs::write(folder.join("all.bib"), fs::read(&file)?)?;
    fs::write(folder.join("page.aux"), "\\relax\n\\citation{*}\n\\bibstyle{plain}\n\\bibdata{all}\n")?;
    let done = Command::new(program).arg("page").current_dir(&folder).output()?;
    let log = fs::read_to_string(folder.join("page.blg"))?;
    ensure!(done.status.success(), "{log}");
    let warnings = log.lines().find(|line| line.contains("warning")).map_or(0.0, |line| numbers_in(line)[0]);
    equal("warnings", warnings, 0.0)?;
    let set = fs::read_to_string(folder.join("page.bbl"))?.matches("\\bibitem{").count();
    equal("entries", set, entries)?;
    Ok(format!("{set} entries"))
}
