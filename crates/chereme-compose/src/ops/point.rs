//! `point`: generates a pointing gesture from a body at rest and back.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{BodyPart, BodySide, FingerAngles, HandAngles, HandFinger, ModelPose, ThumbAngles};
use chereme_sign::{ComponentReading, SignComponent};

use crate::answers::{self, AnswerSlot, CorpusAsker};
use crate::arm;
use crate::body::SignerFrame;
use crate::course::TransitionCourses;
use crate::error::StepError;
use crate::ops::travel::wrist_path;
use crate::ops::{StepOutcome, join, place_operator};
use crate::outcome::{GeneratedNote, NoteSubject};
use crate::poses::{self, HandPose, PoseOrigin};
use crate::recipe_inputs::{MaterialInput, PlaceInput};
use crate::recipe_settings::{PointSettings, TransitionProfile};
use crate::sources::{LearnedProfile, LearnedReaches, MaterialSigner};
use crate::work::{JointGroup, WorkingClip, find_joint_groups};

/// The body that points.
pub(crate) const POINT_BODY_SLOT: AnswerSlot<MaterialInput> = AnswerSlot::new("point");
/// The hand's shape.
const POINT_HANDSHAPE_SLOT: AnswerSlot<Vec<HandPose>> = AnswerSlot::new("point/with");
/// The place of the target, if an inventory names it.
const POINT_TARGET_SLOT: AnswerSlot<PlaceInput> = AnswerSlot::new("point/at");
/// The learned courses of reaching and retraction.
const POINT_COURSE_SLOT: AnswerSlot<LearnedProfile> = AnswerSlot::new("point/via");

/// Asks for the body, the hand's shape and the place of a pointing gesture.
pub(crate) fn resolve_pointing_inputs(
    settings: &PointSettings,
    ask: &mut CorpusAsker<'_>,
) -> Result<MaterialSigner, StepError> {
    let setting = ask.ask_signer_body(&POINT_BODY_SLOT, settings.on.as_deref())?;
    let poses = match &settings.with {
        Some(with) => {
            let side = settings.hand.chosen_sides(setting.handedness)[0];
            poses::choose_hand_poses(ask.sources, with, side, &setting)?
        }
        None => {
            let mut pose = index_finger();
            pose.value = poses::nearest_value(ask.sources, &pose.angles);
            vec![pose]
        }
    };
    ask.put_answer(&POINT_HANDSHAPE_SLOT, poses);
    ask.ask_spot_place(&POINT_TARGET_SLOT, &settings.at)?;
    ask.usual_reaches(&POINT_COURSE_SLOT, &settings.via)?;
    Ok(setting)
}

/// Generates a pointing gesture.
pub(crate) fn generate_pointing(
    settings: &PointSettings,
    given: &mut answers::NodeAnswers<'_>,
) -> Result<(WorkingClip, StepOutcome), StepError> {
    let mut work = WorkingClip::working_clip_from(given.answered_material(&POINT_BODY_SLOT)?);
    let course = given.transition_courses(&POINT_COURSE_SLOT, &settings.via, TransitionProfile::MinimumJerk)?;
    let learned = given.get_answer(&POINT_COURSE_SLOT);
    let point_inputs = PointInputs {
        shape: given.get_answer(&POINT_HANDSHAPE_SLOT).map(Vec::as_slice),
        place: given.get_answer(&POINT_TARGET_SLOT),
        reaches: learned.and_then(|learned| learned.reaches.as_ref()),
    };
    let done = point_at_target(&mut work, settings, &point_inputs, &course)?;
    Ok((work, done))
}

/// The usual time of reaching, and of retraction, in seconds, if the corpus shows too few reaches.
const POINT_REACH_S: f64 = 0.5;
/// The greatest speed of a wrist whose time nobody states, in metres per second; that of captured signers.
const FASTEST_REACH: f64 = 1.6;
/// The number of steps in which the speed of a reach is measured.
const REACH_STEPS: usize = 100;
/// The usual time of the hold between, in seconds.
const POINT_HOLD_S: f64 = 0.3;
/// The extension of the arm towards a far target, as a share of its length.
const POINT_ARM_EXTENSION: f64 = 0.88;
/// The distance of the fingertip from a near target, in metres.
const SHORT_OF: f64 = 0.02;

/// The inputs of a pointing gesture.
pub(crate) struct PointInputs<'a> {
    pub(crate) shape: Option<&'a [HandPose]>,
    pub(crate) place: Option<&'a PlaceInput>,
    /// The reaches whose speed it has, if the corpus shows enough.
    pub(crate) reaches: Option<&'a LearnedReaches>,
}

/// Points on the body of `work`, whose first frame is its posture at rest.
pub(crate) fn point_at_target(
    work: &mut WorkingClip,
    settings: &PointSettings,
    given: &PointInputs<'_>,
    courses: &TransitionCourses,
) -> Result<StepOutcome, StepError> {
    let sides = settings.hand.chosen_sides(work.handedness);
    let frame = place_operator::signer_body_frame(work, sides)?;
    let step = work.rate.frame_time();
    let frames = |seconds: f64| ((seconds / step).round() as usize).max(1);
    work.resample_channels(&[0.0]);
    work.notes.clear();
    let mut did = Vec::new();
    let mut shapes = Vec::new();
    let mut apex = work.clone();
    for &side in sides {
        let pose = given.shape.and_then(<[_]>::first).cloned().unwrap_or_else(index_finger);
        let joints = poses::hand_pose_rotations(&work.skeleton, &work.anatomy, side, &pose);
        for (joint, rotation) in joints.ok_or(StepError::NoFingers(side))? {
            apex.channels[joint].rotations[0] = rotation;
        }
        let given_place = given.place.map(|input| &input.at);
        let target = frame
            .hand_spot_position(work, &settings.at, given_place, side)
            .ok_or(StepError::NoMeaning {
                value: settings.at.to_string(),
                what: "landmark that this skeleton has",
            })?;
        let missed = aim_index_finger(&mut apex, &frame, side, target)?;
        did.push(format!(
            "the {} index finger's line passes {:.1} mm beside the target",
            side.body_side_name(),
            missed * 1000.0
        ));
        shapes.push((side, pose));
    }
    let seconds = match settings.via.time {
        Some(time) => time.0,
        None => {
            // The time depends on the wrist's way, which is tried out first.
            let mut reaching = work.clone();
            reaching.resample_channels(&[0.0; REACH_STEPS + 1]);
            carry_to_apex(&mut reaching, &apex, sides, courses, |step| {
                step as f64 / REACH_STEPS as f64
            });
            let seconds = usual_time(&reaching, sides, given.reaches)?;
            did.push(format!("reaching takes {seconds:.2} s"));
            seconds
        }
    };
    let (reach, hold) = (
        frames(seconds),
        frames(settings.hold.map_or(POINT_HOLD_S, |time| time.0)),
    );
    let total = 2 * reach + hold;
    join::check_length(work, total)?;
    work.resample_channels(&vec![0.0; total]);
    carry_to_apex(work, &apex, sides, courses, |frame| {
        // The way back mirrors the way there.
        frame.min(total - 1 - frame) as f64 / reach as f64
    });
    for (side, pose) in shapes {
        write_pointing_note(work, side, &pose, reach..reach + hold);
    }
    work.notes.push(GeneratedNote {
        hand: None,
        about: NoteSubject::Gloss,
        value: ComponentReading::Value("point".into()),
        span: work.working_clip_span(),
        origin: settings.to_string(),
    });
    let changed = sides.iter().flat_map(|&s| [JointGroup::Arm(s), JointGroup::Fingers(s)]);
    work.note_changed_groups(changed.collect::<Vec<_>>(), &settings.to_string());
    Ok(StepOutcome::with_residual(did, 0.0))
}

/// Carries arms and hands from the posture of each frame to that of `apex`; `out` is the share of a reach at a frame.
fn carry_to_apex(
    work: &mut WorkingClip,
    apex: &WorkingClip,
    sides: &[BodySide],
    courses: &TransitionCourses,
    out: impl Fn(usize) -> f64,
) {
    let groups = find_joint_groups(&work.skeleton, &work.anatomy);
    for (joint, group) in groups.iter().enumerate() {
        // Hands take their shape in the first half of reaching, and lose it in the last half of retraction.
        let (early, course) = match group {
            JointGroup::Fingers(side) if sides.contains(side) => (2.0, &courses.fingers),
            JointGroup::Arm(side) if sides.contains(side) => (1.0, &courses.arms),
            _ => continue,
        };
        let top = apex.channels[joint].rotations[0];
        for (frame, rotation) in work.channels[joint].rotations.iter_mut().enumerate() {
            *rotation = course.rotation_along_course(*rotation, top, (out(frame) * early).min(1.0));
        }
    }
}

/// Returns the time of a reach in seconds: at the mean speed of captured ones, if they are known, and never so short that
/// a wrist would be faster than those of signers. `reaching` goes from rest to the apex in [`REACH_STEPS`] steps.
fn usual_time(reaching: &WorkingClip, sides: &[BodySide], reaches: Option<&LearnedReaches>) -> Result<f64, StepError> {
    let mut seconds = reaches.map_or(POINT_REACH_S, |_| 0.0);
    for &side in sides {
        let path = wrist_path(reaching, side)?;
        let step = path.windows(2).map(|two| two[0].distance(two[1]));
        let fastest = step.fold(0.0, f64::max) * REACH_STEPS as f64;
        let far = path[REACH_STEPS].distance(path[0]);
        let usual = reaches.map_or(0.0, |reaches| far / reaches.speed.max(1e-3));
        // A hundredth more, as the steps are measured and not the curve between them.
        seconds = seconds.max(usual).max(1.01 * fastest / FASTEST_REACH);
    }
    Ok(seconds)
}

fn write_pointing_note(work: &mut WorkingClip, side: BodySide, pose: &HandPose, frames: std::ops::Range<usize>) {
    work.notes.push(GeneratedNote {
        hand: Some(side),
        about: NoteSubject::Component(SignComponent::Configuration, None),
        value: pose
            .value
            .clone()
            .map_or(ComponentReading::Unset, ComponentReading::Value),
        span: work.rate.frame_range_span(frames),
        origin: pose.origin.to_string(),
    });
}

/// Returns a closed hand with the index finger straight.
fn index_finger() -> HandPose {
    let bent = FingerAngles {
        spread: 0.0,
        flexion: [1.4, 1.7, 1.0],
    };
    let mut fingers = [bent; 4];
    fingers[HandFinger::Index.index()] = FingerAngles::default();
    HandPose {
        value: None,
        origin: PoseOrigin::Inventory("the pointing index finger".into()),
        angles: HandAngles {
            thumb: ThumbAngles {
                radial: 0.3,
                palmar: 0.7,
                opposition: 0.4,
                flexion: [0.6, 0.6],
            },
            fingers,
        },
        exact: None,
        coding: None,
    }
}

/// Moves arm and hand of a posture so that the index finger's line meets the target; returns the distance by which it
/// misses.
fn aim_index_finger(
    apex: &mut WorkingClip,
    frame: &SignerFrame,
    side: BodySide,
    target: DVec3,
) -> Result<f64, StepError> {
    let chain = apex.anatomy.arm_chain(side).ok_or(StepError::NoArm(side))?;
    let model = ModelPose::from_local_pose(&apex.skeleton, &apex.local_pose_at(0));
    let shoulder = model.model_joint_position(chain.upper);
    let direction = (target - shoulder).normalize_or(frame.forward);
    // A finger that points up or down leaves no palm that could face down.
    let down = if direction.y.abs() > 0.9 {
        frame.forward
    } else {
        DVec3::NEG_Y
    };
    // As people point: the palm down and a little inwards.
    let palm = (down - frame.left * (0.3 * side.side_sign())).reject_from_normalized(direction);
    let rotation = apex
        .anatomy
        .hand_rotation(side, direction, palm)
        .ok_or(StepError::NoFingers(side))?;
    let length = |model: &ModelPose| {
        index_finger_ends(apex, model, side).map(|(_, tip)| tip.distance(model.model_joint_position(chain.hand)))
    };
    // A usual hand stands in where the tip is unknown.
    let hand = length(&model).unwrap_or(0.18).max(0.15);
    // Before a near target the finger stops short, but the arm is never folded up.
    let stretch = (POINT_ARM_EXTENSION * crate::body::arm_length(apex, side).unwrap_or(frame.arm))
        .min(shoulder.distance(target) - hand - SHORT_OF)
        .max(0.25 * frame.arm);
    let mut hands = [rotation];
    let mut wrist = [shoulder + direction * stretch];
    let mut missed = f64::INFINITY;
    for _ in 0..8 {
        arm::raise_arm(apex, side, &wrist, &hands, frame.left * side.side_sign()).ok_or(StepError::NoArm(side))?;
        let model = ModelPose::from_local_pose(&apex.skeleton, &apex.local_pose_at(0));
        let (base, tip) = index_finger_ends(apex, &model, side).ok_or(StepError::NoFingers(side))?;
        let line = (tip - base).normalize_or(direction);
        let to = target - base;
        missed = to.reject_from_normalized(line).length();
        // A target behind the finger's base is not met by turning on.
        if missed < 1e-5 || line.dot(to) <= 0.0 {
            break;
        }
        // A rotation about the finger's base makes the line meet the target at once, if the arm follows.
        let turn = DQuat::from_rotation_arc(line, to.normalize_or(line));
        hands = [(turn * hands[0]).normalize()];
        wrist = [base - turn * (base - model.model_joint_position(chain.hand))];
    }
    Ok(missed)
}

/// Returns the base and the tip of the index finger.
fn index_finger_ends(work: &WorkingClip, model: &ModelPose, side: BodySide) -> Option<(DVec3, DVec3)> {
    let base = work.anatomy.part_joint(BodyPart::Finger(side, HandFinger::Index, 1))?;
    let name = format!("{}-index-tip", side.body_side_name());
    let tip = work.anatomy.landmark_place_position(&work.skeleton, model, &name)?;
    Some((model.model_joint_position(base), tip))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sources::{ComponentValue, ValueMeaning};
    use crate::testing::Shelf;

    #[test]
    fn a_pointing_hand_has_the_value_that_it_shows() {
        let mut shelf = Shelf::new();
        let angles = index_finger().angles;
        let found = poses::nearest_value(&shelf, &angles);
        assert_eq!(found, None, "no value is near enough");
        let index = ComponentValue {
            id: "1".into(),
            inventory: "configurations".into(),
            meaning: Some(ValueMeaning::Hand(angles)),
        };
        shelf.values.push((SignComponent::Configuration, index));
        let recipe: crate::Recipe = "point right at 30cm,140cm,50cm".parse().expect("a recipe");
        let resolved = crate::resolve_recipe(&recipe, &shelf).expect("resolved");
        let made = crate::evaluate_recipe(&resolved).expect("made");
        let shown = made
            .notes
            .iter()
            .find(|note| note.about == NoteSubject::Component(SignComponent::Configuration, None));
        assert_eq!(shown.and_then(|note| note.value.reading_value()), Some("1"));
    }
}
