//! `chereme annotate`.

use std::path::{Path, PathBuf};

use anyhow::Result;
use chereme_corpus::{
    Address, AnnotateOptions, AnnotateReport, AnnotationAction, AnnotationChange, AnnotationName,
    Corpus, Error, Moment, Name, Progress, ReportFinding, TierName,
};
use clap::Subcommand;

use super::tiers;
use crate::args::Cli;
use crate::output::{Bar, Output};

/// Add, change, move, split, merge and remove annotations and tiers; in bulk from a table
///
/// Each call is one operation that `chereme undo` takes back. The rules of the tiers hold: what would
/// break one is refused, with what would be right. Times are 1.5, 1.5s, 1500ms, 0:01.500 or a frame,
/// f90. A tier is tier:12, or its name with --in RECORDING; an annotation is annotation:12, or its id
/// in the file it came from.
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
    #[command(subcommand)]
    action: Action,
}

#[derive(Debug, Subcommand)]
enum Action {
    /// Add an annotation
    Add {
        /// The tier
        tier: String,
        /// What it says; unset, n/a and unclear are three ways of saying nothing
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
        /// What it says from now on
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
    /// Do what a table says, all of it or nothing
    ///
    /// Columns: recording, tier, start, end, value, action (add, set, remove), id, parent.
    From {
        /// The table (.csv or .tsv)
        file: PathBuf,
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
        ..AnnotateOptions::default()
    };
    let actions = match &args.action {
        Action::From { file } => {
            let (report, findings) = table(&mut corpus, file, recording, &options)?;
            for finding in &findings {
                let line = finding
                    .line
                    .map(|line| format!("line {line}: "))
                    .unwrap_or_default();
                output.line(format!("{}: {line}{}", finding.severity, finding.message))?;
            }
            return tell(&report, output);
        }
        Action::Other(action) => return tiers::run(&mut corpus, action, recording, output),
        action => changes(action, recording)?,
    };
    let changes: Vec<AnnotationChange> = actions.into_iter().map(AnnotationChange::from).collect();
    let mut bar = Bar::new();
    let mut hear = |step: chereme_corpus::Step<'_>| bar.show(step);
    let report = corpus.annotate(&changes, &options, &mut Progress::new(&mut hear))?;
    drop(bar);
    tell(&report, output)
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
        Action::From { .. } | Action::Other(_) => Vec::new(),
    })
}

fn table(
    corpus: &mut Corpus,
    file: &Path,
    recording: Option<&Name>,
    options: &AnnotateOptions,
) -> Result<(AnnotateReport, Vec<ReportFinding>)> {
    let bytes = std::fs::read(file).map_err(|error| Error::file(file, error))?;
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

fn tell(report: &AnnotateReport, output: &mut Output) -> Result<()> {
    let ids: Vec<String> = report
        .annotations
        .iter()
        .map(|id| format!("annotation:{id}"))
        .collect();
    output.line(format!(
        "{} added, {} changed, {} removed{}{}",
        report.added,
        report.changed,
        report.removed,
        if ids.is_empty() { "" } else { ": " },
        ids.join(", ")
    ))?;
    output.document(report)
}
