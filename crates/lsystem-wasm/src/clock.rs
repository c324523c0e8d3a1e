//! The worker's clock.

use wasm_bindgen::JsCast;

/// Milliseconds on the browser's monotonic clock.
pub(crate) struct Clock(Option<web_sys::Performance>);

impl Clock {
    /// The clock of the worker scope. Outside a worker the clock always shows 0, so that only work ends a step.
    pub(crate) fn new() -> Self {
        let scope = js_sys::global().dyn_into::<web_sys::WorkerGlobalScope>().ok();
        Self(scope.and_then(|scope| scope.performance()))
    }

    /// The time in milliseconds.
    pub(crate) fn now(&self) -> f64 {
        self.0.as_ref().map_or(0.0, web_sys::Performance::now)
    }
}
