//! `chereme merge` and `chereme conflicts`: merges diverged copies, and decides their conflicts.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Result;
use chereme_corpus::words::merge_words as words;
use chereme_corpus::{
    ConflictDecision, CorpusConflict, CorpusError, ImportOptions, MergeReport, OwnEdits, merge_files,
};
use serde_json::json;

use super::diff;
use crate::args::{CommandLine, NamedChoices};
use crate::output::{CommandOutput, with_progress_bar};
use crate::streams;

/// Merge a copy that somebody else changed into your corpus or annotation file
///
/// A change that only one side made is taken over, field by field. Different changes of one field are a conflict: your
/// value stays, and the other one is kept as a candidate until you decide with `chereme conflicts`. OTHER is a copy of
/// the corpus, or an annotation file that was exported from it and changed. If both are annotation files, --to names
/// the merged file, which has the layout of yours; the other side's candidates are then on tiers `NAME (theirs)`. For
/// corpora the common earlier state is found in their history; --base names it for files, and for corpora without a
/// common history. A merge into a corpus is one operation: `chereme undo` takes it back.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme merge mine.chereme hers.chereme
  chereme conflicts mine.chereme
  chereme conflicts mine.chereme 1 3 --take theirs
  chereme merge mine.chereme changed.eaf
  chereme merge mine.eaf hers.eaf --base before.eaf --to merged.eaf")]
pub(crate) struct MergeArgs {
    /// Your corpus, or your annotation file
    mine: PathBuf,
    /// The other corpus or annotation file
    other: PathBuf,
    /// The corpus or file that both were copies of
    #[arg(long, value_name = "FILE")]
    base: Option<PathBuf>,
    /// The merged annotation file; - is standard output
    #[arg(long, value_name = "FILE")]
    to: Option<PathBuf>,
    /// Replace a file that exists already
    #[arg(long)]
    force: bool,
}

/// List the conflicts of merges, or decide some of them
///
/// Each conflict has your candidate, which is in the corpus, and the other side's. `--take mine` leaves yours, `--take
/// theirs` replaces it with the other one, and `--take both` keeps the two: the second annotation goes on the same tier
/// if there is room, otherwise on a tier `NAME (theirs)`. A decision is an operation: `chereme undo` takes it back.
#[derive(Debug, clap::Args)]
pub(crate) struct ConflictsArgs {
    /// The corpus
    corpus: PathBuf,
    /// The conflicts to decide, by their numbers, or all
    numbers: Vec<String>,
    /// The candidate to take
    #[arg(long, value_parser = DECISION_CHOICES)]
    take: Option<ConflictDecision>,
    /// List decided conflicts, too
    #[arg(long)]
    decided: bool,
}

/// The candidates that a decision takes.
const DECISION_CHOICES: NamedChoices<ConflictDecision> = NamedChoices(&[
    ("mine", "Your candidate stays", ConflictDecision::Mine),
    (
        "theirs",
        "The other candidate takes its place",
        ConflictDecision::Theirs,
    ),
    ("both", "Both stay", ConflictDecision::Both),
]);

pub(super) fn merge_corpora(cli: &CommandLine, args: &MergeArgs, output: &mut CommandOutput) -> Result<()> {
    if is_corpus(&args.mine) && streams::is_standard(&args.other) {
        return Err(CorpusError::from_wrong_message(
            "standard input has no name by which the corpus could find the earlier version of the file",
        )
        .with_error_place("-")
        .with_advice("write `chereme import CORPUS - --format eaf --name NAME --merge`")
        .into());
    }
    match (is_corpus(&args.mine), is_corpus(&args.other)) {
        (true, true) => corpora(cli, args, output),
        (true, false) => file_into_corpus(cli, args, output),
        (false, false) => merge_annotation_files(args, output),
        (false, true) => Err(
            CorpusError::from_wrong_message("a corpus cannot be merged into an annotation file")
                .with_error_place(args.mine.display().to_string())
                .with_advice("name the corpus first")
                .into(),
        ),
    }
}

fn is_corpus(path: &Path) -> bool {
    let mut head = [0; 16];
    let read = std::fs::File::open(path).and_then(|mut file| std::io::Read::read_exact(&mut file, &mut head));
    // The first bytes of every SQLite file.
    read.is_ok() && head.starts_with(b"SQLite format 3")
}

fn corpora(cli: &CommandLine, args: &MergeArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.mine)?;
    let report = with_progress_bar(|progress| corpus.merge_corpus(&args.other, args.base.as_deref(), progress))?;
    print_merge_report(&report, output)?;
    output.set_json_document(report)
}

fn print_merge_report(report: &MergeReport, output: &mut CommandOutput) -> Result<()> {
    let kinds = [
        (words::ADDED, &report.added),
        (words::CHANGED, &report.changed),
        (words::REMOVED, &report.removed),
    ];
    let mut any_printed = false;
    for (text, counts) in kinds {
        let counts: Vec<String> = counts
            .iter()
            .map(|(kind, count)| format!("{count} × {}", output.output_text(words::merged_kind_noun(kind))))
            .collect();
        if !counts.is_empty() {
            any_printed = true;
            output.text_line(text, &[("what", &counts.join(", "))])?;
        }
    }
    if !any_printed {
        output.text_line(words::NOTHING, &[])?;
    }
    for note in &report.notes {
        output.write_note(note)?;
    }
    list_merge_conflicts(&report.conflicts, output)?;
    if !report.conflicts.is_empty() {
        output.text_line(words::DECIDE, &[])?;
    }
    Ok(())
}

fn list_merge_conflicts(conflicts: &[CorpusConflict], output: &mut CommandOutput) -> Result<()> {
    if conflicts.is_empty() {
        return output.text_line(words::NO_CONFLICTS, &[]);
    }
    let shown = |side: &Option<chereme_corpus::ConflictCandidate>| match side {
        Some(side) => output.translate_message(&side.to_string()),
        None => output.output_text(words::GONE).to_owned(),
    };
    let rows: Vec<Vec<String>> = conflicts
        .iter()
        .map(|conflict| {
            let decided = conflict
                .decided
                .map(|choice| output.output_text(words::decision_word(choice)).to_owned());
            vec![
                conflict.number.to_string(),
                conflict.what.clone(),
                output.translate_message(&conflict.place),
                shown(&conflict.mine),
                shown(&conflict.theirs),
                conflict.from.clone(),
                decided.unwrap_or_default(),
            ]
        })
        .collect();
    let title_words = [
        words::NUMBER,
        words::WHAT,
        words::PLACE,
        words::MINE,
        words::THEIRS,
        words::FROM,
        words::DECIDED,
    ];
    let titles = title_words.map(|text| output.output_text(text));
    output.write_titled_table(&titles, &rows)
}

/// Imports a changed annotation file, and keeps the edits of both sides.
fn file_into_corpus(cli: &CommandLine, args: &MergeArgs, output: &mut CommandOutput) -> Result<()> {
    // The export remembers its state in the corpus.
    if let Some(base) = &args.base {
        return Err(
            CorpusError::from_wrong_message("a corpus already has the state from which the file was exported")
                .with_error_place(base.display().to_string())
                .with_advice("leave --base out")
                .into(),
        );
    }
    let mut corpus = cli.open_cli_corpus(&args.mine)?;
    let options = ImportOptions {
        own_edits: OwnEdits::Merge,
        ..ImportOptions::default()
    };
    let report =
        with_progress_bar(|progress| corpus.import_paths(std::slice::from_ref(&args.other), &options, progress))?;
    for file in &report.files {
        for finding in &file.findings {
            let message = output.translate_message(&finding.message);
            output.filled_line(&format!("{}: {{what}}", finding.severity), &[&message])?;
        }
    }
    let conflicts = corpus.merge_conflicts(false)?;
    list_merge_conflicts(&conflicts, output)?;
    output.set_json_document(json!({ "import": report, "conflicts": conflicts }))
}

fn merge_annotation_files(args: &MergeArgs, output: &mut CommandOutput) -> Result<()> {
    let Some(to) = &args.to else {
        return Err(CorpusError::from_wrong_message("the merged file needs a name")
            .with_advice("write --to merged.eaf, or --to - for standard output")
            .into());
    };
    let name = |path: &Path| path.display().to_string();
    let base_path = args.base.as_deref();
    // Without a common state, what either side lacks counts as never written.
    let base = base_path.map(|path| Ok::<_, anyhow::Error>((name(path), streams::read_file_or_stdin(path)?)));
    let base = base.transpose()?;
    let (mine, other) = (
        streams::read_file_or_stdin(&args.mine)?,
        streams::read_file_or_stdin(&args.other)?,
    );
    let merged = merge_files(
        base.as_ref().map(|(name, bytes)| (name.as_str(), bytes.as_slice())),
        (&name(&args.mine), &mine),
        (&name(&args.other), &other),
    )?;
    if streams::is_standard(to) {
        streams::not_with_json(output.is_json())?;
        let mut out = streams::StdoutDocument::new();
        out.write_all(&merged.bytes)?;
        out.flush()?;
        output.silence_output();
        return Ok(());
    }
    // Asked before the merge is printed, as a refused one must not look done.
    if to.exists() && !args.force {
        return Err(CorpusError::from_existing_file(to).into());
    }
    std::fs::write(to, &merged.bytes).map_err(|error| CorpusError::from_file_failure(to, error))?;
    diff::print_difference(&merged.changes, output)?;
    for it in &merged.conflicts {
        let shown = |side: &Option<chereme_corpus::ComparedAnnotation>| match side {
            Some(side) => format!("{:?}", side.value),
            None => output.output_text(words::GONE).to_owned(),
        };
        let (mine, theirs) = (shown(&it.mine), shown(&it.theirs));
        let parts: [(&str, &dyn std::fmt::Display); 3] = [("tier", &it.tier), ("mine", &mine), ("theirs", &theirs)];
        output.text_line(words::CONFLICT, &parts)?;
    }
    output.set_json_document(merged)
}

pub(super) fn list_or_decide_conflicts(
    cli: &CommandLine,
    args: &ConflictsArgs,
    output: &mut CommandOutput,
) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let Some(decision) = args.take else {
        if let Some(number) = args.numbers.first() {
            return Err(CorpusError::from_wrong_message("no decision is given")
                .with_error_place(number.clone())
                .with_advice("add --take mine, theirs or both")
                .into());
        }
        let all = corpus.merge_conflicts(args.decided)?;
        list_merge_conflicts(&all, output)?;
        return output.set_json_document(json!({ "total": all.len(), "rows": all }));
    };
    let conflict_numbers: Vec<usize> = if args.numbers.iter().any(|number| number == "all") {
        corpus
            .merge_conflicts(false)?
            .iter()
            .map(|conflict| conflict.number)
            .collect()
    } else {
        let number = |text: &String| {
            text.parse::<usize>().map_err(|_| {
                CorpusError::from_wrong_message(format!("{text:?} is no number of a conflict"))
                    .with_error_place(text.clone())
                    .with_advice("`chereme conflicts CORPUS` lists them; `all` means all of them")
            })
        };
        let numbers: Result<Vec<usize>, CorpusError> = args.numbers.iter().map(number).collect();
        numbers?
    };
    // `all` of no open conflicts is done already.
    if conflict_numbers.is_empty() && !args.numbers.is_empty() {
        list_merge_conflicts(&[], output)?;
        return output.set_json_document(json!({ "total": 0, "rows": [] }));
    }
    if conflict_numbers.is_empty() {
        return Err(CorpusError::from_wrong_message("which conflicts?")
            .with_advice("name them by their numbers, or write all")
            .into());
    }
    let decided = corpus.decide_conflicts(&conflict_numbers, decision)?;
    list_merge_conflicts(&decided, output)?;
    output.set_json_document(json!({ "total": decided.len(), "rows": decided }))
}
