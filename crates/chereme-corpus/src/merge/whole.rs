//! Rows with parts, such as recordings and tiers, that one side removed although the other side changed something in
//! them: they stay whole, or come back whole, until somebody decides.

use std::collections::{BTreeMap, BTreeSet};

use super::{ORDER, Work, rows};
use crate::db::merge::{self as db, Image, Key, Side};
use crate::error::Result;

/// The rows above a row that have a property, as far as they are known.
type Above = BTreeMap<Key, Option<Key>>;

impl Work<'_> {
    /// Returns the topmost of the rows that the other side removed and that this side changed, or changed a part of.
    pub(super) fn contested(&self, gone: &BTreeSet<Key>) -> Result<BTreeSet<Key>> {
        let mut contested = BTreeSet::new();
        if gone.is_empty() {
            return Ok(contested);
        }
        let mut above = Above::new();
        for (key, before) in self.mine.touched.iter().filter(|(key, _)| key.0 != "token") {
            let Some(row) = self.mine.row(&key.0, &key.1)? else {
                continue;
            };
            let bases = match gone.contains(key) {
                true => self.bases(key)?,
                false => before.clone().into_iter().collect(),
            };
            if is_changed(key, &bases, &row)
                && let Some(top) = top(&self.mine, key, &mut above, &|it| Ok(gone.contains(it)))?
            {
                contested.insert(top);
            }
        }
        Ok(contested)
    }

    /// Returns whether a row that the other side removed is contested, or a part of such a row.
    pub(super) fn stays(
        &self,
        key: &Key,
        contested: &BTreeSet<Key>,
        above: &mut Above,
    ) -> Result<bool> {
        let is_contested = |it: &Key| Ok(contested.contains(it));
        Ok(!contested.is_empty() && top(&self.mine, key, above, &is_contested)?.is_some())
    }

    /// Arranges that rows come back which this side removed and in which the other side changed a part, with all of
    /// their parts there.
    pub(super) fn bring_back(&mut self) -> Result<()> {
        let mut above = Above::new();
        let touched = std::mem::take(&mut self.theirs.touched);
        let mut found = BTreeSet::new();
        let is_missing = |key: &Key| -> Result<bool> {
            let is_new = touched.get(key).is_some_and(Option::is_none);
            Ok(!is_new && self.mine.id(&key.0, &key.1)?.is_none())
        };
        for (key, before) in touched.iter().filter(|(key, _)| key.0 != "token") {
            if self.mine.id(&key.0, &key.1)?.is_some() {
                continue;
            }
            let Some(row) = self.theirs.row(&key.0, &key.1)? else {
                continue;
            };
            let bases: Vec<Image> = before.clone().into_iter().collect();
            if is_changed(key, &bases, &row)
                && let Some(root) = top(&self.theirs, key, &mut above, &is_missing)?
                && (root != *key || self.has_parts(&root)?)
            {
                found.insert(root);
            }
        }
        let mut back: BTreeSet<Key> = BTreeSet::new();
        let mut waiting: Vec<Key> = found.iter().cloned().collect();
        while let Some(key) = waiting.pop() {
            let Some(row) = self.theirs.row(&key.0, &key.1)? else {
                continue;
            };
            if !back.insert(key.clone()) {
                continue;
            }
            let id = self.theirs.id(&key.0, &key.1)?.unwrap_or_default();
            for (table, uid, _) in db::owned(self.theirs.connection, &key.0, id)? {
                let part = (table.to_owned(), uid);
                if self.mine.id(&part.0, &part.1)?.is_none() {
                    waiting.push(part);
                }
            }
            for needed in db::needed(&key.0, &row) {
                if is_missing(&needed)? {
                    waiting.push(needed);
                }
            }
        }
        self.theirs.touched = touched;
        for key in &back {
            self.theirs.touched.insert(key.clone(), None);
        }
        self.back_again = back;
        self.roots = found;
        Ok(())
    }

    /// Stores a conflict about a row that came back, unless this side has it under another uid.
    pub(super) fn came_back(&mut self, key: &Key) -> Result<()> {
        let Some(id) = self.mine.id(&key.0, &key.1)? else {
            return Ok(());
        };
        if db::uid_of(self.connection, &key.0, id)?.as_ref() != Some(&key.1) {
            return Ok(());
        }
        let row = self.mine.row(&key.0, &key.1)?;
        self.conflict(key, (None, row.as_ref()), None)
    }

    /// Returns whether a row of the other side has parts.
    fn has_parts(&self, key: &Key) -> Result<bool> {
        let Some(id) = self.theirs.id(&key.0, &key.1)? else {
            return Ok(false);
        };
        let parts = db::owned(self.theirs.connection, &key.0, id)?;
        // Tokens of annotations follow from their tiers.
        Ok(parts
            .iter()
            .any(|(table, ..)| key.0 == "sign" || *table != "token"))
    }
}

/// Returns whether a row differs from all of its common states; one without such a state is new.
fn is_changed(key: &Key, bases: &[Image], row: &Image) -> bool {
    bases.iter().all(|base| rows::differ(&key.0, base, row))
}

/// Returns the topmost row with a property among a row and those it is a part of; `above` holds the known ones.
fn top(
    side: &Side<'_>,
    key: &Key,
    above: &mut Above,
    holds: &dyn Fn(&Key) -> Result<bool>,
) -> Result<Option<Key>> {
    if let Some(known) = above.get(key) {
        return Ok(known.clone());
    }
    // A row that is above itself has no top.
    above.insert(key.clone(), None);
    let mut best = holds(key)?.then(|| key.clone());
    if let Some(row) = side.row(&key.0, &key.1)? {
        for owner in db::owners(&key.0, &row) {
            let found = top(side, &owner, above, holds)?;
            let place = |key: &Key| ORDER.iter().position(|table| *table == key.0);
            let is_higher = match (&found, &best) {
                (Some(found), Some(best)) => best == key || place(found) < place(best),
                (found, None) => found.is_some(),
                (None, Some(_)) => false,
            };
            if is_higher {
                best = found;
            }
        }
    }
    above.insert(key.clone(), best.clone());
    Ok(best)
}
