//! Unfinished text: written beside the settings while it is typed, read again when the corpus is opened again.
//!
//! A draft belongs to the user of this machine and not to the corpus, whose file may be copied and mailed.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::AnnotationDraft;
use crate::settings::{StudioFolders, write_whole};

/// The draft file of one corpus.
#[derive(Debug, Clone, Default)]
pub(crate) struct DraftFile {
    file: Option<PathBuf>,
    corpus: PathBuf,
    /// The draft that was read last, or was last given to be written.
    written: Option<AnnotationDraft>,
}

/// The content of a draft file. It names its corpus, because two paths may have the same hash.
#[derive(Serialize, Deserialize)]
struct DraftFileContent {
    corpus: PathBuf,
    draft: AnnotationDraft,
}

impl DraftFile {
    /// Returns the draft file of the corpus at `path`, which must be absolute; reads no file yet.
    pub(crate) fn for_corpus_path(folders: &StudioFolders, path: &Path) -> Self {
        let name = format!("{:016x}.json", hash(&path.to_string_lossy()));
        let folder = folders.config.as_ref().map(|config| config.join("drafts"));
        Self {
            file: folder.map(|folder| folder.join(name)),
            corpus: path.to_owned(),
            written: None,
        }
    }

    /// Reads the draft; `None` if there is no readable file, or if it belongs to another corpus.
    pub(crate) fn read_draft(&mut self) -> Option<AnnotationDraft> {
        let text = fs::read_to_string(self.file.as_ref()?).ok()?;
        let kept: DraftFileContent = serde_json::from_str(&text).ok()?;
        // Two paths may have the same hash.
        if kept.corpus != self.corpus {
            return None;
        }
        self.written = Some(kept.draft.clone());
        Some(kept.draft)
    }

    /// Writes the draft if it changed; removes the file if there is no draft. After an error the same draft is not tried
    /// again, because the window calls this in every frame.
    pub(crate) fn keep_draft(&mut self, draft: Option<AnnotationDraft>) -> io::Result<()> {
        let Some(file) = self.file.as_ref().filter(|_| draft != self.written) else {
            return Ok(());
        };
        // Remembered even if writing fails: the window would try again in every frame.
        self.written.clone_from(&draft);
        match draft {
            Some(draft) => {
                let corpus = self.corpus.clone();
                write_whole(file, &DraftFileContent { corpus, draft })
            }
            None => match fs::remove_file(file) {
                Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
                _ => Ok(()),
            },
        }
    }
}

/// Returns the FNV-1a hash of a text, the same on every machine.
fn hash(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::panes::timeline::BegunAnnotation;

    fn draft(start: i64) -> AnnotationDraft {
        AnnotationDraft {
            editing: None,
            begun: Some(BegunAnnotation {
                recording: 1,
                tier: 2,
                start,
                value: "é".into(),
            }),
        }
    }

    #[test]
    fn each_corpus_has_its_own_draft_which_is_deleted_when_nothing_is_unfinished() {
        let folder = tempfile::tempdir().expect("a folder");
        let folders = StudioFolders {
            config: Some(folder.path().to_owned()),
            data: None,
        };
        let of = |name: &str| DraftFile::for_corpus_path(&folders, Path::new(name));
        let (mut one, mut other) = (of("/one"), of("/other"));
        assert_eq!(one.read_draft(), None);
        one.keep_draft(Some(draft(5))).expect("written");
        other.keep_draft(Some(draft(7))).expect("written");
        assert_eq!(of("/one").read_draft(), Some(draft(5)));
        assert_eq!(of("/other").read_draft(), Some(draft(7)));
        one.keep_draft(None).expect("taken away");
        one.keep_draft(None).expect("nothing to take away");
        assert_eq!(of("/one").read_draft(), None);
        let mut none = DraftFile::for_corpus_path(&StudioFolders::default(), Path::new("/one"));
        none.keep_draft(Some(draft(1))).expect("nothing to write to");
        assert_eq!(hash(""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(hash("a"), 0xaf63_dc4c_8601_ec8c);
    }
}
