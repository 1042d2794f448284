//! Sentences for work on annotations; the history stores the English form.

use std::fmt::Display;

use chereme_sign::{Component, TierRole};

use super::{Language, Text, fill};

texts! {
    ONE_HANDSHAPE: "{n} handshape changed to {value}", "{n} configuration changée en {value}";
    HANDSHAPES: "{n} handshapes changed to {value}", "{n} configurations changées en {value}";
    ONE_PLACEMENT: "{n} placement changed to {value}", "{n} emplacement changé en {value}";
    PLACEMENTS: "{n} placements changed to {value}", "{n} emplacements changés en {value}";
    ONE_MOVEMENT: "{n} movement changed to {value}", "{n} mouvement changé en {value}";
    MOVEMENTS: "{n} movements changed to {value}", "{n} mouvements changés en {value}";
    ONE_ORIENTATION: "{n} orientation changed to {value}", "{n} orientation changée en {value}";
    ORIENTATIONS: "{n} orientations changed to {value}", "{n} orientations changées en {value}";
    ONE_GLOSS: "{n} gloss changed to {value}", "{n} glose changée en {value}";
    GLOSSES: "{n} glosses changed to {value}", "{n} gloses changées en {value}";
    ONE_VALUE: "{n} annotation changed to {value}", "{n} annotation changée en {value}";
    VALUES: "{n} annotations changed to {value}", "{n} annotations changées en {value}";
    ONE_SAYS: "{n} annotation says something else", "{n} annotation dit autre chose";
    SAY: "{n} annotations say something else", "{n} annotations disent autre chose";
    ONE_MOVED: "{n} annotation moved", "{n} annotation déplacée";
    MOVED: "{n} annotations moved", "{n} annotations déplacées";
    MERGED: "{n} annotations merged", "{n} annotations fusionnées";
    ONE_SPLIT: "{n} annotation split", "{n} annotation coupée";
    SPLIT: "{n} annotations split", "{n} annotations coupées";
}

/// Returns the sentences for giving a value to annotations of a role: to one, and to several.
#[must_use]
pub fn valued(role: &TierRole) -> [Text; 2] {
    let component = match role {
        TierRole::Gloss => return [ONE_GLOSS, GLOSSES],
        TierRole::Component { component, .. } => component,
        _ => return [ONE_VALUE, VALUES],
    };
    match component {
        Component::Configuration => [ONE_HANDSHAPE, HANDSHAPES],
        Component::Placement => [ONE_PLACEMENT, PLACEMENTS],
        Component::Movement => [ONE_MOVEMENT, MOVEMENTS],
        Component::Orientation => [ONE_ORIENTATION, ORIENTATIONS],
        Component::NonManual => [ONE_VALUE, VALUES],
    }
}

/// Returns a sentence of this table, given in English, in another language; nothing for other texts.
pub(super) fn translated(english: &str, language: Language) -> Option<String> {
    let all = [
        [ONE_HANDSHAPE, HANDSHAPES],
        [ONE_PLACEMENT, PLACEMENTS],
        [ONE_MOVEMENT, MOVEMENTS],
        [ONE_ORIENTATION, ORIENTATIONS],
        [ONE_GLOSS, GLOSSES],
        [ONE_VALUE, VALUES],
        [ONE_SAYS, SAY],
        [ONE_MOVED, MOVED],
        [MERGED, MERGED],
        [ONE_SPLIT, SPLIT],
    ];
    all.into_iter().flatten().find_map(|text| {
        let (n, value) = read(text.en, english)?;
        let values: [(&str, &dyn Display); 2] = [("n", &n), ("value", &value)];
        Some(fill(text.of(language), &values))
    })
}

/// Returns the number and the value that fill a sentence.
fn read<'a>(sentence: &str, text: &'a str) -> Option<(u64, &'a str)> {
    let (n, rest) = text.split_once(' ')?;
    let wanted = sentence.strip_prefix("{n} ")?;
    let value = match wanted.strip_suffix("{value}") {
        Some(before) => rest.strip_prefix(before)?,
        None => (rest == wanted).then_some("")?,
    };
    Some((n.parse().ok()?, value))
}
