//! The book for users: each chapter is listed, each link leads somewhere, each command does what its chapter shows.
//!
//! A block `sh` is a script. A block `console` holds commands after `$ `, and below each one what it prints; a line that
//! begins with `> ` continues the command above. Output is compared if a chapter shows any of it: a line `…` stands for
//! any lines, and `…` within a line for any letters. A command that must fail ends in `# exit code 1`.
//!
//! Every chapter has a folder of its own. A chapter that names the folder `chereme-demo` and does not make it finds
//! there the starter files and the corpus that `chereme demo` writes in the tutorial.

mod book_calls;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use book_calls::{chapter_calls, fenced_blocks};
#[cfg(unix)]
use chereme_corpus::{Corpus, SearchOptions};
use chereme_tests::repository;

/// Words that ask a reader to hear something.
const WORDS_OF_HEARING: [&str; 16] = [
    "audible",
    "deafening",
    "echo",
    "echoes",
    "hear",
    "heard",
    "hears",
    "listen",
    "listens",
    "loud",
    "loudly",
    "quiet",
    "quietly",
    "silence",
    "silent",
    "silently",
];

/// The corpus that the tutorial leaves.
#[cfg(unix)]
const DEMO_CORPUS: &str = "chereme-demo/starter.chereme";

/// A page of the book.
struct Chapter {
    /// The path from the folder `src`, with `/`.
    name: String,
    text: String,
}

fn book_folder() -> PathBuf {
    repository::root().join("crates/chereme-cli/book/src")
}

fn book_chapters() -> Vec<Chapter> {
    let folder = "crates/chereme-cli/book/src/";
    let files = repository::text_files();
    let chapters: Vec<Chapter> = files
        .into_iter()
        .filter_map(|file| {
            let name = file.path.strip_prefix(folder)?.to_owned();
            (name.ends_with(".md") && name != "SUMMARY.md").then_some(Chapter { name, text: file.text })
        })
        .collect();
    assert!(chapters.len() > 20, "{} chapters", chapters.len());
    chapters
}

fn chapter_text(name: &str) -> String {
    fs::read_to_string(book_folder().join(name)).expect(name)
}

fn expect_none(what: &str, faults: &[String]) {
    assert!(faults.is_empty(), "{what}:\n{}", faults.join("\n"));
}

/// Returns the text without fenced blocks and without code between backquotes.
fn prose_text(text: &str) -> String {
    let mut open = false;
    let lines = text.lines().filter(|line| {
        let fence = line.trim_start().starts_with("```");
        open ^= fence;
        !open && !fence
    });
    let joined = lines.collect::<Vec<_>>().join("\n");
    joined.split('`').step_by(2).collect::<Vec<_>>().join("x")
}

/// Returns the targets of the links and pictures of a page.
fn link_targets(text: &str) -> Vec<String> {
    let prose = prose_text(text);
    let parts = prose.split("](").skip(1);
    parts
        .filter_map(|part| Some(part.split_once(')')?.0.to_owned()))
        .collect()
}

/// Returns the name that mdBook and GitHub give a heading in addresses.
fn heading_anchor(heading: &str) -> String {
    let kept = heading.trim().chars().filter_map(|c| match c {
        ' ' | '-' => Some('-'),
        c if c.is_alphanumeric() || c == '_' => Some(c.to_ascii_lowercase()),
        _ => None,
    });
    kept.collect()
}

fn has_heading(text: &str, anchor: &str) -> bool {
    let mut open = false;
    text.lines().any(|line| {
        open ^= line.starts_with("```");
        !open && line.starts_with('#') && heading_anchor(line.trim_start_matches('#')) == anchor
    })
}

/// Returns the cells of the tables of a page, row by row, without titles.
fn table_rows(text: &str) -> Vec<Vec<String>> {
    let rows = text.lines().filter(|line| line.starts_with("| "));
    let cells = rows.map(|row| {
        let row = row.replace("\\|", "\u{0}");
        let cells = row.trim_matches('|').split('|');
        cells.map(|cell| cell.trim().replace('\u{0}', "|")).collect()
    });
    cells.collect()
}

/// Returns the code between backquotes.
fn code_words(text: &str) -> Vec<String> {
    text.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

/// Returns the names in the list of commands that a help text shows.
fn listed_commands(help: &str) -> Vec<String> {
    let lines = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let lines = lines.take_while(|line| !line.is_empty());
    let names = lines.filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    names
        .filter(|name| !name.is_empty() && *name != "help")
        .map(str::to_owned)
        .collect()
}

fn program_output(words: &[&str]) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let mut command = book_calls::program_command("chereme", folder.path());
    let output = command.args(words).output().expect("the program runs");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn every_chapter_is_listed_once() {
    let summary = chapter_text("SUMMARY.md");
    let listed = link_targets(&summary);
    let unique: BTreeSet<&String> = listed.iter().collect();
    assert_eq!(unique.len(), listed.len(), "a chapter is listed twice");
    let written: BTreeSet<String> = book_chapters().into_iter().map(|chapter| chapter.name).collect();
    assert_eq!(listed.into_iter().collect::<BTreeSet<_>>(), written);
}

#[test]
fn every_link_leads_somewhere() {
    let mut faults = Vec::new();
    for chapter in book_chapters() {
        let path = book_folder().join(&chapter.name);
        for target in link_targets(&chapter.text) {
            if target.starts_with("https://") {
                continue;
            }
            let (file, anchor) = target.split_once('#').unwrap_or((&target, ""));
            let to = match file {
                "" => path.clone(),
                file => path.parent().unwrap_or(Path::new("")).join(file),
            };
            let text = fs::read_to_string(&to).unwrap_or_default();
            if !to.exists() || !anchor.is_empty() && !has_heading(&text, anchor) {
                faults.push(format!("{}: {target}", chapter.name));
            }
        }
    }
    expect_none("links without a target", &faults);
}

#[test]
fn nothing_in_the_book_is_to_be_heard() {
    let mut faults = Vec::new();
    for chapter in book_chapters() {
        let prose = prose_text(&chapter.text).to_lowercase();
        let words = prose.split(|c: char| !c.is_alphanumeric());
        let found = words.filter(|word| WORDS_OF_HEARING.contains(word));
        faults.extend(found.map(|word| format!("{}: {word}", chapter.name)));
    }
    expect_none("words of hearing", &faults);
}

#[test]
fn the_reference_names_every_command_and_action() {
    let page = chapter_text("reference/commands.md");
    let named: BTreeSet<String> = code_words(&page).into_iter().collect();
    let commands = listed_commands(&program_output(&["--help"]));
    assert!(commands.len() > 40, "{commands:?}");
    let mut missing = Vec::new();
    for command in &commands {
        let help = program_output(&[command, "--help"]);
        let actions = listed_commands(&help)
            .into_iter()
            .map(|action| format!("{command} {action}"));
        missing.extend(
            std::iter::once(command.clone())
                .chain(actions)
                .filter(|name| !named.contains(name)),
        );
    }
    expect_none("commands that the reference does not name", &missing);
    let rows = table_rows(&page);
    let first = rows.iter().flat_map(|cells| code_words(&cells[0]));
    let unknown: Vec<String> = first.filter(|name| !commands.contains(name)).collect();
    expect_none("commands that do not exist", &unknown);
}

#[test]
fn the_reference_names_every_operator_of_recipes() {
    let help = program_output(&["recombine", "--help"]);
    let operators = help.lines().skip_while(|line| !line.starts_with("Operators:")).skip(1);
    let operators: BTreeSet<&str> = operators
        .take_while(|line| !line.is_empty())
        .filter_map(|line| line.strip_prefix("  ")?.split(' ').next())
        .filter(|name| !name.is_empty())
        .collect();
    assert!(operators.len() > 10, "{operators:?}");
    let page = chapter_text("reference/recipes.md");
    let rows = table_rows(&page);
    let named: BTreeSet<String> = rows.iter().flat_map(|cells| code_words(&cells[0])).collect();
    let missing: Vec<String> = operators
        .into_iter()
        .filter(|name| !named.contains(*name))
        .map(str::to_owned)
        .collect();
    expect_none("operators that the reference does not name", &missing);
}

/// Asks the queries in the tables of the reference, and returns those that find another number of tokens.
#[cfg(unix)]
fn query_faults(folder: &Path) -> Vec<String> {
    let mut corpus = Corpus::open_corpus(&folder.join(DEMO_CORPUS), "reader").expect("the corpus of the demo");
    let options = SearchOptions::default();
    let (mut queries, mut faults) = (0, Vec::new());
    for cells in table_rows(&chapter_text("reference/query-language.md")) {
        let total = cells.last().and_then(|cell| cell.parse::<usize>().ok());
        let (Some(query), Some(total)) = (code_words(&cells[0]).pop(), total) else {
            continue;
        };
        queries += 1;
        let found = corpus.search_tokens(&query, &options).map(|answer| answer.total);
        if !found.as_ref().is_ok_and(|found| *found == total) {
            faults.push(format!("reference/query-language.md: {query} finds {found:?}"));
        }
    }
    assert!(queries > 20, "{queries} queries");
    faults
}

/// Evaluates the recipes in the tables of the reference, and returns those that fail.
#[cfg(unix)]
fn recipe_faults(folder: &Path) -> Vec<String> {
    let (mut recipes, mut faults) = (0, Vec::new());
    for cells in table_rows(&chapter_text("reference/recipes.md")) {
        let Some(recipe) = cells.get(1).and_then(|cell| code_words(cell).pop()) else {
            continue;
        };
        recipes += 1;
        let mut command = book_calls::program_command("chereme", folder);
        let words = ["recombine", DEMO_CORPUS, &recipe];
        let output = command.args(words).output().expect("the program runs");
        if !output.status.success() {
            let text = String::from_utf8_lossy(&output.stderr);
            faults.push(format!("reference/recipes.md: {recipe}: {text}"));
        }
    }
    assert!(recipes > 15, "{recipes} recipes");
    faults
}

#[cfg(unix)]
#[test]
fn every_command_does_what_its_chapter_shows() {
    use std::sync::Mutex;
    type BookWork<'a> = Box<dyn FnOnce() -> Vec<String> + Send + 'a>;
    let demo = tempfile::tempdir().expect("a folder");
    let (mut tutorial, mut waiting, mut total) = (Vec::new(), Vec::<BookWork<'_>>::new(), 0);
    for Chapter { name, text } in book_chapters() {
        let mut calls = chapter_calls(&text);
        total += calls.len();
        let demo = demo.path();
        if let Some(at) = book_calls::demo_call(&calls) {
            // The other chapters begin with the folder that this call makes.
            let rest = calls.split_off(at + 1);
            tutorial.extend(book_calls::run_calls(&name, &calls, demo));
            waiting.push(Box::new(move || book_calls::run_calls(&name, &rest, demo)));
        } else {
            waiting.push(Box::new(move || book_calls::run_chapter(&name, &calls, demo)));
        }
    }
    println!("{total} commands");
    assert!(total > 200, "{total} commands");
    assert!(demo.path().join(DEMO_CORPUS).exists(), "{}", tutorial.join("\n"));
    waiting.push(Box::new(|| query_faults(demo.path())));
    waiting.push(Box::new(|| recipe_faults(demo.path())));
    let (waiting, faults) = (Mutex::new(waiting), Mutex::new(tutorial));
    let work = || {
        loop {
            let next = waiting.lock().expect("a list").pop();
            let Some(run) = next else { break };
            let found = run();
            faults.lock().expect("a list").extend(found);
        }
    };
    std::thread::scope(|scope| {
        scope.spawn(work);
        scope.spawn(work);
    });
    let mut faults = faults.into_inner().expect("a list");
    faults.retain(|fault| {
        let is_skipped = fault.starts_with(book_calls::SKIPPED);
        if is_skipped {
            println!("{fault}");
        }
        !is_skipped
    });
    expect_none("the book and the program differ", &faults);
}

#[test]
fn blocks_are_read_as_commands_and_output() {
    let page =
        "Text.\n\n```console\n$ chereme info a\none …\n…\n$ false # exit code 1\n```\n\n```sh\na=1\ntest $a = 1\n```\n";
    let calls = chapter_calls(page);
    assert_eq!(calls.len(), 3);
    assert_eq!((calls[0].line, calls[0].script.as_str()), (4, "chereme info a"));
    assert!(calls[0].fits("one fish\ntwo\nthree\n") && calls[0].fits("one bird\n"));
    assert!(!calls[0].fits("two fish\n"));
    assert_eq!(calls[1].exit_code, 1);
    assert_eq!(calls[2].script, "a=1\ntest $a = 1");
    let kinds: BTreeMap<usize, String> = fenced_blocks(page).into_iter().map(|it| (it.line, it.kind)).collect();
    assert_eq!(kinds.into_values().collect::<Vec<_>>(), ["console", "sh"]);
}
