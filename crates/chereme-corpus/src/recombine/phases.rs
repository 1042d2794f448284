//! The phase of each key in cued speech: the time from the start of its first sound to the arrival of the hand.
//!
//! Tokens store it in milliseconds. The medians of captured keys are in seconds; those of a consonant with a vowel are
//! shares of the consonant's duration.

use chereme_compose::{CuePhases, CueTier};
use chereme_sign::cue;
use rusqlite::Connection;

use crate::db::attributes::{self, AttributeRow};
use crate::db::columns::Origin;
use crate::db::tiers::{self, AnnotationRow};
use crate::db::{recordings, signs};
use crate::error::Result;

/// The attribute of a key's token that holds its phase.
pub(crate) const PHASE: &str = "cue-phase";
/// The fewest keys of a type that are enough to measure its phase.
const FEWEST: usize = 8;
/// The handshape of a vowel without a consonant.
const VOWEL: u8 = 5;

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
pub(crate) fn store(connection: &Connection, recording: i64) -> Result<()> {
    let mut tokens = signs::tokens_of_recording(connection, recording)?;
    tokens.retain(|token| cue::of_gloss(&token.gloss).is_some());
    if tokens.is_empty() {
        return Ok(());
    }
    let gestures = named(connection, recording, CueTier::Hand.name())?;
    let mut gestures = gestures.as_slice();
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
            name: PHASE.to_owned(),
            text: format!("{phase:.1}"),
            number: Some(phase),
        };
        attributes::set(connection, token.id, &[row])?;
    }
    Ok(())
}

/// Returns the annotations of a tier of that name, by time.
fn named(connection: &Connection, recording: i64, name: &str) -> Result<Vec<AnnotationRow>> {
    let mut found = Vec::new();
    for tier in tiers::tiers(connection, recording)? {
        if tier.name == name {
            found.extend(tiers::annotations(connection, tier.id)?);
        }
    }
    found.sort_by_key(|row| row.start_us);
    Ok(found)
}

/// Returns the medians of the phases of captured keys of a consonant with a vowel, of a vowel, and of a consonant; nothing
/// if one of the three has fewer than [`FEWEST`] keys.
///
/// The sounds of a key are the phones that begin within it.
pub(crate) fn measured(connection: &Connection) -> Result<Option<CuePhases>> {
    let mut found: [Vec<f64>; 3] = Default::default();
    for row in recordings::recordings(connection)? {
        if row.origin == Origin::Made {
            continue;
        }
        let keys = named(connection, row.id, CueTier::Keys.name())?;
        let phones = named(connection, row.id, CueTier::Phones.name())?;
        let gestures = named(connection, row.id, CueTier::Hand.name())?;
        let mut gestures = gestures.as_slice();
        for key in &keys {
            let Some((placement, shape)) = cue::key_of_label(&key.value) else {
                continue;
            };
            let own = format!("{placement}-{shape}");
            let Some(gesture) = next_to(&mut gestures, &own) else {
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
                    found[0].push(phase / consonant.max(1e-3));
                }
                (_, VOWEL) => found[1].push(phase),
                _ => found[2].push(phase),
            }
        }
    }
    if found.iter().any(|of| of.len() < FEWEST) {
        return Ok(None);
    }
    let counts = [found[0].len(), found[1].len(), found[2].len()];
    let [pair, vowel, consonant] = found.map(|mut of| {
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
