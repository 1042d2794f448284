//! Computes a map: a position in a plane for each of many things, such as signs, with similar things near each other.
//!
//! [`find_feature_neighbours`] finds the nearest find_feature_neighbours by the cosine of sparse features. [`lay_out_map`] places the things from those
//! neighbours alone: two eigenvectors of the neighbour graph are the start (Belkin and Niyogi, *Laplacian eigenmaps*, 2003), and
//! stochastic steps with attraction along edges and repulsion from random others refine it (McInnes, Healy and Melville,
//! *UMAP*, 2018, section 3.2). The random numbers come from a fixed seed: the same neighbours give the same map. Only which things
//! are near has a meaning on such a map, not how far groups lie apart: so the positions are moved half of the distance to an even
//! use of the square, and groups have room inside and a gap between them.

use std::cmp::Ordering;
use std::f32::consts::PI;

use crate::random::RandomNumbers;

/// The features of a thing: indices of features with weights above 0, each index once.
pub type WeightedFeatures = Vec<(u32, f32)>;

/// The neighbours of a thing: the index of each and its similarity from 0 to 1, nearest first.
pub type SimilarNeighbours = Vec<(usize, f32)>;

/// The number of rounds of refinement.
const LAYOUT_ROUNDS: usize = 200;
/// The number of random things from which a thing is pushed away at each step along an edge (UMAP's negative samples).
const NEGATIVE_SAMPLES: usize = 5;
/// The curve of closeness 1 / (1 + a d^2b) for neighbours that lie at 0.1 or nearer (UMAP, section 3.2).
const CLOSENESS_CURVE: (f32, f32) = (1.577, 0.895);
/// The longest step along one axis.
const MAX_AXIS_STEP: f32 = 4.0;
/// The spread of the initial positions.
const INITIAL_LAYOUT_SPREAD: f32 = 10.0;
/// The number of directions in which positions are spread, and the share of the distance to an even use of the square.
const SPREAD_DIRECTIONS: usize = 48;
const EVENNESS_SHARE: f32 = 0.5;
/// The fraction of the golden ratio: its multiples turn through all directions evenly.
const GOLDEN_FRACTION: f32 = 0.618_034;
/// The number of rounds of power iteration for the initial positions.
const POWER_ITERATIONS: usize = 150;

/// Returns the nearest `count` neighbours of each thing by the cosine of their features; a thing that shares no feature
/// with others has no neighbour. Neighbours of equal similarity are in the order of their indices.
///
/// `goes_on` is called from time to time with the number of finished things. Returns `None` if it returns false.
pub fn find_feature_neighbours(
    things: &[WeightedFeatures],
    count: usize,
    mut goes_on: impl FnMut(usize) -> bool,
) -> Option<Vec<SimilarNeighbours>> {
    let features = things.iter().flatten().map(|&(feature, _)| feature).max();
    let mut holders: Vec<Vec<(usize, f32)>> = vec![Vec::new(); features.map_or(0, |feature| feature as usize + 1)];
    let lengths: Vec<f32> = things
        .iter()
        .map(|thing| thing.iter().map(|(_, weight)| weight * weight).sum::<f32>().sqrt())
        .collect();
    for (index, thing) in things.iter().enumerate() {
        for &(feature, weight) in thing {
            holders[feature as usize].push((index, weight / lengths[index]));
        }
    }
    let mut all = Vec::with_capacity(things.len());
    let mut likeness = vec![0.0_f32; things.len()];
    let mut touched: Vec<usize> = Vec::new();
    for (index, thing) in things.iter().enumerate() {
        if index % 64 == 0 && !goes_on(index) {
            return None;
        }
        // Only things that share a feature are compared.
        for &(feature, weight) in thing {
            for &(other, own) in &holders[feature as usize] {
                if likeness[other] == 0.0 {
                    touched.push(other);
                }
                likeness[other] += own * weight / lengths[index];
            }
        }
        let others = touched.iter().filter(|&&other| other != index);
        let mut near: SimilarNeighbours = others.map(|&other| (other, likeness[other].min(1.0))).collect();
        for other in touched.drain(..) {
            likeness[other] = 0.0;
        }
        let nearer =
            |a: &(usize, f32), b: &(usize, f32)| b.1.partial_cmp(&a.1).unwrap_or(Ordering::Equal).then(a.0.cmp(&b.0));
        if near.len() > count {
            near.select_nth_unstable_by(count, nearer);
            near.truncate(count);
        }
        near.sort_by(nearer);
        all.push(near);
    }
    Some(all)
}

/// Returns a position for each thing in a square from 0 to 1, so that neighbours lie near each other.
///
/// `goes_on` is called with the share of the work done. Returns `None` if it returns false.
pub fn lay_out_map(neighbours: &[SimilarNeighbours], mut goes_on: impl FnMut(f32) -> bool) -> Option<Vec<[f32; 2]>> {
    let edges = edges(neighbours);
    // A fixed seed gives equal corpora equal maps.
    let mut random = LayoutRandom(RandomNumbers::new(0x9E37_79B9_7F4A_7C15));
    let mut places = initial_map_positions(neighbours.len(), &edges, &mut random);
    let heaviest = edges.iter().map(|edge| edge.weight).fold(0.0, f32::max);
    // An edge takes part with a frequency proportional to its weight.
    let mut due: Vec<f32> = edges.iter().map(|edge| heaviest / edge.weight).collect();
    for round in 0..LAYOUT_ROUNDS {
        let share = round as f32 / LAYOUT_ROUNDS as f32;
        if !goes_on(share) {
            return None;
        }
        // Steps shrink evenly to nothing, as in UMAP.
        let rate = 1.0 - share;
        for (edge, due) in edges.iter().zip(&mut due) {
            if *due > (round + 1) as f32 {
                continue;
            }
            *due += heaviest / edge.weight;
            attract(&mut places, edge.a, edge.b, rate);
            for end in [edge.a, edge.b] {
                for _ in 0..NEGATIVE_SAMPLES / 2 + 1 {
                    let other = random.random_index_below(places.len());
                    if other != end {
                        repel(&mut places, end, other, rate);
                    }
                }
            }
        }
    }
    Some(fit_unit_square(spread_map_places(&fit_unit_square(places))))
}

struct NeighbourEdge {
    a: usize,
    b: usize,
    weight: f32,
}

/// Returns the edges of the neighbour graph. The weight of an edge is its similarity relative to that of the nearest
/// neighbour, so that things in sparse regions are attracted to their neighbours too; the two directions are combined
/// as in UMAP (section 3.1).
fn edges(neighbours: &[SimilarNeighbours]) -> Vec<NeighbourEdge> {
    let mut directed: Vec<(usize, usize, f32)> = Vec::new();
    for (index, near) in neighbours.iter().enumerate() {
        let nearest = near.first().map_or(1.0, |&(_, likeness)| likeness);
        for &(other, likeness) in near {
            let weight = (likeness / nearest).powi(4);
            directed.push((index.min(other), index.max(other), weight));
        }
    }
    directed.sort_by_key(|&(a, b, _)| (a, b));
    let mut edges: Vec<NeighbourEdge> = Vec::new();
    for (a, b, weight) in directed {
        match edges.last_mut() {
            Some(last) if (last.a, last.b) == (a, b) => last.weight += weight - last.weight * weight,
            _ => edges.push(NeighbourEdge { a, b, weight }),
        }
    }
    edges.retain(|edge| edge.weight > 1e-6);
    edges
}

/// Returns the initial positions: the second and third eigenvectors of the graph's random walk, with a little noise.
fn initial_map_positions(count: usize, edges: &[NeighbourEdge], random: &mut LayoutRandom) -> Vec<[f32; 2]> {
    // A thing without neighbours must not divide by zero.
    let mut degrees = vec![1e-6_f32; count];
    for edge in edges {
        degrees[edge.a] += edge.weight;
        degrees[edge.b] += edge.weight;
    }
    let roots: Vec<f32> = degrees.iter().map(|degree| degree.sqrt()).collect();
    // The first eigenvector is known: the roots of the degrees. It says nothing about places.
    let mut axes: Vec<Vec<f32>> = vec![normalise_map_vector(roots.clone())];
    for _ in 0..2 {
        let mut axis: Vec<f32> = (0..count).map(|_| random.random_signed_share()).collect();
        for _ in 0..POWER_ITERATIONS {
            // Adding half of the vector itself keeps the iteration away from negative eigenvalues.
            let mut next: Vec<f32> = axis.iter().map(|value| 0.5 * value).collect();
            for edge in edges {
                let weight = 0.5 * edge.weight / (roots[edge.a] * roots[edge.b]);
                next[edge.a] += weight * axis[edge.b];
                next[edge.b] += weight * axis[edge.a];
            }
            for earlier in &axes {
                let along: f32 = next.iter().zip(earlier).map(|(a, b)| a * b).sum();
                for (value, by) in next.iter_mut().zip(earlier) {
                    *value -= along * by;
                }
            }
            axis = normalise_map_vector(next);
        }
        axes.push(axis);
    }
    let mut places: Vec<[f32; 2]> = (0..count)
        .map(|index| [1, 2].map(|axis| axes[axis][index] / roots[index]))
        .collect();
    for axis in 0..2 {
        let largest = places.iter().map(|place| place[axis].abs()).fold(1e-12, f32::max);
        for place in &mut places {
            place[axis] = INITIAL_LAYOUT_SPREAD * place[axis] / largest + 0.01 * random.random_signed_share();
        }
    }
    places
}

fn normalise_map_vector(mut vector: Vec<f32>) -> Vec<f32> {
    let length = vector.iter().map(|value| value * value).sum::<f32>().sqrt();
    if length > 0.0 {
        vector.iter_mut().for_each(|value| *value /= length);
    }
    vector
}

fn attract(places: &mut [[f32; 2]], a: usize, b: usize, rate: f32) {
    let (away, squared) = map_place_offset(places[a], places[b]);
    if squared <= 0.0 {
        return;
    }
    let power = squared.powf(CLOSENESS_CURVE.1);
    // The derivative of the logarithm of the closeness.
    let pull = -2.0 * CLOSENESS_CURVE.0 * CLOSENESS_CURVE.1 * power / squared / (1.0 + CLOSENESS_CURVE.0 * power);
    for axis in 0..2 {
        let step = rate * (pull * away[axis]).clamp(-MAX_AXIS_STEP, MAX_AXIS_STEP);
        places[a][axis] += step;
        places[b][axis] -= step;
    }
}

fn repel(places: &mut [[f32; 2]], moved: usize, from: usize, rate: f32) {
    let (away, squared) = map_place_offset(places[moved], places[from]);
    // The derivative of the logarithm of 1 less the closeness; 0.001 bounds it where things coincide.
    let push =
        2.0 * CLOSENESS_CURVE.1 / ((0.001 + squared) * (1.0 + CLOSENESS_CURVE.0 * squared.powf(CLOSENESS_CURVE.1)));
    for axis in 0..2 {
        places[moved][axis] += rate * (push * away[axis]).clamp(-MAX_AXIS_STEP, MAX_AXIS_STEP);
    }
}

fn map_place_offset(a: [f32; 2], b: [f32; 2]) -> ([f32; 2], f32) {
    let away = [a[0] - b[0], a[1] - b[1]];
    (away, away[0] * away[0] + away[1] * away[1])
}

/// Moves positions part of the distance to places that fill the square evenly. Along one direction after another, each
/// position moves half of the distance to the even place of the same rank: this keeps the order along that direction, so that
/// near things stay near (sliced optimal transport).
fn spread_map_places(places: &[[f32; 2]]) -> Vec<[f32; 2]> {
    let count = places.len();
    // The fractions of multiples of two numbers fill a square evenly.
    let even: Vec<[f32; 2]> = (0..count)
        .map(|index| {
            [0.754_877_666_246_692_7, 0.569_840_290_998_053_2_f64].map(|by| ((index as f64 + 0.5) * by).fract() as f32)
        })
        .collect();
    let mut moved = places.to_vec();
    for turn in 0..SPREAD_DIRECTIONS {
        let angle = PI * (turn as f32 * GOLDEN_FRACTION).fract();
        let (sine, cosine) = angle.sin_cos();
        let along = |place: &[f32; 2]| place[0] * cosine + place[1] * sine;
        let mut goals: Vec<f32> = even.iter().map(along).collect();
        goals.sort_by(f32::total_cmp);
        let mut ranked_places: Vec<(f32, usize)> = moved.iter().map(along).zip(0..).collect();
        ranked_places.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        for (goal, (is, index)) in goals.into_iter().zip(ranked_places) {
            let step = 0.5 * (goal - is);
            moved[index][0] += step * cosine;
            moved[index][1] += step * sine;
        }
    }
    let both = places.iter().zip(moved);
    both.map(|(from, to)| [0, 1].map(|axis| from[axis] + EVENNESS_SHARE * (to[axis] - from[axis])))
        .collect()
}

/// Scales and moves positions into the square from 0 to 1, without changing their proportions.
fn fit_unit_square(mut places: Vec<[f32; 2]>) -> Vec<[f32; 2]> {
    let range = |axis: usize| {
        let values = places.iter().map(|place| place[axis]);
        let (least, most) = values.fold((f32::MAX, f32::MIN), |(a, b), it| (a.min(it), b.max(it)));
        (least, most - least)
    };
    let ranges = [range(0), range(1)];
    let scale = ranges[0].1.max(ranges[1].1).max(1e-6);
    for place in &mut places {
        for axis in 0..2 {
            let (least, width) = ranges[axis];
            place[axis] = (place[axis] - least + (scale - width) / 2.0) / scale;
        }
    }
    places
}

/// Random numbers in the forms that the layout needs.
struct LayoutRandom(RandomNumbers);

impl LayoutRandom {
    fn random_index_below(&mut self, limit: usize) -> usize {
        (self.0.random_bits() % limit.max(1) as u64) as usize
    }

    /// Returns a number from -1 to 1.
    fn random_signed_share(&mut self) -> f32 {
        // An `f32` holds 24 bits.
        (self.0.random_bits() >> 40) as f32 / (1_u64 << 23) as f32 - 1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns things on a grid in a plane. Each has a feature for every square near it, so that similarity falls with
    /// distance.
    fn grid(side: usize) -> Vec<WeightedFeatures> {
        let number = |x: i32, y: i32| (y + 2) as u32 * (side as u32 + 4) + (x + 2) as u32;
        let near = |x: i32, y: i32| {
            let around = (-2..=2).flat_map(move |dx| (-2..=2).map(move |dy| (dx, dy)));
            around.map(move |(dx, dy): (i32, i32)| (number(x + dx, y + dy), 3.0 - (dx.abs().max(dy.abs())) as f32))
        };
        (0..side * side)
            .map(|at| near((at % side) as i32, (at / side) as i32).collect())
            .collect()
    }

    #[test]
    fn neighbours_equal_those_of_a_comparison_of_all_pairs() {
        let things = grid(7);
        let found = find_feature_neighbours(&things, 6, |_| true).expect("not stopped");
        let cosine = |a: &WeightedFeatures, b: &WeightedFeatures| {
            let length = |it: &WeightedFeatures| it.iter().map(|(_, w)| w * w).sum::<f32>().sqrt();
            let both = a.iter().flat_map(|(feature, weight)| {
                let same = b.iter().filter(move |(other, _)| other == feature);
                same.map(move |(_, other)| weight * other)
            });
            both.sum::<f32>() / length(a) / length(b)
        };
        for (index, near) in found.iter().enumerate() {
            let mut all: Vec<f32> = (0..things.len())
                .filter(|&other| other != index)
                .map(|other| cosine(&things[index], &things[other]))
                .collect();
            all.sort_by(|a, b| b.total_cmp(a));
            assert_eq!(near.len(), 6);
            for (&(other, likeness), expected) in near.iter().zip(all) {
                assert!((likeness - expected).abs() < 1e-5);
                assert!((likeness - cosine(&things[index], &things[other])).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn near_items_stay_near_on_the_map() {
        let side = 12;
        let near = find_feature_neighbours(&grid(side), 8, |_| true).expect("not stopped");
        let places = lay_out_map(&near, |_| true).expect("not stopped");
        let apart = |a: usize, b: usize| map_place_offset(places[a], places[b]).1.sqrt();
        let mut kept = 0;
        for (index, near) in near.iter().enumerate() {
            let mut others: Vec<usize> = (0..places.len()).filter(|&it| it != index).collect();
            others.sort_by(|&a, &b| apart(index, a).total_cmp(&apart(index, b)));
            let nearest = &others[..10];
            kept += near.iter().filter(|(other, _)| nearest.contains(other)).count();
        }
        let share = kept as f32 / near.iter().map(Vec::len).sum::<usize>() as f32;
        assert!(share > 0.6, "{share} of the neighbours are still near");
        assert!(places.iter().flatten().all(|it| (0.0..=1.0).contains(it)));
    }

    #[test]
    fn equal_input_gives_an_equal_map_and_equal_items_lie_together() {
        let mut things = grid(6);
        things.push(things[0].clone());
        let near = find_feature_neighbours(&things, 8, |_| true).expect("not stopped");
        assert_eq!(near[0][0].0, 36);
        assert!(near[0][0].1 > 0.9999);
        let map = || lay_out_map(&near, |_| true).expect("not stopped");
        let places = map();
        assert_eq!(places, map());
        assert!(map_place_offset(places[0], places[36]).1.sqrt() < 0.2, "{places:?}");
    }

    #[test]
    fn items_without_features_and_no_items_at_all_have_a_map() {
        assert_eq!(lay_out_map(&[], |_| true), Some(vec![]));
        let near = find_feature_neighbours(&[vec![], vec![(3, 1.0)], vec![]], 4, |_| true).expect("not stopped");
        assert!(near.iter().all(Vec::is_empty));
        let places = lay_out_map(&near, |_| true).expect("not stopped");
        assert!(places.iter().flatten().all(|it| it.is_finite()));
    }

    #[test]
    fn neighbours_and_layout_stop_on_request() {
        assert_eq!(find_feature_neighbours(&grid(3), 4, |_| false), None);
        let near = find_feature_neighbours(&grid(3), 4, |_| true).expect("not stopped");
        assert_eq!(lay_out_map(&near, |_| false), None);
    }

    #[test]
    fn groups_without_common_neighbours_use_the_whole_map_and_stay_groups() {
        // Three grids whose features have nothing in common, two large and one small.
        let mut things: Vec<WeightedFeatures> = Vec::new();
        for (group, side) in [8, 8, 3].into_iter().enumerate() {
            let own = grid(side).into_iter().map(|thing| {
                thing
                    .into_iter()
                    .map(|(feature, weight)| (feature + 1000 * group as u32, weight))
                    .collect()
            });
            things.extend(own);
        }
        let group = |index: usize| [64, 128].iter().filter(|it| **it <= index).count();
        let near = find_feature_neighbours(&things, 8, |_| true).expect("not stopped");
        let places = lay_out_map(&near, |_| true).expect("not stopped");
        let squares: std::collections::BTreeSet<(i32, i32)> = places
            .iter()
            .map(|[x, y]| ((x * 8.0) as i32, (y * 8.0) as i32))
            .collect();
        assert!(squares.len() >= 35, "{} of 64 squares are used", squares.len());
        let alone = (0..places.len()).filter(|&index| {
            let others = (0..places.len()).filter(|&other| other != index);
            let apart = |other: usize| map_place_offset(places[index], places[other]).1;
            let nearest = others.min_by(|&a, &b| apart(a).total_cmp(&apart(b)));
            nearest.is_some_and(|other| group(other) != group(index))
        });
        assert!(alone.count() <= 5, "nearly all lie next to one of their own group");
        assert!(places.iter().flatten().all(|it| (0.0..=1.0).contains(it)));
    }

    #[test]
    fn positions_are_fitted_into_the_square_without_a_change_of_proportions() {
        for by in [[0.0, 0.0], [-3.0, 7.0]] {
            let places = [[2.0, 1.0], [6.0, 2.0], [4.0, 3.0]];
            let moved = places.map(|[x, y]: [f32; 2]| [x + by[0], y + by[1]]);
            let found = fit_unit_square(moved.to_vec());
            for (is, want) in found.iter().zip([[0.0, 0.25], [1.0, 0.5], [0.5, 0.75]]) {
                assert!(map_place_offset(*is, want).1 < 1e-9, "{found:?}");
            }
        }
        assert_eq!(fit_unit_square(vec![[5.0, 5.0]]), [[0.5, 0.5]]);
    }

    #[test]
    fn edges_combine_both_directions_like_independent_chances() {
        let near: Vec<SimilarNeighbours> = vec![
            vec![(1, 0.8), (2, 0.4)],
            vec![(0, 0.8), (2, 0.6)],
            vec![(1, 0.6)],
            vec![],
        ];
        let found: Vec<(usize, usize, f32)> = edges(&near).iter().map(|edge| (edge.a, edge.b, edge.weight)).collect();
        let (half, three_quarters) = (0.5_f32.powi(4), 0.75_f32.powi(4));
        for (is, want) in found.iter().zip([(0, 1, 1.0), (0, 2, half), (1, 2, 1.0)]) {
            assert_eq!((is.0, is.1), (want.0, want.1));
            assert!((is.2 - want.2).abs() < 1e-6, "{found:?}");
        }
        // The chance that neither direction connects is the product of the two.
        let near = vec![vec![(1, 1.0), (2, 0.75)], vec![], vec![(1, 1.0), (0, 0.5)]];
        let combined = 1.0 - (1.0 - half) * (1.0 - three_quarters);
        let found = edges(&near);
        let both = found.iter().find(|edge| (edge.a, edge.b) == (0, 2));
        assert!((both.expect("an edge").weight - combined).abs() < 1e-6);
    }

    #[test]
    fn steps_follow_the_gradient_of_the_curve_of_closeness() {
        // The closeness 1 / (1 + a d^2b): neighbours climb its logarithm, others descend that of its complement.
        let closeness =
            |d: f64| 1.0 / (1.0 + f64::from(CLOSENESS_CURVE.0) * d.powf(2.0 * f64::from(CLOSENESS_CURVE.1)));
        let slope = |f: &dyn Fn(f64) -> f64, d: f64| (f(d + 1e-5) - f(d - 1e-5)) / 2e-5;
        for d in [0.3_f32, 1.0, 2.5] {
            let rate = 0.1;
            let mut places = vec![[d * 0.6, d * 0.8], [0.0, 0.0]];
            attract(&mut places, 0, 1, rate);
            let pull = slope(&|d| closeness(d).ln(), f64::from(d));
            let step = f64::from(rate) * pull;
            let far = f64::from(map_place_offset(places[0], places[1]).1).sqrt();
            assert!(
                (far - f64::from(d) - 2.0 * step).abs() < 1e-3 * far,
                "{d}: {far} {step}"
            );
            let mut places = vec![[d * 0.6, d * 0.8], [0.0, 0.0]];
            repel(&mut places, 0, 1, rate);
            let push = slope(&|d| (1.0 - closeness(d)).ln(), f64::from(d));
            let far = f64::from(map_place_offset(places[0], [0.0, 0.0]).1).sqrt();
            let step = f64::from(rate) * push;
            assert!((far - f64::from(d) - step).abs() < 0.01 * far, "{d}: {far} {step}");
            assert_eq!(places[1], [0.0, 0.0]);
        }
    }
}
