//! `chereme study answers`: lists the answers to a study, and writes them as a table.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::study::{AnswerFilter, AnswerRow};
use chereme_corpus::words::reporting;

use crate::args::Cli;
use crate::output::Output;

/// List the answers one by one, or write all of them as a table
///
/// Questions without an answer are listed, too: a participant passed over them, for example because the browser could not
/// show the film, or did not get that far. A table (.csv) has one answer a row, and import reads it again.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// The name of the study
    name: String,
    /// The table to write (.csv), with all answers
    #[arg(long, value_name = "FILE", conflicts_with_all = ["participant", "only", "missing"])]
    to: Option<PathBuf>,
    /// Replace a file that exists already
    #[arg(long)]
    force: bool,
    /// Only the answers of this participant
    #[arg(long, value_name = "CODE")]
    participant: Option<String>,
    /// Only answers whose item, condition, part or question contains these words
    #[arg(long, value_name = "WORDS")]
    only: Option<String>,
    /// Only questions without an answer
    #[arg(long)]
    missing: bool,
}

/// The most rows that are printed.
const MOST_ROWS: usize = 500;

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let corpus = cli.open(&args.corpus)?;
    if let Some(to) = &args.to {
        let count = corpus.export_answers(&args.name, to, args.force)?;
        output.filled_line("wrote {n} answers to {path}", &[&count, &to.display()])?;
        return output.document(serde_json::json!({ "path": to, "answers": count }));
    }
    let filter = AnswerFilter {
        participant: args.participant.clone(),
        text: args.only.clone().unwrap_or_default(),
        missing: args.missing,
    };
    let mut list = corpus.study_answers(&args.name)?;
    let sum = |of: fn(&chereme_corpus::study::ParticipantSummary) -> u64| -> u64 {
        list.participants.iter().map(of).sum()
    };
    output.filled_line(
        "{people}, {n} to the end; {answers} answers, {m} passed over, {k} not reached",
        &[
            &output.counted(list.participants.len() as u64, "participants"),
            &sum(|it| u64::from(it.finished)),
            &sum(|it| it.answers),
            &sum(|it| it.skipped),
            &sum(|it| it.not_reached),
        ],
    )?;
    list.keep(&filter)?;
    let language = output.language();
    let row = |it: &AnswerRow| {
        let right = it.right.map(|right| match right {
            true => reporting::YES.of(language),
            false => reporting::NO.of(language),
        });
        vec![
            it.participant.clone(),
            it.n.map_or_else(String::new, |it| it.to_string()),
            it.part.clone(),
            it.item.clone(),
            it.condition.clone(),
            it.question.clone(),
            reporting::answer_text(it, language),
            right.unwrap_or_default().to_owned(),
            it.plays.to_string(),
        ]
    };
    let rows: Vec<Vec<String>> = list.rows.iter().take(MOST_ROWS).map(row).collect();
    output.table(
        &[
            "participant",
            "place",
            "part",
            "item",
            "condition",
            "question",
            "answer",
            "right",
            "plays",
        ],
        &rows,
    )?;
    if list.rows.len() > MOST_ROWS {
        let more = list.rows.len() - MOST_ROWS;
        output.filled_line("rows that are not shown: {n}; --json has all", &[&more])?;
    }
    output.document(list)
}
