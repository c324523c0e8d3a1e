//! All tests of the program, in one program: it links in a tenth of the time of many.

mod animate;
mod check;
mod cli;
mod commands;
mod exhibit;
mod export;
mod find;
mod gallery;
mod hostile;
mod import;
mod invent;
mod language;
mod limits;
mod loops;
mod mark;
mod names;
mod program;
mod random;
mod recipes;
mod scorm;
mod shape;
mod tiles;
mod view;
