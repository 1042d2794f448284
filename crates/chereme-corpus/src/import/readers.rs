//! The kinds of files that an import reads. Those that it can only name are in `unread.rs`.
//!
//! To add a format, write a reading function in `chereme-formats` and add an entry to [`FILE_READERS`].

use std::fmt::Display;
use std::path::Path;

use chereme_formats::eaf::AnnotationTranscript;
use chereme_formats::tracks::CapturedTracks;
use chereme_formats::{
    ImportFinding, anvil, c3d, eaf as elan_file, exmaralda, pose, signstream, subtitles, textgrid, trc, xra,
};

use super::import_unread::begins_with_text;
pub(super) use super::import_unread::unread_format_error;
use super::{
    FileReport, ImportJob, elan, import_bvh, import_captured, import_changes, import_eaf, import_film, import_notated,
};
use crate::error::{CorpusError, CorpusResult};
use crate::notation::NotationFormat;
use crate::progress::ProgressReceiver;
use crate::words::{InterfaceLanguage, filled_message};

/// Reads bytes of a foreign file as a document with findings, or says what is wrong with them.
pub(crate) type ParseFunction<T> = fn(&[u8]) -> std::result::Result<(T, Vec<ImportFinding>), String>;

/// Reads a file into the corpus.
type ImportFunction = fn(&mut ImportJob<'_>, &mut ProgressReceiver<'_>) -> CorpusResult<FileReport>;

/// A kind of file that can be imported.
pub(super) struct FileReader {
    /// The file name endings of such files, in lower case, without the dot.
    pub(super) endings: &'static [&'static str],
    /// The kind in `source_file.kind`.
    pub(super) kind: &'static str,
    /// The contents of such files for people, in the plural: a message of the files of words.
    pub(super) holds: &'static str,
    /// Decides whether a file with one of these endings is of this kind, if the ending alone does not determine it.
    looks: fn(&Path) -> bool,
    /// Whether such files never add an inventory, so that the next one need not load them again.
    pub(super) keeps_inventories: bool,
    /// The use of the contents.
    contents: FileContentUse,
}

/// The use of a file's contents.
enum FileContentUse {
    /// Annotations, which become tiers of a recording and update it if the file was edited since.
    Annotations(ParseFunction<AnnotationTranscript>),
    /// A template: tiers without annotations, which have an import of their own.
    Template(ParseFunction<AnnotationTranscript>, ImportFunction),
    /// Tracks, such as markers or curves.
    Tracks(ParseFunction<CapturedTracks>),
    /// The movement of a body, around which the other files of a folder gather.
    Movement(ImportFunction),
    /// Contents with an import of their own.
    Other(ImportFunction),
}

impl FileReader {
    /// Reads a file into the corpus.
    pub(super) fn import_with_reader(
        &self,
        job: &mut ImportJob<'_>,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<FileReport> {
        match self.contents {
            FileContentUse::Annotations(parse) => import_eaf::import_as(job, progress, parse),
            FileContentUse::Tracks(parse) => import_captured::import_tracks(job, progress, parse),
            FileContentUse::Template(_, import) | FileContentUse::Movement(import) | FileContentUse::Other(import) => {
                import(job, progress)
            }
        }
    }

    /// Returns whether such files are read piece by piece, so that they may be of any size.
    pub(super) fn is_streamed(&self) -> bool {
        ["bvh", import_film::FILM_KIND].contains(&self.kind)
    }

    /// Returns whether such files hold the movement of a body.
    pub(super) fn is_movement(&self) -> bool {
        matches!(self.contents, FileContentUse::Movement(_))
    }

    /// Returns whether such files are annotation files.
    pub(super) fn holds_annotations(&self) -> bool {
        matches!(self.contents, FileContentUse::Annotations(_))
    }

    /// Returns the function that reads annotations or tiers from the bytes of such a file, if they hold some.
    fn reader_transcript_parser(&self) -> Option<ParseFunction<AnnotationTranscript>> {
        match self.contents {
            FileContentUse::Annotations(parse) | FileContentUse::Template(parse, _) => Some(parse),
            _ => None,
        }
    }
}

const ANNOTATIONS_NOUN: &str = "annotations";
const MARKERS_NOUN: &str = "markers";
const MOVEMENT_NOUN: &str = "movement";

/// The kinds in the order in which an import reads them. Annotations come after movement, so that they find their
/// recordings and values; films come after annotations, because annotation files name them; tables of
/// annotations need the recordings of all other files; templates come last, for
/// the recordings that still have no tiers.
pub(super) static FILE_READERS: &[FileReader] = &[
    FileReader {
        endings: &["json"],
        kind: "inventory",
        holds: "inventories, signs, scores of a face, points from film of OpenPose or MediaPipe",
        looks: always,
        keeps_inventories: false,
        contents: FileContentUse::Other(import_captured::import_json),
    },
    FileReader {
        endings: &["bvh"],
        kind: "bvh",
        holds: MOVEMENT_NOUN,
        looks: always,
        keeps_inventories: true,
        contents: FileContentUse::Movement(import_bvh::import_bvh),
    },
    FileReader {
        endings: &["glb", "gltf", "vrm", "vrma"],
        kind: "gltf",
        holds: MOVEMENT_NOUN,
        looks: always,
        keeps_inventories: true,
        contents: FileContentUse::Movement(import_captured::import_gltf),
    },
    FileReader {
        endings: if cfg!(feature = "fbx") { &["fbx"] } else { &[] },
        kind: "fbx",
        holds: MOVEMENT_NOUN,
        looks: always,
        keeps_inventories: true,
        contents: FileContentUse::Movement(import_captured::import_fbx),
    },
    FileReader {
        endings: &["c3d"],
        kind: "c3d",
        holds: MARKERS_NOUN,
        looks: always,
        keeps_inventories: true,
        contents: FileContentUse::Tracks(|bytes| c3d::read_c3d(bytes).map_err(parse_error_message)),
    },
    FileReader {
        endings: &["trc"],
        kind: "trc",
        holds: MARKERS_NOUN,
        looks: always,
        keeps_inventories: true,
        contents: FileContentUse::Tracks(|bytes| trc::read_trc_file(bytes).map_err(parse_error_message)),
    },
    FileReader {
        endings: &["pose"],
        kind: "pose",
        holds: "points from film",
        looks: always,
        keeps_inventories: true,
        contents: FileContentUse::Tracks(|bytes| pose::read_pose_file(bytes).map_err(parse_error_message)),
    },
    FileReader {
        endings: &["fap", "pbtxt", "gesichter"],
        kind: "curves",
        holds: "faces",
        looks: always,
        keeps_inventories: true,
        contents: FileContentUse::Other(import_captured::import_curves),
    },
    FileReader {
        endings: &["csv", "tsv"],
        kind: "lexicon",
        holds: "lexicons, markers, faces, tables of annotations",
        looks: |path| !import_changes::is_change_table(path),
        keeps_inventories: false,
        contents: FileContentUse::Other(import_captured::import_table),
    },
    FileReader {
        endings: &["sigml", "hsigml", "xml"],
        kind: "sigml",
        holds: "signs in SiGML",
        looks: |path| NotationFormat::from_notation_path(path) == Some(NotationFormat::Sigml),
        keeps_inventories: true,
        contents: FileContentUse::Other(import_notated::import_sigml),
    },
    FileReader {
        endings: &["hns", "txt"],
        kind: "lexicon",
        holds: "lines of HamNoSys, markers, tables of annotations",
        looks: |path| {
            NotationFormat::from_notation_path(path) == Some(NotationFormat::Lines) || import_captured::is_export(path)
        },
        keeps_inventories: false,
        contents: FileContentUse::Other(import_captured::import_text),
    },
    FileReader {
        endings: &["textgrid"],
        kind: "textgrid",
        holds: ANNOTATIONS_NOUN,
        looks: always,
        keeps_inventories: false,
        contents: FileContentUse::Annotations(|bytes| textgrid::read_textgrid_file(bytes).map_err(parse_error_message)),
    },
    FileReader {
        endings: &["srt", "vtt"],
        kind: "subtitles",
        holds: ANNOTATIONS_NOUN,
        looks: always,
        keeps_inventories: false,
        contents: FileContentUse::Annotations(|bytes| subtitles::read_subtitles(bytes).map_err(parse_error_message)),
    },
    FileReader {
        endings: &["anvil"],
        kind: "anvil",
        holds: ANNOTATIONS_NOUN,
        looks: always,
        keeps_inventories: false,
        contents: FileContentUse::Annotations(|bytes| anvil::read_anvil(bytes).map_err(parse_error_message)),
    },
    FileReader {
        endings: &["exb"],
        kind: "exmaralda",
        holds: ANNOTATIONS_NOUN,
        looks: always,
        keeps_inventories: false,
        contents: FileContentUse::Annotations(|bytes| exmaralda::read_exmaralda(bytes).map_err(parse_error_message)),
    },
    FileReader {
        endings: &["xra"],
        kind: "xra",
        holds: ANNOTATIONS_NOUN,
        looks: always,
        keeps_inventories: false,
        contents: FileContentUse::Annotations(|bytes| xra::read_xra(bytes).map_err(parse_error_message)),
    },
    FileReader {
        endings: &["xml"],
        kind: "signstream",
        holds: "collections of SignStream",
        looks: |path| begins_with_text(path, "<SIGNSTREAM-DATABASE"),
        keeps_inventories: false,
        contents: FileContentUse::Annotations(|bytes| {
            signstream::read_signstream_file(bytes).map_err(parse_error_message)
        }),
    },
    FileReader {
        endings: &["ecv"],
        kind: "ecv",
        holds: "vocabularies of ELAN",
        looks: always,
        keeps_inventories: false,
        contents: FileContentUse::Other(elan::import_vocabularies),
    },
    FileReader {
        endings: &["eaf"],
        kind: "eaf",
        holds: ANNOTATIONS_NOUN,
        looks: always,
        keeps_inventories: false,
        contents: FileContentUse::Annotations(eaf_transcript),
    },
    FileReader {
        endings: &["pfsx", "psfx"],
        kind: "pfsx",
        holds: "settings of ELAN",
        looks: always,
        keeps_inventories: true,
        contents: FileContentUse::Other(elan::import_settings),
    },
    FileReader {
        endings: &["mp4", "m4v", "mov", "avi", "mpg", "mpeg", "webm", "mkv"],
        kind: import_film::FILM_KIND,
        holds: "films",
        looks: always,
        keeps_inventories: true,
        contents: FileContentUse::Other(import_film::import_film),
    },
    FileReader {
        endings: &["csv", "tsv", "txt"],
        kind: import_changes::CHANGE_TABLE_KIND,
        holds: "tables of annotations of several recordings",
        looks: import_changes::is_change_table,
        keeps_inventories: true,
        contents: FileContentUse::Other(import_changes::import_change_table),
    },
    FileReader {
        endings: &["etf"],
        kind: "etf",
        holds: "templates of ELAN",
        looks: always,
        keeps_inventories: false,
        contents: FileContentUse::Template(eaf_transcript, elan::import_template),
    },
];

fn always(_: &Path) -> bool {
    true
}

/// Returns the message of an error.
fn parse_error_message(error: impl Display) -> String {
    error.to_string()
}

fn eaf_transcript(bytes: &[u8]) -> std::result::Result<(AnnotationTranscript, Vec<ImportFinding>), String> {
    elan_file::read_eaf(bytes).map_err(parse_error_message)
}

/// Returns the index in [`FILE_READERS`] of a file's kind, if files of that kind are read.
pub(super) fn find_reader_index(path: &Path) -> Option<usize> {
    let ending = lower_file_ending(path)?;
    FILE_READERS
        .iter()
        // Some endings belong to several kinds, which only the content distinguishes.
        .position(|reader| reader.endings.contains(&ending.as_str()) && (reader.looks)(path))
}

/// Returns the ending of a file's name in lower case, without the dot.
pub(super) fn lower_file_ending(path: &Path) -> Option<String> {
    Some(path.extension()?.to_string_lossy().to_lowercase())
}

/// Returns the reason to leave out a file of a folder that `chereme export all` wrote, if the database in that folder
/// holds the same as the file: its tables, and the list of sources.
pub(super) fn exported_copy_error(path: &Path) -> Option<CorpusError> {
    let folder = path.parent()?;
    let exported = match folder.file_name() {
        Some(name) if name == "tables" => folder.parent()?,
        _ if path.file_name()? == "provenance.json" => folder,
        _ => return None,
    };
    let marks = ["corpus.chereme", "provenance.json", "SHA256SUMS"];
    if !marks.iter().all(|mark| exported.join(mark).is_file()) {
        return None;
    }
    let why = "it is a copy of a part of corpus.chereme, in the folder of an export";
    Some(
        CorpusError::from_wrong_message(why)
            .with_error_place(path.display().to_string())
            .with_command_advice(
                "open the corpus.chereme of that folder, or merge it into yours: `chereme merge CORPUS OTHER`",
            ),
    )
}

/// Returns the function that reads annotations from files of this name, if its ending is that of annotation files.
pub(crate) fn find_transcript_parser(path: &Path) -> Option<ParseFunction<AnnotationTranscript>> {
    FILE_READERS[find_reader_index(path)?].reader_transcript_parser()
}

/// Returns the function that reads annotations from files of a kind in `source_file.kind`, if they hold annotations.
pub(crate) fn annotations_of(kind: &str) -> Option<ParseFunction<AnnotationTranscript>> {
    let reader = FILE_READERS.iter().find(|reader| reader.kind == kind)?;
    match reader.contents {
        FileContentUse::Annotations(parse) => Some(parse),
        _ => None,
    }
}

/// Returns whether files of a kind in `source_file.kind` hold the movement of a body.
pub(super) fn is_movement(kind: &str) -> bool {
    FILE_READERS
        .iter()
        .any(|reader| reader.kind == kind && reader.is_movement())
}

/// Lists the endings of annotation files.
pub(crate) fn annotation_endings() -> String {
    let readers = FILE_READERS
        .iter()
        .filter(|reader| reader.reader_transcript_parser().is_some());
    let dotted = readers
        .flat_map(|reader| reader.endings)
        .map(|ending| format!(".{ending}"));
    dotted.collect::<Vec<_>>().join(", ")
}

/// Returns the kinds of files that an import reads as a sentence, with their endings and contents.
#[must_use]
pub fn readable_files(language: InterfaceLanguage) -> String {
    filled_message(
        "Files that are read: {endings}, or folders of these.",
        &[&list_readable_endings(language)],
        language,
    )
}

/// Lists the endings that are read, and the contents of such files.
pub(crate) fn list_readable_endings(language: InterfaceLanguage) -> String {
    let mut kinds: Vec<(&str, Vec<String>)> = Vec::new();
    for reader in FILE_READERS.iter().filter(|reader| !reader.endings.is_empty()) {
        let dotted = reader.endings.iter().map(|ending| format!(".{ending}"));
        match kinds.iter_mut().find(|(holds, _)| *holds == reader.holds) {
            Some((_, all)) => all.extend(dotted),
            None => kinds.push((reader.holds, dotted.collect())),
        }
    }
    let kinds: Vec<String> = kinds
        .into_iter()
        .map(|(holds, all)| format!("{} ({})", all.join(", "), filled_message(holds, &[], language)))
        .collect();
    kinds.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::db::stored_recordings::CAPTURE_FILE_KINDS;
    use crate::words::localized_message;

    const CHANGE_TABLE: &str = import_changes::CHANGE_TABLE_KIND;

    #[test]
    fn every_extension_has_one_kind_and_annotations_are_read_after_movement() {
        let mut all: Vec<&str> = FILE_READERS.iter().flat_map(|it| it.endings).copied().collect();
        // The root element of an .xml determines its kind, and the titles of a table.
        for shared in ["xml", "csv", "tsv", "txt"] {
            let first = all.iter().position(|ending| *ending == shared);
            all.remove(first.expect("an ending"));
        }
        let many = all.len();
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), many);
        let place = |kind: &str| FILE_READERS.iter().position(|it| it.kind == kind);
        let order = ["bvh", "pose", "ecv", "eaf", "pfsx", "film", CHANGE_TABLE, "etf"].map(place);
        assert!(order.is_sorted() && order[0].is_some(), "{order:?}");
        assert_eq!(find_reader_index(Path::new("A/TAKE.EAF")), place("eaf"));
        assert_eq!(find_reader_index(Path::new("a.docx")), None);
    }

    #[test]
    fn annotation_files_are_known_by_their_endings() {
        for (name, holds) in [
            ("a.eaf", true),
            ("a.etf", true),
            ("a.TextGrid", true),
            ("a.vtt", true),
            ("a.anvil", true),
            ("A.EXB", true),
            ("a.xra", true),
            ("a.bvh", false),
            ("a.docx", false),
        ] {
            assert_eq!(find_transcript_parser(Path::new(name)).is_some(), holds, "{name}");
        }
        let all = annotation_endings();
        assert!(all.contains(".srt, .vtt") && all.ends_with(".eaf, .etf"), "{all}");
        assert!(!all.contains(".bvh"), "{all}");
        assert!(is_movement("fbx") && !is_movement("film"));
        for reader in FILE_READERS {
            let holds_capture = matches!(reader.contents, FileContentUse::Movement(_) | FileContentUse::Tracks(_));
            let is_listed = CAPTURE_FILE_KINDS.contains(&reader.kind);
            let other_kinds = ["curves", import_film::FILM_KIND];
            assert_eq!(
                is_listed,
                holds_capture || other_kinds.contains(&reader.kind),
                "{}",
                reader.kind
            );
        }
        assert!(CAPTURE_FILE_KINDS.contains(&import_captured::POINT_TABLE_KIND));
    }

    #[test]
    fn unreadable_files_are_named_with_a_remedy() {
        for (name, said) in [
            ("a.cha", "CHAT"),
            ("a.Collection", "Praat"),
            ("a.wav", "sound"),
            ("a.docx", "not known"),
            ("noending", "not known"),
        ] {
            let error = unread_format_error(Path::new(name));
            assert!(error.to_string().contains(said), "{error}");
            assert!(error.error_remedy().is_some(), "{name}");
        }
        let all = list_readable_endings(InterfaceLanguage::English);
        assert!(all.contains(".csv, .tsv (lexicons"), "{all}");
        let french = list_readable_endings(InterfaceLanguage::French);
        assert!(french.contains(".csv, .tsv (lexiques"), "{french}");
        let remedy = format!("files that are read end in {all}");
        assert_eq!(
            localized_message(&remedy, InterfaceLanguage::French),
            Some(format!("les fichiers qui sont lus finissent par {french}"))
        );
    }
}
