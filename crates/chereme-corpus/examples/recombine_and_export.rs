//! Makes a new sign from a captured one and exports it: `cargo run -p chereme-corpus --example recombine_and_export`.

#![allow(clippy::print_stdout, reason = "a program prints its answer")]

use std::error::Error;
use std::fs;

use chereme_corpus::{
    Corpus, ExportOptions, ExportWhat, ImportOptions, ProgressReceiver, ignore_progress_step, unpack_starter,
};

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let files = unpack_starter(&folder.path().join("files"))?;
    let mut corpus = Corpus::create_corpus(&folder.path().join("starter.chereme"), "Ada")?;
    let mut listener = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut listener);
    corpus.import_paths(&files, &ImportOptions::default(), progress)?;

    // BOL with other handshapes, in one and a half times its time: stored under a gloss of its own, and taken back by one undo.
    let sign = corpus.recombine_recipe("BOL | configure both 5 | retime 150%", "BOL-5")?;
    println!("{}: {} ms", sign.recipe, sign.duration_us / 1000);
    println!("{}", sign.explanation);

    // The ending of the file's name chooses the format.
    let token = sign.token.ok_or("a stored sign is a token")?;
    for name in ["bol-5.bvh", "bol-5.glb"] {
        let to = folder.path().join(name);
        let what = ExportWhat::Address(format!("token:{token}").parse()?);
        corpus.export_corpus(&what, &to, &ExportOptions::default(), progress)?;
        println!("{name}: {} bytes", fs::metadata(&to)?.len());
    }
    Ok(())
}
