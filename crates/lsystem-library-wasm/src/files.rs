//! Files of systems.

use crate::opened::{OpenSystem, Refusal};
use lsystem_drawing::Origin;
use lsystem_files::{FORMATS, FileLimits, FileOptions, FileTask, FileView, Format, OptionValue, Sink};
use lsystem_render::{Camera, View};
use lsystem_syntax::fields::field;
use lsystem_syntax::notes::similar;
use lsystem_syntax::{Expected, Value};
use serde::Deserialize;
use std::collections::BTreeMap;

/// The range of device pixels in a CSS pixel.
const RATIO: Expected = Expected::Between(0.01, 100.0);

/// The options of a file.
#[derive(Default, Deserialize)]
pub(crate) struct FileRequest {
    /// The choices of [`lsystem_files::FILE_OPTIONS`], by name.
    #[serde(default)]
    values: BTreeMap<String, OptionValue>,
    /// The place of pictures of pixels in the plane; the whole drawing if it is missing.
    view: Option<Members>,
    /// The camera on drawings in space; the page's first one if it is missing.
    camera: Option<Members>,
    /// Device pixels in a CSS pixel, for pictures of pixels.
    ratio: Option<f64>,
}

/// The members of an option that is an object. Others have their defaults.
#[derive(Deserialize)]
struct Members(BTreeMap<String, Value>);

/// The bytes of a file.
pub(crate) fn make(open: &OpenSystem, format: &'static Format, request: &FileRequest) -> Result<Vec<u8>, Refusal> {
    let FileRequest { values, view, camera, ratio } = request;
    if let Some(name) = values.keys().find(|name| !format.options.contains(&name.as_str())) {
        return Err(unknown(&format!("{} has no option", format.name), name, format.options.iter().copied()));
    }
    let options = FileOptions::from_values(values).map_err(Refusal::words)?;
    let segment = view.as_ref().and_then(Members::origin);
    let view = view.as_ref().map_or(Ok(View::default()), Members::view)?;
    let camera = camera.as_ref().map(Members::camera).transpose()?;
    if ratio.is_some_and(|ratio| !RATIO.admits(ratio)) {
        return Err(Refusal::words(format!("ratio must be {}", RATIO.words())));
    }
    let view = FileView { view, segment, camera, upto: None, ratio: *ratio, is_described: true };
    let OpenSystem { definition, system } = open;
    let task = FileTask { definition, system, format, options: &options, view, limits: FileLimits::PAGE };
    let mut bytes = vec![];
    Sink::to(&mut bytes, |sink| lsystem_files::make(&task, sink)).map_err(|halt| open.exceeds(&halt.diagnostic()))?;
    Ok(bytes)
}

/// The format with this name.
pub(crate) fn format(name: &str) -> Result<&'static Format, Refusal> {
    let known = FORMATS.iter().map(|format| format.name);
    Format::named(name).ok_or_else(|| unknown("there is no format", name, known))
}

/// The refusal of a name that is not known.
fn unknown(what: &str, name: &str, known: impl Iterator<Item = &'static str> + Clone) -> Refusal {
    let help = match (similar(name, known.clone()), known.collect::<Vec<_>>()) {
        (Some(near), _) => format!(": did you mean `{near}`?"),
        (None, known) if known.is_empty() => String::new(),
        (None, known) => format!("; known are {}", known.join(", ")),
    };
    Refusal::words(format!("{what} `{name}`{help}"))
}

impl Members {
    fn view(&self) -> Result<View, Refusal> {
        self.check("view")?;
        let View { x, y, zoom, fine } = View::default();
        let fine = [self.number("fx", fine[0]), self.number("fy", fine[1])];
        Ok(View { x: self.number("x", x), y: self.number("y", y), zoom: self.number("zoom", zoom), fine })
    }

    /// The place that is the origin of the view.
    fn origin(&self) -> Option<Origin> {
        let Some(Value::Text(at)) = self.0.get("at") else { return None };
        Origin::read(at)
    }

    fn camera(&self) -> Result<Camera, Refusal> {
        self.check("camera")?;
        let base = Camera::default();
        let [x, y, z] = base.target;
        Ok(Camera {
            azimuth: self.number("azimuth", base.azimuth),
            elevation: self.number("elevation", base.elevation),
            zoom: self.number("zoom", base.zoom),
            target: [self.number("x", x), self.number("y", y), self.number("z", z)],
            perspective: self.0.get("perspective").map_or(base.perspective, |value| *value == Value::Flag(true)),
            fade: self.number("fade", base.fade),
            ..base
        })
    }

    fn number(&self, name: &str, default: f64) -> f64 {
        if let Some(Value::Number(number)) = self.0.get(name) { *number } else { default }
    }

    /// Refuses members that the field `owner` does not have, and values out of their ranges.
    fn check(&self, owner: &str) -> Result<(), Refusal> {
        let Some(Expected::Record(known)) = field(owner).map(|spec| spec.expected) else { return Ok(()) };
        for (name, value) in &self.0 {
            let Some((_, expected)) = known.iter().find(|(known, _)| known == name) else {
                return Err(unknown(&format!("{owner} has no option"), name, known.iter().map(|(name, _)| *name)));
            };
            if !expected.admits_value(value) {
                return Err(Refusal::words(format!("{owner}.{name} must be {}", expected.words())));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn open(n: u32) -> OpenSystem {
        OpenSystem::read(r#"{"axiom": "F", "rules": "F -> F[+F]F"}"#, Some(n.into())).unwrap()
    }

    #[test]
    fn every_format_is_made() {
        for format in &FORMATS {
            assert!(!make(&open(3), format, &FileRequest::default()).unwrap().is_empty(), "{format:?}");
        }
        let svg = Format::named("svg").unwrap();
        assert!(make(&open(30), svg, &FileRequest::default()).unwrap_err().message.contains("segments"));
    }

    #[test]
    fn options_of_other_formats_are_refused() {
        let told = |format: &str, name: &str, value: f64| {
            let values = [(name.to_owned(), OptionValue::Number(value))].into();
            let request = FileRequest { values, ..FileRequest::default() };
            make(&open(2), Format::named(format).unwrap(), &request).unwrap_err().message
        };
        assert_eq!(told("png", "dip", 3.0), "png has no option `dip`: did you mean `dpi`?");
        assert_eq!(told("svg", "pen", 3.0), "svg has no option `pen`; known are transparent, bare");
        assert_eq!(told("csv", "pen", 3.0), "csv has no option `pen`");
        assert_eq!(format("svgg").unwrap_err().message, "there is no format `svgg`: did you mean `svg`?");
        assert_eq!(told("png", "dpi", -3.0), "dpi: expected a number from 0 to 100000");
    }

    #[test]
    fn cameras_have_defaults_names_and_ranges() {
        let members = |name: &str, value: f64| Members([(name.to_owned(), Value::Number(value))].into());
        let camera = members("azimuth", 90.0).camera().unwrap();
        assert_eq!((camera.azimuth, camera.zoom), (90.0, Camera::default().zoom));
        assert_eq!(members("zoom", 3.0).view().unwrap().zoom, 3.0);
        let told = |name, value| members(name, value).camera().unwrap_err().message;
        assert_eq!(told("azimut", 90.0), "camera has no option `azimut`: did you mean `azimuth`?");
        assert_eq!(told("elevation", 100.0), "camera.elevation must be a number from -90 to 90");
        assert_eq!(told("perspective", 1.0), "camera.perspective must be true or false");
    }
}
