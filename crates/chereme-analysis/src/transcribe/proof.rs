//! Where hands are is proven by performing it: what comes back there is told.
//!
//! What a hand is at is told from where it is. But a hand that should touch the trunk is led out of it, one that
//! is turned too far stops, one that has room gives way to its arm. Performed by the same rules, what is meant brings the
//! hand to where it is, to a fraction of a millimetre, and little else does.

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

/// The places that are tried for a hand, the likeliest first: the next ones where none of these is it.
const PLACES: [Range<usize>; 3] = [0..40, 40..120, 120..300];
/// So many places are tried for two hands by each other, and so many pairs of parts of them.
const SHARED: usize = 100;
const PAIRS: usize = 8;
/// So many ways to be turned are tried at so many places.
const TURNS: usize = 12;
const TURNED_AT: usize = 24;
/// More postures than this are not tried of a sign.
pub const MOST_POSTURES: usize = 1000;
/// Of those that come nearest so many are performed to the end.
const FINALISTS: usize = 12;
/// Hands are where they are performed that are so near to there, in metres; and when only the posture is taken up.
const EXACT: f64 = 0.001;
const NEARLY: f64 = 0.0025;
/// How near to there what is told otherwise brings them at least.
const ALMOST: f64 = 0.0035;
/// How much less likely it is that a hand is not where what is told of it would bring it, in nepers.
const INEXACT: f64 = 6.0;

/// Writes down what the hands do; with `performs`, it is proven where they are.
pub(super) fn written<'a>(sight: &'a Sight<'a>, performs: Option<&dyn Performs>) -> Transcription {
    let (told, begun) = tree::written(sight, Picked::default());
    let (Some(begun), Some(performs)) = (begun, performs) else {
        return told;
    };
    let Some(mut body) = sight.look(begun.frame) else {
        return told;
    };
    if let Some(by) = begun.behind {
        body.shift(1, by);
    }
    let proof = Proof {
        sight,
        performs,
        begun: &begun,
        told: &told.sign,
        body,
        left: Cell::new(MOST_POSTURES),
    };
    let Some((picked, mut off)) = proof.best() else {
        return told;
    };
    let mut found = told.clone();
    if let Some(picked) = picked {
        found = tree::written(sight, picked).0;
        // What was tried may have left out what is done after, or said it in other words.
        let whole = performs.performs(&found.sign);
        off = whole.and_then(|clip| proof.off(&clip)).unwrap_or(off);
    }
    let open = proof.open(off);
    let tracks = open
        .iter()
        .filter_map(|&n| Some((n, sight.scene.hands[n].as_ref()?)));
    found.findings.extend(tracks.map(|(n, track)| {
        format!(
            "performed as told, the {} hand begins {:.1} cm from where it is",
            track.side.name(),
            100.0 * off[n]
        )
    }));
    found
}

/// Something that may be told.
#[derive(Clone)]
struct Trial {
    stand: Stand,
    turned: [Option<Turned>; 2],
    /// Whether the hands mirror each other to begin with, and each does for itself what is done after.
    mirrored: bool,
    /// Whether what is done after counts for nothing.
    still: bool,
}

/// A trial that was performed.
struct Tried {
    trial: Trial,
    /// How much less likely it is than what is plain and exact, in nepers.
    total: f64,
    /// How far either hand is from where it is performed, in metres.
    off: [f64; 2],
}

impl Trial {
    fn with(&self, stand: Stand) -> Self {
        Self {
            stand,
            ..self.clone()
        }
    }

    /// Returns how much less likely it is meant than what is plain, in nepers.
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

    /// Returns how much less likely either hand is where it is, than exactly there, if it is there otherwise.
    fn otherwise(&self) -> [f64; 2] {
        match &self.stand {
            Stand::One(_, placed) | Stand::Together(_, placed) => [placed.unlikely; 2],
            Stand::Each(both) => both
                .each_ref()
                .map(|placed| placed.as_ref().map_or(0.0, |placed| placed.unlikely)),
            Stand::Unsaid => [0.0; 2],
        }
    }

    /// Returns what is told with this in place of what it tells.
    fn sign(&self, told: &Sign) -> Sign {
        fn put<T>(each: &mut Each<T>, n: usize, value: T) {
            match each {
                Each::Shared(own) => *own = value,
                Each::Split(a, b) => *[a, b][n] = Some(value),
                Each::Unset => {}
            }
        }
        let mut sign = told.clone();
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
    /// Returns what is told of it, and how far either hand is then from where it is performed.
    fn told(self) -> (Option<Picked>, [f64; 2]) {
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
    told: &'p Sign,
    body: Body<'a>,
    /// So many postures may still be tried.
    left: Cell<usize>,
}

impl Proof<'_, '_> {
    /// Returns what is told better otherwise, if anything, and how far either hand is from where it is performed;
    /// nothing where what is told comes back, or cannot be performed.
    fn best(&self) -> Option<(Option<Picked>, [f64; 2])> {
        let first = Trial {
            stand: self.begun.stand.clone(),
            turned: [None, None],
            mirrored: false,
            still: false,
        };
        let begun = self.off(&self.performs.begins(self.told)?)?;
        if self.open(begun).is_empty() {
            return None;
        }
        if let Some(unsaid) = self.unsaid(&first) {
            return Some(unsaid);
        }
        let mut best = self.tried(first, &self.performs.performs(self.told)?, EXACT)?;
        let told = best.off;
        let mut near = self.moved(&mut best, &PLACES);
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
            self.moved(&mut other, &PLACES[..far]);
            // The other hand alone may be there by chance.
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
            // What a hand does after may be told wrong, and pull at it.
            let still = Trial {
                still: true,
                ..best.trial.clone()
            };
            let mut still = self.begun_as(still)?;
            self.moved(&mut still, &PLACES[..2]);
            if self.open(still.off).len() < self.open(best.off).len() {
                best = still;
            }
        }
        let fewer = |within: f64| {
            let [best, told] = [best.off, told].map(|off| self.beyond(off, within).len());
            best < told
        };
        if !fewer(NEARLY) && !fewer(ALMOST) {
            return Some((None, told));
        }
        Some(best.told())
    }

    /// Returns what is told without a word of where hands are, where that brings them to where they are.
    fn unsaid(&self, first: &Trial) -> Option<(Option<Picked>, [f64; 2])> {
        let begun = self.begun_as(first.with(Stand::Unsaid))?;
        if !self.open(begun.off).is_empty() {
            return None;
        }
        let whole = self.performs.performs(&begun.trial.sign(self.told))?;
        let whole = self.tried(begun.trial, &whole, EXACT)?;
        self.beyond(whole.off, EXACT)
            .is_empty()
            .then(|| whole.told())
    }

    fn begun_as(&self, trial: Trial) -> Option<Tried> {
        let clip = self.performs.begins(&trial.sign(self.told))?;
        self.tried(trial, &clip, NEARLY)
    }

    /// Moves hands that are not where they are performed to other places, and returns how near they came there.
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

    /// Returns the hands that are not where they are performed.
    fn open(&self, off: [f64; 2]) -> Vec<usize> {
        self.beyond(off, NEARLY)
    }

    /// Returns the hands whose place is told and does not bring all to where they are that go with them.
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

    /// Returns the hands that are farther off than so many metres, of those of which it is told where they are.
    fn beyond(&self, off: [f64; 2], within: f64) -> Vec<usize> {
        let told = |n: &usize| match &self.begun.stand {
            Stand::One(own, _) if self.begun.alone => own == n,
            _ => true,
        };
        (0..2).filter(told).filter(|&n| off[n] > within).collect()
    }

    /// Returns what hand `n` may be meant at, or both, the likeliest first, all else as it is.
    fn places(&self, from: &Trial, n: usize) -> Vec<Trial> {
        let [.., last] = PLACES;
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
                let all = self.body.likeliest_shared(together, SHARED);
                let both = |at| from.with(Stand::Together(together.clone(), at));
                all.into_iter().map(both).collect()
            }
            Stand::One(..) | Stand::Together(..) | Stand::Unsaid => Vec::new(),
        }
    }

    /// Returns other forms in which it may be told where two hands are: by each other, or not.
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
        let pairs = self.body.likeliest_pairs().into_iter().take(PAIRS);
        let together = pairs.filter_map(|together| {
            let at = self.body.likeliest_shared(&together, 1).pop()?;
            Some(Stand::Together(together, at))
        });
        let all = apart.into_iter().chain(together);
        let all = all.map(|stand| from.with(stand));
        mirrored.into_iter().chain(all).collect()
    }

    /// Returns other ways in which hand `n` may be turned where it came nearest.
    fn turned(&self, mut near: Vec<Tried>, n: usize) -> Vec<Trial> {
        let Some(track) = self.sight.scene.hands[n]
            .as_ref()
            .filter(|track| track.faces)
        else {
            return Vec::new();
        };
        near.sort_by(|a, b| {
            let of = |tried: &Tried| tried.trial.cost() + 0.5 * tried.off[n] / NEARLY;
            of(a).total_cmp(&of(b))
        });
        near.truncate(TURNED_AT);
        let turns = self.sight.turned(track, self.begun.frame, TURNS + 1);
        let each = near.iter().flat_map(|tried| {
            turns[1..].iter().map(|turned| {
                let mut trial = tried.trial.clone();
                trial.turned[n] = Some(turned.clone());
                trial
            })
        });
        each.collect()
    }

    /// Performs trials, all of them to their first posture and those nearest to the end; keeps the best, and returns
    /// how near all came.
    fn try_all(&self, trials: Vec<Trial>, best: &mut Tried) -> Vec<Tried> {
        let likely = trials.into_iter().filter(|trial| trial.cost() < best.total);
        let likely = likely.take_while(|_| {
            let left = self.left.get();
            self.left.set(left.saturating_sub(1));
            left > 0
        });
        let trials: Vec<Trial> = likely.collect();
        let signs: Vec<Sign> = trials.iter().map(|trial| trial.sign(self.told)).collect();
        let clips = self.performs.begin_all(&signs).into_iter();
        let begun = trials.into_iter().zip(clips);
        let begun = begun.filter_map(|(trial, clip)| self.tried(trial, &clip?, NEARLY));
        let mut all: Vec<Tried> = begun.collect();
        all.sort_by(|a, b| a.total.total_cmp(&b.total));
        for nearest in all.iter().take(FINALISTS) {
            if nearest.trial.cost() >= best.total {
                continue;
            }
            let whole = self.performs.performs(&nearest.trial.sign(self.told));
            let whole = whole.and_then(|clip| self.tried(nearest.trial.clone(), &clip, EXACT));
            if let Some(whole) = whole.filter(|whole| whole.total < best.total) {
                *best = whole;
            }
        }
        all
    }

    fn tried(&self, trial: Trial, clip: &Clip, exact: f64) -> Option<Tried> {
        let off = self.off(clip)?;
        let otherwise = trial.otherwise();
        let of = |n: usize| (0.5 * (off[n] / exact).powi(2)).min(INEXACT + otherwise[n]);
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

    /// Returns how far either hand is from where it is in a clip's first frame, in metres.
    fn off(&self, clip: &Clip) -> Option<[f64; 2]> {
        let scene = self.sight.scene;
        // Where the clip begins with the sign so does what is performed.
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
