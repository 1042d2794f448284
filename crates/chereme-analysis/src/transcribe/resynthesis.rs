//! Verifies movements and places by re-synthesis: candidates are animated, and the one that puts the hands where they
//! were observed is reported.
//!
//! The first reading comes from the hand's position alone. But the animator pushes a hand out of the trunk
//! that should touch it, keeps it clear of the other hand, stops it at its joint limits, and lets it give way to its
//! arm. The right notation, animated by the same rules, puts the hand within a fraction of a millimetre of the observed
//! position, and few others do. If the movement is misread, even the right place misses it by some millimetres: so similar
//! movements are animated first, and the one that moves the hands as observed is reported.

mod actions;
mod homing;
mod movement;
mod nonmanual;
mod regrouped;
pub(super) mod replaced;
mod reshaped;
#[cfg(test)]
mod tests;
mod turning;
mod unrolled;

use std::cell::Cell;

use chereme_motion::Clip;
use chereme_sign::hamnosys::{Each, Motion, Nonmanual, Notated, Sign};
use glam::DVec3;

use super::aim::Turned;
use super::place::{Body, Placed};
use super::scene::Axes;
use super::tree::{self, Begun, Picked, Sight, Stand};
use super::{Performs, Stage, Transcription};
use crate::transcribe::tuned::tuned;
use homing::Search;

/// The most postures that are synthesised in one search for the places of a sign.
const MOST_POSTURES: usize = 1000;

/// The most searches for the places of a sign: a second one follows if the places of the first one explain the movement.
const SEARCHES: usize = 2;

/// The most postures and movements that are synthesised for one sign: each search is repeated with other orientations.
pub const MOST_TRIALS: usize = 2 * SEARCHES * MOST_POSTURES + movement::MOST_MOVEMENTS;

/// Writes the notation of a scene; with `performs`, verifies movements and places by re-synthesis.
pub(super) fn written<'a>(sight: &'a Sight<'a>, performs: Option<&dyn Performs>) -> Transcription {
    let (first, begun) = tree::written(sight, Picked::default());
    let (Some(begun), Some(performs)) = (begun, performs) else {
        return first;
    };
    let Some(mut body) = sight.look(begun.frame) else {
        return first;
    };
    if let Some(by) = begun.behind {
        body.shift(1, by);
    }
    let mut proof = Proof {
        sight,
        performs,
        begun: &begun,
        inferred: first.sign.clone(),
        nonmanual: Nonmanual::default(),
        stages: &first.stages,
        body,
        postures: Cell::new(0),
        movements: Cell::new(movement::MOST_MOVEMENTS),
    };
    let mut best = Verified {
        trial: proof.first_trial(),
        picked: None,
        off: [0.0; 2],
    };
    proof.nonmanual = proof.acts(&best.trial);
    for search in 0..SEARCHES {
        let moved = proof.moved(&best.trial);
        let settled = search > 0 && (moved.is_none() || proof.open(best.off).is_empty());
        if let Some(actions) = moved {
            proof.inferred.parts[0].actions = actions;
        }
        if settled {
            break;
        }
        let Some(verified) = proof.verified(proof.first_trial()) else {
            break;
        };
        best = proof.rather_turned(verified);
    }
    proof.reported(first.clone(), best)
}

/// The reading of the first posture that re-synthesis prefers.
struct Verified {
    trial: Trial,
    /// The readings that it fixes, if it replaces the first reading.
    picked: Option<Picked>,
    /// The error of each hand, in metres.
    off: [f64; 2],
}

/// An alternative reading of the first posture.
#[derive(Clone)]
struct Trial {
    stand: Stand,
    turned: [Option<Turned>; 2],
    /// Whether the hands mirror each other at first, but act separately afterwards.
    mirrored: bool,
    /// Whether the actions are left out.
    still: bool,
}

/// A trial with the result of its re-synthesis.
#[derive(Clone)]
struct Tried {
    trial: Trial,
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

impl Trial {
    fn with(&self, stand: Stand) -> Self {
        Self {
            stand,
            ..self.clone()
        }
    }

    /// Returns whether the places of both trials have the same form of notation.
    fn has_form_of(&self, other: &Self) -> bool {
        let form = |trial: &Self| (std::mem::discriminant(&trial.stand), trial.mirrored);
        form(self) == form(other)
    }

    /// Returns the penalty (nepers) of the notation itself.
    fn cost(&self) -> f64 {
        let own = |placed: &Placed| placed.score - placed.unlikely;
        let stand: f64 = match &self.stand {
            Stand::One(_, placed) => own(placed),
            Stand::Each(both) => both.iter().flatten().map(own).sum(),
            Stand::Together(together, at) => together.cost() + own(at),
            Stand::Unsaid => 0.0,
        };
        let turned = self.turned.iter().flatten().map(|turned| turned.less);
        stand + turned.sum::<f64>()
    }

    /// Returns the penalty (nepers) of each hand's distance from its place, for a hand that re-synthesis
    /// does not explain.
    fn otherwise(&self) -> [f64; 2] {
        match &self.stand {
            Stand::One(_, placed) | Stand::Together(_, placed) => [placed.unlikely; 2],
            Stand::Each(both) => both
                .each_ref()
                .map(|placed| placed.as_ref().map_or(0.0, |placed| placed.unlikely)),
            Stand::Unsaid => [0.0; 2],
        }
    }

    /// Returns the sign `inferred` with this trial's places and orientations.
    fn sign(&self, inferred: &Sign) -> Sign {
        fn put<T>(each: &mut Each<T>, n: usize, value: T) {
            match each {
                Each::Shared(own) => *own = value,
                Each::Split(a, b) => *[a, b][n] = Some(value),
                Each::Unset => {}
            }
        }
        let mut sign = inferred.clone();
        for part in &mut sign.parts {
            part.posture.place = self.stand.place();
            if self.still {
                part.actions.clear();
            }
            if self.mirrored {
                tree::mirror(part);
            }
            for (n, turned) in self.turned.iter().enumerate() {
                if let Some(turned) = turned {
                    put(&mut part.posture.extended, n, turned.extended.best);
                    put(&mut part.posture.palm, n, turned.palm.best);
                }
            }
        }
        sign
    }
}

impl Tried {
    /// Returns the reading that the trial fixes.
    fn verified(self) -> Verified {
        let middle = |placed: &Placed| {
            let mut sites = placed.place.site.iter().chain(&placed.place.second);
            sites.all(|site| site.side.is_none())
        };
        let trial = Trial {
            still: false,
            ..self.trial
        };
        let stand = match trial.stand.clone() {
            Stand::Each([Some(own), Some(other)])
                if trial.mirrored && own.place == other.place && middle(&own) =>
            {
                Stand::One(0, own)
            }
            stand => stand,
        };
        let picked = Picked {
            stand: Some(stand),
            turned: trial.turned.clone(),
            mirrored: trial.mirrored,
        };
        Verified {
            trial,
            picked: Some(picked),
            off: self.off,
        }
    }
}

struct Proof<'a, 'p> {
    sight: &'a Sight<'a>,
    performs: &'p dyn Performs,
    begun: &'p Begun,
    /// The first reading, with the movement that was found.
    inferred: Sign,
    /// The acts of trunk, head and shoulders that were found.
    nonmanual: Nonmanual,
    /// The posture and the actions of the first reading, with their frames.
    stages: &'p [Stage],
    body: Body<'a>,
    /// The number of postures that may still be synthesised.
    postures: Cell<usize>,
    /// The number of whole signs that may still be synthesised in search of the movement.
    movements: Cell<usize>,
}

impl Proof<'_, '_> {
    /// Returns a sign with the acts of the body.
    fn notated(&self, sign: Sign) -> Notated {
        Notated {
            sign,
            nonmanual: self.nonmanual.clone(),
            ..Notated::default()
        }
    }

    /// Returns a trial's sign with the acts of the body.
    fn tried_sign(&self, trial: &Trial) -> Notated {
        self.notated(trial.sign(&self.inferred))
    }

    fn first_trial(&self) -> Trial {
        Trial {
            stand: self.begun.stand.clone(),
            turned: [None, None],
            mirrored: false,
            still: false,
        }
    }

    /// Returns the preferred reading, the places of `first` or others; `None` if `first` cannot be synthesised.
    fn verified(&self, first: Trial) -> Option<Verified> {
        self.postures.set(MOST_POSTURES);
        let begun = self.begun_as(first.clone())?;
        let kept = |off| {
            let is_own = first.turned.iter().all(Option::is_none);
            let tried = Tried {
                off,
                ..begun.clone()
            };
            let picked = if is_own {
                None
            } else {
                tried.verified().picked
            };
            Verified {
                trial: first.clone(),
                picked,
                off,
            }
        };
        if self.beyond(begun.off, tuned().resynthesis.sure).is_empty() {
            return Some(kept(begun.off));
        }
        if let Some(unsaid) = self.unsaid(&first) {
            return Some(unsaid);
        }
        let whole = self.finished(&begun)?;
        let best = self.searched(&whole);
        Some(match self.is_better(&best, &whole) {
            true => best.verified(),
            false => kept(whole.off),
        })
    }

    /// Searches for the reading that puts the hands where they were observed.
    fn searched(&self, first: &Tried) -> Tried {
        let [rounds, few] = tuned().resynthesis.rounds;
        let mut search = Search::of(first.clone());
        let others = self.other_forms(&first.trial).into_iter();
        search.add(self.begin_all(others.map(Self::without_drift)));
        self.home(&mut search, rounds);
        if self.open(search.best.off).is_empty() {
            return search.best;
        }
        self.widen(&mut search);
        if self.open(search.best.off).is_empty() {
            return search.best;
        }
        let turned: Vec<_> = (0..2).flat_map(|n| self.turned(&search, n)).collect();
        let mut otherwise = search.only(self.begin_all(turned));
        self.home(&mut otherwise, few);
        // Orientations are measured well: only an exact match speaks against them.
        if self.open(otherwise.best.off).is_empty() {
            return otherwise.best;
        }
        // A wrong reading of the actions may displace the hand.
        let still = Trial {
            still: true,
            ..search.best.trial.clone()
        };
        let mut still = search.only(self.begin_all([Self::without_drift(still)]));
        self.home(&mut still, few);
        still.best
    }

    /// Returns whether another reading should replace the first one: it must be likelier, and match (or its first posture
    /// alone), or miss the hands by much less.
    fn is_better(&self, other: &Tried, first: &Tried) -> bool {
        let numbers = &tuned().resynthesis;
        let matches = self.beyond(other.off, numbers.almost).is_empty();
        let posed = self.beyond(other.posed, numbers.exact).is_empty();
        let surely = self.beyond(other.off, numbers.sure).is_empty();
        let rather = if surely { 0.0 } else { numbers.rather };
        other.total < first.total - rather
            && (matches || posed || other.error < numbers.less * first.error)
    }

    /// Returns the reading without any place, if re-synthesis of it puts the hands where they were
    /// observed.
    fn unsaid(&self, first: &Trial) -> Option<Verified> {
        let begun = self.begun_as(first.with(Stand::Unsaid))?;
        if !self.open(begun.off).is_empty() {
            return None;
        }
        let whole = self.finished(&begun)?;
        self.beyond(whole.off, tuned().resynthesis.exact)
            .is_empty()
            .then(|| whole.verified())
    }

    fn begun_as(&self, trial: Trial) -> Option<Tried> {
        self.begin_all([Self::without_drift(trial)]).pop()
    }

    fn without_drift(trial: Trial) -> (Trial, [DVec3; 2]) {
        (trial, [DVec3::ZERO; 2])
    }

    /// Returns the hands that miss their observed position: those whose error `off` is above
    /// `resynthesis.nearly`, both in metres.
    fn open(&self, off: [f64; 2]) -> Vec<usize> {
        self.beyond(off, tuned().resynthesis.nearly)
    }

    /// Returns the hands whose error is above `within` metres; a hand at rest, which has no notation, does
    /// not count.
    fn beyond(&self, off: [f64; 2], within: f64) -> Vec<usize> {
        let counts = |n: &usize| match &self.begun.stand {
            Stand::One(own, _) if self.begun.alone => own == n,
            _ => true,
        };
        (0..2).filter(counts).filter(|&n| off[n] > within).collect()
    }

    /// Returns trials with the other forms of notation for the places of two hands: as a constellation, or
    /// separately.
    fn other_forms(&self, from: &Trial) -> Vec<Trial> {
        if self.begun.alone {
            return Vec::new();
        }
        let likeliest = |n: usize| self.body.likeliest(n, self.begun.symmetric, 1).pop();
        let mirrored = [0, 1].map(|n| self.body.likeliest(n, true, 1).pop());
        let mirrored = Trial {
            mirrored: true,
            ..from.with(Stand::Each(mirrored))
        };
        let mirrored = Some(mirrored).filter(|_| !self.begun.symmetric);
        let apart = match &from.stand {
            Stand::Together(..) if self.begun.symmetric => {
                likeliest(0).map(|placed| Stand::One(0, placed))
            }
            Stand::Together(..) => Some(Stand::Each([0, 1].map(likeliest))),
            _ => None,
        };
        let pairs = self.body.likeliest_pairs(tuned().resynthesis.pairs[0]);
        let together = pairs.into_iter().filter_map(|together| {
            let at = self.body.likeliest_shared(&together, 1).pop()?;
            Some(Stand::Together(together, at))
        });
        let all = apart.into_iter().chain(together);
        let all = all.map(|stand| from.with(stand));
        mirrored.into_iter().chain(all).collect()
    }

    /// Returns trials with other orientations of hand `n`, at the places where it came nearest.
    fn turned(&self, search: &Search, n: usize) -> Vec<(Trial, [DVec3; 2])> {
        let track = self.sight.scene.hands[n].as_ref();
        let Some(track) = track.filter(|track| track.faces) else {
            return Vec::new();
        };
        if !self.open(search.best.off).contains(&n) {
            return Vec::new();
        }
        let turns = self
            .sight
            .turned(track, self.begun.frame, tuned().resynthesis.turns + 1);
        let near = search.beam.iter().take(tuned().resynthesis.turned_at);
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
    fn begin_all(&self, trials: impl IntoIterator<Item = (Trial, [DVec3; 2])>) -> Vec<Tried> {
        let trials = trials.into_iter().take_while(|_| {
            let left = self.postures.get();
            self.postures.set(left.saturating_sub(1));
            left > 0
        });
        let trials: Vec<_> = trials.collect();
        let signs = trials.iter().map(|(trial, _)| self.tried_sign(trial));
        let clips = self.performs.begin_all(&signs.collect::<Vec<_>>());
        let begun = trials.into_iter().zip(clips);
        let begun =
            begun.filter_map(|((trial, drift), clip)| self.tried(trial, &clip?, Some(drift)));
        begun.collect()
    }

    /// Returns the transcription of a verified reading. Findings say what re-synthesis corrected and what it does not
    /// explain.
    fn reported(&self, first: Transcription, best: Verified) -> Transcription {
        let actions = self.inferred.parts[0].actions.clone();
        let inferred = first.sign.parts[0].actions.clone();
        let mut found = match best.picked {
            Some(picked) => tree::written(self.sight, picked).0,
            None => first,
        };
        found.nonmanual.clone_from(&self.nonmanual);
        let read = found.sign.clone();
        if actions != inferred {
            let part = &mut found.sign.parts[0];
            part.actions.clone_from(&actions);
            if best.trial.mirrored {
                tree::mirror(part);
            }
        }
        // The trial may have left out the actions or written them in other words.
        let performed = |sign: &Sign| {
            let clip = self.performs.performs(&self.notated(sign.clone()))?;
            Some((self.off(&clip)?, self.deviation(&clip)?))
        };
        let Some((off, after)) = performed(&found.sign) else {
            found.sign = read;
            return found;
        };
        if actions != inferred
            && let Some((_, before)) = performed(&read)
        {
            let several = self.sight.scene.language.repeat_several;
            let actions = [&*inferred, &*actions];
            replaced::replace(&mut found, actions, [before, after], several);
        } else if after > tuned().resynthesis.nearly {
            found.findings.push(format!(
                "re-synthesised, the movement is {:.1} cm from the observed one",
                100.0 * after
            ));
        }
        for n in self.open(off) {
            if let Some(track) = &self.sight.scene.hands[n] {
                found.findings.push(format!(
                    "re-synthesised, the {} hand begins {:.1} cm from its observed place",
                    track.side.name(),
                    100.0 * off[n]
                ));
            }
        }
        found
    }

    /// Synthesises the whole sign of a trial.
    fn finished(&self, begun: &Tried) -> Option<Tried> {
        let whole = self.performs.performs(&self.tried_sign(&begun.trial))?;
        let mut whole = self.tried(begun.trial.clone(), &whole, None)?;
        for (n, drift) in whole.drift.iter_mut().enumerate() {
            *drift = whole.aside[n] - (begun.aside[n] - begun.drift[n]);
        }
        // If the movement is misread, only the first posture matches.
        let numbers = &tuned().resynthesis;
        let matches = |off: f64| numbers.posed + 0.5 * (off / numbers.nearly).powi(2);
        whole.posed = begun.posed;
        let posed = self.unlikely(&whole.trial, begun.posed.map(matches));
        whole.total = whole.total.min(whole.trial.cost() + posed);
        Some(whole)
    }

    /// Returns the penalty (nepers) of the errors of a trial's hands, of those penalties that each hand has.
    fn unlikely(&self, trial: &Trial, of: [f64; 2]) -> f64 {
        match &trial.stand {
            Stand::One(n, _) if self.begun.alone => of[*n],
            Stand::Each(_) => of[0] + of[1],
            Stand::Unsaid if self.begun.alone => of[self.sight.lead],
            Stand::One(..) | Stand::Together(..) | Stand::Unsaid => of[0].max(of[1]),
        }
    }

    /// Compares the clip of a trial with the observed hands; `drift` is the offset that is expected of the whole sign
    /// if the clip is of the first posture alone.
    fn tried(&self, trial: Trial, clip: &Clip, drift: Option<[DVec3; 2]>) -> Option<Tried> {
        let (mut off, mut aside) = self.apart(clip)?;
        let posed = off;
        let exact = match drift {
            Some(_) => tuned().resynthesis.nearly,
            None => tuned().resynthesis.exact,
        };
        for (n, by) in drift.into_iter().flatten().enumerate() {
            let turned = off[n] * off[n] - aside[n].length_squared();
            aside[n] += by;
            off[n] = (turned + aside[n].length_squared()).max(0.0).sqrt();
        }
        let numbers = &tuned().resynthesis;
        let otherwise = trial.otherwise();
        let of = |n: usize| {
            let matches = 0.5 * (off[n] / exact).powi(2);
            let displaced = numbers.near + 0.5 * (off[n] / numbers.displaced).powi(2);
            let misses = numbers.inexact + otherwise[n] + numbers.farther * 1e3 * off[n];
            matches.min(displaced).min(misses)
        };
        let unlikely = self.unlikely(&trial, [of(0), of(1)]);
        let cost = trial.cost();
        let counted = self.beyond(off, 0.0).into_iter();
        let error: f64 = counted.map(|n| off[n]).sum();
        Some(Tried {
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
    fn off(&self, clip: &Clip) -> Option<[f64; 2]> {
        Some(self.apart(clip)?.0)
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
    fn apart(&self, clip: &Clip) -> Option<([f64; 2], [DVec3; 2])> {
        let scene = self.sight.scene;
        let frame = self.compared_from();
        let model = clip.model_pose(0);
        let axes = Axes::of(scene.anatomy, scene.alone, &model, scene.dominant)?;
        let apart = scene.hands.each_ref().map(|track| {
            let track = track.as_ref()?;
            let hand = scene.anatomy.arm(track.side)?.hand;
            let along = scene.anatomy.hand_direction(track.side, &model)?;
            let ends = |wrist: DVec3, along: DVec3| [wrist, wrist + along * scene.hand];
            let own = ends(track.wrist[frame], track.along[frame]);
            let there = ends(axes.place(model.position(hand)), axes.direction(along));
            let apart: Vec<DVec3> = own.iter().zip(there).map(|(a, b)| a - b).collect();
            let squares: f64 = apart.iter().map(|it| it.length_squared()).sum();
            Some(((squares / 2.0).sqrt(), (apart[0] + apart[1]) / 2.0))
        });
        let apart = apart.map(Option::unwrap_or_default);
        Some((apart.map(|it| it.0), apart.map(|it| it.1)))
    }
}
