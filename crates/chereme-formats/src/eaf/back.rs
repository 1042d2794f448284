//! Converts a transcript to a raw document.

use super::eaf_convert::annotation_number;
use super::eaf_raw::{self, AnnotationAnchor, EafDocument, EafText, ElementStart};
use crate::transcript::{
    AnnotationAddress, AnnotationTiming, AnnotationTranscript, ControlledVocabulary, TranscriptAnnotation,
    TranscriptMedia, TranscriptTier,
};
use chereme_motion::RecordingInstant;
use chereme_sign::TierStereotype;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Returns `transcript` as a document of EAF 3.0.
///
/// Everything that a transcript doesn't hold (licences, languages, locales, lexicon and external references, links
/// between annotations) comes from `template`, for example the document that the transcript was read from;
/// [`EafDocument::default`] gives no such parts. Children of a Time_Subdivision share time slots with each other and with
/// their parent; ends within one that were never set stay unset; elsewhere ELAN requires times, and they get the values
/// from reading. `lastUsedAnnotationId` is computed again and comes last.
#[must_use]
pub fn eaf_document_from_transcript<'a>(
    transcript: &AnnotationTranscript,
    template: &EafDocument<'a>,
) -> EafDocument<'a> {
    let mut document = EafDocument {
        author: transcript.author.clone().into(),
        date: transcript.date.clone().into(),
        licenses: template.licenses.clone(),
        locales: template.locales.clone(),
        languages: template.languages.clone(),
        lexicon_refs: template.lexicon_refs.clone(),
        ref_link_sets: template.ref_link_sets.clone(),
        external_refs: template.external_refs.clone(),
        header: to_raw_header(transcript, &template.header),
        kept: template.kept.clone(),
        ..EafDocument::default()
    };
    for vocabulary in &template.vocabularies {
        // Global Signbank writes references inside the vocabulary, where EAF does not allow them.
        document.external_refs.extend(vocabulary.external_refs.iter().cloned());
    }
    document.vocabularies = transcript
        .vocabularies
        .iter()
        .map(|source| to_raw_vocabulary(source, &mut document.external_refs))
        .collect();
    let mut kinds = TierTypeTable::new(template);
    let slots = TranscriptSlots::new(transcript);
    let template_tiers: BTreeMap<&str, &eaf_raw::EafTier<'a>> =
        template.tiers.iter().map(|tier| (&*tier.id, tier)).collect();
    for (at, tier) in transcript.tiers.iter().enumerate() {
        let (kind, known) = (kinds.type_name_for_tier(tier), template_tiers.get(&*tier.name).copied());
        document.tiers.push(raw_tier(transcript, at, kind, &slots, known));
    }
    document.linguistic_types = kinds.finish_linguistic_types();
    let used: BTreeSet<&str> = transcript
        .tiers
        .iter()
        .filter_map(|tier| tier.locale.as_deref())
        .collect();
    let listed_languages: BTreeSet<&str> = template.locales.iter().map(|locale| &*locale.language).collect();
    document
        .locales
        .extend(used.difference(&listed_languages).map(|code| eaf_raw::EafLocale {
            language: owned_eaf_text(code),
            ..eaf_raw::EafLocale::default()
        }));
    document.time_order = slots.order;
    eaf_raw::upgrade_eaf_document(document)
}

fn owned_eaf_text<'a>(text: &str) -> EafText<'a> {
    EafText::Owned(text.to_owned())
}

fn optional_eaf_text<'a>(value: Option<&String>) -> Option<EafText<'a>> {
    value.map(|value| owned_eaf_text(value))
}

fn to_raw_header<'a>(transcript: &AnnotationTranscript, template: &eaf_raw::EafHeader<'a>) -> eaf_raw::EafHeader<'a> {
    let media = |file: &TranscriptMedia| eaf_raw::MediaDescriptor {
        url: owned_eaf_text(&file.url),
        mime_type: owned_eaf_text(&file.mime_type),
        relative_url: optional_eaf_text(file.relative_url.as_ref()),
        time_origin: file.time_origin,
        extracted_from: optional_eaf_text(file.source.as_ref()),
        kept: None,
    };
    let linked = |file: &TranscriptMedia| eaf_raw::LinkedFile {
        url: owned_eaf_text(&file.url),
        mime_type: owned_eaf_text(&file.mime_type),
        relative_url: optional_eaf_text(file.relative_url.as_ref()),
        time_origin: file.time_origin,
        associated_with: optional_eaf_text(file.source.as_ref()),
        kept: None,
    };
    let all = transcript.tiers.iter().flat_map(|tier| &tier.annotations);
    let last = all
        .filter_map(|annotation| annotation_number(&annotation.id))
        .max()
        .unwrap_or(0);
    let property = |name: &str, value: &str| eaf_raw::EafProperty {
        name: Some(owned_eaf_text(name)),
        value: owned_eaf_text(value),
        kept: None,
    };
    let counter = "lastUsedAnnotationId";
    let stored = transcript.properties.iter().find(|(name, _)| name == counter);
    let last = stored.and_then(|(_, value)| value.parse().ok()).unwrap_or(0).max(last);
    let named = transcript.properties.iter().filter(|(name, _)| name != counter);
    eaf_raw::EafHeader {
        media_file: EafText::default(),
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

fn to_raw_vocabulary<'a>(
    cv: &ControlledVocabulary,
    references: &mut Vec<eaf_raw::ExternalRef<'a>>,
) -> eaf_raw::EafVocabulary<'a> {
    let language = |name: &str| (!name.is_empty()).then(|| owned_eaf_text(name));
    eaf_raw::EafVocabulary {
        id: owned_eaf_text(&cv.id),
        external_ref: cv.external.as_deref().map(|url| external(url, references)),
        descriptions: cv
            .descriptions
            .iter()
            .map(|(name, it)| eaf_raw::VocabularyDescription {
                language: language(name),
                text: owned_eaf_text(it),
                kept: None,
            })
            .collect(),
        entries: cv
            .entries
            .iter()
            .map(|entry| eaf_raw::EafVocabularyEntry {
                id: language(&entry.id),
                external_ref: optional_eaf_text(entry.external_ref.as_ref()),
                values: entry
                    .values
                    .iter()
                    .map(|value| eaf_raw::EafEntryValue {
                        language: language(&value.language),
                        description: optional_eaf_text(value.description.as_ref()),
                        value: owned_eaf_text(&value.value),
                        kept: None,
                    })
                    .collect(),
                kept: None,
            })
            .collect(),
        external_refs: Vec::new(),
        kept: None,
        at: ElementStart::default(),
    }
}

/// Returns the id of the reference to an external vocabulary; adds the reference if it is missing.
fn external<'a>(url: &str, references: &mut Vec<eaf_raw::ExternalRef<'a>>) -> EafText<'a> {
    if let Some(known) = references
        .iter()
        .find(|reference| reference.kind == "ecv" && reference.value == url)
    {
        return known.id.clone();
    }
    let id = (1..)
        .map(|n| format!("er{n}"))
        .find(|id| references.iter().all(|reference| reference.id != *id))
        .unwrap_or_default();
    references.push(eaf_raw::ExternalRef {
        id: id.clone().into(),
        kind: "ecv".into(),
        value: owned_eaf_text(url),
        kept: None,
    });
    id.into()
}

/// The tier types that are needed, by name.
struct TierTypeTable<'a, 't> {
    template: &'t EafDocument<'a>,
    used: BTreeMap<String, usize>,
    kinds: Vec<eaf_raw::LinguisticType<'a>>,
}

impl<'a, 't> TierTypeTable<'a, 't> {
    fn new(template: &'t EafDocument<'a>) -> Self {
        Self {
            template,
            used: BTreeMap::new(),
            kinds: Vec::new(),
        }
    }

    /// Returns the name of the type that fits `tier`; creates the type if it is missing.
    fn type_name_for_tier(&mut self, tier: &TranscriptTier) -> EafText<'a> {
        let base = match (&*tier.kind, tier.stereotype) {
            ("", None) => "default-lt",
            ("", Some(stereotype)) => stereotype.elan_name(),
            (name, _) => name,
        };
        let names = std::iter::once(base.to_owned()).chain((2..).map(|n| format!("{base} {n}")));
        for name in names {
            let Some(known) = self.used.get(&name) else {
                self.used.insert(name.clone(), self.kinds.len());
                self.kinds.push(self.new_linguistic_type(&name, tier));
                return name.into();
            };
            let written_kind = &self.kinds[*known];
            if written_kind.constraints.as_deref() == tier.stereotype.map(TierStereotype::elan_name)
                && written_kind.vocabulary.as_deref() == tier.vocabulary.as_deref()
            {
                return name.into();
            }
        }
        EafText::default()
    }

    fn new_linguistic_type(&self, name: &str, tier: &TranscriptTier) -> eaf_raw::LinguisticType<'a> {
        let template_kind = self
            .template
            .linguistic_types
            .iter()
            .find(|kind| kind.id == name)
            .cloned();
        eaf_raw::LinguisticType {
            id: owned_eaf_text(name),
            time_alignable: Some(tier.stereotype.is_none_or(TierStereotype::is_alignable)),
            constraints: tier.stereotype.map(|stereotype| stereotype.elan_name().into()),
            graphic_references: Some(false),
            vocabulary: optional_eaf_text(tier.vocabulary.as_ref()),
            ..template_kind.unwrap_or_default()
        }
    }

    /// Returns the types, including those of the template that no tier uses.
    fn finish_linguistic_types(mut self) -> Vec<eaf_raw::LinguisticType<'a>> {
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
    transcript: &AnnotationTranscript,
    at: usize,
    kind: EafText<'a>,
    slots: &TranscriptSlots<'a>,
    known: Option<&eaf_raw::EafTier<'a>>,
) -> eaf_raw::EafTier<'a> {
    let tier = &transcript.tiers[at];
    eaf_raw::EafTier {
        id: owned_eaf_text(&tier.name),
        linguistic_type: kind,
        participant: optional_eaf_text(tier.participant.as_ref()),
        annotator: optional_eaf_text(tier.annotator.as_ref()),
        locale: optional_eaf_text(tier.locale.as_ref()),
        parent: tier
            .parent
            .and_then(|parent| transcript.tiers.get(parent))
            .map(|parent| owned_eaf_text(&parent.name)),
        external_ref: known.and_then(|known| known.external_ref.clone()),
        language: optional_eaf_text(tier.language.as_ref()),
        annotations: to_raw_annotations(transcript, at, slots),
        kept: known.and_then(|known| known.kept.clone()),
        at: ElementStart::default(),
    }
}

fn to_raw_annotations<'a>(
    transcript: &AnnotationTranscript,
    at: usize,
    slots: &TranscriptSlots<'a>,
) -> Vec<eaf_raw::EafAnnotation<'a>> {
    let tier = &transcript.tiers[at];
    // Only siblings of a subdivision name the one before them.
    let subdivided = tier.stereotype == Some(TierStereotype::SymbolicSubdivision);
    let before: HashMap<(Option<AnnotationAddress>, u32), &str> = if subdivided {
        tier.annotations
            .iter()
            .map(|annotation| ((annotation.parent, annotation.order + 1), &*annotation.id))
            .collect()
    } else {
        HashMap::new()
    };
    let anchor = |index: usize, it: &TranscriptAnnotation| match slots.ends.get(&AnnotationAddress { tier: at, index })
    {
        Some((start, end)) => AnnotationAnchor::Slots {
            start: start.clone(),
            end: end.clone(),
        },
        None => AnnotationAnchor::Parent {
            parent: owned_eaf_text(
                it.parent
                    .and_then(|place| transcript.annotation_at(place))
                    .map_or("", |annotation| &annotation.id),
            ),
            previous: before.get(&(it.parent, it.order)).map(|id| owned_eaf_text(id)),
        },
    };
    let raw = |(index, it): (usize, &TranscriptAnnotation)| eaf_raw::EafAnnotation {
        id: owned_eaf_text(&it.id),
        anchor: anchor(index, it),
        value: owned_eaf_text(&it.value),
        entry: optional_eaf_text(it.entry.as_ref()),
        external_ref: optional_eaf_text(it.external_ref.as_ref()),
        language: optional_eaf_text(it.language.as_ref()),
        svg: None,
        kept: None,
        at: ElementStart::default(),
    };
    tier.annotations.iter().enumerate().map(raw).collect()
}

/// The time slots of a transcript: the ends of each alignable annotation, and all in order.
struct TranscriptSlots<'a> {
    ends: BTreeMap<AnnotationAddress, (EafText<'a>, EafText<'a>)>,
    order: Vec<eaf_raw::TimeSlot<'a>>,
}

/// A slot before it is ordered.
struct DraftTimeSlot {
    time: RecordingInstant,
    millis: Option<i64>,
}

impl TranscriptSlots<'_> {
    fn new(transcript: &AnnotationTranscript) -> Self {
        let mut drafts: Vec<DraftTimeSlot> = Vec::new();
        let mut ends: BTreeMap<AnnotationAddress, (usize, usize)> = BTreeMap::new();
        for tier in written_tiers_parents_first(transcript) {
            add_tier(transcript, tier, &mut drafts, &mut ends);
        }
        let mut uses = vec![0u32; drafts.len()];
        for (start, end) in ends.values() {
            uses[*start] += 1;
            uses[*end] += 1;
        }
        for (draft, _) in drafts.iter_mut().zip(uses).filter(|(_, uses)| *uses < 2) {
            // A time may stay unset only between two annotations that share it.
            draft.millis.get_or_insert(draft.time.instant_millis());
        }
        let mut sorted: Vec<usize> = (0..drafts.len()).collect();
        sorted.sort_by_key(|slot| (drafts[*slot].time, *slot));
        let mut names = vec![String::new(); drafts.len()];
        for (n, slot) in (1..).zip(&sorted) {
            names[*slot] = format!("ts{n}");
        }
        let order = sorted.iter().map(|slot| eaf_raw::TimeSlot {
            id: names[*slot].clone().into(),
            value: drafts[*slot].millis,
            kept: None,
            at: ElementStart::default(),
        });
        Self {
            order: order.collect(),
            ends: ends
                .iter()
                .map(|(place, (start, end))| (*place, (owned_eaf_text(&names[*start]), owned_eaf_text(&names[*end]))))
                .collect(),
        }
    }
}

fn written_tiers_parents_first(transcript: &AnnotationTranscript) -> Vec<usize> {
    let mut order = Vec::new();
    let mut placed = BTreeSet::new();
    for start in 0..transcript.tiers.len() {
        let mut path = Vec::new();
        let mut next = Some(start);
        while let Some(tier) = next.filter(|tier| *tier < transcript.tiers.len() && placed.insert(*tier)) {
            path.push(tier);
            next = transcript.tiers[tier].parent;
        }
        order.extend(path.into_iter().rev());
    }
    order
}

fn add_tier(
    transcript: &AnnotationTranscript,
    at: usize,
    drafts: &mut Vec<DraftTimeSlot>,
    ends: &mut BTreeMap<AnnotationAddress, (usize, usize)>,
) {
    let tier = &transcript.tiers[at];
    let shared = tier.stereotype == Some(TierStereotype::TimeSubdivision);
    let mut sorted: Vec<usize> = (0..tier.annotations.len()).collect();
    if shared {
        sorted.sort_by_key(|index| (tier.annotations[*index].parent, tier.annotations[*index].span));
    }
    let mut last: Option<(Option<AnnotationAddress>, usize)> = None;
    for index in sorted {
        let it = &tier.annotations[index];
        let (start_open, end_open) = match it.timing {
            AnnotationTiming::Proposed { start, end } => (start && shared, end && shared),
            AnnotationTiming::Own => (false, false),
            AnnotationTiming::Parent | AnnotationTiming::Share => continue,
        };
        let [from, to] = it.millis.unwrap_or([
            it.span.span_start_instant().instant_millis(),
            it.span.span_end_instant().instant_millis(),
        ]);
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
            .filter(|slot| drafts[*slot].time == it.span.span_start_instant());
        let end = above
            .map(|(_, end)| end)
            .filter(|slot| drafts[*slot].time == it.span.span_end_instant());
        let mut draft = |time, millis| {
            drafts.push(DraftTimeSlot { time, millis });
            drafts.len() - 1
        };
        let start = start.unwrap_or_else(|| draft(it.span.span_start_instant(), (!start_open).then_some(from)));
        let end = end.unwrap_or_else(|| draft(it.span.span_end_instant(), (!end_open).then_some(to)));
        ends.insert(AnnotationAddress { tier: at, index }, (start, end));
        last = Some((it.parent, end));
    }
}
