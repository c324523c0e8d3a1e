//! Rules of strings, as `lsys find` finds them.

use expect_test::{Expect, expect};
use std::process::Command;

fn told(words: &[&str], expected: &Expect) {
    let output = Command::new(env!("CARGO_BIN_EXE_lsys")).env("LC_ALL", "C").args(words).output().expect("lsys runs");
    let text = String::from_utf8([output.stdout, output.stderr].concat()).expect("UTF-8");
    expected.assert_eq(&format!("{:?}\n{text}", output.status.code()));
}

#[test]
fn rules_are_found() {
    told(
        &["find", "ABAABABA", "--axiom", "A", "-n", "4"],
        &expect![[r#"
        Some(0)
        A -> AB
        B -> A
          after 4 steps from A; 5 symbols

        Searched: n = 4: one rule with up to 60 symbols, 2 rules with up to 38 symbols.
    "#]],
    );
    told(
        &["find", "F[+F]F[+F[+F]F]F[+F]F", "--axiom", "F", "--json"],
        &expect![[r#"
        Some(0)
        {
          "candidates": [
            {
              "axiom": "F",
              "n": 2,
              "rules": [
                "F -> F[+F]F"
              ],
              "symbols": 7
            },
            {
              "axiom": "F",
              "n": 1,
              "rules": [
                "F -> F[+F]F[+F[+F]F]F[+F]F"
              ],
              "symbols": 22
            }
          ],
          "searched": "n = 1: one rule with up to 60 symbols; n = 2: one rule with up to 60 symbols; n = 3: one rule with up to 60 symbols; n = 4: one rule with up to 60 symbols; n = 5: one rule with up to 60 symbols; n = 6: one rule with up to 60 symbols; n = 7: one rule with up to 60 symbols; n = 8: one rule with up to 60 symbols"
        }
    "#]],
    );
    told(
        &["find", "+", "--axiom", "F", "-n", "1", "--constants", "F"],
        &expect![[r#"
        Some(1)
        Nothing found. Searched: n = 1: one rule with up to 60 symbols.
    "#]],
    );
    told(
        &["find", "", "--axiom", "F", "-n", "2"],
        &expect![[r#"
        Some(1)
        error: The string must have 1 to 65,536 symbols.
    "#]],
    );
}

/// Runs `lsys` and gives its exit code and what it printed.
fn output(words: &[&str]) -> (Option<i32>, Vec<u8>) {
    let output = Command::new(env!("CARGO_BIN_EXE_lsys")).env("LC_ALL", "C").args(words).output().expect("lsys runs");
    (output.status.code(), [output.stdout, output.stderr].concat())
}

#[test]
fn rules_of_pictures_are_found() {
    let folder = tempfile::tempdir().expect("a folder");
    let system = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data_in/assignment-8/left_plant.json");
    let (_, picture) = output(&["draw", system, "--format", "png", "--size", "400x400", "-n", "4"]);
    let file = folder.path().join("plant.png");
    std::fs::write(&file, &picture).expect("a file");
    let name = file.to_str().expect("UTF-8");
    let all = [&["--angle", "60", "-n", "4"][..], &["--angle", "60"], &["--heading", "90", "-n", "4"]];
    for known in test_effort::sampled(all, 2, 0) {
        let (code, told) = output(&[&["find", name, "--axiom", "F", "--json"], known].concat());
        let told: serde_json::Value = serde_json::from_slice(&told).expect("JSON");
        let best = &told["candidates"][0];
        assert_eq!(code, Some(0), "{told}");
        assert_eq!((best["rules"][0].as_str(), best["n"].as_u64()), (Some("F -> F[+F]F"), Some(4)), "{told}");
        assert!(best["agreement"].as_f64().is_some_and(|agreement| agreement >= 0.985), "{told}");
        assert!(told["searched"].as_str().is_some_and(|words| words.contains("one rule for F up to")), "{told}");
    }
    // The same as exact segments. A search where nothing is known takes half a minute; the library's tests have others.
    for (format, known) in [("csv", &["--angle", "60"][..]), ("svg", &["--axiom", "F", "--angle", "60"])] {
        let (_, segments) = output(&["draw", system, "--format", format, "-n", "4"]);
        let file = folder.path().join(format!("plant.{format}"));
        std::fs::write(&file, &segments).expect("a file");
        let known = if test_effort::is_thorough() { &[] } else { known };
        let (code, told) = output(&[&["find", file.to_str().expect("UTF-8"), "--json"], known].concat());
        let told: serde_json::Value = serde_json::from_slice(&told).expect("JSON");
        assert_eq!((code, told["candidates"][0]["rules"][0].as_str()), (Some(0), Some("F -> F[+F]F")), "{told}");
    }
    let (code, told) = output(&["find", name, "--axiom", "F+F", "--angle", "90", "-n", "4", "--seconds", "0"]);
    let told = String::from_utf8(told).expect("UTF-8");
    assert!(code == Some(1) && told.contains("Searched: angle 90°; n = 4: from F+F: one rule for F up to"), "{told}");
    std::fs::write(&file, &picture[..picture.len() / 2]).expect("a file");
    let (code, told) = output(&["find", name, "--axiom", "F"]);
    let told = String::from_utf8(told).expect("UTF-8");
    assert!(code == Some(1) && told.starts_with(&format!("error: {name}: ")), "{told}");
}

/// Writes a picture of one bit a pixel, black and white in turn.
fn striped(path: &std::path::Path, side: u32) {
    let file = std::fs::File::create(path).expect("a file");
    let mut encoder = png::Encoder::new(std::io::BufWriter::new(file), side, side);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::One);
    let rows = vec![0x55; side.div_ceil(8) as usize * side as usize];
    encoder.write_header().and_then(|mut writer| writer.write_image_data(&rows)).expect("written");
}

#[cfg(target_os = "linux")]
#[test]
fn pictures_have_bounds() {
    let folder = tempfile::tempdir().expect("a folder");
    for (side, why) in [(8_001, "more than 64,000,000 pixels"), (6_000, "no lines are seen")] {
        let path = folder.path().join("striped.png");
        striped(&path, side);
        let script = format!("ulimit -v 500000; {} find {}", env!("CARGO_BIN_EXE_lsys"), path.display());
        let output = Command::new("sh").env("LC_ALL", "C").args(["-c", &script]).output().expect("a shell");
        let told = String::from_utf8(output.stderr).expect("UTF-8");
        assert!(output.status.code() == Some(1) && told.contains(why), "{side}: {told}");
    }
}

#[test]
fn without_time_a_part_is_searched() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("lines.csv");
    std::fs::write(&file, "0,0,1,0\n1,0,1,7\n1,7,3,2\n").expect("a file");
    let (code, told) = output(&["find", file.to_str().expect("UTF-8"), "--axiom", "F", "--seconds", "0"]);
    let told = String::from_utf8(told).expect("UTF-8");
    assert!(code == Some(1) && told.contains("from F: one rule for F up to"), "{told}");
    let (code, told) = output(&["find", "ABAABABA", "--axiom", "A", "-n", "4", "--seconds", "0"]);
    assert!(code == Some(0) && told.starts_with(b"A -> AB\nB -> A\n"));
    let (code, told) = output(&["find", "+", "--axiom", "F", "-n", "1", "--constants", "F", "--seconds", "0"]);
    assert!(code == Some(1) && told.starts_with(b"Nothing found. Searched: n = 1: one rule"));
}

#[test]
fn pictures_of_other_programs_are_drawn_or_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let system = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data_in/assignment-8/left_plant.json");
    let (_, picture) = output(&["draw", system, "--format", "svg", "-n", "4"]);
    let picture = String::from_utf8(picture).expect("UTF-8");
    let find = |name: &str, bytes: &[u8]| {
        let file = folder.path().join(name);
        std::fs::write(&file, bytes).expect("a file");
        let (code, told) = output(&["find", file.to_str().expect("UTF-8"), "--axiom", "F", "--angle", "60", "-n", "4"]);
        (code, String::from_utf8(told).expect("UTF-8"))
    };
    // A text is no segment, so the picture is drawn.
    let (code, told) = find("plant.svg", picture.replace("</svg>", "<text>F</text></svg>").as_bytes());
    assert!(code == Some(0) && told.contains("F -> F[+F]F") && told.contains("left out: text"), "{told}");
    for (bytes, words) in [
        (&b"II*\0\xff\xff"[..], "TIFF pictures are not read: save this one as a PNG, a JPEG or an SVG"),
        (b"\xff\xd8\xff\xe0", "error: "),
        (b"GIF89a", "error: "),
        (b"RIFF....WEBPVP8 ", "error: "),
        (
            b"<svg viewBox='0 0 9 9'><path stroke-dasharray='1e-9' d='M0 0h9' stroke='#000'/><use/></svg>",
            "too many dashes",
        ),
        (b"<svg><g></svg>", "this SVG is damaged"),
    ] {
        let (code, told) = find("other", bytes);
        assert!(code == Some(1) && told.contains(words), "{told}");
    }
}

/// A picture in a format, from levels of grey.
fn encoded(grey: &image::GrayImage, format: image::ImageFormat) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let picture = image::DynamicImage::ImageLuma8(grey.clone());
    let picture = match format {
        image::ImageFormat::Gif | image::ImageFormat::WebP => image::DynamicImage::ImageRgba8(picture.into_rgba8()),
        _ => picture,
    };
    picture.write_to(&mut bytes, format).expect("a picture");
    bytes.into_inner()
}

#[test]
fn pictures_of_all_formats_of_the_page_are_read_and_those_of_the_gallery_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let system = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data_in/curves/koch-snowflake.json");
    let (_, picture) = output(&["draw", system, "--format", "png", "--size", "500x500", "-n", "3"]);
    let grey = image::load_from_memory(&picture).expect("a picture").into_luma8();
    for format in [image::ImageFormat::Png, image::ImageFormat::Jpeg, image::ImageFormat::Gif, image::ImageFormat::WebP]
    {
        // The ending of the name does not matter.
        let file = folder.path().join("picture");
        std::fs::write(&file, encoded(&grey, format)).expect("a file");
        let name = file.to_str().expect("UTF-8");
        let (code, told) = output(&["find", name, "--axiom", "F--F--F", "--angle", "60", "-n", "3", "--json"]);
        let told: serde_json::Value = serde_json::from_slice(&told).expect("JSON");
        let best = &told["candidates"][0];
        assert_eq!((code, best["same"].as_bool()), (Some(0), Some(true)), "{format:?} {told}");
        assert_eq!(best["gallery"].as_str(), Some("Koch snowflake (curves/koch-snowflake)"), "{format:?} {told}");
    }
    let file = folder.path().join("picture");
    let name = file.to_str().expect("UTF-8");
    let (code, told) = output(&["find", name, "--axiom", "F--F--F", "--angle", "60", "-n", "3"]);
    let told = String::from_utf8(told).expect("UTF-8");
    let first = "The same picture:\n\nKoch snowflake (curves/koch-snowflake), in the gallery:\nF -> F+F--F+F\n";
    assert!(code == Some(0) && told.starts_with(first), "{told}");
    // A file that ends in the middle is told.
    let bytes = encoded(&grey, image::ImageFormat::Jpeg);
    for end in [bytes.len() / 8, 4] {
        std::fs::write(&file, &bytes[..end]).expect("a file");
        let (code, told) = output(&["find", name, "--axiom", "F--F--F", "--angle", "60", "-n", "3", "--seconds", "0"]);
        let told = String::from_utf8(told).expect("UTF-8");
        assert!(code == Some(1) && !told.contains("The same picture"), "{told}");
    }
}
