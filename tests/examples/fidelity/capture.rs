//! Captured movement from BVH files, in metres and model space.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use chereme_formats::bvh::bvh_convert::{self, ClipBuilder};
use chereme_formats::bvh::raw::{BvhReader, ChannelFix, MotionBlock};
use chereme_motion::{BodyAnatomy, BodySide, Clip};

use crate::Result;

/// A captured piece of movement of a body with at least one arm.
pub(crate) struct Capture {
    /// The file's name without its ending.
    pub(crate) name: String,
    pub(crate) clip: Clip,
    pub(crate) anatomy: Arc<BodyAnatomy>,
}

impl Capture {
    /// Returns the sides that have an arm.
    pub(crate) fn sides(&self) -> Vec<BodySide> {
        let has = |side: &BodySide| self.anatomy.arm_chain(*side).is_some();
        BodySide::BOTH_SIDES.into_iter().filter(has).collect()
    }
}

/// Reads every BVH file below `folder`, in the order of their paths; returns the files left out, with the reason.
pub(crate) fn read_folder(folder: &Path) -> Result<(Vec<Capture>, Vec<String>)> {
    let mut paths = Vec::new();
    find(folder, &mut paths)?;
    paths.sort();
    let (mut captures, mut left_out) = (Vec::new(), Vec::new());
    for path in paths {
        let capture = read(&path).and_then(usable);
        match capture {
            Ok(capture) => captures.push(capture),
            Err(error) => left_out.push(format!("{}: {error}", path.display())),
        }
    }
    Ok((captures, left_out))
}

fn find(folder: &Path, paths: &mut Vec<PathBuf>) -> Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        let is_bvh = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("bvh"));
        if path.is_dir() {
            find(&path, paths)?;
        } else if is_bvh {
            paths.push(path);
        }
    }
    Ok(())
}

fn usable(capture: Capture) -> Result<Capture> {
    if capture.sides().is_empty() {
        return Err("no arm was found in its skeleton".into());
    }
    if capture.clip.clip_frame_count() < 10 {
        return Err("it has fewer than ten frames".into());
    }
    Ok(capture)
}

fn read(path: &Path) -> Result<Capture> {
    let clip = match build(path, None)? {
        (_, Some(fix)) => build(path, Some(fix))?.0,
        (clip, None) => clip,
    };
    let skeleton = clip.clip_skeleton();
    let pose = (clip.clip_frame_count() > 0).then(|| clip.model_pose(0));
    let guess = BodyAnatomy::detect_anatomy(skeleton).guess_convention(skeleton, pose.as_ref());
    let clip = guess.convention.file_clip_to_model(&clip);
    let anatomy = BodyAnatomy::detect_anatomy(clip.clip_skeleton()).with_clip(&clip);
    let name = path.file_stem().unwrap_or_default();
    Ok(Capture {
        name: name.to_string_lossy().into_owned(),
        clip,
        anatomy: Arc::new(anatomy),
    })
}

/// Reads a file, in its own unit and axes, and finds out whether its root's columns must be read in
/// another order.
fn build(path: &Path, fix: Option<ChannelFix>) -> Result<(Clip, Option<ChannelFix>)> {
    let mut reader = BvhReader::open_bvh(File::open(path)?)?;
    let rate = bvh_convert::rate_from_frame_time(reader.bvh_motion_header().frame_time.as_ref())?;
    let mut builder = ClipBuilder::new(reader.bvh_hierarchy(), fix)?;
    let mut block = MotionBlock::default();
    while reader.next_block(&mut block)? {
        builder.push_block_rows(0..block.frames, |at| block.columns.get(at));
    }
    let found = reader.finish_bvh_reading().root_fix;
    Ok((builder.finish_bvh_clip(rate)?, found))
}
