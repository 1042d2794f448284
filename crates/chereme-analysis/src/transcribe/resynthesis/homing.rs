//! Searches for the reading of places that re-synthesis confirms.
//!
//! A hand whose place lies in the flesh of the trunk, or whose fingers would be in the other hand, ends beside its place.
//! The animator does nearly the same to similar readings. So the true place is near the observed hand,
//! moved back by the difference between the place of an earlier trial and its re-synthesised hand.

use chereme_sign::hamnosys::{Aim, Compass, Direction, Place};
use glam::DVec3;

use super::*;

/// The trials of a search.
pub(super) struct Search {
    /// The likeliest reading whose whole sign was synthesised.
    pub(super) best: Tried,
    /// The nearest trials, the nearest first.
    pub(super) beam: Vec<Tried>,
    seen: Vec<Key>,
}

/// The properties in which the signs of two trials may differ: the place, the orientations, whether the hands mirror each
/// other, and whether they stay still.
type Key = (
    Option<Place>,
    [Option<(Aim<Direction>, Aim<Compass>)>; 2],
    bool,
    bool,
);

impl Search {
    pub(super) fn of(first: Tried) -> Self {
        Self {
            beam: vec![first.clone()],
            seen: vec![key(&first.trial)],
            best: first,
        }
    }

    /// Returns a search that goes on from these trials alone.
    pub(super) fn only(&self, trials: Vec<Tried>) -> Self {
        let mut search = Self {
            best: self.best.clone(),
            beam: Vec::new(),
            seen: self.seen.clone(),
        };
        search.add(trials);
        search
    }

    /// Returns the nearest trials, at most `most`, and the nearest one of each other form of notation.
    pub(super) fn nearest(&self, most: usize) -> Vec<Tried> {
        let (first, rest) = self.beam.split_at(most.min(self.beam.len()));
        let mut all = first.to_vec();
        for tried in rest {
            if !all.iter().any(|it| it.trial.has_form_of(&tried.trial)) {
                all.push(tried.clone());
            }
        }
        all
    }

    /// Adds trials, the nearest first.
    pub(super) fn add(&mut self, trials: Vec<Tried>) {
        self.beam.extend(trials);
        self.beam.sort_by(|a, b| a.near.total_cmp(&b.near));
    }
}

fn key(trial: &Trial) -> Key {
    let turned = trial.turned.each_ref();
    let turned = turned.map(|it| it.as_ref().map(|it| (it.extended.best, it.palm.best)));
    (trial.stand.place(), turned, trial.mirrored, trial.still)
}

impl Proof<'_, '_> {
    /// Tries places that are likely once the aim is corrected by the nearest trials, in some rounds.
    pub(super) fn home(&self, search: &mut Search, rounds: usize) {
        for round in 0..rounds {
            self.finish(search);
            if self
                .beyond(search.best.off, tuned().resynthesis.sure)
                .is_empty()
            {
                return;
            }
            // At first the beam is wide enough for every form of notation.
            let beam = tuned().resynthesis.beam[usize::from(round > 0)];
            let nearest = search.nearest(beam);
            self.correct(search, nearest, tuned().resynthesis.neighbours);
        }
        self.finish(search);
    }

    /// Tries many more places with the aim of the nearest trial of each form of notation.
    pub(super) fn widen(&self, search: &mut Search) {
        let nearest = search.nearest(1);
        self.correct(search, nearest, tuned().resynthesis.widely);
        self.finish(search);
    }

    /// Corrects the aim of trials, and adds those of at most `most` places with each.
    fn correct(&self, search: &mut Search, from: Vec<Tried>, most: usize) {
        let mut trials: Vec<(Trial, [DVec3; 2])> = Vec::new();
        for tried in from {
            for trial in self.neighbours(&tried, most) {
                let own = key(&trial);
                if !search.seen.contains(&own) {
                    search.seen.push(own);
                    trials.push((trial, tried.drift));
                }
            }
        }
        search.add(self.begin_all(trials));
    }

    /// Synthesises the whole signs of the likeliest trials, and keeps the best.
    fn finish(&self, search: &mut Search) {
        let mut order: Vec<usize> = (0..search.beam.len())
            .filter(|&k| !search.beam[k].whole)
            .collect();
        order.sort_by(|a, b| search.beam[*a].total.total_cmp(&search.beam[*b].total));
        for k in order.into_iter().take(tuned().resynthesis.finalists) {
            if search.beam[k].trial.cost() >= search.best.total {
                continue;
            }
            let Some(whole) = self.finished(&search.beam[k]) else {
                continue;
            };
            if whole.total < search.best.total {
                search.best = whole.clone();
            }
            search.beam[k] = whole;
        }
        search.add(Vec::new());
    }

    /// Returns trials with the likeliest places for the observed hands, if the animator does to them what it did to a trial.
    fn neighbours(&self, tried: &Tried, most: usize) -> Vec<Trial> {
        let from = &tried.trial;
        let by = shift(tried);
        let body = self.body.shifted(by);
        let symmetric = self.begun.symmetric || from.mirrored;
        let likeliest = |n: usize| {
            let mut all = body.likeliest(n, symmetric, most);
            for placed in &mut all {
                placed.aside -= by[n];
            }
            all
        };
        match &from.stand {
            Stand::Unsaid => Vec::new(),
            Stand::One(n, _) => {
                let all = likeliest(*n).into_iter();
                all.map(|placed| from.with(Stand::One(*n, placed)))
                    .collect()
            }
            Stand::Each(_) => {
                let all = [0, 1].map(likeliest);
                let first = all.each_ref().map(|all| all.first().cloned());
                let each =
                    (0..2).flat_map(|n| all[n].iter().map(move |placed| (n, placed.clone())));
                let each = each.map(|(n, placed)| {
                    let mut both = first.clone();
                    both[n] = Some(placed);
                    from.with(Stand::Each(both))
                });
                each.collect()
            }
            Stand::Together(..) => {
                let [own, other] = by;
                let mut all: Vec<(f64, Trial)> = Vec::new();
                for mut together in body.likeliest_pairs(tuned().resynthesis.pairs[1]) {
                    let shared = body.likeliest_shared(&together, tuned().resynthesis.shared);
                    let likely = together.cost() + together.unlikely;
                    together.aside -= own - other;
                    all.extend(shared.into_iter().map(|mut at| {
                        at.aside -= own.midpoint(other);
                        let likely = likely + at.score;
                        let stand = Stand::Together(together.clone(), at);
                        (likely, from.with(stand))
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
fn shift(tried: &Tried) -> [DVec3; 2] {
    let [own, other] = tried.aside;
    match &tried.trial.stand {
        Stand::Unsaid => [DVec3::ZERO; 2],
        Stand::One(n, placed) => {
            let mut by = [DVec3::ZERO; 2];
            by[*n] = tried.aside[*n] - placed.aside;
            by
        }
        Stand::Each(both) => [0, 1].map(|n| {
            let placed = both[n].as_ref();
            placed.map_or(DVec3::ZERO, |placed| tried.aside[n] - placed.aside)
        }),
        Stand::Together(together, placed) => {
            let middle = own.midpoint(other) - placed.aside;
            let apart = (own - other - together.aside) / 2.0;
            [middle + apart, middle - apart]
        }
    }
}
