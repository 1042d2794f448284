//! `chereme publish`: writes a dictionary of signs as a folder of web pages.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{LeftOutPart, LeftOutSigns, PublishOptions};

use super::lexicon_command::LexiconScopeArgs;
use crate::args::CommandLine;
use crate::output::{CommandOutput, with_progress_bar};

/// Publish a dictionary of signs: a folder of web pages that works without a server
///
/// People search by word, by drawn handshape, by place on the body, by movement and by one or two hands; signs that
/// nearly fit follow those that do. Signs move in the list as the reader chooses. Each has a page with its movement and
/// face, which can be slowed down, scrubbed, turned, mirrored and saved as a film, its words, sentences and values, its
/// minimal pairs side by side and its terms of use. The folder opens by a double click and from any web server, in English,
/// French and German, and asks no other computer for anything.
///
/// Signs that have a notation and no movement move on the program's own body, and their pages say so; --no-animation
/// leaves them as they are.
///
/// From a web server (https) a browser keeps a copy of the search and of the signs that were opened, or of all signs if
/// somebody wants that, so that the dictionary works without a connection. With a connection, each page asks first
/// whether the copy still holds, and deletes from it what a newer publication does not have. Without one, the copy is shown
/// for at most 30 days.
///
/// Only what everybody may see is published: recordings whose signers agreed (`chereme consent`), under stated terms, and
/// signs made from such recordings alone. Names of signers, recordings and files stay out; remarks, too, without
/// --notes. The report lists the signs that were left out, and why. A second publication replaces the first one, and a
/// sign that was withdrawn leaves no trace; files of others in the folder stay.
///
/// With --own-body every sign plays on the program's own body. That removes the height and the proportions of signers, but
/// not their rhythm and their movement, by which people are recognised, too. Hands that touch something touch it on that
/// body, too; the report names the signs for which that failed.
///
/// `--json` gives "page", "signs", "moving", "signers", "files", "bytes", "terms" (signs by terms of use), "undrawn"
/// (handshapes without a picture), "namesakes" (handshapes with the picture of the usual one of that name), "armless"
/// (signs whose movement has no arms to show), "cut" (signs whose movement is cut), "own_body", "apart" (signs with a touch
/// that is lost on that body), "without_pairs" (whether there are too many minimal pairs), "animated" (signs that move by
/// their notation), "unanimated" (those whose notation cannot be performed) and "left_out", each with "why", "part"
/// ("sign", "movement", or "lexicon" for its words and values), "signs", "first" and "remedy".
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme consent mine.chereme signer:Ada --all public --licence 'CC BY-NC-SA 4.0'
  chereme publish mine.chereme --to dictionary/
  chereme publish mine.chereme 'origin=captured not gloss=NAME*' --to dictionary/ --title 'Signs of Nantes' --contact signs@example.org
  chereme publish lexicon.chereme --to dictionary/ --terms 'CC BY-NC-SA 3.0, Global Signbank'")]
pub(crate) struct PublishArgs {
    /// The corpus
    corpus: PathBuf,
    /// The signs, as a query for their tokens as in `chereme search`; all signs without it
    query: Vec<String>,
    #[command(flatten)]
    scope: LexiconScopeArgs,
    /// The folder to write
    #[arg(long, value_name = "FOLDER")]
    to: PathBuf,
    /// The title of the pages
    #[arg(long)]
    title: Option<String>,
    /// The terms of use of what shows nobody and has none: entries of tables, signs generated from notation
    #[arg(long)]
    terms: Option<String>,
    /// The address to which people write, also to withdraw a sign
    #[arg(long)]
    contact: Option<String>,
    /// Publish the remarks on signs, too
    #[arg(long)]
    notes: bool,
    /// Play every sign on the program's own body, not on that of its signer
    #[arg(long)]
    own_body: bool,
    /// Leave signs that have a notation and no movement without movement
    #[arg(long)]
    no_animation: bool,
}

pub(super) fn run(cli: &CommandLine, args: &PublishArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let options = PublishOptions {
        query: (!args.query.is_empty()).then(|| args.query.join(" ")),
        scope: args.scope.lexicon_scope(),
        title: args.title.clone(),
        terms: args.terms.clone(),
        contact: args.contact.clone(),
        notes: args.notes,
        own_body: args.own_body,
        without_animation: args.no_animation,
    };
    let done = with_progress_bar(|progress| corpus.publish_dictionary(&args.to, &options, progress))?;
    output.filled_line(
        "published {signs}, {moving} of them with movement: {path}",
        &[
            &output.format_counted_noun(done.signs as u64, "signs"),
            &done.moving,
            &done.page.display(),
        ],
    )?;
    output.filled_line(
        "signers: {n}; files: {files}, {size} KB",
        &[&done.signers, &done.files, &done.bytes.div_ceil(1024)],
    )?;
    if done.animated > 0 {
        output.filled_line("movement generated from notation: {n}", &[&done.animated])?;
    }
    if !done.unanimated.is_empty() {
        output.filled_line(
            "without movement, as their notation cannot be performed: {glosses}",
            &[&done.unanimated.join(", ")],
        )?;
    }
    for (terms, signs) in &done.terms {
        output.filled_line("terms {terms}: {n}", &[&format_args!("{:?}", terms), &signs])?;
    }
    if done.namesakes > 0 {
        output.filled_line(
            "handshapes with the picture of the usual one of that name: {n}; the source may mean \
             another one",
            &[&done.namesakes],
        )?;
    }
    if done.undrawn > 0 {
        output.filled_line(
            "handshapes without a picture: {n}; their values have no posture",
            &[&done.undrawn],
        )?;
    }
    if done.armless > 0 {
        output.filled_line("signs whose movement has no arms to show: {n}", &[&done.armless])?;
    }
    if !done.cut.is_empty() {
        output.filled_line("movement cut after 3600 frames: {glosses}", &[&done.cut.join(", ")])?;
    }
    if !done.apart.is_empty() {
        output.filled_line(
            "a touch is lost on the program's own body: {glosses}",
            &[&done.apart.join(", ")],
        )?;
    }
    // So many pairs would make pages that no browser opens.
    if done.without_pairs {
        output.write_output_line(
            "minimal pairs are left out: there are more than 5,000,000, as the signs are coded in few fields",
        )?;
    }
    for it in &done.left_out {
        print_left_out(it, output)?;
    }
    output.set_json_document(done)
}

fn print_left_out(it: &LeftOutSigns, output: &mut CommandOutput) -> Result<()> {
    let why = output.translate_message(it.why.reason_words());
    let mut first = it.first.join(", ");
    if it.signs > it.first.len() {
        first.push_str(", …");
    }
    let signs = output.format_counted_noun(it.signs as u64, "signs");
    output.write_output_line(match it.part {
        LeftOutPart::Sign => format!("not published: {signs} ({first}): {why}"),
        LeftOutPart::Movement => format!("without movement: {signs} ({first}): {why}"),
        LeftOutPart::Lexicon => format!("without words and values of their lexicon: {signs} ({first}): {why}"),
    })?;
    output.line_as_is(&format!("  {}", output.translate_message(it.remedy.remedy_text())))
}
