//! The meaning of columns by their titles, and the column that names signs.

use super::*;

#[test]
fn exports_of_signbank_and_asl_lex_are_understood_by_their_titles() {
    let signbank = "Signbank ID,Dataset,Lemma ID Gloss (Dutch),Lemma ID Gloss (English),Annotation ID Gloss (Dutch),\
        Annotation ID Gloss (English),Senses (Dutch),Handedness,Strong Hand,Weak Hand,Location,Contact Type,\
        Movement Direction,Repeated Movement,Orientation Change,Mouthing\n\
        12,NGT,PET,CAP,PET-A,CAP-A,pet,2a,B,B,head,brush,backwards,True,-,pet\n";
    let (lexicon, _) = read(signbank);
    assert_eq!(lexicon.entries[0].gloss, "PET-A");
    let codings = codings(&lexicon, 0);
    for wanted in [
        "dominant.configuration=B",
        "weak.configuration=B",
        "placement=head",
        "placement.contact=brush",
        "movement.direction=backwards",
        "nonmanual.mouthing=pet",
    ] {
        assert!(codings.iter().any(|it| it == wanted), "{wanted}: {codings:?}");
    }
    let asl_lex = "EntryID,LemmaID,SignFrequency(Z),SignType.2.0,MajorLocation.2.0,MinorLocation.2.0,SecondMinorLocation.2.0,\
        Movement.2.0,RepeatedMovement.2.0,Contact.2.0,Handshape.2.0,NonDominantHandshape.2.0,SelectedFingers.2.0,Flexion.2.0,\
        Spread.2.0,ThumbPosition.2.0,UlnarRotation.2.0\n\
        cat,cat,0.31,OneHanded,Head,CheekNose,NA,Straight,1,1,f,NA,imrp,4,1,Open,0\n";
    let (lexicon, _) = read(asl_lex);
    let all = self::codings(&lexicon, 0);
    for wanted in [
        "configuration.handedness=OneHanded",
        "placement=Head",
        "initial.placement.minor=CheekNose",
        "dominant.configuration=f",
        "dominant.configuration.selected-fingers=imrp",
        "dominant.configuration.flexion=4",
        "dominant.configuration.spread=1",
        "dominant.configuration.thumb-position=Open",
        "orientation.ulnar-rotation=0",
    ] {
        assert!(all.iter().any(|it| it == wanted), "{wanted}: {all:?}");
    }
    assert!(!all.iter().any(|it| it.ends_with("=NA")), "NA is no value: {all:?}");
    let title = |column: &chereme_formats::lexicon::LexiconColumn| {
        (column.title == "SignFrequency(Z)").then(|| column.meaning.clone())
    };
    assert_eq!(
        lexicon.columns.iter().find_map(title),
        Some(LexiconColumnMeaning::Attribute)
    );
}

#[test]
fn a_table_of_signbank_names_signs_by_their_annotation_gloss() {
    let text = "Signbank ID,Lemma ID Gloss (Dutch),Lemma ID Gloss (English),Annotation ID Gloss (Dutch),\
                Annotation ID Gloss (English),Senses (Dutch),Strong Hand,Relative Orientation: Movement,\
                Phonology Other\n\
                7,PAARD,HORSE,PAARD-A,HORSE-A,1. paard,Curved B,-,-\n\
                8,PAARD,HORSE,PAARD-B,HORSE-B,-,S,Palm,hidden\n";
    let (lexicon, _) = read(text);
    let glosses: Vec<&str> = lexicon.entries.iter().map(|it| it.gloss.as_str()).collect();
    assert_eq!(glosses, ["PAARD-A", "PAARD-B"], "they share a lemma");
    let of = |language: &str, text: &str| (language.to_owned(), text.to_owned());
    assert_eq!(
        lexicon.entries[0].translations,
        [
            of("nl", "PAARD"),
            of("en", "HORSE"),
            of("en", "HORSE-A"),
            of("nl", "1. paard")
        ]
    );
    assert_eq!(lexicon.entries[1].translations.len(), 3, "a dash is no sense");
    assert_eq!(
        codings(&lexicon, 1),
        ["dominant.configuration=S", "orientation.relative-movement=Palm"]
    );
    let attributes = |entry: usize| lexicon.entries[entry].attributes.clone();
    assert_eq!(attributes(0), [of("Signbank ID", "7")]);
    assert_eq!(attributes(1), [of("Signbank ID", "8"), of("Phonology Other", "hidden")]);
}

#[test]
fn columns_of_measures_are_attributes_and_never_components() {
    let text = "EntryID\tHandshape.2.0\tHandshape.2.0Frequency\tMajorLocation.2.0\tMajorLocation.2.0Frequency\t\
                Movement.2.0Frequency\tRepeatedMovement.2.0\tSignFrequency(M)\tIconicity(M)\tGlossConfidence\t\
                LexicalClass\nabout\topen_b\t0.12\thead\t0.457\t0.345\t1\t4,19\t1.50\t0.9\tMinor\n\
                above\t5\t0.2\tneutral\t0.1\t0.2\t0\t3\t\t1\tNoun\n";
    let (lexicon, findings) = read(text);
    assert_eq!(
        codings(&lexicon, 0),
        ["dominant.configuration=open_b", "placement=head", "movement.repeated=1"]
    );
    let own: Vec<String> = (lexicon.entries[0].attributes.iter())
        .map(|(name, text)| format!("{name}={text}"))
        .collect();
    assert_eq!(
        own,
        [
            "Handshape.2.0Frequency=0.12",
            "MajorLocation.2.0Frequency=0.457",
            "Movement.2.0Frequency=0.345",
            "SignFrequency(M)=4,19",
            "Iconicity(M)=1.50",
            "GlossConfidence=0.9",
            "LexicalClass=Minor"
        ]
    );
    assert_eq!(lexicon.entries[1].attributes.len(), 6, "an empty cell gives none");
    assert_eq!(findings.len(), 1, "{findings:?}");
    assert!(findings[0].contains("\"LexicalClass\" are kept as attributes"));
    let mapping =
        r#"{"columns": {"*Frequency": "note", "LexicalClass": "translation", "MajorLocation.2.0": "attribute"}}"#;
    let mapping = TierMapping::from_json(mapping).expect("a mapping");
    let (lexicon, _) = lexicon::read_lexicon(text.as_bytes(), &mapping).expect("a table");
    assert_eq!(lexicon.columns[2].meaning, LexiconColumnMeaning::Note);
    assert_eq!(lexicon.columns[3].meaning, LexiconColumnMeaning::Attribute);
    assert_eq!(lexicon.entries[1].translations[0].1, "Noun");
}

#[test]
fn titles_of_changes_pictures_and_later_morphemes_are_no_components() {
    for (title, cell, wanted) in [
        ("FlexionChange.2.0", "1", "attribute"),
        ("SpreadChange.2.0", "0", "attribute"),
        ("HandshapeImage", "b.png", "attribute"),
        ("Handshape video", "b.mp4", "attribute"),
        ("HandshapeM2.2.0", "b", "attribute"),
        ("Handshape.M3.2.0", "b", "attribute"),
        ("MajorLocation morpheme2", "head", "attribute"),
        ("Photo de la configuration", "b.png", "attribute"),
        ("Handshape.2.0", "b", "dominant.configuration"),
        ("Handshape.M1.2.0", "b", "dominant.configuration"),
        ("Flexion.2.0", "1", "dominant.configuration.flexion"),
        ("Spread.2.0", "0", "dominant.configuration.spread"),
        ("Handshape change MG", "closing", "left.configuration.change"),
    ] {
        let (lexicon, _) = read(&format!("gloss\t{title}\nX\t{cell}\n"));
        assert_eq!(lexicon.columns[1].meaning.to_string(), wanted, "{title}");
    }
}

#[test]
fn a_column_that_many_rows_leave_empty_names_only_what_no_other_column_names() {
    let rows = |filled: usize| -> String {
        let row = |at: usize| match at < filled {
            true => format!("E{at},A{at},L\n"),
            false => format!("E{at},,L\n"),
        };
        (0..20).map(row).collect()
    };
    for (filled, first, last, found) in [
        (14, "E0", "E19", ""),
        (
            19,
            "A0",
            "E19",
            "rows without \"SignBankAnnotationID\" that \"EntryID\" names: 1",
        ),
    ] {
        let text = format!("EntryID,SignBankAnnotationID,LemmaID\n{}", rows(filled));
        let (lexicon, findings) = read(&text);
        let glosses: Vec<&str> = lexicon.entries.iter().map(|it| it.gloss.as_str()).collect();
        assert_eq!((glosses[0], glosses[19]), (first, last), "{filled}");
        let named = findings.iter().filter(|it| it.starts_with("rows without"));
        assert_eq!(named.cloned().collect::<String>(), found);
        assert!(lexicon.entries[0].translations.iter().any(|(_, text)| text == "L"));
    }
    // A mapping decides, and the rows that it leaves without a name have the next one.
    let mapping = TierMapping::from_json(r#"{"columns": {"SignBankAnnotationID": "gloss"}}"#);
    let text = format!("EntryID,SignBankAnnotationID,LemmaID\n{}", rows(5));
    let (lexicon, _) = lexicon::read_lexicon(text.as_bytes(), &mapping.expect("a mapping")).expect("read");
    let glosses = lexicon.entries.iter().map(|it| it.gloss.as_str());
    assert_eq!(glosses.skip(4).take(2).collect::<Vec<_>>(), ["A4", "E5"]);
}

#[test]
fn titles_are_found_below_headings_and_by_their_capital_letters() {
    let rows = "A;B;chin\n\"B, C\";5;nose\n";
    for (text, line, found) in [
        (format!("sep=;\nNL gloss;Handshape strong;Location\n{rows}"), 3, ""),
        (
            format!("Lexicon, NGT\n\nNL gloss;Handshape strong;Location\n{rows}"),
            4,
            "the titles of the columns are in line 3; the text above them was left out: \"Lexicon, NGT\"",
        ),
        (
            format!("Gloss list;;\n;;\nNL gloss;Handshape strong;Location\n{rows}"),
            4,
            "the titles of the columns are in line 3; the text above them was left out: \"Gloss list;; / ;;\"",
        ),
        (format!("NlGloss;HandshapeStrong;Location\n{rows}"), 2, ""),
        (format!("nlGloss;handshapeStrong;LOCATION\n{rows}"), 2, ""),
    ] {
        let (lexicon, findings) = read(&text);
        assert_eq!(findings.join("; "), found, "{text}");
        let entries = lexicon.entries.iter().map(|it| (&*it.gloss, it.line));
        let entries: Vec<_> = entries.collect();
        assert_eq!(entries, [("A", line), ("B, C", line + 1)], "{text}");
        assert_eq!(
            codings(&lexicon, 0),
            ["dominant.configuration=B", "placement=chin"],
            "{text}"
        );
    }
    // A table of one column, and one whose second row is longer, keep their first row.
    for text in ["gloss\nA, B\nC\n", "gloss,Location\nA,chin,,,more\n"] {
        assert_eq!(read(text).0.columns[0].title, "gloss", "{text}");
    }
}
