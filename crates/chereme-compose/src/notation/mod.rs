//! Animates notation: HamNoSys and SiGML, on any body.
//!
//! Follows Kennaway, *Avatar-independent scripting for real-time gesture animation*. The planner turns a
//! sign's tree into events of each hand (paths, turns, shapes, each with its pace), the tracks turn events
//! into frames, and the arms follow the hands by the rules of `arm`.
//!
//! | module | holds |
//! |---|---|
//! | `plan` | from the tree to events: postures, transitions, acting hands and their frames |
//! | `orient` | directions and palms of hands |
//! | `duration` | signs whose speed or duration is written |
//! | `transit` | transitions of hands from one state to another |
//! | `approach` | transitions to movements, no faster than these |
//! | `place` | positions of hands: on the body, in space, in constellations |
//! | `touch` | the fit of a hand to the trunk's surface in contact |
//! | `comfort` | shifts of hands within their place for the comfort of the arm |
//! | `motion`, `wrist_cycle` | motions, repetitions, sequences; movement about the wrist |
//! | `path`, `pace` | paths through space; their course in time |
//! | `stage` | the body: its surface, points of its hands |
//! | `thumb`, `crossed`, `rest`, `lift` | the thumb of a pinch; crossed fingers; hands at rest; arms raised to be touched |
//! | `arm` | elbow, collar bone, wrist |
//! | `track`, `outlines` | from events to the goals and outlines of the hands in each frame |
//! | `hands_apart` | separation of two hands whose paths would pass through each other |
//! | `bulk` | separation of two hands that would penetrate each other |
//! | `skull` | the head as an obstacle, and hands that go round it |
//! | `freedom` | over time: the arm's plane and its shoulder |
//! | `solve`, `solve_frame` | from goals to postures of an arm, without jumps |
//! | `push_out` | removal of remaining intersections with the trunk |
//! | `perform` | one sign after another on the same body, or their first postures alone |
//! | `stretch_time` | stretches of time for arms that would move too fast |
//! | `life` | sway, head and eyes that follow the hands, blinks |
//! | `nonmanual` | head, trunk, shoulders; the curves of all non-manuals |
//! | `notes` | annotations of the synthesised movement |
//! | `tuned` | the tuned numbers, which are data: `schema/notation/animating.json` |

#[cfg(test)]
mod apart_tests;
mod approach;
mod comfort;
mod crossed;
#[cfg(test)]
mod crossed_tests;
mod duration;
#[cfg(test)]
mod ease_tests;
mod freedom;
mod hands_apart;
mod lean;
mod life;
mod lift;
#[cfg(test)]
mod natural_tests;
mod notation_arm;
mod notation_bulk;
mod notation_motion;
pub(crate) mod notation_nonmanual;
mod notation_orient;
mod notation_path;
mod notation_place;
pub(crate) mod notation_plan;
mod notation_solve;
pub(crate) mod notation_stage;
mod notation_track;
mod notation_tuned;
mod notes;
mod outlines;
mod own_side;
mod pace;
mod perform;
mod push_out;
mod rest;
pub(crate) mod skull;
mod solve_frame;
mod stretch_time;
#[cfg(test)]
mod tempo_tests;
#[cfg(test)]
mod tests;
mod thumb;
mod touch;
mod transit;
mod wrist_cycle;

use std::sync::Arc;

use chereme_motion::{BodySide, Clip, FrameRate, JointChannel};
use chereme_sign::hamnosys::{BodyLanguage, NonmanualPart, NotatedSign};

pub use crate::error::NotationError;
use crate::outcome::{ChannelReport, GeneratedMovement, GenerationReport, HandReport, StepReport};
use crate::sources::MovementMaterial;
use crate::work::JointGroup;

use hands_apart::PartedMoment;
use life::BodyLifeRotations;
use notation_plan::{SignPlan, SignPlanner};
use notation_stage::StandingBody;
use notation_track::{AnimationTiming, ArmTrack, HandGoalFit, HandGoalFrames};
use notation_tuned::tuned;
use pace::PaceTables;
pub use perform::SignPerformer;
use stretch_time::{TimeWarp, TopArmSpeeds};

/// The most frames of one animation: ten minutes at 120 Hz.
const MAX_ANIMATION_FRAMES: usize = 72_000;

/// The number of times that finished movement may be stretched again.
const MAX_RESTRETCH_ROUNDS: usize = 4;

/// Settings of the animator.
#[derive(Debug, Clone, PartialEq)]
pub struct AnimatorSettings {
    /// Frames per second.
    pub rate: FrameRate,
    /// The body language: the meaning of each category of notation in numbers.
    pub language: BodyLanguage,
}

impl Default for AnimatorSettings {
    /// 60 frames per second, in the program's own body language.
    fn default() -> Self {
        Self {
            rate: FrameRate::new(60, 1).expect("sixty a second is a rate"),
            language: BodyLanguage::default_body_language().clone(),
        }
    }
}

/// Synthesises the movement of signs one after the other, from rest and back to rest.
///
/// The body is that of `stage`'s first frame; trunk, head and shoulders follow the non-manual tiers, and the legs stay
/// in place. The same signs on the same stage give the same movement.
///
/// # Errors
/// [`NotationError`] if the body has no arm, or the movement would be too long.
pub fn animate_signs(
    signs: &[&NotatedSign],
    stage: &MovementMaterial,
    settings: &AnimatorSettings,
) -> Result<GeneratedMovement, NotationError> {
    let body = StandingBody::body_from_material(stage).ok_or_else(|| NotationError::NoArm(stage.address.clone()))?;
    let rate = settings.rate.per_second();
    let paces = PaceTables::pace_tables_from_language(&settings.language);
    let language = &settings.language;
    let planner = || SignPlanner::new(&body, language, &paces, stage.handedness, rate);
    let limits = planner().signer.limits;
    let (mut plan, asked) = duration::plan_timed(signs, |signs| planner().plan_signs(signs));
    let sides = plan.sides;
    let total = frames_for_duration(plan.end, rate)?;
    let timing = notation_track::AnimationTiming {
        paces: &paces,
        rate,
        total,
    };
    let hands = sides.map(|side| body.hand_of_side(side));
    let BothHandGoals {
        alive,
        wanted,
        parted,
        cleared,
        round_head,
    } = BothHandGoals::goals_from_plan(&body, signs, &plan, &settings.language, &timing);
    let mut wanted = wanted.map(Some);
    let made_tracks = [0, 1].map(|n| {
        let (hand, wanted) = (hands[n]?, wanted[n].take()?);
        let made = notation_track::SolvedFrames::solve_hand_frames(&body, hand, &plan, n, wanted, &limits, &timing);
        Some(made)
    });
    let arms: Vec<&notation_track::SolvedFrames<'_>> = made_tracks.iter().flatten().collect();
    let left = match (hands, arms.as_slice()) {
        ([Some(hand), _], &[first, second]) if !plan.laced => {
            notation_bulk::remaining_hand_depth(hand.staged_hand_length(), [first, second])
        }
        _ => None,
    };
    let crossed_forearms = match arms.as_slice() {
        &[first, second] => notation_bulk::remaining_forearm_depth(body.arm, [first, second]),
        _ => None,
    };
    let moved: Vec<_> = arms.iter().map(|made| made.solved_arm_movement()).collect();
    let mut moved_arms = moved.iter().copied();
    let solved = [0, 1].map(|n| made_tracks[n].as_ref().and_then(|_| moved_arms.next()));
    let longest = settings.language.time_approach_most;
    let least = approach::unhurried_step_factors(&plan, solved, rate, longest);
    let anchors = approach::approach_end_frames(&plan, rate);
    let fastest = fastest(&settings.language, &body);
    let warp = TimeWarp::warp_within_speeds(&moved, rate, &fastest, least, &anchors, |arm, n| {
        arms[arm].fastest_step_motion(n)
    });
    let mut tracks = made_tracks.map(|made| made.map(|made| made.into_stretched_track(&warp)));
    let most = TopArmSpeeds {
        joint: fastest.joint / tuned().tempo.easy,
        wrist: fastest.wrist / tuned().tempo.easy,
    };
    let mut warp = warp;
    for _ in 0..MAX_RESTRETCH_ROUNDS {
        let hand_tracks = hands.iter().zip(&tracks);
        let arms = hand_tracks.filter_map(|(hand, track)| Some(track.as_ref()?.moving_arm_frames((*hand)?)));
        let further_warp = TimeWarp::warp_finished_frames(&arms.collect::<Vec<_>>(), rate, &most);
        if further_warp.is_none() {
            break;
        }
        tracks = tracks.map(|track| track.map(|track| track.stretch_arm_track(&further_warp)));
        warp = warp.compose_warps(&further_warp);
    }
    let least = frames_for_duration(warp.stretched_time_at(plan.end), rate)?;
    let track_lengths = tracks.iter().flatten().map(|track| track.arm[0].len());
    let total = track_lengths.max().unwrap_or(least);
    let mut channels = standing_channels(&body, total);
    let mut fits = [None; 2];
    for (n, track) in tracks.into_iter().enumerate() {
        let (Some(hand), Some(track)) = (hands[n], track) else {
            continue;
        };
        fits[n] = Some(track.fit);
        lay_arm_track(&mut channels, hand, track);
    }
    if let Some(left) = left {
        plan.remarks
            .push(format!("the hands remain {:.1} cm deep in each other", left * 100.0));
    }
    if let Some(deep) = crossed_forearms {
        plan.remarks
            .push(format!("the forearms remain {:.1} cm deep in each other", deep * 100.0));
    }
    if let Some(parted) = farther(parted, cleared) {
        plan.remarks.push(format!(
            "the hands would go through each other at {:.2} s: each moves {:.1} cm aside",
            warp.stretched_time_at(parted.time),
            parted.by * 100.0
        ));
    }
    for (side, moved) in sides.into_iter().zip(round_head) {
        let Some(moved) = moved else { continue };
        plan.remarks.push(format!(
            "the {} hand would go through the head at {:.2} s: it moves {:.1} cm aside",
            side.body_side_name(),
            warp.stretched_time_at(moved.time),
            moved.by * 100.0
        ));
    }
    plan.stretch_plan_times(&warp);
    plan.remarks.extend(duration::missed_durations(&plan.signs, &asked));
    let language = &settings.language;
    let planned = match warp.is_none() {
        true => (0..total).map(|n| (n, 0.0)).collect(),
        false => warp.stretched_frames(),
    };
    notation_nonmanual::turn_body_joints(&body, &alive.bents, &planned, &mut channels);
    let clip = Clip::new(Arc::clone(&body.skeleton), settings.rate, channels)?;
    let report = report_animation(signs, &plan, sides, fits);
    let mut curves = notation_nonmanual::nonmanual_curves(signs, &plan.signs, language, rate, total);
    let more = alive.eye_and_lid_curves(signs, &plan.signs, language, rate, &planned);
    curves.extend(more.into_iter().map(|mut curve| {
        let last = curve.values.last().copied().unwrap_or_default();
        curve.values.resize(total, last);
        curve
    }));
    Ok(GeneratedMovement {
        curves,
        notes: notes::write_sign_notes(signs, &plan, sides, &clip, &warp),
        clip,
        anatomy: Arc::clone(&body.anatomy),
        handedness: stage.handedness,
        signer: stage.signer.clone(),
        report,
    })
}

/// The goals of both hands of signs in each frame, before the arms are solved.
struct BothHandGoals<'a> {
    alive: BodyLifeRotations,
    wanted: [HandGoalFrames<'a>; 2],
    /// The separation of hands that pass each other, or that reach beyond the middle.
    parted: Option<PartedMoment>,
    /// The separation of hands that would penetrate each other.
    cleared: Option<PartedMoment>,
    /// The displacement of each hand that would go through the head.
    round_head: [Option<PartedMoment>; 2],
}

impl<'a> BothHandGoals<'a> {
    /// Turns a plan into goals, with the body's sway, and moves two hands out of each other.
    fn goals_from_plan(
        body: &'a StandingBody,
        signs: &[&NotatedSign],
        plan: &'a SignPlan,
        language: &BodyLanguage,
        timing: &AnimationTiming<'_>,
    ) -> Self {
        let rate = timing.rate;
        let hands = plan.sides.map(|side| body.hand_of_side(side));
        let [mut first, mut second] = [0, 1].map(|n| notation_track::goal_frames_from_plan(body, plan, n, timing));
        let mut parted = None;
        if let [Some(a), Some(b)] = hands {
            parted = own_side::keep_hands_own_side(body, plan, [a, b], [&mut first, &mut second], rate);
        }
        let round_head = [&mut first, &mut second].map(|one| skull::go_round(body, one, rate));
        let alive = BodyLifeRotations::plan_body_life(body, signs, plan, language, [&first, &second], rate);
        for (wanted, side) in [&mut first, &mut second].into_iter().zip(plan.sides) {
            alive.carry_hands_with_head(body, side, wanted);
        }
        let mut cleared = None;
        if let [Some(a), Some(b)] = hands {
            let passed = hands_apart::part_passing_hands(body, [a, b], [&mut first, &mut second], rate);
            parted = farther(parted, passed);
            if !plan.laced {
                let both = [&mut first, &mut second];
                cleared = notation_bulk::clear_overlapping_hands(body, [a, b], both, &plan.contacts, rate);
            }
        }
        Self {
            alive,
            wanted: [first, second],
            parted,
            cleared,
            round_head,
        }
    }
}

/// Returns the separation in which each hand moves farther.
fn farther(a: Option<PartedMoment>, b: Option<PartedMoment>) -> Option<PartedMoment> {
    let both = a.into_iter().chain(b);
    both.max_by(|a, b| a.by.total_cmp(&b.by))
}

/// Returns the number of frames for a duration in seconds.
fn frames_for_duration(seconds: f64, rate: f64) -> Result<usize, NotationError> {
    let total = (seconds * rate - 1e-9).ceil() as usize + 1;
    if total > MAX_ANIMATION_FRAMES {
        return Err(NotationError::Long {
            seconds,
            most: MAX_ANIMATION_FRAMES as f64 / rate,
        });
    }
    Ok(total)
}

/// Returns the top speeds for the solver: a little below the allowed ones, so that speeds measured between
/// frames stay within them.
fn fastest(language: &BodyLanguage, body: &StandingBody) -> TopArmSpeeds {
    TopArmSpeeds {
        joint: tuned().tempo.easy * language.speed_joint,
        wrist: tuned().tempo.easy * language.speed_wrist * body.arm,
    }
}

/// Returns the channels of a body that stands still.
fn standing_channels(body: &StandingBody, total: usize) -> Vec<JointChannel> {
    let joints = body.skeleton.skeleton_joints().iter().enumerate();
    joints
        .map(|(n, joint)| {
            let base_translation = body.base.translations[n];
            JointChannel {
                rotations: vec![body.base.rotations[n]; total],
                translations: (base_translation != joint.offset).then(|| vec![base_translation; total]),
            }
        })
        .collect()
}

fn lay_arm_track(channels: &mut [JointChannel], hand: &notation_stage::StagedHand, track: ArmTrack) {
    for (joint, column) in hand.rig.arm_joint_indices().into_iter().zip(track.arm) {
        if let Some(joint) = joint {
            channels[joint].rotations = column;
        }
    }
    for (&joint, column) in hand.fingers.iter().zip(track.fingers) {
        channels[joint].rotations = column;
    }
}

fn report_animation(
    signs: &[&NotatedSign],
    plan: &SignPlan,
    sides: [BodySide; 2],
    fits: [Option<HandGoalFit>; 2],
) -> GenerationReport {
    let mut report = GenerationReport::default();
    let hands = sides.into_iter().zip(fits).filter_map(|(hand, fit)| {
        let fit = fit?;
        Some(HandReport {
            hand,
            off_m: fit.residual,
            short_m: fit.parted,
            turned_deg: fit.turned.to_degrees(),
            pushed_m: fit.pushed,
        })
    });
    let hands: Vec<HandReport> = hands.collect();
    for (n, sign) in signs.iter().enumerate() {
        let span = &plan.signs[n];
        report.steps.push(StepReport {
            path: format!("/signs/{n}"),
            step: sign.gloss.clone(),
            did: vec![format!("{:.2} s to {:.2} s", span.from, span.to)],
            residual: fits.iter().flatten().map(|fit| fit.residual).reduce(f64::max),
            moved: None,
            language: None,
            hands: hands.clone(),
            touches: Vec::new(),
        });
    }
    let moved = |side: BodySide| {
        let n = usize::from(sides[1] == side);
        !plan.events[n].is_empty()
    };
    let mut unknown: Vec<String> = signs
        .iter()
        .flat_map(|sign| sign.nonmanual.acts_by_tier())
        .filter(|(_, act)| act.part == NonmanualPart::Extra || !act.is_listed())
        .map(|(_, act)| act.act_curve_name())
        .collect();
    unknown.sort_unstable();
    unknown.dedup();
    if !unknown.is_empty() {
        let names = unknown.join(", ");
        let remark = format!("the animator does not know these non-manuals: {names}");
        report.warnings.push(remark);
    }
    let acts = |part: NonmanualPart| {
        let mut all = signs.iter().flat_map(|sign| sign.nonmanual.acts_by_tier());
        all.any(|(_, act)| act.part == part)
    };
    report.channels = JointGroup::ALL_JOINT_GROUPS
        .into_iter()
        .map(|group| ChannelReport {
            channel: group.joint_group_name(),
            from: match group {
                JointGroup::Arm(side) | JointGroup::Fingers(side) if moved(side) => {
                    vec!["notation".to_owned()]
                }
                JointGroup::Head if acts(NonmanualPart::Head) => vec!["notation".to_owned()],
                JointGroup::Trunk if acts(NonmanualPart::Body) => vec!["notation".to_owned()],
                _ => vec!["the stage".to_owned()],
            },
        })
        .collect();
    report.warnings.extend(plan.remarks.iter().cloned());
    for (side, fit) in sides.into_iter().zip(fits) {
        let Some(fit) = fit else { continue };
        if fit.parted > 2e-3 {
            report.warnings.push(format!(
                "the {} hand stays {:.1} cm short of its contact",
                side.body_side_name(),
                fit.parted * 100.0
            ));
        }
        if fit.residual > fit.parted.max(5e-3) {
            report.warnings.push(format!(
                "the {} hand stays up to {:.1} cm off its path",
                side.body_side_name(),
                fit.residual * 100.0
            ));
        }
        if let Some(hindrance) = fit.hindered {
            report.warnings.push(format!(
                "the {} hand is turned up to {:.0}° less than written: {}",
                side.body_side_name(),
                fit.turned.to_degrees(),
                hindrance.describe_hindrance()
            ));
        }
        if fit.pushed > 5e-3 {
            report.warnings.push(format!(
                "the {} hand was moved {:.1} cm out of the trunk",
                side.body_side_name(),
                fit.pushed * 100.0
            ));
        }
    }
    report
}
