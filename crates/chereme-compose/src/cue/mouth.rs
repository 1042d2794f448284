//! The mouth that speaks the cued sounds: a curve for each sound.

use chereme_sign::cue::CuedUtterance;
use chereme_sign::hamnosys::hamnosys_face::FacialExpression;

use crate::outcome::GeneratedCurve;

/// The time before a sound at which the lips begin to form it, in seconds.
const LIP_LEAD_S: f64 = 0.06;
/// The time in which the lips change from one sound to the next, in seconds.
const LIP_CHANGE_S: f64 = 0.09;

/// Returns a curve for each sound that is visible on the lips; `lead` is the time of the first sound in seconds.
pub(super) fn mouth_sound_curves(
    read: &CuedUtterance,
    lead: f64,
    frames: usize,
    frame_time: f64,
) -> Vec<GeneratedCurve> {
    let mut curves: Vec<GeneratedCurve> = Vec::new();
    for phone in &read.phones {
        let symbols = read.code.sampa_symbols(&phone.label, read.alphabet);
        let (Some(symbols), Some(span)) = (symbols, phone.span) else {
            continue;
        };
        let (start, end) = (
            lead + span.span_start_instant().instant_seconds(),
            lead + span.span_end_instant().instant_seconds(),
        );
        let each = (end - start) / symbols.len().max(1) as f64;
        for (n, symbol) in symbols.iter().enumerate() {
            let start = start + n as f64 * each;
            // Sounds of the throat and the tongue cannot be seen.
            if FacialExpression::from_nonmanual_code("mouthing", symbol).is_none() {
                continue;
            }
            let name = format!("mouthing.{symbol}");
            let curve_index = match curves.iter().position(|curve| curve.name == name) {
                Some(at) => at,
                None => {
                    curves.push(GeneratedCurve {
                        name,
                        values: vec![0.0; frames],
                    });
                    curves.len() - 1
                }
            };
            raise_lip_curve(&mut curves[curve_index].values, start, start + each, frame_time);
        }
    }
    curves
}

fn raise_lip_curve(values: &mut [f64], start: f64, end: f64, frame_time: f64) {
    let first = ((start - LIP_LEAD_S) / frame_time).floor().max(0.0) as usize;
    let raw_last = ((end - LIP_LEAD_S + LIP_CHANGE_S) / frame_time).ceil().max(0.0) as usize;
    let last = raw_last.min(values.len());
    for (frame, value) in values.iter_mut().enumerate().take(last).skip(first) {
        let time = frame as f64 * frame_time;
        let rise = smooth_lip_share((time - start + LIP_LEAD_S) / LIP_CHANGE_S);
        let fall = smooth_lip_share((time - end + LIP_LEAD_S) / LIP_CHANGE_S);
        // Two neighbouring sounds of one kind are no stronger than one.
        *value = (*value + rise - fall).clamp(0.0, 1.0);
    }
}

/// Returns a smooth share from 0 to 1 whose slope is 0 at both ends.
fn smooth_lip_share(share: f64) -> f64 {
    let share = share.clamp(0.0, 1.0);
    share * share * share * (share * (6.0 * share - 15.0) + 10.0)
}
