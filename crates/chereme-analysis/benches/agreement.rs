//! Agreement of two tiers of 5,000 units: `cargo bench -p chereme-analysis --bench agreement`.

use chereme_analysis::agreement::gamma::{Costs, Sampling, align, gamma};
use chereme_analysis::agreement::matching::{SHARE, Table, matched, rows};
use chereme_analysis::agreement::resample::bootstrap;
use chereme_analysis::agreement::unitizing::{alpha_u, frames, u_alpha};
use chereme_analysis::agreement::{Continuum, Undefined, Unit};
use chereme_analysis::random::Random;

const UNITS: usize = 5_000;
const VALUES: usize = 300;

fn main() {
    divan::main();
}

/// Returns two tiers of signs of half a second; one sign in ten has another value or lies apart.
fn tiers() -> Continuum {
    let mut random = Random::new(7);
    let (mut first, mut second, mut end) = (Vec::new(), Vec::new(), 0);
    for _ in 0..UNITS {
        let start = end + random.below(200) as i64;
        end = start + 250 + random.below(500) as i64;
        let value = random.below(VALUES);
        first.push(Unit::new(start, end, value));
        let other = match random.below(10) {
            0 => random.below(VALUES),
            _ => value,
        };
        let moved = random.below(80) as i64;
        second.push(Unit::new(start + moved, end, other));
    }
    Continuum::new((0, end), vec![first, second])
}

#[divan::bench]
fn modified_kappa_with_1000_draws(bencher: divan::Bencher<'_, '_>) {
    let all = tiers();
    bencher.bench(|| {
        let pairs = matched(&all.tiers()[0], &all.tiers()[1], SHARE);
        let rows = rows(&all.tiers()[0], &all.tiers()[1], &pairs);
        let mut sum = 0.0;
        bootstrap(rows.len(), 1000, 1, |places| {
            let table = Table::of(places.iter().map(|at| rows[*at]), VALUES);
            sum += table.kappa_ipf().unwrap_or(0.0);
        });
        sum
    });
}

#[divan::bench]
fn alpha_over_time(bencher: divan::Bencher<'_, '_>) {
    let all = tiers();
    bencher.bench(|| (alpha_u(&all), u_alpha(&all).all, frames(&all, 10).alpha));
}

#[divan::bench]
fn alignment(bencher: divan::Bencher<'_, '_>) {
    let all = tiers();
    bencher.bench(|| align(&all, &Costs::default()).map(|it| it.cost));
}

#[divan::bench(sample_count = 3)]
fn gamma_with_30_samples(bencher: divan::Bencher<'_, '_>) {
    let all = [tiers()];
    bencher.bench(|| {
        let go = |_| Ok::<(), Undefined>(());
        gamma(&all, &Costs::default(), &Sampling::default(), go).map(|it| it.samples)
    });
}
