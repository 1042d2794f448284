//! Places the elements of tracks in time, and below the elements that they refer to.

use super::raw::{Document, Element, Text, Track};
use crate::eaf::convert::Timing;
use crate::finding::Finding;
use crate::markup::{LANES, Timed, lanes, micros, split};
use crate::tally::Findings;
use chereme_motion::{Instant, Span};
use chereme_sign::Stereotype;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// The deepest nesting of tiers that references make; tracks below become root tiers.
const DEPTH: usize = 32;

/// Returns the tracks of a document with the places of their elements.
pub(super) fn placed(document: &Document<'_>, findings: &mut Findings) -> Vec<Placed> {
    let mut placing = Placing::new(document);
    for track in 0..document.tracks.len() {
        placing.resolve(track, findings);
    }
    placing.placed
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Primary,
    Point,
    Singleton,
    Span,
    Subdivision,
}

impl Kind {
    fn of(text: &str) -> Option<Self> {
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
pub(super) struct Placed {
    /// The relation to the track above, and that track.
    pub(super) below: Option<(Stereotype, usize)>,
    /// The number of tracks above.
    depth: usize,
    /// Whether its elements have times of their own.
    is_alignable: bool,
    pub(super) is_point: bool,
    /// Its elements by their indices.
    index: HashMap<String, usize>,
    /// The place of each element; nothing for one that was left out.
    pub(super) places: Vec<Option<Place>>,
    /// For each lane that of the track above.
    pub(super) lanes: Vec<usize>,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub(super) span: Span,
    pub(super) timing: Timing,
    /// The element above.
    pub(super) parent: Option<usize>,
    /// The tier, if elements of the track lie on several.
    pub(super) lane: usize,
    /// The place among the annotations of that tier.
    pub(super) at: usize,
}

/// A part of an element with a time, before lanes are known.
struct Found {
    element: usize,
    time: Timed,
    timing: Timing,
    parent: Option<usize>,
}

/// Places the elements of all tracks, each track after the one that it refers to.
struct Placing<'d> {
    document: &'d Document<'d>,
    names: HashMap<&'d str, usize>,
    placed: Vec<Placed>,
    done: Vec<bool>,
}

impl<'d> Placing<'d> {
    fn new(document: &'d Document<'d>) -> Self {
        let mut names = HashMap::new();
        for (at, track) in document.tracks.iter().enumerate() {
            names.entry(&*track.name).or_insert(at);
        }
        let many = document.tracks.len();
        Self {
            document,
            names,
            placed: (0..many).map(|_| Placed::default()).collect(),
            done: vec![false; many],
        }
    }

    /// Returns the track that a track refers to, if its type is one that refers.
    fn above(&self, track: usize) -> Option<usize> {
        let track = &self.document.tracks[track];
        let refers = matches!(
            Kind::of(&track.kind),
            Some(Kind::Singleton | Kind::Span | Kind::Subdivision)
        );
        let name = track.reference.as_deref().filter(|_| refers)?;
        self.names.get(name).copied()
    }

    /// Places a track and those that it refers to.
    fn resolve(&mut self, track: usize, findings: &mut Findings) {
        let mut chain = vec![track];
        let mut seen = BTreeSet::from([track]);
        while let Some(above) = self.above(chain[chain.len() - 1]) {
            if self.done[above] || !seen.insert(above) {
                break;
            }
            chain.push(above);
        }
        for track in chain.into_iter().rev() {
            if !self.done[track] {
                let above = self.above(track).filter(|above| self.done[*above]);
                self.placed[track] = self.place(track, above, findings);
                self.done[track] = true;
            }
        }
    }

    fn place(&self, at: usize, above: Option<usize>, findings: &mut Findings) -> Placed {
        let track = &self.document.tracks[at];
        let kind = self.kind(track, findings);
        let refers = matches!(kind, Kind::Singleton | Kind::Span | Kind::Subdivision);
        let timed = |element: &Element<'_>| element.group.is_none() && element.reference.is_none();
        if refers
            && above.is_none()
            && !(kind == Kind::Subdivision && track.elements.iter().all(timed))
        {
            let named = track.reference.as_deref().unwrap_or_default();
            let many = track.elements.len();
            findings.add("tracks without the one they refer to", || {
                let why = match self.names.contains_key(named) {
                    true => format!("refers to {named:?}, and so to itself"),
                    false => format!("refers to {named:?}, which is not in the file"),
                };
                Finding::warning(
                    self.document.line(track.at),
                    format!(
                        "the track {:?} {why}; its {many} elements were left out",
                        track.name
                    ),
                )
            });
            return Placed {
                places: vec![None; many],
                lanes: vec![0],
                is_alignable: true,
                ..Placed::default()
            };
        }
        let mut placed = Placed {
            is_point: kind == Kind::Point,
            is_alignable: true,
            ..Placed::default()
        };
        if let Some(above) = above {
            let parent = &self.placed[above];
            let fits = parent.depth < DEPTH;
            let below = match kind {
                Kind::Singleton if fits => Some(Stereotype::SymbolicAssociation),
                Kind::Subdivision if fits && parent.is_alignable => {
                    Some(Stereotype::TimeSubdivision)
                }
                _ => None,
            };
            placed.below = below.map(|it| (it, above));
            placed.is_alignable = below.is_none_or(Stereotype::is_alignable);
            placed.depth = below.map_or(0, |_| parent.depth + 1);
        }
        for (position, element) in track.elements.iter().enumerate() {
            let index = element.index.as_deref().map(str::trim);
            let index = index.map_or_else(|| position.to_string(), str::to_owned);
            placed.index.entry(index).or_insert(position);
        }
        let found = match (kind, above) {
            (Kind::Primary | Kind::Point, _) | (_, None) => self.timed(track, kind, findings),
            (Kind::Singleton, Some(above)) => self.singletons(track, above, findings),
            (Kind::Span, Some(above)) => self.spans(track, above, findings),
            (Kind::Subdivision, Some(above)) => self.parts(track, above, findings),
        };
        self.arrange(track, found, &mut placed, findings);
        placed
    }

    fn kind(&self, track: &Track<'_>, findings: &mut Findings) -> Kind {
        Kind::of(&track.kind).unwrap_or_else(|| {
            findings.add("tracks of unknown types", || {
                Finding::note(
                    self.document.line(track.at),
                    format!(
                        "the track {:?} is of the type {:?}, which is not known; its elements are read by their times",
                        track.name, track.kind
                    ),
                )
            });
            match track.elements.iter().all(|it| it.time.is_some()) && !track.elements.is_empty() {
                true => Kind::Point,
                false => Kind::Primary,
            }
        })
    }

    /// Returns the elements that have times of their own.
    fn timed(&self, track: &Track<'_>, kind: Kind, findings: &mut Findings) -> Vec<Found> {
        let mut all = Vec::with_capacity(track.elements.len());
        for (at, element) in track.elements.iter().enumerate() {
            let instant = |text: &Option<_>| {
                let text: &Option<Text<'_>> = text;
                text.as_deref().and_then(micros).map(Instant::from_micros)
            };
            let point = instant(&element.time).or(instant(&element.start));
            let times = instant(&element.start).zip(instant(&element.end));
            let time = match (kind, times, point) {
                (Kind::Point, _, Some(point)) => Timed::point(point),
                (_, Some((start, end)), _) => {
                    let line = || self.document.line(element.at);
                    Timed::between(start, end, (&track.name, line), findings)
                }
                (_, None, Some(point)) if element.time.is_some() => Timed::point(point),
                _ => {
                    self.lost(track, at, "has no time that can be read", findings);
                    continue;
                }
            };
            all.push(Found {
                element: at,
                time,
                timing: Timing::Own,
                parent: None,
            });
        }
        all
    }

    /// Reports an element that was left out.
    fn lost(&self, track: &Track<'_>, at: usize, why: &str, findings: &mut Findings) {
        findings.add("elements that were left out", || {
            let element = &track.elements[at];
            let index = element
                .index
                .as_deref()
                .map_or(at.to_string(), str::to_owned);
            Finding::warning(
                self.document.line(element.at),
                format!(
                    "element {index} of the track {:?} {why} and was left out",
                    track.name
                ),
            )
        });
    }

    /// Returns the element of a track that a text refers to, and its place.
    fn referred(&self, track: usize, index: Option<&str>) -> Option<(usize, Place)> {
        let placed = &self.placed[track];
        let element = *placed.index.get(index?.trim())?;
        Some((element, placed.places[element]?))
    }

    fn singletons(&self, track: &Track<'_>, above: usize, findings: &mut Findings) -> Vec<Found> {
        let mut all = Vec::with_capacity(track.elements.len());
        for (at, element) in track.elements.iter().enumerate() {
            let index = element.reference.as_deref().or(element.start.as_deref());
            let Some((parent, place)) = self.referred(above, index) else {
                self.lost(track, at, "refers to no element that was read", findings);
                continue;
            };
            all.push(Found {
                element: at,
                time: Timed {
                    span: place.span,
                    is_point: false,
                },
                timing: Timing::Parent,
                parent: Some(parent),
            });
        }
        all
    }

    fn spans(&self, track: &Track<'_>, above: usize, findings: &mut Findings) -> Vec<Found> {
        let covered = &self.placed[above];
        let mut all = Vec::with_capacity(track.elements.len());
        for (at, element) in track.elements.iter().enumerate() {
            let first = self.referred(above, element.start.as_deref());
            let last = self.referred(above, element.end.as_deref().or(element.start.as_deref()));
            let (Some((_, first)), Some((_, last))) = (first, last) else {
                self.lost(track, at, "refers to no element that was read", findings);
                continue;
            };
            let start = first.span.start().min(last.span.start());
            let end = match covered.is_point {
                true => first.span.start().max(last.span.start()),
                false => first.span.end().max(last.span.end()),
            };
            let line = || self.document.line(element.at);
            all.push(Found {
                element: at,
                time: Timed::between(start, end, (&track.name, line), findings),
                timing: Timing::Own,
                parent: None,
            });
        }
        if !all.is_empty() {
            findings.add("tracks of spans", || {
                Finding::note(
                    self.document.line(track.at),
                    format!(
                        "the elements of the track {:?} span those of {:?}: they have their times, and no link to them",
                        track.name, self.document.tracks[above].name
                    ),
                )
            });
        }
        all
    }

    /// Returns the elements of groups, which divide the time of the element that the group refers to.
    fn parts(&self, track: &Track<'_>, above: usize, findings: &mut Findings) -> Vec<Found> {
        let mut groups: Vec<(Option<&str>, Vec<usize>)> = track
            .groups
            .iter()
            .map(|reference| (reference.as_deref(), Vec::new()))
            .collect();
        let mut loose: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
        let mut all = Vec::with_capacity(track.elements.len());
        for (at, element) in track.elements.iter().enumerate() {
            match (element.group, element.reference.as_deref()) {
                (Some(group), _) => groups[group].1.push(at),
                (None, Some(reference)) => loose.entry(reference).or_default().push(at),
                (None, None) => {
                    self.lost(track, at, "refers to no element that was read", findings)
                }
            }
        }
        groups.extend(
            loose
                .into_iter()
                .map(|(reference, all)| (Some(reference), all)),
        );
        for (reference, elements) in groups {
            let Some((parent, place)) = self.referred(above, reference) else {
                for at in elements {
                    self.lost(track, at, "refers to no element that was read", findings);
                }
                continue;
            };
            let cuts = self.cuts(track, &elements, place.span, findings);
            for (part, element) in elements.into_iter().enumerate() {
                let [start, end] = [cuts[part], cuts[part + 1]];
                let timing = match (start.1, end.1) {
                    (true, true) => Timing::Own,
                    (start, end) => Timing::Proposed {
                        start: !start,
                        end: !end,
                    },
                };
                all.push(Found {
                    element,
                    time: Timed {
                        span: Span::between(start.0, end.0),
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
        track: &Track<'_>,
        elements: &[usize],
        whole: Span,
        findings: &mut Findings,
    ) -> Vec<(Instant, bool)> {
        let element = |part: usize| &track.elements[elements[part]];
        let many = elements.len();
        let instant = |text: Option<&str>| text.and_then(micros).map(Instant::from_micros);
        let mut cuts: Vec<Option<Instant>> = vec![None; many + 1];
        (cuts[0], cuts[many]) = (Some(whole.start()), Some(whole.end()));
        let mut last = whole.start();
        for (part, cut) in cuts.iter_mut().enumerate().take(many).skip(1) {
            let stated = instant(element(part).start.as_deref())
                .or(instant(element(part - 1).end.as_deref()));
            match stated {
                Some(stated) if stated > last && stated < whole.end() => {
                    *cut = Some(stated);
                    last = stated;
                }
                Some(stated) => findings.add("boundaries out of order", || {
                    Finding::warning(
                        self.document.line(element(part).at),
                        format!(
                            "the boundary at {stated} on the track {:?} is out of order; the elements beside it share their time evenly",
                            track.name
                        ),
                    )
                }),
                None => {}
            }
        }
        let mut at = 0;
        let mut whole = Vec::with_capacity(many + 1);
        while at <= many {
            let next = (at + 1..=many)
                .find(|next| cuts[*next].is_some())
                .unwrap_or(many + 1);
            let from = cuts[at].unwrap_or_default();
            let until = cuts.get(next).copied().flatten().unwrap_or(from);
            let length = i128::from(until.micros()) - i128::from(from.micros());
            for step in at..next {
                let share = length * (step - at) as i128 / (next - at) as i128;
                whole.push((from.shifted(share as i64), step == at));
            }
            at = next;
        }
        whole
    }

    /// Puts elements onto the tiers of a track.
    fn arrange(
        &self,
        track: &Track<'_>,
        found: Vec<Found>,
        placed: &mut Placed,
        findings: &mut Findings,
    ) {
        placed.places = vec![None; track.elements.len()];
        let mut times: Vec<Timed> = found.iter().map(|it| it.time).collect();
        let (of, crowded) = match placed.below {
            None => lanes(&mut times),
            Some((_, above)) => self.below(&found, above, placed),
        };
        if placed.below.is_none() {
            placed.lanes = vec![0; of.iter().max().map_or(1, |last| last + 1)];
        }
        let of_times: &[usize] = if placed.below.is_none() { &of } else { &[] };
        split(
            (&track.name, of_times, crowded),
            || self.document.line(track.at),
            findings,
        );
        let mut counts = vec![0; placed.lanes.len()];
        for ((it, lane), time) in found.into_iter().zip(of).zip(times) {
            placed.places[it.element] = Some(Place {
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
    fn below(&self, found: &[Found], above: usize, placed: &mut Placed) -> (Vec<usize>, u64) {
        let symbolic = !placed.is_alignable;
        let mut seen: HashMap<(usize, Instant), usize> = HashMap::new();
        let mut keys = Vec::with_capacity(found.len());
        let mut crowded = 0;
        for it in found {
            let parent = it.parent.unwrap_or_default();
            let lane = self.placed[above].places[parent].map_or(0, |place| place.lane);
            let start = if symbolic {
                Instant::ZERO
            } else {
                it.time.span.start()
            };
            let ordinal = seen.entry((parent, start)).or_default();
            crowded += u64::from(*ordinal >= LANES);
            keys.push(((*ordinal).min(LANES - 1), lane));
            *ordinal += 1;
        }
        let mut known: BTreeMap<(usize, usize), usize> = keys.iter().map(|key| (*key, 0)).collect();
        if known.is_empty() {
            known.insert((0, 0), 0);
        }
        for (number, (key, lane)) in known.iter_mut().enumerate() {
            *lane = number;
            placed.lanes.push(key.1);
        }
        (keys.iter().map(|key| known[key]).collect(), crowded)
    }
}
