//! Scalar curves and body language go through recipes.

use std::collections::BTreeMap;

use crate::error::SourceError;
use crate::outcome::{GeneratedCurve, GeneratedMovement};
use crate::sources::{
    AlphabetLetter, ComponentValue, LearnedProfile, MovementMaterial, RecipeSources, SpellingTimes, TokenExample,
};
use crate::testing::Shelf;
use crate::testing::restore_recipe_inputs;
use crate::{BodyLanguageChanges, LanguageValue, Recipe, RecipeInput, evaluate_recipe, resolve_recipe};
use chereme_sign::SignComponent;

fn ramp(name: &str, frames: usize) -> GeneratedCurve {
    GeneratedCurve {
        name: name.to_owned(),
        values: (0..frames).map(|n| n as f64 / frames as f64).collect(),
    }
}

fn shelf() -> Shelf {
    let mut shelf = Shelf::new();
    let bol = shelf.materials.get_mut("BOL").expect("there");
    let frames = bol.clip.clip_frame_count();
    bol.curves = vec![ramp("brows.RB", frames), ramp("body.TF", frames)];
    shelf
}

fn made(recipe: &str, sources: &dyn RecipeSources) -> GeneratedMovement {
    let recipe: Recipe = recipe.parse().expect(recipe);
    let resolved = resolve_recipe(&recipe, sources).expect("resolved");
    evaluate_recipe(&resolved).expect("made")
}

fn names(made: &GeneratedMovement) -> Vec<&str> {
    made.curves.iter().map(|curve| curve.name.as_str()).collect()
}

#[test]
fn curves_keep_the_length_of_the_movement_through_every_operator() {
    let shelf = shelf();
    for recipe in [
        "BOL",
        "BOL | reverse",
        "BOL | retime 150%",
        "BOL | repeat 2 tempo 1.3",
        "BOL then LIMACE",
        "LIMACE then BOL then BOL",
        "BOL | place both by up 5cm | swap",
        "ESCARGOT | nonmanual from BOL",
        "ESCARGOT | face from BOL | face brows=raised over 0.2s..0.4s | repeat 2",
    ] {
        let made = made(recipe, &shelf);
        assert!(!made.curves.is_empty(), "{recipe}");
        for curve in &made.curves {
            assert_eq!(
                curve.values.len(),
                made.clip.clip_frame_count(),
                "{recipe} {}",
                curve.name
            );
            assert!(curve.values.iter().all(|it| (0.0..=1.0).contains(it)), "{recipe}");
        }
    }
}

#[test]
fn curves_are_reversed_joined_and_taken_over() {
    let shelf = shelf();
    let plain = made("BOL", &shelf);
    let back = made("BOL | reverse", &shelf);
    let turned: Vec<f64> = plain.curves[0].values.iter().rev().copied().collect();
    assert_eq!(back.curves[0].values, turned);

    let both = made("BOL then LIMACE", &shelf);
    assert_eq!(both.curves[0].values[..60], plain.curves[0].values[..60]);
    assert_eq!(both.curves[0].values.last(), Some(&0.0));
    let other = made("LIMACE then BOL", &shelf);
    assert_eq!(other.curves[0].values[0], 0.0);
    assert_eq!(other.curves[0].values.last(), plain.curves[0].values.last());

    assert_eq!(names(&made("ESCARGOT | nonmanual from BOL", &shelf)), ["brows.RB"]);
    assert_eq!(names(&made("BOL | nonmanual from ESCARGOT", &shelf)), ["body.TF"]);
}

/// A shelf with a body language of its own.
struct Speaking(Shelf, BodyLanguageChanges);

impl RecipeSources for Speaking {
    fn find_material(&self, address: &str) -> Result<MovementMaterial, SourceError> {
        match address {
            "stage" => self.0.stage(None),
            address => self.0.find_material(address),
        }
    }

    fn stage(&self, signer: Option<&str>) -> Result<MovementMaterial, SourceError> {
        self.0.stage(signer)
    }

    fn find_component_value(&self, component: SignComponent, text: &str) -> Result<ComponentValue, SourceError> {
        self.0.find_component_value(component, text)
    }

    fn list_component_values(&self, component: SignComponent) -> Vec<ComponentValue> {
        self.0.list_component_values(component)
    }

    fn holding(&self, component: SignComponent, value: &str) -> Result<Vec<TokenExample>, SourceError> {
        self.0.holding(component, value)
    }

    fn find_best_examples(&self, query: &str, signer: Option<&str>) -> Result<Vec<TokenExample>, SourceError> {
        self.0.find_best_examples(query, signer)
    }

    fn find_alphabet_letters(&self, alphabet: Option<&str>, word: &str) -> Result<Vec<AlphabetLetter>, SourceError> {
        self.0.find_alphabet_letters(alphabet, word)
    }

    fn learned_profile(&self) -> Result<Option<LearnedProfile>, SourceError> {
        self.0.learned_profile()
    }

    fn spelling_times(&self) -> Result<SpellingTimes, SourceError> {
        self.0.spelling_times()
    }

    fn body_language(&self, named: Option<&str>, _signer: Option<&str>) -> Result<BodyLanguageChanges, SourceError> {
        Ok(match named {
            Some("default") => BodyLanguageChanges::default(),
            _ => self.1.clone(),
        })
    }
}

#[test]
fn a_generated_sign_keeps_its_body_language() {
    let speaking = |value: f64| {
        let value = LanguageValue {
            value,
            quartiles: Some([value * 0.9, value * 1.1]),
            count: 20,
            of: "signer:1".into(),
        };
        let language = BodyLanguageChanges {
            from: "measured".into(),
            values: BTreeMap::from([("time.straight".into(), value)]),
            places: BTreeMap::new(),
        };
        Speaking(Shelf::new(), language)
    };
    let text = "hamnosys \"hamflathand hamextfingero hampalmd hamchest hammoveo\"";
    let (slow, slower) = (speaking(1.0), speaking(2.0));
    let usual = made(&format!("{text} with default"), &slow);
    let measured = made(text, &slow);
    assert!(measured.clip.clip_frame_count() > usual.clip.clip_frame_count() + 30);
    assert!(usual.report.steps[0].language.is_none());
    let step = &measured.report.steps[0];
    assert_eq!(step.language.as_ref().map(|it| it.values.len()), Some(1));
    assert!(
        step.did
            .iter()
            .any(|did| did.contains("time.straight 1.000 s, half of 20")),
        "{:?}",
        step.did
    );

    let recipe: Recipe = text.parse().expect("a recipe");
    let inputs = resolve_recipe(&recipe, &slow)
        .expect("resolved")
        .resolved_inputs()
        .clone();
    let json = serde_json::to_string(&inputs).expect("JSON");
    let inputs: crate::RecipeInputs = serde_json::from_str(&json).expect("JSON");
    assert!(inputs.0.values().any(|input| matches!(input, RecipeInput::Language(_))));
    let again = restore_recipe_inputs(&recipe, inputs, &slower).expect("restored");
    assert_eq!(evaluate_recipe(&again).expect("made").clip, measured.clip);
    assert!(made(text, &slower).clip.clip_frame_count() > measured.clip.clip_frame_count() + 30);
}

#[test]
fn the_body_language_of_notation_is_printed_as_it_is_read() {
    for text in [
        "hamnosys hamfist with default on signer:1",
        "sigml HUIS with \"my own.json\"",
        "sigml HUIS on signer:1",
    ] {
        let recipe: Recipe = text.parse().expect(text);
        assert_eq!(recipe.to_string(), text);
        let json = serde_json::to_string(&recipe).expect("JSON");
        assert_eq!(serde_json::from_str::<Recipe>(&json).expect("JSON"), recipe);
    }
    assert!("sigml HUIS with".parse::<Recipe>().is_err());
}
