//! Body language measured in captured movement: size, duration and depth of annotated movements.
//!
//! Only captured movement counts, and only if a person has named the kind of movement: on a tier, or in the lexicon
//! entry of its sign. Annotations by the program itself do not count, because its categories are those of the usual
//! body language. Movements without a marked size have the usual size.

use std::collections::BTreeMap;
use std::ops::Range;

use chereme_analysis::measure::{MeasuredKind, MeasuredStroke, measure_hand_movement};
use chereme_compose::{BodyLanguageChanges, LanguageValue};
use chereme_motion::{BodyAnatomy, BodySide, TimeSpan};
use chereme_sign::SignComponent;
use chereme_sign::hamnosys::BodyLanguage;
use chereme_sign::tier::AnnotatedHands;
use chereme_sign::{HandRef, SignerHandedness};
use rusqlite::Connection;

use crate::address::{CorpusAddress, RowName};
use crate::db::stored_recordings;
use crate::db::stored_spans::{self, LexiconMovement, MovementSpan};
use crate::error::CorpusResult;
use crate::inventories::StoredInventory;
use crate::movement::{ChannelGroup, MotionTrack};

/// The fewest movements for a measured number; with fewer the usual number stays.
const MIN_MEASURED_MOVEMENTS: usize = 8;
/// The largest number of annotations that are read, and of movements that are measured; they are evenly spread.
const MOST_SPANS: usize = 50_000;
const MOST_MEASURED: usize = 600;
/// The margin before and after a stretch, in microseconds: annotations are not exact.
const MEASURED_MARGIN_US: i64 = 300_000;
/// The shortest transition in seconds, whatever its distance.
const LEAST_TRANSITION: f64 = 0.05;
/// Names of the numbers for a small, a usual and a big size; those that are not measured keep their proportion to the
/// usual size.
const MOVEMENT_SIZE_NAMES: [[&str; 3]; 2] = [
    ["move.small", "move.normal", "move.big"],
    ["circle.small", "circle.normal", "circle.big"],
];

/// The measurements: for each number the signers and amounts.
#[derive(Debug, Clone, Default)]
pub(crate) struct MovementSamples(BTreeMap<&'static str, Vec<(Option<String>, f64)>>);

/// A movement whose kind someone has annotated.
#[derive(Debug, Clone, PartialEq)]
struct MeasuredMovement {
    recording: i64,
    span: TimeSpan,
    hand: Option<AnnotatedHands>,
    kind: String,
    size: Option<String>,
    /// Whether its manner is the usual one, so that its duration counts.
    plain: bool,
    /// Whether the stretch is a whole sign, which may contain only one stroke.
    sign: bool,
}

impl MovementSamples {
    /// Measures annotated movements in captured recordings.
    pub(crate) fn measure_annotated_movements(
        connection: &Connection,
        inventories: &[StoredInventory],
    ) -> CorpusResult<Self> {
        let spans = stored_spans::movement_spans(connection, MOST_SPANS)?;
        let lexicon = stored_spans::lexicon_movements(connection, MOST_SPANS)?;
        let mut movements = on_tiers(&spans, inventories);
        movements.extend(in_lexicon(&lexicon));
        // Movements of a recording follow each other, so that its track and body are read once.
        movements.sort_by_key(|movement| {
            (
                movement.recording,
                movement.span.span_start_instant(),
                movement.span.span_end_instant(),
            )
        });
        let count = movements.len().min(MOST_MEASURED);
        let spread = (0..count).map(|n| &movements[n * movements.len() / count]);
        let mut samples = Self::default();
        let mut body: Option<MeasuredBody> = None;
        for movement in spread {
            if body
                .as_ref()
                .is_none_or(|current| current.recording != movement.recording)
            {
                body = Some(MeasuredBody::body_of_recording(connection, movement.recording)?);
            }
            if let Some(body) = &body {
                samples.take_movement_sample(connection, body, movement)?;
            }
        }
        Ok(samples)
    }

    fn take_movement_sample(
        &mut self,
        connection: &Connection,
        body: &MeasuredBody,
        movement: &MeasuredMovement,
    ) -> CorpusResult<()> {
        let Some((track, anatomy)) = &body.track else {
            return Ok(());
        };
        let kind = match movement.kind.as_str() {
            // A hold needs no movement to be measured: its annotation is its duration.
            "hold" | "held" => {
                let name = if movement.kind == "held" {
                    "time.end"
                } else {
                    "time.hold"
                };
                self.add_sample_value(name, body, movement.span.span_seconds());
                return Ok(());
            }
            "straight" | "arc" => MeasuredKind::Stroke,
            "circle" => MeasuredKind::Round,
            "zigzag" | "wavy" => MeasuredKind::Wave,
            "opening" | "closing" | "bending" => MeasuredKind::Shape,
            "preparation" => MeasuredKind::Transition,
            _ => return Ok(()),
        };
        let side = body.signing_side(movement.hand);
        let groups = match (side, kind) {
            (BodySide::Right, MeasuredKind::Shape) => [ChannelGroup::RightHand, ChannelGroup::RightArm],
            (BodySide::Left, MeasuredKind::Shape) => [ChannelGroup::LeftHand, ChannelGroup::LeftArm],
            (BodySide::Right, _) => [ChannelGroup::RightArm; 2],
            (BodySide::Left, _) => [ChannelGroup::LeftArm; 2],
        };
        let groups = if groups[0] == groups[1] {
            &groups[..1]
        } else {
            &groups[..]
        };
        let around = TimeSpan::from_span_micros(
            movement.span.span_start_instant().instant_micros() - MEASURED_MARGIN_US,
            movement.span.span_end_instant().instant_micros() + MEASURED_MARGIN_US,
        );
        let (frames, own) = (track.frames_in(around), track.frames_in(movement.span));
        let within: Range<usize> = own.start.saturating_sub(frames.start)..own.end.saturating_sub(frames.start);
        let clip = track.read_motion_clip(connection, frames, groups)?;
        let measurement = measure_hand_movement(&clip, anatomy, side, within, kind);
        let arm = anatomy
            .anatomy_measures()
            .map(|measures| measures.arm)
            .filter(|arm| *arm > 0.0);
        if let (Some(found), Some(arm)) = (measurement, arm)
            // A whole sign with several strokes does not show which of them the entry means.
            && (!movement.sign || found.strokes == 1)
        {
            self.add_measured_movement(body, movement, &found, arm);
        }
        Ok(())
    }

    fn add_measured_movement(
        &mut self,
        body: &MeasuredBody,
        movement: &MeasuredMovement,
        found: &MeasuredStroke,
        arm: f64,
    ) {
        let sized = |names: [&'static str; 3]| match movement.size.as_deref() {
            Some("small") => names[0],
            Some("large") => names[2],
            _ => names[1],
        };
        let time = match movement.kind.as_str() {
            "straight" => {
                // Lengths are shares of the arm, so that bodies of different sizes can be compared.
                self.add_sample_value(sized(MOVEMENT_SIZE_NAMES[0]), body, found.length / arm);
                "time.straight"
            }
            "arc" => {
                self.add_sample_value(sized(MOVEMENT_SIZE_NAMES[0]), body, found.length / arm);
                self.add_sample_value("arc.normal", body, found.depth);
                "time.arc"
            }
            "circle" => {
                self.add_sample_value(sized(MOVEMENT_SIZE_NAMES[1]), body, found.radius / arm);
                "time.circle"
            }
            "zigzag" | "wavy" => {
                self.add_sample_value(sized(MOVEMENT_SIZE_NAMES[0]), body, found.length / arm);
                self.add_sample_value("zigzag.normal", body, found.depth / arm);
                return;
            }
            "preparation" => {
                let usual = BodyLanguage::default_body_language();
                // The time that the path and the turn take by the usual numbers is taken away; the rest is the
                // constant part.
                let path_time = usual.time_transition_arm * found.length / arm;
                let turn = usual.time_turn * found.turn / std::f64::consts::FRAC_PI_2;
                let rest = (found.seconds - path_time - turn).max(LEAST_TRANSITION);
                self.add_sample_value("time.transition", body, rest);
                return;
            }
            _ => "time.replace",
        };
        if movement.plain {
            self.add_sample_value(time, body, found.seconds);
        }
    }

    fn add_sample_value(&mut self, name: &'static str, body: &MeasuredBody, value: f64) {
        // A number that no body language may have comes from a wrong annotation.
        let check_result = BodyLanguage::default_body_language().with_measured([(name, value)]);
        if check_result.is_ok() {
            let of = (body.signer.clone(), value);
            self.0.entry(name).or_default().push(of);
        }
    }

    /// Returns the numbers with enough measurements; the signer's own if these suffice.
    pub(crate) fn sampled_body_language(&self, signer: Option<&str>) -> BodyLanguageChanges {
        let mut values = BTreeMap::new();
        for (name, samples) in &self.0 {
            let signer_samples = samples.iter().filter(|(of, _)| of.is_some() && of.as_deref() == signer);
            let signer_values: Vec<f64> = signer_samples.map(|(_, value)| *value).collect();
            let all = samples.iter().map(|(_, value)| *value).collect();
            let of_signer = summed(signer_values, signer.unwrap_or_default());
            if let Some(value) = of_signer.or_else(|| summed(all, "all captured signers")) {
                values.insert((*name).to_owned(), value);
            }
        }
        MOVEMENT_SIZE_NAMES.iter().for_each(|names| rising(&mut values, names));
        BodyLanguageChanges {
            from: "measured".to_owned(),
            values,
            places: BTreeMap::new(),
        }
    }
}

/// Returns the median and the quartiles; nothing if there are too few values.
fn summed(mut values: Vec<f64>, of: &str) -> Option<LanguageValue> {
    if values.len() < MIN_MEASURED_MOVEMENTS {
        return None;
    }
    values.sort_unstable_by(f64::total_cmp);
    let quantile = |share: f64| {
        let place = share * (values.len() - 1) as f64;
        let (low, high) = (place.floor() as usize, place.ceil() as usize);
        values[low] + (values[high] - values[low]) * place.fract()
    };
    Some(LanguageValue {
        value: quantile(0.5),
        quartiles: Some([quantile(0.25), quantile(0.75)]),
        count: values.len(),
        of: of.to_owned(),
    })
}

/// Scales a small and a big size that are not measured with the usual one, and removes sizes that do not rise from
/// small to big.
fn rising(values: &mut BTreeMap<String, LanguageValue>, names: &[&str; 3]) {
    let usual = |name: &str| BodyLanguage::default_body_language().value(name).unwrap_or_default();
    if let Some(measured) = values.get(names[1]).map(|value| value.value) {
        let grown = measured / usual(names[1]).max(1e-9);
        for name in [names[0], names[2]] {
            let of = format!("as {} is to its usual size", names[1]);
            values.entry(name.to_owned()).or_insert(LanguageValue {
                value: usual(name) * grown,
                quartiles: None,
                count: 0,
                of,
            });
        }
    }
    let now = names.map(|name| values.get(name).map_or(usual(name), |value| value.value));
    if !(now[0] < now[1] && now[1] < now[2]) {
        names.iter().for_each(|name| {
            values.remove(*name);
        });
    }
}

/// Returns the movements annotated on component tiers: their kinds with size and manner, and phases.
fn on_tiers(spans: &[MovementSpan], inventories: &[StoredInventory]) -> Vec<MeasuredMovement> {
    let id = |span: &MovementSpan| -> String {
        let span_inventory = inventories.iter().find(|stored| Some(stored.id) == span.inventory_id);
        let own_value = span_inventory.and_then(|stored| stored.inventory.find_inventory_value(span.value.trim()));
        // A tier without an inventory may still use the usual names.
        let any = || {
            let same = inventories.iter().filter(|stored| {
                stored.inventory.component == SignComponent::Movement && stored.inventory.feature == span.feature
            });
            same.into_iter()
                .find_map(|stored| stored.inventory.find_inventory_value(span.value.trim()))
        };
        own_value
            .or_else(any)
            .map_or(span.value.trim(), |value| value.id.as_str())
            .to_owned()
    };
    let mut movements = Vec::new();
    for (n, span) in spans.iter().enumerate() {
        let kind = match span.feature.as_deref() {
            None => id(span),
            Some("phase") => match id(span).as_str() {
                "hold" => "held".to_owned(),
                "preparation" => "preparation".to_owned(),
                _ => continue,
            },
            _ => continue,
        };
        let overlapping_value = |feature: &str| {
            // Spans come by recording and time: overlapping ones are near each other in the list.
            let earlier_spans = spans[n.saturating_sub(64)..].iter();
            let near = earlier_spans.take_while(|other| {
                other.recording_id < span.recording_id
                    || (other.recording_id == span.recording_id && other.start_us < span.end_us)
            });
            let mut near = near.filter(|other| {
                other.recording_id == span.recording_id
                    && other.hand == span.hand
                    && other.feature.as_deref() == Some(feature)
            });
            // An annotation that shares most of the movement's time describes it.
            let half = (span.end_us - span.start_us) / 2;
            near.find(|other| other.end_us.min(span.end_us) - other.start_us.max(span.start_us) > half)
                .map(&id)
        };
        movements.push(MeasuredMovement {
            recording: span.recording_id,
            span: TimeSpan::from_span_micros(span.start_us, span.end_us),
            hand: span.hand,
            size: overlapping_value("size"),
            plain: overlapping_value("manner").is_none_or(|manner| manner == "plain"),
            kind,
            sign: false,
        });
    }
    movements
}

/// Returns the movements that lexicon entries state for captured tokens without an annotation of movement: only tokens
/// with one movement of one size, performed once, on which all entries of the sign agree.
fn in_lexicon(rows: &[LexiconMovement]) -> Vec<MeasuredMovement> {
    let mut movements = Vec::new();
    for token in rows.chunk_by(|a, b| a.token == b.token) {
        let values_of = |feature: Option<&str>| -> Vec<&str> {
            let feature_rows = token.iter().filter(|row| row.feature.as_deref() == feature);
            let mut values: Vec<&str> = feature_rows.map(|row| row.value.as_str()).collect();
            values.sort_unstable();
            values.dedup();
            values
        };
        let alone = token
            .chunk_by(|a, b| a.entry == b.entry)
            .all(|entry| entry.iter().filter(|row| row.feature.is_none()).count() == 1);
        let (kinds, sizes) = (values_of(None), values_of(Some("size")));
        let once = values_of(Some("repetition")).iter().all(|value| *value == "once");
        // Round and repeated movements have no single stroke whose length could be measured.
        if let ([kind @ ("straight" | "arc")], [] | [_], true, true) = (kinds.as_slice(), sizes.as_slice(), alone, once)
        {
            movements.push(MeasuredMovement {
                recording: token[0].recording_id,
                span: TimeSpan::from_span_micros(token[0].start_us, token[0].end_us),
                hand: Some(AnnotatedHands::One(HandRef::Dominant)),
                kind: (*kind).to_owned(),
                size: sizes.first().map(|size| (*size).to_owned()),
                plain: values_of(Some("manner")).iter().all(|value| *value == "plain"),
                sign: true,
            });
        }
    }
    movements
}

/// The body and the signer of a recording.
struct MeasuredBody {
    recording: i64,
    track: Option<(MotionTrack, BodyAnatomy)>,
    signer: Option<String>,
    handedness: SignerHandedness,
}

impl MeasuredBody {
    fn body_of_recording(connection: &Connection, recording: i64) -> CorpusResult<Self> {
        let row = stored_recordings::load_recording_row(connection, recording)?;
        let signer = match row.signer_id {
            Some(id) => stored_recordings::find_signer_row(connection, id)?,
            None => None,
        };
        let left = signer
            .as_ref()
            .is_some_and(|row| row.handedness.as_deref() == Some("left"));
        let track = match stored_recordings::body_track(connection, recording)? {
            Some(_) => {
                let track = MotionTrack::open_motion_track(connection, recording)?;
                let anatomy = track.track_anatomy(connection)?;
                Some((track, anatomy))
            }
            None => None,
        };
        Ok(Self {
            recording,
            track,
            signer: signer.map(|row| CorpusAddress::Signer(RowName::Text(row.name)).to_string()),
            handedness: if left {
                SignerHandedness::Left
            } else {
                SignerHandedness::Right
            },
        })
    }

    /// Returns the side of the given hand; for both hands that of the dominant one.
    fn signing_side(&self, hand: Option<AnnotatedHands>) -> BodySide {
        let hand = hand.and_then(AnnotatedHands::single_hand);
        hand.unwrap_or(HandRef::Dominant).resolve_hand_ref(self.handedness)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(name: &'static str, values: impl IntoIterator<Item = (u8, f64)>) -> MovementSamples {
        let of = |signer: u8| Some(format!("signer:{}", char::from(b'A' + signer)));
        let all = values.into_iter().map(|(signer, value)| (of(signer), value));
        MovementSamples(BTreeMap::from([(name, all.collect())]))
    }

    #[test]
    fn a_measured_number_needs_eight_movements_and_prefers_those_of_the_signer() {
        let many = |count: usize| samples("time.arc", (0..count).map(|n| (0, 0.5 + 0.01 * n as f64)));
        assert!(many(7).sampled_body_language(None).is_usual());
        let language = many(9).sampled_body_language(None);
        let value = &language.values["time.arc"];
        assert!((value.value - 0.54).abs() < 1e-12);
        let [low, high] = value.quartiles.expect("spread");
        assert!((low - 0.52).abs() < 1e-12 && (high - 0.56).abs() < 1e-12);
        assert_eq!((value.count, value.of.as_str()), (9, "all captured signers"));
        let two = samples("time.arc", (0..16).map(|n| (n / 8, if n < 8 { 0.4 } else { 0.8 })));
        let of = |signer| two.sampled_body_language(signer).values["time.arc"].clone();
        assert_eq!((of(Some("signer:B")).value, of(Some("signer:B")).count), (0.8, 8));
        assert_eq!(of(Some("signer:B")).of, "signer:B");
        assert_eq!(of(Some("signer:C")).count, 16);
    }

    #[test]
    fn sizes_keep_their_order_and_unmarked_ones_scale_with_the_normal_size() {
        let language = samples("move.normal", (0..8).map(|_| (0, 0.5))).sampled_body_language(None);
        assert_eq!(language.values["move.normal"].value, 0.5);
        let big = &language.values["move.big"];
        assert!((big.value - 0.9).abs() < 1e-12 && big.count == 0, "{big:?}");
        assert!(big.of.contains("move.normal"));
        let odd = samples("move.small", (0..8).map(|_| (0, 0.7))).sampled_body_language(None);
        assert!(odd.is_usual(), "smaller than small: {odd:?}");
    }

    #[test]
    fn size_and_manner_are_assigned_to_the_movement_of_the_same_time() {
        let span = |feature: Option<&str>, start_us: i64, end_us: i64, value: &str| MovementSpan {
            recording_id: 1,
            hand: Some(AnnotatedHands::One(HandRef::Right)),
            feature: feature.map(str::to_owned),
            start_us,
            end_us,
            value: value.into(),
            inventory_id: None,
        };
        let movements = on_tiers(
            &[
                span(None, 0, 400, "straight"),
                span(Some("size"), 0, 380, "large"),
                span(Some("phase"), 400, 500, "hold"),
                span(None, 500, 900, "arc"),
                span(Some("manner"), 520, 900, "fast"),
                span(Some("phase"), 500, 900, "stroke"),
            ],
            &[],
        );
        let seen: Vec<_> = movements
            .iter()
            .map(|it| (it.kind.as_str(), it.size.as_deref(), it.plain))
            .collect();
        assert_eq!(
            seen,
            [
                ("straight", Some("large"), true),
                ("held", None, true),
                ("arc", None, false)
            ]
        );
    }

    #[test]
    fn a_token_takes_lexicon_values_only_if_its_entries_agree() {
        let row = |token, entry, feature: Option<&str>, value: &str| LexiconMovement {
            token,
            entry,
            recording_id: 3,
            start_us: 0,
            end_us: 1,
            feature: feature.map(str::to_owned),
            value: value.into(),
        };
        let rows = [
            row(1, 10, None, "straight"),
            row(1, 10, Some("size"), "small"),
            row(1, 11, None, "straight"),
            row(1, 11, Some("size"), "small"),
            row(2, 10, None, "straight"),
            row(2, 11, None, "arc"),
            row(3, 12, None, "straight"),
            row(3, 12, None, "straight"),
            row(4, 13, None, "arc"),
            row(4, 13, Some("repetition"), "several"),
        ];
        let movements = in_lexicon(&rows);
        assert_eq!(movements.len(), 1, "{movements:?}");
        assert_eq!(
            (
                movements[0].kind.as_str(),
                movements[0].size.as_deref(),
                movements[0].sign
            ),
            ("straight", Some("small"), true)
        );
    }
}
