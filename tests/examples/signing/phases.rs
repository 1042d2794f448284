//! Divides the movement of wrists into approaches, strokes, holds and returns, and prints their table.

use std::ops::Range;

use crate::take::{RATE, Take};

/// Two pieces of movement are one if the speed between them stays above this share of the lower peak.
const DIP: f64 = 0.55;
/// Least peak of speed (m/s) and least path (m) of a stretch.
const LEAST: (f64, f64) = (0.15, 0.03);
/// A stretch lasts while the speed is above this share of its peak.
const ENDS: f64 = 0.1;
/// A hand rests below this height under the shoulders, in metres.
const LOW: f64 = -0.25;
/// A stretch leads from or to rest if it rises or sinks by more than this, in metres.
const FAR: f64 = 0.12;

/// A stretch of movement between two minima of speed.
pub(crate) struct Stretch {
    /// The frames in which the speed is above a tenth of its peak.
    pub(crate) frames: Range<usize>,
    /// The frames from the minimum of speed before to the one after.
    pub(crate) whole: Range<usize>,
    /// Its top speed in metres per second.
    pub(crate) peak: f64,
    /// Its length in metres.
    pub(crate) length: f64,
}

impl Stretch {
    fn seconds(&self) -> f64 {
        self.frames.len() as f64 / RATE
    }
}

/// The stretches of a hand's movement from its first rise to its last fall.
pub(crate) struct Phases {
    pub(crate) approach: Option<Stretch>,
    pub(crate) strokes: Vec<Stretch>,
    pub(crate) back: Option<Stretch>,
}

/// Returns the phases of a take.
pub(crate) fn phases(take: &Take) -> Phases {
    let mut all = stretches(take);
    let height = |n: usize| take.path[n].y;
    let rises = |it: &Stretch| {
        let (from, to) = (it.frames.start, it.frames.end);
        height(from) < LOW && height(to) - height(from) > FAR
    };
    let sinks = |it: &Stretch| {
        let (from, to) = (it.frames.start, it.frames.end);
        height(to) < LOW && height(from) - height(to) > FAR
    };
    let approach = all.first().is_some_and(rises).then(|| all.remove(0));
    let back = all.last().is_some_and(sinks).then(|| all.pop()).flatten();
    Phases {
        approach,
        strokes: all,
        back,
    }
}

fn stretches(take: &Take) -> Vec<Stretch> {
    let speeds = &take.speeds;
    let last = speeds.len() - 1;
    let mut cuts = vec![0];
    cuts.extend((1..last).filter(|&n| speeds[n] <= speeds[n - 1] && speeds[n] < speeds[n + 1]));
    cuts.push(last);
    let peak = |range: &Range<usize>| speeds[range.start..=range.end].iter().copied().fold(0.0, f64::max);
    let mut parts: Vec<Range<usize>> = cuts.windows(2).map(|two| two[0]..two[1]).collect();
    let mut n = 0;
    while n + 1 < parts.len() {
        let lower = peak(&parts[n]).min(peak(&parts[n + 1]));
        if speeds[parts[n].end] > DIP * lower {
            parts[n].end = parts[n + 1].end;
            parts.remove(n + 1);
            n = n.saturating_sub(1);
        } else {
            n += 1;
        }
    }
    let found = parts.into_iter().filter_map(|range| {
        let peak = peak(&range);
        let moves = |n: &usize| speeds[*n] > ENDS * peak;
        let start = (range.start..=range.end).find(moves)?;
        let end = (range.start..=range.end).rev().find(moves)?;
        let length = speeds[start..=end].iter().sum::<f64>() / RATE;
        let falls = |n: usize, next: usize| range.contains(&next) && speeds[next] < speeds[n];
        let (mut first, mut last) = (start, end);
        while first > 0 && falls(first, first - 1) {
            first -= 1;
        }
        while falls(last, last + 1) {
            last += 1;
        }
        (peak > LEAST.0 && length > LEAST.1 && end > start).then_some(Stretch {
            frames: start..end,
            whole: first..last,
            peak,
            length,
        })
    });
    found.collect()
}

/// Returns the table of phases.
pub(crate) fn table(takes: &[Take]) -> String {
    let all: Vec<Phases> = takes.iter().map(phases).collect();
    let approaches: Vec<&Stretch> = all.iter().filter_map(|it| it.approach.as_ref()).collect();
    let backs: Vec<&Stretch> = all.iter().filter_map(|it| it.back.as_ref()).collect();
    let strokes: Vec<&Stretch> = all.iter().flat_map(|it| &it.strokes).collect();
    let short: Vec<&Stretch> = strokes.iter().copied().filter(|it| it.length < 0.1).collect();
    let mid = |it: &&&Stretch| (0.1..0.2).contains(&it.length);
    let middle: Vec<&Stretch> = strokes.iter().filter(mid).copied().collect();
    let long: Vec<&Stretch> = strokes.iter().copied().filter(|it| it.length >= 0.2).collect();
    let mut text = format!(
        "{} hands of {} files; medians with quartiles.\n\n\
         | phase | count | duration, s | top speed, m/s | path, m | top speed against mean |\n\
         |---|--:|--:|--:|--:|--:|\n",
        takes.len(),
        files(takes)
    );
    for (name, some) in [
        ("approach from rest", &approaches),
        ("stroke", &strokes),
        ("stroke under 10 cm", &short),
        ("stroke of 10 to 20 cm", &middle),
        ("stroke over 20 cm", &long),
        ("return to rest", &backs),
    ] {
        let of =
            |value: &dyn Fn(&Stretch) -> f64, digits: usize| spread(some.iter().map(|it| value(it)).collect(), digits);
        text.push_str(&format!(
            "| {name} | {} | {} | {} | {} | {} |\n",
            some.len(),
            of(&Stretch::seconds, 2),
            of(&|it| it.peak, 2),
            of(&|it| it.length, 3),
            of(&|it| it.peak * it.seconds() / it.length, 2),
        ));
    }
    text.push('\n');
    text.push_str(&shares(&all));
    text
}

/// Returns the shares of movement and of holds in signing, and the speed of approaches relative to strokes.
fn shares(all: &[Phases]) -> String {
    let mut moving = Vec::new();
    let mut holds = Vec::new();
    let mut faster = Vec::new();
    for phases in all {
        let (Some(first), Some(last)) = (phases.strokes.first(), phases.strokes.last()) else {
            continue;
        };
        let whole = (last.frames.end - first.frames.start) as f64;
        let strokes: usize = phases.strokes.iter().map(|it| it.frames.len()).sum();
        moving.push(strokes as f64 / whole);
        let gaps = phases.strokes.windows(2);
        holds.extend(gaps.map(|two| (two[1].frames.start - two[0].frames.end) as f64 / RATE));
        let top = phases.strokes.iter().map(|it| it.peak).fold(0.0, f64::max);
        faster.extend(phases.approach.as_ref().map(|it| it.peak / top));
    }
    format!(
        "Share of movement from the first stroke to the last: {}. Hold between two strokes: {} s. Top speed of the \
         approach against the fastest stroke after it: {}.\n",
        spread(moving, 2),
        spread(holds, 2),
        spread(faster, 2)
    )
}

fn files(takes: &[Take]) -> usize {
    let mut names: Vec<&str> = takes.iter().map(|take| take.file.as_str()).collect();
    names.dedup();
    names.len()
}

/// Returns the median with the quartiles.
pub(crate) fn spread(mut values: Vec<f64>, digits: usize) -> String {
    if values.is_empty() {
        return "–".to_owned();
    }
    values.sort_by(f64::total_cmp);
    let at = |share: f64| values[((values.len() - 1) as f64 * share).round() as usize];
    format!("{:.digits$} ({:.digits$} to {:.digits$})", at(0.5), at(0.25), at(0.75))
}
