//! Converts gestural SiGML to and from the tree of a sign.

mod gestural_motion;
mod gestural_nonmanual;
mod gestural_posture;
mod gestural_write;

use super::node::AttributeReader;
use super::sigml_raw::SigmlElement;
use crate::finding::ImportFinding;
use crate::tally::FindingTally;
use chereme_sign::hamnosys::{
    BodyAction, HamnosysSign, HandSymmetry, HandsUsed, ManualPart, NonmanualActs, NotatedMotion,
};

pub(super) use gestural_nonmanual::{read_nonmanual, write_nonmanual};
pub(super) use gestural_write::write_manual;

/// Reads the actions of the hands, one `sign_manual` after the other; nested ones are the parts of a compound.
pub(super) fn read_manual(element: &SigmlElement<'_>, findings: &mut FindingTally, sign: &mut HamnosysSign) {
    let nested = |child: &&SigmlElement<'_>| child.name == "sign_manual";
    if !element.children.iter().any(|child| nested(&child)) {
        sign.parts.push(read_part(element, findings));
        return;
    }
    AttributeReader::new(element, findings).report_unread_attributes();
    for child in &element.children {
        if nested(&child) {
            read_manual(child, findings, sign);
        } else {
            report_unexpected_gestural(child, element, findings);
        }
    }
}

fn read_part(element: &SigmlElement<'_>, findings: &mut FindingTally) -> ManualPart {
    let mut node = AttributeReader::new(element, findings);
    let symmetry = HandSymmetry {
        left_right: node.read_flag_attribute("lr_symm"),
        up_down: node.read_flag_attribute("ud_symm"),
        out_in: node.read_flag_attribute("oi_symm"),
        out_of_phase: node.read_flag_attribute("outofphase"),
        real_space: node.read_flag_attribute("realspace"),
    };
    let (both, other) = (
        node.read_flag_attribute("both_hands"),
        node.read_flag_attribute("nondominant"),
    );
    let holdover = node.read_flag_attribute("holdover");
    if !both && symmetry != HandSymmetry::default() {
        node.add_element_note("symmetry of one hand", |tag| {
            format!("<{tag}> names a symmetry without both_hands; it was read as two-handed")
        });
    }
    let hands = if both || symmetry != HandSymmetry::default() {
        HandsUsed::Both(symmetry)
    } else if other {
        HandsUsed::Nondominant
    } else {
        HandsUsed::Dominant
    };
    if other && hands != HandsUsed::Nondominant {
        node.add_element_warning("two hands and one", |tag| {
            format!("<{tag}> is two-handed and of the non-dominant hand; the second was left out")
        });
    }
    node.report_unread_attributes();
    let mut part = ManualPart {
        hands,
        holdover,
        ..ManualPart::default()
    };
    let mut posture = gestural_posture::PostureReader::new(element);
    for child in &element.children {
        if posture.is_posture_part(&child.name) {
            if !part.actions.is_empty() {
                report_late_element(child, findings);
            }
            posture.read_posture_part(child, findings);
        } else if child.name == "nonmanualconfig" {
            part.body.extend(read_body_action(child, findings));
        } else if gestural_motion::is_motion(&child.name) {
            part.actions.push(gestural_motion::read_motion(child, findings));
        } else {
            report_unexpected_gestural(child, element, findings);
        }
    }
    part.posture = posture.finish_posture();
    part
}

/// Reads `nonmanualconfig` or `nonman_motion`: a part of the body, and its action.
fn read_body_action(element: &SigmlElement<'_>, findings: &mut FindingTally) -> Option<BodyAction> {
    let (mut part, mut side) = (None, None);
    let mut motion: Option<NotatedMotion> = None;
    for child in &element.children {
        if child.name == "handconfig" && part.is_none() {
            let mut node = AttributeReader::new(child, findings);
            part = node.read_word_attribute("bodypart");
            side = node.read_word_attribute("side");
            node.report_unread_attributes();
        } else if gestural_motion::is_motion(&child.name) && motion.is_none() {
            motion = Some(gestural_motion::read_motion(child, findings));
        } else {
            report_unexpected_gestural(child, element, findings);
        }
    }
    let Some(part) = part else {
        findings.add_limited_finding("body actions without a part of the body", || {
            let message = format!("<{}> names no part of the body; it was left out", element.name);
            ImportFinding::new_warning_finding(element.line.0, message)
                .with_remedy("begin it with <handconfig bodypart=\"shoulders\"/> or another part")
        });
        return None;
    };
    let motion = motion.map(Box::new);
    Some(BodyAction { part, side, motion })
}

fn report_late_element(child: &SigmlElement<'_>, findings: &mut FindingTally) {
    findings.add_limited_finding("postures after motions", || {
        let message = format!(
            "<{}> stands after a motion; it was read as part of the posture the sign begins with",
            child.name
        );
        ImportFinding::new_warning_finding(child.line.0, message)
            .with_remedy("write the posture first, or put a target into <tgt_motion>")
    });
}

/// Reports an element that does not belong at its place.
fn report_unexpected_gestural(child: &SigmlElement<'_>, parent: &SigmlElement<'_>, findings: &mut FindingTally) {
    findings.add_limited_finding("elements that are not known", || {
        let (child_name, parent) = (
            super::sigml_raw::shorten_sigml_text(&child.name),
            super::sigml_raw::shorten_sigml_text(&parent.name),
        );
        let message = format!("<{child_name}> has no place in <{parent}>; it was left out");
        ImportFinding::new_warning_finding(child.line.0, message)
    });
}

/// Reads a gestural sign's two halves, in either order.
pub(super) fn read_sign(element: &SigmlElement<'_>, findings: &mut FindingTally) -> (HamnosysSign, NonmanualActs) {
    let (mut sign, mut nonmanual) = (HamnosysSign::default(), NonmanualActs::default());
    for child in &element.children {
        match &*child.name {
            "sign_manual" => read_manual(child, findings, &mut sign),
            "sign_nonmanual" => read_nonmanual(child, findings, &mut nonmanual),
            _ => report_unexpected_gestural(child, element, findings),
        }
    }
    (sign, nonmanual)
}
