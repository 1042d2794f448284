//! `chereme propose`: proposes values of components and detections from movement, and accepts proposals.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{
    Address, DETECTORS, DetectOptions, Detector, Progress, ProposeOptions, ProposeScope, Proposed,
    Step,
};
use chereme_sign::Component;
use clap::builder::PossibleValue;

use crate::args::Cli;
use crate::output::{Bar, Output};
use crate::words::Words;

/// Propose values of a component from movement, for tokens without a value of it; or run a detector on recordings
///
/// The movement of each token is transcribed, and the values are written on separate tiers, such as "configuration
/// dominant (proposed)", as annotations of a detector. They never mix with a person's codings. A call is one operation,
/// which `undo` takes back. Ctrl-C stops it and leaves the corpus as it was.
///
/// With --detector no transcription runs: the detector examines whole recordings, and its detections are written on
/// tiers such as "movement.phase right (proposed)", where they replace earlier ones that nobody has changed.
///
/// `--json` gives "tokens" and "annotations", the numbers of those that were written, "unread", the number of tokens
/// whose movement could not be transcribed, and "recordings", the names of those with new annotations. With --detector
/// it gives "detector", "annotations", "recordings", "unobserved", the number of recordings without the part that the
/// detector examines, and "found", the proposals of each recording with tier, times, value, confidence and evidence.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme propose mine.chereme configuration
  chereme propose mine.chereme --for recording:3
  chereme propose mine.chereme --detector strokes --for recording:3
  chereme propose mine.chereme --accept 41 42
  chereme search mine.chereme configuration=U    (finds proposed codings, too)
  chereme undo mine.chereme                      (takes all of them back)")]
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// The component: configuration (or handshape), placement, movement or orientation; without it all four
    component: Option<Component>,
    /// Only for the tokens of this recording, or for this token
    #[arg(long = "for", value_name = "ADDRESS")]
    only: Option<String>,
    /// Run this detector on every recording, or on that of --for
    #[arg(long, value_name = "NAME", value_parser = detectors(), conflicts_with = "component")]
    detector: Option<String>,
    /// Accept these proposals, by the numbers of their annotations, as codings of your own
    #[arg(long, value_name = "NUMBER", conflicts_with_all = ["component", "only", "detector"], num_args = 1..)]
    accept: Vec<i64>,
}

/// Returns the names of all detectors, each with the annotations that it finds.
fn detectors() -> Vec<PossibleValue> {
    let named = |it: &&dyn Detector| PossibleValue::new(it.name()).help(it.description().finds.en);
    DETECTORS.iter().map(named).collect()
}

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let mut corpus = cli.open(&args.corpus)?;
    let mut bar = Bar::new();
    let mut hear = |step: Step<'_>| bar.show(step);
    let mut progress = Progress::new(&mut hear);
    if !args.accept.is_empty() {
        let report = corpus.accept_proposals(&args.accept, &mut progress)?;
        drop(bar);
        output.line(format!(
            "{} accepted",
            output.counted(report.added, "annotations")
        ))?;
        return output.document(report);
    }
    let scope = match &args.only {
        None => ProposeScope::All,
        Some(only) => corpus.propose_scope(&only.parse::<Address>()?)?,
    };
    if let Some(detector) = &args.detector {
        let options = DetectOptions {
            detector: detector.clone(),
            scope,
        };
        let detected = corpus.detect(&options, &mut progress)?;
        drop(bar);
        output.line(format!(
            "proposed: {} in {}",
            output.counted(detected.annotations, "annotations"),
            output.counted(detected.recordings.len() as u64, "recordings"),
        ))?;
        if detected.unobserved > 0 {
            let unobserved = output.counted(detected.unobserved, "recordings");
            output.line(format!("nothing to examine in {unobserved}"))?;
        }
        return output.document(detected);
    }
    let options = ProposeOptions {
        components: match args.component {
            Some(component) => vec![component],
            None => Proposed::COMPONENTS.to_vec(),
        },
        scope,
    };
    let proposed = corpus.propose(&options, &mut progress)?;
    drop(bar);
    output.line(format!(
        "{} in {}, for {}; {} could not be read from movement",
        output.counted(proposed.annotations, "annotations"),
        output.counted(proposed.recordings.len() as u64, "recordings"),
        output.counted(proposed.tokens, "tokens"),
        output.counted(proposed.unread, "tokens"),
    ))?;
    for finding in &proposed.findings {
        output.warn(finding)?;
    }
    output.document(proposed)
}

/// The French words of the command.
pub(super) const WORDS: Words = Words {
    help: &[
        (
            "Propose values of a component from movement, for tokens without a value of it; or run a detector on recordings",
            "Proposer d’après le mouvement des valeurs d’un composant, pour les occurrences qui n’en ont pas ; ou lancer un détecteur sur des enregistrements",
        ),
        (
            "Run this detector on every recording, or on that of --for",
            "Lancer ce détecteur sur tous les enregistrements, ou sur celui de --for",
        ),
        (
            "The component: configuration (or handshape), placement, movement or orientation; without it all four",
            "Le composant : configuration (ou handshape), placement, movement ou orientation ; sinon les quatre",
        ),
        (
            "Only for the tokens of this recording, or for this token",
            "Seulement pour les occurrences de cet enregistrement, ou pour cette occurrence",
        ),
        (
            "Accept these proposals, by the numbers of their annotations, as codings of your own",
            "Accepter ces propositions, par les numéros de leurs annotations, comme vos propres codages",
        ),
        (
            "The movement of each token is transcribed, and the values are written on separate tiers, such as \"configuration dominant (proposed)\", as annotations of a detector. They never mix with a person's codings. A call is one operation, which `undo` takes back. Ctrl-C stops it and leaves the corpus as it was.",
            "Le mouvement de chaque occurrence est transcrit, et les valeurs sont écrites sur des acteurs à part, comme « configuration dominant (proposed) », en annotations d’un détecteur. Elles ne se mêlent jamais aux codages d’une personne. Un appel est une opération, que `undo` annule. Ctrl-C l’arrête et laisse le corpus tel qu’il était.",
        ),
        (
            "With --detector no transcription runs: the detector examines whole recordings, and its detections are written on tiers such as \"movement.phase right (proposed)\", where they replace earlier ones that nobody has changed.",
            "Avec --detector rien n’est transcrit : le détecteur examine des enregistrements entiers, et ce qu’il trouve est écrit sur des acteurs comme « movement.phase right (proposed) », à la place de ses propositions d’avant que personne n’a modifiées.",
        ),
        (
            "`--json` gives \"tokens\" and \"annotations\", the numbers of those that were written, \"unread\", the number of tokens whose movement could not be transcribed, and \"recordings\", the names of those with new annotations. With --detector it gives \"detector\", \"annotations\", \"recordings\", \"unobserved\", the number of recordings without the part that the detector examines, and \"found\", the proposals of each recording with tier, times, value, confidence and evidence.",
            "`--json` donne \"tokens\" et \"annotations\", les nombres de celles qui ont été écrites, \"unread\", le nombre d’occurrences dont le mouvement n’a pas pu être transcrit, et \"recordings\", les noms de ceux qui ont de nouvelles annotations. Avec --detector il donne \"detector\", \"annotations\", \"recordings\", \"unobserved\", le nombre d’enregistrements sans la partie que le détecteur examine, et \"found\", les propositions de chaque enregistrement avec acteur, temps, valeur, confiance et indices.",
        ),
        (
            "(finds proposed codings, too)",
            "(trouve aussi les codages proposés)",
        ),
        ("(takes all of them back)", "(les retire tous)"),
    ],
    lines: &[
        ("{n} accepted", "accepté : {n}"),
        (
            "proposed: {annotations} in {recordings}",
            "proposé : {annotations} dans {recordings}",
        ),
        (
            "nothing to examine in {recordings}",
            "rien à examiner dans {recordings}",
        ),
        (
            "{annotations} in {recordings}, for {tokens}; {unread} could not be read from movement",
            "{annotations} dans {recordings}, pour {tokens} ; illisible dans le mouvement : {unread}",
        ),
    ],
    titles: &[],
};
