//! `repeat`: the movement several times, growing or shrinking, faster or slower.

use chereme_motion::Side;
use chereme_sign::Component;

use crate::contact::{self, Carry, Keep};
use crate::course::Courses;
use crate::error::Cause;
use crate::made::About;
use crate::ops::join::{self, Seam};
use crate::ops::{retime, say, shape};
use crate::recipe::Repeat;
use crate::work::{Group, Work};

/// The usual time of the return to the start, in seconds.
const GAP: f64 = 0.12;

/// Plays the movement `times` times.
pub(crate) fn repeat(
    work: &mut Work,
    settings: &Repeat,
    courses: &Courses,
    operator: &str,
) -> Result<join::Done, Cause> {
    let seconds = settings
        .gap
        .or(settings.via.time)
        .map_or(GAP, |time| time.0);
    let gap = (seconds / work.rate.frame_time()).round() as usize;
    let times = settings.times as usize;
    join::check_length(work, times.saturating_mul(work.frames + gap))?;
    let mut once = work.clone();
    let (scale, tempo) = (
        settings.scale.map_or(1.0, |s| s.0),
        settings.tempo.map_or(1.0, |t| t.0),
    );
    let arms: Vec<Side> = Side::BOTH
        .into_iter()
        .filter(|&s| work.anatomy.arm(s).is_some())
        .collect();
    let mut residual: f64 = 0.0;
    let mut done = join::Done::default();
    for n in 1..times {
        let mut next = once.clone();
        if scale != 1.0 {
            let mut touched = contact::touches(&next);
            residual = residual.max(shape::scale(&mut next, &arms, scale)?.residual);
            let keep = Keep::All(&Side::BOTH);
            let what = |told: &String| format!("repetition {}: {told}", n + 1);
            let kept = contact::mend(&mut next, &mut touched, keep, operator);
            done.did.extend(kept.iter().map(what));
            let lost = contact::lost(&touched, &next, Carry::Same);
            done.contacts.extend(lost.iter().map(what));
        }
        if tempo != 1.0 {
            retime::stretch(&mut next, 1.0 / tempo)?;
        }
        if scale != 1.0 || tempo != 1.0 {
            once = next.clone();
        }
        let seam = Seam::plain(work, gap);
        let what = format!("repetition {} to {}", n, n + 1);
        done.joins
            .extend(join::join(work, next, &seam, courses, &what)?);
    }
    if times > 1 {
        work.changed(Group::ALL, operator);
        repeated(work, times, operator);
    }
    let times = format!("{times} times, {gap} frames between");
    done.did.insert(0, times);
    if residual > 1e-3 {
        done.did.push(format!(
            "out of reach: a wrist stays {:.1} cm short",
            residual * 100.0
        ));
    }
    Ok(done)
}

/// Notes the number of repetitions of each active hand, in place of its earlier value.
fn repeated(work: &mut Work, times: usize, operator: &str) {
    let is_said = |about: &About| matches!(about, About::Component(Component::Movement, Some(it)) if it == "repetition");
    let more = work.notes.iter().any(|note| {
        let value = note.value.value();
        is_said(&note.about) && value.is_some_and(|value| value != "once")
    });
    let value = if times == 2 && !more {
        "twice"
    } else {
        "several"
    };
    work.notes.retain(|note| !is_said(&note.about));
    let dominant = work.handedness.dominant();
    let moves = |side: Side| {
        let manual = |about: &About| matches!(about, About::Component(..));
        let notes = work.notes.iter();
        notes
            .into_iter()
            .any(|note| note.hand == Some(side) && manual(&note.about))
    };
    let sides: Vec<Side> = Side::BOTH
        .into_iter()
        .filter(|&side| side == dominant || moves(side))
        .collect();
    for side in sides {
        let what = (Component::Movement, Some("repetition"));
        say::tell(work, side, what, value, 0..work.frames, operator);
    }
}
