//! Exports the corpus to files in other formats; the extension of the file determines the format.

#[cfg(test)]
mod avatar_tests;
mod csv;
mod enriched;
mod export_bvh;
mod export_dictionary;
pub(crate) mod export_eaf;
mod export_gate;
mod export_long;
mod export_notation;
mod export_subtitles;
mod foreign;
mod glb_figure;
#[cfg(test)]
mod mixed_tests;
mod movement_form;
#[cfg(feature = "parquet")]
mod parquet;
#[cfg(test)]
mod rig_tests;
mod several;
#[cfg(test)]
mod tests;

use csv::TableForm;

use std::fs::File;
use std::io::{self, BufWriter, Read, Write};
use std::path::{Path, PathBuf};

use chereme_formats::subtitles::SubtitleFormat as Subtitles;
use rusqlite::Connection;
use serde::Serialize;
use sha2::{Digest, Sha256};

use crate::Corpus;
use crate::address::{self, CorpusAddress, RecordingStretch, RowName};
use crate::atomic_write::check_folder;
use crate::consent::{OutputAudience, WithheldOutput};
use crate::curves;
use crate::db::stored_motion::to_hex_text;
use crate::db::stored_search as rows;
use crate::db::unfinished::{UnfinishedFile, remove_leftovers};
use crate::db::{seals, signs, stored_list, stored_recordings, stored_tiers};
use crate::error::{CorpusError, CorpusResult};
use crate::progress::ProgressReceiver;
use crate::track::TrackKind;
use crate::values;
use crate::words::format_noun_count;
use export_gate::ExportGate;
use export_long::LongTable;
pub use movement_form::MovementForm;

/// The part of the corpus to export.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ExportWhat {
    /// The object at an address.
    Address(CorpusAddress),
    /// These tokens in this order, such as the results of a query.
    Tokens(Vec<i64>),
    /// The objects at several addresses.
    Several(Vec<CorpusAddress>),
    /// The inventory of this name.
    Inventory(String),
    /// Everything.
    All,
}

/// Options for an export.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ExportOptions {
    /// Whether an existing file is replaced.
    pub force: bool,
    /// The format, as its extension without the dot, such as `bvh` or `curves.csv`. If it is given, a name without an
    /// extension is a folder with a file for each recording or token; otherwise the extension determines the format.
    pub format: Option<String>,
    /// Whether cells of a table that a spreadsheet would take for formulas get an apostrophe before them.
    pub spreadsheet_safe: bool,
    /// For whom it is written: what somebody did not agree to show them is left out.
    pub audience: OutputAudience,
    /// Whether a copy of everything has the history, with all that was deleted or changed.
    pub with_history: bool,
    /// The form of movement in BVH, GLB and VRMA.
    pub movement: MovementForm,
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
    pub left_out: Vec<LeftOutExport>,
    /// What was left out, because somebody did not agree that this audience sees it.
    pub withheld: Vec<WithheldOutput>,
}

/// A recording or token without a file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct LeftOutExport {
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
    /// | `.livelink.csv` | the captured face of one recording or token as Live Link Face writes it |
    /// | `.eaf` | the tiers of one recording, for ELAN |
    /// | `.bvh` | the movement of one recording or token |
    /// | `.glb` | the same as glTF with a person whose skin and face move, and the annotations, for Blender and the web |
    /// | `.bones.glb` | the same with visible bones in place of the person |
    /// | `.vrma` | the movement of a humanoid for avatars, its face as VRM's presets and gaze, its non-manuals as expressions |
    /// | `.c3d`, `.trc` | the markers of one recording or token |
    /// | `.markers.csv`, `.markers.tsv` | the same as a table of exact numbers, one row for each frame |
    /// | `.TextGrid` | the tiers of one recording, for Praat |
    /// | `.xra` | the same for SPPAS |
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
    pub fn export_corpus(
        &self,
        what: &ExportWhat,
        to: &Path,
        options: &ExportOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<ExportReport> {
        let connection = self.store.read_connection();
        let extension = to.extension().map(|text| text.to_string_lossy().to_lowercase());
        let mut report = ExportReport::default();
        let named_form = options.format.as_deref().map(find_export_format).transpose()?;
        let gate = ExportGate::open_export_gate(connection, what, options.audience)?;
        match (extension.as_deref(), what) {
            (None, _) if let Some((format, extension)) = named_form => {
                let reading = rows::begin_reading(connection)?;
                let (format, extension) = (format.fit_for(options)?, extension.as_str());
                let kind = several::FolderFileKind { format, extension };
                report = several::write_export_folder(&reading, what, kind, to, options, &gate, progress)?;
            }
            (None, ExportWhat::All) => {
                // A copy of everything is a rescue as well, so damage is noted and does not stop it.
                report.notes = damaged_rows(connection)?;
                let folder = enriched::write_enriched_folder(connection, to, &gate, options.with_history, progress)?;
                let files = folder.files;
                report.withheld = folder.withheld;
                report.notes.extend(folder.notes);
                report.files = files.into_iter().map(exported).collect::<CorpusResult<_>>()?;
            }
            (None, _) => {
                let message = "only everything can be written as a folder of all formats";
                return Err(no_format(to, message));
            }
            (Some(extension), _) => {
                let reading = rows::begin_reading(connection)?;
                let inner = inner_extension(to);
                let by_name = SingleFileFormat::from_export_extension(extension)
                    .map(|format| format.select_format_variant(&inner));
                let format = match named_form {
                    // A name that contradicts the format would mislead whoever opens the file later.
                    Some((format, named)) if by_name.is_some_and(|named_format| named_format != format) => {
                        return Err(CorpusError::from_wrong_message(format!(
                            "the name ends in .{extension}, and the format is {named}"
                        ))
                        .with_error_place(to.display().to_string())
                        .with_command_advice(format!("leave --format out, or end the name in .{named}")));
                    }
                    Some((format, _)) => format,
                    None => by_name.ok_or_else(|| unknown_format_error(to, extension))?,
                }
                .fit_for(options)?;
                let passed = gate.pass_export(&reading, what, format)?;
                report.withheld = passed.withheld;
                let file = write_whole_file(to, options.force, &mut |out| {
                    let mut job = ExportJob {
                        connection: &reading,
                        gate: &gate,
                        out,
                        notes: &mut report.notes,
                        progress,
                    };
                    write_file(&mut job, &passed.what, format)
                })?;
                report.files.push(file);
            }
        }
        report.notes.extend(gate.withheld_notes(&report.withheld));
        report.notes.extend(gate.notes);
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
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<Vec<String>> {
        let options = options.into();
        let (format, _) = find_export_format(options.format.as_deref().unwrap_or_default())?;
        let format = format.fit_for(&options)?;
        let reading = rows::begin_reading(self.store.read_connection())?;
        let mut notes = Vec::new();
        let gate = ExportGate::open_export_gate(&reading, what, options.audience)?;
        let passed = gate.pass_export(&reading, what, format)?;
        let mut job = ExportJob {
            connection: &reading,
            gate: &gate,
            out,
            notes: &mut notes,
            progress,
        };
        write_file(&mut job, &passed.what, format)?;
        notes.extend(gate.withheld_notes(&passed.withheld));
        notes.extend(gate.notes);
        Ok(notes)
    }
}

/// Returns the format with this extension, and the extension.
fn find_export_format<'o>(format: &str) -> CorpusResult<(SingleFileFormat<'o>, String)> {
    let extension = format.trim().trim_start_matches('.').to_lowercase();
    let (inner, last) = extension.split_once('.').unwrap_or(("", &extension));
    let inner_format = SingleFileFormat::from_export_extension(last).map(|format| format.select_format_variant(inner));
    match inner_format {
        Some(format) => Ok((format, extension)),
        None => Err(unknown_format_error(Path::new(format), &extension)),
    }
}

/// Returns the error for an unknown format, with the most similar common ones.
fn unknown_format_error(to: &Path, extension: &str) -> CorpusError {
    let wrong = |message: String, remedy: &str| {
        CorpusError::from_wrong_message(message)
            .with_error_place(to.display().to_string())
            .with_advice(remedy)
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

/// What the writer of a file reads and writes.
struct ExportJob<'a, 'p> {
    connection: &'a Connection,
    gate: &'a ExportGate,
    out: &'a mut dyn Write,
    /// Notes for the reader of the file.
    notes: &'a mut Vec<String>,
    progress: &'a mut ProgressReceiver<'p>,
}

/// A format of single files.
#[derive(Debug, Clone, Copy, PartialEq)]
enum SingleFileFormat<'o> {
    /// A table of tokens or annotations.
    Table(TableForm),
    /// A table of curves with this separator.
    Curves(u8),
    /// A captured face for programs that read Live Link Face.
    LiveLink,
    Eaf,
    Bvh(&'o MovementForm),
    Json,
    Glb(foreign::GlbLook, &'o MovementForm),
    Parquet(LongTable),
    Vrma(&'o MovementForm),
    /// Markers as a file of their own.
    Points(foreign::MarkerFileFormat),
    /// Markers as a table with this separator.
    Markers(u8),
    TextGrid,
    Xra,
    ElanTable,
    Subtitles(Subtitles),
    Notation(export_notation::NotationFileFormat),
}

impl<'o> SingleFileFormat<'o> {
    fn from_export_extension(extension: &str) -> Option<Self> {
        let as_captured = const { &MovementForm::AS_CAPTURED };
        match extension {
            "csv" => Some(Self::Table(TableForm::new(b','))),
            "tsv" => Some(Self::Table(TableForm::new(b'\t'))),
            "eaf" => Some(Self::Eaf),
            "bvh" => Some(Self::Bvh(as_captured)),
            "json" => Some(Self::Json),
            "glb" => Some(Self::Glb(foreign::GlbLook::Person, as_captured)),
            "parquet" => Some(Self::Parquet(LongTable::Tokens)),
            "vrma" => Some(Self::Vrma(as_captured)),
            "c3d" => Some(Self::Points(foreign::MarkerFileFormat::C3d)),
            "trc" => Some(Self::Points(foreign::MarkerFileFormat::Trc)),
            "textgrid" => Some(Self::TextGrid),
            "xra" => Some(Self::Xra),
            "srt" => Some(Self::Subtitles(Subtitles::Srt)),
            "vtt" => Some(Self::Subtitles(Subtitles::Vtt)),
            "sigml" => Some(Self::Notation(export_notation::NotationFileFormat::Gestural)),
            "hsigml" => Some(Self::Notation(export_notation::NotationFileFormat::Symbols)),
            "hns" | "txt" => Some(Self::Notation(export_notation::NotationFileFormat::Text)),
            _ => None,
        }
    }

    /// Returns the format with the options that change what it writes.
    fn fit_for(self, options: &'o ExportOptions) -> CorpusResult<Self> {
        let movement = &options.movement;
        if *movement != MovementForm::AS_CAPTURED && !matches!(self, Self::Bvh(_) | Self::Glb(..) | Self::Vrma(_)) {
            return Err(CorpusError::from_wrong_message(
                "only movement is written with another skeleton, frame rate or place",
            )
            .with_advice("end the name in .bvh, .glb or .vrma, or leave --skeleton, --fps and --in-place out"));
        }
        match self {
            Self::Table(form) => Ok(Self::Table(TableForm {
                is_spreadsheet_safe: options.spreadsheet_safe,
                ..form
            })),
            _ if options.spreadsheet_safe => Err(CorpusError::from_wrong_message(
                "only a table of tokens or annotations is written for spreadsheets",
            )
            .with_advice("end the name in .csv or .tsv, or leave --spreadsheet-safe out")),
            Self::Vrma(_) if movement.rig.is_some() => Err(CorpusError::from_wrong_message(
                "a VRMA file has the bones of VRM, which every avatar of VRM has",
            )
            .with_advice("leave --skeleton out, or end the name in .bvh or .glb")),
            Self::Bvh(_) => Ok(Self::Bvh(movement)),
            Self::Glb(look, _) => Ok(Self::Glb(look, movement)),
            Self::Vrma(_) => Ok(Self::Vrma(movement)),
            other => Ok(other),
        }
    }

    /// Returns the variant of a format that the extension before the last one selects, such as that of `x.curves.csv`.
    fn select_format_variant(self, inner: &str) -> Self {
        match (self, inner) {
            (Self::Table(form), "curves") => Self::Curves(form.delimiter),
            (Self::Table(form), "livelink") if form.delimiter == b',' => Self::LiveLink,
            (Self::Table(form), "markers") => Self::Markers(form.delimiter),
            (Self::Notation(export_notation::NotationFileFormat::Text), "elan") => Self::ElanTable,
            (Self::Glb(_, form), "bones") => Self::Glb(foreign::GlbLook::Bones, form),
            (Self::Parquet(_), inner) => Self::Parquet(LongTable::from_inner_extension(inner)),
            (other, _) => other,
        }
    }

    /// Reports whether the format holds tiers; a token then stands for its recording.
    fn is_of_tiers(self) -> bool {
        matches!(
            self,
            Self::Eaf | Self::TextGrid | Self::Xra | Self::ElanTable | Self::Subtitles(_)
        )
    }
}

/// Returns the extension before the last one, in lower case: `curves` of `x.curves.csv`.
fn inner_extension(to: &Path) -> String {
    let stem = to.file_stem().map(Path::new);
    let inner = stem.and_then(Path::extension);
    inner
        .map(|extension| extension.to_string_lossy().to_lowercase())
        .unwrap_or_default()
}

/// The note on importing the annotations of a GLB file as markers.
const GLB_MARKERS_NOTE: &str = "annotations become markers of Blender's timeline by `exec(bpy.context.scene[\"chereme_markers\"])` \
                       in its Python console after the import";

fn write_file(job: &mut ExportJob<'_, '_>, what: &ExportWhat, format: SingleFileFormat<'_>) -> CorpusResult<()> {
    let connection = job.connection;
    // Damaged rows must not go out unnoticed into files of others.
    verify(connection, what, format)?;
    let tokens = || selected_export_tokens(connection, what);
    let stretch = || selected_export_stretch(connection, what);
    match (format, what) {
        (SingleFileFormat::Json, ExportWhat::Inventory(name)) => {
            let text = values::find_stored_inventory(connection, name)?.inventory.to_json();
            let fault = |error: io::Error| CorpusError::from_wrong_message(error.to_string());
            job.out.write_all(text.as_bytes()).map_err(fault)
        }
        (SingleFileFormat::Json, _) => Err(CorpusError::from_wrong_message("only an inventory is written as JSON")
            .with_advice(
                "name one, such as inventory:configurations; tokens go into .csv or .tsv, everything into a folder",
            )),
        (_, ExportWhat::Inventory(name)) => Err(CorpusError::from_wrong_message(format!(
            "the inventory {name:?} is written as JSON"
        ))
        .with_advice("end the name of the file in .json")),
        (SingleFileFormat::Table(form), ExportWhat::Address(CorpusAddress::Tier(tier))) => {
            csv::write_annotation_csv(job, *tier, form)
        }
        (SingleFileFormat::Table(form), ExportWhat::Address(CorpusAddress::Recording(_)))
            if let Ok(stretch) = stretch()
                && tokens()?.is_empty()
                && foreign::has_track_kind(connection, stretch.recording.id, TrackKind::Curves)? =>
        {
            job.notes
                .push("the recording has no tokens: the table holds its curves".to_owned());
            foreign::write_number_table(job, &stretch, TrackKind::Curves, form.delimiter)
        }
        (SingleFileFormat::Table(form), _) => {
            let form = TableForm {
                audience: job.gate.export_audience().consent_audience(),
                ..form
            };
            csv::write_token_csv(job, &tokens()?, form)
        }
        (SingleFileFormat::Curves(delimiter), _) => write_face_curves(job, &stretch()?, delimiter),
        (SingleFileFormat::LiveLink, _) => foreign::write_live_link_file(job, &stretch()?),
        (SingleFileFormat::Eaf, _) => {
            let stretch = stretch()?;
            if stretch.token.is_some() {
                let name = &stretch.recording.name;
                job.notes.push(format!("the file holds all of the recording {name:?}"));
            }
            export_eaf::write_recording_eaf(connection, &stretch.recording, job.out)
        }
        (SingleFileFormat::Bvh(form), _) => {
            let stretch = stretch()?;
            job.notes.extend(export_bvh::late_start(connection, &stretch)?);
            match *form == MovementForm::AS_CAPTURED {
                true => export_bvh::write_bvh_stretch(connection, &stretch, job.out, job.progress)?,
                false => export_bvh::write_shaped_bvh(job, &stretch, form)?,
            };
            Ok(())
        }
        (SingleFileFormat::Glb(look, form), _) => {
            if foreign::write_glb_stretch(job, &stretch()?, (look, form))? > 0 {
                job.notes.push(GLB_MARKERS_NOTE.to_owned());
            }
            Ok(())
        }
        (SingleFileFormat::Parquet(long), _) => export_long::write_long_table(job, what, long),
        (SingleFileFormat::Vrma(form), _) => foreign::write_vrma_stretch(job, &stretch()?, form),
        (SingleFileFormat::Points(form), _) => foreign::write_marker_file(job, &stretch()?, form),
        (SingleFileFormat::Markers(delimiter), _) => {
            foreign::write_number_table(job, &stretch()?, TrackKind::Markers, delimiter)
        }
        (SingleFileFormat::ElanTable, _) => foreign::elan_table(job, &with_tiers(connection, stretch()?)?.recording),
        (SingleFileFormat::TextGrid, _) => foreign::text_grid(job, &with_tiers(connection, stretch()?)?.recording),
        (SingleFileFormat::Xra, _) => foreign::write_xra_file(job, &with_tiers(connection, stretch()?)?.recording),
        (SingleFileFormat::Subtitles(form), ExportWhat::Address(CorpusAddress::Tier(tier))) => {
            export_subtitles::write_tier_subtitles(job, *tier, form)
        }
        (SingleFileFormat::Subtitles(form), _) => export_subtitles::first_group(job, &stretch()?.recording, form),
        (SingleFileFormat::Notation(form), _) => export_notation::write_token_notations(job, &tokens()?, form),
    }
}

/// Writes the face of a recording's body as a table; without one, a track of curves as it was imported.
fn write_face_curves(job: &mut ExportJob<'_, '_>, stretch: &RecordingStretch, delimiter: u8) -> CorpusResult<()> {
    let connection = job.connection;
    let moves = stored_recordings::body_track(connection, stretch.recording.id)?.is_some();
    if moves && curves::has_some(connection, stretch)? {
        return curves::write_table(connection, stretch, delimiter, job.out);
    }
    foreign::write_number_table(job, stretch, TrackKind::Curves, delimiter)
}

/// Returns a note on each row that is not as it was stored: what can be read of a damaged corpus can be saved whole.
fn damaged_rows(connection: &Connection) -> CorpusResult<Vec<String>> {
    let mut notes = Vec::new();
    for table in seals::sealed_tables() {
        let broken = seals::broken_seals(connection, table)?;
        notes.extend(broken.iter().map(|rows| rows.broken_seal_error().to_string()));
    }
    Ok(notes)
}

/// Fails if rows that are written are not as they were stored.
fn verify(connection: &Connection, what: &ExportWhat, format: SingleFileFormat<'_>) -> CorpusResult<()> {
    let is_of_tokens = matches!(
        format,
        SingleFileFormat::Table(_)
            | SingleFileFormat::Notation(_)
            | SingleFileFormat::Parquet(LongTable::Tokens | LongTable::Components)
    );
    match what {
        ExportWhat::Inventory(_) => seals::verify_tables(connection, ["inventory", "inventory_value"]),
        ExportWhat::All => seals::verify_tables(connection, seals::tables_of(is_of_tokens)),
        ExportWhat::Address(CorpusAddress::Tier(tier)) => {
            let tier = stored_tiers::load_tier_row(connection, *tier)?;
            seals::verify_recordings(connection, &[tier.recording_id])
        }
        ExportWhat::Several(addresses) => addresses
            .iter()
            .try_for_each(|one| verify(connection, &ExportWhat::Address(one.clone()), format)),
        ExportWhat::Tokens(_) | ExportWhat::Address(_) => {
            // What cannot be found is refused by the format.
            let tokens = selected_export_tokens(connection, what).unwrap_or_default();
            seals::verify_tokens(connection, &tokens)?;
            let mut recordings: Vec<i64> = match selected_export_stretch(connection, what) {
                Ok(stretch) if !is_of_tokens || stretch.token.is_none() => {
                    vec![stretch.recording.id]
                }
                _ => Vec::new(),
            };
            if !is_of_tokens {
                let rows = signs::load_token_rows(connection, &tokens)?;
                recordings.extend(rows.values().filter_map(|token| token.recording_id));
            }
            seals::verify_recordings(connection, &recordings)
        }
    }
}

/// Returns the stretch; fails if its recording has no tiers.
fn with_tiers(connection: &Connection, stretch: RecordingStretch) -> CorpusResult<RecordingStretch> {
    if !stored_tiers::load_tier_rows(connection, stretch.recording.id)?.is_empty() {
        return Ok(stretch);
    }
    let name = &stretch.recording.name;
    Err(
        CorpusError::from_wrong_message(format!("the recording {name:?} has no tiers"))
            .with_command_advice(
                "add one with `chereme annotate CORPUS add-tier --in RECORDING NAME`, or export .eaf, which needs none",
            )
            .into_lacking_content(),
    )
}

fn no_format(to: &Path, message: &str) -> CorpusError {
    CorpusError::from_wrong_message(message).with_error_place(to.display().to_string()).with_advice(
        "end the name in .csv, .tsv, .curves.csv, .livelink.csv, .markers.csv, .eaf, .bvh, .glb, .vrma, .c3d, .trc, .parquet, .TextGrid, \
         .xra, .elan.txt, .srt, .vtt, .sigml, .hsigml or .hns, an \
         inventory's in .json; a name without a dot is a folder of everything, or with --format of a file for each \
         recording or token",
    )
}

/// Returns the selected tokens.
fn selected_export_tokens(connection: &Connection, what: &ExportWhat) -> CorpusResult<Vec<i64>> {
    let ids = |rows: Vec<signs::TokenRow>| rows.into_iter().map(|row| row.id).collect();
    match what {
        ExportWhat::All => stored_list::token_ids(connection),
        ExportWhat::Inventory(_) => Ok(Vec::new()),
        ExportWhat::Tokens(tokens) => Ok(tokens.clone()),
        ExportWhat::Several(addresses) => {
            let mut all = Vec::new();
            for address in addresses {
                for id in self::selected_export_tokens(connection, &ExportWhat::Address(address.clone()))? {
                    // Addresses may name the same token twice.
                    if !all.contains(&id) {
                        all.push(id);
                    }
                }
            }
            Ok(all)
        }
        ExportWhat::Address(CorpusAddress::Recording(name)) => {
            let recording = address::find_recording_by_name(connection, name)?;
            Ok(ids(signs::tokens_of_recording(connection, recording.id)?))
        }
        ExportWhat::Address(CorpusAddress::Signer(name)) => {
            let signer = address::find_signer_by_name(connection, name)?;
            stored_list::token_ids_of_signer(connection, signer.id)
        }
        ExportWhat::Address(CorpusAddress::Sign(RowName::Number(sign))) => {
            Ok(ids(signs::tokens_of_sign(connection, *sign)?))
        }
        ExportWhat::Address(CorpusAddress::Sign(RowName::Text(gloss))) => {
            let sign = address::find_sign_by_gloss(connection, gloss)?;
            Ok(ids(signs::tokens_of_sign(connection, sign)?))
        }
        ExportWhat::Address(token) => Ok(vec![address::find_addressed_token(connection, token)?.id]),
    }
}

/// Returns the selected recording or token, if it is a single one.
fn selected_export_stretch(connection: &Connection, what: &ExportWhat) -> CorpusResult<RecordingStretch> {
    let several = |count: usize, what: &str| {
        CorpusError::from_wrong_message(format!(
            "such a file holds one recording, and these are {}",
            format_noun_count(count as u64, what)
        ))
        .with_advice(
            "name one, such as recording:3 or token:41, or write a file for each with --to FOLDER --format bvh",
        )
    };
    match what {
        ExportWhat::Address(address) => address::find_addressed_stretch(connection, address),
        ExportWhat::Tokens(tokens) => match tokens.as_slice() {
            [one] => address::find_addressed_stretch(connection, &CorpusAddress::Token(*one)),
            tokens => Err(several(tokens.len(), "tokens")),
        },
        ExportWhat::Several(addresses) => match addresses.as_slice() {
            [one] => address::find_addressed_stretch(connection, one),
            all => Err(several(all.len(), "recordings and tokens")),
        },
        ExportWhat::Inventory(_) => Err(several(0, "recordings")),
        ExportWhat::All => match stored_recordings::load_recording_rows(connection)?.as_slice() {
            [one] => address::find_addressed_stretch(connection, &CorpusAddress::Recording(RowName::Number(one.id))),
            all => Err(several(all.len(), "recordings")),
        },
    }
}

/// Writes a file under a temporary name beside its path, and renames it when it is complete.
fn write_whole_file(
    to: &Path,
    force: bool,
    write: &mut dyn FnMut(&mut dyn Write) -> CorpusResult<()>,
) -> CorpusResult<ExportedFile> {
    remove_leftovers(to);
    UnnamedExportFile::write_unnamed_file(to, force, write)?.name_exported_file()
}

/// A complete file under a temporary name beside its path; it is removed unless it gets its name.
struct UnnamedExportFile {
    part: UnfinishedFile,
    file: ExportedFile,
}

impl UnnamedExportFile {
    fn write_unnamed_file(
        to: &Path,
        force: bool,
        write: &mut dyn FnMut(&mut dyn Write) -> CorpusResult<()>,
    ) -> CorpusResult<Self> {
        // A folder is never replaced by a file, not even by force.
        if to.is_dir() || (to.exists() && !force) {
            return Err(CorpusError::from_existing_file(to));
        }
        check_folder(to)?;
        let mut unnamed = Self {
            part: UnfinishedFile::create_unfinished_file(to)
                .map_err(|error| CorpusError::from_file_failure(to, error))?,
            file: ExportedFile {
                path: to.to_owned(),
                bytes: 0,
                sha256: String::new(),
            },
        };
        unnamed.fill_unnamed_file(write)?;
        Ok(unnamed)
    }

    fn fill_unnamed_file(&mut self, write: &mut dyn FnMut(&mut dyn Write) -> CorpusResult<()>) -> CorpusResult<()> {
        let to = self.file.path.clone();
        let fault = |error| CorpusError::from_file_failure(&to, error);
        let opened = File::options().write(true).open(self.part.unfinished_path());
        let file = opened.map_err(fault)?;
        let mut out = HashingWriter {
            out: BufWriter::with_capacity(1 << 20, file),
            digest: Sha256::new(),
            bytes: 0,
        };
        write(&mut out)?;
        let file = out.out.into_inner().map_err(|error| fault(error.into_error()))?;
        // The file gets its name only when its content is safe on the disk.
        file.sync_all().map_err(fault)?;
        self.file.bytes = out.bytes;
        self.file.sha256 = to_hex_text(&out.digest.finalize());
        Ok(())
    }

    /// Gives the file its name.
    fn name_exported_file(self) -> CorpusResult<ExportedFile> {
        let path = &self.file.path;
        let named = self.part.rename_unfinished(path);
        named.map_err(|error| CorpusError::from_file_failure(path, error))?;
        Ok(self.file)
    }
}

/// Writer that counts and hashes the bytes written to it.
struct HashingWriter<W> {
    out: W,
    digest: Sha256,
    bytes: u64,
}

impl<W: Write> Write for HashingWriter<W> {
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
fn exported(path: PathBuf) -> CorpusResult<ExportedFile> {
    let fault = |error| CorpusError::from_file_failure(&path, error);
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
    let sha256 = to_hex_text(&digest.finalize());
    Ok(ExportedFile { path, bytes, sha256 })
}
