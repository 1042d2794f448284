//! The detector of strokes of the hands.

use chereme_motion::Side;
use chereme_sign::words::Text;
use chereme_sign::{Component, Field};

use super::{Description, Detection, Detector, Observed, Part};
use crate::strokes::{Mover, strokes};

/// Detector of strokes of the wrists, between two minima of their speed: the phase `stroke` of a hand's movement.
#[derive(Debug, Clone, Copy)]
pub struct Strokes;

/// The confidence of a stroke: minima of speed show that the wrist moves, but not whether it signs.
const STROKE: f64 = 0.5;

impl Detector for Strokes {
    fn name(&self) -> &'static str {
        "strokes"
    }

    fn description(&self) -> &'static Description {
        const WORDS: Description = Description {
            finds: Text::new(
                "strokes of each wrist, between two minima of its speed",
                "mouvements utiles (strokes) de chaque poignet, entre deux minimums de sa vitesse",
            ),
            messages: &[Text::new(
                "the wrist moves between two minima of its speed",
                "le poignet bouge entre deux minimums de sa vitesse",
            )],
        };
        &WORDS
    }

    fn examines(&self) -> &'static [Part] {
        &[Part::Arms]
    }

    fn fields(&self) -> Vec<Field> {
        Side::BOTH.map(field).to_vec()
    }

    fn detect(&self, observed: &Observed<'_>) -> Vec<Detection> {
        let Some(body) = observed.body else {
            return Vec::new();
        };
        let of = |side: Side| {
            let found = strokes(body.clip, body.anatomy, side, Mover::Wrist).into_iter();
            // A stroke begins with the posture in which the one before it ends, so its last frame is not in its span.
            let times = found.map(|frames| body.clip.rate().span(frames.start..frames.end - 1));
            times.map(move |span| Detection {
                span: span.shifted(body.start.micros()),
                field: field(side),
                value: "stroke".to_owned(),
                confidence: STROKE,
                why: "the wrist moves between two minima of its speed".to_owned(),
            })
        };
        Side::BOTH.into_iter().flat_map(of).collect()
    }
}

/// Returns the field of the strokes of a side.
fn field(side: Side) -> Field {
    Field::new(Component::Movement).of("phase").on(side)
}
