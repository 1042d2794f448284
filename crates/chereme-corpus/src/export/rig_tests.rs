//! Tests of movement on the bones of avatars: imported again, arms move as in the capture.

use std::path::{Path, PathBuf};

use chereme_motion::glam::DVec3;
use chereme_motion::{BodyPart, BodySide, HandFinger};

use super::tests::{Place, address};
use super::{ExportOptions, ExportReport, MovementForm};
use crate::error::CorpusResult;
use crate::picture::DisplayedMovement;
use crate::{Corpus, ProgressReceiver, ignore_progress_step};

fn export_shaped(corpus: &Corpus, to: &Path, movement: MovementForm) -> CorpusResult<ExportReport> {
    let mut hear = ignore_progress_step;
    let options = ExportOptions {
        movement,
        ..ExportOptions::default()
    };
    corpus.export_corpus(
        &address("recording:1"),
        to,
        &options,
        &mut ProgressReceiver::new(&mut hear),
    )
}

fn form(avatar: &str) -> MovementForm {
    MovementForm::read_movement_form(Some(avatar), None, false).expect("a known avatar")
}

/// Returns the places of a hand's joints from the shoulder, in metres.
fn hand_places(movement: &DisplayedMovement, side: BodySide, frame: usize) -> Vec<DVec3> {
    let joint = |part: BodyPart| movement.anatomy.part_joint(part).unwrap_or_else(|| panic!("no {part}"));
    let pose = movement.clip.model_pose(frame);
    let from = pose.model_joint_position(joint(BodyPart::UpperArm(side)));
    let mut parts = vec![BodyPart::Forearm(side), BodyPart::Hand(side), BodyPart::Thumb(side, 2)];
    parts.extend(HandFinger::ALL_FINGERS.map(|finger| BodyPart::Finger(side, finger, 3)));
    parts
        .into_iter()
        .map(|part| pose.model_joint_position(joint(part)) - from)
        .collect()
}

fn starter_file() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus/bol.bvh")
}

#[test]
fn hands_move_on_the_bones_of_every_avatar_as_they_were_captured() {
    let mut place = Place::new();
    let corpus = place.corpus(&[starter_file()]);
    let first = "recording:1".parse().expect("an address");
    let before = corpus.movement_at_address(&first).expect("a movement");
    for avatar in MovementForm::avatar_names() {
        for ending in ["bvh", "glb"] {
            let to = place.path(&format!("{avatar}.{ending}"));
            export_shaped(&corpus, &to, form(avatar)).expect("written");
            let again = place.corpus(std::slice::from_ref(&to));
            let after = again.movement_at_address(&first).expect("a movement");
            assert_eq!(
                after.clip.clip_frame_count(),
                before.clip.clip_frame_count(),
                "{avatar} {ending}"
            );
            for frame in (0..before.clip.clip_frame_count()).step_by(7) {
                for side in BodySide::BOTH_SIDES {
                    let [then, now] = [&before, &after].map(|movement| hand_places(movement, side, frame));
                    let off = then
                        .iter()
                        .zip(&now)
                        .map(|(then, now)| then.distance(*now))
                        .fold(0.0, f64::max);
                    // Joints of the palm that an avatar lacks bend a little.
                    assert!(off < 5e-4, "{avatar} {ending} {side:?} {frame}: {off} m");
                }
            }
        }
    }
}

#[test]
fn bones_rest_in_the_posture_and_with_the_names_of_the_avatar() {
    let mut place = Place::new();
    let corpus = place.corpus(&[starter_file()]);
    for (avatar, [shoulder, elbow], direction) in [
        ("mixamo", ["mixamorig:LeftArm", "mixamorig:LeftForeArm"], DVec3::X),
        (
            "ue5",
            ["upperarm_r", "lowerarm_r"],
            DVec3::new(-1.0, -1.0, 0.0).normalize(),
        ),
    ] {
        let to = place.path(&format!("{avatar}.bvh"));
        export_shaped(&corpus, &to, form(avatar)).expect("written");
        let text = std::fs::read_to_string(&to).expect("text");
        assert!(text.contains(&format!("JOINT {shoulder}\n")), "{avatar}");
        let after = text.split(&format!("JOINT {elbow}\n")).nth(1).expect("an elbow");
        let offset = after
            .split("OFFSET ")
            .nth(1)
            .and_then(|rest| rest.lines().next())
            .expect("an offset");
        let numbers: Vec<f64> = offset
            .split_whitespace()
            .map(|number| number.parse().expect("a number"))
            .collect();
        let bone = DVec3::from_slice(&numbers);
        assert!(bone.normalize().distance(direction) < 1e-4, "{avatar}: {bone}");
        assert!((20.0..40.0).contains(&bone.length()), "centimetres: {bone}");
    }
}

#[test]
fn another_rate_keeps_the_time_and_hips_in_place_stay_where_they_are() {
    let mut place = Place::new();
    let corpus = place.corpus(&[starter_file()]);
    let first = "recording:1".parse().expect("an address");
    let before = corpus.movement_at_address(&first).expect("a movement");
    let movement = MovementForm::read_movement_form(None, Some(25.0), true).expect("a form");
    for ending in ["bvh", "glb", "vrma"] {
        let to = place.path(&format!("slow.{ending}"));
        export_shaped(&corpus, &to, movement.clone()).expect("written");
        let again = place.corpus(std::slice::from_ref(&to));
        let after = again.movement_at_address(&first).expect("a movement");
        assert_eq!(after.clip.clip_frame_rate().per_second(), 25.0, "{ending}");
        let [then, now] = [&before, &after].map(|movement| movement.clip.clip_span().span_seconds());
        assert!((then - now).abs() < 0.04, "{ending}: {then} {now}");
        let hips = after.anatomy.part_joint(BodyPart::Hips).expect("hips");
        let path = after.clip.joint_path(hips);
        let moved = path.iter().map(|place| (*place - path[0]) * DVec3::new(1.0, 0.0, 1.0));
        assert!(moved.map(DVec3::length).fold(0.0, f64::max) < 1e-5, "{ending}");
    }
}

#[test]
fn what_is_no_movement_or_no_avatar_is_refused_with_a_remedy() {
    let mut place = Place::new();
    let corpus = place.corpus(&[starter_file()]);
    for (avatar, rate, wanted) in [
        (Some("mixamoo"), None, "mixamo, rigify"),
        (Some("{}"), None, "\"bones\""),
        (None, Some(0.0), "frames a second"),
        (None, Some(f64::NAN), "frames a second"),
    ] {
        let error = MovementForm::read_movement_form(avatar, rate, false).expect_err("refused");
        let remedy = error.error_remedy().expect("a remedy");
        let remedy = remedy.remedy_advice().unwrap_or_default();
        assert!(remedy.contains(wanted), "{avatar:?} {rate:?}: {error} {remedy}");
    }
    for (name, wanted) in [("a.csv", "only movement"), ("a.vrma", "bones of VRM")] {
        let error = export_shaped(&corpus, &place.path(name), form("unity")).expect_err("refused");
        assert!(error.to_string().contains(wanted), "{name}: {error}");
    }
}
