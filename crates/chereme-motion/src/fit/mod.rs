//! Fits a skeleton to optical markers: finds the joint rotations that bring it nearest to them.
//!
//! Each marker with a known label belongs to a bone (module `labels`). The skeleton is scaled to the distances of the
//! markers, then turned frame by frame by damped least squares. The place of each marker on its bone is inferred from
//! the frames themselves, as skin and clothing make it differ from any table. One thing is not inferred: the two markers
//! of a wrist lie on the sides of thumb and little finger (module `roll`), without which any turn of a forearm about
//! itself would do. The error of every marker is part of the result, so that nobody takes a fit for a capture without
//! checking.

mod fit_labels;
mod fit_people;
mod fit_solve;
mod roll;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use glam::{DQuat, DVec3};

use crate::anatomy::{BodyAnatomy, BodyPart};
use crate::clip::{Clip, ClipError, JointChannel};
use crate::hand::BodySide;
use crate::markers::{MarkerSpace, MarkerTrack, MotionMarker};
use crate::pose::{LocalPose, ModelPose};
use crate::skeleton::{Skeleton, SkeletonError, SkeletonJoint};
use crate::time::{FrameRate, RateError};
use crate::times::FrameTimes;

pub use fit_labels::{MarkerAttachment, find_marker_attachment};
use fit_people::MarkerPerson;
use fit_solve::{FitSolver, MarkerTarget};
use roll::WristMarkers;

/// A skeleton that moves with the markers.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedSkeleton {
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
    pub unturned: Vec<BodySide>,
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

impl FittedSkeleton {
    /// Returns the median of the markers' median distances, in metres.
    #[must_use]
    pub fn median_marker_distance(&self) -> f64 {
        median_of_values(self.markers.iter().map(|marker| marker.median).collect())
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
const MIN_LABELLED_MARKERS: usize = 8;
const FEWEST_SEEN: usize = 6;
/// The least and the largest size of a fitted skeleton relative to the given one.
const FIT_SCALE_LIMITS: [f64; 2] = [0.3, 3.0];
/// The number of frames that are used to find the places of markers on their bones, and the number of rounds.
const FIT_SAMPLE_FRAMES: usize = 40;
const FIT_SAMPLE_ROUNDS: usize = 4;
/// The greatest distance of a marker from its expected place on the bone, in metres.
const MAX_MARKER_DISTANCE_M: f64 = 0.18;
/// The number of solver steps for a frame after its neighbour, and from scratch.
const FIT_SOLVER_STEPS: usize = 6;
const FIRST_STEPS: usize = 60;

/// A marker that is used.
struct UsedMarker {
    marker: usize,
    joint: usize,
    expected: DVec3,
    place: DVec3,
}

/// Returns the names of the people to whom markers belong if they are those of several, such as `Anna` and `Bob` for
/// `Anna:LSHO` and `Bob:LSHO`: [`fit_skeleton`] needs the name of one of them then. None if they are those of one person.
#[must_use]
pub fn people_of_markers(markers: &MarkerTrack) -> Vec<String> {
    fit_people::list_marker_people(markers)
}

/// Fits a skeleton in metres and model space to markers: to those of `subject`, such as `Anna` for `Anna:LSHO`, if it is
/// given.
///
/// # Errors
/// [`FitError`] if the points are not in metric space, belong to several people and `subject` names none of them, too few
/// labels are known, no frame has enough markers, or the skeleton is not that of a body.
pub fn fit_skeleton(
    markers: &MarkerTrack,
    skeleton: &Skeleton,
    anatomy: &BodyAnatomy,
    subject: Option<&str>,
) -> Result<FittedSkeleton, FitError> {
    if !matches!(markers.marker_space(), MarkerSpace::World(_)) {
        return Err(FitError::Flat);
    }
    let Some(measures) = anatomy
        .anatomy_measures()
        .filter(|_| anatomy.part_joint(BodyPart::Head).is_some())
    else {
        return Err(FitError::NoBody);
    };
    let shown: Vec<Vec<Option<DVec3>>> = (0..markers.marker_frame_count())
        .map(|f| visible_marker_places(markers, f))
        .collect();
    let MarkerPerson { labels, others } = fit_people::select_marker_person(markers, subject)?;
    // The stature below keeps the measured size; only the skeleton is held within limits.
    let measured = estimate_body_scale(&shown, &labels, skeleton, anatomy);
    let scale = measured.clamp(FIT_SCALE_LIMITS[0], FIT_SCALE_LIMITS[1]);
    let skeleton = scaled_skeleton(skeleton, scale)?;
    let rest = skeleton.rest_model_pose();
    let mut used: Vec<UsedMarker> = Vec::new();
    let mut unused = Vec::new();
    for (marker, point) in markers.marker_points().iter().enumerate() {
        let label_anchor = labels[marker].and_then(|label| anchored(label, &rest, &skeleton, anatomy));
        match label_anchor {
            Some((joint, expected)) => used.push(UsedMarker {
                marker,
                joint,
                expected,
                place: expected,
            }),
            // With a subject given, markers of others are left out on purpose and are not called unused.
            None if subject.is_some() && others[marker] => {}
            None => unused.push(full_name(point)),
        }
    }
    if used.len() < MIN_LABELLED_MARKERS {
        return Err(FitError::Few {
            known: used.len(),
            all: markers.marker_points().len(),
            needed: MIN_LABELLED_MARKERS,
        });
    }
    let seen = |frame: usize| {
        used.iter()
            .filter(|marker| shown[frame][marker.marker].is_some())
            .count()
    };
    // Frames with few markers would calibrate the rest of the body to its rest pose.
    let full_frames: Vec<usize> = (0..shown.len()).filter(|&f| seen(f) >= FEWEST_SEEN).collect();
    if full_frames.is_empty() {
        return Err(FitError::Gaps(FEWEST_SEEN));
    }
    // Which sides can be read is settled before calibration, which needs their turn in each round.
    let wrists =
        BodySide::BOTH_SIDES.map(|side| WristMarkers::find_wrist_markers(side, &used, &labels, &shown, &rest, anatomy));
    let unturned_sides = BodySide::BOTH_SIDES.into_iter().zip(&wrists);
    let unturned = unturned_sides.filter_map(|(side, wrist)| wrist.is_none().then_some(side));
    let unturned: Vec<BodySide> = unturned.collect();
    let wrists: Vec<WristMarkers> = wrists.into_iter().flatten().collect();
    let mut solver = FitSolver::new(&skeleton, used.iter().map(|marker| marker.joint));
    calibrate(&mut solver, &mut used, &wrists, &shown, &full_frames, &skeleton);
    let moved = all_frames(&mut solver, &used, &shown, &skeleton);
    let rate = infer_marker_rate(markers)?;
    let others = match subject {
        Some(_) => others.into_iter().filter(|is_other| *is_other).count(),
        None => 0,
    };
    let skeleton = Arc::new(skeleton);
    Ok(FittedSkeleton {
        clip: fitted_clip(&skeleton, rate, &moved.poses)?,
        scale,
        stature: measured * measures.stature,
        markers: measure_fitted_markers(markers, &used, &shown, &skeleton, &moved.poses),
        unused,
        others,
        held: moved.held,
        unturned,
    })
}

/// Returns the places of a frame; a place at exactly 0 0 0 in the file is a gap that a program wrote so.
fn visible_marker_places(markers: &MarkerTrack, frame: usize) -> Vec<Option<DVec3>> {
    let points = markers.marker_points().iter().zip(markers.displayed_markers(frame));
    let seen = points.map(|(point, at)| at.filter(|_| point.marker_position(frame) != Some(DVec3::ZERO)));
    seen.collect()
}

/// Finds the places of markers on their bones from frames over the whole take.
fn calibrate(
    solver: &mut FitSolver,
    used: &mut [UsedMarker],
    wrists: &[WristMarkers],
    shown: &[Vec<Option<DVec3>>],
    whole: &[usize],
    skeleton: &Skeleton,
) {
    let count = whole.len().min(FIT_SAMPLE_FRAMES);
    // Spread evenly from the first full frame to the last, over postures as different as possible.
    let samples: Vec<usize> = (0..count)
        .map(|n| whole[n * (whole.len() - 1) / (count - 1).max(1)])
        .collect();
    let mut poses: Vec<Option<LocalPose>> = vec![None; samples.len()];
    for round in 0..FIT_SAMPLE_ROUNDS {
        let mut before: Option<LocalPose> = None;
        for (pose, &frame) in poses.iter_mut().zip(&samples) {
            let targets = marker_targets(used, &shown[frame]);
            let (start, steps) = match pose.take().or_else(|| before.clone()) {
                // Later rounds start from the round before, so that few steps are enough.
                Some(pose) => (pose, if round == 0 { FIRST_STEPS } else { 4 * FIT_SOLVER_STEPS }),
                None => (upright_rest_pose(&targets, skeleton), FIRST_STEPS),
            };
            let solved = solver.solve_fit_pose(start, &targets, steps);
            before = Some(solved.clone());
            *pose = Some(solved);
        }
        let models: Vec<ModelPose> = poses
            .iter()
            .flatten()
            .map(|pose| ModelPose::from_local_pose(skeleton, pose))
            .collect();
        for it in used.iter_mut() {
            let places: Vec<DVec3> = samples
                .iter()
                .zip(&models)
                .filter_map(|(&frame, model)| {
                    let marker_offset = shown[frame][it.marker]? - model.model_joint_position(it.joint);
                    Some(model.model_joint_rotation(it.joint).inverse() * marker_offset)
                })
                .collect();
            if places.is_empty() {
                continue;
            }
            let median =
                // The median in each axis: a marker that was swapped for a while does not move it.
                DVec3::from_array([0, 1, 2].map(|axis| median_of_values(places.iter().map(|at| at[axis]).collect())));
            // Beyond this distance the label is wrong rather than the body thick.
            it.place = it.expected + (median - it.expected).clamp_length_max(MAX_MARKER_DISTANCE_M);
        }
        for wrist in wrists {
            wrist.turn_forearm_markers(used);
        }
    }
}

/// The postures of all frames, and how many of them are held because of missing markers.
struct FittedMotion {
    poses: Vec<LocalPose>,
    held: usize,
}

fn all_frames(
    solver: &mut FitSolver,
    used: &[UsedMarker],
    shown: &[Vec<Option<DVec3>>],
    skeleton: &Skeleton,
) -> FittedMotion {
    let mut moved = FittedMotion {
        poses: Vec::with_capacity(shown.len()),
        held: 0,
    };
    let mut first = true;
    for frame in shown {
        let targets = marker_targets(used, frame);
        if targets.len() < FEWEST_SEEN {
            // The posture before is held over a gap; a gap at the start shows the rest pose.
            let last_pose = moved.poses.last().cloned();
            moved.poses.push(last_pose.unwrap_or_else(|| skeleton.rest_pose()));
            moved.held += 1;
            continue;
        }
        let (start, steps) = match moved.poses.last().filter(|_| !first) {
            // A held rest pose before the first markers is no good start for the solver.
            Some(before) => (before.clone(), FIT_SOLVER_STEPS),
            None => (upright_rest_pose(&targets, skeleton), FIRST_STEPS),
        };
        first = false;
        moved.poses.push(solver.solve_fit_pose(start, &targets, steps));
    }
    moved
}

fn marker_targets(used: &[UsedMarker], shown: &[Option<DVec3>]) -> Vec<MarkerTarget> {
    let target = |marker: &UsedMarker| {
        Some(MarkerTarget {
            joint: marker.joint,
            place: marker.place,
            at: shown[marker.marker]?,
        })
    };
    used.iter().filter_map(target).collect()
}

/// Returns the rest posture, turned about the vertical and moved so that it fits the markers best.
fn upright_rest_pose(targets: &[MarkerTarget], skeleton: &Skeleton) -> LocalPose {
    let mut pose = skeleton.rest_pose();
    let rest = ModelPose::from_local_pose(skeleton, &pose);
    let count = targets.len().max(1) as f64;
    let rest_points: Vec<DVec3> = targets
        .iter()
        .map(|target| rest.joint_point_to_model(target.joint, target.place))
        .collect();
    let from = rest_points.iter().sum::<DVec3>() / count;
    let to = targets.iter().map(|target| target.at).sum::<DVec3>() / count;
    let (mut sine, mut cosine) = (0.0, 0.0);
    // The best turn about the vertical in closed form: the angle of summed cross and dot products.
    for (own, target) in rest_points.iter().zip(targets) {
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
    label: MarkerAttachment,
    rest: &ModelPose,
    skeleton: &Skeleton,
    anatomy: &BodyAnatomy,
) -> Option<(usize, DVec3)> {
    let joint = label.on.iter().find_map(|&part| anatomy.part_joint(part))?;
    let from = rest.model_joint_position(joint);
    let line_place = match label.towards {
        None => from,
        Some((part, share)) => {
            let end = match anatomy.part_joint(part) {
                // A skeleton without the part's joint may still have its bone's end.
                Some(end) => rest.model_joint_position(end),
                None => rest.bone_tip_position(skeleton, joint)?,
            };
            from.lerp(end, share)
        }
    };
    let roll_offset = roll::marker_bone_shift(label, rest, anatomy).unwrap_or_default();
    let anchor_place = line_place + roll_offset;
    Some((
        joint,
        rest.model_joint_rotation(joint).inverse() * (anchor_place - from),
    ))
}

/// Returns the size of the markers' body relative to the skeleton, from the distances of markers at the ends of its
/// limbs.
fn estimate_body_scale(
    shown: &[Vec<Option<DVec3>>],
    labels: &[Option<MarkerAttachment>],
    skeleton: &Skeleton,
    anatomy: &BodyAnatomy,
) -> f64 {
    let rest = skeleton.rest_model_pose();
    let part_place = |part: BodyPart, frame: &[Option<DVec3>]| {
        let places: Vec<DVec3> = labels
            .iter()
            .zip(frame)
            .filter(|(label, _)| label.is_some_and(|attachment| attachment.near == Some(part)))
            .filter_map(|(_, at)| *at)
            .collect();
        let count = places.len() as f64;
        (count > 0.0).then(|| places.iter().sum::<DVec3>() / count)
    };
    let mut ratios = Vec::new();
    for side in BodySide::BOTH_SIDES {
        let bones = [
            (BodyPart::UpperArm(side), BodyPart::Forearm(side)),
            (BodyPart::Forearm(side), BodyPart::Hand(side)),
            (BodyPart::Shin(side), BodyPart::Foot(side)),
        ];
        for (from, to) in bones {
            // Thighs are left out, since hip markers lie on the pelvis and not at its joints.
            let (Some(a), Some(b)) = (anatomy.part_joint(from), anatomy.part_joint(to)) else {
                continue;
            };
            let rest_length = rest.model_joint_position(a).distance(rest.model_joint_position(b));
            let lengths: Vec<f64> = shown
                .iter()
                .filter_map(|frame| Some(part_place(from, frame)?.distance(part_place(to, frame)?)))
                .collect();
            if rest_length > 1e-6 && !lengths.is_empty() {
                ratios.push(median_of_values(lengths) / rest_length);
            }
        }
    }
    if ratios.is_empty() {
        return 1.0;
    }
    // The median of the bones: one label on the wrong joint does not scale the body.
    median_of_values(ratios)
}

fn scaled_skeleton(skeleton: &Skeleton, scale: f64) -> Result<Skeleton, SkeletonError> {
    let joint = |joint: &SkeletonJoint| SkeletonJoint {
        offset: joint.offset * scale,
        tip: joint.tip.map(|tip| tip * scale),
        ..joint.clone()
    };
    Skeleton::new(skeleton.skeleton_joints().iter().map(joint).collect())
}

fn infer_marker_rate(markers: &MarkerTrack) -> Result<FrameRate, RateError> {
    if let FrameTimes::Even(rate) = markers.marker_times() {
        return Ok(*rate);
    }
    let seconds = markers.marker_track_span().span_seconds().max(1e-6);
    // Thousandths of a frame a second keep broadcast rates apart.
    let per_second = (markers.marker_frame_count() as f64 / seconds * 1000.0).round();
    FrameRate::new(per_second.clamp(1.0, 4e9) as u32, 1000)
}

fn fitted_clip(skeleton: &Arc<Skeleton>, rate: FrameRate, poses: &[LocalPose]) -> Result<Clip, FitError> {
    let channels = (0..skeleton.len()).map(|joint| JointChannel {
        rotations: poses.iter().map(|pose| pose.rotations[joint]).collect(),
        // Bones keep their length: only the root moves.
        translations: (joint == 0).then(|| poses.iter().map(|pose| pose.translations[0]).collect()),
    });
    Ok(Clip::new(skeleton.clone(), rate, channels.collect())?)
}

/// Returns for each used marker how far from its place on the fitted body it was recorded.
fn measure_fitted_markers(
    markers: &MarkerTrack,
    used: &[UsedMarker],
    shown: &[Vec<Option<DVec3>>],
    skeleton: &Skeleton,
    poses: &[LocalPose],
) -> Vec<FittedMarker> {
    let models: Vec<ModelPose> = poses
        .iter()
        .map(|pose| ModelPose::from_local_pose(skeleton, pose))
        .collect();
    let fitted = used.iter().map(|marker| {
        let distances: Vec<f64> = shown
            .iter()
            .zip(&models)
            .map(|(frame, model)| {
                frame[marker.marker].map_or(f64::NAN, |at| {
                    at.distance(model.joint_point_to_model(marker.joint, marker.place))
                })
            })
            .collect();
        let mut off: Vec<f64> = distances
            .iter()
            .copied()
            .filter(|distance| !distance.is_nan())
            .collect();
        off.sort_by(f64::total_cmp);
        // An empty list of distances, for a marker that is never seen, gives no value.
        let most = off.get(off.len() * 19 / 20).or(off.last()).copied();
        FittedMarker {
            name: full_name(&markers.marker_points()[marker.marker]),
            joint: marker.joint,
            place: marker.place,
            seen: off.len() as f64 / shown.len().max(1) as f64,
            most: most.unwrap_or_default(),
            median: median_of_values(off),
            distances,
        }
    });
    fitted.collect()
}

/// Returns the name of a marker with its subject: `Anna:LSHO`.
fn full_name(point: &MotionMarker) -> String {
    match point.group.is_empty() {
        true => point.name.clone(),
        false => format!("{}:{}", point.group, point.name),
    }
}

fn median_of_values(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or_default()
}
