//! Tests of reading and writing SubRip and WebVTT, and of damaged files.

use super::*;

/// Cues as `voice|start-end|text`, in milliseconds.
fn cues(transcript: &AnnotationTranscript) -> Vec<String> {
    let tiers = transcript.tiers.iter();
    let all = tiers.flat_map(|tier| tier.annotations.iter().map(move |cue| (tier, cue)));
    all.map(|(tier, cue)| {
        format!(
            "{}|{}-{}|{}",
            tier.name,
            cue.span.span_start_instant().instant_millis(),
            cue.span.span_end_instant().instant_millis(),
            cue.value
        )
    })
    .collect()
}

#[test]
fn both_kinds_and_their_dialects_are_read() {
    let cases: [(&str, &[&str]); 7] = [
        (
            "1\n00:00:01,000 --> 00:00:02,500\nHallo\nWelt\n\n2\n00:00:03,000 --> 00:00:04,000\nja\n",
            &["subtitles|1000-2500|Hallo\nWelt", "subtitles|3000-4000|ja"],
        ),
        (
            "\u{feff}1\r\n00:00:01.000 --> 00:00:02.5\r\n<i>Hallo</i> {\\an8}\r\n\r\n",
            &["subtitles|1000-2500|Hallo"],
        ),
        (
            "00:01,000 --> 00:02,000\na\n00:02,000 --> 00:03,000\nb",
            &["subtitles|1000-2000|a", "subtitles|2000-3000|b"],
        ),
        (
            "1\n00:00:01,000 --> 00:00:02,000\na\n2\n00:00:02,000 --> 00:00:03,000\nb",
            &["subtitles|1000-2000|a", "subtitles|2000-3000|b"],
        ),
        (
            "WEBVTT - films\n\nNOTE a\nb\n\nSTYLE\n::cue{}\n\nx1\n00:01.000 --> 00:02.000 align:start\n<v Anna>R&amp;D &lt;3\n\n00:02.000 --> 01:00:03.000\n<v.loud Bo>x</v>\n",
            &["Anna|1000-2000|R&D <3", "Bo|2000-3603000|x"],
        ),
        (
            "WEBVTT\n\n00:00.000 --> 00:02.000\na\n\n00:01.000 --> 00:03.000\nb\n",
            &["subtitles|0-1000|a", "subtitles|1000-3000|b"],
        ),
        (
            "WEBVTT\n\n00:00.000 --> 00:02.000\n5 < 6 {x}\n",
            &["subtitles|0-2000|5 < 6 {x}"],
        ),
    ];
    for (text, expected) in cases {
        let (transcript, _) = read_subtitles(text.as_bytes()).expect("subtitles");
        assert_eq!(cues(&transcript), expected, "{text}");
    }
}

#[test]
fn skipped_lines_are_reported() {
    let text = "WEBVTT\n\nNOTE\nx\n\n00:00.000 --> 00:01.000 line:0\na\n\nsoon --> later\nb\n";
    let (_, findings) = read_subtitles(text.as_bytes()).expect("subtitles");
    let lines: Vec<Option<u64>> = findings.iter().map(|finding| finding.line).collect();
    assert_eq!(lines, [Some(3), Some(6), Some(9)], "{findings:?}");
}

#[test]
fn only_a_header_that_says_something_is_reported() {
    for (header, said) in [
        ("WEBVTT", None),
        ("WEBVTT films", Some("the block \"WEBVTT films\" was left out")),
        (
            "WEBVTT\nKind: captions",
            Some("the block \"WEBVTT Kind: captions\" was left out"),
        ),
    ] {
        let text = format!("{header}\n\n00:00.000 --> 00:01.000\na\n");
        let (_, findings) = read_subtitles(text.as_bytes()).expect("subtitles");
        let messages: Vec<&str> = findings.iter().map(|finding| finding.message.as_str()).collect();
        assert_eq!(messages, said.into_iter().collect::<Vec<_>>(), "{header}");
    }
}

#[test]
fn text_after_a_blank_line_is_added_or_named() {
    type Case<'c> = (&'c str, &'c [&'c str], &'c [Option<u64>]);
    let cases: [Case<'_>; 6] = [
        (
            "1\n00:00:01,000 --> 00:00:02,000\nx\n\n\ny\n\n5\n\n2\n\n00:00:03,000 --> 00:00:04,000\n\nz\n",
            &["subtitles|1000-2000|x\ny\n5", "subtitles|3000-4000|z"],
            &[Some(6), Some(8), Some(14)],
        ),
        (
            "title\n\n1\n00:00:01,000 --> 00:00:02,000\nx\n",
            &["subtitles|1000-2000|x"],
            &[Some(1)],
        ),
        (
            "1\n00:00:01,000 --> 00:00:02,000\nx\n\n2\nsoon --> later\na\n\nb\n",
            &["subtitles|1000-2000|x"],
            &[Some(6), Some(9)],
        ),
        (
            "WEBVTT\n\na name\n00:01.000 --> 00:02.000\nx\n\ny\nz\n",
            &["subtitles|1000-2000|x"],
            &[Some(7), Some(8)],
        ),
        (
            "1\n00:00:01,000 --> 00:00:02,000\nx\n\n2\n",
            &["subtitles|1000-2000|x\n2"],
            &[Some(5)],
        ),
        (
            "1\n00:00:01,000 --> 00:00:02,000\nx\n\n",
            &["subtitles|1000-2000|x"],
            &[],
        ),
    ];
    for (text, expected, lines) in cases {
        let (transcript, findings) = read_subtitles(text.as_bytes()).expect("subtitles");
        assert_eq!(cues(&transcript), expected, "{text}");
        let found: Vec<Option<u64>> = findings.iter().map(|finding| finding.line).collect();
        assert_eq!(found, lines, "{text}{findings:?}");
    }
}

#[test]
fn files_without_a_cue_are_refused() {
    for bytes in [&b""[..], b"WEBVTT\n", b"hello", b"\x00\x01", b"1\n-1:00 --> x\n"] {
        assert!(read_subtitles(bytes).is_err(), "{bytes:?}");
    }
}

#[test]
fn subtitles_read_back_unchanged() {
    let text = "WEBVTT\n\n00:00:01.000 --> 00:00:02.000\n<v Anna>R&amp;D &lt;3\n\n00:00:02.000 --> 01:00:03.000\n<v Bo>x\ny\n\n";
    let (transcript, _) = read_subtitles(text.as_bytes()).expect("subtitles");
    assert_eq!(write_subtitles(&transcript, SubtitleFormat::Vtt), text);
    let srt = "1\n00:00:01,000 --> 00:00:02,500\nHallo\n\n2\n00:00:03,000 --> 00:00:04,000\nja\n\n";
    let (transcript, _) = read_subtitles(srt.as_bytes()).expect("subtitles");
    assert_eq!(write_subtitles(&transcript, SubtitleFormat::Srt), srt);
}

#[test]
fn no_cut_or_changed_byte_breaks_the_reader() {
    let whole = "WEBVTT\n\n00:00:01.000 --> 00:00:02.000\n<v Ännä>é {\\a} <i\n\n1\n00:00:03,000 --> 00:00:04,000\nx\n"
        .as_bytes();
    for end in 0..whole.len() {
        let _ = read_subtitles(&whole[..end]);
        let mut changed = whole.to_vec();
        changed[end] ^= 0x5f;
        let _ = read_subtitles(&changed);
    }
}
