//! Fits a skeleton to optical markers: finds the joint rotations that bring it nearest to them.
//!
//! Each marker with a known label belongs to a bone (module `labels`). The skeleton is scaled to the distances of the
//! markers, then turned frame by frame by damped least squares. The place of each marker on its bone is inferred from
//! the frames themselves, as skin and clothing make it differ from any table. One thing is not inferred: the two markers
//! of a wrist lie on the sides of thumb and little finger (module `roll`), without which any turn of a forearm about
//! itself would do. The error of every marker is part of the result, so that nobody takes a fit for a capture without
//! checking.

mod labels;
mod people;
mod roll;
mod solve;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use glam::{DQuat, DVec3};

use crate::anatomy::{Anatomy, Part};
use crate::clip::{Channel, Clip, ClipError};
use crate::hand::Side;
use crate::markers::{Marker, Markers, Space};
use crate::pose::{ModelPose, Pose};
use crate::skeleton::{Joint, Skeleton, SkeletonError};
use crate::time::{Rate, RateError};
use crate::times::Times;

pub use labels::{Attachment, attachment};
use people::Person;
use roll::Wrist;
use solve::{Solver, Target};

/// A skeleton that moves with the markers.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    /// The movement in metres and model space; the skeleton has the size of the markers' body.
    pub clip: Clip,
    /// The size of the skeleton relative to the given one.
    pub scale: f64,
    /// The stature of the markers' body in metres, as the distances between its joints' markers show it. It is not that
    /// of the skeleton if no skeleton is so small or large.
    pub stature: f64,
    /// The markers that were used, in the order of the track.
    pub markers: Vec<FittedMarker>,
    /// The labels of markers that belong to no known bone.
    pub unused: Vec<String>,
    /// The number of markers of other people, which are left out.
    pub others: usize,
    /// The number of frames with too few markers, in which the posture before is held.
    pub held: usize,
    /// The sides whose two wrist markers are not both there: the turn of forearm and palm about the forearm is a guess.
    pub unturned: Vec<Side>,
}

/// The distance of a marker from its place on the skeleton.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedMarker {
    /// Its label.
    pub name: String,
    /// The joint of its bone.
    pub joint: usize,
    /// Its place in that joint's space, in metres.
    pub place: DVec3,
    /// The share of frames in which it is seen, from 0 to 1.
    pub seen: f64,
    /// The median distance in metres.
    pub median: f64,
    /// The distance in metres that is not exceeded in 19 of 20 frames.
    pub most: f64,
    /// The distance in every frame, in metres; NaN in frames in which the marker is not seen.
    pub distances: Vec<f64>,
}

impl Fitted {
    /// Returns the median of the markers' median distances, in metres.
    #[must_use]
    pub fn median(&self) -> f64 {
        middle(self.markers.iter().map(|marker| marker.median).collect())
    }
}

/// A reason why a skeleton cannot be fitted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FitError {
    /// The points are not in metric space.
    #[error("the points have no place in a room; only markers in three dimensions can be fitted")]
    Flat,
    /// Too few labels are known.
    #[error("only {known} of {all} markers have a known label, and {needed} are needed")]
    Few {
        /// The known ones.
        known: usize,
        /// All.
        all: usize,
        /// The needed number.
        needed: usize,
    },
    /// The markers are those of several people.
    #[error("the markers are those of several people: {}", .0.join(", "))]
    People(Vec<String>),
    /// No marker with a known label belongs to that person.
    #[error("no marker with a known label is of {wanted:?}; the people are: {}", known.join(", "))]
    Subject {
        /// The name that was asked for.
        wanted: String,
        /// The people of the markers.
        known: Vec<String>,
    },
    /// No frame has enough markers.
    #[error("no frame has {0} markers with a known label at once")]
    Gaps(usize),
    /// The skeleton has no arms or legs with known joints.
    #[error("the skeleton has no trunk, arms and head with known joints")]
    NoBody,
    /// The track has no rate.
    #[error(transparent)]
    Rate(#[from] RateError),
    /// The skeleton cannot be scaled.
    #[error(transparent)]
    Skeleton(#[from] SkeletonError),
    /// The movement is too long or not finite.
    #[error(transparent)]
    Clip(#[from] ClipError),
}

/// The least number of markers with a known label, in all and in a frame.
const FEWEST: usize = 8;
const FEWEST_SEEN: usize = 6;
/// The least and the largest size of a fitted skeleton relative to the given one.
const SCALES: [f64; 2] = [0.3, 3.0];
/// The number of frames that are used to find the places of markers on their bones, and the number of rounds.
const SAMPLES: usize = 40;
const ROUNDS: usize = 4;
/// The greatest distance of a marker from its expected place on the bone, in metres.
const FARTHEST: f64 = 0.18;
/// The number of solver steps for a frame after its neighbour, and from scratch.
const STEPS: usize = 6;
const FIRST_STEPS: usize = 60;

/// A marker that is used.
struct Used {
    marker: usize,
    joint: usize,
    expected: DVec3,
    place: DVec3,
}

/// Returns the names of the people to whom markers belong if they are those of several, such as `Anna` and `Bob` for
/// `Anna:LSHO` and `Bob:LSHO`: [`fit`] needs the name of one of them then. None if they are those of one person.
#[must_use]
pub fn people(markers: &Markers) -> Vec<String> {
    people::several(markers)
}

/// Fits a skeleton in metres and model space to markers: to those of `subject`, such as `Anna` for `Anna:LSHO`, if it is
/// given.
///
/// # Errors
/// [`FitError`] if the points are not in metric space, belong to several people and `subject` names none of them, too few
/// labels are known, no frame has enough markers, or the skeleton is not that of a body.
pub fn fit(
    markers: &Markers,
    skeleton: &Skeleton,
    anatomy: &Anatomy,
    subject: Option<&str>,
) -> Result<Fitted, FitError> {
    if !matches!(markers.space(), Space::World(_)) {
        return Err(FitError::Flat);
    }
    let Some(measures) = anatomy
        .measures()
        .filter(|_| anatomy.joint(Part::Head).is_some())
    else {
        return Err(FitError::NoBody);
    };
    let shown: Vec<Vec<Option<DVec3>>> = (0..markers.frames()).map(|f| shown(markers, f)).collect();
    let Person { labels, others } = people::person(markers, subject)?;
    let measured = scale(&shown, &labels, skeleton, anatomy);
    let scale = measured.clamp(SCALES[0], SCALES[1]);
    let skeleton = scaled(skeleton, scale)?;
    let rest = skeleton.rest_model_pose();
    let mut used: Vec<Used> = Vec::new();
    let mut unused = Vec::new();
    for (marker, point) in markers.points().iter().enumerate() {
        let found = labels[marker].and_then(|it| anchored(it, &rest, &skeleton, anatomy));
        match found {
            Some((joint, expected)) => used.push(Used {
                marker,
                joint,
                expected,
                place: expected,
            }),
            None if subject.is_some() && others[marker] => {}
            None => unused.push(full_name(point)),
        }
    }
    if used.len() < FEWEST {
        return Err(FitError::Few {
            known: used.len(),
            all: markers.points().len(),
            needed: FEWEST,
        });
    }
    let seen = |frame: usize| {
        used.iter()
            .filter(|it| shown[frame][it.marker].is_some())
            .count()
    };
    let whole: Vec<usize> = (0..shown.len())
        .filter(|&f| seen(f) >= FEWEST_SEEN)
        .collect();
    if whole.is_empty() {
        return Err(FitError::Gaps(FEWEST_SEEN));
    }
    let wrists = Side::BOTH.map(|side| Wrist::of(side, &used, &labels, &shown, &rest, anatomy));
    let unturned = Side::BOTH.into_iter().zip(&wrists);
    let unturned = unturned.filter_map(|(side, wrist)| wrist.is_none().then_some(side));
    let unturned: Vec<Side> = unturned.collect();
    let wrists: Vec<Wrist> = wrists.into_iter().flatten().collect();
    let mut solver = Solver::new(&skeleton, used.iter().map(|it| it.joint));
    calibrate(&mut solver, &mut used, &wrists, &shown, &whole, &skeleton);
    let moved = all_frames(&mut solver, &used, &shown, &skeleton);
    let rate = rate(markers)?;
    let others = match subject {
        Some(_) => others.into_iter().filter(|it| *it).count(),
        None => 0,
    };
    let fitted = finish(
        markers,
        skeleton,
        (scale, measured * measures.stature),
        rate,
        (used, unused, unturned),
        &shown,
        moved,
    )?;
    Ok(Fitted { others, ..fitted })
}

/// Returns the places of a frame; a place at exactly 0 0 0 in the file is a gap that a program wrote so.
fn shown(markers: &Markers, frame: usize) -> Vec<Option<DVec3>> {
    let points = markers.points().iter().zip(markers.shown(frame));
    let seen = points.map(|(point, at)| at.filter(|_| point.at(frame) != Some(DVec3::ZERO)));
    seen.collect()
}

/// Finds the places of markers on their bones from frames over the whole take.
fn calibrate(
    solver: &mut Solver,
    used: &mut [Used],
    wrists: &[Wrist],
    shown: &[Vec<Option<DVec3>>],
    whole: &[usize],
    skeleton: &Skeleton,
) {
    let count = whole.len().min(SAMPLES);
    let samples: Vec<usize> = (0..count)
        .map(|n| whole[n * (whole.len() - 1) / (count - 1).max(1)])
        .collect();
    let mut poses: Vec<Option<Pose>> = vec![None; samples.len()];
    for round in 0..ROUNDS {
        let mut before: Option<Pose> = None;
        for (pose, &frame) in poses.iter_mut().zip(&samples) {
            let targets = targets(used, &shown[frame]);
            let (start, steps) = match pose.take().or_else(|| before.clone()) {
                Some(pose) => (pose, if round == 0 { FIRST_STEPS } else { 4 * STEPS }),
                None => (upright(&targets, skeleton), FIRST_STEPS),
            };
            let solved = solver.solve(start, &targets, steps);
            before = Some(solved.clone());
            *pose = Some(solved);
        }
        let models: Vec<ModelPose> = poses
            .iter()
            .flatten()
            .map(|pose| ModelPose::of(skeleton, pose))
            .collect();
        for it in used.iter_mut() {
            let places: Vec<DVec3> = samples
                .iter()
                .zip(&models)
                .filter_map(|(&frame, model)| {
                    let at = shown[frame][it.marker]? - model.position(it.joint);
                    Some(model.rotation(it.joint).inverse() * at)
                })
                .collect();
            if places.is_empty() {
                continue;
            }
            let median = DVec3::from_array(
                [0, 1, 2].map(|axis| middle(places.iter().map(|at| at[axis]).collect())),
            );
            it.place = it.expected + (median - it.expected).clamp_length_max(FARTHEST);
        }
        for wrist in wrists {
            wrist.turn(used);
        }
    }
}

/// The postures of all frames, and how many of them are held because of missing markers.
struct Moved {
    poses: Vec<Pose>,
    held: usize,
}

fn all_frames(
    solver: &mut Solver,
    used: &[Used],
    shown: &[Vec<Option<DVec3>>],
    skeleton: &Skeleton,
) -> Moved {
    let mut moved = Moved {
        poses: Vec::with_capacity(shown.len()),
        held: 0,
    };
    let mut first = true;
    for frame in shown {
        let targets = targets(used, frame);
        if targets.len() < FEWEST_SEEN {
            let held = moved.poses.last().cloned();
            moved
                .poses
                .push(held.unwrap_or_else(|| skeleton.rest_pose()));
            moved.held += 1;
            continue;
        }
        let (start, steps) = match moved.poses.last().filter(|_| !first) {
            Some(before) => (before.clone(), STEPS),
            None => (upright(&targets, skeleton), FIRST_STEPS),
        };
        first = false;
        moved.poses.push(solver.solve(start, &targets, steps));
    }
    moved
}

fn targets(used: &[Used], shown: &[Option<DVec3>]) -> Vec<Target> {
    let target = |it: &Used| {
        Some(Target {
            joint: it.joint,
            place: it.place,
            at: shown[it.marker]?,
        })
    };
    used.iter().filter_map(target).collect()
}

/// Returns the rest posture, turned about the vertical and moved so that it fits the markers best.
fn upright(targets: &[Target], skeleton: &Skeleton) -> Pose {
    let mut pose = skeleton.rest_pose();
    let rest = ModelPose::of(skeleton, &pose);
    let count = targets.len().max(1) as f64;
    let own: Vec<DVec3> = targets
        .iter()
        .map(|target| rest.point(target.joint, target.place))
        .collect();
    let from = own.iter().sum::<DVec3>() / count;
    let to = targets.iter().map(|target| target.at).sum::<DVec3>() / count;
    let (mut sine, mut cosine) = (0.0, 0.0);
    for (own, target) in own.iter().zip(targets) {
        let (a, b) = (*own - from, target.at - to);
        cosine += a.x * b.x + a.z * b.z;
        sine += a.z * b.x - a.x * b.z;
    }
    let turn = DQuat::from_rotation_y(sine.atan2(cosine));
    pose.rotations[0] = turn * pose.rotations[0];
    pose.translations[0] = to + turn * (pose.translations[0] - from);
    pose
}

/// Returns the joint of a marker and its expected place in that joint's space.
fn anchored(
    label: Attachment,
    rest: &ModelPose,
    skeleton: &Skeleton,
    anatomy: &Anatomy,
) -> Option<(usize, DVec3)> {
    let joint = label.on.iter().find_map(|&part| anatomy.joint(part))?;
    let from = rest.position(joint);
    let at = match label.towards {
        None => from,
        Some((part, share)) => {
            let end = match anatomy.joint(part) {
                Some(end) => rest.position(end),
                None => rest.tip(skeleton, joint)?,
            };
            from.lerp(end, share)
        }
    };
    let beside = roll::beside(label, rest, anatomy).unwrap_or_default();
    let at = at + beside;
    Some((joint, rest.rotation(joint).inverse() * (at - from)))
}

/// Returns the size of the markers' body relative to the skeleton, from the distances of markers at the ends of its
/// limbs.
fn scale(
    shown: &[Vec<Option<DVec3>>],
    labels: &[Option<Attachment>],
    skeleton: &Skeleton,
    anatomy: &Anatomy,
) -> f64 {
    let rest = skeleton.rest_model_pose();
    let at = |part: Part, frame: &[Option<DVec3>]| {
        let places: Vec<DVec3> = labels
            .iter()
            .zip(frame)
            .filter(|(label, _)| label.is_some_and(|it| it.near == Some(part)))
            .filter_map(|(_, at)| *at)
            .collect();
        let count = places.len() as f64;
        (count > 0.0).then(|| places.iter().sum::<DVec3>() / count)
    };
    let mut ratios = Vec::new();
    for side in Side::BOTH {
        let bones = [
            (Part::UpperArm(side), Part::Forearm(side)),
            (Part::Forearm(side), Part::Hand(side)),
            (Part::Shin(side), Part::Foot(side)),
        ];
        for (from, to) in bones {
            let (Some(a), Some(b)) = (anatomy.joint(from), anatomy.joint(to)) else {
                continue;
            };
            let own = rest.position(a).distance(rest.position(b));
            let lengths: Vec<f64> = shown
                .iter()
                .filter_map(|frame| Some(at(from, frame)?.distance(at(to, frame)?)))
                .collect();
            if own > 1e-6 && !lengths.is_empty() {
                ratios.push(middle(lengths) / own);
            }
        }
    }
    if ratios.is_empty() {
        return 1.0;
    }
    middle(ratios)
}

fn scaled(skeleton: &Skeleton, scale: f64) -> Result<Skeleton, SkeletonError> {
    let joint = |joint: &Joint| Joint {
        offset: joint.offset * scale,
        tip: joint.tip.map(|tip| tip * scale),
        ..joint.clone()
    };
    Skeleton::new(skeleton.joints().iter().map(joint).collect())
}

fn rate(markers: &Markers) -> Result<Rate, RateError> {
    if let Times::Even(rate) = markers.times() {
        return Ok(*rate);
    }
    let seconds = markers.span().seconds().max(1e-6);
    let per_second = (markers.frames() as f64 / seconds * 1000.0).round();
    Rate::new(per_second.clamp(1.0, 4e9) as u32, 1000)
}

fn finish(
    markers: &Markers,
    skeleton: Skeleton,
    (scale, stature): (f64, f64),
    rate: Rate,
    (used, unused, unturned): (Vec<Used>, Vec<String>, Vec<Side>),
    shown: &[Vec<Option<DVec3>>],
    moved: Moved,
) -> Result<Fitted, FitError> {
    let skeleton = Arc::new(skeleton);
    let models: Vec<ModelPose> = moved
        .poses
        .iter()
        .map(|pose| ModelPose::of(&skeleton, pose))
        .collect();
    let fitted = used.iter().map(|it| {
        let distances: Vec<f64> = shown
            .iter()
            .zip(&models)
            .map(|(frame, model)| {
                frame[it.marker].map_or(f64::NAN, |at| at.distance(model.point(it.joint, it.place)))
            })
            .collect();
        let mut off: Vec<f64> = distances
            .iter()
            .copied()
            .filter(|it| !it.is_nan())
            .collect();
        off.sort_by(f64::total_cmp);
        let most = off.get(off.len() * 19 / 20).or(off.last()).copied();
        FittedMarker {
            name: full_name(&markers.points()[it.marker]),
            joint: it.joint,
            place: it.place,
            seen: off.len() as f64 / shown.len().max(1) as f64,
            most: most.unwrap_or_default(),
            median: middle(off),
            distances,
        }
    });
    let fitted = fitted.collect();
    let channels = (0..skeleton.len()).map(|joint| Channel {
        rotations: moved.poses.iter().map(|it| it.rotations[joint]).collect(),
        translations: (joint == 0)
            .then(|| moved.poses.iter().map(|it| it.translations[0]).collect()),
    });
    Ok(Fitted {
        clip: Clip::new(skeleton.clone(), rate, channels.collect())?,
        scale,
        stature,
        markers: fitted,
        unused,
        others: 0,
        held: moved.held,
        unturned,
    })
}

/// Returns the name of a marker with its subject: `Anna:LSHO`.
fn full_name(point: &Marker) -> String {
    match point.group.is_empty() {
        true => point.name.clone(),
        false => format!("{}:{}", point.group, point.name),
    }
}

fn middle(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or_default()
}
