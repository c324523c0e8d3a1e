//! All tests of teaching, in one program: it links in a tenth of the time of many.

mod check;
mod exercises;
mod growth;
mod hints;
mod marks;
mod naive;
mod steps;
mod variants;
