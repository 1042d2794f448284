//! The arrows between the crates, and what comes from outside: read from `cargo metadata`.

use std::collections::BTreeSet;
use std::process::Command;

use chereme_tests::repository;
use serde_json::Value;

/// Every crate of the workspace, with the crates of the workspace that it may depend on.
const ARROWS: [(&str, &[&str]); 11] = [
    ("chereme-data", &[]),
    ("chereme-motion", &[]),
    ("chereme-sign", &["data", "motion"]),
    ("chereme-formats", &["data", "motion", "sign"]),
    ("chereme-analysis", &["motion", "sign"]),
    ("chereme-compose", &["motion", "sign"]),
    ("chereme-figure", &["motion"]),
    (
        "chereme-corpus",
        &["data", "motion", "sign", "formats", "analysis", "compose", "figure"],
    ),
    ("chereme-studio", &["data", "motion", "sign", "figure", "corpus"]),
    ("chereme-cli", &["motion", "sign", "figure", "corpus"]),
    (
        "chereme-tests",
        &[
            "data", "motion", "sign", "formats", "analysis", "compose", "figure", "corpus",
        ],
    ),
];

/// Crates from outside that would bring in what a crate must never know: crate, and why.
const NEVER: [(&str, &[&str], &str); 11] = [
    ("rusqlite", &["chereme-corpus"], "SQL lives in the corpus"),
    ("tantivy", &["chereme-corpus"], "the search index lives in the corpus"),
    (
        "rusty_h264",
        &["chereme-corpus"],
        "films are decoded and coded behind the door of the corpus",
    ),
    ("clap", &["chereme-cli"], "only the terminal skin reads arguments"),
    ("indicatif", &["chereme-cli"], "only the terminal skin shows progress"),
    (
        "anyhow",
        &["chereme-cli", "chereme-studio"],
        "libraries have typed errors",
    ),
    ("rand", &[], "movement is made without unseeded randomness"),
    (
        "bvh_anim",
        &[],
        "the oracle of the tests and the peer of the benchmark only",
    ),
    ("bindgen", &[], "building needs no libclang"),
    ("eframe", &["chereme-studio"], "only the window skin knows a window"),
    ("wgpu", &["chereme-studio"], "only the window skin knows a GPU"),
];

/// Licences under which a crate may come in.
const LICENCES: [&str; 16] = [
    "0BSD",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "CC0-1.0",
    "ISC",
    "MIT",
    "MIT-0",
    "OFL-1.1",
    "Ubuntu-font-1.0",
    "Unicode-3.0",
    "Unicode-DFS-2016",
    "Unlicense",
    "Zlib",
];

/// Crates that name no licence but carry its text, which was read: crate, licence.
const READ: [(&str, &str); 1] = [("dtw_rs", "MIT")];

fn metadata(arguments: &[&str]) -> Result<Value, String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args(["metadata", "--offline", "--format-version", "1"])
        .args(arguments)
        .current_dir(repository::root())
        .output()
        .map_err(|error| error.to_string())?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    serde_json::from_slice(&output.stdout).map_err(|error| error.to_string())
}

fn list<'a>(value: &'a Value, key: &str) -> &'a [Value] {
    value[key].as_array().map_or(&[], Vec::as_slice)
}

fn text<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap_or_default()
}

/// The dependencies of a crate without those of its tests.
fn dependencies(package: &Value) -> impl Iterator<Item = &str> {
    list(package, "dependencies")
        .iter()
        .filter(|it| it["kind"].as_str() != Some("dev"))
        .map(|it| text(it, "name"))
}

#[test]
fn crates_depend_only_on_those_that_the_design_allows() {
    let workspace = metadata(&["--no-deps"]).expect("cargo metadata");
    let mut faults = Vec::new();
    for package in list(&workspace, "packages") {
        let name = text(package, "name");
        let Some((_, allowed)) = ARROWS.iter().find(|(known, _)| *known == name) else {
            faults.push(format!(
                "{name} is a crate more than the house has; it needs a reason of the kind \"X must not \
                 be able to know Y\", and a line here"
            ));
            continue;
        };
        for dependency in dependencies(package) {
            let own = dependency.strip_prefix("chereme-");
            if own.is_some_and(|own| !allowed.contains(&own)) {
                faults.push(format!("{name} must not know {dependency}"));
            }
            let never = NEVER.iter().find(|(outside, ..)| *outside == dependency);
            if let Some((outside, rooms, why)) = never
                && !rooms.contains(&name)
            {
                faults.push(format!("{name} must not know {outside}: {why}"));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn no_crate_embeds_a_file_outside_its_folder() {
    let mut faults = Vec::new();
    for file in repository::rust_files() {
        // Tests are not packaged alone.
        if file.is_test() || file.path.ends_with("_tests.rs") || !file.path.starts_with("crates/") {
            continue;
        }
        let depth = file.path.split('/').count() - 3;
        for (line, text) in file.code() {
            let includes = ["include_str!(\"", "include_bytes!(\"", "include!(\""];
            let mut paths = includes.iter().flat_map(|name| text.split(name).skip(1));
            if paths.any(|path| path.split('"').next().unwrap_or_default().matches("../").count() > depth)
                || text.contains("CARGO_MANIFEST_DIR")
            {
                faults.push(format!("{}, line {line}: {}", file.path, text.trim()));
            }
        }
    }
    assert!(faults.is_empty(), "take it from chereme-data: {faults:#?}");
}

#[test]
fn every_crate_has_the_version_of_the_workspace() {
    let workspace = metadata(&["--no-deps"]).expect("cargo metadata");
    let packages = list(&workspace, "packages");
    let version = text(&packages[0], "version");
    for package in packages {
        let name = text(package, "name");
        assert_eq!(text(package, "version"), version, "{name}");
        for dependency in list(package, "dependencies") {
            let other = text(dependency, "name");
            let wanted = text(dependency, "req");
            // The crate of tests is never packaged with another one.
            let is_own = other.starts_with("chereme-") && other != "chereme-tests";
            assert!(
                !is_own || wanted == format!("^{version}"),
                "{name} wants {other} {wanted}"
            );
        }
    }
}

#[test]
fn tests_reach_no_higher_than_their_crate() {
    let workspace = metadata(&["--no-deps"]).expect("cargo metadata");
    for package in list(&workspace, "packages") {
        let name = text(package, "name");
        let above: &[&str] = match name {
            "chereme-tests" | "chereme-cli" | "chereme-studio" => &[],
            _ => &["chereme-corpus", "chereme-cli", "chereme-studio"],
        };
        for dependency in list(package, "dependencies") {
            let other = text(dependency, "name");
            assert!(
                !above.contains(&other) || other == name,
                "{name}'s tests need {other}: put them into tests/, which may know every crate"
            );
        }
    }
}

#[test]
fn every_dependency_has_an_accepted_licence() {
    let all = metadata(&[]).or_else(|_| {
        let output = Command::new("rustc").arg("-vV").output().map_err(|e| e.to_string())?;
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        let host = said.lines().find_map(|line| line.strip_prefix("host: "));
        metadata(&["--filter-platform", host.unwrap_or_default()])
    });
    let all = all.expect("cargo metadata of all crates; `cargo fetch` brings them");
    let mut faults = BTreeSet::new();
    for package in list(&all, "packages") {
        let (name, licence) = (text(package, "name"), text(package, "license"));
        let read = READ.iter().any(|(known, _)| *known == name) && licence.is_empty();
        if !read && !allows(licence) {
            let version = text(package, "version");
            faults.insert(format!("{name} {version} comes under {licence:?}"));
        }
    }
    let faults: Vec<String> = faults.into_iter().collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Returns whether an SPDX expression can be met with the licences of the list.
fn allows(expression: &str) -> bool {
    let expression = expression.replace('/', " OR ");
    let expression = expression.replace('(', " ( ").replace(')', " ) ");
    let words: Vec<&str> = expression.split_whitespace().collect();
    let (met, rest) = either(&words);
    met && rest.is_empty()
}

fn either<'a>(words: &'a [&'a str]) -> (bool, &'a [&'a str]) {
    let (mut met, mut rest) = both(words);
    while let ["OR", after @ ..] = rest {
        let (other, after) = both(after);
        (met, rest) = (met || other, after);
    }
    (met, rest)
}

fn both<'a>(words: &'a [&'a str]) -> (bool, &'a [&'a str]) {
    let (mut met, mut rest) = one(words);
    while let ["AND", after @ ..] = rest {
        let (other, after) = one(after);
        (met, rest) = (met && other, after);
    }
    (met, rest)
}

fn one<'a>(words: &'a [&'a str]) -> (bool, &'a [&'a str]) {
    match words {
        ["(", rest @ ..] => match either(rest) {
            (met, [")", rest @ ..]) => (met, rest),
            (_, rest) => (false, rest),
        },
        [licence, "WITH", exception, rest @ ..] => {
            let whole = format!("{licence} WITH {exception}");
            (LICENCES.contains(&whole.as_str()), rest)
        }
        [licence, rest @ ..] => (LICENCES.contains(licence), rest),
        [] => (false, words),
    }
}

#[test]
fn licence_expressions_are_evaluated_correctly() {
    for (expression, want) in [
        ("MIT", true),
        ("MIT/Apache-2.0", true),
        ("GPL-3.0", false),
        ("GPL-3.0 OR MIT", true),
        ("GPL-3.0 AND MIT", false),
        ("(MIT OR GPL-3.0) AND Unicode-3.0", true),
        ("(MIT OR Apache-2.0) AND GPL-2.0", false),
        ("Apache-2.0 WITH LLVM-exception OR GPL-2.0", true),
        ("GPL-2.0 WITH Classpath-exception-2.0", false),
        ("Apache-2.0 / MIT / MPL-2.0", true),
        ("", false),
        ("(MIT", false),
    ] {
        assert_eq!(allows(expression), want, "{expression}");
    }
}

/// The modules of the corpus that its database module may use. `words` has what an operation did, which the history stores.
const BELOW_THE_DATABASE: [&str; 4] = ["db", "error", "progress", "words"];

/// Returns the code of a file without the tests at its end.
fn code(text: &str) -> &str {
    let marks = text.match_indices("#[cfg(test)]\nmod ");
    let mut test_starts = marks.filter(|(at, _)| text[*at..].lines().nth(1).is_some_and(|line| line.ends_with('{')));
    test_starts.next().map_or(text, |(at, _)| &text[..at])
}

#[test]
fn the_database_module_depends_on_nothing_above_it() {
    let mut files = repository::rust_files();
    files.retain(|file| file.path.starts_with("crates/chereme-corpus/src/db/"));
    assert!(files.len() > 20, "{} files of the database", files.len());
    let mut faults = Vec::new();
    for file in &files {
        for part in code(&file.text).split("crate::").skip(1) {
            let module: String = part.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
            let own = module.chars().next().is_some_and(char::is_lowercase);
            if own && !BELOW_THE_DATABASE.contains(&module.as_str()) {
                faults.push(format!("{} uses crate::{module}", file.path));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn the_search_engine_is_named_in_one_folder() {
    let room = "crates/chereme-corpus/src/search/index/";
    let files = repository::rust_files();
    let named = |file: &&repository::TextFile| code(&file.text).contains("tantivy::");
    let (inside, outside): (Vec<_>, Vec<_>) = files
        .iter()
        .filter(named)
        .map(|file| file.path.as_str())
        .filter(|path| path.starts_with("crates/chereme-") && path.contains("/src/"))
        .partition(|path| path.starts_with(room));
    assert!(!inside.is_empty(), "the engine has moved");
    assert!(outside.is_empty(), "{outside:?}");
}
