//! The file of figures and limits: a document whose tables are read and written, and whose sentences stay as they are.

use super::Measured;
use anyhow::{Context, Result};

/// A figure when it was last written, and the most that it may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Row {
    pub(super) figure: f64,
    pub(super) limit: f64,
}

/// A section: its title, its sentences, its rows by name.
struct Section {
    title: String,
    text: String,
    rows: Vec<(String, Row)>,
}

/// The whole file.
pub(super) struct Table {
    /// What stands above the first section.
    head: String,
    sections: Vec<Section>,
}

const HEADER: &str = "| what | figure | limit |\n| --- | ---: | ---: |\n";

/// The highest limit of a figure, in whole units.
pub(super) fn limit(figure: f64, margin: f64) -> f64 {
    (figure * (1.0 + margin)).floor().max(figure.ceil())
}

impl Table {
    /// Reads the text of the file.
    pub(super) fn read(text: &str) -> Result<Self> {
        let mut parts = text.split("\n## ");
        let head = parts.next().unwrap_or_default().to_owned();
        let sections = parts.map(Section::read).collect::<Result<_>>()?;
        Ok(Self { head, sections })
    }

    /// The text of the file.
    pub(super) fn text(&self) -> String {
        self.sections.iter().fold(self.head.clone(), |text, section| text + "\n## " + &section.text_of())
    }

    #[cfg(test)]
    pub(super) fn titles(&self) -> impl Iterator<Item = &str> {
        self.sections.iter().map(|section| section.title.as_str())
    }

    fn section(&self, title: &str) -> Option<&Section> {
        self.sections.iter().find(|section| section.title == title)
    }

    /// The names of a section's rows.
    pub(super) fn names(&self, title: &str) -> impl Iterator<Item = &str> {
        self.section(title).into_iter().flat_map(|section| &section.rows).map(|(name, _)| name.as_str())
    }

    pub(super) fn row(&self, title: &str, name: &str) -> Option<Row> {
        let rows = &self.section(title)?.rows;
        rows.iter().find(|(its, _)| its == name).map(|(_, row)| *row)
    }

    /// Takes over what is measured. Limits fall, and never rise; new rows get one, rows of what is gone vanish, and rows above
    /// their limits stay as they are.
    pub(super) fn write(&mut self, title: &str, margin: f64, measured: &Measured) {
        let Some(section) = self.sections.iter_mut().find(|section| section.title == title) else { return };
        let known = std::mem::take(&mut section.rows);
        section.rows = measured
            .iter()
            .map(|(name, &figure)| {
                let before = known.iter().find(|(its, _)| its == name).map(|(_, row)| *row);
                let now = Row { figure, limit: limit(figure, margin) };
                let row = match before {
                    Some(before) if figure > before.limit => before,
                    Some(before) => Row { limit: now.limit.min(before.limit), ..now },
                    None => now,
                };
                (name.clone(), row)
            })
            .collect();
    }
}

impl Section {
    fn read(text: &str) -> Result<Self> {
        let (title, rest) = text.split_once('\n').context("a section without text")?;
        let (sentences, rows) = rest.split_once(HEADER).context("a section without a table")?;
        let rows = rows.lines().take_while(|line| line.starts_with('|')).map(|line| {
            let mut cells = line.trim_matches('|').split('|').map(str::trim);
            let mut cell = || cells.next().with_context(|| format!("a cell is missing: {line}"));
            Ok((cell()?.to_owned(), Row { figure: cell()?.parse()?, limit: cell()?.parse()? }))
        });
        Ok(Self { title: title.to_owned(), text: sentences.to_owned(), rows: rows.collect::<Result<_>>()? })
    }

    fn text_of(&self) -> String {
        let row = |(name, row): &(String, Row)| format!("| {name} | {:.0} | {:.0} |\n", row.figure, row.limit);
        let rows: String = self.rows.iter().map(row).collect();
        format!("{}\n{}{HEADER}{rows}", self.title, self.text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "# Head\n\nWhy.\n\n## One\n\nHow.\n\n| what | figure | limit |\n| --- | ---: | ---: |\n\
                        | a | 100 | 103 |\n| b | 50 | 51 |\n";

    #[test]
    fn reads_what_it_writes() {
        let table = Table::read(TEXT).unwrap();
        assert_eq!(table.text(), TEXT);
        assert_eq!(table.row("One", "b"), Some(Row { figure: 50.0, limit: 51.0 }));
        assert_eq!(table.names("One").collect::<Vec<_>>(), ["a", "b"]);
        for wrong in ["# Head\n## One\nno table\n", &TEXT.replace("| 50 ", "| x ")] {
            assert!(Table::read(wrong).is_err());
        }
    }

    #[test]
    fn writing_lowers_limits_only() {
        let mut table = Table::read(TEXT).unwrap();
        table.write("One", 0.03, &[("a".to_owned(), 102.0), ("c".to_owned(), 10.0)].into());
        assert_eq!(table.row("One", "a"), Some(Row { figure: 102.0, limit: 103.0 }));
        assert_eq!(table.row("One", "c"), Some(Row { figure: 10.0, limit: 10.0 }));
        assert_eq!(table.row("One", "b"), None);
        table.write("One", 0.03, &[("a".to_owned(), 104.0)].into());
        assert_eq!(table.row("One", "a"), Some(Row { figure: 102.0, limit: 103.0 }));
        table.write("One", 0.03, &[("a".to_owned(), 90.0)].into());
        assert_eq!(table.row("One", "a"), Some(Row { figure: 90.0, limit: 92.0 }));
    }
}
