//! Closed loop from captured movement: transcribes it, animates the notation, and compares both movements.

use std::path::Path;
use std::sync::Arc;

use chereme_analysis::score::{Performed, ScoreOptions, score_as};
use chereme_analysis::transcribe::{Options, transcribe};
use chereme_compose::notation::{Settings, animate};
use chereme_motion::{Anatomy, Channel, Clip, Side};
use chereme_sign::hamnosys::{Notated, Sign, parse, print, to_names};

use crate::Result;
use crate::bodies;

/// A flat hand before the chest that goes to the right, and back, and again.
const ANOTHER: &str =
    "hamflathand hamextfingeru hampalml hamchest hamclose hammover hamrepeatfromstart";

/// Prints the notation of captured movement and the distance of the movement generated from it, per step of the
/// alignment, next to the distances of a hand that keeps its first posture and of another sign. A left hand that does
/// not sign keeps its captured movement.
pub(crate) fn table(files: &[&str]) -> Result<()> {
    println!(
        "| recording | seconds | symbols | distance | held still | another sign | components |"
    );
    println!("|---|---|---|---|---|---|---|");
    for file in files {
        let captured = bodies::movement(Path::new(file))?;
        let anatomy = Arc::clone(&captured.anatomy);
        let found = transcribe(&captured.clip, &anatomy, &Options::default())?;
        let (first, end) = found.frames;
        let sign = captured.clip.slice(first..end);
        let names = to_names(&print(&found.sign).text)?;
        let notated = Notated {
            sign: found.sign.clone(),
            ..Notated::default()
        };
        let again = made(&notated, &captured)?;
        let held = made(&still(&notated), &captured)?;
        let another = Notated {
            sign: parse(ANOTHER)?.sign,
            ..Notated::default()
        };
        let another = made(&another, &captured)?;
        let options = ScoreOptions::default();
        let alone = found.features.iter().all(|it| it.hand != Some(Side::Left));
        let score = |clip: &Clip| {
            let clip = match alone {
                true => with_left_of(clip, &sign, &anatomy)?,
                false => clip.clone(),
            };
            let performed = [&sign, &clip].map(|clip| Performed {
                clip,
                anatomy: &anatomy,
                uncaptured: &[],
            });
            crate::Result::Ok(score_as(performed[0], performed[1], &options)?)
        };
        let (own, held, another) = (score(&again)?, score(&held)?, score(&another)?);
        let parts: Vec<String> = own
            .components
            .iter()
            .map(|(component, part)| format!("{component} {part:.2}"))
            .collect();
        println!(
            "| {} | {:.2} | {} | {:.3} | {:.3} | {:.3} | {} |",
            Path::new(file).file_stem().unwrap_or_default().display(),
            sign.span().seconds(),
            names.len(),
            own.normalized.unwrap_or(f64::NAN),
            held.normalized.unwrap_or(f64::NAN),
            another.normalized.unwrap_or(f64::NAN),
            parts.join(", ")
        );
        println!("\n{}\n", names.join(" "));
    }
    Ok(())
}

/// Returns movement with the left arm and hand of another one's first frame.
fn with_left_of(clip: &Clip, other: &Clip, anatomy: &Anatomy) -> Result<Clip> {
    let (skeleton, rate) = (Arc::clone(clip.skeleton()), clip.rate());
    let frames = clip.frames();
    let mut channels = clip.channels().to_vec();
    for joint in [anatomy.arm_joints(Side::Left), anatomy.fingers(Side::Left)].concat() {
        channels[joint] = Channel {
            rotations: vec![other.channel(joint).rotations[0]; frames],
            translations: channels[joint].translations.take(),
        };
    }
    Ok(Clip::new(skeleton, rate, channels)?)
}

/// Returns a sign that keeps its first posture.
fn still(notated: &Notated) -> Notated {
    let mut parts = notated.sign.parts.clone();
    for part in &mut parts {
        part.actions.clear();
    }
    Notated {
        sign: Sign { parts },
        ..notated.clone()
    }
}

/// Animates a sign on the captured body, and cuts off the movements from and to rest.
fn made(notated: &Notated, stage: &chereme_compose::Material) -> Result<Clip> {
    let made = animate(&[notated], stage, &Settings::default())?;
    let gloss = made
        .notes
        .iter()
        .find(|note| note.about == chereme_compose::About::Gloss)
        .ok_or("no gloss")?;
    let rate = made.clip.rate();
    let (first, last) = (
        rate.frame_at(gloss.span.start()),
        rate.frame_at(gloss.span.end()),
    );
    Ok(made.clip.slice(first..last + 1))
}
