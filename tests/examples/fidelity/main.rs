//! Measures the fidelity of generated movement to captured movement, as Markdown tables:
//! `cargo run --release -p chereme-tests --example fidelity -- FOLDER-OF-BVH`.
//!
//! Reads every BVH file below the folder. With the names of tables after it (`interpolation`,
//! `exactness`, `spatialisation`, `contact`) only those are printed.

use std::error::Error;
use std::path::Path;

mod capture;
mod contact;
mod exactness;
mod interpolation;
mod shelf;
mod spatial;
mod strokes;
mod table;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// One part of the benchmark, which returns its tables.
type Table = fn(&[capture::Capture]) -> Result<String>;

#[allow(clippy::print_stdout, clippy::print_stderr)]
fn main() -> Result<()> {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments.next().ok_or("name a folder of BVH files")?;
    let wanted: Vec<String> = arguments.collect();
    let (captures, left_out) = capture::read_folder(Path::new(&folder))?;
    for reason in left_out {
        eprintln!("left out: {reason}");
    }
    let tables: [(&str, Table); 4] = [
        ("interpolation", interpolation::tables),
        ("exactness", exactness::tables),
        ("spatialisation", spatial::tables),
        ("contact", contact::tables),
    ];
    for (name, table) in tables {
        if wanted.is_empty() || wanted.iter().any(|word| word == name) {
            println!("{}", table(&captures)?);
        }
    }
    Ok(())
}
