//! Places the elements of tracks in time, and below the elements that they refer to.

use super::anvil_raw::{AnvilDocument, AnvilElement, AnvilTrack};
use crate::finding::ImportFinding;
use crate::markup::{MAX_TIER_LANES, TimedAnnotation, arrange_tier_lanes, parse_decimal_seconds, report_split_lanes};
use crate::tally::FindingTally;
use crate::transcript::AnnotationTiming;
use chereme_motion::{RecordingInstant, TimeSpan};
use chereme_sign::TierStereotype;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// The deepest nesting of tiers that references make; tracks below become root tiers.
const MAX_TIER_NESTING: usize = 32;

/// Returns the tracks of a document with the places of their elements.
pub(super) fn place_anvil_tracks(document: &AnvilDocument<'_>, findings: &mut FindingTally) -> Vec<PlacedTrack> {
    let mut placing = TrackPlacing::new(document);
    for track in 0..document.tracks.len() {
        placing.resolve_track(track, findings);
    }
    placing.placed
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum AnvilTrackKind {
    Primary,
    Point,
    Singleton,
    Span,
    Subdivision,
}

impl AnvilTrackKind {
    fn parse_track_kind(text: &str) -> Option<Self> {
        let plain: String = text.chars().filter(|c| c.is_alphabetic()).collect();
        Some(match &*plain.to_lowercase() {
            "primary" | "interval" => Self::Primary,
            "primarypoint" | "point" => Self::Point,
            "singleton" => Self::Singleton,
            "span" => Self::Span,
            "subdivision" => Self::Subdivision,
            _ => return None,
        })
    }
}

/// A track with the places of its elements in time and below other elements.
#[derive(Debug, Default)]
pub(super) struct PlacedTrack {
    /// The relation to the track above, and that track.
    pub(super) below: Option<(TierStereotype, usize)>,
    /// The number of tracks above.
    depth: usize,
    /// Whether its elements have times of their own.
    is_alignable: bool,
    pub(super) is_point: bool,
    /// Its elements by their indices.
    index: HashMap<String, usize>,
    /// The place of each element; nothing for one that was left out.
    pub(super) places: Vec<Option<ElementPlace>>,
    /// For each lane that of the track above.
    pub(super) lanes: Vec<usize>,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct ElementPlace {
    pub(super) span: TimeSpan,
    pub(super) timing: AnnotationTiming,
    /// The element above.
    pub(super) parent: Option<usize>,
    /// The tier, if elements of the track lie on several.
    pub(super) lane: usize,
    /// The place among the annotations of that tier.
    pub(super) at: usize,
}

/// A part of an element with a time, before lanes are known.
struct FoundElement {
    element: usize,
    time: TimedAnnotation,
    timing: AnnotationTiming,
    parent: Option<usize>,
}

/// Places the elements of all tracks, each track after the one that it refers to.
struct TrackPlacing<'d> {
    document: &'d AnvilDocument<'d>,
    names: HashMap<&'d str, usize>,
    placed: Vec<PlacedTrack>,
    done: Vec<bool>,
}

impl<'d> TrackPlacing<'d> {
    fn new(document: &'d AnvilDocument<'d>) -> Self {
        let mut names = HashMap::new();
        for (at, track) in document.tracks.iter().enumerate() {
            names.entry(track.name).or_insert(at);
        }
        let many = document.tracks.len();
        Self {
            document,
            names,
            placed: (0..many).map(|_| PlacedTrack::default()).collect(),
            done: vec![false; many],
        }
    }

    /// Returns the track that a track refers to, if its type is one that refers.
    fn track_above(&self, track: usize) -> Option<usize> {
        let track = &self.document.tracks[track];
        let refers = matches!(
            AnvilTrackKind::parse_track_kind(track.kind),
            Some(AnvilTrackKind::Singleton | AnvilTrackKind::Span | AnvilTrackKind::Subdivision)
        );
        let name = track.reference.filter(|_| refers)?;
        self.names.get(name).copied()
    }

    /// Places a track and those that it refers to.
    fn resolve_track(&mut self, track: usize, findings: &mut FindingTally) {
        let mut chain = vec![track];
        let mut seen = BTreeSet::from([track]);
        while let Some(above) = self.track_above(chain[chain.len() - 1]) {
            if self.done[above] || !seen.insert(above) {
                break;
            }
            chain.push(above);
        }
        for track in chain.into_iter().rev() {
            if !self.done[track] {
                let above = self.track_above(track).filter(|above| self.done[*above]);
                self.placed[track] = self.place_anvil_track(track, above, findings);
                self.done[track] = true;
            }
        }
    }

    fn place_anvil_track(&self, at: usize, above: Option<usize>, findings: &mut FindingTally) -> PlacedTrack {
        let track = &self.document.tracks[at];
        let kind = self.anvil_track_kind(track, findings);
        let refers = matches!(
            kind,
            AnvilTrackKind::Singleton | AnvilTrackKind::Span | AnvilTrackKind::Subdivision
        );
        let timed = |element: &AnvilElement<'_>| element.group.is_none() && element.reference.is_none();
        if refers && above.is_none() && !(kind == AnvilTrackKind::Subdivision && track.elements.iter().all(timed)) {
            let named = track.reference.unwrap_or_default();
            let many = track.elements.len();
            findings.add_limited_finding("tracks without the one they refer to", || {
                let why = match self.names.contains_key(named) {
                    true => format!("refers to {named:?}, and so to itself"),
                    false => format!("refers to {named:?}, which is not in the file"),
                };
                ImportFinding::new_warning_finding(
                    track.source.element_line(),
                    format!("the track {:?} {why}; its {many} elements were left out", track.name),
                )
            });
            return PlacedTrack {
                places: vec![None; many],
                lanes: vec![0],
                is_alignable: true,
                ..PlacedTrack::default()
            };
        }
        let mut placed = PlacedTrack {
            is_point: kind == AnvilTrackKind::Point,
            is_alignable: true,
            ..PlacedTrack::default()
        };
        if let Some(above) = above {
            let parent = &self.placed[above];
            let fits = parent.depth < MAX_TIER_NESTING;
            let below = match kind {
                AnvilTrackKind::Singleton if fits => Some(TierStereotype::SymbolicAssociation),
                // Deeper tiers, and times below symbols, are no tiers of ELAN: such tracks stand on their own.
                AnvilTrackKind::Subdivision if fits && parent.is_alignable => Some(TierStereotype::TimeSubdivision),
                _ => None,
            };
            placed.below = below.map(|stereotype| (stereotype, above));
            placed.is_alignable = below.is_none_or(TierStereotype::is_alignable);
            placed.depth = below.map_or(0, |_| parent.depth + 1);
        }
        for (position, element) in track.elements.iter().enumerate() {
            let index_text = element.index.map(str::trim);
            let index = index_text.map_or_else(|| position.to_string(), str::to_owned);
            // Of two elements with one number the first is the one that others refer to.
            placed.index.entry(index).or_insert(position);
        }
        let placed_elements = match (kind, above) {
            (AnvilTrackKind::Primary | AnvilTrackKind::Point, _) | (_, None) => {
                self.timed_track_elements(track, kind, findings)
            }
            (AnvilTrackKind::Singleton, Some(above)) => self.singletons(track, above, findings),
            (AnvilTrackKind::Span, Some(above)) => self.span_track_elements(track, above, findings),
            (AnvilTrackKind::Subdivision, Some(above)) => self.group_part_elements(track, above, findings),
        };
        self.arrange_track_elements(track, placed_elements, &mut placed, findings);
        placed
    }

    fn anvil_track_kind(&self, track: &AnvilTrack<'_>, findings: &mut FindingTally) -> AnvilTrackKind {
        AnvilTrackKind::parse_track_kind(track.kind).unwrap_or_else(|| {
            findings.add_limited_note("tracks of unknown types", track.source.element_line(), || {
                format!(
                    "the track {:?} is of the type {:?}, which is not known; its elements are read by their times",
                    track.name, track.kind
                )
            });
            match track.elements.iter().all(|element| element.time.is_some()) && !track.elements.is_empty() {
                true => AnvilTrackKind::Point,
                false => AnvilTrackKind::Primary,
            }
        })
    }

    /// Returns the elements that have times of their own.
    fn timed_track_elements(
        &self,
        track: &AnvilTrack<'_>,
        kind: AnvilTrackKind,
        findings: &mut FindingTally,
    ) -> Vec<FoundElement> {
        let mut all = Vec::with_capacity(track.elements.len());
        for (at, element) in track.elements.iter().enumerate() {
            let instant = |text: Option<&str>| text.and_then(parse_decimal_seconds).map(RecordingInstant::from_micros);
            let point = instant(element.time).or(instant(element.start));
            let times = instant(element.start).zip(instant(element.end));
            let time = match (kind, times, point) {
                (AnvilTrackKind::Point, _, Some(point)) => TimedAnnotation::timed_at_point(point),
                (_, Some((start, end)), _) => {
                    let line = || element.source.element_line();
                    TimedAnnotation::timed_between_instants(start, end, track.name, line, findings)
                }
                (_, None, Some(point)) if element.time.is_some() => TimedAnnotation::timed_at_point(point),
                _ => {
                    self.report_lost_element(track, at, "has no time that can be read", findings);
                    continue;
                }
            };
            all.push(FoundElement {
                element: at,
                time,
                timing: AnnotationTiming::Own,
                parent: None,
            });
        }
        all
    }

    /// Reports an element that was left out.
    fn report_lost_element(&self, track: &AnvilTrack<'_>, at: usize, why: &str, findings: &mut FindingTally) {
        findings.add_limited_finding("elements that were left out", || {
            let element = &track.elements[at];
            let index = element.index.map_or(at.to_string(), str::to_owned);
            ImportFinding::new_warning_finding(
                element.source.element_line(),
                format!("element {index} of the track {:?} {why} and was left out", track.name),
            )
        });
    }

    /// Returns the element of a track that a text refers to, and its place.
    fn referred(&self, track: usize, index: Option<&str>) -> Option<(usize, ElementPlace)> {
        let placed = &self.placed[track];
        let element = *placed.index.get(index?.trim())?;
        Some((element, placed.places[element]?))
    }

    fn singletons(&self, track: &AnvilTrack<'_>, above: usize, findings: &mut FindingTally) -> Vec<FoundElement> {
        let mut all = Vec::with_capacity(track.elements.len());
        for (at, element) in track.elements.iter().enumerate() {
            let index = element.reference.or(element.start);
            let Some((parent, place)) = self.referred(above, index) else {
                self.report_lost_element(track, at, "refers to no element that was read", findings);
                continue;
            };
            all.push(FoundElement {
                element: at,
                time: TimedAnnotation {
                    span: place.span,
                    is_point: false,
                },
                timing: AnnotationTiming::Parent,
                parent: Some(parent),
            });
        }
        all
    }

    fn span_track_elements(
        &self,
        track: &AnvilTrack<'_>,
        above: usize,
        findings: &mut FindingTally,
    ) -> Vec<FoundElement> {
        let covered = &self.placed[above];
        let mut all = Vec::with_capacity(track.elements.len());
        for (at, element) in track.elements.iter().enumerate() {
            let first = self.referred(above, element.start);
            // Without an end it spans one element.
            let last = self.referred(above, element.end.or(element.start));
            let (Some((_, first)), Some((_, last))) = (first, last) else {
                self.report_lost_element(track, at, "refers to no element that was read", findings);
                continue;
            };
            // The two may be named in either order.
            let start = first.span.span_start_instant().min(last.span.span_start_instant());
            let end = match covered.is_point {
                true => first.span.span_start_instant().max(last.span.span_start_instant()),
                false => first.span.span_end_instant().max(last.span.span_end_instant()),
            };
            let line = || element.source.element_line();
            all.push(FoundElement {
                element: at,
                time: TimedAnnotation::timed_between_instants(start, end, track.name, line, findings),
                timing: AnnotationTiming::Own,
                parent: None,
            });
        }
        if !all.is_empty() {
            findings.add_limited_note("tracks of spans", track.source.element_line(), || {
                format!(
                    "the elements of the track {:?} span those of {:?}: they have their times, and no link to them",
                    track.name, self.document.tracks[above].name
                )
            });
        }
        all
    }

    /// Returns the elements of groups, which divide the time of the element that the group refers to.
    fn group_part_elements(
        &self,
        track: &AnvilTrack<'_>,
        above: usize,
        findings: &mut FindingTally,
    ) -> Vec<FoundElement> {
        let mut groups: Vec<(Option<&str>, Vec<usize>)> =
            track.groups.iter().map(|reference| (*reference, Vec::new())).collect();
        let mut loose: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
        let mut all = Vec::with_capacity(track.elements.len());
        for (at, element) in track.elements.iter().enumerate() {
            match (element.group, element.reference) {
                (Some(group), _) => groups[group].1.push(at),
                // Early versions write the reference at each element instead of at their group.
                (None, Some(reference)) => loose.entry(reference).or_default().push(at),
                (None, None) => self.report_lost_element(track, at, "refers to no element that was read", findings),
            }
        }
        groups.extend(loose.into_iter().map(|(reference, all)| (Some(reference), all)));
        for (reference, elements) in groups {
            let Some((parent, place)) = self.referred(above, reference) else {
                for at in elements {
                    self.report_lost_element(track, at, "refers to no element that was read", findings);
                }
                continue;
            };
            let cuts = self.cuts(track, &elements, place.span, findings);
            for (part, element) in elements.into_iter().enumerate() {
                let [start, end] = [cuts[part], cuts[part + 1]];
                let timing = match (start.1, end.1) {
                    (true, true) => AnnotationTiming::Own,
                    (start, end) => AnnotationTiming::Proposed {
                        start: !start,
                        end: !end,
                    },
                };
                all.push(FoundElement {
                    element,
                    time: TimedAnnotation {
                        span: TimeSpan::span_between(start.0, end.0),
                        is_point: false,
                    },
                    timing,
                    parent: Some(parent),
                });
            }
        }
        all
    }

    /// Returns the boundaries of elements that divide a time, and whether the file states them.
    fn cuts(
        &self,
        track: &AnvilTrack<'_>,
        elements: &[usize],
        whole: TimeSpan,
        findings: &mut FindingTally,
    ) -> Vec<(RecordingInstant, bool)> {
        let element = |part: usize| &track.elements[elements[part]];
        let many = elements.len();
        let instant = |text: Option<&str>| text.and_then(parse_decimal_seconds).map(RecordingInstant::from_micros);
        let mut cuts: Vec<Option<RecordingInstant>> = vec![None; many + 1];
        (cuts[0], cuts[many]) = (Some(whole.span_start_instant()), Some(whole.span_end_instant()));
        let mut last = whole.span_start_instant();
        for (part, cut) in cuts.iter_mut().enumerate().take(many).skip(1) {
            let stated = instant(element(part).start).or(instant(element(part - 1).end));
            match stated {
                Some(stated) if stated > last && stated < whole.span_end_instant() => {
                    *cut = Some(stated);
                    last = stated;
                }
                Some(stated) => findings.add_limited_warning("boundaries out of order", element(part).source.element_line(), || format!(
                            "the boundary at {stated} on the track {:?} is out of order; the elements beside it share their time evenly",
                            track.name
                        )),
                None => {}
            }
        }
        let mut cut_index = 0;
        let mut all_cuts = Vec::with_capacity(many + 1);
        while cut_index <= many {
            let next = (cut_index + 1..=many)
                .find(|next| cuts[*next].is_some())
                .unwrap_or(many + 1);
            let from = cuts[cut_index].unwrap_or_default();
            let until = cuts.get(next).copied().flatten().unwrap_or(from);
            let length = i128::from(until.instant_micros()) - i128::from(from.instant_micros());
            for step in cut_index..next {
                // Elements between two stated boundaries share their time evenly; products of 64 bits could overflow.
                let share = length * (step - cut_index) as i128 / (next - cut_index) as i128;
                all_cuts.push((from.shifted_instant(share as i64), step == cut_index));
            }
            cut_index = next;
        }
        all_cuts
    }

    /// Puts elements onto the tiers of a track.
    fn arrange_track_elements(
        &self,
        track: &AnvilTrack<'_>,
        found: Vec<FoundElement>,
        placed: &mut PlacedTrack,
        findings: &mut FindingTally,
    ) {
        placed.places = vec![None; track.elements.len()];
        let mut times: Vec<TimedAnnotation> = found.iter().map(|item| item.time).collect();
        let (of, crowded) = match placed.below {
            None => arrange_tier_lanes(&mut times),
            Some((_, above)) => self.lanes_below_elements(&found, above, placed),
        };
        if placed.below.is_none() {
            // A track without elements still is a tier.
            placed.lanes = vec![0; of.iter().max().map_or(1, |last| last + 1)];
        }
        let of_times: &[usize] = if placed.below.is_none() { &of } else { &[] };
        report_split_lanes(track.name, of_times, crowded, || track.source.element_line(), findings);
        let mut counts = vec![0; placed.lanes.len()];
        for ((it, lane), time) in found.into_iter().zip(of).zip(times) {
            placed.places[it.element] = Some(ElementPlace {
                span: time.span,
                timing: it.timing,
                parent: it.parent.filter(|_| placed.below.is_some()),
                lane,
                at: counts[lane],
            });
            counts[lane] += 1;
        }
    }

    /// Returns the lanes of elements below others: each lies below that of the element above; a second one for the same
    /// element gets another.
    fn lanes_below_elements(
        &self,
        found: &[FoundElement],
        above: usize,
        placed: &mut PlacedTrack,
    ) -> (Vec<usize>, u64) {
        let symbolic = !placed.is_alignable;
        let mut seen: HashMap<(usize, RecordingInstant), usize> = HashMap::new();
        let mut keys = Vec::with_capacity(found.len());
        let mut crowded = 0;
        for it in found {
            let parent = it.parent.unwrap_or_default();
            let lane = self.placed[above].places[parent].map_or(0, |place| place.lane);
            // Symbols have no times, so that two of one parent always stand in each other's way.
            let start = if symbolic {
                RecordingInstant::RECORDING_START
            } else {
                it.time.span.span_start_instant()
            };
            let ordinal = seen.entry((parent, start)).or_default();
            crowded += u64::from(*ordinal >= MAX_TIER_LANES);
            keys.push(((*ordinal).min(MAX_TIER_LANES - 1), lane));
            *ordinal += 1;
        }
        let mut lane_numbers: BTreeMap<(usize, usize), usize> = keys.iter().map(|key| (*key, 0)).collect();
        if lane_numbers.is_empty() {
            lane_numbers.insert((0, 0), 0);
        }
        for (number, (key, lane)) in lane_numbers.iter_mut().enumerate() {
            *lane = number;
            placed.lanes.push(key.1);
        }
        (keys.iter().map(|key| lane_numbers[key]).collect(), crowded)
    }
}
