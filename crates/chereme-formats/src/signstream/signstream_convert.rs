//! Converts utterances to tiers.

use super::UTTERANCE_TIER_NAME;
use super::signstream_raw::{SignstreamDocument, SignstreamField, SignstreamItem, SignstreamText, SignstreamUtterance};
use crate::finding::ImportFinding;
use crate::markup::{
    MarkupError, TimedAnnotation, UniqueNames, arrange_tier_lanes, media_from_url, new_timed_annotation,
    parse_decimal_millis, report_split_lanes, stable_annotation_id,
};
use crate::tally::FindingTally;
use crate::transcript::{AnnotationTranscript, TranscriptTier};
use chereme_motion::RecordingInstant;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Returns the meaning of a document.
///
/// # Errors
/// [`Error::Films`] if its utterances lie in different films.
pub(super) fn interpret_signstream_document(
    document: &SignstreamDocument<'_>,
) -> Result<(AnnotationTranscript, Vec<ImportFinding>), MarkupError> {
    let films = count_film_groups(document);
    if films > 1 {
        return Err(MarkupError::Films { films });
    }
    let mut findings = FindingTally::default();
    let rows = SignstreamRows::new(document).collect_tier_rows(&mut findings);
    let transcript = AnnotationTranscript {
        author: document.author.trim().to_owned(),
        media: document
            .media
            .iter()
            .filter(|(_, path)| !path.trim().is_empty())
            .map(|(_, path)| media_from_url(&convert_macintosh_path(path.trim())))
            .collect(),
        tiers: build_signstream_tiers(document, rows, &mut findings),
        ..AnnotationTranscript::default()
    };
    Ok((transcript, findings.finish_finding_tally()))
}

/// Returns a path with slashes; paths of the classic Macintosh have colons between folders.
fn convert_macintosh_path(path: &str) -> String {
    let is_classic = !path.contains(['/', '\\']);
    if is_classic {
        path.replace(':', "/")
    } else {
        path.to_owned()
    }
}

/// Returns the number of groups of films that no utterance joins.
fn count_film_groups(document: &SignstreamDocument<'_>) -> usize {
    let mut groups: Vec<BTreeSet<&str>> = Vec::new();
    let mut of: HashMap<&str, usize> = HashMap::new();
    for utterance in &document.utterances {
        let ids: BTreeSet<&str> = utterance.media.iter().map(|id| id.trim()).collect();
        let joined: BTreeSet<usize> = ids.iter().filter_map(|id| of.get(id).copied()).collect();
        let mut merged_group = ids;
        for group in joined {
            merged_group.extend(std::mem::take(&mut groups[group]));
        }
        if !merged_group.is_empty() {
            of.extend(merged_group.iter().map(|id| (*id, groups.len())));
            groups.push(merged_group);
        }
    }
    groups.iter().filter(|group| !group.is_empty()).count()
}

/// A tier of the file: the participant and the field.
type SignstreamTierKey<'d> = (&'d str, &'d str);

/// An annotation of a tier.
struct SignstreamRow<'d> {
    time: TimedAnnotation,
    value: &'d str,
}

struct SignstreamRows<'d> {
    document: &'d SignstreamDocument<'d>,
    fields: HashMap<&'d str, (&'d SignstreamField<'d>, HashMap<&'d str, &'d str>)>,
    /// The tiers in the order in which they occur.
    keys: Vec<SignstreamTierKey<'d>>,
    rows: BTreeMap<SignstreamTierKey<'d>, Vec<SignstreamRow<'d>>>,
}

impl<'d> SignstreamRows<'d> {
    fn new(document: &'d SignstreamDocument<'d>) -> Self {
        let values = |field: &'d SignstreamField<'d>| {
            let all = field.values.iter();
            all.map(|(id, name)| (id.trim(), name.trim())).collect()
        };
        let fields = document.fields.iter();
        Self {
            document,
            fields: fields.map(|field| (field.id.trim(), (field, values(field)))).collect(),
            keys: Vec::new(),
            rows: BTreeMap::new(),
        }
    }

    fn collect_tier_rows(
        mut self,
        findings: &mut FindingTally,
    ) -> Vec<(SignstreamTierKey<'d>, Vec<SignstreamRow<'d>>)> {
        let document = self.document;
        for utterance in &document.utterances {
            let time = |text: &SignstreamText<'_>| parse_decimal_millis(text);
            let (Some(start), Some(end)) = (time(&utterance.start), time(&utterance.end)) else {
                self.report_untimed_annotation(utterance, utterance.at, findings);
                continue;
            };
            let line = || document.signstream_line_at(utterance.at);
            let utterance_time = TimedAnnotation::timed_between_instants(
                instant_from_micros(start),
                instant_from_micros(end),
                UTTERANCE_TIER_NAME,
                line,
                findings,
            );
            self.add_tier_row(
                ("", ""),
                SignstreamRow {
                    time: utterance_time,
                    value: &utterance.id,
                },
            );
            for track in &utterance.tracks {
                for item in &track.items {
                    let (Some(from), Some(to)) = (time(&item.start), time(&item.end)) else {
                        self.report_untimed_annotation(utterance, item.at, findings);
                        continue;
                    };
                    let line = || document.signstream_line_at(item.at);
                    // Times of items count from the start of their utterance.
                    let [from, to] = [from, to].map(|offset| instant_from_micros(start.saturating_add(offset)));
                    let name = self.fields.get(track.field.trim()).map_or("", |field| &field.0.name);
                    let time = TimedAnnotation::timed_between_instants(from, to, name, line, findings);
                    let value = self.signstream_item_text(&track.field, item, findings);
                    self.add_tier_row(
                        (track.participant.trim(), track.field.trim()),
                        SignstreamRow { time, value },
                    );
                }
            }
        }
        let mut rows = self.rows;
        let keys = self.keys.into_iter();
        keys.filter_map(|key| Some((key, rows.remove(&key)?))).collect()
    }

    fn add_tier_row(&mut self, key: SignstreamTierKey<'d>, row: SignstreamRow<'d>) {
        let rows = self.rows.entry(key).or_insert_with(|| {
            self.keys.push(key);
            Vec::new()
        });
        rows.push(row);
    }

    fn report_untimed_annotation(&self, utterance: &SignstreamUtterance<'_>, at: usize, findings: &mut FindingTally) {
        findings.add_limited_warning(
            "annotations without times",
            self.document.signstream_line_at(at),
            || {
                format!(
                    "an annotation of the utterance {:?} has no times in milliseconds; it was left out",
                    utterance.id
                )
            },
        );
    }

    /// Returns the text of an annotation, else the name of its value.
    fn signstream_item_text(
        &self,
        field: &'d SignstreamText<'d>,
        item: &'d SignstreamItem<'d>,
        findings: &mut FindingTally,
    ) -> &'d str {
        let text = item.text.trim();
        let Some(id) = item.value.as_deref().map(str::trim).filter(|_| text.is_empty()) else {
            return text;
        };
        let field_entry = self.fields.get(field.trim());
        match field_entry.and_then(|(_, values)| values.get(id)) {
            Some(name) => name,
            None => {
                findings.add_limited_warning(
                    "values that the coding scheme lacks",
                    self.document.signstream_line_at(item.at),
                    || format!("the coding scheme has no value {id:?} of the field {field:?}; the number is kept"),
                );
                id
            }
        }
    }
}

fn instant_from_micros(micros: i64) -> RecordingInstant {
    RecordingInstant::from_micros(micros)
}

fn build_signstream_tiers(
    document: &SignstreamDocument<'_>,
    rows: Vec<(SignstreamTierKey<'_>, Vec<SignstreamRow<'_>>)>,
    findings: &mut FindingTally,
) -> Vec<TranscriptTier> {
    let people: BTreeSet<&str> = rows.iter().map(|((person, _), _)| *person).collect();
    // Tiers name the person only where there is more than one.
    let several = people.iter().filter(|person| !person.is_empty()).count() > 1;
    let (mut names, mut ids) = (UniqueNames::default(), UniqueNames::default());
    let mut all = Vec::new();
    for ((person, field), rows) in rows {
        let named = |list: &[(SignstreamText<'_>, SignstreamText<'_>)], wanted: &str| {
            let list_entry = list.iter().find(|(id, _)| id.trim() == wanted);
            list_entry
                .map(|(_, name)| name.trim().to_owned())
                .filter(|name| !name.is_empty())
        };
        let participant =
            named(&document.participants, person).or_else(|| (!person.is_empty()).then(|| person.to_owned()));
        let field = match field {
            "" if person.is_empty() => UTTERANCE_TIER_NAME.to_owned(),
            id => {
                let matched_field = document.fields.iter().find(|field| field.id.trim() == id);
                let name = matched_field
                    .map(|field| field.name.trim())
                    .filter(|name| !name.is_empty());
                name.map_or_else(|| format!("field {id}"), str::to_owned)
            }
        };
        let wanted = match &participant {
            Some(person) if several => format!("{person} {field}"),
            _ => field.clone(),
        };
        let mut times: Vec<TimedAnnotation> = rows.iter().map(|row| row.time).collect();
        let (of, crowded) = arrange_tier_lanes(&mut times);
        report_split_lanes(&wanted, &of, crowded, || 1, findings);
        let first = all.len();
        all.extend((0..=of.iter().max().copied().unwrap_or(0)).map(|_| TranscriptTier {
            name: names.give_unique_name(&wanted),
            kind: field.clone(),
            participant: participant.clone(),
            ..TranscriptTier::default()
        }));
        for ((row, lane), time) in rows.into_iter().zip(of).zip(times) {
            let tier = &mut all[first + lane];
            let id = ids.give_unique_id(&stable_annotation_id(&tier.name, time.span.span_start_instant()));
            tier.annotations.push(new_timed_annotation(id, time.span, row.value));
        }
    }
    all
}
