//! `chereme annotate`: adds, changes and removes annotations, one by one or from a table.

use std::path::{Path, PathBuf};

use anyhow::Result;
use chereme_corpus::annotate_paste::PasteOptions;
use chereme_corpus::words::history_words::annotation_sentence;
use chereme_corpus::words::{fill_text_braces, trouble_words};
use chereme_corpus::{
    AnnotateOptions, AnnotateReport, AnnotationAction, AnnotationChange, AnnotationName, Corpus, CorpusAddress,
    CorpusError, NeighbourMode, ReportFinding, RowName, TableMoment, TableTimeUnit, TierRequestName, TierRoundWork,
    TierSelection, ValueSearch,
};
use clap::Subcommand;

use super::tiers_command;
use crate::args::{CommandLine, NamedChoices};
use crate::output::{CommandOutput, with_progress_bar};
use crate::streams;

/// Add, change, move, split, merge, replace and remove annotations and tiers; in bulk from a table
///
/// Each call is one operation that `chereme undo` takes back. A change that would break a rule of the tiers is refused,
/// with a remedy. A time is 1.5, 1.5s, 1500ms, 0:01.500 or a frame such as f90. A tier is tier:12, or its name with
/// --in RECORDING; an annotation is annotation:12, or its id in the file from which it was imported.
///
/// Work on tiers (add-tier, add-tiers, tier, copy-tier, remove-tier, shift) takes several recordings, too: --in 'S07*' by
/// name, --in signer:S07, --where QUERY, or --all. A tier is then a name, where * stands for any letters;
/// recordings without it stay as they are. If a recording refuses, nothing is done, unless --skip leaves it out.
///
/// Actions on annotations: add, set, split, merge, reorder, remove, replace, shift, paste, from. On tiers: add-tier,
/// add-tiers, tier, copy-tier, remove-tier. On other things: recording, signer, sign, cite, prefer.
#[derive(Debug, clap::Args)]
pub(crate) struct AnnotateArgs {
    /// The corpus
    corpus: PathBuf,
    /// The recording of the named tiers and annotations: recording:3 or its name
    #[arg(long = "in", value_name = "RECORDING", global = true)]
    recording: Option<String>,
    /// Move boundaries to the nearest frames of the recording's movement
    #[arg(long, global = true)]
    snap: bool,
    /// The treatment of annotations in the way of one that is added or moved
    #[arg(long, global = true, value_parser = NEIGHBOUR_MODE_CHOICES, default_value = "normal", hide_possible_values = false)]
    mode: NeighbourMode,
    /// Report the ids of all annotations; without it of at most 100 in JSON, and of at most 20 in text
    #[arg(long, global = true)]
    ids: bool,
    #[command(subcommand)]
    action: AnnotateCommand,
}

/// What becomes of annotations in the way.
const NEIGHBOUR_MODE_CHOICES: NamedChoices<NeighbourMode> = NamedChoices(&[
    ("normal", "They stay, and the change is refused", NeighbourMode::Normal),
    (
        "bulldozer",
        "They are pushed along as far as necessary",
        NeighbourMode::Bulldozer,
    ),
    (
        "shift",
        "All later annotations of the tier move along",
        NeighbourMode::Shift,
    ),
]);

#[derive(Debug, Subcommand)]
enum AnnotateCommand {
    /// Add an annotation
    Add {
        /// The tier
        tier: String,
        /// Its value; unset, n/a and unclear are the three kinds of missing values
        value: String,
        /// Its start time
        #[arg(long)]
        start: Option<TableMoment>,
        /// Its end time
        #[arg(long)]
        end: Option<TableMoment>,
        /// Its parent annotation, on a tier whose annotations have no times of their own
        #[arg(long)]
        parent: Option<String>,
        /// Its position among its siblings, counted from 0
        #[arg(long)]
        order: Option<u32>,
    },
    /// Change the value of an annotation, or move it
    Set {
        /// The annotation
        annotation: String,
        /// Its new value
        #[arg(long)]
        value: Option<String>,
        /// Its new start time
        #[arg(long)]
        start: Option<TableMoment>,
        /// Its new end time
        #[arg(long)]
        end: Option<TableMoment>,
    },
    /// Cut an annotation in two
    Split {
        /// The annotation, which becomes the first half
        annotation: String,
        /// The time of the cut
        #[arg(long)]
        at: TableMoment,
    },
    /// Merge two neighbouring annotations into one
    Merge {
        /// The earlier one, which stays
        first: String,
        /// The later one, which is removed
        second: String,
        /// The value of the merged annotation; needed if the two values differ
        #[arg(long)]
        value: Option<String>,
    },
    /// Move an annotation of a symbolic subdivision to another position among its siblings
    Reorder {
        /// The annotation
        annotation: String,
        /// The position, counted from 0
        order: u32,
    },
    /// Remove annotations, with all that depend on them
    Remove {
        /// The annotations
        #[arg(required = true)]
        annotations: Vec<String>,
    },
    /// Replace text in the values of annotations, of all tiers or of some
    Replace {
        /// The text to look for, letter by letter, anywhere in a value
        find: String,
        /// The replacement
        with: String,
        /// Take the text as a regular expression; $1 in the new text is its first group
        #[arg(long)]
        regex: bool,
        /// Only values that equal the whole text
        #[arg(long, conflicts_with = "regex")]
        whole: bool,
        /// Only tiers with this name, where * stands for any letters; or tier:12
        #[arg(long = "tier", value_name = "TIER")]
        tiers: Vec<String>,
        /// Report what would change, and write nothing
        #[arg(long)]
        dry_run: bool,
    },
    /// Shift all annotations of tiers in time, in the recording named by --in or in several
    ///
    /// Dependent tiers are shifted, too. Without --tier all tiers of the recording are shifted.
    Shift {
        /// The amount, such as 0.2s or -200ms; a negative amount shifts towards the start
        #[arg(long, allow_hyphen_values = true, value_parser = parse_signed_time)]
        by: i64,
        /// Only tiers with this name, where * stands for any letters; or tier:12
        #[arg(long = "tier", value_name = "TIER")]
        tiers: Vec<String>,
        #[command(flatten)]
        round: tiers_command::TierRoundArgs,
    },
    /// Carry out the changes in a table, all of them or none
    ///
    /// Columns: recording, tier, start, end, duration, value, action (add, set, remove), id, parent. The title
    /// (start_ms, `end [s]`), the number (1500ms) or --unit gives the unit of times; without any of them times are in
    /// seconds. The tab-delimited text that ELAN exports is such a table, with and without titles.
    From {
        /// The table (.csv, .tsv or .txt); - is standard input
        file: PathBuf,
        /// The unit of bare numbers: s, ms or frames
        #[arg(long)]
        unit: Option<TableTimeUnit>,
        /// Add the tiers that the table needs and its recordings lack; their names say what they are about
        #[arg(long)]
        add_tiers: bool,
    },
    /// Paste annotations that the window or a spreadsheet copied, into the recording named by --in
    ///
    /// Each line of the text has a tier, a start, an end and a value, with tabs between them; titles may give another
    /// order. Annotations keep their times and tiers, unless --at and --tier give others.
    Paste {
        /// The text; - is standard input
        file: PathBuf,
        /// The tier of annotations without a tier name; with --at, of all if they name one tier only
        #[arg(long)]
        tier: Option<String>,
        /// The start of the first annotation; the others keep their distances from it
        #[arg(long)]
        at: Option<TableMoment>,
        /// Paste the annotations that have a place even if others have none
        #[arg(long)]
        partly: bool,
    },
    #[command(flatten)]
    Other(tiers_command::TierCommand),
}

pub(super) fn run(cli: &CommandLine, args: &AnnotateArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let recording_name = args.recording.as_deref().map(parse_annotated_recording).transpose()?;
    let recording = recording_name.as_ref();
    let options = AnnotateOptions {
        snap: args.snap,
        mode: args.mode,
        ..AnnotateOptions::default()
    };
    let actions = match &args.action {
        AnnotateCommand::From { file, unit, add_tiers } => {
            let (unit, add_tiers) = (*unit, *add_tiers);
            let options = AnnotateOptions {
                unit,
                add_tiers,
                ..options
            };
            let (report, findings) = annotate_from_table(&mut corpus, file, recording, &options)?;
            for finding in &findings {
                let line = finding.line.map(|line| format!("line {line}: ")).unwrap_or_default();
                let message = output.translate_message(&finding.message);
                output.write_output_line(format!("{}: {line}{message}", finding.severity))?;
            }
            for row in &report.added_tiers {
                let name = format!("recording:{} {:?}", row.recording, row.name);
                output.filled_line("added to {recording}: {tiers}", &[&name, &row.tiers.join(", ")])?;
            }
            return print_annotate_report(report, args.ids, output);
        }
        AnnotateCommand::Replace { .. } => {
            return replace_annotation_texts(&mut corpus, &args.action, recording, output);
        }
        AnnotateCommand::Shift { .. } => {
            return shift_annotations(&mut corpus, args, recording, output);
        }
        AnnotateCommand::Paste { .. } => {
            return paste_annotation_table(&mut corpus, args, recording, output);
        }
        AnnotateCommand::Other(action) => {
            return tiers_command::run(&mut corpus, action, recording, output);
        }
        action => to_annotation_actions(action, recording)?,
    };
    let changes: Vec<AnnotationChange> = actions.into_iter().map(AnnotationChange::from).collect();
    let report = with_progress_bar(|progress| corpus.annotate_corpus(&changes, &options, progress))?;
    print_annotate_report(report, args.ids, output)
}

fn to_annotation_actions(action: &AnnotateCommand, recording: Option<&RowName>) -> Result<Vec<AnnotationAction>> {
    let named = |text: &String| AnnotationName::parse_annotation_name(text, recording);
    Ok(match action {
        AnnotateCommand::Add {
            tier,
            value,
            start,
            end,
            parent,
            order,
        } => vec![AnnotationAction::Add {
            tier: TierRequestName::parse_tier_name(tier, recording)?,
            start: *start,
            end: *end,
            parent: parent.as_ref().map(named),
            order: *order,
            value: value.clone(),
            confidence: None,
        }],
        AnnotateCommand::Set {
            annotation,
            value,
            start,
            end,
        } => vec![AnnotationAction::Set {
            annotation: named(annotation),
            start: *start,
            end: *end,
            value: value.clone(),
        }],
        AnnotateCommand::Split { annotation, at } => {
            vec![AnnotationAction::Split {
                annotation: named(annotation),
                at: *at,
            }]
        }
        AnnotateCommand::Merge { first, second, value } => vec![AnnotationAction::Merge {
            first: named(first),
            second: named(second),
            value: value.clone(),
            join: false,
        }],
        AnnotateCommand::Reorder { annotation, order } => {
            vec![AnnotationAction::Reorder {
                annotation: named(annotation),
                order: *order,
            }]
        }
        AnnotateCommand::Remove { annotations } => annotations
            .iter()
            .map(|text| AnnotationAction::Remove {
                annotation: named(text),
            })
            .collect(),
        AnnotateCommand::From { .. }
        | AnnotateCommand::Replace { .. }
        | AnnotateCommand::Shift { .. }
        | AnnotateCommand::Paste { .. }
        | AnnotateCommand::Other(_) => Vec::new(),
    })
}

fn annotate_from_table(
    corpus: &mut Corpus,
    file: &Path,
    recording: Option<&RowName>,
    options: &AnnotateOptions,
) -> Result<(AnnotateReport, Vec<ReportFinding>)> {
    let bytes = streams::read_file_or_stdin(file)?;
    let name = file.display().to_string();
    Ok(with_progress_bar(|progress| {
        corpus.annotate_table(&bytes, &name, recording, options, progress)
    })?)
}

fn paste_annotation_table(
    corpus: &mut Corpus,
    args: &AnnotateArgs,
    recording: Option<&RowName>,
    output: &mut CommandOutput,
) -> Result<()> {
    let AnnotateCommand::Paste { file, tier, at, partly } = &args.action else {
        return Ok(());
    };
    let recording = recording.ok_or_else(which_recording)?;
    let tier = tier
        .as_ref()
        .map(|text| TierRequestName::parse_tier_name(text, Some(recording)));
    let options = PasteOptions {
        tier: tier.transpose()?,
        at: *at,
        partly: *partly,
    };
    let name = file.display().to_string();
    let text = String::from_utf8(streams::read_file_or_stdin(file)?).map_err(|_| {
        CorpusError::from_wrong_message("the text is not UTF-8")
            .with_error_place(&name)
            .with_advice("save it as UTF-8")
    })?;
    let (report, odd) =
        with_progress_bar(|progress| corpus.paste_annotations(recording, &text, &name, &options, progress))?;
    for line in &odd {
        let fault_text = output.translate_message(&line.odd_line_fault());
        let place = fill_text_braces(output.output_text(trouble_words::LINE), &[("n", &line.line)]);
        output.line_as_is(&format!("{place}{fault_text}"))?;
    }
    print_annotate_report(report, args.ids, output)
}

/// Returns the error for an action that needs a recording.
pub(super) fn which_recording() -> CorpusError {
    CorpusError::from_wrong_message("which recording?").with_advice("name it with --in")
}

/// Parses `recording:3` or a recording's name.
pub(super) fn parse_annotated_recording(text: &str) -> Result<RowName> {
    match text.parse()? {
        CorpusAddress::Recording(name) => Ok(name),
        _ => Ok(RowName::Text(text.trim().to_owned())),
    }
}

/// The numbers of ids in the text output and in JSON, unless `--ids` asks for all.
const MAX_PRINTED_IDS: usize = 20;
const MAX_JSON_IDS: usize = 100;

fn print_annotate_report(mut report: AnnotateReport, all: bool, output: &mut CommandOutput) -> Result<()> {
    let total = report.annotations.len();
    // Many ids would hide the sentence.
    let few = all || total <= MAX_PRINTED_IDS;
    let ids: Vec<String> = report
        .annotations
        .iter()
        .filter(|_| few)
        .map(|id| format!("annotation:{id}"))
        .collect();
    let summary = match report.added + report.changed + report.removed {
        // A change that changes nothing is still an answer.
        0 => output.translate_message("nothing changed"),
        _ => annotation_sentence(&report.effect, output.output_language()),
    };
    output.line_as_is(&format!(
        "{}{}{}",
        summary,
        if ids.is_empty() { "" } else { ": " },
        ids.join(", ")
    ))?;
    if !all {
        report.annotations.truncate(MAX_JSON_IDS);
    }
    let mut document = serde_json::to_value(report)?;
    // The number of all ids is known even if the list is cut.
    document["annotations_total"] = total.into();
    output.set_json_document(document)
}

/// Parses a time with a sign, such as -200ms; returns microseconds.
fn parse_signed_time(text: &str) -> Result<i64, String> {
    let (sign, rest) = match text.strip_prefix('-') {
        Some(rest) => (-1, rest),
        None => (1, text.strip_prefix('+').unwrap_or(text)),
    };
    match rest.parse::<TableMoment>() {
        Ok(TableMoment::Time(time)) => Ok(sign * time.instant_micros()),
        _ => Err("write a time such as 0.2s or -200ms".to_owned()),
    }
}

fn replace_annotation_texts(
    corpus: &mut Corpus,
    action: &AnnotateCommand,
    recording: Option<&RowName>,
    output: &mut CommandOutput,
) -> Result<()> {
    let AnnotateCommand::Replace {
        find,
        with,
        regex,
        whole,
        tiers,
        dry_run,
    } = action
    else {
        return Ok(());
    };
    // Clap refuses both together, so that their order does not matter.
    let find = match (regex, whole) {
        (true, _) => ValueSearch::from_value_pattern(find)?,
        (_, true) => ValueSearch::Whole(find.clone()),
        _ => ValueSearch::Text(find.clone()),
    };
    let within = TierSelection {
        recording: recording.cloned(),
        tiers: tiers.clone(),
    };
    let done = with_progress_bar(|progress| corpus.replace_values(&find, with, &within, *dry_run, progress))?;
    for value in done.values.iter().take(MAX_PRINTED_IDS) {
        let start_seconds = value.start_us as f64 / 1e6;
        output.filled_line(
            "  {tier} of {recording} at {time} s: {from} -> {to}",
            &[
                &value.tier,
                &value.recording,
                &format_args!("{:.3}", start_seconds),
                &format_args!("{:?}", value.from),
                &format_args!("{:?}", value.to),
            ],
        )?;
    }
    let more = done.values.len().saturating_sub(MAX_PRINTED_IDS);
    if more > 0 {
        output.filled_line("  and {n} more", &[&more])?;
    }
    // Of a dry run the same list is a promise, and must not sound like a deed.
    let word = if *dry_run { "would change" } else { "changed" };
    let count = output.format_counted_noun(done.changed, "annotations");
    output.write_output_line(format!("{word}: {count}"))?;
    output.set_json_document(done)
}

fn shift_annotations(
    corpus: &mut Corpus,
    args: &AnnotateArgs,
    recording: Option<&RowName>,
    output: &mut CommandOutput,
) -> Result<()> {
    let AnnotateCommand::Shift { by, tiers, round } = &args.action else {
        return Ok(());
    };
    if let Some(scope) = round.named_scope(recording)? {
        let (tiers, by_us) = (tiers.clone(), *by);
        let work = TierRoundWork::Shift { tiers, by_us };
        return tiers_command::run_tier_round(corpus, &scope, &work, round, output);
    }
    let dry_run = round.dry_run;
    // A tier by its number belongs to one recording, which needs no name.
    let of_all = tiers.iter().all(|tier| !tier.starts_with("tier:"));
    if recording.is_none() && of_all {
        return Err(which_recording().into());
    }
    let within = TierSelection {
        recording: recording.cloned(),
        tiers: tiers.clone(),
    };
    let report = with_progress_bar(|progress| corpus.shift_tiers(&within, *by, dry_run, progress))?;
    if dry_run {
        output.write_output_line("nothing is written; it would be:")?;
    }
    print_annotate_report(report, args.ids, output)
}
