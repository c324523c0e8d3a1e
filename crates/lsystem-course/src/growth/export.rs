//! Growth as CSV, LaTeX and plain text.

use crate::growth::text::{Style, closed, decimal, recurrence};
use crate::growth::{Growth, Series};
use core::fmt::Write as _;
use lsystem_base::say;

impl Growth {
    /// The table as CSV: n, symbols, segments, width, height, length, turning, and each listed letter.
    #[must_use]
    pub fn csv(&self) -> String {
        let quoted = |letter: &String| format!("\"{}\"", letter.replace('"', "\"\""));
        let mut csv = String::from("n,symbols,segments,width,height,length,turning_degrees");
        csv += if self.is_random { ",segments_deviation" } else { "" };
        self.letters.iter().for_each(|letter| csv += &format!(",{}", quoted(letter)));
        csv.push('\n');
        for row in &self.table {
            let [width, height] = row.size.map_or_else(Default::default, |size| size.map(|side| side.to_string()));
            let [length, turning] =
                [row.length, row.turning].map(|value| value.map(|value| value.to_string()).unwrap_or_default());
            let (n, symbols, segments) = (row.n, &row.symbols.digits, &row.segments.digits);
            let _ = write!(csv, "{n},{symbols},{segments},{width},{height},{length},{turning}");
            if self.is_random {
                let _ = write!(csv, ",{}", row.spread.map(|spread| spread.to_string()).unwrap_or_default());
            }
            row.letters.iter().for_each(|count| csv += &format!(",{}", count.digits));
            csv.push('\n');
        }
        csv
    }

    /// The matrix, recurrences, closed forms, factors and the dimension for a LaTeX document with `amsmath`.
    #[must_use]
    pub fn latex(&self) -> String {
        let mut tex = String::new();
        let heads: Vec<String> = self.letters.iter().map(|letter| format!("\\texttt{{{}}}", escaped(letter))).collect();
        let _ = writeln!(tex, "% Rows: letters; columns: what they become in one step.");
        let _ = writeln!(tex, "% Letters: {}", self.letters.join(" ").replace('\n', " "));
        let rows: Vec<String> = (self.matrix.iter())
            .map(|row| row.iter().map(|value| decimal(*value)).collect::<Vec<_>>().join(" & "))
            .collect();
        let _ = writeln!(tex, "\\[ M = \\begin{{pmatrix}} {} \\end{{pmatrix}} \\]", rows.join(" \\\\ "));
        let _ = writeln!(tex, "for the letters {}.", heads.join(", "));
        for (name, series) in [("symbols", &self.symbols), ("segments", &self.segments)] {
            let _ = writeln!(tex, "\n% The number of {name}, s_n.");
            tex += &formulas(series);
        }
        if let (Some(stretch), Some(dimension)) = (self.stretch, self.dimension) {
            let _ = writeln!(
                tex,
                "\n% The similarity dimension.\n\\[ \\frac{{\\log {}}}{{\\log {}}} \\approx {dimension:.6} \\]",
                decimal(self.segments.factor),
                decimal(stretch)
            );
        }
        tex
    }

    /// The essence, the matrix and the table as text.
    #[must_use]
    pub fn words(&self) -> String {
        let mut text = self.sentences.join("\n");
        text += &format!("\n\n{}\n", say!("What a letter becomes in one step:"));
        let cells: Vec<Vec<String>> =
            self.matrix.iter().map(|row| row.iter().map(|value| decimal(*value)).collect()).collect();
        let wide = cells.iter().flatten().chain(&self.letters).map(|cell| cell.chars().count()).max().unwrap_or(1);
        let line = |cells: &[String]| cells.iter().map(|cell| format!(" {cell:>wide$}")).collect::<String>();
        let _ = writeln!(text, "{:>wide$} {}", "", line(&self.letters));
        for (letter, row) in self.letters.iter().zip(&cells) {
            let _ = writeln!(text, "{letter:>wide$} {}", line(row));
        }
        if self.letter_count > self.letters.len() {
            let _ = writeln!(text, "{}", say!("and {} more letters", self.letter_count - self.letters.len()));
        }
        text += &format!("\n    n  {}  {}\n", say!("symbols"), say!("segments"));
        for row in &self.table {
            let _ = writeln!(text, "{:>5}  {}  {}", row.n, row.symbols.digits, row.segments.digits);
        }
        text
    }
}

fn formulas(series: &Series) -> String {
    let mut tex = String::new();
    if let Some(found) = &series.found {
        let _ = writeln!(tex, "\\[ {} \\qquad (n \\ge {}) \\]", recurrence(found, Style::Latex), series.from);
    }
    if let Some(terms) = &series.terms {
        let _ = writeln!(tex, "\\[ s_n = {} \\qquad (n \\ge {}) \\]", closed(terms, Style::Latex), series.closed_from);
    }
    let _ = writeln!(tex, "\\[ \\lambda \\approx {:.12} \\]", series.factor);
    tex
}

/// A letter in LaTeX.
fn escaped(letter: &str) -> String {
    let one = |c: char| match c {
        '\\' => "\\textbackslash{}".to_owned(),
        '^' => "\\textasciicircum{}".to_owned(),
        '~' => "\\textasciitilde{}".to_owned(),
        '#' | '$' | '%' | '&' | '_' | '{' | '}' => format!("\\{c}"),
        c => c.to_string(),
    };
    letter.chars().map(one).collect()
}
