//! Converts between a SiGML document and notated signs.

use super::gestural::{read_sign, write_manual, write_nonmanual};
use super::node::Node;
use super::raw::{Element, Line, shown};
use super::symbols;
use crate::finding::{Finding, Mend};
use crate::tally::Findings;
use chereme_sign::hamnosys::Notated;

pub use super::error::Error;

/// A notated sign and the line of the file on which it starts.
#[derive(Debug, Clone, PartialEq)]
pub struct SigmlSign {
    /// The sign.
    pub sign: Notated,
    /// Its line; ignored in comparisons.
    pub line: Line,
}

/// Interprets a document: returns its signs in order.
///
/// Tolerable oddities are read and reported as findings: names and values that SiGML 1.2 does not have,
/// repeated letters, parts at other places.
///
/// # Errors
/// [`Error::Root`] if the root is neither `<sigml>` nor a sign, nor an element that contains one.
pub fn from_raw(root: &Element<'_>) -> Result<(Vec<SigmlSign>, Vec<Finding>), Error> {
    let mut findings = Findings::default();
    let mut entries = Vec::new();
    if root.name.eq_ignore_ascii_case("sigml") {
        if root.name != "sigml" {
            findings.add("roots in another case", || {
                let message = format!("<{}> was read as <sigml>", shown(&root.name));
                Finding::note(root.line.0, message)
            });
        }
        let mut node = Node::new(root, &mut findings);
        node.text("base_uri");
        node.finish();
        read_signs(root, &mut findings, &mut entries);
    } else if read_entry(root, &mut findings, &mut entries) {
        findings.add("signs without a document", || {
            Finding::note(
                root.line.0,
                "the root element is a sign; <sigml> is missing around it",
            )
        });
    } else if holds_signs(root) {
        findings.add("wrappers", || {
            let message = format!(
                "<{}> was read as a wrapper around the signs in it",
                shown(&root.name)
            );
            Finding::note(root.line.0, message)
        });
        read_signs(root, &mut findings, &mut entries);
    } else {
        return Err(Error::Root {
            line: root.line.0,
            found: shown(&root.name),
        });
    }
    if entries.is_empty() {
        findings.add("documents without signs", || {
            Finding::warning(root.line.0, "there is no sign in the document")
        });
    }
    Ok((entries, findings.finish()))
}

/// Returns whether an element contains a document or a sign.
fn holds_signs(element: &Element<'_>) -> bool {
    element.children.iter().any(|child| {
        let name = child.name.to_ascii_lowercase();
        matches!(
            &*name,
            "sigml" | "hamgestural_sign" | "hamgestural_segment" | "hns_sign"
        ) || holds_signs(child)
    })
}

fn read_signs(parent: &Element<'_>, findings: &mut Findings, entries: &mut Vec<SigmlSign>) {
    for child in &parent.children {
        if read_entry(child, findings, entries) {
            continue;
        }
        match &*child.name {
            "sigmlsection" | "sigmlstream" => read_signs(child, findings, entries),
            name if name.eq_ignore_ascii_case("sigml") => {
                let mut node = Node::new(child, findings);
                node.text("base_uri");
                node.finish();
                read_signs(child, findings, entries);
            }
            _ if holds_signs(child) => {
                findings.add("wrappers", || {
                    let message = format!(
                        "<{}> was read as a wrapper around the signs in it",
                        shown(&child.name)
                    );
                    Finding::note(child.line.0, message)
                });
                read_signs(child, findings, entries);
            }
            _ => findings.add("elements that are not signs", || {
                let message = format!(
                    "<{}> is no notated sign; it was left out",
                    shown(&child.name)
                );
                Finding::warning(child.line.0, message)
            }),
        }
    }
}

/// Reads an element if it is a sign; returns whether it is.
fn read_entry(
    element: &Element<'_>,
    findings: &mut Findings,
    entries: &mut Vec<SigmlSign>,
) -> bool {
    let gestural = matches!(&*element.name, "hamgestural_sign" | "hamgestural_segment");
    if !gestural && element.name != "hns_sign" {
        return false;
    }
    let mut node = Node::new(element, findings);
    let gloss = node.text("gloss").map(str::trim).unwrap_or_default();
    if gloss.is_empty() {
        node.warn_of("signs without a gloss", Mend::Gloss, |tag| {
            format!("<{tag}> has no gloss")
        });
    }
    let owned = |text: Option<&str>| text.map(str::to_owned);
    let mut sign = Notated {
        gloss: gloss.to_owned(),
        sign_language: owned(node.text("sign_language")),
        gloss_language: owned(node.text("gloss_language")),
        speed: node.number("speed"),
        timescale: node.number("timescale"),
        duration: node.number("duration"),
        ..Notated::default()
    };
    node.finish();
    if gestural {
        (sign.sign, sign.nonmanual) = read_sign(element, findings);
    } else {
        (sign.sign, sign.text, sign.nonmanual) = symbols::read_sign(element, findings);
    }
    if sign.sign.parts.is_empty() {
        findings.add("signs without hands", || {
            let message = format!("<{}> says nothing of the hands", element.name);
            Finding::warning(element.line.0, message)
        });
    }
    entries.push(SigmlSign {
        sign,
        line: element.line,
    });
    true
}

/// Returns the document that holds these signs as gestural SiGML.
///
/// To lose nothing, it goes beyond SiGML 1.2: it also writes the attributes `speed`, `amount`, `timescale` and
/// `duration` if the tree has them, `digits` of a finger play, `second_size` of a circle, `approx_repetition`, and an
/// empty `location_hand` for an empty half of a split.
pub fn to_gestural<'s>(signs: impl IntoIterator<Item = &'s Notated>) -> Element<'static> {
    let mut root = Element::new("sigml");
    for sign in signs {
        let mut element = header("hamgestural_sign", sign);
        if !sign.nonmanual.is_empty() {
            element.children.push(write_nonmanual(&sign.nonmanual));
        }
        if !sign.sign.parts.is_empty() {
            element.children.push(write_manual(&sign.sign));
        }
        root.children.push(element);
    }
    root
}

/// Returns the document that holds these signs as H-SiGML, and for each the parts that it cannot express.
///
/// HamNoSys lacks symbols for some parts of a tree; a sign that was read as symbols is written with its
/// original text.
pub fn to_symbols<'s>(
    signs: impl IntoIterator<Item = &'s Notated>,
) -> (Element<'static>, Vec<Vec<String>>) {
    let mut root = Element::new("sigml");
    let mut lost = Vec::new();
    for sign in signs {
        let mut element = header("hns_sign", sign);
        lost.push(symbols::write_sign(sign, &mut element));
        root.children.push(element);
    }
    (root, lost)
}

fn header(name: &'static str, sign: &Notated) -> Element<'static> {
    let mut element = Element::new(name);
    element.set("gloss", sign.gloss.clone());
    element.some("sign_language", sign.sign_language.clone());
    element.some("gloss_language", sign.gloss_language.clone());
    for (name, value) in [
        ("speed", sign.speed),
        ("timescale", sign.timescale),
        ("duration", sign.duration),
    ] {
        element.some(name, value.map(|value| value.to_string()));
    }
    element
}
