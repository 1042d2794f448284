//! One word for one idea: words that the glossary replaced stand in no comment, guide, help text or name any more.

use chereme_tests::repository;

/// This file writes the words that it looks for.
const OWN: [&str; 2] = ["tests/tests/house_words.rs", "tests/tests/plain_words.rs"];

/// Words that are never used, with the words of the house. Words in code, between grave accents, do not count.
const REPLACED: [(&str, &str); 15] = [
    ("anew", "again"),
    ("kept search", "saved search"),
    ("kept searches", "saved searches"),
    ("made movement", "generated movement"),
    ("made sign", "generated sign"),
    ("made signs", "generated signs"),
    ("made clip", "generated clip"),
    ("made clips", "generated clips"),
    ("made recording", "generated recording"),
    ("made recordings", "generated recordings"),
    ("told", "inferred, reported, shown"),
    ("telling", "inferring, reporting, showing"),
    ("tells", "infers, reports, shows"),
    ("tell apart", "distinguish"),
    ("otherwise than", "differently from"),
];

/// Returns the words of a text in lower case, each after a blank, without code between grave accents.
fn words(text: &str) -> String {
    let prose: Vec<&str> = text.split('`').step_by(2).collect();
    let prose = prose.join(" ").to_lowercase();
    let words = prose.split(|c: char| !c.is_alphanumeric() && c != '_');
    let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
    format!(" {} ", words.join(" "))
}

/// Returns the prose of a line: a comment of Rust, which is the help of commands too, or a line of a guide.
fn prose<'a>(path: &str, line: &'a str) -> Option<&'a str> {
    if path.ends_with(".rs") {
        let comment = line.trim_start().strip_prefix("//")?;
        return Some(comment);
    }
    Some(line)
}

fn replaced(text: &str) -> Option<(&'static str, &'static str)> {
    let words = words(text);
    let found = REPLACED.iter();
    found.copied().find(|(word, _)| words.contains(&format!(" {word} ")))
}

#[test]
fn every_term_is_the_one_of_the_glossary() {
    let mut files = repository::text_files();
    files.retain(|file| {
        let guide = file.path.ends_with("README.md");
        (guide || file.path.ends_with(".rs")) && !OWN.contains(&file.path.as_str())
    });
    assert!(files.len() > 500, "{} files", files.len());
    let mut faults = Vec::new();
    for file in &files {
        let mut drawn = false;
        for (at, line) in file.text.lines().enumerate() {
            drawn ^= line.starts_with("```");
            let text = prose(&file.path, line).filter(|_| !drawn);
            let found = text.and_then(replaced);
            if let Some((word, instead)) = found {
                faults.push(format!("{}:{}: {word:?}: write {instead}", file.path, at + 1));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn words_in_code_do_not_count() {
    assert_eq!(replaced("/// Builds the index anew.").map(|it| it.0), Some("anew"));
    assert!(replaced("/// The variant `Told`, and `made sign` in a query.").is_none());
    assert_eq!(replaced("What it was told.").map(|it| it.0), Some("told"));
}
