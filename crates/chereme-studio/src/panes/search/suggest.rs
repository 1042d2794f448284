//! Completions of a query: words of the language, values, names and glosses.

use chereme_corpus::KeptSearch;
use chereme_sign::query::{Completion, Expected, Missing, Property, TextField, complete};
use chereme_sign::text::fold;
use chereme_sign::{Component, Field};

use crate::model::Snapshot;
use crate::panes::library::data::origin_named;
use crate::words::{Language, library, search};

/// The most completions.
const MOST: usize = 10;

/// A possible completion.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Offer {
    /// The text to write, in quotes if it needs them.
    pub(crate) text: String,
    /// Its meaning, if it differs from the text.
    pub(crate) about: String,
}

/// Completions, and the range of characters that each replaces.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Offers {
    pub(crate) replace: std::ops::Range<usize>,
    pub(crate) all: Vec<Offer>,
}

impl Offers {
    /// Returns the query with a completion, and the index of the cursor after it.
    pub(crate) fn take(&self, query: &str, offer: &Offer) -> (String, usize) {
        let before: String = query.chars().take(self.replace.start).collect();
        let after: String = query.chars().skip(self.replace.end).collect();
        let cursor = self.replace.start + offer.text.chars().count();
        (format!("{before}{}{after}", offer.text), cursor)
    }
}

/// Returns the completions in `query` at the character index `cursor`; none if the present word is already complete.
pub(crate) fn offers(
    query: &str,
    cursor: usize,
    snapshot: &Snapshot,
    language: Language,
) -> Offers {
    if let Some(name) = kept_name(query) {
        return kept(query, name, snapshot);
    }
    let completion = complete(query, cursor);
    let mut all: Vec<Offer> = completion
        .words
        .iter()
        .map(|word| Offer {
            text: with_operator(word, &completion.expected),
            about: match &completion.expected {
                Expected::Value(field) if *word == "*" && field.feature.is_none() => {
                    search::MAIN_VALUE.of(language).to_owned()
                }
                _ => String::new(),
            },
        })
        .collect();
    all.extend(names(&completion, snapshot, language));
    let written: String = query
        .chars()
        .skip(completion.replace.start)
        .take(completion.replace.len())
        .collect();
    if all.iter().any(|offer| offer.text == written) && !written.is_empty() {
        all.clear();
    }
    all.truncate(MOST);
    Offers {
        replace: completion.replace,
        all,
    }
}

/// Returns the name of a saved search, if a query consists of one: `@NAME`.
pub(super) fn kept_name(query: &str) -> Option<&str> {
    query.trim().strip_prefix('@')
}

/// Returns whether a query is the name of a saved search that does not exist.
pub(super) fn is_unkept(query: &str, snapshot: &Snapshot) -> bool {
    kept_name(query).is_some() && kept_query(query, snapshot).is_none()
}

/// Returns the query of a saved search, if `query` is its name.
pub(crate) fn kept_query<'a>(query: &str, snapshot: &'a Snapshot) -> Option<&'a str> {
    let name = fold(kept_name(query)?.trim());
    let mut all = snapshot.overview.searches.iter();
    let found = all.find(|it| fold(&it.name) == name);
    found.map(|it| it.query.as_str())
}

/// Returns the saved searches whose name contains the typed text; each completes to its query.
fn kept(query: &str, name: &str, snapshot: &Snapshot) -> Offers {
    let wanted = fold(name.trim());
    let searches = snapshot.overview.searches.iter();
    let fitting = searches.filter(|it| fold(&it.name).contains(&wanted));
    let offer = |it: &KeptSearch| Offer {
        text: it.query.clone(),
        about: format!("@{}", it.name),
    };
    Offers {
        replace: 0..query.chars().count(),
        all: fitting.take(MOST).map(offer).collect(),
    }
}

/// Appends the operator to a field's name, as a field without it is useless.
fn with_operator(word: &str, expected: &Expected) -> String {
    let field = matches!(expected, Expected::Term | Expected::Annotation)
        && (word.parse::<Field>().is_ok()
            || matches!(
                word,
                "gloss"
                    | "translation"
                    | "comment"
                    | "origin"
                    | "signer"
                    | "recording"
                    | "sign"
                    | "hand"
                    | "inventory"
            ));
    if field {
        format!("{word}=")
    } else {
        word.to_owned()
    }
}

fn names(completion: &Completion, snapshot: &Snapshot, language: Language) -> Vec<Offer> {
    let overview = &snapshot.overview;
    let mut found: Vec<(bool, Offer)> = Vec::new();
    let mut fields: Vec<Offer> = Vec::new();
    let wanted = fold(&completion.prefix);
    let mut add = |spellings: &[&str], text: &str, about: String| {
        let folded = |it: &&str| fold(it);
        let starts = spellings
            .iter()
            .map(folded)
            .any(|it| it.starts_with(&wanted));
        if starts || spellings.iter().map(folded).any(|it| it.contains(&wanted)) {
            let text = quoted(text);
            found.push((!starts, Offer { text, about }));
        }
    };
    match &completion.expected {
        Expected::Value(field) => {
            let fits = overview.inventories.iter().filter(|it| {
                it.inventory.component == field.component && it.inventory.feature == field.feature
            });
            for value in fits.flat_map(|it| &it.inventory.values) {
                let spellings: Vec<&str> = value.spellings().collect();
                let name = value.name(language.code());
                let about = if name == value.id { "" } else { name };
                add(&spellings, &value.id, about.to_owned());
            }
            for missing in Missing::ALL {
                add(&[missing.name()], missing.name(), String::new());
            }
        }
        Expected::Feature(field) => {
            let fits = overview.inventories.iter().filter(|it| {
                it.inventory.component == field.component && it.inventory.feature == field.feature
            });
            for feature in fits.flat_map(|it| it.inventory.features()) {
                add(&[feature], feature, String::new());
            }
        }
        Expected::Property(Property::Signer) => {
            for signer in &overview.signers {
                add(&[&signer.name], &signer.name, String::new());
            }
        }
        Expected::Property(Property::Origin) => {
            for id in Property::Origin.fixed_values().unwrap_or_default() {
                let Some(text) = origin_named(id) else {
                    continue;
                };
                let name = text.of(language);
                let also = if *id == "lexicon" {
                    library::NOTATED.of(language)
                } else {
                    name
                };
                add(&[id, name, also], id, name.to_owned());
            }
        }
        Expected::Property(Property::Recording) => {
            for it in &overview.recordings {
                add(&[&it.row.name], &it.row.name, String::new());
            }
        }
        Expected::Property(Property::Inventory) => {
            for it in &overview.inventories {
                add(&[&it.inventory.id], &it.inventory.id, String::new());
            }
        }
        Expected::TierName | Expected::Property(Property::Tier) => {
            let open = snapshot.open.iter();
            for tier in open.flat_map(|open| &open.contents.tiers) {
                add(&[&tier.row.name], &tier.row.name, String::new());
            }
        }
        Expected::Text(TextField::Gloss)
        | Expected::Property(Property::Sign)
        | Expected::Example => {
            for sign in &overview.signs {
                add(&[&sign.gloss], &sign.gloss, String::new());
            }
        }
        Expected::Part(component) => {
            let fits = overview.inventories.iter();
            for it in fits.filter(|it| it.inventory.component == *component) {
                if let Some(feature) = &it.inventory.feature {
                    add(&[feature], feature, String::new());
                }
            }
        }
        Expected::Term if completion.prefix.chars().count() > 1 => {
            for component in Component::ALL {
                let name = component.name();
                let other = |it: &str| it != name && fold(it).starts_with(&wanted);
                if !fold(name).starts_with(&wanted) && component.names().iter().any(|it| other(it))
                {
                    fields.push(Offer {
                        text: format!("{name}="),
                        about: component.names().join(", "),
                    });
                }
            }
            for sign in &overview.signs {
                add(&[&sign.gloss], &sign.gloss, String::new());
            }
        }
        _ => {}
    }
    found.sort_by_key(|(later, _)| *later);
    let mut all = fields;
    for (_, offer) in found {
        if !all.iter().any(|it| it.text == offer.text) {
            all.push(offer);
        }
    }
    all
}

/// Returns a value in the notation of queries, in quotes if necessary.
pub(super) fn quoted(text: &str) -> String {
    super::builder::with_value("", "", text)[1..].to_owned()
}

#[cfg(test)]
mod tests {
    use chereme_sign::query::Query;

    use super::*;
    use chereme_corpus::{Overview, SignGlance, StoredInventory};
    use std::sync::Arc;

    fn snapshot() -> Snapshot {
        let inventories = chereme_sign::inventory::builtin()
            .iter()
            .map(|inventory| StoredInventory {
                id: 1,
                inventory: inventory.clone(),
            })
            .collect();
        let sign = |gloss: &str| SignGlance {
            id: 1,
            gloss: gloss.to_owned(),
            tokens: 1,
            ..SignGlance::default()
        };
        let overview = Overview {
            inventories,
            signs: vec![sign("ESCARGOT"), sign("BON APPETIT")],
            searches: vec![KeptSearch {
                name: "À la tête".into(),
                query: "placement=head".into(),
            }],
            ..Overview::default()
        };
        Snapshot {
            overview: Arc::new(overview),
            open: None,
        }
    }

    fn first(query: &str) -> Option<String> {
        let snapshot = snapshot();
        let offers = offers(query, query.chars().count(), &snapshot, Language::English);
        let offer = offers.all.first()?;
        Some(offers.take(query, offer).0)
    }

    #[test]
    fn saved_searches_are_offered_by_name_with_their_query() {
        assert_eq!(first("@TETE").as_deref(), Some("placement=head"));
        let snapshot = snapshot();
        assert_eq!(kept_query("@a la tete", &snapshot), Some("placement=head"));
        assert_eq!(kept_query("@tete", &snapshot), None);
        assert_eq!(kept_query("tete", &snapshot), None);
    }

    #[test]
    fn names_values_and_glosses_are_offered() {
        for (query, wanted) in [
            ("plac", "placement="),
            ("placement=chi", "placement=chin"),
            ("placement=menton", "placement=chin"),
            ("right.conf", "right.configuration="),
            ("configuration=u-be", "configuration=U-bent"),
            ("gloss=bon", "gloss=\"BON APPETIT\""),
            ("esca", "ESCARGOT"),
            ("nonmanual.bro", "nonmanual.brows"),
            ("like esc", "like ESCARGOT"),
            ("origin=ma", "origin=made"),
            ("origin=synth", "origin=made"),
            ("origin=nota", "origin=lexicon"),
            ("handsh", "configuration="),
        ] {
            assert_eq!(first(query).as_deref(), Some(wanted), "{query}");
        }
    }

    #[test]
    fn origins_are_accepted_under_their_names_in_the_window() {
        let written = |word: &str| {
            let query: Query = format!("origin={word:?}").parse().expect(word);
            query.to_string()
        };
        for (language, _) in Language::ALL {
            for id in Property::Origin.fixed_values().expect("origins") {
                let name = origin_named(id).expect("a name").of(language);
                assert_eq!(written(name), format!("origin={id}"), "{name}");
            }
            assert_eq!(written(library::NOTATED.of(language)), "origin=lexicon");
        }
        assert!("origin=nonsense".parse::<Query>().is_err());
    }

    #[test]
    fn suggestions_repeat_neither_the_query_nor_each_other() {
        assert_eq!(first("placement=chin"), None);
        let snapshot = snapshot();
        let all = offers("placement=", 10, &snapshot, Language::French).all;
        let any = all.iter().find(|it| it.text == "*");
        assert!(any.is_some_and(|it| it.about.starts_with("une valeur principale")));
        assert_eq!(all.len(), MOST);
        let (text, cursor) = {
            let offers = offers("placement=ch gloss=A", 12, &snapshot, Language::English);
            let chin = offers.all.iter().find(|it| it.text == "chin").cloned();
            offers.take("placement=ch gloss=A", &chin.expect("the chin"))
        };
        assert_eq!((text.as_str(), cursor), ("placement=chin gloss=A", 14));
    }

    #[test]
    fn only_the_name_of_no_saved_search_is_reported_by_the_field() {
        let snapshot = snapshot();
        for (query, unkept) in [
            ("@nowhere", true),
            (" @nowhere ", true),
            ("@a la tete", false),
            ("placement=head", false),
            ("", false),
        ] {
            assert_eq!(is_unkept(query, &snapshot), unkept, "{query}");
        }
    }
}
