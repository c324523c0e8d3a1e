//! Pyramids of tiles, made by one process and by several.

use crate::program;

use program::{command, root};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

fn tiles(folder: &Path, more: &str) -> Command {
    let mut command = command(root(), ["tiles", "data_in/abop/1.24f.json"]);
    command.arg(folder).args(more.split_whitespace());
    command
}

fn run(folder: &Path, more: &str) -> String {
    let output = tiles(folder, more).output().expect("lsys runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// All files below a folder, by path.
fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(next).expect("readable").flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(folder).expect("inside").to_owned();
                found.insert(name, fs::read(&path).expect("readable"));
            }
        }
    }
    found
}

#[test]
fn the_page_has_the_language_of_its_maker() {
    let folder = tempfile::tempdir().unwrap();
    for (language, level) in [("en", "Level {} of {}"), ("de", "Ebene {} von {}"), ("fr", "Niveau {} sur {}")] {
        let folder = folder.path().join(language);
        run(&folder, &format!("--levels 0..0 -n 4 --language {language}"));
        let page = fs::read_to_string(folder.join("index.html")).expect("a page");
        assert!(page.contains(&format!("\"language\":\"{language}\"")) && page.contains(level), "{language}: {page}");
    }
}

#[test]
fn workers_make_what_one_makes() {
    let folder = tempfile::tempdir().unwrap();
    let [alone, shared] = ["alone", "shared"].map(|name| folder.path().join(name));
    let told = run(&alone, "--levels 0..3 -n 9");
    assert!(told.ends_with(" 0 kept, 0 without ink\n"), "{told}");
    let expected = files(&alone);
    for name in ["pyramid.json", "index.html", "tiles.dzi", "tiles_files/0/0_0.png", "tiles_files/8/0_0.png"] {
        assert!(expected.contains_key(Path::new(name)), "{name}");
    }
    let deepest = expected.keys().filter(|path| path.starts_with("tiles_files/11")).count();
    assert!((16..60).contains(&deepest), "{deepest} of 64 tiles have ink");

    // A worker is killed in the middle, and the others go on.
    let mut killed = tiles(&shared, "--levels 0..3 -n 9 --threads 1").stdout(Stdio::null()).spawn().unwrap();
    let first = shared.join("tiles_files/9");
    while !first.exists() && killed.try_wait().unwrap().is_none() {
        std::thread::yield_now();
    }
    killed.kill().unwrap();
    killed.wait().unwrap();
    for part in ["1/3", "0/3", "2/3"] {
        run(&shared, &format!("--levels 0..3 -n 9 --part {part} --threads 2"));
    }
    assert!(files(&shared) == expected);
    let told = run(&shared, "--levels 0..3 -n 9");
    assert!(told.starts_with("0 tiles made (0 bytes), "), "{told}");

    let other = tiles(&shared, "--levels 0..3 -n 8").output().unwrap();
    assert!(String::from_utf8_lossy(&other.stderr).contains("tells of another pyramid"));
}

#[test]
fn maps_have_their_own_names_and_depth() {
    let folder = tempfile::tempdir().unwrap();
    run(folder.path(), "--scheme xyz --size 512 --levels 0..1 -n 6 --transparent");
    let made = files(folder.path());
    // The plant leans to the right: its lower left quarter is empty.
    let names: Vec<_> = made.keys().filter(|name| name.extension().is_some_and(|ending| ending == "png")).collect();
    assert_eq!(names, ["0/0/0.png", "1/0/0.png", "1/1/0.png", "1/1/1.png"].map(Path::new).iter().collect::<Vec<_>>());
    assert!(!made.contains_key(Path::new("tiles.dzi")));
    let mut reader = png::Decoder::new(std::io::Cursor::new(&made[Path::new("0/0/0.png")])).read_info().unwrap();
    assert_eq!((reader.info().width, reader.info().color_type), (512, png::ColorType::Rgba));
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();

    // Far below, only what is under a tile with ink.
    let deep = tempfile::tempdir().unwrap();
    run(deep.path(), "--levels 3..3 -n 20 --under 0/0/0 --scheme xyz --part 0/1 --threads 2");
    let tile = files(deep.path()).into_keys().rfind(|path| path.starts_with("3")).unwrap();
    let place = tile.with_extension("").display().to_string();
    let below = tempfile::tempdir().unwrap();
    run(below.path(), &format!("--levels 3..6 -n 20 --scheme xyz --under {place}"));
    let below = files(below.path());
    assert_eq!(below.keys().filter(|path| path.starts_with("3")).count(), 1);
    let deepest = below.keys().filter(|path| path.starts_with("6")).count();
    assert!((1..=64).contains(&deepest), "{deepest}");
}
