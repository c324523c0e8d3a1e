//! The canvas that shows pixels.

use lsystem::Viewport;
use lsystem::render::Pane;
use wasm_bindgen::{Clamped, JsCast, JsValue};
use web_sys::{ImageData, OffscreenCanvas, OffscreenCanvasRenderingContext2d};

/// A canvas and its 2D context.
pub(crate) struct CanvasSurface {
    canvas: OffscreenCanvas,
    context: OffscreenCanvasRenderingContext2d,
}

impl CanvasSurface {
    pub(crate) fn new(canvas: OffscreenCanvas) -> Result<Self, JsValue> {
        let context = canvas.get_context("2d")?.ok_or("this canvas has no 2D context")?;
        Ok(Self { canvas, context: context.dyn_into()? })
    }

    /// Shows a picture of opaque RGBA pixels, and sets the canvas to its size.
    pub(crate) fn show(&self, pixels: &[u8], viewport: Viewport) -> Result<(), JsValue> {
        self.put(pixels, viewport, Pane::whole(viewport))
    }

    /// Shows a pane of a picture, and sets the canvas to the picture's size.
    pub(crate) fn put(&self, pixels: &[u8], viewport: Viewport, pane: Pane) -> Result<(), JsValue> {
        let Viewport { width, height, .. } = viewport;
        // Setting a size clears the canvas, even an equal size.
        if (self.canvas.width(), self.canvas.height()) != (width, height) {
            self.canvas.set_width(width);
            self.canvas.set_height(height);
        }
        let image = ImageData::new_with_u8_clamped_array_and_sh(Clamped(pixels), pane.width, pane.height)?;
        self.context.put_image_data(&image, f64::from(pane.x), f64::from(pane.y))
    }
}
