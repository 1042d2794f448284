//! `chereme fit`: fits a skeleton to the markers of a recording.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{FitOptions, Name};

use super::track::recording;
use crate::args::Cli;
use crate::output::Output;
use crate::words::Words;

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
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// The recording with markers, such as recording:3
    #[arg(value_parser = recording)]
    recording: Name,
    /// The recording whose skeleton is fitted; without it the program's own body
    #[arg(long, value_name = "RECORDING", value_parser = recording)]
    to: Option<Name>,
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

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let mut corpus = cli.open(&args.corpus)?;
    let options = FitOptions {
        track: args.track.as_deref(),
        to: args.to.as_ref(),
        subject: args.subject.as_deref(),
        dry_run: args.dry_run,
    };
    let report = corpus.fit_markers(&args.recording, &options)?;
    let rows: Vec<Vec<String>> = report
        .residuals
        .iter()
        .map(|it| {
            vec![
                it.marker.clone(),
                it.joint.clone(),
                format!("{:.1}", it.median_mm),
                format!("{:.1}", it.most_mm),
                format!("{:.0} %", it.seen * 100.0),
            ]
        })
        .collect();
    output.table(&["marker", "joint", "median_mm", "most_mm", "seen"], &rows)?;
    output.line(format!(
        "{} frames; the skeleton scaled by {:.3}; median distance of the markers {:.1} mm",
        report.frames, report.scale, report.median_mm
    ))?;
    if !report.unused.is_empty() {
        output.line(format!("not used: {}", report.unused.join(", ")))?;
    }
    for finding in &report.findings {
        output.warn(finding)?;
    }
    match &report.track {
        Some(track) => output.line(format!("stored as the track {track:?}"))?,
        None => output.line("nothing was stored")?,
    }
    output.document(report)
}

/// The French words of the command.
pub(super) const WORDS: Words = Words {
    help: &[
        (
            "Fit a skeleton to the markers of a recording, and report the distance of every marker",
            "Ajuster un squelette aux marqueurs d’un enregistrement, et donner la distance de chaque marqueur",
        ),
        (
            "The recording with markers, such as recording:3",
            "L’enregistrement des marqueurs, comme recording:3",
        ),
        (
            "The recording whose skeleton is fitted; without it the program's own body",
            "L’enregistrement dont le squelette est ajusté ; sinon le corps du programme",
        ),
        (
            "The track of markers, if there are several",
            "La piste de marqueurs, s’il y en a plusieurs",
        ),
        (
            "The person whose markers are used, if they are those of several people: Anna for Anna:LSHO",
            "La personne dont les marqueurs servent, s’ils sont ceux de plusieurs personnes : Anna pour Anna:LSHO",
        ),
        (
            "Report the distances and store nothing",
            "Donner les distances sans rien enregistrer",
        ),
        (
            "The movement becomes a track of the recording, and the distances of the markers in every frame become a track of curves; the markers stay as they are. The program knows the labels of three sets of markers: Plug-in Gait, the 41 markers of CMU, and Helen Hayes.",
            "Le mouvement devient une piste de l’enregistrement, et les distances des marqueurs dans chaque image une piste de courbes ; les marqueurs restent tels quels. Le programme connaît les étiquettes de trois jeux de marqueurs : Plug-in Gait, les 41 marqueurs de CMU, et Helen Hayes.",
        ),
    ],
    lines: &[
        (
            "stored as the track {name}",
            "enregistré comme la piste {name}",
        ),
        (
            "{n} frames; the skeleton scaled by {scale}; median distance of the markers {mm} mm",
            "{n} images ; squelette à l’échelle {scale} ; distance médiane des marqueurs {mm} mm",
        ),
    ],
    titles: &[
        ("joint", "articulation"),
        ("marker", "marqueur"),
        ("median_mm", "médiane_mm"),
        ("most_mm", "maximum_mm"),
        ("seen", "vu"),
    ],
};
