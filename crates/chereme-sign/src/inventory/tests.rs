//! Reading, finding, and the inventories that come with the program.

use super::*;
use chereme_motion::HandFinger;

const SMALL: &str = r#"{
  "id": "small", "component": "handshape", "version": 1, "names": {"en": "small"},
  "values": [
    {"id": "V", "names": {"en": "victory", "fr": "écartés"}, "aliases": ["2"], "features": ["index", "middle", "spread"]},
    {"id": "head"},
    {"id": "chin", "broader": "head", "landmark": "ipsi-chin", "offset": [0.5, 0, 1], "roll": 90},
    {"id": "lip", "broader": "chin"}
  ]
}"#;

fn small() -> ComponentInventory {
    ComponentInventory::from_json(SMALL).expect("a good inventory")
}

#[test]
fn values_are_found_by_any_spelling() {
    let inventory = small();
    for (text, id) in [
        ("V", Some("V")),
        ("v", Some("V")),
        ("2", Some("V")),
        ("ECARTES", Some("V")),
        (" Victory ", Some("V")),
        ("chin", Some("chin")),
        ("chinn", None),
        ("", None),
    ] {
        assert_eq!(
            inventory.find_inventory_value(text).map(|value| value.id.as_str()),
            id,
            "{text:?}"
        );
    }
    assert_eq!(inventory.suggest_value_ids("chinn"), ["chin"]);
    assert_eq!(inventory.suggest_value_ids("victroy"), ["V"]);
    assert!(inventory.suggest_value_ids("elephant").is_empty());
    assert!(inventory.is_within_value("lip", "head"));
    assert!(!inventory.is_within_value("head", "lip"));
    assert_eq!(inventory.inventory_field().to_string(), "configuration");
}

#[test]
fn side_relative_landmarks_follow_the_hand() {
    let inventory = small();
    let landmark = inventory
        .value_by_id("chin")
        .and_then(|chin| chin.landmark.clone())
        .expect("one");
    assert_eq!(
        landmark.resolve_landmark(BodySide::Left),
        ("left-chin".to_owned(), [0.5, 0.0, 1.0])
    );
    assert_eq!(
        landmark.resolve_landmark(BodySide::Right),
        ("right-chin".to_owned(), [-0.5, 0.0, 1.0])
    );
    let contra = BodyLandmark {
        name: "contra-chin".to_owned(),
        ..landmark
    };
    assert_eq!(
        contra.resolve_landmark(BodySide::Right),
        ("left-chin".to_owned(), [0.5, 0.0, 1.0])
    );
    let middle = BodyLandmark {
        name: "head-top".to_owned(),
        offset: [0.1, 0.2, 0.3],
    };
    assert_eq!(
        middle.resolve_landmark(BodySide::Right),
        ("head-top".to_owned(), [0.1, 0.2, 0.3])
    );
}

#[test]
fn faults_name_the_value_and_the_field() {
    let with =
        |values: &str| format!(r#"{{"id":"x","component":"placement","version":1,"names":{{}},"values":[{values}]}}"#);
    for (text, message) in [
        (
            "{".to_owned(),
            "line 1, column 1: EOF while parsing an object at line 1 column 1",
        ),
        (
            "3".to_owned(),
            "the inventory: a number where an object with fields must be",
        ),
        (
            r#"{"id":"x"}"#.to_owned(),
            r#"inventory "x": the field "component" is missing"#,
        ),
        (
            with("").replace("placement", "handshpe"),
            r#"inventory "x", field "component": "handshpe" names no component: configuration, placement, movement, orientation or nonmanual"#,
        ),
        (
            with("").replace("version", "versoin"),
            r#"inventory "x": there is no field "versoin"; did you mean "version"?"#,
        ),
        (
            with("3"),
            r#"inventory "x", value "1": a number where an object with fields must be"#,
        ),
        (
            with(r#"{"names":{}}"#),
            r#"inventory "x", value "1": the field "id" is missing"#,
        ),
        (
            with(r#"{"id":" "}"#),
            r#"inventory "x", value " ", field "id": an id has no blanks around it and is not empty"#,
        ),
        (
            with(r#"{"id":"a","nmaes":{}}"#),
            r#"inventory "x", value "a": there is no field "nmaes"; did you mean "names"?"#,
        ),
        (
            with(r#"{"id":"a","times":-1}"#),
            r#"inventory "x", value "a", field "times": invalid value: integer `-1`, expected u32"#,
        ),
        (
            with(r#"{"id":"a","pose":{"thmb":{}}}"#),
            r#"inventory "x", value "a", field "pose": there is no field "thmb"; did you mean "thumb"?"#,
        ),
        (
            with(r#"{"id":"a","pose":{"thumb":{}}}"#),
            r#"inventory "x", value "a", field "pose": the field "index" is missing"#,
        ),
        (
            with(r#"{"id":"a","pose":{"thumb":{"flexion":[1]}}}"#),
            r#"inventory "x", value "a", field "pose.thumb.flexion": invalid length 1, expected an array of length 2"#,
        ),
        (
            with(r#"{"id":"a","offset":[0,0,0]}"#),
            r#"inventory "x", value "a": the field "landmark" is missing"#,
        ),
        (
            with(r#"{"id":"a"},{"id":"a"}"#),
            r#"inventory "x", value "a", field "id": "a" means "a" already; give each value its own ids, aliases and names"#,
        ),
        (
            with(r#"{"id":"a"},{"id":"b","aliases":["Á"]}"#),
            r#"inventory "x", value "b", field "id": "a" means "a" already; give each value its own ids, aliases and names"#,
        ),
        (
            with(r#"{"id":"chin","broader":"haed"},{"id":"head"}"#),
            r#"inventory "x", value "chin", field "broader": there is no value "haed"; did you mean "head"?"#,
        ),
        (
            with(r#"{"id":"a","broader":"b"},{"id":"b","broader":"a"}"#),
            r#"inventory "x", value "a", field "broader": the value lies within itself; give it a broader one that is not part of it"#,
        ),
        (
            with(r#"{"id":"a","broader":"a"}"#),
            r#"inventory "x", value "a", field "broader": the value lies within itself; give it a broader one that is not part of it"#,
        ),
    ] {
        let error = ComponentInventory::from_json(&text).expect_err(message);
        assert_eq!(error.to_string(), message, "{text}");
    }
}

#[test]
fn nesting_and_truncation_are_errors() {
    assert!(ComponentInventory::from_json(&"[".repeat(100_000)).is_err());
    for end in 0..SMALL.len() {
        assert!(ComponentInventory::from_json(&SMALL[..SMALL.floor_char_boundary(end)]).is_err());
    }
}

#[test]
fn writing_and_reading_gives_the_inventory_back() {
    for inventory in builtin_inventories().iter().chain([&small()]) {
        let again = ComponentInventory::from_json(&inventory.to_json()).expect(&inventory.id);
        assert_eq!(again.to_json(), inventory.to_json());
        for (a, b) in inventory.values.iter().zip(&again.values) {
            let near = |a: &HandAngles, b: &HandAngles| {
                a.to_array().iter().zip(b.to_array()).all(|(a, b)| (a - b).abs() < 1e-9)
            };
            match (&a.pose, &b.pose) {
                (Some(a), Some(b)) => assert!(near(a, b)),
                (a, b) => assert_eq!(a, b),
            }
            let plain = |value: &InventoryValue| InventoryValue {
                pose: None,
                roll: value.roll.map(|roll| (roll * 1e9).round()),
                strokes: Vec::new(),
                ..value.clone()
            };
            assert_eq!(plain(a), plain(b));
            assert_eq!(a.strokes.len(), b.strokes.len());
        }
    }
}

#[test]
fn the_built_in_inventories_are_complete() {
    let mut ids = BTreeSet::new();
    for inventory in builtin_inventories() {
        assert!(ids.insert(&inventory.id), "{}", inventory.id);
        assert!(!inventory.description.is_empty(), "{}", inventory.id);
        assert!(!inventory.values.is_empty(), "{}", inventory.id);
        for language in ["en", "fr"] {
            assert!(inventory.names.contains_key(language), "{}", inventory.id);
            for value in &inventory.values {
                let name = value.names.get(language).map(String::as_str).unwrap_or_default();
                assert!(!name.trim().is_empty(), "{} {} {language}", inventory.id, value.id);
            }
        }
    }
    assert_eq!(builtin_by_id("palm").map(|palm| palm.values.len()), Some(8));
    assert_eq!(builtin_by_id("fingers").map(|fingers| fingers.values.len()), Some(26));
    for field in [
        "configuration",
        "placement",
        "movement",
        "movement.direction",
        "orientation.palm",
        "orientation.fingers",
        "nonmanual.brows",
        "nonmanual.mouth",
    ] {
        let field: ComponentField = field.parse().expect(field);
        assert!(builtin_for(&field).is_some(), "{field}");
    }
}

fn configurations() -> &'static ComponentInventory {
    builtin_by_id("configurations").expect("the configurations")
}

#[test]
fn the_named_handshapes_are_there() {
    for id in [
        "U",
        "H",
        "V",
        "Y",
        "S",
        "A",
        "B",
        "C",
        "D",
        "F",
        "O",
        "L",
        "1",
        "2",
        "3",
        "4",
        "5",
        "5_folded",
        "5 folded",
        "bent-B",
        "claw",
        "X",
        "ILY",
        "fist",
        "flat",
        "finger23",
        "finger23spread",
        "finger2345",
        "pinch12",
        "pinchall",
        "pinch12open",
        "cee12",
        "ceeall",
        "cee12open",
        "index",
        "W",
        "K",
        "R",
    ] {
        let found = configurations().find_inventory_value(&id.replace(' ', "-"));
        assert!(found.is_some(), "{id}");
    }
    for (id, wanted) in [
        ("U", &["index", "middle", "together", "thumb-across"][..]),
        ("H", &["index", "middle", "together", "thumb-out"]),
        ("V", &["index", "middle", "spread", "-ring"]),
        ("Y", &["thumb", "little", "-index"]),
        ("S", &["closed", "thumb-across"]),
        ("3", &["thumb", "index", "middle", "spread"]),
        ("5_folded", &["index", "middle", "ring", "little", "spread", "curved"]),
        ("F", &["index", "thumb", "aperture-closed"]),
        ("C", &["curved", "aperture-open"]),
    ] {
        let value = configurations().value_by_id(id).expect(id);
        for feature in wanted {
            let (name, is_wanted) = feature.strip_prefix('-').map_or((*feature, true), |name| (name, false));
            let has = value.features.iter().any(|known| known == name);
            assert_eq!(has, is_wanted, "{id}: {:?}", value.features);
        }
    }
}

/// Ranges in degrees in the order of [`HandAngles::to_array`]: the movement of an adult's hand without pain, with
/// some room.
fn limits() -> Vec<(f64, f64)> {
    let mut all = vec![
        // The thumb of W reaches across the palm.
        (-20.0, 75.0),
        (-10.0, 75.0),
        (-10.0, 90.0),
        (-15.0, 70.0),
        (-15.0, 85.0),
    ];
    for _ in HandFinger::ALL_FINGERS {
        all.extend([(-25.0, 25.0), (-20.0, 95.0), (-5.0, 112.0), (-10.0, 85.0)]);
    }
    all
}

#[test]
fn every_configuration_is_one_plausible_hand() {
    let values = &configurations().values;
    for (n, value) in values.iter().enumerate() {
        let pose = value.pose.unwrap_or_else(|| panic!("{} has no pose", value.id));
        let degrees = pose.map_hand_angles(f64::to_degrees).to_array();
        for (k, (angle, (least, most))) in degrees.iter().zip(limits()).enumerate() {
            assert!((least..=most).contains(angle), "{} angle {k}: {angle}", value.id);
        }
        assert!(!value.features.is_empty(), "{}", value.id);
        for other in &values[..n] {
            let theirs = other
                .pose
                .unwrap_or_default()
                .map_hand_angles(f64::to_degrees)
                .to_array();
            let apart = degrees
                .iter()
                .zip(theirs)
                .map(|(a, b)| (a - b).abs())
                .fold(0.0, f64::max);
            assert!(apart > 7.5, "{} and {} are one shape", value.id, other.id);
        }
    }
}

#[test]
fn stretched_fingers_are_the_selected_ones() {
    for value in &configurations().values {
        let pose = value.pose.expect("a pose");
        for finger in HandFinger::ALL_FINGERS {
            let bend: f64 = pose.fingers[finger.index()].flexion.iter().sum();
            let bend = bend.to_degrees();
            let good = if value.features.contains(finger.finger_name()) {
                bend < 235.0
            } else {
                let open = ["pinch12open", "cee12open"];
                let open = open.iter().any(|class| value.features.contains(*class));
                open || bend > 150.0
            };
            assert!(good, "{} {}: {bend}", value.id, finger.finger_name());
        }
    }
}

#[test]
fn the_alphabet_spells_every_letter_with_known_shapes_and_directions() {
    let alphabet = builtin_by_id("lsf-alphabet").expect("the alphabet");
    let letters: String = alphabet
        .values
        .iter()
        .filter_map(|value| value.letter.as_deref())
        .collect();
    assert_eq!(letters, "ABCDEFGHIJKLMNOPQRSTUVWXYZ");
    let known = |inventory: &str, id: &str| {
        builtin_by_id(inventory).is_some_and(|inventory| inventory.value_by_id(id).is_some())
    };
    for value in &alphabet.values {
        assert!(value.hand_pose(configurations()).is_some(), "{}", value.id);
        let orientation = value.orientation.as_ref().expect(&value.id);
        assert!(known("palm", &orientation.palm) && known("fingers", &orientation.fingers));
        for stroke in &value.strokes {
            assert!(stroke.direction.iter().all(|direction| known("directions", direction)));
            assert!(stroke.size > 0.0);
        }
        let moves = ["J", "Z"].contains(&value.id.as_str());
        assert_eq!(!value.strokes.is_empty(), moves, "{}", value.id);
    }
}

#[test]
fn every_place_has_a_landmark_within_reach() {
    let placements = builtin_by_id("placements").expect("the placements");
    let known = chereme_motion::BodyAnatomy::landmark_names();
    for value in &placements.values {
        let landmark = value.landmark.as_ref().expect(&value.id);
        assert!(landmark.offset.iter().all(|part| part.abs() <= 0.8), "{}", value.id);
        let (name, _) = landmark.resolve_landmark(BodySide::Left);
        assert!(known.contains(&name), "{}: {name}", value.id);
    }
    for (place, broader) in [
        ("chin", "head"),
        ("under-chin", "head"),
        ("high-left-near", "neutral"),
        ("high-left-near", "high-left"),
        ("elbow-inside", "arm"),
        ("palm", "weak-hand"),
        ("chest", "trunk"),
    ] {
        assert!(placements.is_within_value(place, broader), "{place} in {broader}");
    }
    for (text, id) in [
        ("neutral space", "neutral"),
        ("menton", "chin"),
        ("weak hand", "weak-hand"),
        ("location on chest", ""),
        ("espace neutre", "neutral"),
        ("épaule", "shoulder"),
    ] {
        let found = placements.find_inventory_value(&text.replace("weak hand", "main dominée"));
        assert_eq!(found.map_or("", |value| &value.id), id, "{text}");
    }
}

#[test]
fn directions_are_unit_vectors_that_their_codes_spell() {
    for id in ["directions", "fingers"] {
        for value in &builtin_by_id(id).expect(id).values {
            let direction = value.direction.expect(&value.id);
            let length = direction.iter().map(|part| part * part).sum::<f64>().sqrt();
            assert!((length - 1.0).abs() < 1e-5, "{}", value.id);
            let axis = |plus: &str, minus: &str| {
                let has = |word: &str| f64::from(u8::from(value.id.split('-').any(|w| w == word)));
                has(plus) - has(minus)
            };
            let spelled = [axis("left", "right"), axis("up", "down"), axis("out", "in")];
            for (part, spelled) in direction.iter().zip(spelled) {
                assert!((part.signum() * f64::from(u8::from(*part != 0.0)) - spelled).abs() < 1e-9);
            }
        }
    }
}

#[test]
fn hamnosys_symbols_are_known_ones() {
    let table = std::env::var_os("CHEREME_SHARED_DATA")
        .map(|data| std::path::Path::new(&data).join("../facts/hamnosys_symbols.tsv"));
    let known: Option<BTreeSet<String>> = table.and_then(|path| {
        let text = std::fs::read_to_string(path).ok()?;
        Some(
            text.lines()
                .filter_map(|line| line.split('\t').nth(1))
                .map(str::to_owned)
                .collect(),
        )
    });
    if known.is_none() {
        eprintln!("no table of symbols: only the prefix is checked");
    }
    for inventory in builtin_inventories() {
        for value in &inventory.values {
            for symbol in value.hamnosys.iter().flat_map(|text| text.split(' ')) {
                let good = match &known {
                    Some(known) => known.contains(symbol),
                    None => symbol.starts_with("ham"),
                };
                assert!(good, "{} {}: {symbol:?}", inventory.id, value.id);
            }
        }
    }
}

#[test]
fn the_json_schema_knows_the_fields_that_are_read() {
    let schema: serde_json::Value =
        serde_json::from_str(chereme_data::schema_text("inventory.schema.json")).expect("JSON");
    let fields = |path: &str| -> BTreeSet<String> {
        let object = schema.pointer(path).and_then(serde_json::Value::as_object);
        object.expect(path).keys().cloned().collect()
    };
    let known = |names: &[&str]| -> BTreeSet<String> { names.iter().map(|name| (*name).to_owned()).collect() };
    assert_eq!(
        fields("/$defs/inventory/properties"),
        known(inventory_json::INVENTORY_FIELDS)
    );
    assert_eq!(
        fields("/$defs/value/properties"),
        known(inventory_json::INVENTORY_VALUE_FIELDS)
    );
    assert_eq!(
        fields("/$defs/value/properties/pose/properties"),
        known(inventory_json::HAND_POSE_FIELDS)
    );
    assert_eq!(
        fields("/$defs/finger/properties"),
        known(inventory_json::FINGER_POSE_FIELDS)
    );
}
