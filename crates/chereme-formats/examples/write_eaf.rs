//! Writes annotations as a file of ELAN: `cargo run -p chereme-formats --example write_eaf`.

#![allow(clippy::print_stdout, reason = "a program prints its answer")]

use std::error::Error;

use chereme_formats::eaf::{convert, raw, read};
use chereme_motion::{Instant, Span};

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let mut tier = convert::Tier {
        name: "Gloss".to_owned(),
        kind: "gloss".to_owned(),
        participant: Some("Ada".to_owned()),
        ..convert::Tier::default()
    };
    for (gloss, start, end) in [("BOL", 200, 700), ("DONNER", 900, 1600)] {
        tier.annotations.push(convert::Annotation {
            id: format!("a{}", tier.annotations.len() + 1),
            span: Span::between(Instant::from_millis(start), Instant::from_millis(end)),
            timing: convert::Timing::Own,
            parent: None,
            order: 0,
            value: gloss.to_owned(),
            entry: None,
            language: None,
            external_ref: None,
            millis: None,
        });
    }
    let transcript = convert::Transcript {
        author: "Ada".to_owned(),
        date: "2024-01-01T00:00:00Z".to_owned(),
        tiers: vec![tier],
        ..convert::Transcript::default()
    };

    // The document is the file as ELAN has it: time slots, tier types, ids.
    let document = convert::to_raw(&transcript, &raw::Document::default());
    let mut file = Vec::new();
    raw::write(&document, &mut file)?;
    println!("{}", String::from_utf8_lossy(&file));

    let (again, findings) = read(&file)?;
    assert!(findings.is_empty(), "{findings:?}");
    for (read, written) in again.tiers[0]
        .annotations
        .iter()
        .zip(&transcript.tiers[0].annotations)
    {
        assert_eq!((read.span, &read.value), (written.span, &written.value));
    }
    assert_eq!(again.tiers[0].annotations.len(), 2);
    Ok(())
}
