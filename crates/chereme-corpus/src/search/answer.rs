//! Answers: the tokens found, in order, with their coded values and the counts of each value.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use chereme_sign::SignComponent;
use serde::Serialize;
use serde_json::Value;

use super::compile::{QueryContext, QueryResult};
use super::docs::{DocumentList, DocumentTimes};
use super::like::ExampleScores;
use super::probe::{IndexDocument, NumberColumn, RowField};
use super::search_attributes::{self, TokenAttributes};
use super::search_finding::QueryFinding;
use super::search_plan::{self, QueryPlan};
use crate::db::stored_attributes::AttributeRow;
use crate::db::stored_columns::{RecordOrigin, ValueState};
use crate::db::stored_search::search_answers::{self, CodedRow};
use crate::details::ValueOpinion;

/// The result of a query.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SearchAnswer {
    /// The query in its canonical form.
    pub query: String,
    /// The number of tokens found, including those that are not shown.
    pub total: usize,
    /// The tokens shown, in order.
    pub hits: Vec<SearchHit>,
    /// By field, the number of tokens found that have each value, most frequent first; at most the requested number of
    /// values, and equal counts ordered by name.
    #[serde(serialize_with = "serialize_facet_counts")]
    pub facets: BTreeMap<String, Vec<(String, usize)>>,
    /// By field, the number of values that were left out, if there are any.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub facets_left_out: BTreeMap<String, usize>,
    /// The wider values that conditions of the query accepted or matched, and conditions that cannot match.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub findings: Vec<QueryFinding>,
    /// Further notes for the user.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

/// Serialises facets as one object of values and counts per field, most frequent first.
fn serialize_facet_counts<S: serde::Serializer>(
    facets: &BTreeMap<String, Vec<(String, usize)>>,
    out: S,
) -> std::result::Result<S::Ok, S::Error> {
    let object = |values: &Vec<(String, usize)>| {
        let pairs = values.iter().map(|(value, count)| (value.clone(), Value::from(*count)));
        Value::Object(pairs.collect())
    };
    out.collect_map(facets.iter().map(|(field, values)| (field, object(values))))
}

/// A token that was found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SearchHit {
    /// The token's row.
    pub token: i64,
    /// Its gloss.
    pub gloss: String,
    /// The lexicon to which its sign belongs, if it belongs to one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lexicon: Option<String>,
    /// The name of its recording; a lexicon entry has none.
    pub recording: Option<String>,
    /// Where it starts, in microseconds.
    pub start_us: Option<i64>,
    /// The first microsecond after it.
    pub end_us: Option<i64>,
    /// Its origin.
    pub origin: RecordOrigin,
    /// Its similarity to the example, from 0 to 1, if there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub score: Option<f64>,
    /// Its values of the attribute by which the answer is sorted.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub order_values: Vec<String>,
    /// Values by field, such as `initial.right.placement`; a list if there are several. A value that does not apply
    /// is `n/a`, an unclear one `unclear`.
    pub components: BTreeMap<String, Value>,
    /// Proposals of detectors and disputed values, if the query asks for them: none of it counts.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub opinions: Vec<ValueOpinion>,
}

/// The order in which tokens are shown.
///
/// Every order is completed by: recordings in the order in which they were stored, time, lexicon entries by gloss, the
/// order in which tokens were stored.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum HitOrder {
    /// The most similar to an example first; then tokens whose whole gloss is the text, then a word of the gloss,
    /// part of a translation, part of a remark.
    #[default]
    Rank,
    /// By recording and time.
    Place,
    /// By gloss.
    Gloss,
    /// The longest first, the lexicon last.
    Duration,
    /// By an attribute: numbers in order, then texts in order, then tokens without the attribute.
    Attribute(String),
    /// By an attribute, the greatest number first.
    AttributeDescending(String),
}

impl HitOrder {
    /// The words for the orders that are not attributes.
    const ORDER_WORDS: [&str; 4] = ["rank", "place", "gloss", "duration"];

    /// Returns the order that a word means: that of an attribute unless it is one of the others; with `-` before it the
    /// greatest first. `attribute.gloss` is the attribute of that name.
    #[must_use]
    pub fn order_from_word(word: &str) -> Self {
        let attribute = |name: &str| name.strip_prefix("attribute.").unwrap_or(name).to_owned();
        match word {
            "rank" => Self::Rank,
            "place" => Self::Place,
            "gloss" => Self::Gloss,
            "duration" => Self::Duration,
            _ => match word.strip_prefix('-') {
                Some(name) => Self::AttributeDescending(attribute(name)),
                None => Self::Attribute(attribute(word)),
            },
        }
    }

    /// Returns the attribute that gives the order.
    #[must_use]
    pub fn order_attribute(&self) -> Option<&str> {
        match self {
            Self::Attribute(name) | Self::AttributeDescending(name) => Some(name),
            _ => None,
        }
    }

    /// Returns the values of the attribute that gives the order; none without one.
    pub(super) fn load_order_attributes(&self, ask: &QueryContext<'_>) -> QueryResult<TokenAttributes> {
        match self.order_attribute() {
            Some(name) => search_attributes::load_token_attributes(ask, name, &Self::ORDER_WORDS),
            None => Ok(TokenAttributes::new()),
        }
    }
}

/// The sort key of a token.
type TokenSortKey = (u64, u64, u64, i64);

/// Returns the requested range of documents, in order.
pub(crate) fn order_document_page(
    ask: &QueryContext<'_>,
    found: &[IndexDocument],
    order: &HitOrder,
    attributes: &TokenAttributes,
    ranks: &DocumentRanks,
    range: std::ops::Range<usize>,
) -> QueryResult<DocumentList> {
    ask.go_on()?;
    let places = DocumentPlaces::open_document_places(ask, found, order, attributes)?;
    let mut keyed: Vec<((u64, TokenSortKey), IndexDocument)> = Vec::with_capacity(found.len());
    for (&doc, rank) in found.iter().zip(ranks.iter()) {
        let key = (places.leading_sort_key(doc, order, rank), places.token_sort_key(doc));
        keyed.push((key, doc));
    }
    let end = range.end.min(keyed.len());
    let start = range.start.min(end);
    // A page of few tokens needs no sort of all of them: those before its end are found first.
    if end > 0 && end < keyed.len() {
        keyed.select_nth_unstable(end - 1);
    }
    keyed.truncate(end);
    keyed.sort_unstable();
    Ok(keyed[start..].iter().map(|(_, doc)| *doc).collect())
}

/// The rank of each document found, least first.
pub(crate) struct DocumentRanks(Option<Vec<u64>>);

impl DocumentRanks {
    /// Ranks documents by similarity and by the places where texts are found in them.
    pub(crate) fn new(
        ask: &QueryContext<'_>,
        found: &[IndexDocument],
        scores: Option<&ExampleScores>,
        texts: &[Vec<Option<QueryPlan>>],
    ) -> QueryResult<Self> {
        if scores.is_none() && texts.is_empty() {
            return Ok(Self(None));
        }
        let mut ranks = vec![0; found.len()];
        for places in texts {
            // A document in none of the places ranks after all others.
            let farthest = places.len() as u64;
            let mut own = vec![farthest; found.len()];
            for (place, plan) in (0..).zip(places) {
                let Some(plan) = plan else {
                    continue;
                };
                let matching = search_plan::evaluate_query_plan(ask, plan, Some(found))?;
                // Both lists are in order of documents, so that one pass compares them.
                let mut here = matching.iter().peekable();
                for (doc, rank) in found.iter().zip(&mut own) {
                    if here.next_if_eq(&doc).is_some() {
                        *rank = (*rank).min(place);
                    }
                }
            }
            ranks.iter_mut().zip(own).for_each(|(rank, own)| *rank += own);
        }
        if let Some(scores) = scores {
            let ids = ask.now.open_row_column(RowField::Token)?;
            for (doc, rank) in found.iter().zip(&mut ranks) {
                let example = ids
                    .document_number(*doc)
                    .is_some_and(|id| scores.examples.contains(&id));
                // Similarities become whole numbers, whose equal values stay equal despite rounding.
                let distance = ((1.0 - scores.document_similarity(*doc)) * 1e9).round() as u64;
                let first = if example { 0 } else { distance + 1 };
                // The similarity is in the upper bits and decides before the place of a text in the lower 16.
                *rank = *rank.min(&mut 0xFFFF) + (first << 16);
            }
        }
        Ok(Self(Some(ranks)))
    }

    fn iter(&self) -> impl Iterator<Item = u64> {
        let ranks = self.0.as_ref();
        (0..).map(move |number: usize| ranks.map_or(0, |ranks| ranks[number]))
    }
}

/// The keys that determine the order of documents.
struct DocumentPlaces {
    id: Box<dyn NumberColumn>,
    sign: Box<dyn NumberColumn>,
    times: DocumentTimes,
    signs: Option<std::sync::Arc<super::search_known::KnownSigns>>,
    /// The rank of each token with the attribute that gives the order.
    attribute_ranks: BTreeMap<i64, u64>,
}

impl DocumentPlaces {
    fn open_document_places(
        ask: &QueryContext<'_>,
        found: &[IndexDocument],
        order: &HitOrder,
        attributes: &TokenAttributes,
    ) -> QueryResult<Self> {
        let times = DocumentTimes::open_document_times(ask.now)?;
        let by_gloss = *order == HitOrder::Gloss || found.iter().any(|doc| times.document_times(*doc).is_none());
        Ok(Self {
            id: ask.now.open_row_column(RowField::Token)?,
            sign: ask.now.open_row_column(RowField::Sign)?,
            times,
            signs: by_gloss.then(|| ask.known_signs()).transpose()?,
            attribute_ranks: rank_by_attribute(attributes, matches!(order, HitOrder::AttributeDescending(_))),
        })
    }

    fn leading_sort_key(&self, doc: IndexDocument, order: &HitOrder, rank: u64) -> u64 {
        match order {
            HitOrder::Rank => rank,
            HitOrder::Place => 0,
            HitOrder::Gloss => self.gloss_rank(doc),
            HitOrder::Duration => match self.times.document_times(doc) {
                Some((_, start, end)) => u64::MAX - 1 - end.abs_diff(start),
                None => u64::MAX,
            },
            HitOrder::Attribute(_) | HitOrder::AttributeDescending(_) => {
                let token = self.id.document_number(doc);
                token
                    .and_then(|id| self.attribute_ranks.get(&id))
                    .copied()
                    .unwrap_or(u64::MAX)
            }
        }
    }

    fn token_sort_key(&self, doc: IndexDocument) -> TokenSortKey {
        let id = self.id.document_number(doc).unwrap_or(i64::MAX);
        match self.times.document_times(doc) {
            Some((recording, start, _)) => (recording as u64, ordered(start), 0, id),
            None => (u64::MAX, 0, self.gloss_rank(doc), id),
        }
    }

    fn gloss_rank(&self, doc: IndexDocument) -> u64 {
        let rank = |signs: &super::search_known::KnownSigns| signs.rank.get(&self.sign.document_number(doc)?).copied();
        self.signs.as_deref().and_then(rank).unwrap_or(u64::MAX)
    }
}

/// Returns the rank of each token by the least of its values of an attribute, or by the greatest if `descending`: numbers
/// before texts, in both directions.
fn rank_by_attribute(attributes: &TokenAttributes, descending: bool) -> BTreeMap<i64, u64> {
    let compare = |a: &AttributeRow, b: &AttributeRow| {
        let by_value = match (a.number, b.number) {
            (Some(one), Some(other)) => one.total_cmp(&other),
            (None, None) => a.text.cmp(&b.text),
            // Numbers stay before texts when the order is turned.
            (one, _) => {
                return if one.is_some() {
                    Ordering::Less
                } else {
                    Ordering::Greater
                };
            }
        };
        if descending { by_value.reverse() } else { by_value }
    };
    let leading = attributes.iter().filter_map(|(token, rows)| {
        let filled = rows.iter().filter(|row| !row.text.trim().is_empty());
        Some((*token, filled.min_by(|a, b| compare(a, b))?))
    });
    let mut ordered_tokens: Vec<(i64, &std::rc::Rc<AttributeRow>)> = leading.collect();
    ordered_tokens.sort_by(|a, b| compare(a.1, b.1));
    let groups = ordered_tokens.chunk_by(|a, b| compare(a.1, b.1).is_eq());
    let ranked = (0..)
        .zip(groups)
        .flat_map(|(rank, group)| group.iter().map(move |(token, _)| (*token, rank)));
    ranked.collect()
}

/// Maps a time to a number that sorts in the same order, also for times before zero.
fn ordered(micros: i64) -> u64 {
    micros as u64 ^ (1 << 63)
}

/// Returns the hits of documents, in their order.
pub(crate) fn collect_search_hits(
    ask: &QueryContext<'_>,
    docs: &[IndexDocument],
    scores: Option<&ExampleScores>,
    attributes: &TokenAttributes,
) -> QueryResult<Vec<SearchHit>> {
    let ids = ask.now.open_row_column(RowField::Token)?;
    let mut hits = Vec::with_capacity(docs.len());
    for doc in docs {
        ask.count_examined_row()?;
        let token = ids.document_number(*doc).unwrap_or_default();
        let Some(row) = search_answers::find_hit_row(ask.connection, token)? else {
            continue;
        };
        let mut components = BTreeMap::new();
        search_answers::coded_of_token(ask.connection, token, |row| add_value(&mut components, &row))?;
        let mut opinions = Vec::new();
        if ask.opinions.get() || ask.asks_sources.get() {
            search_answers::visit_token_opinions(ask.connection, token, |row, standing, opinion| {
                opinions.push(ValueOpinion::from_annotation(field_of_row(row), standing, opinion));
            })?;
        }
        let order_rows = attributes.get(&token).into_iter().flatten();
        hits.push(SearchHit {
            token,
            gloss: row.gloss,
            lexicon: row.lexicon,
            recording: row.recording,
            start_us: row.start_us,
            end_us: row.end_us,
            origin: row.origin,
            score: scores.map(|scores| scores.document_similarity(*doc)),
            order_values: order_rows.map(|row| row.text.clone()).collect(),
            components,
            opinions,
        });
    }
    Ok(hits)
}

fn add_value(components: &mut BTreeMap<String, Value>, row: &CodedRow<'_>) {
    if row.state == ValueState::Unset {
        return;
    }
    let Some(text) = row.state.missing_text().or(row.value) else {
        return;
    };
    let field = field_of_row(row);
    let value = Value::from(text);
    match components.get_mut(&field) {
        None => _ = components.insert(field, value),
        Some(Value::Array(values)) => values.push(value),
        Some(one) => *one = Value::Array(vec![one.take(), value]),
    }
}

/// Returns the field of a row as answers write it, such as `initial.right.placement`.
fn field_of_row(row: &CodedRow<'_>) -> String {
    let mut field = String::new();
    if let Some(phase) = row.phase {
        field.push_str(&format!("{phase}."));
    }
    if let Some(hand) = row.hand {
        field.push_str(hand.annotated_hands_name());
        field.push('.');
    }
    field.push_str(row.component.map_or("", SignComponent::component_name));
    if let Some(part) = row.part {
        field.push('.');
        field.push_str(part);
    }
    field
}
