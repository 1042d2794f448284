//! Verifies hand placement by re-synthesis: candidates are animated, and the one that puts the hand at
//! its observed position is reported.
//!
//! The first reading comes from the hand's position alone. But the animator pushes a hand out of the trunk
//! that should touch it, stops a hand at its joint limits, and lets a hand give way to its arm. The right
//! notation, animated by the same rules, puts the hand within a fraction of a millimetre of the observed
//! position, and few others do.

use std::cell::Cell;
use std::ops::Range;

use chereme_motion::Clip;
use chereme_sign::hamnosys::{Each, Sign};
use glam::DVec3;

use super::aim::Turned;
use super::place::{Body, Placed};
use super::scene::Axes;
use super::tree::{self, Begun, Picked, Sight, Stand};
use super::{Performs, Transcription};
use crate::transcribe::tuned::tuned;

/// Returns the ranks of the candidate places of a hand that are tried in turn; the next range is tried only if no place
/// of the one before fits.
fn ranks() -> [Range<usize>; 3] {
    let [few, more, most] = tuned().resynthesis.places;
    [0..few, few..more, more..most]
}

/// The most postures that are synthesised for one sign.
pub const MOST_POSTURES: usize = 1000;

/// Writes the notation of a scene; with `performs`, verifies the places by re-synthesis.
pub(super) fn written<'a>(sight: &'a Sight<'a>, performs: Option<&dyn Performs>) -> Transcription {
    let (transcription, begun) = tree::written(sight, Picked::default());
    let (Some(begun), Some(performs)) = (begun, performs) else {
        return transcription;
    };
    let Some(mut body) = sight.look(begun.frame) else {
        return transcription;
    };
    if let Some(by) = begun.behind {
        body.shift(1, by);
    }
    let proof = Proof {
        sight,
        performs,
        begun: &begun,
        inferred: &transcription.sign,
        body,
        left: Cell::new(MOST_POSTURES),
    };
    let Some((picked, mut off)) = proof.best() else {
        return transcription;
    };
    let mut found = transcription.clone();
    if let Some(picked) = picked {
        found = tree::written(sight, picked).0;
        // The trial may have left out the actions or written them in other words.
        let whole = performs.performs(&found.sign);
        off = whole.and_then(|clip| proof.off(&clip)).unwrap_or(off);
    }
    let open = proof.open(off);
    let tracks = open
        .iter()
        .filter_map(|&n| Some((n, sight.scene.hands[n].as_ref()?)));
    found.findings.extend(tracks.map(|(n, track)| {
        format!(
            "re-synthesised, the {} hand begins {:.1} cm from its observed place",
            track.side.name(),
            100.0 * off[n]
        )
    }));
    found
}

/// An alternative reading of the first posture.
#[derive(Clone)]
struct Trial {
    stand: Stand,
    turned: [Option<Turned>; 2],
    /// Whether the hands mirror each other at first, but act separately afterwards.
    mirrored: bool,
    /// Whether to leave out the actions.
    still: bool,
}

/// A trial with the result of its re-synthesis.
struct Tried {
    trial: Trial,
    /// Its penalty in nepers; the simplest reading, if exact, has none.
    total: f64,
    /// The error of each hand: the distance between its observed and its re-synthesised position, in
    /// metres.
    off: [f64; 2],
}

impl Trial {
    fn with(&self, stand: Stand) -> Self {
        Self {
            stand,
            ..self.clone()
        }
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
    /// Returns the readings that the trial fixes, and the error of each hand (m).
    fn picked(self) -> (Option<Picked>, [f64; 2]) {
        let middle = |placed: &Placed| {
            let mut sites = placed.place.site.iter().chain(&placed.place.second);
            sites.all(|site| site.side.is_none())
        };
        let stand = match self.trial.stand {
            Stand::Each([Some(own), Some(other)])
                if self.trial.mirrored && own.place == other.place && middle(&own) =>
            {
                Stand::One(0, own)
            }
            stand => stand,
        };
        let picked = Picked {
            stand: Some(stand),
            turned: self.trial.turned,
            mirrored: self.trial.mirrored,
        };
        (Some(picked), self.off)
    }
}

struct Proof<'a, 'p> {
    sight: &'a Sight<'a>,
    performs: &'p dyn Performs,
    begun: &'p Begun,
    inferred: &'p Sign,
    body: Body<'a>,
    /// The number of postures that may still be synthesised.
    left: Cell<usize>,
}

impl Proof<'_, '_> {
    /// Returns a better reading, if any, and the error of each hand (m); `None` if the first reading is
    /// already right, or cannot be synthesised.
    fn best(&self) -> Option<(Option<Picked>, [f64; 2])> {
        let first = Trial {
            stand: self.begun.stand.clone(),
            turned: [None, None],
            mirrored: false,
            still: false,
        };
        let begun = self.off(&self.performs.begins(self.inferred)?)?;
        if self.open(begun).is_empty() {
            return None;
        }
        if let Some(unsaid) = self.unsaid(&first) {
            return Some(unsaid);
        }
        let mut best = self.tried(
            first,
            &self.performs.performs(self.inferred)?,
            tuned().resynthesis.exact,
        )?;
        let first_off = best.off;
        let mut near = self.moved(&mut best, &ranks());
        for other in self.other_forms(&best.trial) {
            if self.open(best.off).is_empty() {
                break;
            }
            let Some(mut other) = self.begun_as(other) else {
                continue;
            };
            let far = if matches!(other.trial.stand, Stand::Together(..)) {
                1
            } else {
                2
            };
            self.moved(&mut other, &ranks()[..far]);
            // A match of the other hand alone may be chance.
            let [open, before] = [other.off, best.off].map(|off| self.open(off));
            if open.len() < before.len() && !open.contains(&0) {
                best = other;
                near = Default::default();
            }
        }
        for (n, near) in near.into_iter().enumerate() {
            if self.amiss(&best).contains(&n) {
                self.try_all(self.turned(near, n), &mut best);
            }
        }
        if !self.open(best.off).is_empty() {
            // A wrong reading of the actions may displace the hand.
            let still = Trial {
                still: true,
                ..best.trial.clone()
            };
            let mut still = self.begun_as(still)?;
            self.moved(&mut still, &ranks()[..2]);
            if self.open(still.off).len() < self.open(best.off).len() {
                best = still;
            }
        }
        let fewer = |within: f64| {
            let [best, first_off] = [best.off, first_off].map(|off| self.beyond(off, within).len());
            best < first_off
        };
        if !fewer(tuned().resynthesis.nearly) && !fewer(tuned().resynthesis.almost) {
            return Some((None, first_off));
        }
        Some(best.picked())
    }

    /// Returns the reading without any place, if re-synthesis of it puts the hands where they were
    /// observed.
    fn unsaid(&self, first: &Trial) -> Option<(Option<Picked>, [f64; 2])> {
        let begun = self.begun_as(first.with(Stand::Unsaid))?;
        if !self.open(begun.off).is_empty() {
            return None;
        }
        let whole = self.performs.performs(&begun.trial.sign(self.inferred))?;
        let whole = self.tried(begun.trial, &whole, tuned().resynthesis.exact)?;
        self.beyond(whole.off, tuned().resynthesis.exact)
            .is_empty()
            .then(|| whole.picked())
    }

    fn begun_as(&self, trial: Trial) -> Option<Tried> {
        let clip = self.performs.begins(&trial.sign(self.inferred))?;
        self.tried(trial, &clip, tuned().resynthesis.nearly)
    }

    /// Tries other places for hands that miss their observed position, updates `best`, and returns the
    /// trials of each hand.
    fn moved(&self, best: &mut Tried, places: &[Range<usize>]) -> [Vec<Tried>; 2] {
        let mut near: [Vec<Tried>; 2] = Default::default();
        for (n, near) in near.iter_mut().enumerate() {
            if !self.amiss(best).contains(&n) {
                continue;
            }
            let all = self.places(&best.trial, n);
            let some = places.iter();
            let some = some.map(|some| all.get(some.start..some.end.min(all.len())));
            for some in some.flatten() {
                if self.amiss(best).contains(&n) {
                    near.extend(self.try_all(some.to_vec(), best));
                }
            }
        }
        near
    }

    /// Returns the hands that miss their observed position: those whose error `off` is above
    /// `resynthesis.nearly`, both in metres.
    fn open(&self, off: [f64; 2]) -> Vec<usize> {
        self.beyond(off, tuned().resynthesis.nearly)
    }

    /// Returns the hands whose reading is responsible for a miss, of their own or of the hands that follow
    /// them.
    fn amiss(&self, tried: &Tried) -> Vec<usize> {
        let open = self.open(tried.off);
        match &tried.trial.stand {
            Stand::Each(_) => open,
            _ if open.is_empty() => open,
            Stand::Unsaid => Vec::new(),
            Stand::One(own, _) => vec![*own],
            Stand::Together(..) => vec![0],
        }
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

    /// Returns trials with other places for hand `n`, or for both in a constellation, the likeliest first.
    fn places(&self, from: &Trial, n: usize) -> Vec<Trial> {
        let [.., last] = ranks();
        let symmetric = self.begun.symmetric || from.mirrored;
        match &from.stand {
            Stand::One(own, _) if *own == n => {
                let all = self.body.likeliest(n, symmetric, last.end);
                let one = |placed| from.with(Stand::One(n, placed));
                all.into_iter().map(one).collect()
            }
            Stand::Each(both) => {
                let all = self.body.likeliest(n, symmetric, last.end);
                let each = |placed| {
                    let mut both = both.clone();
                    both[n] = Some(placed);
                    from.with(Stand::Each(both))
                };
                all.into_iter().map(each).collect()
            }
            Stand::Together(together, _) if n == 0 => {
                let all = self
                    .body
                    .likeliest_shared(together, tuned().resynthesis.shared);
                let both = |at| from.with(Stand::Together(together.clone(), at));
                all.into_iter().map(both).collect()
            }
            Stand::One(..) | Stand::Together(..) | Stand::Unsaid => Vec::new(),
        }
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
        let pairs = self
            .body
            .likeliest_pairs()
            .into_iter()
            .take(tuned().resynthesis.pairs);
        let together = pairs.filter_map(|together| {
            let at = self.body.likeliest_shared(&together, 1).pop()?;
            Some(Stand::Together(together, at))
        });
        let all = apart.into_iter().chain(together);
        let all = all.map(|stand| from.with(stand));
        mirrored.into_iter().chain(all).collect()
    }

    /// Returns trials with other orientations of hand `n`, at the places where it came nearest.
    fn turned(&self, mut near: Vec<Tried>, n: usize) -> Vec<Trial> {
        let Some(track) = self.sight.scene.hands[n]
            .as_ref()
            .filter(|track| track.faces)
        else {
            return Vec::new();
        };
        near.sort_by(|a, b| {
            let of = |tried: &Tried| {
                tried.trial.cost() + 0.5 * tried.off[n] / tuned().resynthesis.nearly
            };
            of(a).total_cmp(&of(b))
        });
        near.truncate(tuned().resynthesis.turned_at);
        let turns = self
            .sight
            .turned(track, self.begun.frame, tuned().resynthesis.turns + 1);
        let each = near.iter().flat_map(|tried| {
            turns[1..].iter().map(|turned| {
                let mut trial = tried.trial.clone();
                trial.turned[n] = Some(turned.clone());
                trial
            })
        });
        each.collect()
    }

    /// Synthesises the first posture of all trials and the whole sign of the nearest ones; updates `best`,
    /// and returns the trials with their errors.
    fn try_all(&self, trials: Vec<Trial>, best: &mut Tried) -> Vec<Tried> {
        let likely = trials.into_iter().filter(|trial| trial.cost() < best.total);
        let likely = likely.take_while(|_| {
            let left = self.left.get();
            self.left.set(left.saturating_sub(1));
            left > 0
        });
        let trials: Vec<Trial> = likely.collect();
        let signs: Vec<Sign> = trials
            .iter()
            .map(|trial| trial.sign(self.inferred))
            .collect();
        let clips = self.performs.begin_all(&signs).into_iter();
        let begun = trials.into_iter().zip(clips);
        let begun =
            begun.filter_map(|(trial, clip)| self.tried(trial, &clip?, tuned().resynthesis.nearly));
        let mut all: Vec<Tried> = begun.collect();
        all.sort_by(|a, b| a.total.total_cmp(&b.total));
        for nearest in all.iter().take(tuned().resynthesis.finalists) {
            if nearest.trial.cost() >= best.total {
                continue;
            }
            let whole = self.performs.performs(&nearest.trial.sign(self.inferred));
            let whole = whole.and_then(|clip| {
                self.tried(nearest.trial.clone(), &clip, tuned().resynthesis.exact)
            });
            if let Some(whole) = whole.filter(|whole| whole.total < best.total) {
                *best = whole;
            }
        }
        all
    }

    fn tried(&self, trial: Trial, clip: &Clip, exact: f64) -> Option<Tried> {
        let off = self.off(clip)?;
        let otherwise = trial.otherwise();
        let of = |n: usize| {
            (0.5 * (off[n] / exact).powi(2)).min(tuned().resynthesis.inexact + otherwise[n])
        };
        let unlikely = match &trial.stand {
            Stand::One(n, _) if self.begun.alone => of(*n),
            Stand::Each(_) => of(0) + of(1),
            Stand::Unsaid if self.begun.alone => of(self.sight.lead),
            Stand::One(..) | Stand::Together(..) | Stand::Unsaid => of(0).max(of(1)),
        };
        Some(Tried {
            total: trial.cost() + unlikely,
            trial,
            off,
        })
    }

    /// Returns the distance (m) between each hand in a clip's first frame and its observed position.
    fn off(&self, clip: &Clip) -> Option<[f64; 2]> {
        let scene = self.sight.scene;
        // If the observed clip begins within the sign, so does the synthesised one.
        let frame = if self.begun.first == 0 {
            0
        } else {
            self.begun.frame
        };
        let model = clip.model_pose(0);
        let axes = Axes::of(scene.anatomy, scene.alone, &model, scene.dominant)?;
        let off = scene.hands.each_ref().map(|track| {
            let track = track.as_ref()?;
            let hand = scene.anatomy.arm(track.side)?.hand;
            let along = scene.anatomy.hand_direction(track.side, &model)?;
            let ends = |wrist: DVec3, along: DVec3| [wrist, wrist + along * scene.hand];
            let own = ends(track.wrist[frame], track.along[frame]);
            let there = ends(axes.place(model.position(hand)), axes.direction(along));
            let apart = own.iter().zip(there).map(|(a, b)| a.distance_squared(b));
            Some((apart.sum::<f64>() / 2.0).sqrt())
        });
        Some(off.map(|off| off.unwrap_or(0.0)))
    }
}
