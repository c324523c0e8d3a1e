//! All tests of the search, in one program: it links in a tenth of the time of many.

mod pictures;
mod sketches;
mod strings;
