//! Local assignments of cpfg's productions: `A(x) : {y = x + 1;} y < 3 {z = 2 * y;} --> A(z)`. The values are written in
//! place of the names.

/// The most characters of a production with its values in place.
const LONGEST: usize = 4000;

/// A production without its blocks of assignments; `None` if a block is other code.
pub(super) fn inlined(line: &str) -> Option<String> {
    let (head, successor) = line.split_once("-->")?;
    let (before, rest) = head.split_once('{')?;
    let (first, rest) = rest.split_once('}')?;
    let (condition, second) = match rest.split_once('{') {
        Some((condition, second)) => (condition, second.trim_end().strip_suffix('}')?),
        None => (rest, ""),
    };
    let mut values = Values::default();
    values.assign(first)?;
    let condition = values.put(condition.trim(), 1)?;
    values.assign(second)?;
    let successor = values.put(successor, 0)?;
    let before = before.trim_end().trim_end_matches(':').trim_end();
    let condition = if matches!(&*condition, "" | "*" | "1") { String::new() } else { format!(" : {condition}") };
    Some(format!("{before}{condition} -->{successor}")).filter(|line| line.len() <= LONGEST)
}

/// The values of names, by the last assignment.
#[derive(Default)]
struct Values(Vec<(String, String)>);

impl Values {
    /// Reads assignments; `None` if there is other code.
    fn assign(&mut self, block: &str) -> Option<()> {
        for statement in block.split(';').map(str::trim).filter(|statement| !statement.is_empty()) {
            let (name, value) = statement.split_once('=')?;
            let name = name.trim();
            let is_name = name.starts_with(|c: char| c.is_alphabetic() || c == '_') && name.chars().all(is_part);
            if !is_name || value.contains(['=', '{', '?', '"']) {
                return None;
            }
            let value = self.put(value.trim(), 1)?;
            self.0.retain(|(known, _)| known != name);
            self.0.push((name.to_owned(), value));
        }
        Some(())
    }

    /// Writes values in place of names inside parentheses; `depth` is 1 for arithmetic, which is inside already.
    fn put(&self, text: &str, mut depth: usize) -> Option<String> {
        let mut out = String::new();
        let mut rest = text;
        while let Some(ch) = rest.chars().next() {
            depth = (depth + usize::from(ch == '(')).saturating_sub(usize::from(ch == ')'));
            let end = rest.find(|c: char| !is_part(c)).unwrap_or(rest.len()).max(ch.len_utf8());
            let (word, behind) = rest.split_at(if depth > 0 { end } else { ch.len_utf8() });
            match self.0.iter().find(|(name, _)| depth > 0 && name == word) {
                Some((_, value)) => out.extend(["(", value, ")"]),
                None => out.push_str(word),
            }
            if out.len() > LONGEST {
                return None;
            }
            rest = behind;
        }
        Some(out)
    }
}

fn is_part(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}
