//! The JSON that SLP-AA exports: signs with modules; read as a table of one sign per row.
//!
//! A hand configuration is written there in the slots of Johnson and Liddell: thumb, thumb's contact, and three joints
//! for each finger. The nearest handshape of this project's inventory goes into the column of handshapes; the slots
//! themselves are kept next to it as text. Places and movements are the checked leaves of SLP-AA's trees.

use chereme_motion::{FingerAngles, HandAngles};
use chereme_sign::inventory;
use serde_json::{Map, Value};

use super::lexicon_json::json_cell_text;
use crate::table::{TableCells, TableRow};

/// The most bytes of JSON that are read.
const MAX_SLPAA_BYTES: usize = 64 << 20;
/// The greatest distance, in radians, of a posture from the handshape that it gets.
const MAX_POSTURE_DISTANCE_RADIANS: f64 = 0.33;

const SLPAA_COLUMN_TITLES: [&str; 15] = [
    "gloss",
    "slp-aa entry",
    "lemma",
    "id gloss",
    "sign type",
    "handshape strong",
    "handshape weak",
    "location",
    "movement",
    "slots of hand 1",
    "slots of hand 2",
    "source",
    "signer",
    "frequency",
    "note",
];

/// The bends of the base, middle and end joints in a fist, in degrees.
const SLPAA_FIST_DEGREES: [f64; 3] = [85.0, 100.0, 65.0];

/// Returns the table of the signs of an export; `None` if the bytes are something else.
pub(super) fn read_slpaa_cells(bytes: &[u8]) -> Option<TableCells> {
    let text = str::from_utf8(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)).ok()?;
    if bytes.len() > MAX_SLPAA_BYTES || !text.contains("\"signlevel\"") {
        return None;
    }
    let document: Value = serde_json::from_str(text).ok()?;
    let signs = match &document {
        Value::Object(corpus) => corpus.get("signs")?.as_array()?,
        Value::Array(signs) => signs,
        _ => return None,
    };
    let mut lines = text.match_indices("\"signlevel\"");
    let (mut line, mut from) = (1, 0);
    let mut rows = Vec::with_capacity(signs.len());
    for sign in signs {
        let level = sign.get("signlevel")?.as_object()?;
        if let Some((at, _)) = lines.next() {
            line += memchr::memchr_iter(b'\n', &text.as_bytes()[from..at]).count() as u64;
            from = at;
        }
        rows.push(TableRow {
            line,
            cells: slpaa_sign_row(sign, level),
        });
    }
    Some(TableCells {
        header_line: 1,
        header: SLPAA_COLUMN_TITLES.map(str::to_owned).to_vec(),
        rows,
        delimiter: b',',
    })
}

fn slpaa_sign_row(sign: &Value, level: &Map<String, Value>) -> Vec<String> {
    let named = |key: &str| plain_value_text(level.get(key));
    let lemma = named("lemma");
    let id_gloss = named("idgloss");
    let glosses = [named("gloss"), lemma.clone(), id_gloss.clone()];
    // The first name that is filled in stands for the sign.
    let gloss = glosses.into_iter().find(|name| !name.is_empty());
    let hands = modules(sign, "cfg");
    let shapes = |hand: usize| value_sequence_text(&hands, hand, nearest_module_handshape);
    let slots = |hand: usize| {
        let of_hand = hands.iter().filter(|module| is_module_of_hand(module, hand));
        let texts: Vec<String> = of_hand.filter_map(|module| transcription(module)).collect();
        texts.join(" ")
    };
    let ends = |kind: &str, tree: &str| {
        let kind_modules = modules(sign, kind);
        value_sequence_text(&kind_modules, 0, |module| {
            let leaves = checked_tree_leaves(module.get(tree)?);
            (!leaves.is_empty()).then(|| leaves.join(" + "))
        })
    };
    vec![
        gloss.unwrap_or_default(),
        named("entryid"),
        lemma,
        id_gloss,
        sign_type(sign),
        shapes(1),
        shapes(2),
        ends("loc", "locationtree"),
        ends("mov", "movementtree"),
        slots(1),
        slots(2),
        named("source"),
        named("signer"),
        named("frequency"),
        named("note"),
    ]
}

/// Returns a value as text; of a list, its first element.
fn plain_value_text(value: Option<&Value>) -> String {
    match value {
        Some(Value::Array(all)) => json_cell_text(all.first()),
        other => json_cell_text(other),
    }
}

/// Returns the modules of a kind in the order of their numbers.
fn modules<'v>(sign: &'v Value, kind: &str) -> Vec<&'v Map<String, Value>> {
    let Some(Value::Object(all)) = sign.get(format!("{kind} modules")) else {
        return Vec::new();
    };
    let numbers = sign.get(format!("{kind} module numbers"));
    let number = |key: &String| numbers.and_then(|map| map.get(key)).and_then(Value::as_u64);
    let mut numbered_modules: Vec<(Option<u64>, &Map<String, Value>)> = all
        .iter()
        .filter_map(|(key, module)| Some((number(key), module.as_object()?)))
        .collect();
    numbered_modules.sort_by_key(|(number, _)| number.unwrap_or(u64::MAX));
    numbered_modules.into_iter().map(|(_, module)| module).collect()
}

/// Returns the attribute of a module; its name may begin with an underscore.
fn module_attribute<'v>(module: &'v Map<String, Value>, name: &str) -> Option<&'v Value> {
    module.get(name).or_else(|| module.get(&format!("_{name}")))
}

/// Returns whether a module belongs to hand 1 or 2; 0 means any hand.
fn is_module_of_hand(module: &Map<String, Value>, hand: usize) -> bool {
    if hand == 0 {
        return true;
    }
    match module_attribute(module, "articulators") {
        Some(Value::Array(both)) => {
            let which = both.get(1).and_then(|hands| hands.get(hand.to_string()));
            let is_hand = both.first().and_then(Value::as_str);
            is_hand.is_none_or(|part| part.eq_ignore_ascii_case("hand")) && which.and_then(Value::as_bool) == Some(true)
        }
        // A module that names no hand belongs to the dominant one.
        _ => hand == 1,
    }
}

/// Returns successive values as a lexicon table writes them: `A > B`.
fn value_sequence_text(
    modules: &[&Map<String, Value>],
    hand: usize,
    value: impl Fn(&Map<String, Value>) -> Option<String>,
) -> String {
    let hand_modules = modules.iter().filter(|module| is_module_of_hand(module, hand));
    let mut texts: Vec<String> = hand_modules.filter_map(|module| value(module)).collect();
    texts.dedup();
    texts.join(" > ")
}

/// Returns the symbols of a hand configuration by the number of their slot, from 2 to 34.
fn configuration_symbols(module: &Map<String, Value>) -> Option<[String; 35]> {
    let fields = module_attribute(module, "handconfiguration")?.as_array()?;
    let mut symbols: [String; 35] = std::array::from_fn(|_| String::new());
    for field in fields {
        for slot in field.get("slots")?.as_array()? {
            let number = slot.get("slot_number").and_then(Value::as_u64);
            let text = json_cell_text(slot.get("symbol"));
            if let Some(place) = number.and_then(|at| symbols.get_mut(usize::try_from(at).ok()?)) {
                *place = text;
            }
        }
    }
    symbols[2..].iter().any(|symbol| !symbol.is_empty()).then_some(symbols)
}

/// Returns the slots as people write them: each field in brackets.
fn transcription(module: &Map<String, Value>) -> Option<String> {
    let symbols = configuration_symbols(module)?;
    let fields = [2..6, 6..16, 16..20, 20..25, 25..30, 30..35];
    Some(fields.map(|slots| format!("[{}]", symbols[slots].concat())).concat())
}

/// Returns the bend for a letter, as a share of the bend in a fist.
fn bend_from_symbol(symbol: &str) -> Option<f64> {
    Some(match symbol {
        "H" => -0.12,
        "E" => 0.0,
        "e" => 0.2,
        "i" => 0.5,
        "f" => 0.75,
        "F" => 1.0,
        _ => return None,
    })
}

/// Returns the handshape nearest to the slots of a module.
fn nearest_module_handshape(module: &Map<String, Value>) -> Option<String> {
    let (angles, known) = angles_from_symbols(&configuration_symbols(module)?)?;
    let off = |pose: &HandAngles| {
        let pairs = pose.to_array().into_iter().zip(angles.to_array());
        let joint_pairs = pairs.zip(known).filter(|(_, known)| *known);
        let squares: Vec<f64> = joint_pairs.map(|((a, b), _)| (a - b).powi(2)).collect();
        (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt()
    };
    let shapes = inventory::builtin_by_id("configurations")?;
    let near = shapes
        .values
        .iter()
        .filter_map(|value| Some((off(value.pose.as_ref()?), &value.id)));
    let (far, id) = near.min_by(|a, b| a.0.total_cmp(&b.0))?;
    (far < MAX_POSTURE_DISTANCE_RADIANS).then(|| id.clone())
}

/// Returns the posture that the slots describe, and which of its angles they give; `None` if most fingers are not
/// described.
fn angles_from_symbols(symbols: &[String; 35]) -> Option<(HandAngles, [bool; HandAngles::HAND_ANGLE_COUNT])> {
    let mut hand = HandAngles::default();
    let mut given_angles = [false; HandAngles::HAND_ANGLE_COUNT];
    for (finger, first) in [17, 22, 27, 32].into_iter().enumerate() {
        for joint in 0..3 {
            if let Some(share) = bend_from_symbol(&symbols[first + joint]) {
                hand.fingers[finger].flexion[joint] = (share * SLPAA_FIST_DEGREES[joint]).to_radians();
                given_angles[5 + 4 * finger + 1 + joint] = true;
            }
        }
    }
    // Nine of twelve joints are three of four fingers.
    if given_angles.iter().filter(|known| **known).count() < 9 {
        return None;
    }
    spreads(symbols, &mut hand.fingers, &mut given_angles);
    let wide = match symbols[3].as_str() {
        "{" => Some(1.0),
        "<" => Some(0.5),
        "=" => Some(0.0),
        _ => None,
    };
    if let Some(wide) = wide {
        let between = |beside: [f64; 3], away: [f64; 3]| [0, 1, 2].map(|n| beside[n] + (away[n] - beside[n]) * wide);
        // Degrees of a thumb beside and away from the hand, opposed or lateral, as the inventory of handshapes has
        // them.
        let [radial, palmar, opposition] = match symbols[2].as_str() {
            "O" => between([16.0, 55.0, 16.0], [34.0, 58.0, 60.0]),
            _ => between([12.0, 2.0, 0.0], [60.0, 8.0, 0.0]),
        };
        hand.thumb.radial = radial.to_radians();
        hand.thumb.palmar = palmar.to_radians();
        hand.thumb.opposition = opposition.to_radians();
        given_angles[..3].fill(true);
    }
    // Degrees of the thumb's joints in a fist.
    for (joint, most) in [50.0, 70.0].into_iter().enumerate() {
        if let Some(share) = bend_from_symbol(&symbols[4 + joint]) {
            hand.thumb.flexion[joint] = f64::to_radians(share * most);
            given_angles[3 + joint] = true;
        }
    }
    Some((hand, given_angles))
}

/// Spreads fingers by the symbols between them.
fn spreads(symbols: &[String; 35], fingers: &mut [FingerAngles; 4], known: &mut [bool]) {
    let gap = |slot: usize| -> Option<f64> {
        let degrees: f64 = match symbols[slot].as_str() {
            "{" => 12.0,
            "<" => 6.0,
            "=" => 0.0,
            "x" | "x+" | "ƻ" => -16.0,
            _ => return None,
        };
        Some(degrees.to_radians())
    };
    let [first, second, third] = [20, 25, 30].map(gap);
    // The symbol between two fingers moves the outer one; the middle finger stays.
    let straight = |finger: usize| fingers[finger].flexion[0] < 0.6;
    let open = [0, 1, 2, 3].map(straight);
    if let Some(gap) = first {
        fingers[0].spread = if open[0] && open[1] { gap } else { 0.0 };
        known[5] = true;
    }
    if let Some(gap) = second {
        fingers[2].spread = if open[1] && open[2] { -gap } else { 0.0 };
        known[13] = true;
    }
    if let Some(gap) = third {
        let more = if open[2] && open[3] { gap } else { 0.0 };
        fingers[3].spread = fingers[2].spread - more;
        known[17] = true;
    }
}

/// Returns the leaves of the checked branches of a tree, each as the last part of its path.
fn checked_tree_leaves(tree: &Value) -> Vec<String> {
    let Some(Value::Object(states)) = tree.get("checkstates") else {
        return Vec::new();
    };
    let checked: Vec<&str> = states
        .iter()
        .filter(|(_, state)| state.as_i64() == Some(2))
        .map(|(path, _)| path.as_str())
        .collect();
    let is_end = |path: &&&str| {
        let below = format!("{path}>");
        !checked.iter().any(|other| other.starts_with(&below))
    };
    let ends = checked.iter().filter(is_end);
    ends.map(|path| path.rsplit('>').next().unwrap_or(path).replace('+', " and "))
        .collect()
}

/// Returns the number of hands of a sign, in the words of this project's lexicons.
fn sign_type(sign: &Value) -> String {
    let specs = sign
        .get("type")
        .and_then(Value::as_object)
        .and_then(|value| module_attribute(value, "specslist"));
    let Some(Value::Array(specs)) = specs else {
        return String::new();
    };
    let mut texts: Vec<&str> = specs
        .iter()
        .filter_map(|spec| spec.get(0).and_then(Value::as_str).or_else(|| spec.as_str()))
        .collect();
    texts.sort_by_key(|text| std::cmp::Reverse(text.len()));
    let longest = texts.first().copied().unwrap_or_default();
    longest.replace(['>', '+'], ", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lexicon;
    use crate::roles::TierMapping;

    fn slots(symbols: [&str; 33]) -> Value {
        let slots: Vec<Value> = (2..)
            .zip(symbols)
            .filter(|(_, symbol)| !symbol.is_empty())
            .map(|(number, symbol)| serde_json::json!({"slot_number": number, "symbol": symbol}))
            .collect();
        serde_json::json!([{"field_number": 2, "slots": slots}])
    }

    const ONE: [&str; 33] = [
        "O", "=", "i", "i", "fr", "d", "\u{2205}", "/", "b", "m", "-", "2", "-", "-", "1", "E", "E", "E", "<", "2",
        "F", "F", "F", "=", "3", "F", "F", "F", "=", "4", "F", "F", "F",
    ];
    const FIVE: [&str; 33] = [
        "L", "{", "E", "E", "-", "-", "\u{2205}", "/", "-", "-", "-", "-", "-", "-", "1", "E", "E", "E", "{", "2", "E",
        "E", "E", "{", "3", "E", "E", "E", "{", "4", "E", "E", "E",
    ];
    const FIST: [&str; 33] = [
        "U", "=", "E", "E", "fr", "d", "\u{2205}", "/", "r", "p", "1", "-", "-", "-", "1", "F", "F", "F", "=", "2",
        "F", "F", "F", "=", "3", "F", "F", "F", "=", "4", "F", "F", "F",
    ];

    #[test]
    fn signs_of_an_export_have_handshapes_places_and_movements() {
        let hand = |slots: Value, hand: &str| serde_json::json!({"_handconfiguration": slots, "_articulators": ["Hand", {hand: true}]});
        let document = serde_json::json!({
            "name": "corpus.slpaa",
            "signs": [{
                "signlevel": {"entryid": 7, "gloss": ["DOG", "HOUND"], "lemma": "dog", "signer": "Anna"},
                "type": {"_specslist": [["Two hands", true], ["Two hands>Both hands move", true]]},
                "cfg modules": {"b": hand(slots(FIVE), "1"), "a": hand(slots(ONE), "1"), "c": hand(slots(FIST), "2")},
                "cfg module numbers": {"a": 1, "b": 2, "c": 3},
                "loc modules": {"x": {"locationtree": {"checkstates":
                    {"Body": 2, "Body>Chin": 2, "Body>Forehead": 1}}}},
                "mov modules": {"x": {"movementtree": {"checkstates": {"Movement type>Shape>Arc": 2}}}},
            }]
        });
        let text = serde_json::to_string_pretty(&document).expect("JSON");
        let (lexicon, _) = lexicon::read_lexicon(text.as_bytes(), &TierMapping::default()).expect("a lexicon");
        let sign = &lexicon.entries[0];
        assert_eq!((sign.gloss.as_str(), lexicon.entries.len()), ("DOG", 1));
        let said: Vec<String> = sign
            .codings
            .iter()
            .map(|it| format!("{}={}", it.coding_field(), it.reading))
            .collect();
        for wanted in [
            "initial.dominant.configuration=1",
            "final.dominant.configuration=5",
            "weak.configuration=A",
            "placement=Chin",
            "movement=Arc",
        ] {
            assert!(said.iter().any(|it| it == wanted), "{wanted}: {said:?}");
        }
        let kept = |title: &str| sign.attributes.iter().any(|(name, _)| name == title);
        assert!(kept("slots of hand 1") && kept("slp-aa entry"), "{:?}", sign.attributes);
    }

    #[test]
    fn json_that_is_no_export_is_left_to_other_readers() {
        for text in [
            "{}",
            "[]",
            "{\"signs\": 3, \"signlevel\": 1}",
            "\"signlevel\"",
            "{\"signs\":[{\"signlevel\":2}]}",
        ] {
            assert_eq!(read_slpaa_cells(text.as_bytes()), None, "{text}");
        }
    }
}
