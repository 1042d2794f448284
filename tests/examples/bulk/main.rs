//! Imports many takes with annotations in one command, and prints the speed and the memory used:
//! `cargo run --release -p chereme-tests --example bulk [-- TAKES [CAPTURE.bvh]]`.
//!
//! Each take is a copy of the capture with another first number, so that no two files are equal, and has an annotation
//! file. Without CAPTURE a recording of the starter corpus is used. Without any argument the program imports 100, 300 and
//! 1,000 takes, each in a separate process, so that their peaks of memory can be compared, and writes the table to
//! RESULTS.md.

#![allow(clippy::print_stdout, reason = "a program prints its table")]

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use chereme_corpus::{Corpus, FileStatus, ImportOptions, ProgressReceiver, ProgressStep, unpack_starter};

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// The text before the table in the file of results.
const HEAD: &str = "# Many takes imported by one command

Written by `cargo run --release -p chereme-tests --example bulk`. Every take is a BVH file of its own with an EAF file; each row
is a process of its own. *Before* is the most memory that the process used until the import began, *peak* the most at its end: their
difference should not grow with the number of takes. *Steps* are the reports of progress.

| takes | files | seconds | takes a second | steps | before | peak | recordings | annotations | refused |
|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|
";

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let Some(takes) = arguments.first() else {
        let mut text = HEAD.to_owned();
        for takes in ["100", "300", "1000"] {
            let output = Command::new(std::env::current_exe()?).arg(takes).output()?;
            if !output.status.success() {
                return Err(String::from_utf8_lossy(&output.stderr).into_owned().into());
            }
            text += &String::from_utf8(output.stdout)?;
        }
        print!("{text}");
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/bulk/RESULTS.md");
        return Ok(std::fs::write(file, text)?);
    };
    print!("{}", row(takes.parse()?, arguments.get(1).map(Path::new))?);
    Ok(())
}

/// Imports `takes` takes, and returns the row of the table.
fn row(takes: usize, capture: Option<&Path>) -> Result<String> {
    let own = tempfile::tempdir()?;
    let starter = unpack_starter(&own.path().join("starter"))?;
    let named = |ending: &str| {
        let is = |path: &&PathBuf| {
            path.file_stem().is_some_and(|it| it == "escargot") && path.extension().is_some_and(|it| it == ending)
        };
        starter.iter().find(is).cloned()
    };
    let capture = match capture {
        Some(path) => path.to_owned(),
        None => named("bvh").ok_or("the starter corpus has no capture")?,
    };
    let notes = named("eaf").ok_or("the starter corpus has no annotations")?;
    let folder = own.path().join("takes");
    let bytes = write_takes(&folder, takes, &capture, &notes)?;
    let mut corpus = Corpus::create_corpus(&own.path().join("bulk.chereme"), "A")?;
    let before = memory();
    let begun = Instant::now();
    let mut steps = 0_u64;
    let mut hear = |_: ProgressStep<'_>| {
        steps += 1;
        std::ops::ControlFlow::Continue(())
    };
    let options = ImportOptions::default();
    let report = corpus.import_paths(&[folder], &options, &mut ProgressReceiver::new(&mut hear))?;
    let seconds = begun.elapsed().as_secs_f64();
    let mebibytes = |it: Option<u64>| it.map_or("?".into(), |it| format!("{it} MiB"));
    let made = |kind: &str| report.created.get(kind).copied().unwrap_or_default();
    let refused = report.files.iter().filter(|it| it.status == FileStatus::Refused);
    Ok(format!(
        "| {takes} | {:.0} MB | {seconds:.1} | {:.0} | {steps} | {} | {} | {} | {} | {} |\n",
        bytes as f64 / 1e6,
        takes as f64 / seconds,
        mebibytes(before),
        mebibytes(memory()),
        made("recordings"),
        made("annotations"),
        refused.count(),
    ))
}

/// Writes the takes, and returns their size in bytes.
fn write_takes(folder: &Path, takes: usize, capture: &Path, notes: &Path) -> Result<u64> {
    std::fs::create_dir_all(folder)?;
    let movement = std::fs::read_to_string(capture)?;
    let head = movement.find("Frame Time").ok_or("the capture has no movement")?;
    let numbers = head + movement[head..].find('\n').ok_or("the capture has no frames")? + 1;
    let first = numbers + movement[numbers..].find(' ').ok_or("a frame has one number")?;
    let notes = std::fs::read_to_string(notes)?;
    let mut bytes = 0;
    for take in 0..takes {
        let text = format!("{}{take}.5{}", &movement[..numbers], &movement[first..]);
        bytes += (text.len() + notes.len()) as u64;
        std::fs::write(folder.join(format!("take{take:05}.bvh")), text)?;
        std::fs::write(folder.join(format!("take{take:05}.eaf")), &notes)?;
    }
    Ok(bytes)
}

/// Returns the peak memory of this process in MiB, if the system reports it.
fn memory() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kilobytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes / 1024)
}
