//! Recordings that show the movement of another one unchanged: byte-equal copies, pieces of a take, and results of recipes
//! that leave it as it is.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use chereme_motion::TimeSpan;
use chereme_motion::glam::{DQuat, DVec3};
use rusqlite::Connection;

use crate::db::{consents, stored_recordings};
use crate::error::CorpusResult;
use crate::movement::{ChannelGroup, MotionTrack};
use crate::progress::ProgressReceiver;

/// The channels that carry movement.
const ARM_GROUPS: [ChannelGroup; 2] = [ChannelGroup::RightArm, ChannelGroup::LeftArm];
/// For how long the arms of a result have the rotations of those of a source before it counts as the movement of that source, in seconds.
const KEPT_MOVEMENT_SECONDS: f64 = 0.4;
/// The least cosine of half the angle between two rotations that count as the same: both were rounded when they were
/// stored.
const SAME_ROTATION_COSINE: f64 = 1.0 - 1e-8;
/// The cosine of half an angle of one degree: arms that turn less than that are at rest.
const MOVING_COSINE: f64 = 1.0 - 3.8e-5;

/// Returns the groups of recordings whose arms have equal blocks at the same frames.
pub(super) fn equal_movement_groups(connection: &Connection) -> CorpusResult<Vec<BTreeSet<i64>>> {
    let mut by_blocks: BTreeMap<(i64, Vec<Vec<u8>>), BTreeSet<i64>> = BTreeMap::new();
    for arms in consents::list_arm_blocks(connection)? {
        let recordings = by_blocks.entry((arms.first_frame, arms.hashes)).or_default();
        recordings.insert(arms.recording);
    }
    Ok(by_blocks.into_values().filter(|group| group.len() > 1).collect())
}

/// A recording that shows the movement of a stretch of another one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct MovementPiece {
    pub(crate) piece: i64,
    pub(crate) take: i64,
    /// The part of the take that the whole piece corresponds to.
    pub(crate) span: TimeSpan,
}

/// How many frames of a take are compared at once.
const COMPARED_FRAMES: usize = 4096;
/// By how much the lengths of the same arms may differ, as a share.
const ARM_LENGTH_TOLERANCE: f64 = 1e-3;

/// The rotations of the joints of the arms, by name: skeletons may order their joints differently.
type ArmRotations = BTreeMap<String, Vec<DQuat>>;

/// The arms of a recording's body.
struct BodyArms {
    recording: i64,
    track: MotionTrack,
    joints: Vec<usize>,
    /// The length of their bones in metres.
    arm_length: f64,
}

impl BodyArms {
    /// Opens the body of a recording; nothing if it has no arms.
    fn open_body_arms(connection: &Connection, recording: i64) -> CorpusResult<Option<Self>> {
        if stored_recordings::body_track(connection, recording)?.is_none() {
            return Ok(None);
        }
        let track = MotionTrack::open_motion_track(connection, recording)?;
        let groups = ARM_GROUPS.iter().filter_map(|group| track.groups.get(group));
        let joints: Vec<usize> = groups.flatten().copied().collect();
        let offsets = joints.iter().map(|joint| &track.hierarchy.joints[*joint].offset);
        let lengths = offsets.map(|offset| DVec3::from_array([0, 1, 2].map(|axis| offset[axis].to_f64())).length());
        let arm_length = lengths.sum::<f64>() * track.convention.metres_per_unit;
        Ok((!joints.is_empty()).then_some(Self {
            recording,
            track,
            joints,
            arm_length,
        }))
    }

    fn read_arm_rotations(&self, connection: &Connection, frames: Range<usize>) -> CorpusResult<ArmRotations> {
        let clip = self.track.read_motion_clip(connection, frames, &ARM_GROUPS)?;
        let joints = self.joints.iter().filter(|joint| **joint < clip.joint_channels().len());
        let named = joints.map(|&joint| {
            let name = clip.clip_skeleton().joint_at(joint).name.clone();
            (name, clip.joint_channel(joint).rotations.clone())
        });
        Ok(named.collect())
    }

    /// Returns how many frames show whose movement it is.
    fn telling_frame_count(&self) -> usize {
        let enough = (KEPT_MOVEMENT_SECONDS / self.track.rate.frame_time()).ceil() as usize;
        // A clip that is shorter counts if all of it is the same.
        enough.min(self.track.motion_frame_count()).max(2)
    }

    /// Reads the first frames in which the arms move, with the place of the first of them.
    fn read_moving_frames(&self, connection: &Connection) -> CorpusResult<Option<(usize, ArmRotations)>> {
        let (count, enough) = (self.track.motion_frame_count(), self.telling_frame_count());
        for start in (0..count).step_by(COMPARED_FRAMES) {
            let end = (start + COMPARED_FRAMES + enough).min(count);
            let mut turns = self.read_arm_rotations(connection, start..end)?;
            let is_moving = |first: &usize| (turns.values()).any(|one| moves_between(one, *first, first + enough - 1));
            if let Some(first) = (0..(end - start + 1).saturating_sub(enough)).find(is_moving) {
                (turns.values_mut()).for_each(|one| *one = one[first..first + enough].to_vec());
                return Ok(Some((start + first, turns)));
            }
        }
        Ok(None)
    }

    /// Reports whether this may be a piece of a take: it is not longer, and the bones of two people differ.
    fn may_be_piece_of(&self, take: &Self) -> bool {
        let most = take.arm_length * ARM_LENGTH_TOLERANCE;
        self.recording != take.recording
            && self.track.row.frames <= take.track.row.frames
            && self.track.rate == take.track.rate
            && (self.arm_length - take.arm_length).abs() <= most
    }
}

/// Reports whether two rotations are the same; a quaternion and its negative are.
fn is_same_rotation((one, two): (&DQuat, &DQuat)) -> bool {
    one.dot(*two).abs() >= SAME_ROTATION_COSINE
}

fn moves_between(rotations: &[DQuat], first: usize, last: usize) -> bool {
    rotations[first].dot(rotations[last]).abs() < MOVING_COSINE
}

/// Returns the first frame of a take at which the arms begin to move as in the frames of a piece.
fn find_frames_in_take(piece: &ArmRotations, take: &ArmRotations) -> Option<usize> {
    let pairs = piece.iter().map(|(name, own)| Some((own, take.get(name)?)));
    let pairs: Vec<_> = pairs.collect::<Option<_>>()?;
    let starts = pairs
        .iter()
        .map(|(own, turns)| (turns.len() + 1).saturating_sub(own.len()));
    let is_from =
        |frame: &usize| (pairs.iter()).all(|(own, turns)| own.iter().zip(&turns[*frame..]).all(is_same_rotation));
    (0..starts.min()?).find(is_from)
}

/// Returns those of `pieces` whose arms do what those of a take do that is not shorter, each with its first place in every
/// such take. A piece is recognised by the first frames in which its arms move.
pub(crate) fn find_movement_pieces(
    connection: &Connection,
    pieces: &BTreeSet<i64>,
    takes: &BTreeSet<i64>,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<Vec<MovementPiece>> {
    let mut moving_pieces = Vec::new();
    for &piece in pieces.iter().filter(|_| !takes.is_empty()) {
        if let Some(arms) = BodyArms::open_body_arms(connection, piece)? {
            let moving = arms.read_moving_frames(connection)?;
            moving_pieces.extend(moving.map(|(first, turns)| (arms, first, turns)));
        }
    }
    let longest = moving_pieces.iter().map(|(arms, ..)| arms.telling_frame_count()).max();
    let mut found = Vec::new();
    for (done, &take) in takes.iter().enumerate().filter(|_| longest.is_some()) {
        progress.report_items("comparing movement", done, takes.len())?;
        let Some(body) = BodyArms::open_body_arms(connection, take)? else {
            continue;
        };
        let (count, rate) = (body.track.motion_frame_count(), body.track.rate);
        let mut waiting: Vec<_> = (moving_pieces.iter())
            .filter(|(arms, ..)| arms.may_be_piece_of(&body))
            .collect();
        for start in (0..count).step_by(COMPARED_FRAMES) {
            // Movement of others is not read at all.
            if waiting.is_empty() {
                break;
            }
            let end = (start + COMPARED_FRAMES + longest.unwrap_or_default()).min(count);
            let turns = body.read_arm_rotations(connection, start..end)?;
            waiting.retain(|(arms, first, own)| {
                let frame = find_frames_in_take(own, &turns);
                found.extend(frame.map(|frame| {
                    let begin = (start + frame).saturating_sub(*first);
                    let end = (begin + arms.track.motion_frame_count()).min(count);
                    let [begin, end] = [begin, end].map(|frame| rate.frame_start_instant(frame));
                    let span = TimeSpan::span_between(begin, end);
                    let piece = arms.recording;
                    MovementPiece { piece, take, span }
                }));
                frame.is_none()
            });
        }
    }
    Ok(found)
}

/// Returns those sources of a generated recording whose movement it shows unchanged.
pub(super) fn sources_kept_by(
    connection: &Connection,
    generated: i64,
    sources: &BTreeSet<i64>,
) -> CorpusResult<BTreeSet<i64>> {
    let mut kept_sources = BTreeSet::new();
    let Some(generated) = BodyArms::open_body_arms(connection, generated)? else {
        return Ok(kept_sources);
    };
    let read_whole = |arms: &BodyArms| arms.read_arm_rotations(connection, 0..arms.track.motion_frame_count());
    let own = read_whole(&generated)?;
    for &source in sources {
        if let Some(arms) = BodyArms::open_body_arms(connection, source)?
            && is_movement_kept(&own, &read_whole(&arms)?, generated.telling_frame_count())
        {
            kept_sources.insert(source);
        }
    }
    Ok(kept_sources)
}

/// Reports whether the arms do what those of the source do, in its order and at any tempo, and move meanwhile. Fingers, face
/// and the way somebody stands may be others: the movement, by which people are recognised, is the same.
fn is_movement_kept(generated: &ArmRotations, source: &ArmRotations, enough: usize) -> bool {
    let pairs = generated
        .iter()
        .filter_map(|(name, own)| Some((own, source.get(name)?)));
    let pairs: Vec<_> = pairs.collect();
    let Some([own_count, count]) = pairs.first().map(|(own, other)| [own.len(), other.len()]) else {
        return false;
    };
    // Few common joints could be alike by chance.
    if pairs.len() * 2 < generated.len() || count == 0 {
        return false;
    }
    let enough = enough.min(count).max(2) - 1;
    // Other rates and tempos show the arms between the frames of the source.
    let fine: Vec<Vec<DQuat>> = pairs.iter().map(|(_, other)| refine_rotations(other)).collect();
    let steps = (count - 1) * STEPS_PER_FRAME + 1;
    // For each step of the source, the first step of the movement that leads to it in the former frame.
    let (mut before, mut now) = (vec![None; steps], vec![None; steps]);
    for frame in 0..own_count {
        for step in 0..steps {
            let is_near = || (pairs.iter().zip(&fine)).all(|((own, _), fine)| is_near_rotation(own[frame], fine[step]));
            now[step] = is_near().then(|| {
                let earlier = before[step.saturating_sub(MAX_STEPS_AT_ONCE)..=step].iter().flatten();
                earlier.min().copied().unwrap_or(step)
            });
            // At rest, the arms of all people are alike.
            let moves = |first: usize| fine.iter().any(|one| one[first].dot(one[step]).abs() < SHOWING_COSINE);
            if now[step].is_some_and(|first: usize| step - first >= enough * STEPS_PER_FRAME && moves(first)) {
                return true;
            }
        }
        std::mem::swap(&mut before, &mut now);
    }
    false
}

/// How many steps a frame of a source is parted into.
const STEPS_PER_FRAME: usize = 4;
/// By how many steps a generated movement may go on from one frame to the next: it is up to four times as fast.
const MAX_STEPS_AT_ONCE: usize = 4 * STEPS_PER_FRAME;
/// The least cosine of half the angle between rotations that look the same, which is three degrees.
const NEAR_ROTATION_COSINE: f64 = 1.0 - 3.43e-4;
/// The cosine of half an angle of twelve degrees: arms that turn more than that show a movement.
const SHOWING_COSINE: f64 = 1.0 - 5.48e-3;

fn is_near_rotation(one: DQuat, two: DQuat) -> bool {
    one.dot(two).abs() >= NEAR_ROTATION_COSINE
}

/// Returns rotations with those between them.
fn refine_rotations(rotations: &[DQuat]) -> Vec<DQuat> {
    let steps = (0..STEPS_PER_FRAME).map(|step| step as f64 / STEPS_PER_FRAME as f64);
    let pairs = rotations.windows(2).map(|pair| [pair[0], pair[1]]);
    let between = pairs.flat_map(|[from, to]| steps.clone().map(move |share| from.slerp(to, share)));
    between.chain(rotations.last().copied()).collect()
}
