//! Converts tracks to tiers.

use super::ELEMENTS;
use super::raw::{Document, Element, Track};
use crate::eaf::convert::{AnnotationAddress, Media, Tier, Timing, Transcript};
use crate::finding::Finding;
use crate::markup::{LANES, Names, Timed, annotation, id, lanes, medium, micros, split};
use crate::tally::Findings;
use crate::textgrid::POINTS;
use chereme_motion::{Instant, Span};
use chereme_sign::Stereotype;
use std::collections::{BTreeMap, HashMap};

/// The deepest nesting of tiers that references make; tracks below become root tiers.
const DEPTH: usize = 32;

/// Returns the meaning of a document.
pub(super) fn from_raw(document: &Document<'_>) -> (Transcript, Vec<Finding>) {
    let mut findings = Findings::default();
    let mut transcript = Transcript {
        media: media(document, &mut findings),
        properties: document
            .infos
            .iter()
            .map(|(key, text)| (key.to_string(), text.to_string()))
            .collect(),
        ..Transcript::default()
    };
    if let Some(specification) = &document.specification {
        findings.push(Finding::note(
            None,
            format!(
                "the specification {specification:?} is another file and is not read; values are those of the elements"
            ),
        ));
    }
    for (name, many) in &document.sets {
        findings.add("sets", || {
            Finding::warning(
                None,
                format!("the set {name:?} has no times; its {many} elements were left out"),
            )
        });
    }
    let mut placing = Placing::new(document);
    for track in 0..document.tracks.len() {
        placing.resolve(track, &mut findings);
    }
    let placed = placing.placed;
    let coder = ["coder", "annotator"].iter().find_map(|wanted| {
        let is =
            |(key, text): &&(String, String)| key.eq_ignore_ascii_case(wanted) && !text.is_empty();
        transcript.properties.iter().find(is)
    });
    let mut tiers = Tiers {
        document,
        annotator: coder.map(|(_, name)| name.clone()),
        names: Names::default(),
        ids: Names::default(),
        links: 0,
        mains: Vec::new(),
        tiers: Vec::new(),
    };
    for (track, placed) in document.tracks.iter().zip(&placed) {
        tiers.track(track, placed, &mut findings);
    }
    tiers.finish(&placed, &mut findings);
    transcript.tiers = tiers.tiers;
    (transcript, findings.finish())
}

fn media(document: &Document<'_>, findings: &mut Findings) -> Vec<Media> {
    let mut media = Vec::new();
    for (name, source) in &document.media {
        if ["video", "audio", "media"].contains(name) {
            if !source.trim().is_empty() {
                media.push(medium(source.trim()));
            }
        } else {
            findings.add("other files of the head", || {
                Finding::note(
                    None,
                    format!("the head names {source:?}, too (<{name}>); import it by itself"),
                )
            });
        }
    }
    media
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
struct Placed {
    /// The relation to the track above, and that track.
    below: Option<(Stereotype, usize)>,
    /// The number of tracks above.
    depth: usize,
    /// Whether its elements have times of their own.
    is_alignable: bool,
    is_point: bool,
    /// Its elements by their indices.
    index: HashMap<String, usize>,
    /// The place of each element; nothing for one that was left out.
    places: Vec<Option<Place>>,
    /// For each lane that of the track above.
    lanes: Vec<usize>,
}

#[derive(Debug, Clone, Copy)]
struct Place {
    span: Span,
    timing: Timing,
    /// The element above.
    parent: Option<usize>,
    /// The tier, if elements of the track lie on several.
    lane: usize,
    /// The place among the annotations of that tier.
    at: usize,
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
        let mut seen = std::collections::BTreeSet::from([track]);
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
                let text: &Option<super::raw::Text<'_>> = text;
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
                    self.lost(track, at, "has no time", findings);
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
        for part in 1..many {
            let stated = instant(element(part).start.as_deref())
                .or(instant(element(part - 1).end.as_deref()));
            match stated {
                Some(stated) if stated > last && stated < whole.end() => {
                    cuts[part] = Some(stated);
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

/// Builds tiers of placed tracks.
struct Tiers<'d> {
    document: &'d Document<'d>,
    annotator: Option<String>,
    names: Names,
    ids: Names,
    links: u64,
    /// For each track its tiers, one for each lane.
    mains: Vec<Vec<usize>>,
    tiers: Vec<Tier>,
}

impl Tiers<'_> {
    fn track(&mut self, track: &Track<'_>, placed: &Placed, findings: &mut Findings) {
        let mut attributes: Vec<&str> = Vec::new();
        let mut known: HashMap<&str, usize> = HashMap::new();
        for attribute in track.elements.iter().flat_map(|it| &it.attributes) {
            known.entry(&attribute.name).or_insert_with(|| {
                attributes.push(&attribute.name);
                attributes.len() - 1
            });
        }
        let commented = track.elements.iter().any(|it| it.comment.is_some());
        let single = attributes.len() < 2;
        let kind = match (placed.is_point, single, attributes.first()) {
            (true, ..) => POINTS,
            (_, true, Some(one)) => one,
            (_, true, None) => "",
            _ => ELEMENTS,
        };
        let wanted = match track.name.trim() {
            "" => format!("track {}", self.tiers.len() + 1),
            name => name.to_owned(),
        };
        let mut mains = Vec::with_capacity(placed.lanes.len());
        for lane in 0..placed.lanes.len() {
            let main = self.tiers.len();
            mains.push(main);
            let name = self.names.unique(&wanted);
            if lane == 0 && name != wanted {
                findings.add("tiers of one name", || {
                    Finding::note(
                        self.document.line(track.at),
                        format!(
                            "another tier is called {:?}, too; here it is {name:?}",
                            track.name
                        ),
                    )
                });
            }
            self.tiers.push(Tier {
                name: name.clone(),
                kind: kind.to_owned(),
                stereotype: placed.below.map(|(stereotype, _)| stereotype),
                annotator: self.annotator.clone(),
                ..Tier::default()
            });
            let mut columns = vec![Vec::new(); attributes.len()];
            let mut comments = Vec::new();
            for (element, place) in track.elements.iter().zip(&placed.places) {
                let Some(place) = place.filter(|place| place.lane == lane) else {
                    continue;
                };
                let values = self.values(track, element, &known, findings);
                let own = values.first().filter(|_| single);
                let value = own.map_or("", |(_, value)| value);
                let start = place.span.start();
                let id = self.ids.id(&id(&name, start));
                let address = AnnotationAddress {
                    tier: main,
                    index: place.at,
                };
                for (column, value) in values.iter().filter(|(_, it)| !single && !it.is_empty()) {
                    columns[*column].push((address, place.span, value.clone()));
                }
                if let Some(comment) = &element.comment {
                    comments.push((address, place.span, comment.to_string()));
                }
                let mut row = annotation(id, place.span, value);
                row.timing = place.timing;
                self.tiers[main].annotations.push(row);
            }
            for (attribute, column) in attributes.iter().zip(columns) {
                self.child(&name, attribute, column);
            }
            if commented {
                self.child(&name, "comment", comments);
            }
        }
        self.mains.push(mains);
    }

    /// Adds the tier of an attribute, unless it has no values.
    fn child(&mut self, above: &str, kind: &str, rows: Vec<(AnnotationAddress, Span, String)>) {
        let Some((first, _, _)) = rows.first() else {
            return;
        };
        let parent = first.tier;
        let name = self.names.unique(&format!("{above}.{kind}"));
        let mut annotations = Vec::with_capacity(rows.len());
        for (address, span, value) in rows {
            let mut row = annotation(self.ids.id(&id(&name, span.start())), span, &value);
            (row.timing, row.parent) = (Timing::Parent, Some(address));
            annotations.push(row);
        }
        self.tiers.push(Tier {
            name,
            kind: kind.to_owned(),
            parent: Some(parent),
            stereotype: Some(Stereotype::SymbolicAssociation),
            annotator: self.annotator.clone(),
            annotations,
            ..Tier::default()
        });
    }

    /// Returns the values of an element, each with the number of its attribute.
    fn values(
        &mut self,
        track: &Track<'_>,
        element: &Element<'_>,
        known: &HashMap<&str, usize>,
        findings: &mut Findings,
    ) -> Vec<(usize, String)> {
        let mut values: BTreeMap<usize, String> = BTreeMap::new();
        for attribute in &element.attributes {
            let mut value = attribute.text.to_string();
            for (track, index) in &attribute.links {
                let between = if value.is_empty() { "" } else { ", " };
                value.push_str(&format!("{between}{track} {index}"));
            }
            self.links += attribute.links.len() as u64;
            let number = known[&*attribute.name];
            if let Some(before) = values.get_mut(&number) {
                before.push_str("; ");
                before.push_str(&value);
                findings.add("attributes twice", || {
                    Finding::warning(
                        self.document.line(element.at),
                        format!(
                            "an element of the track {:?} has the attribute {:?} twice; both values are kept",
                            track.name, attribute.name
                        ),
                    )
                });
            } else {
                values.insert(number, value);
            }
        }
        values.into_iter().collect()
    }

    /// Links the tiers of tracks that refer to others, once all tiers are there.
    fn finish(&mut self, placed: &[Placed], findings: &mut Findings) {
        if self.links > 0 {
            findings.push(Finding::note(
                None,
                format!(
                    "links to other elements are kept as texts, the track and the index: {}",
                    self.links
                ),
            ));
        }
        for (track, own) in placed.iter().enumerate() {
            let Some((_, above)) = own.below else {
                continue;
            };
            for (main, lane) in self.mains[track].iter().zip(&own.lanes) {
                self.tiers[*main].parent = Some(self.mains[above][*lane]);
            }
            for place in own.places.iter().flatten() {
                let parent = place.parent.and_then(|it| placed[above].places[it]);
                let address = parent.map(|it| AnnotationAddress {
                    tier: self.mains[above][it.lane],
                    index: it.at,
                });
                let main = self.mains[track][place.lane];
                self.tiers[main].annotations[place.at].parent = address;
            }
        }
    }
}
