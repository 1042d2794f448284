//! Golden tables of recipes on two bodies: movement, annotations, report and inputs of every operator.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{BodyPart, BodySide, Clip, HandAngles};
use chereme_sign::SignComponent;

use crate::golden::{LITTLE, compare_to, put};
use crate::outcome::GeneratedMovement;
use crate::sources::{ComponentValue, ValueMeaning};
use crate::testing::Shelf;
use crate::{MakeError, evaluate_recipe, resolve_recipe};

/// The moments of a movement that are written down, as shares of its duration.
const MOMENTS: [f64; 6] = [0.0, 0.2, 0.4, 0.6, 0.8, 1.0];

/// Returns numbers in words.
pub(super) fn list(numbers: impl IntoIterator<Item = f64>) -> String {
    let words = numbers.into_iter().map(|number| format!("{number:?}"));
    words.collect::<Vec<_>>().join(" ")
}

fn milli(at: DVec3) -> String {
    list((at * 1000.0).to_array())
}

/// Returns a rotation in words: the directions of the first two axes.
fn turned(q: DQuat) -> String {
    let axes = [q * DVec3::X, q * DVec3::Y].map(|axis| axis.to_array());
    list(axes.into_iter().flatten())
}

/// Writes down where joints are at some moments, and how they are turned; fingers as angles in one of them.
pub(super) fn movement(out: &mut String, made: &GeneratedMovement) {
    let clip: &Clip = &made.clip;
    let last = clip.clip_frame_count().saturating_sub(1);
    put(
        out,
        format!("{} frames at {:?}", clip.clip_frame_count(), clip.clip_frame_rate()),
    );
    for moment in MOMENTS {
        let frame = (last as f64 * moment).round() as usize;
        let model = clip.model_pose(frame);
        let at = |part: BodyPart| made.anatomy.part_joint(part).expect("a joint");
        let head = at(BodyPart::Head);
        put(
            out,
            format!(
                "{frame}: hips {} head {} {}",
                milli(model.model_joint_position(at(BodyPart::Hips))),
                milli(model.model_joint_position(head)),
                turned(model.model_joint_rotation(head))
            ),
        );
        for side in BodySide::BOTH_SIDES {
            let hand = at(BodyPart::Hand(side));
            put(
                out,
                format!(
                    "  {} {} {} elbow {} shoulder {}",
                    side.body_side_name(),
                    milli(model.model_joint_position(hand)),
                    turned(model.model_joint_rotation(hand)),
                    milli(model.model_joint_position(at(BodyPart::Forearm(side)))),
                    milli(model.model_joint_position(at(BodyPart::UpperArm(side))))
                ),
            );
        }
    }
    for frame in [last / 3, 2 * last / 3] {
        let pose = clip.clip_pose_at(frame);
        for side in BodySide::BOTH_SIDES {
            let angles = made.anatomy.hand_angles(clip.clip_skeleton(), side, &pose);
            let angles = angles.map(|it| list(it.map_hand_angles(f64::to_degrees).to_array()));
            put(out, format!("  {frame} {} fingers {angles:?}", side.body_side_name()));
        }
    }
}

/// Writes down annotations, report and curves.
pub(super) fn said(out: &mut String, made: &GeneratedMovement) {
    for note in &made.notes {
        let hand = note.hand.map_or("-", BodySide::body_side_name);
        put(
            out,
            format!(
                "note {hand} {:?} {} {}..{} ms {}",
                note.about,
                note.value,
                note.span.span_start_instant().instant_millis(),
                note.span.span_end_instant().instant_millis(),
                note.origin
            ),
        );
    }
    let report = &made.report;
    for step in &report.steps {
        put(out, format!("step {}: {}", step.path, step.step));
        step.did.iter().for_each(|did| put(out, format!("  {did}")));
        put(
            out,
            format!(
                "  residual {:?} moved {:?} {:?} own language {}",
                step.residual,
                step.moved,
                step.hands,
                step.language.is_some()
            ),
        );
    }
    for channel in &report.channels {
        put(out, format!("channel {}: {:?}", channel.channel, channel.from));
    }
    for join in &report.joins {
        put(out, format!("{join:?}"));
    }
    put(
        out,
        format!("contacts {:?} warnings {:?}", report.contacts, report.warnings),
    );
    for curve in &made.curves {
        let step = (curve.values.len() / 9).max(1);
        let values = curve.values.iter().copied().step_by(step);
        put(out, format!("curve {} {}", curve.name, list(values)));
    }
}

/// Returns the small test corpus with invented handshapes for cued speech.
fn shelf() -> Shelf {
    let mut shelf = Shelf::new();
    for (n, id) in ["A", "1", "3-outer-together", "B-thumb", "L"].into_iter().enumerate() {
        let mut angles = HandAngles::default();
        for (finger, own) in angles.fingers.iter_mut().enumerate() {
            let bent = if n == 0 || finger % n.max(1) > 0 { 1.3 } else { 0.05 };
            own.flexion = [bent, bent + 0.1, 0.7 * bent];
        }
        angles.thumb.radial = 0.2 * n as f64;
        let value = ComponentValue {
            id: id.to_owned(),
            inventory: "configurations".into(),
            meaning: Some(ValueMeaning::Hand(angles)),
        };
        shelf.values.push((SignComponent::Configuration, value));
    }
    shelf
}

fn make(text: &str) -> Result<(GeneratedMovement, String), MakeError> {
    let recipe: crate::Recipe = text.parse().unwrap_or_else(|e| panic!("{text}: {e}"));
    let resolved = resolve_recipe(&recipe, &shelf())?;
    let inputs = serde_json::to_value(resolved.resolved_inputs()).expect("inputs are JSON");
    let inputs = inputs.as_object().expect("inputs have names").iter();
    let lines: Vec<String> = inputs.map(|(name, it)| format!("input {name} {it}")).collect();
    Ok((evaluate_recipe(&resolved)?, lines.join("\n")))
}

fn tabled(name: &str, recipes: &[&str]) {
    let mut out = String::new();
    for recipe in recipes {
        put(&mut out, format!("## {recipe}"));
        match make(recipe) {
            Ok((made, inputs)) => {
                movement(&mut out, &made);
                said(&mut out, &made);
                put(&mut out, inputs);
            }
            Err(error) => put(&mut out, format!("refused: {error}")),
        }
    }
    compare_to(name, &out, LITTLE);
}

#[test]
fn golden_hands_in_other_places() {
    tabled(
        "placed",
        &[
            "BOL | place both by left 12cm",
            "ESCARGOT | place right by up 9cm back 3cm using fabrik",
            "LIMACE | place right by left 20%",
            "ESCARGOT | place right at chin with index",
            "ESCARGOT | place right at chin with palm",
            "BOL | place both at -10cm,110cm,40cm",
            "LIMACE | place right near BOL by up 5cm",
            "CHAT | place left at neutral-space",
            "LIMACE | place right at chin",
            "ESCARGOT | place right by forward 60cm",
            "ESCARGOT | orient right palm up",
            "LIMACE | orient right palm left fingers forward",
            "ESCARGOT | orient both by 30deg about up",
            "CHAT | orient left fingers up",
            "BOL | amplify both 1.4",
            "LIMACE | amplify right 0.5",
            "ESCARGOT | travel right down 12cm then up 15cm",
            "ESCARGOT | travel right left 10cm in 0.3s",
            "LIMACE | travel right through 10cm,8cm,0cm then 15cm,0cm,4cm in 0.8s",
            "BOL | from me to left",
            "ESCARGOT | from left to me",
            "ESCARGOT | from neutral-space to chin",
            "BOL | from chin to neutral-space",
            "LIMACE | from chin to left",
            "ESCARGOT | amplify right 1.2 | from me to chin",
            "BOL | travel both up 10cm then left 10cm then down 20cm in 0.6s",
            "BOL | travel left back 5cm",
            "BOL | travel right left 150cm",
            "ESCARGOT | place right by up 3m",
            "LIMACE | orient right by 60deg about left by 20deg about forward",
            "BOL | orient right palm down | place right at chin",
            "ESCARGOT | amplify right 0",
            "CHAT | amplify both 2.5",
        ],
    );
}

#[test]
fn golden_handshapes_of_others() {
    tabled(
        "configured",
        &[
            "ESCARGOT | configure right U",
            "ESCARGOT | configure right H via minimum-jerk 0.2s",
            "ESCARGOT | configure right V",
            "BOL | configure right U, _",
            "BOL | configure right _, Y",
            "LIMACE | configure both from BOL",
            "CHAT | configure left U",
            "BOL | configure right best(configuration=U signer=same)",
            "BOL | configure right U, Y",
            "BOL | configure right U, Y via slerp 0.05s",
            "BOL | configure right U, Y via cosine 0.6s",
            "BOL | configure both U via learned 0.3s",
            "ESCARGOT | configure right claw",
            "ESCARGOT | nonmanual from BOL",
            "ESCARGOT | nonmanual from CHAT",
        ],
    );
}

#[test]
fn golden_movement_turned_round_repeated_and_timed() {
    tabled(
        "timed",
        &[
            "ESCARGOT | reverse",
            "BOL | swap",
            "LIMACE | swap",
            "BOL | mirror right",
            "CHAT | mirror left",
            "ESCARGOT | mirror",
            "ESCARGOT | repeat 2",
            "ESCARGOT | repeat 3 scale 0.8 tempo 1.2 gap 0.1s",
            "LIMACE | repeat 2 scale 1.1 via cosine 0.15s",
            "ESCARGOT | retime 150%",
            "LIMACE | retime to 0.7s",
            "ESCARGOT | retime 1, to 1.2s, 50%",
            "CHAT | span 0.2s..0.8s",
            "CHAT | span 0.45s..",
            "ESCARGOT | trim",
            "ESCARGOT | place right by left 15cm | reverse | repeat 2",
            "ESCARGOT | retime 1, 2",
            "ESCARGOT | span 4s..5s",
        ],
    );
}

#[test]
fn golden_signs_joined_spelled_and_pointed() {
    tabled(
        "joined",
        &[
            "BOL then ESCARGOT",
            "BOL then via sigmoid 0.4s LIMACE then CHAT",
            "ESCARGOT then via learned BOL",
            "(BOL | trim) then via minimum-jerk 0.2s (ESCARGOT | reverse)",
            "spell USB",
            "spell UU left hold 0.2s via slerp 0.1s on signer:2",
            "spell USY right on signer:1 | travel right 12cm",
            "point right at 30cm,140cm,50cm",
            "point left at left up with U hold 0.3s on signer:2",
            "point right at -20cm,90cm,60cm then BOL",
            "spell UQ",
            "MOON then BOL",
        ],
    );
}

#[test]
fn golden_cued_speech() {
    tabled(
        "cued",
        &[
            "cue \"le chat dort\" on signer:1",
            "cue \"bonjour\" by attina pace 1.6 on signer:2",
            "cue \"il mange du pain\" left by sppas on signer:1",
            "cue \"gagne un vert\" by duchnowski pace 0.9 on signer:1",
            "cue \"l=87 @=131\" as sampa on signer:1",
            "cue \"beau\" by measured on signer:1 then BOL",
        ],
    );
}
