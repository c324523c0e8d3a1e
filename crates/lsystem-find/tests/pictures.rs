//! The rules of pictures that this project draws itself, at their own scale and stroke.

use lsystem_drawing::{Drawer, compile};
use lsystem_find::{FOUND, Known, Picture, PictureSearch, Searched};
use lsystem_render::{Detail, Renderer, View, Viewport};
use lsystem_syntax::{Definition, Limits, Progress};
use std::sync::Arc;
