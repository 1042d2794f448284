//! ELAN's preferences of one annotation file, `.pfsx`: how its tiers are shown.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;

use super::error::EafError;
use super::xml::{XmlCursor, XmlStartTag};
use crate::finding::ImportFinding;

/// How the tiers of a file are shown.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct TierDisplaySettings {
    /// The tiers in the order in which they are shown.
    pub order: Vec<String>,
    /// Tiers that are not shown.
    pub hidden: BTreeSet<String>,
    /// Colours of tiers: red, green, blue.
    pub colours: BTreeMap<String, [u8; 3]>,
    /// The tier that was worked on last.
    pub active: Option<String>,
}

impl TierDisplaySettings {
    /// Returns whether the file has no setting for any tier.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.order.is_empty() && self.hidden.is_empty() && self.colours.is_empty()
    }
}

/// The most tiers that are read.
const MAX_SETTINGS_TIERS: usize = 10_000;

/// Reads a file of preferences (root `preferences`), and leaves out everything that is not about tiers.
///
/// # Errors
/// [`EafError`] if the bytes are not UTF-8, not XML, cut short, or no preferences.
pub fn read_display_settings(bytes: &[u8]) -> Result<(TierDisplaySettings, Vec<ImportFinding>), EafError> {
    let mut reader = DisplaySettingsReader {
        cursor: XmlCursor::new(bytes)?,
        settings: TierDisplaySettings::default(),
    };
    let root = reader.cursor.read_root_tag("preferences")?;
    while let Some(child) = reader.cursor.next_child_tag(&root)? {
        let key = reader.read_settings_key(&child)?;
        match (child.name, key.as_str()) {
            ("prefList", "MultiTierViewer.TierOrder") => {
                for name in reader.read_settings_values(&child)? {
                    if !reader.settings.order.contains(&name) {
                        reader.settings.order.push(name);
                    }
                }
            }
            ("prefList", "MultiTierViewer.HiddenTiers") => {
                let hidden = reader.read_settings_values(&child)?;
                reader.settings.hidden.extend(hidden);
            }
            ("pref", "MultiTierViewer.ActiveTierName") => {
                reader.settings.active = reader.read_settings_values(&child)?.into_iter().next();
            }
            ("prefGroup", "TierColors") => reader.read_tier_colours(&child)?,
            _ => {
                reader.cursor.skip_xml_element(&child)?;
            }
        }
    }
    reader.cursor.check_document_end()?;
    Ok((reader.settings, reader.cursor.findings.finish_finding_tally()))
}

struct DisplaySettingsReader<'a> {
    cursor: XmlCursor<'a>,
    settings: TierDisplaySettings,
}

impl<'a> DisplaySettingsReader<'a> {
    fn read_settings_key(&mut self, tag: &XmlStartTag<'a>) -> Result<String, EafError> {
        let mut key = String::new();
        self.cursor.visit_tag_attributes(tag, |name, value| {
            if name == "key" {
                key = value.into_owned();
            }
        })?;
        Ok(key)
    }

    /// Returns the texts of the elements in `tag`.
    fn read_settings_values(&mut self, tag: &XmlStartTag<'a>) -> Result<Vec<String>, EafError> {
        let mut values = Vec::new();
        while let Some(child) = self.cursor.next_child_tag(tag)? {
            let text = self.cursor.read_tag_text(&child)?;
            if values.len() < MAX_SETTINGS_TIERS && !text.trim().is_empty() {
                values.push(text.into_owned());
            }
        }
        Ok(values)
    }

    fn read_tier_colours(&mut self, group: &XmlStartTag<'a>) -> Result<(), EafError> {
        while let Some(child) = self.cursor.next_child_tag(group)? {
            let tier = self.read_settings_key(&child)?;
            let colour = self.read_settings_values(&child)?;
            let parts: Vec<u8> = colour
                .first()
                .into_iter()
                .flat_map(|text| text.split(','))
                .filter_map(|part| part.trim().parse().ok())
                .collect();
            match <[u8; 3]>::try_from(parts) {
                Ok(colour) if self.settings.colours.len() < MAX_SETTINGS_TIERS => {
                    self.settings.colours.insert(tier, colour);
                }
                _ => self.cursor.findings.add_limited_finding("colours that are none", || {
                    let message = format!("the colour of the tier {tier:?} is not understood");
                    ImportFinding::new_note_finding(child.start_tag_line(), message)
                }),
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<preferences version="1.1">
    <pref key="MultiTierViewer.ActiveTierName"><String>Gloss &amp; more</String></pref>
    <pref key="MediaTime"><Long>-1</Long></pref>
    <prefList key="MultiTierViewer.HiddenTiers"/>
    <prefGroup key="TierColors">
        <pref key="Gloss"><Object class="java.awt.Color">0,160,255</Object></pref>
        <pref key="Odd"><Object class="java.awt.Color">0,160,999</Object></pref>
    </prefGroup>
    <prefList key="MultiTierViewer.TierOrder"><String>B</String><String>A</String><String>B</String></prefList>
</preferences>
"#;

    #[test]
    fn order_colours_and_hidden_tiers_are_read() {
        let (settings, findings) = read_display_settings(FILE.as_bytes()).expect("preferences");
        assert_eq!(settings.order, ["B", "A"]);
        assert_eq!(settings.colours, BTreeMap::from([("Gloss".to_owned(), [0, 160, 255])]));
        assert_eq!(settings.active.as_deref(), Some("Gloss & more"));
        assert!(settings.hidden.is_empty());
        assert_eq!(findings.len(), 1, "{findings:?}");
    }

    #[test]
    fn truncated_and_foreign_settings_are_refused() {
        for cut in [0, 10, 60, 200, FILE.len() - 20] {
            assert!(read_display_settings(&FILE.as_bytes()[..cut]).is_err(), "{cut}");
        }
        assert!(read_display_settings(b"<ANNOTATION_DOCUMENT/>").is_err());
    }
}
