//! The tier of each row: children below their parents, without folded and hidden ones.

use std::collections::{BTreeMap, BTreeSet};

use chereme_corpus::TierContents;

/// A row of the timeline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct TimelineRow {
    /// Index of the tier in the recording's list.
    pub(crate) tier: usize,
    /// The number of its ancestors.
    pub(crate) depth: usize,
    /// Whether the tier has children.
    pub(crate) has_below: bool,
    /// Whether its children are folded.
    pub(crate) folded: bool,
}

/// Returns the rows, without tiers named in `hidden` and their descendants, and without descendants of `folded` ones.
pub(crate) fn build_timeline_rows(
    tiers: &[TierContents],
    folded: &BTreeSet<String>,
    hidden: &BTreeSet<String>,
) -> Vec<TimelineRow> {
    let tier_ids: BTreeSet<i64> = tiers.iter().map(|tier| tier.row.id).collect();
    let mut below: BTreeMap<Option<i64>, Vec<usize>> = BTreeMap::new();
    // ELAN's settings may order tiers differently than their file.
    let mut order: Vec<usize> = (0..tiers.len()).collect();
    order.sort_by_key(|at| tiers[*at].row.elan_display_settings().order.unwrap_or(usize::MAX));
    for at in order {
        let tier = &tiers[at];
        let stored_parent = tier.row.parent_id;
        let parent = stored_parent.filter(|id| tier_ids.contains(id) && *id != tier.row.id);
        below.entry(parent).or_default().push(at);
    }
    let mut rows = Vec::new();
    let mut open: Vec<(usize, usize)> = Vec::new();
    let push = |open: &mut Vec<(usize, usize)>, parent: Option<i64>, depth: usize| {
        let all = below.get(&parent).map_or(&[][..], Vec::as_slice);
        open.extend(all.iter().rev().map(|at| (*at, depth)));
    };
    push(&mut open, None, 0);
    while let Some((at, depth)) = open.pop() {
        let row = &tiers[at].row;
        if hidden.contains(&row.name) || depth > tiers.len() {
            continue;
        }
        let has_below = below.contains_key(&Some(row.id));
        let folded = has_below && folded.contains(&row.name);
        rows.push(TimelineRow {
            tier: at,
            depth,
            has_below,
            folded,
        });
        if !folded {
            push(&mut open, Some(row.id), depth + 1);
        }
    }
    rows
}

/// Returns how many tiers of the recording are named in `hidden`.
pub(crate) fn hidden_count(tiers: &[TierContents], hidden: &BTreeSet<String>) -> usize {
    let is = |tier: &&TierContents| hidden.contains(&tier.row.name);
    tiers.iter().filter(is).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_corpus::{AnnotationColumns, TierRow};

    fn tier(id: i64, parent_id: Option<i64>) -> TierContents {
        TierContents {
            row: TierRow {
                id,
                parent_id,
                name: format!("t{id}"),
                ..TierRow::default()
            },
            annotations: AnnotationColumns::default(),
        }
    }

    #[test]
    fn children_stand_below_their_parents_whatever_the_order_of_the_file() {
        let all = [
            tier(2, Some(3)),
            tier(1, None),
            tier(3, Some(1)),
            tier(4, Some(99)),
            tier(5, Some(1)),
        ];
        let names = |folded: &[&str], hidden: &[&str]| -> Vec<(String, usize, bool)> {
            let set = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
            build_timeline_rows(&all, &set(folded), &set(hidden))
                .iter()
                .map(|row| (all[row.tier].row.name.clone(), row.depth, row.folded))
                .collect()
        };
        let row = |name: &str, depth, folded| (name.to_owned(), depth, folded);
        let open = [
            row("t1", 0, false),
            row("t3", 1, false),
            row("t2", 2, false),
            row("t5", 1, false),
            row("t4", 0, false),
        ];
        assert_eq!(names(&[], &[]), open);
        assert_eq!(names(&["t1", "t4"], &[]), [row("t1", 0, true), row("t4", 0, false)]);
        assert_eq!(names(&["t3"], &["t5", "t4"]), [row("t1", 0, false), row("t3", 1, true)]);
        assert_eq!(hidden_count(&all, &BTreeSet::from(["t5".into(), "x".into()])), 1);
    }
}
