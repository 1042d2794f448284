//! What is said about movement made from notation.

use std::sync::LazyLock;

use chereme_motion::{Clip, Instant, Side, Span};
use chereme_sign::component::{HandRef, Phase};
use chereme_sign::hamnosys::Notated;
use chereme_sign::hamnosys::components::{MappedValue, Mapper};
use chereme_sign::{Component, Reading, inventory};

use super::plan::{PhaseKind, Plan};
use crate::made::{About, Note};

/// Returns the glosses, the component values, the strokes and holds of either hand, and the transitions.
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
            value: Reading::Value(name(sign).to_owned()),
            span: span(own.from, own.to),
            origin: format!("notation of {}", name(sign)),
        })
        .collect();
    for (sign, own) in signs.iter().zip(&plan.signs) {
        for (value, share) in components(sign) {
            let at = |part: f64| own.from + (own.to - own.from) * part;
            notes.push(Note {
                hand: value.field.hand.map(|hand| match hand {
                    HandRef::Right => Side::Right,
                    HandRef::Left => Side::Left,
                    HandRef::Dominant => sides[0],
                    HandRef::Weak => sides[1],
                }),
                about: About::Component(value.field.component, value.field.feature),
                value: Reading::Value(value.value),
                span: span(at(share.0), at(share.1)),
                origin: format!("notation of {}", name(sign)),
            });
        }
    }
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
        let phase_of = |name: &str| {
            let about = About::Component(Component::Movement, Some("phase".into()));
            (about, Reading::Value(name.into()))
        };
        let (about, value) = match phase.kind {
            PhaseKind::Transition => (About::Transition, Reading::Unset),
            PhaseKind::Stroke => phase_of("stroke"),
            PhaseKind::Hold => phase_of("hold"),
        };
        notes.push(Note {
            hand,
            about,
            value,
            span: span(phase.from, phase.to),
            origin: format!("notation of {gloss}: {}", phase.says)
                .trim_end_matches([':', ' '])
                .to_owned(),
        });
    }
    notes.sort_by_key(|note| (note.span.start(), note.span.end()));
    notes
}

fn name(sign: &Notated) -> &str {
    if sign.gloss.is_empty() {
        "notation"
    } else {
        &sign.gloss
    }
}

/// Returns what a sign has in each component, each with the share of the sign's time that it holds:
/// successive values share it evenly.
fn components(sign: &Notated) -> Vec<(MappedValue, (f64, f64))> {
    static MAPPER: LazyLock<Mapper<'static>> = LazyLock::new(|| Mapper::new(inventory::builtin()));
    let values = MAPPER.map(sign).values;
    let last = |of: &MappedValue| {
        let same = values.iter().filter(|it| {
            let (a, b) = (&it.field, &of.field);
            (a.hand, a.component, &a.feature) == (b.hand, b.component, &b.feature)
        });
        same.filter(|it| it.field.phase.is_some()).count()
    };
    let shares: Vec<(f64, f64)> = values
        .iter()
        .map(|value| {
            let steps = last(value).max(1);
            let at = match value.field.phase {
                None => return (0.0, 1.0),
                Some(Phase::Initial) => 0,
                Some(Phase::Middle(n)) => usize::from(n).min(steps - 1),
                Some(Phase::Final) => steps - 1,
            };
            (at as f64 / steps as f64, (at + 1) as f64 / steps as f64)
        })
        .collect();
    values.into_iter().zip(shares).collect()
}
