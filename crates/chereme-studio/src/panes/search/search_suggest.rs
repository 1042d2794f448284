//! Completions of a query: words of the language, values, names and glosses.

use chereme_corpus::{KeptSearch, StoredInventory};
use chereme_sign::query::{
    CursorCompletion, ExpectedText, MissingReason, TextField, WholeTokenProperty, complete_query,
};
use chereme_sign::text::fold_text;
use chereme_sign::{ComponentField, SignComponent};

use crate::model::CorpusSnapshot;
use crate::panes::library::library_data::origin_named;
use crate::words::{InterfaceLanguage, library, search_words};

/// The most completions.
const MAX_QUERY_COMPLETIONS: usize = 10;

/// A possible completion.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct QueryCompletion {
    /// The text to write, in quotes if it needs them.
    pub(crate) text: String,
    /// Its meaning, if it differs from the text.
    pub(crate) about: String,
}

/// Completions, and the range of characters that each replaces.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct CompletionOffers {
    pub(crate) replace: std::ops::Range<usize>,
    pub(crate) all: Vec<QueryCompletion>,
}

impl CompletionOffers {
    /// Returns the query with a completion, and the index of the cursor after it.
    pub(crate) fn apply_completion_offer(&self, query: &str, offer: &QueryCompletion) -> (String, usize) {
        let before: String = query.chars().take(self.replace.start).collect();
        let after: String = query.chars().skip(self.replace.end).collect();
        let cursor = self.replace.start + offer.text.chars().count();
        (format!("{before}{}{after}", offer.text), cursor)
    }
}

/// Returns the completions in `query` at the character index `cursor`; none if the present word is already complete.
pub(crate) fn find_query_completions(
    query: &str,
    cursor: usize,
    snapshot: &CorpusSnapshot,
    language: InterfaceLanguage,
) -> CompletionOffers {
    if let Some(name) = kept_name(query) {
        return find_saved_search_offers(query, name, snapshot);
    }
    let completion = complete_query(query, cursor);
    let mut all: Vec<QueryCompletion> = completion
        .words
        .iter()
        .map(|word| QueryCompletion {
            text: with_operator(word, &completion.expected),
            about: match &completion.expected {
                ExpectedText::Value(field) if *word == "*" && field.feature.is_none() => {
                    search_words::MAIN_VALUE.text_in_language(language).to_owned()
                }
                _ => String::new(),
            },
        })
        .collect();
    all.extend(completion_value_offers(&completion, snapshot, language));
    let written: String = query
        .chars()
        .skip(completion.replace.start)
        .take(completion.replace.len())
        .collect();
    if all.iter().any(|offer| offer.text == written) && !written.is_empty() {
        all.clear();
    }
    all.truncate(MAX_QUERY_COMPLETIONS);
    CompletionOffers {
        replace: completion.replace,
        all,
    }
}

/// Returns the name of a saved search, if a query consists of one: `@NAME`.
pub(super) fn kept_name(query: &str) -> Option<&str> {
    query.trim().strip_prefix('@')
}

/// Returns whether a query is the name of a saved search that does not exist.
pub(super) fn is_unkept(query: &str, snapshot: &CorpusSnapshot) -> bool {
    kept_name(query).is_some() && kept_query(query, snapshot).is_none()
}

/// Returns the query of a saved search, if `query` is its name.
pub(crate) fn kept_query<'a>(query: &str, snapshot: &'a CorpusSnapshot) -> Option<&'a str> {
    let name = fold_text(kept_name(query)?.trim());
    let mut all = snapshot.overview.searches.iter();
    let search = all.find(|it| fold_text(&it.name) == name);
    search.map(|it| it.query.as_str())
}

/// Returns the saved searches whose name contains the typed text; each completes to its query.
fn find_saved_search_offers(query: &str, name: &str, snapshot: &CorpusSnapshot) -> CompletionOffers {
    let wanted = fold_text(name.trim());
    let searches = snapshot.overview.searches.iter();
    let fitting = searches.filter(|search| fold_text(&search.name).contains(&wanted));
    let offer = |search: &KeptSearch| QueryCompletion {
        text: search.query.clone(),
        about: format!("@{}", search.name),
    };
    CompletionOffers {
        replace: 0..query.chars().count(),
        all: fitting.take(MAX_QUERY_COMPLETIONS).map(offer).collect(),
    }
}

/// Appends the operator to a field's name, as a field without it is useless.
fn with_operator(word: &str, expected: &ExpectedText) -> String {
    let field = matches!(expected, ExpectedText::Term | ExpectedText::Annotation)
        && (word.parse::<ComponentField>().is_ok()
            || matches!(
                word,
                "gloss" | "translation" | "comment" | "origin" | "signer" | "recording" | "sign" | "hand" | "inventory"
            ));
    if field { format!("{word}=") } else { word.to_owned() }
}

fn completion_value_offers(
    completion: &CursorCompletion,
    snapshot: &CorpusSnapshot,
    language: InterfaceLanguage,
) -> Vec<QueryCompletion> {
    let overview = &snapshot.overview;
    let mut offers: Vec<(bool, QueryCompletion)> = Vec::new();
    let mut fields: Vec<QueryCompletion> = Vec::new();
    let wanted = fold_text(&completion.prefix);
    let mut add = |spellings: &[&str], text: &str, about: String| {
        let folded = |spelling: &&str| fold_text(spelling);
        let starts = spellings
            .iter()
            .map(folded)
            .any(|spelling| spelling.starts_with(&wanted));
        if starts || spellings.iter().map(folded).any(|spelling| spelling.contains(&wanted)) {
            let text = quote_query_value(text);
            offers.push((!starts, QueryCompletion { text, about }));
        }
    };
    match &completion.expected {
        ExpectedText::Value(field) => {
            let fits = overview.inventories.iter().filter(|stored| {
                stored.inventory.component == field.component && stored.inventory.feature == field.feature
            });
            let fits: Vec<&StoredInventory> = fits.collect();
            let listed = || fits.iter().map(|stored| &stored.inventory);
            let each = listed().flat_map(|inventory| inventory.values.iter().map(move |value| (inventory, value)));
            for (inventory, value) in each {
                // A value that is one with another is offered under the word that stands for both.
                if overview.equal_values.has_stand_in(listed(), &inventory.id, &value.id) {
                    continue;
                }
                let spellings: Vec<&str> = value.value_spellings().collect();
                let name = value.value_name_in(language.language_code());
                let about = if name == value.id { "" } else { name };
                add(&spellings, &value.id, about.to_owned());
            }
            for missing in MissingReason::ALL_MISSING_REASONS {
                add(
                    &[missing.missing_reason_name()],
                    missing.missing_reason_name(),
                    String::new(),
                );
            }
        }
        ExpectedText::Feature(field) => {
            let fits = overview.inventories.iter().filter(|stored| {
                stored.inventory.component == field.component && stored.inventory.feature == field.feature
            });
            for feature in fits.flat_map(|stored| stored.inventory.feature_names()) {
                add(&[feature], feature, String::new());
            }
        }
        ExpectedText::Property(WholeTokenProperty::Signer) => {
            for signer in &overview.signers {
                add(&[&signer.name], &signer.name, String::new());
            }
        }
        ExpectedText::Property(WholeTokenProperty::Origin) => {
            for id in WholeTokenProperty::Origin.fixed_values().unwrap_or_default() {
                let Some(text) = origin_named(id) else {
                    continue;
                };
                let name = text.text_in_language(language);
                let also = if *id == "lexicon" {
                    library::NOTATED.text_in_language(language)
                } else {
                    name
                };
                add(&[id, name, also], id, name.to_owned());
            }
        }
        ExpectedText::Property(WholeTokenProperty::Recording) => {
            for it in &overview.recordings {
                add(&[&it.row.name], &it.row.name, String::new());
            }
        }
        ExpectedText::Property(WholeTokenProperty::Lexicon) => {
            for lexicon in &overview.lexicons {
                add(&[&lexicon.name], &lexicon.name, String::new());
            }
        }
        ExpectedText::Property(WholeTokenProperty::Language) => {
            for lexicon in &overview.lexicons {
                let code = lexicon.language.as_deref().unwrap_or_default();
                add(&[code, &lexicon.name], code, lexicon.name.clone());
            }
        }
        ExpectedText::Property(WholeTokenProperty::Inventory) => {
            for it in &overview.inventories {
                add(&[&it.inventory.id], &it.inventory.id, String::new());
            }
        }
        ExpectedText::TierName | ExpectedText::Property(WholeTokenProperty::Tier) => {
            let open = snapshot.open.iter();
            for tier in open.flat_map(|open| &open.contents.tiers) {
                add(&[&tier.row.name], &tier.row.name, String::new());
            }
        }
        ExpectedText::Text(TextField::Gloss)
        | ExpectedText::Property(WholeTokenProperty::Sign)
        | ExpectedText::Example => {
            for sign in &overview.signs {
                add(&[&sign.gloss], &sign.gloss, String::new());
            }
        }
        ExpectedText::Part(component) => {
            let fits = overview.inventories.iter();
            for it in fits.filter(|stored| stored.inventory.component == *component) {
                if let Some(feature) = &it.inventory.feature {
                    add(&[feature], feature, String::new());
                }
            }
        }
        ExpectedText::Term if completion.prefix.chars().count() > 1 => {
            for component in SignComponent::ALL_COMPONENTS {
                let name = component.component_name();
                let other = |alias: &str| alias != name && fold_text(alias).starts_with(&wanted);
                if !fold_text(name).starts_with(&wanted)
                    && component.component_spellings().iter().any(|alias| other(alias))
                {
                    fields.push(QueryCompletion {
                        text: format!("{name}="),
                        about: component.component_spellings().join(", "),
                    });
                }
            }
            for sign in &overview.signs {
                add(&[&sign.gloss], &sign.gloss, String::new());
            }
        }
        _ => {}
    }
    offers.sort_by_key(|(later, _)| *later);
    let mut all = fields;
    for (_, offer) in offers {
        if !all.iter().any(|earlier| earlier.text == offer.text) {
            all.push(offer);
        }
    }
    all
}

/// Returns a value in the notation of queries, in quotes if necessary.
pub(super) fn quote_query_value(text: &str) -> String {
    super::search_builder::with_value("", "", text)[1..].to_owned()
}

#[cfg(test)]
mod tests {
    use chereme_sign::query::TokenQuery;

    use super::*;
    use chereme_corpus::{CorpusOverview, SignGlance};
    use std::sync::Arc;

    fn snapshot() -> CorpusSnapshot {
        let inventories = chereme_sign::inventory::builtin_inventories()
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
        let overview = CorpusOverview {
            inventories,
            signs: vec![sign("ESCARGOT"), sign("BON APPETIT")],
            searches: vec![KeptSearch {
                name: "À la tête".into(),
                query: "placement=head".into(),
            }],
            ..CorpusOverview::default()
        };
        CorpusSnapshot {
            overview: Arc::new(overview),
            open: None,
        }
    }

    fn first(query: &str) -> Option<String> {
        let snapshot = snapshot();
        let offers = find_query_completions(query, query.chars().count(), &snapshot, InterfaceLanguage::English);
        let offer = offers.all.first()?;
        Some(offers.apply_completion_offer(query, offer).0)
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
            let query: TokenQuery = format!("origin={word:?}").parse().expect(word);
            query.to_string()
        };
        for (language, _) in InterfaceLanguage::BUILTIN_LANGUAGES {
            for id in WholeTokenProperty::Origin.fixed_values().expect("origins") {
                let name = origin_named(id).expect("a name").text_in_language(language);
                assert_eq!(written(name), format!("origin={id}"), "{name}");
            }
            assert_eq!(written(library::NOTATED.text_in_language(language)), "origin=lexicon");
        }
        assert!("origin=nonsense".parse::<TokenQuery>().is_err());
    }

    #[test]
    fn suggestions_repeat_neither_the_query_nor_each_other() {
        assert_eq!(first("placement=chin"), None);
        let snapshot = snapshot();
        let all = find_query_completions("placement=", 10, &snapshot, InterfaceLanguage::French).all;
        let any = all.iter().find(|it| it.text == "*");
        assert!(any.is_some_and(|it| it.about.starts_with("une valeur principale")));
        assert_eq!(all.len(), MAX_QUERY_COMPLETIONS);
        let (text, cursor) = {
            let offers = find_query_completions("placement=ch gloss=A", 12, &snapshot, InterfaceLanguage::English);
            let chin = offers.all.iter().find(|it| it.text == "chin").cloned();
            offers.apply_completion_offer("placement=ch gloss=A", &chin.expect("the chin"))
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
