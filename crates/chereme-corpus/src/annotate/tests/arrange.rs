//! Tests of moving tiers, and of putting them below another tier.

use super::*;

fn change(corpus: &mut Corpus, name: &str, change: &TierPropertyChange) -> CorpusResult<TierRow> {
    let tier = TierRequestName::parse_tier_name(name, Some(&RowName::Number(1))).expect("a name");
    corpus.change_tier_properties(&tier, change)
}

fn names(corpus: &Corpus) -> Vec<String> {
    let tiers = tier_rows::load_tier_rows(corpus.store.read_connection(), 1).expect("read");
    tiers.into_iter().map(|tier| tier.name).collect()
}

fn hang(parent: Option<(&str, TierStereotype)>) -> TierPropertyChange {
    TierPropertyChange {
        parent: Some(parent.map(|(name, stereotype)| (name.to_owned(), stereotype))),
        ..TierPropertyChange::default()
    }
}

#[test]
fn a_tier_is_moved_among_the_others_and_undo_moves_it_back() {
    let (_folder, mut corpus) = corpus();
    let before = names(&corpus);
    for (place, want) in [(0, 0), (4, 4), (99, before.len() - 1)] {
        let to = TierPropertyChange {
            place: Some(place),
            ..TierPropertyChange::default()
        };
        change(&mut corpus, "C", &to).expect("moved");
        let now = names(&corpus);
        assert_eq!(now.iter().position(|name| name == "C"), Some(want));
        let without = |all: &[String]| all.iter().filter(|it| *it != "C").cloned().collect::<Vec<_>>();
        assert_eq!(without(&now), without(&before));
        corpus.undo_operation().expect("undone");
        assert_eq!(names(&corpus), before);
    }
}

#[test]
fn a_tier_becomes_a_child_only_if_its_annotations_lie_inside() {
    let (_folder, mut corpus) = corpus();
    annotate(&mut corpus, "add G 0-100 BOL; add C 10-50 U; add L 90-120 chin").expect("added");
    let below = |it| hang(Some(("G", it)));
    let row = change(&mut corpus, "C", &below(TierStereotype::IncludedIn)).expect("hung");
    assert_eq!(row.stereotype, Some(TierStereotype::IncludedIn));
    let connection = corpus.store.read_connection();
    let glosses = tier_rows::load_tier_annotation_rows(connection, row.parent_id.expect("a parent")).expect("read");
    let own = tier_rows::load_tier_annotation_rows(connection, row.id).expect("read");
    assert_eq!(own[0].parent_id, Some(glosses[0].id));
    let row = change(&mut corpus, "C", &hang(None)).expect("freed");
    assert_eq!((row.parent_id, row.stereotype), (None, None));
    for (tier, to, want) in [
        ("L", below(TierStereotype::IncludedIn), "inside one of the tier above"),
        ("C", below(TierStereotype::TimeSubdivision), "Choose Included_In"),
        ("G", hang(Some(("I", TierStereotype::IncludedIn))), "below"),
        ("C", hang(Some(("nothing", TierStereotype::IncludedIn))), "no tier"),
    ] {
        let before = rows(corpus.store.read_connection());
        let error = change(&mut corpus, tier, &to).expect_err(want);
        let message = format!("{error} {}", error.error_remedy().unwrap_or_default());
        assert!(
            message.to_lowercase().contains(&want.to_lowercase()),
            "{tier}: {message}"
        );
        assert_eq!(rows(corpus.store.read_connection()), before);
    }
}
