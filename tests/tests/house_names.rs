//! Names that a stranger finds with grep: shares of names of one word and of names with several owners, over the whole house and crate by crate.

use std::collections::{BTreeMap, BTreeSet};

use chereme_tests::repository;
use regex::Regex;

/// Names that traits of the standard library and the usual form of Rust ask for.
const USUAL_NAMES: [&str; 29] = [
    "new",
    "fmt",
    "default",
    "from",
    "eq",
    "ui",
    "next",
    "from_str",
    "hash",
    "cmp",
    "partial_cmp",
    "drop",
    "into",
    "clone",
    "run",
    "main",
    "deref",
    "serialize",
    "deserialize",
    "try_from",
    "as_ref",
    "borrow",
    "index",
    "len",
    "is_empty",
    "iter",
    "visit_str",
    "expecting",
    "source",
];

/// File names that each folder may have.
const SHARED_FILE_NAMES: [&str; 4] = ["mod.rs", "lib.rs", "main.rs", "error.rs"];

/// The measures, each with its largest value over the whole house.
const LIMITS: [(&str, f64); 10] = [
    ("functions and types of one word, in percent", 45.0),
    ("types owned twice or more, in percent", 5.0),
    ("functions with four owners or more, in percent", 30.0),
    ("constants of one word, in percent", 30.0),
    ("constants with three owners or more, in percent", 15.0),
    ("files of one name, in percent", 25.0),
    ("parameters that are tuples", 20.0),
    ("names bound again at once, in each thousand lines", 0.8),
    ("locals that are no nouns, in each thousand lines", 1.0),
    ("closures over `it`, in each thousand lines", 0.5),
];

/// The largest share of functions, types and constants of one word in a crate, in percent.
const MAX_CRATE_SHARE: f64 = 45.0;

/// The names of a part of the house and how often each is given, and its lines.
#[derive(Default)]
struct NameCounts {
    functions: BTreeMap<String, usize>,
    types: BTreeMap<String, usize>,
    constants: BTreeMap<String, usize>,
    files: BTreeMap<String, usize>,
    code_lines: usize,
    tuple_parameters: usize,
    names_bound_again: usize,
    odd_locals: usize,
    closures_over_it: usize,
}

/// The patterns that find names in Rust source.
struct NamePatterns {
    function: Regex,
    type_name: Regex,
    constant: Regex,
    tuple_parameter: Regex,
    binding: Regex,
    odd_local: Regex,
    closure_over_it: Regex,
}

impl NamePatterns {
    fn new() -> Self {
        let pattern = |text: &str| Regex::new(text).expect("a pattern");
        Self {
            function: pattern(r"\bfn (\w+)"),
            type_name: pattern(r"\b(?:struct|enum|trait|union) (\w+)"),
            constant: pattern(r"\b(?:const|static) ([A-Z]\w*):"),
            tuple_parameter: pattern(r"[(,]\s*\((?:mut |&|\w|, |_)+\): \("),
            binding: pattern(r"(?m)^\s*let (?:mut )?(\w+)(?:: [^=\n]+)? = [^;]*;\n"),
            odd_local: pattern(
                r"\blet (?:mut )?(?:at|own|found|known|said|told|held|meant|heard|laid|hung|got|want|whole|beside|again)\b",
            ),
            closure_over_it: pattern(r"\|(?:&|\(|mut )*it\b"),
        }
    }

    /// Returns how many bindings are followed by a binding of the same name.
    fn count_names_bound_again(&self, source: &str) -> usize {
        let mut count = 0;
        for binding in self.binding.captures_iter(source) {
            let end = binding.get(0).map_or(0, |all| all.end());
            let next_line = source[end..].trim_start();
            let next_name = next_line.strip_prefix("let ").map(|name| {
                let name = name.strip_prefix("mut ").unwrap_or(name);
                name.split(|c: char| c != '_' && !c.is_alphanumeric())
                    .next()
                    .unwrap_or("")
            });
            count += usize::from(next_name == Some(&binding[1]));
        }
        count
    }
}

impl NameCounts {
    /// Counts the names of a file.
    fn add_file(&mut self, patterns: &NamePatterns, path: &str, source: &str) {
        let add = |names: &mut BTreeMap<String, usize>, pattern: &Regex| {
            for name in pattern.captures_iter(source) {
                *names.entry(name[1].to_owned()).or_default() += 1;
            }
        };
        add(&mut self.functions, &patterns.function);
        add(&mut self.types, &patterns.type_name);
        add(&mut self.constants, &patterns.constant);
        let file_name = path.rsplit('/').next().unwrap_or(path);
        *self.files.entry(file_name.to_owned()).or_default() += 1;
        let is_code = |line: &&str| !line.trim().is_empty() && !line.trim().starts_with("//");
        self.code_lines += source.lines().filter(is_code).count();
        self.tuple_parameters += patterns.tuple_parameter.find_iter(source).count();
        self.names_bound_again += patterns.count_names_bound_again(source);
        self.odd_locals += patterns.odd_local.find_iter(source).count();
        self.closures_over_it += patterns.closure_over_it.find_iter(source).count();
    }

    /// Returns the measures in the order of [`LIMITS`].
    fn measures(&self) -> [f64; LIMITS.len()] {
        let is_usual = |name: &str| USUAL_NAMES.contains(&name);
        let all_functions: usize = self.functions.values().sum();
        let shared_functions = self.functions.iter();
        let shared_functions = shared_functions.filter(|(name, count)| **count >= 4 && !is_usual(name));
        let types_twice = self.types.values().filter(|count| **count > 1).count();
        let shared_constants = self.constants.values().filter(|count| **count >= 3);
        let shared_files = self
            .files
            .iter()
            .filter(|(name, count)| **count > 1 && !SHARED_FILE_NAMES.contains(&name.as_str()));
        let in_each_thousand = |count: usize| 1000.0 * count as f64 / self.code_lines.max(1) as f64;
        [
            self.one_word_names(),
            percent(types_twice, self.types.len()),
            percent(shared_functions.map(|(_, count)| count).sum(), all_functions),
            one_word_share(self.constants.iter()),
            percent(shared_constants.sum(), self.constants.values().sum()),
            percent(shared_files.map(|(_, count)| count).sum(), self.files.values().sum()),
            self.tuple_parameters as f64,
            in_each_thousand(self.names_bound_again),
            in_each_thousand(self.odd_locals),
            in_each_thousand(self.closures_over_it),
        ]
    }

    /// Returns the share of functions and types with a name of one word, in percent.
    fn one_word_names(&self) -> f64 {
        one_word_share(self.functions.iter().chain(&self.types))
    }
}

fn percent(part: usize, whole: usize) -> f64 {
    100.0 * part as f64 / whole.max(1) as f64
}

/// Returns the share of names of one word among those that are free to choose, in percent.
fn one_word_share<'a>(names: impl Iterator<Item = (&'a String, &'a usize)>) -> f64 {
    let (mut one_word, mut all) = (0, 0);
    for (name, count) in names.filter(|(name, _)| !USUAL_NAMES.contains(&name.as_str())) {
        all += count;
        one_word += if count_words(name) == 1 { *count } else { 0 };
    }
    percent(one_word, all)
}

/// Returns the number of words in a name of Rust.
fn count_words(name: &str) -> usize {
    name.split('_')
        .map(|part| {
            let letters: Vec<char> = part.chars().collect();
            let inner = letters
                .windows(2)
                .filter(|pair| !pair[0].is_uppercase() && pair[0].is_alphanumeric() && pair[1].is_uppercase());
            usize::from(!letters.is_empty()) + inner.count()
        })
        .sum()
}

/// Returns the names of each crate, and of all of them together, without tests.
fn count_house_names() -> (BTreeMap<String, NameCounts>, NameCounts) {
    let patterns = NamePatterns::new();
    let (mut crates, mut house) = (BTreeMap::<String, NameCounts>::new(), NameCounts::default());
    for file in repository::rust_files() {
        let Some(rest) = file.path.strip_prefix("crates/") else {
            continue;
        };
        let Some((crate_name, inside)) = rest.split_once('/') else {
            continue;
        };
        let file_name = inside.rsplit('/').next().unwrap_or(inside);
        let is_test = inside.contains("/tests/")
            || file_name == "tests.rs"
            || file_name == "testing.rs"
            || file_name.ends_with("_tests.rs");
        if !inside.starts_with("src/") || is_test {
            continue;
        }
        let source = file.text.split("#[cfg(test)]\nmod tests {").next().unwrap_or("");
        let names = crates.entry(crate_name.to_owned()).or_default();
        names.add_file(&patterns, inside, source);
        house.add_file(&patterns, inside, source);
    }
    (crates, house)
}

#[test]
fn names_of_the_house_are_found_with_grep() {
    let (crates, house) = count_house_names();
    assert!(crates.len() >= 9, "{:?}", crates.keys());
    let mut faults = Vec::new();
    for ((what, limit), value) in LIMITS.iter().zip(house.measures()) {
        if value > *limit {
            faults.push(format!("{what}: {value:.2}, at most {limit}"));
        }
    }
    for (crate_name, names) in &crates {
        let constants = one_word_share(names.constants.iter());
        for (what, value) in [("names", names.one_word_names()), ("constants", constants)] {
            if value > MAX_CRATE_SHARE {
                let message = format!("{crate_name}: {what} of one word: {value:.1} %, at most {MAX_CRATE_SHARE}");
                faults.push(message);
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn words_are_counted_as_a_reader_counts_them() {
    for (name, count) in [
        ("of", 1),
        ("place_wrist", 2),
        ("Hung", 1),
        ("AdaptedHand", 2),
        ("MAX_REPORTED_IDS", 3),
        ("_unused", 1),
        ("to_4x4", 2),
        ("Vec3", 1),
    ] {
        assert_eq!(count_words(name), count, "{name}");
    }
    let patterns = NamePatterns::new();
    let mut names = NameCounts::default();
    names.add_file(
        &patterns,
        "src/a.rs",
        "fn of((a, b): (u8, u8)) {\n    let rows = 1;\n    let rows = rows;\n    let at = |it| it;\n}\nconst MOST: u8 = 1;\nstruct Hung;\n",
    );
    assert_eq!(names.functions.keys().collect::<Vec<_>>(), ["of"]);
    assert_eq!(
        names.types.keys().collect::<BTreeSet<_>>(),
        BTreeSet::from([&"Hung".to_owned()])
    );
    let counts = (
        names.tuple_parameters,
        names.names_bound_again,
        names.odd_locals,
        names.closures_over_it,
    );
    assert_eq!(counts, (1, 1, 1, 1));
    assert_eq!(names.one_word_names(), 100.0);
}
