//! `chereme consent`: states what signers agreed to.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{Address, Audience, ConsentChange, ConsentRow};

use crate::args::Cli;
use crate::output::Output;

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
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// The signers and recordings, such as signer:Ada or recording:3
    #[arg(value_name = "WHO")]
    who: Vec<Address>,
    /// Who may see all three: public, research, nobody, or unknown
    #[arg(long, value_name = "AUDIENCE", value_parser = audience)]
    all: Option<Said>,
    /// Who may see the recorded movement
    #[arg(long, value_name = "AUDIENCE", value_parser = audience)]
    movement: Option<Said>,
    /// Who may see what annotators wrote about it
    #[arg(long, value_name = "AUDIENCE", value_parser = audience)]
    annotation: Option<Said>,
    /// Who may see signs made from it
    #[arg(long, value_name = "AUDIENCE", value_parser = audience)]
    derived: Option<Said>,
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
struct Said(Option<Audience>);

fn audience(text: &str) -> std::result::Result<Said, String> {
    if text.trim() == "unknown" {
        return Ok(Said(None));
    }
    let read = text.parse::<Audience>();
    read.map(|it| Said(Some(it)))
        .map_err(|_| "write public, research, nobody or unknown".to_owned())
}

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let mut corpus = cli.open(&args.corpus)?;
    let said = |own: Option<Said>| own.or(args.all).map(|it| it.0);
    let filled = |text: &Option<String>| {
        let text = text.as_deref().map(str::trim);
        text.map(|it| Some(it.to_owned()).filter(|it| !it.is_empty()))
    };
    let change = ConsentChange {
        movement: said(args.movement),
        annotation: said(args.annotation),
        derived: said(args.derived),
        day: filled(&args.day),
        form: filled(&args.form),
        licence: args.licence.clone(),
    };
    let rows = if change == ConsentChange::default() {
        let all = corpus.consents()?;
        let named = corpus.consents_of(&args.who)?;
        if args.who.is_empty() { all } else { named }
    } else if args.who.is_empty() {
        return Err(chereme_corpus::Error::wrong("nobody is named")
            .advise("name signers or recordings, such as signer:Ada or recording:3")
            .into());
    } else {
        corpus.change_consent(&args.who, &change)?
    };
    print(&rows, output)?;
    output.document(rows)
}

fn print(rows: &[ConsentRow], output: &mut Output) -> Result<()> {
    let word = |it: Option<Audience>| it.map_or("", Audience::name).to_owned();
    let rows: Vec<Vec<String>> = rows
        .iter()
        .map(|row| {
            let it = &row.consent;
            vec![
                format!("{}:{}", row.of, row.id),
                row.name.clone(),
                word(it.movement),
                word(it.annotation),
                word(it.derived),
                it.day.clone().unwrap_or_default(),
                it.form.clone().unwrap_or_default(),
            ]
        })
        .collect();
    let titles = [
        "of",
        "name",
        "movement",
        "annotation",
        "derived",
        "day",
        "form",
    ];
    output.table(&titles, &rows)
}
