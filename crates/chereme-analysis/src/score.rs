//! Scores the similarity of two performances: their distance under the best alignment, component by
//! component.
//!
//! Each frame of a clip becomes a point of up to 66 channels, per hand:
//!
//! | component | channels | counts as 1 ([`ComponentScales`]) |
//! |---|---|---|
//! | placement | the wrist left, up and forward of the shoulders' middle, in shoulder widths | 0.2: a hand's breadth |
//! | movement | the wrist's velocity along the same axes, in shoulder widths per second | 2: about 0.7 m/s |
//! | orientation | unit vectors out of the palm and along the hand, in the trunk's axes | 0.73: both turned by 30 degrees |
//! | configuration | the 21 angles of thumb and fingers, in radians | 1.6: all off by 20 degrees |
//!
//! The numbers describe the body, not the skeleton, so clips of different skeletons, sizes and places on
//! the floor are comparable; channels that one of them lacks, or that nobody captured, are left out and reported. The
//! points are aligned by [dynamic time warping](crate::dtw).

use std::collections::BTreeMap;
use std::ops::Range;

use chereme_motion::anatomy::BodyFrame;
use chereme_motion::{BodyAnatomy, BodyPart, BodySide, Clip, FrameRate, HandAngles, ModelPose};
use chereme_sign::SignComponent;
use serde::{Deserialize, Serialize};

use crate::dtw::{self, ChannelSeries, CostMethod, DtwAlignment, DtwError};

/// Half the time over which a velocity is measured, in seconds: longer than the jitter of
/// captured markers, shorter than a stroke.
const VELOCITY_SECONDS: f64 = 0.025;

/// The amount of each component that counts as 1, over all its channels of one hand.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ComponentScales {
    /// Distance of the wrists in shoulder widths.
    pub placement: f64,
    /// Difference of the wrists' velocities in shoulder widths per second.
    pub movement: f64,
    /// Root of the sum of squares of both unit vectors' differences.
    pub orientation: f64,
    /// Root of the sum of squares of the angles' differences in radians.
    pub configuration: f64,
}

impl Default for ComponentScales {
    fn default() -> Self {
        Self {
            placement: 0.2,
            movement: 2.0,
            orientation: 0.73,
            configuration: 1.6,
        }
    }
}

impl ComponentScales {
    fn component_scale(&self, component: SignComponent) -> f64 {
        match component {
            SignComponent::Placement => self.placement,
            SignComponent::Movement => self.movement,
            SignComponent::Orientation => self.orientation,
            SignComponent::Configuration | SignComponent::NonManual => self.configuration,
        }
    }
}

/// Options of a score.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ScoreOptions {
    /// Options of the alignment: by default symmetric2 without a window, for which a path always exists.
    /// The first clip is the query.
    pub dtw: dtw::DtwOptions,
    /// The amounts that count as 1.
    pub scales: ComponentScales,
}

/// The similarity of two clips.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ClipSimilarityScore {
    /// The cost of the best alignment, in units of [`ComponentScales`] summed over time.
    pub distance: f64,
    /// The distance divided by the path's weight; `None` if the step pattern has no norm.
    pub normalized: Option<f64>,
    /// For each component, its own distance over the same alignment (both hands together), in its own unit and
    /// divided like `normalized`, which none of them exceeds; without a norm, the mean over the alignment.
    pub components: BTreeMap<SignComponent, f64>,
    /// The largest model-space distance, in metres, of a joint or a bone's tip to its counterpart: frame
    /// by frame if the clips have the same number of frames, else of aligned frames. `None` if the
    /// skeletons have no joint in common.
    pub max_joint_error_m: Option<f64>,
    /// The place of that error.
    pub worst: Option<WorstJoint>,
    /// Corresponding frames of the first and of the second clip.
    pub alignment: Vec<(usize, usize)>,
    /// Whether the policy for missing paths was needed.
    pub made: CostMethod,
    /// The components that were not compared, because one or both of the clips do not show them.
    pub left_out: Vec<UncomparedComponent>,
    /// Joints of the first clip without a counterpart in the second, by name.
    pub only_in_first: Vec<String>,
    /// Joints of the second clip without a counterpart in the first, by name.
    pub only_in_second: Vec<String>,
}

/// The joint that is farthest from its counterpart, with the frames.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct WorstJoint {
    /// Its name in the first clip.
    pub joint: String,
    /// The frame of the first and of the second clip.
    pub frames: (usize, usize),
}

/// A component of one hand that was not compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct UncomparedComponent {
    /// The component.
    pub component: SignComponent,
    /// The hand.
    pub side: BodySide,
    /// Whether the first and the second clip show it.
    pub shown: (bool, bool),
    /// Whether the first and the second clip have joints for it, but nobody captured them.
    #[serde(default)]
    pub uncaptured: (bool, bool),
}

/// A clip to be scored, with the parts of its body.
#[derive(Debug, Clone, Copy)]
pub struct PerformedClip<'a> {
    /// The movement.
    pub clip: &'a Clip,
    /// The parts of the body.
    pub anatomy: &'a BodyAnatomy,
    /// The hands whose fingers nobody captured; their handshapes are not compared.
    pub uncaptured: &'a [BodySide],
}

/// The reason why two clips cannot be scored.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ScoreError {
    /// A clip has no frames.
    #[error("the {which} clip has no frames; score stretches of at least one frame")]
    Empty {
        /// `first` or `second`.
        which: &'static str,
    },
    /// The two skeletons show no component in common.
    #[error(
        "the two skeletons have no arm or hand in common to compare; name their joints' roles if \
         they have"
    )]
    NothingInCommon,
    /// Nothing but handshapes could be compared, and nobody captured them.
    #[error(
        "the two have only handshapes in common, and nobody captured them, as the fingers rest throughout; compare \
         recordings whose fingers move, or that have joints of the arms"
    )]
    NothingCaptured,
    /// The alignment failed.
    #[error(transparent)]
    Dtw(#[from] DtwError),
}

/// Returns the score of two clips, with the parts of their bodies found by joint names.
///
/// # Errors
/// The same as [`score_as`]'s.
pub fn score_clips(a: &Clip, b: &Clip, options: &ScoreOptions) -> Result<ClipSimilarityScore, ScoreError> {
    let (first, second) = (
        BodyAnatomy::detect_anatomy(a.clip_skeleton()),
        BodyAnatomy::detect_anatomy(b.clip_skeleton()),
    );
    let performed = |clip, anatomy| PerformedClip {
        clip,
        anatomy,
        uncaptured: &[],
    };
    score_as(performed(a, &first), performed(b, &second), options)
}

/// Returns the score of two clips, given the anatomy of each and the hands that were not captured.
///
/// # Errors
/// [`ScoreError`] if a clip has no frames, the skeletons have no captured component in common, a scale is not positive,
/// or [`dtw::align_series`] refuses (no path under the requested pattern and window, too many cells).
pub fn score_as(
    a: PerformedClip<'_>,
    b: PerformedClip<'_>,
    options: &ScoreOptions,
) -> Result<ClipSimilarityScore, ScoreError> {
    for (performed, which) in [(a, "first"), (b, "second")] {
        if performed.clip.clip_frame_count() == 0 {
            return Err(ScoreError::Empty { which });
        }
    }
    let uncaptured = (a.uncaptured, b.uncaptured);
    let (mut first, mut second) = (extract_component_features(a), extract_component_features(b));
    let left_out = keep_common(&mut first, &mut second, uncaptured);
    if first.is_empty() {
        let captured = |part: &UncomparedComponent| part.uncaptured == (false, false);
        return Err(if left_out.iter().all(captured) {
            ScoreError::NothingInCommon
        } else {
            ScoreError::NothingCaptured
        });
    }
    let scales: Vec<f64> = first
        .iter()
        .flat_map(|(key, columns)| vec![options.scales.component_scale(key.0); columns.len()])
        .collect();
    let series = |features: &ComponentFeatures| {
        let columns: Vec<&Vec<f64>> = features.values().flatten().collect();
        ChannelSeries::from_columns(&columns)?.scale_channels(&scales)
    };
    let (query, reference) = (series(&first)?, series(&second)?);
    let aligned = dtw::align_series(&query, &reference, &options.dtw)?;
    let pairs = pairs_of(a, b);
    let fingers = |anatomy: &BodyAnatomy, sides: &[BodySide]| -> Vec<usize> {
        let all = sides.iter().flat_map(|&side| anatomy.finger_joints(side));
        all.collect()
    };
    let still = [fingers(a.anatomy, uncaptured.0), fingers(b.anatomy, uncaptured.1)];
    // Fingers that nobody captured must not be the worst.
    let mut seen = pairs.clone();
    seen.retain(|(left, right)| !still[0].contains(left) && !still[1].contains(right));
    let largest = largest_error(a, b, &seen, &aligned.path);
    let name = |clip: &Clip, joint: usize| clip.clip_skeleton().joint_at(joint).name.clone();
    let unpaired = |clip: &Clip, used: &dyn Fn(usize) -> bool| {
        (0..clip.clip_skeleton().len())
            .filter(|&j| !used(j))
            .map(|j| name(clip, j))
            .collect()
    };
    Ok(ClipSimilarityScore {
        distance: aligned.cost.distance,
        normalized: aligned.cost.normalized,
        components: component_parts(&first, &query, &reference, &aligned),
        max_joint_error_m: largest.map(|(error, ..)| error),
        worst: largest.map(|(_, joint, frames)| WorstJoint {
            joint: name(a.clip, joint),
            frames,
        }),
        alignment: aligned.path,
        made: aligned.cost.made,
        left_out,
        only_in_first: unpaired(a.clip, &|j| pairs.iter().any(|pair| pair.0 == j)),
        only_in_second: unpaired(b.clip, &|j| pairs.iter().any(|pair| pair.1 == j)),
    })
}

/// The channels of each component and hand, one value per frame.
type ComponentFeatures = BTreeMap<(SignComponent, BodySide), Vec<Vec<f64>>>;

const MANUAL_COMPONENTS: [SignComponent; 4] = [
    SignComponent::Configuration,
    SignComponent::Placement,
    SignComponent::Movement,
    SignComponent::Orientation,
];

fn extract_component_features(performed: PerformedClip<'_>) -> ComponentFeatures {
    let PerformedClip { clip, anatomy, .. } = performed;
    let mut features = ComponentFeatures::new();
    let mut model = clip.model_pose(0);
    let mut rows: BTreeMap<(SignComponent, BodySide), Vec<Option<Vec<f64>>>> = BTreeMap::new();
    for frame in 0..clip.clip_frame_count() {
        let pose = clip.clip_pose_at(frame);
        model.set_local_pose(clip.clip_skeleton(), &pose);
        let body = anatomy.body_frame(&model);
        for side in BodySide::BOTH_SIDES {
            let angles = anatomy.hand_angles(clip.clip_skeleton(), side, &pose);
            let mut put = |component, row| rows.entry((component, side)).or_default().push(row);
            put(
                SignComponent::Configuration,
                angles.map(|hand: HandAngles| hand.to_array().to_vec()),
            );
            put(
                SignComponent::Placement,
                measure_hand_placement(anatomy, &model, body.as_ref(), side),
            );
            put(
                SignComponent::Orientation,
                orientation(anatomy, &model, body.as_ref(), side),
            );
        }
    }
    for (key, rows) in rows {
        if let Some(columns) = fill_missing_rows(rows) {
            features.insert(key, columns);
        }
    }
    // From places whose gaps are filled, so that no gap is a jump.
    for side in BodySide::BOTH_SIDES {
        if let Some(places) = features.get(&(SignComponent::Placement, side)) {
            let velocities = places
                .iter()
                .map(|column| velocity(column, clip.clip_frame_rate()))
                .collect();
            features.insert((SignComponent::Movement, side), velocities);
        }
    }
    features
}

fn measure_hand_placement(
    anatomy: &BodyAnatomy,
    model: &ModelPose,
    body: Option<&BodyFrame>,
    side: BodySide,
) -> Option<Vec<f64>> {
    let wrist = model.model_joint_position(anatomy.part_joint(BodyPart::Hand(side))?);
    Some(body?.to_body(wrist).to_array().to_vec())
}

fn orientation(anatomy: &BodyAnatomy, model: &ModelPose, body: Option<&BodyFrame>, side: BodySide) -> Option<Vec<f64>> {
    let palm = body?.direction_to_body(anatomy.palm_normal(side, model)?);
    let along = body?.direction_to_body(anatomy.hand_direction(side, model)?);
    Some([palm.to_array(), along.to_array()].concat())
}

/// Converts rows to columns; a missing frame takes the last value before it, else the first one after it.
/// `None` if all frames are missing.
fn fill_missing_rows(rows: Vec<Option<Vec<f64>>>) -> Option<Vec<Vec<f64>>> {
    let mut last = rows.iter().find_map(Clone::clone)?;
    let mut columns = vec![Vec::with_capacity(rows.len()); last.len()];
    for row in rows {
        last = row.unwrap_or(last);
        for (column, value) in columns.iter_mut().zip(&last) {
            column.push(*value);
        }
    }
    Some(columns)
}

/// Returns the rate of change per second, over neighbours on both sides where both exist.
fn velocity(column: &[f64], rate: FrameRate) -> Vec<f64> {
    let reach = (rate.per_second() * VELOCITY_SECONDS).round().max(1.0) as usize;
    (0..column.len())
        .map(|frame| {
            let Range { start, end } = frame.saturating_sub(reach)..(frame + reach).min(column.len() - 1);
            let seconds = (end - start) as f64 * rate.frame_time();
            if end > start {
                (column[end] - column[start]) / seconds
            } else {
                0.0
            }
        })
        .collect()
}

/// Drops the handshapes of uncaptured hands and the components that only one of the clips shows, and returns them.
fn keep_common(
    first: &mut ComponentFeatures,
    second: &mut ComponentFeatures,
    uncaptured: (&[BodySide], &[BodySide]),
) -> Vec<UncomparedComponent> {
    let mut left_out = Vec::new();
    let drop_handshape = |features: &mut ComponentFeatures, sides: &[BodySide], side: BodySide| {
        sides.contains(&side) && features.remove(&(SignComponent::Configuration, side)).is_some()
    };
    for component in MANUAL_COMPONENTS {
        for side in BodySide::BOTH_SIDES {
            let key = (component, side);
            let uncaptured = match component {
                SignComponent::Configuration => (
                    drop_handshape(first, uncaptured.0, side),
                    drop_handshape(second, uncaptured.1, side),
                ),
                _ => (false, false),
            };
            let shown = (first.contains_key(&key), second.contains_key(&key));
            if shown != (true, true) {
                first.remove(&key);
                second.remove(&key);
                left_out.push(UncomparedComponent {
                    component,
                    side,
                    shown,
                    uncaptured,
                });
            }
        }
    }
    left_out
}

fn component_parts(
    features: &ComponentFeatures,
    query: &ChannelSeries,
    reference: &ChannelSeries,
    aligned: &DtwAlignment,
) -> BTreeMap<SignComponent, f64> {
    let mut channels: BTreeMap<SignComponent, Vec<usize>> = BTreeMap::new();
    let mut next = 0;
    for (key, columns) in features {
        channels.entry(key.0).or_default().extend(next..next + columns.len());
        next += columns.len();
    }
    let path = &aligned.path;
    // A step along both clips counts for a frame of each, as in the norm.
    let weight = |n: usize| match n.checked_sub(1).map(|before| path[before]) {
        Some((i, j)) if (i, j) != path[n] && (i == path[n].0 || j == path[n].1) => 1.0,
        _ => 2.0,
    };
    let sum = |channels: &[usize]| -> f64 {
        let apart = |(i, j): (usize, usize)| {
            let difference = |c: &usize| query.channel_values(*c)[i] - reference.channel_values(*c)[j];
            let squares = channels.iter().map(|c| difference(c).powi(2));
            squares.sum::<f64>().sqrt()
        };
        let pairs = path.iter().enumerate();
        pairs.map(|(n, pair)| weight(n) * apart(*pair)).sum()
    };
    let all: Vec<usize> = (0..next).collect();
    let total_cost = sum(&all);
    let weights: f64 = (0..path.len()).map(weight).sum();
    let per_unit = match aligned.cost.normalized {
        Some(normalized) if total_cost > 0.0 => normalized / total_cost,
        _ => 1.0 / weights.max(1.0),
    };
    channels
        .iter()
        .map(|(component, channels)| (*component, sum(channels) * per_unit))
        .collect()
}

/// Returns the corresponding joints of both clips: all of them if the skeletons have the same joints, else
/// those of the same part of the body, else of the same name.
fn pairs_of(a: PerformedClip<'_>, b: PerformedClip<'_>) -> Vec<(usize, usize)> {
    let (first, second) = (
        a.clip.clip_skeleton().skeleton_joints(),
        b.clip.clip_skeleton().skeleton_joints(),
    );
    let same = first.len() == second.len()
        && first
            .iter()
            .zip(second)
            .all(|(x, y)| x.name == y.name && x.parent == y.parent);
    if same {
        return (0..first.len()).map(|j| (j, j)).collect();
    }
    // Of equal names the first joint remains, because it is written last.
    let names: BTreeMap<&str, usize> = second
        .iter()
        .enumerate()
        .rev()
        .map(|(j, joint)| (joint.name.as_str(), j))
        .collect();
    let counterpart = |j: usize| match a.anatomy.part_of(j) {
        Some(part) => b.anatomy.part_joint(part),
        None => {
            // A part of the body is no counterpart of a joint that is none.
            let other = names.get(first[j].name.as_str()).copied();
            other.filter(|&other| b.anatomy.part_of(other).is_none())
        }
    };
    (0..first.len()).filter_map(|j| Some((j, counterpart(j)?))).collect()
}

/// Returns the largest distance of paired joints or tips, with the first clip's joint and frames. Tips of fingers that
/// point elsewhere than their fingers are turned first; a pair with a tip without a length is left out.
fn largest_error(
    a: PerformedClip<'_>,
    b: PerformedClip<'_>,
    pairs: &[(usize, usize)],
    path: &[(usize, usize)],
) -> Option<(f64, usize, (usize, usize))> {
    let frame_by_frame: Vec<(usize, usize)>;
    let path = if a.clip.clip_frame_count() == b.clip.clip_frame_count() {
        frame_by_frame = (0..a.clip.clip_frame_count()).map(|i| (i, i)).collect();
        &frame_by_frame
    } else {
        path
    };
    let ended = pairs.iter().map(|&(left, right)| {
        let tips = (
            a.anatomy.joint_tip(a.clip.clip_skeleton(), left),
            b.anatomy.joint_tip(b.clip.clip_skeleton(), right),
        );
        ((left, right), tips)
    });
    let ended: Vec<_> = ended.collect();
    let (mut first, mut second) = (PostureWalker::new(a.clip), PostureWalker::new(b.clip));
    let mut largest: Option<(f64, usize, (usize, usize))> = None;
    for &(i, j) in path {
        let (x, y) = (first.pose_at_frame(i), second.pose_at_frame(j));
        for &((left, right), tips) in &ended {
            let mut error = x.model_joint_position(left).distance(y.model_joint_position(right));
            if let (Some(tip), Some(other)) = tips {
                error = error.max(
                    x.joint_point_to_model(left, tip)
                        .distance(y.joint_point_to_model(right, other)),
                );
            }
            if largest.is_none_or(|(most, ..)| error > most) {
                largest = Some((error, left, (i, j)));
            }
        }
    }
    largest
}

/// The posture of a clip in model space, cached by frame.
struct PostureWalker<'a> {
    clip: &'a Clip,
    frame: usize,
    model: ModelPose,
}

impl<'a> PostureWalker<'a> {
    fn new(clip: &'a Clip) -> Self {
        Self {
            clip,
            frame: 0,
            model: clip.model_pose(0),
        }
    }

    fn pose_at_frame(&mut self, frame: usize) -> &ModelPose {
        if self.frame != frame {
            self.model
                .set_local_pose(self.clip.clip_skeleton(), &self.clip.clip_pose_at(frame));
            self.frame = frame;
        }
        &self.model
    }
}
