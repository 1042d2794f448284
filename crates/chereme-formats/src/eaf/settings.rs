//! ELAN's preferences of one annotation file, `.pfsx`: how its tiers are shown.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;

use super::error::Error;
use super::xml::{Cursor, Tag};
use crate::finding::Finding;

/// How the tiers of a file are shown.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct Settings {
    /// The tiers in the order in which they are shown.
    pub order: Vec<String>,
    /// Tiers that are not shown.
    pub hidden: BTreeSet<String>,
    /// Colours of tiers: red, green, blue.
    pub colours: BTreeMap<String, [u8; 3]>,
    /// The tier that was worked on last.
    pub active: Option<String>,
}

impl Settings {
    /// Returns whether the file has no setting for any tier.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.order.is_empty() && self.hidden.is_empty() && self.colours.is_empty()
    }
}

/// The most tiers that are read.
const TIERS: usize = 10_000;

/// Reads a file of preferences (root `preferences`), and leaves out everything that is not about tiers.
///
/// # Errors
/// [`Error`] if the bytes are not UTF-8, not XML, cut short, or no preferences.
pub fn read(bytes: &[u8]) -> Result<(Settings, Vec<Finding>), Error> {
    let mut reader = Reader {
        cursor: Cursor::new(bytes)?,
        settings: Settings::default(),
    };
    let root = reader.cursor.root("preferences")?;
    while let Some(child) = reader.cursor.child(&root)? {
        let key = reader.key(&child)?;
        match (child.name, key.as_str()) {
            ("prefList", "MultiTierViewer.TierOrder") => {
                for name in reader.values(&child)? {
                    if !reader.settings.order.contains(&name) {
                        reader.settings.order.push(name);
                    }
                }
            }
            ("prefList", "MultiTierViewer.HiddenTiers") => {
                let hidden = reader.values(&child)?;
                reader.settings.hidden.extend(hidden);
            }
            ("pref", "MultiTierViewer.ActiveTierName") => {
                reader.settings.active = reader.values(&child)?.into_iter().next();
            }
            ("prefGroup", "TierColors") => reader.colours(&child)?,
            _ => {
                reader.cursor.skip(&child)?;
            }
        }
    }
    reader.cursor.finish()?;
    Ok((reader.settings, reader.cursor.findings.finish()))
}

struct Reader<'a> {
    cursor: Cursor<'a>,
    settings: Settings,
}

impl<'a> Reader<'a> {
    fn key(&mut self, tag: &Tag<'a>) -> Result<String, Error> {
        let mut key = String::new();
        self.cursor.attributes(tag, |name, value| {
            if name == "key" {
                key = value.into_owned();
            }
        })?;
        Ok(key)
    }

    /// Returns the texts of the elements in `tag`.
    fn values(&mut self, tag: &Tag<'a>) -> Result<Vec<String>, Error> {
        let mut values = Vec::new();
        while let Some(child) = self.cursor.child(tag)? {
            let text = self.cursor.text(&child)?;
            if values.len() < TIERS && !text.trim().is_empty() {
                values.push(text.into_owned());
            }
        }
        Ok(values)
    }

    fn colours(&mut self, group: &Tag<'a>) -> Result<(), Error> {
        while let Some(child) = self.cursor.child(group)? {
            let tier = self.key(&child)?;
            let colour = self.values(&child)?;
            let parts: Vec<u8> = colour
                .first()
                .into_iter()
                .flat_map(|text| text.split(','))
                .filter_map(|part| part.trim().parse().ok())
                .collect();
            match <[u8; 3]>::try_from(parts) {
                Ok(colour) if self.settings.colours.len() < TIERS => {
                    self.settings.colours.insert(tier, colour);
                }
                _ => self.cursor.findings.add("colours that are none", || {
                    let message = format!("the colour of the tier {tier:?} is not understood");
                    Finding::note(child.line(), message)
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
        let (settings, findings) = read(FILE.as_bytes()).expect("preferences");
        assert_eq!(settings.order, ["B", "A"]);
        assert_eq!(
            settings.colours,
            BTreeMap::from([("Gloss".to_owned(), [0, 160, 255])])
        );
        assert_eq!(settings.active.as_deref(), Some("Gloss & more"));
        assert!(settings.hidden.is_empty());
        assert_eq!(findings.len(), 1, "{findings:?}");
    }

    #[test]
    fn truncated_and_foreign_settings_are_refused() {
        for cut in [0, 10, 60, 200, FILE.len() - 20] {
            assert!(read(&FILE.as_bytes()[..cut]).is_err(), "{cut}");
        }
        assert!(read(b"<ANNOTATION_DOCUMENT/>").is_err());
    }
}
