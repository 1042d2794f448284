//! The phases of each hand: preparation, stroke, hold and retraction.

use std::ops::Range;

use chereme_motion::{RecordingInstant, TimeSpan};

use super::SampledSign;
use super::channel_holds::HandChannel;
use super::cut_curves::{CURVE_RATE, HandCurve, TakeCurves};
use super::cut_tuned::tuned;

/// A phase of the movement of a hand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HandPhase {
    /// Its time from the first frame of the take.
    pub span: TimeSpan,
    /// Its kind.
    pub kind: PhaseKind,
    /// The confidence of the sign that it belongs to.
    pub confidence: f64,
}

/// The kind of a phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PhaseKind {
    /// The hand comes to where the sign starts.
    Preparation,
    /// The hand makes the sign.
    Stroke,
    /// The hand stays.
    Hold,
    /// The hand goes back to rest.
    Retraction,
}

impl PhaseKind {
    /// Returns the id of its value in the inventory of phases.
    #[must_use]
    pub fn phase_name(self) -> &'static str {
        match self {
            Self::Preparation => "preparation",
            Self::Stroke => "stroke",
            Self::Hold => "hold",
            Self::Retraction => "retraction",
        }
    }
}

/// Returns the phases of each hand around and in the signs that it makes.
pub(super) fn divide_phases(curves: &TakeCurves, signs: &[SampledSign]) -> [Vec<HandPhase>; 2] {
    [0, 1].map(|number| {
        let hand = &curves.hands[number];
        let own_signs: Vec<&SampledSign> = signs.iter().filter(|sign| sign.counts[number]).collect();
        let mut pieces: Vec<(PhaseKind, Range<usize>, f64)> = Vec::new();
        for (place, sign) in own_signs.iter().enumerate() {
            let earliest = place.checked_sub(1).map_or(0, |before| own_signs[before].samples.end);
            let is_next = |next: &&&SampledSign| next.activity == sign.activity;
            // Between two signs of one activity the way is the next one's preparation.
            let follows = own_signs.get(place + 1).filter(is_next).is_some();
            let latest = own_signs
                .get(place + 1)
                .map_or(hand.speed.len() - 1, |after| after.samples.start);
            let prepares = way_to_posture(hand, sign.samples.start, earliest);
            pieces.push((PhaseKind::Preparation, prepares..sign.samples.start, sign.confidence));
            let held_pieces = strokes_and_holds(hand, &sign.samples).into_iter();
            pieces.extend(held_pieces.map(|(kind, samples)| (kind, samples, sign.confidence)));
            if !follows {
                let ends = way_from_posture(hand, sign.samples.end, latest);
                pieces.push((PhaseKind::Retraction, sign.samples.end..ends, sign.confidence));
            }
        }
        let mut phases: Vec<HandPhase> = Vec::new();
        let mut free_from = 0;
        for (kind, samples, confidence) in pieces {
            let instant = |sample: usize| RecordingInstant::from_seconds(sample as f64 / CURVE_RATE);
            // The way to a sign may begin within the retraction before it; phases of a hand never overlap.
            let start = samples.start.max(free_from);
            if start < samples.end {
                free_from = samples.end;
                phases.push(HandPhase {
                    span: TimeSpan::span_between(instant(start), instant(samples.end)),
                    kind,
                    confidence,
                });
            }
        }
        phases
    })
}

/// Returns the sample at which a hand sets out for the posture that it reaches at `begin`.
fn way_to_posture(hand: &HandCurve, begin: usize, earliest: usize) -> usize {
    end_of_way(&hand.posture_speed, (earliest..=begin).rev())
}

/// Returns the sample at which a hand that leaves its posture at `end` has arrived.
fn way_from_posture(hand: &HandCurve, end: usize, latest: usize) -> usize {
    end_of_way(&hand.posture_speed, end..=latest.max(end))
}

/// Returns the sample of a way, up to its peak and down again, at which the speed falls below a share of the peak.
fn end_of_way(speed: &[f64], samples: impl Iterator<Item = usize> + Clone) -> usize {
    // Only the peak next to the sign is that of its own way.
    let around = (tuned().activity.around * 2.0 * CURVE_RATE).round() as usize;
    let near = samples.clone().take(around);
    let peak = near.max_by(|a, b| speed[*a].total_cmp(&speed[*b])).unwrap_or(0);
    let slow = tuned().holds.moving * speed[peak];
    let mut last = peak;
    for sample in samples.skip_while(|sample| *sample != peak) {
        last = sample;
        if speed[sample] < slow {
            break;
        }
    }
    last
}

/// Divides a sign of a hand into holds, in which place, palm and fingers are held, and strokes.
fn strokes_and_holds(hand: &HandCurve, samples: &Range<usize>) -> Vec<(PhaseKind, Range<usize>)> {
    let channels = HandChannel::ALL_CHANNELS.map(|channel| channel.speed_and_limit(hand, samples));
    let is_held = |sample: usize| channels.iter().all(|(speed, limit)| speed[sample] < *limit);
    let shortest = (tuned().holds.shortest * CURVE_RATE).round() as usize;
    let mut pieces: Vec<(PhaseKind, Range<usize>)> = Vec::new();
    let mut start = samples.start;
    while start < samples.end {
        let held = is_held(start);
        let end = (start..samples.end)
            .find(|sample| is_held(*sample) != held)
            .unwrap_or(samples.end);
        // A short stop is a turning point of the stroke and no hold.
        let kind = match held && end - start >= shortest {
            true => PhaseKind::Hold,
            false => PhaseKind::Stroke,
        };
        match pieces.last_mut() {
            Some((before, piece)) if *before == kind => piece.end = end,
            _ => pieces.push((kind, start..end)),
        }
        start = end;
    }
    pieces
}
