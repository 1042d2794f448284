//! A cuer: cued speech from text or phones, on any body with an arm, fingers and a head.
//!
//! Keys come from [`chereme_sign::cue`], their times from [`PhaseRule`]. The tip of the pointing finger moves between
//! places of the head along minimum-jerk paths that bend around the lips, the fingers change from shape to shape, and
//! arm and hand follow; the mouth speaks the sounds.
//!
//! After Gibert, Bailly, Elisei, Beautemps & Brun, *Evaluation of a speech cuer* (2004).

pub mod dikey;
mod hand;
pub(crate) mod leaf;
mod mouth;
mod places;
mod timing;

pub use timing::{CuePhases, KeyTimes, KeyType, PhaseRule, Sound, sounds, times};

use chereme_motion::{Instant, ModelPose, Side, Span};
use chereme_sign::cue::{Alphabet, Utterance, french, gloss};
use chereme_sign::{Component, Reading, cue};

use crate::error::Cause;
use crate::explain::brief;
use crate::face::faces;
use crate::ops::join;
use crate::outcome::{About, CueTier, Note};
use crate::poses::HandPose;
use crate::recipe::Cue;
use crate::work::{Group, Work};
use places::{Bow, CLEAR, Head, Spot};

/// Factor on the usual durations of sounds, for people who cue.
const PACE: f64 = 1.6;
/// The least time before the first sound, in seconds.
const LEAD: f64 = 0.6;
/// The time for which the hand rests at either end, in seconds.
const REST: f64 = 0.2;
/// The time in which the hand comes to rest, in seconds.
const TO_REST: f64 = 0.4;
/// The shortest silence in which the hand rests, in seconds.
const SILENCE: f64 = 0.25;
/// The name of the place between utterances.
const AT_REST: &str = "rest";
/// The number of the shape between utterances.
const FIST: u8 = 0;

/// A key, or the rest between keys, with the times of hand and fingers.
struct Target {
    placement: String,
    shape: u8,
    spot: Spot,
    times: KeyTimes,
    /// The bend of the tip's path to it.
    bow: Bow,
    /// The span of the key's sounds; `None` at rest.
    key: Option<Span>,
}

/// Reads the text or phones to cue.
pub(crate) fn read(settings: &Cue) -> Result<Utterance, Cause> {
    let mut french = french::Options::default();
    let mut variants = Vec::new();
    for variant in &settings.variants {
        match &**variant {
            "no-liaison" => french.liaison = false,
            "schwa-said" => french.schwa = french::Schwa::Said,
            "schwa-dropped" => french.schwa = french::Schwa::Dropped,
            _ => variants.push(variant.clone()),
        }
    }
    let alphabet = |name: &String| {
        let known = Alphabet::ALL.into_iter().find(|it| it.name() == name);
        known.unwrap_or_default()
    };
    let reading = cue::Reading {
        code: settings.code.clone().unwrap_or_else(|| "french".to_owned()),
        phones: settings.phones.as_ref().map(alphabet),
        variants,
        french,
        pace: Some(settings.pace.map_or(PACE, |pace| pace.0)),
    };
    let spoken = Utterance::read(&settings.text, &reading)
        .map_err(|error| Cause::Utterance(Box::new(error)))?;
    if spoken.keys.is_empty() {
        return Err(Cause::Empty(settings.text.clone()));
    }
    Ok(spoken)
}

/// The results of cueing.
pub(crate) struct Done {
    pub(crate) did: Vec<String>,
    pub(crate) warnings: Vec<String>,
    pub(crate) residual: f64,
}

/// Cues on the body of `work`, whose first frame is its posture; `shapes` are those of the code, the resting one
/// included.
pub(crate) fn cue(
    work: &mut Work,
    settings: &Cue,
    shapes: &[(u8, HandPose)],
    measured: &CuePhases,
) -> Result<Done, Cause> {
    let side = settings.hand.sides(work.handedness)[0];
    let read = read(settings)?;
    let model = ModelPose::of(&work.skeleton, &work.pose(0));
    let head = Head::of(&work.anatomy, &work.skeleton, &model, side).ok_or(Cause::NoHead)?;
    let sounds = sounds(&read.keys).ok_or(Cause::Input)?;
    let times = times(&sounds, settings.phase, measured);
    // Before the paths of a very long text are found.
    let least = sounds.last().map_or(0.0, |sound| sound.a3) / work.rate.frame_time();
    join::check_length(work, least.ceil() as usize)?;
    let early = times
        .first()
        .map_or(0.0, |first| -first.m1.min(first.d1))
        .max(0.0);
    let lead = (early + REST).max(LEAD);
    let lead = (lead * 1000.0).ceil() / 1000.0;
    let targets = targets(&read, &sounds, &times, &head, lead)?;
    let last = targets
        .last()
        .map_or(0.0, |it| it.times.m2.max(it.times.d2));
    let frame_time = work.rate.frame_time();
    let frames = ((last + REST) / frame_time).ceil().max(1.0) as usize;
    join::check_length(work, frames)?;
    work.sample(&vec![0.0; frames]);
    work.notes.clear();
    work.curves = mouth::curves(&read, lead, frames, frame_time);
    let residual = hand::show(work, side, &head, &targets, (shapes, &read.code))?;
    notes(work, side, settings, &read, (&targets, lead));
    let mut warnings: Vec<String> = read.findings.iter().map(ToString::to_string).collect();
    let clear = lips(work, side, &head, &targets, &read.code);
    if let Some((least, frame)) = clear
        && least < CLEAR
    {
        warnings.push(format!(
            "the fingertip comes within {:.1} mm of the lips at {}; they should be {:.0} mm free",
            least * 1000.0,
            work.rate.instant(frame),
            CLEAR * 1000.0
        ));
    }
    work.changed(
        [Group::Arm(side), Group::Fingers(side)],
        &brief(&settings.to_string()),
    );
    let mut did = vec![format!(
        "{} keys of {} in {:.2} s, phases as {} has them",
        read.keys.len(),
        read.code.id,
        frames as f64 * frame_time,
        settings.phase.name()
    )];
    if settings.phase == PhaseRule::Measured {
        let [pair, vowel, consonant] = measured.counts;
        did.push(format!(
            "measured on {pair} pairs, {vowel} vowels and {consonant} consonants alone"
        ));
    }
    did.extend(clear.map(|(least, _)| {
        format!(
            "the fingertip stays {:.1} mm or more outside the lips",
            least * 1000.0
        )
    }));
    for key in read.keys.iter().filter(|key| key.or_at.is_some()) {
        let other = key.or_at.as_deref().unwrap_or_default();
        let said = key.phones.concat();
        did.push(format!(
            "{said}: {} here, {other} for some speakers",
            key.placement
        ));
    }
    Ok(Done {
        did,
        warnings,
        residual,
    })
}

/// Returns the successive targets of the hand: rest, the keys, and rest in long silences and at the end.
fn targets(
    read: &Utterance,
    sounds: &[Sound],
    times: &[KeyTimes],
    head: &Head,
    lead: f64,
) -> Result<Vec<Target>, Cause> {
    let spot = |placement: &str| {
        head.spot(placement).ok_or_else(|| Cause::NoMeaning {
            value: placement.to_owned(),
            what: "place of cued speech",
        })
    };
    let moved = |times: KeyTimes| KeyTimes {
        m1: times.m1 + lead,
        m2: times.m2 + lead,
        d1: times.d1 + lead,
        d2: times.d2 + lead,
    };
    let rest = |from: f64, to: f64| -> Result<Target, Cause> {
        Ok(Target {
            placement: AT_REST.to_owned(),
            shape: FIST,
            spot: spot(AT_REST)?,
            times: KeyTimes {
                m1: from,
                m2: to,
                d1: from,
                d2: to,
            },
            bow: Bow::default(),
            key: None,
        })
    };
    let shift = (lead * 1e6).round() as i64;
    let mut targets = vec![rest(0.0, 0.0)?];
    for (n, key) in read.keys.iter().enumerate() {
        let mut own = moved(times[n]);
        let ends = n.checked_sub(1).map(|n| sounds[n].a3);
        if let Some(end) = ends
            && sounds[n].a1 - end > SILENCE
        {
            let before = targets[targets.len() - 1].times;
            let from = (end + lead).max(before.m2).max(before.d2);
            // Half of the silence for the path to rest, at most its usual time.
            let to = from + TO_REST.min((sounds[n].a1 - end) / 2.0);
            targets.push(rest(from, to)?);
            own.m2 = own.m2.max(to + 0.06);
            own.d2 = own.d2.max(to + 0.06);
            own.m1 = own.m1.clamp(to, own.m2);
            own.d1 = own.d1.clamp(to, own.d2);
        }
        let instant = |seconds: f64| Instant::from_seconds(seconds).shifted(shift);
        targets.push(Target {
            placement: key.placement.clone(),
            shape: key.shape,
            spot: spot(&key.placement)?,
            times: own,
            bow: Bow::default(),
            key: Some(Span::between(instant(sounds[n].a1), instant(sounds[n].a3))),
        });
    }
    let (last, end) = (
        targets[targets.len() - 1].times,
        lead + sounds.last().map_or(0.0, |sound| sound.a3),
    );
    let from = end.max(last.m2).max(last.d2);
    targets.push(rest(from, from + TO_REST)?);
    for n in 1..targets.len() {
        let [before, own] = [&targets[n - 1], &targets[n]];
        let same = before.placement == own.placement && before.shape == own.shape;
        targets[n].bow = if same {
            Bow::renewed()
        } else {
            Bow::between(&before.spot, &own.spot, head.size)
        };
    }
    Ok(targets)
}

/// Returns the least distance of the pointing tip from the lips, and its frame.
fn lips(
    work: &Work,
    side: Side,
    head: &Head,
    targets: &[Target],
    code: &cue::CueCode,
) -> Option<(f64, usize)> {
    let faces = faces(&work.curves);
    let mut least: Option<(f64, usize)> = None;
    for frame in 0..work.frames {
        let model = ModelPose::of(&work.skeleton, &work.pose(frame));
        let tip = hand::tip(work, &model, side, targets, frame, code)?;
        let face = faces.get(frame).copied().unwrap_or_default();
        let clear = places::clearance(head.local(tip), &face, head.size);
        if least.is_none_or(|(known, _)| clear < known) {
            least = Some((clear, frame));
        }
    }
    least
}

fn notes(
    work: &mut Work,
    side: Side,
    settings: &Cue,
    read: &Utterance,
    (targets, lead): (&[Target], f64),
) {
    let whole = work.span();
    // A copy stands with every note.
    let from = brief(&settings.to_string());
    let mut add = |hand: Option<Side>, about: About, value: &str, span: Span| {
        if let Some(span) = span.intersection(whole)
            && !span.is_empty()
        {
            work.notes.push(Note {
                hand,
                about,
                value: Reading::Value(value.to_owned()),
                span,
                origin: from.clone(),
            });
        }
    };
    add(None, About::Gloss, &settings.text, whole);
    let shift = (lead * 1e6).round() as i64;
    for phone in &read.phones {
        let symbols = read.code.symbols(&phone.label, read.alphabet);
        if let (Some(span), Some(symbols)) = (phone.span, symbols)
            && symbols.iter().any(|symbol| !read.code.is_pause(symbol))
        {
            let label = symbols.join(" ");
            add(
                None,
                About::Cue(CueTier::Phones),
                &label,
                span.shifted(shift),
            );
        }
    }
    let between =
        |from: f64, to: f64| Span::between(Instant::from_seconds(from), Instant::from_seconds(to));
    for (n, target) in targets.iter().enumerate().skip(1) {
        let (before, times) = (&targets[n - 1], target.times);
        let name = |it: &Target| format!("{}-{}", it.placement, it.shape);
        let transition = format!("{}>{}", name(before), name(target));
        add(
            None,
            About::Cue(CueTier::Hand),
            &transition,
            between(times.m1, times.m2),
        );
        let transition = format!("{}>{}", before.shape, target.shape);
        add(
            None,
            About::Cue(CueTier::Fingers),
            &transition,
            between(times.d1, times.d2),
        );
        let Some(key) = target.key else { continue };
        let next = targets.get(n + 1).map_or(times, |next| next.times);
        let held = |from: f64, to: f64| between(from, to.max(from + 0.02));
        let value = gloss(&target.placement, target.shape);
        add(None, About::Cue(CueTier::Keys), &value, key);
        if let Some(shape) = read.code.shape(target.shape) {
            let about = About::Component(Component::Configuration, None);
            add(
                Some(side),
                about,
                &shape.configuration,
                held(times.d2, next.d1),
            );
        }
        if let Some(place) = read.code.placement(&target.placement) {
            let about = About::Component(Component::Placement, None);
            add(Some(side), about, &place.placement, held(times.m2, next.m1));
        }
    }
}

#[cfg(test)]
mod tests;
