//! Tables of programs: Motive, Nexus, QTM, and DeepLabCut.

use super::*;

pub(super) const MOTIVE: &str = "Format Version,1.25,Take Name,a take,Capture Frame Rate,240.000000,Export Frame Rate,120.000000,Rotation Type,Quaternion,Length Units,Millimeters,Coordinate Space,Global
,
,Type,Bone,Bone,Bone,Bone,Bone,Bone,Bone,Bone Marker,Bone Marker,Bone Marker,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Marker,Marker,Marker,Marker,Marker,Marker
,Name,Anna:Hip,Anna:Hip,Anna:Hip,Anna:Hip,Anna:Hip,Anna:Hip,Anna:Hip,Anna:HEAD,Anna:HEAD,Anna:HEAD,Hat,Hat,Hat,Hat,\"Anna:HEAD\",\"Anna:HEAD\",\"Anna:HEAD\",\"Unlabeled 1218\",\"Unlabeled 1218\",\"Unlabeled 1218\"
,ID,1,1,1,1,1,1,1,2,2,2,3,3,3,3,4,4,4,5,5,5
,Parent,,,,,,,,,,,,,,,,,,,,
,,Rotation,Rotation,Rotation,Rotation,Position,Position,Position,Position,Position,Position,Position,Position,Position,Mean Marker Error,Position,Position,Position,Position,Position,Position
Frame,Time (Seconds),X,Y,Z,W,X,Y,Z,X,Y,Z,X,Y,Z,,X,Y,Z,X,Y,Z
0,0.000000,0,0,0,1,10.5,900.0,3,1,1,1,11,1700,5,0.2,12.250,1650,4,,,
1,0.008333,0,0,0,1,10.6,900.1,3,1,1,1,11,1701,5,0.2,,,,7,8,9
";

pub(super) const VICON: &str = "Devices,
1000,
,,Force Plate - Force,,
Frame,Sub Frame,Fx,Fy,Fz
,,N,N,N
1,0,1,2,3

Trajectories
100
,,Anna:LSHO,,,Anna:RSHO,,
Frame,Sub Frame,X,Y,Z,X,Y,Z
,,mm,mm,mm,mm,mm,mm
101,0,10.5,20,1400,-300,20,1400
102,0,10.6,20,1400,,,

Model Outputs
100
,,Anna:LElbowAngles,,
Frame,Sub Frame,X,Y,Z
,,deg,deg,deg
1,0,1,2,3
";

pub(super) const QUALISYS: &str = "NO_OF_FRAMES\t2
NO_OF_CAMERAS\t14
NO_OF_MARKERS\t2
FREQUENCY\t200
NO_OF_ANALOG\t0
DESCRIPTION\t--
TIME_STAMP\t2022-06-03, 10:47:36.627\t94247.45402301
DATA_INCLUDED\t3D
EVENT\tclap\t2\t0.005
MARKER_NAMES\tx_HeadL\tx_ToeR\t
TRAJECTORY_TYPES\tMeasured\tMeasured
100.5\t20\t1600\t300\t40\t50
100.6\t20\t1600\t\t\t
";

pub(super) const DEEP_LAB_CUT: &str =
    "scorer,DLC_resnet50,DLC_resnet50,DLC_resnet50,DLC_resnet50,DLC_resnet50,DLC_resnet50
bodyparts,nose,nose,nose,tail base,tail base,tail base
coords,x,y,likelihood,x,y,likelihood
0,245.3,189.2,0.98,300,192.5,0.95
1,246.1,190.3,0.97,301,193.2,0.96
";

fn convention(markers: &MarkerTrack) -> String {
    match markers.marker_space() {
        MarkerSpace::World(it) => format!("{} {}", it.metres_per_unit, it.axes.up_direction()),
        other => other.marker_space_name().to_owned(),
    }
}

#[test]
fn motive_gives_markers_bones_and_rigid_bodies_and_names_what_is_left_out() {
    let (found, findings) = markers(MOTIVE);
    let expected = [
        ("Anna bones", "Hip"),
        ("rigid bodies", "Hat"),
        ("Anna", "HEAD"),
        ("", "Unlabeled 1218"),
    ];
    assert_eq!(labels(&found), expected);
    assert_eq!(
        found.marker_points()[2].place[0].column_text_at(0).as_deref(),
        Some("12.250")
    );
    assert_eq!(found.marker_points()[2].marker_position(1), None);
    assert_eq!(
        found.marker_times().even_times_rate().map(|it| it.rate_numerator()),
        Some(120)
    );
    assert_eq!(convention(&found), "0.001 +Y");
    for part in [
        "columns of rotations are left out, for a table of points holds the places of bones and rigid bodies alone: 4",
        "the places where bodies expect their markers are left out, for the seen markers are there: 1",
        "columns of errors and qualities of markers and bodies are left out: 1",
        "+Y is taken, as Motive usually has it",
    ] {
        assert!(holds(&findings, part), "{part}: {findings:?}");
    }
    assert_eq!(PointFile::detect_point_file(MOTIVE.as_bytes()), Some(PointFile::Motive));
}

#[test]
fn versions_of_motive_read_to_equal_points() {
    let (expected, _) = markers(MOTIVE);
    let parent = ",Parent,,,,,,,,,,,,,,,,,,,,\n";
    assert!(MOTIVE.contains(parent));
    let dialects = [
        ("no parents", MOTIVE.replace(parent, "")),
        (
            "no labels of rows",
            MOTIVE
                .replace(parent, "")
                .replace(",Type", ",")
                .replace(",Name", ",")
                .replace(",ID", ","),
        ),
        ("semicolons", MOTIVE.replace(',', ";").replace('.', ",")),
        ("a blank line above", format!("\n{MOTIVE}")),
        (
            "only the rate of the capture",
            MOTIVE.replace("240.000000,Export Frame Rate,120", "120.000000,Export Frame Rate,"),
        ),
    ];
    for (name, text) in dialects {
        assert_eq!(markers(&text).0, expected, "{name}\n{text}");
    }
    let timed = MOTIVE
        .replace("(Seconds),", "(Seconds),TimeCode,")
        .replace("0.000000,", "0.000000,15:26:46:12.02,")
        .replace("0.008333,", "0.008333,15:26:46:13.02,")
        .replace(",Type", ",Type,")
        .replace(",Name", ",Name,")
        .replace(",ID", ",ID,")
        .replace(",Parent", ",Parent,")
        .replace(",,Rotation", ",,,Rotation")
        .replace("240.000000,15:26:46:12.02,", "240.000000,")
        .replace("120.000000,15:26:46:12.02,", "120.000000,");
    assert_eq!(markers(&timed).0, expected, "a column of timecodes\n{timed}");
}

#[test]
fn bones_of_motive_in_their_parents_space_are_no_places() {
    let local = MOTIVE.replace("Space,Global", "Space,Local");
    let (found, findings) = markers(&local);
    assert!(!labels(&found).contains(&("Anna bones", "Hip")));
    assert!(holds(&findings, "relative to their parents"), "{findings:?}");
    let alone = "Format Version,1.23,Length Units,Meters,Coordinate Space,Local\n\n,,Bone,Bone,Bone\n,,A:Hip,A:Hip,A:Hip\n,,1,1,1\n,,Position,Position,Position\nFrame,Time (Seconds),X,Y,Z\n0,0,1,2,3\n";
    assert!(refused(alone).contains("Coordinate Space is Local"));
    let whole = alone.replace("Local", "Global");
    assert_eq!(labels(&markers(&whole).0), [("A bones", "Hip")]);
    assert!(refused("Format Version,1.23\n\n,,Marker\n").contains("axes, which begins with Frame"));
}

#[test]
fn nexus_gives_its_trajectories_and_names_its_other_sections() {
    let (tracks, findings) = table(VICON);
    let (found, _) = markers(VICON);
    assert_eq!(labels(&found), [("Anna", "LSHO"), ("Anna", "RSHO")]);
    assert_eq!(
        found.marker_points()[0].place[0].column_text_at(1).as_deref(),
        Some("10.6")
    );
    assert_eq!(found.marker_points()[1].marker_position(1), None);
    assert_eq!(convention(&found), "0.001 +Z");
    assert_eq!(
        found.marker_times().even_times_rate().map(|it| it.rate_numerator()),
        Some(100)
    );
    assert!(
        holds(&findings, "sections of other data are left out: Devices, Model Outputs"),
        "{findings:?}"
    );
    assert!(holds(&findings, "it begins with frame 101"), "{findings:?}");
    assert_eq!(tracks.events, None);
    let tabs = VICON.replace(',', "\t");
    assert_eq!(markers(&tabs).0, found);
    let moments = "Events\n100\nSubject,Context,Name,Time (s),Description\nAnna,Left,Foot Strike,0.01,\n\n";
    let (tracks, _) = table(&format!("{moments}{VICON}"));
    let events = tracks.events.expect("events");
    assert_eq!(events.tiers[0].annotations[0].value, "Left Foot Strike");
    let (_, other) = VICON.split_once("Model").expect("a section");
    assert!(refused(&format!("Model{other}")).contains("but Model Outputs"));
}

#[test]
fn qualisys_has_frames_and_times_or_none_and_three_forms_of_a_gap() {
    let (tracks, findings) = table(QUALISYS);
    let (expected, _) = markers(QUALISYS);
    assert_eq!(labels(&expected), [("", "x_HeadL"), ("", "x_ToeR")]);
    assert_eq!(expected.marker_points()[1].marker_position(1), None);
    assert_eq!(
        expected.marker_times().even_times_rate().map(|it| it.rate_numerator()),
        Some(200)
    );
    assert_eq!(convention(&expected), "0.001 +Z", "{findings:?}");
    let events = tracks.events.expect("events");
    assert_eq!(events.tiers[0].annotations[0].value, "clap");
    let rows = |first: &str, second: &str| {
        QUALISYS
            .replace("\n100.5", &format!("\n{first}100.5"))
            .replace("\n100.6", &format!("\n{second}100.6"))
    };
    let titles = "\nFrame\tTime\tx_HeadL X\tx_HeadL Y\tx_HeadL Z\tx_ToeR X\tx_ToeR Y\tx_ToeR Z\n100.5";
    for (name, text) in [
        ("times", rows("1\t0.00000\t", "2\t0.00500\t")),
        (
            "titles",
            QUALISYS
                .replace("\n100.5", titles)
                .replace("\n100.5", "\n1\t0.00000\t100.5")
                .replace("\n100.6", "\n2\t0.00500\t100.6"),
        ),
        ("noughts", QUALISYS.replace("\t\t\t\n", "\t0.000\t0.000\t0.000\n")),
        ("words", QUALISYS.replace("\t\t\t\n", "\tNULL\tNULL\tNULL\n")),
        (
            "decimal commas",
            QUALISYS
                .replace("100.5", "100,5")
                .replace("100.6", "100,6")
                .replace("0.005", "0,005")
                .replace(".627", "")
                .replace(".45402301", ""),
        ),
    ] {
        assert_eq!(markers(&text).0, expected, "{name}\n{text}");
    }
}

#[test]
fn bodies_of_qualisys_are_points_if_titles_show_their_places() {
    let head = "NO_OF_FRAMES\t1\nNO_OF_BODIES\t2\nFREQUENCY\t100\nDATA_INCLUDED\t6D\nBODY_NAMES\tHat\tHand\n";
    let titles = "Frame\tTime\tX\tY\tZ\tRoll\tX\tY\tZ\tRoll\n";
    let row = "1\t0\t1\t2\t3\t90\t4\t5\t6\t90\n";
    let (found, findings) = markers(&format!("{head}{titles}{row}"));
    assert_eq!(labels(&found), [("rigid bodies", "Hat"), ("rigid bodies", "Hand")]);
    assert_eq!(found.marker_points()[1].marker_position(0).map(|at| at.z), Some(6.0));
    assert!(
        holds(&findings, "holds the places of bones and rigid bodies alone: 2"),
        "{findings:?}"
    );
    assert!(refused(&format!("{head}{row}")).contains("do not show which columns are places"));
}

#[test]
fn titles_over_several_rows_name_points_and_people() {
    let (found, _) = markers(DEEP_LAB_CUT);
    assert_eq!(labels(&found), [("", "nose"), ("", "tail base")]);
    assert_eq!(convention(&found), "image-2d");
    assert_eq!(found.marker_quality(), Some(QualityMeaning::Confidence));
    let (_, below) = DEEP_LAB_CUT.split_once('\n').expect("rows");
    let people = format!("scorer,a,a,a,a,a,a\nindividuals,one,one,one,two,two,two\n{below}");
    assert_eq!(labels(&markers(&people).0), [("one", "nose"), ("two", "tail base")]);
    let (room, _) = markers(",A,,,B,,\ntime,X,Y,Z,X,Y,Z\n,mm,mm,mm,mm,mm,mm\n0,1,2,3,4,5,6\n0.02,1,2,3,4,5,6\n");
    assert_eq!(labels(&room), [("", "A"), ("", "B")]);
    assert!(convention(&room).starts_with("0.001 "), "{}", convention(&room));
    assert_eq!(
        room.marker_times().even_times_rate().map(|it| it.rate_numerator()),
        Some(50)
    );
}
