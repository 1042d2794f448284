//! Signs whose notation states how fast they are or how long they last.

use chereme_sign::hamnosys::Notated;

use super::plan::{SignPlan, SignSpan};

/// The range of the factor on the speed of a sign.
const SPEEDS: (f64, f64) = (0.1, 10.0);
/// The number of times that the speeds of signs are adapted to the written durations.
const ROUNDS: usize = 5;
/// The difference between a sign's duration and the written one that is reported, as a share.
const REPORTED: f64 = 0.1;

/// Plans signs so that each lasts as long as its notation asks for; `plan` plans them at their speeds. Returns the plan, and
/// the duration (s) that each sign should have if its notation states one.
///
/// A duration is that of the sign from its first posture to its end; a speed, or the inverse of a scale of time, is a factor
/// on all of it.
pub(crate) fn plan_timed(
    signs: &[&Notated],
    plan: impl Fn(&[&Notated]) -> SignPlan,
) -> (SignPlan, Vec<Option<f64>>) {
    let legal = |factor: Option<f64>| factor.filter(|factor| factor.is_finite() && *factor > 0.0);
    let factor = |sign: &Notated| {
        let factors = (legal(sign.speed), legal(sign.timescale));
        (factors != (None, None)).then(|| factors.0.unwrap_or(1.0) / factors.1.unwrap_or(1.0))
    };
    let mut own: Vec<Notated> = signs.iter().map(|sign| (*sign).clone()).collect();
    own.iter_mut().for_each(|sign| sign.speed = None);
    let again = |own: &[Notated]| plan(&own.iter().collect::<Vec<_>>());
    let mut found = again(&own);
    let length = |span: &SignSpan| span.to - span.from;
    let usual: Vec<f64> = found.signs.iter().map(length).collect();
    let asked = signs.iter().zip(&usual).map(|(sign, usual)| {
        let by_factor = factor(sign).map(|factor| usual / factor.clamp(SPEEDS.0, SPEEDS.1));
        legal(sign.duration).or(by_factor)
    });
    let asked: Vec<Option<f64>> = asked.collect();
    if asked.iter().any(Option::is_some) {
        for _ in 0..ROUNDS {
            let lengths = found.signs.iter().map(length).zip(&asked);
            for (sign, (length, asked)) in own.iter_mut().zip(lengths) {
                let Some(asked) = asked else { continue };
                let speed = sign.speed.unwrap_or(1.0) * length / asked;
                sign.speed = legal(Some(speed.clamp(SPEEDS.0, SPEEDS.1)));
            }
            found = again(&own);
        }
    }
    for factor in signs.iter().filter_map(|sign| factor(sign)) {
        let used = factor.clamp(SPEEDS.0, SPEEDS.1);
        let remark = format!(
            "the notation asks for another speed than can be performed: {used} times the usual one is used"
        );
        if used != factor && !found.remarks.contains(&remark) {
            found.remarks.push(remark);
        }
    }
    (found, asked)
}

/// Returns a remark about each sign that does not last as long as it should.
pub(crate) fn missed_durations(signs: &[SignSpan], asked: &[Option<f64>]) -> Vec<String> {
    let both = signs.iter().zip(asked);
    let missed = both.filter_map(|(sign, asked)| {
        let (lasts, asked) = (sign.to - sign.from, (*asked)?);
        ((lasts / asked - 1.0).abs() > REPORTED).then(|| {
            format!(
                "{:?} lasts {lasts:.2} s, and its notation asks for {asked:.2} s",
                sign.gloss
            )
        })
    });
    missed.collect()
}
