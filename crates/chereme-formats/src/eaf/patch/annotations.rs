//! Annotations and tiers that were changed, removed and added.

use super::{Refs, Work, is_alignable};
use crate::eaf::model::{AnnotationAddress, Transcript};
use crate::eaf::output::written;
use crate::eaf::raw::{self, Anchor, At, Document};
use crate::eaf::write;
use chereme_sign::Stereotype;
use std::collections::{BTreeMap, HashMap};

impl<'w> Work<'w, '_> {
    /// Changes and removes annotations of the file, and adds new ones to its tiers.
    pub(super) fn annotations(&mut self, refs: &Refs) -> Option<()> {
        let (previous, next) = (before_each(self.before), before_each(self.after));
        let mut elements: HashMap<AnnotationAddress, usize> = HashMap::new();
        for (place, element, raw) in self.annotations_of_file() {
            let Some(old) = place else { continue };
            let around = self.layout.elements[element].parent?;
            match self.kept(old) {
                Some(new) => {
                    elements.insert(new, around);
                    let chain = (previous.get(&old).copied(), next.get(&new).copied());
                    self.annotation(element, raw, (old, new), refs.get(&new), chain)?;
                }
                None if self.tiers[old.tier].is_none() => {}
                None => {
                    let alone = self.layout.elements[around].children.len() == 1;
                    let span = self.layout.lines(if alone { around } else { element });
                    self.edits.remove(span);
                }
            }
        }
        for (tier, from) in self.from.clone().into_iter().enumerate() {
            let Some(from) = from else { continue };
            let at = self.document.tiers[from].at.0 as usize;
            let container = self.layout.starting(at)?;
            let indent = self.indent_in(container);
            let mut added: BTreeMap<Option<usize>, Vec<String>> = BTreeMap::new();
            let mut last = None;
            for index in 0..self.after.tiers[tier].annotations.len() {
                let place = AnnotationAddress { tier, index };
                if let Some(element) = elements.get(&place) {
                    last = Some(*element);
                    continue;
                }
                let block = self.block(place, refs, &next, &indent)?;
                added.entry(last).or_default().push(block);
            }
            for (after, blocks) in added {
                self.insert(container, after, &blocks);
            }
        }
        Some(())
    }

    /// Changes an annotation that remains.
    fn annotation(
        &mut self,
        element: usize,
        raw: &raw::Annotation<'_>,
        (old, new): (AnnotationAddress, AnnotationAddress),
        refs: Option<&[String; 2]>,
        (previous, next): (Option<&str>, Option<&str>),
    ) -> Option<()> {
        let (before, after) = (self.before.annotation(old)?, self.wanted(new));
        if before.value != after.value {
            match self.layout.child(element, "ANNOTATION_VALUE") {
                Some(value) => self.text(value, &after.value),
                None => return None,
            }
        }
        let own = [
            ("CVE_REF", &before.entry, &after.entry),
            ("EXT_REF", &before.external_ref, &after.external_ref),
            ("LANG_REF", &before.language, &after.language),
        ];
        for (name, before, after) in own {
            if before != after {
                self.attribute(element, name, after.as_deref());
            }
        }
        match (&raw.anchor, refs) {
            (Anchor::Slots { start, end }, Some(refs)) => {
                let names = ["TIME_SLOT_REF1", "TIME_SLOT_REF2"];
                for ((name, slot), known) in names.into_iter().zip(refs).zip([start, end]) {
                    if slot.as_str() != &**known {
                        self.attribute(element, name, Some(slot));
                    }
                }
            }
            (Anchor::Parent { .. }, None) => {
                let above = |transcript: &'w Transcript, place: AnnotationAddress| {
                    let parent = transcript.annotation(place)?.parent?;
                    Some(transcript.annotation(parent)?.id.as_str())
                };
                let parent = above(self.after, new);
                if above(self.before, old) != parent {
                    self.attribute(element, "ANNOTATION_REF", Some(parent?));
                }
                if previous != next {
                    self.attribute(element, "PREVIOUS_ANNOTATION", next);
                }
            }
            _ => return None,
        }
        Some(())
    }

    /// Returns the lines of a new annotation.
    fn block(
        &self,
        place: AnnotationAddress,
        refs: &Refs,
        previous: &HashMap<AnnotationAddress, &str>,
        indent: &str,
    ) -> Option<String> {
        let it = self.wanted(place);
        let anchor = if is_alignable(self.after, place.tier) {
            let [start, end] = refs.get(&place)?.clone();
            Anchor::Slots {
                start: start.into(),
                end: end.into(),
            }
        } else {
            Anchor::Parent {
                parent: self.after.annotation(it.parent?)?.id.as_str().into(),
                previous: previous.get(&place).map(|id| (*id).into()),
            }
        };
        let raw = raw::Annotation {
            id: it.id.as_str().into(),
            anchor,
            value: it.value.as_str().into(),
            entry: it.entry.as_deref().map(Into::into),
            external_ref: it.external_ref.as_deref().map(Into::into),
            language: it.language.as_deref().map(Into::into),
            svg: None,
            kept: None,
            at: At::default(),
        };
        written(self.style, indent, |xml| write::annotation(&raw, xml))
    }

    /// Removes tiers, adds tiers with their annotations, and changes the attributes of the others.
    pub(super) fn tiers(
        &mut self,
        new: &Document<'_>,
        old: &Document<'_>,
        refs: &Refs,
    ) -> Option<()> {
        let order = self.from.iter().flatten();
        if !order.is_sorted() {
            return None;
        }
        let element = |work: &Self, old: usize| {
            let at = work.document.tiers[old].at.0 as usize;
            work.layout.starting(at)
        };
        for at in 0..self.tiers.len() {
            if self.tiers[at].is_none() {
                let span = self.layout.lines(element(self, at)?);
                self.edits.remove(span);
            }
        }
        let previous = before_each(self.after);
        let root = self.root()?;
        let mut last = self.layout.child(root, "TIME_ORDER");
        let mut added: BTreeMap<Option<usize>, Vec<String>> = BTreeMap::new();
        for at in 0..new.tiers.len() {
            if let Some(from) = self.from[at] {
                let own = element(self, from)?;
                last = Some(own);
                self.attributes_of(own, &bare(&old.tiers[from]), &bare(&new.tiers[at]))?;
                continue;
            }
            let indent = self.indent_in(root);
            let inner = format!("{indent}{}", self.style.unit);
            let mut text = written(self.style, &indent, |xml| {
                write::tier(&bare(&new.tiers[at]), xml)
            })?;
            let mut blocks = String::new();
            for index in 0..self.after.tiers[at].annotations.len() {
                let place = AnnotationAddress { tier: at, index };
                let block = self.block(place, refs, &previous, &inner)?;
                blocks.push_str(&format!("{}{inner}{block}", self.style.newline));
            }
            if !blocks.is_empty() {
                let tag = text.strip_suffix(self.style.close())?;
                text = format!("{tag}>{blocks}{}{indent}</TIER>", self.style.newline);
            }
            added.entry(last).or_default().push(text);
        }
        for (after, blocks) in added {
            self.insert(root, after, &blocks);
        }
        Some(())
    }

    pub(super) fn root(&self) -> Option<usize> {
        let all = 0..self.layout.elements.len();
        all.take(1)
            .find(|it| self.layout.elements[*it].parent.is_none())
    }
}

fn bare<'t>(tier: &raw::Tier<'t>) -> raw::Tier<'t> {
    raw::Tier {
        annotations: Vec::new(),
        kept: None,
        ..tier.clone()
    }
}

/// Returns for each annotation of a chain below a symbolic parent the id of the one before it.
fn before_each(transcript: &Transcript) -> HashMap<AnnotationAddress, &str> {
    let mut found = HashMap::new();
    for (tier, it) in transcript.tiers.iter().enumerate() {
        if it.stereotype != Some(Stereotype::SymbolicSubdivision) {
            continue;
        }
        let mut chain: Vec<usize> = (0..it.annotations.len()).collect();
        chain.sort_by_key(|index| (it.annotations[*index].parent, it.annotations[*index].order));
        for pair in chain.windows(2) {
            let (before, own) = (&it.annotations[pair[0]], &it.annotations[pair[1]]);
            if before.parent == own.parent {
                let index = pair[1];
                found.insert(AnnotationAddress { tier, index }, before.id.as_str());
            }
        }
    }
    found
}
