//! Packages for learning systems: SCORM 1.2, and SCORM 2004 in its 3rd edition, which newer systems read, too.
//!
//! A package is a zip with the manifest, the page of steps, which talks to the learning system, and the page of an
//! exercise, which the steps show in frames. Both pages are single files of the built site.

mod manifest;

use crate::page_words::without_requests;
use crate::{Asks, Exercise, PageWords};
use lsystem_base::say;
use lsystem_base::words::said;
use miniz_oxide::deflate::compress_to_vec;
use rawzip::time::UtcDateTime;
use rawzip::{CompressionMethod, DataDescriptorOutput, ZipArchiveWriter, crc32};
use std::io::{self, Write};

/// The most exercises of a package. The marks of more would not fit into the state that a learning system keeps.
pub(crate) const MAX_EXERCISES: usize = 100;
/// The most UTF-16 units of a package's title.
const MAX_TITLE: usize = 200;
/// The level of compression.
const LEVEL: u8 = 9;
/// The markup around the steps of the lesson on its page.
const STEPS: [&str; 2] = ["<!-- steps -->", "<!-- /steps -->"];

/// The file that a learning system opens, and the file that its frames show.
const PAGE: &str = "index.html";
const EXERCISE: &str = "exercise.html";
/// The page of exercises whose answer is a program, to which that of exercises leads.
const PROGRAM: &str = "program.html";
const READ_ME: &str = "read-me.txt";

/// A standard that a package follows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ScormStandard {
    /// SCORM 1.2, which every learning system reads.
    #[default]
    Scorm12,
    /// SCORM 2004, 3rd edition: longer states, and completion apart from success.
    Scorm2004,
}

impl ScormStandard {
    /// Both standards.
    pub const ALL: [Self; 2] = [Self::Scorm12, Self::Scorm2004];

    /// The name in options and in the package's page.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Scorm12 => "1.2",
            Self::Scorm2004 => "2004",
        }
    }

    /// The standard with this [`name`](Self::name).
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|standard| standard.name() == name)
    }
}

/// The content of a package.
#[derive(Clone, Copy, Debug)]
pub struct Scorm<'a> {
    /// The name in the learning system; that of the first exercise, or of the lesson, if empty.
    pub title: &'a str,
    /// The exercises as values of `x` in links. None stands for the lesson.
    pub exercises: &'a [String],
    /// The standard.
    pub standard: ScormStandard,
}

/// The pages of the built site that a package is made of.
#[derive(Clone, Copy, Debug)]
pub struct ScormPages<'a> {
    /// `package.html`: the lesson's page in one file.
    pub steps: &'a str,
    /// `exercise.html`: the page of an exercise in one file.
    pub exercise: &'a str,
    /// `program.html`: the page of an exercise whose answer is a program, for packages with one.
    pub program: Option<&'a str>,
    /// The words of the package's language; none for English.
    pub words: Option<PageWords<'a>>,
}

/// Makes a package: the bytes of a zip.
///
/// # Errors
/// A sentence about an exercise that is damaged, about too many exercises, or about pages of another version.
pub fn scorm_package(scorm: &Scorm<'_>, pages: &ScormPages<'_>) -> Result<Vec<u8>, String> {
    if scorm.exercises.len() > MAX_EXERCISES {
        return Err(say!("A package holds at most {} exercises.", MAX_EXERCISES));
    }
    let read = |text: &String| Exercise::read(text).map_err(|wrong| say!("The exercise {}.", wrong));
    let exercises = scorm.exercises.iter().map(read).collect::<Result<Vec<_>, _>>()?;
    let title = title(scorm, &exercises);
    let id = match scorm.exercises {
        [] => "lesson".to_owned(),
        all => Exercise::key(&all.join("\n")),
    };
    let foreign = || say!("The page of steps belongs to another version of this program.");
    let texts: String = match &exercises[..] {
        [] => in_links(pages.steps).iter().map(texts).collect(),
        all => all.iter().map(texts).collect(),
    };
    let told = |page: &str| match &pages.words {
        Some(words) => words.give_to(page, &texts).ok_or_else(foreign),
        None => Ok(without_requests(page)),
    };
    let language = pages.words.map_or("en", |words| words.language);
    let page = page(scorm, &told(pages.steps)?, language, &id, &title, &exercises).ok_or_else(foreign)?;
    let exercise = told(pages.exercise)?;
    let program = match exercises.iter().any(|exercise| exercise.asks == Asks::Program) {
        true => Some(told(pages.program.ok_or_else(|| say!("The page {} is missing.", PROGRAM))?)?),
        false => None,
    };
    let manifest = manifest::manifest(scorm.standard, &id, &title, program.is_some());
    let read_me = read_me(scorm, &title, &exercises);
    let files = [
        (manifest::NAME, manifest.as_bytes()),
        (PAGE, page.as_bytes()),
        (EXERCISE, exercise.as_bytes()),
        (READ_ME, read_me.as_bytes()),
    ];
    let program = program.iter().map(|page| (PROGRAM, page.as_bytes()));
    let files: Vec<_> = files.into_iter().chain(program).collect();
    zip(&files).map_err(|error| say!("The package cannot be written ({}).", error))
}

/// The exercises in the links of a page.
fn in_links(page: &str) -> Vec<Exercise> {
    let is_inside = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_');
    let links = page.split("x=").skip(1).map(|rest| rest.split(|c| !is_inside(c)).next().unwrap_or_default());
    links.filter_map(|text| Exercise::read(text).ok()).collect()
}

/// The texts of an exercise that a student reads, a line for each.
fn texts(exercise: &Exercise) -> String {
    let Exercise { title, task, hints, .. } = exercise;
    format!("{title}\n{task}\n{}\n", hints.join("\n"))
}

/// The title of a package.
fn title(scorm: &Scorm<'_>, exercises: &[Exercise]) -> String {
    let mut title = match exercises {
        _ if !scorm.title.trim().is_empty() => scorm.title.trim().to_owned(),
        [] => say!("Plants from rules"),
        [one] => name(one),
        _ => say!("L-system exercises"),
    };
    crate::exercise::cut(&mut title, MAX_TITLE);
    title
}

fn name(exercise: &Exercise) -> String {
    if exercise.title.is_empty() { say!("Exercise") } else { said(&exercise.title) }
}

/// The page of steps for these exercises. `None` if it has no place for them.
fn page(
    scorm: &Scorm<'_>,
    steps: &str,
    language: &str,
    id: &str,
    title: &str,
    exercises: &[Exercise],
) -> Option<String> {
    let root = format!("<html lang=\"{language}\" data-package=\"{id}\" data-scorm=\"{}\">", scorm.standard.name());
    let page = between(steps, ["<html", ">"], |_| root)?;
    if exercises.is_empty() {
        return Some(page);
    }
    let title = escaped(title);
    let page = between(&page, ["<title>", "</title>"], |_| format!("<title>{title}</title>"))?;
    let page = between(&page, ["<h1>", "</h1>"], |_| format!("<h1>{title}</h1>"))?;
    between(&page, STEPS, |_| {
        let steps = (1..).zip(scorm.exercises).zip(exercises);
        steps.map(|((number, text), exercise)| step(number, text, exercise)).collect()
    })
}

/// A step with an exercise, which shows its title itself.
fn step(number: usize, text: &str, exercise: &Exercise) -> String {
    let name = escaped(&name(exercise));
    // The student's name decides on the variant.
    let varied = if exercise.variants.is_empty() { "" } else { " data-varied" };
    format!(
        "<section class=\"step bare\" id=\"step-{number}\" aria-labelledby=\"h-{number}\">\n\
         <h2 id=\"h-{number}\">{number}. {name}</h2>\n\
         <l-system class=\"task\" data-step=\"{number}\"{varied} caption=\"{name}\" link=\"#v=1&amp;x={text}&amp;hand=0\"></l-system>\n\
         </section>\n"
    )
}

/// The text with its first part from one mark to another, marks included, replaced.
fn between(text: &str, [start, end]: [&str; 2], replace: impl FnOnce(&str) -> String) -> Option<String> {
    let from = text.find(start)?;
    let to = from + text[from..].find(end)? + end.len();
    Some([&text[..from], &replace(&text[from..to]), &text[to..]].concat())
}

/// Words for teachers who open the zip, with the links that mark answers again.
fn read_me(scorm: &Scorm<'_>, title: &str, exercises: &[Exercise]) -> String {
    let package = say!("A package for learning systems (SCORM {}): upload the zip as it is.", scorm.standard.name());
    let marks = say!(
        "The marks are made in the student's browser, so they can be forged. Where a mark counts, mark the answers again:\n\
         the learning system keeps each answer as a link that begins with {} (in the interactions and in suspend_data).",
        "#v=1"
    );
    let files = say!(
        "EXERCISE is a link below, ANSWERS.csv the table that the learning system exports, or a file with such links."
    );
    let mut text = format!("{title}\n\n{package}\n\n{marks}\n\n    lsys mark EXERCISE ANSWERS.csv\n\n{files}\n");
    for ((number, x), exercise) in (1..).zip(scorm.exercises).zip(exercises) {
        text += &format!("\n{number}. {}\n#v=1&x={x}\n", name(exercise));
    }
    text
}

fn escaped(text: &str) -> String {
    let is_kept = |c: &char| matches!(c, '\t' | '\n' | ' '..='\u{fffd}' | '\u{10000}'..);
    let text: String = text.chars().filter(is_kept).collect();
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// A zip of files. All have the same date, so that equal contents give equal bytes.
fn zip(files: &[(&str, &[u8])]) -> io::Result<Vec<u8>> {
    let mut archive = ZipArchiveWriter::new(Vec::new());
    for (name, bytes) in files {
        let file = archive.new_file(*name).compression_method(CompressionMethod::DEFLATE);
        let (mut entry, _) = file.last_modified(UtcDateTime::from_unix(DATE)).start().map_err(io::Error::other)?;
        entry.write_all(&compress_to_vec(bytes, LEVEL))?;
        let described = DataDescriptorOutput::new(crc32(bytes), bytes.len() as u64);
        entry.finish(described).map_err(io::Error::other)?;
    }
    archive.finish().map_err(io::Error::other)
}

/// The first day that a zip can name, in seconds since 1970: 1980-01-01.
const DATE: i64 = 315_532_800;

#[cfg(test)]
mod tests {
    use super::*;
    use lsystem_syntax::Definition;

    const STEPS_PAGE: &str = "<!doctype html>\n<html lang=\"en\">\n<head><title>T</title></head>\n<body><h1>T</h1>\n\
         <!-- steps -->\n<section>lesson</section>\n<!-- /steps -->\n</body></html>\n";

    fn exercise(title: &str, rules: &str) -> String {
        let target = Definition { axiom: "F".into(), rules: rules.into(), ..Definition::default() };
        Exercise { title: title.into(), target, ..Exercise::default() }.write()
    }

    fn files(zip: &[u8]) -> Vec<(String, String)> {
        let archive = rawzip::ZipArchive::from_slice(zip).unwrap();
        let mut entries = archive.entries();
        let mut files = vec![];
        while let Some(entry) = entries.next_entry().unwrap() {
            let name = entry.file_path().try_normalize().unwrap().as_ref().to_owned();
            let data = archive.get_entry(entry.wayfinder()).unwrap();
            let bytes = miniz_oxide::inflate::decompress_to_vec(data.data()).unwrap();
            assert_eq!((bytes.len() as u64, crc32(&bytes)), (entry.uncompressed_size_hint(), entry.crc32()));
            files.push((name, String::from_utf8(bytes).unwrap()));
        }
        files
    }

    fn package(title: &str, exercises: &[String]) -> Result<Vec<(String, String)>, String> {
        let pages = ScormPages { steps: STEPS_PAGE, exercise: "<p>exercise", program: Some("<p>program"), words: None };
        let scorm = Scorm { title, exercises, standard: ScormStandard::Scorm12 };
        let zip = scorm_package(&scorm, &pages)?;
        assert_eq!(zip, scorm_package(&scorm, &pages)?, "equal contents give equal bytes");
        Ok(files(&zip))
    }

    #[test]
    fn a_package_has_the_manifest_first_and_both_pages() {
        let (koch, bush) = (exercise("Koch & <co>", "F -> F+F--F+F"), exercise("", "F -> FF"));
        let files = package("", &[koch.clone(), bush.clone()]).unwrap();
        let names: Vec<_> = files.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["imsmanifest.xml", "index.html", "exercise.html", "read-me.txt"]);
        let page = &files[1].1;
        for part in [
            "<html lang=\"en\" data-package=\"",
            "data-scorm=\"1.2\">",
            "<title>L-system exercises</title>",
            "<h1>L-system exercises</h1>",
            "<h2 id=\"h-1\">1. Koch &amp; &lt;co&gt;</h2>",
            "<h2 id=\"h-2\">2. Exercise</h2>",
            &format!("link=\"#v=1&amp;x={koch}&amp;hand=0\""),
        ] {
            assert!(page.contains(part), "{part}: {page}");
        }
        assert!(!page.contains("lesson"), "{page}");
        assert_eq!(files[2].1, "<p>exercise");
        assert!(
            files[3].1.contains("can be forged") && files[3].1.contains(&format!("#v=1&x={bush}")),
            "{}",
            files[3].1
        );
    }

    #[test]
    fn exercises_that_ask_for_programs_bring_their_page() {
        let text = Exercise { asks: Asks::Program, program: "set: practical-1".into(), ..Exercise::default() }.write();
        assert_eq!(Exercise::read(&text).unwrap().program, "set: practical-1");
        let files = package("", &[text]).unwrap();
        assert_eq!(files[4], ("program.html".to_owned(), "<p>program".to_owned()));
        assert!(files[0].1.contains("<file href=\"program.html\"/>"), "{}", files[0].1);
    }

    #[test]
    fn both_pages_have_the_words_of_the_language() {
        let catalogue = r#"{"lesson": "Lektion", "exercise": {"one": "Aufgabe", "other": "Aufgaben"}, "Nowhere": "x",
            "Draw it": "Zeichne sie"}"#;
        let words = Some(PageWords { language: "de", catalogue });
        let exercise = "<html lang=\"en\"><title>E</title><p>exercise";
        let pages = ScormPages { steps: STEPS_PAGE, exercise, program: None, words };
        let scorm = Scorm { title: "", exercises: &[], standard: ScormStandard::Scorm12 };
        let files = files(&scorm_package(&scorm, &pages).unwrap());
        let steps = "<script type=\"text/plain\" data-file=\"lang/de/words.json\">{\"lesson\":\"Lektion\"}</script>";
        assert!(files[1].1.contains("<html lang=\"de\" data-package=\"lesson\""), "{}", files[1].1);
        assert!(files[1].1.contains(steps), "{}", files[1].1);
        assert!(
            files[2].1.starts_with("<html lang=\"de\"><title>E</title>\n<script type=\"text/plain\""),
            "{}",
            files[2].1
        );
        assert!(files[2].1.contains(">{\"exercise\":{\"one\":\"Aufgabe\",\"other\":\"Aufgaben\"}}<"), "{}", files[2].1);
        // The texts of an exercise stand in its link.
        let target = Definition { axiom: "F".into(), rules: "F -> FF".into(), ..Definition::default() };
        let link = Exercise { task: "Draw it".into(), target, ..Exercise::default() }.write();
        let of_lesson = STEPS_PAGE.replace("lesson", &format!("<a href=\"#v=1&amp;x={link}&amp;hand=0\">lesson</a>"));
        let lesson = self::files(&scorm_package(&scorm, &ScormPages { steps: &of_lesson, ..pages }).unwrap());
        let exercises = &[link];
        let one = self::files(&scorm_package(&Scorm { exercises, ..scorm }, &pages).unwrap());
        for files in [lesson, one] {
            assert!(files[2].1.contains("\"Draw it\":\"Zeichne sie\""), "{}", files[2].1);
        }
        let untitled = ScormPages { exercise: "<p>exercise", ..pages };
        assert!(scorm_package(&scorm, &untitled).unwrap_err().contains("another version"));
    }

    #[test]
    fn one_exercise_gives_its_title_and_none_is_the_lesson() {
        let page = &package("", &[exercise("Koch", "F -> F+F--F+F")]).unwrap()[1].1;
        assert!(page.contains("<title>Koch</title>"), "{page}");
        let page = &package("", &[]).unwrap()[1].1;
        assert!(page.contains("<section>lesson</section>") && page.contains("data-package=\"lesson\""), "{page}");
        let page = &package(" Week \"3\" ", &[exercise("Koch", "F -> FF")]).unwrap()[1].1;
        assert!(page.contains("<h1>Week &quot;3&quot;</h1>"), "{page}");
    }

    #[test]
    fn what_cannot_be_packed_is_told() {
        let damaged = package("", &["AAAA".to_owned()]).unwrap_err();
        assert_eq!(damaged, "The exercise is damaged or cut off.");
        let many = vec![exercise("", "F -> FF"); MAX_EXERCISES + 1];
        assert!(package("", &many).unwrap_err().contains("100"));
        let pages = ScormPages { steps: "<p>", exercise: "", program: None, words: None };
        let scorm = Scorm { title: "", exercises: &[], standard: ScormStandard::Scorm2004 };
        assert!(scorm_package(&scorm, &pages).unwrap_err().contains("another version"));
    }
}
