//! Converts a timeline and its events to tiers.

use crate::finding::ImportFinding;
use crate::markup::{
    MarkupContents, MarkupElement, TimedAnnotation, UniqueNames, arrange_tier_lanes, media_from_url,
    new_timed_annotation, parse_decimal_seconds, report_split_lanes, stable_annotation_id,
};
use crate::tally::FindingTally;
use crate::transcript::{AnnotationTiming, AnnotationTranscript, TranscriptTier};
use chereme_motion::RecordingInstant;
use std::collections::HashMap;

/// The distance of points if nothing states their times, in microseconds.
const UNTIMED_STEP_MICROS: i64 = 1_000_000;

/// Returns what is read of an element.
pub(super) fn exmaralda_contents(parent: &str, element: &MarkupElement<'_>) -> Option<MarkupContents> {
    Some(match (parent, element.element_name()) {
        ("basic-transcription", "head" | "basic-body" | "body") => MarkupContents::Elements,
        ("head", "meta-information" | "speakertable") => MarkupContents::Elements,
        ("meta-information", "ud-meta-information") | ("speakertable", "speaker") => MarkupContents::Elements,
        ("basic-body" | "body", "common-timeline" | "tier") => MarkupContents::Elements,
        ("basic-transcription", "tierformat-table") | ("meta-information", "referenced-file") => {
            MarkupContents::Attributes
        }
        ("meta-information" | "ud-meta-information", _) | ("speaker", "abbreviation") => MarkupContents::Text,
        // Ages, languages and the like of people have no place in a transcript.
        ("speaker" | "common-timeline", _) => MarkupContents::Attributes,
        ("tier", "event") => MarkupContents::TextWithElements,
        _ => return None,
    })
}

/// Returns the meaning of a basic transcription.
pub(super) fn transcript_from_exmaralda(root: &MarkupElement<'_>, findings: &mut FindingTally) -> AnnotationTranscript {
    let bodies = root
        .children
        .iter()
        .filter(|child| child.element_name().ends_with("body"));
    let in_bodies = |path: &[&str]| bodies.clone().flat_map(|body| body.elements_at(path)).collect();
    let timeline: Vec<&MarkupElement<'_>> = in_bodies(&["common-timeline", "tli"]);
    let tiers: Vec<&MarkupElement<'_>> = in_bodies(&["tier"]);
    let times = timeline_point_times(&timeline, findings);
    let mut points: HashMap<&str, usize> = HashMap::new();
    for (at, point) in timeline.iter().enumerate() {
        points.entry(point.attribute_text("id")).or_insert(at);
    }
    let files = root.elements_at(&["head", "meta-information", "referenced-file"]);
    let urls = files.iter().map(|file| file.attribute_text("url").trim());
    let mut transcript = AnnotationTranscript {
        media: urls.filter(|url| !url.is_empty()).map(media_from_url).collect(),
        properties: transcription_properties(root),
        ..AnnotationTranscript::default()
    };
    let (mut names, mut ids) = (UniqueNames::default(), UniqueNames::default());
    let events = TranscriptionEvents {
        speakers: &root.elements_at(&["head", "speakertable", "speaker"]),
        times: &times,
        points: &points,
    };
    for tier in tiers {
        let tiers = events.convert_event_tiers(tier, &mut names, &mut ids, findings);
        transcript.tiers.extend(tiers);
    }
    transcript
}

/// Returns what the head says about the transcription; the user's own entries name themselves in an attribute.
fn transcription_properties(root: &MarkupElement<'_>) -> Vec<(String, String)> {
    let heads = root.elements_at(&["head", "meta-information"]);
    let entries = heads.into_iter().flat_map(|about| &about.children);
    let named = entries.flat_map(|entry| match entry.element_name() {
        "ud-meta-information" => {
            let own = entry.children.iter();
            own.map(|own| (own.attribute_text("attribute-name"), own)).collect()
        }
        name => vec![(name, entry)],
    });
    let stated = named.filter(|(_, entry)| !entry.text.trim().is_empty());
    stated
        .map(|(name, entry)| (name.to_owned(), entry.text.trim().to_owned()))
        .collect()
}

/// The time of a point, and whether the file states it.
type TimelinePointTime = (RecordingInstant, bool);

/// Returns the time of each point; one without a time lies evenly between its neighbours.
fn timeline_point_times(timeline: &[&MarkupElement<'_>], findings: &mut FindingTally) -> Vec<TimelinePointTime> {
    let stated = |point: &MarkupElement<'_>| {
        let text = point.stated_attribute("time").filter(|text| !text.trim().is_empty())?;
        Some((parse_decimal_seconds(text), text.to_owned()))
    };
    let mut point_times: Vec<Option<i64>> = Vec::with_capacity(timeline.len());
    let mut last = i64::MIN;
    for point in timeline {
        let time = match stated(point) {
            Some((None, text)) => {
                findings.add_limited_warning("times that are no numbers", point.element_line(), || {
                    format!(
                        "the time {text:?} of the point {:?} is no number of seconds; it was left out",
                        point.attribute_text("id")
                    )
                });
                None
            }
            Some((Some(time), _)) => Some(time),
            None => None,
        };
        if time.is_some_and(|time| time < last) {
            findings.add_limited_warning("points out of order", point.element_line(), || {
                format!(
                    "the point {:?} of the timeline is earlier than the one before it",
                    point.attribute_text("id")
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
    speakers: &'d [&'d MarkupElement<'d>],
    times: &'d [TimelinePointTime],
    points: &'d HashMap<&'d str, usize>,
}

impl TranscriptionEvents<'_> {
    /// Returns the tier of a file, or several if events overlap.
    fn convert_event_tiers(
        &self,
        tier: &MarkupElement<'_>,
        names: &mut UniqueNames,
        ids: &mut UniqueNames,
        findings: &mut FindingTally,
    ) -> Vec<TranscriptTier> {
        let speaker = tier.stated_attribute("speaker").filter(|name| !name.is_empty());
        let participant = speaker.map(|id| {
            let of = self.speakers.iter().find(|known| known.attribute_text("id") == id);
            let shorts = of.map(|of| of.elements_at(&["abbreviation"])).unwrap_or_default();
            // The abbreviation is the name that stands on screen; the id is one of the file.
            let short = shorts.last().map(|short| short.text.trim());
            short
                .filter(|abbreviation| !abbreviation.is_empty())
                .unwrap_or(id)
                .to_owned()
        });
        let category = tier.attribute_text("category").trim();
        let wanted = match (tier.attribute_text("display-name").trim(), &participant) {
            (name, _) if !name.is_empty() => name.to_owned(),
            (_, Some(speaker)) => format!("{speaker} [{category}]"),
            (_, None) if !category.is_empty() => category.to_owned(),
            _ => tier.attribute_text("id").to_owned(),
        };
        let mut placed_events = Vec::with_capacity(tier.children.len());
        for event in &tier.children {
            let time = |id: &str| self.points.get(id).map(|at| self.times[*at]);
            let (Some(start), Some(end)) = (time(event.attribute_text("start")), time(event.attribute_text("end")))
            else {
                findings.add_limited_warning("events that were left out", event.element_line(), || format!("the event {:?} of the tier {wanted:?} lies between points that the timeline does not have; it was left out", event.text));
                continue;
            };
            let line = || event.element_line();
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
        report_split_lanes(&wanted, &of, crowded, || tier.element_line(), findings);
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
                    tier.element_line(),
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
