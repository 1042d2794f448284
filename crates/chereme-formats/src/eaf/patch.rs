//! Changes an EAF file in the layout in which it was found: unchanged parts keep their bytes.

mod annotations;
mod patch_parts;
mod same;
mod slots;

pub use same::same_meaning;

use super::EafError;
use super::back::eaf_document_from_transcript;
use super::eaf_convert::from_raw_placed;
use super::eaf_layout::{EafLayout, TextEdits};
use super::eaf_raw::{self, EafDocument};
use super::encoding::decode_eaf;
use super::style::EafSpelling;
use crate::transcript::{AnnotationAddress, AnnotationTiming, AnnotationTranscript, TranscriptAnnotation};
use chereme_sign::TierStereotype;
use std::collections::{BTreeMap, HashMap};

/// Returns the file `bytes`, changed so that it means `after`; the same bytes if it does already.
///
/// A changed annotation changes its own lines and time slots; line ends, quotes, entities, the order of
/// attributes, the encoding, comments and all that EAF does not define stay as they are. The date stays, too, and
/// `lastUsedAnnotationId` rises if the file counts it. `None` stands for a change that is more than lines, such
/// as a new vocabulary in a format before 2.8 or another order of tiers: then the file has to be
/// [written](super::eaf_write::write_eaf_document) whole.
///
/// # Errors
/// The same as [`read_eaf`](super::read_eaf)'s.
pub fn patch_eaf(bytes: &[u8], after: &AnnotationTranscript) -> Result<Option<Vec<u8>>, EafError> {
    let decoded = decode_eaf(bytes)?;
    let (document, _) = eaf_raw::read_eaf_document(decoded.text.as_bytes())?;
    let (before, places, _) = from_raw_placed(&document);
    if same_meaning(&before, after) {
        return Ok(Some(bytes.to_vec()));
    }
    let Some(changed) = patch_document_text(&document, &before, &places, after) else {
        return Ok(None);
    };
    let changed = decoded.encoding.encode_xml_text(&changed);
    let (meant, _) = super::read_eaf(&changed)?;
    Ok(same_meaning(&meant, after).then_some(changed))
}

fn patch_document_text(
    document: &EafDocument<'_>,
    before: &AnnotationTranscript,
    places: &[Option<AnnotationAddress>],
    after: &AnnotationTranscript,
) -> Option<String> {
    let layout = EafLayout::layout_from_text(document.source.0)?;
    let style = EafSpelling::spelling_from_layout(&layout);
    let tiers = match_patched_tiers(before, after);
    let mut work = EafPatchWork {
        layout: &layout,
        style: &style,
        document,
        before,
        after,
        places,
        from: from(&tiers, after.tiers.len()),
        found: annotations_by_id(after),
        tiers,
        edits: TextEdits::default(),
    };
    // Annotations name slots, so that the slots are settled first.
    let refs = work.patch_time_slots()?;
    work.patch_file_annotations(&refs)?;
    let (old, new) = (
        eaf_document_from_transcript(before, document),
        eaf_document_from_transcript(after, document),
    );
    work.patch_file_tiers(&new, &old, &refs)?;
    work.patch_document_parts(&old, &new)?;
    work.edits.apply_text_edits(document.source.0)
}

/// The names of the two time slots of alignable annotations, by their place in the new transcript.
type SlotReferences = HashMap<AnnotationAddress, [String; 2]>;

/// A change of a file: its document, its present meaning, and the wanted meaning.
struct EafPatchWork<'w, 'd> {
    layout: &'w EafLayout<'d>,
    style: &'w EafSpelling,
    document: &'w EafDocument<'d>,
    before: &'w AnnotationTranscript,
    after: &'w AnnotationTranscript,
    /// The place of each annotation of the document.
    places: &'w [Option<AnnotationAddress>],
    /// The new tier of each old one.
    tiers: Vec<Option<usize>>,
    /// The old tier of each new one.
    from: Vec<Option<usize>>,
    /// The new annotations by their ids.
    found: BTreeMap<&'w str, AnnotationAddress>,
    edits: TextEdits,
}

impl<'w, 'd> EafPatchWork<'w, 'd> {
    /// Returns the new place of an old annotation; `None` if it was removed or went to another tier.
    fn kept_annotation_place(&self, old: AnnotationAddress) -> Option<AnnotationAddress> {
        let it = self.before.annotation_at(old)?;
        let new = *self.found.get(it.id.as_str())?;
        (self.tiers[old.tier] == Some(new.tier)).then_some(new)
    }

    fn wanted_annotation(&self, place: AnnotationAddress) -> &'w TranscriptAnnotation {
        &self.after.tiers[place.tier].annotations[place.index]
    }

    /// Returns the annotations of the document with their elements and old places.
    fn annotations_of_file(&self) -> Vec<(Option<AnnotationAddress>, usize, &'w eaf_raw::EafAnnotation<'d>)> {
        let (document, layout) = (self.document, self.layout);
        let all = document.tiers.iter().flat_map(|tier| &tier.annotations);
        all.zip(self.places)
            .filter_map(|(annotation, place)| {
                Some((
                    *place,
                    layout.element_starting_at(annotation.at.0 as usize)?,
                    annotation,
                ))
            })
            .collect()
    }

    /// Adds elements to a container: after one of its children, or before all of them.
    fn insert_container_elements(&mut self, container: usize, after: Option<usize>, blocks: &[String]) {
        if blocks.is_empty() {
            return;
        }
        let it = &self.layout.elements[container];
        let newline = self.style.newline;
        let indent = self.indent_in(container);
        let text: String = blocks.iter().map(|block| format!("{newline}{indent}{block}")).collect();
        let outer = self.layout.element_indent(container).unwrap_or_default();
        if let Some(child) = after {
            let end = self.layout.elements[child].span.end;
            self.edits.insert_text_at(end, text);
        } else if it.empty {
            let name = self.layout.layout_element_name(container);
            let tag = &self.layout.text[it.span.start..it.inner.start];
            let start = it.span.start + tag.trim_ascii_end().len();
            let text = format!(">{text}{newline}{outer}</{name}>");
            self.edits.replace_text_span(start..it.span.end, text);
        } else if it.children.is_empty() && !self.layout.text[it.inner.clone()].contains('\n') {
            self.edits
                .insert_text_at(it.inner.start, format!("{text}{newline}{outer}"));
        } else {
            self.edits.insert_text_at(it.inner.start, text);
        }
    }

    /// Returns the indentation of the elements of a container.
    fn indent_in(&self, container: usize) -> String {
        if self.style.newline.is_empty() {
            return String::new();
        }
        let first = self.layout.elements[container].children.first();
        if let Some(indent) = first.and_then(|child| self.layout.element_indent(*child)) {
            return indent.to_owned();
        }
        let outer = self.layout.element_indent(container).unwrap_or_default();
        format!("{outer}{}", self.style.unit)
    }

    /// Writes, replaces or removes an attribute.
    fn patch_element_attribute(&mut self, element: usize, name: &str, value: Option<&str>) {
        let present_attribute = self.layout.find_element_attribute(element, name);
        match (present_attribute, value) {
            (Some(known), Some(value)) => {
                let quote = char::from(self.layout.text.as_bytes()[known.value.end]);
                let value = self.style.escape_xml_text(value, Some(quote));
                self.edits.replace_text_span(known.value, value);
            }
            (Some(known), None) => {
                let before = &self.layout.text[..known.name.start];
                let start = before.trim_ascii_end().len();
                self.edits.remove_text_span(start..known.value.end + 1);
            }
            (None, Some(value)) => {
                let all = self.layout.element_attributes(element);
                let before = all
                    .iter()
                    .take_while(|attribute| self.layout.text[attribute.name.clone()] < *name)
                    .last();
                let end = before.map_or(self.layout.elements[element].name.end, |attribute| {
                    attribute.value.end + 1
                });
                let written = self.style.format_xml_attribute(name, value);
                self.edits.insert_text_at(end, format!(" {written}"));
            }
            (None, None) => {}
        }
    }

    /// Replaces the text of an element.
    fn patch_element_text(&mut self, element: usize, text: &str) {
        let it = &self.layout.elements[element];
        let text = self.style.escape_xml_text(text, None);
        if !it.empty {
            self.edits.replace_text_span(it.inner.clone(), text);
        } else if !text.is_empty() {
            let name = self.layout.layout_element_name(element);
            let tag = &self.layout.text[it.span.start..it.inner.start];
            let start = it.span.start + tag.trim_ascii_end().len();
            self.edits
                .replace_text_span(start..it.span.end, format!(">{text}</{name}>"));
        }
    }
}

/// Returns both ends of an annotation in milliseconds; `None` for an end that was never set.
fn annotation_end_millis(annotation: &TranscriptAnnotation) -> [Option<i64>; 2] {
    let span = [annotation.span.span_start_instant(), annotation.span.span_end_instant()];
    let [start, end] = annotation
        .millis
        .unwrap_or(span.map(|instant| instant.instant_millis()));
    match annotation.timing {
        AnnotationTiming::Proposed { start: from, end: to } => [(!from).then_some(start), (!to).then_some(end)],
        _ => [Some(start), Some(end)],
    }
}

fn is_alignable(transcript: &AnnotationTranscript, tier: usize) -> bool {
    let stereotype = transcript.tiers[tier].stereotype;
    stereotype.is_none_or(TierStereotype::is_alignable)
}

fn annotations_by_id(transcript: &AnnotationTranscript) -> BTreeMap<&str, AnnotationAddress> {
    let mut addresses = BTreeMap::new();
    for (tier, it) in transcript.tiers.iter().enumerate() {
        for (index, annotation) in it.annotations.iter().enumerate() {
            addresses.insert(annotation.id.as_str(), AnnotationAddress { tier, index });
        }
    }
    addresses
}

fn from(tiers: &[Option<usize>], count: usize) -> Vec<Option<usize>> {
    let mut from = vec![None; count];
    for (old, new) in tiers.iter().enumerate() {
        if let Some(new) = new {
            from[*new] = Some(old);
        }
    }
    from
}

/// Returns the new tier of each old one: the tier of the same name, else one that holds most of its annotations.
fn match_patched_tiers(before: &AnnotationTranscript, after: &AnnotationTranscript) -> Vec<Option<usize>> {
    let by_name: HashMap<&str, usize> = after
        .tiers
        .iter()
        .enumerate()
        .map(|(at, tier)| (tier.name.as_str(), at))
        .collect();
    let mut tiers: Vec<Option<usize>> = before
        .tiers
        .iter()
        .map(|tier| by_name.get(tier.name.as_str()).copied())
        .collect();
    let new_ids = annotations_by_id(after);
    for (old, tier) in before.tiers.iter().enumerate() {
        if tiers[old].is_some() {
            continue;
        }
        let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
        for annotation in &tier.annotations {
            if let Some(place) = new_ids.get(annotation.id.as_str()) {
                *counts.entry(place.tier).or_default() += 1;
            }
        }
        let most = counts
            .into_iter()
            .filter(|(tier, _)| !tiers.contains(&Some(*tier)))
            .max_by_key(|(tier, count)| (*count, usize::MAX - tier));
        tiers[old] = most
            // A tier that was only renamed keeps most of its annotations.
            .filter(|(_, count)| 2 * count > tier.annotations.len())
            .map(|(tier, _)| tier);
    }
    tiers
}
