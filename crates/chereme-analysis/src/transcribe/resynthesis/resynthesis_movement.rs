//! Verifies movements by re-synthesis: similar movements are animated, and the one that moves the hands as observed is
//! kept.
//!
//! The path of a hand hardly depends on its place. So the movement can be verified before the place is known: the paths
//! of observed and re-synthesised hands are compared from their first frames on.

use chereme_motion::HandAngles;
use chereme_sign::hamnosys::{HandPlace, MotionKind, NotatedPosture};

use super::regrouped::regroup_action_lists;
use super::resynthesis_actions::{self, similar_action_lists};
use super::unrolled::unroll_repeated_motion;
use super::*;

/// The most whole signs that are synthesised in search of the movement of one sign.
pub(super) const MOST_MOVEMENTS: usize = 800;

/// The number of signs that are synthesised at once: their clips are in memory together.
const MAX_CONCURRENT_SIGNS: usize = 32;

/// A hand that is farther off in a frame than this (m) counts as no farther: a wrong start of one action displaces all
/// later ones.
const MAX_HAND_ERROR_METRES: f64 = 0.1;

/// The deviation (m) for each second by which the synthesised sign is shorter or longer.
const DURATION_DEVIATION_METRES: f64 = 0.009;

/// The deviation (m) of fingers that are off by a radian, in hand lengths.
const FINGER_DEVIATION_METRES: f64 = 0.25;

/// The posture of a hand in one frame: its wrist, the end of its middle metacarpal in m, and its finger angles.
type HandPosture = ([DVec3; 2], HandAngles);

impl TrialResynthesis<'_, '_> {
    /// Searches for actions that move the hands as observed, at the places of a trial. Replaces one property after the
    /// other. Returns `None` if the inferred actions do so, or no others come much nearer.
    pub(super) fn search_moving_actions(&self, at: &ReadingTrial) -> Option<Vec<NotatedMotion>> {
        let numbers = &tuned().resynthesis;
        let [part] = self.inferred.parts.as_slice() else {
            return None;
        };
        let inferred = self.deviations(at, vec![part.actions.clone()]);
        let (first, _) = inferred.into_iter().next()?;
        let mut best = self.replace_action_properties(at, first, part.actions.clone());
        // If the hands begin elsewhere, a place at the end of a path leads them astray.
        let free: Vec<NotatedMotion> = part
            .actions
            .iter()
            .map(resynthesis_actions::without_target_place)
            .collect();
        if best.0 >= numbers.exact && free != part.actions {
            let freed = self.deviations(at, vec![free]).into_iter();
            let others = freed.map(|(deviation, actions)| self.replace_action_properties(at, deviation, actions));
            best = others.fold(best, |best, other| if other.0 < best.0 { other } else { best });
        }
        let (least, mut actions) = best;
        if least >= numbers.convincing * first {
            return None;
        }
        // Without an exact match, a rest only makes up for the duration of a misread movement.
        let unrested = |all: &[NotatedMotion]| {
            all.iter()
                .map(resynthesis_actions::without_motion_rests)
                .collect::<Vec<_>>()
        };
        if least >= numbers.exact && unrested(&part.actions) == part.actions {
            actions = unrested(&actions);
        }
        Some(actions).filter(|actions| *actions != part.actions)
    }

    /// Replaces one property of actions after the other, as long as the hands come nearer: returns the actions found
    /// and their deviation (m).
    fn replace_action_properties(
        &self,
        at: &ReadingTrial,
        mut least: f64,
        mut actions: Vec<NotatedMotion>,
    ) -> (f64, Vec<NotatedMotion>) {
        let numbers = &tuned().resynthesis;
        let posture = at.apply_trial_places(&self.inferred).parts.swap_remove(0).posture;
        for _ in 0..numbers.moved {
            if least < numbers.exact {
                break;
            }
            let mut others = similar_action_lists(&actions);
            others.extend(self.targeted(&actions));
            others.extend(unrolled_in(&actions, &posture));
            others.extend(regroup_action_lists(&actions));
            let candidates = self.deviations(at, others).into_iter();
            let best = candidates.min_by(|a, b| a.0.total_cmp(&b.0));
            let Some(best) = best.filter(|candidate| candidate.0 < numbers.nearer * least) else {
                break;
            };
            (least, actions) = best;
        }
        (least, actions)
    }

    /// Synthesises a trial with each list of actions. Returns the deviations (m) of those that can be synthesised.
    fn deviations(&self, at: &ReadingTrial, all: Vec<Vec<NotatedMotion>>) -> Vec<(f64, Vec<NotatedMotion>)> {
        let mut results = Vec::new();
        for all in all.chunks(MAX_CONCURRENT_SIGNS) {
            let left = self.movements.get();
            let all = &all[..all.len().min(left)];
            self.movements.set(left - all.len());
            let signs = all.iter().map(|actions| {
                let mut sign = self.inferred.clone();
                sign.parts[0].actions.clone_from(actions);
                self.to_notated_sign(at.apply_trial_places(&sign))
            });
            let performed_clips = self.performs.perform_all(&signs.collect::<Vec<_>>());
            let clips = all.iter().zip(performed_clips);
            results.extend(
                clips.filter_map(|(actions, clip)| Some((self.hand_movement_deviation(&clip?)?, actions.clone()))),
            );
        }
        results
    }

    /// Returns lists of actions that differ from `actions` in the place at which one of them ends.
    fn targeted(&self, actions: &[NotatedMotion]) -> Vec<Vec<NotatedMotion>> {
        let mut all = Vec::new();
        for (k, action) in actions.iter().enumerate() {
            let stage = self.stages.iter().find(|stage| stage.action == Some(k + 1));
            let ends = stage.map(|stage| self.likeliest_end_places(action, stage.frames.0, stage.frames.1));
            for place in ends.into_iter().flatten() {
                if let Some(motion) = resynthesis_actions::with_target_place(action, &place) {
                    let mut other = actions.to_vec();
                    other[k] = motion;
                    all.push(other);
                }
            }
        }
        all
    }

    /// Returns the likeliest places at the end of an action between two frames.
    fn likeliest_end_places(&self, action: &NotatedMotion, first: usize, end: usize) -> Vec<HandPlace> {
        let [sites, pairs] = tuned().resynthesis.targets;
        let lead = match self.begun.stand {
            PlaceNotation::One(n, _) => n,
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
        let Some(body) = self.sight.cached_body_at(frame.unwrap_or(last)) else {
            return Vec::new();
        };
        let placed_sites = body.rank_hand_places(lead, self.begun.symmetric, sites);
        let on_body = placed_sites.into_iter().map(|placed| HandPlace::Body(placed.place));
        let mut all: Vec<HandPlace> = on_body.collect();
        if !self.begun.alone {
            let pairs = body.likeliest_pairs(pairs).into_iter();
            all.extend(pairs.map(|together| HandPlace::Hands(transcribe_tree::placeless_constellation(&together))));
        }
        all
    }

    /// Returns how far (m) the hands in a clip move from the observed ones, on average over frames: the distance of both
    /// ends of the hand, compared from the first frame on, and the difference of the fingers.
    pub(super) fn hand_movement_deviation(&self, clip: &Clip) -> Option<f64> {
        let scene = self.sight.scene;
        let from = self.compared_from();
        let observed = scene.clip.clip_frame_count() - from;
        let begins = self.hands_in(clip, 0)?;
        let (mut sum, mut count) = (0.0, 0);
        // A synthesised sign that is shorter stays in its last posture.
        let mut there = begins;
        for frame in 0..observed.max(clip.clip_frame_count()) {
            if frame < clip.clip_frame_count() {
                there = self.hands_in(clip, frame)?;
            }
            let observed_frame = from + frame.min(observed - 1);
            for n in self.hands_beyond_distance([f64::INFINITY; 2], 0.0) {
                let (Some(track), Some((there, angles)), Some((begins, _))) =
                    (scene.hands[n].as_ref(), there[n], begins[n])
                else {
                    continue;
                };
                let ends = |frame: usize| {
                    let wrist = track.wrist[frame];
                    [wrist, wrist + track.along[frame] * scene.hand]
                };
                let (now, at_first) = (ends(observed_frame), ends(from));
                for end in 0..2 {
                    // Paths are compared and not places: a wrong start is left to the search for places.
                    let path = now[end] - at_first[end];
                    let apart = path.distance(there[end] - begins[end]);
                    sum += apart.min(MAX_HAND_ERROR_METRES) / 2.0;
                }
                sum += FINGER_DEVIATION_METRES
                    * scene.hand
                    * track
                        .known
                        .known_angle_difference(&track.angles[observed_frame], &angles);
                count += 1;
            }
        }
        let longer = scene.frames_to_seconds(observed.abs_diff(clip.clip_frame_count()));
        Some(sum / f64::from(count.max(1)) + DURATION_DEVIATION_METRES * longer)
    }

    /// Returns the hands in a frame of a synthesised clip, in the signer's own space.
    fn hands_in(&self, clip: &Clip, frame: usize) -> Option<[Option<HandPosture>; 2]> {
        let scene = self.sight.scene;
        let pose = clip.clip_pose_at(frame);
        let model = clip.model_pose(frame);
        let axes = LevelSignerAxes::read_signer_axes(scene.anatomy, scene.alone, &model, scene.dominant)?;
        Some(scene.hands.each_ref().map(|track| {
            let side = track.as_ref()?.side;
            let wrist = axes.signer_place_of(model.model_joint_position(scene.anatomy.arm_chain(side)?.hand));
            let along = axes.signer_direction_of(scene.anatomy.hand_direction(side, &model)?);
            let angles = scene.anatomy.hand_angles(clip.clip_skeleton(), side, &pose);
            let ends = [wrist, wrist + along * scene.hand];
            Some((ends, angles.unwrap_or_default()))
        }))
    }
}

/// Returns lists of actions in which one repeated action is written there and back; `posture` is that before the first.
fn unrolled_in(actions: &[NotatedMotion], posture: &NotatedPosture) -> Vec<Vec<NotatedMotion>> {
    let each = actions.iter().enumerate();
    each.flat_map(|(k, action)| {
        unroll_repeated_motion(action, posture).into_iter().map(move |other| {
            let mut all = actions.to_vec();
            all[k] = other;
            all
        })
    })
    .collect()
}
