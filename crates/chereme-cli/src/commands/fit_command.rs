//! `chereme fit`: fits a skeleton to the markers of a recording.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{FitOptions, RowName};

use super::track_command::parse_recording_address;
use crate::args::CommandLine;
use crate::output::CommandOutput;

/// Fit a skeleton to the markers of a recording, and report the distance of every marker
///
/// The movement becomes a track of the recording, and the distances of the markers in every frame become a track of
/// curves; the markers stay as they are. The program knows the labels of three sets of markers: Plug-in Gait, the 41
/// markers of CMU, and Helen Hayes.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme fit mine.chereme recording:3
  chereme fit mine.chereme recording:3 --to recording:1
  chereme fit mine.chereme recording:3 --subject Anna
  chereme fit mine.chereme recording:3 --dry-run --json")]
pub(crate) struct FitArgs {
    /// The corpus
    corpus: PathBuf,
    /// The recording with markers, such as recording:3
    #[arg(value_parser = parse_recording_address)]
    recording: RowName,
    /// The recording whose skeleton is fitted; without it the program's own body
    #[arg(long, value_name = "RECORDING", value_parser = parse_recording_address)]
    to: Option<RowName>,
    /// The track of markers, if there are several
    #[arg(long, value_name = "NAME")]
    track: Option<String>,
    /// The person whose markers are used, if they are those of several people: Anna for Anna:LSHO
    #[arg(long, value_name = "NAME")]
    subject: Option<String>,
    /// Report the distances and store nothing
    #[arg(long)]
    dry_run: bool,
}

pub(super) fn run(cli: &CommandLine, args: &FitArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let options = FitOptions {
        track: args.track.as_deref(),
        to: args.to.as_ref(),
        subject: args.subject.as_deref(),
        dry_run: args.dry_run,
    };
    let report = corpus.fit_markers(&args.recording, &options)?;
    output.write_item_table(
        &report.residuals,
        &[
            ("marker", &|entry| entry.marker.clone()),
            ("joint", &|entry| entry.joint.clone()),
            ("median_mm", &|entry| format!("{:.1}", entry.median_mm)),
            ("most_mm", &|entry| format!("{:.1}", entry.most_mm)),
            ("seen", &|entry| format!("{:.0} %", entry.seen * 100.0)),
        ],
    )?;
    output.filled_line(
        "{n} frames; the skeleton scaled by {scale}; median distance of the markers {mm} mm",
        &[
            &report.frames,
            &format_args!("{:.3}", report.scale),
            &format_args!("{:.1}", report.median_mm),
        ],
    )?;
    if !report.unused.is_empty() {
        output.filled_line("not used: {names}", &[&report.unused.join(", ")])?;
    }
    output.write_warnings(&report.findings)?;
    // A dry run reports everything but the stored track.
    match &report.track {
        Some(track) => output.filled_line("stored as the track {name}", &[&format_args!("{:?}", track)])?,
        None => output.write_output_line("nothing was stored")?,
    }
    output.set_json_document(report)
}
