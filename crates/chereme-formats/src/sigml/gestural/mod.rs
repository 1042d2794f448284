//! Converts gestural SiGML to and from the tree of a sign.

mod motion;
mod nonmanual;
mod posture;
mod write;

use super::node::Node;
use super::raw::Element;
use crate::finding::Finding;
use crate::tally::Findings;
use chereme_sign::hamnosys::{BodyAction, HandsUsed, Manual, Motion, Nonmanual, Sign, Symmetry};

pub(super) use nonmanual::{read_nonmanual, write_nonmanual};
pub(super) use write::write_manual;

/// Reads the actions of the hands, one `sign_manual` after the other; nested ones are the parts of a compound.
pub(super) fn read_manual(element: &Element<'_>, findings: &mut Findings, sign: &mut Sign) {
    let nested = |child: &&Element<'_>| child.name == "sign_manual";
    if !element.children.iter().any(|child| nested(&child)) {
        sign.parts.push(read_part(element, findings));
        return;
    }
    Node::new(element, findings).finish();
    for child in &element.children {
        if nested(&child) {
            read_manual(child, findings, sign);
        } else {
            unexpected(child, element, findings);
        }
    }
}

fn read_part(element: &Element<'_>, findings: &mut Findings) -> Manual {
    let mut node = Node::new(element, findings);
    let symmetry = Symmetry {
        left_right: node.flag("lr_symm"),
        up_down: node.flag("ud_symm"),
        out_in: node.flag("oi_symm"),
        out_of_phase: node.flag("outofphase"),
        real_space: node.flag("realspace"),
    };
    let (both, other) = (node.flag("both_hands"), node.flag("nondominant"));
    let holdover = node.flag("holdover");
    if !both && symmetry != Symmetry::default() {
        node.note("symmetry of one hand", |tag| {
            format!("<{tag}> names a symmetry without both_hands; it was read as two-handed")
        });
    }
    let hands = if both || symmetry != Symmetry::default() {
        HandsUsed::Both(symmetry)
    } else if other {
        HandsUsed::Nondominant
    } else {
        HandsUsed::Dominant
    };
    if other && hands != HandsUsed::Nondominant {
        node.warn("two hands and one", |tag| {
            format!("<{tag}> is two-handed and of the non-dominant hand; the second was left out")
        });
    }
    node.finish();
    let mut part = Manual {
        hands,
        holdover,
        ..Manual::default()
    };
    let mut posture = posture::Reader::new(element);
    for child in &element.children {
        if posture.takes(&child.name) {
            if !part.actions.is_empty() {
                late(child, findings);
            }
            posture.take(child, findings);
        } else if child.name == "nonmanualconfig" {
            part.body.extend(body_action(child, findings));
        } else if motion::is_motion(&child.name) {
            part.actions.push(motion::read_motion(child, findings));
        } else {
            unexpected(child, element, findings);
        }
    }
    part.posture = posture.finish();
    part
}

/// Reads `nonmanualconfig` or `nonman_motion`: a part of the body, and its action.
fn body_action(element: &Element<'_>, findings: &mut Findings) -> Option<BodyAction> {
    let (mut part, mut side) = (None, None);
    let mut motion: Option<Motion> = None;
    for child in &element.children {
        if child.name == "handconfig" && part.is_none() {
            let mut node = Node::new(child, findings);
            part = node.word("bodypart");
            side = node.word("side");
            node.finish();
        } else if motion::is_motion(&child.name) && motion.is_none() {
            motion = Some(motion::read_motion(child, findings));
        } else {
            unexpected(child, element, findings);
        }
    }
    let Some(part) = part else {
        findings.add("body actions without a part of the body", || {
            let message = format!(
                "<{}> names no part of the body; it was left out",
                element.name
            );
            Finding::warning(element.line.0, message)
                .with_remedy("begin it with <handconfig bodypart=\"shoulders\"/> or another part")
        });
        return None;
    };
    let motion = motion.map(Box::new);
    Some(BodyAction { part, side, motion })
}

fn late(child: &Element<'_>, findings: &mut Findings) {
    findings.add("postures after motions", || {
        let message = format!(
            "<{}> stands after a motion; it was read as part of the posture the sign begins with",
            child.name
        );
        Finding::warning(child.line.0, message)
            .with_remedy("write the posture first, or put a target into <tgt_motion>")
    });
}

/// Reports an element that does not belong at its place.
fn unexpected(child: &Element<'_>, parent: &Element<'_>, findings: &mut Findings) {
    findings.add("elements that are not known", || {
        let (child_name, parent) = (
            super::raw::shown(&child.name),
            super::raw::shown(&parent.name),
        );
        let message = format!("<{child_name}> has no place in <{parent}>; it was left out");
        Finding::warning(child.line.0, message)
    });
}

/// Reads a gestural sign's two halves, in either order.
pub(super) fn read_sign(element: &Element<'_>, findings: &mut Findings) -> (Sign, Nonmanual) {
    let (mut sign, mut nonmanual) = (Sign::default(), Nonmanual::default());
    for child in &element.children {
        match &*child.name {
            "sign_manual" => read_manual(child, findings, &mut sign),
            "sign_nonmanual" => read_nonmanual(child, findings, &mut nonmanual),
            _ => unexpected(child, element, findings),
        }
    }
    (sign, nonmanual)
}
