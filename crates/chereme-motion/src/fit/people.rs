//! The person of each marker: labels such as `Anna:LSHO` and `Bob:LSHO` are those of two people.

use std::collections::{BTreeMap, BTreeSet};

use super::labels::{Attachment, worn};
use super::{FEWEST, FitError};
use crate::markers::{Marker, Markers};

/// The name that lists of people have for the person of the markers without a subject.
const NAMELESS: &str = "(no name)";

/// The markers of the person to whom a skeleton is fitted.
pub(super) struct Person {
    /// The place of each marker of the track, in its order; `None` for those of others and for unknown labels.
    pub(super) labels: Vec<Option<Attachment>>,
    /// Whether each marker belongs to another person.
    pub(super) others: Vec<bool>,
}

/// Returns the markers of one person by their labels: those of `subject` if it is given.
///
/// Otherwise, a subject whose known labels another subject with more of them has as well is another person, and one with
/// enough known labels is refused; parts of one body may have names before their labels too.
pub(super) fn person(markers: &Markers, subject: Option<&str>) -> Result<Person, FitError> {
    let mut known: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    let all: Vec<(&str, &str, Option<Attachment>)> = markers.points().iter().map(split).collect();
    for (subject, label, _) in all.iter().filter(|it| it.2.is_some()) {
        known.entry(subject).or_default().insert(label);
    }
    let mut subjects: Vec<(&str, &BTreeSet<&str>)> =
        known.iter().map(|(name, it)| (*name, it)).collect();
    subjects.sort_by_key(|(_, labels)| std::cmp::Reverse(labels.len()));
    let is_other: Box<dyn Fn(&str) -> bool> = match subject {
        Some(wanted) => {
            let is_wanted = move |name: &str| shown_name(name) == wanted || name == wanted;
            if !subjects.iter().any(|(name, _)| is_wanted(name)) {
                return Err(FitError::Subject {
                    wanted: wanted.to_owned(),
                    known: subjects.iter().map(|(name, _)| shown_name(name)).collect(),
                });
            }
            Box::new(move |name| !is_wanted(name))
        }
        None => {
            let others = others(&subjects)?;
            Box::new(move |name| others.contains(name))
        }
    };
    let labels = all.iter();
    let labels = labels.map(|(subject, _, place)| place.filter(|_| !is_other(subject)));
    Ok(Person {
        labels: labels.collect(),
        others: all.iter().map(|(subject, ..)| is_other(subject)).collect(),
    })
}

/// Returns the names of the people if the markers are those of several: [`person`] needs the name of one of them then.
pub(super) fn several(markers: &Markers) -> Vec<String> {
    match person(markers, None) {
        Err(FitError::People(names)) => names,
        _ => Vec::new(),
    }
}

/// Returns the subjects that are other people than the one with most known labels.
fn others<'a>(subjects: &[(&'a str, &BTreeSet<&'a str>)]) -> Result<BTreeSet<&'a str>, FitError> {
    let mut own: BTreeSet<&str> = BTreeSet::new();
    let mut others: Vec<(&str, usize)> = Vec::new();
    for (subject, labels) in subjects {
        if own.is_disjoint(labels) {
            own.extend(labels.iter());
        } else {
            others.push((subject, labels.len()));
        }
    }
    if others.iter().any(|(_, count)| *count >= FEWEST) {
        let people = subjects.iter().filter(|(_, it)| it.len() >= FEWEST);
        let names = people.map(|(name, _)| shown_name(name));
        return Err(FitError::People(names.collect()));
    }
    Ok(others.into_iter().map(|(name, _)| name).collect())
}

/// Returns the subject of a marker, its label, and its place.
fn split(point: &Marker) -> (&str, &str, Option<Attachment>) {
    let (subject, place) = worn(&point.name);
    let label = match subject.is_empty() {
        true => point.name.trim_start_matches(':'),
        false => point.name.get(subject.len() + 1..).unwrap_or_default(),
    };
    match subject.is_empty() {
        true => (&point.group, label, place),
        false => (subject, label, place),
    }
}

fn shown_name(subject: &str) -> String {
    match subject.is_empty() {
        true => NAMELESS.to_owned(),
        false => subject.to_owned(),
    }
}
