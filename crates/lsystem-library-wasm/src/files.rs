//! Files of systems.

use crate::FileRequest;
use crate::opened::{OpenSystem, Refusal};
use lsystem_files::{FileLimits, FileOptions, FileTask, FileView, Format, Sink};
use lsystem_syntax::notes::similar;

/// The bytes of a file.
pub(crate) fn make(open: &OpenSystem, format: &'static Format, request: FileRequest) -> Result<Vec<u8>, Refusal> {
    let FileRequest { values, view, camera, ratio } = request;
    let options = FileOptions::from_values(&values);
    if let Some(name) = values.keys().find(|name| !format.options.contains(&name.as_str())) {
        let help = match similar(name, format.options.iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None if format.options.is_empty() => "it has no options".to_owned(),
            None => format!("it has {}", format.options.join(", ")),
        };
        return Err(Refusal::words(format!("{} has no option `{name}`: {help}", format.name)));
    }
    let options = options.map_err(Refusal::words)?;
    let (view, camera) = (view.map(Into::into).unwrap_or_default(), camera.map(Into::into));
    let view = FileView { view, camera, upto: None, ratio, is_described: true };
    let OpenSystem { definition, system } = open;
    let task = FileTask { definition, system, format, options: &options, view, limits: FileLimits::PAGE };
    let mut bytes = vec![];
    Sink::to(&mut bytes, |sink| lsystem_files::make(&task, sink)).map_err(|halt| open.exceeds(&halt.diagnostic()))?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lsystem_files::{FORMATS, OptionValue};

    fn open(n: u32) -> OpenSystem {
        OpenSystem::read(r#"{"axiom": "F", "rules": "F -> F[+F]F"}"#, Some(n.into())).unwrap()
    }

    #[test]
    fn every_format_is_made() {
        for format in &FORMATS {
            assert!(!make(&open(3), format, FileRequest::default()).unwrap().is_empty(), "{format:?}");
        }
        let svg = Format::named("svg").unwrap();
        assert!(make(&open(30), svg, FileRequest::default()).unwrap_err().message.contains("segments"));
    }

    #[test]
    fn options_of_other_formats_are_refused() {
        let told = |format: &str, name: &str, value: f64| {
            let values = [(name.to_owned(), OptionValue::Number(value))].into();
            let request = FileRequest { values, ..FileRequest::default() };
            make(&open(2), Format::named(format).unwrap(), request).unwrap_err().message
        };
        assert_eq!(told("png", "dip", 3.0), "png has no option `dip`: did you mean `dpi`?");
        assert_eq!(told("svg", "pen", 3.0), "svg has no option `pen`: it has transparent, bare");
        assert_eq!(told("csv", "pen", 3.0), "csv has no option `pen`: it has no options");
        assert_eq!(told("png", "dpi", -3.0), "dpi: expected a number from 0 to 100000");
    }
}
