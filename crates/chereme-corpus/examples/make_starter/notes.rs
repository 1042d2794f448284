//! The annotations of a take on each tier, as the animator describes its movement.

use chereme_compose::{GeneratedMovement, NoteSubject};
use chereme_motion::{BodySide, RecordingInstant, TimeSpan};
use chereme_sign::{ComponentReading, SignComponent};

use super::perform::REST;
use super::signs::{Finer, Sign};
use super::takes::Take;

/// A tier of the annotation files.
pub(crate) struct TierKind {
    /// Its name; `@` stands for `RH` or `LH`.
    pub(crate) name: &'static str,
    /// The inventory of its values.
    pub(crate) inventory: Option<&'static str>,
    component: SignComponent,
    feature: Option<&'static str>,
}

impl TierKind {
    /// Returns the name of its ELAN type.
    pub(crate) fn kind(&self) -> String {
        self.name.trim_end_matches(" @").to_lowercase()
    }
}

/// The tiers below the gloss, including the phases.
pub(crate) const TIERS: [TierKind; 9] = {
    use SignComponent::{Configuration, Movement, NonManual, Orientation, Placement};
    [
        tier("Configuration @", "configurations", Configuration, None),
        tier("Placement @", "placements", Placement, None),
        tier("Movement @", "movements", Movement, None),
        tier("Movement direction @", "directions", Movement, Some("direction")),
        tier("Palm direction @", "palm", Orientation, Some("palm")),
        tier("Finger direction @", "fingers", Orientation, Some("fingers")),
        tier("Brows", "brows", NonManual, Some("brows")),
        tier("Head", "head", NonManual, Some("head")),
        tier("Phase @", "", Movement, Some("phase")),
    ]
};

const fn tier(
    name: &'static str,
    inventory: &'static str,
    component: SignComponent,
    feature: Option<&'static str>,
) -> TierKind {
    TierKind {
        name,
        inventory: if inventory.is_empty() { None } else { Some(inventory) },
        component,
        feature,
    }
}

/// The index of the configurations in [`TIERS`].
pub(crate) const CONFIGURATION: usize = 0;
/// The index of the placements.
pub(crate) const PLACEMENT: usize = 1;
/// The index of the movements.
pub(crate) const MOVEMENT: usize = 2;
/// The index of the movements' directions.
pub(crate) const DIRECTION: usize = 3;
/// The index of the phases.
pub(crate) const PHASE: usize = 8;

/// A value over a stretch of time.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Note {
    /// The index of the tier in [`TIERS`].
    pub(crate) tier: usize,
    /// The hand; nothing if the tier has none.
    pub(crate) side: Option<BodySide>,
    /// The value.
    pub(crate) value: String,
    /// The time.
    pub(crate) span: TimeSpan,
    /// The index of the sign in the take.
    pub(crate) sign: usize,
}

/// Returns the times of a take's signs.
pub(crate) fn glosses(made: &GeneratedMovement) -> Vec<TimeSpan> {
    let glosses = made.notes.iter().filter(|note| note.about == NoteSubject::Gloss);
    glosses.map(|note| later(note.span)).collect()
}

/// Returns the annotations of the signs of `take`, tier by tier in order of time.
pub(crate) fn notes(take: &Take, made: &GeneratedMovement) -> Vec<Note> {
    let phases: Vec<Note> = BodySide::BOTH_SIDES
        .iter()
        .flat_map(|side| phases(made, *side))
        .collect();
    let mut notes = Vec::new();
    for (n, (sign, span)) in take.signs.iter().zip(glosses(made)).enumerate() {
        for tier in 0..PHASE {
            for side in [Some(BodySide::Right), Some(BodySide::Left), None] {
                let said = of_tier(sign, span, made, &phases, tier, side);
                notes.extend(said.into_iter().map(|(value, span)| Note {
                    tier,
                    side,
                    value,
                    span,
                    sign: n,
                }));
            }
        }
    }
    notes.extend(phases);
    notes
}

/// Returns the values of one tier in one sign.
fn of_tier(
    sign: &Sign,
    gloss: TimeSpan,
    made: &GeneratedMovement,
    phases: &[Note],
    tier: usize,
    side: Option<BodySide>,
) -> Vec<(String, TimeSpan)> {
    let kind = &TIERS[tier];
    let own = made.notes.iter().filter(|note| match &note.about {
        NoteSubject::Component(component, feature) => {
            let said = (*component, feature.as_deref()) == (kind.component, kind.feature);
            said && note.hand == side && gloss.has_instant(later(note.span).span_start_instant())
        }
        _ => false,
    });
    let mut said: Vec<(String, TimeSpan)> = Vec::new();
    for note in own {
        let (ComponentReading::Value(value), span) = (&note.value, later(note.span)) else {
            continue;
        };
        if said
            .last()
            .is_none_or(|(_, before)| before.span_end_instant() <= span.span_start_instant())
        {
            said.push((value.clone(), span));
        }
    }
    let finer = sign.finer.iter().find(|finer| (finer.0, finer.1) == (tier, side));
    if let Some(Finer(_, _, values)) = finer {
        let spans: Vec<TimeSpan> = match said.len() == values.len() {
            true => said.iter().map(|(_, span)| *span).collect(),
            false if values.len() == 1 => said.first().zip(said.last()).map_or(vec![gloss], |(a, b)| {
                vec![TimeSpan::span_between(a.1.span_start_instant(), b.1.span_end_instant())]
            }),
            false => shares(gloss, values.len()),
        };
        said = values.iter().map(|value| (*value).to_owned()).zip(spans).collect();
    }
    let own = phases.iter().filter(|phase| {
        let stroke = phase.side == side && phase.value == "stroke";
        stroke && gloss.has_instant(phase.span.span_start_instant())
    });
    let strokes: Vec<TimeSpan> = own.map(|phase| phase.span).collect();
    if let (Some(first), Some(last)) = (strokes.first(), strokes.last()) {
        let whole = TimeSpan::span_between(first.span_start_instant(), last.span_end_instant());
        if tier == MOVEMENT || tier == DIRECTION {
            let shares = shares(whole, said.len());
            said.iter_mut().zip(shares).for_each(|(said, share)| said.1 = share);
        } else if let [(_, one), (_, other)] = &mut said[..] {
            change(one, other, whole);
        }
    }
    said
}

/// Shortens a value that changes into another during a stroke to the stroke's first third, and starts the other one at
/// its last third.
fn change(one: &mut TimeSpan, other: &mut TimeSpan, stroke: TimeSpan) {
    if one.span_end_instant() < other.span_start_instant() {
        return;
    }
    let thirds = shares(stroke, 3);
    *one = TimeSpan::span_between(one.span_start_instant(), thirds[0].span_end_instant());
    *other = TimeSpan::span_between(thirds[2].span_start_instant(), other.span_end_instant());
}

/// Divides a span into `count` equal parts.
fn shares(span: TimeSpan, count: usize) -> Vec<TimeSpan> {
    let (start, end) = (
        span.span_start_instant().instant_seconds(),
        span.span_end_instant().instant_seconds(),
    );
    let at = |n: usize| {
        let time = start + (end - start) * n as f64 / count as f64;
        RecordingInstant::from_millis((time * 1000.0).round() as i64)
    };
    (0..count).map(|n| TimeSpan::span_between(at(n), at(n + 1))).collect()
}

/// Returns the phases of a hand: preparation, strokes and holds, retraction.
fn phases(made: &GeneratedMovement, side: BodySide) -> Vec<Note> {
    let mut all: Vec<Note> = Vec::new();
    for note in made.notes.iter().filter(|note| note.hand == Some(side)) {
        let value = match (&note.about, &note.value) {
            (NoteSubject::Transition, _) => "preparation",
            (NoteSubject::Component(SignComponent::Movement, Some(feature)), ComponentReading::Value(value))
                if feature == "phase" =>
            {
                value
            }
            _ => continue,
        };
        let span = later(note.span);
        match all.last_mut() {
            Some(last) if last.value == value && last.span.span_end_instant() >= span.span_start_instant() => {
                last.span = TimeSpan::span_between(
                    last.span.span_start_instant(),
                    span.span_end_instant().max(last.span.span_end_instant()),
                );
            }
            Some(last) if last.span.span_end_instant() > span.span_start_instant() => {}
            _ => all.push(Note {
                tier: PHASE,
                side: Some(side),
                value: value.to_owned(),
                span,
                sign: 0,
            }),
        }
    }
    if let Some(last) = all.last_mut().filter(|last| last.value == "preparation") {
        "retraction".clone_into(&mut last.value);
    }
    all
}

/// Converts a span of the animator's movement to the time of the take, which begins with rest; in whole milliseconds.
fn later(span: TimeSpan) -> TimeSpan {
    let rest = REST as f64 / 60.0;
    let at =
        |at: RecordingInstant| RecordingInstant::from_millis(((at.instant_seconds() + rest) * 1000.0).round() as i64);
    TimeSpan::span_between(at(span.span_start_instant()), at(span.span_end_instant()))
}
