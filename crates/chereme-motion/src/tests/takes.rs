//! Golden tables of takes: their ends, what happens between them, and skeletons that follow markers.

use std::sync::Arc;

use glam::{DQuat, DVec3};

use super::{dressed, list, milli, signing, take, turned, usual_take};
use crate::anatomy::HandRange;
use crate::anatomy::tests::fixtures::{BodyVariation, PLAIN_BODY_VARIATION};
use crate::column::FrameNumberColumn;
use crate::ends::{ClipEnds, activity_frames};
use crate::golden::{LITTLE, compare, compare_to, put};
use crate::markers::PointPictureSize;
use crate::{
    AxisDirection, BodyAnatomy, BodyPart, BodySide, Clip, CurveTrack, FrameRate, FrameTimes, LocalPose, MarkerSpace,
    MarkerTrack, ModelPose, MotionMarker, QualityMeaning, RecordingInstant, ScalarCurve, SignerAxes, Skeleton,
    SpaceAxis, SpaceConvention,
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

fn posture(skeleton: &Skeleton, anatomy: &BodyAnatomy, doing: Doing, at: f64) -> LocalPose {
    let mut pose = skeleton.rest_pose();
    for side in BodySide::BOTH_SIDES {
        let own = side.side_sign();
        let mut turn = |part: BodyPart, by: DQuat| {
            let joint = anatomy.part_joint(part).expect("a joint");
            pose.rotations[joint] *= by;
        };
        let (lowered, bent) = match doing {
            Doing::Hang => (1.45, 0.1),
            Doing::Wait => (1.4, 1.4),
            Doing::Sign => (0.9 + 0.3 * (5.0 * at).sin(), 1.6 + 0.4 * (4.0 * at).cos()),
            Doing::Tee => (0.05, 0.02),
            Doing::Bind => continue,
        };
        turn(BodyPart::UpperArm(side), DQuat::from_rotation_z(-own * lowered));
        turn(BodyPart::Forearm(side), DQuat::from_rotation_y(-own * bent));
    }
    pose
}

/// Returns a clip of stretches of frames; between two of them the posture changes within 8 frames.
fn staged(stages: &[(Doing, usize)], rate: u32) -> (Clip, BodyAnatomy) {
    let (skeleton, anatomy) = dressed(PLAIN_BODY_VARIATION);
    let mut poses: Vec<LocalPose> = Vec::new();
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
    let rate = FrameRate::new(rate, 1).expect("a rate");
    let clip = Clip::from_poses(skeleton, rate, &poses).expect("a clip");
    (clip, anatomy)
}

fn ended(out: &mut String, name: &str, clip: &Clip, anatomy: &BodyAnatomy) {
    let ends = ClipEnds::examine_clip_ends(clip, anatomy);
    put(
        out,
        format!(
            "{name}: sound {:?} active {:?}",
            ends.sound,
            activity_frames(clip, anatomy)
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
        ("short waits", &[(Doing::Wait, 9), (Doing::Sign, 60), (Doing::Wait, 9)]),
        (
            "T-poses",
            &[(Doing::Tee, 20), (Doing::Hang, 30), (Doing::Sign, 60), (Doing::Tee, 25)],
        ),
        ("a bind pose", &[(Doing::Bind, 3), (Doing::Hang, 30), (Doing::Sign, 50)]),
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
    let arm = anatomy.part_joint(BodyPart::UpperArm(BodySide::Left)).expect("an arm");
    for frames in [0..1, 0..12, 5..6, 128..140, 139..140, 120..121, 60..61] {
        for (name, far, turn, swing) in [
            ("far", 3.0, 0.0, 0.0),
            ("a little", 0.45, 0.7, 0.1),
            ("about", 0.0, 2.5, 0.0),
            ("arm", 0.0, 0.0, 1.2),
        ] {
            let mut channels = clip.joint_channels().to_vec();
            for frame in frames.clone() {
                channels[0].rotations[frame] *= DQuat::from_rotation_y(turn);
                channels[arm].rotations[frame] *= DQuat::from_rotation_y(swing);
                if let Some(places) = &mut channels[0].translations {
                    places[frame].z += far;
                }
            }
            let broken = Clip::new(Arc::clone(clip.clip_skeleton()), clip.clip_frame_rate(), channels);
            let broken = broken.expect("a clip");
            ended(&mut out, &format!("{frames:?} {name}"), &broken, &anatomy);
        }
    }
    compare("ends", &out);
}

/// Returns sums over all joints of a posture, so that a change of any joint shows.
fn summed(skeleton: &Skeleton, pose: &LocalPose) -> String {
    let model = ModelPose::from_local_pose(skeleton, pose);
    let places: DVec3 = model
        .model_joint_positions()
        .iter()
        .enumerate()
        .map(|(n, at)| *at * (1.0 + n as f64 / 10.0))
        .sum();
    let turns: f64 = model
        .model_joint_rotations()
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
    let skeleton = clip.clip_skeleton();
    put(&mut out, format!("## frames of {:?}", clip.clip_span()));
    for seconds in [-0.3, 0.0, 0.013, 0.02, 0.395, 0.779, 0.78, 2.0] {
        let pose = clip.sample_pose(RecordingInstant::from_seconds(seconds));
        put(&mut out, format!("{seconds} s: {}", summed(skeleton, &pose)));
    }
    for (frames, per) in [(25, 1), (120, 1), (30_000, 1001), (50, 1), (7, 1)] {
        let rate = FrameRate::new(frames, per).expect("a rate");
        let other = clip.resample_clip(rate);
        let last = other.clip_pose_at(other.clip_frame_count() - 1);
        put(
            &mut out,
            format!(
                "{frames}/{per}: {} frames, {:?}, last {}",
                other.clip_frame_count(),
                other.clip_span(),
                summed(skeleton, &last)
            ),
        );
    }
    for range in [0..40, 3..9, 35..90, 50..60] {
        let cut = clip.slice_clip_frames(range.clone());
        let first = (cut.clip_frame_count() > 0).then(|| summed(skeleton, &cut.clip_pose_at(0)));
        put(&mut out, format!("{range:?}: {} {first:?}", cut.clip_frame_count()));
    }
    let hand = anatomy.part_joint(BodyPart::Hand(BodySide::Right)).expect("a hand");
    let path: Vec<String> = clip.joint_path(hand).into_iter().step_by(8).map(milli).collect();
    put(&mut out, format!("path {}", path.join(" | ")));
    let still = Clip::from_rest_pose(Arc::clone(skeleton), clip.clip_frame_rate(), 2);
    put(&mut out, format!("still {}", summed(skeleton, &still.clip_pose_at(1))));
    put(&mut out, "## other axes");
    let up = AxisDirection {
        axis: SpaceAxis::Z,
        negative: false,
    };
    let left = AxisDirection {
        axis: SpaceAxis::Y,
        negative: true,
    };
    let convention = SpaceConvention {
        metres_per_unit: 0.01,
        axes: SignerAxes::new(up, left).expect("axes"),
    };
    let (there, back) = (convention.clip_back(&clip), convention.file_clip_to_model(&clip));
    for other in [&there, &back, &convention.file_clip_to_model(&there)] {
        put(&mut out, summed(other.clip_skeleton(), &other.clip_pose_at(7)));
    }
    put(
        &mut out,
        summed(&convention.file_skeleton_to_model(skeleton), &skeleton.rest_pose()),
    );
    let model = clip.model_pose(5);
    let local = model.to_local(skeleton);
    put(&mut out, format!("local {}", summed(skeleton, &local)));
    put(
        &mut out,
        format!(
            "point {}",
            milli(model.joint_point_to_model(hand, DVec3::new(0.1, 0.02, 0.03)))
        ),
    );
    put(&mut out, "## hands of a take");
    for step in [1, 3] {
        let mut range = HandRange::default();
        range.observe_clip_frames(&clip, &anatomy, BodySide::Left, step);
        put(&mut out, format!("every {step}: {} frames", range.posture_count()));
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
        FrameNumberColumn::from_double_floats(values.collect())
    };
    let even = || FrameTimes::Even(FrameRate::new(25, 1).expect("a rate"));
    let listed = || {
        let times = [0.0, 0.04, 0.1, 0.13, 0.2, 0.24, 0.3, 0.31, 0.4];
        FrameTimes::from_listed_seconds(FrameNumberColumn::from_double_floats(times.to_vec())).expect("times")
    };
    for times in [even(), listed()] {
        let curves = CurveTrack::new(
            times.clone(),
            vec![ScalarCurve::new("a", column(0.3)), ScalarCurve::new("b", column(0.9))],
        )
        .expect("curves");
        put(&mut out, format!("## curves over {:?}", curves.curve_track_span()));
        for seconds in [-0.1, 0.0, 0.01, 0.03, 0.125, 0.15, 0.17, 0.19, 0.305, 0.32, 0.41] {
            let found = curves.sample_curves(RecordingInstant::from_seconds(seconds));
            put(&mut out, format!("{seconds}: {found:?}"));
        }
    }
    let frame = PointPictureSize {
        width: 640.0,
        height: 480.0,
    };
    let up = AxisDirection {
        axis: SpaceAxis::Z,
        negative: false,
    };
    let left = AxisDirection {
        axis: SpaceAxis::X,
        negative: true,
    };
    let world = SpaceConvention {
        metres_per_unit: 0.001,
        axes: SignerAxes::new(up, left).expect("axes"),
    };
    for (space, count) in [
        (MarkerSpace::World(world), 3),
        (MarkerSpace::Image(frame), 2),
        (MarkerSpace::Depth(frame), 3),
    ] {
        let place = |step: f64| (0..count).map(|n| column(step + f64::from(n))).collect();
        let points = vec![MotionMarker::new("p", place(0.2)), MotionMarker::new("q", place(0.7))];
        let markers = MarkerTrack::new(even(), space, points).expect("markers");
        put(
            &mut out,
            format!(
                "## {} {} {:?}",
                space.marker_space_name(),
                space.space_coordinate_count(),
                markers.marker_track_span()
            ),
        );
        for seconds in [0.0, 0.09, 0.16, 0.35, 0.5] {
            let instant = RecordingInstant::from_seconds(seconds);
            let frame = markers
                .marker_times()
                .shown_frame_at(instant, markers.marker_frame_count());
            let found = frame.map_or(vec![None; markers.marker_points().len()], |at| {
                markers.displayed_markers(at)
            });
            let found: Vec<Option<String>> = found.into_iter().map(|it| it.map(milli)).collect();
            put(&mut out, format!("{seconds}: {found:?}"));
        }
        let limbs: [Vec<[usize; 2]>; 3] = [vec![[0, 1]], vec![[0, 2]], vec![[1, 1]]];
        for limbs in limbs {
            let joined = markers
                .clone()
                .with_quality_meaning(QualityMeaning::Residual)
                .with_marker_limbs(limbs);
            let joined = joined.map(|it| {
                (
                    it.marker_limbs().to_vec(),
                    it.marker_quality().map(QualityMeaning::quality_meaning_name),
                )
            });
            put(&mut out, format!("{:?}", joined.map_err(|it| it.to_string())));
        }
    }
    compare("points_curves", &out);
}

#[test]
fn golden_skeletons_that_follow_markers() {
    let mut out = String::new();
    let (clip, anatomy) = take(
        BodyVariation {
            lowered: 0.2,
            ..PLAIN_BODY_VARIATION
        },
        30,
        FrameRate::new(25, 1).expect("a rate"),
    );
    let labels = [
        ("LFHD", BodyPart::Head, [0.07, 0.12, 0.1]),
        ("RFHD", BodyPart::Head, [-0.07, 0.12, 0.1]),
        ("LBHD", BodyPart::Head, [0.07, 0.12, -0.1]),
        ("RBHD", BodyPart::Head, [-0.07, 0.12, -0.1]),
        ("C7", BodyPart::Chest, [0.0, 0.2, -0.06]),
        ("CLAV", BodyPart::Chest, [0.0, 0.16, 0.08]),
        ("STRN", BodyPart::Chest, [0.0, 0.0, 0.12]),
        ("T10", BodyPart::Chest, [0.0, -0.02, -0.12]),
        ("LSHO", BodyPart::Clavicle(BodySide::Left), [0.15, 0.05, -0.02]),
        ("RSHO", BodyPart::Clavicle(BodySide::Right), [-0.15, 0.05, -0.02]),
        ("LELB", BodyPart::UpperArm(BodySide::Left), [0.27, -0.03, -0.03]),
        ("RELB", BodyPart::UpperArm(BodySide::Right), [-0.27, -0.03, -0.03]),
        ("LWRA", BodyPart::Forearm(BodySide::Left), [0.24, -0.02, 0.03]),
        ("RWRA", BodyPart::Forearm(BodySide::Right), [-0.24, -0.02, 0.03]),
        ("LWRB", BodyPart::Forearm(BodySide::Left), [0.25, -0.04, -0.03]),
        ("RWRB", BodyPart::Forearm(BodySide::Right), [-0.25, -0.04, -0.03]),
        ("LASI", BodyPart::Hips, [0.1, 0.05, 0.1]),
        ("RASI", BodyPart::Hips, [-0.1, 0.05, 0.1]),
        ("LPSI", BodyPart::Hips, [0.05, 0.06, -0.1]),
        ("RPSI", BodyPart::Hips, [-0.05, 0.06, -0.1]),
        ("LANK", BodyPart::Shin(BodySide::Left), [0.04, -0.42, 0.0]),
        ("RANK", BodyPart::Shin(BodySide::Right), [-0.04, -0.42, 0.0]),
        ("NOSE", BodyPart::Head, [0.0, 0.1, 0.15]),
    ];
    let models: Vec<ModelPose> = (0..clip.clip_frame_count()).map(|n| clip.model_pose(n)).collect();
    let points = labels.iter().enumerate().map(|(n, (label, part, place))| {
        let joint = anatomy.part_joint(*part).expect("a joint");
        let at = |axis: usize| {
            let value = |(frame, model): (usize, &ModelPose)| {
                // Every marker has a gap of its own; in three frames few are seen.
                let hidden = frame == n || ((12..15).contains(&frame) && n > 3);
                match hidden {
                    true => f64::NAN,
                    false => 1.05 * model.joint_point_to_model(joint, DVec3::from(*place))[axis],
                }
            };
            FrameNumberColumn::from_double_floats(models.iter().enumerate().map(value).collect())
        };
        MotionMarker::new(*label, vec![at(0), at(1), at(2)])
    });
    let markers = MarkerTrack::new(
        FrameTimes::Even(clip.clip_frame_rate()),
        MarkerSpace::World(SpaceConvention::MODEL_CONVENTION),
        points.collect(),
    )
    .expect("markers");
    let (skeleton, own) = dressed(PLAIN_BODY_VARIATION);
    let fitted = crate::fit::fit_skeleton(&markers, &skeleton, &own, None).expect("a fit");
    put(
        &mut out,
        format!(
            "scale {:?} held {} unused {:?} median {:?} mm",
            fitted.scale,
            fitted.held,
            fitted.unused,
            fitted.median_marker_distance() * 1e3
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
        for (part, joint, _) in own.found_parts() {
            if matches!(part, BodyPart::Finger(..) | BodyPart::Thumb(..)) {
                continue;
            }
            let (at, turn) = (model.model_joint_position(joint), model.model_joint_rotation(joint));
            put(&mut out, format!("{part} at {} turned {}", milli(at), turned(turn)));
        }
    }
    let signed = signing(&skeleton, &own, 0.0);
    put(&mut out, format!("truth {}", summed(&skeleton, &signed)));
    compare_to("fits", &out, LITTLE);
}
