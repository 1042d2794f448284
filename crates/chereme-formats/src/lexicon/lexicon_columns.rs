//! Infers the meaning of a lexicon table's columns from their titles.

use crate::finding::ImportFinding;
use crate::hns::holds_symbols;
use crate::roles::{AnnotatedHands, MappingTarget, TierMapping, is_hand, normalize_tier_name, stated_hands};
use crate::table::TableRow;
use crate::tally::FindingTally;
use chereme_sign::query::parse_plain_number;
use chereme_sign::{ErrorRemedy, RemedyChoice};
use chereme_sign::{HandRef, SignComponent, SignPhase, TierRole, TierTopic};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

/// A column of a lexicon table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LexiconColumn {
    /// Its title as written.
    pub title: String,
    /// The inferred meaning.
    pub meaning: LexiconColumnMeaning,
    /// The confidence, from 0 to 1; 1 for columns of a mapping.
    pub confidence: f64,
    /// The evidence for the meaning.
    pub why: String,
}

impl std::fmt::Display for LexiconColumnMeaning {
    /// Writes the meaning as mappings spell it: `right.configuration`, `translation.en`.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let of_language = |f: &mut std::fmt::Formatter<'_>, word: &str, language: &Option<String>| {
            f.write_str(word)?;
            language.as_ref().map_or(Ok(()), |code| write!(f, ".{code}"))
        };
        match self {
            Self::Gloss { language } => of_language(f, "gloss", language),
            Self::Translation { language } => of_language(f, "translation", language),
            Self::Coding {
                hand,
                component,
                feature,
                phase,
            } => {
                if let Some(phase) = phase {
                    write!(f, "{phase}.")?;
                }
                let role = TierRole::Component {
                    component: *component,
                    feature: feature.clone(),
                };
                write!(f, "{}", TierTopic { role, hand: *hand })
            }
            Self::Notation => f.write_str("notation"),
            Self::Attribute => f.write_str("attribute"),
            Self::Note => f.write_str("note"),
        }
    }
}

/// The kinds of columns.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LexiconColumnMeaning {
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
    /// A component of the sign.
    Coding {
        /// The hand.
        hand: Option<AnnotatedHands>,
        /// The component.
        component: SignComponent,
        /// The part of it.
        feature: Option<String>,
        /// The phase: initial, middle or final.
        #[serde(serialize_with = "super::phase_name")]
        phase: Option<SignPhase>,
    },
    /// The sign as HamNoSys.
    Notation,
    /// A number or a text about the sign that is not a component: frequency, iconicity, word class.
    Attribute,
    /// Other text, kept unchanged.
    Note,
}

/// Titles as folded words, with their meanings.
static COLUMN_TITLE_TARGETS: LazyLock<BTreeMap<String, MappingTarget>> = LazyLock::new(|| {
    parse_column_targets(chereme_data::schema_text("column_words.json"))
        .expect("the shipped table of titles is whole; a test reads it")
});

const LANGUAGE_TITLE_WORDS: [(&str, &[&str]); 12] = [
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

fn parse_column_targets(text: &str) -> Result<BTreeMap<String, MappingTarget>, String> {
    let file: BTreeMap<String, Vec<String>> = serde_json::from_str(text).map_err(|error| error.to_string())?;
    let mut table = BTreeMap::new();
    for (meaning, titles) in file {
        let target = MappingTarget::parse_mapping_target(&meaning, &meaning).map_err(|error| error.to_string())?;
        table.extend(titles.into_iter().map(|title| (title, target.clone())));
    }
    Ok(table)
}

/// Titles of properties of tokens rather than signs.
const TOKEN_PROPERTY_TITLES: [&str; 10] = [
    "token",
    "recording",
    "start_s",
    "end_s",
    "origin",
    "signer",
    "hand",
    "citation",
    "disputed",
    "proposed",
];

/// Titles of columns that hold HamNoSys, as folded words.
const NOTATION_TITLES: [&str; 8] = [
    "hamnosys",
    "hamnosys 4",
    "hamnosys4",
    "hamnosys notation",
    "hamnosys string",
    "hamnosys text",
    "notation",
    "transcription",
];

/// Titles of columns that name the sign if no column is called a gloss, as folded words.
const SIGN_NAME_TITLES: [&str; 16] = [
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

/// Words in titles of measurements, as parts of folded words.
const MEASUREMENT_TITLE_WORDS: [&str; 24] = [
    "frequency",
    "freq",
    "count",
    "mean",
    "median",
    "sd",
    "rating",
    "iconicity",
    "score",
    "percent",
    "zipf",
    "log",
    "accuracy",
    "rt",
    "density",
    "age",
    "frequence",
    "haufigkeit",
    "frequentie",
    "iconicite",
    "ikonizitat",
    "probability",
    "number",
    "rank",
];

/// Words that make a title that of something else than the component it names: of its change, of a picture or a file.
const UNRELATED_TITLE_WORDS: [&str; 18] = [
    "change",
    "changement",
    "image",
    "images",
    "picture",
    "pictures",
    "photo",
    "foto",
    "bild",
    "icon",
    "video",
    "film",
    "movie",
    "link",
    "lien",
    "url",
    "file",
    "fichier",
];

/// Returns whether a word of a title names a later morpheme, as `M2` or `morpheme2` do.
fn is_later_morpheme(word: &str) -> bool {
    let number = word.strip_prefix("morpheme").or_else(|| word.strip_prefix('m'));
    number.is_some_and(|digits| digits.parse::<u8>().is_ok_and(|number| number > 1))
}

/// The columns of a table with their meanings.
pub(super) struct LexiconTableColumns {
    pub(super) columns: Vec<LexiconColumn>,
    /// The places of the columns that name signs: a row without a cell in one of them is named by the next.
    pub(super) names: Vec<usize>,
}

/// Returns the inferred meaning of each column. One gloss column names the sign; further ones are translations, and name
/// the rows without a gloss. Of columns with unknown titles, those with HamNoSys's symbols are notation, the others attributes; if no column is
/// titled a gloss, one titled a name or a word is the gloss, else the first one next to the notation. A column of
/// measurements is an attribute even if its title names a component.
pub(super) fn infer_column_meanings(
    header: &[String],
    rows: &[TableRow],
    mapping: &TierMapping,
    findings: &mut FindingTally,
) -> LexiconTableColumns {
    let mut columns: Vec<LexiconColumn> = header.iter().map(|title| column_from_title(title, mapping)).collect();
    state_hands(&mut columns);
    for (at, column) in columns.iter_mut().enumerate() {
        if column.why.is_empty() && holds_notation(rows, at) {
            column.meaning = LexiconColumnMeaning::Notation;
            column.confidence = 0.9;
            "its cells hold HamNoSys's symbols".clone_into(&mut column.why);
        }
        if (1e-9..0.9).contains(&column.confidence)
            && !matches!(column.meaning, LexiconColumnMeaning::Note)
            && is_measurement_column(rows, at, column)
        {
            column.meaning = LexiconColumnMeaning::Attribute;
            column.confidence = 0.8;
            "its cells are numbers that measure".clone_into(&mut column.why);
        }
    }
    let mut names = gloss_columns(&columns, rows);
    for at in names.iter().skip(1) {
        let column = &mut columns[*at];
        if let LexiconColumnMeaning::Gloss { language } = &column.meaning {
            column.meaning = match is_entry_id(&column.title) {
                true => LexiconColumnMeaning::Attribute,
                false => LexiconColumnMeaning::Translation {
                    language: language.clone(),
                },
            };
        }
    }
    if names.is_empty()
        && let Some(at) = likely_gloss(&columns)
    {
        names.push(at);
        let column = &mut columns[at];
        column.meaning = LexiconColumnMeaning::Gloss { language: None };
        column.confidence = 0.4;
        "no column is called a gloss".clone_into(&mut column.why);
        findings.add_limited_finding("glosses by another title", || {
            let title = &column.title;
            let message = format!("no column is called a gloss; {title:?} was taken for it");
            ImportFinding::new_warning_finding(1, message).with_remedy(ErrorRemedy::choice_remedy(
                RemedyChoice::TierRoles,
                format!("call the column \"gloss\", or say so in a mapping: {{\"columns\": {{{title:?}: \"gloss\"}}}}"),
            ))
        });
    }
    let mut seen = BTreeSet::new();
    for column in &mut columns {
        let title = &column.title;
        if column.why.is_empty() {
            column.meaning = LexiconColumnMeaning::Attribute;
            "no word of its title is known".clone_into(&mut column.why);
        }
        if !seen.insert(title.clone()) {
            findings.add_limited_warning("columns given twice", 1, || {
                format!("the column {title:?} is there twice")
            });
        }
    }
    report_attributes(&columns, findings);
    report_shared(&columns, findings);
    LexiconTableColumns { columns, names }
}

/// Gives columns of a hand's components the hand that their title states: `Configuration MG` is that of the left hand.
fn state_hands(columns: &mut [LexiconColumn]) {
    let titles: Vec<String> = columns.iter().map(|column| with_parted_words(&column.title)).collect();
    for (column, stated) in columns.iter_mut().zip(stated_hands(&titles)) {
        let Some(AnnotatedHands::One(own)) = stated.filter(|_| column.confidence < 1.0) else {
            continue;
        };
        if let LexiconColumnMeaning::Coding {
            hand,
            component,
            feature,
            ..
        } = &mut column.meaning
            && is_of_a_hand(*component, feature.as_deref())
        {
            *hand = Some(AnnotatedHands::One(own));
        }
    }
}

/// Returns whether a feature belongs to one hand, and not to both together as their relation does.
fn is_of_a_hand(component: SignComponent, feature: Option<&str>) -> bool {
    let both = ["handedness", "relation", "alternating"];
    component.is_manual() && !feature.is_some_and(|feature| both.contains(&feature))
}

/// Reports columns that hold the same component of the same hand: each sign has the values of all of them.
fn report_shared(columns: &[LexiconColumn], findings: &mut FindingTally) {
    let mut shared: BTreeMap<String, Vec<&LexiconColumn>> = BTreeMap::new();
    for column in columns {
        if matches!(column.meaning, LexiconColumnMeaning::Coding { .. }) && column.confidence < 1.0 {
            let same = shared.entry(column.meaning.to_string()).or_default();
            same.push(column);
        }
    }
    for (meaning, same) in shared {
        if let [first, second, ..] = same[..] {
            let (first, other, own) = (&first.title, &second.title, second_meaning(&second.meaning));
            findings.push_counted_finding(
                ImportFinding::new_warning_finding(
                    1,
                    format!("the columns {first:?} and {other:?} are both taken for {meaning}; signs have the values of both"),
                )
                .with_remedy(ErrorRemedy::choice_remedy(
                    RemedyChoice::TierRoles,
                    format!("say in a mapping what each is: {{\"columns\": {{{other:?}: \"{own}\"}}}}"),
                )),
            );
        }
    }
}

/// Returns the meaning that the second of two columns of one meaning is likely to have: the same of the weak hand, or an
/// attribute.
fn second_meaning(meaning: &LexiconColumnMeaning) -> LexiconColumnMeaning {
    let mut changed_meaning = meaning.clone();
    match &mut changed_meaning {
        LexiconColumnMeaning::Coding {
            hand: hand @ (None | Some(AnnotatedHands::One(HandRef::Dominant))),
            component,
            feature,
            ..
        } if is_of_a_hand(*component, feature.as_deref()) => {
            *hand = Some(AnnotatedHands::One(HandRef::Weak));
            changed_meaning
        }
        _ => LexiconColumnMeaning::Attribute,
    }
}

/// Returns the columns of glosses, first the one that names the sign: the first one of a mapping, otherwise the first one
/// whose title speaks of annotation, because several signs of Signbank share a lemma, otherwise the first one. The id
/// of an entry, and a column that many rows leave empty, come after others, unless a mapping names them.
fn gloss_columns(columns: &[LexiconColumn], rows: &[TableRow]) -> Vec<usize> {
    let annotation = |title: &str| {
        let words = normalize_tier_name(&with_parted_words(title));
        words.split(' ').any(|word| word == "annotation")
    };
    let tenths = |at: usize| {
        let filled = rows.iter().filter(|row| is_filled(row, at)).count();
        filled * 10 / rows.len().max(1)
    };
    let columns = columns.iter().enumerate();
    let mut candidates: Vec<_> = columns
        .filter(|(_, column)| matches!(column.meaning, LexiconColumnMeaning::Gloss { .. }))
        .map(|(at, column)| {
            let mapped = column.confidence >= 1.0;
            // Eight rows of ten are enough.
            let empty = if mapped { 0 } else { 8 - tenths(at).min(8) };
            // In ASL-LEX an entry's id is its gloss; a table with another gloss has ids beside it.
            let is_id = !mapped && is_entry_id(&column.title);
            (!mapped, empty, is_id, !annotation(&column.title), at)
        })
        .collect();
    candidates.sort_unstable();
    candidates.into_iter().map(|(.., at)| at).collect()
}

fn is_entry_id(title: &str) -> bool {
    ["entryid", "entry id"].contains(&normalize_tier_name(&with_parted_words(title)).as_str())
}

/// Returns whether a row has a cell with text in a column.
pub(super) fn is_filled(row: &TableRow, column: usize) -> bool {
    let cell = row.cells.get(column);
    cell.is_some_and(|cell| !cell.trim().is_empty())
}

/// Reports the columns that become attributes, all in one finding.
fn report_attributes(columns: &[LexiconColumn], findings: &mut FindingTally) {
    const MAX_REPORTED_ATTRIBUTES: usize = 12;
    let guessed =
        |column: &&LexiconColumn| column.meaning == LexiconColumnMeaning::Attribute && column.confidence < 1.0;
    let titles: Vec<&str> = (columns.iter().filter(guessed))
        .map(|column| column.title.as_str())
        .collect();
    let Some(first) = titles.first() else { return };
    let shown: Vec<String> = titles
        .iter()
        .take(MAX_REPORTED_ATTRIBUTES)
        .map(|title| format!("{title:?}"))
        .collect();
    let more = match titles.len().saturating_sub(MAX_REPORTED_ATTRIBUTES) {
        0 => String::new(),
        count => format!(" and {count} more"),
    };
    let (columns, are) = match titles.len() {
        1 => ("column", "is kept as an attribute"),
        _ => ("columns", "are kept as attributes"),
    };
    let (shown, example) = (
        shown.join(", "),
        format!("{{\"columns\": {{{first:?}: \"translation\"}}}}"),
    );
    findings.add_limited_finding("attributes", || {
        ImportFinding::new_note_finding(1, format!("the {columns} {shown}{more} {are} of each sign")).with_remedy(
            ErrorRemedy::choice_remedy(
                RemedyChoice::TierRoles,
                format!(
                    "queries find them, as in attribute({first:?})=*; to take one for something else, say so in a \
             mapping: {example}"
                ),
            ),
        )
    });
}

/// Returns whether a column holds measurements: its cells are numbers, and its title is that of a measurement, or some
/// cells have decimals, or it would be words.
fn is_measurement_column(rows: &[TableRow], at: usize, column: &LexiconColumn) -> bool {
    let all_cells = rows.iter().filter_map(|row| row.cells.get(at));
    let cells = all_cells.map(|cell| cell.trim()).filter(|cell| !cell.is_empty());
    let (mut all, mut numbers, mut parts) = (0usize, 0usize, 0usize);
    for cell in cells {
        all += 1;
        let read = parse_plain_number(cell);
        numbers += usize::from(read.is_some());
        parts += usize::from(read.is_some_and(|number| number.fract() != 0.0));
    }
    let plain_title = normalize_tier_name(&column.title);
    let words = matches!(
        column.meaning,
        LexiconColumnMeaning::Gloss { .. } | LexiconColumnMeaning::Translation { .. }
    );
    let is_measure = plain_title.split(' ').any(|word| {
        let letters = word.trim_start_matches(|c: char| c.is_ascii_digit());
        MEASUREMENT_TITLE_WORDS.iter().any(|measure| match measure.len() {
            ..=4 => letters == *measure,
            _ => letters.contains(measure),
        })
    });
    // Occasional words, such as NA, stand for missing values.
    all > 0 && numbers * 10 >= all * 9 && (is_measure || words || parts > 0)
}

/// Returns the column that names the sign if no column is titled a gloss.
fn likely_gloss(columns: &[LexiconColumn]) -> Option<usize> {
    let unknown = |column: &LexiconColumn| column.why.is_empty();
    let called = columns
        .iter()
        .position(|column| unknown(column) && SIGN_NAME_TITLES.contains(&&*normalize_tier_name(&column.title)));
    let notated = |column: &LexiconColumn| column.meaning == LexiconColumnMeaning::Notation;
    let first = || {
        let any = columns.iter().any(notated);
        columns.iter().position(unknown).filter(|_| any)
    };
    called.or_else(first)
}

/// Returns a title such as `NlGloss` or `handshapeStrong` with a blank before each of its words.
fn with_parted_words(title: &str) -> String {
    let letters: Vec<char> = title.chars().collect();
    let mut parted = String::with_capacity(title.len() + 4);
    for (at, letter) in letters.iter().enumerate() {
        let before = at.checked_sub(1).map(|at| letters[at]);
        let is_lower = |letter: Option<&char>| letter.is_some_and(|character| character.is_lowercase());
        let begins = before
            .is_some_and(|before| before.is_lowercase() || before.is_uppercase() && is_lower(letters.get(at + 1)));
        if letter.is_uppercase() && begins {
            parted.push(' ');
        }
        parted.push(*letter);
    }
    parted
}

/// Returns the meaning of a column by its title, as written or by the words that capital letters part.
pub(super) fn column_from_title(title: &str, mapping: &TierMapping) -> LexiconColumn {
    let whole_column = column_by(title, title, mapping);
    let parted = with_parted_words(title);
    if !whole_column.why.is_empty() || parted == title {
        return whole_column;
    }
    column_by(title, &parted, mapping)
}

/// Returns the meaning of a column by a spelling of its title.
fn column_by(title: &str, spelled: &str, mapping: &TierMapping) -> LexiconColumn {
    let column = |target: Option<&MappingTarget>, language, confidence, why| LexiconColumn {
        title: title.to_owned(),
        meaning: target.map_or(LexiconColumnMeaning::Note, |target| meaning_of_target(target, language)),
        confidence,
        why,
    };
    if let Some((entry, target)) = mapping.column_mapping_entry(title) {
        return column(Some(target), None, 1.0, format!("the mapping says so ({entry:?})"));
    }
    let normal_title = normalize_tier_name(spelled);
    if TOKEN_PROPERTY_TITLES.contains(&title) {
        let why = "a table of tokens that Chereme wrote has it".to_owned();
        return column(None, None, 1.0, why);
    }
    if NOTATION_TITLES.contains(&normal_title.as_str()) {
        return LexiconColumn {
            meaning: LexiconColumnMeaning::Notation,
            ..column(None, None, 0.95, format!("its title is {normal_title:?}"))
        };
    }
    let language = language_in_title(&normal_title);
    let words: Vec<&str> = normal_title
        .split(' ')
        .filter(|word| language.as_ref().is_none_or(|(_, found)| word != found))
        .collect();
    let plain = words.join(" ");
    let name = language.map(|(code, _)| code);
    for text in [&normal_title, &plain] {
        if let Some(target) = COLUMN_TITLE_TARGETS.get(text) {
            return column(Some(target), name, 0.95, format!("its title is {text:?}"));
        }
    }
    if let Some(target) = MappingTarget::of_title(spelled) {
        return column(Some(&target), None, 1.0, "its title is a field".to_owned());
    }
    let within = |known: &&String| known.split(' ').all(|word| words.contains(&word));
    // A hand alone means its handshape; beside another word it is the hand of that: the location of the weak hand.
    let longest = COLUMN_TITLE_TARGETS
        .keys()
        .filter(within)
        .max_by_key(|known| (!is_hand(&known.replace(' ', "")), known.split(' ').count(), known.len()));
    let aside = |known: &String| {
        let named = |word: &&&str| known.split(' ').any(|own| own == **word);
        let other = |word: &&&str| UNRELATED_TITLE_WORDS.contains(word) || is_later_morpheme(word);
        words.iter().filter(other).find(|word| !named(word)).copied()
    };
    match longest {
        Some(known) if let Some(word) = aside(known) => LexiconColumn {
            meaning: LexiconColumnMeaning::Attribute,
            ..column(None, None, 0.6, format!("{word:?} beside {known:?} in its title"))
        },
        Some(known) => column(
            COLUMN_TITLE_TARGETS.get(known),
            name,
            0.6,
            format!("{known:?} in its title"),
        ),
        None => column(None, None, 0.0, String::new()),
    }
}

/// Returns whether most non-empty cells of a column hold symbols of HamNoSys.
fn holds_notation(rows: &[TableRow], column: usize) -> bool {
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

/// Returns the code of two letters for a language that a code or a name means, in lower case: `fr` for `fra` and `french`.
#[must_use]
pub fn short_language_code(name: &str) -> Option<&'static str> {
    let known = LANGUAGE_TITLE_WORDS.iter().find(|(_, names)| names.contains(&name));
    known.map(|(code, _)| *code)
}

/// Returns the language that a title of several words names, and the word.
fn language_in_title(title: &str) -> Option<(String, &str)> {
    let words: Vec<&str> = title.split(' ').collect();
    let mut language_words = words
        .iter()
        .filter_map(|word| Some((short_language_code(word)?.to_owned(), *word)));
    language_words.next().filter(|_| words.len() > 1)
}

fn meaning_of_target(target: &MappingTarget, language: Option<String>) -> LexiconColumnMeaning {
    let language = target.language.clone().or(language);
    if target.attribute {
        return LexiconColumnMeaning::Attribute;
    }
    match &target.role {
        Some(TierRole::Gloss) => LexiconColumnMeaning::Gloss { language },
        Some(TierRole::Translation) => LexiconColumnMeaning::Translation { language },
        Some(TierRole::Component { component, feature }) => LexiconColumnMeaning::Coding {
            hand: target.hand,
            component: *component,
            feature: feature.clone(),
            phase: target.phase,
        },
        _ => LexiconColumnMeaning::Note,
    }
}

#[cfg(test)]
mod tests;
