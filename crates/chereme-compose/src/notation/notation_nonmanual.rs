//! Animates head, trunk and shoulders, and computes the curve of each non-manual.
//!
//! Every act is a curve from 0 to 1: an attack before the sign begins, a sustained part, and a release
//! after the sign. Acts of one tier that follow one another share the sign's time. The curves of head,
//! trunk and shoulders turn joints; those of gaze, brows, lids, nose and mouth are passed on unchanged.

use std::f64::consts::{PI, TAU};

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::interpolation::smooth_step;
use chereme_motion::{BodyPart, BodySide, JointChannel};
use chereme_sign::hamnosys::{
    BodyLanguage, NonmanualAct, NonmanualPart, NonmanualTier, NotatedSign, TierEnd, TierStart,
};

use super::notation_plan::SignSpan;
use super::notation_stage::StandingBody;
use super::notation_tuned::tuned;
use crate::outcome::GeneratedCurve;

/// The duration (s) of a single nod, there and back, as measured in the movement of another animator.
const SINGLE_NOD_S: f64 = 0.62;

/// One act with its times, in seconds.
struct TimedAct<'a> {
    act: &'a NonmanualAct,
    from: f64,
    to: f64,
    attack: f64,
    release: f64,
    /// How often it is written at this moment: three shakes are one act that shakes three times.
    times: usize,
}

impl TimedAct<'_> {
    /// Returns its intensity at a time, from 0 to 1.
    fn act_intensity_at(&self, time: f64) -> f64 {
        intensity_over_span(time, [self.from, self.to], [self.attack, self.release])
    }

    /// Begins a nod or a shake earlier and ends it later if the hands leave too little time for it.
    fn stretch_head_act(&mut self, speed: f64) {
        let needs = cycles(self) / (tuned().nonmanual.shakes * speed);
        let missing = (needs - (self.to - self.from)).max(0.0);
        let [before, after] = tuned().nonmanual.spread;
        self.from -= missing * before;
        self.to += missing * after;
    }

    /// Ends single nods after their own time, and begins them earlier if the hands leave too little time.
    fn end_single_nod(&mut self, speed: f64) {
        let needs = SINGLE_NOD_S * self.times as f64 / speed;
        let missing = (needs - (self.to - self.from)).max(0.0);
        self.from -= missing * tuned().nonmanual.spread[0];
        self.to = self.from + needs;
    }

    /// Returns the elapsed share of its duration.
    fn elapsed_act_share(&self, time: f64) -> f64 {
        ((time - self.from) / (self.to - self.from).max(1e-6)).clamp(0.0, 1.0)
    }
}

/// Rotations of body parts at one moment, in radians about each axis (left, up, forward).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct BodyBend {
    /// The rotation of the head.
    pub(crate) head: DVec3,
    /// The rotation of the lowest joint of the neck.
    pub(crate) neck: DVec3,
    /// The rotation of the trunk.
    pub(crate) trunk: DVec3,
    /// Angles by which the right and left collar bones are raised (rad).
    raised: [f64; 2],
    /// Angles by which they are brought forward (rad).
    hunched: [f64; 2],
}

/// The degree to which written acts control each part of the body, from 0 to 1.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct ActControl {
    pub(crate) head: f64,
    pub(crate) trunk: f64,
}

/// Returns the intensity of each non-manual in each frame.
pub(crate) fn nonmanual_curves(
    signs: &[&NotatedSign],
    spans: &[SignSpan],
    language: &BodyLanguage,
    rate: f64,
    total: usize,
) -> Vec<GeneratedCurve> {
    let mut curves: Vec<GeneratedCurve> = Vec::new();
    for timed in all_timed_acts(signs, spans, language) {
        let name = timed.act.act_curve_name();
        let curve_position = curves.iter().position(|curve| curve.name == name);
        let n = curve_position.unwrap_or_else(|| {
            curves.push(GeneratedCurve {
                name,
                values: vec![0.0; total],
            });
            curves.len() - 1
        });
        for (frame, value) in curves[n].values.iter_mut().enumerate() {
            let now = timed.act_intensity_at(frame as f64 / rate) * act_amount(timed.act);
            *value = value.max(now.min(1.0));
        }
    }
    curves
}

/// Returns the weight of an act over a span of time, in seconds, in each of `total` frames: 1 within the span, less in the
/// attack before it and in the release after it.
pub(crate) fn weights_over_span(span: [f64; 2], rate: f64, total: usize) -> Vec<f64> {
    let language = BodyLanguage::default_body_language();
    let blends = [language.time_attack, language.time_release];
    let frames = 0..total;
    frames
        .map(|frame| intensity_over_span(frame as f64 / rate, span, blends))
        .collect()
}

/// Returns the rotations of the written acts in each frame, and the degree to which the acts control head and trunk.
pub(crate) fn written_body_bends(
    signs: &[&NotatedSign],
    spans: &[SignSpan],
    language: &BodyLanguage,
    rate: f64,
    total: usize,
) -> (Vec<BodyBend>, Vec<ActControl>) {
    let acts = all_timed_acts(signs, spans, language);
    let each = (0..total).map(|frame| {
        let time = frame as f64 / rate;
        (sum_body_bend(&acts, time), busy(&acts, time))
    });
    each.unzip()
}

fn busy(acts: &[TimedAct<'_>], time: f64) -> ActControl {
    let mut busy = ActControl::default();
    for timed in acts {
        match timed.act.part {
            NonmanualPart::Head => busy.head = busy.head.max(timed.act_intensity_at(time)),
            NonmanualPart::Body => busy.trunk = busy.trunk.max(timed.act_intensity_at(time)),
            _ => {}
        }
    }
    busy
}

/// Rotates the joints of head, trunk and shoulders in stretched time; the arms move with the trunk. `frames` are the
/// planned frames.
pub(crate) fn turn_body_joints(
    body: &StandingBody,
    bents: &[BodyBend],
    frames: &[(usize, f64)],
    channels: &mut [JointChannel],
) {
    let total = channels.first().map_or(0, |channel| channel.rotations.len());
    let joints = TurnedJoints::find_turned_joints(body);
    for frame in 0..total {
        let (n, share) = frames.get(frame).or(frames.last()).copied().unwrap_or_default();
        let frame_bend = |n: usize| bents.get(n).or(bents.last()).copied().unwrap_or_default();
        let bent = frame_bend(n).mix_body_bends(&frame_bend(n + 1), share);
        if bent != BodyBend::default() {
            joints.bend_frame_joints(body, &bent, frame, channels);
        }
    }
}

/// A joint with the rotation of its parent on the standing body, in model space.
#[derive(Clone, Copy)]
struct TurnedJoint {
    joint: usize,
    above: DQuat,
}

impl TurnedJoint {
    fn find_turned_joint(body: &StandingBody, part: BodyPart) -> Option<Self> {
        let joint = body.anatomy.part_joint(part)?;
        let parent_joint = body.skeleton.joint_parent(joint);
        let above = parent_joint.map_or(DQuat::IDENTITY, |above| body.model.model_joint_rotation(above));
        Some(Self { joint, above })
    }
}

/// The joints of trunk, head and shoulders.
struct TurnedJoints {
    /// The lower and the upper joint of the trunk.
    trunk: [Option<TurnedJoint>; 2],
    neck: Option<TurnedJoint>,
    head: Option<TurnedJoint>,
    /// The collar bone and the upper arm of each side.
    shoulders: [[Option<TurnedJoint>; 2]; 2],
}

impl BodyBend {
    /// Returns the rotation of the collar bone on the standing body, in model space.
    pub(crate) fn collar_bone(&self, body: &StandingBody, side: BodySide) -> DQuat {
        let n = usize::from(side == BodySide::BOTH_SIDES[1]);
        let up = body.forward * (self.raised[n] * side.side_sign());
        let ahead = DVec3::Y * (-self.hunched[n] * side.side_sign());
        DQuat::from_scaled_axis(up + ahead)
    }

    fn mix_body_bends(&self, to: &Self, share: f64) -> Self {
        if share == 0.0 || self == to {
            return *self;
        }
        let pair = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|n| a[n] + (b[n] - a[n]) * share);
        Self {
            head: self.head.lerp(to.head, share),
            neck: self.neck.lerp(to.neck, share),
            trunk: self.trunk.lerp(to.trunk, share),
            raised: pair(self.raised, to.raised),
            hunched: pair(self.hunched, to.hunched),
        }
    }
}

/// Returns every act with its time.
fn all_timed_acts<'a>(signs: &[&'a NotatedSign], spans: &[SignSpan], language: &BodyLanguage) -> Vec<TimedAct<'a>> {
    let mut all = Vec::new();
    for (sign, span) in signs.iter().zip(spans) {
        for tier in sign.nonmanual.tiers.values() {
            collect_timed_acts(tier, span, language, &mut all);
        }
    }
    all
}

fn collect_timed_acts<'a>(
    tier: &'a NonmanualTier,
    span: &SignSpan,
    language: &BodyLanguage,
    all: &mut Vec<TimedAct<'a>>,
) {
    let from = span.from
        + match tier.start {
            Some(TierStart::SlightDelay) => tuned().tempo.slightly,
            Some(TierStart::StartSlightlyAhead) => -tuned().tempo.slightly,
            None => 0.0,
        };
    let to = span.to
        + match tier.end {
            Some(TierEnd::LastsLonger) => tuned().tempo.slightly,
            Some(TierEnd::EndsBefore) => -tuned().tempo.slightly,
            None => 0.0,
        };
    let each = (to - from).max(0.05) / tier.groups.len().max(1) as f64;
    for (n, group) in tier.groups.iter().enumerate() {
        let from = from + each * n as f64;
        for (k, act) in group.iter().enumerate() {
            let alike = |other: &&NonmanualAct| other.part == act.part && other.act_code() == act.act_code();
            if group[..k].iter().any(|other| alike(&other)) {
                continue;
            }
            let given_speed = act.speed.filter(|speed| speed.is_finite() && *speed > 0.0);
            let speed = given_speed.unwrap_or(1.0).clamp(0.2, 5.0);
            let mut timed = TimedAct {
                act,
                from,
                to: from + each,
                attack: language.time_attack / speed,
                release: language.time_release / speed,
                times: group.iter().filter(alike).count(),
            };
            if nods_once(act) {
                timed.end_single_nod(speed);
            } else if waves(act) {
                timed.stretch_head_act(speed);
            }
            all.push(timed);
        }
    }
}

fn act_amount(act: &NonmanualAct) -> f64 {
    act.amount
        .filter(|amount| amount.is_finite())
        .map_or(1.0, |amount| amount.clamp(0.0, 2.0))
}

/// Returns the sum of all acts at a time.
fn sum_body_bend(acts: &[TimedAct<'_>], time: f64) -> BodyBend {
    let mut bent = BodyBend::default();
    for timed in acts {
        let much = timed.act_intensity_at(time) * act_amount(timed.act);
        if much == 0.0 {
            continue;
        }
        let wave = match nods_once(timed.act) {
            true => (PI * timed.times as f64 * timed.elapsed_act_share(time)).sin().abs(),
            false => (TAU * cycles(timed) * timed.elapsed_act_share(time)).sin(),
        };
        let angle = |degrees: f64| (degrees * much).to_radians();
        match (timed.act.part, timed.act.act_code()) {
            (NonmanualPart::Head, code) => turn_head(&mut bent, code, angle, wave),
            (NonmanualPart::Body, code) => turn_trunk(&mut bent, code, angle, timed.elapsed_act_share(time)),
            (NonmanualPart::Shoulders, code) => {
                move_shoulders(&mut bent, code, angle, timed.elapsed_act_share(time));
            }
            _ => {}
        }
    }
    bent
}

/// Returns the number of nods or shakes of an act that repeats: two per second, at least two, and at least as many as are written.
fn cycles(timed: &TimedAct<'_>) -> f64 {
    let least = timed.times.max(2) as f64;
    (2.0 * (timed.to - timed.from)).round().max(least)
}

/// Returns whether an act nods or shakes the head again and again.
fn waves(act: &NonmanualAct) -> bool {
    act.part == NonmanualPart::Head && matches!(act.act_code(), "NO" | "SH")
}

/// Returns whether an act nods the head once, down or up.
fn nods_once(act: &NonmanualAct) -> bool {
    act.part == NonmanualPart::Head && matches!(act.act_code(), "ND" | "NU")
}

fn turn_head(bent: &mut BodyBend, code: &str, angle: impl Fn(f64) -> f64, wave: f64) {
    match code {
        "NO" => bent.head.x += angle(11.0) * wave,
        "ND" => bent.head.x += angle(14.0) * wave,
        "NU" => bent.head.x -= angle(12.0) * wave,
        "SH" => bent.head.y += angle(16.0) * wave,
        "SR" => bent.head.y -= angle(28.0),
        "SL" => bent.head.y += angle(28.0),
        "TR" => bent.head.z += angle(14.0),
        "TL" => bent.head.z -= angle(14.0),
        "NF" => bent.head.x += angle(16.0),
        "NB" => bent.head.x -= angle(14.0),
        "PF" => {
            bent.neck.x += angle(14.0);
            bent.head.x -= angle(14.0);
        }
        "PB" => {
            bent.neck.x -= angle(10.0);
            bent.head.x += angle(10.0);
        }
        _ => {}
    }
}

fn turn_trunk(bent: &mut BodyBend, code: &str, angle: impl Fn(f64) -> f64, share: f64) {
    let once = (PI * share).sin();
    match code {
        "RL" => bent.trunk.y += angle(14.0),
        "RR" => bent.trunk.y -= angle(14.0),
        "TL" => bent.trunk.z -= angle(8.0),
        "TR" => bent.trunk.z += angle(8.0),
        "TF" => bent.trunk.x += angle(9.0),
        "TB" => bent.trunk.x -= angle(7.0),
        "RD" => {
            bent.trunk.x += angle(7.0);
            bent.head.x += angle(5.0);
        }
        // A sigh rises and sinks; heaving only rises. A body stands straight by default.
        "SI" => {
            let rise = (TAU * share).sin();
            bent.trunk.x -= angle(3.0) * rise;
            bent.raised = bent.raised.map(|raised| raised + angle(5.0) * rise);
        }
        "HE" => {
            bent.trunk.x -= angle(4.0) * once;
            bent.raised = bent.raised.map(|raised| raised + angle(6.0) * once);
        }
        _ => {}
    }
}

fn move_shoulders(bent: &mut BodyBend, code: &str, angle: impl Fn(f64) -> f64, share: f64) {
    let mut letters = code.chars();
    let (what, side) = (letters.next(), letters.next());
    let once = (PI * share).sin();
    for (n, own) in ['R', 'L'].into_iter().enumerate() {
        if side != Some(own) && side != Some('B') {
            continue;
        }
        match what {
            Some('U') => bent.raised[n] += angle(11.0),
            Some('H') => bent.hunched[n] += angle(13.0),
            Some('S') => bent.raised[n] += angle(13.0) * once,
            _ => {}
        }
    }
}

impl TurnedJoints {
    fn find_turned_joints(body: &StandingBody) -> Self {
        let joint = |part| TurnedJoint::find_turned_joint(body, part);
        let (lower, chest) = (joint(BodyPart::Spine), joint(BodyPart::Chest));
        let apart = |upper: &TurnedJoint| lower.is_some_and(|lower| lower.joint != upper.joint);
        Self {
            trunk: [lower.or(chest), chest.filter(apart)],
            neck: joint(BodyPart::Neck),
            head: joint(BodyPart::Head),
            shoulders: BodySide::BOTH_SIDES.map(|side| [BodyPart::Clavicle(side), BodyPart::UpperArm(side)].map(joint)),
        }
    }

    /// Rotates the joints of one frame.
    fn bend_frame_joints(&self, body: &StandingBody, bent: &BodyBend, frame: usize, channels: &mut [JointChannel]) {
        let axes = |v: DVec3| body.left * v.x + DVec3::Y * v.y + body.forward * v.z;
        let mut turn = |joint: Option<TurnedJoint>, by: DQuat| {
            let Some(TurnedJoint { joint, above }) = joint else {
                return;
            };
            let joint_rotation = &mut channels[joint].rotations[frame];
            *joint_rotation = (above.inverse() * by * above * *joint_rotation).normalize();
        };
        let each = if self.trunk[1].is_some() { 0.5 } else { 1.0 };
        let trunk = DQuat::from_scaled_axis(axes(bent.trunk) * each);
        for joint in self.trunk {
            turn(joint, trunk);
        }
        turn(self.neck, DQuat::from_scaled_axis(axes(bent.neck)));
        turn(self.head, DQuat::from_scaled_axis(axes(bent.head)));
        for (n, side) in BodySide::BOTH_SIDES.into_iter().enumerate() {
            // The upper arm keeps its direction: the whole arm moves with the shoulder.
            let by = bent.collar_bone(body, side);
            let [clavicle, upper_arm] = self.shoulders[n];
            if by == DQuat::IDENTITY || clavicle.is_none() {
                continue;
            }
            turn(clavicle, by);
            turn(upper_arm, by.inverse());
        }
    }
}

/// Returns the intensity at a time of an act over a span, with its attack before and its release after it, in seconds.
fn intensity_over_span(time: f64, [from, to]: [f64; 2], [attack, release]: [f64; 2]) -> f64 {
    let rise = (time - from + attack) / attack.max(1e-6);
    let fall = (to + release - time) / release.max(1e-6);
    smooth_step(rise).min(smooth_step(fall))
}
