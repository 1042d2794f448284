//! Generates movement from notation: HamNoSys text, SiGML files, and signs that the corpus has as notation.

use std::path::Path;

use chereme_compose::recipe::{Node, Notation};
use chereme_compose::{Sources, VERSION};
use chereme_formats::Finding;
use chereme_motion::Side;
use chereme_motion::anatomy::Anatomy;
use chereme_sign::hamnosys::{self, Sign};
use chereme_sign::text::{did_you_mean, nearest};
use chereme_sign::{Choice, Remedy};
use serde_json::json;

use crate::Corpus;
use crate::address::{self, Address, Name};
use crate::db::recordings;
use crate::error::{Error, Result};
use crate::notation;
use crate::recombine::{NotationFinding, Recombination};
use crate::sources::CorpusSources;
use crate::sources::notation::{NEXT, OWN_BODY};

/// The signer and the body language for notated signs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Staging<'a> {
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
    pub fn animate(
        &mut self,
        notation: &[&str],
        staging: &Staging<'_>,
        gloss: Option<&str>,
    ) -> Result<Recombination> {
        let body = staging.signer.map(|it| self.body(it)).transpose()?;
        let staging = &Staging {
            signer: body.as_deref(),
            ..*staging
        };
        let (node, mut findings) = leaf(notation, staging)?;
        let recipe = json!({"version": VERSION, "make": node}).to_string();
        let mut done = match gloss {
            Some(gloss) => self.recombine(&recipe, gloss),
            None => self.preview(&recipe),
        }?;
        findings.extend(without_fingers(&done.anatomy));
        for finding in &findings {
            done.explanation += &format!("\nwarning: {finding}");
        }
        let texts = findings.iter().map(ToString::to_string);
        done.report.warnings.splice(0..0, texts);
        done.findings = findings;
        Ok(done)
    }

    /// Returns the address of a body; the text may be just the name of a signer or a recording.
    ///
    /// # Errors
    /// Fails if the corpus has no signer and no recording of that name.
    pub(crate) fn body(&self, wanted: &str) -> Result<String> {
        let connection = self.store.read();
        let name = || Name::Text(wanted.to_owned());
        match wanted.parse() {
            _ if wanted == OWN_BODY => {}
            Ok(Address::Recording(name)) => drop(address::recording(connection, &name)?),
            Ok(Address::Signer(name)) => drop(address::signer(connection, &name)?),
            _ if address::signer(connection, &name()).is_ok() => {
                return Ok(Address::Signer(name()).to_string());
            }
            _ if address::recording(connection, &name()).is_ok() => {
                return Ok(Address::Recording(name()).to_string());
            }
            _ => {
                let (signers, takes) = (
                    recordings::signers(connection)?,
                    recordings::recordings(connection)?,
                );
                let signers = signers.iter().map(|signer| signer.name.as_str());
                let takes = takes.iter().map(|take| take.name.as_str());
                let near = did_you_mean(nearest(wanted, signers.chain(takes)));
                return Err(Error::wrong(format!("{wanted:?} names nobody's body{near}")).advise(
                    Remedy::command("write the name of a signer or a recording; `chereme list CORPUS signers` lists them"),
                ));
            }
        }
        Ok(wanted.to_owned())
    }

    /// Returns the address of the body that the corpus chooses if none is named.
    pub(crate) fn chosen_body(&mut self) -> Result<String> {
        let inventories = self.inventories_now()?;
        let sources = CorpusSources::open(&mut self.store, &inventories, &self.learned)?;
        let stage = sources.stage(None);
        let stage = stage.map_err(|error| Error::wrong(error.to_string()))?;
        Ok(stage.address)
    }
}

/// Returns a warning that handshapes are not visible on a body whose skeleton has no fingers.
fn without_fingers(anatomy: &Anatomy) -> Option<NotationFinding> {
    let without: Vec<&str> = Side::BOTH
        .into_iter()
        .filter(|&side| !anatomy.has_fingers(side))
        .map(Side::name)
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
        remedy: Some(Remedy::choice(
            Choice::JointRoles,
            "name another body with --signer, or the joints in a roles file",
        )),
    })
}

/// Returns the leaf of the recipe, and findings about the notation.
fn leaf(notation: &[&str], staging: &Staging<'_>) -> Result<(Node, Vec<NotationFinding>)> {
    let notated = |of: String| Notation {
        of,
        language: staging.language.map(str::to_owned),
        on: staging.signer.map(str::to_owned),
    };
    let text = match notation {
        all if all.iter().all(|it| it.trim().is_empty()) => {
            return Err(Error::wrong("there is no notation")
                .advise("write HamNoSys, a SiGML file, or the gloss of a notated sign"));
        }
        [one] => plain_text(one)?,
        _ => None,
    };
    Ok(match text {
        Some(text) => {
            let (of, findings) = understood(&text)?;
            (Node::Hamnosys(notated(of)), findings)
        }
        None => {
            let (mut names, mut findings) = (Vec::new(), Vec::new());
            for name in notation {
                let text = (notation.len() > 1 && !Path::new(name).is_file())
                    .then(|| plain_text(name))
                    .transpose()?;
                let (name, odd) = match text.flatten() {
                    Some(text) => understood(&text)?,
                    None => ((*name).to_owned(), odd_in_file(name)?),
                };
                names.push(name);
                findings.extend(odd);
            }
            (Node::Sigml(notated(names.join(NEXT))), findings)
        }
    })
}

/// Returns HamNoSys text that can be read completely: the given text, or the understood part of it, with findings.
fn understood(text: &str) -> Result<(String, Vec<NotationFinding>)> {
    let (read, whole) = match hamnosys::parse(text) {
        Ok(read) => (read, None),
        Err(error) => (hamnosys::parse_lenient(text), Some(error)),
    };
    let converted = |finding: &hamnosys::Finding| NotationFinding {
        file: None,
        line: None,
        symbol: Some(finding.number()),
        message: finding.message.clone(),
        remedy: Some(finding.remedy.into()),
    };
    let mut findings: Vec<NotationFinding> = read.findings.iter().map(converted).collect();
    let Some(error) = whole else {
        return Ok((text.to_owned(), findings));
    };
    let known = hamnosys::print(&unspelled(&read.sign)?).text;
    if known.is_empty() || hamnosys::parse(&known).is_err() {
        return Err(Error::wrong(error.to_string()).at("the HamNoSys text").advise(
            "symbols may be written as characters or by name: hamflathand hamextfingeru hampalml",
        ));
    }
    let names = hamnosys::to_names(&known).unwrap_or_default();
    findings.push(NotationFinding {
        file: None,
        line: None,
        symbol: None,
        message: format!("made of what was understood: {}", names.join(" ")),
        remedy: None,
    });
    Ok((known, findings))
}

/// Returns a sign without its original spelling and odd symbols.
fn unspelled(sign: &Sign) -> Result<Sign> {
    let tree = serde_json::to_value(sign).and_then(serde_json::from_value);
    tree.map_err(|error| Error::wrong(format!("the notation cannot be copied: {error}")))
}

/// Returns findings about a file of notation; none if the name is not that of a file.
fn odd_in_file(name: &str) -> Result<Vec<NotationFinding>> {
    const ENDINGS: [&str; 5] = ["sigml", "hsigml", "xml", "hns", "txt"];
    let path = Path::new(name);
    if !path.is_file() {
        let ending = path.extension().and_then(|it| it.to_str());
        if name.contains(char::is_whitespace) || !ending.is_some_and(|it| ENDINGS.contains(&it)) {
            return Ok(Vec::new());
        }
        return Err(Error::wrong(format!("there is no file {name:?}"))
            .advise("name a file, or a sign that the corpus holds as notation by its gloss"));
    }
    let (_, findings) = notation::read_notation(path)?;
    let converted = |finding: Finding| NotationFinding {
        file: Some(name.to_owned()),
        line: finding.line,
        symbol: None,
        message: finding.message,
        remedy: finding.remedy,
    };
    Ok(findings.into_iter().map(converted).collect())
}

/// Returns HamNoSys text, typed or from a file with one sign; nothing for other inputs.
fn plain_text(notation: &str) -> Result<Option<String>> {
    let path = Path::new(notation);
    let lines = path
        .extension()
        .is_some_and(|it| it == "hns" || it == "txt");
    if lines && path.is_file() {
        let (mut signs, _) = notation::read_notation(path)?;
        let whole: Vec<_> = signs.iter().filter_map(|it| it.text.as_deref()).collect();
        let whole = whole.join(" ");
        if signs.len() > 1 && hamnosys::parse(&whole).is_ok() {
            return Ok(Some(whole));
        }
        let one = if signs.len() == 1 { signs.pop() } else { None };
        return Ok(one.and_then(|sign| sign.text));
    }
    let plain = hamnosys::in_plain_symbols(notation);
    let symbols = plain
        .chars()
        .any(|c| ('\u{e000}'..='\u{f8ff}').contains(&c));
    let words: Vec<&str> = plain
        .split(|c: char| c.is_whitespace() || c == ',')
        .filter(|word| !word.is_empty())
        .collect();
    let named = words
        .first()
        .is_some_and(|word| hamnosys::symbol::Symbol::from_name(word).is_some());
    // If all words look like names of symbols, they are taken as such, even if some are unknown.
    let meant = words.len() > 1 && words.iter().all(|word| word.starts_with("ham"));
    Ok((symbols || named || meant).then(|| notation.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn an_odd_string_is_animated_as_far_as_understood_with_findings() {
        let whole = "hamfist hamextfingeru hampalml hamchest hamclose";
        assert_eq!(
            understood(whole).expect("whole"),
            (whole.to_owned(), vec![])
        );
        let (known, findings) =
            understood("hamfist hamextfingeru hampalml hamparend hamchest").expect("some of it");
        assert!(hamnosys::parse(&known).is_ok());
        assert!(
            findings.iter().any(|it| it.symbol == Some(4)),
            "{findings:?}"
        );
        let last = findings.last().expect("what was made");
        assert!(
            last.message.contains("hamfist hamextfingeru hampalml"),
            "{last}"
        );
        assert!(understood("hamparend").is_err(), "nothing is understood");
    }

    #[test]
    fn signs_are_animated_one_after_another_however_they_are_given() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = Corpus::create(&folder.path().join("a.chereme"), "A").expect("made");
        let (fist, flat) = (
            "hamfist hamextfingeru hampalml hamchest",
            "hamflathand hamextfingeru hampalml hamchin hamtouch",
        );
        let mut animate = |notation: &[&str], gloss: Option<&str>| {
            corpus.animate(notation, &Staging::default(), gloss)
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
        corpus.recombine("FLAT | swap", "SWAPPED").expect("made");
        corpus.recombine("sigml FLAT", "AGAIN").expect("made");
        for (gloss, notation) in [
            ("FLAT", Some(flat)),
            ("SWAPPED", None),
            ("AGAIN", Some(flat)),
        ] {
            let address: Address = gloss.parse().expect("an address");
            let found = corpus.notation(&address).ok();
            assert_eq!(found.as_ref().and_then(|it| it.text.as_deref()), notation);
            let mut written = Vec::new();
            let what = crate::ExportWhat::Address(address);
            let mut hear = crate::unheard;
            let mut progress = crate::Progress::new(&mut hear);
            let notes = corpus.export_stream(&what, "hns", &mut written, &mut progress);
            assert_eq!(notes.is_ok(), notation.is_some(), "{gloss}");
        }
    }

    #[test]
    fn a_sign_of_an_odd_string_is_stored_with_a_recipe_that_evaluates_again() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.chereme");
        let mut corpus = Corpus::create(&path, "A").expect("made");
        let odd = "hamfist hamextfingeru hampalml hamparend hamchest";
        let done = corpus
            .animate(&[odd], &Staging::default(), Some("ODD"))
            .expect("made");
        assert!(done.report.warnings[0].contains("symbol 4"));
        assert!(done.explanation.contains("made of what was understood"));
        assert!(corpus.preview(&done.recipe).is_ok(), "{}", done.recipe);
        let file = folder.path().join("odd.sigml");
        let text = "<sigml><hamgestural_sign gloss=\"X\"><sign_manual><handconfig handshape=\"fist\" \
                    extfidir=\"uuo\" palmor=\"l\"/></sign_manual></hamgestural_sign></sigml>";
        fs::write(&file, text).expect("written");
        let done = corpus
            .animate(&[&file.to_string_lossy()], &Staging::default(), None)
            .expect("made");
        assert!(
            done.report.warnings[0].contains("line 1"),
            "{:?}",
            done.report.warnings
        );
    }
}
