//! The person of each marker: labels such as `Anna:LSHO` and `Bob:LSHO` are those of two people.

use std::collections::{BTreeMap, BTreeSet};

use super::fit_labels::{MarkerAttachment, split_worn_marker};
use super::{FitError, MIN_LABELLED_MARKERS};
use crate::markers::{MarkerTrack, MotionMarker};

/// The name that lists of people have for the person of the markers without a subject.
const NAMELESS_PERSON: &str = "(no name)";

/// The markers of the person to whom a skeleton is fitted.
pub(super) struct MarkerPerson {
    /// The place of each marker of the track, in its order; `None` for those of others and for unknown labels.
    pub(super) labels: Vec<Option<MarkerAttachment>>,
    /// Whether each marker belongs to another person.
    pub(super) others: Vec<bool>,
}

/// Returns the markers of one person by their labels: those of `subject` if it is given.
///
/// Otherwise, a subject whose known labels another subject with more of them has as well is another person, and one with
/// enough known labels is refused; parts of one body may have names before their labels too.
pub(super) fn select_marker_person(markers: &MarkerTrack, subject: Option<&str>) -> Result<MarkerPerson, FitError> {
    let mut subject_labels: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    let all: Vec<(&str, &str, Option<MarkerAttachment>)> =
        markers.marker_points().iter().map(split_marker_subject).collect();
    // Unknown labels do not tell people apart: any program's extra points have them.
    for (subject, label, _) in all.iter().filter(|entry| entry.2.is_some()) {
        subject_labels.entry(subject).or_default().insert(label);
    }
    let mut subjects: Vec<(&str, &BTreeSet<&str>)> = subject_labels.iter().map(|(name, it)| (*name, it)).collect();
    // The subject with most labels is the person; others are held against it.
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
            let others = find_other_subjects(&subjects)?;
            Box::new(move |name| others.contains(name))
        }
    };
    let all_labels = all.iter();
    let labels = all_labels.map(|(subject, _, place)| place.filter(|_| !is_other(subject)));
    Ok(MarkerPerson {
        labels: labels.collect(),
        others: all.iter().map(|(subject, ..)| is_other(subject)).collect(),
    })
}

/// Returns the names of the people if the markers are those of several: [`select_marker_person`] needs the name of one of them then.
pub(super) fn list_marker_people(markers: &MarkerTrack) -> Vec<String> {
    match select_marker_person(markers, None) {
        Err(FitError::People(names)) => names,
        _ => Vec::new(),
    }
}

/// Returns the subjects that are other people than the one with most known labels.
fn find_other_subjects<'a>(subjects: &[(&'a str, &BTreeSet<&'a str>)]) -> Result<BTreeSet<&'a str>, FitError> {
    let mut seen_labels: BTreeSet<&str> = BTreeSet::new();
    let mut others: Vec<(&str, usize)> = Vec::new();
    for (subject, labels) in subjects {
        // Parts of one body have different labels, two people have the same ones.
        if seen_labels.is_disjoint(labels) {
            seen_labels.extend(labels.iter());
        } else {
            others.push((subject, labels.len()));
        }
    }
    // A few doubles are ghosts of the solver; enough of them are a second body.
    if others.iter().any(|(_, count)| *count >= MIN_LABELLED_MARKERS) {
        let people = subjects.iter().filter(|(_, it)| it.len() >= MIN_LABELLED_MARKERS);
        let names = people.map(|(name, _)| shown_name(name));
        return Err(FitError::People(names.collect()));
    }
    Ok(others.into_iter().map(|(name, _)| name).collect())
}

/// Returns the subject of a marker, its label, and its place.
fn split_marker_subject(point: &MotionMarker) -> (&str, &str, Option<MarkerAttachment>) {
    let (subject, place) = split_worn_marker(&point.name);
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
        true => NAMELESS_PERSON.to_owned(),
        false => subject.to_owned(),
    }
}
