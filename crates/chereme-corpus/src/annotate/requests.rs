//! Changes that people make on a timeline, as lists of annotation changes; each list is one operation.

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::table::annotations::TableMoment;
use chereme_motion::RecordingInstant;
use chereme_sign::tier::tier_spans::SpanItem;

use super::drag_limits::chosen_annotation_indices;
use super::{AnnotationAction, AnnotationChange, AnnotationName, TierRequestName};
use crate::contents::{AnnotationColumns, RecordingContents, TierContents};
use crate::db::stored_columns::ValueState;

fn moment_from_micros(micros: i64) -> TableMoment {
    TableMoment::Time(RecordingInstant::from_micros(micros))
}

/// Returns the change that adds an annotation.
#[must_use]
pub fn add_annotation_change(tier: i64, start: i64, end: i64, value: &str) -> AnnotationChange {
    let action = AnnotationAction::Add {
        tier: TierRequestName::Number(tier),
        start: Some(moment_from_micros(start)),
        end: Some(moment_from_micros(end)),
        parent: None,
        order: None,
        value: value.to_owned(),
        confidence: None,
    };
    action.into()
}

/// Returns the changes that set the times of annotations, in this order.
#[must_use]
pub fn set_times_changes(items: &[SpanItem]) -> Vec<AnnotationChange> {
    let set = items.iter().map(|item| AnnotationAction::Set {
        annotation: AnnotationName::Number(item.id),
        start: Some(moment_from_micros(item.start)),
        end: Some(moment_from_micros(item.end)),
        value: None,
    });
    set.map(AnnotationChange::from).collect()
}

/// Returns the change that cuts an annotation in two.
#[must_use]
pub fn split_annotation_change(annotation: i64, at: i64) -> AnnotationChange {
    let annotation = AnnotationName::Number(annotation);
    let split_moment = moment_from_micros(at);
    AnnotationAction::Split {
        annotation,
        at: split_moment,
    }
    .into()
}

/// Returns the changes that set the value of annotations.
#[must_use]
pub fn set_value(annotations: &BTreeSet<i64>, value: &str) -> Vec<AnnotationChange> {
    let set = annotations.iter().map(|id| AnnotationAction::Set {
        annotation: AnnotationName::Number(*id),
        start: None,
        end: None,
        value: Some(value.to_owned()),
    });
    set.map(AnnotationChange::from).collect()
}

/// Returns the changes that remove annotations; children of removed ones are removed with them.
#[must_use]
pub fn remove_annotation_changes(contents: &RecordingContents, annotations: &BTreeSet<i64>) -> Vec<AnnotationChange> {
    let mut changes = Vec::new();
    for tier in &contents.tiers {
        for at in chosen_annotation_indices(tier, annotations) {
            if !goes_with_another(contents, tier, at, annotations) {
                let annotation = AnnotationName::Number(tier.annotations.ids[at]);
                changes.push(AnnotationAction::Remove { annotation }.into());
            }
        }
    }
    changes
}

fn goes_with_another(contents: &RecordingContents, tier: &TierContents, at: usize, gone: &BTreeSet<i64>) -> bool {
    let mut above = tier.annotations.parents.get(at).copied().flatten();
    // Damaged rows may be each other's parents, so the way up is limited.
    for _ in 0..contents.tiers.len() {
        let Some(id) = above else { return false };
        if gone.contains(&id) {
            return true;
        }
        above = contents.tiers.iter().find_map(|tier| {
            let index = tier.annotations.ids.iter().position(|other| *other == id)?;
            tier.annotations.parents.get(index).copied().flatten()
        });
    }
    false
}

/// Returns the value of an annotation as one would type it.
#[must_use]
pub fn typed_annotation_value(columns: &AnnotationColumns, at: usize) -> String {
    match columns.states[at] {
        ValueState::Value => columns.values[at].to_string(),
        ValueState::NotApplicable => "n/a".to_owned(),
        ValueState::Unclear => "unclear".to_owned(),
        ValueState::Unset => String::new(),
    }
}

/// Returns the changes that copy annotations to another tier at the same times; with `and_remove`, also those that
/// remove the originals.
#[must_use]
pub fn to_tier(contents: &RecordingContents, items: &[SpanItem], to: i64, and_remove: bool) -> Vec<AnnotationChange> {
    let mut changes = Vec::new();
    for item in items {
        let typed_value = contents.tiers.iter().find_map(|tier| {
            let index = tier.annotations.ids.iter().position(|id| *id == item.id)?;
            Some(typed_annotation_value(&tier.annotations, index))
        });
        changes.push(add_annotation_change(
            to,
            item.start,
            item.end,
            &typed_value.unwrap_or_default(),
        ));
    }
    if and_remove {
        let gone = items.iter().map(|item| item.id).collect();
        changes.extend(remove_annotation_changes(contents, &gone));
    }
    changes
}

/// Returns the changes that merge the annotations of a tier from the first to the last of `chosen`, or a single one
/// with the next. Different values are joined; `closed` tiers keep the first. Returns `None` if there is no next
/// annotation.
#[must_use]
pub fn merge_annotation_changes(
    tier: &TierContents,
    chosen: &BTreeSet<i64>,
    closed: bool,
) -> Option<Vec<AnnotationChange>> {
    let columns = &tier.annotations;
    let mut all = chosen_annotation_indices(tier, chosen);
    let first = all.next()?;
    let last = all.last().unwrap_or(first + 1);
    if last >= columns.len() {
        return None;
    }
    let mut value = typed_annotation_value(columns, first);
    let mut changes = Vec::new();
    for at in first + 1..=last {
        let other = typed_annotation_value(columns, at);
        // An empty annotation adds nothing to the merged value.
        if value.is_empty() {
            value = other;
        } else if !closed && !other.is_empty() && other != value {
            value = format!("{value} {other}");
        }
        let action = AnnotationAction::Merge {
            first: AnnotationName::Number(columns.ids[first]),
            second: AnnotationName::Number(columns.ids[at]),
            value: Some(value.clone()),
            join: true,
        };
        changes.push(action.into());
    }
    Some(changes)
}

/// Returns whether any of the annotations has children.
#[must_use]
pub fn has_below(contents: &RecordingContents, annotations: &BTreeSet<i64>) -> bool {
    let mut parents = contents.tiers.iter().flat_map(|tier| &tier.annotations.parents);
    parents.any(|parent| parent.is_some_and(|id| annotations.contains(&id)))
}

/// Returns the missing annotations below the chosen ones, parents first, as `(tier, span)`.
#[must_use]
pub fn missing_below(tiers: &[TierContents], chosen: &BTreeSet<i64>) -> Vec<(i64, (i64, i64))> {
    let mut under: BTreeMap<(i64, i64), Vec<usize>> = BTreeMap::new();
    // Tiers with a span of an annotation, and its id if it exists already.
    let mut open: Vec<(i64, (i64, i64), Option<i64>)> = Vec::new();
    for tier in tiers {
        let columns = &tier.annotations;
        for (at, parent) in columns.parents.iter().enumerate() {
            if let Some(parent) = parent {
                under.entry((tier.row.id, *parent)).or_default().push(at);
            }
        }
        open.extend(chosen_annotation_indices(tier, chosen).map(|at| {
            let span = (columns.starts[at], columns.ends[at]);
            (tier.row.id, span, Some(columns.ids[at]))
        }));
    }
    let (mut adds, mut seen, mut at) = (Vec::new(), BTreeSet::new(), 0);
    // New annotations get their own children, so the list grows while it is read.
    while let Some((above, span, id)) = open.get(at).copied() {
        at += 1;
        if id.is_some_and(|id| !seen.insert(id)) {
            continue;
        }
        for tier in tiers.iter().filter(|tier| tier.row.parent_id == Some(above)) {
            let columns = &tier.annotations;
            let there = id.and_then(|id| under.get(&(tier.row.id, id)));
            if there.is_none() {
                adds.push((tier.row.id, span));
                open.push((tier.row.id, span, None));
            }
            for at in there.into_iter().flatten() {
                let span = (columns.starts[*at], columns.ends[*at]);
                open.push((tier.row.id, span, Some(columns.ids[*at])));
            }
        }
    }
    adds
}

#[cfg(test)]
mod tests {
    use super::super::testing::contents;
    use super::*;

    fn recording() -> RecordingContents {
        contents(&[
            (
                1,
                None,
                "",
                &[(1, 0, 100, None), (2, 100, 200, None), (5, 300, 400, None)],
            ),
            (
                2,
                Some(1),
                "Included_In",
                &[(3, 10, 20, Some(1)), (4, 110, 120, Some(2))],
            ),
        ])
    }

    #[test]
    fn children_removed_with_their_parent_are_not_removed_twice() {
        let removed = remove_annotation_changes(&recording(), &BTreeSet::from([1, 3, 4]));
        let ids: Vec<_> = removed
            .iter()
            .map(|it| match &it.action {
                AnnotationAction::Remove { annotation } => annotation.clone(),
                other => panic!("{other:?}"),
            })
            .collect();
        assert_eq!(ids, [AnnotationName::Number(1), AnnotationName::Number(4)]);
    }

    #[test]
    fn merging_extends_to_the_next_or_to_the_last_selected_annotation() {
        let all = recording();
        let values = |chosen: &[i64], closed| {
            let chosen = chosen.iter().copied().collect();
            let merged = merge_annotation_changes(&all.tiers[0], &chosen, closed)?;
            let value = |it: &AnnotationChange| match &it.action {
                AnnotationAction::Merge { value, .. } => value.clone().unwrap_or_default(),
                other => panic!("{other:?}"),
            };
            Some(merged.iter().map(value).collect::<Vec<_>>())
        };
        assert_eq!(values(&[1], false), Some(vec!["v1 v2".into()]));
        assert_eq!(values(&[1, 5], false), Some(vec!["v1 v2".into(), "v1 v2 v5".into()]));
        assert_eq!(values(&[1], true), Some(vec!["v1".into()]));
        assert_eq!(values(&[5], false), None);
        assert_eq!(values(&[3], false), None);
    }

    #[test]
    fn moving_to_another_tier_adds_and_removes() {
        let all = recording();
        let item = SpanItem {
            id: 5,
            start: 310,
            end: 410,
        };
        let copied = to_tier(&all, &[item], 2, false);
        assert_eq!(copied, [add_annotation_change(2, 310, 410, "v5")]);
        assert_eq!(to_tier(&all, &[item], 2, true).len(), 2);
        assert!(has_below(&all, &BTreeSet::from([2])) && !has_below(&all, &BTreeSet::from([5])));
    }

    #[test]
    fn missing_child_annotations_are_added_on_every_level() {
        let all = contents(&[
            (1, None, "", &[(1, 0, 100, None), (2, 500, 600, None)]),
            (2, Some(1), "Included_In", &[(3, 10, 20, Some(1))]),
            (3, Some(2), "Symbolic_Association", &[]),
            (4, Some(1), "Time_Subdivision", &[]),
            (5, None, "", &[]),
        ]);
        let below = |ids: &[i64]| missing_below(&all.tiers, &ids.iter().copied().collect());
        assert_eq!(below(&[1]), [(4, (0, 100)), (3, (10, 20))]);
        let whole = (500, 600);
        assert_eq!(below(&[2]), [(2, whole), (4, whole), (3, whole)]);
        assert_eq!(below(&[3]), [(3, (10, 20))]);
        // An annotation below another chosen one is created once.
        assert_eq!(below(&[1, 3]).len(), 2);
    }
}
