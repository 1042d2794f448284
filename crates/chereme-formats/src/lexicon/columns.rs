//! What the columns of a lexicon table are, by their titles.

use crate::finding::Finding;
use crate::hns::holds_symbols;
use crate::roles::{Hands, Mapping, Target, normal};
use crate::table::Row;
use crate::tally::Findings;
use chereme_sign::{Component, Phase, TierRole};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

/// A column of a lexicon table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Column {
    /// Its title as it is written.
    pub title: String,
    /// What it is taken for.
    pub meaning: Meaning,
    /// How sure that is, from 0 to 1, where 1 is what a mapping says.
    pub confidence: f64,
    /// What it was taken from.
    pub why: String,
}

/// What a column holds.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Meaning {
    /// The gloss by which a sign is named.
    Gloss {
        /// The language of the gloss, such as `nl`.
        language: Option<String>,
    },
    /// A gloss or translation in another language.
    Translation {
        /// The language, such as `en`.
        language: Option<String>,
    },
    /// What the sign is coded as.
    Coding {
        /// Whose hand.
        hand: Option<Hands>,
        /// The component.
        component: Component,
        /// The part of it.
        feature: Option<String>,
        /// Which of successive values.
        #[serde(serialize_with = "super::phase_name")]
        phase: Option<Phase>,
    },
    /// The sign as HamNoSys.
    Notation,
    /// Something else, kept as it is.
    Note,
}

/// Titles by what they mean, each as folded words.
static TABLE: LazyLock<BTreeMap<String, Target>> = LazyLock::new(|| {
    parse(include_str!("../../../../schema/column_words.json"))
        .expect("the shipped table of titles is whole; a test reads it")
});

const LANGUAGES: [(&str, &[&str]); 12] = [
    ("en", &["en", "eng", "english", "anglais"]),
    ("nl", &["nl", "nld", "dutch", "nederlands"]),
    ("fr", &["fr", "fra", "fre", "french", "francais"]),
    ("de", &["de", "deu", "ger", "german", "deutsch", "allemand"]),
    ("es", &["es", "spa", "spanish", "espanol"]),
    ("it", &["it", "ita", "italian", "italiano"]),
    ("pt", &["pt", "por", "portuguese", "portugues"]),
    ("fi", &["fi", "fin", "finnish", "suomi"]),
    ("sv", &["sv", "swe", "swedish", "svenska"]),
    ("ja", &["ja", "jpn", "japanese"]),
    ("ko", &["ko", "kor", "korean"]),
    ("zh", &["zh", "zho", "chinese"]),
];

fn parse(text: &str) -> Result<BTreeMap<String, Target>, String> {
    let file: BTreeMap<String, Vec<String>> =
        serde_json::from_str(text).map_err(|error| error.to_string())?;
    let mut table = BTreeMap::new();
    for (meaning, titles) in file {
        let target = Target::parse(&meaning, &meaning).map_err(|error| error.to_string())?;
        table.extend(titles.into_iter().map(|title| (title, target.clone())));
    }
    Ok(table)
}

/// Titles of columns that hold HamNoSys, as folded words.
const NOTATION: [&str; 8] = [
    "hamnosys",
    "hamnosys 4",
    "hamnosys4",
    "hamnosys notation",
    "hamnosys string",
    "hamnosys text",
    "notation",
    "transcription",
];

/// Titles of columns that name the sign where no column is called a gloss, as folded words.
const NAMES: [&str; 16] = [
    "word",
    "words",
    "headword",
    "sign name",
    "name",
    "label",
    "entry",
    "term",
    "title",
    "mot",
    "signe",
    "nom",
    "wort",
    "gebarde",
    "woord",
    "gebaar",
];

/// Returns what each column is taken for. The first gloss column names the sign; further ones are
/// translations. Of columns that no title tells, those with HamNoSys's symbols are notation; where none
/// is called a gloss, one that is called a name or a word is, else the first one beside the notation.
pub(super) fn meanings(
    header: &[String],
    rows: &[Row],
    mapping: &Mapping,
    findings: &mut Findings,
) -> Vec<Column> {
    let mut columns: Vec<Column> = header.iter().map(|title| column(title, mapping)).collect();
    let mut gloss = false;
    for (at, column) in columns.iter_mut().enumerate() {
        if column.why.is_empty() && holds_notation(rows, at) {
            column.meaning = Meaning::Notation;
            column.confidence = 0.9;
            "its cells hold HamNoSys's symbols".clone_into(&mut column.why);
        }
        if let Meaning::Gloss { language } = &column.meaning {
            if gloss {
                column.meaning = Meaning::Translation {
                    language: language.clone(),
                };
            }
            gloss = true;
        }
    }
    if !gloss && let Some(at) = likely_gloss(&columns) {
        let column = &mut columns[at];
        column.meaning = Meaning::Gloss { language: None };
        column.confidence = 0.4;
        "no column is called a gloss".clone_into(&mut column.why);
        findings.add("glosses by another title", || {
            let title = &column.title;
            let message = format!("no column is called a gloss; {title:?} was taken for it");
            Finding::warning(1, message).with_remedy(format!(
                "call the column \"gloss\", or say so in a mapping: {{\"columns\": {{{title:?}: \"gloss\"}}}}"
            ))
        });
    }
    let mut seen = BTreeSet::new();
    for column in &mut columns {
        let title = &column.title;
        if column.why.is_empty() {
            findings.add("unknown columns", || {
                Finding::note(
                    1,
                    format!("the column {title:?} is not understood; it is kept as a note"),
                )
                .with_remedy(format!(
                    "say what it is in a mapping: {{\"columns\": {{{title:?}: \"placement\"}}}}"
                ))
            });
            "no word of its title is known".clone_into(&mut column.why);
        }
        if !seen.insert(title.clone()) {
            findings.add("columns given twice", || {
                Finding::warning(1, format!("the column {title:?} is there twice"))
            });
        }
    }
    columns
}

/// Returns the column that names the sign where none is called a gloss.
fn likely_gloss(columns: &[Column]) -> Option<usize> {
    let unknown = |column: &Column| column.why.is_empty();
    let called = columns
        .iter()
        .position(|column| unknown(column) && NAMES.contains(&&*normal(&column.title)));
    let notated = |column: &Column| column.meaning == Meaning::Notation;
    let first = || {
        let any = columns.iter().any(notated);
        columns.iter().position(unknown).filter(|_| any)
    };
    called.or_else(first)
}

fn column(title: &str, mapping: &Mapping) -> Column {
    let column = |target: Option<&Target>, language, confidence, why| Column {
        title: title.to_owned(),
        meaning: target.map_or(Meaning::Note, |target| meaning(target, language)),
        confidence,
        why,
    };
    if let Some((entry, target)) = mapping.column(title) {
        return column(
            Some(target),
            None,
            1.0,
            format!("the mapping says so ({entry:?})"),
        );
    }
    let whole = normal(title);
    if NOTATION.contains(&whole.as_str()) {
        return Column {
            meaning: Meaning::Notation,
            ..column(None, None, 0.95, format!("its title is {whole:?}"))
        };
    }
    let language = language(&whole);
    let words: Vec<&str> = whole
        .split(' ')
        .filter(|word| language.as_ref().is_none_or(|(_, found)| word != found))
        .collect();
    let plain = words.join(" ");
    let name = language.map(|(code, _)| code);
    for text in [&whole, &plain] {
        if let Some(target) = TABLE.get(text) {
            return column(Some(target), name, 0.95, format!("its title is {text:?}"));
        }
    }
    if let Some(target) = Target::of_title(title) {
        return column(Some(&target), None, 1.0, "its title is a field".to_owned());
    }
    let within = |known: &&String| known.split(' ').all(|word| words.contains(&word));
    let longest = TABLE
        .keys()
        .filter(within)
        .max_by_key(|known| (known.split(' ').count(), known.len()));
    match longest {
        Some(known) => column(
            TABLE.get(known),
            name,
            0.6,
            format!("{known:?} in its title"),
        ),
        None => column(None, None, 0.0, String::new()),
    }
}

/// Tells whether most cells of a column that hold something hold symbols of HamNoSys.
fn holds_notation(rows: &[Row], column: usize) -> bool {
    let cells = rows
        .iter()
        .filter_map(|row| row.cells.get(column))
        .filter(|cell| !cell.trim().is_empty());
    let (mut all, mut notated) = (0usize, 0usize);
    for cell in cells {
        all += 1;
        notated += usize::from(holds_symbols(cell));
    }
    notated * 2 > all
}

/// Returns the language that a title of several words names, and the word.
fn language(title: &str) -> Option<(String, &str)> {
    let words: Vec<&str> = title.split(' ').collect();
    let mut found = words.iter().filter_map(|word| {
        let (code, _) = LANGUAGES.iter().find(|(_, names)| names.contains(word))?;
        Some(((*code).to_owned(), *word))
    });
    found.next().filter(|_| words.len() > 1)
}

fn meaning(target: &Target, language: Option<String>) -> Meaning {
    let language = target.language.clone().or(language);
    match &target.role {
        Some(TierRole::Gloss) => Meaning::Gloss { language },
        Some(TierRole::Translation) => Meaning::Translation { language },
        Some(TierRole::Component { component, feature }) => Meaning::Coding {
            hand: target.hand,
            component: *component,
            feature: feature.clone(),
            phase: target.phase,
        },
        _ => Meaning::Note,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shipped_table_is_whole_and_each_title_has_one_meaning() {
        let text = include_str!("../../../../schema/column_words.json");
        let file: BTreeMap<String, Vec<String>> = serde_json::from_str(text).expect("a table");
        let titles: Vec<&String> = file.values().flatten().collect();
        assert!(
            titles.iter().all(|title| normal(title) == **title),
            "titles are folded words"
        );
        assert_eq!(
            parse(text).expect("a table").len(),
            titles.len(),
            "a title stands twice"
        );
    }
}
