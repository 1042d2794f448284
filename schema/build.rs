//! Lists the files of `schema` and `corpus` as Rust, so that the crate embeds whatever lies in these folders.

use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let mut rows = String::new();
    for folder in ["corpus", "schema"] {
        println!("cargo::rerun-if-changed={folder}");
        add_files(folder, &mut rows)?;
    }
    let out = env::var("OUT_DIR").map_err(io::Error::other)?;
    fs::write(Path::new(&out).join("files.rs"), format!("&[{rows}]"))
}

/// Adds the path and the text of each file below a folder, by name; Rust is code, not data.
fn add_files(folder: &str, rows: &mut String) -> io::Result<()> {
    let names: io::Result<Vec<_>> = fs::read_dir(folder)?
        .map(|entry| entry.map(|entry| entry.file_name()))
        .collect();
    let mut names = names?;
    names.sort();
    for name in names {
        let path = format!("{folder}/{}", name.to_string_lossy());
        if Path::new(&path).is_dir() {
            add_files(&path, rows)?;
        } else if !path.ends_with(".rs") {
            let text = format!("include_str!(concat!(env!(\"CARGO_MANIFEST_DIR\"), \"/\", {path:?}))");
            writeln!(rows, "({path:?}, {text}),").map_err(io::Error::other)?;
        }
    }
    Ok(())
}
