//! Builds the sign's tree, and its features in words.

mod manner;
mod motion;
mod posture;
mod readings;
mod record;

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use chereme_motion::{Finger, Part, Side};
use chereme_sign::hamnosys::{
    Aim, Amount, BodyPlace, Circular, Clock, Compass, Constellation, Contact, Curve, Directed,
    Direction, Each, Ellipse, Growth, HandsUsed, Handshape, Manual, Motion, MotionKind, Nonmanual,
    Place, Posture, Repetition, Sign, Size, Symmetry, WristMotion, Zigzag, orientation,
};
use glam::DVec3;

use super::acts::{Act, ActKind, Mover, Seeing, Sway, acts, signing};
use super::aim;
use super::hands::{Relation, RelationKind, lead, relation, signs};
use super::path::PathForm;
use super::place::{Body, Placed, Together, named};
use super::scene::{HandTrajectory, Scene, length};
use super::shape::Forms;
use super::words;
use super::{Feature, FeatureKind, Found, Options, RunnerUp, Stage, Transcription, Unit};
use crate::transcribe::tuned::tuned;
use posture::behind;
pub(super) use posture::{Stand, meeting};
pub(super) use readings::Sight;

/// The symmetry of hands that mirror each other.
const MIRRORED: Symmetry = Symmetry {
    left_right: true,
    up_down: false,
    out_in: false,
    out_of_phase: false,
    real_space: false,
};

/// The readings of one hand in one frame.
#[derive(Debug, Clone)]
pub(super) struct HandReading {
    pub(super) shape: Option<Found<Handshape>>,
    pub(super) extended: Found<Aim<Direction>>,
    pub(super) palm: Option<Found<Aim<Compass>>>,
    /// Degrees by which the reading lies beyond the limit of wrist or forearm.
    beyond: f64,
}

/// Writes the notation of a scene, and returns how the sign begins; `picked` readings are fixed.
pub(super) fn written<'a>(sight: &'a Sight<'a>, picked: Picked) -> (Transcription, Option<Begun>) {
    Writer::new(sight, picked).written()
}

/// Readings fixed in advance; they override more likely ones.
#[derive(Debug, Clone, Default)]
pub(super) struct Picked {
    pub(super) stand: Option<Stand>,
    /// The orientation of each hand.
    pub(super) turned: [Option<aim::Turned>; 2],
    /// Whether the hands mirror each other at first, though their movements are unrelated.
    pub(super) mirrored: bool,
}

/// The first posture of a sign, as it was read.
#[derive(Debug, Clone)]
pub(super) struct Begun {
    /// The frame in which its posture was read.
    pub(super) frame: usize,
    /// The first frame of the sign.
    pub(super) first: usize,
    pub(super) stand: Stand,
    pub(super) symmetric: bool,
    pub(super) alone: bool,
    /// Offset (m) by which the other hand's place is shifted from its measured one.
    pub(super) behind: Option<DVec3>,
}

impl HandReading {
    fn turned(self, turned: aim::Turned) -> Self {
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
    scene: &Scene<'_>,
    options: &Options,
    frame: usize,
    (place, other): (&BodyPlace, Option<&BodyPlace>),
    symmetric: bool,
) -> Option<(f64, f64)> {
    let sight = Sight::new(scene, options);
    let (body, n) = (sight.body(frame)?, sight.lead);
    let own = body.goal_of(n, place, symmetric)?;
    let apart = other.and_then(|other| body.goal_of(n, other, symmetric));
    let apart = apart.map_or(f64::INFINITY, |at| at.distance(own));
    Some((body.off(n, place, symmetric)?, apart))
}

struct Writer<'a> {
    scene: &'a Scene<'a>,
    sight: &'a Sight<'a>,
    /// The index of the hand that signs if only one does.
    lead: usize,
    features: Vec<Feature>,
    stages: Vec<Stage>,
    findings: Vec<String>,
    /// The number of the current action.
    action: Option<usize>,
    /// The frames of the current posture or action.
    frames: (usize, usize),
    picked: Picked,
    /// Offset (m) by which the other hand's place is shifted from its measured one.
    behind: Option<DVec3>,
    /// The first frame of the sign.
    first: usize,
    /// How the sign begins, once it is written.
    begun: Option<Begun>,
}

impl<'a> Writer<'a> {
    fn new(sight: &'a Sight<'a>, picked: Picked) -> Self {
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

    fn written(mut self) -> (Transcription, Option<Begun>) {
        let scene = self.scene;
        let lead = self.lead;
        let Some(track) = scene.hands[lead].as_ref() else {
            return self.done(Manual::default(), 0, scene.clip.frames());
        };
        self.lacks();
        self.rests();
        let frames = signing(scene, track);
        let (first, last) = (*frames.start(), *frames.end());
        let (all, left) = self.sight.acts(lead, track, &frames);
        let start = left.unwrap_or(first + (last - first) / 2);
        let relation = relation(scene, &frames);
        self.begins(None, (first, all.first().map_or(last + 1, |_| start + 1)));
        let beginning = match self.picked.mirrored {
            true => mirrored(&relation),
            false => relation,
        };
        self.record_hands(&beginning, start);
        let mut body = self.sight.look(start);
        let shift = behind(&relation, all.first());
        if let (Some(body), Some(by)) = (&mut body, shift) {
            body.shift(1, by);
        }
        self.behind = shift;
        self.first = first;
        let posture = self.posture(start, &beginning, body.as_ref());
        let hands = self.used(&beginning.kind);
        self.ends(None, words::begun(hands, posture.clone()));
        let mut actions: Vec<Motion> = Vec::new();
        let other = scene.hands[1].as_ref().filter(|_| lead == 0);
        let unlike = relation.kind == RelationKind::Unlike { moves: true };
        let others = other.filter(|_| unlike).map(|other| {
            let (others, _) = self.sight.acts(1, other, &frames);
            (other, others)
        });
        if let Some((other, others)) = others.filter(|(_, others)| !others.is_empty()) {
            actions.extend(self.split(first, (track, &all), (other, &others)));
        } else {
            let mut before = first;
            for (n, act) in all.iter().enumerate() {
                self.begins(Some(n + 1), (*act.frames.start(), act.until + 1));
                let idle = act.frames.start().saturating_sub(before);
                let motion = self.motion(lead, track, (act, idle), &relation);
                self.ends(None, words::motion(&motion));
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
        let mut manual = Manual {
            hands,
            posture,
            actions,
            ..Manual::default()
        };
        if self.picked.mirrored {
            mirror(&mut manual);
        }
        self.done(manual, first, last + 1)
    }

    /// Returns the hands that act; on a skeleton with one arm, that one.
    fn used(&self, kind: &RelationKind) -> HandsUsed {
        match kind {
            RelationKind::Alike(symmetry) => HandsUsed::Both(*symmetry),
            RelationKind::Alone if self.lead == 1 && self.scene.hands[0].is_some() => {
                HandsUsed::Nondominant
            }
            _ => HandsUsed::Dominant,
        }
    }

    fn done(self, manual: Manual, first: usize, end: usize) -> (Transcription, Option<Begun>) {
        let transcription = Transcription {
            sign: Sign {
                parts: vec![manual],
            },
            features: self.features,
            stages: self.stages,
            frames: (first, end),
            nonmanual: Nonmanual::default(),
            findings: self.findings,
        };
        (transcription, self.begun)
    }

    /// Reports what the skeleton does not show.
    fn lacks(&mut self) {
        for track in self.scene.hands.iter().flatten() {
            let side = track.side.name();
            if !track.faces {
                self.findings.push(format!(
                    "the {side} hand has too few fingers to define its palm"
                ));
            }
            let names = |parts: &[Part]| {
                let names: Vec<String> = parts.iter().map(ToString::to_string).collect();
                names.join(", ")
            };
            let missing = &track.missing;
            let there: Vec<Part> = joints(track.side)
                .filter(|part| !missing.contains(part))
                .collect();
            if there.len() < missing.len() && !there.is_empty() {
                self.findings.push(format!(
                    "the {side} handshape is inferred from {} alone, and may be another",
                    names(&there)
                ));
            } else if !missing.is_empty() {
                self.findings.push(format!(
                    "the {side} handshape is inferred without {}",
                    names(missing)
                ));
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
    fn rests(&mut self) {
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
    fn split(
        &mut self,
        first: usize,
        (track, own): (&HandTrajectory, &[Act]),
        (other, others): (&HandTrajectory, &[Act]),
    ) -> Vec<Motion> {
        let alone = Relation {
            kind: RelationKind::Unlike { moves: true },
            residual: 0.0,
            runner_up: None,
        };
        let mut of = |lead: usize, track: &HandTrajectory, acts: &[Act]| -> Vec<Motion> {
            let mut before = first;
            acts.iter()
                .enumerate()
                .map(|(n, act)| {
                    self.begins(Some(n + 1), (*act.frames.start(), act.until + 1));
                    let idle = act.frames.start().saturating_sub(before);
                    before = act.until;
                    let motion = self.motion(lead, track, (act, idle), &alone);
                    self.ends(Some(track.side), words::motion(&motion));
                    motion
                })
                .collect()
        };
        let (a, b) = (of(0, track, own), of(1, other, others));
        if a.is_empty() && b.is_empty() {
            return Vec::new();
        }
        let split = |a: Option<Motion>, b: Option<Motion>| {
            Motion::new(MotionKind::Split(a.map(Box::new), b.map(Box::new)))
        };
        if a.len() == b.len() {
            return a
                .into_iter()
                .zip(b)
                .map(|(a, b)| split(Some(a), Some(b)))
                .collect();
        }
        let whole = |mut all: Vec<Motion>| match all.len() {
            0 | 1 => all.pop(),
            _ => Some(Motion::new(MotionKind::Sequence {
                motions: all,
                fused: false,
            })),
        };
        vec![split(whole(a), whole(b))]
    }

    /// Writes an act that begins `idle` frames after the one before.
    fn motion(
        &mut self,
        hand: usize,
        track: &HandTrajectory,
        (act, idle): (&Act, usize),
        relation: &Relation,
    ) -> Motion {
        let (first, last) = (*act.frames.start(), *act.frames.end());
        let mut motion = match &act.kind {
            ActKind::Path(_) => Some(self.path(track, act)),
            ActKind::Sway(sway) => Some(self.sway(track, sway, first)),
            ActKind::Change => {
                self.record_change(track, first);
                None
            }
        };
        if let Some(with) = &act.with {
            let with = self.sway(track, with, first);
            motion = motion.map(|main| Motion::new(MotionKind::Parallel(vec![main, with])));
        }
        let changed = self.changed(track, act, first, last);
        let place = self.reached(hand, act, relation, first, last);
        let manner = self.manner(track, act, place.is_some(), idle);
        if let Some(motion) = &mut motion {
            motion.manner = manner;
        }
        if !changed.is_empty() {
            let target = Motion {
                manner,
                ..Motion::new(MotionKind::Target {
                    motion: None,
                    posture: Box::new(changed),
                })
            };
            motion = Some(match motion {
                Some(main) => Motion::new(MotionKind::Parallel(vec![main, target])),
                None => target,
            });
        }
        if let Some(place) = place {
            motion = Some(Motion::new(MotionKind::Target {
                motion: motion.map(Box::new),
                posture: Box::new(Posture {
                    place: Some(place),
                    ..Posture::default()
                }),
            }));
        }
        let motion = motion.unwrap_or_else(|| Motion::new(MotionKind::Still));
        self.repeated(track, act, motion)
    }

    fn repeated(&mut self, track: &HandTrajectory, act: &Act, motion: Motion) -> Motion {
        let Some(repeat) = act.repeat else {
            return motion;
        };
        self.record_repetition(track, act, repeat);
        Motion::new(MotionKind::Repeated {
            motion: Box::new(motion),
            repetition: Repetition {
                growth: act.grows.map(|increasing| Growth {
                    increasing,
                    size: None,
                }),
                ..Repetition::plain(repeat)
            },
        })
    }
}

/// Returns the relation of two hands that mirror each other at first, and then do not.
fn mirrored(relation: &Relation) -> Relation {
    Relation {
        kind: RelationKind::Alike(MIRRORED),
        residual: relation.residual,
        runner_up: Some((relation.kind, relation.residual)),
    }
}

/// Makes two hands mirror each other in the first posture; the other hand stays still while the dominant
/// one acts.
pub(super) fn mirror(part: &mut Manual) {
    part.hands = HandsUsed::Both(MIRRORED);
    for motion in &mut part.actions {
        if !matches!(motion.kind, MotionKind::Split(..)) {
            let own = std::mem::replace(motion, Motion::new(MotionKind::Still));
            let nothing = Motion::new(MotionKind::Still);
            motion.kind = MotionKind::Split(Some(Box::new(own)), Some(Box::new(nothing)));
        }
    }
}

/// Returns the joints that define a handshape.
fn joints(side: Side) -> impl Iterator<Item = Part> {
    let thumb = (0..3).map(move |n| Part::Thumb(side, n));
    let fingers = Finger::ALL.into_iter();
    thumb.chain(fingers.flat_map(move |finger| (1..4).map(move |n| Part::Finger(side, finger, n))))
}

fn circular(
    axis: Direction,
    size: Option<Size>,
    long: DVec3,
    narrow: f64,
    start: DVec3,
    l: &chereme_sign::hamnosys::BodyLanguage,
) -> Circular {
    let angle = |spoke: DVec3| orientation::angle_about(axis.vector(), spoke.into());
    let start = Compass::nearest(angle(start));
    let ellipse = (narrow < (1.0 + l.ellipse_small) / 2.0).then(|| {
        // From right over up to left.
        let lean = (angle(long).to_degrees() - 90.0).rem_euclid(180.0) / 45.0;
        let lean = lean.round() as u8;
        match lean % 4 {
            0 => Ellipse::Horizontal,
            1 => Ellipse::UpRight,
            2 => Ellipse::Vertical,
            _ => Ellipse::UpLeft,
        }
    });
    Circular {
        axis,
        second: None,
        size: Amount {
            first: size,
            second: None,
        },
        ellipse,
        ellipse_size: ellipse.and_then(|_| {
            // A narrower ellipse is written as a bigger one.
            sized(
                1.0 / narrow,
                [l.ellipse_small, l.ellipse_normal, l.ellipse_big].map(|x| 1.0 / x),
            )
            .best
        }),
        clock: Clock {
            start: (start != Compass::U).then_some(start),
            end: None,
            full: 0,
        },
        zigzag: None,
        growth: None,
    }
}

/// Returns the size whose ratio to a measure is nearest to 1; the residual is the ratio's logarithm.
fn sized(measure: f64, sizes: [f64; 3]) -> Found<Option<Size>> {
    let named = [Some(Size::Small), None, Some(Size::Big)];
    let off = |size: f64| (measure.max(1e-6) / size).ln().abs();
    Found::of(
        named
            .into_iter()
            .zip(sizes)
            .map(|(name, size)| (name, off(size), off(size)))
            .collect(),
    )
}
