//! The choices of the first page: handshapes, places and movements that signs of the dictionary have.

use std::collections::BTreeMap;

use chereme_figure::{HandshapeOptions, Image, Theme, handshape_picture};
use chereme_motion::HandAngles;
use chereme_sign::{Component, Inventory, InventoryValue};
use serde_json::{Value, json};

use super::entries::Entry;
use super::names::names;
use crate::db::columns::ValueState;
use crate::db::signs::TokenValueRow;
use crate::error::{Error, Result};
use crate::inventories::StoredInventory;
use crate::picture::values::{Panel, Scene};

/// The size of the picture of a hand in pixels; it is shown at 64.
pub(super) const HAND: usize = 96;
/// The height of a picture of places, in pixels.
const PANEL: usize = 340;

/// The components that can be chosen, each with its letter in the page's address.
pub(super) const CHOSEN: [(&str, Component); 3] = [
    ("h", Component::Configuration),
    ("p", Component::Placement),
    ("m", Component::Movement),
];

/// A value with its inventory; nothing if no inventory has it.
type Known<'i> = Option<(&'i Inventory, &'i InventoryValue)>;
/// The place of a value among the inventories and in its own one, and its id.
type Place = (usize, usize, String);
/// A picture of the body, and a position on it in percent of width and height.
type Spot = (&'static str, [f64; 2]);

/// The values of a component in the dictionary.
pub(super) struct Facet<'i> {
    pub(super) values: Vec<FacetValue<'i>>,
    /// For each entry its values, as indices.
    pub(super) of: Vec<Vec<usize>>,
}

/// A value that can be chosen.
pub(super) struct FacetValue<'i> {
    pub(super) id: String,
    pub(super) known: Known<'i>,
    /// The next wider value.
    pub(super) wider: Option<usize>,
    /// The name of its picture.
    pub(super) picture: Option<String>,
}

/// Reports whether a value names the kind of a component, and no part of it. Tables of the Signbank write the kind of a
/// movement as its shape.
fn is_kind(row: &TokenValueRow) -> bool {
    let shape = row.component == Component::Movement && row.feature.as_deref() == Some("shape");
    row.feature.is_none() || shape
}

/// Finds a value in the inventories of the corpus.
pub(super) fn known<'i>(inventories: &'i [StoredInventory], row: &TokenValueRow) -> Known<'i> {
    let id = row.value.as_deref()?;
    let named = inventories
        .iter()
        .find(|it| Some(it.id) == row.inventory_id);
    let fitting = inventories.iter().filter(|it| {
        it.inventory.component == row.component && it.inventory.feature == row.feature
    });
    let mut all = named.into_iter().chain(fitting);
    all.find_map(|it| Some((&it.inventory, it.inventory.get(id)?)))
}

/// Returns the values of a component that entries have, in the order of their inventories, with wider ones.
pub(super) fn facet<'i>(
    component: Component,
    entries: &[Entry],
    inventories: &'i [StoredInventory],
) -> Facet<'i> {
    let mut found: BTreeMap<Place, Known<'i>> = BTreeMap::new();
    let place = |known: Known<'_>, id: &str| {
        let at = known.and_then(|(inventory, value)| {
            let which = inventories
                .iter()
                .position(|it| it.inventory.id == inventory.id)?;
            let values = &inventory.values;
            Some((which, values.iter().position(|it| it.id == value.id)?))
        });
        let (which, at) = at.unwrap_or((usize::MAX, 0));
        (which, at, id.to_owned())
    };
    let own = |entry: &Entry| -> Vec<Place> {
        let rows = entry.values.iter().filter(|it| it.component == component);
        let rows = rows.filter(|it| is_kind(it) && it.state == ValueState::Value);
        rows.filter_map(|row| {
            let known = known(inventories, row);
            Some(place(known, row.value.as_deref()?))
        })
        .collect()
    };
    for entry in entries {
        for row in &entry.values {
            let fits = row.component == component && is_kind(row);
            let Some(id) = row
                .value
                .as_deref()
                .filter(|_| fits && row.state == ValueState::Value)
            else {
                continue;
            };
            let known = known(inventories, row);
            found.insert(place(known, id), known);
            if let Some((inventory, value)) = known {
                for wider in inventory.chain(&value.id).skip(1) {
                    let wider = Some((inventory, wider));
                    found.insert(place(wider, wider.map_or("", |it| &it.1.id)), wider);
                }
            }
        }
    }
    let places: BTreeMap<&Place, usize> = found
        .keys()
        .enumerate()
        .map(|(at, key)| (key, at))
        .collect();
    let index = |key: &Place| places.get(key).copied();
    let pictured = names(found.keys().map(|key| key.2.as_str()));
    let values = found.iter().map(|(key, known)| FacetValue {
        id: key.2.clone(),
        known: *known,
        wider: known.and_then(|(inventory, value)| {
            let wider = inventory.chain(&value.id).nth(1)?;
            index(&place(Some((inventory, wider)), &wider.id))
        }),
        picture: pictured.get(key.2.as_str()).cloned(),
    });
    let of = entries.iter().map(|entry| {
        let mut all: Vec<usize> = own(entry).iter().filter_map(index).collect();
        all.sort_unstable();
        all.dedup();
        all
    });
    Facet {
        values: values.collect(),
        of: of.collect(),
    }
}

/// Returns the posture of a handshape.
pub(super) fn posture(
    value: &InventoryValue,
    inventories: &[StoredInventory],
) -> Option<HandAngles> {
    let mut all = inventories.iter().map(|it| &it.inventory);
    let mut all = all
        .by_ref()
        .filter(|it| it.component == Component::Configuration);
    all.find_map(|it| value.hand_pose(it))
}

/// Draws a handshape in a square of so many pixels.
pub(super) fn hand(angles: &HandAngles, size: usize) -> Result<Image> {
    let options = HandshapeOptions::small(size);
    handshape_picture(angles, &options).map_err(|error| Error::wrong(error.to_string()))
}

/// Returns the group of a handshape by its selected fingers.
pub(super) fn group(value: &InventoryValue) -> &'static str {
    let has = |feature: &str| value.features.contains(feature);
    let fingers = ["index", "middle", "ring", "little"].map(has);
    let count = fingers.iter().filter(|it| **it).count();
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
pub(super) struct Likeness<'i> {
    pub(super) value: &'i InventoryValue,
    pub(super) angles: HandAngles,
    /// Whether it has that name, and not a shorter one.
    pub(super) is_namesake: bool,
}

/// Returns the handshape that has the name of one without a posture, or after which that one is named: `C-small` for
/// `baby-C`, which is another name of it; `1` for `1-curved`, `5` for `5mx`, `beak` for `beak2` and `beak, pinkie
/// extended`, `T` for `T + L`. A name promises no more than a likeness.
pub(super) fn likeness<'i>(id: &str, inventories: &'i [StoredInventory]) -> Option<Likeness<'i>> {
    let mut name = id.split(['+', '>', ',', ' ']).next().unwrap_or_default();
    loop {
        let shapes = inventories.iter().map(|it| &it.inventory);
        let shapes = shapes.filter(|it| it.component == Component::Configuration);
        let mut found = shapes.filter_map(|it| {
            let value = it.find(name)?;
            Some((value, value.hand_pose(it)?))
        });
        if let Some((value, angles)) = found.next() {
            return Some(Likeness {
                value,
                angles,
                is_namesake: name == id,
            });
        }
        let stem = name.trim_end_matches(|it: char| it.is_ascii_digit());
        let sign = name.trim_end_matches(|it: char| it.is_ascii_lowercase());
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
    pub(super) image: Image,
}

/// Returns the pictures of the body that show places of the dictionary, and for each value its picture and its position
/// there, in percent of width and height.
pub(super) fn panels(facet: &Facet<'_>) -> Result<(Vec<DrawnPanel>, Vec<Option<Spot>>)> {
    let scene = Scene::new()?;
    let mut drawn: Vec<DrawnPanel> = Vec::new();
    let mut spots = Vec::new();
    for value in &facet.values {
        let spot = value.known.and_then(|(_, value)| {
            let landmark = value.landmark.as_ref()?;
            let panel = Panel::of(landmark);
            let size = [(PANEL as f32 * panel.aspect()) as usize, PANEL];
            let camera = scene.camera(panel, false)?;
            let seen = camera
                .projection(size[0], size[1])
                .project(scene.at(landmark)?);
            let shares = [seen.x / size[0] as f32, seen.y / size[1] as f32];
            let inside = shares.iter().all(|it| (0.02..0.98).contains(it));
            let name = panel_name(panel);
            if inside && !drawn.iter().any(|it| it.name == name) {
                let image = scene.draw(panel, false, size, Theme::Light)?;
                drawn.push(DrawnPanel { name, image });
            }
            let percent = shares.map(|it| (f64::from(it) * 1000.0).round() / 10.0);
            inside.then_some((name, percent))
        });
        spots.push(spot);
    }
    drawn.sort_by_key(|it| it.name);
    Ok((drawn, spots))
}

fn panel_name(panel: Panel) -> &'static str {
    match panel {
        Panel::Trunk => "trunk",
        Panel::Head => "head",
        Panel::Hand => "hand",
        Panel::Space => "space",
    }
}

/// Returns a value as the page reads it.
pub(super) fn document(value: &FacetValue<'_>) -> Value {
    let mut it = json!({ "id": value.id });
    if let Some((_, known)) = value.known {
        // The page reads the English name where a language has none.
        it["en"] = json!(known.name("en"));
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
            let value = known.get(id).expect(id);
            assert_eq!(group(value), wanted, "{id}");
        }
    }

    #[test]
    fn a_handshape_without_a_posture_stands_with_the_one_it_is_named_after() {
        let own = inventory::builtin().iter().enumerate();
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
            let found = likeness(id, &all);
            let same = found.as_ref().is_some_and(|it| it.is_namesake);
            assert_eq!(same, ["B", "baby-C"].contains(&id), "{id}");
            assert_eq!(found.map(|it| it.value.id.as_str()), wanted, "{id}");
        }
    }
}
