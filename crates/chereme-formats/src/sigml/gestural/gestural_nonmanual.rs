//! Reads and writes the non-manual tiers of gestural SiGML.

use super::super::node::AttributeReader;
use super::super::sigml_raw::SigmlElement;
use super::super::sigml_words::{SigmlWord, group_name, tag_name};
use super::gestural_write::format_sigml_number;
use super::report_unexpected_gestural;
use crate::finding::ImportFinding;
use crate::tally::FindingTally;
use chereme_sign::hamnosys::{NonmanualAct, NonmanualActs, NonmanualPart, NonmanualTier, TierKind};

/// Reads `sign_nonmanual`.
pub(in super::super) fn read_nonmanual(
    element: &SigmlElement<'_>,
    findings: &mut FindingTally,
    nonmanual: &mut NonmanualActs,
) {
    AttributeReader::new(element, findings).report_unread_attributes();
    for child in &element.children {
        let Some(kind) = TierKind::from_sigml_word(&child.name) else {
            report_unexpected_gestural(child, element, findings);
            continue;
        };
        let tier = read_tier(child, kind, findings);
        if tier.is_empty() {
            continue;
        }
        if let Some(known) = nonmanual.tiers.get_mut(&kind) {
            findings.add_limited_finding("tiers said twice", || {
                let message = format!("<{}> stands twice; the second follows the first", child.name);
                ImportFinding::new_warning_finding(child.line.0, message)
            });
            known.groups.extend(tier.groups);
        } else {
            nonmanual.tiers.insert(kind, tier);
        }
    }
}

fn read_tier(element: &SigmlElement<'_>, kind: TierKind, findings: &mut FindingTally) -> NonmanualTier {
    let mut node = AttributeReader::new(element, findings);
    let mut tier = NonmanualTier {
        start: node.read_word_attribute("presynchronization"),
        end: node.read_word_attribute("postsynchronization"),
        fit_picture: kind == TierKind::Mouthing && node.read_flag_attribute("fitpicturetomanual"),
        groups: Vec::new(),
    };
    node.report_unread_attributes();
    for child in &element.children {
        if child.name.ends_with("_par") {
            let group = read_group(child, kind, findings);
            if !group.is_empty() {
                tier.groups.push(group);
            }
        } else if let Some(act) = read_act(child, element, kind, findings) {
            tier.groups.push(vec![act]);
        }
    }
    tier
}

fn read_group(element: &SigmlElement<'_>, kind: TierKind, findings: &mut FindingTally) -> Vec<NonmanualAct> {
    if element.name != group_name(kind) {
        findings.add_limited_finding("groups of another tier", || {
            let right = group_name(kind);
            let message = format!(
                "<{}> was read as <{right}>",
                super::super::sigml_raw::shorten_sigml_text(&element.name)
            );
            ImportFinding::new_note_finding(element.line.0, message)
        });
    }
    AttributeReader::new(element, findings).report_unread_attributes();
    let acts = element.children.iter();
    acts.filter_map(|child| read_act(child, element, kind, findings))
        .collect()
}

fn read_act(
    element: &SigmlElement<'_>,
    parent: &SigmlElement<'_>,
    kind: TierKind,
    findings: &mut FindingTally,
) -> Option<NonmanualAct> {
    let Some(part) = NonmanualPart::from_sigml_word(&element.name) else {
        report_unexpected_gestural(element, parent, findings);
        return None;
    };
    let mut node = AttributeReader::new(element, findings);
    let tag = read_act_tag(&mut node, part)?;
    if tag.trim().is_empty() && part != NonmanualPart::Neutral {
        node.add_element_note("acts with an empty tag", |name| {
            format!("<{name} {}=\"\"> says nothing; it was left out", tag_name(part))
        });
        return None;
    }
    let act = NonmanualAct {
        part,
        tag: tag.to_owned(),
        amount: node.read_positive_number("amount"),
        speed: node.read_positive_number("speed"),
    };
    if act.amount.is_some() || act.speed.is_some() {
        node.add_element_note("amounts and speeds of face and body", |tag| {
            format!("<{tag}> has an amount or speed, which is not in SiGML 1.2; it was kept as a factor")
        });
    }
    if part.sigml_tier() != kind && part != NonmanualPart::Neutral {
        node.add_element_note("acts in another tier", |tag| {
            let right = part.sigml_tier().sigml_word();
            format!("<{tag}> belongs into <{right}>; it was kept in <{}>", kind.sigml_word())
        });
    }
    if !act.is_listed() {
        node.add_element_note("tags that are not listed", |name| {
            let shown = super::super::sigml_raw::shorten_sigml_text(&act.tag);
            format!("<{name}>: SiGML 1.2 lists no {shown:?}; it was kept as it is")
        });
    }
    node.report_unread_attributes();
    Some(act)
}

/// Returns the tag of an act, even if it is in the attribute of another part.
fn read_act_tag<'e>(node: &mut AttributeReader<'e, '_>, part: NonmanualPart) -> Option<&'e str> {
    let right = tag_name(part);
    if let Some(tag) = node.attribute_text(right) {
        return Some(tag);
    }
    if let Some(tag) = ["movement", "direction", "tag"]
        .into_iter()
        .find_map(|name| node.attribute_text(name))
    {
        node.add_element_note("tags in another attribute", |name| {
            format!(
                "<{name}> should say {:?} in {right}",
                super::super::sigml_raw::shorten_sigml_text(tag)
            )
        });
        return Some(tag);
    }
    if part == NonmanualPart::Neutral {
        return Some("");
    }
    node.add_element_warning("acts without a tag", |name| {
        format!("<{name}> has no {right}; it was left out")
    });
    None
}

/// Returns `sign_nonmanual`.
pub(in super::super) fn write_nonmanual(nonmanual: &NonmanualActs) -> SigmlElement<'static> {
    let mut root_element = SigmlElement::new("sign_nonmanual");
    for (kind, tier) in &nonmanual.tiers {
        let mut element = SigmlElement::new(kind.sigml_word());
        element.set_word_attribute("presynchronization", tier.start);
        element.set_word_attribute("postsynchronization", tier.end);
        element.set_flag_attribute("fitpicturetomanual", tier.fit_picture);
        for group in &tier.groups {
            match group.as_slice() {
                [act] => element.children.push(write_act(act)),
                acts => {
                    let mut group = SigmlElement::new(group_name(*kind));
                    group.children.extend(acts.iter().map(write_act));
                    element.children.push(group);
                }
            }
        }
        root_element.children.push(element);
    }
    root_element
}

fn write_act(act: &NonmanualAct) -> SigmlElement<'static> {
    let mut element = SigmlElement::new(act.part.sigml_word());
    if act.part != NonmanualPart::Neutral || !act.tag.is_empty() {
        element.set_attribute(tag_name(act.part), act.tag.clone());
    }
    element.set_optional_attribute("amount", act.amount.map(format_sigml_number));
    element.set_optional_attribute("speed", act.speed.map(format_sigml_number));
    element
}
