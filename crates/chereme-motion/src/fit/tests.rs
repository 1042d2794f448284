//! Tests of fitting a skeleton to markers whose true movement is known, and of the reported oddities.

use super::*;
use crate::anatomy::tests::fixtures::{BodyVariation, PLAIN_BODY_VARIATION, fixture_body, fixture_joint_roles};
use crate::axes::SpaceConvention;
use crate::column::FrameNumberColumn;

/// Labels with the offsets of their markers from the table's places in metres, as on skin.
const SET: [(&str, [f64; 3]); 30] = [
    ("LFHD", [0.07, 0.12, 0.1]),
    ("RFHD", [-0.07, 0.12, 0.1]),
    ("LBHD", [0.07, 0.12, -0.1]),
    ("RBHD", [-0.07, 0.12, -0.1]),
    ("C7", [0.0, 0.0, -0.06]),
    ("CLAV", [0.0, -0.04, 0.08]),
    ("STRN", [0.0, 0.0, 0.12]),
    ("T10", [0.0, -0.02, -0.12]),
    ("LSHO", [0.01, 0.05, 0.0]),
    ("RSHO", [-0.01, 0.05, 0.0]),
    ("LUPA", [0.0, 0.04, 0.02]),
    ("RUPA", [0.0, 0.04, 0.03]),
    ("LELB", [0.01, 0.03, -0.03]),
    ("RELB", [-0.01, 0.03, -0.03]),
    ("LFRM", [0.0, 0.03, 0.01]),
    ("RFRM", [0.0, 0.03, 0.01]),
    ("LWRA", [0.0, 0.01, 0.03]),
    ("RWRA", [0.0, 0.01, 0.03]),
    ("LWRB", [0.0, 0.01, -0.03]),
    ("RWRB", [0.0, 0.01, -0.03]),
    ("LFIN", [0.0, 0.02, 0.0]),
    ("RFIN", [0.0, 0.02, 0.0]),
    ("LASI", [0.1, 0.05, 0.1]),
    ("RASI", [-0.1, 0.05, 0.1]),
    ("LPSI", [0.05, 0.06, -0.1]),
    ("RPSI", [-0.05, 0.06, -0.1]),
    ("LKNE", [0.05, 0.0, 0.02]),
    ("RKNE", [-0.05, 0.0, 0.02]),
    ("LANK", [0.04, 0.0, 0.0]),
    ("RANK", [-0.04, 0.0, 0.0]),
];

/// Returns the markers and joint positions of a body of another size that makes a step and raises an arm, whose left
/// forearm is turned about itself by some `rolled` radians.
fn capture(size: f64, frames: usize, rolled: f64) -> (MarkerTrack, Vec<ModelPose>, BodyAnatomy) {
    let skeleton = scaled_skeleton(&fixture_body(PLAIN_BODY_VARIATION), size).expect("a body");
    let anatomy = BodyAnatomy::with_roles(&skeleton, &fixture_joint_roles(&skeleton)).expect("a body");
    let rest = skeleton.rest_model_pose();
    let joint = |part| anatomy.part_joint(part).expect("a joint");
    let models: Vec<ModelPose> = (0..frames)
        .map(|frame| {
            let t = frame as f64 / 25.0;
            let mut pose = skeleton.rest_pose();
            let turn = |angle: f64| DQuat::from_rotation_z(angle);
            pose.translations[0] += DVec3::new(1.0, 0.0, 0.3 * t);
            pose.rotations[0] = DQuat::from_rotation_y(2.0 + 0.2 * t);
            pose.rotations[joint(BodyPart::UpperArm(BodySide::Left))] = turn(-1.2 + 0.5 * t);
            pose.rotations[joint(BodyPart::UpperArm(BodySide::Right))] = turn(1.2);
            pose.rotations[joint(BodyPart::Forearm(BodySide::Left))] =
                DQuat::from_rotation_y(-0.6 - 0.5 * (2.0 * t).sin())
                    * DQuat::from_rotation_x(rolled + 0.3 * (4.0 * t).sin());
            pose.rotations[joint(BodyPart::Head)] = DQuat::from_rotation_y(0.3 * (3.0 * t).sin());
            ModelPose::from_local_pose(&skeleton, &pose)
        })
        .collect();
    let points = SET.iter().map(|(name, offset)| {
        let label = find_marker_attachment(name).expect(name);
        let (on, place) = anchored(label, &rest, &skeleton, &anatomy).expect(name);
        let place = place + rest.model_joint_rotation(on).inverse() * DVec3::from(*offset);
        let at = |axis: usize| {
            let value = |model: &ModelPose| model.joint_point_to_model(on, place)[axis];
            FrameNumberColumn::from_double_floats(models.iter().map(value).collect())
        };
        MotionMarker::new(format!("Anna:{name}"), vec![at(0), at(1), at(2)])
    });
    let times = FrameTimes::Even(FrameRate::new(25, 1).expect("a rate"));
    let markers = MarkerTrack::new(
        times,
        MarkerSpace::World(SpaceConvention::MODEL_CONVENTION),
        points.collect(),
    );
    (markers.expect("a track"), models, anatomy)
}

#[test]
fn a_skeleton_of_another_size_and_rest_posture_follows_markers() {
    let (markers, truth, anatomy) = capture(1.08, 40, 0.0);
    let other = fixture_body(BodyVariation {
        lowered: 0.5,
        ..PLAIN_BODY_VARIATION
    });
    let own = BodyAnatomy::with_roles(&other, &fixture_joint_roles(&other)).expect("a body");
    let fitted = fit_skeleton(&markers, &other, &own, None).expect("a fit");
    assert!(fitted.unused.is_empty() && fitted.held == 0);
    assert!((fitted.scale - 1.08).abs() < 0.12, "{}", fitted.scale);
    assert!(fitted.median_marker_distance() < 0.012, "{:?}", fitted.markers);
    for part in [
        BodyPart::Hand(BodySide::Left),
        BodyPart::Forearm(BodySide::Right),
        BodyPart::Head,
    ] {
        let (a, b) = (anatomy.part_joint(part), own.part_joint(part));
        let (a, b) = (a.expect("a joint"), b.expect("a joint"));
        for frame in [0, 20, 39] {
            let is = fitted.clip.model_pose(frame).model_joint_position(b);
            let off = is.distance(truth[frame].model_joint_position(a));
            assert!(off < 0.08, "{part} in frame {frame} is {off:.3} m off");
        }
    }
}

/// Returns the median angle of a side's palms to the true ones, in degrees.
fn palms_off(fitted: &FittedSkeleton, own: &BodyAnatomy, truth: &[ModelPose], anatomy: &BodyAnatomy) -> [f64; 2] {
    BodySide::BOTH_SIDES.map(|side| {
        let off = truth.iter().enumerate().map(|(frame, truth)| {
            let palm = own.palm_normal(side, &fitted.clip.model_pose(frame));
            let truth = anatomy.palm_normal(side, truth).expect("a palm");
            palm.expect("a palm").angle_between(truth).to_degrees()
        });
        median_of_values(off.collect())
    })
}

#[test]
fn palms_follow_the_sides_of_the_wrist_markers() {
    let other = fixture_body(BodyVariation {
        lowered: 0.5,
        ..PLAIN_BODY_VARIATION
    });
    let own = BodyAnatomy::with_roles(&other, &fixture_joint_roles(&other)).expect("a body");
    for rolled in [-1.5, -0.8, 0.0, 0.8, 1.5] {
        let (markers, truth, anatomy) = capture(1.0, 30, rolled);
        let fitted = fit_skeleton(&markers, &other, &own, None).expect("a fit");
        let off = palms_off(&fitted, &own, &truth, &anatomy);
        assert!(off.iter().all(|it| *it < 10.0), "rolled {rolled}: {off:?}");
        assert_eq!(fitted.unturned, []);

        let exchanged = markers.marker_points().iter().map(|point| MotionMarker {
            name: match point.name.as_str() {
                "Anna:LWRA" => "Anna:LWRB".to_owned(),
                "Anna:LWRB" => "Anna:LWRA".to_owned(),
                name => name.to_owned(),
            },
            ..point.clone()
        });
        let exchanged = MarkerTrack::new(
            markers.marker_times().clone(),
            *markers.marker_space(),
            exchanged.collect(),
        );
        let turned = fit_skeleton(&exchanged.expect("a track"), &other, &own, None).expect("a fit");
        let off = palms_off(&turned, &own, &truth, &anatomy);
        let [right, left] = off;
        assert!(left > 150.0 && right < 10.0, "rolled {rolled}: {off:?}");
    }
}

#[test]
fn a_forearm_without_both_wrist_markers_is_reported() {
    let (markers, ..) = capture(1.0, 4, 0.0);
    let skeleton = fixture_body(PLAIN_BODY_VARIATION);
    let anatomy = BodyAnatomy::with_roles(&skeleton, &fixture_joint_roles(&skeleton)).expect("a body");
    let cases: [(&[&str], &[BodySide]); 3] = [
        (&["Anna:LWRA"], &[BodySide::Left]),
        (&["Anna:RWRB"], &[BodySide::Right]),
        (
            &["Anna:LWRA", "Anna:LWRB", "Anna:RWRA"],
            &[BodySide::Right, BodySide::Left],
        ),
    ];
    for (missing, unturned) in cases {
        let points = markers.marker_points().iter();
        let points = points.filter(|it| !missing.contains(&it.name.as_str()));
        let fewer = MarkerTrack::new(
            markers.marker_times().clone(),
            *markers.marker_space(),
            points.cloned().collect(),
        );
        let fitted = fit_skeleton(&fewer.expect("a track"), &skeleton, &anatomy, None).expect("a fit");
        assert_eq!(fitted.unturned, unturned, "{missing:?}");
    }
}

#[test]
fn the_markers_of_two_people_are_refused_and_a_few_of_another_are_not_used() {
    let (markers, ..) = capture(1.0, 4, 0.0);
    let skeleton = fixture_body(PLAIN_BODY_VARIATION);
    let anatomy = BodyAnatomy::with_roles(&skeleton, &fixture_joint_roles(&skeleton)).expect("a body");
    let named = |subject: &str, group: &str, label: &str| match subject {
        "" => (group.to_owned(), label.to_owned()),
        _ => (group.to_owned(), format!("{subject}:{label}")),
    };
    // The subject and group of a second person, the number of its markers, and the people or the unused markers.
    let cases: [(&str, &str, usize, Result<usize, &str>); 5] = [
        ("Bob", "", 20, Err("Bob")),
        ("", "Bob", 20, Err("Bob")),
        ("", "", 20, Err("(no name)")),
        ("Bob", "", 5, Ok(5)),
        ("Bob", "", 0, Ok(0)),
    ];
    for (subject, group, count, expected) in cases {
        let second = markers.marker_points().iter().zip(SET).take(count);
        let second = second.map(|(point, (label, _))| {
            let (group, name) = named(subject, group, label);
            MotionMarker {
                group,
                name,
                place: point.place.clone(),
                quality: None,
            }
        });
        let points = markers.marker_points().iter().cloned().chain(second).collect();
        let track = MarkerTrack::new(markers.marker_times().clone(), *markers.marker_space(), points);
        let fitted = fit_skeleton(&track.expect("a track"), &skeleton, &anatomy, None);
        match (fitted, expected) {
            (Ok(fitted), Ok(unused)) => assert_eq!(fitted.unused.len(), unused),
            (Err(FitError::People(names)), Err(second)) => assert_eq!(names, ["Anna", second]),
            (found, expected) => panic!("{expected:?}: {found:?}"),
        }
    }
    // Two parts of one body may have names of their own.
    let points = markers.marker_points().iter().zip(SET).map(|(point, (label, _))| {
        let part = if label.starts_with('L') { "Left" } else { "Rest" };
        MotionMarker {
            name: format!("{part}:{label}"),
            ..point.clone()
        }
    });
    let track = MarkerTrack::new(
        markers.marker_times().clone(),
        *markers.marker_space(),
        points.collect(),
    );
    let fitted = fit_skeleton(&track.expect("a track"), &skeleton, &anatomy, None).expect("a fit");
    assert_eq!(fitted.markers.len(), SET.len());
}

#[test]
fn one_of_several_people_is_fitted_by_name() {
    let (markers, ..) = capture(1.0, 4, 0.0);
    let skeleton = fixture_body(PLAIN_BODY_VARIATION);
    let anatomy = BodyAnatomy::with_roles(&skeleton, &fixture_joint_roles(&skeleton)).expect("a body");
    // The group and prefix of the second person's labels, who stands a metre beside the first, and the name of the person.
    let cases = [
        ("", "Ben:", "Ben", "Ben:LSHO"),
        ("", "Ben_", "Ben", "Ben_LSHO"),
        ("", "Room:Ben:", "Room:Ben", "Room:Ben:LSHO"),
        ("Ben", "", "Ben", "Ben:LSHO"),
        ("", "", "(no name)", "LSHO"),
    ];
    for (group, prefix, name, shoulder) in cases {
        let second = markers.marker_points().iter().zip(SET).map(|(point, (label, _))| {
            let x = (0..4).map(|frame| point.place[0].column_value_at(frame).map_or(f64::NAN, |x| x + 1.0));
            let x = FrameNumberColumn::from_double_floats(x.collect());
            MotionMarker {
                group: group.to_owned(),
                name: format!("{prefix}{label}"),
                place: vec![x, point.place[1].clone(), point.place[2].clone()],
                quality: None,
            }
        });
        let points = markers.marker_points().iter().cloned().chain(second).collect();
        let track = MarkerTrack::new(markers.marker_times().clone(), *markers.marker_space(), points);
        let track = track.expect("a track");
        let fitted = |subject| fit_skeleton(&track, &skeleton, &anatomy, subject);
        let (anna, ben) = (fitted(Some("Anna")), fitted(Some(name)));
        let (anna, ben) = (anna.expect("a fit"), ben.expect("a fit"));
        let x = |fitted: &FittedSkeleton| fitted.clip.model_pose(2).model_joint_position(0).x;
        assert!((x(&ben) - x(&anna) - 1.0).abs() < 0.02, "{name}");
        assert!(ben.markers.iter().any(|it| it.name == shoulder), "{name}");
        for fitted in [anna, ben] {
            assert!(fitted.median_marker_distance() < 0.012 && fitted.unused.is_empty());
            assert_eq!((fitted.markers.len(), fitted.others), (30, 30), "{name}");
        }
        assert_eq!(
            fitted(Some("Cleo")),
            Err(FitError::Subject {
                wanted: "Cleo".to_owned(),
                known: if name < "Anna" {
                    vec![name.to_owned(), "Anna".to_owned()]
                } else {
                    vec!["Anna".to_owned(), name.to_owned()]
                },
            })
        );
    }
}

#[test]
fn a_wrong_unit_shows_in_the_stature_and_places_at_nought_are_not_seen() {
    let (markers, ..) = capture(1.0, 4, 0.0);
    let skeleton = fixture_body(PLAIN_BODY_VARIATION);
    let anatomy = BodyAnatomy::with_roles(&skeleton, &fixture_joint_roles(&skeleton)).expect("a body");
    let own = anatomy.anatomy_measures().expect("a body").stature;
    for (unit, scale) in [(1.0, 1.0), (0.001, FIT_SCALE_LIMITS[0]), (25.4, FIT_SCALE_LIMITS[1])] {
        let convention = SpaceConvention {
            metres_per_unit: unit,
            ..SpaceConvention::MODEL_CONVENTION
        };
        let track = MarkerTrack::new(
            markers.marker_times().clone(),
            MarkerSpace::World(convention),
            markers.marker_points().to_vec(),
        );
        let fitted = fit_skeleton(&track.expect("a track"), &skeleton, &anatomy, None).expect("a fit");
        assert!((fitted.stature / (unit * own) - 1.0).abs() < 0.15);
        assert!((fitted.scale / scale - 1.0).abs() < 0.15);
    }
    let points = markers.marker_points().iter().map(|point| {
        let column = |column: &FrameNumberColumn| {
            let numbers = (0..4).map(|frame| match frame {
                1 => 0.0,
                _ => column.column_value_at(frame).unwrap_or(f64::NAN),
            });
            FrameNumberColumn::from_double_floats(numbers.collect())
        };
        let is_left = point.name.contains(":L");
        MotionMarker {
            place: match is_left {
                true => point.place.iter().map(column).collect(),
                false => point.place.clone(),
            },
            ..point.clone()
        }
    });
    let track = MarkerTrack::new(
        markers.marker_times().clone(),
        *markers.marker_space(),
        points.collect(),
    );
    let fitted = fit_skeleton(&track.expect("a track"), &skeleton, &anatomy, None).expect("a fit");
    for marker in &fitted.markers {
        let seen = if marker.name.contains(":L") { 0.75 } else { 1.0 };
        assert_eq!(marker.seen, seen, "{}", marker.name);
    }
    assert!(fitted.median_marker_distance() < 0.012);
}

#[test]
fn unknown_labels_gaps_and_films_are_reported() {
    let (markers, ..) = capture(1.0, 4, 0.0);
    let skeleton = fixture_body(PLAIN_BODY_VARIATION);
    let anatomy = BodyAnatomy::with_roles(&skeleton, &fixture_joint_roles(&skeleton)).expect("a body");
    let renamed: Vec<MotionMarker> = markers
        .marker_points()
        .iter()
        .enumerate()
        .map(|(n, point)| MotionMarker {
            name: if n < 5 { point.name.clone() } else { format!("Q{n}") },
            ..point.clone()
        })
        .collect();
    let renamed = MarkerTrack::new(markers.marker_times().clone(), *markers.marker_space(), renamed);
    let few = fit_skeleton(&renamed.expect("a track"), &skeleton, &anatomy, None);
    assert!(matches!(few, Err(FitError::Few { known: 5, .. })), "{few:?}");
    let gaps: Vec<MotionMarker> = markers
        .marker_points()
        .iter()
        .map(|point| MotionMarker {
            place: vec![FrameNumberColumn::from_double_floats(vec![f64::NAN; 4]); 3],
            ..point.clone()
        })
        .collect();
    let gaps = MarkerTrack::new(markers.marker_times().clone(), *markers.marker_space(), gaps);
    let gaps = fit_skeleton(&gaps.expect("a track"), &skeleton, &anatomy, None);
    assert!(matches!(gaps, Err(FitError::Gaps(_))), "{gaps:?}");
    assert_eq!(
        find_marker_attachment("TakeoMonday:LWRA"),
        find_marker_attachment("l.wra")
    );
    assert_eq!(find_marker_attachment("CentreOfMass"), None);
}
