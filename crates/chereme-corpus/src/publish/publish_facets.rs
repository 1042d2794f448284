//! The choices of the first page: handshapes, places and movements that signs of the dictionary have.

use std::collections::BTreeMap;

use chereme_figure::{HandshapeOptions, PaperTheme, RasterImage, handshape_picture};
use chereme_motion::HandAngles;
use chereme_sign::{ComponentInventory, InventoryValue, SignComponent};
use serde_json::{Value, json};

use super::entries::DictionaryEntry;
use super::publish_names::unique_file_names;
use crate::db::signs::TokenValueRow;
use crate::db::stored_columns::ValueState;
use crate::error::{CorpusError, CorpusResult};
use crate::inventories::{EqualValues, StoredInventory};
use crate::picture::picture_values::{PlacePanel, RestingBodyScene};

/// The size of the picture of a hand in pixels; it is shown at 64.
pub(super) const HAND_PICTURE_SIZE_PX: usize = 96;
/// The height of a picture of places, in pixels.
const PLACE_PANEL_HEIGHT_PX: usize = 340;

/// The components that can be chosen, each with its letter in the page's address.
pub(super) const CHOOSABLE_COMPONENTS: [(&str, SignComponent); 3] = [
    ("h", SignComponent::Configuration),
    ("p", SignComponent::Placement),
    ("m", SignComponent::Movement),
];

/// A value with its inventory; nothing if no inventory has it.
type KnownInventoryValue<'i> = Option<(&'i ComponentInventory, &'i InventoryValue)>;
/// The place of a value among the inventories and in its own one, and its id.
type InventoryPlace = (usize, usize, String);
/// A picture of the body, and a position on it in percent of width and height.
type PanelSpot = (&'static str, [f64; 2]);

/// The values of a component in the dictionary.
pub(super) struct ComponentFacet<'i> {
    pub(super) values: Vec<FacetValue<'i>>,
    /// For each entry its values, as indices.
    pub(super) of: Vec<Vec<usize>>,
}

/// A value that can be chosen.
pub(super) struct FacetValue<'i> {
    pub(super) id: String,
    pub(super) known: KnownInventoryValue<'i>,
    /// The next wider value.
    pub(super) wider: Option<usize>,
    /// The name of its picture.
    pub(super) picture: Option<String>,
}

/// Reports whether a value names the kind of a component, and no part of it. Tables of the Signbank write the kind of a
/// movement as its shape.
fn is_kind(row: &TokenValueRow) -> bool {
    let shape = row.component == SignComponent::Movement && row.feature.as_deref() == Some("shape");
    row.feature.is_none() || shape
}

/// Finds a value in the inventories of the corpus.
pub(super) fn find_known_value<'i>(inventories: &'i [StoredInventory], row: &TokenValueRow) -> KnownInventoryValue<'i> {
    let id = row.value.as_deref()?;
    // The inventory that the value was coded with knows best what its id means.
    let named = inventories.iter().find(|stored| Some(stored.id) == row.inventory_id);
    let fitting = inventories
        .iter()
        .filter(|stored| stored.inventory.component == row.component && stored.inventory.feature == row.feature);
    let mut all = named.into_iter().chain(fitting);
    all.find_map(|stored| Some((&stored.inventory, stored.inventory.value_by_id(id)?)))
}

/// Returns the values of a component that entries have, in the order of their inventories, with wider ones. Values that are
/// one are shown once.
pub(super) fn component_facet<'i>(
    component: SignComponent,
    entries: &[DictionaryEntry],
    inventories: &'i [StoredInventory],
    equal: &EqualValues,
) -> ComponentFacet<'i> {
    let mut value_by_place: BTreeMap<InventoryPlace, KnownInventoryValue<'i>> = BTreeMap::new();
    let place = |known: KnownInventoryValue<'_>, id: &str| {
        let value_place = known.and_then(|(inventory, value)| {
            let which = inventories
                .iter()
                .position(|stored| stored.inventory.id == inventory.id)?;
            let values = &inventory.values;
            Some((which, values.iter().position(|candidate| candidate.id == value.id)?))
        });
        // Values that no inventory knows come after all others.
        let (which, at) = value_place.unwrap_or((usize::MAX, 0));
        (which, at, id.to_owned())
    };
    let shown = |row: &TokenValueRow| {
        let known_value = find_known_value(inventories, row).map(|pair| equal.standing_value(inventories, pair));
        let id = known_value.map_or(row.value.as_deref()?, |(_, value)| &value.id);
        Some((place(known_value, id), known_value))
    };
    let places_of = |entry: &DictionaryEntry| -> Vec<InventoryPlace> {
        let component_rows = entry.values.iter().filter(|row| row.component == component);
        let rows = component_rows.filter(|row| is_kind(row) && row.state == ValueState::Value);
        rows.filter_map(|row| Some(shown(row)?.0)).collect()
    };
    for entry in entries {
        for row in &entry.values {
            let fits = row.component == component && is_kind(row);
            let Some((value_place, known_value)) = shown(row).filter(|_| fits && row.state == ValueState::Value) else {
                continue;
            };
            value_by_place.insert(value_place, known_value);
            if let Some((inventory, value)) = known_value {
                // A wider value can be chosen although no sign is coded with it.
                for wider in inventory.broader_value_chain(&value.id).skip(1) {
                    let wider = Some((inventory, wider));
                    value_by_place.insert(place(wider, wider.map_or("", |pair| &pair.1.id)), wider);
                }
            }
        }
    }
    let places: BTreeMap<&InventoryPlace, usize> =
        value_by_place.keys().enumerate().map(|(at, key)| (key, at)).collect();
    let index = |key: &InventoryPlace| places.get(key).copied();
    let pictured = unique_file_names(value_by_place.keys().map(|key| key.2.as_str()));
    let values = value_by_place.iter().map(|(key, known)| FacetValue {
        id: key.2.clone(),
        known: *known,
        wider: known.and_then(|(inventory, value)| {
            let wider = inventory.broader_value_chain(&value.id).nth(1)?;
            index(&place(Some((inventory, wider)), &wider.id))
        }),
        picture: pictured.get(key.2.as_str()).cloned(),
    });
    let of = entries.iter().map(|entry| {
        let mut all: Vec<usize> = places_of(entry).iter().filter_map(index).collect();
        all.sort_unstable();
        // Both hands may have the same value.
        all.dedup();
        all
    });
    ComponentFacet {
        values: values.collect(),
        of: of.collect(),
    }
}

/// Returns the posture of a handshape.
pub(super) fn handshape_posture(value: &InventoryValue, inventories: &[StoredInventory]) -> Option<HandAngles> {
    let mut inventory_list = inventories.iter().map(|stored| &stored.inventory);
    let mut all = inventory_list
        .by_ref()
        .filter(|inventory| inventory.component == SignComponent::Configuration);
    all.find_map(|inventory| value.hand_pose(inventory))
}

/// Draws a handshape in a square of so many pixels.
pub(super) fn draw_handshape(angles: &HandAngles, size: usize) -> CorpusResult<RasterImage> {
    let options = HandshapeOptions::with_small_size(size);
    handshape_picture(angles, &options).map_err(|error| CorpusError::from_wrong_message(error.to_string()))
}

/// Returns the group of a handshape by its selected fingers.
pub(super) fn handshape_group(value: &InventoryValue) -> &'static str {
    let has = |feature: &str| value.features.contains(feature);
    let fingers = ["index", "middle", "ring", "little"].map(has);
    let count = fingers.iter().filter(|finger| **finger).count();
    match count {
        _ if has("fist") && has("thumb") => "thumb",
        _ if has("fist") || has("closed") => "fist",
        _ if has("thumb-opposed") && count > 0 => "ring",
        0 if has("thumb") => "thumb",
        1 if fingers[0] => "index",
        1 if fingers[3] => "little",
        1 => "other",
        2 => "two",
        3 => "three",
        4 if has("thumb") => "five",
        4 => "four",
        _ => "other",
    }
}

/// A handshape of the program for one without a posture.
pub(super) struct HandshapeLikeness<'i> {
    pub(super) value: &'i InventoryValue,
    pub(super) angles: HandAngles,
    /// Whether it has that name, and not a shorter one.
    pub(super) is_namesake: bool,
}

/// Returns the handshape that has the name of one without a posture, or after which that one is named: `C-small` for
/// `baby-C`, which is another name of it; `1` for `1-curved`, `5` for `5mx`, `beak` for `beak2` and `beak, pinkie
/// extended`, `T` for `T + L`. A name promises no more than a likeness.
pub(super) fn find_handshape_likeness<'i>(
    id: &str,
    inventories: &'i [StoredInventory],
) -> Option<HandshapeLikeness<'i>> {
    let mut name = id.split(['+', '>', ',', ' ']).next().unwrap_or_default();
    loop {
        let all_inventories = inventories.iter().map(|stored| &stored.inventory);
        let shapes = all_inventories.filter(|inventory| inventory.component == SignComponent::Configuration);
        let mut poses = shapes.filter_map(|inventory| {
            let value = inventory.find_inventory_value(name)?;
            Some((value, value.hand_pose(inventory)?))
        });
        if let Some((value, angles)) = poses.next() {
            return Some(HandshapeLikeness {
                value,
                angles,
                is_namesake: name == id,
            });
        }
        let stem = name.trim_end_matches(|letter: char| letter.is_ascii_digit());
        let sign = name.trim_end_matches(|letter: char| letter.is_ascii_lowercase());
        name = match name.rsplit_once('-') {
            Some((before, _)) => before,
            // A letter or a digit, and what varies it.
            None if sign.len() == 1 && sign != name => sign,
            None if stem != name => stem,
            None => return None,
        };
    }
}

/// A picture of the body with places on it.
pub(super) struct DrawnPanel {
    pub(super) name: &'static str,
    pub(super) image: RasterImage,
}

/// Returns the pictures of the body that show places of the dictionary, and for each value its picture and its position
/// there, in percent of width and height.
pub(super) fn draw_place_panels(facet: &ComponentFacet<'_>) -> CorpusResult<(Vec<DrawnPanel>, Vec<Option<PanelSpot>>)> {
    let scene = RestingBodyScene::new()?;
    let mut drawn: Vec<DrawnPanel> = Vec::new();
    let mut spots = Vec::new();
    for value in &facet.values {
        let spot = value.known.and_then(|(_, value)| {
            let landmark = value.landmark.as_ref()?;
            let panel = PlacePanel::panel_of_landmark(landmark);
            let size = [
                (PLACE_PANEL_HEIGHT_PX as f32 * panel.panel_aspect_ratio()) as usize,
                PLACE_PANEL_HEIGHT_PX,
            ];
            let camera = scene.panel_camera(panel, false)?;
            let seen = camera
                .camera_projection(size[0], size[1])
                .project_point(scene.landmark_position(landmark)?);
            let shares = [seen.x / size[0] as f32, seen.y / size[1] as f32];
            // A mark at the very edge of the picture would be cut off.
            let inside = shares.iter().all(|share| (0.02..0.98).contains(share));
            let name = panel_name(panel);
            if inside && !drawn.iter().any(|drawn_panel| drawn_panel.name == name) {
                let image = scene.draw_body_panel(panel, false, size, PaperTheme::Light)?;
                drawn.push(DrawnPanel { name, image });
            }
            let percent = shares.map(|share| (f64::from(share) * 1000.0).round() / 10.0);
            inside.then_some((name, percent))
        });
        spots.push(spot);
    }
    // The order must not depend on which sign comes first.
    drawn.sort_by_key(|drawn_panel| drawn_panel.name);
    Ok((drawn, spots))
}

fn panel_name(panel: PlacePanel) -> &'static str {
    match panel {
        PlacePanel::Trunk => "trunk",
        PlacePanel::Head => "head",
        PlacePanel::Hand => "hand",
        PlacePanel::Space => "space",
    }
}

/// Returns a value as the page reads it.
pub(super) fn facet_value_document(value: &FacetValue<'_>) -> Value {
    let mut it = json!({ "id": value.id });
    if let Some((_, known)) = value.known {
        // The page reads the English name where a language has none.
        it["en"] = json!(known.value_name_in("en"));
        for (language, name) in known.names.iter().filter(|(language, _)| *language != "en") {
            it[language] = json!(name);
        }
    }
    if let Some(wider) = value.wider {
        it["up"] = json!(wider);
    }
    it
}

#[cfg(test)]
mod tests {
    use chereme_sign::inventory;

    use super::*;

    #[test]
    fn handshapes_are_grouped_by_their_fingers() {
        let known = inventory::builtin_by_id("configurations").expect("built in");
        for (id, wanted) in [
            ("A", "fist"),
            ("thumb", "thumb"),
            ("G", "index"),
            ("I", "little"),
            ("U", "two"),
            ("M", "three"),
            ("flat", "four"),
            ("5", "five"),
            ("C", "ring"),
        ] {
            let value = known.value_by_id(id).expect(id);
            assert_eq!(handshape_group(value), wanted, "{id}");
        }
    }

    #[test]
    fn a_handshape_without_a_posture_stands_with_the_one_it_is_named_after() {
        let own = inventory::builtin_inventories().iter().enumerate();
        let all: Vec<StoredInventory> = own
            .map(|(at, it)| StoredInventory {
                id: at as i64,
                inventory: it.clone(),
            })
            .collect();
        for (id, wanted) in [
            ("B", Some("B")),
            ("baby-C", Some("C-small")),
            ("1-curved", Some("1")),
            ("C-spread-2", Some("C-spread")),
            ("beak2-spread", Some("beak")),
            ("beak, pinkie extended", Some("beak")),
            ("5mx", Some("5")),
            ("5rx > open-5r", Some("5")),
            ("O2", Some("O")),
            ("T + L", Some("T")),
            ("Y mrp-bent", Some("Y")),
            ("baby-C-wide", Some("C-small")),
            ("money", None),
            ("counting hand", None),
            ("ASL-T", None),
            ("N", None),
            ("", None),
            ("-", None),
            ("ß-1", None),
        ] {
            let found = find_handshape_likeness(id, &all);
            let same = found.as_ref().is_some_and(|it| it.is_namesake);
            assert_eq!(same, ["B", "baby-C"].contains(&id), "{id}");
            assert_eq!(found.map(|it| it.value.id.as_str()), wanted, "{id}");
        }
    }
}
