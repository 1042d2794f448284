//! The movement of a recording: stored by channel group and block, read back in part.

use std::collections::BTreeMap;
use std::ops::Range;

use chereme_formats::bvh::convert::ClipBuilder;
use chereme_formats::bvh::raw::{ChannelFix, Column, Hierarchy};
use chereme_motion::anatomy::{Anatomy, Part, Roles};
use chereme_motion::ends::{Ends, OddFrames};
use chereme_motion::{Clip, Convention, Rate, Side, Skeleton, Span};
use rusqlite::Connection;

use crate::codec;
use crate::db::damaged;
use crate::db::motion::{self, BlockRow};
use crate::db::recipes;
use crate::db::recordings::{self, MotionTrackRow};
use crate::error::{Error, Result};

/// How many frames a block holds: long enough to be coded well, short enough to be read alone.
pub(crate) const BLOCK_FRAMES: usize = 512;

/// The joints that are stored together, so that one hand is read alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ChannelGroup {
    /// The joints below the right wrist.
    RightHand,
    /// The joints below the left wrist.
    LeftHand,
    /// From the right collar bone to the wrist.
    RightArm,
    /// From the left collar bone to the wrist.
    LeftArm,
    /// Neck, head and all above.
    Head,
    /// Everything else.
    Rest,
}

impl ChannelGroup {
    /// Every group.
    pub const ALL: [Self; 6] = [
        Self::RightHand,
        Self::LeftHand,
        Self::RightArm,
        Self::LeftArm,
        Self::Head,
        Self::Rest,
    ];

    /// Returns the name under which the group is stored.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::RightHand => "right-hand",
            Self::LeftHand => "left-hand",
            Self::RightArm => "right-arm",
            Self::LeftArm => "left-arm",
            Self::Head => "head",
            Self::Rest => "rest",
        }
    }
}

/// Which joints lie in which group.
pub(crate) fn channel_groups(
    skeleton: &Skeleton,
    anatomy: &Anatomy,
) -> BTreeMap<ChannelGroup, Vec<usize>> {
    let mut group = vec![ChannelGroup::Rest; skeleton.len()];
    let top = anatomy.joint(Part::Neck).or(anatomy.joint(Part::Head));
    let sides = [
        (Side::Right, ChannelGroup::RightArm, ChannelGroup::RightHand),
        (Side::Left, ChannelGroup::LeftArm, ChannelGroup::LeftHand),
    ];
    for joint in top.map(|top| skeleton.subtree(top)).unwrap_or_default() {
        group[joint] = ChannelGroup::Head;
    }
    for (side, arm, hand) in sides {
        for joint in anatomy.arm_joints(side) {
            group[joint] = arm;
        }
        for joint in anatomy.fingers(side) {
            group[joint] = hand;
        }
    }
    let mut groups = BTreeMap::new();
    for (joint, group) in group.into_iter().enumerate() {
        groups.entry(group).or_insert_with(Vec::new).push(joint);
    }
    groups
}

/// The motion track of a recording with all that is needed to read it.
pub(crate) struct Track {
    pub(crate) row: MotionTrackRow,
    pub(crate) hierarchy: Hierarchy,
    pub(crate) convention: Convention,
    pub(crate) rate: Rate,
    fix: Option<ChannelFix>,
    groups: BTreeMap<ChannelGroup, Vec<usize>>,
}

impl Track {
    /// Returns the motion track of a recording.
    pub(crate) fn of(connection: &Connection, recording: i64) -> Result<Self> {
        let Some(row) = recordings::motion_track(connection, recording)? else {
            let name = recordings::recording(connection, recording)?.name;
            return Err(
                Error::wrong(format!("the recording {name:?} holds no movement"))
                    .at(name)
                    .advise("import the motion file of the same name"),
            );
        };
        let place = format!("track {}", row.id);
        let bad = |what: &str| damaged(place.clone(), format!("its {what} cannot be read"));
        let document = recordings::skeleton_document(connection, row.skeleton_id)?;
        let hierarchy: Hierarchy = serde_json::from_str(&document).map_err(|_| bad("skeleton"))?;
        let named: BTreeMap<String, Vec<usize>> =
            serde_json::from_str(&row.channel_groups).map_err(|_| bad("channel groups"))?;
        let groups: BTreeMap<ChannelGroup, Vec<usize>> = ChannelGroup::ALL
            .into_iter()
            .filter_map(|group| Some((group, named.get(group.name())?.clone())))
            .collect();
        let joints = hierarchy.joints.len();
        if groups.values().flatten().any(|&joint| joint >= joints) {
            return Err(bad("channel groups"));
        }
        let fix = match row.root_order.as_deref() {
            None => None,
            Some("rotation-before-position") => Some(ChannelFix::RotationBeforePosition),
            Some(_) => return Err(bad("order of the root's columns")),
        };
        Ok(Self {
            convention: Convention {
                metres_per_unit: row.metres_per_unit,
                axes: row.axes.parse().map_err(|_| bad("axes"))?,
            },
            rate: Rate::new(row.rate_frames, row.rate_seconds).map_err(|_| bad("frame rate"))?,
            hierarchy,
            fix,
            groups,
            row,
        })
    }

    /// Returns how many frames there are.
    pub(crate) fn frames(&self) -> usize {
        usize::try_from(self.row.frames).unwrap_or_default()
    }

    /// Returns which columns of the file a group's joints have.
    pub(crate) fn columns_of(&self, group: ChannelGroup) -> Vec<usize> {
        columns_of(
            &self.hierarchy,
            self.groups.get(&group).map_or(&[], Vec::as_slice),
        )
    }

    /// Returns the frames that start in `span`.
    pub(crate) fn frames_in(&self, span: Span) -> Range<usize> {
        let frames = self.rate.frames_in(span.shifted(-self.row.offset_us));
        frames.start.min(self.frames())..frames.end.min(self.frames())
    }

    /// Calls `take` with the columns of whole blocks that hold any of `frames`, group by group.
    ///
    /// It is given the columns' numbers in the file, the first frame of the block, and its columns.
    pub(crate) fn blocks(
        &self,
        connection: &Connection,
        groups: &[ChannelGroup],
        frames: &Range<usize>,
        mut take: impl FnMut(&[usize], usize, Vec<Column>) -> Result<()>,
    ) -> Result<()> {
        for &group in groups {
            let columns = self.columns_of(group);
            motion::blocks(connection, self.row.id, group.name(), frames, |block| {
                let BlockRow {
                    first_frame,
                    frames,
                    data,
                    hash,
                } = block;
                if frames > BLOCK_FRAMES {
                    return Err(damaged(
                        format!("block {}", motion::hex(&hash)),
                        "it is too long",
                    ));
                }
                let decoded = codec::decode(&data, frames, columns.len());
                let decoded = decoded
                    .map_err(|reason| damaged(format!("block {}", motion::hex(&hash)), reason))?;
                take(&columns, first_frame, decoded)
            })?;
        }
        Ok(())
    }

    /// Returns the movement of `frames` in metres and model space; joints of groups that are not
    /// asked for stay at rest.
    pub(crate) fn clip(
        &self,
        connection: &Connection,
        frames: Range<usize>,
        groups: &[ChannelGroup],
    ) -> Result<Clip> {
        let frames = frames.start.min(self.frames())..frames.end.min(self.frames());
        let mut blocks: BTreeMap<usize, BTreeMap<usize, Column>> = BTreeMap::new();
        self.blocks(connection, groups, &frames, |numbers, first, columns| {
            let block = blocks.entry(first).or_default();
            block.extend(numbers.iter().copied().zip(columns));
            Ok(())
        })?;
        let place = || format!("track {}", self.row.id);
        let mut builder = ClipBuilder::new(&self.hierarchy, self.fix)
            .map_err(|error| damaged(place(), error.to_string()))?;
        let mut next = frames.start;
        for (first, columns) in &blocks {
            let length = columns
                .values()
                .next()
                .map_or(0, |column| column.mantissas.len());
            let rows = next.saturating_sub(*first)..(frames.end - first).min(length);
            if *first > next || rows.is_empty() {
                return Err(damaged(place(), format!("frame {next} is missing")));
            }
            next = first + rows.end;
            builder.push(rows, |at| columns.get(&at));
        }
        if next < frames.end && self.hierarchy.channel_count() > 0 {
            return Err(damaged(place(), format!("frame {next} is missing")));
        }
        let clip = builder
            .finish(self.rate)
            .map_err(|error| damaged(place(), error.to_string()))?;
        let clip = match self.row.root_scale {
            None => clip,
            Some(scale) => scale_root(clip, scale),
        };
        Ok(self.convention.clip(&clip))
    }

    /// Returns what the skeleton's joints are, measured where the recording begins; made movement has the body of
    /// what it was made from, measured there.
    pub(crate) fn anatomy(&self, connection: &Connection) -> Result<Anatomy> {
        let first = self.clip(connection, 0..self.head(), &ChannelGroup::ALL)?;
        let roles = self.row.roles.as_deref().map(str::parse::<Roles>);
        let place = format!("track {}", self.row.id);
        let roles = roles
            .transpose()
            .map_err(|error| damaged(place.clone(), error.to_string()))?
            .unwrap_or_default();
        let anatomy = Anatomy::with_roles(first.skeleton(), &roles)
            .map_err(|error| damaged(place, error.to_string()))?;
        if anatomy.is_posed() {
            return Ok(anatomy);
        }
        let own = self.row.recording_id;
        let body = recipes::body_of(connection, own, self.row.skeleton_id)?;
        let Some(body) = body.filter(|body| *body != own) else {
            return Ok(standing(anatomy, &first));
        };
        let body = Self::of(connection, body)?;
        let body = body.clip(connection, 0..body.head(), &ChannelGroup::ALL)?;
        let same = body.skeleton() == first.skeleton();
        Ok(standing(anatomy, if same { &body } else { &first }))
    }

    /// Returns how many frames from the first on are looked at for odd ones.
    fn head(&self) -> usize {
        let frames = (ENDS * self.rate.per_second()).ceil() as usize;
        frames.clamp(1, BLOCK_FRAMES).min(self.frames().max(1))
    }

    /// Returns the odd frames at both ends of the recording.
    pub(crate) fn odd_frames(
        &self,
        connection: &Connection,
        anatomy: &Anatomy,
    ) -> Result<Vec<OddFrames>> {
        let (all, part) = (self.frames(), 4 * self.head());
        let look = |frames: Range<usize>| -> Result<Vec<OddFrames>> {
            let from = frames.start;
            let clip = self.clip(connection, frames, &ChannelGroup::ALL)?;
            let mut odd = Ends::of(&clip, anatomy).odd;
            for odd in &mut odd {
                odd.frames = odd.frames.start + from..odd.frames.end + from;
            }
            Ok(odd)
        };
        if all <= 2 * part {
            return look(0..all);
        }
        let mut odd = look(0..part)?;
        odd.retain(|odd| odd.frames.end < part);
        let tail = look(all - part..all)?;
        odd.extend(tail.into_iter().filter(|odd| odd.frames.start > all - part));
        Ok(odd)
    }
}

/// Measures an anatomy in the first frame that is not odd, where the rest pose is none that a body takes.
pub(crate) fn standing(anatomy: Anatomy, head: &Clip) -> Anatomy {
    if anatomy.is_posed() || head.frames() == 0 {
        return anatomy;
    }
    let first = anatomy.clone().with_clip(head);
    match Ends::of(head, &first).sound.start {
        0 => first,
        sound => anatomy.with_reference(head.skeleton(), &head.model_pose(sound)),
    }
}

/// How long odd frames at an end of a recording may be and still be found for measuring, in seconds.
const ENDS: f64 = 2.5;

/// Returns the clip with the root's places multiplied.
fn scale_root(clip: Clip, scale: f64) -> Clip {
    let (skeleton, rate) = (clip.skeleton().clone(), clip.rate());
    let mut channels = clip.clone().into_channels();
    for at in channels[0].translations.iter_mut().flatten() {
        *at *= scale;
    }
    Clip::new(skeleton, rate, channels).unwrap_or(clip)
}

/// Returns which columns of a file those joints have.
pub(crate) fn columns_of(hierarchy: &Hierarchy, joints: &[usize]) -> Vec<usize> {
    let ranges = hierarchy.columns();
    joints
        .iter()
        .filter_map(|&joint| ranges.get(joint).cloned())
        .flatten()
        .collect()
}

/// Stores `frames` frames of columns from `first_frame` on, group by group.
pub(crate) fn store_block(
    connection: &Connection,
    track: i64,
    groups: &[(ChannelGroup, Vec<usize>)],
    first_frame: usize,
    frames: usize,
    columns: &[Column],
) -> Result<()> {
    for (group, numbers) in groups {
        let own: Vec<&Column> = numbers.iter().filter_map(|&at| columns.get(at)).collect();
        if !own.is_empty() {
            let data = codec::encode(frames, &own);
            motion::insert_block(connection, track, group.name(), first_frame, frames, &data)?;
        }
    }
    Ok(())
}
