//! Real notation on bodies: the conditions for every sign. Needs `CHEREME_SHARED_DATA`; the example `notation`
//! prints the same for all of them. The warnings of the animator exist in French.

#[path = "../examples/notation/bodies.rs"]
mod bodies;
#[path = "../examples/notation/checks.rs"]
mod checks;
#[path = "../examples/notation/vectors.rs"]
mod vectors;

use std::path::{Path, PathBuf};

use chereme_compose::notation::{AnimatorSettings, animate_signs};
use chereme_corpus::words::{InterfaceLanguage, localized_message};
use chereme_tests::repository;

/// The fastest that a wrist may go in metres a second, and joints of an arm in radians a second.
const FASTEST: f64 = 6.0;
const TURNING: f64 = 45.0;
/// How deep a hand or an elbow is in the trunk at most, in metres.
const DEEPEST: f64 = 0.01;
/// One sign out of this many is animated on each body.
const EVERY: usize = 12;
/// One of this many vectors of the reference engine is compared.
const VECTORS_EVERY: usize = 7;
/// The median that each group of these had, and a twentieth more.
const LARGEST_MEDIANS: [(&str, f64); 22] = [
    ("palm as asked, one hand", 6.899),
    ("palm reached, one hand", 10.739),
    ("fingers reached, one hand", 15.126),
    ("palm reached, left hand, mirrored", 9.815),
    ("palm reached, left hand, parallel", 25.257),
    ("palm reached, half-way direction", 8.801),
    ("palm reached, half-way palm", 14.279),
    ("place in the face, no mark", 0.180),
    ("place in the face, close", 0.163),
    ("place in the face, touch", 0.172),
    ("place before trunk and head, no mark", 0.107),
    ("place before trunk and head, close", 0.119),
    ("place at the trunk, touch", 0.240),
    ("place, arm extended", 0.473),
    ("place between two", 0.173),
    ("place, both hands", 0.207),
    ("place, hands together", 0.229),
    ("place, the hand at the other hand", 0.209),
    ("place, the other hand under it", 0.045),
    ("joints of fingers", 30.093),
    ("straight movements, direction", 3.579),
    ("written times", 0.016),
];

fn holds_on(body: &Path, folder: &Path, first: usize) {
    let stage = bodies::stage(body).expect("a body that signs");
    assert!(checks::has_hand(&stage.anatomy));
    let signs = bodies::signs(folder).expect("a folder of notation");
    assert!(signs.len() > 1600, "{} signs", signs.len());
    for (name, notated) in signs.iter().skip(first).step_by(EVERY) {
        let made = animate_signs(&[notated], &stage, &AnimatorSettings::default());
        let made = made.unwrap_or_else(|error| panic!("{name}: {error}"));
        let worst = checks::worst(&made);
        assert_eq!(worst.nan, 0, "{name}");
        assert!(worst.bone < 1e-9, "{name}: a bone changes by {} m", worst.bone);
        assert!(
            worst.wrist < 1.05,
            "{name}: a wrist bends to {:.2} of its range",
            worst.wrist
        );
        assert!(
            worst.turn < 1.02,
            "{name}: a forearm turns to {:.2} of its range",
            worst.turn
        );
        assert!(
            worst.hand_depth.max(worst.elbow_depth) < DEEPEST,
            "{name}: a hand is {:.3} m in the trunk, an elbow {:.3} m, at {:.2} s",
            worst.hand_depth,
            worst.elbow_depth,
            worst.deepest
        );
        assert!(worst.speed < FASTEST, "{name}: a hand goes at {:.1} m/s", worst.speed);
        assert!(
            worst.turning < TURNING,
            "{name}: a joint turns at {:.0} rad/s",
            worst.turning
        );
    }
}

#[test]
fn signs_keep_their_contacts_on_the_starter_body_and_a_captured_one() {
    let Some(data) = std::env::var_os("CHEREME_SHARED_DATA").map(PathBuf::from) else {
        eprintln!("CHEREME_SHARED_DATA is not set: real notation is not animated");
        return;
    };
    let folder = data.join("notation/sigml");
    let starter = Path::new(env!("CARGO_MANIFEST_DIR")).join("../corpus/chat.bvh");
    holds_on(&starter, &folder, 0);
    let captured = data.join("motion/bvh/upf-gti-performs/NGT Thanks.bvh");
    holds_on(&captured, &folder, EVERY / 2);
}

#[test]
fn postures_and_movements_stay_as_near_to_those_of_the_reference_engine() {
    let Some(data) = std::env::var_os("CHEREME_SHARED_DATA").map(PathBuf::from) else {
        eprintln!("CHEREME_SHARED_DATA is not set: nothing is compared with the reference engine");
        return;
    };
    let file = data.join("../facts/reference_engine_vectors.json");
    let starter = Path::new(env!("CARGO_MANIFEST_DIR")).join("../corpus/chat.bvh");
    let stage = bodies::stage(&starter).expect("a body that signs");
    let groups = vectors::compare_vectors(&file, &stage, VECTORS_EVERY).expect("the vectors are compared");
    for (row, (name, limit)) in groups.iter().zip(LARGEST_MEDIANS) {
        let (unit, reason) = (row.group.unit, row.group.reason);
        assert_eq!(row.group.name, name);
        let sorted = row.sorted_differences();
        let median = sorted.get(sorted.len() / 2).map_or(f64::INFINITY, |(_, off)| *off);
        assert!(
            median <= limit,
            "{name}: the median is {median:.3} {unit}, at most {limit} before; {reason}"
        );
    }
    let asked = &groups[0];
    assert_eq!(
        asked.count_within(),
        asked.sorted_differences().len(),
        "{}",
        asked.group.name
    );
}

#[test]
fn warnings_of_the_animator_exist_in_french() {
    let folder = repository::root().join("crates/chereme-compose/tests/goldens");
    let mut reported = 0;
    for entry in std::fs::read_dir(folder).expect("goldens") {
        let entry = entry.expect("an entry");
        let name = entry.file_name().to_string_lossy().into_owned();
        if !["notated", "varied"].iter().any(|made| name.starts_with(made)) {
            continue;
        }
        let text = std::fs::read_to_string(entry.path()).expect("text");
        let lists = text.lines().filter_map(|line| line.split_once("warnings "));
        for (_, list) in lists {
            let warnings: Vec<String> = serde_json::from_str(list).expect("a list of texts");
            for warning in warnings {
                let french = localized_message(&warning, InterfaceLanguage::French);
                assert!(french.is_some_and(|it| it != warning), "{warning}");
                reported += 1;
            }
        }
    }
    assert!(reported > 100, "{reported}");
}
