//! Stores notation and the components derived from it.

use std::collections::BTreeMap;

use chereme_formats::ImportFinding;
use chereme_formats::hns::holds_some;
use chereme_sign::hamnosys::components::{MappedSign, MappedValue, SignMapper};
use chereme_sign::hamnosys::{NotatedSign, is_garbled, parse_lenient};
use chereme_sign::{ComponentReading, SignComponent};
use chereme_sign::{ErrorRemedy, RemedyChoice};

use super::{FileReport, ImportJob};
use crate::db::notations::{self, NotationRow};
use crate::db::signs::{self, TokenValueRow};
use crate::error::{CorpusError, CorpusResult};
use crate::inventories::StoredInventory;
use crate::report_finding::ReportFinding;

/// The HamNoSys text of a sign in a table.
pub(super) struct LexiconNotationText<'t> {
    pub(super) token: i64,
    pub(super) file: i64,
    pub(super) line: u64,
    pub(super) gloss: &'t str,
    pub(super) text: &'t str,
}

impl LexiconNotationText<'_> {
    /// Stores the notation of the token, and its components for which the table has no coding.
    pub(super) fn import_sign_notation(
        &self,
        job: &mut ImportJob<'_>,
        words: &NotationValueMapper<'_>,
        report: &mut FileReport,
    ) -> CorpusResult<()> {
        if let Some(finding) = uncoded_text_finding(self.gloss, self.line, self.text) {
            report.findings.push(finding);
            return Ok(());
        }
        let read = parse_lenient(self.text);
        for found in &read.findings {
            let (gloss, number) = (self.gloss, found.symbol_number());
            let message = format!("{gloss}, symbol {number}: {}", found.message);
            // Only a dropped symbol changes the sign, so the rest deserves no warning.
            let finding = if found.dropped {
                ImportFinding::new_warning_finding(self.line, message)
            } else {
                ImportFinding::new_note_finding(self.line, message)
            };
            report.findings.push(finding.with_remedy(found.remedy).into());
        }
        let sign = NotatedSign {
            gloss: self.gloss.to_owned(),
            text: Some(self.text.to_owned()),
            sign: read.sign,
            ..NotatedSign::default()
        };
        let mapped = words.map_notated_sign(&sign);
        let mut values = signs::load_values_and_opinions(job.connection, self.token)?;
        let coded_parts: Vec<_> = values.iter().map(|row| (row.component, row.feature.clone())).collect();
        let new = words.mapped_value_rows(&mapped).into_iter();
        // A coding in the table was made by a person, and counts more than one derived from notation.
        values.extend(new.filter(|row| !coded_parts.contains(&(row.component, row.feature.clone()))));
        signs::set_values(job.connection, self.token, &values)?;
        let is_new = notations::find_token_notation(job.connection, self.token)?.is_none();
        let row = NotationRow {
            token_id: self.token,
            source_file_id: Some(self.file),
            line: i64::try_from(self.line).ok(),
            system: "hamnosys".to_owned(),
            text: sign.text.clone(),
            document: notated_sign_document(&sign)?,
            ..NotationRow::default()
        };
        notations::set_token_notation(job.connection, &row)?;
        job.count_created_rows("notations", usize::from(is_new));
        report
            .findings
            .extend(lost_notation_finding(self.gloss, self.line, &mapped));
        Ok(())
    }
}

/// Returns the reason why a text cannot code a sign: it was garbled, or holds no symbol.
pub(super) fn uncoded_text_finding(gloss: &str, line: u64, text: &str) -> Option<ReportFinding> {
    let (message, remedy) = if is_garbled(text) {
        (
            format!(
                "{gloss}: its HamNoSys was saved as UTF-8 and read as Latin-1, and parts of it are lost; \
                 the sign was left uncoded"
            ),
            ErrorRemedy::from("export the source again as UTF-8, and import that"),
        )
    } else if !holds_some(text.as_bytes()) {
        (
            format!("{gloss}: {text:?} holds no HamNoSys; the sign was left uncoded by it"),
            ErrorRemedy::choice_remedy(
                RemedyChoice::TierRoles,
                "if the column holds something else, say so in a mapping: {\"columns\": {\"NAME\": \"attribute\"}}",
            ),
        )
    } else {
        return None;
    };
    let mut finding = ReportFinding::finding_warning(message, remedy);
    finding.line = Some(line);
    Some(finding)
}

/// Returns the stored form of a notated sign.
pub(super) fn notated_sign_document(sign: &NotatedSign) -> CorpusResult<String> {
    serde_json::to_string(sign).map_err(|error| {
        CorpusError::from_wrong_message(format!("the notation of {:?} cannot be stored: {error}", sign.gloss))
    })
}

/// Returns a finding about the parts of a notation that the components of the sign cannot express.
pub(super) fn lost_notation_finding(gloss: &str, line: u64, mapped: &MappedSign) -> Option<ReportFinding> {
    if mapped.lost.is_empty() {
        return None;
    }
    let lost = mapped.lost.join("; ");
    let mut note = ReportFinding::finding_note(format!(
        "{gloss}: the components come near the notation, but leave out {lost}"
    ));
    note.line = Some(line);
    Some(note)
}

/// Mapping of notation to the values of the corpus's inventories.
pub(super) struct NotationValueMapper<'i> {
    mapper: SignMapper<'i>,
    rows: BTreeMap<(SignComponent, Option<&'i str>), i64>,
}

impl<'i> NotationValueMapper<'i> {
    pub(super) fn new(inventories: &'i [StoredInventory]) -> Self {
        let mut rows = BTreeMap::new();
        for stored in inventories {
            let inventory = &stored.inventory;
            rows.entry((inventory.component, inventory.feature.as_deref()))
                .or_insert(stored.id);
        }
        let mapper = SignMapper::new(inventories.iter().map(|stored| &stored.inventory));
        Self { mapper, rows }
    }

    /// Returns the values of a sign in each component.
    pub(super) fn map_notated_sign(&self, sign: &NotatedSign) -> MappedSign {
        self.mapper.map_sign_components(sign)
    }

    /// Returns the values as rows for storage.
    pub(super) fn mapped_value_rows(&self, mapped: &MappedSign) -> Vec<TokenValueRow> {
        mapped.values.iter().map(|value| self.mapped_value_row(value)).collect()
    }

    fn mapped_value_row(&self, mapped: &MappedValue) -> TokenValueRow {
        let field = &mapped.field;
        let reading = ComponentReading::Value(mapped.value.clone());
        TokenValueRow {
            inventory_id: self.rows.get(&(field.component, field.feature.as_deref())).copied(),
            ..TokenValueRow::from_field_reading(field, &reading)
        }
    }
}
