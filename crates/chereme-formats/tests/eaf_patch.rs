//! Changed EAF files keep the layout in which they were found: unchanged parts keep their bytes.

#![allow(clippy::print_stderr, reason = "a test may say that it skips its work")]

use chereme_formats::eaf::eaf_convert::{
    AnnotationAddress, AnnotationTiming, TranscriptAnnotation, TranscriptTier, VocabularyEntry, VocabularyEntryValue,
};
use chereme_formats::eaf::{self, AnnotationTranscript, eaf_raw, patch_eaf, read_eaf, same_meaning};
use chereme_motion::{RecordingInstant, TimeSpan};
use std::path::{Path, PathBuf};

/// As ELAN 2 writes: a line for each tag, `&apos;`, empty values with two tags.
const OLD: &str = include_str!("eaf/elan2.eaf");
/// As ELAN 6 writes: long start tags broken at column 72, empty values as one tag.
const NEW: &str = include_str!("eaf/elan6.eaf");

fn both() -> [(&'static str, &'static str); 2] {
    [("elan2", OLD), ("elan6", NEW)]
}

fn transcript(text: &[u8]) -> AnnotationTranscript {
    read_eaf(text).expect("an EAF file").0
}

fn place(it: &AnnotationTranscript, id: &str) -> AnnotationAddress {
    let mut all = it.tiers.iter().enumerate().flat_map(|(tier, it)| {
        let own = it.annotations.iter().enumerate();
        own.map(move |(index, it)| (it.id.clone(), AnnotationAddress { tier, index }))
    });
    all.find(|(known, _)| known == id).expect("an annotation").1
}

fn annotation<'t>(it: &'t mut AnnotationTranscript, id: &str) -> &'t mut TranscriptAnnotation {
    let place = place(it, id);
    &mut it.tiers[place.tier].annotations[place.index]
}

fn tier<'t>(it: &'t mut AnnotationTranscript, name: &str) -> &'t mut TranscriptTier {
    it.tiers.iter_mut().find(|it| it.name == name).expect("a tier")
}

fn move_to(it: &mut TranscriptAnnotation, start: i64, end: i64) {
    it.span = TimeSpan::span_between(RecordingInstant::from_millis(start), RecordingInstant::from_millis(end));
    it.millis = None;
    it.timing = AnnotationTiming::Own;
}

fn new(id: &str, start: i64, end: i64, value: &str) -> TranscriptAnnotation {
    TranscriptAnnotation {
        id: id.into(),
        span: TimeSpan::span_between(RecordingInstant::from_millis(start), RecordingInstant::from_millis(end)),
        timing: AnnotationTiming::Own,
        parent: None,
        order: 0,
        value: value.into(),
        entry: None,
        language: None,
        external_ref: None,
        millis: None,
    }
}

/// Changes a file; returns the new text.
fn changed(text: &str, change: impl FnOnce(&mut AnnotationTranscript)) -> String {
    let mut after = transcript(text.as_bytes());
    change(&mut after);
    let bytes = patch_eaf(text.as_bytes(), &after)
        .expect("an EAF file")
        .expect("changed in place");
    assert!(same_meaning(&transcript(&bytes), &after));
    String::from_utf8(bytes).expect("UTF-8")
}

/// The lines of `a` that `b` does not have, and those that it has beyond `a`.
fn difference(a: &str, b: &str) -> (Vec<String>, Vec<String>) {
    let beyond = |a: &str, b: &str| {
        let mut known: Vec<&str> = a.split_inclusive('\n').collect();
        let lines = b.split_inclusive('\n').filter(|line| {
            let at = known.iter().position(|it| it == line);
            at.map(|at| known.remove(at)).is_none()
        });
        lines.map(|line| line.trim_end().to_owned()).collect()
    };
    (beyond(b, a), beyond(a, b))
}

#[track_caller]
fn lines(before: &str, after: &str, removed: &[&str], added: &[&str]) {
    let (gone, new) = difference(before, after);
    let trim = |lines: Vec<String>| -> Vec<String> {
        let mut lines: Vec<String> = lines.iter().map(|line| line.trim().to_owned()).collect();
        lines.sort();
        lines
    };
    assert_eq!((trim(gone), trim(new)), (strings(removed), strings(added)), "{after}");
}

fn strings(lines: &[&str]) -> Vec<String> {
    let mut lines: Vec<String> = lines.iter().map(|line| (*line).to_owned()).collect();
    lines.sort();
    lines
}

#[test]
fn an_unchanged_file_is_written_byte_for_byte() {
    for (name, text) in both() {
        for text in [
            text.to_owned(),
            text.replace('\n', "\r\n"),
            format!("\u{feff}{text}"),
            text.trim_end().to_owned(),
            text.replace('\'', "&apos;").replace('"', "'"),
        ] {
            let after = transcript(text.as_bytes());
            let bytes = patch_eaf(text.as_bytes(), &after).expect("read").expect("kept");
            assert!(bytes == text.as_bytes(), "{name}");
        }
    }
}

/// Returns a text in an encoding that its declaration names, with a mark or without.
fn encoded(text: &str, encoding: &str) -> Vec<u8> {
    let name = encoding.trim_end_matches(" marked");
    let text = text.replacen("UTF-8", name, 1);
    let mark = encoding.ends_with(" marked").then_some(0xfeff);
    let units = mark.into_iter().chain(text.encode_utf16());
    match name {
        "UTF-16LE" => units.flat_map(u16::to_le_bytes).collect(),
        "UTF-16" | "UTF-16BE" => units.flat_map(u16::to_be_bytes).collect(),
        _ => text
            .chars()
            .map(|it| u8::try_from(u32::from(it)).expect("Latin-1"))
            .collect(),
    }
}

const ENCODINGS: [&str; 6] = [
    "UTF-16LE marked",
    "UTF-16LE",
    "UTF-16BE",
    "UTF-16 marked",
    "ISO-8859-1",
    "windows-1252",
];

#[test]
fn files_in_other_encodings_keep_their_bytes_and_their_encoding() {
    for (name, text) in both() {
        let text = text.replacen("CHAT", "CH\u{c2}T\u{e9}", 1);
        let text: String = text.chars().filter(|it| u32::from(*it) < 0x100).collect();
        for encoding in ENCODINGS {
            let bytes = encoded(&text, encoding);
            let (before, findings) = read_eaf(&bytes).expect(encoding);
            assert_eq!(before.tiers, transcript(text.as_bytes()).tiers, "{encoding}");
            assert_eq!(findings.len(), 1 + read_eaf(text.as_bytes()).expect("read").1.len());
            let same = patch_eaf(&bytes, &before).expect("read").expect("kept");
            assert!(same == bytes, "{name} {encoding}");
            let mut after = before.clone();
            annotation(&mut after, "a1").value = "\u{ca}TRE \u{2019} \u{20ac} \u{1f91f}".into();
            let changed = patch_eaf(&bytes, &after).expect("read").expect("in place");
            assert!(same_meaning(&transcript(&changed), &after), "{encoding}");
            let decoded = eaf::decode_eaf(&changed).expect("the same encoding").text;
            let (gone, new) = difference(
                &text.replacen("UTF-8", encoding.trim_end_matches(" marked"), 1),
                &decoded,
            );
            assert_eq!((gone.len(), new.len()), (1, 1), "{encoding} {new:?}");
        }
    }
}

#[test]
fn an_encoding_that_a_file_declares_wrongly_is_a_finding() {
    let text = OLD.replacen("CHAT", "CH\u{c2}T", 1);
    for name in ["ISO-8859-1", "UTF-16"] {
        let wrong = text.replacen("UTF-8", name, 1);
        let (it, findings) = read_eaf(wrong.as_bytes()).expect("read");
        assert!(
            findings.iter().any(|it| it.message.contains("in UTF-8")),
            "{findings:?}"
        );
        let same = patch_eaf(wrong.as_bytes(), &it).expect("read").expect("kept");
        assert!(same == wrong.as_bytes());
    }
    let marked = format!("\u{feff}{text}").replacen("UTF-8", "ISO-8859-1", 1);
    assert_eq!(
        read_eaf(marked.as_bytes()).expect("read").0.tiers,
        transcript(text.as_bytes()).tiers
    );
}

#[test]
fn bytes_of_no_encoding_are_refused_in_words() {
    let cut = &encoded(NEW, "UTF-16LE marked")[..301];
    let mut half = encoded(NEW, "UTF-16LE marked");
    half.splice(200..202, [0x00, 0xd8]);
    let mut wide = vec![0xff, 0xfe, 0, 0];
    wide.extend(NEW.chars().flat_map(|it| u32::from(it).to_le_bytes()));
    let latin: Vec<u8> = OLD.replacen("CHAT", "\u{e9}", 1).chars().map(|it| it as u8).collect();
    for bytes in [cut, &half, &wide, &latin] {
        let error = read_eaf(bytes).expect_err("refused");
        assert!(!error.to_string().is_empty());
    }
}

#[test]
fn a_changed_value_changes_its_own_line() {
    for (_, text) in both() {
        let after = changed(text, |it| annotation(it, "a1").value = "L'OISEAU <2>".into());
        let apostrophe = if text == OLD { "&apos;" } else { "'" };
        let line = format!("<ANNOTATION_VALUE>L{apostrophe}OISEAU &lt;2&gt;</ANNOTATION_VALUE>");
        lines(text, &after, &["<ANNOTATION_VALUE>CHAT</ANNOTATION_VALUE>"], &[&line]);
    }
}

#[test]
fn values_are_emptied_and_filled_in_the_style_of_the_file() {
    let empty = |text| changed(text, |it| annotation(it, "a1").value = String::new());
    let fill = |text| changed(text, |it| annotation(it, "a2").value = "B".into());
    let full = "<ANNOTATION_VALUE>CHAT</ANNOTATION_VALUE>";
    let pair = "<ANNOTATION_VALUE></ANNOTATION_VALUE>";
    lines(OLD, &empty(OLD), &[full], &[pair]);
    lines(NEW, &empty(NEW), &[full], &[pair]);
    let b = "<ANNOTATION_VALUE>B</ANNOTATION_VALUE>";
    lines(OLD, &fill(OLD), &[pair], &[b]);
    lines(NEW, &fill(NEW), &["<ANNOTATION_VALUE/>"], &[b]);
}

#[test]
fn line_ends_byte_order_mark_and_quotes_are_kept_when_a_value_changes() {
    for (_, text) in both() {
        let text = format!("\u{feff}{}", text.replace('\n', "\r\n"));
        let after = changed(&text, |it| annotation(it, "a1").value = "NEU".into());
        let value = |text: &str| format!("<ANNOTATION_VALUE>{text}<");
        assert_eq!(after, text.replace(&value("CHAT"), &value("NEU")));
        let single = text.replace('\'', "&apos;").replace('"', "'");
        let after = changed(&single, |it| {
            annotation(it, "a3").value = "x".into();
            annotation(it, "a1").language = Some("deu".into());
        });
        assert!(after.contains("LANG_REF='deu'"), "{after}");
        assert_eq!(after.matches('\n').count(), after.matches("\r\n").count());
    }
}

#[test]
fn a_moved_end_changes_its_slot() {
    for (_, text) in both() {
        let after = changed(text, |it| move_to(annotation(it, "a1"), 100, 720));
        lines(
            text,
            &after,
            &["<TIME_SLOT TIME_SLOT_ID=\"ts2\" TIME_VALUE=\"700\"/>"],
            &["<TIME_SLOT TIME_SLOT_ID=\"ts2\" TIME_VALUE=\"720\"/>"],
        );
    }
}

#[test]
fn a_slot_that_passes_its_neighbour_moves_its_line() {
    let after = changed(NEW, |it| move_to(annotation(it, "a1"), 2600, 2700));
    let slots: Vec<&str> = after.lines().filter(|line| line.contains("<TIME_SLOT ")).collect();
    let values: Vec<i64> = slots
        .iter()
        .filter_map(|line| line.split("TIME_VALUE=\"").nth(1)?.split('"').next()?.parse().ok())
        .collect();
    assert!(values.is_sorted(), "{slots:?}");
    let (gone, new) = difference(NEW, &after);
    assert_eq!((gone.len(), new.len()), (2, 2));
}

#[test]
fn a_shared_slot_is_parted_only_if_one_of_its_ends_moves() {
    // a5 and a6 meet at ts7: both move, then one.
    let shared = changed(NEW, |it| {
        move_to(annotation(it, "a5"), 1000, 1600);
        move_to(annotation(it, "a6"), 1600, 2000);
    });
    let (gone, new) = difference(NEW, &shared);
    assert_eq!((gone.len(), new.len()), (1, 1), "{new:?}");
    let parted = changed(NEW, |it| move_to(annotation(it, "a5"), 1000, 1400));
    let (gone, new) = difference(NEW, &parted);
    assert_eq!((gone.len(), new.len()), (1, 2), "{new:?}");
}

#[test]
fn a_removed_annotation_removes_its_lines_and_time_slots() {
    let after = changed(OLD, |it| drop(tier(it, "Gloss").annotations.pop()));
    lines(
        OLD,
        &after,
        &[
            "<TIME_SLOT TIME_SLOT_ID=\"ts3\" TIME_VALUE=\"800\"/>",
            "<TIME_SLOT TIME_SLOT_ID=\"ts4\" TIME_VALUE=\"900\"/>",
            "<ANNOTATION>",
            "<ALIGNABLE_ANNOTATION ANNOTATION_ID=\"a2\" TIME_SLOT_REF1=\"ts3\" TIME_SLOT_REF2=\"ts4\">",
            "<ANNOTATION_VALUE></ANNOTATION_VALUE>",
            "</ALIGNABLE_ANNOTATION>",
            "</ANNOTATION>",
        ],
        &[],
    );
    assert!(after.contains("<!-- checked by two people -->"));
}

#[test]
fn an_added_annotation_adds_lines_in_the_style_of_the_file() {
    let add = |text| {
        changed(text, |it| {
            let annotations = &mut tier(it, "Gloss").annotations;
            annotations.insert(1, new("a20", 720, 790, "UND"));
        })
    };
    let slots = [
        "<TIME_SLOT TIME_SLOT_ID=\"ts9\" TIME_VALUE=\"720\"/>",
        "<TIME_SLOT TIME_SLOT_ID=\"ts10\" TIME_VALUE=\"790\"/>",
    ];
    let value = "<ANNOTATION_VALUE>UND</ANNOTATION_VALUE>";
    let tags = ["<ANNOTATION>", "</ALIGNABLE_ANNOTATION>", "</ANNOTATION>"];
    let one = "<ALIGNABLE_ANNOTATION ANNOTATION_ID=\"a20\" TIME_SLOT_REF1=\"ts9\" TIME_SLOT_REF2=\"ts10\">";
    lines(
        OLD,
        &add(OLD),
        &[],
        &[slots[0], slots[1], tags[0], one, value, tags[1], tags[2]],
    );
    let counter = |n| format!("<PROPERTY NAME=\"lastUsedAnnotationId\">{n}</PROPERTY>");
    let first = "<ALIGNABLE_ANNOTATION ANNOTATION_ID=\"a20\"";
    let second = "TIME_SLOT_REF1=\"ts9\" TIME_SLOT_REF2=\"ts10\">";
    lines(
        NEW,
        &add(NEW),
        &[&counter(7)],
        &[
            &counter(20),
            slots[0],
            slots[1],
            tags[0],
            first,
            second,
            value,
            tags[1],
            tags[2],
        ],
    );
}

#[test]
fn a_divided_annotation_shares_slots_with_its_neighbour_and_its_parent() {
    let after = changed(NEW, |it| {
        move_to(annotation(it, "a6"), 1500, 1750);
        let parent = place(it, "a4");
        let piece = TranscriptAnnotation {
            parent: Some(parent),
            ..new("a8", 1750, 2000, "c")
        };
        tier(it, "Phases").annotations.push(piece);
    });
    let line = |start: &str| {
        let mut lines = after.lines().skip_while(|line| !line.contains(start));
        format!(
            "{} {}",
            lines.next().unwrap_or_default(),
            lines.next().unwrap_or_default()
        )
    };
    assert!(line("\"a6\"").contains("TIME_SLOT_REF2=\"ts9\""), "{after}");
    assert!(
        line("\"a8\"").contains("TIME_SLOT_REF1=\"ts9\" TIME_SLOT_REF2=\"ts8\""),
        "{after}"
    );
}

#[test]
fn only_pieces_of_a_division_share_the_slots_of_their_parent() {
    let included = NEW.replacen("Time_Subdivision", "Included_In", 1);
    for (text, slot) in [(NEW, "ts6"), (&included, "ts7")] {
        let after = changed(text, |it| {
            tier(it, "Phases").annotations.remove(0);
            move_to(annotation(it, "a6"), 1000, 2000);
        });
        let mut lines = after.lines().skip_while(|line| !line.contains("\"a6\""));
        let slots = lines.nth(1).unwrap_or_default();
        let wanted = format!("TIME_SLOT_REF1=\"{slot}\" TIME_SLOT_REF2=\"ts8\"");
        assert!(slots.contains(&wanted), "{after}");
        let moved = after.contains("TIME_SLOT_ID=\"ts7\" TIME_VALUE=\"1000\"");
        assert_eq!(moved, slot == "ts7", "{after}");
    }
}

#[test]
fn a_chain_is_relinked_around_a_removed_annotation() {
    let after = changed(OLD, |it| {
        let all = &mut tier(it, "Parts").annotations;
        all.remove(0);
        all[0].order = 0;
    });
    assert!(
        after.contains("<REF_ANNOTATION ANNOTATION_ID=\"a4\" ANNOTATION_REF=\"a1\">"),
        "{after}"
    );
}

#[test]
fn tiers_are_renamed_added_and_removed_in_place() {
    let renamed = changed(OLD, |it| tier(it, "Gloss").name = "Glosse".into());
    let (gone, new) = difference(OLD, &renamed);
    assert_eq!((gone.len(), new.len()), (2, 2), "the tier and its child: {new:?}");
    let added = changed(NEW, |it| {
        it.tiers.push(TranscriptTier {
            name: "Notes".into(),
            kind: "notes".into(),
            annotations: vec![self::new("a30", 0, 90, "first")],
            ..TranscriptTier::default()
        });
    });
    let (gone, new) = difference(NEW, &added);
    assert_eq!(gone.len(), 1, "the number of the last annotation");
    assert!(new.iter().any(|line| line.contains("TIER_ID=\"Notes\"")), "{new:?}");
    assert!(
        new.iter().any(|line| line.contains("LINGUISTIC_TYPE_ID=\"notes\"")),
        "{new:?}"
    );
    let removed = changed(OLD, |it| {
        it.tiers.retain(|tier| tier.name != "Parts");
    });
    let (gone, new) = difference(OLD, &removed);
    assert!(
        new.is_empty() && gone.iter().all(|line| !line.contains("TIME_SLOT")),
        "{gone:?}"
    );
}

#[test]
fn a_vocabulary_gets_entries_and_the_header_properties() {
    let after = changed(NEW, |it| {
        let entry = VocabularyEntry {
            id: "cveid1".into(),
            values: vec![VocabularyEntryValue {
                language: "und".into(),
                value: "CHIEN".into(),
                description: None,
            }],
            external_ref: None,
        };
        it.vocabularies[0].entries.push(entry);
        it.properties.push(("chereme.signer".into(), "Anna".into()));
    });
    lines(
        NEW,
        &after,
        &[],
        &[
            "<PROPERTY NAME=\"chereme.signer\">Anna</PROPERTY>",
            "<CV_ENTRY_ML CVE_ID=\"cveid1\">",
            "<CVE_VALUE LANG_REF=\"und\">CHIEN</CVE_VALUE>",
            "</CV_ENTRY_ML>",
        ],
    );
}

#[test]
fn a_file_without_line_ends_gets_none() {
    let flat: String = NEW.lines().map(str::trim_start).collect::<Vec<_>>().join(" ");
    let flat = flat.replace("> <", "><");
    let after = changed(&flat, |it| {
        annotation(it, "a1").value = "NEU".into();
        tier(it, "Gloss").annotations.push(new("a9", 3000, 3100, "x"));
        tier(it, "Phases").annotations.clear();
    });
    assert!(!after.contains('\n'));
}

#[test]
fn changes_that_cannot_be_made_in_place_are_refused() {
    let mut after = transcript(NEW.as_bytes());
    after.tiers.reverse();
    for tier in &mut after.tiers {
        tier.parent = None;
        tier.stereotype = None;
    }
    assert_eq!(patch_eaf(NEW.as_bytes(), &after), Ok(None));
    assert!(patch_eaf(b"no file", &after).is_err());
}

#[test]
fn new_files_break_start_tags_as_elan_6_does() {
    let (document, _) = eaf_raw::read_eaf_document(NEW.as_bytes()).expect("read");
    let mut out = Vec::new();
    eaf_raw::write_eaf_document(&document, &mut out).expect("written");
    let text = String::from_utf8(out).expect("UTF-8");
    assert_eq!(text, NEW.replace("    <!-- checked by two people -->\n", ""));
}

fn shared_files() -> Vec<PathBuf> {
    let Some(folder) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("skipped: CHEREME_SHARED_DATA names no folder");
        return Vec::new();
    };
    let mut found = Vec::new();
    let mut folders = vec![Path::new(&folder).join("annotation/eaf")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|it| it == "eaf") {
                found.push(path);
            }
        }
    }
    assert!(found.len() > 8, "{found:?}");
    found
}

#[test]
fn shared_files_change_only_in_the_lines_that_were_edited() {
    for path in shared_files() {
        let bytes = std::fs::read(&path).expect("a file");
        let text = std::str::from_utf8(&bytes).expect("UTF-8");
        let before = transcript(&bytes);
        assert!(
            patch_eaf(&bytes, &before) == Ok(Some(bytes.clone())),
            "{}",
            path.display()
        );
        let filled = before.tiers.iter().flat_map(|it| &it.annotations);
        let mut filled = filled.filter(|it| !it.value.is_empty() && !it.value.contains('\n'));
        if let Some(id) = filled.next().map(|it| it.id.clone()) {
            let after = changed(text, |it| annotation(it, &id).value = "another".into());
            let (gone, new) = difference(text, &after);
            assert_eq!((gone.len(), new.len()), (1, 1), "{} {gone:?} {new:?}", path.display());
        }
        let roots = before.tiers.iter().enumerate();
        let mut roots = roots.filter(|(at, it)| {
            it.parent.is_none()
                && !it.annotations.is_empty()
                && before.tiers.iter().all(|below| below.parent != Some(*at))
        });
        if let Some((at, _)) = roots.next() {
            let after = changed(text, |it| drop(it.tiers[at].annotations.pop()));
            let (gone, new) = difference(text, &after);
            assert!(new.is_empty() && gone.len() <= 9, "{} {gone:?} {new:?}", path.display());
        }
        let _: Result<_, eaf::EafError> = patch_eaf(&bytes, &AnnotationTranscript::default());
    }
}

#[test]
fn a_value_outside_an_old_vocabulary_adds_a_line_to_it() {
    let old = OLD.replace(
        "</ANNOTATION_DOCUMENT>",
        "    <CONTROLLED_VOCABULARY CV_ID=\"POS\" DESCRIPTION=\"Part of Speech\">\n\
         \x20       <CV_ENTRY DESCRIPTION=\"noun\">n</CV_ENTRY>\n\
         \x20   </CONTROLLED_VOCABULARY>\n</ANNOTATION_DOCUMENT>",
    );
    let add = |it: &mut AnnotationTranscript, id: &str| {
        let mut entry = it.vocabularies[0].entries[0].clone();
        entry.id = id.to_owned();
        entry.values[0].value = "v & w".into();
        entry.values[0].description = None;
        it.vocabularies[0].entries.push(entry);
        annotation(it, "a1").value = "v & w".into();
    };
    let after = changed(&old, |it| add(it, ""));
    lines(
        &old,
        &after,
        &["<ANNOTATION_VALUE>CHAT</ANNOTATION_VALUE>"],
        &[
            "<ANNOTATION_VALUE>v &amp; w</ANNOTATION_VALUE>",
            "<CV_ENTRY>v &amp; w</CV_ENTRY>",
        ],
    );
    let after = changed(&old, |it| add(it, "cve7"));
    assert!(after.contains("<CV_ENTRY ID=\"cve7\">"), "{after}");
    let mut gone = transcript(old.as_bytes());
    gone.vocabularies[0].entries.clear();
    assert_eq!(patch_eaf(old.as_bytes(), &gone), Ok(None), "more than lines");
}
