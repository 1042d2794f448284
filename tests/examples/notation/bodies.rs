//! Bodies from BVH files, signs from SiGML files.

use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use chereme_compose::Material;
use chereme_formats::bvh::convert::{self, ClipBuilder};
use chereme_formats::bvh::raw::{Block, ChannelFix, Decimal, Number, Reader, Writer};
use chereme_formats::{Finding, Severity};
use chereme_motion::{Anatomy, Clip};
use chereme_sign::Handedness;
use chereme_sign::hamnosys::Notated;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Reads the body of a BVH file as a stage: its first frame.
pub(crate) fn stage(path: &Path) -> Result<Material> {
    let whole = movement(path)?;
    Ok(Material {
        clip: whole.clip.slice(0..1),
        ..whole
    })
}

/// Reads a BVH file with all its frames.
pub(crate) fn movement(path: &Path) -> Result<Material> {
    let name = path.file_stem().unwrap_or_default();
    read(&name.to_string_lossy(), |fix| build(path, fix))
}

fn read(
    name: &str,
    build: impl Fn(Option<ChannelFix>) -> Result<(Clip, Option<ChannelFix>)>,
) -> Result<Material> {
    let clip = match build(None)? {
        (_, Some(fix)) => build(Some(fix))?.0,
        (clip, None) => clip,
    };
    let skeleton = clip.skeleton();
    let pose = (clip.frames() > 0).then(|| clip.model_pose(0));
    let guess = Anatomy::detect(skeleton).convention(skeleton, pose.as_ref());
    let clip = guess.convention.clip(&clip);
    let anatomy = Anatomy::detect(clip.skeleton()).with_clip(&clip);
    Ok(Material {
        curves: Vec::new(),
        address: name.to_owned(),
        hash: String::new(),
        gloss: String::new(),
        signer: None,
        handedness: Handedness::Right,
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
pub(crate) fn again(clip: &Clip, decimals: u8) -> Result<(Clip, Arc<Anatomy>)> {
    let hierarchy = convert::widened(&convert::hierarchy(clip.skeleton(), DECIMALS), clip);
    let channels = hierarchy.joints.iter().flat_map(|joint| &joint.channels);
    let [fine, coarse] = [DECIMALS, decimals].map(|n| convert::columns(clip, &hierarchy, n));
    let columns = channels.zip(fine?.into_iter().zip(coarse?));
    let columns = columns.map(|(channel, (fine, coarse))| match channel.is_rotation() {
        true => coarse,
        false => fine,
    });
    let columns = columns.collect();
    let time = Decimal::rounded(clip.rate().frame_time(), 9).map(Number::from);
    let motion = Some((time.as_ref(), clip.frames() as u64));
    let mut bytes = Vec::new();
    let mut writer = Writer::new(&mut bytes, &hierarchy, motion)?;
    let frames = clip.frames();
    writer.block(&Block {
        first_frame: 0,
        frames,
        columns,
    })?;
    writer.finish()?;
    let whole = read("again", |fix| from(bytes.as_slice(), fix))?;
    Ok((whole.clip, whole.anatomy))
}

fn build(path: &Path, fix: Option<ChannelFix>) -> Result<(Clip, Option<ChannelFix>)> {
    from(File::open(path)?, fix)
}

fn from(bytes: impl std::io::Read, fix: Option<ChannelFix>) -> Result<(Clip, Option<ChannelFix>)> {
    let mut reader = Reader::open(bytes)?;
    let rate = convert::rate(reader.header().frame_time.as_ref())?;
    let mut builder = ClipBuilder::new(reader.hierarchy(), fix)?;
    let mut block = Block::default();
    while reader.next_block(&mut block)? {
        builder.push(0..block.frames, |at| block.columns.get(at));
    }
    let found = reader.finish().root_fix;
    Ok((builder.finish(rate)?, found))
}

/// Reads every sign of a folder's SiGML files, in the order of their names, each with its file's.
pub(crate) fn signs(folder: &Path) -> Result<Vec<(String, Notated)>> {
    let all = signs_with_findings(folder)?.into_iter();
    Ok(all.map(|(name, notated, _)| (name, notated)).collect())
}

/// Like [`signs`], each with the number of warnings about its file.
pub(crate) fn signs_with_findings(folder: &Path) -> Result<Vec<(String, Notated, usize)>> {
    let mut paths: Vec<_> = std::fs::read_dir(folder)?
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<std::io::Result<_>>()?;
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "sigml"));
    paths.sort();
    let mut all = Vec::new();
    for path in paths {
        let name = path
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let (entries, findings) = chereme_formats::sigml::read(&std::fs::read(&path)?)?;
        let each = entries.into_iter();
        let warning = |it: &&Finding| it.severity == Severity::Warning;
        let warnings = findings.iter().filter(warning).count();
        all.extend(each.map(|entry| (name.clone(), entry.sign, warnings)));
    }
    Ok(all)
}
