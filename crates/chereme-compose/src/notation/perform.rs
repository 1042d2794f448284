//! Synthesises one sign after another on the same body: whole, or only its first posture.

use std::sync::Arc;

use chereme_motion::Clip;
use chereme_sign::hamnosys::Notated;

use super::pace::Paces;
use super::plan::Planner;
use super::solve::Arm;
use super::stage::Stage;
use super::{
    Goals, NotationError, Settings, animate, duration, frames, lay, nonmanual, standing, track,
};
use crate::outcome::About;
use crate::sources::Material;

/// Seconds before and after the first posture that are computed with it: the arm takes from several solutions the one that
/// changes least in the movement that follows, and sudden changes are spread over the time around them.
const AROUND: [f64; 2] = [0.5, 1.0];

/// A body that performs many signs, one at a time.
pub struct Performer {
    stage: Material,
    body: Stage,
    settings: Settings,
    paces: Paces,
}

impl Performer {
    /// Takes the body from the first frame of the material.
    ///
    /// # Errors
    /// [`NotationError::NoArm`] if the body has no arm.
    pub fn new(stage: Material, settings: Settings) -> Result<Self, NotationError> {
        let body = Stage::of(&stage).ok_or_else(|| NotationError::NoArm(stage.address.clone()))?;
        Ok(Self {
            paces: Paces::of(&settings.language),
            stage,
            body,
            settings,
        })
    }

    /// Returns the settings of the animator.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Returns the movement of a sign as [`animate`] synthesises it, without the paths from and to rest.
    ///
    /// # Errors
    /// The same as [`animate`]'s.
    pub fn performs(&self, sign: &Notated) -> Result<Clip, NotationError> {
        let made = animate(&[sign], &self.stage, &self.settings)?;
        let clip = made.clip;
        let mut glosses = made.notes.iter().filter(|note| note.about == About::Gloss);
        Ok(match glosses.next() {
            Some(note) => {
                let [first, last] =
                    [note.span.start(), note.span.end()].map(|at| clip.rate().frame_at(at));
                clip.slice(first..last + 1)
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
    pub fn begins(&self, sign: &Notated) -> Result<Clip, NotationError> {
        let (body, rate) = (&self.body, self.settings.rate.per_second());
        let language = (&self.settings.language, &self.paces);
        let planner = || Planner::new(body, language, self.stage.handedness, rate);
        let limits = planner().signer.limits;
        let (plan, _) = duration::plan_timed(&[sign], |signs| planner().signs(signs));
        let sides = plan.sides;
        let total = frames(plan.end, rate)?;
        let reached = plan.signs.first().map_or(0.0, |sign| sign.from);
        let frame = ((reached * rate + 1e-6) as usize).min(total - 1);
        let [before, after] = AROUND.map(|seconds| (seconds * rate).ceil() as usize);
        let span = frame.saturating_sub(before)..(frame + after + 1).min(total);
        let timing = track::Timing {
            paces: &self.paces,
            rate,
            total,
        };
        let mut channels = standing(body, 1);
        let hands = sides.map(|side| body.hand(side));
        let language = &self.settings.language;
        let Goals { alive, wanted, .. } = Goals::of(body, &[sign], &plan, language, &timing);
        for (n, (hand, wanted)) in hands.into_iter().zip(wanted).enumerate() {
            let Some(hand) = hand else { continue };
            let solver = Arm::of(body, hand, &limits);
            let (_, got) = solver.over_time(&wanted.cut(span.clone()), rate);
            let got = &got[frame - span.start];
            let fingers = track::fingers(body, hand, &plan, n, &timing).into_iter();
            let track = track::ArmTrack {
                arm: hand
                    .rig
                    .rotations(&got.posed, got.rotation)
                    .map(|at| vec![at]),
                fingers: fingers.map(|column| vec![column[frame]]).collect(),
                fit: track::Fit::default(),
            };
            lay(&mut channels, hand, track);
        }
        nonmanual::turn(body, &alive.bents, &[(frame, 0.0)], &mut channels);
        let (skeleton, rate) = (Arc::clone(&body.skeleton), self.settings.rate);
        Ok(Clip::new(skeleton, rate, channels)?)
    }
}

#[cfg(test)]
mod tests {
    use chereme_motion::{Anatomy, Rate, Side};
    use chereme_sign::Handedness;
    use chereme_sign::hamnosys::{from_names, parse};

    use super::*;
    use crate::testing::{Axes, skeleton};

    const SIGNS: [&str; 5] = [
        "hamflathand hamextfingerul hampalmd hamchest",
        "hamfinger2 hamextfingeru hampalml hamchin hamtouch hammoveo",
        "hamfist hamextfingerol hampalmd hamshoulders hamlrat hamclose hammoved",
        "hamsymmlr hamflathand hamextfingeruo hampalml hamstomach hammoveu hamrepeatfromstart",
        "hampinch12 hamextfingeru hampalml hamforehead hamclose hamcirclel",
    ];

    fn performer(rate: u32) -> Performer {
        let rate = Rate::new(rate, 1).expect("a rate");
        let skeleton = Arc::new(skeleton(Axes::Plain, 1.0));
        let stage = Material {
            address: "stage".into(),
            hash: String::new(),
            gloss: String::new(),
            signer: None,
            handedness: Handedness::Right,
            anatomy: Arc::new(Anatomy::detect(&skeleton)),
            clip: Clip::still(skeleton, rate, 1),
            curves: Vec::new(),
            held: Vec::new(),
        };
        let settings = Settings {
            rate,
            ..Settings::default()
        };
        Performer::new(stage, settings).expect("a body")
    }

    fn sign(names: &str) -> Notated {
        let text = from_names(names.split(' ')).expect("names of symbols");
        let sign = parse(&text).expect("HamNoSys").sign;
        Notated {
            sign,
            ..Notated::default()
        }
    }

    #[test]
    fn the_initial_posture_equals_the_first_frame_of_the_movement() {
        let performer = performer(60);
        for names in SIGNS {
            let sign = sign(names);
            let (begun, whole) = (performer.begins(&sign), performer.performs(&sign));
            let (begun, whole) = (begun.expect("a posture"), whole.expect("movement"));
            assert_eq!(begun.frames(), 1);
            assert!(whole.frames() > 1, "{names}");
            let [one, first] = [&begun, &whole].map(|clip| clip.model_pose(0));
            for side in Side::BOTH {
                let hand = performer.stage.anatomy.arm(side).expect("an arm").hand;
                let off = one.position(hand).distance(first.position(hand));
                let turned = one.rotation(hand).angle_between(first.rotation(hand));
                assert!(off < 2e-3 && turned < 0.05, "{names}: {off} {turned}");
            }
            for &joint in &performer.body.hand(Side::Right).expect("a hand").fingers {
                let [a, b] = [&begun, &whole].map(|clip| clip.pose(0).rotations[joint]);
                assert!(a.angle_between(b) < 0.01, "{names}");
            }
        }
    }

    #[test]
    fn first_postures_are_reached_in_a_frame_at_any_rate() {
        for rate in [24, 25, 30, 50, 60, 120] {
            let performer = performer(rate);
            let rate = performer.settings().rate;
            // Signs whose time is not stretched.
            for names in [SIGNS[0], SIGNS[2], SIGNS[3]] {
                let sign = sign(names);
                let made = animate(&[&sign], &performer.stage, performer.settings());
                let made = made.expect("movement");
                let gloss = made.notes.iter().find(|note| note.about == About::Gloss);
                let reached = gloss.expect("a gloss").span.start();
                let frame = rate.instant(rate.frame_at(reached));
                let off = (reached.micros() - frame.micros()).abs();
                assert!(off <= 1, "{names}: {off} microseconds from a frame");
            }
        }
    }

    #[test]
    fn performing_gives_the_sign_without_approach_and_return() {
        let performer = performer(60);
        let still = performer.performs(&sign(SIGNS[0])).expect("movement");
        let hold = performer.settings().language.time_hold;
        let frames = still.frames() as f64;
        assert!((frames / 60.0 - hold).abs() < 0.05, "{frames} frames");
        let mut body = performer.stage.clone();
        body.clip = body.clip.slice(0..0);
        let nobody = Performer::new(body, Settings::default());
        assert!(matches!(nobody, Err(NotationError::NoArm(_))));
    }
}
