//! Folds repetitions: consecutive circles, to and fro, the same again.

use chereme_sign::hamnosys::RepeatKind;
use glam::DVec3;

use super::super::transcribe_path::PathForm;
use super::super::transcribe_scene::{HandTrajectory, SignerScene, to_rotation_vector};
use super::{ActKind, TranscribedAct};
use crate::transcribe::transcribe_tuned::tuned;

/// Returns the change that an act brings, as one vector: displacement, turn and finger angles, each in
/// units of its usual size.
fn act_change_vector(scene: &SignerScene<'_>, track: &HandTrajectory, act: &TranscribedAct) -> Vec<f64> {
    let (first, last) = (act.first_act_frame(), act.last_act_frame());
    let chord = match &act.kind {
        ActKind::Path(fitted) => fitted.path.path_chord() / (scene.language.move_normal * scene.arm),
        _ => DVec3::ZERO,
    };
    // Opposite turns cancel only in one common frame: that of the body.
    let turn = to_rotation_vector(track.turned[last] * track.turned[first].inverse()) / 0.8;
    let mut all = chord.to_array().to_vec();
    if act.turned {
        all.extend(turn.to_array());
    } else {
        all.extend([0.0; 3]);
    }
    let (a, b) = (track.angles[first].to_array(), track.angles[last].to_array());
    let share = if act.reshaped { 0.25 } else { 0.0 };
    all.extend(a.iter().zip(b).map(|(a, b)| share * (b - a)));
    all
}

fn signed_change_distance(a: &[f64], b: &[f64], sign: f64) -> f64 {
    let off: Vec<f64> = a.iter().zip(b).map(|(x, y)| x - sign * y).collect();
    change_vector_norm(&off) / change_vector_norm(a).max(change_vector_norm(b)).max(1e-9)
}

/// Folds repeated acts into one act each: consecutive circles, to and fro, the same again.
pub(super) fn fold_repeated_acts(
    scene: &SignerScene<'_>,
    track: &HandTrajectory,
    acts: Vec<TranscribedAct>,
) -> Vec<TranscribedAct> {
    let changes: Vec<Vec<f64>> = acts.iter().map(|act| act_change_vector(scene, track, act)).collect();
    let mut folded_acts: Vec<TranscribedAct> = Vec::new();
    let mut n = 0;
    while n < acts.len() {
        // Circles are counted by their turns, so that each ends the run.
        let run = |sign: f64| {
            let mut end = n + 1;
            while end < acts.len()
                && !is_round(&acts[end - 1])
                && signed_change_distance(&changes[end - 1], &changes[end], sign) < tuned().fold.alike
            {
                end += 1;
            }
            end - n
        };
        let mut act = acts[n].clone();
        let rounds = rounds(&acts[n..]);
        // Three strokes to and fro are a repetition; two are there and back.
        let (to_and_fro, on) = (run(-1.0), run(1.0));
        act.grows = match (is_round(&act), to_and_fro >= 3) {
            (true, _) => None,
            (_, true) => execution_growth(&changes[n..n + to_and_fro], 2),
            _ => execution_growth(&changes[n..n + on], 1),
        };
        if is_round(&act) {
            let turns: f64 = acts[n..n + rounds].iter().filter_map(act_circle_turns).sum();
            act.times = (turns.round() as usize).max(1);
            act.repeat = choose_repeat(act.times, RepeatKind::FromStart, RepeatKind::FromStartSeveral);
            act.until = acts[n + rounds - 1].until;
            n += rounds;
        } else if to_and_fro >= 3 {
            // A stroke back counts with the stroke there.
            act.times = to_and_fro.div_ceil(2);
            act.repeat = choose_repeat(act.times, RepeatKind::FromStart, RepeatKind::FromStartSeveral);
            act.until = acts[n + to_and_fro - 1].until;
            n += to_and_fro;
        } else if on >= 2 {
            act.times = on;
            act.repeat = choose_repeat(on, RepeatKind::Continue, RepeatKind::ContinueSeveral);
            act.until = acts[n + on - 1].until;
            n += on;
        } else {
            n += 1;
        }
        folded_acts.push(act);
    }
    folded_acts
}

/// Returns whether the executions grow (true) or shrink (false) in turn; with `step` 2 only every other
/// one counts, as those between lead back.
fn execution_growth(changes: &[Vec<f64>], step: usize) -> Option<bool> {
    let sizes: Vec<f64> = changes
        .iter()
        .step_by(step)
        .map(|change| change_vector_norm(change))
        .collect();
    let by = |least: fn(f64, f64) -> bool| sizes.windows(2).all(|pair| least(pair[0], pair[1]));
    match sizes.len() {
        // Two executions are too few to show growth.
        0..=2 => None,
        _ if by(|a, b| b > tuned().fold.grows * a) => Some(true),
        _ if by(|a, b| a > tuned().fold.grows * b) => Some(false),
        _ => None,
    }
}

fn change_vector_norm(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn choose_repeat(times: usize, once: RepeatKind, several: RepeatKind) -> Option<RepeatKind> {
    match times {
        0 | 1 => None,
        2 => Some(once),
        _ => Some(several),
    }
}

fn act_circle_turns(act: &TranscribedAct) -> Option<f64> {
    match &act.kind {
        ActKind::Path(fitted) => match fitted.path {
            PathForm::Circle { turns, .. } => Some(turns),
            _ => None,
        },
        _ => None,
    }
}

fn is_round(act: &TranscribedAct) -> bool {
    act_circle_turns(act).is_some()
}

/// Returns how many consecutive circles about one axis begin the list.
fn rounds(acts: &[TranscribedAct]) -> usize {
    let axis = |act: &TranscribedAct| match &act.kind {
        ActKind::Path(fitted) => match fitted.path {
            PathForm::Circle { axis, .. } => Some(axis),
            _ => None,
        },
        _ => None,
    };
    let Some(first) = acts.first().and_then(axis) else {
        return 0;
    };
    acts.iter()
        .take_while(|act| axis(act).is_some_and(|axis| axis.dot(first) > 0.7))
        .count()
}

#[cfg(test)]
mod tests {
    use glam::DQuat;

    use super::super::super::tests::{ARM, before_chest, clip};
    use super::super::super::transcribe_path::fit_path_form;
    use super::*;
    use crate::transcribe::TranscribeOptions;

    #[test]
    fn the_change_of_an_act_counts_in_units_of_usual_movements() {
        let usual = chereme_sign::hamnosys::BodyLanguage::default_body_language();
        let own = before_chest(chereme_sign::hamnosys::HandClass::Flat);
        let far = DVec3::X * (usual.move_normal * ARM);
        let (clip, anatomy) = clip(0.4, |time| {
            let turned = own.turned(DQuat::from_rotation_z(0.8 * time));
            [Some(turned.moved(far * time)), None]
        });
        let options = TranscribeOptions::synthesised_options();
        let scene = SignerScene::read_signer_scene(&clip, &anatomy, &options).expect("a scene");
        let mut tracks = scene.hands.iter().flatten();
        let track = tracks.find(|track| track.side == chereme_motion::BodySide::Right);
        let track = track.expect("a hand");
        let last = track.palm.len() - 1;
        let act = |turned: bool| TranscribedAct {
            frames: 0..=last,
            kind: ActKind::Path(Box::new(fit_path_form(&track.palm, 1e-3))),
            with: None,
            turned,
            reshaped: false,
            repeat: None,
            times: 1,
            grows: None,
            until: last,
        };
        let straight = act_change_vector(&scene, track, &act(false));
        // Lengths of arms are measured on the body, to a few hundredths.
        let chord = DVec3::from_slice(&straight[..3]);
        assert!((chord.length() - 1.0).abs() < 0.05, "{chord}");
        assert!(straight[3..].iter().all(|it| *it == 0.0));
        let turned = act_change_vector(&scene, track, &act(true));
        let turn = DVec3::from_slice(&turned[3..6]);
        assert!((turn.length() - 1.0).abs() < 0.01, "{turn}");
        assert_eq!(signed_change_distance(&turned, &turned, 1.0), 0.0);
        assert!((signed_change_distance(&turned, &turned, -1.0) - 2.0).abs() < 1e-12);
    }

    #[test]
    fn executions_grow_only_if_each_is_larger_than_the_one_before() {
        let by = tuned().fold.grows * 1.01;
        let sized = |sizes: &[f64]| sizes.iter().map(|size| vec![0.0, *size]).collect::<Vec<_>>();
        for (sizes, step, grows) in [
            (&[1.0, by, by * by][..], 1, Some(true)),
            (&[by * by, by, 1.0], 1, Some(false)),
            (&[1.0, by, by], 1, None),
            (&[1.0, by], 1, None),
            (&[1.0, 9.0, by, 9.0, by * by], 2, Some(true)),
            (&[1.0, by, 1.0], 1, None),
        ] {
            assert_eq!(execution_growth(&sized(sizes), step), grows, "{sizes:?}");
        }
    }
}
