//! Search by example: the similarity of tokens to given ones.

use std::collections::BTreeMap;

use chereme_sign::query::{Example, Like, QueryError, Weighted};
use chereme_sign::text::{fold, nearest};
use chereme_sign::{Component, Field, Phase, Reading};

use super::compile::{Ask, Asked};
use super::probe::{Doc, Probe};
use crate::address::{self, Address, Name};
use crate::db::search::answers;
use crate::db::search::terms::{self, hand_codes, hands_of, phase_counts};
use crate::db::signs::TokenRow;

/// The similarity of each document to the examples, from 0 to 1.
///
/// For each component in the comparison, the score is the share of the example's readings that the token has too.
/// Hands are compared by their part in signing unless the component names a side, and a single value is both the
/// first and the last value. Components that the example leaves unset do not count: two unset fields are not equal.
/// Several components are weighted; several examples have equal weight.
pub(crate) struct Scores {
    scores: BTreeMap<Doc, f64>,
    /// For each example, the similarity of documents and the required minimum.
    bars: Vec<(BTreeMap<Doc, f64>, f64)>,
    /// The rows of the examples.
    pub(crate) examples: Vec<i64>,
}

impl Scores {
    /// Scores all documents by these examples; there is at least one.
    pub(crate) fn new(ask: &Ask<'_>, likes: &[&Like]) -> Asked<Self> {
        let mut all = Self {
            scores: BTreeMap::new(),
            bars: Vec::new(),
            examples: Vec::new(),
        };
        for like in likes {
            let token = example(ask, like)?;
            all.examples.push(token.id);
            let own = scored(ask, like, &token)?;
            for (doc, score) in &own {
                *all.scores.entry(*doc).or_default() += score / likes.len() as f64;
            }
            if let Some(least) = like.above {
                all.bars.push((own, least));
            }
        }
        Ok(all)
    }

    /// Returns the similarity of a document.
    pub(crate) fn of(&self, doc: Doc) -> f64 {
        self.scores.get(&doc).copied().unwrap_or(0.0).min(1.0)
    }

    /// Returns whether a document reaches the required similarity to each example.
    pub(crate) fn pass(&self, doc: Doc) -> bool {
        // Shares of a whole are added, which is exact only up to the last few digits.
        const SLACK: f64 = 1e-9;
        let mut bars = self.bars.iter();
        bars.all(|(own, least)| own.get(&doc).is_some_and(|score| *score > least + SLACK))
    }
}

/// Returns the similarity of each document to one example, from 0 to 1.
fn scored(ask: &Ask<'_>, like: &Like, token: &TokenRow) -> Asked<BTreeMap<Doc, f64>> {
    let mut scores = BTreeMap::new();
    let on: Vec<(Field, f64)> = if like.on.is_empty() {
        Component::ALL
            .map(|component| (Field::new(component), 1.0))
            .to_vec()
    } else {
        let weighted = |one: &Weighted| (one.field.clone(), one.weight);
        like.on.iter().map(weighted).collect()
    };
    let slots = slots(ask, token)?;
    let counted: Vec<(Vec<&Slot>, f64)> = on
        .iter()
        .filter_map(|(field, weight)| {
            let own: Vec<&Slot> = slots.iter().filter(|slot| slot.belongs(field)).collect();
            if own.is_empty() && !like.on.is_empty() {
                ask.note(format!("token:{} has no value of {field}", token.id));
            }
            (!own.is_empty()).then_some((own, *weight))
        })
        .collect();
    let total: f64 = counted.iter().map(|(_, weight)| weight).sum();
    for (slots, weight) in counted {
        let each = weight / total / slots.len() as f64;
        for slot in slots {
            let probe = Probe::readings(slot.terms(ask)?);
            for doc in ask.run(&probe)? {
                *scores.entry(doc).or_default() += each;
            }
        }
    }
    Ok(scores)
}

/// One coded value of the example.
struct Slot {
    hand: char,
    phase: Phase,
    component: Component,
    part: Option<String>,
    value: String,
}

impl Slot {
    fn belongs(&self, field: &Field) -> bool {
        let hands = hands_of(field.hand);
        self.component == field.component
            && (field.feature.is_none() || self.part == field.feature)
            && field.phase.is_none_or(|phase| phase == self.phase)
            && hands.contains(&self.hand)
    }

    fn terms(&self, ask: &Ask<'_>) -> Asked<Vec<String>> {
        let known = ask.readings(self.component)?;
        let values = known.parts.get(&self.part);
        let alike = values.and_then(|values| values.get(&self.value));
        let terms = alike.into_iter().flatten().flat_map(|known| &known.terms);
        let equal = terms
            .filter(|(hand, phase, _)| *hand == self.hand && phase_counts(Some(self.phase), phase));
        Ok(equal.map(|(_, _, term)| term.clone()).collect())
    }
}

/// Returns the coded values of a token, under every name of their hands; a single value counts as both the first and
/// the last.
fn slots(ask: &Ask<'_>, token: &TokenRow) -> Asked<Vec<Slot>> {
    let left_handed = match token.recording_id {
        Some(recording) => answers::left_handed(ask.connection, recording)?,
        None => false,
    };
    let mut slots = Vec::new();
    answers::coded_of_token(ask.connection, token.id, |row| {
        let reading = terms::reading(row.state, row.value);
        let (Reading::Value(value), Some(component)) = (reading, row.component) else {
            return;
        };
        let phases: Vec<Phase> = match row.phase {
            Some(phase) => vec![phase],
            None => vec![Phase::Initial, Phase::Final],
        };
        for &hand in hand_codes(row.hand, left_handed) {
            for &phase in &phases {
                slots.push(Slot {
                    hand,
                    phase,
                    component,
                    part: row.part.map(str::to_owned),
                    value: fold(&value),
                });
            }
        }
    })?;
    Ok(slots)
}

fn example(ask: &Ask<'_>, like: &Like) -> Asked<TokenRow> {
    let address = match &like.example {
        Example::Token(text) => match text.parse() {
            Ok(number) => Address::Token(number),
            Err(_) => {
                return Err(unknown(
                    ask,
                    like,
                    &format!("{text:?} is no number of a token"),
                )?);
            }
        },
        Example::Sign(text) => Address::Sign(Name::Text(text.clone())),
    };
    match address::token(ask.connection, &address) {
        Ok(token) => Ok(token),
        Err(crate::Error::Wrong { message, .. }) => Err(unknown(ask, like, &message)?),
        Err(other) => Err(other.into()),
    }
}

fn unknown(ask: &Ask<'_>, like: &Like, message: &str) -> Asked<super::compile::Failure> {
    let suggestion = match &like.example {
        Example::Sign(text) => {
            let signs = ask.signs()?;
            nearest(text, signs.rows.iter().map(|(_, gloss, _)| gloss.as_str()))
                .filter(|near| *near != text)
                .map(str::to_owned)
        }
        Example::Token(_) => None,
    };
    Ok(QueryError {
        at: like.example_at.range(),
        message: message.to_owned(),
        remedy: "write like token:41, or like and a gloss of the corpus".into(),
        suggestion,
    }
    .into())
}
