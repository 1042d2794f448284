//! Reads a BVH file into a clip: `cargo run -p chereme-formats --example read_bvh -- [FILE.bvh]`.

#![allow(clippy::print_stdout, reason = "a program prints its answer")]

use std::error::Error;

use chereme_formats::bvh::convert::{ClipBuilder, rate};
use chereme_formats::bvh::raw::{Block, Reader};
use chereme_motion::{Anatomy, Side};

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let named = std::env::args()
        .nth(1)
        .filter(|name| name.ends_with(".bvh"));
    let text = match named {
        Some(path) => std::fs::read_to_string(path)?,
        None => chereme_data::starter_text("bol.bvh").to_owned(),
    };

    // The raw reader mirrors the file, block by block of frames; an error names its line.
    let mut reader = Reader::open(text.as_bytes())?;
    let rate = rate(reader.header().frame_time.as_ref())?;
    let mut builder = ClipBuilder::new(reader.hierarchy(), None)?;
    let mut block = Block::default();
    while reader.next_block(&mut block)? {
        builder.push(0..block.frames, |column| block.columns.get(column));
    }

    // The clip is what the file means: joints in metres, frames at exact times.
    let clip = builder.finish(rate)?;
    let anatomy = Anatomy::detect(clip.skeleton());
    let (joints, frames) = (clip.skeleton().len(), clip.frames());
    println!(
        "{joints} joints, {frames} frames, {:.2} s",
        clip.span().seconds()
    );
    println!("fingers on the right: {}", anatomy.has_fingers(Side::Right));
    Ok(())
}
