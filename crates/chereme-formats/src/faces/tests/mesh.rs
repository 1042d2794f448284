//! Faces as points on film, and weights fitted to a person.

use chereme_motion::markers::PointPictureSize;
use chereme_motion::{FacePosture, FrameNumberColumn, FrameRate, FrameTimes, MarkerSpace, MarkerTrack, MotionMarker};

use super::{DerivedFaceView, FaceCalibration, FaceMesh, FaceSystem};

/// The activity of a drawn face in one frame.
#[derive(Clone, Copy, Default)]
struct Drawn {
    brow: f64,
    lid: f64,
    mouth: f64,
    roll: f64,
    turn: f64,
}

/// Returns the points of a face 100 pixels wide between the corners of the eyes, as MediaPipe numbers them.
fn points(drawn: Drawn) -> Vec<(&'static str, [f64; 2])> {
    let Drawn {
        brow,
        lid,
        mouth,
        roll,
        turn,
    } = drawn;
    let up = 27.0 * (1.0 + brow);
    let gap = 9.0 * (1.0 - lid);
    let nose = 50.0 * turn.tan();
    let all = [
        ("33", [-50.0, 0.0]),
        ("263", [50.0, 0.0]),
        ("133", [-20.0, 0.0]),
        ("362", [20.0, 0.0]),
        ("159", [-35.0, gap / 2.0]),
        ("145", [-35.0, -gap / 2.0]),
        ("386", [35.0, gap / 2.0]),
        ("374", [35.0, -gap / 2.0]),
        ("105", [-35.0, up]),
        ("334", [35.0, up]),
        ("107", [-12.0, up]),
        ("336", [12.0, up]),
        ("1", [nose, -45.0]),
        ("61", [-25.0, -75.0]),
        ("291", [25.0, -75.0]),
        ("13", [0.0, -75.0 + mouth / 2.0]),
        ("14", [0.0, -75.0 - mouth / 2.0]),
        ("468", [-35.0, 0.0]),
        ("473", [35.0, 0.0]),
    ];
    let turned = |[x, y]: [f64; 2]| {
        let (sin, cos) = roll.sin_cos();
        [400.0 + x * cos - y * sin, 300.0 - (x * sin + y * cos)]
    };
    all.into_iter().map(|(name, at)| (name, turned(at))).collect()
}

fn markers(frames: &[Drawn]) -> MarkerTrack {
    let drawn: Vec<_> = frames.iter().map(|it| points(*it)).collect();
    let point = |at: usize| {
        let axis = |axis: usize| drawn.iter().map(|frame| frame[at].1[axis]).collect();
        MotionMarker {
            group: "FACE_LANDMARKS".to_owned(),
            ..MotionMarker::new(
                drawn[0][at].0,
                vec![
                    FrameNumberColumn::from_double_floats(axis(0)),
                    FrameNumberColumn::from_double_floats(axis(1)),
                ],
            )
        }
    };
    let picture = MarkerSpace::Image(PointPictureSize {
        width: 800.0,
        height: 600.0,
    });
    let times = FrameTimes::Even(FrameRate::new(25, 1).expect("a rate"));
    MarkerTrack::new(times, picture, (0..drawn[0].len()).map(point).collect()).expect("a track")
}

fn view(markers: &MarkerTrack) -> DerivedFaceView {
    let named = markers.marker_points().iter();
    let mesh = FaceMesh::find_face_mesh(named.map(|it| (it.group.as_str(), it.name.as_str())));
    let mesh = mesh.expect("a face");
    let curves = FaceMesh::face_measure_curves(markers.marker_times().clone(), &mesh.measure_face_frames(markers));
    let system = FaceSystem::find_face_system("mesh").expect("a system");
    assert_eq!(
        FaceSystem::system_of_curves(curves.as_ref().expect("curves")),
        Some(system)
    );
    system.derive_face_view(&curves.expect("curves"))
}

#[test]
fn points_of_a_face_become_brows_lids_mouth_and_turns() {
    let still = Drawn::default();
    let mut frames = vec![still; 40];
    frames[10] = Drawn { brow: 0.21, ..still };
    frames[11] = Drawn { brow: -0.3, ..still };
    frames[12] = Drawn { lid: 1.0, ..still };
    frames[13] = Drawn { mouth: 40.0, ..still };
    frames[14] = Drawn { turn: 0.3, ..still };
    frames[15] = Drawn { roll: 0.2, ..still };
    frames[16] = Drawn {
        brow: 0.21,
        roll: 0.2,
        ..still
    };
    let view = view(&markers(&frames));
    let near = |a: f64, b: f64| assert!((a - b).abs() < 0.02, "{a} {b}");
    assert!(view.faces[0].face_numbers().iter().all(|it| it.abs() < 1e-9));
    near(view.faces[10].brows[0], 1.0);
    near(view.faces[11].brows[1], -1.0);
    assert!(view.faces[12].lids[0] > 0.99 && view.faces[10].lids[0].abs() < 0.01);
    near(view.faces[13].jaw, 1.0);
    near(view.faces[16].brows[0], 1.0);
    let head = view.head.as_ref().expect("turns");
    near(head[14][1], 0.3);
    near(head[15][2], 0.2);
    assert!(view.faces[15].is_at_rest() || view.faces[15].face_numbers().iter().all(|it| it.abs() < 0.02));
    assert_eq!(
        view.face_number_values("tongue_out"),
        None,
        "points do not show a tongue"
    );
    assert!(
        view.findings
            .iter()
            .any(|it| it.message.contains("estimated from points"))
    );
}

#[test]
fn points_that_are_no_face_are_ignored_and_gaps_are_bridged() {
    let hand = [("RIGHT_HAND_LANDMARKS", "WRIST"), ("POSE_LANDMARKS", "33")];
    assert_eq!(FaceMesh::find_face_mesh(hand.into_iter()), None);
    let odd = [("FACE_LANDMARKS", "99999999999999999999"), ("FACE_LANDMARKS", "x")];
    assert_eq!(FaceMesh::find_face_mesh(odd.into_iter()), None);
    let still = Drawn::default();
    let whole = markers(&[still; 6]);
    let mut points = whole.marker_points().to_vec();
    points[0].place[0] = FrameNumberColumn::from_double_floats(vec![350.0, f64::NAN, 350.0, 350.0, 350.0, 350.0]);
    let gappy = MarkerTrack::new(whole.marker_times().clone(), *whole.marker_space(), points).expect("a track");
    let view = view(&gappy);
    assert_eq!(view.bridged, 1);
    assert!(
        view.faces
            .iter()
            .all(|face| face.face_numbers().iter().all(|it| it.is_finite()))
    );
}

#[test]
fn weights_are_scaled_so_that_one_is_the_largest_movement_of_the_person() {
    let rest = FacePosture {
        brows: [0.1, 0.1],
        ..FacePosture::default()
    };
    let mut faces = vec![rest; 100];
    for (at, face) in faces.iter_mut().enumerate().skip(40).take(20) {
        face.brows = [0.5 + 0.001 * at as f64, 0.5];
        face.jaw = 0.4;
    }
    let mut view = DerivedFaceView {
        system: FaceSystem::find_face_system("arkit").expect("a system"),
        faces,
        known: [true; FacePosture::FACE_NUMBER_COUNT],
        head: None,
        place: None,
        bridged: 0,
        findings: Vec::new(),
        units: Vec::new(),
    };
    let fit = FaceCalibration::calibration_from_view(&view).expect("a fit");
    assert!(fit.is_calibration_for(&view));
    let text = serde_json::to_string(&fit).expect("written");
    assert_eq!(
        serde_json::from_str::<FaceCalibration>(&text).expect("read"),
        fit,
        "as data"
    );
    let brow = fit.numbers["brow_raise_left"];
    assert!((brow.rest - 0.1).abs() < 1e-12 && (brow.up.expect("up") - 0.4).abs() < 1e-9);
    assert_eq!(brow.down, None, "the take never lowers them");
    let untried: Vec<&str> = fit.untried_number_names().collect();
    assert!(untried.contains(&"tongue_out") && !untried.contains(&"jaw_open"));
    fit.apply_face_calibration(&mut view);
    assert_eq!(view.faces[0].brows, [0.0, 0.0]);
    assert!((view.faces[50].brows[1] - 1.0).abs() < 1e-9);
    assert!((view.faces[50].jaw - 1.0).abs() < 1e-9);
    let other = DerivedFaceView {
        system: FaceSystem::find_face_system("fap").expect("a system"),
        ..view
    };
    assert!(!fit.is_calibration_for(&other));
}

/// Tests films of signers by other people: known medians of lids and brows for two of them, and mouths that open.
#[test]
fn meshes_of_others_show_faces() {
    let Some(folder) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("skipped: CHEREME_SHARED_DATA names no folder");
        return;
    };
    let folder = std::path::Path::new(&folder).join("motion/pose/sign-language-processing-pose");
    let mut moving = 0;
    for name in [
        "mediapipe.pose",
        "84322c38ff23406f222641da30d0a49b.pose",
        "sample-data-example.pose",
        "7bd6dd48722def3cf84258b96371cb1e.pose",
    ] {
        let bytes = std::fs::read(folder.join(name)).expect("a file");
        let (tracks, _) = crate::pose::read_pose_file(&bytes).expect("points");
        let found = tracks.tracks.iter().find_map(|track| match &track.content {
            crate::tracks::CapturedTrackContent::Markers(markers) => {
                let named = markers.marker_points().iter();
                let mesh = FaceMesh::find_face_mesh(named.map(|it| (&*it.group, &*it.name)))?;
                Some((mesh.measure_face_frames(markers), markers.marker_times().clone()))
            }
            crate::tracks::CapturedTrackContent::Curves(_) => None,
        });
        let (measured, times) = found.unwrap_or_else(|| panic!("{name} has a face"));
        let median = |at: usize| super::faces_mesh::quantile_of_known(&column(&measured, at), 0.5).expect("known");
        let (brow, lid, wide) = (median(0), median(3), median(8));
        assert!((0.05..0.14).contains(&lid), "{name}: lid {lid}");
        assert!((0.08..0.35).contains(&brow), "{name}: brow {brow}");
        assert!((0.35..0.65).contains(&wide), "{name}: mouth {wide}");
        let view = FaceSystem::find_face_system("mesh")
            .expect("a system")
            .derive_face_view(&FaceMesh::face_measure_curves(times, &measured).expect("curves"));
        let jaw = view.face_number_values("jaw_open").expect("a jaw");
        let most = jaw.iter().copied().fold(0.0, f64::max);
        eprintln!("{name}: lid {lid:.3}, brow {brow:.3}, mouth {wide:.3}, jaw to {most:.2}");
        moving += usize::from(most > 0.05);
    }
    assert!(moving > 2, "mouths move in {moving} takes");
}

fn column(all: &[super::FaceMeasures], at: usize) -> Vec<f64> {
    all.iter().map(|it| it[at]).collect()
}
