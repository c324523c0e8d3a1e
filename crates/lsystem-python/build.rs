//! On macOS, libraries that Python loads need their own options of the linker; maturin gives the same ones.

fn main() {
    pyo3_build_config::add_extension_module_link_args();
}
