//! The person of each marker: labels such as `Anna:LSHO` and `Bob:LSHO` are those of two people.

use std::collections::{BTreeMap, BTreeSet};

use super::labels::{Attachment, attachment};
use super::{FEWEST, FitError};
use crate::markers::Markers;

/// Returns the places of the markers of one person by their labels; `None` for the others.
///
/// A subject whose known labels another subject with more of them has as well is another person, and one with enough
/// known labels is refused; parts of one body may have names before their labels too.
pub(super) fn labels(markers: &Markers) -> Result<Vec<Option<Attachment>>, FitError> {
    let mut known: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    let all: Vec<(&str, &str, Option<Attachment>)> = markers
        .points()
        .iter()
        .map(|point| {
            let (subject, label) = match point.name.rsplit_once(':') {
                Some((subject, label)) => (subject, label),
                None => (point.group.as_str(), point.name.as_str()),
            };
            (subject, label, attachment(label))
        })
        .collect();
    for (subject, label, _) in all.iter().filter(|it| it.2.is_some()) {
        known.entry(subject).or_default().insert(label);
    }
    let mut subjects: Vec<(&str, &BTreeSet<&str>)> =
        known.iter().map(|(name, it)| (*name, it)).collect();
    subjects.sort_by_key(|(_, labels)| std::cmp::Reverse(labels.len()));
    let mut own: BTreeSet<&str> = BTreeSet::new();
    let mut others: Vec<(&str, usize)> = Vec::new();
    for (subject, labels) in &subjects {
        if own.is_disjoint(labels) {
            own.extend(labels.iter());
        } else {
            others.push((subject, labels.len()));
        }
    }
    if others.iter().any(|(_, count)| *count >= FEWEST) {
        let people = subjects.iter().filter(|(_, it)| it.len() >= FEWEST);
        let names = people.map(|(name, _)| match name.is_empty() {
            true => "(no name)".to_owned(),
            false => (*name).to_owned(),
        });
        return Err(FitError::People(names.collect()));
    }
    let is_other = |subject: &str| others.iter().any(|(name, _)| *name == subject);
    let own = all.into_iter();
    let own = own.map(|(subject, _, place)| place.filter(|_| !is_other(subject)));
    Ok(own.collect())
}
