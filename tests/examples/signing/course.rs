//! Measures the distance of the courses of formulas from strokes of real signing.

use chereme_motion::InterpolationKind;
use chereme_motion::glam::DVec3;

use crate::phases::phases;
use crate::take::{RATE, Take};

/// Least distance (m) from the start to the end of a stroke.
const LEAST: f64 = 0.05;
/// The number of steps of a learned course.
const STEPS: usize = 50;

struct Stroke<'t> {
    file: &'t str,
    path: &'t [DVec3],
}

impl Stroke<'_> {
    /// Returns the covered share of the path at equal steps of time.
    fn course(&self) -> Vec<f64> {
        let (first, last) = (self.path[0], self.path[self.path.len() - 1]);
        let chord = last - first;
        let share = |n: usize| {
            let at = n as f64 / STEPS as f64 * (self.path.len() - 1) as f64;
            let from = at as usize;
            let to = (from + 1).min(self.path.len() - 1);
            let point = self.path[from].lerp(self.path[to], at - from as f64);
            (point - first).dot(chord) / chord.length_squared()
        };
        (0..=STEPS).map(share).collect()
    }

    /// Returns the mean squares of the distances to a straight path with this course: in metres, and in
    /// metres per second.
    fn off(&self, course: &dyn Fn(f64) -> f64) -> [f64; 2] {
        let last = self.path.len() - 1;
        let (from, to) = (self.path[0], self.path[last]);
        let made: Vec<DVec3> = (0..=last)
            .map(|n| from.lerp(to, course(n as f64 / last as f64)))
            .collect();
        let speed = |path: &[DVec3], n: usize| path[n].distance(path[n + 1]) * RATE;
        let places = (0..=last).map(|n| made[n].distance_squared(self.path[n]));
        let speeds = (0..last).map(|n| (speed(&made, n) - speed(self.path, n)).powi(2));
        [
            places.sum::<f64>() / (last + 1) as f64,
            speeds.sum::<f64>() / last.max(1) as f64,
        ]
    }
}

/// Returns the table of courses.
pub(crate) fn table(takes: &[Take]) -> String {
    let strokes: Vec<Stroke<'_>> = takes
        .iter()
        .flat_map(|take| {
            let own = phases(take).strokes.into_iter();
            own.map(|it| Stroke {
                file: &take.file,
                path: &take.path[it.whole.start..=it.whole.end],
            })
        })
        .filter(|it| it.path[0].distance(it.path[it.path.len() - 1]) > LEAST)
        .collect();
    let formulas = [
        ("slerp", InterpolationKind::Slerp),
        ("cosine", InterpolationKind::Cosine),
        ("sigmoid", InterpolationKind::Sigmoid),
        ("minimum jerk", InterpolationKind::MinimumJerk),
    ];
    let mut rows: Vec<(String, [f64; 2])> = formulas
        .into_iter()
        .map(|(name, formula)| {
            let off = strokes.iter().map(|it| it.off(&|w| formula.interpolation_share(w)));
            (name.to_owned(), mean(off))
        })
        .collect();
    let learned = strokes.iter().map(|it| {
        let others = strokes.iter().filter(|other| other.file != it.file);
        let others: Vec<Vec<f64>> = others.map(Stroke::course).collect();
        let table: Vec<f64> = (0..=STEPS)
            .map(|n| {
                let sum: f64 = others.iter().map(|course| course[n]).sum();
                sum / others.len().max(1) as f64
            })
            .collect();
        it.off(&|w| {
            let at = w.clamp(0.0, 1.0) * STEPS as f64;
            let first = (at as usize).min(STEPS - 1);
            table[first] + (table[first + 1] - table[first]) * (at - first as f64)
        })
    });
    rows.push(("learned from the other files".to_owned(), mean(learned)));
    rows.sort_by(|a, b| a.1[0].total_cmp(&b.1[0]));
    let mut text = format!(
        "{} strokes of 5 cm and more; root of the mean square, the nearest course first.\n\n\
         | course | position, mm | speed, mm/s |\n|---|--:|--:|\n",
        strokes.len()
    );
    for (name, [place, speed]) in rows {
        text.push_str(&format!("| {name} | {place:.1} | {speed:.0} |\n"));
    }
    text
}

/// Returns the roots of the means in millimetres and millimetres per second.
fn mean(all: impl Iterator<Item = [f64; 2]>) -> [f64; 2] {
    let (mut sums, mut count) = ([0.0; 2], 0.0);
    for off in all {
        sums = [sums[0] + off[0], sums[1] + off[1]];
        count += 1.0;
    }
    sums.map(|sum| (sum / f64::max(count, 1.0)).sqrt() * 1000.0)
}
