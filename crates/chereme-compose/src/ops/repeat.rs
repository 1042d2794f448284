//! `repeat`: the movement several times, growing or shrinking, faster or slower.

use crate::course::Course;
use crate::error::Cause;
use crate::made::JoinReport;
use crate::ops::join::{self, Seam};
use crate::recipe::Repeat;
use crate::work::{Group, Work};

/// How long the way back to the start takes where nothing is said, in seconds.
const GAP: f64 = 0.12;

/// Plays the movement `times` times.
pub(crate) fn repeat(
    work: &mut Work,
    settings: &Repeat,
    course: &Course,
    operator: &str,
) -> Result<(Vec<String>, Vec<JoinReport>), Cause> {
    let seconds = settings
        .gap
        .or(settings.via.time)
        .map_or(GAP, |time| time.0);
    let gap = (seconds / work.rate.frame_time()).round() as usize;
    let times = settings.times as usize;
    join::check_length(work, times.saturating_mul(work.frames + gap))?;
    let once = work.clone();
    let mut joins = Vec::new();
    for n in 1..times {
        let next = once.clone();
        let seam = Seam::plain(work, gap);
        let what = format!("repetition {} to {}", n, n + 1);
        joins.extend(join::join(work, next, &seam, course, &what)?);
    }
    if times > 1 {
        work.changed(Group::ALL, operator);
    }
    Ok((vec![format!("{times} times, {gap} frames between")], joins))
}
