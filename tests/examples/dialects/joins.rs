//! Movement of one dialect on the body of another: the paths of hips and feet where two captures are joined, and the
//! directions of feet and thumbs.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use chereme_compose::on_body;
use chereme_corpus::{
    Corpus, DisplayedMovement, ImportOptions, ProgressReceiver, RecombinationResult, ignore_progress_step,
};
use chereme_motion::glam::DVec3;
use chereme_motion::{BodyAnatomy, BodyPart, BodySide, Clip, ModelPose, Skeleton};
use chereme_sign::SignerHandedness;

use crate::Result;
use crate::dialect::{self, Dialect};
use crate::read;
use crate::rig::{self, Staged};

/// The largest distances at a join, in metres.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct JoinMeasure {
    /// From the straight line between the last place of the hips in the first piece and the first one in the second.
    pub(crate) hips: f64,
    /// Of the lower foot from its usual height in the first piece.
    pub(crate) floor: f64,
    /// The number of joins that are refused.
    pub(crate) refused: usize,
}

impl JoinMeasure {
    fn of_join(made: &RecombinationResult) -> Result<Self> {
        let clip = &made.clip;
        let transition = made.notes.iter().find(|note| note.about == "transition");
        let transition = transition.ok_or("the recipe has no transition")?;
        let frame = |us: i64| (us as f64 / 1e6 * clip.clip_frame_rate().per_second()).round() as usize;
        let (leave, enter) = (frame(transition.start_us) - 1, frame(transition.end_us));
        let joint = |part| made.anatomy.part_joint(part).ok_or("a part is not found");
        let hips = joint(BodyPart::Hips)?;
        let feet = [BodyPart::Foot(BodySide::Right), BodyPart::Foot(BodySide::Left)].map(joint);
        let feet = [feet[0]?, feet[1]?];
        let models: Vec<ModelPose> = (0..clip.clip_frame_count()).map(|n| clip.model_pose(n)).collect();
        let (start, end) = (
            models[leave].model_joint_position(hips),
            models[enter].model_joint_position(hips),
        );
        let off = |model: &ModelPose| {
            let own = model.model_joint_position(hips) - start;
            let line = end - start;
            let share = own.dot(line) / line.length_squared().max(1e-12);
            (own - line * share.clamp(0.0, 1.0)).length()
        };
        let height = |model: &ModelPose| {
            let [right, left] = feet.map(|foot| model.model_joint_position(foot).y);
            right.min(left)
        };
        let mut first: Vec<f64> = models[..=leave].iter().map(height).collect();
        first.sort_by(f64::total_cmp);
        let usual = first[first.len() / 2];
        let most = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
        Ok(Self {
            hips: most(&mut models[leave..=enter].iter().map(off)),
            floor: most(&mut models.iter().map(|model| (height(model) - usual).abs())),
            refused: 0,
        })
    }

    fn larger(self, other: Self) -> Self {
        Self {
            hips: self.hips.max(other.hips),
            floor: self.floor.max(other.floor),
            refused: self.refused + other.refused,
        }
    }
}

/// Joins every capture to every other one, or in dialects with a name other than `plain` only to those beside it: within
/// each dialect, and between that dialect and the captures as they are. Returns the largest distances for each dialect.
pub(crate) fn worst_joins(
    captures: &[PathBuf],
    dialects: &[Dialect],
    folder: &Path,
) -> Result<Vec<(&'static str, JoinMeasure)>> {
    let mut sources = Vec::new();
    for (n, capture) in captures.iter().enumerate() {
        sources.push(read::import(folder, &format!("capture{n}"), capture)?);
    }
    let mut rows = Vec::new();
    for dialect in dialects {
        let name = dialect.name;
        let mut corpus = Corpus::create_corpus(&folder.join(format!("{name}-joins.chereme")), name)?;
        let mut files = Vec::new();
        for (capture, source) in captures.iter().zip(&sources) {
            let staged = Staged {
                clip: source.moving.clip.clone(),
                frames: Vec::new(),
            };
            let stem = capture.file_stem().unwrap_or_default().to_string_lossy();
            let path = folder.join(format!("{name}-{stem}.bvh"));
            rig::write(&source.moving, &staged, dialect, &path)?;
            files.push(path);
        }
        for file in files.iter().chain(captures) {
            let mut hear = ignore_progress_step;
            let options = ImportOptions::default();
            corpus.import_paths(
                std::slice::from_ref(file),
                &options,
                &mut ProgressReceiver::new(&mut hear),
            )?;
        }
        let count = captures.len();
        let is_beside = |one: usize, other: usize| [1, count - 1].contains(&one.abs_diff(other));
        let pairs = (1..=count).flat_map(|one| (1..=count).map(move |other| (one, other)));
        let pairs: Vec<(usize, usize)> = pairs
            .filter(|&(one, other)| one != other && (name == "plain" || is_beside(one, other)))
            .collect();
        rows.push((name, worst_join(&mut corpus, &pairs, count)?));
    }
    Ok(rows)
}

/// Returns the largest distances at the joins of pairs in a corpus that holds `count` recordings in a dialect, then the same
/// as they are.
fn worst_join(corpus: &mut Corpus, pairs: &[(usize, usize)], count: usize) -> Result<JoinMeasure> {
    let mut worst = JoinMeasure::default();
    for &(one, other) in pairs {
        for (first, second) in [(one, other), (one, count + other), (count + one, other)] {
            let recipe = format!("(recording:{first} | trim) then (recording:{second} | trim)");
            match corpus.preview_recipe(&recipe) {
                Ok(made) => worst = worst.larger(JoinMeasure::of_join(&made)?),
                Err(_) => worst.refused += 1,
            }
        }
    }
    Ok(worst)
}

/// The body of a dialect, and a few frames of movement on it.
struct DialectBody {
    name: &'static str,
    clip: Clip,
    anatomy: Arc<BodyAnatomy>,
}

/// The number of frames in which bones are compared.
const FRAMES: usize = 4;

impl DialectBody {
    fn with_frames(name: &'static str, moving: &DisplayedMovement) -> Result<Self> {
        let clip = &moving.clip;
        let last = clip.clip_frame_count() - 1;
        let poses = (1..=FRAMES).map(|n| clip.clip_pose_at(n * last / FRAMES));
        let poses: Vec<_> = poses.collect();
        Ok(Self {
            name,
            clip: Clip::from_poses(clip.clip_skeleton().clone(), clip.clip_frame_rate(), &poses)?,
            anatomy: Arc::new(moving.anatomy.clone()),
        })
    }

    /// Returns the largest angle by which a bone of foot or thumb points elsewhere on another body, and its name.
    fn turned_on(&self, other: &Self) -> Result<(f64, String)> {
        let made = on_body(
            &self.clip,
            &self.anatomy,
            SignerHandedness::Right,
            other.clip.clip_skeleton(),
            &other.anatomy,
        )?;
        let mut worst = (0.0, String::new());
        for frame in 0..FRAMES {
            let before = bones(self.clip.clip_skeleton(), &self.anatomy, &self.clip.model_pose(frame));
            let after = bones(other.clip.clip_skeleton(), &other.anatomy, &made.clip.model_pose(frame));
            for (part, bone) in &before {
                let same = after.iter().find(|(other, _)| other == part);
                let angle = same.map_or(0.0, |(_, other)| bone.angle_between(*other));
                if angle > worst.0 {
                    worst = (angle, part.to_string());
                }
            }
        }
        Ok(worst)
    }
}

/// Puts the movement of each dialect on the body of each; returns the names of both, the largest angle by which a bone of
/// foot or thumb is turned away, in radians, and the bone.
pub(crate) fn turned_bones(capture: &Path, folder: &Path) -> Result<Vec<TurnedBone>> {
    let source = read::import(folder, "staged", capture)?;
    let staged = rig::staged(&source.moving)?;
    let mut bodies = Vec::new();
    for dialect in dialect::all() {
        let path = folder.join(format!("{}-staged.bvh", dialect.name));
        rig::write(&source.moving, &staged, &dialect, &path)?;
        let moving = read::import(folder, &format!("{}-staged", dialect.name), &path)?;
        bodies.push(DialectBody::with_frames(dialect.name, &moving.moving)?);
    }
    let mut all = Vec::new();
    for from in &bodies {
        for onto in &bodies {
            let (angle, part) = from.turned_on(onto)?;
            all.push((from.name, onto.name, angle, part));
        }
    }
    Ok(all)
}

/// The names of two dialects, an angle in radians, and the name of a part.
type TurnedBone = (&'static str, &'static str, f64, String);

/// Returns the directions of the bones of feet and thumbs in model space.
fn bones(skeleton: &Skeleton, anatomy: &BodyAnatomy, model: &ModelPose) -> Vec<(BodyPart, DVec3)> {
    let mut bones = Vec::new();
    for side in BodySide::BOTH_SIDES {
        let foot = [BodyPart::Foot(side), BodyPart::Toes(side)];
        let thumb = [0, 1, 2].map(|n| BodyPart::Thumb(side, n));
        for chain in [&foot[..], &thumb[..]] {
            let joints: Vec<(BodyPart, usize)> = chain
                .iter()
                .filter_map(|&part| Some((part, anatomy.part_joint(part)?)))
                .collect();
            for (n, &(part, joint)) in joints.iter().enumerate() {
                let below = skeleton.joint_children(joint);
                let end = match joints.get(n + 1) {
                    Some(&(_, next)) => Some(model.model_joint_position(next)),
                    None => match (anatomy.joint_tip(skeleton, joint), below) {
                        (Some(tip), _) => Some(model.joint_point_to_model(joint, tip)),
                        (None, [child]) => Some(model.model_joint_position(*child)),
                        _ => None,
                    },
                };
                let bone = end.and_then(|end| (end - model.model_joint_position(joint)).try_normalize());
                bones.extend(bone.map(|bone| (part, bone)));
            }
        }
    }
    bones
}
