//! Movement pinned down: where hands, fingertips and head are at five moments of recipes on the starter corpus.
//!
//! If movement is meant to change, `UPDATE_GOLDENS=1 cargo test --workspace --test goldens` writes the tables again;
//! their difference then shows how far each sign has moved.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::{env, fs};

use chereme_corpus::{Corpus, ImportOptions, Progress, Recombination, unheard, unpack_starter};
use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{Finger, Part, Side};
use chereme_tests::repository;

/// The moments, as shares of the movement.
const MOMENTS: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];
/// How far, in millimetres, a joint may be from its place: rounding of the table, and of other machines' arithmetic.
const NEAR: f64 = 1.0;
/// How far, in degrees, a hand may be turned from its orientation.
const TURNED: f64 = 1.0;

/// A joint at a moment: its place in millimetres, and its rotation.
#[derive(Debug, Clone, Copy)]
struct Posture {
    at: DVec3,
    turned: DQuat,
}

/// The joints, with the names of their columns.
fn parts() -> [(&'static str, Part); 5] {
    [
        ("head", Part::Head),
        ("right hand", Part::Hand(Side::Right)),
        ("left hand", Part::Hand(Side::Left)),
        ("right index", Part::Finger(Side::Right, Finger::Index, 2)),
        ("left index", Part::Finger(Side::Left, Finger::Index, 2)),
    ]
}

fn folder() -> PathBuf {
    repository::root().join("tests/goldens")
}

fn starter(folder: &std::path::Path) -> Corpus {
    let paths = unpack_starter(&folder.join("starter")).expect("the starter corpus");
    let mut corpus = Corpus::create(&folder.join("c.chereme"), "T").expect("a corpus");
    let mut hear = unheard;
    let mut progress = Progress::new(&mut hear);
    corpus
        .import(&paths, &ImportOptions::default(), &mut progress)
        .expect("imported");
    corpus
}

/// Returns the postures of a generated sign at each moment.
fn postures(made: &Recombination) -> Vec<Vec<Posture>> {
    let joints = parts().map(|(name, part)| made.anatomy.joint(part).expect(name));
    let last = made.clip.frames() - 1;
    let at = |moment: f64| {
        let model = made
            .clip
            .model_pose((last as f64 * moment).round() as usize);
        let posture = |joint: usize| Posture {
            at: model.position(joint) * 1000.0,
            turned: model.rotation(joint),
        };
        joints.iter().map(|&joint| posture(joint)).collect()
    };
    MOMENTS.into_iter().map(at).collect()
}

/// Returns a line of the table: the recipe, the moment, and for each joint place and rotation.
fn line(recipe: &str, moment: f64, postures: &[Posture]) -> String {
    let mut line = format!("{recipe}\t{moment}");
    for Posture { at, turned } in postures {
        let turned = if turned.w < 0.0 { -*turned } else { *turned };
        let [x, y, z] = at.to_array();
        let [i, j, k, w] = turned.to_array();
        write!(line, "\t{x:.1} {y:.1} {z:.1} {i:.4} {j:.4} {k:.4} {w:.4}").expect("a text grows");
    }
    line
}

fn read(cell: &str) -> Posture {
    let numbers: Vec<f64> = cell
        .split(' ')
        .map(|number| number.parse().expect("a number"))
        .collect();
    let [x, y, z, i, j, k, w] = numbers[..] else {
        panic!("seven numbers, not {cell:?}");
    };
    Posture {
        at: DVec3::new(x, y, z),
        turned: DQuat::from_xyzw(i, j, k, w).normalize(),
    }
}

/// Compares the recipes of a list with their table, or writes the table.
fn compare(list: &str) {
    let of = |ending: &str| folder().join(format!("{list}.{ending}"));
    let recipes = fs::read_to_string(of("txt")).expect("the list of recipes");
    let recipes: Vec<&str> = recipes
        .lines()
        .filter(|line| !line.is_empty() && !line.starts_with('#'))
        .collect();
    let scratch = tempfile::tempdir().expect("a folder");
    let mut corpus = starter(scratch.path());
    let mut now = Vec::new();
    for recipe in &recipes {
        let made = corpus.preview(recipe);
        let made = made.unwrap_or_else(|error| panic!("{recipe}: {error}"));
        now.push(postures(&made));
    }
    let lines = recipes.iter().zip(&now).flat_map(|(recipe, all)| {
        let moments = MOMENTS.iter().zip(all);
        moments.map(move |(moment, postures)| line(recipe, *moment, postures))
    });
    let lines: Vec<String> = lines.collect();
    if env::var_os("UPDATE_GOLDENS").is_some() {
        let head = parts().map(|(name, _)| name).join("\t");
        let table = format!("recipe\tmoment\t{head}\n{}\n", lines.join("\n"));
        fs::write(of("tsv"), table).expect("the table is written");
        return;
    }
    let table = fs::read_to_string(of("tsv")).expect("the table");
    let known: Vec<&str> = table.lines().skip(1).collect();
    assert_eq!(
        known.len(),
        lines.len(),
        "{list}: recipes were added or removed"
    );
    let mut faults = Vec::new();
    for (was, is) in known.iter().zip(&lines) {
        let [before, after] = [was, &is.as_str()].map(|it| it.split('\t').collect::<Vec<&str>>());
        assert_eq!(
            before[..2],
            after[..2],
            "{list}: the recipes stand in another order"
        );
        for (at, (name, _)) in parts().iter().enumerate() {
            let (was, is) = (read(before[at + 2]), read(after[at + 2]));
            let moved = was.at.distance(is.at);
            let turned = was.turned.angle_between(is.turned).to_degrees();
            let turned = turned.min(360.0 - turned);
            if moved > NEAR || (name.contains("hand") && turned > TURNED) {
                let place = format!("{} at {}", after[0], after[1]);
                faults.push(format!(
                    "{place}, {name}: {moved:.1} mm, {turned:.1} degrees"
                ));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn recipes_move_as_they_did() {
    compare("recipes");
}
