//! The skeleton of a glTF document and its movement.

use std::sync::Arc;

use chereme_motion::{Channel, Clip, Column, Convention, Curve, Curves, Rate, Skeleton, Times};

use super::accessor::Data;
use super::avatar_face::gaze;
use super::container::{buffers, chunks};
use super::error::Error;
use super::model::{Animation, Document, FaceNode};
use super::rig::{Rig, SAME_SCALE};
use super::sample::Keys;
use crate::finding::Finding;
use crate::scene::{Scene, near_usual, settle};
use crate::tally::Findings;
use crate::tracks::{rate_of, unique};

/// Frames a second of a skeleton without movement.
const STILL_RATE: u32 = 30;
/// Largest distance of a key from an even grid, as a share of a frame, at which the animation still has a rate.
const NEAR_FRAME: f64 = 0.05;
const MOST_FRAMES: usize = 5_000_000;
/// The most joints times frames of any file; each byte of its buffers allows one more.
const MOST_POSITIONS: usize = 8_000_000;

/// Reads a GLB or `.gltf`; `beside` returns the bytes of a file in the same folder, by its name.
///
/// # Errors
/// [`Error`] if the bytes are not glTF, an element refers to one that does not exist, the movement is
/// compressed, or the file has no skeleton.
pub fn read(
    bytes: &[u8],
    beside: &dyn Fn(&str) -> Option<Vec<u8>>,
) -> Result<(Scene, Vec<Finding>), Error> {
    let (json, binary) = chunks(bytes)?;
    let document: Document = serde_json::from_slice(json).map_err(|error| match binary {
        None if !json.trim_ascii_start().starts_with(b"{") => Error::NoGltf,
        _ => Error::Json(error.to_string()),
    })?;
    if !document.asset.version.starts_with("2.") {
        return Err(Error::NoGltf);
    }
    let data = Data::new(&document, buffers(&document, binary, beside)?);
    let mut findings = Findings::default();
    for extension in &document.extensions_required {
        if extension == "EXT_meshopt_compression" {
            return Err(Error::Packed(extension.clone()));
        }
        findings.push(Finding::note(
            None,
            format!("it needs the extension {extension}; movement is read without it"),
        ));
    }
    let rig = Rig::of(&document, &mut findings)?;
    let scene = scene(&data, rig, &mut findings)?;
    Ok((scene, findings.finish()))
}

/// The samplers of one joint.
#[derive(Default)]
struct Moved {
    rotation: Option<Keys>,
    translation: Option<Keys>,
}

fn scene(data: &Data<'_>, rig: Rig, findings: &mut Findings) -> Result<Scene, Error> {
    let document = data.document;
    let vrm0 = document.extensions.get("VRM").is_some();
    let axes = if vrm0 { "+Y,-X" } else { "+Y,+X" };
    let convention = Convention {
        metres_per_unit: 1.0,
        axes: axes.parse().unwrap_or(Convention::MODEL.axes),
    };
    let skeleton =
        Skeleton::new(rig.joints.clone()).map_err(|error| Error::Skeleton(error.to_string()))?;
    let skeleton = Arc::new(skeleton);
    let still = Rate::new(STILL_RATE, 1).map_err(|error| Error::Skeleton(error.to_string()))?;
    let Some(animation) = document.animations.first() else {
        findings.push(Finding::warning(
            None,
            "it has no animation; one frame at rest was made",
        ));
        return Ok(Scene {
            clip: Clip::still(skeleton, still, 1),
            convention,
            morphs: None,
            take: None,
            clock: None,
        });
    };
    if document.animations.len() > 1 {
        let names = document.animations[1..]
            .iter()
            .map(|it| it.name.as_deref().unwrap_or("unnamed"));
        let names: Vec<&str> = names.collect();
        findings.push(
            Finding::warning(
                None,
                format!(
                    "only its first animation was read; left out: {}",
                    names.join(", ")
                ),
            )
            .with_remedy("export each animation to a file of its own"),
        );
    }
    let (moved, weights) = samplers(data, animation, &rig, findings)?;
    let grid = Grid::of(
        moved
            .iter()
            .flat_map(|it| [&it.rotation, &it.translation])
            .flatten()
            .chain(weights.iter().map(|it| &it.keys)),
        findings,
    );
    let most = MOST_POSITIONS.saturating_add(data.bytes());
    let wide = weights.iter().map(|it| it.keys.width).sum::<usize>();
    let fits = |grid: &Grid| grid.frames.saturating_mul(rig.joints.len() + wide) <= most;
    let Some(grid) = grid.filter(fits) else {
        findings.push(Finding::warning(
            None,
            "its key times make more frames than can be held; one frame at rest was made",
        ));
        return Ok(Scene {
            clip: Clip::still(skeleton, still, 1),
            convention,
            morphs: None,
            take: animation.name.clone(),
            clock: None,
        });
    };
    let channels = rig.joints.iter().zip(&moved).zip(&rig.scales);
    let channels = channels.map(|((joint, moved), scale)| Channel {
        rotations: match &moved.rotation {
            Some(keys) => grid.times().map(|time| keys.turn_at(time)).collect(),
            None => vec![joint.rest; grid.frames],
        },
        translations: moved.translation.as_ref().map(|keys| {
            grid.times()
                .map(|time| keys.place_at(time) * *scale)
                .collect()
        }),
    });
    let mut channels: Vec<Channel> = channels.collect();
    let mut joints = rig.joints;
    let wrong = settle(&mut joints, &mut channels);
    if wrong > 0 {
        findings.push(Finding::note(
            None,
            format!("joints whose rest position contradicts the movement, which is used: {wrong}"),
        ));
    }
    let fault = |error: chereme_motion::SkeletonError| Error::Skeleton(error.to_string());
    let skeleton = Arc::new(Skeleton::new(joints).map_err(fault)?);
    let clip = Clip::new(skeleton, grid.rate, channels)
        .map_err(|error| Error::Skeleton(error.to_string()))?;
    let morphs = morphs(document, &weights, &grid);
    Ok(Scene {
        clip,
        convention,
        morphs,
        take: animation.name.clone(),
        clock: None,
    })
}

/// Weights of the morph targets of a node, or the movement of a node that stands for a part of a face.
struct Weights {
    node: usize,
    keys: Keys,
}

fn samplers(
    data: &Data<'_>,
    animation: &Animation,
    rig: &Rig,
    findings: &mut Findings,
) -> Result<(Vec<Moved>, Vec<Weights>), Error> {
    let mut moved: Vec<Moved> = rig.joints.iter().map(|_| Moved::default()).collect();
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
            let keys = keys(data, animation, channel.sampler, width)?;
            weights.push(Weights { node, keys });
            continue;
        }
        let width = match channel.target.path.as_str() {
            "rotation" => 4,
            "translation" => 3,
            "weights" => targets(data.document, node),
            "scale" => {
                let keys = keys(data, animation, channel.sampler, 3)?;
                if keys.values.chunks(3).any(|scale| {
                    scale
                        .iter()
                        .any(|it| (f64::from(*it) - 1.0).abs() > SAME_SCALE)
                }) {
                    findings.add("animated scales", || {
                        Finding::warning(
                            None,
                            format!("channel {at} changes the scale of a node; that is not shown"),
                        )
                    });
                }
                continue;
            }
            other => {
                findings.add("unknown channels", || {
                    Finding::note(
                        None,
                        format!("channel {at} changes {other:?}; it was left out"),
                    )
                });
                continue;
            }
        };
        if width == 0 {
            continue;
        }
        let keys = keys(data, animation, channel.sampler, width)?;
        match (channel.target.path.as_str(), joint) {
            ("rotation", Some(joint)) => moved[joint].rotation = Some(keys),
            ("translation", Some(joint)) => moved[joint].translation = Some(keys),
            ("weights", _) => weights.push(Weights { node, keys }),
            _ => {}
        }
    }
    Ok((moved, weights))
}

fn keys(
    data: &Data<'_>,
    animation: &Animation,
    sampler: usize,
    width: usize,
) -> Result<Keys, Error> {
    let fault = |problem: &str| Error::element("samplers", sampler, problem);
    let found = animation
        .samplers
        .get(sampler)
        .ok_or_else(|| fault("does not exist"))?;
    if let Some(extension) = found
        .extensions
        .as_object()
        .and_then(|all| all.keys().next())
    {
        return Err(Error::Packed(extension.clone()));
    }
    let is_weights = !matches!(width, 3 | 4)
        || data
            .document
            .accessors
            .get(found.output)
            .is_some_and(|it| it.shape == "SCALAR");
    let keys = Keys {
        times: data.floats(found.input, 1)?,
        values: data.floats(found.output, if is_weights { 1 } else { width })?,
        interpolation: found.interpolation,
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
fn targets(document: &Document, node: usize) -> usize {
    let mesh = document
        .nodes
        .get(node)
        .and_then(|node| document.meshes.get(node.mesh?));
    mesh.and_then(|mesh| mesh.primitives.first())
        .map_or(0, |primitive| primitive.targets.len())
}

/// The frames at which samplers are read.
struct Grid {
    rate: Rate,
    first: f64,
    frames: usize,
}

impl Grid {
    /// Returns frames at the rate of the keys; keys between frames are reported.
    fn of<'k>(keys: impl Iterator<Item = &'k Keys>, findings: &mut Findings) -> Option<Self> {
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
            let rate = Rate::new(STILL_RATE, 1).ok()?;
            return Some(Self {
                rate,
                first,
                frames: 1,
            });
        };
        let guess = rate_of(near_usual(1.0 / step)).or_else(|| Rate::new(STILL_RATE, 1).ok())?;
        let frames = (((last - first) * guess.per_second()).round() as usize).saturating_add(1);
        if frames > MOST_FRAMES {
            return None;
        }
        let off = times.iter().filter(|time| {
            let at = (**time - first) * guess.per_second();
            (at - at.round()).abs() > NEAR_FRAME
        });
        let off = off.count();
        if off > 0 {
            findings.push(Finding::note(
                None,
                format!("{off} of its {} key times lie between frames of {guess:?}; movement is read at that rate", times.len()),
            ));
        }
        if first.abs() > 1e-6 {
            findings.push(Finding::note(
                None,
                format!("its movement begins at {first:.3} s; that is 0 s here"),
            ));
        }
        Some(Self {
            rate: guess,
            first,
            frames,
        })
    }

    fn times(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.frames).map(|frame| self.first + frame as f64 * self.rate.frame_time())
    }
}

fn morphs(document: &Document, weights: &[Weights], grid: &Grid) -> Option<Curves> {
    let mut curves = Vec::new();
    let face = document.face_nodes();
    for moved in weights {
        match face.get(&moved.node) {
            Some(FaceNode::Expression(name)) => {
                let weight = |time| moved.keys.place_at(time).x as f32;
                let values = grid.times().map(weight).collect();
                curves.push(Curve::new(name.clone(), Column::singles(values)));
                continue;
            }
            Some(FaceNode::Gaze) => {
                for (name, axis) in [("gaze_left_degrees", 0), ("gaze_up_degrees", 1)] {
                    let degrees = |time| gaze(moved.keys.turn_at(time))[axis] as f32;
                    let values = grid.times().map(degrees).collect();
                    curves.push(Curve::new(name, Column::singles(values)));
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
        for time in grid.times() {
            moved.keys.at(time, &mut row);
            for (column, value) in columns.iter_mut().zip(&row) {
                column.push(*value as f32);
            }
        }
        for (target, values) in columns.into_iter().enumerate() {
            let given = names.get(target).and_then(|name| name.as_str());
            let name = given.map_or_else(|| format!("{mesh} {target}"), str::to_owned);
            curves.push(Curve::new(name, Column::singles(values)));
        }
    }
    let names: Vec<String> = curves
        .iter()
        .map(|curve: &Curve| curve.name.clone())
        .collect();
    for (curve, name) in curves
        .iter_mut()
        .zip(unique(names.iter().map(String::as_str), "target"))
    {
        curve.name = name;
    }
    Curves::new(Times::Even(grid.rate), curves).ok()
}
