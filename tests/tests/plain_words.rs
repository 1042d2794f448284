//! Plain English in comments and READMEs: an agent, a noun, a verb, and no sentence that a reader must read twice.

use chereme_tests::repository;

/// The most riddles in a thousand sentences.
const MOST: f64 = 10.0;

/// This file writes the words that it looks for.
const OWN: &str = "tests/tests/plain_words.rs";

/// Phrases that riddles are made of, in lower case, and the words to use in their place.
const RIDDLES: [(&str, &str); 38] = [
    ("is told", "infer, report, print, distinguish"),
    ("are told", "infer, report, print, distinguish"),
    ("was told", "infer, report, print, distinguish"),
    ("were told", "infer, report, print, distinguish"),
    ("be told", "infer, report, print, distinguish"),
    ("told by", "infer, report, print, distinguish"),
    ("told of", "report"),
    ("told otherwise", "read differently"),
    ("tells whether", "returns whether"),
    ("tells that", "reports that"),
    ("tells of", "reports"),
    ("what is told", "the noun"),
    ("what was told", "the noun"),
    ("what is said", "the noun"),
    ("what was said", "the noun"),
    ("what is made", "the noun"),
    ("what was made", "the noun"),
    ("what is left", "the rest"),
    ("what was left", "the rest"),
    ("what is meant", "the meaning"),
    ("what is there", "the noun"),
    ("what is known", "the noun"),
    ("what is done", "the noun"),
    ("where it is", "if, when"),
    ("where that is", "if, when"),
    ("where nothing is", "if, when"),
    ("where there is none", "if, when"),
    ("where there are none", "if, when"),
    ("where it has", "if, when"),
    ("where they are", "if, when"),
    ("of which", "two sentences"),
    ("is none", "does not exist, has no"),
    ("are none", "do not exist, have no"),
    ("otherwise than", "differently from"),
    ("anew", "again"),
    ("likewise", "also"),
    ("lest", "so that not"),
    ("kept search", "saved search"),
];

#[test]
fn sentences_are_plain() {
    let mut files = repository::rust_files();
    files.extend(repository::text_files().into_iter().filter(|file| {
        let path = std::path::Path::new(&file.path);
        path.extension().is_some_and(|it| it == "md") && !file.path.ends_with("RESULTS.md")
    }));
    let (mut all, mut riddles) = (0_usize, Vec::new());
    for file in files.iter().filter(|file| file.path != OWN) {
        let is_rust = file.path.ends_with(".rs");
        let blocks = if is_rust {
            comments(&file.text)
        } else {
            paragraphs(&file.text)
        };
        for sentence in blocks.iter().flat_map(|block| sentences(block)) {
            all += 1;
            if let Some(why) = riddle(&sentence) {
                riddles.push(format!("{}: {sentence} ({why})", file.path));
            }
        }
    }
    assert!(all > 1000, "{all} sentences were found");
    let share = 1000.0 * riddles.len() as f64 / all as f64;
    assert!(
        share <= MOST,
        "{share:.1} riddles in a thousand sentences; rewrite some of them:\n  {}",
        riddles.join("\n  ")
    );
}

#[test]
fn riddles_are_recognised_and_plain_sentences_are_not() {
    for text in [
        "What is told of it stays.",
        "The index of the corpus is made anew.",
        "The places, of which there are two, move.",
    ] {
        assert!(sentences(text).iter().any(|it| riddle(it).is_some()), "{text}");
    }
    for text in [
        "Returns the place of the hand.",
        "Tells users what to do.",
        "The word `anew` is code.",
    ] {
        assert!(sentences(text).iter().all(|it| riddle(it).is_none()), "{text}");
    }
    assert_eq!(
        comments("let a = 1; // aside\n/// One\n/// two.\nfn f() {}"),
        ["One two."]
    );
}

/// Returns the comments of Rust source, lines joined, without code blocks.
fn comments(text: &str) -> Vec<String> {
    let (mut blocks, mut block, mut code) = (Vec::new(), String::new(), false);
    for line in text.lines().chain([""]) {
        let line = line.trim_start();
        let words = ["///", "//!", "//"].iter().find_map(|mark| line.strip_prefix(mark));
        match words.map(str::trim) {
            Some(words) if words.starts_with("```") => code = !code,
            Some(_) if code => {}
            Some(words) => {
                block.push_str(if block.is_empty() { "" } else { " " });
                block.push_str(words);
            }
            None => {
                code = false;
                if !block.is_empty() {
                    blocks.push(std::mem::take(&mut block));
                }
            }
        }
    }
    blocks
}

/// Returns the paragraphs of Markdown, lines joined, without code blocks, tables and headings.
fn paragraphs(text: &str) -> Vec<String> {
    let (mut blocks, mut block, mut code) = (Vec::new(), Vec::new(), false);
    for line in text.lines().chain([""]) {
        if line.starts_with("```") {
            code = !code;
        } else if code || line.starts_with(['|', '#']) {
        } else if line.trim().is_empty() {
            blocks.extend((!block.is_empty()).then(|| block.join(" ")));
            block.clear();
        } else {
            block.push(line.trim());
        }
    }
    blocks
}

/// Cuts text into sentences in lower case, with code in backquotes left out.
fn sentences(block: &str) -> Vec<String> {
    let prose: String = block
        .split('`')
        .enumerate()
        .map(|(at, part)| if at % 2 == 0 { part } else { "x" })
        .collect();
    let mut all = vec![String::new()];
    let mut ended = false;
    for c in prose.chars() {
        if ended && c.is_whitespace() {
            all.push(String::new());
        }
        ended = matches!(c, '.' | ';' | ':' | '!' | '?');
        if let Some(last) = all.last_mut() {
            last.extend(c.to_lowercase());
        }
    }
    all.retain(|sentence| sentence.trim().len() > 20);
    all
}

/// Returns the advice on the first riddle of a sentence.
fn riddle(sentence: &str) -> Option<&'static str> {
    let words: Vec<&str> = sentence
        .split(|c: char| !c.is_alphanumeric())
        .filter(|word| !word.is_empty())
        .collect();
    let plain = format!(" {} ", words.join(" "));
    if plain.starts_with(" what ") && !plain.starts_with(" what happens ") && !plain.contains(" what to do ") {
        return Some("a sentence whose subject is 'What ...': use the noun");
    }
    RIDDLES
        .iter()
        .find(|(phrase, _)| plain.contains(&format!(" {phrase} ")))
        .map(|&(_, why)| why)
}
