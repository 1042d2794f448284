//! Imports many takes with annotations in one command and prints how fast that goes and how much memory it takes:
//! `cargo run --release -p chereme-tests --example bulk [-- TAKES [CAPTURE.bvh]]`.
//!
//! Every take is the capture with another first number, so that no two files are the same, and has an annotation file.
//! Without a capture that of the starter corpus is used.

#![allow(clippy::print_stdout, reason = "a program prints its table")]

use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;

use chereme_corpus::{Corpus, ImportOptions, Progress, Step, unpack_starter};

type Result<T> = std::result::Result<T, Box<dyn Error>>;

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let takes: usize = arguments.first().map_or(Ok(1000), |text| text.parse())?;
    let own = tempfile::tempdir()?;
    let starter = unpack_starter(&own.path().join("starter"))?;
    let named = |ending: &str| {
        let is = |path: &&PathBuf| {
            path.file_stem().is_some_and(|it| it == "escargot")
                && path.extension().is_some_and(|it| it == ending)
        };
        starter.iter().find(is).cloned()
    };
    let capture = match arguments.get(1) {
        Some(path) => PathBuf::from(path),
        None => named("bvh").ok_or("the starter corpus has no capture")?,
    };
    let notes = named("eaf").ok_or("the starter corpus has no annotations")?;
    let folder = own.path().join("takes");
    let bytes = write_takes(&folder, takes, &capture, &notes)?;
    let mut corpus = Corpus::create(&own.path().join("bulk.chereme"), "A")?;
    let before = memory();
    let begun = Instant::now();
    let mut steps = 0_u64;
    let mut hear = |_: Step<'_>| {
        steps += 1;
        std::ops::ControlFlow::Continue(())
    };
    let options = ImportOptions::default();
    let report = corpus.import(&[folder], &options, &mut Progress::new(&mut hear))?;
    let seconds = begun.elapsed().as_secs_f64();
    println!(
        "{takes} takes with annotations, {:.0} MB: {seconds:.1} s, {:.0} takes a second, {steps} steps of progress",
        bytes as f64 / 1e6,
        takes as f64 / seconds
    );
    if let Some((before, most)) = before.zip(memory()) {
        println!("the most memory before: {before} MiB, after: {most} MiB");
    }
    println!(
        "made: {:?}, refused: {}",
        report.created,
        report.has_refusals()
    );
    Ok(())
}

/// Writes the takes and returns how many bytes they have.
fn write_takes(folder: &Path, takes: usize, capture: &Path, notes: &Path) -> Result<u64> {
    std::fs::create_dir_all(folder)?;
    let movement = std::fs::read_to_string(capture)?;
    let head = movement
        .find("Frame Time")
        .ok_or("the capture has no movement")?;
    let numbers = head
        + movement[head..]
            .find('\n')
            .ok_or("the capture has no frames")?
        + 1;
    let first = numbers
        + movement[numbers..]
            .find(' ')
            .ok_or("a frame has one number")?;
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

/// Returns the most memory that this process ever used, in MiB, where the system has it.
fn memory() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kilobytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes / 1024)
}
