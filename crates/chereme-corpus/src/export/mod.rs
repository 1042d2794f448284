//! Exports the corpus to files in other formats; the extension of the file determines the format.

#[cfg(test)]
mod avatar_tests;
mod bvh;
mod csv;
mod dictionary;
pub(crate) mod eaf;
mod enriched;
mod foreign;
mod long;
#[cfg(test)]
mod mixed_tests;
mod notation;
#[cfg(feature = "parquet")]
mod parquet;
mod several;
mod subtitles;
#[cfg(test)]
mod tests;

use csv::TableForm;
pub(crate) use csv::compound;

use std::fs::File;
use std::io::{self, BufWriter, Read, Write};
use std::path::{Path, PathBuf};

use chereme_formats::subtitles::Form as Subtitles;
use chereme_sign::Remedy;
use rusqlite::Connection;
use serde::Serialize;
use sha2::{Digest, Sha256};

use crate::Corpus;
use crate::address::{self, Address, Name, Stretch};
use crate::curves;
use crate::db::motion::hex;
use crate::db::search as rows;
use crate::db::unfinished::{Unfinished, remove_leftovers};
use crate::db::{list, recordings, seals, signs, tiers};
use crate::error::{Error, Result};
use crate::progress::Progress;
use crate::track::TrackKind;
use crate::values;
use crate::words::counted;
use long::Long;

/// The part of the corpus to export.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ExportWhat {
    /// The object at an address.
    Address(Address),
    /// These tokens in this order, such as the results of a query.
    Tokens(Vec<i64>),
    /// The objects at several addresses.
    Several(Vec<Address>),
    /// The inventory of this name.
    Inventory(String),
    /// Everything.
    All,
}

/// Options for an export.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ExportOptions {
    /// Whether an existing file is replaced.
    pub force: bool,
    /// The format, as its extension without the dot, such as `bvh` or `curves.csv`. If it is given, a name without an
    /// extension is a folder with a file for each recording or token; otherwise the extension determines the format.
    pub format: Option<String>,
    /// Whether cells of a table that a spreadsheet would take for formulas get an apostrophe before them.
    pub spreadsheet_safe: bool,
}

impl From<&str> for ExportOptions {
    /// Returns the options for a format alone.
    fn from(format: &str) -> Self {
        Self {
            format: Some(format.to_owned()),
            ..Self::default()
        }
    }
}

/// The result of an export.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct ExportReport {
    /// The files.
    pub files: Vec<ExportedFile>,
    /// Notes for the reader of the files.
    pub notes: Vec<String>,
    /// The recordings and tokens without a file, because they hold nothing for the format.
    pub left_out: Vec<LeftOut>,
}

/// A recording or token without a file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct LeftOut {
    /// The recording's name, or the token's gloss.
    pub name: String,
    /// What it lacks.
    pub why: String,
}

/// A file that was written.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ExportedFile {
    /// Its path.
    pub path: PathBuf,
    /// Its size in bytes.
    pub bytes: u64,
    /// Its SHA-256, in hexadecimal.
    pub sha256: String,
}

impl Corpus {
    /// Writes a part of the corpus, or all of it, to `to`.
    ///
    /// | extension | what is written |
    /// |---|---|
    /// | `.csv`, `.tsv` | one row for each token, with its components; or the annotations of a tier |
    /// | `.curves.csv`, `.curves.tsv` | the scalar curves of one recording or token, one row for each frame |
    /// | `.eaf` | the tiers of one recording, for ELAN |
    /// | `.bvh` | the movement of one recording or token |
    /// | `.glb` | the same as glTF with a skin, visible bones and the annotations, for Blender and the web |
    /// | `.vrma` | the movement of a humanoid for avatars, its face as VRM's presets and gaze, its non-manuals as expressions |
    /// | `.c3d`, `.trc` | the markers of one recording or token |
    /// | `.markers.csv`, `.markers.tsv` | the same as a table of exact numbers, one row for each frame |
    /// | `.TextGrid` | the tiers of one recording, for Praat |
    /// | `.elan.txt` | the same in the form of ELAN's tab-delimited export |
    /// | `.srt`, `.vtt` | the translations or glosses of one recording as subtitles, one language; or a tier |
    /// | `.parquet`, `.components.parquet` | one row for each token, or each value of a token (feature `parquet`) |
    /// | `.annotations.parquet`, `.frames.parquet` | one row for each annotation, or joint of a frame (same feature) |
    /// | `.sigml` | notated tokens as gestural SiGML |
    /// | `.hsigml` | notated tokens as H-SiGML, HamNoSys's symbols as elements |
    /// | `.hns`, `.txt` | notated tokens as HamNoSys text, one line for each sign: the gloss, a tab, the text |
    /// | `.json` | an inventory, in the form that can be imported |
    /// | none | everything, as a folder of files that anyone can read |
    /// | none, with a format | a folder with a file of that format for each recording or token |
    ///
    /// A file appears complete or not at all.
    ///
    /// # Errors
    /// Fails if the extension belongs to no format, if `what` cannot be written in it, or if the file or folder already
    /// exists.
    pub fn export(
        &self,
        what: &ExportWhat,
        to: &Path,
        options: &ExportOptions,
        progress: &mut Progress<'_>,
    ) -> Result<ExportReport> {
        let connection = self.store.read();
        let extension = to
            .extension()
            .map(|text| text.to_string_lossy().to_lowercase());
        let mut report = ExportReport::default();
        let form = options.format.as_deref().map(named).transpose()?;
        let form = match form {
            Some((format, extension)) => Some((format.fit_for(options)?, extension)),
            None => None,
        };
        match (extension.as_deref(), what) {
            (None, _) if let Some((format, extension)) = form => {
                let reading = rows::begin_reading(connection)?;
                let form = (format, extension.as_str());
                return several::write(&reading, what, form, to, options, progress);
            }
            (None, ExportWhat::All) => {
                report.notes = damaged_rows(connection)?;
                let files = enriched::write(connection, to, progress)?;
                report.files = files.into_iter().map(exported).collect::<Result<_>>()?;
            }
            (None, _) => {
                let message = "only everything can be written as a folder of all formats";
                return Err(no_format(to, message));
            }
            (Some(extension), _) => {
                let reading = rows::begin_reading(connection)?;
                let inner = inner_extension(to);
                let by_name = Format::of(extension).map(|format| format.within(&inner));
                let format = match form {
                    Some((format, named)) if by_name.is_some_and(|it| it != format) => {
                        return Err(Error::wrong(format!(
                            "the name ends in .{extension}, and the format is {named}"
                        ))
                        .at(to.display().to_string())
                        .advise(Remedy::command(format!(
                            "leave --format out, or end the name in .{named}"
                        ))));
                    }
                    Some((format, _)) => format,
                    None => by_name.ok_or_else(|| unknown(to, extension))?,
                }
                .fit_for(options)?;
                let file = whole(to, options.force, &mut |out| {
                    let notes = &mut report.notes;
                    write_file(&reading, what, format, out, notes, progress)
                })?;
                report.files.push(file);
            }
        }
        Ok(report)
    }

    /// Writes a part of the corpus to `out` in the format that the options name, and returns notes for the
    /// reader of the output.
    ///
    /// # Errors
    /// Fails if there is no such format, or if `what` cannot be written in it.
    pub fn export_stream(
        &self,
        what: &ExportWhat,
        options: impl Into<ExportOptions>,
        out: &mut dyn Write,
        progress: &mut Progress<'_>,
    ) -> Result<Vec<String>> {
        let options = options.into();
        let (format, _) = named(options.format.as_deref().unwrap_or_default())?;
        let format = format.fit_for(&options)?;
        let reading = rows::begin_reading(self.store.read())?;
        let mut notes = Vec::new();
        write_file(&reading, what, format, out, &mut notes, progress)?;
        Ok(notes)
    }
}

/// Returns the format with this extension, and the extension.
fn named(format: &str) -> Result<(Format, String)> {
    let extension = format.trim().trim_start_matches('.').to_lowercase();
    let (inner, last) = extension.split_once('.').unwrap_or(("", &extension));
    let found = Format::of(last).map(|format| format.within(inner));
    match found {
        Some(format) => Ok((format, extension)),
        None => Err(unknown(Path::new(format), &extension)),
    }
}

/// Returns the error for an unknown format, with the most similar common ones.
fn unknown(to: &Path, extension: &str) -> Error {
    let wrong = |message: String, remedy: &str| {
        Error::wrong(message)
            .at(to.display().to_string())
            .advise(remedy)
    };
    match extension {
        "gltf" | "fbx" | "usd" | "usda" | "usdz" => wrong(
            format!("{extension} is not written"),
            "write .glb or .bvh, which Blender and others read",
        ),
        "png" | "gif" | "svg" => wrong(
            format!("{extension} is a picture"),
            "draw it with `chereme render CORPUS WHAT --to FILE`",
        ),
        "json" => wrong(
            "json is not written as a file".to_owned(),
            "add --json to `chereme list` or `chereme search`; export all to a folder for the inventories",
        ),
        _ => no_format(to, &format!("{extension:?} is no format")),
    }
}

/// A format of single files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    /// A table of tokens or annotations.
    Table(TableForm),
    /// A table of curves with this separator.
    Curves(u8),
    Eaf,
    Bvh,
    Json,
    Glb,
    Parquet(Long),
    Vrma,
    /// Markers as a file of their own.
    Points(foreign::Points),
    /// Markers as a table with this separator.
    Markers(u8),
    TextGrid,
    ElanTable,
    Subtitles(Subtitles),
    Notation(notation::Form),
}

impl Format {
    fn of(extension: &str) -> Option<Self> {
        match extension {
            "csv" => Some(Self::Table(TableForm::new(b','))),
            "tsv" => Some(Self::Table(TableForm::new(b'\t'))),
            "eaf" => Some(Self::Eaf),
            "bvh" => Some(Self::Bvh),
            "json" => Some(Self::Json),
            "glb" => Some(Self::Glb),
            "parquet" => Some(Self::Parquet(Long::Tokens)),
            "vrma" => Some(Self::Vrma),
            "c3d" => Some(Self::Points(foreign::Points::C3d)),
            "trc" => Some(Self::Points(foreign::Points::Trc)),
            "textgrid" => Some(Self::TextGrid),
            "srt" => Some(Self::Subtitles(Subtitles::Srt)),
            "vtt" => Some(Self::Subtitles(Subtitles::Vtt)),
            "sigml" => Some(Self::Notation(notation::Form::Gestural)),
            "hsigml" => Some(Self::Notation(notation::Form::Symbols)),
            "hns" | "txt" => Some(Self::Notation(notation::Form::Text)),
            _ => None,
        }
    }

    /// Returns the format with the options that change what it writes.
    fn fit_for(self, options: &ExportOptions) -> Result<Self> {
        match self {
            Self::Table(form) => Ok(Self::Table(TableForm {
                is_spreadsheet_safe: options.spreadsheet_safe,
                ..form
            })),
            _ if options.spreadsheet_safe => Err(Error::wrong(
                "only a table of tokens or annotations is written for spreadsheets",
            )
            .advise("end the name in .csv or .tsv, or leave --spreadsheet-safe out")),
            other => Ok(other),
        }
    }

    /// Returns the variant of a format that the extension before the last one selects, such as that of `x.curves.csv`.
    fn within(self, inner: &str) -> Self {
        match (self, inner) {
            (Self::Table(form), "curves") => Self::Curves(form.delimiter),
            (Self::Table(form), "markers") => Self::Markers(form.delimiter),
            (Self::Notation(notation::Form::Text), "elan") => Self::ElanTable,
            (Self::Parquet(_), inner) => Self::Parquet(Long::of(inner)),
            (other, _) => other,
        }
    }

    /// Reports whether the format holds tiers; a token then stands for its recording.
    fn is_of_tiers(self) -> bool {
        matches!(
            self,
            Self::Eaf | Self::TextGrid | Self::ElanTable | Self::Subtitles(_)
        )
    }
}

/// Returns the extension before the last one, in lower case: `curves` of `x.curves.csv`.
fn inner_extension(to: &Path) -> String {
    let stem = to.file_stem().map(Path::new);
    let inner = stem.and_then(Path::extension);
    inner
        .map(|it| it.to_string_lossy().to_lowercase())
        .unwrap_or_default()
}

/// The note on importing the annotations of a GLB file as markers.
const MARKERS: &str = "annotations become markers of Blender's timeline by `exec(bpy.context.scene[\"chereme_markers\"])` \
                       in its Python console after the import";

fn write_file(
    connection: &Connection,
    what: &ExportWhat,
    format: Format,
    out: &mut dyn Write,
    notes: &mut Vec<String>,
    progress: &mut Progress<'_>,
) -> Result<()> {
    verify(connection, what, format)?;
    match (format, what) {
        (Format::Json, ExportWhat::Inventory(name)) => {
            let text = values::named(connection, name)?.inventory.to_json();
            let fault = |error: io::Error| Error::wrong(error.to_string());
            out.write_all(text.as_bytes()).map_err(fault)
        }
        (Format::Json, _) => Err(Error::wrong("only an inventory is written as JSON").advise(
            "name one, such as inventory:configurations; tokens go into .csv or .tsv, everything into a folder",
        )),
        (_, ExportWhat::Inventory(name)) => {
            Err(Error::wrong(format!("the inventory {name:?} is written as JSON"))
                .advise("end the name of the file in .json"))
        }
        (Format::Table(form), ExportWhat::Address(Address::Tier(tier))) => {
            csv::annotations(connection, *tier, form, out)
        }
        (Format::Table(form), ExportWhat::Address(Address::Recording(_)))
            if let Ok(stretch) = stretch(connection, what)
                && tokens(connection, what)?.is_empty()
                && foreign::has(connection, stretch.recording.id, TrackKind::Curves)? =>
        {
            notes.push("the recording has no tokens: the table holds its curves".to_owned());
            foreign::numbers(connection, &stretch, TrackKind::Curves, form.delimiter, out, notes)
        }
        (Format::Table(form), _) => {
            let tokens = tokens(connection, what)?;
            csv::tokens(connection, &tokens, form, out, notes, progress)
        }
        (Format::Curves(delimiter), _) => {
            let stretch = stretch(connection, what)?;
            let moves = recordings::body_track(connection, stretch.recording.id)?.is_some();
            let shows = moves && curves::has_some(connection, &stretch)?;
            if !shows {
                return foreign::numbers(connection, &stretch, TrackKind::Curves, delimiter, out, notes);
            }
            curves::write_table(connection, &stretch, delimiter, out)
        }
        (Format::Eaf, _) => {
            let stretch = stretch(connection, what)?;
            if stretch.token.is_some() {
                let name = &stretch.recording.name;
                notes.push(format!("the file holds all of the recording {name:?}"));
            }
            eaf::write(connection, &stretch.recording, out)
        }
        (Format::Bvh, _) => {
            let stretch = stretch(connection, what)?;
            notes.extend(bvh::late_start(connection, &stretch)?);
            bvh::write(connection, &stretch, out, progress).map(|_| ())
        }
        (Format::Glb, _) => {
            let stretch = stretch(connection, what)?;
            if foreign::glb(connection, &stretch, out)? > 0 {
                notes.push(MARKERS.to_owned());
            }
            Ok(())
        }
        (Format::Parquet(long), _) => long::write(connection, what, long, out, notes, progress),
        (Format::Vrma, _) => {
            let stretch = stretch(connection, what)?;
            foreign::vrma(connection, &stretch, out, notes)
        }
        (Format::Points(form), _) => {
            let stretch = stretch(connection, what)?;
            foreign::points(connection, &stretch, form, out, notes)
        }
        (Format::Markers(delimiter), _) => {
            let stretch = stretch(connection, what)?;
            foreign::numbers(connection, &stretch, TrackKind::Markers, delimiter, out, notes)
        }
        (Format::ElanTable, _) => {
            let stretch = stretch(connection, what)?;
            has_tiers(connection, &stretch)?;
            foreign::elan_table(connection, &stretch.recording, out)
        }
        (Format::TextGrid, _) => {
            let stretch = stretch(connection, what)?;
            has_tiers(connection, &stretch)?;
            foreign::text_grid(connection, &stretch.recording, out, notes)
        }
        (Format::Subtitles(form), ExportWhat::Address(Address::Tier(tier))) => {
            subtitles::tier(connection, *tier, form, out)
        }
        (Format::Subtitles(form), _) => {
            let stretch = stretch(connection, what)?;
            subtitles::first_group(connection, &stretch.recording, form, out, notes)
        }
        (Format::Notation(form), _) => {
            let tokens = tokens(connection, what)?;
            notation::write(connection, &tokens, form, out, notes, progress)
        }
    }
}

/// Returns a note on each row that is not as it was stored: what can be read of a damaged corpus can be saved whole.
fn damaged_rows(connection: &Connection) -> Result<Vec<String>> {
    let mut notes = Vec::new();
    for table in seals::sealed_tables() {
        let broken = seals::broken_seals(connection, table)?;
        notes.extend(broken.iter().map(|rows| rows.error().to_string()));
    }
    Ok(notes)
}

/// Fails if rows that are written are not as they were stored.
fn verify(connection: &Connection, what: &ExportWhat, format: Format) -> Result<()> {
    let is_of_tokens = matches!(
        format,
        Format::Table(_) | Format::Notation(_) | Format::Parquet(Long::Tokens | Long::Components)
    );
    match what {
        ExportWhat::Inventory(_) => {
            seals::verify_tables(connection, ["inventory", "inventory_value"])
        }
        ExportWhat::All => seals::verify_tables(connection, seals::tables_of(is_of_tokens)),
        ExportWhat::Address(Address::Tier(tier)) => {
            let tier = tiers::tier(connection, *tier)?;
            seals::verify_recordings(connection, &[tier.recording_id])
        }
        ExportWhat::Several(addresses) => addresses
            .iter()
            .try_for_each(|one| verify(connection, &ExportWhat::Address(one.clone()), format)),
        ExportWhat::Tokens(_) | ExportWhat::Address(_) => {
            // What cannot be found is refused by the format.
            let tokens = tokens(connection, what).unwrap_or_default();
            seals::verify_tokens(connection, &tokens)?;
            let mut recordings: Vec<i64> = match stretch(connection, what) {
                Ok(stretch) if !is_of_tokens || stretch.token.is_none() => {
                    vec![stretch.recording.id]
                }
                _ => Vec::new(),
            };
            if !is_of_tokens {
                let rows = signs::tokens(connection, &tokens)?;
                recordings.extend(rows.values().filter_map(|token| token.recording_id));
            }
            seals::verify_recordings(connection, &recordings)
        }
    }
}

/// Fails if a recording has no tiers.
fn has_tiers(connection: &Connection, stretch: &Stretch) -> Result<()> {
    if !tiers::tiers(connection, stretch.recording.id)?.is_empty() {
        return Ok(());
    }
    let name = &stretch.recording.name;
    Err(Error::wrong(format!("the recording {name:?} has no tiers"))
        .advise(Remedy::command(
            "add one with `chereme annotate CORPUS add-tier --in RECORDING NAME`, or export .eaf, which needs none",
        ))
        .lacking())
}

fn no_format(to: &Path, message: &str) -> Error {
    Error::wrong(message).at(to.display().to_string()).advise(
        "end the name in .csv, .tsv, .curves.csv, .markers.csv, .eaf, .bvh, .glb, .vrma, .c3d, .trc, .parquet, .TextGrid, \
         .elan.txt, .srt, .vtt, .sigml, .hsigml or .hns, an \
         inventory's in .json; a name without a dot is a folder of everything, or with --format of a file for each \
         recording or token",
    )
}

/// Returns the selected tokens.
fn tokens(connection: &Connection, what: &ExportWhat) -> Result<Vec<i64>> {
    let ids = |rows: Vec<signs::TokenRow>| rows.into_iter().map(|row| row.id).collect();
    match what {
        ExportWhat::All => list::token_ids(connection),
        ExportWhat::Inventory(_) => Ok(Vec::new()),
        ExportWhat::Tokens(tokens) => Ok(tokens.clone()),
        ExportWhat::Several(addresses) => {
            let mut all = Vec::new();
            for address in addresses {
                for id in self::tokens(connection, &ExportWhat::Address(address.clone()))? {
                    if !all.contains(&id) {
                        all.push(id);
                    }
                }
            }
            Ok(all)
        }
        ExportWhat::Address(Address::Recording(name)) => {
            let recording = address::recording(connection, name)?;
            Ok(ids(signs::tokens_of_recording(connection, recording.id)?))
        }
        ExportWhat::Address(Address::Signer(name)) => {
            let signer = address::signer(connection, name)?;
            list::token_ids_of_signer(connection, signer.id)
        }
        ExportWhat::Address(Address::Sign(Name::Number(sign))) => {
            Ok(ids(signs::tokens_of_sign(connection, *sign)?))
        }
        ExportWhat::Address(Address::Sign(Name::Text(gloss))) => {
            let sign = address::sign(connection, gloss)?;
            Ok(ids(signs::tokens_of_sign(connection, sign)?))
        }
        ExportWhat::Address(token) => Ok(vec![address::token(connection, token)?.id]),
    }
}

/// Returns the selected recording or token, if it is a single one.
fn stretch(connection: &Connection, what: &ExportWhat) -> Result<Stretch> {
    let several = |count: usize, what: &str| {
        Error::wrong(format!(
            "such a file holds one recording, and these are {}",
            counted(count as u64, what)
        ))
        .advise("name one, such as recording:3 or token:41, or write a file for each with --to FOLDER --format bvh")
    };
    match what {
        ExportWhat::Address(address) => address::stretch(connection, address),
        ExportWhat::Tokens(tokens) => match tokens.as_slice() {
            [one] => address::stretch(connection, &Address::Token(*one)),
            tokens => Err(several(tokens.len(), "tokens")),
        },
        ExportWhat::Several(addresses) => match addresses.as_slice() {
            [one] => address::stretch(connection, one),
            all => Err(several(all.len(), "recordings and tokens")),
        },
        ExportWhat::Inventory(_) => Err(several(0, "recordings")),
        ExportWhat::All => match recordings::recordings(connection)?.as_slice() {
            [one] => address::stretch(connection, &Address::Recording(Name::Number(one.id))),
            all => Err(several(all.len(), "recordings")),
        },
    }
}

/// Writes a file under a temporary name beside its path, and renames it when it is complete.
fn whole(
    to: &Path,
    force: bool,
    write: &mut dyn FnMut(&mut dyn Write) -> Result<()>,
) -> Result<ExportedFile> {
    remove_leftovers(to);
    Unnamed::write(to, force, write)?.name()
}

/// A complete file under a temporary name beside its path; it is removed unless it gets its name.
struct Unnamed {
    part: Unfinished,
    file: ExportedFile,
}

impl Unnamed {
    fn write(
        to: &Path,
        force: bool,
        write: &mut dyn FnMut(&mut dyn Write) -> Result<()>,
    ) -> Result<Self> {
        if to.is_dir() || (to.exists() && !force) {
            return Err(Error::file(to, io::ErrorKind::AlreadyExists.into()));
        }
        check_folder(to)?;
        let mut unnamed = Self {
            part: Unfinished::file(to).map_err(|error| Error::file(to, error))?,
            file: ExportedFile {
                path: to.to_owned(),
                bytes: 0,
                sha256: String::new(),
            },
        };
        unnamed.fill(write)?;
        Ok(unnamed)
    }

    fn fill(&mut self, write: &mut dyn FnMut(&mut dyn Write) -> Result<()>) -> Result<()> {
        let to = self.file.path.clone();
        let fault = |error| Error::file(&to, error);
        let file = File::options().write(true).open(self.part.path());
        let file = file.map_err(fault)?;
        let mut out = Hashed {
            out: BufWriter::with_capacity(1 << 20, file),
            digest: Sha256::new(),
            bytes: 0,
        };
        write(&mut out)?;
        let file = out
            .out
            .into_inner()
            .map_err(|error| fault(error.into_error()))?;
        file.sync_all().map_err(fault)?;
        self.file.bytes = out.bytes;
        self.file.sha256 = hex(&out.digest.finalize());
        Ok(())
    }

    /// Gives the file its name.
    fn name(self) -> Result<ExportedFile> {
        let path = &self.file.path;
        let named = self.part.rename(path);
        named.map_err(|error| Error::file(path, error))?;
        Ok(self.file)
    }
}

/// Fails if the folder of the path does not exist.
pub(crate) fn check_folder(to: &Path) -> Result<()> {
    let folder = to.parent().unwrap_or(to);
    if folder.as_os_str().is_empty() || folder.is_dir() {
        return Ok(());
    }
    let message = format!("the folder {} is not there", folder.display());
    Err(Error::wrong(message).advise("make it first, or choose another place"))
}

/// Writer that counts and hashes the bytes written to it.
struct Hashed<W> {
    out: W,
    digest: Sha256,
    bytes: u64,
}

impl<W: Write> Write for Hashed<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.out.write(bytes)?;
        self.digest.update(&bytes[..written]);
        self.bytes += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// Returns a file of a folder in the form for reports.
fn exported(path: PathBuf) -> Result<ExportedFile> {
    let fault = |error| Error::file(&path, error);
    let mut file = File::open(&path).map_err(fault)?;
    let (mut digest, mut buffer, mut bytes) = (Sha256::new(), vec![0; 1 << 20], 0);
    loop {
        match file.read(&mut buffer).map_err(fault)? {
            0 => break,
            read => {
                digest.update(&buffer[..read]);
                bytes += read as u64;
            }
        }
    }
    let sha256 = hex(&digest.finalize());
    Ok(ExportedFile {
        path,
        bytes,
        sha256,
    })
}
