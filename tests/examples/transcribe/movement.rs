//! Closed loop from captured movement: transcribes it, animates the notation, and compares both movements.

use std::path::Path;
use std::sync::Arc;

use chereme_analysis::score::{PerformedClip, ScoreOptions, score_as};
use chereme_analysis::transcribe::{TranscribeOptions, transcribe_clip};
use chereme_compose::notation::{AnimatorSettings, animate_signs};
use chereme_motion::{BodyAnatomy, BodySide, Clip, JointChannel};
use chereme_sign::hamnosys::{HamnosysSign, NotatedSign, parse_hamnosys, print_hamnosys, to_names};

use crate::Result;
use crate::bodies;

/// A flat hand before the chest that goes to the right, and back, and again.
const ANOTHER: &str = "hamflathand hamextfingeru hampalml hamchest hamclose hammover hamrepeatfromstart";

/// Prints the notation of captured movement and the distance of the movement generated from it, per step of the
/// alignment, next to the distances of a hand that keeps its first posture and of another sign. A left hand that does
/// not sign keeps its captured movement.
pub(crate) fn table(files: &[&str]) -> Result<()> {
    println!("| recording | seconds | symbols | distance | held still | another sign | components |");
    println!("|---|---|---|---|---|---|---|");
    for file in files {
        let captured = bodies::movement(Path::new(file))?;
        let anatomy = Arc::clone(&captured.anatomy);
        let found = transcribe_clip(&captured.clip, &anatomy, &TranscribeOptions::default())?;
        let (first, end) = found.frames;
        let sign = captured.clip.slice_clip_frames(first..end);
        let names = to_names(&print_hamnosys(&found.sign).text)?;
        let notated = NotatedSign {
            sign: found.sign.clone(),
            ..NotatedSign::default()
        };
        let again = made(&notated, &captured)?;
        let held = made(&still(&notated), &captured)?;
        let another = NotatedSign {
            sign: parse_hamnosys(ANOTHER)?.sign,
            ..NotatedSign::default()
        };
        let another = made(&another, &captured)?;
        let options = ScoreOptions::default();
        let alone = found.features.iter().all(|it| it.hand != Some(BodySide::Left));
        let score = |clip: &Clip| {
            let clip = match alone {
                true => with_left_of(clip, &sign, &anatomy)?,
                false => clip.clone(),
            };
            let performed = [&sign, &clip].map(|clip| PerformedClip {
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
            sign.clip_span().span_seconds(),
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
fn with_left_of(clip: &Clip, other: &Clip, anatomy: &BodyAnatomy) -> Result<Clip> {
    let (skeleton, rate) = (Arc::clone(clip.clip_skeleton()), clip.clip_frame_rate());
    let frames = clip.clip_frame_count();
    let mut channels = clip.joint_channels().to_vec();
    for joint in [
        anatomy.arm_joints(BodySide::Left),
        anatomy.finger_joints(BodySide::Left),
    ]
    .concat()
    {
        channels[joint] = JointChannel {
            rotations: vec![other.joint_channel(joint).rotations[0]; frames],
            translations: channels[joint].translations.take(),
        };
    }
    Ok(Clip::new(skeleton, rate, channels)?)
}

/// Returns a sign that keeps its first posture.
fn still(notated: &NotatedSign) -> NotatedSign {
    let mut parts = notated.sign.parts.clone();
    for part in &mut parts {
        part.actions.clear();
    }
    NotatedSign {
        sign: HamnosysSign { parts },
        ..notated.clone()
    }
}

/// Animates a sign on the captured body, and cuts off the movements from and to rest.
fn made(notated: &NotatedSign, stage: &chereme_compose::MovementMaterial) -> Result<Clip> {
    let made = animate_signs(&[notated], stage, &AnimatorSettings::default())?;
    let gloss = made
        .notes
        .iter()
        .find(|note| note.about == chereme_compose::NoteSubject::Gloss)
        .ok_or("no gloss")?;
    let rate = made.clip.clip_frame_rate();
    let (first, last) = (
        rate.nearest_frame_at(gloss.span.span_start_instant()),
        rate.nearest_frame_at(gloss.span.span_end_instant()),
    );
    Ok(made.clip.slice_clip_frames(first..last + 1))
}
