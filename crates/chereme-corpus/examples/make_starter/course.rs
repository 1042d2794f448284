//! Values that go from one moment to the next along minimum-jerk courses.

use chereme_motion::HandAngles;
use chereme_motion::glam::DVec3;

/// Returns the share of a way that is done at the share `u` of its time: at rest at both ends, with
/// the least jerk between (Flash & Hogan 1985).
pub(crate) fn minimum_jerk(u: f64) -> f64 {
    let u = u.clamp(0.0, 1.0);
    u * u * u * (10.0 + u * (6.0 * u - 15.0))
}

/// Returns the place of `time` between moments in order: the one before it and the share of the way
/// to the next.
pub(crate) fn between(times: &[f64], time: f64) -> (usize, f64) {
    let after = times.partition_point(|&at| at <= time);
    match (after.checked_sub(1), times.get(after)) {
        (None, _) => (0, 0.0),
        (Some(before), None) => (before, 0.0),
        (Some(before), Some(next)) => (before, (time - times[before]) / (next - times[before])),
    }
}

/// Three angles over time.
#[derive(Clone, Debug, Default)]
pub(crate) struct Turns {
    times: Vec<f64>,
    angles: Vec<DVec3>,
}

impl Turns {
    /// Adds a moment after those before; one that is not later is left out.
    pub(crate) fn push(&mut self, time: f64, angles: DVec3) {
        if self.times.last().is_none_or(|&last| time > last + 0.05) {
            self.times.push(time);
            self.angles.push(angles);
        }
    }

    /// Returns the angles at `time`.
    pub(crate) fn at(&self, time: f64) -> DVec3 {
        if self.times.is_empty() {
            return DVec3::ZERO;
        }
        let (n, share) = between(&self.times, time);
        let next = self.angles.get(n + 1).unwrap_or(&self.angles[n]);
        self.angles[n].lerp(*next, minimum_jerk(share))
    }
}

/// The handshapes of one hand over time: from each the fingers start and arrive by and by.
#[derive(Clone, Debug)]
pub(crate) struct Fingers {
    first: HandAngles,
    changes: Vec<Change>,
}

#[derive(Clone, Debug)]
struct Change {
    start: f64,
    end: f64,
    to: HandAngles,
}

impl Fingers {
    /// Returns the fingers of a hand in one shape.
    pub(crate) fn new(first: HandAngles) -> Self {
        Self {
            first,
            changes: Vec::new(),
        }
    }

    /// Adds the change to `to` between two moments after those before.
    pub(crate) fn change(&mut self, start: f64, end: f64, to: HandAngles) {
        self.changes.push(Change { start, end, to });
    }

    /// Returns the shape at `time`.
    pub(crate) fn at(&self, time: f64) -> HandAngles {
        let done = self.changes.partition_point(|change| change.end <= time);
        let from = done
            .checked_sub(1)
            .map_or(&self.first, |n| &self.changes[n].to);
        match self.changes.get(done) {
            Some(change) if change.start < time => {
                let share = (time - change.start) / (change.end - change.start);
                blend(from, &change.to, share)
            }
            _ => *from,
        }
    }
}

/// Each digit takes four fifths of the time; a thumb that closes over the fingers comes last, one
/// that opens goes first, and the fingers follow each other from the index.
fn blend(from: &HandAngles, to: &HandAngles, share: f64) -> HandAngles {
    let digit = |delay: f64| minimum_jerk((share - delay) / 0.8);
    let closing = to.thumb.palmar > from.thumb.palmar + 0.1;
    let thumb = from.lerp(to, digit(if closing { 0.20 } else { 0.0 })).thumb;
    let delays = if closing {
        [0.0, 0.03, 0.06, 0.09]
    } else {
        [0.10, 0.13, 0.16, 0.19]
    };
    let fingers = std::array::from_fn(|n| from.lerp(to, digit(delays[n])).fingers[n]);
    HandAngles { thumb, fingers }
}
