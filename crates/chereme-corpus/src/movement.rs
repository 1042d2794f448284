//! The movement of a recording: stored by channel group and block, so that parts of it can be read.

use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use chereme_formats::bvh::convert::ClipBuilder;
use chereme_formats::bvh::raw::{ChannelFix, Column, Hierarchy, Number};
use chereme_motion::anatomy::{Anatomy, Part, Roles};
use chereme_motion::clip::Channel;
use chereme_motion::column::{Column as Numbers, Numbers as Form};
use chereme_motion::ends::{Ends, OddFrames};
use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{Clip, Convention, Joint, Rate, Side, Skeleton, Span};
use chereme_sign::Remedy;
use rusqlite::Connection;
use serde::{Deserialize, Serialize};

use crate::address::Stretch;
use crate::codec;
use crate::db::damaged;
use crate::db::motion::{self, BlockRow};
use crate::db::recipes;
use crate::db::recordings::{self, MotionTrackRow};
use crate::db::tracks;
use crate::error::{Error, Result};

/// The number of frames in a block: enough for good compression, few enough to be read alone.
pub(crate) const BLOCK_FRAMES: usize = 512;

/// Joints that are stored together, so that for example one hand can be read alone.
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
    /// Neck, head and everything above.
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

/// Returns the joints of each group.
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

/// The column layout of a skeleton track that did not come from a BVH file: the unit quaternion of every joint (x, y,
/// z, w), followed by the position in the parent's space for joints that move.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Layout {
    rotations: RotationForm,
    /// The joints with changing positions.
    moving: Vec<usize>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum RotationForm {
    Quaternion,
}

impl Layout {
    /// Returns the layout of a clip.
    pub(crate) fn of(clip: &Clip) -> Self {
        let moves = |joint: &usize| clip.channel(*joint).translations.is_some();
        Self {
            rotations: RotationForm::Quaternion,
            moving: (0..clip.skeleton().len()).filter(moves).collect(),
        }
    }

    /// Returns how many columns a joint has.
    fn width(&self, joint: usize) -> usize {
        if self.moving.binary_search(&joint).is_ok() {
            7
        } else {
            4
        }
    }

    /// Returns the columns of a joint.
    pub(crate) fn columns(&self, clip: &Clip, joint: usize) -> Vec<Numbers> {
        let channel = clip.channel(joint);
        let turned = |axis: usize| {
            channel
                .rotations
                .iter()
                .map(|q| q.to_array()[axis])
                .collect()
        };
        let mut columns: Vec<Numbers> = (0..4).map(|axis| Numbers::doubles(turned(axis))).collect();
        if let Some(places) = &channel.translations {
            let moved = |axis: usize| places.iter().map(|at| at[axis]).collect();
            columns.extend((0..3).map(|axis| Numbers::doubles(moved(axis))));
        }
        columns
    }

    /// Appends the frames `rows` of a joint's columns to its channel.
    fn push(&self, channel: &mut Channel, columns: &[&Numbers], rows: Range<usize>) -> Option<()> {
        let value = |axis: usize, row: usize| columns.get(axis)?.value(row);
        for row in rows {
            let [x, y, z, w] = [
                value(0, row)?,
                value(1, row)?,
                value(2, row)?,
                value(3, row)?,
            ];
            channel.rotations.push(DQuat::from_xyzw(x, y, z, w));
            if let Some(places) = &mut channel.translations {
                places.push(DVec3::new(value(4, row)?, value(5, row)?, value(6, row)?));
            }
        }
        Some(())
    }
}

/// The rest rotations in a skeleton's document.
#[derive(Deserialize)]
struct Rests {
    joints: Vec<Rest>,
}

#[derive(Deserialize)]
struct Rest {
    rest: Option<[f64; 4]>,
}

/// Returns the skeleton of a document, whose joints may have rest rotations.
fn skeleton_of(hierarchy: &Hierarchy, document: &str) -> Option<Skeleton> {
    let plain = chereme_formats::bvh::convert::skeleton(hierarchy).ok()?;
    let rests: Rests = serde_json::from_str(document).ok()?;
    let joints = plain.joints().iter().zip(rests.joints);
    let joints = joints.map(|(joint, rest)| Joint {
        rest: rest.rest.map_or(DQuat::IDENTITY, DQuat::from_array),
        ..joint.clone()
    });
    Skeleton::new(joints.collect()).ok()
}

/// The motion track of a recording, with everything needed to read it.
pub(crate) struct MotionTrack {
    pub(crate) row: MotionTrackRow,
    pub(crate) hierarchy: Hierarchy,
    pub(crate) convention: Convention,
    pub(crate) rate: Rate,
    fix: Option<ChannelFix>,
    groups: BTreeMap<ChannelGroup, Vec<usize>>,
    /// The layout of its numbers and its skeleton, if it did not come from a BVH file.
    exact: Option<(Layout, Arc<Skeleton>)>,
    /// Finger bones that are impossibly long, with their usual lengths in metres.
    long_bones: OnceCell<Vec<(usize, f64)>>,
}

/// Returns the error for a recording without movement.
pub(crate) fn no_movement(recording: &str) -> Error {
    Error::wrong(format!("the recording {recording:?} holds no movement"))
        .at(recording)
        .advise(Remedy::command(
            "import the motion file of the same name; movement is made from markers by `chereme fit CORPUS RECORDING`",
        ))
        .lacking()
}

impl MotionTrack {
    /// Returns the motion track of a recording's body.
    pub(crate) fn of(connection: &Connection, recording: i64) -> Result<Self> {
        let Some(row) = recordings::body_track(connection, recording)? else {
            let name = recordings::recording(connection, recording)?.name;
            return Err(no_movement(&name));
        };
        Self::read(connection, row)
    }

    /// Returns the motion track of that row.
    pub(crate) fn of_row(connection: &Connection, track: i64) -> Result<Self> {
        let row = recordings::skeleton_track(connection, track)?;
        let place = format!("track {track}");
        Self::read(
            connection,
            row.ok_or_else(|| damaged(place, "it holds no movement"))?,
        )
    }

    fn read(connection: &Connection, row: MotionTrackRow) -> Result<Self> {
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
        let exact = match tracks::form(connection, row.id)?.layout {
            None => None,
            Some(text) => {
                let layout = serde_json::from_str(&text).map_err(|_| bad("layout"))?;
                let skeleton = skeleton_of(&hierarchy, &document).ok_or_else(|| bad("skeleton"))?;
                Some((layout, Arc::new(skeleton)))
            }
        };
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
            exact,
            row,
            long_bones: OnceCell::new(),
        })
    }

    /// Returns the number of frames.
    pub(crate) fn frames(&self) -> usize {
        usize::try_from(self.row.frames).unwrap_or_default()
    }

    /// Returns the joint roles that a person set.
    pub(crate) fn roles(&self) -> Option<Roles> {
        self.row.roles.as_deref()?.parse().ok()
    }

    /// Returns whether the numbers came from a BVH file, so that they can be written unchanged.
    pub(crate) fn is_of_bvh(&self) -> bool {
        self.exact.is_none()
    }

    /// Returns the frame time that the file stated, if it did.
    ///
    /// # Errors
    /// Fails if the stored one is no number.
    pub(crate) fn frame_time(&self) -> Result<Option<Number>> {
        let stored = self.row.frame_time.as_deref();
        let time = stored.map(str::parse::<Number>).transpose();
        time.map_err(|_| Error::wrong("the stored frame time is no number"))
    }

    /// Returns the columns of the file for a group's joints.
    pub(crate) fn columns_of(&self, group: ChannelGroup) -> Vec<usize> {
        let joints = self.groups.get(&group).map_or(&[][..], Vec::as_slice);
        let Some((layout, _)) = &self.exact else {
            return columns_of(&self.hierarchy, joints);
        };
        let first = |joint: usize| (0..joint).map(|it| layout.width(it)).sum::<usize>();
        let own = |&joint: &usize| first(joint)..first(joint) + layout.width(joint);
        joints.iter().flat_map(own).collect()
    }

    /// Returns the frames of a stretch: those of a token, or all of a recording.
    pub(crate) fn frames_of(&self, stretch: &Stretch) -> Range<usize> {
        match stretch.token {
            Some(_) => self.frames_in(stretch.span),
            None => 0..self.frames(),
        }
    }

    /// Returns the frames that start within `span`.
    pub(crate) fn frames_in(&self, span: Span) -> Range<usize> {
        let frames = self.rate.frames_in(span.shifted(-self.row.offset_us));
        frames.start.min(self.frames())..frames.end.min(self.frames())
    }

    /// Calls `take` with the columns of complete blocks that contain any of `frames`, group by group.
    ///
    /// `take` receives the indices of the columns in the file, the first frame of the block, and the columns.
    pub(crate) fn blocks(
        &self,
        connection: &Connection,
        groups: &[ChannelGroup],
        frames: &Range<usize>,
        mut take: impl FnMut(&[usize], usize, Vec<Numbers>) -> Result<()>,
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

    /// Returns the movement of `frames` in metres and model space; joints of groups that are not requested stay at
    /// rest. Finger bones that are impossibly long have their usual length.
    pub(crate) fn clip(
        &self,
        connection: &Connection,
        frames: Range<usize>,
        groups: &[ChannelGroup],
    ) -> Result<Clip> {
        let clip = self.raw(connection, frames, groups)?;
        let clip = self.convention.clip(&clip);
        let long_bones = self.long_bones.get_or_init(|| {
            let roles = self.roles().unwrap_or_default();
            let anatomy = Anatomy::with_roles(clip.skeleton(), &roles);
            anatomy.map_or_else(|_| Vec::new(), |it| it.long_finger_bones(clip.skeleton()))
        });
        Ok(draw_in(clip, long_bones))
    }

    /// Returns the movement of `frames` in the file's unit and axes.
    pub(crate) fn raw_clip(&self, connection: &Connection, frames: Range<usize>) -> Result<Clip> {
        self.raw(connection, frames, &ChannelGroup::ALL)
    }

    fn raw(
        &self,
        connection: &Connection,
        frames: Range<usize>,
        groups: &[ChannelGroup],
    ) -> Result<Clip> {
        let frames = frames.start.min(self.frames())..frames.end.min(self.frames());
        let mut blocks: BTreeMap<usize, BTreeMap<usize, Numbers>> = BTreeMap::new();
        self.blocks(connection, groups, &frames, |numbers, first, columns| {
            let block = blocks.entry(first).or_default();
            block.extend(numbers.iter().copied().zip(columns));
            Ok(())
        })?;
        if let Some((layout, skeleton)) = &self.exact {
            return self.exact_clip(layout, skeleton, &blocks, frames);
        }
        let place = || format!("track {}", self.row.id);
        let mut decimals: BTreeMap<usize, BTreeMap<usize, Column>> = BTreeMap::new();
        for (first, columns) in blocks {
            let plain = columns
                .into_iter()
                .map(|(at, column)| match column.into_numbers() {
                    Form::Decimals(decimals) => Ok((at, decimals)),
                    other => {
                        let reason = format!("its numbers are {}, not decimals", other.form());
                        Err(damaged(place(), reason))
                    }
                });
            decimals.insert(first, plain.collect::<Result<_>>()?);
        }
        let blocks = decimals;
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
        Ok(match self.row.root_scale {
            None => clip,
            Some(scale) => scale_root(clip, scale),
        })
    }

    /// Returns the clip for columns of quaternions and positions; joints whose columns were not read stay at rest.
    fn exact_clip(
        &self,
        layout: &Layout,
        skeleton: &Arc<Skeleton>,
        blocks: &BTreeMap<usize, BTreeMap<usize, Numbers>>,
        frames: Range<usize>,
    ) -> Result<Clip> {
        let bad = |reason: String| damaged(format!("track {}", self.row.id), reason);
        let mut next = frames.start;
        let mut parts = Vec::new();
        for (first, columns) in blocks {
            let length = columns.values().next().map_or(0, Numbers::len);
            let rows = next.saturating_sub(*first)..(frames.end - first).min(length);
            if *first > next || rows.is_empty() {
                return Err(bad(format!("frame {next} is missing")));
            }
            next = first + rows.end;
            parts.push((columns, rows));
        }
        if next < frames.end {
            return Err(bad(format!("frame {next} is missing")));
        }
        let mut from = 0;
        let mut channels = Vec::with_capacity(skeleton.len());
        for (joint, at) in skeleton.joints().iter().enumerate() {
            let width = layout.width(joint);
            let own = from..from + width;
            from += width;
            let mut channel = Channel {
                rotations: Vec::with_capacity(frames.len()),
                translations: (width > 4).then(Vec::new),
            };
            for (columns, rows) in &parts {
                let found: Option<Vec<&Numbers>> = own.clone().map(|it| columns.get(&it)).collect();
                let Some(found) = found else {
                    channel.rotations.extend(rows.clone().map(|_| at.rest));
                    if let Some(places) = &mut channel.translations {
                        places.extend(rows.clone().map(|_| at.offset));
                    }
                    continue;
                };
                layout
                    .push(&mut channel, &found, rows.clone())
                    .ok_or_else(|| bad(format!("joint {:?} has a gap", at.name)))?;
            }
            channels.push(channel);
        }
        Clip::new(Arc::clone(skeleton), self.rate, channels).map_err(|error| bad(error.to_string()))
    }

    /// Returns the body parts of the skeleton's joints, measured at the beginning of the recording; for generated
    /// movement, measured at the beginning of the recording that provided its body.
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

    /// Returns the number of initial frames that are searched for odd ones.
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
        let read = |frames: Range<usize>| self.clip(connection, frames, &ChannelGroup::ALL);
        if all <= 2 * part {
            return Ok(Ends::of(&read(0..all)?, anatomy).odd);
        }
        let hips = anatomy.joint(Part::Hips).unwrap_or(0);
        let above = |joint: &usize| self.hierarchy.joints[*joint].parent;
        let carriers: Vec<usize> = std::iter::successors(Some(hips), above).collect();
        let mut groups = ChannelGroup::ALL.to_vec();
        groups.retain(|group| {
            let joints = self.groups.get(group).into_iter().flatten();
            joints.into_iter().any(|joint| carriers.contains(joint))
        });
        let mut path = Vec::with_capacity(all);
        for start in (0..all).step_by(BLOCK_FRAMES) {
            let frames = start..(start + BLOCK_FRAMES).min(all);
            let clip = self.clip(connection, frames, &groups)?;
            path.extend(clip.path(hips));
        }
        Ok(Ends::of_long_take(&path, part, anatomy, read)?.odd)
    }
}

/// Measures an anatomy in the first ordinary frame, if no body can assume the rest pose.
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

/// The longest run of odd frames at an end of a recording that is skipped for measuring, in seconds.
const ENDS: f64 = 2.5;

/// Returns the clip with the root's positions multiplied.
fn scale_root(clip: Clip, scale: f64) -> Clip {
    let (skeleton, rate) = (clip.skeleton().clone(), clip.rate());
    let mut channels = clip.clone().into_channels();
    for at in channels[0].translations.iter_mut().flatten() {
        *at *= scale;
    }
    Clip::new(skeleton, rate, channels).unwrap_or(clip)
}

/// Returns the clip with bones of other lengths: joints, and the lengths in metres of the bones that end in them.
fn draw_in(clip: Clip, bones: &[(usize, f64)]) -> Clip {
    if bones.is_empty() {
        return clip;
    }
    let mut joints = clip.skeleton().joints().to_vec();
    let mut channels = clip.channels().to_vec();
    for &(joint, length) in bones {
        let share = length / joints[joint].offset.length();
        joints[joint].offset *= share;
        for place in channels[joint].translations.iter_mut().flatten() {
            *place *= share;
        }
    }
    let drawn = Skeleton::new(joints).ok();
    let drawn = drawn.and_then(|it| Clip::new(Arc::new(it), clip.rate(), channels).ok());
    drawn.unwrap_or(clip)
}

/// Returns the columns of a file for those joints.
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
