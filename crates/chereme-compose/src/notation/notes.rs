//! What is said about movement made from notation.

use chereme_motion::{Clip, Instant, Side, Span};
use chereme_sign::hamnosys::Notated;
use chereme_sign::{Component, Reading};

use super::plan::{PhaseKind, Plan};
use crate::made::{About, Note};

/// Returns the glosses, the strokes and holds of either hand, and the transitions.
pub(crate) fn notes(signs: &[&Notated], plan: &Plan, sides: [Side; 2], clip: &Clip) -> Vec<Note> {
    let span = |from: f64, to: f64| {
        let span = Span::between(Instant::from_seconds(from), Instant::from_seconds(to));
        span.intersection(clip.span()).unwrap_or(span)
    };
    let mut notes: Vec<Note> = signs
        .iter()
        .zip(&plan.signs)
        .map(|(sign, own)| Note {
            hand: None,
            about: About::Gloss,
            value: Reading::Value(sign.gloss.clone()),
            span: span(own.from, own.to),
            origin: format!("notation of {}", sign.gloss),
        })
        .collect();
    for phase in &plan.phases {
        if phase.to - phase.from < 1e-6 {
            continue;
        }
        let hand = Some(sides[phase.hand]);
        let gloss = plan
            .signs
            .iter()
            .find(|sign| phase.from < sign.to)
            .or(plan.signs.last())
            .map_or("", |sign| sign.gloss.as_str());
        let (about, value) = match phase.kind {
            PhaseKind::Transition => (About::Transition, Reading::Unset),
            PhaseKind::Stroke => (
                About::Component(Component::Movement, Some("stroke".into())),
                Reading::Value(phase.says.clone()),
            ),
            PhaseKind::Hold => (
                About::Component(Component::Movement, Some("hold".into())),
                Reading::Value(if phase.says.is_empty() {
                    "hold".into()
                } else {
                    phase.says.clone()
                }),
            ),
        };
        notes.push(Note {
            hand,
            about,
            value,
            span: span(phase.from, phase.to),
            origin: format!("notation of {gloss}"),
        });
    }
    notes.sort_by_key(|note| (note.span.start(), note.span.end()));
    notes
}
