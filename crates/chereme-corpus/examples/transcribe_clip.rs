//! Writes the notation of captured movement: `cargo run -p chereme-corpus --example transcribe_clip`.

#![allow(clippy::print_stdout, reason = "a program prints its answer")]

use std::error::Error;

use chereme_analysis::transcribe::{TranscribeOptions, transcribe_clip};
use chereme_corpus::starter_signs;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    for sign in starter_signs().take(3) {
        // A clip is a skeleton and its channels; its anatomy says which joint is which part of the body.
        let sign = sign?;
        let written = transcribe_clip(&sign.clip, &sign.anatomy, &TranscribeOptions::default())?;
        println!(
            "{}: {}",
            sign.gloss,
            chereme_sign::hamnosys::sign_hamnosys_text(&written.sign)
        );
        // Each feature knows how far the movement is from the value that was written.
        for feature in &written.features {
            println!("  {}: {} ({:.3})", feature.text, feature.value, feature.residual);
        }
        for finding in &written.findings {
            println!("  {finding}");
        }
    }
    Ok(())
}
