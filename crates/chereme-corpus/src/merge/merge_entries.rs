//! Entries of lexicons that both sides made separately, for example by importing one table each.

use serde_json::Value;

use super::MergeWork;
use crate::db::signs;
use crate::db::stored_merge::{self as db, RowImage, TableRowKey};
use crate::error::CorpusResult;
use crate::lexicon::entry_match::{self, EntryPlace};

impl MergeWork<'_> {
    /// Merges a new sign or lexicon entry of the other side with the one of this side that is the same. Returns whether
    /// there is one; otherwise a sign gets a number that is free here.
    pub(super) fn join_same_entry(
        &mut self,
        key: &TableRowKey,
        theirs: &RowImage,
        local: &mut RowImage,
    ) -> CorpusResult<bool> {
        match key.0.as_str() {
            "sign" => self.join_same_sign(key, theirs, local),
            "token" => self.join_same_token(key, local),
            _ => Ok(false),
        }
    }

    fn join_same_sign(&mut self, key: &TableRowKey, theirs: &RowImage, local: &mut RowImage) -> CorpusResult<bool> {
        let Some(there) = self.theirs.find_row_id("sign", &key.1)? else {
            return Ok(false);
        };
        let ids = entry_match::sign_row_ids(self.theirs.connection, there)?;
        let number = |column: &str| local.get(column).and_then(Value::as_i64);
        let (lexicon, homonym) = (number("lexicon_id"), number("homonym").unwrap_or(1));
        let gloss = local["gloss"].as_str().unwrap_or_default().to_owned();
        let is_own = |sign: i64| self.is_own_row("sign", sign);
        match entry_match::find_entry_place(self.connection, lexicon, (&gloss, homonym), &ids, is_own)? {
            EntryPlace::Same(sign) => {
                let own = signs::entry_number(self.connection, sign)?;
                let mut theirs = theirs.clone();
                theirs.insert("homonym".into(), Some(own).filter(|own| *own > 1).into());
                self.join_same_named_row(key, &[], &theirs, sign)?;
                Ok(true)
            }
            EntryPlace::Free(free) => {
                if free != homonym {
                    self.report.notes.push(format!(
                        "both have an entry {gloss:?} of another row: that of {} is {:?} here",
                        self.from,
                        format!("{gloss}#{free}")
                    ));
                    local.insert("homonym".into(), Value::from(free));
                }
                Ok(false)
            }
        }
    }

    fn join_same_token(&mut self, key: &TableRowKey, local: &mut RowImage) -> CorpusResult<bool> {
        let (Some(there), Some(sign)) = (
            self.theirs.find_row_id("token", &key.1)?,
            local.get("sign_id").and_then(Value::as_i64),
        ) else {
            return Ok(false);
        };
        let theirs = signs::load_token_row(self.theirs.connection, there)?;
        if theirs.recording_id.is_some() {
            return Ok(false);
        }
        let ids = entry_match::token_row_ids(&theirs);
        let values = signs::load_token_values(self.theirs.connection, there)?;
        for own in entry_match::lexicon_tokens(self.connection, sign)? {
            let own_ids = entry_match::token_row_ids(&own);
            let is_row = !own_ids.is_disjoint(&ids) || entry_match::are_rows_equal(&own, &theirs);
            if !is_row || !self.is_own_row("token", own.id)? {
                continue;
            }
            if entry_match::are_codings_alike(&signs::load_token_values(self.connection, own.id)?, &values) {
                self.mine.remember_row_uid("token", &key.1, Some(own.id))?;
                return Ok(true);
            }
            self.report.notes.push(format!(
                "the entry {:?} is coded differently in {}: both codings are kept",
                own.gloss, self.from
            ));
        }
        if signs::has_citation(self.connection, sign)? {
            local.insert("citation".into(), Value::from(0));
        }
        Ok(false)
    }

    /// Returns whether only this side has a row.
    fn is_own_row(&self, table: &str, id: i64) -> CorpusResult<bool> {
        let uid = db::uid_of(self.connection, table, id)?.unwrap_or_default();
        Ok(self.theirs.find_row_id(table, &uid)?.is_none())
    }
}
