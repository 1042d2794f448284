//! Writes a raw document as EAF 3.0.

use super::output::Output;
use super::raw::*;
use super::style::Style;
use std::io::{self, Write};

/// The stereotypes in ELAN's order and words ("refering" is ELAN's own).
const CONSTRAINTS: [(&str, &str); 4] = [
    (
        "Time_Subdivision",
        "Time subdivision of parent annotation's time interval, no time gaps allowed within this interval",
    ),
    (
        "Symbolic_Subdivision",
        "Symbolic subdivision of a parent annotation. Annotations refering to the same parent are ordered",
    ),
    (
        "Symbolic_Association",
        "1-1 association with a parent annotation",
    ),
    (
        "Included_In",
        "Time alignable annotations within the parent annotation's time interval, gaps are allowed",
    ),
];

const SCHEMA: &str = "http://www.mpi.nl/tools/elan/EAFv3.0.xsd";

/// Writes `document` as ELAN 6 writes EAF 3.0: in UTF-8, an element per line, indented by four blanks, long
/// start tags broken at column 72.
///
/// The same document gives the same bytes. The document is [`upgraded`] first; time slots keep their ids
/// and order, so that annotations continue to share slots. Characters that XML cannot hold become U+FFFD.
///
/// # Errors
/// The errors of `out`.
pub fn write(document: &Document<'_>, out: impl Write) -> io::Result<()> {
    let document = upgraded(document.clone());
    let style = Style::elan();
    let mut xml = Output::new(io::BufWriter::new(out), &style, "");
    xml.out
        .write_all(b"<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n")?;
    root(&document, &mut xml)?;
    xml.out.flush()
}

/// Returns the document in the form of EAF 3.0: sets format and schema, gives vocabularies of formats
/// before 2.8 entry ids and the language `und`, moves external references inside a vocabulary to the end,
/// and writes the four constraints as ELAN does.
#[must_use]
pub fn upgraded(mut document: Document<'_>) -> Document<'_> {
    document.version = "3.0".into();
    document.format = Some("3.0".into());
    document.schema = Some(SCHEMA.into());
    document
        .header
        .time_units
        .get_or_insert("milliseconds".into());
    let mut legacy = false;
    for vocabulary in &mut document.vocabularies {
        legacy |= upgrade_vocabulary(vocabulary);
        document.external_refs.append(&mut vocabulary.external_refs);
    }
    if legacy
        && !document
            .languages
            .iter()
            .any(|language| language.id == "und")
    {
        document.languages.push(Language {
            id: "und".into(),
            definition: Some("http://cdb.iso.org/lg/CDB-00130975-001".into()),
            label: Some("undetermined (und)".into()),
            kept: None,
        });
    }
    document.constraints = CONSTRAINTS
        .iter()
        .map(|(stereotype, description)| Constraint {
            stereotype: (*stereotype).into(),
            description: Some((*description).into()),
            kept: None,
        })
        .collect();
    document
}

fn upgrade_vocabulary(vocabulary: &mut Vocabulary<'_>) -> bool {
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
    let mut fresh = (0u64..)
        .map(|n| format!("cveid{n}"))
        .filter(|id| !taken.contains(id));
    for entry in &mut vocabulary.entries {
        if entry.id.is_none() {
            entry.id = fresh.next().map(Text::Owned);
        }
        for value in &mut entry.values {
            legacy |= value.language.is_none();
            value.language.get_or_insert("und".into());
        }
    }
    legacy
}

fn flag(value: Option<bool>) -> Option<&'static str> {
    value.map(|value| if value { "true" } else { "false" })
}

fn root<W: Write>(doc: &Document<'_>, xml: &mut Output<'_, W>) -> io::Result<()> {
    let pairs = [
        ("AUTHOR", Some(&*doc.author)),
        ("DATE", Some(&*doc.date)),
        ("FORMAT", doc.format.as_deref()),
        ("VERSION", Some(&*doc.version)),
        (
            "xmlns:xsi",
            Some("http://www.w3.org/2001/XMLSchema-instance"),
        ),
        ("xsi:noNamespaceSchemaLocation", doc.schema.as_deref()),
    ];
    xml.element("ANNOTATION_DOCUMENT", &pairs, &doc.kept, false, |xml| {
        for license in &doc.licenses {
            xml.text(
                "LICENSE",
                &[("LICENSE_URL", Some(&license.url))],
                &license.kept,
                &license.text,
            )?;
        }
        header(&doc.header, xml)?;
        xml.element("TIME_ORDER", &[], &None, doc.time_order.is_empty(), |xml| {
            doc.time_order
                .iter()
                .try_for_each(|slot| time_slot(slot, xml))
        })?;
        doc.tiers.iter().try_for_each(|it| tier(it, xml))?;
        doc.linguistic_types
            .iter()
            .try_for_each(|it| linguistic_type(it, xml))?;
        doc.locales.iter().try_for_each(|it| locale(it, xml))?;
        doc.languages.iter().try_for_each(|it| language(it, xml))?;
        doc.constraints
            .iter()
            .try_for_each(|it| constraint(it, xml))?;
        doc.vocabularies
            .iter()
            .try_for_each(|it| vocabulary(it, xml))?;
        doc.lexicon_refs
            .iter()
            .try_for_each(|it| lexicon_ref(it, xml))?;
        doc.ref_link_sets
            .iter()
            .try_for_each(|it| ref_link_set(it, xml))?;
        doc.external_refs
            .iter()
            .try_for_each(|it| external_ref(it, xml))
    })
}

fn header<W: Write>(header: &Header<'_>, xml: &mut Output<'_, W>) -> io::Result<()> {
    let pairs = [
        ("MEDIA_FILE", Some(&*header.media_file)),
        ("TIME_UNITS", header.time_units.as_deref()),
    ];
    let empty =
        header.media.is_empty() && header.linked_files.is_empty() && header.properties.is_empty();
    xml.element("HEADER", &pairs, &header.kept, empty, |xml| {
        header.media.iter().try_for_each(|it| media(it, xml))?;
        for file in &header.linked_files {
            let origin = file.time_origin.map(|ms| ms.to_string());
            let pairs = [
                ("ASSOCIATED_WITH", file.associated_with.as_deref()),
                ("LINK_URL", Some(&*file.url)),
                ("MIME_TYPE", Some(&*file.mime_type)),
                ("RELATIVE_LINK_URL", file.relative_url.as_deref()),
                ("TIME_ORIGIN", origin.as_deref()),
            ];
            xml.leaf("LINKED_FILE_DESCRIPTOR", &pairs, &file.kept)?;
        }
        header
            .properties
            .iter()
            .try_for_each(|it| property(it, xml))
    })
}

pub(super) fn media<W: Write>(
    media: &MediaDescriptor<'_>,
    xml: &mut Output<'_, W>,
) -> io::Result<()> {
    let origin = media.time_origin.map(|ms| ms.to_string());
    let pairs = [
        ("EXTRACTED_FROM", media.extracted_from.as_deref()),
        ("MEDIA_URL", Some(&*media.url)),
        ("MIME_TYPE", Some(&*media.mime_type)),
        ("RELATIVE_MEDIA_URL", media.relative_url.as_deref()),
        ("TIME_ORIGIN", origin.as_deref()),
    ];
    xml.leaf("MEDIA_DESCRIPTOR", &pairs, &media.kept)
}

pub(super) fn property<W: Write>(
    property: &Property<'_>,
    xml: &mut Output<'_, W>,
) -> io::Result<()> {
    xml.text(
        "PROPERTY",
        &[("NAME", property.name.as_deref())],
        &property.kept,
        &property.value,
    )
}

pub(super) fn time_slot<W: Write>(slot: &TimeSlot<'_>, xml: &mut Output<'_, W>) -> io::Result<()> {
    let value = slot.value.map(|value| value.to_string());
    xml.leaf(
        "TIME_SLOT",
        &[
            ("TIME_SLOT_ID", Some(&slot.id)),
            ("TIME_VALUE", value.as_deref()),
        ],
        &slot.kept,
    )
}

pub(super) fn tier<W: Write>(tier: &Tier<'_>, xml: &mut Output<'_, W>) -> io::Result<()> {
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
    xml.element(
        "TIER",
        &pairs,
        &tier.kept,
        tier.annotations.is_empty(),
        |xml| {
            tier.annotations
                .iter()
                .try_for_each(|it| annotation(it, xml))
        },
    )
}

pub(super) fn annotation<W: Write>(
    annotation: &Annotation<'_>,
    xml: &mut Output<'_, W>,
) -> io::Result<()> {
    let id = ("ANNOTATION_ID", Some(&*annotation.id));
    let own = [
        ("CVE_REF", annotation.entry.as_deref()),
        ("EXT_REF", annotation.external_ref.as_deref()),
        ("LANG_REF", annotation.language.as_deref()),
    ];
    let value =
        |xml: &mut Output<'_, W>| xml.text("ANNOTATION_VALUE", &[], &None, &annotation.value);
    xml.element("ANNOTATION", &[], &None, false, |xml| {
        match &annotation.anchor {
            Anchor::Slots { start, end } => {
                let [entry, external, language] = own;
                let slots = [
                    ("TIME_SLOT_REF1", Some(&**start)),
                    ("TIME_SLOT_REF2", Some(&**end)),
                ];
                let pairs = [
                    id,
                    entry,
                    external,
                    language,
                    ("SVG_REF", annotation.svg.as_deref()),
                    slots[0],
                    slots[1],
                ];
                xml.element(
                    "ALIGNABLE_ANNOTATION",
                    &pairs,
                    &annotation.kept,
                    false,
                    value,
                )
            }
            Anchor::Parent { parent, previous } => {
                let [entry, external, language] = own;
                let parent = ("ANNOTATION_REF", Some(&**parent));
                let pairs = [
                    id,
                    parent,
                    entry,
                    external,
                    language,
                    ("PREVIOUS_ANNOTATION", previous.as_deref()),
                ];
                xml.element("REF_ANNOTATION", &pairs, &annotation.kept, false, value)
            }
        }
    })
}

pub(super) fn linguistic_type<W: Write>(
    kind: &LinguisticType<'_>,
    xml: &mut Output<'_, W>,
) -> io::Result<()> {
    let pairs = [
        ("CONSTRAINTS", kind.constraints.as_deref()),
        ("CONTROLLED_VOCABULARY_REF", kind.vocabulary.as_deref()),
        ("EXT_REF", kind.external_ref.as_deref()),
        ("GRAPHIC_REFERENCES", flag(kind.graphic_references)),
        ("LEXICON_REF", kind.lexicon_ref.as_deref()),
        ("LINGUISTIC_TYPE_ID", Some(&*kind.id)),
        ("TIME_ALIGNABLE", flag(kind.time_alignable)),
    ];
    xml.leaf("LINGUISTIC_TYPE", &pairs, &kind.kept)
}

pub(super) fn locale<W: Write>(locale: &Locale<'_>, xml: &mut Output<'_, W>) -> io::Result<()> {
    let pairs = [
        ("COUNTRY_CODE", locale.country.as_deref()),
        ("LANGUAGE_CODE", Some(&*locale.language)),
        ("VARIANT", locale.variant.as_deref()),
    ];
    xml.leaf("LOCALE", &pairs, &locale.kept)
}

pub(super) fn language<W: Write>(
    language: &Language<'_>,
    xml: &mut Output<'_, W>,
) -> io::Result<()> {
    let pairs = [
        ("LANG_DEF", language.definition.as_deref()),
        ("LANG_ID", Some(&*language.id)),
        ("LANG_LABEL", language.label.as_deref()),
    ];
    xml.leaf("LANGUAGE", &pairs, &language.kept)
}

pub(super) fn constraint<W: Write>(
    constraint: &Constraint<'_>,
    xml: &mut Output<'_, W>,
) -> io::Result<()> {
    let pairs = [
        ("DESCRIPTION", constraint.description.as_deref()),
        ("STEREOTYPE", Some(&*constraint.stereotype)),
    ];
    xml.leaf("CONSTRAINT", &pairs, &constraint.kept)
}

pub(super) fn vocabulary<W: Write>(cv: &Vocabulary<'_>, xml: &mut Output<'_, W>) -> io::Result<()> {
    let pairs = [
        ("CV_ID", Some(&*cv.id)),
        ("EXT_REF", cv.external_ref.as_deref()),
    ];
    let empty = cv.descriptions.is_empty() && cv.entries.is_empty();
    xml.element("CONTROLLED_VOCABULARY", &pairs, &cv.kept, empty, |xml| {
        for description in &cv.descriptions {
            let language = [("LANG_REF", description.language.as_deref())];
            xml.text(
                "DESCRIPTION",
                &language,
                &description.kept,
                &description.text,
            )?;
        }
        cv.entries.iter().try_for_each(|it| entry(it, xml))
    })
}

pub(super) fn entry<W: Write>(entry: &Entry<'_>, xml: &mut Output<'_, W>) -> io::Result<()> {
    let pairs = [
        ("CVE_ID", entry.id.as_deref()),
        ("EXT_REF", entry.external_ref.as_deref()),
    ];
    xml.element(
        "CV_ENTRY_ML",
        &pairs,
        &entry.kept,
        entry.values.is_empty(),
        |xml| {
            entry.values.iter().try_for_each(|value| {
                let pairs = [
                    ("DESCRIPTION", value.description.as_deref()),
                    ("LANG_REF", value.language.as_deref()),
                ];
                xml.text("CVE_VALUE", &pairs, &value.kept, &value.value)
            })
        },
    )
}

fn lexicon_ref<W: Write>(lexicon: &LexiconRef<'_>, xml: &mut Output<'_, W>) -> io::Result<()> {
    let pairs = [
        ("DATCAT_ID", lexicon.category_id.as_deref()),
        ("DATCAT_NAME", lexicon.category_name.as_deref()),
        ("LEXICON_ID", Some(&*lexicon.lexicon_id)),
        ("LEXICON_NAME", Some(&*lexicon.lexicon_name)),
        ("LEX_REF_ID", Some(&*lexicon.id)),
        ("NAME", Some(&*lexicon.name)),
        ("TYPE", Some(&*lexicon.kind)),
        ("URL", Some(&*lexicon.url)),
    ];
    xml.leaf("LEXICON_REF", &pairs, &lexicon.kept)
}

fn ref_link_set<W: Write>(set: &RefLinkSet<'_>, xml: &mut Output<'_, W>) -> io::Result<()> {
    let pairs = [
        ("CV_REF", set.vocabulary.as_deref()),
        ("EXT_REF", set.external_ref.as_deref()),
        ("LANG_REF", set.language.as_deref()),
        ("LINK_SET_ID", Some(&*set.id)),
        ("LINK_SET_NAME", set.name.as_deref()),
    ];
    xml.element(
        "REF_LINK_SET",
        &pairs,
        &set.kept,
        set.links.is_empty(),
        |xml| set.links.iter().try_for_each(|link| ref_link(link, xml)),
    )
}

fn ref_link<W: Write>(link: &RefLink<'_>, xml: &mut Output<'_, W>) -> io::Result<()> {
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
    xml.text(name, &pairs, &link.kept, &link.text)
}

pub(super) fn external_ref<W: Write>(
    reference: &ExternalRef<'_>,
    xml: &mut Output<'_, W>,
) -> io::Result<()> {
    let pairs = [
        ("EXT_REF_ID", Some(&*reference.id)),
        ("TYPE", Some(&*reference.kind)),
        ("VALUE", Some(&*reference.value)),
    ];
    xml.leaf("EXTERNAL_REF", &pairs, &reference.kept)
}
