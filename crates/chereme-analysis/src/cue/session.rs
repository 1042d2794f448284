//! Takes of one cuer: fingertips and distances from markers, with targets, scores and phases of keys.

use chereme_motion::InterpolationKind;
use glam::DVec3;

use super::ModelError;
use super::cue_face;
use super::cue_hand::{self, HAND_BEND_COUNT, HandModel};
use super::cue_labels::RIGID_HEAD_MARKERS;
use super::cue_targets::{
    MAX_END_OVERRUN_FRAMES, MIN_FITTED_FRAMES, MovementFit, SoughtKey, TargetOptions, find_key_targets, handed_over,
};
use super::gauss::GaussianRecogniser;
use super::rigid::RigidMotion;

/// Measurements of a take, computed from its markers.
#[derive(Debug, Clone, Default)]
pub struct FollowedTake {
    /// Frames per second.
    pub rate: f64,
    /// The motion of the head in each frame; nothing if a frame shows too few of its markers.
    pub head: Vec<Option<RigidMotion>>,
    /// The seven distances that distinguish shapes.
    pub seven: Vec<Option<[f64; 7]>>,
    /// The bends of fingers and thumb, in millimetres of their tips.
    pub bends: Vec<Option<[f64; HAND_BEND_COUNT]>>,
    /// The tip of the index finger in the space of the head.
    pub index: Vec<Option<DVec3>>,
    /// The tip of the middle finger in the space of the head.
    pub middle: Vec<Option<DVec3>>,
}

impl FollowedTake {
    /// Returns the measurements for markers whose positions are all known, given the head's motion in each frame.
    #[must_use]
    pub fn of_truth(points: &[Vec<DVec3>], heads: &[RigidMotion], rate: f64) -> Self {
        let complete_frame = |points: &Vec<DVec3>| points.iter().copied().map(Some).collect();
        let hand: Vec<cue_hand::HandMarkerFrame> = points.iter().map(complete_frame).collect();
        Self::of_hand_frames(&hand, heads.iter().copied().map(Some).collect(), rate)
    }

    /// Returns the measurements computed from markers alone; hidden ones may have been restored before. A tip or a
    /// number with missing markers is unknown, and gaps of at most a quarter of a second are bridged by straight lines.
    ///
    /// `rigid` gives the usual positions of the head's rigid markers; without them the room is used as the space of the
    /// head.
    #[must_use]
    pub fn of_seen(
        hand: &[cue_hand::HandMarkerFrame],
        face: &[cue_face::FaceMarkerFrame],
        rigid: Option<&[DVec3]>,
        rate: f64,
    ) -> Self {
        let head = (0..hand.len()).map(|n| match rigid {
            None => Some(RigidMotion::default()),
            Some(rigid) => face
                .get(n)
                .and_then(|face| face.get(RIGID_HEAD_MARKERS))
                .and_then(|seen| RigidMotion::fit_rigid_motion(rigid, seen).ok()),
        });
        let mut followed = Self::of_hand_frames(hand, head.collect(), rate);
        let most = (MAX_BRIDGED_SECONDS * rate) as usize;
        bridge_row_gaps(&mut followed.seven, most, mixed_numbers);
        bridge_row_gaps(&mut followed.index, most, |a, b, share| a.lerp(b, share));
        bridge_row_gaps(&mut followed.middle, most, |a, b, share| a.lerp(b, share));
        followed
    }

    fn of_hand_frames(hand: &[cue_hand::HandMarkerFrame], head: Vec<Option<RigidMotion>>, rate: f64) -> Self {
        let tips = |shape: u8| {
            let frames = hand.iter().zip(&head);
            let tip = |(frame, head): (&cue_hand::HandMarkerFrame, &Option<RigidMotion>)| {
                let tip_point = HandModel::tip_seen(frame, shape)?;
                Some((*head)?.undo_rigid_motion(tip_point)).filter(|at| at.is_finite())
            };
            frames.map(tip).collect()
        };
        Self {
            rate,
            seven: hand.iter().map(HandModel::distances_seen).collect(),
            bends: bridged_bends(hand, (MAX_BRIDGED_SECONDS * rate) as usize),
            index: tips(1),
            middle: tips(4),
            head,
        }
    }

    /// Returns the number of frames.
    #[must_use]
    pub fn followed_frame_count(&self) -> usize {
        self.seven.len()
    }

    /// Returns whether bends show when the fingers arrive. Without them distances do, which hardly change near a straight
    /// finger and so seem to come to rest too early.
    #[must_use]
    pub fn has_bends(&self) -> bool {
        2 * self.bends.iter().flatten().count() >= self.seven.iter().flatten().count()
    }

    /// Returns the fingertip that points for a shape, in the space of the head.
    #[must_use]
    pub fn head_space_fingertip(&self, shape: u8, frame: usize) -> Option<DVec3> {
        let tips = if points_with_index(shape) {
            &self.index
        } else {
            &self.middle
        };
        tips.get(frame).copied().flatten()
    }

    /// Returns the numbers that a dictionary stores for a frame: the seven distances, then both tips in the space of
    /// the head.
    #[must_use]
    pub fn dictionary_parameters(&self, frame: usize) -> Option<Vec<f64>> {
        let mut row = (*self.seven.get(frame)?)?.to_vec();
        row.extend((*self.index.get(frame)?)?.to_array());
        row.extend((*self.middle.get(frame)?)?.to_array());
        Some(row)
    }
}

/// The longest gap that is bridged, in seconds.
const MAX_BRIDGED_SECONDS: f64 = 0.25;

fn mixed_numbers<const N: usize>(a: [f64; N], b: [f64; N], share: f64) -> [f64; N] {
    std::array::from_fn(|k| a[k] + (b[k] - a[k]) * share)
}

/// Returns the bends in each frame in which none is unknown; gaps of each number are bridged by itself.
fn bridged_bends(hand: &[cue_hand::HandMarkerFrame], most: usize) -> Vec<Option<[f64; HAND_BEND_COUNT]>> {
    let mut rows = HandModel::bends_seen(hand);
    for k in 0..HAND_BEND_COUNT {
        let finite_bend = |row: &[f64; HAND_BEND_COUNT]| row[k].is_finite().then_some([row[k]]);
        let mut column: Vec<Option<[f64; 1]>> = rows.iter().map(finite_bend).collect();
        // Each number alone: a hidden marker spoils few of them.
        bridge_row_gaps(&mut column, most, mixed_numbers);
        for (row, number) in rows.iter_mut().zip(column) {
            row[k] = number.map_or(f64::NAN, |[number]| number);
        }
    }
    let finite_row = |row: [f64; HAND_BEND_COUNT]| row.iter().all(|number| number.is_finite()).then_some(row);
    rows.into_iter().map(finite_row).collect()
}

/// Fills gaps of at most `most` frames between two known frames.
pub fn bridge_row_gaps<T: Copy>(rows: &mut [Option<T>], most: usize, between: impl Fn(T, T, f64) -> T) {
    let mut last_known: Option<usize> = None;
    for at in 0..rows.len() {
        let Some(own) = rows[at] else { continue };
        if let Some((first, before)) = last_known.and_then(|first| Some((first, rows[first]?)))
            && (2..=most + 1).contains(&(at - first))
        {
            let gap = rows.iter_mut().enumerate().take(at).skip(first + 1);
            for (place, row) in gap {
                let share = (place - first) as f64 / (at - first) as f64;
                *row = Some(between(before, own, share));
            }
        }
        last_known = Some(at);
    }
}

/// Returns the usual positions of the head's rigid markers, from frames that show all of them; nothing if fewer than
/// two frames do.
#[must_use]
pub fn rigid_set<'a>(frames: impl Iterator<Item = &'a cue_face::FaceMarkerFrame>) -> Option<Vec<DVec3>> {
    let complete_frames: Vec<Vec<Option<DVec3>>> = frames
        .filter_map(|frame| frame.get(RIGID_HEAD_MARKERS))
        .filter(|seen| seen.iter().all(|at| at.is_some_and(|at| at.is_finite())))
        .map(<[Option<DVec3>]>::to_vec)
        .collect();
    if complete_frames.len() < 2 {
        return None;
    }
    let mut mean: Vec<DVec3> = complete_frames[0].iter().flatten().copied().collect();
    // The first frame's own errors are gone after the first round.
    for _ in 0..2 {
        let (mut sum, mut count) = (vec![DVec3::ZERO; mean.len()], 0.0);
        for seen in &complete_frames {
            if let Ok(motion) = RigidMotion::fit_rigid_motion(&mean, seen) {
                count += 1.0;
                let places = sum.iter_mut().zip(seen.iter().flatten());
                places.for_each(|(sum, at)| *sum += motion.undo_rigid_motion(*at));
            }
        }
        if count < 2.0 {
            return None;
        }
        mean = sum.into_iter().map(|sum| sum / count).collect();
    }
    Some(mean)
}

/// Returns whether the index finger points for a shape; otherwise the middle finger does.
#[must_use]
pub fn points_with_index(shape: u8) -> bool {
    matches!(shape, 1 | 6)
}

/// The sounds of a key: they determine when its target is expected.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum KeySounds {
    /// A consonant and a vowel.
    Pair,
    /// A single vowel.
    Vowel,
    /// A single consonant.
    Consonant,
}

impl KeySounds {
    /// Every kind.
    pub const ALL_KEY_SOUNDS: [Self; 3] = [Self::Pair, Self::Vowel, Self::Consonant];

    /// Returns the name of the kind.
    #[must_use]
    pub fn key_sounds_name(self) -> &'static str {
        match self {
            Self::Pair => "pair",
            Self::Vowel => "vowel",
            Self::Consonant => "consonant",
        }
    }
}

/// A key expected in a take, with the times of its sounds in seconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExpectedCueKey {
    /// The sounds of the key.
    pub kind: KeySounds,
    /// The number of its placement.
    pub placement: u8,
    /// The number of its shape.
    pub shape: u8,
    /// The acoustic start of the key.
    pub a1: f64,
    /// The start of its vowel.
    pub a2: f64,
    /// Its end.
    pub a3: f64,
}

/// A gesture of a key: the movement to it, its target, and the time in which it is the most probable one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredGesture {
    /// The frame of the target.
    pub frame: usize,
    /// The movement to the target.
    pub movement: MovementFit,
    /// Whether the movement was long and clear enough to be measured.
    pub measured: bool,
    /// The most probable class at the target.
    pub recognised: u8,
    /// The logarithm of the probability of the right class at the target.
    pub log: f64,
    /// The time around the target in which the right class is more probable than any other, in seconds; nothing if
    /// another one is more probable at the target.
    pub extent: Option<[f64; 2]>,
}

/// The gestures of one key in a take.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KeyGestures {
    /// The hand at its placement.
    pub hand: MeasuredGesture,
    /// The fingers in their shape.
    pub fingers: MeasuredGesture,
}

/// The recognisers of one cuer.
#[derive(Debug, Clone)]
pub struct CuerRecognisers {
    /// The recogniser of shapes, from the seven distances.
    pub shapes: GaussianRecogniser,
    /// The recogniser of placements, from the pointing tip in the space of the head.
    pub placements: GaussianRecogniser,
}

/// The number added to every variance of the Gaussians, in square millimetres.
const VARIANCE_FLOOR_MM2: f64 = 0.25;
/// The number of rounds in which recognisers learn from targets that they found.
const RECOGNISER_LEARNING_ROUNDS: usize = 2;
/// The shortest movement of the hand that is measured, in millimetres, and the least share of the variance that it must
/// explain.
const MIN_HAND_MOVEMENT_MM: f64 = 12.0;
const MIN_EXPLAINED_VARIANCE: f64 = 0.7;
/// The logarithm of the probability in a frame without measurements.
const UNSEEN_LOG_PROBABILITY: f64 = -50.0;

/// Examples of classes: the class number and the measured numbers.
pub type ClassExamples = Vec<(u8, Vec<f64>)>;

impl CuerRecognisers {
    /// Learns from examples of shapes and of placements.
    ///
    /// # Errors
    /// [`ModelError`] if there are too few.
    pub fn learn_cuer_recognisers(shapes: &ClassExamples, placements: &ClassExamples) -> Result<Self, ModelError> {
        Ok(Self {
            shapes: GaussianRecogniser::learn_gaussian_classes(shapes, VARIANCE_FLOOR_MM2)?,
            placements: GaussianRecogniser::learn_gaussian_classes(placements, VARIANCE_FLOOR_MM2)?,
        })
    }

    /// Returns the most probable placement and shape in a frame; the placement is that of the tip that points for the
    /// shape. Nothing if the frame shows too few markers.
    #[must_use]
    pub fn recognise_frame_key(&self, take: &FollowedTake, frame: usize) -> Option<(u8, u8)> {
        let shape = self.shapes.most_probable_class(take.seven.get(frame)?.as_ref()?);
        let tip = take.head_space_fingertip(shape, frame)?;
        Some((self.placements.most_probable_class(&tip.to_array()), shape))
    }
}

/// Returns the examples of shapes and placements at the targets of takes.
#[must_use]
pub fn collect_target_examples(
    takes: &[(&FollowedTake, &[ExpectedCueKey])],
    shown: &[Vec<KeyGestures>],
) -> (ClassExamples, ClassExamples) {
    let (mut shapes, mut placements) = (Vec::new(), Vec::new());
    for ((take, keys), shown) in takes.iter().zip(shown) {
        for (key, shown) in keys.iter().zip(shown) {
            if let Some(Some(seven)) = take.seven.get(shown.fingers.frame) {
                shapes.push((key.shape, seven.to_vec()));
            }
            if let Some(tip) = take.head_space_fingertip(key.shape, shown.hand.frame) {
                placements.push((key.placement, tip.to_array().to_vec()));
            }
        }
    }
    (shapes, placements)
}

/// Finds the gestures of all keys in takes, and trains recognisers on them: first by speed and sound alone, then with
/// the recognisers of the previous round.
///
/// A take with too few frames for its keys gets no gestures.
///
/// # Errors
/// [`ModelError`] if too few keys were found to learn from.
pub fn find_key_gestures(
    takes: &[(&FollowedTake, &[ExpectedCueKey])],
) -> Result<(CuerRecognisers, Vec<Vec<KeyGestures>>), ModelError> {
    let mut frames: Vec<TargetFrames> = takes
        .iter()
        .map(|(take, keys)| find_take_targets(take, keys, None))
        .collect();
    let mut recognisers = teach(takes, &frames)?;
    for _ in 0..RECOGNISER_LEARNING_ROUNDS {
        frames = takes
            .iter()
            .map(|(take, keys)| find_take_targets(take, keys, Some(&recognisers)))
            .collect();
        recognisers = teach(takes, &frames)?;
    }
    let framed_takes = takes.iter().zip(&frames);
    let shown = framed_takes.map(|((take, keys), frames)| gestures(take, keys, frames, &recognisers));
    let shown = shown.collect();
    Ok((recognisers, shown))
}

/// Finds the gestures of the keys in a take with given recognisers; empty if the take has too few frames for the keys.
#[must_use]
pub fn find_known(take: &FollowedTake, keys: &[ExpectedCueKey], recognisers: &CuerRecognisers) -> Vec<KeyGestures> {
    let frames = find_take_targets(take, keys, Some(recognisers));
    gestures(take, keys, &frames, recognisers)
}

/// The target frames of the hand and of the fingers; nothing if the take has too few frames for the keys.
type TargetFrames = Option<[Vec<usize>; 2]>;

fn find_take_targets(
    take: &FollowedTake,
    keys: &[ExpectedCueKey],
    recognisers: Option<&CuerRecognisers>,
) -> TargetFrames {
    let frame_time = 1.0 / take.rate;
    let options = TargetOptions::default();
    let hand: Vec<SoughtKey> = keys
        .iter()
        .map(|key| SoughtKey {
            a1: key.a1,
            log: recognisers.map_or_else(Vec::new, |known| {
                logs(take, key, &options, |frame| {
                    let tip = take.head_space_fingertip(key.shape, frame)?;
                    Some(known.placements.log_of(&tip.to_array(), key.placement))
                })
            }),
        })
        .collect();
    let fingers: Vec<SoughtKey> = keys
        .iter()
        .map(|key| SoughtKey {
            a1: key.a1,
            log: recognisers.map_or_else(Vec::new, |known| {
                logs(take, key, &options, |frame| {
                    let seven = take.seven.get(frame)?.as_ref()?;
                    Some(known.shapes.log_of(seven, key.shape))
                })
            }),
        })
        .collect();
    let tips = |frame: usize| {
        let (index, middle) = ((*take.index.get(frame)?)?, (*take.middle.get(frame)?)?);
        let both = [index.to_array(), middle.to_array()];
        Some(both.concat())
    };
    let seven = |frame: usize| Some((*take.seven.get(frame)?)?.to_vec());
    let frames = take.followed_frame_count();
    Some([
        find_key_targets(&hand, &measure_row_speed(frames, take.rate, tips), frame_time, &options)?,
        find_key_targets(
            &fingers,
            &measure_row_speed(frames, take.rate, seven),
            frame_time,
            &options,
        )?,
    ])
}

/// Returns the logarithms from `of` for the frames near a key; frames far from it get 0.
fn logs(
    take: &FollowedTake,
    key: &ExpectedCueKey,
    options: &TargetOptions,
    of: impl Fn(usize) -> Option<f64>,
) -> Vec<f64> {
    let near = |time: f64| ((time * take.rate).round().max(0.0) as usize).min(take.followed_frame_count());
    // Targets are sought only within the window, so that other frames need no probability.
    let (from, to) = (near(key.a1 - options.window), near(key.a1 + options.window) + 1);
    (0..to.min(take.followed_frame_count()))
        .map(|frame| {
            if frame < from {
                0.0
            } else {
                of(frame).unwrap_or(UNSEEN_LOG_PROBABILITY)
            }
        })
        .collect()
}

/// Returns the speed of a row of numbers in each frame, from the two frames around it; NaN if one of these is missing.
fn measure_row_speed(frames: usize, rate: f64, row: impl Fn(usize) -> Option<Vec<f64>>) -> Vec<f64> {
    let rows: Vec<Option<Vec<f64>>> = (0..frames).map(row).collect();
    (0..frames)
        .map(|frame| {
            // At the ends one neighbour is the frame itself.
            let (a, b) = (frame.saturating_sub(1), (frame + 1).min(frames - 1));
            match (&rows[a], &rows[b]) {
                (Some(before), Some(after)) if b > a => {
                    let square: f64 = before.iter().zip(after).map(|(x, y)| (x - y) * (x - y)).sum();
                    square.sqrt() * rate / (b - a) as f64
                }
                _ => f64::NAN,
            }
        })
        .collect()
}

fn teach(takes: &[(&FollowedTake, &[ExpectedCueKey])], frames: &[TargetFrames]) -> Result<CuerRecognisers, ModelError> {
    let (mut shapes, mut placements) = (Vec::new(), Vec::new());
    for ((take, keys), frames) in takes.iter().zip(frames) {
        let Some([hand, fingers]) = frames else {
            continue;
        };
        for (n, key) in keys.iter().enumerate() {
            if let Some(Some(seven)) = take.seven.get(fingers[n]) {
                shapes.push((key.shape, seven.to_vec()));
            }
            if let Some(tip) = take.head_space_fingertip(key.shape, hand[n]) {
                placements.push((key.placement, tip.to_array().to_vec()));
            }
        }
    }
    CuerRecognisers::learn_cuer_recognisers(&shapes, &placements)
}

/// Returns the gestures of hand and fingers. The fingers' have the course that explains most of their movements: a fit with
/// another one ends too early or too late. The hand's are of minimum jerk, as its pointing tip moves with the fingers, too.
fn gestures(
    take: &FollowedTake,
    keys: &[ExpectedCueKey],
    frames: &TargetFrames,
    known: &CuerRecognisers,
) -> Vec<KeyGestures> {
    let [mut usual, other] = [InterpolationKind::MinimumJerk, InterpolationKind::Cosine]
        .map(|course| gestures_of_course(take, keys, frames, known, course));
    let both = usual.iter().zip(&other).map(|(a, b)| (a.fingers, b.fingers));
    let measured = both.filter(|(a, b)| a.measured && b.measured);
    let votes = measured.map(|(a, b)| b.movement.explained > a.movement.explained);
    let (ayes, noes): (Vec<bool>, Vec<bool>) = votes.partition(|vote| *vote);
    // The course is a habit of the cuer, so that the keys vote on it together.
    if ayes.len() > noes.len() {
        for (usual, other) in usual.iter_mut().zip(other) {
            usual.fingers = other.fingers;
        }
    }
    usual
}

fn gestures_of_course(
    take: &FollowedTake,
    keys: &[ExpectedCueKey],
    frames: &TargetFrames,
    known: &CuerRecognisers,
    course: InterpolationKind,
) -> Vec<KeyGestures> {
    let Some([hand, fingers]) = frames else {
        return Vec::new();
    };
    let has_bends = take.has_bends();
    let tips = [true, false].map(|index| {
        let of = if index { &take.index } else { &take.middle };
        let rows = of.iter().map(|at| at.map(|at| at.to_array()));
        rows.collect::<Vec<Option<[f64; 3]>>>()
    });
    let mut all: Vec<KeyGestures> = Vec::with_capacity(keys.len());
    for (n, key) in keys.iter().enumerate() {
        let before = n.checked_sub(1);
        let around = |frames: &[usize], gesture: fn(&KeyGestures) -> MeasuredGesture| GestureWindow {
            before: before.map(|n| frames[n]),
            arrived: all.last().map(gesture).map_or(0.0, |previous| previous.movement.end),
            frame: frames[n],
            after: frames.get(n + 1).copied(),
        };
        // On the way from one pointing finger to another the first gives way to the second; a hand that comes from rest
        // counts as pointing with the middle finger.
        let pointing = |shape: u8| &tips[usize::from(!points_with_index(shape))];
        let [first, second] = [before.map_or(REST_HAND_SHAPE, |n| keys[n].shape), key.shape].map(pointing);
        let rows = |frame: usize| {
            let (first, second) = (first.get(frame)?.as_ref()?, second.get(frame)?.as_ref()?);
            Some([first.as_slice(), second.as_slice()])
        };
        let posteriors = |frame: usize| {
            let tip = take.head_space_fingertip(key.shape, frame)?;
            Some(known.placements.class_log_posteriors(&tip.to_array()))
        };
        let same = before.is_some_and(|n| keys[n].placement == key.placement);
        let near = around(hand, |key_gestures| key_gestures.hand);
        let hand = measure_key_gesture(take, &near, key.placement, rows, course, posteriors, same);
        let rows = |frame: usize| {
            let row = match has_bends {
                true => take.bends.get(frame)?.as_ref()?.as_slice(),
                false => take.seven.get(frame)?.as_ref()?.as_slice(),
            };
            Some([row, row])
        };
        let posteriors = |frame: usize| {
            let seven = take.seven.get(frame)?.as_ref()?;
            Some(known.shapes.class_log_posteriors(seven))
        };
        let same = before.is_some_and(|n| keys[n].shape == key.shape);
        let near = around(fingers, |key_gestures| key_gestures.fingers);
        let fingers = measure_key_gesture(take, &near, key.shape, rows, course, posteriors, same);
        all.push(KeyGestures { hand, fingers });
    }
    all
}

/// The shape of a hand at rest.
const REST_HAND_SHAPE: u8 = 0;
/// The longest time before its target at which the movement to the first key may begin, in seconds.
const MAX_FIRST_MOVEMENT_SECONDS: f64 = 0.6;

/// The frames between which a gesture is sought.
struct GestureWindow {
    /// The target of the previous key.
    before: Option<usize>,
    /// The time at which the movement to the previous key ends, in seconds.
    arrived: f64,
    /// The target.
    frame: usize,
    /// The target of the next key.
    after: Option<usize>,
}

/// Fits the movement to a target. A movement that ends with the examined frames is fitted again to more of them, up to
/// the next target; a target found in the middle of a movement is corrected by this.
fn fit_target_movement<'a>(
    rows: impl Fn(usize) -> Option<[&'a [f64]; 2]>,
    from: usize,
    to: usize,
    most: usize,
    frame_time: f64,
    course: InterpolationKind,
) -> Option<MovementFit> {
    const EXTRA_MOVEMENT_FRAMES: usize = 3;
    let mut to = to;
    loop {
        let fit = handed_over(&rows, from..=to, frame_time, course)?;
        // A movement that would go on ends at its limit, and the target was found too early.
        let at_its_limit = fit.end / frame_time >= to as f64 + MAX_END_OVERRUN_FRAMES - 0.5;
        if !at_its_limit || to >= most {
            return Some(fit);
        }
        to = (to + EXTRA_MOVEMENT_FRAMES).min(most);
    }
}

fn measure_key_gesture<'a>(
    take: &FollowedTake,
    around: &GestureWindow,
    right: u8,
    rows: impl Fn(usize) -> Option<[&'a [f64]; 2]>,
    course: InterpolationKind,
    posteriors: impl Fn(usize) -> Option<Vec<(u8, f64)>>,
    same: bool,
) -> MeasuredGesture {
    let (before, frame, after) = (around.before, around.frame, around.after);
    let frame_time = 1.0 / take.rate;
    let last = take.followed_frame_count().saturating_sub(1);
    let earliest = frame.saturating_sub((MAX_FIRST_MOVEMENT_SECONDS * take.rate) as usize);
    let arrival_frame = (around.arrived * take.rate) as usize;
    // An end so late leaves too few frames for a fit, and the previous target is the better limit.
    let arrived = if arrival_frame + MIN_FITTED_FRAMES <= frame {
        arrival_frame
    } else {
        0
    };
    let from = before.map_or(earliest, |before| before.max(arrived).max(earliest));
    let most = after.unwrap_or(last).min(last);
    // Two frames past the target show the movement come to rest.
    let movement_fit = fit_target_movement(rows, from, (frame + 2).min(most), most, frame_time, course);
    let still = MovementFit {
        start: frame as f64 * frame_time,
        end: frame as f64 * frame_time,
        length: 0.0,
        explained: 0.0,
    };
    // Nothing moves between two keys of one class, whatever noise the fit finds.
    let measured = !same
        && movement_fit
            .is_some_and(|fit| fit.length >= MIN_HAND_MOVEMENT_MM && fit.explained >= MIN_EXPLAINED_VARIANCE);
    let frame_posteriors = posteriors(frame).unwrap_or_default();
    let best = |all: &[(u8, f64)]| {
        let most = all.iter().copied();
        most.reduce(|best, next| if next.1 > best.1 { next } else { best })
            .map_or(0, |entry| entry.0)
    };
    let recognised = best(&frame_posteriors);
    let log = frame_posteriors
        .iter()
        .find(|entry| entry.0 == right)
        .map_or(UNSEEN_LOG_PROBABILITY, |entry| entry.1);
    let is_right = |frame: usize| posteriors(frame).is_some_and(|all| best(&all) == right);
    let extent = (recognised == right).then(|| {
        let first = (before.unwrap_or(0)..frame)
            .rev()
            .take_while(|other_frame| is_right(*other_frame));
        let end = after.unwrap_or(last);
        let later = (frame + 1..=end).take_while(|other_frame| is_right(*other_frame));
        let (first, later) = (first.last().unwrap_or(frame), later.last().unwrap_or(frame));
        [first as f64 * frame_time, (later + 1) as f64 * frame_time]
    });
    MeasuredGesture {
        frame,
        movement: movement_fit.unwrap_or(still),
        measured,
        recognised,
        log,
        extent,
    }
}
