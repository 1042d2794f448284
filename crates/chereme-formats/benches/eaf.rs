//! Reading EAF beside quick-xml's own event loop on the same text.
//!
//! The text is like a coded recording: a gloss tier and four component tiers for each hand, about
//! 2,000 annotations.

use chereme_formats::eaf;
use divan::counter::BytesCount;
use quick_xml::events::Event;
use std::fmt::Write;

fn main() {
    divan::main();
}

/// A small deterministic stream of numbers (xorshift64).
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, limit: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0 % limit
    }
}

const HEAD: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<ANNOTATION_DOCUMENT AUTHOR="gen" DATE="2024-01-01T00:00:00+00:00" FORMAT="3.0" VERSION="3.0" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="http://www.mpi.nl/tools/elan/EAFv3.0.xsd">
    <HEADER MEDIA_FILE="" TIME_UNITS="milliseconds">
        <PROPERTY NAME="lastUsedAnnotationId">0</PROPERTY>
    </HEADER>
    <TIME_ORDER>
"#;

fn sample(signs: u64) -> String {
    let mut numbers = Numbers(7);
    let (mut slots, mut tiers, mut count) = (String::new(), String::new(), 0u64);
    for tier in [
        "Gloss",
        "RH_config",
        "RH_placement",
        "RH_movement",
        "RH_orientation",
        "LH_config",
        "LH_placement",
        "LH_movement",
        "LH_orientation",
    ] {
        let _ = writeln!(
            tiers,
            "    <TIER LINGUISTIC_TYPE_REF=\"default-lt\" TIER_ID=\"{tier}\">"
        );
        let mut time = numbers.below(500);
        for _ in 0..signs {
            if tier.starts_with("LH") && numbers.below(100) < 35 {
                time += 700;
                continue;
            }
            let pieces = if tier != "Gloss" && numbers.below(100) < 35 {
                2
            } else {
                1
            };
            for _ in 0..pieces {
                let end = time + 100 + numbers.below(500);
                count += 1;
                let (first, second) = (count * 2 - 1, count * 2);
                let _ = writeln!(
                    slots,
                    "        <TIME_SLOT TIME_SLOT_ID=\"ts{first}\" TIME_VALUE=\"{time}\"/>\n        <TIME_SLOT TIME_SLOT_ID=\"ts{second}\" TIME_VALUE=\"{end}\"/>"
                );
                let _ = writeln!(
                    tiers,
                    "        <ANNOTATION>\n            <ALIGNABLE_ANNOTATION ANNOTATION_ID=\"a{count}\" TIME_SLOT_REF1=\"ts{first}\" TIME_SLOT_REF2=\"ts{second}\">\n                <ANNOTATION_VALUE>value{:02}</ANNOTATION_VALUE>\n            </ALIGNABLE_ANNOTATION>\n        </ANNOTATION>",
                    numbers.below(40)
                );
                time = end;
            }
            time += numbers.below(300);
        }
        tiers.push_str("    </TIER>\n");
    }
    format!(
        "{HEAD}{slots}    </TIME_ORDER>\n{tiers}    <LINGUISTIC_TYPE GRAPHIC_REFERENCES=\"false\" LINGUISTIC_TYPE_ID=\"default-lt\" TIME_ALIGNABLE=\"true\"/>\n</ANNOTATION_DOCUMENT>\n"
    )
}

const SIGNS: u64 = 205;

#[divan::bench]
fn quick_xml_events_and_attributes(bencher: divan::Bencher) {
    let text = sample(SIGNS);
    bencher.counter(BytesCount::of_str(&text)).bench(|| {
        let mut reader = quick_xml::Reader::from_str(&text);
        let mut length = 0;
        loop {
            match reader.read_event().expect("well-formed") {
                Event::Start(tag) | Event::Empty(tag) => {
                    length += tag
                        .attributes()
                        .map(|it| it.expect("well-formed").value.len())
                        .sum::<usize>();
                }
                Event::Text(text) => length += text.len(),
                Event::Eof => break length,
                _ => {}
            }
        }
    });
}

#[divan::bench]
fn quick_xml_events_only(bencher: divan::Bencher) {
    let text = sample(SIGNS);
    bencher.counter(BytesCount::of_str(&text)).bench(|| {
        let mut reader = quick_xml::Reader::from_str(&text);
        let mut count = 0;
        loop {
            match reader.read_event().expect("well-formed") {
                Event::Eof => break count,
                _ => count += 1,
            }
        }
    });
}

#[divan::bench]
fn raw_read(bencher: divan::Bencher) {
    let text = sample(SIGNS);
    bencher
        .counter(BytesCount::of_str(&text))
        .bench(|| eaf::eaf_raw::read_eaf_document(text.as_bytes()).expect("a document"));
}

#[divan::bench]
fn read_for_meaning(bencher: divan::Bencher) {
    let text = sample(SIGNS);
    bencher
        .counter(BytesCount::of_str(&text))
        .bench(|| eaf::read_eaf(text.as_bytes()).expect("a document"));
}

#[divan::bench]
fn meaning_alone(bencher: divan::Bencher) {
    let text = sample(SIGNS);
    let (document, _) = eaf::eaf_raw::read_eaf_document(text.as_bytes()).expect("a document");
    bencher
        .counter(BytesCount::of_str(&text))
        .bench(|| eaf::transcript_from_eaf(&document));
}

#[divan::bench]
fn write(bencher: divan::Bencher) {
    let text = sample(SIGNS);
    let (document, _) = eaf::eaf_raw::read_eaf_document(text.as_bytes()).expect("a document");
    bencher.counter(BytesCount::of_str(&text)).bench(|| {
        let mut out = Vec::with_capacity(text.len());
        eaf::eaf_raw::write_eaf_document(&document, &mut out).expect("a vector takes everything");
        out
    });
}
