//! All tests of foreign notations, in one program: it links in a tenth of the time of many.

mod cpfg;
mod foreign;
mod reads_back;
