//! Compares proposals for brows, lids, gaze, mouth and head with the events that a generator put into the curves.

use std::collections::BTreeMap;

use chereme_analysis::nonmanuals::{ObservedFaceCurves, propose_face_actions};

/// Frames a second, and the seconds of a take.
const RATE: f64 = 50.0;
const SECONDS: f64 = 40.0;

/// A small generator of numbers (splitmix64).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.next()).sum::<f64>() - 6.0
    }
}

/// Something that a generated face does: the part, the value, begin and end in seconds.
type Event = (&'static str, &'static str, f64, f64);

/// The curves of a generated take, and the events in them.
struct Take {
    brows: [Vec<f64>; 2],
    squeeze: Vec<f64>,
    lids: Vec<f64>,
    gaze: [Vec<f64>; 2],
    jaw: Vec<f64>,
    pitch: Vec<f64>,
    yaw: Vec<f64>,
    truth: Vec<Event>,
}

fn add(curve: &mut [f64], (from, to): (f64, f64), ramp: f64, size: f64) {
    for (frame, value) in curve.iter_mut().enumerate() {
        let at = frame as f64 / RATE;
        let share = ((at - from) / ramp + 0.5).min((to - at) / ramp + 0.5);
        *value += size * share.clamp(0.0, 1.0);
    }
}

fn swing(curve: &mut [f64], (from, to): (f64, f64), rate: f64, size: f64) {
    for (frame, value) in curve.iter_mut().enumerate() {
        let at = frame as f64 / RATE;
        if (from..to).contains(&at) {
            *value += size * ((at - from) * rate * std::f64::consts::TAU).sin();
        }
    }
}

impl Take {
    /// Returns a take with one event after another in each part, and with similar non-events between them.
    fn new(numbers: &mut Numbers) -> Self {
        let count = (SECONDS * RATE) as usize;
        let still = || vec![0.0; count];
        let mut it = Self {
            brows: [still(), still()],
            squeeze: still(),
            lids: still(),
            gaze: [still(), still()],
            jaw: still(),
            pitch: still(),
            yaw: still(),
            truth: Vec::new(),
        };
        let (face, degrees) = (numbers.between(0.005, 0.04), numbers.between(0.05, 0.4));
        let drift = numbers.between(2.0, 6.0);
        let rest = numbers.between(0.0, 0.15);
        it.brow_events(numbers);
        it.lid_events(numbers);
        it.other_events(numbers);
        it.head_events(numbers);
        let all = [&mut it.squeeze, &mut it.lids, &mut it.jaw];
        for curve in all.into_iter().chain(&mut it.brows).chain(&mut it.gaze) {
            curve
                .iter_mut()
                .for_each(|value| *value += rest + face * numbers.normal());
        }
        for curve in [&mut it.pitch, &mut it.yaw] {
            swing(curve, (0.0, SECONDS), 0.07, drift);
            curve.iter_mut().for_each(|value| *value += degrees * numbers.normal());
        }
        it
    }

    /// Calls `event` with spans one after the other.
    fn spans(numbers: &mut Numbers, length: (f64, f64), mut event: impl FnMut(&mut Numbers, (f64, f64))) {
        let mut at = numbers.between(0.5, 2.0);
        loop {
            let end = at + numbers.between(length.0, length.1);
            if end > SECONDS - 0.5 {
                return;
            }
            event(numbers, (at, end));
            at = end + numbers.between(1.2, 3.5);
        }
    }

    fn brow_events(&mut self, numbers: &mut Numbers) {
        Self::spans(numbers, (0.4, 2.0), |numbers, span| {
            let size = numbers.between(0.5, 1.0);
            let value = match (numbers.next() * 5.0) as usize {
                0 => {
                    add(&mut self.squeeze, span, 0.1, size);
                    "furrowed"
                }
                1 => {
                    add(&mut self.brows[0], span, 0.1, size);
                    "raised-right"
                }
                2 => {
                    add(&mut self.brows[1], span, 0.1, size);
                    "raised-left"
                }
                3 => {
                    // Below the threshold of a proposal.
                    self.brows.iter_mut().for_each(|it| add(it, span, 0.1, 0.12));
                    return;
                }
                _ => {
                    self.brows.iter_mut().for_each(|it| add(it, span, 0.1, size));
                    "raised"
                }
            };
            self.truth.push(("brows", value, span.0, span.1));
        });
    }

    fn lid_events(&mut self, numbers: &mut Numbers) {
        Self::spans(numbers, (0.09, 0.16), |numbers, span| {
            let span = match (numbers.next() * 6.0) as usize {
                0 => {
                    let span = (span.0, span.0 + numbers.between(0.6, 1.5));
                    self.truth.push(("lids", "closed", span.0, span.1));
                    span
                }
                1 => {
                    // A squint.
                    add(&mut self.lids, (span.0, span.0 + 0.5), 0.08, 0.3);
                    return;
                }
                _ => {
                    self.truth.push(("lids", "blink", span.0, span.1));
                    span
                }
            };
            add(&mut self.lids, span, 0.07, numbers.between(0.85, 1.0));
        });
    }

    fn other_events(&mut self, numbers: &mut Numbers) {
        Self::spans(numbers, (0.4, 1.5), |numbers, span| {
            let (axis, sign, value) = match (numbers.next() * 4.0) as usize {
                0 => (0, 1.0, "left"),
                1 => (0, -1.0, "right"),
                2 => (1, 1.0, "up"),
                _ => (1, -1.0, "down"),
            };
            let size = sign * numbers.between(0.5, 1.0);
            add(&mut self.gaze[axis], span, 0.06, size);
            self.truth.push(("gaze", value, span.0, span.1));
        });
        Self::spans(numbers, (0.3, 1.2), |numbers, span| {
            add(&mut self.jaw, span, 0.1, numbers.between(0.45, 1.0));
            self.truth.push(("mouth", "open", span.0, span.1));
        });
    }

    fn head_events(&mut self, numbers: &mut Numbers) {
        Self::spans(numbers, (0.9, 2.5), |numbers, span| {
            let rate = numbers.between(1.4, 3.5);
            let size = numbers.between(3.0, 9.0);
            let turns = ((span.1 - span.0) * rate).floor().max(2.0);
            let span = (span.0, span.0 + turns / rate);
            match (numbers.next() * 4.0) as usize {
                0 => add(&mut self.yaw, span, 0.3, 4.0 * size),
                1 => {
                    swing(&mut self.pitch, span, rate, size);
                    self.truth.push(("head", "nodding", span.0, span.1));
                }
                _ => {
                    swing(&mut self.yaw, span, rate, size);
                    self.truth.push(("head", "shaking", span.0, span.1));
                }
            }
        });
    }

    fn curves(&self) -> ObservedFaceCurves<'_> {
        ObservedFaceCurves {
            rate: RATE,
            brow_raise: [Some(&self.brows[0]), Some(&self.brows[1])],
            brow_squeeze: Some(&self.squeeze),
            eye_close: [Some(&self.lids), Some(&self.lids)],
            gaze_left: Some(&self.gaze[0]),
            gaze_up: Some(&self.gaze[1]),
            jaw_open: Some(&self.jaw),
            lips_part: None,
            head_pitch: Some(&self.pitch),
            head_yaw: Some(&self.yaw),
        }
    }
}

/// Counts of correct proposals of one value.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Count {
    /// The events that the generator put in.
    pub(crate) there: usize,
    /// The proposals.
    pub(crate) proposed: usize,
    /// Proposals of the right value whose overlap with the event is at least half of their union.
    pub(crate) right: usize,
}

impl Count {
    /// Returns the share of proposals that are right.
    pub(crate) fn precision(&self) -> f64 {
        self.right as f64 / self.proposed.max(1) as f64
    }

    /// Returns the share of the generator's events that were found.
    pub(crate) fn recall(&self) -> f64 {
        self.right as f64 / self.there.max(1) as f64
    }
}

/// Counts proposals over generated takes, by part and value.
pub(crate) fn counted(takes: usize) -> BTreeMap<(&'static str, &'static str), Count> {
    let mut numbers = Numbers(24);
    let mut all: BTreeMap<_, Count> = BTreeMap::new();
    for _ in 0..takes {
        let take = Take::new(&mut numbers);
        for (part, value, ..) in &take.truth {
            all.entry((*part, *value)).or_default().there += 1;
        }
        let mut open = take.truth.clone();
        for found in propose_face_actions(&take.curves()) {
            let count = all.entry((found.feature, found.value)).or_default();
            count.proposed += 1;
            let (from, to) = (found.frames.start as f64 / RATE, found.frames.end as f64 / RATE);
            let shares = |event: &Event| {
                let both = to.min(event.3) - from.max(event.2);
                both / (to.max(event.3) - from.min(event.2)) >= 0.5
            };
            let same = |event: &Event| (event.0, event.1) == (found.feature, found.value);
            if let Some(at) = open.iter().position(|event| same(event) && shares(event)) {
                open.remove(at);
                count.right += 1;
            }
        }
    }
    all
}
