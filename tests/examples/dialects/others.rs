//! Table of the handshapes read from other people's captures: of each hand at its straightest, and at rest.

use std::path::{Path, PathBuf};

use chereme_corpus::{CorpusAddress, RowName};
use chereme_motion::{BodySide, HandAngles, HandCorrection};

use crate::Result;
use crate::read::{known, known_distance, shapes};

/// The number of frames of a capture that are read.
const FRAMES: usize = 400;

/// The head of the table.
pub(crate) const HEAD: &str = "
## Hands of other people's captures

For each hand with fingers: the nearest handshape and its residual at the moment at which the fingers are straightest, and in
the middle posture of the take, as the file has the angles and as they are read (against the signer's own range). *Residual* is
the root of the mean square of all angles that the skeleton shows. A hand whose fingers move by less than 10° over the whole
take is *still*: its file holds one posture, and nothing shows where that signer's fingers are straight.

| capture | hand | angles | movement | straightest as in the file | straightest as read | middle as read | fingers bent |
|---|---|--:|--:|---|---|---|--:|
";

/// Returns the captures below a folder that may have fingers.
fn captures(folder: &Path, found: &mut Vec<PathBuf>) {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    for path in entries.map(|entry| entry.path()) {
        let ending = path.extension().unwrap_or_default().to_string_lossy();
        if path.is_dir() {
            captures(&path, found);
        } else if ["bvh", "fbx", "glb", "gltf"].contains(&ending.as_ref()) {
            found.push(path);
        }
    }
    found.sort();
}

/// Returns the rows of all captures below the folder of shared data.
pub(crate) fn rows(data: &Path) -> Result<String> {
    let mut files = Vec::new();
    captures(&data.join("motion"), &mut files);
    let mut text = String::new();
    for file in files {
        let own = tempfile::tempdir()?;
        let Ok(corpus) = crate::corpus_of(own.path(), "capture", &file) else {
            continue;
        };
        let name = RowName::Number(1);
        let Ok(moving) = corpus.movement_at_address(&CorpusAddress::Recording(name.clone())) else {
            continue;
        };
        let corrections = corpus.hand_corrections(&name)?;
        for (side, correction) in BodySide::BOTH_SIDES.into_iter().zip(corrections) {
            if moving.anatomy.has_fingers(side)
                && let Some(row) = row(&file, &moving, side, correction)
            {
                text += &row;
            }
        }
    }
    Ok(text)
}

/// Returns the mean flexion of all finger joints in degrees.
fn bent(angles: &HandAngles) -> f64 {
    let all = angles.fingers.iter().flat_map(|finger| finger.flexion);
    all.map(f64::abs).sum::<f64>().to_degrees() / 12.0
}

fn row(
    file: &Path,
    moving: &chereme_corpus::DisplayedMovement,
    side: BodySide,
    correction: HandCorrection,
) -> Option<String> {
    let clip = &moving.clip;
    let known = known(&moving.anatomy, side);
    let step = clip.clip_frame_count().div_ceil(FRAMES).max(1);
    let read = |frame: usize| {
        let pose = clip.clip_pose_at(frame);
        moving.anatomy.hand_angles(clip.clip_skeleton(), side, &pose)
    };
    let raw: Vec<HandAngles> = (0..clip.clip_frame_count()).step_by(step).filter_map(read).collect();
    let straightest = raw.iter().min_by(|a, b| bent(a).total_cmp(&bent(b)))?;
    let middle = median(&raw);
    let moves = (0..HandAngles::HAND_ANGLE_COUNT)
        .filter(|angle| known[*angle])
        .map(|angle| {
            let values = raw.iter().map(|it| it.to_array()[angle]);
            let (low, high) = values.fold((f64::MAX, f64::MIN), |(low, high), it| (low.min(it), high.max(it)));
            high - low
        })
        .fold(0.0, f64::max)
        .to_degrees();
    let named = |angles: &HandAngles| {
        let far = |shape: &(String, HandAngles)| known_distance(&shape.1, angles, &known);
        let shapes = shapes();
        let near = shapes.iter().min_by(|a, b| far(a).total_cmp(&far(b)))?;
        Some(format!("{} {:.0}°", near.0, far(near).to_degrees()))
    };
    let count = known.iter().filter(|known| **known).count();
    let moved = match moves < 10.0 {
        true => "still".to_owned(),
        false => format!("{moves:.0}°"),
    };
    Some(format!(
        "| `{}` | {} | {count} | {moved} | {} | {} | {} | {:.0}° |\n",
        file.file_name()?.to_string_lossy(),
        side.body_side_name(),
        named(straightest)?,
        named(&correction.correct_hand_angles(straightest))?,
        named(&correction.correct_hand_angles(&middle))?,
        bent(&correction.correct_hand_angles(straightest))
    ))
}

/// Returns the median of each angle.
fn median(all: &[HandAngles]) -> HandAngles {
    HandAngles::from_array(std::array::from_fn(|angle| {
        let mut values: Vec<f64> = all.iter().map(|it| it.to_array()[angle]).collect();
        values.sort_by(f64::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or_default()
    }))
}
