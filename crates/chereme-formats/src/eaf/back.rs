//! Converts a transcript to a raw document.

use super::convert::annotation_number;
use super::model::{Annotation, AnnotationAddress, Media, Tier, Timing, Transcript, Vocabulary};
use super::raw::{self, Anchor, At, Document, Text};
use chereme_motion::Instant;
use chereme_sign::Stereotype;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Returns `transcript` as a document of EAF 3.0.
///
/// Everything that a transcript doesn't hold (licences, languages, locales, lexicon and external references, links
/// between annotations) comes from `template`, for example the document that the transcript was read from;
/// [`Document::default`] gives no such parts. Children of a Time_Subdivision share time slots with each other and with
/// their parent; ends within one that were never set stay unset; elsewhere ELAN requires times, and they get the values
/// from reading. `lastUsedAnnotationId` is computed again and comes last.
#[must_use]
pub fn to_raw<'a>(transcript: &Transcript, template: &Document<'a>) -> Document<'a> {
    let mut document = Document {
        author: transcript.author.clone().into(),
        date: transcript.date.clone().into(),
        licenses: template.licenses.clone(),
        locales: template.locales.clone(),
        languages: template.languages.clone(),
        lexicon_refs: template.lexicon_refs.clone(),
        ref_link_sets: template.ref_link_sets.clone(),
        external_refs: template.external_refs.clone(),
        header: header(transcript, &template.header),
        kept: template.kept.clone(),
        ..Document::default()
    };
    for vocabulary in &template.vocabularies {
        document
            .external_refs
            .extend(vocabulary.external_refs.iter().cloned());
    }
    document.vocabularies = transcript
        .vocabularies
        .iter()
        .map(|it| vocabulary(it, &mut document.external_refs))
        .collect();
    let mut kinds = Kinds::new(template);
    let slots = Slots::new(transcript);
    let known: BTreeMap<&str, &raw::Tier<'a>> =
        template.tiers.iter().map(|it| (&*it.id, it)).collect();
    for (at, tier) in transcript.tiers.iter().enumerate() {
        let (kind, known) = (kinds.name(tier), known.get(&*tier.name).copied());
        document
            .tiers
            .push(raw_tier(transcript, at, kind, &slots, known));
    }
    document.linguistic_types = kinds.finish();
    let used: BTreeSet<&str> = transcript
        .tiers
        .iter()
        .filter_map(|tier| tier.locale.as_deref())
        .collect();
    let known: BTreeSet<&str> = template.locales.iter().map(|it| &*it.language).collect();
    document
        .locales
        .extend(used.difference(&known).map(|it| raw::Locale {
            language: text(it),
            ..raw::Locale::default()
        }));
    document.time_order = slots.order;
    raw::upgraded(document)
}

fn text<'a>(text: &str) -> Text<'a> {
    Text::Owned(text.to_owned())
}

fn optional<'a>(value: Option<&String>) -> Option<Text<'a>> {
    value.map(|value| text(value))
}

fn header<'a>(transcript: &Transcript, template: &raw::Header<'a>) -> raw::Header<'a> {
    let media = |it: &Media| raw::MediaDescriptor {
        url: text(&it.url),
        mime_type: text(&it.mime_type),
        relative_url: optional(it.relative_url.as_ref()),
        time_origin: it.time_origin,
        extracted_from: optional(it.source.as_ref()),
        kept: None,
    };
    let linked = |it: &Media| raw::LinkedFile {
        url: text(&it.url),
        mime_type: text(&it.mime_type),
        relative_url: optional(it.relative_url.as_ref()),
        time_origin: it.time_origin,
        associated_with: optional(it.source.as_ref()),
        kept: None,
    };
    let all = transcript.tiers.iter().flat_map(|tier| &tier.annotations);
    let last = all
        .filter_map(|it| annotation_number(&it.id))
        .max()
        .unwrap_or(0);
    let property = |name: &str, value: &str| raw::Property {
        name: Some(text(name)),
        value: text(value),
        kept: None,
    };
    let counter = "lastUsedAnnotationId";
    let stored = transcript
        .properties
        .iter()
        .find(|(name, _)| name == counter);
    let last = stored
        .and_then(|(_, value)| value.parse().ok())
        .unwrap_or(0)
        .max(last);
    let named = transcript
        .properties
        .iter()
        .filter(|(name, _)| name != counter);
    raw::Header {
        media_file: Text::default(),
        time_units: Some("milliseconds".into()),
        media: transcript.media.iter().map(media).collect(),
        linked_files: transcript.linked_files.iter().map(linked).collect(),
        properties: named
            .map(|(name, value)| property(name, value))
            .chain([property(counter, &last.to_string())])
            .collect(),
        kept: template.kept.clone(),
    }
}

fn vocabulary<'a>(
    cv: &Vocabulary,
    references: &mut Vec<raw::ExternalRef<'a>>,
) -> raw::Vocabulary<'a> {
    let language = |name: &str| (!name.is_empty()).then(|| text(name));
    raw::Vocabulary {
        id: text(&cv.id),
        external_ref: cv.external.as_deref().map(|url| external(url, references)),
        descriptions: cv
            .descriptions
            .iter()
            .map(|(name, it)| raw::Description {
                language: language(name),
                text: text(it),
                kept: None,
            })
            .collect(),
        entries: cv
            .entries
            .iter()
            .map(|entry| raw::Entry {
                id: language(&entry.id),
                external_ref: optional(entry.external_ref.as_ref()),
                values: entry
                    .values
                    .iter()
                    .map(|it| raw::EntryValue {
                        language: language(&it.language),
                        description: optional(it.description.as_ref()),
                        value: text(&it.value),
                        kept: None,
                    })
                    .collect(),
                kept: None,
            })
            .collect(),
        external_refs: Vec::new(),
        kept: None,
        at: At::default(),
    }
}

/// Returns the id of the reference to an external vocabulary; adds the reference if it is missing.
fn external<'a>(url: &str, references: &mut Vec<raw::ExternalRef<'a>>) -> Text<'a> {
    if let Some(known) = references
        .iter()
        .find(|it| it.kind == "ecv" && it.value == url)
    {
        return known.id.clone();
    }
    let id = (1..)
        .map(|n| format!("er{n}"))
        .find(|id| references.iter().all(|it| it.id != *id))
        .unwrap_or_default();
    references.push(raw::ExternalRef {
        id: id.clone().into(),
        kind: "ecv".into(),
        value: text(url),
        kept: None,
    });
    id.into()
}

/// The tier types that are needed, by name.
struct Kinds<'a, 't> {
    template: &'t Document<'a>,
    used: BTreeMap<String, usize>,
    kinds: Vec<raw::LinguisticType<'a>>,
}

impl<'a, 't> Kinds<'a, 't> {
    fn new(template: &'t Document<'a>) -> Self {
        Self {
            template,
            used: BTreeMap::new(),
            kinds: Vec::new(),
        }
    }

    /// Returns the name of the type that fits `tier`; creates the type if it is missing.
    fn name(&mut self, tier: &Tier) -> Text<'a> {
        let base = match (&*tier.kind, tier.stereotype) {
            ("", None) => "default-lt",
            ("", Some(stereotype)) => stereotype.elan_name(),
            (name, _) => name,
        };
        let names = std::iter::once(base.to_owned()).chain((2..).map(|n| format!("{base} {n}")));
        for name in names {
            let Some(known) = self.used.get(&name) else {
                self.used.insert(name.clone(), self.kinds.len());
                self.kinds.push(self.kind(&name, tier));
                return name.into();
            };
            let known = &self.kinds[*known];
            if known.constraints.as_deref() == tier.stereotype.map(Stereotype::elan_name)
                && known.vocabulary.as_deref() == tier.vocabulary.as_deref()
            {
                return name.into();
            }
        }
        Text::default()
    }

    fn kind(&self, name: &str, tier: &Tier) -> raw::LinguisticType<'a> {
        let known = self
            .template
            .linguistic_types
            .iter()
            .find(|kind| kind.id == name)
            .cloned();
        raw::LinguisticType {
            id: text(name),
            time_alignable: Some(tier.stereotype.is_none_or(Stereotype::is_alignable)),
            constraints: tier.stereotype.map(|it| it.elan_name().into()),
            graphic_references: Some(false),
            vocabulary: optional(tier.vocabulary.as_ref()),
            ..known.unwrap_or_default()
        }
    }

    /// Returns the types, including those of the template that no tier uses.
    fn finish(mut self) -> Vec<raw::LinguisticType<'a>> {
        let unused = self
            .template
            .linguistic_types
            .iter()
            .filter(|kind| !self.used.contains_key(&*kind.id));
        self.kinds.extend(unused.cloned());
        self.kinds
    }
}

fn raw_tier<'a>(
    transcript: &Transcript,
    at: usize,
    kind: Text<'a>,
    slots: &Slots<'a>,
    known: Option<&raw::Tier<'a>>,
) -> raw::Tier<'a> {
    let tier = &transcript.tiers[at];
    raw::Tier {
        id: text(&tier.name),
        linguistic_type: kind,
        participant: optional(tier.participant.as_ref()),
        annotator: optional(tier.annotator.as_ref()),
        locale: optional(tier.locale.as_ref()),
        parent: tier
            .parent
            .and_then(|parent| transcript.tiers.get(parent))
            .map(|parent| text(&parent.name)),
        external_ref: known.and_then(|known| known.external_ref.clone()),
        language: optional(tier.language.as_ref()),
        annotations: annotations(transcript, at, slots),
        kept: known.and_then(|known| known.kept.clone()),
        at: At::default(),
    }
}

fn annotations<'a>(
    transcript: &Transcript,
    at: usize,
    slots: &Slots<'a>,
) -> Vec<raw::Annotation<'a>> {
    let tier = &transcript.tiers[at];
    let subdivided = tier.stereotype == Some(Stereotype::SymbolicSubdivision);
    let before: HashMap<(Option<AnnotationAddress>, u32), &str> = if subdivided {
        tier.annotations
            .iter()
            .map(|it| ((it.parent, it.order + 1), &*it.id))
            .collect()
    } else {
        HashMap::new()
    };
    let anchor = |index: usize, it: &Annotation| match slots
        .ends
        .get(&AnnotationAddress { tier: at, index })
    {
        Some((start, end)) => Anchor::Slots {
            start: start.clone(),
            end: end.clone(),
        },
        None => Anchor::Parent {
            parent: text(
                it.parent
                    .and_then(|place| transcript.annotation(place))
                    .map_or("", |it| &it.id),
            ),
            previous: before.get(&(it.parent, it.order)).map(|id| text(id)),
        },
    };
    let raw = |(index, it): (usize, &Annotation)| raw::Annotation {
        id: text(&it.id),
        anchor: anchor(index, it),
        value: text(&it.value),
        entry: optional(it.entry.as_ref()),
        external_ref: optional(it.external_ref.as_ref()),
        language: optional(it.language.as_ref()),
        svg: None,
        kept: None,
        at: At::default(),
    };
    tier.annotations.iter().enumerate().map(raw).collect()
}

/// The time slots of a transcript: the ends of each alignable annotation, and all in order.
struct Slots<'a> {
    ends: BTreeMap<AnnotationAddress, (Text<'a>, Text<'a>)>,
    order: Vec<raw::TimeSlot<'a>>,
}

/// A slot before it is ordered.
struct Draft {
    time: Instant,
    millis: Option<i64>,
}

impl Slots<'_> {
    fn new(transcript: &Transcript) -> Self {
        let mut drafts: Vec<Draft> = Vec::new();
        let mut ends: BTreeMap<AnnotationAddress, (usize, usize)> = BTreeMap::new();
        for tier in parents_first(transcript) {
            add_tier(transcript, tier, &mut drafts, &mut ends);
        }
        let mut uses = vec![0u32; drafts.len()];
        for (start, end) in ends.values() {
            uses[*start] += 1;
            uses[*end] += 1;
        }
        for (draft, _) in drafts.iter_mut().zip(uses).filter(|(_, uses)| *uses < 2) {
            draft.millis.get_or_insert(draft.time.millis());
        }
        let mut sorted: Vec<usize> = (0..drafts.len()).collect();
        sorted.sort_by_key(|slot| (drafts[*slot].time, *slot));
        let mut names = vec![String::new(); drafts.len()];
        for (n, slot) in (1..).zip(&sorted) {
            names[*slot] = format!("ts{n}");
        }
        let order = sorted.iter().map(|slot| raw::TimeSlot {
            id: names[*slot].clone().into(),
            value: drafts[*slot].millis,
            kept: None,
            at: At::default(),
        });
        Self {
            order: order.collect(),
            ends: ends
                .iter()
                .map(|(place, (start, end))| (*place, (text(&names[*start]), text(&names[*end]))))
                .collect(),
        }
    }
}

fn parents_first(transcript: &Transcript) -> Vec<usize> {
    let mut order = Vec::new();
    let mut placed = BTreeSet::new();
    for start in 0..transcript.tiers.len() {
        let mut path = Vec::new();
        let mut next = Some(start);
        while let Some(tier) =
            next.filter(|tier| *tier < transcript.tiers.len() && placed.insert(*tier))
        {
            path.push(tier);
            next = transcript.tiers[tier].parent;
        }
        order.extend(path.into_iter().rev());
    }
    order
}

fn add_tier(
    transcript: &Transcript,
    at: usize,
    drafts: &mut Vec<Draft>,
    ends: &mut BTreeMap<AnnotationAddress, (usize, usize)>,
) {
    let tier = &transcript.tiers[at];
    let shared = tier.stereotype == Some(Stereotype::TimeSubdivision);
    let mut sorted: Vec<usize> = (0..tier.annotations.len()).collect();
    if shared {
        sorted.sort_by_key(|index| {
            (
                tier.annotations[*index].parent,
                tier.annotations[*index].span,
            )
        });
    }
    let mut last: Option<(Option<AnnotationAddress>, usize)> = None;
    for index in sorted {
        let it = &tier.annotations[index];
        let (start_open, end_open) = match it.timing {
            Timing::Proposed { start, end } => (start && shared, end && shared),
            Timing::Own => (false, false),
            Timing::Parent | Timing::Share => continue,
        };
        let [from, to] = it
            .millis
            .unwrap_or([it.span.start().millis(), it.span.end().millis()]);
        let above = it
            .parent
            .filter(|_| shared)
            .and_then(|parent| ends.get(&parent))
            .copied();
        let before = last
            .filter(|(parent, _)| shared && *parent == it.parent)
            .map(|(_, slot)| slot);
        let start = before
            .or(above.map(|(start, _)| start))
            .filter(|slot| drafts[*slot].time == it.span.start());
        let end = above
            .map(|(_, end)| end)
            .filter(|slot| drafts[*slot].time == it.span.end());
        let mut draft = |time, millis| {
            drafts.push(Draft { time, millis });
            drafts.len() - 1
        };
        let start = start.unwrap_or_else(|| draft(it.span.start(), (!start_open).then_some(from)));
        let end = end.unwrap_or_else(|| draft(it.span.end(), (!end_open).then_some(to)));
        ends.insert(AnnotationAddress { tier: at, index }, (start, end));
        last = Some((it.parent, end));
    }
}
