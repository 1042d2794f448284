//! `nonmanual from`: head and face of another sign.

use std::sync::Arc;

use chereme_sign::Component;

use crate::error::Cause;
use crate::made::{About, Curve, Note};
use crate::ops::retarget;
use crate::sources::Material;
use crate::work::{Group, Work, groups};

/// Gives head, neck, jaw and eyes the movement they have in another sign, stretched to this one's
/// time.
pub(crate) fn nonmanual(
    work: &mut Work,
    donor: &Material,
    operator: &str,
) -> Result<Vec<String>, Cause> {
    let mut other = Work::of(donor);
    let (seconds, own) = (other.span().seconds(), work.span().seconds());
    if other.skeleton != work.skeleton {
        other = retarget::retarget(&other, &work.skeleton, &work.anatomy)?;
    } else {
        other.skeleton = Arc::clone(&work.skeleton);
    }
    let last = (other.frames - 1) as f64 / work.frames.saturating_sub(1).max(1) as f64;
    let at: Vec<f64> = (0..work.frames).map(|frame| frame as f64 * last).collect();
    other.sample(&at);
    let groups = groups(&work.skeleton, &work.anatomy);
    let head: Vec<usize> = (0..groups.len())
        .filter(|&j| groups[j] == Group::Head)
        .collect();
    if head.is_empty() {
        return Err(Cause::NoHead);
    }
    for &joint in &head {
        work.channels[joint] = other.channels[joint].clone();
    }
    let is_nonmanual =
        |note: &Note| matches!(note.about, About::Component(Component::NonManual, _));
    work.notes.retain(|note| !is_nonmanual(note));
    let stretch = own / seconds.max(1e-9);
    let scaled = |instant: chereme_motion::Instant| {
        chereme_motion::Instant::from_seconds(instant.seconds() * stretch).min(work.end())
    };
    let notes: Vec<Note> = other
        .notes
        .iter()
        .filter(|note| is_nonmanual(note))
        .map(|note| Note {
            span: chereme_motion::Span::between(scaled(note.span.start()), scaled(note.span.end())),
            ..note.clone()
        })
        .collect();
    work.notes.extend(notes);
    // Trunk and shoulders stay this sign's own.
    let of_body = |curve: &Curve| {
        ["body.", "shoulders."]
            .iter()
            .any(|part| curve.name.starts_with(part))
    };
    work.curves.retain(of_body);
    work.curves
        .extend(other.curves.into_iter().filter(|curve| !of_body(curve)));
    work.changed([Group::Head], operator);
    Ok(vec![format!(
        "{} joints of the head from {} ({seconds:.2} s stretched to {own:.2} s)",
        head.len(),
        donor.address
    )])
}
