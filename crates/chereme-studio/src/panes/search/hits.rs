//! The results: pages of hits, their neighbours, and their order.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use chereme_corpus::{Answer, Around, Finding, Hit, Order};
use chereme_motion::{Instant, Span};
use chereme_sign::{Component, Field};
use serde_json::Value;

use super::super::timeline::data::time_text;

/// How many hits are requested at once.
pub(crate) const PAGE: usize = 500;
/// How many neighbours are requested on each side.
pub(crate) const NEIGHBOURS: usize = 3;

/// The order of hits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Sort {
    #[default]
    Rank,
    Place,
    Gloss,
    Duration,
    Before,
    After,
}

impl Sort {
    /// Returns the order to request from the corpus.
    pub(crate) fn order(self) -> Order {
        match self {
            Self::Rank => Order::Rank,
            Self::Gloss => Order::Gloss,
            Self::Duration => Order::Duration,
            Self::Place | Self::Before | Self::After => Order::Place,
        }
    }

    /// Returns whether hits are sorted here, as the corpus does not know their neighbours.
    pub(crate) fn is_local(self) -> bool {
        matches!(self, Self::Before | Self::After)
    }
}

/// The answer to a query.
#[derive(Debug, Default)]
pub(crate) struct Found {
    /// The query in its canonical form.
    pub(crate) query: String,
    pub(crate) total: usize,
    pub(crate) facets: Arc<BTreeMap<String, Vec<(String, usize)>>>,
    pub(crate) notes: Vec<String>,
    pub(crate) findings: Vec<Finding>,
    pages: BTreeMap<usize, Vec<Hit>>,
    around: BTreeMap<i64, Around>,
    /// The order of hits as indices, if they are sorted here.
    sorted: Option<Vec<usize>>,
}

impl Found {
    pub(crate) fn new(answer: &Answer) -> Self {
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

    pub(crate) fn put(&mut self, page: usize, hits: &[Hit]) {
        self.pages.insert(page, hits.to_vec());
    }

    pub(crate) fn put_around(&mut self, around: &[Around]) {
        let pairs = around.iter().map(|it| (it.token, it.clone()));
        self.around.extend(pairs);
    }

    /// Returns the hit at a position, if it has been read.
    pub(crate) fn hit(&self, at: usize) -> Option<&Hit> {
        let at = self
            .sorted
            .as_ref()
            .map_or(Some(at), |it| it.get(at).copied())?;
        self.pages.get(&(at / PAGE))?.get(at % PAGE)
    }

    pub(crate) fn around(&self, token: i64) -> Option<&Around> {
        self.around.get(&token)
    }

    /// Returns the first missing page of a range.
    pub(crate) fn missing(&self, range: Range<usize>) -> Option<usize> {
        let end = range.end.min(self.total);
        if range.start >= end || self.sorted.is_some() {
            return None;
        }
        (range.start / PAGE..=(end - 1) / PAGE).find(|page| !self.pages.contains_key(page))
    }

    /// Returns the tokens of a range whose neighbours are unknown.
    pub(crate) fn lonely(&self, range: Range<usize>) -> Vec<i64> {
        range
            .filter_map(|at| Some(self.hit(at)?.token))
            .filter(|token| !self.around.contains_key(token))
            .collect()
    }

    /// Returns whether every hit has been read, so that they can be sorted here.
    pub(crate) fn is_whole(&self) -> bool {
        self.pages.values().map(Vec::len).sum::<usize>() == self.total
    }

    /// Sorts the hits by their neighbours, or restores their own order.
    pub(crate) fn sort(&mut self, sort: Sort) {
        self.sorted = None;
        if !sort.is_local() || !self.is_whole() {
            return;
        }
        let word = |at: &usize| {
            let around = self.around(self.hit(*at)?.token)?;
            match sort {
                Sort::Before => around.before.last(),
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
pub(crate) fn place(hit: &Hit) -> Option<(&str, Span)> {
    let (start, end) = hit.start_us.zip(hit.end_us)?;
    let span = Span::between(Instant::from_micros(start), Instant::from_micros(end));
    Some((hit.recording.as_deref()?, span))
}

/// Returns the place of a hit as text; `lexicon` is the text for an entry without movement.
pub(crate) fn place_text(hit: &Hit, lexicon: &str) -> String {
    match place(hit) {
        Some((name, span)) => format!("{name} · {}", time_text(span.start())),
        None => lexicon.to_owned(),
    }
}

/// Returns the duration of a hit as text.
pub(crate) fn duration_text(hit: &Hit) -> String {
    place(hit).map_or(String::new(), |(_, span)| {
        format!("{:.2} s", span.seconds())
    })
}

/// Returns the values of a hit, which its picture shows, as component, feature and value. The dominant hand comes
/// before the weak one, component by component, each value once.
pub(crate) fn coding(hit: &Hit) -> Vec<(String, String)> {
    let mut all: Vec<(String, String)> = Vec::new();
    for hand in ["right", "dominant", "left", "weak", ""] {
        for (field, value) in &hit.components {
            let parts: Vec<&str> = field.split('.').collect();
            let own = parts
                .iter()
                .find(|part| ["right", "dominant", "left", "weak"].contains(part))
                .copied()
                .unwrap_or("");
            if own != hand {
                continue;
            }
            let kept: Vec<&str> = parts
                .into_iter()
                .filter(|part| *part != own && !["initial", "middle", "final"].contains(part))
                .collect();
            let values = match value {
                Value::String(one) => vec![one.clone()],
                Value::Array(several) => several
                    .iter()
                    .filter_map(|it| it.as_str().map(str::to_owned))
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
        let component = field.parse::<Field>().ok().map(|it| it.component);
        Component::ALL.iter().position(|it| Some(*it) == component)
    };
    all.sort_by_key(|pair| place(pair).unwrap_or(Component::ALL.len()));
    all
}

/// Returns the index that arrow keys go to in a grid of `columns`; a table has one column.
pub(crate) fn walk(at: usize, total: usize, columns: usize, [x, y]: [isize; 2]) -> usize {
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

    fn hit(token: i64, gloss: &str) -> Hit {
        Hit {
            token,
            gloss: gloss.into(),
            recording: Some("Un".into()),
            start_us: Some(1_250_000),
            end_us: Some(2_000_000),
            origin: chereme_corpus::Origin::Captured,
            score: None,
            components: BTreeMap::new(),
        }
    }

    fn found(total: usize) -> Found {
        let hits = (0..total.min(PAGE)).map(|n| hit(n as i64, "BOL"));
        Found::new(&Answer {
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
        assert_eq!(found.missing(0..40), None);
        assert_eq!(found.missing(480..520), Some(1));
        assert_eq!(found.missing(99_990..100_010), Some(199));
        assert_eq!(found.missing(100_000..100_010), None);
        found.put(199, &[hit(7, "X")]);
        assert_eq!(found.hit(99_500).map(|hit| hit.token), Some(7));
        assert!(found.hit(700).is_none() && !found.is_whole());
        found.sort(Sort::Before);
        assert_eq!(found.hit(0).map(|hit| hit.token), Some(0));
    }

    #[test]
    fn hits_are_sorted_by_their_neighbours_with_unknown_ones_last() {
        let mut found = found(3);
        assert_eq!(found.lonely(0..3), [0, 1, 2]);
        let around = |token, before: &[&str]| Around {
            token,
            before: before.iter().map(|it| (*it).to_owned()).collect(),
            ..Around::default()
        };
        found.put_around(&[around(0, &[]), around(1, &["A", "Z"]), around(2, &["B"])]);
        assert!(found.lonely(0..3).is_empty());
        found.sort(Sort::Before);
        let order: Vec<i64> = (0..3).filter_map(|at| Some(found.hit(at)?.token)).collect();
        assert_eq!(order, [2, 1, 0]);
        found.sort(Sort::Place);
        assert_eq!(found.hit(0).map(|hit| hit.token), Some(0));
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
            coding(&coded),
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
        assert_eq!(walk(0, 7, 3, [1, 0]), 1);
        assert_eq!(walk(0, 7, 3, [-1, 0]), 0);
        assert_eq!(walk(4, 7, 3, [0, 1]), 6);
        assert_eq!(walk(6, 7, 3, [0, 1]), 6);
        assert_eq!(walk(1, 7, 3, [0, -1]), 1);
        assert_eq!(walk(5, 7, 1, [0, 1]), 6);
        assert_eq!(walk(3, 0, 1, [0, 1]), 0);
    }
}
