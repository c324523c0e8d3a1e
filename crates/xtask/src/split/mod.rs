//! Wasms in several files: the first part, and parts that join it.
//!
//! The parts share memory, tables and globals, so no state moves when a part joins. A part calls another one through
//! slots of the table, which each part fills for its functions when it is instantiated; until then such a call traps.
//! The first part is always there, and the others import what they call of it. A function may be in several parts that no
//! instance has together.

mod core;
mod linked;
mod tools;

pub(crate) use core::{REST, split_core};
pub(crate) use linked::EMIT;
pub(crate) use tools::split_tools;

use crate::files;
use anyhow::{Context, Result, bail};
use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use walrus::ir::{Value, Visitor, dfs_in_order};
use walrus::{
    ConstExpr, DataKind, ElementItems, ElementKind, ExportItem, FunctionBuilder, FunctionId, FunctionKind, GlobalKind,
    ImportKind, ImportedFunction, LocalFunction, Module, ModuleConfig, RefType, TableId, ValType, passes,
};

/// A wasm without contents.
const EMPTY: &[u8] = b"\0asm\x01\0\0\0";

/// A set of parts: a bit for each. The first part has the lowest bit.
type Parts = u32;

/// The first part alone.
const FIRST: Parts = 1;

/// Which parts have what.
struct Plan {
    parts: usize,
    /// The parts of all functions, by the functions' numbers. The first part has what is imported.
    functions: Vec<Parts>,
    /// Addresses of constants that are not in the first part, in order, with their parts.
    constants: Vec<(Range<u32>, Parts)>,
}

impl Plan {
    /// Whether a part has a function.
    fn has(&self, part: usize, function: usize) -> bool {
        self.functions[function] >> part & 1 == 1
    }
}

/// Divides a wasm into its parts.
fn divide(wasm: &[u8], plan: &Plan) -> Result<Vec<Vec<u8>>> {
    let mut first = ModuleConfig::new().generate_name_section(false).parse(wasm)?;
    let slots = Slots::new(&first, plan)?;
    let items = items(&first, plan);
    // The memory is named after the whole, so that the parts of two versions do not fit each other.
    let version = &files::hex(&Sha256::digest(wasm))[..16];
    let mut used = BTreeMap::new();
    let later = (1..plan.parts).map(|part| later_part(wasm, plan, &slots, part, version, &mut used));
    let later = later.collect::<Result<Vec<_>>>()?;
    slots.take_out(&mut first, plan)?;
    for (number, name) in used {
        let item = match items[number] {
            ImportKind::Function(id) => ExportItem::Function(id),
            ImportKind::Table(id) => ExportItem::Table(id),
            ImportKind::Memory(id) => ExportItem::Memory(id),
            ImportKind::Global(id) => ExportItem::Global(id),
            ImportKind::Tag(_) => bail!("a tag"),
        };
        first.exports.add(&name, item);
    }
    for id in first.data.iter().map(walrus::Data::id).collect::<Vec<_>>() {
        let data = first.data.get_mut(id);
        let start = address(&data.kind)?;
        for (place, _) in &plan.constants {
            let range = (place.start.wrapping_sub(start)) as usize..(place.end.wrapping_sub(start)) as usize;
            if let Some(bytes) = data.value.get_mut(range) {
                bytes.fill(0);
            }
        }
    }
    let first = written(&mut first);
    Ok([first].into_iter().chain(later).collect())
}

/// A part but the first one. `used` gets what it imports, with names.
fn later_part(
    wasm: &[u8],
    plan: &Plan,
    slots: &Slots,
    part: usize,
    version: &str,
    used: &mut BTreeMap<usize, String>,
) -> Result<Vec<u8>> {
    let mut module = ModuleConfig::new().generate_name_section(false).parse(wasm)?;
    let there = functions(&module);
    let constants = constants(&module, plan, part)?;
    clear(&mut module)?;
    slots.call_others(&mut module, plan, part)?;
    fill(&mut module, slots.of.iter().filter(|(_, number)| plan.has(part, **number)), &there)?;
    let memory = module.memories.iter().next().context("a wasm without a memory")?.id();
    for (start, value) in constants {
        let offset = ConstExpr::Value(Value::I32(start.cast_signed()));
        let data = module.data.add(DataKind::Active { memory, offset }, value);
        module.memories.get_mut(memory).data_segments.insert(data);
    }
    let items = items(&module, plan);
    used.extend(share(&mut module, items, version)?);
    Ok(written(&mut module))
}

/// A module without what nobody uses and without remarks.
fn written(module: &mut Module) -> Vec<u8> {
    passes::gc::run(module);
    module.customs = walrus::ModuleCustomSections::default();
    module.emit_wasm()
}

/// All functions, by their numbers.
fn functions(module: &Module) -> Vec<FunctionId> {
    module.funcs.iter().map(walrus::Function::id).collect()
}

/// What other parts can import of the first part. All modules of a wasm have it in the same order.
fn items(module: &Module, plan: &Plan) -> Vec<ImportKind> {
    let early = functions(module).into_iter().zip(&plan.functions).filter(|(_, parts)| **parts == FIRST);
    (early.map(|(id, _)| id.into()))
        .chain(module.tables.iter().map(|table| table.id().into()))
        .chain(module.globals.iter().map(|global| global.id().into()))
        .chain(module.memories.iter().map(|memory| memory.id().into()))
        .collect()
}

/// Runs of bytes that are not in the first part, by the parts of each byte from an address on.
fn runs(start: u32, parts: impl Iterator<Item = Parts>) -> Vec<(Range<u32>, Parts)> {
    let mut runs: Vec<(Range<u32>, Parts)> = vec![];
    for (address, of) in (start..).zip(parts) {
        match runs.last_mut() {
            Some((place, last)) if *last == of && place.end == address => place.end += 1,
            _ if of != FIRST => runs.push((address..address + 1, of)),
            _ => {}
        }
    }
    runs
}

/// The address of a segment of data.
fn address(kind: &DataKind) -> Result<u32> {
    match kind {
        DataKind::Active { offset: ConstExpr::Value(Value::I32(start)), .. } => Ok(start.cast_unsigned()),
        _ => bail!("data that code loads"),
    }
}

/// The constants of a part, by addresses.
fn constants(module: &Module, plan: &Plan, part: usize) -> Result<Vec<(u32, Vec<u8>)>> {
    let mut found = vec![];
    for data in module.data.iter() {
        let start = address(&data.kind)?;
        for (place, _) in plan.constants.iter().filter(|(_, parts)| parts >> part & 1 == 1) {
            let range = (place.start.wrapping_sub(start)) as usize..(place.end.wrapping_sub(start)) as usize;
            found.extend(data.value.get(range).map(|bytes| (place.start, bytes.to_vec())));
        }
    }
    Ok(found)
}

/// The table of the functions that are called by pointers.
fn table_of(module: &Module) -> Result<TableId> {
    let found = module.tables.iter().find(|table| table.element_ty == RefType::FUNCREF);
    Ok(found.context("a wasm without a table of functions")?.id())
}

/// The functions that functions name.
struct Named(BTreeSet<FunctionId>);

impl Visitor<'_> for Named {
    fn visit_function_id(&mut self, id: &FunctionId) {
        self.0.insert(*id);
    }
}

/// Slots of the table for the functions of parts but the first one.
struct Slots {
    /// The functions' numbers, by slots.
    of: BTreeMap<i32, usize>,
    /// The slots of the functions that another part names.
    called: BTreeMap<usize, i32>,
    /// How many slots the table gets.
    added: u64,
}

impl Slots {
    fn new(module: &Module, plan: &Plan) -> Result<Self> {
        let table = table_of(module)?;
        let numbers: BTreeMap<FunctionId, usize> = functions(module).into_iter().zip(0..).collect();
        let mut of = BTreeMap::new();
        for (slot, id) in filled(module, table)? {
            let number = numbers[&id];
            if plan.functions[number] != FIRST {
                of.insert(slot, number);
            }
        }
        let mut named = BTreeSet::new();
        for (function, &parts) in module.funcs.iter().zip(&plan.functions) {
            let FunctionKind::Local(local) = &function.kind else { continue };
            let mut names = Named(BTreeSet::new());
            dfs_in_order(&mut names, local, local.entry_block());
            named.extend(names.0.iter().map(|id| numbers[id]).filter(|&number| parts & !plan.functions[number] != 0));
        }
        named.extend(module.exports.iter().filter_map(|export| match export.item {
            ExportItem::Function(id) => Some(numbers[&id]),
            _ => None,
        }));
        let known: BTreeMap<usize, i32> = of.iter().map(|(&slot, &number)| (number, slot)).collect();
        let (mut called, mut added) = (BTreeMap::new(), 0);
        for number in named.into_iter().filter(|&number| plan.functions[number] != FIRST) {
            let slot = known.get(&number).copied().unwrap_or_else(|| {
                added += 1;
                (module.tables.get(table).initial + added - 1) as i32
            });
            of.insert(slot, number);
            called.insert(number, slot);
        }
        Ok(Self { of, called, added })
    }

    /// Makes functions of parts but the first one, and of `part`, calls of their slots.
    fn call_others(&self, module: &mut Module, plan: &Plan, part: usize) -> Result<()> {
        let (table, there) = (table_of(module)?, functions(module));
        for (&number, &slot) in self.called.iter().filter(|(number, _)| !plan.has(part, **number)) {
            let id = there[number];
            module.funcs.get_mut(id).kind = FunctionKind::Local(caller(module, id, table, slot));
        }
        Ok(())
    }

    /// Takes the functions of other parts out of the first one.
    fn take_out(&self, module: &mut Module, plan: &Plan) -> Result<()> {
        let (table, nobody) = (table_of(module)?, nobody(module));
        for element in module.elements.iter_mut() {
            let (ElementKind::Active { table: of, offset }, ElementItems::Functions(items)) =
                (&element.kind, &mut element.items)
            else {
                continue;
            };
            let &ConstExpr::Value(Value::I32(offset)) = offset else { bail!("functions at a slot that is computed") };
            for (_, item) in (offset..).zip(items).filter(|(slot, _)| *of == table && self.of.contains_key(slot)) {
                *item = nobody;
            }
        }
        let table = module.tables.get_mut(table);
        table.initial += self.added;
        table.maximum = table.maximum.map(|most| most.max(table.initial));
        self.call_others(module, plan, 0)
    }
}

/// The functions in the table, with their slots.
fn filled(module: &Module, table: TableId) -> Result<Vec<(i32, FunctionId)>> {
    let mut found = vec![];
    for element in module.elements.iter() {
        let (ElementKind::Active { table: of, offset }, ElementItems::Functions(items)) =
            (&element.kind, &element.items)
        else {
            continue;
        };
        let &ConstExpr::Value(Value::I32(offset)) = offset else { bail!("functions at a slot that is computed") };
        found.extend((offset..).zip(items.iter().copied()).filter(|_| *of == table));
    }
    Ok(found)
}

/// A function of a type that no call has, for slots without their function: calls trap there.
fn nobody(module: &mut Module) -> FunctionId {
    let params = [ValType::Ref(RefType::EXTERNREF); 9];
    let args = params.map(|param| module.locals.add(param)).to_vec();
    FunctionBuilder::new(&mut module.types, &params, &[]).finish(args, &mut module.funcs)
}

/// A function that calls the one in a slot, which has the same type as `id`.
fn caller(module: &mut Module, id: FunctionId, table: TableId, slot: i32) -> LocalFunction {
    let ty = module.funcs.get(id).ty();
    let (params, results) = (module.types.get(ty).params().to_vec(), module.types.get(ty).results().to_vec());
    let args: Vec<_> = params.iter().map(|&param| module.locals.add(param)).collect();
    let mut builder = FunctionBuilder::new(&mut module.types, &params, &results);
    let mut body = builder.func_body();
    for &arg in &args {
        body.local_get(arg);
    }
    body.i32_const(slot).call_indirect(ty, table);
    builder.local_func(args)
}

/// Takes exports, the start, data and elements out of the rest.
fn clear(module: &mut Module) -> Result<()> {
    module.start = None;
    for id in module.exports.iter().map(walrus::Export::id).collect::<Vec<_>>() {
        module.exports.delete(id);
    }
    for id in module.data.iter().map(walrus::Data::id).collect::<Vec<_>>() {
        module.data.delete(id);
    }
    for id in module.elements.iter().map(walrus::Element::id).collect::<Vec<_>>() {
        module.elements.delete(id);
    }
    module.tables.iter_mut().for_each(|table| table.elem_segments.clear());
    module.memories.iter_mut().for_each(|memory| memory.data_segments.clear());
    Ok(())
}

/// Fills slots of the table when the rest is instantiated.
fn fill<'a>(
    module: &mut Module,
    slots: impl Iterator<Item = (&'a i32, &'a usize)>,
    there: &[FunctionId],
) -> Result<()> {
    let table = table_of(module)?;
    let mut runs: Vec<(i32, Vec<FunctionId>)> = vec![];
    for (&slot, &number) in slots {
        let id = there[number];
        match runs.last_mut() {
            Some((start, run)) if *start + run.len() as i32 == slot => run.push(id),
            _ => runs.push((slot, vec![id])),
        }
    }
    for (start, run) in runs {
        let kind = ElementKind::Active { table, offset: ConstExpr::Value(Value::I32(start)) };
        let element = module.elements.add(kind, ElementItems::Functions(run));
        module.tables.get_mut(table).elem_segments.insert(element);
    }
    Ok(())
}

/// Makes items imports of a part. Returns the numbers of those that the part uses, with their names.
fn share(module: &mut Module, items: Vec<ImportKind>, version: &str) -> Result<Vec<(usize, String)>> {
    let mut names = vec![];
    for (number, kind) in items.into_iter().enumerate() {
        let is_memory = matches!(kind, ImportKind::Memory(_));
        let name = if is_memory { version.to_owned() } else { number.to_string() };
        let import = module.imports.add("", &name, kind.clone());
        names.push((import, (number, name)));
        match kind {
            ImportKind::Function(id) => {
                let ty = module.funcs.get(id).ty();
                let kind = &mut module.funcs.get_mut(id).kind;
                if let FunctionKind::Import(former) = kind {
                    module.imports.delete(former.import);
                }
                *kind = FunctionKind::Import(ImportedFunction { import, ty });
            }
            ImportKind::Table(id) => {
                let table = module.tables.get_mut(id);
                // The table of the first part is larger.
                (table.import, table.maximum) = (Some(import), None);
            }
            ImportKind::Memory(id) => module.memories.get_mut(id).import = Some(import),
            ImportKind::Global(id) => module.globals.get_mut(id).kind = GlobalKind::Import(import),
            ImportKind::Tag(_) => bail!("a tag"),
        }
    }
    passes::gc::run(module);
    let used: BTreeSet<_> = module.imports.iter().map(walrus::Import::id).collect();
    Ok(names.into_iter().filter(|(import, _)| used.contains(import)).map(|(_, named)| named).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use walrus::ModuleConfig;

    /// Three functions: one calls another one, which stores 7; the table has this one and the third.
    pub(super) fn whole() -> Vec<u8> {
        let mut module = Module::with_config(ModuleConfig::new());
        let memory = module.memories.add_local(false, false, 1, None, None);
        let table = module.tables.add_local(false, 2, Some(2), RefType::FUNCREF);
        let mut stores = FunctionBuilder::new(&mut module.types, &[], &[]);
        let arg = walrus::ir::MemArg { align: 4, offset: 0 };
        stores.func_body().i32_const(0).i32_const(7).store(memory, walrus::ir::StoreKind::I32 { atomic: false }, arg);
        let stores = stores.finish(vec![], &mut module.funcs);
        let mut calls = FunctionBuilder::new(&mut module.types, &[], &[]);
        calls.func_body().call(stores);
        let calls = calls.finish(vec![], &mut module.funcs);
        let idle = FunctionBuilder::new(&mut module.types, &[], &[]).finish(vec![], &mut module.funcs);
        let kind = ElementKind::Active { table, offset: ConstExpr::Value(Value::I32(0)) };
        let element = module.elements.add(kind, ElementItems::Functions(vec![stores, idle]));
        module.tables.get_mut(table).elem_segments.insert(element);
        module.exports.add("calls", calls);
        let offset = ConstExpr::Value(Value::I32(1));
        let data = module.data.add(DataKind::Active { memory, offset }, vec![1, 2, 3, 4]);
        module.memories.get_mut(memory).data_segments.insert(data);
        module.emit_wasm()
    }

    fn number_of(module: &Module, name: &str) -> usize {
        let id = module.exports.get_func(name).unwrap();
        functions(module).iter().position(|&each| each == id).unwrap()
    }

    /// The function that is exported is in `calls`, and the others in the second and the third part.
    fn plan(module: &Module, calls: Parts) -> Plan {
        let first = number_of(module, "calls");
        let functions = (0..3).map(|number| if number == first { calls } else { FIRST << number.max(1) }).collect();
        Plan { parts: 3, functions, constants: vec![(2..4, FIRST << 2)] }
    }

    #[test]
    fn parts_import_what_the_first_one_exports_and_fill_their_slots() {
        let whole = whole();
        let plan = plan(&Module::from_buffer(&whole).unwrap(), FIRST);
        let parts = divide(&whole, &plan).unwrap();
        let [first, second, third] = &*parts else { panic!("three parts") };
        let [first, second, third] = [first, second, third].map(|part| Module::from_buffer(part).unwrap());
        assert!(first.exports.get_func("calls").is_ok() && second.exports.iter().next().is_none());
        let given: Vec<&str> = first.exports.iter().map(|export| &*export.name).collect();
        assert!(second.imports.iter().count() >= 2, "memory and table");
        for import in second.imports.iter().chain(third.imports.iter()) {
            assert!(given.contains(&&*import.name), "{} of {given:?}", import.name);
        }
        let filled = |module: &Module| -> usize {
            let items = module.elements.iter().map(|element| match &element.items {
                ElementItems::Functions(items) => items.len(),
                ElementItems::Expressions(..) => 0,
            });
            items.sum()
        };
        assert_eq!((filled(&second), filled(&third)), (1, 1), "functions that are named, and only in the table");
        let stores = |module: &Module| module.funcs.iter_local().filter(|(_, it)| it.size() == 3).count();
        assert_eq!([&first, &second, &third].map(stores), [0, 1, 0]);
    }

    #[test]
    fn constants_are_in_one_part() {
        let whole = whole();
        let plan = plan(&Module::from_buffer(&whole).unwrap(), FIRST);
        let data = |part: &Vec<u8>| -> Vec<(u32, Vec<u8>)> {
            let module = Module::from_buffer(part).unwrap();
            module.data.iter().map(|data| (address(&data.kind).unwrap(), data.value.clone())).collect()
        };
        let parts: Vec<_> = divide(&whole, &plan).unwrap().iter().map(data).collect();
        assert_eq!(parts, [vec![(1, vec![1, 0, 0, 4])], vec![], vec![(2, vec![2, 3])]]);
    }

    #[test]
    fn parts_of_two_versions_do_not_fit() {
        let whole = whole();
        let mut other = Module::from_buffer(&whole).unwrap();
        let plan = plan(&other, FIRST << 1);
        other.exports.remove("calls").unwrap();
        let parts = |wasm: &[u8]| divide(wasm, &plan).unwrap();
        let rest = &parts(&other.emit_wasm())[1];
        let first = Module::from_buffer(&parts(&whole)[0]).unwrap();
        let fits = |name: &str| first.exports.iter().any(|export| export.name == name);
        assert!(!Module::from_buffer(rest).unwrap().imports.iter().all(|import| fits(&import.name)));
    }
}
