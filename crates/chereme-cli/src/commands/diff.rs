//! `chereme diff`: compares two annotation files or two recordings by meaning.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::Result;
use chereme_corpus::words::merge_words as words;
use chereme_corpus::{CompareSide, TranscriptDifference};

use crate::args::CommandLine;
use crate::output::CommandOutput;
use crate::streams;

/// Compare two annotation files, or two recordings, by meaning
///
/// Lists annotations that were added, removed, moved or given another value, and changes of tiers. Time slots, the
/// order of elements and the spelling of a file make no difference; times within a millisecond are equal.
/// Annotations are matched by their ids if both files descend from the same file, otherwise by tier and time. Both
/// sides are annotation files or templates that `import` reads (- is standard input), or the first argument is a
/// corpus, and the sides are files or addresses such as recording:3. With --json it prints {"added", "removed",
/// "moved", "revalued", "tiers", "document"}. The exit code is 0 after a comparison, 1 if the comparison failed or,
/// with --exit-code, if there are differences, and 2 on wrong usage.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme diff mine.eaf theirs.eaf
  chereme diff mine.chereme recording:1 recording:2
  chereme diff mine.chereme recording:1 theirs.eaf --json")]
pub(crate) struct DiffArgs {
    /// Two files, or a corpus and then two recordings or files
    #[arg(required = true, num_args = 2..=3, value_name = "SIDE")]
    sides: Vec<PathBuf>,
    /// Exit with 1 if there are differences
    #[arg(long)]
    exit_code: bool,
}

pub(super) fn run(cli: &CommandLine, args: &DiffArgs, output: &mut CommandOutput) -> Result<ExitCode> {
    let difference = match args.sides.as_slice() {
        [a, b] => file_compare_side(a)?.diff_annotation_files(&file_compare_side(b)?)?,
        [corpus, a, b] => cli
            .open_cli_corpus(corpus)?
            .diff_compare_sides(&parse_compare_side(a)?, &parse_compare_side(b)?)?,
        _ => TranscriptDifference::default(),
    };
    print_difference(&difference, output)?;
    let differ = !difference.is_empty();
    output.set_json_document(difference)?;
    Ok(ExitCode::from(u8::from(args.exit_code && differ)))
}

/// Returns a side of the comparison: a file with its bytes, or an address.
fn parse_compare_side(path: &Path) -> Result<CompareSide> {
    if streams::is_standard(path) || path.is_file() {
        return file_compare_side(path);
    }
    let text = path.to_string_lossy();
    Ok(CompareSide::Recording(text.parse()?))
}

pub(super) fn file_compare_side(path: &Path) -> Result<CompareSide> {
    Ok(CompareSide::File {
        name: path.display().to_string(),
        bytes: streams::read_file_or_stdin(path)?,
    })
}

/// Prints one line for each difference.
pub(super) fn print_difference(found: &TranscriptDifference, output: &mut CommandOutput) -> Result<()> {
    let time = |us: i64| format!("{:.3}", us as f64 / 1e6);
    let span = |from: i64, to: i64| format!("{}–{}", time(from), time(to));
    for it in &found.tiers {
        let fields: Vec<String> = it
            .fields
            .iter()
            .map(|(name, [from, to])| format!("{name} {from:?} → {to:?}"))
            .collect();
        let text = match it.change {
            "added" => words::TIER_ADDED,
            "removed" => words::TIER_REMOVED,
            "renamed" => words::TIER_RENAMED,
            _ => words::TIER_CHANGED,
        };
        let to = format!("{:?}", it.to.as_deref().unwrap_or_default());
        let tier = format!("{:?}", it.tier);
        let fields = fields.join(", ");
        let parts: [(&str, &dyn std::fmt::Display); 3] = [("tier", &tier), ("to", &to), ("what", &fields)];
        output.text_line(text, &parts)?;
    }
    for it in &found.removed {
        let times = span(it.start_us, it.end_us);
        output.line_as_is(&format!("- {} {times} {:?}", it.tier, it.value))?;
    }
    for it in &found.added {
        let times = span(it.start_us, it.end_us);
        output.line_as_is(&format!("+ {} {times} {:?}", it.tier, it.value))?;
    }
    for it in &found.moved {
        let (from, to) = (span(it.from[0], it.from[1]), span(it.to[0], it.to[1]));
        let tier = it
            .to_tier
            .as_ref()
            .map(|detail| format!(" {detail}"))
            .unwrap_or_default();
        output.line_as_is(&format!("> {} {from} → {to}{tier} {:?}", it.tier, it.value))?;
    }
    for it in &found.revalued {
        let times = span(it.start_us, it.end_us);
        output.line_as_is(&format!("~ {} {times} {:?} → {:?}", it.tier, it.from, it.to))?;
    }
    for it in &found.document {
        output.write_output_line(it)?;
    }
    let line = format!(
        "{} +, {} -, {} >, {} ~, {}",
        found.added.len(),
        found.removed.len(),
        found.moved.len(),
        found.revalued.len(),
        output.format_counted_noun(found.tiers.len() as u64, "tiers")
    );
    output.line_as_is(&line)
}
