//! A draft gives the same result as an evaluation from scratch, and evaluates only the changed parts.

use crate::{evaluate_recipe, resolve_recipe};
use std::cell::RefCell;

use super::*;
use crate::error::SourceError;
use crate::sources::{
    AlphabetLetter, ComponentValue, LearnedProfile, MovementMaterial, RecipeSources, SpellingTimes, TokenExample,
};
use crate::{BodyLanguageChanges, Recipe, RecipeDraft};

/// Sources that record the questions.
struct Asked {
    shelf: Shelf,
    materials: RefCell<Vec<String>>,
}

impl Asked {
    fn new() -> Self {
        Self {
            shelf: Shelf::new(),
            materials: RefCell::default(),
        }
    }

    fn take(&self) -> usize {
        self.materials.take().len()
    }
}

impl RecipeSources for Asked {
    fn find_material(&self, address: &str) -> Result<MovementMaterial, SourceError> {
        self.materials.borrow_mut().push(address.to_owned());
        self.shelf.find_material(address)
    }

    fn stage(&self, signer: Option<&str>) -> Result<MovementMaterial, SourceError> {
        self.shelf.stage(signer)
    }

    fn find_component_value(&self, component: SignComponent, text: &str) -> Result<ComponentValue, SourceError> {
        self.shelf.find_component_value(component, text)
    }

    fn list_component_values(&self, component: SignComponent) -> Vec<ComponentValue> {
        self.shelf.list_component_values(component)
    }

    fn holding(&self, component: SignComponent, value: &str) -> Result<Vec<TokenExample>, SourceError> {
        self.shelf.holding(component, value)
    }

    fn find_best_examples(&self, query: &str, signer: Option<&str>) -> Result<Vec<TokenExample>, SourceError> {
        self.shelf.find_best_examples(query, signer)
    }

    fn find_alphabet_letters(&self, alphabet: Option<&str>, word: &str) -> Result<Vec<AlphabetLetter>, SourceError> {
        self.shelf.find_alphabet_letters(alphabet, word)
    }

    fn learned_profile(&self) -> Result<Option<LearnedProfile>, SourceError> {
        self.shelf.learned_profile()
    }

    fn find_named_notation(&self, name: &str) -> Result<Vec<chereme_sign::hamnosys::NotatedSign>, SourceError> {
        self.shelf.find_named_notation(name)
    }

    fn body_language(&self, named: Option<&str>, signer: Option<&str>) -> Result<BodyLanguageChanges, SourceError> {
        self.shelf.body_language(named, signer)
    }

    fn spelling_times(&self) -> Result<SpellingTimes, SourceError> {
        self.shelf.spelling_times()
    }
}

fn recipe(text: &str) -> Recipe {
    text.parse().unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// Recipes as successive edits of a person's work: a setting, an operator's position, the source or a piece changes.
const SOURCES: [&str; 4] = [
    "ESCARGOT",
    "BOL",
    "point right at 30cm,140cm,50cm hold 0.2s",
    "(ESCARGOT | place right by up 2cm then BOL then CHAT)",
];
const STEPS: [&str; 9] = [
    "configure right U",
    "configure right _",
    "place both by left 5cm up 2cm",
    "place both by right 5cm",
    "place right at chin",
    "swap",
    "reverse",
    "repeat 2 gap 0.1s",
    "amplify both 1.2",
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn a_draft_gives_the_same_result_as_a_fresh_evaluation(
        all in prop::collection::vec(
            (0..SOURCES.len(), prop::collection::vec(0..STEPS.len(), 0..4)),
            2..6,
        )
    ) {
        let shelf = Shelf::new();
        let mut draft = RecipeDraft::default();
        for (source, steps) in all {
            let mut text = SOURCES[source].to_owned();
            for step in steps {
                text = format!("{text} | {}", STEPS[step]);
            }
            let recipe = recipe(&text);
            let whole = resolve_recipe(&recipe, &shelf).and_then(|resolved| evaluate_recipe(&resolved));
            let made = draft.generate_draft(&recipe, &shelf, &|| true);
            match (made, whole) {
                (Ok(made), Ok(whole)) => prop_assert_eq!(made, whole),
                (Err(a), Err(b)) => prop_assert_eq!(a.to_string(), b.to_string()),
                (a, b) => prop_assert!(false, "{text}: {a:?} and {b:?}"),
            }
        }
    }
}

#[test]
fn unchanged_sources_are_not_looked_up_again() {
    let sources = Asked::new();
    let mut draft = RecipeDraft::default();
    let mut asked = |text: &str| {
        draft
            .generate_draft(&recipe(text), &sources, &|| true)
            .unwrap_or_else(|error| panic!("{text}: {error}"));
        sources.take()
    };
    assert!(asked("ESCARGOT") > 0);
    assert_eq!(asked("ESCARGOT | swap"), 0, "the source is the same");
    assert!(asked("ESCARGOT | configure right U | swap") > 0);
    for text in [
        "ESCARGOT | configure right U | place both by up 2cm",
        "ESCARGOT | configure right U | place both by up 3cm",
        "ESCARGOT | place both by up 3cm | configure right U",
        "ESCARGOT | configure right U | place both by up 3cm",
    ] {
        assert_eq!(asked(text), 0, "{text}");
    }
    assert_eq!(asked("ESCARGOT | configure right U then ESCARGOT"), 1);
    assert_eq!(asked("ESCARGOT | configure right U then ESCARGOT | swap"), 0);
    draft.forget_draft_results();
    let made = draft.generate_draft(&recipe("ESCARGOT"), &sources, &|| true);
    assert!(made.is_ok() && sources.take() > 0);
}

#[test]
fn a_cancelled_evaluation_stops_and_keeps_its_finished_steps() {
    let shelf = Shelf::new();
    let mut draft = RecipeDraft::default();
    let text = recipe("ESCARGOT | swap | reverse | amplify both 1.2");
    let left = std::cell::Cell::new(3);
    let goes_on = || {
        left.set(left.get() - 1);
        left.get() >= 0
    };
    let stopped = draft.generate_draft(&text, &shelf, &goes_on);
    assert!(matches!(
        stopped,
        Err(MakeError {
            cause: StepError::Stopped,
            ..
        })
    ));
    left.set(1);
    let made = draft.generate_draft(&text, &shelf, &goes_on);
    let made = made.expect("only one step is left to take");
    let whole = resolve_recipe(&text, &shelf).and_then(|resolved| evaluate_recipe(&resolved));
    assert_eq!(made, whole.expect("a recipe that can be made"));
}
