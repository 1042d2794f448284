//! Generates movement from notation: HamNoSys text, SiGML files, and signs that the corpus has as notation.

use std::path::Path;

use chereme_compose::recipe::{NotationSettings, RecipeNode};
use chereme_compose::{RECIPE_TREE_VERSION, RecipeSources};
use chereme_formats::ImportFinding;
use chereme_motion::BodySide;
use chereme_motion::anatomy::BodyAnatomy;
use chereme_sign::hamnosys::{self, HamnosysSign};
use chereme_sign::text::{did_you_mean, nearest_candidate};
use chereme_sign::{ErrorRemedy, RemedyChoice};
use serde_json::json;

use crate::Corpus;
use crate::address::{self, CorpusAddress, RowName};
use crate::db::stored_recordings;
use crate::error::{CorpusError, CorpusResult};
use crate::notation;
use crate::recombine::{NotationFinding, RecombinationResult};
use crate::sources::CorpusSources;
use crate::sources::sources_notation::SIGN_NAME_SEPARATOR;
use crate::starter::OWN_BODY;

/// The signer and the body language for notated signs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct NotationStaging<'a> {
    /// The name or address of a signer or a recording whose body signs. Without one the corpus chooses; a corpus
    /// without movement takes the body that comes with the program.
    pub signer: Option<&'a str>,
    /// The body language: `default`, `measured` in the corpus's captured signs, or a file. Without one the measured
    /// body language is used if there are enough measurements.
    pub language: Option<&'a str>,
}

impl Corpus {
    /// Generates movement from notation: HamNoSys text, a SiGML or HamNoSys file, or signs that the corpus has as
    /// notation, one after the other. Stores it under `gloss` if one is given.
    ///
    /// If HamNoSys cannot be read completely, movement is generated from the parts that were understood; warnings of
    /// the report list the other parts, and oddities of a file.
    ///
    /// # Errors
    /// Fails if the notation cannot be read (the error names the symbol or the line), if nothing notated has that name,
    /// or if the body has no arms. Nothing incomplete is stored.
    pub fn animate_notation(
        &mut self,
        notation: &[&str],
        staging: &NotationStaging<'_>,
        gloss: Option<&str>,
    ) -> CorpusResult<RecombinationResult> {
        let body = staging.signer.map(|signer| self.body_address(signer)).transpose()?;
        let staging = &NotationStaging {
            signer: body.as_deref(),
            ..*staging
        };
        let (node, mut findings) = notation_leaf(notation, staging)?;
        let recipe = json!({"version": RECIPE_TREE_VERSION, "make": node}).to_string();
        let mut done = match gloss {
            Some(gloss) => self.recombine_recipe(&recipe, gloss),
            None => self.preview_recipe(&recipe),
        }?;
        findings.extend(without_fingers(&done.anatomy));
        for finding in &findings {
            done.explanation += &format!("\nwarning: {finding}");
        }
        let texts = findings.iter().map(ToString::to_string);
        // Findings about the notation come first, as they explain what the movement lacks.
        done.report.warnings.splice(0..0, texts);
        done.findings = findings;
        Ok(done)
    }

    /// Returns the address of a body; the text may be just the name of a signer or a recording.
    ///
    /// # Errors
    /// Fails if the corpus has no signer and no recording of that name.
    pub(crate) fn body_address(&self, wanted: &str) -> CorpusResult<String> {
        let connection = self.store.read_connection();
        let name = || RowName::Text(wanted.to_owned());
        match wanted.parse() {
            _ if wanted == OWN_BODY => {}
            Ok(CorpusAddress::Recording(name)) => drop(address::find_recording_by_name(connection, &name)?),
            Ok(CorpusAddress::Signer(name)) => drop(address::find_signer_by_name(connection, &name)?),
            _ if address::find_signer_by_name(connection, &name()).is_ok() => {
                return Ok(CorpusAddress::Signer(name()).to_string());
            }
            _ if address::find_recording_by_name(connection, &name()).is_ok() => {
                return Ok(CorpusAddress::Recording(name()).to_string());
            }
            _ => {
                let (signers, takes) = (
                    stored_recordings::load_signer_rows(connection)?,
                    stored_recordings::load_recording_rows(connection)?,
                );
                let signers = signers.iter().map(|signer| signer.name.as_str());
                let takes = takes.iter().map(|take| take.name.as_str());
                let near = did_you_mean(nearest_candidate(wanted, signers.chain(takes)));
                return Err(
                    CorpusError::from_wrong_message(format!("{wanted:?} names nobody's body{near}"))
                        .with_command_advice(
                            "write the name of a signer or a recording; `chereme list CORPUS signers` lists them",
                        ),
                );
            }
        }
        Ok(wanted.to_owned())
    }

    /// Returns the address of the body that the corpus chooses if none is named.
    pub(crate) fn chosen_body(&mut self) -> CorpusResult<String> {
        let inventories = self.inventories_now()?;
        let sources = CorpusSources::open_corpus_sources(&mut self.store, &inventories, &self.learned)?;
        let usual_stage = sources.stage(None);
        let stage = usual_stage.map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
        Ok(stage.address)
    }
}

/// Returns a warning that handshapes are not visible on a body whose skeleton has no fingers.
fn without_fingers(anatomy: &BodyAnatomy) -> Option<NotationFinding> {
    let without: Vec<&str> = BodySide::BOTH_SIDES
        .into_iter()
        .filter(|&side| !anatomy.has_fingers(side))
        .map(BodySide::body_side_name)
        .collect();
    let hands = match without[..] {
        [] => return None,
        [one] => format!("{one} hand lacks"),
        _ => "hands lack".to_owned(),
    };
    Some(NotationFinding {
        file: None,
        line: None,
        symbol: None,
        message: format!("the body's {hands} joints of fingers: no handshape can be seen"),
        remedy: Some(ErrorRemedy::choice_remedy(
            RemedyChoice::JointRoles,
            "name another body with --signer, or the joints in a roles file",
        )),
    })
}

/// Returns the leaf of the recipe, and findings about the notation.
fn notation_leaf(notation: &[&str], staging: &NotationStaging<'_>) -> CorpusResult<(RecipeNode, Vec<NotationFinding>)> {
    let notated = |of: String| NotationSettings {
        of,
        language: staging.language.map(str::to_owned),
        on: staging.signer.map(str::to_owned),
    };
    let text = match notation {
        all if all.iter().all(|text| text.trim().is_empty()) => {
            return Err(CorpusError::from_wrong_message("there is no notation")
                .with_advice("write HamNoSys, a SiGML file, or the gloss of a notated sign"));
        }
        [one] => plain_text(one)?,
        _ => None,
    };
    Ok(match text {
        Some(text) => {
            let (of, findings) = understood_notation(&text)?;
            (RecipeNode::Hamnosys(notated(of)), findings)
        }
        None => {
            let (mut names, mut findings) = (Vec::new(), Vec::new());
            for name in notation {
                // A single text was tried already, and a file is read as one.
                let text = (notation.len() > 1 && !Path::new(name).is_file())
                    .then(|| plain_text(name))
                    .transpose()?;
                let (name, odd) = match text.flatten() {
                    Some(text) => understood_notation(&text)?,
                    None => ((*name).to_owned(), odd_in_file(name)?),
                };
                names.push(name);
                findings.extend(odd);
            }
            (RecipeNode::Sigml(notated(names.join(SIGN_NAME_SEPARATOR))), findings)
        }
    })
}

/// Returns HamNoSys text that can be read completely: the given text, or the understood part of it, with findings.
fn understood_notation(text: &str) -> CorpusResult<(String, Vec<NotationFinding>)> {
    let (read, whole) = match hamnosys::parse_hamnosys(text) {
        Ok(read) => (read, None),
        Err(error) => (hamnosys::parse_lenient(text), Some(error)),
    };
    let converted = |finding: &hamnosys::HamnosysFinding| NotationFinding {
        file: None,
        line: None,
        symbol: Some(finding.symbol_number()),
        message: finding.message.clone(),
        remedy: Some(finding.remedy.into()),
    };
    let mut findings: Vec<NotationFinding> = read.findings.iter().map(converted).collect();
    let Some(error) = whole else {
        return Ok((text.to_owned(), findings));
    };
    // The understood part is written again, since the text as it stands cannot be read by the recipe either.
    let printed_text = hamnosys::print_hamnosys(&unspelled(&read.sign)?).text;
    if printed_text.is_empty() || hamnosys::parse_hamnosys(&printed_text).is_err() {
        return Err(CorpusError::from_wrong_message(error.to_string())
            .with_error_place("the HamNoSys text")
            .with_advice("symbols may be written as characters or by name: hamflathand hamextfingeru hampalml"));
    }
    let names = hamnosys::to_names(&printed_text).unwrap_or_default();
    findings.push(NotationFinding {
        file: None,
        line: None,
        symbol: None,
        message: format!("made of what was understood: {}", names.join(" ")),
        remedy: None,
    });
    Ok((printed_text, findings))
}

/// Returns a sign without its original spelling and odd symbols.
fn unspelled(sign: &HamnosysSign) -> CorpusResult<HamnosysSign> {
    // Fields that are only spelling are not serialised, so that a copy through JSON loses them.
    let tree = serde_json::to_value(sign).and_then(serde_json::from_value);
    tree.map_err(|error| CorpusError::from_wrong_message(format!("the notation cannot be copied: {error}")))
}

/// Returns findings about a file of notation; none if the name is not that of a file.
fn odd_in_file(name: &str) -> CorpusResult<Vec<NotationFinding>> {
    const NOTATION_FILE_ENDINGS: [&str; 5] = ["sigml", "hsigml", "xml", "hns", "txt"];
    let path = Path::new(name);
    if !path.is_file() {
        let ending = path.extension().and_then(|suffix| suffix.to_str());
        // A gloss may have a point in it; a name with an ending of notation files is a mistyped path.
        if name.contains(char::is_whitespace) || !ending.is_some_and(|suffix| NOTATION_FILE_ENDINGS.contains(&suffix)) {
            return Ok(Vec::new());
        }
        return Err(CorpusError::from_wrong_message(format!("there is no file {name:?}"))
            .with_advice("name a file, or a sign that the corpus holds as notation by its gloss"));
    }
    let (_, findings) = notation::read_notation(path)?;
    let converted = |finding: ImportFinding| NotationFinding {
        file: Some(name.to_owned()),
        line: finding.line,
        symbol: None,
        message: finding.message,
        remedy: finding.remedy,
    };
    Ok(findings.into_iter().map(converted).collect())
}

/// Returns HamNoSys text, typed or from a file with one sign; nothing for other inputs.
fn plain_text(notation: &str) -> CorpusResult<Option<String>> {
    let path = Path::new(notation);
    let lines = path
        .extension()
        .is_some_and(|suffix| suffix == "hns" || suffix == "txt");
    if lines && path.is_file() {
        let (mut signs, _) = notation::read_notation(path)?;
        let sign_texts: Vec<_> = signs.iter().filter_map(|sign| sign.text.as_deref()).collect();
        let joined_text = sign_texts.join(" ");
        // HamNoSys that was broken into lines reads as several signs, and as one if the lines are joined.
        if signs.len() > 1 && hamnosys::parse_hamnosys(&joined_text).is_ok() {
            return Ok(Some(joined_text));
        }
        let one = if signs.len() == 1 { signs.pop() } else { None };
        return Ok(one.and_then(|sign| sign.text));
    }
    let plain = hamnosys::in_plain_symbols(notation);
    // The HamNoSys font has its symbols in the private use area of Unicode.
    let symbols = plain.chars().any(|c| ('\u{e000}'..='\u{f8ff}').contains(&c));
    let words: Vec<&str> = plain
        .split(|c: char| c.is_whitespace() || c == ',')
        .filter(|word| !word.is_empty())
        .collect();
    let named = words
        .first()
        .is_some_and(|word| hamnosys::symbol::HamnosysSymbol::from_symbol_name(word).is_some());
    // If all words look like names of symbols, they are taken as such, even if some are unknown.
    let has_symbol_names = words.len() > 1 && words.iter().all(|word| word.starts_with("ham"));
    Ok((symbols || named || has_symbol_names).then(|| notation.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn an_odd_string_is_animated_as_far_as_understood_with_findings() {
        let whole = "hamfist hamextfingeru hampalml hamchest hamclose";
        assert_eq!(understood_notation(whole).expect("whole"), (whole.to_owned(), vec![]));
        let (known, findings) =
            understood_notation("hamfist hamextfingeru hampalml hamparend hamchest").expect("some of it");
        assert!(hamnosys::parse_hamnosys(&known).is_ok());
        assert!(findings.iter().any(|it| it.symbol == Some(4)), "{findings:?}");
        let last = findings.last().expect("what was made");
        assert!(last.message.contains("hamfist hamextfingeru hampalml"), "{last}");
        assert!(understood_notation("hamparend").is_err(), "nothing is understood");
    }

    #[test]
    fn signs_are_animated_one_after_another_however_they_are_given() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = Corpus::create_corpus(&folder.path().join("a.chereme"), "A").expect("made");
        let (fist, flat) = (
            "hamfist hamextfingeru hampalml hamchest",
            "hamflathand hamextfingeru hampalml hamchin hamtouch",
        );
        let mut animate = |notation: &[&str], gloss: Option<&str>| {
            corpus.animate_notation(notation, &NotationStaging::default(), gloss)
        };
        animate(&[flat], Some("FLAT")).expect("made");
        let file = folder.path().join("fist.sigml");
        let text = "<sigml><hns_sign gloss=\"F\"><hamnosys_manual><hamfist/><hamextfingeru/><hampalml/>\
                    <hamchest/></hamnosys_manual></hns_sign></sigml>";
        fs::write(&file, text).expect("written");
        let file = file.display().to_string();
        let both = animate(&[fist, flat], None).expect("made").duration_us;
        for notation in [
            [fist, "FLAT"],
            [&file, flat],
            [&file, "FLAT"],
            ["hamfist hamextfingeru hampalml hamchest hamnonsense", flat],
        ] {
            let done = animate(&notation, None).expect("made");
            assert_eq!(done.duration_us, both, "{notation:?}");
            let odd = notation[0].contains("nonsense");
            assert_eq!(done.findings.is_empty(), !odd, "{:?}", done.findings);
        }
        for nothing in ["", " "] {
            let error = animate(&[nothing], None).expect_err("nothing");
            assert_eq!(error.to_string(), "there is no notation");
        }
        // A sign keeps the notation from which it was generated, until its movement is another one.
        corpus.recombine_recipe("FLAT | swap", "SWAPPED").expect("made");
        corpus.recombine_recipe("sigml FLAT", "AGAIN").expect("made");
        for (gloss, notation) in [("FLAT", Some(flat)), ("SWAPPED", None), ("AGAIN", Some(flat))] {
            let address: CorpusAddress = gloss.parse().expect("an address");
            let found = corpus.notation_at(&address).ok();
            assert_eq!(found.as_ref().and_then(|it| it.text.as_deref()), notation);
            let mut written = Vec::new();
            let what = crate::ExportWhat::Address(address);
            let mut hear = crate::ignore_progress_step;
            let mut progress = crate::ProgressReceiver::new(&mut hear);
            let notes = corpus.export_stream(&what, "hns", &mut written, &mut progress);
            assert_eq!(notes.is_ok(), notation.is_some(), "{gloss}");
        }
    }

    #[test]
    fn a_sign_of_an_odd_string_is_stored_with_a_recipe_that_evaluates_again() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.chereme");
        let mut corpus = Corpus::create_corpus(&path, "A").expect("made");
        let odd = "hamfist hamextfingeru hampalml hamparend hamchest";
        let done = corpus
            .animate_notation(&[odd], &NotationStaging::default(), Some("ODD"))
            .expect("made");
        assert!(done.report.warnings[0].contains("symbol 4"));
        assert!(done.explanation.contains("made of what was understood"));
        assert!(corpus.preview_recipe(&done.recipe).is_ok(), "{}", done.recipe);
        let file = folder.path().join("odd.sigml");
        let text = "<sigml><hamgestural_sign gloss=\"X\"><sign_manual><handconfig handshape=\"fist\" \
                    extfidir=\"uuo\" palmor=\"l\"/></sign_manual></hamgestural_sign></sigml>";
        fs::write(&file, text).expect("written");
        let done = corpus
            .animate_notation(&[&file.to_string_lossy()], &NotationStaging::default(), None)
            .expect("made");
        assert!(done.report.warnings[0].contains("line 1"), "{:?}", done.report.warnings);
    }
}
