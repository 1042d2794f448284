//! Rules for the contents of a picker: which values it shows, in which order, and in which form.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use chereme_corpus::value_pictures::expression;
use chereme_motion::HandAngles;
use chereme_sign::inventory::{InventoryValue, builtin_by_id};
use chereme_sign::text::fold;
use chereme_sign::{Component, Inventory};
use eframe::egui::{Rect, Vec2, vec2};

use crate::words::Language;

/// The form in which the values of an inventory are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PickerForm {
    /// Pictures of hands.
    Hands,
    /// Places on a body.
    Body,
    /// Arrows around a centre.
    Rose,
    /// Drawn movements.
    Glyphs,
    /// Facial expressions.
    Faces,
    /// Names only.
    Names,
}

/// Returns the form in which the values of an inventory are shown.
pub(crate) fn kind(inventory: &Inventory) -> PickerForm {
    let any = |test: fn(&InventoryValue) -> bool| inventory.values.iter().any(test);
    let directed = |value: &InventoryValue| value.direction.is_some() || value.roll.is_some();
    match inventory.component {
        Component::Configuration if inventory.values.iter().any(|it| hand(it).is_some()) => {
            PickerForm::Hands
        }
        Component::Placement if any(|value| value.landmark.is_some()) => PickerForm::Body,
        Component::Movement | Component::Orientation if any(directed) => PickerForm::Rose,
        Component::Movement if inventory.feature.is_none() => PickerForm::Glyphs,
        Component::NonManual if any_face(inventory) => PickerForm::Faces,
        _ => PickerForm::Names,
    }
}

fn any_face(inventory: &Inventory) -> bool {
    let mut values = inventory.values.iter();
    values.any(|value| expression(inventory, value).is_some())
}

/// Returns the hand posture of a value: its own, or that of the built-in handshape that it names or shares its name
/// with.
pub(crate) fn hand(value: &InventoryValue) -> Option<HandAngles> {
    static HOUSE: LazyLock<BTreeMap<String, HandAngles>> = LazyLock::new(|| {
        let values = builtin_by_id("configurations").map(|it| it.values.iter());
        let named = |value: &'static InventoryValue| {
            let pose = value.pose?;
            Some(value.spellings().map(move |text| (fold(text), pose)))
        };
        let mut all = BTreeMap::new();
        for (name, pose) in values.into_iter().flatten().filter_map(named).flatten() {
            all.entry(name).or_insert(pose);
        }
        all
    });
    let name = value.configuration.as_deref().unwrap_or(&value.id);
    value.pose.or_else(|| HOUSE.get(&fold(name)).copied())
}

/// Returns the label of a value: its id, and its name if that differs.
pub(crate) fn label(value: &InventoryValue, language: Language) -> String {
    let name = value.name(language.code());
    if fold(name) == fold(&value.id) {
        name.to_owned()
    } else {
        format!("{}, {name}", value.id)
    }
}

/// Returns a short text for a value: its id. In languages other than English, returns its name instead if the id is an
/// English word, such as `hand-back`, and not a letter or a sign.
pub(crate) fn short_name(value: &InventoryValue, language: Language) -> &str {
    let english = fold(value.name(Language::English.code()));
    let mut words = value.id.split(['-', '_', ' ']);
    let is_word = words.all(|word| word.len() > 1 && english.contains(&fold(word)));
    if language != Language::English && is_word {
        value.name(language.code())
    } else {
        &value.id
    }
}

/// Returns the indices of the values that match `filter`; those whose name begins with it come first.
pub(crate) fn fitting(inventory: &Inventory, filter: &str) -> Vec<usize> {
    let wanted = fold(filter.trim());
    let rank = |value: &InventoryValue| {
        let spellings: Vec<String> = value.spellings().map(fold).collect();
        if spellings.contains(&wanted) {
            return Some(0);
        }
        if spellings.iter().any(|it| it.starts_with(&wanted)) {
            return Some(1);
        }
        let holds = |word: &str| {
            spellings.iter().any(|it| it.contains(word))
                || value.features.iter().any(|it| fold(it).starts_with(word))
        };
        wanted.split_whitespace().all(holds).then_some(2)
    };
    let mut found: Vec<(u8, usize)> = inventory
        .values
        .iter()
        .enumerate()
        .filter_map(|(at, value)| Some((rank(value)?, at)))
        .collect();
    if !wanted.is_empty() {
        found.sort_by_key(|(rank, _)| *rank);
    }
    found.into_iter().map(|(_, at)| at).collect()
}

/// Returns whether a name in the inventory begins with a digit, so that digits must be usable as text.
pub(crate) fn has_numbers(inventory: &Inventory) -> bool {
    let digit = |text: &str| text.starts_with(|c: char| c.is_ascii_digit());
    inventory.values.iter().any(|it| it.spellings().any(digit))
}

/// Returns the least size of a cell, in points.
pub(crate) fn cell(kind: PickerForm) -> Vec2 {
    match kind {
        PickerForm::Hands | PickerForm::Faces => vec2(84.0, 98.0),
        PickerForm::Glyphs => vec2(84.0, 72.0),
        _ => vec2(150.0, 30.0),
    }
}

/// Returns the preferred width of a picker, in points.
pub(crate) fn width(kind: PickerForm) -> f32 {
    match kind {
        PickerForm::Body => 780.0,
        PickerForm::Hands | PickerForm::Faces => 660.0,
        PickerForm::Rose | PickerForm::Glyphs => 460.0,
        PickerForm::Names => 340.0,
    }
}

/// Returns the preferred height of a picker, in points.
pub(crate) fn height(kind: PickerForm) -> f32 {
    match kind {
        PickerForm::Body => 560.0,
        _ => 440.0,
    }
}

/// A direction for walking through cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum StepDirection {
    Left,
    Right,
    Up,
    Down,
}

/// Returns the next cell from `at` in a direction: the nearest of those that lie more in that direction than to its
/// side. Without such a cell, left and right continue in the order of the cells.
pub(crate) fn walk(rects: &[Rect], at: usize, direction: StepDirection) -> usize {
    let Some(here) = rects.get(at).map(Rect::center) else {
        return 0;
    };
    let away = |rect: &Rect| {
        let to = rect.center() - here;
        let (ahead, aside) = match direction {
            StepDirection::Left => (-to.x, to.y.abs()),
            StepDirection::Right => (to.x, to.y.abs()),
            StepDirection::Up => (-to.y, to.x.abs()),
            StepDirection::Down => (to.y, to.x.abs()),
        };
        let most = match direction {
            StepDirection::Left | StepDirection::Right => 0.9,
            StepDirection::Up | StepDirection::Down => 1.5,
        };
        (ahead > 1.0 && aside <= ahead * most).then_some(ahead + 2.0 * aside)
    };
    let nearest = rects
        .iter()
        .enumerate()
        .filter_map(|(index, rect)| Some((away(rect)?, index)))
        .min_by(|a, b| a.0.total_cmp(&b.0));
    match (nearest, direction) {
        (Some((_, index)), _) => index,
        (None, StepDirection::Right) => (at + 1).min(rects.len() - 1),
        (None, StepDirection::Left) => at.saturating_sub(1),
        _ => at,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_sign::inventory::builtin;
    use eframe::egui::pos2;

    fn ids(inventory: &str, filter: &str) -> Vec<&'static str> {
        let inventory = builtin_by_id(inventory).expect("one of the house");
        fitting(inventory, filter)
            .into_iter()
            .map(|at| inventory.values[at].id.as_str())
            .collect()
    }

    #[test]
    fn values_that_are_english_words_have_french_names() {
        for (id, english, french, want) in [
            (
                "hand-back",
                "back of the hand",
                "dos de la main",
                "dos de la main",
            ),
            ("neutral", "neutral space", "espace neutre", "espace neutre"),
            ("up", "palm up", "paume vers le haut", "paume vers le haut"),
            ("U", "U", "U", "U"),
            ("5_folded", "folded 5", "5 plié", "5_folded"),
        ] {
            let names = [("en", english), ("fr", french)];
            let value = InventoryValue {
                id: id.into(),
                names: names.map(|(a, b)| (a.to_owned(), b.to_owned())).into(),
                ..InventoryValue::default()
            };
            assert_eq!(short_name(&value, Language::French), want);
            assert_eq!(short_name(&value, Language::English), id);
        }
    }

    #[test]
    fn exact_names_come_first_then_prefixes_then_values_with_every_word() {
        assert_eq!(ids("configurations", "u")[0], "U");
        assert_eq!(ids("configurations", "")[0], "A");
        assert!(ids("configurations", "index middle bent").contains(&"U-bent"));
        assert_eq!(ids("placements", "menton")[0], "chin");
        assert!(ids("placements", "no such place").is_empty());
    }

    #[test]
    fn every_built_in_inventory_has_its_own_picker() {
        let kinds: Vec<(String, PickerForm)> = builtin()
            .iter()
            .map(|it| (it.id.clone(), kind(it)))
            .filter(|(_, kind)| *kind != PickerForm::Names)
            .collect();
        let kinds: Vec<(&str, PickerForm)> = kinds
            .iter()
            .map(|(id, kind)| (id.as_str(), *kind))
            .collect();
        assert_eq!(
            kinds,
            [
                ("configurations", PickerForm::Hands),
                ("lsf-alphabet", PickerForm::Hands),
                ("placements", PickerForm::Body),
                ("movements", PickerForm::Glyphs),
                ("directions", PickerForm::Rose),
                ("palm", PickerForm::Rose),
                ("fingers", PickerForm::Rose),
                ("brows", PickerForm::Faces),
                ("lids", PickerForm::Faces),
                ("gaze", PickerForm::Faces),
                ("nose", PickerForm::Faces),
                ("mouth", PickerForm::Faces),
            ]
        );
        let configurations = builtin_by_id("configurations").expect("of the house");
        assert!(configurations.values.iter().all(|it| hand(it).is_some()));
        assert!(has_numbers(configurations));
        assert!(!has_numbers(
            builtin_by_id("placements").expect("of the house")
        ));
    }

    #[test]
    fn labels_contain_id_and_name() {
        let label = |inventory, id| {
            let inventory = builtin_by_id(inventory).expect("of the house");
            label(inventory.get(id).expect("a value"), Language::English)
        };
        assert_eq!(label("placements", "chin"), "chin");
        assert_eq!(
            label("configurations", "U"),
            "U, index and middle finger together"
        );
    }

    #[test]
    fn arrow_keys_go_to_the_neighbour_in_that_direction_and_stay_inside() {
        // A table of three columns with five cells.
        let cell = |n: usize| {
            let at = pos2((n % 3) as f32 * 10.0, (n / 3) as f32 * 10.0);
            Rect::from_min_size(at, vec2(9.0, 9.0))
        };
        let rects: Vec<Rect> = (0..5).map(cell).collect();
        assert_eq!(walk(&rects, 0, StepDirection::Right), 1);
        assert_eq!(walk(&rects, 2, StepDirection::Right), 3);
        assert_eq!(walk(&rects, 3, StepDirection::Left), 2);
        assert_eq!(walk(&rects, 1, StepDirection::Down), 4);
        assert_eq!(walk(&rects, 4, StepDirection::Up), 1);
        assert_eq!(walk(&rects, 4, StepDirection::Down), 4);
        assert_eq!(walk(&rects, 4, StepDirection::Right), 4);
        assert_eq!(walk(&rects, 0, StepDirection::Left), 0);
        assert_eq!(walk(&[], 3, StepDirection::Left), 0);
    }
}
