//! Writes a raw document as EAF 3.0.

use super::eaf_output::XmlOutput;
use super::eaf_raw::*;
use super::style::EafSpelling;
use std::io::{self, Write};

/// The stereotypes in ELAN's order and words ("refering" is ELAN's own).
const STEREOTYPE_CONSTRAINTS: [(&str, &str); 4] = [
    (
        "Time_Subdivision",
        "Time subdivision of parent annotation's time interval, no time gaps allowed within this interval",
    ),
    (
        "Symbolic_Subdivision",
        "Symbolic subdivision of a parent annotation. Annotations refering to the same parent are ordered",
    ),
    ("Symbolic_Association", "1-1 association with a parent annotation"),
    (
        "Included_In",
        "Time alignable annotations within the parent annotation's time interval, gaps are allowed",
    ),
];

const EAF_SCHEMA_URL: &str = "http://www.mpi.nl/tools/elan/EAFv3.0.xsd";

/// Writes `document` as ELAN 6 writes EAF 3.0: in UTF-8, an element per line, indented by four blanks, long
/// start tags broken at column 72.
///
/// The same document gives the same bytes. The document is [`upgrade_eaf_document`] first; time slots keep their ids
/// and order, so that annotations continue to share slots. Characters that XML cannot hold become U+FFFD.
///
/// # Errors
/// The errors of `out`.
pub fn write_eaf_document(document: &EafDocument<'_>, out: impl Write) -> io::Result<()> {
    let document = upgrade_eaf_document(document.clone());
    let style = EafSpelling::elan_spelling();
    let mut xml = XmlOutput::new(io::BufWriter::new(out), &style, "");
    xml.out.write_all(b"<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n")?;
    write_eaf_root(&document, &mut xml)?;
    xml.out.flush()
}

/// Returns the document in the form of EAF 3.0: sets format and schema, gives vocabularies of formats
/// before 2.8 entry ids and the language `und`, moves external references inside a vocabulary to the end,
/// and writes the four constraints as ELAN does.
#[must_use]
pub fn upgrade_eaf_document(mut document: EafDocument<'_>) -> EafDocument<'_> {
    document.version = "3.0".into();
    document.format = Some("3.0".into());
    document.schema = Some(EAF_SCHEMA_URL.into());
    document.header.time_units.get_or_insert("milliseconds".into());
    let mut legacy = false;
    for vocabulary in &mut document.vocabularies {
        legacy |= upgrade_vocabulary(vocabulary);
        document.external_refs.append(&mut vocabulary.external_refs);
    }
    if legacy && !document.languages.iter().any(|language| language.id == "und") {
        document.languages.push(EafLanguage {
            id: "und".into(),
            definition: Some("http://cdb.iso.org/lg/CDB-00130975-001".into()),
            label: Some("undetermined (und)".into()),
            kept: None,
        });
    }
    document.constraints = STEREOTYPE_CONSTRAINTS
        .iter()
        .map(|(stereotype, description)| EafConstraint {
            stereotype: (*stereotype).into(),
            description: Some((*description).into()),
            kept: None,
        })
        .collect();
    document
}

fn upgrade_vocabulary(vocabulary: &mut EafVocabulary<'_>) -> bool {
    let mut legacy = false;
    for description in &mut vocabulary.descriptions {
        legacy |= description.language.is_none();
        description.language.get_or_insert("und".into());
    }
    let taken: std::collections::BTreeSet<String> = vocabulary
        .entries
        .iter()
        .filter_map(|entry| entry.id.as_deref().map(str::to_owned))
        .collect();
    let mut fresh = (0u64..).map(|n| format!("cveid{n}")).filter(|id| !taken.contains(id));
    for entry in &mut vocabulary.entries {
        if entry.id.is_none() {
            entry.id = fresh.next().map(EafText::Owned);
        }
        for value in &mut entry.values {
            legacy |= value.language.is_none();
            value.language.get_or_insert("und".into());
        }
    }
    legacy
}

fn write_eaf_root<W: Write>(doc: &EafDocument<'_>, xml: &mut XmlOutput<'_, W>) -> io::Result<()> {
    let pairs = [
        ("AUTHOR", Some(&*doc.author)),
        ("DATE", Some(&*doc.date)),
        ("FORMAT", doc.format.as_deref()),
        ("VERSION", Some(&*doc.version)),
        ("xmlns:xsi", Some("http://www.w3.org/2001/XMLSchema-instance")),
        ("xsi:noNamespaceSchemaLocation", doc.schema.as_deref()),
    ];
    xml.write_parent_element("ANNOTATION_DOCUMENT", &pairs, &doc.kept, false, |xml| {
        for license in &doc.licenses {
            xml.write_text_element(
                "LICENSE",
                &[("LICENSE_URL", Some(&license.url))],
                &license.kept,
                &license.text,
            )?;
        }
        write_eaf_header(&doc.header, xml)?;
        xml.write_parent_element("TIME_ORDER", &[], &None, doc.time_order.is_empty(), |xml| {
            doc.time_order.iter().try_for_each(|slot| slot.write_leaf(xml))
        })?;
        doc.tiers.iter().try_for_each(|item| write_eaf_tier(item, xml))?;
        doc.linguistic_types.iter().try_for_each(|item| item.write_leaf(xml))?;
        doc.locales.iter().try_for_each(|item| item.write_leaf(xml))?;
        doc.languages.iter().try_for_each(|item| item.write_leaf(xml))?;
        doc.constraints.iter().try_for_each(|item| item.write_leaf(xml))?;
        doc.vocabularies
            .iter()
            .try_for_each(|item| write_eaf_vocabulary(item, xml))?;
        doc.lexicon_refs.iter().try_for_each(|item| item.write_leaf(xml))?;
        doc.ref_link_sets.iter().try_for_each(|item| ref_link_set(item, xml))?;
        doc.external_refs.iter().try_for_each(|item| item.write_leaf(xml))
    })
}

fn write_eaf_header<W: Write>(header: &EafHeader<'_>, xml: &mut XmlOutput<'_, W>) -> io::Result<()> {
    let pairs = [
        ("MEDIA_FILE", Some(&*header.media_file)),
        ("TIME_UNITS", header.time_units.as_deref()),
    ];
    let empty = header.media.is_empty() && header.linked_files.is_empty() && header.properties.is_empty();
    xml.write_parent_element("HEADER", &pairs, &header.kept, empty, |xml| {
        header.media.iter().try_for_each(|item| item.write_leaf(xml))?;
        header.linked_files.iter().try_for_each(|item| item.write_leaf(xml))?;
        header
            .properties
            .iter()
            .try_for_each(|item| write_eaf_property(item, xml))
    })
}

pub(super) fn write_eaf_property<W: Write>(property: &EafProperty<'_>, xml: &mut XmlOutput<'_, W>) -> io::Result<()> {
    xml.write_text_element(
        "PROPERTY",
        &[("NAME", property.name.as_deref())],
        &property.kept,
        &property.value,
    )
}

pub(super) fn write_eaf_tier<W: Write>(tier: &EafTier<'_>, xml: &mut XmlOutput<'_, W>) -> io::Result<()> {
    let pairs = [
        ("ANNOTATOR", tier.annotator.as_deref()),
        ("DEFAULT_LOCALE", tier.locale.as_deref()),
        ("EXT_REF", tier.external_ref.as_deref()),
        ("LANG_REF", tier.language.as_deref()),
        ("LINGUISTIC_TYPE_REF", Some(&*tier.linguistic_type)),
        ("PARENT_REF", tier.parent.as_deref()),
        ("PARTICIPANT", tier.participant.as_deref()),
        ("TIER_ID", Some(&*tier.id)),
    ];
    xml.write_parent_element("TIER", &pairs, &tier.kept, tier.annotations.is_empty(), |xml| {
        tier.annotations
            .iter()
            .try_for_each(|item| write_eaf_annotation(item, xml))
    })
}

pub(super) fn write_eaf_annotation<W: Write>(
    annotation: &EafAnnotation<'_>,
    xml: &mut XmlOutput<'_, W>,
) -> io::Result<()> {
    let id = ("ANNOTATION_ID", Some(&*annotation.id));
    let reference_pairs = [
        ("CVE_REF", annotation.entry.as_deref()),
        ("EXT_REF", annotation.external_ref.as_deref()),
        ("LANG_REF", annotation.language.as_deref()),
    ];
    let value = |xml: &mut XmlOutput<'_, W>| xml.write_text_element("ANNOTATION_VALUE", &[], &None, &annotation.value);
    xml.write_parent_element("ANNOTATION", &[], &None, false, |xml| match &annotation.anchor {
        AnnotationAnchor::Slots { start, end } => {
            let [entry, external, language] = reference_pairs;
            let slots = [("TIME_SLOT_REF1", Some(&**start)), ("TIME_SLOT_REF2", Some(&**end))];
            let pairs = [
                id,
                entry,
                external,
                language,
                ("SVG_REF", annotation.svg.as_deref()),
                slots[0],
                slots[1],
            ];
            xml.write_parent_element("ALIGNABLE_ANNOTATION", &pairs, &annotation.kept, false, value)
        }
        AnnotationAnchor::Parent { parent, previous } => {
            let [entry, external, language] = reference_pairs;
            let parent = ("ANNOTATION_REF", Some(&**parent));
            let pairs = [
                id,
                parent,
                entry,
                external,
                language,
                ("PREVIOUS_ANNOTATION", previous.as_deref()),
            ];
            xml.write_parent_element("REF_ANNOTATION", &pairs, &annotation.kept, false, value)
        }
    })
}

pub(super) fn write_eaf_vocabulary<W: Write>(cv: &EafVocabulary<'_>, xml: &mut XmlOutput<'_, W>) -> io::Result<()> {
    let pairs = [("CV_ID", Some(&*cv.id)), ("EXT_REF", cv.external_ref.as_deref())];
    let empty = cv.descriptions.is_empty() && cv.entries.is_empty();
    xml.write_parent_element("CONTROLLED_VOCABULARY", &pairs, &cv.kept, empty, |xml| {
        for description in &cv.descriptions {
            let language = [("LANG_REF", description.language.as_deref())];
            xml.write_text_element("DESCRIPTION", &language, &description.kept, &description.text)?;
        }
        cv.entries.iter().try_for_each(|item| write_vocabulary_entry(item, xml))
    })
}

pub(super) fn write_vocabulary_entry<W: Write>(
    entry: &EafVocabularyEntry<'_>,
    xml: &mut XmlOutput<'_, W>,
) -> io::Result<()> {
    let pairs = [
        ("CVE_ID", entry.id.as_deref()),
        ("EXT_REF", entry.external_ref.as_deref()),
    ];
    xml.write_parent_element("CV_ENTRY_ML", &pairs, &entry.kept, entry.values.is_empty(), |xml| {
        entry.values.iter().try_for_each(|value| {
            let pairs = [
                ("DESCRIPTION", value.description.as_deref()),
                ("LANG_REF", value.language.as_deref()),
            ];
            xml.write_text_element("CVE_VALUE", &pairs, &value.kept, &value.value)
        })
    })
}

fn ref_link_set<W: Write>(set: &RefLinkSet<'_>, xml: &mut XmlOutput<'_, W>) -> io::Result<()> {
    let pairs = [
        ("CV_REF", set.vocabulary.as_deref()),
        ("EXT_REF", set.external_ref.as_deref()),
        ("LANG_REF", set.language.as_deref()),
        ("LINK_SET_ID", Some(&*set.id)),
        ("LINK_SET_NAME", set.name.as_deref()),
    ];
    xml.write_parent_element("REF_LINK_SET", &pairs, &set.kept, set.links.is_empty(), |xml| {
        set.links.iter().try_for_each(|link| ref_link(link, xml))
    })
}

fn ref_link<W: Write>(link: &RefLink<'_>, xml: &mut XmlOutput<'_, W>) -> io::Result<()> {
    let mut pairs = vec![
        ("CVE_REF", link.entry.as_deref()),
        ("EXT_REF", link.external_ref.as_deref()),
        ("LANG_REF", link.language.as_deref()),
    ];
    let name = match &link.ends {
        LinkEnds::Cross {
            from,
            to,
            directionality,
        } => {
            pairs.extend([
                ("DIRECTIONALITY", directionality.as_deref()),
                ("REF1", Some(&**from)),
                ("REF2", Some(&**to)),
            ]);
            "CROSS_REF_LINK"
        }
        LinkEnds::Group(refs) => {
            pairs.push(("REFS", Some(&**refs)));
            "GROUP_REF_LINK"
        }
    };
    pairs.extend([
        ("REF_LINK_ID", Some(&*link.id)),
        ("REF_LINK_NAME", link.name.as_deref()),
        ("REF_TYPE", link.kind.as_deref()),
    ]);
    xml.write_text_element(name, &pairs, &link.kept, &link.text)
}
