//! The skeleton of a glTF document and its movement.

use std::sync::Arc;

use chereme_motion::{
    Clip, CurveTrack, FrameNumberColumn, FrameRate, FrameTimes, JointChannel, ScalarCurve, Skeleton, SpaceConvention,
};

use super::accessor::GltfData;
use super::avatar_face::gaze_from_eye_rotation;
use super::container::{load_gltf_buffers, split_glb_chunks};
use super::error::GltfError;
use super::gltf_model::{FaceNode, GltfAnimation, GltfDocument};
use super::rig::{GltfRig, SAME_SCALE};
use super::sample::SamplerKeys;
use crate::finding::ImportFinding;
use crate::scene::{BodyScene, near_usual, settle_joint_offsets};
use crate::tally::FindingTally;
use crate::tracks::{rate_of, unique_track_names};

/// Frames a second of a skeleton without movement.
const STILL_RATE: u32 = 30;
/// Largest distance of a key from an even grid, as a share of a frame, at which the animation still has a rate.
const NEAR_FRAME: f64 = 0.05;
const MAX_GLTF_FRAMES: usize = 5_000_000;
/// The most joints times frames of any file; each byte of its buffers allows one more.
const MOST_POSITIONS: usize = 8_000_000;

/// Reads a GLB or `.gltf`; `beside` returns the bytes of a file in the same folder, by its name.
///
/// # Errors
/// [`GltfError`] if the bytes are not glTF, an element refers to one that does not exist, the movement is
/// compressed, or the file has no skeleton.
pub fn read_gltf(
    bytes: &[u8],
    beside: &dyn Fn(&str) -> Option<Vec<u8>>,
) -> Result<(BodyScene, Vec<ImportFinding>), GltfError> {
    let (json, binary) = split_glb_chunks(bytes)?;
    let document: GltfDocument = serde_json::from_slice(json).map_err(|error| match binary {
        None if !json.trim_ascii_start().starts_with(b"{") => GltfError::NoGltf,
        _ => GltfError::Json(error.to_string()),
    })?;
    if !document.asset.version.starts_with("2.") {
        return Err(GltfError::NoGltf);
    }
    let data = GltfData::new(&document, load_gltf_buffers(&document, binary, beside)?);
    let mut findings = FindingTally::default();
    for extension in &document.extensions_required {
        if extension == "EXT_meshopt_compression" {
            return Err(GltfError::Packed(extension.clone()));
        }
        findings.push_note_finding(
            None,
            format!("it needs the extension {extension}; movement is read without it"),
        );
    }
    let rig = GltfRig::rig_from_document(&document, &mut findings)?;
    let scene = build_gltf_scene(&data, rig, &mut findings)?;
    Ok((scene, findings.finish_finding_tally()))
}

/// The samplers of one joint.
#[derive(Default)]
struct MovedJointSamplers {
    rotation: Option<SamplerKeys>,
    translation: Option<SamplerKeys>,
}

fn build_gltf_scene(data: &GltfData<'_>, rig: GltfRig, findings: &mut FindingTally) -> Result<BodyScene, GltfError> {
    let document = data.document;
    // VRM 0 looks along -Z, against glTF and VRM 1.
    let vrm0 = document.extensions.get("VRM").is_some();
    let axes = if vrm0 { "+Y,-X" } else { "+Y,+X" };
    let convention = SpaceConvention {
        metres_per_unit: 1.0,
        axes: axes.parse().unwrap_or(SpaceConvention::MODEL_CONVENTION.axes),
    };
    let skeleton = Skeleton::new(rig.joints.clone()).map_err(|error| GltfError::Skeleton(error.to_string()))?;
    let skeleton = Arc::new(skeleton);
    let still = FrameRate::new(STILL_RATE, 1).map_err(|error| GltfError::Skeleton(error.to_string()))?;
    let Some(animation) = document.animations.first() else {
        findings.push_warning_finding(None, "it has no animation; one frame at rest was made");
        return Ok(BodyScene {
            clip: Clip::from_rest_pose(skeleton, still, 1),
            convention,
            morphs: None,
            take: None,
            clock: None,
        });
    };
    if document.animations.len() > 1 {
        let animation_names = document.animations[1..]
            .iter()
            .map(|animation| animation.name.as_deref().unwrap_or("unnamed"));
        let names: Vec<&str> = animation_names.collect();
        findings.push_counted_finding(
            ImportFinding::new_warning_finding(
                None,
                format!("only its first animation was read; left out: {}", names.join(", ")),
            )
            .with_remedy("export each animation to a file of its own"),
        );
    }
    let (moved, weights) = samplers(data, animation, &rig, findings)?;
    let grid = GltfFrameGrid::frame_grid_from_keys(
        moved
            .iter()
            .flat_map(|motion| [&motion.rotation, &motion.translation])
            .flatten()
            .chain(weights.iter().map(|weight| &weight.keys)),
        findings,
    );
    // A few keys far apart in time can make any number of frames; long files may have more of them.
    let most = MOST_POSITIONS.saturating_add(data.count_buffer_bytes());
    let wide = weights.iter().map(|weight| weight.keys.width).sum::<usize>();
    let fits = |grid: &GltfFrameGrid| grid.frames.saturating_mul(rig.joints.len() + wide) <= most;
    let Some(grid) = grid.filter(fits) else {
        findings.push_warning_finding(
            None,
            "its key times make more frames than can be held; one frame at rest was made",
        );
        return Ok(BodyScene {
            clip: Clip::from_rest_pose(skeleton, still, 1),
            convention,
            morphs: None,
            take: animation.name.clone(),
            clock: None,
        });
    };
    let joint_moves = rig.joints.iter().zip(&moved).zip(&rig.scales);
    let channels = joint_moves.map(|((joint, moved), scale)| JointChannel {
        rotations: match &moved.rotation {
            Some(keys) => grid.gltf_frame_times().map(|time| keys.turn_at(time)).collect(),
            None => vec![joint.rest; grid.frames],
        },
        translations: moved.translation.as_ref().map(|keys| {
            grid.gltf_frame_times()
                // Skeletons have no scale, so that the scale of nodes above goes into the places.
                .map(|time| keys.place_at(time) * *scale)
                .collect()
        }),
    });
    let mut channels: Vec<JointChannel> = channels.collect();
    let mut joints = rig.joints;
    let wrong = settle_joint_offsets(&mut joints, &mut channels);
    if wrong > 0 {
        findings.push_note_finding(
            None,
            format!("joints whose rest position contradicts the movement, which is used: {wrong}"),
        );
    }
    let fault = |error: chereme_motion::SkeletonError| GltfError::Skeleton(error.to_string());
    let skeleton = Arc::new(Skeleton::new(joints).map_err(fault)?);
    let clip = Clip::new(skeleton, grid.rate, channels).map_err(|error| GltfError::Skeleton(error.to_string()))?;
    let morphs = gltf_morph_curves(document, &weights, &grid);
    Ok(BodyScene {
        clip,
        convention,
        morphs,
        take: animation.name.clone(),
        clock: None,
    })
}

/// Weights of the morph targets of a node, or the movement of a node that stands for a part of a face.
struct MorphTargetWeights {
    node: usize,
    keys: SamplerKeys,
}

fn samplers(
    data: &GltfData<'_>,
    animation: &GltfAnimation,
    rig: &GltfRig,
    findings: &mut FindingTally,
) -> Result<(Vec<MovedJointSamplers>, Vec<MorphTargetWeights>), GltfError> {
    let mut moved: Vec<MovedJointSamplers> = rig.joints.iter().map(|_| MovedJointSamplers::default()).collect();
    let mut weights = Vec::new();
    let face = data.document.face_nodes();
    for (at, channel) in animation.channels.iter().enumerate() {
        // An extension may animate a target that is not a node.
        let Some(node) = channel.target.node else {
            continue;
        };
        let joint = rig.nodes.iter().position(|known| *known == Some(node));
        if joint.is_none() && face.contains_key(&node) {
            let width = match (&face[&node], channel.target.path.as_str()) {
                (FaceNode::Expression(_), "translation") => 3,
                (FaceNode::Gaze, "rotation") => 4,
                _ => continue,
            };
            let keys = read_sampler_keys(data, animation, channel.sampler, width)?;
            weights.push(MorphTargetWeights { node, keys });
            continue;
        }
        let width = match channel.target.path.as_str() {
            "rotation" => 4,
            "translation" => 3,
            "weights" => count_morph_targets(data.document, node),
            "scale" => {
                let keys = read_sampler_keys(data, animation, channel.sampler, 3)?;
                if keys
                    .values
                    .chunks(3)
                    .any(|scale| scale.iter().any(|scale| (f64::from(*scale) - 1.0).abs() > SAME_SCALE))
                {
                    findings.add_limited_warning("animated scales", None, || {
                        format!("channel {at} changes the scale of a node; that is not shown")
                    });
                }
                continue;
            }
            other => {
                findings.add_limited_note("unknown channels", None, || {
                    format!("channel {at} changes {other:?}; it was left out")
                });
                continue;
            }
        };
        if width == 0 {
            continue;
        }
        let keys = read_sampler_keys(data, animation, channel.sampler, width)?;
        match (channel.target.path.as_str(), joint) {
            ("rotation", Some(joint)) => moved[joint].rotation = Some(keys),
            ("translation", Some(joint)) => moved[joint].translation = Some(keys),
            ("weights", _) => weights.push(MorphTargetWeights { node, keys }),
            _ => {}
        }
    }
    Ok((moved, weights))
}

fn read_sampler_keys(
    data: &GltfData<'_>,
    animation: &GltfAnimation,
    sampler: usize,
    width: usize,
) -> Result<SamplerKeys, GltfError> {
    let fault = |problem: &str| GltfError::gltf_element_error("samplers", sampler, problem);
    let animation_sampler = animation.samplers.get(sampler).ok_or_else(|| fault("does not exist"))?;
    if let Some(extension) = animation_sampler
        .extensions
        .as_object()
        .and_then(|all| all.keys().next())
    {
        return Err(GltfError::Packed(extension.clone()));
    }
    // Weights of three or four targets differ from vectors by the shape of their accessor.
    let is_weights = !matches!(width, 3 | 4)
        || data
            .document
            .accessors
            .get(animation_sampler.output)
            .is_some_and(|accessor| accessor.shape == "SCALAR");
    let keys = SamplerKeys {
        times: data.read_accessor_floats(animation_sampler.input, 1)?,
        values: data.read_accessor_floats(animation_sampler.output, if is_weights { 1 } else { width })?,
        interpolation: animation_sampler.interpolation,
        width,
    };
    if !keys.are_sound() {
        return Err(fault(
            "has times that do not rise, or another number of values than times",
        ));
    }
    Ok(keys)
}

/// Returns the number of morph targets of a node's mesh.
fn count_morph_targets(document: &GltfDocument, node: usize) -> usize {
    let mesh = document
        .nodes
        .get(node)
        .and_then(|node| document.meshes.get(node.mesh?));
    mesh.and_then(|mesh| mesh.primitives.first())
        .map_or(0, |primitive| primitive.targets.len())
}

/// The frames at which samplers are read.
struct GltfFrameGrid {
    rate: FrameRate,
    first: f64,
    frames: usize,
}

impl GltfFrameGrid {
    /// Returns frames at the rate of the keys; keys between frames are reported.
    fn frame_grid_from_keys<'k>(
        keys: impl Iterator<Item = &'k SamplerKeys>,
        findings: &mut FindingTally,
    ) -> Option<Self> {
        // The joints of most files share one list of times.
        let mut lists: Vec<&[f32]> = Vec::new();
        for keys in keys {
            if lists.last() != Some(&keys.times.as_slice()) {
                lists.push(&keys.times);
            }
        }
        let mut times: Vec<f64> = lists.concat().into_iter().map(f64::from).collect();
        times.sort_by(f64::total_cmp);
        times.dedup_by(|a, b| (*a - *b).abs() < 1e-6);
        let (first, last) = (*times.first()?, *times.last()?);
        let mut steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        steps.sort_by(f64::total_cmp);
        let Some(step) = steps.get(steps.len() / 2) else {
            let rate = FrameRate::new(STILL_RATE, 1).ok()?;
            return Some(Self { rate, first, frames: 1 });
        };
        let guess = rate_of(near_usual(1.0 / step)).or_else(|| FrameRate::new(STILL_RATE, 1).ok())?;
        let frames = (((last - first) * guess.per_second()).round() as usize).saturating_add(1);
        if frames > MAX_GLTF_FRAMES {
            return None;
        }
        let off = times.iter().filter(|time| {
            let frame_position = (**time - first) * guess.per_second();
            (frame_position - frame_position.round()).abs() > NEAR_FRAME
        });
        let off = off.count();
        if off > 0 {
            findings.push_note_finding(
                None,
                format!(
                    "{off} of its {} key times lie between frames of {guess:?}; movement is read at that rate",
                    times.len()
                ),
            );
        }
        if first.abs() > 1e-6 {
            findings.push_note_finding(None, format!("its movement begins at {first:.3} s; that is 0 s here"));
        }
        Some(Self {
            rate: guess,
            first,
            frames,
        })
    }

    fn gltf_frame_times(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.frames).map(|frame| self.first + frame as f64 * self.rate.frame_time())
    }
}

fn gltf_morph_curves(
    document: &GltfDocument,
    weights: &[MorphTargetWeights],
    grid: &GltfFrameGrid,
) -> Option<CurveTrack> {
    let mut curves = Vec::new();
    let face = document.face_nodes();
    for moved in weights {
        match face.get(&moved.node) {
            Some(FaceNode::Expression(name)) => {
                // VRM animations move a node along x instead of a weight.
                let weight = |time| moved.keys.place_at(time).x as f32;
                let values = grid.gltf_frame_times().map(weight).collect();
                curves.push(ScalarCurve::new(
                    name.clone(),
                    FrameNumberColumn::from_single_floats(values),
                ));
                continue;
            }
            Some(FaceNode::Gaze) => {
                for (name, axis) in [("gaze_left_degrees", 0), ("gaze_up_degrees", 1)] {
                    let degrees = |time| gaze_from_eye_rotation(moved.keys.turn_at(time))[axis] as f32;
                    let values = grid.gltf_frame_times().map(degrees).collect();
                    curves.push(ScalarCurve::new(name, FrameNumberColumn::from_single_floats(values)));
                }
                continue;
            }
            None => {}
        }
        let mesh = document
            .nodes
            .get(moved.node)
            .and_then(|node| document.meshes.get(node.mesh?));
        let names = mesh
            .and_then(|mesh| mesh.extras.get("targetNames")?.as_array().cloned())
            .unwrap_or_default();
        let mesh = mesh
            .and_then(|mesh| mesh.name.clone())
            .unwrap_or_else(|| "mesh".to_owned());
        let mut columns = vec![Vec::with_capacity(grid.frames); moved.keys.width];
        let mut row = vec![0.0; moved.keys.width];
        for time in grid.gltf_frame_times() {
            moved.keys.write_values_at(time, &mut row);
            for (column, value) in columns.iter_mut().zip(&row) {
                column.push(*value as f32);
            }
        }
        for (target, values) in columns.into_iter().enumerate() {
            let given = names.get(target).and_then(|name| name.as_str());
            let name = given.map_or_else(|| format!("{mesh} {target}"), str::to_owned);
            curves.push(ScalarCurve::new(name, FrameNumberColumn::from_single_floats(values)));
        }
    }
    let names: Vec<String> = curves.iter().map(|curve: &ScalarCurve| curve.name.clone()).collect();
    for (curve, name) in curves
        .iter_mut()
        .zip(unique_track_names(names.iter().map(String::as_str), "target"))
    {
        curve.name = name;
    }
    CurveTrack::new(FrameTimes::Even(grid.rate), curves).ok()
}
