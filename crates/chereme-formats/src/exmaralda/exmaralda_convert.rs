//! Converts a timeline and its events to tiers.

use super::exmaralda_raw::{ExmaraldaDocument, ExmaraldaTier as RawTier, TimelinePoint};
use crate::finding::ImportFinding;
use crate::markup::{
    TimedAnnotation, UniqueNames, arrange_tier_lanes, media_from_url, new_timed_annotation, parse_decimal_seconds,
    report_split_lanes, stable_annotation_id,
};
use crate::tally::FindingTally;
use crate::transcript::{AnnotationTiming, AnnotationTranscript, TranscriptTier};
use chereme_motion::RecordingInstant;
use std::collections::HashMap;

/// The distance of points if nothing states their times, in microseconds.
const UNTIMED_STEP_MICROS: i64 = 1_000_000;

/// Returns the meaning of a document.
pub(super) fn transcript_from_exmaralda(
    document: &ExmaraldaDocument<'_>,
) -> (AnnotationTranscript, Vec<ImportFinding>) {
    let mut findings = FindingTally::default();
    let times = timeline_point_times(document, &mut findings);
    let mut points: HashMap<&str, usize> = HashMap::new();
    for (at, point) in document.timeline.iter().enumerate() {
        points.entry(&point.id).or_insert(at);
    }
    let mut transcript = AnnotationTranscript {
        media: document.files.iter().map(|url| media_from_url(url.trim())).collect(),
        properties: document
            .properties
            .iter()
            .map(|(name, text)| (name.to_string(), text.trim().to_owned()))
            .collect(),
        ..AnnotationTranscript::default()
    };
    let (mut names, mut ids) = (UniqueNames::default(), UniqueNames::default());
    for tier in &document.tiers {
        let tiers = TranscriptionEvents {
            document,
            times: &times,
            points: &points,
        }
        .convert_event_tiers(tier, &mut names, &mut ids, &mut findings);
        transcript.tiers.extend(tiers);
    }
    (transcript, findings.finish_finding_tally())
}

/// The time of a point, and whether the file states it.
type TimelinePointTime = (RecordingInstant, bool);

/// Returns the time of each point; one without a time lies evenly between its neighbours.
fn timeline_point_times(document: &ExmaraldaDocument<'_>, findings: &mut FindingTally) -> Vec<TimelinePointTime> {
    let timeline = &document.timeline;
    let stated = |point: &TimelinePoint<'_>| {
        let text = point.time.as_deref().filter(|text| !text.trim().is_empty())?;
        Some((parse_decimal_seconds(text), text.to_owned()))
    };
    let mut point_times: Vec<Option<i64>> = Vec::with_capacity(timeline.len());
    let mut last = i64::MIN;
    for point in timeline {
        let time = match stated(point) {
            Some((None, text)) => {
                findings.add_limited_warning(
                    "times that are no numbers",
                    document.exmaralda_line_at(point.at),
                    || {
                        format!(
                            "the time {text:?} of the point {:?} is no number of seconds; it was left out",
                            point.id
                        )
                    },
                );
                None
            }
            Some((Some(time), _)) => Some(time),
            None => None,
        };
        if time.is_some_and(|time| time < last) {
            findings.add_limited_warning("points out of order", document.exmaralda_line_at(point.at), || {
                format!(
                    "the point {:?} of the timeline is earlier than the one before it",
                    point.id
                )
            });
        }
        // A point that is out of order must not make all later ones look so.
        last = last.max(time.unwrap_or(i64::MIN));
        point_times.push(time);
    }
    let missing = point_times.iter().filter(|time| time.is_none()).count();
    if missing > 0 && missing == point_times.len() {
        findings.push_counted_finding(
            ImportFinding::new_warning_finding(
                None,
                "no point of the timeline has a time: points lie a second apart now",
            )
            .with_remedy("align the transcription with its film in the Partitur Editor, and import it again"),
        );
    } else if missing > 0 {
        findings.push_note_finding(
            None,
            format!("points of the timeline without a time lie evenly between their neighbours: {missing}"),
        );
    }
    let mut all = Vec::with_capacity(point_times.len());
    let mut before: Option<i64> = None;
    let mut point_index = 0;
    while point_index < point_times.len() {
        if let Some(time) = point_times[point_index] {
            all.push((RecordingInstant::from_micros(time), true));
            before = Some(time);
            point_index += 1;
            continue;
        }
        let next = (point_index..point_times.len()).find(|next| point_times[*next].is_some());
        let until = next.unwrap_or(point_times.len());
        let many = (until - point_index) as i128;
        for step in 1..=many {
            let shared_time = match (before, next.and_then(|next| point_times[next])) {
                (Some(from), Some(to)) => i128::from(from) + (i128::from(to) - i128::from(from)) * step / (many + 1),
                (Some(from), None) => i128::from(from) + i128::from(UNTIMED_STEP_MICROS) * step,
                // Before the first known time there is only the time since the beginning to share.
                (None, Some(to)) => i128::from(to).max(0) * (step - 1) / many,
                (None, None) => i128::from(UNTIMED_STEP_MICROS) * (step - 1),
            };
            let time = i64::try_from(shared_time).unwrap_or(i64::MAX);
            all.push((RecordingInstant::from_micros(time), false));
        }
        point_index = until;
    }
    all
}

/// The events of a transcription and the times that they refer to.
struct TranscriptionEvents<'d> {
    document: &'d ExmaraldaDocument<'d>,
    times: &'d [TimelinePointTime],
    points: &'d HashMap<&'d str, usize>,
}

impl TranscriptionEvents<'_> {
    /// Returns the tier of a file, or several if events overlap.
    fn convert_event_tiers(
        &self,
        tier: &RawTier<'_>,
        names: &mut UniqueNames,
        ids: &mut UniqueNames,
        findings: &mut FindingTally,
    ) -> Vec<TranscriptTier> {
        let speaker = tier.speaker.as_deref().filter(|name| !name.is_empty());
        let participant = speaker.map(|id| {
            let of = self.document.speakers.iter().find(|(known, _)| *known == id);
            // The abbreviation is the name that stands on screen; the id is one of the file.
            let short = of
                .map(|(_, short)| short.trim())
                .filter(|abbreviation| !abbreviation.is_empty());
            short.unwrap_or(id).to_owned()
        });
        let category = tier.category.trim();
        let wanted = match (tier.name.as_deref().map(str::trim), &participant) {
            (Some(name), _) if !name.is_empty() => name.to_owned(),
            (_, Some(speaker)) => format!("{speaker} [{category}]"),
            (_, None) if !category.is_empty() => category.to_owned(),
            _ => tier.id.to_string(),
        };
        let mut placed_events = Vec::with_capacity(tier.events.len());
        for event in &tier.events {
            let time = |id: &str| self.points.get(id).map(|at| self.times[*at]);
            let (Some(start), Some(end)) = (time(&event.start), time(&event.end)) else {
                findings.add_limited_warning("events that were left out", self.document.exmaralda_line_at(event.at), || format!("the event {:?} of the tier {wanted:?} lies between points that the timeline does not have; it was left out", event.text));
                continue;
            };
            let line = || self.document.exmaralda_line_at(event.at);
            let time = TimedAnnotation::timed_between_instants(start.0, end.0, &wanted, line, findings);
            let timing = match (start.1, end.1) {
                (true, true) => AnnotationTiming::Own,
                (start, end) => AnnotationTiming::Proposed {
                    start: !start,
                    end: !end,
                },
            };
            placed_events.push((event, time, timing));
        }
        let mut times: Vec<TimedAnnotation> = placed_events.iter().map(|(_, time, _)| *time).collect();
        let (of, crowded) = arrange_tier_lanes(&mut times);
        report_split_lanes(
            &wanted,
            &of,
            crowded,
            || self.document.exmaralda_line_at(tier.at),
            findings,
        );
        let many = of.iter().max().map_or(1, |last| last + 1);
        let mut tiers: Vec<TranscriptTier> = (0..many)
            .map(|_| TranscriptTier {
                name: names.give_unique_name(&wanted),
                kind: category.to_owned(),
                participant: participant.clone(),
                ..TranscriptTier::default()
            })
            .collect();
        if tiers[0].name != wanted {
            findings.add_limited_finding("tiers of one name", || {
                let name = &tiers[0].name;
                ImportFinding::new_note_finding(
                    self.document.exmaralda_line_at(tier.at),
                    format!("another tier is called {wanted:?}, too; here it is {name:?}"),
                )
            });
        }
        for (((event, _, timing), lane), time) in placed_events.into_iter().zip(of).zip(times) {
            let tier = &mut tiers[lane];
            let id = ids.give_unique_id(&stable_annotation_id(&tier.name, time.span.span_start_instant()));
            let mut row = new_timed_annotation(id, time.span, &event.text);
            row.timing = timing;
            tier.annotations.push(row);
        }
        tiers
    }
}
