//! The statistics as a table in a file.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;

use super::{Battison, Estimate, FieldAssociation, FieldInDepth, HandCondition, LexiconStatistics};
use crate::error::{Error, Result};
use crate::picture;

/// The most cells of a cross table that is written.
const MOST_CELLS: usize = 1_000_000;

impl LexiconStatistics {
    /// Writes a table of commas: the cross table of two fields, the values of one field, the exceptions to the
    /// conditions on the hands, or the overview of the fields, the first of these that was asked for.
    ///
    /// # Errors
    /// Fails if a file of this name exists and `force` is false, or it cannot be written; [`Error::Wrong`] for a cross
    /// table of more than a million cells.
    pub fn write_table(&self, to: &Path, force: bool) -> Result<()> {
        let rows = match (&self.between, &self.of, &self.battison) {
            (Some(it), _, _) => cross(it)?,
            (None, Some(it), _) => values(it),
            (None, None, Some(it)) => exceptions(it),
            (None, None, None) => self.overview(),
        };
        let mut writer = ::csv::Writer::from_writer(Vec::new());
        let fault = |error: ::csv::Error| Error::wrong(error.to_string());
        for row in rows {
            writer.write_record(row).map_err(fault)?;
        }
        let bytes = writer.into_inner();
        let bytes = bytes.map_err(|error| Error::wrong(error.to_string()))?;
        picture::write(to, force, |out| {
            out.write_all(&bytes)
                .map_err(|error| Error::file(to, error))
        })
        .map(drop)
    }

    fn overview(&self) -> Vec<Vec<String>> {
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
        rows.extend(self.fields.iter().map(|it| {
            let counts = [it.values, it.given, it.empty, it.successive];
            let mut row = vec![it.field.clone()];
            row.extend(counts.map(|count| count.to_string()));
            for estimate in [&it.entropy, &it.entropy_given, &it.load] {
                row.extend(numbers(estimate));
            }
            row
        }));
        rows
    }
}

/// Returns an estimate with the ends of its interval; an empty cell for a missing number.
fn numbers(of: &Estimate) -> [String; 3] {
    let number = |it: Option<f64>| it.map(|it| format!("{it:.6}")).unwrap_or_default();
    let ends = of.interval;
    [
        number(of.value),
        number(ends.map(|it| it.low)),
        number(ends.map(|it| it.high)),
    ]
}

/// Returns the values of a field.
fn values(of: &FieldInDepth) -> Vec<Vec<String>> {
    let titles = [
        of.field.as_str(),
        "count",
        "share",
        "share_low",
        "share_high",
    ];
    let mut rows = vec![titles.map(str::to_owned).to_vec()];
    rows.extend(of.values.iter().map(|it| {
        let share = Estimate {
            value: Some(it.share),
            why: None,
            interval: it.interval,
        };
        let mut row = vec![it.value.clone(), it.count.to_string()];
        row.extend(numbers(&share));
        row
    }));
    rows
}

/// Returns the cross table with its sums.
fn cross(of: &FieldAssociation) -> Result<Vec<Vec<String>>> {
    let cells = of.rows.len().saturating_mul(of.columns.len());
    if cells > MOST_CELLS {
        let text = format!(
            "the cross table would have {cells} cells, and at most {MOST_CELLS} are written"
        );
        return Err(Error::wrong(text).at(of.fields.join(" / ")).advise(
            crate::remedy::Remedy::command("`--json` has the cells that are not 0"),
        ));
    }
    let mut counts: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    for cell in &of.cells {
        counts.insert((&cell.row, &cell.column), cell.count);
    }
    let mut titles = vec![of.fields.join(" / ")];
    titles.extend(of.columns.iter().map(|it| it.value.clone()));
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
fn exceptions(of: &Battison) -> Vec<Vec<String>> {
    let titles = ["condition", "gloss", "strong", "weak", "line"];
    let mut rows = vec![titles.map(str::to_owned).to_vec()];
    let mut add = |name: &str, condition: &HandCondition| {
        rows.extend(condition.exceptions.iter().map(|it| {
            vec![
                name.to_owned(),
                it.gloss.clone(),
                it.strong.clone(),
                it.weak.clone(),
                it.line.map(|line| line.to_string()).unwrap_or_default(),
            ]
        }));
    };
    add("symmetry", &of.symmetry);
    add("dominance", &of.dominance);
    rows
}
