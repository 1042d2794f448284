//! Relations between signs: variants, synonyms, compounds with their parts, families that differ in the handshape.

use std::collections::BTreeSet;

use chereme_sign::text::fold_text;
use chereme_sign::words::folders::phrase_text;
use rusqlite::Connection;

use crate::Corpus;
use crate::address::{self, RowName};
use crate::db::sign_relations::{self, RelationRow, SignRelation};
use crate::db::{signs, stored_attributes};
use crate::error::{CorpusError, CorpusResult};
use crate::pairs::{self, PairOptions};
use crate::progress::ProgressReceiver;
use crate::words::InterfaceLanguage;
use crate::words::effect::OperationEffect;

/// Who says that two signs are related because they have the same form.
const SAID_BY_FORM: &str = "form";

/// A change of relations.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RelationChange {
    /// They are added.
    Add,
    /// They are taken away.
    Remove,
}

impl SignRelation {
    /// Returns the words for the relation before the name of the other sign, such as `part of`.
    #[must_use]
    pub fn relation_words(&self, language: InterfaceLanguage) -> &str {
        phrase_text(&format!("page-relation-{}", self.relation), language).unwrap_or(&self.relation)
    }
}

impl Corpus {
    /// Returns the relations of a sign, or those of all signs, each from both ends.
    ///
    /// # Errors
    /// Fails if there is no such sign.
    pub fn list_relations(&self, sign: Option<&RowName>) -> CorpusResult<Vec<SignRelation>> {
        let connection = self.store.read_connection();
        let sign = sign
            .map(|name| address::find_sign_by_name(connection, name))
            .transpose()?;
        sign_relations::load_sign_relations(connection, sign)
    }

    /// Adds or takes away relations of a sign to others; the parts of a compound are in order. Returns how many changed.
    ///
    /// # Errors
    /// Fails if there is no such sign or relation, or if a sign would be related to itself.
    pub fn change_relations(
        &mut self,
        sign: &RowName,
        relation: &str,
        related: &[RowName],
        change: RelationChange,
    ) -> CorpusResult<usize> {
        self.store.run_store_operation(|connection| {
            let (kind, is_inverse) = find_relation_kind(connection, relation)?;
            let own = address::find_sign_by_name(connection, sign)?;
            let mut changed = 0;
            for (place, name) in related.iter().enumerate() {
                let other = address::find_sign_by_name(connection, name)?;
                let label = signs::sign_label(connection, other)?;
                if own == other {
                    let text = format!("{label} would be related to itself");
                    return Err(CorpusError::from_wrong_message(text)
                        .with_error_place(&label)
                        .with_advice("name another sign"));
                }
                let (from, to) = if is_inverse { (other, own) } else { (own, other) };
                changed += match change {
                    RelationChange::Add => {
                        let has_parts = kind == "compound-of" && !is_inverse;
                        let row = RelationRow {
                            sign: from,
                            kind: kind.clone(),
                            related: to,
                            position: if has_parts { place as i64 + 1 } else { 1 },
                            source: None,
                        };
                        usize::from(sign_relations::insert_relation(connection, &row)?)
                    }
                    RelationChange::Remove => sign_relations::remove_relations(connection, from, &kind, to)?,
                };
            }
            let (count, relation) = (changed as u64, kind);
            Ok((changed, OperationEffect::RelateSigns { count, relation }))
        })
    }

    /// Returns the relations that the form of signs decides and that nobody stated: homonyms are equal in all fields, and
    /// the signs of a paradigm in all but the handshape of the dominant hand. With `store` they are stored.
    ///
    /// # Errors
    /// Those of [`minimal_pairs`](Self::minimal_pairs).
    pub fn relate_by_form(
        &mut self,
        options: &PairOptions,
        store: bool,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<Vec<SignRelation>> {
        let found = pairs::find_forms_alike(&self.load_pair_forms(options, progress)?)?;
        let connection = self.store.read_connection();
        let tokens: Vec<i64> = found.iter().flat_map(|alike| alike.tokens).collect();
        let sign_of = stored_attributes::signs_of_tokens(connection, &tokens)?;
        let mut rows = BTreeSet::new();
        for alike in found {
            let [Some(&one), Some(&other)] = alike.tokens.map(|token| sign_of.get(&token)) else {
                continue;
            };
            // Two forms of one sign are no two signs.
            if one != other {
                let kind = if alike.differs_in_handshape {
                    "paradigm"
                } else {
                    "homonym"
                };
                rows.insert((one.min(other), one.max(other), kind));
            }
        }
        let stated = sign_relations::load_sign_relations(connection, None)?;
        let is_stated = |sign: i64, related: i64, kind: &str| {
            let mut stated = stated.iter();
            stated.any(|row| (row.sign_id, row.related_id, &*row.relation) == (sign, related, kind))
        };
        let rows: Vec<RelationRow> = rows
            .into_iter()
            .filter(|(sign, related, kind)| !is_stated(*sign, *related, kind))
            .map(|(sign, related, kind)| RelationRow {
                sign,
                kind: kind.to_owned(),
                related,
                position: 1,
                source: Some(SAID_BY_FORM.to_owned()),
            })
            .collect();
        if store && !rows.is_empty() {
            self.store.run_store_operation(|connection| {
                for row in &rows {
                    sign_relations::insert_relation(connection, row)?;
                }
                let (count, relation) = (rows.len() as u64, "homonym, paradigm".to_owned());
                Ok(((), OperationEffect::RelateSigns { count, relation }))
            })?;
        }
        let connection = self.store.read_connection();
        let relation = |row: &RelationRow| {
            Ok(SignRelation {
                sign_id: row.sign,
                sign: signs::sign_label(connection, row.sign)?,
                relation: row.kind.clone(),
                related_id: row.related,
                related: signs::sign_label(connection, row.related)?,
                position: row.position,
                source: row.source.clone(),
            })
        };
        rows.iter().map(relation).collect()
    }
}

/// Returns the stored kind of a relation, and whether the name is that of the other end.
pub(crate) fn find_relation_kind(connection: &Connection, name: &str) -> CorpusResult<(String, bool)> {
    let kinds = sign_relations::load_relation_kinds(connection)?;
    let wanted = fold_text(name.trim()).replace([' ', '_'], "-");
    if kinds.contains_key(&wanted) {
        return Ok((wanted, false));
    }
    if let Some((kind, _)) = kinds.iter().find(|(_, inverse)| **inverse == wanted) {
        return Ok((kind.clone(), true));
    }
    let mut names: Vec<&str> = kinds.iter().flat_map(|(kind, inverse)| [&**kind, &**inverse]).collect();
    names.sort_unstable();
    names.dedup();
    Err(
        CorpusError::from_wrong_message(format!("{name:?} is no relation of signs"))
            .with_error_place(name)
            .with_advice(format!("write one of: {}", names.join(", "))),
    )
}

#[cfg(test)]
mod tests;
