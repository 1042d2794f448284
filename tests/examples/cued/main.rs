//! Generated sessions of cued speech, and the table of what the models recover of their truth.
//!
//! `cargo run --release -p chereme-tests --example cued -- table` prints the table;
//! `… -- session OUT [SENTENCES] [SEED]` writes a session: TRC, TextGrid and the truth as CSV, with a README that says
//! that nothing of it was captured. `… -- fable` prints the keys of a fable of La Fontaine, line by line; the same text
//! is cued with `chereme cue CORPUS "$(cat tests/examples/cued/fable.txt)"`.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "the table is the program's result"
)]

mod session;
mod table;

use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let number =
        |at: usize, usual: u64| words.get(at).map_or(Some(usual), |word| word.parse().ok());
    match words.first().map(String::as_str) {
        Some("table") => {
            table::print();
            ExitCode::SUCCESS
        }
        Some("session") if words.len() >= 2 => {
            let (Some(sentences), Some(seed)) = (number(2, 20), number(3, 1)) else {
                eprintln!("SENTENCES and SEED are whole numbers");
                return ExitCode::from(2);
            };
            match session::write(Path::new(&words[1]), sentences, seed) {
                Ok(told) => {
                    println!("{told}");
                    ExitCode::SUCCESS
                }
                Err(error) => {
                    eprintln!("{}: {error}", words[1]);
                    ExitCode::FAILURE
                }
            }
        }
        Some("fable") => {
            for line in include_str!("fable.txt").lines() {
                match chereme_corpus::cue_keys(line, &chereme_corpus::KeysOptions::default()) {
                    Ok(read) => {
                        let keys = read.keys.iter();
                        let keys: Vec<String> = keys
                            .map(|key| format!("{}-{}", key.placement, key.shape))
                            .collect();
                        println!("{line}\n    {}", keys.join(" "));
                        read.findings
                            .iter()
                            .for_each(|finding| println!("    {finding}"));
                    }
                    Err(error) => eprintln!("{line}: {error}"),
                }
            }
            ExitCode::SUCCESS
        }
        _ => {
            eprintln!("write `table`, `fable`, or `session OUT [SENTENCES] [SEED]`");
            ExitCode::from(2)
        }
    }
}
