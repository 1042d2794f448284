//! Tests of moving tiers, and of putting them below another tier.

use super::*;

fn change(corpus: &mut Corpus, name: &str, change: &TierChange) -> Result<TierRow> {
    let tier = TierName::read(name, Some(&Name::Number(1))).expect("a name");
    corpus.change_tier(&tier, change)
}

fn names(corpus: &Corpus) -> Vec<String> {
    let tiers = tier_rows::tiers(corpus.store.read(), 1).expect("read");
    tiers.into_iter().map(|tier| tier.name).collect()
}

fn hang(parent: Option<(&str, Stereotype)>) -> TierChange {
    TierChange {
        parent: Some(parent.map(|(name, stereotype)| (name.to_owned(), stereotype))),
        ..TierChange::default()
    }
}

#[test]
fn a_tier_is_moved_among_the_others_and_undo_moves_it_back() {
    let (_folder, mut corpus) = corpus();
    let before = names(&corpus);
    for (place, want) in [(0, 0), (4, 4), (99, before.len() - 1)] {
        let to = TierChange {
            place: Some(place),
            ..TierChange::default()
        };
        change(&mut corpus, "C", &to).expect("moved");
        let now = names(&corpus);
        assert_eq!(now.iter().position(|name| name == "C"), Some(want));
        let without = |all: &[String]| {
            all.iter()
                .filter(|it| *it != "C")
                .cloned()
                .collect::<Vec<_>>()
        };
        assert_eq!(without(&now), without(&before));
        corpus.undo().expect("undone");
        assert_eq!(names(&corpus), before);
    }
}

#[test]
fn a_tier_becomes_a_child_only_if_its_annotations_lie_inside() {
    let (_folder, mut corpus) = corpus();
    annotate(
        &mut corpus,
        "add G 0-100 BOL; add C 10-50 U; add L 90-120 chin",
    )
    .expect("added");
    let below = |it| hang(Some(("G", it)));
    let row = change(&mut corpus, "C", &below(Stereotype::IncludedIn)).expect("hung");
    assert_eq!(row.stereotype, Some(Stereotype::IncludedIn));
    let connection = corpus.store.read();
    let glosses =
        tier_rows::annotations(connection, row.parent_id.expect("a parent")).expect("read");
    let own = tier_rows::annotations(connection, row.id).expect("read");
    assert_eq!(own[0].parent_id, Some(glosses[0].id));
    let row = change(&mut corpus, "C", &hang(None)).expect("freed");
    assert_eq!((row.parent_id, row.stereotype), (None, None));
    for (tier, to, want) in [
        (
            "L",
            below(Stereotype::IncludedIn),
            "inside one of the tier above",
        ),
        (
            "C",
            below(Stereotype::TimeSubdivision),
            "Choose Included_In",
        ),
        ("G", hang(Some(("I", Stereotype::IncludedIn))), "below"),
        (
            "C",
            hang(Some(("nothing", Stereotype::IncludedIn))),
            "no tier",
        ),
    ] {
        let before = rows(corpus.store.read());
        let error = change(&mut corpus, tier, &to).expect_err(want);
        let message = format!("{error} {}", error.remedy().unwrap_or_default());
        assert!(
            message.to_lowercase().contains(&want.to_lowercase()),
            "{tier}: {message}"
        );
        assert_eq!(rows(corpus.store.read()), before);
    }
}
