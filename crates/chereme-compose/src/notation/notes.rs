//! Annotations and remarks about synthesised movement.

use std::sync::LazyLock;

use chereme_motion::{BodySide, Clip, RecordingInstant, TimeSpan};
use chereme_sign::component::{HandRef, SignPhase};
use chereme_sign::hamnosys::NotatedSign;
use chereme_sign::hamnosys::components::{MappedValue, SignMapper};
use chereme_sign::{ComponentReading, SignComponent, inventory};

use super::notation_plan::{HandAct, PhaseKind, SignPlan, SignSpan};
use super::stretch_time::TimeWarp;
use crate::outcome::{GeneratedNote, NoteSubject};

/// Shortest annotation (s) of a value that the hand has only momentarily.
const MIN_ANNOTATION_S: f64 = 0.04;

/// Returns the glosses, the component values, the strokes and holds of each hand, and the transitions. All
/// times in `plan` are stretched already, except those of its events; `stretch_time` stretches those.
pub(crate) fn write_sign_notes(
    signs: &[&NotatedSign],
    plan: &SignPlan,
    sides: [BodySide; 2],
    clip: &Clip,
    warp: &TimeWarp,
) -> Vec<GeneratedNote> {
    let span = |from: f64, to: f64| {
        let span = TimeSpan::span_between(RecordingInstant::from_seconds(from), RecordingInstant::from_seconds(to));
        span.span_intersection(clip.clip_span()).unwrap_or(span)
    };
    let mut notes: Vec<GeneratedNote> = signs
        .iter()
        .zip(&plan.signs)
        .map(|(sign, own)| GeneratedNote {
            hand: None,
            about: NoteSubject::Gloss,
            value: ComponentReading::Value(notated_sign_name(sign).to_owned()),
            span: span(own.from, own.to),
            origin: format!("notation of {}", notated_sign_name(sign)),
        })
        .collect();
    for (sign, own) in signs.iter().zip(&plan.signs) {
        for (value, (from, to)) in sign_component_spans(sign, plan, own, sides, warp) {
            notes.push(GeneratedNote {
                hand: value.field.hand.map(|hand| match hand {
                    HandRef::Right => BodySide::Right,
                    HandRef::Left => BodySide::Left,
                    HandRef::Dominant => sides[0],
                    HandRef::Weak => sides[1],
                }),
                about: NoteSubject::Component(value.field.component, value.field.feature),
                value: ComponentReading::Value(value.value),
                span: span(from, to),
                origin: format!("notation of {}", notated_sign_name(sign)),
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
            let about = NoteSubject::Component(SignComponent::Movement, Some("phase".into()));
            (about, ComponentReading::Value(name.into()))
        };
        let (about, value) = match phase.kind {
            PhaseKind::Transition => (NoteSubject::Transition, ComponentReading::Unset),
            PhaseKind::Stroke => phase_of("stroke"),
            PhaseKind::Hold => phase_of("hold"),
        };
        notes.push(GeneratedNote {
            hand,
            about,
            value,
            span: span(phase.from, phase.to),
            origin: format!("notation of {gloss}: {}", phase.says)
                .trim_end_matches([':', ' '])
                .to_owned(),
        });
    }
    notes.sort_by_key(|note| (note.span.span_start_instant(), note.span.span_end_instant()));
    notes
}

fn notated_sign_name(sign: &NotatedSign) -> &str {
    if sign.gloss.is_empty() { "notation" } else { &sign.gloss }
}

/// Returns a sign's values in each component with their times: from the end of one change to the beginning
/// of the next. If those are unknown, successive values share the sign evenly.
fn sign_component_spans(
    sign: &NotatedSign,
    plan: &SignPlan,
    own: &SignSpan,
    sides: [BodySide; 2],
    warp: &TimeWarp,
) -> Vec<(MappedValue, (f64, f64))> {
    static COMPONENT_MAPPERS: LazyLock<[SignMapper<'static>; 2]> = LazyLock::new(|| {
        let mapper = || SignMapper::new(inventory::builtin_inventories());
        [mapper(), mapper().of_left_handed(true)]
    });
    let values = COMPONENT_MAPPERS[usize::from(sides[0] == BodySide::Left)]
        .map_sign_components(sign)
        .values;
    let field = |of: &MappedValue| {
        let field = &of.field;
        (field.hand, field.component, field.feature.clone())
    };
    let step = |of: &MappedValue, last: usize| match of.field.phase {
        None | Some(SignPhase::Initial) => 0,
        Some(SignPhase::Middle(n)) => usize::from(n).min(last),
        Some(SignPhase::Final) => last,
    };
    let mut all = Vec::new();
    for value in &values {
        let middles = values.iter().filter(|other| field(other) == field(value));
        let last = middles
            .filter_map(|other| match other.field.phase {
                Some(SignPhase::Middle(n)) => Some(usize::from(n) + 1),
                Some(SignPhase::Final) => Some(1),
                _ => None,
            })
            .max()
            .unwrap_or(0);
        let value_step = step(value, last);
        if last == 0 {
            all.push((value.clone(), (own.from, own.to)));
            continue;
        }
        let held_spans = match value.field.hand {
            Some(HandRef::Dominant) => held_component_spans(plan, 0, value.field.component, own, warp),
            Some(HandRef::Weak) => held_component_spans(plan, 1, value.field.component, own, warp),
            _ => Vec::new(),
        };
        match match_values_to_spans(&held_spans, last + 1) {
            Some(steps) => {
                let step_spans = held_spans.iter().zip(steps).filter(|(_, step)| *step == value_step);
                all.extend(step_spans.map(|(held, _)| (value.clone(), held.span)));
            }
            None => {
                let part = |n: usize| own.from + (own.to - own.from) * n as f64 / (last + 1) as f64;
                all.push((value.clone(), (part(value_step), part(value_step + 1))));
            }
        }
    }
    all
}

/// A time span in which a hand has one value of a component, as an index.
struct ValueSpan {
    span: (f64, f64),
    what: usize,
}

/// Assigns `count` successive values to the spans: one after the other, or cyclically; `None` if the
/// numbers do not match.
fn match_values_to_spans(held: &[ValueSpan], count: usize) -> Option<Vec<usize>> {
    if held.len() == count {
        return Some((0..count).collect());
    }
    let mut known_values: Vec<usize> = Vec::new();
    let steps = held.iter().map(|held| {
        let value_index = known_values.iter().position(|what| *what == held.what);
        value_index.unwrap_or_else(|| {
            known_values.push(held.what);
            known_values.len() - 1
        })
    });
    let steps: Vec<usize> = steps.collect();
    (known_values.len() == count).then_some(steps)
}

/// Returns the spans in which a hand has one value of a component each, within a sign.
fn held_component_spans(
    plan: &SignPlan,
    n: usize,
    component: SignComponent,
    own: &SignSpan,
    warp: &TimeWarp,
) -> Vec<ValueSpan> {
    let within = |from: f64| (own.from - 1e-6..own.to - 1e-6).contains(&from);
    if component == SignComponent::Movement {
        let strokes = plan
            .phases
            .iter()
            .filter(|phase| phase.hand == n && phase.kind == PhaseKind::Stroke && within(phase.from));
        let each = strokes.enumerate().map(|(what, phase)| ValueSpan {
            span: (phase.from, phase.to),
            what,
        });
        return each.collect();
    }
    let mut changes: Vec<((f64, f64), usize)> = Vec::new();
    let mut first = usize::MAX;
    let mut turns = Vec::new();
    let mut add = |(from, to): (f64, f64), what: usize| {
        let span = (warp.stretched_time_at(from), warp.stretched_time_at(to));
        if within(span.0) {
            changes.push((span, what));
        } else if span.0 < own.from {
            first = what;
        }
    };
    if component == SignComponent::Placement {
        for (number, &span) in plan.arrivals[n].iter().enumerate() {
            add(span, number);
        }
    } else {
        for event in &plan.events[n] {
            let what = match (&event.act, component) {
                (HandAct::Shape(shape), SignComponent::Configuration) => *shape,
                (HandAct::Turn(to) | HandAct::Follow { to, .. }, SignComponent::Orientation) => {
                    // One written orientation leans to two sides at most by this.
                    let same = |known: &chereme_motion::glam::DQuat| known.angle_between(*to) < 0.25;
                    turns.iter().position(same).unwrap_or_else(|| {
                        turns.push(*to);
                        turns.len() - 1
                    })
                }
                _ => continue,
            };
            add((event.from, event.to), what);
        }
    }
    changes.sort_by(|a, b| a.0.0.total_cmp(&b.0.0));
    let mut all = vec![ValueSpan {
        span: (own.from, own.to),
        what: first,
    }];
    for ((from, to), what) in changes {
        let third = (to - from).max(0.0) / 3.0;
        if let Some(last) = all.last_mut() {
            last.span.1 = from.max(last.span.0 + MIN_ANNOTATION_S.min(third));
        }
        let begins = to.min(own.to - MIN_ANNOTATION_S.min(third));
        all.push(ValueSpan {
            span: (begins.max(from), own.to),
            what,
        });
    }
    all
}
