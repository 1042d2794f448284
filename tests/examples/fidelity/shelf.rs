//! A corpus with a single sign, as the source for recipes.

use std::sync::Arc;

use chereme_compose::{
    AlphabetLetter, ComponentValue, GeneratedMovement, MakeError, MovementMaterial, Recipe, RecipeSources, SourceError,
    TokenExample, ValueMeaning, evaluate_recipe, resolve_recipe,
};
use chereme_motion::{BodyAnatomy, Clip, HandAngles};
use chereme_sign::{SignComponent, SignerHandedness};

/// One sign, named `A`, and two hand shapes: a `fist` and a `flat` hand.
pub(crate) struct Shelf(MovementMaterial);

impl Shelf {
    pub(crate) fn new(clip: Clip, anatomy: &Arc<BodyAnatomy>) -> Self {
        Self(MovementMaterial {
            curves: Vec::new(),
            address: "token:1".into(),
            hash: "1".into(),
            gloss: "A".into(),
            signer: None,
            handedness: SignerHandedness::Right,
            clip,
            anatomy: Arc::clone(anatomy),
            held: Vec::new(),
        })
    }

    /// Evaluates the recipe `A | operators`.
    pub(crate) fn make(&self, operators: &str) -> Result<GeneratedMovement, MakeError> {
        let recipe: Recipe = match format!("A | {operators}").parse() {
            Ok(recipe) => recipe,
            Err(error) => unreachable!("{operators} is a recipe: {error}"),
        };
        evaluate_recipe(&resolve_recipe(&recipe, self)?)
    }
}

fn unknown(component: SignComponent, text: &str) -> SourceError {
    SourceError::UnknownValue {
        component,
        text: text.to_owned(),
        nearest: None,
    }
}

impl RecipeSources for Shelf {
    fn find_material(&self, _: &str) -> Result<MovementMaterial, SourceError> {
        Ok(self.0.clone())
    }

    fn stage(&self, _: Option<&str>) -> Result<MovementMaterial, SourceError> {
        Ok(self.0.clone())
    }

    fn find_component_value(&self, component: SignComponent, text: &str) -> Result<ComponentValue, SourceError> {
        let mut all = self.list_component_values(component).into_iter();
        all.find(|value| value.id == text)
            .ok_or_else(|| unknown(component, text))
    }

    fn list_component_values(&self, component: SignComponent) -> Vec<ComponentValue> {
        if component != SignComponent::Configuration {
            return Vec::new();
        }
        let value = |id: &str, bend: f64| {
            let mut angles = HandAngles::default();
            for finger in &mut angles.fingers {
                finger.flexion = [bend; 3];
            }
            ComponentValue {
                id: id.to_owned(),
                inventory: "shapes".into(),
                meaning: Some(ValueMeaning::Hand(angles)),
            }
        };
        vec![value("fist", 1.4), value("flat", 0.0)]
    }

    fn holding(&self, _: SignComponent, _: &str) -> Result<Vec<TokenExample>, SourceError> {
        Ok(Vec::new())
    }

    fn find_best_examples(&self, _: &str, _: Option<&str>) -> Result<Vec<TokenExample>, SourceError> {
        Ok(Vec::new())
    }

    fn find_alphabet_letters(&self, _: Option<&str>, word: &str) -> Result<Vec<AlphabetLetter>, SourceError> {
        Err(unknown(SignComponent::Configuration, word))
    }
}
