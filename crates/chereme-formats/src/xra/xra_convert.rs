//! Converts a document of SPPAS to tiers.

use std::collections::HashMap;

use chereme_motion::RecordingInstant;
use chereme_sign::TierStereotype;

use super::{ANNOTATOR_KEY, LANGUAGE_KEY, PARENT_TIER_KEY, PARTICIPANT_KEY, STEREOTYPE_KEY, TIER_TYPE_KEY};
use crate::finding::ImportFinding;
use crate::markup::{
    MarkupContents, MarkupElement, TimedAnnotation, UniqueNames, arrange_tier_lanes, media_from_url,
    new_timed_annotation, parse_decimal_seconds, report_split_lanes, stable_annotation_id,
};
use crate::tally::FindingTally;
use crate::transcript::{AnnotationAddress, AnnotationTiming, AnnotationTranscript, POINT_TIER_KIND, TranscriptTier};

/// A tier below another one, by their places in the transcript.
struct TierBond {
    upper: usize,
    lower: usize,
    stereotype: TierStereotype,
}

/// A place in time, in seconds as they are written.
#[derive(Debug, Clone, Default)]
struct XraPlace<'t> {
    /// The middle of the first point.
    begin: &'t str,
    /// The middle of the last point; `None` for a point in time.
    end: Option<&'t str>,
    /// The alternative with the highest score is the best.
    score: Option<&'t str>,
    /// The number of intervals between both points.
    pieces: usize,
}

/// Returns what is read of an element.
pub(super) fn xra_contents(parent: &str, element: &MarkupElement<'_>) -> Option<MarkupContents> {
    let is_location = ["Location", "Localization", "Disjoint", "TimeDisjoint"].contains(&parent);
    Some(match (parent, element.element_name()) {
        ("Document", "Metadata" | "Tier" | "Hierarchy") => MarkupContents::Elements,
        ("Tier", "Metadata" | "Annotation") | ("Annotation", "Location" | "Label") => MarkupContents::Elements,
        ("Metadata" | "Label", _) => MarkupContents::Text,
        // The provenance of an annotation has no place in a transcript. A film that is embedded is left out, and its tiers
        // are all tiers.
        ("Annotation", "Metadata") | ("Document", "Media") | ("Hierarchy", _) => MarkupContents::Attributes,
        (_, "Localization" | "Disjoint" | "TimeDisjoint") if is_location => MarkupContents::Elements,
        (_, name) if is_location && name.ends_with("Interval") => MarkupContents::Elements,
        (_, name) if is_location && name.ends_with("Point") => MarkupContents::Attributes,
        (interval, _) if interval.ends_with("Interval") => MarkupContents::Attributes,
        _ => return None,
    })
}

/// Returns keys with their texts.
fn xra_properties<'t>(element: &'t MarkupElement<'t>) -> impl Iterator<Item = (&'t str, &'t str)> {
    let entries = element
        .elements_at(&["Metadata"])
        .into_iter()
        .flat_map(|all| &all.children);
    entries.map(|entry| (entry.attribute_text("key"), entry.text.trim()))
}

/// Adds the alternatives of a location. Version 1.2 and older wrap each in a `Localization`, which has the score, and call
/// them `TimePoint` and `TimeInterval`.
fn add_xra_places<'t>(location: &'t MarkupElement<'t>, outer_score: Option<&'t str>, places: &mut Vec<XraPlace<'t>>) {
    for child in &location.children {
        let score = child.stated_attribute("score").or(outer_score);
        match child.element_name() {
            "Localization" => add_xra_places(child, score, places),
            "Disjoint" | "TimeDisjoint" => {
                let mut pieces = Vec::new();
                add_xra_places(child, None, &mut pieces);
                if let (Some(first), Some(last)) = (pieces.first(), pieces.last()) {
                    places.push(XraPlace {
                        begin: first.begin,
                        end: last.end,
                        score,
                        pieces: pieces.len(),
                    });
                }
            }
            name => {
                let midpoint = |bound: &'t MarkupElement<'t>| bound.attribute_text("midpoint");
                let mut bounds: Vec<&str> = child.children.iter().map(midpoint).collect();
                let end = bounds.pop();
                let begin = bounds.pop().unwrap_or_default();
                places.push(XraPlace {
                    begin: if name.ends_with("Point") {
                        midpoint(child)
                    } else {
                        begin
                    },
                    end,
                    score,
                    pieces: 1,
                });
            }
        }
    }
}

/// Returns the alternatives of an annotation's place in time.
fn xra_places<'t>(annotation: &'t MarkupElement<'t>) -> Vec<XraPlace<'t>> {
    let mut places = Vec::new();
    for location in annotation.elements_at(&["Location"]) {
        add_xra_places(location, None, &mut places);
    }
    places
}

/// Returns the meaning of a document.
pub(super) fn transcript_from_xra(root: &MarkupElement<'_>, findings: &mut FindingTally) -> AnnotationTranscript {
    let films = root.elements_at(&["Media"]);
    let mut transcript = AnnotationTranscript {
        author: root.attribute_text("author").to_owned(),
        media: films
            .iter()
            .map(|film| media_from_url(film.attribute_text("url")))
            .collect(),
        properties: xra_properties(root)
            .map(|(key, text)| (key.to_owned(), text.to_owned()))
            .collect(),
        ..AnnotationTranscript::default()
    };
    // Older versions date a document without its time.
    transcript.date = Some(root.attribute_text("date"))
        .filter(|date| date.contains('T'))
        .unwrap_or_default()
        .to_owned();
    let (mut names, mut ids) = (UniqueNames::default(), UniqueNames::default());
    // The first tier of the transcript for each tier of the file; only a tier without overlaps can lie below another.
    let mut whole_tiers: HashMap<&str, usize> = HashMap::new();
    for tier in root.elements_at(&["Tier"]) {
        let converted = convert_xra_tier(tier, &mut names, &mut ids, findings);
        if converted.len() == 1 {
            whole_tiers
                .entry(tier.attribute_text("id"))
                .or_insert(transcript.tiers.len());
        }
        transcript.tiers.extend(converted);
    }
    for bond in tier_bonds(root, &transcript, &whole_tiers) {
        if !bind_tiers(&mut transcript, &bond) {
            let [lower, upper] = [bond.lower, bond.upper].map(|tier| transcript.tiers[tier].name.clone());
            findings.push_counted_finding(ImportFinding::new_note_finding(
                None,
                format!("{lower:?} does not lie within {upper:?} everywhere; it stands next to it"),
            ));
        }
    }
    report_whole_seconds(root, findings);
    transcript
}

/// Returns the tier of a file, or several if annotations overlap.
fn convert_xra_tier(
    tier: &MarkupElement<'_>,
    names: &mut UniqueNames,
    ids: &mut UniqueNames,
    findings: &mut FindingTally,
) -> Vec<TranscriptTier> {
    let names_of_tier = ["tiername", "id"].map(|key| tier.attribute_text(key));
    let wanted = names_of_tier
        .into_iter()
        .find(|name| !name.is_empty())
        .unwrap_or_default();
    let mut placed = Vec::with_capacity(tier.children.len());
    for annotation in tier.elements_at(&["Annotation"]) {
        let line = || annotation.element_line();
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
    report_split_lanes(wanted, &lanes, crowded, || tier.element_line(), findings);
    let property = |key: &str| {
        let (_, text) = xra_properties(tier).find(|(known, _)| *known == key)?;
        Some(text.to_owned()).filter(|text| !text.is_empty())
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
        let wanted_id = match annotation.attribute_text("id") {
            "" => stable_annotation_id(&tier.name, time.span.span_start_instant()),
            id => id.to_owned(),
        };
        let id = ids.give_unique_id(&wanted_id);
        tier.annotations
            .push(new_timed_annotation(id, time.span, &label_text(annotation)));
    }
    tiers
}

/// Returns the time of the best alternative of a location.
fn time_of_annotation(
    annotation: &MarkupElement<'_>,
    tier: &str,
    line: impl Fn() -> u64,
    findings: &mut FindingTally,
) -> Option<TimedAnnotation> {
    let score = |place: &XraPlace<'_>| {
        let stated_score = place.score.and_then(|text| text.trim().parse::<f64>().ok());
        stated_score.unwrap_or_default()
    };
    let places = xra_places(annotation);
    // The first of equal alternatives is the best.
    let best = places.iter().rev().max_by(|a, b| score(a).total_cmp(&score(b)))?;
    if places.len() > 1 || best.pieces > 1 {
        findings.add_limited_finding("alternative times", || {
            let message = format!(
                "an annotation of the tier {tier:?} has several places in time; the best one counts, from its first to its \
                 last moment"
            );
            ImportFinding::new_warning_finding(line(), message)
        });
    }
    let instant = |text: &str| parse_decimal_seconds(text).map(RecordingInstant::from_micros);
    let begin = instant(best.begin)?;
    match best.end {
        None => Some(TimedAnnotation::timed_at_point(begin)),
        Some(end) => {
            let end = instant(end)?;
            Some(TimedAnnotation::timed_between_instants(
                begin, end, tier, line, findings,
            ))
        }
    }
}

/// Returns the labels of an annotation as lines, and the alternatives of a label in braces.
fn label_text(annotation: &MarkupElement<'_>) -> String {
    let labels = annotation.elements_at(&["Label"]).into_iter();
    let tags = labels.map(|label| label.children.iter().map(|tag| tag.text.trim()).collect::<Vec<_>>());
    let one_label = |tags: Vec<&str>| match tags.as_slice() {
        [only] => (*only).to_owned(),
        tags => format!("{{{}}}", tags.join("|")),
    };
    let stated_labels = tags.filter(|tags| tags.iter().any(|tag| !tag.is_empty()));
    stated_labels.map(one_label).collect::<Vec<_>>().join("\n")
}

/// Returns which tier lies below which, as links of SPPAS and metadata of this program say.
fn tier_bonds(
    root: &MarkupElement<'_>,
    transcript: &AnnotationTranscript,
    whole_tiers: &HashMap<&str, usize>,
) -> Vec<TierBond> {
    let place = |id: &str| whole_tiers.get(id).copied();
    let tiers = root.elements_at(&["Tier"]).into_iter();
    let stated = tiers.filter_map(|tier| {
        let property = |key: &str| xra_properties(tier).find(|(known, _)| *known == key);
        let (_, name) = property(PARENT_TIER_KEY)?;
        let upper = transcript.tiers.iter().position(|tier| tier.name == name)?;
        let stereotype = TierStereotype::from_elan_name(property(STEREOTYPE_KEY)?.1)?;
        Some(TierBond {
            upper,
            lower: place(tier.attribute_text("id"))?,
            stereotype,
        })
    });
    let hierarchies = root.elements_at(&["Hierarchy"]).into_iter();
    let links = hierarchies
        .flat_map(|hierarchy| &hierarchy.children)
        .filter_map(|link| {
            let (from, to) = (place(link.attribute_text("from"))?, place(link.attribute_text("to"))?);
            // The tier with the finer borders leads in SPPAS, and lies below in ELAN.
            Some(match link.attribute_text("type") {
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
fn report_whole_seconds(root: &MarkupElement<'_>, findings: &mut FindingTally) {
    let annotations = root.elements_at(&["Tier", "Annotation"]).into_iter();
    let mut places = annotations.flat_map(|annotation| xra_places(annotation)).peekable();
    let is_whole = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    if places.peek().is_some() && places.all(|place| is_whole(place.begin)) {
        findings.push_counted_finding(
            ImportFinding::new_warning_finding(None, "all of its times are whole numbers; they were read as seconds")
                .with_remedy("if they count frames, save the file with times in seconds from SPPAS"),
        );
    }
}
