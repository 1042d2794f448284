//! Table of exactness: operators followed by their inverse, and the lengths of bones.

use chereme_compose::GeneratedMovement;
use chereme_motion::glam::DVec3;
use chereme_motion::{BodySide, Clip};

use crate::Result;
use crate::capture::Capture;
use crate::shelf::Shelf;
use crate::table::{markdown, small};

const HEAD: [&str; 8] = [
    "capture",
    "`reverse`, `reverse`",
    "`swap`, `swap`",
    "`mirror right`, `mirror right`",
    "`mirror right`, `swap`",
    "`place` there and back, frames in reach",
    "frames in reach",
    "bone lengths",
];

pub(crate) fn tables(captures: &[Capture]) -> Result<String> {
    let mut rows = Vec::new();
    for capture in captures {
        rows.push(row(capture)?);
    }
    Ok(format!(
        "### Operators taken back\n\nEach operator is made alone, on what the one before made: the \
         largest distance of a fingertip in metres, and the largest change of a bone's length.\n\n{}",
        markdown(&HEAD, rows)
    ))
}

fn row(capture: &Capture) -> Result<Vec<String>> {
    let (clip, both) = (&capture.clip, capture.sides().len() == 2);
    let source = Shelf::new(clip.clone(), &capture.anatomy);
    let after = |first: &str, second: &str| -> Result<[GeneratedMovement; 2]> {
        let one = source.make(first)?;
        let two = Shelf::new(one.clip.clone(), &one.anatomy).make(second)?;
        Ok([one, two])
    };
    let mut bones: f64 = 0.0;
    let mut cells = vec![capture.name.clone()];
    for (first, second, to_source) in [
        ("reverse", "reverse", true),
        ("swap", "swap", true),
        ("mirror right", "mirror right", false),
        ("mirror right", "swap", false),
    ] {
        if !both && first != "reverse" {
            cells.push("–".into());
            continue;
        }
        let [one, two] = after(first, second)?;
        let to = if to_source { clip } else { &one.clip };
        bones = bones.max(stretched(clip, &one.clip)).max(stretched(clip, &two.clip));
        let apart = fingertips(capture, to, &two.clip).into_iter();
        cells.push(small(apart.map(|(_, far)| far).fold(0.0, f64::max)));
    }
    let (mut worst, mut reached, mut all): (f64, usize, usize) = (0.0, 0, 0);
    for (there, back) in [("left", "right"), ("up", "down"), ("forward", "back")] {
        let hands = if both {
            "both"
        } else {
            capture.sides()[0].body_side_name()
        };
        let place = |direction: &str| format!("place {hands} by {direction} 10cm");
        let [one, two] = after(&place(there), &place(back))?;
        bones = bones.max(stretched(clip, &one.clip)).max(stretched(clip, &two.clip));
        let moved = moved(capture, &one.clip);
        for ((side, far), shift) in fingertips(capture, clip, &two.clip).into_iter().zip(moved) {
            all += usize::from(capture.anatomy.arm_chain(side).is_some());
            if (shift.length() - 0.1).abs() < 1e-6 {
                reached += 1;
                worst = worst.max(far);
            }
        }
    }
    cells.push(small(worst));
    cells.push(format!("{:.0} %", 100.0 * reached as f64 / all.max(1) as f64));
    cells.push(small(bones));
    Ok(cells)
}

/// Returns for each frame and side the largest distance between the ends of the same fingers, or
/// between the wrists of hands without fingers.
fn fingertips(capture: &Capture, a: &Clip, b: &Clip) -> Vec<(BodySide, f64)> {
    let skeleton = a.clip_skeleton();
    let mut found = Vec::new();
    for frame in 0..a.clip_frame_count() {
        let models = [a, b].map(|clip| clip.model_pose(frame));
        for side in capture.sides() {
            let mut joints = capture.anatomy.finger_joints(side);
            joints.extend(capture.anatomy.arm_chain(side).map(|arm| arm.hand));
            let far = joints.iter().map(|&joint| {
                let [a, b] = models.each_ref().map(|m| {
                    m.bone_tip_position(skeleton, joint)
                        .unwrap_or(m.model_joint_position(joint))
                });
                a.distance(b)
            });
            found.push((side, far.fold(0.0, f64::max)));
        }
    }
    found
}

/// Returns the displacement of the wrist for each frame and side.
fn moved(capture: &Capture, made: &Clip) -> Vec<DVec3> {
    let hands: Vec<usize> = capture
        .sides()
        .into_iter()
        .filter_map(|side| capture.anatomy.arm_chain(side))
        .map(|arm| arm.hand)
        .collect();
    (0..made.clip_frame_count())
        .flat_map(|frame| {
            let [was, is] = [&capture.clip, made].map(|clip| clip.model_pose(frame));
            let shift = move |hand: usize| is.model_joint_position(hand) - was.model_joint_position(hand);
            hands.iter().copied().map(shift).collect::<Vec<DVec3>>()
        })
        .collect()
}

/// Returns the largest change of a bone's length.
fn stretched(was: &Clip, is: &Clip) -> f64 {
    let skeleton = was.clip_skeleton();
    let mut worst: f64 = 0.0;
    for frame in 0..was.clip_frame_count().min(is.clip_frame_count()) {
        // A reversed or mirrored clip has the bones of other frames if joints also move.
        let models = [was, is].map(|clip| clip.model_pose(frame));
        for joint in 1..skeleton.len() {
            let Some(parent) = skeleton.joint_parent(joint) else {
                continue;
            };
            if was.joint_channel(joint).translations.is_some() {
                continue;
            }
            let [a, b] = models
                .each_ref()
                .map(|m| m.model_joint_position(joint).distance(m.model_joint_position(parent)));
            worst = worst.max((a - b).abs());
        }
    }
    worst
}
