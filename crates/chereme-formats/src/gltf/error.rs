//! What can keep bytes from being read as glTF.

/// A reason why a file could not be read as glTF.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Error {
    /// The bytes are neither GLB nor JSON of glTF 2.
    #[error("this is no glTF 2.0 file")]
    NoGltf,
    /// The JSON does not say what glTF says.
    #[error("its JSON is not that of glTF: {0}")]
    Json(String),
    /// The file was cut short.
    #[error("the file ends within {0}; it is cut short")]
    Short(&'static str),
    /// An element names one that does not exist, or bytes outside its buffer.
    #[error("{element} {index}: {problem}")]
    Element {
        /// The list that the element belongs to, such as `accessors`.
        element: &'static str,
        /// The element's position in it, from 0.
        index: usize,
        /// What is wrong.
        problem: String,
    },
    /// The movement is packed in a way that is not read.
    #[error("the movement is packed by the extension {0}; export it without compression")]
    Packed(String),
    /// A buffer lies in a file or at an address that is not read.
    #[error(
        "the buffer {0:?} is not in the file or next to it; save as .glb, or keep the .bin beside the .gltf"
    )]
    Elsewhere(String),
    /// There is no skeleton.
    #[error("the file holds no skeleton: no skin and no animated node")]
    NoSkeleton,
    /// The nodes are no tree, or their numbers are no places and rotations.
    #[error("{0}")]
    Skeleton(String),
}

impl Error {
    pub(super) fn element(element: &'static str, index: usize, problem: impl Into<String>) -> Self {
        Self::Element {
            element,
            index,
            problem: problem.into(),
        }
    }
}
