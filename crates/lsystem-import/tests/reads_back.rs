//! Systems that this library writes in other notations read back as the same systems.

use lsystem_base::Limits;
use lsystem_drawing::{System, expand};
use lsystem_files::{Content, FileOptions, Format, collect};
use lsystem_import::import;
use lsystem_syntax::Definition;

#[test]
fn a_declaration_for_tikz() {
    let plant = Definition {
        axiom: "X".into(),
        rules: "X -> F-[[X]+X]+F[-FX]-X\nF -> FF".into(),
        angle: 22.5,
        heading: 0.0,
        iterations: 4,
        ..Definition::default()
    };
    let system = System::new(&plant).unwrap();
    let Content::Words(write) = Format::named("tikz-library").unwrap().content else { panic!("not in words") };
    let (text, _) = collect::<String, _>(|sink| write(&plant, &system, &FileOptions::default(), sink)).unwrap();
    let imported = import(&text).unwrap();
    let read = imported.entries[0].definition.clone().unwrap();
    let string = |definition: &Definition| expand(&System::new(definition).unwrap(), 4, &Limits::default()).unwrap();
    assert_eq!((string(&read), read.angle, read.iterations), (string(&plant), plant.angle, plant.iterations));
}
