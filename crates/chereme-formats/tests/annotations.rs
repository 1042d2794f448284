//! Tables of changes to annotations.

use chereme_formats::eaf::AnnotationTranscript;
use chereme_formats::eaf::eaf_convert::{AnnotationTiming, TranscriptAnnotation, TranscriptTier};
use chereme_formats::table::TableError;
use chereme_formats::table::annotations::{
    TableMoment, TableTimeUnit, is_export, read_change_table, read_elan_table, write_elan_table,
};
use chereme_formats::table::tab_rows;
use chereme_motion::{RecordingInstant, TimeSpan};
use proptest::prelude::*;

/// Reads a table and shows each row or fault as a line.
fn shown(text: &str) -> String {
    let (table, _) = read_change_table(text.as_bytes(), None).expect("a table");
    let time = |moment: Option<TableMoment>| match moment {
        None => "-".to_owned(),
        Some(TableMoment::Frame(frame)) => format!("f{frame}"),
        Some(TableMoment::Time(time)) => time.instant_micros().to_string(),
    };
    let text = |text: &Option<String>| text.as_deref().unwrap_or("-").to_owned();
    let rows = table.rows.iter().map(|row| {
        let [recording, tier, value, id, parent] =
            [&row.recording, &row.tier, &row.value, &row.id, &row.parent].map(text);
        format!(
            "{}: {:?} {recording}|{tier} {}..{} {value} {id} {parent}\n",
            row.line,
            row.action,
            time(row.start),
            time(row.end)
        )
    });
    let faults = table.faults.iter().map(|fault| format!("{fault}\n"));
    rows.chain(faults).collect()
}

#[test]
fn rows_are_read_in_every_form() {
    let text = "\u{feff}Recording;Tier;Start;End;Value;Action;ID;Parent\r\n\
        R1;Gloss RH;0.5;1.2s;CHAT;;;\r\n\
        R1;Gloss RH;1500ms;0:02.25;\"a;\"\"b\"\"\";ADD;;\r\n\
        R1;config;f12;f144;B;add;;\r\n\
        \r\n\
        ;;;;neu;set;a7;\r\n\
        R1;Gloss RH;1:02:03.5;;;remove;;\r\n\
        R1;sub;;;x;;;a3\r\n";
    assert_eq!(
        shown(text),
        "2: Add R1|Gloss RH 500000..1200000 CHAT - -\n\
         3: Add R1|Gloss RH 1500000..2250000 a;\"b\" - -\n\
         4: Add R1|config f12..f144 B - -\n\
         6: Set -|- -..- neu a7 -\n\
         7: Remove R1|Gloss RH 3723500000..- - - -\n\
         8: Add R1|sub -..- x - a3\n"
    );
}

#[test]
fn faults_name_line_and_column() {
    let text = "tier,start,end,value,action\n\
        ,1,2,a,\n\
        t,,2,a,\n\
        t,1,,a,\n\
        t,2,1,a,\n\
        t,f2,f2,a,\n\
        t,\"1,5\",2,a,\n\
        t,1:75,2,a,\n\
        t,x,2,a,\n\
        t,1,2,a,rmove\n\
        t,,,a,remove\n\
        t,99999999999999,2,a,\n";
    assert_eq!(
        shown(text),
        "line 2, tier: an added annotation needs a tier\n\
         line 3, start: an added annotation needs a start, or a parent on a symbolic tier\n\
         line 4, end: an added annotation needs an end\n\
         line 5, end: the end 1.000s is not after the start 2.000s\n\
         line 6, end: the end f2 is not after the start f2\n\
         line 7, start: \"1,5\" is no time: write 1.5, 1.5s, 1500ms, 0:01.500 or f12; write a point before the decimals\n\
         line 8, start: \"1:75\" is no time: write 1.5, 1.5s, 1500ms, 0:01.500 or f12\n\
         line 9, start: \"x\" is no time: write 1.5, 1.5s, 1500ms, 0:01.500 or f12\n\
         line 10, action: \"rmove\" is no action: add, remove or set; did you mean \"remove\"?\n\
         line 11, id: name the annotation by its id, or by its tier and start\n\
         line 12, start: \"99999999999999\" is no time: write 1.5, 1.5s, 1500ms, 0:01.500 or f12\n"
    );
}

#[test]
fn a_duration_beyond_the_range_of_times_is_a_fault() {
    let text = "tier,start,duration,value\n\
        t,2562047788:00:00,999999999999,a\n\
        t,f18446744073709551615,f1,a\n\
        t,f18446744073709551614,f1,a\n";
    assert_eq!(
        shown(text),
        "4: Add -|t f18446744073709551614..f18446744073709551615 a - -\n\
         line 2, end: the duration 999999999999.000s from 9223372036800.000s is too long\n\
         line 3, end: the duration f1 from f18446744073709551615 is too long\n"
    );
}

#[test]
fn text_that_is_no_table_is_refused() {
    assert_eq!(read_change_table(b"", None), Err(TableError::Empty));
    assert_eq!(read_change_table(b"\n \n", None), Err(TableError::Empty));
    assert_eq!(
        read_change_table(b"tier\n\0", None),
        Err(TableError::NotText { line: 2 })
    );
    assert!(matches!(
        read_change_table(b"start,end\n1,2\n", None),
        Err(TableError::Missing {
            needed: "tier or id",
            ..
        })
    ));
    let wide = ",".repeat(5000) + "tier";
    assert!(matches!(
        read_change_table(wide.as_bytes(), None),
        Err(TableError::Columns { found: 5001, .. })
    ));
}

#[test]
fn odd_columns_are_reported() {
    let (_, findings) = read_change_table(b"teir,tier,tier\nx,y,z\n", None).expect("a table");
    let messages: Vec<&str> = findings.iter().map(|it| &*it.message).collect();
    assert_eq!(
        messages,
        [
            "the column \"tier\" is there twice; the first counts",
            "the column \"teir\" is not used; did you mean \"tier\"?"
        ]
    );
}

/// Returns the annotations that a table adds: tier, start and end in milliseconds, value.
fn added(text: &str, unit: Option<TableTimeUnit>) -> Vec<(String, i64, i64, String)> {
    let (table, _) = read_change_table(text.as_bytes(), unit).expect(text);
    assert_eq!(table.faults, [], "{text}");
    let millis = |moment: Option<TableMoment>| match moment {
        Some(TableMoment::Time(time)) => time.instant_micros() / 1000,
        Some(TableMoment::Frame(frame)) => -i64::try_from(frame).expect("few"),
        None => i64::MIN,
    };
    let row = |row: chereme_formats::table::annotations::ChangeRow| {
        let (tier, value) = (row.tier.expect("a tier"), row.value.unwrap_or_default());
        (tier, millis(row.start), millis(row.end), value)
    };
    table.rows.into_iter().map(row).collect()
}

#[test]
fn units_are_read_from_titles_or_given_with_the_table() {
    let want = [("A".to_owned(), 35_100, 35_200, "x".to_owned())];
    for text in [
        "tier,start_ms,end_ms,value\nA,35100,35200,x\n",
        "tier,start (ms),end [ms],value\nA,35100,35200,x\n",
        "tier,Start in ms,duration_ms,value\nA,35100,100,x\n",
        "tier,start [s],end [s],value\nA,35.1,35.2,x\n",
        "tier,start_ms,end_ms,value\nA,35.1s,0:35.2,x\n",
        "tier,start,end,value\nA,35100ms,35200ms,x\n",
    ] {
        assert_eq!(added(text, None), want, "{text}");
    }
    let bare = "tier,start,end,value\nA,35100,35200,x\n";
    assert_eq!(added(bare, Some(TableTimeUnit::Milliseconds)), want);
    assert_eq!(added(bare, Some(TableTimeUnit::Seconds))[0].1, 35_100_000);
    assert_eq!(added(bare, Some(TableTimeUnit::Frames))[0].1, -35_100);
    assert_eq!(added("tier,start_frame,end_frame\nA,12,24\n", None)[0].2, -24);
}

#[test]
fn whole_numbers_too_long_for_seconds_are_refused_and_others_are_not() {
    for (rows, refused) in [
        ("A,35100,35200,x\n", true),
        ("A,100,900,x\nA,1000,1900,y\n", true),
        ("A,0,1,x\nA,20000,20001,y\n", true),
        ("A,1,2,x\nA,3,40,y\n", false),
        ("A,100,161,x\nA,161.5,170,y\n", false),
        ("A,100s,900s,x\n", false),
        ("A,,,x\n", false),
    ] {
        let text = format!("tier,start,end,value\n{rows}");
        let read = read_change_table(text.as_bytes(), None);
        let implausible =
            matches!(&read, Err(error @ TableError::Implausible { .. }) if error.to_string().contains("start_ms"));
        assert_eq!(implausible, refused, "{rows}: {read:?}");
    }
}

#[test]
fn elan_exports_are_read() {
    let want = [
        ("Gloss".to_owned(), 1_040, 2_330, "HAUS".to_owned()),
        ("Gloss".to_owned(), 3_200, 5_050, "5".to_owned()),
    ];
    let titles = "Tier\tParticipant\tBegin Time - hh:mm:ss.ms\tBegin Time - ss.msec\tBegin Time - msec\t\
                  End Time - hh:mm:ss.ms\tEnd Time - ss.msec\tEnd Time - msec\tDuration - hh:mm:ss.ms\t\
                  Duration - ss.msec\tDuration - msec\tAnnotation\n";
    let rows = "Gloss\tP1\t00:00:01.040\t1.040\t1040\t00:00:02.330\t2.330\t2330\t00:00:01.290\t1.290\t1290\tHAUS\n\
                Gloss\tP1\t00:00:03.200\t3.200\t3200\t00:00:05.050\t5.050\t5050\t00:00:01.850\t1.850\t1850\t5\n";
    let part = |columns: &[usize]| -> String {
        let line = |line: &str| {
            let cells: Vec<&str> = line.split('\t').collect();
            let kept: Vec<&str> = columns.iter().map(|&at| cells[at]).collect();
            kept.join("\t") + "\n"
        };
        rows.lines().map(line).collect()
    };
    let all = [
        format!("{titles}{rows}"),
        rows.to_owned(),
        part(&[0, 1, 2, 5, 8, 11]),
        part(&[0, 1, 3, 6, 9, 11]),
        part(&[0, 4, 7, 11]),
        part(&[0, 4, 10, 11]),
        part(&[0, 2, 5, 11]),
        "Begin Time - msec\tEnd Time - msec\tGloss\tMouthing\n1040\t2330\tHAUS\t\n3200\t5050\t5\t\n".to_owned(),
    ];
    for text in all {
        assert_eq!(added(&text, None), want, "{text}");
    }
    let spread = "Begin Time - msec\tEnd Time - msec\tGloss\tMouthing\n1040\t2330\tHAUS\thau\n";
    assert_eq!(added(spread, None).len(), 2, "an annotation for each tier");
    let Some(data) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("CHEREME_SHARED_DATA is not set: the export of others was not tried");
        return;
    };
    let file = std::path::Path::new(&data).join("annotation/eaf/neocl-speach/test.eaf.tsv");
    let text = std::fs::read_to_string(file).expect("the file");
    let rows = added(&text, None);
    assert_eq!(rows.len(), text.lines().filter(|line| !line.trim().is_empty()).count());
    assert_eq!(
        (&*rows[0].0, rows[0].1, rows[0].2),
        ("Person1 (Utterance)", 1_040, 2_330)
    );
}

#[test]
fn quotation_marks_that_close_at_no_end_of_a_cell_are_text() {
    let row = |start: u32, value: &str| format!("G\t\t{start}.0\t{}.5\t0.5\t{value}\n", start);
    for (written, want) in [
        (vec!["\"open", "B", "C"], vec!["\"open", "B", "C"]),
        (vec!["\"open", "B", "end\" C"], vec!["\"open", "B", "end\" C"]),
        (vec!["\"he said", "yes\"", "C"], vec!["\"he said", "yes\"", "C"]),
        (
            vec!["A", "\"he said", "well", "yes\""],
            vec!["A", "\"he said", "well", "yes\""],
        ),
        (vec!["A", "\"a\" and \"b\"", "\""], vec!["A", "\"a\" and \"b\"", "\""]),
        (vec!["\"Aha!\"", "B"], vec!["\"Aha!\"", "B"]),
        (vec!["\"a \"\"b\"\" c\"", "B"], vec!["a \"b\" c", "B"]),
        (vec!["\"two\nlines\"", "B"], vec!["two\nlines", "B"]),
        (vec!["\"a, b\"", "\"\""], vec!["a, b", ""]),
    ] {
        let text: String = (1..).zip(&written).map(|(at, it)| row(at, it)).collect();
        assert!(is_export(text.as_bytes()), "{text}");
        let (found, _) = read_elan_table(text.as_bytes()).expect(&text);
        let found: Vec<&str> = found.tiers[0].annotations.iter().map(|it| &*it.value).collect();
        assert_eq!(found, want, "{text}");
    }
    let quoted = "\"tier\"\t\"start\"\t\"end\"\t\"value\"\n\"G\"\t1\t2\t\"Aha!\"\n\"G\"\t3\t4\t\"a\n\"\"b\tc\"\n";
    let values: Vec<String> = added(quoted, None).into_iter().map(|it| it.3).collect();
    assert_eq!(values, ["Aha!", "a\n\"b\tc"]);
    let comma = "tier,start,end,value\nG,1,2,\"open\nG,3,4,B\nG,5,6,\"a, \"\"b\"\"\"\nG,7,8,\"c\"\n";
    let values: Vec<String> = added(comma, None).into_iter().map(|it| it.3).collect();
    assert_eq!(values, ["\"open", "B", "a, \"b\"", "c"]);
    let (_, findings) = read_change_table(comma.as_bytes(), None).expect("a table");
    let lines: Vec<Option<u64>> = findings.iter().map(|it| it.line).collect();
    assert_eq!(lines, [Some(2)], "{findings:?}");
}

#[test]
fn the_lines_of_rows_count_those_within_cells() {
    let text = "\n\"a\"\t\"b\nb\"\r\n\r\n\"c\"\t1\n \t\nd";
    let rows = tab_rows(text);
    let lines: Vec<(u64, usize)> = rows.iter().map(|it| (it.0, it.1.len())).collect();
    assert_eq!(lines, [(2, 2), (5, 2), (7, 1)]);
}

/// A document with a tier for each name and its annotations one after the other, `length` milliseconds each.
fn document(tiers: Vec<(&str, Vec<String>)>, from: i64, length: i64) -> AnnotationTranscript {
    let annotation = |(at, value): (i64, String)| TranscriptAnnotation {
        id: format!("a{at}"),
        span: TimeSpan::span_between(
            RecordingInstant::from_millis(from + at * length),
            RecordingInstant::from_millis(from + (at + 1) * length),
        ),
        timing: AnnotationTiming::Own,
        parent: None,
        order: 0,
        value,
        entry: None,
        language: None,
        external_ref: None,
        millis: None,
    };
    let tier = |(name, values): (&str, Vec<String>)| TranscriptTier {
        name: name.to_owned(),
        annotations: (0..).zip(values).map(annotation).collect(),
        ..TranscriptTier::default()
    };
    AnnotationTranscript {
        tiers: tiers.into_iter().map(tier).collect(),
        ..AnnotationTranscript::default()
    }
}

/// The tiers of a document: name, start and end in milliseconds, value.
fn flat(document: &AnnotationTranscript) -> Vec<(String, i64, i64, String)> {
    let all = document.tiers.iter().flat_map(|tier| {
        tier.annotations.iter().map(|it| {
            let (start, end) = (
                it.span.span_start_instant().instant_millis(),
                it.span.span_end_instant().instant_millis(),
            );
            (tier.name.clone(), start, end, it.value.clone())
        })
    });
    all.collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn tiers_written_as_elan_does_read_back_unchanged(
        odd in proptest::collection::vec("[ -~é\"\"\t\n\r,;#1.]{0,8}", 1..5),
        any in proptest::collection::vec("[^\\x00-\\x08\\x0e-\\x1f]{0,12}", 1..4),
        names in proptest::sample::subsequence(vec!["G", "\"q\" A", "#1", "1", "\"x"], 1..4),
    ) {
        let mut tiers: Vec<(&str, Vec<String>)> = names.into_iter().map(|it| (it, odd.clone())).collect();
        tiers.push(("any", any));
        let whole = document(tiers, 0, 250);
        let text = write_elan_table(&whole);
        prop_assert!(is_export(text.as_bytes()), "{}", text);
        let (found, findings) = read_elan_table(text.as_bytes()).expect("what was written");
        prop_assert_eq!(flat(&found), flat(&whole), "{}", text);
        prop_assert!(findings.iter().all(|it| it.message.contains("no titles") || it.message.contains("lines")), "{:?}", findings);
    }
}

#[test]
fn negative_times_read_back_and_unreadable_ones_are_named() {
    let tiers = vec![("G", vec!["A".to_owned(), "B".into(), "C".into()])];
    for (from, length) in [(-500, 1500), (-4_000_001, 250), (-1000, 1000)] {
        let whole = document(tiers.clone(), from, length);
        let text = write_elan_table(&whole);
        let (found, _) = read_elan_table(text.as_bytes()).expect("what was written");
        assert_eq!(flat(&found), flat(&whole), "{text}");
    }
    let text = write_elan_table(&document(tiers.clone(), -500, 1500));
    assert!(
        text.starts_with("G\t\t-00:00:00.500\t-0.500\t00:00:01.000\t1.000\t"),
        "{text}"
    );
    let whole = document(tiers, 500, 1000);
    let all = flat(&whole);
    let good = write_elan_table(&whole);
    for (from, to) in [
        ("1.500\t00:00:02", "n/a\t00:00:02"),
        ("00:00:00.500\t0.500", "00:00:00.-500\t0.-500"),
        ("00:00:02.500\t2.500\t00:00:03", "\t\t00:00:03"),
        ("1.500\t00:00:01.000\t1.000\tA", "x\t00:00:01.000\t1.000\tA"),
    ] {
        let damaged = good.replacen(from, to, 1);
        assert_ne!(damaged, good);
        let at = 1
            + (0..3)
                .find(|&at| damaged.lines().nth(at) != good.lines().nth(at))
                .expect("a change");
        let (found, findings) = read_elan_table(damaged.as_bytes()).expect("a table");
        let mut rest = all.clone();
        rest.remove(at - 1);
        assert_eq!(flat(&found), rest, "{damaged}");
        let named = findings
            .iter()
            .any(|it| it.line == Some(at as u64) && it.message.contains("a row was left out"));
        assert!(named, "{damaged}: {findings:?}");
    }
    for (text, want) in [
        ("-0:01.5", Some(-1_500_000)),
        ("-1:00:00.25", Some(-3_600_250_000)),
        ("-0.5", Some(-500_000)),
        ("0:-1.5", None),
        ("--1", None),
        ("0:00:00.-5", None),
        ("-", None),
    ] {
        let found = text.parse::<TableMoment>().ok();
        let want = want.map(|it| TableMoment::Time(RecordingInstant::from_micros(it)));
        assert_eq!(found, want, "{text}");
    }
}
