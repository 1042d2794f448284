//! `chereme face`: shows and fits captured faces, proposes annotations from them, and lists the face systems.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{Address, Corpus, FaceFinding, FaceSystem, Progress, Step};
use serde_json::json;

use crate::args::Cli;
use crate::output::{Bar, Output};

/// Show a captured face in the program's own numbers, or list the supported face systems
///
/// Captured channels stay as their file has them. The program derives its own numbers of a face from them, or estimates
/// them from the points of a face on film (.pose). Without a recording the command lists the face systems (ARKit,
/// MediaPipe, OpenFace, MPEG-4, SiGML), and with --system the mapping of one system and its losses.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme face mine.chereme                       (the systems)
  chereme face mine.chereme --system arkit        (its channels, formulas and losses)
  chereme face mine.chereme recording:3           (the face of a recording)
  chereme face mine.chereme recording:3 --propose --store   (brows, blinks, gaze, mouth, shakes and nods as tiers)
  chereme face mine.chereme recording:4 --fit --store       (weights for this signer, from a range of motion)
  chereme render mine.chereme recording:3 --to face.gif --face")]
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// The recording, or a token in it
    recording: Option<String>,
    /// Propose annotations of brows, lids, gaze, mouth and head, each with its confidence and the rule that found it
    #[arg(long, requires = "recording", group = "finds")]
    propose: bool,
    /// Fit the weights of the mapping to the signer, from a take in which each part of the face moves to its extremes
    #[arg(long, requires = "recording", group = "finds")]
    fit: bool,
    /// Store the result: proposals as tiers such as "nonmanual.brows (proposed)", fitted weights for every face of the
    /// signer; `undo` takes it back
    #[arg(long, requires = "finds")]
    store: bool,
    /// Show one face system: arkit, mediapipe, openface, fap, mesh, sigml or house (the program's own)
    #[arg(long, conflicts_with = "recording")]
    system: Option<String>,
}

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let mut corpus = cli.open(&args.corpus)?;
    let Some(recording) = &args.recording else {
        return systems(args.system.as_deref(), output);
    };
    if args.fit {
        return fit(&mut corpus, &recording.parse()?, args.store, output);
    }
    if args.propose {
        return propose(&mut corpus, &recording.parse()?, args.store, output);
    }
    let face = corpus.face(&recording.parse()?)?;
    output.filled_line(
        "{recording}: {n} frames of {system} in the track {name}",
        &[
            &face.recording,
            &face.frames,
            &face.system,
            &format_args!("{:?}", face.track),
        ],
    )?;
    let number = |value: Option<f64>| value.map_or("unknown".to_owned(), |it| format!("{it:.3}"));
    let rows: Vec<Vec<String>> = face
        .numbers
        .iter()
        .map(|it| {
            vec![
                it.name.clone(),
                number(it.least),
                number(it.mean),
                number(it.most),
            ]
        })
        .collect();
    output.table(&["number", "least", "mean", "most"], &rows)?;
    if let Some(on) = &face.fitted_on {
        output.filled_line("the weights were fitted on {on}", &[&on])?;
    }
    if face.bridged > 0 {
        output.filled_line("frames with bridged gaps: {n}", &[&face.bridged])?;
    }
    findings(&face.findings, output)?;
    output.document(face)
}

fn propose(corpus: &mut Corpus, address: &Address, store: bool, output: &mut Output) -> Result<()> {
    let mut bar = Bar::new();
    let mut hear = |step: Step<'_>| bar.show(step);
    let found = corpus.propose_nonmanuals(address, store, &mut Progress::new(&mut hear))?;
    drop(bar);
    let seconds = |micros: i64| format!("{:.3}", micros as f64 / 1e6);
    let rows: Vec<Vec<String>> = found
        .proposals
        .iter()
        .map(|it| {
            let confidence = format!("{:.2}", it.confidence);
            let (start, end) = (seconds(it.start_us), seconds(it.end_us));
            vec![
                it.tier.clone(),
                start,
                end,
                it.value.clone(),
                confidence,
                output.spoken(&it.why),
            ]
        })
        .collect();
    output.table(
        &["tier", "start", "end", "value", "confidence", "rule"],
        &rows,
    )?;
    if store {
        output.filled_line("{n} annotations written", &[&found.written])?;
    }
    output.document(found)
}

fn fit(corpus: &mut Corpus, address: &Address, store: bool, output: &mut Output) -> Result<()> {
    let fit = corpus.fit_face(address, store)?;
    let whose = fit.signer.as_deref().unwrap_or(&fit.recording);
    output.filled_line(
        "{system} of {whose}, fitted on {n} frames of {recording}",
        &[&fit.system, &whose, &fit.frames, &fit.recording],
    )?;
    let factor = |it: f64| match it == 1.0 {
        true => "-".to_owned(),
        false => format!("{it:.2}"),
    };
    let rows: Vec<Vec<String>> = fit
        .numbers
        .iter()
        .map(|it| {
            let rest = format!("{:.3}", it.rest);
            let (up, down) = (factor(it.up), factor(it.down));
            vec![it.name.clone(), rest, up, down, it.formula.clone()]
        })
        .collect();
    let titles = ["number", "rest", "times above", "times below", "weights"];
    output.table(&titles, &rows)?;
    findings(&fit.findings, output)?;
    if fit.stored {
        output.filled_line(
            "stored: from now on these weights apply to all faces of {whose}",
            &[&whose],
        )?;
    }
    output.document(fit)
}

fn findings(all: &[FaceFinding], output: &mut Output) -> Result<()> {
    for it in all {
        let remedy = it.remedy.as_ref().map_or(String::new(), |it| {
            format!(" ({})", output.spoken(it.text()))
        });
        output.line(format!("- {}{remedy}", output.spoken(&it.message)))?;
    }
    Ok(())
}

fn systems(named: Option<&str>, output: &mut Output) -> Result<()> {
    let Some(id) = named else {
        let rows: Vec<Vec<String>> = FaceSystem::all()
            .iter()
            .map(|it| {
                let numbers = if it.expressions {
                    "by code".to_owned()
                } else {
                    it.house.len().to_string()
                };
                vec![
                    it.id.clone(),
                    it.name.clone(),
                    it.channels.len().to_string(),
                    numbers,
                ]
            })
            .collect();
        output.table(&["system", "name", "channels", "numbers of a face"], &rows)?;
        return output.document(json!({ "systems": FaceSystem::all() }));
    };
    let Some(system) = FaceSystem::named(id) else {
        let known: Vec<&str> = FaceSystem::all().iter().map(|it| it.id.as_str()).collect();
        let error = chereme_corpus::Error::wrong(format!("{id:?} is no face system"));
        return Err(error
            .at(id)
            .advise(format!("the systems are: {}", known.join(", ")))
            .into());
    };
    output.line(format!("{}: {}", system.name, system.description))?;
    let formulas = system.house.iter().chain(&system.head).chain(&system.place);
    let rows: Vec<Vec<String>> = formulas
        .map(|(name, formula)| vec![name.clone(), formula.clone()])
        .collect();
    output.table(&["number", "formula"], &rows)?;
    if !system.unknown.is_empty() {
        output.filled_line("unknown: {names}", &[&system.unknown.join(", ")])?;
    }
    for loss in &system.loses {
        output.line(format!("- {} ({})", loss.says, loss.channels.join(", ")))?;
    }
    output.document(system)
}
