use std::collections::BTreeMap;

use super::*;
use crate::import::ImportOptions;
use crate::progress::ProgressStep;
use crate::progress::ignore_progress_step;
use crate::study::{StudyRequest, study_plan};

/// Returns a corpus with BOL and CHAT of the starter corpus.
pub(in crate::study) fn corpus(folder: &Path) -> Corpus {
    let mut corpus = Corpus::create_corpus(&folder.join("c.chereme"), "A").expect("made");
    let files: Vec<PathBuf> = crate::unpack_starter(folder)
        .expect("unpacked")
        .into_iter()
        .filter(|it| it.file_stem().is_some_and(|it| it == "bol" || it == "chat"))
        .collect();
    let mut hear = ignore_progress_step;
    corpus
        .import_paths(&files, &ImportOptions::default(), &mut ProgressReceiver::new(&mut hear))
        .expect("imported");
    let everybody = Some(Some(crate::ConsentAudience::Public));
    let yes = crate::ConsentChange {
        movement: everybody,
        annotation: everybody,
        derived: everybody,
        ..crate::ConsentChange::default()
    };
    let of = ["signer:\"Camille (made)\"".parse().expect("an address")];
    corpus.change_consent(&of, &yes).expect("stated");
    corpus
}

fn request() -> StudyRequest {
    StudyRequest {
        name: "placing".into(),
        title: Some("Where is it? </script> @@DATA@@".into()),
        items: vec!["BOL".into(), "CHAT".into()],
        conditions: vec![
            ("captured".into(), "{}".into()),
            ("higher".into(), "{} | place both by up 10cm".into()),
        ],
        questions: vec!["realism".into(), "gloss=items LIMACE".into()],
        scale: 5,
        ..StudyRequest::default()
    }
}

#[test]
fn a_questionnaire_holds_plan_script_and_films_and_lets_nothing_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus(folder.path());
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let mut plan = request().make_study_plan().expect("a plan");
    plan.trials[0].right.insert("gloss".into(), "LIMACE".into());
    let planned = corpus.plan_study(&plan, progress).expect("planned");
    let small = QuestionnaireOptions {
        height: 64,
        rate: 5,
        force: false,
        ..QuestionnaireOptions::default()
    };
    let to = [folder.path().join("one"), folder.path().join("two")];
    let built = corpus.build_study("placing", &to[0], small, progress).expect("built");
    corpus
        .build_study("placing", &to[1], small, progress)
        .expect("built again");
    assert_eq!((built.films, built.orders), (4, 48));
    let files = |folder: &Path| -> BTreeMap<String, Vec<u8>> {
        let media = fs::read_dir(folder.join("media")).expect("films").flatten();
        let all = media.map(|it| it.path()).chain([folder.join("index.html")]);
        all.map(|it| {
            (
                it.file_name().expect("a name").to_string_lossy().into_owned(),
                fs::read(&it).expect("read"),
            )
        })
        .collect()
    };
    let one = files(&to[0]);
    assert_eq!(one, files(&to[1]), "the same bytes");
    assert_eq!(one.len(), 5);
    let page = String::from_utf8(one["index.html"].clone()).expect("text");
    for part in [
        QUESTIONNAIRE_SCRIPT,
        QUESTIONNAIRE_TEXTS,
        QUESTIONNAIRE_STYLE_CSS,
        "default-src 'none'",
        "connect-src 'none'",
        "&lt;/script> @@DATA@@</title>",
    ] {
        assert!(page.contains(part), "{part}");
    }
    assert_eq!(page.matches("<script").count(), 2);
    for outside in ["http:", "https:", "src=\"", "import(", "fetch(", "eval("] {
        assert!(!page.contains(outside), "{outside}");
    }
    let start = page.find("id=\"data\">").expect("data") + "id=\"data\">".len();
    let end = start + page[start..].find("</script>").expect("its end");
    let data: serde_json::Value = serde_json::from_str(&page[start..end]).expect("JSON");
    assert_eq!(data["plan_sha256"], planned.plan_sha256.as_str());
    assert_eq!(data["title"]["en"], "Where is it? </script> @@DATA@@");
    assert!(!page.contains("place both by up"), "recipes stay at home");
    assert!(data["trials"][0].get("right").is_none());
    for trial in data["trials"].as_array().expect("trials") {
        assert!(one.contains_key(trial["film"].as_str().expect("a film")));
    }
    // All films have one size, and half a second before and after the movement.
    let films = one.keys().filter(|it| it.ends_with(".mp4"));
    let sizes: BTreeSet<_> = films
        .map(|it| {
            let path = to[0].join("media").join(it);
            let film = crate::FilmFile::open_film(&path).expect("a film");
            (film.film_facts().width, film.film_facts().height)
        })
        .collect();
    assert_eq!(sizes.len(), 1);
    assert!(
        corpus.build_study("placing", &to[0], small, progress).is_err(),
        "it is there"
    );
    fs::write(to[0].join("media/consent.fr.mp4"), "a film").expect("written");
    fs::write(to[0].join("media/0123456789abcdef.mp4"), "an old film").expect("written");
    let forced = QuestionnaireOptions { force: true, ..small };
    corpus.build_study("placing", &to[0], forced, progress).expect("built");
    let names: Vec<String> = files(&to[0]).into_keys().collect();
    assert!(
        names.contains(&"consent.fr.mp4".to_owned()) && names.len() == 6,
        "{names:?}"
    );
}

#[test]
fn what_cannot_be_made_is_named_and_a_stopped_build_leaves_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus(folder.path());
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let mut wrong = request();
    wrong.items.push("BOLL".into());
    let error = corpus
        .plan_study(&wrong.make_study_plan().expect("a plan"), progress)
        .expect_err("unknown");
    assert!(error.to_string().contains("BOLL"), "{error}");
    assert_eq!(error.error_place().as_deref(), Some("trial 5 (BOLL, captured)"));
    let plan = request().make_study_plan().expect("a plan");
    corpus.plan_study(&plan, progress).expect("planned");
    let mut films = 0;
    let mut stop = |step: ProgressStep<'_>| {
        films += usize::from(step.task == "drawing films");
        if films > 20 {
            std::ops::ControlFlow::Break(())
        } else {
            std::ops::ControlFlow::Continue(())
        }
    };
    let to = folder.path().join("stopped");
    let small = QuestionnaireOptions {
        height: 64,
        rate: 5,
        force: false,
        ..QuestionnaireOptions::default()
    };
    let done = corpus.build_study("placing", &to, small, &mut ProgressReceiver::new(&mut stop));
    assert!(matches!(done, Err(CorpusError::Stopped)));
    assert!(!to.exists());
    let damage = "UPDATE track SET metres_per_unit = metres_per_unit * 2";
    let done = rusqlite::Connection::open(corpus.corpus_file_path()).and_then(|it| it.execute_batch(damage));
    done.expect("damaged");
    let done = corpus.build_study("placing", &to, small, progress);
    assert!(matches!(done, Err(CorpusError::Damaged { .. })), "{done:?}");
    assert!(!to.exists());
    corpus.undo_operation().expect("undone");
    assert!(corpus.study_with_answers("placing").is_err());
}

#[test]
fn the_script_saves_answers_before_it_forgets_them() {
    let place = |text: &str, from: usize| {
        let found = QUESTIONNAIRE_SCRIPT[from..].find(text);
        from + found.unwrap_or_else(|| panic!("the script has no {text:?}"))
    };
    for (function, saves, forgets) in [
        ("function begin(", "rescue(null)", "person = {"),
        ("function proceed(", "rescue(saved)", "person = saved"),
        ("function thanks(", "if (dirty) save()", "localStorage.removeItem"),
    ] {
        let begin = place(function, 0);
        let end = place("\n}\n", begin);
        assert!(place(saves, begin) < place(forgets, begin), "{function}");
        assert!(place(forgets, begin) < end, "{function}");
    }
}

#[test]
fn base64_is_that_of_the_standard() {
    // RFC 4648, section 10.
    for (text, code) in [
        ("", ""),
        ("f", "Zg=="),
        ("fo", "Zm8="),
        ("foo", "Zm9v"),
        ("foobar", "Zm9vYmFy"),
    ] {
        assert_eq!(encode_base64(text.as_bytes()), code);
    }
}

#[test]
fn a_table_makes_the_first_design_of_the_founding_paper() {
    let table = "item;condition;clip;role;part;answer;distance\n\
                 b0;captured;BOL;training;places;left;\n\
                 b1;captured;BOL;;places;right;0.5\n\
                 p1;linear;point right at 30cm,140cm,50cm via linear;;pointing;;\n";
    let request = StudyRequest {
        items: Vec::new(),
        conditions: Vec::new(),
        trials: Some((table.into(), "t.csv".into())),
        questions: vec!["place@places=left right".into(), "realism=1-7".into()],
        ..request()
    };
    let plan = request.make_study_plan().expect("a plan");
    assert_eq!(plan.trials[0].role, study_plan::TrialRole::Training);
    assert_eq!(plan.trials[1].right["place"], "right");
    assert_eq!(plan.trials[1].measures["distance"], 0.5);
    assert!(plan.trials[2].right.is_empty());
    let asked: Vec<usize> = plan
        .trials
        .iter()
        .map(|it| plan.questions_of_trial(it).count())
        .collect();
    assert_eq!(asked, [2, 2, 1]);
    for (from, to, place) in [
        (";right;", ";up;", "t.csv, line 3"),
        (";0.5", ";half", "t.csv, line 3"),
        ("training", "practice", "t.csv, line 2"),
        ("clip;", "film;", "t.csv"),
    ] {
        let wrong = StudyRequest {
            trials: Some((table.replacen(from, to, 1), "t.csv".into())),
            ..request.clone()
        };
        let error = wrong.make_study_plan().expect_err(to);
        assert_eq!(error.error_place().as_deref(), Some(place), "{error}");
        assert!(error.error_remedy().is_some());
    }
}

#[test]
fn the_clip_of_a_trial_is_that_of_its_address_or_recipe() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus(folder.path());
    let own = corpus.trial_clip("BOL").expect("a clip");
    let address = "BOL".parse().expect("an address");
    let moving = corpus.movement_at_address(&address).expect("movement");
    assert_eq!(own.clip, moving.clip);
    let higher = corpus.trial_clip("BOL | place both by up 10cm").expect("a clip");
    assert_ne!(higher.clip, own.clip);
    assert!(corpus.trial_clip("NOBODY").is_err());
}

#[test]
fn films_of_somebody_who_did_not_agree_are_not_built() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus(folder.path());
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let plan = request().make_study_plan().expect("a plan");
    corpus.plan_study(&plan, progress).expect("planned");
    let no = crate::ConsentChange {
        movement: Some(Some(crate::ConsentAudience::Research)),
        ..crate::ConsentChange::default()
    };
    let of = ["recording:bol".parse().expect("an address")];
    corpus.change_consent(&of, &no).expect("stated");
    let to = folder.path().join("study");
    let small = QuestionnaireOptions {
        height: 64,
        rate: 5,
        ..QuestionnaireOptions::default()
    };
    let refused = corpus
        .build_study("placing", &to, small, progress)
        .expect_err("withheld");
    let message = refused.to_string();
    assert!(
        message.contains("Camille (made)") && message.contains("withheld from public"),
        "{message}"
    );
    assert!(!to.exists());
    let for_research = QuestionnaireOptions {
        audience: OutputAudience::Research,
        ..small
    };
    corpus
        .build_study("placing", &to, for_research, progress)
        .expect("research is agreed to");
}
