//! Tests that tables which look nearly alike keep the times of their frames, their gaps and their kind.

use super::*;

/// Returns the times of the frames of the first track in seconds, from the start of the file.
fn times(text: &str) -> Vec<f64> {
    let (tracks, _) = table(text);
    let track = &tracks.tracks[0];
    let CapturedTrackContent::Markers(markers) = &track.content else {
        panic!("markers");
    };
    let start = track.offset.instant_seconds();
    (0..markers.marker_frame_count())
        .map(|frame| start + markers.marker_times().frame_time_instant(frame).instant_seconds())
        .collect()
}

/// Writes a table with these first columns, their numbers in each row, and one point.
fn of_rows(titles: &str, rows: impl Iterator<Item = String>) -> String {
    let mut text = format!("{titles},palm_x,palm_y,palm_z\n");
    for row in rows {
        text += &format!("{row},0.1,0.2,0.3\n");
    }
    text
}

#[track_caller]
fn assert_times(text: &str, expected: &[f64], slack: f64) {
    let found = times(text);
    assert_eq!(found.len(), expected.len(), "{text}");
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() <= slack, "{found} {expected}\n{text}");
    }
}

#[test]
fn frames_that_are_missing_move_no_other_frame() {
    let kept: Vec<u32> = (0..60).filter(|frame| *frame != 30).collect();
    let all = || kept.iter().copied();
    let at_rate = |rate: f64| -> Vec<f64> { all().map(|it| f64::from(it) / rate).collect() };
    let frames = of_rows("frame [25 fps]", all().map(|it| it.to_string()));
    assert_times(&frames, &at_rate(25.0), 1e-6);
    let both = all().map(|it| format!("{},{:.2}", it + 1, f64::from(it) / 100.0));
    assert_times(&of_rows("frame,time", both), &at_rate(100.0), 1e-6);
    let times = all().map(|it| format!("{:.2}", f64::from(it) / 100.0));
    assert_times(&of_rows("time", times), &at_rate(100.0), 1e-6);
    let whole = [0.0, 1.0, 2.0, 5.0, 6.0, 7.0];
    let rows = whole.iter().map(ToString::to_string);
    assert_times(&of_rows("time", rows), &whole, 1e-6);
}

#[test]
fn rounded_times_are_those_of_an_even_rate() {
    for (rate, decimals) in [(120.0, 2), (60.0, 2), (60.0, 3), (29.97, 3), (25.0, 2)] {
        let rows = (0..90).map(|it| format!("{:.decimals$}", f64::from(it) / rate));
        let (markers, _) = markers(&of_rows("time", rows));
        let found = markers.marker_times().even_times_rate().map(|it| it.per_second());
        assert!(found.is_some_and(|it| (it - rate).abs() < 0.05), "{rate} {found:?}");
    }
}

#[test]
fn units_of_times_are_read_from_titles_and_from_whole_numbers() {
    let expected: Vec<f64> = (0..30).map(|it| f64::from(it) / 30.0).collect();
    for (title, factor) in [
        ("time_us", 1e6),
        ("timestamp [us]", 1e6),
        ("timestamp", 1e6),
        ("time [ns]", 1e9),
        ("timestamp_ms", 1e3),
    ] {
        let rows = expected.iter().map(|at| format!("{:.0}", at * factor));
        assert_times(&of_rows(title, rows), &expected, 1e-3);
    }
}

#[test]
fn rows_without_numbers_are_frames_unless_rows_have_a_clock() {
    let text = "palm_x,palm_y,palm_z\n1,2,3\n,,\n,,\n4,5,6\n,,\n";
    let (found, _) = markers(text);
    assert_eq!(found.marker_frame_count(), 4);
    assert_eq!(found.marker_points()[0].marker_position(1), None);
    assert_eq!(
        found.marker_points()[0].marker_position(3),
        Some(glam::DVec3::new(4.0, 5.0, 6.0))
    );
    let text = "time,palm_x,palm_y,palm_z\n0,1,2,3\n,,,\n0.02,1,2,3\n0.03,1,2,3\n";
    assert_times(text, &[0.0, 0.02, 0.03], 1e-6);
    let qualisys = "NO_OF_FRAMES\t5\nNO_OF_MARKERS\t1\nFREQUENCY\t100\nMARKER_NAMES\tw\nNULL\tNULL\tNULL\n1\t2\t3\n\t\t\n4\t5\t6\n";
    let (found, findings) = markers(qualisys);
    assert_eq!(found.marker_frame_count(), 4);
    assert_eq!(found.marker_points()[0].marker_position(0), None);
    let said = holds(&findings, "the header states 5 frames, and the file holds 4");
    assert!(said, "{findings:?}");
}

#[test]
fn events_have_the_times_of_the_frames_of_their_capture() {
    let rows = (201..=300).filter(|frame| *frame != 250);
    let rows: String = rows.map(|frame| format!("{frame},0,1,2,3\n")).collect();
    let text = format!(
        "Events\n100\nSubject,Context,Name,Time (s),Description\nA,Left,Touch,2.5,\n\nTrajectories\n100\n,,A:w\nFrame,Sub Frame,X,Y,Z\n,,mm,mm,mm\n{rows}"
    );
    let (tracks, _) = table(&text);
    assert!((times(&text)[0] - 2.0).abs() < 1e-6);
    let events = tracks.events.expect("events");
    let at = events.tiers[0].annotations[0]
        .span
        .span_start_instant()
        .instant_seconds();
    assert!((at - 2.5).abs() < 1e-6, "{at}");
}

#[test]
fn lexicons_features_and_trials_hold_no_points() {
    for text in [
        "gloss,dominant handshape,weak handshape\nBOOK,B,B\nSTICK,X,Y\nTABLE,5,5\n",
        "gloss,dominant handshape,weak handshape\nBOOK,B,B\nSTICK,X,Y\nCAT,F,F\n",
        "gloss,Handshape x,Handshape y,Handshape z\nBOL,1,2,3\nCHAT,1,2,4\n",
        "Index,Gloss,LocX,LocY,LocZ\n1,BOL,1,2,3\n2,CHAT,1,2,4\n",
        "clip,palm_x,palm_y,palm_z\nbol,1,2,3\nchat,1,2,4\nlion,2,3,4\n",
        "id,mean_x,mean_y,mean_z,sd_x,sd_y,sd_z\n1,1,2,3,1,1,1\n2,1,2,4,1,1,1\n",
        "id,onset_x,onset_y,onset_z,duration\n1,1,2,3,1\n2,1,2,4,1\n",
        "participant,trial,palm_x,palm_y,palm_z\n1,1,1,2,3\n1,2,1,2,4\n",
        "time,wrist_ax,wrist_ay,wrist_az\n0,1,2,3\n0.01,1,2,3\n",
        "time,acc1_x,acc1_y,acc1_z,velocities_x,velocities_y,velocities_z\n0,1,2,3,4,5,6\n0.1,1,2,3,4,5,6\n",
        "time,grf_x,grf_y,grf_z,torques_x,torques_y,torques_z\n0,1,2,3,4,5,6\n0.1,1,2,3,4,5,6\n",
    ] {
        assert_eq!(PointFile::detect_point_file(text.as_bytes()), None, "{text}");
    }
    let pose = "frame,timestamp,pose_Tx,pose_Ty,pose_Tz,pose_Rx,pose_Ry,pose_Rz\n1,0,1,2,3,0.1,0.2,0.3\n2,0.04,1,2,3,0.1,0.2,0.3\n";
    assert_eq!(labels(&markers(pose).0), [("", "pose_T")]);
    let hands = "time,hand_r_x,hand_r_y,hand_r_z\n0,1,2,3\n0.01,1,2,3\n";
    assert_eq!(labels(&markers(hands).0), [("", "hand_r")]);
}

#[test]
fn a_row_for_each_point_of_a_frame_is_refused_whatever_names_the_point() {
    for (text, column) in [
        (
            "time,marker,x,y,z\n0,a,1,2,3\n0,b,2,3,4\n0.1,a,1,2,3\n0.1,b,2,3,4\n",
            "marker",
        ),
        ("frame,id,x,y,z\n1,1,1,2,3\n1,2,2,3,4\n2,1,1,2,3\n2,2,2,3,4\n", "id"),
    ] {
        let error = refused(text);
        assert!(error.contains(&format!("the column {column:?}")), "{error}");
    }
}

#[test]
fn a_pelvis_from_which_the_others_are_measured_is_kept() {
    let text = "time,pelvis_x,pelvis_y,pelvis_z,head_x,head_y,head_z\n0,0,0,0,0,0.6,0\n0.01,0,0,0,0,0.61,0\n";
    let (found, findings) = markers(text);
    assert_eq!(found.marker_points()[0].marker_position(1), Some(glam::DVec3::ZERO));
    assert!(!holds(&findings, "0 0 0"), "{findings:?}");
}
