//! Movement from notation: HamNoSys text, SiGML files, and signs that the corpus holds as notation.

use std::fs;
use std::path::Path;

use chereme_compose::VERSION;
use chereme_compose::recipe::{Node, Notation};
use chereme_sign::hamnosys;
use serde_json::json;

use crate::Corpus;
use crate::error::{Error, Result};
use crate::recombine::Recombination;
use crate::sources::notation::NEXT;

/// The longest file of plain HamNoSys that is read.
const MOST_BYTES: u64 = 1 << 20;

impl Corpus {
    /// Makes movement of notation: of HamNoSys text, of a SiGML or HamNoSys file, or of signs that the
    /// corpus holds as notation, one after the other; stores it under `gloss` where there is one.
    ///
    /// `signer` is the address of a signer or a recording whose body signs; without one the corpus
    /// chooses, and one without any movement takes the body that comes with the program.
    ///
    /// # Errors
    /// Where the notation cannot be read, with the symbol or the line; where nothing notated has that
    /// name; where the body has no arms. Nothing half-made is stored.
    pub fn animate(
        &mut self,
        notation: &[&str],
        signer: Option<&str>,
        gloss: Option<&str>,
    ) -> Result<Recombination> {
        let recipe = json!({"version": VERSION, "make": leaf(notation, signer)?}).to_string();
        match gloss {
            Some(gloss) => self.recombine(&recipe, gloss),
            None => self.preview(&recipe),
        }
    }
}

fn leaf(notation: &[&str], signer: Option<&str>) -> Result<Node> {
    let on = signer.map(str::to_owned);
    let text = match notation {
        [] => {
            return Err(Error::wrong("there is no notation")
                .advise("write HamNoSys, a SiGML file, or the gloss of a notated sign"));
        }
        [one] => plain_text(one)?,
        _ => None,
    };
    Ok(match text {
        Some(of) => {
            hamnosys::parse(&of).map_err(|error| {
                Error::wrong(error.to_string())
                    .at("the HamNoSys text")
                    .advise("symbols may be written as characters or by name: hamflathand hamextfingeru hampalml")
            })?;
            Node::Hamnosys(Notation { of, on })
        }
        None => Node::Sigml(Notation {
            of: notation.join(NEXT),
            on,
        }),
    })
}

/// Returns HamNoSys text, typed or from a file of it; nothing for anything else.
fn plain_text(notation: &str) -> Result<Option<String>> {
    let path = Path::new(notation);
    let extension = path
        .extension()
        .and_then(|it| it.to_str())
        .unwrap_or_default();
    if matches!(extension, "hns" | "txt") && path.is_file() {
        let size = fs::metadata(path)
            .map_err(|error| Error::file(path, error))?
            .len();
        if size > MOST_BYTES {
            return Err(Error::wrong("it is too long for the HamNoSys of a sign")
                .at(notation)
                .advise("import it as a lexicon, then animate its signs by gloss"));
        }
        let text = fs::read_to_string(path).map_err(|error| Error::file(path, error))?;
        return Ok(Some(text.trim().to_owned()));
    }
    let symbols = notation
        .chars()
        .any(|c| ('\u{e000}'..='\u{f8ff}').contains(&c));
    let named = notation
        .split_whitespace()
        .next()
        .is_some_and(|word| hamnosys::symbol::Symbol::from_name(word).is_some());
    Ok((symbols || named).then(|| notation.to_owned()))
}
