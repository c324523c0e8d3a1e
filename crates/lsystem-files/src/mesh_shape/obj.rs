//! The triangles of Wavefront OBJ files: lines `v x y z` and `f a b c …`. Faces with more corners become fans.

use super::{Triangle, too_many};
use lsystem_base::say;
use lsystem_syntax::MAX_SIDES;

/// The triangles of a file.
///
/// # Errors
/// The first wrong line, or a mesh that is too large.
pub(super) fn triangles(bytes: &[u8]) -> Result<Vec<Triangle>, String> {
    let text = str::from_utf8(bytes).map_err(|_| say!("this is no SVG, OBJ or GLB"))?;
    let (mut vertices, mut triangles): (Vec<[f64; 3]>, Vec<Triangle>) = (vec![], vec![]);
    for (line, written) in text.lines().enumerate() {
        let wrong = |what: String| say!("line {}: {}", line + 1, what);
        let mut words = written.split_whitespace();
        match words.next() {
            Some("v") => {
                let numbers: Vec<f64> = words.by_ref().take(3).map_while(|word| word.parse().ok()).collect();
                let vertex: [f64; 3] =
                    numbers.try_into().map_err(|_| wrong(say!("a vertex has three numbers: v 0 1 0.5")))?;
                if vertex.iter().any(|value| !value.is_finite()) {
                    return Err(wrong(say!("this number is not finite")));
                }
                vertices.push(vertex);
            }
            Some("f") => {
                let corner = |word: &str| -> Option<[f64; 3]> {
                    // Behind a slash are the numbers of textures and normals; negative numbers count from the end.
                    let number: i64 = word.split('/').next()?.parse().ok()?;
                    let count = vertices.len() as i64;
                    let at = if number < 0 { count.checked_add(number)? } else { number - 1 };
                    vertices.get(usize::try_from(at).ok()?).copied()
                };
                // One more triangle than there may be, which is refused.
                let most = MAX_SIDES + 3 - triangles.len();
                let corners: Option<Vec<_>> = words.take(most).map(corner).collect();
                let corners = corners.filter(|corners| corners.len() >= 3);
                let corners =
                    corners.ok_or_else(|| wrong(say!("a face has the numbers of three vertices or more: f 1 2 3")))?;
                triangles.extend((2..corners.len()).map(|at| [corners[0], corners[at - 1], corners[at]]));
                if triangles.len() > MAX_SIDES {
                    return Err(too_many());
                }
            }
            _ => {}
        }
    }
    if triangles.is_empty() { Err(say!("this is no SVG, OBJ or GLB with a mesh")) } else { Ok(triangles) }
}
