//! The functions of L-Py: `name = QuantisedFunction(NurbsCurve2D(…))` in the code, and `name = pgl.NurbsCurve2D(…)` below
//! the rules, where L-Py's editor keeps its functions. By default a curve is a clamped cubic B-spline, as ours are.

use super::assignments::is_name;
use super::companions::NamedFunction;
use super::symbols::parenthesised;
use lsystem_syntax::Curve;

/// The most curves and the most points of a curve that are looked at.
const MAX: usize = 1000;

/// The curves of a text with their names; `None` for one that is no clamped cubic of equal weights.
pub(super) fn read_curves(text: &str) -> Vec<NamedFunction<'_>> {
    let mut found: Vec<NamedFunction<'_>> = Vec::new();
    for kind in ["NurbsCurve2D", "BezierCurve2D"] {
        for (at, _) in text.match_indices(kind).take(MAX) {
            let line = text[..at].rsplit('\n').next().unwrap_or_default();
            let Some((name, _)) = line.split_once('=').map(|(name, rest)| (name.trim(), rest)) else { continue };
            if !is_name(name) || found.iter().any(|known| known.name == name) {
                continue;
            }
            let inside = parenthesised(&text[at + kind.len()..]).and_then(|(inside, _)| inside).unwrap_or_default();
            let points = points(inside);
            let is_cubic = !inside.contains("degree") && !inside.contains("knotList")
                || inside.replace(' ', "").contains("degree=3") && !inside.contains("knotList");
            let fits = is_cubic && (kind == "NurbsCurve2D" || points.as_ref().is_some_and(|all| all.len() == 4));
            let curve = points.filter(|all| fits && all.len() >= 4).and_then(Curve::new);
            found.push(NamedFunction { name, curve });
        }
    }
    found
}

/// The points `(x, y, weight)`, all of the weight 1.
fn points(text: &str) -> Option<Vec<[f64; 2]>> {
    let innermost = text.split('(').filter_map(|part| part.split_once(')')).map(|(inside, _)| inside);
    let mut found = Vec::new();
    for inside in innermost.take(MAX) {
        let numbers: Result<Vec<f64>, _> = inside.split(',').take(4).map(|word| word.trim().parse::<f64>()).collect();
        match numbers.as_deref() {
            Ok(&[x, y] | &[x, y, 1.0]) => found.push([x, y]),
            _ => return None,
        }
    }
    Some(found)
}
