//! Inventories as JSON: every fault names its value and field.

use super::{BodyLandmark, ComponentInventory, HandOrientation, InventoryValue, LetterSignStroke, spelling_key};
use crate::component::SignComponent;
use crate::text::{did_you_mean, nearest_candidate};
use chereme_motion::{FingerAngles, HandAngles, HandFinger, ThumbAngles};
use serde::de::DeserializeOwned;
use serde_json::{Map, Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// A place in an inventory's file.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct FilePosition {
    /// The inventory's id, or `None` if it is not known yet.
    pub inventory: Option<String>,
    /// The value's id, or its number from 1 if it has no id.
    pub value: Option<String>,
    /// The field inside, such as `pose.index`.
    pub field: Option<String>,
}

impl fmt::Display for FilePosition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.inventory {
            Some(id) => write!(f, "inventory {id:?}")?,
            None => f.write_str("the inventory")?,
        }
        if let Some(value) = &self.value {
            write!(f, ", value {value:?}")?;
        }
        match &self.field {
            Some(field) => write!(f, ", field {field:?}"),
            None => Ok(()),
        }
    }
}

/// A text that is no inventory.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum InventoryError {
    /// The text is not JSON.
    #[error("line {line}, column {column}: {message}")]
    Syntax {
        /// The line, from 1.
        line: usize,
        /// The column, from 1.
        column: usize,
        /// The message of the JSON reader.
        message: String,
    },
    /// Something has another type than it must have.
    #[error("{place}: {message}")]
    Type {
        /// The place of the fault.
        place: FilePosition,
        /// The fault, and the correct form.
        message: String,
    },
    /// A field is not known.
    #[error("{place}: there is no field {name:?}{}", did_you_mean(nearest.as_deref()))]
    UnknownField {
        /// The place of the fault.
        place: FilePosition,
        /// The field.
        name: String,
        /// The known field nearest to it.
        nearest: Option<String>,
    },
    /// A field is missing.
    #[error("{place}: the field {name:?} is missing")]
    MissingField {
        /// The place of the fault.
        place: FilePosition,
        /// The field.
        name: &'static str,
    },
    /// Two values have one spelling.
    #[error("{place}: {text:?} means {other:?} already; give each value its own ids, aliases and names")]
    Duplicate {
        /// The later value.
        place: FilePosition,
        /// The spelling.
        text: String,
        /// The value that had it first.
        other: String,
    },
    /// A broader value does not exist.
    #[error("{place}: there is no value {id:?}{}", did_you_mean(nearest.as_deref()))]
    UnknownBroader {
        /// The place of the fault.
        place: FilePosition,
        /// The id.
        id: String,
        /// The id nearest to it.
        nearest: Option<String>,
    },
    /// A chain of broader values leads back to a value in it.
    #[error("{place}: the value lies within itself; give it a broader one that is not part of it")]
    BroaderCycle {
        /// The place of the fault.
        place: FilePosition,
    },
}

pub(super) const INVENTORY_FIELDS: &[&str] = &[
    "id",
    "component",
    "feature",
    "version",
    "language",
    "names",
    "description",
    "values",
];
pub(super) const INVENTORY_VALUE_FIELDS: &[&str] = &[
    "id",
    "names",
    "aliases",
    "broader",
    "features",
    "hamnosys",
    "configuration",
    "pose",
    "letter",
    "orientation",
    "strokes",
    "landmark",
    "offset",
    "direction",
    "roll",
    "size",
    "times",
    "notes",
];
pub(super) const HAND_POSE_FIELDS: &[&str] = &["thumb", "index", "middle", "ring", "little"];
const THUMB_POSE_FIELDS: &[&str] = &["radial", "palmar", "opposition", "flexion"];
pub(super) const FINGER_POSE_FIELDS: &[&str] = &["spread", "flexion"];

impl ComponentInventory {
    /// Reads one inventory from JSON, as `schema/inventory.schema.json` describes it.
    ///
    /// # Errors
    /// [`InventoryError`] if the text is not an inventory; it names the value and field at fault.
    pub fn from_json(text: &str) -> Result<Self, InventoryError> {
        read_inventory(parse_inventory_json(text)?)
    }

    /// Reads one inventory, or a list of them, from JSON.
    ///
    /// # Errors
    /// [`InventoryError`] if the text is not such JSON; it names the value and field at fault.
    pub fn all_from_json(text: &str) -> Result<Vec<Self>, InventoryError> {
        match parse_inventory_json(text)? {
            Value::Array(list) => list.into_iter().map(read_inventory).collect(),
            one => Ok(vec![read_inventory(one)?]),
        }
    }

    /// Writes the inventory as JSON; reading it gives the inventory back, angles to within 1e-9
    /// degrees.
    #[must_use]
    pub fn to_json(&self) -> String {
        let mut map = Map::new();
        map.insert("id".into(), json!(self.id));
        map.insert("component".into(), json!(self.component));
        insert_optional_text(&mut map, "feature", &self.feature);
        map.insert("version".into(), json!(self.version));
        insert_optional_text(&mut map, "language", &self.language);
        map.insert("names".into(), json!(self.names));
        map.insert("description".into(), json!(self.description));
        map.insert("values".into(), self.values.iter().map(write_value).collect());
        format!("{:#}\n", Value::Object(map))
    }

    /// Checks what [`from_json`](Self::from_json) checks beyond the JSON's structure: spellings are unique, except for
    /// ids that differ only in case or accents, and broader values exist.
    ///
    /// # Errors
    /// The first [`InventoryError`] found.
    pub fn check_inventory(&self) -> Result<(), InventoryError> {
        let mut seen: BTreeMap<String, &str> = BTreeMap::new();
        for value in &self.values {
            let place = |field: &str| FilePosition {
                inventory: Some(self.id.clone()),
                value: Some(value.id.clone()),
                field: Some(field.to_owned()),
            };
            let spelling_keys: BTreeSet<String> = value.value_spellings().map(spelling_key).collect();
            for text in spelling_keys {
                if let Some(other) = seen.get(&text) {
                    // Ids that differ in case or accents are two values.
                    let apart = *other != value.id && spelling_key(other) == text && spelling_key(&value.id) == text;
                    if apart {
                        continue;
                    }
                    let other = (*other).to_owned();
                    return Err(InventoryError::Duplicate {
                        place: place("id"),
                        text,
                        other,
                    });
                }
                seen.insert(text, &value.id);
            }
            let Some(broader) = &value.broader else {
                continue;
            };
            if self.value_by_id(broader).is_none() {
                let ids = self.values.iter().map(|value| value.id.as_str());
                let nearest = nearest_candidate(broader, ids).map(str::to_owned);
                let (place, id) = (place("broader"), broader.clone());
                return Err(InventoryError::UnknownBroader { place, id, nearest });
            }
            if self
                .broader_value_chain(&value.id)
                .skip(1)
                .any(|above| above.id == value.id)
            {
                return Err(InventoryError::BroaderCycle {
                    place: place("broader"),
                });
            }
        }
        Ok(())
    }
}

fn parse_inventory_json(text: &str) -> Result<Value, InventoryError> {
    serde_json::from_str(text.trim_start_matches('\u{feff}')).map_err(|error| InventoryError::Syntax {
        line: error.line(),
        column: error.column(),
        message: error.to_string(),
    })
}

fn read_inventory(value: Value) -> Result<ComponentInventory, InventoryError> {
    let id = value.get("id").and_then(Value::as_str).map(str::to_owned);
    let mut object = InventoryObject::new(
        value,
        FilePosition {
            inventory: id,
            ..FilePosition::default()
        },
        INVENTORY_FIELDS,
    )?;
    let inventory = ComponentInventory {
        id: object.take_required_field("id")?,
        component: read_component(&mut object)?,
        feature: object.take_optional_field("feature")?,
        version: object.take_required_field("version")?,
        language: object.take_optional_field("language")?,
        names: object.take_required_field("names")?,
        description: object.take_optional_field("description")?.unwrap_or_default(),
        values: {
            let place = object.place.clone();
            let values: Vec<Value> = object.take_required_field("values")?;
            let numbered = values.into_iter().enumerate();
            numbered
                .map(|(n, value)| read_value(value, &place, n + 1))
                .collect::<Result<_, _>>()?
        },
    };
    inventory.check_inventory()?;
    Ok(inventory)
}

fn read_component(object: &mut InventoryObject) -> Result<SignComponent, InventoryError> {
    let name: String = object.take_required_field("component")?;
    name.parse()
        .map_err(|error: crate::component::FieldError| InventoryError::Type {
            place: object.field_position("component"),
            message: error.to_string(),
        })
}

fn read_value(value: Value, place: &FilePosition, number: usize) -> Result<InventoryValue, InventoryError> {
    let id = value.get("id").and_then(Value::as_str).map(str::to_owned);
    let place = FilePosition {
        value: id.or(Some(number.to_string())),
        ..place.clone()
    };
    let mut object = InventoryObject::new(value, place, INVENTORY_VALUE_FIELDS)?;
    let id: String = object.take_required_field("id")?;
    if id.trim().is_empty() || id.trim() != id {
        let (place, message) = (
            object.field_position("id"),
            "an id has no blanks around it and is not empty",
        );
        return Err(InventoryError::Type {
            place,
            message: message.to_owned(),
        });
    }
    let landmark: Option<String> = object.take_optional_field("landmark")?;
    let offset: Option<[f64; 3]> = object.take_optional_field("offset")?;
    // An offset counts from a landmark.
    if landmark.is_none() && offset.is_some() {
        return Err(InventoryError::MissingField {
            place: object.place,
            name: "landmark",
        });
    }
    Ok(InventoryValue {
        id,
        names: object.take_optional_field("names")?.unwrap_or_default(),
        aliases: object.take_optional_field("aliases")?.unwrap_or_default(),
        broader: object.take_optional_field("broader")?,
        features: object.take_optional_field("features")?.unwrap_or_default(),
        hamnosys: object.take_optional_field("hamnosys")?,
        configuration: object.take_optional_field("configuration")?,
        pose: object
            .take_optional_field("pose")?
            .map(|pose| read_pose(pose, object.field_position("pose")))
            .transpose()?,
        letter: object.take_optional_field("letter")?,
        orientation: match object.take_optional_field("orientation")? {
            Some(value) => {
                let mut inner =
                    InventoryObject::new(value, object.field_position("orientation"), &["palm", "fingers"])?;
                Some(HandOrientation {
                    palm: inner.take_required_field("palm")?,
                    fingers: inner.take_required_field("fingers")?,
                })
            }
            None => None,
        },
        strokes: {
            let strokes: Vec<Value> = object.take_optional_field("strokes")?.unwrap_or_default();
            let place = object.field_position("strokes");
            strokes
                .into_iter()
                .map(|stroke| read_stroke(stroke, &place))
                .collect::<Result<_, _>>()?
        },
        landmark: landmark.map(|name| BodyLandmark {
            name,
            offset: offset.unwrap_or_default(),
        }),
        direction: object.take_optional_field("direction")?,
        roll: object.take_optional_field("roll")?.map(f64::to_radians),
        size: object.take_optional_field("size")?,
        times: object.take_optional_field("times")?,
        notes: object.take_optional_field("notes")?,
    })
}

fn read_stroke(value: Value, place: &FilePosition) -> Result<LetterSignStroke, InventoryError> {
    let mut object = InventoryObject::new(value, place.clone(), &["direction", "size", "turn"])?;
    Ok(LetterSignStroke {
        direction: object.take_optional_field("direction")?,
        size: object.take_optional_field("size")?.unwrap_or_default(),
        turn: object
            .take_optional_field("turn")?
            .map(f64::to_radians)
            .unwrap_or_default(),
    })
}

fn read_pose(value: Value, place: FilePosition) -> Result<HandAngles, InventoryError> {
    let mut object = InventoryObject::new(value, place, HAND_POSE_FIELDS)?;
    let mut pose = HandAngles::default();
    let mut thumb = InventoryObject::new(
        object.take_required_field("thumb")?,
        object.field_position("thumb"),
        THUMB_POSE_FIELDS,
    )?;
    pose.thumb = ThumbAngles {
        radial: thumb.take_optional_field("radial")?.unwrap_or_default(),
        palmar: thumb.take_optional_field("palmar")?.unwrap_or_default(),
        opposition: thumb.take_optional_field("opposition")?.unwrap_or_default(),
        flexion: thumb.take_optional_field("flexion")?.unwrap_or_default(),
    };
    for finger in HandFinger::ALL_FINGERS {
        let (name, place) = (finger.finger_name(), object.field_position(finger.finger_name()));
        let mut angles = InventoryObject::new(object.take_required_field(name)?, place, FINGER_POSE_FIELDS)?;
        pose.fingers[finger.index()] = FingerAngles {
            spread: angles.take_optional_field("spread")?.unwrap_or_default(),
            flexion: angles.take_optional_field("flexion")?.unwrap_or_default(),
        };
    }
    Ok(pose.map_hand_angles(f64::to_radians))
}

/// A JSON object with known fields, and its place in the file.
struct InventoryObject {
    map: Map<String, Value>,
    place: FilePosition,
}

impl InventoryObject {
    fn new(value: Value, place: FilePosition, known: &[&str]) -> Result<Self, InventoryError> {
        let Value::Object(map) = value else {
            let message = format!("{} where an object with fields must be", json_kind_name(&value));
            return Err(InventoryError::Type { place, message });
        };
        match map.keys().find(|name| !known.contains(&name.as_str())) {
            Some(name) => Err(InventoryError::UnknownField {
                place,
                name: name.clone(),
                nearest: nearest_candidate(name, known.iter().copied()).map(str::to_owned),
            }),
            None => Ok(Self { map, place }),
        }
    }

    fn field_position(&self, field: &str) -> FilePosition {
        let inside = self.place.field.iter().map(|outer| format!("{outer}.{field}")).next();
        FilePosition {
            field: Some(inside.unwrap_or_else(|| field.to_owned())),
            ..self.place.clone()
        }
    }

    fn take_optional_field<T: DeserializeOwned>(&mut self, name: &'static str) -> Result<Option<T>, InventoryError> {
        let Some(value) = self.map.remove(name) else {
            return Ok(None);
        };
        serde_json::from_value(value).map(Some).map_err(|error| {
            let message = error.to_string();
            InventoryError::Type {
                place: self.field_position(name),
                message,
            }
        })
    }

    fn take_required_field<T: DeserializeOwned>(&mut self, name: &'static str) -> Result<T, InventoryError> {
        let place = self.place.clone();
        self.take_optional_field(name)?
            .ok_or(InventoryError::MissingField { place, name })
    }
}

fn json_kind_name(value: &Value) -> &'static str {
    match value {
        Value::Null => "null",
        Value::Bool(_) => "true or false",
        Value::Number(_) => "a number",
        Value::String(_) => "a text",
        Value::Array(_) => "a list",
        Value::Object(_) => "an object",
    }
}

fn insert_optional_text(map: &mut Map<String, Value>, name: &str, value: &Option<String>) {
    if let Some(value) = value {
        map.insert(name.to_owned(), json!(value));
    }
}

fn write_value(value: &InventoryValue) -> Value {
    let mut map = Map::new();
    map.insert("id".into(), json!(value.id));
    if !value.names.is_empty() {
        map.insert("names".into(), json!(value.names));
    }
    if !value.aliases.is_empty() {
        map.insert("aliases".into(), json!(value.aliases));
    }
    insert_optional_text(&mut map, "broader", &value.broader);
    if !value.features.is_empty() {
        map.insert("features".into(), json!(value.features));
    }
    insert_optional_text(&mut map, "hamnosys", &value.hamnosys);
    insert_optional_text(&mut map, "configuration", &value.configuration);
    if let Some(pose) = &value.pose {
        map.insert("pose".into(), write_pose(pose));
    }
    insert_optional_text(&mut map, "letter", &value.letter);
    if let Some(HandOrientation { palm, fingers }) = &value.orientation {
        map.insert("orientation".into(), json!({ "palm": palm, "fingers": fingers }));
    }
    if !value.strokes.is_empty() {
        map.insert("strokes".into(), value.strokes.iter().map(write_stroke).collect());
    }
    if let Some(BodyLandmark { name, offset }) = &value.landmark {
        map.insert("landmark".into(), json!(name));
        map.insert("offset".into(), json!(offset));
    }
    let numbers = [
        ("direction", value.direction.map(|direction| json!(direction))),
        ("roll", value.roll.map(|roll| json!(rounded_degrees(roll)))),
        ("size", value.size.map(|size| json!(size))),
        ("times", value.times.map(|times| json!(times))),
    ];
    let given = numbers
        .into_iter()
        .filter_map(|(name, value)| Some((name.to_owned(), value?)));
    map.extend(given);
    insert_optional_text(&mut map, "notes", &value.notes);
    Value::Object(map)
}

fn write_stroke(stroke: &LetterSignStroke) -> Value {
    let mut map = Map::new();
    insert_optional_text(&mut map, "direction", &stroke.direction);
    map.insert("size".into(), json!(stroke.size));
    map.insert("turn".into(), json!(rounded_degrees(stroke.turn)));
    Value::Object(map)
}

fn write_pose(pose: &HandAngles) -> Value {
    let pose = pose.map_hand_angles(rounded_degrees);
    let ThumbAngles {
        radial,
        palmar,
        opposition,
        flexion,
    } = pose.thumb;
    let mut map = Map::new();
    map.insert(
        "thumb".into(),
        json!({ "radial": radial, "palmar": palmar, "opposition": opposition, "flexion": flexion }),
    );
    for finger in HandFinger::ALL_FINGERS {
        let FingerAngles { spread, flexion } = pose.fingers[finger.index()];
        map.insert(
            finger.finger_name().into(),
            json!({ "spread": spread, "flexion": flexion }),
        );
    }
    Value::Object(map)
}

/// Returns an angle in degrees without the noise of the last binary places.
fn rounded_degrees(radians: f64) -> f64 {
    (radians.to_degrees() * 1e9).round() / 1e9
}
