//! Movement pinned down: where hands, fingertips and head are at five moments of recipes on the starter corpus and of
//! notated signs; and what the transcriber reads from the latter.
//!
//! If movement is meant to change, `UPDATE_GOLDENS=1 cargo test --workspace --test goldens` writes the tables again;
//! their difference then shows how far each sign has moved.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::{env, fs};

use chereme_analysis::transcribe::{TranscribeOptions, transcribe_clip};
use chereme_corpus::{
    Corpus, ImportOptions, ProgressReceiver, RecombinationResult, ignore_progress_step, unpack_starter,
};
use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{BodyPart, BodySide, HandFinger};
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
fn parts() -> [(&'static str, BodyPart); 5] {
    [
        ("head", BodyPart::Head),
        ("right hand", BodyPart::Hand(BodySide::Right)),
        ("left hand", BodyPart::Hand(BodySide::Left)),
        ("right index", BodyPart::Finger(BodySide::Right, HandFinger::Index, 2)),
        ("left index", BodyPart::Finger(BodySide::Left, HandFinger::Index, 2)),
    ]
}

fn folder() -> PathBuf {
    repository::root().join("tests/goldens")
}

fn starter(folder: &std::path::Path) -> Corpus {
    let paths = unpack_starter(&folder.join("starter")).expect("the starter corpus");
    let mut corpus = Corpus::create_corpus(&folder.join("c.chereme"), "T").expect("a corpus");
    let mut hear = ignore_progress_step;
    let mut progress = ProgressReceiver::new(&mut hear);
    corpus
        .import_paths(&paths, &ImportOptions::default(), &mut progress)
        .expect("imported");
    corpus
}

/// Returns the postures of a generated sign at each moment.
fn postures(made: &RecombinationResult) -> Vec<Vec<Posture>> {
    let joints = parts().map(|(name, part)| made.anatomy.part_joint(part).expect(name));
    let last = made.clip.clip_frame_count() - 1;
    let at = |moment: f64| {
        let model = made.clip.model_pose((last as f64 * moment).round() as usize);
        let posture = |joint: usize| Posture {
            at: model.model_joint_position(joint) * 1000.0,
            turned: model.model_joint_rotation(joint),
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

/// Returns the recipes of a list, one on each line; a line with `#` is a remark.
fn recipes(list: &str) -> Vec<String> {
    let lines = fs::read_to_string(folder().join(format!("{list}.txt"))).expect("the list of recipes");
    let kept = lines.lines().filter(|line| !line.is_empty() && !line.starts_with('#'));
    kept.map(str::to_owned).collect()
}

/// Compares the recipes of a list with their table, or writes the table.
fn compare(list: &str) {
    let recipes = recipes(list);
    let path = folder().join(format!("{list}.tsv"));
    let scratch = tempfile::tempdir().expect("a folder");
    let mut corpus = starter(scratch.path());
    let mut now = Vec::new();
    for recipe in &recipes {
        let made = corpus.preview_recipe(recipe);
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
        fs::write(&path, table).expect("the table is written");
        return;
    }
    let table = fs::read_to_string(&path).expect("the table");
    let known: Vec<&str> = table.lines().skip(1).collect();
    assert_eq!(known.len(), lines.len(), "{list}: recipes were added or removed");
    let mut faults = Vec::new();
    for (was, is) in known.iter().zip(&lines) {
        let [before, after] = [was, &is.as_str()].map(|it| it.split('\t').collect::<Vec<&str>>());
        assert_eq!(before[..2], after[..2], "{list}: the recipes stand in another order");
        for (at, (name, _)) in parts().iter().enumerate() {
            let (was, is) = (read(before[at + 2]), read(after[at + 2]));
            let moved = was.at.distance(is.at);
            let turned = was.turned.angle_between(is.turned).to_degrees();
            let turned = turned.min(360.0 - turned);
            if moved > NEAR || (name.contains("hand") && turned > TURNED) {
                let place = format!("{} at {}", after[0], after[1]);
                faults.push(format!("{place}, {name}: {moved:.1} mm, {turned:.1} degrees"));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn recipes_move_as_they_did() {
    compare("recipes");
}

#[test]
fn notated_signs_move_as_they_did() {
    compare("notated");
}

/// Returns the lines of a table: for each recipe the features of its transcription, each with hand and stage.
fn transcriptions(recipes: &[String]) -> Vec<String> {
    let scratch = tempfile::tempdir().expect("a folder");
    let mut corpus = starter(scratch.path());
    let mut lines = Vec::new();
    for recipe in recipes {
        let made = corpus.preview_recipe(recipe);
        let made = made.unwrap_or_else(|error| panic!("{recipe}: {error}"));
        let read = transcribe_clip(&made.clip, &made.anatomy, &TranscribeOptions::synthesised_options());
        let read = read.unwrap_or_else(|error| panic!("{recipe}: {error}"));
        for feature in &read.features {
            let hand = feature.hand.map_or("", |hand| match hand {
                BodySide::Right => "right",
                BodySide::Left => "left",
            });
            let action = feature.action.map(|n| n.to_string()).unwrap_or_default();
            let (kind, value) = (feature.kind, &feature.value);
            lines.push(format!("{recipe}\t{action}\t{hand}\t{kind:?}\t{value}"));
        }
    }
    lines
}

#[test]
fn movement_is_transcribed_as_it_was() {
    let now = transcriptions(&recipes("notated"));
    let table = folder().join("transcribed.tsv");
    if env::var_os("UPDATE_GOLDENS").is_some() {
        let text = format!("recipe\taction\thand\tfeature\tvalue\n{}\n", now.join("\n"));
        fs::write(table, text).expect("the table is written");
        return;
    }
    let known = fs::read_to_string(table).expect("the table");
    let known: Vec<&str> = known.lines().skip(1).collect();
    let gone = known.iter().filter(|line| !now.iter().any(|it| it == *line));
    let new = now.iter().filter(|line| !known.contains(&line.as_str()));
    let changes: Vec<String> = gone
        .map(|line| format!("- {line}"))
        .chain(new.map(|line| format!("+ {line}")))
        .collect();
    assert!(changes.is_empty(), "{}", changes.join("\n"));
}
