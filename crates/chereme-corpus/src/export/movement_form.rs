//! Movement as another program needs it: on the bones of its avatars, at its frame rate, without leaving its place.

use std::ops::Range;

use chereme_compose::GeneratedCurve;
use chereme_formats::avatar_rig::{AvatarRig, RigError};
use chereme_motion::anatomy::AssignedJointRoles;
use chereme_motion::glam::DVec3;
use chereme_motion::{BodyAnatomy, BodyPart, Clip, FrameRate, Skeleton, SkeletonJoint};
use rusqlite::Connection;

use super::foreign::too_far;
use crate::curves;
use crate::error::{CorpusError, CorpusResult};
use crate::movement::{ChannelGroup, MotionTrack};

/// The highest frame rate that is written, which is above that of any capture.
const MAX_WRITTEN_RATE: f64 = 1000.0;
/// The number of decimals that count in a frame time from a typed rate.
const TYPED_RATE_DECIMALS: u32 = 6;
const CENTIMETRES_PER_METRE: f64 = 100.0;

/// The form in which movement is written.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MovementForm {
    /// The avatar whose bones move instead of those of the capture.
    pub rig: Option<AvatarRig>,
    /// The frame rate, unless that of the capture is kept.
    pub rate: Option<FrameRate>,
    /// Whether the hips stay above their first place.
    pub is_in_place: bool,
}

impl MovementForm {
    /// The form of the capture.
    pub const AS_CAPTURED: Self = Self {
        rig: None,
        rate: None,
        is_in_place: false,
    };

    /// Returns the names of the avatars that are known.
    pub fn avatar_names() -> impl Iterator<Item = &'static str> {
        AvatarRig::avatar_rig_names()
    }

    /// Reads the names of an avatar and a frame rate as a user states them: the avatar is one that is known, or the text
    /// of a table of bones.
    ///
    /// # Errors
    /// Fails if there is no such avatar, the table is wrong, or the rate is not between 0 and 1000 frames a second.
    pub fn read_movement_form(avatar: Option<&str>, rate: Option<f64>, is_in_place: bool) -> CorpusResult<Self> {
        let rig = match avatar {
            Some(text) if text.contains('{') => Some(AvatarRig::read_rig_table(text).map_err(|error| {
                CorpusError::from_wrong_message(error.to_string()).with_advice(
                    "a table has \"title\", \"sides\" such as [\"L\", \"R\"], and \"bones\", such as \"hips\": \"pelvis\" and \
                     \"upper arm\": \"arm.{side}\"",
                )
            })?),
            Some(name) => Some(AvatarRig::find_avatar_rig(name).ok_or_else(|| {
                let names: Vec<&str> = AvatarRig::avatar_rig_names().collect();
                CorpusError::from_wrong_message(format!("{name:?} is no skeleton that is known"))
                    .with_advice(format!(
                        "name one of {}, or a file with a table of bones",
                        names.join(", ")
                    ))
            })?),
            None => None,
        };
        let wrong_rate = |rate: f64| {
            CorpusError::from_wrong_message(format!("{rate} is no frame rate"))
                .with_advice("name frames a second, such as 30 or 29.97")
        };
        let rate = match rate {
            Some(rate) if rate > 0.0 && rate <= MAX_WRITTEN_RATE => {
                let exact = FrameRate::from_frame_time(1.0 / rate, TYPED_RATE_DECIMALS);
                Some(exact.map_err(|_| wrong_rate(rate))?)
            }
            Some(rate) => return Err(wrong_rate(rate)),
            None => None,
        };
        Ok(Self { rig, rate, is_in_place })
    }

    /// Reads frames of a track in this form; adds a note on bones that the body lacks.
    ///
    /// # Errors
    /// Fails if blocks are damaged, or the body does not fit on the avatar.
    pub(super) fn load_shaped_movement(
        &self,
        connection: &Connection,
        track: &MotionTrack,
        frames: Range<usize>,
        notes: &mut Vec<String>,
    ) -> CorpusResult<ShapedMovement> {
        let clip = track.read_motion_clip(connection, frames.clone(), &ChannelGroup::ALL_CHANNEL_GROUPS)?;
        let mut movement = ShapedMovement {
            anatomy: track.track_anatomy(connection)?,
            curves: curves::of_track(connection, track, frames)?,
            clip,
        };
        if let Some(rate) = self.rate {
            movement.change_frame_rate(rate);
        }
        if self.is_in_place {
            movement.clip = clip_in_place(movement.clip, &movement.anatomy);
        }
        if let Some(rig) = &self.rig {
            let rigged = rig
                .put_on_rig(&movement.clip, &movement.anatomy)
                .map_err(|error| match error {
                    RigError::TooFar(error) => too_far(&error),
                    RigError::NoPart(_) => CorpusError::from_wrong_message(error.to_string())
                        .with_command_advice("say which joint is what with `chereme track`, or leave --skeleton out")
                        .into_lacking_content(),
                })?;
            if !rigged.missing.is_empty() {
                notes.push(format!(
                    "the body lacks bones of {}: {}",
                    rig.title,
                    rigged.missing.join(", ")
                ));
            }
            let skeleton = rigged.clip.clip_skeleton();
            let named = rigged.joints.iter().zip(skeleton.skeleton_joints());
            let roles = named.filter_map(|(joint, bone)| Some((joint.as_ref()?.0, bone.name.clone())));
            movement.anatomy = BodyAnatomy::with_roles(skeleton, &AssignedJointRoles(roles.collect()))
                .map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
            movement.clip = rigged.clip;
        }
        Ok(movement)
    }
}

/// Movement in the form in which it is written, in metres of model space.
pub(super) struct ShapedMovement {
    pub(super) clip: Clip,
    pub(super) anatomy: BodyAnatomy,
    /// The curves of the face and of non-manuals, with a value for each frame.
    pub(super) curves: Vec<GeneratedCurve>,
}

impl ShapedMovement {
    fn change_frame_rate(&mut self, rate: FrameRate) {
        let before = self.clip.clip_frame_rate();
        self.clip = self.clip.resample_clip(rate);
        let frames = self.clip.clip_frame_count();
        for curve in &mut self.curves {
            let former = std::mem::take(&mut curve.values);
            let Some(last) = former.len().checked_sub(1) else {
                continue;
            };
            let sampled = (0..frames).map(|frame| {
                let seconds = rate.frame_start_instant(frame).instant_seconds();
                let position = (seconds * before.per_second()).clamp(0.0, last as f64);
                let (early, share) = (position.floor() as usize, position.fract());
                former[early] * (1.0 - share) + former[(early + 1).min(last)] * share
            });
            curve.values = sampled.collect();
        }
    }

    /// Returns the movement in centimetres, as programs that read BVH expect it.
    pub(super) fn clip_in_centimetres(&self) -> CorpusResult<Clip> {
        let joints = self.clip.clip_skeleton().skeleton_joints().iter();
        let joints = joints.map(|joint| SkeletonJoint {
            offset: joint.offset * CENTIMETRES_PER_METRE,
            tip: joint.tip.map(|tip| tip * CENTIMETRES_PER_METRE),
            ..joint.clone()
        });
        let mut channels = self.clip.joint_channels().to_vec();
        for place in channels
            .iter_mut()
            .filter_map(|channel| channel.translations.as_mut())
            .flatten()
        {
            *place *= CENTIMETRES_PER_METRE;
        }
        let fault = |error: String| CorpusError::from_wrong_message(error);
        let skeleton = Skeleton::new(joints.collect()).map_err(|error| fault(error.to_string()))?;
        Clip::new(skeleton.into(), self.clip.clip_frame_rate(), channels).map_err(|error| fault(error.to_string()))
    }
}

/// Returns a movement whose hips stay above their place in the first frame.
fn clip_in_place(clip: Clip, anatomy: &BodyAnatomy) -> Clip {
    let hips = clip.joint_path(anatomy.part_joint(BodyPart::Hips).unwrap_or(0));
    let (skeleton, rate) = (clip.clip_skeleton().clone(), clip.clip_frame_rate());
    let root = hips.iter().enumerate().map(|(frame, place)| {
        let moved = *place - hips[0];
        clip.joint_translation(0, frame) - DVec3::new(moved.x, 0.0, moved.z)
    });
    let root = root.collect();
    let mut channels = clip.into_channels();
    channels[0].translations = Some(root);
    Clip::new(skeleton, rate, channels).expect("only places of the root changed, to finite ones")
}
