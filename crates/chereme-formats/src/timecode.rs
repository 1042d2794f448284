//! Timecodes such as `12:34:56:07.250`: hours, minutes, seconds, frames and a fraction of a frame.

use chereme_motion::RecordingInstant;

/// A timecode as its parts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct VideoTimecode {
    seconds: f64,
    frames: f64,
    /// Whether a semicolon says that its count drops frames.
    drops: bool,
}

/// A day in seconds.
pub(crate) const SECONDS_PER_DAY: f64 = 86_400.0;

/// Reads a timecode; a semicolon or a point may stand before the frames.
pub(crate) fn parse_timecode(text: &str) -> Option<VideoTimecode> {
    let drops = text.contains(';');
    let mut parts = text.trim().splitn(4, [':', ';']);
    let mut next_number = |most: u32| {
        let number: u32 = parts.next()?.trim().parse().ok()?;
        (number <= most).then_some(f64::from(number))
    };
    let seconds = next_number(23)? * 3600.0 + next_number(59)? * 60.0 + next_number(59)?;
    let frames: f64 = parts.next()?.trim().replacen(',', ".", 1).parse().ok()?;
    (0.0..1000.0)
        .contains(&frames)
        .then_some(VideoTimecode { seconds, frames, drops })
}

/// The rate and the times that the timecodes of a file show together.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TimecodeTimes {
    /// The seconds of the day; after midnight they go on beyond 24 hours.
    pub(crate) seconds: Vec<f64>,
    /// The frames that a second counts.
    pub(crate) base: f64,
    /// Whether no step into the next second shows the base.
    pub(crate) is_guessed: bool,
    /// Whether the first frames of most minutes are left out, so that a frame lasts 1001/1000 of its share of a second.
    pub(crate) drops: bool,
    /// Whether the decimals repeat the frame as a part of the second, and count for nothing.
    pub(crate) repeats: bool,
}

/// The frames in a second that timecodes count.
const TIMECODE_BASES_FPS: [f64; 8] = [24.0, 25.0, 30.0, 48.0, 50.0, 60.0, 100.0, 120.0];
/// The frames in a second that are taken if nothing shows them, as phones count them.
const USUAL_BASE: f64 = 60.0;
/// The error of a part of a second of three decimals.
const DECIMAL_SLACK: f64 = 0.0011;
/// The largest difference of a step across a second from the usual step, in frames.
const STEP_SLACK: f64 = 1.5;

/// Returns the times of timecodes in their order.
pub(crate) fn infer_timecode_times(codes: &[VideoTimecode]) -> TimecodeTimes {
    let (base, is_guessed) = infer_timecode_base(codes);
    let drops = codes.iter().any(|code| code.drops) || leaves_out(codes, base);
    let dropped = match base {
        30.0 if drops => 2.0,
        60.0 if drops => 4.0,
        _ => 0.0,
    };
    let drops = dropped > 0.0;
    // Decimals may be those of the second instead of the frame; then frames may occur twice.
    let share = |code: &VideoTimecode| (code.frames.floor() / base).fract();
    let later = codes.iter().filter(|code| code.frames >= 1.0).count() > 1;
    let exact = |code: &VideoTimecode| (code.frames.fract() - share(code)).abs() < DECIMAL_SLACK;
    let within = |code: &VideoTimecode| {
        let part = code.frames.fract() - share(code);
        (-DECIMAL_SLACK..1.0 / base + DECIMAL_SLACK).contains(&part)
    };
    let is_exact = later && codes.iter().all(exact);
    let repeats = later && codes.iter().all(within);
    let counted = |code: &VideoTimecode| match (is_exact, repeats) {
        (true, _) => code.frames.floor(),
        (false, true) => code.frames.fract() * base,
        (false, false) => code.frames,
    };
    let clock_seconds = |seconds: f64, frames: f64| {
        let minutes = (seconds / 60.0).floor();
        let left_out = dropped * (minutes - (minutes / 10.0).floor());
        let length = if drops { 1.001 } else { 1.0 };
        (seconds * base + frames - left_out) * length / base
    };
    let day = clock_seconds(SECONDS_PER_DAY, 0.0);
    let mut days = 0.0;
    let mut before = f64::NEG_INFINITY;
    let seconds = codes.iter().map(|code| {
        let mut time = clock_seconds(code.seconds, counted(code)) + days;
        if time < before - SECONDS_PER_DAY / 2.0 {
            days += day;
            time += day;
        }
        before = time;
        time
    });
    TimecodeTimes {
        seconds: seconds.collect(),
        base,
        is_guessed,
        drops,
        repeats,
    }
}

/// Returns the frames in a second that timecodes count, and whether nothing shows them: the usual number with which the
/// steps across seconds are like the others.
fn infer_timecode_base(codes: &[VideoTimecode]) -> (f64, bool) {
    let frames = codes.iter().map(|code| code.frames.floor());
    let largest = frames.fold(0.0, f64::max);
    let mut possible = TIMECODE_BASES_FPS.into_iter().filter(|base| largest < *base);
    let least = possible.clone().next().unwrap_or(1000.0);
    let usual = if largest < USUAL_BASE { USUAL_BASE } else { least };
    let mut steps = Vec::new();
    let mut across = Vec::new();
    for pair in codes.windows(2) {
        let [before, after] = pair else { continue };
        // A day may end between them.
        let passed = (after.seconds - before.seconds).rem_euclid(SECONDS_PER_DAY);
        match passed {
            0.0 => steps.push(after.frames - before.frames),
            1.0 => across.push(after.frames - before.frames),
            _ => {}
        }
    }
    steps.sort_by(f64::total_cmp);
    across.sort_by(f64::total_cmp);
    let middle = |all: &[f64]| all.get(all.len() / 2).copied();
    let (Some(step), Some(turn)) = (middle(&steps), middle(&across)) else {
        return (usual, true);
    };
    let fits = possible.find(|base| (base + turn - step).abs() <= STEP_SLACK);
    match fits {
        Some(base) => (base, false),
        // Rows are missing at the ends of seconds; the last frame of a second may be there.
        None if largest + 1.0 == least => (least, true),
        None => (usual, true),
    }
}

/// Returns whether frames are left out where a count that drops frames leaves them out: at every minute but each tenth.
fn leaves_out(codes: &[VideoTimecode], base: f64) -> bool {
    let first = match base {
        30.0 => 2.0,
        60.0 => 4.0,
        _ => return false,
    };
    let begins = |code: &VideoTimecode| code.seconds % 60.0 == 0.0 && code.seconds % 600.0 != 0.0;
    let within = |code: &VideoTimecode| begins(code) && code.frames.floor() < first;
    let leaps = |pair: &[VideoTimecode]| {
        let [before, after] = pair else { return false };
        after.seconds - before.seconds == 1.0
            && before.frames.floor() == base - 1.0
            && begins(after)
            && after.frames.floor() == first
    };
    codes.windows(2).any(leaps) && !codes.iter().any(within)
}

/// Returns a time of day as a timecode that counts 60 frames a second and their thousandths, as phones write it:
/// `12:34:56:07.250`. After midnight it begins again.
pub(crate) fn format_timecode(at: RecordingInstant) -> String {
    const THOUSANDTHS_PER_SECOND: i64 = 60_000;
    let micros = i128::from(at.instant_micros()) * i128::from(THOUSANDTHS_PER_SECOND);
    let thousandths = (micros + 500_000).div_euclid(1_000_000) as i64;
    let thousandths = thousandths.rem_euclid(86_400 * THOUSANDTHS_PER_SECOND);
    let (seconds, part) = (
        thousandths / THOUSANDTHS_PER_SECOND,
        thousandths % THOUSANDTHS_PER_SECOND,
    );
    let (minutes, hours) = (seconds / 60 % 60, seconds / 3600);
    format!(
        "{hours:02}:{minutes:02}:{:02}:{:02}.{:03}",
        seconds % 60,
        part / 1000,
        part % 1000
    )
}

/// Returns the time of day of one timecode, such as `12:34:56:07@25`: the number after the `@` is the number of frames
/// in a second; without it, it follows from the capture's `rate`.
///
/// ```
/// use chereme_formats::timecode::time_of_day;
///
/// let at = time_of_day("01:00:02:05@25", 100.0).map(|at| at.instant_micros());
/// assert_eq!(at, Some(3_602_200_000));
/// assert_eq!(time_of_day("01:00:02:05", 100.0).map(|at| at.instant_micros()), at);
/// assert_eq!(time_of_day("25:00:00:00", 30.0), None);
/// ```
#[must_use]
pub fn time_of_day(text: &str, rate: f64) -> Option<RecordingInstant> {
    let (code, base) = match text.trim().split_once('@') {
        Some((code, base)) => (code, base.trim().parse().ok()?),
        None => (text, base_of(rate)),
    };
    let code = match code.trim().matches([':', ';']).count() {
        2 => parse_timecode(&format!("{}:00", code.trim()))?,
        _ => parse_timecode(code)?,
    };
    let sound = (1.0..=1000.0).contains(&base) && code.frames < base;
    sound.then(|| RecordingInstant::from_seconds(code.seconds + code.frames / base))
}

/// Returns the number of frames in a second that the timecodes of a capture of this rate use.
fn base_of(rate: f64) -> f64 {
    let is_multiple = |base: &f64| {
        let times = rate / base;
        times >= 0.99 && (times - times.round()).abs() < 0.002 * times
    };
    let usual = [30.0, 25.0, 24.0];
    usual.into_iter().find(is_multiple).unwrap_or(30.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(codes: &[String]) -> TimecodeTimes {
        let codes: Option<Vec<VideoTimecode>> = codes.iter().map(|code| parse_timecode(code)).collect();
        infer_timecode_times(&codes.expect("timecodes"))
    }

    /// Returns timecodes of frames from `begin` on, `step` apart, that count `base` a second.
    fn codes(begin: u32, count: u32, step: u32, base: u32, decimals: impl Fn(u32) -> String) -> Vec<String> {
        let code = |at: u32| {
            let frame = begin + at * step;
            let (second, frame) = (frame / base, frame % base);
            let (minute, second) = (second / 60, second % 60);
            format!("00:{minute:02}:{second:02}:{frame:02}{}", decimals(frame))
        };
        (0..count).map(code).collect()
    }

    #[test]
    fn the_step_from_a_second_into_the_next_shows_the_base() {
        let plain = |_: u32| String::new();
        // The first frame, the rows, the step between rows, the base, what is found, and whether it is guessed.
        let cases = [
            (0, 20, 1, 60, 60.0, true),
            (5, 24, 1, 60, 60.0, true),
            (0, 12, 2, 60, 60.0, true),
            (50, 25, 1, 60, 60.0, false),
            (40, 20, 2, 60, 60.0, false),
            (20, 20, 1, 24, 24.0, false),
            (20, 20, 1, 25, 25.0, false),
            (20, 20, 1, 30, 30.0, false),
            (0, 300, 1, 50, 50.0, false),
        ];
        for (begin, rows, step, base, found, is_guessed) in cases {
            let times = read(&codes(begin, rows, step, base, plain));
            assert_eq!(
                (times.base, times.is_guessed),
                (found, is_guessed),
                "{begin} {rows} {step} {base}"
            );
            let last = f64::from((rows - 1) * step) / found;
            let length = times.seconds[rows as usize - 1] - times.seconds[0];
            assert!((length - last).abs() < 1e-9, "{length} {last}");
        }
    }

    #[test]
    fn counts_that_drop_frames_are_even_across_minutes() {
        for (base, dropped) in [(30, 2), (60, 4)] {
            for separator in [':', ';'] {
                let code = |frame: u32| {
                    let minute = 60 * base - dropped;
                    let (minutes, frame) = match frame < 60 * base {
                        true => (0, frame),
                        false => (1 + (frame - 60 * base) / minute, dropped + (frame - 60 * base) % minute),
                    };
                    let (second, frame) = (frame / base, frame % base);
                    format!("00:{minutes:02}:{second:02}{separator}{frame:02}")
                };
                let all: Vec<String> = (0..150 * base).map(code).collect();
                let times = read(&all);
                assert!(times.drops, "{separator}");
                for (at, seconds) in (0u32..).zip(&times.seconds) {
                    let want = f64::from(at) * 1.001 / f64::from(base);
                    assert!((seconds - want).abs() < 1e-9, "{at} {seconds} {want}");
                }
            }
        }
    }

    #[test]
    fn decimals_of_the_second_are_not_added_to_the_frames() {
        let times = read(&codes(0, 120, 1, 60, |frame| {
            format!(".{:03}", (f64::from(frame) * 1000.0 / 60.0).round())
        }));
        assert!(times.repeats);
        assert!((times.seconds[90] - 1.5).abs() < 1e-9);
        // Two rows for each frame.
        let twice = (0..120).map(|row| {
            let (second, part) = (row / 60, f64::from(row % 60) / 60.0);
            format!("00:00:{second:02}:{:02}.{:03}", row % 60 / 2, (part * 1000.0).floor())
        });
        let times = read(&twice.collect::<Vec<_>>());
        assert!(times.repeats && times.base == 30.0);
        for (row, seconds) in (0..).zip(&times.seconds) {
            assert!((seconds - f64::from(row) / 60.0).abs() < 0.0011, "{row} {seconds}");
        }
        let times = read(&codes(0, 120, 1, 60, |_| ".500".to_owned()));
        assert!(!times.repeats);
        assert!((times.seconds[90] - 90.5 / 60.0).abs() < 1e-9);
    }
}
