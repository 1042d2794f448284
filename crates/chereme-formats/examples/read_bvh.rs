//! Reads a BVH file into a clip: `cargo run -p chereme-formats --example read_bvh -- [FILE.bvh]`.

#![allow(clippy::print_stdout, reason = "a program prints its answer")]

use std::error::Error;

use chereme_formats::bvh::bvh_convert::{ClipBuilder, rate_from_frame_time};
use chereme_formats::bvh::raw::{BvhReader, MotionBlock};
use chereme_motion::{BodyAnatomy, BodySide};

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let named = std::env::args().nth(1).filter(|name| name.ends_with(".bvh"));
    let text = match named {
        Some(path) => std::fs::read_to_string(path)?,
        None => chereme_data::starter_text("bol.bvh").to_owned(),
    };

    // The raw reader mirrors the file, block by block of frames; an error names its line.
    let mut reader = BvhReader::open_bvh(text.as_bytes())?;
    let rate = rate_from_frame_time(reader.bvh_motion_header().frame_time.as_ref())?;
    let mut builder = ClipBuilder::new(reader.bvh_hierarchy(), None)?;
    let mut block = MotionBlock::default();
    while reader.next_block(&mut block)? {
        builder.push_block_rows(0..block.frames, |column| block.columns.get(column));
    }

    // The clip is what the file means: joints in metres, frames at exact times.
    let clip = builder.finish_bvh_clip(rate)?;
    let anatomy = BodyAnatomy::detect_anatomy(clip.clip_skeleton());
    let (joints, frames) = (clip.clip_skeleton().len(), clip.clip_frame_count());
    println!(
        "{joints} joints, {frames} frames, {:.2} s",
        clip.clip_span().span_seconds()
    );
    println!("fingers on the right: {}", anatomy.has_fingers(BodySide::Right));
    Ok(())
}
