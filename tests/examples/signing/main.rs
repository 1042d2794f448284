//! Measures the timing of signing, in signers estimated from film and in captured signs:
//! `cargo run --release -p chereme-tests --example signing -- FILE-OR-FOLDER...`.
//!
//! Reads every `.pose` and BVH file that is named or lies below a named folder. Prints medians and quartiles of
//! approaches, strokes, holds and returns of the wrists, how far the courses that formulas give are from the
//! strokes, and how high elbows are while hands sign. Films are measured on the picture, shoulders taken as 36 cm wide;
//! so movement towards the camera is missing.

use std::error::Error;
use std::path::{Path, PathBuf};

mod course;
mod elbows;
mod phases;
mod take;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

#[allow(clippy::print_stdout, clippy::print_stderr)]
fn main() -> Result<()> {
    let mut paths = Vec::new();
    for argument in std::env::args().skip(1) {
        find(Path::new(&argument), &mut paths)?;
    }
    if paths.is_empty() {
        return Err("name `.pose` or BVH files, or folders of them".into());
    }
    paths.sort();
    let mut takes = Vec::new();
    for path in &paths {
        match take::read(path) {
            Ok(found) => takes.extend(found),
            Err(error) => eprintln!("left out: {}: {error}", path.display()),
        }
    }
    println!("{}", phases::table(&takes));
    println!("{}", course::table(&takes));
    println!("{}", elbows::table(&takes));
    Ok(())
}

fn find(path: &Path, paths: &mut Vec<PathBuf>) -> Result<()> {
    if path.is_dir() {
        for entry in std::fs::read_dir(path)? {
            find(&entry?.path(), paths)?;
        }
    } else if path
        .extension()
        .is_some_and(|ending| ending == "pose" || ending.eq_ignore_ascii_case("bvh"))
    {
        paths.push(path.to_owned());
    }
    Ok(())
}
