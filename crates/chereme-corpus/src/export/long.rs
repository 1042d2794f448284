//! The long tables of Parquet, and an error in their place in a program that was built without Parquet.

use std::io::Write;

#[cfg(not(feature = "parquet"))]
use chereme_sign::Remedy;
use rusqlite::Connection;

use super::ExportWhat;
use crate::error::Result;
use crate::progress::Progress;

/// The long tables of Parquet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Long {
    /// One row for each token.
    Tokens,
    /// One row for each value of a token.
    Components,
    /// One row for each annotation.
    Annotations,
    /// One row for each joint of a frame.
    Frames,
}

impl Long {
    /// Returns the table for the extension before `.parquet`.
    pub(super) fn of(inner: &str) -> Self {
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
pub(super) fn write(
    connection: &Connection,
    what: &ExportWhat,
    long: Long,
    out: &mut dyn Write,
    notes: &mut Vec<String>,
    progress: &mut Progress<'_>,
) -> Result<()> {
    use super::parquet;
    match long {
        Long::Tokens => {
            let tokens = super::tokens(connection, what)?;
            parquet::tokens(connection, &tokens, out, notes, progress)
        }
        Long::Components => {
            let tokens = super::tokens(connection, what)?;
            parquet::components(connection, &tokens, out, progress)
        }
        Long::Annotations => {
            let stretches = stretches(connection, what, notes)?;
            parquet::annotations(connection, &stretches, out, progress)
        }
        Long::Frames => {
            let stretches = stretches(connection, what, notes)?;
            parquet::frames(connection, &stretches, out, progress)
        }
    }
}

/// Returns the selected recordings and tokens; lexicon entries are left out, as they have neither annotations nor
/// frames.
#[cfg(feature = "parquet")]
fn stretches(
    connection: &Connection,
    what: &ExportWhat,
    notes: &mut Vec<String>,
) -> Result<Vec<crate::address::Stretch>> {
    use crate::address::{self, Address, Name};
    use crate::db::{recordings, signs};
    use crate::words::counted;
    let of = |id: i64| address::stretch(connection, &Address::Recording(Name::Number(id)));
    let mut several = Vec::new();
    match what {
        ExportWhat::All => {
            let all = recordings::recordings(connection)?.into_iter();
            return all.map(|row| of(row.id)).collect();
        }
        ExportWhat::Address(Address::Recording(name)) => {
            return Ok(vec![of(address::recording(connection, name)?.id)?]);
        }
        ExportWhat::Several(addresses) => {
            for address in addresses {
                let one = ExportWhat::Address(address.clone());
                several.extend(stretches(connection, &one, notes)?);
            }
            return Ok(several);
        }
        _ => {}
    }
    let mut entries = 0;
    for id in super::tokens(connection, what)? {
        if signs::token(connection, id)?.recording_id.is_some() {
            several.push(address::stretch(connection, &Address::Token(id))?);
        } else {
            entries += 1;
        }
    }
    if entries > 0 {
        let entries = counted(entries, "tokens");
        notes.push(format!("{entries} of the lexicon are in no recording"));
    }
    Ok(several)
}

/// Refuses Parquet, because this program was built without it.
///
/// # Errors
/// Always fails; the error names the formats that can be written instead.
#[cfg(not(feature = "parquet"))]
pub(super) fn write(
    _connection: &Connection,
    _what: &ExportWhat,
    long: Long,
    _out: &mut dyn Write,
    _notes: &mut Vec<String>,
    _progress: &mut Progress<'_>,
) -> Result<()> {
    let instead = match long {
        Long::Tokens | Long::Components => "write .csv, which pandas, polars and DuckDB read, too",
        Long::Annotations => "export a tier as .csv, or a folder of everything",
        Long::Frames => "export .bvh, or a folder of everything",
    };
    Err(
        crate::error::Error::wrong("this program was built without Parquet").advise(
            Remedy::command(format!(
                "build it with `cargo build --release --features parquet`; or {instead}"
            )),
        ),
    )
}
