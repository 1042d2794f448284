//! EAF files: values read, findings, refusals, and round trips.

use chereme_formats::eaf::eaf_raw::{self, AnnotationAnchor, EafDocument};
use chereme_formats::eaf::{
    AnnotationTranscript, EafError, eaf_document_from_transcript, read_eaf, transcript_from_eaf,
};
use std::path::{Path, PathBuf};

const HEAD: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<ANNOTATION_DOCUMENT AUTHOR=\"\" DATE=\"2024-01-01T00:00:00Z\" FORMAT=\"3.0\" VERSION=\"3.0\">\n";

/// A document of slots (`id=ms` or `id`), tiers and more.
fn eaf(slots: &str, rest: &str) -> String {
    let mut text = format!("{HEAD}<HEADER MEDIA_FILE=\"\" TIME_UNITS=\"milliseconds\"/>\n<TIME_ORDER>\n");
    for slot in slots.split_whitespace() {
        let (id, value) = slot.split_once('=').unwrap_or((slot, ""));
        let value = if value.is_empty() {
            String::new()
        } else {
            format!(" TIME_VALUE=\"{value}\"")
        };
        text += &format!("<TIME_SLOT TIME_SLOT_ID=\"{id}\"{value}/>\n");
    }
    text + "</TIME_ORDER>\n" + rest + TYPES + "</ANNOTATION_DOCUMENT>\n"
}

const TYPES: &str = r#"<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID="root" TIME_ALIGNABLE="true"/>
<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID="time" CONSTRAINTS="Time_Subdivision" TIME_ALIGNABLE="true"/>
<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID="in" CONSTRAINTS="Included_In" TIME_ALIGNABLE="true"/>
<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID="sub" CONSTRAINTS="Symbolic_Subdivision" TIME_ALIGNABLE="false"/>
<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID="one" CONSTRAINTS="Symbolic_Association" TIME_ALIGNABLE="false"/>
"#;

/// A tier of annotations written `id:slot-slot=value` or `id:^parent<previous=value`.
fn tier(head: &str, annotations: &str) -> String {
    let mut words = head.split(' ');
    let (name, kind) = (words.next().unwrap_or_default(), words.next().unwrap_or_default());
    let parent = words
        .next()
        .map(|it| format!(" PARENT_REF=\"{it}\""))
        .unwrap_or_default();
    let mut text = format!("<TIER TIER_ID=\"{name}\" LINGUISTIC_TYPE_REF=\"{kind}\"{parent}>\n");
    for annotation in annotations.split_whitespace() {
        let (id, rest) = annotation.split_once(':').expect("id:");
        let (place, value) = rest.split_once('=').unwrap_or((rest, ""));
        let (name, attributes) = match place.strip_prefix('^') {
            Some(place) => {
                let (parent, previous) = place.split_once('<').map_or((place, None), |(a, b)| (a, Some(b)));
                let previous = previous
                    .map(|it| format!(" PREVIOUS_ANNOTATION=\"{it}\""))
                    .unwrap_or_default();
                ("REF_ANNOTATION", format!("ANNOTATION_REF=\"{parent}\"{previous}"))
            }
            None => {
                let (start, end) = place.split_once('-').expect("two slots");
                (
                    "ALIGNABLE_ANNOTATION",
                    format!("TIME_SLOT_REF1=\"{start}\" TIME_SLOT_REF2=\"{end}\""),
                )
            }
        };
        text += &format!(
            "<ANNOTATION><{name} ANNOTATION_ID=\"{id}\" {attributes}><ANNOTATION_VALUE>{value}</ANNOTATION_VALUE></{name}></ANNOTATION>\n"
        );
    }
    text + "</TIER>\n"
}

/// The tiers as lines: `name: id start-end value, …`.
fn shown(transcript: &AnnotationTranscript) -> String {
    let mut text = String::new();
    for tier in &transcript.tiers {
        text += &format!("{}:", tier.name);
        for it in &tier.annotations {
            let (from, to) = (
                it.span.span_start_instant().instant_micros() as f64 / 1e3,
                it.span.span_end_instant().instant_micros() as f64 / 1e3,
            );
            let above = it.parent.and_then(|place| transcript.annotation_at(place));
            let above = above.map(|it| format!("^{}", it.id)).unwrap_or_default();
            text += &format!(" {}{above} {from}-{to} {}", it.id, it.value);
        }
        text += "\n";
    }
    text
}

fn written(document: &EafDocument<'_>) -> String {
    let mut out = Vec::new();
    eaf_raw::write_eaf_document(document, &mut out).expect("a vector takes everything");
    String::from_utf8(out).expect("UTF-8")
}

fn check(text: &str, expected: &str, findings: &[&str]) {
    check_reading(text, expected, findings);
    comes_back(text.as_bytes());
}

fn check_reading(text: &str, expected: &str, findings: &[&str]) {
    let (document, mut found) = eaf_raw::read_eaf_document(text.as_bytes()).expect("a document");
    let (transcript, more) = transcript_from_eaf(&document);
    found.extend(more);
    assert_eq!(shown(&transcript), expected);
    let found: Vec<&str> = found.iter().map(|it| &*it.message).collect();
    assert_eq!(found.len(), findings.len(), "{found:#?}");
    for (found, expected) in found.iter().zip(findings) {
        assert!(found.contains(expected), "{found:?} does not say {expected:?}");
    }
}

/// Checks that a document stays the same through reading, writing and reading, and through its meaning and back.
fn comes_back(bytes: &[u8]) {
    let (document, _) = eaf_raw::read_eaf_document(bytes).expect("a document");
    let text = written(&document);
    let (again, findings) = eaf_raw::read_eaf_document(text.as_bytes()).expect("what was written is read");
    assert_eq!(again, eaf_raw::upgrade_eaf_document(document.clone()));
    assert_eq!(written(&again), text, "writing is a fixpoint");
    let loud =
        |it: &&chereme_formats::ImportFinding| !it.message.contains("kept aside") && !it.message.contains("is not a");
    assert_eq!(findings.iter().find(loud), None);
    let (meant, _) = transcript_from_eaf(&document);
    let back = eaf_document_from_transcript(&meant, &document);
    let text = written(&back);
    let (back, _) = eaf_raw::read_eaf_document(text.as_bytes()).expect("what was written is read");
    let (mut again, findings) = transcript_from_eaf(&back);
    assert!(
        !findings.iter().any(|it| it.message.contains("not in the file")),
        "{findings:?}"
    );
    let (mut meant, counter) = (meant, "lastUsedAnnotationId");
    for transcript in [&mut meant, &mut again] {
        transcript.properties.retain(|(name, _)| name != counter);
        for cv in &mut transcript.vocabularies {
            cv.descriptions
                .iter_mut()
                .filter(|it| it.0.is_empty())
                .for_each(|it| it.0 = "und".into());
            for (n, entry) in cv.entries.iter_mut().enumerate() {
                entry
                    .values
                    .iter_mut()
                    .filter(|it| it.language.is_empty())
                    .for_each(|it| it.language = "und".into());
                if entry.id.is_empty() {
                    entry.id = format!("cveid{n}")
                }
            }
        }
    }
    assert_eq!(meant.tiers, again.tiers);
    assert_eq!(meant, again);
}

#[test]
fn shared_unaligned_and_equal_time_slots_are_read() {
    check(
        &eaf(
            "ts1=0 ts2 ts3 ts4=90 ts5=90 ts6=100",
            &(tier("p root", "a1:ts1-ts4=x a2:ts5-ts6") + &tier("c time p", "a3:ts1-ts2=i a4:ts2-ts3=j a5:ts3-ts4=k")),
        ),
        "p: a1 0-90 x a2 90-100 \nc: a3^a1 0-30 i a4^a1 30-60 j a5^a1 60-90 k\n",
        &[],
    );
}

#[test]
fn shared_time_slots_stay_shared_when_written() {
    let text = eaf(
        "ts1=0 ts2=40 ts4=90",
        &(tier("p root", "a1:ts1-ts4=x") + &tier("c time p", "a3:ts1-ts2=i a4:ts2-ts4=j")),
    );
    let (document, _) = eaf_raw::read_eaf_document(text.as_bytes()).expect("a document");
    let back = eaf_document_from_transcript(&transcript_from_eaf(&document).0, &document);
    assert_eq!(back.time_order.len(), 3);
    assert_eq!(
        back.tiers[1].annotations[0].anchor,
        AnnotationAnchor::Slots {
            start: "ts1".into(),
            end: "ts2".into()
        }
    );
}

#[test]
fn four_stereotypes_are_read_three_levels_deep() {
    check(
        &eaf(
            "ts1=0 ts2=100 ts3=10 ts4=60",
            &(tier("one one sub", "a9:^a6=N")
                + &tier("sub sub in", "a6:^a5<a8=second a8:^a5=first")
                + &tier("in in p", "a5:ts3-ts4=e")
                + &tier("p root", "a1:ts1-ts2=x")),
        ),
        "one: a9^a6 35-60 N\nsub: a6^a5 35-60 second a8^a5 10-35 first\nin: a5^a1 10-60 e\np: a1 0-100 x\n",
        &[],
    );
}

#[test]
fn dangling_references_are_reported() {
    check(
        &eaf(
            "ts1=0 ts2=100",
            &(tier("p root", "a1:ts1-ts9=x a2:ts1-ts2=y")
                + &tier("c one p", "a3:^a7=z a4:^a1 a5:^a2=kept")
                + &tier("q nokind nowhere", "")),
        ),
        "p: a2 0-100 y\nc: a5^a2 0-100 kept\nq:\n",
        &[
            "the tier \"q\" has the type \"nokind\", which is not in the file",
            "the tier \"q\" hangs below \"nowhere\", which is not in the file",
            "annotation \"a1\" refers to the time slot \"ts9\"",
            "annotation \"a3\" refers to the annotation above, \"a7\"",
            "annotation \"a1\" has no place in time",
            "annotation \"a3\" has no place in time",
            "annotation \"a4\" has no place in time",
        ],
    );
}

#[test]
fn duplicate_tiers_and_ids_are_renamed_and_reported() {
    check(
        &eaf(
            "ts1=0 ts2=100 ts1=7",
            &(tier("p root", "a1:ts1-ts2=x") + &tier("p root", "a1:ts1-ts2=y") + &tier("p root", "")),
        ),
        "p: a1 0-100 x\np 2: a2 0-100 y\np 3:\n",
        &[
            "the tier \"p\" is there twice",
            "the tier \"p\" is there twice",
            "time slot id \"ts1\" is given twice",
            "annotation id \"a1\" is empty or given twice",
        ],
    );
}

#[test]
fn cyclic_references_are_cut() {
    check_reading(
        &eaf(
            "ts1=0 ts2=100",
            &(tier("p in q", "a1:ts1-ts2=x")
                + &tier("q in p", "")
                + &tier("s sub p", "a2:^a1<a3=x a3:^a1<a2=y a4:^a4")),
        ),
        "p: a1 0-100 x\nq:\ns: a2^a1 0-50 x a3^a1 50-100 y\n",
        &[
            "the tier \"q\" hangs below itself",
            "the tier \"q\" has no parent",
            "annotation \"a1\" does not lie within",
            "annotation \"a4\" has no place",
            "are not one chain",
        ],
    );
}

#[test]
fn odd_times_are_corrected_and_reported() {
    check_reading(
        &eaf(
            "ts1=100 ts2=0 ts3=50 ts4=x ts5=60 ts6=70 ts7",
            &tier(
                "p root",
                "a1:ts1-ts2=back a2:ts3-ts3=point a3:ts4-ts5=open a4:ts6-ts7=end",
            ),
        ),
        "p: a1 0-100 back a2 50-50 point a3 55-60 open a4 70-70 end\n",
        &[
            "TIME_VALUE=\"x\" of <TIME_SLOT> is not a whole number within",
            "ends before it starts",
            "\"a2\" has no length",
            "\"a4\" has no length",
            "overlap",
        ],
    );
}

#[test]
fn times_that_no_clock_can_hold_are_left_out_and_reported() {
    let last = i64::MAX / 40_000;
    for (time, fits) in [
        (last.to_string(), true),
        ((last + 1).to_string(), false),
        (i64::MAX.to_string(), false),
        ("99999999999999999999999".to_owned(), false),
        ((-last).to_string(), true),
        ((-last - 1).to_string(), false),
        (i64::MIN.to_string(), false),
    ] {
        for units in ["milliseconds", "PAL-frames", "NTSC-frames"] {
            let slots = format!("ts1=0 ts2={time}");
            let text = eaf(&slots, &tier("p root", "a1:ts1-ts2=x"));
            let text = text.replace("\"milliseconds\"", &format!("\"{units}\""));
            let (document, mut findings) = eaf_raw::read_eaf_document(text.as_bytes()).expect("a document");
            let (transcript, more) = transcript_from_eaf(&document);
            findings.extend(more);
            let want = format!(
                "TIME_VALUE=\"{time}\" of <TIME_SLOT> is not a whole number within the range of times; it was left out"
            );
            let finding = findings.iter().find(|it| it.message == want);
            assert_eq!(finding.is_none(), fits, "{time} {units}: {findings:?}");
            if let Some(finding) = finding {
                assert_eq!(finding.line, Some(6), "{time} {units}");
            }
            let ends = [i64::MIN, i64::MAX];
            for it in transcript.tiers.iter().flat_map(|tier| &tier.annotations) {
                let span = [
                    it.span.span_start_instant().instant_micros(),
                    it.span.span_end_instant().instant_micros(),
                ];
                assert!(span.iter().all(|at| !ends.contains(at)), "{time} {units}: {span:?}");
            }
        }
    }
}

#[test]
fn a_subdivision_with_a_gap_is_reported() {
    let above = tier("top root", "a1:ts1-ts4=x");
    for (divided, reported) in [
        ("a2:ts1-ts2=p a3:ts2-ts4=q", false),
        ("a2:ts1-ts2=p a3:ts3-ts4=q", true),
        ("a2:ts2-ts4=p", true),
        ("a2:ts1-ts3=p", true),
    ] {
        let text = eaf(
            "ts1=0 ts2=100 ts3=200 ts4=300",
            &(above.clone() + &tier("below time top", divided)),
        );
        let (document, _) = eaf_raw::read_eaf_document(text.as_bytes()).expect("a document");
        let (_, findings) = transcript_from_eaf(&document);
        let gap = |it: &chereme_formats::ImportFinding| it.message.contains("part of annotation \"a1\"");
        assert_eq!(findings.iter().any(gap), reported, "{divided}: {findings:?}");
    }
}

#[test]
fn frames_become_milliseconds() {
    let pal = eaf("ts1=1 ts2=25", &tier("p root", "a1:ts1-ts2=x")).replace("\"milliseconds\"", "\"PAL-frames\"");
    check(&pal, "p: a1 40-1000 x\n", &["the times are in PAL-frames"]);
    let ntsc = pal.replace("PAL", "NTSC");
    assert_eq!(
        shown(&read_eaf(ntsc.as_bytes()).expect("a document").0),
        "p: a1 33.366-834.166 x\n"
    );
}

#[test]
fn values_keep_breaks_entities_and_blanks() {
    let text = eaf("ts1=0 ts2=9", &tier("p&amp;é&#x3e; root", "a1:ts1-ts2=@"))
        .replace('@', "  a\r\nb &lt;i&gt; &quot;&apos;&amp;&#233;<![CDATA[<&>]]> ");
    check(&text, "p&é>: a1 0-9   a\nb <i> \"'&é<&> \n", &[]);
    let text = eaf("ts1=0 ts2=9", &tier("p root", "a1:ts1-ts2=@")).replace('@', "R&D &nbsp; &#0; &");
    check(
        &text,
        "p: a1 0-9 R&D &nbsp; &#0; &\n",
        &["& is unknown", "&nbsp; is unknown", "&#0; is unknown", "& is unknown"],
    );
    let text = eaf("ts1=0 ts2=9", &tier("p root", "")).replace("AUTHOR=\"\"", "AUTHOR='a \"b\"\n&#10;&amp; c & d'");
    let (document, _) = eaf_raw::read_eaf_document(text.as_bytes()).expect("a document");
    assert_eq!(document.author, "a \"b\" \n& c & d");
    comes_back(text.as_bytes());
}

#[test]
fn every_element_of_the_schema_and_unknown_ones_are_kept() {
    let more = r#"<LOCALE COUNTRY_CODE="US" LANGUAGE_CODE="en" VARIANT="v"/>
<LANGUAGE LANG_ID="fra" LANG_LABEL="French"/>
<CONTROLLED_VOCABULARY CV_ID="v8"><DESCRIPTION LANG_REF="fra">d</DESCRIPTION>
<CV_ENTRY_ML CVE_ID="c1" EXT_REF="er1"><CVE_VALUE LANG_REF="fra" DESCRIPTION="x">oui</CVE_VALUE><CVE_VALUE LANG_REF="eng">yes</CVE_VALUE></CV_ENTRY_ML>
<EXTERNAL_REF EXT_REF_ID="er1" TYPE="resource_url" VALUE="https://example.org/1"/></CONTROLLED_VOCABULARY>
<CONTROLLED_VOCABULARY CV_ID="v7" DESCRIPTION="old"><CV_ENTRY DESCRIPTION="noun" ID="cveid0">n</CV_ENTRY><CV_ENTRY>v</CV_ENTRY></CONTROLLED_VOCABULARY>
<CONTROLLED_VOCABULARY CV_ID="far" EXT_REF="er9"/>
<LEXICON_REF LEX_REF_ID="lr1" NAME="n" TYPE="t" URL="u" LEXICON_ID="1" LEXICON_NAME="l" DATCAT_ID="d"/>
<REF_LINK_SET LINKS_ID="rl" LINK_SET_NAME="set"><CROSS_REF_LINK REF_LINK_ID="l1" REF1="a1" REF2="a2" DIRECTIONALITY="undirected">text</CROSS_REF_LINK>
<GROUP_REF_LINK REF_LINK_ID="l2" REFS="l1 a1" REF_TYPE="x"/></REF_LINK_SET>
<EXTERNAL_REF EXT_REF_ID="er9" TYPE="ecv" VALUE="file:/c.ecv"/>
<LICENSE LICENSE_URL="u">words</LICENSE>
<EXTRA own="1"><a>b &amp; c</a></EXTRA>
"#;
    let text = eaf("ts1=0 ts2=9", &(tier("p root", "a1:ts1-ts2=x").replace("ANNOTATION_ID=\"a1\"", "ANNOTATION_ID=\"a1\" LANG_REF=\"fra\" SVG_REF=\"s\" EXT_REF=\"er1 er9\" CVE_REF=\"c1\" colour=\"red\"") + more))
        .replace("<HEADER MEDIA_FILE=\"\" TIME_UNITS=\"milliseconds\"/>", r#"<HEADER TIME_UNITS="milliseconds"><MEDIA_DESCRIPTOR MEDIA_URL="file:///C:/v.mp4" MIME_TYPE="video/mp4" TIME_ORIGIN="1200" EXTRACTED_FROM="e"/>
        <MEDIA_DESCRIPTOR MEDIA_URL="file:C:\v.mp4" MIME_TYPE="video/mp4"/><LINKED_FILE_DESCRIPTOR LINK_URL="l" MIME_TYPE="m" ASSOCIATED_WITH="x"/><PROPERTY NAME="URN">urn:x</PROPERTY><PROPERTY NAME="lastUsedAnnotation">4</PROPERTY></HEADER>"#);
    let (document, findings) = eaf_raw::read_eaf_document(text.as_bytes()).expect("a document");
    assert_eq!(findings.len(), 2, "{findings:?}");
    let annotation = &document.tiers[0].annotations[0];
    assert_eq!(
        (annotation.language.as_deref(), annotation.svg.as_deref()),
        (Some("fra"), Some("s"))
    );
    assert_eq!(annotation.external_ref.as_deref(), Some("er1 er9"));
    assert_eq!(document.vocabularies[0].external_refs[0].kind, "resource_url");
    assert_eq!(document.ref_link_sets[0].id, "rl");
    let (transcript, _) = transcript_from_eaf(&document);
    assert_eq!(transcript.media[0].time_origin, Some(1200));
    assert_eq!(transcript.vocabularies[2].external.as_deref(), Some("file:/c.ecv"));
    let out = written(&document);
    for part in [
        "<EXTRA own=\"1\"><a>b &amp; c</a></EXTRA>",
        "colour=\"red\"",
        "<CV_ENTRY_ML CVE_ID=\"cveid1\">",
        "LANG_ID=\"und\"",
        "LINK_SET_ID=\"rl\"",
        "<CVE_VALUE LANG_REF=\"eng\">yes</CVE_VALUE>",
    ] {
        assert!(out.contains(part), "{part} is not in {out}");
    }
    assert_eq!(out.matches("<CONSTRAINT").count(), 4);
    assert!(!out.contains(" />"));
    comes_back(text.as_bytes());
}

#[test]
fn many_tiers_and_long_names_are_read() {
    let tiers: String = (0..150)
        .map(|n| tier(&format!("{}{n} root", "长".repeat(300)), &format!("a{n}:ts1-ts2=v")))
        .collect();
    comes_back(eaf("ts1=0 ts2=10", &tiers).as_bytes());
}

#[test]
fn the_last_used_id_is_updated_as_the_last_property() {
    let text = eaf("ts1=0 ts2=10", &tier("p root", "a41:ts1-ts2=v")).replace(
        "<HEADER MEDIA_FILE=\"\" TIME_UNITS=\"milliseconds\"/>",
        "<HEADER><PROPERTY NAME=\"lastUsedAnnotationId\">7</PROPERTY><PROPERTY NAME=\"URN\">u</PROPERTY></HEADER>",
    );
    let (document, _) = eaf_raw::read_eaf_document(text.as_bytes()).expect("a document");
    let back = eaf_document_from_transcript(&transcript_from_eaf(&document).0, &document);
    let properties: Vec<(&str, &str)> = back
        .header
        .properties
        .iter()
        .map(|it| (it.name.as_deref().unwrap_or(""), &*it.value))
        .collect();
    assert_eq!(properties, [("URN", "u"), ("lastUsedAnnotationId", "41")]);
}

#[test]
fn an_annotation_keeps_its_milliseconds_until_it_is_moved() {
    let text = eaf("ts1=33 ts2=67", &tier("p root", "a1:ts1-ts2=v"));
    let (document, _) = eaf_raw::read_eaf_document(text.as_bytes()).expect("a document");
    let (mut transcript, _) = transcript_from_eaf(&document);
    let snapped = chereme_motion::TimeSpan::span_between(
        chereme_motion::RecordingInstant::from_micros(33_900),
        chereme_motion::RecordingInstant::from_micros(66_666),
    );
    transcript.tiers[0].annotations[0].span = snapped;
    let values = |transcript: &AnnotationTranscript| {
        eaf_document_from_transcript(transcript, &document)
            .time_order
            .iter()
            .map(|slot| slot.value)
            .collect::<Vec<_>>()
    };
    assert_eq!(values(&transcript), [Some(33), Some(67)]);
    transcript.tiers[0].annotations[0].millis = None;
    assert_eq!(values(&transcript), [Some(34), Some(67)]);
}

#[test]
fn external_vocabularies_are_read() {
    let text = "\u{feff}<CV_RESOURCE AUTHOR=\"\" DATE=\"\" VERSION=\"0.2\"><LANGUAGE LANG_ID=\"eng\"/><CONTROLLED_VOCABULARY CV_ID=\"v\"><CV_ENTRY_ML CVE_ID=\"1\"><CVE_VALUE LANG_REF=\"eng\">B</CVE_VALUE></CV_ENTRY_ML></CONTROLLED_VOCABULARY></CV_RESOURCE>";
    let (document, findings) = eaf_raw::read_ecv(text.as_bytes()).expect("a vocabulary");
    assert_eq!(
        (
            document.vocabularies[0].entries[0].values[0].value.as_ref(),
            findings.len()
        ),
        ("B", 0)
    );
    assert!(matches!(
        eaf_raw::read_eaf_document(text.as_bytes()),
        Err(EafError::Root { line: 1, .. })
    ));
}

#[test]
fn files_that_are_no_eaf_are_refused_with_the_line() {
    let laughs = "<?xml version=\"1.0\"?>\n<!DOCTYPE lolz [<!ENTITY lol \"lol\"><!ENTITY lol2 \"&lol;&lol;&lol;\">]>\n<ANNOTATION_DOCUMENT>&lol2;</ANNOTATION_DOCUMENT>";
    let many: String = (0..1_000_000).map(|n| format!(" a{n}=\"\"")).collect();
    let utf16: Vec<u8> = [0xff, 0xfe]
        .into_iter()
        .chain(HEAD.encode_utf16().flat_map(u16::to_le_bytes))
        .collect();
    let cases: [(&str, Vec<u8>, &str); 16] = [
        ("empty", b"".into(), "line 1: this is not XML"),
        ("blank", b"  \n ".into(), "line 2: this is not XML"),
        ("text", b"ANNOTATION".into(), "line 1: this is not XML"),
        ("binary", b"\x00\x01\x02\xff\xfe<".into(), "line 1: this is not XML"),
        (
            "control",
            b"<ANNOTATION_DOCUMENT>\n\x01</ANNOTATION_DOCUMENT>".into(),
            "line 2: this is not XML",
        ),
        (
            "root",
            b"\n<html></html>".into(),
            "line 2: the root element is <html>; it should be <ANNOTATION_DOCUMENT>",
        ),
        ("laughs", laughs.into(), "line 2: a <!DOCTYPE"),
        (
            "nested",
            (HEAD.to_owned() + &"<a>".repeat(1_000_000)).into(),
            "line 3: elements are nested too deep, more than 64",
        ),
        (
            "attributes",
            format!("<ANNOTATION_DOCUMENT{many}/>").into(),
            "line 1: the element has too many attributes, more than 64",
        ),
        ("utf-16", utf16, "line 1: the text is in UTF-16"),
        (
            "declared",
            b"<?xml version=\"1.0\" encoding=\"Shift_JIS\"?><ANNOTATION_DOCUMENT/>".into(),
            "line 1: the text is in Shift_JIS",
        ),
        (
            "latin-1",
            b"<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>\n<ANNOTATION_DOCUMENT AUTHOR=\"\xe9\"/>".into(),
            "line 2: the text is in ISO-8859-1",
        ),
        ("cut", HEAD.into(), "line 3: the file ends inside <ANNOTATION_DOCUMENT>"),
        (
            "crossed",
            (HEAD.to_owned() + "<HEADER>\n</TIER>").into(),
            "line 4: </TIER> closes <HEADER>",
        ),
        (
            "attribute",
            (HEAD.to_owned() + "\n<TIER TIER_ID></TIER>").into(),
            "line 4: <TIER> has a broken attribute",
        ),
        (
            "unquoted",
            (HEAD.to_owned() + "\n<TIER TIER_ID=x></TIER>").into(),
            "line 4: <TIER> has a broken attribute",
        ),
    ];
    for (name, bytes, expected) in cases {
        let error = eaf_raw::read_eaf_document(&bytes).expect_err(name).to_string();
        assert!(error.starts_with(expected), "{name}: {error}");
    }
}

#[test]
fn findings_of_a_kind_are_counted_not_piled_up() {
    let text = eaf(
        "ts1=0 ts2=10",
        &("<!-- -->\n<x/>".repeat(50_000) + &tier("p root", "a1:ts1-ts2=v")),
    );
    let (_, findings) = eaf_raw::read_eaf_document(text.as_bytes()).expect("a document");
    assert_eq!(findings.len(), 42);
    assert_eq!(findings[41].message, "49980 more: elements beyond the schema");
}

/// A small document that has a bit of everything.
fn small() -> String {
    eaf(
        "ts1=0 ts2 ts3=90",
        &(tier("p&amp;q root", "a1:ts1-ts3=x&lt;é")
            + &tier("c time p&amp;q", "a2:ts1-ts2=i a3:ts2-ts3")
            + &tier("s sub c", "a4:^a2=b a5:^a2<a4")),
    )
}

#[test]
fn truncation_anywhere_is_an_error_or_a_document() {
    let text = small();
    let end = text.trim_end().len();
    for length in 0..end {
        let result = read_eaf(&text.as_bytes()[..length]);
        assert!(
            result.is_err(),
            "{length} of {end} bytes were taken for a whole document"
        );
    }
    comes_back(text.as_bytes());
}

#[test]
fn flipped_bytes_do_no_harm() {
    let text = small();
    let mut seed = 0x9e37_79b9_7f4a_7c15_u64;
    let mut next = || {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        seed
    };
    for _ in 0..1500 {
        let mut bytes = text.clone().into_bytes();
        for _ in 0..=next() % 4 {
            let at = next() as usize % bytes.len();
            bytes[at] = match next() % 3 {
                0 => b"<>&\"'=/ \n"[next() as usize % 9],
                1 => bytes[next() as usize % bytes.len()],
                _ => next() as u8,
            };
        }
        if let Ok((document, _)) = eaf_raw::read_eaf_document(&bytes) {
            let (transcript, _) = transcript_from_eaf(&document);
            let out = written(&eaf_document_from_transcript(&transcript, &document));
            assert!(eaf_raw::read_eaf_document(out.as_bytes()).is_ok());
            let again = written(&document);
            assert_eq!(
                eaf_raw::read_eaf_document(again.as_bytes())
                    .expect("what was written")
                    .0,
                eaf_raw::upgrade_eaf_document(document)
            );
        }
    }
}

fn files(folder: &Path, extension: &str, found: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> = std::fs::read_dir(folder)
        .expect("a folder")
        .flatten()
        .map(|it| it.path())
        .collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            files(&path, extension, found);
        } else if path.extension().is_some_and(|it| it == extension) {
            found.push(path);
        }
    }
}

#[test]
fn shared_files_read_back_unchanged() {
    let Some(data) = std::env::var_os("CHEREME_SHARED_DATA").map(PathBuf::from) else {
        eprintln!("CHEREME_SHARED_DATA is not set: the files of others were not tried");
        return;
    };
    let mut found = Vec::new();
    files(&data.join("annotation/eaf"), "eaf", &mut found);
    for path in &found {
        let bytes = std::fs::read(path).expect("a file");
        let (transcript, findings) = read_eaf(&bytes).expect("a document");
        let count: usize = transcript.tiers.iter().map(|tier| tier.annotations.len()).sum();
        eprintln!(
            "{}: {} tiers, {count} annotations, {} findings",
            path.display(),
            transcript.tiers.len(),
            findings.len()
        );
        for finding in &findings {
            eprintln!("    {:?} {}", finding.line, finding.message);
        }
        comes_back(&bytes);
    }
    assert!(found.len() >= 9);
    found.clear();
    files(&data.join("annotation/eaf"), "ecv", &mut found);
    for path in &found {
        assert!(eaf_raw::read_ecv(&std::fs::read(path).expect("a file")).is_ok_and(|it| it.1.is_empty()));
    }
}
