//! The results: pages of hits, their neighbours, and their order.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use chereme_corpus::{HitOrder, QueryFinding, SearchAnswer, SearchHit, TokenNeighbours};
use chereme_motion::TimeSpan;
use chereme_sign::{ComponentField, SignComponent};
use serde_json::Value;

use super::super::timeline::timeline_data::time_text;
use crate::words::{InterfaceLanguage, InterfaceText, measures_words};

/// How many hits are requested at once.
pub(crate) const HIT_PAGE_SIZE: usize = 500;
/// How many neighbours are requested on each side.
pub(crate) const MAX_HIT_NEIGHBOURS: usize = 3;

/// The order of hits.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) enum HitSort {
    #[default]
    Rank,
    Place,
    Gloss,
    Duration,
    Before,
    After,
    /// By an attribute of the signs, the greatest number first if `descending`.
    Attribute {
        name: String,
        descending: bool,
    },
}

impl HitSort {
    /// Returns the order to request from the corpus.
    pub(crate) fn corpus_order(&self) -> HitOrder {
        match self {
            Self::Rank => HitOrder::Rank,
            Self::Gloss => HitOrder::Gloss,
            Self::Duration => HitOrder::Duration,
            Self::Place | Self::Before | Self::After => HitOrder::Place,
            Self::Attribute {
                name,
                descending: false,
            } => HitOrder::Attribute(name.clone()),
            Self::Attribute { name, descending: true } => HitOrder::AttributeDescending(name.clone()),
        }
    }

    /// Returns whether hits are sorted here, as the corpus does not know their neighbours.
    pub(crate) fn is_local(&self) -> bool {
        matches!(self, Self::Before | Self::After)
    }

    /// Returns the attribute that gives the order.
    pub(crate) fn sort_attribute(&self) -> Option<&str> {
        match self {
            Self::Attribute { name, .. } => Some(name),
            _ => None,
        }
    }
}

/// The answer to a query.
#[derive(Debug, Default)]
pub(crate) struct QueryAnswer {
    /// The query in its canonical form.
    pub(crate) query: String,
    pub(crate) total: usize,
    pub(crate) facets: Arc<BTreeMap<String, Vec<(String, usize)>>>,
    pub(crate) notes: Vec<String>,
    pub(crate) findings: Vec<QueryFinding>,
    pages: BTreeMap<usize, Vec<SearchHit>>,
    around: BTreeMap<i64, TokenNeighbours>,
    /// The order of hits as indices, if they are sorted here.
    sorted: Option<Vec<usize>>,
}

impl QueryAnswer {
    pub(crate) fn new(answer: &SearchAnswer) -> Self {
        Self {
            query: answer.query.clone(),
            total: answer.total,
            facets: Arc::new(answer.facets.clone()),
            notes: answer.notes.clone(),
            findings: answer.findings.clone(),
            pages: BTreeMap::from([(0, answer.hits.clone())]),
            ..Self::default()
        }
    }

    pub(crate) fn put_hit_page(&mut self, page: usize, hits: &[SearchHit]) {
        self.pages.insert(page, hits.to_vec());
    }

    pub(crate) fn put_around(&mut self, around: &[TokenNeighbours]) {
        let pairs = around.iter().map(|entry| (entry.token, entry.clone()));
        self.around.extend(pairs);
    }

    /// Returns the hit at a position, if it has been read.
    pub(crate) fn hit_at(&self, at: usize) -> Option<&SearchHit> {
        let hit_index = self.sorted.as_ref().map_or(Some(at), |order| order.get(at).copied())?;
        self.pages
            .get(&(hit_index / HIT_PAGE_SIZE))?
            .get(hit_index % HIT_PAGE_SIZE)
    }

    pub(crate) fn hit_neighbours(&self, token: i64) -> Option<&TokenNeighbours> {
        self.around.get(&token)
    }

    /// Returns the first missing page of a range.
    pub(crate) fn first_missing_page(&self, range: Range<usize>) -> Option<usize> {
        let end = range.end.min(self.total);
        if range.start >= end || self.sorted.is_some() {
            return None;
        }
        (range.start / HIT_PAGE_SIZE..=(end - 1) / HIT_PAGE_SIZE).find(|page| !self.pages.contains_key(page))
    }

    /// Returns the tokens of a range whose neighbours are unknown.
    pub(crate) fn tokens_without_neighbours(&self, range: Range<usize>) -> Vec<i64> {
        range
            .filter_map(|at| Some(self.hit_at(at)?.token))
            .filter(|token| !self.around.contains_key(token))
            .collect()
    }

    /// Returns whether every hit has been read, so that they can be sorted here.
    pub(crate) fn is_whole(&self) -> bool {
        self.pages.values().map(Vec::len).sum::<usize>() == self.total
    }

    /// Sorts the hits by their neighbours, or restores their own order.
    pub(crate) fn sort_found_hits(&mut self, sort: &HitSort) {
        self.sorted = None;
        if !sort.is_local() || !self.is_whole() {
            return;
        }
        let word = |at: &usize| {
            let around = self.hit_neighbours(self.hit_at(*at)?.token)?;
            match sort {
                HitSort::Before => around.before.last(),
                _ => around.after.first(),
            }
        };
        let mut all: Vec<usize> = (0..self.total).collect();
        // Hits without that neighbour come last.
        all.sort_by_key(|at| (word(at).is_none(), word(at).cloned()));
        self.sorted = Some(all);
    }
}

/// Returns the place of a hit, as the recording's name and the span, if it was recorded.
pub(crate) fn hit_recording_span(hit: &SearchHit) -> Option<(&str, TimeSpan)> {
    let (start, end) = hit.start_us.zip(hit.end_us)?;
    let span = TimeSpan::from_span_micros(start, end);
    Some((hit.recording.as_deref()?, span))
}

/// Returns the place of a hit as text; `lexicon` is the text for an entry without movement.
pub(crate) fn place_text(hit: &SearchHit, lexicon: &str) -> String {
    match hit_recording_span(hit) {
        Some((name, span)) => format!("{name} · {}", time_text(span.span_start_instant())),
        None => lexicon.to_owned(),
    }
}

/// The measures of signs that are stored as attributes.
const MEASURE_WORDS: [(&str, InterfaceText); 9] = [
    ("measure.density", measures_words::DENSITY),
    ("measure.pairs", measures_words::PAIRS),
    ("measure.homonyms", measures_words::HOMONYMS),
    ("measure.family", measures_words::FAMILY),
    ("measure.family-size", measures_words::FAMILY_SIZE),
    ("measure.probability", measures_words::PROBABILITY),
    ("measure.pair-probability", measures_words::PAIR_PROBABILITY_NAME),
    ("measure.tokens", measures_words::TOKENS),
    ("measure.signers", measures_words::SIGNERS),
];

/// Returns the name of an attribute as people read it: that of a measure in the words of the window.
pub(crate) fn attribute_name_text(name: &str, language: InterfaceLanguage) -> &str {
    let measure = MEASURE_WORDS.iter().find(|(measure, _)| *measure == name);
    measure.map_or(name, |(_, text)| text.text_in_language(language))
}

/// Returns the values of a hit that give its place in an order by an attribute, after the name of the attribute.
pub(crate) fn order_value_text(hit: &SearchHit, sort: &HitSort, language: InterfaceLanguage) -> Option<String> {
    let name = attribute_name_text(sort.sort_attribute()?, language);
    (!hit.order_values.is_empty()).then(|| format!("{name} {}", hit.order_values.join("; ")))
}

/// Returns the duration of a hit as text.
pub(crate) fn duration_text(hit: &SearchHit) -> String {
    hit_recording_span(hit).map_or(String::new(), |(_, span)| format!("{:.2} s", span.span_seconds()))
}

/// Returns the values of a hit, which its picture shows, as component, feature and value. The dominant hand comes
/// before the weak one, component by component, each value once.
pub(crate) fn hit_coding_values(hit: &SearchHit) -> Vec<(String, String)> {
    let mut all: Vec<(String, String)> = Vec::new();
    for hand in ["right", "dominant", "left", "weak", ""] {
        for (field, value) in &hit.components {
            let parts: Vec<&str> = field.split('.').collect();
            let field_hand = parts
                .iter()
                .find(|part| ["right", "dominant", "left", "weak"].contains(part))
                .copied()
                .unwrap_or("");
            if field_hand != hand {
                continue;
            }
            // Pictures show a value once, whatever its hand and phase.
            let kept: Vec<&str> = parts
                .into_iter()
                .filter(|part| *part != field_hand && !["initial", "middle", "final"].contains(part))
                .collect();
            let values = match value {
                Value::String(one) => vec![one.clone()],
                Value::Array(several) => several
                    .iter()
                    .filter_map(|item| item.as_str().map(str::to_owned))
                    .collect(),
                _ => Vec::new(),
            };
            for value in values {
                let pair = (kept.join("."), value);
                if pair.1 != "n/a" && pair.1 != "unclear" && !all.contains(&pair) {
                    all.push(pair);
                }
            }
        }
    }
    let place = |(field, _): &(String, String)| {
        let component = field.parse::<ComponentField>().ok().map(|parsed| parsed.component);
        SignComponent::ALL_COMPONENTS
            .iter()
            .position(|other| Some(*other) == component)
    };
    all.sort_by_key(|pair| place(pair).unwrap_or(SignComponent::ALL_COMPONENTS.len()));
    all
}

/// Returns the index that arrow keys go to in a grid of `columns`; a table has one column.
pub(crate) fn walk_hit_grid(at: usize, total: usize, columns: usize, [x, y]: [isize; 2]) -> usize {
    let step = x + y * columns as isize;
    let to = at as isize + step;
    if total == 0 {
        0
    } else if to < 0 || to >= total as isize {
        if y != 0 && to >= total as isize && at / columns < (total - 1) / columns {
            total - 1
        } else {
            at.min(total - 1)
        }
    } else {
        to as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hit(token: i64, gloss: &str) -> SearchHit {
        SearchHit {
            lexicon: None,
            token,
            gloss: gloss.into(),
            recording: Some("Un".into()),
            start_us: Some(1_250_000),
            end_us: Some(2_000_000),
            origin: chereme_corpus::RecordOrigin::Captured,
            score: None,
            order_values: Vec::new(),
            components: BTreeMap::new(),
            opinions: Vec::new(),
        }
    }

    fn found(total: usize) -> QueryAnswer {
        let hits = (0..total.min(HIT_PAGE_SIZE)).map(|n| hit(n as i64, "BOL"));
        QueryAnswer::new(&SearchAnswer {
            query: String::new(),
            total,
            hits: hits.collect(),
            facets: BTreeMap::new(),
            facets_left_out: BTreeMap::new(),
            findings: Vec::new(),
            notes: Vec::new(),
        })
    }

    #[test]
    fn hits_show_their_recording_time_and_duration() {
        let mut bol = hit(1, "BOL");
        assert_eq!(place_text(&bol, "lexicon"), "Un · 0:01.250");
        assert_eq!(duration_text(&bol), "0.75 s");
        (bol.recording, bol.start_us) = (None, None);
        assert_eq!(place_text(&bol, "lexicon"), "lexicon");
        assert_eq!(duration_text(&bol), "");
    }

    #[test]
    fn pages_are_requested_as_they_become_visible() {
        let mut found = found(100_000);
        assert_eq!(found.first_missing_page(0..40), None);
        assert_eq!(found.first_missing_page(480..520), Some(1));
        assert_eq!(found.first_missing_page(99_990..100_010), Some(199));
        assert_eq!(found.first_missing_page(100_000..100_010), None);
        found.put_hit_page(199, &[hit(7, "X")]);
        assert_eq!(found.hit_at(99_500).map(|hit| hit.token), Some(7));
        assert!(found.hit_at(700).is_none() && !found.is_whole());
        found.sort_found_hits(&HitSort::Before);
        assert_eq!(found.hit_at(0).map(|hit| hit.token), Some(0));
    }

    #[test]
    fn hits_are_sorted_by_their_neighbours_with_unknown_ones_last() {
        let mut found = found(3);
        assert_eq!(found.tokens_without_neighbours(0..3), [0, 1, 2]);
        let around = |token, before: &[&str]| TokenNeighbours {
            token,
            before: before.iter().map(|it| (*it).to_owned()).collect(),
            ..TokenNeighbours::default()
        };
        found.put_around(&[around(0, &[]), around(1, &["A", "Z"]), around(2, &["B"])]);
        assert!(found.tokens_without_neighbours(0..3).is_empty());
        found.sort_found_hits(&HitSort::Before);
        let order: Vec<i64> = (0..3).filter_map(|at| Some(found.hit_at(at)?.token)).collect();
        assert_eq!(order, [2, 1, 0]);
        found.sort_found_hits(&HitSort::Place);
        assert_eq!(found.hit_at(0).map(|hit| hit.token), Some(0));
    }

    #[test]
    fn coding_names_each_value_once_the_dominant_hand_first() {
        let mut coded = hit(1, "A");
        for (field, value) in [
            ("left.configuration", Value::from("S")),
            ("initial.right.configuration", Value::from("U")),
            ("final.right.configuration", Value::from("U")),
            ("right.placement", Value::from(vec!["chin", "n/a"])),
            ("orientation.palm", Value::from("up")),
        ] {
            coded.components.insert(field.to_owned(), value);
        }
        let pair = |field: &str, value: &str| (field.to_owned(), value.to_owned());
        assert_eq!(
            hit_coding_values(&coded),
            [
                pair("configuration", "U"),
                pair("configuration", "S"),
                pair("placement", "chin"),
                pair("orientation.palm", "up"),
            ]
        );
    }

    #[test]
    fn arrow_keys_stay_within_the_hits() {
        assert_eq!(walk_hit_grid(0, 7, 3, [1, 0]), 1);
        assert_eq!(walk_hit_grid(0, 7, 3, [-1, 0]), 0);
        assert_eq!(walk_hit_grid(4, 7, 3, [0, 1]), 6);
        assert_eq!(walk_hit_grid(6, 7, 3, [0, 1]), 6);
        assert_eq!(walk_hit_grid(1, 7, 3, [0, -1]), 1);
        assert_eq!(walk_hit_grid(5, 7, 1, [0, 1]), 6);
        assert_eq!(walk_hit_grid(3, 0, 1, [0, 1]), 0);
    }
}
