use std::collections::BTreeSet;

use super::super::effect::{TierRoundDeed, TrackEffect, ValuedThing};
use super::super::old_effect::effect_of_summary;
use super::*;
use crate::{ChangeKind, ChangedRow, ConflictDecision, FieldChange, change_sentence};

fn annotations(changes: Vec<AnnotationDeed>) -> AnnotationEffect {
    AnnotationEffect::from_changes(changes, &["Un".to_owned()])
}

/// Every kind of operation, and of change of annotations.
fn all_effects() -> Vec<OperationEffect> {
    use AnnotationDeed as Deed;
    use OperationEffect as Effect;
    let text = |name: &str| format!("<{name}>");
    let count = 3;
    let all_deeds = vec![
        Deed::AnnotationsAdded { count },
        Deed::AnnotationsChanged { count },
        Deed::AnnotationsRemoved { count },
        Deed::AnnotationsMoved { count },
        Deed::AnnotationsMerged { count },
        Deed::AnnotationsSplit { count },
        Deed::AnnotationsRevalued { count },
        Deed::AnnotationsValued {
            count,
            of: ValuedThing::Handshape,
            value: text("value"),
        },
    ];
    let (tier, recording, gloss) = (text("tier"), text("recording"), text("gloss"));
    let study = text("study");
    let change_track = |change| Effect::ChangeTrack {
        recording: text("recording"),
        track: text("track"),
        change,
    };
    let fit_markers = |subject| Effect::FitMarkers {
        recording: text("recording"),
        markers: text("markers"),
        subject,
        millimetres: 12,
    };
    let change_sign = |former| Effect::ChangeSign {
        sign: text("sign"),
        former,
        annotations: 2,
    };
    vec![
        Effect::Import {
            count,
            first: text("first"),
            last: text("last"),
        },
        Effect::Recombine {
            gloss: gloss.clone(),
            recipe: text("recipe"),
        },
        Effect::RecombineAgain {
            gloss: gloss.clone(),
            recipe: text("recipe"),
        },
        Effect::Annotate(annotations(all_deeds)),
        Effect::Propose(annotations(vec![Deed::AnnotationsAdded { count }])),
        Effect::Accept {
            count,
            annotations: annotations(vec![Deed::AnnotationsRemoved { count }]),
        },
        Effect::Reject {
            count,
            annotations: annotations(vec![Deed::AnnotationsRemoved { count }]),
        },
        Effect::Adjudicate { tier: tier.clone() },
        Effect::PreferAnnotator {
            annotator: text("anna"),
        },
        Effect::AddTier {
            tier: tier.clone(),
            recording: recording.clone(),
        },
        Effect::ChangeTier {
            tier: tier.clone(),
            recording: recording.clone(),
        },
        Effect::RemoveTier {
            tiers: vec![tier.clone()],
            annotations: 1,
            recording: recording.clone(),
        },
        Effect::AddTiers {
            count,
            recording: recording.clone(),
        },
        Effect::CopyTier {
            tier,
            recording: recording.clone(),
            copy: text("copy"),
            annotations: 2,
        },
        Effect::WorkOnTiers {
            deed: TierRoundDeed::Shifted,
            tiers: 3,
            recordings: 2,
        },
        Effect::OrderTiers {
            recording: recording.clone(),
        },
        Effect::AddValue {
            value: text("value"),
            inventory: text("inventory"),
        },
        Effect::MergeValues {
            value: text("value"),
            into: text("into"),
            inventory: text("inventory"),
        },
        Effect::EquateValues {
            value: text("value"),
            other: text("other"),
        },
        Effect::PartValue { value: text("value") },
        Effect::ChangeRecording {
            recording: recording.clone(),
        },
        Effect::ChangeSigner { signer: text("signer") },
        change_sign(None),
        change_sign(Some(text("former"))),
        Effect::SetCitation {
            token: 7,
            gloss: gloss.clone(),
        },
        Effect::ChangePerson { person: text("Ada") },
        Effect::RelateSigns {
            count: 2,
            relation: "variant".into(),
        },
        Effect::UniteLexicons {
            names: vec![text("A")],
            lexicon: text("B"),
        },
        Effect::UnitePeople {
            names: vec![text("ada"), text("A.L.")],
            person: text("Ada"),
        },
        Effect::RemovePerson { person: text("Bo") },
        Effect::ImportPeople {
            file: text("people.csv"),
            people: 2,
        },
        Effect::ChangeLexicon { lexicon: text("NGT") },
        Effect::LinkLexicon {
            lexicon: text("NGT"),
            recordings: 2,
        },
        Effect::UnlinkLexicon { recordings: 2 },
        Effect::MeasureSigns { signs: 2145 },
        Effect::RemoveLexicon { lexicon: "BSL".into() },
        Effect::Transcribe {
            token: 7,
            gloss: gloss.clone(),
        },
        Effect::AddTracks {
            recording: recording.clone(),
            tracks: vec![text("one"), text("two")],
        },
        change_track(TrackEffect::Moved {
            seconds: "1.500000".into(),
        }),
        change_track(TrackEffect::Renamed { to: text("to") }),
        change_track(TrackEffect::Removed),
        Effect::ChangeMedia {
            recording: recording.clone(),
        },
        fit_markers(None),
        fit_markers(Some(text("subject"))),
        Effect::RestoreMarkers {
            places: 5,
            recordings: 1,
        },
        Effect::FitFace {
            track: text("track"),
            signer: text("signer"),
            recording,
        },
        Effect::CueFromDictionary { gloss, movements: 8 },
        Effect::FindTargets { keys: 1, recordings: 2 },
        Effect::KeepSearch {
            names: vec![text("one"), text("two")],
        },
        Effect::RenameSearch {
            from: text("from"),
            to: text("to"),
        },
        Effect::ForgetSearch { name: text("name") },
        Effect::Delete {
            names: vec![text("one"), text("two")],
        },
        Effect::PlanStudy { study: study.clone() },
        Effect::ImportAnswers {
            study: study.clone(),
            participants: 2,
        },
        Effect::ForgetParticipant { study: study.clone() },
        Effect::DeleteStudy { study },
        Effect::ChangeConsent {
            names: vec![text("one")],
        },
        Effect::Merge {
            from: text("from"),
            added: 1,
            changed: 2,
            removed: 0,
            conflicts: 1,
        },
        Effect::Decide {
            conflicts: vec![1, 2],
            decision: ConflictDecision::Theirs,
        },
        Effect::Mend {},
    ]
}

#[test]
fn every_operation_has_its_sentence_with_all_its_names_in_both_languages() {
    let mut used = BTreeSet::new();
    for effect in all_effects() {
        let (name, summary, json) = effect.stored_texts();
        let json = json.expect("a value");
        let read = OperationEffect::from_stored_texts(&name, &summary, Some(&json));
        assert_eq!(read, effect, "{json}");
        let ids = json.split("\"does\":\"").skip(1);
        used.extend(ids.filter_map(|rest| rest.split('"').next().map(str::to_owned)));
        let [english, french] = [InterfaceLanguage::English, InterfaceLanguage::French]
            .map(|language| operation_sentence(&effect, language));
        for sentence in [&english, &french] {
            assert!(!sentence.contains(['{', '}']), "{sentence}");
            assert!(!sentence.contains("  "), "{sentence}");
            let names = json.split('<').skip(1);
            for name in names.filter_map(|rest| rest.split('>').next()) {
                assert!(sentence.contains(&format!("<{name}>")), "{sentence}: {name}");
            }
        }
        assert_ne!(english, french, "{json}");
    }
    let further = [
        "rename-sign",
        "fit-markers-of-person",
        "undone",
        "delete-undone",
        "summary-only",
    ];
    used.extend(further.map(str::to_owned));
    used.insert("annotations-removed-undone".to_owned());
    // The error of an unknown name lists all names.
    let error = serde_json::from_str::<OperationEffect>("{\"does\":\"?\"}").expect_err("unknown");
    let error = error.to_string();
    let variants: Vec<&str> = error.split('`').skip(3).step_by(2).collect();
    assert!(variants.len() > 40, "{error}");
    assert!(variants.iter().all(|name| used.contains(*name)), "{error}");
    let known = load_message_patterns(InterfaceLanguage::French)
        .keys()
        .filter_map(|id| id.strip_prefix("history-"));
    let known = known
        .filter(|id| !id.starts_with("summary-only-") && !id.starts_with("row-"))
        .map(str::to_owned);
    assert_eq!(known.collect::<BTreeSet<_>>(), used);
}

#[test]
fn operations_are_sentences_in_both_languages() {
    use AnnotationDeed as Deed;
    let valued = |count, of, value: &str| Deed::AnnotationsValued {
        count,
        of,
        value: value.into(),
    };
    let in_both = |changes| AnnotationEffect {
        changes,
        recordings: 2,
        recording: String::new(),
    };
    let import = |count, first: &str, last: &str| OperationEffect::Import {
        count,
        first: first.into(),
        last: last.into(),
    };
    for (effect, english, french) in [
        (
            OperationEffect::Propose(in_both(vec![Deed::AnnotationsAdded { count: 3 }])),
            "Proposed from movement: 3 annotations added in 2 recordings",
            "Proposé d’après le mouvement : 3 annotations ajoutées dans 2 enregistrements",
        ),
        (
            OperationEffect::Annotate(annotations(vec![
                Deed::AnnotationsAdded { count: 2 },
                Deed::AnnotationsRemoved { count: 1 },
            ])),
            "2 annotations added, 1 annotation removed in Un",
            "2 annotations ajoutées, 1 annotation supprimée dans Un",
        ),
        (
            OperationEffect::Annotate(annotations(vec![
                Deed::AnnotationsMoved { count: 1 },
                valued(2, ValuedThing::Gloss, "A, moved in B"),
            ])),
            "1 annotation moved, 2 glosses changed to A, moved in B in Un",
            "1 annotation déplacée, 2 gloses changées en A, moved in B dans Un",
        ),
        (
            OperationEffect::Annotate(annotations(vec![valued(1, ValuedThing::Handshape, "U")])),
            "1 handshape changed to U in Un",
            "1 configuration changée en U dans Un",
        ),
        (
            OperationEffect::Recombine {
                gloss: "note: X".into(),
                recipe: "BOL | swap".into(),
            },
            "note: X made: BOL | swap",
            "note: X composé : BOL | swap",
        ),
        (import(1, "a.bvh", "a.bvh"), "Imported: a.bvh", "Importé : a.bvh"),
        (import(0, "", ""), "Imported: nothing new", "Importé : rien de nouveau"),
        (
            import(2, "talk in Paris to Lyon.bvh", "talk in Paris to Lyon.eaf"),
            "Imported: 2 files from talk in Paris to Lyon.bvh to talk in Paris to Lyon.eaf",
            "Importé : 2 fichiers, de talk in Paris to Lyon.bvh à talk in Paris to Lyon.eaf",
        ),
        (
            OperationEffect::Accept {
                count: 2,
                annotations: annotations(Vec::new()),
            },
            "Proposed values accepted: 2, in Un",
            "Valeurs proposées acceptées : 2, dans Un",
        ),
        (
            OperationEffect::Reject {
                count: 2,
                annotations: annotations(Vec::new()),
            },
            "Proposed values rejected: 2, in Un",
            "Valeurs proposées rejetées : 2, dans Un",
        ),
        (
            OperationEffect::SummaryOnly {
                name: "novel".into(),
                summary: "x".into(),
            },
            "novel: x",
            "novel : x",
        ),
    ] {
        assert_eq!(operation_sentence(&effect, InterfaceLanguage::English), english);
        assert_eq!(operation_sentence(&effect, InterfaceLanguage::French), french);
    }
}

#[test]
fn undoing_a_removal_reads_as_a_restoration() {
    let removed = |count| {
        let changes = vec![AnnotationDeed::AnnotationsRemoved { count }];
        OperationEffect::Annotate(annotations(changes))
    };
    let merged = vec![AnnotationDeed::AnnotationsMerged { count: 2 }];
    for (effect, english, french) in [
        (
            removed(3),
            "3 annotations restored in Un",
            "3 annotations rétablies dans Un",
        ),
        (
            removed(1),
            "1 annotation restored in Un",
            "1 annotation rétablie dans Un",
        ),
        (
            OperationEffect::Annotate(annotations(merged)),
            "Undone: 2 annotations merged in Un",
            "Annulé : 2 annotations fusionnées dans Un",
        ),
        (
            OperationEffect::Delete {
                names: vec!["escargot".into(), "B".into()],
            },
            "Restored: escargot, B",
            "Rétabli : escargot, B",
        ),
    ] {
        assert_eq!(undo_sentence(&effect, InterfaceLanguage::English), english);
        assert_eq!(undo_sentence(&effect, InterfaceLanguage::French), french);
    }
}

/// Summaries that programs of earlier versions stored: what they meant is read, and a summary with two readings stays text.
#[test]
fn old_summaries_are_read_if_they_have_one_reading() {
    for (name, summary, french) in [
        ("import", "nothing new", "Importé : rien de nouveau"),
        (
            "import",
            "27 files from aimer.bvh to week-end.eaf",
            "Importé : 27 fichiers, de aimer.bvh à week-end.eaf",
        ),
        (
            "import",
            "2 files from talk in Paris to Lyon.bvh to talk in Paris to Lyon.eaf",
            "Importé : 2 files from talk in Paris to Lyon.bvh to talk in Paris to Lyon.eaf",
        ),
        ("recombine", "note: X = BOL | swap", "note: X composé : BOL | swap"),
        (
            "annotate",
            "2 added, 1 removed in Un",
            "2 annotations ajoutées, 1 annotation supprimée dans Un",
        ),
        (
            "annotate",
            "1 annotation moved, 2 glosses changed to A, B in Un",
            "1 annotation déplacée, 2 gloses changées en A, B dans Un",
        ),
        (
            "annotate",
            "3 annotations say something else in 2 recordings",
            "3 annotations disent autre chose dans 2 enregistrements",
        ),
        (
            "annotate",
            "1 added in talk in Paris",
            "Annotations : 1 added in talk in Paris",
        ),
        (
            "accept",
            "2 added, 2 removed in Un",
            "Valeurs proposées acceptées : 2, dans Un",
        ),
        ("keep search", "chins", "Recherche enregistrée : chins"),
        (
            "merge values",
            "2S into 2s in hands",
            "Valeur 2S fusionnée avec 2s dans hands",
        ),
        ("add tier", "\"a \\\"b\\\" to\" to Un", "Acteur a \"b\" to ajouté à Un"),
        (
            "remove tier",
            "Gloss with 2 annotations from Un",
            "Acteur supprimé : Gloss with 2 annotations from Un",
        ),
        ("novel", "x", "novel : x"),
    ] {
        let effect = effect_of_summary(name, summary);
        let unread = OperationEffect::from_stored_texts(name, summary, None);
        let effect = effect.unwrap_or(unread);
        assert_eq!(operation_sentence(&effect, InterfaceLanguage::French), french);
        let (stored_name, stored_summary, _) = effect.stored_texts();
        assert_eq!((stored_name.as_str(), stored_summary.as_str()), (name, summary));
    }
}

/// The names of tiers and recordings are not cut at the words of the line.
#[test]
fn changes_of_rows_are_lines_in_both_languages() {
    let field = |name: &str, from: Value, to: Value| FieldChange {
        field: name.into(),
        from,
        to,
    };
    let change = |kind, fields| ChangedRow {
        what: "annotation",
        id: Some(1),
        name: "note: X".into(),
        place: None,
        place_names: vec!["A of B".into(), "talk, 1 to 2".into()],
        kind,
        fields,
    };
    let span = || {
        let start = field("start_us", Value::Null, 100_000.into());
        vec![start, field("end_us", Value::Null, 200_000.into())]
    };
    let changed = vec![
        field("value", "note: X".into(), "Y; value from Z".into()),
        field("annotator", Value::Null, "Zoé".into()),
    ];
    for (change, english, french) in [
        (
            change(ChangeKind::Added, span()),
            "added annotation \"note: X\" on A of B of talk, 1 to 2, 0.100s to 0.200s",
            "annotation \"note: X\" ajoutée sur A of B de talk, 1 to 2, de 0.100s à 0.200s",
        ),
        (
            change(ChangeKind::Changed, changed),
            "annotation \"note: X\" on A of B of talk, 1 to 2: value from \"note: X\" to \"Y; value from Z\"; \
             annotator from nothing to \"Zoé\"",
            "annotation \"note: X\" sur A of B de talk, 1 to 2 : valeur : \"note: X\" → \"Y; value from Z\" ; \
             annotateur : rien → \"Zoé\"",
        ),
        (
            change(ChangeKind::Changed, Vec::new()),
            "annotation \"note: X\" on A of B of talk, 1 to 2: its order or form",
            "annotation \"note: X\" sur A of B de talk, 1 to 2 : son ordre ou sa forme",
        ),
    ] {
        assert_eq!(change_sentence(&change, InterfaceLanguage::English), english);
        assert_eq!(change_sentence(&change, InterfaceLanguage::French), french);
    }
}
