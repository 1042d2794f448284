//! What tiers are taken for.

use chereme_formats::roles::{Mapping, TierName, guess_roles};

fn check(names: &[(&str, &str)]) {
    let tiers: Vec<TierName<'_>> = names
        .iter()
        .map(|(name, _)| TierName {
            name,
            ..TierName::default()
        })
        .collect();
    for (guess, (name, expected)) in guess_roles(&tiers, &Mapping::default()).iter().zip(names) {
        let hand = guess
            .hand
            .map(|hand| format!("{hand}."))
            .unwrap_or_default();
        let role = guess
            .role
            .as_ref()
            .map_or("?".to_owned(), |role| role.name());
        assert_eq!(format!("{hand}{role}"), *expected, "{name}: {}", guess.why);
        assert_eq!(guess.role.is_none(), guess.confidence == 0.0, "{name}");
    }
}

#[test]
fn names_of_several_projects_and_languages() {
    check(&[
        ("Gloss RH", "right.gloss"),
        ("GlossL S1", "left.gloss"),
        ("GlossR S2", "right.gloss"),
        ("RH-IDgloss", "right.gloss"),
        ("LH-IDgloss", "left.gloss"),
        ("Lexem_Gebärde_r_A", "right.gloss"),
        ("Lexem_Gebärde_l_B", "left.gloss"),
        ("Lexeme_Sign_r_A", "right.gloss"),
        ("HandShape right", "right.configuration"),
        ("Hand shape (left)", "left.configuration"),
        ("RH_config", "right.configuration"),
        ("LH_placement", "left.placement"),
        ("RH_movement", "right.movement"),
        ("LH_orientation", "left.orientation"),
        ("Config MD", "right.configuration"),
        ("Config MG", "left.configuration"),
        ("Emplacement MD", "right.placement"),
        ("Mouvement main gauche", "left.movement"),
        ("Orientation de la paume", "orientation.palm"),
        ("Conf_D", "right.configuration"),
        ("H1", "dominant.gloss"),
        ("H2", "weak.gloss"),
        ("H2 handshape", "weak.configuration"),
        ("Hold", "movement.hold"),
        ("Free Translation", "translation"),
        ("Translation_into_German_A", "translation"),
        ("Traduction", "translation"),
        ("sentence", "translation"),
        ("Mouthing", "nonmanual.mouthing"),
        ("Mundbild_A", "nonmanual.mouthing"),
        ("Mundbild_Mundgestik_A", "nonmanual.mouth"),
        ("eyebrows", "nonmanual.brows"),
        ("sourcils", "nonmanual.brows"),
        ("regard", "nonmanual.gaze"),
        ("Eye gaze", "nonmanual.gaze"),
        ("Head movement", "nonmanual.head"),
        ("Non-manual", "nonmanual"),
        ("Comments RH handshape", "comment"),
        ("Commentaire", "comment"),
        ("Bewegung rechte Hand", "right.movement"),
        ("both", "both.gloss"),
        ("left", "left.gloss"),
        ("right", "right.gloss"),
        ("EBf", "nonmanual.brows"),
        ("Ci", "nonmanual.cheeks"),
        ("Hno", "nonmanual.head"),
        ("Mmo", "nonmanual.mouthing"),
        ("Mctr", "nonmanual.mouth"),
        ("non-dominant handshape", "weak.configuration"),
        ("P-Gloss", "gloss"),
        ("W-RGph", "?"),
        ("default", "?"),
        ("", "?"),
        ("日本語", "?"),
    ]);
}

#[test]
fn md_beside_mnd_is_the_dominant_hand() {
    check(&[
        ("Config MD/Dominante", "dominant.configuration"),
        ("Config MD", "dominant.configuration"),
        ("Config MND", "weak.configuration"),
        ("Conf_D", "dominant.configuration"),
        ("Conf_ND", "weak.configuration"),
    ]);
}

#[test]
fn types_and_parents_help() {
    let tiers = [
        TierName {
            name: "RH",
            ..TierName::default()
        },
        TierName {
            name: "tier 2",
            kind: "handshape",
            parent: Some(0),
        },
        TierName {
            name: "brows",
            kind: "",
            parent: Some(0),
        },
    ];
    let guesses = guess_roles(&tiers, &Mapping::default());
    assert_eq!(
        guesses[1].role.as_ref().map(|role| role.name()).as_deref(),
        Some("configuration")
    );
    assert_eq!(guesses[1].hand.map(|hand| hand.name()), Some("right"));
    assert_eq!(guesses[1].confidence, 0.5);
    assert_eq!(
        guesses[1].why,
        "\"handshape\" in its type \"handshape\"; right as the tier above, \"RH\""
    );
    assert_eq!(guesses[2].hand, None);
}

#[test]
fn a_mapping_overrides() {
    let mapping = Mapping::from_json(r#"{"tiers": {"RH_*": "left.placement", "H1": "free"}}"#)
        .expect("a mapping");
    let tiers = [
        TierName {
            name: "rh_config",
            ..TierName::default()
        },
        TierName {
            name: "H1",
            ..TierName::default()
        },
    ];
    let guesses = guess_roles(&tiers, &mapping);
    assert_eq!(
        (
            guesses[0].role.as_ref().map(|role| role.name()),
            guesses[0].confidence
        ),
        (Some("placement".into()), 1.0)
    );
    assert_eq!(
        guesses[1].role.as_ref().map(|role| role.name()).as_deref(),
        Some("free")
    );
}
