//! Agreement of two tiers of 5,000 units: `cargo bench -p chereme-analysis --bench agreement`.

use chereme_analysis::agreement::agreement_resample::draw_bootstrap_samples;
use chereme_analysis::agreement::gamma::{AlignmentCosts, GammaSampling, align_continuum, measure_gamma_agreement};
use chereme_analysis::agreement::matching::{
    DEFAULT_OVERLAP_SHARE, HolleReinTable, build_matching_rows, match_overlapping_units,
};
use chereme_analysis::agreement::unitizing::{alpha_u, measure_frame_agreement, u_alpha};
use chereme_analysis::agreement::{AnnotatedUnit, AnnotationContinuum, UndefinedAgreement};
use chereme_analysis::random::RandomNumbers;

const UNITS: usize = 5_000;
const VALUES: usize = 300;

fn main() {
    divan::main();
}

/// Returns two tiers of signs of half a second; one sign in ten has another value or lies apart.
fn tiers() -> AnnotationContinuum {
    let mut random = RandomNumbers::new(7);
    let (mut first, mut second, mut end) = (Vec::new(), Vec::new(), 0);
    for _ in 0..UNITS {
        let start = end + random.random_below(200) as i64;
        end = start + 250 + random.random_below(500) as i64;
        let value = random.random_below(VALUES);
        first.push(AnnotatedUnit::new(start, end, value));
        let other = match random.random_below(10) {
            0 => random.random_below(VALUES),
            _ => value,
        };
        let moved = random.random_below(80) as i64;
        second.push(AnnotatedUnit::new(start + moved, end, other));
    }
    AnnotationContinuum::new(0..end, vec![first, second])
}

#[divan::bench]
fn modified_kappa_with_1000_draws(bencher: divan::Bencher<'_, '_>) {
    let all = tiers();
    bencher.bench(|| {
        let pairs = match_overlapping_units(
            &all.annotator_tiers()[0],
            &all.annotator_tiers()[1],
            DEFAULT_OVERLAP_SHARE,
        );
        let rows = build_matching_rows(&all.annotator_tiers()[0], &all.annotator_tiers()[1], &pairs);
        let mut sum = 0.0;
        draw_bootstrap_samples(rows.len(), 1000, 1, |places| {
            let table = HolleReinTable::from_matching_rows(places.iter().map(|at| rows[*at]), VALUES);
            sum += table.kappa_ipf().unwrap_or(0.0);
        });
        sum
    });
}

#[divan::bench]
fn alpha_over_time(bencher: divan::Bencher<'_, '_>) {
    let all = tiers();
    bencher.bench(|| {
        (
            alpha_u(&all),
            u_alpha(&all).all,
            measure_frame_agreement(&all, 10).alpha,
        )
    });
}

#[divan::bench]
fn alignment(bencher: divan::Bencher<'_, '_>) {
    let all = tiers();
    bencher.bench(|| align_continuum(&all, &AlignmentCosts::default()).map(|it| it.cost));
}

#[divan::bench(sample_count = 3)]
fn gamma_with_30_samples(bencher: divan::Bencher<'_, '_>) {
    let all = [tiers()];
    bencher.bench(|| {
        let go = |_| Ok::<(), UndefinedAgreement>(());
        measure_gamma_agreement(&all, &AlignmentCosts::default(), &GammaSampling::default(), go).map(|it| it.samples)
    });
}
