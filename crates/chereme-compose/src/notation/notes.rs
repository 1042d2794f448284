//! Annotations and remarks about synthesised movement.

use std::sync::LazyLock;

use chereme_motion::{Clip, Instant, Side, Span};
use chereme_sign::component::{HandRef, Phase};
use chereme_sign::hamnosys::Notated;
use chereme_sign::hamnosys::components::{MappedValue, Mapper};
use chereme_sign::{Component, Reading, inventory};

use super::plan::{Act, PhaseKind, SignPlan, SignSpan};
use super::stretch_time::Warp;
use crate::outcome::{About, Note};

/// Shortest annotation (s) of a value that the hand has only momentarily.
const SHORTEST: f64 = 0.04;

/// Returns the glosses, the component values, the strokes and holds of each hand, and the transitions. All
/// times in `plan` are stretched already, except those of its events; `stretch_time` stretches those.
pub(crate) fn notes(
    signs: &[&Notated],
    plan: &SignPlan,
    sides: [Side; 2],
    clip: &Clip,
    warp: &Warp,
) -> Vec<Note> {
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
        for (value, (from, to)) in components(sign, plan, own, sides, warp) {
            notes.push(Note {
                hand: value.field.hand.map(|hand| match hand {
                    HandRef::Right => Side::Right,
                    HandRef::Left => Side::Left,
                    HandRef::Dominant => sides[0],
                    HandRef::Weak => sides[1],
                }),
                about: About::Component(value.field.component, value.field.feature),
                value: Reading::Value(value.value),
                span: span(from, to),
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

/// Returns a sign's values in each component with their times: from the end of one change to the beginning
/// of the next. If those are unknown, successive values share the sign evenly.
fn components(
    sign: &Notated,
    plan: &SignPlan,
    own: &SignSpan,
    sides: [Side; 2],
    warp: &Warp,
) -> Vec<(MappedValue, (f64, f64))> {
    static MAPPERS: LazyLock<[Mapper<'static>; 2]> = LazyLock::new(|| {
        let mapper = || Mapper::new(inventory::builtin());
        [mapper(), mapper().of_left_handed(true)]
    });
    let values = MAPPERS[usize::from(sides[0] == Side::Left)]
        .map(sign)
        .values;
    let field = |of: &MappedValue| {
        let field = &of.field;
        (field.hand, field.component, field.feature.clone())
    };
    let step = |of: &MappedValue, last: usize| match of.field.phase {
        None | Some(Phase::Initial) => 0,
        Some(Phase::Middle(n)) => usize::from(n).min(last),
        Some(Phase::Final) => last,
    };
    let mut all = Vec::new();
    for value in &values {
        let middles = values.iter().filter(|other| field(other) == field(value));
        let last = middles
            .filter_map(|other| match other.field.phase {
                Some(Phase::Middle(n)) => Some(usize::from(n) + 1),
                Some(Phase::Final) => Some(1),
                _ => None,
            })
            .max()
            .unwrap_or(0);
        let at = step(value, last);
        if last == 0 {
            all.push((value.clone(), (own.from, own.to)));
            continue;
        }
        let held = match value.field.hand {
            Some(HandRef::Dominant) => held(plan, 0, value.field.component, own, warp),
            Some(HandRef::Weak) => held(plan, 1, value.field.component, own, warp),
            _ => Vec::new(),
        };
        match matched(&held, last + 1) {
            Some(steps) => {
                let own = held.iter().zip(steps).filter(|(_, step)| *step == at);
                all.extend(own.map(|(held, _)| (value.clone(), held.span)));
            }
            None => {
                let part = |n: usize| own.from + (own.to - own.from) * n as f64 / (last + 1) as f64;
                all.push((value.clone(), (part(at), part(at + 1))));
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
fn matched(held: &[ValueSpan], count: usize) -> Option<Vec<usize>> {
    if held.len() == count {
        return Some((0..count).collect());
    }
    let mut known: Vec<usize> = Vec::new();
    let steps = held.iter().map(|held| {
        let at = known.iter().position(|what| *what == held.what);
        at.unwrap_or_else(|| {
            known.push(held.what);
            known.len() - 1
        })
    });
    let steps: Vec<usize> = steps.collect();
    (known.len() == count).then_some(steps)
}

/// Returns the spans in which a hand has one value of a component each, within a sign.
fn held(
    plan: &SignPlan,
    n: usize,
    component: Component,
    own: &SignSpan,
    warp: &Warp,
) -> Vec<ValueSpan> {
    let within = |from: f64| (own.from - 1e-6..own.to - 1e-6).contains(&from);
    if component == Component::Movement {
        let strokes = plan.phases.iter().filter(|phase| {
            phase.hand == n && phase.kind == PhaseKind::Stroke && within(phase.from)
        });
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
        let span = (warp.at(from), warp.at(to));
        if within(span.0) {
            changes.push((span, what));
        } else if span.0 < own.from {
            first = what;
        }
    };
    if component == Component::Placement {
        for (number, &span) in plan.arrivals[n].iter().enumerate() {
            add(span, number);
        }
    } else {
        for event in &plan.events[n] {
            let what = match (&event.act, component) {
                (Act::Shape(shape), Component::Configuration) => *shape,
                (Act::Turn(to) | Act::Follow { to, .. }, Component::Orientation) => {
                    // One written orientation leans to two sides at most by this.
                    let same =
                        |known: &chereme_motion::glam::DQuat| known.angle_between(*to) < 0.25;
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
            last.span.1 = from.max(last.span.0 + SHORTEST.min(third));
        }
        let begins = to.min(own.to - SHORTEST.min(third));
        all.push(ValueSpan {
            span: (begins.max(from), own.to),
            what,
        });
    }
    all
}
