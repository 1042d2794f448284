//! Three-way merge of a single row: its columns in the common state, here and in the other corpus.

use rusqlite::Connection;
use serde_json::Value;

use crate::db::stored_history::are_image_values_equal;
use crate::db::stored_merge::RowImage;
use crate::db::stored_tiers;
use crate::error::CorpusResult;

/// Columns of annotations that are merged together: those of each end, those of the value, and the references.
const ANNOTATION_COLUMN_GROUPS: [&[&str]; 5] = [
    &["start_us", "file_start_ms"],
    &["end_us", "file_end_ms"],
    &["state", "value", "origin", "confidence", "source"],
    &["tier_id"],
    &["parent_id"],
];

/// Columns in which this side's change wins if both sides changed them.
const OWN_SIDE_WINS_COLUMNS: [(&str, &str); 6] = [
    ("tier", "position"),
    ("tier", "source"),
    ("annotation", "position"),
    ("annotation", "external_id"),
    ("inventory_value", "position"),
    ("recording", "duration_us"),
];

/// Returns the columns to take from `theirs`, and whether both sides changed some column in different ways.
pub(super) fn merge_row_columns(table: &str, base: &RowImage, mine: &RowImage, theirs: &RowImage) -> (RowImage, bool) {
    let mut taken = RowImage::new();
    let mut disagree = false;
    for group in merge_column_groups(table, theirs) {
        let of = |image: &RowImage| -> Vec<Value> {
            let get = |column: &&str| image.get(*column).cloned().unwrap_or(Value::Null);
            group.iter().map(get).collect()
        };
        let (old, own, new) = (of(base), of(mine), of(theirs));
        // The first columns of a group hold its value, the others its source.
        let length = if group[0] == "state" { 2 } else { 1 };
        let stated = |values: &[Value]| values[..length].to_vec();
        if are_values_alike(&new, &old) || are_values_alike(&own, &new) {
            continue;
        }
        let is_own = are_values_alike(&own, &old);
        if !is_own && are_values_alike(&stated(&new), &stated(&own)) {
            continue;
        }
        // Only the source of the same value changed here: the other side's value brings its own source.
        if is_own || are_values_alike(&stated(&own), &stated(&old)) {
            for (column, value) in group.iter().zip(new) {
                taken.insert((*column).to_owned(), value);
            }
        } else if group == ["duration_us"] {
            // A recording lasts as long as the longer of what either side put into it.
            let most = own[0].as_i64().max(new[0].as_i64());
            taken.insert("duration_us".to_owned(), Value::from(most));
        } else if !are_values_alike(&stated(&new), &stated(&old))
            && !OWN_SIDE_WINS_COLUMNS
                .iter()
                .any(|soft| soft.0 == table && group == [soft.1])
        {
            disagree = true;
        }
    }
    (taken, disagree)
}

/// Reports whether the content of a row has changed; its position among other rows does not count.
pub(super) fn has_row_content_changed(table: &str, base: &RowImage, mine: &RowImage) -> bool {
    let soft = |column: &str| OWN_SIDE_WINS_COLUMNS.contains(&(table, column));
    mine.iter().any(|(column, value)| {
        !soft(column) && !are_image_values_equal(base.get(column).unwrap_or(&Value::Null), value)
    })
}

fn are_values_alike(a: &[Value], b: &[Value]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| are_image_values_equal(a, b))
}

fn merge_column_groups<'g>(table: &str, row: &'g RowImage) -> Vec<Vec<&'g str>> {
    let together = |column: &str| {
        let mut all = ANNOTATION_COLUMN_GROUPS.iter().filter(|_| table == "annotation");
        all.find(|group| group.contains(&column))
    };
    let mut groups: Vec<Vec<&str>> = Vec::new();
    if table == "annotation" {
        groups.extend(ANNOTATION_COLUMN_GROUPS.iter().map(|group| group.to_vec()));
    }
    let column_names = row.keys().map(String::as_str);
    let rest = column_names.filter(|column| !["id", "uid"].contains(column) && together(column).is_none());
    groups.extend(rest.map(|column| vec![column]));
    groups
}

/// Reports whether an annotation would end before it starts if the columns `taken` were applied.
pub(super) fn is_backwards(mine: &RowImage, taken: &RowImage) -> bool {
    let number = |column: &str| {
        let value = taken.get(column).or_else(|| mine.get(column));
        value.and_then(Value::as_i64)
    };
    let spans = |image: &RowImage| {
        let get = |column: &str| image.get(column).and_then(Value::as_i64);
        get("start_us")
            .zip(get("end_us"))
            .is_some_and(|(start, end)| start < end)
    };
    let ends = number("start_us").zip(number("end_us"));
    // An annotation that is backwards here already is not made so by the merge.
    spans(mine) && ends.is_some_and(|(start, end)| start >= end)
}

/// Returns the annotation with the same value, time and tier.
pub(super) fn find_twin_annotation(connection: &Connection, row: &RowImage) -> CorpusResult<Option<i64>> {
    let number = |column: &str| row.get(column).and_then(Value::as_i64);
    let (Some(tier), Some(start), Some(end)) = (number("tier_id"), number("start_us"), number("end_us")) else {
        return Ok(None);
    };
    let near = stored_tiers::annotations_near(connection, tier, start, end)?;
    let same = near.into_iter().find(|candidate| {
        candidate.start_us == start
            && candidate.end_us == end
            && Some(candidate.value.as_str()) == row["value"].as_str()
            && Some(candidate.state.value_state_name()) == row["state"].as_str()
            && candidate.parent_id == number("parent_id")
            && Some(candidate.position) == number("position")
    });
    Ok(same.map(|annotation| annotation.id))
}
