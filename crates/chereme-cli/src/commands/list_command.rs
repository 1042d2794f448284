//! `chereme list` and `chereme info`: the rows of a corpus, filtered and sorted, and an overview.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::words::history_words::operation_sentence;
use chereme_corpus::words::{InterfaceLanguage, counted_in};
use chereme_corpus::{AttributeInfo, CorpusInfo, ListFilter, ListKind, cell_text};

use crate::args::CommandLine;
use crate::output::CommandOutput;
use crate::words::kinds;

/// List rows: recordings, tracks, signs, tokens, tiers, annotations, inventories, values, signers, searches, studies, operations
#[derive(Debug, clap::Args)]
pub(crate) struct ListArgs {
    /// The corpus
    corpus: PathBuf,
    /// What to list
    #[arg(value_parser = parse_list_kind)]
    kind: ListKind,
    /// Only rows with these values, such as gloss=BO*, start_us=>=500000, recording=recording:3, parent=none
    #[arg(long = "where", value_name = "COLUMN=PATTERN", value_parser = parse_column_pattern)]
    filter: Vec<(String, String)>,
    /// Only values of this inventory; its name may contain blanks
    #[arg(long, value_name = "NAME")]
    inventory: Option<String>,
    /// The column to sort by
    #[arg(long, value_name = "COLUMN")]
    sort: Option<String>,
    /// Sort from the greatest to the least
    #[arg(long)]
    descending: bool,
    /// List at most N rows
    #[arg(long, value_name = "N")]
    limit: Option<usize>,
    /// Skip the first N rows
    #[arg(long, default_value_t = 0, value_name = "N")]
    offset: usize,
}

fn parse_list_kind(text: &str) -> Result<ListKind, String> {
    text.parse()
        .map_err(|error: chereme_corpus::CorpusError| format!("{error}; {}", error.error_remedy().unwrap_or_default()))
}

fn parse_column_pattern(text: &str) -> Result<(String, String), String> {
    let (column, pattern) = text.split_once('=').ok_or("write COLUMN=PATTERN, such as gloss=BO*")?;
    Ok((column.to_owned(), pattern.to_owned()))
}

pub(super) fn list_corpus_rows(cli: &CommandLine, args: &ListArgs, output: &mut CommandOutput) -> Result<()> {
    let corpus = cli.open_cli_corpus(&args.corpus)?;
    let mut columns = args.filter.clone();
    if let Some(name) = &args.inventory {
        // A pattern is compared with the ids as they are; a name may be an older one or one of several spellings.
        let key = match name.contains('*') {
            true => name.clone(),
            false => corpus.inventory_key(name)?,
        };
        columns.push(("inventory".to_owned(), key));
    }
    let filter = ListFilter {
        columns,
        sort: args.sort.clone(),
        descending: args.descending,
        limit: args.limit,
        offset: args.offset,
    };
    let listing = corpus.list_rows(args.kind, &filter)?;
    let columns = args.kind.list_column_names();
    let rows: Vec<Vec<String>> = listing
        .rows
        .iter()
        .map(|row| {
            columns
                .iter()
                .map(|name| row.get(*name).map(cell_text).unwrap_or_default())
                .collect()
        })
        .collect();
    output.write_named_columns(&columns, &rows)?;
    // A limit must not look like the whole list.
    let shown = if (rows.len() as u64) < listing.total {
        format!(", {} shown", rows.len())
    } else {
        String::new()
    };
    let count = output.format_counted_noun(listing.total, args.kind.list_kind_name());
    output.write_output_line(format!("{count}{shown}"))?;
    output.set_json_document(listing)
}

/// Show an overview of a corpus
#[derive(Debug, clap::Args)]
pub(crate) struct InfoArgs {
    /// The corpus
    corpus: PathBuf,
}

pub(super) fn show_corpus_info(cli: &CommandLine, args: &InfoArgs, output: &mut CommandOutput) -> Result<()> {
    let info = cli.open_cli_corpus(&args.corpus)?.load_corpus_info()?;
    print_corpus_info(&info, output)?;
    output.set_json_document(info)
}

fn print_corpus_info(info: &CorpusInfo, output: &mut CommandOutput) -> Result<()> {
    let language = output.output_language();
    let counts = |map: &std::collections::BTreeMap<String, u64>| {
        map.iter()
            .map(|(what, count)| kinds::format_kind_count(*count, what, language))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let counted = |(what, count): (&&str, &u64)| counted_in(*count, what, language);
    output.filled_line(
        "{path}: {size} MB, schema version {version}",
        &[
            &info.path.display(),
            &format_args!("{:.1}", info.file_bytes as f64 / 1e6),
            &info.schema_version,
        ],
    )?;
    let all: Vec<String> = info.counts.iter().map(counted).collect();
    output.filled_line("holds: {list}", &[&all.join(", ")])?;
    let frames = |count: u64| counted_in(count, "frames", language);
    output.filled_line(
        "movement: {hours} hours, {frames}",
        &[&format_args!("{:.2}", info.motion_hours), &frames(info.motion_frames)],
    )?;
    if let Some(it) = info.amounts.get("markers") {
        output.filled_line(
            "markers: {hours} hours, {frames}",
            &[&format_args!("{:.2}", it.hours), &frames(it.frames)],
        )?;
    }
    if let Some(it) = info.amounts.get("curves") {
        output.filled_line(
            "faces and other curves: {hours} hours, {frames}",
            &[&format_args!("{:.2}", it.hours), &frames(it.frames)],
        )?;
    }
    output.filled_line("recordings: {list}", &[&counts(&info.recordings)])?;
    output.filled_line("tracks: {list}", &[&counts(&info.tracks)])?;
    output.filled_line("tokens: {list}", &[&counts(&info.tokens)])?;
    output.filled_line("tiers: {list}", &[&counts(&info.tiers)])?;
    for signer in &info.signers {
        let hand = signer.handedness.as_deref().unwrap_or("handedness not known");
        output.filled_line(
            "signer {name}: {hand}, {n}",
            &[
                &signer.name,
                &output.translate_message(hand),
                &counted_in(signer.recordings, "recordings", language),
            ],
        )?;
    }
    let named: Vec<String> = info
        .inventories
        .iter()
        .map(|inventory| format!("{} ({})", inventory.id, inventory.values))
        .collect();
    output.filled_line("inventories: {list}", &[&named.join(", ")])?;
    if !info.attributes.is_empty() {
        let one = |attribute: &AttributeInfo| match (attribute.least, attribute.greatest) {
            (Some(least), Some(greatest)) => {
                format!("{} ({}, {least} to {greatest})", attribute.name, attribute.entries)
            }
            _ => format!("{} ({})", attribute.name, attribute.entries),
        };
        let named: Vec<String> = info.attributes.iter().map(one).collect();
        output.filled_line("attributes of signs: {list}", &[&named.join(", ")])?;
    }
    if let Some(last) = &info.last_operation {
        let what = match language {
            InterfaceLanguage::English => format!("{} {}", last.name, last.summary),
            InterfaceLanguage::French | InterfaceLanguage::Other(_) => operation_sentence(&last.effect, language),
        };
        let (at, who) = (&last.at, &last.author);
        output.filled_line("last change: {at} by {who}: {what}", &[&at, &who, &what])?;
    }
    Ok(())
}
