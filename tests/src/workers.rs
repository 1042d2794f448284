//! Other processes at work on a corpus, and what must hold of it afterwards.

use std::collections::BTreeSet;
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdout, Command, Stdio};

use chereme_corpus::{Corpus, ImportOptions, ProgressReceiver, ignore_progress_step};

use crate::files;

/// A worker process.
pub struct Worker {
    child: Child,
    lines: BufReader<ChildStdout>,
}

/// The output of a worker that has ended.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Said {
    /// The numbers of the operations that it reported done.
    pub done: BTreeSet<i64>,
    /// Whether it came to its end with success.
    pub ended: bool,
    /// Its standard error.
    pub errors: String,
}

impl Worker {
    /// Starts the program `worker` on a corpus: its task, who it is, how many times.
    ///
    /// # Errors
    /// Where the program cannot be started.
    pub fn start(program: &str, corpus: &Path, task: &str, author: &str, count: usize) -> io::Result<Self> {
        let folder = corpus.parent().unwrap_or(corpus);
        let mut child = Command::new(program)
            .arg(corpus)
            .args([task, author])
            .arg(folder)
            .arg(count.to_string())
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()?;
        let out = child.stdout.take().ok_or(io::ErrorKind::BrokenPipe)?;
        let lines = BufReader::new(out);
        Ok(Self { child, lines })
    }

    /// Waits until the worker has its corpus open.
    ///
    /// # Errors
    /// Where it ended before.
    pub fn wait_until_ready(&mut self) -> io::Result<()> {
        let mut line = String::new();
        self.lines.read_line(&mut line)?;
        if line.trim() == "ready" {
            Ok(())
        } else {
            Err(io::ErrorKind::UnexpectedEof.into())
        }
    }

    /// Kills the worker at once, and returns its output up to then.
    ///
    /// # Errors
    /// Fails if the system does not allow the kill.
    pub fn kill(mut self) -> io::Result<Said> {
        self.child.kill()?;
        self.hear()
    }

    /// Waits until the worker ends, and returns its output.
    ///
    /// # Errors
    /// Fails if its output cannot be read.
    pub fn hear(mut self) -> io::Result<Said> {
        let mut text = String::new();
        self.lines.read_to_string(&mut text)?;
        let mut errors = String::new();
        if let Some(stream) = &mut self.child.stderr {
            stream.read_to_string(&mut errors)?;
        }
        let status = self.child.wait()?;
        let whole = text.rfind('\n').map_or("", |end| &text[..end]);
        let done = whole
            .lines()
            .filter_map(|line| line.strip_prefix("done ")?.parse().ok())
            .collect();
        let ended = status.success();
        Ok(Said { done, ended, errors })
    }
}

/// Makes a corpus with a recording, its annotations and a lexicon, and returns its file.
///
/// # Errors
/// Where the files cannot be written, or the corpus refuses them.
pub fn small_corpus(folder: &Path, name: &str) -> Result<PathBuf, Box<dyn std::error::Error>> {
    let inbox = folder.join("inbox");
    std::fs::create_dir_all(&inbox)?;
    std::fs::write(inbox.join("bowl and cat.bvh"), files::bvh(200, 1))?;
    std::fs::write(inbox.join("bowl and cat.eaf"), files::two_signs())?;
    std::fs::write(inbox.join("words.tsv"), files::lexicon())?;
    std::fs::write(inbox.join("notated.sigml"), files::sigml())?;
    let path = folder.join(name);
    let mut corpus = Corpus::create_corpus(&path, "maker")?;
    let report = corpus.import_paths(
        std::slice::from_ref(&inbox),
        &ImportOptions::default(),
        &mut ProgressReceiver::new(&mut ignore_progress_step),
    )?;
    if report.has_refusals() {
        return Err(format!("{:?}", report.files).into());
    }
    Ok(path)
}
