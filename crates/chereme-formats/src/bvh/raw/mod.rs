//! The contents of a BVH file: its hierarchy, and its motion in blocks of frames, every number an exact decimal.
//!
//! ```
//! use chereme_formats::bvh::raw::{MotionBlock, BvhReader, BvhWriter};
//!
//! let text = "HIERARCHY\nROOT Hips\n{\n\tOFFSET 0 95.5 0\n\tCHANNELS 3 Zrotation Xrotation Yrotation\n\
//!             \tEnd Site\n\t{\n\t\tOFFSET 0 10 0\n\t}\n}\nMOTION\nFrames: 2\nFrame Time: 0.008333\n\
//!             1.50 -2 3e-3\n1.25 -2 0\n";
//! let mut reader = BvhReader::open_bvh(text.as_bytes())?;
//! assert_eq!(reader.bvh_hierarchy().joints[0].name, "Hips");
//! let mut copy = Vec::new();
//! let mut writer = BvhWriter::new(&mut copy, reader.bvh_hierarchy(), Some((reader.bvh_motion_header().frame_time.as_ref(), 2)))?;
//! let mut block = MotionBlock::default();
//! while reader.next_block(&mut block)? {
//!     assert_eq!((block.columns[0].decimal_value_at(0), block.columns[2].decimal_value_at(0)), (1.5, 0.003));
//!     writer.write_motion_block(&block)?;
//! }
//! writer.finish_bvh_writing()?;
//! assert_eq!(reader.finish_bvh_reading().frames, 2);
//! assert!(String::from_utf8_lossy(&copy).ends_with("1.50 -2 0.003\n1.25 -2 0.000\n"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod block;
mod digits;
mod error;
mod header;
mod hierarchy;
mod oddity;
mod raw_parse;
mod raw_source;
mod raw_writer;
mod reader;
mod root_order;

pub use block::MotionBlock;
pub use error::{BvhError, BvhErrorKind};
pub use header::BvhMotionHeader;
pub use hierarchy::{BvhChannel, BvhHierarchy, RawJoint};
pub use raw_writer::{BvhWriteError, BvhWriter};
pub use reader::{BvhReadOptions, BvhReadSummary, BvhReader};
pub use root_order::ChannelFix;

pub use chereme_motion::column::{DecimalColumn as Column, ExactDecimal, FileNumber, NotANumber};
