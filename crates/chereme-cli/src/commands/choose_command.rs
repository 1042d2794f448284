//! `chereme choose`: ranks recorded expressions of the face for a sentence, and animates it with one of them.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{
    ChooseOptions, ExpressionFunction, NoPath, PerformanceChoice, RankedPerformance, RankingCriterion,
};
use serde_json::json;

use crate::args::{CommandLine, NamedChoices};
use crate::output::{CommandOutput, with_progress_bar};

/// Rank recorded expressions of the face, such as those of a negation, for a sentence, and animate it with one of them
///
/// Dynamic time warping aligns each phase of a recorded performance (see `milestones`) with the same phase of the
/// sentence's own face. The score is the sum of the distances times the ratio of lengths; 0 is the same face. If the
/// sentence's face was not recorded, the most typical performance, the medoid, comes first. A recording is never its
/// own candidate; equal scores are ordered by name.
///
/// With --as the sentence is generated again with head, trunk and face of the first performance, or of the one that
/// --use names; each of its phases is stretched to the length of the sentence's own.
///
/// `--json` gives "ranking", each with "token", "recording", "score", "unstretched", "stretch", "partial", "phases"
/// ("phase", "frames", "distance", "normalized", "made", "channels") and "channels", and "channels", "left_out",
/// "compared", "adapted", "skipped"; with --as "made" and "recipe".
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme choose mine.chereme --function wh --for recording:7
  chereme choose mine.chereme --function wh --for recording:7 --as QUI-FACE
  chereme choose mine.chereme --function negation --for recording:2 --rank farthest --channels head,brow")]
pub(crate) struct ChooseArgs {
    /// The corpus
    corpus: PathBuf,
    /// The function of the expression: negation, wh, yn, topic, conditional, rhetorical, or another word of the tier of
    /// functions
    #[arg(long)]
    function: String,
    /// The sentence: a recording, a token in it, or the annotation of its function
    #[arg(long = "for", value_name = "TOKEN")]
    target: String,
    /// The order of the ranking
    #[arg(long, value_parser = RANKING_CHOICES, default_value = "nearest")]
    rank: RankingCriterion,
    #[command(flatten)]
    comparing: PerformanceComparing,
    /// How many performances to report
    #[arg(long, default_value_t = 20, value_name = "N")]
    limit: usize,
    /// Animate the sentence with the face, and store it under this gloss
    #[arg(long = "as", value_name = "GLOSS")]
    gloss: Option<String>,
    /// The address of the performance to animate with; without it the first of the ranking
    #[arg(long = "use", value_name = "TOKEN", requires = "gloss")]
    chosen: Option<String>,
}

/// How performances are compared.
#[derive(Debug, clap::Args)]
pub(crate) struct PerformanceComparing {
    /// The channels to compare, separated by commas: head, brow, eye, gaze, jaw, mouth …; without it head and brows
    #[arg(long, value_delimiter = ',', value_name = "NAMES")]
    pub(super) channels: Vec<String>,
    /// The weights of the phases onset, first, rest and offset, such as 1,2,2,0.5
    #[arg(long, value_delimiter = ',', num_args = 4, value_name = "W,W,W,W")]
    pub(super) weights: Vec<f64>,
    /// Leave the ratio of lengths out of the score
    #[arg(long)]
    pub(super) no_stretch: bool,
    /// Refuse phases that no path within the alignment window (10 frames) connects, instead of widening the window
    #[arg(long)]
    pub(super) strict: bool,
}

impl PerformanceComparing {
    pub(super) fn choose_options(&self) -> ChooseOptions {
        let usual = ChooseOptions::default();
        ChooseOptions {
            channels: self.channels.iter().map(|part| part.trim().to_owned()).collect(),
            weights: self.weights.clone().try_into().unwrap_or(usual.weights),
            stretch: !self.no_stretch,
            no_path: if self.strict { NoPath::Refuse } else { NoPath::Adapt },
            ..usual
        }
    }
}

/// The orders of a ranking.
const RANKING_CHOICES: NamedChoices<RankingCriterion> = NamedChoices(&[
    (
        "nearest",
        "The most similar to the sentence's own face; the medoid if that face was not recorded",
        RankingCriterion::Nearest,
    ),
    (
        "farthest",
        "The least similar to the sentence's own face",
        RankingCriterion::Farthest,
    ),
    ("medoid", "The most similar to all others", RankingCriterion::Medoid),
]);

pub(super) fn run(cli: &CommandLine, args: &ChooseArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let options = ChooseOptions {
        rank: args.rank,
        limit: args.limit,
        ..args.comparing.choose_options()
    };
    let function = ExpressionFunction::from_function_name(&args.function);
    let target = args.target.parse()?;
    let choice = with_progress_bar(|progress| corpus.choose_performances(&function, &target, &options, progress))?;
    print_choice(&choice, output)?;
    let Some(gloss) = &args.gloss else {
        return output.set_json_document(choice);
    };
    let first = choice
        .ranking
        .first()
        .map(|candidate| candidate.token.clone())
        .unwrap_or_default();
    // The best performance is used, unless one of the list is named.
    let token = args.chosen.clone().unwrap_or(first);
    let made = corpus.animate_choice(&choice, &token, gloss)?;
    output.line_as_is(&format!("{gloss} = {}", made.recipe))?;
    let mut document = serde_json::to_value(&choice)?;
    document["recipe"] = json!(made.recipe);
    document["made"] = json!(made);
    output.set_json_document(document)
}

fn print_choice(choice: &PerformanceChoice, output: &mut CommandOutput) -> Result<()> {
    let by = match choice.rank {
        RankingCriterion::Nearest => "the most similar to its own face first",
        RankingCriterion::Farthest => "the least similar to its own face first",
        RankingCriterion::Medoid => "the most usual first",
    };
    output.filled_line(
        "{n} performances of {function} for {sign}, {order}; compared: {channels}",
        &[
            &choice.compared,
            &choice.function,
            &choice.target,
            &output.translate_message(by),
            &choice
                .channels
                .iter()
                .map(|entry| entry.name)
                .collect::<Vec<_>>()
                .join(", "),
        ],
    )?;
    let part = |ranked: &RankedPerformance, at: usize| {
        let phase = ranked.parts.phases.get(at).and_then(|phase| phase.normalized);
        phase.map_or("-".to_owned(), |number| format!("{number:.3}"))
    };
    let most_different = |ranked: &RankedPerformance| {
        let most = ranked.parts.channels.first();
        most.map_or(String::new(), |channel| {
            format!("{} {:.2}", channel.name, channel.difference)
        })
    };
    output.write_item_table(
        &choice.ranking,
        &[
            ("token", &|ranked| ranked.token.clone()),
            ("recording", &|ranked| ranked.recording.clone()),
            ("score", &|ranked| format!("{:.3}", ranked.score)),
            ("stretch", &|ranked| format!("{:.2}", ranked.parts.stretch)),
            ("onset", &|ranked| part(ranked, 0)),
            ("first", &|ranked| part(ranked, 1)),
            ("rest", &|ranked| part(ranked, 2)),
            ("offset", &|ranked| part(ranked, 3)),
            ("differs most in", &most_different),
        ],
    )?;
    if !choice.left_out.is_empty() {
        output.filled_line("left out, as they are unknown: {names}", &[&choice.left_out.join(", ")])?;
    }
    if choice.adapted > 0 {
        output.filled_line(
            "comparisons with phases of too different lengths for the window of 10 frames, which \
             was widened: {n}",
            &[&choice.adapted],
        )?;
    }
    if choice.references > 0 {
        output.filled_line("each was compared with {n} others", &[&choice.references])?;
    }
    for (token, why) in choice.skipped.iter().take(10) {
        let why = output.translate_message(why);
        output.filled_line("not compared: {token}: {why}", &[token, &why])?;
    }
    if choice.skipped.len() > 10 {
        output.filled_line("and {n} more were not compared", &[&(choice.skipped.len() - 10)])?;
    }
    Ok(())
}
