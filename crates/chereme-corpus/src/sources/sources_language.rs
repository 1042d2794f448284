//! The body language for animating notation: the usual one, a quiet one, the measured one, or one from a file.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use chereme_compose::{BodyLanguageChanges, LanguageValue, SourceError};
use chereme_sign::hamnosys::BodyLanguage;
use chereme_sign::text::nearest_candidate;

use super::learned::learned_language::MovementSamples;
use super::{CorpusSources, unreadable};
use crate::db::stored_history;

/// The size of the longest body language file that is read, in bytes.
const MAX_LANGUAGE_FILE_BYTES: u64 = 1 << 20;
/// The names that do not stand for files.
pub(crate) const DEFAULT_LANGUAGE_NAME: &str = "default";
const MEASURED_LANGUAGE_NAME: &str = "measured";
const QUIET_LANGUAGE_NAME: &str = "quiet";

impl CorpusSources<'_> {
    pub(super) fn find_body_language(
        &self,
        named: Option<&str>,
        signer: Option<&str>,
    ) -> Result<BodyLanguageChanges, SourceError> {
        match named {
            Some(DEFAULT_LANGUAGE_NAME) => Ok(BodyLanguageChanges::default()),
            Some(QUIET_LANGUAGE_NAME) => Ok(BodyLanguageChanges::quiet_body_language()),
            None | Some(MEASURED_LANGUAGE_NAME) => self.measured_body_language(signer),
            Some(file) => read_body_language_file(file),
        }
    }

    fn measured_body_language(&self, signer: Option<&str>) -> Result<BodyLanguageChanges, SourceError> {
        let newest = stored_history::find_newest_operation(self.connection).map_err(|error| unreadable(&error))?;
        let mut learned = self.learned.borrow_mut();
        if let Some((_, samples)) = learned.samples.as_ref().filter(|(at, _)| *at == newest) {
            return Ok(samples.sampled_body_language(signer));
        }
        let samples_result = MovementSamples::measure_annotated_movements(self.connection, self.inventories);
        let samples = samples_result.map_err(|error| unreadable(&error))?;
        let language = samples.sampled_body_language(signer);
        learned.samples = Some((newest, samples));
        Ok(language)
    }
}

fn read_body_language_file(file: &str) -> Result<BodyLanguageChanges, SourceError> {
    let fault = |message: String| SourceError::Language {
        name: file.to_owned(),
        message,
    };
    let path = Path::new(file);
    if !path.is_file() {
        let near_name = nearest_candidate(
            file,
            [DEFAULT_LANGUAGE_NAME, MEASURED_LANGUAGE_NAME, QUIET_LANGUAGE_NAME],
        );
        let hint = chereme_sign::text::did_you_mean(near_name);
        return Err(fault(format!("there is no such file{hint}")));
    }
    let size = fs::metadata(path).map(|file_info| file_info.len());
    if size.map_err(|error| fault(error.to_string()))? > MAX_LANGUAGE_FILE_BYTES {
        return Err(fault("the file is longer than a megabyte".to_owned()));
    }
    let text = fs::read_to_string(path).map_err(|error| fault(error.to_string()))?;
    let changes = BodyLanguage::parse_language_changes(&text).map_err(|error| fault(error.to_string()))?;
    let values = changes.values.into_iter().map(|(name, value)| {
        let value = LanguageValue {
            value,
            quartiles: None,
            count: 0,
            of: file.to_owned(),
        };
        (name, value)
    });
    Ok(BodyLanguageChanges {
        from: file.to_owned(),
        values: values.collect::<BTreeMap<_, _>>(),
        places: changes.places,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_invalid_language_file_is_refused_with_a_suggestion() {
        let folder = tempfile::tempdir().expect("a folder");
        let says = |name: &str| read_body_language_file(name).expect_err(name).to_string();
        assert!(says("mesured").contains("measured"));
        assert!(says("quite").contains("quiet"));
        let path = folder.path().join("mine.json");
        let file = path.display().to_string();
        for (text, said) in [
            ("{", "line 1"),
            (r#"{"version": 9}"#, "version 9"),
            (
                r#"{"version": 1, "values": {"move.bik": [0.5, "arm", ""]}}"#,
                "move.big",
            ),
            (r#"{"version": 1, "values": {"move.big": [0.5, "cm", ""]}}"#, "\"arm\""),
            (r#"{"version": 1, "places": {"chinn": [0, 0, 0]}}"#, "chin"),
            (r#"{"version": 1, "places": {"chin": [0, 7, 0]}}"#, "-1 to 1"),
        ] {
            fs::write(&path, text).expect("written");
            assert!(says(&file).contains(said), "{text}: {}", says(&file));
        }
        let text = r#"{"version": 1, "values": {"move.big": [0.5, "arm", "me"]}, "places": {"chin": [0, 0.1, 0]}}"#;
        fs::write(&path, text).expect("written");
        let language = read_body_language_file(&file).expect("good");
        assert_eq!(language.values["move.big"].value, 0.5);
        assert_eq!(language.places["chin"], [0.0, 0.1, 0.0]);
    }
}
