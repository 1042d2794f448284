//! Converts tracks to tiers.

use super::anvil_place::{PlacedTrack, place_anvil_tracks};
use super::anvil_raw::{AnvilDocument, AnvilElement, AnvilTrack};
use crate::markup::{UniqueNames, media_from_url, new_timed_annotation, stable_annotation_id};
use crate::tally::FindingTally;
use crate::transcript::{
    AnnotationAddress, AnnotationTiming, AnnotationTranscript, ELEMENT_TIER_TYPE, POINT_TIER_KIND, TranscriptMedia,
    TranscriptTier,
};
use chereme_motion::TimeSpan;
use chereme_sign::TierStereotype;
use std::collections::{BTreeMap, HashMap};

/// Returns the meaning of a document.
pub(super) fn transcript_from_anvil(document: &AnvilDocument<'_>, findings: &mut FindingTally) -> AnnotationTranscript {
    let mut transcript = AnnotationTranscript {
        media: convert_anvil_media(document, findings),
        properties: document
            .infos
            .iter()
            .map(|(key, text)| (key.to_string(), text.to_string()))
            .collect(),
        ..AnnotationTranscript::default()
    };
    if let Some(specification) = document.specification {
        findings.push_note_finding(
            None,
            format!(
                "the specification {specification:?} is another file and is not read; values are those of the elements"
            ),
        );
    }
    for (name, many) in &document.sets {
        findings.add_limited_warning("sets", None, || {
            format!("the set {name:?} has no times; its {many} elements were left out")
        });
    }
    let placed = place_anvil_tracks(document, findings);
    // Anvil has no annotator of a track; projects state theirs as a property of the whole file.
    let coder = ["coder", "annotator"].iter().find_map(|wanted| {
        let is = |(key, text): &&(String, String)| key.eq_ignore_ascii_case(wanted) && !text.is_empty();
        transcript.properties.iter().find(is)
    });
    let mut tiers = AnvilTierBuilder {
        annotator: coder.map(|(_, name)| name.clone()),
        names: UniqueNames::default(),
        ids: UniqueNames::default(),
        links: 0,
        mains: Vec::new(),
        tiers: Vec::new(),
    };
    for (track, placed) in document.tracks.iter().zip(&placed) {
        tiers.add_track_tiers(track, placed, findings);
    }
    tiers.link_track_tiers(&placed, findings);
    transcript.tiers = tiers.tiers;
    transcript
}

fn convert_anvil_media(document: &AnvilDocument<'_>, findings: &mut FindingTally) -> Vec<TranscriptMedia> {
    let mut media = Vec::new();
    for (name, source) in &document.media {
        if ["video", "audio", "media"].contains(name) {
            if !source.trim().is_empty() {
                media.push(media_from_url(source.trim()));
            }
        } else {
            findings.add_limited_note("other files of the head", None, || {
                format!("the head names {source:?}, too (<{name}>); import it by itself")
            });
        }
    }
    media
}

/// Builds tiers of placed tracks.
struct AnvilTierBuilder {
    annotator: Option<String>,
    names: UniqueNames,
    ids: UniqueNames,
    links: u64,
    /// For each track its tiers, one for each lane.
    mains: Vec<Vec<usize>>,
    tiers: Vec<TranscriptTier>,
}

impl AnvilTierBuilder {
    fn add_track_tiers(&mut self, track: &AnvilTrack<'_>, placed: &PlacedTrack, findings: &mut FindingTally) {
        let mut attributes: Vec<&str> = Vec::new();
        let mut attribute_indices: HashMap<&str, usize> = HashMap::new();
        for attribute in track.elements.iter().flat_map(|element| &element.attributes) {
            attribute_indices.entry(attribute.name).or_insert_with(|| {
                attributes.push(attribute.name);
                attributes.len() - 1
            });
        }
        let commented = track.elements.iter().any(|element| element.comment.is_some());
        // Elements with one attribute are annotations of its values; with several, each attribute becomes a tier
        // below them.
        let single = attributes.len() < 2;
        let kind = match (placed.is_point, single, attributes.first()) {
            (true, ..) => POINT_TIER_KIND,
            (_, true, Some(one)) => one,
            (_, true, None) => "",
            _ => ELEMENT_TIER_TYPE,
        };
        let wanted = match track.name.trim() {
            "" => format!("track {}", self.tiers.len() + 1),
            name => name.to_owned(),
        };
        let mut mains = Vec::with_capacity(placed.lanes.len());
        // Elements of a track may overlap, annotations of a tier may not.
        for lane in 0..placed.lanes.len() {
            let main = self.tiers.len();
            mains.push(main);
            let name = self.names.give_unique_name(&wanted);
            if lane == 0 && name != wanted {
                findings.add_limited_note("tiers of one name", track.source.element_line(), || {
                    format!("another tier is called {:?}, too; here it is {name:?}", track.name)
                });
            }
            self.tiers.push(TranscriptTier {
                name: name.clone(),
                kind: kind.to_owned(),
                stereotype: placed.below.map(|(stereotype, _)| stereotype),
                annotator: self.annotator.clone(),
                ..TranscriptTier::default()
            });
            let mut columns = vec![Vec::new(); attributes.len()];
            let mut comments = Vec::new();
            for (element, place) in track.elements.iter().zip(&placed.places) {
                let Some(place) = place.filter(|place| place.lane == lane) else {
                    continue;
                };
                let values = self.element_attribute_values(track, element, &attribute_indices, findings);
                let single_value = values.first().filter(|_| single);
                let value = single_value.map_or("", |(_, value)| value);
                let start = place.span.span_start_instant();
                let id = self.ids.give_unique_id(&stable_annotation_id(&name, start));
                let address = AnnotationAddress {
                    tier: main,
                    index: place.at,
                };
                for (column, value) in values.iter().filter(|(_, it)| !single && !it.is_empty()) {
                    columns[*column].push((address, place.span, value.clone()));
                }
                if let Some(comment) = element.comment {
                    comments.push((address, place.span, comment.to_string()));
                }
                let mut row = new_timed_annotation(id, place.span, value);
                row.timing = place.timing;
                self.tiers[main].annotations.push(row);
            }
            for (attribute, column) in attributes.iter().zip(columns) {
                self.add_attribute_tier(&name, attribute, column);
            }
            if commented {
                self.add_attribute_tier(&name, "comment", comments);
            }
        }
        self.mains.push(mains);
    }

    /// Adds the tier of an attribute, unless it has no values.
    fn add_attribute_tier(&mut self, above: &str, kind: &str, rows: Vec<(AnnotationAddress, TimeSpan, String)>) {
        let Some((first, _, _)) = rows.first() else {
            return;
        };
        let parent = first.tier;
        let name = self.names.give_unique_name(&format!("{above}.{kind}"));
        let mut annotations = Vec::with_capacity(rows.len());
        for (address, span, value) in rows {
            let mut row = new_timed_annotation(
                self.ids
                    .give_unique_id(&stable_annotation_id(&name, span.span_start_instant())),
                span,
                &value,
            );
            (row.timing, row.parent) = (AnnotationTiming::Parent, Some(address));
            annotations.push(row);
        }
        self.tiers.push(TranscriptTier {
            name,
            kind: kind.to_owned(),
            parent: Some(parent),
            stereotype: Some(TierStereotype::SymbolicAssociation),
            annotator: self.annotator.clone(),
            annotations,
            ..TranscriptTier::default()
        });
    }

    /// Returns the values of an element, each with the number of its attribute.
    fn element_attribute_values(
        &mut self,
        track: &AnvilTrack<'_>,
        element: &AnvilElement<'_>,
        known: &HashMap<&str, usize>,
        findings: &mut FindingTally,
    ) -> Vec<(usize, String)> {
        let mut values: BTreeMap<usize, String> = BTreeMap::new();
        for attribute in &element.attributes {
            let mut value = attribute.text.to_string();
            for (track, index) in &attribute.links {
                let between = if value.is_empty() { "" } else { ", " };
                value.push_str(&format!("{between}{track} {index}"));
            }
            self.links += attribute.links.len() as u64;
            let number = known[attribute.name];
            if let Some(before) = values.get_mut(&number) {
                before.push_str("; ");
                before.push_str(&value);
                findings.add_limited_warning("attributes twice", element.source.element_line(), || {
                    format!(
                        "an element of the track {:?} has the attribute {:?} twice; both values are kept",
                        track.name, attribute.name
                    )
                });
            } else {
                values.insert(number, value);
            }
        }
        values.into_iter().collect()
    }

    /// Links the tiers of tracks that refer to others, once all tiers are there.
    fn link_track_tiers(&mut self, placed: &[PlacedTrack], findings: &mut FindingTally) {
        if self.links > 0 {
            findings.push_note_finding(
                None,
                format!(
                    "links to other elements are kept as texts, the track and the index: {}",
                    self.links
                ),
            );
        }
        for (track, own) in placed.iter().enumerate() {
            let Some((_, above)) = own.below else {
                continue;
            };
            for (main, lane) in self.mains[track].iter().zip(&own.lanes) {
                self.tiers[*main].parent = Some(self.mains[above][*lane]);
            }
            for place in own.places.iter().flatten() {
                let parent = place.parent.and_then(|index| placed[above].places[index]);
                let address = parent.map(|slot| AnnotationAddress {
                    tier: self.mains[above][slot.lane],
                    index: slot.at,
                });
                let main = self.mains[track][place.lane];
                self.tiers[main].annotations[place.at].parent = address;
            }
        }
    }
}
