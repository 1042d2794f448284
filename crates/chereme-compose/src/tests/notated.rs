//! Golden tables of signs from notation: movement, annotations and report on a usual and on an odd body.

use std::sync::Arc;

use chereme_motion::glam::DVec3;
use chereme_motion::{BodyAnatomy, BodyPart, BodySide, Clip, FrameRate, HandFinger, ModelPose};
use chereme_sign::SignerHandedness;
use chereme_sign::hamnosys::{BodyLanguage, NonmanualAct, NonmanualPart, NotatedSign, from_names, parse_lenient};

use super::goldens::{list, movement, said};
use crate::golden::{LITTLE, compare_to, put};
use crate::notation::{AnimatorSettings, SignPerformer, animate_signs};
use crate::outcome::GeneratedMovement;
use crate::sources::MovementMaterial;
use crate::testing::{Axes, skeleton};

fn stage(axes: Axes, handedness: SignerHandedness) -> MovementMaterial {
    let skeleton = Arc::new(skeleton(axes, if axes == Axes::Odd { 0.9 } else { 1.0 }));
    let anatomy = Arc::new(BodyAnatomy::detect_anatomy(&skeleton));
    MovementMaterial {
        address: "stage".into(),
        hash: String::new(),
        gloss: String::new(),
        signer: None,
        handedness,
        clip: Clip::from_rest_pose(skeleton, FrameRate::new(60, 1).expect("a rate"), 1),
        anatomy,
        curves: Vec::new(),
        held: Vec::new(),
    }
}

fn sign(names: &str) -> NotatedSign {
    let text = from_names(names.split_whitespace()).unwrap_or_else(|_| panic!("{names}"));
    NotatedSign {
        gloss: "SIGN".into(),
        sign: parse_lenient(&text).sign,
        ..NotatedSign::default()
    }
}

fn still() -> AnimatorSettings {
    AnimatorSettings {
        language: BodyLanguage::default_body_language().without_life(),
        ..AnimatorSettings::default()
    }
}

fn animated(out: &mut String, signs: &[&NotatedSign], stage: &MovementMaterial, settings: &AnimatorSettings) {
    match animate_signs(signs, stage, settings) {
        Ok(made) => {
            movement(out, &made);
            said(out, &made);
        }
        Err(error) => put(out, format!("refused: {error} {:?}", error.notation_remedy())),
    }
}

fn tabled(name: &str, signs: &[&str]) {
    let mut out = String::new();
    let stages = [
        stage(Axes::Plain, SignerHandedness::Right),
        stage(Axes::Odd, SignerHandedness::Left),
    ];
    for (n, names) in signs.iter().enumerate() {
        put(&mut out, format!("## {names}"));
        let stage = &stages[usize::from(n % 3 == 2)];
        animated(&mut out, &[&sign(names)], stage, &still());
    }
    compare_to(name, &out, LITTLE);
}

#[test]
fn golden_postures_and_places_from_notation() {
    tabled(
        "notated_places",
        &[
            "hamflathand hamextfingerui hampalmd hamchest hamtouch",
            "hamfist hamthumboutmod hamextfingerul hampalml hamchin hamclose",
            "hamfinger2 hamextfingeru hampalml hamforehead hamlrat hamtouch",
            "hamfinger23spread hamextfingerul hampalmd hameyes hamclose",
            "hampinch12open hamextfingerul hampalml hamear hamtouch",
            "hamceeall hamextfingeru hampalml hamshouldertop hamlrbeside hamclose",
            "hamflathand hamthumbacrossmod hamextfingeru hampalml hamcheek hamlrbeside",
            "hamfinger2345 hamfingerhookmod hamextfingero hampalmu hambelowstomach hamclose",
            "hamflathand hamextfingerl hampalmd hamneck hamtouch",
            "hampinchall hamextfingerui hampalmu hamlips hamtouch",
            "hamsymmlr hamflathand hamextfingeruo hampalmd hamchest hamlrbeside",
            "hamsymmlr hamfinger2 hamextfingerl hampalmd hamparbegin hamindexfinger hamfingertip hamplus \
             hamindexfinger hamfingertip hamparend hamtouch",
            "hamparbegin hamflathand hamextfingero hampalml hamplus hamfist hamextfingero hampalmu hamparend \
             hamneutralspace",
            "hamflathand hamextfingerur hampalmr hamelbow hamclose",
        ],
    );
}

#[test]
fn golden_paths_from_notation() {
    tabled(
        "notated_paths",
        &[
            "hamflathand hamextfingerui hampalmd hamchest hamtouch hammoveo",
            "hamfist hamextfingerui hampalmd hamneutralspace hammoved hamhalt",
            "hamfinger2 hamextfingerl hampalmd hamnose hamtouch hammovedo hamfast",
            "hamflathand hamextfingeruo hampalml hamneutralspace hammovel hamarcu hamlargemod",
            "hamflathand hamextfingero hampalml hamneutralspace hammoveo hamzigzag",
            "hamfinger2345 hamextfingeru hampalml hamchin hamclose hammover hamwavy",
            "hamfinger2 hamthumboutmod hamextfingeru hampalml hamcheek hamclose hamcircleo",
            "hamfist hamextfingeruo hampalml hamhead hamlrbeside hamclose hamcircleo hamsmallmod \
             hamrepeatfromstart",
            "hamflathand hamfingerbendmod hamextfingerul hampalmd hamshouldertop hamlrat hamtouch hammoveu \
             hamrepeatreverse",
            "hamfinger2 hamextfingero hampalmd hamneutralspace hamseqbegin hammover hammoved hammovel \
             hamseqend",
            "hamflathand hamextfingero hampalmu hambelowstomach hamclose hammoveu hamslow",
            "hamflathand hamextfingerl hampalmd hamchest hamtouch hammover hamtense",
            "hamflathand hamextfingerl hampalmd hamstomach hamparbegin hammoveu hamplus hamtwisting hamparend",
            "hamfinger2 hamextfingeru hampalmd hamchin hamtouch hammovedo hamrepeatfromstartseveral",
        ],
    );
}

#[test]
fn golden_changes_from_notation() {
    tabled(
        "notated_changes",
        &[
            "hampinch12 hamextfingeru hampalmd hamlips hamtouch hamreplace hampinch12open hamextfingero \
             hampalmd",
            "hamfinger23spread hamextfingeru hampalml hamneutralspace hamfingerplay",
            "hamfinger2 hamfingerhookmod hamextfingerul hampalml hamcheek hamtouch hamtwisting",
            "hamfist hamextfingero hampalmd hamneutralspace hamnodding",
            "hamflathand hamextfingeru hampalmu hamneutralspace hamswinging",
            "hamfist hamextfingeru hampalml hamneutralspace hamparbegin hammoveo hamreplace hamfinger2345 \
             hamparend",
            "hamsymmlr hampinchall hamextfingero hampalmd hamneutralspace hamclose hammover hamreplace \
             hamfinger2345 hamextfingero hampalmd",
            "hamflathand hamextfingero hampalmd hamneutralspace hamreplace hamextfingeru hampalml",
        ],
    );
}

#[test]
fn golden_two_hands_from_notation() {
    tabled(
        "notated_two_hands",
        &[
            "hamsymmlr hamfist hamextfingeruo hampalml hamneutralspace hammoveu hammoved",
            "hamsymmpar hamflathand hamextfingero hampalmu hamneutralspace hammover",
            "hamsymmlr hamfinger2345 hamextfingero hampalmd hamneutralspace hamalternatingmotion hammoveu \
             hamrepeatreverse",
            "hamsymmlr hamflathand hamthumboutmod hamextfingeruo hampalml hamshoulders hamclose hammovedo \
             hamlargemod",
            "hamsymmlr hamfinger2 hamextfingeruo hampalmd hamparbegin hamindexfinger hamfingertip hamplus \
             hamindexfinger hamfingertip hamparend hamclose hamcircleo",
            "hamparbegin hamflathand hamextfingero hampalml hamplus hamflathand hamextfingero hampalmu \
             hamparend hamneutralspace hammoved",
            "hamsymmlr hamflathand hamextfingerl hampalmu hamneutralspace hamclose hamparbegin hammoveu hamplus \
             hammoved hamparend",
            "hamsymmlr hamfist hamextfingerl hampalmd hamchest hamtouch hamnomotion",
        ],
    );
}

/// Writes down the movement in a few lines: moments of both arms, and means over all frames.
fn briefly(out: &mut String, made: &GeneratedMovement) {
    let clip = &made.clip;
    let last = clip.clip_frame_count() - 1;
    put(
        out,
        format!(
            "{} frames, warnings {:?}",
            clip.clip_frame_count(),
            made.report.warnings
        ),
    );
    let models: Vec<ModelPose> = (0..=last).map(|frame| clip.model_pose(frame)).collect();
    for side in BodySide::BOTH_SIDES {
        let joint = |part: BodyPart| made.anatomy.part_joint(part).expect("a joint");
        let hand = joint(BodyPart::Hand(side));
        for frame in [last / 3, last / 2, 2 * last / 3] {
            let model = &models[frame];
            let directions = [DVec3::X, DVec3::Z].map(|axis| model.model_joint_rotation(hand) * axis);
            let all = directions.into_iter().flat_map(|it| it.to_array());
            let at = (model.model_joint_position(hand) * 1000.0).to_array();
            put(
                out,
                format!("  {} {frame}: {} turned {}", side.body_side_name(), list(at), list(all)),
            );
        }
        let parts = [
            BodyPart::Clavicle(side),
            BodyPart::UpperArm(side),
            BodyPart::Forearm(side),
            BodyPart::Hand(side),
            BodyPart::Finger(side, HandFinger::Index, 3),
            BodyPart::Finger(side, HandFinger::Little, 3),
            BodyPart::Thumb(side, 2),
        ];
        for part in parts {
            let joint = joint(part);
            let path: Vec<DVec3> = models
                .iter()
                .map(|it| it.model_joint_position(joint) * 1000.0)
                .collect();
            let mean = path.iter().sum::<DVec3>() / path.len() as f64;
            let length: f64 = path.windows(2).map(|two| two[0].distance(two[1])).sum();
            let turns: f64 = models
                .windows(2)
                .map(|two| {
                    two[0]
                        .model_joint_rotation(joint)
                        .angle_between(two[1].model_joint_rotation(joint))
                })
                .sum();
            put(
                out,
                format!(
                    "  {part} mean {} path {length:?} turns {:?}",
                    list(mean.to_array()),
                    turns.to_degrees()
                ),
            );
        }
    }
}

/// Writes down signs whose shapes, directions and palms go round while `endings` are gone through.
fn varied(name: &str, beginnings: &[&str], endings: &[&str]) {
    const SHAPES: [&str; 9] = [
        "hamflathand",
        "hamfinger2",
        "hamfist hamthumboutmod",
        "hamfinger2345",
        "hampinch12",
        "hamceeall",
        "hamfinger23spread hamthumbacrossmod",
        "hamflathand hamfingerbendmod",
        "hampinchall",
    ];
    const DIRECTIONS: [&str; 11] = [
        "hamextfingeru",
        "hamextfingerul",
        "hamextfingero",
        "hamextfingeruo",
        "hamextfingerl",
        "hamextfingerui",
        "hamextfingerol",
        "hamextfingeril",
        "hamextfingerdo",
        "hamextfingerur",
        "hamextfingerd",
    ];
    const PALMS: [&str; 7] = [
        "hampalmd",
        "hampalml",
        "hampalmu",
        "hampalmdl",
        "hampalmr",
        "hampalmul",
        "hampalmdr",
    ];
    let mut out = String::new();
    let stages = [
        stage(Axes::Plain, SignerHandedness::Right),
        stage(Axes::Odd, SignerHandedness::Left),
    ];
    for (n, ending) in endings.iter().enumerate() {
        let posture = format!(
            "{} {} {} {}",
            beginnings[n % beginnings.len()],
            SHAPES[n % SHAPES.len()],
            DIRECTIONS[(3 * n + n / 11) % DIRECTIONS.len()],
            PALMS[(2 * n + n / 7) % PALMS.len()]
        );
        let names = format!("{} {ending}", posture.trim());
        put(&mut out, format!("## {names}"));
        let settings = match n % 4 {
            3 => AnimatorSettings::default(),
            _ => still(),
        };
        match animate_signs(&[&sign(&names)], &stages[usize::from(n % 3 == 2)], &settings) {
            Ok(made) => briefly(&mut out, &made),
            Err(error) => put(&mut out, format!("refused: {error}")),
        }
    }
    compare_to(name, &out, LITTLE);
}

#[test]
fn golden_varied_places_from_notation() {
    varied(
        "varied_places",
        &["", "", "", "hamsymmlr"],
        &[
            "hamhead hamclose",
            "hamheadtop hamtouch",
            "hamforehead hamlrat hamclose",
            "hameyebrows hamtouch",
            "hameyes hamlrbeside",
            "hamnose hamtouch",
            "hamnostrils hamclose",
            "hamear hamtouch",
            "hamearlobe hamtouch",
            "hamcheek hamlrat hamtouch",
            "hamlips hamclose",
            "hamtongue hamclose",
            "hamteeth hamtouch",
            "hamchin hamlrbeside hamtouch",
            "hamunderchin hamtouch",
            "hamneck hamclose",
            "hamshouldertop hamlrat hamtouch",
            "hamshoulders hamclose",
            "hamchest hamlrat hamtouch",
            "hamstomach hamtouch",
            "hambelowstomach hamclose",
            "hamlrbeside hamchest hamarmextended",
            "hamneutralspace hamclose",
            "hamupperarm hamtouch",
            "hamelbow hamclose",
            "hamelbowinside hamtouch",
            "hamlowerarm hamtouch",
            "hamwristback hamtouch",
            "hamwristpulse hamclose",
            "hamthumbball hamtouch",
            "hampalm hamtouch",
            "hamhandback hamclose",
            "hamindexfinger hamfingertip hamtouch",
            "hammiddlefinger hamfingerside hamclose",
            "hambehind hamhead hamtouch",
            "hamforehead hamtouch hammoved hamchin hamtouch",
        ],
    );
}

#[test]
fn golden_varied_paths_from_notation() {
    varied(
        "varied_paths",
        &["", "hamsymmlr", "", "hamsymmpar"],
        &[
            "hammoveu hamlargemod",
            "hamchest hamtouch hammoveur",
            "hammover hamsmallmod",
            "hamstomach hammovedr",
            "hammoved hamarcl",
            "hamchest hammovedl hamfast",
            "hammovel hamarcu hamsmallmod",
            "hamchin hamtouch hammoveul",
            "hammovei hamslow",
            "hamchest hamclose hammoveo hamarcu",
            "hammoveuo hamwavy",
            "hammovedo hamzigzag hamlargemod",
            "hammoveol hamhalt",
            "hammoveor hamtense",
            "hamforehead hammoveui hamarcr",
            "hammovedi hamarcd",
            "hammovecross",
            "hammovex",
            "hamcircleu hamlargemod",
            "hamchest hamcircled",
            "hamcirclel hamsmallmod",
            "hamcircler hamincreasing",
            "hamcheek hamclose hamcirclei",
            "hamcircleul hamfast",
            "hamcircledr hamdecreasing",
            "hamcircleol hamclockl",
            "hamcircleir hamclockfull",
            "hamcircleo hamellipseh",
            "hamcircled hamellipsev hamsmallmod",
            "hamcircleuo hamclocku hamclockfull",
            "hammoveu hamrepeatfromstart",
            "hamchest hamtouch hammoveo hamrepeatfromstartseveral",
            "hammover hamrepeatreverse",
            "hammoved hamrepeatcontinue",
            "hamcircleo hamrepeatcontinueseveral",
            "hammovel hamrepeatfromstart hamincreasing",
            "hamchin hamtouch hammovedo hamrepeatreverse hamalternatingmotion",
            "hamseqbegin hammoveu hammover hamseqend",
            "hamfusionbegin hammoveu hammover hamfusionend",
            "hamparbegin hammoveo hamplus hamtwisting hamparend",
            "hamchest hamtouch hambrushing hammover",
            "hamnomotion",
        ],
    );
}

#[test]
fn golden_varied_turns_and_changes_from_notation() {
    varied(
        "varied_changes",
        &["", "", "hamsymmlr"],
        &[
            "hamfingerplay",
            "hamtwisting hamfast",
            "hamnodding",
            "hamswinging",
            "hamwristtopinky",
            "hamwristtothumb hamrepeatfromstart",
            "hamwristtopulse",
            "hamwristtoback hamslow",
            "hamstircw",
            "hamstirccw hamrepeatcontinue",
            "hamreplace hamfist",
            "hamreplace hamextfingeru hampalml",
            "hamreplace hamfinger2345 hamextfingero hampalmd",
            "hamchest hamparbegin hammoveo hamreplace hamfist hamparend",
            "hamparbegin hammover hamplus hamreplace hamextfingeru hampalmd hamparend",
            "hamchin hamtouch hamreplace hamflathand hamextfingero hampalmu hamchest",
            "hamchest hamtouch hamtwisting hamrepeatfromstart",
            "hamparbegin hammoveu hamplus hamfingerplay hamparend",
            "hamnose hamclose hamnodding hamrepeatfromstart",
            "hamseqbegin hamtwisting hammoveo hamseqend",
            "hampalm hamorirelative hammovel",
        ],
    );
}

#[test]
fn golden_sentences_life_and_non_manuals() {
    let mut out = String::new();
    let (plain, odd) = (
        stage(Axes::Plain, SignerHandedness::Right),
        stage(Axes::Odd, SignerHandedness::Right),
    );
    let first = sign("hamflathand hamextfingerui hampalmd hamchest hamtouch hammoveo");
    let second = sign("hamsymmlr hamfinger2 hamextfingero hampalmd hamneutralspace hammover");
    put(&mut out, "## two signs, alive");
    animated(&mut out, &[&first, &second], &plain, &AnimatorSettings::default());
    put(&mut out, "## two signs on another body, 25 frames a second");
    let slow = AnimatorSettings {
        rate: FrameRate::new(25, 1).expect("a rate"),
        ..AnimatorSettings::default()
    };
    animated(&mut out, &[&second, &first, &second], &odd, &slow);
    let acts = [
        [(NonmanualPart::Head, "SL"), (NonmanualPart::Body, "TF")],
        [(NonmanualPart::Head, "NO"), (NonmanualPart::Body, "RR")],
        [(NonmanualPart::Head, "PF"), (NonmanualPart::Body, "TB")],
        [(NonmanualPart::Shoulders, "UB"), (NonmanualPart::Brows, "RB")],
        [(NonmanualPart::Shoulders, "HB"), (NonmanualPart::Gaze, "AD")],
    ];
    for acts in acts {
        put(&mut out, format!("## {acts:?}"));
        let mut sign = first.clone();
        for (part, tag) in acts {
            sign.nonmanual
                .push_act_group(part.sigml_tier(), vec![NonmanualAct::new(part, tag)]);
        }
        animated(&mut out, &[&sign], &odd, &still());
    }
    put(&mut out, "## nothing, and a body without arms");
    animated(&mut out, &[], &plain, &still());
    put(&mut out, "## first postures and movement alone");
    let performer = SignPerformer::new(plain, still()).expect("a performer");
    for sign in [&first, &second] {
        for clip in [performer.perform_first_posture(sign), performer.perform_sign(sign)] {
            let clip = clip.expect("a clip");
            let model = clip.model_pose(clip.clip_frame_count() - 1);
            let places: Vec<[f64; 3]> = model
                .model_joint_positions()
                .iter()
                .step_by(5)
                .map(|at| (*at * 1000.0).to_array())
                .collect();
            put(&mut out, format!("{} frames, last {places:?}", clip.clip_frame_count()));
        }
    }
    compare_to("notated_sentences", &out, LITTLE);
}
