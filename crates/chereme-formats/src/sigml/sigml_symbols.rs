//! Converts H-SiGML to and from notated signs: HamNoSys's symbols as elements.

use super::node::AttributeReader;
use super::sigml_raw::{SigmlElement, shorten_sigml_text};
use crate::finding::ImportFinding;
use crate::tally::FindingTally;
use chereme_sign::hamnosys::{
    HamnosysSign, HamnosysSymbol, NonmanualAct, NonmanualActs, NonmanualPart, NotatedSign, parse_lenient,
    spelled_symbols,
};
use chereme_sign::text::nearest_candidate;

/// The elements of face and body.
const NONMANUAL_ELEMENT_PARTS: [(&str, NonmanualPart); 10] = [
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
const LAYOUT_ELEMENT_NAMES: [&str; 6] = [
    "hamtab",
    "hamlinefeed",
    "hampagebreak",
    "hamreturn",
    "hamnbs",
    "hamversion40",
];

/// Reads the two halves of a sign: its tree with its original text, and face and body.
pub(super) fn read_sign(
    element: &SigmlElement<'_>,
    findings: &mut FindingTally,
) -> (HamnosysSign, Option<String>, NonmanualActs) {
    let (mut symbols, mut nonmanual) = (Vec::new(), NonmanualActs::default());
    for child in &element.children {
        match &*child.name {
            "hamnosys_manual" => symbols.extend(read_symbols(child, findings)),
            "hamnosys_nonmanual" => read_nonmanual(child, findings, &mut nonmanual),
            _ => report_unexpected_symbol(child, element, findings),
        }
    }
    if symbols.is_empty() {
        return (HamnosysSign::default(), None, nonmanual);
    }
    let text: String = symbols.iter().map(|(symbol, _)| symbol.symbol_char()).collect();
    let read = parse_lenient(&text);
    for found in &read.findings {
        let line = symbols.get(found.index).map(|(_, line)| *line);
        let kind = if found.dropped {
            "symbols that no sign can be read from"
        } else {
            "odd symbols"
        };
        findings.add_limited_finding(kind, || {
            let message = format!("symbol {}: {}", found.symbol_number(), found.message);
            let finding = if found.dropped {
                ImportFinding::new_warning_finding(line, message)
            } else {
                ImportFinding::new_note_finding(line, message)
            };
            finding.with_remedy(found.remedy)
        });
    }
    (read.sign, Some(text), nonmanual)
}

/// Returns the symbols with their lines.
fn read_symbols(element: &SigmlElement<'_>, findings: &mut FindingTally) -> Vec<(HamnosysSymbol, u64)> {
    AttributeReader::new(element, findings).report_unread_attributes();
    let mut symbols = Vec::new();
    for child in &element.children {
        let symbol = HamnosysSymbol::from_symbol_name(&child.name);
        let exact = symbol.is_some_and(|symbol| symbol.symbol_name() == child.name);
        match symbol {
            _ if !exact && LAYOUT_ELEMENT_NAMES.contains(&&*child.name) => {
                findings.add_limited_finding("layout", || {
                    let message = format!("<{}> is layout; it was left out", child.name);
                    ImportFinding::new_note_finding(child.line.0, message)
                })
            }
            Some(symbol) => {
                if !exact {
                    findings.add_limited_finding("symbols by another name", || {
                        let (name, right) = (shorten_sigml_text(&child.name), symbol.symbol_name());
                        ImportFinding::new_note_finding(child.line.0, format!("<{name}> was read as <{right}>"))
                    });
                }
                symbols.push((symbol, child.line.0));
            }
            None => findings.add_limited_finding("symbols that are not known", || {
                let message = format!(
                    "<{}> is not a symbol of HamNoSys; it was left out",
                    shorten_sigml_text(&child.name)
                );
                let near = nearest_candidate(
                    &child.name,
                    HamnosysSymbol::all_symbols().map(HamnosysSymbol::symbol_name),
                );
                let remedy = near.map_or_else(
                    || "write one of its 209 symbols".to_owned(),
                    |near| format!("write one of its 209 symbols, perhaps <{near}>"),
                );
                ImportFinding::new_warning_finding(child.line.0, message).with_remedy(remedy)
            }),
        }
    }
    symbols
}

fn read_nonmanual(element: &SigmlElement<'_>, findings: &mut FindingTally, said: &mut NonmanualActs) {
    AttributeReader::new(element, findings).report_unread_attributes();
    for child in &element.children {
        let Some((_, part)) = NONMANUAL_ELEMENT_PARTS.iter().find(|(name, _)| *name == child.name) else {
            report_unexpected_symbol(child, element, findings);
            continue;
        };
        let mut node = AttributeReader::new(child, findings);
        let Some(tag) = node.attribute_text(tag_name(*part)) else {
            node.add_element_warning("acts without a tag", |name| {
                format!("<{name}> has no {}; it was left out", tag_name(*part))
            });
            continue;
        };
        if tag.trim().is_empty() {
            node.add_element_note("acts with an empty tag", |name| {
                format!("<{name} {}=\"\"> says nothing; it was left out", tag_name(*part))
            });
            continue;
        }
        let act = NonmanualAct::new(*part, tag);
        if !act.is_listed() {
            node.add_element_note("tags that are not listed", |name| {
                format!(
                    "<{name}>: SiGML 1.2 lists no {:?}; it was kept as it is",
                    shorten_sigml_text(tag)
                )
            });
        }
        node.report_unread_attributes();
        said.push_act_group(part.sigml_tier(), vec![act]);
    }
}

fn tag_name(part: NonmanualPart) -> &'static str {
    if part == NonmanualPart::MouthPicture {
        "picture"
    } else {
        "tag"
    }
}

fn report_unexpected_symbol(child: &SigmlElement<'_>, parent: &SigmlElement<'_>, findings: &mut FindingTally) {
    findings.add_limited_finding("elements that are not known", || {
        let (child_name, parent) = (shorten_sigml_text(&child.name), shorten_sigml_text(&parent.name));
        let message = format!("<{child_name}> has no place in <{parent}>; it was left out");
        ImportFinding::new_warning_finding(child.line.0, message)
    });
}

/// Adds the two halves of a sign to its element, and returns the parts that they cannot express.
pub(super) fn write_sign(sign: &NotatedSign, element: &mut SigmlElement<'static>) -> Vec<String> {
    let mut lost = Vec::new();
    if !sign.nonmanual.is_empty() {
        element.children.push(write_nonmanual(&sign.nonmanual, &mut lost));
    }
    let printed = sign.hamnosys_text();
    lost.extend(printed.losses.into_iter().map(|loss| loss.message));
    let mut manual = SigmlElement::new("hamnosys_manual");
    let (symbols, odd) = spelled_symbols(&printed.text);
    if !odd.is_empty() {
        lost.push("words that name no symbol".to_owned());
    }
    let elements = symbols.into_iter();
    manual
        .children
        .extend(elements.map(|symbol| SigmlElement::new(symbol.symbol_name())));
    element.children.push(manual);
    lost
}

fn write_nonmanual(said: &NonmanualActs, lost: &mut Vec<String>) -> SigmlElement<'static> {
    let mut root_element = SigmlElement::new("hamnosys_nonmanual");
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
    for (kind, act) in said.acts_by_tier() {
        let Some((name, _)) = NONMANUAL_ELEMENT_PARTS.iter().find(|(_, part)| *part == act.part) else {
            lose("what face and body hold on to");
            continue;
        };
        if act.amount.is_some() || act.speed.is_some() {
            lose("how much and how fast face and body act");
        }
        if act.part.sigml_tier() != kind {
            lose("the tier of acts that stand in another's");
        }
        let mut element = SigmlElement::new(*name);
        let picture = act.part == NonmanualPart::MouthPicture;
        let tag = if picture { &act.tag } else { act.act_code() };
        element.set_attribute(tag_name(act.part), tag);
        root_element.children.push(element);
    }
    root_element
}
