//! Everything but annotations: properties, media, tier types, vocabularies, references.

use super::Work;
use crate::eaf::layout::Layout;
use crate::eaf::model::Vocabulary;
use crate::eaf::output::{Output, written};
use crate::eaf::raw::{self, Document};
use crate::eaf::style::Style;
use crate::eaf::write;
use std::collections::{BTreeMap, BTreeSet};
use std::io;

/// An element in two spellings: ELAN's, which is used for comparison, and the file's.
struct TwoSpellings {
    plain: String,
    written: String,
}

type Writer<'x> = Output<'x, Vec<u8>>;

impl Work<'_, '_> {
    /// Changes everything but tiers from its state in the old document to that in the new one.
    pub(super) fn parts(&mut self, old: &Document<'_>, new: &Document<'_>) -> Option<()> {
        let root = self.root()?;
        if old.author != new.author {
            self.attribute(root, "AUTHOR", Some(&new.author));
        }
        let header = self.layout.child(root, "HEADER");
        if let Some(header) = header {
            let indent = self.indent_in(header);
            let media = |it: &raw::Document<'_>| {
                let all = it.header.media.iter();
                self.rendered(&indent, all, write::media)
            };
            let (before, after) = (media(old)?, media(new)?);
            let counts = self.has_counter(header);
            let property = |it: &raw::Document<'_>| {
                let all = it.header.properties.iter();
                let counter = Some("lastUsedAnnotationId");
                let all = all.filter(|it| counts || it.name.as_deref() != counter);
                self.rendered(&indent, all, write::property)
            };
            let properties = (property(old)?, property(new)?);
            self.list(
                header,
                ("MEDIA_DESCRIPTOR", "MEDIA_URL"),
                (before, after),
                &[],
            )?;
            let places = ["MEDIA_DESCRIPTOR", "LINKED_FILE_DESCRIPTOR"];
            self.list(header, ("PROPERTY", "NAME"), properties, &places)?;
        } else if old.header != new.header {
            return None;
        }
        self.of_root(root, old, new)
    }

    fn of_root(&mut self, root: usize, old: &Document<'_>, new: &Document<'_>) -> Option<()> {
        const ORDER: [&str; 8] = [
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
                (
                    self.rendered(&indent, old.$field.iter(), $write)?,
                    self.rendered(&indent, new.$field.iter(), $write)?,
                )
            };
        }
        let kinds = both!(linguistic_types, write::linguistic_type);
        self.list(
            root,
            ("LINGUISTIC_TYPE", "LINGUISTIC_TYPE_ID"),
            kinds,
            &ORDER[..2],
        )?;
        let locales = both!(locales, write::locale);
        self.list(root, ("LOCALE", "LANGUAGE_CODE"), locales, &ORDER[..3])?;
        let languages = both!(languages, write::language);
        self.list(root, ("LANGUAGE", "LANG_ID"), languages, &ORDER[..4])?;
        self.constraints(root, old, new, &ORDER[..5])?;
        if old.vocabularies != new.vocabularies {
            let legacy = (0..self.layout.elements.len())
                .any(|it| matches!(self.layout.name(it), "CV_ENTRY"));
            if legacy || self.document.version.as_ref() < "2.8" {
                self.old_vocabularies(root)?;
            } else {
                let all = both!(vocabularies, write::vocabulary);
                self.list(root, ("CONTROLLED_VOCABULARY", "CV_ID"), all, &ORDER[..6])?;
            }
        }
        let references = both!(external_refs, write::external_ref);
        self.list(root, ("EXTERNAL_REF", "EXT_REF_ID"), references, &ORDER)
    }

    /// Adds entries to vocabularies of a format before 2.8, one line for each; other changes are more than lines.
    fn old_vocabularies(&mut self, root: usize) -> Option<()> {
        let (before, after) = (&self.before.vocabularies, &self.after.vocabularies);
        if before.len() != after.len() {
            return None;
        }
        for (old, new) in before.iter().zip(after) {
            let (first, added) = new.entries.split_at_checked(old.entries.len())?;
            let without = Vocabulary {
                entries: first.to_vec(),
                ..new.clone()
            };
            if without != *old {
                return None;
            }
            if added.is_empty() {
                continue;
            }
            let mut all = self.layout.children(root, "CONTROLLED_VOCABULARY");
            let element = all.find(|it| {
                let own = self.layout.attribute(*it, "CV_ID");
                own.is_some_and(|own| self.layout.text[own.value] == *old.id)
            })?;
            let last = self.layout.children(element, "CV_ENTRY").last();
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
                    let kept = raw::Kept::default();
                    written(self.style, &indent, |xml| {
                        xml.text("CV_ENTRY", &pairs, &kept, &value.value)
                    })
                })
                .collect();
            self.insert(element, last, &lines?);
        }
        Some(())
    }

    /// Adds the stereotypes that tier types need and the file lacks.
    fn constraints(
        &mut self,
        root: usize,
        old: &Document<'_>,
        new: &Document<'_>,
        places: &[&str],
    ) -> Option<()> {
        let used = |it: &Document<'_>| -> BTreeSet<String> {
            let all = it.linguistic_types.iter();
            all.filter_map(|kind| kind.constraints.as_deref().map(str::to_owned))
                .collect()
        };
        let there = &self.document.constraints;
        let needed: Vec<String> = used(new)
            .difference(&used(old))
            .filter(|name| there.iter().all(|it| it.stereotype != name.as_str()))
            .cloned()
            .collect();
        let all = new.constraints.iter();
        let all = all.filter(|it| needed.iter().any(|name| it.stereotype == name.as_str()));
        let parts = self.rendered(&self.indent_in(root), all, write::constraint)?;
        self.list(
            root,
            ("CONSTRAINT", "STEREOTYPE"),
            (Vec::new(), parts),
            places,
        )
    }

    fn has_counter(&self, header: usize) -> bool {
        let mut all = self.layout.children(header, "PROPERTY");
        all.any(|it| {
            let name = self.layout.attribute(it, "NAME");
            name.is_some_and(|name| &self.layout.text[name.value] == "lastUsedAnnotationId")
        })
    }

    fn rendered<'p, T: 'p>(
        &self,
        indent: &str,
        all: impl Iterator<Item = &'p T>,
        write: impl Fn(&T, &mut Writer<'_>) -> io::Result<()>,
    ) -> Option<Vec<TwoSpellings>> {
        let elan = Style::elan();
        all.map(|it| {
            Some(TwoSpellings {
                plain: written(&elan, "", |xml| write(it, xml))?,
                written: written(self.style, indent, |xml| write(it, xml))?,
            })
        })
        .collect()
    }

    /// Brings a list of elements with keys from one state to another.
    fn list(
        &mut self,
        container: usize,
        (name, key): (&str, &str),
        (old, new): (Vec<TwoSpellings>, Vec<TwoSpellings>),
        places: &[&str],
    ) -> Option<()> {
        if old
            .iter()
            .map(|it| &it.plain)
            .eq(new.iter().map(|it| &it.plain))
        {
            return Some(());
        }
        let keyed = |parts: Vec<TwoSpellings>| -> Option<BTreeMap<String, TwoSpellings>> {
            let count = parts.len();
            let all = parts.into_iter().map(|it| (key_of(&it.plain, key), it));
            let all: BTreeMap<String, TwoSpellings> = all.collect();
            (all.len() == count).then_some(all)
        };
        let order: Vec<String> = new.iter().map(|it| key_of(&it.plain, key)).collect();
        let (old, new) = (keyed(old)?, keyed(new)?);
        let mut there: BTreeMap<String, usize> = BTreeMap::new();
        let found: Vec<usize> = self.layout.children(container, name).collect();
        for element in found {
            let own = self.layout.attribute(element, key);
            let own = own.map_or("", |it| &self.layout.text[it.value]);
            if there.insert(own.to_owned(), element).is_some() {
                return None;
            }
        }
        for (own, part) in &old {
            let element = there.get(own);
            match new.get(own) {
                None => {
                    let span = self.layout.lines(*element?);
                    self.edits.remove(span);
                }
                Some(other) if other.plain != part.plain => self.morph(*element?, part, other)?,
                Some(_) => {}
            }
        }
        let last = there.values().max().copied().or_else(|| {
            let known = |it: &&usize| places.contains(&self.layout.name(**it));
            let children = &self.layout.elements[container].children;
            children.iter().rev().find(known).copied()
        });
        let added: Vec<String> = order
            .iter()
            .filter(|own| !old.contains_key(*own))
            .map(|own| new[own].written.clone())
            .collect();
        self.insert(container, last, &added);
        Some(())
    }

    /// Changes an element: attribute by attribute and its text; vocabularies entry by entry.
    fn morph(&mut self, element: usize, old: &TwoSpellings, new: &TwoSpellings) -> Option<()> {
        let (before, after) = (Layout::of(&old.plain)?, Layout::of(&new.plain)?);
        self.attributes_between(element, &before, &after);
        let inner = |layout: &Layout<'_>| layout.text[layout.elements[0].inner.clone()].to_owned();
        if inner(&before) == inner(&after) {
            return Some(());
        }
        let plain = |layout: &Layout<'_>| layout.elements[0].children.is_empty();
        if plain(&before) && plain(&after) && self.layout.name(element) != "CONTROLLED_VOCABULARY" {
            let text = quick_xml::escape::unescape(&inner(&after))
                .ok()?
                .into_owned();
            self.text(element, &text);
            return Some(());
        }
        let others = |layout: &Layout<'_>| -> Vec<String> {
            let children = layout.elements[0].children.iter();
            let children = children.filter(|it| layout.name(**it) != "CV_ENTRY_ML");
            children
                .map(|it| layout.text[layout.elements[*it].span.clone()].to_owned())
                .collect()
        };
        if others(&before) != others(&after) {
            return None;
        }
        let entries = |layout: &Layout<'_>| -> Vec<TwoSpellings> {
            let indent = self.indent_in(element);
            let children = layout.children(0, "CV_ENTRY_ML");
            let text = |it: usize| layout.text[layout.elements[it].span.clone()].to_owned();
            let part = |plain: String| {
                let lines = plain
                    .lines()
                    .map(|line| line.strip_prefix("    ").unwrap_or(line));
                let newline = format!("{}{indent}", self.style.newline);
                let written = lines.collect::<Vec<_>>().join(&newline);
                TwoSpellings { plain, written }
            };
            children.map(text).map(part).collect()
        };
        let both = (entries(&before), entries(&after));
        self.list(element, ("CV_ENTRY_ML", "CVE_ID"), both, &["DESCRIPTION"])
    }

    /// Changes the attributes of a tier.
    pub(super) fn attributes_of(
        &mut self,
        element: usize,
        old: &raw::Tier<'_>,
        new: &raw::Tier<'_>,
    ) -> Option<()> {
        let elan = Style::elan();
        let text = |tier| written(&elan, "", |xml| write::tier(tier, xml));
        let (old, new) = (text(old)?, text(new)?);
        let (before, after) = (Layout::of(&old)?, Layout::of(&new)?);
        self.attributes_between(element, &before, &after);
        Some(())
    }

    fn attributes_between(&mut self, element: usize, before: &Layout<'_>, after: &Layout<'_>) {
        let all = |layout: &Layout<'_>| -> BTreeMap<String, String> {
            let found = layout.attributes(0).into_iter();
            let value = |raw: &str| {
                let plain = quick_xml::escape::unescape(raw);
                plain.map_or_else(|_| raw.to_owned(), std::borrow::Cow::into_owned)
            };
            found
                .map(|it| {
                    (
                        layout.text[it.name].to_owned(),
                        value(&layout.text[it.value]),
                    )
                })
                .collect()
        };
        let (before, after) = (all(before), all(after));
        let names: BTreeSet<&String> = before.keys().chain(after.keys()).collect();
        for name in names {
            if before.get(name) != after.get(name) {
                self.attribute(element, name, after.get(name).map(String::as_str));
            }
        }
    }
}

fn key_of(text: &str, key: &str) -> String {
    let layout = Layout::of(text);
    let found = layout.and_then(|it| {
        let value = it.attribute(0, key)?.value;
        Some(text[value].to_owned())
    });
    found.unwrap_or_default()
}
