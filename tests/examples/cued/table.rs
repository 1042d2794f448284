//! The main table: the accuracy with which models recover the known truth of generated sessions.

use std::time::Instant;

use chereme_analysis::cue::cue_face::FaceModel;
use chereme_analysis::cue::cue_hand::{HandModel, RestoredHand};
use chereme_analysis::cue::cue_labels::{HAND_MARKER_COUNT, THROAT_MARKERS, first_finger_marker};
use chereme_analysis::cue::cue_targets::GestureQuartiles;
use chereme_analysis::cue::gauss::{GaussianRecogniser, RecognitionConfusion};
use chereme_analysis::cue::generate::{self, CueGeneratorSettings, GENERATED_FRAME_RATE, GeneratedTake};
use chereme_analysis::cue::session::{self, FollowedTake, KeySounds};
use chereme_motion::glam::DVec3;

use super::{exact, made};

/// The rows so far, as Markdown.
pub(crate) struct Table {
    text: String,
    passed: usize,
    rows: usize,
}

impl Table {
    pub(crate) fn row(&mut self, what: &str, found: &str, wanted: &str, passes: bool) {
        self.rows += 1;
        self.passed += usize::from(passes);
        let word = if passes { "yes" } else { "**no**" };
        let row = format!("| {what} | {found} | {wanted} | {word} |\n");
        eprint!("{row}");
        self.text += &row;
    }
}

/// Returns the whole table, with the confusion tables of the recognisers below it.
pub(crate) fn made() -> String {
    let mut table = Table {
        text: "| on generated sessions | found | wanted | reached |\n|---|---|---|---|\n".to_owned(),
        passed: 0,
        rows: 0,
    };
    exact::rows(&mut table);
    let (hand_model, face_model) = training(&mut table);
    hand(&mut table, &hand_model);
    face(&mut table, &face_model);
    let tables = recognisers(&mut table);
    phases(&mut table);
    made::dictionary(&mut table);
    made::cuer(&mut table);
    let mut text = table.text;
    text += &format!("\n{} of {} rows reach what is wanted.\n", table.passed, table.rows);
    for (name, confusion) in tables {
        text += &format!("\n{name}, produced in rows and recognised in columns:\n\n```\n{confusion}\n```\n");
    }
    text
}

pub(crate) fn takes(settings: &CueGeneratorSettings, numbers: std::ops::Range<u64>) -> Vec<GeneratedTake> {
    numbers
        .map(|n| generate::generate_random_sentence(settings, n, 14))
        .collect()
}

pub(crate) fn clean() -> CueGeneratorSettings {
    CueGeneratorSettings {
        hidden: 0.0,
        ..CueGeneratorSettings::default()
    }
}

#[derive(Default)]
struct Errors {
    seen: Vec<f64>,
    axis: Vec<f64>,
    hidden: Vec<f64>,
    covered: usize,
}

fn mean(all: &[f64]) -> f64 {
    all.iter().sum::<f64>() / all.len().max(1) as f64
}

fn errors(model: &HandModel, takes: &[GeneratedTake]) -> Errors {
    let mut found = Errors::default();
    for take in takes {
        let mut before: Option<RestoredHand> = None;
        for (frame, truth) in take.hand.iter().zip(&take.true_hand) {
            let Some(restored) = model.restore_hand_markers(frame, before.as_ref()) else {
                continue;
            };
            for marker in 0..HAND_MARKER_COUNT {
                match frame[marker] {
                    Some(at) => {
                        let apart = restored.points[marker] - at;
                        found.seen.push(apart.length());
                        found.axis.extend(apart.abs().to_array());
                    }
                    None => {
                        let off = restored.points[marker].distance(truth[marker]);
                        found.hidden.push(off);
                        found.covered += usize::from(off <= 2.795 * restored.sd[marker]);
                    }
                }
            }
            before = Some(restored);
        }
    }
    found.hidden.sort_by(f64::total_cmp);
    found
}

/// Trains both models, and compares them with numpy if `CHEREME_PYTHON` names a Python that has it.
fn training(table: &mut Table) -> (HandModel, FaceModel) {
    let free = generate::generate_shape_transitions(&CueGeneratorSettings::default(), 2);
    let whole: Vec<_> = takes(&clean(), 0..12).into_iter().flat_map(|it| it.face).collect();
    let start = Instant::now();
    let hand = HandModel::learn_hand_model(&free.hand, 12).expect("a model");
    let own = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let face = FaceModel::learn_face_model(&whole).expect("a face");
    let took = [own, start.elapsed().as_secs_f64()];
    let frames = [free.hand.len(), whole.len()];
    let peer = numpy(frames);
    for (n, part) in ["hand", "face"].into_iter().enumerate() {
        let beside = match peer {
            Ok(peer) => format!(
                "; numpy {:.2} s for as many: {:.1} times as long",
                peer[n],
                peer[n] / took[n]
            ),
            Err(why) => format!("; {why}"),
        };
        table.row(
            &format!("training of the {part}'s model, one core"),
            &format!("{:.2} s for {} frames{beside}", took[n], frames[n]),
            "< 5 s for 10,000",
            took[n] * 10_000.0 / (frames[n] as f64) < 5.0,
        );
    }
    (hand, face)
}

/// Returns the seconds that numpy needs on one core for the work of both models.
fn numpy(frames: [usize; 2]) -> Result<[f64; 2], &'static str> {
    let program = std::env::var_os("CHEREME_PYTHON").ok_or("CHEREME_PYTHON is not set")?;
    let peer = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/cued/peer.py");
    let done = std::process::Command::new(program)
        .arg(peer)
        .args(frames.map(|it| it.to_string()))
        .envs([("OMP_NUM_THREADS", "1"), ("OPENBLAS_NUM_THREADS", "1")])
        .output()
        .map_err(|_| "CHEREME_PYTHON cannot be run")?;
    let said = String::from_utf8_lossy(&done.stdout);
    let mut times = said.lines().map(str::parse);
    match (times.next(), times.next()) {
        (Some(Ok(hand)), Some(Ok(face))) => Ok([hand, face]),
        _ => Err("CHEREME_PYTHON has no numpy"),
    }
}

fn hand(table: &mut Table, model: &HandModel) {
    let free = generate::generate_shape_transitions(&CueGeneratorSettings::default(), 2);
    let train = errors(model, &takes(&CueGeneratorSettings::default(), 0..4));
    let test = errors(model, &takes(&CueGeneratorSettings::default(), 100..108));
    let (seen, axis) = (mean(&test.seen), mean(&test.axis));
    table.row(
        "hand, 12 components, visible markers, unseen sentences",
        &format!(
            "{seen:.2} mm, {axis:.2} mm an axis, {:.2} times the first",
            seen / mean(&train.seen)
        ),
        "≤ 2.5 mm, ≤ 1.25 an axis, ≤ 1.1 times",
        seen <= 2.5 && axis <= 1.25 && seen <= 1.1 * mean(&train.seen),
    );
    let far = test.hidden[test.hidden.len() * 95 / 100];
    table.row(
        "hand, 12 components, hidden markers against truth",
        &format!(
            "{:.2} mm, 95 % within {far:.1} (n = {})",
            mean(&test.hidden),
            test.hidden.len()
        ),
        "≤ 3.5 mm, 95 % within 10",
        mean(&test.hidden) <= 3.5 && far <= 10.0,
    );
    let covered = 100.0 * test.covered as f64 / test.hidden.len() as f64;
    table.row(
        "errors within what is predicted for 95 of 100",
        &format!("{covered:.1} %"),
        "90–100 %",
        covered >= 90.0,
    );
    let wide = HandModel::learn_hand_model(&free.hand, 20).expect("a model");
    let wide = errors(&wide, &takes(&CueGeneratorSettings::default(), 100..108));
    let far = wide.hidden[wide.hidden.len() * 95 / 100];
    let (seen, hidden) = (mean(&wide.seen), mean(&wide.hidden));
    table.row(
        "hand, 20 components (those of `restore`), visible and hidden",
        &format!("{seen:.2} mm; {hidden:.2} mm, 95 % within {far:.1}"),
        "≤ 2.0 mm; ≤ 3.5 mm, 95 % within 10",
        seen <= 2.0 && hidden <= 3.5 && far <= 10.0,
    );
    let take = generate::generate_random_sentence(&clean(), 300, 8);
    let mut grown = Vec::new();
    for share in [0.2, 0.4, 0.6] {
        let mut hidden = take.clone();
        let mut random = generate::RandomNumbers::new(9);
        for at in hidden.hand.iter_mut().flatten() {
            if random.random_share() < share {
                *at = None;
            }
        }
        grown.push(mean(&errors(model, &[hidden]).hidden));
    }
    table.row(
        "20, 40, 60 % hidden",
        &format!("{:.2}, {:.2}, {:.2} mm", grown[0], grown[1], grown[2]),
        "grows",
        grown[0] <= grown[1] && grown[1] <= grown[2],
    );
    let mut gone = take.hand[120].clone();
    gone[first_finger_marker(2)..first_finger_marker(2) + 8].fill(None);
    let sd = model
        .restore_hand_markers(&gone, None)
        .map_or(0.0, |it| it.sd[first_finger_marker(2) + 7] * 3f64.sqrt());
    table.row(
        "a finger wholly hidden: predicted sd of its tip",
        &format!("{sd:.1} mm"),
        "> 8 mm",
        sd > 8.0,
    );
    let mut scrambled = take.hand[120].clone();
    scrambled[20] = Some(DVec3::NAN);
    let mut hidden = take.hand[120].clone();
    hidden[20] = None;
    let same = model.restore_hand_markers(&scrambled, None).map(|it| it.points)
        == model.restore_hand_markers(&hidden, None).map(|it| it.points);
    table.row(
        "hidden values are not looked at",
        if same { "bit by bit" } else { "differ" },
        "bit by bit",
        same,
    );
}

fn face(table: &mut Table, model: &FaceModel) {
    let settings = CueGeneratorSettings::default();
    let mut frames = Vec::new();
    for take in takes(&settings, 0..12) {
        frames.extend(take.face.into_iter().step_by(5));
    }
    let error = |frames: &[chereme_analysis::cue::cue_face::FaceMarkerFrame]| {
        let mut all = Vec::new();
        for frame in frames {
            if let Some((motion, own)) = model.estimate_face_parameters(frame) {
                let said = model.place_face_markers(&motion, &own);
                all.extend(
                    frame
                        .iter()
                        .zip(said)
                        .filter_map(|(at, said)| at.map(|at| at.distance(said))),
                );
            }
        }
        mean(&all)
    };
    let test: Vec<_> = takes(&settings, 200..206)
        .into_iter()
        .flat_map(|it| it.face.into_iter().step_by(5))
        .collect();
    let (first, second) = (error(&frames), error(&test));
    table.row(
        "face, visible markers, unseen sentences",
        &format!("{second:.2} mm, {:.2} times the first", second / first),
        "≤ 1 mm, ≤ 1.1 times",
        second <= 1.0 && second <= 1.1 * first,
    );
    let off = generate::throat_weights().into_iter().enumerate();
    let off = off
        .map(|(n, truth)| (model.weights[THROAT_MARKERS.start + n] - truth).abs())
        .fold(0.0, f64::max);
    table.row(
        "weights of the throat, the worst",
        &format!("{off:.3}"),
        "± 0.05",
        off <= 0.05,
    );
}

pub(crate) type Examples = Vec<(u8, Vec<f64>)>;

pub(crate) fn at_targets(takes: &[GeneratedTake]) -> (Examples, Examples) {
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

fn recognisers(table: &mut Table) -> Vec<(&'static str, RecognitionConfusion)> {
    let rates = |scatter: f64| {
        let settings = CueGeneratorSettings { scatter, ..clean() };
        let (shapes, places) = at_targets(&takes(&settings, 0..68));
        let (new_shapes, new_places) = at_targets(&takes(&settings, 100..180));
        let shape = RecognitionConfusion::count_confusions(
            &GaussianRecogniser::learn_gaussian_classes(&shapes, 0.25).expect("shapes"),
            &new_shapes,
        );
        let place = RecognitionConfusion::count_confusions(
            &GaussianRecogniser::learn_gaussian_classes(&places, 0.25).expect("places"),
            &new_places,
        );
        (shape, place)
    };
    let ((shape, place), (still, _)) = (rates(8.0), rates(4.0));
    let percent = |confusion: &RecognitionConfusion| 100.0 * confusion.correct_recognition_rate();
    table.row(
        "shapes, angles scattered by 8°",
        &format!("{:.1} %", percent(&shape)),
        "≥ 96 %",
        shape.correct_recognition_rate() >= 0.96,
    );
    table.row(
        "shapes, angles scattered by 4°",
        &format!("{:.1} %", percent(&still)),
        "≥ 99.5 %",
        still.correct_recognition_rate() >= 0.995,
    );
    table.row(
        "placements, one cuer",
        &format!("{:.1} %", percent(&place)),
        "≥ 98 %",
        place.correct_recognition_rate() >= 0.98,
    );
    vec![("Shapes at 8°", shape), ("Placements", place)]
}

fn sounds_of(take: &GeneratedTake) -> Vec<session::ExpectedCueKey> {
    let keys = take.keys.iter().map(|key| session::ExpectedCueKey {
        kind: KeySounds::ALL_KEY_SOUNDS[key.kind],
        placement: key.placement,
        shape: key.shape,
        a1: key.sound[0],
        a2: key.sound[1],
        a3: key.sound[2],
    });
    keys.collect()
}

/// Targets found from markers as cameras see them: the kind of key, the start of its sound, and the true and the found
/// begin and end of the hand's movement.
fn found_phases(
    settings: &CueGeneratorSettings,
    sentences: std::ops::Range<u64>,
) -> Vec<(KeySounds, f64, [f64; 2], [f64; 2])> {
    let takes = takes(settings, sentences);
    let rigid = session::rigid_set(takes.iter().flat_map(|take| take.face.iter()));
    let keys: Vec<Vec<session::ExpectedCueKey>> = takes.iter().map(sounds_of).collect();
    let followed: Vec<FollowedTake> = takes
        .iter()
        .map(|take| FollowedTake::of_seen(&take.hand, &take.face, rigid.as_deref(), GENERATED_FRAME_RATE))
        .collect();
    let pairs: Vec<(&FollowedTake, &[session::ExpectedCueKey])> = followed
        .iter()
        .zip(&keys)
        .map(|(take, keys)| (take, keys.as_slice()))
        .collect();
    let Ok((_, shown)) = session::find_key_gestures(&pairs) else {
        return Vec::new();
    };
    let mut all = Vec::new();
    for (take, shown) in takes.iter().zip(shown) {
        for ((key, own), kind) in take.keys.iter().zip(shown).zip(sounds_of(take)) {
            if own.hand.measured {
                let truth = [key.times[0], key.times[1]];
                let found = [own.hand.movement.start, own.hand.movement.end];
                all.push((kind.kind, key.sound[0], truth, found));
            }
        }
    }
    all
}

/// Returns the median and the ninth decile.
fn half_and_most(mut off: Vec<f64>) -> (f64, f64) {
    off.sort_by(f64::total_cmp);
    let at = |share: usize| off.get(off.len() * share / 10).copied().unwrap_or(f64::NAN);
    (at(5), at(9))
}

fn phases(table: &mut Table) {
    let settings = clean();
    let found = found_phases(&settings, 0..40);
    for (n, name) in ["begin of the hand's movement", "targets of the hand found"]
        .into_iter()
        .enumerate()
    {
        let off = found.iter().map(|it| (it.3[n] - it.2[n]).abs() * 1000.0).collect();
        let (half, most) = half_and_most(off);
        table.row(
            name,
            &format!("half within {half:.1} ms, 90 % within {most:.1} (n = {})", found.len()),
            "8.3 and 16.7 ms",
            half <= 8.4 && most <= 16.7,
        );
    }
    let quartiles = |truth: bool, kind: KeySounds| {
        let own = found.iter().filter(|it| it.0 == kind);
        let phases: Vec<f64> = own
            .map(|it| 1000.0 * (if truth { it.2[1] } else { it.3[1] } - it.1))
            .collect();
        GestureQuartiles::quartiles_from_numbers(&phases)
    };
    for (kind, name) in [
        (KeySounds::Pair, "pairs"),
        (KeySounds::Vowel, "vowels alone"),
        (KeySounds::Consonant, "consonants alone"),
    ] {
        let (Some(truth), Some(own)) = (quartiles(true, kind), quartiles(false, kind)) else {
            continue;
        };
        let (wide, narrow) = (own.high - own.low, truth.high - truth.low);
        table.row(
            &format!("phase of {name} (n = {})", own.n),
            &format!(
                "median {:.1} for {:.1} ms, quartiles {wide:.0} for {narrow:.0} apart",
                own.median, truth.median
            ),
            "median ± 5 ms, quartiles ± 15 %",
            (own.median - truth.median).abs() <= 5.0 && (wide / narrow - 1.0).abs() <= 0.15,
        );
    }
    let planted = [[0.5, 0.0, 0.0], [0.3, 0.21, 0.1], [0.33, -0.6, -0.3]];
    let median = |phase: [f64; 3], seeds: std::ops::Range<u64>, truth: bool| {
        let settings = CueGeneratorSettings { phase, ..clean() };
        let found = found_phases(&settings, seeds);
        KeySounds::ALL_KEY_SOUNDS.map(|kind| {
            let own: Vec<f64> = found
                .iter()
                .filter(|it| it.0 == kind)
                .map(|it| if truth { it.2[1] } else { it.3[1] } - it.1)
                .collect();
            let median = GestureQuartiles::quartiles_from_numbers(&own).map_or(0.0, |it| it.median);
            (own.len() as f64, median)
        })
    };
    let known = planted.map(|phase| median(phase, 0..40, true));
    let mut keys = usize::MAX;
    let right = (0..3)
        .filter(|n| {
            let own = median(planted[*n], 40..80, false);
            keys = keys.min(own.iter().map(|it| it.0 as usize).sum());
            // A kind with many keys has a better median, and counts more.
            let apart = |at: &[(f64, f64); 3]| -> f64 {
                let both = at.iter().zip(own);
                both.map(|(a, (count, b))| count * (a.1 - b) * (a.1 - b)).sum()
            };
            let best = known
                .iter()
                .enumerate()
                .min_by(|a, b| apart(a.1).total_cmp(&apart(b.1)));
            best.is_some_and(|(m, _)| m == *n)
        })
        .count();
    table.row(
        "three planted rules of phases distinguished",
        &format!("{right} of 3, by {keys} keys or more"),
        "3 of 3",
        right == 3,
    );
}
