//! The words for the parts of a system, as keys of objects, names of variables and labels in running text.

/// A part of a system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Key {
    Axiom,
    /// All rules.
    Rules,
    /// One rule, whose predecessor may stand in the key.
    Rule,
    Angle,
    LeftAngle,
    RightAngle,
    Heading,
    Iterations,
    Name,
    /// By how much `>` and `<` change lengths.
    LengthFactor,
    Ignore,
    /// The length of a step, which changes only the size.
    Step,
    /// What symbols do.
    Meanings,
}

/// English first; then German, French and Spanish. Lower case, without blanks and signs.
const WORDS: [(Key, &[&str]); 13] = [
    (
        Key::Axiom,
        &[
            "axiom",
            "start",
            "initial",
            "initiator",
            "omega",
            "ω",
            "startstring",
            "startword",
            "startsymbol",
            "initialstring",
            "initialword",
            "initialstate",
            "initialsymbol",
            "initialsentence",
            "startsentence",
            "seed",
            "seedstring",
            "s0",
            "w0",
            "init",
            "startwort",
            "startzustand",
            "startsymbole",
            "axiome",
            "axiomas",
            "axioma",
            "motif",
            "inicio",
            "départ",
            "depart",
            "anfang",
            "mot initial",
            "motinitial",
        ],
    ),
    (
        Key::Rules,
        &[
            "rules",
            "productions",
            "ruleset",
            "productionrules",
            "rewriterules",
            "rewritingrules",
            "replacements",
            "replacementrules",
            "replace",
            "substitutions",
            "regeln",
            "ersetzungsregeln",
            "produktionen",
            "produktionsregeln",
            "règles",
            "regles",
            "règlesdeproduction",
            "reglas",
            "producciones",
            "transformations",
            "mapping",
            "rewrites",
        ],
    ),
    (Key::Rule, &["rule", "production", "regel", "produktion", "règle", "regle", "regla", "producción"]),
    (
        Key::Angle,
        &[
            "angle",
            "delta",
            "δ",
            "theta",
            "θ",
            "turnangle",
            "turningangle",
            "anglestep",
            "angledeg",
            "anglerad",
            "angledegrees",
            "angleindegrees",
            "angleradians",
            "angleincrement",
            "degrees",
            "turn",
            "rotationangle",
            "rotangle",
            "rotateangle",
            "branchangle",
            "branchingangle",
            "rotation",
            "winkel",
            "drehwinkel",
            "α",
            "φ",
            "phi",
            "ángulo",
            "angulo",
            "angled",
            "turnby",
            "alpha",
            "defaultangle",
        ],
    ),
    (Key::LeftAngle, &["leftangle", "angleleft", "linkerwinkel", "winkellinks", "anglegauche", "anguloizquierdo"]),
    (Key::RightAngle, &["rightangle", "angleright", "rechterwinkel", "winkelrechts", "angledroit", "anguloderecho"]),
    (
        Key::Heading,
        &[
            "heading",
            "startangle",
            "initialangle",
            "initialheading",
            "startheading",
            "startdirection",
            "initialdirection",
            "startwinkel",
            "startrichtung",
            "angleinitial",
            "anguloinicial",
            "startingangle",
            "orientation",
            "startrotation",
            "initialrotation",
        ],
    ),
    (
        Key::Iterations,
        &[
            "iterations",
            "iteration",
            "n",
            "depth",
            "generations",
            "generation",
            "order",
            "iters",
            "iter",
            "numiters",
            "numiter",
            "numiterations",
            "niter",
            "niterations",
            "numberofiterations",
            "recursion",
            "recursions",
            "recursionlevel",
            "recursiondepth",
            "gens",
            "gen",
            "numgenerations",
            "ngenerations",
            "maxiterations",
            "maxdepth",
            "derivationlength",
            "derivationsteps",
            "level",
            "levels",
            "steps",
            "stage",
            "stages",
            "iterationen",
            "schritte",
            "tiefe",
            "rekursionstiefe",
            "itérations",
            "profondeur",
            "étapes",
            "ordre",
            "iteraciones",
            "profundidad",
            "orden",
            "nsteps",
            "numsteps",
        ],
    ),
    (Key::Name, &["name", "title", "label", "id", "titel", "nom", "titre", "nombre"]),
    (
        Key::LengthFactor,
        &[
            "lengthfactor",
            "linelengthfactor",
            "lengthscale",
            "lengthscalefactor",
            "linelengthscale",
            "scalefactor",
            "lengthmultiplier",
            "längenfaktor",
        ],
    ),
    (Key::Ignore, &["ignore", "ignored", "ignoredsymbols"]),
    (
        Key::Step,
        &[
            "step",
            "steplength",
            "stepsize",
            "length",
            "linelength",
            "segmentlength",
            "len",
            "size",
            "distance",
            "schrittlänge",
            "länge",
            "longueur",
            "longitud",
            "linesize",
            "startlength",
        ],
    ),
    (
        Key::Meanings,
        &[
            "meanings",
            "meaning",
            "actions",
            "commands",
            "finals",
            "symbols",
            "interpretation",
            "drawing",
            "bedeutung",
            "significations",
            "draw",
            "instructions",
            "drawrules",
            "drawings",
        ],
    ),
];

/// The part that a key, a variable or a label names.
pub(super) fn key(name: &str) -> Option<Key> {
    let word: String = name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect();
    if let Some((key, _)) = WORDS.iter().find(|(_, words)| words.contains(&word.as_str())) {
        return Some(*key);
    }
    if word.len() > 30 {
        return None;
    }
    // Parts of longer names: `kochAxiom`, `axiom_text`, `num_rules` not.
    let counts =
        ["num", "count", "number", "max", "min", "is", "has", "total"].iter().any(|part| word.starts_with(part));
    if counts {
        return None;
    }
    let ends = |parts: &[&str]| parts.iter().any(|part| word.ends_with(part));
    if ends(&["axiom"]) || word.starts_with("axiom") {
        return Some(Key::Axiom);
    }
    if ends(&["productionrules", "rules", "productions"]) || word.starts_with("rules") && word.len() < 8 {
        return Some(Key::Rules);
    }
    let numbered = |stem: &str| {
        word.strip_prefix(stem).is_some_and(|rest| rest.chars().count() <= 2 && rest.chars().all(char::is_alphanumeric))
    };
    if numbered("rule") || numbered("production") || word.strip_suffix("rule").is_some_and(|rest| rest.len() == 1) {
        return Some(Key::Rule);
    }
    if ends(&["turnangle", "turningangle"]) {
        return Some(Key::Angle);
    }
    if ends(&["iterations", "generations"]) {
        return Some(Key::Iterations);
    }
    None
}

/// The letter of a key such as `ruleF`, `rule_a` or `F_rule`, as it stands there.
pub(super) fn letter_of(key: &str) -> Option<char> {
    let lower = key.to_ascii_lowercase();
    let stem = ["rules", "rule", "production"].iter().find(|stem| lower.starts_with(**stem));
    let rest = match stem {
        Some(stem) => key.get(stem.len()..)?,
        None => key.get(..lower.find("rule")?)?,
    };
    let mut letters = rest.trim_matches('_').chars();
    let letter = letters.next().filter(|letter| letter.is_alphabetic())?;
    letters.next().is_none().then_some(letter)
}
