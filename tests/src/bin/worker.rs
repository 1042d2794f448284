//! Works on a corpus until it is done or killed, and prints a line for each finished operation.
//!
//! `chereme-worker CORPUS TASK AUTHOR FOLDER COUNT` prints `ready` when the corpus is open, then
//! `done N` after each finished operation, N being its number in the history, and at last `end`.

use std::error::Error;
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use chereme_corpus::{AnnotateOptions, Corpus, ImportOptions, ProgressReceiver, RowName, ignore_progress_step};
use chereme_tests::files;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [corpus, task, author, folder, count] = arguments.as_slice() else {
        let _ = writeln!(io::stderr(), "usage: CORPUS TASK AUTHOR FOLDER COUNT");
        return ExitCode::from(2);
    };
    let job = Job {
        path: PathBuf::from(corpus),
        author: author.clone(),
        folder: PathBuf::from(folder),
    };
    match job.run(task, count.parse().unwrap_or(usize::MAX)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            let _ = writeln!(io::stderr(), "{author}: {error}");
            ExitCode::FAILURE
        }
    }
}

type Done = Result<(), Box<dyn Error>>;

struct Job {
    path: PathBuf,
    author: String,
    folder: PathBuf,
}

impl Job {
    fn run(&self, task: &str, count: usize) -> Done {
        if task == "create" {
            return self.create(count);
        }
        let mut corpus = Corpus::open_corpus(&self.path, &self.author)?;
        say("ready")?;
        for step in 0..count {
            match task {
                "import" => self.import(&mut corpus, step)?,
                "annotate" => self.annotate(&mut corpus, step)?,
                "recombine" => {
                    let gloss = format!("{}-{step}", self.author);
                    corpus.recombine_recipe("BOL | place right by left 5cm", &gloss)?;
                }
                "history" => {
                    corpus.redo_operation().or_else(|_| corpus.undo_operation())?;
                }
                "read" => {
                    corpus.operation_log(usize::MAX)?;
                }
                other => return Err(format!("the task {other:?} is unknown").into()),
            }
            if task != "read" {
                self.print_newest(&corpus)?;
            }
        }
        drop(corpus);
        say("end")
    }

    fn create(&self, count: usize) -> Done {
        say("ready")?;
        for step in 0..count {
            let path = self.folder.join(format!("{}-{step}.chereme", self.author));
            Corpus::create_corpus(&path, &self.author)?;
            say(&format!("done {step}"))?;
        }
        say("end")
    }

    /// Imports a recording with its annotations as one operation.
    fn import(&self, corpus: &mut Corpus, step: usize) -> Done {
        let stem = format!("{}-{step}", self.author);
        let seed = stem
            .bytes()
            .fold(7u32, |sum, byte| sum.wrapping_mul(31).wrapping_add(u32::from(byte)));
        let write = |name: String, text: String| -> io::Result<PathBuf> {
            let path = self.folder.join(name);
            std::fs::write(&path, text)?;
            Ok(path)
        };
        let motion = write(format!("{stem}.bvh"), files::bvh(60, seed))?;
        let said = files::two_signs().replace("BOL", &stem);
        let said = write(format!("{stem}.eaf"), said)?;
        let report = corpus.import_paths(
            &[motion, said],
            &ImportOptions::default(),
            &mut ProgressReceiver::new(&mut ignore_progress_step),
        )?;
        if report.has_refusals() {
            return Err(format!("{:?}", report.files).into());
        }
        Ok(())
    }

    /// Gives a sign another gloss, handshape, time and translation in one operation.
    fn annotate(&self, corpus: &mut Corpus, step: usize) -> Done {
        let (author, handshape) = (&self.author, ["5", "S"][step % 2]);
        let end = 1400 + step % 100;
        let table = format!(
            "action,id,end,value\n\
             set,a2,,{author}-{step}\n\
             set,a4,{end}ms,{handshape}\n\
             set,a9,,step {step} of {author}\n"
        );
        let recording = RowName::Text("bowl and cat".to_owned());
        corpus.annotate_table(
            table.as_bytes(),
            "changes",
            Some(&recording),
            &AnnotateOptions::default(),
            &mut ProgressReceiver::new(&mut ignore_progress_step),
        )?;
        Ok(())
    }

    /// Prints the newest operation of this worker.
    fn print_newest(&self, corpus: &Corpus) -> Done {
        let log = corpus.operation_log(200)?;
        let own = log.iter().find(|row| row.author == self.author);
        let own = own.ok_or("the operation is not in the log")?;
        say(&format!("done {}", own.id))
    }
}

fn say(text: &str) -> Done {
    let mut out = io::stdout().lock();
    writeln!(out, "{text}")?;
    out.flush()?;
    Ok(())
}
