//! Learns the weights of the linear heads from generated takes of the tuning half, by logistic regression.

use std::path::Path;

use chereme_analysis::cut::measure_frame_numbers;

use crate::{Result, TrueTake, strings};

/// The time around a boundary that counts as it, in seconds.
const BOUNDARY_SECONDS: f64 = 0.045;
/// The penalty on the square of each weight of standardised numbers, for each frame.
const RIDGE_WEIGHT: f64 = 1e-3;
/// Steps of Newton's method; it needs fewer.
const FITTING_STEPS: usize = 12;

/// Learns from strings and signs alone on several bodies, and prints the weights as JSON.
pub(crate) fn print_weights(folder: &Path, bodies: &[&str], count: usize) -> Result<()> {
    let mut takes = Vec::new();
    for body in bodies {
        takes.extend(strings::generate_strings(folder, Path::new(body), count, true)?);
        takes.extend(strings::generate_isolated(folder, Path::new(body), 2 * count, true)?);
    }
    let mut table = FrameTable::default();
    for take in &takes {
        table.add_take(take);
    }
    println!("{{");
    println!("  \"frames\": {},", table.rows.len());
    for (place, head) in ["sign", "begin", "end"].into_iter().enumerate() {
        let share = table.labels.iter().filter(|labels| labels[place]).count() as f64 / table.rows.len() as f64;
        let weights = table.learn_head(place);
        let named = table.names.iter().zip(&weights[1..]);
        let listed: Vec<String> = named.map(|(name, weight)| format!("\"{name}\": {weight:.4}")).collect();
        println!("  \"{head}_share\": {share:.4},");
        let comma = if place < 2 { "," } else { "" };
        println!(
            "  \"{head}\": {{\"bias\": {:.4}, {}}}{comma}",
            weights[0],
            listed.join(", ")
        );
    }
    println!("}}");
    Ok(())
}

/// The numbers of frames, and whether each lies in a sign, at its begin, or at its end.
#[derive(Default)]
struct FrameTable {
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
    labels: Vec<[bool; 3]>,
}

impl FrameTable {
    fn add_take(&mut self, take: &TrueTake) {
        let Some(numbers) = measure_frame_numbers(&take.clip, &take.anatomy) else {
            return;
        };
        self.names = numbers.names;
        let times: Vec<[f64; 2]> = take
            .signs
            .iter()
            .map(|span| [span.span_start_instant(), span.span_end_instant()].map(|instant| instant.instant_seconds()))
            .collect();
        for (frame, row) in numbers.rows.into_iter().enumerate() {
            let time = frame as f64 * 0.04;
            let near = |place: usize| times.iter().any(|ends| (ends[place] - time).abs() < BOUNDARY_SECONDS);
            let within = times.iter().any(|[start, end]| (*start..*end).contains(&time));
            self.rows.push(row);
            self.labels.push([within, near(0), near(1)]);
        }
    }

    /// Returns the bias and the weight of each number, by Newton's method on standardised numbers.
    fn learn_head(&self, place: usize) -> Vec<f64> {
        let (count, width) = (self.rows.len() as f64, self.names.len());
        let mean: Vec<f64> = (0..width)
            .map(|n| self.rows.iter().map(|row| row[n]).sum::<f64>() / count)
            .collect();
        let deviation: Vec<f64> = (0..width)
            .map(|n| {
                let squares = self.rows.iter().map(|row| (row[n] - mean[n]).powi(2));
                (squares.sum::<f64>() / count).sqrt().max(1e-6)
            })
            .collect();
        let standard: Vec<Vec<f64>> = self
            .rows
            .iter()
            .map(|row| {
                let numbers = row
                    .iter()
                    .enumerate()
                    .map(|(n, number)| (number - mean[n]) / deviation[n]);
                [1.0].into_iter().chain(numbers).collect()
            })
            .collect();
        let mut weights = vec![0.0; width + 1];
        for _ in 0..FITTING_STEPS {
            let mut gradient = vec![0.0; width + 1];
            let mut curvature = vec![vec![0.0; width + 1]; width + 1];
            for (row, labels) in standard.iter().zip(&self.labels) {
                let odds: f64 = row.iter().zip(&weights).map(|(number, weight)| number * weight).sum();
                let share = 1.0 / (1.0 + (-odds).exp());
                let (error, spread) = (f64::from(u8::from(labels[place])) - share, share * (1.0 - share));
                for (n, number) in row.iter().enumerate() {
                    gradient[n] += error * number;
                    for (entry, other) in curvature[n][..=n].iter_mut().zip(row) {
                        *entry += spread * number * other;
                    }
                }
            }
            for n in 0..=width {
                let ridge = if n == 0 { 1e-9 } else { RIDGE_WEIGHT } * count;
                gradient[n] -= ridge * weights[n];
                curvature[n][n] += ridge;
            }
            let step = solve_symmetric(&curvature, &gradient);
            for (weight, change) in weights.iter_mut().zip(step) {
                *weight += change;
            }
        }
        let plain: Vec<f64> = weights[1..]
            .iter()
            .zip(&deviation)
            .map(|(weight, deviation)| weight / deviation)
            .collect();
        let bias = weights[0] - plain.iter().zip(&mean).map(|(weight, mean)| weight * mean).sum::<f64>();
        [bias].into_iter().chain(plain).collect()
    }
}

/// Solves a symmetric positive system, given its lower half, by Cholesky's decomposition.
fn solve_symmetric(lower_half: &[Vec<f64>], right: &[f64]) -> Vec<f64> {
    let size = right.len();
    let mut root = vec![vec![0.0; size]; size];
    for row in 0..size {
        for column in 0..=row {
            let known: f64 = (0..column).map(|k| root[row][k] * root[column][k]).sum();
            let left = lower_half[row][column] - known;
            root[row][column] = match row == column {
                true => left.max(1e-12).sqrt(),
                false => left / root[column][column],
            };
        }
    }
    let mut solution = right.to_vec();
    for row in 0..size {
        let known: f64 = (0..row).map(|k| root[row][k] * solution[k]).sum();
        solution[row] = (solution[row] - known) / root[row][row];
    }
    for row in (0..size).rev() {
        let known: f64 = (row + 1..size).map(|k| root[k][row] * solution[k]).sum();
        solution[row] = (solution[row] - known) / root[row][row];
    }
    solution
}
