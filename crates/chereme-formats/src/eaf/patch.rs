//! Changes an EAF file in the layout in which it was found: unchanged parts keep their bytes.

mod annotations;
mod parts;
mod same;
mod slots;

pub use same::same_meaning;

use super::Error;
use super::back::to_raw;
use super::convert::from_raw_placed;
use super::encoding::decode;
use super::layout::{Edits, Layout};
use super::model::{Annotation, AnnotationAddress, Timing, Transcript};
use super::raw::{self, Document};
use super::style::Style;
use chereme_sign::Stereotype;
use std::collections::{BTreeMap, HashMap};

/// Returns the file `bytes`, changed so that it means `after`; the same bytes if it does already.
///
/// A changed annotation changes its own lines and time slots; line ends, quotes, entities, the order of
/// attributes, the encoding, comments and all that EAF does not define stay as they are. The date stays, too, and
/// `lastUsedAnnotationId` rises if the file counts it. `None` stands for a change that is more than lines, such
/// as a new vocabulary in a format before 2.8 or another order of tiers: then the file has to be
/// [written](raw::write) whole.
///
/// # Errors
/// The same as [`read`](super::read)'s.
pub fn patched(bytes: &[u8], after: &Transcript) -> Result<Option<Vec<u8>>, Error> {
    let decoded = decode(bytes)?;
    let (document, _) = raw::read(decoded.text.as_bytes())?;
    let (before, places, _) = from_raw_placed(&document);
    if same_meaning(&before, after) {
        return Ok(Some(bytes.to_vec()));
    }
    let Some(changed) = change(&document, (&before, &places), after) else {
        return Ok(None);
    };
    let changed = decoded.encoding.bytes(&changed);
    let (meant, _) = super::read(&changed)?;
    Ok(same_meaning(&meant, after).then_some(changed))
}

fn change(
    document: &Document<'_>,
    (before, places): (&Transcript, &[Option<AnnotationAddress>]),
    after: &Transcript,
) -> Option<String> {
    let layout = Layout::of(document.source.0)?;
    let style = Style::of(&layout);
    let tiers = matched(before, after);
    let mut work = Work {
        layout: &layout,
        style: &style,
        document,
        before,
        after,
        places,
        from: from(&tiers, after.tiers.len()),
        found: ids(after),
        tiers,
        edits: Edits::default(),
    };
    let refs = work.slots()?;
    work.annotations(&refs)?;
    let (old, new) = (to_raw(before, document), to_raw(after, document));
    work.tiers(&new, &old, &refs)?;
    work.parts(&old, &new)?;
    work.edits.apply(document.source.0)
}

/// The names of the two time slots of alignable annotations, by their place in the new transcript.
type Refs = HashMap<AnnotationAddress, [String; 2]>;

/// A change of a file: its document, its present meaning, and the wanted meaning.
struct Work<'w, 'd> {
    layout: &'w Layout<'d>,
    style: &'w Style,
    document: &'w Document<'d>,
    before: &'w Transcript,
    after: &'w Transcript,
    /// The place of each annotation of the document.
    places: &'w [Option<AnnotationAddress>],
    /// The new tier of each old one.
    tiers: Vec<Option<usize>>,
    /// The old tier of each new one.
    from: Vec<Option<usize>>,
    /// The new annotations by their ids.
    found: BTreeMap<&'w str, AnnotationAddress>,
    edits: Edits,
}

impl<'w, 'd> Work<'w, 'd> {
    /// Returns the new place of an old annotation; `None` if it was removed or went to another tier.
    fn kept(&self, old: AnnotationAddress) -> Option<AnnotationAddress> {
        let it = self.before.annotation(old)?;
        let new = *self.found.get(it.id.as_str())?;
        (self.tiers[old.tier] == Some(new.tier)).then_some(new)
    }

    fn wanted(&self, place: AnnotationAddress) -> &'w Annotation {
        &self.after.tiers[place.tier].annotations[place.index]
    }

    /// Returns the annotations of the document with their elements and old places.
    fn annotations_of_file(
        &self,
    ) -> Vec<(Option<AnnotationAddress>, usize, &'w raw::Annotation<'d>)> {
        let (document, layout) = (self.document, self.layout);
        let all = document.tiers.iter().flat_map(|it| &it.annotations);
        all.zip(self.places)
            .filter_map(|(it, place)| Some((*place, layout.starting(it.at.0 as usize)?, it)))
            .collect()
    }

    /// Adds elements to a container: after one of its children, or before all of them.
    fn insert(&mut self, container: usize, after: Option<usize>, blocks: &[String]) {
        if blocks.is_empty() {
            return;
        }
        let it = &self.layout.elements[container];
        let newline = self.style.newline;
        let indent = self.indent_in(container);
        let text: String = blocks
            .iter()
            .map(|block| format!("{newline}{indent}{block}"))
            .collect();
        let outer = self.layout.indent(container).unwrap_or_default();
        if let Some(child) = after {
            let end = self.layout.elements[child].span.end;
            self.edits.insert(end, text);
        } else if it.empty {
            let name = self.layout.name(container);
            let tag = &self.layout.text[it.span.start..it.inner.start];
            let start = it.span.start + tag.trim_ascii_end().len();
            let text = format!(">{text}{newline}{outer}</{name}>");
            self.edits.replace(start..it.span.end, text);
        } else if it.children.is_empty() && !self.layout.text[it.inner.clone()].contains('\n') {
            self.edits
                .insert(it.inner.start, format!("{text}{newline}{outer}"));
        } else {
            self.edits.insert(it.inner.start, text);
        }
    }

    /// Returns the indentation of the elements of a container.
    fn indent_in(&self, container: usize) -> String {
        if self.style.newline.is_empty() {
            return String::new();
        }
        let first = self.layout.elements[container].children.first();
        if let Some(indent) = first.and_then(|child| self.layout.indent(*child)) {
            return indent.to_owned();
        }
        let outer = self.layout.indent(container).unwrap_or_default();
        format!("{outer}{}", self.style.unit)
    }

    /// Writes, replaces or removes an attribute.
    fn attribute(&mut self, element: usize, name: &str, value: Option<&str>) {
        let known = self.layout.attribute(element, name);
        match (known, value) {
            (Some(known), Some(value)) => {
                let quote = char::from(self.layout.text.as_bytes()[known.value.end]);
                let value = self.style.escape(value, Some(quote));
                self.edits.replace(known.value, value);
            }
            (Some(known), None) => {
                let before = &self.layout.text[..known.name.start];
                let start = before.trim_ascii_end().len();
                self.edits.remove(start..known.value.end + 1);
            }
            (None, Some(value)) => {
                let all = self.layout.attributes(element);
                let before = all
                    .iter()
                    .take_while(|it| self.layout.text[it.name.clone()] < *name)
                    .last();
                let end = before.map_or(self.layout.elements[element].name.end, |it| {
                    it.value.end + 1
                });
                let written = self.style.attribute(name, value);
                self.edits.insert(end, format!(" {written}"));
            }
            (None, None) => {}
        }
    }

    /// Replaces the text of an element.
    fn text(&mut self, element: usize, text: &str) {
        let it = &self.layout.elements[element];
        let text = self.style.escape(text, None);
        if !it.empty {
            self.edits.replace(it.inner.clone(), text);
        } else if !text.is_empty() {
            let name = self.layout.name(element);
            let tag = &self.layout.text[it.span.start..it.inner.start];
            let start = it.span.start + tag.trim_ascii_end().len();
            self.edits
                .replace(start..it.span.end, format!(">{text}</{name}>"));
        }
    }
}

/// Returns both ends of an annotation in milliseconds; `None` for an end that was never set.
fn ends(annotation: &Annotation) -> [Option<i64>; 2] {
    let span = [annotation.span.start(), annotation.span.end()];
    let [start, end] = annotation.millis.unwrap_or(span.map(|it| it.millis()));
    match annotation.timing {
        Timing::Proposed {
            start: from,
            end: to,
        } => [(!from).then_some(start), (!to).then_some(end)],
        _ => [Some(start), Some(end)],
    }
}

fn is_alignable(transcript: &Transcript, tier: usize) -> bool {
    let stereotype = transcript.tiers[tier].stereotype;
    stereotype.is_none_or(Stereotype::is_alignable)
}

fn ids(transcript: &Transcript) -> BTreeMap<&str, AnnotationAddress> {
    let mut found = BTreeMap::new();
    for (tier, it) in transcript.tiers.iter().enumerate() {
        for (index, annotation) in it.annotations.iter().enumerate() {
            found.insert(annotation.id.as_str(), AnnotationAddress { tier, index });
        }
    }
    found
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
fn matched(before: &Transcript, after: &Transcript) -> Vec<Option<usize>> {
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
    let found = ids(after);
    for (old, tier) in before.tiers.iter().enumerate() {
        if tiers[old].is_some() {
            continue;
        }
        let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
        for annotation in &tier.annotations {
            if let Some(place) = found.get(annotation.id.as_str()) {
                *counts.entry(place.tier).or_default() += 1;
            }
        }
        let most = counts
            .into_iter()
            .filter(|(tier, _)| !tiers.contains(&Some(*tier)))
            .max_by_key(|(tier, count)| (*count, usize::MAX - tier));
        tiers[old] = most
            .filter(|(_, count)| 2 * count > tier.annotations.len())
            .map(|(tier, _)| tier);
    }
    tiers
}
