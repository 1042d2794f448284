//! Converts utterances to tiers.

use super::{SIGNSTREAM_TOOL, UTTERANCE_TIER_NAME};
use crate::markup::{
    MarkupContents, MarkupElement, MarkupError, TimedAnnotation, UniqueNames, arrange_tier_lanes, media_from_url,
    new_timed_annotation, parse_decimal_millis, report_split_lanes, stable_annotation_id,
};
use crate::tally::FindingTally;
use crate::transcript::{AnnotationTranscript, TranscriptTier};
use chereme_motion::RecordingInstant;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Returns what is read of an element.
pub(super) fn signstream_contents(parent: &str, element: &MarkupElement<'_>) -> Option<MarkupContents> {
    Some(match (parent, element.element_name()) {
        ("SIGNSTREAM-DATABASE", "AUTHOR") | ("TRACK", "A") => MarkupContents::Text,
        ("SIGNSTREAM-DATABASE", "PARTICIPANTS" | "CODING-SCHEME" | "MEDIA-FILES" | "UTTERANCES") => {
            MarkupContents::Elements
        }
        ("PARTICIPANTS" | "CODING-SCHEME" | "MEDIA-FILES", "FIELD") => MarkupContents::Elements,
        ("PARTICIPANTS" | "CODING-SCHEME" | "MEDIA-FILES", "PARTICIPANT" | "MEDIA-FILE") => MarkupContents::Attributes,
        ("UTTERANCES", "UTTERANCE") | ("UTTERANCE", "SEGMENT") | ("SEGMENT", "TRACK") => MarkupContents::Elements,
        ("FIELD", _) | ("UTTERANCE", "MEDIA-REF") => MarkupContents::Attributes,
        _ => return None,
    })
}

/// Returns the elements of this name in the lists before the utterances.
fn listed_elements<'t>(root: &'t MarkupElement<'t>, name: &str) -> Vec<&'t MarkupElement<'t>> {
    let lists = root.children.iter();
    lists.flat_map(|list| list.elements_at(&[name])).collect()
}

/// Returns the first of these attributes that is not blank.
fn first_stated<'t>(element: &'t MarkupElement<'t>, names: &[&str]) -> &'t str {
    let texts = names.iter().map(|name| element.attribute_text(name).trim());
    texts.into_iter().find(|text| !text.is_empty()).unwrap_or_default()
}

/// Returns the meaning of a collection.
///
/// # Errors
/// [`MarkupError`] if it holds no utterances, or they lie in different films.
pub(super) fn transcript_from_signstream(
    root: &MarkupElement<'_>,
    findings: &mut FindingTally,
) -> Result<AnnotationTranscript, MarkupError> {
    SIGNSTREAM_TOOL.check_child_element(root, "UTTERANCES")?;
    let utterances = root.elements_at(&["UTTERANCES", "UTTERANCE"]);
    let films = count_film_groups(&utterances);
    if films > 1 {
        return Err(MarkupError::Films { films });
    }
    let rows = SignstreamRows::new(root).collect_tier_rows(&utterances, findings);
    let files = listed_elements(root, "MEDIA-FILE");
    let paths = files
        .iter()
        .map(|file| first_stated(file, &["LEGACY-PATH", "PATH", "URL", "NAME"]));
    let authors = root.elements_at(&["AUTHOR"]);
    Ok(AnnotationTranscript {
        author: authors.last().map_or("", |author| author.text.trim()).to_owned(),
        media: paths
            .filter(|path| !path.is_empty())
            .map(|path| media_from_url(&convert_macintosh_path(path)))
            .collect(),
        tiers: build_signstream_tiers(root, rows, findings),
        ..AnnotationTranscript::default()
    })
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
fn count_film_groups(utterances: &[&MarkupElement<'_>]) -> usize {
    let mut groups: Vec<BTreeSet<&str>> = Vec::new();
    let mut of: HashMap<&str, usize> = HashMap::new();
    for utterance in utterances {
        let films = utterance.elements_at(&["MEDIA-REF"]).into_iter();
        let ids: BTreeSet<&str> = films.map(|film| film.attribute_text("ID").trim()).collect();
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
    /// The name of each field, and those of its values.
    fields: HashMap<&'d str, (&'d str, HashMap<&'d str, &'d str>)>,
    /// The tiers in the order in which they occur.
    keys: Vec<SignstreamTierKey<'d>>,
    rows: BTreeMap<SignstreamTierKey<'d>, Vec<SignstreamRow<'d>>>,
}

impl<'d> SignstreamRows<'d> {
    fn new(root: &'d MarkupElement<'d>) -> Self {
        let named = |element: &'d MarkupElement<'d>| {
            let text = |name| element.attribute_text(name).trim();
            (text("ID"), text("NAME"))
        };
        let field = |field: &'d MarkupElement<'d>| {
            let values = field.elements_at(&["VALUE"]).into_iter().map(named).collect();
            let (id, _) = named(field);
            (id, (field.attribute_text("NAME"), values))
        };
        Self {
            fields: listed_elements(root, "FIELD").into_iter().map(field).collect(),
            keys: Vec::new(),
            rows: BTreeMap::new(),
        }
    }

    fn collect_tier_rows(
        mut self,
        utterances: &[&'d MarkupElement<'d>],
        findings: &mut FindingTally,
    ) -> Vec<(SignstreamTierKey<'d>, Vec<SignstreamRow<'d>>)> {
        let times = |element: &MarkupElement<'_>| {
            let [start, end] = ["S", "E"].map(|name| parse_decimal_millis(element.attribute_text(name)));
            start.zip(end)
        };
        for utterance in utterances {
            let Some((start, end)) = times(utterance) else {
                report_untimed_annotation(utterance, utterance, findings);
                continue;
            };
            let utterance_time = TimedAnnotation::timed_between_instants(
                RecordingInstant::from_micros(start),
                RecordingInstant::from_micros(end),
                UTTERANCE_TIER_NAME,
                || utterance.element_line(),
                findings,
            );
            self.add_tier_row(
                ("", ""),
                SignstreamRow {
                    time: utterance_time,
                    value: utterance.attribute_text("ID"),
                },
            );
            for segment in utterance.elements_at(&["SEGMENT"]) {
                let participant = segment.attribute_text("PARTICIPANT-ID").trim();
                for track in segment.elements_at(&["TRACK"]) {
                    let field = track.attribute_text("FID");
                    for item in &track.children {
                        let Some((from, to)) = times(item) else {
                            report_untimed_annotation(utterance, item, findings);
                            continue;
                        };
                        // Times of items count from the start of their utterance.
                        let [from, to] =
                            [from, to].map(|offset| RecordingInstant::from_micros(start.saturating_add(offset)));
                        let name = self.fields.get(field.trim()).map_or("", |field| field.0);
                        let line = || item.element_line();
                        let time = TimedAnnotation::timed_between_instants(from, to, name, line, findings);
                        let value = self.signstream_item_text(field, item, findings);
                        self.add_tier_row((participant, field.trim()), SignstreamRow { time, value });
                    }
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

    /// Returns the text of an annotation, else the name of its value.
    fn signstream_item_text(&self, field: &str, item: &'d MarkupElement<'d>, findings: &mut FindingTally) -> &'d str {
        let text = item.text.trim();
        let value = item.stated_attribute("VID").map(str::trim);
        let Some(id) = value.filter(|_| text.is_empty()) else {
            return text;
        };
        let field_entry = self.fields.get(field.trim());
        match field_entry.and_then(|(_, values)| values.get(id)) {
            Some(name) => name,
            None => {
                findings.add_limited_warning("values that the coding scheme lacks", item.element_line(), || {
                    format!("the coding scheme has no value {id:?} of the field {field:?}; the number is kept")
                });
                id
            }
        }
    }
}

fn report_untimed_annotation(utterance: &MarkupElement<'_>, untimed: &MarkupElement<'_>, findings: &mut FindingTally) {
    findings.add_limited_warning("annotations without times", untimed.element_line(), || {
        format!(
            "an annotation of the utterance {:?} has no times in milliseconds; it was left out",
            utterance.attribute_text("ID")
        )
    });
}

fn build_signstream_tiers(
    root: &MarkupElement<'_>,
    rows: Vec<(SignstreamTierKey<'_>, Vec<SignstreamRow<'_>>)>,
    findings: &mut FindingTally,
) -> Vec<TranscriptTier> {
    let people: BTreeSet<&str> = rows.iter().map(|((person, _), _)| *person).collect();
    // Tiers name the person only where there is more than one.
    let several = people.iter().filter(|person| !person.is_empty()).count() > 1;
    let (mut names, mut ids) = (UniqueNames::default(), UniqueNames::default());
    let mut all = Vec::new();
    for ((person, field), rows) in rows {
        let named = |list: &str, wanted: &str, names: &[&str]| {
            let listed = listed_elements(root, list).into_iter();
            let mut matching = listed.filter(|listed| listed.attribute_text("ID").trim() == wanted);
            let name = first_stated(matching.next()?, names);
            Some(name.to_owned()).filter(|name| !name.is_empty())
        };
        let participant = named("PARTICIPANT", person, &["LABEL", "NAME"])
            .or_else(|| (!person.is_empty()).then(|| person.to_owned()));
        let field = match field {
            "" if person.is_empty() => UTTERANCE_TIER_NAME.to_owned(),
            id => named("FIELD", id, &["NAME"]).unwrap_or_else(|| format!("field {id}")),
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
