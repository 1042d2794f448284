//! A hierarchy and blocks of frames as BVH text.

use std::io::{self, Write};

use super::{BvhHierarchy, ExactDecimal, FileNumber, MotionBlock};

/// Columns of up to this many digits after the point are written with all of them, as exporters do; finer
/// ones, from scientific notation or full precision, without trailing zeros.
const FIXED_DIGITS: u8 = 8;
/// Bytes of text that are collected before they are written.
const WRITER_CHUNK_BYTES: usize = 64 * 1024;

/// The reason why a hierarchy or its motion can't be written as BVH.
#[derive(Debug, thiserror::Error)]
pub enum BvhWriteError {
    /// The bytes could not be written.
    #[error("the file can't be written: {0}")]
    Io(#[from] io::Error),
    /// A name that would be read as something else.
    #[error("the joint name {0:?} has braces, line ends or blanks at its ends, which BVH can't hold; rename the joint")]
    Name(String),
    /// A parent that does not come before its child, or a second root.
    #[error("joint {0:?} does not come after its parent, depth first; BVH holds one tree")]
    Order(String),
    /// A block whose number of columns differs from the hierarchy's channels, or with columns of different
    /// lengths.
    #[error("the block at frame {frame} has not {channels} columns of {rows} rows")]
    Shape {
        /// The first frame of the block.
        frame: u64,
        /// The channels of the hierarchy.
        channels: usize,
        /// The frames of the block.
        rows: usize,
    },
    /// The number of frames differs from the header's.
    #[error("the header says {declared} frames, but {written} were given")]
    FrameCount {
        /// The frames in the header.
        declared: u64,
        /// The frames that were given.
        written: u64,
    },
}

/// Writes a BVH file piece by piece; the file reads back equal, number by number.
pub struct BvhWriter<W> {
    out: W,
    text: Vec<u8>,
    channels: usize,
    declared: Option<u64>,
    written: u64,
}

impl<W: Write> BvhWriter<W> {
    /// Writes the hierarchy and, given frame time and frame count, the header of the motion; otherwise no
    /// MOTION section.
    ///
    /// # Errors
    /// [`BvhWriteError`] if the names or the order of the joints can't be written as BVH, or the bytes can't
    /// be written.
    pub fn new(
        out: W,
        hierarchy: &BvhHierarchy,
        motion: Option<(Option<&FileNumber>, u64)>,
    ) -> Result<Self, BvhWriteError> {
        let mut text = Vec::with_capacity(WRITER_CHUNK_BYTES * 2);
        push_hierarchy(&mut text, hierarchy)?;
        if let Some((frame_time, frames)) = motion {
            text.extend_from_slice(format!("MOTION\nFrames: {frames}\n").as_bytes());
            if let Some(frame_time) = frame_time {
                text.extend_from_slice(format!("Frame Time: {frame_time}\n").as_bytes());
            }
        }
        let declared = motion.map(|(_, frames)| frames);
        let mut writer = Self {
            out,
            text,
            channels: hierarchy.channel_count(),
            declared,
            written: 0,
        };
        writer.flush_text(0)?;
        Ok(writer)
    }

    /// Writes the frames of a block after the previous ones.
    ///
    /// # Errors
    /// [`BvhWriteError`] if the block does not fit the hierarchy, or the bytes can't be written.
    pub fn write_motion_block(&mut self, block: &MotionBlock) -> Result<(), BvhWriteError> {
        let rows = block.frames;
        let fits = block.columns.len() == self.channels && block.columns.iter().all(|c| c.mantissas.len() == rows);
        if !fits {
            return Err(BvhWriteError::Shape {
                frame: block.first_frame,
                channels: self.channels,
                rows,
            });
        }
        for frame in 0..rows {
            self.write_motion_row(block, frame);
            self.flush_text(WRITER_CHUNK_BYTES)?;
        }
        self.written += rows as u64;
        Ok(())
    }

    /// Writes the rest, and returns the output.
    ///
    /// # Errors
    /// [`BvhWriteError`] if the number of frames differs from the announced one, or the bytes cannot be
    /// written.
    pub fn finish_bvh_writing(mut self) -> Result<W, BvhWriteError> {
        let declared = self.declared.unwrap_or(0);
        if declared != self.written {
            return Err(BvhWriteError::FrameCount {
                declared,
                written: self.written,
            });
        }
        self.flush_text(0)?;
        self.out.flush()?;
        Ok(self.out)
    }

    fn write_motion_row(&mut self, block: &MotionBlock, frame: usize) {
        for column in &block.columns {
            match column.decimal_exception_at(frame) {
                Some(number) => number.push_to(&mut self.text),
                None => {
                    let decimal = ExactDecimal {
                        mantissa: column.mantissas[frame],
                        scale: column.scale,
                    };
                    let is_fixed = column.scale <= FIXED_DIGITS;
                    let shown = if is_fixed {
                        decimal
                    } else {
                        decimal.trim_trailing_zeros()
                    };
                    shown.push_to(&mut self.text);
                }
            }
            self.text.push(b' ');
        }
        self.text.pop();
        self.text.push(b'\n');
    }

    fn flush_text(&mut self, beyond: usize) -> Result<(), BvhWriteError> {
        if self.text.len() > beyond {
            self.out.write_all(&self.text)?;
            self.text.clear();
        }
        Ok(())
    }
}

/// Appends the hierarchy; a joint's End Sites come before its children.
fn push_hierarchy(text: &mut Vec<u8>, hierarchy: &BvhHierarchy) -> Result<(), BvhWriteError> {
    text.extend_from_slice(b"HIERARCHY\n");
    let mut open: Vec<usize> = Vec::new();
    for (index, joint) in hierarchy.joints.iter().enumerate() {
        let name = &joint.name;
        if name.contains(['{', '}', '\n', '\r']) || name.trim_ascii() != name {
            return Err(BvhWriteError::Name(name.clone()));
        }
        // Joints come depth first: open ones below the parent are complete.
        while open.last().copied() != joint.parent {
            open.pop().ok_or_else(|| BvhWriteError::Order(name.clone()))?;
            push_line(text, open.len(), "}");
        }
        if joint.parent.is_none() != (index == 0) {
            return Err(BvhWriteError::Order(name.clone()));
        }
        let depth = open.len();
        push_line(
            text,
            depth,
            &format!("{} {name}", if index == 0 { "ROOT" } else { "JOINT" }),
        );
        push_line(text, depth, "{");
        push_line(text, depth + 1, &offset_line(&joint.offset));
        let words: String = joint.channels.iter().map(|channel| format!(" {channel}")).collect();
        push_line(text, depth + 1, &format!("CHANNELS {}{words}", joint.channels.len()));
        for end in &joint.end_sites {
            push_line(text, depth + 1, "End Site");
            push_line(text, depth + 1, "{");
            push_line(text, depth + 2, &offset_line(end));
            push_line(text, depth + 1, "}");
        }
        open.push(index);
    }
    for depth in (0..open.len()).rev() {
        push_line(text, depth, "}");
    }
    Ok(())
}

fn offset_line([x, y, z]: &[FileNumber; 3]) -> String {
    format!("OFFSET {x} {y} {z}")
}

fn push_line(text: &mut Vec<u8>, depth: usize, line: &str) {
    text.extend(std::iter::repeat_n(b'\t', depth));
    text.extend_from_slice(line.as_bytes());
    text.push(b'\n');
}
