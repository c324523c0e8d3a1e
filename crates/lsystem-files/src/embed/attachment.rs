//! Systems attached to PDF files, as they were written here or by a program that has saved the file again.

use super::{find, is_system};
use lsystem_base::MAX_FILE;
use miniz_oxide::inflate::{TINFLStatus, decompress_to_vec_zlib_with_limit};
use std::borrow::Cow;

/// The type of attached files, in the dictionary before their bytes.
const TYPE: &str = "/EmbeddedFile";
/// The most bytes that are unpacked of all attached files.
const MAX_UNPACKED: usize = 16 * MAX_FILE;

/// The system in a PDF file: the first attached file that is one. The table of the file's objects is not read, so that a
/// file may be cut off after the system.
pub(super) fn system_in(pdf: &[u8]) -> Option<String> {
    let mut rest = pdf;
    let mut left = MAX_UNPACKED;
    while let Some(at) = find(rest, TYPE) {
        let (before, after) = (&rest[..at], &rest[at + TYPE.len()..]);
        rest = after;
        // The list of all attached files is `/EmbeddedFiles`.
        if after.first().is_some_and(u8::is_ascii_alphanumeric) {
            continue;
        }
        let begin = match stream_begin(after) {
            Ok(begin) => begin,
            Err(end) => {
                rest = &after[end..];
                continue;
            }
        };
        let start = before.windows(3).rposition(|word| word == b"obj").unwrap_or(0);
        let dictionary = [&before[start..], b" ", &after[..begin]].concat();
        let content = content(&dictionary, &after[begin..])?;
        rest = &after[begin + content.len()..];
        let has = |filter: &str| find(&dictionary, filter).is_some();
        // Two digits a byte, and one byte more than is read.
        let mut bytes = Cow::Borrowed(&content[..content.len().min(2 * MAX_FILE + 2)]);
        if has("/ASCIIHexDecode") {
            bytes = from_hexadecimal(&bytes).into();
        }
        if has("/FlateDecode") {
            let unpacked = decompress_to_vec_zlib_with_limit(&bytes, left.min(MAX_FILE + 1));
            left = left.checked_sub(unpacked.as_ref().map_or_else(|error| error.output.len(), Vec::len))?;
            bytes = match unpacked {
                Ok(unpacked) => unpacked.into(),
                // Longer than anything that is read, which is told.
                Err(error) if error.status == TINFLStatus::HasMoreOutput => error.output.into(),
                Err(_) => continue,
            };
        }
        let system = String::from_utf8_lossy(&bytes);
        if is_system(&system) {
            return Some(system.into_owned());
        }
    }
    None
}

/// The bytes of hexadecimal digits.
fn from_hexadecimal(text: &[u8]) -> Vec<u8> {
    let digits = text.iter().filter_map(|&digit| char::from(digit).to_digit(16));
    let digits: Vec<u8> = digits.map(|digit| digit as u8).collect();
    digits.chunks_exact(2).map(|pair| 16 * pair[0] + pair[1]).collect()
}

/// The place behind the word `stream` and its end of line, which follow a dictionary; or the end of an object that has no
/// stream.
fn stream_begin(bytes: &[u8]) -> Result<usize, usize> {
    let mut from = 0;
    while let Some(at) = bytes[from..].windows(6).position(|word| matches!(word, b"stream" | b"endobj")) {
        let word = from + at;
        from = word + 6;
        if bytes[word] == b'e' {
            return Err(word);
        }
        let line = [&b"\r\n"[..], b"\n", b"\r"].into_iter().find(|line| bytes[from..].starts_with(line));
        // Kinds of media end in this word, too.
        if let Some(line) = line.filter(|_| bytes[..word].trim_ascii_end().ends_with(b">>")) {
            return Ok(from + line.len());
        }
    }
    Err(bytes.len())
}

/// The bytes of a stream: as many as its dictionary tells, unless the number stands elsewhere or is wrong.
fn content<'a>(dictionary: &[u8], bytes: &'a [u8]) -> Option<&'a [u8]> {
    const END: &str = "endstream";
    let told = find(dictionary, "/Length").and_then(|at| {
        let digits = dictionary[at + "/Length".len()..].trim_ascii_start();
        let digits = &digits[..digits.iter().take_while(|byte| byte.is_ascii_digit()).count()];
        let (content, rest) = bytes.split_at_checked(str::from_utf8(digits).ok()?.parse().ok()?)?;
        rest.trim_ascii_start().starts_with(END.as_bytes()).then_some(content)
    });
    told.or_else(|| Some(&bytes[..find(bytes, END)?]))
}

#[cfg(test)]
mod tests {
    use crate::read_file;

    /// A PDF with these objects: dictionaries, and streams.
    fn pdf(objects: &[(&str, Option<&[u8]>)]) -> Vec<u8> {
        let mut file = b"%PDF-1.5\n".to_vec();
        for ((dictionary, stream), number) in objects.iter().zip(1..) {
            file.extend(format!("{number} 0 obj\n<<{dictionary}>>").bytes());
            if let Some(stream) = stream {
                file.extend([b"\nstream\r\n", *stream, b"\nendstream"].concat());
            }
            file.extend(b"\nendobj\n");
        }
        file
    }

    #[test]
    fn attached_files_that_are_no_system_are_passed_over() {
        let check = |file: &[u8], axiom: Option<&str>| {
            let found = read_file(file);
            assert_eq!(found.definition.as_ref().map(|found| &*found.axiom), axiom);
            if axiom.is_none() {
                assert_eq!(found.diagnostics[0].message, "This PDF holds no L-system");
            }
        };
        let json = b"{\"initial\": \"F\", \"title\": \"a\\nendstream endobj >>stream\"}".as_slice();
        let length = format!("/Type /EmbeddedFile /Length {}", json.len());
        let packed = miniz_oxide::deflate::compress_to_vec_zlib(b"{\"initial\": \"F\"}", 9);
        let catalogue = ("/Names <</EmbeddedFiles 9 0 R>>", None);
        let picture = ("/Length 9", Some(b"0 0 m 9 9 l S".as_slice()));
        let own = (length.as_str(), Some(json));
        check(&pdf(&[catalogue, picture, own]), Some("F"));
        check(&pdf(&[own]), Some("F"));
        let flate =
            ("/Filter[/FlateDecode]/Length 8 0 R/Type/EmbeddedFile/Subtype/a#2Foctet-stream", Some(packed.as_slice()));
        check(&pdf(&[catalogue, picture, flate]), Some("F"));
        let others = [
            ("/Type/EmbeddedFile", Some(b"<invoice/>".as_slice())),
            ("/Type/EmbeddedFile", Some(b"{\"a\": 1}".as_slice())),
            ("/Type/EmbeddedFile /Filter /FlateDecode", Some(b"\x00\xff".as_slice())),
            ("/Type/EmbeddedFile", None),
        ];
        check(&pdf(&others), None);
        check(&pdf(&[&others[..], &[flate]].concat()), Some("F"));
        check(&pdf(&[catalogue, picture]), None);
        let whole = pdf(&[catalogue, picture, flate]);
        for end in 5..whole.len() {
            let _ = read_file(&whole[..end]);
        }
    }
}
