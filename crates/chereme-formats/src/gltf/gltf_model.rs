//! The part of the JSON of glTF that movement needs.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::Value;

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct GltfDocument {
    pub(super) asset: GltfAsset,
    pub(super) extensions_required: Vec<String>,
    pub(super) extensions: Value,
    pub(super) scene: Option<usize>,
    pub(super) scenes: Vec<SceneNodes>,
    pub(super) nodes: Vec<GltfNode>,
    pub(super) skins: Vec<GltfSkin>,
    pub(super) meshes: Vec<GltfMesh>,
    pub(super) animations: Vec<GltfAnimation>,
    pub(super) accessors: Vec<GltfAccessor>,
    pub(super) buffer_views: Vec<BufferView>,
    pub(super) buffers: Vec<GltfBuffer>,
}

/// The part of a face that a node of a VRMA stands for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum FaceNode {
    /// The strength of an expression: its name.
    Expression(String),
    /// The direction of the eyes.
    Gaze,
}

impl GltfDocument {
    /// Returns the nodes of a VRMA whose movement is that of a face, not of a joint.
    pub(super) fn face_nodes(&self) -> BTreeMap<usize, FaceNode> {
        let Some(animation) = self.extensions.get("VRMC_vrm_animation") else {
            return BTreeMap::new();
        };
        let node = |of: &Value| of.get("node")?.as_u64().and_then(|number| number.try_into().ok());
        let kind_names = ["preset", "custom"].into_iter();
        let kinds = kind_names.filter_map(|kind| animation.get("expressions")?.get(kind)?.as_object());
        let mut nodes: BTreeMap<usize, FaceNode> = kinds
            .flatten()
            .filter_map(|(name, of)| {
                let node: usize = node(of)?;
                let original = self.nodes.get(node)?.extras.get("name");
                let name = original.and_then(Value::as_str).unwrap_or(name);
                Some((node, FaceNode::Expression(name.to_owned())))
            })
            .collect();
        let gaze = animation.get("lookAt").and_then(node);
        nodes.extend(gaze.map(|node: usize| (node, FaceNode::Gaze)));
        nodes
    }
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct GltfAsset {
    pub(super) version: String,
    pub(super) generator: Option<String>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct SceneNodes {
    pub(super) nodes: Vec<usize>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct GltfNode {
    pub(super) name: Option<String>,
    pub(super) children: Vec<usize>,
    pub(super) matrix: Option<[f64; 16]>,
    pub(super) translation: Option<[f64; 3]>,
    pub(super) rotation: Option<[f64; 4]>,
    pub(super) scale: Option<[f64; 3]>,
    pub(super) mesh: Option<usize>,
    pub(super) extras: Value,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct GltfSkin {
    pub(super) joints: Vec<usize>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct GltfMesh {
    pub(super) name: Option<String>,
    pub(super) primitives: Vec<GltfPrimitive>,
    pub(super) extras: Value,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct GltfPrimitive {
    pub(super) targets: Vec<Value>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct GltfAnimation {
    pub(super) name: Option<String>,
    pub(super) channels: Vec<GltfAnimationChannel>,
    pub(super) samplers: Vec<GltfSampler>,
}

#[derive(Debug, Deserialize)]
pub(super) struct GltfAnimationChannel {
    pub(super) sampler: usize,
    pub(super) target: GltfChannelTarget,
}

#[derive(Debug, Deserialize)]
pub(super) struct GltfChannelTarget {
    pub(super) node: Option<usize>,
    pub(super) path: String,
}

#[derive(Debug, Deserialize)]
pub(super) struct GltfSampler {
    pub(super) input: usize,
    pub(super) output: usize,
    #[serde(default)]
    pub(super) interpolation: GltfInterpolation,
    #[serde(default)]
    pub(super) extensions: Value,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
pub(super) enum GltfInterpolation {
    #[default]
    #[serde(rename = "LINEAR")]
    Linear,
    #[serde(rename = "STEP")]
    Step,
    #[serde(rename = "CUBICSPLINE")]
    Cubic,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct GltfAccessor {
    pub(super) buffer_view: Option<usize>,
    pub(super) byte_offset: usize,
    pub(super) component_type: u32,
    pub(super) normalized: bool,
    pub(super) count: usize,
    #[serde(rename = "type")]
    pub(super) shape: String,
    pub(super) sparse: Option<SparseAccessor>,
}

#[derive(Debug, Deserialize)]
pub(super) struct SparseAccessor {
    pub(super) count: usize,
    pub(super) indices: SparseIndices,
    pub(super) values: SparseValues,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct SparseIndices {
    pub(super) buffer_view: usize,
    #[serde(default)]
    pub(super) byte_offset: usize,
    pub(super) component_type: u32,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct SparseValues {
    pub(super) buffer_view: usize,
    #[serde(default)]
    pub(super) byte_offset: usize,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct BufferView {
    pub(super) buffer: usize,
    pub(super) byte_offset: usize,
    pub(super) byte_length: usize,
    pub(super) byte_stride: Option<usize>,
    pub(super) extensions: Value,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct GltfBuffer {
    pub(super) uri: Option<String>,
    pub(super) byte_length: usize,
}
