//! The movement of a recording: stored by channel group and block, so that parts of it can be read.

use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use chereme_formats::bvh::bvh_convert::ClipBuilder;
use chereme_formats::bvh::raw::{BvhHierarchy, ChannelFix, Column, FileNumber};
use chereme_motion::anatomy::{AssignedJointRoles, BodyAnatomy, BodyPart};
use chereme_motion::clip::JointChannel;
use chereme_motion::column::{ColumnNumbers as Form, FrameNumberColumn as Numbers};
use chereme_motion::ends::{ClipEnds, OddFrames};
use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{BodySide, Clip, FrameRate, Skeleton, SkeletonJoint, SpaceConvention, TimeSpan};
use rusqlite::Connection;
use serde::{Deserialize, Serialize};

use crate::address::RecordingStretch;
use crate::codec;
use crate::db::damaged_row_error;
use crate::db::recipes;
use crate::db::stored_motion::{self, BlockRow};
use crate::db::stored_recordings::{self, MotionTrackRow};
use crate::db::stored_tracks;
use crate::error::{CorpusError, CorpusResult};

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
    pub const ALL_CHANNEL_GROUPS: [Self; 6] = [
        Self::RightHand,
        Self::LeftHand,
        Self::RightArm,
        Self::LeftArm,
        Self::Head,
        Self::Rest,
    ];

    /// Returns the name under which the group is stored.
    #[must_use]
    pub fn channel_group_name(self) -> &'static str {
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
pub(crate) fn channel_groups(skeleton: &Skeleton, anatomy: &BodyAnatomy) -> BTreeMap<ChannelGroup, Vec<usize>> {
    let mut group = vec![ChannelGroup::Rest; skeleton.len()];
    let top = anatomy
        .part_joint(BodyPart::Neck)
        .or(anatomy.part_joint(BodyPart::Head));
    let sides = [
        (BodySide::Right, ChannelGroup::RightArm, ChannelGroup::RightHand),
        (BodySide::Left, ChannelGroup::LeftArm, ChannelGroup::LeftHand),
    ];
    // Arms and hands come after the head, as collar bones may lie above the neck joint.
    for joint in top.map(|top| skeleton.joint_subtree(top)).unwrap_or_default() {
        group[joint] = ChannelGroup::Head;
    }
    for (side, arm, hand) in sides {
        for joint in anatomy.arm_joints(side) {
            group[joint] = arm;
        }
        // Fingers come last: they lie below the arm's joints.
        for joint in anatomy.finger_joints(side) {
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
pub(crate) struct TrackColumnLayout {
    rotations: RotationForm,
    /// The joints with changing positions.
    moving: Vec<usize>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum RotationForm {
    Quaternion,
}

impl TrackColumnLayout {
    /// Returns the layout of a clip.
    pub(crate) fn from_clip_columns(clip: &Clip) -> Self {
        let moves = |joint: &usize| clip.joint_channel(*joint).translations.is_some();
        Self {
            rotations: RotationForm::Quaternion,
            moving: (0..clip.clip_skeleton().len()).filter(moves).collect(),
        }
    }

    /// Returns how many columns a joint has.
    fn joint_column_count(&self, joint: usize) -> usize {
        // Four numbers of a quaternion, and three of a position.
        if self.moving.binary_search(&joint).is_ok() {
            7
        } else {
            4
        }
    }

    /// Returns the columns of a joint.
    pub(crate) fn joint_columns(&self, clip: &Clip, joint: usize) -> Vec<Numbers> {
        let channel = clip.joint_channel(joint);
        let turned = |axis: usize| channel.rotations.iter().map(|q| q.to_array()[axis]).collect();
        let mut columns: Vec<Numbers> = (0..4).map(|axis| Numbers::from_double_floats(turned(axis))).collect();
        if let Some(places) = &channel.translations {
            let moved = |axis: usize| places.iter().map(|at| at[axis]).collect();
            columns.extend((0..3).map(|axis| Numbers::from_double_floats(moved(axis))));
        }
        columns
    }

    /// Appends the frames `rows` of a joint's columns to its channel.
    fn append_joint_rows(&self, channel: &mut JointChannel, columns: &[&Numbers], rows: Range<usize>) -> Option<()> {
        let value = |axis: usize, row: usize| columns.get(axis)?.column_value_at(row);
        for row in rows {
            let [x, y, z, w] = [value(0, row)?, value(1, row)?, value(2, row)?, value(3, row)?];
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
struct RestRotations {
    joints: Vec<JointRest>,
}

#[derive(Deserialize)]
struct JointRest {
    rest: Option<[f64; 4]>,
}

/// Returns the skeleton of a document, whose joints may have rest rotations.
fn skeleton_of(hierarchy: &BvhHierarchy, document: &str) -> Option<Skeleton> {
    let plain = chereme_formats::bvh::bvh_convert::skeleton_from_hierarchy(hierarchy).ok()?;
    let rests: RestRotations = serde_json::from_str(document).ok()?;
    let joint_rests = plain.skeleton_joints().iter().zip(rests.joints);
    let joints = joint_rests.map(|(joint, rest)| SkeletonJoint {
        rest: rest.rest.map_or(DQuat::IDENTITY, DQuat::from_array),
        ..joint.clone()
    });
    Skeleton::new(joints.collect()).ok()
}

/// The motion track of a recording, with everything needed to read it.
pub(crate) struct MotionTrack {
    pub(crate) row: MotionTrackRow,
    pub(crate) hierarchy: BvhHierarchy,
    pub(crate) convention: SpaceConvention,
    pub(crate) rate: FrameRate,
    fix: Option<ChannelFix>,
    pub(crate) groups: BTreeMap<ChannelGroup, Vec<usize>>,
    /// The layout of its numbers and its skeleton, if it did not come from a BVH file.
    exact: Option<(TrackColumnLayout, Arc<Skeleton>)>,
    /// Finger bones that are impossibly long, with their usual lengths in metres.
    long_bones: OnceCell<Vec<(usize, f64)>>,
}

/// Returns the error for a recording without movement.
pub(crate) fn no_movement(recording: &str) -> CorpusError {
    CorpusError::from_wrong_message(format!("the recording {recording:?} holds no movement"))
        .with_error_place(recording)
        .with_command_advice(
            "import the motion file of the same name; movement is made from markers by `chereme fit CORPUS RECORDING`",
        )
        .into_lacking_content()
}

impl MotionTrack {
    /// Returns the motion track of a recording's body.
    pub(crate) fn open_motion_track(connection: &Connection, recording: i64) -> CorpusResult<Self> {
        let Some(row) = stored_recordings::body_track(connection, recording)? else {
            let name = stored_recordings::load_recording_row(connection, recording)?.name;
            return Err(no_movement(&name));
        };
        Self::read_motion_track(connection, row)
    }

    /// Returns the motion track of that row.
    pub(crate) fn of_row(connection: &Connection, track: i64) -> CorpusResult<Self> {
        let row = stored_recordings::skeleton_track(connection, track)?;
        let place = format!("track {track}");
        Self::read_motion_track(
            connection,
            row.ok_or_else(|| damaged_row_error(place, "it holds no movement"))?,
        )
    }

    fn read_motion_track(connection: &Connection, row: MotionTrackRow) -> CorpusResult<Self> {
        let place = format!("track {}", row.id);
        let bad = |what: &str| damaged_row_error(place.clone(), format!("its {what} cannot be read"));
        let document = stored_recordings::skeleton_document(connection, row.skeleton_id)?;
        let hierarchy: BvhHierarchy = serde_json::from_str(&document).map_err(|_| bad("skeleton"))?;
        let named: BTreeMap<String, Vec<usize>> =
            serde_json::from_str(&row.channel_groups).map_err(|_| bad("channel groups"))?;
        let groups: BTreeMap<ChannelGroup, Vec<usize>> = ChannelGroup::ALL_CHANNEL_GROUPS
            .into_iter()
            .filter_map(|group| Some((group, named.get(group.channel_group_name())?.clone())))
            .collect();
        let joints = hierarchy.joints.len();
        // Numbers of joints come from the file; a wrong one must not reach the arrays below.
        if groups.values().flatten().any(|&joint| joint >= joints) {
            return Err(bad("channel groups"));
        }
        let exact = match stored_tracks::load_track_form(connection, row.id)?.layout {
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
            convention: SpaceConvention {
                metres_per_unit: row.metres_per_unit,
                axes: row.axes.parse().map_err(|_| bad("axes"))?,
            },
            rate: FrameRate::new(row.rate_frames, row.rate_seconds).map_err(|_| bad("frame rate"))?,
            hierarchy,
            fix,
            groups,
            exact,
            row,
            long_bones: OnceCell::new(),
        })
    }

    /// Returns the number of frames.
    pub(crate) fn motion_frame_count(&self) -> usize {
        usize::try_from(self.row.frames).unwrap_or_default()
    }

    /// Returns the joint roles that a person set.
    pub(crate) fn manual_joint_roles(&self) -> Option<AssignedJointRoles> {
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
    pub(crate) fn frame_time(&self) -> CorpusResult<Option<FileNumber>> {
        let stored = self.row.frame_time.as_deref();
        let time = stored.map(str::parse::<FileNumber>).transpose();
        time.map_err(|_| CorpusError::from_wrong_message("the stored frame time is no number"))
    }

    /// Returns the columns of the file for a group's joints.
    pub(crate) fn columns_of(&self, group: ChannelGroup) -> Vec<usize> {
        let joints = self.groups.get(&group).map_or(&[][..], Vec::as_slice);
        let Some((layout, _)) = &self.exact else {
            return columns_of(&self.hierarchy, joints);
        };
        let first = |joint: usize| (0..joint).map(|index| layout.joint_column_count(index)).sum::<usize>();
        let joint_columns = |&joint: &usize| first(joint)..first(joint) + layout.joint_column_count(joint);
        joints.iter().flat_map(joint_columns).collect()
    }

    /// Returns the frames of a stretch: those of a token, or all of a recording.
    pub(crate) fn stretch_frames(&self, stretch: &RecordingStretch) -> Range<usize> {
        match stretch.token {
            Some(_) => self.frames_in(stretch.span),
            None => 0..self.motion_frame_count(),
        }
    }

    /// Returns the frames that start within `span`.
    pub(crate) fn frames_in(&self, span: TimeSpan) -> Range<usize> {
        let frames = self.rate.frames_in(span.shifted_span(-self.row.offset_us));
        frames.start.min(self.motion_frame_count())..frames.end.min(self.motion_frame_count())
    }

    /// Calls `take` with the columns of complete blocks that contain any of `frames`, group by group.
    ///
    /// `take` receives the indices of the columns in the file, the first frame of the block, and the columns.
    pub(crate) fn take_frame_blocks(
        &self,
        connection: &Connection,
        groups: &[ChannelGroup],
        frames: &Range<usize>,
        mut take: impl FnMut(&[usize], usize, Vec<Numbers>) -> CorpusResult<()>,
    ) -> CorpusResult<()> {
        for &group in groups {
            let columns = self.columns_of(group);
            stored_motion::visit_track_blocks(connection, self.row.id, group.channel_group_name(), frames, |block| {
                let BlockRow {
                    first_frame,
                    frames,
                    data,
                    hash,
                } = block;
                // A damaged count must not reserve memory for more than a block holds.
                if frames > BLOCK_FRAMES {
                    return Err(damaged_row_error(
                        format!("block {}", stored_motion::to_hex_text(&hash)),
                        "it is too long",
                    ));
                }
                let decode_result = codec::decode_block_columns(&data, frames, columns.len());
                let decoded = decode_result.map_err(|reason| {
                    damaged_row_error(format!("block {}", stored_motion::to_hex_text(&hash)), reason)
                })?;
                take(&columns, first_frame, decoded)
            })?;
        }
        Ok(())
    }

    /// Returns the movement of `frames` in metres and model space; joints of groups that are not requested stay at
    /// rest. Finger bones that are impossibly long have their usual length.
    pub(crate) fn read_motion_clip(
        &self,
        connection: &Connection,
        frames: Range<usize>,
        groups: &[ChannelGroup],
    ) -> CorpusResult<Clip> {
        let raw_clip = self.read_raw_clip(connection, frames, groups)?;
        let clip = self.convention.file_clip_to_model(&raw_clip);
        let long_bones = self.long_bones.get_or_init(|| {
            let roles = self.manual_joint_roles().unwrap_or_default();
            let anatomy = BodyAnatomy::with_roles(clip.clip_skeleton(), &roles);
            anatomy.map_or_else(|_| Vec::new(), |body| body.long_finger_bones(clip.clip_skeleton()))
        });
        Ok(draw_in(clip, long_bones))
    }

    /// Returns the movement of `frames` in the file's unit and axes.
    pub(crate) fn raw_clip(&self, connection: &Connection, frames: Range<usize>) -> CorpusResult<Clip> {
        self.read_raw_clip(connection, frames, &ChannelGroup::ALL_CHANNEL_GROUPS)
    }

    fn read_raw_clip(
        &self,
        connection: &Connection,
        frames: Range<usize>,
        groups: &[ChannelGroup],
    ) -> CorpusResult<Clip> {
        let frames = frames.start.min(self.motion_frame_count())..frames.end.min(self.motion_frame_count());
        let mut blocks: BTreeMap<usize, BTreeMap<usize, Numbers>> = BTreeMap::new();
        self.take_frame_blocks(connection, groups, &frames, |numbers, first, columns| {
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
            let plain = columns.into_iter().map(|(at, column)| match column.into_numbers() {
                Form::Decimals(decimals) => Ok((at, decimals)),
                other => {
                    let reason = format!("its numbers are {}, not decimals", other.number_form_name());
                    Err(damaged_row_error(place(), reason))
                }
            });
            decimals.insert(first, plain.collect::<CorpusResult<_>>()?);
        }
        let blocks = decimals;
        let mut builder = ClipBuilder::new(&self.hierarchy, self.fix)
            .map_err(|error| damaged_row_error(place(), error.to_string()))?;
        let mut next = frames.start;
        for (first, columns) in &blocks {
            let length = columns.values().next().map_or(0, |column| column.mantissas.len());
            // Blocks are whole, and the wanted frames may begin and end within one.
            let rows = next.saturating_sub(*first)..(frames.end - first).min(length);
            if *first > next || rows.is_empty() {
                return Err(damaged_row_error(place(), format!("frame {next} is missing")));
            }
            next = first + rows.end;
            builder.push_block_rows(rows, |at| columns.get(&at));
        }
        // A skeleton without channels has no blocks, and nothing is missing from it.
        if next < frames.end && self.hierarchy.channel_count() > 0 {
            return Err(damaged_row_error(place(), format!("frame {next} is missing")));
        }
        let clip = builder
            .finish_bvh_clip(self.rate)
            .map_err(|error| damaged_row_error(place(), error.to_string()))?;
        Ok(match self.row.root_scale {
            None => clip,
            Some(scale) => scale_root(clip, scale),
        })
    }

    /// Returns the clip for columns of quaternions and positions; joints whose columns were not read stay at rest.
    fn exact_clip(
        &self,
        layout: &TrackColumnLayout,
        skeleton: &Arc<Skeleton>,
        blocks: &BTreeMap<usize, BTreeMap<usize, Numbers>>,
        frames: Range<usize>,
    ) -> CorpusResult<Clip> {
        let bad = |reason: String| damaged_row_error(format!("track {}", self.row.id), reason);
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
        for (joint, at) in skeleton.skeleton_joints().iter().enumerate() {
            let width = layout.joint_column_count(joint);
            let joint_columns = from..from + width;
            from += width;
            let mut channel = JointChannel {
                rotations: Vec::with_capacity(frames.len()),
                translations: (width > 4).then(Vec::new),
            };
            for (columns, rows) in &parts {
                let joint_numbers: Option<Vec<&Numbers>> =
                    joint_columns.clone().map(|column| columns.get(&column)).collect();
                // The group of this joint was not asked for, so that it stays at rest.
                let Some(found) = joint_numbers else {
                    channel.rotations.extend(rows.clone().map(|_| at.rest));
                    if let Some(places) = &mut channel.translations {
                        places.extend(rows.clone().map(|_| at.offset));
                    }
                    continue;
                };
                layout
                    .append_joint_rows(&mut channel, &found, rows.clone())
                    .ok_or_else(|| bad(format!("joint {:?} has a gap", at.name)))?;
            }
            channels.push(channel);
        }
        Clip::new(Arc::clone(skeleton), self.rate, channels).map_err(|error| bad(error.to_string()))
    }

    /// Returns the body parts of the skeleton's joints, measured at the beginning of the recording; for generated
    /// movement, measured at the beginning of the recording that provided its body.
    pub(crate) fn track_anatomy(&self, connection: &Connection) -> CorpusResult<BodyAnatomy> {
        let first = self.read_motion_clip(
            connection,
            0..self.head_frame_count(),
            &ChannelGroup::ALL_CHANNEL_GROUPS,
        )?;
        let roles = self.row.roles.as_deref().map(str::parse::<AssignedJointRoles>);
        let place = format!("track {}", self.row.id);
        let roles = roles
            .transpose()
            .map_err(|error| damaged_row_error(place.clone(), error.to_string()))?
            .unwrap_or_default();
        let anatomy = BodyAnatomy::with_roles(first.clip_skeleton(), &roles)
            .map_err(|error| damaged_row_error(place, error.to_string()))?;
        // A skeleton whose rest pose a body can assume is measured in that.
        if anatomy.is_posed() {
            return Ok(anatomy);
        }
        let recording_id = self.row.recording_id;
        let body = recipes::body_of(connection, recording_id, self.row.skeleton_id)?;
        let Some(body) = body.filter(|body| *body != recording_id) else {
            return Ok(measure_standing_anatomy(anatomy, &first));
        };
        let body_track = Self::open_motion_track(connection, body)?;
        let body = body_track.read_motion_clip(
            connection,
            0..body_track.head_frame_count(),
            &ChannelGroup::ALL_CHANNEL_GROUPS,
        )?;
        // Rows of skeletons may be shared though their units differ, so that the measured bodies are
        // compared.
        let same = body.clip_skeleton() == first.clip_skeleton();
        Ok(measure_standing_anatomy(anatomy, if same { &body } else { &first }))
    }

    /// Returns the number of initial frames that are searched for odd ones.
    fn head_frame_count(&self) -> usize {
        let frames = (MAX_ODD_END_SECONDS * self.rate.per_second()).ceil() as usize;
        frames.clamp(1, BLOCK_FRAMES).min(self.motion_frame_count().max(1))
    }

    /// Returns the odd frames at both ends of the recording.
    pub(crate) fn odd_frames(&self, connection: &Connection, anatomy: &BodyAnatomy) -> CorpusResult<Vec<OddFrames>> {
        let (all, part) = (self.motion_frame_count(), 4 * self.head_frame_count());
        let read = |frames: Range<usize>| self.read_motion_clip(connection, frames, &ChannelGroup::ALL_CHANNEL_GROUPS);
        if all <= 2 * part {
            return Ok(ClipEnds::examine_clip_ends(&read(0..all)?, anatomy).odd);
        }
        let hips = anatomy.part_joint(BodyPart::Hips).unwrap_or(0);
        let above = |joint: &usize| self.hierarchy.joints[*joint].parent;
        // The hips' path depends on the joints above them alone, so that a long take is read without its
        // limbs.
        let carriers: Vec<usize> = std::iter::successors(Some(hips), above).collect();
        let mut groups = ChannelGroup::ALL_CHANNEL_GROUPS.to_vec();
        groups.retain(|group| {
            let joints = self.groups.get(group).into_iter().flatten();
            joints.into_iter().any(|joint| carriers.contains(joint))
        });
        let mut path = Vec::with_capacity(all);
        for start in (0..all).step_by(BLOCK_FRAMES) {
            let frames = start..(start + BLOCK_FRAMES).min(all);
            let clip = self.read_motion_clip(connection, frames, &groups)?;
            path.extend(clip.joint_path(hips));
        }
        Ok(ClipEnds::of_long_take(&path, part, anatomy, read)?.odd)
    }
}

/// Measures an anatomy in the first ordinary frame, if no body can assume the rest pose.
pub(crate) fn measure_standing_anatomy(anatomy: BodyAnatomy, head: &Clip) -> BodyAnatomy {
    if anatomy.is_posed() || head.clip_frame_count() == 0 {
        return anatomy;
    }
    let first = anatomy.clone().with_clip(head);
    // A take may begin with a pose for calibration, in which nobody is to be measured.
    match ClipEnds::examine_clip_ends(head, &first).sound.start {
        0 => first,
        sound => anatomy.with_reference(head.clip_skeleton(), &head.model_pose(sound)),
    }
}

/// The longest run of odd frames at an end of a recording that is skipped for measuring, in seconds.
const MAX_ODD_END_SECONDS: f64 = 2.5;

/// Returns the clip with the root's positions multiplied.
fn scale_root(clip: Clip, scale: f64) -> Clip {
    let (skeleton, rate) = (clip.clip_skeleton().clone(), clip.clip_frame_rate());
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
    let mut joints = clip.clip_skeleton().skeleton_joints().to_vec();
    let mut channels = clip.joint_channels().to_vec();
    for &(joint, length) in bones {
        let share = length / joints[joint].offset.length();
        joints[joint].offset *= share;
        for place in channels[joint].translations.iter_mut().flatten() {
            *place *= share;
        }
    }
    let drawn_skeleton = Skeleton::new(joints).ok();
    let drawn =
        drawn_skeleton.and_then(|skeleton| Clip::new(Arc::new(skeleton), clip.clip_frame_rate(), channels).ok());
    drawn.unwrap_or(clip)
}

/// Returns the columns of a file for those joints.
pub(crate) fn columns_of(hierarchy: &BvhHierarchy, joints: &[usize]) -> Vec<usize> {
    let ranges = hierarchy.joint_channel_columns();
    joints
        .iter()
        .filter_map(|&joint| ranges.get(joint).cloned())
        .flatten()
        .collect()
}

/// Stores `frames` frames of columns from `first_frame` on, group by group.
pub(crate) fn store_block_groups(
    connection: &Connection,
    track: i64,
    groups: &[(ChannelGroup, Vec<usize>)],
    first_frame: usize,
    frames: usize,
    columns: &[Column],
) -> CorpusResult<()> {
    for (group, numbers) in groups {
        let group_columns: Vec<&Column> = numbers.iter().filter_map(|&at| columns.get(at)).collect();
        if !group_columns.is_empty() {
            let data = codec::encode_decimal_columns(frames, &group_columns);
            stored_motion::insert_block(
                connection,
                track,
                group.channel_group_name(),
                first_frame,
                frames,
                &data,
            )?;
        }
    }
    Ok(())
}
