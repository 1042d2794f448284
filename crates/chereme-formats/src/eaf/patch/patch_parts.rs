//! Everything but annotations: properties, media, tier types, vocabularies, references.

use super::EafPatchWork;
use crate::eaf::eaf_layout::EafLayout;
use crate::eaf::eaf_output::{XmlOutput, render_eaf_elements};
use crate::eaf::eaf_raw::{
    self, EafConstraint, EafDocument, EafLanguage, EafLocale, ExternalRef, LinguisticType, MediaDescriptor,
};
use crate::eaf::eaf_write;
use crate::eaf::style::EafSpelling;
use crate::transcript::ControlledVocabulary;
use std::collections::{BTreeMap, BTreeSet};
use std::io;

/// An element in two spellings: ELAN's, which is used for comparison, and the file's.
struct TwoSpellings {
    plain: String,
    written: String,
}

/// A list of elements of one kind before and after a change.
struct ChangedList {
    before: Vec<TwoSpellings>,
    after: Vec<TwoSpellings>,
}

type XmlBufferOutput<'x> = XmlOutput<'x, Vec<u8>>;

impl EafPatchWork<'_, '_> {
    /// Changes everything but tiers from its state in the old document to that in the new one.
    pub(super) fn patch_document_parts(&mut self, old: &EafDocument<'_>, new: &EafDocument<'_>) -> Option<()> {
        let root = self.root_layout_element()?;
        if old.author != new.author {
            self.patch_element_attribute(root, "AUTHOR", Some(&new.author));
        }
        let header = self.layout.first_child_named(root, "HEADER");
        if let Some(header) = header {
            let indent = self.indent_in(header);
            let media = |document: &eaf_raw::EafDocument<'_>| {
                let all = document.header.media.iter();
                self.rendered(&indent, all, MediaDescriptor::write_leaf)
            };
            let descriptors = ChangedList {
                before: media(old)?,
                after: media(new)?,
            };
            let counts = self.has_counter(header);
            let property = |document: &eaf_raw::EafDocument<'_>| {
                let all = document.header.properties.iter();
                let counter = Some("lastUsedAnnotationId");
                let all = all.filter(|property| counts || property.name.as_deref() != counter);
                self.rendered(&indent, all, eaf_write::write_eaf_property)
            };
            let properties = ChangedList {
                before: property(old)?,
                after: property(new)?,
            };
            self.patch_keyed_list(header, "MEDIA_DESCRIPTOR", "MEDIA_URL", descriptors, &[])?;
            let places = ["MEDIA_DESCRIPTOR", "LINKED_FILE_DESCRIPTOR"];
            self.patch_keyed_list(header, "PROPERTY", "NAME", properties, &places)?;
        } else if old.header != new.header {
            return None;
        }
        self.of_root(root, old, new)
    }

    fn of_root(&mut self, root: usize, old: &EafDocument<'_>, new: &EafDocument<'_>) -> Option<()> {
        const ROOT_CHILD_ORDER: [&str; 8] = [
            "TIME_ORDER",
            "TIER",
            "LINGUISTIC_TYPE",
            "LOCALE",
            "LANGUAGE",
            "CONSTRAINT",
            "CONTROLLED_VOCABULARY",
            "LEXICON_REF",
        ];
        let indent = self.indent_in(root);
        macro_rules! both {
            ($field:ident, $write:path) => {
                ChangedList {
                    before: self.rendered(&indent, old.$field.iter(), $write)?,
                    after: self.rendered(&indent, new.$field.iter(), $write)?,
                }
            };
        }
        let kinds = both!(linguistic_types, LinguisticType::write_leaf);
        self.patch_keyed_list(
            root,
            "LINGUISTIC_TYPE",
            "LINGUISTIC_TYPE_ID",
            kinds,
            &ROOT_CHILD_ORDER[..2],
        )?;
        let locales = both!(locales, EafLocale::write_leaf);
        self.patch_keyed_list(root, "LOCALE", "LANGUAGE_CODE", locales, &ROOT_CHILD_ORDER[..3])?;
        let languages = both!(languages, EafLanguage::write_leaf);
        self.patch_keyed_list(root, "LANGUAGE", "LANG_ID", languages, &ROOT_CHILD_ORDER[..4])?;
        self.constraints(root, old, new, &ROOT_CHILD_ORDER[..5])?;
        if old.vocabularies != new.vocabularies {
            let legacy = (0..self.layout.elements.len())
                .any(|child| matches!(self.layout.layout_element_name(child), "CV_ENTRY"));
            if legacy || self.document.version.as_ref() < "2.8" {
                self.old_vocabularies(root)?;
            } else {
                let all = both!(vocabularies, eaf_write::write_eaf_vocabulary);
                self.patch_keyed_list(root, "CONTROLLED_VOCABULARY", "CV_ID", all, &ROOT_CHILD_ORDER[..6])?;
            }
        }
        let references = both!(external_refs, ExternalRef::write_leaf);
        self.patch_keyed_list(root, "EXTERNAL_REF", "EXT_REF_ID", references, &ROOT_CHILD_ORDER)
    }

    /// Adds entries to vocabularies of a format before 2.8, one line for each; other changes are more than lines.
    fn old_vocabularies(&mut self, root: usize) -> Option<()> {
        let (before, after) = (&self.before.vocabularies, &self.after.vocabularies);
        if before.len() != after.len() {
            return None;
        }
        for (old, new) in before.iter().zip(after) {
            let (first, added) = new.entries.split_at_checked(old.entries.len())?;
            let without = ControlledVocabulary {
                entries: first.to_vec(),
                ..new.clone()
            };
            if without != *old {
                return None;
            }
            if added.is_empty() {
                continue;
            }
            let mut all = self.layout.children_named(root, "CONTROLLED_VOCABULARY");
            let element = all.find(|candidate| {
                let id_attribute = self.layout.find_element_attribute(*candidate, "CV_ID");
                id_attribute.is_some_and(|own| self.layout.text[own.value] == *old.id)
            })?;
            let last = self.layout.children_named(element, "CV_ENTRY").last();
            let indent = self.indent_in(element);
            let lines: Option<Vec<String>> = added
                .iter()
                .map(|entry| {
                    let [value] = entry.values.as_slice() else {
                        return None;
                    };
                    let pairs = [
                        ("DESCRIPTION", value.description.as_deref()),
                        ("EXT_REF", entry.external_ref.as_deref()),
                        ("ID", Some(entry.id.as_str()).filter(|id| !id.is_empty())),
                    ];
                    let kept = eaf_raw::KeptContents::default();
                    render_eaf_elements(self.style, &indent, |xml| {
                        xml.write_text_element("CV_ENTRY", &pairs, &kept, &value.value)
                    })
                })
                .collect();
            self.insert_container_elements(element, last, &lines?);
        }
        Some(())
    }

    /// Adds the stereotypes that tier types need and the file lacks.
    fn constraints(
        &mut self,
        root: usize,
        old: &EafDocument<'_>,
        new: &EafDocument<'_>,
        places: &[&str],
    ) -> Option<()> {
        let used = |document: &EafDocument<'_>| -> BTreeSet<String> {
            let all = document.linguistic_types.iter();
            all.filter_map(|kind| kind.constraints.as_deref().map(str::to_owned))
                .collect()
        };
        let there = &self.document.constraints;
        let needed: Vec<String> = used(new)
            .difference(&used(old))
            .filter(|name| there.iter().all(|constraint| constraint.stereotype != name.as_str()))
            .cloned()
            .collect();
        let all_constraints = new.constraints.iter();
        let all = all_constraints.filter(|constraint| needed.iter().any(|name| constraint.stereotype == name.as_str()));
        let parts = self.rendered(&self.indent_in(root), all, EafConstraint::write_leaf)?;
        let added = ChangedList {
            before: Vec::new(),
            after: parts,
        };
        self.patch_keyed_list(root, "CONSTRAINT", "STEREOTYPE", added, places)
    }

    fn has_counter(&self, header: usize) -> bool {
        let mut all = self.layout.children_named(header, "PROPERTY");
        all.any(|element| {
            let name = self.layout.find_element_attribute(element, "NAME");
            name.is_some_and(|name| &self.layout.text[name.value] == "lastUsedAnnotationId")
        })
    }

    fn rendered<'p, T: 'p>(
        &self,
        indent: &str,
        all: impl Iterator<Item = &'p T>,
        write: impl Fn(&T, &mut XmlBufferOutput<'_>) -> io::Result<()>,
    ) -> Option<Vec<TwoSpellings>> {
        let elan = EafSpelling::elan_spelling();
        all.map(|item| {
            Some(TwoSpellings {
                plain: render_eaf_elements(&elan, "", |xml| write(item, xml))?,
                written: render_eaf_elements(self.style, indent, |xml| write(item, xml))?,
            })
        })
        .collect()
    }

    /// Brings a list of elements with keys from one state to another.
    fn patch_keyed_list(
        &mut self,
        container: usize,
        name: &str,
        key: &str,
        list: ChangedList,
        places: &[&str],
    ) -> Option<()> {
        let ChangedList { before, after } = list;
        if before
            .iter()
            .map(|part| &part.plain)
            .eq(after.iter().map(|part| &part.plain))
        {
            return Some(());
        }
        let keyed = |parts: Vec<TwoSpellings>| -> Option<BTreeMap<String, TwoSpellings>> {
            let count = parts.len();
            let keyed_parts = parts.into_iter().map(|part| (key_of(&part.plain, key), part));
            let all: BTreeMap<String, TwoSpellings> = keyed_parts.collect();
            (all.len() == count).then_some(all)
        };
        let order: Vec<String> = after.iter().map(|part| key_of(&part.plain, key)).collect();
        let (old, new) = (keyed(before)?, keyed(after)?);
        let mut there: BTreeMap<String, usize> = BTreeMap::new();
        let child_elements: Vec<usize> = self.layout.children_named(container, name).collect();
        for element in child_elements {
            let key_attribute = self.layout.find_element_attribute(element, key);
            let element_key = key_attribute.map_or("", |attribute| &self.layout.text[attribute.value]);
            if there.insert(element_key.to_owned(), element).is_some() {
                return None;
            }
        }
        for (own, part) in &old {
            let element = there.get(own);
            match new.get(own) {
                None => {
                    let span = self.layout.element_line_span(*element?);
                    self.edits.remove_text_span(span);
                }
                Some(other) if other.plain != part.plain => self.morph(*element?, part, other)?,
                Some(_) => {}
            }
        }
        let last = there.values().max().copied().or_else(|| {
            let is_listed = |element: &&usize| places.contains(&self.layout.layout_element_name(**element));
            let children = &self.layout.elements[container].children;
            children.iter().rev().find(is_listed).copied()
        });
        let added: Vec<String> = order
            .iter()
            .filter(|own| !old.contains_key(*own))
            .map(|own| new[own].written.clone())
            .collect();
        self.insert_container_elements(container, last, &added);
        Some(())
    }

    /// Changes an element: attribute by attribute and its text; vocabularies entry by entry.
    fn morph(&mut self, element: usize, old: &TwoSpellings, new: &TwoSpellings) -> Option<()> {
        let (before, after) = (
            EafLayout::layout_from_text(&old.plain)?,
            EafLayout::layout_from_text(&new.plain)?,
        );
        self.attributes_between(element, &before, &after);
        let inner = |layout: &EafLayout<'_>| layout.text[layout.elements[0].inner.clone()].to_owned();
        if inner(&before) == inner(&after) {
            return Some(());
        }
        let plain = |layout: &EafLayout<'_>| layout.elements[0].children.is_empty();
        if plain(&before) && plain(&after) && self.layout.layout_element_name(element) != "CONTROLLED_VOCABULARY" {
            let text = quick_xml::escape::unescape(&inner(&after)).ok()?.into_owned();
            self.patch_element_text(element, &text);
            return Some(());
        }
        let others = |layout: &EafLayout<'_>| -> Vec<String> {
            let child_indices = layout.elements[0].children.iter();
            let children = child_indices.filter(|child| layout.layout_element_name(**child) != "CV_ENTRY_ML");
            children
                .map(|child| layout.text[layout.elements[*child].span.clone()].to_owned())
                .collect()
        };
        if others(&before) != others(&after) {
            return None;
        }
        let entries = |layout: &EafLayout<'_>| -> Vec<TwoSpellings> {
            let indent = self.indent_in(element);
            let children = layout.children_named(0, "CV_ENTRY_ML");
            let text = |index: usize| layout.text[layout.elements[index].span.clone()].to_owned();
            let part = |plain: String| {
                let lines = plain.lines().map(|line| line.strip_prefix("    ").unwrap_or(line));
                let newline = format!("{}{indent}", self.style.newline);
                let written = lines.collect::<Vec<_>>().join(&newline);
                TwoSpellings { plain, written }
            };
            children.map(text).map(part).collect()
        };
        let values = ChangedList {
            before: entries(&before),
            after: entries(&after),
        };
        self.patch_keyed_list(element, "CV_ENTRY_ML", "CVE_ID", values, &["DESCRIPTION"])
    }

    /// Changes the attributes of a tier.
    pub(super) fn attributes_of(
        &mut self,
        element: usize,
        old: &eaf_raw::EafTier<'_>,
        new: &eaf_raw::EafTier<'_>,
    ) -> Option<()> {
        let elan = EafSpelling::elan_spelling();
        let text = |tier| render_eaf_elements(&elan, "", |xml| eaf_write::write_eaf_tier(tier, xml));
        let (old, new) = (text(old)?, text(new)?);
        let (before, after) = (EafLayout::layout_from_text(&old)?, EafLayout::layout_from_text(&new)?);
        self.attributes_between(element, &before, &after);
        Some(())
    }

    fn attributes_between(&mut self, element: usize, before: &EafLayout<'_>, after: &EafLayout<'_>) {
        let all = |layout: &EafLayout<'_>| -> BTreeMap<String, String> {
            let found_attributes = layout.element_attributes(0).into_iter();
            let value = |raw: &str| {
                let plain = quick_xml::escape::unescape(raw);
                plain.map_or_else(|_| raw.to_owned(), std::borrow::Cow::into_owned)
            };
            found_attributes
                .map(|attribute| {
                    (
                        layout.text[attribute.name].to_owned(),
                        value(&layout.text[attribute.value]),
                    )
                })
                .collect()
        };
        let (before, after) = (all(before), all(after));
        let names: BTreeSet<&String> = before.keys().chain(after.keys()).collect();
        for name in names {
            if before.get(name) != after.get(name) {
                self.patch_element_attribute(element, name, after.get(name).map(String::as_str));
            }
        }
    }
}

fn key_of(text: &str, key: &str) -> String {
    let layout = EafLayout::layout_from_text(text);
    let key_text = layout.and_then(|layout| {
        let value = layout.find_element_attribute(0, key)?.value;
        Some(text[value].to_owned())
    });
    key_text.unwrap_or_default()
}
