//! Movement during the evaluation of a recipe: a clip taken apart, with its annotations.

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{
    BodyAnatomy, BodyPart, BodySide, Clip, FrameRate, JointChannel, LocalPose, RecordingInstant, Skeleton, TimeSpan,
};
use chereme_sign::{ComponentReading, SignComponent, SignerHandedness};

use crate::outcome::{GeneratedCurve, GeneratedMovement, GeneratedNote, NoteSubject};
use crate::sources::MovementMaterial;

/// A clip under construction.
#[derive(Debug, Clone)]
pub(crate) struct WorkingClip {
    pub(crate) skeleton: Arc<Skeleton>,
    pub(crate) anatomy: Arc<BodyAnatomy>,
    pub(crate) rate: FrameRate,
    pub(crate) frames: usize,
    pub(crate) channels: Vec<JointChannel>,
    pub(crate) handedness: SignerHandedness,
    pub(crate) signer: Option<String>,
    pub(crate) notes: Vec<GeneratedNote>,
    /// Scalar curves, each with a value per frame.
    pub(crate) curves: Vec<GeneratedCurve>,
    /// Sources and operators of each channel of the body, in order.
    pub(crate) from: BTreeMap<JointGroup, Vec<String>>,
}

/// A channel of the body: the joints that move together for one component on one side.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum JointGroup {
    Fingers(BodySide),
    Arm(BodySide),
    Head,
    Trunk,
    Legs,
}

impl JointGroup {
    pub(crate) const ALL_JOINT_GROUPS: [Self; 7] = [
        Self::Fingers(BodySide::Right),
        Self::Fingers(BodySide::Left),
        Self::Arm(BodySide::Right),
        Self::Arm(BodySide::Left),
        Self::Head,
        Self::Trunk,
        Self::Legs,
    ];

    pub(crate) fn joint_group_name(self) -> String {
        match self {
            Self::Fingers(side) => format!("{} fingers", side.body_side_name()),
            Self::Arm(side) => format!("{} arm", side.body_side_name()),
            Self::Head => "head".into(),
            Self::Trunk => "trunk".into(),
            Self::Legs => "legs".into(),
        }
    }
}

/// Returns the group of each joint: that of the nearest part at or above it.
pub(crate) fn find_joint_groups(skeleton: &Skeleton, anatomy: &BodyAnatomy) -> Vec<JointGroup> {
    let mut groups = Vec::with_capacity(skeleton.len());
    for joint in 0..skeleton.len() {
        let above = skeleton.joint_parent(joint).map_or(JointGroup::Trunk, |p| groups[p]);
        let is_hand = |side| anatomy.part_joint(BodyPart::Hand(side)) == Some(joint);
        let group = match anatomy.part_of(joint) {
            Some(BodyPart::Neck | BodyPart::Head | BodyPart::Jaw | BodyPart::Eye(_)) => JointGroup::Head,
            Some(
                BodyPart::Clavicle(side) | BodyPart::UpperArm(side) | BodyPart::Forearm(side) | BodyPart::Hand(side),
            ) => JointGroup::Arm(side),
            Some(BodyPart::Thumb(side, _) | BodyPart::Finger(side, _, _)) => JointGroup::Fingers(side),
            Some(BodyPart::Thigh(_) | BodyPart::Shin(_) | BodyPart::Foot(_) | BodyPart::Toes(_)) => JointGroup::Legs,
            Some(BodyPart::Hips | BodyPart::Spine | BodyPart::Chest) => JointGroup::Trunk,
            None => match skeleton.joint_parent(joint).zip(
                BodySide::BOTH_SIDES
                    .into_iter()
                    .find(|&s| skeleton.joint_parent(joint) == anatomy.part_joint(BodyPart::Hand(s)) && !is_hand(s)),
            ) {
                Some((_, side)) => JointGroup::Fingers(side),
                None => above,
            },
        };
        groups.push(group);
    }
    groups
}

impl WorkingClip {
    /// Takes a source's movement to work on.
    pub(crate) fn working_clip_from(material: &MovementMaterial) -> Self {
        let clip = &material.clip;
        let notes = std::iter::once(GeneratedNote {
            hand: None,
            about: NoteSubject::Gloss,
            value: ComponentReading::Value(material.gloss.clone()),
            span: clip.clip_span(),
            origin: material.address.clone(),
        });
        let held_notes = material.held.iter().map(|held| GeneratedNote {
            hand: held.hand,
            about: NoteSubject::Component(held.component, held.feature.clone()),
            value: held.value.clone(),
            span: held.span,
            origin: material.address.clone(),
        });
        let source = || vec![material.address.clone()];
        Self {
            skeleton: Arc::clone(clip.clip_skeleton()),
            anatomy: Arc::clone(&material.anatomy),
            rate: clip.clip_frame_rate(),
            frames: clip.clip_frame_count(),
            notes: notes.chain(held_notes).collect(),
            channels: clip.joint_channels().to_vec(),
            handedness: material.handedness,
            signer: material.signer.clone(),
            curves: material.curves.clone(),
            from: JointGroup::ALL_JOINT_GROUPS
                .into_iter()
                .map(|group| (group, source()))
                .collect(),
        }
    }

    /// Takes movement that was generated from notation alone to work on.
    pub(crate) fn from_generated_movement(made: GeneratedMovement, leaf: &str) -> Self {
        Self {
            skeleton: Arc::clone(made.clip.clip_skeleton()),
            anatomy: made.anatomy,
            rate: made.clip.clip_frame_rate(),
            frames: made.clip.clip_frame_count(),
            channels: made.clip.into_channels(),
            handedness: made.handedness,
            signer: made.signer,
            notes: made.notes,
            curves: made.curves,
            from: JointGroup::ALL_JOINT_GROUPS
                .into_iter()
                .map(|group| (group, vec![leaf.to_owned()]))
                .collect(),
        }
    }

    /// Returns the end of the movement.
    pub(crate) fn working_clip_end(&self) -> RecordingInstant {
        self.rate.frame_start_instant(self.frames)
    }

    /// Returns the whole time.
    pub(crate) fn working_clip_span(&self) -> TimeSpan {
        self.rate.frame_range_span(0..self.frames)
    }

    /// Returns the place of `joint` in its parent's space at `frame`.
    pub(crate) fn joint_translation_at(&self, joint: usize, frame: usize) -> DVec3 {
        match &self.channels[joint].translations {
            Some(places) => places[frame],
            None => self.skeleton.joint_at(joint).offset,
        }
    }

    /// Returns the posture at `frame`, in local space.
    pub(crate) fn local_pose_at(&self, frame: usize) -> LocalPose {
        LocalPose {
            rotations: self.channels.iter().map(|c| c.rotations[frame]).collect(),
            translations: (0..self.channels.len())
                .map(|j| self.joint_translation_at(j, frame))
                .collect(),
        }
    }

    /// Notes that `operator` changed the channels of `groups`.
    pub(crate) fn note_changed_groups(&mut self, groups: impl IntoIterator<Item = JointGroup>, operator: &str) {
        for group in groups {
            self.from.entry(group).or_default().push(operator.to_owned());
        }
    }

    /// Returns the spans in which `side` has values of `component`, in order of time, as indices of notes.
    pub(crate) fn held_note_indices(&self, side: BodySide, component: SignComponent) -> Vec<usize> {
        let about = NoteSubject::Component(component, None);
        let mut component_notes: Vec<usize> = (0..self.notes.len())
            .filter(|&n| {
                let note = &self.notes[n];
                note.hand == Some(side) && note.about == about && note.value.reading_value().is_some()
            })
            .collect();
        component_notes.sort_by_key(|&n| {
            (
                self.notes[n].span.span_start_instant(),
                self.notes[n].span.span_end_instant(),
            )
        });
        component_notes
    }

    /// Converts the movement to a clip.
    pub(crate) fn into_clip(self) -> Result<Clip, chereme_motion::ClipError> {
        Clip::new(self.skeleton, self.rate, self.channels)
    }
}

/// The positions and rotations of joints in model space over all frames, joint by joint.
pub(crate) struct JointColumns {
    positions: Vec<Option<Vec<DVec3>>>,
    rotations: Vec<Option<Vec<DQuat>>>,
}

impl JointColumns {
    /// Runs forward kinematics over `joints` and all joints above them.
    pub(crate) fn joint_columns_of(work: &WorkingClip, joints: impl IntoIterator<Item = usize>) -> Self {
        let len = work.skeleton.len();
        let mut wanted = vec![false; len];
        for joint in joints {
            for above in work.skeleton.joint_ancestors(joint) {
                // Above a joint that is wanted all are.
                if std::mem::replace(&mut wanted[above], true) {
                    break;
                }
            }
        }
        let mut columns = Self {
            positions: vec![None; len],
            rotations: vec![None; len],
        };
        // Parents come first in a skeleton, so that each finds its parent done.
        for joint in (0..len).filter(|&joint| wanted[joint]) {
            let channel = &work.channels[joint];
            let offset = work.skeleton.joint_at(joint).offset;
            let joint_translation = |frame: usize| channel.translations.as_ref().map_or(offset, |t| t[frame]);
            let (positions, rotations) = match work.skeleton.joint_parent(joint) {
                None => (
                    (0..work.frames).map(joint_translation).collect(),
                    channel.rotations.clone(),
                ),
                Some(parent) => {
                    let (above, turned) = (columns.joint_positions(parent), columns.joint_rotations(parent));
                    let mut positions = Vec::with_capacity(work.frames);
                    let mut rotations = Vec::with_capacity(work.frames);
                    let local = above.iter().zip(turned).zip(&channel.rotations);
                    for (frame, ((above, turned), own)) in local.enumerate() {
                        positions.push(*above + *turned * joint_translation(frame));
                        rotations.push(*turned * *own);
                    }
                    (positions, rotations)
                }
            };
            columns.positions[joint] = Some(positions);
            columns.rotations[joint] = Some(rotations);
        }
        columns
    }

    /// Returns the positions of `joint`, one per frame.
    pub(crate) fn joint_positions(&self, joint: usize) -> &[DVec3] {
        self.positions[joint]
            .as_deref()
            .expect("kinematics were run for this joint")
    }

    /// Returns the rotations of `joint`, one per frame.
    pub(crate) fn joint_rotations(&self, joint: usize) -> &[DQuat] {
        self.rotations[joint]
            .as_deref()
            .expect("kinematics were run for this joint")
    }
}

impl WorkingClip {
    /// Resamples every channel: each entry gives the frame of the old movement for one new frame, interpolated if it is
    /// a fraction; the rate stays the same.
    pub(crate) fn resample_channels(&mut self, at: &[f64]) {
        let last = (self.frames - 1) as f64;
        let between = |at: f64| {
            let position = at.clamp(0.0, last);
            let first = position.floor() as usize;
            (first, (first + 1).min(last as usize), position.fract())
        };
        for channel in &mut self.channels {
            let old = &channel.rotations;
            let new_rotations = at.iter().map(|&at| match between(at) {
                // Whole frames stay bit for bit as they were captured.
                (first, _, 0.0) => old[first],
                (first, second, share) => old[first].slerp(old[second], share).normalize(),
            });
            let new: Vec<DQuat> = new_rotations.collect();
            if let Some(places) = &mut channel.translations {
                let moved = at.iter().map(|&at| {
                    let (first, second, share) = between(at);
                    places[first].lerp(places[second], share)
                });
                *places = moved.collect();
            }
            channel.rotations = new;
        }
        for curve in &mut self.curves {
            let old = &curve.values;
            let value = |&at: &f64| {
                let (first, second, share) = between(at);
                old[first] + (old[second] - old[first]) * share
            };
            let new = at.iter().map(value).collect();
            curve.values = new;
        }
        self.frames = at.len();
    }
}
