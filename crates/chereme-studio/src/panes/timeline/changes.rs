//! Changes of the timeline as requests to the corpus; each list is one operation, undone at once.

use std::collections::BTreeSet;

use chereme_corpus::{
    AnnotationAction, AnnotationChange, AnnotationColumns, AnnotationName, Contents, Moment,
    TierContents, TierName, ValueState,
};
use chereme_motion::Instant;

use super::dragged::places;
use super::spans::Item;

fn moment(micros: i64) -> Moment {
    Moment::Time(Instant::from_micros(micros))
}

/// Returns the change that adds an annotation.
pub(crate) fn add(tier: i64, (start, end): (i64, i64), value: &str) -> AnnotationChange {
    let action = AnnotationAction::Add {
        tier: TierName::Number(tier),
        start: Some(moment(start)),
        end: Some(moment(end)),
        parent: None,
        order: None,
        value: value.to_owned(),
        confidence: None,
    };
    action.into()
}

/// Returns the changes that set the times of annotations, in this order.
pub(crate) fn respan(items: &[Item]) -> Vec<AnnotationChange> {
    let set = items.iter().map(|item| AnnotationAction::Set {
        annotation: AnnotationName::Number(item.id),
        start: Some(moment(item.start)),
        end: Some(moment(item.end)),
        value: None,
    });
    set.map(AnnotationChange::from).collect()
}

/// Returns the change that cuts an annotation in two.
pub(crate) fn split(annotation: i64, at: i64) -> AnnotationChange {
    let annotation = AnnotationName::Number(annotation);
    let at = moment(at);
    AnnotationAction::Split { annotation, at }.into()
}

/// Returns the changes that set the value of annotations.
pub(crate) fn say(annotations: &BTreeSet<i64>, value: &str) -> Vec<AnnotationChange> {
    let set = annotations.iter().map(|id| AnnotationAction::Set {
        annotation: AnnotationName::Number(*id),
        start: None,
        end: None,
        value: Some(value.to_owned()),
    });
    set.map(AnnotationChange::from).collect()
}

/// Returns the changes that remove annotations; children of removed ones are removed with them.
pub(crate) fn remove(contents: &Contents, annotations: &BTreeSet<i64>) -> Vec<AnnotationChange> {
    let mut changes = Vec::new();
    for tier in &contents.tiers {
        for at in places(tier, annotations) {
            if !goes_with_another(contents, tier, at, annotations) {
                let annotation = AnnotationName::Number(tier.annotations.ids[at]);
                changes.push(AnnotationAction::Remove { annotation }.into());
            }
        }
    }
    changes
}

fn goes_with_another(
    contents: &Contents,
    tier: &TierContents,
    at: usize,
    gone: &BTreeSet<i64>,
) -> bool {
    let mut above = tier.annotations.parents.get(at).copied().flatten();
    for _ in 0..contents.tiers.len() {
        let Some(id) = above else { return false };
        if gone.contains(&id) {
            return true;
        }
        above = contents.tiers.iter().find_map(|tier| {
            let at = tier.annotations.ids.iter().position(|it| *it == id)?;
            tier.annotations.parents.get(at).copied().flatten()
        });
    }
    false
}

/// Returns the value of an annotation as one would type it.
pub(crate) fn typed(columns: &AnnotationColumns, at: usize) -> String {
    match columns.states[at] {
        ValueState::Value => columns.values[at].to_string(),
        ValueState::NotApplicable => "n/a".to_owned(),
        ValueState::Unclear => "unclear".to_owned(),
        ValueState::Unset => String::new(),
    }
}

/// Returns the changes that copy annotations to another tier at the same times; with `and_remove`, also those that
/// remove the originals.
pub(crate) fn to_tier(
    contents: &Contents,
    items: &[Item],
    to: i64,
    and_remove: bool,
) -> Vec<AnnotationChange> {
    let mut changes = Vec::new();
    for item in items {
        let found = contents.tiers.iter().find_map(|tier| {
            let at = tier.annotations.ids.iter().position(|id| *id == item.id)?;
            Some(typed(&tier.annotations, at))
        });
        changes.push(add(to, (item.start, item.end), &found.unwrap_or_default()));
    }
    if and_remove {
        let gone = items.iter().map(|item| item.id).collect();
        changes.extend(remove(contents, &gone));
    }
    changes
}

/// Returns the changes that merge the annotations of a tier from the first to the last of `chosen`, or a single one
/// with the next. Different values are joined; `closed` tiers keep the first. Returns `None` if there is no next
/// annotation.
pub(crate) fn merge(
    tier: &TierContents,
    chosen: &BTreeSet<i64>,
    closed: bool,
) -> Option<Vec<AnnotationChange>> {
    let columns = &tier.annotations;
    let mut all = places(tier, chosen);
    let first = all.next()?;
    let last = all.last().unwrap_or(first + 1);
    if last >= columns.len() {
        return None;
    }
    let mut value = typed(columns, first);
    let mut changes = Vec::new();
    for at in first + 1..=last {
        let other = typed(columns, at);
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
pub(crate) fn has_below(contents: &Contents, annotations: &BTreeSet<i64>) -> bool {
    let mut parents = contents.tiers.iter().flat_map(|it| &it.annotations.parents);
    parents.any(|parent| parent.is_some_and(|id| annotations.contains(&id)))
}

#[cfg(test)]
mod tests {
    use super::super::dragged::tests::contents;
    use super::*;

    fn recording() -> Contents {
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
        let removed = remove(&recording(), &BTreeSet::from([1, 3, 4]));
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
            let merged = merge(&all.tiers[0], &chosen, closed)?;
            let value = |it: &AnnotationChange| match &it.action {
                AnnotationAction::Merge { value, .. } => value.clone().unwrap_or_default(),
                other => panic!("{other:?}"),
            };
            Some(merged.iter().map(value).collect::<Vec<_>>())
        };
        assert_eq!(values(&[1], false), Some(vec!["v1 v2".into()]));
        assert_eq!(
            values(&[1, 5], false),
            Some(vec!["v1 v2".into(), "v1 v2 v5".into()])
        );
        assert_eq!(values(&[1], true), Some(vec!["v1".into()]));
        assert_eq!(values(&[5], false), None);
        assert_eq!(values(&[3], false), None);
    }

    #[test]
    fn moving_to_another_tier_adds_and_removes() {
        let all = recording();
        let item = Item {
            id: 5,
            start: 310,
            end: 410,
        };
        let copied = to_tier(&all, &[item], 2, false);
        assert_eq!(copied, [add(2, (310, 410), "v5")]);
        assert_eq!(to_tier(&all, &[item], 2, true).len(), 2);
        assert!(has_below(&all, &BTreeSet::from([2])) && !has_below(&all, &BTreeSet::from([5])));
    }
}
