//! `chereme recombine`: composes a new sign by a recipe, and stores it.

use std::path::{Path, PathBuf};

use anyhow::Result;
use chereme_corpus::recipe::Step;
use chereme_corpus::words::{InterfaceLanguage, InterfaceText};
use chereme_corpus::{CorpusAddress, PictureOptions, RecombinationResult, draw_clip};
use serde_json::json;

use crate::args::CommandLine;
use crate::output::{CommandOutput, with_progress_bar};
use crate::streams;

const RECIPE_SOURCES_HELP: &str = "\
Sources: what a recipe begins with
  ESCARGOT  token:41  sign:LIMACE         a sign of the corpus, with movement or as notation
  take-1  recording:3                     a whole recording, by its name if no sign has that name
  spell LSF left hold 0.2s                a word in a manual alphabet
  point right at 30cm,140cm,50cm          reaching for a point: to the left, up from the floor, forward
  hamnosys \"...\"  sigml HUIS.sigml        notation

Operators: the changes, one after another, each after |";

const RECIPE_UTTERANCES_HELP: &str = "\
One after the other, with transitions
  BOL then ESCARGOT then via sigmoid 0.3s CHAT

Examples:
  chereme recombine mine.chereme 'ESCARGOT | configure right U' --as LIMACE
  chereme recombine mine.chereme 'AIMER | reverse | repeat 2' --explain
  chereme recombine mine.chereme 'take-1 | trim' --as HELLO
  chereme recombine mine.chereme 'spell LSF | travel right down 20cm then up 20cm' --draw lsf.gif";

/// The column in which the effects of examples begin.
const EXAMPLE_EFFECTS_COLUMN: usize = 42;

/// Returns the help of recipes: sources, every operator by its own examples, and utterances.
fn recipe_help_text() -> String {
    let examples = Step::DESCRIPTIONS.iter().flat_map(|description| description.examples);
    let line = |(recipe, effect): &(&str, InterfaceText)| {
        let before = match recipe.chars().count() + 4 > EXAMPLE_EFFECTS_COLUMN {
            true => format!("\n  {recipe}\n{:EXAMPLE_EFFECTS_COLUMN$}", ""),
            false => format!("\n  {recipe:<width$}", width = EXAMPLE_EFFECTS_COLUMN - 2),
        };
        format!("{before}{}", effect.text_in_language(InterfaceLanguage::English))
    };
    let operators: String = examples.map(line).collect();
    format!("{RECIPE_SOURCES_HELP}{operators}\n\n{RECIPE_UTTERANCES_HELP}")
}

/// Compose a new sign from stored ones, and store it
///
/// A recipe is a sign and the changes to it: ESCARGOT | configure right U. The new sign gets its own tiers and is
/// found by search like a captured one; its recipe is stored with it. Quote the recipe for your shell.
#[derive(Debug, clap::Args)]
#[command(after_help = recipe_help_text())]
pub(crate) struct RecombineArgs {
    /// The corpus
    corpus: PathBuf,
    /// The recipe, as text or JSON; - is standard input
    recipe: String,
    /// The gloss of the new sign; without it nothing is stored
    #[arg(long = "as", value_name = "GLOSS")]
    gloss: Option<String>,
    /// Replace a sign that was generated before; it keeps its gloss, its token and the annotations that people wrote on
    /// its tiers
    #[arg(long, value_name = "SIGN", conflicts_with = "gloss")]
    replace: Option<CorpusAddress>,
    /// Explain the sign: its steps, the source of each channel, joins and residuals
    #[arg(long)]
    explain: bool,
    /// Draw the sign to a contact sheet (.png), an animation (.gif) or a film (.mp4)
    #[arg(long, value_name = "FILE")]
    draw: Option<PathBuf>,
}

pub(super) fn run(cli: &CommandLine, args: &RecombineArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let recipe = match args.recipe.as_str() {
        "-" => streams::read_stdin_text()?.trim().to_owned(),
        recipe => recipe.to_owned(),
    };
    let done = match (&args.replace, &args.gloss) {
        (Some(sign), _) => corpus.recombine_again(sign, &recipe)?,
        (None, Some(gloss)) => corpus.recombine_recipe(&recipe, gloss)?,
        (None, None) => corpus.preview_recipe(&recipe)?,
    };
    print_recombination(&done, args.explain, args.draw.as_deref(), output)?;
    // Two signs of one gloss are allowed, and seldom meant.
    if args.gloss.is_some() && one_more(&done) {
        let gloss = &done.gloss;
        output.filled_line(
            "note: {gloss} was there already and stays; --replace {other} instead of --as puts a \
             sign in its place",
            &[gloss, gloss],
        )?;
    }
    Ok(())
}

/// Returns whether the recording's name differs from the gloss, because that name was taken.
fn one_more(done: &RecombinationResult) -> bool {
    done.name.as_ref().is_some_and(|name| *name != done.gloss)
}

/// Prints the result, and draws it if a file is given.
pub(super) fn print_recombination(
    done: &RecombinationResult,
    explain: bool,
    draw: Option<&Path>,
    output: &mut CommandOutput,
) -> Result<()> {
    let seconds = done.duration_us as f64 / 1e6;
    match (done.token, &done.name) {
        (Some(token), Some(name)) => output.filled_line(
            "stored {gloss} as token:{token}, recording {name}, {seconds} s: {recipe}",
            &[
                &done.gloss,
                &token,
                &format_args!("{:?}", name),
                &format_args!("{:.2}", seconds),
                &done.recipe,
            ],
        )?,
        _ => output.filled_line(
            "{seconds} s, not stored (give it a gloss with --as): {recipe}",
            &[&format_args!("{:.2}", seconds), &done.recipe],
        )?,
    }
    if explain {
        for line in done.explanation.trim_end().lines() {
            output.write_output_line(line)?;
        }
    } else {
        output.write_warnings(&done.report.warnings)?;
    }
    let mut document = serde_json::to_value(done)?;
    if let Some(path) = draw {
        let title = if done.gloss.is_empty() {
            &done.recipe
        } else {
            &done.gloss
        };
        let options = PictureOptions {
            // A picture of a preview is looked at and made again many times.
            force: true,
            ..PictureOptions::default()
        };
        let picture = with_progress_bar(|progress| draw_clip(done.into(), title, path, &options, progress))?;
        output.filled_line("drew {path}", &[&path.display()])?;
        document["picture"] = json!(picture);
    }
    output.set_json_document(document)
}
