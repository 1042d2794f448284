//! Golden cases: all that is found in 67 generated movements, with every number.

use std::fmt::Write as _;

use chereme_sign::hamnosys::sign_hamnosys_text;

use super::super::acts::{ActKind, find_signing_frames};
use super::super::transcribe_hands::find_hand_relation;
use super::super::transcribe_place::{HandsTogether, LikelyHandPlace};
use super::super::transcribe_scene::{HandTrajectory, SignerScene};
use super::super::transcribe_tree::SceneReadings;
use super::super::transcribe_words;
use super::movements::{Case, captured, one_hand, places, two_hands};
use super::*;
use crate::golden::compare;

#[test]
fn golden_transcriptions_of_one_hand_hold_every_number_that_is_found() {
    check("one_hand", &one_hand());
}

#[test]
fn golden_transcriptions_of_places_hold_every_number_that_is_found() {
    check("places", &places());
}

#[test]
fn golden_transcriptions_of_two_hands_hold_every_number_that_is_found() {
    check("two_hands", &two_hands());
}

#[test]
fn golden_transcriptions_of_captured_hands_hold_every_number_that_is_found() {
    check("captured", &captured());
}

fn check(table: &str, cases: &[Case]) {
    let mut text = String::new();
    for case in cases {
        writeln!(text, "## {}", case.name).expect("a text grows");
        let found = features(&mut text, case);
        scores(&mut text, case, &found);
        text.push('\n');
    }
    compare(&format!("transcribed_{table}"), &text);
}

fn names(text: &str) -> String {
    to_names(text).expect("symbols").join(" ")
}

/// Writes what everyone sees: the notation, its stages, and its features with their residuals and runners-up.
fn features(out: &mut String, case: &Case) -> TokenTranscription {
    let found = transcribe_clip(&case.clip, &case.anatomy, &case.options).expect("a sign");
    let mut line = |text: String| writeln!(out, "{text}").expect("a text grows");
    line(format!("notation: {}", names(&sign_hamnosys_text(&found.sign))));
    line(format!("signs: {:?} of {}", found.frames, case.clip.clip_frame_count()));
    for finding in &found.findings {
        line(format!("finding: {finding}"));
    }
    for stage in &found.stages {
        let TranscriptionStage {
            action,
            hand,
            frames,
            text,
        } = stage;
        line(format!("stage {action:?} {hand:?} {frames:?}: {}", names(text)));
    }
    for it in &found.features {
        let next = it.runner_up.as_ref().map_or(String::new(), |next| {
            format!("; then {} ({}) {:?}", next.value, names(&next.text), next.residual)
        });
        line(format!(
            "{} {:?} {:?} at {} in {:?}: {} ({}) {:?}{}{next}",
            it.kind.feature_kind_name(),
            it.action,
            it.hand,
            it.frame,
            it.frames,
            it.value,
            names(&it.text),
            it.residual,
            it.unit.residual_unit_symbol(),
        ));
    }
    found
}

/// Writes what the readings were chosen from: trajectories, acts, and the first three candidates with their scores.
fn scores(out: &mut String, case: &Case, found: &TokenTranscription) {
    let steadied = denoise::steady_trembling_clip(&case.clip);
    let clip = steadied.as_ref().map_or(&case.clip, |it| &it.clip);
    let scene = SignerScene::read_signer_scene(clip, &case.anatomy, &case.options).expect("a scene");
    let sight = SceneReadings::new(&scene, &case.options);
    let mut line = |text: String| writeln!(out, "{text}").expect("a text grows");
    line(format!(
        "scene: arm {:?} shoulders {:?} hand {:?} loose {:?} alone {:?} lead {} slack {:.6}",
        scene.arm,
        scene.shoulders,
        scene.hand,
        scene.loose,
        scene.alone,
        sight.lead,
        precision::expected_place_slack(&scene, &sight)
    ));
    let Some(track) = scene.hands[sight.lead].as_ref() else {
        return;
    };
    let frames = find_signing_frames(&scene, track);
    line(format!("relation: {:?}", find_hand_relation(&scene, &frames)));
    for (n, track) in scene.hands.iter().enumerate() {
        let Some(track) = track else { continue };
        trajectory(&mut line, track);
        let (acts, left) = sight.read_hand_acts(n, track, &frames);
        line(format!("  leaves its first posture at {left:?}"));
        for act in acts {
            let what = match &act.kind {
                ActKind::Path(fitted) => format!("{fitted:?}"),
                other => format!("{other:?}"),
            };
            line(format!(
                "  act {:?} until {} times {} {:?} grows {:?} turned {} reshaped {} with {:?}: {what}",
                act.frames, act.until, act.times, act.repeat, act.grows, act.turned, act.reshaped, act.with
            ));
        }
    }
    let start = found.features.first().map_or(*frames.start(), |it| it.frame);
    let symmetric = matches!(found.sign.parts[0].hands, HandsUsed::Both(_));
    for frame in [start, *frames.end()] {
        candidates(&mut line, &sight, frame, symmetric);
    }
}

fn trajectory(line: &mut impl FnMut(String), track: &HandTrajectory) {
    let last = track.palm.len() - 1;
    line(format!(
        "{:?} hand: rests in {} of {} frames, turns by {:?}, reshapes by {:?}",
        track.side,
        track.rests.iter().filter(|rests| **rests).count(),
        last + 1,
        track.hand_turn_vector(0, last),
        track.finger_angle_change(0, last)
    ));
    let middle = last / 2;
    line(format!(
        "  middle: palm {:?} along {:?} normal {:?}",
        track.palm[middle], track.along[middle], track.normal[middle]
    ));
}

/// Writes the first three candidates of each choice in a frame.
fn candidates(line: &mut impl FnMut(String), sight: &SceneReadings<'_>, frame: usize, symmetric: bool) {
    let Some(body) = sight.cached_body_at(frame) else {
        return;
    };
    for (n, track) in sight.scene.hands.iter().enumerate() {
        let Some(track) = track.as_ref().filter(|it| !it.rests[frame]) else {
            continue;
        };
        line(format!("frame {frame}, {:?} hand", track.side));
        if let Some(it) = sight.read_hand_posture(track, frame).shape {
            let next = it
                .runner_up
                .map(|(shape, off)| (transcribe_words::describe_handshape(&shape).words, off));
            line(format!(
                "  shape {} {:?}, then {next:?}",
                transcribe_words::describe_handshape(&it.best).words,
                it.residual
            ));
        }
        if track.faces {
            for it in sight.read_hand_orientations(track, frame, 3) {
                line(format!(
                    "  turned {} {:?}, palm {} {:?}, beyond {:?} less {:?}",
                    transcribe_words::describe_aim_direction(&it.extended.best).words,
                    it.extended.residual,
                    transcribe_words::describe_palm(&it.palm.best).words,
                    it.palm.residual,
                    it.beyond,
                    it.less
                ));
            }
        }
        let likely = body.rank_hand_places(n, symmetric, 3);
        for it in body.find_hand_place(n, symmetric).into_iter().chain(likely) {
            line(format!("  place {}", placed(&it)));
        }
        for (parts, less) in body.other_parts(n).into_iter().take(3) {
            line(format!("  or by {parts:?}: less {less:?}"));
        }
    }
    if let Some(it) = body.nearest_hands_together() {
        line(format!("  together {}", together(&it)));
    }
    for it in body.likeliest_pairs(tuned().resynthesis.pairs[1]).into_iter().take(3) {
        line(format!("  pair {}", together(&it)));
    }
    if let Some((it, at)) = body.likeliest_constellation(0.0) {
        line(format!("  constellation {} at {}", together(&it), placed(&at)));
    }
}

fn placed(it: &LikelyHandPlace) -> String {
    let found = [
        transcribe_words::describe_body_place(&it.place).words,
        transcribe_words::describe_place_contact(&it.place).words,
    ];
    let next = it.runner_up.as_ref();
    let next = next.map(|(place, off)| (transcribe_words::describe_body_place(place).words, off));
    format!(
        "{}: score {:?} unlikely {:?} residual {:?} distance {:?} small {}, then {next:?}",
        found.join(", "),
        it.score,
        it.unlikely,
        it.residual,
        it.distance,
        it.small
    )
}

fn together(it: &HandsTogether) -> String {
    format!(
        "{:?} {:?} distance {:?} cost {:?} named {}",
        it.parts,
        it.contact,
        it.distance,
        it.together_notation_penalty(),
        it.named
    )
}
