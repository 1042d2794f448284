//! Converts a raw document to its meaning.

pub use super::back::eaf_document_from_transcript;
pub use crate::transcript::{
    AnnotationAddress, AnnotationTiming, AnnotationTranscript, ControlledVocabulary, TranscriptAnnotation,
    TranscriptMedia, TranscriptTier, VocabularyEntry, VocabularyEntryValue,
};

use super::eaf_check::{AnnotationHandle, AnnotationLink, ResolvedReferences, resolve_eaf_references};
use super::eaf_raw::{self, EafDocument, EafText};
use crate::finding::ImportFinding;
use crate::tally::FindingTally;
use chereme_motion::{RecordingInstant, TimeSpan};
use chereme_sign::TierStereotype;
use chereme_sign::tier::subdivision_share;
use std::collections::{BTreeMap, HashMap, HashSet};

/// The number of overlaps of one tier that a finding names.
const SHOWN_OVERLAPS: usize = 3;

/// Returns the meaning of `document`.
///
/// Time slots without a value lie evenly between their neighbours: t0 + k(t1 − t0)/(n + 1). Children of a
/// Symbolic_Association have the span of their parent; children of a Symbolic_Subdivision share it evenly
/// in the order of their chain. Times in PAL or NTSC frames become milliseconds. An annotation whose slots
/// or parent are missing is left out with all below it; two tiers or annotations of one name get names of
/// their own. A finding reports each of these cases.
#[must_use]
pub fn transcript_from_eaf(document: &EafDocument<'_>) -> (AnnotationTranscript, Vec<ImportFinding>) {
    let (transcript, _, findings) = from_raw_placed(document);
    (transcript, findings)
}

/// Does what [`transcript_from_eaf`] does, and returns the place of each annotation, counted over all tiers; an
/// annotation that was left out has none.
pub(super) fn from_raw_placed(
    document: &EafDocument<'_>,
) -> (AnnotationTranscript, Vec<Option<AnnotationAddress>>, Vec<ImportFinding>) {
    let (resolved, mut reported) = resolve_eaf_references(document);
    let mut findings = FindingTally::default();
    let times = SlotTimes::new(document, &resolved, &mut findings);
    let (tiers, places) = EafTierConverter::new(document, &resolved, &times).convert(&mut findings);
    reported.extend(findings.finish_finding_tally());
    let transcript = AnnotationTranscript {
        author: document.author.to_string(),
        date: document.date.to_string(),
        media: document.header.media.iter().map(convert_eaf_media).collect(),
        linked_files: document.header.linked_files.iter().map(linked_file).collect(),
        properties: document
            .header
            .properties
            .iter()
            .map(|property| {
                (
                    property.name.as_deref().unwrap_or_default().to_owned(),
                    property.value.to_string(),
                )
            })
            .collect(),
        tiers,
        vocabularies: document_vocabularies(document),
    };
    (transcript, places, reported)
}

/// Returns the controlled vocabularies of a document, for example of an `.ecv` file.
#[must_use]
pub fn document_vocabularies(document: &EafDocument<'_>) -> Vec<ControlledVocabulary> {
    let references: HashMap<&str, &str> = document
        .external_refs
        .iter()
        .map(|reference| (&*reference.id, &*reference.value))
        .collect();
    let vocabulary = |cv: &eaf_raw::EafVocabulary<'_>| ControlledVocabulary {
        id: cv.id.to_string(),
        descriptions: cv
            .descriptions
            .iter()
            .map(|description| {
                (
                    text_or_empty(description.language.as_ref()),
                    description.text.to_string(),
                )
            })
            .collect(),
        entries: cv.entries.iter().map(convert_vocabulary_entry).collect(),
        external: cv
            .external_ref
            .as_deref()
            .and_then(|id| references.get(id))
            .map(|url| (*url).to_owned()),
    };
    document.vocabularies.iter().map(vocabulary).collect()
}

fn convert_vocabulary_entry(entry: &eaf_raw::EafVocabularyEntry<'_>) -> VocabularyEntry {
    VocabularyEntry {
        id: text_or_empty(entry.id.as_ref()),
        values: entry
            .values
            .iter()
            .map(|entry_value| VocabularyEntryValue {
                language: text_or_empty(entry_value.language.as_ref()),
                value: entry_value.value.to_string(),
                description: owned_text_string(entry_value.description.as_ref()),
            })
            .collect(),
        external_ref: owned_text_string(entry.external_ref.as_ref()),
    }
}

fn convert_eaf_media(media: &eaf_raw::MediaDescriptor<'_>) -> TranscriptMedia {
    TranscriptMedia {
        url: media.url.to_string(),
        relative_url: owned_text_string(media.relative_url.as_ref()),
        mime_type: media.mime_type.to_string(),
        time_origin: media.time_origin,
        source: owned_text_string(media.extracted_from.as_ref()),
    }
}

fn linked_file(file: &eaf_raw::LinkedFile<'_>) -> TranscriptMedia {
    TranscriptMedia {
        url: file.url.to_string(),
        relative_url: owned_text_string(file.relative_url.as_ref()),
        mime_type: file.mime_type.to_string(),
        time_origin: file.time_origin,
        source: owned_text_string(file.associated_with.as_ref()),
    }
}

fn owned_text_string(text: Option<&EafText<'_>>) -> Option<String> {
    text.map(|text| text.to_string())
}

fn text_or_empty(text: Option<&EafText<'_>>) -> String {
    owned_text_string(text).unwrap_or_default()
}

/// The time of each time slot, in the order of the file.
struct SlotTimes {
    millis: Vec<Option<i64>>,
    times: Vec<RecordingInstant>,
}

impl SlotTimes {
    fn new(document: &EafDocument<'_>, resolved: &ResolvedReferences, findings: &mut FindingTally) -> Self {
        let units = document.header.time_units.as_deref().unwrap_or("milliseconds");
        let (per, of) = match units {
            "milliseconds" => (1, 1),
            "PAL-frames" => (40, 1),
            "NTSC-frames" => (1001, 30),
            _ => {
                findings.add_limited_finding("unknown time units", || {
                    ImportFinding::new_warning_finding(
                        None,
                        format!("the time units {units:?} are not known; they were read as milliseconds"),
                    )
                    .with_remedy("set TIME_UNITS to milliseconds, PAL-frames or NTSC-frames")
                });
                (1, 1)
            }
        };
        if of * per != 1 {
            findings.add_limited_note("times in frames", None, || {
                format!("the times are in {units}; they become milliseconds")
            });
        }
        let time = |value: i64| {
            let micros = i128::from(value) * 1000 * i128::from(per) / i128::from(of);
            RecordingInstant::from_micros(micros.clamp(i64::MIN.into(), i64::MAX.into()) as i64)
        };
        let slot_times: Vec<Option<RecordingInstant>> =
            document.time_order.iter().map(|slot| slot.value.map(time)).collect();
        let millis = slot_times
            .iter()
            .map(|time| time.map(RecordingInstant::instant_millis))
            .collect();
        let mut slots = Self {
            millis,
            times: slot_times.iter().map(|time| time.unwrap_or_default()).collect(),
        };
        if slot_times.iter().any(Option::is_none) {
            slots.propose_slot_times(&slot_times, resolved);
        }
        slots
    }

    /// Places the unaligned slots: those in a chain of annotations on one tier within that chain, the
    /// others within the time order.
    fn propose_slot_times(&mut self, known: &[Option<RecordingInstant>], resolved: &ResolvedReferences) {
        let mut slot_times = known.to_vec();
        for tier in resolved.first.windows(2) {
            let links = &resolved.links[tier[0] as usize..tier[1] as usize];
            let mut chain: Vec<usize> = Vec::new();
            for link in links {
                let AnnotationLink::Slots(Some(start), Some(end)) = *link else {
                    continue;
                };
                if chain.last() != Some(&(start as usize)) {
                    spread_slot_times(&chain, &mut slot_times);
                    chain.clear();
                    chain.push(start as usize);
                }
                chain.push(end as usize);
            }
            spread_slot_times(&chain, &mut slot_times);
        }
        let all: Vec<usize> = (0..slot_times.len()).collect();
        spread_slot_times(&all, &mut slot_times);
        let edge = slot_times.iter().flatten().next().copied().unwrap_or_default();
        let mut last = edge;
        for (time, known) in self.times.iter_mut().zip(slot_times) {
            last = known.unwrap_or(last);
            *time = last;
        }
    }
}

/// Spreads the unknown times of a chain of slots evenly, in whole milliseconds, between the known.
fn spread_slot_times(chain: &[usize], known: &mut [Option<RecordingInstant>]) {
    let mut from: Option<(usize, RecordingInstant)> = None;
    for (at, slot) in chain.iter().enumerate() {
        let Some(time) = known[*slot] else { continue };
        if let Some((start, t0)) = from {
            let (n, t0, t1) = (
                (at - start - 1) as i128,
                i128::from(t0.instant_millis()),
                i128::from(time.instant_millis()),
            );
            for (k, slot) in (1..).zip(&chain[start + 1..at]) {
                let t = t0 + k * (t1 - t0) / (n + 1);
                known[*slot] = Some(RecordingInstant::from_millis(t as i64));
            }
        }
        from = Some((at, time));
    }
}

/// The tiers during conversion.
struct EafTierConverter<'d> {
    document: &'d EafDocument<'d>,
    resolved: &'d ResolvedReferences,
    times: &'d SlotTimes,
    /// The place of each raw annotation in the result; `None` for one that was left out.
    places: Vec<Option<AnnotationAddress>>,
    tiers: Vec<TranscriptTier>,
}

impl<'d> EafTierConverter<'d> {
    fn new(document: &'d EafDocument<'d>, resolved: &'d ResolvedReferences, times: &'d SlotTimes) -> Self {
        let places = vec![None; resolved.links.len()];
        let mut tiers = Self {
            document,
            resolved,
            times,
            places,
            tiers: Vec::new(),
        };
        let mut names: HashSet<String> = document.tiers.iter().map(|tier| tier.id.to_string()).collect();
        let mut used: HashMap<String, u64> = HashMap::new();
        for (at, tier) in document.tiers.iter().enumerate() {
            let mut name = tier.id.to_string();
            let count = used.entry(name.clone()).and_modify(|n| *n += 1).or_insert(1);
            while name.is_empty() || (*count > 1 && names.contains(&name)) {
                let base = if tier.id.is_empty() { "tier" } else { &*tier.id };
                name = format!("{base} {count}");
                *count += u64::from(names.contains(&name));
            }
            names.insert(name.clone());
            tiers.tiers.push(tiers.empty_converted_tier(at, tier, name));
        }
        tiers
    }

    fn empty_converted_tier(&self, at: usize, tier: &eaf_raw::EafTier<'_>, name: String) -> TranscriptTier {
        let kind = self.resolved.types[at].map(|kind| &self.document.linguistic_types[kind]);
        TranscriptTier {
            name,
            parent: self.resolved.parents[at],
            stereotype: self.resolved.stereotypes[at],
            kind: tier.linguistic_type.to_string(),
            participant: owned_text_string(tier.participant.as_ref()),
            annotator: owned_text_string(tier.annotator.as_ref()),
            language: owned_text_string(tier.language.as_ref()),
            locale: owned_text_string(tier.locale.as_ref()),
            vocabulary: kind.and_then(|kind| owned_text_string(kind.vocabulary.as_ref())),
            annotations: Vec::with_capacity(tier.annotations.len()),
        }
    }

    fn convert(mut self, findings: &mut FindingTally) -> (Vec<TranscriptTier>, Vec<Option<AnnotationAddress>>) {
        for at in self.resolved.order.clone() {
            self.convert_eaf_tier(at, findings);
        }
        self.fresh_ids();
        (self.tiers, self.places)
    }

    fn convert_eaf_tier(&mut self, at: usize, findings: &mut FindingTally) {
        let document = self.document;
        let first = self.resolved.first[at];
        for (handle, annotation) in (first..).zip(&document.tiers[at].annotations) {
            let timed_span = match self.resolved.links[handle as usize] {
                AnnotationLink::Slots(Some(start), Some(end)) => {
                    self.timed_slot_span(start as usize, end as usize, annotation, findings)
                }
                AnnotationLink::Parent(Some(parent), _) => {
                    self.places[parent as usize].map(|place| TimedSpan {
                        span: self.tiers[place.tier].annotations[place.index].span,
                        timing: AnnotationTiming::Parent,
                        // A tier that became a root tier keeps its times only.
                        parent: self.tiers[at].parent.map(|_| place),
                        millis: None,
                    })
                }
                _ => None,
            };
            let Some(held) = timed_span else {
                findings.add_limited_finding("annotations that were left out", || {
                    let id = &annotation.id;
                    ImportFinding::new_warning_finding(
                        self.document.line_of_element(annotation.at),
                        format!("annotation {id:?} has no place in time and was left out"),
                    )
                });
                continue;
            };
            self.places[handle as usize] = Some(AnnotationAddress {
                tier: at,
                index: self.tiers[at].annotations.len(),
            });
            self.tiers[at].annotations.push(TranscriptAnnotation {
                id: annotation.id.to_string(),
                span: held.span,
                timing: held.timing,
                parent: held.parent,
                order: 0,
                value: annotation.value.to_string(),
                entry: owned_text_string(annotation.entry.as_ref()),
                language: owned_text_string(annotation.language.as_ref()),
                external_ref: owned_text_string(annotation.external_ref.as_ref()),
                millis: held.millis,
            });
        }
        match self.tiers[at].stereotype {
            Some(TierStereotype::SymbolicSubdivision) => self.order_siblings(at, findings),
            Some(TierStereotype::SymbolicAssociation) => self.only_children(at, findings),
            Some(_) => self.find_parents(at, findings),
            None => {}
        }
        if self.tiers[at].stereotype.is_none_or(TierStereotype::is_alignable) {
            self.report_tier_overlaps(at, findings);
        }
        if self.tiers[at].stereotype == Some(TierStereotype::TimeSubdivision) {
            self.report_subdivision_gaps(at, findings);
        }
    }

    /// Reports annotations that their subdivision covers only in part.
    fn report_subdivision_gaps(&self, at: usize, findings: &mut FindingTally) {
        let mut divided: BTreeMap<(usize, usize), Vec<TimeSpan>> = BTreeMap::new();
        for annotation in &self.tiers[at].annotations {
            if let Some(above) = annotation.parent {
                let spans = divided.entry((above.tier, above.index)).or_default();
                spans.push(annotation.span);
            }
        }
        for ((tier, index), mut spans) in divided {
            let parent_annotation = &self.tiers[tier].annotations[index];
            spans.sort();
            let mut covered = parent_annotation.span.span_start_instant();
            let mut gap = false;
            for span in spans {
                gap |= span.span_start_instant() > covered;
                covered = covered.max(span.span_end_instant());
            }
            if gap || covered < parent_annotation.span.span_end_instant() {
                findings.add_limited_finding("subdivisions with gaps", || {
                    let message = format!(
                        "the Time_Subdivision {:?} leaves part of annotation {:?} uncovered",
                        self.tiers[at].name, parent_annotation.id
                    );
                    ImportFinding::new_warning_finding(None, message)
                        .with_remedy("ELAN allows no gaps there; move a boundary, or make the tier Included_In")
                });
            }
        }
    }

    fn timed_slot_span(
        &self,
        start: usize,
        end: usize,
        annotation: &eaf_raw::EafAnnotation<'_>,
        findings: &mut FindingTally,
    ) -> Option<TimedSpan> {
        let (from, to) = (self.times.times[start], self.times.times[end]);
        if to <= from {
            findings.add_limited_finding("annotations that end before they start", || {
                let what = if to == from {
                    "has no length"
                } else {
                    "ends before it starts; the ends were exchanged"
                };
                ImportFinding::new_warning_finding(
                    self.document.line_of_element(annotation.at),
                    format!("annotation {:?} {what}", annotation.id),
                )
            });
        }
        let millis = self.times.millis[start].zip(self.times.millis[end]);
        let (start, end) = (self.times.millis[start].is_none(), self.times.millis[end].is_none());
        // The flags of unset times follow their ends.
        let swapped = to < from;
        Some(TimedSpan {
            span: TimeSpan::span_between(from, to),
            timing: if start || end {
                AnnotationTiming::Proposed {
                    start: if swapped { end } else { start },
                    end: if swapped { start } else { end },
                }
            } else {
                AnnotationTiming::Own
            },
            parent: None,
            millis: millis.map(|(from, to)| [from.min(to), from.max(to)]),
        })
    }

    /// Finds for each annotation of an alignable child tier the annotation above that overlaps it most.
    fn find_parents(&mut self, at: usize, findings: &mut FindingTally) {
        let Some(above) = self.tiers[at].parent else {
            return;
        };
        let mut spans: Vec<(TimeSpan, usize)> = self.tiers[above]
            .annotations
            .iter()
            .enumerate()
            .map(|(index, it)| (it.span, index))
            .collect();
        spans.sort();
        let mut tier = std::mem::take(&mut self.tiers[at].annotations);
        for annotation in &mut tier {
            let span = annotation.span;
            let next = spans.partition_point(|(other, _)| other.span_start_instant() <= span.span_start_instant());
            // Spans of a tier do not overlap, so that only the neighbours of the start can share time with it.
            let near = &spans[next.saturating_sub(2)..(next + 1).min(spans.len())];
            let shared = |other: TimeSpan| {
                let (start, end) = (
                    other.span_start_instant().max(span.span_start_instant()),
                    other.span_end_instant().min(span.span_end_instant()),
                );
                end.instant_micros().saturating_sub(start.instant_micros())
            };
            let best = near
                .iter()
                .max_by_key(|(other, index)| (shared(*other), std::cmp::Reverse(*index)));
            annotation.parent = best
                .filter(|(other, _)| other.is_overlapping_span(span) || other.has_span_inside(span))
                .map(|(_, index)| AnnotationAddress {
                    tier: above,
                    index: *index,
                });
            let inside = best.is_some_and(|(other, _)| other.has_span_inside(span));
            if !inside {
                findings.add_limited_warning("annotations that lie outside those above them", None, || {
                    format!(
                        "annotation {:?} does not lie within an annotation of the tier above",
                        annotation.id
                    )
                });
            }
        }
        self.tiers[at].annotations = tier;
    }

    /// Gives the children of a Symbolic_Subdivision their places and their shares of time.
    fn order_siblings(&mut self, at: usize, findings: &mut FindingTally) {
        let first = self.resolved.first[at];
        let handles = first..self.resolved.first[at + 1];
        let mut families: Vec<(AnnotationAddress, Vec<AnnotationHandle>)> = Vec::new();
        let mut family_indices: HashMap<AnnotationAddress, usize> = HashMap::new();
        for handle in handles {
            let Some(place) = self.places[handle as usize] else {
                continue;
            };
            let Some(parent) = self.tiers[at].annotations[place.index].parent else {
                continue;
            };
            let family = *family_indices.entry(parent).or_insert(families.len());
            if family == families.len() {
                families.push((parent, Vec::new()));
            }
            families[family].1.push(handle);
        }
        for (parent, children) in families {
            let (sorted, whole) = self.order_sibling_chain(&children);
            if !whole {
                findings.add_limited_finding("broken chains of annotations", || {
                    let above = self.tiers[parent.tier].annotations.get(parent.index).map_or("", |annotation| &annotation.id);
                    ImportFinding::new_warning_finding(None, format!("the annotations below {above:?} are not one chain; loose annotations follow in the order of the file"))
                });
            }
            let (span, count) = (self.tiers[parent.tier].annotations[parent.index].span, sorted.len());
            for (k, handle) in sorted.into_iter().enumerate() {
                let Some(place) = self.places[handle as usize] else {
                    continue;
                };
                let annotation = &mut self.tiers[at].annotations[place.index];
                annotation.order = u32::try_from(k).unwrap_or(u32::MAX);
                annotation.span = subdivision_share(span, k, count);
                // An only child has the time of its parent, as an association has.
                annotation.timing = if count == 1 {
                    AnnotationTiming::Parent
                } else {
                    AnnotationTiming::Share
                };
            }
        }
    }

    /// Sorts siblings by their links to the previous one; returns whether they form one chain.
    fn order_sibling_chain(&self, children: &[AnnotationHandle]) -> (Vec<AnnotationHandle>, bool) {
        let family: HashSet<AnnotationHandle> = children.iter().copied().collect();
        let before = |child: AnnotationHandle| match self.resolved.links[child as usize] {
            AnnotationLink::Parent(_, before) => before.filter(|sibling| family.contains(sibling) && *sibling != child),
            AnnotationLink::Slots(..) => None,
        };
        let mut after: HashMap<AnnotationHandle, AnnotationHandle> = HashMap::new();
        let mut heads = Vec::new();
        for child in children {
            match before(*child) {
                Some(before) if !after.contains_key(&before) => {
                    after.insert(before, *child);
                }
                _ => heads.push(*child),
            }
        }
        let is_one_chain = heads.len() == 1;
        let mut sorted = Vec::with_capacity(children.len());
        let mut seen = HashSet::new();
        for head in heads.into_iter().chain(children.iter().copied()) {
            let mut next = Some(head);
            while let Some(child) = next.filter(|child| seen.insert(*child)) {
                sorted.push(child);
                next = after.get(&child).copied();
            }
        }
        (sorted, is_one_chain)
    }

    fn only_children(&self, at: usize, findings: &mut FindingTally) {
        let mut seen = HashSet::new();
        for annotation in &self.tiers[at].annotations {
            if !seen.insert(annotation.parent) {
                findings.add_limited_warning("second annotations where one is allowed", None, || {
                    format!(
                        "annotation {:?} is not the only one below its parent, and its tier allows one",
                        annotation.id
                    )
                });
            }
        }
    }

    fn report_tier_overlaps(&self, at: usize, findings: &mut FindingTally) {
        let mut spans: Vec<(TimeSpan, &str)> = self.tiers[at]
            .annotations
            .iter()
            .map(|annotation| (annotation.span, &*annotation.id))
            .collect();
        if !spans.is_sorted_by_key(|(span, _)| *span) {
            spans.sort();
        }
        let mut last: Option<(TimeSpan, &str)> = None;
        let (mut count, mut shown) = (0, Vec::new());
        for (span, id) in spans {
            if let Some((_, other)) = last.filter(|(last, _)| last.is_overlapping_span(span)) {
                count += 1;
                if shown.len() < SHOWN_OVERLAPS {
                    shown.push(format!("{other:?} and {id:?} at {}", span.span_start_instant()));
                }
            }
            // A long annotation may overlap several later ones.
            if last.is_none_or(|(last, _)| last.span_end_instant() < span.span_end_instant()) {
                last = Some((span, id));
            }
        }
        if count == 0 {
            return;
        }
        let more = match count - shown.len() {
            0 => String::new(),
            more => format!(", and {more} more"),
        };
        findings.add_limited_finding("tiers with annotations that overlap", || {
            ImportFinding::new_warning_finding(
                None,
                format!(
                    "annotations overlap on the tier {:?}: {}{more}",
                    self.tiers[at].name,
                    shown.join(", ")
                ),
            )
            .with_remedy("ELAN allows no overlap within a tier; put one of each two on another tier")
        });
    }

    /// Gives new ids to annotations whose own is empty or taken.
    fn fresh_ids(&mut self) {
        let mut number = self
            .document
            .tiers
            .iter()
            .flat_map(|tier| &tier.annotations)
            .filter_map(|annotation| annotation_number(&annotation.id))
            .max()
            .unwrap_or(0);
        let mut doubles: Vec<AnnotationHandle> = self.resolved.doubles.iter().copied().collect();
        doubles.sort_unstable();
        for place in doubles.into_iter().filter_map(|handle| self.places[handle as usize]) {
            number += 1;
            self.tiers[place.tier].annotations[place.index].id = format!("a{number}");
        }
    }
}

/// Returns the number of an id of ELAN's form, such as 12 of `a12`.
pub(super) fn annotation_number(id: &str) -> Option<u64> {
    id.strip_prefix('a')?
        .parse()
        .ok()
        .filter(|number| *number < u64::MAX / 2)
}

struct TimedSpan {
    span: TimeSpan,
    timing: AnnotationTiming,
    parent: Option<AnnotationAddress>,
    millis: Option<[i64; 2]>,
}
