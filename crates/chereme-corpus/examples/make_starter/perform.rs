//! Performs a take: the animator's movement between moments of rest, by a signer who breathes.

use std::sync::Arc;

use chereme_compose::notation::{AnimatorSettings, animate_signs};
use chereme_compose::{GeneratedMovement, MovementMaterial};
use chereme_motion::glam::{DQuat, DVec3, EulerRot};
use chereme_motion::{BodyAnatomy, BodySide, Clip, FrameRate, JointChannel, LocalPose};
use chereme_sign::SignerHandedness;
use chereme_sign::hamnosys::{BodyLanguage, NotatedSign};

use super::noise::Noise;
use super::signer;
use super::takes::Take;

/// Frames per second.
const FPS: u32 = 60;
/// The number of frames for which the signer rests before and after the animator's movement.
pub(crate) const REST: usize = 15;

/// Returns the signer at the beginning.
pub(crate) fn stage() -> MovementMaterial {
    let skeleton = Arc::new(signer::skeleton());
    let anatomy = Arc::new(BodyAnatomy::detect_anatomy(&skeleton));
    let rate = FrameRate::new(FPS, 1).expect("a whole rate");
    MovementMaterial {
        curves: Vec::new(),
        address: signer::NAME.to_owned(),
        hash: String::new(),
        gloss: String::new(),
        signer: None,
        handedness: SignerHandedness::Right,
        clip: Clip::from_rest_pose(skeleton, rate, 1),
        anatomy,
        held: Vec::new(),
    }
}

/// Performs `take`: the movement with rest before and after it, and the animator's notes, whose times count from the
/// end of the first rest.
pub(crate) fn perform(stage: &MovementMaterial, take: &Take) -> GeneratedMovement {
    let signs: Vec<NotatedSign> = take.signs.iter().map(|sign| sign.notated()).collect();
    let signs: Vec<&NotatedSign> = signs.iter().collect();
    // The noise below adds this signer's sway.
    let mut settings = AnimatorSettings {
        language: BodyLanguage::default_body_language().without_life(),
        ..AnimatorSettings::default()
    };
    settings.language.time_hold = take.hold.unwrap_or(settings.language.time_hold);
    let made = animate_signs(&signs, stage, &settings);
    let made = made.unwrap_or_else(|error| panic!("{}: {error}", take.stem));
    let channels = made.clip.joint_channels().iter().map(rested).collect();
    let clip = Clip::new(
        Arc::clone(made.clip.clip_skeleton()),
        made.clip.clip_frame_rate(),
        channels,
    );
    let clip = clip.expect("channels of this skeleton");
    let acts = |side: &BodySide| made.notes.iter().any(|note| note.hand == Some(*side));
    let busy: Vec<BodySide> = BodySide::BOTH_SIDES.into_iter().filter(acts).collect();
    let clip = alive(&clip, &busy, take.seed);
    GeneratedMovement { clip, ..made }
}

/// Returns a channel that holds its first and last frame for the time of rest.
fn rested(channel: &JointChannel) -> JointChannel {
    fn longer<T: Clone>(frames: &[T]) -> Vec<T> {
        let (first, last) = (frames.first(), frames.last());
        let before = first.into_iter().cycle().take(REST);
        let after = last.into_iter().cycle().take(REST);
        before.chain(frames).chain(after).cloned().collect()
    }
    JointChannel {
        rotations: longer(&channel.rotations),
        translations: channel.translations.as_deref().map(longer),
    }
}

/// Returns the movement of a signer who breathes, sways a little, and whose fingers are never quite still.
///
/// The trunk carries both arms and the head, so hands keep their contact.
fn alive(clip: &Clip, busy: &[BodySide], seed: u64) -> Clip {
    let noise: Vec<Noise> = (0..32).map(|channel| Noise::new(seed, channel)).collect();
    let poses: Vec<LocalPose> = (0..clip.clip_frame_count())
        .map(|frame| {
            let time = clip.clip_frame_rate().frame_start_instant(frame).instant_seconds();
            let at = |channel: usize| noise[channel].at(time);
            let mut pose = clip.clip_pose_at(frame);
            sway(&mut pose, clip, &at, time);
            for (n, side) in busy.iter().enumerate() {
                fidget(&mut pose, clip, *side, |finger| at(12 + 5 * n + finger));
            }
            pose
        })
        .collect();
    Clip::from_poses(Arc::clone(clip.clip_skeleton()), clip.clip_frame_rate(), &poses).expect("poses of this skeleton")
}

/// Adds breathing and small sways of the spine, and movement of the head.
fn sway(pose: &mut LocalPose, clip: &Clip, at: &impl Fn(usize) -> f64, time: f64) {
    let breath = (time * std::f64::consts::TAU / 3.9).sin();
    let spine = DVec3::new(at(0) * 0.35, at(1) * 0.5, at(2) * 0.3);
    let head = DVec3::new(at(3) * 0.25 + 0.5 * breath, at(4) * 0.3, at(5) * 0.25);
    let turns = [
        ("Hips", DVec3::new(0.0, at(6) * 0.25, at(7) * 0.2)),
        ("Spine", spine * 0.30),
        ("Spine1", spine * 0.35 - DVec3::X * 0.3 * breath),
        ("Spine2", spine * 0.35 - DVec3::X * 0.25 * breath),
        ("Neck", head * 0.35),
        ("Neck1", head * 0.25),
        ("Head", head * 0.40),
    ];
    for (name, turn) in turns {
        if let Some(joint) = clip.clip_skeleton().find_joint(name) {
            let [x, y, z] = turn.to_array().map(f64::to_radians);
            pose.rotations[joint] *= DQuat::from_euler(EulerRot::YXZ, y, x, z);
        }
    }
}

/// Bends the fingers slightly more or less, by a number between -1 and 1 for each.
fn fidget(pose: &mut LocalPose, clip: &Clip, side: BodySide, at: impl Fn(usize) -> f64) {
    let prefix = match side {
        BodySide::Left => "Left",
        BodySide::Right => "Right",
    };
    for (finger, name) in ["Index", "Middle", "Ring", "Pinky"].iter().enumerate() {
        for (segment, share) in (1..).zip([1.0, 0.8, 0.5]) {
            let joint = clip.clip_skeleton().find_joint(&format!("{prefix}Hand{name}{segment}"));
            if let Some(joint) = joint {
                let bend = -side.side_sign() * at(finger) * share * 0.008;
                pose.rotations[joint] *= DQuat::from_rotation_z(bend);
            }
        }
    }
}
