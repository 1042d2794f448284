//! Annotations and tiers that were changed, removed and added.

use super::{EafPatchWork, SlotReferences, is_alignable};
use crate::eaf::eaf_output::render_eaf_elements;
use crate::eaf::eaf_raw::{self, AnnotationAnchor, EafDocument, ElementStart};
use crate::eaf::eaf_write;
use crate::transcript::{AnnotationAddress, AnnotationTranscript};
use chereme_sign::TierStereotype;
use std::collections::{BTreeMap, HashMap};

/// An annotation of the file that remains: its element, its places before and after, and the ids of the annotations that
/// it followed and follows in a chain below one parent.
struct KeptAnnotation<'t> {
    element: usize,
    old: AnnotationAddress,
    new: AnnotationAddress,
    old_previous: Option<&'t str>,
    new_previous: Option<&'t str>,
}

impl<'w> EafPatchWork<'w, '_> {
    /// Changes and removes annotations of the file, and adds new ones to its tiers.
    pub(super) fn patch_file_annotations(&mut self, refs: &SlotReferences) -> Option<()> {
        let (previous, next) = (before_each(self.before), before_each(self.after));
        let mut elements: HashMap<AnnotationAddress, usize> = HashMap::new();
        for (place, element, raw) in self.annotations_of_file() {
            let Some(old) = place else { continue };
            let around = self.layout.elements[element].parent?;
            match self.kept_annotation_place(old) {
                Some(new) => {
                    elements.insert(new, around);
                    let kept = KeptAnnotation {
                        element,
                        old,
                        new,
                        old_previous: previous.get(&old).copied(),
                        new_previous: next.get(&new).copied(),
                    };
                    self.patch_kept_annotation(&kept, raw, refs.get(&new))?;
                }
                // It goes with its tier.
                None if self.tiers[old.tier].is_none() => {}
                None => {
                    // Each annotation stands in an element of its own, which goes with it.
                    let alone = self.layout.elements[around].children.len() == 1;
                    let span = self.layout.element_line_span(if alone { around } else { element });
                    self.edits.remove_text_span(span);
                }
            }
        }
        for (tier, from) in self.from.clone().into_iter().enumerate() {
            let Some(from) = from else { continue };
            let tier_start = self.document.tiers[from].at.0 as usize;
            let container = self.layout.element_starting_at(tier_start)?;
            let indent = self.indent_in(container);
            let mut added: BTreeMap<Option<usize>, Vec<String>> = BTreeMap::new();
            let mut last = None;
            for index in 0..self.after.tiers[tier].annotations.len() {
                let place = AnnotationAddress { tier, index };
                if let Some(element) = elements.get(&place) {
                    last = Some(*element);
                    continue;
                }
                let block = self.render_new_annotation(place, refs, &next, &indent)?;
                // New ones follow the last annotation that stands in the file before them.
                added.entry(last).or_default().push(block);
            }
            for (after, blocks) in added {
                self.insert_container_elements(container, after, &blocks);
            }
        }
        Some(())
    }

    /// Changes an annotation that remains.
    fn patch_kept_annotation(
        &mut self,
        kept: &KeptAnnotation<'_>,
        raw: &eaf_raw::EafAnnotation<'_>,
        refs: Option<&[String; 2]>,
    ) -> Option<()> {
        let KeptAnnotation { element, old, new, .. } = *kept;
        let (before, after) = (self.before.annotation_at(old)?, self.wanted_annotation(new));
        if before.value != after.value {
            match self.layout.first_child_named(element, "ANNOTATION_VALUE") {
                Some(value) => self.patch_element_text(value, &after.value),
                None => return None,
            }
        }
        let reference_pairs = [
            ("CVE_REF", &before.entry, &after.entry),
            ("EXT_REF", &before.external_ref, &after.external_ref),
            ("LANG_REF", &before.language, &after.language),
        ];
        for (name, before, after) in reference_pairs {
            if before != after {
                self.patch_element_attribute(element, name, after.as_deref());
            }
        }
        match (&raw.anchor, refs) {
            (AnnotationAnchor::Slots { start, end }, Some(refs)) => {
                let names = ["TIME_SLOT_REF1", "TIME_SLOT_REF2"];
                for ((name, slot), known) in names.into_iter().zip(refs).zip([start, end]) {
                    if slot.as_str() != &**known {
                        self.patch_element_attribute(element, name, Some(slot));
                    }
                }
            }
            (AnnotationAnchor::Parent { .. }, None) => {
                let above = |transcript: &'w AnnotationTranscript, place: AnnotationAddress| {
                    let parent = transcript.annotation_at(place)?.parent?;
                    Some(transcript.annotation_at(parent)?.id.as_str())
                };
                let parent = above(self.after, new);
                if above(self.before, old) != parent {
                    self.patch_element_attribute(element, "ANNOTATION_REF", Some(parent?));
                }
                if kept.old_previous != kept.new_previous {
                    self.patch_element_attribute(element, "PREVIOUS_ANNOTATION", kept.new_previous);
                }
            }
            _ => return None,
        }
        Some(())
    }

    /// Returns the lines of a new annotation.
    fn render_new_annotation(
        &self,
        place: AnnotationAddress,
        refs: &SlotReferences,
        previous: &HashMap<AnnotationAddress, &str>,
        indent: &str,
    ) -> Option<String> {
        let it = self.wanted_annotation(place);
        let anchor = if is_alignable(self.after, place.tier) {
            let [start, end] = refs.get(&place)?.clone();
            AnnotationAnchor::Slots {
                start: start.into(),
                end: end.into(),
            }
        } else {
            AnnotationAnchor::Parent {
                parent: self.after.annotation_at(it.parent?)?.id.as_str().into(),
                previous: previous.get(&place).map(|id| (*id).into()),
            }
        };
        let raw = eaf_raw::EafAnnotation {
            id: it.id.as_str().into(),
            anchor,
            value: it.value.as_str().into(),
            entry: it.entry.as_deref().map(Into::into),
            external_ref: it.external_ref.as_deref().map(Into::into),
            language: it.language.as_deref().map(Into::into),
            svg: None,
            kept: None,
            at: ElementStart::default(),
        };
        render_eaf_elements(self.style, indent, |xml| eaf_write::write_eaf_annotation(&raw, xml))
    }

    /// Removes tiers, adds tiers with their annotations, and changes the attributes of the others.
    pub(super) fn patch_file_tiers(
        &mut self,
        new: &EafDocument<'_>,
        old: &EafDocument<'_>,
        refs: &SlotReferences,
    ) -> Option<()> {
        let order = self.from.iter().flatten();
        // Tiers in another order are no small change: the file is written afresh.
        if !order.is_sorted() {
            return None;
        }
        let element = |work: &Self, old: usize| {
            let tier_start = work.document.tiers[old].at.0 as usize;
            work.layout.element_starting_at(tier_start)
        };
        for at in 0..self.tiers.len() {
            if self.tiers[at].is_none() {
                let span = self.layout.element_line_span(element(self, at)?);
                self.edits.remove_text_span(span);
            }
        }
        let previous = before_each(self.after);
        let root = self.root_layout_element()?;
        let mut last = self.layout.first_child_named(root, "TIME_ORDER");
        let mut added: BTreeMap<Option<usize>, Vec<String>> = BTreeMap::new();
        for at in 0..new.tiers.len() {
            if let Some(from) = self.from[at] {
                let tier_element = element(self, from)?;
                last = Some(tier_element);
                self.attributes_of(
                    tier_element,
                    &raw_tier_without_annotations(&old.tiers[from]),
                    &raw_tier_without_annotations(&new.tiers[at]),
                )?;
                continue;
            }
            let indent = self.indent_in(root);
            let inner = format!("{indent}{}", self.style.unit);
            let mut text = render_eaf_elements(self.style, &indent, |xml| {
                eaf_write::write_eaf_tier(&raw_tier_without_annotations(&new.tiers[at]), xml)
            })?;
            let mut blocks = String::new();
            for index in 0..self.after.tiers[at].annotations.len() {
                let place = AnnotationAddress { tier: at, index };
                let block = self.render_new_annotation(place, refs, &previous, &inner)?;
                blocks.push_str(&format!("{}{inner}{block}", self.style.newline));
            }
            if !blocks.is_empty() {
                // The tier was rendered without annotations, as an empty element.
                let tag = text.strip_suffix(self.style.empty_tag_end())?;
                text = format!("{tag}>{blocks}{}{indent}</TIER>", self.style.newline);
            }
            added.entry(last).or_default().push(text);
        }
        for (after, blocks) in added {
            self.insert_container_elements(root, after, &blocks);
        }
        Some(())
    }

    pub(super) fn root_layout_element(&self) -> Option<usize> {
        let all = 0..self.layout.elements.len();
        all.take(1)
            .find(|element| self.layout.elements[*element].parent.is_none())
    }
}

fn raw_tier_without_annotations<'t>(tier: &eaf_raw::EafTier<'t>) -> eaf_raw::EafTier<'t> {
    eaf_raw::EafTier {
        annotations: Vec::new(),
        kept: None,
        ..tier.clone()
    }
}

/// Returns for each annotation of a chain below a symbolic parent the id of the one before it.
fn before_each(transcript: &AnnotationTranscript) -> HashMap<AnnotationAddress, &str> {
    let mut ids_before = HashMap::new();
    for (tier, it) in transcript.tiers.iter().enumerate() {
        if it.stereotype != Some(TierStereotype::SymbolicSubdivision) {
            continue;
        }
        let mut chain: Vec<usize> = (0..it.annotations.len()).collect();
        chain.sort_by_key(|index| (it.annotations[*index].parent, it.annotations[*index].order));
        for pair in chain.windows(2) {
            let (before, own) = (&it.annotations[pair[0]], &it.annotations[pair[1]]);
            if before.parent == own.parent {
                let index = pair[1];
                ids_before.insert(AnnotationAddress { tier, index }, before.id.as_str());
            }
        }
    }
    ids_before
}
