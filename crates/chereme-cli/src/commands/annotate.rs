//! `chereme annotate`: adds, changes and removes annotations, one by one or from a table.

use std::path::{Path, PathBuf};

use anyhow::Result;
use chereme_corpus::paste::PasteOptions;
use chereme_corpus::words::history::annotation_sentence;
use chereme_corpus::words::{fill, trouble};
use chereme_corpus::{
    Address, AnnotateOptions, AnnotateReport, AnnotationAction, AnnotationChange, AnnotationName,
    Corpus, Error, Find, Mode, Moment, Name, Progress, ReportFinding, TierName, TimeUnit, Within,
};
use clap::{Subcommand, ValueEnum};

use super::tiers;
use crate::args::Cli;
use crate::output::{Bar, Output};
use crate::streams;

/// Add, change, move, split, merge, replace and remove annotations and tiers; in bulk from a table
///
/// Each call is one operation that `chereme undo` takes back. A change that would break a rule of the tiers is refused,
/// with a remedy. A time is 1.5, 1.5s, 1500ms, 0:01.500 or a frame such as f90. A tier is tier:12, or its name with
/// --in RECORDING; an annotation is annotation:12, or its id in the file from which it was imported.
///
/// Actions on annotations: add, set, split, merge, reorder, remove, replace, shift, paste, from. On tiers: add-tier,
/// add-tiers, tier, copy-tier, remove-tier. On other things: recording, signer, sign, cite.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// The recording of the named tiers and annotations: recording:3 or its name
    #[arg(long = "in", value_name = "RECORDING", global = true)]
    recording: Option<String>,
    /// Move boundaries to the nearest frames of the recording's movement
    #[arg(long, global = true)]
    snap: bool,
    /// The treatment of annotations in the way of one that is added or moved
    #[arg(long, global = true, value_enum, default_value_t = ModeWord::Normal, hide_possible_values = false)]
    mode: ModeWord,
    /// Report the ids of all annotations; without it of at most 100 in JSON, and of at most 20 in text
    #[arg(long, global = true)]
    ids: bool,
    #[command(subcommand)]
    action: Action,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum ModeWord {
    /// They stay, and the change is refused
    Normal,
    /// They are pushed along as far as necessary
    Bulldozer,
    /// All later annotations of the tier move along
    Shift,
}

impl ModeWord {
    fn mode(self) -> Mode {
        match self {
            Self::Normal => Mode::Normal,
            Self::Bulldozer => Mode::Bulldozer,
            Self::Shift => Mode::Shift,
        }
    }
}

#[derive(Debug, Subcommand)]
enum Action {
    /// Add an annotation
    Add {
        /// The tier
        tier: String,
        /// Its value; unset, n/a and unclear are the three kinds of missing values
        value: String,
        /// Its start time
        #[arg(long)]
        start: Option<Moment>,
        /// Its end time
        #[arg(long)]
        end: Option<Moment>,
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
        start: Option<Moment>,
        /// Its new end time
        #[arg(long)]
        end: Option<Moment>,
    },
    /// Cut an annotation in two
    Split {
        /// The annotation, which becomes the first half
        annotation: String,
        /// The time of the cut
        #[arg(long)]
        at: Moment,
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
    /// Shift all annotations of tiers in time, in the recording named by --in
    ///
    /// Dependent tiers are shifted, too. Without --tier all tiers of the recording are shifted.
    Shift {
        /// The amount, such as 0.2s or -200ms; a negative amount shifts towards the start
        #[arg(long, allow_hyphen_values = true, value_parser = signed)]
        by: i64,
        /// Only tiers with this name, where * stands for any letters; or tier:12
        #[arg(long = "tier", value_name = "TIER")]
        tiers: Vec<String>,
        /// Report how many annotations would move, and write nothing
        #[arg(long)]
        dry_run: bool,
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
        unit: Option<TimeUnit>,
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
        at: Option<Moment>,
        /// Paste the annotations that have a place even if others have none
        #[arg(long)]
        partly: bool,
    },
    #[command(flatten)]
    Other(tiers::Action),
}

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let mut corpus = cli.open(&args.corpus)?;
    let recording = args.recording.as_deref().map(name).transpose()?;
    let recording = recording.as_ref();
    let options = AnnotateOptions {
        snap: args.snap,
        mode: args.mode.mode(),
        ..AnnotateOptions::default()
    };
    let actions = match &args.action {
        Action::From { file, unit } => {
            let options = AnnotateOptions {
                unit: *unit,
                ..options
            };
            let (report, findings) = table(&mut corpus, file, recording, &options)?;
            for finding in &findings {
                let line = finding
                    .line
                    .map(|line| format!("line {line}: "))
                    .unwrap_or_default();
                let said = output.spoken(&finding.message);
                output.line(format!("{}: {line}{said}", finding.severity))?;
            }
            return print(report, args.ids, output);
        }
        Action::Replace { .. } => return replace(&mut corpus, &args.action, recording, output),
        Action::Shift { .. } => return shift(&mut corpus, args, recording, output),
        Action::Paste { .. } => return paste(&mut corpus, args, recording, output),
        Action::Other(action) => return tiers::run(&mut corpus, action, recording, output),
        action => changes(action, recording)?,
    };
    let changes: Vec<AnnotationChange> = actions.into_iter().map(AnnotationChange::from).collect();
    let mut bar = Bar::new();
    let mut hear = |step: chereme_corpus::Step<'_>| bar.show(step);
    let report = corpus.annotate(&changes, &options, &mut Progress::new(&mut hear))?;
    drop(bar);
    print(report, args.ids, output)
}

fn changes(action: &Action, recording: Option<&Name>) -> Result<Vec<AnnotationAction>> {
    let named = |text: &String| AnnotationName::read(text, recording);
    Ok(match action {
        Action::Add {
            tier,
            value,
            start,
            end,
            parent,
            order,
        } => vec![AnnotationAction::Add {
            tier: TierName::read(tier, recording)?,
            start: *start,
            end: *end,
            parent: parent.as_ref().map(named),
            order: *order,
            value: value.clone(),
            confidence: None,
        }],
        Action::Set {
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
        Action::Split { annotation, at } => {
            vec![AnnotationAction::Split {
                annotation: named(annotation),
                at: *at,
            }]
        }
        Action::Merge {
            first,
            second,
            value,
        } => vec![AnnotationAction::Merge {
            first: named(first),
            second: named(second),
            value: value.clone(),
            join: false,
        }],
        Action::Reorder { annotation, order } => {
            vec![AnnotationAction::Reorder {
                annotation: named(annotation),
                order: *order,
            }]
        }
        Action::Remove { annotations } => annotations
            .iter()
            .map(|text| AnnotationAction::Remove {
                annotation: named(text),
            })
            .collect(),
        Action::From { .. }
        | Action::Replace { .. }
        | Action::Shift { .. }
        | Action::Paste { .. }
        | Action::Other(_) => Vec::new(),
    })
}

fn table(
    corpus: &mut Corpus,
    file: &Path,
    recording: Option<&Name>,
    options: &AnnotateOptions,
) -> Result<(AnnotateReport, Vec<ReportFinding>)> {
    let bytes = bytes_of(file)?;
    let name = file.display().to_string();
    let mut bar = Bar::new();
    let mut hear = |step: chereme_corpus::Step<'_>| bar.show(step);
    let progress = &mut Progress::new(&mut hear);
    Ok(corpus.annotate_table(&bytes, &name, recording, options, progress)?)
}

/// Returns the bytes of a file or of standard input.
fn bytes_of(file: &Path) -> Result<Vec<u8>> {
    if streams::is_standard(file) {
        return streams::read();
    }
    Ok(std::fs::read(file).map_err(|error| Error::file(file, error))?)
}

fn paste(
    corpus: &mut Corpus,
    args: &Args,
    recording: Option<&Name>,
    output: &mut Output,
) -> Result<()> {
    let Action::Paste {
        file,
        tier,
        at,
        partly,
    } = &args.action
    else {
        return Ok(());
    };
    let recording = recording.ok_or_else(which_recording)?;
    let tier = tier.as_ref().map(|it| TierName::read(it, Some(recording)));
    let options = PasteOptions {
        tier: tier.transpose()?,
        at: *at,
        partly: *partly,
    };
    let name = file.display().to_string();
    let text = String::from_utf8(bytes_of(file)?).map_err(|_| {
        Error::wrong("the text is not UTF-8")
            .at(&name)
            .advise("save it as UTF-8")
    })?;
    let mut bar = Bar::new();
    let mut hear = |step: chereme_corpus::Step<'_>| bar.show(step);
    let progress = &mut Progress::new(&mut hear);
    let text = (text.as_str(), name.as_str());
    let (report, odd) = corpus.paste_annotations(recording, text, &options, progress)?;
    drop(bar);
    for line in &odd {
        let said = output.spoken(&line.fault());
        let place = fill(output.say(trouble::LINE), &[("n", &line.line)]);
        output.line_as_is(&format!("{place}{said}"))?;
    }
    print(report, args.ids, output)
}

/// Returns the error for an action that needs a recording.
fn which_recording() -> Error {
    Error::wrong("which recording?").advise("name it with --in")
}

/// Parses `recording:3` or a recording's name.
pub(super) fn name(text: &str) -> Result<Name> {
    match text.parse()? {
        Address::Recording(name) => Ok(name),
        _ => Ok(Name::Text(text.trim().to_owned())),
    }
}

/// The numbers of ids in the text output and in JSON, unless `--ids` asks for all.
const NAMED: usize = 20;
const LISTED: usize = 100;

fn print(mut report: AnnotateReport, all: bool, output: &mut Output) -> Result<()> {
    let total = report.annotations.len();
    let few = all || total <= NAMED;
    let ids: Vec<String> = report
        .annotations
        .iter()
        .filter(|_| few)
        .map(|id| format!("annotation:{id}"))
        .collect();
    let summary = match report.added + report.changed + report.removed {
        0 => output.spoken("nothing changed"),
        _ => annotation_sentence(&report.effect, output.language()),
    };
    output.line_as_is(&format!(
        "{}{}{}",
        summary,
        if ids.is_empty() { "" } else { ": " },
        ids.join(", ")
    ))?;
    if !all {
        report.annotations.truncate(LISTED);
    }
    let mut document = serde_json::to_value(report)?;
    document["annotations_total"] = total.into();
    output.document(document)
}

/// Parses a time with a sign, such as -200ms; returns microseconds.
fn signed(text: &str) -> Result<i64, String> {
    let (sign, rest) = match text.strip_prefix('-') {
        Some(rest) => (-1, rest),
        None => (1, text.strip_prefix('+').unwrap_or(text)),
    };
    match rest.parse::<Moment>() {
        Ok(Moment::Time(time)) => Ok(sign * time.micros()),
        _ => Err("write a time such as 0.2s or -200ms".to_owned()),
    }
}

fn replace(
    corpus: &mut Corpus,
    action: &Action,
    recording: Option<&Name>,
    output: &mut Output,
) -> Result<()> {
    let Action::Replace {
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
    let find = match (regex, whole) {
        (true, _) => Find::pattern(find)?,
        (_, true) => Find::Whole(find.clone()),
        _ => Find::Text(find.clone()),
    };
    let within = Within {
        recording: recording.cloned(),
        tiers: tiers.clone(),
    };
    let mut bar = Bar::new();
    let mut hear = |step: chereme_corpus::Step<'_>| bar.show(step);
    let progress = &mut Progress::new(&mut hear);
    let done = corpus.replace_values(&find, with, &within, *dry_run, progress)?;
    drop(bar);
    for value in done.values.iter().take(NAMED) {
        let at = value.start_us as f64 / 1e6;
        output.filled_line(
            "  {tier} of {recording} at {time} s: {from} -> {to}",
            &[
                &value.tier,
                &value.recording,
                &format_args!("{:.3}", at),
                &format_args!("{:?}", value.from),
                &format_args!("{:?}", value.to),
            ],
        )?;
    }
    let more = done.values.len().saturating_sub(NAMED);
    if more > 0 {
        output.filled_line("  and {n} more", &[&more])?;
    }
    let word = if *dry_run { "would change" } else { "changed" };
    let count = output.counted(done.changed, "annotations");
    output.line(format!("{word}: {count}"))?;
    output.document(done)
}

fn shift(
    corpus: &mut Corpus,
    args: &Args,
    recording: Option<&Name>,
    output: &mut Output,
) -> Result<()> {
    let Action::Shift { by, tiers, dry_run } = &args.action else {
        return Ok(());
    };
    let of_all = tiers.iter().all(|tier| !tier.starts_with("tier:"));
    if recording.is_none() && of_all {
        return Err(which_recording().into());
    }
    let within = Within {
        recording: recording.cloned(),
        tiers: tiers.clone(),
    };
    let mut bar = Bar::new();
    let mut hear = |step: chereme_corpus::Step<'_>| bar.show(step);
    let report = corpus.shift_tiers(&within, *by, *dry_run, &mut Progress::new(&mut hear))?;
    drop(bar);
    if *dry_run {
        output.line("nothing is written; it would be:")?;
    }
    print(report, args.ids, output)
}
