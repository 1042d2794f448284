//! Keeps the tier rules in a merge: a change that would break one waits as a conflict.

use std::collections::{BTreeMap, BTreeSet};

use chereme_sign::tier::{self, AnnotationId, Violation};
use rusqlite::Connection;

use super::{Work, remove};
use crate::annotate::messages;
use crate::db::merge as db;
use crate::db::tiers;
use crate::error::{Error, Result};

/// The rules that the tiers of a recording break: the kind of each violation with the uids of its annotations.
type Broken = BTreeSet<(String, Vec<String>)>;

impl Work<'_> {
    /// Takes back the changes of the other side that break tier rules together with those of this side, and stores them
    /// as conflicts. Symbolic annotations follow the annotations above them.
    pub(super) fn keep_rules(&mut self, recordings: &BTreeSet<i64>) -> Result<()> {
        for &recording in recordings {
            let mut known = None;
            let mut followed = BTreeSet::new();
            // Each round takes back a change, or moves annotations below others.
            for _ in 0..=2 * self.came.len() {
                let found = violations(self.connection, recording)?;
                if found.is_empty() {
                    break;
                }
                let known = match &known {
                    Some(known) => known,
                    None => known.insert(self.broken_there(recording)?),
                };
                let mut settled = false;
                for violation in found {
                    if !known.contains(&key(self.connection, &violation)?) {
                        settled |= self.settle(&violation, &mut followed)?;
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
    fn broken_there(&self, recording: i64) -> Result<Broken> {
        let uid = db::uid_of(self.connection, "recording", recording)?;
        let there = uid
            .map(|uid| self.theirs.id("recording", &uid))
            .transpose()?;
        match there.flatten() {
            Some(there) => broken(self.theirs.connection, there),
            None => Ok(Broken::new()),
        }
    }

    /// Removes the cause of a violation if it is a change of the other side; returns whether it did. `followed` holds the
    /// symbolic annotations that followed such a change.
    fn settle(&mut self, violation: &Violation, followed: &mut BTreeSet<i64>) -> Result<bool> {
        let own: Vec<i64> = violation.annotations().into_iter().map(number).collect();
        for &id in &own {
            // An earlier violation of this round may have removed it.
            if db::uid_of(self.connection, "annotation", id)?.is_none() {
                return Ok(true);
            }
        }
        let near = self.near(&own)?;
        if let Violation::DerivedSpan {
            annotation,
            expected,
            ..
        } = violation
        {
            let mut came = false;
            for id in &near {
                let uid = db::uid_of(self.connection, "annotation", *id)?;
                came |=
                    followed.contains(id) || uid.is_some_and(|uid| self.came.contains_key(&uid));
            }
            if came {
                let mut row = tiers::annotation(self.connection, number(*annotation))?;
                (row.start_us, row.end_us) = (expected.start().micros(), expected.end().micros());
                tiers::update_annotation(self.connection, &row)?;
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
                Some(before) => db::update(self.connection, "annotation", id, &before)?,
                None => {
                    for part in with_children(self.connection, id)? {
                        let uid = db::uid_of(self.connection, "annotation", part)?;
                        if let Some(uid) = uid.filter(|uid| self.came.remove(uid).is_some()) {
                            self.take_back(&("annotation".to_owned(), uid), None)?;
                        }
                    }
                    remove(self.connection, id)?;
                    self.mine.know(&key.0, &key.1, None)?;
                }
            }
            self.take_back(&key, Some(id))?;
            return Ok(true);
        }
        Ok(false)
    }

    /// Stores a conflict about an annotation whose change was taken back.
    fn take_back(&mut self, key: &db::Key, id: Option<i64>) -> Result<()> {
        let mine = match id {
            Some(_) => self.mine.row(&key.0, &key.1)?,
            None => None,
        };
        let theirs = self.theirs.row(&key.0, &key.1)?;
        let count = match mine {
            Some(_) => &mut self.report.changed,
            None => &mut self.report.added,
        };
        if let Some(count) = count.get_mut(&key.0) {
            *count = count.saturating_sub(1);
        }
        count.retain(|_, count| *count > 0);
        self.conflict(key, (mine.as_ref(), theirs.as_ref()), None)
    }

    /// Returns the annotations that may be the cause of a violation of these, the likeliest first: themselves, those below
    /// them and those above.
    fn near(&self, own: &[i64]) -> Result<Vec<i64>> {
        let mut near = own.to_vec();
        for &id in own {
            near.extend(tiers::children(self.connection, id)?.iter().map(|it| it.id));
        }
        for &id in own {
            near.extend(tiers::annotation(self.connection, id)?.parent_id);
        }
        Ok(near)
    }
}

/// Returns the rules that the tiers of a recording break.
pub(super) fn broken(connection: &Connection, recording: i64) -> Result<Broken> {
    let found = violations(connection, recording)?;
    found.iter().map(|it| key(connection, it)).collect()
}

/// Fails if the tiers of a recording break a rule that is not `known`.
pub(super) fn check(connection: &Connection, known: &BTreeMap<i64, Broken>) -> Result<()> {
    for (&recording, known) in known {
        for violation in violations(connection, recording)? {
            if !known.contains(&key(connection, &violation)?) {
                let rule = messages::named(connection, &violation.to_string());
                return Err(Error::wrong(format!(
                    "after this decision the tiers would break a rule: {rule}"
                ))
                .advise("decide the conflicts of that place together, change what is in the way first, or decide for mine"));
            }
        }
    }
    Ok(())
}

fn violations(connection: &Connection, recording: i64) -> Result<Vec<Violation>> {
    let set = crate::check::tier_set(connection, recording)?;
    Ok(tier::check(&set))
}

/// Returns the kind of a violation, and the uids of its annotations.
fn key(connection: &Connection, violation: &Violation) -> Result<(String, Vec<String>)> {
    let text = format!("{violation:?}");
    let kind = text.split([' ', '{', '(']).next().unwrap_or_default();
    let mut uids = Vec::new();
    for id in violation.annotations() {
        uids.extend(db::uid_of(connection, "annotation", number(id))?);
    }
    Ok((kind.to_owned(), uids))
}

fn number(id: AnnotationId) -> i64 {
    i64::try_from(id.0).unwrap_or(i64::MAX)
}

/// Returns all annotations below an annotation.
fn with_children(connection: &Connection, id: i64) -> Result<Vec<i64>> {
    let mut all = Vec::new();
    let mut waiting = vec![id];
    while let Some(above) = waiting.pop() {
        let children = tiers::children(connection, above)?;
        waiting.extend(children.iter().map(|it| it.id));
        all.extend(children.iter().map(|it| it.id));
    }
    Ok(all)
}
