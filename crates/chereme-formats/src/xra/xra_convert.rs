//! Converts a document of SPPAS to tiers.

use std::collections::HashMap;

use chereme_motion::RecordingInstant;
use chereme_sign::TierStereotype;

use super::xra_raw::{XraAnnotation, XraDocument, XraPlace, XraText, XraTier};
use super::{ANNOTATOR_KEY, LANGUAGE_KEY, PARENT_TIER_KEY, PARTICIPANT_KEY, STEREOTYPE_KEY, TIER_TYPE_KEY};
use crate::finding::ImportFinding;
use crate::markup::{
    TimedAnnotation, UniqueNames, arrange_tier_lanes, media_from_url, new_timed_annotation, parse_decimal_seconds,
    report_split_lanes, stable_annotation_id,
};
use crate::tally::FindingTally;
use crate::transcript::{AnnotationAddress, AnnotationTiming, AnnotationTranscript, POINT_TIER_KIND, TranscriptTier};

/// A tier below another one, by their places in the transcript.
struct TierBond {
    upper: usize,
    lower: usize,
    stereotype: TierStereotype,
}

/// Returns the meaning of a document.
pub(super) fn transcript_from_xra(document: &XraDocument<'_>) -> (AnnotationTranscript, Vec<ImportFinding>) {
    let mut findings = FindingTally::default();
    let property = |pair: &(XraText<'_>, XraText<'_>)| (pair.0.to_string(), pair.1.to_string());
    let mut transcript = AnnotationTranscript {
        author: document.author.to_string(),
        media: document.media.iter().map(|url| media_from_url(url)).collect(),
        properties: document.properties.iter().map(property).collect(),
        ..AnnotationTranscript::default()
    };
    // Older versions date a document without its time.
    if document.date.contains('T') {
        transcript.date = document.date.to_string();
    }
    let (mut names, mut ids) = (UniqueNames::default(), UniqueNames::default());
    // The first tier of the transcript for each tier of the file; only a tier without overlaps can lie below another.
    let mut whole_tiers: HashMap<&str, usize> = HashMap::new();
    for tier in &document.tiers {
        let converted = convert_xra_tier(document, tier, &mut names, &mut ids, &mut findings);
        if converted.len() == 1 {
            whole_tiers.entry(&tier.id).or_insert(transcript.tiers.len());
        }
        transcript.tiers.extend(converted);
    }
    for bond in tier_bonds(document, &transcript, &whole_tiers) {
        if !bind_tiers(&mut transcript, &bond) {
            let [lower, upper] = [bond.lower, bond.upper].map(|tier| transcript.tiers[tier].name.clone());
            findings.push_counted_finding(ImportFinding::new_note_finding(
                None,
                format!("{lower:?} does not lie within {upper:?} everywhere; it stands next to it"),
            ));
        }
    }
    report_whole_seconds(document, &mut findings);
    (transcript, findings.finish_finding_tally())
}

/// Returns the tier of a file, or several if annotations overlap.
fn convert_xra_tier(
    document: &XraDocument<'_>,
    tier: &XraTier<'_>,
    names: &mut UniqueNames,
    ids: &mut UniqueNames,
    findings: &mut FindingTally,
) -> Vec<TranscriptTier> {
    let wanted = if tier.name.is_empty() { &tier.id } else { &tier.name };
    let mut placed = Vec::with_capacity(tier.annotations.len());
    for annotation in &tier.annotations {
        let line = || document.xra_line_at(annotation.at);
        match time_of_annotation(annotation, wanted, line, findings) {
            Some(time) => placed.push((annotation, time)),
            None => findings.add_limited_finding("annotations without a time", || {
                let message = format!("an annotation of the tier {wanted:?} has no time in seconds; it was left out");
                ImportFinding::new_warning_finding(line(), message)
            }),
        }
    }
    let is_of_points = !placed.is_empty() && placed.iter().all(|(_, time)| time.is_point);
    let mut times: Vec<TimedAnnotation> = placed.iter().map(|(_, time)| *time).collect();
    let (lanes, crowded) = arrange_tier_lanes(&mut times);
    report_split_lanes(wanted, &lanes, crowded, || document.xra_line_at(tier.at), findings);
    let property = |key: &str| {
        let found = tier.properties.iter().find(|(known, _)| known == key)?;
        Some(found.1.to_string()).filter(|text| !text.is_empty())
    };
    let kind = property(TIER_TYPE_KEY).unwrap_or_default();
    let count = lanes.iter().max().map_or(1, |last| last + 1);
    let lane_tier = |_: usize| TranscriptTier {
        name: names.give_unique_name(wanted),
        kind: if is_of_points {
            POINT_TIER_KIND.to_owned()
        } else {
            kind.clone()
        },
        participant: property(PARTICIPANT_KEY),
        annotator: property(ANNOTATOR_KEY),
        language: property(LANGUAGE_KEY),
        ..TranscriptTier::default()
    };
    let mut tiers: Vec<TranscriptTier> = (0..count).map(lane_tier).collect();
    for (((annotation, _), lane), time) in placed.into_iter().zip(lanes).zip(times) {
        let tier = &mut tiers[lane];
        let wanted_id = match &*annotation.id {
            "" => stable_annotation_id(&tier.name, time.span.span_start_instant()),
            id => id.to_owned(),
        };
        let id = ids.give_unique_id(&wanted_id);
        tier.annotations
            .push(new_timed_annotation(id, time.span, &label_text(&annotation.labels)));
    }
    tiers
}

/// Returns the time of the best alternative of a location.
fn time_of_annotation(
    annotation: &XraAnnotation<'_>,
    tier: &str,
    line: impl Fn() -> u64,
    findings: &mut FindingTally,
) -> Option<TimedAnnotation> {
    let score = |place: &XraPlace<'_>| {
        let stated_score = place.score.as_ref().and_then(|text| text.trim().parse::<f64>().ok());
        stated_score.unwrap_or_default()
    };
    // The first of equal alternatives is the best.
    let best = annotation
        .places
        .iter()
        .rev()
        .max_by(|a, b| score(a).total_cmp(&score(b)))?;
    if annotation.places.len() > 1 || best.pieces > 1 {
        findings.add_limited_finding("alternative times", || {
            let message = format!(
                "an annotation of the tier {tier:?} has several places in time; the best one counts, from its first to its \
                 last moment"
            );
            ImportFinding::new_warning_finding(line(), message)
        });
    }
    let instant = |text: &str| parse_decimal_seconds(text).map(RecordingInstant::from_micros);
    let begin = instant(&best.begin)?;
    match &best.end {
        None => Some(TimedAnnotation::timed_at_point(begin)),
        Some(end) => {
            let end = instant(end)?;
            Some(TimedAnnotation::timed_between_instants(
                begin, end, tier, line, findings,
            ))
        }
    }
}

/// Returns labels as lines, and the alternatives of a label in braces.
fn label_text(labels: &[Vec<XraText<'_>>]) -> String {
    let one_label = |tags: &Vec<XraText<'_>>| match tags.as_slice() {
        [only] => only.to_string(),
        tags => format!("{{{}}}", tags.join("|")),
    };
    let stated_labels = labels.iter().filter(|tags| tags.iter().any(|tag| !tag.is_empty()));
    stated_labels.map(one_label).collect::<Vec<_>>().join("\n")
}

/// Returns which tier lies below which, as links of SPPAS and metadata of this program say.
fn tier_bonds(
    document: &XraDocument<'_>,
    transcript: &AnnotationTranscript,
    whole_tiers: &HashMap<&str, usize>,
) -> Vec<TierBond> {
    let place = |id: &str| whole_tiers.get(id).copied();
    let stated = document.tiers.iter().filter_map(|tier| {
        let property = |key: &str| tier.properties.iter().find(|(known, _)| known == key);
        let name = &*property(PARENT_TIER_KEY)?.1;
        let upper = transcript.tiers.iter().position(|tier| tier.name == *name)?;
        let stereotype = TierStereotype::from_elan_name(&property(STEREOTYPE_KEY)?.1)?;
        Some(TierBond {
            upper,
            lower: place(&tier.id)?,
            stereotype,
        })
    });
    let links = document.links.iter().filter_map(|link| {
        let (from, to) = (place(&link.from)?, place(&link.to)?);
        // The tier with the finer borders leads in SPPAS, and lies below in ELAN.
        Some(match &*link.kind {
            "TimeAlignment" => TierBond {
                upper: to,
                lower: from,
                stereotype: TierStereotype::IncludedIn,
            },
            "TimeAssociation" => TierBond {
                upper: from,
                lower: to,
                stereotype: TierStereotype::SymbolicAssociation,
            },
            _ => return None,
        })
    });
    stated.chain(links).collect()
}

/// Hangs a tier below another; returns whether each of its annotations lies in one above. A tier that hangs somewhere
/// already stays there.
fn bind_tiers(transcript: &mut AnnotationTranscript, bond: &TierBond) -> bool {
    let mut above = Some(bond.upper);
    while let Some(tier) = above {
        if tier == bond.lower {
            return true;
        }
        above = transcript.tiers[tier].parent;
    }
    if transcript.tiers[bond.lower].parent.is_some() {
        return true;
    }
    let mut uppers: Vec<usize> = (0..transcript.tiers[bond.upper].annotations.len()).collect();
    let span_above = |index: usize| transcript.tiers[bond.upper].annotations[index].span;
    uppers.sort_by_key(|index| span_above(*index).span_start_instant());
    let mut children_above: HashMap<usize, u32> = HashMap::new();
    let mut parents = Vec::new();
    for annotation in &transcript.tiers[bond.lower].annotations {
        let span = annotation.span;
        let after =
            uppers.partition_point(|index| span_above(*index).span_start_instant() <= span.span_start_instant());
        let Some(index) = after.checked_sub(1).map(|last| uppers[last]) else {
            return false;
        };
        let order = children_above.entry(index).or_default();
        let is_within = span.span_end_instant() <= span_above(index).span_end_instant();
        let is_one_of_one = span == span_above(index) && *order == 0;
        if !is_within || (bond.stereotype == TierStereotype::SymbolicAssociation && !is_one_of_one) {
            return false;
        }
        parents.push((index, *order));
        *order += 1;
    }
    let lower = &mut transcript.tiers[bond.lower];
    lower.parent = Some(bond.upper);
    lower.stereotype = Some(bond.stereotype);
    for (annotation, (index, order)) in lower.annotations.iter_mut().zip(parents) {
        annotation.parent = Some(AnnotationAddress {
            tier: bond.upper,
            index,
        });
        if !bond.stereotype.is_alignable() {
            annotation.order = order;
            annotation.timing = match bond.stereotype {
                TierStereotype::SymbolicAssociation => AnnotationTiming::Parent,
                _ => AnnotationTiming::Share,
            };
        }
    }
    true
}

/// Reports a file all of whose times are whole numbers: SPPAS counts frames so, whose rate no file states.
fn report_whole_seconds(document: &XraDocument<'_>, findings: &mut FindingTally) {
    let annotations = document.tiers.iter().flat_map(|tier| &tier.annotations);
    let mut places = annotations.flat_map(|annotation| &annotation.places).peekable();
    let is_whole = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    if places.peek().is_some() && places.all(|place| is_whole(&place.begin)) {
        findings.push_counted_finding(
            ImportFinding::new_warning_finding(None, "all of its times are whole numbers; they were read as seconds")
                .with_remedy("if they count frames, save the file with times in seconds from SPPAS"),
        );
    }
}
