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

/// Parts of names that say nothing about the value that has the name, with names that do.
const VAGUE: [(&str, &str); 7] = [
    ("anew", "again, rebuilt"),
    ("tell", "print, report, describe"),
    ("tells", "prints, reports, distinguishes"),
    ("telling", "printing, reporting, describing"),
    ("told", "messages, report, findings, inferred, text"),
    ("way", "direction, path, offset, axis, mode"),
    ("ways", "directions, paths, offsets, settings"),
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
    found
        .copied()
        .find(|(word, _)| words.contains(&format!(" {word} ")))
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
                faults.push(format!(
                    "{}:{}: {word:?}: write {instead}",
                    file.path,
                    at + 1
                ));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn words_in_code_do_not_count() {
    assert_eq!(
        replaced("/// Builds the index anew.").map(|it| it.0),
        Some("anew")
    );
    assert!(replaced("/// The variant `Told`, and `made sign` in a query.").is_none());
    assert_eq!(replaced("What it was told.").map(|it| it.0), Some("told"));
}

/// Returns the names in Rust source with their line numbers: words outside of comments and literals.
fn names(source: &str) -> Vec<(usize, &str)> {
    let is_part = |c: char| c == '_' || c.is_alphanumeric();
    let (mut found, mut line, mut rest) = (Vec::new(), 1, source);
    while let Some(first) = rest.chars().next() {
        let word = rest.find(|c| !is_part(c)).unwrap_or(rest.len());
        let skipped = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").map_or(rest.len(), |end| end + 2)
        } else if first == '"' {
            literal(rest, '"')
        } else if first == '\'' {
            let mut next = rest[1..].chars();
            let is_char = next.next() == Some('\\') || next.next() == Some('\'');
            if is_char { literal(rest, '\'') } else { 1 }
        } else if let Some(length) = raw_literal(rest) {
            length
        } else if word > 0 {
            if !first.is_ascii_digit() {
                found.push((line, &rest[..word]));
            }
            word
        } else {
            first.len_utf8()
        };
        line += rest[..skipped].matches('\n').count();
        rest = &rest[skipped..];
    }
    found
}

/// Returns the length of a literal between quotes in which a backslash escapes the next character.
fn literal(text: &str, quote: char) -> usize {
    let mut escaped = false;
    let end = text.char_indices().skip(1).find(|(_, c)| {
        let ends = *c == quote && !escaped;
        escaped = *c == '\\' && !escaped;
        ends
    });
    end.map_or(text.len(), |(at, _)| at + 1)
}

/// Returns the length of the raw literal with which a text begins, if it begins with one.
fn raw_literal(text: &str) -> Option<usize> {
    let mut marks = ["r", "br", "cr"].iter();
    let after = marks.find_map(|mark| text.strip_prefix(mark))?;
    let hashes = after.len() - after.trim_start_matches('#').len();
    let inside = after[hashes..].strip_prefix('"')?;
    let close = format!("\"{}", "#".repeat(hashes));
    let end = inside
        .find(&close)
        .map_or(inside.len(), |at| at + close.len());
    Some(text.len() - inside.len() + end)
}

/// Returns the vague part of a name, and what to use instead.
fn vague(name: &str) -> Option<(&'static str, &'static str)> {
    let mut snake = String::new();
    let mut after_small = false;
    for c in name.chars() {
        if c.is_uppercase() && after_small {
            snake.push('_');
        }
        after_small = c.is_lowercase() || c.is_ascii_digit();
        snake.extend(c.to_lowercase());
    }
    let is_in = |(part, _): &(&str, &str)| {
        snake
            .split('_')
            .any(|it| it.trim_end_matches(char::is_numeric) == *part)
    };
    VAGUE.into_iter().find(is_in)
}

#[test]
fn no_name_has_a_part_that_says_nothing() {
    let mut faults = Vec::new();
    let mut count = 0;
    for file in repository::rust_files() {
        for (line, name) in names(&file.text) {
            count += 1;
            if let Some((part, instead)) = vague(name) {
                let place = format!("{}:{line}", file.path);
                faults.push(format!("{place}: {name} has {part:?}: use {instead}"));
            }
        }
    }
    assert!(count > 500_000, "only {count} names");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn names_are_recognised_outside_of_comments_and_literals() {
    let source = "fn a<'b>(told: &'b str) { // told\n let c = '\\''; let d = '\"'; \"tell\\\"told\n\";\n\
                  r#\"way \"told\"#; br\"tell\"; r#type; /* way */ 1e5; é('x') }";
    let all = names(source);
    let words: Vec<&str> = all.iter().map(|it| it.1).collect();
    let wanted = [
        "fn", "a", "b", "told", "b", "str", "let", "c", "let", "d", "r", "type", "é",
    ];
    assert_eq!(words, wanted);
    assert_eq!((all[3].0, all[7].0, all[11].0), (1, 2, 4));
    for name in ["told", "TOLD_AFTER", "StageWays", "tell_lost", "way2"] {
        assert!(vague(name).is_some(), "{name}");
    }
    for name in ["always", "Untold", "Gateway", "toll", "AWAY"] {
        assert!(vague(name).is_none(), "{name}");
    }
}
