//! The texts of the lists of recordings and signs, without widgets.

use std::collections::{BTreeMap, BTreeSet};

use chereme_corpus::{CorpusOverview, PersonContents, RecordOrigin, RecordingGlance, SignGlance, TrackKind};
use chereme_motion::{RecordingInstant, TimeSpan};
use chereme_sign::text::fold_text;

use super::super::timeline::timeline_data::time_text;
use crate::words::{InterfaceLanguage, InterfaceText, fill_text_braces, library as words};

/// A recording as a row of the list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct LibraryRow {
    pub(crate) id: i64,
    pub(crate) name: String,
    /// Signer, origin and duration.
    pub(crate) about: String,
    /// Its whole span, and whether it has movement or a film.
    pub(crate) whole: TimeSpan,
    pub(crate) moves: bool,
    /// Whether it has a track of markers.
    pub(crate) has_markers: bool,
}

/// Returns the recordings whose name or signer contains `filter`, ignoring case and accents.
pub(crate) fn library_recording_rows(
    recordings: &[RecordingGlance],
    filter: &str,
    origin: impl Fn(RecordingOrigin) -> String,
    kind: impl Fn(TrackKind) -> String,
) -> Vec<LibraryRow> {
    let wanted = fold_text(filter.trim());
    let fits = |glance: &&RecordingGlance| {
        wanted.is_empty()
            || fold_text(&glance.row.name).contains(&wanted)
            || glance
                .row
                .signer
                .as_deref()
                .is_some_and(|signer| fold_text(signer).contains(&wanted))
    };
    let row = |glance: &RecordingGlance| {
        let parts = [
            glance.row.signer.clone(),
            Some(origin(displayed_recording_origin(glance))),
            Some(time_text(RecordingInstant::from_micros(glance.row.duration_us))),
            other_track_names(glance, &kind),
        ];
        LibraryRow {
            id: glance.row.id,
            name: glance.row.name.clone(),
            about: parts.into_iter().flatten().collect::<Vec<_>>().join(" · "),
            whole: TimeSpan::span_between(
                RecordingInstant::RECORDING_START,
                RecordingInstant::from_micros(glance.row.duration_us),
            ),
            moves: glance.shown_frames().is_some() || glance.kinds.contains(&TrackKind::Media),
            has_markers: has_markers(glance),
        }
    };
    recordings.iter().filter(fits).map(row).collect()
}

/// A person as a row of the list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct LibraryPersonRow {
    pub(crate) id: i64,
    pub(crate) name: String,
    /// The roles with their numbers, then the attributes.
    pub(crate) about: String,
}

/// Returns the people with a name or an attribute that contains `filter`, ignoring case and accents.
pub(crate) fn library_person_rows(
    overview: &CorpusOverview,
    filter: &str,
    language: InterfaceLanguage,
) -> Vec<LibraryPersonRow> {
    let wanted = fold_text(filter.trim());
    let row = |person: &PersonContents| {
        let roles = [
            (words::SIGNS_IN, person.recordings),
            (words::TAKES_PART, person.participant_tiers),
            (words::ANNOTATES, person.annotator_tiers),
        ];
        let roles = roles.into_iter().filter(|(_, n)| *n > 0);
        let roles = roles.map(|(text, n)| fill_text_braces(text.text_in_language(language), &[("n", &n)]));
        let is_preferred = overview.preferred_annotator.as_ref() == Some(&person.name);
        let counts_first = is_preferred.then(|| words::PREFERRED.text_in_language(language).to_owned());
        let attributes = person.attributes.iter();
        let said = attributes.map(|attribute| format!("{}={}", attribute.name, attribute.text));
        LibraryPersonRow {
            id: person.id,
            name: person.name.clone(),
            about: roles.chain(counts_first).chain(said).collect::<Vec<_>>().join(" · "),
        }
    };
    let fits = |(person, row): &(&PersonContents, LibraryPersonRow)| {
        let mut texts = person.aliases.iter().chain([&row.name, &row.about]);
        texts.any(|text| fold_text(text).contains(&wanted))
    };
    overview
        .people
        .iter()
        .map(|person| (person, row(person)))
        .filter(fits)
        .map(|(_, row)| row)
        .collect()
}

/// Returns whether a recording has a track of markers.
pub(crate) fn has_markers(glance: &RecordingGlance) -> bool {
    glance.kinds.contains(&TrackKind::Markers)
}

/// Returns the name of a kind of track.
pub(crate) fn kind_text(kind: TrackKind) -> InterfaceText {
    match kind {
        TrackKind::Skeleton => words::SKELETON,
        TrackKind::Markers => words::MARKERS,
        TrackKind::Curves => words::CURVES,
        TrackKind::Media => words::FILM,
    }
}

/// Returns the names of the track kinds other than skeletal movement; `None` if it has no others.
fn other_track_names(glance: &RecordingGlance, kind: impl Fn(TrackKind) -> String) -> Option<String> {
    let other_kinds = glance
        .kinds
        .iter()
        .filter(|track_kind| **track_kind != TrackKind::Skeleton);
    let names: Vec<String> = other_kinds.map(|track_kind| kind(*track_kind)).collect();
    (!names.is_empty()).then(|| names.join(", "))
}

/// The displayed origin of a recording.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum RecordingOrigin {
    /// The origin that the corpus stores.
    Stored(RecordOrigin),
    /// No captured data: the recording was only annotated.
    Annotated,
}

impl RecordingOrigin {
    /// Returns the name of the source.
    pub(crate) fn recording_origin_text(self) -> InterfaceText {
        match self {
            Self::Stored(origin) => origin_text(origin),
            Self::Annotated => words::ANNOTATED,
        }
    }
}

/// Returns the displayed origin of a recording.
pub(crate) fn displayed_recording_origin(it: &RecordingGlance) -> RecordingOrigin {
    let measured = it.frames > 0 || it.kinds.iter().any(|kind| *kind != TrackKind::Media);
    match it.row.origin {
        RecordOrigin::Captured if !measured => RecordingOrigin::Annotated,
        origin => RecordingOrigin::Stored(origin),
    }
}

/// Returns the name of an origin.
pub(crate) fn origin_text(origin: RecordOrigin) -> InterfaceText {
    match origin {
        RecordOrigin::Captured => words::CAPTURED,
        RecordOrigin::Made => words::MADE,
        RecordOrigin::Generated => words::GENERATED,
        RecordOrigin::Lexicon => words::IN_LEXICON,
    }
}

/// Returns the name of an origin, given its name in queries.
pub(crate) fn origin_named(name: &str) -> Option<InterfaceText> {
    RecordOrigin::of_name(name).map(origin_text)
}

/// The movement of a sign, if there is any.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SignMovement {
    /// The citation form has movement, in that recording and span.
    Recorded(i64, TimeSpan),
    /// The sign has a notation, and can be animated.
    Notated,
    /// The sign is coded, or only named.
    Not,
}

impl SignMovement {
    /// Returns the movement of a sign.
    pub(crate) fn movement_of_sign(sign: &SignGlance) -> Self {
        match sign.place {
            Some((recording, span)) => Self::Recorded(recording, span),
            None if sign.notated => Self::Notated,
            None => Self::Not,
        }
    }
}

/// A sign as a row of the list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct LibrarySignRow {
    pub(crate) id: i64,
    pub(crate) gloss: String,
    /// The number of tokens, and the origin of the citation form.
    pub(crate) about: String,
    /// The token of its citation form.
    pub(crate) token: Option<i64>,
    pub(crate) moves: SignMovement,
}

/// Returns the signs whose gloss contains `filter`, ignoring case and accents.
pub(crate) fn library_sign_rows(
    signs: &[SignGlance],
    recordings: &[RecordingGlance],
    filter: &str,
    language: InterfaceLanguage,
) -> Vec<LibrarySignRow> {
    let origins: BTreeMap<i64, RecordOrigin> = recordings
        .iter()
        .map(|glance| (glance.row.id, glance.row.origin))
        .collect();
    let origin = |sign: &SignGlance| origins.get(&sign.place?.0).copied();
    let wanted = fold_text(filter.trim());
    let fits = |sign: &&SignGlance| wanted.is_empty() || fold_text(&sign.gloss).contains(&wanted);
    let lexicons: BTreeSet<&String> = signs.iter().filter_map(|sign| sign.lexicon.as_ref()).collect();
    let about = |sign: &SignGlance| {
        let text = describe_sign_origin(sign, origin(sign), language);
        match &sign.lexicon {
            Some(lexicon) if lexicons.len() > 1 => format!("{lexicon} · {text}"),
            _ => text,
        }
    };
    let row = |sign: &SignGlance| LibrarySignRow {
        id: sign.id,
        gloss: sign.gloss.clone(),
        about: about(sign),
        token: sign.citation,
        moves: SignMovement::movement_of_sign(sign),
    };
    signs.iter().filter(fits).map(row).collect()
}

/// Returns the text about a sign's origin and its number of tokens.
pub(crate) fn describe_sign_origin(
    sign: &SignGlance,
    origin: Option<RecordOrigin>,
    language: InterfaceLanguage,
) -> String {
    let state_text = match SignMovement::movement_of_sign(sign) {
        // A generated recording was not captured.
        SignMovement::Recorded(..) => origin
            .filter(|origin| *origin != RecordOrigin::Captured)
            .map_or(words::RECORDED, origin_text),
        SignMovement::Notated => words::NOTATED,
        SignMovement::Not => words::IN_LEXICON,
    };
    let what = state_text.text_in_language(language);
    if sign.tokens < 2 {
        return what.to_owned();
    }
    let count = crate::words::fill_text_braces(words::TOKENS.text_in_language(language), &[("n", &sign.tokens)]);
    format!("{what} · {count}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_corpus::RecordingRow;

    fn glance(id: i64, name: &str, signer: Option<&str>) -> RecordingGlance {
        let row = RecordingRow {
            id,
            name: name.into(),
            signer_id: None,
            signer: signer.map(str::to_owned),
            origin: RecordOrigin::Made,
            duration_us: 1_500_000,
            licence: None,
            notes: None,
        };
        RecordingGlance {
            row,
            frames: 1,
            rate: None,
            offset_us: 0,
            kinds: vec![TrackKind::Skeleton, TrackKind::Markers],
            tiers: 0,
            tokens: 0,
            recipe: None,
            face_alone: None,
        }
    }

    #[test]
    fn recordings_are_filtered_by_name_and_signer_whatever_the_accents() {
        let all = [
            glance(1, "Écureuil", None),
            glance(2, "bol", Some("Zoé")),
            glance(3, "chat", None),
        ];
        let name = |kind: TrackKind| kind.track_kind_name().to_owned();
        let said = |source: RecordingOrigin| format!("{source:?}");
        let ids = |filter: &str| -> Vec<i64> {
            library_recording_rows(&all, filter, said, name)
                .iter()
                .map(|row| row.id)
                .collect()
        };
        assert_eq!(ids(""), [1, 2, 3]);
        assert_eq!(ids("ecu"), [1]);
        assert_eq!(ids(" ZOE "), [2]);
        assert_eq!(
            library_recording_rows(&all, "bol", said, name)[0].about,
            "Zoé · Stored(Made) · 0:01.500 · markers"
        );
    }

    #[test]
    fn a_generated_sign_is_not_listed_as_recorded() {
        let span = TimeSpan::span_between(RecordingInstant::RECORDING_START, RecordingInstant::from_micros(9));
        let sign = SignGlance {
            gloss: "LIMACE".into(),
            tokens: 1,
            place: Some((1, span)),
            ..SignGlance::default()
        };
        let mut recording = glance(1, "LIMACE", None);
        for (origin, english, french) in [
            (RecordOrigin::Made, "synthesised", "composé"),
            (RecordOrigin::Generated, "generated", "produit"),
            (RecordOrigin::Captured, "recorded", "enregistré"),
        ] {
            recording.row.origin = origin;
            let about = |language| {
                let rows = library_sign_rows(
                    std::slice::from_ref(&sign),
                    std::slice::from_ref(&recording),
                    "",
                    language,
                );
                rows[0].about.clone()
            };
            assert_eq!(about(InterfaceLanguage::English), english);
            assert_eq!(about(InterfaceLanguage::French), french);
        }
    }

    #[test]
    fn signs_show_whether_they_have_movement_or_notation() {
        let sign = |gloss: &str, tokens, citation| SignGlance {
            gloss: gloss.into(),
            tokens,
            citation,
            ..SignGlance::default()
        };
        let span = TimeSpan::span_between(RecordingInstant::RECORDING_START, RecordingInstant::from_micros(9));
        let all = [
            SignGlance {
                place: Some((4, span)),
                ..sign("BOL", 3, Some(1))
            },
            SignGlance {
                notated: true,
                ..sign("ZÉRO", 1, Some(2))
            },
            sign("rien", 0, None),
        ];
        let shown = library_sign_rows(&all, &[], "", InterfaceLanguage::English);
        let moves: Vec<SignMovement> = shown.iter().map(|row| row.moves).collect();
        assert_eq!(
            moves,
            [
                SignMovement::Recorded(4, span),
                SignMovement::Notated,
                SignMovement::Not
            ]
        );
        assert_eq!(shown[0].about, "recorded · tokens: 3");
        assert_eq!(
            library_sign_rows(&all, &[], "zer", InterfaceLanguage::French)[0].token,
            Some(2)
        );
        assert!(library_sign_rows(&all, &[], "none", InterfaceLanguage::French).is_empty());
    }
}
