//! Tests of adding whole sets of tiers.

use super::*;

#[test]
fn a_recording_gets_the_usual_tiers_or_those_of_another_in_one_step() {
    let (_folder, mut corpus) = corpus();
    corpus
        .store
        .named_operation("fill", |connection| {
            let empty = RecordingRow {
                name: "Take 2".to_owned(),
                ..recordings::recording(connection, 1)?
            };
            Ok((
                recordings::insert_recording(connection, &empty)?,
                String::new(),
            ))
        })
        .expect("a recording");
    let (first, second) = (Name::Number(1), Name::Text("Take 2".into()));
    let shape = |corpus: &Corpus, recording: &Name| -> Vec<String> {
        let read = corpus.store.read();
        let id = crate::address::recording(read, recording)
            .expect("a recording")
            .id;
        let tiers = crate::db::tiers::tiers(read, id).expect("tiers");
        let name = |id: Option<i64>| tiers.iter().find(|it| Some(it.id) == id).map(|it| &it.name);
        let line = |it: &TierRow| {
            format!(
                "{} {} {:?} {:?}",
                it.name,
                it.topic(),
                it.inventory_id,
                name(it.parent_id)
            )
        };
        tiers.iter().map(line).collect()
    };
    let error = corpus.add_tiers(&first, &Scheme::Like(second.clone()));
    assert!(error.is_err_and(|it| it.to_string().contains("no tiers")));
    corpus
        .add_tiers(&second, &Scheme::Like(first.clone()))
        .expect("added");
    assert_eq!(shape(&corpus, &second), shape(&corpus, &first));
    let again = corpus.add_tiers(&second, &Scheme::Like(first));
    assert!(again.is_err_and(|it| it.to_string().contains("already")));
    corpus.undo().expect("undone");
    assert_eq!(shape(&corpus, &second), Vec::<String>::new());

    let added = corpus.add_tiers(&second, &Scheme::Usual).expect("added");
    assert_eq!(added.len(), 18);
    let said = shape(&corpus, &second);
    assert!(said.contains(&"Gloss gloss None None".to_owned()));
    let palm = said
        .iter()
        .find(|it| it.starts_with("Palm direction LH"))
        .expect("a tier");
    assert!(palm.contains(" left.orientation.palm Some("), "{palm}");
    assert!(palm.ends_with("Some(\"Gloss\")"), "{palm}");

    let before = shape(&corpus, &Name::Number(1)).len();
    let names: Vec<String> = corpus
        .add_tiers(&Name::Number(1), &Scheme::Usual)
        .expect("added")
        .into_iter()
        .map(|it| it.name)
        .collect();
    assert_eq!(shape(&corpus, &Name::Number(1)).len(), before + names.len());
    for there in ["Gloss", "Translation", "Comment", "Configuration RH"] {
        assert!(!names.iter().any(|it| it == there), "{there} has its tier");
    }
}

#[test]
fn each_gloss_tier_gets_the_components_of_its_hand() {
    let (_folder, mut corpus) = corpus();
    let recording = Name::Number(1);
    let mut gloss = NewTier::new(recording.clone(), "RH-IDgloss", TierRole::Gloss);
    gloss.hand = chereme_formats::roles::Hands::of("right");
    let gloss = corpus.add_tier(&gloss).expect("added");
    let below = Scheme::Below(TierName::Number(gloss.id));
    let added = corpus.add_tiers(&recording, &below).expect("added");
    assert_eq!(added.len(), 6);
    for row in &added {
        assert_eq!(row.parent_id, Some(gloss.id));
        assert_eq!(row.hand, crate::Hands::of("right"), "{}", row.name);
    }
    assert_eq!(added[0].name, "Configuration RH");
    let other = TierName::Of {
        recording: recording.clone(),
        tier: "G".to_owned(),
    };
    let others = corpus.add_tiers(&recording, &Scheme::Below(other));
    assert_eq!(others.expect("added")[0].name, "Configuration RH (G)");
    let again = corpus.add_tiers(&recording, &below);
    assert!(again.is_err_and(|it| it.to_string().contains("already")));
    let wrong = Scheme::Below(TierName::Number(added[0].id));
    let error = corpus.add_tiers(&recording, &wrong);
    assert!(error.is_err_and(|it| it.to_string().contains("no glosses")));
}
