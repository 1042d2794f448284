//! The JSON spelling of a recipe: a version and the tree.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::{Recipe, RecipeNode};
use crate::error::RecipeError;

/// The version of the tree that this engine reads and writes.
pub const RECIPE_TREE_VERSION: u64 = 1;

/// A recipe's JSON object before its version is checked.
#[derive(Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct VersionedRecipe(Map<String, Value>);

impl TryFrom<VersionedRecipe> for Recipe {
    type Error = RecipeError;

    fn try_from(VersionedRecipe(mut fields): VersionedRecipe) -> Result<Self, RecipeError> {
        match fields.remove("version") {
            Some(Value::Number(found)) if found.as_u64() == Some(RECIPE_TREE_VERSION) => {}
            Some(found) => {
                return Err(RecipeError::Version {
                    found: found.to_string(),
                });
            }
            None => {
                return Err(RecipeError::Field {
                    message: "a recipe needs \"version\"".into(),
                });
            }
        }
        let make = fields.remove("make").ok_or_else(|| RecipeError::Field {
            message: "a recipe needs \"make\", its tree".into(),
        })?;
        if let Some(unknown) = fields.keys().next() {
            return Err(RecipeError::Field {
                message: format!("unknown field {unknown:?}; a recipe has version and make"),
            });
        }
        one_key("make", &make)?;
        let root: RecipeNode = serde_json::from_value(make).map_err(|error| RecipeError::Field {
            message: error.to_string(),
        })?;
        Self::new(root)
    }
}

/// Refuses an object with more than its one expected key; the error names the others.
fn one_key(name: &str, object: &Value) -> Result<(), RecipeError> {
    let keys: Vec<&str> = object
        .as_object()
        .into_iter()
        .flat_map(Map::keys)
        .map(String::as_str)
        .collect();
    match keys.as_slice() {
        [first, second, ..] => Err(RecipeError::Field {
            message: format!("{name:?} holds one thing, but {first:?} and {second:?} are given; leave one out"),
        }),
        _ => Ok(()),
    }
}

impl From<Recipe> for VersionedRecipe {
    fn from(recipe: Recipe) -> Self {
        let make = serde_json::to_value(&recipe.root)
            .expect("a recipe's tree has only strings, lists and objects with string keys");
        let fields = [("version", Value::from(RECIPE_TREE_VERSION)), ("make", make)];
        Self(fields.map(|(key, value)| (key.to_owned(), value)).into_iter().collect())
    }
}
