//! The signs of a dictionary: the token that shows each, its words, values and minimal pairs.

use std::collections::{BTreeMap, BTreeSet};

use crate::Corpus;
use crate::consent::{ConsentKind, Permissions, Withheld};
use crate::db::edits;
use crate::db::recordings;
use crate::db::signs::{self, TokenRow, TokenValueRow};
use crate::error::Result;
use crate::pairs;
use crate::progress::Progress;
use crate::search::SearchOptions;

use super::names::names;
use super::source::MovementSource;

/// The most minimal pairs that a sign lists.
const MOST_PAIRS: usize = 40;

/// A sign of the dictionary.
pub(super) struct Entry {
    pub(super) gloss: String,
    /// The name of its folder.
    pub(super) name: String,
    /// Translations, as language and text.
    pub(super) texts: Vec<(String, String)>,
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
    pub(super) moves: Moves,
    /// What its movement comes from.
    pub(super) source: MovementSource,
    /// Minimal pairs: the other entry, and the field in which they differ.
    pub(super) pairs: Vec<(usize, String)>,
}

/// Whether a sign's movement is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Moves {
    /// The sign has no movement.
    Never,
    /// The movement may not be shown.
    Withheld,
    /// The movement may be shown.
    Public,
}

/// The signs of a dictionary, and those that were left out.
pub(super) struct Entries {
    pub(super) all: Vec<Entry>,
    /// The signs that were left out, with the reason.
    pub(super) withheld: Vec<(String, Withheld)>,
    /// The signs whose movement was left out, with the reason.
    pub(super) still: Vec<(String, Withheld)>,
    /// The number of signers.
    pub(super) people: usize,
    /// Whether there are too many minimal pairs to list them.
    pub(super) without_pairs: bool,
}

/// Collects the signs of the tokens that answer a query, of all signs without one.
pub(super) fn collect(
    corpus: &mut Corpus,
    query: Option<&str>,
    permissions: &Permissions,
    notes: bool,
    progress: &mut Progress<'_>,
) -> Result<Entries> {
    let asked = asked(corpus, query, progress)?;
    let connection = corpus.store.read();
    let mut found = Entries {
        all: Vec::new(),
        withheld: Vec::new(),
        still: Vec::new(),
        people: 0,
        without_pairs: false,
    };
    let mut people: BTreeMap<(bool, i64), usize> = BTreeMap::new();
    for (gloss, tokens) in asked {
        let (token, terms, movement) = match choose(corpus, tokens, permissions)? {
            Ok(chosen) => chosen,
            Err(reason) => {
                found.withheld.push((gloss, reason));
                continue;
            }
        };
        let person = token.recording_id.and_then(|it| permissions.person(it));
        let person = person.map(|it| {
            let next = people.len() + 1;
            *people.entry(it).or_insert(next)
        });
        let mut terms = terms;
        let moves = match movement {
            Some(Ok(more)) => {
                terms.extend(more);
                Moves::Public
            }
            Some(Err(reason)) => {
                found.still.push((gloss.clone(), reason));
                match token.recording_id {
                    Some(_) => Moves::Withheld,
                    None => Moves::Never,
                }
            }
            None => Moves::Never,
        };
        let remarks = edits::sign(connection, token.sign_id)?.1;
        found.all.push(Entry {
            name: String::new(),
            texts: signs::texts(connection, token.sign_id)?,
            notes: remarks.filter(|_| notes),
            values: signs::values(connection, token.id)?,
            coding: corpus.coding_of(&token)?,
            source: MovementSource::of_token(connection, &token)?,
            token,
            gloss,
            terms,
            person,
            moves,
            pairs: Vec::new(),
        });
    }
    name_folders(&mut found.all);
    found.people = people.len();
    found.without_pairs = !add_pairs(&mut found.all);
    Ok(found)
}

/// Names the folder of each sign. Only the signs of the dictionary count: the mark of a name would show that another
/// sign exists, which may not be public.
fn name_folders(entries: &mut [Entry]) {
    let named = names(entries.iter().map(|it| it.gloss.as_str()));
    let named: Vec<String> = entries
        .iter()
        .map(|it| named.get(it.gloss.as_str()).cloned().unwrap_or_default())
        .collect();
    for (entry, name) in entries.iter_mut().zip(named) {
        entry.name = name;
    }
}

/// Returns the tokens to choose from, by gloss.
fn asked(
    corpus: &mut Corpus,
    query: Option<&str>,
    progress: &mut Progress<'_>,
) -> Result<BTreeMap<String, Vec<TokenRow>>> {
    let tokens = match query {
        Some(query) => {
            let all = SearchOptions {
                limit: None,
                facets: false,
                ..SearchOptions::default()
            };
            let found = corpus.search_until(query, &all, progress)?;
            let ids: Vec<i64> = found.hits.iter().map(|hit| hit.token).collect();
            signs::tokens(corpus.store.read(), &ids)?
                .into_values()
                .collect()
        }
        None => {
            let mut all = Vec::new();
            for citation in signs::citations(corpus.store.read())? {
                all.extend(signs::tokens_of_sign(
                    corpus.store.read(),
                    citation.sign_id,
                )?);
            }
            all
        }
    };
    let mut by_gloss: BTreeMap<String, Vec<TokenRow>> = BTreeMap::new();
    for token in tokens {
        by_gloss.entry(token.gloss.clone()).or_default().push(token);
    }
    Ok(by_gloss)
}

type Terms = BTreeSet<String>;
/// A token, its terms, and those of its movement: nothing if it has none, the reason if it may not be shown.
type Chosen = (
    TokenRow,
    Terms,
    Option<std::result::Result<Terms, Withheld>>,
);

/// Returns the first token that may be shown: one that moves before one that does not, the citation form before others.
fn choose(
    corpus: &Corpus,
    mut tokens: Vec<TokenRow>,
    permissions: &Permissions,
) -> Result<std::result::Result<Chosen, Withheld>> {
    tokens.sort_by_key(|it| (!it.citation, it.recording_id.is_none(), it.id));
    let mut best: Option<Chosen> = None;
    let mut reason = None;
    for token in tokens {
        let terms = match token.recording_id {
            Some(recording) => permissions.of_recording(recording, ConsentKind::Annotation),
            None => permissions.of_entry(),
        };
        let terms = match terms {
            Ok(terms) => terms,
            Err(why) => {
                reason.get_or_insert(why);
                continue;
            }
        };
        let movement = match token.recording_id {
            Some(recording) if has_body(corpus, recording)? => {
                Some(permissions.of_recording(recording, ConsentKind::Movement))
            }
            _ => None,
        };
        if matches!(movement, Some(Ok(_))) {
            return Ok(Ok((token, terms, movement)));
        }
        best.get_or_insert((token, terms, movement));
    }
    if let (Some((_, _, movement @ None)), Some(reason)) = (&mut best, reason) {
        // Another token moves, and may not be shown.
        *movement = Some(Err(reason));
    }
    Ok(best.ok_or(reason.unwrap_or(Withheld::NoTerms)))
}

fn has_body(corpus: &Corpus, recording: i64) -> Result<bool> {
    Ok(recordings::body_track(corpus.store.read(), recording)?.is_some())
}

/// Adds the minimal pairs; returns whether there are few enough of them.
fn add_pairs(entries: &mut [Entry]) -> bool {
    let codings: Vec<(String, BTreeMap<String, String>)> = entries
        .iter()
        .map(|it| (it.gloss.clone(), it.coding.clone()))
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
        let ends = [&pair.a, &pair.b].map(|it| places.get(it.as_str()).copied());
        if let [Some(a), Some(b)] = ends {
            for (one, other) in [(a, b), (b, a)] {
                let own = &mut entries[one].pairs;
                if own.len() < MOST_PAIRS {
                    own.push((other, pair.field.clone()));
                }
            }
        }
    }
    true
}
