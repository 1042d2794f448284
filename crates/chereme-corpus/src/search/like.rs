//! Search by example: the similarity of tokens to given ones.

use std::collections::BTreeMap;

use chereme_sign::query::{ExampleToken, LikeSearch, QueryError, WeightedComponent};
use chereme_sign::text::{fold_text, nearest_candidate};
use chereme_sign::{ComponentField, ComponentReading, SignComponent, SignPhase};

use super::compile::{QueryContext, QueryResult};
use super::probe::{IndexDocument, IndexProbe};
use crate::address::{self, CorpusAddress, RowName};
use crate::db::signs::TokenRow;
use crate::db::stored_search::search_answers;
use crate::db::stored_search::search_terms::{self, hand_codes, hands_of, phase_counts};

/// The similarity of each document to the examples, from 0 to 1.
///
/// For each component in the comparison, the score is the share of the example's readings that the token has too.
/// Hands are compared by their part in signing unless the component names a side, and a single value is both the
/// first and the last value. Components that the example leaves unset do not count: two unset fields are not equal.
/// Several components are weighted; several examples have equal weight.
pub(crate) struct ExampleScores {
    scores: BTreeMap<IndexDocument, f64>,
    /// For each example, the similarity of documents and the required minimum.
    bars: Vec<(BTreeMap<IndexDocument, f64>, f64)>,
    /// The rows of the examples.
    pub(crate) examples: Vec<i64>,
}

impl ExampleScores {
    /// Scores all documents by these examples; there is at least one.
    pub(crate) fn new(ask: &QueryContext<'_>, likes: &[&LikeSearch]) -> QueryResult<Self> {
        let mut all = Self {
            scores: BTreeMap::new(),
            bars: Vec::new(),
            examples: Vec::new(),
        };
        for like in likes {
            let token = example_token(ask, like)?;
            all.examples.push(token.id);
            let like_scores = score_like_example(ask, like, &token)?;
            for (doc, score) in &like_scores {
                *all.scores.entry(*doc).or_default() += score / likes.len() as f64;
            }
            if let Some(least) = like.above {
                all.bars.push((like_scores, least));
            }
        }
        Ok(all)
    }

    /// Returns the similarity of a document.
    pub(crate) fn document_similarity(&self, doc: IndexDocument) -> f64 {
        self.scores.get(&doc).copied().unwrap_or(0.0).min(1.0)
    }

    /// Returns whether a document reaches the required similarity to each example.
    pub(crate) fn passes_every_example(&self, doc: IndexDocument) -> bool {
        // Shares of a whole are added, which is exact only up to the last few digits.
        const SCORE_SLACK: f64 = 1e-9;
        let mut bars = self.bars.iter();
        bars.all(|(own, least)| own.get(&doc).is_some_and(|score| *score > least + SCORE_SLACK))
    }
}

/// Returns the similarity of each document to one example, from 0 to 1.
fn score_like_example(
    ask: &QueryContext<'_>,
    like: &LikeSearch,
    token: &TokenRow,
) -> QueryResult<BTreeMap<IndexDocument, f64>> {
    let mut scores = BTreeMap::new();
    // Without a choice of components all of them count alike.
    let on: Vec<(ComponentField, f64)> = if like.on.is_empty() {
        SignComponent::ALL_COMPONENTS
            .map(|component| (ComponentField::new(component), 1.0))
            .to_vec()
    } else {
        let weighted = |one: &WeightedComponent| (one.field.clone(), one.weight);
        like.on.iter().map(weighted).collect()
    };
    let slots = example_slots(ask, token)?;
    let counted: Vec<(Vec<&ExampleSlot>, f64)> = on
        .iter()
        .filter_map(|(field, weight)| {
            let field_slots: Vec<&ExampleSlot> = slots.iter().filter(|slot| slot.belongs_to_field(field)).collect();
            // A component that the user named and the example lacks is reported; one of all is no surprise.
            if field_slots.is_empty() && !like.on.is_empty() {
                ask.add_query_note(format!("token:{} has no value of {field}", token.id));
            }
            (!field_slots.is_empty()).then_some((field_slots, *weight))
        })
        .collect();
    // Weights are shares of those that the example has, so that the best score is 1.
    let total: f64 = counted.iter().map(|(_, weight)| weight).sum();
    for (slots, weight) in counted {
        let each = weight / total / slots.len() as f64;
        for slot in slots {
            let probe = IndexProbe::from_reading_terms(slot.slot_terms(ask)?);
            for doc in ask.run_index_probe(&probe)? {
                *scores.entry(doc).or_default() += each;
            }
        }
    }
    Ok(scores)
}

/// One coded value of the example.
struct ExampleSlot {
    hand: char,
    phase: SignPhase,
    component: SignComponent,
    part: Option<String>,
    value: String,
}

impl ExampleSlot {
    fn belongs_to_field(&self, field: &ComponentField) -> bool {
        let hands = hands_of(field.hand);
        self.component == field.component
            && (field.feature.is_none() || self.part == field.feature)
            && field.phase.is_none_or(|phase| phase == self.phase)
            && hands.contains(&self.hand)
    }

    fn slot_terms(&self, ask: &QueryContext<'_>) -> QueryResult<Vec<String>> {
        let readings = ask.known_component_readings(self.component)?;
        let values = readings.parts.get(&self.part);
        let alike = values.and_then(|values| values.get(&self.value));
        let terms = alike.into_iter().flatten().flat_map(|known| &known.terms);
        let equal = terms.filter(|(hand, phase, _)| *hand == self.hand && phase_counts(Some(self.phase), phase));
        Ok(equal.map(|(_, _, term)| term.clone()).collect())
    }
}

/// Returns the coded values of a token, under every name of their hands; a single value counts as both the first and
/// the last.
fn example_slots(ask: &QueryContext<'_>, token: &TokenRow) -> QueryResult<Vec<ExampleSlot>> {
    let left_handed = match token.recording_id {
        Some(recording) => search_answers::left_handed(ask.connection, recording)?,
        None => false,
    };
    let mut slots = Vec::new();
    search_answers::coded_of_token(ask.connection, token.id, |row| {
        let reading = search_terms::reading_from_state(row.state, row.value);
        // Two tokens are not alike because neither has a value.
        let (ComponentReading::Value(value), Some(component)) = (reading, row.component) else {
            return;
        };
        let phases: Vec<SignPhase> = match row.phase {
            Some(phase) => vec![phase],
            None => vec![SignPhase::Initial, SignPhase::Final],
        };
        for &hand in hand_codes(row.hand, left_handed) {
            for &phase in &phases {
                slots.push(ExampleSlot {
                    hand,
                    phase,
                    component,
                    part: row.part.map(str::to_owned),
                    value: fold_text(&value),
                });
            }
        }
    })?;
    Ok(slots)
}

fn example_token(ask: &QueryContext<'_>, like: &LikeSearch) -> QueryResult<TokenRow> {
    let address = match &like.example {
        ExampleToken::Token(text) => match text.parse() {
            Ok(number) => CorpusAddress::Token(number),
            Err(_) => {
                return Err(unknown_example_failure(
                    ask,
                    like,
                    &format!("{text:?} is no number of a token"),
                )?);
            }
        },
        ExampleToken::Sign(text) => CorpusAddress::Sign(RowName::Text(text.clone())),
    };
    match address::find_addressed_token(ask.connection, &address) {
        Ok(token) => Ok(token),
        Err(crate::CorpusError::Wrong { message, .. }) => Err(unknown_example_failure(ask, like, &message)?),
        Err(other) => Err(other.into()),
    }
}

fn unknown_example_failure(
    ask: &QueryContext<'_>,
    like: &LikeSearch,
    message: &str,
) -> QueryResult<super::compile::QueryFailure> {
    let suggestion = match &like.example {
        ExampleToken::Sign(text) => {
            let signs = ask.known_signs()?;
            nearest_candidate(text, signs.rows.iter().map(|(_, gloss, _)| gloss.as_str()))
                .filter(|near| *near != text)
                .map(str::to_owned)
        }
        ExampleToken::Token(_) => None,
    };
    Ok(QueryError {
        at: like.example_at.char_range(),
        message: message.to_owned(),
        remedy: "write like token:41, or like and a gloss of the corpus".into(),
        suggestion,
    }
    .into())
}
