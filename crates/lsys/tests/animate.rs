//! Films, as `lsys animate` writes them.

use crate::program;

use program::output;
use std::fs;
use std::path::Path;
use std::process::Output;

const BUSH: &str = r#"{"name": "bush", "initial": "X", "angle_deg": 22.5, "num_iters": 4,
    "rules": {"X": "F-[[X]+X]+F[+FX]-X", "F": "FF"}}"#;
const SPIRE: &str = r#"{"name": "spire", "initial": "X", "angle_deg": 30, "num_iters": 4,
    "rules": {"X": "F&[X]/[X]", "F": "FF"}, "turtle": {"dialect": "abop"}}"#;

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("bush.json"), BUSH).expect("written");
    fs::write(folder.path().join("spire.json"), SPIRE).expect("written");
    folder
}

fn done(folder: &Path, line: &str) -> Vec<u8> {
    let Output { status, stdout, stderr } = output(folder, line);
    assert!(status.success(), "{line}: {}", String::from_utf8_lossy(&stderr));
    stdout
}

fn refused(folder: &Path, line: &str) -> String {
    let Output { status, stderr, .. } = output(folder, line);
    assert!(!status.success(), "{line}");
    String::from_utf8(stderr).expect("UTF-8")
}

/// The frames of raw pixels.
fn raw(folder: &Path, options: &str) -> Vec<Vec<u8>> {
    let line = format!("animate bush.json --to - --format rgba --size 64x48 --seconds 1 --fps 5{options}");
    done(folder, &line).chunks(64 * 48 * 4).map(<[u8]>::to_vec).collect()
}

#[test]
fn gifs_decode_to_the_frames() {
    let folder = folder();
    let path = folder.path();
    let line = "animate bush.json --to out.gif --size 64x48 --seconds 1 --fps 5";
    assert!(done(path, line).is_empty());
    let bytes = fs::read(path.join("out.gif")).expect("a file");
    assert_eq!(done(path, "animate bush.json --to - --format gif --size 64x48 --seconds 1 --fps 5"), bytes);
    let frames = raw(path, "");
    assert_eq!(frames.len(), 5);

    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(&bytes[..]).expect("a GIF");
    assert_eq!(decoder.repeat(), gif::Repeat::Infinite);
    let mut canvas = vec![0; 64 * 48 * 4];
    let mut found = 0;
    while let Some(frame) = decoder.read_next_frame().expect("a frame") {
        let [left, top, width] = [frame.left, frame.top, frame.width].map(usize::from);
        for (at, pixel) in frame.buffer.chunks(4).enumerate().filter(|(_, pixel)| pixel[3] == 255) {
            canvas[((top + at / width) * 64 + left + at % width) * 4..][..4].copy_from_slice(pixel);
        }
        assert!(canvas == frames[found], "{found}");
        assert_eq!(frame.delay, 20);
        found += 1;
    }
    assert_eq!(found, 5);
}

#[test]
fn folders_get_numbered_pictures() {
    let folder = folder();
    let path = folder.path();
    done(path, "animate bush.json --to frames --size 64x48 --seconds 1 --fps 5 --turtle");
    let mut names: Vec<_> =
        fs::read_dir(path.join("frames")).expect("a folder").map(|file| file.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["0000.png", "0001.png", "0002.png", "0003.png", "0004.png"]);
    let again = refused(path, "animate bush.json --to frames --size 64x48");
    assert!(again.contains("not empty"), "{again}");
}

#[test]
fn frames_go_to_other_programs() {
    let folder = folder();
    let path = folder.path();
    let y4m = done(path, "animate bush.json --to - --size 64x48 --seconds 1 --fps 5");
    assert!(y4m.starts_with(b"YUV4MPEG2 W64 H48 F5:1 Ip A1:1 C444 XCOLORRANGE=LIMITED\nFRAME\n"));
    let head = y4m.iter().position(|&byte| byte == b'\n').expect("a line") + 1;
    assert_eq!(y4m.len(), head + 5 * (6 + 64 * 48 * 3));
    let png = done(path, "animate bush.json --to - --format png --size 64x48 --seconds 1 --fps 5 --dive");
    assert_eq!(png.windows(8).filter(|bytes| *bytes == b"\x89PNG\r\n\x1a\n").count(), 5);
    // The same film has the same frames, whatever its text form.
    let angle = raw(path, " --track angle=0:10,1:30");
    assert_eq!(angle, raw(path, " --film 1;angle=0:10,1:30"));
    assert!(angle.windows(2).all(|pair| pair[0] != pair[1]));
    let turned = done(path, "animate spire.json --to - --format rgba --size 32x32 --seconds 1 --fps 4 --turntable");
    assert_eq!(turned.len(), 4 * 32 * 32 * 4);
}

#[test]
fn growth_keeps_the_frame_of_the_end_unless_it_is_followed() {
    let folder = folder();
    let path = folder.path();
    // A track that ends with the film, so that the last frame is the end.
    let track = " --loop once --track n=0:0,1:4 --growth";
    let (fixed, follow) = (raw(path, track), raw(path, &format!("{track} --follow")));
    assert_eq!(fixed[4], follow[4]);
    assert!((0..4).all(|frame| fixed[frame] != follow[frame]));
    assert_eq!(fixed, raw(path, " --film 1;once;fixed;n=0:0,1:4"));
}

#[test]
fn wind_is_a_loop_around_the_still_plant() {
    let folder = folder();
    let path = folder.path();
    let wind = raw(path, " --sway");
    assert!(wind.windows(2).all(|pair| pair[0] != pair[1]));
    assert_eq!(wind, raw(path, " --film 1;sway=0:3/0,1:3/360"));
    // The system's own strength.
    assert_eq!(raw(path, " --sway --set sway=[8,90]"), raw(path, " --track sway=0:8/0,1:8/360"));
    assert_eq!(raw(path, " --track sway=0:0/0,1:0/360")[0], raw(path, " --track hue=0:0")[0]);
}

#[test]
fn mistakes_are_told() {
    let folder = folder();
    let path = folder.path();
    let told = |options: &str| refused(path, &format!("animate bush.json --to out.gif --size 64x48 {options}"));
    assert!(told("--turntable").contains("in the plane"));
    assert!(told("--sway --set rules=X->F").contains("this drawing has none"));
    assert!(told("--film 1;moon=0:1").contains("film, `moon`: a track is"));
    assert!(told("--track rules.r=0:1").contains("the rules have no constant `r`"));
    assert!(told("--dive=999999").contains("the drawing has"));
    assert!(told("--fps 99").contains("1 to 60 frames a second"));
    assert!(told("--format y4m").contains("standard output"));
    // Half a billion symbols at random take more than a film's drawing may.
    let random = r#"{"name": "r", "initial": "F", "num_iters": 18, "rules": {"F": [{"p": 0.5, "e": "FFF"}, {"p": 0.5, "e": "F+FF"}]}}"#;
    fs::write(path.join("random.json"), random).expect("written");
    assert!(refused(path, "animate random.json --to out.gif --size 64x48 --fps 1").contains("of the film"));
    assert!(!path.join("out.gif").exists());
    assert!(
        fs::read_dir(path).expect("a folder").all(|file| !file.unwrap().file_name().to_string_lossy().contains("tmp"))
    );
}
