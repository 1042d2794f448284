//! Generates the starter corpus in `corpus/`: `cargo run -p chereme-corpus --example make_starter`.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

#[path = "all.rs"]
mod all;

fn main() -> io::Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus");
    fs::create_dir_all(&folder)?;
    let performances = all::performances();
    for (take, made) in &performances {
        for warning in &made.report.warnings {
            writeln!(io::stderr(), "{}: {warning}", take.stem)?;
        }
    }
    for (name, bytes) in all::files(&performances) {
        fs::write(folder.join(name), bytes)?;
    }
    Ok(())
}
