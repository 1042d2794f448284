//! Verifies movements and places by re-synthesis: candidates are animated, and the one that puts the hands where they
//! were observed is reported.
//!
//! The first reading comes from the hand's position alone. But the animator pushes a hand out of the trunk
//! that should touch it, keeps it clear of the other hand, stops it at its joint limits, and lets it give way to its
//! arm. The right notation, animated by the same rules, puts the hand within a fraction of a millimetre of the observed
//! position, and few others do. If the movement is misread, even the right place misses it by some millimetres: so similar
//! movements are animated first, and the one that moves the hands as observed is reported.

mod homing;
mod regrouped;
pub(super) mod replaced;
mod reshaped;
mod resynthesis_actions;
mod resynthesis_movement;
mod resynthesis_nonmanual;
#[cfg(test)]
mod tests;
mod turning;
mod unrolled;

use std::cell::Cell;

use chereme_motion::Clip;
use chereme_sign::hamnosys::{EachHand, HamnosysSign, NonmanualActs, NotatedMotion, NotatedSign};
use glam::DVec3;

use super::aim::OrientationReading;
use super::transcribe_place::{LikelyHandPlace, PosedBody};
use super::transcribe_scene::LevelSignerAxes;
use super::transcribe_tree::{self, BegunPosture, PickedReadings, PlaceNotation, SceneReadings};
use super::{NotationSynthesiser, TokenTranscription, TranscriptionStage};
use crate::transcribe::transcribe_tuned::tuned;
use homing::TrialSearch;

/// The most postures that are synthesised in one search for the places of a sign.
const MOST_POSTURES: usize = 1000;

/// The most searches for the places of a sign: a second one follows if the places of the first one explain the movement.
const MAX_PLACE_SEARCHES: usize = 2;

/// The most postures and movements that are synthesised for one sign: each search is repeated with other orientations.
pub const MOST_TRIALS: usize = 2 * MAX_PLACE_SEARCHES * MOST_POSTURES + resynthesis_movement::MOST_MOVEMENTS;

/// Writes the notation of a scene; with `performs`, verifies movements and places by re-synthesis.
pub(super) fn write_verified_notation<'a>(
    sight: &'a SceneReadings<'a>,
    performs: Option<&dyn NotationSynthesiser>,
) -> TokenTranscription {
    let (first, begun) = transcribe_tree::write_scene_notation(sight, PickedReadings::default());
    let (Some(begun), Some(performs)) = (begun, performs) else {
        return first;
    };
    let Some(mut body) = sight.read_uncached_body(begun.frame) else {
        return first;
    };
    if let Some(by) = begun.behind {
        body.shift_body_hand(1, by);
    }
    let mut proof = TrialResynthesis {
        sight,
        performs,
        begun: &begun,
        inferred: first.sign.clone(),
        nonmanual: NonmanualActs::default(),
        stages: &first.stages,
        body,
        postures: Cell::new(0),
        movements: Cell::new(resynthesis_movement::MOST_MOVEMENTS),
    };
    let mut best = VerifiedReading {
        trial: proof.first_trial(),
        picked: None,
        off: [0.0; 2],
    };
    proof.nonmanual = proof.find_nonmanual_acts(&best.trial);
    // Places and movement depend on each other: each search goes on from the result of the other.
    for search in 0..MAX_PLACE_SEARCHES {
        let moved = proof.search_moving_actions(&best.trial);
        let settled = search > 0 && (moved.is_none() || proof.missing_hands(best.off).is_empty());
        if let Some(actions) = moved {
            proof.inferred.parts[0].actions = actions;
        }
        if settled {
            break;
        }
        let Some(verified) = proof.verify_first_posture(proof.first_trial()) else {
            break;
        };
        best = proof.rather_turned(verified);
    }
    proof.reported(first.clone(), best)
}

/// The reading of the first posture that re-synthesis prefers.
struct VerifiedReading {
    trial: ReadingTrial,
    /// The readings that it fixes, if it replaces the first reading.
    picked: Option<PickedReadings>,
    /// The error of each hand, in metres.
    off: [f64; 2],
}

/// An alternative reading of the first posture.
#[derive(Clone)]
struct ReadingTrial {
    stand: PlaceNotation,
    turned: [Option<OrientationReading>; 2],
    /// Whether the hands mirror each other at first, but act separately afterwards.
    mirrored: bool,
    /// Whether the actions are left out.
    still: bool,
}

/// A trial with the result of its re-synthesis.
#[derive(Clone)]
struct TriedReading {
    trial: ReadingTrial,
    /// Its penalty in nepers; the simplest reading, if exact, has none.
    total: f64,
    /// How far it is from the observed hands, in nepers: as `total`, with a penalty that grows evenly with the error.
    near: f64,
    /// The error of each hand: the distance between its observed and its re-synthesised position, in
    /// metres.
    off: [f64; 2],
    /// The errors of the hands that have notation together, in metres.
    error: f64,
    /// The middle of each hand as observed, less its middle after re-synthesis, in metres.
    aside: [DVec3; 2],
    /// The part of `aside` that the whole sign adds to the first posture alone, or is expected to add, in metres.
    drift: [DVec3; 2],
    /// Whether the whole sign was synthesised.
    whole: bool,
    /// The error of each hand in the first posture alone, in metres.
    posed: [f64; 2],
}

impl ReadingTrial {
    fn with_place_notation(&self, stand: PlaceNotation) -> Self {
        Self { stand, ..self.clone() }
    }

    /// Returns whether the places of both trials have the same form of notation.
    fn has_form_of(&self, other: &Self) -> bool {
        let form = |trial: &Self| (std::mem::discriminant(&trial.stand), trial.mirrored);
        form(self) == form(other)
    }

    /// Returns the penalty (nepers) of the notation itself.
    fn trial_notation_penalty(&self) -> f64 {
        let placement_cost = |placed: &LikelyHandPlace| placed.score - placed.unlikely;
        let stand: f64 = match &self.stand {
            PlaceNotation::One(_, placed) => placement_cost(placed),
            PlaceNotation::Each(both) => both.iter().flatten().map(placement_cost).sum(),
            PlaceNotation::Together(together, at) => together.together_notation_penalty() + placement_cost(at),
            PlaceNotation::Unsaid => 0.0,
        };
        let turned = self.turned.iter().flatten().map(|turned| turned.less);
        stand + turned.sum::<f64>()
    }

    /// Returns the penalty (nepers) of each hand's distance from its place, for a hand that re-synthesis
    /// does not explain.
    fn unexplained_place_penalties(&self) -> [f64; 2] {
        match &self.stand {
            PlaceNotation::One(_, placed) | PlaceNotation::Together(_, placed) => [placed.unlikely; 2],
            PlaceNotation::Each(both) => both
                .each_ref()
                .map(|placed| placed.as_ref().map_or(0.0, |placed| placed.unlikely)),
            PlaceNotation::Unsaid => [0.0; 2],
        }
    }

    /// Returns the sign `inferred` with this trial's places and orientations.
    fn apply_trial_places(&self, inferred: &HamnosysSign) -> HamnosysSign {
        fn put_each_value<T>(each: &mut EachHand<T>, n: usize, value: T) {
            match each {
                EachHand::Shared(own) => *own = value,
                EachHand::Split(a, b) => *[a, b][n] = Some(value),
                EachHand::Unset => {}
            }
        }
        let mut sign = inferred.clone();
        for part in &mut sign.parts {
            part.posture.place = self.stand.notated_place();
            if self.still {
                part.actions.clear();
            }
            if self.mirrored {
                transcribe_tree::mirror_first_posture(part);
            }
            for (n, turned) in self.turned.iter().enumerate() {
                if let Some(turned) = turned {
                    put_each_value(&mut part.posture.extended, n, turned.extended.best);
                    put_each_value(&mut part.posture.palm, n, turned.palm.best);
                }
            }
        }
        sign
    }
}

impl TriedReading {
    /// Returns the reading that the trial fixes.
    fn into_verified_reading(self) -> VerifiedReading {
        let middle = |placed: &LikelyHandPlace| {
            let mut sites = placed.place.site.iter().chain(&placed.place.second);
            sites.all(|site| site.side.is_none())
        };
        let trial = ReadingTrial {
            still: false,
            ..self.trial
        };
        let stand = match trial.stand.clone() {
            PlaceNotation::Each([Some(own), Some(other)])
                if trial.mirrored && own.place == other.place && middle(&own) =>
            {
                PlaceNotation::One(0, own)
            }
            stand => stand,
        };
        let picked = PickedReadings {
            stand: Some(stand),
            turned: trial.turned.clone(),
            mirrored: trial.mirrored,
        };
        VerifiedReading {
            trial,
            picked: Some(picked),
            off: self.off,
        }
    }
}

struct TrialResynthesis<'a, 'p> {
    sight: &'a SceneReadings<'a>,
    performs: &'p dyn NotationSynthesiser,
    begun: &'p BegunPosture,
    /// The first reading, with the movement that was found.
    inferred: HamnosysSign,
    /// The acts of trunk, head and shoulders that were found.
    nonmanual: NonmanualActs,
    /// The posture and the actions of the first reading, with their frames.
    stages: &'p [TranscriptionStage],
    body: PosedBody<'a>,
    /// The number of postures that may still be synthesised.
    postures: Cell<usize>,
    /// The number of whole signs that may still be synthesised in search of the movement.
    movements: Cell<usize>,
}

impl TrialResynthesis<'_, '_> {
    /// Returns a sign with the acts of the body.
    fn to_notated_sign(&self, sign: HamnosysSign) -> NotatedSign {
        NotatedSign {
            sign,
            nonmanual: self.nonmanual.clone(),
            ..NotatedSign::default()
        }
    }

    /// Returns a trial's sign with the acts of the body.
    fn tried_sign(&self, trial: &ReadingTrial) -> NotatedSign {
        self.to_notated_sign(trial.apply_trial_places(&self.inferred))
    }

    fn first_trial(&self) -> ReadingTrial {
        ReadingTrial {
            stand: self.begun.stand.clone(),
            turned: [None, None],
            mirrored: false,
            still: false,
        }
    }

    /// Returns the preferred reading, the places of `first` or others; `None` if `first` cannot be synthesised.
    fn verify_first_posture(&self, first: ReadingTrial) -> Option<VerifiedReading> {
        self.postures.set(MOST_POSTURES);
        let begun = self.begun_as(first.clone())?;
        let kept = |off| {
            let is_own = first.turned.iter().all(Option::is_none);
            let tried = TriedReading { off, ..begun.clone() };
            let picked = if is_own {
                None
            } else {
                tried.into_verified_reading().picked
            };
            VerifiedReading {
                trial: first.clone(),
                picked,
                off,
            }
        };
        // A first reading that already puts the hands there needs no search.
        if self
            .hands_beyond_distance(begun.off, tuned().resynthesis.sure)
            .is_empty()
        {
            return Some(kept(begun.off));
        }
        // A reading that says less is preferred if it explains the hands as well.
        if let Some(unsaid) = self.unsaid(&first) {
            return Some(unsaid);
        }
        let finished_trial = self.synthesise_whole_trial(&begun)?;
        let best = self.search_hand_reading(&finished_trial);
        Some(match self.is_better(&best, &finished_trial) {
            true => best.into_verified_reading(),
            false => kept(finished_trial.off),
        })
    }

    /// Searches for the reading that puts the hands where they were observed.
    fn search_hand_reading(&self, first: &TriedReading) -> TriedReading {
        let [rounds, few] = tuned().resynthesis.rounds;
        let mut search = TrialSearch::search_from_trial(first.clone());
        let others = self.other_forms(&first.trial).into_iter();
        search.add_search_trials(self.begin_all(others.map(Self::without_drift)));
        self.try_likely_places(&mut search, rounds);
        if self.missing_hands(search.best.off).is_empty() {
            return search.best;
        }
        self.widen_place_search(&mut search);
        if self.missing_hands(search.best.off).is_empty() {
            return search.best;
        }
        let turned: Vec<_> = (0..2).flat_map(|n| self.trial_other_orientations(&search, n)).collect();
        let mut otherwise = search.with_trials_only(self.begin_all(turned));
        self.try_likely_places(&mut otherwise, few);
        // Orientations are measured well: only an exact match speaks against them.
        if self.missing_hands(otherwise.best.off).is_empty() {
            return otherwise.best;
        }
        // A wrong reading of the actions may displace the hand.
        let still_trial = ReadingTrial {
            still: true,
            ..search.best.trial.clone()
        };
        let mut still = search.with_trials_only(self.begin_all([Self::without_drift(still_trial)]));
        self.try_likely_places(&mut still, few);
        still.best
    }

    /// Returns whether another reading should replace the first one: it must be likelier, and match (or its first posture
    /// alone), or miss the hands by much less.
    fn is_better(&self, other: &TriedReading, first: &TriedReading) -> bool {
        let numbers = &tuned().resynthesis;
        let matches = self.hands_beyond_distance(other.off, numbers.almost).is_empty();
        let posed = self.hands_beyond_distance(other.posed, numbers.exact).is_empty();
        let surely = self.hands_beyond_distance(other.off, numbers.sure).is_empty();
        let rather = if surely { 0.0 } else { numbers.rather };
        other.total < first.total - rather && (matches || posed || other.error < numbers.less * first.error)
    }

    /// Returns the reading without any place, if re-synthesis of it puts the hands where they were
    /// observed.
    fn unsaid(&self, first: &ReadingTrial) -> Option<VerifiedReading> {
        let begun = self.begun_as(first.with_place_notation(PlaceNotation::Unsaid))?;
        if !self.missing_hands(begun.off).is_empty() {
            return None;
        }
        let finished_trial = self.synthesise_whole_trial(&begun)?;
        self.hands_beyond_distance(finished_trial.off, tuned().resynthesis.exact)
            .is_empty()
            .then(|| finished_trial.into_verified_reading())
    }

    fn begun_as(&self, trial: ReadingTrial) -> Option<TriedReading> {
        self.begin_all([Self::without_drift(trial)]).pop()
    }

    fn without_drift(trial: ReadingTrial) -> (ReadingTrial, [DVec3; 2]) {
        (trial, [DVec3::ZERO; 2])
    }

    /// Returns the hands that miss their observed position: those whose error `off` is above
    /// `resynthesis.nearly`, both in metres.
    fn missing_hands(&self, off: [f64; 2]) -> Vec<usize> {
        self.hands_beyond_distance(off, tuned().resynthesis.nearly)
    }

    /// Returns the hands whose error is above `within` metres; a hand at rest, which has no notation, does
    /// not count.
    fn hands_beyond_distance(&self, off: [f64; 2], within: f64) -> Vec<usize> {
        let counts = |n: &usize| match &self.begun.stand {
            PlaceNotation::One(own, _) if self.begun.alone => own == n,
            _ => true,
        };
        (0..2).filter(counts).filter(|&n| off[n] > within).collect()
    }

    /// Returns trials with the other forms of notation for the places of two hands: as a constellation, or
    /// separately.
    fn other_forms(&self, from: &ReadingTrial) -> Vec<ReadingTrial> {
        if self.begun.alone {
            return Vec::new();
        }
        let likeliest = |n: usize| self.body.rank_hand_places(n, self.begun.symmetric, 1).pop();
        let mirrored_places = [0, 1].map(|n| self.body.rank_hand_places(n, true, 1).pop());
        let mirrored = ReadingTrial {
            mirrored: true,
            ..from.with_place_notation(PlaceNotation::Each(mirrored_places))
        };
        // Hands that act alike mirror each other anyway.
        let mirrored = Some(mirrored).filter(|_| !self.begun.symmetric);
        let apart = match &from.stand {
            PlaceNotation::Together(..) if self.begun.symmetric => {
                likeliest(0).map(|placed| PlaceNotation::One(0, placed))
            }
            PlaceNotation::Together(..) => Some(PlaceNotation::Each([0, 1].map(likeliest))),
            _ => None,
        };
        let pairs = self.body.likeliest_pairs(tuned().resynthesis.pairs[0]);
        let together = pairs.into_iter().filter_map(|together| {
            let shared_place = self.body.likeliest_shared(&together, 1).pop()?;
            Some(PlaceNotation::Together(together, shared_place))
        });
        let stands = apart.into_iter().chain(together);
        let all = stands.map(|stand| from.with_place_notation(stand));
        mirrored.into_iter().chain(all).collect()
    }

    /// Returns trials with other orientations of hand `n`, at the places where it came nearest.
    fn trial_other_orientations(&self, search: &TrialSearch, n: usize) -> Vec<(ReadingTrial, [DVec3; 2])> {
        let track = self.sight.scene.hands[n].as_ref();
        let Some(track) = track.filter(|track| track.faces) else {
            return Vec::new();
        };
        if !self.missing_hands(search.best.off).contains(&n) {
            return Vec::new();
        }
        let turns = self
            .sight
            .read_hand_orientations(track, self.begun.frame, tuned().resynthesis.turns + 1);
        let near = search.beam.iter().take(tuned().resynthesis.turned_at);
        // The first orientation is the one that has been tried.
        let each = near.flat_map(|tried| {
            turns.iter().skip(1).map(|turned| {
                let mut trial = tried.trial.clone();
                trial.turned[n] = Some(turned.clone());
                (trial, tried.drift)
            })
        });
        each.collect()
    }

    /// Synthesises the first posture of trials, each with the offset (m) that the whole sign is expected to add to
    /// its hands.
    fn begin_all(&self, trials: impl IntoIterator<Item = (ReadingTrial, [DVec3; 2])>) -> Vec<TriedReading> {
        let trials = trials.into_iter().take_while(|_| {
            let left = self.postures.get();
            self.postures.set(left.saturating_sub(1));
            left > 0
        });
        let trials: Vec<_> = trials.collect();
        let signs = trials.iter().map(|(trial, _)| self.tried_sign(trial));
        let clips = self.performs.begin_all(&signs.collect::<Vec<_>>());
        let begun = trials.into_iter().zip(clips);
        let begun = begun.filter_map(|((trial, drift), clip)| self.compare_trial_clip(trial, &clip?, Some(drift)));
        begun.collect()
    }

    /// Returns the transcription of a verified reading. Findings say what re-synthesis corrected and what it does not
    /// explain.
    fn reported(&self, first: TokenTranscription, best: VerifiedReading) -> TokenTranscription {
        let actions = self.inferred.parts[0].actions.clone();
        let inferred = first.sign.parts[0].actions.clone();
        let mut transcription = match best.picked {
            Some(picked) => transcribe_tree::write_scene_notation(self.sight, picked).0,
            None => first,
        };
        transcription.nonmanual.clone_from(&self.nonmanual);
        let read = transcription.sign.clone();
        if actions != inferred {
            let part = &mut transcription.sign.parts[0];
            part.actions.clone_from(&actions);
            if best.trial.mirrored {
                transcribe_tree::mirror_first_posture(part);
            }
        }
        // The trial may have left out the actions or written them in other words.
        let performed = |sign: &HamnosysSign| {
            let clip = self
                .performs
                .synthesise_notated_sign(&self.to_notated_sign(sign.clone()))?;
            Some((
                self.observed_hand_distances(&clip)?,
                self.hand_movement_deviation(&clip)?,
            ))
        };
        let Some((off, after)) = performed(&transcription.sign) else {
            transcription.sign = read;
            return transcription;
        };
        if actions != inferred
            && let Some((_, before)) = performed(&read)
        {
            let several = self.sight.scene.language.repeat_several;
            let actions = [&*inferred, &*actions];
            replaced::replace_transcribed_actions(&mut transcription, actions, [before, after], several);
        } else if after > tuned().resynthesis.nearly {
            transcription.findings.push(format!(
                "re-synthesised, the movement is {:.1} cm from the observed one",
                100.0 * after
            ));
        }
        for n in self.missing_hands(off) {
            if let Some(track) = &self.sight.scene.hands[n] {
                transcription.findings.push(format!(
                    "re-synthesised, the {} hand begins {:.1} cm from its observed place",
                    track.side.body_side_name(),
                    100.0 * off[n]
                ));
            }
        }
        transcription
    }

    /// Synthesises the whole sign of a trial.
    fn synthesise_whole_trial(&self, begun: &TriedReading) -> Option<TriedReading> {
        let performed_clip = self.performs.synthesise_notated_sign(&self.tried_sign(&begun.trial))?;
        let mut finished_trial = self.compare_trial_clip(begun.trial.clone(), &performed_clip, None)?;
        for (n, drift) in finished_trial.drift.iter_mut().enumerate() {
            *drift = finished_trial.aside[n] - (begun.aside[n] - begun.drift[n]);
        }
        // If the movement is misread, only the first posture matches.
        let numbers = &tuned().resynthesis;
        let matches = |off: f64| numbers.posed + 0.5 * (off / numbers.nearly).powi(2);
        finished_trial.posed = begun.posed;
        let posed = self.trial_error_penalty(&finished_trial.trial, begun.posed.map(matches));
        finished_trial.total = finished_trial
            .total
            .min(finished_trial.trial.trial_notation_penalty() + posed);
        Some(finished_trial)
    }

    /// Returns the penalty (nepers) of the errors of a trial's hands, of those penalties that each hand has.
    fn trial_error_penalty(&self, trial: &ReadingTrial, of: [f64; 2]) -> f64 {
        match &trial.stand {
            PlaceNotation::One(n, _) if self.begun.alone => of[*n],
            PlaceNotation::Each(_) => of[0] + of[1],
            PlaceNotation::Unsaid if self.begun.alone => of[self.sight.lead],
            PlaceNotation::One(..) | PlaceNotation::Together(..) | PlaceNotation::Unsaid => of[0].max(of[1]),
        }
    }

    /// Compares the clip of a trial with the observed hands; `drift` is the offset that is expected of the whole sign
    /// if the clip is of the first posture alone.
    fn compare_trial_clip(&self, trial: ReadingTrial, clip: &Clip, drift: Option<[DVec3; 2]>) -> Option<TriedReading> {
        let (mut off, mut aside) = self.observed_hand_offsets(clip)?;
        let posed = off;
        let exact = match drift {
            Some(_) => tuned().resynthesis.nearly,
            None => tuned().resynthesis.exact,
        };
        for (n, by) in drift.into_iter().flatten().enumerate() {
            // The offset displaces the hand; the rest of its error comes from its rotation.
            let turned = off[n] * off[n] - aside[n].length_squared();
            aside[n] += by;
            off[n] = (turned + aside[n].length_squared()).max(0.0).sqrt();
        }
        let numbers = &tuned().resynthesis;
        let otherwise = trial.unexplained_place_penalties();
        // A hand matches, is displaced by the animator, or misses its place, whichever is the likeliest.
        let of = |n: usize| {
            let matches = 0.5 * (off[n] / exact).powi(2);
            let displaced = numbers.near + 0.5 * (off[n] / numbers.displaced).powi(2);
            let misses = numbers.inexact + otherwise[n] + numbers.farther * 1e3 * off[n];
            matches.min(displaced).min(misses)
        };
        let unlikely = self.trial_error_penalty(&trial, [of(0), of(1)]);
        let cost = trial.trial_notation_penalty();
        let counted = self.hands_beyond_distance(off, 0.0).into_iter();
        let error: f64 = counted.map(|n| off[n]).sum();
        Some(TriedReading {
            total: cost + unlikely,
            near: cost + numbers.per * 1e3 * error,
            trial,
            off,
            error,
            aside,
            drift: drift.unwrap_or_default(),
            whole: drift.is_none(),
            posed,
        })
    }

    /// Returns the distance (m) between each hand in a clip's first frame and its observed position.
    fn observed_hand_distances(&self, clip: &Clip) -> Option<[f64; 2]> {
        Some(self.observed_hand_offsets(clip)?.0)
    }

    /// Returns the frame of the observed clip that corresponds to the first frame of a synthesised one: if the observed
    /// clip begins within the sign, so does the synthesised one.
    fn compared_from(&self) -> usize {
        match self.begun.first {
            0 => 0,
            _ => self.begun.frame,
        }
    }

    /// Returns the distance between each hand in a clip's first frame and its observed position, and the middle of each
    /// hand as observed, less that in the clip, all in metres.
    fn observed_hand_offsets(&self, clip: &Clip) -> Option<([f64; 2], [DVec3; 2])> {
        let scene = self.sight.scene;
        let frame = self.compared_from();
        let model = clip.model_pose(0);
        let axes = LevelSignerAxes::read_signer_axes(scene.anatomy, scene.alone, &model, scene.dominant)?;
        let apart = scene.hands.each_ref().map(|track| {
            let track = track.as_ref()?;
            let hand = scene.anatomy.arm_chain(track.side)?.hand;
            let along = scene.anatomy.hand_direction(track.side, &model)?;
            // Both ends of the hand, so that its direction counts as well as its place.
            let ends = |wrist: DVec3, along: DVec3| [wrist, wrist + along * scene.hand];
            let hand_ends = ends(track.wrist[frame], track.along[frame]);
            let there = ends(
                axes.signer_place_of(model.model_joint_position(hand)),
                axes.signer_direction_of(along),
            );
            let apart: Vec<DVec3> = hand_ends.iter().zip(there).map(|(a, b)| a - b).collect();
            let squares: f64 = apart.iter().map(|difference| difference.length_squared()).sum();
            Some(((squares / 2.0).sqrt(), (apart[0] + apart[1]) / 2.0))
        });
        let apart = apart.map(Option::unwrap_or_default);
        Some((apart.map(|entry| entry.0), apart.map(|entry| entry.1)))
    }
}
