//! A corpus with a single sign, as the source for recipes.

use std::sync::Arc;

use chereme_compose::{
    Example, Generated, Letter, MakeError, Material, Meaning, Recipe, SourceError, Sources, Value,
    evaluate, resolve,
};
use chereme_motion::{Anatomy, Clip, HandAngles};
use chereme_sign::{Component, Handedness};

/// One sign, named `A`, and two hand shapes: a `fist` and a `flat` hand.
pub(crate) struct Shelf(Material);

impl Shelf {
    pub(crate) fn new(clip: Clip, anatomy: &Arc<Anatomy>) -> Self {
        Self(Material {
            curves: Vec::new(),
            address: "token:1".into(),
            hash: "1".into(),
            gloss: "A".into(),
            signer: None,
            handedness: Handedness::Right,
            clip,
            anatomy: Arc::clone(anatomy),
            held: Vec::new(),
        })
    }

    /// Evaluates the recipe `A | operators`.
    pub(crate) fn make(&self, operators: &str) -> Result<Generated, MakeError> {
        let recipe: Recipe = match format!("A | {operators}").parse() {
            Ok(recipe) => recipe,
            Err(error) => unreachable!("{operators} is a recipe: {error}"),
        };
        evaluate(&resolve(&recipe, self)?)
    }
}

fn unknown(component: Component, text: &str) -> SourceError {
    SourceError::UnknownValue {
        component,
        text: text.to_owned(),
        nearest: None,
    }
}

impl Sources for Shelf {
    fn material(&self, _: &str) -> Result<Material, SourceError> {
        Ok(self.0.clone())
    }

    fn stage(&self, _: Option<&str>) -> Result<Material, SourceError> {
        Ok(self.0.clone())
    }

    fn value(&self, component: Component, text: &str) -> Result<Value, SourceError> {
        let mut all = self.values(component).into_iter();
        all.find(|value| value.id == text)
            .ok_or_else(|| unknown(component, text))
    }

    fn values(&self, component: Component) -> Vec<Value> {
        if component != Component::Configuration {
            return Vec::new();
        }
        let value = |id: &str, bend: f64| {
            let mut angles = HandAngles::default();
            for finger in &mut angles.fingers {
                finger.flexion = [bend; 3];
            }
            Value {
                id: id.to_owned(),
                inventory: "shapes".into(),
                meaning: Some(Meaning::Hand(angles)),
            }
        };
        vec![value("fist", 1.4), value("flat", 0.0)]
    }

    fn holding(&self, _: Component, _: &str) -> Result<Vec<Example>, SourceError> {
        Ok(Vec::new())
    }

    fn best(&self, _: &str, _: Option<&str>) -> Result<Vec<Example>, SourceError> {
        Ok(Vec::new())
    }

    fn letters(&self, _: Option<&str>, word: &str) -> Result<Vec<Letter>, SourceError> {
        Err(unknown(Component::Configuration, word))
    }
}
