//! Kinds of files that an import can only name, with a step that makes their contents readable.

use std::borrow::Cow;
use std::path::Path;

use chereme_sign::ErrorRemedy;

use super::import_captured;
use super::readers::{list_readable_endings, lower_file_ending};
use crate::error::CorpusError;
use crate::words::InterfaceLanguage;

/// A kind of file that often accompanies readable files, or that colleagues have, but is not read.
struct UnreadFormat {
    endings: &'static [&'static str],
    /// A text that the file begins with, if the ending alone does not determine its kind.
    begins: Option<&'static str>,
    /// A noun for such files.
    what: &'static str,
    /// A step that makes its contents readable.
    remedy: ErrorRemedy,
}

impl UnreadFormat {
    const fn new(endings: &'static [&'static str], what: &'static str, remedy: ErrorRemedy) -> Self {
        Self {
            endings,
            begins: None,
            what,
            remedy,
        }
    }

    const fn advised(endings: &'static [&'static str], what: &'static str, remedy: &'static str) -> Self {
        Self::new(endings, what, ErrorRemedy::Advice(Cow::Borrowed(remedy)))
    }

    /// Returns the kind of XML files with this root element.
    const fn xml(begins: &'static str, what: &'static str, remedy: &'static str) -> Self {
        Self {
            endings: &["xml"],
            begins: Some(begins),
            what,
            remedy: ErrorRemedy::Advice(Cow::Borrowed(remedy)),
        }
    }
}

const MEDIA_FILE_REMEDY: &str = "import the .eaf that names it; its recording is linked to it then";
const ANNOTATION_TABLE_REMEDY: &str =
    "write its annotations as a table (.csv) with the columns tier, start_s, end_s and value";
const BY_ELAN: &str = "import it in ELAN (File, Import), and save it as .eaf";

static UNREAD_FORMATS: &[UnreadFormat] = &[
    UnreadFormat::advised(
        &["txt"],
        "text without HamNoSys",
        "a .txt holds HamNoSys, a sign a line: the gloss, a tab, and symbols or their names",
    ),
    UnreadFormat::xml(
        "<basic-transcription",
        "a transcription of EXMARaLDA",
        "give its name the ending .exb",
    ),
    UnreadFormat::xml(
        "<annotation-spec",
        "a specification of ANVIL",
        "import the .anvil files that were made with it",
    ),
    UnreadFormat::xml(
        "<SIGNSTREAM_DAI",
        "a download of SignStream collections, whose times have no stated unit",
        ANNOTATION_TABLE_REMEDY,
    ),
    UnreadFormat::xml("<CHAT", "a transcript of CLAN", BY_CLAN),
    UnreadFormat::advised(
        &["xml"],
        "XML without SiGML",
        "an .xml holds SiGML or a collection of SignStream: its root is <sigml> or <SIGNSTREAM-DATABASE>",
    ),
    UnreadFormat::advised(&["cha"], "a transcript of CLAN (CHAT)", BY_CLAN),
    UnreadFormat::advised(
        &["collection"],
        "a collection of Praat",
        "select each TextGrid of it in Praat, and save it as a file of its own",
    ),
    UnreadFormat::advised(
        &["exs"],
        "a segmented transcription of EXMARaLDA",
        "import the .exb that it was made from",
    ),
    UnreadFormat::advised(&["ss3"], "a collection of SignStream 3", ANNOTATION_TABLE_REMEDY),
    UnreadFormat::advised(&["trs"], "a transcript of Transcriber", BY_ELAN),
    UnreadFormat::advised(&["flextext"], "a text of FLEx", BY_ELAN),
    UnreadFormat::advised(
        &["boris"],
        "a project of BORIS",
        "export its events in BORIS as TextGrid, and import that",
    ),
    UnreadFormat::advised(
        &["par", "bpf"],
        "annotations of BAS (Partitur)",
        "convert them into .TextGrid or .eaf with the services of BAS, and import that",
    ),
    UnreadFormat::advised(&["opf"], "a spreadsheet of Datavyu", ANNOTATION_TABLE_REMEDY),
    UnreadFormat::advised(
        &["annotation", "annotation~"],
        "annotations of NOVA",
        ANNOTATION_TABLE_REMEDY,
    ),
    UnreadFormat::advised(&["tra"], "a transcript of Transana", ANNOTATION_TABLE_REMEDY),
    UnreadFormat::advised(
        &["mx18", "mx20", "mx22", "mx24"],
        "a project of MAXQDA",
        ANNOTATION_TABLE_REMEDY,
    ),
    #[cfg(not(feature = "fbx"))]
    UnreadFormat::advised(
        &["fbx"],
        "movement in a form that this build of the program does not read",
        "open it in Blender and export .glb or .bvh",
    ),
    UnreadFormat::advised(&["wav", "mp3"], "sound", MEDIA_FILE_REMEDY),
    UnreadFormat::advised(&["png", "jpg", "jpeg", "gif"], "pictures", MEDIA_FILE_REMEDY),
    UnreadFormat::new(
        &["chereme"],
        "a corpus",
        ErrorRemedy::Command(Cow::Borrowed(
            "merge it into yours: `chereme merge CORPUS OTHER`; or export its files, and import those",
        )),
    ),
];

const BY_CLAN: &str = "convert it with chat2elan in CLAN, and import the .eaf";

/// Returns the error for a file of a kind that is not read, with a step that makes its contents readable.
pub(super) fn unread_format_error(path: &Path) -> CorpusError {
    let ending = lower_file_ending(path).unwrap_or_default();
    let known_kind = UNREAD_FORMATS.iter().find(|kind| {
        kind.endings.contains(&ending.as_str()) && kind.begins.is_none_or(|root| begins_with_text(path, root))
    });
    let (message, remedy) = match known_kind {
        Some(known) => (format!("it holds {}", known.what), known.remedy.clone()),
        None => (
            "this kind of file is not known".to_owned(),
            format!(
                "files that are read end in {}",
                list_readable_endings(InterfaceLanguage::English)
            )
            .into(),
        ),
    };
    CorpusError::from_wrong_message(message)
        .with_error_place(path.display().to_string())
        .with_advice(remedy)
}

/// Returns whether the first bytes of a file contain a text, in UTF-8 or UTF-16.
pub(super) fn begins_with_text(path: &Path, text: &str) -> bool {
    let head = import_captured::read_file_head(path).unwrap_or_default();
    // In UTF-16, each letter of ASCII comes with a zero byte, without which the text can be compared.
    let plain: Vec<u8> = head.into_iter().filter(|byte| *byte != 0).collect();
    plain.windows(text.len()).any(|part| part == text.as_bytes())
}
