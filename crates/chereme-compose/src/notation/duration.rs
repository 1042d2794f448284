//! Signs whose notation states how fast they are or how long they last.

use chereme_sign::hamnosys::NotatedSign;

use super::notation_plan::{SignPlan, SignSpan};

/// The range of the factor on the speed of a sign.
const SIGN_SPEED_RANGE: (f64, f64) = (0.1, 10.0);
/// The number of times that the speeds of signs are adapted to the written durations.
const DURATION_ROUNDS: usize = 5;
/// The difference between a sign's duration and the written one that is reported, as a share.
const REPORTED_DURATION_SHARE: f64 = 0.1;

/// Plans signs so that each lasts as long as its notation asks for; `plan` plans them at their speeds. Returns the plan, and
/// the duration (s) that each sign should have if its notation states one.
///
/// A duration is that of the sign from its first posture to its end; a speed, or the inverse of a scale of time, is a factor
/// on all of it.
pub(crate) fn plan_timed(
    signs: &[&NotatedSign],
    plan: impl Fn(&[&NotatedSign]) -> SignPlan,
) -> (SignPlan, Vec<Option<f64>>) {
    let legal = |factor: Option<f64>| factor.filter(|factor| factor.is_finite() && *factor > 0.0);
    let factor = |sign: &NotatedSign| {
        let factors = (legal(sign.speed), legal(sign.timescale));
        (factors != (None, None)).then(|| factors.0.unwrap_or(1.0) / factors.1.unwrap_or(1.0))
    };
    let mut plain_signs: Vec<NotatedSign> = signs.iter().map(|sign| (*sign).clone()).collect();
    plain_signs.iter_mut().for_each(|sign| sign.speed = None);
    let new_plan = |own: &[NotatedSign]| plan(&own.iter().collect::<Vec<_>>());
    let mut timed_plan = new_plan(&plain_signs);
    let length = |span: &SignSpan| span.to - span.from;
    let usual: Vec<f64> = timed_plan.signs.iter().map(length).collect();
    let asked = signs.iter().zip(&usual).map(|(sign, usual)| {
        let by_factor = factor(sign).map(|factor| usual / factor.clamp(SIGN_SPEED_RANGE.0, SIGN_SPEED_RANGE.1));
        legal(sign.duration).or(by_factor)
    });
    let asked: Vec<Option<f64>> = asked.collect();
    if asked.iter().any(Option::is_some) {
        for _ in 0..DURATION_ROUNDS {
            let lengths = timed_plan.signs.iter().map(length).zip(&asked);
            for (sign, (length, asked)) in plain_signs.iter_mut().zip(lengths) {
                let Some(asked) = asked else { continue };
                let speed = sign.speed.unwrap_or(1.0) * length / asked;
                sign.speed = legal(Some(speed.clamp(SIGN_SPEED_RANGE.0, SIGN_SPEED_RANGE.1)));
            }
            timed_plan = new_plan(&plain_signs);
        }
    }
    for factor in signs.iter().filter_map(|sign| factor(sign)) {
        let used = factor.clamp(SIGN_SPEED_RANGE.0, SIGN_SPEED_RANGE.1);
        let remark =
            format!("the notation asks for another speed than can be performed: {used} times the usual one is used");
        if used != factor && !timed_plan.remarks.contains(&remark) {
            timed_plan.remarks.push(remark);
        }
    }
    (timed_plan, asked)
}

/// Returns a remark about each sign that does not last as long as it should.
pub(crate) fn missed_durations(signs: &[SignSpan], asked: &[Option<f64>]) -> Vec<String> {
    let both = signs.iter().zip(asked);
    let missed = both.filter_map(|(sign, asked)| {
        let (lasts, asked) = (sign.to - sign.from, (*asked)?);
        ((lasts / asked - 1.0).abs() > REPORTED_DURATION_SHARE).then(|| {
            format!(
                "{:?} lasts {lasts:.2} s, and its notation asks for {asked:.2} s",
                sign.gloss
            )
        })
    });
    missed.collect()
}
