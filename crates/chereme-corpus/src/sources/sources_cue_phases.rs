//! The phase of each key in cued speech: the time from the start of its first sound to the arrival of the hand.
//!
//! Tokens store it in milliseconds. The medians of captured keys are in seconds; those of a consonant with a vowel are
//! shares of the consonant's duration.

use chereme_compose::{CuePhases, CueTier};
use chereme_sign::cue;
use rusqlite::Connection;

use crate::db::stored_attributes::{self, AttributeRow};
use crate::db::stored_columns::RecordOrigin;
use crate::db::stored_tiers::{self, AnnotationRow};
use crate::db::{signs, stored_recordings};
use crate::error::CorpusResult;

/// The attribute of a key's token that holds its phase.
pub(crate) const CUE_PHASE_ATTRIBUTE: &str = "cue-phase";
/// The fewest keys of a type that are enough to measure its phase.
const MIN_PHASE_KEYS: usize = 8;
/// The handshape of a vowel without a consonant.
const VOWEL_ONLY_HANDSHAPE: u8 = 5;

/// Returns the next gesture that leads to a key and cuts the list behind it; leaves the list as it is if no gesture leads to
/// the key.
fn next_to<'g>(gestures: &mut &'g [AnnotationRow], key: &str) -> Option<&'g AnnotationRow> {
    let all = *gestures;
    let leads = |gesture: &AnnotationRow| gesture.value.rsplit('>').next() == Some(key);
    let n = all.iter().position(leads)?;
    *gestures = &all[n + 1..];
    Some(&all[n])
}

/// Sets the phases of the key tokens in a recording, computed from the tokens' starts and the tier of the hand's
/// movement. A gesture is named `FROM>TO`; gestures and keys are in the same order.
pub(crate) fn store_cue_phases(connection: &Connection, recording: i64) -> CorpusResult<()> {
    let mut tokens = signs::tokens_of_recording(connection, recording)?;
    tokens.retain(|token| cue::of_gloss(&token.gloss).is_some());
    if tokens.is_empty() {
        return Ok(());
    }
    let gesture_rows = annotations_of_named_tier(connection, recording, CueTier::Hand.cue_tier_name())?;
    let mut gestures = gesture_rows.as_slice();
    for token in tokens {
        let key = token.gloss.trim_start_matches("cue:").to_owned();
        let Some(gesture) = next_to(&mut gestures, &key) else {
            continue;
        };
        let Some(start) = token.start_us else {
            continue;
        };
        let phase = (gesture.end_us - start) as f64 / 1000.0;
        let row = AttributeRow {
            name: CUE_PHASE_ATTRIBUTE.to_owned(),
            text: format!("{phase:.1}"),
            number: Some(phase),
        };
        stored_attributes::set_token_attributes(connection, token.id, &[row])?;
    }
    Ok(())
}

/// Returns the annotations of a tier of that name, by time.
fn annotations_of_named_tier(connection: &Connection, recording: i64, name: &str) -> CorpusResult<Vec<AnnotationRow>> {
    let mut rows = Vec::new();
    for tier in stored_tiers::load_tier_rows(connection, recording)? {
        if tier.name == name {
            rows.extend(stored_tiers::load_tier_annotation_rows(connection, tier.id)?);
        }
    }
    rows.sort_by_key(|row| row.start_us);
    Ok(rows)
}

/// Returns the medians of the phases of captured keys of a consonant with a vowel, of a vowel, and of a consonant; nothing
/// if one of the three has fewer than [`MIN_PHASE_KEYS`] keys.
///
/// The sounds of a key are the phones that begin within it.
pub(crate) fn measured_cue_phases(connection: &Connection) -> CorpusResult<Option<CuePhases>> {
    let mut phase_samples: [Vec<f64>; 3] = Default::default();
    for row in stored_recordings::load_recording_rows(connection)? {
        if row.origin == RecordOrigin::Made {
            continue;
        }
        let keys = annotations_of_named_tier(connection, row.id, CueTier::Keys.cue_tier_name())?;
        let phones = annotations_of_named_tier(connection, row.id, CueTier::Phones.cue_tier_name())?;
        let gesture_rows = annotations_of_named_tier(connection, row.id, CueTier::Hand.cue_tier_name())?;
        let mut gestures = gesture_rows.as_slice();
        for key in &keys {
            let Some((placement, shape)) = cue::key_of_label(&key.value) else {
                continue;
            };
            let gesture_name = format!("{placement}-{shape}");
            let Some(gesture) = next_to(&mut gestures, &gesture_name) else {
                continue;
            };
            let first = phones.partition_point(|phone| phone.start_us < key.start_us);
            let sounds: Vec<&AnnotationRow> = phones[first..]
                .iter()
                .take_while(|phone| phone.start_us < key.end_us)
                .collect();
            let phase = (gesture.end_us - key.start_us) as f64 / 1e6;
            match (sounds.len(), shape) {
                (2.., _) => {
                    let consonant = (sounds[1].start_us - key.start_us) as f64 / 1e6;
                    // A phone of no length must not divide by zero.
                    phase_samples[0].push(phase / consonant.max(1e-3));
                }
                (_, VOWEL_ONLY_HANDSHAPE) => phase_samples[1].push(phase),
                _ => phase_samples[2].push(phase),
            }
        }
    }
    if phase_samples.iter().any(|of| of.len() < MIN_PHASE_KEYS) {
        return Ok(None);
    }
    let counts = [phase_samples[0].len(), phase_samples[1].len(), phase_samples[2].len()];
    let [pair, vowel, consonant] = phase_samples.map(|mut of| {
        of.sort_by(f64::total_cmp);
        of[of.len() / 2]
    });
    Ok(Some(CuePhases {
        pair,
        vowel,
        consonant,
        counts,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_without_a_gesture_hides_no_later_key() {
        let row = |value: &str| AnnotationRow {
            value: value.to_owned(),
            ..AnnotationRow::default()
        };
        let all = ["N>side-5", "side-5>chin-1", "chin-1>side-5"].map(row);
        let mut gestures = all.as_slice();
        let found = ["side-5", "mouth-2", "chin-1", "side-5", "chin-1"]
            .map(|key| next_to(&mut gestures, key).map(|it| it.value.as_str()));
        assert_eq!(
            found,
            [
                Some("N>side-5"),
                None,
                Some("side-5>chin-1"),
                Some("chin-1>side-5"),
                None
            ]
        );
    }
}
