//! Verifies orientations by re-synthesis.
//!
//! A hand whose wrist or forearm stops it is turned less than it is written. The animator turns a similar reading nearly as
//! much less: so the written orientation is near the observed one, turned back by what an earlier trial lacks.

use chereme_sign::hamnosys::{Each, orientation};
use glam::DQuat;

use super::*;
use crate::transcribe::aim::{self, How};
use crate::transcribe::scene::rotation;

/// A hand that re-synthesis turns at least this far (rad) from the observed one may have another orientation.
const OTHERWISE: f64 = 0.035;

/// The error (m) of a hand that is turned a radian from the observed one.
const PER_RADIAN: f64 = 0.07;

/// How often the orientation is corrected.
const ROUNDS: usize = 3;

/// The number of orientations that are tried with each correction.
const TRIED: usize = 8;

/// Other orientations are kept if the error of the hands is below this share of what it was.
const CONVINCING: f64 = 0.5;

/// The hands of a synthesised clip's first frame beside the observed ones.
struct Beside {
    /// The rotation that takes each hand to the observed one.
    twists: [DQuat; 2],
    /// The error (m) of the hands, in place and orientation together.
    error: f64,
}

impl Proof<'_, '_> {
    /// Returns the reading with other orientations if re-synthesis puts the hands much nearer to the observed ones.
    pub(super) fn rather_turned(&self, own: Verified) -> Verified {
        let Some(turned) = self.righted(&own.trial) else {
            return own;
        };
        let error = |trial: &Trial| {
            let clip = self.performs.performs(&self.tried_sign(trial))?;
            Some(self.beside(&clip, &self.written_for(trial))?.error)
        };
        let (Some(before), Some(other)) = (error(&own.trial), self.verified(turned)) else {
            return own;
        };
        match error(&other.trial) {
            Some(after) if after < CONVINCING * before => other,
            _ => own,
        }
    }

    /// Searches for orientations that turn the hands as observed, at the places of a trial. Returns `None` if the trial's
    /// own do so, or no others come nearer.
    fn righted(&self, from: &Trial) -> Option<Trial> {
        let mut trial = from.clone();
        let hands = self.written_for(&trial);
        let begins = |trial: &Trial| {
            let clip = self.performs.begins(&self.tried_sign(trial))?;
            self.beside(&clip, &hands)
        };
        let mut best = begins(&trial)?;
        if hands.iter().all(|&n| angle(best.twists[n]) < OTHERWISE) {
            return None;
        }
        for _ in 0..ROUNDS {
            let least = best.error;
            for &n in &hands {
                let others = self.turned_by(&trial, n, best.twists[n]);
                let signs: Vec<Notated> = others.iter().map(|it| self.tried_sign(it)).collect();
                let found = others.into_iter().zip(self.performs.begin_all(&signs));
                let found =
                    found.filter_map(|(other, clip)| Some((self.beside(&clip?, &hands)?, other)));
                let nearest = found.min_by(|a, b| a.0.error.total_cmp(&b.0.error));
                if let Some(nearest) = nearest.filter(|it| it.0.error < best.error) {
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
    fn written_for(&self, trial: &Trial) -> Vec<usize> {
        let sign = trial.sign(&self.inferred);
        let Some(part) = sign.parts.first() else {
            return Vec::new();
        };
        let lead = match self.begun.stand {
            Stand::One(n, _) if self.begun.alone => n,
            _ => 0,
        };
        let hands = match &part.posture.extended {
            Each::Unset => Vec::new(),
            Each::Shared(_) => vec![lead],
            Each::Split(own, other) => {
                let both = [own.is_some(), other.is_some()];
                (0..2).filter(|&n| both[n]).collect()
            }
        };
        let faces = |n: &usize| {
            self.sight.scene.hands[*n]
                .as_ref()
                .is_some_and(|it| it.faces)
        };
        hands.into_iter().filter(faces).collect()
    }

    /// Returns trials with the orientations nearest to that of a trial, turned by `twist`.
    fn turned_by(&self, trial: &Trial, n: usize, twist: DQuat) -> Vec<Trial> {
        let sign = trial.sign(&self.inferred);
        let track = self.sight.scene.hands[n].as_ref();
        let (Some(part), Some(track)) = (sign.parts.first(), track) else {
            return Vec::new();
        };
        let written = written(&part.posture.extended, n).zip(written(&part.posture.palm, n));
        let Some((extended, palm)) = written else {
            return Vec::new();
        };
        let along = aim::vector(extended);
        let normal = DVec3::from(orientation::palm(along.to_array(), palm.angle()));
        let how = How {
            between: true,
            loose: self.sight.scene.loose,
        };
        let all = aim::turned(twist * along, twist * normal, None, how, TRIED).into_iter();
        let observed = [
            track.along[self.begun.frame],
            track.normal[self.begun.frame],
        ];
        let all = all.map(|turned| {
            let mut other = trial.clone();
            other.turned[n] = Some(turned.seen_from(observed));
            other
        });
        all.collect()
    }

    fn beside(&self, clip: &Clip, hands: &[usize]) -> Option<Beside> {
        let scene = self.sight.scene;
        let frame = self.compared_from();
        let model = clip.model_pose(0);
        let axes = Axes::of(scene.anatomy, scene.alone, &model, scene.dominant)?;
        let twists = scene.hands.each_ref().map(|track| {
            let track = track.as_ref()?;
            let along = axes.direction(scene.anatomy.hand_direction(track.side, &model)?);
            let normal = axes.direction(scene.anatomy.palm_normal(track.side, &model)?);
            Some(track.turned[frame] * rotation(along, normal).inverse())
        });
        let twists = twists.map(Option::unwrap_or_default);
        let off = self.off(clip)?;
        let each = hands
            .iter()
            .map(|&n| off[n] + PER_RADIAN * angle(twists[n]));
        Some(Beside {
            twists,
            error: each.sum(),
        })
    }
}

/// Returns the value for hand `n`.
fn written<T>(each: &Each<T>, n: usize) -> Option<&T> {
    match each {
        Each::Unset => None,
        Each::Shared(value) => Some(value),
        Each::Split(own, other) => [own.as_ref(), other.as_ref()][n],
    }
}

/// Returns the angle of a rotation, in radians.
fn angle(twist: DQuat) -> f64 {
    twist.angle_between(DQuat::IDENTITY)
}
