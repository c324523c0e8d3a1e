//! The outputs of a film.

use super::pool::Pool;
use super::words;
use crate::cli::FilmFormat;
use crate::output::within;
use crate::pending::{self, Pending};
use crate::{CommandFailure, print};
use lsystem::base::{say, word};
use lsystem::film::{GifWriter, Palette, PaletteMaker, palette_samples};
use std::fs;
use std::io::{self, IsTerminal, Write};
use std::path::Path;

/// Writes a GIF. The file is either complete or absent.
pub(super) fn gif_to_file(pool: &Pool<'_>, path: &Path) -> Result<(), CommandFailure> {
    let palette = palette(pool)?;
    let wrong = |error: io::Error| CommandFailure::io(path.display(), &error);
    let output = |write: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>| {
        Pending::write(path, |out| write(out)).and_then(Pending::commit).map_err(wrong)
    };
    within(output, |out| gif(pool, &palette, out, &wrong))
}

/// Writes a GIF to standard output.
pub(super) fn gif_to_stdout(pool: &Pool<'_>) -> Result<(), CommandFailure> {
    refuse_terminal()?;
    let palette = palette(pool)?;
    within(|write| print(|out| write(out)), |out| gif(pool, &palette, out, &|error| stdout_failure(&error)))
}

fn stdout_failure(error: &io::Error) -> CommandFailure {
    CommandFailure::io(say!("standard output"), error)
}

fn refuse_terminal() -> Result<(), CommandFailure> {
    match io::stdout().is_terminal() {
        true => Err(words(say!("a terminal cannot show a film: give a file, a folder, or a pipe to another program"))),
        false => Ok(()),
    }
}

/// The palette of a film, from frames that are spread over its time.
fn palette(pool: &Pool<'_>) -> Result<Palette, CommandFailure> {
    let (numbers, size) = palette_samples(pool.film.script());
    let mut maker = PaletteMaker::default();
    pool.run(
        &numbers,
        size,
        word!("colours"),
        |_, pixels| Ok(pixels.to_vec()),
        |_, pixels| {
            maker.add(&pixels);
            Ok(())
        },
    )?;
    Ok(maker.finish())
}

fn all_frames(pool: &Pool<'_>) -> Vec<u32> {
    (0..pool.film.frames()).collect()
}

fn gif(
    pool: &Pool<'_>,
    palette: &Palette,
    out: &mut dyn Write,
    wrong: &dyn Fn(io::Error) -> CommandFailure,
) -> Result<(), CommandFailure> {
    let script = pool.film.script();
    let gif_wrong = |error| words(format!("GIF: {error}"));
    let mut writer = GifWriter::new(script.size, script.ending, palette.clone()).map_err(gif_wrong)?;
    pool.run(
        &all_frames(pool),
        script.size,
        word!("frames"),
        |_, pixels| Ok(palette.index(pixels)),
        |number, sheet| {
            writer.add(&sheet, script.delay_of(number)).map_err(gif_wrong)?;
            out.write_all(&writer.take()).map_err(wrong)
        },
    )?;
    out.write_all(&writer.finish().map_err(gif_wrong)?).map_err(wrong)
}

/// Writes numbered PNG pictures into a folder. Each picture is either complete or absent.
pub(super) fn pngs_to_folder(pool: &Pool<'_>, folder: &Path) -> Result<(), CommandFailure> {
    let wrong = |error: io::Error| CommandFailure::io(folder.display(), &error);
    fs::create_dir_all(folder).map_err(wrong)?;
    pending::remove_dead(folder);
    // Frames of another film between those of this one would be taken for its frames.
    if fs::read_dir(folder).map_err(wrong)?.next().is_some() {
        return Err(words(say!("{}: the folder is not empty", folder.display())));
    }
    let size = pool.film.script().size;
    let digits = (pool.film.frames() - 1).to_string().len().max(4);
    let make = |number: u32, pixels: &[u8]| {
        let bytes = png(size, pixels)?;
        let path = folder.join(format!("{number:0digits$}.png"));
        Pending::write(&path, |out| out.write_all(&bytes)).and_then(Pending::commit).map_err(wrong)
    };
    pool.run(&all_frames(pool), size, word!("frames"), make, |_, ()| Ok(()))
}

/// Writes all frames to standard output, one after the other.
pub(super) fn frames_to_stdout(pool: &Pool<'_>, format: FilmFormat) -> Result<(), CommandFailure> {
    refuse_terminal()?;
    let script = pool.film.script();
    let [width, height] = script.size;
    let make = |_: u32, pixels: &[u8]| match format {
        FilmFormat::Y4m => Ok(y4m_frame(pixels)),
        FilmFormat::Png => png(script.size, pixels),
        _ => Ok(pixels.to_vec()),
    };
    within(
        |write| print(|out| write(out)),
        |out| {
            if format == FilmFormat::Y4m {
                let rate = script.rate;
                let head = format!("YUV4MPEG2 W{width} H{height} F{rate}:1 Ip A1:1 C444 XCOLORRANGE=LIMITED\n");
                out.write_all(head.as_bytes()).map_err(|error| stdout_failure(&error))?;
            }
            pool.run(&all_frames(pool), script.size, word!("frames"), make, |_, bytes| {
                out.write_all(&bytes).map_err(|error| stdout_failure(&error))
            })
        },
    )
}

/// A frame of YUV4MPEG2: luma and two differences of colour for each pixel, of limited range, by ITU-R BT.709.
fn y4m_frame(pixels: &[u8]) -> Vec<u8> {
    /// The parts of red, green and blue, and the offset with a half for rounding, in 2^-16.
    const PLANES: [[i32; 4]; 3] = [
        [11_966, 40_254, 4_064, (16 << 16) + (1 << 15)],
        [-6_596, -22_189, 28_785, (128 << 16) + (1 << 15)],
        [28_785, -26_145, -2_640, (128 << 16) + (1 << 15)],
    ];
    let mut frame = b"FRAME\n".to_vec();
    frame.reserve(pixels.len() / 4 * 3);
    for [red, green, blue, offset] in PLANES {
        let sample = |&[r, g, b, _]: &[u8; 4]| {
            ((red * i32::from(r) + green * i32::from(g) + blue * i32::from(b) + offset) >> 16) as u8
        };
        frame.extend(pixels.as_chunks::<4>().0.iter().map(sample));
    }
    frame
}

/// A frame as PNG.
fn png([width, height]: [u32; 2], pixels: &[u8]) -> Result<Vec<u8>, CommandFailure> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_compression(png::Compression::Fast);
    let rgb: Vec<u8> = pixels.as_chunks::<4>().0.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
    let write = |encoder: png::Encoder<'_, _>| encoder.write_header()?.write_image_data(&rgb);
    write(encoder).map_err(|error| words(format!("PNG: {error}")))?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_of_y4m_are_those_of_the_standard() {
        // Black, white, red, green and blue of 75 % colour bars, as in ITU-R BT.709 and EBU Tech 3325.
        let frame = |rgb: [u8; 3]| y4m_frame(&[rgb[0], rgb[1], rgb[2], 255])[6..].to_vec();
        assert_eq!(frame([0; 3]), [16, 128, 128]);
        assert_eq!(frame([255; 3]), [235, 128, 128]);
        assert_eq!(frame([191, 0, 0]), [51, 109, 212]);
        assert_eq!(frame([0, 191, 0]), [133, 63, 52]);
        assert_eq!(frame([0, 0, 191]), [28, 212, 120]);
    }

    #[test]
    fn pngs_are_whole() {
        let bytes = png([2, 1], &[1, 2, 3, 255, 4, 5, 6, 255]).ok().unwrap();
        let mut reader = png::Decoder::new(io::Cursor::new(bytes)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        assert_eq!(pixels, [1, 2, 3, 4, 5, 6]);
    }
}
