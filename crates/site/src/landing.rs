//! A page for each system of the gallery, so that a link to it shows its picture where links are shown: `gallery/NAME.html`
//! with `NAME.png` and `NAME.json` (oEmbed), a page with all, and `sitemap.xml`. They name their own addresses, and so are
//! made only for a site whose address is known. In another language it is `gallery/NAME.de.html`, with the same picture.

mod shelves;
mod thumbnail;

use crate::docs::{Page, escape, fill, shortened};
use crate::exercises::try_out;
use crate::gallery::{Entry, systems};
use crate::language;
use anyhow::{Context, Result, ensure};
use fs_err as fs;
use lsystem::course::Exercise;
use lsystem::course::growth::growth;
use lsystem::drawing::{kind, legend};
use lsystem::files::write_link;
use lsystem_base::say;
use lsystem_base::words::said;
use serde_json::{Value, json};
use shelves::Shelf;
use std::collections::HashMap;
use std::fmt::Write as _;
use std::path::Path;
use thumbnail::{SIZE, picture};

/// The folder of the pages.
const FOLDER: &str = "gallery";
/// The most bytes of all pictures.
const MAX_BYTES: usize = 16 << 20;
/// The size of an embedded drawing, in CSS pixels.
const FRAME: [u32; 2] = [640, 480];
/// Rules up to this number of lines make an exercise.
const MAX_RULES: usize = 3;

/// What the pages are made of, and where they are.
pub(crate) struct Sources<'a> {
    pub(crate) root: &'a Path,
    /// The folder of the site, with all other pages.
    pub(crate) site: &'a Path,
    /// The site's address, with a slash at its end.
    pub(crate) address: &'a str,
    /// All languages but English, by code.
    pub(crate) languages: &'a [String],
}

/// Writes the pages, and returns a sentence with their number and the bytes of their pictures.
pub(crate) fn write(sources: &Sources<'_>) -> Result<String> {
    let Sources { root, site, .. } = sources;
    let template = fs::read_to_string(root.join("www/docs/page.html"))?;
    let shelves = shelves::read(&fs::read_to_string(root.join("www/js/shelves.json"))?)?;
    let exercises = published(&root.join("www/exercises.json"), &site.join("exercises.json"))?;
    let folder = site.join(FOLDER);
    fs::create_dir_all(&folder)?;
    let (ending, mut bytes, mut cards) = (language::ending(), 0, HashMap::new());
    for entry in systems(&root.join("data_in"))? {
        let entry = entry?;
        let path = entry.path.trim_end_matches(".json");
        let shelf = shelves.iter().find(|shelf| shelf.paths.iter().any(|each| each == path));
        let shelf = shelf.with_context(|| format!("{path} stands on no shelf"))?;
        let landing = Landing::new(&entry, said(&shelf.name), exercises.get(path).cloned(), sources);
        let page = folder.join(format!("{}{ending}.html", landing.name));
        ensure!(!page.exists(), "two systems have the page {}", landing.name);
        fs::write(page, landing.page(&template)?)?;
        if ending.is_empty() {
            let picture = picture(&entry)?;
            bytes += picture.len();
            let file = |ending: &str| folder.join(format!("{}.{ending}", landing.name));
            fs::write(file("png"), picture)?;
            fs::write(file("json"), landing.oembed().to_string())?;
        }
        cards.insert(path.to_owned(), landing.card());
    }
    ensure!(bytes <= MAX_BYTES, "the pictures have {bytes} bytes, more than {MAX_BYTES}");
    fs::write(folder.join(format!("index{ending}.html")), index(&template, &shelves, &cards, sources)?)?;
    fs::write(site.join("sitemap.xml"), sitemap(site, sources.address)?)?;
    Ok(format!("{} pages of the gallery in `{}`, with {bytes} bytes of pictures", cards.len(), language::language()))
}

/// The published exercises by the path of their system.
fn published(source: &Path, written: &Path) -> Result<HashMap<String, String>> {
    let read = |file: &Path| -> Result<Vec<Value>> { Ok(serde_json::from_str(&fs::read_to_string(file)?)?) };
    let text = |value: &Value| value.as_str().map(str::to_owned);
    // The first of a system's exercises is the one that finds its rules.
    let pairs = read(source)?.into_iter().zip(read(written)?).rev();
    Ok(pairs.filter_map(|(source, written)| Some((text(&source["system"])?, text(&written["x"])?))).collect())
}

/// The facts of one page.
struct Landing<'a> {
    entry: &'a Entry,
    /// The file's name without its ending.
    name: String,
    title: String,
    shelf: String,
    /// The value of `x` in the exercise's link.
    exercise: Option<String>,
    /// The drawing in words.
    description: String,
    /// The author's note; may be empty.
    notes: String,
    /// The site's address.
    site: &'a str,
    languages: &'a [String],
}

impl<'a> Landing<'a> {
    fn new(entry: &'a Entry, shelf: String, exercise: Option<String>, sources: &Sources<'a>) -> Self {
        let Entry { path, definition, system, figure } = entry;
        let count = figure.exact_segments().or_else(|| {
            let mut counter = system.segments(definition.iterations);
            while counter.step(1 << 20) == lsystem::Progress::More {}
            counter.count().cloned()
        });
        Self {
            entry,
            name: path.trim_end_matches(".json").replace('/', "-"),
            title: said(definition.label()),
            shelf,
            exercise: exercise.or_else(|| own_exercise(entry)),
            description: count.map(|n| figure.describe(system, definition.iterations, &n)).unwrap_or_default(),
            notes: said(&definition.notes),
            site: sources.address,
            languages: sources.languages,
        }
    }

    /// The address of a file beside the page.
    fn beside(&self, ending: &str) -> String {
        format!("{}{FOLDER}/{}.{ending}", self.site, self.name)
    }

    /// A sentence or two: the author's note, or else the drawing in words.
    fn summary(&self) -> &str {
        if self.notes.is_empty() { &self.description } else { &self.notes }
    }

    fn page(&self, template: &str) -> Result<String> {
        let (head, body) = (self.head()?, self.body()?);
        let (title, description) = (&self.title, &*shortened(self.summary()));
        let language = language::language();
        Page { docs: "../docs/", name: "", title, description, head: &head, language, body: &body }.fill(template)
    }

    fn head(&self) -> Result<String> {
        let (page, picture) = (self.beside(&format!("{}html", others(language::language()))), self.beside("png"));
        let description = shortened(self.summary());
        let data = json!({
            "@context": "https://schema.org",
            "@type": ["VisualArtwork", "LearningResource"],
            "name": self.title,
            "description": self.summary(),
            "url": page,
            "image": { "@type": "ImageObject", "url": picture, "width": SIZE[0], "height": SIZE[1] },
            "artform": "L-system",
            "citation": self.entry.definition.source,
            "isPartOf": { "@type": "WebSite", "name": "L-systems", "url": self.site },
        });
        // A title may hold the end of a script.
        let data = data.to_string().replace('<', "\\u003c");
        let [width, height] = SIZE.map(|side| side.to_string());
        fill(
            include_str!("landing/head.html"),
            &[
                ("page", &page),
                ("alternates", &alternates(self.languages, |part| self.beside(&format!("{part}html")))),
                ("oembed", &escape(&self.beside("json"))),
                ("title", &escape(&self.title)),
                ("description", &escape(&description)),
                ("picture", &escape(&picture)),
                ("width", &width),
                ("height", &height),
                ("alt", &escape(&self.description)),
                ("data", &data),
            ],
        )
    }

    /// The drawing as other pages embed it (oEmbed 1.0, section 2.3.4.4).
    fn oembed(&self) -> Value {
        let [width, height] = FRAME;
        let address = format!("{}v1/embed.html{}", self.site, write_link(&self.entry.definition));
        let (address, title) = (escape(&address), escape(&self.title));
        json!({
            "version": "1.0",
            "type": "rich",
            "title": self.title,
            "provider_name": "L-systems",
            "provider_url": self.site,
            "thumbnail_url": self.beside("png"),
            "thumbnail_width": SIZE[0],
            "thumbnail_height": SIZE[1],
            "width": width,
            "height": height,
            "html": format!("<iframe src=\"{address}\" title=\"{title}\" width=\"{width}\" height=\"{height}\" style=\"border: 0; max-width: 100%\" loading=\"lazy\"></iframe>"),
        })
    }

    fn body(&self) -> Result<String> {
        let Entry { definition, system, .. } = self.entry;
        let (name, [width, height]) = (&self.name, SIZE);
        let asked =
            if language::ending().is_empty() { String::new() } else { format!("?lang={}", language::language()) };
        let link = escape(&format!("../{asked}{}", write_link(definition)));
        let exercise = self.exercise.as_ref().map(|x| {
            let words = escape(&say!("Try the exercise"));
            format!("<a class=\"door\" href=\"../exercise.html{asked}#v=1&amp;x={}\">{words}</a>\n", escape(x))
        });
        let facts = [
            (say!("Axiom"), code(&definition.axiom)),
            (say!("Iterations"), definition.iterations.to_string()),
            (say!("Angle"), degrees(Some(definition.angle))),
            (say!("Right turns"), degrees(definition.right_angle)),
            (say!("Symbols as in"), code(definition.dialect.name())),
            (say!("Kind"), escape(&kind(system).split(", ").map(said).collect::<Vec<_>>().join(", "))),
            (say!("Source"), escape(&definition.source)),
        ];
        let facts: String = facts
            .iter()
            .filter(|(_, value)| !value.is_empty())
            .map(|(name, value)| format!("<tr><th scope=\"row\">{name}</th><td>{value}</td></tr>\n"))
            .collect();
        let symbols: String = legend(system)
            .iter()
            .map(|entry| (escape(&entry.module), escape(&entry.actions)))
            .map(|(module, does)| format!("<tr><td><code class=\"short\">{module}</code></td><td>{does}</td></tr>\n"))
            .collect();
        let growth = growth(system, definition.iterations).map(|growth| growth.sentences.join(" ")).unwrap_or_default();
        // Where the note is empty, the description stands above the picture.
        let words: String = [&self.description, &growth]
            .iter()
            .filter(|words| !words.is_empty() && words.as_str() != self.summary())
            .map(|words| format!("<p>{}</p>\n", escape(words)))
            .collect();
        let words = if words.is_empty() { words } else { format!("<h2>{}</h2>\n{words}", escape(&say!("In words"))) };
        let ending = language::ending();
        let all = if ending.is_empty() { "./".to_owned() } else { format!("index{ending}.html") };
        fill(
            include_str!("landing/body.html"),
            &[
                ("all", &all),
                ("gallery", &escape(&say!("Gallery"))),
                ("shelf", &escape(&self.shelf)),
                ("title", &escape(&self.title)),
                ("summary", &escape(self.summary())),
                ("link", &link),
                ("name", name),
                ("width", &width.to_string()),
                ("height", &height.to_string()),
                ("alt", &escape(&self.description)),
                ("open", &escape(&say!("Open in the playground"))),
                ("exercise", &exercise.unwrap_or_default()),
                ("rules name", &escape(&say!("Rules"))),
                ("rules", &escape(definition.rules.trim_end())),
                ("values", &escape(&say!("Values"))),
                ("facts", &facts),
                ("words", &words),
                ("symbols name", &escape(&say!("Symbols"))),
                ("symbol", &escape(&say!("symbol"))),
                ("does", &escape(&say!("what it does"))),
                ("symbols", &symbols),
            ],
        )
    }

    /// The link to the page, among all of them.
    fn card(&self) -> String {
        let (name, [width, height]) = (&self.name, SIZE);
        format!(
            "<li><a href=\"{name}{}.html\"><img src=\"{name}.png\" width=\"{width}\" height=\"{height}\" alt=\"\" loading=\"lazy\">\
             {}</a></li>\n",
            language::ending(),
            escape(&self.title)
        )
    }
}

/// An exercise that asks for the rules, for systems with few rules that each picture decides.
fn own_exercise(entry: &Entry) -> Option<String> {
    let Entry { definition, system, .. } = entry;
    if kind(system) != "deterministic" || definition.rules.lines().count() > MAX_RULES {
        return None;
    }
    let exercise = Exercise { title: definition.label().to_owned(), target: definition.clone(), ..Exercise::default() };
    try_out(&exercise).ok().map(|_| exercise.write())
}

fn code(text: &str) -> String {
    format!("<code>{}</code>", escape(text))
}

fn degrees(angle: Option<f64>) -> String {
    angle.map_or_else(String::new, |angle| format!("{angle}°"))
}

/// What the name of a page has before `html` in a language.
fn others(language: &str) -> String {
    if language == "en" { String::new() } else { format!("{language}.") }
}

/// The links to a page in all languages.
fn alternates(languages: &[String], address: impl Fn(&str) -> String) -> String {
    let all = ["en"].into_iter().chain(languages.iter().map(String::as_str));
    all.map(|language| {
        let page = escape(&address(&others(language)));
        format!("<link rel=\"alternate\" hreflang=\"{language}\" href=\"{page}\">\n")
    })
    .collect()
}

/// The page with all systems, by shelf.
fn index(template: &str, shelves: &[Shelf], cards: &HashMap<String, String>, sources: &Sources) -> Result<String> {
    let site = sources.address;
    let (title, description) =
        (&*say!("Gallery"), &*say!("All systems of the gallery: plants, curves, tilings, stars and trees in space."));
    let mut body = format!("<h1>{}</h1>\n<p>{}</p>\n", escape(title), escape(description));
    for Shelf { name, paths } in shelves {
        let cards: String = paths.iter().filter_map(|path| cards.get(path)).map(String::as_str).collect();
        if !cards.is_empty() {
            write!(body, "<h2>{}</h2>\n<ul class=\"shelf\">\n{cards}</ul>\n", escape(&said(name)))?;
        }
    }
    let address = |part: &str| {
        format!("{site}{FOLDER}/{}", if part.is_empty() { String::new() } else { format!("index.{part}html") })
    };
    let own = address(&others(language::language()));
    let others = alternates(sources.languages, address);
    let head = format!("<link rel=\"canonical\" href=\"{own}\">\n{others}");
    let language = language::language();
    Page { docs: "../docs/", name: "", title, description, head: &head, language, body: &body }.fill(template)
}

/// The addresses of all pages for readers (sitemaps.org, version 0.9).
fn sitemap(site: &Path, address: &str) -> Result<String> {
    let mut pages = vec![String::new()];
    for folder in ["docs", FOLDER] {
        for file in fs::read_dir(site.join(folder))? {
            let name = file?.file_name().to_string_lossy().into_owned();
            if name.ends_with(".html") {
                pages.push(format!("{folder}/{}", name.trim_start_matches("index.html")));
            }
        }
    }
    pages.sort();
    let lines: String =
        pages.iter().map(|page| format!("<url><loc>{}</loc></url>\n", escape(&format!("{address}{page}")))).collect();
    Ok(format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <urlset xmlns=\"http://www.sitemaps.org/schemas/sitemap/0.9\">\n{lines}</urlset>\n"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use lsystem::{Definition, Figure, Limits, System, read_file};

    const SITE: &str = "https://example.org/l/";

    fn entry() -> Entry {
        let definition = Definition {
            title: "A \"</script>\" & more".into(),
            axiom: "F".into(),
            rules: "F -> F[+F]F".into(),
            iterations: 2,
            angle: 25.7,
            ..Definition::default()
        };
        let system = System::new(&definition).unwrap();
        let figure = Figure::draw(&system, definition.iterations, &Limits::default()).unwrap();
        Entry { path: "a/b.json".into(), definition, system, figure }
    }

    #[test]
    fn a_page_names_its_picture_and_shows_the_system() {
        let entry = entry();
        let (root, languages) = (Path::new(""), ["de".to_owned()]);
        let sources = Sources { root, site: root, address: SITE, languages: &languages };
        let landing = Landing::new(&entry, "Trees".to_owned(), None, &sources);
        let page = landing.page("{{head}}<title>{{title}}</title>{{body}}").unwrap();
        for part in [
            "<meta property=\"og:image\" content=\"https://example.org/l/gallery/a-b.png\">",
            "href=\"https://example.org/l/gallery/a-b.json\" title=\"A &quot;&lt;/script",
            "<h1>A &quot;&lt;/script&gt;&quot; &amp; more</h1>",
            "<code>F -&gt; F[+F]F</code>",
            "<link rel=\"alternate\" hreflang=\"de\" href=\"https://example.org/l/gallery/a-b.de.html\">",
            "<th scope=\"row\">Angle</th><td>25.7°</td>",
            "href=\"../#v=1&amp;title=A%20",
            ">Try the exercise</a>",
            "multiplies the number of segments by 3.",
        ] {
            assert!(page.contains(part), "{part}: {page}");
        }
        assert_eq!(page.matches("</script>").count(), 1, "{page}");
        let data = page.split_once("ld+json\">").unwrap().1.split_once("</script>").unwrap().0;
        let data: Value = serde_json::from_str(data).unwrap();
        assert_eq!(data["name"], entry.definition.title);
        let oembed = landing.oembed();
        assert_eq!(oembed["type"], "rich");
        let frame = oembed["html"].as_str().unwrap();
        assert!(frame.starts_with("<iframe src=\"https://example.org/l/v1/embed.html#v=1&amp;title="), "{frame}");
    }

    #[test]
    fn a_picture_is_small_and_opens_as_its_system() {
        let entry = entry();
        let file = picture(&entry).unwrap();
        assert!(file.len() < 20_000, "{}", file.len());
        assert_eq!(read_file(&file).definition.unwrap(), entry.definition);
        let mut reader = png::Decoder::new(std::io::Cursor::new(&file)).read_info().unwrap();
        assert_eq!([reader.info().width, reader.info().height], SIZE);
        let mut indices = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut indices).unwrap();
        indices.sort_unstable();
        indices.dedup();
        assert!(indices.len() > 1, "the picture is empty");
    }

    #[test]
    fn chance_makes_no_exercise() {
        let mut entry = entry();
        assert!(own_exercise(&entry).is_some());
        entry.definition.rules = "F -> F[+F]F : 1\nF -> FF : 1".into();
        entry.system = System::new(&entry.definition).unwrap();
        assert_eq!(own_exercise(&entry), None);
    }

    #[test]
    fn the_sitemap_has_pages_only() {
        let site = tempfile::tempdir().unwrap();
        for file in ["docs/a.html", "docs/a.svg", "gallery/index.html", "gallery/b.html", "gallery/b.json"] {
            fs::create_dir_all(site.path().join(file).parent().unwrap()).unwrap();
            fs::write(site.path().join(file), "").unwrap();
        }
        let text = sitemap(site.path(), SITE).unwrap();
        let places: Vec<_> = text.split("<loc>").skip(1).map(|part| part.split_once("</loc>").unwrap().0).collect();
        assert_eq!(places, ["", "docs/a.html", "gallery/", "gallery/b.html"].map(|page| format!("{SITE}{page}")));
    }
}
