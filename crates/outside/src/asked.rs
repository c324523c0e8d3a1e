//! Questions about files, and the checks of their answers.

use crate::programs::Programs;
use anyhow::{Result, bail};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Compares the answers with what `lsys` tells. Returns what was found, in words.
type Compare = Box<dyn Fn(&[Value]) -> Result<String>>;

/// A check that is done: the output, the program that opens it, and the result in words.
pub(crate) type Done = (String, &'static str, Result<String>);

/// The checks so far. Python starts once for all questions, since its libraries take seconds to load.
pub(crate) struct Asked<'a> {
    pub(crate) programs: &'a Programs,
    /// The output, the program that opens it, the numbers of its questions, and the comparison.
    checks: Vec<(String, &'static str, Vec<usize>, Compare)>,
    done: Vec<Done>,
    questions: Vec<Value>,
    /// glTF files, with the output's name and the comparison.
    gltf: Vec<(PathBuf, String, Compare)>,
}

impl<'a> Asked<'a> {
    pub(crate) fn new(programs: &'a Programs) -> Self {
        Self { programs, checks: vec![], done: vec![], questions: vec![], gltf: vec![] }
    }

    /// Asks `look.py` these questions about an output.
    pub(crate) fn look(
        &mut self,
        output: impl Into<String>,
        by: &'static str,
        questions: impl IntoIterator<Item = Value>,
        compare: impl Fn(&[Value]) -> Result<String> + 'static,
    ) {
        let first = self.questions.len();
        self.questions.extend(questions);
        let numbers = (first..self.questions.len()).collect();
        self.checks.push((output.into(), by, numbers, Box::new(compare)));
    }

    /// Has the glTF validator read a file.
    pub(crate) fn validate_gltf(
        &mut self,
        output: impl Into<String>,
        file: &Path,
        compare: impl Fn(&[Value]) -> Result<String> + 'static,
    ) {
        self.gltf.push((file.to_owned(), output.into(), Box::new(compare)));
    }

    /// Notes a check that needs no answers.
    pub(crate) fn note(&mut self, output: impl Into<String>, by: &'static str, result: Result<String>) {
        self.done.push((output.into(), by, result));
    }

    /// Asks all questions, and prints a line for each check and each of `others`, which run meanwhile. Returns the numbers
    /// of right and of wrong outputs.
    pub(crate) fn finish(self, others: impl FnOnce() -> Result<Vec<Done>>) -> Result<(usize, usize)> {
        let answers = self.programs.look(&self.questions)?;
        let files: Vec<PathBuf> = self.gltf.iter().map(|check| check.0.clone()).collect();
        let reports = self.programs.validate_gltf(&files)?;
        let mut done = self.done;
        for (output, by, numbers, compare) in self.checks {
            let own: Vec<Value> = numbers.iter().map(|&number| answers[number].clone()).collect();
            done.push((output, by, compared(&own, &compare)));
        }
        for ((_, output, compare), report) in self.gltf.into_iter().zip(reports) {
            done.push((output, "gltf-validator", compared(&[report], &compare)));
        }
        done.extend(others()?);
        let mut wrong = 0;
        for (output, by, result) in &done {
            match result {
                Ok(found) => println!("{output}: {by}: {found}"),
                Err(error) => {
                    wrong += 1;
                    println!("{output}: {by}: WRONG: {error:#}");
                }
            }
        }
        Ok((done.len() - wrong, wrong))
    }
}

fn compared(answers: &[Value], compare: &Compare) -> Result<String> {
    match answers.iter().find_map(|answer| answer["error"].as_str()) {
        Some(error) => bail!("{error}"),
        None => compare(answers),
    }
}

/// A number of an answer; no number if it is missing, which is near no other.
pub(crate) fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

/// The numbers of an array of an answer.
pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().map_or_else(Vec::new, |array| array.iter().map(number).collect())
}

/// The numbers in a text, in order. Commas group the digits of none of them.
pub(crate) fn numbers_in(text: &str) -> Vec<f64> {
    let pieces = text.split(|letter: char| !letter.is_ascii_digit() && letter != '.');
    pieces.filter_map(|piece| piece.trim_end_matches('.').parse().ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_found_in_words() {
        assert_eq!(numbers_in("plot of 210 x 297.5 mm: 8 pens, 5.13 m."), [210.0, 297.5, 8.0, 5.13]);
    }
}
