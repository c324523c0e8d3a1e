//! The systems of the gallery that the program carries, for searches of pictures.

use expect_test::expect_file;
use lsystem::files::write_link;
use lsystem::{Definition, Style, System, read_json};
use std::fs;
use std::path::{Path, PathBuf};

/// The JSON files below a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        match path.is_dir() {
            true => files.extend(self::files(&path)),
            false if path.extension().is_some_and(|ending| ending == "json") => files.push(path),
            false => {}
        }
    }
    files.sort();
    files
}

/// With `UPDATE_EXPECT=1` this writes the gallery anew.
#[test]
fn the_program_carries_the_gallery() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data_in");
    let mut text = String::new();
    for path in files(&folder) {
        let definition = read_json(&fs::read_to_string(&path).expect("a text")).0.expect("a system");
        // Pictures of systems in space depend on the camera.
        if System::new(&definition).expect("a system").is_solid() {
            continue;
        }
        let (source, notes) = (String::new(), String::new());
        let link = write_link(&Definition { source, notes, style: Style::default(), ..definition });
        let name = path.strip_prefix(&folder).expect("below the folder").with_extension("");
        text += &format!("{}\t{link}\n", name.to_str().expect("UTF-8").replace('\\', "/"));
    }
    assert!(text.lines().count() > 100, "{text}");
    expect_file!["../src/find/gallery.txt"].assert_eq(&text);
}
