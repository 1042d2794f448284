//! Reads motions.

use super::super::node::Node;
use super::super::raw::Element;
use super::posture::{self, is_place, one_half, read_place};
use super::{body_action, unexpected};
use crate::finding::Finding;
use crate::tally::Findings;
use chereme_sign::hamnosys::{
    Amount, Circular, Clock, Contact, Curve, Directed, Direction, Growth, Manner, Motion,
    MotionKind, Place, Posture, Repeat, Repetition, Zigzag,
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
pub(super) fn read_motion(element: &Element<'_>, findings: &mut Findings) -> Motion {
    let mut node = Node::new(element, findings);
    let manner = manner(&mut node);
    let kind = match &*element.name {
        "directedmotion" => simple(directed(&mut node), element, node),
        "circularmotion" => simple(circular(&mut node), element, node),
        "wristmotion" => simple(wrist(&mut node), element, node),
        "crossmotion" => simple(cross(&mut node), element, node),
        "fingerplay" => {
            let digits = node.digits("digits");
            simple(MotionKind::FingerPlay(digits), element, node)
        }
        "rpt_motion" => repeated(element, node),
        "seq_motion" => {
            let fused = node.flag("fused");
            node.finish();
            let motions = motions(element, findings);
            MotionKind::Sequence { motions, fused }
        }
        "par_motion" => {
            node.finish();
            MotionKind::Parallel(motions(element, findings))
        }
        "split_motion" => {
            node.finish();
            split(element, findings)
        }
        "tgt_motion" => {
            node.finish();
            target(element, findings)
        }
        "nonman_motion" => {
            node.finish();
            body_action(element, findings).map_or(MotionKind::Still, MotionKind::Body)
        }
        _ => still(element, node),
    };
    match kind {
        // The manner of a brushing motion is that of the motion, not of its target.
        MotionKind::Target { motion, posture } if is_simple(&element.name) => {
            let motion = motion.map(|motion| Box::new(Motion { manner, ..*motion }));
            Motion::new(MotionKind::Target { motion, posture })
        }
        kind => Motion {
            manner,
            ..Motion::new(kind)
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
fn simple(kind: MotionKind, element: &Element<'_>, mut node: Node<'_, '_>) -> MotionKind {
    if node.name_number("def_locname").is_some() {
        node.warn("places named by a motion", |tag| {
            format!("<{tag} def_locname>: the end of a motion can't be named here; the name was left out")
        });
    }
    let mut brushed = None;
    for child in &element.children {
        if is_place(&child.name) && brushed.is_none() {
            brushed = Some(brushing(read_place(child, node.findings)));
        } else {
            unexpected(child, element, node.findings);
        }
    }
    node.finish();
    match brushed {
        None => kind,
        Some(place) => MotionKind::Target {
            motion: Some(Box::new(Motion::new(kind))),
            posture: Box::new(Posture {
                place: Some(place),
                ..Posture::default()
            }),
        },
    }
}

fn brushing(mut place: Place) -> Place {
    let contact = match &mut place {
        Place::Body(place) => &mut place.contact,
        Place::Hand(site) => &mut site.contact,
        _ => return place,
    };
    if matches!(contact, None | Some(Contact::Touch)) {
        *contact = Some(Contact::Brushing);
    }
    place
}

fn manner(node: &mut Node<'_, '_>) -> Manner {
    if node.element.attributes.is_empty() {
        return Manner::default();
    }
    let word = node.parsed("manner", "fast, slow, tense, rest or halt", |text| {
        ["fast", "slow", "tense", "rest", "halt"]
            .into_iter()
            .find(|known| *known == text)
    });
    let mut set = |name: &str| node.flag(name) | (word == Some(name));
    let manner = Manner {
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
    let speed = node.number("speed");
    if speed.is_some() {
        node.note("speeds of single motions", |tag| {
            format!("<{tag} speed> is not in SiGML 1.2; it was kept as a factor")
        });
    }
    Manner { speed, ..manner }
}

fn still(element: &Element<'_>, mut node: Node<'_, '_>) -> MotionKind {
    let change = element.name == "changeposture";
    if element.name == "no_motion" {
        node.note("elements with another name", |_| {
            "<no_motion> was read as <nomotion>".into()
        });
    }
    if change {
        node.warn("changes of posture without one", |_| {
            "<changeposture> stands outside <tgt_motion>; it changes nothing".into()
        });
    }
    for child in &element.children {
        unexpected(child, element, node.findings);
    }
    node.finish();
    MotionKind::Still
}

fn directed(node: &mut Node<'_, '_>) -> MotionKind {
    let curve = node.compass("curve").map(|to| Curve {
        to,
        size: node.word("curve_size"),
    });
    MotionKind::Directed(Directed {
        direction: required(node, "direction"),
        second: node.direction("second_direction"),
        size: Amount {
            first: node.word("size"),
            second: node.word("second_size"),
        },
        curve,
        zigzag: zigzag(node),
        ellipse: node.word("ellipse_direction"),
    })
}

/// Reads a required direction; outward if it is missing.
fn required(node: &mut Node<'_, '_>, name: &str) -> Direction {
    node.direction(name).unwrap_or_else(|| {
        node.warn("motions without a direction", |tag| {
            format!("<{tag}> has no {name} that can be read; it was taken as \"o\"")
        });
        Direction::OUT
    })
}

fn zigzag(node: &mut Node<'_, '_>) -> Option<Zigzag> {
    let wavy = node.parsed("zigzag_style", "zigzag or wavy", |text| match text {
        "zigzag" => Some(false),
        "wavy" => Some(true),
        _ => None,
    });
    let size = node.word("zigzag_size");
    let growth = growth(node, "zigzag_incrdecr");
    let zigzag = wavy.map(|wavy| Zigzag { wavy, size, growth });
    if zigzag.is_none() && (size.is_some() || growth.is_some()) {
        node.warn("zigzags without a style", |tag| {
            format!("<{tag}> says how a zigzag is without zigzag_style; it was left out")
        });
    }
    zigzag
}

fn growth(node: &mut Node<'_, '_>, name: &str) -> Option<Growth> {
    let increasing = node.parsed(name, "increasing or decreasing", |text| match text {
        "increasing" => Some(true),
        "decreasing" => Some(false),
        _ => None,
    });
    let size = node.word(&format!("{name}_size"));
    if increasing.is_none() && size.is_some() {
        node.warn("growth without a way", |tag| {
            format!("<{tag}> has {name}_size without {name}; it was left out")
        });
    }
    increasing.map(|increasing| Growth { increasing, size })
}

fn circular(node: &mut Node<'_, '_>) -> MotionKind {
    let full = u8::from(node.flag("clockplus")) + u8::from(node.flag("second_clockplus"));
    MotionKind::Circular(Circular {
        axis: required(node, "axis"),
        second: node.direction("second_axis"),
        size: Amount {
            first: node.word("size"),
            second: node.word("second_size"),
        },
        ellipse: node.word("ellipse_direction"),
        ellipse_size: node.word("ellipse_size"),
        clock: Clock {
            start: node.compass("start"),
            end: node.compass("end"),
            full,
        },
        zigzag: zigzag(node),
        growth: growth(node, "incrdecr"),
    })
}

fn wrist(node: &mut Node<'_, '_>) -> MotionKind {
    let size = node.word("size");
    match node.word("motion") {
        Some(motion) => MotionKind::Wrist { motion, size },
        None => {
            node.warn("wrist motions without a kind", |tag| {
                format!("<{tag}> has no motion that can be read; nothing moves")
            });
            MotionKind::Still
        }
    }
}

fn cross(node: &mut Node<'_, '_>) -> MotionKind {
    let diagonal = node.parsed("cross", "plus or x", |text| match text {
        "plus" => Some(false),
        "x" => Some(true),
        _ => None,
    });
    MotionKind::Cross {
        diagonal: diagonal.unwrap_or_default(),
    }
}

fn motions(element: &Element<'_>, findings: &mut Findings) -> Vec<Motion> {
    let mut motions = Vec::new();
    for child in &element.children {
        if is_motion(&child.name) {
            motions.push(read_motion(child, findings));
        } else {
            unexpected(child, element, findings);
        }
    }
    if motions.len() < 2 && matches!(&*element.name, "par_motion" | "seq_motion") {
        findings.add("groups of one motion", || {
            let message = format!(
                "<{}> holds {} motions instead of two or more",
                element.name,
                motions.len()
            );
            Finding::note(element.line.0, message)
        });
    }
    motions
}

/// Returns the motion of an element; several motions become a sequence.
fn one(element: &Element<'_>, mut motions: Vec<Motion>, findings: &mut Findings) -> Option<Motion> {
    if motions.len() < 2 {
        return motions.pop();
    }
    findings.add("several motions in place of one", || {
        let message = format!(
            "<{}> holds {} motions instead of one; they were read as a sequence",
            element.name,
            motions.len()
        );
        Finding::warning(element.line.0, message).with_remedy("put them into <seq_motion>")
    });
    let fused = false;
    Some(Motion::new(MotionKind::Sequence { motions, fused }))
}

fn split(element: &Element<'_>, findings: &mut Findings) -> MotionKind {
    let mut halves = motions(element, findings);
    if halves.len() < 2 {
        one_half(element, findings);
    }
    if halves.len() > 2 {
        findings.add("splits with more than two halves", || {
            let message = format!(
                "<{}> holds more than two motions; the others were left out",
                element.name
            );
            Finding::warning(element.line.0, message)
        });
        halves.truncate(2);
    }
    let mut halves = halves.into_iter().map(Box::new);
    MotionKind::Split(halves.next(), halves.next())
}

fn target(element: &Element<'_>, findings: &mut Findings) -> MotionKind {
    let mut posture = posture::Reader::new(element);
    let mut motions = Vec::new();
    for child in &element.children {
        if posture.takes(&child.name) {
            posture.take(child, findings);
        } else if child.name == "changeposture" {
            let mut node = Node::new(child, findings);
            if node.name_number("def_locname").is_some() {
                node.warn("places named by a motion", |tag| {
                    format!("<{tag} def_locname>: the end of a motion can't be named here; the name was left out")
                });
            }
            node.finish();
        } else if is_motion(&child.name) {
            motions.push(read_motion(child, findings));
        } else {
            unexpected(child, element, findings);
        }
    }
    let posture = posture.finish();
    if posture.is_empty() {
        findings.add("targets without a posture", || {
            Finding::note(
                element.line.0,
                "<tgt_motion> says no posture that it ends in",
            )
        });
    }
    MotionKind::Target {
        motion: one(element, motions, findings).map(Box::new),
        posture: Box::new(posture),
    }
}

fn repeated(element: &Element<'_>, mut node: Node<'_, '_>) -> MotionKind {
    let repeat = node.word("repetition");
    if repeat.is_none() {
        node.warn("repetitions without a kind", |tag| {
            format!("<{tag}> has no repetition that can be read; it was taken as \"fromstart\"")
        });
    }
    let repetition = Repetition {
        repeat: repeat.unwrap_or(Repeat::FromStart),
        second: node.word("second_repetition"),
        growth: growth(&mut node, "repetition_incrdecr"),
        shift: node.direction("repetition_baseshift"),
        shift_size: node.word("baseshift_size"),
        shift_growth: growth(&mut node, "baseshift_incrdecr"),
        approx: node.flag("approx_repetition"),
    };
    let held = motions(element, node.findings);
    let motion = one(element, held, node.findings);
    if motion.is_none() {
        node.warn("repetitions of nothing", |tag| {
            format!("<{tag}> holds no motion; nothing moves")
        });
    }
    node.finish();
    motion.map_or(MotionKind::Still, |motion| MotionKind::Repeated {
        motion: Box::new(motion),
        repetition,
    })
}
