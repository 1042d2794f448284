//! Searches for the reading of places that re-synthesis confirms.
//!
//! A hand whose place lies in the flesh of the trunk, or whose fingers would be in the other hand, ends beside its place.
//! The animator does nearly the same to similar readings. So the true place is near the observed hand,
//! moved back by the difference between the place of an earlier trial and its re-synthesised hand.

use chereme_sign::hamnosys::{CompassDirection, DirectionAim, HandPlace, SpatialDirection};
use glam::DVec3;

use super::*;

/// The trials of a search.
pub(super) struct TrialSearch {
    /// The likeliest reading whose whole sign was synthesised.
    pub(super) best: TriedReading,
    /// The nearest trials, the nearest first.
    pub(super) beam: Vec<TriedReading>,
    seen: Vec<TrialFormKey>,
}

/// The properties in which the signs of two trials may differ: the place, the orientations, whether the hands mirror each
/// other, and whether they stay still.
type TrialFormKey = (
    Option<HandPlace>,
    [Option<(DirectionAim<SpatialDirection>, DirectionAim<CompassDirection>)>; 2],
    bool,
    bool,
);

impl TrialSearch {
    pub(super) fn search_from_trial(first: TriedReading) -> Self {
        Self {
            beam: vec![first.clone()],
            seen: vec![trial_form_key(&first.trial)],
            best: first,
        }
    }

    /// Returns a search that goes on from these trials alone.
    pub(super) fn with_trials_only(&self, trials: Vec<TriedReading>) -> Self {
        let mut search = Self {
            best: self.best.clone(),
            beam: Vec::new(),
            seen: self.seen.clone(),
        };
        search.add_search_trials(trials);
        search
    }

    /// Returns the nearest trials, at most `most`, and the nearest one of each other form of notation.
    pub(super) fn nearest_trials(&self, most: usize) -> Vec<TriedReading> {
        let (first, rest) = self.beam.split_at(most.min(self.beam.len()));
        let mut all = first.to_vec();
        for tried in rest {
            if !all.iter().any(|other| other.trial.has_form_of(&tried.trial)) {
                all.push(tried.clone());
            }
        }
        all
    }

    /// Adds trials, the nearest first.
    pub(super) fn add_search_trials(&mut self, trials: Vec<TriedReading>) {
        self.beam.extend(trials);
        self.beam.sort_by(|a, b| a.near.total_cmp(&b.near));
    }
}

fn trial_form_key(trial: &ReadingTrial) -> TrialFormKey {
    let turned_hands = trial.turned.each_ref();
    let turned = turned_hands.map(|hand| hand.as_ref().map(|aim| (aim.extended.best, aim.palm.best)));
    (trial.stand.notated_place(), turned, trial.mirrored, trial.still)
}

impl TrialResynthesis<'_, '_> {
    /// Tries places that are likely once the aim is corrected by the nearest trials, in some rounds.
    pub(super) fn try_likely_places(&self, search: &mut TrialSearch, rounds: usize) {
        for round in 0..rounds {
            self.finish_likeliest_trials(search);
            if self
                .hands_beyond_distance(search.best.off, tuned().resynthesis.sure)
                .is_empty()
            {
                return;
            }
            // At first the beam is wide enough for every form of notation.
            let beam = tuned().resynthesis.beam[usize::from(round > 0)];
            let nearest = search.nearest_trials(beam);
            self.correct_trial_aims(search, nearest, tuned().resynthesis.neighbours);
        }
        self.finish_likeliest_trials(search);
    }

    /// Tries many more places with the aim of the nearest trial of each form of notation.
    pub(super) fn widen_place_search(&self, search: &mut TrialSearch) {
        let nearest = search.nearest_trials(1);
        self.correct_trial_aims(search, nearest, tuned().resynthesis.widely);
        self.finish_likeliest_trials(search);
    }

    /// Corrects the aim of trials, and adds those of at most `most` places with each.
    fn correct_trial_aims(&self, search: &mut TrialSearch, from: Vec<TriedReading>, most: usize) {
        let mut trials: Vec<(ReadingTrial, [DVec3; 2])> = Vec::new();
        for tried in from {
            for trial in self.neighbouring_trials(&tried, most) {
                let trial_key = trial_form_key(&trial);
                if !search.seen.contains(&trial_key) {
                    search.seen.push(trial_key);
                    trials.push((trial, tried.drift));
                }
            }
        }
        search.add_search_trials(self.begin_all(trials));
    }

    /// Synthesises the whole signs of the likeliest trials, and keeps the best.
    fn finish_likeliest_trials(&self, search: &mut TrialSearch) {
        let mut order: Vec<usize> = (0..search.beam.len()).filter(|&k| !search.beam[k].whole).collect();
        order.sort_by(|a, b| search.beam[*a].total.total_cmp(&search.beam[*b].total));
        for k in order.into_iter().take(tuned().resynthesis.finalists) {
            // The notation alone costs as much as the best trial in all.
            if search.beam[k].trial.trial_notation_penalty() >= search.best.total {
                continue;
            }
            let Some(whole) = self.synthesise_whole_trial(&search.beam[k]) else {
                continue;
            };
            if whole.total < search.best.total {
                search.best = whole.clone();
            }
            search.beam[k] = whole;
        }
        // Whole signs have other errors than first postures, so that the order has changed.
        search.add_search_trials(Vec::new());
    }

    /// Returns trials with the likeliest places for the observed hands, if the animator does to them what it did to a trial.
    fn neighbouring_trials(&self, tried: &TriedReading, most: usize) -> Vec<ReadingTrial> {
        let from = &tried.trial;
        let by = hand_aim_shift(tried);
        let body = self.body.with_shifted_hands(by);
        let symmetric = self.begun.symmetric || from.mirrored;
        let likeliest = |n: usize| {
            let mut all = body.rank_hand_places(n, symmetric, most);
            // Places were ranked for shifted hands; offsets count from the observed ones.
            for placed in &mut all {
                placed.aside -= by[n];
            }
            all
        };
        match &from.stand {
            PlaceNotation::Unsaid => Vec::new(),
            PlaceNotation::One(n, _) => {
                let all = likeliest(*n).into_iter();
                all.map(|placed| from.with_place_notation(PlaceNotation::One(*n, placed)))
                    .collect()
            }
            PlaceNotation::Each(_) => {
                let all = [0, 1].map(likeliest);
                let first = all.each_ref().map(|all| all.first().cloned());
                let each = (0..2).flat_map(|n| all[n].iter().map(move |placed| (n, placed.clone())));
                let each = each.map(|(n, placed)| {
                    let mut both = first.clone();
                    both[n] = Some(placed);
                    from.with_place_notation(PlaceNotation::Each(both))
                });
                each.collect()
            }
            PlaceNotation::Together(..) => {
                let [own, other] = by;
                let mut all: Vec<(f64, ReadingTrial)> = Vec::new();
                for mut together in body.likeliest_pairs(tuned().resynthesis.pairs[1]) {
                    let shared = body.likeliest_shared(&together, tuned().resynthesis.shared);
                    let likely = together.together_notation_penalty() + together.unlikely;
                    together.aside -= own - other;
                    all.extend(shared.into_iter().map(|mut at| {
                        at.aside -= own.midpoint(other);
                        let likely = likely + at.score;
                        let stand = PlaceNotation::Together(together.clone(), at);
                        (likely, from.with_place_notation(stand))
                    }));
                }
                all.sort_by(|a, b| a.0.total_cmp(&b.0));
                all.truncate(2 * most);
                all.into_iter().map(|(_, trial)| trial).collect()
            }
        }
    }
}

/// Returns how far the aim at each hand is from the observed hand, in metres, so that the animator puts it there.
fn hand_aim_shift(tried: &TriedReading) -> [DVec3; 2] {
    let [own, other] = tried.aside;
    match &tried.trial.stand {
        PlaceNotation::Unsaid => [DVec3::ZERO; 2],
        PlaceNotation::One(n, placed) => {
            let mut by = [DVec3::ZERO; 2];
            by[*n] = tried.aside[*n] - placed.aside;
            by
        }
        PlaceNotation::Each(both) => [0, 1].map(|n| {
            let placed = both[n].as_ref();
            placed.map_or(DVec3::ZERO, |placed| tried.aside[n] - placed.aside)
        }),
        PlaceNotation::Together(together, placed) => {
            let middle = own.midpoint(other) - placed.aside;
            let apart = (own - other - together.aside) / 2.0;
            [middle + apart, middle - apart]
        }
    }
}
