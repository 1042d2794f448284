//! Faces as points on film: derives the channels of a face from lengths between the landmarks of its mesh.
//!
//! The points are MediaPipe's (478, 468 or fewer, each named by its number) or the 70 of OpenPose. Of each frame a few
//! lengths are measured ([`FaceMesh::measure_face_frames`]); the channels compare those lengths with the signer's own medians
//! ([`FaceMesh::face_measure_curves`]), so they need the whole film.

use chereme_motion::glam::DVec2;
use chereme_motion::{CurveTrack, FrameNumberColumn, FrameTimes, MarkerTrack, MotionMarker, ScalarCurve, TrackError};

/// The number of lengths measured in each frame.
pub const FACE_MEASURE_COUNT: usize = 14;
/// The lengths of one frame, in the order of the channels of the system `mesh`; a NaN is unknown.
pub type FaceMeasures = [f64; FACE_MEASURE_COUNT];

/// The names of the channels.
const MEASURE_CHANNEL_NAMES: [&str; FACE_MEASURE_COUNT] = [
    "mesh_brow_right",
    "mesh_brow_left",
    "mesh_brow_gap",
    "mesh_lid_right",
    "mesh_lid_left",
    "mesh_gaze_left",
    "mesh_gaze_up",
    "mesh_mouth_gap",
    "mesh_mouth_width",
    "mesh_corner_right",
    "mesh_corner_left",
    "mesh_pitch",
    "mesh_yaw",
    "mesh_roll",
];
const PITCH_MEASURE_INDEX: usize = 11;

/// Distance by which the tip of the nose, and of the brows, protrudes in front of the corners of the eyes, as shares of
/// the distance between the eyes' outer corners.
const NOSE_DEPTH_SHARE: f64 = 0.5;
const BROW_DEPTH_SHARE: f64 = 0.18;
/// The fewest frames with a face for a median.
const MIN_MEDIAN_FRAMES: usize = 2;

/// A place on a face; for several points it is their mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum FaceSpot {
    OuterEye,
    InnerEye,
    UpperLid,
    LowerLid,
    Brow,
    InnerBrow,
    Corner,
    Iris,
}

const FACE_SPOTS: [FaceSpot; 8] = [
    FaceSpot::OuterEye,
    FaceSpot::InnerEye,
    FaceSpot::UpperLid,
    FaceSpot::LowerLid,
    FaceSpot::Brow,
    FaceSpot::InnerBrow,
    FaceSpot::Corner,
    FaceSpot::Iris,
];

/// The numbers of the points of a place: on the signer's right, then on the left.
type FaceSpotPair = [&'static [u16]; 2];

/// The numbers of points in a kind of mesh.
struct MeshPoints {
    pairs: [FaceSpotPair; FACE_SPOTS.len()],
    nose: &'static [u16],
    upper_lip: &'static [u16],
    lower_lip: &'static [u16],
}

const MEDIAPIPE_MESH_POINTS: MeshPoints = MeshPoints {
    pairs: [
        [&[33], &[263]],
        [&[133], &[362]],
        [&[159], &[386]],
        [&[145], &[374]],
        [&[105], &[334]],
        [&[107, 55], &[336, 285]],
        [&[61], &[291]],
        [&[468], &[473]],
    ],
    nose: &[1, 4],
    upper_lip: &[13],
    lower_lip: &[14],
};

const OPENPOSE_MESH_POINTS: MeshPoints = MeshPoints {
    pairs: [
        [&[36], &[45]],
        [&[39], &[42]],
        [&[37, 38], &[43, 44]],
        [&[41, 40], &[47, 46]],
        [&[19], &[24]],
        [&[21], &[22]],
        [&[48], &[54]],
        [&[68], &[69]],
    ],
    nose: &[30],
    upper_lip: &[62],
    lower_lip: &[66],
};

/// The positions of a face's points in a track.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FaceMesh {
    /// For each place the indices of its points, right and left.
    pairs: Vec<[Vec<usize>; 2]>,
    nose: Vec<usize>,
    lips: [Vec<usize>; 2],
}

impl FaceMesh {
    /// Returns the mesh in a list of points, each given by group and name; `None` if they hold no face, or too little
    /// of one.
    #[must_use]
    pub fn find_face_mesh<'a>(points: impl Iterator<Item = (&'a str, &'a str)> + Clone) -> Option<Self> {
        let of = |wanted: &str, kind: &MeshPoints| {
            let mut places: Vec<Option<usize>> = vec![None; 512];
            for (at, (group, name)) in points.clone().enumerate() {
                if !group.to_ascii_lowercase().contains(wanted) {
                    continue;
                }
                let digits = name.rsplit('_').next().unwrap_or_default();
                let slot = digits.parse::<usize>().ok();
                if let Some(slot) = slot.and_then(|index| places.get_mut(index)) {
                    slot.get_or_insert(at);
                }
            }
            Self::face_mesh_from_places(kind, &places)
        };
        of("face_landmarks", &MEDIAPIPE_MESH_POINTS).or_else(|| of("face_keypoints", &OPENPOSE_MESH_POINTS))
    }

    fn face_mesh_from_places(kind: &MeshPoints, places: &[Option<usize>]) -> Option<Self> {
        let present_points = |points: &[u16]| -> Vec<usize> {
            let found_places = points.iter().filter_map(|point| places[usize::from(*point)]);
            found_places.collect()
        };
        let mesh = Self {
            pairs: kind.pairs.iter().map(|pair| pair.map(present_points)).collect(),
            nose: present_points(kind.nose),
            lips: [present_points(kind.upper_lip), present_points(kind.lower_lip)],
        };
        let there = |spot: FaceSpot| mesh.pairs[spot as usize].iter().all(|side| !side.is_empty());
        let needed_spots = [
            FaceSpot::OuterEye,
            FaceSpot::UpperLid,
            FaceSpot::LowerLid,
            FaceSpot::Brow,
        ];
        needed_spots.into_iter().all(there).then_some(mesh)
    }

    /// Returns the lengths in each frame of a track, or of a part of one.
    #[must_use]
    pub fn measure_face_frames(&self, markers: &MarkerTrack) -> Vec<FaceMeasures> {
        let points = markers.marker_points();
        (0..markers.marker_frame_count())
            .map(|frame| {
                self.measure_face_frame(points, frame)
                    .unwrap_or([f64::NAN; FACE_MEASURE_COUNT])
            })
            .collect()
    }

    fn measure_face_frame(&self, points: &[MotionMarker], frame: usize) -> Option<FaceMeasures> {
        let middle = |places: &[usize]| -> Option<DVec2> {
            let mut sum = DVec2::ZERO;
            for place in places {
                let marker_place = points.get(*place)?.marker_position(frame)?;
                // Pictures count rows from the top down.
                sum += DVec2::new(marker_place.x, -marker_place.y);
            }
            (!places.is_empty()).then(|| sum / places.len() as f64)
        };
        let pair = |spot: FaceSpot| self.pairs[spot as usize].each_ref();
        let outer = pair(FaceSpot::OuterEye);
        let (right, left) = (middle(outer[0])?, middle(outer[1])?);
        let across = left - right;
        let size = across.length();
        if !(size.is_finite() && size > f64::EPSILON) {
            return None;
        }
        let level = DVec2::new(across.x, -across.y) / size;
        let between = (right + left) / 2.0;
        // Axes towards the signer's left and up; origin between the eyes; unit the distance of the eyes' outer corners.
        let face_place = |places: &[usize]| Some((middle(places)? - between).rotate(level) / size);
        let of = |spot: FaceSpot, side: usize| face_place(pair(spot)[side]);
        let number = |value: Option<f64>| value.unwrap_or(f64::NAN);
        let nose = face_place(&self.nose);
        let lips = self.lips.each_ref().map(|lip| face_place(lip));
        let brow = |side| Some(of(FaceSpot::Brow, side)?.y);
        let lid = |side| Some((of(FaceSpot::UpperLid, side)? - of(FaceSpot::LowerLid, side)?).length());
        let both = |one: &dyn Fn(usize) -> Option<f64>| Some((one(0)? + one(1)?) / 2.0);
        let eye = |side| {
            let (outer, inner) = (of(FaceSpot::OuterEye, side)?, of(FaceSpot::InnerEye, side)?);
            let iris = of(FaceSpot::Iris, side)?;
            Some((iris - (outer + inner) / 2.0, (outer - inner).length()))
        };
        let looks = |side| eye(side).map(|(at, wide)| at.x / wide.max(f64::EPSILON));
        let rises = |side| eye(side).map(|(at, _)| at.y);
        let gap = || Some((lips[0]? - lips[1]?).length());
        let corner = |side| Some(of(FaceSpot::Corner, side)?.y - (lips[0]?.y + lips[1]?.y) / 2.0);
        let wide = |spot| Some((of(spot, 1)? - of(spot, 0)?).length());
        Some([
            number(brow(0)),
            number(brow(1)),
            number(wide(FaceSpot::InnerBrow)),
            number(lid(0)),
            number(lid(1)),
            number(both(&looks)),
            number(both(&rises)),
            number(gap()),
            number(wide(FaceSpot::Corner)),
            number(corner(0)),
            number(corner(1)),
            number(nose.map(|at| -at.y / NOSE_DEPTH_SHARE)),
            number(nose.map(|at| (at.x / NOSE_DEPTH_SHARE).atan())),
            across.y.atan2(across.x),
        ])
    }

    /// Returns the channels of the system `mesh` for the lengths of a whole film.
    ///
    /// # Errors
    /// [`TrackError`] if the numbers of times and frames differ.
    pub fn face_measure_curves(times: FrameTimes, frames: &[FaceMeasures]) -> Result<CurveTrack, TrackError> {
        let column = |at: usize| -> Vec<f64> { frames.iter().map(|frame| frame[at]).collect() };
        let pitch = compare_with_median(&column(PITCH_MEASURE_INDEX), less);
        let channel = |(at, name): (usize, &&str)| {
            let raw_values = column(at);
            let values = match at {
                // Brows seem lower when the head bends down, because they protrude; this corrects it.
                0 | 1 => {
                    let bent = raw_values.iter().zip(&pitch).map(|(brow, down)| match down.is_nan() {
                        true => *brow,
                        false => brow + BROW_DEPTH_SHARE * down,
                    });
                    compare_with_median(&bent.collect::<Vec<_>>(), |brow, usual| brow / usual - 1.0)
                }
                2 | 8 => compare_with_median(&raw_values, |wide, usual| wide / usual - 1.0),
                3 | 4 => compare_with_median(&raw_values, |gap, usual| gap / usual),
                5 | 6 | 9 | 10 => compare_with_median(&raw_values, less),
                7 => from_least(&raw_values),
                PITCH_MEASURE_INDEX => pitch.clone(),
                _ => raw_values,
            };
            let finite = values
                .into_iter()
                .map(|value| if value.is_finite() { value } else { f64::NAN });
            ScalarCurve::new(*name, FrameNumberColumn::from_double_floats(finite.collect()))
        };
        CurveTrack::new(times, MEASURE_CHANNEL_NAMES.iter().enumerate().map(channel).collect())
    }
}

fn less(value: f64, usual: f64) -> f64 {
    value - usual
}

/// Returns the value below which a share of the known numbers lies; `None` with too few of them.
pub(super) fn quantile_of_known(values: &[f64], share: f64) -> Option<f64> {
    let mut finite_values: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    finite_values.sort_by(f64::total_cmp);
    let last = finite_values.len().checked_sub(1)?;
    (finite_values.len() >= MIN_MEDIAN_FRAMES).then(|| finite_values[(share * last as f64).round() as usize])
}

/// Returns `how` of each number and the median; NaN for all if there is no median.
fn compare_with_median(values: &[f64], how: fn(f64, f64) -> f64) -> Vec<f64> {
    let usual = quantile_of_known(values, 0.5).unwrap_or(f64::NAN);
    values.iter().map(|value| how(*value, usual)).collect()
}

/// Returns how far each number lies above the tenth percentile; 0 below it.
fn from_least(values: &[f64]) -> Vec<f64> {
    let least = quantile_of_known(values, 0.1).unwrap_or(f64::NAN);
    values.iter().map(|value| (value - least).max(0.0)).collect()
}
