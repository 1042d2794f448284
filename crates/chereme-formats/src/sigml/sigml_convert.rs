//! Converts between a SiGML document and notated signs.

use super::gestural::{read_sign, write_manual, write_nonmanual};
use super::node::AttributeReader;
use super::sigml_raw::{SigmlElement, SigmlLine, shorten_sigml_text};
use super::sigml_symbols;
use crate::finding::{ImportFinding, ReaderCorrection};
use crate::tally::FindingTally;
use chereme_sign::hamnosys::NotatedSign;

pub use super::error::SigmlError;

/// A notated sign and the line of the file on which it starts.
#[derive(Debug, Clone, PartialEq)]
pub struct SigmlSign {
    /// The sign.
    pub sign: NotatedSign,
    /// Its line; ignored in comparisons.
    pub line: SigmlLine,
}

/// Interprets a document: returns its signs in order.
///
/// Tolerable oddities are read and reported as findings: names and values that SiGML 1.2 does not have,
/// repeated letters, parts at other places.
///
/// # Errors
/// [`SigmlError::Root`] if the root is neither `<sigml>` nor a sign, nor an element that contains one.
pub fn interpret_sigml_document(root: &SigmlElement<'_>) -> Result<(Vec<SigmlSign>, Vec<ImportFinding>), SigmlError> {
    let mut findings = FindingTally::default();
    let mut entries = Vec::new();
    if root.name.eq_ignore_ascii_case("sigml") {
        if root.name != "sigml" {
            findings.add_limited_finding("roots in another case", || {
                let message = format!("<{}> was read as <sigml>", shorten_sigml_text(&root.name));
                ImportFinding::new_note_finding(root.line.0, message)
            });
        }
        let mut node = AttributeReader::new(root, &mut findings);
        node.attribute_text("base_uri");
        node.report_unread_attributes();
        read_signs(root, &mut findings, &mut entries);
    } else if read_entry(root, &mut findings, &mut entries) {
        findings.add_limited_note(
            "signs without a document",
            root.line.0,
            || "the root element is a sign; <sigml> is missing around it",
        );
    } else if holds_signs(root) {
        findings.add_limited_finding("wrappers", || {
            let message = format!(
                "<{}> was read as a wrapper around the signs in it",
                shorten_sigml_text(&root.name)
            );
            ImportFinding::new_note_finding(root.line.0, message)
        });
        read_signs(root, &mut findings, &mut entries);
    } else {
        return Err(SigmlError::Root {
            line: root.line.0,
            found: shorten_sigml_text(&root.name),
        });
    }
    if entries.is_empty() {
        findings.add_limited_warning(
            "documents without signs",
            root.line.0,
            || "there is no sign in the document",
        );
    }
    Ok((entries, findings.finish_finding_tally()))
}

/// Returns whether an element contains a document or a sign.
fn holds_signs(element: &SigmlElement<'_>) -> bool {
    element.children.iter().any(|child| {
        let name = child.name.to_ascii_lowercase();
        matches!(
            &*name,
            "sigml" | "hamgestural_sign" | "hamgestural_segment" | "hns_sign"
        ) || holds_signs(child)
    })
}

fn read_signs(parent: &SigmlElement<'_>, findings: &mut FindingTally, entries: &mut Vec<SigmlSign>) {
    for child in &parent.children {
        if read_entry(child, findings, entries) {
            continue;
        }
        match &*child.name {
            "sigmlsection" | "sigmlstream" => read_signs(child, findings, entries),
            // Files put together by hand hold whole files.
            name if name.eq_ignore_ascii_case("sigml") => {
                let mut node = AttributeReader::new(child, findings);
                node.attribute_text("base_uri");
                node.report_unread_attributes();
                read_signs(child, findings, entries);
            }
            _ if holds_signs(child) => {
                findings.add_limited_finding("wrappers", || {
                    let message = format!(
                        "<{}> was read as a wrapper around the signs in it",
                        shorten_sigml_text(&child.name)
                    );
                    ImportFinding::new_note_finding(child.line.0, message)
                });
                read_signs(child, findings, entries);
            }
            _ => findings.add_limited_finding("elements that are not signs", || {
                let message = format!(
                    "<{}> is no notated sign; it was left out",
                    shorten_sigml_text(&child.name)
                );
                ImportFinding::new_warning_finding(child.line.0, message)
            }),
        }
    }
}

/// Reads an element if it is a sign; returns whether it is.
fn read_entry(element: &SigmlElement<'_>, findings: &mut FindingTally, entries: &mut Vec<SigmlSign>) -> bool {
    let gestural = matches!(&*element.name, "hamgestural_sign" | "hamgestural_segment");
    if !gestural && element.name != "hns_sign" {
        return false;
    }
    let mut node = AttributeReader::new(element, findings);
    let gloss = node.attribute_text("gloss").map(str::trim).unwrap_or_default();
    if gloss.is_empty() {
        node.warn_of("signs without a gloss", ReaderCorrection::Gloss, |tag| {
            format!("<{tag}> has no gloss")
        });
    }
    let owned = |text: Option<&str>| text.map(str::to_owned);
    let mut sign = NotatedSign {
        gloss: gloss.to_owned(),
        sign_language: owned(node.attribute_text("sign_language")),
        gloss_language: owned(node.attribute_text("gloss_language")),
        speed: node.read_positive_number("speed"),
        timescale: node.read_positive_number("timescale"),
        duration: node.read_positive_number("duration"),
        ..NotatedSign::default()
    };
    node.report_unread_attributes();
    if gestural {
        (sign.sign, sign.nonmanual) = read_sign(element, findings);
    } else {
        (sign.sign, sign.text, sign.nonmanual) = sigml_symbols::read_sign(element, findings);
    }
    if sign.sign.parts.is_empty() {
        findings.add_limited_finding("signs without hands", || {
            let message = format!("<{}> says nothing of the hands", element.name);
            ImportFinding::new_warning_finding(element.line.0, message)
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
pub fn to_gestural<'s>(signs: impl IntoIterator<Item = &'s NotatedSign>) -> SigmlElement<'static> {
    let mut root = SigmlElement::new("sigml");
    for sign in signs {
        let mut element = sigml_sign_element("hamgestural_sign", sign);
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
pub fn to_symbols<'s>(signs: impl IntoIterator<Item = &'s NotatedSign>) -> (SigmlElement<'static>, Vec<Vec<String>>) {
    let mut root = SigmlElement::new("sigml");
    let mut lost = Vec::new();
    for sign in signs {
        let mut element = sigml_sign_element("hns_sign", sign);
        lost.push(sigml_symbols::write_sign(sign, &mut element));
        root.children.push(element);
    }
    (root, lost)
}

fn sigml_sign_element(name: &'static str, sign: &NotatedSign) -> SigmlElement<'static> {
    let mut element = SigmlElement::new(name);
    element.set_attribute("gloss", sign.gloss.clone());
    element.set_optional_attribute("sign_language", sign.sign_language.clone());
    element.set_optional_attribute("gloss_language", sign.gloss_language.clone());
    for (name, value) in [
        ("speed", sign.speed),
        ("timescale", sign.timescale),
        ("duration", sign.duration),
    ] {
        element.set_optional_attribute(name, value.map(|value| value.to_string()));
    }
    element
}
