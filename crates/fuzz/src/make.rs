//! What inputs are made of.

mod definition;
mod text;
mod view;

pub(crate) use definition::{definition, limits, system};
pub(crate) use text::{expression, overrides, soup};
pub(crate) use view::{camera, style, upto, view, viewport};
