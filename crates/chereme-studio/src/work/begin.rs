//! Opening a corpus, which is created first if necessary.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, channel};

use chereme_corpus::{
    Corpus, CorpusError, CorpusResult, ImportOptions, ProgressReceiver, ProgressStep, unpack_starter,
};

use super::WorkProgress;
use super::desk::WindowWaker;

/// The corpus to open.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum CorpusOpening {
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
pub(crate) struct OpeningInProgress {
    news: Receiver<OpeningNews>,
    pub(crate) far: WorkProgress,
    stop: Arc<AtomicBool>,
    /// The files to show in the import pane after the opening.
    pub(crate) look: Vec<PathBuf>,
    /// The corpus, if it is created only to receive those files.
    pub(crate) made: Option<PathBuf>,
}

enum OpeningNews {
    Far(WorkProgress),
    Ended(CorpusResult<PathBuf>),
}

impl OpeningInProgress {
    /// Starts the opening on a separate thread.
    pub(crate) fn start_corpus_opening(begin: CorpusOpening, author: &str, wake: &WindowWaker) -> Self {
        let (look, made) = begin.opening_import_files();
        let (sender, news) = channel();
        let (author, wake) = (author.to_owned(), wake.clone());
        let stop = Arc::new(AtomicBool::new(false));
        let stopped = stop.clone();
        std::thread::spawn(move || {
            let mut hear = |step: ProgressStep<'_>| {
                // An opening that nobody waits for any more goes on to its end.
                let _ = sender.send(OpeningNews::Far(WorkProgress::progress_from_step(&step)));
                wake();
                if stopped.load(Ordering::Relaxed) {
                    ControlFlow::Break(())
                } else {
                    ControlFlow::Continue(())
                }
            };
            let ended = begin.carry_out_opening(&author, &mut ProgressReceiver::new(&mut hear));
            let _ = sender.send(OpeningNews::Ended(ended));
            wake();
        });
        Self {
            news,
            far: WorkProgress::default(),
            stop,
            look,
            made,
        }
    }

    pub(crate) fn stop_corpus_opening(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    /// Returns the path of the corpus or the error, once the opening has ended.
    pub(crate) fn finished_opening_path(&mut self) -> Option<CorpusResult<PathBuf>> {
        while let Ok(step) = self.news.try_recv() {
            match step {
                OpeningNews::Far(far) => self.far = far,
                OpeningNews::Ended(ended) => return Some(ended),
            }
        }
        None
    }
}

impl CorpusOpening {
    fn carry_out_opening(self, author: &str, progress: &mut ProgressReceiver<'_>) -> CorpusResult<PathBuf> {
        match self {
            Self::Open(path) => {
                // A path below the working folder names no folder that the file could be put back into.
                let path = std::path::absolute(&path).unwrap_or(path);
                Corpus::open_corpus(&path, author).map(|_| path)
            }
            Self::New(path) => {
                let path = with_extension(path);
                Corpus::create_corpus(&path, author).map(|_| path)
            }
            Self::Starter(folder) => starter(&folder, author, progress),
            Self::Folder(ref folder) if !folder.is_dir() => Err(CorpusError::from_file_failure(
                folder,
                std::io::ErrorKind::NotFound.into(),
            )),
            Self::Folder(_) | Self::Files(_) => {
                let path = self.opening_corpus_path();
                let open = if path.is_file() {
                    Corpus::open_corpus(&path, author)
                } else {
                    Corpus::create_corpus(&path, author)
                };
                open.map(|_| path)
            }
        }
    }

    /// Returns the files to show in the import pane, and the path of the corpus if it is created only for them.
    fn opening_import_files(&self) -> (Vec<PathBuf>, Option<PathBuf>) {
        let look = match self {
            Self::Folder(folder) => vec![folder.clone()],
            Self::Files(files) => files.clone(),
            _ => return (Vec::new(), None),
        };
        let path = self.opening_corpus_path();
        // An absolute path still names the corpus if the working folder changes.
        let made = (!path.exists()).then(|| std::path::absolute(&path).unwrap_or(path));
        (look, made)
    }

    /// Returns the path of the corpus for the files.
    fn opening_corpus_path(&self) -> PathBuf {
        let path = match self {
            Self::Folder(folder) => folder.clone(),
            Self::Files(files) => {
                let parent_folder = files.first().and_then(|file| file.parent());
                let folder = parent_folder.unwrap_or(Path::new(""));
                // The corpus beside the folder has the folder's name.
                folder.join(folder.file_name().unwrap_or_default())
            }
            Self::Open(path) | Self::New(path) | Self::Starter(path) => path.clone(),
        };
        with_extension(path)
    }
}

/// Opens the starter corpus in `folder`, built first if missing.
fn starter(folder: &Path, author: &str, progress: &mut ProgressReceiver<'_>) -> CorpusResult<PathBuf> {
    let path = folder.join("starter.chereme");
    if path.is_file() {
        return Corpus::open_corpus(&path, author).map(|_| path);
    }
    let files = folder.join("starter");
    unpack_starter(&files)?;
    create_filled_corpus(&path, &files, author, progress)?;
    Ok(path)
}

/// Creates a corpus and imports all files of `folder`; deletes the corpus again if the import fails.
fn create_filled_corpus(
    path: &Path,
    folder: &Path,
    author: &str,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<()> {
    if !folder.is_dir() {
        return Err(CorpusError::from_file_failure(
            folder,
            std::io::ErrorKind::NotFound.into(),
        ));
    }
    let mut corpus = Corpus::create_corpus(path, author)?;
    let done = corpus.import_paths(&[folder.to_owned()], &ImportOptions::default(), progress);
    drop(corpus);
    if done.is_err() {
        // The failed import leaves an empty corpus that nobody has seen.
        let _ = std::fs::remove_file(path);
    }
    done.map(|_| ())
}

/// Returns the path with the extension of a corpus.
pub(crate) fn with_extension(path: PathBuf) -> PathBuf {
    if path.extension().is_some_and(|extension| extension == "chereme") {
        return path;
    }
    let mut name = path.into_os_string();
    name.push(".chereme");
    PathBuf::from(name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_corpus::ignore_progress_step;

    fn begin(what: CorpusOpening) -> CorpusResult<PathBuf> {
        let mut hear = ignore_progress_step;
        what.carry_out_opening("A", &mut ProgressReceiver::new(&mut hear))
    }

    #[test]
    fn a_new_corpus_gets_its_extension_and_is_never_overwritten() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = begin(CorpusOpening::New(folder.path().join("v1.2"))).expect("made");
        assert_eq!(path, folder.path().join("v1.2.chereme"));
        assert!(begin(CorpusOpening::New(path.clone())).is_err());
        assert_eq!(begin(CorpusOpening::Open(path.clone())).expect("opened"), path);
        assert!(begin(CorpusOpening::Open(folder.path().join("gone"))).is_err());
        let gone = begin(CorpusOpening::Open("gone.chereme".into())).expect_err("not there");
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
        let mut stop = |_: ProgressStep<'_>| ControlFlow::Break(());
        let starter = CorpusOpening::Starter(folder.path().to_owned());
        let done = starter.carry_out_opening("A", &mut ProgressReceiver::new(&mut stop));
        assert!(matches!(done, Err(CorpusError::Stopped)));
        assert!(!folder.path().join("starter.chereme").exists());
    }

    #[test]
    fn a_folder_and_files_are_inspected_before_the_import() {
        let folder = tempfile::tempdir().expect("a folder");
        let files = folder.path().join("mine");
        unpack_starter(&files).expect("unpacked");
        let file = files.join("escargot.bvh");
        for (what, look, name) in [
            (CorpusOpening::Folder(files.clone()), &files, "mine.chereme"),
            (CorpusOpening::Files(vec![file.clone()]), &file, "mine/mine.chereme"),
        ] {
            let want = folder.path().join(name);
            assert_eq!(what.opening_import_files(), (vec![look.clone()], Some(want.clone())));
            assert_eq!(begin(what.clone()).expect("made"), want);
            let corpus = Corpus::open_corpus(&want, "A").expect("opened");
            let overview = corpus.load_corpus_overview(10).expect("read");
            assert!(overview.recordings.is_empty() && overview.operations.is_empty());
            // The opened corpus exists, so it is not created only for the files.
            assert_eq!(what.opening_import_files().1, None);
            assert_eq!(begin(what).expect("opened"), want);
        }
        assert!(begin(CorpusOpening::Folder(folder.path().join("gone"))).is_err());
    }
}
