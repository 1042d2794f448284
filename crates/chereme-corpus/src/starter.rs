//! The starter corpus: recordings and annotation files made by a program, held in the binary.

use std::fs;
use std::path::{Path, PathBuf};

use include_dir::{Dir, include_dir};

use chereme_figure::signed;
use chereme_motion::{Anatomy, Clip};

use crate::error::{Error, Result};
use crate::sources::notation::own_movement;

static FILES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/../../corpus");

/// Returns the names and bytes of the starter corpus's files.
pub fn starter_files() -> impl Iterator<Item = (&'static Path, &'static [u8])> {
    FILES.files().map(|file| (file.path(), file.contents()))
}

/// A sign of the starter corpus, to be seen before any corpus is open.
#[derive(Debug, Clone)]
pub struct StarterSign {
    /// Its gloss.
    pub gloss: String,
    /// Its movement, from the first to the last frame with a hand up.
    pub clip: Clip,
    /// Which joint is what.
    pub anatomy: Anatomy,
}

/// Recordings of the starter corpus that hold a single sign, and its gloss.
const SINGLE: [(&str, &str); 10] = [
    ("escargot.bvh", "ESCARGOT"),
    ("aimer.bvh", "AIMER"),
    ("chat.bvh", "CHAT"),
    ("bol.bvh", "BOL"),
    ("donner.bvh", "DONNER"),
    ("penser.bvh", "PENSER"),
    ("chien.bvh", "CHIEN"),
    ("week-end.bvh", "WEEK-END"),
    ("clair.bvh", "CLAIR"),
    ("punir.bvh", "PUNIR"),
];

/// Reads single signs of the starter corpus, one after the other; not for a window's thread.
///
/// # Errors
/// Where one of the program's own files is damaged.
pub fn starter_signs() -> impl Iterator<Item = Result<StarterSign>> {
    SINGLE.into_iter().map(|(file, gloss)| {
        let (clip, anatomy, _) = own_movement(file, usize::MAX)?;
        let clip = clip.slice(signed(&clip, &anatomy));
        Ok(StarterSign {
            gloss: gloss.to_owned(),
            clip,
            anatomy,
        })
    })
}

/// Writes the starter corpus's files into `folder`, which is made, and returns their paths.
///
/// # Errors
/// [`Error::File`] where a file cannot be written, or is there already with other bytes.
pub fn unpack_starter(folder: &Path) -> Result<Vec<PathBuf>> {
    fs::create_dir_all(folder).map_err(|error| Error::file(folder, error))?;
    let mut paths = Vec::new();
    for (name, bytes) in starter_files() {
        let path = folder.join(name);
        let same = fs::read(&path).is_ok_and(|there| there == bytes);
        if path.exists() && !same {
            return Err(Error::file(path, std::io::ErrorKind::AlreadyExists.into()));
        }
        fs::write(&path, bytes).map_err(|error| Error::file(&path, error))?;
        paths.push(path);
    }
    paths.sort();
    Ok(paths)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn single_signs_of_the_starter_corpus_move_and_have_hands() {
        let signs: Vec<StarterSign> = starter_signs().map(|it| it.expect("a sign")).collect();
        assert_eq!(signs.len(), SINGLE.len());
        for sign in &signs {
            let seconds = sign.clip.span().seconds();
            assert!((0.3..8.0).contains(&seconds), "{}: {seconds}", sign.gloss);
            let sides = chereme_motion::Side::BOTH;
            assert!(sides.iter().all(|&side| sign.anatomy.has_fingers(side)));
        }
    }
}
