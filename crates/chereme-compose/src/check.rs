//! Checks of settings that several sources and operators share.

use crate::error::RecipeError;
use crate::recipe_settings::{PostureTransition, SigningSpot, StraightLeg, ValueChoice};
use crate::units::{BodyDirection, RecipeLength, RecipeSeconds, mean_of_directions};

/// The longest time in seconds that a recipe can state: a day.
pub(crate) const MAX_RECIPE_SECONDS: f64 = 86_400.0;

/// Checks straight legs.
pub(crate) fn check_path_legs(step: &'static str, legs: &[StraightLeg]) -> Result<(), RecipeError> {
    legs.iter().try_for_each(|leg| {
        check_step_directions(step, &leg.towards)?;
        check_step_length(step, leg.distance)?;
        check_step_time(step, "the time", leg.time, 600.0)
    })
}

pub(crate) fn check_step_directions(step: &'static str, directions: &[BodyDirection]) -> Result<(), RecipeError> {
    if mean_of_directions(directions).is_none() || directions.len() > 6 {
        let what = "the directions are missing, too many, or cancel out";
        return Err(RecipeError::Empty { step, what });
    }
    Ok(())
}

pub(crate) fn check_step_length(step: &'static str, length: RecipeLength) -> Result<(), RecipeError> {
    match length {
        RecipeLength::Metres(metres) => check_step_range(step, "the length in metres", metres, -10.0, 10.0),
        RecipeLength::Arm(share) => check_step_range(step, "the share of the arm", share, -10.0, 10.0),
    }
}

pub(crate) fn check_step_time(
    step: &'static str,
    what: &'static str,
    time: Option<RecipeSeconds>,
    most: f64,
) -> Result<(), RecipeError> {
    time.map_or(Ok(()), |time| check_step_range(step, what, time.0, 0.0, most))
}

pub(crate) fn check_step_transition(step: &'static str, via: &PostureTransition) -> Result<(), RecipeError> {
    check_step_time(step, "the transition's time", via.time, 60.0)
}

pub(crate) fn check_step_range(
    step: &'static str,
    what: &'static str,
    found: f64,
    least: f64,
    most: f64,
) -> Result<(), RecipeError> {
    if (least..=most).contains(&found) {
        return Ok(());
    }
    Err(RecipeError::Range {
        step,
        what,
        found: found.to_string(),
        least,
        most,
    })
}

pub(crate) fn check_step_choice(step: &'static str, choice: &ValueChoice) -> Result<(), RecipeError> {
    match choice {
        ValueChoice::Keep => Ok(()),
        ValueChoice::Value(text) => check_named_text(step, text, "the value is empty"),
        ValueChoice::From(text) => check_named_text(step, text, "the name of the sign is empty"),
        ValueChoice::Best(text) => check_named_text(step, text, "the query is empty"),
    }
}

pub(crate) fn check_step_spot(step: &'static str, spot: &SigningSpot) -> Result<(), RecipeError> {
    match spot {
        SigningSpot::Me | SigningSpot::You => Ok(()),
        SigningSpot::Towards(all) => check_step_directions(step, all),
        SigningSpot::Value(text) => check_named_text(step, text, "the name of the placement is empty"),
        SigningSpot::Point(point) => point.iter().try_for_each(|&at| check_step_length(step, at)),
    }
}

pub(crate) fn check_named_text(step: &'static str, text: &str, what: &'static str) -> Result<(), RecipeError> {
    if text.trim().is_empty() {
        return Err(RecipeError::Empty { step, what });
    }
    Ok(())
}

pub(crate) fn check_optional_text(
    text: Option<&str>,
    step: &'static str,
    what: &'static str,
) -> Result<(), RecipeError> {
    text.map_or(Ok(()), |text| check_named_text(step, text, what))
}

pub(crate) fn check_filled_list<T>(step: &'static str, list: &[T], what: &'static str) -> Result<(), RecipeError> {
    if list.is_empty() {
        return Err(RecipeError::Empty { step, what });
    }
    Ok(())
}
