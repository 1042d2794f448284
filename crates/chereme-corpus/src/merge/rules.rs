//! Keeps the tier rules in a merge: a change that would break one waits as a conflict.

use std::collections::{BTreeMap, BTreeSet};

use chereme_sign::tier::{self, AnnotationId, TierViolation};
use rusqlite::Connection;

use super::{MergeWork, remove_annotation_tree};
use crate::address::message_names;
use crate::db::stored_merge as db;
use crate::db::stored_tiers;
use crate::error::{CorpusError, CorpusResult};

/// The rules that the tiers of a recording break: the kind of each violation with the uids of its annotations.
type BrokenTierRules = BTreeSet<(String, Vec<String>)>;

impl MergeWork<'_> {
    /// Takes back the changes of the other side that break tier rules together with those of this side, and stores them
    /// as conflicts. Symbolic annotations follow the annotations above them.
    pub(super) fn keep_rules(&mut self, recordings: &BTreeSet<i64>) -> CorpusResult<()> {
        for &recording in recordings {
            let mut broken_cache = None;
            let mut followed = BTreeSet::new();
            // Each round takes back a change, or moves annotations below others.
            for _ in 0..=2 * self.came.len() {
                let open_violations = recording_violations(self.connection, recording)?;
                if open_violations.is_empty() {
                    break;
                }
                let their_broken = match &broken_cache {
                    Some(known) => known,
                    None => broken_cache.insert(self.broken_there(recording)?),
                };
                let mut settled = false;
                for violation in open_violations {
                    // A rule that is broken on the other side already is not broken by the merge.
                    if !their_broken.contains(&violation_key(self.connection, &violation)?) {
                        settled |= self.settle_violation(&violation, &mut followed)?;
                    }
                }
                if !settled {
                    break;
                }
            }
        }
        Ok(())
    }

    /// Returns the rules that a recording breaks on the other side.
    fn broken_there(&self, recording: i64) -> CorpusResult<BrokenTierRules> {
        let uid = db::uid_of(self.connection, "recording", recording)?;
        let there = uid.map(|uid| self.theirs.find_row_id("recording", &uid)).transpose()?;
        match there.flatten() {
            Some(there) => broken_tier_rules(self.theirs.connection, there),
            None => Ok(BrokenTierRules::new()),
        }
    }

    /// Removes the cause of a violation if it is a change of the other side; returns whether it did. `followed` holds the
    /// symbolic annotations that followed such a change.
    fn settle_violation(&mut self, violation: &TierViolation, followed: &mut BTreeSet<i64>) -> CorpusResult<bool> {
        let annotation_ids: Vec<i64> = violation
            .violating_annotations()
            .into_iter()
            .map(annotation_row_number)
            .collect();
        for &id in &annotation_ids {
            // An earlier violation of this round may have removed it.
            if db::uid_of(self.connection, "annotation", id)?.is_none() {
                return Ok(true);
            }
        }
        let near = self.likely_cause_annotations(&annotation_ids)?;
        if let TierViolation::DerivedSpan {
            annotation, expected, ..
        } = violation
        {
            let mut came = false;
            for id in &near {
                let uid = db::uid_of(self.connection, "annotation", *id)?;
                came |= followed.contains(id) || uid.is_some_and(|uid| self.came.contains_key(&uid));
            }
            if came {
                let mut row = stored_tiers::load_annotation_row(self.connection, annotation_row_number(*annotation))?;
                (row.start_us, row.end_us) = expected.span_bounds_micros();
                stored_tiers::update_annotation(self.connection, &row)?;
                followed.insert(row.id);
            }
            return Ok(came);
        }
        for id in near {
            let Some(uid) = db::uid_of(self.connection, "annotation", id)? else {
                continue;
            };
            let Some(before) = self.came.remove(&uid) else {
                continue;
            };
            let key = ("annotation".to_owned(), uid);
            match before {
                Some(before) => db::update_row_image(self.connection, "annotation", id, &before)?,
                None => {
                    for part in with_children(self.connection, id)? {
                        let uid = db::uid_of(self.connection, "annotation", part)?;
                        if let Some(uid) = uid.filter(|uid| self.came.remove(uid).is_some()) {
                            self.take_back(&("annotation".to_owned(), uid), None)?;
                        }
                    }
                    remove_annotation_tree(self.connection, id)?;
                    self.mine.remember_row_uid(&key.0, &key.1, None)?;
                }
            }
            self.take_back(&key, Some(id))?;
            return Ok(true);
        }
        Ok(false)
    }

    /// Stores a conflict about an annotation whose change was taken back.
    fn take_back(&mut self, key: &db::TableRowKey, id: Option<i64>) -> CorpusResult<()> {
        let mine = match id {
            Some(_) => self.mine.find_row_image(&key.0, &key.1)?,
            None => None,
        };
        let theirs = self.theirs.find_row_image(&key.0, &key.1)?;
        // The change was counted when it was made, and is undone now.
        let count = match mine {
            Some(_) => &mut self.report.changed,
            None => &mut self.report.added,
        };
        if let Some(count) = count.get_mut(&key.0) {
            *count = count.saturating_sub(1);
        }
        count.retain(|_, count| *count > 0);
        self.store_row_conflict(key, mine.as_ref(), theirs.as_ref(), None)
    }

    /// Returns the annotations that may be the cause of a violation of these, the likeliest first: themselves, those below
    /// them and those above.
    fn likely_cause_annotations(&self, own: &[i64]) -> CorpusResult<Vec<i64>> {
        let mut near = own.to_vec();
        for &id in own {
            near.extend(
                stored_tiers::load_child_annotations(self.connection, id)?
                    .iter()
                    .map(|child| child.id),
            );
        }
        for &id in own {
            near.extend(stored_tiers::load_annotation_row(self.connection, id)?.parent_id);
        }
        Ok(near)
    }
}

/// Returns the rules that the tiers of a recording break.
pub(super) fn broken_tier_rules(connection: &Connection, recording: i64) -> CorpusResult<BrokenTierRules> {
    let broken_rules = recording_violations(connection, recording)?;
    broken_rules
        .iter()
        .map(|violation| violation_key(connection, violation))
        .collect()
}

/// Fails if the tiers of a recording break a rule that is not `known`.
pub(super) fn check_new_violations(
    connection: &Connection,
    known: &BTreeMap<i64, BrokenTierRules>,
) -> CorpusResult<()> {
    for (&recording, known) in known {
        for violation in recording_violations(connection, recording)? {
            if !known.contains(&violation_key(connection, &violation)?) {
                let rule = message_names::name_message_ids(connection, &violation.to_string());
                return Err(CorpusError::from_wrong_message(format!(
                    "after this decision the tiers would break a rule: {rule}"
                ))
                .with_advice(
                    "decide the conflicts of that place together, change what is in the way first, or decide for mine",
                ));
            }
        }
    }
    Ok(())
}

fn recording_violations(connection: &Connection, recording: i64) -> CorpusResult<Vec<TierViolation>> {
    let set = stored_tiers::load_tier_set(connection, recording)?;
    Ok(tier::check_tier_set(&set))
}

/// Returns the kind of a violation, and the uids of its annotations.
fn violation_key(connection: &Connection, violation: &TierViolation) -> CorpusResult<(String, Vec<String>)> {
    // The first word of a violation's debug form is its variant.
    let text = format!("{violation:?}");
    let kind = text.split([' ', '{', '(']).next().unwrap_or_default();
    let mut uids = Vec::new();
    for id in violation.violating_annotations() {
        uids.extend(db::uid_of(connection, "annotation", annotation_row_number(id))?);
    }
    Ok((kind.to_owned(), uids))
}

fn annotation_row_number(id: AnnotationId) -> i64 {
    i64::try_from(id.0).unwrap_or(i64::MAX)
}

/// Returns all annotations below an annotation.
fn with_children(connection: &Connection, id: i64) -> CorpusResult<Vec<i64>> {
    let mut all = Vec::new();
    let mut waiting = vec![id];
    while let Some(above) = waiting.pop() {
        let children = stored_tiers::load_child_annotations(connection, above)?;
        waiting.extend(children.iter().map(|child| child.id));
        all.extend(children.iter().map(|child| child.id));
    }
    Ok(all)
}
