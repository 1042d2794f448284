//! Verifies orientations by re-synthesis.
//!
//! A hand whose wrist or forearm stops it is turned less than it is written. The animator turns a similar reading nearly as
//! much less: so the written orientation is near the observed one, turned back by what an earlier trial lacks.

use chereme_sign::hamnosys::{EachHand, orientation};
use glam::DQuat;

use super::*;
use crate::transcribe::aim::{self, AimReadingSettings};
use crate::transcribe::transcribe_scene::rotation_from_axes;

/// A hand that re-synthesis turns at least this far (rad) from the observed one may have another orientation.
const MIN_TURN_RADIANS: f64 = 0.035;

/// The error (m) of a hand that is turned a radian from the observed one.
const PER_RADIAN: f64 = 0.07;

/// How often the orientation is corrected.
const ORIENTATION_CORRECTION_ROUNDS: usize = 3;

/// The number of orientations that are tried with each correction.
const TRIED_ORIENTATIONS: usize = 8;

/// Other orientations are kept if the error of the hands is below this share of what it was.
const KEPT_ORIENTATION_SHARE: f64 = 0.5;

/// The hands of a synthesised clip's first frame beside the observed ones.
struct ComparedHands {
    /// The rotation that takes each hand to the observed one.
    twists: [DQuat; 2],
    /// The error (m) of the hands, in place and orientation together.
    error: f64,
}

impl TrialResynthesis<'_, '_> {
    /// Returns the reading with other orientations if re-synthesis puts the hands much nearer to the observed ones.
    pub(super) fn rather_turned(&self, own: VerifiedReading) -> VerifiedReading {
        let Some(turned) = self.righted(&own.trial) else {
            return own;
        };
        let error = |trial: &ReadingTrial| {
            let clip = self.performs.synthesise_notated_sign(&self.tried_sign(trial))?;
            Some(self.compare_first_hands(&clip, &self.written_for(trial))?.error)
        };
        let (Some(before), Some(other)) = (error(&own.trial), self.verify_first_posture(turned)) else {
            return own;
        };
        match error(&other.trial) {
            Some(after) if after < KEPT_ORIENTATION_SHARE * before => other,
            _ => own,
        }
    }

    /// Searches for orientations that turn the hands as observed, at the places of a trial. Returns `None` if the trial's
    /// own do so, or no others come nearer.
    fn righted(&self, from: &ReadingTrial) -> Option<ReadingTrial> {
        let mut trial = from.clone();
        let hands = self.written_for(&trial);
        let begins = |trial: &ReadingTrial| {
            let clip = self.performs.synthesise_first_posture(&self.tried_sign(trial))?;
            self.compare_first_hands(&clip, &hands)
        };
        let mut best = begins(&trial)?;
        if hands
            .iter()
            .all(|&n| twist_rotation_angle(best.twists[n]) < MIN_TURN_RADIANS)
        {
            return None;
        }
        for _ in 0..ORIENTATION_CORRECTION_ROUNDS {
            let least = best.error;
            for &n in &hands {
                let others = self.turned_by(&trial, n, best.twists[n]);
                let signs: Vec<NotatedSign> = others.iter().map(|other| self.tried_sign(other)).collect();
                let begun_trials = others.into_iter().zip(self.performs.begin_all(&signs));
                let measured_trials =
                    begun_trials.filter_map(|(other, clip)| Some((self.compare_first_hands(&clip?, &hands)?, other)));
                let nearest = measured_trials.min_by(|a, b| a.0.error.total_cmp(&b.0.error));
                if let Some(nearest) = nearest.filter(|candidate| candidate.0.error < best.error) {
                    (best, trial) = nearest;
                }
            }
            if best.error >= least {
                break;
            }
        }
        trial.turned.iter().any(Option::is_some).then_some(trial)
    }

    /// Returns the hands whose orientations a trial's notation writes.
    fn written_for(&self, trial: &ReadingTrial) -> Vec<usize> {
        let sign = trial.apply_trial_places(&self.inferred);
        let Some(part) = sign.parts.first() else {
            return Vec::new();
        };
        let lead = match self.begun.stand {
            PlaceNotation::One(n, _) if self.begun.alone => n,
            _ => 0,
        };
        let hands = match &part.posture.extended {
            EachHand::Unset => Vec::new(),
            EachHand::Shared(_) => vec![lead],
            EachHand::Split(own, other) => {
                let both = [own.is_some(), other.is_some()];
                (0..2).filter(|&n| both[n]).collect()
            }
        };
        let faces = |n: &usize| self.sight.scene.hands[*n].as_ref().is_some_and(|turned| turned.faces);
        hands.into_iter().filter(faces).collect()
    }

    /// Returns trials with the orientations nearest to that of a trial, turned by `twist`.
    fn turned_by(&self, trial: &ReadingTrial, n: usize, twist: DQuat) -> Vec<ReadingTrial> {
        let sign = trial.apply_trial_places(&self.inferred);
        let track = self.sight.scene.hands[n].as_ref();
        let (Some(part), Some(track)) = (sign.parts.first(), track) else {
            return Vec::new();
        };
        let written = hand_written_value(&part.posture.extended, n).zip(hand_written_value(&part.posture.palm, n));
        let Some((extended, palm)) = written else {
            return Vec::new();
        };
        let along = aim::notated_aim_vector(extended);
        let normal = DVec3::from(orientation::palm_direction_vector(along.to_array(), palm.aim_angle()));
        let how = AimReadingSettings {
            between: true,
            loose: self.sight.scene.loose,
        };
        let all = aim::likeliest_orientations(twist * along, twist * normal, None, how, TRIED_ORIENTATIONS).into_iter();
        let observed = [track.along[self.begun.frame], track.normal[self.begun.frame]];
        let all = all.map(|turned| {
            let mut other = trial.clone();
            other.turned[n] = Some(turned.seen_from(observed));
            other
        });
        all.collect()
    }

    fn compare_first_hands(&self, clip: &Clip, hands: &[usize]) -> Option<ComparedHands> {
        let scene = self.sight.scene;
        let frame = self.compared_from();
        let model = clip.model_pose(0);
        let axes = LevelSignerAxes::read_signer_axes(scene.anatomy, scene.alone, &model, scene.dominant)?;
        let twists = scene.hands.each_ref().map(|track| {
            let track = track.as_ref()?;
            let along = axes.signer_direction_of(scene.anatomy.hand_direction(track.side, &model)?);
            let normal = axes.signer_direction_of(scene.anatomy.palm_normal(track.side, &model)?);
            Some(track.turned[frame] * rotation_from_axes(along, normal).inverse())
        });
        let twists = twists.map(Option::unwrap_or_default);
        let off = self.observed_hand_distances(clip)?;
        let each = hands
            .iter()
            .map(|&n| off[n] + PER_RADIAN * twist_rotation_angle(twists[n]));
        Some(ComparedHands {
            twists,
            error: each.sum(),
        })
    }
}

/// Returns the value for hand `n`.
fn hand_written_value<T>(each: &EachHand<T>, n: usize) -> Option<&T> {
    match each {
        EachHand::Unset => None,
        EachHand::Shared(value) => Some(value),
        EachHand::Split(own, other) => [own.as_ref(), other.as_ref()][n],
    }
}

/// Returns the angle of a rotation, in radians.
fn twist_rotation_angle(twist: DQuat) -> f64 {
    twist.angle_between(DQuat::IDENTITY)
}
