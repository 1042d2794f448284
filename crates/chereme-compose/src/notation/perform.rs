//! Synthesises one sign after another on the same body: whole, or only its first posture.

use std::sync::Arc;

use chereme_motion::Clip;
use chereme_sign::hamnosys::NotatedSign;

use super::notation_plan::SignPlanner;
use super::notation_solve::ArmSolver;
use super::notation_stage::StandingBody;
use super::pace::PaceTables;
use super::{
    AnimatorSettings, BothHandGoals, NotationError, animate_signs, duration, frames_for_duration, lay_arm_track,
    notation_nonmanual, notation_track, standing_channels,
};
use crate::outcome::NoteSubject;
use crate::sources::MovementMaterial;

/// Seconds before and after the first posture that are computed with it: the arm takes from several solutions the one that
/// changes least in the movement that follows, and sudden changes are spread over the time around them.
const AROUND_POSTURE_S: [f64; 2] = [0.5, 1.0];

/// A body that performs many signs, one at a time.
pub struct SignPerformer {
    stage: MovementMaterial,
    body: StandingBody,
    settings: AnimatorSettings,
    paces: PaceTables,
}

impl SignPerformer {
    /// Takes the body from the first frame of the material.
    ///
    /// # Errors
    /// [`NotationError::NoArm`] if the body has no arm.
    pub fn new(stage: MovementMaterial, settings: AnimatorSettings) -> Result<Self, NotationError> {
        let body =
            StandingBody::body_from_material(&stage).ok_or_else(|| NotationError::NoArm(stage.address.clone()))?;
        Ok(Self {
            paces: PaceTables::pace_tables_from_language(&settings.language),
            stage,
            body,
            settings,
        })
    }

    /// Returns the settings of the animator.
    #[must_use]
    pub fn performer_settings(&self) -> &AnimatorSettings {
        &self.settings
    }

    /// Returns the movement of a sign as [`animate_signs`] synthesises it, without the paths from and to rest.
    ///
    /// # Errors
    /// The same as [`animate_signs`]'s.
    pub fn perform_sign(&self, sign: &NotatedSign) -> Result<Clip, NotationError> {
        let made = animate_signs(&[sign], &self.stage, &self.settings)?;
        let clip = made.clip;
        let mut glosses = made.notes.iter().filter(|note| note.about == NoteSubject::Gloss);
        Ok(match glosses.next() {
            Some(note) => {
                let [first, last] = [note.span.span_start_instant(), note.span.span_end_instant()]
                    .map(|at| clip.clip_frame_rate().nearest_frame_at(at));
                clip.slice_clip_frames(first..last + 1)
            }
            None => clip,
        })
    }

    /// Returns the body at the moment when it reaches the first posture of a sign, as a clip of one frame.
    ///
    /// Only that posture is computed, at about a tenth of the cost of the whole sign. It differs from the
    /// first frame of the whole sign by influences of distant frames on the arm and by stretched time: by
    /// at most 2 mm for four signs out of five.
    ///
    /// # Errors
    /// [`NotationError`] if the movement would be too long.
    pub fn perform_first_posture(&self, sign: &NotatedSign) -> Result<Clip, NotationError> {
        let (body, rate) = (&self.body, self.settings.rate.per_second());
        let language = &self.settings.language;
        let planner = || SignPlanner::new(body, language, &self.paces, self.stage.handedness, rate);
        let limits = planner().signer.limits;
        let (plan, _) = duration::plan_timed(&[sign], |signs| planner().plan_signs(signs));
        let sides = plan.sides;
        let total = frames_for_duration(plan.end, rate)?;
        let reached = plan.signs.first().map_or(0.0, |sign| sign.from);
        let frame = ((reached * rate + 1e-6) as usize).min(total - 1);
        let [before, after] = AROUND_POSTURE_S.map(|seconds| (seconds * rate).ceil() as usize);
        let span = frame.saturating_sub(before)..(frame + after + 1).min(total);
        let timing = notation_track::AnimationTiming {
            paces: &self.paces,
            rate,
            total,
        };
        let mut channels = standing_channels(body, 1);
        let hands = sides.map(|side| body.hand_of_side(side));
        let language = &self.settings.language;
        let BothHandGoals { alive, wanted, .. } =
            BothHandGoals::goals_from_plan(body, &[sign], &plan, language, &timing);
        for (n, (hand, wanted)) in hands.into_iter().zip(wanted).enumerate() {
            let Some(hand) = hand else { continue };
            let solver = ArmSolver::solver_for_hand(body, hand, &limits);
            let (_, got) = solver.over_time(&wanted.cut_goal_frames(span.clone()), rate);
            let solved_frame = &got[frame - span.start];
            let fingers = notation_track::finger_rotation_frames(body, hand, &plan, n, &timing).into_iter();
            let track = notation_track::ArmTrack {
                arm: hand
                    .rig
                    .arm_joint_rotations(&solved_frame.posed, solved_frame.rotation)
                    .map(|at| vec![at]),
                fingers: fingers.map(|column| vec![column[frame]]).collect(),
                fit: notation_track::HandGoalFit::default(),
            };
            lay_arm_track(&mut channels, hand, track);
        }
        notation_nonmanual::turn_body_joints(body, &alive.bents, &[(frame, 0.0)], &mut channels);
        let (skeleton, rate) = (Arc::clone(&body.skeleton), self.settings.rate);
        Ok(Clip::new(skeleton, rate, channels)?)
    }
}

#[cfg(test)]
mod tests {
    use chereme_motion::{BodyAnatomy, BodySide, FrameRate};
    use chereme_sign::SignerHandedness;
    use chereme_sign::hamnosys::{from_names, parse_hamnosys};

    use super::*;
    use crate::testing::{Axes, skeleton};

    const SIGNS: [&str; 5] = [
        "hamflathand hamextfingerul hampalmd hamchest",
        "hamfinger2 hamextfingeru hampalml hamchin hamtouch hammoveo",
        "hamfist hamextfingerol hampalmd hamshoulders hamlrat hamclose hammoved",
        "hamsymmlr hamflathand hamextfingeruo hampalml hamstomach hammoveu hamrepeatfromstart",
        "hampinch12 hamextfingeru hampalml hamforehead hamclose hamcirclel",
    ];

    fn performer(rate: u32) -> SignPerformer {
        let rate = FrameRate::new(rate, 1).expect("a rate");
        let skeleton = Arc::new(skeleton(Axes::Plain, 1.0));
        let stage = MovementMaterial {
            address: "stage".into(),
            hash: String::new(),
            gloss: String::new(),
            signer: None,
            handedness: SignerHandedness::Right,
            anatomy: Arc::new(BodyAnatomy::detect_anatomy(&skeleton)),
            clip: Clip::from_rest_pose(skeleton, rate, 1),
            curves: Vec::new(),
            held: Vec::new(),
        };
        let settings = AnimatorSettings {
            rate,
            ..AnimatorSettings::default()
        };
        SignPerformer::new(stage, settings).expect("a body")
    }

    fn sign(names: &str) -> NotatedSign {
        let text = from_names(names.split(' ')).expect("names of symbols");
        let sign = parse_hamnosys(&text).expect("HamNoSys").sign;
        NotatedSign {
            sign,
            ..NotatedSign::default()
        }
    }

    #[test]
    fn the_initial_posture_equals_the_first_frame_of_the_movement() {
        let performer = performer(60);
        for names in SIGNS {
            let sign = sign(names);
            let (begun, whole) = (performer.perform_first_posture(&sign), performer.perform_sign(&sign));
            let (begun, whole) = (begun.expect("a posture"), whole.expect("movement"));
            assert_eq!(begun.clip_frame_count(), 1);
            assert!(whole.clip_frame_count() > 1, "{names}");
            let [one, first] = [&begun, &whole].map(|clip| clip.model_pose(0));
            for side in BodySide::BOTH_SIDES {
                let hand = performer.stage.anatomy.arm_chain(side).expect("an arm").hand;
                let off = one
                    .model_joint_position(hand)
                    .distance(first.model_joint_position(hand));
                let turned = one
                    .model_joint_rotation(hand)
                    .angle_between(first.model_joint_rotation(hand));
                assert!(off < 2e-3 && turned < 0.05, "{names}: {off} {turned}");
            }
            for &joint in &performer.body.hand_of_side(BodySide::Right).expect("a hand").fingers {
                let [a, b] = [&begun, &whole].map(|clip| clip.clip_pose_at(0).rotations[joint]);
                assert!(a.angle_between(b) < 0.01, "{names}");
            }
        }
    }

    #[test]
    fn first_postures_are_reached_in_a_frame_at_any_rate() {
        for rate in [24, 25, 30, 50, 60, 120] {
            let performer = performer(rate);
            let rate = performer.performer_settings().rate;
            // Signs whose time is not stretched.
            for names in [SIGNS[0], SIGNS[2], SIGNS[3]] {
                let sign = sign(names);
                let made = animate_signs(&[&sign], &performer.stage, performer.performer_settings());
                let made = made.expect("movement");
                let gloss = made.notes.iter().find(|note| note.about == NoteSubject::Gloss);
                let reached = gloss.expect("a gloss").span.span_start_instant();
                let frame = rate.frame_start_instant(rate.nearest_frame_at(reached));
                let off = (reached.instant_micros() - frame.instant_micros()).abs();
                assert!(off <= 1, "{names}: {off} microseconds from a frame");
            }
        }
    }

    #[test]
    fn performing_gives_the_sign_without_approach_and_return() {
        let performer = performer(60);
        let still = performer.perform_sign(&sign(SIGNS[0])).expect("movement");
        let hold = performer.performer_settings().language.time_hold;
        let frames = still.clip_frame_count() as f64;
        assert!((frames / 60.0 - hold).abs() < 0.05, "{frames} frames");
        let mut body = performer.stage.clone();
        body.clip = body.clip.slice_clip_frames(0..0);
        let nobody = SignPerformer::new(body, AnimatorSettings::default());
        assert!(matches!(nobody, Err(NotationError::NoArm(_))));
    }
}
