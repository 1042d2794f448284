//! `point`: generates a pointing gesture from a body at rest and back.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{Finger, FingerAngles, HandAngles, ModelPose, Part, Side, ThumbAngles};
use chereme_sign::{Component, Reading};

use crate::answers::{self, Ask, Setting, Slot};
use crate::arm;
use crate::body::Frame;
use crate::course::Courses;
use crate::error::Cause;
use crate::ops::Done;
use crate::ops::travel::wrist_path;
use crate::ops::{join, place};
use crate::outcome::{About, Note};
use crate::poses::{self, HandPose, PoseOrigin};
use crate::recipe::Point;
use crate::recipe::Profile;
use crate::resolve::MaterialInput;
use crate::resolve::PlaceInput;
use crate::sources::{LearnedProfile, LearnedReaches};
use crate::work::{Group, Work, groups};

/// The body that points.
pub(crate) const BODY: Slot<MaterialInput> = Slot::new("point");
/// The hand's shape.
const WITH: Slot<Vec<HandPose>> = Slot::new("point/with");
/// The place of the target, if an inventory names it.
const AT: Slot<PlaceInput> = Slot::new("point/at");
/// The learned courses of reaching and retraction.
const VIA: Slot<LearnedProfile> = Slot::new("point/via");

/// Asks for the body, the hand's shape and the place of a pointing gesture.
pub(crate) fn resolve(settings: &Point, ask: &mut Ask<'_>) -> Result<Setting, Cause> {
    let setting = ask.body(&BODY, settings.on.as_deref())?;
    let poses = match &settings.with {
        Some(with) => {
            let side = settings.hand.sides(setting.handedness)[0];
            poses::choose(ask.sources, with, side, &setting)?
        }
        None => {
            let mut pose = index_finger();
            pose.value = poses::nearest_value(ask.sources, &pose.angles);
            vec![pose]
        }
    };
    ask.put(&WITH, poses);
    ask.spot(&AT, &settings.at)?;
    ask.usual_reaches(&VIA, &settings.via)?;
    Ok(setting)
}

/// Generates a pointing gesture.
pub(crate) fn generate(
    settings: &Point,
    given: &mut answers::Given<'_>,
) -> Result<(Work, Done), Cause> {
    let mut work = Work::of(given.material(&BODY)?);
    let course = given.course(&VIA, &settings.via, Profile::MinimumJerk)?;
    let learned = given.get(&VIA);
    let found = PointInputs {
        shape: given.get(&WITH).map(Vec::as_slice),
        place: given.get(&AT),
        reaches: learned.and_then(|learned| learned.reaches.as_ref()),
    };
    let done = point(&mut work, settings, &found, &course)?;
    Ok((work, done.into()))
}

/// The usual time of reaching, and of retraction, in seconds, if the corpus shows too few reaches.
const REACH: f64 = 0.5;
/// The greatest speed of a wrist whose time nobody states, in metres per second; that of captured signers.
const FASTEST_REACH: f64 = 1.6;
/// The number of steps in which the speed of a reach is measured.
const REACH_STEPS: usize = 100;
/// The usual time of the hold between, in seconds.
const HOLD: f64 = 0.3;
/// The extension of the arm towards a far target, as a share of its length.
const STRETCH: f64 = 0.88;
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
pub(crate) fn point(
    work: &mut Work,
    settings: &Point,
    given: &PointInputs<'_>,
    courses: &Courses,
) -> Result<(Vec<String>, f64), Cause> {
    let sides = settings.hand.sides(work.handedness);
    let frame = place::frame(work, sides)?;
    let step = work.rate.frame_time();
    let frames = |seconds: f64| ((seconds / step).round() as usize).max(1);
    work.sample(&[0.0]);
    work.notes.clear();
    let mut did = Vec::new();
    let mut shapes = Vec::new();
    let mut apex = work.clone();
    for &side in sides {
        let pose = given
            .shape
            .and_then(<[_]>::first)
            .cloned()
            .unwrap_or_else(index_finger);
        let joints = poses::rotations(&work.skeleton, &work.anatomy, side, &pose);
        for (joint, rotation) in joints.ok_or(Cause::NoFingers(side))? {
            apex.channels[joint].rotations[0] = rotation;
        }
        let at = given.place.map(|input| &input.at);
        let target = frame
            .spot(work, &settings.at, at, side)
            .ok_or(Cause::NoMeaning {
                value: settings.at.to_string(),
                what: "landmark that this skeleton has",
            })?;
        let missed = aim(&mut apex, &frame, side, target)?;
        did.push(format!(
            "the {} index finger's line passes {:.1} mm beside the target",
            side.name(),
            missed * 1000.0
        ));
        shapes.push((side, pose));
    }
    let seconds = match settings.via.time {
        Some(time) => time.0,
        None => {
            let mut reaching = work.clone();
            reaching.sample(&[0.0; REACH_STEPS + 1]);
            carry(&mut reaching, &apex, sides, courses, |step| {
                step as f64 / REACH_STEPS as f64
            });
            let seconds = usual_time(&reaching, sides, given.reaches)?;
            did.push(format!("reaching takes {seconds:.2} s"));
            seconds
        }
    };
    let (reach, hold) = (
        frames(seconds),
        frames(settings.hold.map_or(HOLD, |it| it.0)),
    );
    let total = 2 * reach + hold;
    join::check_length(work, total)?;
    work.sample(&vec![0.0; total]);
    carry(work, &apex, sides, courses, |frame| {
        frame.min(total - 1 - frame) as f64 / reach as f64
    });
    for (side, pose) in shapes {
        note(work, side, &pose, reach..reach + hold);
    }
    work.notes.push(Note {
        hand: None,
        about: About::Gloss,
        value: Reading::Value("point".into()),
        span: work.span(),
        origin: settings.to_string(),
    });
    let changed = sides
        .iter()
        .flat_map(|&s| [Group::Arm(s), Group::Fingers(s)]);
    work.changed(changed.collect::<Vec<_>>(), &settings.to_string());
    Ok((did, 0.0))
}

/// Carries arms and hands from the posture of each frame to that of `apex`; `out` is the share of a reach at a frame.
fn carry(
    work: &mut Work,
    apex: &Work,
    sides: &[Side],
    courses: &Courses,
    out: impl Fn(usize) -> f64,
) {
    let groups = groups(&work.skeleton, &work.anatomy);
    for (joint, group) in groups.iter().enumerate() {
        // Hands take their shape in the first half of reaching, and lose it in the last half of retraction.
        let (early, course) = match group {
            Group::Fingers(side) if sides.contains(side) => (2.0, &courses.fingers),
            Group::Arm(side) if sides.contains(side) => (1.0, &courses.arms),
            _ => continue,
        };
        let top = apex.channels[joint].rotations[0];
        for (frame, rotation) in work.channels[joint].rotations.iter_mut().enumerate() {
            *rotation = course.rotation(*rotation, top, (out(frame) * early).min(1.0));
        }
    }
}

/// Returns the time of a reach in seconds: at the mean speed of captured ones, if they are known, and never so short that
/// a wrist would be faster than those of signers. `reaching` goes from rest to the apex in [`REACH_STEPS`] steps.
fn usual_time(
    reaching: &Work,
    sides: &[Side],
    reaches: Option<&LearnedReaches>,
) -> Result<f64, Cause> {
    let mut seconds = reaches.map_or(REACH, |_| 0.0);
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

fn note(work: &mut Work, side: Side, pose: &HandPose, frames: std::ops::Range<usize>) {
    work.notes.push(Note {
        hand: Some(side),
        about: About::Component(Component::Configuration, None),
        value: pose.value.clone().map_or(Reading::Unset, Reading::Value),
        span: work.rate.span(frames),
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
    fingers[Finger::Index.index()] = FingerAngles::default();
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
    }
}

/// Moves arm and hand of a posture so that the index finger's line meets the target; returns the distance by which it
/// misses.
fn aim(apex: &mut Work, frame: &Frame, side: Side, target: DVec3) -> Result<f64, Cause> {
    let chain = apex.anatomy.arm(side).ok_or(Cause::NoArm(side))?;
    let model = ModelPose::of(&apex.skeleton, &apex.pose(0));
    let shoulder = model.position(chain.upper);
    let direction = (target - shoulder).normalize_or(frame.forward);
    let down = if direction.y.abs() > 0.9 {
        frame.forward
    } else {
        DVec3::NEG_Y
    };
    let palm = (down - frame.left * (0.3 * side.sign())).reject_from_normalized(direction);
    let rotation = apex
        .anatomy
        .hand_rotation(side, direction, palm)
        .ok_or(Cause::NoFingers(side))?;
    let length = |model: &ModelPose| {
        finger(apex, model, side).map(|(_, tip)| tip.distance(model.position(chain.hand)))
    };
    let hand = length(&model).unwrap_or(0.18).max(0.15);
    let stretch = (STRETCH * crate::body::arm_length(apex, side).unwrap_or(frame.arm))
        .min(shoulder.distance(target) - hand - SHORT_OF)
        .max(0.25 * frame.arm);
    let mut hands = [rotation];
    let mut wrist = [shoulder + direction * stretch];
    let mut missed = f64::INFINITY;
    for _ in 0..8 {
        arm::raise_arm(apex, side, &wrist, &hands, frame.left * side.sign())
            .ok_or(Cause::NoArm(side))?;
        let model = ModelPose::of(&apex.skeleton, &apex.pose(0));
        let (base, tip) = finger(apex, &model, side).ok_or(Cause::NoFingers(side))?;
        let line = (tip - base).normalize_or(direction);
        let to = target - base;
        missed = to.reject_from_normalized(line).length();
        if missed < 1e-5 || line.dot(to) <= 0.0 {
            break;
        }
        // A rotation about the finger's base makes the line meet the target at once, if the arm follows.
        let turn = DQuat::from_rotation_arc(line, to.normalize_or(line));
        hands = [(turn * hands[0]).normalize()];
        wrist = [base - turn * (base - model.position(chain.hand))];
    }
    Ok(missed)
}

/// Returns the base and the tip of the index finger.
fn finger(work: &Work, model: &ModelPose, side: Side) -> Option<(DVec3, DVec3)> {
    let base = work.anatomy.joint(Part::Finger(side, Finger::Index, 1))?;
    let name = format!("{}-index-tip", side.name());
    let tip = work.anatomy.landmark(&work.skeleton, model, &name)?;
    Some((model.position(base), tip))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sources::{Meaning, Value};
    use crate::testing::Shelf;

    #[test]
    fn a_pointing_hand_has_the_value_that_it_shows() {
        let mut shelf = Shelf::new();
        let angles = index_finger().angles;
        let found = poses::nearest_value(&shelf, &angles);
        assert_eq!(found, None, "no value is near enough");
        let index = Value {
            id: "1".into(),
            inventory: "configurations".into(),
            meaning: Some(Meaning::Hand(angles)),
        };
        shelf.values.push((Component::Configuration, index));
        let recipe: crate::Recipe = "point right at 30cm,140cm,50cm".parse().expect("a recipe");
        let resolved = crate::resolve(&recipe, &shelf).expect("resolved");
        let made = crate::evaluate(&resolved).expect("made");
        let shown = made
            .notes
            .iter()
            .find(|note| note.about == About::Component(Component::Configuration, None));
        assert_eq!(shown.and_then(|note| note.value.value()), Some("1"));
    }
}
