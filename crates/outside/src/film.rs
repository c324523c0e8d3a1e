//! Films.

use crate::asked::{Asked, number, numbers};
use crate::made::Made;
use crate::output;
use crate::{equal, near};
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};
use std::path::Path;
use std::process::Command;

/// A plant that grows.
const SYSTEM: &str = "abop/1.24f";
/// The size of a frame.
const SIZE: (u64, u64) = (160, 120);
/// The frames of a film: this many seconds, with this many frames each.
const SECONDS: u64 = 2;
const FPS: u64 = 10;

pub(crate) fn ask(made: &Made<'_>, asked: &mut Asked<'_>) -> Result<()> {
    let gif = made.path("film.gif");
    film(made, gif.to_string_lossy().as_ref(), &[])?;
    asked.look("film as gif", "Pillow", [json!({"look": "gif", "file": gif})], |answers| {
        let film = &answers[0];
        equal("pixels", numbers(&film["size"]), vec![SIZE.0 as f64, SIZE.1 as f64])?;
        equal("frames", film["frames"].as_u64(), Some(SECONDS * FPS))?;
        equal("milliseconds", number(&film["milliseconds"]), 1000.0 * SECONDS as f64)?;
        // Something grows in each frame but the first ones.
        let different = film["different"].as_u64().unwrap_or(0);
        ensure!(different >= SECONDS * FPS / 2, "{different} frames differ");
        Ok(format!("{} frames, {different} different ones, {SECONDS} s", SECONDS * FPS))
    });
    let Some(program) = asked.programs.optional("ffprobe").map(Path::to_owned) else { return Ok(()) };
    asked.note("film as gif", "ffprobe", probe(&program, &[], gif.to_string_lossy().as_ref(), true));
    let folder = made.path("frames");
    film(made, folder.to_string_lossy().as_ref(), &[])?;
    let pattern = folder.join("%04d.png");
    let rate = FPS.to_string();
    let words = ["-framerate", &rate];
    asked.note("film as numbered png", "ffprobe", probe(&program, &words, pattern.to_string_lossy().as_ref(), true));
    let size = format!("{}x{}", SIZE.0, SIZE.1);
    let raw = ["-f", "rawvideo", "-pixel_format", "rgba", "-video_size", &size, "-framerate", &rate];
    for (format, words) in [("y4m", &["-f", "yuv4mpegpipe"][..]), ("rgba", &raw), ("png", &["-f", "png_pipe"])] {
        let file = made.path(&format!("pipe.{format}"));
        let pipe = film(made, "-", &["--format", format])?;
        std::fs::write(&file, pipe)?;
        // A pipe has no length in seconds of its own.
        let result = probe(&program, words, file.to_string_lossy().as_ref(), format == "rgba");
        asked.note(format!("film as {format} on standard output"), "ffprobe", result);
    }
    Ok(())
}

/// Makes the film, and returns standard output.
fn film(made: &Made<'_>, to: &str, words: &[&str]) -> Result<Vec<u8>> {
    let mut command = made.command("animate", SYSTEM);
    let (seconds, rate, size) = (SECONDS.to_string(), FPS.to_string(), format!("{}x{}", SIZE.0, SIZE.1));
    command.args(["--to", to, "--seconds", &seconds, "--fps", &rate, "--size", &size]).args(words);
    let done = command.output()?;
    ensure!(done.status.success(), "lsys makes no film: {}", String::from_utf8_lossy(&done.stderr));
    Ok(done.stdout)
}

/// The size and the number of frames, and the seconds where a file has them.
fn probe(program: &Path, words: &[&str], file: &str, has_seconds: bool) -> Result<String> {
    let mut command = Command::new(program);
    command.args(["-v", "error", "-count_frames", "-select_streams", "v", "-of", "json", "-show_entries"]);
    command.arg("stream=nb_read_frames,width,height,r_frame_rate,duration").args(words).args(["-i", file]);
    let found: Value = serde_json::from_str(&output(&mut command)?)?;
    let stream = found["streams"].get(0).context("ffprobe finds no film")?;
    equal("size", [stream["width"].as_u64(), stream["height"].as_u64()], [Some(SIZE.0), Some(SIZE.1)])?;
    let frames = stream["nb_read_frames"].as_str().and_then(|frames| frames.parse().ok());
    equal("frames", frames, Some(SECONDS * FPS))?;
    if has_seconds {
        equal("frames a second", stream["r_frame_rate"].as_str(), Some(format!("{FPS}/1").as_str()))?;
        let seconds = stream["duration"].as_str().and_then(|seconds| seconds.parse().ok()).unwrap_or(f64::NAN);
        near("seconds", seconds, SECONDS as f64, 1e-6)?;
    }
    Ok(format!("{} frames of {} x {} pixels", SECONDS * FPS, SIZE.0, SIZE.1))
}
