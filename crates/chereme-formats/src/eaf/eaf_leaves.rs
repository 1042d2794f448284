//! Elements without children: each attribute with its field, in the order in which ELAN writes them.

use std::borrow::Cow;
use std::io::{self, Write};

use super::eaf_fields::{AttributeField, DocumentReader};
use super::eaf_output::XmlOutput;
use super::eaf_raw::*;
use super::error::EafError;
use super::xml::XmlStartTag;

/// The value of a field, as a file has it in an attribute.
trait AttributeText {
    fn attribute_text(&self) -> Option<Cow<'_, str>>;
}

impl AttributeText for EafText<'_> {
    fn attribute_text(&self) -> Option<Cow<'_, str>> {
        Some(Cow::Borrowed(self))
    }
}

impl AttributeText for Option<EafText<'_>> {
    fn attribute_text(&self) -> Option<Cow<'_, str>> {
        self.as_deref().map(Cow::Borrowed)
    }
}

impl AttributeText for Option<i64> {
    fn attribute_text(&self) -> Option<Cow<'_, str>> {
        self.map(|number| Cow::Owned(number.to_string()))
    }
}

impl AttributeText for Option<bool> {
    fn attribute_text(&self) -> Option<Cow<'_, str>> {
        self.map(|flag| Cow::Borrowed(if flag { "true" } else { "false" }))
    }
}

macro_rules! leaf_elements {
    ($($element:ident $tag:literal { $($attribute:literal $kind:ident $field:ident,)* })*) => {$(
        impl<'a> $element<'a> {
            /// Reads the element that starts with this tag.
            pub(super) fn read_leaf(reader: &mut DocumentReader<'a>, tag: &XmlStartTag<'a>) -> Result<Self, EafError> {
                let mut leaf = Self::default();
                let fields = &mut [$(($attribute, AttributeField::$kind(&mut leaf.$field)),)*];
                let kept = reader.read_attribute_fields(tag, fields)?;
                leaf.kept = reader.read_leaf_end(tag, kept)?;
                Ok(leaf)
            }

            /// Writes the element.
            pub(super) fn write_leaf<W: Write>(&self, xml: &mut XmlOutput<'_, W>) -> io::Result<()> {
                let texts = [$(($attribute, self.$field.attribute_text()),)*];
                let pairs = texts.each_ref().map(|(name, text)| (*name, text.as_deref()));
                xml.write_leaf_element($tag, &pairs, &self.kept)
            }
        }
    )*};
}

leaf_elements! {
    MediaDescriptor "MEDIA_DESCRIPTOR" {
        "EXTRACTED_FROM" Optional extracted_from,
        "MEDIA_URL" Required url,
        "MIME_TYPE" Required mime_type,
        "RELATIVE_MEDIA_URL" Optional relative_url,
        "TIME_ORIGIN" Time time_origin,
    }
    LinkedFile "LINKED_FILE_DESCRIPTOR" {
        "ASSOCIATED_WITH" Optional associated_with,
        "LINK_URL" Required url,
        "MIME_TYPE" Required mime_type,
        "RELATIVE_LINK_URL" Optional relative_url,
        "TIME_ORIGIN" Time time_origin,
    }
    TimeSlot "TIME_SLOT" {
        "TIME_SLOT_ID" Required id,
        "TIME_VALUE" Time value,
    }
    LinguisticType "LINGUISTIC_TYPE" {
        "CONSTRAINTS" Optional constraints,
        "CONTROLLED_VOCABULARY_REF" Optional vocabulary,
        "EXT_REF" Optional external_ref,
        "GRAPHIC_REFERENCES" Flag graphic_references,
        "LEXICON_REF" Optional lexicon_ref,
        "LINGUISTIC_TYPE_ID" Required id,
        "TIME_ALIGNABLE" Flag time_alignable,
    }
    EafLocale "LOCALE" {
        "COUNTRY_CODE" Optional country,
        "LANGUAGE_CODE" Required language,
        "VARIANT" Optional variant,
    }
    EafLanguage "LANGUAGE" {
        "LANG_DEF" Optional definition,
        "LANG_ID" Required id,
        "LANG_LABEL" Optional label,
    }
    EafConstraint "CONSTRAINT" {
        "DESCRIPTION" Optional description,
        "STEREOTYPE" Required stereotype,
    }
    LexiconRef "LEXICON_REF" {
        "DATCAT_ID" Optional category_id,
        "DATCAT_NAME" Optional category_name,
        "LEXICON_ID" Text lexicon_id,
        "LEXICON_NAME" Text lexicon_name,
        "LEX_REF_ID" Required id,
        "NAME" Text name,
        "TYPE" Text kind,
        "URL" Text url,
    }
    ExternalRef "EXTERNAL_REF" {
        "EXT_REF_ID" Required id,
        "TYPE" Text kind,
        "VALUE" Text value,
    }
}
