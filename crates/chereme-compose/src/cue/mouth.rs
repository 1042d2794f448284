//! The mouth that speaks the cued sounds: a curve for each sound.

use chereme_sign::cue::Utterance;
use chereme_sign::hamnosys::face::Expression;

use crate::outcome::Curve;

/// The time before a sound at which the lips begin to form it, in seconds.
const BEFORE: f64 = 0.06;
/// The time in which the lips change from one sound to the next, in seconds.
const CHANGE: f64 = 0.09;

/// Returns a curve for each sound that is visible on the lips; `lead` is the time of the first sound in seconds.
pub(super) fn curves(read: &Utterance, lead: f64, frames: usize, frame_time: f64) -> Vec<Curve> {
    let mut curves: Vec<Curve> = Vec::new();
    for phone in &read.phones {
        let symbols = read.code.symbols(&phone.label, read.alphabet);
        let (Some(symbols), Some(span)) = (symbols, phone.span) else {
            continue;
        };
        let (start, end) = (lead + span.start().seconds(), lead + span.end().seconds());
        let each = (end - start) / symbols.len().max(1) as f64;
        for (n, symbol) in symbols.iter().enumerate() {
            let start = start + n as f64 * each;
            if Expression::of("mouthing", symbol).is_none() {
                continue;
            }
            let name = format!("mouthing.{symbol}");
            let at = match curves.iter().position(|curve| curve.name == name) {
                Some(at) => at,
                None => {
                    curves.push(Curve {
                        name,
                        values: vec![0.0; frames],
                    });
                    curves.len() - 1
                }
            };
            show(&mut curves[at].values, (start, start + each), frame_time);
        }
    }
    curves
}

fn show(values: &mut [f64], (start, end): (f64, f64), frame_time: f64) {
    let first = ((start - BEFORE) / frame_time).floor().max(0.0) as usize;
    let last = ((end - BEFORE + CHANGE) / frame_time).ceil().max(0.0) as usize;
    let last = last.min(values.len());
    for (frame, value) in values.iter_mut().enumerate().take(last).skip(first) {
        let time = frame as f64 * frame_time;
        let rise = level((time - start + BEFORE) / CHANGE);
        let fall = level((time - end + BEFORE) / CHANGE);
        *value = (*value + rise - fall).clamp(0.0, 1.0);
    }
}

/// Returns a smooth share from 0 to 1 whose slope is 0 at both ends.
fn level(share: f64) -> f64 {
    let share = share.clamp(0.0, 1.0);
    share * share * share * (share * (6.0 * share - 15.0) + 10.0)
}
