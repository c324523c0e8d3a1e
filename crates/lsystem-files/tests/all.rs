//! All tests of files, in one program: it links in a tenth of the time of many.

mod edit;
mod meshes;
mod midi;
mod plotter;
