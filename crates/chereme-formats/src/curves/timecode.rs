//! Timecodes such as `12:34:56:07.250`: hours, minutes, seconds, frames and a fraction of a frame.

/// A timecode as its parts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Timecode {
    seconds: f64,
    frames: f64,
}

/// A day in seconds.
const DAY: f64 = 86_400.0;

/// Reads a timecode; a semicolon or a point may stand before the frames.
pub(super) fn parse(text: &str) -> Option<Timecode> {
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
pub(super) fn seconds(codes: &[Timecode]) -> (Vec<f64>, f64) {
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
