//! Signs from notation, drawn and measured.
//!
//! `cargo run --release -p chereme-tests --example notation -- table FOLDER BODY.bvh...` animates every
//! `.sigml` file of a folder on each body and prints what came of it. `... -- draw FOLDER BODY.bvh OUT
//! GLOSS...` draws contact sheets of some. `... -- list FOLDER BODY.bvh` prints a line for each sign:
//! its worst values, and what is said of it.

#![allow(clippy::print_stdout)]

mod bodies;
mod checks;
mod draw;
mod table;

use std::error::Error;
use std::path::Path;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words.as_slice() {
        ["table", folder, bodies @ ..] if !bodies.is_empty() => {
            table::print(Path::new(folder), bodies)
        }
        ["list", folder, body] => table::list(Path::new(folder), body),
        ["draw", folder, body, out, glosses @ ..] => {
            draw::sheets(Path::new(folder), Path::new(body), Path::new(out), glosses)
        }
        _ => Err("say `table FOLDER BODY.bvh...`, `draw FOLDER BODY.bvh OUT GLOSS...` or `list FOLDER BODY.bvh`".into()),
    }
}
