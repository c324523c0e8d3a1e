//! What functions and data of a linked wasm refer to: the same graph by which the linker itself leaves out what is not
//! used. The linker writes the graph if it is asked to (`--emit-relocs`).

use anyhow::{Context, Result, bail, ensure};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use wasmparser::{
    BinaryReader, DataKind, KnownCustom, Linking, Name, Operator, Parser, Payload, RelocationEntry, RelocationType,
    SymbolInfo, TypeRef,
};

/// The argument for the linker.
pub(crate) const EMIT: &str = "link-arg=--emit-relocs";

/// The references of a function or of a datum, except calls by name.
#[derive(Default)]
pub(super) struct References {
    /// Slots of the table of functions.
    pub(super) slots: BTreeSet<u32>,
    /// Indices of data.
    pub(super) data: BTreeSet<usize>,
}

/// A datum: a constant, a table of methods, a variable.
pub(super) struct Datum {
    /// The addresses in the memory.
    pub(super) place: Range<u32>,
    pub(super) references: References,
}

/// The references in a linked wasm.
#[derive(Default)]
pub(super) struct Linked {
    /// All functions by their names. Functions of one name share their references.
    functions: BTreeMap<String, References>,
    pub(super) data: Vec<Datum>,
    /// The addresses of the constants: the linker writes them first.
    pub(super) constants: Range<u32>,
    /// The slots of the table that the linker has filled, and slot 0.
    pub(super) slots: u32,
}

/// The parts of a wasm that relocations refer to.
#[derive(Default)]
struct Sections<'a> {
    imported: u32,
    /// Where the contents of the sections of code and of data begin.
    code: usize,
    data: usize,
    /// The bytes of the wasm that each function has.
    bodies: Vec<Range<usize>>,
    /// The bytes of the wasm that each segment of data has, and its address.
    segments: Vec<(Range<usize>, u32)>,
    slots: u32,
    names: BTreeMap<u32, &'a str>,
    symbols: Vec<SymbolInfo<'a>>,
    of_code: Vec<RelocationEntry>,
    of_data: Vec<RelocationEntry>,
}

impl Linked {
    /// What a function refers to; nothing for what wasm-bindgen has made. A function that neither of them made is an error,
    /// because its part might lack what it needs.
    pub(super) fn of(&self, function: &walrus::Function) -> Result<Option<&References>> {
        let name = function.name.as_ref().context("a function without a name")?;
        let references = self.functions.get(name);
        let is_made = name.ends_with(" shim") || name.starts_with("__wbindgen_");
        ensure!(references.is_some() || is_made, "neither the linker nor wasm-bindgen makes a function {name}");
        Ok(references)
    }

    /// Reads the graph of a wasm that the linker has written.
    pub(super) fn read(wasm: &[u8]) -> Result<Self> {
        let sections = Sections::read(wasm)?;
        ensure!(!sections.of_code.is_empty(), "a wasm that was linked without `{EMIT}`");
        let (bytes, start) = sections.segments.first().context("a wasm without constants")?;
        let constants = *start..start + bytes.len() as u32;
        let mut linked = Self { constants, slots: sections.slots, ..Self::default() };
        let mut datum_of = BTreeMap::new();
        let mut data = vec![];
        for (number, symbol) in sections.symbols.iter().enumerate() {
            let SymbolInfo::Data { symbol: Some(at), .. } = symbol else { continue };
            // Symbols of the linker lie outside of all segments.
            let Some((bytes, address)) = sections.segments.get(at.index as usize) else { continue };
            let (start, place) = (bytes.start + at.offset as usize, address + at.offset);
            datum_of.insert(number as u32, linked.data.len());
            data.push((start..start + at.size as usize, linked.data.len()));
            linked.data.push(Datum { place: place..place + at.size, references: References::default() });
        }
        for name in sections.names.values() {
            linked.functions.entry(renamed(name).to_owned()).or_default();
        }
        for entry in &sections.of_code {
            let at = sections.code + entry.offset as usize;
            let number = sections.bodies.partition_point(|body| body.end <= at);
            ensure!(sections.bodies.get(number).is_some_and(|body| body.contains(&at)), "a reference outside of code");
            let name = sections.names.get(&(sections.imported + number as u32)).context("a function without a name")?;
            add(wasm, entry, at, &datum_of, linked.functions.entry(renamed(name).to_owned()).or_default())?;
        }
        data.sort_by_key(|(bytes, _)| bytes.start);
        let longest = data.iter().map(|(bytes, _)| bytes.len()).max().unwrap_or(0);
        for entry in &sections.of_data {
            let at = sections.data + entry.offset as usize;
            let end = data.partition_point(|(bytes, _)| bytes.start <= at);
            // Names of one datum may overlap.
            let near = data[..end].iter().rev().take_while(|(bytes, _)| bytes.start + longest > at);
            let owners: Vec<usize> = near.filter(|(bytes, _)| bytes.contains(&at)).map(|&(_, datum)| datum).collect();
            ensure!(!owners.is_empty(), "a reference outside of data");
            for datum in owners {
                add(wasm, entry, at, &datum_of, &mut linked.data[datum].references)?;
            }
        }
        Ok(linked)
    }

    /// The sets of each byte of the constants, by those of the data.
    pub(super) fn constants_of(&self, data: &[u32]) -> Vec<u32> {
        let mut bytes = vec![0; self.constants.len()];
        for (datum, of) in self.data.iter().zip(data) {
            let at = |address: u32| address.saturating_sub(self.constants.start) as usize;
            bytes.get_mut(at(datum.place.start)..at(datum.place.end)).into_iter().flatten().for_each(|it| *it |= of);
        }
        bytes
    }
}

/// The name that wasm-bindgen gives to a function: it takes the number of the crate off the names of its exports.
fn renamed(name: &str) -> &str {
    let is_number = |end: &str| end.len() == 16 && end.bytes().all(|digit| digit.is_ascii_hexdigit());
    name.rsplit_once('_').filter(|(_, end)| is_number(end)).map_or(name, |(start, _)| start)
}

/// Adds the reference at a place of the wasm.
fn add(
    wasm: &[u8],
    entry: &RelocationEntry,
    at: usize,
    datum_of: &BTreeMap<u32, usize>,
    to: &mut References,
) -> Result<()> {
    use RelocationType as Type;
    match entry.ty {
        Type::TableIndexSleb => _ = to.slots.insert(BinaryReader::new(&wasm[at..], at).read_var_i32()?.cast_unsigned()),
        Type::TableIndexI32 => _ = to.slots.insert(BinaryReader::new(&wasm[at..], at).read_u32()?),
        Type::MemoryAddrLeb | Type::MemoryAddrSleb | Type::MemoryAddrI32 => {
            to.data.extend(datum_of.get(&entry.index));
        }
        // Calls by name are read from the code.
        Type::FunctionIndexLeb | Type::TypeIndexLeb | Type::GlobalIndexLeb | Type::TableNumberLeb => {}
        other => bail!("an unknown reference: {other:?}"),
    }
    Ok(())
}

impl<'a> Sections<'a> {
    fn read(wasm: &'a [u8]) -> Result<Self> {
        let mut sections = Self::default();
        for payload in Parser::new(0).parse_all(wasm) {
            match payload? {
                Payload::ImportSection(imports) => {
                    for import in imports.into_imports() {
                        sections.imported += u32::from(matches!(import?.ty, TypeRef::Func(_)));
                    }
                }
                Payload::TableSection(tables) => {
                    for table in tables {
                        let table = table?.ty;
                        sections.slots =
                            if table.element_type.is_func_ref() { table.initial as u32 } else { sections.slots };
                    }
                }
                Payload::CodeSectionStart { range, .. } => sections.code = range.start,
                Payload::CodeSectionEntry(body) => sections.bodies.push(body.range()),
                Payload::DataSection(data) => {
                    sections.data = data.range().start;
                    for segment in data {
                        let segment = segment?;
                        let DataKind::Active { offset_expr, .. } = segment.kind else { bail!("data that code loads") };
                        let Operator::I32Const { value } = offset_expr.get_operators_reader().read()? else {
                            bail!("data at an address that is computed")
                        };
                        let start = segment.range.end - segment.data.len();
                        sections.segments.push((start..segment.range.end, value.cast_unsigned()));
                    }
                }
                Payload::CustomSection(custom) => sections.custom(custom.name(), custom.as_known())?,
                _ => {}
            }
        }
        Ok(sections)
    }

    fn custom(&mut self, name: &str, content: KnownCustom<'a>) -> Result<()> {
        match content {
            KnownCustom::Name(names) => {
                for kind in names {
                    let Name::Function(names) = kind? else { continue };
                    for naming in names {
                        let naming = naming?;
                        self.names.insert(naming.index, naming.name);
                    }
                }
            }
            KnownCustom::Linking(linking) => {
                for subsection in linking {
                    let Linking::SymbolTable(symbols) = subsection? else { continue };
                    self.symbols = symbols.into_iter().collect::<Result<_, _>>()?;
                }
            }
            KnownCustom::Reloc(entries) => {
                let to = if name == "reloc.CODE" { &mut self.of_code } else { &mut self.of_data };
                *to = entries.entries().into_iter().collect::<Result<_, _>>()?;
            }
            _ => {}
        }
        Ok(())
    }
}
