//! Random inputs, and the file that names the present one in case the program crashes.

use crate::{Source, Target};
use anyhow::{Context, Result};
use lsystem::Definition;
use std::fs::File;
use std::io::{Seek, Write};
use std::path::{Path, PathBuf};

/// The generator SplitMix64 (Steele, Lea and Flood, Fast splittable pseudorandom number generators, 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }
}

/// The inputs of a target: the committed inputs, then an endless number of random ones.
pub(crate) struct Inputs {
    target: &'static Target,
    seed: u64,
    /// The committed systems.
    systems: Vec<Definition>,
    /// The committed rows of bytes.
    rows: Vec<Vec<u8>>,
}

/// One input: a row of bytes, and a committed system, if any.
#[derive(Default)]
pub(crate) struct Input {
    pub(crate) bytes: Vec<u8>,
    pub(crate) system: Option<Definition>,
}

impl Input {
    /// A source that reads the input.
    pub(crate) fn source(&self) -> Source<'_> {
        let mut source = Source::new(&self.bytes);
        source.given.clone_from(&self.system);
        source
    }
}

/// The number of rows of bytes that are tried with each committed system; the first row is empty.
const ROWS: usize = 4;

impl Inputs {
    /// Reads the folder `seeds`: systems as `.json` for all targets, and rows of bytes as `TARGET-NAME.bin`.
    pub(crate) fn of(target: &'static Target, seed: u64) -> Result<Self> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("seeds");
        let entries = std::fs::read_dir(&folder).with_context(|| format!("reading {}", folder.display()))?;
        let mut paths: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
        paths.sort();
        let (mut systems, mut rows) = (vec![], vec![]);
        for path in paths.iter().filter(|path| path.is_file()) {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let bytes = || std::fs::read(path).with_context(|| format!("reading {}", path.display()));
            if name.ends_with(".json") {
                let system = lsystem::read_file(&bytes()?).definition;
                systems.push(system.with_context(|| format!("{} has no system", path.display()))?);
            } else if name.starts_with(&format!("{}-", target.name)) {
                rows.push(bytes()?);
            }
        }
        Ok(Self { target, seed, systems, rows })
    }

    /// The number of committed inputs.
    pub(crate) fn committed(&self) -> u64 {
        (ROWS * self.systems.len() + self.rows.len()) as u64
    }

    /// Replaces `input` by the input `number`.
    pub(crate) fn fill(&self, number: u64, input: &mut Input) {
        input.system = None;
        let index = usize::try_from(number).unwrap_or(usize::MAX);
        if let Some(row) = self.rows.get(index) {
            input.bytes.clone_from(row);
            return;
        }
        let index = index - self.rows.len();
        random(self.target, self.seed, number, &mut input.bytes);
        if let Some(system) = self.systems.get(index / ROWS) {
            input.system = Some(system.clone());
            if index.is_multiple_of(ROWS) {
                input.bytes.clear();
            }
        }
    }
}

/// Writes the random input `number` of a target and a seed into `bytes`.
fn random(target: &Target, seed: u64, number: u64, bytes: &mut Vec<u8>) {
    let name = target.name.bytes().fold(seed, |hash, byte| hash.wrapping_mul(0x0100_0000_01b3) ^ u64::from(byte));
    let mut random = Random(name ^ number.wrapping_mul(0xd6e8_feb8_6659_fd93));
    // Short inputs are fast; long inputs reach more.
    let length = [64, 256, 512, 1024, 2048, 4096][(random.next() % 6) as usize];
    bytes.clear();
    while bytes.len() < length {
        bytes.extend(random.next().to_le_bytes());
    }
}

/// The file with the number of the present input.
pub(crate) struct Current(File);

impl Current {
    pub(crate) fn new(folder: &Path, target: &Target) -> Result<Self> {
        let path = Self::path(folder, target);
        Ok(Self(File::create(&path).with_context(|| format!("creating {}", path.display()))?))
    }

    /// The path of the file.
    pub(crate) fn path(folder: &Path, target: &Target) -> PathBuf {
        folder.join(format!("{}.current", target.name))
    }

    /// Writes the number of the next input. The number determines the input.
    pub(crate) fn note(&mut self, number: u64) -> Result<()> {
        self.0.rewind()?;
        Ok(self.0.write_all(&number.to_le_bytes())?)
    }

    /// The number written last.
    pub(crate) fn read(folder: &Path, target: &Target) -> Option<u64> {
        let bytes = std::fs::read(Self::path(folder, target)).ok()?;
        Some(u64::from_le_bytes(bytes.try_into().ok()?))
    }
}
