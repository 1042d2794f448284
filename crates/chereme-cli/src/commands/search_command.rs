//! `chereme search`: finds the tokens that answer a query, counts them, and saves queries.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use anyhow::Result;
use chereme_corpus::{
    Corpus, CorpusError, FACET_VALUES, HitOrder, KeptSearch, SearchHit, SearchOptions, TallyRow, ValueOpinion,
    ValueTally, components_text,
};
use clap::ValueEnum;
use serde_json::json;

use crate::args::CommandLine;
use crate::output::{CommandOutput, with_progress_bar};

/// Find the tokens that answer a query
///
/// A query finds lexicon entries like captured tokens. Quote it for your shell, for example 'right.configuration=U
/// placement=chin' or 'gloss:BO* not weak.configuration=S'. Any query can contain @NAME for a search that was saved
/// with --keep NAME; `chereme list CORPUS searches` lists the saved ones.
///
/// Several corpora are asked one after another if their files stand before the query; hits name their corpus, and counts
/// are added up.
#[derive(Debug, clap::Args)]
#[command(after_long_help = chereme_corpus::QUERY_HELP)]
pub(crate) struct SearchArgs {
    /// The corpus
    corpus: PathBuf,
    /// The query; all of its conditions must hold. @NAME stands for a saved search. Further corpora stand before it
    #[arg(required_unless_present = "forget", value_name = "QUERY")]
    query: Vec<String>,
    /// Save the query in the corpus as @NAME
    #[arg(long, value_name = "NAME")]
    keep: Option<String>,
    /// Replace the search that is saved under that name
    #[arg(long, requires = "keep")]
    replace: bool,
    /// Delete the saved search NAME
    #[arg(long, value_name = "NAME", conflicts_with_all = ["query", "keep"])]
    forget: Option<String>,
    /// Show at most N tokens
    #[arg(long, value_name = "N")]
    limit: Option<usize>,
    /// Skip the first N tokens
    #[arg(long, default_value_t = 0, value_name = "N")]
    offset: usize,
    /// The order of the results: rank (the best first if the query ranks, otherwise by recording and time), gloss, place
    /// (recording and time), duration (the longest first), or an attribute such as density; with - before it the greatest first
    #[arg(long, value_name = "ORDER", default_value = "rank", allow_hyphen_values = true)]
    sort: String,
    /// Leave out the counts of values
    #[arg(long)]
    no_facets: bool,
    /// The number of values of each field whose counts are shown, or all
    #[arg(long, value_name = "N|all", value_parser = facet_count)]
    facets: Option<usize>,
    /// Count the values of a field among all tokens found, such as placement or signer
    #[arg(long, value_name = "FIELD", conflicts_with = "cross")]
    count: Option<String>,
    /// Count them for each value of another field, too, such as signer
    #[arg(long, value_name = "FIELD", requires = "count")]
    by: Option<String>,
    /// Count how often each pair of values of two fields occurs, such as dominant.configuration placement
    #[arg(long, num_args = 2, value_names = ["ROWS", "COLUMNS"])]
    cross: Vec<String>,
    /// Write the table of --count or --cross with commas or tabs between its cells
    #[arg(long, value_enum, default_value_t = TableFormat::Text)]
    table: TableFormat,
}

fn facet_count(text: &str) -> Result<usize, String> {
    match text {
        "all" => Ok(usize::MAX),
        _ => text.parse().map_err(|_| "write a number, or all".to_owned()),
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum TableFormat {
    /// A table for people to read
    Text,
    /// Commas between the cells
    Csv,
    /// Tabs between the cells
    Tsv,
}

/// The number of values of a field that are shown without `--facets`.
const TABLE_FACETS: usize = 8;

/// The number of rows of a table without `--limit`.
const TABLE_ROWS: usize = 50;

pub(super) fn run(cli: &CommandLine, args: &SearchArgs, output: &mut CommandOutput) -> Result<()> {
    let further = args.query.iter().take_while(|word| is_corpus_file(word)).count();
    if further > 0 {
        return search_several_corpora(cli, args, further, output);
    }
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    if let Some(name) = &args.forget {
        let forgotten = corpus.forget_search(name)?;
        output.filled_line(
            "saved search @{name} deleted: {query}",
            &[&forgotten.name, &forgotten.query],
        )?;
        return output.set_json_document(forgotten);
    }
    let fields = args.counted_fields();
    if !fields.is_empty() {
        let query = args.query.join(" ");
        let tally = with_progress_bar(|progress| corpus.tally_values(&query, &fields, progress))?;
        return print_token_tally(tally, args, output);
    }
    if args.table != TableFormat::Text {
        let error = CorpusError::from_wrong_message("there is no table to write");
        return Err(error.with_advice("name its fields with --count or --cross").into());
    }
    // People read a screen of rows, programs take all.
    let limit = args.limit.or((!output.is_json()).then_some(TABLE_ROWS));
    let options = SearchOptions {
        limit,
        offset: args.offset,
        facets: !args.no_facets,
        facet_values: args.facets.unwrap_or(FACET_VALUES),
        order: HitOrder::order_from_word(&args.sort),
    };
    let query = args.query.join(" ");
    let mut answer = corpus.search_tokens(&query, &options)?;
    if answer.total == 0
        && let Some(meant) = corpus.guess_query_meaning(&query)?
    {
        answer.notes.push(format!("did you mean {meant}?"));
    }
    if let Some(name) = &args.keep {
        answer.notes.push(save_named_query(&mut corpus, args, name, query)?);
    }
    let rows: Vec<Vec<String>> = {
        let lexicons: BTreeSet<&String> = answer.hits.iter().filter_map(|hit| hit.lexicon.as_ref()).collect();
        // The name of the only lexicon would say the same in each row.
        let has_several = lexicons.len() > 1;
        answer
            .hits
            .iter()
            .map(|hit| search_hit_cells(hit, has_several, options.order.order_attribute()))
            .collect()
    };
    if !rows.is_empty() {
        output.write_titled_table(
            &["token", "gloss", "recording", "start", "length", "origin", "components"],
            &rows,
        )?;
    }
    let more = answer.total.saturating_sub(rows.len());
    match (answer.total, more) {
        (1, 0) => output.filled_line("1 token: {query}", &[&answer.query])?,
        (0, 0) => output.filled_line("0 tokens: {query}", &[&answer.query])?,
        (total, 0) => output.filled_line("{n} tokens: {query}", &[&total, &answer.query])?,
        (total, _) => output.filled_line(
            "{n} tokens, {shown} shown: {query}",
            &[&total, &rows.len(), &answer.query],
        )?,
    }
    let shown = args.facets.unwrap_or(TABLE_FACETS);
    for (field, values) in &answer.facets {
        let counts: Vec<String> = values
            .iter()
            .take(shown)
            .map(|(value, count)| format!("{value} {count}"))
            .collect();
        let left_out = answer.facets_left_out.get(field).copied().unwrap_or(0);
        // The library has left out values beyond its own limit.
        let more = match values.len().saturating_sub(shown) + left_out {
            0 => String::new(),
            more => format!(", and {more} more (--facets all)"),
        };
        output.write_output_line(format!("  {field}: {}{more}", counts.join(", ")))?;
    }
    for finding in &answer.findings {
        output.write_note(&finding.finding_message())?;
    }
    for note in &answer.notes {
        output.write_note(note)?;
    }
    output.set_json_document(answer)
}

impl SearchArgs {
    /// Returns the fields whose values are counted.
    fn counted_fields(&self) -> Vec<String> {
        match &self.count {
            Some(field) => [field].into_iter().chain(&self.by).cloned().collect(),
            None => self.cross.clone(),
        }
    }
}

/// Returns whether a word of a query names the file of a corpus, which need not exist: no sign is called so.
fn is_corpus_file(word: &str) -> bool {
    Path::new(word).extension().is_some_and(|ending| ending == "chereme")
}

/// Asks several corpora the same, `further` of them named before the query, and shows their hits one after another, or
/// their counts together.
fn search_several_corpora(
    cli: &CommandLine,
    args: &SearchArgs,
    further: usize,
    output: &mut CommandOutput,
) -> Result<()> {
    let (further, words) = args.query.split_at(further);
    if args.keep.is_some() || args.offset > 0 || words.is_empty() {
        let error =
            CorpusError::from_wrong_message("several corpora are asked a query, and nothing is saved or skipped");
        return Err(error
            .with_advice("write a query after their files, and leave out --keep and --offset")
            .into());
    }
    let (query, fields) = (words.join(" "), args.counted_fields());
    let paths: Vec<&Path> = [args.corpus.as_path()]
        .into_iter()
        .chain(further.iter().map(Path::new))
        .collect();
    let mut sum: Option<ValueTally> = None;
    let (mut total, mut rows, mut answers) = (0, Vec::new(), Vec::new());
    for path in &paths {
        let mut corpus = cli.open_cli_corpus(path)?;
        if !fields.is_empty() {
            let tally = with_progress_bar(|progress| corpus.tally_values(&query, &fields, progress))?;
            match &mut sum {
                Some(sum) => sum.add_tally(tally),
                None => sum = Some(tally),
            }
            continue;
        }
        let limit = args.limit.or((!output.is_json()).then_some(TABLE_ROWS));
        let options = SearchOptions {
            limit: limit.map(|limit| limit.saturating_sub(rows.len())),
            facets: !args.no_facets && output.is_json(),
            facet_values: args.facets.unwrap_or(FACET_VALUES),
            order: HitOrder::order_from_word(&args.sort),
            ..SearchOptions::default()
        };
        let answer = corpus.search_tokens(&query, &options)?;
        total += answer.total;
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        rows.extend(answer.hits.iter().map(|hit| {
            let cells = search_hit_cells(hit, hit.lexicon.is_some(), options.order.order_attribute());
            [name.clone()].into_iter().chain(cells).collect::<Vec<String>>()
        }));
        answers.push(json!({ "corpus": path, "answer": answer }));
    }
    if let Some(sum) = sum {
        return print_token_tally(sum, args, output);
    }
    if !rows.is_empty() {
        output.write_titled_table(
            &[
                "corpus",
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
    output.filled_line(
        "{n} tokens in {corpora}, {shown} shown: {query}",
        &[
            &total,
            &output.format_counted_noun(paths.len() as u64, "corpora"),
            &rows.len(),
            &query,
        ],
    )?;
    output.set_json_document(json!({ "query": query, "total": total, "corpora": answers }))
}

/// Prints the number of tokens found for each value of one field, or for each pair of values of two.
fn print_token_tally(tally: ValueTally, args: &SearchArgs, output: &mut CommandOutput) -> Result<()> {
    let columns: Vec<&str> = match tally.columns.is_empty() {
        true => vec!["tokens"],
        false => tally.columns.iter().map(String::as_str).collect(),
    };
    let title = match &tally.fields[..] {
        [rows, columns] => format!("{rows} / {columns}"),
        _ => tally.fields.concat(),
    };
    let mut header = vec![title.as_str()];
    header.extend(columns);
    if tally.fields.len() > 1 {
        header.push("all");
    }
    let row = |row: &TallyRow| -> Vec<String> {
        let counts = row.counts.iter().chain([&row.total]);
        [row.value.clone()]
            .into_iter()
            .chain(counts.map(ToString::to_string))
            .collect()
    };
    let rows: Vec<Vec<String>> = tally.rows.iter().map(row).collect();
    match args.table {
        TableFormat::Text => {
            output.write_named_columns(&header, &rows)?;
            output.filled_line("{n} tokens: {query}", &[&tally.total, &tally.query])?;
        }
        separated => {
            let tabs = separated == TableFormat::Tsv;
            let head: Vec<String> = header.iter().map(|cell| (*cell).to_owned()).collect();
            for cells in [head].iter().chain(&rows) {
                output.line_as_is(&separated_line(cells, tabs))?;
            }
        }
    }
    output.set_json_document(tally)
}

/// Returns cells as a line of a CSV or TSV table.
pub(super) fn separated_line(cells: &[String], tabs: bool) -> String {
    let separator = if tabs { "\t" } else { "," };
    let quoted = |cell: &String| {
        let plain = !cell.contains(['"', '\n', '\r']) && !cell.contains(separator);
        match plain {
            true => cell.clone(),
            false => format!("\"{}\"", cell.replace('"', "\"\"")),
        }
    };
    let cells: Vec<String> = cells.iter().map(quoted).collect();
    cells.join(separator)
}

/// Saves a query in the corpus, and reports its name.
fn save_named_query(corpus: &mut Corpus, args: &SearchArgs, name: &str, query: String) -> Result<String> {
    let name = name.trim().trim_start_matches('@').to_owned();
    let message = format!("saved: @{name} stands for this query");
    let search = KeptSearch { name, query };
    match args.replace {
        true => corpus.keep_searches(&[search])?,
        false => corpus.keep_new_search(&search)?,
    }
    Ok(message)
}

/// Returns the cells of a hit; with `names_lexicon` its gloss is that of a lexicon: `NGT/BOOK`. Before its components
/// stands the value of the attribute that gives the order.
fn search_hit_cells(hit: &SearchHit, names_lexicon: bool, order_attribute: Option<&str>) -> Vec<String> {
    let lexicon = hit.lexicon.as_ref().filter(|_| names_lexicon);
    let seconds = |micros: i64| format!("{:.3}", micros as f64 / 1e6);
    let length = hit.start_us.zip(hit.end_us).map(|(start, end)| seconds(end - start));
    vec![
        hit.token.to_string(),
        lexicon.map_or_else(|| hit.gloss.clone(), |lexicon| format!("{lexicon}/{}", hit.gloss)),
        hit.recording.clone().unwrap_or_default(),
        hit.start_us.map(seconds).unwrap_or_default(),
        length.unwrap_or_default(),
        hit.origin.record_origin_name().to_owned(),
        order_attribute
            .map(|name| format!("{name}={}", hit.order_values.join(",")))
            .filter(|_| !hit.order_values.is_empty())
            .into_iter()
            .chain([components_text(&hit.components)])
            .chain(hit.opinions.iter().map(opinion_text))
            .filter(|text| !text.is_empty())
            .collect::<Vec<_>>()
            .join(" "),
    ]
}

/// Returns an opinion marked with why it does not count: `right.placement=chin [proposed, detector, 0.92]`.
fn opinion_text(opinion: &ValueOpinion) -> String {
    let mut marks = vec![opinion.standing.standing_name().to_owned()];
    marks.extend(opinion.by.clone());
    marks.extend(opinion.confidence.map(|sure| format!("{sure:.2}")));
    format!("{}={} [{}]", opinion.field, opinion.value, marks.join(", "))
}
