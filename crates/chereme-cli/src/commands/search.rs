//! `chereme search`.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{Corpus, Hit, KeptSearch, Order, SearchOptions, components_text};
use clap::ValueEnum;

use crate::args::Cli;
use crate::output::Output;

/// Find the tokens that answer a query
///
/// Lexicon entries are found like captured tokens. Quote the query for your shell, for example
/// 'right.configuration=U placement=chin' or 'gloss:BO* not weak.configuration=S'. What --keep NAME
/// kept in the corpus is asked as @NAME; `chereme list CORPUS searches` lists it.
#[derive(Debug, clap::Args)]
#[command(after_long_help = chereme_corpus::QUERY_HELP)]
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// The query, words side by side must all hold; or @NAME, a kept one
    #[arg(required_unless_present = "forget", value_name = "QUERY")]
    query: Vec<String>,
    /// Save the query in the corpus as @NAME, in place of an earlier one of that name
    #[arg(long, value_name = "NAME")]
    keep: Option<String>,
    /// Delete the saved search NAME
    #[arg(long, value_name = "NAME", conflicts_with_all = ["query", "keep"])]
    forget: Option<String>,
    /// Show at most N tokens
    #[arg(long, value_name = "N")]
    limit: Option<usize>,
    /// Skip the first N tokens
    #[arg(long, default_value_t = 0, value_name = "N")]
    offset: usize,
    /// In which order
    #[arg(long, value_enum, default_value_t = OrderWord::Rank)]
    sort: OrderWord,
    /// Leave out the counts of values
    #[arg(long)]
    no_facets: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum OrderWord {
    /// The best first where the query ranks, else by recording and time
    Rank,
    /// By gloss
    Gloss,
    /// By recording and time
    Place,
    /// The longest first
    Duration,
}

/// What a table shows without --limit.
const TABLE_ROWS: usize = 50;

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let mut corpus = cli.open(&args.corpus)?;
    if let Some(name) = &args.forget {
        let forgotten = corpus.forget_search(name)?;
        output.line(format!(
            "@{} is kept no longer: {}",
            forgotten.name, forgotten.query
        ))?;
        return output.document(forgotten);
    }
    let limit = args.limit.or((!output.is_json()).then_some(TABLE_ROWS));
    let order = match args.sort {
        OrderWord::Rank => Order::Rank,
        OrderWord::Gloss => Order::Gloss,
        OrderWord::Place => Order::Place,
        OrderWord::Duration => Order::Duration,
    };
    let options = SearchOptions {
        limit,
        offset: args.offset,
        facets: !args.no_facets,
        order,
    };
    let query = args.query.join(" ");
    let mut answer = corpus.search(&query, &options)?;
    if answer.total == 0
        && let Some(meant) = corpus.guess(&query)?
    {
        answer.notes.push(format!("did you mean {meant}?"));
    }
    if let Some(name) = &args.keep {
        answer.notes.push(keep(&mut corpus, name, query)?);
    }
    let rows: Vec<Vec<String>> = answer.hits.iter().map(cells).collect();
    if !rows.is_empty() {
        output.table(
            &[
                "token",
                "gloss",
                "recording",
                "start",
                "length",
                "origin",
                "components",
            ],
            &rows,
        )?;
    }
    let more = answer.total.saturating_sub(rows.len());
    let more = if more > 0 {
        format!(", {} shown", rows.len())
    } else {
        String::new()
    };
    let word = if answer.total == 1 { "token" } else { "tokens" };
    output.line(format!("{} {word}{more}: {}", answer.total, answer.query))?;
    for (field, values) in &answer.facets {
        let counts: Vec<String> = values
            .iter()
            .take(8)
            .map(|(value, count)| format!("{value} {count}"))
            .collect();
        output.line(format!("  {field}: {}", counts.join(", ")))?;
    }
    for note in &answer.notes {
        output.line(format!("note: {note}"))?;
    }
    output.document(answer)
}

/// Keeps a query, and says so.
fn keep(corpus: &mut Corpus, name: &str, query: String) -> Result<String> {
    let name = name.trim().trim_start_matches('@').to_owned();
    let said = format!("kept: @{name} asks this again");
    corpus.keep_searches(&[KeptSearch { name, query }])?;
    Ok(said)
}

fn cells(hit: &Hit) -> Vec<String> {
    let seconds = |micros: i64| format!("{:.3}", micros as f64 / 1e6);
    let length = hit
        .start_us
        .zip(hit.end_us)
        .map(|(start, end)| seconds(end - start));
    vec![
        hit.token.to_string(),
        hit.gloss.clone(),
        hit.recording.clone().unwrap_or_default(),
        hit.start_us.map(seconds).unwrap_or_default(),
        length.unwrap_or_default(),
        hit.origin.clone(),
        components_text(&hit.components),
    ]
}
