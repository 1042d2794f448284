//! Tests of adding, changing and removing tiers.

use super::*;

#[test]
fn tiers_are_added_changed_and_removed() {
    let (_folder, mut corpus) = corpus();
    annotate(
        &mut corpus,
        "add G 0-100 BOL; add I 0-50 x; add C 0-100 U; add L 0-100 chin; add H 200-300 CHAT",
    )
    .expect("added");
    let tier = |name: &str| TierRequestName::parse_tier_name(name, Some(&RowName::Number(1))).expect("a name");
    let before = rows(corpus.store.read_connection());
    let change = |change: &str| {
        let component = |component| TierRole::Component {
            component,
            feature: None,
        };
        let values = |id: &str| Some(TierValueSource::Inventory(id.to_owned()));
        match change {
            "left" => TierPropertyChange {
                hand: Some(Some(chereme_formats::roles::AnnotatedHands::One(
                    "left".parse().expect("a hand"),
                ))),
                ..Default::default()
            },
            "movement" => TierPropertyChange {
                role: Some(component(SignComponent::Movement)),
                ..Default::default()
            },
            "free" => TierPropertyChange {
                values: Some(TierValueSource::Free),
                ..Default::default()
            },
            "rename" => TierPropertyChange {
                name: Some("New".into()),
                ..Default::default()
            },
            "taken" => TierPropertyChange {
                name: Some("G".into()),
                ..Default::default()
            },
            "comment" => TierPropertyChange {
                role: Some(TierRole::Comment),
                ..Default::default()
            },
            id => TierPropertyChange {
                values: values(id),
                ..Default::default()
            },
        }
    };
    for (name, what, want) in [
        ("C", "left", "BOL 0-100: right.placement=chin; CHAT 200-300"),
        (
            "C",
            "movement",
            "BOL 0-100: right.placement=chin right.movement=U; CHAT 200-300",
        ),
        (
            "C",
            "free",
            "BOL 0-100: right.configuration=U right.placement=chin; CHAT 200-300",
        ),
        (
            "C",
            "rename",
            "BOL 0-100: right.configuration=U right.placement=chin; CHAT 200-300",
        ),
        ("C", "taken", "already"),
        ("C", "placements", "is for placement"),
        ("C", "configuratons", "did you mean \"configurations\""),
        (
            "L",
            "placements",
            "BOL 0-100: right.configuration=U right.placement=chin; CHAT 200-300",
        ),
        ("G", "comment", "CHAT 200-300"),
        ("G", "left", "BOL 0-100: left.placement=chin; CHAT 200-300"),
    ] {
        match corpus.change_tier_properties(&tier(name), &change(what)) {
            Ok(_) => {
                assert_eq!(tokens_shown(&corpus), want, "{name} {what}");
                corpus.undo_operation().expect("undone");
            }
            Err(error) => {
                let message = format!("{error} {}", error.error_remedy().unwrap_or_default());
                assert!(message.contains(want), "{name} {what}: {message}");
            }
        }
        assert_eq!(rows(corpus.store.read_connection()), before, "{name} {what}");
    }
    annotate(&mut corpus, "add L 200-300 nowhere").expect("added");
    let error = corpus
        .change_tier_properties(&tier("L"), &change("placements"))
        .expect_err("a value is missing");
    assert!(error.to_string().contains("\"nowhere\" (1 times"), "{error}");
    corpus.undo_operation().expect("undone");
    let removed = corpus.remove_tier(&tier("G")).expect("removed");
    assert_eq!(
        (removed.tiers.join(" "), removed.annotations),
        ("G T I S A".to_owned(), 2)
    );
    assert_eq!(tokens_shown(&corpus), "CHAT 200-300");
    corpus.undo_operation().expect("undone");
    assert_eq!(rows(corpus.store.read_connection()), before);
    let wrong = NewTier {
        parent: Some(("S".into(), TierStereotype::IncludedIn)),
        ..NewTier::new(RowName::Number(1), "N", TierRole::Free)
    };
    assert!(
        corpus
            .add_tier(&wrong)
            .is_err_and(|error| error.to_string().contains("symbolic tier"))
    );
    let double = NewTier::new(RowName::Number(1), "G", TierRole::Free);
    assert!(corpus.add_tier(&double).is_err());
}
