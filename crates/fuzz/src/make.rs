//! Random inputs from a row of bytes.
mod definition;
mod field;
mod text;
mod view;

pub(crate) use definition::{definition, limits, system};
pub(crate) use field::{change_field, style};
pub(crate) use text::{damage, expression, overrides, random_pieces};
pub(crate) use view::{camera, upto, view, viewport};
