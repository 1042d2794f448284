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
                ..stored_recordings::load_recording_row(connection, 1)?
            };
            Ok((stored_recordings::insert_recording(connection, &empty)?, String::new()))
        })
        .expect("a recording");
    let (first, second) = (RowName::Number(1), RowName::Text("Take 2".into()));
    let shape = |corpus: &Corpus, recording: &RowName| -> Vec<String> {
        let read = corpus.store.read_connection();
        let id = crate::address::find_recording_by_name(read, recording)
            .expect("a recording")
            .id;
        let tiers = crate::db::stored_tiers::load_tier_rows(read, id).expect("tiers");
        let name = |id: Option<i64>| tiers.iter().find(|it| Some(it.id) == id).map(|it| &it.name);
        let line = |it: &TierRow| {
            format!(
                "{} {} {:?} {:?}",
                it.name,
                it.tier_topic(),
                it.inventory_id,
                name(it.parent_id)
            )
        };
        tiers.iter().map(line).collect()
    };
    let error = corpus.add_tiers(&first, &TierScheme::Like(second.clone()));
    assert!(error.is_err_and(|it| it.to_string().contains("no tiers")));
    corpus
        .add_tiers(&second, &TierScheme::Like(first.clone()))
        .expect("added");
    assert_eq!(shape(&corpus, &second), shape(&corpus, &first));
    let again = corpus.add_tiers(&second, &TierScheme::Like(first));
    assert!(again.is_err_and(|it| it.to_string().contains("already")));
    corpus.undo_operation().expect("undone");
    assert_eq!(shape(&corpus, &second), Vec::<String>::new());

    let added = corpus.add_tiers(&second, &TierScheme::Usual).expect("added");
    assert_eq!(added.len(), 18);
    let said = shape(&corpus, &second);
    assert!(said.contains(&"Gloss gloss None None".to_owned()));
    let palm = said
        .iter()
        .find(|it| it.starts_with("Palm direction LH"))
        .expect("a tier");
    assert!(palm.contains(" left.orientation.palm Some("), "{palm}");
    assert!(palm.ends_with("Some(\"Gloss\")"), "{palm}");

    let before = shape(&corpus, &RowName::Number(1)).len();
    let names: Vec<String> = corpus
        .add_tiers(&RowName::Number(1), &TierScheme::Usual)
        .expect("added")
        .into_iter()
        .map(|it| it.name)
        .collect();
    assert_eq!(shape(&corpus, &RowName::Number(1)).len(), before + names.len());
    for there in ["Gloss", "Translation", "Comment", "Configuration RH"] {
        assert!(!names.iter().any(|it| it == there), "{there} has its tier");
    }
}

#[test]
fn each_gloss_tier_gets_the_components_of_its_hand() {
    let (_folder, mut corpus) = corpus();
    let recording = RowName::Number(1);
    let mut gloss = NewTier::new(recording.clone(), "RH-IDgloss", TierRole::Gloss);
    gloss.hand = chereme_formats::roles::AnnotatedHands::from_hand_name("right");
    let gloss = corpus.add_tier(&gloss).expect("added");
    let below = TierScheme::Below(TierRequestName::Number(gloss.id));
    let added = corpus.add_tiers(&recording, &below).expect("added");
    assert_eq!(added.len(), 6);
    for row in &added {
        assert_eq!(row.parent_id, Some(gloss.id));
        assert_eq!(row.hand, crate::AnnotatedHands::from_hand_name("right"), "{}", row.name);
    }
    assert_eq!(added[0].name, "Configuration RH");
    let other = TierRequestName::Of {
        recording: recording.clone(),
        tier: "G".to_owned(),
    };
    let others = corpus.add_tiers(&recording, &TierScheme::Below(other));
    assert_eq!(others.expect("added")[0].name, "Configuration RH (G)");
    let again = corpus.add_tiers(&recording, &below);
    assert!(again.is_err_and(|it| it.to_string().contains("already")));
    let wrong = TierScheme::Below(TierRequestName::Number(added[0].id));
    let error = corpus.add_tiers(&recording, &wrong);
    assert!(error.is_err_and(|it| it.to_string().contains("no glosses")));
}
