//! The canvas that shows pixels, and the worker's clock.

use lsystem::Viewport;
use lsystem::render::Pane;
use lsystem_session::{Clock, Screen};
use wasm_bindgen::{Clamped, JsCast, JsValue};
use web_sys::{ImageData, OffscreenCanvas, OffscreenCanvasRenderingContext2d, Performance, WorkerGlobalScope};

/// A canvas and its 2D context.
pub(crate) struct Canvas {
    canvas: OffscreenCanvas,
    context: OffscreenCanvasRenderingContext2d,
}

impl Canvas {
    pub(crate) fn new(canvas: OffscreenCanvas) -> Result<Self, JsValue> {
        let context = canvas.get_context("2d")?.ok_or("this canvas has no 2D context")?;
        Ok(Self { canvas, context: context.dyn_into()? })
    }
}

impl Screen for Canvas {
    type Error = JsValue;

    fn put(&mut self, pixels: &[u8], viewport: Viewport, pane: Pane) -> Result<(), JsValue> {
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

/// The clock of the worker scope. Outside a worker the clock always shows 0, so that only work ends a step.
pub(crate) fn clock() -> Clock {
    let scope = js_sys::global().dyn_into::<WorkerGlobalScope>().ok();
    let performance = scope.and_then(|scope| scope.performance());
    Box::new(move || performance.as_ref().map_or(0.0, Performance::now))
}
