//! The arrows between the rooms of a crate, which are its top-level modules: they form no large circles.

use std::collections::{BTreeMap, BTreeSet};

use chereme_tests::repository;
use regex::Regex;

/// The largest number of rooms that may use each other in a circle.
const MAX_ROOMS_IN_CIRCLE: usize = 3;

/// The rooms of a crate, each with the rooms that it uses, and a file that does.
type RoomArrows = BTreeMap<String, BTreeMap<String, String>>;

/// The source of one crate without tests and comments, by path within `src`.
type CrateSources = BTreeMap<String, String>;

fn sources_by_crate() -> BTreeMap<String, CrateSources> {
    let comment = Regex::new(r"(?m)//.*$").expect("a pattern");
    let tests = Regex::new(r"#\[cfg\([^\n]*\btest\b[^\n]*\)\]\n(?:#\[[^\n]*\]\n)*mod \w+ \{").expect("a pattern");
    let mut crates: BTreeMap<String, CrateSources> = BTreeMap::new();
    for file in repository::rust_files() {
        let within = file
            .path
            .strip_prefix("crates/")
            .and_then(|path| path.split_once("/src/"));
        let Some((name, path)) = within.filter(|_| !file.is_test() && !file.path.ends_with("_tests.rs")) else {
            continue;
        };
        let end = tests.find(&file.text).map_or(file.text.len(), |module| module.start());
        let code = comment.replace_all(&file.text[..end], "").into_owned();
        crates.entry(name.to_owned()).or_default().insert(path.to_owned(), code);
    }
    crates
}

fn room_of_path(path: &str) -> &str {
    let top = path.split('/').next().unwrap_or_default();
    top.strip_suffix(".rs").unwrap_or(top)
}

/// Returns the first names of the paths of a `use`, whose text begins with a name or a group in braces.
fn first_path_names(text: &str) -> Vec<&str> {
    let name = |part: &str| -> usize {
        part.find(|c: char| c != '_' && !c.is_alphanumeric())
            .unwrap_or(part.len())
    };
    let Some(group) = text.strip_prefix('{') else {
        return vec![&text[..name(text)]];
    };
    let (mut names, mut depth, mut starts) = (Vec::new(), 0_u32, true);
    for (index, letter) in group.char_indices() {
        match letter {
            '}' if depth == 0 => break,
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => starts = true,
            _ if starts && depth == 0 && !letter.is_whitespace() => {
                names.push(&group[index..index + name(&group[index..])]);
                starts = false;
            }
            _ => {}
        }
    }
    names
}

/// Returns the rooms by the names that the root of the crate gives to what lies in them.
fn names_given_by_root(root: &str) -> BTreeMap<&str, &str> {
    let export = Regex::new(r"pub(?:\([^)]*\))? use (\w+)(?:::\w+)*::(?:\{([^}]*)\}|(\w+));").expect("a pattern");
    let mut given = BTreeMap::new();
    for found in export.captures_iter(root) {
        let (_, [room, names]) = found.extract();
        let names = names.split(',').filter_map(|name| name.split_whitespace().last());
        given.extend(names.map(|name| (name, room)));
    }
    given
}

/// Returns the rooms that define methods of the type `Corpus`, by the names of the methods: a call of one is an arrow, too.
fn rooms_of_corpus_methods(sources: &CrateSources) -> BTreeMap<&str, &str> {
    let method = Regex::new(r"(?m)^    pub(?:\([^)]*\))? (?:const )?fn (\w+)").expect("a pattern");
    let mut rooms = BTreeMap::new();
    for (path, code) in sources {
        for block in code.split("\nimpl Corpus {\n").skip(1) {
            let block = block.split("\n}\n").next().unwrap_or_default();
            let names = method.captures_iter(block).map(|found| found.extract::<1>().1[0]);
            rooms.extend(names.map(|name| (name, room_of_path(path))));
        }
    }
    rooms
}

fn room_arrows(sources: &CrateSources) -> RoomArrows {
    let rooms: BTreeSet<&str> = sources.keys().map(|path| room_of_path(path)).collect();
    let root = ["lib.rs", "main.rs"].iter().find_map(|name| sources.get(*name));
    let given = names_given_by_root(root.map_or("", String::as_str));
    let methods = rooms_of_corpus_methods(sources);
    let call = Regex::new(r"\b(?:self|corpus)\s*\.(\w+)\(").expect("a pattern");
    let mut arrows = RoomArrows::new();
    for (path, code) in sources {
        let here = room_of_path(path);
        if ["lib", "main"].contains(&here) {
            continue;
        }
        let names = code.split("crate::").skip(1).flat_map(first_path_names);
        let used = names.filter_map(|name| rooms.get(name).or_else(|| given.get(name)).copied());
        let called = call.captures_iter(code).map(|found| found.extract::<1>().1[0]);
        let called = called.filter_map(|name| methods.get(name).copied());
        let arrow = arrows.entry(here.to_owned()).or_default();
        for room in used.chain(called) {
            if room != here && !["lib", "main"].contains(&room) {
                arrow.entry(room.to_owned()).or_insert_with(|| path.clone());
            }
        }
    }
    arrows
}

/// Returns the rooms that can be reached from a room.
fn rooms_reached<'a>(arrows: &'a RoomArrows, from: &str) -> BTreeSet<&'a str> {
    let mut reached = BTreeSet::new();
    let mut waiting: Vec<&str> = vec![from];
    while let Some(room) = waiting.pop() {
        for next in arrows.get(room).into_iter().flat_map(BTreeMap::keys) {
            if reached.insert(next.as_str()) {
                waiting.push(next);
            }
        }
    }
    reached
}

/// Returns the circles of more than one room.
fn room_circles(arrows: &RoomArrows) -> BTreeSet<BTreeSet<&str>> {
    let reached: BTreeMap<&str, BTreeSet<&str>> = arrows
        .keys()
        .map(|room| (room.as_str(), rooms_reached(arrows, room)))
        .collect();
    let in_circle = reached.iter().filter(|(room, after)| after.contains(*room));
    let circles = in_circle.map(|(room, after)| {
        let back = |other: &&&str| reached.get(**other).is_some_and(|onward| onward.contains(room));
        after.iter().filter(back).copied().collect()
    });
    circles.collect()
}

#[test]
fn rooms_form_no_large_circles() {
    let mut faults = Vec::new();
    for (name, sources) in sources_by_crate() {
        let arrows = room_arrows(&sources);
        let circles = room_circles(&arrows);
        let is_large = |circle: &&BTreeSet<&str>| circle.len() > MAX_ROOMS_IN_CIRCLE;
        let large = circles.iter().find(is_large);
        for (from, to) in large
            .into_iter()
            .flat_map(|circle| circle.iter().map(move |room| (*room, circle)))
        {
            for (room, file) in arrows[from].iter().filter(|(room, _)| to.contains(room.as_str())) {
                faults.push(format!(
                    "{name}: {from} uses {room} (in {file}), and {room} comes back to {from}"
                ));
            }
        }
    }
    assert!(
        faults.is_empty(),
        "move an item to the room where it belongs:\n{}",
        faults.join("\n")
    );
}

/// The guide of the corpus, in which a table lists its rooms from the lowest to the highest.
const CORPUS_GUIDE: &str = "crates/chereme-corpus/README.md";

#[test]
fn rooms_of_the_corpus_use_none_above_their_line_in_the_guide() {
    let guide = repository::text_files()
        .into_iter()
        .find(|file| file.path == CORPUS_GUIDE);
    let guide = guide.expect("the guide of the corpus").text;
    let table = guide.split("| rooms | hold |\n").nth(1).expect("the table of rooms");
    let mut lines: BTreeMap<&str, usize> = BTreeMap::new();
    for (number, line) in table.lines().take_while(|line| line.starts_with('|')).enumerate() {
        let rooms = line.split('|').nth(1).unwrap_or_default();
        lines.extend(rooms.split('`').skip(1).step_by(2).map(|room| (room, number)));
    }
    let sources = sources_by_crate().remove("chereme-corpus").expect("the corpus");
    let mut faults = Vec::new();
    for (from, arrows) in room_arrows(&sources) {
        let Some(line) = lines.get(from.as_str()) else {
            faults.push(format!("{from} is missing in the table of {CORPUS_GUIDE}"));
            continue;
        };
        let above = arrows.iter().filter(|(room, _)| lines.get(room.as_str()) > Some(line));
        faults.extend(above.map(|(room, file)| format!("{from} uses {room}, which stands above it (in {file})")));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn arrows_are_found_in_paths_exports_and_methods() {
    let mut sources = CrateSources::new();
    for (path, code) in [
        ("lib.rs", "pub use low::{Grain, Flour as Dust};\n"),
        ("low.rs", "use crate::{high::{a, b}, middle};\n"),
        ("middle.rs", "fn f() { crate::Dust::new(); }\n"),
        (
            "high/inner.rs",
            "\nimpl Corpus {\n    pub fn grind_grain(&self) {}\n}\n",
        ),
        ("side.rs", "fn g(corpus: &Corpus) { corpus.grind_grain(); }\n"),
    ] {
        sources.insert(path.to_owned(), code.to_owned());
    }
    let arrows = room_arrows(&sources);
    let used = |room: &str| arrows[room].keys().map(String::as_str).collect::<Vec<_>>();
    assert_eq!(used("low"), ["high", "middle"]);
    assert_eq!(used("middle"), ["low"]);
    assert_eq!(used("side"), ["high"]);
    assert_eq!(
        room_circles(&arrows),
        BTreeSet::from([BTreeSet::from(["low", "middle"])])
    );
}
