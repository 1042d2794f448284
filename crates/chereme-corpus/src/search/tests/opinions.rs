//! Opinions about a token: proposals of detectors, and what annotators say differently.

use super::*;
use crate::address::CorpusAddress;
use crate::details::ValueOpinion;
use crate::search::OpinionStanding;
use crate::tokens;
use crate::{AgreeOptions, ConflictDecision, ProgressReceiver, ignore_progress_step};

/// A tier of an annotator, with annotations of an origin in milliseconds.
struct Said<'a> {
    field: &'a str,
    annotator: &'a str,
    origin: AnnotationOrigin,
    values: &'a [(i64, i64, &'a str)],
}

/// Returns a corpus with a recording of one sign, from 0 to 1 s, with all these annotations.
fn corpus_of_one_sign(all: &[Said<'_>]) -> Sample {
    let mut sample = Sample::new();
    let recording = sample.recording("take", "Anna", "right");
    sample.tier(&tier(recording, "Gloss", "gloss"), &[(0, 1000, "CHIEN")]);
    for (place, said) in all.iter().enumerate() {
        let row = TierRow {
            name: format!("{} {place}", said.field),
            annotator: Some(said.annotator.to_owned()).filter(|name| !name.is_empty()),
            ..component_tier(recording, said.field)
        };
        sample.tier(&row, said.values);
        sample.work(|connection| {
            connection.execute(
                "UPDATE annotation SET origin = ?1, confidence = iif(?1 = 'detector', 0.9, NULL)
                 WHERE tier_id = (SELECT max(id) FROM tier)",
                [match said.origin {
                    AnnotationOrigin::Detector => "detector",
                    _ => "human",
                }],
            )?;
            Ok(())
        });
    }
    sample.work(|connection| tokens::update_recording_tokens(connection, recording, None, &[]));
    sample
}

fn by_person<'a>(annotator: &'a str, values: &'a [(i64, i64, &'a str)]) -> Said<'a> {
    Said {
        field: "right.configuration",
        annotator,
        origin: AnnotationOrigin::Human,
        values,
    }
}

/// Returns what counts, and after a bar what does not.
fn coding(sample: &mut Sample) -> String {
    let hit = sample.search("gloss=CHIEN").hits.remove(0);
    assert_eq!(hit.opinions, [], "they are not asked for");
    let counted = hit.components.iter().map(|(field, value)| format!("{field}={value}"));
    let counted: Vec<String> = counted.collect();
    let hit = sample
        .search("gloss=CHIEN (by=* or proposed:yes or token=1)")
        .hits
        .remove(0);
    let opinions = hit.opinions.iter().map(|one| {
        let (by, standing) = (one.by.as_deref().unwrap_or("-"), one.standing.standing_name());
        format!("{}={} {standing} {by}", one.field, one.value)
    });
    format!("{} | {}", counted.join(" "), opinions.collect::<Vec<_>>().join(", "))
}

#[test]
fn an_adjudication_counts_only_where_somebody_has_decided() {
    let disputed = " | right.configuration=flat disputed anna, right.configuration=5 disputed ben";
    for (decision, wanted) in [
        (
            ConflictDecision::Mine,
            "right.configuration=\"flat\" | right.configuration=flat agreed anna, right.configuration=5 replaced ben",
        ),
        (
            ConflictDecision::Theirs,
            "right.configuration=\"5\" | right.configuration=flat replaced anna, right.configuration=5 agreed ben",
        ),
    ] {
        let mut sample = corpus_of_one_sign(&[
            by_person("anna", &[(0, 1000, "flat")]),
            by_person("ben", &[(0, 1000, "5")]),
        ]);
        let options = AgreeOptions::new("right.configuration 0", "right.configuration 1");
        let mut hear = ignore_progress_step;
        let progress = &mut ProgressReceiver::new(&mut hear);
        let done = sample
            .corpus
            .adjudicate_tiers(&options, "both", progress)
            .expect("adjudicated");
        assert_eq!(done.conflicts, 1);
        assert_eq!(coding(&mut sample), disputed, "nobody has decided");
        sample.corpus.decide_conflicts(&[1], decision).expect("decided");
        assert_eq!(coding(&mut sample), wanted);
        sample.corpus.undo_operation().expect("undone");
        assert_eq!(coding(&mut sample), disputed, "the decision is undone");
    }
}

#[test]
fn a_proposal_that_a_person_corrected_leaves_its_neighbours_proposals() {
    let proposed = Said {
        field: "right.configuration",
        annotator: "",
        origin: AnnotationOrigin::Detector,
        values: &[(0, 500, "flat"), (500, 1000, "5")],
    };
    let mut sample = corpus_of_one_sign(&[proposed]);
    sample.work(|connection| {
        let sql = "UPDATE annotation SET origin = 'human', value = 'B' WHERE value = 'flat'";
        connection.execute(sql, [])?;
        tokens::update_recording_tokens(connection, 1, None, &[])
    });
    assert_eq!(
        coding(&mut sample),
        "right.configuration=\"B\" | right.configuration=5 proposed detector"
    );
}

#[test]
fn a_tier_of_proposals_that_a_file_brings_holds_proposals() {
    let mut sample = corpus_of_one_sign(&[by_person("anna", &[(0, 1000, "flat")])]);
    for (suffix, origin, wanted) in [
        ("(proposed)", "file", " | right.configuration=flat proposed detector"),
        ("(rejected)", "file", " | right.configuration=flat rejected detector"),
        // A person corrected it where it lies.
        ("(proposed)", "human", "right.configuration=\"flat\" | "),
        ("of proposed values", "file", "right.configuration=\"flat\" | "),
    ] {
        sample.work(|connection| {
            let name = format!("configuration right {suffix}");
            connection.execute("UPDATE tier SET name = ?1 WHERE component = 'configuration'", [name])?;
            connection.execute("UPDATE annotation SET origin = ?1 WHERE value = 'flat'", [origin])?;
            tokens::update_recording_tokens(connection, 1, None, &[])
        });
        assert_eq!(coding(&mut sample), wanted, "{suffix} {origin}");
    }
}

#[test]
fn two_annotators_are_two_readings_and_one_of_them_counts_or_none() {
    for (all, wanted) in [
        (
            &[
                by_person("anna", &[(0, 1000, "flat")]),
                by_person("ben", &[(0, 1000, "5")]),
            ][..],
            " | right.configuration=flat disputed anna, right.configuration=5 disputed ben",
        ),
        (
            &[
                by_person("anna", &[(0, 1000, "flat")]),
                by_person("ben", &[(10, 990, "flat")]),
            ],
            "right.configuration=\"flat\" | right.configuration=flat agreed ben",
        ),
        // Phase by phase.
        (
            &[
                by_person("anna", &[(0, 500, "flat"), (500, 1000, "5")]),
                by_person("ben", &[(0, 400, "flat"), (400, 1000, "S")]),
            ],
            "initial.right.configuration=\"flat\" | initial.right.configuration=flat agreed ben, \
             final.right.configuration=5 disputed anna, final.right.configuration=S disputed ben",
        ),
        (
            &[
                by_person("anna", &[(0, 1000, "flat")]),
                by_person("ben", &[(0, 1000, "5")]),
                by_person("adjudication", &[(0, 1000, "5")]),
            ],
            "right.configuration=\"5\" | right.configuration=flat replaced anna, right.configuration=5 agreed ben",
        ),
        // Copies of a tier without an annotator are opinions, too, and pieces on two tiers are one reading.
        (
            &[by_person("", &[(0, 1000, "flat")]), by_person("", &[(0, 1000, "5")])],
            " | right.configuration=flat disputed -, right.configuration=5 disputed -",
        ),
        (
            &[by_person("", &[(0, 500, "flat")]), by_person("", &[(500, 1000, "5")])],
            "final.right.configuration=\"5\" initial.right.configuration=\"flat\" | ",
        ),
    ] {
        assert_eq!(coding(&mut corpus_of_one_sign(all)), wanted);
    }
}

#[test]
fn the_annotator_whom_the_corpus_prefers_counts() {
    let all = [
        by_person("anna", &[(0, 1000, "flat")]),
        by_person("ben", &[(0, 1000, "5")]),
    ];
    let mut sample = corpus_of_one_sign(&all);
    assert_eq!(sample.search("disputed:yes").total, 1);
    sample.corpus.prefer_annotator(Some("ben")).expect("preferred");
    let preferred = "right.configuration=\"5\" | right.configuration=flat replaced anna";
    assert_eq!(coding(&mut sample), preferred);
    assert_eq!(sample.search("disputed:yes").total, 0);
    sample.corpus.prefer_annotator(None).expect("nobody is");
    assert_eq!(sample.search("disputed:yes").total, 1);
    assert!(
        sample.corpus.prefer_annotator(Some("zoe")).is_err(),
        "nobody has that name"
    );
}

#[test]
fn proposals_count_only_where_they_are_asked_for() {
    let proposal = Said {
        field: "right.placement",
        annotator: "",
        origin: AnnotationOrigin::Detector,
        values: &[(0, 1000, "chin")],
    };
    let mut sample = corpus_of_one_sign(&[by_person("anna", &[(0, 1000, "flat")]), proposal]);
    for (query, total) in [
        ("configuration=flat", 1),
        ("placement=*", 0),
        ("placement=unset", 1),
        ("placement=* proposed:yes", 1),
        ("placement=chin proposed=oui", 1),
        ("placement=chin by=detector", 1),
        ("placement=chin confidence>0.8", 1),
        ("placement=chin confidence>0.95", 0),
        ("configuration=flat by=anna", 1),
        ("proposed:no", 0),
        ("disputed:yes", 0),
        ("overlaps placement=chin", 0),
        ("proposed:yes overlaps placement=chin", 1),
    ] {
        let found = sample.corpus.search_tokens(query, &SearchOptions::default());
        // A value that nothing but a proposal has is unknown unless proposals are read.
        assert_eq!(found.map_or(0, |answer| answer.total), total, "{query}");
    }
    let answer = sample.search("proposed:yes");
    let opinion = ValueOpinion {
        detector: None,
        field: "right.placement".to_owned(),
        value: "chin".to_owned(),
        standing: OpinionStanding::Proposed,
        by: Some("detector".to_owned()),
        confidence: Some(0.9),
    };
    let address: CorpusAddress = format!("token:{}", answer.hits[0].token).parse().expect("an address");
    let details = sample.corpus.token_details(&address).expect("details");
    assert!(details.values.iter().all(|value| value.field != "right.placement"));
    assert_eq!(answer.hits[0].opinions, [opinion]);
    assert_eq!(details.opinions, answer.hits[0].opinions);
    assert!(!answer.facets.contains_key("right.placement"), "{:?}", answer.facets);
    assert_eq!(answer.facets["proposed"], [("yes".to_owned(), 1)]);
    // An index follows a proposal that changes, and one that a person makes their own.
    sample.work(|connection| {
        connection.execute("UPDATE annotation SET value = 'head' WHERE value = 'chin'", [])?;
        Ok(())
    });
    assert_eq!(sample.search("placement=head proposed:yes").total, 1);
}

#[test]
fn an_annotator_is_found_by_values_that_others_say_too_and_by_every_name() {
    let mut sample = corpus_of_one_sign(&[
        by_person("anna", &[(0, 500, "flat"), (500, 1000, "5")]),
        by_person("ben", &[(0, 500, "flat"), (500, 1000, "S")]),
        by_person("cleo", &[(0, 500, "flat"), (500, 1000, "5")]),
    ]);
    sample.work(|connection| {
        let person = "INSERT INTO signer (name) VALUES ('ben') ON CONFLICT DO NOTHING";
        connection.execute(person, [])?;
        let alias = "INSERT INTO person_alias (signer_id, name) SELECT id, 'coder 2' FROM signer WHERE name = 'ben'";
        connection.execute(alias, [])?;
        Ok(())
    });
    sample.corpus.prefer_annotator(Some("cleo")).expect("preferred");
    for (query, total) in [
        ("by=ben", 1),
        ("by=\"coder 2\"", 1),
        ("configuration=flat{by=ben}", 1),
        ("configuration=flat{by=\"coder 2\"}", 1),
        ("configuration=S{by=ben}", 1),
        ("configuration=5{by=ben}", 0),
        // Anna agrees with the value that counts, and nothing is in dispute.
        ("configuration=5{by=anna}", 1),
        ("configuration=5{by=cleo}", 1),
        ("configuration=S", 0),
        ("disputed:yes", 0),
    ] {
        let found = sample.corpus.search_tokens(query, &SearchOptions::default());
        assert_eq!(found.map_or(0, |answer| answer.total), total, "{query}");
    }
    let details = sample.corpus.token_details(&CorpusAddress::Token(1)).expect("details");
    let said = details
        .values
        .iter()
        .map(|value| (value.field.as_str(), value.by.join(",")));
    let said: Vec<(&str, String)> = said.collect();
    let wanted = [
        ("initial.right.configuration", "cleo,anna,ben".to_owned()),
        ("final.right.configuration", "cleo,anna".to_owned()),
    ];
    assert_eq!(said, wanted);
    let replaced: Vec<_> = details
        .opinions
        .iter()
        .map(|one| (one.value.as_str(), one.standing))
        .collect();
    assert_eq!(replaced, [("S", OpinionStanding::Replaced)]);
}

#[test]
fn tokens_of_an_older_program_lack_what_others_say_of_a_counting_value_and_are_well() {
    let mut sample = corpus_of_one_sign(&[
        by_person("anna", &[(0, 1000, "flat")]),
        by_person("ben", &[(0, 1000, "flat")]),
    ]);
    for (change, faults) in [
        ("DELETE FROM token_value WHERE standing = 'agreed'", 0),
        ("UPDATE token_value SET value = '5' WHERE value = 'flat'", 1),
    ] {
        sample.work(|connection| {
            assert_eq!(connection.execute(change, [])?, 1, "{change}");
            Ok(())
        });
        let mut hear = ignore_progress_step;
        let report = sample.corpus.check_corpus(false, &mut ProgressReceiver::new(&mut hear));
        let report = report.expect("checked");
        let of_tokens = report.all_findings().filter(|fault| fault.kind == "tokens");
        assert_eq!(of_tokens.count(), faults, "{change}");
    }
}

#[test]
fn braces_ask_who_says_this_very_value() {
    let proposal = Said {
        field: "right.placement",
        annotator: "",
        origin: AnnotationOrigin::Detector,
        values: &[(0, 1000, "chin")],
    };
    let all = [
        by_person("anna", &[(0, 1000, "flat")]),
        by_person("ben", &[(0, 1000, "5")]),
        proposal,
    ];
    let mut sample = corpus_of_one_sign(&all);
    for (query, total) in [
        // Of the token as a whole: anna says something of it, and somebody says 5.
        ("configuration=5 by=anna", 1),
        ("configuration=5{by=anna}", 0),
        ("configuration=5{by=ben}", 1),
        ("right.configuration=5{by=b*}", 1),
        ("left.configuration=5{by=ben}", 0),
        ("initial.configuration=5{by=ben}", 1),
        ("configuration!=5{by=anna}", 1),
        ("configuration!=5{by=ben}", 0),
        ("not configuration=5{by=anna}", 1),
        ("configuration=*{by!=anna}", 1),
        ("configuration=5{disputed:yes}", 1),
        ("configuration=5{proposed:yes}", 0),
        ("configuration=5{confidence>0.1}", 0),
        ("placement=chin{proposed:yes confidence>0.8}", 1),
        ("placement=chin{proposed:yes confidence>0.95}", 0),
        ("placement=chin{by=detector}", 1),
        ("placement=chin{proposed:no}", 0),
        // Opinions about other components do not count because one is asked for.
        ("placement=chin{by=detector} configuration=*", 0),
        ("placement=chin{by=detector} configuration=5{by=ben}", 1),
    ] {
        assert_eq!(sample.search(query).total, total, "{query}");
    }
    let answer = sample.search("configuration=5{by=ben}");
    assert_eq!(answer.query, "configuration=5{by=ben}");
    let shown: Vec<&str> = answer.hits[0].opinions.iter().map(|one| one.value.as_str()).collect();
    assert_eq!(shown, ["flat", "5", "chin"]);
    let error = sample
        .corpus
        .search_tokens("configuration=5{by=bem}", &SearchOptions::default());
    let message = error.expect_err("nobody has that name").to_string();
    assert!(message.contains("no annotator is called \"bem\""), "{message}");
    // A preferred annotator's value counts, and is still said by them.
    sample.corpus.prefer_annotator(Some("ben")).expect("preferred");
    assert_eq!(sample.search("configuration=5{by=ben disputed:no}").total, 1);
}
