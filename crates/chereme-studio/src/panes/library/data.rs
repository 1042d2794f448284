//! The texts of the lists of recordings and signs, without widgets.

use std::collections::BTreeMap;

use chereme_corpus::{Origin, RecordingGlance, SignGlance, TrackKind};
use chereme_motion::{Instant, Span};
use chereme_sign::text::fold;

use super::super::timeline::data::time_text;
use crate::words::{Language, Text, library as words};

/// A recording as a row of the list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct LibraryRow {
    pub(crate) id: i64,
    pub(crate) name: String,
    /// Signer, origin and duration.
    pub(crate) about: String,
    /// Its whole span, and whether it has movement or a film.
    pub(crate) whole: Span,
    pub(crate) moves: bool,
    /// Whether it has a track of markers.
    pub(crate) has_markers: bool,
}

/// Returns the recordings whose name or signer contains `filter`, ignoring case and accents.
pub(crate) fn rows(
    recordings: &[RecordingGlance],
    filter: &str,
    origin: impl Fn(Source) -> String,
    kind: impl Fn(TrackKind) -> String,
) -> Vec<LibraryRow> {
    let wanted = fold(filter.trim());
    let fits = |it: &&RecordingGlance| {
        wanted.is_empty()
            || fold(&it.row.name).contains(&wanted)
            || it
                .row
                .signer
                .as_deref()
                .is_some_and(|signer| fold(signer).contains(&wanted))
    };
    let row = |it: &RecordingGlance| {
        let parts = [
            it.row.signer.clone(),
            Some(origin(source(it))),
            Some(time_text(Instant::from_micros(it.row.duration_us))),
            others(it, &kind),
        ];
        LibraryRow {
            id: it.row.id,
            name: it.row.name.clone(),
            about: parts.into_iter().flatten().collect::<Vec<_>>().join(" · "),
            whole: Span::between(Instant::ZERO, Instant::from_micros(it.row.duration_us)),
            moves: it.shown().is_some() || it.kinds.contains(&TrackKind::Media),
            has_markers: has_markers(it),
        }
    };
    recordings.iter().filter(fits).map(row).collect()
}

/// Returns whether a recording has a track of markers.
pub(crate) fn has_markers(glance: &RecordingGlance) -> bool {
    glance.kinds.contains(&TrackKind::Markers)
}

/// Returns the name of a kind of track.
pub(crate) fn kind_text(kind: TrackKind) -> Text {
    match kind {
        TrackKind::Skeleton => words::SKELETON,
        TrackKind::Markers => words::MARKERS,
        TrackKind::Curves => words::CURVES,
        TrackKind::Media => words::FILM,
    }
}

/// Returns the names of the track kinds other than skeletal movement; `None` if it has no others.
fn others(glance: &RecordingGlance, kind: impl Fn(TrackKind) -> String) -> Option<String> {
    let own = glance.kinds.iter().filter(|it| **it != TrackKind::Skeleton);
    let names: Vec<String> = own.map(|it| kind(*it)).collect();
    (!names.is_empty()).then(|| names.join(", "))
}

/// The displayed origin of a recording.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Source {
    /// The origin that the corpus stores.
    Stored(Origin),
    /// No captured data: the recording was only annotated.
    Annotated,
}

impl Source {
    /// Returns the name of the source.
    pub(crate) fn text(self) -> Text {
        match self {
            Self::Stored(origin) => origin_text(origin),
            Self::Annotated => words::ANNOTATED,
        }
    }
}

/// Returns the displayed origin of a recording.
pub(crate) fn source(it: &RecordingGlance) -> Source {
    let measured = it.frames > 0 || it.kinds.iter().any(|kind| *kind != TrackKind::Media);
    match it.row.origin {
        Origin::Captured if !measured => Source::Annotated,
        origin => Source::Stored(origin),
    }
}

/// Returns the name of an origin.
pub(crate) fn origin_text(origin: Origin) -> Text {
    match origin {
        Origin::Captured => words::CAPTURED,
        Origin::Made => words::MADE,
        Origin::Generated => words::GENERATED,
        Origin::Lexicon => words::IN_LEXICON,
    }
}

/// Returns the name of an origin, given its name in queries.
pub(crate) fn origin_named(name: &str) -> Option<Text> {
    Origin::of_name(name).map(origin_text)
}

/// The movement of a sign, if there is any.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Moves {
    /// The citation form has movement, in that recording and span.
    Recorded(i64, Span),
    /// The sign has a notation, and can be animated.
    Notated,
    /// The sign is coded, or only named.
    Not,
}

impl Moves {
    /// Returns the movement of a sign.
    pub(crate) fn of(sign: &SignGlance) -> Self {
        match sign.place {
            Some((recording, span)) => Self::Recorded(recording, span),
            None if sign.notated => Self::Notated,
            None => Self::Not,
        }
    }
}

/// A sign as a row of the list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct SignRow {
    pub(crate) gloss: String,
    /// The number of tokens, and the origin of the citation form.
    pub(crate) about: String,
    /// The token of its citation form.
    pub(crate) token: Option<i64>,
    pub(crate) moves: Moves,
}

/// Returns the signs whose gloss contains `filter`, ignoring case and accents.
pub(crate) fn signs(
    signs: &[SignGlance],
    recordings: &[RecordingGlance],
    filter: &str,
    language: Language,
) -> Vec<SignRow> {
    let origins: BTreeMap<i64, Origin> = recordings
        .iter()
        .map(|it| (it.row.id, it.row.origin))
        .collect();
    let origin = |it: &SignGlance| origins.get(&it.place?.0).copied();
    let wanted = fold(filter.trim());
    let fits = |it: &&SignGlance| wanted.is_empty() || fold(&it.gloss).contains(&wanted);
    let row = |it: &SignGlance| SignRow {
        gloss: it.gloss.clone(),
        about: about(it, origin(it), language),
        token: it.citation,
        moves: Moves::of(it),
    };
    signs.iter().filter(fits).map(row).collect()
}

/// Returns the text about a sign's origin and its number of tokens.
pub(crate) fn about(sign: &SignGlance, origin: Option<Origin>, language: Language) -> String {
    let what = match Moves::of(sign) {
        // A generated recording was not captured.
        Moves::Recorded(..) => origin
            .filter(|it| *it != Origin::Captured)
            .map_or(words::RECORDED, origin_text),
        Moves::Notated => words::NOTATED,
        Moves::Not => words::IN_LEXICON,
    };
    let what = what.of(language);
    if sign.tokens < 2 {
        return what.to_owned();
    }
    let count = crate::words::fill(words::TOKENS.of(language), &[("n", &sign.tokens)]);
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
            origin: Origin::Made,
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
        let name = |kind: TrackKind| kind.name().to_owned();
        let said = |source: Source| format!("{source:?}");
        let ids = |filter: &str| -> Vec<i64> {
            rows(&all, filter, said, name)
                .iter()
                .map(|row| row.id)
                .collect()
        };
        assert_eq!(ids(""), [1, 2, 3]);
        assert_eq!(ids("ecu"), [1]);
        assert_eq!(ids(" ZOE "), [2]);
        assert_eq!(
            rows(&all, "bol", said, name)[0].about,
            "Zoé · Stored(Made) · 0:01.500 · markers"
        );
    }

    #[test]
    fn a_generated_sign_is_not_listed_as_recorded() {
        let span = Span::between(Instant::ZERO, Instant::from_micros(9));
        let sign = SignGlance {
            gloss: "LIMACE".into(),
            tokens: 1,
            place: Some((1, span)),
            ..SignGlance::default()
        };
        let mut recording = glance(1, "LIMACE", None);
        for (origin, english, french) in [
            (Origin::Made, "synthesised", "composé"),
            (Origin::Generated, "generated", "produit"),
            (Origin::Captured, "recorded", "enregistré"),
        ] {
            recording.row.origin = origin;
            let about = |language| {
                let rows = signs(
                    std::slice::from_ref(&sign),
                    std::slice::from_ref(&recording),
                    "",
                    language,
                );
                rows[0].about.clone()
            };
            assert_eq!(about(Language::English), english);
            assert_eq!(about(Language::French), french);
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
        let span = Span::between(Instant::ZERO, Instant::from_micros(9));
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
        let shown = signs(&all, &[], "", Language::English);
        let moves: Vec<Moves> = shown.iter().map(|row| row.moves).collect();
        assert_eq!(
            moves,
            [Moves::Recorded(4, span), Moves::Notated, Moves::Not]
        );
        assert_eq!(shown[0].about, "recorded · tokens: 3");
        assert_eq!(signs(&all, &[], "zer", Language::French)[0].token, Some(2));
        assert!(signs(&all, &[], "none", Language::French).is_empty());
    }
}
