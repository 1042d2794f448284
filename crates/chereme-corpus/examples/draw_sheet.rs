//! Draws a sign as a sheet of moments, without a window: `cargo run -p chereme-corpus --example draw_sheet -- [FILE.png]`.

#![allow(clippy::print_stdout, reason = "a program prints its answer")]

use std::error::Error;
use std::fs;
use std::ops::ControlFlow;
use std::path::PathBuf;

use chereme_corpus::starter_signs;
use chereme_figure::{SheetOptions, contact_sheet, write_png};

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let named = std::env::args().nth(1).filter(|name| name.ends_with(".png"));
    let folder = tempfile::tempdir()?;
    let to = named.map_or_else(|| folder.path().join("sheet.png"), PathBuf::from);

    let sign = starter_signs().next().ok_or("the starter corpus has signs")??;
    let options = SheetOptions {
        title: sign.gloss,
        ..SheetOptions::default()
    };
    // The last argument hears how far the drawing is, and may stop it.
    let mut progress = |_done, _total| ControlFlow::Continue(());
    let sheet = contact_sheet(&sign.clip, &sign.anatomy, &options, &mut progress)?;

    let mut bytes = Vec::new();
    write_png(&sheet, &mut bytes)?;
    fs::write(&to, &bytes)?;
    println!("{}: {} bytes", to.display(), bytes.len());
    Ok(())
}
