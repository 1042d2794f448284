//! Builds the sign's tree, and its features in words.

mod manner;
mod readings;
mod record;
mod tree_held;
mod tree_motion;
mod tree_posture;

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use chereme_motion::{BodyPart, BodySide, HandFinger};
use chereme_sign::hamnosys::{
    BodyPlace, CircularPath, ClockRange, CompassDirection, DirectedPath, DirectionAim, EachHand, EllipseAxis,
    HamnosysSign, HandConstellation, HandPlace, HandSymmetry, HandsUsed, Handshape, ManualPart, MotionGrowth,
    MotionKind, MotionRepetition, MotionSize, NonmanualActs, NotatedMotion, NotatedPosture, PathCurve, PathZigzag,
    PlaceContact, SizeAmount, SpatialDirection, WristMotion, orientation,
};
use glam::DVec3;

use super::acts::{
    ActKind, HandPartQueries, HandSway, MovingHand, TranscribedAct, find_hand_acts, find_signing_frames,
};
use super::aim;
use super::transcribe_hands::{
    HandRelation, RelationKind, find_hand_relation, leading_hand_index, symmetric_hand_orientation, symmetry_axis_signs,
};
use super::transcribe_path::PathForm;
use super::transcribe_place::{HandsTogether, LikelyHandPlace, PosedBody, hand_point_site};
use super::transcribe_scene::{HandTrajectory, SignerScene, polyline_length};
use super::transcribe_shape::HandFormTable;
use super::transcribe_words;
use super::{
    BestReading, FeatureKind, NotationFeature, ResidualUnit, RunnerUp, TokenTranscription, TranscribeOptions,
    TranscriptionStage,
};
use crate::transcribe::transcribe_tuned::tuned;
pub(super) use readings::SceneReadings;
pub use tree_held::HeldReading;
pub(super) use tree_held::read_held_postures;
use tree_posture::circling_lag_offset;
pub(super) use tree_posture::{PlaceNotation, placeless_constellation};

/// The symmetry of hands that mirror each other.
const MIRRORED_SYMMETRY: HandSymmetry = HandSymmetry {
    left_right: true,
    up_down: false,
    out_in: false,
    out_of_phase: false,
    real_space: false,
};

/// The readings of one hand in one frame.
#[derive(Debug, Clone)]
pub(super) struct HandReading {
    pub(super) shape: Option<BestReading<Handshape>>,
    pub(super) extended: BestReading<DirectionAim<SpatialDirection>>,
    pub(super) palm: Option<BestReading<DirectionAim<CompassDirection>>>,
    /// Degrees by which the reading lies beyond the limit of wrist or forearm.
    beyond: f64,
}

/// Writes the notation of a scene, and returns how the sign begins; `picked` readings are fixed.
pub(super) fn write_scene_notation<'a>(
    sight: &'a SceneReadings<'a>,
    picked: PickedReadings,
) -> (TokenTranscription, Option<BegunPosture>) {
    NotationWriter::new(sight, picked).write_notation()
}

/// Readings fixed in advance; they override more likely ones.
#[derive(Debug, Clone, Default)]
pub(super) struct PickedReadings {
    pub(super) stand: Option<PlaceNotation>,
    /// The orientation of each hand.
    pub(super) turned: [Option<aim::OrientationReading>; 2],
    /// Whether the hands mirror each other at first, though their movements are unrelated.
    pub(super) mirrored: bool,
}

/// The first posture of a sign, as it was read.
#[derive(Debug, Clone)]
pub(super) struct BegunPosture {
    /// The frame in which its posture was read.
    pub(super) frame: usize,
    /// The first frame of the sign.
    pub(super) first: usize,
    pub(super) stand: PlaceNotation,
    pub(super) symmetric: bool,
    pub(super) alone: bool,
    /// Offset (m) by which the other hand's place is shifted from its measured one.
    pub(super) behind: Option<DVec3>,
}

impl HandReading {
    fn with_orientation_reading(self, turned: aim::OrientationReading) -> Self {
        let palm = self.palm.as_ref().map(|_| turned.palm);
        Self {
            extended: turned.extended,
            palm,
            beyond: turned.beyond,
            ..self
        }
    }
}

/// Returns the distance of the signing hand from a place, and that of the place's goal from another
/// place's.
pub(super) fn off_place(
    scene: &SignerScene<'_>,
    options: &TranscribeOptions,
    frame: usize,
    place: &BodyPlace,
    other: Option<&BodyPlace>,
    symmetric: bool,
) -> Option<(f64, f64)> {
    let sight = SceneReadings::new(scene, options);
    let (body, n) = (sight.cached_body_at(frame)?, sight.lead);
    let own_goal = body.goal_of(n, place, symmetric)?;
    let other_goal = other.and_then(|other| body.goal_of(n, other, symmetric));
    let apart = other_goal.map_or(f64::INFINITY, |at| at.distance(own_goal));
    Some((body.hand_place_distance(n, place, symmetric)?, apart))
}

struct NotationWriter<'a> {
    scene: &'a SignerScene<'a>,
    sight: &'a SceneReadings<'a>,
    /// The index of the hand that signs if only one does.
    lead: usize,
    features: Vec<NotationFeature>,
    stages: Vec<TranscriptionStage>,
    findings: Vec<String>,
    /// The number of the current action.
    action: Option<usize>,
    /// The frames of the current posture or action.
    frames: (usize, usize),
    picked: PickedReadings,
    /// Offset (m) by which the other hand's place is shifted from its measured one.
    behind: Option<DVec3>,
    /// The first frame of the sign.
    first: usize,
    /// How the sign begins, once it is written.
    begun: Option<BegunPosture>,
}

impl<'a> NotationWriter<'a> {
    fn new(sight: &'a SceneReadings<'a>, picked: PickedReadings) -> Self {
        Self {
            scene: sight.scene,
            sight,
            lead: sight.lead,
            features: Vec::new(),
            stages: Vec::new(),
            findings: Vec::new(),
            action: None,
            frames: (0, 0),
            picked,
            behind: None,
            first: 0,
            begun: None,
        }
    }

    fn write_notation(mut self) -> (TokenTranscription, Option<BegunPosture>) {
        let scene = self.scene;
        let lead = self.lead;
        let Some(track) = scene.hands[lead].as_ref() else {
            return self.finish_manual_notation(ManualPart::default(), 0, scene.clip.clip_frame_count());
        };
        self.lacks();
        self.report_resting_hands();
        let frames = find_signing_frames(scene, track);
        let (first, last) = (*frames.start(), *frames.end());
        let (all, left) = self.sight.read_hand_acts(lead, track, &frames);
        let start = left.unwrap_or(first + (last - first) / 2);
        let relation = find_hand_relation(scene, &frames);
        self.begin_recorded_stage(None, (first, all.first().map_or(last + 1, |_| start + 1)));
        let beginning = match self.picked.mirrored {
            true => mirrored_hand_relation(&relation),
            false => relation,
        };
        self.record_hands(&beginning, start);
        let mut body = self.sight.read_uncached_body(start);
        let shift = circling_lag_offset(&relation, all.first());
        if let (Some(body), Some(by)) = (&mut body, shift) {
            body.shift_body_hand(1, by);
        }
        self.behind = shift;
        self.first = first;
        let posture = self.write_first_posture(start, &beginning, body.as_ref());
        let hands = self.choose_hands_used(&beginning.kind);
        self.end_recorded_stage(None, transcribe_words::begun_posture_hamnosys(hands, posture.clone()));
        let mut actions: Vec<NotatedMotion> = Vec::new();
        let other = scene.hands[1].as_ref().filter(|_| lead == 0);
        let unlike = relation.kind == RelationKind::Unlike { moves: true };
        let others = other.filter(|_| unlike).map(|other| {
            let (others, _) = self.sight.read_hand_acts(1, other, &frames);
            (other, others)
        });
        if let Some((other, others)) = others.filter(|(_, others)| !others.is_empty()) {
            actions.extend(self.write_split_acts(first, track, &all, other, &others));
        } else {
            let mut before = first;
            for (n, act) in all.iter().enumerate() {
                self.begin_recorded_stage(Some(n + 1), (*act.frames.start(), act.until + 1));
                let idle = act.frames.start().saturating_sub(before);
                let motion = self.write_act_motion(lead, track, act, idle, &relation);
                self.end_recorded_stage(None, transcribe_words::motion_hamnosys(&motion));
                actions.push(motion);
                before = act.until;
            }
        }
        let done = self.stages.len() - 1;
        if done > tuned().tree.most {
            self.findings.push(format!(
                "{done} actions are many for one sign: give the span of a single token"
            ));
        }
        let mut manual = ManualPart {
            hands,
            posture,
            actions,
            ..ManualPart::default()
        };
        if self.picked.mirrored {
            mirror_first_posture(&mut manual);
        }
        self.finish_manual_notation(manual, first, last + 1)
    }

    /// Returns the hands that act; on a skeleton with one arm, that one.
    fn choose_hands_used(&self, kind: &RelationKind) -> HandsUsed {
        match kind {
            RelationKind::Alike(symmetry) => HandsUsed::Both(*symmetry),
            RelationKind::Alone if self.lead == 1 && self.scene.hands[0].is_some() => HandsUsed::Nondominant,
            _ => HandsUsed::Dominant,
        }
    }

    fn finish_manual_notation(
        self,
        manual: ManualPart,
        first: usize,
        end: usize,
    ) -> (TokenTranscription, Option<BegunPosture>) {
        let transcription = TokenTranscription {
            sign: HamnosysSign { parts: vec![manual] },
            features: self.features,
            stages: self.stages,
            frames: (first, end),
            nonmanual: NonmanualActs::default(),
            findings: self.findings,
        };
        (transcription, self.begun)
    }

    /// Reports what the skeleton does not show.
    fn lacks(&mut self) {
        for track in self.scene.hands.iter().flatten() {
            let side = track.side.body_side_name();
            if !track.faces {
                self.findings
                    .push(format!("the {side} hand has too few fingers to define its palm"));
            }
            let names = |parts: &[BodyPart]| {
                let names: Vec<String> = parts.iter().map(ToString::to_string).collect();
                names.join(", ")
            };
            let missing = &track.missing;
            let there: Vec<BodyPart> = handshape_joints(track.side)
                .filter(|part| !missing.contains(part))
                .collect();
            if there.len() < missing.len() && !there.is_empty() {
                self.findings.push(format!(
                    "the {side} handshape is inferred from {} alone, and may be another",
                    names(&there)
                ));
            } else if !missing.is_empty() {
                self.findings
                    .push(format!("the {side} handshape is inferred without {}", names(missing)));
            }
        }
        for (n, track) in self.scene.hands.iter().enumerate() {
            if track.is_none() {
                let which = ["dominant", "other"][n];
                self.findings
                    .push(format!("the skeleton has no arm on the {which} side"));
            }
        }
    }

    /// Reports that nothing is signed: hands that hang, or arms that stick out, all the time.
    fn report_resting_hands(&mut self) {
        let mut hands = self.scene.hands.iter().flatten();
        if hands.all(|track| track.rests.iter().all(|rests| *rests)) {
            self.findings.push(
                "the hands rest or the arms stick out in every frame: only that posture is transcribed; \
                 give a span in which something is signed"
                    .to_owned(),
            );
        }
    }

    /// Writes the acts of each hand, if they move for themselves.
    fn write_split_acts(
        &mut self,
        first: usize,
        track: &HandTrajectory,
        own: &[TranscribedAct],
        other: &HandTrajectory,
        others: &[TranscribedAct],
    ) -> Vec<NotatedMotion> {
        let alone = HandRelation {
            kind: RelationKind::Unlike { moves: true },
            residual: 0.0,
            runner_up: None,
        };
        let mut of = |lead: usize, track: &HandTrajectory, acts: &[TranscribedAct]| -> Vec<NotatedMotion> {
            let mut before = first;
            acts.iter()
                .enumerate()
                .map(|(n, act)| {
                    self.begin_recorded_stage(Some(n + 1), (*act.frames.start(), act.until + 1));
                    let idle = act.frames.start().saturating_sub(before);
                    before = act.until;
                    let motion = self.write_act_motion(lead, track, act, idle, &alone);
                    self.end_recorded_stage(Some(track.side), transcribe_words::motion_hamnosys(&motion));
                    motion
                })
                .collect()
        };
        let (a, b) = (of(0, track, own), of(1, other, others));
        if a.is_empty() && b.is_empty() {
            return Vec::new();
        }
        let split = |a: Option<NotatedMotion>, b: Option<NotatedMotion>| {
            NotatedMotion::new(MotionKind::Split(a.map(Box::new), b.map(Box::new)))
        };
        if a.len() == b.len() {
            return a.into_iter().zip(b).map(|(a, b)| split(Some(a), Some(b))).collect();
        }
        let joined_motion = |mut all: Vec<NotatedMotion>| match all.len() {
            0 | 1 => all.pop(),
            _ => Some(NotatedMotion::new(MotionKind::Sequence {
                motions: all,
                fused: false,
            })),
        };
        vec![split(joined_motion(a), joined_motion(b))]
    }

    /// Writes an act that begins `idle` frames after the one before.
    fn write_act_motion(
        &mut self,
        hand: usize,
        track: &HandTrajectory,
        act: &TranscribedAct,
        idle: usize,
        relation: &HandRelation,
    ) -> NotatedMotion {
        let (first, last) = (*act.frames.start(), *act.frames.end());
        let mut motion = match &act.kind {
            ActKind::Path(_) => Some(self.write_act_path(track, act)),
            ActKind::Sway(sway) => Some(self.write_sway_motion(track, sway, first)),
            ActKind::Change => {
                self.record_change(track, first);
                None
            }
        };
        if let Some(with) = &act.with {
            let with = self.write_sway_motion(track, with, first);
            motion = motion.map(|main| NotatedMotion::new(MotionKind::Parallel(vec![main, with])));
        }
        let changed = self.write_end_changes(track, act, first, last);
        let place = self.write_reached_place(hand, act, relation, first, last);
        let manner = self.infer_act_manner(track, act, place.is_some(), idle);
        if let Some(motion) = &mut motion {
            motion.manner = manner;
        }
        if !changed.is_empty() {
            let target = NotatedMotion {
                manner,
                ..NotatedMotion::new(MotionKind::Target {
                    motion: None,
                    posture: Box::new(changed),
                })
            };
            motion = Some(match motion {
                Some(main) => NotatedMotion::new(MotionKind::Parallel(vec![main, target])),
                None => target,
            });
        }
        if let Some(place) = place {
            motion = Some(NotatedMotion::new(MotionKind::Target {
                motion: motion.map(Box::new),
                posture: Box::new(NotatedPosture {
                    place: Some(place),
                    ..NotatedPosture::default()
                }),
            }));
        }
        let motion = motion.unwrap_or_else(|| NotatedMotion::new(MotionKind::Still));
        self.write_repeated_motion(track, act, motion)
    }

    fn write_repeated_motion(
        &mut self,
        track: &HandTrajectory,
        act: &TranscribedAct,
        motion: NotatedMotion,
    ) -> NotatedMotion {
        let Some(repeat) = act.repeat else {
            return motion;
        };
        self.record_repetition(track, act, repeat);
        NotatedMotion::new(MotionKind::Repeated {
            motion: Box::new(motion),
            repetition: MotionRepetition {
                growth: act.grows.map(|increasing| MotionGrowth { increasing, size: None }),
                ..MotionRepetition::plain_repetition(repeat)
            },
        })
    }
}

/// Returns the relation of two hands that mirror each other at first, and then do not.
fn mirrored_hand_relation(relation: &HandRelation) -> HandRelation {
    HandRelation {
        kind: RelationKind::Alike(MIRRORED_SYMMETRY),
        residual: relation.residual,
        runner_up: Some((relation.kind, relation.residual)),
    }
}

/// Makes two hands mirror each other in the first posture; the other hand stays still while the dominant
/// one acts.
pub(super) fn mirror_first_posture(part: &mut ManualPart) {
    part.hands = HandsUsed::Both(MIRRORED_SYMMETRY);
    for motion in &mut part.actions {
        if !matches!(motion.kind, MotionKind::Split(..)) {
            let own_motion = std::mem::replace(motion, NotatedMotion::new(MotionKind::Still));
            let nothing = NotatedMotion::new(MotionKind::Still);
            motion.kind = MotionKind::Split(Some(Box::new(own_motion)), Some(Box::new(nothing)));
        }
    }
}

/// Returns the joints that define a handshape.
fn handshape_joints(side: BodySide) -> impl Iterator<Item = BodyPart> {
    let thumb = (0..3).map(move |n| BodyPart::Thumb(side, n));
    let fingers = HandFinger::ALL_FINGERS.into_iter();
    thumb.chain(fingers.flat_map(move |finger| (1..4).map(move |n| BodyPart::Finger(side, finger, n))))
}

fn notate_circular_path(
    axis: SpatialDirection,
    size: Option<MotionSize>,
    long: DVec3,
    narrow: f64,
    start: DVec3,
    l: &chereme_sign::hamnosys::BodyLanguage,
) -> CircularPath {
    let angle = |spoke: DVec3| orientation::angle_about(axis.spatial_direction_vector(), spoke.into());
    let start = CompassDirection::nearest_compass_direction(angle(start));
    let ellipse = (narrow < (1.0 + l.ellipse_small) / 2.0).then(|| {
        // From right over up to left.
        let lean_steps = (angle(long).to_degrees() - 90.0).rem_euclid(180.0) / 45.0;
        let lean = lean_steps.round() as u8;
        match lean % 4 {
            0 => EllipseAxis::Horizontal,
            1 => EllipseAxis::UpRight,
            2 => EllipseAxis::Vertical,
            _ => EllipseAxis::UpLeft,
        }
    });
    CircularPath {
        axis,
        second: None,
        size: SizeAmount {
            first: size,
            second: None,
        },
        ellipse,
        ellipse_size: ellipse.and_then(|_| {
            // A narrower ellipse is written as a bigger one.
            nearest_notated_size(
                1.0 / narrow,
                [l.ellipse_small, l.ellipse_normal, l.ellipse_big].map(|x| 1.0 / x),
            )
            .best
        }),
        clock: ClockRange {
            start: (start != CompassDirection::U).then_some(start),
            end: None,
            full: 0,
        },
        zigzag: None,
        growth: None,
    }
}

/// Returns the size whose ratio to a measure is nearest to 1; the residual is the ratio's logarithm.
fn nearest_notated_size(measure: f64, sizes: [f64; 3]) -> BestReading<Option<MotionSize>> {
    let named = [Some(MotionSize::Small), None, Some(MotionSize::Big)];
    let off = |size: f64| (measure.max(1e-6) / size).ln().abs();
    BestReading::pick_best_reading(
        named
            .into_iter()
            .zip(sizes)
            .map(|(name, size)| (name, off(size), off(size)))
            .collect(),
    )
}
