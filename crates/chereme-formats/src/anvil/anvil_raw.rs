//! The parts of an annotation file of ANVIL: its head, and tracks of elements with attributes.

use super::ANVIL_TOOL;
use crate::markup::{MarkupContents, MarkupElement, MarkupError};

/// An annotation file.
#[derive(Debug)]
pub(super) struct AnvilDocument<'t> {
    /// `specification`: the file of the coding scheme.
    pub(super) specification: Option<&'t str>,
    /// `video` and other elements of the head that name a file, by their names.
    pub(super) media: Vec<(&'t str, &'t str)>,
    /// `info`: keys with their texts.
    pub(super) infos: Vec<(&'t str, &'t str)>,
    /// The tracks in the order of the file.
    pub(super) tracks: Vec<AnvilTrack<'t>>,
    /// `set`: the name, and the number of its elements, which have no times.
    pub(super) sets: Vec<(&'t str, usize)>,
}

/// `track`.
#[derive(Debug)]
pub(super) struct AnvilTrack<'t> {
    /// `name`, with the names of its groups before it: `Gesture.Phase`.
    pub(super) name: &'t str,
    /// `type`: `primary`, `primarypoint`, `singleton`, `span` or `subdivision`.
    pub(super) kind: &'t str,
    /// `ref`: the name of the track that this one refers to.
    pub(super) reference: Option<&'t str>,
    /// `el`, in the order of the file.
    pub(super) elements: Vec<AnvilElement<'t>>,
    /// `el-group`: the index of the element that its elements divide.
    pub(super) groups: Vec<Option<&'t str>>,
    /// The element itself.
    pub(super) source: &'t MarkupElement<'t>,
}

/// `el`.
#[derive(Debug)]
pub(super) struct AnvilElement<'t> {
    /// `index`, by which others refer to it.
    pub(super) index: Option<&'t str>,
    /// `start`: a time in seconds, or the index of an element.
    pub(super) start: Option<&'t str>,
    /// `end`: a time in seconds, or the index of an element.
    pub(super) end: Option<&'t str>,
    /// `time` of a point, in seconds.
    pub(super) time: Option<&'t str>,
    /// `ref`: the index of an element.
    pub(super) reference: Option<&'t str>,
    /// The group of the track that it belongs to.
    pub(super) group: Option<usize>,
    /// `attribute`, in the order of the file.
    pub(super) attributes: Vec<AnvilAttribute<'t>>,
    /// `comment`.
    pub(super) comment: Option<&'t str>,
    /// The element itself.
    pub(super) source: &'t MarkupElement<'t>,
}

/// `attribute`.
#[derive(Debug)]
pub(super) struct AnvilAttribute<'t> {
    /// `name`.
    pub(super) name: &'t str,
    /// Its text.
    pub(super) text: &'t str,
    /// Links to other elements: the track and the index.
    pub(super) links: Vec<(&'t str, &'t str)>,
}

/// Returns what is read of an element.
pub(super) fn anvil_contents(parent: &str, element: &MarkupElement<'_>) -> Option<MarkupContents> {
    Some(match (parent, element.element_name()) {
        ("annotation", "head" | "body") | ("body", "track" | "set") => MarkupContents::Elements,
        ("track", "el" | "el-group") | ("el-group", "el") => MarkupContents::Elements,
        ("head", "info") | ("el", "comment") => MarkupContents::Text,
        ("el", "attribute") => MarkupContents::TextWithElements,
        ("head", "specification") | ("set", _) => MarkupContents::Attributes,
        ("head", _) if element.stated_attribute("src").is_some() => MarkupContents::Attributes,
        ("attribute", _) if anvil_link(element).is_some() => MarkupContents::Attributes,
        _ => return None,
    })
}

impl<'t> AnvilDocument<'t> {
    /// Returns the parts of a file.
    pub(super) fn from_anvil_root(root: &'t MarkupElement<'t>) -> Result<Self, MarkupError> {
        // Other programs call their root <annotation>, too.
        ANVIL_TOOL.check_child_element(root, "body")?;
        let source = |element: &'t MarkupElement<'t>| element.stated_attribute("src");
        let head = root.elements_at(&["head"]).into_iter().flat_map(|head| &head.children);
        let files = head.filter(|child| !["specification", "info"].contains(&child.element_name()));
        let info = |info: &'t MarkupElement<'t>| (info.attribute_text("key"), info.text.trim());
        let set = |set: &'t MarkupElement<'t>| (set.attribute_text("name"), set.children.len());
        let specifications = root.elements_at(&["head", "specification"]);
        Ok(Self {
            specification: specifications.last().and_then(|last| source(last)),
            media: files
                .filter_map(|file| Some((file.element_name(), source(file)?)))
                .collect(),
            infos: root.elements_at(&["head", "info"]).into_iter().map(info).collect(),
            tracks: root
                .elements_at(&["body", "track"])
                .into_iter()
                .map(AnvilTrack::from_element)
                .collect(),
            sets: root.elements_at(&["body", "set"]).into_iter().map(set).collect(),
        })
    }
}

impl<'t> AnvilTrack<'t> {
    fn from_element(source: &'t MarkupElement<'t>) -> Self {
        let (mut elements, mut groups) = (Vec::new(), Vec::new());
        for child in &source.children {
            if child.element_name() == "el" {
                elements.push(AnvilElement::from_element(child, None));
            } else {
                let members = child.children.iter();
                elements.extend(members.map(|member| AnvilElement::from_element(member, Some(groups.len()))));
                groups.push(child.stated_attribute("ref"));
            }
        }
        Self {
            name: source.attribute_text("name"),
            kind: source.attribute_text("type"),
            reference: source.stated_attribute("ref"),
            elements,
            groups,
            source,
        }
    }
}

impl<'t> AnvilElement<'t> {
    fn from_element(source: &'t MarkupElement<'t>, group: Option<usize>) -> Self {
        let attribute = |attribute: &'t MarkupElement<'t>| AnvilAttribute {
            name: attribute.attribute_text("name"),
            text: attribute.text.trim(),
            links: attribute.children.iter().filter_map(anvil_link).collect(),
        };
        Self {
            index: source.stated_attribute("index"),
            start: source.stated_attribute("start"),
            end: source.stated_attribute("end"),
            time: source.stated_attribute("time"),
            reference: source.stated_attribute("ref"),
            group,
            attributes: source.elements_at(&["attribute"]).into_iter().map(attribute).collect(),
            comment: source
                .elements_at(&["comment"])
                .last()
                .map(|comment| comment.text.trim()),
            source,
        }
    }
}

/// Returns the track and the index that an element inside an attribute refers to.
fn anvil_link<'t>(element: &'t MarkupElement<'_>) -> Option<(&'t str, &'t str)> {
    let first = |names: [&str; 2]| names.into_iter().find_map(|name| element.stated_attribute(name));
    Some((first(["ref-track", "track"])?, first(["ref-index", "index"])?))
}
