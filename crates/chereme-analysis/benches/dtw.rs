//! Benchmark of dynamic time warping and other implementations: `cargo bench -p chereme-analysis --bench dtw`.
//!
//! Series are sums of sines from 0.2 to 3 Hz at 120 frames per second, similar to joint angles; every tenth candidate
//! is a warped, noisy copy of the first. All implementations use the squared local distance; `item/s` are cells inside
//! the window, or queries for nearest neighbours. The others do less (augurs has one channel only) or more (dtw_rs
//! stores the whole table).

use chereme_analysis::dtw::{
    AlignmentWindow, ChannelSeries, DtwOptions, LocalDistance, StepPattern, align_series, dtw_distance,
    find_nearest_candidates,
};
use divan::{Bencher, counter::ItemsCount};

fn main() {
    divan::main();
}

/// A small generator of numbers in 0..1 (splitmix64), which gives the same numbers in every run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Six sines for each channel, as amplitude, frequency and phase.
type Sines = Vec<[(f64, f64, f64); 6]>;

fn sines(channels: usize, numbers: &mut Numbers) -> Sines {
    let mut one = || {
        let frequency = 0.2 * 15f64.powf(numbers.next());
        (
            (numbers.next() - 0.5) / frequency,
            frequency,
            numbers.next() * std::f64::consts::TAU,
        )
    };
    (0..channels).map(|_| std::array::from_fn(|_| one())).collect()
}

fn played(sines: &Sines, frames: usize, time: impl Fn(f64) -> f64) -> Vec<Vec<f64>> {
    let value = |channel: &[(f64, f64, f64); 6], frame: usize| {
        let t = time(frame as f64 / 120.0);
        channel
            .iter()
            .map(|(a, f, p)| a * (std::f64::consts::TAU * f * t + p).sin())
            .sum()
    };
    sines
        .iter()
        .map(|c| (0..frames).map(|frame| value(c, frame)).collect())
        .collect()
}

fn movement(frames: usize, channels: usize, seed: u64) -> Vec<Vec<f64>> {
    played(&sines(channels, &mut Numbers(seed)), frames, |t| t)
}

fn rows(columns: &[Vec<f64>]) -> Vec<Vec<f64>> {
    (0..columns[0].len())
        .map(|i| columns.iter().map(|c| c[i]).collect())
        .collect()
}

fn series(columns: &[Vec<f64>]) -> ChannelSeries {
    ChannelSeries::from_columns(columns).expect("finite columns of one length")
}

const SQUARED: DtwOptions = DtwOptions {
    pattern: StepPattern::Symmetric1,
    window: AlignmentWindow::None,
    local: LocalDistance::SquaredEuclidean,
    open_begin: false,
    open_end: false,
    policy: chereme_analysis::dtw::DtwPathPolicy::Refuse,
    limits: chereme_analysis::dtw::DtwLimits {
        kept: 1 << 28,
        cells: 1 << 36,
    },
};

const PAIRS: &[(usize, usize)] = &[
    (1, 1000),
    (8, 200),
    (8, 1000),
    (8, 5000),
    (30, 200),
    (30, 1000),
    (30, 5000),
];

mod pair {
    use super::*;

    fn run(bencher: Bencher<'_, '_>, (channels, frames): (usize, usize), options: DtwOptions) {
        let (a, b) = (movement(frames, channels, 1), movement(frames, channels, 2));
        let (a, b) = (series(&a), series(&b));
        let cells = match options.window {
            AlignmentWindow::SakoeChiba(w) => frames * (2 * w + 1) - w * (w + 1),
            _ => frames * frames,
        };
        bencher
            .counter(ItemsCount::new(cells))
            .bench(|| dtw_distance(&a, &b, &options));
    }

    #[divan::bench(args = PAIRS)]
    fn ours(bencher: Bencher<'_, '_>, size: &(usize, usize)) {
        run(bencher, *size, SQUARED);
    }

    #[divan::bench(args = [(8, 1000), (30, 1000)])]
    fn ours_window_of_100(bencher: Bencher<'_, '_>, size: (usize, usize)) {
        run(
            bencher,
            size,
            DtwOptions {
                window: AlignmentWindow::SakoeChiba(100),
                ..SQUARED
            },
        );
    }

    #[divan::bench(args = [(8, 1000), (30, 1000)])]
    fn ours_symmetric2_euclidean(bencher: Bencher<'_, '_>, size: (usize, usize)) {
        run(bencher, size, DtwOptions::default());
    }

    #[divan::bench(args = [(8, 1000), (30, 1000)])]
    fn ours_asymmetric(bencher: Bencher<'_, '_>, size: (usize, usize)) {
        run(
            bencher,
            size,
            DtwOptions {
                pattern: StepPattern::Asymmetric,
                ..SQUARED
            },
        );
    }

    #[divan::bench(args = [1000])]
    fn augurs_1_channel(bencher: Bencher<'_, '_>, frames: usize) {
        let (a, b) = (movement(frames, 1, 1), movement(frames, 1, 2));
        let dtw = augurs_dtw::Dtw::euclidean();
        bencher
            .counter(ItemsCount::new(frames * frames))
            .bench(|| dtw.distance(&a[0], &b[0]));
    }
}

mod path {
    use super::*;
    use dtw_rs::Solution;

    const SIZES: &[(usize, usize)] = &[(8, 200), (8, 1000), (30, 1000)];

    #[divan::bench(args = SIZES)]
    fn ours(bencher: Bencher<'_, '_>, (channels, frames): &(usize, usize)) {
        let (a, b) = (movement(*frames, *channels, 1), movement(*frames, *channels, 2));
        let (a, b) = (series(&a), series(&b));
        bencher
            .counter(ItemsCount::new(frames * frames))
            .bench(|| align_series(&a, &b, &SQUARED));
    }

    #[divan::bench(args = SIZES)]
    fn dtw_rs(bencher: Bencher<'_, '_>, (channels, frames): &(usize, usize)) {
        let (a, b) = (movement(*frames, *channels, 1), movement(*frames, *channels, 2));
        let (a, b) = (rows(&a), rows(&b));
        let squared = |a: &Vec<f64>, b: &Vec<f64>| -> f64 { a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum() };
        bencher.counter(ItemsCount::new(frames * frames)).bench(|| {
            let found = dtw_rs::dtw_with_distance(&a, &b, squared);
            (found.distance(), found.path().len())
        });
    }
}

mod nearest_of_10000 {
    use super::*;

    const FRAMES: usize = 200;
    const WINDOW: usize = 20;

    /// Returns a query and candidates; with `copies`, some candidates are near copies of the query.
    fn corpus(channels: usize, copies: bool) -> (Vec<Vec<f64>>, Vec<Vec<Vec<f64>>>) {
        let base = sines(channels, &mut Numbers(1));
        let mut numbers = Numbers(7);
        let candidate = |i: usize| {
            if !i.is_multiple_of(10) || !copies {
                return played(&sines(channels, &mut numbers), FRAMES, |t| t);
            }
            let bend = (numbers.next() - 0.5) * 0.2;
            let end = FRAMES as f64 / 120.0;
            let mut warped = played(&base, FRAMES, |t| t + bend * (t / end) * (end - t));
            let noise = 0.05 * (1.0 + i as f64 / 2500.0);
            warped
                .iter_mut()
                .flatten()
                .for_each(|v| *v += (numbers.next() - 0.5) * noise);
            warped
        };
        (played(&base, FRAMES, |t| t), (0..10_000).map(candidate).collect())
    }

    #[divan::bench(args = [(1, true), (1, false), (8, true), (8, false)], sample_count = 20, sample_size = 1)]
    fn ours(bencher: Bencher<'_, '_>, (channels, copies): (usize, bool)) {
        let (query, candidates) = corpus(channels, copies);
        let query = series(&query);
        let candidates: Vec<ChannelSeries> = candidates.iter().map(|c| series(c)).collect();
        let options = DtwOptions {
            window: AlignmentWindow::SakoeChiba(WINDOW),
            ..SQUARED
        };
        bencher
            .counter(ItemsCount::new(1usize))
            .bench(|| find_nearest_candidates(&query, &candidates, 1, &options));
    }

    #[divan::bench(args = [true, false], sample_count = 20, sample_size = 1)]
    fn augurs_1_channel(bencher: Bencher<'_, '_>, copies: bool) {
        let (query, candidates) = corpus(1, copies);
        bencher.counter(ItemsCount::new(1usize)).bench(|| {
            let mut best = (f64::INFINITY, 0);
            for (index, candidate) in candidates.iter().enumerate() {
                let dtw = augurs_dtw::Dtw::euclidean()
                    .with_window(WINDOW)
                    .with_max_distance(best.0);
                let found = dtw.distance(&query[0], &candidate[0]);
                if found < best.0 {
                    best = (found, index);
                }
            }
            best
        });
    }
}
