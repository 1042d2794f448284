//! Three-way merge of a single row: its columns in the common state, here and in the other corpus.

use rusqlite::Connection;
use serde_json::Value;

use crate::db::history::alike;
use crate::db::merge::Image;
use crate::db::tiers;
use crate::error::Result;

/// Columns of annotations that are merged together: those of each end, those of the value, and the references.
const ANNOTATION: [&[&str]; 5] = [
    &["start_us", "file_start_ms"],
    &["end_us", "file_end_ms"],
    &["state", "value", "origin", "confidence", "source"],
    &["tier_id"],
    &["parent_id"],
];

/// Columns in which this side's change wins if both sides changed them.
const SOFT: [(&str, &str); 6] = [
    ("tier", "position"),
    ("tier", "source"),
    ("annotation", "position"),
    ("annotation", "external_id"),
    ("inventory_value", "position"),
    ("recording", "duration_us"),
];

/// Returns the columns to take from `theirs`, and whether both sides changed some column in different ways.
pub(super) fn merged(table: &str, base: &Image, mine: &Image, theirs: &Image) -> (Image, bool) {
    let mut taken = Image::new();
    let mut disagree = false;
    for group in groups(table, theirs) {
        let of = |image: &Image| -> Vec<Value> {
            let get = |column: &&str| image.get(*column).cloned().unwrap_or(Value::Null);
            group.iter().map(get).collect()
        };
        let (old, own, new) = (of(base), of(mine), of(theirs));
        // The first columns of a group hold its value, the others its source.
        let length = if group[0] == "state" { 2 } else { 1 };
        let said = |values: &[Value]| values[..length].to_vec();
        if same(&new, &old) || same(&own, &new) {
            continue;
        }
        let is_own = same(&own, &old);
        if !is_own && same(&said(&new), &said(&own)) {
            continue;
        }
        if is_own || same(&said(&own), &said(&old)) {
            for (column, value) in group.iter().zip(new) {
                taken.insert((*column).to_owned(), value);
            }
        } else if group == ["duration_us"] {
            let most = own[0].as_i64().max(new[0].as_i64());
            taken.insert("duration_us".to_owned(), Value::from(most));
        } else if !same(&said(&new), &said(&old))
            && !SOFT.iter().any(|it| it.0 == table && group == [it.1])
        {
            disagree = true;
        }
    }
    (taken, disagree)
}

/// Reports whether the content of a row has changed; its position among other rows does not count.
pub(super) fn differ(table: &str, base: &Image, mine: &Image) -> bool {
    let soft = |column: &str| SOFT.contains(&(table, column));
    mine.iter().any(|(column, value)| {
        !soft(column) && !alike(base.get(column).unwrap_or(&Value::Null), value)
    })
}

fn same(a: &[Value], b: &[Value]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| alike(a, b))
}

fn groups<'g>(table: &str, row: &'g Image) -> Vec<Vec<&'g str>> {
    let together = |column: &str| {
        let mut all = ANNOTATION.iter().filter(|_| table == "annotation");
        all.find(|group| group.contains(&column))
    };
    let mut groups: Vec<Vec<&str>> = Vec::new();
    if table == "annotation" {
        groups.extend(ANNOTATION.iter().map(|group| group.to_vec()));
    }
    let rest = row.keys().map(String::as_str);
    let rest = rest.filter(|it| !["id", "uid"].contains(it) && together(it).is_none());
    groups.extend(rest.map(|column| vec![column]));
    groups
}

/// Reports whether an annotation would end before it starts if the columns `taken` were applied.
pub(super) fn is_backwards(mine: &Image, taken: &Image) -> bool {
    let number = |column: &str| {
        let value = taken.get(column).or_else(|| mine.get(column));
        value.and_then(Value::as_i64)
    };
    let spans = |it: &Image| {
        let get = |column: &str| it.get(column).and_then(Value::as_i64);
        get("start_us")
            .zip(get("end_us"))
            .is_some_and(|(start, end)| start < end)
    };
    let ends = number("start_us").zip(number("end_us"));
    spans(mine) && ends.is_some_and(|(start, end)| start >= end)
}

/// Returns the annotation with the same value, time and tier.
pub(super) fn twin(connection: &Connection, row: &Image) -> Result<Option<i64>> {
    let number = |column: &str| row.get(column).and_then(Value::as_i64);
    let (Some(tier), Some(start), Some(end)) =
        (number("tier_id"), number("start_us"), number("end_us"))
    else {
        return Ok(None);
    };
    let near = tiers::annotations_near(connection, tier, start, end)?;
    let same = near.into_iter().find(|it| {
        it.start_us == start
            && it.end_us == end
            && Some(it.value.as_str()) == row["value"].as_str()
            && Some(it.state.name()) == row["state"].as_str()
            && it.parent_id == number("parent_id")
            && Some(it.position) == number("position")
    });
    Ok(same.map(|it| it.id))
}
