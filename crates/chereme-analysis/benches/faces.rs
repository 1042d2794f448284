//! Benchmark of scores for expressions of the face: one sentence against 10,000 performances of 200 frames, in four
//! phases.
//!
//! Run with `cargo bench -p chereme-analysis --bench faces`; the target is less than a second for a choice among them.

use chereme_analysis::phases::{PhasedPerformance, PhasedScoreOptions, score_phased_candidate};
use divan::Bencher;

fn main() {
    divan::main();
}

/// Returns a performance of about 200 frames with six channels, which depends on the seed.
fn performance(seed: u64) -> PhasedPerformance {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let lengths: [usize; 4] = std::array::from_fn(|n| [15, 90, 70, 15][n] + (next() * 10.0) as usize);
    let mut marks = [0; 5];
    for n in 0..4 {
        marks[n + 1] = marks[n] + lengths[n];
    }
    let column = |(shift, tempo): (f64, f64)| {
        let value = |frame: usize| (frame as f64 * tempo + shift).sin();
        (0..marks[4]).map(value).collect()
    };
    let columns: Vec<Vec<f64>> = (0..6).map(|_| column((next() * 6.0, 0.02 + 0.05 * next()))).collect();
    PhasedPerformance::new(&columns, marks, marks[4] as f64 / 30.0).expect("phases")
}

#[divan::bench(sample_count = 5)]
fn ten_thousand_performances_are_scored(bencher: Bencher<'_, '_>) {
    let gold = performance(1);
    let all: Vec<PhasedPerformance> = (2..10_002).map(performance).collect();
    bencher.bench_local(|| {
        let best = all.iter().enumerate().map(|(at, it)| {
            let found = score_phased_candidate(&gold, it, gold.phased_seconds(), &PhasedScoreOptions::default());
            (found.map_or(f64::INFINITY, |found| found.score), at)
        });
        best.min_by(|a, b| a.0.total_cmp(&b.0))
    });
}
