//! The window's data about the corpus: an immutable snapshot, and the movement on the stage.

pub(crate) mod display_state;
pub(crate) mod generated;
pub(crate) mod model_handle;
pub(crate) mod reel;
pub(crate) mod time_window;

use std::collections::HashMap;
use std::sync::Arc;

use chereme_corpus::{CorpusOverview, RecordingContents, RecordingGlance, TierContents};
use chereme_motion::TimeSpan;

/// The corpus at one moment, with the annotations of the open recording.
#[derive(Debug, Clone, Default)]
pub(crate) struct CorpusSnapshot {
    pub(crate) overview: Arc<CorpusOverview>,
    pub(crate) open: Option<Arc<OpenedRecording>>,
}

/// The annotations of a recording, with an index.
#[derive(Debug)]
pub(crate) struct OpenedRecording {
    pub(crate) contents: RecordingContents,
    /// For every annotation id, the index of its tier and its index in the tier's columns.
    places: HashMap<i64, (usize, usize)>,
}

impl OpenedRecording {
    pub(crate) fn new(contents: RecordingContents) -> Self {
        let mut places = HashMap::new();
        for (tier, it) in contents.tiers.iter().enumerate() {
            let ids = it.annotations.ids.iter().enumerate();
            places.extend(ids.map(|(at, id)| (*id, (tier, at))));
        }
        Self { contents, places }
    }
}

/// An annotation in a snapshot.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FoundAnnotation<'a> {
    pub(crate) tier: &'a TierContents,
    /// Index in the tier's columns.
    pub(crate) at: usize,
}

/// Something that the inspector can show.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum InspectedThing {
    Token(i64),
    Sign(i64),
    Signer(i64),
    Recording(i64),
    /// A value of the inventory with that row id.
    Value(i64, String),
}

/// The sign of a token.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct TokenSign {
    pub(crate) gloss: String,
    /// The recording with its movement, and the span there.
    pub(crate) place: Option<(i64, TimeSpan)>,
}

impl CorpusSnapshot {
    /// Returns whether the corpus is read-only.
    pub(crate) fn is_read_only(&self) -> bool {
        self.overview.read_only
    }

    /// Returns the recording with that row id.
    pub(crate) fn recording_glance(&self, id: i64) -> Option<&RecordingGlance> {
        self.overview.recordings.iter().find(|glance| glance.row.id == id)
    }

    /// Returns the recording of that name.
    pub(crate) fn recording_named(&self, name: &str) -> Option<&RecordingGlance> {
        self.overview.recordings.iter().find(|glance| glance.row.name == name)
    }

    /// Returns the sign of a token, if the token is a citation form or in the open recording.
    pub(crate) fn known_token_sign(&self, id: i64) -> Option<TokenSign> {
        let signs = self.overview.signs.iter();
        // Citation forms are known without opening their recording.
        if let Some(sign) = signs.into_iter().find(|sign| sign.citation == Some(id)) {
            return Some(TokenSign {
                gloss: sign.gloss.clone(),
                place: sign.place,
            });
        }
        let tokens = &self.open.as_deref()?.contents.tokens;
        let token = tokens.iter().find(|token| token.id == id)?;
        let (start, end) = token.start_us.zip(token.end_us)?;
        let span = TimeSpan::from_span_micros(start, end);
        Some(TokenSign {
            gloss: token.gloss.clone(),
            place: token.recording_id.map(|recording| (recording, span)),
        })
    }

    /// Returns a text with the glosses of known tokens in place of their numbers.
    pub(crate) fn name_tokens_in_text(&self, text: &str) -> String {
        const TOKEN_NUMBER_PREFIX: &str = "token:";
        let mut named = String::with_capacity(text.len());
        let mut rest = text;
        while let Some((before, after)) = rest.split_once(TOKEN_NUMBER_PREFIX) {
            named.push_str(before);
            let digits = after.len() - after.trim_start_matches(|c: char| c.is_ascii_digit()).len();
            let (number, after) = after.split_at(digits);
            match number.parse().ok().and_then(|id| self.known_token_sign(id)) {
                Some(known) => named.push_str(&known.gloss),
                None => named.extend([TOKEN_NUMBER_PREFIX, number]),
            }
            rest = after;
        }
        named + rest
    }

    /// Returns the recipe and the name of a recording that was made from a recipe.
    pub(crate) fn recipe_of(&self, recording: i64) -> Option<(String, String)> {
        let it = self.recording_glance(recording)?;
        Some((it.recipe.clone()?, it.row.name.clone()))
    }

    /// Returns whether the sign of that gloss has a notation.
    pub(crate) fn is_notated(&self, gloss: &str) -> bool {
        let signs = &self.overview.signs;
        let position = signs.binary_search_by(|sign| sign.gloss.as_str().cmp(gloss));
        position.is_ok_and(|at| signs[at].notated)
    }

    /// Returns the annotations of a recording, if it is the open one.
    pub(crate) fn recording_contents(&self, recording: i64) -> Option<&RecordingContents> {
        let contents = &self.open.as_deref()?.contents;
        (contents.recording.id == recording).then_some(contents)
    }

    /// Returns the annotations of a recording, or those of its predecessor while it is read, so that what shows them
    /// keeps its place.
    pub(crate) fn contents_or_before(&self, recording: Option<i64>) -> Option<&RecordingContents> {
        recording.and(self.open.as_deref()).map(|opened| &opened.contents)
    }

    /// Returns the annotation with that row id, if it is in the open recording.
    pub(crate) fn find_open_annotation(&self, id: i64) -> Option<FoundAnnotation<'_>> {
        let open = self.open.as_deref()?;
        let (tier, at) = *open.places.get(&id)?;
        Some(FoundAnnotation {
            tier: &open.contents.tiers[tier],
            at,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_corpus::{CorpusOverview, SignGlance};

    #[test]
    fn texts_name_tokens_by_their_glosses() {
        let sign = SignGlance {
            gloss: "AIMER".into(),
            citation: Some(15),
            ..SignGlance::default()
        };
        let snapshot = CorpusSnapshot {
            overview: Arc::new(CorpusOverview {
                signs: vec![sign],
                ..CorpusOverview::default()
            }),
            open: None,
        };
        for (text, wanted) in [
            ("token:15 (same signer)", "AIMER (same signer)"),
            ("token:15 → token:150", "AIMER → token:150"),
            ("token: nothing", "token: nothing"),
            ("", ""),
        ] {
            assert_eq!(snapshot.name_tokens_in_text(text), wanted);
        }
    }

    #[test]
    fn the_recording_before_stays_while_another_one_is_read() {
        let contents = crate::panes::timeline::contents_of(&[(1, 0, 10)]);
        let own = contents.recording.id;
        let snapshot = CorpusSnapshot {
            open: Some(Arc::new(OpenedRecording::new(contents))),
            ..CorpusSnapshot::default()
        };
        let kept = |recording| {
            let kept = snapshot.contents_or_before(recording);
            kept.map(|it| it.recording.id)
        };
        assert!(snapshot.recording_contents(own + 1).is_none());
        assert_eq!(kept(Some(own + 1)), Some(own));
        assert_eq!(kept(Some(own)), Some(own));
        assert_eq!(kept(None), None, "no recording is shown");
    }
}
