//! Converts a timeline and its events to tiers.

use super::raw::{Document, Point, Tier as RawTier};
use crate::eaf::convert::{Tier, Timing, Transcript};
use crate::finding::Finding;
use crate::markup::{Names, Timed, annotation, id, lanes, medium, micros, split};
use crate::tally::Findings;
use chereme_motion::Instant;
use std::collections::HashMap;

/// The distance of points if nothing states their times, in microseconds.
const APART: i64 = 1_000_000;

/// Returns the meaning of a document.
pub(super) fn from_raw(document: &Document<'_>) -> (Transcript, Vec<Finding>) {
    let mut findings = Findings::default();
    let times = times(document, &mut findings);
    let mut points: HashMap<&str, usize> = HashMap::new();
    for (at, point) in document.timeline.iter().enumerate() {
        points.entry(&point.id).or_insert(at);
    }
    let mut transcript = Transcript {
        media: document
            .files
            .iter()
            .map(|url| medium(url.trim()))
            .collect(),
        properties: document
            .properties
            .iter()
            .map(|(name, text)| (name.to_string(), text.trim().to_owned()))
            .collect(),
        ..Transcript::default()
    };
    let (mut names, mut ids) = (Names::default(), Names::default());
    for tier in &document.tiers {
        let tiers = Events {
            document,
            times: &times,
            points: &points,
        }
        .tiers(tier, (&mut names, &mut ids), &mut findings);
        transcript.tiers.extend(tiers);
    }
    (transcript, findings.finish())
}

/// The time of a point, and whether the file states it.
type Time = (Instant, bool);

/// Returns the time of each point; one without a time lies evenly between its neighbours.
fn times(document: &Document<'_>, findings: &mut Findings) -> Vec<Time> {
    let timeline = &document.timeline;
    let stated = |point: &Point<'_>| {
        let text = point
            .time
            .as_deref()
            .filter(|text| !text.trim().is_empty())?;
        Some((micros(text), text.to_owned()))
    };
    let mut known: Vec<Option<i64>> = Vec::with_capacity(timeline.len());
    let mut last = i64::MIN;
    for point in timeline {
        let time = match stated(point) {
            Some((None, text)) => {
                findings.add("times that are no numbers", || {
                    Finding::warning(
                        document.line(point.at),
                        format!("the time {text:?} of the point {:?} is no number of seconds; it was left out", point.id),
                    )
                });
                None
            }
            Some((Some(time), _)) => Some(time),
            None => None,
        };
        if time.is_some_and(|time| time < last) {
            findings.add("points out of order", || {
                Finding::warning(
                    document.line(point.at),
                    format!(
                        "the point {:?} of the timeline is earlier than the one before it",
                        point.id
                    ),
                )
            });
        }
        last = last.max(time.unwrap_or(i64::MIN));
        known.push(time);
    }
    let missing = known.iter().filter(|time| time.is_none()).count();
    if missing > 0 && missing == known.len() {
        findings.push(
            Finding::warning(
                None,
                "no point of the timeline has a time: points lie a second apart now",
            )
            .with_remedy(
                "align the transcription with its film in the Partitur Editor, and import it again",
            ),
        );
    } else if missing > 0 {
        findings.push(Finding::note(
            None,
            format!("points of the timeline without a time lie evenly between their neighbours: {missing}"),
        ));
    }
    let mut all = Vec::with_capacity(known.len());
    let mut before: Option<i64> = None;
    let mut at = 0;
    while at < known.len() {
        if let Some(time) = known[at] {
            all.push((Instant::from_micros(time), true));
            before = Some(time);
            at += 1;
            continue;
        }
        let next = (at..known.len()).find(|next| known[*next].is_some());
        let until = next.unwrap_or(known.len());
        let many = (until - at) as i128;
        for step in 1..=many {
            let time = match (before, next.and_then(|next| known[next])) {
                (Some(from), Some(to)) => {
                    i128::from(from) + (i128::from(to) - i128::from(from)) * step / (many + 1)
                }
                (Some(from), None) => i128::from(from) + i128::from(APART) * step,
                (None, Some(to)) => i128::from(to).max(0) * (step - 1) / many,
                (None, None) => i128::from(APART) * (step - 1),
            };
            let time = i64::try_from(time).unwrap_or(i64::MAX);
            all.push((Instant::from_micros(time), false));
        }
        at = until;
    }
    all
}

/// The events of a transcription and the times that they refer to.
struct Events<'d> {
    document: &'d Document<'d>,
    times: &'d [Time],
    points: &'d HashMap<&'d str, usize>,
}

impl Events<'_> {
    /// Returns the tier of a file, or several if events overlap.
    fn tiers(
        &self,
        tier: &RawTier<'_>,
        (names, ids): (&mut Names, &mut Names),
        findings: &mut Findings,
    ) -> Vec<Tier> {
        let speaker = tier.speaker.as_deref().filter(|it| !it.is_empty());
        let participant = speaker.map(|id| {
            let of = self
                .document
                .speakers
                .iter()
                .find(|(known, _)| *known == id);
            let short = of
                .map(|(_, short)| short.trim())
                .filter(|it| !it.is_empty());
            short.unwrap_or(id).to_owned()
        });
        let category = tier.category.trim();
        let wanted = match (tier.name.as_deref().map(str::trim), &participant) {
            (Some(name), _) if !name.is_empty() => name.to_owned(),
            (_, Some(speaker)) => format!("{speaker} [{category}]"),
            (_, None) if !category.is_empty() => category.to_owned(),
            _ => tier.id.to_string(),
        };
        let mut found = Vec::with_capacity(tier.events.len());
        for event in &tier.events {
            let time = |id: &str| self.points.get(id).map(|at| self.times[*at]);
            let (Some(start), Some(end)) = (time(&event.start), time(&event.end)) else {
                findings.add("events that were left out", || {
                    Finding::warning(
                        self.document.line(event.at),
                        format!("the event {:?} of the tier {wanted:?} lies between points that the timeline does not have; it was left out", event.text),
                    )
                });
                continue;
            };
            let line = || self.document.line(event.at);
            let time = Timed::between(start.0, end.0, (&wanted, line), findings);
            let timing = match (start.1, end.1) {
                (true, true) => Timing::Own,
                (start, end) => Timing::Proposed {
                    start: !start,
                    end: !end,
                },
            };
            found.push((event, time, timing));
        }
        let mut times: Vec<Timed> = found.iter().map(|(_, time, _)| *time).collect();
        let (of, crowded) = lanes(&mut times);
        split(
            (&wanted, &of, crowded),
            || self.document.line(tier.at),
            findings,
        );
        let many = of.iter().max().map_or(1, |last| last + 1);
        let mut tiers: Vec<Tier> = (0..many)
            .map(|_| Tier {
                name: names.unique(&wanted),
                kind: category.to_owned(),
                participant: participant.clone(),
                ..Tier::default()
            })
            .collect();
        if tiers[0].name != wanted {
            findings.add("tiers of one name", || {
                let name = &tiers[0].name;
                Finding::note(
                    self.document.line(tier.at),
                    format!("another tier is called {wanted:?}, too; here it is {name:?}"),
                )
            });
        }
        for (((event, _, timing), lane), time) in found.into_iter().zip(of).zip(times) {
            let tier = &mut tiers[lane];
            let id = ids.id(&id(&tier.name, time.span.start()));
            let mut row = annotation(id, time.span, &event.text);
            row.timing = timing;
            tier.annotations.push(row);
        }
        tiers
    }
}
