//! The content of the inspector as lines and texts, without widgets.

use std::collections::BTreeMap;

use chereme_corpus::{RecordingGlance, SignerDetails, TierContents, TokenValue, TrackRow, ValueOpinion};
use chereme_motion::RecordingInstant;
use chereme_sign::SignComponent;

use crate::panes::library::library_data as library;
use crate::panes::timeline::timeline_data::time_text;
use crate::words::{InterfaceText, fill_text_braces, inspector as words};

/// A line: its name and its text.
pub(crate) type InspectorLine = (InterfaceText, String);

/// Returns lines about a recording's movement; missing details are left out.
pub(crate) fn recording_lines(
    it: &RecordingGlance,
    origin: impl Fn(library::RecordingOrigin) -> String,
) -> Vec<InspectorLine> {
    let frames = match it.rate {
        Some(rate) if it.frames > 0 => Some(format!("{} × {:.3} Hz", it.frames, rate.per_second())),
        _ => None,
    };
    [
        (words::ORIGIN, Some(origin(library::displayed_recording_origin(it)))),
        (
            words::DURATION,
            Some(time_text(RecordingInstant::from_micros(it.row.duration_us))),
        ),
        (words::FRAMES, frames),
        (words::TIERS, Some(it.tiers.to_string())),
        (words::TOKENS, Some(it.tokens.to_string())),
    ]
    .into_iter()
    .filter_map(|(text, value)| Some((text, value?)))
    .collect()
}

/// Returns the description of a track: its kind, rate, channels, length and start.
pub(crate) fn track_description(it: &TrackRow, say: impl Fn(InterfaceText) -> String) -> String {
    let kind = say(library::kind_text(it.kind));
    let rate = match it.rate {
        Some(rate) => format!("{:.3} Hz", rate.per_second()),
        None => say(words::TRACK_UNEVEN),
    };
    let length = time_text(RecordingInstant::from_micros(it.duration_us.unwrap_or_default()));
    let start = format!("{:.3} s", it.offset_us as f64 / 1e6);
    let with: [(&str, &dyn std::fmt::Display); 5] = [
        ("kind", &kind),
        ("rate", &rate),
        ("channels", &it.channels),
        ("length", &length),
        ("start", &start),
    ];
    fill_text_braces(&say(words::TRACK), &with)
}

/// Returns how many annotations a tier has, and how many different values.
pub(crate) fn tier_counts(tier: &TierContents) -> (usize, usize) {
    let values: std::collections::BTreeSet<&str> = tier
        .annotations
        .values
        .iter()
        .map(|value| &**value)
        .filter(|value| !value.is_empty())
        .collect();
    (tier.annotations.len(), values.len())
}

/// Returns the measures of a body in centimetres.
pub(crate) fn body_measure_lines(it: &SignerDetails) -> Vec<InspectorLine> {
    let Some(body) = it.measures else {
        return Vec::new();
    };
    [
        (words::STATURE, body.stature),
        (words::SHOULDERS, body.shoulder_width),
        (words::ARM, body.arm),
        (words::HAND_LENGTH, body.hand),
        (words::TRUNK, body.trunk),
        (words::HEAD, body.head),
    ]
    .map(|(text, metres)| (text, format!("{:.1} cm", metres * 100.0)))
    .into()
}

/// Returns the words for a field such as `initial.right.placement`, and the rest of it.
pub(crate) fn field_words(field: &str) -> (Vec<InterfaceText>, Vec<&str>) {
    let (mut texts, mut rest) = (Vec::new(), Vec::new());
    for part in field.split('.') {
        match part {
            "configuration" => texts.push(words::CONFIGURATION),
            "placement" => texts.push(words::PLACEMENT),
            "movement" => texts.push(words::MOVEMENT),
            "orientation" => texts.push(words::ORIENTATION),
            "nonmanual" => texts.push(words::NONMANUAL),
            "right" => texts.push(words::RIGHT),
            "left" => texts.push(words::LEFT),
            "both" => texts.push(words::BOTH),
            "dominant" => texts.push(words::DOMINANT),
            "weak" => texts.push(words::WEAK),
            "initial" => texts.push(words::INITIAL),
            "middle" => texts.push(words::MIDDLE),
            "final" => texts.push(words::FINAL),
            other => rest.push(other),
        }
    }
    // The component comes first, then the hand and the time.
    texts.sort_by_key(|text| {
        let parts = [
            words::CONFIGURATION,
            words::PLACEMENT,
            words::MOVEMENT,
            words::ORIENTATION,
            words::NONMANUAL,
        ];
        !parts.contains(text)
    });
    (texts, rest)
}

/// Returns a length in metres as text with four significant digits.
pub(crate) fn metres_text(length: f64) -> String {
    let before = length.abs().max(1e-9).log10().floor() + 1.0;
    let scale = 10f64.powf((4.0 - before).clamp(0.0, 12.0));
    format!("{} m", (length * scale).round() / scale)
}

/// Reads a time such as `0:01.500`, `1.5` or `1.5 s`.
pub(crate) fn read_time(text: &str) -> Option<RecordingInstant> {
    let text = text.trim().trim_end_matches('s').trim();
    let mut micros = 0.0;
    let mut parts = text.split(':').rev();
    let seconds: f64 = parts.next()?.replace(',', ".").parse().ok()?;
    for (part, scale) in parts.zip([60.0, 3600.0]) {
        let number: u32 = part.parse().ok()?;
        micros += f64::from(number) * scale;
    }
    let micros = (micros + seconds) * 1e6;
    (micros.is_finite() && (0.0..1e15).contains(&micros)).then(|| RecordingInstant::from_micros(micros.round() as i64))
}

/// A row of the coding of a token.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum CodingRow<'a> {
    /// A value that counts.
    Value(&'a TokenValue),
    /// A proposal, or one of the values in dispute.
    Opinion(&'a ValueOpinion),
}

/// Returns the coding of a token by component and hand, each row with its field, such as `initial.right.placement`; the
/// opinions about a field stand below its values.
pub(crate) fn coding_rows<'a>(values: &'a [TokenValue], opinions: &'a [ValueOpinion]) -> Vec<(&'a str, CodingRow<'a>)> {
    let values = values.iter().map(|value| (&*value.field, CodingRow::Value(value)));
    let opinions = opinions
        .iter()
        .map(|opinion| (&*opinion.field, CodingRow::Opinion(opinion)));
    let mut rows: Vec<_> = values.chain(opinions).collect();
    // The phases of a hand keep their order.
    let place = |field: &str| rows.iter().position(|(other, _)| *other == field);
    let rank = |field: &str| {
        let has = |name: &str| field.split('.').any(|part| part == name);
        let component = SignComponent::ALL_COMPONENTS
            .iter()
            .position(|one| has(one.component_name()));
        (component, has("left") || has("weak"), place(field))
    };
    let ranks: BTreeMap<&str, _> = rows.iter().map(|(field, _)| (*field, rank(field))).collect();
    rows.sort_by_key(|(field, _)| ranks[field]);
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_read_as_they_are_shown() {
        for (text, micros) in [
            ("0:01.500", Some(1_500_000)),
            ("1.5", Some(1_500_000)),
            ("1,5 s", Some(1_500_000)),
            ("1:00:02", Some(3_602_000_000)),
            ("x", None),
            ("-1", None),
            ("", None),
        ] {
            assert_eq!(read_time(text).map(RecordingInstant::instant_micros), micros, "{text}");
        }
        let at = RecordingInstant::from_micros(61_234_000);
        assert_eq!(read_time(&time_text(at)), Some(at));
    }

    #[test]
    fn lengths_have_only_significant_digits() {
        for (length, text) in [
            (0.01, "0.01 m"),
            (0.056_444_444_4, "0.05644 m"),
            (1.0, "1 m"),
            (0.0254, "0.0254 m"),
            (12_345.678, "12346 m"),
            (0.0, "0 m"),
        ] {
            assert_eq!(metres_text(length), text);
        }
    }

    #[test]
    fn opinions_stand_at_the_row_of_their_field() {
        let value = |field: &str| TokenValue {
            field: field.to_owned(),
            component: SignComponent::Placement,
            state: chereme_corpus::ValueState::Value,
            value: None,
            inventory: None,
            annotation: None,
            by: Vec::new(),
            confidence: None,
            detector: None,
            proposed: None,
        };
        let opinion = |field: &str| ValueOpinion {
            field: field.to_owned(),
            value: "U".to_owned(),
            standing: chereme_corpus::OpinionStanding::Disputed,
            by: None,
            confidence: None,
            detector: None,
        };
        let values = [
            "movement",
            "final.right.placement",
            "initial.right.placement",
            "left.placement",
        ]
        .map(value);
        let opinions = ["right.configuration", "left.configuration", "initial.right.placement"].map(opinion);
        let rows = coding_rows(&values, &opinions);
        let fields: Vec<&str> = rows.iter().map(|(field, _)| *field).collect();
        let wanted = [
            "right.configuration",
            "left.configuration",
            "final.right.placement",
            "initial.right.placement",
            "initial.right.placement",
            "left.placement",
            "movement",
        ];
        assert_eq!(fields, wanted);
        assert_eq!(rows[3].1, CodingRow::Value(&values[2]));
        assert_eq!(rows[4].1, CodingRow::Opinion(&opinions[2]));
    }

    #[test]
    fn fields_are_named_component_first() {
        let (texts, rest) = field_words("initial.right.placement");
        assert_eq!(texts, [words::PLACEMENT, words::INITIAL, words::RIGHT]);
        assert!(rest.is_empty());
        assert_eq!(field_words("nonmanual.brows").1, ["brows"]);
    }
}
