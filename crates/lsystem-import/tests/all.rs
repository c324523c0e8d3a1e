//! All tests of foreign notations, in one program: it links in a tenth of the time of many.

mod bank;
mod cpfg;
mod foreign;
mod reads_back;
