//! One small corpus, and what each construct of the language finds in it.

use super::*;
use crate::CorpusError;
use crate::progress::{ProgressReceiver, ignore_progress_step};
use crate::search::{FindingKind, HitOrder, QueryFinding, TallyRow, ValueTally};

/// Two recordings of two signers and a lexicon; the glosses name the case.
fn sample() -> Sample {
    let mut sample = Sample::new();
    let one = sample.recording("Session 1", "Anna", "right");
    let two = sample.recording("Session 2", "Ben", "left");
    let values = ["right.configuration=U", "right.placement=chin", "movement=arc"];
    sample.token("CHAT", Some((one, 0, 500)), &values);
    let values = [
        "right.configuration=B",
        "left.configuration=S",
        "initial.right.placement=neutral",
        "final.right.placement=chest",
        "movement.direction=up",
    ];
    sample.token("BOL-2H", Some((one, 600, 1400)), &values);
    let values = ["right.configuration=unclear", "right.placement=n/a"];
    sample.token("MAISON", Some((one, 1400, 3400)), &values);
    let values = ["left.configuration=U", "left.placement=head", "nonmanual.brows=raised"];
    sample.token("INDEX:1", Some((two, 100, 300)), &values);
    let values = [
        "initial.both.configuration=S",
        "middle.both.configuration=5",
        "middle2.both.configuration=B",
        "final.both.configuration=S",
        "nonmanual.brows=furrowed",
    ];
    sample.token("ÉCOLE", Some((two, 1000, 2000)), &values);
    sample.token("BOL", None, &["dominant.configuration=B", "both.placement=neutral"]);
    sample.token("ESCARGOT", None, &[]);
    sample.work(|connection| {
        for (gloss, language, text) in [
            ("CHAT", "en", "cat"),
            ("ESCARGOT", "en", "the slow animal"),
            ("ÉCOLE", "fr", "l’école, où l'on apprend"),
            ("BOL", "en", "bowl"),
        ] {
            let sign = signs::sign_of_annotation(connection, None, gloss)?;
            signs::add_text(connection, sign, language, text)?;
        }
        connection.execute("UPDATE sign SET notes = 'seen in Lyon' WHERE gloss = 'BOL'", [])?;
        connection.execute("UPDATE token SET hand = 'right' WHERE id = 1", [])?;
        connection.execute("UPDATE token SET hand = 'both' WHERE id = 2", [])?;
        Ok(())
    });
    sample.tier(
        &tier(one, "Traduction", "translation"),
        &[(0, 1500, "The cat is in the bowl"), (1500, 4000, "A house for animals")],
    );
    sample.tier(&tier(one, "Remarks", "comment"), &[(1400, 1500, "blurred, slow")]);
    sample.tier(
        &component_tier(one, "nonmanual.brows"),
        &[(400, 700, "raised"), (1400, 3400, "furrowed"), (3400, 3500, "")],
    );
    sample.tier(
        &component_tier(two, "dominant.configuration"),
        &[(100, 300, "U"), (1200, 1800, "S")],
    );
    sample.tier(
        &tier(two, "Mouthing", "free"),
        &[(150, 250, "moi"), (900, 1100, "école")],
    );
    sample
}

#[test]
fn every_construct_finds_its_listed_tokens() {
    let mut sample = sample();
    let mut failures = Vec::new();
    for line in TABLE.lines().filter(|line| !line.trim().is_empty()) {
        let (query, wanted) = line.split_once("=>").expect("query => glosses");
        let query = query.trim();
        let found = match sample.corpus.search_tokens(query, &SearchOptions::default()) {
            Ok(answer) => {
                let glosses: Vec<String> = answer.hits.into_iter().map(|hit| hit.gloss).collect();
                assert_eq!(answer.total, glosses.len());
                glosses.join(" ")
            }
            Err(error) => error.to_string(),
        };
        if found != wanted.trim() {
            failures.push(format!("{query} => {found}\n  wanted {wanted}"));
        }
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

const TABLE: &str = r#"
    => CHAT BOL-2H MAISON INDEX:1 ÉCOLE BOL ESCARGOT
right.configuration=U => CHAT
configuration=U => CHAT INDEX:1
dominant.configuration=U => CHAT INDEX:1
weak.configuration=S => BOL-2H ÉCOLE
left.configuration=s => BOL-2H ÉCOLE
configuration=U,S => CHAT BOL-2H INDEX:1 ÉCOLE
right.configuration=B => BOL-2H ÉCOLE BOL
final.configuration=B => BOL-2H BOL
final.configuration=S => BOL-2H ÉCOLE
initial.right.placement=neutral => BOL-2H BOL
final.right.placement=neutral => BOL
final.placement=chest => BOL-2H
middle.configuration=5 => ÉCOLE
middle2.configuration=B => ÉCOLE
middle.configuration=B =>
placement=head => CHAT INDEX:1
placement==head => INDEX:1
placement==chin => CHAT
placement=Tête => CHAT INDEX:1
placement==tête => INDEX:1
placement=menton => CHAT
placement=ch* => CHAT BOL-2H
placement!=head => BOL-2H BOL
not placement=head => BOL-2H MAISON ÉCOLE BOL ESCARGOT
placement=* => CHAT BOL-2H INDEX:1 BOL
placement=unset => ÉCOLE ESCARGOT
placement=n/a => MAISON
placement=unclear =>
configuration=unclear => MAISON
configuration!=unclear => CHAT BOL-2H INDEX:1 ÉCOLE BOL ESCARGOT
left.placement=unset => CHAT BOL-2H MAISON ÉCOLE ESCARGOT
placement=unset,n/a => MAISON ÉCOLE ESCARGOT
configuration=[index middle -thumb] => CHAT BOL-2H INDEX:1 ÉCOLE BOL
configuration=[index middle -ring] => CHAT INDEX:1
configuration==[index middle] =>
movement=arc => CHAT
movement=up => BOL-2H
movement.direction=up => BOL-2H
movement=* => CHAT
movement.direction=* => BOL-2H
movement=unset => BOL-2H MAISON INDEX:1 ÉCOLE BOL ESCARGOT
nonmanual=raised => INDEX:1
nonmanual.brows=raised,furrowed => INDEX:1 ÉCOLE
configuration=U placement=chin => CHAT
configuration=U or configuration=B placement=chest => CHAT BOL-2H INDEX:1
configuration=B not (placement=neutral or gloss=ÉCOLE) =>
not configuration=* not origin=lexicon => MAISON
gloss=bol => BOL
gloss=BOL-2H => BOL-2H
gloss:BOL => BOL BOL-2H
gloss:BO* => BOL-2H BOL
gloss:2h => BOL-2H
gloss:MA*SON => MAISON
gloss=*O* => BOL-2H MAISON ÉCOLE BOL ESCARGOT
gloss=ecole => ÉCOLE
gloss==ecole =>
gloss==ÉCOLE => ÉCOLE
gloss==É* => ÉCOLE
gloss!=bol => CHAT BOL-2H MAISON INDEX:1 ÉCOLE ESCARGOT
gloss=INDEX:1 => INDEX:1
gloss:INDEX => INDEX:1
gloss~ESCARGO => ESCARGOT
gloss~ESCRGO~2 => ESCARGOT
gloss~BAL => BOL BOL-2H
slow => ESCARGOT MAISON
"slow animal" => ESCARGOT
"slow ani*" => ESCARGOT
slow animal* => ESCARGOT MAISON
"animal slow" =>
cat => CHAT BOL-2H MAISON
translation:bowl => CHAT BOL-2H MAISON BOL
translation=bowl => BOL
translation=BOWL => BOL
translation==BOWL =>
translation=bo* => BOL
translation="l'ecole ou l'on apprend" =>
translation="l'ecole, ou l'on apprend" => ÉCOLE
translation=unset => INDEX:1
translation!=bowl => CHAT BOL-2H MAISON ÉCOLE ESCARGOT
comment=* => MAISON BOL
comment:lyon => BOL
text=bol => BOL
translation~animel => ESCARGOT
translation~animel~2 => MAISON ESCARGOT
duration<0.5s => INDEX:1
duration<=0.5s => CHAT INDEX:1
duration=0.5s..1s => CHAT BOL-2H ÉCOLE
start>=1s => MAISON ÉCOLE
end<=300ms => INDEX:1
origin=lexicon => BOL ESCARGOT
origin=notated => BOL ESCARGOT
origin!=lexicon => CHAT BOL-2H MAISON INDEX:1 ÉCOLE
signer=ben => INDEX:1 ÉCOLE
signer=unset => BOL ESCARGOT
recording="session 1" => CHAT BOL-2H MAISON
recording=2 => INDEX:1 ÉCOLE
recording=*2 => INDEX:1 ÉCOLE
recording!=2 => CHAT BOL-2H MAISON
sign=BOL => BOL
token=2 => BOL-2H
hand=right => CHAT
hand=dominant => CHAT INDEX:1
hand=both => BOL-2H ÉCOLE BOL
hand=unset => MAISON ESCARGOT
overlaps nonmanual.brows=raised => CHAT BOL-2H INDEX:1
not-overlaps nonmanual.brows=raised => MAISON ÉCOLE
inside nonmanual.brows=furrowed => MAISON ÉCOLE
equals nonmanual.brows=furrowed => MAISON ÉCOLE
not-inside nonmanual.brows=furrowed => CHAT BOL-2H INDEX:1
overlaps-begin nonmanual.brows=raised => CHAT
overlaps-end nonmanual.brows=raised => BOL-2H
before nonmanual.brows=furrowed => CHAT BOL-2H INDEX:1
after nonmanual.brows=raised => MAISON ÉCOLE
meets nonmanual.brows=furrowed => BOL-2H
met-by gloss=BOL-2H => MAISON
covers dominant.configuration=S => ÉCOLE
covers right.configuration=S => ÉCOLE
covers left.configuration=S => BOL-2H ÉCOLE
within 0.2s around nonmanual.brows=raised => INDEX:1
within 0.6s of-begin nonmanual.brows=raised => CHAT INDEX:1
before gloss=MAISON => CHAT BOL-2H
after gloss:bo* => MAISON
overlaps gloss=CHAT =>
overlaps translation:house => MAISON
inside translation:cat => CHAT BOL-2H
overlaps comment:slow => MAISON
not overlaps nonmanual.brows=* => BOL ESCARGOT
tier("Mouthing")=moi => INDEX:1
tier(mouth*)=* => INDEX:1 ÉCOLE
tier(Mouthing)=unset => CHAT BOL-2H MAISON BOL ESCARGOT
tier(Mouthing)!=moi => ÉCOLE
starts tier(Mouthing)=moi =>
covers tier(Mouthing)=moi => INDEX:1
gloss=CHAT overlaps nonmanual.brows=raised => CHAT
like token:1 => CHAT INDEX:1 BOL-2H MAISON ÉCOLE BOL ESCARGOT
like CHAT on configuration => CHAT INDEX:1 BOL-2H MAISON ÉCOLE BOL ESCARGOT
like BOL on right.configuration origin=captured => BOL-2H CHAT MAISON INDEX:1 ÉCOLE
like CHAT on configuration above 0.5 => CHAT INDEX:1
like CHAT on configuration above 0.5 not gloss=CHAT => INDEX:1
like CHAT on configuration:3, placement above 0.8 => CHAT
placement=neutral > chest => BOL-2H
placement=neutral>trunk => BOL-2H
placement==neutral > trunk =>
placement=neutral > * => BOL-2H
placement=* > chest => BOL-2H
placement=chest > neutral =>
placement=chin > * =>
left.placement=neutral > chest =>
right.placement=neutral > chest,chin => CHAT BOL-2H
not placement=neutral > * => CHAT MAISON INDEX:1 ÉCOLE BOL ESCARGOT
configuration=S > 5 > S => ÉCOLE
configuration=S > B > S => ÉCOLE
configuration=S > 5 > B > S => ÉCOLE
configuration=S > B > 5 =>
weak.configuration=* > [index middle] => ÉCOLE
gloss=/^BO.*/ => BOL-2H BOL
gloss=/^bo/ => BOL-2H BOL
gloss==/^bo/ =>
gloss~/-[0-9]H$/ => BOL-2H
gloss=/^éc/ => ÉCOLE
gloss=/^ec/ => ÉCOLE
gloss!=/O/ => CHAT INDEX:1
translation=/^the (slow|fast)/ => ESCARGOT
translation=/bowl$/ => CHAT BOL-2H MAISON BOL
comment=/lyon|blurred/ => MAISON BOL
text=/slow/ => MAISON ESCARGOT
configuration=/^[BU]$/ => CHAT BOL-2H INDEX:1 ÉCOLE BOL
tier(/^Mouth/)=/^m/ => INDEX:1
signer=/^a/ => CHAT BOL-2H MAISON
placement=menton ou placement=poitrine => CHAT BOL-2H
non configuration=* et non origin=lexicon => MAISON
gloss=CHAT chevauche nonmanuel.brows=raised => CHAT
like BOL-2H on final.placement, configuration:2 => BOL-2H ÉCOLE BOL CHAT MAISON INDEX:1 ESCARGOT
"#;

#[test]
fn unknown_values_and_fields_are_pointed_at() {
    let mut sample = sample();
    for (query, character, part) in [
        ("placement=chim", 11, "did you mean chin?"),
        ("right.configuration=U placement=xyzzy", 33, "in no inventory"),
        ("nonmanual.brwos=raised", 11, "did you mean brows?"),
        ("configuration=[indx]", 16, "did you mean index?"),
        ("configuration=[-indx]", 17, "did you mean index?"),
        ("signer=Bem", 8, "did you mean Ben?"),
        ("recording=\"Session 3\"", 11, "did you mean \"Session 1\"?"),
        ("overlaps nonmanual.brows=razed", 26, "did you mean raised?"),
        ("not like token:1", 5, "orders the whole answer"),
        ("like CHAR", 6, "did you mean CHAT?"),
        ("like token:99", 6, "there is no token:99"),
        ("token=x", 7, "no number"),
        ("inventory=placement", 11, "did you mean placements?"),
        ("gloss=", 7, "a value should stand here"),
    ] {
        let error = sample.corpus.search_tokens(query, &SearchOptions::default());
        let error = error.expect_err(query);
        assert!(matches!(error, CorpusError::Query(_)));
        assert_eq!(error.error_place(), Some(format!("character {character}")), "{query}");
        let text = error.to_string();
        assert!(text.contains(part), "{query}: {text}");
        assert!(text.starts_with(query) && text.contains('^'), "{text}");
    }
}

/// Queries with the expected findings about their conditions, each as kind, condition and names.
const FOUND: &str = r#"
placement=head => widened placement=head: chin
placement==head =>
placement=chin =>
placement=trunk => widened placement=trunk: chest
placement=ch* => matched placement=ch*: chest chin
configuration=[index middle -ring] => matched configuration=[index middle -ring]: U
movement=circle => cannot-match movement=circle: arc
movement.shape=circle => error
left.placement=chest => cannot-match left.placement=chest: head neutral
orientation.palm=up => not-coded orientation.palm=up:
orientation=* => not-coded orientation=*:
not orientation.palm=up => not-coded orientation.palm=up:
gloss=CHATS => cannot-match gloss=CHATS: CHAT
gloss=X* => cannot-match gloss=X*:
gloss=/^X/ => cannot-match gloss=/^X/:
gloss=/^BOLL/ => cannot-match gloss=/^BOLL/: BOL
tier(nosuch)=x => cannot-match tier("nosuch")=x: Mouthing Remarks Traduction dominant.configuration nonmanual.brows
overlaps tier(Mouth)=* => cannot-match tier("Mouth")=*: Mouthing
tier(Mouthing)=moo => cannot-match tier("Mouthing")=moo:
zebra => cannot-match zebra:
CHATS => cannot-match CHATS: CHAT
gloss:CHATS => cannot-match gloss:CHATS: CHAT
text=/^BOLL/ => cannot-match text=/^BOLL/: BOL
placement=head or placement=head => widened placement=head: chin
gloss=CHAT or zebra => cannot-match zebra:
gloss=CHAT or gloss:zeb* => cannot-match gloss:zeb*:
configuration=U placement=chest => none-together configuration=U placement=chest: configuration=U 2 placement=chest 1
configuration=U > S => cannot-match configuration=U > S:
configuration=U placement=chin =>
"#;

#[test]
fn an_answer_reports_widened_matched_and_impossible_conditions() {
    let mut sample = sample();
    let mut failures = Vec::new();
    for line in FOUND.lines().filter(|line| !line.trim().is_empty()) {
        let (query, wanted) = line.split_once(" =>").expect("query => findings");
        let found = sample.corpus.search_tokens(query, &SearchOptions::default());
        let found = match found {
            Ok(answer) => answer.findings.iter().map(shown).collect::<Vec<_>>().join(" | "),
            Err(_) => "error".to_owned(),
        };
        if found != wanted.trim() {
            failures.push(format!("{query} => {found}\n  wanted {wanted}"));
        }
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
    let answer = sample.search("placement=head");
    let json = serde_json::to_value(&answer.findings).expect("json");
    let wanted = serde_json::json!([{
        "kind": "widened",
        "condition": "placement=head",
        "at": [10, 14],
        "message": "placement=head counts narrower values, too: chin; == counts the value alone",
        "values": ["chin"],
    }]);
    assert_eq!(json, wanted);
}

fn shown(finding: &QueryFinding) -> String {
    let names: Vec<String> = match &finding.kind {
        FindingKind::Widened { values } | FindingKind::Matched { values } => values.clone(),
        FindingKind::CannotMatch { names, .. } => names.clone(),
        FindingKind::Equal { values, .. } => {
            let counted = |(value, count): &(String, usize)| format!("{value} ({count})");
            values.iter().map(counted).collect()
        }
        FindingKind::NotCoded { .. } => Vec::new(),
        FindingKind::NoneTogether { terms } => terms.iter().map(|(term, count)| format!("{term} {count}")).collect(),
    };
    let text = format!("{} {}: {}", finding.kind_name(), finding.condition, names.join(" "));
    text.trim_end().to_owned()
}

#[test]
fn values_are_counted_by_one_field_and_by_two() {
    let mut sample = sample();
    let mut tally = |query: &str, fields: &[&str]| {
        let fields: Vec<String> = fields.iter().map(|it| (*it).to_owned()).collect();
        let mut hear = ignore_progress_step;
        sample
            .corpus
            .tally_values(query, &fields, &mut ProgressReceiver::new(&mut hear))
    };
    let rows = |tally: &ValueTally| -> Vec<String> {
        let row = |row: &TallyRow| format!("{} {} {:?}", row.value, row.total, row.counts);
        tally.rows.iter().map(row).collect()
    };
    let one = tally("origin=captured", &["placement"]).expect("counted");
    assert_eq!(one.total, 5);
    assert_eq!(
        rows(&one),
        [
            "chest 1 []",
            "chin 1 []",
            "head 1 []",
            "neutral 1 []",
            "n/a 1 []",
            "unset 1 []"
        ]
    );
    let two = tally("", &["configuration", "signer"]).expect("counted");
    assert_eq!(two.columns, ["Anna", "Ben", "unset"]);
    assert_eq!(
        rows(&two),
        [
            "B 3 [1, 1, 1]",
            "S 2 [1, 1, 0]",
            "U 2 [1, 1, 0]",
            "5 1 [0, 1, 0]",
            "unclear 1 [1, 0, 0]",
            "unset 1 [0, 0, 1]",
        ]
    );
    // Counts of two corpora stand together as if all tokens were in one.
    let mut sum = tally("signer=Ben", &["configuration", "signer"]).expect("counted");
    sum.add_tally(tally("not signer=Ben", &["configuration", "signer"]).expect("counted"));
    assert_eq!(
        (sum.total, &sum.columns, &sum.rows),
        (two.total, &two.columns, &two.rows)
    );
    for (fields, part) in [
        (&["nosuch"][..], "there is no field or attribute"),
        (&["duration"], "are not counted"),
        (&["translation"], "are not counted"),
        (&["gloss", "signer", "hand"], "one field or of two"),
        (&[], "one field or of two"),
    ] {
        let error = tally("", fields).expect_err("refused").to_string();
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn the_count_of_a_facet_is_what_its_condition_leaves() {
    let mut sample = sample();
    let mut asked = 0;
    for query in ["", "movement=arc or configuration=*", "not placement=chin"] {
        let answer = sample.search(query);
        for (field, values) in &answer.facets {
            for (value, count) in values {
                let Some(condition) = chereme_sign::query::facet_condition(field, value) else {
                    continue;
                };
                let narrowed = match query {
                    "" => condition.clone(),
                    query => format!("({query}) {condition}"),
                };
                assert_eq!(sample.search(&narrowed).total, *count, "{narrowed}");
                asked += 1;
            }
        }
    }
    assert!(asked > 50, "{asked}");
}

#[test]
fn facets_count_the_values_that_they_leave_out() {
    let mut sample = sample();
    let mut facets = |most| {
        let options = SearchOptions {
            facet_values: most,
            ..SearchOptions::default()
        };
        sample.corpus.search_tokens("", &options).expect("found")
    };
    let all = facets(usize::MAX);
    assert!(all.facets_left_out.is_empty());
    assert_eq!(all.facets["gloss"].len(), 7);
    let few = facets(2);
    for (field, values) in &few.facets {
        let left = few.facets_left_out.get(field).copied().unwrap_or(0);
        assert_eq!(values.len() + left, all.facets[field].len(), "{field}");
        assert_eq!(values[..], all.facets[field][..values.len()], "{field}");
    }
    assert_eq!(few.facets_left_out["gloss"], 5);
}

#[test]
fn an_answer_is_json_as_scripts_expect_it() {
    let mut sample = sample();
    let options = SearchOptions {
        limit: Some(1),
        offset: 1,
        ..SearchOptions::default()
    };
    let answer = sample.corpus.search_tokens("configuration=B", &options).expect("found");
    let json = serde_json::to_value(&answer).expect("json");
    let wanted = serde_json::json!({
        "query": "configuration=B",
        "total": 3,
        "hits": [{
            "token": 5,
            "gloss": "ÉCOLE",
            "recording": "Session 2",
            "start_us": 1_000_000,
            "end_us": 2_000_000,
            "origin": "captured",
            "components": {
                "final.both.configuration": "S",
                "initial.both.configuration": "S",
                "middle.both.configuration": "5",
                "middle2.both.configuration": "B",
                "nonmanual.brows": "furrowed",
            },
        }],
        "facets": {
            "both.configuration": { "5": 1, "B": 1, "S": 1 },
            "both.placement": { "neutral": 1 },
            "dominant.configuration": { "5": 1, "B": 3, "S": 1 },
            "gloss": { "BOL": 1, "BOL-2H": 1, "ÉCOLE": 1 },
            "hand": { "both": 3 },
            "left.configuration": { "5": 1, "B": 1, "S": 2 },
            "movement.direction": { "up": 1 },
            "nonmanual.brows": { "furrowed": 1 },
            "recording": { "Session 1": 1, "Session 2": 1 },
            "right.configuration": { "5": 1, "B": 3, "S": 1 },
            "right.placement": { "chest": 1, "neutral": 2 },
            "signer": { "Anna": 1, "Ben": 1 },
        },
    });
    assert_eq!(json, wanted);
}

#[test]
fn hits_are_ordered_by_the_requested_order_with_scores() {
    let mut sample = sample();
    let mut in_order = |query: &str, order| {
        let options = SearchOptions {
            order,
            ..SearchOptions::default()
        };
        sample.corpus.search_tokens(query, &options).expect("found").hits
    };
    let glosses =
        |hits: Vec<super::super::SearchHit>| -> Vec<String> { hits.into_iter().map(|hit| hit.gloss).collect() };
    let by_gloss = glosses(in_order("", HitOrder::Gloss));
    let wanted = ["BOL", "BOL-2H", "CHAT", "ÉCOLE", "ESCARGOT", "INDEX:1", "MAISON"];
    assert_eq!(by_gloss, wanted);
    let longest = glosses(in_order("origin=captured", HitOrder::Duration));
    assert_eq!(longest, ["MAISON", "ÉCOLE", "BOL-2H", "CHAT", "INDEX:1"]);
    assert_eq!(glosses(in_order("slow", HitOrder::Place)), ["MAISON", "ESCARGOT"]);
    let like = in_order("like CHAT on configuration:3, placement", HitOrder::Rank);
    let scores: Vec<Option<f64>> = like.iter().map(|hit| hit.score).collect();
    assert_eq!(scores[..3], [Some(1.0), Some(0.75), Some(0.0)]);
}

#[test]
fn edits_and_their_undoing_show_at_once() {
    let mut sample = sample();
    assert_eq!(sample.glosses("gloss=CHIEN"), "");
    sample.token("CHIEN", None, &["right.configuration=zzz"]);
    assert_eq!(sample.glosses("configuration=zzz"), "CHIEN");
    sample.corpus.undo_operation().expect("undone");
    assert_eq!(sample.glosses("gloss=CHIEN"), "");
    assert!(
        !sample.search("").facets["right.configuration"]
            .iter()
            .any(|it| it.0 == "zzz")
    );
    sample.corpus.redo_operation().expect("done again");
    assert_eq!(sample.glosses("configuration=zzz"), "CHIEN");
    sample.work(|connection| {
        connection.execute("UPDATE signer SET handedness = 'left' WHERE name = 'Anna'", [])?;
        Ok(())
    });
    assert_eq!(sample.glosses("dominant.configuration=U"), "INDEX:1");
    assert!(sample.search("").notes.is_empty());
}

#[test]
fn another_program_that_writes_is_noticed() {
    let mut sample = sample();
    assert_eq!(sample.glosses("gloss=CHIEN"), "");
    let mut other = Corpus::open_corpus(&sample.path(), "B").expect("opened");
    std::mem::swap(&mut other, &mut sample.corpus);
    sample.token("CHIEN", None, &["right.placement=chin"]);
    std::mem::swap(&mut other, &mut sample.corpus);
    assert_eq!(sample.glosses("gloss=CHIEN"), "CHIEN");
    assert!(sample.search("").notes.is_empty());
    let foreign = rusqlite::Connection::open(sample.path()).expect("opened");
    foreign
        .execute("INSERT INTO token (sign_id, origin) VALUES (1, 'made')", [])
        .expect("written");
    let answer = sample.search("origin=made");
    assert_eq!((answer.total, answer.notes.len()), (1, 1));
    assert!(sample.search("").notes.is_empty());
}

#[test]
fn a_lost_or_outdated_index_is_rebuilt() {
    let damage = [
        "DELETE FROM search_file",
        "DELETE FROM search_file WHERE path LIKE '%.term'",
        "UPDATE search_file SET data = zeroblob(length(data))",
        "UPDATE search_file SET data = x'' WHERE path = 'meta.json'",
        "UPDATE search_state SET content = content + 1, indexed = indexed + 1",
        "UPDATE search_state SET format = 0",
    ];
    let mut sample = sample();
    for sql in damage {
        let foreign = rusqlite::Connection::open(sample.path()).expect("opened");
        foreign.execute(sql, []).expect("damaged");
        drop(foreign);
        sample.corpus = Corpus::open_corpus(&sample.path(), "B").expect("opened");
        let answer = sample.search("configuration=B");
        assert_eq!((answer.total, answer.notes.len()), (3, 1), "{sql}");
        sample.corpus = Corpus::open_corpus(&sample.path(), "B").expect("opened");
        let answer = sample.search("configuration=B");
        assert_eq!((answer.total, answer.notes.len()), (3, 0), "{sql}");
    }
}

#[test]
fn a_failed_operation_leaves_no_trace_in_the_index() {
    let mut sample = sample();
    let failed: CorpusResult<()> = sample.corpus.store.named_operation("fail", |connection| {
        let sign_id = signs::sign_of_annotation(connection, None, "CHIEN")?;
        let row = TokenRow {
            sign_id,
            origin: crate::RecordOrigin::Lexicon,
            ..TokenRow::default()
        };
        signs::insert_token(connection, &row)?;
        Err(CorpusError::from_wrong_message("no"))
    });
    assert!(failed.is_err());
    assert_eq!(sample.glosses("gloss=CHIEN"), "");
    sample.corpus = Corpus::open_corpus(&sample.path(), "B").expect("opened");
    let answer = sample.search("");
    assert_eq!((answer.total, answer.notes.len()), (7, 0));
}
