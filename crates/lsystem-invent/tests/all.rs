//! All tests of new systems, in one program: it links in a tenth of the time of many.

mod gallery;
mod invent;
