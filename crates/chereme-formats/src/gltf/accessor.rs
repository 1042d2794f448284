//! Reads the numbers of accessors, and checks every index and every range of bytes.

use std::cell::Cell;

use super::error::GltfError;
use super::gltf_model::{GltfAccessor, GltfDocument, SparseAccessor};

/// The most numbers that are read from any file; each byte of its buffers allows two more, as accessors may share
/// bytes.
const MAX_ACCESSOR_NUMBERS: usize = 1 << 25;

/// The document with the bytes of its buffers.
pub(super) struct GltfData<'a> {
    pub(super) document: &'a GltfDocument,
    pub(super) buffers: Vec<Vec<u8>>,
    /// The number of numbers that may still be read.
    left: Cell<usize>,
}

impl<'a> GltfData<'a> {
    /// Returns the data of a document, with a limit on reading that grows with its size.
    pub(super) fn new(document: &'a GltfDocument, buffers: Vec<Vec<u8>>) -> Self {
        let data = Self {
            document,
            buffers,
            left: Cell::new(0),
        };
        data.left
            .set(MAX_ACCESSOR_NUMBERS.saturating_add(data.count_buffer_bytes().saturating_mul(2)));
        data
    }

    /// Returns the number of bytes of all buffers.
    pub(super) fn count_buffer_bytes(&self) -> usize {
        self.buffers.iter().map(Vec::len).sum()
    }

    /// Returns the numbers of an accessor whose elements have `width` numbers each.
    pub(super) fn read_accessor_floats(&self, index: usize, width: usize) -> Result<Vec<f32>, GltfError> {
        let fault = |problem: &str| GltfError::gltf_element_error("accessors", index, problem);
        let accessor = self
            .document
            .accessors
            .get(index)
            .ok_or_else(|| fault("does not exist"))?;
        let accessor_width = match accessor.shape.as_str() {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            "MAT4" => 16,
            _ => 0,
        };
        if accessor_width != width {
            return Err(fault(&format!(
                "is {:?}, and {width} numbers are needed",
                accessor.shape
            )));
        }
        let number_count = accessor
            .count
            .checked_mul(width)
            .filter(|count| *count <= self.left.get());
        let numbers = number_count.ok_or_else(|| fault("has too many elements"))?;
        self.left.set(self.left.get() - numbers);
        let mut values = match accessor.buffer_view {
            Some(view) => self.dense(index, accessor, view, width)?,
            // Without a view all numbers are zero.
            None => vec![0.0; numbers],
        };
        if let Some(sparse) = &accessor.sparse {
            self.overlay_sparse_values(index, accessor, sparse, &mut values, width)?;
        }
        if values.iter().any(|value| !value.is_finite()) {
            return Err(fault("holds numbers that are not finite"));
        }
        Ok(values)
    }

    fn buffer_view_bytes(&self, index: usize) -> Result<(&[u8], Option<usize>), GltfError> {
        let fault = |problem: &str| GltfError::gltf_element_error("bufferViews", index, problem);
        let view = self
            .document
            .buffer_views
            .get(index)
            .ok_or_else(|| fault("does not exist"))?;
        if let Some(extension) = view.extensions.as_object().and_then(|all| all.keys().next()) {
            return Err(GltfError::Packed(extension.clone()));
        }
        let buffer = self
            .buffers
            .get(view.buffer)
            .ok_or_else(|| fault("names a buffer that does not exist"))?;
        let end = view.byte_offset.checked_add(view.byte_length);
        let bytes = end.and_then(|end| buffer.get(view.byte_offset..end));
        Ok((
            bytes.ok_or_else(|| fault("reaches beyond its buffer"))?,
            view.byte_stride,
        ))
    }

    fn dense(&self, index: usize, accessor: &GltfAccessor, view: usize, width: usize) -> Result<Vec<f32>, GltfError> {
        let fault = |problem: &str| GltfError::gltf_element_error("accessors", index, problem);
        let (bytes, stride) = self.buffer_view_bytes(view)?;
        let size =
            component_size_bytes(accessor.component_type).ok_or_else(|| fault("has an unknown component type"))?;
        let stride = stride.unwrap_or(size * width);
        if stride < size * width {
            return Err(fault("has elements that lie in each other"));
        }
        let mut values = Vec::new();
        for element in 0..accessor.count {
            let begin = element
                .checked_mul(stride)
                .and_then(|at| at.checked_add(accessor.byte_offset));
            let element_bytes = begin.and_then(|at| bytes.get(at..at.checked_add(size * width)?));
            let element = element_bytes.ok_or_else(|| fault("reaches beyond its view"))?;
            let numbers = element.chunks_exact(size);
            values.extend(
                numbers.map(|bytes| read_component_number(bytes, accessor.component_type, accessor.normalized)),
            );
        }
        Ok(values)
    }

    fn overlay_sparse_values(
        &self,
        index: usize,
        accessor: &GltfAccessor,
        sparse: &SparseAccessor,
        values: &mut [f32],
        width: usize,
    ) -> Result<(), GltfError> {
        let fault = |problem: &str| GltfError::gltf_element_error("accessors", index, problem);
        let index_size =
            component_size_bytes(sparse.indices.component_type).ok_or_else(|| fault("has unknown sparse indices"))?;
        let size =
            component_size_bytes(accessor.component_type).ok_or_else(|| fault("has an unknown component type"))?;
        let (indices, _) = self.buffer_view_bytes(sparse.indices.buffer_view)?;
        let (numbers, _) = self.buffer_view_bytes(sparse.values.buffer_view)?;
        let beyond = || fault("has sparse values beyond their view");
        let indices = indices.get(sparse.indices.byte_offset..).ok_or_else(beyond)?;
        let numbers = numbers.get(sparse.values.byte_offset..).ok_or_else(beyond)?;
        for at in 0..sparse.count {
            let bytes = indices.get(at * index_size..(at + 1) * index_size).ok_or_else(beyond)?;
            let target = read_component_number(bytes, sparse.indices.component_type, false) as usize;
            let element = numbers
                .get(at * size * width..(at + 1) * size * width)
                .ok_or_else(beyond)?;
            let end = target.checked_add(1).and_then(|next| next.checked_mul(width));
            let place = end
                .and_then(|end| values.get_mut(target * width..end))
                .ok_or_else(beyond)?;
            for (value, bytes) in place.iter_mut().zip(element.chunks_exact(size)) {
                *value = read_component_number(bytes, accessor.component_type, accessor.normalized);
            }
        }
        Ok(())
    }
}

/// Returns the number of bytes of a component type; `None` if it is unknown.
fn component_size_bytes(component: u32) -> Option<usize> {
    match component {
        5120 | 5121 => Some(1),
        5122 | 5123 => Some(2),
        5125 | 5126 => Some(4),
        _ => None,
    }
}

/// Reads a number; normalised integers are shares of their range (glTF 2.0, section 3.6.2.2).
fn read_component_number(bytes: &[u8], component: u32, normalized: bool) -> f32 {
    let two = || [bytes[0], bytes[1]];
    let four = || [bytes[0], bytes[1], bytes[2], bytes[3]];
    let (value, range) = match component {
        5120 => (f32::from(bytes[0] as i8), 127.0),
        5121 => (f32::from(bytes[0]), 255.0),
        5122 => (f32::from(i16::from_le_bytes(two())), 32_767.0),
        5123 => (f32::from(u16::from_le_bytes(two())), 65_535.0),
        5125 => (u32::from_le_bytes(four()) as f32, 1.0),
        _ => return f32::from_le_bytes(four()),
    };
    if normalized { (value / range).max(-1.0) } else { value }
}
