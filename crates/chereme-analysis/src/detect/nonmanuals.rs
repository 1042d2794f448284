//! The detector of actions of face and head.

use chereme_motion::{Instant, Span};
use chereme_sign::words::Text;
use chereme_sign::{Component, Field};

use super::{Description, Detection, Detector, Observed, Part};
use crate::nonmanuals::{FEATURES, proposals};

/// Detector of actions of brows, lids, gaze, mouth and head, by the rules of [`nonmanuals`](crate::nonmanuals).
#[derive(Debug, Clone, Copy)]
pub struct Nonmanuals;

impl Detector for Nonmanuals {
    fn name(&self) -> &'static str {
        "nonmanuals"
    }

    fn description(&self) -> &'static Description {
        const WORDS: Description = Description {
            finds: Text::new(
                "actions of brows, lids, gaze, mouth and head, from the curves of the face",
                "actions des sourcils, des paupières, du regard, de la bouche et de la tête, d’après les courbes du visage",
            ),
            messages: &[
                Text::new(
                    "{peak} above the median; {threshold} is enough, for less than {time} s",
                    "{peak} au-dessus de la médiane ; {threshold} suffit, pendant moins de {time} s",
                ),
                Text::new(
                    "{peak} above the median; {threshold} is enough",
                    "{peak} au-dessus de la médiane ; {threshold} suffit",
                ),
                Text::new(
                    "{count} half swings of {mean} degrees; {fewest} of {least} are enough",
                    "{count} demi-balancements de {mean} degrés ; {fewest} de {least} suffisent",
                ),
            ],
        };
        &WORDS
    }

    fn examines(&self) -> &'static [Part] {
        &[Part::Face]
    }

    fn fields(&self) -> Vec<Field> {
        FEATURES.map(field).to_vec()
    }

    fn detect(&self, observed: &Observed<'_>) -> Vec<Detection> {
        let Some(curves) = &observed.face else {
            return Vec::new();
        };
        let at = |frame: usize| Instant::from_seconds(frame as f64 / curves.rate);
        let found = proposals(curves).into_iter();
        found
            .map(|it| Detection {
                span: Span::between(at(it.frames.start), at(it.frames.end)),
                field: field(it.feature),
                value: it.value.to_owned(),
                confidence: it.confidence,
                why: it.why,
            })
            .collect()
    }
}

/// Returns the field of a part of face or head.
fn field(feature: &str) -> Field {
    Field::new(Component::NonManual).of(feature)
}
