//! Declares a constant for each text of the window: of the phrase `window-shell-close` in `window-shell.ftl` the constant
//! `shell::CLOSE`. A name without a phrase does not compile, and a phrase without a reader is reported.

use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=build.rs");
    let mut modules = String::new();
    for (path, words) in chereme_data::files_below("schema/words/en") {
        let part = path.strip_prefix("window-").and_then(|name| name.strip_suffix(".ftl"));
        let Some(part) = part else { continue };
        let start = format!("window-{part}-");
        let ids = words.lines().filter_map(|line| Some(line.split_once(" =")?.0));
        let constants: String = ids.filter_map(|id| declared_text(id, &start)).collect();
        let module = part.replace('-', "_");
        writeln!(
            modules,
            "pub(crate) mod {module} {{ use crate::words::InterfaceText; {constants} }}"
        )
        .map_err(io::Error::other)?;
    }
    let out = env::var("OUT_DIR").map_err(io::Error::other)?;
    fs::write(Path::new(&out).join("texts.rs"), modules)
}

/// Returns the constant of a phrase whose id begins with `start`.
fn declared_text(id: &str, start: &str) -> Option<String> {
    let name = id.strip_prefix(start)?.to_uppercase().replace('-', "_");
    Some(format!(
        "pub(crate) const {name}: InterfaceText = InterfaceText::from_id({id:?});"
    ))
}
