//! Pictures of pixels as levels of grey: PNG, JPEG, GIF and WebP, as the page reads them.

use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, guess_format};
use lsystem::base::say;
use std::io::Cursor;

/// The most pixels of a picture.
const MAX_PIXELS: u64 = 64_000_000;
/// The formats that are read.
const READ: [ImageFormat; 4] = [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::Gif, ImageFormat::WebP];

/// Whether a file begins as a picture that is read.
pub(super) fn is_picture(bytes: &[u8]) -> bool {
    guess_format(bytes).is_ok_and(|format| READ.contains(&format))
}

/// The kind of a picture that is not read. A text is no picture, however it begins.
pub(super) fn other_kind(bytes: &[u8]) -> Option<String> {
    let format = guess_format(bytes).ok().filter(|_| str::from_utf8(bytes).is_err())?;
    format.extensions_str().first().map(|ending| ending.to_uppercase())
}

/// The levels of grey of a picture on white, or on black where it shows nothing on white, with its width and height. A
/// photograph stands upright, as its camera says. Of a moving picture this is the first frame.
///
/// # Errors
/// Why it cannot be read, in words.
pub(super) fn grey(bytes: &[u8]) -> Result<(Vec<u8>, usize, usize), String> {
    let words = |error: image::ImageError| error.to_string();
    let reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format().map_err(|error| error.to_string())?;
    let mut decoder = reader.into_decoder().map_err(words)?;
    let (width, height) = decoder.dimensions();
    if u64::from(width) * u64::from(height) > MAX_PIXELS {
        return Err(say!("the picture has more than 64,000,000 pixels"));
    }
    let orientation = decoder.orientation().map_err(words)?;
    // Decoders reserve memory without checking that there is enough. A turned copy and the levels of grey take as much again.
    let size = usize::try_from(decoder.total_bytes()).unwrap_or(usize::MAX).saturating_mul(2);
    Vec::<u8>::new().try_reserve_exact(size).map_err(|_| say!("not enough memory for the picture"))?;
    let mut image = DynamicImage::from_decoder(decoder).map_err(words)?;
    image.apply_orientation(orientation);
    let (width, height) = (image.width() as usize, image.height() as usize);
    let (pixels, channels) = match image {
        DynamicImage::ImageLuma8(pixels) => (pixels.into_raw(), 1),
        DynamicImage::ImageLumaA8(pixels) => (pixels.into_raw(), 2),
        DynamicImage::ImageRgb8(pixels) => (pixels.into_raw(), 3),
        other => (other.into_rgba8().into_raw(), 4),
    };
    let on = |paper: u32| -> Vec<u8> {
        let level = |pixel: &[u8]| {
            let (light, alpha) = match *pixel {
                [grey] => (u32::from(grey), 255),
                [grey, alpha] => (u32::from(grey), u32::from(alpha)),
                [red, green, blue] => (light(red, green, blue), 255),
                _ => (light(pixel[0], pixel[1], pixel[2]), u32::from(pixel[3])),
            };
            ((light * alpha + paper * (255 - alpha)) / 255) as u8
        };
        pixels.chunks_exact(channels).map(level).collect()
    };
    let on_white = on(255);
    let is_plain = on_white.iter().all(|level| Some(level) == on_white.first());
    Ok((if is_plain { on(0) } else { on_white }, width, height))
}

/// The lightness of a colour, from 0 to 255.
fn light(red: u8, green: u8, blue: u8) -> u32 {
    (u32::from(red) * 299 + u32::from(green) * 587 + u32::from(blue) * 114) / 1000
}
