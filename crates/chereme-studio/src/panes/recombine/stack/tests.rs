//! Tests of the stack of cards.

use super::*;
use proptest::prelude::*;
use std::collections::BTreeSet;

fn stack(text: &str) -> CardStack {
    CardStack::from_stack_recipe(&text.parse().expect(text))
}

fn ids(stack: &CardStack) -> Vec<u64> {
    stack.stack_cards().iter().map(|card| card.id).collect()
}

#[test]
fn a_recipe_is_a_card_for_each_source_and_operator() {
    let stack = stack("BOL | reverse | repeat 2 then via 0.3s spell LSF | swap");
    let kinds: Vec<bool> = stack.stack_cards().iter().map(|it| it.what.is_source()).collect();
    assert_eq!(kinds, [true, false, false, true, false]);
    assert_eq!(stack.count_stack_sources(), 2);
    assert_eq!(stack.piece_of(2), 0..3);
    let paths: Vec<(String, usize)> = stack.card_indices_by_path().into_iter().collect();
    let want = [
        ("/then/first/pipe/of", 0),
        ("/then/first/pipe/steps/0", 1),
        ("/then/first/pipe/steps/1", 2),
        ("/then/next/0", 3),
        ("/then/next/0/node/pipe/of", 3),
        ("/then/next/0/node/pipe/steps/0", 4),
    ];
    assert_eq!(paths, want.map(|(path, at)| (path.to_owned(), at)));
    assert_eq!(stack.card_at("/then/first/pipe/steps/1/place/to"), Some(2));
    assert_eq!(self::stack("BOL").card_at(""), Some(0));
    let nested = self::stack("(BOL then CHAT | swap) | reverse");
    assert_eq!(nested.stack_cards().len(), 2);
    assert_eq!(nested.card_at("/pipe/of/then/next/0/node/pipe/of"), Some(0));
}

#[test]
fn disabled_cards_keep_their_position_and_are_left_out_of_the_text() {
    let mut stack = stack("BOL | reverse | repeat 2");
    let reverse = stack.stack_cards()[1].id;
    stack.switch_stack_card(reverse);
    assert_eq!(stack.used_recipe_text(), "BOL | repeat 2");
    let before = ids(&stack);
    stack.replace_stack_recipe(&"BOL | repeat 3 | swap".parse().expect("a recipe"));
    assert_eq!(ids(&stack)[..3], before[..]);
    assert_eq!(stack.used_recipe_text(), "BOL | repeat 3 | swap");
    stack.switch_stack_card(reverse);
    assert_eq!(stack.used_recipe_text(), "BOL | reverse | repeat 3 | swap");
    let mut two = self::stack("A | reverse then B | swap then C");
    two.switch_stack_card(two.stack_cards()[2].id);
    assert_eq!(two.used_recipe_text(), "A | reverse then C");
    two.replace_stack_recipe(&"A | reverse | swap then C".parse().expect("a recipe"));
    two.switch_stack_card(two.stack_cards()[3].id);
    assert_eq!(two.used_recipe_text(), "A | reverse | swap then B | swap then C");
}

#[test]
fn incomplete_cards_are_left_out_of_the_text() {
    let mut stack = stack("BOL");
    let value = ValueChoice::Value(String::new());
    let empty = CardContent::Step(Step::Configure(chereme_corpus::recipe::ConfigureSettings {
        hand: chereme_corpus::recipe::HandChoice::Dominant,
        values: vec![value],
        via: PostureTransition::default(),
    }));
    let id = stack.add_stack_card(None, empty).expect("added");
    assert_eq!(stack.used_recipe_text(), "BOL");
    if let Some(RecipeCard {
        what: CardContent::Step(Step::Configure(it)),
        ..
    }) = stack.get_mut(id)
    {
        it.values = vec![ValueChoice::Value("U".into())];
    }
    assert_eq!(stack.used_recipe_text(), "BOL | configure dominant U");
}

#[test]
fn sources_move_together_with_their_operators() {
    let mut stack = stack("A | reverse | swap then B | mirror then C");
    let id = |stack: &CardStack, at: usize| stack.stack_cards()[at].id;
    let swap = id(&stack, 2);
    assert!(stack.shift_stack_card(swap, false));
    assert_eq!(stack.used_recipe_text(), "A | swap | reverse then B | mirror then C");
    assert!(!stack.shift_stack_card(swap, false), "a source stays first");
    assert!(stack.shift_stack_card(swap, true) && stack.shift_stack_card(swap, true));
    assert_eq!(stack.used_recipe_text(), "A | reverse then B | swap | mirror then C");
    let a = id(&stack, 0);
    assert!(stack.shift_stack_card(a, true));
    assert_eq!(stack.used_recipe_text(), "B | swap | mirror then A | reverse then C");
    assert!(stack.shift_stack_card(a, true) && !stack.shift_stack_card(a, true));
    assert_eq!(stack.used_recipe_text(), "B | swap | mirror then C then A | reverse");
    assert!(stack.move_to(a, 0));
    assert_eq!(stack.used_recipe_text(), "A | reverse then B | swap | mirror then C");
    assert!(stack.move_to(a, 4));
    assert_eq!(stack.used_recipe_text(), "B | swap | mirror then A | reverse then C");
    let copy = stack.duplicate_stack_card(a).expect("a copy");
    assert_eq!(
        stack.used_recipe_text(),
        "B | swap | mirror then A | reverse then A | reverse then C"
    );
    stack.remove_stack_card(copy);
    stack.remove_stack_card(swap);
    assert_eq!(stack.used_recipe_text(), "B | mirror then A | reverse then C");
}

const SOURCES: [&str; 7] = [
    "ESCARGOT",
    "token:41",
    "spell LSF left with lsf hold 0.2s via sigmoid 0.25s",
    "point right at 30cm,140cm,50cm with U",
    "hamnosys \"…\" on signer:1",
    "sigml HUIS",
    "(A then B | swap)",
];
const STEPS: [&str; 20] = [
    "configure right U",
    "configure both from LION via 0.1s",
    "configure right U, _",
    "configure right best(configuration=U signer=same)",
    "place both by left 25cm up 5cm",
    "place right at chin with index",
    "place left near BOL by up 5cm using fabrik",
    "reverse",
    "mirror left",
    "repeat 3 scale 0.8 tempo 1.2 gap 0.1s",
    "orient right palm up fingers forward by 30deg about up",
    "amplify both 1.5",
    "travel right down 20cm then up 20cm in 0.4s",
    "from me to left",
    "retime 1, 50%, to 0.3s",
    "nonmanual from B",
    "face brows=raised mouthing=bOl over 0.2s..0.9s",
    "face from B",
    "span 0.4s..1.9s",
    "trim",
];

fn texts() -> impl Strategy<Value = String> {
    let steps = prop::collection::vec(prop::sample::select(&STEPS[..]), 0..4);
    let piece = (prop::sample::select(&SOURCES[..]), steps).prop_map(|(source, steps)| {
        let parts: Vec<&str> = [source].into_iter().chain(steps).collect();
        parts.join(" | ")
    });
    prop::collection::vec(piece, 1..4).prop_map(|pieces| pieces.join(" then via 0.3s "))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn text_to_cards_and_back_is_the_same_recipe(text in texts(), other in texts()) {
        let recipe: Recipe = text.parse().expect("a recipe");
        let mut stack = CardStack::from_stack_recipe(&recipe);
        prop_assert_eq!(stack.used_recipe_text(), recipe.to_string());
        prop_assert_eq!(stack.used_recipe(), Some(Ok(recipe.clone())));
        let before = ids(&stack);
        stack.replace_stack_recipe(&recipe);
        prop_assert_eq!(ids(&stack), before);
        let other: Recipe = other.parse().expect("a recipe");
        stack.replace_stack_recipe(&other);
        prop_assert_eq!(stack.used_recipe(), Some(Ok(other)));
        let unique: BTreeSet<u64> = ids(&stack).into_iter().collect();
        prop_assert_eq!(unique.len(), stack.stack_cards().len());
    }

    #[test]
    fn the_text_matches_the_cards_after_any_moves_and_switches(
        text in texts(),
        moves in prop::collection::vec((0usize..12, 0usize..14, 0u8..4), 0..8),
    ) {
        let mut stack = CardStack::from_stack_recipe(&text.parse().expect("a recipe"));
        for (card, to, what) in moves {
            let Some(id) = stack.stack_cards().get(card).map(|card| card.id) else { continue };
            match what {
                0 => stack.switch_stack_card(id),
                1 => drop(stack.duplicate_stack_card(id)),
                2 => drop(stack.shift_stack_card(id, to % 2 == 0)),
                _ => drop(stack.move_to(id, to)),
            }
            prop_assert!(stack.stack_cards()[0].what.is_source());
        }
        let all = ids(&stack);
        if let Some(recipe) = stack.used_recipe() {
            let recipe = recipe.expect("in range");
            prop_assert_eq!(stack.used_recipe_text(), CardStack::from_stack_recipe(&recipe).used_recipe_text());
            stack.replace_stack_recipe(&recipe);
            let unique: BTreeSet<u64> = ids(&stack).into_iter().collect();
            let before: BTreeSet<u64> = all.into_iter().collect();
            prop_assert!(before.is_subset(&unique));
        }
    }
}
