//! Converts tracks to tiers.

use super::ELEMENTS;
use super::place::{Placed, placed};
use super::raw::{Document, Element, Track};
use crate::eaf::convert::{AnnotationAddress, Media, Tier, Timing, Transcript};
use crate::finding::Finding;
use crate::markup::{Names, annotation, id, medium};
use crate::tally::Findings;
use crate::textgrid::POINTS;
use chereme_motion::Span;
use chereme_sign::Stereotype;
use std::collections::{BTreeMap, HashMap};

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
    let placed = placed(document, &mut findings);
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
