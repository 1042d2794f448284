//! `chereme list` and `chereme info`: the rows of a corpus, filtered and sorted, and an overview.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::words::history::operation_sentence;
use chereme_corpus::words::{Language, counted_in};
use chereme_corpus::{AttributeInfo, Info, ListFilter, ListKind, cell_text};

use crate::args::Cli;
use crate::output::Output;
use crate::words::kinds;

/// List rows: recordings, tracks, signs, tokens, tiers, annotations, inventories, values, signers, searches, studies, operations
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// What to list
    #[arg(value_parser = kind)]
    kind: ListKind,
    /// Only rows with these values, such as gloss=BO*, start_us=>=500000, recording=recording:3, parent=none
    #[arg(long = "where", value_name = "COLUMN=PATTERN", value_parser = pair)]
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

fn kind(text: &str) -> Result<ListKind, String> {
    text.parse().map_err(|error: chereme_corpus::Error| {
        format!("{error}; {}", error.remedy().unwrap_or_default())
    })
}

fn pair(text: &str) -> Result<(String, String), String> {
    let (column, pattern) = text
        .split_once('=')
        .ok_or("write COLUMN=PATTERN, such as gloss=BO*")?;
    Ok((column.to_owned(), pattern.to_owned()))
}

pub(super) fn list(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let corpus = cli.open(&args.corpus)?;
    let mut columns = args.filter.clone();
    if let Some(name) = &args.inventory {
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
    let found = corpus.list(args.kind, &filter)?;
    let columns = args.kind.columns();
    let rows: Vec<Vec<String>> = found
        .rows
        .iter()
        .map(|row| {
            columns
                .iter()
                .map(|name| row.get(*name).map(cell_text).unwrap_or_default())
                .collect()
        })
        .collect();
    output.columns(&columns, &rows)?;
    let shown = if (rows.len() as u64) < found.total {
        format!(", {} shown", rows.len())
    } else {
        String::new()
    };
    let count = output.counted(found.total, args.kind.name());
    output.line(format!("{count}{shown}"))?;
    output.document(found)
}

/// Show an overview of a corpus
#[derive(Debug, clap::Args)]
pub(crate) struct InfoArgs {
    /// The corpus
    corpus: PathBuf,
}

pub(super) fn info(cli: &Cli, args: &InfoArgs, output: &mut Output) -> Result<()> {
    let info = cli.open(&args.corpus)?.info()?;
    print(&info, output)?;
    output.document(info)
}

fn print(info: &Info, output: &mut Output) -> Result<()> {
    let language = output.language();
    let counts = |map: &std::collections::BTreeMap<String, u64>| {
        map.iter()
            .map(|(what, count)| kinds::counted(*count, what, language))
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
        &[
            &format_args!("{:.2}", info.motion_hours),
            &frames(info.motion_frames),
        ],
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
        let hand = signer
            .handedness
            .as_deref()
            .unwrap_or("handedness not known");
        output.filled_line(
            "signer {name}: {hand}, {n}",
            &[
                &signer.name,
                &output.spoken(hand),
                &counted_in(signer.recordings, "recordings", language),
            ],
        )?;
    }
    let named: Vec<String> = info
        .inventories
        .iter()
        .map(|it| format!("{} ({})", it.id, it.values))
        .collect();
    output.filled_line("inventories: {list}", &[&named.join(", ")])?;
    if !info.attributes.is_empty() {
        let one = |it: &AttributeInfo| match (it.least, it.greatest) {
            (Some(least), Some(greatest)) => {
                format!("{} ({}, {least} to {greatest})", it.name, it.entries)
            }
            _ => format!("{} ({})", it.name, it.entries),
        };
        let named: Vec<String> = info.attributes.iter().map(one).collect();
        output.filled_line("attributes of signs: {list}", &[&named.join(", ")])?;
    }
    if let Some(last) = &info.last_operation {
        let what = match language {
            Language::English => format!("{} {}", last.name, last.summary),
            Language::French | Language::Other(_) => operation_sentence(&last.effect, language),
        };
        let (at, who) = (&last.at, &last.author);
        output.filled_line("last change: {at} by {who}: {what}", &[&at, &who, &what])?;
    }
    Ok(())
}
