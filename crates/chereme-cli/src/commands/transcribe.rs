//! `chereme transcribe`: writes the movement of a sign as HamNoSys.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{Address, Progress, Step, TranscribedFeature};

use crate::args::Cli;
use crate::output::{Bar, Output};
use crate::words::Words;

/// Transcribe a captured or generated sign in HamNoSys, with the residual of each feature
///
/// The residual is the distance of the movement from its transcription, and the runner-up is the second-best reading.
/// Only a HamNoSys font shows the characters; their names are printed below them, `--names` prints nothing else, and
/// `render TOKEN --to it.svg` draws a stored notation.
///
/// If a sign was generated from notation alone, the program animates its transcription as a check. If its hands move
/// differently, it tries similar movements and other postures. Values that it replaces have two residuals in cm: how far
/// the hands are from the observed ones with the new value and with the old one, on average. It also reads the acts of
/// trunk, head and shoulders, such as body.TF or head.SR in the codes of SiGML. That takes up to a minute; Ctrl-C stops it.
///
/// `--json` gives "gloss", "token", "recording", "start_us", "end_us", the whole as "hamnosys" and "symbols" and as the
/// tree "sign"; "stages", the posture at the beginning and each action with "action", "hand", "start_us", "end_us",
/// "hamnosys", "symbols"; "features", each with "feature", "hand", "action" (null for the posture), "at_us",
/// "start_us", "end_us", "value", "hamnosys", "symbols", "residual", "unit" (deg, cm or share) and "runner_up"
/// ("value", "hamnosys", "symbols", "residual"; null if there is no second reading); "nonmanual", the tiers with acts
/// that were read; "findings". Times are microseconds from the start of the recording.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme transcribe mine.chereme ESCARGOT
  chereme transcribe mine.chereme token:41 --names
  chereme transcribe mine.chereme token:41 --store   (then: export mine.chereme token:41 --to it.sigml)")]
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// The movement to transcribe: a gloss, token:41, or recording:3 if it is short
    token: String,
    /// Write the names of the symbols in place of the table
    #[arg(long)]
    names: bool,
    /// Store the transcription as the token's notation; `undo` takes it back
    #[arg(long)]
    store: bool,
    /// Replace the notation that the token has already
    #[arg(long, requires = "store")]
    force: bool,
}

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let mut corpus = cli.open(&args.corpus)?;
    let address: Address = args.token.parse()?;
    let mut bar = Bar::new();
    let mut hear = |step: Step<'_>| bar.show(step);
    let progress = &mut Progress::new(&mut hear);
    let written = if args.store {
        corpus.store_transcription(&address, args.force, progress)?
    } else {
        corpus.transcribe(&address, progress)?
    };
    drop(bar);
    if args.names {
        output.line(written.symbols.join(" "))?;
    } else {
        output.line(format!("{}: {}", written.gloss, written.hamnosys))?;
        output.line(written.symbols.join(" "))?;
        let rows: Vec<Vec<String>> = written.features.iter().map(row).collect();
        output.table(
            &[
                "feature",
                "hand",
                "action",
                "seconds",
                "value",
                "residual",
                "runner-up",
            ],
            &rows,
        )?;
        let acts = written.nonmanual.acts().map(|(_, act)| act.name());
        let acts: Vec<String> = acts.collect();
        if !acts.is_empty() {
            output.line(acts.join(" "))?;
        }
        for finding in &written.findings {
            output.line(output.spoken(finding))?;
        }
    }
    output.document(written)
}

fn seconds(micros: i64) -> f64 {
    micros as f64 / 1e6
}

fn row(feature: &TranscribedFeature) -> Vec<String> {
    let residual = |residual: f64| format!("{residual:.1}{}", feature.unit.sign());
    vec![
        feature.feature.name().to_owned(),
        feature
            .hand
            .map_or_else(String::new, |hand| hand.name().to_owned()),
        feature.action.map_or_else(String::new, |n| n.to_string()),
        format!(
            "{:.2}-{:.2}",
            seconds(feature.start_us),
            seconds(feature.end_us)
        ),
        feature.value.value.clone(),
        residual(feature.value.residual),
        feature.runner_up.as_ref().map_or_else(String::new, |next| {
            format!("{}, {}", next.value, residual(next.residual))
        }),
    ]
}

/// The French words of the command.
pub(super) const WORDS: Words = Words {
    help: &[
        (
            "Transcribe a captured or generated sign in HamNoSys, with the residual of each feature",
            "Transcrire un signe capturé ou composé en HamNoSys, avec l’écart de chaque trait",
        ),
        (
            "The movement to transcribe: a gloss, token:41, or recording:3 if it is short",
            "Quoi transcrire : une glose, token:41, ou recording:3 s’il est court",
        ),
        (
            "Write the names of the symbols in place of the table",
            "Écrire les noms des symboles à la place du tableau",
        ),
        (
            "Store the transcription as the token's notation; `undo` takes it back",
            "Enregistrer la transcription comme notation de l’occurrence ; `undo` l’annule",
        ),
        (
            "Replace the notation that the token has already",
            "Remplacer la notation que l’occurrence a déjà",
        ),
        (
            "The residual is the distance of the movement from its transcription, and the runner-up is the second-best reading. Only a HamNoSys font shows the characters; their names are printed below them, `--names` prints nothing else, and `render TOKEN --to it.svg` draws a stored notation.",
            "L’écart est la distance du mouvement à sa transcription, et le second choix est la deuxième meilleure lecture. Seule une police HamNoSys montre les caractères ; leurs noms sont écrits en dessous, `--names` n’écrit rien d’autre, et `render TOKEN --to it.svg` dessine une notation enregistrée.",
        ),
        (
            "If a sign was generated from notation alone, the program animates its transcription as a check. If its hands move differently, it tries similar movements and other postures. Values that it replaces have two residuals in cm: how far the hands are from the observed ones with the new value and with the old one, on average. It also reads the acts of trunk, head and shoulders, such as body.TF or head.SR in the codes of SiGML. That takes up to a minute; Ctrl-C stops it.",
            "Si un signe a été généré d’une notation seule, le programme anime sa transcription pour contrôle. Si les mains bougent autrement, il essaie des mouvements semblables et d’autres postures. Les valeurs qu’il remplace ont deux écarts en cm : la distance moyenne des mains à celles qui ont été observées, avec la nouvelle valeur et avec l’ancienne. Il lit aussi les actes du tronc, de la tête et des épaules, comme body.TF ou head.SR dans les codes de SiGML. Cela prend jusqu’à une minute ; Ctrl-C l’arrête.",
        ),
        (
            "`--json` gives \"gloss\", \"token\", \"recording\", \"start_us\", \"end_us\", the whole as \"hamnosys\" and \"symbols\" and as the tree \"sign\"; \"stages\", the posture at the beginning and each action with \"action\", \"hand\", \"start_us\", \"end_us\", \"hamnosys\", \"symbols\"; \"features\", each with \"feature\", \"hand\", \"action\" (null for the posture), \"at_us\", \"start_us\", \"end_us\", \"value\", \"hamnosys\", \"symbols\", \"residual\", \"unit\" (deg, cm or share) and \"runner_up\" (\"value\", \"hamnosys\", \"symbols\", \"residual\"; null if there is no second reading); \"nonmanual\", the tiers with acts that were read; \"findings\". Times are microseconds from the start of the recording.",
            "`--json` donne \"gloss\", \"token\", \"recording\", \"start_us\", \"end_us\", l’ensemble comme \"hamnosys\" et \"symbols\" et comme arbre \"sign\" ; \"stages\", la posture initiale et chaque action avec \"action\", \"hand\", \"start_us\", \"end_us\", \"hamnosys\", \"symbols\" ; \"features\", chacun avec \"feature\", \"hand\", \"action\" (null pour la posture), \"at_us\", \"start_us\", \"end_us\", \"value\", \"hamnosys\", \"symbols\", \"residual\", \"unit\" (deg, cm ou share) et \"runner_up\" (\"value\", \"hamnosys\", \"symbols\", \"residual\" ; null sans deuxième lecture) ; \"nonmanual\", les lignes avec les actes lus ; \"findings\". Les temps sont en microsecondes depuis le début de l’enregistrement.",
        ),
        (
            "(then: export mine.chereme token:41 --to it.sigml)",
            "(puis : export mine.chereme token:41 --to it.sigml)",
        ),
    ],
    lines: &[],
    titles: &[
        ("action", "action"),
        ("feature", "trait"),
        ("residual", "écart"),
        ("runner-up", "second choix"),
    ],
};
