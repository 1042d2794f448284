//! `chereme annotate`.

use std::path::{Path, PathBuf};

use anyhow::Result;
use chereme_corpus::words::history as words;
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
/// Each call is one operation that `chereme undo` takes back. The rules of the tiers hold: a change that
/// would break one is refused, with a remedy. Times are 1.5, 1.5s, 1500ms, 0:01.500 or a frame,
/// f90. A tier is tier:12, or its name with --in RECORDING; an annotation is annotation:12, or its id
/// in the file it came from.
///
/// Actions on annotations: add, set, split, merge, reorder, remove, replace, shift, from. On tiers: add-tier,
/// add-tiers, tier, copy-tier, remove-tier. On other things: recording, signer, sign, cite.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// The recording meant by names of tiers and ids of annotations: recording:3 or its name
    #[arg(long = "in", value_name = "RECORDING", global = true)]
    recording: Option<String>,
    /// Move boundaries to the nearest frames of the recording's movement
    #[arg(long, global = true)]
    snap: bool,
    /// How annotations give way to one that is added or moved
    #[arg(long, global = true, value_enum, default_value_t = ModeWord::Normal, hide_possible_values = false)]
    mode: ModeWord,
    /// Report the ids of all annotations; else of at most 100 in JSON, and of at most 20 in words
    #[arg(long, global = true)]
    ids: bool,
    #[command(subcommand)]
    action: Action,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum ModeWord {
    /// They stay, and the change is refused
    Normal,
    /// They are pushed on as far as they are in the way
    Bulldozer,
    /// All that comes after moves along
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
        /// What it says; unset, n/a and unclear are the three kinds of missing values
        value: String,
        /// Where it starts
        #[arg(long)]
        start: Option<Moment>,
        /// Where it ends
        #[arg(long)]
        end: Option<Moment>,
        /// The annotation above it, on a tier whose annotations have no times of their own
        #[arg(long)]
        parent: Option<String>,
        /// Its place among its siblings, from 0
        #[arg(long)]
        order: Option<u32>,
    },
    /// Change what an annotation says, or move it
    Set {
        /// The annotation
        annotation: String,
        /// Its new value
        #[arg(long)]
        value: Option<String>,
        /// Where it starts from now on
        #[arg(long)]
        start: Option<Moment>,
        /// Where it ends from now on
        #[arg(long)]
        end: Option<Moment>,
    },
    /// Cut an annotation in two
    Split {
        /// The annotation, which becomes the first half
        annotation: String,
        /// Where to cut
        #[arg(long)]
        at: Moment,
    },
    /// Make one annotation of two neighbours
    Merge {
        /// The earlier one, which stays
        first: String,
        /// The later one, which goes
        second: String,
        /// What the one says; needed where the two differ
        #[arg(long)]
        value: Option<String>,
    },
    /// Give an annotation of a list another place among its siblings
    Reorder {
        /// The annotation
        annotation: String,
        /// The place, from 0
        order: u32,
    },
    /// Remove annotations with all below them
    Remove {
        /// The annotations
        #[arg(required = true)]
        annotations: Vec<String>,
    },
    /// Replace text in the values of annotations, of all tiers or of some
    Replace {
        /// The text to look for, letter by letter, anywhere in a value
        find: String,
        /// The text to put there
        with: String,
        /// Take the text as a regular expression; $1 in the new text is its first group
        #[arg(long)]
        regex: bool,
        /// Only values that are the text and nothing else
        #[arg(long, conflicts_with = "regex")]
        whole: bool,
        /// Only tiers of this name, * for any letters; or tier:12
        #[arg(long = "tier", value_name = "TIER")]
        tiers: Vec<String>,
        /// Report what would change, and write nothing
        #[arg(long)]
        dry_run: bool,
    },
    /// Move all annotations of tiers, of the recording named by --in, in time
    ///
    /// Tiers below go along. Without --tier all tiers of the recording move.
    Shift {
        /// By how much: 0.2s, -200ms; minus is earlier
        #[arg(long, allow_hyphen_values = true, value_parser = signed)]
        by: i64,
        /// Only tiers of this name, * for any letters; or tier:12
        #[arg(long = "tier", value_name = "TIER")]
        tiers: Vec<String>,
        /// Report how many would move, and write nothing
        #[arg(long)]
        dry_run: bool,
    },
    /// Make the changes of a table, all of them or none
    ///
    /// Columns: recording, tier, start, end, duration, value, action (add, set, remove), id, parent. The unit of
    /// times stands in the title (start_ms, `end [s]`), with the number (1500ms), or in --unit; else they are
    /// seconds. The tab-delimited text that ELAN exports is such a table, with and without titles.
    From {
        /// The table (.csv, .tsv or .txt); - is standard input
        file: PathBuf,
        /// The unit of bare numbers: s, ms or frames
        #[arg(long)]
        unit: Option<TimeUnit>,
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
                output.line(format!("{}: {line}{}", finding.severity, finding.message))?;
            }
            return tell(report, args.ids, output);
        }
        Action::Replace { .. } => return replace(&mut corpus, &args.action, recording, output),
        Action::Shift { .. } => return shift(&mut corpus, args, recording, output),
        Action::Other(action) => return tiers::run(&mut corpus, action, recording, output),
        action => changes(action, recording)?,
    };
    let changes: Vec<AnnotationChange> = actions.into_iter().map(AnnotationChange::from).collect();
    let mut bar = Bar::new();
    let mut hear = |step: chereme_corpus::Step<'_>| bar.show(step);
    let report = corpus.annotate(&changes, &options, &mut Progress::new(&mut hear))?;
    drop(bar);
    tell(report, args.ids, output)
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
        Action::From { .. } | Action::Replace { .. } | Action::Shift { .. } | Action::Other(_) => {
            Vec::new()
        }
    })
}

fn table(
    corpus: &mut Corpus,
    file: &Path,
    recording: Option<&Name>,
    options: &AnnotateOptions,
) -> Result<(AnnotateReport, Vec<ReportFinding>)> {
    let bytes = if streams::is_standard(file) {
        streams::read()?
    } else {
        std::fs::read(file).map_err(|error| Error::file(file, error))?
    };
    let name = file.display().to_string();
    let mut bar = Bar::new();
    let mut hear = |step: chereme_corpus::Step<'_>| bar.show(step);
    let progress = &mut Progress::new(&mut hear);
    Ok(corpus.annotate_table(&bytes, &name, recording, options, progress)?)
}

/// Reads `recording:3`, or else a recording's name.
pub(super) fn name(text: &str) -> Result<Name> {
    match text.parse()? {
        Address::Recording(name) => Ok(name),
        _ => Ok(Name::Text(text.trim().to_owned())),
    }
}

/// How many ids are named in words, and in JSON, if nobody asks for all.
const NAMED: usize = 20;
const LISTED: usize = 100;

fn tell(mut report: AnnotateReport, all: bool, output: &mut Output) -> Result<()> {
    let total = report.annotations.len();
    let few = all || total <= NAMED;
    let ids: Vec<String> = report
        .annotations
        .iter()
        .filter(|_| few)
        .map(|id| format!("annotation:{id}"))
        .collect();
    let summary = match report.added + report.changed + report.removed {
        0 => "nothing changed".to_owned(),
        _ => words::annotated(&report.summary, output.language())
            .unwrap_or_else(|| report.summary.clone()),
    };
    output.line(format!(
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

/// Reads a time with a sign, such as -200ms, in microseconds.
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
        output.line(format!(
            "  {} of {} at {at:.3} s: {:?} -> {:?}",
            value.tier, value.recording, value.from, value.to
        ))?;
    }
    let more = done.values.len().saturating_sub(NAMED);
    if more > 0 {
        output.line(format!("  and {more} more"))?;
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
        return Err(Error::wrong("which recording?")
            .advise("name it with --in")
            .into());
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
    tell(report, args.ids, output)
}
