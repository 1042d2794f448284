//! Opening a corpus, which is created first if necessary.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, channel};

use chereme_corpus::{Corpus, Error, ImportOptions, Progress, Result, Step, unpack_starter};

use super::Far;
use super::desk::Wake;

/// The corpus to open.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Begin {
    /// An existing corpus.
    Open(PathBuf),
    /// A new, empty one.
    New(PathBuf),
    /// The starter corpus, built in this folder unless it exists.
    Starter(PathBuf),
    /// The corpus beside this folder, created empty if missing. The files of the folder are shown in the import pane
    /// first, and imported when the user agrees.
    Folder(PathBuf),
    /// The same for files, in the folder of the first.
    Files(Vec<PathBuf>),
}

/// An opening in progress.
pub(crate) struct Beginning {
    news: Receiver<OpeningNews>,
    pub(crate) far: Far,
    stop: Arc<AtomicBool>,
    /// The files to show in the import pane after the opening.
    pub(crate) look: Vec<PathBuf>,
    /// The corpus, if it is created only to receive those files.
    pub(crate) made: Option<PathBuf>,
}

enum OpeningNews {
    Far(Far),
    Ended(Result<PathBuf>),
}

impl Beginning {
    /// Starts the opening on a separate thread.
    pub(crate) fn start(begin: Begin, author: &str, wake: &Wake) -> Self {
        let (look, made) = begin.look();
        let (sender, news) = channel();
        let (author, wake) = (author.to_owned(), wake.clone());
        let stop = Arc::new(AtomicBool::new(false));
        let stopped = stop.clone();
        std::thread::spawn(move || {
            let mut hear = |step: Step<'_>| {
                let _ = sender.send(OpeningNews::Far(Far::of(&step)));
                wake();
                if stopped.load(Ordering::Relaxed) {
                    ControlFlow::Break(())
                } else {
                    ControlFlow::Continue(())
                }
            };
            let ended = begin.carry_out(&author, &mut Progress::new(&mut hear));
            let _ = sender.send(OpeningNews::Ended(ended));
            wake();
        });
        Self {
            news,
            far: Far::default(),
            stop,
            look,
            made,
        }
    }

    pub(crate) fn stop(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    /// Returns the path of the corpus or the error, once the opening has ended.
    pub(crate) fn ended(&mut self) -> Option<Result<PathBuf>> {
        while let Ok(step) = self.news.try_recv() {
            match step {
                OpeningNews::Far(far) => self.far = far,
                OpeningNews::Ended(ended) => return Some(ended),
            }
        }
        None
    }
}

impl Begin {
    fn carry_out(self, author: &str, progress: &mut Progress<'_>) -> Result<PathBuf> {
        match self {
            Self::Open(path) => {
                // A path below the working folder names no folder that the file could be put back into.
                let path = std::path::absolute(&path).unwrap_or(path);
                Corpus::open(&path, author).map(|_| path)
            }
            Self::New(path) => {
                let path = with_extension(path);
                Corpus::create(&path, author).map(|_| path)
            }
            Self::Starter(folder) => starter(&folder, author, progress),
            Self::Folder(ref folder) if !folder.is_dir() => {
                Err(Error::file(folder, std::io::ErrorKind::NotFound.into()))
            }
            Self::Folder(_) | Self::Files(_) => {
                let path = self.target();
                let open = if path.is_file() {
                    Corpus::open(&path, author)
                } else {
                    Corpus::create(&path, author)
                };
                open.map(|_| path)
            }
        }
    }

    /// Returns the files to show in the import pane, and the path of the corpus if it is created only for them.
    fn look(&self) -> (Vec<PathBuf>, Option<PathBuf>) {
        let look = match self {
            Self::Folder(folder) => vec![folder.clone()],
            Self::Files(files) => files.clone(),
            _ => return (Vec::new(), None),
        };
        let path = self.target();
        let made = (!path.exists()).then(|| std::path::absolute(&path).unwrap_or(path));
        (look, made)
    }

    /// Returns the path of the corpus for the files.
    fn target(&self) -> PathBuf {
        let path = match self {
            Self::Folder(folder) => folder.clone(),
            Self::Files(files) => {
                let folder = files.first().and_then(|it| it.parent());
                let folder = folder.unwrap_or(Path::new(""));
                folder.join(folder.file_name().unwrap_or_default())
            }
            Self::Open(path) | Self::New(path) | Self::Starter(path) => path.clone(),
        };
        with_extension(path)
    }
}

/// Opens the starter corpus in `folder`, built first if missing.
fn starter(folder: &Path, author: &str, progress: &mut Progress<'_>) -> Result<PathBuf> {
    let path = folder.join("starter.chereme");
    if path.is_file() {
        return Corpus::open(&path, author).map(|_| path);
    }
    let files = folder.join("starter");
    unpack_starter(&files)?;
    filled(&path, &files, author, progress)?;
    Ok(path)
}

/// Creates a corpus and imports all files of `folder`; deletes the corpus again if the import fails.
fn filled(path: &Path, folder: &Path, author: &str, progress: &mut Progress<'_>) -> Result<()> {
    if !folder.is_dir() {
        return Err(Error::file(folder, std::io::ErrorKind::NotFound.into()));
    }
    let mut corpus = Corpus::create(path, author)?;
    let done = corpus.import(&[folder.to_owned()], &ImportOptions::default(), progress);
    drop(corpus);
    if done.is_err() {
        // The failed import leaves an empty corpus that nobody has seen.
        let _ = std::fs::remove_file(path);
    }
    done.map(|_| ())
}

/// Returns the path with the extension of a corpus.
pub(crate) fn with_extension(path: PathBuf) -> PathBuf {
    if path
        .extension()
        .is_some_and(|extension| extension == "chereme")
    {
        return path;
    }
    let mut name = path.into_os_string();
    name.push(".chereme");
    PathBuf::from(name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_corpus::unheard;

    fn begin(what: Begin) -> Result<PathBuf> {
        let mut hear = unheard;
        what.carry_out("A", &mut Progress::new(&mut hear))
    }

    #[test]
    fn a_new_corpus_gets_its_extension_and_is_never_overwritten() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = begin(Begin::New(folder.path().join("v1.2"))).expect("made");
        assert_eq!(path, folder.path().join("v1.2.chereme"));
        assert!(begin(Begin::New(path.clone())).is_err());
        assert_eq!(begin(Begin::Open(path.clone())).expect("opened"), path);
        assert!(begin(Begin::Open(folder.path().join("gone"))).is_err());
        let gone = begin(Begin::Open("gone.chereme".into())).expect_err("not there");
        let here = std::env::current_dir().expect("a folder");
        assert!(
            gone.to_string()
                .contains(&here.join("gone.chereme").display().to_string()),
            "{gone}"
        );
    }

    #[test]
    fn a_stopped_import_leaves_no_corpus_behind() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut stop = |_: Step<'_>| ControlFlow::Break(());
        let starter = Begin::Starter(folder.path().to_owned());
        let done = starter.carry_out("A", &mut Progress::new(&mut stop));
        assert!(matches!(done, Err(Error::Stopped)));
        assert!(!folder.path().join("starter.chereme").exists());
    }

    #[test]
    fn a_folder_and_files_are_inspected_before_the_import() {
        let folder = tempfile::tempdir().expect("a folder");
        let files = folder.path().join("mine");
        unpack_starter(&files).expect("unpacked");
        let file = files.join("escargot.bvh");
        for (what, look, name) in [
            (Begin::Folder(files.clone()), &files, "mine.chereme"),
            (Begin::Files(vec![file.clone()]), &file, "mine/mine.chereme"),
        ] {
            let want = folder.path().join(name);
            assert_eq!(what.look(), (vec![look.clone()], Some(want.clone())));
            assert_eq!(begin(what.clone()).expect("made"), want);
            let corpus = Corpus::open(&want, "A").expect("opened");
            let overview = corpus.overview(10).expect("read");
            assert!(overview.recordings.is_empty() && overview.operations.is_empty());
            // The opened corpus exists, so it is not created only for the files.
            assert_eq!(what.look().1, None);
            assert_eq!(begin(what).expect("opened"), want);
        }
        assert!(begin(Begin::Folder(folder.path().join("gone"))).is_err());
    }
}
