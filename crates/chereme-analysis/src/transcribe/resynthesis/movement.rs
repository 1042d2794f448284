//! Verifies movements by re-synthesis: similar movements are animated, and the one that moves the hands as observed is
//! kept.
//!
//! The path of a hand hardly depends on its place. So the movement can be verified before the place is known: the paths
//! of observed and re-synthesised hands are compared from their first frames on.

use chereme_motion::HandAngles;
use chereme_sign::hamnosys::{MotionKind, Place, Posture};

use super::actions::{self, similar};
use super::regrouped::regrouped;
use super::unrolled::unrolled;
use super::*;

/// The most whole signs that are synthesised in search of the movement of one sign.
pub(super) const MOST_MOVEMENTS: usize = 800;

/// The number of signs that are synthesised at once: their clips are in memory together.
const AT_ONCE: usize = 32;

/// A hand that is farther off in a frame than this (m) counts as no farther: a wrong start of one action displaces all
/// later ones.
const FARTHEST: f64 = 0.1;

/// The deviation (m) for each second by which the synthesised sign is shorter or longer.
const LONGER: f64 = 0.009;

/// The deviation (m) of fingers that are off by a radian, in hand lengths.
const FINGERS: f64 = 0.25;

/// The posture of a hand in one frame: its wrist, the end of its middle metacarpal in m, and its finger angles.
type HandPosture = ([DVec3; 2], HandAngles);

impl Proof<'_, '_> {
    /// Searches for actions that move the hands as observed, at the places of a trial. Replaces one property after the
    /// other. Returns `None` if the inferred actions do so, or no others come much nearer.
    pub(super) fn moved(&self, at: &Trial) -> Option<Vec<Motion>> {
        let numbers = &tuned().resynthesis;
        let [part] = self.inferred.parts.as_slice() else {
            return None;
        };
        let inferred = self.deviations(at, vec![part.actions.clone()]);
        let (first, _) = inferred.into_iter().next()?;
        let mut best = self.nearest(at, (first, part.actions.clone()));
        // If the hands begin elsewhere, a place at the end of a path leads them astray.
        let free: Vec<Motion> = part.actions.iter().map(actions::untargeted).collect();
        if best.0 >= numbers.exact && free != part.actions {
            let from = self.deviations(at, vec![free]);
            let others = from.into_iter().map(|from| self.nearest(at, from));
            best = others.fold(
                best,
                |best, other| if other.0 < best.0 { other } else { best },
            );
        }
        let (least, mut actions) = best;
        if least >= numbers.convincing * first {
            return None;
        }
        // Without an exact match, a rest only makes up for the duration of a misread movement.
        let unrested = |all: &[Motion]| all.iter().map(actions::unrested).collect::<Vec<_>>();
        if least >= numbers.exact && unrested(&part.actions) == part.actions {
            actions = unrested(&actions);
        }
        Some(actions).filter(|actions| *actions != part.actions)
    }

    /// Replaces one property of actions after the other, as long as the hands come nearer: returns the actions found
    /// and their deviation (m).
    fn nearest(
        &self,
        at: &Trial,
        (mut least, mut actions): (f64, Vec<Motion>),
    ) -> (f64, Vec<Motion>) {
        let numbers = &tuned().resynthesis;
        let posture = at.sign(&self.inferred).parts.swap_remove(0).posture;
        for _ in 0..numbers.moved {
            if least < numbers.exact {
                break;
            }
            let mut others = similar(&actions);
            others.extend(self.targeted(&actions));
            others.extend(unrolled_in(&actions, &posture));
            others.extend(regrouped(&actions));
            let best = self.deviations(at, others).into_iter();
            let best = best.min_by(|a, b| a.0.total_cmp(&b.0));
            let Some(best) = best.filter(|it| it.0 < numbers.nearer * least) else {
                break;
            };
            (least, actions) = best;
        }
        (least, actions)
    }

    /// Synthesises a trial with each list of actions. Returns the deviations (m) of those that can be synthesised.
    fn deviations(&self, at: &Trial, all: Vec<Vec<Motion>>) -> Vec<(f64, Vec<Motion>)> {
        let mut found = Vec::new();
        for all in all.chunks(AT_ONCE) {
            let left = self.movements.get();
            let all = &all[..all.len().min(left)];
            self.movements.set(left - all.len());
            let signs = all.iter().map(|actions| {
                let mut sign = self.inferred.clone();
                sign.parts[0].actions.clone_from(actions);
                self.notated(at.sign(&sign))
            });
            let clips = self.performs.perform_all(&signs.collect::<Vec<_>>());
            let clips = all.iter().zip(clips);
            found
                .extend(clips.filter_map(|(actions, clip)| {
                    Some((self.deviation(&clip?)?, actions.clone()))
                }));
        }
        found
    }

    /// Returns lists of actions that differ from `actions` in the place at which one of them ends.
    fn targeted(&self, actions: &[Motion]) -> Vec<Vec<Motion>> {
        let mut all = Vec::new();
        for (k, action) in actions.iter().enumerate() {
            let stage = self.stages.iter().find(|it| it.action == Some(k + 1));
            let ends = stage.map(|stage| self.ends(action, stage.frames));
            for place in ends.into_iter().flatten() {
                if let Some(motion) = actions::targeting(action, &place) {
                    let mut other = actions.to_vec();
                    other[k] = motion;
                    all.push(other);
                }
            }
        }
        all
    }

    /// Returns the likeliest places at the end of an action between two frames.
    fn ends(&self, action: &Motion, (first, end): (usize, usize)) -> Vec<Place> {
        let [sites, pairs] = tuned().resynthesis.targets;
        let lead = match self.begun.stand {
            Stand::One(n, _) => n,
            _ => 0,
        };
        let Some(track) = self.sight.scene.hands[lead].as_ref() else {
            return Vec::new();
        };
        let last = end.min(track.wrist.len()).saturating_sub(1);
        let first = first.min(last);
        // The end of a repeated path is its farthest point from the start.
        let farther = |a: &usize, b: &usize| {
            let from = |frame: usize| track.wrist[frame].distance(track.wrist[first]);
            from(*a).total_cmp(&from(*b))
        };
        let frame = match action.kind {
            MotionKind::Repeated { .. } => (first..=last).max_by(farther),
            _ => None,
        };
        let Some(body) = self.sight.body(frame.unwrap_or(last)) else {
            return Vec::new();
        };
        let on_body = body.likeliest(lead, self.begun.symmetric, sites);
        let on_body = on_body.into_iter().map(|placed| Place::Body(placed.place));
        let mut all: Vec<Place> = on_body.collect();
        if !self.begun.alone {
            let pairs = body.likeliest_pairs(pairs).into_iter();
            all.extend(pairs.map(|together| Place::Hands(tree::meeting(&together))));
        }
        all
    }

    /// Returns how far (m) the hands in a clip move from the observed ones, on average over frames: the distance of both
    /// ends of the hand, compared from the first frame on, and the difference of the fingers.
    pub(super) fn deviation(&self, clip: &Clip) -> Option<f64> {
        let scene = self.sight.scene;
        let from = self.compared_from();
        let observed = scene.clip.frames() - from;
        let begins = self.hands_in(clip, 0)?;
        let (mut sum, mut count) = (0.0, 0);
        let mut there = begins;
        for frame in 0..observed.max(clip.frames()) {
            if frame < clip.frames() {
                there = self.hands_in(clip, frame)?;
            }
            let own = from + frame.min(observed - 1);
            for n in self.beyond([f64::INFINITY; 2], 0.0) {
                let (Some(track), Some((there, angles)), Some((begins, _))) =
                    (scene.hands[n].as_ref(), there[n], begins[n])
                else {
                    continue;
                };
                let ends = |frame: usize| {
                    let wrist = track.wrist[frame];
                    [wrist, wrist + track.along[frame] * scene.hand]
                };
                let (now, at_first) = (ends(own), ends(from));
                for end in 0..2 {
                    let path = now[end] - at_first[end];
                    let apart = path.distance(there[end] - begins[end]);
                    sum += apart.min(FARTHEST) / 2.0;
                }
                sum += FINGERS * scene.hand * track.known.apart(&track.angles[own], &angles);
                count += 1;
            }
        }
        let longer = scene.seconds(observed.abs_diff(clip.frames()));
        Some(sum / f64::from(count.max(1)) + LONGER * longer)
    }

    /// Returns the hands in a frame of a synthesised clip, in the signer's own space.
    fn hands_in(&self, clip: &Clip, frame: usize) -> Option<[Option<HandPosture>; 2]> {
        let scene = self.sight.scene;
        let pose = clip.pose(frame);
        let model = clip.model_pose(frame);
        let axes = Axes::of(scene.anatomy, scene.alone, &model, scene.dominant)?;
        Some(scene.hands.each_ref().map(|track| {
            let side = track.as_ref()?.side;
            let wrist = axes.place(model.position(scene.anatomy.arm(side)?.hand));
            let along = axes.direction(scene.anatomy.hand_direction(side, &model)?);
            let angles = scene.anatomy.hand_angles(clip.skeleton(), side, &pose);
            let ends = [wrist, wrist + along * scene.hand];
            Some((ends, angles.unwrap_or_default()))
        }))
    }
}

/// Returns lists of actions in which one repeated action is written there and back; `posture` is that before the first.
fn unrolled_in(actions: &[Motion], posture: &Posture) -> Vec<Vec<Motion>> {
    let each = actions.iter().enumerate();
    each.flat_map(|(k, action)| {
        unrolled(action, posture).into_iter().map(move |other| {
            let mut all = actions.to_vec();
            all[k] = other;
            all
        })
    })
    .collect()
}
