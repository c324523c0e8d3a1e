//! Formatting, clippy and documentation: warnings are errors.

use crate::report::StepReport;
use crate::tools;
use crate::wasms::WASMS;
use crate::workspace::{Workspace, run};

pub(crate) fn steps(workspace: &Workspace, report: &mut StepReport) {
    report.step("formatting", || run(&mut workspace.cargo(["fmt", "--all", "--check"])));
    report.step("clippy", || {
        run(&mut workspace.cargo(["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"]))
    });
    report.step("clippy for wasm", || {
        tools::wasm_target()?;
        let packages = WASMS.iter().flat_map(|wasm| ["--package", wasm.package]);
        let what = ["clippy", "--all-targets", "--target", tools::WASM_TARGET].into_iter().chain(packages);
        run(workspace.cargo(what).args(["--", "-D", "warnings"]))
    });
    report.step("clippy for the measurements in the browser", || {
        let what = ["clippy", "--lib", "--package=bench", "--target", tools::WASM_TARGET];
        run(workspace.cargo(what).args(["--", "-D", "warnings"]))
    });
    report.step("documentation", || run(workspace.cargo(["doc", "--no-deps"]).env("RUSTDOCFLAGS", "-D warnings")));
}
