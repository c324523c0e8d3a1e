//! The wasm of the tools in several files, so that the first call of a tool loads what this tool needs.
//!
//! A function is needed by a tool if the linker would keep it for this tool alone ([`linked`]): no call finds its function
//! missing. `www/js/tool-parts.json` says which parts there are and which tools load each. What all tools of `first` need
//! is in the first part, which every tool loads. Any other function goes into as few parts as reach all tools that need it; of
//! these, into parts that no other tool loads.

use super::linked::{self, Linked};
use super::{EMPTY, FIRST, Named, Parts, Plan, divide, filled, functions, runs, table_of};
use crate::files;
use crate::wasms::{self, ALONE};
use crate::workspace::{Kind, Workspace};
use anyhow::{Context, Result, bail, ensure};
use fs_err as fs;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use walrus::ir::dfs_in_order;
use walrus::{ExportItem, FunctionId, FunctionKind, Module};

/// The wasms of some tools, `NAME.wasm`, for pages in single files.
const OF_TOOLS: [(&str, &[&str]); 2] = [(ALONE[0], &["course", "study"]), (ALONE[1], &["film"])];

/// A set of tools: a bit for each.
type Tools = u32;

/// All tools.
const ALL: Tools = Tools::MAX;

/// The parts of the tools' wasm, with the tools that load them. The tools of the first part decide what it has.
type Table = Vec<(String, Vec<String>)>;

fn table(workspace: &Workspace) -> Result<Table> {
    read_table(&fs::read_to_string(workspace.www().join("js/tool-parts.json"))?)
}

fn read_table(text: &str) -> Result<Table> {
    let mut parts: BTreeMap<String, Vec<String>> = serde_json::from_str(text)?;
    let first = parts.remove("first").context("no first part")?;
    Ok([("first".to_owned(), first)].into_iter().chain(parts).collect())
}

/// The names of the parts' files on the site, the first one's first.
fn part_files(workspace: &Workspace) -> Result<Vec<String>> {
    Ok(table(workspace)?.iter().map(|(part, _)| format!("tools-{part}.wasm")).collect())
}

/// Splits the tools in the folder of the site. A draft's first part is the whole.
pub(crate) fn split_tools(workspace: &Workspace, kind: Kind, site: &Path) -> Result<()> {
    let (files, whole) = (part_files(workspace)?, site.join("tools.wasm"));
    if kind == Kind::Draft {
        files[1..].iter().try_for_each(|file| files::write(&site.join(file), EMPTY))?;
        let wholes = ALONE.map(|name| format!("{name}.wasm"));
        return Ok(wholes
            .iter()
            .chain(&files[..1])
            .try_for_each(|file| fs::copy(&whole, site.join(file)).map(drop))?);
    }
    let made = wasms::generated(workspace).join("tools");
    let (linked, parts) = (wasms::TOOLS.linked(workspace, kind), workspace.www().join("js/tool-parts.json"));
    let calls = files::list(&workspace.www().join("worker/calls"), |_| true)?;
    let sources: Vec<&Path> = [&whole, &linked, &parts].into_iter().chain(&calls).map(|file| &**file).collect();
    files::once(&sources, &made.join("made-of"), || {
        let wasm = fs::read(&whole)?;
        let tools = calls.iter().map(|file| Tool::read(file)).collect::<Result<Vec<_>>>()?;
        let needs = Needs::new(&Module::from_buffer(&wasm)?, &Linked::read(&fs::read(&linked)?)?, &tools)?;
        for (file, part) in files.iter().zip(divide(&wasm, &needs.plan(&tools, &table(workspace)?)?)?) {
            files::write(&made.join(file), part)?;
        }
        for (name, of) in OF_TOOLS {
            let [only, ..] = &divide(&wasm, &needs.alone(&tools, of)?)?[..] else { continue };
            files::write(&made.join(format!("{name}.wasm")), only)?;
        }
        let all = needs.planned(1, |_| FIRST);
        divide(&wasm, &all)?.iter().try_for_each(|all| files::write(&made.join("tools.wasm"), all))
    })?;
    let carried = ["tools"].into_iter().chain(ALONE).map(|name| format!("{name}.wasm"));
    files
        .iter()
        .cloned()
        .chain(carried)
        .try_for_each(|file| Ok(fs::copy(made.join(&file), site.join(&file)).map(drop)?))
}

/// A tool: a file of `www/worker/calls`.
struct Tool {
    name: String,
    /// The functions and classes of the wasm that the tool names.
    named: BTreeSet<String>,
}

impl Tool {
    fn read(file: &Path) -> Result<Self> {
        let name = file.file_stem().and_then(|stem| stem.to_str()).context("a tool without a name")?;
        let text = fs::read_to_string(file)?;
        let is_word = |letter: char| letter.is_alphanumeric() || letter == '_';
        let words = text.split("wasm_bindgen.").skip(1).filter_map(|rest| rest.split(|letter| !is_word(letter)).next());
        Ok(Self { name: name.to_owned(), named: words.map(str::to_owned).collect() })
    }

    /// Whether an export is a function that the tool names, or belongs to a class that it names.
    fn calls(&self, export: &str) -> bool {
        let of_class = |class: &String| {
            let class = class.to_lowercase();
            export.starts_with(&format!("{class}_")) || export == format!("__wbg_{class}_free")
        };
        self.named.contains(export) || self.named.iter().any(of_class)
    }
}

/// The tools that need each function and each constant.
struct Needs {
    /// By the functions' numbers; nothing for what is imported, which the first part has.
    functions: Vec<Option<Tools>>,
    /// The address of the constants, and the tools that need each of their bytes.
    constants: (u32, Vec<Tools>),
}

impl Needs {
    fn new(module: &Module, linked: &Linked, tools: &[Tool]) -> Result<Self> {
        let ids = functions(module);
        let numbers: BTreeMap<FunctionId, usize> = ids.iter().copied().zip(0..).collect();
        let slots: BTreeMap<u32, usize> = (filled(module, table_of(module)?)?.into_iter())
            .map(|(slot, id)| (slot.cast_unsigned(), numbers[&id]))
            .collect();
        // The functions, then the data.
        let mut needs = vec![0; ids.len() + linked.data.len()];
        let mut open: Vec<(usize, Tools)> = vec![];
        for export in module.exports.iter() {
            let ExportItem::Function(id) = export.item else { continue };
            let callers = (tools.iter().zip(0..)).filter(|(tool, _)| tool.calls(&export.name));
            let callers = callers.fold(0, |all, (_, number)| all | 1 << number);
            open.push((numbers[&id], if callers == 0 { ALL } else { callers }));
        }
        open.extend(module.start.map(|id| (numbers[&id], ALL)));
        // What wasm-bindgen has added to the table.
        open.extend(slots.range(linked.slots..).map(|(_, &number)| (number, ALL)));
        let edges = |references: &linked::References| -> Vec<usize> {
            let called = references.slots.iter().filter_map(|slot| slots.get(slot).copied());
            called.chain(references.data.iter().map(|datum| ids.len() + datum)).collect()
        };
        let mut known: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (number, &id) in ids.iter().enumerate() {
            let function = module.funcs.get(id);
            let FunctionKind::Local(local) = &function.kind else { continue };
            let mut named = Named(BTreeSet::new());
            dfs_in_order(&mut named, local, local.entry_block());
            let pointed = linked.of(function)?.map(edges).unwrap_or_default();
            known.insert(number, named.0.iter().map(|id| numbers[id]).chain(pointed).collect());
        }
        known.extend(linked.data.iter().zip(ids.len()..).map(|(datum, node)| (node, edges(&datum.references))));
        while let Some((node, tools)) = open.pop() {
            if needs[node] | tools != needs[node] {
                needs[node] |= tools;
                open.extend(known.get(&node).into_iter().flatten().map(|&next| (next, needs[node])));
            }
        }
        let local = |id: &FunctionId| matches!(module.funcs.get(*id).kind, FunctionKind::Local(_));
        let functions = ids.iter().zip(&needs).map(|(id, &tools)| local(id).then_some(tools)).collect();
        Ok(Self { functions, constants: (linked.constants.start, linked.constants_of(&needs[ids.len()..])) })
    }

    /// The plan with so many parts, where `parts_of` tells the parts of what some tools need.
    fn planned(&self, parts: usize, parts_of: impl Fn(Tools) -> Parts) -> Plan {
        // Nobody calls or reads what no tool needs: the parts may leave it out, and constants have gaps.
        let functions = self.functions.iter().map(|tools| tools.map_or(FIRST, &parts_of)).collect();
        let of = |&tools: &Tools| if tools == 0 { FIRST } else { parts_of(tools) };
        let constants = runs(self.constants.0, self.constants.1.iter().map(of));
        Plan { parts, functions, constants }
    }

    fn plan(&self, tools: &[Tool], table: &Table) -> Result<Plan> {
        let sets = table.iter().map(|(_, names)| set(tools, names)).collect::<Result<Vec<Tools>>>()?;
        let [first, sets @ ..] = &sets[..] else { bail!("no parts") };
        ensure!(
            tools.iter().enumerate().all(|(tool, _)| sets.iter().any(|set| set >> tool & 1 == 1)),
            "a tool without a part"
        );
        Ok(self.planned(sets.len() + 1, |needed| if first & !needed == 0 { FIRST } else { cover(sets, needed) << 1 }))
    }

    /// The plan whose first part has all that some tools need.
    fn alone(&self, tools: &[Tool], names: &[&str]) -> Result<Plan> {
        let set = set(tools, names)?;
        Ok(self.planned(1, |needed| if needed & set == 0 { FIRST << 1 } else { FIRST }))
    }
}

/// The sets that have all of `needed`: first the largest ones that have nothing else.
fn cover(sets: &[Tools], needed: Tools) -> Parts {
    let (mut left, mut parts) = (needed, 0);
    let all = sets.iter().fold(0, |all, set| all | set);
    while left & all != 0 {
        let useful = sets.iter().enumerate().filter(|(_, set)| *set & left != 0);
        let best = useful.min_by_key(|(_, set)| ((*set & !needed).count_ones(), Reverse((*set & left).count_ones())));
        let Some((part, set)) = best else { break };
        parts |= 1 << part;
        left &= !set;
    }
    parts
}

fn set(tools: &[Tool], names: &[impl AsRef<str>]) -> Result<Tools> {
    ensure!(tools.len() < Tools::BITS as usize, "too many tools");
    let number = |name: &str| tools.iter().position(|tool| tool.name == name);
    let bit = |name: &str| Ok(1 << number(name).with_context(|| format!("no tool is named {name}"))?);
    names.iter().map(|name| bit(name.as_ref())).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_without_other_tools_come_first() {
        let sets = [0b0001, 0b0011, 0b0110, 0b1100];
        for (needed, parts) in
            [(0b0001, 0b0001), (0b0011, 0b0010), (0b0111, 0b0110), (0b0010, 0b0010), (0b1000, 0b1000)]
        {
            assert_eq!(cover(&sets, needed), parts, "{needed:b}");
        }
        assert_eq!(cover(&sets, 0), 0);
    }

    #[test]
    fn a_tool_calls_the_functions_and_the_classes_that_it_names() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("find.js");
        files::write(&file, "wasm_bindgen.outlineOfSvg(bytes); new wasm_bindgen.RuleFinder(1)").unwrap();
        let tool = Tool::read(&file).unwrap();
        assert_eq!(tool.name, "find");
        for called in ["outlineOfSvg", "rulefinder_new", "__wbg_rulefinder_free"] {
            assert!(tool.calls(called), "{called}");
        }
        for other in ["outline", "rulefinder", "openexercise_new", "__wbindgen_malloc"] {
            assert!(!tool.calls(other), "{other}");
        }
    }

    #[test]
    fn constants_follow_their_tools() {
        let needs =
            Needs { functions: vec![None, Some(0b01), Some(0b11)], constants: (8, vec![0b11, 0b01, 0b01, 0, 0b10]) };
        let tools = ["a", "b"].map(|name| Tool { name: name.to_owned(), named: BTreeSet::new() });
        let table = read_table(r#"{"b": ["b"], "a": ["a"], "first": ["a", "b"]}"#).unwrap();
        let plan = needs.plan(&tools, &table).unwrap();
        assert_eq!((plan.parts, plan.functions), (3, vec![FIRST, 0b010, FIRST]));
        assert_eq!(plan.constants, [(9..11, 0b010), (12..13, 0b100)]);
        let alone = needs.alone(&tools, &["b"]).unwrap();
        assert_eq!((alone.parts, alone.functions), (1, vec![FIRST, 0b10, FIRST]));
        assert!(needs.alone(&tools, &["c"]).is_err());
    }
}
