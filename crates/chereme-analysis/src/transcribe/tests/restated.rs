//! Compares the values that notation states about an act with its recorded features.

use chereme_sign::hamnosys::{HamnosysSign, NonmanualActs, NotatedMotion, from_names, parse_hamnosys};

use super::movements::{captured, one_hand, places, two_hands};
use super::*;
use crate::transcribe::resynthesis::replaced::{list_single_acts, replace_transcribed_actions, stated_act_values};

#[test]
fn notation_states_the_features_that_are_recorded() {
    let cases = [one_hand(), places(), two_hands(), captured()];
    let mut compared = 0;
    for case in cases.iter().flatten() {
        let found = transcribe_clip(&case.clip, &case.anatomy, &case.options).expect("a sign");
        let acts = list_single_acts(&found.sign.parts[0].actions);
        assert_eq!(acts.len(), found.stages.len() - 1, "{}", case.name);
        for (act, stage) in acts.into_iter().zip(&found.stages[1..]) {
            let own =
                |it: &&NotationFeature| it.action == stage.action && (stage.hand.is_none() || it.hand == stage.hand);
            // The number of times is not in the notation.
            let value = |kind: FeatureKind, words: &str| match kind {
                FeatureKind::Repetition => String::new(),
                _ => words.to_owned(),
            };
            let recorded = found.features.iter().filter(own);
            let mut recorded: Vec<(FeatureKind, String, String)> = recorded
                .map(|it| (it.kind, value(it.kind, &it.value), it.text.clone()))
                .collect();
            let has_manner = recorded.iter().any(|it| it.0 == FeatureKind::Manner);
            let stated = stated_act_values(act, 2.0)
                .into_iter()
                .filter(|it| has_manner || it.0 != FeatureKind::Manner);
            let mut stated: Vec<_> = stated
                .map(|(kind, it)| (kind, value(kind, &it.words), it.text))
                .collect();
            recorded.sort();
            stated.sort();
            assert_eq!(stated, recorded, "{}, action {:?}", case.name, stage.action);
            compared += stated.len();
        }
    }
    assert!(compared > 100, "{compared}");
}

/// Returns the actions that symbols without their first three letters mean.
fn actions(names: &str) -> Vec<NotatedMotion> {
    let names = names.split(' ').map(|it| format!("ham{it}"));
    let names: Vec<String> = names.collect();
    let text = from_names(names.iter().map(String::as_str)).expect("symbols");
    let mut sign = parse_hamnosys(&text).expect("a movement").sign;
    sign.parts.swap_remove(0).actions
}

#[test]
fn every_mark_of_a_repetition_adds_to_its_times() {
    for (movement, times, symbols) in [
        ("moveo repeatfromstart", "2 times", 1),
        ("moveo repeatfromstartseveral", "3 times", 1),
        ("moveo repeatfromstart repeatfromstart", "3 times", 2),
        ("moveo repeatfromstartseveral repeatfromstartseveral", "5 times", 2),
    ] {
        let stated = stated_act_values(&actions(movement)[0], 2.0);
        let repetition = stated.iter().find(|it| it.0 == FeatureKind::Repetition);
        let (_, repetition) = repetition.expect("a repetition");
        assert_eq!(repetition.words, times, "{movement}");
        assert_eq!(repetition.text.chars().count(), symbols, "{movement}");
    }
}

#[test]
fn features_follow_actions_that_are_replaced() {
    let [from, to] = [
        "moveo smallmod chest touch moved repeatfromstart",
        "moveo fast moved repeatfromstartseveral",
    ]
    .map(actions);
    let feature = |(action, kind, value): (usize, FeatureKind, &str)| NotationFeature {
        kind,
        hand: None,
        frame: 7 * action,
        frames: (7 * action, 7 * action + 7),
        action: Some(action),
        value: value.to_owned(),
        text: String::new(),
        residual: 0.25,
        unit: ResidualUnit::Share,
        runner_up: None,
    };
    let stage = |action: usize| TranscriptionStage {
        action: Some(action).filter(|action| *action > 0),
        hand: None,
        frames: (7 * action, 7 * action + 7),
        text: String::new(),
    };
    let mut found = TokenTranscription {
        sign: HamnosysSign::default(),
        features: [
            (1, FeatureKind::Movement, "straight"),
            (1, FeatureKind::Course, "o"),
            (1, FeatureKind::Size, "small"),
            (1, FeatureKind::Manner, "usual"),
            (1, FeatureKind::Location, "chest"),
            (1, FeatureKind::Contact, "touch"),
            (2, FeatureKind::Movement, "straight"),
            (2, FeatureKind::Course, "d"),
            (2, FeatureKind::Size, "usual"),
            (2, FeatureKind::Repetition, "2 times"),
        ]
        .map(feature)
        .to_vec(),
        stages: [0, 1, 2].map(stage).to_vec(),
        frames: (0, 21),
        nonmanual: NonmanualActs::default(),
        findings: Vec::new(),
    };
    replace_transcribed_actions(&mut found, [&from, &to], [0.021, 0.0004], 2.0);
    let words: Vec<String> = found
        .features
        .iter()
        .map(|it| {
            let next = it.runner_up.as_ref();
            let next = next.map_or(String::new(), |it| {
                format!(" rather than {} {:.2}", it.value, it.residual)
            });
            let (value, residual, unit) = (&it.value, it.residual, it.unit.residual_unit_symbol());
            format!("{} {value} {residual:.2}{unit}{next}", it.kind.feature_kind_name())
        })
        .collect();
    assert_eq!(
        words,
        [
            "movement straight 0.25",
            "course o 0.25",
            "size usual 0.04 cm rather than small 2.10",
            "manner fast 0.04 cm rather than usual 2.10",
            "movement straight 0.25",
            "course d 0.25",
            "size usual 0.25",
            "repetition 3 times 0.04 cm rather than 2 times 2.10",
        ]
    );
    let stages = found.stages[1..].iter().map(|it| to_names(&it.text));
    let stages: Vec<String> = stages.map(|it| it.expect("symbols").join(" ")).collect();
    assert_eq!(stages, ["hammoveo hamfast", "hammoved hamrepeatfromstartseveral"]);
    assert_eq!(
        found.findings,
        [
            "re-synthesised, the movement hammoveo hamfast hammoved hamrepeatfromstartseveral is 0.0 cm from the observed one; \
          hammoveo hamsmallmod hamchest hamtouch hammoved hamrepeatfromstart, which was read first, is 2.1 cm from it"
        ]
    );
}
