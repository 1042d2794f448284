//! The faults that make synthesised movement look unlike a person's, judged sign by sign.

mod arms;

use arms::{akimbo, behind, folded, lifted, pumping, raised, standing_out, wandering};
use chereme_compose::notation::{AnimatorSettings, animate_signs};
use chereme_compose::{GeneratedMovement, MovementMaterial, NoteSubject};
use chereme_motion::glam::DVec3;
use chereme_motion::{BodyPart, BodySide, ModelPose, TimeSpan};
use chereme_sign::hamnosys::{HandPlace, MotionKind, NonmanualPart, NotatedSign, PlaceContact, WristMotion};
use chereme_sign::{ComponentReading, SignComponent};

use crate::Result;
use crate::bulk::{Hand, Skull, Tube, deepest};
use crate::checks::Trunk;
use crate::walk::{each_motion, interlocked, places, with_motions};

/// One fault: its name, and a function that reports whether a sign has it; `None` if it cannot occur in the sign.
pub(crate) type Judge = (&'static str, fn(&Seen<'_>) -> Option<bool>);

pub(crate) const FAULTS: [Judge; 25] = [
    ("a thumb across lies more than 3 mm off its finger or palm", thumb_off),
    ("the approach is faster than the stroke", hasty),
    (
        "strokes take less than 30 % of the time from first movement to last",
        short_stroke,
    ),
    ("head or trunk stand still", frozen),
    ("lids never move", unblinking),
    ("hands pass 8 mm or more into each other, unreported", merged),
    ("the same, reported or not", merged_at_all),
    ("an elbow's path is over 1.5 of its wrist's", pumping),
    ("an elbow stands out by more than 60° with the hand low", standing_out),
    (
        "an elbow stands out by more than 45° on the way from rest or back, with the hand low",
        akimbo,
    ),
    ("an elbow is more than 3 cm above its shoulder", raised),
    (
        "an elbow is 10 cm above three of four captured ones with the hand at its height",
        lifted,
    ),
    ("an elbow is more than 10 cm behind its shoulder", behind),
    ("a wrist is folded by more than 65° for 0.2 s", folded),
    ("a wrist's way from rest is over 1.25 of the straight one", wandering),
    ("a head turns faster than 400° a second", whipped),
    ("flesh of a hand more than 5 mm in the trunk", buried),
    ("a finger's bone more than 1 cm in the head", in_head),
    (
        "at a turned head, or with a raised shoulder, a touch is more than 1.5 cm off its site",
        off_face,
    ),
    ("a wave is outside 2.5 to 4 Hz", trembling),
    ("a swing moves the fingertip less than 2.5 cm", faint),
    (
        "a movement with a target starts more than 45° off its direction",
        astray,
    ),
    ("a hand is turned more than 45° off, as reported", turned),
    (
        "no stroke of a fast sign is 1.2 times as fast as usual, or none of a slow one below 0.8",
        unreported,
    ),
    ("notation that is dropped with a warning", dropped),
];

/// A sign with its movement.
pub(crate) struct Seen<'a> {
    notated: &'a NotatedSign,
    findings: usize,
    made: GeneratedMovement,
    /// The same without its non-manuals, if it has some.
    plain: Option<GeneratedMovement>,
    /// The same with neither fast nor slow movement, if it has some.
    usual: Option<GeneratedMovement>,
    /// The model in each frame.
    models: Vec<ModelPose>,
    /// Frames per second.
    pub(crate) rate: f64,
}

impl Seen<'_> {
    fn sign(&self) -> Option<(usize, usize)> {
        let gloss = self.made.notes.iter().find(|note| note.about == NoteSubject::Gloss)?;
        Some(self.frames(gloss.span))
    }

    fn frames(&self, span: TimeSpan) -> (usize, usize) {
        let at = |n: usize| n.min(self.models.len() - 1);
        let rate = self.made.clip.clip_frame_rate();
        (
            at(rate.nearest_frame_at(span.span_start_instant())),
            at(rate.nearest_frame_at(span.span_end_instant())),
        )
    }

    fn phases(&self, name: &str) -> Vec<(BodySide, (usize, usize))> {
        let phase = NoteSubject::Component(SignComponent::Movement, Some("phase".into()));
        let notes = self.made.notes.iter().filter(|note| match name {
            "transition" => note.about == NoteSubject::Transition,
            _ => note.about == phase && note.value == ComponentReading::Value(name.into()),
        });
        notes
            .filter_map(|note| Some((note.hand?, self.frames(note.span))))
            .collect()
    }

    fn wrist(&self, side: BodySide, frame: usize) -> Option<DVec3> {
        Some(self.models[frame].model_joint_position(self.made.anatomy.arm_chain(side)?.hand))
    }

    pub(crate) fn dominant(&self) -> BodySide {
        match self.made.handedness {
            chereme_sign::SignerHandedness::Left => BodySide::Left,
            _ => BodySide::Right,
        }
    }

    /// Returns the path of a joint between two frames, in metres.
    fn path(&self, joint: usize, (from, to): (usize, usize)) -> f64 {
        let steps = self.models[from..=to].windows(2);
        steps
            .map(|two| {
                two[0]
                    .model_joint_position(joint)
                    .distance(two[1].model_joint_position(joint))
            })
            .sum()
    }

    /// Returns the highest speed of a wrist between two frames, in metres per second.
    pub(crate) fn peak(&self, side: BodySide, (from, to): (usize, usize)) -> f64 {
        let Some(arm) = self.made.anatomy.arm_chain(side) else {
            return 0.0;
        };
        let steps = self.models[from..=to].windows(2);
        let steps = steps.map(|two| {
            two[0]
                .model_joint_position(arm.hand)
                .distance(two[1].model_joint_position(arm.hand))
        });
        steps.fold(0.0, f64::max) * self.rate
    }

    pub(crate) fn strokes(&self) -> Vec<(usize, usize)> {
        let own = self.dominant();
        let all = self.phases("stroke").into_iter();
        all.filter(|(side, span)| *side == own && span.1 > span.0)
            .map(|(_, span)| span)
            .collect()
    }

    pub(crate) fn approach(&self) -> Option<(usize, usize)> {
        let own = self.dominant();
        let all = self.phases("transition").into_iter();
        all.filter(|(side, _)| *side == own).map(|(_, span)| span).min()
    }

    /// Returns whether the stroke moves the wrist and is not played by fingers or wrist alone.
    pub(crate) fn moves(&self) -> bool {
        let own = self.dominant();
        let Some(arm) = self.made.anatomy.arm_chain(own) else {
            return false;
        };
        self.strokes().iter().any(|&span| self.path(arm.hand, span) > 0.05)
    }
}

fn thumb_off(seen: &Seen<'_>) -> Option<bool> {
    let (at, _) = seen.sign()?;
    let mut judged = None;
    for part in seen.notated.sign.parts.iter().take(1) {
        let sides = [seen.dominant(), seen.dominant().opposite_side()];
        let both = matches!(part.hands, chereme_sign::hamnosys::HandsUsed::Both(_));
        let shapes = [
            part.posture.shape.dominant_value(),
            part.posture.shape.other_value().or(if both {
                part.posture.shape.dominant_value()
            } else {
                None
            }),
        ];
        for (side, shape) in sides.into_iter().zip(shapes) {
            let Some(shape) = shape else { continue };
            let Some(hand) = Hand::of(
                &seen.made.anatomy,
                seen.made.clip.clip_skeleton(),
                &seen.models[at],
                side,
            ) else {
                continue;
            };
            let Some(off) = hand.thumb_off(shape) else {
                continue;
            };
            judged = Some(judged.unwrap_or(false) || off > 0.003);
        }
    }
    judged
}

fn hasty(seen: &Seen<'_>) -> Option<bool> {
    if !seen.moves() {
        return None;
    }
    let own = seen.dominant();
    let strokes = seen.strokes().into_iter().map(|span| seen.peak(own, span));
    Some(seen.peak(own, seen.approach()?) > 1.02 * strokes.fold(0.0, f64::max))
}

fn short_stroke(seen: &Seen<'_>) -> Option<bool> {
    if !seen.moves() {
        return None;
    }
    Some(stroke_share(seen)? < 0.3)
}

/// Returns the share of the strokes in the time from the first movement to the end of the sign.
pub(crate) fn stroke_share(seen: &Seen<'_>) -> Option<f64> {
    let (from, to) = (seen.approach()?.0, seen.sign()?.1);
    let strokes: usize = seen.strokes().iter().map(|span| span.1 - span.0).sum();
    Some(strokes as f64 / (to - from).max(1) as f64)
}

fn frozen(seen: &Seen<'_>) -> Option<bool> {
    let anatomy = &seen.made.anatomy;
    let joints = [BodyPart::Head, BodyPart::Chest];
    let still = joints
        .into_iter()
        .filter_map(|part| anatomy.part_joint(part))
        .any(|joint| {
            let first = seen.models[0].model_joint_rotation(joint);
            let turned = seen
                .models
                .iter()
                .map(|model| model.model_joint_rotation(joint).angle_between(first));
            turned.fold(0.0, f64::max) < 0.3_f64.to_radians()
        });
    Some(still)
}

fn unblinking(seen: &Seen<'_>) -> Option<bool> {
    Some(!seen.made.curves.iter().any(|curve| curve.name.starts_with("lids.")))
}

fn merged(seen: &Seen<'_>) -> Option<bool> {
    let reported = seen
        .made
        .report
        .warnings
        .iter()
        .any(|warning| warning.contains("each other"));
    Some(merged_at_all(seen)? && !reported)
}

fn merged_at_all(seen: &Seen<'_>) -> Option<bool> {
    if interlocked(seen.notated) {
        return None;
    }
    let (from, to) = seen.sign()?;
    let hands = |model: &ModelPose| {
        let skeleton = seen.made.clip.clip_skeleton();
        let hands = BodySide::BOTH_SIDES.map(|side| Hand::of(&seen.made.anatomy, skeleton, model, side));
        match hands {
            [Some(a), Some(b)] => deepest(&a, &b),
            _ => 0.0,
        }
    };
    let steps = (from..=to).step_by(2);
    Some(steps.map(|frame| hands(&seen.models[frame])).fold(0.0, f64::max) > 0.008)
}

/// Fastest turn of a head, in degrees a second: people who shake it in speech reach half of that.
const WHIPS: f64 = 400.0;

fn whipped(seen: &Seen<'_>) -> Option<bool> {
    let head = seen.made.anatomy.part_joint(BodyPart::Head)?;
    let fast = seen.models.windows(2).any(|two| {
        let turned = two[0]
            .model_joint_rotation(head)
            .angle_between(two[1].model_joint_rotation(head));
        turned.to_degrees() * seen.rate > WHIPS
    });
    Some(fast)
}

fn buried(seen: &Seen<'_>) -> Option<bool> {
    let (from, to) = seen.sign()?;
    let anatomy = &seen.made.anatomy;
    let skeleton = seen.made.clip.clip_skeleton();
    let still = Trunk::of(anatomy, skeleton, &seen.models[0])?;
    let deep = (from..=to).step_by(3).any(|n| {
        let model = &seen.models[n];
        let trunk = still.moved(&seen.models[0], model);
        let hands = BodySide::BOTH_SIDES
            .into_iter()
            .filter_map(|side| Hand::of(anatomy, skeleton, model, side));
        hands.into_iter().any(|hand| {
            hand.tubes
                .iter()
                .any(|Tube { ends, radius, .. }| ends.iter().any(|&at| trunk.depth_with(at, *radius) > 0.005))
        })
    });
    Some(deep)
}

fn in_head(seen: &Seen<'_>) -> Option<bool> {
    let (from, to) = seen.sign()?;
    let anatomy = &seen.made.anatomy;
    let skeleton = seen.made.clip.clip_skeleton();
    let deep = (from..=to).step_by(3).any(|n| {
        let model = &seen.models[n];
        let Some(skull) = Skull::of(anatomy, skeleton, model) else {
            return false;
        };
        let hands = BodySide::BOTH_SIDES
            .into_iter()
            .filter_map(|side| Hand::of(anatomy, skeleton, model, side));
        let tubes = hands.flat_map(|hand| hand.tubes);
        tubes.flat_map(|tube| tube.ends).any(|at| skull.depth(at) > 0.01)
    });
    Some(deep)
}

fn off_face(seen: &Seen<'_>) -> Option<bool> {
    let plain = seen.plain.as_ref()?;
    let turned = seen.notated.nonmanual.acts_by_tier().any(|(_, act)| {
        use NonmanualPart as P;
        matches!(act.part, P::Head | P::Body | P::Shoulders) && !matches!(act.act_code(), "NO" | "ND" | "SH" | "ST")
    });
    let head = seen.made.anatomy.part_joint(BodyPart::Head)?;
    use chereme_sign::hamnosys::BodyLocation as B;
    let on_head = |at: B| {
        (B::Head as u8..=B::UnderChin as u8).contains(&(at as u8)) || matches!(at, B::Ear | B::EarLobe | B::Cheek)
    };
    let touching = places(seen.notated).into_iter().find(|place| {
        // A place half-way to the trunk follows the head by half.
        let mut sites = place.site.iter().chain(&place.second).peekable();
        place.contact == Some(PlaceContact::Touch) && sites.peek().is_some() && sites.all(|site| on_head(site.at))
    });
    let part = touching?.by.as_ref();
    if !turned {
        return None;
    }
    let side = seen.dominant();
    let (first, _) = seen.sign()?;
    let span = plain.notes.iter().find(|note| note.about == NoteSubject::Gloss)?.span;
    let other = plain.clip.model_pose(
        plain
            .clip
            .clip_frame_rate()
            .nearest_frame_at(span.span_start_instant())
            .min(plain.clip.clip_frame_count() - 1),
    );
    let hand = |model: &ModelPose| {
        let hand = Hand::of(&seen.made.anatomy, seen.made.clip.clip_skeleton(), model, side)?;
        let at = hand.part(part)?;
        Some(model.model_joint_rotation(head).inverse() * (at - model.model_joint_position(head)))
    };
    Some(hand(&seen.models[first])?.distance(hand(&other)?) > 0.015)
}

fn trembling(seen: &Seen<'_>) -> Option<bool> {
    let mut any = false;
    each_motion(seen.notated, &mut |motion| {
        any |= match &motion.kind {
            MotionKind::Directed(directed) => directed.zigzag.is_some(),
            MotionKind::Circular(circular) => circular.zigzag.is_some(),
            _ => false,
        };
    });
    if !any {
        return None;
    }
    let side = seen.dominant();
    let rates: Vec<f64> = seen
        .strokes()
        .into_iter()
        .filter_map(|span| seen.frequency(side, span))
        .collect();
    let first = *rates.first()?;
    Some(!(2.3..=4.2).contains(&first))
}

impl Seen<'_> {
    /// Returns the frequency (Hz) with which a wrist moves to and fro across its path; `None` if it hardly does.
    fn frequency(&self, side: BodySide, (from, to): (usize, usize)) -> Option<f64> {
        let at = |n: usize| self.wrist(side, n);
        let (first, last) = (at(from)?, at(to)?);
        let along = (last - first).try_normalize().unwrap_or(DVec3::ZERO);
        let off: Vec<DVec3> = (from..=to)
            .filter_map(at)
            .map(|v| {
                let v = v - first;
                v - along * v.dot(along)
            })
            .collect();
        let main = off
            .iter()
            .copied()
            .max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))?;
        let most = main.length();
        let main = main.try_normalize().filter(|_| most > 0.01)?;
        let off: Vec<f64> = off.iter().map(|v| v.dot(main)).collect();
        let (mut turns, mut ends) = (Vec::new(), (0.0, 0));
        let mut up = true;
        for (n, &now) in off.iter().enumerate() {
            let better = if up { now > ends.0 } else { now < ends.0 };
            if better {
                ends = (now, n);
            } else if (ends.0 - now).abs() > 0.35 * most {
                turns.push(ends.1);
                up = !up;
                ends = (now, n);
            }
        }
        let (a, b) = (turns.first()?, turns.last()?);
        (turns.len() > 1).then(|| (turns.len() - 1) as f64 / 2.0 * self.rate / (b - a) as f64)
    }
}

fn faint(seen: &Seen<'_>) -> Option<bool> {
    let mut any = false;
    each_motion(seen.notated, &mut |motion| {
        any |= matches!(&motion.kind, MotionKind::Wrist { motion: WristMotion::Swinging, size } if *size != Some(chereme_sign::hamnosys::MotionSize::Small));
    });
    if !any {
        return None;
    }
    let side = seen.dominant();
    let skeleton = seen.made.clip.clip_skeleton();
    let (from, to) = seen.sign()?;
    let tips: Vec<DVec3> = (from..=to)
        .filter_map(|n| {
            let hand = Hand::of(&seen.made.anatomy, skeleton, &seen.models[n], side)?;
            let arm = seen.made.anatomy.arm_chain(side)?;
            let turned = seen.models[n].model_joint_rotation(arm.forearm);
            Some(turned.inverse() * (hand.palm_end - hand.wrist))
        })
        .collect();
    let far = tips
        .iter()
        .flat_map(|a| tips.iter().step_by(4).map(move |b| a.distance(*b)));
    Some(far.fold(0.0, f64::max) * 2.0 < 0.025)
}

fn astray(seen: &Seen<'_>) -> Option<bool> {
    let mut found = None;
    if let Some(MotionKind::Target {
        motion: Some(inner),
        posture,
    }) = seen
        .notated
        .sign
        .parts
        .first()
        .and_then(|part| Some(&part.actions.first()?.kind))
        && posture.place.is_some()
        && let MotionKind::Directed(directed) = &inner.kind
        && directed.curve.is_none()
        && directed.zigzag.is_none()
        && matches!(
            seen.notated.sign.parts[0].hands,
            chereme_sign::hamnosys::HandsUsed::Dominant | chereme_sign::hamnosys::HandsUsed::Both(_)
        )
    {
        let v = DVec3::from(directed.direction.spatial_direction_vector());
        let second = directed
            .second
            .map_or(v, |second| DVec3::from(second.spatial_direction_vector()));
        // The part of the hand that reaches the target goes there, not the wrist.
        let part = match posture.place.as_ref() {
            Some(HandPlace::Body(place)) => place.by.as_ref(),
            Some(HandPlace::Hand(site)) => site.by.as_deref(),
            Some(HandPlace::Hands(hands)) => hands.dominant.as_ref(),
            _ => None,
        };
        found = Some(((v + second).normalize_or(v), part));
    }
    let (expected, part) = found?;
    let frame = seen.made.anatomy.body_frame(&seen.models[0])?;
    let side = seen.dominant();
    let left = if side == BodySide::Left {
        -expected.x
    } else {
        expected.x
    };
    let expected = frame.left * left + DVec3::Y * expected.y + frame.forward * expected.z;
    let &(from, to) = seen.strokes().first()?;
    let at = |n: usize| {
        let wrist = seen.wrist(side, n)?;
        let skeleton = seen.made.clip.clip_skeleton();
        let hand = Hand::of(&seen.made.anatomy, skeleton, &seen.models[n], side);
        Some(match part {
            Some(part) => hand?.part(Some(part))?,
            None => wrist,
        })
    };
    let path: Vec<DVec3> = (from..=to).map(at).collect::<Option<_>>()?;
    let steps = path.windows(2).map(|two| two[0].distance(two[1]));
    let gone: Vec<f64> = steps
        .scan(0.0, |sum, step| {
            *sum += step;
            Some(*sum)
        })
        .collect();
    let whole = *gone.last()?;
    let early = gone.iter().position(|gone| *gone > 0.25 * whole)?;
    let went = (path[early + 1] - path[0]).try_normalize().filter(|_| whole > 0.03)?;
    Some(went.angle_between(expected) > 45_f64.to_radians())
}

fn turned(seen: &Seen<'_>) -> Option<bool> {
    Some(crate::table::turned_by(&seen.made.report.warnings) > 45.0)
}

/// Top speed of the wrist (m/s) below which a stroke moves the hand alone, and is compared by its duration.
const STILL: f64 = 0.1;

fn unreported(seen: &Seen<'_>) -> Option<bool> {
    let usual = seen.usual.as_ref()?;
    let mut manner = None;
    each_motion(seen.notated, &mut |motion| {
        if motion.manner.fast || motion.manner.slow {
            manner = manner.or(Some(motion.manner.fast));
        }
    });
    let fast = manner?;
    if !seen.moves() {
        return None;
    }
    let arm = seen.made.anatomy.arm_chain(seen.dominant())?.hand;
    let strokes = |made: &GeneratedMovement| -> Vec<(f64, f64)> {
        let phase = NoteSubject::Component(SignComponent::Movement, Some("phase".into()));
        let stroke = ComponentReading::Value("stroke".into());
        let own = made
            .notes
            .iter()
            .filter(|note| note.about == phase && note.value == stroke && note.hand == Some(seen.dominant()));
        own.map(|note| {
            let frames = made.clip.clip_frame_rate().frames_in(note.span);
            let at = |frame: usize| made.clip.model_pose(frame).model_joint_position(arm);
            let steps = frames.start..frames.end.min(made.clip.clip_frame_count()).saturating_sub(1);
            let steps = steps.map(|frame| at(frame).distance(at(frame + 1)) * seen.rate);
            (steps.fold(0.0, f64::max), note.span.span_seconds())
        })
        .collect()
    };
    // Of a sequence one motion may be fast and the next as usual: the stroke that differs most counts.
    let pairs = strokes(&seen.made).into_iter().zip(strokes(usual));
    let against = pairs.map(|((peak, lasts), (usual, usually))| match usual > STILL {
        true => peak / usual,
        false => usually / lasts.max(1e-9),
    });
    Some(match fast {
        true => against.fold(0.0, f64::max) < 1.2,
        false => against.fold(f64::INFINITY, f64::min) > 0.8,
    })
}

fn dropped(seen: &Seen<'_>) -> Option<bool> {
    Some(seen.findings > 0)
}

/// Animates a sign and collects the data by which its faults are judged.
pub(crate) fn see<'a>(
    notated: &'a NotatedSign,
    findings: usize,
    stage: &MovementMaterial,
    settings: &AnimatorSettings,
) -> Result<Seen<'a>> {
    let made = animate_signs(&[notated], stage, settings)?;
    let plain = (notated.nonmanual.acts_by_tier().next().is_some())
        .then(|| {
            let mut bare = notated.clone();
            bare.nonmanual.tiers.clear();
            animate_signs(&[&bare], stage, settings)
        })
        .transpose()?;
    let even = with_motions(notated, &mut |motion| {
        motion.manner.fast = false;
        motion.manner.slow = false;
    });
    let usual = (even.sign != notated.sign)
        .then(|| animate_signs(&[&even], stage, settings))
        .transpose()?;
    let models = (0..made.clip.clip_frame_count())
        .map(|n| made.clip.model_pose(n))
        .collect();
    Ok(Seen {
        usual,
        notated,
        findings,
        made,
        plain,
        models,
        rate: settings.rate.per_second(),
    })
}
