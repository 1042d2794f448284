//! Movement from notation: HamNoSys and SiGML on any body.
//!
//! After Kennaway, *Avatar-independent scripting for real-time gesture animation*. A sign's tree
//! becomes events of either hand (ways, turns, shapes, each with its course), events become frames,
//! and the arms follow the hands by the rules of `arm`.
//!
//! | module | holds |
//! |---|---|
//! | `plan` | from the tree to events: postures, transitions, who acts in which frame |
//! | `place` | where hands are: on the body, in space, by each other |
//! | `motion` | motions, repetitions, sequences |
//! | `path`, `pace` | ways through space; how they run in time |
//! | `stage` | the body: its surface, points of its hands |
//! | `thumb`, `rest` | the thumb of a pinch; hands at rest |
//! | `arm` | elbow, collar bone, wrist |
//! | `track` | from events to frames |
//! | `notes` | what is said about the movement |

mod arm;
mod motion;
mod notes;
mod pace;
mod path;
mod place;
mod plan;
mod rest;
mod stage;
#[cfg(test)]
mod tests;
mod thumb;
mod track;

use std::sync::Arc;

use chereme_motion::{Channel, Clip, ClipError, Rate, Side};
use chereme_sign::hamnosys::{BodyLanguage, Notated};

use crate::made::{ChannelReport, Made, Report, StepReport};
use crate::sources::Material;
use crate::work::Group;

use pace::Paces;
use plan::{Plan, Planner};
use stage::Stage;
use track::{Fit, Track};

/// The most frames that are made at once: ten minutes at 120 Hz.
const MOST_FRAMES: usize = 72_000;

/// How notation is animated.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// The frames per second.
    pub rate: Rate,
    /// What the categories of notation mean in numbers.
    pub language: BodyLanguage,
}

impl Default for Settings {
    /// 60 frames a second, in the program's own body language.
    fn default() -> Self {
        Self {
            rate: Rate::new(60, 1).expect("sixty a second is a rate"),
            language: BodyLanguage::usual().clone(),
        }
    }
}

/// Why notation cannot be animated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NotationError {
    /// The body has no arm.
    #[error(
        "the body of {0:?} has no arm with shoulder, elbow and wrist; name them in a roles file"
    )]
    NoArm(String),
    /// The movement would be too long.
    #[error("the movement would last {seconds:.0} s; {most:.0} s can be made at once")]
    Long {
        /// How long it would be.
        seconds: f64,
        /// How long it may be.
        most: f64,
    },
    /// A number is none.
    #[error(transparent)]
    Clip(#[from] ClipError),
}

/// Makes the movement of signs one after the other, from rest and back to rest.
///
/// The body is that of `stage`'s first frame; its trunk, head and legs stay as they are there. The
/// same signs on the same stage give the same movement.
///
/// # Errors
/// [`NotationError`] where the body has no arm, or the movement would be too long.
pub fn animate(
    signs: &[&Notated],
    stage: &Material,
    settings: &Settings,
) -> Result<Made, NotationError> {
    let body = Stage::of(stage).ok_or_else(|| NotationError::NoArm(stage.address.clone()))?;
    let planner = Planner::new(&body, &settings.language, stage.handedness);
    let limits = planner.limits;
    let sides = planner.sides;
    let plan = planner.signs(signs);
    let rate = settings.rate;
    let total = (plan.end * rate.per_second()).ceil() as usize + 1;
    if total > MOST_FRAMES {
        return Err(NotationError::Long {
            seconds: plan.end,
            most: MOST_FRAMES as f64 / rate.per_second(),
        });
    }
    let paces = Paces::of(&settings.language);
    let mut channels = standing(&body, total);
    let mut fits = [None; 2];
    for (n, side) in sides.into_iter().enumerate() {
        let Some(hand) = body.hand(side) else {
            continue;
        };
        let timing = track::Timing {
            paces: &paces,
            rate: rate.per_second(),
            total,
        };
        let track = track::track(&body, hand, &plan, n, &limits, &timing);
        fits[n] = Some(track.fit);
        lay(&mut channels, hand, track);
    }
    let clip = Clip::new(Arc::clone(&body.skeleton), rate, channels)?;
    let report = report(signs, &plan, sides, fits);
    Ok(Made {
        notes: notes::notes(signs, &plan, sides, &clip),
        clip,
        anatomy: Arc::clone(&body.anatomy),
        handedness: stage.handedness,
        signer: stage.signer.clone(),
        report,
    })
}

/// Returns channels in which the body stands still.
fn standing(body: &Stage, total: usize) -> Vec<Channel> {
    let joints = body.skeleton.joints().iter().enumerate();
    joints
        .map(|(n, joint)| {
            let at = body.base.translations[n];
            Channel {
                rotations: vec![body.base.rotations[n]; total],
                translations: (at != joint.offset).then(|| vec![at; total]),
            }
        })
        .collect()
}

fn lay(channels: &mut [Channel], hand: &stage::Hand, track: Track) {
    for (joint, column) in hand.rig.joints().into_iter().zip(track.arm) {
        if let Some(joint) = joint {
            channels[joint].rotations = column;
        }
    }
    for (&joint, column) in hand.fingers.iter().zip(track.fingers) {
        channels[joint].rotations = column;
    }
}

fn report(signs: &[&Notated], plan: &Plan, sides: [Side; 2], fits: [Option<Fit>; 2]) -> Report {
    let mut report = Report::default();
    for (n, sign) in signs.iter().enumerate() {
        let span = &plan.signs[n];
        report.steps.push(StepReport {
            path: format!("/signs/{n}"),
            step: sign.gloss.clone(),
            did: vec![format!("{:.2} s to {:.2} s", span.from, span.to)],
            residual: fits
                .iter()
                .flatten()
                .map(|fit| fit.residual)
                .reduce(f64::max),
        });
    }
    let moved = |side: Side| {
        let n = usize::from(sides[1] == side);
        !plan.events[n].is_empty()
    };
    report.channels = Group::ALL
        .into_iter()
        .map(|group| ChannelReport {
            channel: group.name(),
            from: match group {
                Group::Arm(side) | Group::Fingers(side) if moved(side) => {
                    vec!["notation".to_owned()]
                }
                _ => vec!["the stage".to_owned()],
            },
        })
        .collect();
    report.warnings.extend(plan.remarks.iter().cloned());
    for (side, fit) in sides.into_iter().zip(fits) {
        let Some(fit) = fit else { continue };
        if fit.residual > 2e-3 {
            report.warnings.push(format!(
                "the {} hand stays {:.1} cm short of its place",
                side.name(),
                fit.residual * 100.0
            ));
        }
        if fit.turned > 0.05 {
            report.warnings.push(format!(
                "the {} hand is turned up to {:.0}° less than written: the wrist goes no farther",
                side.name(),
                fit.turned.to_degrees()
            ));
        }
        if fit.pushed > 5e-3 {
            report.warnings.push(format!(
                "the {} hand was moved {:.1} cm out of the trunk",
                side.name(),
                fit.pushed * 100.0
            ));
        }
    }
    report
}
