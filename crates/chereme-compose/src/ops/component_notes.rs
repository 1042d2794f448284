//! Notes the values that an operator gives to signs, and withdraws those that no longer hold.

use std::ops::Range;

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{BodySide, TimeSpan};
use chereme_sign::hamnosys::{SpatialDirection, orientation};
use chereme_sign::{ComponentReading, SignComponent};

use crate::outcome::{GeneratedNote, NoteSubject};
use crate::work::WorkingClip;

/// Returns whether a note is about a hand in `sides`; a note without a hand is about the dominant one.
pub(crate) fn is_of(work: &WorkingClip, note: &GeneratedNote, sides: &[BodySide]) -> bool {
    let dominant = work.handedness.signer_dominant_side();
    sides.contains(&note.hand.unwrap_or(dominant))
}

/// Withdraws notes about hands if `about` returns that the component, or the part of it, no longer holds.
pub(crate) fn withdraw_hand_notes(
    work: &mut WorkingClip,
    sides: &[BodySide],
    operator: &str,
    about: impl Fn(SignComponent, Option<&str>) -> bool,
) {
    for n in 0..work.notes.len() {
        let note = &work.notes[n];
        let NoteSubject::Component(component, feature) = &note.about else {
            continue;
        };
        let has_value = note.value.reading_value().is_some();
        if has_value && is_of(work, note, sides) && about(*component, feature.as_deref()) {
            let note = &mut work.notes[n];
            note.value = ComponentReading::Unset;
            note.origin = format!("{} | {operator}", note.origin);
        }
    }
}

/// Notes that a hand has a value of a component, or of a part of it, over some frames. Earlier notes on the same
/// subject are cut or removed there.
pub(crate) fn record_component_value(
    work: &mut WorkingClip,
    side: BodySide,
    about: NoteSubject,
    value: &str,
    frames: Range<usize>,
    operator: &str,
) {
    let span = work.rate.frame_range_span(frames);
    cut_notes_in_span(work, span, |note| note.hand == Some(side) && note.about == about);
    work.notes.push(GeneratedNote {
        hand: Some(side),
        about,
        value: ComponentReading::from(value),
        span,
        origin: operator.to_owned(),
    });
}

/// Cuts those notes that `is_meant` names to the time outside of a span, and removes those within it.
pub(crate) fn cut_notes_in_span(work: &mut WorkingClip, span: TimeSpan, is_meant: impl Fn(&GeneratedNote) -> bool) {
    let mut left = Vec::with_capacity(work.notes.len() + 2);
    for note in std::mem::take(&mut work.notes) {
        if !is_meant(&note) {
            left.push(note);
            continue;
        }
        let before = TimeSpan::span_between(
            note.span.span_start_instant(),
            note.span.span_end_instant().min(span.span_start_instant()),
        );
        let after = TimeSpan::span_between(
            note.span.span_start_instant().max(span.span_end_instant()),
            note.span.span_end_instant(),
        );
        for part in [before, after] {
            if part.span_micros() > 0 && note.span.span_intersection(part) == Some(part) {
                left.push(GeneratedNote {
                    span: part,
                    ..note.clone()
                });
            }
        }
    }
    work.notes = left;
}

/// Notes the place of a moved hand: `value`, over the times of its earlier placements, or over `frames` if it had no
/// placement. Without a value, it only withdraws the earlier placements.
pub(crate) fn record_placement_note(
    work: &mut WorkingClip,
    side: BodySide,
    value: Option<&str>,
    frames: Range<usize>,
    operator: &str,
) {
    withdraw_hand_notes(work, &[side], operator, |component, feature| {
        component == SignComponent::Placement && feature.is_some()
    });
    let mut recorded = false;
    let reading = value.map_or(ComponentReading::Unset, ComponentReading::from);
    for n in 0..work.notes.len() {
        let is_whole = work.notes[n].about == NoteSubject::Component(SignComponent::Placement, None);
        if !is_whole || !is_of(work, &work.notes[n], &[side]) {
            continue;
        }
        recorded = true;
        let note = &mut work.notes[n];
        note.value = reading.clone();
        note.origin = format!("{} | {operator}", note.origin);
    }
    if let Some(value) = value.filter(|_| !recorded) {
        let what = NoteSubject::Component(SignComponent::Placement, None);
        record_component_value(work, side, what, value, frames, operator);
    }
}

/// Returns the value of a component when the movement is played backwards; `None` if it would be a value without a
/// known word.
pub(crate) fn backwards_value(component: SignComponent, feature: Option<&str>, value: &str) -> Option<String> {
    if value.contains('>') {
        let parts: Vec<&str> = value.split('>').map(str::trim).rev().collect();
        return Some(parts.join(" > "));
    }
    let same = || Some(value.to_owned());
    match (component, feature) {
        (SignComponent::Movement, Some("direction")) => Some(opposite_direction_name(value)),
        (SignComponent::Movement, Some("phase")) => match value {
            "preparation" => Some("retraction".to_owned()),
            "retraction" => Some("preparation".to_owned()),
            _ => same(),
        },
        (SignComponent::Movement, Some("manner")) if ["halt", "rest"].contains(&value) => None,
        (SignComponent::Movement, Some("size" | "repetition" | "manner")) => same(),
        (SignComponent::Movement, None) => match value {
            "opening" => Some("closing".to_owned()),
            "closing" => Some("opening".to_owned()),
            "hold" | "path" | "straight" | "arc" | "circle" | "zigzag" | "wavy" | "wrist" | "nodding" | "swinging"
            | "twisting" | "stirring" | "finger" | "wiggle" | "rubbing" | "contact" => same(),
            _ => None,
        },
        (SignComponent::Movement, Some(_)) => None,
        (_, Some("change")) => match value {
            "opening" => Some("closing".to_owned()),
            "closing" => Some("opening".to_owned()),
            _ => None,
        },
        (SignComponent::NonManual, Some("mouthing")) if value != "none" => None,
        _ => same(),
    }
}

/// Returns the opposite of a direction such as `up-left`.
fn opposite_direction_name(value: &str) -> String {
    let words = value.split('-').map(|word| match word {
        "up" => "down",
        "down" => "up",
        "left" => "right",
        "right" => "left",
        "in" => "out",
        "out" => "in",
        other => other,
    });
    words.collect::<Vec<_>>().join("-")
}

/// Returns the name of the nearest of the 26 directions of body space (left, up, forward), in the words of inventories.
pub(crate) fn nearest_direction_name(vector: DVec3) -> Option<String> {
    let vector = vector.try_normalize()?;
    let cells = (-1..=1).flat_map(|x| (-1..=1).flat_map(move |y| (-1..=1).map(move |z| [x, y, z])));
    let nearest = cells.filter(|cell| *cell != [0; 3]).max_by(|a, b| {
        let near = |cell: &[i32; 3]| DVec3::from(cell.map(f64::from)).normalize().dot(vector);
        near(a).total_cmp(&near(b))
    })?;
    let axis_words = [
        (nearest[1], ["down", "up"]),
        (nearest[2], ["in", "out"]),
        (nearest[0], ["right", "left"]),
    ];
    let words = axis_words.into_iter().filter(|(sign, _)| *sign != 0);
    let words: Vec<&str> = words.map(|(sign, names)| names[usize::from(sign > 0)]).collect();
    Some(words.join("-"))
}

/// Returns the name of the palm's direction, one of eight, in the words of notation for fingers in that direction; both
/// directions are in body space.
pub(crate) fn palm_direction_name(fingers: DVec3, palm: DVec3) -> Option<&'static str> {
    let (fingers, palm) = (fingers.try_normalize()?, palm.try_normalize()?);
    // The letters jump at the vertical, where the measured direction may lie to either side.
    let nearest = SpatialDirection::nearest_spatial_direction(fingers.to_array())?;
    let facing = DQuat::from_rotation_arc(fingers, nearest.spatial_direction_vector().into()) * palm;
    let angle = orientation::palm_angle(nearest.spatial_direction_vector(), facing.to_array());
    const PALM_DIRECTION_NAMES: [&str; 8] = [
        "down",
        "down-right",
        "right",
        "up-right",
        "up",
        "up-left",
        "left",
        "down-left",
    ];
    let eighth = (angle / std::f64::consts::FRAC_PI_4).round() as i64;
    Some(PALM_DIRECTION_NAMES[eighth.rem_euclid(8) as usize])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_have_the_names_of_the_inventory() {
        for (vector, want) in [
            ([0.0, 1.0, 0.0], "up"),
            ([1.0, 1.0, 0.0], "up-left"),
            ([-0.1, 0.0, 1.0], "out"),
            ([-1.0, -1.0, -1.0], "down-in-right"),
        ] {
            assert_eq!(nearest_direction_name(vector.into()).as_deref(), Some(want));
        }
        assert_eq!(palm_direction_name(DVec3::Z, DVec3::NEG_Y), Some("down"));
        assert_eq!(palm_direction_name(DVec3::Y, DVec3::Z), Some("down"));
        assert_eq!(palm_direction_name(DVec3::Y, DVec3::X), Some("left"));
    }

    #[test]
    fn reversed_values_become_opposite_stay_or_are_withdrawn() {
        let movement = SignComponent::Movement;
        for (component, feature, value, want) in [
            (movement, Some("direction"), "up-out-left", Some("down-in-right")),
            (movement, None, "arc", Some("arc")),
            (movement, None, "opening", Some("closing")),
            (movement, None, "grasp", None),
            (movement, Some("phase"), "stroke", Some("stroke")),
            (movement, Some("manner"), "halt", None),
            (SignComponent::Placement, None, "head > chest", Some("chest > head")),
            (SignComponent::Configuration, None, "U", Some("U")),
            (SignComponent::NonManual, Some("mouthing"), "word", None),
        ] {
            assert_eq!(backwards_value(component, feature, value).as_deref(), want, "{value}");
        }
    }
}
