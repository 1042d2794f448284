//! Kinds of files that an import can only name, with a step that makes their contents readable.

use std::borrow::Cow;
use std::path::Path;

use chereme_sign::Remedy;

use super::captured;
use super::readers::{ending, endings};
use crate::error::Error;
use crate::words::Language;

/// A kind of file that often accompanies readable files, or that colleagues have, but is not read.
struct Unread {
    endings: &'static [&'static str],
    /// A text that the file begins with, if the ending alone does not determine its kind.
    begins: Option<&'static str>,
    /// A noun for such files.
    what: &'static str,
    /// A step that makes its contents readable.
    remedy: Remedy,
}

impl Unread {
    const fn new(endings: &'static [&'static str], what: &'static str, remedy: Remedy) -> Self {
        Self {
            endings,
            begins: None,
            what,
            remedy,
        }
    }

    const fn advised(
        endings: &'static [&'static str],
        what: &'static str,
        remedy: &'static str,
    ) -> Self {
        Self::new(endings, what, Remedy::Advice(Cow::Borrowed(remedy)))
    }

    /// Returns the kind of XML files with this root element.
    const fn xml(begins: &'static str, what: &'static str, remedy: &'static str) -> Self {
        Self {
            endings: &["xml"],
            begins: Some(begins),
            what,
            remedy: Remedy::Advice(Cow::Borrowed(remedy)),
        }
    }
}

const MEDIA: &str = "import the .eaf that names it; its recording is linked to it then";
const TABLE: &str =
    "write its annotations as a table (.csv) with the columns tier, start_s, end_s and value";
const BY_ELAN: &str = "import it in ELAN (File, Import), and save it as .eaf";

static UNREAD: &[Unread] = &[
    Unread::advised(
        &["txt"],
        "text without HamNoSys",
        "a .txt holds HamNoSys, a sign a line: the gloss, a tab, and symbols or their names",
    ),
    Unread::xml(
        "<basic-transcription",
        "a transcription of EXMARaLDA",
        "give its name the ending .exb",
    ),
    Unread::xml(
        "<annotation-spec",
        "a specification of ANVIL",
        "import the .anvil files that were made with it",
    ),
    Unread::xml(
        "<SIGNSTREAM_DAI",
        "a download of SignStream collections, whose times have no stated unit",
        TABLE,
    ),
    Unread::xml("<CHAT", "a transcript of CLAN", BY_CLAN),
    Unread::advised(
        &["xml"],
        "XML without SiGML",
        "an .xml holds SiGML or a collection of SignStream: its root is <sigml> or <SIGNSTREAM-DATABASE>",
    ),
    Unread::advised(&["cha"], "a transcript of CLAN (CHAT)", BY_CLAN),
    Unread::advised(
        &["collection"],
        "a collection of Praat",
        "select each TextGrid of it in Praat, and save it as a file of its own",
    ),
    Unread::advised(
        &["exs"],
        "a segmented transcription of EXMARaLDA",
        "import the .exb that it was made from",
    ),
    Unread::advised(&["ss3"], "a collection of SignStream 3", TABLE),
    Unread::advised(&["trs"], "a transcript of Transcriber", BY_ELAN),
    Unread::advised(&["flextext"], "a text of FLEx", BY_ELAN),
    Unread::advised(
        &["boris"],
        "a project of BORIS",
        "export its events in BORIS as TextGrid, and import that",
    ),
    Unread::advised(
        &["par", "bpf"],
        "annotations of BAS (Partitur)",
        "convert them into .TextGrid or .eaf with the services of BAS, and import that",
    ),
    Unread::advised(&["opf"], "a spreadsheet of Datavyu", TABLE),
    Unread::advised(&["annotation", "annotation~"], "annotations of NOVA", TABLE),
    Unread::advised(&["tra"], "a transcript of Transana", TABLE),
    Unread::advised(
        &["mx18", "mx20", "mx22", "mx24"],
        "a project of MAXQDA",
        TABLE,
    ),
    #[cfg(not(feature = "fbx"))]
    Unread::advised(
        &["fbx"],
        "movement in a form that this build of the program does not read",
        "open it in Blender and export .glb or .bvh",
    ),
    Unread::advised(&["wav", "mp3"], "sound", MEDIA),
    Unread::advised(&["png", "jpg", "jpeg", "gif"], "pictures", MEDIA),
    Unread::new(
        &["chereme"],
        "a corpus",
        Remedy::Command(Cow::Borrowed(
            "merge it into yours: `chereme merge CORPUS OTHER`; or export its files, and import those",
        )),
    ),
];

const BY_CLAN: &str = "convert it with chat2elan in CLAN, and import the .eaf";

/// Returns the error for a file of a kind that is not read, with a step that makes its contents readable.
pub(super) fn unread(path: &Path) -> Error {
    let ending = ending(path).unwrap_or_default();
    let known = UNREAD.iter().find(|it| {
        it.endings.contains(&ending.as_str()) && it.begins.is_none_or(|root| begins(path, root))
    });
    let (message, remedy) = match known {
        Some(known) => (format!("it holds {}", known.what), known.remedy.clone()),
        None => (
            "this kind of file is not known".to_owned(),
            format!("files that are read end in {}", endings(Language::English)).into(),
        ),
    };
    Error::wrong(message)
        .at(path.display().to_string())
        .advise(remedy)
}

/// Returns whether the first bytes of a file contain a text, in UTF-8 or UTF-16.
pub(super) fn begins(path: &Path, text: &str) -> bool {
    let head = captured::head(path).unwrap_or_default();
    let plain: Vec<u8> = head.into_iter().filter(|byte| *byte != 0).collect();
    plain
        .windows(text.len())
        .any(|part| part == text.as_bytes())
}
