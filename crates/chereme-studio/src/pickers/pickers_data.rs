//! Rules for the contents of a picker: which values it shows, in which order, and in which form.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use chereme_corpus::value_pictures::facial_expression_of_value;
use chereme_motion::HandAngles;
use chereme_sign::inventory::{InventoryValue, builtin_by_id};
use chereme_sign::text::fold_text;
use chereme_sign::{ComponentInventory, SignComponent};
use eframe::egui::{Rect, Vec2, vec2};

use crate::words::InterfaceLanguage;

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
pub(crate) fn inventory_picker_form(inventory: &ComponentInventory) -> PickerForm {
    let any = |test: fn(&InventoryValue) -> bool| inventory.values.iter().any(test);
    let directed = |value: &InventoryValue| value.direction.is_some() || value.roll.is_some();
    match inventory.component {
        SignComponent::Configuration if inventory.values.iter().any(|value| value_hand_angles(value).is_some()) => {
            PickerForm::Hands
        }
        SignComponent::Placement if any(|value| value.landmark.is_some()) => PickerForm::Body,
        SignComponent::Movement | SignComponent::Orientation if any(directed) => PickerForm::Rose,
        SignComponent::Movement if inventory.feature.is_none() => PickerForm::Glyphs,
        SignComponent::NonManual if any_face(inventory) => PickerForm::Faces,
        _ => PickerForm::Names,
    }
}

fn any_face(inventory: &ComponentInventory) -> bool {
    let mut values = inventory.values.iter();
    values.any(|value| facial_expression_of_value(inventory, value).is_some())
}

/// Returns the hand posture of a value: its own, or that of the built-in handshape that it names or shares its name
/// with.
pub(crate) fn value_hand_angles(value: &InventoryValue) -> Option<HandAngles> {
    static BUILT_IN_HAND_ANGLES: LazyLock<BTreeMap<String, HandAngles>> = LazyLock::new(|| {
        let values = builtin_by_id("configurations").map(|inventory| inventory.values.iter());
        let named = |value: &'static InventoryValue| {
            let pose = value.pose?;
            Some(value.value_spellings().map(move |text| (fold_text(text), pose)))
        };
        let mut all = BTreeMap::new();
        for (name, pose) in values.into_iter().flatten().filter_map(named).flatten() {
            all.entry(name).or_insert(pose);
        }
        all
    });
    let name = value.configuration.as_deref().unwrap_or(&value.id);
    value
        .pose
        .or_else(|| BUILT_IN_HAND_ANGLES.get(&fold_text(name)).copied())
}

/// Returns the label of a value: its id, and its name if that differs.
pub(crate) fn inventory_value_label(value: &InventoryValue, language: InterfaceLanguage) -> String {
    let name = value.value_name_in(language.language_code());
    if fold_text(name) == fold_text(&value.id) {
        name.to_owned()
    } else {
        format!("{}, {name}", value.id)
    }
}

/// Returns a short text for a value: its id. In languages other than English, returns its name instead if the id is an
/// English word, such as `hand-back`, and not a letter or a sign.
pub(crate) fn short_name(value: &InventoryValue, language: InterfaceLanguage) -> &str {
    let english = fold_text(value.value_name_in(InterfaceLanguage::English.language_code()));
    let mut words = value.id.split(['-', '_', ' ']);
    let is_word = words.all(|word| word.len() > 1 && english.contains(&fold_text(word)));
    if language != InterfaceLanguage::English && is_word {
        value.value_name_in(language.language_code())
    } else {
        &value.id
    }
}

/// Returns the indices of the values that match `filter`; those whose name begins with it come first.
pub(crate) fn filtered_value_indices(inventory: &ComponentInventory, filter: &str) -> Vec<usize> {
    let wanted = fold_text(filter.trim());
    let rank = |value: &InventoryValue| {
        let spellings: Vec<String> = value.value_spellings().map(fold_text).collect();
        if spellings.contains(&wanted) {
            return Some(0);
        }
        if spellings.iter().any(|spelling| spelling.starts_with(&wanted)) {
            return Some(1);
        }
        let holds = |word: &str| {
            spellings.iter().any(|spelling| spelling.contains(word))
                || value
                    .features
                    .iter()
                    .any(|feature| fold_text(feature).starts_with(word))
        };
        wanted.split_whitespace().all(holds).then_some(2)
    };
    let mut ranked_values: Vec<(u8, usize)> = inventory
        .values
        .iter()
        .enumerate()
        .filter_map(|(at, value)| Some((rank(value)?, at)))
        .collect();
    if !wanted.is_empty() {
        ranked_values.sort_by_key(|(rank, _)| *rank);
    }
    ranked_values.into_iter().map(|(_, at)| at).collect()
}

/// Returns whether a name in the inventory begins with a digit, so that digits must be usable as text.
pub(crate) fn has_numbers(inventory: &ComponentInventory) -> bool {
    let digit = |text: &str| text.starts_with(|c: char| c.is_ascii_digit());
    inventory.values.iter().any(|value| value.value_spellings().any(digit))
}

/// Returns the least size of a cell, in points.
pub(crate) fn picker_cell_size(kind: PickerForm) -> Vec2 {
    match kind {
        PickerForm::Hands | PickerForm::Faces => vec2(84.0, 98.0),
        PickerForm::Glyphs => vec2(84.0, 72.0),
        _ => vec2(150.0, 30.0),
    }
}

/// Returns the preferred width of a picker, in points.
pub(crate) fn picker_width_points(kind: PickerForm) -> f32 {
    match kind {
        PickerForm::Body => 780.0,
        PickerForm::Hands | PickerForm::Faces => 660.0,
        PickerForm::Rose | PickerForm::Glyphs => 460.0,
        PickerForm::Names => 340.0,
    }
}

/// Returns the preferred height of a picker, in points.
pub(crate) fn picker_height_points(kind: PickerForm) -> f32 {
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
pub(crate) fn walk_picker_cells(rects: &[Rect], at: usize, direction: StepDirection) -> usize {
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
    use chereme_sign::inventory::builtin_inventories;
    use eframe::egui::pos2;

    fn ids(inventory: &str, filter: &str) -> Vec<&'static str> {
        let inventory = builtin_by_id(inventory).expect("one of the house");
        filtered_value_indices(inventory, filter)
            .into_iter()
            .map(|at| inventory.values[at].id.as_str())
            .collect()
    }

    #[test]
    fn values_that_are_english_words_have_french_names() {
        for (id, english, french, want) in [
            ("hand-back", "back of the hand", "dos de la main", "dos de la main"),
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
            assert_eq!(short_name(&value, InterfaceLanguage::French), want);
            assert_eq!(short_name(&value, InterfaceLanguage::English), id);
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
        let kinds: Vec<(String, PickerForm)> = builtin_inventories()
            .iter()
            .map(|it| (it.id.clone(), inventory_picker_form(it)))
            .filter(|(_, kind)| *kind != PickerForm::Names)
            .collect();
        let kinds: Vec<(&str, PickerForm)> = kinds.iter().map(|(id, kind)| (id.as_str(), *kind)).collect();
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
        assert!(configurations.values.iter().all(|it| value_hand_angles(it).is_some()));
        assert!(has_numbers(configurations));
        assert!(!has_numbers(builtin_by_id("placements").expect("of the house")));
    }

    #[test]
    fn labels_contain_id_and_name() {
        let label = |inventory, id| {
            let inventory = builtin_by_id(inventory).expect("of the house");
            inventory_value_label(inventory.value_by_id(id).expect("a value"), InterfaceLanguage::English)
        };
        assert_eq!(label("placements", "chin"), "chin");
        assert_eq!(label("configurations", "U"), "U, index and middle finger together");
    }

    #[test]
    fn arrow_keys_go_to_the_neighbour_in_that_direction_and_stay_inside() {
        // A table of three columns with five cells.
        let cell = |n: usize| {
            let at = pos2((n % 3) as f32 * 10.0, (n / 3) as f32 * 10.0);
            Rect::from_min_size(at, vec2(9.0, 9.0))
        };
        let rects: Vec<Rect> = (0..5).map(cell).collect();
        assert_eq!(walk_picker_cells(&rects, 0, StepDirection::Right), 1);
        assert_eq!(walk_picker_cells(&rects, 2, StepDirection::Right), 3);
        assert_eq!(walk_picker_cells(&rects, 3, StepDirection::Left), 2);
        assert_eq!(walk_picker_cells(&rects, 1, StepDirection::Down), 4);
        assert_eq!(walk_picker_cells(&rects, 4, StepDirection::Up), 1);
        assert_eq!(walk_picker_cells(&rects, 4, StepDirection::Down), 4);
        assert_eq!(walk_picker_cells(&rects, 4, StepDirection::Right), 4);
        assert_eq!(walk_picker_cells(&rects, 0, StepDirection::Left), 0);
        assert_eq!(walk_picker_cells(&[], 3, StepDirection::Left), 0);
    }
}
