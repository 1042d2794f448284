//! `chereme face`: shows and fits captured faces, proposes annotations from them, and lists the face systems.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{Corpus, CorpusAddress, FaceFinding, FaceSystem};
use serde_json::json;

use crate::args::CommandLine;
use crate::output::{CommandOutput, with_progress_bar};

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
pub(crate) struct FaceArgs {
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

pub(super) fn run(cli: &CommandLine, args: &FaceArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let Some(recording) = &args.recording else {
        return systems(args.system.as_deref(), output);
    };
    if args.fit {
        return fit_recorded_face(&mut corpus, &recording.parse()?, args.store, output);
    }
    if args.propose {
        return print_face_proposals(&mut corpus, &recording.parse()?, args.store, output);
    }
    let face = corpus.report_captured_face(&recording.parse()?)?;
    output.filled_line(
        "{recording}: {n} frames of {system} in the track {name}",
        &[
            &face.recording,
            &face.frames,
            &face.system,
            &format_args!("{:?}", face.track),
        ],
    )?;
    let number = |value: Option<f64>| value.map_or("unknown".to_owned(), |decimal| format!("{decimal:.3}"));
    output.write_item_table(
        &face.numbers,
        &[
            ("number", &|entry| entry.name.clone()),
            ("least", &|entry| number(entry.least)),
            ("mean", &|entry| number(entry.mean)),
            ("most", &|entry| number(entry.most)),
        ],
    )?;
    if let Some(on) = &face.fitted_on {
        output.filled_line("the weights were fitted on {on}", &[&on])?;
    }
    if face.bridged > 0 {
        output.filled_line("frames with bridged gaps: {n}", &[&face.bridged])?;
    }
    print_face_findings(&face.findings, output)?;
    output.set_json_document(face)
}

fn print_face_proposals(
    corpus: &mut Corpus,
    address: &CorpusAddress,
    store: bool,
    output: &mut CommandOutput,
) -> Result<()> {
    let proposals = with_progress_bar(|progress| corpus.propose_nonmanuals(address, store, progress))?;
    let seconds = |micros: i64| format!("{:.3}", micros as f64 / 1e6);
    let rows: Vec<Vec<String>> = proposals
        .proposals
        .iter()
        .map(|proposal| {
            let confidence = format!("{:.2}", proposal.confidence);
            let (start, end) = (seconds(proposal.start_us), seconds(proposal.end_us));
            vec![
                proposal.tier.clone(),
                start,
                end,
                proposal.value.clone(),
                confidence,
                output.translate_message(&proposal.why),
            ]
        })
        .collect();
    output.write_titled_table(&["tier", "start", "end", "value", "confidence", "rule"], &rows)?;
    if store {
        output.filled_line("{n} annotations written", &[&proposals.written])?;
    }
    output.set_json_document(proposals)
}

fn fit_recorded_face(
    corpus: &mut Corpus,
    address: &CorpusAddress,
    store: bool,
    output: &mut CommandOutput,
) -> Result<()> {
    let fit = corpus.fit_face(address, store)?;
    let whose = fit.signer.as_deref().unwrap_or(&fit.recording);
    output.filled_line(
        "{system} of {whose}, fitted on {n} frames of {recording}",
        &[&fit.system, &whose, &fit.frames, &fit.recording],
    )?;
    // A factor of 1 was not fitted: the number never left its rest to that side.
    let factor = |value: f64| match value == 1.0 {
        true => "-".to_owned(),
        false => format!("{value:.2}"),
    };
    output.write_item_table(
        &fit.numbers,
        &[
            ("number", &|entry| entry.name.clone()),
            ("rest", &|entry| format!("{:.3}", entry.rest)),
            ("times above", &|entry| factor(entry.up)),
            ("times below", &|entry| factor(entry.down)),
            ("weights", &|entry| entry.formula.clone()),
        ],
    )?;
    print_face_findings(&fit.findings, output)?;
    if fit.stored {
        output.filled_line(
            "stored: from now on these weights apply to all faces of {whose}",
            &[&whose],
        )?;
    }
    output.set_json_document(fit)
}

fn print_face_findings(all: &[FaceFinding], output: &mut CommandOutput) -> Result<()> {
    for it in all {
        let remedy = it.remedy.as_ref().map_or(String::new(), |remedy| {
            format!(" ({})", output.translate_message(remedy.remedy_text()))
        });
        output.write_output_line(format!("- {}{remedy}", output.translate_message(&it.message)))?;
    }
    Ok(())
}

fn systems(named: Option<&str>, output: &mut CommandOutput) -> Result<()> {
    let Some(id) = named else {
        output.write_item_table(
            FaceSystem::all_face_systems(),
            &[
                ("system", &|system| system.id.clone()),
                ("name", &|system| system.name.clone()),
                ("channels", &|system| system.channels.len().to_string()),
                ("numbers of a face", &|system| match system.expressions {
                    true => "by code".to_owned(),
                    false => system.house.len().to_string(),
                }),
            ],
        )?;
        return output.set_json_document(json!({ "systems": FaceSystem::all_face_systems() }));
    };
    let Some(system) = FaceSystem::find_face_system(id) else {
        let known_ids: Vec<&str> = FaceSystem::all_face_systems()
            .iter()
            .map(|system| system.id.as_str())
            .collect();
        let error = chereme_corpus::CorpusError::from_wrong_message(format!("{id:?} is no face system"));
        return Err(error
            .with_error_place(id)
            .with_advice(format!("the systems are: {}", known_ids.join(", ")))
            .into());
    };
    output.write_output_line(format!("{}: {}", system.name, system.description))?;
    let formulas = system.house.iter().chain(&system.head).chain(&system.place);
    let rows: Vec<Vec<String>> = formulas
        .map(|(name, formula)| vec![name.clone(), formula.clone()])
        .collect();
    output.write_titled_table(&["number", "formula"], &rows)?;
    if !system.unknown.is_empty() {
        output.filled_line("unknown: {names}", &[&system.unknown.join(", ")])?;
    }
    for loss in &system.loses {
        output.write_output_line(format!("- {} ({})", loss.says, loss.channels.join(", ")))?;
    }
    output.set_json_document(system)
}
