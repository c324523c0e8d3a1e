//! The shelves of the gallery, read from the table of the page, `www/js/shelves.json`.

use anyhow::Result;
use jsonc_parser::ast::Value;
use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};

/// A shelf, with its systems by folder and file name.
pub(crate) struct Shelf {
    pub(crate) name: String,
    pub(crate) paths: Vec<String>,
}

/// All shelves, in order.
pub(crate) fn read(table: &str) -> Result<Vec<Shelf>> {
    let parsed = parse_to_ast(table, &CollectOptions::default(), &ParseOptions::default())?;
    let Some(Value::Object(shelves)) = parsed.value else { anyhow::bail!("the shelves are no table") };
    let shelves = shelves.properties.into_iter().map(|shelf| {
        let Value::Object(systems) = shelf.value else { anyhow::bail!("a shelf is no table") };
        let paths = systems.properties.into_iter().map(|system| system.name.into_string()).collect();
        Ok(Shelf { name: shelf.name.into_string(), paths })
    });
    shelves.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_the_table_of_the_page() {
        let shelves = read(r#"{"In space": {"a/b": "Trees", "a/c": ""}, "Trees": {}}"#).unwrap();
        let found: Vec<_> = shelves.iter().map(|shelf| (&*shelf.name, shelf.paths.join(" "))).collect();
        assert_eq!(found, [("In space", "a/b a/c".to_owned()), ("Trees", String::new())]);
        assert!(read("1").is_err());
    }
}
