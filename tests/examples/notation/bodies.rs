//! Bodies from BVH files, signs from SiGML files.

use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use chereme_compose::MovementMaterial;
use chereme_formats::bvh::bvh_convert::{self, ClipBuilder};
use chereme_formats::bvh::raw::{BvhReader, BvhWriter, ChannelFix, ExactDecimal, FileNumber, MotionBlock};
use chereme_formats::{FindingSeverity, ImportFinding};
use chereme_motion::{BodyAnatomy, Clip};
use chereme_sign::SignerHandedness;
use chereme_sign::hamnosys::NotatedSign;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Reads the body of a BVH file as a stage: its first frame.
pub(crate) fn stage(path: &Path) -> Result<MovementMaterial> {
    let whole = movement(path)?;
    Ok(MovementMaterial {
        clip: whole.clip.slice_clip_frames(0..1),
        ..whole
    })
}

/// Reads a BVH file with all its frames.
pub(crate) fn movement(path: &Path) -> Result<MovementMaterial> {
    let name = path.file_stem().unwrap_or_default();
    read(&name.to_string_lossy(), |fix| build(path, fix))
}

fn read(
    name: &str,
    build: impl Fn(Option<ChannelFix>) -> Result<(Clip, Option<ChannelFix>)>,
) -> Result<MovementMaterial> {
    let clip = match build(None)? {
        (_, Some(fix)) => build(Some(fix))?.0,
        (clip, None) => clip,
    };
    let skeleton = clip.clip_skeleton();
    let pose = (clip.clip_frame_count() > 0).then(|| clip.model_pose(0));
    let guess = BodyAnatomy::detect_anatomy(skeleton).guess_convention(skeleton, pose.as_ref());
    let clip = guess.convention.file_clip_to_model(&clip);
    let anatomy = BodyAnatomy::detect_anatomy(clip.clip_skeleton()).with_clip(&clip);
    Ok(MovementMaterial {
        curves: Vec::new(),
        address: name.to_owned(),
        hash: String::new(),
        gloss: String::new(),
        signer: None,
        handedness: SignerHandedness::Right,
        clip,
        anatomy: Arc::new(anatomy),
        held: Vec::new(),
    })
}

/// The decimals of numbers in exported files.
#[allow(dead_code, reason = "only the transcriber's example needs it")]
pub(crate) const DECIMALS: u8 = 6;

/// Writes a clip as BVH, its angles with `decimals` digits after the point, and reads it again, with the anatomy that
/// is found in it.
#[allow(dead_code, reason = "only the transcriber's example needs it")]
pub(crate) fn again(clip: &Clip, decimals: u8) -> Result<(Clip, Arc<BodyAnatomy>)> {
    let hierarchy = bvh_convert::widen_hierarchy(
        &bvh_convert::hierarchy_from_skeleton(clip.clip_skeleton(), DECIMALS),
        clip,
    );
    let channels = hierarchy.joints.iter().flat_map(|joint| &joint.channels);
    let [fine, coarse] = [DECIMALS, decimals].map(|n| bvh_convert::columns_from_clip(clip, &hierarchy, n));
    let columns = channels.zip(fine?.into_iter().zip(coarse?));
    let columns = columns.map(|(channel, (fine, coarse))| match channel.is_rotation() {
        true => coarse,
        false => fine,
    });
    let columns = columns.collect();
    let time = ExactDecimal::from_rounded_value(clip.clip_frame_rate().frame_time(), 9).map(FileNumber::from);
    let motion = Some((time.as_ref(), clip.clip_frame_count() as u64));
    let mut bytes = Vec::new();
    let mut writer = BvhWriter::new(&mut bytes, &hierarchy, motion)?;
    let frames = clip.clip_frame_count();
    writer.write_motion_block(&MotionBlock {
        first_frame: 0,
        frames,
        columns,
    })?;
    writer.finish_bvh_writing()?;
    let whole = read("again", |fix| from(bytes.as_slice(), fix))?;
    Ok((whole.clip, whole.anatomy))
}

fn build(path: &Path, fix: Option<ChannelFix>) -> Result<(Clip, Option<ChannelFix>)> {
    from(File::open(path)?, fix)
}

fn from(bytes: impl std::io::Read, fix: Option<ChannelFix>) -> Result<(Clip, Option<ChannelFix>)> {
    let mut reader = BvhReader::open_bvh(bytes)?;
    let rate = bvh_convert::rate_from_frame_time(reader.bvh_motion_header().frame_time.as_ref())?;
    let mut builder = ClipBuilder::new(reader.bvh_hierarchy(), fix)?;
    let mut block = MotionBlock::default();
    while reader.next_block(&mut block)? {
        builder.push_block_rows(0..block.frames, |at| block.columns.get(at));
    }
    let found = reader.finish_bvh_reading().root_fix;
    Ok((builder.finish_bvh_clip(rate)?, found))
}

/// Reads every sign of a folder's SiGML files, in the order of their names, each with its file's.
pub(crate) fn signs(folder: &Path) -> Result<Vec<(String, NotatedSign)>> {
    let all = signs_with_findings(folder)?.into_iter();
    Ok(all.map(|(name, notated, _)| (name, notated)).collect())
}

/// Like [`signs`], each with the number of warnings about its file.
pub(crate) fn signs_with_findings(folder: &Path) -> Result<Vec<(String, NotatedSign, usize)>> {
    let mut paths: Vec<_> = std::fs::read_dir(folder)?
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<std::io::Result<_>>()?;
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "sigml"));
    paths.sort();
    let mut all = Vec::new();
    for path in paths {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let (entries, findings) = chereme_formats::sigml::read_sigml_signs(&std::fs::read(&path)?)?;
        let each = entries.into_iter();
        let warning = |it: &&ImportFinding| it.severity == FindingSeverity::Warning;
        let warnings = findings.iter().filter(warning).count();
        all.extend(each.map(|entry| (name.clone(), entry.sign, warnings)));
    }
    Ok(all)
}
