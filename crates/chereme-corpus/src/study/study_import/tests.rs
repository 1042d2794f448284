use std::fs;
use std::path::{Path, PathBuf};

use proptest::prelude::*;
use serde_json::{Value, json};

use super::*;
use crate::import::FileStatus;
use crate::progress::ignore_progress_step;
use crate::study::study_plan::StudyPlan;

/// Returns a corpus with a study of two parts.
fn corpus(folder: &Path) -> (Corpus, StudyPlan) {
    let mut corpus = Corpus::create_corpus(&folder.join("c.chereme"), "A").expect("made");
    let plan = json!({
        "format": "chereme-study", "version": 1, "name": "bowls",
        "trials": [
            {"item": "BOL", "condition": "captured", "clip": "BOL", "part": "places", "right": {"place": "left"}},
            {"item": "BOL", "condition": "made", "clip": "BOL | swap", "part": "places", "right": {"place": "right"}},
            {"item": "BOL", "condition": "made", "clip": "BOL", "part": "places", "role": "training"},
            {"item": "POINT", "condition": "made", "clip": "POINT", "part": "points"}],
        "questions": [
            {"name": "realism", "kind": {"scale": {"low": 1, "high": 5}}, "cannot_say": true},
            {"name": "place", "kind": {"choice": {"options": [{"name": "left"}, {"name": "right"}]}}, "parts": ["places"]}],
        "profile": [{"name": "level", "options": [{"name": "good"}, {"name": "native"}]}],
    });
    let plan: StudyPlan = serde_json::from_value(plan).expect("a plan");
    let stored = corpus.store.named_operation("plan study", |connection| {
        db::insert_study_row(connection, &stored::study_plan_row(&plan))?;
        Ok(((), String::new()))
    });
    stored.expect("stored");
    (corpus, plan)
}

fn answer(n: u32, item: &str, condition: &str, part: &str) -> Value {
    json!({"n": n, "block": 1, "part": part, "item": item, "condition": condition, "role": "main",
           "question": "realism", "scale": [1, 5], "value": 4, "choice": null, "right": null,
           "plays": 2, "ms": 1500, "hidden": 0, "slow": 1})
}

fn file(plan: &StudyPlan, code: &str, finished: bool, answers: &[Value]) -> Value {
    json!({"format": "chereme-answers", "version": 1, "study": "bowls", "plan_sha256": plan.plan_sha256(),
           "participant": code, "seed": 7, "started_day": "2026-11-27", "language": "fr",
           "device": {"w": 1280, "h": 720, "dpr": 1.5}, "consent": {"analysis": true, "publication": false},
           "profile": {"level": "native"}, "finished": finished, "answers": answers})
}

fn write(folder: &Path, name: &str, content: &Value) -> PathBuf {
    let path = folder.join(name);
    let text = serde_json::to_string_pretty(content).expect("text");
    fs::write(&path, text).expect("written");
    path
}

fn import(corpus: &mut Corpus, path: &Path) -> AnswersReport {
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    corpus
        .import_answers("bowls", &[path.to_owned()], &AnswersOptions::default(), progress)
        .expect("imported")
}

#[test]
fn answers_are_imported_once_exported_as_a_table_and_read_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut corpus, plan) = corpus(folder.path());
    let mut place = answer(1, "BOL", "captured", "places");
    place["question"] = json!("place");
    (place["scale"], place["value"], place["choice"]) = (Value::Null, Value::Null, json!("left"));
    let mut unsure = answer(3, "POINT", "made", "points");
    unsure["value"] = Value::Null;
    let all = [
        answer(1, "BOL", "captured", "places"),
        place,
        answer(2, "BOL", "made", "places"),
        unsure,
    ];
    let inside = folder.path().join("answers");
    fs::create_dir(&inside).expect("made");
    write(&inside, "a.json", &file(&plan, "Zoé-1", true, &all));
    write(&inside, "b.json", &file(&plan, "empty", false, &[]));
    fs::write(inside.join("notes.txt"), "not answers").expect("written");
    let report = import(&mut corpus, &inside);
    assert_eq!((report.added, report.answers, report.files.len()), (2, 4, 2));
    assert!(report.files.iter().all(|it| it.findings.is_empty()), "{report:?}");
    let all = corpus.study_overviews().expect("listed");
    let counts: Vec<_> = all
        .iter()
        .map(|it| (it.plan.name.as_str(), it.participants, it.finished, it.answers))
        .collect();
    assert_eq!(counts, [("bowls", 2, 1, 4)]);
    let study = corpus.study_with_answers("bowls").expect("read");
    let zoe = &study.participants[0];
    assert_eq!((zoe.code.as_str(), zoe.answers.len()), ("Zoé-1", 4));
    assert_eq!(zoe.answers[1].right, Some(true));
    assert_eq!((zoe.answers[3].value, zoe.device.dpr), (None, 1.5));
    let operations = corpus.operation_log(10).expect("log").len();
    assert_eq!(import(&mut corpus, &inside).unchanged, 2);
    assert_eq!(
        corpus.operation_log(10).expect("log").len(),
        operations,
        "nothing changed"
    );

    let table = folder.path().join("all.csv");
    assert_eq!(corpus.export_answers("bowls", &table, false).expect("written"), 4);
    assert_eq!(import(&mut corpus, &table).unchanged, 2);
    corpus.undo_operation().expect("undone");
    assert_eq!(corpus.study_with_answers("bowls").expect("read").participants, []);
    assert_eq!(import(&mut corpus, &table).added, 2);
    assert_eq!(corpus.study_with_answers("bowls").expect("read"), study);
    corpus.forget_participant("bowls", "Zoé-1").expect("forgotten");
    assert_eq!(corpus.study_with_answers("bowls").expect("read").participants.len(), 1);
    corpus.undo_operation().expect("undone");
    assert_eq!(corpus.study_with_answers("bowls").expect("read"), study);
    corpus.delete_study("bowls").expect("deleted");
    assert!(corpus.study_with_answers("bowl").is_err());
    corpus.undo_operation().expect("undone");
    assert_eq!(corpus.study_with_answers("bowls").expect("read"), study);
}

#[test]
fn later_answers_replace_unfinished_ones_only() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut corpus, plan) = corpus(folder.path());
    let (one, two) = (
        answer(1, "BOL", "captured", "places"),
        answer(2, "BOL", "made", "places"),
    );
    let versions = [
        ("1", false, vec![one.clone()], FileStatus::Imported, 0),
        ("2", false, vec![one.clone(), two.clone()], FileStatus::Updated, 0),
        ("1", false, vec![one.clone()], FileStatus::Refused, 1),
        ("3", true, vec![one.clone(), two.clone()], FileStatus::Updated, 0),
        ("4", true, vec![two], FileStatus::Refused, 1),
        (
            "3",
            true,
            vec![one.clone(), answer(2, "BOL", "made", "places")],
            FileStatus::Unchanged,
            0,
        ),
    ];
    for (at, (name, finished, answers, status, findings)) in versions.into_iter().enumerate() {
        let path = write(
            folder.path(),
            &format!("{name}.json"),
            &file(&plan, "p", finished, &answers),
        );
        let report = import(&mut corpus, &path);
        assert_eq!(
            (report.files[0].status, report.files[0].findings.len()),
            (status, findings),
            "{at}"
        );
    }
    let study = corpus.study_with_answers("bowls").expect("read");
    assert_eq!(
        (study.participants[0].answers.len(), study.participants[0].finished),
        (2, true)
    );
}

#[test]
fn a_code_that_two_people_chose_costs_neither_their_answers() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut corpus, plan) = corpus(folder.path());
    let one = answer(1, "BOL", "captured", "places");
    let mut content = file(&plan, "p", false, std::slice::from_ref(&one));
    import(&mut corpus, &write(folder.path(), "1.json", &content));
    let before = corpus.study_with_answers("bowls").expect("read");
    content["seed"] = json!(8);
    content["finished"] = json!(true);
    let report = import(&mut corpus, &write(folder.path(), "2.json", &content));
    assert_eq!(report.files[0].status, FileStatus::Refused);
    let message = &report.files[0].findings[0].message;
    assert!(message.contains("the seeds are 7 and 8"), "{message}");
    assert_eq!(corpus.study_with_answers("bowls").expect("read"), before);
}

#[test]
fn films_that_could_not_be_shown_are_reported_and_cost_no_other_answer() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut corpus, plan) = corpus(folder.path());
    let mut content = file(&plan, "p", true, &[answer(1, "BOL", "captured", "places")]);
    content["skipped"] = json!([2, 3, 2]);
    let path = write(folder.path(), "1.json", &content);
    let report = import(&mut corpus, &path);
    let found = &report.files[0].findings[0].message;
    assert_eq!(
        found,
        "p: the browser could not show films; trials without all answers: 2, 3"
    );
    let people = corpus.study_with_answers("bowls").expect("read").participants;
    assert_eq!((people.len(), people[0].answers.len()), (1, 1));
    assert!(people[0].finished);
    assert_eq!(import(&mut corpus, &path).unchanged, 1);
}

#[cfg(unix)]
#[test]
fn a_folder_gives_the_files_that_its_links_lead_to() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut corpus, plan) = corpus(folder.path());
    let one = answer(1, "BOL", "captured", "places");
    let file = file(&plan, "p", true, std::slice::from_ref(&one));
    let file = write(folder.path(), "1.json", &file);
    let inside = folder.path().join("answers");
    fs::create_dir(&inside).expect("made");
    for (to, name) in [(&*file, "a.json"), ("nowhere".as_ref(), "b.json"), (&*inside, "c.json")] {
        std::os::unix::fs::symlink(to, inside.join(name)).expect("linked");
    }
    let report = import(&mut corpus, &inside);
    let found: Vec<FileStatus> = report.files.iter().map(|it| it.status).collect();
    assert_eq!(found, [FileStatus::Imported, FileStatus::Refused]);
}

#[test]
fn folders_that_lie_too_deep_are_refused_rather_than_left_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut corpus, plan) = corpus(folder.path());
    let one = answer(1, "BOL", "captured", "places");
    let content = file(&plan, "p", true, std::slice::from_ref(&one));
    let top = folder.path().join("answers");
    for (depth, taken) in [(7, true), (8, false)] {
        let inside = (0..depth).fold(top.clone(), |it, _| it.join("in"));
        fs::create_dir_all(&inside).expect("made");
        write(&inside, "p.json", &content);
        let mut hear = ignore_progress_step;
        let found = corpus.import_answers(
            "bowls",
            std::slice::from_ref(&top),
            &AnswersOptions::default(),
            &mut ProgressReceiver::new(&mut hear),
        );
        assert_eq!(found.is_ok(), taken, "{depth}: {found:?}");
    }
}

#[test]
fn a_merge_brings_the_participants_of_both_sides_and_the_studies_of_the_other() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mine, plan) = corpus(folder.path());
    let path = mine.corpus_file_path().to_owned();
    drop(mine);
    let other = folder.path().join("other.chereme");
    fs::copy(&path, &other).expect("copied");
    let mut mine = Corpus::open_corpus(&path, "A").expect("opened");
    let mut theirs = Corpus::open_corpus(&other, "B").expect("opened");
    let one = answer(1, "BOL", "captured", "places");
    let file_of = |code: &str, finished| {
        let content = file(&plan, code, finished, std::slice::from_ref(&one));
        write(folder.path(), &format!("{code}.json"), &content)
    };
    import(&mut mine, &file_of("mine", true));
    import(&mut theirs, &file_of("theirs", true));
    for corpus in [&mut mine, &mut theirs] {
        import(corpus, &file_of("both", true));
    }
    let second = StudyPlan {
        name: "second".into(),
        ..plan.clone()
    };
    let stored = theirs.store.named_operation("plan study", |connection| {
        let id = db::insert_study_row(connection, &stored::study_plan_row(&second))?;
        Ok((id, "second".to_owned()))
    });
    stored.expect("stored");
    drop(theirs);
    let mut hear = ignore_progress_step;
    let report = mine
        .merge_corpus(&other, None, &mut ProgressReceiver::new(&mut hear))
        .expect("merged");
    assert!(report.conflicts.is_empty(), "{report:?}");
    let study = mine.study_with_answers("bowls").expect("read");
    let codes: Vec<(&str, usize)> = study
        .participants
        .iter()
        .map(|it| (it.code.as_str(), it.answers.len()))
        .collect();
    assert_eq!(codes, [("both", 1), ("mine", 1), ("theirs", 1)]);
    assert_eq!(mine.study_with_answers("second").expect("brought").plan, second);
    mine.undo_operation().expect("undone");
    assert_eq!(mine.study_with_answers("bowls").expect("read").participants.len(), 2);
}

#[test]
fn a_merge_keeps_studies_and_people_apart_that_only_share_a_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut mine, plan) = corpus(folder.path());
    let other = folder.path().join("other.chereme");
    let path = mine.corpus_file_path().to_owned();
    drop(mine);
    fs::copy(&path, &other).expect("copied");
    mine = Corpus::open_corpus(&path, "A").expect("opened");
    let mut theirs = Corpus::open_corpus(&other, "B").expect("opened");
    let one = answer(1, "BOL", "captured", "places");
    let mut second = plan.clone();
    second.name = "second".into();
    for (corpus, seed) in [(&mut mine, 7), (&mut theirs, 8)] {
        let mut content = file(&plan, "p", false, std::slice::from_ref(&one));
        content["seed"] = json!(seed);
        import(corpus, &write(folder.path(), "p.json", &content));
        second.design.seed = seed;
        let stored = corpus.store.named_operation("plan study", |connection| {
            db::insert_study_row(connection, &stored::study_plan_row(&second))?;
            Ok(((), String::new()))
        });
        stored.expect("stored");
    }
    drop(theirs);
    let mut hear = ignore_progress_step;
    let report = mine
        .merge_corpus(&other, None, &mut ProgressReceiver::new(&mut hear))
        .expect("merged");
    assert!(report.conflicts.is_empty(), "{report:?}");
    assert_eq!(report.notes.len(), 2, "{report:?}");
    let people = mine.study_with_answers("bowls").expect("read").participants;
    let seeds: Vec<(&str, u32)> = people.iter().map(|it| (it.code.as_str(), it.seed)).collect();
    assert_eq!(seeds, [("p", 7), ("p-2", 8)]);
    assert_eq!(mine.study_with_answers("second").expect("kept").plan.design.seed, 7);
    let brought = mine.study_with_answers("second (2)").expect("brought");
    assert_eq!(
        (brought.plan.design.seed, brought.plan.name.as_str()),
        (8, "second (2)")
    );
    assert_eq!(brought.plan_sha256, second.plan_sha256());
}

#[test]
fn a_merge_does_not_mix_answers_to_two_versions_of_a_plan() {
    // After the copy each side does this: write a plan again, or not.
    for (mine_planned, theirs_planned) in [(true, true), (true, false), (false, true)] {
        let folder = tempfile::tempdir().expect("a folder");
        let (mine, plan) = corpus(folder.path());
        let (path, other) = (mine.corpus_file_path().to_owned(), folder.path().join("other.chereme"));
        drop(mine);
        fs::copy(&path, &other).expect("copied");
        let one = answer(1, "BOL", "captured", "places");
        let side = |path: &Path, code: &str, planned: bool, seed: u64| {
            let mut corpus = Corpus::open_corpus(path, "A").expect("opened");
            let mut own = plan.clone();
            if planned {
                own.design.seed = seed;
                let stored = corpus.store.named_operation("plan study", |connection| {
                    let study = stored::load_stored_study(connection, "bowls")?.expect("a study");
                    db::replace_study_plan(connection, study.id, &stored::study_plan_row(&own))?;
                    Ok(((), String::new()))
                });
                stored.expect("stored");
            }
            let mut content = file(&own, code, true, std::slice::from_ref(&one));
            content["plan_sha256"] = json!(corpus.study_with_answers("bowls").expect("a study").plan_sha256);
            import(&mut corpus, &write(folder.path(), &format!("{code}.json"), &content));
            corpus
        };
        let mut mine = side(&path, "a", mine_planned, 7);
        for (merges, codes) in [(1, ["b"].as_slice()), (2, &["b", "c"])] {
            let planned = theirs_planned && merges == 1;
            let corpus = side(&other, codes[merges - 1], planned, 8);
            let theirs = corpus.study_with_answers("bowls").expect("a study");
            drop(corpus);
            let mut hear = ignore_progress_step;
            let report = mine
                .merge_corpus(&other, None, &mut ProgressReceiver::new(&mut hear))
                .expect("merged");
            assert!(report.conflicts.is_empty(), "{report:?}");
            let of = |name: &str| {
                let study = mine.study_with_answers(name).expect(name);
                let codes = study.participants.into_iter().map(|it| it.code);
                (study.plan_sha256, codes.collect::<Vec<_>>())
            };
            assert_eq!(of("bowls").1, ["a"], "{mine_planned} {theirs_planned}");
            assert_eq!(
                of("bowls (2)"),
                (theirs.plan_sha256, codes.iter().map(|it| (*it).to_owned()).collect())
            );
        }
    }
}

#[test]
fn what_does_not_fit_the_plan_is_left_out_with_a_finding() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut corpus, plan) = corpus(folder.path());
    let good = answer(1, "BOL", "captured", "places");
    let with = |field: &str, value: Value| {
        let mut wrong = answer(2, "BOL", "made", "places");
        wrong[field] = value;
        wrong
    };
    for (wrong, message) in [
        (with("value", json!(6)), "6 lies outside the scale from 1 to 5"),
        (
            with("scale", json!([1, 7])),
            "the scale of \"realism\" goes from 1 to 5",
        ),
        (
            with("item", json!("CHAT")),
            "the plan has no trial with \"CHAT\" and \"made\" (main)",
        ),
        (
            with("role", json!("check")),
            "the plan has no trial with \"BOL\" and \"made\" (check)",
        ),
        (
            with("question", json!("charm")),
            "the plan does not ask \"charm\" there",
        ),
        (
            with("choice", json!("left")),
            "\"realism\" is a scale, which has no options",
        ),
        (with("n", json!(0)), "0 is no place in an order of trials"),
        (with("n", json!(1)), "\"realism\" was answered twice in trial 1"),
        (
            with("condition", json!("captured")),
            "\"realism\" was answered more often than \"BOL\" (captured) is shown",
        ),
    ] {
        let path = write(folder.path(), "w.json", &file(&plan, "w", true, &[good.clone(), wrong]));
        let report = import(&mut corpus, &path);
        let found = &report.files[0].findings;
        assert_eq!(found.len(), 1, "{message}");
        assert_eq!(found[0].message, format!("answer 2 was left out: {message}"));
        assert_eq!(
            corpus.study_with_answers("bowls").expect("read").participants[0]
                .answers
                .len(),
            1
        );
        corpus.undo_operation().expect("undone");
    }
    let mut other = file(&plan, "w", true, std::slice::from_ref(&good));
    for (field, value, message) in [
        (
            "plan_sha256",
            json!("00"),
            "the answers of \"w\" belong to another plan than that of the study \"bowls\"",
        ),
        ("participant", json!("=1+1"), "\"=1+1\" is no code of a participant"),
        (
            "format",
            json!("novel"),
            "the file is no chereme-answers, but \"novel\"",
        ),
        (
            "consent",
            json!({"analysis": false}),
            "\"w\" did not agree that the answers are analysed",
        ),
    ] {
        let before = std::mem::replace(&mut other[field], value);
        let report = import(&mut corpus, &write(folder.path(), "w.json", &other));
        other[field] = before;
        assert_eq!(report.files[0].status, FileStatus::Refused);
        assert_eq!(report.files[0].findings[0].message, message);
    }
    fs::write(
        folder.path().join("w.json"),
        "{\"format\": \"chereme-answers\",\n \"version\": }",
    )
    .expect("written");
    let report = import(&mut corpus, &folder.path().join("w.json"));
    assert_eq!(report.files[0].findings[0].line, Some(2));
    assert_eq!(corpus.study_with_answers("bowls").expect("read").participants, []);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn no_bytes_harm(bytes in prop::collection::vec(any::<u8>(), 0..400), at in 0_usize..900, tabular in any::<bool>()) {
        let folder = tempfile::tempdir().expect("a folder");
        let (mut corpus, plan) = corpus(folder.path());
        let whole = file(&plan, "p", true, &[answer(1, "BOL", "captured", "places")]);
        let mut text = serde_json::to_vec(&whole).expect("text");
        if tabular {
            import(&mut corpus, &write(folder.path(), "p.json", &whole));
            let table = folder.path().join("p.csv");
            corpus.export_answers("bowls", &table, false).expect("written");
            text = fs::read(&table).expect("read");
            corpus.undo_operation().expect("undone");
        }
        let at = at.min(text.len());
        text.splice(at..(at + bytes.len() / 3).min(text.len()), bytes);
        let path = folder.path().join("hostile.json");
        fs::write(&path, text).expect("written");
        let report = import(&mut corpus, &path);
        prop_assert_eq!(report.files.len(), 1);
        // All that was stored can be read.
        let stored = corpus.study_with_answers("bowls").expect("read").participants.len() as u64;
        prop_assert_eq!(stored, report.added);
    }
}
