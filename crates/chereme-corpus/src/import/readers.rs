//! The kinds of files that an import recognises: those that it reads, and those that it can only name.
//!
//! To add a format, write a module with a reading function and add a line to [`READERS`].

use std::borrow::Cow;
use std::path::Path;

use chereme_sign::Remedy;

use super::{FileReport, Job, bvh, captured, eaf, elan, film, notated};
use crate::error::{Error, Result};
use crate::notation::Form;
use crate::progress::Progress;

/// A kind of file that can be imported.
pub(super) struct Reader {
    /// The file name endings of such files, in lower case, without the dot.
    pub(super) endings: &'static [&'static str],
    /// The kind in `source_file.kind`.
    pub(super) kind: &'static str,
    /// The contents of such files, in the plural.
    pub(super) holds: &'static str,
    /// Decides whether a file with one of these endings is of this kind, if the ending alone does not determine it.
    looks: fn(&Path) -> bool,
    /// Whether such files never add an inventory, so that the next one need not load them again.
    pub(super) keeps_inventories: bool,
    /// Reads a file into the corpus.
    pub(super) read: fn(&mut Job<'_>, &mut Progress<'_>) -> Result<FileReport>,
}

/// The kinds in the order in which an import reads them. Annotations come after movement, so that they find their
/// recordings and values; films come after annotations, because annotation files name them; templates come last, for
/// the recordings that still have no tiers.
pub(super) static READERS: &[Reader] = &[
    Reader {
        endings: &["json"],
        kind: "inventory",
        holds: "inventories, signs, scores of a face or points from film",
        looks: always,
        keeps_inventories: false,
        read: captured::import_json,
    },
    Reader {
        endings: &["bvh"],
        kind: "bvh",
        holds: "movement",
        looks: always,
        keeps_inventories: true,
        read: bvh::import,
    },
    Reader {
        endings: &["glb", "gltf", "vrm", "vrma"],
        kind: "gltf",
        holds: "movement",
        looks: always,
        keeps_inventories: true,
        read: captured::import_gltf,
    },
    #[cfg(feature = "fbx")]
    Reader {
        endings: &["fbx"],
        kind: "fbx",
        holds: "movement",
        looks: always,
        keeps_inventories: true,
        read: captured::import_fbx,
    },
    Reader {
        endings: &["c3d"],
        kind: "c3d",
        holds: "markers",
        looks: always,
        keeps_inventories: true,
        read: captured::import_c3d,
    },
    Reader {
        endings: &["trc"],
        kind: "trc",
        holds: "markers",
        looks: always,
        keeps_inventories: true,
        read: captured::import_trc,
    },
    Reader {
        endings: &["pose"],
        kind: "pose",
        holds: "points from film",
        looks: always,
        keeps_inventories: true,
        read: captured::import_pose,
    },
    Reader {
        endings: &["fap", "pbtxt", "gesichter"],
        kind: "curves",
        holds: "faces",
        looks: always,
        keeps_inventories: true,
        read: captured::import_curves,
    },
    Reader {
        endings: &["csv", "tsv"],
        kind: "lexicon",
        holds: "lexicons, annotations that ELAN exported",
        looks: always,
        keeps_inventories: false,
        read: captured::import_table,
    },
    Reader {
        endings: &["sigml", "hsigml", "xml"],
        kind: "sigml",
        holds: "notation",
        looks: |path| Form::of(path) == Some(Form::Sigml),
        keeps_inventories: true,
        read: notated::import_sigml,
    },
    Reader {
        endings: &["hns", "txt"],
        kind: "lexicon",
        holds: "notation",
        looks: |path| Form::of(path) == Some(Form::Lines) || captured::is_export(path),
        keeps_inventories: false,
        read: captured::import_text,
    },
    Reader {
        endings: &["textgrid"],
        kind: "textgrid",
        holds: "annotations",
        looks: always,
        keeps_inventories: false,
        read: captured::import_text_grid,
    },
    Reader {
        endings: &["srt", "vtt"],
        kind: "subtitles",
        holds: "annotations",
        looks: always,
        keeps_inventories: false,
        read: captured::import_subtitles,
    },
    Reader {
        endings: &["ecv"],
        kind: "ecv",
        holds: "vocabularies of ELAN",
        looks: always,
        keeps_inventories: false,
        read: elan::import_vocabularies,
    },
    Reader {
        endings: &["eaf"],
        kind: "eaf",
        holds: "annotations",
        looks: always,
        keeps_inventories: false,
        read: eaf::import,
    },
    Reader {
        endings: &["pfsx", "psfx"],
        kind: "pfsx",
        holds: "settings of ELAN",
        looks: always,
        keeps_inventories: true,
        read: elan::import_settings,
    },
    Reader {
        endings: &["mp4", "m4v", "mov", "avi", "mpg", "mpeg", "webm", "mkv"],
        kind: film::KIND,
        holds: "films",
        looks: always,
        keeps_inventories: true,
        read: film::import,
    },
    Reader {
        endings: &["etf"],
        kind: "etf",
        holds: "templates of ELAN",
        looks: always,
        keeps_inventories: false,
        read: elan::import_template,
    },
];

fn always(_: &Path) -> bool {
    true
}

/// A kind of file that often accompanies readable files but is not read.
struct Unread {
    endings: &'static [&'static str],
    /// A noun for such files.
    what: &'static str,
    /// A step that makes its contents readable.
    remedy: Remedy,
}

const MEDIA: Remedy = Remedy::Advice(Cow::Borrowed(
    "import the .eaf that names it; its recording is linked to it then",
));

static UNREAD: &[Unread] = &[
    Unread {
        endings: &["txt"],
        what: "text without HamNoSys",
        remedy: Remedy::Advice(Cow::Borrowed(
            "a .txt holds HamNoSys, a sign a line: the gloss, a tab, and symbols or their names",
        )),
    },
    Unread {
        endings: &["xml"],
        what: "XML without SiGML",
        remedy: Remedy::Advice(Cow::Borrowed("an .xml holds SiGML: its root is <sigml>")),
    },
    #[cfg(not(feature = "fbx"))]
    Unread {
        endings: &["fbx"],
        what: "movement in a form that this build of the program does not read",
        remedy: Remedy::Advice(Cow::Borrowed("open it in Blender and export .glb or .bvh")),
    },
    Unread {
        endings: &["wav", "mp3"],
        what: "sound",
        remedy: MEDIA,
    },
    Unread {
        endings: &["png", "jpg", "jpeg", "gif"],
        what: "pictures",
        remedy: MEDIA,
    },
    Unread {
        endings: &["chereme"],
        what: "a corpus",
        remedy: Remedy::Command(Cow::Borrowed(
            "merge it into yours: `chereme merge CORPUS OTHER`; or export its files, and import those",
        )),
    },
];

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

/// Returns the error for a file of a kind that is not read, with a way to make its contents readable.
pub(super) fn unread(path: &Path) -> Error {
    let ending = ending(path).unwrap_or_default();
    let known = UNREAD
        .iter()
        .find(|it| it.endings.contains(&ending.as_str()));
    let (message, remedy) = match known {
        Some(known) => (format!("it holds {}", known.what), known.remedy.clone()),
        None => (
            "this kind of file is not known".to_owned(),
            endings().into(),
        ),
    };
    Error::wrong(message)
        .at(path.display().to_string())
        .advise(remedy)
}

/// Lists the endings that are read, and the content of such files.
fn endings() -> String {
    let mut kinds: Vec<(&str, Vec<String>)> = Vec::new();
    for reader in READERS {
        let dotted = reader.endings.iter().map(|it| format!(".{it}"));
        match kinds.iter_mut().find(|(holds, _)| *holds == reader.holds) {
            Some((_, all)) => all.extend(dotted),
            None => kinds.push((reader.holds, dotted.collect())),
        }
    }
    let kinds: Vec<String> = kinds
        .into_iter()
        .map(|(holds, all)| format!("{} ({holds})", all.join(", ")))
        .collect();
    format!("files that are read end in {}", kinds.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_extension_has_one_kind_and_annotations_are_read_after_movement() {
        let mut all: Vec<&str> = READERS.iter().flat_map(|it| it.endings).copied().collect();
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
    fn unreadable_files_are_named_with_a_remedy() {
        for (name, said) in [
            ("a.wav", "sound"),
            ("a.docx", "not known"),
            ("noending", "not known"),
        ] {
            let error = unread(Path::new(name));
            assert!(error.to_string().contains(said), "{error}");
            assert!(error.remedy().is_some(), "{name}");
        }
        assert!(endings().contains(".csv, .tsv (lexicons"), "{}", endings());
    }
}
