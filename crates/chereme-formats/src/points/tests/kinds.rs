//! Other kinds of tables, which are no tables of points.

use super::*;

#[test]
fn tables_of_other_things_hold_no_points() {
    for text in [
        "gloss,handshape,placement\nBOL,U,chin\n",
        "gloss,x,y\nBOL,1,2\nCHAT,3,4\n",
        "x,y\n1,2\n3,4\n",
        "Gloss,Location.x,Location.y,Frequency,Notes\nBOL,1,2,7,common\nCHAT,3,4,9,rare\n",
        "tier,start,end,value\nGloss,0.5,1.5,BOL\n",
        "time,jawOpen,mouthPucker\n0,0.1,0.2\n",
        "time,acc_x,acc_y,acc_z,gyro_x,gyro_y,gyro_z\n0,1,2,3,4,5,6\n",
        "time [s],Fx,Fy,Fz,Mx,My,Mz\n0,1,2,3,4,5,6\n",
        "time,hand_qx,hand_qy,hand_qz,hand_qw\n0,0,0,0,1\n",
        "time,hand_x,hand_y,hand_z,hand_w\n0,0,0,0,1\n",
        "time,angle_x,angle_y,angle_z\n0,1,2,3\n",
        "frame, face_id, timestamp, confidence, success, gaze_0_x, gaze_0_y, gaze_0_z, AU01_r, AU02_r, AU01_c\n1,0,0,0.9,1,0,0,0,0,0,0\n",
        "index,name\n1,a\n",
        "",
        "\n\n",
        ",,,\n",
        "events\n5\nBOL\n",
    ] {
        assert_eq!(PointFile::detect_point_file(text.as_bytes()), None, "{text}");
    }
}

#[test]
fn rotations_beside_places_become_curves() {
    let text = "timestamp_ms,Hips_position_x,Hips_position_y,Hips_position_z,Hips_rotation_x,Hips_rotation_y,Hips_rotation_z,Hips_rotation_w\n0,0,0.9,0,0,0,0,1\n10,0,0.9,0,0,0,0,1\n";
    assert_eq!(
        PointFile::detect_point_file(text.as_bytes()),
        None,
        "most of it are rotations"
    );
    let text = text.replace(",Hips_rotation_w", "").replace(",1\n", "\n");
    let (tracks, _) = table(&text);
    let CapturedTrackContent::Curves(curves) = &tracks.tracks[1].content else {
        panic!("curves");
    };
    assert_eq!(curves.track_curves().len(), 3);
    assert_eq!(labels(&markers(&text).0), [("", "Hips")]);
}
