//! Tests of the meanings of columns by their titles.

use super::*;

/// Returns the meanings of the titles of a table with one row.
fn meant(titles: &[&str], cells: &[&str]) -> (Vec<String>, Vec<String>) {
    let own = |texts: &[&str]| texts.iter().map(|&it| it.to_owned()).collect::<Vec<_>>();
    let rows = [TableRow {
        line: 2,
        cells: own(cells),
    }];
    let mut findings = FindingTally::default();
    let mapping = TierMapping::default();
    let LexiconTableColumns { columns, .. } = infer_column_meanings(&own(titles), &rows, &mapping, &mut findings);
    let said = findings.finish_finding_tally().into_iter().map(|it| it.message);
    let meant = columns.iter().map(|column| column.meaning.to_string());
    (meant.collect(), said.collect())
}

#[test]
fn titles_state_the_hand_of_a_component() {
    for (title, meaning) in [
        ("Configuration MD", "right.configuration"),
        ("Configuration MG", "left.configuration"),
        ("Handshape NDH", "weak.configuration"),
        ("Handshape DH final", "final.dominant.configuration"),
        ("Final Handshape (left)", "final.left.configuration"),
        ("Weak Hand Location", "weak.placement"),
        ("Weak Hand", "weak.configuration"),
        ("Orientation paume MG", "left.orientation.palm"),
        ("Sign Type", "configuration.handedness"),
        ("Location", "placement"),
    ] {
        let (meant, said) = meant(&["gloss", title], &["A", "x"]);
        assert_eq!(meant[1], meaning, "{title}");
        assert!(said.is_empty(), "{said:?}");
    }
    // With a weak hand MND, MD is the dominant one.
    let (meant, _) = meant(&["Glose", "Configuration MD", "Configuration MND"], &["A", "x", "y"]);
    assert_eq!(meant, ["gloss", "dominant.configuration", "weak.configuration"]);
}

#[test]
fn the_id_of_an_entry_is_its_gloss_only_where_there_is_no_other() {
    for (titles, wanted) in [
        (&["EntryID", "Handshape"][..], &["gloss", "dominant.configuration"][..]),
        (
            &["EntryID", "Gloss", "Handshape"],
            &["attribute", "gloss", "dominant.configuration"],
        ),
        (&["Gloss", "Entry ID"], &["gloss", "attribute"]),
    ] {
        assert_eq!(meant(titles, &vec!["a"; titles.len()]).0, wanted, "{titles:?}");
    }
}

#[test]
fn two_columns_of_one_component_are_reported() {
    let (_, said) = meant(&["gloss", "Handshape", "Handform"], &["A", "U", "V"]);
    assert!(said[0].contains("\"Handshape\" and \"Handform\""), "{said:?}");
    // The remedy names what a mapping takes.
    for (title, second) in [
        ("configuration", "weak.configuration"),
        ("final.dominant.configuration", "final.weak.configuration"),
        ("left.configuration", "attribute"),
        ("configuration.handedness", "attribute"),
        ("nonmanual.mouth", "attribute"),
    ] {
        let own = second_meaning(&column_from_title(title, &TierMapping::default()).meaning);
        assert_eq!(own.to_string(), second, "{title}");
        let mapping = format!(r#"{{"columns": {{"x": "{own}"}}}}"#);
        assert!(TierMapping::from_json(&mapping).is_ok(), "{mapping}");
    }
}

#[test]
fn numbers_are_no_translations() {
    let titles = ["gloss", "SignOnset(ms)", "SignLength(ms)", "Meaning 2"];
    let (meant, _) = meant(&titles, &["A", "500", "700", "snail"]);
    assert_eq!(meant, ["gloss", "attribute", "attribute", "translation"]);
}

#[test]
fn the_built_in_table_is_complete_and_each_title_has_one_meaning() {
    let text = chereme_data::schema_text("column_words.json");
    let file: BTreeMap<String, Vec<String>> = serde_json::from_str(text).expect("a table");
    let titles: Vec<&String> = file.values().flatten().collect();
    assert!(
        titles.iter().all(|title| normalize_tier_name(title) == **title),
        "titles are folded words"
    );
    assert_eq!(
        parse_column_targets(text).expect("a table").len(),
        titles.len(),
        "a title stands twice"
    );
}
