//! `chereme import`: takes files and folders into a corpus, and reports how each was interpreted.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Result;
use chereme_corpus::words::{InterfaceLanguage, fill_text_braces, trouble_words};
use chereme_corpus::{
    Corpus, CorpusError, FileJoining, FileReport, FileStatus, GLOSSES_FROM_NAMES, ImportOptions, ImportReport,
    JoinedRecording, OwnEdits, RecordOrigin, ReportFinding, TierMapping,
};
use chereme_motion::BodySide;
use chereme_motion::anatomy::RolesError;

use crate::args::{BODY_SIDE_CHOICES, CommandLine, NamedChoices, read_named_text, wrong_text};
use crate::output::{CommandOutput, with_progress_bar};
use crate::streams::{self, StandInFile};

/// Import recordings, annotations, lexicons and inventories into a corpus
#[derive(Debug, clap::Args)]
#[command(long_about = long_about(), after_help = "\
Examples:
  chereme import mine.chereme FOLDER
  chereme import mine.chereme take.bvh take.eaf --dry-run
  chereme import ngt.chereme sigml/
  chereme import mine.chereme takes/ --gloss-from-name
  chereme import mine.chereme take.eaf --merge
  chereme import mine.chereme take.eaf --map tiers.json
  chereme import mine.chereme face.csv --into recording:3 --offset 0.48s
  chereme import mine.chereme take.bvh --timecode 10:22:31:12@25")]
pub(crate) struct ImportArgs {
    /// The corpus
    corpus: PathBuf,
    /// Files and folders; - is standard input, with its kind in --format
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// The kind of the file on standard input, as an extension: eaf, bvh, csv, sigml ...
    #[arg(long, value_name = "FORMAT")]
    format: Option<String>,
    /// The name of the recording or table on standard input
    #[arg(long, value_name = "NAME", default_value = "stdin")]
    name: String,
    /// Give each take without tokens one whose gloss is the take's name, over the sign that is found in its movement
    #[arg(long)]
    gloss_from_name: bool,
    /// Report what would be done, and write nothing
    #[arg(long)]
    dry_run: bool,
    /// The signer who moves
    #[arg(long, value_name = "NAME")]
    signer: Option<String>,
    /// The signer's dominant hand
    #[arg(long, value_parser = BODY_SIDE_CHOICES)]
    handedness: Option<BodySide>,
    /// The unit of length of the movement files: m, cm, mm, inch, ft, acclaim, or metres per unit
    #[arg(long, value_parser = parse_length_unit)]
    unit: Option<f64>,
    /// The axes of the movement files: the directions up and to the signer's left, such as +Z,+X
    #[arg(long, value_name = "UP,LEFT", allow_hyphen_values = true)]
    axes: Option<chereme_motion::SignerAxes>,
    /// A file that assigns joints to parts of the body, in lines such as `right wrist = RHand`
    #[arg(long, value_name = "FILE")]
    roles: Option<PathBuf>,
    /// Read the root's columns as the numbers suggest if the header gives a wrong order or unit
    #[arg(long)]
    mend_root: bool,
    /// A JSON file with the meaning of tiers or columns
    #[arg(long, value_name = "FILE")]
    map: Option<PathBuf>,
    /// Keep your edits and take the file's other changes; if both changed the same annotation, yours stays
    #[arg(long, conflicts_with_all = ["theirs", "mine"])]
    merge: bool,
    /// Take everything from the file, even if it takes back your edits
    #[arg(long, conflicts_with = "mine")]
    theirs: bool,
    /// Leave a recording as it is if the file would take back your edits
    #[arg(long)]
    mine: bool,
    /// The origin of the recordings
    #[arg(long, value_parser = RECORD_ORIGIN_CHOICES)]
    origin: Option<RecordOrigin>,
    /// The terms under which the recordings may be used
    #[arg(long, value_name = "TEXT")]
    licence: Option<String>,
    /// The lexicon to which the signs of tables and notation belong; without it a table is one of its own, and notation
    /// belongs to the only one of the corpus
    #[arg(long, value_name = "NAME")]
    lexicon: Option<String>,
    /// The sign language of that lexicon, as a code of ISO 639-3 such as dse
    #[arg(long, value_name = "CODE", requires = "lexicon")]
    sign_language: Option<String>,
    /// The recording for all tracks and tiers of the files, instead of the one with the files' name
    #[arg(long, value_name = "RECORDING", value_parser = super::track_command::parse_recording_address)]
    into: Option<chereme_corpus::RowName>,
    /// The evidence that joins files into one recording
    #[arg(long, value_parser = FILE_JOINING_CHOICES, value_name = "EVIDENCE", default_value = "certain")]
    join: FileJoining,
    /// The start of the files' tracks on the recording's clock, such as 0.48s
    #[arg(long, value_name = "TIME", value_parser = super::track_command::parse_time_micros, allow_hyphen_values = true,
          default_value = "0s")]
    offset: i64,
    /// The time of day at which the files' tracks start, if they do not state it: 12:34:56:07, or 12:34:56:07@25 for 25
    /// frames a second. Tracks of a recording with known times of day are aligned by them
    #[arg(long, value_name = "TIMECODE", value_parser = parse_import_timecode)]
    timecode: Option<chereme_motion::RecordingInstant>,
    /// The frame rate of points from film and of tables of markers that do not state it, in frames per second, such as 50
    /// or 30000/1001
    #[arg(long, value_name = "RATE", value_parser = parse_import_rate)]
    rate: Option<chereme_motion::FrameRate>,
}

/// The rules by which files are grouped and interpreted, for the help.
const IMPORT_RULES_HELP: &str = "Files of the same name in one folder become one recording; so does a film that an .eaf names, \
and, within a folder, a file of another kind whose timecode overlaps. What only may belong together, such as files of \
the same name in two folders, is not joined but listed with what to do (--join, --into), and the report says what was \
joined and why. A line of HamNoSys holds the gloss, a tab, and the symbols. The report shows how each file was \
interpreted. Options override this, also later: --map gives an imported file other tiers or columns. A corpus that does \
not exist yet is created. If a file cannot be read, the others are imported.";

/// The treatment of files that are imported again, for the help.
const REIMPORT_HELP: &str = "An annotation file that was imported before and edited since updates its recording, annotation by \
annotation. If that would take back edits made in the corpus, the file is refused and the edits are listed; then \
--merge, --theirs or --mine decides. One import is one operation: `chereme undo` takes it back, and Ctrl-C leaves the \
corpus as it was.";

/// Returns the long help, with the endings that the table of readers lists.
fn long_about() -> String {
    let about = "Import recordings, annotations, lexicons and inventories into a corpus";
    let files = chereme_corpus::readable_files(InterfaceLanguage::English);
    [about, &files, IMPORT_RULES_HELP, REIMPORT_HELP].join("\n\n")
}

fn parse_import_timecode(text: &str) -> Result<chereme_motion::RecordingInstant, String> {
    let instant = chereme_corpus::time_of_day(text);
    instant.ok_or_else(|| "write hours, minutes, seconds and frames: 12:34:56:07@25".to_owned())
}

fn parse_import_rate(text: &str) -> Result<chereme_motion::FrameRate, String> {
    let parts = text.split_once('/').unwrap_or((text, "1"));
    let [frames, seconds] = [parts.0, parts.1].map(|part| part.trim().parse::<u32>().ok());
    let rate = frames
        .zip(seconds)
        .and_then(|(frames, seconds)| chereme_motion::FrameRate::new(frames, seconds).ok());
    rate.ok_or_else(|| "write a whole number such as 50, or a fraction such as 30000/1001".to_owned())
}

/// The origins of recordings.
const RECORD_ORIGIN_CHOICES: NamedChoices<RecordOrigin> = NamedChoices(&[
    ("captured", "", RecordOrigin::Captured),
    ("made", "", RecordOrigin::Made),
    ("generated", "", RecordOrigin::Generated),
]);

/// The evidence that joins files.
const FILE_JOINING_CHOICES: NamedChoices<FileJoining> = NamedChoices(&[
    (
        "certain",
        "Folder and name, what an annotation file says, and a true timecode within a folder",
        FileJoining::Certain,
    ),
    (
        "name",
        "Also the same name in another folder, if only one recording has it",
        FileJoining::Name,
    ),
    (
        "timecode",
        "Also any timecode, in neighbouring folders too",
        FileJoining::Timecode,
    ),
    ("none", "Folder and name alone", FileJoining::None),
]);

/// The lengths in metres that a unit of length may have: from a micrometre to a kilometre.
const LENGTH_UNIT_METRES: std::ops::RangeInclusive<f64> = 1e-6..=1e3;

fn parse_length_unit(text: &str) -> Result<f64, String> {
    match text.to_lowercase().as_str() {
        "m" => Ok(1.0),
        "cm" => Ok(0.01),
        "mm" => Ok(0.001),
        "inch" | "in" => Ok(0.0254),
        "ft" | "feet" => Ok(0.3048),
        "acclaim" => Ok(0.0254 / 0.45),
        other => match other.parse::<f64>() {
            Ok(metres) if LENGTH_UNIT_METRES.contains(&metres) => Ok(metres),
            Ok(metres) if metres.is_finite() => Err("a unit of length has between 0.000001 and 1000 metres".to_owned()),
            _ => Err("write m, cm, mm, inch, ft, acclaim, or how many metres one unit is".to_owned()),
        },
    }
}

pub(super) fn run(cli: &CommandLine, args: &ImportArgs, output: &mut CommandOutput) -> Result<ExitCode> {
    let mut options = import_options(args)?;
    let (files, stands) = list_import_files(args)?;
    options.standard_input = stands.first().map(|stand_in| stand_in.path.clone());
    let scratch = tempfile_for(args)?;
    let path = scratch.as_ref().map_or(&args.corpus, |scratch| &scratch.1);
    // Whether the corpus is new decides what a failure leaves behind.
    let fresh = !path.exists();
    let mut corpus = if fresh {
        Corpus::create_corpus(path, &cli.history_author())?
    } else {
        cli.open_cli_corpus(path)?
    };
    let report = with_progress_bar(|progress| corpus.import_paths(&files, &options, progress));
    // Everything was refused and nothing is in it.
    let empty = |report: &ImportReport| report.has_refusals() && report.created.values().all(|count| *count == 0);
    // A corpus of a dry run lies in a temporary folder.
    if fresh && scratch.is_none() {
        if report.as_ref().map_or(true, empty) {
            // A failed import leaves no empty corpus behind.
            drop(corpus);
            let _ = std::fs::remove_file(path);
        } else {
            output.filled_line("made {path}", &[&path.display()])?;
        }
    }
    let report = report?;
    print_import_report(&report, output)?;
    let refused = report.has_refusals();
    output.set_json_document(report)?;
    Ok(if refused { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}

/// Returns the files to import, with a temporary file for standard input.
fn list_import_files(args: &ImportArgs) -> Result<(Vec<PathBuf>, Vec<StandInFile>)> {
    let mut stands = Vec::new();
    let mut files = args.files.clone();
    for file in files.iter_mut().filter(|file| streams::is_standard(file)) {
        let format = args.format.as_deref().ok_or_else(|| {
            CorpusError::from_wrong_message("standard input has no extension that says its kind")
                .with_error_place("-")
                .with_advice("name it, as with --format eaf")
        })?;
        // The name becomes a file's, so that it must not lead to another folder.
        if !format.chars().all(|c| c.is_alphanumeric() || c == '.') || args.name.contains(['/', '\\']) {
            return Err(CorpusError::from_wrong_message(format!(
                "{format:?} is no extension of a file, or {:?} no name",
                args.name
            ))
            .with_error_place(format)
            .with_advice("write --format eaf, and --name take1")
            .into());
        }
        if chereme_corpus::is_film(&format!("film.{format}")) {
            return Err(CorpusError::from_wrong_message(
                "a corpus stores the path of a film, and standard input has none",
            )
            .with_error_place(format)
            .with_advice("name the file of the film")
            .into());
        }
        let stand = streams::stdin_stand_in(&args.name, format)?;
        file.clone_from(&stand.path);
        stands.push(stand);
    }
    Ok((files, stands))
}

/// Returns a temporary corpus for a dry run, if the named one does not exist yet.
fn tempfile_for(args: &ImportArgs) -> Result<Option<(tempfile::TempDir, PathBuf)>> {
    // A dry run must not create the corpus that it was asked about.
    if !args.dry_run || args.corpus.exists() {
        return Ok(None);
    }
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("dry-run.chereme");
    Ok(Some((folder, path)))
}

fn import_options(args: &ImportArgs) -> Result<ImportOptions> {
    let roles = args.roles.as_ref().map(|path| -> Result<_> {
        let text = read_named_text(path)?;
        let advice = "write lines such as `right wrist = RHand`, each a part of the body and a joint";
        Ok(text
            .parse()
            .map_err(|error: RolesError| wrong_text(path, error, advice))?)
    });
    let mapping = args.map.as_ref().map(|path| -> Result<_> {
        let text = read_named_text(path)?;
        let advice = "write a JSON object such as {\"tiers\": {\"Tier 1\": \"right.configuration\"}}";
        Ok(TierMapping::from_json(&text).map_err(|error| wrong_text(path, error, advice))?)
    });
    Ok(ImportOptions {
        signer: args.signer.clone(),
        handedness: args.handedness.map(|hand| hand.body_side_name().to_owned()),
        metres_per_unit: args.unit,
        axes: args.axes,
        roles: roles.transpose()?,
        mend_root: args.mend_root,
        mapping: mapping.transpose()?.unwrap_or_default(),
        origin: args.origin,
        licence: args.licence.clone(),
        lexicon: args.lexicon.clone(),
        sign_language: args.sign_language.clone(),
        own_edits: match (args.merge, args.theirs, args.mine) {
            (true, _, _) => OwnEdits::Merge,
            (_, true, _) => OwnEdits::Theirs,
            (_, _, true) => OwnEdits::Mine,
            _ => OwnEdits::Ask,
        },
        into: args.into.clone(),
        joining: args.join,
        offset_us: args.offset,
        clock: args.timecode,
        rate: args.rate,
        completion: args.gloss_from_name.then_some(GLOSSES_FROM_NAMES),
        dry_run: args.dry_run,
        standard_input: None,
    })
}

/// If there are more files than this, only those with a warning are shown.
const MAX_SHOWN_FILES: usize = 50;

fn print_import_report(report: &ImportReport, output: &mut CommandOutput) -> Result<()> {
    let many = report.files.len() > MAX_SHOWN_FILES;
    let mut quiet = 0;
    for file in &report.files {
        let plain = |severity: &str| severity == "note";
        // In long lists only what needs attention is shown.
        if many && file.findings.iter().all(|finding| plain(finding.severity)) {
            quiet += usize::from(matches!(file.status, FileStatus::Imported | FileStatus::Updated));
        } else {
            print_file(file, output)?;
        }
    }
    if quiet > 0 {
        output.filled_line(
            "{n} more files were imported without a warning; --json lists their notes",
            &[&quiet],
        )?;
    }
    print_joined_recordings(&report.joined, output)?;
    for kind in report.unread_file_kinds() {
        let what = match kind.ending {
            Some(ending) => format!("{} .{ending}", kind.files.len()),
            None => format!("{} without an ending", kind.files.len()),
        };
        let why = output.translate_message(&kind.why);
        output.filled_line("not read: {what} ({why})", &[&what, &why])?;
        // Three names show what kind of files they are.
        for file in kind.files.iter().take(MAX_NAMED_UNREAD) {
            output.line_as_is(&format!("  {file}"))?;
        }
        if kind.files.len() > MAX_NAMED_UNREAD {
            output.filled_line("  and {n} more", &[&(kind.files.len() - MAX_NAMED_UNREAD)])?;
        }
        if let Some(remedy) = kind.remedy {
            let remedy = output.translate_message(remedy.remedy_text());
            output.filled_line("    what to do: {what}", &[&remedy])?;
        }
    }
    for finding in &report.findings {
        print_finding(finding, output)?;
    }
    let noun = |(what, count): (&&'static str, &u64)| output.format_counted_noun(*count, what);
    let counts = |counts: &BTreeMap<&'static str, u64>| -> String {
        let counts = counts.iter().filter(|(_, count)| **count > 0);
        counts.map(noun).collect::<Vec<_>>().join(", ")
    };
    let lines = [
        ("would make", "made", counts(&report.created)),
        ("would change", "changed", counts(&report.changed)),
        ("would remove", "removed", counts(&report.removed)),
    ];
    let mut any = false;
    for (would, did, all) in lines {
        if !all.is_empty() {
            any = true;
            output.write_output_line(format!("{}: {all}", if report.dry_run { would } else { did }))?;
        }
    }
    if !any {
        output.write_output_line("nothing new")?;
    }
    Ok(())
}

/// Prints for each recording that files joined which they are, and why.
fn print_joined_recordings(joined: &[JoinedRecording], output: &mut CommandOutput) -> Result<()> {
    for recording in joined.iter().take(MAX_SHOWN_FILES) {
        output.filled_line(
            "recording {name} holds {file} and",
            &[&format_args!("{:?}", recording.recording), &recording.with],
        )?;
        for file in &recording.files {
            let why = output.translate_message(file.by.join_reason_text());
            output.line_as_is(&format!("  {} ({why})", file.path))?;
        }
    }
    if joined.len() > MAX_SHOWN_FILES {
        let more = joined.len() - MAX_SHOWN_FILES;
        output.filled_line("{n} more recordings hold several files; --json lists them", &[&more])?;
    }
    Ok(())
}

/// The number of unread files of one kind that are named; further ones are only counted.
const MAX_NAMED_UNREAD: usize = 3;

fn print_file(file: &FileReport, output: &mut CommandOutput) -> Result<()> {
    // Skipped files of a folder are of kinds that nobody asked for.
    let status = match file.status {
        FileStatus::Skipped => return Ok(()),
        FileStatus::Imported => "",
        FileStatus::Updated => ": updated",
        FileStatus::Unchanged => ": unchanged",
        FileStatus::Refused => ": REFUSED",
    };
    match &file.recording {
        Some(name) => output.filled_line(
            &format!("{{file}}{status} -> recording {{name}}"),
            &[&file.path, &format_args!("{name:?}")],
        )?,
        None => output.filled_line(&format!("{{file}}{status}"), &[&file.path])?,
    }
    if let Some(movement) = &file.understood.movement {
        output.filled_line(
            "  {n} joints, {rate}, unit {unit}, axes up,left = {axes}",
            &[&movement.joints, &movement.frame_rate, &movement.unit, &movement.axes],
        )?;
    }
    for track in file.understood.tracks.iter().flatten() {
        if let Some(line) = track.track_description_line() {
            output.write_output_line(format!("  {line}"))?;
        }
    }
    for guess in file.understood.guessed_tiers() {
        let topic = guess.guessed_tier_topic().map(|topic| topic.to_string());
        let role_text = topic.unwrap_or_else(|| "not known".to_owned());
        let role = output.translate_message(&role_text);
        output.filled_line("  tier {name}: {role}", &[&guess.tier, &role])?;
    }
    if let Some(lexicon) = &file.understood.lexicon {
        output.filled_line("  lexicon {name}", &[lexicon])?;
    }
    for column in file.understood.columns.iter().flatten() {
        output.filled_line(
            "  column {name}: {meaning}",
            &[&column.title, &output.translate_message(&column.meaning.to_string())],
        )?;
    }
    let (shown, more) = without_repetition(&file.findings);
    for finding in shown {
        print_finding(finding, output)?;
    }
    if more > 0 {
        output.filled_line("  and {n} more findings like these, all of them with --json", &[&more])?;
    }
    Ok(())
}

/// The number of findings of a file with the same remedy that are listed.
const MAX_ALIKE_FINDINGS: usize = 10;

/// Returns the findings to list, and the number of those left out because many others have the same remedy.
fn without_repetition(findings: &[ReportFinding]) -> (Vec<&ReportFinding>, usize) {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    let mut shown = Vec::new();
    for finding in findings {
        // A finding without a remedy is always listed.
        let count = finding.remedy.as_ref().map_or(0, |remedy| {
            let count = counts.entry(remedy.remedy_text()).or_default();
            *count += 1;
            *count
        });
        if count <= MAX_ALIKE_FINDINGS {
            shown.push(finding);
        }
    }
    let more = findings.len() - shown.len();
    (shown, more)
}

pub(super) fn print_finding(finding: &ReportFinding, output: &mut CommandOutput) -> Result<()> {
    let line = match finding.line {
        Some(line) => fill_text_braces(output.output_text(trouble_words::LINE), &[("n", &line)]),
        None => String::new(),
    };
    let message = output.translate_message(&finding.message);
    let form = format!("  {}: {{what}}", finding.severity);
    output.filled_line(&form, &[&format!("{line}{message}")])?;
    if let Some(remedy) = &finding.remedy {
        let what = output.translate_message(remedy.remedy_text());
        let remedy = fill_text_braces(output.output_text(trouble_words::WHAT_TO_DO), &[("what", &what)]);
        output.line_as_is(&format!("  {remedy}"))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_of_length_is_a_name_or_a_sensible_number_of_metres() {
        let form = "write m, cm, mm, inch, ft, acclaim, or how many metres one unit is";
        let range = "a unit of length has between 0.000001 and 1000 metres";
        for (text, want) in [
            ("cm", Ok(0.01)),
            ("0.02", Ok(0.02)),
            ("1e-6", Ok(1e-6)),
            ("1000", Ok(1000.0)),
            ("1e300", Err(range)),
            ("1001", Err(range)),
            ("1e-7", Err(range)),
            ("0", Err(range)),
            ("-1", Err(range)),
            ("1e999", Err(form)),
            ("nan", Err(form)),
            ("yard", Err(form)),
        ] {
            assert_eq!(parse_length_unit(text), want.map_err(str::to_owned), "{text}");
        }
    }

    #[test]
    fn findings_with_one_remedy_are_listed_a_few_times() {
        let finding = |line: u64, remedy: Option<&str>| ReportFinding {
            severity: "warning",
            line: Some(line),
            message: format!("the sign {line} has no notation"),
            remedy: remedy.map(Into::into),
        };
        let same = (0..40).map(|line| finding(line, Some("export it again")));
        let mut findings: Vec<ReportFinding> = same.collect();
        findings.push(finding(40, None));
        findings.push(finding(41, Some("give it a gloss")));
        let (shown, more) = without_repetition(&findings);
        assert_eq!((shown.len(), more), (12, 30));
        let last: Vec<_> = shown[10..].iter().map(|it| it.line).collect();
        assert_eq!(last, [Some(40), Some(41)]);
        assert_eq!(without_repetition(&findings[30..]).1, 0);
    }
}
