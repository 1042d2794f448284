//! Generates sessions of cued speech, and measures how well the models recover their known truth.
//!
//! `cargo run --release -p chereme-tests --example cued -- table` prints the table, `… -- table FILE` writes it into a
//! Markdown file between the lines `<!-- cued -->` and `<!-- end of cued -->`, with numpy beside the training of models if
//! `CHEREME_PYTHON` names a Python that has it;
//! `… -- session OUT [SENTENCES] [SEED]` writes a session, 238 sentences if no number is given: C3D with TextGrid, TRC with
//! EAF, the truth as CSV, and a README that declares everything as generated. `… -- fable` prints the keys of two fables of La Fontaine, line by line; the same
//! text is cued with `chereme cue CORPUS "$(cat tests/examples/cued/corbeau.txt)"`.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "the table is the program's result"
)]

mod exact;
mod made;
mod session;
mod table;

use std::path::Path;
use std::process::ExitCode;

use chereme_analysis::cue::generate::CueGeneratorSettings;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let number = |at: usize, usual: u64| words.get(at).map_or(Some(usual), |word| word.parse().ok());
    match words.first().map(String::as_str) {
        Some("table") => {
            let text = table::made();
            match words.get(1).map(|path| put(Path::new(path), &text)) {
                None => println!("{text}"),
                Some(Ok(())) => println!("written"),
                Some(Err(error)) => {
                    eprintln!("{}: {error}", words[1]);
                    return ExitCode::FAILURE;
                }
            }
            ExitCode::SUCCESS
        }
        Some("session") if words.len() >= 2 => {
            let (Some(sentences), Some(seed)) = (number(2, 238), number(3, 1)) else {
                eprintln!("SENTENCES and SEED are whole numbers");
                return ExitCode::from(2);
            };
            let plan = session::Plan {
                sentences,
                words: session::USUAL_WORDS,
                times: 2,
                settings: CueGeneratorSettings {
                    seed,
                    ..CueGeneratorSettings::default()
                },
            };
            match session::write(Path::new(&words[1]), &plan) {
                Ok(report) => {
                    println!("{report}");
                    ExitCode::SUCCESS
                }
                Err(error) => {
                    eprintln!("{}: {error}", words[1]);
                    ExitCode::FAILURE
                }
            }
        }
        Some("fable") => {
            let fables = [include_str!("fable.txt"), include_str!("corbeau.txt")];
            for line in fables.into_iter().flat_map(str::lines) {
                match chereme_corpus::cue_keys(line, &chereme_corpus::KeysOptions::default()) {
                    Ok(read) => {
                        let keys = read.keys.iter();
                        let keys: Vec<String> = keys.map(|key| format!("{}-{}", key.placement, key.shape)).collect();
                        println!("{line}\n    {}", keys.join(" "));
                        read.findings.iter().for_each(|finding| println!("    {finding}"));
                    }
                    Err(error) => eprintln!("{line}: {error}"),
                }
            }
            ExitCode::SUCCESS
        }
        _ => {
            eprintln!("write `table [FILE]`, `fable`, or `session OUT [SENTENCES] [SEED]`");
            ExitCode::from(2)
        }
    }
}

/// Replaces the table in a Markdown file.
fn put(path: &Path, table: &str) -> std::io::Result<()> {
    const BEGIN: &str = "<!-- cued -->\n";
    const END: &str = "<!-- end of cued -->";
    let text = std::fs::read_to_string(path)?;
    let parts = text
        .split_once(BEGIN)
        .and_then(|(before, rest)| Some((before, rest.split_once(END)?.1)));
    let Some((before, after)) = parts else {
        return Err(std::io::Error::other(format!(
            "there are no lines {BEGIN:?} and {END:?}"
        )));
    };
    std::fs::write(path, format!("{before}{BEGIN}\n{table}\n{END}{after}"))
}
