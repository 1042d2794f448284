//! `chereme consent`: states what signers agreed to.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{ConsentAudience, ConsentChange, ConsentRow, CorpusAddress};

use crate::args::CommandLine;
use crate::output::CommandOutput;

/// State what signers agreed to: who may see their movement, its annotation, and signs made from it
///
/// A consent belongs to a signer, or to one recording; where both say something, the narrower of the two holds. After a
/// merge of copies that disagree, too, the narrower one holds until somebody decides (`chereme conflicts`). Without a
/// statement a consent is unknown, and `chereme publish` leaves out what it covers. Movement shows who signs even without a
/// face: state it only after the person agreed. Without an option the consents are listed.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme consent mine.chereme
  chereme consent mine.chereme signer:Ada --all public --day 2026-11-27 --form 'form 3, explained in LSF'
  chereme consent mine.chereme signer:Ada --movement research --annotation public
  chereme consent mine.chereme recording:3 --all nobody
  chereme consent mine.chereme signer:Ada --licence 'CC BY-NC-SA 4.0'")]
pub(crate) struct ConsentArgs {
    /// The corpus
    corpus: PathBuf,
    /// The signers and recordings, such as signer:Ada or recording:3
    #[arg(value_name = "WHO")]
    who: Vec<CorpusAddress>,
    /// Who may see all three: public, research, nobody, or unknown
    #[arg(long, value_name = "AUDIENCE", value_parser = audience)]
    all: Option<ParsedAudience>,
    /// Who may see the recorded movement
    #[arg(long, value_name = "AUDIENCE", value_parser = audience)]
    movement: Option<ParsedAudience>,
    /// Who may see what annotators wrote about it
    #[arg(long, value_name = "AUDIENCE", value_parser = audience)]
    annotation: Option<ParsedAudience>,
    /// Who may see signs made from it
    #[arg(long, value_name = "AUDIENCE", value_parser = audience)]
    derived: Option<ParsedAudience>,
    /// The day of the agreement, such as 2026-11-27
    #[arg(long)]
    day: Option<String>,
    /// What was signed: the version of a form, its language
    #[arg(long, value_name = "TEXT")]
    form: Option<String>,
    /// The terms of use of those recordings that have none
    #[arg(long, value_name = "TERMS")]
    licence: Option<String>,
}

/// An audience, or nothing for `unknown`.
#[derive(Debug, Clone, Copy)]
struct ParsedAudience(Option<ConsentAudience>);

fn audience(text: &str) -> std::result::Result<ParsedAudience, String> {
    if text.trim() == "unknown" {
        return Ok(ParsedAudience(None));
    }
    let read = text.parse::<ConsentAudience>();
    read.map(|value| ParsedAudience(Some(value)))
        .map_err(|_| "write public, research, nobody or unknown".to_owned())
}

pub(super) fn run(cli: &CommandLine, args: &ConsentArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    // What is said of one kind of content counts more than what is said of all.
    let chosen_audience = |own: Option<ParsedAudience>| own.or(args.all).map(|choice| choice.0);
    let filled = |text: &Option<String>| {
        let text = text.as_deref().map(str::trim);
        text.map(|trimmed| Some(trimmed.to_owned()).filter(|owned_text| !owned_text.is_empty()))
    };
    let change = ConsentChange {
        movement: chosen_audience(args.movement),
        annotation: chosen_audience(args.annotation),
        derived: chosen_audience(args.derived),
        day: filled(&args.day),
        form: filled(&args.form),
        licence: args.licence.clone(),
    };
    let rows = if change == ConsentChange::default() {
        let all = corpus.list_consents()?;
        // Without a change the command lists, and a wrong name is an error all the same.
        let named = corpus.consents_of(&args.who)?;
        if args.who.is_empty() { all } else { named }
    } else if args.who.is_empty() {
        return Err(chereme_corpus::CorpusError::from_wrong_message("nobody is named")
            .with_advice("name signers or recordings, such as signer:Ada or recording:3")
            .into());
    } else {
        corpus.change_consent(&args.who, &change)?
    };
    print_consent_rows(&rows, output)?;
    output.set_json_document(rows)
}

fn print_consent_rows(rows: &[ConsentRow], output: &mut CommandOutput) -> Result<()> {
    let word = |audience: Option<ConsentAudience>| audience.map_or("", ConsentAudience::audience_name).to_owned();
    output.write_item_table(
        rows,
        &[
            ("of", &|row| format!("{}:{}", row.of, row.id)),
            ("name", &|row| row.name.clone()),
            ("movement", &|row| word(row.consent.movement)),
            ("annotation", &|row| word(row.consent.annotation)),
            ("derived", &|row| word(row.consent.derived)),
            ("day", &|row| row.consent.day.clone().unwrap_or_default()),
            ("form", &|row| row.consent.form.clone().unwrap_or_default()),
        ],
    )
}
