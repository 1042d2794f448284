//! Tests of the models of captured cued speech on generated sessions, whose truth is known.

use glam::{DQuat, DVec3};

use super::cue_face::FaceModel;
use super::cue_hand::{HandMarkerFrame, HandModel};
use super::cue_labels::{
    FACE_MARKER_COUNT, HAND_MARKER_COUNT, RIGID_HEAD_MARKERS, THROAT_MARKERS, first_finger_marker,
};
use super::cue_targets::{GestureQuartiles, SoughtKey, TargetOptions, find_key_targets, fit_movement};
use super::gauss::{GaussianRecogniser, RecognitionConfusion};
use super::generate::{self, CueGeneratorSettings, GENERATED_FRAME_RATE, GeneratedTake, RandomNumbers};
use super::linear::{DenseMatrix, symmetric_eigenvectors};
use super::pca::{PrincipalComponents, find_guided_components};
use super::rigid::{RigidError, RigidMotion};
use super::{cue_labels, pca};

fn clean() -> CueGeneratorSettings {
    CueGeneratorSettings {
        hidden: 0.0,
        ..CueGeneratorSettings::default()
    }
}

#[test]
fn the_50_hand_and_63_face_labels_are_found_under_any_subject_prefix() {
    assert_eq!(
        (
            cue_labels::hand_marker_names().len(),
            cue_labels::face_marker_names().len()
        ),
        (HAND_MARKER_COUNT, FACE_MARKER_COUNT)
    );
    assert_eq!(cue_labels::hand_marker_names()[first_finger_marker(1) + 7], "M8");
    let wanted = cue_labels::hand_marker_names();
    let found = cue_labels::match_cue_labels(&wanted, &["Anna:fa1", " M8 ", "ghost"]);
    assert_eq!(
        (found[0], found[first_finger_marker(1) + 7], found[1]),
        (Some(0), Some(1), None)
    );
}

#[test]
fn a_rigid_motion_is_recovered_and_points_without_one_are_refused() {
    let mut random = RandomNumbers::new(5);
    let mut point = |sd: f64| DVec3::new(random.random_normal(), random.random_normal(), random.random_normal()) * sd;
    for noise in [0.0, 0.3] {
        for _ in 0..50 {
            let motion = RigidMotion {
                rotation: DQuat::from_scaled_axis(point(1.2)),
                translation: point(300.0),
            };
            let from: Vec<DVec3> = (0..9).map(|_| point(60.0)).collect();
            let to: Vec<Option<DVec3>> = from
                .iter()
                .map(|at| Some(motion.apply_rigid_motion(*at) + point(noise)))
                .collect();
            let found = RigidMotion::fit_rigid_motion(&from, &to).expect("a motion");
            let turn = found.rotation.angle_between(motion.rotation).to_degrees();
            let middle = from.iter().sum::<DVec3>() / 9.0;
            let off = found
                .apply_rigid_motion(middle)
                .distance(motion.apply_rigid_motion(middle));
            let shortest = found.rotation.to_scaled_axis().length();
            assert!(shortest <= std::f64::consts::PI + 1e-9, "{shortest}");
            if noise == 0.0 {
                assert!(off < 1e-9, "{off}");
            } else {
                assert!(off < 0.5 && turn < 0.6, "{off} mm {turn} degrees");
            }
        }
    }
    let line: Vec<DVec3> = (0..5).map(|n| DVec3::X * f64::from(n)).collect();
    let seen = |points: &[DVec3]| points.iter().copied().map(Some).collect::<Vec<_>>();
    assert_eq!(
        RigidMotion::fit_rigid_motion(&line, &seen(&line)),
        Err(RigidError::Line)
    );
    assert_eq!(
        RigidMotion::fit_rigid_motion(&line[..2], &seen(&line[..2])),
        Err(RigidError::Few(2))
    );
    let lost = vec![Some(DVec3::NAN); 5];
    assert_eq!(RigidMotion::fit_rigid_motion(&line, &lost), Err(RigidError::Few(0)));
}

#[test]
fn principal_components_equal_those_of_a_hand_computed_case() {
    let rows = vec![vec![1.0, 1.0], vec![-1.0, -1.0], vec![0.5, -0.5], vec![-0.5, 0.5]];
    let found = PrincipalComponents::fit_principal_components(&rows, 2, 0).expect("components");
    let half = 0.5f64.sqrt();
    assert!((found.directions[0][0] - half).abs() < 1e-9);
    assert!((found.directions[0][1] - half).abs() < 1e-9);
    assert!((found.variances[0] - 1.0).abs() < 1e-9 && (found.variances[1] - 0.25).abs() < 1e-9);
    assert!((found.total - 1.25).abs() < 1e-9);
    // An independent method: power iteration on the covariance.
    let mut random = RandomNumbers::new(3);
    let rows: Vec<Vec<f64>> = (0..200)
        .map(|_| (0..6).map(|k| random.random_normal() * f64::from(k + 1)).collect())
        .collect();
    let (_, covariance) = pca::row_covariance(&rows);
    let mut vector = vec![1.0; 6];
    for _ in 0..20_000 {
        let next: Vec<f64> = (0..6)
            .map(|i| (0..6).map(|j| covariance[(i, j)] * vector[j]).sum::<f64>())
            .collect();
        let length = next.iter().map(|x| x * x).sum::<f64>().sqrt();
        vector = next.iter().map(|x| x / length).collect();
    }
    let found = PrincipalComponents::fit_principal_components(&rows, 1, 0).expect("components");
    let cosine: f64 = vector.iter().zip(&found.directions[0]).map(|(a, b)| a * b).sum();
    assert!((cosine.abs() - 1.0).abs() < 1e-9);
    let hilbert = |i: usize, j: usize| 1.0 / (i + j + 1) as f64;
    let mut matrix = DenseMatrix::zero_matrix(5, 5);
    for i in 0..5 {
        for j in 0..5 {
            matrix[(i, j)] = hilbert(i, j);
        }
    }
    let (values, vectors) = symmetric_eigenvectors(&matrix);
    for (n, value) in values.iter().enumerate() {
        for i in 0..5 {
            let product: f64 = (0..5).map(|j| matrix[(i, j)] * vectors[(n, j)]).sum();
            assert!((product - value * vectors[(n, i)]).abs() < 1e-12);
        }
    }
}

#[test]
fn guided_components_recover_the_components_that_generated_the_data() {
    let mut random = RandomNumbers::new(11);
    let subsets: Vec<Vec<usize>> = (0..7).map(|k| vec![3 * k, 3 * k + 1, 3 * k + 2]).collect();
    let true_directions: Vec<Vec<f64>> = (0..7)
        .map(|k| {
            (0..40)
                .map(|n| match n / 3 {
                    own if own == k => 3.0,
                    own if own < 7 => 0.0,
                    _ => ((n * (k + 2)) as f64).sin(),
                })
                .collect()
        })
        .collect();
    let rows: Vec<Vec<f64>> = (0..4000)
        .map(|_| {
            let own: Vec<f64> = (0..7).map(|_| random.random_normal()).collect();
            (0..40)
                .map(|n| own.iter().zip(&true_directions).map(|(p, d)| p * d[n]).sum::<f64>())
                .collect()
        })
        .collect();
    let found = find_guided_components(&rows, &subsets).expect("components");
    for (own, known) in found.directions.iter().zip(&true_directions) {
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let cosine = dot(own, known).abs() / (dot(own, own) * dot(known, known)).sqrt();
        assert!(cosine > 0.99, "{cosine}");
    }
}

/// Returns the mean distance of visible markers from the model, and of hidden ones from the truth, in millimetres.
fn errors(model: &HandModel, take: &GeneratedTake) -> (f64, f64) {
    let (mut seen, mut hidden) = (Vec::new(), Vec::new());
    let mut before = None;
    for (frame, truth) in take.hand.iter().zip(&take.true_hand) {
        let Some(restored) = model.restore_hand_markers(frame, before.as_ref()) else {
            continue;
        };
        for marker in 0..HAND_MARKER_COUNT {
            let said = restored.points[marker];
            match frame[marker] {
                Some(at) => seen.push(said.distance(at)),
                None => hidden.push(said.distance(truth[marker])),
            }
        }
        before = Some(restored);
    }
    let mean = |all: &[f64]| all.iter().sum::<f64>() / all.len().max(1) as f64;
    (mean(&seen), mean(&hidden))
}

#[test]
fn hidden_markers_of_a_hand_are_restored_without_being_read() {
    let model =
        HandModel::learn_hand_model(&generate::generate_shape_transitions(&clean(), 1).hand, 12).expect("a model");
    let take = generate::generate_random_sentence(&CueGeneratorSettings::default(), 3, 6);
    let (seen, hidden) = errors(&model, &take);
    assert!(seen < 4.0 && hidden < 6.0, "{seen} {hidden}");
    let frame: HandMarkerFrame = take.hand[200].clone();
    let mut nan = frame.clone();
    for (own, seen) in nan.iter_mut().zip(&frame) {
        if seen.is_none() {
            *own = Some(DVec3::NAN);
        }
    }
    let (one, two) = (
        model.restore_hand_markers(&frame, None),
        model.restore_hand_markers(&nan, None),
    );
    let (one, two) = (one.expect("restored"), two.expect("restored"));
    assert_eq!(one.points, two.points, "bit by bit");
    assert_eq!(
        one.seen.iter().filter(|seen| !**seen).count(),
        frame.iter().filter(|at| at.is_none()).count()
    );
    let whole = generate::generate_random_sentence(&clean(), 3, 6).hand[200].clone();
    let mut without = whole.clone();
    without[first_finger_marker(2)..first_finger_marker(2) + 8].fill(None);
    let known = model.restore_hand_markers(&whole, None).expect("restored");
    let gone = model.restore_hand_markers(&without, None).expect("restored");
    let tip = first_finger_marker(2) + 7;
    assert!(gone.sd[tip] > known.sd[tip], "a hidden finger is uncertain");
    assert!(
        model
            .restore_hand_markers(&vec![None; HAND_MARKER_COUNT], None)
            .is_none()
    );
    assert!(model.restore_hand_markers(&Vec::new(), None).is_none());
}

#[test]
fn the_weights_of_the_throat_are_recovered() {
    let settings = clean();
    let mut frames = Vec::new();
    for number in 0..3 {
        frames.extend(
            generate::generate_random_sentence(&settings, number, 8)
                .face
                .into_iter()
                .step_by(4),
        );
    }
    let model = FaceModel::learn_face_model(&frames).expect("a model");
    for (n, truth) in generate::throat_weights().into_iter().enumerate() {
        let found = model.weights[THROAT_MARKERS.start + n];
        assert!((found - truth).abs() < 0.1, "TH{}: {found} for {truth}", n + 1);
    }
    let take = generate::generate_random_sentence(&settings, 99, 6);
    let (mut sum, mut count) = (0.0, 0.0);
    for frame in take.face.iter().step_by(5) {
        let (motion, own) = model.estimate_face_parameters(frame).expect("a head");
        for (at, said) in frame.iter().zip(model.place_face_markers(&motion, &own)) {
            sum += at.map_or(0.0, |at| at.distance(said));
            count += 1.0;
        }
    }
    assert!(sum / count < 1.0, "{} mm", sum / count);
    assert_eq!(model.estimate_face_parameters(&vec![None; FACE_MARKER_COUNT]), None);
    assert!(FaceModel::learn_face_model(&frames[..RIGID_HEAD_MARKERS.len()]).is_err());
}

#[test]
fn the_predicted_error_of_a_face_agrees_with_the_error() {
    let learnt = generate::generate_random_sentence(&clean(), 0, 12).face;
    let frames: Vec<HandMarkerFrame> = learnt.into_iter().step_by(3).collect();
    let model = FaceModel::learn_face_model(&frames).expect("a model");
    let take = generate::generate_random_sentence(&clean(), 99, 6);
    let (mut square, mut count) = (0.0, 0.0);
    for frame in take.face.iter().step_by(5) {
        let (_, _, known) = model.restore_face_markers(frame).expect("a head");
        let mut hidden = frame.clone();
        hidden[super::cue_labels::LIP_MARKERS].fill(None);
        let (_, points, sd) = model.restore_face_markers(&hidden).expect("a head");
        for marker in super::cue_labels::LIP_MARKERS {
            assert!(sd[marker] > known[marker], "a hidden marker is less certain");
            let Some(at) = frame[marker] else { continue };
            square += at.distance_squared(points[marker]) / (3.0 * sd[marker].powi(2));
            count += 1.0;
        }
        for marker in RIGID_HEAD_MARKERS {
            assert!((0.01..2.0).contains(&known[marker]), "{}", known[marker]);
        }
    }
    let ratio: f64 = square / count;
    assert!((0.2..5.0).contains(&ratio), "{ratio}");
}

type Examples = Vec<(u8, Vec<f64>)>;

/// Returns the seven distances and the tip at the true targets of takes.
fn at_targets(takes: &[GeneratedTake]) -> (Examples, Examples) {
    let (mut shapes, mut places) = (Vec::new(), Vec::new());
    for take in takes {
        for key in &take.keys {
            let frame = ((key.times[1] * GENERATED_FRAME_RATE).round() as usize).min(take.true_hand.len() - 1);
            let points = &take.true_hand[frame];
            if let (Some(seven), Some(tip)) = (
                HandModel::shape_distances(points),
                HandModel::pointing_fingertip(points, key.shape),
            ) {
                shapes.push((key.shape, seven.to_vec()));
                places.push((
                    key.placement,
                    take.head[frame].undo_rigid_motion(tip).to_array().to_vec(),
                ));
            }
        }
    }
    (shapes, places)
}

#[test]
fn shapes_and_placements_of_unseen_sentences_are_recognised() {
    let of = |numbers: std::ops::Range<u64>| -> Vec<GeneratedTake> {
        numbers
            .map(|n| generate::generate_random_sentence(&clean(), n, 10))
            .collect()
    };
    let (shapes, places) = at_targets(&of(0..20));
    let (new_shapes, new_places) = at_targets(&of(100..110));
    let by_shape = GaussianRecogniser::learn_gaussian_classes(&shapes, 0.25).expect("shapes");
    let by_place = GaussianRecogniser::learn_gaussian_classes(&places, 0.25).expect("places");
    let rates = [
        RecognitionConfusion::count_confusions(&by_shape, &new_shapes).correct_recognition_rate(),
        RecognitionConfusion::count_confusions(&by_place, &new_places).correct_recognition_rate(),
    ];
    assert!(rates[0] > 0.9 && rates[1] > 0.9, "{rates:?}");
    assert!(GaussianRecogniser::learn_gaussian_classes(&[], 0.25).is_err());
    assert!(GaussianRecogniser::learn_gaussian_classes(&[(1, vec![f64::NAN]), (2, vec![0.0])], 0.25).is_err());
}

#[test]
fn targets_found_by_dynamic_programming_equal_an_exhaustive_search() {
    let mut random = RandomNumbers::new(21);
    let options = TargetOptions {
        window: 0.04,
        apart: 0.02,
        ..TargetOptions::default()
    };
    for _ in 0..100 {
        let frame_time = 0.01;
        let speed: Vec<f64> = (0..20).map(|_| random.random_share()).collect();
        let keys: Vec<SoughtKey> = (0..3)
            .map(|n| SoughtKey {
                a1: 0.05 + 0.05 * f64::from(n),
                log: (0..20).map(|_| -3.0 * random.random_share()).collect(),
            })
            .collect();
        let found = find_key_targets(&keys, &speed, frame_time, &options).expect("targets");
        let mut sorted = speed.clone();
        sorted.sort_by(f64::total_cmp);
        let median = sorted[10];
        let score = |frames: &[usize]| -> f64 {
            let each = keys.iter().zip(frames).map(|(key, frame)| {
                let near = (*frame as f64 * frame_time - key.a1) / options.spread;
                key.log[*frame] - 0.5 * (speed[*frame] / median).powi(2) - 0.5 * near * near
            });
            each.sum()
        };
        let mut best = f64::NEG_INFINITY;
        for (a, b, c) in (0..20usize).flat_map(|a| (0..20).flat_map(move |b| (0..20).map(move |c| (a, b, c)))) {
            let near = |frame: usize, key: &SoughtKey| {
                let first = ((key.a1 - 0.04) / frame_time).round() as usize;
                let last = ((key.a1 + 0.04) / frame_time).round() as usize;
                (first..=last).contains(&frame)
            };
            if near(a, &keys[0]) && near(b, &keys[1]) && near(c, &keys[2]) && a + 2 <= b && b + 2 <= c {
                best = best.max(score(&[a, b, c]));
            }
        }
        assert!((score(&found) - best).abs() < 1e-9);
    }
    let close = vec![
        SoughtKey {
            a1: 0.0,
            log: Vec::new()
        };
        50
    ];
    assert_eq!(find_key_targets(&close, &[0.0; 3], 0.01, &options), None, "no room");
    assert_eq!(find_key_targets(&close, &[], 0.01, &options), None);
}

#[test]
fn the_start_and_end_of_a_minimum_jerk_movement_are_recovered() {
    let course = chereme_motion::InterpolationKind::MinimumJerk;
    let (start, end) = (0.31, 0.56);
    let mut random = RandomNumbers::new(8);
    for noise in [0.0, 0.4] {
        let rows: Vec<Vec<f64>> = (0..120)
            .map(|frame| {
                let share = course.interpolation_share(
                    ((f64::from(frame) / GENERATED_FRAME_RATE - start) / (end - start)).clamp(0.0, 1.0),
                );
                let ends = [(10.0, 40.0), (-3.0, 2.0), (0.0, 0.0)];
                ends.map(|(a, b)| a + (b - a) * share + noise * random.random_normal())
                    .to_vec()
            })
            .collect();
        let found = fit_movement(
            |frame| rows.get(frame).map(Vec::as_slice),
            20..=80,
            1.0 / GENERATED_FRAME_RATE,
        )
        .expect("a way");
        let off = (found.start - start).abs().max((found.end - end).abs());
        assert!(off < if noise == 0.0 { 0.001 } else { 0.009 }, "{found:?}");
        assert!((found.length - 30.4).abs() < 1.0 && found.explained > 0.98, "{found:?}");
    }
    assert_eq!(
        fit_movement(|_| Some(&[1.0][..]), 0..=50, 1.0 / GENERATED_FRAME_RATE),
        None,
        "nothing moves"
    );
    assert_eq!(fit_movement(|_| None, 0..=50, 1.0 / GENERATED_FRAME_RATE), None);
    assert_eq!(
        fit_movement(|_| Some(&[f64::NAN][..]), 0..=50, 1.0 / GENERATED_FRAME_RATE),
        None
    );
    assert_eq!(
        GestureQuartiles::quartiles_from_numbers(&[4.0, 1.0, 3.0, 2.0, 5.0]).map(|q| (q.low, q.median, q.high)),
        Some((2.0, 3.0, 4.0))
    );
    assert_eq!(GestureQuartiles::quartiles_from_numbers(&[f64::NAN]), None);
}

#[test]
fn a_generated_hand_rests_in_its_shape_between_its_movements() {
    let take = generate::generate_random_sentence(&clean(), 7, 6);
    let mut held = 0;
    for pair in take.keys.windows(2) {
        let [from, to] = [pair[0].times[3], pair[1].times[2]].map(|time| time * GENERATED_FRAME_RATE);
        let (from, to) = (from.ceil() as usize, to.floor() as usize);
        let shape = generate::shape_angles(pair[0].shape);
        for frame in from..to.max(from) {
            held += 1;
            let now = take.true_angles[frame];
            assert!(frame == from || now == take.true_angles[frame - 1], "{frame}");
            let off = (0..20).map(|k| (now[k] - shape[k]).abs().to_degrees());
            assert!(off.fold(0.0, f64::max) < 60.0, "{frame}: {now:?}");
        }
    }
    assert!(held > 10, "{held} frames");
}

#[test]
fn generated_hands_and_faces_move_without_jumps() {
    for number in 0..4 {
        let take = generate::generate_random_sentence(&clean(), number, 6);
        for (all, most) in [(&take.true_hand, 150.0), (&take.true_face, 8.0)] {
            for (n, pair) in all.windows(2).enumerate() {
                for (a, b) in pair[0].iter().zip(&pair[1]) {
                    let far = a.distance(*b);
                    assert!(far < most, "{number}: {far} mm after frame {n}");
                }
            }
        }
    }
}

#[test]
fn a_session_is_the_same_for_the_same_seed() {
    let one = generate::generate_random_sentence(&CueGeneratorSettings::default(), 7, 5);
    let two = generate::generate_random_sentence(&CueGeneratorSettings::default(), 7, 5);
    assert_eq!((one.hand.clone(), one.keys.clone()), (two.hand, two.keys));
    let hidden = one.hand.iter().flatten().filter(|at| at.is_none()).count();
    let share = hidden as f64 / (one.hand.len() * HAND_MARKER_COUNT) as f64;
    assert!((0.03..0.35).contains(&share), "{share}");
}
