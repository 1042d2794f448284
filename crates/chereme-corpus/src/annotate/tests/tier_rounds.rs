//! Tests of work on the tiers of many recordings.

use super::*;

/// Returns a corpus with "Take 1" and its tiers, "Take 2" with the tier `G` alone and "Other" without tiers.
fn three_recordings() -> (tempfile::TempDir, Corpus) {
    let (folder, mut corpus) = corpus();
    corpus
        .store
        .named_operation("fill", |connection| {
            for name in ["Take 2", "Other"] {
                let name = name.to_owned();
                let empty = RecordingRow {
                    name,
                    ..stored_recordings::load_recording_row(connection, 1)?
                };
                stored_recordings::insert_recording(connection, &empty)?;
            }
            Ok(((), String::new()))
        })
        .expect("recordings");
    let gloss = NewTier::new(RowName::Text("Take 2".to_owned()), "G", TierRole::Gloss);
    corpus.add_tier(&gloss).expect("a tier");
    (folder, corpus)
}

fn work_on(
    corpus: &mut Corpus,
    scope: &TierRoundScope,
    work: &TierRoundWork,
    options: TierRoundOptions,
) -> CorpusResult<TierRoundReport> {
    let mut hear = ignore_progress_step;
    corpus.work_on_tiers(scope, work, options, &mut ProgressReceiver::new(&mut hear))
}

/// Returns the recordings with the tiers that changed in them.
fn changed_tiers(report: &TierRoundReport) -> Vec<String> {
    let row = |row: &TierRoundRow| match row.refused {
        Some(_) => format!("{} refuses", row.name),
        None => format!("{}: {}", row.name, row.tiers.join(" ")),
    };
    report.recordings.iter().map(row).collect()
}

#[test]
fn tiers_of_many_recordings_are_added_renamed_copied_and_removed_in_one_step_each() {
    let (_folder, mut corpus) = three_recordings();
    let start = rows(corpus.store.read_connection());
    let (all, options) = (TierRoundScope::All, TierRoundOptions::default());
    let takes = TierRoundScope::Pattern("take*".to_owned());
    let mouth = NewTier::new(RowName::Number(0), "mouth", TierRole::Free);
    let rename = TierPropertyChange {
        name: Some("Gloss-R".to_owned()),
        ..TierPropertyChange::default()
    };
    let copied = CopiedAnnotations::All;
    let (tier, name) = ("G".to_owned(), "G-2".to_owned());
    let like = TierScheme::Like(RowName::Text("Take 1".to_owned()));
    for (scope, work, wanted) in [
        (
            &all,
            TierRoundWork::Add(mouth),
            &["Take 1: mouth", "Take 2: mouth", "Other: mouth"][..],
        ),
        (
            &takes,
            TierRoundWork::Copy { tier, name, copied },
            &["Take 1: G", "Take 2: G"],
        ),
        (
            &all,
            TierRoundWork::Change {
                tier: "g".to_owned(),
                change: rename,
            },
            &["Take 1: G", "Take 2: G"],
        ),
        (&takes, TierRoundWork::AddScheme(like), &["Take 2: T I S A H C L"]),
        (
            &takes,
            TierRoundWork::Remove { tier: "Gl*".to_owned() },
            &["Take 1: Gloss-R T I S A", "Take 2: Gloss-R T I S A"],
        ),
    ] {
        let before = rows(corpus.store.read_connection());
        let tried = TierRoundOptions {
            dry_run: true,
            ..options
        };
        let tried = work_on(&mut corpus, scope, &work, tried).expect("tried");
        assert_eq!(rows(corpus.store.read_connection()), before, "a dry run writes nothing");
        let done = work_on(&mut corpus, scope, &work, options).expect("done");
        assert_eq!(tried.recordings, done.recordings);
        assert_eq!(changed_tiers(&done), wanted);
    }
    for _ in 0..5 {
        corpus.undo_operation().expect("undone");
    }
    assert_eq!(rows(corpus.store.read_connection()), start);
}

#[test]
fn nothing_is_done_if_a_recording_refuses_unless_it_is_left_out() {
    let (_folder, mut corpus) = three_recordings();
    let before = rows(corpus.store.read_connection());
    let work = TierRoundWork::Add(NewTier::new(RowName::Number(0), "G", TierRole::Free));
    let options = TierRoundOptions::default();
    let error = work_on(&mut corpus, &TierRoundScope::All, &work, options).expect_err("two have one");
    let CorpusError::Several { errors, .. } = &error else {
        panic!("a list: {error}");
    };
    let places: Vec<_> = errors.iter().filter_map(CorpusError::error_place).collect();
    assert_eq!(places, ["recording:1 (\"Take 1\")", "recording:2 (\"Take 2\")"]);
    let remedy = error.error_remedy().expect("a remedy for the list");
    assert!(remedy.remedy_text().contains("--skip"), "{remedy:?}");
    assert_eq!(rows(corpus.store.read_connection()), before);

    let skip = TierRoundOptions { skip: true, ..options };
    let report = work_on(&mut corpus, &TierRoundScope::All, &work, skip).expect("one has none");
    assert_eq!(changed_tiers(&report), ["Take 1 refuses", "Take 2 refuses", "Other: G"]);
    let overview = corpus.load_corpus_overview(1).expect("read");
    assert_eq!(overview.operations[0].summary, "1 tier added in 1 recording");
}

#[test]
fn recordings_are_chosen_by_their_rows() {
    let (_folder, mut corpus) = three_recordings();
    let work = TierRoundWork::Add(NewTier::new(RowName::Number(0), "new", TierRole::Free));
    let on = |corpus: &mut Corpus, ids: &[i64]| {
        let scope = TierRoundScope::Recordings(ids.to_vec());
        work_on(corpus, &scope, &work, TierRoundOptions::default())
    };
    let report = on(&mut corpus, &[3, 1]).expect("done");
    assert_eq!(changed_tiers(&report), ["Take 1: new", "Other: new"]);
    assert!(on(&mut corpus, &[]).is_err() && on(&mut corpus, &[99]).is_err());
}

#[test]
fn a_shift_of_many_recordings_is_one_step() {
    let (_folder, mut corpus) = three_recordings();
    annotate(&mut corpus, "add G 0-100 BOL; add H 50-100 CHAT").expect("added");
    let (tiers, by_us) = (vec!["G".to_owned()], 40_000);
    let work = TierRoundWork::Shift { tiers, by_us };
    let report = work_on(&mut corpus, &TierRoundScope::All, &work, TierRoundOptions::default()).expect("shifted");
    assert_eq!((report.recordings.len(), report.untouched), (1, 2));
    assert_eq!(report.recordings[0].annotations, 1);
    corpus.undo_operation().expect("undone");
    assert_eq!(shown(&corpus), "G 1 0-100 BOL; H 2 50-100 CHAT");
}

#[test]
fn a_dry_run_that_is_stopped_gives_no_half_of_a_list() {
    let (_folder, mut corpus) = three_recordings();
    let work = TierRoundWork::Add(NewTier::new(RowName::Number(0), "new", TierRole::Free));
    let options = TierRoundOptions {
        dry_run: true,
        ..TierRoundOptions::default()
    };
    let mut stop = |step: crate::ProgressStep<'_>| match step.done {
        0 => std::ops::ControlFlow::Continue(()),
        _ => std::ops::ControlFlow::Break(()),
    };
    let progress = &mut ProgressReceiver::new(&mut stop);
    let stopped = corpus.work_on_tiers(&TierRoundScope::All, &work, options, progress);
    assert!(matches!(stopped, Err(CorpusError::Stopped)), "{stopped:?}");
    let report = work_on(&mut corpus, &TierRoundScope::All, &work, options).expect("tried");
    assert_eq!(report.recordings.len(), 3);
}

#[test]
fn a_query_about_recordings_finds_those_without_tokens() {
    let (_folder, mut corpus) = three_recordings();
    let fill = |connection: &Connection| {
        let ben = stored_recordings::signer_named(connection, "Ben", None)?;
        connection.execute("UPDATE recording SET signer_id = ?1 WHERE name = 'Other'", [ben])?;
        connection.execute("UPDATE tier SET participant = 'Ben' WHERE recording_id = 2", [])?;
        connection.execute_batch(
            "INSERT INTO source_file (recording_id, kind, name, path, hash) VALUES (3, 'eaf', 'other.eaf', 'other.eaf', 'x');
             INSERT INTO person_alias (signer_id, name) VALUES (2, 'B.');
             INSERT INTO person_attribute (signer_id, name, text, number, audience)
             VALUES (2, 'region', 'North', NULL, 'nobody'), (2, 'age', '41', 41, 'nobody')",
        )?;
        Ok(((), String::new()))
    };
    corpus.store.named_operation("fill", fill).expect("filled");
    annotate(&mut corpus, "add G 0-100 BOL").expect("added");
    let mut found = |query: &str| {
        let mut hear = ignore_progress_step;
        let ids = corpus.recordings_of_query(query, &mut ProgressReceiver::new(&mut hear));
        ids.map(|ids| ids.into_iter().collect::<Vec<i64>>())
    };
    for (query, wanted) in [
        ("signer=Ben", &[2, 3][..]),
        ("signer=B.", &[2, 3]),
        ("signer!=Anna", &[3]),
        ("not signer=ben", &[1]),
        ("signer.region=north", &[2, 3]),
        ("signer.age>40 recording=Take*", &[2]),
        ("signer.region=unset", &[1]),
        ("file=other.eaf or recording=1", &[1, 3]),
        ("file=unset", &[1, 2]),
        ("recording!=Other (signer=Anna)", &[1, 2]),
        // A condition on tokens leaves out the recordings without one.
        ("gloss=BOL", &[1]),
        ("gloss=BOL or recording=Other", &[1]),
        ("", &[1]),
    ] {
        assert_eq!(
            found(query).unwrap_or_else(|error| panic!("{query}: {error}")),
            wanted,
            "{query}"
        );
    }
    for (query, wrong) in [
        ("signer=Zoe", "no signer is called"),
        ("signer.shoe=3", "no field or attribute"),
    ] {
        let error = found(query).expect_err(query).to_string();
        assert!(error.contains(wrong), "{query}: {error}");
    }
    let work = TierRoundWork::Add(NewTier::new(RowName::Number(0), "new", TierRole::Free));
    for (query, only_with_tokens) in [("signer=Ben", false), ("gloss=BOL", true)] {
        let scope = TierRoundScope::Query(query.to_owned());
        let report = work_on(&mut corpus, &scope, &work, TierRoundOptions::default()).expect("done");
        assert_eq!(report.only_with_tokens, only_with_tokens, "{query}");
    }
}
