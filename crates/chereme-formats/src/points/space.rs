//! The space of the places of a table: a room, with its unit and axes, or a picture.

use chereme_motion::markers::PointPictureSize;
use chereme_motion::{AxisDirection, MarkerSpace, MotionMarker, QualityMeaning, SpaceConvention};
use chereme_sign::{ErrorRemedy, RemedyChoice};
use glam::DVec3;

use super::points_rows::PointTableLayout;
use crate::finding::ImportFinding;
use crate::tally::FindingTally;
use crate::tracks::{axes_with_up, say_axes, up_of};

/// The frames at which places are looked at.
const SPACE_SAMPLE_FRAMES: usize = 60;
/// The share of places within a picture from which all are shares of its size.
const PICTURE_SHARE_THRESHOLD: f64 = 0.8;
/// The counts of landmarks of MediaPipe's hands, pose, pose with both hands, face, and all.
const MEDIAPIPE_LANDMARK_COUNTS: [usize; 8] = [21, 33, 42, 75, 468, 478, 543, 553];
/// The largest extents of people in metres and in centimetres.
const MAX_PERSON_EXTENTS: [f64; 2] = [6.0, 250.0];

/// Returns the space of points.
pub(super) fn infer_point_space(
    layout: &PointTableLayout,
    points: &[MotionMarker],
    findings: &mut FindingTally,
) -> MarkerSpace {
    let places = sample_point_places(points);
    if layout.coordinates_per_point() == 2 || layout.pixels || are_pixels(layout, points, &places) {
        let frame = infer_picture_frame(&places, findings);
        return match layout.coordinates_per_point() {
            2 => MarkerSpace::Image(frame),
            _ => MarkerSpace::Depth(frame),
        };
    }
    if layout.unit.is_none() && are_shares(layout, points, &places) {
        let text = "places are shares of the picture's width and height: angles between them need its proportions";
        findings.push_note_finding(None, text);
        return MarkerSpace::Depth(PointPictureSize {
            width: 1.0,
            height: 1.0,
        });
    }
    let metres_per_unit = layout.unit.unwrap_or_else(|| infer_point_unit(&places, findings));
    let up = infer_up_direction(layout, points, findings);
    MarkerSpace::World(SpaceConvention {
        metres_per_unit,
        axes: axes_with_up(points, up, findings),
    })
}

/// Returns the places of points at some frames, frame by frame.
fn sample_point_places(points: &[MotionMarker]) -> Vec<Vec<DVec3>> {
    let frames = points
        .first()
        .and_then(|point| point.place.first())
        .map_or(0, |column| column.len());
    let step = frames.div_ceil(SPACE_SAMPLE_FRAMES).max(1);
    let frame_places = |frame| points.iter().filter_map(|point| point.marker_position(frame)).collect();
    (0..frames).step_by(step).map(frame_places).collect()
}

/// Returns the size of the picture on which points lie: their largest coordinates, or 1 if they are shares of it.
fn infer_picture_frame(places: &[Vec<DVec3>], findings: &mut FindingTally) -> PointPictureSize {
    let most = places.iter().flatten().fold(DVec3::ONE, |most, at| most.max(*at));
    let (width, height) = (most.x.ceil(), most.y.ceil());
    let text = match [width, height] == [1.0; 2] {
        true => {
            "places are shares of the picture's width and height: angles between them need its proportions".to_owned()
        }
        false => format!("the size of the pictures is not stated; points reach {width} by {height} pixels"),
    };
    findings.push_note_finding(None, text);
    PointPictureSize { width, height }
}

/// Returns whether places are shares of a picture's size, as landmarks of MediaPipe are.
fn are_shares(layout: &PointTableLayout, points: &[MotionMarker], places: &[Vec<DVec3>]) -> bool {
    let is_number = |point: &MotionMarker| point.name.bytes().all(|byte| byte.is_ascii_digit());
    let are_landmarks = MEDIAPIPE_LANDMARK_COUNTS.contains(&points.len()) && points.iter().all(is_number);
    let is_film = layout.quality.is_some() || are_landmarks;
    if !layout.program.is_empty() || !is_film {
        return false;
    }
    let share = |at: &&DVec3| (0.0..=1.0).contains(&at.x) && (0.0..=1.0).contains(&at.y);
    let all = places.iter().flatten();
    let (count, within) = (all.clone().count(), all.filter(share).count());
    count > 0 && within as f64 >= PICTURE_SHARE_THRESHOLD * count as f64
}

/// Returns whether places with a depth are pixels: estimated, too far apart for metres, and with the head below the
/// feet, as pixels count down.
fn are_pixels(layout: &PointTableLayout, points: &[MotionMarker], places: &[Vec<DVec3>]) -> bool {
    let is_film = layout.unit.is_none() && layout.quality == Some(QualityMeaning::Confidence);
    let reach = places.iter().flatten().map(|at| at.x.max(at.y)).fold(0.0, f64::max);
    is_film
        && reach > MAX_PERSON_EXTENTS[0]
        && up_of(points) == Some(AxisDirection::nearest_axis_direction(DVec3::NEG_Y))
}

/// Infers the unit from the extent of the points.
fn infer_point_unit(places: &[Vec<DVec3>], findings: &mut FindingTally) -> f64 {
    const MIN_CROWD_POINTS: usize = 4;
    let extent = |all: &mut dyn Iterator<Item = &DVec3>| {
        let first = all.next().copied()?;
        let (least, most) = all.fold((first, first), |(least, most), at| (least.min(*at), most.max(*at)));
        Some((most - least).length())
    };
    let crowded = places.iter().filter(|frame| frame.len() >= MIN_CROWD_POINTS);
    let mut each: Vec<f64> = crowded.filter_map(|frame| extent(&mut frame.iter())).collect();
    each.sort_by(f64::total_cmp);
    let median = each.get(each.len() / 2).copied();
    let usual = median.or_else(|| extent(&mut places.iter().flatten())).unwrap_or(0.0);
    let (name, metres) = match usual {
        extent if extent > 0.0 && extent <= MAX_PERSON_EXTENTS[0] => ("metres", 1.0),
        extent if extent > 0.0 && extent <= MAX_PERSON_EXTENTS[1] => ("centimetres", 0.01),
        _ => ("millimetres", 0.001),
    };
    let text = format!("the table states no unit; its points are {usual:.3} apart at most, so {name} are assumed");
    findings.push_counted_finding(ImportFinding::new_warning_finding(None, text).with_remedy(
        ErrorRemedy::choice_remedy(
            RemedyChoice::Unit,
            "say the unit with --unit, such as --unit mm, or write it into the titles, such as wrist_x [mm]",
        ),
    ));
    metres
}

/// Returns the direction that is up: that from feet to head, else that of the program, else +Y.
fn infer_up_direction(
    layout: &PointTableLayout,
    points: &[MotionMarker],
    findings: &mut FindingTally,
) -> AxisDirection {
    let program = layout.program;
    match (up_of(points), layout.up) {
        (Some(seen), Some(usual)) if seen != usual => {
            let text = format!(
                "markers of head and feet show that {seen} is up, and {program} usually has {usual} up; {seen} is taken"
            );
            findings.push_counted_finding(ImportFinding::new_warning_finding(None, text).with_remedy(say_axes()));
            seen
        }
        (Some(seen), _) => seen,
        (None, Some(usual)) => {
            let text =
                format!("the file does not state which axis is up; {usual} is taken, as {program} usually has it");
            findings.push_counted_finding(ImportFinding::new_note_finding(None, text).with_remedy(say_axes()));
            usual
        }
        (None, None) => {
            let text = "no markers of head and feet show which axis is up; +Y is taken";
            findings.push_counted_finding(ImportFinding::new_note_finding(None, text).with_remedy(say_axes()));
            AxisDirection::nearest_axis_direction(DVec3::Y)
        }
    }
}
