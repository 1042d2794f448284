//! Tests of reading and writing TextGrid in all forms and encodings, and of damaged files.

use super::*;

const LONG: &str = include_str!("long.TextGrid");

const SHORT: &str = "File type = \"ooTextFile\"\r\n\"TextGrid\"\r\n\r\n0\r\n2.5\r\n<exists>\r\n2 ! two tiers\r\n\
\"IntervalTier\"\r\n\"phones\"\r\n0\r\n2.5\r\n3\r\n0\r\n1\r\n\"\"\r\n1\r\n1.25\r\n\"say \"\"a\"\"\r\nnow\"\r\n1.25\r\n2.5\r\n\"ə\"\r\n\
\"TextTier\"\r\n\"clicks\"\r\n0\r\n2.5\r\n1\r\n0.5\r\n\"x\"\r\n";

/// The long form in UTF-16, with its mark or without.
fn utf16(big: bool, mark: bool) -> Vec<u8> {
    let units = mark.then_some(0xfeff).into_iter().chain(LONG.encode_utf16());
    let bytes = units.flat_map(|unit| if big { unit.to_be_bytes() } else { unit.to_le_bytes() });
    bytes.collect()
}

fn binary_form() -> Vec<u8> {
    let mut bytes = b"ooBinaryFile\x08TextGrid".to_vec();
    let label = |bytes: &mut Vec<u8>, text: &str| {
        if text.is_ascii() {
            bytes.extend((text.len() as i16).to_be_bytes());
            bytes.extend(text.bytes());
        } else {
            bytes.extend((-1i16).to_be_bytes());
            bytes.extend((text.encode_utf16().count() as u16).to_be_bytes());
            bytes.extend(text.encode_utf16().flat_map(u16::to_be_bytes));
        }
    };
    let numbers = |bytes: &mut Vec<u8>, values: &[f64]| {
        bytes.extend(values.iter().flat_map(|value| value.to_be_bytes()));
    };
    numbers(&mut bytes, &[0.0, 2.5]);
    bytes.push(1);
    bytes.extend(2i32.to_be_bytes());
    bytes.extend(b"\x0cIntervalTier");
    label(&mut bytes, "phones");
    numbers(&mut bytes, &[0.0, 2.5]);
    bytes.extend(3i32.to_be_bytes());
    for (start, end, text) in [(0.0, 1.0, ""), (1.0, 1.25, "say \"a\"\nnow"), (1.25, 2.5, "ə")] {
        numbers(&mut bytes, &[start, end]);
        label(&mut bytes, text);
    }
    bytes.extend(b"\x08TextTier");
    label(&mut bytes, "clicks");
    numbers(&mut bytes, &[0.0, 2.5]);
    bytes.extend(1i32.to_be_bytes());
    numbers(&mut bytes, &[0.5]);
    label(&mut bytes, "x");
    bytes
}

/// Tiers and annotations as lines of text.
fn plain(transcript: &AnnotationTranscript) -> String {
    let mut out = String::new();
    for tier in &transcript.tiers {
        let _ = writeln!(out, "{} {}", tier.kind, tier.name);
        for annotation in &tier.annotations {
            let span = annotation.span;
            let _ = writeln!(
                out,
                "  {} {} {:?}",
                span.span_start_instant().instant_micros(),
                span.span_end_instant().instant_micros(),
                annotation.value
            );
        }
    }
    out
}

const EXPECTED: &str = "IntervalTier phones\n  1000000 1250000 \"say \\\"a\\\"\\nnow\"\n  1250000 2500000 \"ə\"\n\
TextTier clicks\n  500000 540000 \"x\"\n";

#[test]
fn all_forms_and_encodings_read_to_equal_data() {
    let cases = [
        LONG.as_bytes().to_vec(),
        SHORT.as_bytes().to_vec(),
        [b"\xef\xbb\xbf", LONG.as_bytes()].concat(),
        utf16(true, true),
        utf16(false, true),
        utf16(true, false),
        utf16(false, false),
        binary_form(),
    ];
    for (at, bytes) in cases.iter().enumerate() {
        let (transcript, _) = read_textgrid_file(bytes).unwrap_or_else(|error| panic!("case {at}: {error}"));
        assert_eq!(plain(&transcript), EXPECTED, "case {at}");
    }
}

#[test]
fn a_text_grid_reads_back_unchanged() {
    let (transcript, _) = read_textgrid_file(LONG.as_bytes()).expect("a TextGrid");
    let (long, findings) = write_textgrid(&transcript, TextGridForm::Long, RecordingInstant::from_millis(2500));
    assert_eq!(findings, []);
    assert_eq!(long, LONG);
    let (short, _) = write_textgrid(&transcript, TextGridForm::Short, RecordingInstant::from_millis(2500));
    let (again, _) = read_textgrid_file(short.as_bytes()).expect("a TextGrid");
    assert_eq!(plain(&again), EXPECTED);
}

#[test]
fn tiers_without_a_name_of_their_own_get_one() {
    let tier = "\"IntervalTier\"\n\"%\"\n0\n1\n1\n0\n1\n\"x\"\n";
    let text = format!(
        "\"ooTextFile\"\n\"TextGrid\"\n-0\n1\n<exists>\n3\n{}{}{}",
        tier.replace('%', "a"),
        tier.replace('%', "a"),
        tier.replace('%', "")
    );
    let (transcript, findings) = read_textgrid_file(text.as_bytes()).expect("a TextGrid");
    let names: Vec<&str> = transcript.tiers.iter().map(|tier| tier.name.as_str()).collect();
    assert_eq!(names, ["a", "a (2)", "tier 3"]);
    assert_eq!(findings.len(), 2);
}

#[test]
fn intervals_that_overlap_or_have_no_time_are_reported() {
    let text = "\"ooTextFile\" \"TextGrid\" 0 9 <exists> 1 \"IntervalTier\" \"a\" 0 9 3 0 2 \"x\" 1 3 \"y\" 5 4 \"z\"";
    let (transcript, findings) = read_textgrid_file(text.as_bytes()).expect("a TextGrid");
    assert_eq!(
        plain(&transcript),
        "IntervalTier a\n  0 1000000 \"x\"\n  1000000 3000000 \"y\"\n"
    );
    let messages: Vec<&str> = findings.iter().map(|finding| finding.message.as_str()).collect();
    assert!(
        messages[0].contains("\"z\" on \"a\" lasts from 5 to 4 s"),
        "{messages:?}"
    );
    assert!(messages[1].contains("\"x\" on \"a\" ends after"), "{messages:?}");
}

#[test]
fn annotations_that_a_text_grid_cuts_or_leaves_out_are_reported() {
    let tier = |annotations: &[(i64, i64, &str)]| {
        let annotation = |&(start, end, value): &(i64, i64, &str)| TranscriptAnnotation {
            id: format!("a{start}"),
            span: TimeSpan::span_between(
                RecordingInstant::from_millis(start * 1000),
                RecordingInstant::from_millis(end * 1000),
            ),
            timing: AnnotationTiming::Own,
            parent: None,
            order: 0,
            value: value.to_owned(),
            entry: None,
            language: None,
            external_ref: None,
            millis: None,
        };
        TranscriptTier {
            name: "T".to_owned(),
            annotations: annotations.iter().map(annotation).collect(),
            ..TranscriptTier::default()
        }
    };
    let empty =
        "annotations without text are not in the TextGrid, where an empty interval is a gap; an .eaf keeps them";
    let cut = "\"B\" at 1.000s on \"T\" overlaps others; in the TextGrid it starts at 2.000s";
    let gone = "\"C\" at 1.000s on \"T\" overlaps others; a TextGrid has no room for it";
    for (annotations, written, said) in [
        (&[(0, 2, "A"), (2, 3, "B")][..], &["0-2 A", "2-3 B"][..], vec![]),
        (
            &[(0, 2, "A"), (1, 3, "B"), (1, 2, "C")],
            &["0-2 A", "2-3 B"],
            vec![cut.to_owned(), gone.to_owned()],
        ),
        (
            &[(0, 1, ""), (1, 2, "A"), (2, 3, "")],
            &["1-2 A"],
            vec![format!("{empty}: 2")],
        ),
        // An empty annotation takes no room from others.
        (&[(0, 2, ""), (1, 3, "B")], &["1-3 B"], vec![format!("{empty}: 1")]),
    ] {
        let transcript = AnnotationTranscript {
            tiers: vec![tier(annotations)],
            ..AnnotationTranscript::default()
        };
        let (text, findings) = write_textgrid(&transcript, TextGridForm::Long, RecordingInstant::from_millis(3000));
        let (again, _) = read_textgrid_file(text.as_bytes()).expect("a TextGrid");
        let spans = again.tiers[0].annotations.iter().map(|it| {
            let [start, end] =
                [it.span.span_start_instant(), it.span.span_end_instant()].map(|at| at.instant_millis() / 1000);
            format!("{start}-{end} {}", it.value)
        });
        assert_eq!(spans.collect::<Vec<_>>(), written);
        let messages: Vec<String> = findings.into_iter().map(|it| it.message).collect();
        assert_eq!(messages, said);
    }
}

#[test]
fn damaged_files_are_refused_with_the_place() {
    let cases: [(&[u8], &str); 8] = [
        (b"", "does not begin"),
        (b"hello", "does not begin"),
        (b"\"ooTextFile\" \"Pitch 1\"", "holds a \"Pitch 1\""),
        (b"\"ooTextFile\"\n\"TextGrid\"\n0", "line 3: the end"),
        (b"\"ooTextFile\" \"TextGrid\" 0 1 <exists> 1e300", "the number of tiers"),
        (b"\"ooTextFile\" \"TextGrid\" 0 1 <exists> 1 \"X\"", "IntervalTier"),
        (b"\x01\x02", "not text"),
        (b"ooBinaryFile\x08TextGrid\0\0", "the beginning"),
    ];
    for (bytes, expected) in cases {
        let error = read_textgrid_file(bytes).expect_err("no TextGrid").to_string();
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn no_cut_or_changed_byte_breaks_the_reader() {
    for whole in [LONG.as_bytes().to_vec(), binary_form()] {
        for end in 0..whole.len() {
            let _ = read_textgrid_file(&whole[..end]);
            let mut changed = whole.clone();
            changed[end] ^= 0xff;
            let _ = read_textgrid_file(&changed);
        }
    }
}

#[test]
fn grids_of_others_are_read_whole() {
    let Some(folder) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("skipped: CHEREME_SHARED_DATA names no folder");
        return;
    };
    let folder = std::path::Path::new(&folder).join("annotation/textgrid");
    let mut files = Vec::new();
    let mut folders = vec![folder];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "TextGrid") {
                files.push(path);
            }
        }
    }
    assert!(files.len() >= 16, "{} files", files.len());
    let counts = [
        ("mary.TextGrid", vec![16, 6, 4]),
        ("bobby_words_with_newlines.TextGrid", vec![6, 3, 4]),
        ("damon_set_test.TextGrid", vec![18, 8, 7, 7, 6, 5]),
        ("textgrid_to_merge.TextGrid", vec![8, 7, 7]),
    ];
    for path in files {
        let bytes = std::fs::read(&path).expect("a file");
        let (grid, _) = textgrid_raw::read_raw_textgrid(&bytes).unwrap_or_else(|error| panic!("{path:?}: {error}"));
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if let Some((_, expected)) = counts.iter().find(|(file, _)| *file == name) {
            let found: Vec<usize> = grid.tiers.iter().map(|tier| tier.items.len()).collect();
            assert_eq!(&found, expected, "{name}");
        }
        let (transcript, _) = read_textgrid_file(&bytes).expect("a TextGrid");
        let (text, _) = write_textgrid(&transcript, TextGridForm::Long, transcript.transcript_end());
        let (again, _) = read_textgrid_file(text.as_bytes()).expect("what was written");
        assert_eq!(plain(&again), plain(&transcript), "{name}");
    }
}

#[test]
fn golden_textgrids_read_and_written() {
    use crate::golden::{compare, put};
    use crate::tests::{findings, transcript};
    let mut out = String::new();
    let files = [
        ("long", LONG.as_bytes().to_vec()),
        ("short", SHORT.as_bytes().to_vec()),
        ("binary", binary_form()),
        ("UTF-16", utf16(true, true)),
        ("overlap", LONG.replace("xmax = 1.25", "xmax = 1.5").into_bytes()),
        ("backwards", LONG.replace("xmin = 1.25", "xmin = 9").into_bytes()),
        ("another count", LONG.replace("size = 2", "size = 3").into_bytes()),
        ("broken off", LONG.as_bytes()[..LONG.len() / 2].to_vec()),
        ("none", b"text".to_vec()),
    ];
    for (name, bytes) in &files {
        put(&mut out, format!("## {name}"));
        match read_textgrid_file(bytes) {
            Ok((it, found)) => {
                transcript(&mut out, &it);
                findings(&mut out, &found);
                for form in [TextGridForm::Long, TextGridForm::Short] {
                    for end in [RecordingInstant::RECORDING_START, RecordingInstant::from_millis(4000)] {
                        let (text, found) = write_textgrid(&it, form, end);
                        put(&mut out, text);
                        findings(&mut out, &found);
                    }
                }
            }
            Err(error) => put(&mut out, format!("refused: {error}")),
        }
    }
    compare("textgrid", &out);
}
