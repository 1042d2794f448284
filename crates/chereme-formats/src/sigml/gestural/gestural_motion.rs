//! Reads motions.

use super::super::node::AttributeReader;
use super::super::sigml_raw::SigmlElement;
use super::gestural_posture::{self, is_place, one_half, read_place};
use super::{read_body_action, report_unexpected_gestural};
use crate::finding::ImportFinding;
use crate::tally::FindingTally;
use chereme_sign::hamnosys::{
    CircularPath, ClockRange, DirectedPath, HandPlace, MotionGrowth, MotionKind, MotionManner, MotionRepetition,
    NotatedMotion, NotatedPosture, PathCurve, PathZigzag, PlaceContact, RepeatKind, SizeAmount, SpatialDirection,
};

/// Returns whether an element is a motion.
pub(super) fn is_motion(name: &str) -> bool {
    matches!(
        name,
        "directedmotion"
            | "circularmotion"
            | "wristmotion"
            | "crossmotion"
            | "fingerplay"
            | "changeposture"
            | "nomotion"
            | "no_motion"
            | "nonman_motion"
            | "split_motion"
            | "seq_motion"
            | "par_motion"
            | "tgt_motion"
            | "rpt_motion"
    )
}

/// Reads an element that [`is_motion`].
pub(super) fn read_motion(element: &SigmlElement<'_>, findings: &mut FindingTally) -> NotatedMotion {
    let mut node = AttributeReader::new(element, findings);
    let manner = read_motion_manner(&mut node);
    let kind = match &*element.name {
        "directedmotion" => finish_simple_motion(read_directed_motion(&mut node), element, node),
        "circularmotion" => finish_simple_motion(read_circular_motion(&mut node), element, node),
        "wristmotion" => finish_simple_motion(read_wrist_motion(&mut node), element, node),
        "crossmotion" => finish_simple_motion(read_cross_motion(&mut node), element, node),
        "fingerplay" => {
            let digits = node.read_digits_attribute("digits");
            finish_simple_motion(MotionKind::FingerPlay(digits), element, node)
        }
        "rpt_motion" => read_repeated_motion(element, node),
        "seq_motion" => {
            let fused = node.read_flag_attribute("fused");
            node.report_unread_attributes();
            let motions = read_child_motions(element, findings);
            MotionKind::Sequence { motions, fused }
        }
        "par_motion" => {
            node.report_unread_attributes();
            MotionKind::Parallel(read_child_motions(element, findings))
        }
        "split_motion" => {
            node.report_unread_attributes();
            read_split_motion(element, findings)
        }
        "tgt_motion" => {
            node.report_unread_attributes();
            read_target_motion(element, findings)
        }
        "nonman_motion" => {
            node.report_unread_attributes();
            read_body_action(element, findings).map_or(MotionKind::Still, MotionKind::Body)
        }
        _ => read_still_motion(element, node),
    };
    match kind {
        // The manner of a brushing motion is that of the motion, not of its target.
        MotionKind::Target { motion, posture } if is_simple(&element.name) => {
            let motion = motion.map(|motion| Box::new(NotatedMotion { manner, ..*motion }));
            NotatedMotion::new(MotionKind::Target { motion, posture })
        }
        kind => NotatedMotion {
            manner,
            ..NotatedMotion::new(kind)
        },
    }
}

fn is_simple(name: &str) -> bool {
    matches!(
        name,
        "directedmotion" | "circularmotion" | "wristmotion" | "crossmotion" | "fingerplay"
    )
}

/// Finishes a motion without nested motions; a place in it is one that the hand brushes along.
fn finish_simple_motion(kind: MotionKind, element: &SigmlElement<'_>, mut node: AttributeReader<'_, '_>) -> MotionKind {
    if node.name_number("def_locname").is_some() {
        node.add_element_warning("places named by a motion", |tag| {
            format!("<{tag} def_locname>: the end of a motion can't be named here; the name was left out")
        });
    }
    let mut brushed = None;
    for child in &element.children {
        if is_place(&child.name) && brushed.is_none() {
            brushed = Some(to_brushing_place(read_place(child, node.findings)));
        } else {
            report_unexpected_gestural(child, element, node.findings);
        }
    }
    node.report_unread_attributes();
    match brushed {
        None => kind,
        Some(place) => MotionKind::Target {
            motion: Some(Box::new(NotatedMotion::new(kind))),
            posture: Box::new(NotatedPosture {
                place: Some(place),
                ..NotatedPosture::default()
            }),
        },
    }
}

fn to_brushing_place(mut place: HandPlace) -> HandPlace {
    let contact = match &mut place {
        HandPlace::Body(place) => &mut place.contact,
        HandPlace::Hand(site) => &mut site.contact,
        _ => return place,
    };
    if matches!(contact, None | Some(PlaceContact::Touch)) {
        *contact = Some(PlaceContact::Brushing);
    }
    place
}

fn read_motion_manner(node: &mut AttributeReader<'_, '_>) -> MotionManner {
    if node.element.attributes.is_empty() {
        return MotionManner::default();
    }
    let word = node.parse_attribute("manner", "fast, slow, tense, rest or halt", |text| {
        ["fast", "slow", "tense", "rest", "halt"]
            .into_iter()
            .find(|known| *known == text)
    });
    let mut set = |name: &str| node.read_flag_attribute(name) | (word == Some(name));
    let manner = MotionManner {
        fast: set("fast"),
        slow: set("slow"),
        tense: set("tense"),
        rest: set("rest"),
        halt: set("halt"),
        bouncing: set("bouncing"),
        alternating: set("alternating"),
        second_alternating: set("second_alternating"),
        absolute: set("abs_motion"),
        speed: None,
    };
    let speed = node.read_positive_number("speed");
    if speed.is_some() {
        node.add_element_note("speeds of single motions", |tag| {
            format!("<{tag} speed> is not in SiGML 1.2; it was kept as a factor")
        });
    }
    MotionManner { speed, ..manner }
}

fn read_still_motion(element: &SigmlElement<'_>, mut node: AttributeReader<'_, '_>) -> MotionKind {
    let change = element.name == "changeposture";
    if element.name == "no_motion" {
        node.add_element_note("elements with another name", |_| {
            "<no_motion> was read as <nomotion>".into()
        });
    }
    if change {
        node.add_element_warning("changes of posture without one", |_| {
            "<changeposture> stands outside <tgt_motion>; it changes nothing".into()
        });
    }
    for child in &element.children {
        report_unexpected_gestural(child, element, node.findings);
    }
    node.report_unread_attributes();
    MotionKind::Still
}

fn read_directed_motion(node: &mut AttributeReader<'_, '_>) -> MotionKind {
    let curve = node.read_compass_attribute("curve").map(|to| PathCurve {
        to,
        size: node.read_word_attribute("curve_size"),
    });
    MotionKind::Directed(DirectedPath {
        direction: required(node, "direction"),
        second: node.read_direction_attribute("second_direction"),
        size: SizeAmount {
            first: node.read_word_attribute("size"),
            second: node.read_word_attribute("second_size"),
        },
        curve,
        zigzag: read_motion_zigzag(node),
        ellipse: node.read_word_attribute("ellipse_direction"),
    })
}

/// Reads a required direction; outward if it is missing.
fn required(node: &mut AttributeReader<'_, '_>, name: &str) -> SpatialDirection {
    node.read_direction_attribute(name).unwrap_or_else(|| {
        node.add_element_warning("motions without a direction", |tag| {
            format!("<{tag}> has no {name} that can be read; it was taken as \"o\"")
        });
        SpatialDirection::OUT_DIRECTION
    })
}

fn read_motion_zigzag(node: &mut AttributeReader<'_, '_>) -> Option<PathZigzag> {
    let wavy = node.parse_attribute("zigzag_style", "zigzag or wavy", |text| match text {
        "zigzag" => Some(false),
        "wavy" => Some(true),
        _ => None,
    });
    let size = node.read_word_attribute("zigzag_size");
    let growth = read_size_growth(node, "zigzag_incrdecr");
    let zigzag = wavy.map(|wavy| PathZigzag { wavy, size, growth });
    if zigzag.is_none() && (size.is_some() || growth.is_some()) {
        node.add_element_warning("zigzags without a style", |tag| {
            format!("<{tag}> says how a zigzag is without zigzag_style; it was left out")
        });
    }
    zigzag
}

fn read_size_growth(node: &mut AttributeReader<'_, '_>, name: &str) -> Option<MotionGrowth> {
    let increasing = node.parse_attribute(name, "increasing or decreasing", |text| match text {
        "increasing" => Some(true),
        "decreasing" => Some(false),
        _ => None,
    });
    let size = node.read_word_attribute(&format!("{name}_size"));
    if increasing.is_none() && size.is_some() {
        node.add_element_warning("growth without a way", |tag| {
            format!("<{tag}> has {name}_size without {name}; it was left out")
        });
    }
    increasing.map(|increasing| MotionGrowth { increasing, size })
}

fn read_circular_motion(node: &mut AttributeReader<'_, '_>) -> MotionKind {
    let full = u8::from(node.read_flag_attribute("clockplus")) + u8::from(node.read_flag_attribute("second_clockplus"));
    MotionKind::Circular(CircularPath {
        axis: required(node, "axis"),
        second: node.read_direction_attribute("second_axis"),
        size: SizeAmount {
            first: node.read_word_attribute("size"),
            second: node.read_word_attribute("second_size"),
        },
        ellipse: node.read_word_attribute("ellipse_direction"),
        ellipse_size: node.read_word_attribute("ellipse_size"),
        clock: ClockRange {
            start: node.read_compass_attribute("start"),
            end: node.read_compass_attribute("end"),
            full,
        },
        zigzag: read_motion_zigzag(node),
        growth: read_size_growth(node, "incrdecr"),
    })
}

fn read_wrist_motion(node: &mut AttributeReader<'_, '_>) -> MotionKind {
    let size = node.read_word_attribute("size");
    match node.read_word_attribute("motion") {
        Some(motion) => MotionKind::Wrist { motion, size },
        None => {
            node.add_element_warning("wrist motions without a kind", |tag| {
                format!("<{tag}> has no motion that can be read; nothing moves")
            });
            MotionKind::Still
        }
    }
}

fn read_cross_motion(node: &mut AttributeReader<'_, '_>) -> MotionKind {
    let diagonal = node.parse_attribute("cross", "plus or x", |text| match text {
        "plus" => Some(false),
        "x" => Some(true),
        _ => None,
    });
    MotionKind::Cross {
        diagonal: diagonal.unwrap_or_default(),
    }
}

fn read_child_motions(element: &SigmlElement<'_>, findings: &mut FindingTally) -> Vec<NotatedMotion> {
    let mut motions = Vec::new();
    for child in &element.children {
        if is_motion(&child.name) {
            motions.push(read_motion(child, findings));
        } else {
            report_unexpected_gestural(child, element, findings);
        }
    }
    if motions.len() < 2 && matches!(&*element.name, "par_motion" | "seq_motion") {
        findings.add_limited_finding("groups of one motion", || {
            let message = format!(
                "<{}> holds {} motions instead of two or more",
                element.name,
                motions.len()
            );
            ImportFinding::new_note_finding(element.line.0, message)
        });
    }
    motions
}

/// Returns the motion of an element; several motions become a sequence.
fn read_single_motion(
    element: &SigmlElement<'_>,
    mut motions: Vec<NotatedMotion>,
    findings: &mut FindingTally,
) -> Option<NotatedMotion> {
    if motions.len() < 2 {
        return motions.pop();
    }
    findings.add_limited_finding("several motions in place of one", || {
        let message = format!(
            "<{}> holds {} motions instead of one; they were read as a sequence",
            element.name,
            motions.len()
        );
        ImportFinding::new_warning_finding(element.line.0, message).with_remedy("put them into <seq_motion>")
    });
    let fused = false;
    Some(NotatedMotion::new(MotionKind::Sequence { motions, fused }))
}

fn read_split_motion(element: &SigmlElement<'_>, findings: &mut FindingTally) -> MotionKind {
    let mut halves = read_child_motions(element, findings);
    if halves.len() < 2 {
        one_half(element, findings);
    }
    if halves.len() > 2 {
        findings.add_limited_finding("splits with more than two halves", || {
            let message = format!(
                "<{}> holds more than two motions; the others were left out",
                element.name
            );
            ImportFinding::new_warning_finding(element.line.0, message)
        });
        halves.truncate(2);
    }
    let mut halves = halves.into_iter().map(Box::new);
    MotionKind::Split(halves.next(), halves.next())
}

fn read_target_motion(element: &SigmlElement<'_>, findings: &mut FindingTally) -> MotionKind {
    let mut posture = gestural_posture::PostureReader::new(element);
    let mut motions = Vec::new();
    for child in &element.children {
        if posture.is_posture_part(&child.name) {
            posture.read_posture_part(child, findings);
        } else if child.name == "changeposture" {
            let mut node = AttributeReader::new(child, findings);
            if node.name_number("def_locname").is_some() {
                node.add_element_warning("places named by a motion", |tag| {
                    format!("<{tag} def_locname>: the end of a motion can't be named here; the name was left out")
                });
            }
            node.report_unread_attributes();
        } else if is_motion(&child.name) {
            motions.push(read_motion(child, findings));
        } else {
            report_unexpected_gestural(child, element, findings);
        }
    }
    let posture = posture.finish_posture();
    if posture.is_empty() {
        findings.add_limited_note(
            "targets without a posture",
            element.line.0,
            || "<tgt_motion> says no posture that it ends in",
        );
    }
    MotionKind::Target {
        motion: read_single_motion(element, motions, findings).map(Box::new),
        posture: Box::new(posture),
    }
}

fn read_repeated_motion(element: &SigmlElement<'_>, mut node: AttributeReader<'_, '_>) -> MotionKind {
    let repeat = node.read_word_attribute("repetition");
    if repeat.is_none() {
        node.add_element_warning("repetitions without a kind", |tag| {
            format!("<{tag}> has no repetition that can be read; it was taken as \"fromstart\"")
        });
    }
    let repetition = MotionRepetition {
        repeat: repeat.unwrap_or(RepeatKind::FromStart),
        second: node.read_word_attribute("second_repetition"),
        growth: read_size_growth(&mut node, "repetition_incrdecr"),
        shift: node.read_direction_attribute("repetition_baseshift"),
        shift_size: node.read_word_attribute("baseshift_size"),
        shift_growth: read_size_growth(&mut node, "baseshift_incrdecr"),
        approx: node.read_flag_attribute("approx_repetition"),
    };
    let inner_motions = read_child_motions(element, node.findings);
    let motion = read_single_motion(element, inner_motions, node.findings);
    if motion.is_none() {
        node.add_element_warning("repetitions of nothing", |tag| {
            format!("<{tag}> holds no motion; nothing moves")
        });
    }
    node.report_unread_attributes();
    motion.map_or(MotionKind::Still, |motion| MotionKind::Repeated {
        motion: Box::new(motion),
        repetition,
    })
}
