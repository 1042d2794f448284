//! Movement during the evaluation of a recipe: a clip taken apart, with its annotations.

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{Anatomy, Channel, Clip, Instant, Part, Pose, Rate, Side, Skeleton, Span};
use chereme_sign::{Component, Handedness, Reading};

use crate::outcome::{About, Curve, Generated, Note};
use crate::sources::Material;

/// A clip under construction.
#[derive(Debug, Clone)]
pub(crate) struct Work {
    pub(crate) skeleton: Arc<Skeleton>,
    pub(crate) anatomy: Arc<Anatomy>,
    pub(crate) rate: Rate,
    pub(crate) frames: usize,
    pub(crate) channels: Vec<Channel>,
    pub(crate) handedness: Handedness,
    pub(crate) signer: Option<String>,
    pub(crate) notes: Vec<Note>,
    /// Scalar curves, each with a value per frame.
    pub(crate) curves: Vec<Curve>,
    /// Sources and operators of each channel of the body, in order.
    pub(crate) from: BTreeMap<Group, Vec<String>>,
}

/// A channel of the body: the joints that move together for one component on one side.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Group {
    Fingers(Side),
    Arm(Side),
    Head,
    Trunk,
    Legs,
}

impl Group {
    pub(crate) const ALL: [Self; 7] = [
        Self::Fingers(Side::Right),
        Self::Fingers(Side::Left),
        Self::Arm(Side::Right),
        Self::Arm(Side::Left),
        Self::Head,
        Self::Trunk,
        Self::Legs,
    ];

    pub(crate) fn name(self) -> String {
        match self {
            Self::Fingers(side) => format!("{} fingers", side.name()),
            Self::Arm(side) => format!("{} arm", side.name()),
            Self::Head => "head".into(),
            Self::Trunk => "trunk".into(),
            Self::Legs => "legs".into(),
        }
    }
}

/// Returns the group of each joint: that of the nearest part at or above it.
pub(crate) fn groups(skeleton: &Skeleton, anatomy: &Anatomy) -> Vec<Group> {
    let mut groups = Vec::with_capacity(skeleton.len());
    for joint in 0..skeleton.len() {
        let above = skeleton.parent(joint).map_or(Group::Trunk, |p| groups[p]);
        let is_hand = |side| anatomy.joint(Part::Hand(side)) == Some(joint);
        let group =
            match anatomy.part_of(joint) {
                Some(Part::Neck | Part::Head | Part::Jaw | Part::Eye(_)) => Group::Head,
                Some(
                    Part::Clavicle(side)
                    | Part::UpperArm(side)
                    | Part::Forearm(side)
                    | Part::Hand(side),
                ) => Group::Arm(side),
                Some(Part::Thumb(side, _) | Part::Finger(side, _, _)) => Group::Fingers(side),
                Some(Part::Thigh(_) | Part::Shin(_) | Part::Foot(_) | Part::Toes(_)) => Group::Legs,
                Some(Part::Hips | Part::Spine | Part::Chest) => Group::Trunk,
                None => match skeleton
                    .parent(joint)
                    .zip(Side::BOTH.into_iter().find(|&s| {
                        skeleton.parent(joint) == anatomy.joint(Part::Hand(s)) && !is_hand(s)
                    })) {
                    Some((_, side)) => Group::Fingers(side),
                    None => above,
                },
            };
        groups.push(group);
    }
    groups
}

impl Work {
    /// Takes a source's movement to work on.
    pub(crate) fn of(material: &Material) -> Self {
        let clip = &material.clip;
        let notes = std::iter::once(Note {
            hand: None,
            about: About::Gloss,
            value: Reading::Value(material.gloss.clone()),
            span: clip.span(),
            origin: material.address.clone(),
        });
        let held = material.held.iter().map(|held| Note {
            hand: held.hand,
            about: About::Component(held.component, held.feature.clone()),
            value: held.value.clone(),
            span: held.span,
            origin: material.address.clone(),
        });
        let source = || vec![material.address.clone()];
        Self {
            skeleton: Arc::clone(clip.skeleton()),
            anatomy: Arc::clone(&material.anatomy),
            rate: clip.rate(),
            frames: clip.frames(),
            notes: notes.chain(held).collect(),
            channels: clip.channels().to_vec(),
            handedness: material.handedness,
            signer: material.signer.clone(),
            curves: material.curves.clone(),
            from: Group::ALL
                .into_iter()
                .map(|group| (group, source()))
                .collect(),
        }
    }

    /// Takes movement that was generated from notation alone to work on.
    pub(crate) fn made(made: Generated, leaf: &str) -> Self {
        Self {
            skeleton: Arc::clone(made.clip.skeleton()),
            anatomy: made.anatomy,
            rate: made.clip.rate(),
            frames: made.clip.frames(),
            channels: made.clip.into_channels(),
            handedness: made.handedness,
            signer: made.signer,
            notes: made.notes,
            curves: made.curves,
            from: Group::ALL
                .into_iter()
                .map(|group| (group, vec![leaf.to_owned()]))
                .collect(),
        }
    }

    /// Returns the end of the movement.
    pub(crate) fn end(&self) -> Instant {
        self.rate.instant(self.frames)
    }

    /// Returns the whole time.
    pub(crate) fn span(&self) -> Span {
        self.rate.span(0..self.frames)
    }

    /// Returns the place of `joint` in its parent's space at `frame`.
    pub(crate) fn translation(&self, joint: usize, frame: usize) -> DVec3 {
        match &self.channels[joint].translations {
            Some(places) => places[frame],
            None => self.skeleton.joint(joint).offset,
        }
    }

    /// Returns the posture at `frame`, in local space.
    pub(crate) fn pose(&self, frame: usize) -> Pose {
        Pose {
            rotations: self.channels.iter().map(|c| c.rotations[frame]).collect(),
            translations: (0..self.channels.len())
                .map(|j| self.translation(j, frame))
                .collect(),
        }
    }

    /// Notes that `operator` changed the channels of `groups`.
    pub(crate) fn changed(&mut self, groups: impl IntoIterator<Item = Group>, operator: &str) {
        for group in groups {
            self.from
                .entry(group)
                .or_default()
                .push(operator.to_owned());
        }
    }

    /// Returns the spans in which `side` has values of `component`, in order of time, as indices of notes.
    pub(crate) fn held(&self, side: Side, component: Component) -> Vec<usize> {
        let about = About::Component(component, None);
        let mut found: Vec<usize> = (0..self.notes.len())
            .filter(|&n| {
                let note = &self.notes[n];
                note.hand == Some(side) && note.about == about && note.value.value().is_some()
            })
            .collect();
        found.sort_by_key(|&n| (self.notes[n].span.start(), self.notes[n].span.end()));
        found
    }

    /// Converts the movement to a clip.
    pub(crate) fn into_clip(self) -> Result<Clip, chereme_motion::ClipError> {
        Clip::new(self.skeleton, self.rate, self.channels)
    }
}

/// The positions and rotations of joints in model space over all frames, joint by joint.
pub(crate) struct Columns {
    positions: Vec<Option<Vec<DVec3>>>,
    rotations: Vec<Option<Vec<DQuat>>>,
}

impl Columns {
    /// Runs forward kinematics over `joints` and all joints above them.
    pub(crate) fn of(work: &Work, joints: impl IntoIterator<Item = usize>) -> Self {
        let len = work.skeleton.len();
        let mut wanted = vec![false; len];
        for joint in joints {
            for above in work.skeleton.ancestors(joint) {
                if std::mem::replace(&mut wanted[above], true) {
                    break;
                }
            }
        }
        let mut columns = Self {
            positions: vec![None; len],
            rotations: vec![None; len],
        };
        for joint in (0..len).filter(|&joint| wanted[joint]) {
            let channel = &work.channels[joint];
            let offset = work.skeleton.joint(joint).offset;
            let at = |frame: usize| channel.translations.as_ref().map_or(offset, |t| t[frame]);
            let (positions, rotations) = match work.skeleton.parent(joint) {
                None => (
                    (0..work.frames).map(at).collect(),
                    channel.rotations.clone(),
                ),
                Some(parent) => {
                    let (above, turned) = (columns.positions(parent), columns.rotations(parent));
                    let mut positions = Vec::with_capacity(work.frames);
                    let mut rotations = Vec::with_capacity(work.frames);
                    let local = above.iter().zip(turned).zip(&channel.rotations);
                    for (frame, ((above, turned), own)) in local.enumerate() {
                        positions.push(*above + *turned * at(frame));
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
    pub(crate) fn positions(&self, joint: usize) -> &[DVec3] {
        self.positions[joint]
            .as_deref()
            .expect("kinematics were run for this joint")
    }

    /// Returns the rotations of `joint`, one per frame.
    pub(crate) fn rotations(&self, joint: usize) -> &[DQuat] {
        self.rotations[joint]
            .as_deref()
            .expect("kinematics were run for this joint")
    }
}

impl Work {
    /// Resamples every channel: each entry gives the frame of the old movement for one new frame, interpolated if it is
    /// a fraction; the rate stays the same.
    pub(crate) fn sample(&mut self, at: &[f64]) {
        let last = (self.frames - 1) as f64;
        let between = |at: f64| {
            let at = at.clamp(0.0, last);
            let first = at.floor() as usize;
            (first, (first + 1).min(last as usize), at.fract())
        };
        for channel in &mut self.channels {
            let old = &channel.rotations;
            let new = at.iter().map(|&at| match between(at) {
                (first, _, 0.0) => old[first],
                (first, second, share) => old[first].slerp(old[second], share).normalize(),
            });
            let new: Vec<DQuat> = new.collect();
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
