//! The signs of a dictionary: the token that shows each, its words, values and minimal pairs.

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::lexicon::short_language_code;
use chereme_sign::SignComponent;
use chereme_sign::text::fold_text;
use rusqlite::Connection;

use crate::Corpus;
use crate::consent::{ConsentKind, PublishPermissions, WithheldReason};
use crate::db::edits;
use crate::db::lexicons;
use crate::db::notations;
use crate::db::sign_relations;
use crate::db::signs::{self, TokenRow, TokenValueRow};
use crate::db::stored_attributes::{self, AttributeRow};
use crate::db::stored_columns::{RecordOrigin, ValueState};
use crate::db::stored_recordings;
use crate::db::stored_spans;
use crate::error::CorpusResult;
use crate::lexicon::{LexiconScope, keep_scope_rows};
use crate::notation;
use crate::pairs;
use crate::progress::ProgressReceiver;
use crate::search::SearchOptions;
use crate::suggest::CodingReader;

use super::PublishOptions;
use super::publish_names::unique_file_names;
use super::publish_source::MovementSource;

/// The most minimal pairs that a sign lists.
const MAX_ENTRY_PAIRS: usize = 40;

/// Texts with their languages.
type EntryTexts = Vec<(String, String)>;

/// A sign of the dictionary.
pub(super) struct DictionaryEntry {
    pub(super) gloss: String,
    /// The name of its folder.
    pub(super) name: String,
    /// Translations, as language and text: those of the lexicon, then those annotated for the shown token alone.
    pub(super) texts: EntryTexts,
    /// Sentences in which the shown token is signed, as language and text.
    pub(super) sentences: EntryTexts,
    /// The notation as HamNoSys, if there is one.
    pub(super) notation: Option<String>,
    /// The attributes of the lexicon's rows, and measures.
    pub(super) attributes: Vec<AttributeRow>,
    /// Remarks, if they were asked for.
    pub(super) notes: Option<String>,
    pub(super) token: TokenRow,
    pub(super) values: Vec<TokenValueRow>,
    /// The values by field, successive ones together.
    pub(super) coding: BTreeMap<String, String>,
    /// The terms of use of everything that is shown.
    pub(super) terms: BTreeSet<String>,
    /// The number of the signer in this dictionary.
    pub(super) person: Option<usize>,
    /// Whether it has movement, and whether that may be shown.
    pub(super) moves: EntryMovement,
    /// What its movement comes from.
    pub(super) source: MovementSource,
    /// Minimal pairs: the other entry, and the field in which they differ.
    pub(super) pairs: Vec<(usize, String)>,
    /// Relations to other entries: the name of each, and the other entry.
    pub(super) relations: Vec<(String, usize)>,
}

/// Whether a sign's movement is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum EntryMovement {
    /// The sign has no movement.
    Never,
    /// The sign has no movement, but the token of this row has a notation, from which movement can be generated.
    Notated(i64),
    /// The movement may not be shown.
    Withheld,
    /// The movement may be shown.
    Public,
}

/// The signs of a dictionary, and those that were left out.
pub(super) struct DictionaryEntries {
    pub(super) all: Vec<DictionaryEntry>,
    /// The signs that were left out, with the reason.
    pub(super) withheld: Vec<(String, WithheldReason)>,
    /// The signs whose movement was left out, with the reason.
    pub(super) still: Vec<(String, WithheldReason)>,
    /// The signs that are shown without the words and values of their lexicon, with the reason.
    pub(super) unlicensed: Vec<(String, WithheldReason)>,
    /// The number of signers.
    pub(super) people: usize,
    /// Whether there are too many minimal pairs to list them.
    pub(super) without_pairs: bool,
}

/// Collects the signs of the tokens that answer a query, of all signs without one.
pub(super) fn collect_dictionary_entries(
    corpus: &mut Corpus,
    query: Option<&str>,
    options: &PublishOptions,
    permissions: &PublishPermissions,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<DictionaryEntries> {
    let asked = tokens_by_sign_name(corpus, query, &options.scope, progress)?;
    let connection = corpus.store.read_connection();
    let mut entries = DictionaryEntries {
        all: Vec::new(),
        withheld: Vec::new(),
        still: Vec::new(),
        unlicensed: Vec::new(),
        people: 0,
        without_pairs: false,
    };
    let mut people: BTreeMap<(bool, i64), usize> = BTreeMap::new();
    let reader = CodingReader::in_standing_words(corpus)?;
    for (gloss, tokens) in asked {
        let rows = LexiconRows::from_tokens(&tokens, permissions);
        let (token, mut terms, movement) = match choose_shown_token(corpus, tokens, permissions)? {
            Ok(chosen) => chosen,
            Err(reason) => {
                entries.withheld.push((gloss, reason));
                continue;
            }
        };
        // Signers are numbered in the order of their signs, so that no name of theirs is published.
        let person_id = token
            .recording_id
            .and_then(|recording| permissions.recording_person_key(recording));
        let person = person_id.map(|id| {
            let next = people.len() + 1;
            *people.entry(id).or_insert(next)
        });
        // A page has the terms of all that it shows.
        terms.extend(rows.terms);
        if let Some(reason) = rows.withheld {
            entries.unlicensed.push((gloss.clone(), reason));
        }
        let licensed_tokens = rows.licensed.iter().filter(|id| **id != token.id);
        let own_tokens: Vec<i64> = [&token.id].into_iter().chain(licensed_tokens).copied().collect();
        let mut notated = None;
        for id in &own_tokens {
            notated = notation::notation_of_token(connection, *id)?;
            if notated.is_some() {
                break;
            }
        }
        let mut attributes = stored_attributes::of_tokens(connection, &own_tokens)?;
        let moves = match movement {
            Some(Ok(more)) => {
                terms.extend(more);
                EntryMovement::Public
            }
            Some(Err(reason)) => {
                // A sign whose movement is private can still be shown with its words and values.
                entries.still.push((gloss.clone(), reason));
                match token.recording_id {
                    Some(_) => EntryMovement::Withheld,
                    None => EntryMovement::Never,
                }
            }
            None => notated
                .as_ref()
                .map_or(EntryMovement::Never, |notated| EntryMovement::Notated(notated.token)),
        };
        let values = entry_values(connection, &token, &own_tokens)?;
        let (texts, sentences) = entry_translations(connection, &token, rows.withheld.is_none())?;
        let remarks = edits::sign_gloss_and_notes(connection, token.sign_id)?.1;
        entries.all.push(DictionaryEntry {
            name: String::new(),
            texts,
            sentences,
            notation: notated.map(|notated| match notated.text {
                Some(text) => text,
                None => notated.document.hamnosys_text().text,
            }),
            attributes: own_tokens
                .iter()
                .filter_map(|id| attributes.remove(id))
                .flatten()
                .collect(),
            notes: remarks.filter(|_| options.notes),
            coding: reader.coding_from_values(&token, &values)?,
            values,
            source: match moves {
                EntryMovement::Notated(_) => MovementSource::Notation,
                _ => MovementSource::movement_source_of_token(connection, &token)?,
            },
            token,
            gloss,
            terms,
            person,
            moves,
            pairs: Vec::new(),
            relations: Vec::new(),
        });
    }
    name_folders(&mut entries.all);
    entries.people = people.len();
    entries.without_pairs = !add_pairs(&mut entries.all);
    add_relations(corpus.store.read_connection(), &mut entries)?;
    Ok(entries)
}

/// The rows of lexicons that describe a sign, as far as they may be published.
struct LexiconRows {
    /// Their tokens.
    licensed: Vec<i64>,
    /// The terms of their lexicons.
    terms: BTreeSet<String>,
    /// The reason if a row may not be published.
    withheld: Option<WithheldReason>,
}

impl LexiconRows {
    fn from_tokens(tokens: &[TokenRow], permissions: &PublishPermissions) -> Self {
        let (mut licensed, mut terms, mut withheld) = (Vec::new(), BTreeSet::new(), None);
        for token in tokens.iter().filter(|token| token.recording_id.is_none()) {
            match permissions.entry_publish_terms(token.lexicon.as_deref()) {
                Ok(more) => {
                    licensed.push(token.id);
                    terms.extend(more);
                }
                Err(reason) => withheld = Some(reason),
            }
        }
        Self {
            licensed,
            terms,
            withheld,
        }
    }
}

/// Returns the words for a token's sign, if those of its lexicon are public, and the sentences in which the token is
/// signed, each once.
fn entry_translations(
    connection: &Connection,
    token: &TokenRow,
    with_lexicon: bool,
) -> CorpusResult<(EntryTexts, EntryTexts)> {
    let mut words = match with_lexicon {
        true => signs::list_sign_translations(connection, token.sign_id)?,
        false => EntryTexts::new(),
    };
    let mut sentences = EntryTexts::new();
    for annotated in stored_spans::translations_over_token(connection, token.id)? {
        let texts = match annotated.other_signs {
            0 => &mut words,
            _ => &mut sentences,
        };
        let folded = fold_text(&annotated.text);
        if texts.iter().all(|(_, text)| fold_text(text) != folded) {
            texts.push((annotated.language, annotated.text));
        }
    }
    for (language, _) in words.iter_mut().chain(&mut sentences) {
        // Pages name languages as browsers do, which choose the voice and the letters by it.
        if let Some(code) = short_language_code(&language.to_lowercase()) {
            *language = code.to_owned();
        }
    }
    Ok((words, sentences))
}

/// Names the folder of each sign. Only the signs of the dictionary count: the mark of a name would show that another
/// sign exists, which may not be public.
fn name_folders(entries: &mut [DictionaryEntry]) {
    let folder_names = unique_file_names(entries.iter().map(|entry| entry.gloss.as_str()));
    let named: Vec<String> = entries
        .iter()
        .map(|entry| folder_names.get(entry.gloss.as_str()).cloned().unwrap_or_default())
        .collect();
    for (entry, name) in entries.iter_mut().zip(named) {
        entry.name = name;
    }
}

/// Returns the tokens to choose from, by the gloss of the sign; signs of several lexicons with one gloss have the name of
/// the lexicon behind it.
fn tokens_by_sign_name(
    corpus: &mut Corpus,
    query: Option<&str>,
    scope: &LexiconScope,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<BTreeMap<String, Vec<TokenRow>>> {
    let tokens = match query {
        Some(query) => {
            let all = SearchOptions {
                // A dictionary has all signs that the query finds, not only the first page of them.
                limit: None,
                facets: false,
                ..SearchOptions::default()
            };
            let answer = corpus.search_until(query, &all, progress)?;
            let ids: Vec<i64> = answer.hits.iter().map(|hit| hit.token).collect();
            signs::load_token_rows(corpus.store.read_connection(), &ids)?
                .into_values()
                .collect()
        }
        None => {
            let mut all = Vec::new();
            for citation in signs::load_citation_tokens(corpus.store.read_connection())? {
                all.extend(signs::tokens_of_sign(corpus.store.read_connection(), citation.sign_id)?);
            }
            all
        }
    };
    let connection = corpus.store.read_connection();
    let tokens = keep_scope_rows(connection, scope, tokens, |token| token.sign_id)?;
    let mut by_gloss: BTreeMap<String, BTreeMap<i64, Vec<TokenRow>>> = BTreeMap::new();
    for token in tokens {
        let signs = by_gloss.entry(token.gloss.clone()).or_default();
        signs.entry(token.sign_id).or_default().push(token);
    }
    let mut by_name = BTreeMap::new();
    for (gloss, signs) in by_gloss {
        // A lexicon's name behind each gloss would only disturb where the gloss is clear without it.
        let has_namesakes = signs.len() > 1;
        for (sign, tokens) in signs {
            let lexicon = match has_namesakes {
                true => lexicons::lexicon_name_of_sign(connection, sign)?,
                false => None,
            };
            let name = lexicon.map_or(gloss.clone(), |lexicon| format!("{gloss} ({lexicon})"));
            by_name.entry(name).or_insert_with(Vec::new).extend(tokens);
        }
    }
    Ok(by_name)
}

type UsageTerms = BTreeSet<String>;
/// A token, its terms, and those of its movement: nothing if it has none, the reason if it may not be shown.
type ChosenToken = (
    TokenRow,
    UsageTerms,
    Option<std::result::Result<UsageTerms, WithheldReason>>,
);

/// Returns the first token that may be shown: one that moves before one that does not, the citation form before others.
fn choose_shown_token(
    corpus: &Corpus,
    mut tokens: Vec<TokenRow>,
    permissions: &PublishPermissions,
) -> CorpusResult<std::result::Result<ChosenToken, WithheldReason>> {
    // The id comes last so that the same corpus always gives the same choice.
    tokens.sort_by_key(|token| (!token.citation, token.recording_id.is_none(), token.id));
    let mut best: Option<ChosenToken> = None;
    let mut reason = None;
    for token in tokens {
        let recording_terms = match token.recording_id {
            Some(recording) => permissions.recording_publish_terms(recording, ConsentKind::Annotation),
            None => permissions.entry_publish_terms(token.lexicon.as_deref()),
        };
        let terms = match recording_terms {
            Ok(terms) => terms,
            Err(why) => {
                // The first reason is that of the preferred token, which is the one to be mended.
                reason.get_or_insert(why);
                continue;
            }
        };
        let movement = match token.recording_id {
            Some(recording) if has_body(corpus, recording)? => {
                Some(permissions.recording_publish_terms(recording, ConsentKind::Movement))
            }
            _ => None,
        };
        if matches!(movement, Some(Ok(_))) {
            return Ok(Ok((token, terms, movement)));
        }
        // A later token may still move, so the search goes on.
        best.get_or_insert((token, terms, movement));
    }
    if let (Some((_, _, movement @ None)), Some(reason)) = (&mut best, reason) {
        // Another token moves, and may not be shown.
        *movement = Some(Err(reason));
    }
    Ok(best.ok_or(reason.unwrap_or(WithheldReason::NoTerms)))
}

/// Returns the values of a dictionary's entry by component, from the shown token, which comes first, and its rows in
/// lexicons: those that somebody coded before those that notation implies.
fn entry_values(connection: &Connection, token: &TokenRow, own_tokens: &[i64]) -> CorpusResult<Vec<TokenValueRow>> {
    let mut sources = Vec::new();
    for &id in own_tokens {
        let is_implied = notations::find_token_notation(connection, id)?.is_some()
            // A generated movement was made from values, so its own values are no observation.
            || id == token.id && token.origin == RecordOrigin::Generated;
        sources.push((is_implied, id));
    }
    // The sort is stable, so the shown token stays before those of the lexicon.
    sources.sort_by_key(|(is_implied, _)| *is_implied);
    let mut values: Vec<TokenValueRow> = Vec::new();
    for (_, id) in sources {
        let valued: BTreeSet<SignComponent> = values
            .iter()
            .filter(|row| row.state != ValueState::Unset)
            .map(|row| row.component)
            .collect();
        let rows = signs::load_token_values(connection, id)?;
        values.extend(rows.into_iter().filter(|row| !valued.contains(&row.component)));
    }
    Ok(values)
}

fn has_body(corpus: &Corpus, recording: i64) -> CorpusResult<bool> {
    Ok(stored_recordings::body_track(corpus.store.read_connection(), recording)?.is_some())
}

/// Adds the relations between entries whose lexicons have terms.
fn add_relations(connection: &Connection, entries: &mut DictionaryEntries) -> CorpusResult<()> {
    let unlicensed: BTreeSet<&String> = entries.unlicensed.iter().map(|(gloss, _)| gloss).collect();
    let licensed = entries.all.iter().enumerate();
    let places: BTreeMap<i64, usize> = licensed
        .filter(|(_, entry)| !unlicensed.contains(&entry.gloss))
        .map(|(place, entry)| (entry.token.sign_id, place))
        .collect();
    for row in sign_relations::load_sign_relations(connection, None)? {
        if let [Some(&own), Some(&other)] = [row.sign_id, row.related_id].map(|sign| places.get(&sign)) {
            entries.all[own].relations.push((row.relation, other));
        }
    }
    Ok(())
}

/// Adds the minimal pairs; returns whether there are few enough of them.
fn add_pairs(entries: &mut [DictionaryEntry]) -> bool {
    let codings: Vec<(String, BTreeMap<String, String>)> = entries
        .iter()
        .map(|entry| (entry.gloss.clone(), entry.coding.clone()))
        .collect();
    let Some(found) = pairs::of_codings(&codings) else {
        return false;
    };
    let places: BTreeMap<&str, usize> = codings
        .iter()
        .enumerate()
        .map(|(at, (gloss, _))| (gloss.as_str(), at))
        .collect();
    for pair in &found.list {
        let ends = [&pair.a, &pair.b].map(|gloss| places.get(gloss.as_str()).copied());
        // A pair counts for both of its signs.
        if let [Some(a), Some(b)] = ends {
            for (one, other) in [(a, b), (b, a)] {
                let entry_pairs = &mut entries[one].pairs;
                if entry_pairs.len() < MAX_ENTRY_PAIRS {
                    entry_pairs.push((other, pair.field.clone()));
                }
            }
        }
    }
    true
}
