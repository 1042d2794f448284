//! `chereme render`: draws movement, handshapes and notation as pictures, animations and films.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{ANIMATION_SPEEDS, CorpusAddress, DrawnPicture, OutputAudience, PictureOptions};
use chereme_motion::BodySide;

use crate::args::{BODY_SIDE_CHOICES, CommandLine};
use crate::output::{CommandOutput, with_progress_bar, write_to_stderr};
use crate::streams;

/// Draw movement as a contact sheet (.png), an animation (.gif) or a film (.mp4), handshapes (.png), or notation (.svg)
///
/// WHAT is a gloss, a recording's name, token:41, recording:3, recording:"NGT Thanks", or inventory:configurations or
/// inventory:configurations/U for handshapes. If a sign has only a notation, the program animates it first. The program
/// draws the symbols of HamNoSys without a font; inventory:hamnosys shows all of them. inventory:faces shows the face
/// for each non-manual of SiGML. Several WHAT are drawn next to each other in one film or animation: they begin
/// together, and the shorter ones stop at their last picture. Films are in H.264, which every player, browser and
/// office program can show.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme render mine.chereme ESCARGOT --to escargot.png
  chereme render ngt.chereme BABYSITTEN --to babysitten.gif --speed 0.5
  chereme render mine.chereme ESCARGOT LIMACE --to both.mp4 --captions
  chereme render ngt.chereme recording:3 --to take.mp4 --captions --height 720
  chereme render mine.chereme ESCARGOT --to escargot.mp4 --face
  chereme render ngt.chereme BABYSITTEN --to notation.svg
  chereme render mine.chereme inventory:configurations --to handshapes.png
  chereme render mine.chereme inventory:faces --to faces.png")]
pub(crate) struct RenderArgs {
    /// The corpus
    corpus: PathBuf,
    /// What to draw
    #[arg(value_name = "WHAT", required = true)]
    what: Vec<String>,
    /// The picture to write; its extension determines the kind; - is standard output
    #[arg(long, value_name = "FILE")]
    to: PathBuf,
    /// The kind of picture for standard output: png, gif, mp4 or svg
    #[arg(long, value_name = "FORMAT", default_value = "png", value_parser = ["png", "gif", "mp4", "svg"])]
    format: String,
    /// The number of pictures side by side in a contact sheet, from 1 to 64
    #[arg(long, default_value_t = 8, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=64))]
    frames: u16,
    /// The height of one picture in pixels, from 32 to 2000; without it 260, for films 540, for handshapes 128, for
    /// faces 160
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u16).range(32..=2000))]
    height: Option<u16>,
    /// The speed of an animation, from 0.05 to 20; 1 is the recorded speed
    #[arg(long, default_value_t = 1.0, value_name = "FACTOR", value_parser = parse_animation_speed, allow_negative_numbers = true)]
    speed: f64,
    /// The number of pictures per second in a film, from 1 to 120
    #[arg(long, default_value_t = 25, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=120))]
    rate: u32,
    /// Write glosses below an animation or a film while they are signed
    #[arg(long)]
    captions: bool,
    /// Leave out the close-ups of hands and face
    #[arg(long)]
    no_hands: bool,
    /// Show a close-up of the face next to the signer, in every picture
    #[arg(long)]
    face: bool,
    /// The hand on which handshapes are drawn
    #[arg(long, value_parser = BODY_SIDE_CHOICES, default_value = "right")]
    hand: BodySide,
    /// Replace a file that exists already
    #[arg(long)]
    force: bool,
    /// For whom it is drawn: what people did not agree to show them is left out and listed
    #[arg(long = "for", value_name = "AUDIENCE", default_value = "me", value_parser = ["me", "research", "public"])]
    audience: String,
}

/// Parses the speed of an animation.
fn parse_animation_speed(text: &str) -> Result<f64, String> {
    let speed: Option<f64> = text.parse().ok();
    speed.filter(|speed| ANIMATION_SPEEDS.contains(speed)).ok_or_else(|| {
        format!(
            "a speed is a number from {} to {}",
            ANIMATION_SPEEDS.start(),
            ANIMATION_SPEEDS.end()
        )
    })
}

pub(super) fn run(cli: &CommandLine, args: &RenderArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let options = PictureOptions {
        frames: usize::from(args.frames),
        hands: !args.no_hands,
        face: args.face,
        height: args.height.map(usize::from),
        speed: args.speed,
        rate: args.rate,
        captions: args.captions,
        force: args.force,
        audience: args.audience.parse()?,
    };
    let stand = match streams::is_standard(&args.to) {
        true => {
            streams::not_with_json(output.is_json())?;
            Some(streams::stdout_stand_in("picture", &args.format)?)
        }
        false => None,
    };
    // The rasteriser writes files; one of them stands in for standard output.
    let to = stand.as_ref().map_or(&args.to, |stand| &stand.path);
    let inventory = match args.what.as_slice() {
        [one] => one.strip_prefix("inventory:"),
        _ => None,
    };
    let picture = match inventory {
        Some(name) => {
            let (inventory, value) = match name.split_once('/') {
                Some((inventory, value)) => (inventory, Some(value)),
                None => (name, None),
            };
            corpus.draw_handshapes(inventory, value, args.hand, to, &options)?
        }
        None => {
            let addresses: Vec<CorpusAddress> = args.what.iter().map(|what| what.parse()).collect::<Result<_, _>>()?;
            with_progress_bar(|progress| corpus.draw_together(&addresses, to, &options, progress))?
        }
    };
    if let Some(stand) = &stand {
        for note in consent_notes(&picture, options.audience) {
            write_to_stderr(&format!("note: {}", output.translate_message(&note)));
        }
        output.silence_output();
        return streams::copy_to_stdout(stand);
    }
    report_rendered_picture(&picture, output)?;
    for note in consent_notes(&picture, options.audience) {
        output.write_note(&note)?;
    }
    output.set_json_document(picture)
}

/// Returns what was left out of a picture, and who has not agreed that others see it.
fn consent_notes(picture: &DrawnPicture, audience: OutputAudience) -> Vec<String> {
    let withheld = picture.withheld.iter().map(|one| one.withheld_sentence(audience));
    withheld.chain(picture.for_me.clone()).collect()
}

fn report_rendered_picture(picture: &DrawnPicture, output: &mut CommandOutput) -> Result<()> {
    if let Some(body) = &picture.animated_on {
        output.filled_line(
            "{name} has no movement of its own: its notation was animated on {body}",
            &[&picture.title, &output.translate_message(body)],
        )?;
    }
    if picture.transcribed {
        output.filled_line(
            "{name} has no notation: it was transcribed from its movement, and not stored",
            &[&picture.title],
        )?;
    }
    let noun = match picture.path.extension() {
        Some(ending) if ending == "svg" => "symbols",
        _ => "frames",
    };
    output.filled_line(
        "drew {what} to {path}: {drawn}, {size} KB",
        &[
            &picture.title,
            &picture.path.display(),
            &output.format_counted_noun(picture.frames as u64, noun),
            &picture.bytes.div_ceil(1024),
        ],
    )
}
