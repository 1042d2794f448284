//! Stores notation and the components derived from it.

use std::collections::BTreeMap;

use chereme_formats::Finding;
use chereme_formats::hns::holds_some;
use chereme_sign::hamnosys::components::{Mapped, MappedValue, Mapper};
use chereme_sign::hamnosys::{Notated, is_garbled, parse_lenient};
use chereme_sign::{Choice, Remedy};
use chereme_sign::{Component, Reading};

use super::report::ReportFinding;
use super::{FileReport, Job};
use crate::db::notations::{self, NotationRow};
use crate::db::signs::{self, TokenValueRow};
use crate::error::{Error, Result};
use crate::inventories::StoredInventory;

/// The HamNoSys text of a sign in a table.
pub(super) struct Text<'t> {
    pub(super) token: i64,
    pub(super) file: i64,
    pub(super) line: u64,
    pub(super) gloss: &'t str,
    pub(super) text: &'t str,
}

impl Text<'_> {
    /// Stores the notation of the token, and its components for which the table has no coding.
    pub(super) fn import(
        &self,
        job: &mut Job<'_>,
        words: &Words<'_>,
        report: &mut FileReport,
    ) -> Result<()> {
        if let Some(finding) = uncoded(self.gloss, self.line, self.text) {
            report.findings.push(finding);
            return Ok(());
        }
        let read = parse_lenient(self.text);
        for found in &read.findings {
            let (gloss, number) = (self.gloss, found.number());
            let message = format!("{gloss}, symbol {number}: {}", found.message);
            let finding = if found.dropped {
                Finding::warning(self.line, message)
            } else {
                Finding::note(self.line, message)
            };
            report
                .findings
                .push(finding.with_remedy(found.remedy).into());
        }
        let sign = Notated {
            gloss: self.gloss.to_owned(),
            text: Some(self.text.to_owned()),
            sign: read.sign,
            ..Notated::default()
        };
        let mapped = words.map(&sign);
        let mut values = signs::values(job.connection, self.token)?;
        let own: Vec<_> = values
            .iter()
            .map(|row| (row.component, row.feature.clone()))
            .collect();
        let new = words.rows(&mapped).into_iter();
        values.extend(new.filter(|row| !own.contains(&(row.component, row.feature.clone()))));
        signs::set_values(job.connection, self.token, &values)?;
        let is_new = notations::of_token(job.connection, self.token)?.is_none();
        let row = NotationRow {
            token_id: self.token,
            source_file_id: Some(self.file),
            line: i64::try_from(self.line).ok(),
            system: "hamnosys".to_owned(),
            text: sign.text.clone(),
            document: document(&sign)?,
            ..NotationRow::default()
        };
        notations::set(job.connection, &row)?;
        job.count("notations", usize::from(is_new));
        report.findings.extend(lost(self.gloss, self.line, &mapped));
        Ok(())
    }
}

/// Returns the reason why a text cannot code a sign: it was garbled, or holds no symbol.
pub(super) fn uncoded(gloss: &str, line: u64, text: &str) -> Option<ReportFinding> {
    let (message, remedy) = if is_garbled(text) {
        (
            format!(
                "{gloss}: its HamNoSys was saved as UTF-8 and read as Latin-1, and parts of it are lost; \
                 the sign was left uncoded"
            ),
            Remedy::from("export the source again as UTF-8, and import that"),
        )
    } else if !holds_some(text.as_bytes()) {
        (
            format!("{gloss}: {text:?} holds no HamNoSys; the sign was left uncoded by it"),
            Remedy::choice(
                Choice::TierRoles,
                "if the column holds something else, say so in a mapping: {\"columns\": {\"NAME\": \"attribute\"}}",
            ),
        )
    } else {
        return None;
    };
    let mut finding = ReportFinding::warning(message, remedy);
    finding.line = Some(line);
    Some(finding)
}

/// Returns the stored form of a notated sign.
pub(super) fn document(sign: &Notated) -> Result<String> {
    serde_json::to_string(sign).map_err(|error| {
        Error::wrong(format!(
            "the notation of {:?} cannot be stored: {error}",
            sign.gloss
        ))
    })
}

/// Returns a finding about the parts of a notation that the components of the sign cannot express.
pub(super) fn lost(gloss: &str, line: u64, mapped: &Mapped) -> Option<ReportFinding> {
    if mapped.lost.is_empty() {
        return None;
    }
    let lost = mapped.lost.join("; ");
    let mut note = ReportFinding::note(format!(
        "{gloss}: the components come near the notation, but leave out {lost}"
    ));
    note.line = Some(line);
    Some(note)
}

/// Mapping of notation to the values of the corpus's inventories.
pub(super) struct Words<'i> {
    mapper: Mapper<'i>,
    rows: BTreeMap<(Component, Option<&'i str>), i64>,
}

impl<'i> Words<'i> {
    pub(super) fn new(inventories: &'i [StoredInventory]) -> Self {
        let mut rows = BTreeMap::new();
        for stored in inventories {
            let own = &stored.inventory;
            rows.entry((own.component, own.feature.as_deref()))
                .or_insert(stored.id);
        }
        let mapper = Mapper::new(inventories.iter().map(|stored| &stored.inventory));
        Self { mapper, rows }
    }

    /// Returns the values of a sign in each component.
    pub(super) fn map(&self, sign: &Notated) -> Mapped {
        self.mapper.map(sign)
    }

    /// Returns the values as rows for storage.
    pub(super) fn rows(&self, mapped: &Mapped) -> Vec<TokenValueRow> {
        mapped.values.iter().map(|value| self.row(value)).collect()
    }

    fn row(&self, mapped: &MappedValue) -> TokenValueRow {
        let field = &mapped.field;
        let reading = Reading::Value(mapped.value.clone());
        TokenValueRow {
            inventory_id: self
                .rows
                .get(&(field.component, field.feature.as_deref()))
                .copied(),
            ..TokenValueRow::of(field, &reading)
        }
    }
}
