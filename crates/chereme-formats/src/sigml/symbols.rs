//! Converts H-SiGML to and from notated signs: HamNoSys's symbols as elements.

use super::node::Node;
use super::raw::{Element, shown};
use crate::finding::Finding;
use crate::tally::Findings;
use chereme_sign::hamnosys::{
    Act, Nonmanual, NonmanualPart, Notated, Sign, Symbol, parse_lenient, spelled_symbols,
};
use chereme_sign::text::nearest;

/// The elements of face and body.
const PARTS: [(&str, NonmanualPart); 10] = [
    ("hnm_shoulder", NonmanualPart::Shoulders),
    ("hnm_body", NonmanualPart::Body),
    ("hnm_head", NonmanualPart::Head),
    ("hnm_eyegaze", NonmanualPart::Gaze),
    ("hnm_eyebrows", NonmanualPart::Brows),
    ("hnm_eyelids", NonmanualPart::Lids),
    ("hnm_nose", NonmanualPart::Nose),
    ("hnm_mouthgesture", NonmanualPart::MouthGesture),
    ("hnm_mouthpicture", NonmanualPart::MouthPicture),
    ("hnm_extra", NonmanualPart::Extra),
];

/// Elements for line and page breaks, without meaning.
const LAYOUT: [&str; 6] = [
    "hamtab",
    "hamlinefeed",
    "hampagebreak",
    "hamreturn",
    "hamnbs",
    "hamversion40",
];

/// Reads the two halves of a sign: its tree with its original text, and face and body.
pub(super) fn read_sign(
    element: &Element<'_>,
    findings: &mut Findings,
) -> (Sign, Option<String>, Nonmanual) {
    let (mut symbols, mut nonmanual) = (Vec::new(), Nonmanual::default());
    for child in &element.children {
        match &*child.name {
            "hamnosys_manual" => symbols.extend(read_symbols(child, findings)),
            "hamnosys_nonmanual" => read_nonmanual(child, findings, &mut nonmanual),
            _ => unexpected(child, element, findings),
        }
    }
    if symbols.is_empty() {
        return (Sign::default(), None, nonmanual);
    }
    let text: String = symbols.iter().map(|(symbol, _)| symbol.char()).collect();
    let read = parse_lenient(&text);
    for found in &read.findings {
        let line = symbols.get(found.index).map(|(_, line)| *line);
        let kind = if found.dropped {
            "symbols that no sign can be read from"
        } else {
            "odd symbols"
        };
        findings.add(kind, || {
            let message = format!("symbol {}: {}", found.number(), found.message);
            let finding = if found.dropped {
                Finding::warning(line, message)
            } else {
                Finding::note(line, message)
            };
            finding.with_remedy(found.remedy)
        });
    }
    (read.sign, Some(text), nonmanual)
}

/// Returns the symbols with their lines.
fn read_symbols(element: &Element<'_>, findings: &mut Findings) -> Vec<(Symbol, u64)> {
    Node::new(element, findings).finish();
    let mut symbols = Vec::new();
    for child in &element.children {
        let symbol = Symbol::from_name(&child.name);
        let exact = symbol.is_some_and(|symbol| symbol.name() == child.name);
        match symbol {
            _ if !exact && LAYOUT.contains(&&*child.name) => findings.add("layout", || {
                let message = format!("<{}> is layout; it was left out", child.name);
                Finding::note(child.line.0, message)
            }),
            Some(symbol) => {
                if !exact {
                    findings.add("symbols by another name", || {
                        let (name, right) = (shown(&child.name), symbol.name());
                        Finding::note(child.line.0, format!("<{name}> was read as <{right}>"))
                    });
                }
                symbols.push((symbol, child.line.0));
            }
            None => findings.add("symbols that are not known", || {
                let message = format!(
                    "<{}> is not a symbol of HamNoSys; it was left out",
                    shown(&child.name)
                );
                let near = nearest(&child.name, Symbol::all().map(Symbol::name));
                let remedy = near.map_or_else(
                    || "write one of its 209 symbols".to_owned(),
                    |near| format!("write one of its 209 symbols, perhaps <{near}>"),
                );
                Finding::warning(child.line.0, message).with_remedy(remedy)
            }),
        }
    }
    symbols
}

fn read_nonmanual(element: &Element<'_>, findings: &mut Findings, said: &mut Nonmanual) {
    Node::new(element, findings).finish();
    for child in &element.children {
        let Some((_, part)) = PARTS.iter().find(|(name, _)| *name == child.name) else {
            unexpected(child, element, findings);
            continue;
        };
        let mut node = Node::new(child, findings);
        let Some(tag) = node.text(tag_name(*part)) else {
            node.warn("acts without a tag", |name| {
                format!("<{name}> has no {}; it was left out", tag_name(*part))
            });
            continue;
        };
        if tag.trim().is_empty() {
            node.note("acts with an empty tag", |name| {
                format!(
                    "<{name} {}=\"\"> says nothing; it was left out",
                    tag_name(*part)
                )
            });
            continue;
        }
        let act = Act::new(*part, tag);
        if !act.is_listed() {
            node.note("tags that are not listed", |name| {
                format!(
                    "<{name}>: SiGML 1.2 lists no {:?}; it was kept as it is",
                    shown(tag)
                )
            });
        }
        node.finish();
        said.push(part.tier(), vec![act]);
    }
}

fn tag_name(part: NonmanualPart) -> &'static str {
    if part == NonmanualPart::MouthPicture {
        "picture"
    } else {
        "tag"
    }
}

fn unexpected(child: &Element<'_>, parent: &Element<'_>, findings: &mut Findings) {
    findings.add("elements that are not known", || {
        let (child_name, parent) = (shown(&child.name), shown(&parent.name));
        let message = format!("<{child_name}> has no place in <{parent}>; it was left out");
        Finding::warning(child.line.0, message)
    });
}

/// Adds the two halves of a sign to its element, and returns the parts that they cannot express.
pub(super) fn write_sign(sign: &Notated, element: &mut Element<'static>) -> Vec<String> {
    let mut lost = Vec::new();
    if !sign.nonmanual.is_empty() {
        element
            .children
            .push(write_nonmanual(&sign.nonmanual, &mut lost));
    }
    let printed = sign.hamnosys();
    lost.extend(printed.losses.into_iter().map(|loss| loss.message));
    let mut manual = Element::new("hamnosys_manual");
    let (symbols, odd) = spelled_symbols(&printed.text);
    if !odd.is_empty() {
        lost.push("words that name no symbol".to_owned());
    }
    let elements = symbols.into_iter();
    manual
        .children
        .extend(elements.map(|symbol| Element::new(symbol.name())));
    element.children.push(manual);
    lost
}

fn write_nonmanual(said: &Nonmanual, lost: &mut Vec<String>) -> Element<'static> {
    let mut whole = Element::new("hamnosys_nonmanual");
    let mut lose = |what: &str| {
        if lost.iter().all(|known| known != what) {
            lost.push(what.to_owned());
        }
    };
    for tier in said.tiers.values() {
        if tier.start.is_some() || tier.end.is_some() || tier.fit_picture {
            lose("when face and body start and end");
        }
        if tier.groups.iter().any(|group| group.len() > 1) {
            lose("what of face and body happens at the same time");
        }
    }
    for (kind, act) in said.acts() {
        let Some((name, _)) = PARTS.iter().find(|(_, part)| *part == act.part) else {
            lose("what face and body hold on to");
            continue;
        };
        if act.amount.is_some() || act.speed.is_some() {
            lose("how much and how fast face and body act");
        }
        if act.part.tier() != kind {
            lose("the tier of acts that stand in another's");
        }
        let mut element = Element::new(*name);
        let picture = act.part == NonmanualPart::MouthPicture;
        let tag = if picture { &act.tag } else { act.code() };
        element.set(tag_name(act.part), tag);
        whole.children.push(element);
    }
    whole
}
