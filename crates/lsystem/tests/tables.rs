//! The tables of the core in other files must equal the core's: `www/js/tables.js` and `late-tables.js`, the tables of
//! fields in `docs/files.md` and `docs/links.md`, of choices for plots in `docs/plotting.md`, and of notations in
//! `docs/imports.md`. Two more are in `tables/`. `cargo xtask tables` updates them.

mod library;
mod schema;

use expect_test::expect_file;
use lsystem::base::MAX_PICTURE_SIDE;
use lsystem::base::number::number;
use lsystem::course::Asks;
use lsystem::files::{FILE_OPTIONS, FORMATS, FileOption, Format, OptionKind, Purpose};
use lsystem::import::write::{NOTATIONS, Notation};
use lsystem::plot::SHEETS;
use lsystem::syntax::fields::Section;
use lsystem::syntax::{ColourBy, Expected, FIELDS, FieldSpec, Value};
use lsystem::{Definition, Dialect};
use lsystem_catalogue::Catalogue;
use std::fmt::Write;
use std::fs;

/// The text between the types of a definition and its fields.
const FIELD_TYPES: &str = " */

/**
 * What a number may be, and in words; `whole` where it has no fraction.
 * @typedef {{kind: 'number', low: number, high: number, whole?: boolean, expected?: string}} NumberRange
 */

/**
 * What a value may be.
 * @typedef {NumberRange | {kind: 'flag' | 'colour'} | {kind: 'text' | 'colours', maxLength: number} | {kind: 'word', words: readonly string[]} | {kind: 'list', count: number, each: NumberRange} | {kind: 'record', members: Readonly<Record<string, NumberRange | {kind: 'flag'} | {kind: 'text', maxLength: number}>>}} Range
 */

/**
 * A field of the state: its key in links, its default, what it must be in words, what the page calls it, the values
 * under its slider (up to which value they are how far apart) and what an arrow key adds, and what has to be made anew where it changes.
 * @typedef {Range & {link: string, optional?: boolean, default: unknown, label: string, expected: string, unit?: string, slider?: {from: number, parts: readonly (readonly number[])[], arrow: number}, affects: string}} FieldSpec
 */

/** @typedef {keyof Definition | 'view' | 'camera'} FieldName */

/** The fields of the state by name, in the order in which links write them. @type {Readonly<Record<FieldName, FieldSpec>>} */
export const FIELDS = /* @__PURE__ */ Object.freeze({
";

/// The text between the purposes and the choices for files.
const OPTION_TYPE: &str = "});

/**
 * A choice for files: its values and its default, what the page calls it, and what it is.
 * @typedef {{label: string, help: string, unit: string} & ({kind: 'flag'} | {kind: 'number', low: number, high: number, step: number, default: number} | {kind: 'word', words: Readonly<Record<string, string>>, default: string} | {kind: 'size', most: number} | {kind: 'sheet', words: Readonly<Record<string, string>>, default: string, low: number, high: number})} FileOption
 */

/** Choices for files by name; each format lists those that it reads. @type {Readonly<Record<string, FileOption>>} */
export const FILE_OPTIONS = /* @__PURE__ */ Object.freeze({
";

/// A string in JavaScript.
fn quoted(text: &str) -> String {
    format!("'{}'", text.replace('\\', "\\\\").replace('\'', "\\'"))
}

/// A list of strings in JavaScript.
fn list<'a>(words: impl IntoIterator<Item = &'a str>) -> String {
    format!("[{}]", words.into_iter().map(quoted).collect::<Vec<_>>().join(", "))
}

/// A value in JavaScript.
fn script(value: &Value) -> String {
    match value {
        Value::Nothing => "null".to_owned(),
        Value::Flag(flag) => flag.to_string(),
        Value::Number(number) => number.to_string(),
        Value::Text(text) => quoted(text),
        Value::List(list) => format!("[{}]", list.iter().map(script).collect::<Vec<_>>().join(", ")),
    }
}

/// The default of a field; `null` for a field that is not part of a definition.
fn default_of(spec: &FieldSpec) -> Value {
    spec.get(&Definition::default()).unwrap_or(Value::Nothing)
}

/// The limits of a value, as members of a JavaScript object.
fn range(expected: Expected) -> String {
    match expected {
        Expected::Number => "kind: 'number', low: -Infinity, high: Infinity".into(),
        Expected::Between(low, high) => format!("kind: 'number', low: {}, high: {}", number(low), number(high)),
        Expected::Whole(low, high) => format!("kind: 'number', low: {low}, high: {high}, whole: true"),
        Expected::Boolean => "kind: 'flag'".into(),
        Expected::Text(max) => format!("kind: 'text', maxLength: {max}"),
        Expected::Word(words) => format!("kind: 'word', words: {}", list(words.iter().copied())),
        Expected::Colour => "kind: 'colour'".into(),
        Expected::Palette => format!("kind: 'colours', maxLength: {}", lsystem::base::MAX_PALETTE),
        Expected::Each(count, each) => {
            format!("kind: 'list', count: {count}, each: {{ {}, expected: {} }}", range(*each), quoted(&each.words()))
        }
        Expected::Record(members) => {
            let members: Vec<_> =
                members.iter().map(|(name, each)| format!("{name}: {{ {} }}", range(*each))).collect();
            format!("kind: 'record', members: {{ {} }}", members.join(", "))
        }
        other => panic!("no field expects {other:?}"),
    }
}

/// The type of a field in JSDoc.
fn kind(spec: &FieldSpec) -> String {
    let kind = match spec.expected {
        Expected::Number | Expected::Between(..) | Expected::Whole(..) => "number".to_owned(),
        Expected::Boolean => "boolean".to_owned(),
        Expected::Word(words) => words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" | "),
        Expected::Palette => "string[]".to_owned(),
        Expected::Each(count, _) => format!("[{}]", vec!["number"; count].join(", ")),
        _ => "string".to_owned(),
    };
    if spec.optional { kind + " | null" } else { kind }
}

fn tables() -> String {
    let mut script_text = String::from(
        "/** What the core knows and the page shows: written by `cargo xtask tables`, not by hand. */\n\n\
         /** What symbols do, by the name of the dialect in files: what it is called, and what it does in words. */\n\
         export const DIALECTS = /* @__PURE__ */ Object.freeze({\n",
    );
    for dialect in Dialect::ALL {
        let [label, help] = dialect.words().map(quoted);
        writeln!(script_text, "    {}: {{ label: {label}, help: {help} }},", quoted(dialect.name())).unwrap();
    }
    script_text += "});\n\n/** What the colour follows, by its name in files: what it is called, and a note. */\n\
        export const COLOURINGS = /* @__PURE__ */ Object.freeze({\n";
    for by in ColourBy::LISTED {
        let [label, help] = by.words().map(quoted);
        writeln!(script_text, "    {}: {{ label: {label}, help: {help} }},", by.name()).unwrap();
    }
    script_text += "});\n\n/**\n * An L-system as its author wrote it.\n * @typedef {object} Definition\n";
    for spec in FIELDS.iter().filter(|spec| spec.is_defined()) {
        writeln!(script_text, " * @property {{{}}} {} {}", kind(spec), spec.name, spec.help).unwrap();
    }
    script_text += FIELD_TYPES;
    for spec in &FIELDS {
        let mut row = format!("    {}: {{ link: {}, {}", spec.name, quoted(spec.link), range(spec.expected));
        if spec.optional {
            row += ", optional: true";
        }
        write!(row, ", default: {}", script(&default_of(spec))).unwrap();
        write!(row, ", label: {}, expected: {}", quoted(spec.label), quoted(&spec.expected_words())).unwrap();
        if !spec.unit.is_empty() {
            write!(row, ", unit: {}", quoted(spec.unit)).unwrap();
        }
        if let Some(slider) = spec.slider {
            let parts: Vec<_> = slider.parts.iter().map(|(to, by)| format!("[{to}, {by}]")).collect();
            write!(
                row,
                ", slider: {{ from: {}, parts: [{}], arrow: {} }}",
                slider.from,
                parts.join(", "),
                slider.arrow
            )
            .unwrap();
        }
        writeln!(script_text, "{row}, affects: {} }},", quoted(spec.affects.name())).unwrap();
    }
    script_text += "});\n\n/** Attributes of the element and the keys in links that they stand for. */\n";
    let pairs: Vec<_> = FIELDS.iter().map(|spec| format!("{}: {}", spec.attribute(), quoted(spec.link))).collect();
    writeln!(script_text, "export const ATTRIBUTES = {{ {} }};", pairs.join(", ")).unwrap();
    script_text
}

/// The tables that the first screen does without: kinds of exercises, and files.
fn late_tables() -> String {
    let mut script_text = String::from(
        "/** What the core knows and late parts of the page show: written by `cargo xtask tables`, not by hand. */\n\n\
         /**\n * What an exercise can ask for, by name: what must be the same, the task where none is given, whether\n\
         \x20* other answers can be searched, and whether the string counts.\n */\n\
         export const ASKS = /* @__PURE__ */ Object.freeze({\n",
    );
    for asks in Asks::ALL {
        let [name, label, task] = [asks.name(), asks.label(), asks.task()].map(quoted);
        let (searched, text) = (asks.is_searched(), asks.is_text());
        writeln!(
            script_text,
            "    {name}: {{ label: {label}, task: {task}, isSearched: {searched}, isText: {text} }},"
        )
        .unwrap();
    }
    script_text += "});\n\n/** Formats of exported files by name: ending and media type of the file, what the page calls it, and what it is. */\n\
        export const FORMATS = /* @__PURE__ */ Object.freeze({\n";
    for format in &FORMATS {
        let [name, ending, mime, label, help] =
            [format.name, format.ending, format.mime, format.label, format.help].map(quoted);
        let (picture, purposes) = (format.is_picture(), list(format.purposes.iter().map(|purpose| purpose.name())));
        let (content, options) = (quoted(format.content.name()), list(format.options.iter().copied()));
        writeln!(
            script_text,
            "    {name}: {{ ending: {ending}, mime: {mime}, label: {label}, help: {help}, picture: {picture}, purposes: {purposes}, content: {content}, options: {options} }},"
        )
        .unwrap();
    }
    script_text += "});\n\n/** Notations that systems are written in, by name: what the page calls them, what they are, and the ending of files. */\n\
        export const NOTATIONS = /* @__PURE__ */ Object.freeze({\n";
    for notation in &NOTATIONS {
        let Notation { name, label, help, ending, .. } = notation;
        let [name, label, help, ending] = [name, label, help, ending].map(|text| quoted(text));
        writeln!(script_text, "    {name}: {{ label: {label}, help: {help}, ending: {ending} }},").unwrap();
    }
    script_text += "});\n\n/** The letters of ASCII that draw, by dialect. */\nexport const DRAWS = /* @__PURE__ */ Object.freeze({\n";
    for dialect in Dialect::ALL {
        let letters: String = ('A'..='Z')
            .chain('a'..='z')
            .filter(|letter| dialect.actions(*letter).iter().any(|action| action.draws()))
            .collect();
        writeln!(script_text, "    {}: {},", quoted(dialect.name()), quoted(&letters)).unwrap();
    }
    script_text += "});\n\n/** What files are for, in the order of the page's dialog, with labels. */\n\
        export const PURPOSES = /* @__PURE__ */ Object.freeze({\n";
    for purpose in Purpose::ALL {
        writeln!(script_text, "    {}: {},", purpose.name(), quoted(purpose.label())).unwrap();
    }
    script_text += OPTION_TYPE;
    for option in &FILE_OPTIONS {
        let [label, help, unit] = [option.label, option.help, option.unit].map(quoted);
        let kind = option_kind(option);
        let name = quoted(option.name);
        writeln!(script_text, "    {name}: {{ {kind}, label: {label}, help: {help}, unit: {unit} }},").unwrap();
    }
    script_text += "});\n\n/** Sheets of paper in portrait by name: width and height in millimetres. */\n\
        export const SHEETS = /* @__PURE__ */ Object.freeze({\n";
    for (name, width, height) in SHEETS {
        writeln!(script_text, "    {name}: [{width}, {height}],").unwrap();
    }
    script_text += "});\n";
    script_text
}

/// Words with their labels, as members of a JavaScript object.
fn labels(words: &[(&str, &str)]) -> String {
    words.iter().map(|(word, label)| format!("{}: {}", quoted(word), quoted(label))).collect::<Vec<_>>().join(", ")
}

/// The values of a choice for files, as members of a JavaScript object.
fn option_kind(option: &FileOption) -> String {
    match option.kind {
        OptionKind::Flag => "kind: 'flag'".to_owned(),
        OptionKind::Number { low, high, step, default } => {
            format!("kind: 'number', low: {low}, high: {high}, step: {step}, default: {default}")
        }
        OptionKind::Word { words, default } => {
            format!("kind: 'word', words: {{ {} }}, default: {}", labels(words), quoted(default))
        }
        OptionKind::Sheet { words, default, low, high } => {
            let words = labels(words);
            format!("kind: 'sheet', words: {{ {words} }}, default: {}, low: {low}, high: {high}", quoted(default))
        }
        OptionKind::Size => format!("kind: 'size', most: {MAX_PICTURE_SIDE}"),
    }
}

/// A text in which `rows` replace the text between the marks of a table.
fn with_table(text: &str, rows: &str) -> String {
    let (begin, end) = ("<!-- fields: written by `cargo xtask tables` -->\n", "<!-- end of fields -->");
    let (before, rest) = text.split_once(begin).expect("the table begins");
    let (_, after) = rest.split_once(end).expect("the table ends");
    format!("{before}{begin}{rows}{end}{after}")
}

/// The meaning and the values of a field, for a table in a document.
fn meaning(spec: &FieldSpec) -> String {
    format!("{}: {}", spec.help, spec.expected_words()).replace('|', "\\|")
}

/// Code in a table; empty for an empty text.
fn code(text: &str) -> String {
    if text.is_empty() { "none".to_owned() } else { format!("`{text}`") }
}

fn file_rows() -> String {
    let mut rows = String::from("| object | key | default | what it is, and what it must be |\n|---|---|---|---|\n");
    for (section, name) in [(Section::File, "the file"), (Section::Turtle, "`turtle`"), (Section::Style, "`style`")] {
        for spec in &FIELDS {
            if let Some((place, key)) = spec.file
                && place == section
            {
                let default = serde_json::to_string(&default_of(spec)).unwrap().replace(".0", "");
                writeln!(rows, "| {name} | `{key}` | `{default}` | {} |", meaning(spec)).unwrap();
            }
        }
    }
    rows
}

/// A default as in links.
fn linked(value: &Value) -> String {
    match value {
        Value::Nothing => String::new(),
        Value::Flag(flag) => u8::from(*flag).to_string(),
        Value::Number(number) => number.to_string(),
        Value::Text(text) => text.trim_start_matches('#').to_owned(),
        Value::List(list) => list.iter().map(linked).collect::<Vec<_>>().join(","),
    }
}

fn link_rows() -> String {
    let mut rows = String::from("| key | default | what it is, and what it must be |\n|---|---|---|\n");
    for spec in FIELDS.iter().filter(|spec| spec.is_defined()) {
        writeln!(rows, "| `{}` | {} | {} |", spec.link, code(&linked(&default_of(spec))), meaning(spec)).unwrap();
    }
    rows
}

/// The choices for plots.
fn plot_rows() -> String {
    let mut rows = String::from("| option | what it is, and what it must be | default |\n|---|---|---|\n");
    let plotter = Format::named("plotter").unwrap();
    for option in plotter.options.iter().map(|name| FileOption::named(name).unwrap()) {
        let unit = if option.unit.is_empty() { String::new() } else { format!(" {}", option.unit) };
        let (values, default) = match option.kind {
            OptionKind::Flag => (String::new(), String::new()),
            OptionKind::Number { default, .. } => (format!(": {}", option.expected_words()), number(default)),
            OptionKind::Word { default, .. } | OptionKind::Sheet { default, .. } => {
                (format!(": {}", option.expected_words()), code(default))
            }
            OptionKind::Size => (format!(": {}", option.expected_words()), String::new()),
        };
        writeln!(rows, "| `--{}` | {}{values}{unit} | {default} |", option.name, option.help).unwrap();
    }
    rows
}

/// The notations that systems are written in.
fn notation_rows() -> String {
    let mut rows = String::from("| name | what is written | what cannot be expressed |\n|---|---|---|\n");
    for notation in &NOTATIONS {
        let lacks: Vec<&str> = notation.lacks().collect();
        writeln!(rows, "| `{}` | {} | {} |", notation.name, notation.help, lacks.join(", ")).unwrap();
    }
    rows
}

#[test]
fn every_purpose_but_films_has_a_format() {
    for purpose in Purpose::ALL {
        // The page has a dialog of its own for films.
        let has_format = FORMATS.iter().any(|format| format.purposes.contains(&purpose));
        assert_eq!(has_format, purpose != Purpose::Film, "{purpose:?}");
    }
}

#[test]
fn the_pages_tables_are_those_of_the_core() {
    expect_file!["../../../www/js/tables.js"].assert_eq(&tables());
    expect_file!["../../../www/js/late-tables.js"].assert_eq(&late_tables());
}

/// The languages of the page: the folders of `www/lang`, by the names that they have for themselves.
#[test]
fn the_page_knows_the_languages() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../www/lang");
    let name = |code: &String| {
        let words = fs::read_to_string(format!("{folder}/{code}/words.json")).unwrap();
        let own = Catalogue::new(code, &words).unwrap().find("English", None).unwrap();
        format!("{code}: '{own}'")
    };
    let languages: Vec<_> = lsystem_catalogue::languages(folder.as_ref()).unwrap().iter().map(name).collect();
    let text = format!(
        "/** The languages in `lang/`, each by its own name: written by `cargo xtask tables`, not by hand. */\n\
         export const LANGUAGES = Object.freeze({{ en: 'English', {} }});\n",
        languages.join(", ")
    );
    expect_file!["../../../www/js/languages.js"].assert_eq(&text);
}

#[test]
fn the_documents_tables_are_those_of_the_core() {
    let files = include_str!("../../../docs/files.md");
    expect_file!["../../../docs/files.md"].assert_eq(&with_table(files, &file_rows()));
    let links = include_str!("../../../docs/links.md");
    expect_file!["../../../docs/links.md"].assert_eq(&with_table(links, &link_rows()));
    let imports = include_str!("../../../docs/imports.md");
    expect_file!["../../../docs/imports.md"].assert_eq(&with_table(imports, &notation_rows()));
    let plotting = include_str!("../../../docs/plotting.md");
    expect_file!["../../../docs/plotting.md"].assert_eq(&with_table(plotting, &plot_rows()));
}

#[test]
fn names_and_keys_stand_for_one_field_each() {
    let unique = |of: fn(&FieldSpec) -> String| {
        let mut names: Vec<_> = FIELDS.iter().map(of).collect();
        names.sort_unstable();
        names.windows(2).all(|pair| pair[0] != pair[1])
    };
    assert!(unique(|spec| spec.name.to_owned()));
    assert!(unique(|spec| spec.link.to_owned()));
    assert!(unique(|spec| spec.attribute().to_owned()));
    assert!(unique(|spec| spec.file.map_or(spec.name.to_owned(), |(place, key)| format!("{place:?} {key}"))));
}

#[test]
fn defaults_are_within_their_ranges_and_sliders() {
    for spec in &FIELDS {
        assert!(spec.admits(&default_of(spec)) || !spec.is_defined(), "{}", spec.name);
        for (value, _) in spec.slider.iter().flat_map(|slider| slider.parts) {
            assert!(spec.expected.admits(*value), "{}", spec.name);
        }
    }
}

#[test]
fn every_field_is_read_and_written() {
    for spec in FIELDS.iter().filter(|spec| spec.is_defined()) {
        let mut definition = Definition::default();
        let value = other(spec);
        assert!(spec.admits(&value) && spec.set(&mut definition, &value), "{}", spec.name);
        assert_eq!(spec.get(&definition), Some(value), "{}", spec.name);
        assert_ne!(definition, Definition::default(), "{}", spec.name);
    }
}

/// A value of a field other than its default.
fn other(spec: &FieldSpec) -> Value {
    match (spec.expected, default_of(spec)) {
        (Expected::Word(words), default) => {
            let word = words.iter().find(|word| default != Value::Text((**word).to_owned()));
            Value::Text(word.copied().unwrap_or_default().to_owned())
        }
        (Expected::Colour, _) => Value::Text("#123456".into()),
        (_, Value::Nothing) => Value::Number(5.0),
        (_, Value::Flag(flag)) => Value::Flag(!flag),
        (_, Value::Number(number)) => {
            let mut others = [2.0, 0.5, 0.0].map(Value::Number).into_iter();
            others.find(|value| spec.admits(value) && *value != Value::Number(number)).unwrap_or(Value::Nothing)
        }
        (_, Value::Text(text)) => Value::Text(text + "F"),
        (_, Value::List(mut list)) => {
            list.reverse();
            list[0] = if matches!(list[0], Value::Number(_)) { Value::Number(7.0) } else { list[0].clone() };
            Value::List(list)
        }
    }
}
