//! Writes tiers as a document of SPPAS, format 1.5.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use chereme_motion::RecordingInstant;
use chereme_sign::TierStereotype;
use chereme_sign::cue::{of_gloss, sppas_key_labels};
use quick_xml::escape::escape;

use super::{ANNOTATOR_KEY, LANGUAGE_KEY, PARENT_TIER_KEY, PARTICIPANT_KEY, STEREOTYPE_KEY, TIER_TYPE_KEY};
use crate::transcript::{AnnotationTranscript, POINT_TIER_KIND, TranscriptAnnotation, TranscriptTier};

/// Writes tiers as SPPAS reads them, with their hierarchy as links where its rules allow that, and as metadata always.
/// Keys of cued speech are written in its notation.
#[must_use]
pub fn write_xra(transcript: &AnnotationTranscript, name: &str) -> String {
    let mut out = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Document author=\"{}\" date=\"{}\" format=\"1.5\" name=\"{}\">\n",
        escape(&*transcript.author),
        escape(&*transcript.date),
        escape(name)
    );
    write_metadata(
        &mut out,
        1,
        transcript
            .properties
            .iter()
            .map(|(key, text)| (key.as_str(), text.as_str())),
    );
    for (number, tier) in transcript.tiers.iter().enumerate() {
        write_xra_tier(&mut out, transcript, number, tier);
    }
    for (number, media) in transcript.media.iter().enumerate() {
        let mime = match &*media.mime_type {
            "" => String::new(),
            mime => format!(" mimetype=\"{}\"", escape(mime)),
        };
        let _ = writeln!(
            out,
            "\t<Media id=\"m{number}\" url=\"{}\"{mime} />",
            escape(&*media.url)
        );
    }
    let tiers = transcript.tiers.iter().enumerate();
    let links: Vec<String> = tiers
        .filter_map(|(number, tier)| hierarchy_link(transcript, number, tier))
        .collect();
    if !links.is_empty() {
        let _ = writeln!(out, "\t<Hierarchy>\n{}\t</Hierarchy>", links.concat());
    }
    out.push_str("</Document>\n");
    out
}

fn write_metadata<'m>(out: &mut String, depth: usize, entries: impl Iterator<Item = (&'m str, &'m str)>) {
    let mut entries = entries.filter(|(_, text)| !text.is_empty()).peekable();
    if entries.peek().is_none() {
        return;
    }
    let indent = "\t".repeat(depth);
    let _ = writeln!(out, "{indent}<Metadata>");
    for (key, text) in entries {
        let _ = writeln!(out, "{indent}\t<Entry key=\"{}\">{}</Entry>", escape(key), escape(text));
    }
    let _ = writeln!(out, "{indent}</Metadata>");
}

fn write_xra_tier(out: &mut String, transcript: &AnnotationTranscript, number: usize, tier: &TranscriptTier) {
    let is_of_points = tier.kind == POINT_TIER_KIND;
    let _ = writeln!(out, "\t<Tier id=\"t{number}\" tiername=\"{}\">", escape(&*tier.name));
    let parent = tier.parent.and_then(|parent| transcript.tiers.get(parent));
    let optional = |text: &'_ Option<String>| text.clone().unwrap_or_default();
    let entries = [
        (PARTICIPANT_KEY, optional(&tier.participant)),
        (ANNOTATOR_KEY, optional(&tier.annotator)),
        (LANGUAGE_KEY, optional(&tier.language)),
        (
            TIER_TYPE_KEY,
            if is_of_points { String::new() } else { tier.kind.clone() },
        ),
        (
            PARENT_TIER_KEY,
            parent.map_or_else(String::new, |parent| parent.name.clone()),
        ),
        (
            STEREOTYPE_KEY,
            tier.stereotype.map_or("", TierStereotype::elan_name).to_owned(),
        ),
    ];
    write_metadata(out, 2, entries.iter().map(|(key, text)| (*key, text.as_str())));
    for annotation in &tier.annotations {
        write_xra_annotation(out, annotation, is_of_points);
    }
    out.push_str("\t</Tier>\n");
}

fn write_xra_annotation(out: &mut String, annotation: &TranscriptAnnotation, is_point: bool) {
    let [begin, end] = [annotation.span.span_start_instant(), annotation.span.span_end_instant()].map(decimal_seconds);
    let _ = writeln!(
        out,
        "\t\t<Annotation id=\"{}\">\n\t\t\t<Location>",
        escape(&*annotation.id)
    );
    let _ = match is_point {
        true => writeln!(out, "\t\t\t\t<Point midpoint=\"{begin}\" />"),
        false => writeln!(
            out,
            "\t\t\t\t<Interval>\n\t\t\t\t\t<Begin midpoint=\"{begin}\" />\n\t\t\t\t\t<End midpoint=\"{end}\" />\n\t\t\t\t</Interval>"
        ),
    };
    out.push_str("\t\t\t</Location>\n");
    let key = of_gloss(&annotation.value).and_then(|(placement, shape)| sppas_key_labels(placement, shape));
    let labels: Vec<&str> = match &key {
        Some(labels) => labels.iter().map(String::as_str).collect(),
        None => annotation.value.split('\n').filter(|label| !label.is_empty()).collect(),
    };
    for label in labels {
        let alternatives = label.strip_prefix('{').and_then(|inner| inner.strip_suffix('}'));
        let tags: Vec<&str> = match alternatives {
            Some(inner) if inner.contains('|') => inner.split('|').collect(),
            _ => vec![label],
        };
        out.push_str("\t\t\t<Label>\n");
        for tag in tags {
            let _ = writeln!(out, "\t\t\t\t<Tag>{}</Tag>", escape(tag));
        }
        out.push_str("\t\t\t</Label>\n");
    }
    out.push_str("\t\t</Annotation>\n");
}

/// Returns the link of a tier and the one above, if SPPAS accepts it: it refuses a file whose borders contradict a link.
fn hierarchy_link(transcript: &AnnotationTranscript, number: usize, tier: &TranscriptTier) -> Option<String> {
    let above = tier.parent?;
    let parent = transcript.tiers.get(above)?;
    let spans = |tier: &TranscriptTier| tier.annotations.iter().map(|one| one.span).collect::<BTreeSet<_>>();
    let borders = |tier: &TranscriptTier| {
        let each = tier.annotations.iter().map(|one| one.span);
        each.flat_map(|span| [span.span_start_instant(), span.span_end_instant()])
            .collect::<BTreeSet<_>>()
    };
    let (kind, from, to) = if spans(tier) == spans(parent) {
        ("TimeAssociation", above, number)
    } else if borders(parent).is_subset(&borders(tier)) {
        ("TimeAlignment", number, above)
    } else {
        return None;
    };
    Some(format!("\t\t<Link type=\"{kind}\" from=\"t{from}\" to=\"t{to}\" />\n"))
}

/// Returns a time in seconds with a decimal point, without which SPPAS counts frames.
fn decimal_seconds(at: RecordingInstant) -> String {
    let micros = at.instant_micros();
    let sign = if micros < 0 { "-" } else { "" };
    let (whole, part) = (micros.unsigned_abs() / 1_000_000, micros.unsigned_abs() % 1_000_000);
    let text = format!("{sign}{whole}.{part:06}");
    let shown = text.trim_end_matches('0');
    if shown.ends_with('.') {
        format!("{shown}0")
    } else {
        shown.to_owned()
    }
}
