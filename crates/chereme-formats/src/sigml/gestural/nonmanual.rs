//! Reads and writes the non-manual tiers of gestural SiGML.

use super::super::node::Node;
use super::super::raw::Element;
use super::super::words::{Word, group_name, tag_name};
use super::unexpected;
use super::write::number;
use crate::finding::Finding;
use crate::tally::Findings;
use chereme_sign::hamnosys::{Act, Nonmanual, NonmanualPart, NonmanualTier, TierKind};

/// Reads `sign_nonmanual`.
pub(in super::super) fn read_nonmanual(
    element: &Element<'_>,
    findings: &mut Findings,
    nonmanual: &mut Nonmanual,
) {
    Node::new(element, findings).finish();
    for child in &element.children {
        let Some(kind) = TierKind::of(&child.name) else {
            unexpected(child, element, findings);
            continue;
        };
        let tier = read_tier(child, kind, findings);
        if tier.is_empty() {
            continue;
        }
        if let Some(known) = nonmanual.tiers.get_mut(&kind) {
            findings.add("tiers said twice", || {
                let message = format!(
                    "<{}> stands twice; the second follows the first",
                    child.name
                );
                Finding::warning(child.line.0, message)
            });
            known.groups.extend(tier.groups);
        } else {
            nonmanual.tiers.insert(kind, tier);
        }
    }
}

fn read_tier(element: &Element<'_>, kind: TierKind, findings: &mut Findings) -> NonmanualTier {
    let mut node = Node::new(element, findings);
    let mut tier = NonmanualTier {
        start: node.word("presynchronization"),
        end: node.word("postsynchronization"),
        fit_picture: kind == TierKind::Mouthing && node.flag("fitpicturetomanual"),
        groups: Vec::new(),
    };
    node.finish();
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

fn read_group(element: &Element<'_>, kind: TierKind, findings: &mut Findings) -> Vec<Act> {
    if element.name != group_name(kind) {
        findings.add("groups of another tier", || {
            let right = group_name(kind);
            let message = format!(
                "<{}> was read as <{right}>",
                super::super::raw::shown(&element.name)
            );
            Finding::note(element.line.0, message)
        });
    }
    Node::new(element, findings).finish();
    let acts = element.children.iter();
    acts.filter_map(|child| read_act(child, element, kind, findings))
        .collect()
}

fn read_act(
    element: &Element<'_>,
    parent: &Element<'_>,
    kind: TierKind,
    findings: &mut Findings,
) -> Option<Act> {
    let Some(part) = NonmanualPart::of(&element.name) else {
        unexpected(element, parent, findings);
        return None;
    };
    let mut node = Node::new(element, findings);
    let tag = tag(&mut node, part)?;
    if tag.trim().is_empty() && part != NonmanualPart::Neutral {
        node.note("acts with an empty tag", |name| {
            format!(
                "<{name} {}=\"\"> says nothing; it was left out",
                tag_name(part)
            )
        });
        return None;
    }
    let act = Act {
        part,
        tag: tag.to_owned(),
        amount: node.number("amount"),
        speed: node.number("speed"),
    };
    if act.amount.is_some() || act.speed.is_some() {
        node.note("amounts and speeds of face and body", |tag| {
            format!(
                "<{tag}> has an amount or speed, which is not in SiGML 1.2; it was kept as a factor"
            )
        });
    }
    if part.tier() != kind && part != NonmanualPart::Neutral {
        node.note("acts in another tier", |tag| {
            let right = part.tier().word();
            format!(
                "<{tag}> belongs into <{right}>; it was kept in <{}>",
                kind.word()
            )
        });
    }
    if !act.is_listed() {
        node.note("tags that are not listed", |name| {
            let shown = super::super::raw::shown(&act.tag);
            format!("<{name}>: SiGML 1.2 lists no {shown:?}; it was kept as it is")
        });
    }
    node.finish();
    Some(act)
}

/// Returns the tag of an act, even if it is in the attribute of another part.
fn tag<'e>(node: &mut Node<'e, '_>, part: NonmanualPart) -> Option<&'e str> {
    let right = tag_name(part);
    if let Some(tag) = node.text(right) {
        return Some(tag);
    }
    if let Some(tag) = ["movement", "direction", "tag"]
        .into_iter()
        .find_map(|name| node.text(name))
    {
        node.note("tags in another attribute", |name| {
            format!(
                "<{name}> should say {:?} in {right}",
                super::super::raw::shown(tag)
            )
        });
        return Some(tag);
    }
    if part == NonmanualPart::Neutral {
        return Some("");
    }
    node.warn("acts without a tag", |name| {
        format!("<{name}> has no {right}; it was left out")
    });
    None
}

/// Returns `sign_nonmanual`.
pub(in super::super) fn write_nonmanual(nonmanual: &Nonmanual) -> Element<'static> {
    let mut whole = Element::new("sign_nonmanual");
    for (kind, tier) in &nonmanual.tiers {
        let mut element = Element::new(kind.word());
        element.word("presynchronization", tier.start);
        element.word("postsynchronization", tier.end);
        element.flag("fitpicturetomanual", tier.fit_picture);
        for group in &tier.groups {
            match group.as_slice() {
                [act] => element.children.push(write_act(act)),
                acts => {
                    let mut group = Element::new(group_name(*kind));
                    group.children.extend(acts.iter().map(write_act));
                    element.children.push(group);
                }
            }
        }
        whole.children.push(element);
    }
    whole
}

fn write_act(act: &Act) -> Element<'static> {
    let mut element = Element::new(act.part.word());
    if act.part != NonmanualPart::Neutral || !act.tag.is_empty() {
        element.set(tag_name(act.part), act.tag.clone());
    }
    element.some("amount", act.amount.map(number));
    element.some("speed", act.speed.map(number));
    element
}
