//! Lexicon tables: the meaning of columns and cells, findings, and round trips.

#[path = "lexicon/titles.rs"]
mod titles;

use chereme_formats::lexicon::{self, LexiconColumnMeaning, SignLexicon};
use chereme_formats::roles::TierMapping;
use chereme_formats::table::TableError;
use chereme_sign::SignComponent;
use proptest::prelude::*;

fn read(text: &str) -> (SignLexicon, Vec<String>) {
    let (lexicon, findings) = lexicon::read_lexicon(text.as_bytes(), &TierMapping::default()).expect("a table");
    (lexicon, findings.into_iter().map(|it| it.message).collect())
}

fn codings(lexicon: &SignLexicon, entry: usize) -> Vec<String> {
    let all = lexicon.entries[entry].codings.iter();
    all.map(|it| format!("{}={}", it.coding_field(), it.reading)).collect()
}

#[test]
fn cells_are_split_into_separate_values() {
    for (title, cell, expected) in [
        ("Location", "neutral space", "placement=neutral space"),
        (
            "Location",
            "neutral space > head",
            "initial.placement=neutral space final.placement=head",
        ),
        ("Location", "cheek + chin", "placement=cheek placement=chin"),
        ("Location", "weak hand: back", "placement=weak hand: back"),
        (
            "Movement direction",
            "outwards > downwards > inwards",
            "initial.movement.direction=outwards middle.movement.direction=downwards final.movement.direction=inwards",
        ),
        (
            "Movement direction",
            "downwards > outwards, downwards",
            "initial.movement.direction=downwards final.movement.direction=outwards final.movement.direction=downwards",
        ),
        ("Movement direction", "variable", "movement.direction=variable"),
        (
            "Movement shape",
            "circle parallel + straight",
            "movement.shape=circle parallel movement.shape=straight",
        ),
        (
            "Contact type",
            "none + initial",
            "placement.contact=none placement.contact=initial",
        ),
        ("Contact type", "> final", "final.placement.contact=final"),
        (
            "Handshape change",
            "closing > opening",
            "initial.dominant.configuration.change=closing final.dominant.configuration.change=opening",
        ),
        ("right.placement", "chin", "right.placement=chin"),
        (
            "initial.weak.configuration.change",
            "closing",
            "initial.weak.configuration.change=closing",
        ),
        ("nonmanual.gaze", "left", "nonmanual.gaze=left"),
        ("Handshape change", "closing", "dominant.configuration.change=closing"),
        ("Handshape change", ">S", "final.dominant.configuration=S"),
        ("Handshape change", "+ closing", "dominant.configuration.change=closing"),
        (
            "Handshape change",
            "wiggle, closing",
            "dominant.configuration.change=wiggle dominant.configuration.change=closing",
        ),
        (
            "Handshape weak",
            "O >5",
            "initial.weak.configuration=O final.weak.configuration=5",
        ),
        (
            "Handshape weak",
            "S, closing",
            "weak.configuration=S weak.configuration.change=closing",
        ),
        (
            "Handshape weak",
            "B + closing",
            "weak.configuration=B weak.configuration.change=closing",
        ),
        (
            "Handshape strong",
            "S + W",
            "dominant.configuration=S dominant.configuration=W",
        ),
        (
            "Handshape strong",
            "beak, pinkie extended",
            "dominant.configuration=beak, pinkie extended",
        ),
        ("Handshape weak", "N/A", "weak.configuration=not applicable"),
        ("Handshape weak", "-", "weak.configuration=not applicable"),
        ("Handshape weak", "?", "weak.configuration=unclear"),
        ("Handshape weak", "  ", ""),
        (
            "Absolute Orientation: palm",
            "backwards > forwards",
            "initial.orientation.palm=backwards final.orientation.palm=forwards",
        ),
        (
            "Absolute Orientation: Fingers",
            "back/palm",
            "orientation.fingers=back/palm",
        ),
        (
            "Relation between articulators",
            "hands rotate around each other, then contacting movement",
            "placement.relation=hands rotate around each other, then contacting movement",
        ),
        ("Handedness", "2s", "configuration.handedness=2s"),
        ("Repeated Movement", "yes", "movement.repeated=yes"),
        ("Final location", "chest", "final.placement=chest"),
        ("Movement", "None", "movement=None"),
        ("Movement shape", "none", "movement.shape=none"),
        ("Contact type", "None", "placement.contact=None"),
        ("Location", "None", ""),
        ("Handshape weak", "NA", "weak.configuration=not applicable"),
    ] {
        let (lexicon, _) = read(&format!("gloss\t{title}\nX\t{cell}\n"));
        assert_eq!(codings(&lexicon, 0).join(" "), expected, "{title}: {cell}");
    }
}

#[test]
fn beside_a_final_value_of_another_column_the_value_is_initial() {
    for (titles, cells, wanted) in [
        (
            "Handshape\tFinal handshape\tLocation\tFinal location",
            "B\tS\tchin\t",
            "initial.dominant.configuration=B final.dominant.configuration=S placement=chin",
        ),
        (
            "Handshape strong\tHandshape change\tHandshape weak",
            "B\t>S\tB",
            "initial.dominant.configuration=B final.dominant.configuration=S weak.configuration=B",
        ),
        (
            "MinorLocation.2.0\tSecondMinorLocation.2.0",
            "Palm\tNA",
            "initial.placement.minor=Palm final.placement.minor=not applicable",
        ),
        (
            "Location\tEmplacement\tFinal location",
            "chin > nose\tcheek\tchest",
            "initial.placement=chin final.placement=nose placement=cheek final.placement=chest",
        ),
    ] {
        let (lexicon, _) = read(&format!("gloss\t{titles}\nX\t{cells}\n"));
        assert_eq!(codings(&lexicon, 0).join(" "), wanted, "{titles}");
    }
}

#[test]
fn handshapes_in_a_column_of_changes_are_announced() {
    let (_, findings) = read("gloss\tHandshape change\nA\tclosing\nB\t>S\nC\t>5\nD\topening > closing\n");
    assert_eq!(
        findings,
        ["cells of \"Handshape change\" that name handshapes, such as \">S\", were taken for these: 2"]
    );
}

#[test]
fn columns_are_recognised_by_title_and_by_mapping() {
    let (lexicon, findings) = read(
        "Annotation ID Gloss (Dutch);Annotation ID Gloss (English);Palm orientation;Remarks;Handshape\nX;Y;up;hm;B\n",
    );
    assert_eq!(lexicon.delimiter, b';');
    assert_eq!(
        lexicon.columns[0].meaning,
        LexiconColumnMeaning::Gloss {
            language: Some("nl".into())
        }
    );
    assert_eq!(lexicon.entries[0].translations, [("en".to_owned(), "Y".to_owned())]);
    assert_eq!(lexicon.columns[3].meaning, LexiconColumnMeaning::Attribute);
    assert_eq!(lexicon.entries[0].attributes, [("Remarks".to_owned(), "hm".to_owned())]);
    assert_eq!(
        findings,
        ["the column \"Remarks\" is kept as an attribute of each sign"]
    );
    assert_eq!(
        codings(&lexicon, 0),
        ["orientation.palm=up", "dominant.configuration=B"]
    );
    let mapping = TierMapping::from_json(
        r#"{"columns": {"Mot": "gloss.fr", "Re*": "note", "Forme": "both.configuration", "Fin": "final.placement"}}"#,
    )
    .expect("a mapping");
    let (lexicon, findings) =
        lexicon::read_lexicon("Mot,Remarque,Forme,Fin\nchat,x,V,a > b\n".as_bytes(), &mapping).expect("a table");
    assert!(findings.is_empty());
    assert_eq!(lexicon.entries[0].gloss, "chat");
    assert_eq!(
        lexicon.entries[0].codings[0].hand.map(|it| it.annotated_hands_name()),
        Some("both")
    );
    assert_eq!(
        codings(&lexicon, 0),
        ["configuration=V", "initial.placement=a", "final.placement=b"]
    );
}

#[test]
fn symbols_in_a_wrong_encoding_are_mended_before_blanks_are_cut() {
    let symbols = "\u{e001}\u{e03c}\u{e0e0}";
    let latin: String = symbols.bytes().map(char::from).collect();
    let (lexicon, findings) = read(&format!("gloss\tHamNoSys\nA\t{latin}\nB\t{symbols}\n"));
    for entry in &lexicon.entries {
        assert_eq!(entry.notation.as_deref(), Some(symbols), "{}", entry.gloss);
    }
    assert_eq!(findings.len(), 1, "{findings:?}");
}

#[test]
fn odd_tables_are_read_with_findings() {
    let (lexicon, findings) =
        read("\u{feff}gloss,Location\r\n\"A, \"\"B\"\"\",chin\r\nSHORT\r\n,chin\r\nC,chin,more\r\nC,nose\r\n");
    let glosses: Vec<(&str, u64)> = lexicon.entries.iter().map(|it| (&*it.gloss, it.line)).collect();
    assert_eq!(glosses, [("A, \"B\"", 2), ("SHORT", 3), ("C", 5), ("C", 6)]);
    assert_eq!(
        findings,
        [
            "the row has 1 cells and the first row 2; the rest was taken as empty",
            "the row has 3 cells and the first row 2; the rest was left out",
            "the row has no gloss; it was left out",
        ]
    );
    let (latin, findings) =
        lexicon::read_lexicon(b"gloss\tLocation\n\xc9T\xc9\tchin\n", &TierMapping::default()).expect("a table");
    assert_eq!(latin.entries[0].gloss, "ÉTÉ");
    assert_eq!(findings[0].line, Some(2));
    let utf16: Vec<u8> = [0xff, 0xfe]
        .into_iter()
        .chain("gloss\tLocation\nÉTÉ\tchin\n".encode_utf16().flat_map(u16::to_le_bytes))
        .collect();
    assert_eq!(
        lexicon::read_lexicon(&utf16, &TierMapping::default())
            .expect("a table")
            .0
            .entries[0]
            .gloss,
        "ÉTÉ"
    );
    assert!(matches!(
        lexicon::read_lexicon(b"a,b\n1,2\n", &TierMapping::default()),
        Err(TableError::Missing { needed: "a gloss", .. })
    ));
    assert_eq!(
        lexicon::read_lexicon(b"", &TierMapping::default()),
        Err(TableError::Empty)
    );
}

#[test]
fn arrows_part_successive_values_and_what_programs_write_for_nothing_is_counted() {
    let (lexicon, findings) = read(
        "gloss\thandshape\tlocation\nA\tB->5\tchin->chest\nB\tB → 5\tchin\nC\tB > 5\tNone\nD\tnan\t#N/A\nE\t- > 5\tnan\n",
    );
    let changing = "initial.dominant.configuration=B final.dominant.configuration=5";
    for (entry, wanted) in [
        (0, format!("{changing} initial.placement=chin final.placement=chest")),
        (1, format!("{changing} placement=chin")),
        (2, changing.to_owned()),
        (3, String::new()),
        (4, changing.replace("=B", "=not applicable")),
    ] {
        assert_eq!(codings(&lexicon, entry).join(" "), wanted, "{entry}");
    }
    assert_eq!(
        findings,
        [
            "values that programs write for an empty cell were taken as unset: \"#N/A\" once, \"None\" once, \"nan\" 2 times"
        ]
    );
}

#[test]
fn tables_of_other_projects_are_understood() {
    let notated = |bytes: &[u8]| -> Vec<(u64, String, Option<String>)> {
        let (lexicon, _) = lexicon::read_lexicon(bytes, &TierMapping::default()).expect("a table");
        let all = lexicon.entries.into_iter();
        all.map(|it| (it.line, it.gloss, it.notation)).collect()
    };
    let flat = "hamflathand hamextfingeru hampalml";
    let entry = |line, gloss: &str| (line, gloss.to_owned(), Some(flat.to_owned()));
    for table in [
        format!("Gloss|Symbols|Video\nA|{flat}|a.mp4\nB|{flat}|b.mp4\n"),
        format!("id,word,ham\n7,A,{flat}\n8,B,{flat}\n"),
        format!("Symbols;Bezeichnung\n{flat};A\n{flat};B\n"),
        format!("[{{\"gloss\": \"A\", \"hamnosys\": \"{flat}\"}}]\n"),
        format!("{{\n\"A\": {{\"symbols\": \"{flat}\", \"n\": 1, \"more\": [1]}},\n\"B\": \"{flat}\"}}"),
    ] {
        let read = notated(table.as_bytes());
        assert_eq!((&*read[0].1, read[0].2.as_deref()), ("A", Some(flat)), "{table}");
    }
    assert_eq!(
        notated(format!("{{\n \"A\": \"{flat}\",\n \"B\": \"{flat}\"}}").as_bytes()),
        [entry(2, "A"), entry(3, "B")]
    );
    let headless = format!("A,{flat}\nB,{flat}\n");
    assert_eq!(notated(headless.as_bytes()), [entry(1, "A"), entry(2, "B")]);
    let (_, findings) = read(&headless);
    assert_eq!(
        findings,
        [
            "the first row holds HamNoSys: it was taken for a sign, not for titles",
            "no column is called a gloss; \"column 1\" was taken for it",
        ]
    );
    assert!(lexicon::read_lexicon(b"{\"id\": 1}", &TierMapping::default()).is_err());
    let (windows, _) = lexicon::read_lexicon(b"gloss;Location\nC\x8cUR \x93\xe9\x94;chin\n", &TierMapping::default())
        .expect("a table");
    assert_eq!(windows.entries[0].gloss, "CŒUR “é”");
}

#[test]
fn a_short_row_below_a_wide_one_costs_little() {
    let wide: String = (0..4096).map(|n| format!("c{n},")).collect();
    let text = format!("gloss,{wide}\n{}", "x\n".repeat(2000));
    let refused = lexicon::read_lexicon(text[..].as_bytes(), &TierMapping::default());
    assert!(matches!(refused, Err(TableError::Columns { .. })), "{refused:?}");
    let text = text.replacen("c0,c1,", "", 1);
    let refused = lexicon::read_lexicon(text.as_bytes(), &TierMapping::default());
    assert!(
        matches!(refused, Err(TableError::Ragged { line: 1026, .. })),
        "{refused:?}"
    );
}

#[test]
fn tables_and_cells_beyond_the_limits_are_refused_with_their_place() {
    let refused = |text: String| lexicon::read_lexicon(text.as_bytes(), &TierMapping::default());
    let rows = refused(format!("gloss,Handshape\n{}", "x,B\n".repeat(1_000_001)));
    assert_eq!(rows.err(), Some(TableError::TooLarge { line: 1_000_002 }));
    let cells = refused(format!(
        "gloss,{}\n{}",
        "c,".repeat(400),
        format!("x{}\n", ",1".repeat(401)).repeat(12_000)
    ));
    assert!(
        matches!(cells, Err(TableError::TooLarge { line: 9_951 })),
        "{:?}",
        cells.err()
    );
    let long = refused(format!("gloss,Handshape\nA,B\n{},B\n", "x".repeat((1 << 20) + 1)));
    let (line, column, bytes) = (3, 1, (1 << 20) + 1);
    assert_eq!(long.err(), Some(TableError::LongCell { line, column, bytes }));
}

#[test]
fn inventories_count_values_of_both_hands_and_all_phases() {
    let (lexicon, _) =
        read("gloss\tHandshape strong\tHandshape weak\tLocation\nA\tB\t\tchin > nose\nC\tB\t5\tchin\nD\tB > 5\t-\t?\n");
    let inventories = lexicon.component_inventories();
    let shown: Vec<String> = inventories
        .iter()
        .map(|it| {
            format!(
                "{}: {}",
                it.component,
                it.values
                    .iter()
                    .map(|(value, count)| format!("{value} {count}"))
                    .collect::<Vec<_>>()
                    .join(", ")
            )
        })
        .collect();
    assert_eq!(shown, ["configuration: 5 2, B 3", "placement: chin 2, nose 1"]);
}

#[test]
fn misspelled_values_get_a_suggestion() {
    let mut text = "gloss\tHandshape weak\n".to_owned();
    for n in 0..30 {
        text += &format!("G{n}\tC-spread\n");
    }
    text += "X\tC-spreid\nY\tc-spread\n";
    let (_, findings) = read(&text);
    assert_eq!(
        findings,
        [
            "configuration: \"C-spreid\" (once) and \"C-spread\" (30 times) are kept as two values",
            "configuration: \"c-spread\" (once) and \"C-spread\" (30 times) are kept as two values",
        ]
    );
}

#[test]
fn a_misspelled_value_is_located_in_its_own_column() {
    // "S-spreid" is also a place, in the first line; and in the third line it is another feature of the hand.
    let mut text = "gloss\tLocation\tHandshape change\tHandshape weak\n".to_owned();
    text += "P\tC-spreid\t\t\nQ\t\tC-spreid\t\n";
    for n in 0..30 {
        text += &format!("G{n}\t\t\tC-spread\n");
    }
    text += "X\t\t\tC-spreid\n";
    let (_, findings) = lexicon::read_lexicon(text.as_bytes(), &TierMapping::default()).expect("a table");
    let slip = findings.iter().find(|it| it.message.contains("kept as two"));
    assert_eq!(slip.expect("a finding").line, Some(34));
}

#[test]
fn a_table_of_2145_signs_reads_back_unchanged() {
    let Some(data) = std::env::var_os("CHEREME_SHARED_DATA").map(std::path::PathBuf::from) else {
        eprintln!("CHEREME_SHARED_DATA is not set: the table of others was not tried");
        return;
    };
    let bytes = std::fs::read(data.join("phonology/ngt_lexicon.tsv")).expect("a file");
    let (lexicon, findings) = lexicon::read_lexicon(&bytes, &TierMapping::default()).expect("a table");
    for finding in &findings {
        eprintln!("{:?} {}", finding.line, finding.message);
    }
    for column in &lexicon.columns {
        eprintln!(
            "{}: {:?} {} ({})",
            column.title, column.meaning, column.confidence, column.why
        );
    }
    assert_eq!(lexicon.entries.len(), 2145);
    assert!(lexicon.columns.iter().all(|column| column.confidence > 0.9));
    let mut out = Vec::new();
    lexicon::write_lexicon(&lexicon, &mut out).expect("a vector takes everything");
    let (again, _) = lexicon::read_lexicon(&out, &TierMapping::default()).expect("what was written");
    assert_eq!(again, lexicon);
    let plain = String::from_utf8(bytes).expect("UTF-8");
    let rows: Vec<Vec<&str>> = plain.lines().map(|line| line.split('\t').collect()).collect();
    for (entry, row) in lexicon.entries.iter().zip(&rows[1..]) {
        assert_eq!(entry.cells, *row);
        let filled = lexicon
            .columns
            .iter()
            .zip(row)
            .enumerate()
            .filter(|(_, (column, cell))| {
                matches!(column.meaning, LexiconColumnMeaning::Coding { .. }) && !cell.is_empty()
            });
        for (at, (_, cell)) in filled {
            let raw: Vec<&str> = entry
                .codings
                .iter()
                .filter(|it| it.column == at)
                .map(|it| &*it.raw)
                .collect();
            let letters = |text: &str| {
                text.chars()
                    .filter(|c| !c.is_whitespace() && !"+>,".contains(*c))
                    .collect::<String>()
            };
            assert_eq!(letters(&raw.concat()), letters(cell), "{}", entry.gloss);
        }
    }
    let inventories = lexicon.component_inventories();
    let shapes = inventories
        .iter()
        .find(|it| it.component == SignComponent::Configuration && it.feature.is_none());
    assert!(shapes.is_some_and(|it| it.values["B"] > 600));
    let compound = lexicon
        .entries
        .iter()
        .flat_map(|it| &it.codings)
        .filter_map(|it| it.reading.reading_value());
    assert_eq!(compound.filter(|value| value.contains(['>', '+'])).count(), 0);
    for inventory in &inventories {
        eprintln!(
            "{} {:?}: {}",
            inventory.component,
            inventory.feature,
            inventory.values.len()
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn any_bytes_are_a_table_or_an_error(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        let _ = lexicon::read_lexicon(&bytes, &TierMapping::default());
        let _ = chereme_formats::table::annotations::read_change_table(&bytes, None);
        let _ = chereme_formats::eaf::read_eaf(&bytes);
    }

    #[test]
    fn any_cells_read_back_unchanged(cells in proptest::collection::vec("[ -~éあ\"\n;\t>+,]{0,12}", 8)) {
        let header = ["gloss", "Location", "Handshape strong", "Movement direction"].map(str::to_owned);
        let mut table = csv::Writer::from_writer(Vec::new());
        table.write_record(&header).expect("a vector takes everything");
        for row in cells.chunks(4) {
            table.write_record(row).expect("a vector takes everything");
        }
        let bytes = table.into_inner().expect("a vector takes everything");
        let Ok((lexicon, _)) = lexicon::read_lexicon(&bytes, &TierMapping::default()) else { return Ok(()) };
        let kept: Vec<&[String]> = cells.chunks(4).filter(|row| !row[0].trim().is_empty()).collect();
        prop_assert!(lexicon.entries.iter().map(|entry| &entry.cells[..]).eq(kept));
        let mut out = Vec::new();
        lexicon::write_lexicon(&lexicon, &mut out).expect("a vector takes everything");
        let (again, _) = lexicon::read_lexicon(&out, &TierMapping::default()).expect("what was written");
        let cells = |it: &SignLexicon| it.entries.iter().map(|entry| entry.cells.clone()).collect::<Vec<_>>();
        prop_assert_eq!(cells(&again), cells(&lexicon));
    }
}
