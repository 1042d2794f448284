//! A scene's skeleton, movement and blend shapes.

use std::sync::Arc;

use chereme_motion::{
    AxisDirection, Clip, CurveTrack, FrameNumberColumn, FrameRate, FrameTimes, JointChannel, RecordingInstant,
    ScalarCurve, SignerAxes, Skeleton, SpaceAxis, SpaceConvention,
};
use ufbx::{AllocatorOpts, AnimStack, CoordinateAxis, ErrorType, LoadOpts};

use super::joints::{AnimatedNodes, FbxRig};
use crate::finding::ImportFinding;
use crate::scene::{BodyScene, near_usual, settle_joint_offsets};
use crate::tally::FindingTally;
use crate::timecode;
use crate::tracks::{rate_of, unique_track_names};

/// A reason why a file could not be read as FBX.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FbxError {
    /// The bytes are no FBX.
    #[error("this is no FBX file")]
    NoFbx,
    /// The file is of a version or kind that is not supported.
    #[error(
        "FBX of this version is not supported; open it in Blender or MotionBuilder and save it as FBX 2013 or later"
    )]
    Version,
    /// The file is damaged, or larger after decompression than the limit.
    #[error("the file is damaged: {0}")]
    Damaged(String),
    /// There is no skeleton.
    #[error("the file holds no skeleton: no bone and no animated node")]
    NoSkeleton,
    /// The take is longer than can be held.
    #[error("its take lasts {seconds:.0} s with {joints} joints; at most {most} positions can be held")]
    TooLong {
        /// The length of the take.
        seconds: f64,
        /// The number of joints.
        joints: usize,
        /// The largest number of joints times frames.
        most: usize,
    },
    /// The joints are not a tree, or their numbers are not positions and rotations.
    #[error("{0}")]
    Skeleton(String),
}

/// Memory for a scene: a fixed number of bytes, and a multiple of the file's size.
const SCENE_MEMORY_BYTES: (usize, usize) = (64 << 20, 96);
/// The most memory for a scene, in bytes.
const MOST_MEMORY: usize = 4 << 30;
/// The greatest depth of a tree of nodes.
const MAX_NODE_DEPTH: u32 = 512;
/// The most nodes of a scene.
const MOST_NODES: usize = 20_000;
/// The most joints times frames.
const MOST_POSITIONS: usize = 60_000_000;
/// The start of a take, in seconds, beyond which its times are timecodes.
const MIN_TIMECODE_SECONDS: f64 = 60.0;
/// Frames per second of a file that states no rate.
const DEFAULT_FBX_FPS: f64 = 30.0;
/// The most keys that are examined for their rate.
const MOST_KEYS: usize = 4_000_000;

/// Reads an FBX file, binary or ASCII.
///
/// # Errors
/// [`FbxError`] if the bytes are no FBX of a supported version, are damaged, or hold no skeleton.
pub fn read_fbx(bytes: &[u8]) -> Result<(BodyScene, Vec<ImportFinding>), FbxError> {
    let limit = |share: usize| AllocatorOpts {
        memory_limit: SCENE_MEMORY_BYTES
            .0
            .saturating_add(bytes.len().saturating_mul(SCENE_MEMORY_BYTES.1))
            .min(MOST_MEMORY)
            / share,
        ..AllocatorOpts::default()
    };
    let options = LoadOpts {
        temp_allocator: limit(1),
        result_allocator: limit(1),
        ignore_geometry: true,
        ignore_embedded: true,
        load_external_files: false,
        node_depth_limit: MAX_NODE_DEPTH,
        ..LoadOpts::default()
    };
    if !is_fbx(bytes) {
        return Err(FbxError::NoFbx);
    }
    let scene = ufbx::load_memory(bytes, options).map_err(|error| match error.type_ {
        ErrorType::UnrecognizedFileFormat | ErrorType::EmptyFile => FbxError::NoFbx,
        ErrorType::UnsupportedVersion => FbxError::Version,
        _ => FbxError::Damaged(error.description.to_string()),
    })?;
    if scene.nodes.len() > MOST_NODES {
        let nodes = scene.nodes.len();
        return Err(FbxError::Skeleton(format!("{nodes} nodes are too many")));
    }
    let mut findings = FindingTally::default();
    for warning in scene.metadata.warnings.iter() {
        findings.add_limited_note("warnings of the parser", None, || warning.description.to_string());
    }
    let convention = fbx_convention(&scene, &mut findings);
    let stack = choose_fbx_take(&scene, &mut findings);
    let animated = stack.map(AnimatedNodes::nodes_of_stack).unwrap_or_default();
    let rig = FbxRig::rig_from_scene(&scene, &animated, &mut findings);
    if rig.joints.is_empty() {
        return Err(FbxError::NoSkeleton);
    }
    let read = match stack {
        Some(stack) => read_moving_scene(&scene, stack, rig, convention, &mut findings)?,
        None => read_still_scene(rig, convention, &mut findings)?,
    };
    Ok((read, findings.finish_finding_tally()))
}

/// Returns whether bytes begin as binary FBX, or have the word `FBX` near their beginning, as ASCII FBX does.
fn is_fbx(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(4096)];
    let has = |word: &[u8]| head.windows(word.len()).any(|window| window == word);
    head.starts_with(b"Kaydara FBX Binary") || has(b"FBX")
}

fn fbx_convention(scene: &ufbx::Scene, findings: &mut FindingTally) -> SpaceConvention {
    let settings = &scene.settings;
    let metres = settings.unit_meters;
    let metres_per_unit = if metres.is_finite() && metres > 0.0 {
        metres
    } else {
        findings.push_warning_finding(None, "it states no unit; centimetres are taken");
        0.01
    };
    let [right, up, front] = [settings.axes.right, settings.axes.up, settings.axes.front].map(direction_of_axis);
    let axes = up.zip(right).and_then(|(up, right)| SignerAxes::new(up, right));
    let handed = axes.zip(front).is_none_or(|(_, front)| {
        let (right, up) = (
            right.map(AxisDirection::axis_direction_vector),
            up.map(AxisDirection::axis_direction_vector),
        );
        right
            .zip(up)
            .is_none_or(|(right, up)| right.cross(up).dot(front.axis_direction_vector()) > 0.0)
    });
    if !handed {
        findings.push_warning_finding(None, "its axes are left-handed: left and right may be exchanged");
    }
    SpaceConvention {
        metres_per_unit,
        axes: axes.unwrap_or_else(|| {
            findings.push_warning_finding(None, "it states no axes; Y is taken for up");
            SpaceConvention::MODEL_CONVENTION.axes
        }),
    }
}

fn direction_of_axis(axis: CoordinateAxis) -> Option<AxisDirection> {
    let (axis, negative) = match axis {
        CoordinateAxis::PositiveX => (SpaceAxis::X, false),
        CoordinateAxis::NegativeX => (SpaceAxis::X, true),
        CoordinateAxis::PositiveY => (SpaceAxis::Y, false),
        CoordinateAxis::NegativeY => (SpaceAxis::Y, true),
        CoordinateAxis::PositiveZ => (SpaceAxis::Z, false),
        CoordinateAxis::NegativeZ => (SpaceAxis::Z, true),
        CoordinateAxis::Unknown => return None,
    };
    Some(AxisDirection { axis, negative })
}

/// Returns the first take that moves a node, else the first one; a finding names the others that move.
fn choose_fbx_take<'s>(scene: &'s ufbx::Scene, findings: &mut FindingTally) -> Option<&'s AnimStack> {
    let stacks: Vec<&AnimStack> = scene.anim_stacks.into_iter().collect();
    let moving: Vec<&AnimStack> = stacks
        .iter()
        .copied()
        .filter(|stack| !AnimatedNodes::nodes_of_stack(stack).nodes.is_empty())
        .collect();
    if moving.len() > 1 {
        let names: Vec<&str> = moving[1..]
            .iter()
            .map(|moving_stack| &*moving_stack.element.name)
            .collect();
        findings.push_counted_finding(
            ImportFinding::new_warning_finding(
                None,
                format!("only its first take was read; left out: {}", names.join(", ")),
            )
            .with_remedy("export each take to a file of its own"),
        );
    }
    moving.first().or(stacks.first()).copied()
}

fn read_still_scene(
    rig: FbxRig<'_>,
    convention: SpaceConvention,
    findings: &mut FindingTally,
) -> Result<BodyScene, FbxError> {
    findings.push_warning_finding(None, "it has no animation; one frame at rest was made");
    let skeleton = Skeleton::new(rig.joints).map_err(|error| FbxError::Skeleton(error.to_string()))?;
    let rate = rate_of(DEFAULT_FBX_FPS).ok_or(FbxError::NoSkeleton)?;
    Ok(BodyScene {
        clip: Clip::from_rest_pose(Arc::new(skeleton), rate, 1),
        convention,
        morphs: None,
        take: None,
        clock: None,
    })
}

/// The times of frames.
struct FbxFrameGrid {
    rate: FrameRate,
    first: f64,
    frames: usize,
}

impl FbxFrameGrid {
    fn fbx_frame_times(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.frames).map(|frame| self.first + frame as f64 * self.rate.frame_time())
    }
}

fn read_moving_scene(
    scene: &ufbx::Scene,
    stack: &AnimStack,
    mut rig: FbxRig<'_>,
    convention: SpaceConvention,
    findings: &mut FindingTally,
) -> Result<BodyScene, FbxError> {
    let grid = fbx_frame_grid(scene, stack, rig.joints.len(), findings)?;
    let mut channels: Vec<JointChannel> = rig
        .moves
        .iter()
        .map(|moves| JointChannel {
            rotations: Vec::with_capacity(grid.frames),
            translations: moves.then(|| Vec::with_capacity(grid.frames)),
        })
        .collect();
    for time in grid.fbx_frame_times() {
        for (channel, local) in channels.iter_mut().zip(rig.joint_transforms_at(&stack.anim, time)) {
            let turn = match channel.rotations.last() {
                Some(before) if before.dot(local.turn) < 0.0 => -local.turn,
                _ => local.turn,
            };
            channel.rotations.push(turn);
            if let Some(places) = &mut channel.translations {
                places.push(local.place);
            }
        }
    }
    let mut joints = std::mem::take(&mut rig.joints);
    let wrong = settle_joint_offsets(&mut joints, &mut channels);
    if wrong > 0 {
        findings.push_note_finding(
            None,
            format!("joints whose rest position contradicts the movement, which is used: {wrong}"),
        );
    }
    let fault = |error: String| FbxError::Skeleton(error);
    let skeleton = Skeleton::new(joints).map_err(|error| fault(error.to_string()))?;
    let clip = Clip::new(Arc::new(skeleton), grid.rate, channels).map_err(|error| fault(error.to_string()))?;
    Ok(BodyScene {
        clip,
        convention,
        morphs: fbx_morph_curves(scene, stack, &grid),
        take: Some(stack.element.name.to_string()),
        clock: (grid.first >= MIN_TIMECODE_SECONDS && grid.first < 2.0 * timecode::SECONDS_PER_DAY)
            .then(|| RecordingInstant::from_seconds(grid.first)),
    })
}

/// Returns the times of a take's frames: its range at the rate of its keys if they are dense, else at the file's rate.
fn fbx_frame_grid(
    scene: &ufbx::Scene,
    stack: &AnimStack,
    joints: usize,
    findings: &mut FindingTally,
) -> Result<FbxFrameGrid, FbxError> {
    let scene_rate = scene.settings.frames_per_second;
    let stated = if scene_rate.is_finite() && scene_rate > 0.0 {
        near_usual(scene_rate)
    } else {
        DEFAULT_FBX_FPS
    };
    let keys = FbxKeySummary::summarize_scene_keys(scene);
    let per_second = keys.rate.map_or(stated, near_usual);
    let rate = rate_of(per_second)
        .or_else(|| rate_of(stated))
        .or_else(|| rate_of(DEFAULT_FBX_FPS))
        .ok_or(FbxError::NoSkeleton)?;
    if (rate.per_second() / stated - 1.0).abs() > 0.01 {
        findings.push_note_finding(
            None,
            format!(
                "its keys come {:.3} times a second, though it states {stated:.3}; the keys count",
                rate.per_second()
            ),
        );
    }
    let fits = |(first, last): &(f64, f64)| {
        let frames = (last - first) * rate.per_second();
        first.is_finite() && (0.0..=MOST_POSITIONS as f64 / joints.max(1) as f64).contains(&frames)
    };
    let stated = (stack.time_begin, stack.time_end);
    let (first, last) = [Some(stated), keys.range]
        .into_iter()
        .flatten()
        .find(fits)
        .ok_or(FbxError::TooLong {
            seconds: stated.1 - stated.0,
            joints,
            most: MOST_POSITIONS,
        })?;
    if (first, last) != stated {
        findings.push_warning_finding(None, "the range of its take is no time; that of its keys is taken");
    }
    if first.abs() > 1e-6 {
        findings.push_note_finding(None, format!("its take begins at {first:.3} s; that is 0 s here"));
    }
    let frames = ((last - first) * rate.per_second() + 1e-6).floor() as usize + 1;
    Ok(FbxFrameGrid { rate, first, frames })
}

/// The rate and range of the keys of all curves.
#[derive(Default)]
struct FbxKeySummary {
    /// Keys per second of the curve with the most keys, if a curve has keys in most of its frames.
    rate: Option<f64>,
    /// The times of the first and last key.
    range: Option<(f64, f64)>,
}

impl FbxKeySummary {
    fn summarize_scene_keys(scene: &ufbx::Scene) -> Self {
        let mut keys = Self::default();
        let mut most = 2;
        for curve in &scene.anim_curves {
            let times = &curve.keyframes;
            let (Some(first), Some(last)) = (times.first(), times.last()) else {
                continue;
            };
            let (low, high) = keys.range.unwrap_or((first.time, last.time));
            keys.range = Some((low.min(first.time), high.max(last.time)));
            if times.len() <= most || times.len() > MOST_KEYS {
                continue;
            }
            most = times.len();
            let mut steps: Vec<f64> = times.windows(2).map(|pair| pair[1].time - pair[0].time).collect();
            steps.sort_by(f64::total_cmp);
            let step = steps[steps.len() / 2];
            let dense = (last.time - first.time) / step < 2.0 * times.len() as f64;
            keys.rate = (step > 1e-6 && dense).then(|| 1.0 / step);
        }
        keys
    }
}

/// Returns the weights of the blend shapes that the take moves.
fn fbx_morph_curves(scene: &ufbx::Scene, stack: &AnimStack, grid: &FbxFrameGrid) -> Option<CurveTrack> {
    let moved: std::collections::BTreeSet<u32> = stack
        .layers
        .into_iter()
        .flat_map(|layer| layer.anim_props.iter())
        .map(|prop| prop.element.element_id)
        .collect();
    let all_channels = scene.blend_channels.into_iter();
    let channels: Vec<&ufbx::BlendChannel> = all_channels
        .filter(|channel| moved.contains(&channel.element.element_id))
        .collect();
    if channels.len().saturating_mul(grid.frames) > MOST_POSITIONS {
        return None;
    }
    let names = channels.iter().map(|channel| &*channel.element.name);
    let curve = |(channel, name): (&&ufbx::BlendChannel, String)| {
        let weight = |time| ufbx::evaluate_blend_weight(&stack.anim, channel, time);
        ScalarCurve::new(
            name,
            FrameNumberColumn::from_double_floats(grid.fbx_frame_times().map(weight).collect()),
        )
    };
    let curves = channels.iter().zip(unique_track_names(names, "target")).map(curve);
    CurveTrack::new(FrameTimes::Even(grid.rate), curves.collect()).ok()
}
