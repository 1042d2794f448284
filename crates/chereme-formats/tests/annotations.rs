//! Tables of changes to annotations.

use chereme_formats::table::TableError;
use chereme_formats::table::annotations::{Moment, read};

/// Reads a table and shows each row or fault as a line.
fn shown(text: &str) -> String {
    let (table, _) = read(text.as_bytes()).expect("a table");
    let time = |moment: Option<Moment>| match moment {
        None => "-".to_owned(),
        Some(Moment::Frame(frame)) => format!("f{frame}"),
        Some(Moment::Time(time)) => time.micros().to_string(),
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
fn rows_in_all_forms() {
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
fn what_is_no_table_is_refused() {
    assert_eq!(read(b""), Err(TableError::Empty));
    assert_eq!(read(b"\n \n"), Err(TableError::Empty));
    assert_eq!(read(b"tier\n\0"), Err(TableError::NotText { line: 2 }));
    assert!(matches!(
        read(b"start,end\n1,2\n"),
        Err(TableError::Missing {
            needed: "tier or id",
            ..
        })
    ));
    let wide = ",".repeat(5000) + "tier";
    assert!(matches!(
        read(wide.as_bytes()),
        Err(TableError::Columns { found: 5001, .. })
    ));
}

#[test]
fn odd_columns_are_found() {
    let (_, findings) = read(b"teir,tier,tier\nx,y,z\n").expect("a table");
    let messages: Vec<&str> = findings.iter().map(|it| &*it.message).collect();
    assert_eq!(
        messages,
        [
            "the column \"teir\" is not used; did you mean \"tier\"?",
            "the column \"tier\" is there twice; the first counts"
        ]
    );
}
