//! Declares a constant for each text that the command line and the window share.

use std::path::Path;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=build.rs");
    let out = env::var("OUT_DIR").map_err(io::Error::other)?;
    let texts = chereme_data::declare_text_constants("texts", "pub");
    fs::write(Path::new(&out).join("texts.rs"), texts)
}
