//! Writes annotations as a file of ELAN: `cargo run -p chereme-formats --example write_eaf`.

#![allow(clippy::print_stdout, reason = "a program prints its answer")]

use std::error::Error;

use chereme_formats::eaf::{eaf_convert, eaf_raw, read_eaf};
use chereme_motion::{RecordingInstant, TimeSpan};

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let mut tier = eaf_convert::TranscriptTier {
        name: "Gloss".to_owned(),
        kind: "gloss".to_owned(),
        participant: Some("Ada".to_owned()),
        ..eaf_convert::TranscriptTier::default()
    };
    for (gloss, start, end) in [("BOL", 200, 700), ("DONNER", 900, 1600)] {
        tier.annotations.push(eaf_convert::TranscriptAnnotation {
            id: format!("a{}", tier.annotations.len() + 1),
            span: TimeSpan::span_between(RecordingInstant::from_millis(start), RecordingInstant::from_millis(end)),
            timing: eaf_convert::AnnotationTiming::Own,
            parent: None,
            order: 0,
            value: gloss.to_owned(),
            entry: None,
            language: None,
            external_ref: None,
            millis: None,
        });
    }
    let transcript = eaf_convert::AnnotationTranscript {
        author: "Ada".to_owned(),
        date: "2024-01-01T00:00:00Z".to_owned(),
        tiers: vec![tier],
        ..eaf_convert::AnnotationTranscript::default()
    };

    // The document is the file as ELAN has it: time slots, tier types, ids.
    let document = eaf_convert::eaf_document_from_transcript(&transcript, &eaf_raw::EafDocument::default());
    let mut file = Vec::new();
    eaf_raw::write_eaf_document(&document, &mut file)?;
    println!("{}", String::from_utf8_lossy(&file));

    let (again, findings) = read_eaf(&file)?;
    assert!(findings.is_empty(), "{findings:?}");
    for (read, written) in again.tiers[0].annotations.iter().zip(&transcript.tiers[0].annotations) {
        assert_eq!((read.span, &read.value), (written.span, &written.value));
    }
    assert_eq!(again.tiers[0].annotations.len(), 2);
    Ok(())
}
