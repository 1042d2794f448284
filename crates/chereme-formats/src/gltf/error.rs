//! Errors in reading glTF.

/// A reason why a file could not be read as glTF.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum GltfError {
    /// The bytes are neither GLB nor JSON of glTF 2.
    #[error("this is no glTF 2.0 file")]
    NoGltf,
    /// The JSON does not have the structure of glTF.
    #[error("its JSON is not that of glTF: {0}")]
    Json(String),
    /// The file was cut short.
    #[error("the file ends within {0}; it is cut short")]
    Short(&'static str),
    /// An element refers to one that does not exist, or to bytes outside its buffer.
    #[error("{element} {index}: {problem}")]
    Element {
        /// The list that the element belongs to, such as `accessors`.
        element: &'static str,
        /// The element's position in it, from 0.
        index: usize,
        /// The problem.
        problem: String,
    },
    /// The movement is compressed by an unsupported extension.
    #[error("the movement is packed by the extension {0}; export it without compression")]
    Packed(String),
    /// A buffer is in a file or at an address that the reader does not open.
    #[error("the buffer {0:?} is not in the file or next to it; save as .glb, or keep the .bin beside the .gltf")]
    Elsewhere(String),
    /// There is no skeleton.
    #[error("the file holds no skeleton: no skin and no animated node")]
    NoSkeleton,
    /// The nodes are not a tree, or their numbers are not positions and rotations.
    #[error("{0}")]
    Skeleton(String),
}

impl GltfError {
    pub(super) fn gltf_element_error(element: &'static str, index: usize, problem: impl Into<String>) -> Self {
        Self::Element {
            element,
            index,
            problem: problem.into(),
        }
    }
}
