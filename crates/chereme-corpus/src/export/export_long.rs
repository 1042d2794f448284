//! The long tables of Parquet, and an error in their place in a program that was built without Parquet.

use super::ExportJob;
use super::ExportWhat;
use crate::error::CorpusResult;

/// The long tables of Parquet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum LongTable {
    /// One row for each token.
    Tokens,
    /// One row for each value of a token.
    Components,
    /// One row for each annotation.
    Annotations,
    /// One row for each joint of a frame.
    Frames,
}

impl LongTable {
    /// Returns the table for the extension before `.parquet`.
    pub(super) fn from_inner_extension(inner: &str) -> Self {
        match inner {
            "components" => Self::Components,
            "annotations" => Self::Annotations,
            "frames" => Self::Frames,
            _ => Self::Tokens,
        }
    }
}

/// Writes a long table as Parquet.
///
/// # Errors
/// Fails if `what` does not exist, rows are damaged, or `out` fails.
#[cfg(feature = "parquet")]
pub(super) fn write_long_table(job: &mut ExportJob<'_, '_>, what: &ExportWhat, long: LongTable) -> CorpusResult<()> {
    use super::parquet;
    match long {
        LongTable::Tokens => {
            let tokens = super::selected_export_tokens(job.connection, what)?;
            parquet::write_token_parquet(job, &tokens)
        }
        LongTable::Components => {
            let tokens = super::selected_export_tokens(job.connection, what)?;
            parquet::write_component_parquet(job, &tokens)
        }
        LongTable::Annotations => {
            let stretches = select_long_stretches(job, what)?;
            parquet::write_annotation_parquet(job, &stretches)
        }
        LongTable::Frames => {
            let stretches = select_long_stretches(job, what)?;
            parquet::write_frame_parquet(job, &stretches)
        }
    }
}

/// Returns the selected recordings and tokens; lexicon entries are left out, as they have neither annotations nor
/// frames.
#[cfg(feature = "parquet")]
fn select_long_stretches(
    job: &mut ExportJob<'_, '_>,
    what: &ExportWhat,
) -> CorpusResult<Vec<crate::address::RecordingStretch>> {
    let connection = job.connection;
    use crate::address::{self, CorpusAddress, RowName};
    use crate::db::{signs, stored_recordings};
    use crate::words::format_noun_count;
    let of = |id: i64| address::find_addressed_stretch(connection, &CorpusAddress::Recording(RowName::Number(id)));
    let mut several = Vec::new();
    match what {
        ExportWhat::All => {
            let all = stored_recordings::load_recording_rows(connection)?.into_iter();
            return all.map(|row| of(row.id)).collect();
        }
        ExportWhat::Address(CorpusAddress::Recording(name)) => {
            return Ok(vec![of(address::find_recording_by_name(connection, name)?.id)?]);
        }
        ExportWhat::Several(addresses) => {
            for address in addresses {
                let one = ExportWhat::Address(address.clone());
                several.extend(select_long_stretches(job, &one)?);
            }
            return Ok(several);
        }
        _ => {}
    }
    let mut entries = 0;
    for id in super::selected_export_tokens(connection, what)? {
        if signs::load_token_row(connection, id)?.recording_id.is_some() {
            several.push(address::find_addressed_stretch(connection, &CorpusAddress::Token(id))?);
        } else {
            entries += 1;
        }
    }
    if entries > 0 {
        let entries = format_noun_count(entries, "tokens");
        job.notes.push(format!("{entries} of the lexicon are in no recording"));
    }
    Ok(several)
}

/// Refuses Parquet, because this program was built without it.
///
/// # Errors
/// Always fails; the error names the formats that can be written instead.
#[cfg(not(feature = "parquet"))]
pub(super) fn write_long_table(_job: &mut ExportJob<'_, '_>, _what: &ExportWhat, long: LongTable) -> CorpusResult<()> {
    let instead = match long {
        LongTable::Tokens | LongTable::Components => "write .csv, which pandas, polars and DuckDB read, too",
        LongTable::Annotations => "export a tier as .csv, or a folder of everything",
        LongTable::Frames => "export .bvh, or a folder of everything",
    };
    Err(
        crate::error::CorpusError::from_wrong_message("this program was built without Parquet").with_command_advice(
            format!("build it with `cargo build --release --features parquet`; or {instead}"),
        ),
    )
}
