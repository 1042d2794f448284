//! `chereme study answers`: lists the answers to a study, and writes them as a table.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::study::report::report_words as reporting;
use chereme_corpus::study::{AnswerFilter, AnswerListRow};

use crate::args::CommandLine;
use crate::output::CommandOutput;

/// List the answers one by one, or write all of them as a table
///
/// Questions without an answer are listed, too: a participant passed over them, for example because the browser could not
/// show the film, or did not get that far. A table (.csv) has one answer a row, and import reads it again.
#[derive(Debug, clap::Args)]
pub(super) struct StudyAnswersArgs {
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
const MAX_PRINTED_ANSWERS: usize = 500;

pub(super) fn run(cli: &CommandLine, args: &StudyAnswersArgs, output: &mut CommandOutput) -> Result<()> {
    let corpus = cli.open_cli_corpus(&args.corpus)?;
    if let Some(to) = &args.to {
        let count = corpus.export_answers(&args.name, to, args.force)?;
        output.filled_line("wrote {n} answers to {path}", &[&count, &to.display()])?;
        return output.set_json_document(serde_json::json!({ "path": to, "answers": count }));
    }
    let filter = AnswerFilter {
        participant: args.participant.clone(),
        text: args.only.clone().unwrap_or_default(),
        missing: args.missing,
    };
    let mut list = corpus.study_answers(&args.name)?;
    let sum =
        |of: fn(&chereme_corpus::study::ParticipantSummary) -> u64| -> u64 { list.participants.iter().map(of).sum() };
    output.filled_line(
        "{people}, {n} to the end; {answers} answers, {m} passed over, {k} not reached",
        &[
            &output.format_counted_noun(list.participants.len() as u64, "participants"),
            &sum(|participant| u64::from(participant.finished)),
            &sum(|participant| participant.answers),
            &sum(|participant| participant.skipped),
            &sum(|participant| participant.not_reached),
        ],
    )?;
    list.keep_filtered_rows(&filter)?;
    let language = output.output_language();
    let right = |answer: &AnswerListRow| {
        let word = answer.right.map(|right| match right {
            true => reporting::YES,
            false => reporting::NO,
        });
        word.map_or_else(String::new, |word| word.text_in_language(language).to_owned())
    };
    output.write_item_table(
        list.rows.iter().take(MAX_PRINTED_ANSWERS),
        &[
            ("participant", &|answer| answer.participant.clone()),
            ("place", &|answer| {
                answer.n.map_or_else(String::new, |number| number.to_string())
            }),
            ("part", &|answer| answer.part.clone()),
            ("item", &|answer| answer.item.clone()),
            ("condition", &|answer| answer.condition.clone()),
            ("question", &|answer| answer.question.clone()),
            ("answer", &|answer| reporting::answer_text(answer, language)),
            ("right", &right),
            ("plays", &|answer| answer.plays.to_string()),
        ],
    )?;
    if list.rows.len() > MAX_PRINTED_ANSWERS {
        let more = list.rows.len() - MAX_PRINTED_ANSWERS;
        output.filled_line("rows that are not shown: {n}; --json has all", &[&more])?;
    }
    output.set_json_document(list)
}
