//! Golden tables of takes: their ends, what happens between them, and skeletons that follow markers.

use std::sync::Arc;

use glam::{DQuat, DVec3};

use super::{dressed, list, milli, signing, take, turned, usual_take};
use crate::anatomy::HandRange;
use crate::anatomy::fixtures::{PLAIN, Wear};
use crate::column::Column;
use crate::ends::{Ends, activity};
use crate::golden::{LITTLE, compare, compare_to, put};
use crate::markers::Frame;
use crate::{
    Anatomy, Axes, Axis, Clip, Convention, Curve, Curves, Direction, Instant, Marker, Markers,
    ModelPose, Part, Pose, Quality, Rate, Side, Skeleton, Space, Times,
};

/// The hands of a posture hang, wait before the belly, sign, or are stretched out to both sides.
#[derive(Debug, Clone, Copy)]
enum Doing {
    Hang,
    Wait,
    Sign,
    Tee,
    Bind,
}

fn posture(skeleton: &Skeleton, anatomy: &Anatomy, doing: Doing, at: f64) -> Pose {
    let mut pose = skeleton.rest_pose();
    for side in Side::BOTH {
        let own = side.sign();
        let mut turn = |part: Part, by: DQuat| {
            let joint = anatomy.joint(part).expect("a joint");
            pose.rotations[joint] *= by;
        };
        let (lowered, bent) = match doing {
            Doing::Hang => (1.45, 0.1),
            Doing::Wait => (1.4, 1.4),
            Doing::Sign => (0.9 + 0.3 * (5.0 * at).sin(), 1.6 + 0.4 * (4.0 * at).cos()),
            Doing::Tee => (0.05, 0.02),
            Doing::Bind => continue,
        };
        turn(Part::UpperArm(side), DQuat::from_rotation_z(-own * lowered));
        turn(Part::Forearm(side), DQuat::from_rotation_y(-own * bent));
    }
    pose
}

/// Returns a clip of stretches of frames; between two of them the posture changes within 8 frames.
fn staged(stages: &[(Doing, usize)], rate: u32) -> (Clip, Anatomy) {
    let (skeleton, anatomy) = dressed(PLAIN);
    let mut poses: Vec<Pose> = Vec::new();
    for &(doing, frames) in stages {
        for n in 0..frames {
            let at = poses.len() as f64 / f64::from(rate);
            let mut pose = posture(&skeleton, &anatomy, doing, at);
            let before = poses.last().cloned();
            if let (Some(before), true) = (before, n < 8 && !matches!(doing, Doing::Sign)) {
                let share = (n + 1) as f64 / 8.0;
                let mixed = before.rotations.iter().zip(&pose.rotations);
                pose.rotations = mixed.map(|(a, b)| a.slerp(*b, share)).collect();
            }
            poses.push(pose);
        }
    }
    let rate = Rate::new(rate, 1).expect("a rate");
    let clip = Clip::from_poses(skeleton, rate, &poses).expect("a clip");
    (clip, anatomy)
}

fn ended(out: &mut String, name: &str, clip: &Clip, anatomy: &Anatomy) {
    let ends = Ends::of(clip, anatomy);
    put(
        out,
        format!(
            "{name}: sound {:?} active {:?}",
            ends.sound,
            activity(clip, anatomy)
        ),
    );
    for odd in &ends.odd {
        put(out, format!("  {odd}: {:?}", odd.what));
    }
}

#[test]
fn golden_ends_of_takes() {
    let mut out = String::new();
    let stages: [(&str, &[(Doing, usize)]); 10] = [
        (
            "rest, sign, rest",
            &[(Doing::Hang, 40), (Doing::Sign, 60), (Doing::Hang, 40)],
        ),
        (
            "waiting hands",
            &[(Doing::Wait, 40), (Doing::Sign, 60), (Doing::Wait, 40)],
        ),
        (
            "short waits",
            &[(Doing::Wait, 9), (Doing::Sign, 60), (Doing::Wait, 9)],
        ),
        (
            "T-poses",
            &[
                (Doing::Tee, 20),
                (Doing::Hang, 30),
                (Doing::Sign, 60),
                (Doing::Tee, 25),
            ],
        ),
        (
            "a bind pose",
            &[(Doing::Bind, 3), (Doing::Hang, 30), (Doing::Sign, 50)],
        ),
        (
            "a long bind pose",
            &[(Doing::Bind, 60), (Doing::Hang, 30), (Doing::Sign, 50)],
        ),
        ("nothing but rest", &[(Doing::Hang, 80)]),
        ("nothing but a T-pose", &[(Doing::Tee, 80)]),
        ("no rest", &[(Doing::Sign, 80)]),
        ("three frames", &[(Doing::Sign, 3)]),
    ];
    for rate in [25, 60] {
        put(&mut out, format!("## {rate} frames a second"));
        for (name, stages) in stages {
            let (clip, anatomy) = staged(stages, rate);
            ended(&mut out, name, &clip, &anatomy);
        }
    }
    put(&mut out, "## breaks");
    let (clip, anatomy) = staged(stages[0].1, 60);
    let arm = anatomy.joint(Part::UpperArm(Side::Left)).expect("an arm");
    for frames in [0..1, 0..12, 5..6, 128..140, 139..140, 120..121, 60..61] {
        for (name, far, turn, swing) in [
            ("far", 3.0, 0.0, 0.0),
            ("a little", 0.45, 0.7, 0.1),
            ("about", 0.0, 2.5, 0.0),
            ("arm", 0.0, 0.0, 1.2),
        ] {
            let mut channels = clip.channels().to_vec();
            for frame in frames.clone() {
                channels[0].rotations[frame] *= DQuat::from_rotation_y(turn);
                channels[arm].rotations[frame] *= DQuat::from_rotation_y(swing);
                if let Some(places) = &mut channels[0].translations {
                    places[frame].z += far;
                }
            }
            let broken = Clip::new(Arc::clone(clip.skeleton()), clip.rate(), channels);
            let broken = broken.expect("a clip");
            ended(&mut out, &format!("{frames:?} {name}"), &broken, &anatomy);
        }
    }
    compare("ends", &out);
}

/// Returns sums over all joints of a posture, so that a change of any joint shows.
fn summed(skeleton: &Skeleton, pose: &Pose) -> String {
    let model = ModelPose::of(skeleton, pose);
    let places: DVec3 = model
        .positions()
        .iter()
        .enumerate()
        .map(|(n, at)| *at * (1.0 + n as f64 / 10.0))
        .sum();
    let turns: f64 = model
        .rotations()
        .iter()
        .enumerate()
        .map(|(n, q)| q.angle_between(DQuat::from_rotation_x(0.1 * n as f64)))
        .sum();
    format!("places {} turns {turns:?}", milli(places / 100.0))
}

#[test]
fn golden_clips_cut_sampled_and_resampled() {
    let mut out = String::new();
    let (clip, anatomy) = usual_take(40);
    let skeleton = clip.skeleton();
    put(&mut out, format!("## frames of {:?}", clip.span()));
    for seconds in [-0.3, 0.0, 0.013, 0.02, 0.395, 0.779, 0.78, 2.0] {
        let pose = clip.sample(Instant::from_seconds(seconds));
        put(
            &mut out,
            format!("{seconds} s: {}", summed(skeleton, &pose)),
        );
    }
    for (frames, per) in [(25, 1), (120, 1), (30_000, 1001), (50, 1), (7, 1)] {
        let rate = Rate::new(frames, per).expect("a rate");
        let other = clip.resampled(rate);
        let last = other.pose(other.frames() - 1);
        put(
            &mut out,
            format!(
                "{frames}/{per}: {} frames, {:?}, last {}",
                other.frames(),
                other.span(),
                summed(skeleton, &last)
            ),
        );
    }
    for range in [0..40, 3..9, 35..90, 50..60] {
        let cut = clip.slice(range.clone());
        let first = (cut.frames() > 0).then(|| summed(skeleton, &cut.pose(0)));
        put(&mut out, format!("{range:?}: {} {first:?}", cut.frames()));
    }
    let hand = anatomy.joint(Part::Hand(Side::Right)).expect("a hand");
    let path: Vec<String> = clip.path(hand).into_iter().step_by(8).map(milli).collect();
    put(&mut out, format!("path {}", path.join(" | ")));
    let still = Clip::still(Arc::clone(skeleton), clip.rate(), 2);
    put(
        &mut out,
        format!("still {}", summed(skeleton, &still.pose(1))),
    );
    put(&mut out, "## other axes");
    let up = Direction {
        axis: Axis::Z,
        negative: false,
    };
    let left = Direction {
        axis: Axis::Y,
        negative: true,
    };
    let convention = Convention {
        metres_per_unit: 0.01,
        axes: Axes::new(up, left).expect("axes"),
    };
    let (there, back) = (convention.clip_back(&clip), convention.clip(&clip));
    for other in [&there, &back, &convention.clip(&there)] {
        put(&mut out, summed(other.skeleton(), &other.pose(7)));
    }
    put(
        &mut out,
        summed(&convention.skeleton(skeleton), &skeleton.rest_pose()),
    );
    let model = clip.model_pose(5);
    let local = model.to_local(skeleton);
    put(&mut out, format!("local {}", summed(skeleton, &local)));
    put(
        &mut out,
        format!(
            "point {}",
            milli(model.point(hand, DVec3::new(0.1, 0.02, 0.03)))
        ),
    );
    put(&mut out, "## hands of a take");
    for step in [1, 3] {
        let mut range = HandRange::default();
        range.observe(&clip, &anatomy, Side::Left, step);
        put(&mut out, format!("every {step}: {} frames", range.frames()));
    }
    compare("clips", &out);
}

#[test]
fn golden_points_and_curves_of_takes() {
    let mut out = String::new();
    let column = |step: f64| {
        let values = (0..9).map(|n| match n {
            4 => f64::NAN,
            _ => (f64::from(n) * step).sin(),
        });
        Column::doubles(values.collect())
    };
    let even = || Times::Even(Rate::new(25, 1).expect("a rate"));
    let listed = || {
        let times = [0.0, 0.04, 0.1, 0.13, 0.2, 0.24, 0.3, 0.31, 0.4];
        Times::listed(Column::doubles(times.to_vec())).expect("times")
    };
    for times in [even(), listed()] {
        let curves = Curves::new(
            times.clone(),
            vec![Curve::new("a", column(0.3)), Curve::new("b", column(0.9))],
        )
        .expect("curves");
        put(&mut out, format!("## curves over {:?}", curves.span()));
        for seconds in [
            -0.1, 0.0, 0.01, 0.03, 0.125, 0.15, 0.17, 0.19, 0.305, 0.32, 0.41,
        ] {
            let found = curves.sample(Instant::from_seconds(seconds));
            put(&mut out, format!("{seconds}: {found:?}"));
        }
    }
    let frame = Frame {
        width: 640.0,
        height: 480.0,
    };
    let up = Direction {
        axis: Axis::Z,
        negative: false,
    };
    let left = Direction {
        axis: Axis::X,
        negative: true,
    };
    let world = Convention {
        metres_per_unit: 0.001,
        axes: Axes::new(up, left).expect("axes"),
    };
    for (space, count) in [
        (Space::World(world), 3),
        (Space::Image(frame), 2),
        (Space::Depth(frame), 3),
    ] {
        let place = |step: f64| (0..count).map(|n| column(step + f64::from(n))).collect();
        let points = vec![Marker::new("p", place(0.2)), Marker::new("q", place(0.7))];
        let markers = Markers::new(even(), space, points).expect("markers");
        put(
            &mut out,
            format!(
                "## {} {} {:?}",
                space.name(),
                space.coordinates(),
                markers.span()
            ),
        );
        for seconds in [0.0, 0.09, 0.16, 0.35, 0.5] {
            let found = markers.shown_at(Instant::from_seconds(seconds));
            let found: Vec<Option<String>> = found.into_iter().map(|it| it.map(milli)).collect();
            put(&mut out, format!("{seconds}: {found:?}"));
        }
        let limbs: [Vec<[usize; 2]>; 3] = [vec![[0, 1]], vec![[0, 2]], vec![[1, 1]]];
        for limbs in limbs {
            let joined = markers.clone().rated(Quality::Residual).joined(limbs);
            let joined = joined.map(|it| (it.limbs().to_vec(), it.quality().map(Quality::name)));
            put(
                &mut out,
                format!("{:?}", joined.map_err(|it| it.to_string())),
            );
        }
    }
    compare("points_curves", &out);
}

#[test]
fn golden_skeletons_that_follow_markers() {
    let mut out = String::new();
    let (clip, anatomy) = take(
        Wear {
            lowered: 0.2,
            ..PLAIN
        },
        30,
        Rate::new(25, 1).expect("a rate"),
    );
    let labels = [
        ("LFHD", Part::Head, [0.07, 0.12, 0.1]),
        ("RFHD", Part::Head, [-0.07, 0.12, 0.1]),
        ("LBHD", Part::Head, [0.07, 0.12, -0.1]),
        ("RBHD", Part::Head, [-0.07, 0.12, -0.1]),
        ("C7", Part::Chest, [0.0, 0.2, -0.06]),
        ("CLAV", Part::Chest, [0.0, 0.16, 0.08]),
        ("STRN", Part::Chest, [0.0, 0.0, 0.12]),
        ("T10", Part::Chest, [0.0, -0.02, -0.12]),
        ("LSHO", Part::Clavicle(Side::Left), [0.15, 0.05, -0.02]),
        ("RSHO", Part::Clavicle(Side::Right), [-0.15, 0.05, -0.02]),
        ("LELB", Part::UpperArm(Side::Left), [0.27, -0.03, -0.03]),
        ("RELB", Part::UpperArm(Side::Right), [-0.27, -0.03, -0.03]),
        ("LWRA", Part::Forearm(Side::Left), [0.24, -0.02, 0.03]),
        ("RWRA", Part::Forearm(Side::Right), [-0.24, -0.02, 0.03]),
        ("LWRB", Part::Forearm(Side::Left), [0.25, -0.04, -0.03]),
        ("RWRB", Part::Forearm(Side::Right), [-0.25, -0.04, -0.03]),
        ("LASI", Part::Hips, [0.1, 0.05, 0.1]),
        ("RASI", Part::Hips, [-0.1, 0.05, 0.1]),
        ("LPSI", Part::Hips, [0.05, 0.06, -0.1]),
        ("RPSI", Part::Hips, [-0.05, 0.06, -0.1]),
        ("LANK", Part::Shin(Side::Left), [0.04, -0.42, 0.0]),
        ("RANK", Part::Shin(Side::Right), [-0.04, -0.42, 0.0]),
        ("NOSE", Part::Head, [0.0, 0.1, 0.15]),
    ];
    let models: Vec<ModelPose> = (0..clip.frames()).map(|n| clip.model_pose(n)).collect();
    let points = labels.iter().enumerate().map(|(n, (label, part, place))| {
        let joint = anatomy.joint(*part).expect("a joint");
        let at = |axis: usize| {
            let value = |(frame, model): (usize, &ModelPose)| {
                // Every marker has a gap of its own; in three frames few are seen.
                let hidden = frame == n || ((12..15).contains(&frame) && n > 3);
                match hidden {
                    true => f64::NAN,
                    false => 1.05 * model.point(joint, DVec3::from(*place))[axis],
                }
            };
            Column::doubles(models.iter().enumerate().map(value).collect())
        };
        Marker::new(*label, vec![at(0), at(1), at(2)])
    });
    let markers = Markers::new(
        Times::Even(clip.rate()),
        Space::World(Convention::MODEL),
        points.collect(),
    )
    .expect("markers");
    let (skeleton, own) = dressed(PLAIN);
    let fitted = crate::fit::fit(&markers, &skeleton, &own, None).expect("a fit");
    put(
        &mut out,
        format!(
            "scale {:?} held {} unused {:?} median {:?} mm",
            fitted.scale,
            fitted.held,
            fitted.unused,
            fitted.median() * 1e3
        ),
    );
    for marker in &fitted.markers {
        put(
            &mut out,
            format!(
                "{} on {} at {} seen {:?} median {:?} most {:?}: {}",
                marker.name,
                marker.joint,
                milli(marker.place),
                marker.seen,
                marker.median * 1e3,
                marker.most * 1e3,
                list(marker.distances.iter().step_by(5).map(|it| it * 1e3))
            ),
        );
    }
    for frame in [0, 11, 13, 22, 29] {
        let model = fitted.clip.model_pose(frame);
        put(&mut out, format!("## frame {frame}"));
        for (part, joint, _) in own.found() {
            if matches!(part, Part::Finger(..) | Part::Thumb(..)) {
                continue;
            }
            let (at, turn) = (model.position(joint), model.rotation(joint));
            put(
                &mut out,
                format!("{part} at {} turned {}", milli(at), turned(turn)),
            );
        }
    }
    let signed = signing(&skeleton, &own, 0.0);
    put(&mut out, format!("truth {}", summed(&skeleton, &signed)));
    compare_to("fits", &out, LITTLE);
}
