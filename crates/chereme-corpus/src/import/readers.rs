//! The kinds of files that an import reads. Those that it can only name are in `unread.rs`.
//!
//! To add a format, write a reading function in `chereme-formats` and add an entry to [`READERS`].

use std::fmt::Display;
use std::path::Path;

use chereme_formats::eaf::Transcript;
use chereme_formats::tracks::Tracks;
use chereme_formats::{
    Finding, anvil, c3d, eaf as elan_file, exmaralda, pose, signstream, subtitles, textgrid, trc,
};
use chereme_sign::Remedy;

use super::unread::begins;
pub(super) use super::unread::unread;
use super::{FileReport, Job, bvh, captured, eaf, elan, film, notated};
use crate::error::{Error, Result};
use crate::notation::Form;
use crate::progress::Progress;
use crate::words::{Language, Text, fill};

/// Reads bytes of a foreign file as a document with findings, or says what is wrong with them.
pub(crate) type Parse<T> = fn(&[u8]) -> std::result::Result<(T, Vec<Finding>), String>;

/// Reads a file into the corpus.
type Import = fn(&mut Job<'_>, &mut Progress<'_>) -> Result<FileReport>;

/// A kind of file that can be imported.
pub(super) struct Reader {
    /// The file name endings of such files, in lower case, without the dot.
    pub(super) endings: &'static [&'static str],
    /// The kind in `source_file.kind`.
    pub(super) kind: &'static str,
    /// The contents of such files for people, in the plural.
    pub(super) holds: Text,
    /// Decides whether a file with one of these endings is of this kind, if the ending alone does not determine it.
    looks: fn(&Path) -> bool,
    /// Whether such files never add an inventory, so that the next one need not load them again.
    pub(super) keeps_inventories: bool,
    /// The use of the contents.
    contents: Contents,
}

/// The use of a file's contents.
enum Contents {
    /// Annotations, which become tiers of a recording and update it if the file was edited since.
    Annotations(Parse<Transcript>),
    /// A template: tiers without annotations, which have an import of their own.
    Template(Parse<Transcript>, Import),
    /// Tracks, such as markers or curves.
    Tracks(Parse<Tracks>),
    /// The movement of a body, around which the other files of a folder gather.
    Movement(Import),
    /// Contents with an import of their own.
    Other(Import),
}

impl Reader {
    /// Reads a file into the corpus.
    pub(super) fn import(
        &self,
        job: &mut Job<'_>,
        progress: &mut Progress<'_>,
    ) -> Result<FileReport> {
        match self.contents {
            Contents::Annotations(parse) => eaf::import_as(job, progress, parse),
            Contents::Tracks(parse) => captured::import_tracks(job, progress, parse),
            Contents::Template(_, import)
            | Contents::Movement(import)
            | Contents::Other(import) => import(job, progress),
        }
    }

    /// Returns whether such files are read piece by piece, so that they may be of any size.
    pub(super) fn is_streamed(&self) -> bool {
        ["bvh", film::KIND].contains(&self.kind)
    }

    /// Returns whether such files hold the movement of a body.
    pub(super) fn is_movement(&self) -> bool {
        matches!(self.contents, Contents::Movement(_))
    }

    /// Returns the function that reads annotations or tiers from the bytes of such a file, if they hold some.
    fn transcript(&self) -> Option<Parse<Transcript>> {
        match self.contents {
            Contents::Annotations(parse) | Contents::Template(parse, _) => Some(parse),
            _ => None,
        }
    }
}

const ANNOTATIONS: Text = Text::new("annotations", "annotations");
const MARKERS: Text = Text::new("markers", "marqueurs");
const MOVEMENT: Text = Text::new("movement", "mouvement");

/// The kinds in the order in which an import reads them. Annotations come after movement, so that they find their
/// recordings and values; films come after annotations, because annotation files name them; templates come last, for
/// the recordings that still have no tiers.
pub(super) static READERS: &[Reader] = &[
    Reader {
        endings: &["json"],
        kind: "inventory",
        holds: Text::new(
            "inventories, signs, scores of a face, points from film of OpenPose or MediaPipe",
            "inventaires, signes, scores d’un visage, points d’un film d’OpenPose ou de MediaPipe",
        ),
        looks: always,
        keeps_inventories: false,
        contents: Contents::Other(captured::import_json),
    },
    Reader {
        endings: &["bvh"],
        kind: "bvh",
        holds: MOVEMENT,
        looks: always,
        keeps_inventories: true,
        contents: Contents::Movement(bvh::import),
    },
    Reader {
        endings: &["glb", "gltf", "vrm", "vrma"],
        kind: "gltf",
        holds: MOVEMENT,
        looks: always,
        keeps_inventories: true,
        contents: Contents::Movement(captured::import_gltf),
    },
    Reader {
        endings: if cfg!(feature = "fbx") { &["fbx"] } else { &[] },
        kind: "fbx",
        holds: MOVEMENT,
        looks: always,
        keeps_inventories: true,
        contents: Contents::Movement(captured::import_fbx),
    },
    Reader {
        endings: &["c3d"],
        kind: "c3d",
        holds: MARKERS,
        looks: always,
        keeps_inventories: true,
        contents: Contents::Tracks(|bytes| c3d::read(bytes).map_err(said)),
    },
    Reader {
        endings: &["trc"],
        kind: "trc",
        holds: MARKERS,
        looks: always,
        keeps_inventories: true,
        contents: Contents::Tracks(|bytes| trc::read(bytes).map_err(said)),
    },
    Reader {
        endings: &["pose"],
        kind: "pose",
        holds: Text::new("points from film", "points d’un film"),
        looks: always,
        keeps_inventories: true,
        contents: Contents::Tracks(|bytes| pose::read(bytes).map_err(said)),
    },
    Reader {
        endings: &["fap", "pbtxt", "gesichter"],
        kind: "curves",
        holds: Text::new("faces", "visages"),
        looks: always,
        keeps_inventories: true,
        contents: Contents::Other(captured::import_curves),
    },
    Reader {
        endings: &["csv", "tsv"],
        kind: "lexicon",
        holds: Text::new(
            "lexicons, markers, faces, tables of annotations",
            "lexiques, marqueurs, visages, tables d’annotations",
        ),
        looks: always,
        keeps_inventories: false,
        contents: Contents::Other(captured::import_table),
    },
    Reader {
        endings: &["sigml", "hsigml", "xml"],
        kind: "sigml",
        holds: Text::new("signs in SiGML", "signes en SiGML"),
        looks: |path| Form::of(path) == Some(Form::Sigml),
        keeps_inventories: true,
        contents: Contents::Other(notated::import_sigml),
    },
    Reader {
        endings: &["hns", "txt"],
        kind: "lexicon",
        holds: Text::new(
            "lines of HamNoSys, markers, tables of annotations",
            "lignes de HamNoSys, marqueurs, tables d’annotations",
        ),
        looks: |path| Form::of(path) == Some(Form::Lines) || captured::is_export(path),
        keeps_inventories: false,
        contents: Contents::Other(captured::import_text),
    },
    Reader {
        endings: &["textgrid"],
        kind: "textgrid",
        holds: ANNOTATIONS,
        looks: always,
        keeps_inventories: false,
        contents: Contents::Annotations(|bytes| textgrid::read(bytes).map_err(said)),
    },
    Reader {
        endings: &["srt", "vtt"],
        kind: "subtitles",
        holds: ANNOTATIONS,
        looks: always,
        keeps_inventories: false,
        contents: Contents::Annotations(|bytes| subtitles::read(bytes).map_err(said)),
    },
    Reader {
        endings: &["anvil"],
        kind: "anvil",
        holds: ANNOTATIONS,
        looks: always,
        keeps_inventories: false,
        contents: Contents::Annotations(|bytes| anvil::read(bytes).map_err(said)),
    },
    Reader {
        endings: &["exb"],
        kind: "exmaralda",
        holds: ANNOTATIONS,
        looks: always,
        keeps_inventories: false,
        contents: Contents::Annotations(|bytes| exmaralda::read(bytes).map_err(said)),
    },
    Reader {
        endings: &["xml"],
        kind: "signstream",
        holds: Text::new("collections of SignStream", "collections de SignStream"),
        looks: |path| begins(path, "<SIGNSTREAM-DATABASE"),
        keeps_inventories: false,
        contents: Contents::Annotations(|bytes| signstream::read(bytes).map_err(said)),
    },
    Reader {
        endings: &["ecv"],
        kind: "ecv",
        holds: Text::new("vocabularies of ELAN", "vocabulaires d’ELAN"),
        looks: always,
        keeps_inventories: false,
        contents: Contents::Other(elan::import_vocabularies),
    },
    Reader {
        endings: &["eaf"],
        kind: "eaf",
        holds: ANNOTATIONS,
        looks: always,
        keeps_inventories: false,
        contents: Contents::Annotations(eaf_transcript),
    },
    Reader {
        endings: &["pfsx", "psfx"],
        kind: "pfsx",
        holds: Text::new("settings of ELAN", "réglages d’ELAN"),
        looks: always,
        keeps_inventories: true,
        contents: Contents::Other(elan::import_settings),
    },
    Reader {
        endings: &["mp4", "m4v", "mov", "avi", "mpg", "mpeg", "webm", "mkv"],
        kind: film::KIND,
        holds: Text::new("films", "films"),
        looks: always,
        keeps_inventories: true,
        contents: Contents::Other(film::import),
    },
    Reader {
        endings: &["etf"],
        kind: "etf",
        holds: Text::new("templates of ELAN", "modèles d’ELAN"),
        looks: always,
        keeps_inventories: false,
        contents: Contents::Template(eaf_transcript, elan::import_template),
    },
];

fn always(_: &Path) -> bool {
    true
}

/// Returns the message of an error.
fn said(error: impl Display) -> String {
    error.to_string()
}

fn eaf_transcript(bytes: &[u8]) -> std::result::Result<(Transcript, Vec<Finding>), String> {
    elan_file::read(bytes).map_err(said)
}

/// Returns the index in [`READERS`] of a file's kind, if files of that kind are read.
pub(super) fn reader(path: &Path) -> Option<usize> {
    let ending = ending(path)?;
    READERS
        .iter()
        .position(|it| it.endings.contains(&ending.as_str()) && (it.looks)(path))
}

/// Returns the ending of a file's name in lower case, without the dot.
pub(super) fn ending(path: &Path) -> Option<String> {
    Some(path.extension()?.to_string_lossy().to_lowercase())
}

/// Returns the reason to leave out a file of a folder that `chereme export all` wrote, if the database in that folder
/// holds the same as the file: its tables, and the list of sources.
pub(super) fn copied(path: &Path) -> Option<Error> {
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
        Error::wrong(why)
            .at(path.display().to_string())
            .advise(Remedy::command(
                "open the corpus.chereme of that folder, or merge it into yours: `chereme merge CORPUS OTHER`",
            )),
    )
}

/// Returns the function that reads annotations from files of this name, if its ending is that of annotation files.
pub(crate) fn transcript(path: &Path) -> Option<Parse<Transcript>> {
    READERS[reader(path)?].transcript()
}

/// Returns the function that reads annotations from files of a kind in `source_file.kind`, if they hold annotations.
pub(crate) fn annotations_of(kind: &str) -> Option<Parse<Transcript>> {
    let reader = READERS.iter().find(|it| it.kind == kind)?;
    match reader.contents {
        Contents::Annotations(parse) => Some(parse),
        _ => None,
    }
}

/// Returns whether files of a kind in `source_file.kind` hold the movement of a body.
pub(super) fn is_movement(kind: &str) -> bool {
    READERS.iter().any(|it| it.kind == kind && it.is_movement())
}

/// Lists the endings of annotation files.
pub(crate) fn annotation_endings() -> String {
    let readers = READERS.iter().filter(|it| it.transcript().is_some());
    let dotted = readers.flat_map(|it| it.endings).map(|it| format!(".{it}"));
    dotted.collect::<Vec<_>>().join(", ")
}

/// Returns the kinds of files that an import reads as a sentence, with their endings and contents.
#[must_use]
pub fn readable_files(language: Language) -> String {
    let sentence = Text::new(
        "Files that are read: {endings}, or folders of these.",
        "Fichiers lus : {endings}, ou des dossiers qui en contiennent.",
    );
    fill(sentence.of(language), &[("endings", &endings(language))])
}

/// Lists the endings that are read, and the contents of such files.
pub(crate) fn endings(language: Language) -> String {
    let mut kinds: Vec<(Text, Vec<String>)> = Vec::new();
    for reader in READERS.iter().filter(|it| !it.endings.is_empty()) {
        let dotted = reader.endings.iter().map(|it| format!(".{it}"));
        match kinds.iter_mut().find(|(holds, _)| *holds == reader.holds) {
            Some((_, all)) => all.extend(dotted),
            None => kinds.push((reader.holds, dotted.collect())),
        }
    }
    let kinds: Vec<String> = kinds
        .into_iter()
        .map(|(holds, all)| format!("{} ({})", all.join(", "), holds.of(language)))
        .collect();
    kinds.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::words::message;

    #[test]
    fn every_extension_has_one_kind_and_annotations_are_read_after_movement() {
        let mut all: Vec<&str> = READERS.iter().flat_map(|it| it.endings).copied().collect();
        // The root element of an .xml determines its kind.
        let first = all.iter().position(|ending| *ending == "xml");
        all.remove(first.expect("an ending"));
        let many = all.len();
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), many);
        let place = |kind: &str| READERS.iter().position(|it| it.kind == kind);
        let order = ["bvh", "pose", "ecv", "eaf", "pfsx", "film", "etf"].map(place);
        assert!(order.is_sorted() && order[0].is_some(), "{order:?}");
        assert_eq!(reader(Path::new("A/TAKE.EAF")), place("eaf"));
        assert_eq!(reader(Path::new("a.docx")), None);
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
            ("a.bvh", false),
            ("a.docx", false),
        ] {
            assert_eq!(transcript(Path::new(name)).is_some(), holds, "{name}");
        }
        let all = annotation_endings();
        assert!(
            all.contains(".srt, .vtt") && all.ends_with(".eaf, .etf"),
            "{all}"
        );
        assert!(!all.contains(".bvh"), "{all}");
        assert!(is_movement("fbx") && !is_movement("film"));
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
            let error = unread(Path::new(name));
            assert!(error.to_string().contains(said), "{error}");
            assert!(error.remedy().is_some(), "{name}");
        }
        let all = endings(Language::English);
        assert!(all.contains(".csv, .tsv (lexicons"), "{all}");
        let french = endings(Language::French);
        assert!(french.contains(".csv, .tsv (lexiques"), "{french}");
        let remedy = format!("files that are read end in {all}");
        assert_eq!(
            message(&remedy, Language::French),
            Some(format!("les fichiers qui sont lus finissent par {french}"))
        );
    }
}
