//! `chereme words`: the languages of the interfaces, and what each of them lacks.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::words::InterfaceLanguage;
use chereme_corpus::{LanguageCoverage, language_coverage};

use crate::args::CommandLine;
use crate::output::CommandOutput;

/// List the languages of the programs, or what a translator has to do
///
/// A language is a folder of files in Fluent's syntax, as schema/words/fr has them. The environment variable CHEREME_WORDS
/// names a folder with such folders of your own: both programs and published pages read them besides their own, and
/// --language takes their names. What a language lacks is English.
#[derive(Debug, clap::Args)]
pub(crate) struct WordsArgs {
    /// List the phrases that this language lacks, and those that cannot be used
    #[arg(long, value_name = "LANGUAGE")]
    missing: Option<String>,
    /// Read this folder of languages, too, as CHEREME_WORDS would name it
    #[arg(long, value_name = "DIR", requires = "missing")]
    folder: Option<PathBuf>,
}

pub(super) fn run(_: &CommandLine, args: &WordsArgs, output: &mut CommandOutput) -> Result<()> {
    let Some(code) = &args.missing else {
        let mut rows = Vec::new();
        let mut languages = Vec::new();
        for (language, name) in InterfaceLanguage::all_listed() {
            let coverage = language_coverage(language.language_code(), None)?;
            let counts = [coverage.translated, coverage.phrases].map(|count| count.to_string());
            let row = [language.language_code(), name, &counts[0], &counts[1]];
            rows.push(row.map(str::to_owned).to_vec());
            languages.push(serde_json::json!({
                "language": language.language_code(), "name": name,
                "translated": coverage.translated, "phrases": coverage.phrases,
            }));
        }
        output.write_titled_table(&["language", "name", "translated", "phrases"], &rows)?;
        return output.set_json_document(serde_json::json!({ "languages": languages }));
    };
    let coverage = language_coverage(code, args.folder.as_deref())?;
    let LanguageCoverage { missing, faults, .. } = &coverage;
    if !missing.is_empty() {
        output.write_item_table(
            missing,
            &[
                ("id", &|row| row.id.clone()),
                ("English", &|row| row.english.clone()),
                ("place", &|row| row.place.clone()),
            ],
        )?;
    }
    for row in faults {
        output.write_output_line(format!("{}: {}", row.place, row.fault))?;
    }
    let (count, phrases) = (missing.len(), coverage.phrases);
    output.write_output_line(format!("{code} lacks {count} of {phrases} phrases"))?;
    output.set_json_document(&coverage)
}
