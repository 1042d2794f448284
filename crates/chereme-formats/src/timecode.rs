//! Timecodes such as `12:34:56:07.250`: hours, minutes, seconds, frames and a fraction of a frame.

use chereme_motion::Instant;

/// A timecode as its parts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Timecode {
    seconds: f64,
    frames: f64,
}

/// A day in seconds.
pub(crate) const DAY: f64 = 86_400.0;

/// Reads a timecode; a semicolon or a point may stand before the frames.
pub(crate) fn parse(text: &str) -> Option<Timecode> {
    let mut parts = text.trim().splitn(4, [':', ';']);
    let mut whole = |most: u32| {
        let number: u32 = parts.next()?.trim().parse().ok()?;
        (number <= most).then_some(f64::from(number))
    };
    let seconds = whole(23)? * 3600.0 + whole(59)? * 60.0 + whole(59)?;
    let frames: f64 = parts.next()?.trim().parse().ok()?;
    (0.0..1000.0)
        .contains(&frames)
        .then_some(Timecode { seconds, frames })
}

/// Returns the seconds of the day for each timecode; after midnight they go on beyond 24 hours.
///
/// The number of frames in a second is the smallest usual one above every frame that occurs.
pub(crate) fn seconds(codes: &[Timecode]) -> (Vec<f64>, f64) {
    let largest = codes
        .iter()
        .map(|code| code.frames.floor())
        .fold(0.0, f64::max);
    let usual = [24.0, 25.0, 30.0, 48.0, 50.0, 60.0, 100.0, 120.0];
    let base = usual
        .into_iter()
        .find(|base| largest < *base)
        .unwrap_or(1000.0);
    let mut days = 0.0;
    let mut before = f64::NEG_INFINITY;
    let times = codes.iter().map(|code| {
        let mut at = code.seconds + code.frames / base + days;
        if at < before - DAY / 2.0 {
            days += DAY;
            at += DAY;
        }
        before = at;
        at
    });
    (times.collect(), base)
}

/// Returns the time of day of one timecode, such as `12:34:56:07@25`: the number after the `@` is the number of frames
/// in a second; without it, it follows from the capture's `rate`.
///
/// ```
/// use chereme_formats::timecode::time_of_day;
///
/// let at = time_of_day("01:00:02:05@25", 100.0).map(|at| at.micros());
/// assert_eq!(at, Some(3_602_200_000));
/// assert_eq!(time_of_day("01:00:02:05", 100.0).map(|at| at.micros()), at);
/// assert_eq!(time_of_day("25:00:00:00", 30.0), None);
/// ```
#[must_use]
pub fn time_of_day(text: &str, rate: f64) -> Option<Instant> {
    let (code, base) = match text.trim().split_once('@') {
        Some((code, base)) => (code, base.trim().parse().ok()?),
        None => (text, base_of(rate)),
    };
    let code = match code.trim().matches([':', ';']).count() {
        2 => parse(&format!("{}:00", code.trim()))?,
        _ => parse(code)?,
    };
    let sound = (1.0..=1000.0).contains(&base) && code.frames < base;
    sound.then(|| Instant::from_seconds(code.seconds + code.frames / base))
}

/// Returns the number of frames in a second that the timecodes of a capture of this rate use.
fn base_of(rate: f64) -> f64 {
    let whole = |base: &f64| {
        let times = rate / base;
        times >= 0.99 && (times - times.round()).abs() < 0.002 * times
    };
    let usual = [30.0, 25.0, 24.0];
    usual.into_iter().find(whole).unwrap_or(30.0)
}
