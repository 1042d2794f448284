//! The skeleton of a glTF document and its movement.

use std::sync::Arc;

use chereme_motion::glam::{DMat4, DQuat, DVec3};
use chereme_motion::{
    Channel, Clip, Column, Convention, Curve, Curves, Joint, Rate, Skeleton, Times,
};

use super::accessor::Data;
use super::error::Error;
use super::model::{Animation, Document, Node};
use super::sample::{Keys, turn};
use crate::finding::Finding;
use crate::scene::{Scene, near_usual, settle};
use crate::tally::Findings;
use crate::tracks::{rate_of, unique};

/// Frames a second of a skeleton without movement.
const STILL_RATE: u32 = 30;
/// Largest difference of scales, from 1 or from each other, that count as equal.
const SAME_SCALE: f64 = 1e-4;
/// Largest distance of a key from an even grid, as a share of a frame, at which the animation still has a rate.
const NEAR_FRAME: f64 = 0.05;
/// The most nodes of a file, and the greatest depth of a joint.
const MOST_NODES: usize = 20_000;
const MOST_FRAMES: usize = 5_000_000;
/// The most joints times frames of any file; each byte of its buffers allows one more.
const MOST_POSITIONS: usize = 8_000_000;
/// The most bytes of all buffers.
const MOST_BYTES: usize = 1 << 31;

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

/// Returns the JSON of a document and the binary chunk of a GLB.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), Error> {
    let word = |at: usize| -> Option<usize> {
        let bytes = bytes.get(at..at + 4)?;
        Some(u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]) as usize)
    };
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes, None));
    }
    if word(4) != Some(2) {
        return Err(Error::NoGltf);
    }
    let (mut json, mut binary) = (None, None);
    let mut at = 12;
    while let (Some(length), Some(kind)) = (word(at), bytes.get(at + 4..at + 8)) {
        let body = bytes.get(at + 8..).and_then(|rest| rest.get(..length));
        let body = body.ok_or(Error::Short("a chunk"))?;
        match kind {
            b"JSON" if json.is_none() => json = Some(body),
            b"BIN\0" if binary.is_none() => binary = Some(body),
            _ => {}
        }
        at += 8 + length;
    }
    let json = json.ok_or(Error::Short("its JSON"))?;
    Ok((json, Some(binary.unwrap_or_default())))
}

fn buffers(
    document: &Document,
    binary: Option<&[u8]>,
    beside: &dyn Fn(&str) -> Option<Vec<u8>>,
) -> Result<Vec<Vec<u8>>, Error> {
    let mut total = 0_usize;
    let bytes = |(at, buffer): (usize, &super::model::Buffer)| {
        let bytes = match &buffer.uri {
            None => binary
                .filter(|_| at == 0)
                .map(<[u8]>::to_vec)
                .unwrap_or_default(),
            Some(uri) => match uri.strip_prefix("data:") {
                Some(data) => {
                    let (_, text) = data.split_once(";base64,").ok_or_else(|| elsewhere(uri))?;
                    base64(text).ok_or_else(|| elsewhere(uri))?
                }
                None if is_plain_name(uri) => {
                    beside(&unescaped(uri)).ok_or_else(|| elsewhere(uri))?
                }
                None => return Err(elsewhere(uri)),
            },
        };
        if bytes.len() < buffer.byte_length {
            return Err(Error::Short("a buffer"));
        }
        total = total.saturating_add(bytes.len());
        if total > MOST_BYTES {
            return Err(Error::element(
                "buffers",
                at,
                "makes more bytes than can be held",
            ));
        }
        Ok(bytes)
    };
    document.buffers.iter().enumerate().map(bytes).collect()
}

fn elsewhere(uri: &str) -> Error {
    Error::Elsewhere(uri.chars().take(60).collect())
}

/// Returns whether an address is a file inside the folder: no scheme, no step up, no root.
fn is_plain_name(uri: &str) -> bool {
    let name = unescaped(uri);
    let steps = || name.split(['/', '\\']);
    !name.contains(':') && steps().all(|step| !step.is_empty() && step != "." && step != "..")
}

/// Decodes `%20` and similar escapes.
fn unescaped(uri: &str) -> String {
    let mut bytes = Vec::new();
    let mut rest = uri.as_bytes();
    while let Some((first, after)) = rest.split_first() {
        let hex = after.get(..2).and_then(|two| std::str::from_utf8(two).ok());
        let byte = hex.and_then(|two| u8::from_str_radix(two, 16).ok());
        match (first, byte) {
            (b'%', Some(byte)) => {
                bytes.push(byte);
                rest = &after[2..];
            }
            _ => {
                bytes.push(*first);
                rest = after;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Decodes base64 (RFC 4648, section 4); blanks are skipped.
pub(super) fn base64(text: &str) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3);
    let (mut word, mut bits) = (0u32, 0);
    for letter in text
        .bytes()
        .filter(|byte| !byte.is_ascii_whitespace() && *byte != b'=')
    {
        let six = match letter {
            b'A'..=b'Z' => letter - b'A',
            b'a'..=b'z' => letter - b'a' + 26,
            b'0'..=b'9' => letter - b'0' + 52,
            b'+' | b'-' => 62,
            b'/' | b'_' => 63,
            _ => return None,
        };
        word = (word << 6) | u32::from(six);
        bits += 6;
        if bits >= 8 {
            bits -= 8;
            bytes.push((word >> bits) as u8);
            word &= (1 << bits) - 1;
        }
    }
    Some(bytes)
}

/// The nodes that are joints, parents before children, with scales folded into offsets.
struct Rig {
    /// The node of each joint; `None` for a root that joins several trees.
    nodes: Vec<Option<usize>>,
    joints: Vec<Joint>,
    /// The scale of each joint's translations.
    scales: Vec<f64>,
}

/// The translation, rotation and scale of a node.
fn transform(node: &Node) -> (DVec3, DQuat, DVec3) {
    if let Some(matrix) = &node.matrix {
        let (scale, rotation, translation) =
            DMat4::from_cols_array(matrix).to_scale_rotation_translation();
        let sound = scale.is_finite() && rotation.is_finite() && translation.is_finite();
        if sound {
            return (translation, turn(&rotation.to_array()), scale);
        }
    }
    let translation = DVec3::from_array(node.translation.unwrap_or_default());
    let rotation = node.rotation.map_or(DQuat::IDENTITY, |it| turn(&it));
    let scale = DVec3::from_array(node.scale.unwrap_or([1.0; 3]));
    (translation, rotation, scale)
}

impl Rig {
    fn of(document: &Document, findings: &mut Findings) -> Result<Self, Error> {
        let nodes = &document.nodes;
        if nodes.len() > MOST_NODES {
            return Err(Error::Skeleton(format!(
                "{} nodes are too many",
                nodes.len()
            )));
        }
        let mut parents = vec![None; nodes.len()];
        for (at, node) in nodes.iter().enumerate() {
            for child in &node.children {
                let fault = |problem: &str| Error::element("nodes", at, problem);
                let parent = parents
                    .get_mut(*child)
                    .ok_or_else(|| fault("has a child that does not exist"))?;
                if parent.replace(at).is_some() {
                    return Err(fault("shares a child with another node"));
                }
            }
        }
        if let Some(at) = below_itself(nodes, &parents) {
            return Err(Error::element("nodes", at, "is below itself"));
        }
        let kept = kept(document, &parents)?;
        let roots: Vec<usize> = (0..nodes.len())
            .filter(|at| kept[*at] && parents[*at].is_none())
            .collect();
        if roots.is_empty() {
            return Err(Error::NoSkeleton);
        }
        let mut rig = Self {
            nodes: Vec::new(),
            joints: Vec::new(),
            scales: Vec::new(),
        };
        if roots.len() > 1 {
            rig.nodes.push(None);
            rig.joints.push(Joint::new("scene", None, DVec3::ZERO));
            rig.scales.push(1.0);
            findings.push(Finding::note(
                None,
                format!("{} trees of joints were put below one root", roots.len()),
            ));
        }
        let top = (roots.len() > 1).then_some(0);
        let mut open: Vec<(usize, Option<usize>, f64)> =
            roots.iter().rev().map(|root| (*root, top, 1.0)).collect();
        while let Some((at, parent, above)) = open.pop() {
            let (translation, rotation, scale) = transform(&nodes[at]);
            let offset = translation * above;
            if !offset.is_finite() || rig.joints.len() > nodes.len() {
                return Err(Error::element("nodes", at, "has a place that is no number"));
            }
            rig.joints.push(Joint {
                rest: rotation,
                ..Joint::new(name(&nodes[at], at), parent, offset)
            });
            rig.nodes.push(Some(at));
            rig.scales.push(above);
            let joint = rig.joints.len() - 1;
            let below = above * uniform(scale, at, &nodes[at], findings);
            let children = nodes[at]
                .children
                .iter()
                .rev()
                .filter(|child| kept[**child]);
            open.extend(children.map(|child| (*child, Some(joint), below)));
        }
        let names: Vec<String> = rig.joints.iter().map(|joint| joint.name.clone()).collect();
        for (joint, name) in rig
            .joints
            .iter_mut()
            .zip(unique(names.iter().map(String::as_str), "joint"))
        {
            joint.name = name;
        }
        Ok(rig)
    }
}

/// Returns a node that no root leads to, because it is an ancestor of itself.
fn below_itself(nodes: &[Node], parents: &[Option<usize>]) -> Option<usize> {
    let mut reached = vec![false; nodes.len()];
    let roots = (0..nodes.len()).filter(|at| parents[*at].is_none());
    let mut open: Vec<usize> = roots.collect();
    while let Some(at) = open.pop() {
        reached[at] = true;
        open.extend(&nodes[at].children);
    }
    reached.iter().position(|reached| !reached)
}

/// Returns a node's original name, undoing an exporter's changes.
fn name(node: &Node, at: usize) -> String {
    let original = node.extras.get("name").and_then(serde_json::Value::as_str);
    let name = original.or(node.name.as_deref()).unwrap_or_default();
    if name.is_empty() {
        format!("node {at}")
    } else {
        name.to_owned()
    }
}

/// Returns a scale as one number, and reports a scale that differs between axes.
fn uniform(scale: DVec3, at: usize, node: &Node, findings: &mut Findings) -> f64 {
    let mean = (scale.x.abs() + scale.y.abs() + scale.z.abs()) / 3.0;
    let even = (scale.abs() - DVec3::splat(mean)).abs().max_element() <= SAME_SCALE * mean.max(1.0);
    if !even || scale.min_element() < 0.0 || !mean.is_finite() {
        let name = name(node, at);
        findings.add("scales that are not even", || {
            Finding::warning(
                None,
                format!("the node {name:?} is stretched or mirrored; its mean scale is taken"),
            )
        });
    }
    let near_one = (mean - 1.0).abs() <= SAME_SCALE;
    if near_one || !mean.is_finite() {
        1.0
    } else {
        mean
    }
}

/// Marks joints of skins, animated nodes, and all nodes above them.
fn kept(document: &Document, parents: &[Option<usize>]) -> Result<Vec<bool>, Error> {
    let mut kept = vec![false; parents.len()];
    let of_skins = document
        .skins
        .iter()
        .flat_map(|skin| skin.joints.iter().copied());
    let animated = document
        .animations
        .iter()
        .flat_map(|animation| &animation.channels);
    let animated = animated
        .filter(|channel| channel.target.path != "weights")
        .filter_map(|channel| channel.target.node);
    for node in of_skins.chain(animated) {
        let mut at = Some(node);
        let mut steps = 0;
        while let Some(node) = at {
            let mark = kept
                .get_mut(node)
                .ok_or_else(|| Error::element("nodes", node, "does not exist"))?;
            steps += 1;
            if steps > parents.len() {
                return Err(Error::element("nodes", node, "is its own ancestor"));
            }
            if *mark && steps > 1 {
                break;
            }
            *mark = true;
            at = parents[node];
        }
    }
    Ok(kept)
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

/// Weights of the morph targets of a node.
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
    for (at, channel) in animation.channels.iter().enumerate() {
        // An extension may animate a target that is not a node.
        let Some(node) = channel.target.node else {
            continue;
        };
        let joint = rig.nodes.iter().position(|known| *known == Some(node));
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
    for moved in weights {
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
