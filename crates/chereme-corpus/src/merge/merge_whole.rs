//! Rows with parts, such as recordings and tiers, that one side removed although the other side changed something in
//! them: they stay whole, or come back whole, until somebody decides.

use std::collections::{BTreeMap, BTreeSet};

use super::{MERGED_TABLE_ORDER, MergeWork, merge_rows};
use crate::db::stored_merge::{self as db, MergeSide, RowImage, TableRowKey};
use crate::error::CorpusResult;

/// The rows above a row that have a property, as far as they are known.
type RowsAbove = BTreeMap<TableRowKey, Option<TableRowKey>>;

impl MergeWork<'_> {
    /// Returns the topmost of the rows that the other side removed and that this side changed, or changed a part of.
    pub(super) fn contested_removed_rows(&self, gone: &BTreeSet<TableRowKey>) -> CorpusResult<BTreeSet<TableRowKey>> {
        let mut contested = BTreeSet::new();
        if gone.is_empty() {
            return Ok(contested);
        }
        let mut above = RowsAbove::new();
        // Tokens follow from annotations, and their changes are changes of these.
        for (key, before) in self.mine.touched.iter().filter(|(key, _)| key.0 != "token") {
            let Some(row) = self.mine.find_row_image(&key.0, &key.1)? else {
                continue;
            };
            let bases = match gone.contains(key) {
                true => self.common_base_images(key)?,
                false => before.clone().into_iter().collect(),
            };
            if is_changed(key, &bases, &row)
                && let Some(top) = top(&self.mine, key, &mut above, &|candidate| Ok(gone.contains(candidate)))?
            {
                contested.insert(top);
            }
        }
        Ok(contested)
    }

    /// Returns whether a row that the other side removed is contested, or a part of such a row.
    pub(super) fn is_contested_row(
        &self,
        key: &TableRowKey,
        contested: &BTreeSet<TableRowKey>,
        above: &mut RowsAbove,
    ) -> CorpusResult<bool> {
        let is_contested = |candidate: &TableRowKey| Ok(contested.contains(candidate));
        Ok(!contested.is_empty() && top(&self.mine, key, above, &is_contested)?.is_some())
    }

    /// Leaves out what the other side holds of people who were forgotten here.
    pub(super) fn leave_out_forgotten(&mut self) -> CorpusResult<()> {
        let forgotten = db::list_forgotten_rows(self.connection)?;
        if forgotten.is_empty() {
            return Ok(());
        }
        let mut above = RowsAbove::new();
        let is_forgotten = |key: &TableRowKey| {
            Ok(matches!(&*key.0, "signer" | "recording") && forgotten.contains(&db::forgotten_row_note(&key.1)))
        };
        let mut left_out = BTreeSet::new();
        for key in self.theirs.touched.keys() {
            if top(&self.theirs, key, &mut above, &is_forgotten)?.is_some() {
                left_out.insert(key.clone());
            }
        }
        self.theirs.touched.retain(|key, _| !left_out.contains(key));
        let recordings = left_out.iter().filter(|key| key.0 == "recording").count();
        if !left_out.is_empty() {
            self.report.notes.push(format!(
                "the other corpus still holds a person who was forgotten here, with {recordings} recordings: left out"
            ));
        }
        Ok(())
    }

    /// Arranges that rows come back which this side removed and in which the other side changed a part, with all of
    /// their parts there.
    pub(super) fn bring_back(&mut self) -> CorpusResult<()> {
        let mut above = RowsAbove::new();
        // It is taken so that the test can read it while this side is changed.
        let touched = std::mem::take(&mut self.theirs.touched);
        let mut missing_keys = BTreeSet::new();
        let is_missing = |key: &TableRowKey| -> CorpusResult<bool> {
            let is_new = touched.get(key).is_some_and(Option::is_none);
            Ok(!is_new && self.mine.find_row_id(&key.0, &key.1)?.is_none())
        };
        for (key, before) in touched.iter().filter(|(key, _)| key.0 != "token") {
            if self.mine.find_row_id(&key.0, &key.1)?.is_some() {
                continue;
            }
            let Some(row) = self.theirs.find_row_image(&key.0, &key.1)? else {
                continue;
            };
            let bases: Vec<RowImage> = before.clone().into_iter().collect();
            if is_changed(key, &bases, &row)
                && let Some(root) = top(&self.theirs, key, &mut above, &is_missing)?
                // A row without parts that one side removed is an ordinary conflict.
                && (root != *key || self.has_parts(&root)?)
            {
                missing_keys.insert(root);
            }
        }
        let mut back: BTreeSet<TableRowKey> = BTreeSet::new();
        let mut waiting: Vec<TableRowKey> = missing_keys.iter().cloned().collect();
        while let Some(key) = waiting.pop() {
            let Some(row) = self.theirs.find_row_image(&key.0, &key.1)? else {
                continue;
            };
            if !back.insert(key.clone()) {
                continue;
            }
            let id = self.theirs.find_row_id(&key.0, &key.1)?.unwrap_or_default();
            for (table, uid, _) in db::find_owned_rows(self.theirs.connection, &key.0, id)? {
                let part = (table.to_owned(), uid);
                if self.mine.find_row_id(&part.0, &part.1)?.is_none() {
                    waiting.push(part);
                }
            }
            for needed in db::image_needed_keys(&key.0, &row) {
                if is_missing(&needed)? {
                    waiting.push(needed);
                }
            }
        }
        self.theirs.touched = touched;
        // Without a state before, the rows count as new on the other side, and are added like others.
        for key in &back {
            self.theirs.touched.insert(key.clone(), None);
        }
        self.back_again = back;
        self.roots = missing_keys;
        Ok(())
    }

    /// Stores a conflict about a row that came back, unless this side has it under another uid.
    pub(super) fn came_back(&mut self, key: &TableRowKey) -> CorpusResult<()> {
        let Some(id) = self.mine.find_row_id(&key.0, &key.1)? else {
            return Ok(());
        };
        if db::uid_of(self.connection, &key.0, id)?.as_ref() != Some(&key.1) {
            return Ok(());
        }
        let row = self.mine.find_row_image(&key.0, &key.1)?;
        self.store_row_conflict(key, None, row.as_ref(), None)
    }

    /// Returns whether a row of the other side has parts.
    fn has_parts(&self, key: &TableRowKey) -> CorpusResult<bool> {
        let Some(id) = self.theirs.find_row_id(&key.0, &key.1)? else {
            return Ok(false);
        };
        let parts = db::find_owned_rows(self.theirs.connection, &key.0, id)?;
        // Tokens of annotations follow from their tiers.
        Ok(parts.iter().any(|(table, ..)| key.0 == "sign" || *table != "token"))
    }
}

/// Returns whether a row differs from all of its common states; one without such a state is new.
fn is_changed(key: &TableRowKey, bases: &[RowImage], row: &RowImage) -> bool {
    bases
        .iter()
        .all(|base| merge_rows::has_row_content_changed(&key.0, base, row))
}

/// Returns the topmost row with a property among a row and those it is a part of; `above` holds the known ones.
fn top(
    side: &MergeSide<'_>,
    key: &TableRowKey,
    above: &mut RowsAbove,
    holds: &dyn Fn(&TableRowKey) -> CorpusResult<bool>,
) -> CorpusResult<Option<TableRowKey>> {
    if let Some(known) = above.get(key) {
        return Ok(known.clone());
    }
    // A row that is above itself has no top.
    above.insert(key.clone(), None);
    let mut best = holds(key)?.then(|| key.clone());
    if let Some(row) = side.find_row_image(&key.0, &key.1)? {
        for owner in db::image_owner_keys(&key.0, &row) {
            let top_key = top(side, &owner, above, holds)?;
            let place = |key: &TableRowKey| MERGED_TABLE_ORDER.iter().position(|table| *table == key.0);
            // Of several owners the one in the earliest table is the highest.
            let is_higher = match (&top_key, &best) {
                (Some(found), Some(best)) => best == key || place(found) < place(best),
                (found, None) => found.is_some(),
                (None, Some(_)) => false,
            };
            if is_higher {
                best = top_key;
            }
        }
    }
    above.insert(key.clone(), best.clone());
    Ok(best)
}
