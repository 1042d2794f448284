//! `chereme merge` and `chereme conflicts`: merges diverged copies, and decides their conflicts.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Result;
use chereme_corpus::words::merge as words;
use chereme_corpus::{
    CorpusConflict, Decision, Error, ImportOptions, MergeReport, OwnEdits, Progress, merge_files,
};
use clap::ValueEnum;
use serde_json::json;

use super::diff;
use crate::args::Cli;
use crate::output::{Bar, Output};
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
    #[arg(long, value_enum)]
    take: Option<Take>,
    /// List decided conflicts, too
    #[arg(long)]
    decided: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Take {
    /// Your candidate stays
    Mine,
    /// The other candidate takes its place
    Theirs,
    /// Both stay
    Both,
}

pub(super) fn merge(cli: &Cli, args: &MergeArgs, output: &mut Output) -> Result<()> {
    if is_corpus(&args.mine) && streams::is_standard(&args.other) {
        return Err(Error::wrong(
            "standard input has no name by which the corpus could find the earlier version of the file",
        )
        .at("-")
        .advise("write `chereme import CORPUS - --format eaf --name NAME --merge`")
        .into());
    }
    match (is_corpus(&args.mine), is_corpus(&args.other)) {
        (true, true) => corpora(cli, args, output),
        (true, false) => file_into_corpus(cli, args, output),
        (false, false) => files(args, output),
        (false, true) => Err(
            Error::wrong("a corpus cannot be merged into an annotation file")
                .at(args.mine.display().to_string())
                .advise("name the corpus first")
                .into(),
        ),
    }
}

fn is_corpus(path: &Path) -> bool {
    let mut head = [0; 16];
    let read = std::fs::File::open(path)
        .and_then(|mut file| std::io::Read::read_exact(&mut file, &mut head));
    read.is_ok() && head.starts_with(b"SQLite format 3")
}

fn corpora(cli: &Cli, args: &MergeArgs, output: &mut Output) -> Result<()> {
    let mut corpus = cli.open(&args.mine)?;
    let mut bar = Bar::new();
    let mut hear = |step: chereme_corpus::Step<'_>| bar.show(step);
    let progress = &mut Progress::new(&mut hear);
    let report = corpus.merge(&args.other, args.base.as_deref(), progress)?;
    drop(bar);
    print(&report, output)?;
    output.document(report)
}

fn print(report: &MergeReport, output: &mut Output) -> Result<()> {
    let kinds = [
        (words::ADDED, &report.added),
        (words::CHANGED, &report.changed),
        (words::REMOVED, &report.removed),
    ];
    let mut said = false;
    for (text, counts) in kinds {
        let counts: Vec<String> = counts
            .iter()
            .map(|(kind, count)| format!("{count} × {}", output.say(words::kind(kind))))
            .collect();
        if !counts.is_empty() {
            said = true;
            output.text_line(text, &[("what", &counts.join(", "))])?;
        }
    }
    if !said {
        output.text_line(words::NOTHING, &[])?;
    }
    for note in &report.notes {
        output.note(note)?;
    }
    list(&report.conflicts, output)?;
    if !report.conflicts.is_empty() {
        output.text_line(words::DECIDE, &[])?;
    }
    Ok(())
}

fn list(conflicts: &[CorpusConflict], output: &mut Output) -> Result<()> {
    if conflicts.is_empty() {
        return output.text_line(words::NO_CONFLICTS, &[]);
    }
    let shown = |side: &Option<chereme_corpus::Candidate>| match side {
        Some(side) => output.spoken(&side.to_string()),
        None => output.say(words::GONE).to_owned(),
    };
    let rows: Vec<Vec<String>> = conflicts
        .iter()
        .map(|it| {
            let decided = it
                .decided
                .map(|it| output.say(words::decision(it)).to_owned());
            vec![
                it.number.to_string(),
                it.what.clone(),
                output.spoken(&it.place),
                shown(&it.mine),
                shown(&it.theirs),
                it.from.clone(),
                decided.unwrap_or_default(),
            ]
        })
        .collect();
    let titles = [
        words::NUMBER,
        words::WHAT,
        words::PLACE,
        words::MINE,
        words::THEIRS,
        words::FROM,
        words::DECIDED,
    ];
    let titles = titles.map(|text| output.say(text));
    output.table(&titles, &rows)
}

/// Imports a changed annotation file, and keeps the edits of both sides.
fn file_into_corpus(cli: &Cli, args: &MergeArgs, output: &mut Output) -> Result<()> {
    if let Some(base) = &args.base {
        return Err(Error::wrong(
            "a corpus already has the state from which the file was exported",
        )
        .at(base.display().to_string())
        .advise("leave --base out")
        .into());
    }
    let mut corpus = cli.open(&args.mine)?;
    let options = ImportOptions {
        own_edits: OwnEdits::Merge,
        ..ImportOptions::default()
    };
    let mut bar = Bar::new();
    let mut hear = |step: chereme_corpus::Step<'_>| bar.show(step);
    let progress = &mut Progress::new(&mut hear);
    let report = corpus.import(std::slice::from_ref(&args.other), &options, progress)?;
    drop(bar);
    for file in &report.files {
        for finding in &file.findings {
            let said = output.spoken(&finding.message);
            output.filled_line(&format!("{}: {{what}}", finding.severity), &[&said])?;
        }
    }
    let conflicts = corpus.conflicts(false)?;
    list(&conflicts, output)?;
    output.document(json!({ "import": report, "conflicts": conflicts }))
}

fn files(args: &MergeArgs, output: &mut Output) -> Result<()> {
    let Some(to) = &args.to else {
        return Err(Error::wrong("the merged file needs a name")
            .advise("write --to merged.eaf, or --to - for standard output")
            .into());
    };
    let name = |path: &Path| path.display().to_string();
    let base = args.base.as_deref();
    let base = base.map(|path| Ok::<_, anyhow::Error>((name(path), diff::bytes(path)?)));
    let base = base.transpose()?;
    let (mine, other) = (diff::bytes(&args.mine)?, diff::bytes(&args.other)?);
    let merged = merge_files(
        base.as_ref()
            .map(|(name, bytes)| (name.as_str(), bytes.as_slice())),
        (&name(&args.mine), &mine),
        (&name(&args.other), &other),
    )?;
    if streams::is_standard(to) {
        streams::not_with_json(output.is_json())?;
        let mut out = streams::Document::new();
        out.write_all(&merged.bytes)?;
        out.flush()?;
        output.silence();
        return Ok(());
    }
    if to.exists() && !args.force {
        return Err(Error::file(to, std::io::ErrorKind::AlreadyExists.into()).into());
    }
    std::fs::write(to, &merged.bytes).map_err(|error| Error::file(to, error))?;
    diff::print(&merged.changes, output)?;
    for it in &merged.conflicts {
        let shown = |side: &Option<chereme_corpus::ComparedAnnotation>| match side {
            Some(side) => format!("{:?}", side.value),
            None => output.say(words::GONE).to_owned(),
        };
        let (mine, theirs) = (shown(&it.mine), shown(&it.theirs));
        let parts: [(&str, &dyn std::fmt::Display); 3] =
            [("tier", &it.tier), ("mine", &mine), ("theirs", &theirs)];
        output.text_line(words::CONFLICT, &parts)?;
    }
    output.document(merged)
}

pub(super) fn conflicts(cli: &Cli, args: &ConflictsArgs, output: &mut Output) -> Result<()> {
    let mut corpus = cli.open(&args.corpus)?;
    let Some(take) = args.take else {
        if let Some(number) = args.numbers.first() {
            return Err(Error::wrong("no decision is given")
                .at(number.clone())
                .advise("add --take mine, theirs or both")
                .into());
        }
        let all = corpus.conflicts(args.decided)?;
        list(&all, output)?;
        return output.document(json!({ "total": all.len(), "rows": all }));
    };
    let numbers: Vec<usize> = if args.numbers.iter().any(|it| it == "all") {
        corpus
            .conflicts(false)?
            .iter()
            .map(|it| it.number)
            .collect()
    } else {
        let number = |text: &String| {
            text.parse::<usize>().map_err(|_| {
                Error::wrong(format!("{text:?} is no number of a conflict"))
                    .at(text.clone())
                    .advise("`chereme conflicts CORPUS` lists them; `all` means all of them")
            })
        };
        let numbers: Result<Vec<usize>, Error> = args.numbers.iter().map(number).collect();
        numbers?
    };
    if numbers.is_empty() && !args.numbers.is_empty() {
        list(&[], output)?;
        return output.document(json!({ "total": 0, "rows": [] }));
    }
    if numbers.is_empty() {
        return Err(Error::wrong("which conflicts?")
            .advise("name them by their numbers, or write all")
            .into());
    }
    let decision = match take {
        Take::Mine => Decision::Mine,
        Take::Theirs => Decision::Theirs,
        Take::Both => Decision::Both,
    };
    let decided = corpus.decide(&numbers, decision)?;
    list(&decided, output)?;
    output.document(json!({ "total": decided.len(), "rows": decided }))
}
