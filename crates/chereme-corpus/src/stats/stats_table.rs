//! The statistics as a table in a file.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;

use super::{BattisonConditions, FieldAssociation, FieldInDepth, HandCondition, LexiconStatistics, StatsEstimate};
use crate::atomic_write;
use crate::error::{CorpusError, CorpusResult};

/// The most cells of a cross table that is written.
const MAX_CROSS_TABLE_CELLS: usize = 1_000_000;

/// Writes rows with commas between their cells; a file of this name is replaced only with `force`.
pub(super) fn write_table_rows(rows: Vec<Vec<String>>, to: &Path, force: bool) -> CorpusResult<()> {
    let mut writer = ::csv::Writer::from_writer(Vec::new());
    let fault = |error: ::csv::Error| CorpusError::from_wrong_message(error.to_string());
    for row in rows {
        writer.write_record(row).map_err(fault)?;
    }
    let written = writer.into_inner();
    let bytes = written.map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
    atomic_write::write_atomically(to, force, |out| {
        out.write_all(&bytes)
            .map_err(|error| CorpusError::from_file_failure(to, error))
    })
    .map(drop)
}

impl LexiconStatistics {
    /// Writes a table of commas: the cross table of two fields, the values of one field, the exceptions to the
    /// conditions on the hands, or the overview of the fields, the first of these that was asked for.
    ///
    /// # Errors
    /// Fails if a file of this name exists and `force` is false, or it cannot be written; [`CorpusError::Wrong`] for a cross
    /// table of more than a million cells.
    pub fn write_table(&self, to: &Path, force: bool) -> CorpusResult<()> {
        let rows = match (&self.between, &self.of, &self.battison) {
            (Some(it), _, _) => cross_table_rows(it)?,
            (None, Some(it), _) => field_values_table(it),
            (None, None, Some(it)) => battison_exceptions_table(it),
            (None, None, None) => self.overview_table(),
        };
        write_table_rows(rows, to, force)
    }

    fn overview_table(&self) -> Vec<Vec<String>> {
        let titles = [
            "field",
            "values",
            "given",
            "empty",
            "successive",
            "entropy",
            "entropy_low",
            "entropy_high",
            "entropy_given",
            "entropy_given_low",
            "entropy_given_high",
            "load",
            "load_low",
            "load_high",
        ];
        let mut rows = vec![titles.map(str::to_owned).to_vec()];
        rows.extend(self.fields.iter().map(|field| {
            let counts = [field.values, field.given, field.empty, field.successive];
            let mut row = vec![field.field.clone()];
            row.extend(counts.map(|count| count.to_string()));
            for estimate in [&field.entropy, &field.entropy_given, &field.load] {
                row.extend(estimate_cells(estimate));
            }
            row
        }));
        rows
    }
}

/// Returns an estimate with the ends of its interval; an empty cell for a missing number.
fn estimate_cells(of: &StatsEstimate) -> [String; 3] {
    let number = |option: Option<f64>| option.map(|value| format!("{value:.6}")).unwrap_or_default();
    let ends = of.interval;
    [
        number(of.value),
        number(ends.map(|interval| interval.low)),
        number(ends.map(|interval| interval.high)),
    ]
}

/// Returns the values of a field.
fn field_values_table(of: &FieldInDepth) -> Vec<Vec<String>> {
    let titles = [of.field.as_str(), "count", "share", "share_low", "share_high"];
    let mut rows = vec![titles.map(str::to_owned).to_vec()];
    rows.extend(of.values.iter().map(|value| {
        let share = StatsEstimate {
            value: Some(value.share),
            why: None,
            interval: value.interval,
        };
        let mut row = vec![value.value.clone(), value.count.to_string()];
        row.extend(estimate_cells(&share));
        row
    }));
    rows
}

/// Returns the cross table with its sums.
fn cross_table_rows(of: &FieldAssociation) -> CorpusResult<Vec<Vec<String>>> {
    let cells = of.rows.len().saturating_mul(of.columns.len());
    if cells > MAX_CROSS_TABLE_CELLS {
        let text = format!("the cross table would have {cells} cells, and at most {MAX_CROSS_TABLE_CELLS} are written");
        return Err(CorpusError::from_wrong_message(text)
            .with_error_place(of.fields.join(" / "))
            .with_advice(crate::remedy::ErrorRemedy::command_remedy(
                "`--json` has the cells that are not 0",
            )));
    }
    let mut counts: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    for cell in &of.cells {
        counts.insert((&cell.row, &cell.column), cell.count);
    }
    let mut titles = vec![of.fields.join(" / ")];
    titles.extend(of.columns.iter().map(|column| column.value.clone()));
    titles.push("all".to_owned());
    let mut rows = vec![titles];
    rows.extend(of.rows.iter().map(|row| {
        let mut cells = vec![row.value.clone()];
        cells.extend(of.columns.iter().map(|column| {
            let count = counts.get(&(row.value.as_str(), column.value.as_str()));
            count.copied().unwrap_or(0).to_string()
        }));
        cells.push(row.count.to_string());
        cells
    }));
    Ok(rows)
}

/// Returns the exceptions to both conditions.
fn battison_exceptions_table(of: &BattisonConditions) -> Vec<Vec<String>> {
    let titles = ["condition", "gloss", "strong", "weak", "line"];
    let mut rows = vec![titles.map(str::to_owned).to_vec()];
    let mut add = |name: &str, condition: &HandCondition| {
        rows.extend(condition.exceptions.iter().map(|exception| {
            vec![
                name.to_owned(),
                exception.gloss.clone(),
                exception.strong.clone(),
                exception.weak.clone(),
                exception.line.map(|line| line.to_string()).unwrap_or_default(),
            ]
        }));
    };
    add("symmetry", &of.symmetry);
    add("dominance", &of.dominance);
    rows
}
