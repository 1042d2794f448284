//! A dictionary of movements between keys, and sentences composed of them.
//!
//! A *dikey* is the movement of all parameters of hand and head from the target of one key to that of the next (Gibert
//! et al. 2004, section 5). The caller defines the meaning of parameters: numbers of a model of the hand, or angles of
//! joints. Time is in seconds.

use std::collections::{BTreeMap, BTreeSet};

use chereme_motion::interpolation::smooth_step;
use serde::Serialize;

/// A key: the number of its placement (0 is rest) and of its shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub struct DikeyEnd {
    /// The number of the placement; 0 is rest.
    pub placement: u8,
    /// The number of the handshape.
    pub shape: u8,
}

impl std::fmt::Display for DikeyEnd {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}{}", self.placement, self.shape)
    }
}

/// A captured movement from one key to the next.
#[derive(Debug, Clone, PartialEq)]
pub struct KeyTransition {
    /// The key at its first frame.
    pub from: DikeyEnd,
    /// The key at its last frame.
    pub to: DikeyEnd,
    /// The parameters of each frame, two frames or more.
    pub frames: Vec<Vec<f64>>,
    /// The recording and the frames that it was cut from.
    pub source: String,
}

/// A dictionary of dikeys.
#[derive(Debug, Clone, Default)]
pub struct DikeyDictionary {
    dikeys: Vec<KeyTransition>,
    by_ends: BTreeMap<(DikeyEnd, DikeyEnd), Vec<usize>>,
    /// Frames per second.
    rate: f64,
    /// The weight of each parameter, and its spread within a key.
    scale: Vec<(f64, f64)>,
    /// The means of the parameters at each key.
    keys: BTreeMap<DikeyEnd, Vec<f64>>,
    places: BTreeMap<u8, [f64; 3]>,
}

/// The weights of the costs of candidates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DikeyCostWeights {
    /// The cost of a duration that differs by 100 ms.
    pub duration: f64,
    /// The cost of a join whose ends differ by the spread within one key.
    pub join: f64,
}

impl Default for DikeyCostWeights {
    fn default() -> Self {
        Self {
            duration: 1.0,
            join: 1.0,
        }
    }
}

/// A piece of a sentence: a pair of keys with its dikey, and their cost.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DikeyPiece {
    /// The wanted pair of keys.
    pub wanted: (DikeyEnd, DikeyEnd),
    /// The index of the dikey; `None` for a synthetic ramp between the means of the two keys.
    pub dikey: Option<usize>,
    /// The recording and the frames that it was cut from.
    pub source: String,
    /// The ends of the dikey that replaces a missing one.
    pub instead: Option<(DikeyEnd, DikeyEnd)>,
    /// The cost of its duration.
    pub duration_cost: f64,
    /// The cost of the join to the piece before.
    pub join_cost: f64,
}

/// The strongest compression and the longest stretch of a dikey in time; beyond the latter the hand is held at the
/// target.
const DIKEY_STRETCH_RANGE: (f64, f64) = (0.5, 2.5);

impl DikeyDictionary {
    /// Cuts the dikeys between neighbouring targets from a take; `targets` holds the key and the frame of each, in
    /// order of time.
    #[must_use]
    pub fn cut_dikeys(rows: &[Vec<f64>], targets: &[(DikeyEnd, usize)], source: &str) -> Vec<KeyTransition> {
        let mut dikeys = Vec::new();
        for pair in targets.windows(2) {
            let ((from, start), (to, end)) = (pair[0], pair[1]);
            if start < end && end < rows.len() {
                dikeys.push(KeyTransition {
                    from,
                    to,
                    frames: rows[start..=end].to_vec(),
                    source: format!("{source} frames {start}-{end}"),
                });
            }
        }
        dikeys
    }

    /// Returns a dictionary; `weights` holds the variance that each parameter explains, `places` the position of each
    /// placement. Dikeys with fewer than two frames, or of another width, are left out.
    #[must_use]
    pub fn new(dikeys: Vec<KeyTransition>, rate: f64, weights: &[f64], places: BTreeMap<u8, [f64; 3]>) -> Self {
        let width = weights.len();
        let legal = |dikey: &KeyTransition| {
            dikey.frames.len() > 1
                && dikey
                    .frames
                    .iter()
                    .all(|row| row.len() == width && row.iter().all(|x| x.is_finite()))
        };
        let dikeys: Vec<KeyTransition> = dikeys.into_iter().filter(legal).collect();
        let mut by_ends: BTreeMap<_, Vec<usize>> = BTreeMap::new();
        let mut at_key: BTreeMap<DikeyEnd, Vec<&[f64]>> = BTreeMap::new();
        for (n, dikey) in dikeys.iter().enumerate() {
            by_ends.entry((dikey.from, dikey.to)).or_default().push(n);
            let (first, last) = (&dikey.frames[0], &dikey.frames[dikey.frames.len() - 1]);
            // Each movement begins at one key and ends at the next, so that both ends say how a key looks.
            at_key.entry(dikey.from).or_default().push(first);
            at_key.entry(dikey.to).or_default().push(last);
        }
        let mean = |rows: &[&[f64]]| -> Vec<f64> {
            let sum = |n: usize| rows.iter().map(|row| row[n]).sum::<f64>();
            (0..width).map(|n| sum(n) / rows.len() as f64).collect()
        };
        let keys: BTreeMap<DikeyEnd, Vec<f64>> = at_key.iter().map(|(key, rows)| (*key, mean(rows))).collect();
        let mut squares = vec![0.0; width];
        let mut count: f64 = 0.0;
        for (key, rows) in &at_key {
            for row in rows {
                count += 1.0;
                for ((square, x), mean) in squares.iter_mut().zip(*row).zip(&keys[key]) {
                    *square += (x - mean) * (x - mean);
                }
            }
        }
        let scale = weights
            .iter()
            .zip(&squares)
            // A parameter that never differs must not divide by nothing.
            .map(|(weight, square)| (*weight, (square / count.max(1.0)).sqrt().max(1e-9)))
            .collect();
        Self {
            dikeys,
            by_ends,
            rate,
            scale,
            keys,
            places,
        }
    }

    /// Returns its dikeys.
    #[must_use]
    pub fn dictionary_dikeys(&self) -> &[KeyTransition] {
        &self.dikeys
    }

    /// Returns the number of different dikeys in it, of the 1,680 that 41 keys can have.
    #[must_use]
    pub fn count_dikey_kinds(&self) -> usize {
        self.by_ends.len()
    }

    /// Returns the pairs of keys of a script that the dictionary lacks, each with its number of occurrences.
    #[must_use]
    pub fn missing_dikeys(&self, script: &[Vec<DikeyEnd>]) -> BTreeMap<(DikeyEnd, DikeyEnd), usize> {
        let mut missing = BTreeMap::new();
        for pair in script.iter().flat_map(|keys| keys.windows(2)) {
            if !self.by_ends.contains_key(&(pair[0], pair[1])) {
                *missing.entry((pair[0], pair[1])).or_default() += 1;
            }
        }
        missing
    }

    /// Returns the sentences of a script that would add most dikeys, the best first: the index of each, and the number
    /// of dikeys that it adds to the ones before it.
    #[must_use]
    pub fn worth_recording(&self, script: &[Vec<DikeyEnd>], most: usize) -> Vec<(usize, usize)> {
        let mut known_pairs: BTreeSet<(DikeyEnd, DikeyEnd)> = self.by_ends.keys().copied().collect();
        let pairs: Vec<BTreeSet<(DikeyEnd, DikeyEnd)>> = script
            .iter()
            .map(|keys| keys.windows(2).map(|pair| (pair[0], pair[1])).collect())
            .collect();
        let mut chosen = Vec::new();
        while chosen.len() < most {
            let adds = pairs
                .iter()
                .enumerate()
                .map(|(n, own)| (own.difference(&known_pairs).count(), n));
            let Some((count, n)) = adds.reduce(|best, next| if next.0 > best.0 { next } else { best }) else {
                break;
            };
            if count == 0 {
                break;
            }
            known_pairs.extend(pairs[n].iter().copied());
            chosen.push((n, count));
        }
        chosen
    }

    /// Chooses dikeys for keys with the times of their targets, so that the sum of both costs is least; among equals,
    /// the lowest index wins.
    #[must_use]
    pub fn select_dikeys(&self, wanted: &[(DikeyEnd, f64)], costs: &DikeyCostWeights) -> Vec<DikeyPiece> {
        let mut steps: Vec<Vec<DikeyCandidate>> = Vec::new();
        for pair in wanted.windows(2) {
            steps.push(self.dikey_candidates(pair[0].0, pair[1].0, pair[1].1 - pair[0].1, costs));
        }
        let chosen = self.cheapest_dikey_path(&steps, costs);
        let mut pieces: Vec<DikeyPiece> = Vec::with_capacity(steps.len());
        for (n, pair) in wanted.windows(2).enumerate() {
            let chosen_candidate = &steps[n][chosen[n]];
            let before = n.checked_sub(1).map(|n| &steps[n][chosen[n]]);
            let join = before.map_or(0.0, |before| self.dikey_join_cost(before, chosen_candidate, costs));
            let dikey = chosen_candidate.dikey.map(|n| &self.dikeys[n]);
            let ends = dikey.map(|dikey| (dikey.from, dikey.to));
            let asked = (pair[0].0, pair[1].0);
            pieces.push(DikeyPiece {
                wanted: asked,
                dikey: chosen_candidate.dikey,
                source: dikey.map_or_else(|| "synthetic".to_owned(), |piece| piece.source.clone()),
                instead: ends.filter(|ends| *ends != asked),
                duration_cost: chosen_candidate.duration,
                join_cost: join,
            });
        }
        pieces
    }

    /// Returns the candidates for a pair of keys: exact ones, else those whose second placement is the nearest to the
    /// wanted one, else those with the nearest first placement, else a ramp.
    fn dikey_candidates(
        &self,
        from: DikeyEnd,
        to: DikeyEnd,
        length: f64,
        costs: &DikeyCostWeights,
    ) -> Vec<DikeyCandidate> {
        // The shape of fingers is kept in any case; the place may be that of a neighbour.
        let recorded_dikeys = self
            .by_ends
            .get(&(from, to))
            .or_else(|| {
                let with = |place| (from, DikeyEnd { placement: place, ..to });
                self.nearest_placement_dikeys(to.placement, with)
            })
            .or_else(|| {
                let with = |place| {
                    (
                        DikeyEnd {
                            placement: place,
                            ..from
                        },
                        to,
                    )
                };
                self.nearest_placement_dikeys(from.placement, with)
            });
        let Some(found) = recorded_dikeys else {
            return vec![DikeyCandidate {
                dikey: None,
                duration: 0.0,
                ends: [self.mean_of(from), self.mean_of(to)],
            }];
        };
        let candidate = |n: &usize| {
            let frames = &self.dikeys[*n].frames;
            let dikey_seconds = (frames.len() - 1) as f64 / self.rate;
            DikeyCandidate {
                dikey: Some(*n),
                duration: costs.duration * (dikey_seconds - length).abs() / 0.1,
                ends: [frames[0].clone(), frames[frames.len() - 1].clone()],
            }
        };
        found.iter().map(candidate).collect()
    }

    fn nearest_placement_dikeys(
        &self,
        placement: u8,
        with: impl Fn(u8) -> (DikeyEnd, DikeyEnd),
    ) -> Option<&Vec<usize>> {
        let placement_point = self.places.get(&placement)?;
        let apart =
            |other: &[f64; 3]| -> f64 { placement_point.iter().zip(other).map(|(a, b)| (a - b) * (a - b)).sum() };
        let mut others: Vec<(f64, u8)> = self
            .places
            .iter()
            .filter(|(place, _)| **place != placement)
            .map(|(place, at)| (apart(at), *place))
            .collect();
        others.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        others.iter().find_map(|(_, place)| self.by_ends.get(&with(*place)))
    }

    /// Returns the mean of the parameters at a key; if no dikey has that key, the mean at the most similar one.
    fn mean_of(&self, key: DikeyEnd) -> Vec<f64> {
        let alike = |own: &DikeyEnd| u8::from(own.shape != key.shape) * 2 + u8::from(own.placement != key.placement);
        let nearest_key = self.keys.iter().min_by_key(|(own, _)| alike(own));
        nearest_key.map_or_else(|| vec![0.0; self.scale.len()], |(_, mean)| mean.clone())
    }

    fn dikey_join_cost(&self, before: &DikeyCandidate, own: &DikeyCandidate, costs: &DikeyCostWeights) -> f64 {
        let all: f64 = self.scale.iter().map(|(weight, _)| weight).sum();
        let numbers = before.ends[1].iter().zip(&own.ends[0]).zip(&self.scale);
        let square: f64 = numbers
            .map(|((a, b), (weight, spread))| weight * ((a - b) / spread).powi(2))
            .sum();
        costs.join * (square / all.max(1e-12)).sqrt()
    }

    fn cheapest_dikey_path(&self, steps: &[Vec<DikeyCandidate>], costs: &DikeyCostWeights) -> Vec<usize> {
        // Viterbi's algorithm: the least cost of each candidate, and the one before it.
        let mut table: Vec<Vec<(f64, usize)>> = Vec::with_capacity(steps.len());
        for (n, own) in steps.iter().enumerate() {
            let row = own.iter().map(|candidate| {
                let Some(before) = n.checked_sub(1) else {
                    return (candidate.duration, 0);
                };
                let previous_sums = steps[before].iter().zip(&table[before]).enumerate();
                let sums = previous_sums
                    .map(|(at, (other, (sum, _)))| (sum + self.dikey_join_cost(other, candidate, costs), at));
                let best = sums.reduce(|best, next| if next.0 < best.0 { next } else { best });
                let (sum, at) = best.unwrap_or((0.0, 0));
                (sum + candidate.duration, at)
            });
            table.push(row.collect());
        }
        let mut chosen = vec![0; steps.len()];
        let last = table.last().map(|row| {
            let ends = row.iter().enumerate().map(|(at, (sum, _))| (*sum, at));
            ends.reduce(|best, next| if next.0 < best.0 { next } else { best })
        });
        let mut candidate_index = last.flatten().map_or(0, |(_, at)| at);
        for n in (0..steps.len()).rev() {
            chosen[n] = candidate_index;
            candidate_index = table[n][candidate_index].1;
        }
        chosen
    }

    /// Returns the parameters frame by frame, from the first target to the last: each dikey is warped to the time
    /// between its targets, and the jump to the next one is spread over it as a linear ramp.
    #[must_use]
    pub fn render_dikeys(&self, pieces: &[DikeyPiece], wanted: &[(DikeyEnd, f64)]) -> Vec<Vec<f64>> {
        let ends = |n: usize| -> [Vec<f64>; 2] {
            match pieces[n].dikey.and_then(|n| self.dikeys.get(n)) {
                Some(dikey) => [dikey.frames[0].clone(), dikey.frames[dikey.frames.len() - 1].clone()],
                None => [self.mean_of(pieces[n].wanted.0), self.mean_of(pieces[n].wanted.1)],
            }
        };
        let Some((first, last)) = wanted.first().zip(wanted.last()) else {
            return Vec::new();
        };
        let frames = ((last.1 - first.1) * self.rate).round().max(0.0) as usize + 1;
        let mut out = Vec::with_capacity(frames);
        let mut n = 0;
        for frame in 0..frames {
            let time = first.1 + frame as f64 / self.rate;
            while n + 1 < pieces.len() && time >= wanted[n + 1].1 {
                n += 1;
            }
            if pieces.is_empty() {
                out.push(self.mean_of(first.0));
                continue;
            }
            let (start, end) = (wanted[n].1, wanted[n + 1].1);
            let share = ((time - start) / (end - start).max(1e-9)).clamp(0.0, 1.0);
            let [own_start, own_end] = ends(n);
            let mut row = match pieces[n].dikey.and_then(|n| self.dikeys.get(n)) {
                Some(dikey) => warped(dikey, share, end - start, self.rate),
                None => {
                    // A ramp that begins and ends at rest.
                    let eased = smooth_step(share);
                    let both = own_start.iter().zip(&own_end);
                    both.map(|(a, b)| a + (b - a) * eased).collect()
                }
            };
            // The jump to the next dikey is spread over this one, so that its end is where the next one starts.
            let goal = match pieces.get(n + 1) {
                Some(_) => Some(ends(n + 1)[0].clone()),
                None => pieces[n].instead.map(|_| self.mean_of(pieces[n].wanted.1)),
            };
            if let Some(goal) = goal {
                for ((x, goal), end) in row.iter_mut().zip(&goal).zip(&own_end) {
                    *x += (goal - end) * share;
                }
            }
            out.push(row);
        }
        out
    }
}

/// Returns a dikey's parameters at a share of its new time; beyond the longest stretch it waits at its target.
fn warped(dikey: &KeyTransition, share: f64, length: f64, rate: f64) -> Vec<f64> {
    let last = dikey.frames.len() - 1;
    let dikey_seconds = last as f64 / rate;
    let moving = length.min(dikey_seconds * DIKEY_STRETCH_RANGE.1);
    let share = (share * length / moving.max(1e-9)).min(1.0);
    let frame_position = share * last as f64;
    let first = (frame_position.floor() as usize).min(last);
    let next = (first + 1).min(last);
    let both = dikey.frames[first].iter().zip(&dikey.frames[next]);
    both.map(|(a, b)| a + (b - a) * frame_position.fract()).collect()
}

struct DikeyCandidate {
    dikey: Option<usize>,
    duration: f64,
    ends: [Vec<f64>; 2],
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(placement: u8, shape: u8) -> DikeyEnd {
        DikeyEnd { placement, shape }
    }

    /// Numbers from 0 to 1 that are the same every time.
    fn random(seed: &mut u64) -> f64 {
        *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (*seed >> 40) as f64 / (1u64 << 24) as f64
    }

    fn places() -> BTreeMap<u8, [f64; 3]> {
        let at = [
            (0, [90.0, -130.0, 0.0]),
            (1, [97.0, 46.0, 0.0]),
            (2, [34.0, 40.0, 0.0]),
            (3, [10.0, 14.0, 0.0]),
            (4, [50.0, 75.0, 0.0]),
            (5, [9.0, -52.0, 0.0]),
        ];
        at.into_iter().collect()
    }

    #[test]
    fn the_cheapest_sequence_equals_that_of_an_exhaustive_search() {
        let mut seed = 1;
        for _ in 0..200 {
            let keys = [key(1, 1), key(2, 2), key(3, 3), key(4, 4)];
            let mut dikeys = Vec::new();
            for pair in keys.windows(2) {
                for _ in 0..3 {
                    let frames = 2 + (random(&mut seed) * 20.0) as usize;
                    let row = |seed: &mut u64| vec![random(seed), random(seed)];
                    dikeys.push(KeyTransition {
                        from: pair[0],
                        to: pair[1],
                        frames: (0..frames).map(|_| row(&mut seed)).collect(),
                        source: String::new(),
                    });
                }
            }
            let book = DikeyDictionary::new(dikeys, 50.0, &[2.0, 1.0], places());
            let times: Vec<(DikeyEnd, f64)> = keys
                .iter()
                .zip([0.0, 0.2, 0.5, 0.7])
                .map(|(key, time)| (*key, time))
                .collect();
            let costs = DikeyCostWeights::default();
            let pieces = book.select_dikeys(&times, &costs);
            let sum: f64 = pieces.iter().map(|piece| piece.duration_cost + piece.join_cost).sum();
            let of = |n: usize| book.dikey_candidates(keys[n], keys[n + 1], times[n + 1].1 - times[n].1, &costs);
            let (a, b, c) = (of(0), of(1), of(2));
            let mut best = f64::INFINITY;
            for a in &a {
                for b in &b {
                    for c in &c {
                        let joins = book.dikey_join_cost(a, b, &costs) + book.dikey_join_cost(b, c, &costs);
                        best = best.min(a.duration + b.duration + c.duration + joins);
                    }
                }
            }
            assert!((sum - best).abs() < 1e-12, "{sum} {best}");
            assert_eq!(pieces, book.select_dikeys(&times, &costs));
        }
    }

    /// A take of keys at every tenth frame, in two parameters.
    fn take(keys: &[DikeyEnd], seed: &mut u64) -> (Vec<Vec<f64>>, Vec<(DikeyEnd, usize)>) {
        let at = |key: DikeyEnd, seed: &mut u64| {
            let place = places()[&key.placement];
            vec![place[0] + random(seed), f64::from(key.shape) * 10.0 + random(seed)]
        };
        let goals: Vec<Vec<f64>> = keys.iter().map(|key| at(*key, seed)).collect();
        let mut rows = Vec::new();
        for pair in goals.windows(2) {
            for step in 0..10 {
                let share = f64::from(step) / 10.0;
                let eased = share * share * (3.0 - 2.0 * share);
                rows.push(pair[0].iter().zip(&pair[1]).map(|(a, b)| a + (b - a) * eased).collect());
            }
        }
        rows.push(goals[goals.len() - 1].clone());
        let targets = keys.iter().enumerate().map(|(n, key)| (*key, 10 * n)).collect();
        (rows, targets)
    }

    fn timed(targets: &[(DikeyEnd, usize)]) -> Vec<(DikeyEnd, f64)> {
        targets
            .iter()
            .map(|(key, frame)| (*key, *frame as f64 / 50.0))
            .collect()
    }

    #[test]
    fn a_sentence_of_the_dictionary_is_reproduced_exactly() {
        let mut seed = 5;
        let keys = [
            key(0, 0),
            key(2, 4),
            key(3, 1),
            key(1, 3),
            key(2, 4),
            key(5, 5),
            key(0, 0),
        ];
        let (rows, targets) = take(&keys, &mut seed);
        let book = DikeyDictionary::new(
            DikeyDictionary::cut_dikeys(&rows, &targets, "take 1"),
            50.0,
            &[1.0, 1.0],
            places(),
        );
        assert_eq!(book.count_dikey_kinds(), 6);
        let wanted = timed(&targets);
        let pieces = book.select_dikeys(&wanted, &DikeyCostWeights::default());
        assert!(
            pieces
                .iter()
                .all(|piece| piece.instead.is_none() && piece.dikey.is_some())
        );
        let made = book.render_dikeys(&pieces, &wanted);
        assert_eq!(made.len(), rows.len());
        for (made, row) in made.iter().zip(&rows) {
            for (a, b) in made.iter().zip(row) {
                assert!((a - b).abs() < 1e-9, "{a} {b}");
            }
        }
    }

    #[test]
    fn a_missing_dikey_is_taken_from_the_nearest_placement_and_joins_the_next() {
        let mut seed = 9;
        let (rows, targets) = take(&[key(1, 1), key(2, 2), key(3, 3), key(4, 3), key(1, 1)], &mut seed);
        let book = DikeyDictionary::new(
            DikeyDictionary::cut_dikeys(&rows, &targets, "take 1"),
            50.0,
            &[1.0, 1.0],
            places(),
        );
        // The pair from 22 to 33 exists, that to 53 does not; the chin is nearest to the throat.
        let wanted = timed(&[(key(1, 1), 0), (key(2, 2), 10), (key(5, 3), 25)]);
        let pieces = book.select_dikeys(&wanted, &DikeyCostWeights::default());
        assert_eq!(pieces[1].instead, Some((key(2, 2), key(3, 3))));
        assert_eq!(pieces[0].instead, None);
        let wanted = timed(&[(key(1, 1), 0), (key(2, 2), 10), (key(3, 3), 20), (key(4, 3), 30)]);
        let pieces = book.select_dikeys(&wanted, &DikeyCostWeights::default());
        let made = book.render_dikeys(&pieces, &wanted);
        let jump = made
            .windows(2)
            .map(|pair| (pair[1][0] - pair[0][0]).abs())
            .fold(0.0, f64::max);
        assert!(jump < 20.0, "no jump at joins: {jump}");
        let none = timed(&[(key(5, 7), 0), (key(4, 8), 10)]);
        let pieces = book.select_dikeys(&none, &DikeyCostWeights::default());
        assert_eq!((pieces[0].dikey, &*pieces[0].source), (None, "synthetic"));
        assert_eq!(book.render_dikeys(&pieces, &none).len(), 11);
        let missing = book.missing_dikeys(&[vec![key(1, 1), key(2, 2), key(5, 3)]]);
        assert_eq!(missing.into_iter().collect::<Vec<_>>(), [((key(2, 2), key(5, 3)), 1)]);
        let script = [vec![key(1, 1), key(2, 2)], vec![key(2, 2), key(5, 3), key(1, 1)]];
        assert_eq!(book.worth_recording(&script, 5), [(1, 2)]);
    }

    #[test]
    fn an_empty_dictionary_and_odd_rows_are_accepted() {
        let book = DikeyDictionary::new(Vec::new(), 50.0, &[1.0], places());
        assert!(book.select_dikeys(&[], &DikeyCostWeights::default()).is_empty());
        assert!(book.render_dikeys(&[], &[]).is_empty());
        let wanted = [(key(1, 1), 0.0), (key(2, 2), 0.3)];
        let pieces = book.select_dikeys(&wanted, &DikeyCostWeights::default());
        assert_eq!(book.render_dikeys(&pieces, &wanted).len(), 16);
        let odd = KeyTransition {
            from: key(1, 1),
            to: key(2, 2),
            frames: vec![vec![f64::NAN], vec![1.0]],
            source: String::new(),
        };
        assert_eq!(
            DikeyDictionary::new(vec![odd], 50.0, &[1.0], places()).count_dikey_kinds(),
            0
        );
    }
}
