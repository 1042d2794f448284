//! Converts a raw document to its meaning.

pub use super::back::to_raw;
pub use super::model::{
    Annotation, AnnotationAddress, EntryValue, Media, Tier, Timing, Transcript, Vocabulary,
    VocabularyEntry,
};

use super::check::{Handle, Link, Resolved, resolve};
use super::raw::{self, Document, Text};
use crate::finding::Finding;
use crate::tally::Findings;
use chereme_motion::{Instant, Span};
use chereme_sign::Stereotype;
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
pub fn from_raw(document: &Document<'_>) -> (Transcript, Vec<Finding>) {
    let (transcript, _, findings) = from_raw_placed(document);
    (transcript, findings)
}

/// Does what [`from_raw`] does, and returns the place of each annotation, counted over all tiers; an
/// annotation that was left out has none.
pub(super) fn from_raw_placed(
    document: &Document<'_>,
) -> (Transcript, Vec<Option<AnnotationAddress>>, Vec<Finding>) {
    let (resolved, mut reported) = resolve(document);
    let mut findings = Findings::default();
    let times = SlotTimes::new(document, &resolved, &mut findings);
    let (tiers, places) = Tiers::new(document, &resolved, &times).convert(&mut findings);
    reported.extend(findings.finish());
    let transcript = Transcript {
        author: document.author.to_string(),
        date: document.date.to_string(),
        media: document.header.media.iter().map(media).collect(),
        linked_files: document
            .header
            .linked_files
            .iter()
            .map(linked_file)
            .collect(),
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
        vocabularies: vocabularies(document),
    };
    (transcript, places, reported)
}

/// Returns the controlled vocabularies of a document, for example of an `.ecv` file.
#[must_use]
pub fn vocabularies(document: &Document<'_>) -> Vec<Vocabulary> {
    let references: HashMap<&str, &str> = document
        .external_refs
        .iter()
        .map(|it| (&*it.id, &*it.value))
        .collect();
    let vocabulary = |cv: &raw::Vocabulary<'_>| Vocabulary {
        id: cv.id.to_string(),
        descriptions: cv
            .descriptions
            .iter()
            .map(|it| (plain(it.language.as_ref()), it.text.to_string()))
            .collect(),
        entries: cv.entries.iter().map(entry).collect(),
        external: cv
            .external_ref
            .as_deref()
            .and_then(|id| references.get(id))
            .map(|url| (*url).to_owned()),
    };
    document.vocabularies.iter().map(vocabulary).collect()
}

fn entry(entry: &raw::Entry<'_>) -> VocabularyEntry {
    VocabularyEntry {
        id: plain(entry.id.as_ref()),
        values: entry
            .values
            .iter()
            .map(|it| EntryValue {
                language: plain(it.language.as_ref()),
                value: it.value.to_string(),
                description: owned(it.description.as_ref()),
            })
            .collect(),
        external_ref: owned(entry.external_ref.as_ref()),
    }
}

fn media(media: &raw::MediaDescriptor<'_>) -> Media {
    Media {
        url: media.url.to_string(),
        relative_url: owned(media.relative_url.as_ref()),
        mime_type: media.mime_type.to_string(),
        time_origin: media.time_origin,
        source: owned(media.extracted_from.as_ref()),
    }
}

fn linked_file(file: &raw::LinkedFile<'_>) -> Media {
    Media {
        url: file.url.to_string(),
        relative_url: owned(file.relative_url.as_ref()),
        mime_type: file.mime_type.to_string(),
        time_origin: file.time_origin,
        source: owned(file.associated_with.as_ref()),
    }
}

fn owned(text: Option<&Text<'_>>) -> Option<String> {
    text.map(|text| text.to_string())
}

fn plain(text: Option<&Text<'_>>) -> String {
    owned(text).unwrap_or_default()
}

/// The time of each time slot, in the order of the file.
struct SlotTimes {
    millis: Vec<Option<i64>>,
    times: Vec<Instant>,
}

impl SlotTimes {
    fn new(document: &Document<'_>, resolved: &Resolved, findings: &mut Findings) -> Self {
        let units = document
            .header
            .time_units
            .as_deref()
            .unwrap_or("milliseconds");
        let (per, of) = match units {
            "milliseconds" => (1, 1),
            "PAL-frames" => (40, 1),
            "NTSC-frames" => (1001, 30),
            _ => {
                findings.add("unknown time units", || {
                    Finding::warning(
                        None,
                        format!(
                            "the time units {units:?} are not known; they were read as milliseconds"
                        ),
                    )
                    .with_remedy("set TIME_UNITS to milliseconds, PAL-frames or NTSC-frames")
                });
                (1, 1)
            }
        };
        if of * per != 1 {
            findings.add("times in frames", || {
                Finding::note(
                    None,
                    format!("the times are in {units}; they become milliseconds"),
                )
            });
        }
        let time = |value: i64| {
            let micros = i128::from(value) * 1000 * i128::from(per) / i128::from(of);
            Instant::from_micros(micros.clamp(i64::MIN.into(), i64::MAX.into()) as i64)
        };
        let known: Vec<Option<Instant>> = document
            .time_order
            .iter()
            .map(|slot| slot.value.map(time))
            .collect();
        let millis = known.iter().map(|it| it.map(Instant::millis)).collect();
        let mut slots = Self {
            millis,
            times: known.iter().map(|it| it.unwrap_or_default()).collect(),
        };
        if known.iter().any(Option::is_none) {
            slots.propose(&known, resolved);
        }
        slots
    }

    /// Places the unaligned slots: those in a chain of annotations on one tier within that chain, the
    /// others within the time order.
    fn propose(&mut self, known: &[Option<Instant>], resolved: &Resolved) {
        let mut known = known.to_vec();
        for tier in resolved.first.windows(2) {
            let links = &resolved.links[tier[0] as usize..tier[1] as usize];
            let mut chain: Vec<usize> = Vec::new();
            for link in links {
                let Link::Slots(Some(start), Some(end)) = *link else {
                    continue;
                };
                if chain.last() != Some(&(start as usize)) {
                    spread(&chain, &mut known);
                    chain.clear();
                    chain.push(start as usize);
                }
                chain.push(end as usize);
            }
            spread(&chain, &mut known);
        }
        let all: Vec<usize> = (0..known.len()).collect();
        spread(&all, &mut known);
        let edge = known.iter().flatten().next().copied().unwrap_or_default();
        let mut last = edge;
        for (time, known) in self.times.iter_mut().zip(known) {
            last = known.unwrap_or(last);
            *time = last;
        }
    }
}

/// Spreads the unknown times of a chain of slots evenly, in whole milliseconds, between the known.
fn spread(chain: &[usize], known: &mut [Option<Instant>]) {
    let mut from: Option<(usize, Instant)> = None;
    for (at, slot) in chain.iter().enumerate() {
        let Some(time) = known[*slot] else { continue };
        if let Some((start, t0)) = from {
            let (n, t0, t1) = (
                (at - start - 1) as i128,
                i128::from(t0.millis()),
                i128::from(time.millis()),
            );
            for (k, slot) in (1..).zip(&chain[start + 1..at]) {
                let t = t0 + k * (t1 - t0) / (n + 1);
                known[*slot] = Some(Instant::from_millis(t as i64));
            }
        }
        from = Some((at, time));
    }
}

/// The tiers during conversion.
struct Tiers<'d> {
    document: &'d Document<'d>,
    resolved: &'d Resolved,
    times: &'d SlotTimes,
    /// The place of each raw annotation in the result; `None` for one that was left out.
    places: Vec<Option<AnnotationAddress>>,
    tiers: Vec<Tier>,
}

impl<'d> Tiers<'d> {
    fn new(document: &'d Document<'d>, resolved: &'d Resolved, times: &'d SlotTimes) -> Self {
        let places = vec![None; resolved.links.len()];
        let mut tiers = Self {
            document,
            resolved,
            times,
            places,
            tiers: Vec::new(),
        };
        let mut names: HashSet<String> = document
            .tiers
            .iter()
            .map(|tier| tier.id.to_string())
            .collect();
        let mut used: HashMap<String, u64> = HashMap::new();
        for (at, tier) in document.tiers.iter().enumerate() {
            let mut name = tier.id.to_string();
            let count = used
                .entry(name.clone())
                .and_modify(|n| *n += 1)
                .or_insert(1);
            while name.is_empty() || (*count > 1 && names.contains(&name)) {
                let base = if tier.id.is_empty() {
                    "tier"
                } else {
                    &*tier.id
                };
                name = format!("{base} {count}");
                *count += u64::from(names.contains(&name));
            }
            names.insert(name.clone());
            tiers.tiers.push(tiers.empty(at, tier, name));
        }
        tiers
    }

    fn empty(&self, at: usize, tier: &raw::Tier<'_>, name: String) -> Tier {
        let kind = self.resolved.types[at].map(|kind| &self.document.linguistic_types[kind]);
        Tier {
            name,
            parent: self.resolved.parents[at],
            stereotype: self.resolved.stereotypes[at],
            kind: tier.linguistic_type.to_string(),
            participant: owned(tier.participant.as_ref()),
            annotator: owned(tier.annotator.as_ref()),
            language: owned(tier.language.as_ref()),
            locale: owned(tier.locale.as_ref()),
            vocabulary: kind.and_then(|kind| owned(kind.vocabulary.as_ref())),
            annotations: Vec::with_capacity(tier.annotations.len()),
        }
    }

    fn convert(mut self, findings: &mut Findings) -> (Vec<Tier>, Vec<Option<AnnotationAddress>>) {
        for at in self.resolved.order.clone() {
            self.tier(at, findings);
        }
        self.fresh_ids();
        (self.tiers, self.places)
    }

    fn tier(&mut self, at: usize, findings: &mut Findings) {
        let document = self.document;
        let first = self.resolved.first[at];
        for (handle, annotation) in (first..).zip(&document.tiers[at].annotations) {
            let held = match self.resolved.links[handle as usize] {
                Link::Slots(Some(start), Some(end)) => {
                    self.slots(start as usize, end as usize, annotation, findings)
                }
                Link::Parent(Some(parent), _) => {
                    self.places[parent as usize].map(|place| TimedSpan {
                        span: self.tiers[place.tier].annotations[place.index].span,
                        timing: Timing::Parent,
                        // A tier that became a root tier keeps its times only.
                        parent: self.tiers[at].parent.map(|_| place),
                        millis: None,
                    })
                }
                _ => None,
            };
            let Some(held) = held else {
                findings.add("annotations that were left out", || {
                    let id = &annotation.id;
                    Finding::warning(
                        self.document.line(annotation.at),
                        format!("annotation {id:?} has no place in time and was left out"),
                    )
                });
                continue;
            };
            self.places[handle as usize] = Some(AnnotationAddress {
                tier: at,
                index: self.tiers[at].annotations.len(),
            });
            self.tiers[at].annotations.push(Annotation {
                id: annotation.id.to_string(),
                span: held.span,
                timing: held.timing,
                parent: held.parent,
                order: 0,
                value: annotation.value.to_string(),
                entry: owned(annotation.entry.as_ref()),
                language: owned(annotation.language.as_ref()),
                external_ref: owned(annotation.external_ref.as_ref()),
                millis: held.millis,
            });
        }
        match self.tiers[at].stereotype {
            Some(Stereotype::SymbolicSubdivision) => self.order_siblings(at, findings),
            Some(Stereotype::SymbolicAssociation) => self.only_children(at, findings),
            Some(_) => self.find_parents(at, findings),
            None => {}
        }
        if self.tiers[at]
            .stereotype
            .is_none_or(Stereotype::is_alignable)
        {
            self.overlaps(at, findings);
        }
        if self.tiers[at].stereotype == Some(Stereotype::TimeSubdivision) {
            self.gaps(at, findings);
        }
    }

    /// Reports annotations that their subdivision covers only in part.
    fn gaps(&self, at: usize, findings: &mut Findings) {
        let mut divided: BTreeMap<(usize, usize), Vec<Span>> = BTreeMap::new();
        for annotation in &self.tiers[at].annotations {
            if let Some(above) = annotation.parent {
                let spans = divided.entry((above.tier, above.index)).or_default();
                spans.push(annotation.span);
            }
        }
        for ((tier, index), mut spans) in divided {
            let whole = &self.tiers[tier].annotations[index];
            spans.sort();
            let mut covered = whole.span.start();
            let mut gap = false;
            for span in spans {
                gap |= span.start() > covered;
                covered = covered.max(span.end());
            }
            if gap || covered < whole.span.end() {
                findings.add("subdivisions with gaps", || {
                    let message = format!(
                        "the Time_Subdivision {:?} leaves part of annotation {:?} uncovered",
                        self.tiers[at].name, whole.id
                    );
                    Finding::warning(None, message).with_remedy(
                        "ELAN allows no gaps there; move a boundary, or make the tier Included_In",
                    )
                });
            }
        }
    }

    fn slots(
        &self,
        start: usize,
        end: usize,
        annotation: &raw::Annotation<'_>,
        findings: &mut Findings,
    ) -> Option<TimedSpan> {
        let (from, to) = (self.times.times[start], self.times.times[end]);
        if to <= from {
            findings.add("annotations that end before they start", || {
                let what = if to == from {
                    "has no length"
                } else {
                    "ends before it starts; the ends were exchanged"
                };
                Finding::warning(
                    self.document.line(annotation.at),
                    format!("annotation {:?} {what}", annotation.id),
                )
            });
        }
        let millis = self.times.millis[start].zip(self.times.millis[end]);
        let (start, end) = (
            self.times.millis[start].is_none(),
            self.times.millis[end].is_none(),
        );
        let swapped = to < from;
        Some(TimedSpan {
            span: Span::between(from, to),
            timing: if start || end {
                Timing::Proposed {
                    start: if swapped { end } else { start },
                    end: if swapped { start } else { end },
                }
            } else {
                Timing::Own
            },
            parent: None,
            millis: millis.map(|(from, to)| [from.min(to), from.max(to)]),
        })
    }

    /// Finds for each annotation of an alignable child tier the annotation above that overlaps it most.
    fn find_parents(&mut self, at: usize, findings: &mut Findings) {
        let Some(above) = self.tiers[at].parent else {
            return;
        };
        let mut spans: Vec<(Span, usize)> = self.tiers[above]
            .annotations
            .iter()
            .enumerate()
            .map(|(index, it)| (it.span, index))
            .collect();
        spans.sort();
        let mut tier = std::mem::take(&mut self.tiers[at].annotations);
        for annotation in &mut tier {
            let span = annotation.span;
            let next = spans.partition_point(|(it, _)| it.start() <= span.start());
            let near = &spans[next.saturating_sub(2)..(next + 1).min(spans.len())];
            let shared = |it: Span| {
                let (start, end) = (it.start().max(span.start()), it.end().min(span.end()));
                end.micros().saturating_sub(start.micros())
            };
            let best = near
                .iter()
                .max_by_key(|(it, index)| (shared(*it), std::cmp::Reverse(*index)));
            annotation.parent = best
                .filter(|(it, _)| it.overlaps(span) || it.covers(span))
                .map(|(_, index)| AnnotationAddress {
                    tier: above,
                    index: *index,
                });
            let inside = best.is_some_and(|(it, _)| it.covers(span));
            if !inside {
                findings.add("annotations that lie outside those above them", || {
                    Finding::warning(
                        None,
                        format!(
                            "annotation {:?} does not lie within an annotation of the tier above",
                            annotation.id
                        ),
                    )
                });
            }
        }
        self.tiers[at].annotations = tier;
    }

    /// Gives the children of a Symbolic_Subdivision their places and their shares of time.
    fn order_siblings(&mut self, at: usize, findings: &mut Findings) {
        let first = self.resolved.first[at];
        let handles = first..self.resolved.first[at + 1];
        let mut families: Vec<(AnnotationAddress, Vec<Handle>)> = Vec::new();
        let mut known: HashMap<AnnotationAddress, usize> = HashMap::new();
        for handle in handles {
            let Some(place) = self.places[handle as usize] else {
                continue;
            };
            let Some(parent) = self.tiers[at].annotations[place.index].parent else {
                continue;
            };
            let family = *known.entry(parent).or_insert(families.len());
            if family == families.len() {
                families.push((parent, Vec::new()));
            }
            families[family].1.push(handle);
        }
        for (parent, children) in families {
            let (sorted, whole) = self.chain(&children);
            if !whole {
                findings.add("broken chains of annotations", || {
                    let above = self.tiers[parent.tier].annotations.get(parent.index).map_or("", |it| &it.id);
                    Finding::warning(None, format!("the annotations below {above:?} are not one chain; loose annotations follow in the order of the file"))
                });
            }
            let (span, count) = (
                self.tiers[parent.tier].annotations[parent.index].span,
                sorted.len(),
            );
            for (k, handle) in sorted.into_iter().enumerate() {
                let Some(place) = self.places[handle as usize] else {
                    continue;
                };
                let annotation = &mut self.tiers[at].annotations[place.index];
                annotation.order = u32::try_from(k).unwrap_or(u32::MAX);
                annotation.span = share(span, k, count);
                annotation.timing = if count == 1 {
                    Timing::Parent
                } else {
                    Timing::Share
                };
            }
        }
    }

    /// Sorts siblings by their links to the previous one; returns whether they form one chain.
    fn chain(&self, children: &[Handle]) -> (Vec<Handle>, bool) {
        let family: HashSet<Handle> = children.iter().copied().collect();
        let before = |child: Handle| match self.resolved.links[child as usize] {
            Link::Parent(_, before) => before.filter(|it| family.contains(it) && *it != child),
            Link::Slots(..) => None,
        };
        let mut after: HashMap<Handle, Handle> = HashMap::new();
        let mut heads = Vec::new();
        for child in children {
            match before(*child) {
                Some(before) if !after.contains_key(&before) => {
                    after.insert(before, *child);
                }
                _ => heads.push(*child),
            }
        }
        let whole = heads.len() == 1;
        let mut sorted = Vec::with_capacity(children.len());
        let mut seen = HashSet::new();
        for head in heads.into_iter().chain(children.iter().copied()) {
            let mut next = Some(head);
            while let Some(child) = next.filter(|child| seen.insert(*child)) {
                sorted.push(child);
                next = after.get(&child).copied();
            }
        }
        (sorted, whole)
    }

    fn only_children(&self, at: usize, findings: &mut Findings) {
        let mut seen = HashSet::new();
        for annotation in &self.tiers[at].annotations {
            if !seen.insert(annotation.parent) {
                findings.add("second annotations where one is allowed", || {
                    Finding::warning(None, format!("annotation {:?} is not the only one below its parent, and its tier allows one", annotation.id))
                });
            }
        }
    }

    fn overlaps(&self, at: usize, findings: &mut Findings) {
        let mut spans: Vec<(Span, &str)> = self.tiers[at]
            .annotations
            .iter()
            .map(|it| (it.span, &*it.id))
            .collect();
        if !spans.is_sorted_by_key(|(span, _)| *span) {
            spans.sort();
        }
        let mut last: Option<(Span, &str)> = None;
        let (mut count, mut shown) = (0, Vec::new());
        for (span, id) in spans {
            if let Some((_, other)) = last.filter(|(last, _)| last.overlaps(span)) {
                count += 1;
                if shown.len() < SHOWN_OVERLAPS {
                    shown.push(format!("{other:?} and {id:?} at {}", span.start()));
                }
            }
            if last.is_none_or(|(last, _)| last.end() < span.end()) {
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
        findings.add("tiers with annotations that overlap", || {
            Finding::warning(
                None,
                format!(
                    "annotations overlap on the tier {:?}: {}{more}",
                    self.tiers[at].name,
                    shown.join(", ")
                ),
            )
            .with_remedy(
                "ELAN allows no overlap within a tier; put one of each two on another tier",
            )
        });
    }

    /// Gives new ids to annotations whose own is empty or taken.
    fn fresh_ids(&mut self) {
        let mut number = self
            .document
            .tiers
            .iter()
            .flat_map(|tier| &tier.annotations)
            .filter_map(|it| annotation_number(&it.id))
            .max()
            .unwrap_or(0);
        let mut doubles: Vec<Handle> = self.resolved.doubles.iter().copied().collect();
        doubles.sort_unstable();
        for place in doubles
            .into_iter()
            .filter_map(|handle| self.places[handle as usize])
        {
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
    span: Span,
    timing: Timing,
    parent: Option<AnnotationAddress>,
    millis: Option<[i64; 2]>,
}

/// Returns the `k`-th of `count` even shares of `span`.
fn share(span: Span, k: usize, count: usize) -> Span {
    let cut = |k: usize| {
        let offset = i128::from(span.micros()) * k as i128 / count as i128;
        span.start().shifted(offset as i64)
    };
    Span::between(cut(k), cut(k + 1))
}
