//! `chereme recombine`.

use std::path::{Path, PathBuf};

use anyhow::Result;
use chereme_corpus::{Address, PictureOptions, Progress, Recombination, draw_clip};
use serde_json::json;

use crate::args::Cli;
use crate::output::{Bar, Output};

/// Make a new sign from stored ones, and store it
///
/// A recipe is a sign and what is done to it: ESCARGOT | configure right U, BOL | place both by left
/// 25cm, CLAIR | reverse, AIMER | reverse | repeat 2, spell LSF | travel right down 20cm then up 20cm,
/// BOL then ESCARGOT. The new sign gets its own tiers and is found by search like a captured one; its
/// recipe is stored with it. Quote the recipe for your shell.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// The recipe, as text or JSON
    recipe: String,
    /// The gloss of the new sign; without it nothing is stored
    #[arg(long = "as", value_name = "GLOSS")]
    gloss: Option<String>,
    /// Put it in the place of a sign that was made before, which keeps its gloss, its token and what
    /// people wrote on its tiers
    #[arg(long, value_name = "SIGN", conflicts_with = "gloss")]
    replace: Option<Address>,
    /// Show how the sign comes about: the steps, where each channel comes from, joins and residuals
    #[arg(long)]
    explain: bool,
    /// Draw the sign to a contact sheet (.png) or an animation (.gif)
    #[arg(long, value_name = "FILE")]
    draw: Option<PathBuf>,
}

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let mut corpus = cli.open(&args.corpus)?;
    let done = match (&args.replace, &args.gloss) {
        (Some(sign), _) => corpus.recombine_again(sign, &args.recipe)?,
        (None, Some(gloss)) => corpus.recombine(&args.recipe, gloss)?,
        (None, None) => corpus.preview(&args.recipe)?,
    };
    tell(&done, args.explain, args.draw.as_deref(), output)?;
    if args.gloss.is_some() && one_more(&done) {
        let gloss = &done.gloss;
        output.line(format!(
            "note: {gloss} was there already and stays; --replace {gloss} instead of --as puts a sign in its place"
        ))?;
    }
    Ok(())
}

/// Tells whether the recording had to be named otherwise than its sign, as another has that name.
fn one_more(done: &Recombination) -> bool {
    done.name.as_ref().is_some_and(|name| *name != done.gloss)
}

/// Tells what was made, and draws it where asked.
pub(super) fn tell(
    done: &Recombination,
    explain: bool,
    draw: Option<&Path>,
    output: &mut Output,
) -> Result<()> {
    let seconds = done.duration_us as f64 / 1e6;
    match (done.token, &done.name) {
        (Some(token), Some(name)) => output.line(format!(
            "stored {} as token:{token}, recording {name:?}, {seconds:.2} s: {}",
            done.gloss, done.recipe
        ))?,
        _ => output.line(format!(
            "{seconds:.2} s, not stored (give it a gloss with --as): {}",
            done.recipe
        ))?,
    }
    if explain {
        output.line(done.explanation.trim_end())?;
    } else {
        for warning in &done.report.warnings {
            output.line(format!("warning: {warning}"))?;
        }
    }
    let mut document = serde_json::to_value(done)?;
    if let Some(path) = draw {
        let mut bar = Bar::new();
        let mut hear = |step: chereme_corpus::Step<'_>| bar.show(step);
        let title = if done.gloss.is_empty() {
            &done.recipe
        } else {
            &done.gloss
        };
        let options = PictureOptions {
            force: true,
            ..PictureOptions::default()
        };
        let progress = &mut Progress::new(&mut hear);
        let picture = draw_clip(&done.clip, &done.anatomy, title, path, &options, progress)?;
        drop(bar);
        output.line(format!("drew {}", path.display()))?;
        document["picture"] = json!(picture);
    }
    output.document(document)
}
