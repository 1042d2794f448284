//! Animates signs from notation, draws them, and measures them.
//!
//! `cargo run --release -p chereme-tests --example notation -- table FOLDER BODY.bvh...` animates every `.sigml`
//! file of a folder on each body and prints the result. `... -- draw FOLDER BODY.bvh OUT GLOSS...` draws contact
//! sheets of some, `... -- draw whole FOLDER BODY.bvh OUT GLOSS...` with the way from rest and back, `... -- draw random
//! COUNT SEED FOLDER BODY.bvh OUT` of signs that a seed chooses. `... -- list FOLDER BODY.bvh` prints a line for each sign: its worst values, and its report.
//! `... -- faults FOLDER BODY.bvh [FILE.md [BEFORE]]` counts faults that make movement look unlike a person's, and writes
//! the table between the marks of a file, with the counts of BEFORE, its output for an earlier animator;
//! `faults sample N FOLDER BODY.bvh` takes one sign out of N.
//! `... -- vectors FILE BODY.bvh...` compares small signs with the numbers of the reference engine on each body.

#![allow(clippy::print_stdout, reason = "a program prints its table")]

mod bodies;
mod bulk;
mod checks;
mod count;
mod draw;
mod faults;
mod table;
mod vectors;
mod vectors_table;
mod walk;

use std::error::Error;
use std::path::Path;

use draw::Shown;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words.as_slice() {
        ["table", folder, bodies @ ..] if !bodies.is_empty() => {
            table::print(Path::new(folder), bodies)
        }
        ["faults", "sample", every, folder, body] => {
            count::faults(Path::new(folder), body, every.parse::<usize>()?.max(1), None)
        }
        ["faults", folder, body] => count::faults(Path::new(folder), body, 1, None),
        ["faults", folder, body, file, before @ ..] if before.len() < 2 => {
            let into = count::Table {
                file: Path::new(file),
                before: before.first().map(Path::new),
            };
            count::faults(Path::new(folder), body, 1, Some(into))
        }
        ["vectors", file, paths @ ..] if !paths.is_empty() => {
            let stage = |path: &&str| Ok(((*path).to_owned(), bodies::stage(Path::new(path))?));
            let bodies = paths.iter().map(stage).collect::<Result<Vec<_>>>()?;
            vectors_table::print_vector_table(Path::new(file), &bodies)
        }
        ["list", folder, body] => table::list(Path::new(folder), body),
        ["draw", "random", count, seed, folder, body, out] => {
            let folder = Path::new(folder);
            let glosses = draw::chosen(folder, count.parse()?, seed.parse()?)?;
            println!("{}", glosses.join(" "));
            let glosses: Vec<&str> = glosses.iter().map(String::as_str).collect();
            draw::sheets(folder, Path::new(body), Path::new(out), (&glosses, Shown::Sign))
        }
        ["draw", "whole", folder, body, out, glosses @ ..] => {
            let out = Path::new(out);
            draw::sheets(Path::new(folder), Path::new(body), out, (glosses, Shown::Whole))
        }
        ["draw", folder, body, out, glosses @ ..] => {
            let out = Path::new(out);
            draw::sheets(Path::new(folder), Path::new(body), out, (glosses, Shown::Sign))
        }
        _ => Err("say `table FOLDER BODY.bvh...`, `draw FOLDER BODY.bvh OUT GLOSS...` `list FOLDER BODY.bvh`, `vectors FILE BODY.bvh...` or `faults FOLDER BODY.bvh [FILE.md]`".into()),
    }
}
