//! Bodies from BVH files, signs from SiGML files.

use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use chereme_compose::Material;
use chereme_formats::bvh::convert::{self, ClipBuilder};
use chereme_formats::bvh::raw::{Block, ChannelFix, Reader};
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
    let clip = match build(path, None)? {
        (_, Some(fix)) => build(path, Some(fix))?.0,
        (clip, None) => clip,
    };
    let skeleton = clip.skeleton();
    let pose = (clip.frames() > 0).then(|| clip.model_pose(0));
    let guess = Anatomy::detect(skeleton).convention(skeleton, pose.as_ref());
    let clip = guess.convention.clip(&clip);
    let anatomy = Anatomy::detect(clip.skeleton()).with_clip(&clip);
    let name = path.file_stem().unwrap_or_default();
    Ok(Material {
        curves: Vec::new(),
        address: name.to_string_lossy().into_owned(),
        hash: String::new(),
        gloss: String::new(),
        signer: None,
        handedness: Handedness::Right,
        clip,
        anatomy: Arc::new(anatomy),
        held: Vec::new(),
    })
}

fn build(path: &Path, fix: Option<ChannelFix>) -> Result<(Clip, Option<ChannelFix>)> {
    let mut reader = Reader::open(File::open(path)?)?;
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
        let (entries, _) = chereme_formats::sigml::read(&std::fs::read(&path)?)?;
        all.extend(entries.into_iter().map(|entry| (name.clone(), entry.sign)));
    }
    Ok(all)
}
