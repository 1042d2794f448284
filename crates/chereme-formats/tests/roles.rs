//! Tests of the roles that are inferred from the names of tiers.

use chereme_formats::roles::{TierMapping, TierRoleEvidence, guess_roles};

fn check(names: &[(&str, &str)]) {
    let tiers: Vec<TierRoleEvidence<'_>> = names
        .iter()
        .map(|(name, _)| TierRoleEvidence {
            name,
            ..TierRoleEvidence::default()
        })
        .collect();
    for (guess, (name, expected)) in guess_roles(&tiers, &TierMapping::default()).iter().zip(names) {
        let hand = guess.hand.map(|hand| format!("{hand}.")).unwrap_or_default();
        let role = guess.role.as_ref().map_or("?".to_owned(), |role| role.role_name());
        assert_eq!(format!("{hand}{role}"), *expected, "{name}: {}", guess.why);
        assert_eq!(guess.role.is_none(), guess.confidence == 0.0, "{name}");
    }
}

#[test]
fn tier_names_of_several_projects_and_languages_are_understood() {
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
        ("Non-dominant POS", "weak.free"),
        ("Gloss RH part of speech", "right.free"),
        ("Wortart", "free"),
        ("Non-dominant mood", "weak.?"),
        ("RH S1", "right.gloss"),
        ("left A", "left.gloss"),
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
fn types_and_parents_help_to_infer_a_role() {
    let tiers = [
        TierRoleEvidence {
            name: "RH",
            ..TierRoleEvidence::default()
        },
        TierRoleEvidence {
            name: "tier 2",
            kind: "handshape",
            parent: Some(0),
            ..TierRoleEvidence::default()
        },
        TierRoleEvidence {
            name: "brows",
            parent: Some(0),
            ..TierRoleEvidence::default()
        },
    ];
    let guesses = guess_roles(&tiers, &TierMapping::default());
    assert_eq!(
        guesses[1].role.as_ref().map(|role| role.role_name()).as_deref(),
        Some("configuration")
    );
    assert_eq!(guesses[1].hand.map(|hand| hand.annotated_hands_name()), Some("right"));
    assert_eq!(guesses[1].confidence, 0.5);
    assert_eq!(
        guesses[1].why,
        "\"handshape\" in its type \"handshape\"; right as the tier above, \"RH\""
    );
    assert_eq!(guesses[2].hand, None);
}

#[test]
fn a_mapping_overrides_inferred_roles() {
    let mapping = TierMapping::from_json(r#"{"tiers": {"RH_*": "left.placement", "H1": "free"}}"#).expect("a mapping");
    let tiers = [
        TierRoleEvidence {
            name: "rh_config",
            ..TierRoleEvidence::default()
        },
        TierRoleEvidence {
            name: "H1",
            ..TierRoleEvidence::default()
        },
    ];
    let guesses = guess_roles(&tiers, &mapping);
    assert_eq!(
        (
            guesses[0].role.as_ref().map(|role| role.role_name()),
            guesses[0].confidence
        ),
        (Some("placement".into()), 1.0)
    );
    assert_eq!(
        guesses[1].role.as_ref().map(|role| role.role_name()).as_deref(),
        Some("free")
    );
}

#[test]
fn a_letter_of_a_type_is_no_hand_and_a_word_is() {
    for (kind, hand) in [
        ("d", None),
        ("g", None),
        ("r", None),
        ("default-lt", None),
        ("right hand", Some("right")),
        ("main gauche", Some("left")),
    ] {
        let tier = TierRoleEvidence {
            name: "Gloss",
            kind,
            ..TierRoleEvidence::default()
        };
        let guess = &guess_roles(&[tier], &TierMapping::default())[0];
        assert_eq!(guess.hand.map(|hand| hand.annotated_hands_name()), hand, "{kind}");
    }
}

#[test]
fn a_gloss_tier_one_to_one_below_another_has_glosses_too_unless_a_mapping_says_so() {
    let tier = |name, parent| TierRoleEvidence {
        name,
        kind: "",
        parent,
        one_to_one: parent.is_some(),
        ..TierRoleEvidence::default()
    };
    let below = TierRoleEvidence {
        one_to_one: false,
        ..tier("Signs of the left hand", Some(0))
    };
    let tiers = [
        tier("Lexem_Gebärde_r_A", None),
        tier("Lexeme_Sign_r_A", Some(0)),
        tier("Gebärde_r_A", Some(0)),
        tier("Sign_r_A", Some(2)),
        below,
    ];
    let roles = |mapping: &str| -> Vec<String> {
        let mapping = TierMapping::from_json(mapping).expect("a mapping");
        let guesses = guess_roles(&tiers, &mapping);
        let role = |guess: &chereme_formats::roles::TierGuess| guess.role.clone().map(|role| role.role_name());
        guesses.iter().filter_map(role).collect()
    };
    // Whether a second reading of a sign is a token is the corpus's matter.
    assert_eq!(roles("{}"), ["gloss"; 5]);
    let said = r#"{"tiers": {"Lexem_*": "comment", "Sign_r_A": "right.gloss"}}"#;
    assert_eq!(
        roles(said),
        ["comment", "gloss", "gloss", "gloss", "gloss"],
        "what a mapping says goes before"
    );
}
