//! Results as tables.

use serde::{Deserialize, Serialize};
use std::fmt::Write;

/// One result.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Row {
    /// The kind of work, with its unit: `expansion, symbols/s`.
    pub what: String,
    /// The name of the system.
    pub work: String,
    /// The program: `ours` (`ours, …` for another method), `copy` for a plain copy of the same bytes, or a peer's name.
    pub who: String,
    /// The number of units of one run.
    pub amount: u64,
    /// The shortest time of one run, in seconds.
    pub seconds: f64,
}

impl Row {
    fn rate(&self) -> f64 {
        self.amount as f64 / self.seconds
    }
}

/// A table for each kind of work: units per second, and ratios. Rows keep their order.
#[must_use]
pub fn tables(rows: &[Row], place: &str) -> String {
    let mut text = String::new();
    for what in distinct(rows.iter().map(|row| &*row.what)) {
        let of_kind: Vec<&Row> = rows.iter().filter(|row| row.what == what).collect();
        table(&mut text, &format!("{what}, {place}"), &of_kind);
    }
    text
}

fn table(text: &mut String, title: &str, rows: &[&Row]) {
    let who = distinct(rows.iter().map(|row| &*row.who));
    let peers: Vec<&str> = who.iter().copied().filter(|who| !who.starts_with("ours") && *who != "copy").collect();
    let mut line = |cells: &[String]| {
        let (first, rest) = cells.split_first().expect("a table has columns");
        let _ = write!(text, "{first:32}");
        rest.iter().for_each(|cell| {
            let _ = write!(text, "{cell:>24}");
        });
        text.push('\n');
    };
    let mut head: Vec<String> = [title, "amount"].map(String::from).to_vec();
    head.extend(who.iter().map(ToString::to_string));
    head.extend(["ours/copy", "ours/fastest peer"].map(String::from));
    line(&head);
    for work in distinct(rows.iter().map(|row| &*row.work)) {
        let rate = |who: &str| rows.iter().find(|row| row.work == work && row.who == who).map(|row| row.rate());
        let amount = rows.iter().find(|row| row.work == work).map_or(0, |row| row.amount);
        let fastest = peers.iter().filter_map(|peer| rate(peer)).reduce(f64::max);
        let ratio = |other: Option<f64>| {
            rate("ours").zip(other).map_or("-".into(), |(ours, other)| format!("{:.2}", ours / other))
        };
        let mut cells = vec![work.to_owned(), short(amount as f64)];
        cells.extend(who.iter().map(|who| rate(who).map_or("-".into(), short)));
        cells.extend([ratio(rate("copy")), ratio(fastest)]);
        line(&cells);
    }
    text.push('\n');
}

/// The distinct texts, in the order of their first occurrence.
fn distinct<'a>(texts: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut found = vec![];
    for text in texts {
        if !found.contains(&text) {
            found.push(text);
        }
    }
    found
}

/// A number with three digits and a decimal prefix.
fn short(number: f64) -> String {
    let (value, unit) = match number {
        1e9.. => (number / 1e9, " G"),
        1e6.. => (number / 1e6, " M"),
        1e3.. => (number / 1e3, " k"),
        _ => (number, ""),
    };
    let digits = 2 - usize::from(value >= 10.0) - usize::from(value >= 100.0);
    format!("{value:.digits$}{unit}")
}
