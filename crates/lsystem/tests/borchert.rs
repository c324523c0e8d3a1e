//! Borchert and Honda's model of a Tabebuia branch: signals carry the flux of a resource from the base to the apices, and
//! the number of apices back. The system is compared with a direct simulation of the tree.
//!
//! R. Borchert and H. Honda: Control of development in the bifurcating branch system of Tabebuia rosea: a computer
//! simulation. Botanical Gazette 145 (1984); as an L-system: P. Prusinkiewicz, M. Hammel, J. Hanan and R. Měch: Visual
//! models of plant development (1996).

use lsystem::base::Limits;
use lsystem::syntax::Definition;
use lsystem::{System, expand, read_file};

/// The flux at the base in the first cycle, its growth, the main branch's part of it, and the least flux of a fork.
const NUMBERS: [f64; 4] = [17.0, 0.89, 0.7, 5.0];

/// An internode with its flux, its number of apices, and the lateral and the main internode at its end.
#[derive(Debug)]
struct Internode {
    flux: f64,
    apices: f64,
    fork: Option<Box<[Self; 2]>>,
}

impl Internode {
    fn new() -> Self {
        Self { flux: 0.0, apices: 1.0, fork: None }
    }

    /// Takes a flux and passes it on: the lateral branch gets a part in proportion to its apices, and an apex with
    /// enough of it forks.
    fn take(&mut self, flux: f64) {
        let [_, _, main, least] = NUMBERS;
        self.flux = flux;
        match &mut self.fork {
            None if flux > least => self.fork = Some(Box::new([Self::new(), Self::new()])),
            None => {}
            Some(fork) => {
                let aside = flux * (1.0 - main) * (fork[0].apices / fork[1].apices);
                fork[0].take(aside);
                fork[1].take(flux - aside);
            }
        }
    }

    /// Counts the apices again.
    fn count(&mut self) -> f64 {
        if let Some(fork) = &mut self.fork {
            self.apices = fork[0].count() + fork[1].count();
        }
        self.apices
    }

    /// The internodes in the order of the string: the lateral branch before the main one.
    fn list(&self, depth: u32, all: &mut Vec<(u32, f64, f64)>) {
        all.push((depth, self.flux, self.apices));
        for next in self.fork.iter().flat_map(|fork| fork.iter()) {
            next.list(depth + 1, all);
        }
    }
}

/// The numbers of the modules of a letter in a word.
fn modules(word: &str, letter: char) -> Vec<Vec<f64>> {
    let parts = word.split(letter).skip(1).map(|rest| &rest[1..rest.find(')').unwrap()]);
    parts.map(|inside| inside.split(',').map(|number| number.parse().unwrap()).collect()).collect()
}

/// The depths of the internodes: each fork has the lateral branch in brackets, and the main one behind.
fn depths(word: &str) -> Vec<u32> {
    let (mut depth, mut saved, mut found) = (0, vec![], vec![]);
    for symbol in word.chars() {
        match symbol {
            'I' => {
                found.push(depth);
                depth += 1;
            }
            '[' => saved.push(depth),
            ']' => depth = saved.pop().unwrap(),
            _ => {}
        }
    }
    found
}

#[test]
fn the_flux_and_the_apices_are_those_of_a_direct_simulation() {
    let path = format!("{}/../../data_in/garden/tabebuia.json", env!("CARGO_MANIFEST_DIR"));
    let definition: Definition = read_file(&std::fs::read(path).unwrap()).definition.unwrap();
    let system = System::new(&definition).unwrap();
    let [first, growth, ..] = NUMBERS;
    let mut tree = Internode::new();
    let mut cycles = 0;
    for n in 0..=90 {
        let word = expand(&system, n, &Limits::default()).unwrap();
        let internodes = modules(&word, 'I');
        // The base knows the number of apices: a cycle is over.
        if internodes[0][1] != 2.0 {
            continue;
        }
        assert_eq!(modules(&word, 'N'), [[f64::from(cycles + 1)]], "step {n}");
        let mut expected = vec![];
        tree.list(0, &mut expected);
        let found: Vec<(u32, f64, f64)> =
            depths(&word).into_iter().zip(&internodes).map(|(depth, own)| (depth, own[2], own[3])).collect();
        assert_eq!(found.len(), expected.len(), "step {n}");
        for (a, b) in found.iter().zip(&expected) {
            assert!(a.0 == b.0 && a.2 == b.2, "step {n}: {a:?} {b:?}");
            assert!((a.1 - b.1).abs() <= 1e-9 * b.1.abs(), "step {n}: {a:?} {b:?}");
        }
        // What flows into a fork flows out of it: without loss.
        tree.take(first * libm::pow(2.0, f64::from(cycles) * growth));
        tree.count();
        cycles += 1;
    }
    assert!(cycles >= 9 && tree.apices > 100.0, "{cycles} cycles, {} apices", tree.apices);
}
