use serde_json::json;

use super::*;

fn plan() -> StudyPlan {
    let plan = json!({
        "format": "chereme-study", "version": 1, "name": "bowls",
        "trials": [
            {"item": "BOL", "condition": "captured", "clip": "BOL", "right": {"place": "left"}},
            {"item": "BOL", "condition": "made", "clip": "BOL | swap", "right": {"place": "right"}}],
        "questions": [
            {"name": "realism", "cannot_say": true,
             "kind": {"scale": {"low": 1, "high": 5, "labels": {"1": {"en": "like a robot", "fr": "comme un robot"}}}}},
            {"name": "place", "kind": {"choice": {"options": [
                {"name": "left", "text": {"en": "on the left", "fr": "à gauche"}}, {"name": "right"}]}}}],
        "profile": [{"name": "level", "options": [{"name": "good"}, {"name": "native", "text": {"en": "Since birth"}}]}],
    });
    serde_json::from_value(plan).expect("a plan")
}

const MAP: &str = "\
column;item;condition;question;means;values
id;;;;participant;
r1;BOL;captured;realism;;A1=1; A5=5
p1;BOL;captured;place;;
r2;BOL;made;realism;;
p2;BOL;made;place;;
since;;;;profile.level;
";

/// Returns the map above; the codes of its third line stand in quotes, as they hold the separator.
fn map() -> ColumnMap {
    let text = MAP.replace("A1=1; A5=5", "\"A1=1; A5=5\"");
    ColumnMap::read_column_map(&text, "map.csv", &plan()).expect("a map")
}

fn people(text: &str) -> (Vec<StudyParticipant>, FileFindings) {
    let mut findings = FileFindings::default();
    let (read, _) = read_wide_answers(text, "answers.csv", &map(), &plan(), "sha", &mut findings).expect("read");
    (read.into_iter().map(|it| it.participant).collect(), findings)
}

fn said(person: &StudyParticipant) -> Vec<(u32, &str, Option<i64>, Option<&str>)> {
    let each = person.answers.iter();
    each.map(|it| (it.n, it.question.as_str(), it.value, it.choice.as_deref()))
        .collect()
}

#[test]
fn codes_labels_texts_and_names_are_answers() {
    let (all, findings) = people(
        "id,r1,p1,r2,p2,since,other\n12,A5,À GAUCHE,Comme un robot,right,since birth,x\nR_b,2,left,i cannot say,,,\n",
    );
    assert_eq!(
        said(&all[0]),
        [
            (1, "realism", Some(5), None),
            (1, "place", None, Some("left")),
            (2, "realism", Some(1), None),
            (2, "place", None, Some("right")),
        ]
    );
    assert_eq!(all[0].profile.get("level").map(String::as_str), Some("native"));
    assert_eq!((all[0].code.as_str(), all[0].finished), ("12", true));
    assert_eq!(
        said(&all[1]),
        [
            (1, "realism", Some(2), None),
            (1, "place", None, Some("left")),
            (2, "realism", None, None),
        ]
    );
    assert!(!all[1].finished, "an answer is missing");
    assert!(findings.finish_findings().is_empty());
}

#[test]
fn texts_of_questions_below_the_titles_are_no_people() {
    let text = "\
id,r1,p1,r2,p2,since
Response ID,How real?,Where?,How real?,Where?,Since when?
\"{\"\"ImportId\"\":\"\"_recordId\"\"}\",\"{\"\"ImportId\"\":\"\"QID1\"\"}\",x,x,x,x
R_1,3,left,4,right,good
";
    let (all, _) = people(text);
    assert_eq!((all.len(), all[0].code.as_str()), (1, "R_1"));
    assert_eq!(all[0].answers[0].value, Some(3));
}

#[test]
fn what_is_no_answer_is_reported_with_its_line() {
    let (all, findings) = people("id,r1,p1,r2,p2,since\na,6,up,A1,right,\n");
    assert_eq!(said(&all[0]), [(2, "place", None, Some("right"))]);
    let found = findings.finish_findings();
    let lines: Vec<_> = found.iter().map(|it| it.line).collect();
    assert_eq!(lines, [Some(2); 3]);
    assert!(found[0].message.contains("\"6\" in the column \"r1\""));
}

#[test]
fn maps_that_fit_neither_plan_nor_table_are_refused_with_their_line() {
    let cases = [
        (
            "column,means\nid,name\n",
            "map.csv, line 2",
            "\"name\" is no meaning of a column",
        ),
        (
            "column,means\nid,profile.levle\n",
            "map.csv, line 2",
            "did you mean \"level\"?",
        ),
        (
            "column,item,condition,question\nr,BOL,drawn,realism\n",
            "map.csv, line 2",
            "no trial with \"BOL\" and \"drawn\"",
        ),
        (
            "column,item,condition,question\nr,BOL,made,realsm\n",
            "map.csv, line 2",
            "did you mean \"realism\"?",
        ),
        (
            "column,item,condition,question,role\nr,BOL,made,realism,extra\n",
            "map.csv, line 2",
            "\"extra\" is no role",
        ),
        (
            "column,item,condition,question,values\nr,BOL,made,realism,A1\n",
            "map.csv, line 2",
            "\"A1\" does not say",
        ),
        (
            "column,item,condition,question\nr,BOL,made,realism\ns,BOL,made,realism\n",
            "map.csv, line 3",
            "the same question",
        ),
        (
            "column,item,condition,question\nr,BOL,made,realism\n",
            "map.csv",
            "no column of participants",
        ),
        ("column,what\nid,participant\n", "map.csv", "no column \"what\""),
        ("column,means\n,participant\n", "map.csv, line 2", "names no column"),
    ];
    for (text, place, message) in cases {
        let error = ColumnMap::read_column_map(text, "map.csv", &plan()).expect_err(text);
        let shown = error.to_string();
        assert!(shown.contains(message), "{shown}");
        assert_eq!(error.error_place().as_deref(), Some(place), "{shown}");
    }
    let mut findings = FileFindings::default();
    let error = read_wide_answers("id,r1,p1,r2,p3\n", "a.csv", &map(), &plan(), "sha", &mut findings).err();
    let shown = error.expect("refused").to_string();
    assert!(shown.contains("does not have: \"p2\"; did you mean"), "{shown}");
}

#[test]
fn the_use_of_each_column_is_shown_before_anything_is_stored() {
    let text = "id,r1,p1,r2,p2,since,other\n,A5,left,,,,x\n12,A1,,2,,,y\n";
    let (_, uses) =
        read_wide_answers(text, "a.csv", &map(), &plan(), "sha", &mut FileFindings::default()).expect("read");
    let shown: Vec<String> = uses
        .iter()
        .map(|it| {
            let (column, means, cells) = (&it.column, &it.means, it.cells);
            format!("{column}|{means}|{cells}|{}|{}", it.example, it.stands_for)
        })
        .collect();
    assert_eq!(
        shown,
        [
            "id|participant|1|12|",
            "r1|BOL · captured · realism|2|A5|5",
            "p1|BOL · captured · place|1|left|",
            "r2|BOL · made · realism|1|2|",
            "p2|BOL · made · place|0||",
            "since|profile.level|0||",
            "other||2|x|",
        ]
    );
}

#[test]
fn every_wrong_row_of_a_map_is_named() {
    let text = "column,item,condition,question,means\nid,,,,participant\nr1,BOL,mad,realism,\nx,,,,age\n";
    let Err(CorpusError::Several { errors, .. }) = ColumnMap::read_column_map(text, "m.csv", &plan()) else {
        panic!("two rows are wrong")
    };
    let places: Vec<_> = errors.iter().filter_map(CorpusError::error_place).collect();
    assert_eq!(places, ["m.csv, line 3", "m.csv, line 4"]);
}
