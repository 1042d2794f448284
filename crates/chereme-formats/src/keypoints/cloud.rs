//! The points of one person over the frames of a film.

use std::collections::BTreeMap;

use chereme_motion::column::{FileNumber, FrameNumberColumn};
use chereme_motion::glam::DVec2;
use chereme_motion::markers::PointPictureSize;
use chereme_motion::{
    CaptureMethod, FrameTimes, MarkerSpace, MarkerTrack, MotionMarker, QualityMeaning, SpaceConvention,
};
use serde_json::Value;

use super::KeypointError;
use super::keypoints_names;
use crate::tally::FindingTally;

/// The message for places that are shares of the picture.
const PICTURE_SHARES_MESSAGE: &str =
    "places are shares of the picture's width and height: angles between them need its proportions";
/// The most coordinates of one person's points.
const MAX_CLOUD_COORDINATES: usize = 30_000_000;

/// The space of points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PointSpace {
    /// Pixels of the picture.
    Pixels,
    /// Shares of the picture's width and height.
    Share,
    /// Metres from the hips.
    World,
}

/// One point in one frame.
#[derive(Debug, Clone)]
pub(super) struct KeypointSample {
    group: String,
    name: String,
    /// The coordinates; `None` if the point is not seen.
    at: Option<Vec<FileNumber>>,
    sure: Option<FileNumber>,
}

impl KeypointSample {
    pub(super) fn is_seen(&self) -> bool {
        self.at.is_some()
    }
}

fn number_from_json(value: &Value) -> Option<FileNumber> {
    FileNumber::parse_file_number(value.as_number()?.to_string().as_bytes()).ok()
}

/// Adds the points of one of OpenPose's lists, which repeats x, y and confidence; 0, 0, 0 is a gap.
pub(super) fn add_openpose_triples(group: &str, values: &[Value], points: &mut Vec<KeypointSample>) {
    let count = values.len() / 3;
    for (at, triple) in values.chunks_exact(3).enumerate() {
        let sure = number_from_json(&triple[2]);
        let seen = sure.as_ref().is_some_and(|sure| sure.to_f64() > 0.0);
        let place: Option<Vec<FileNumber>> = triple[..2].iter().map(number_from_json).collect();
        points.push(KeypointSample {
            group: group.to_owned(),
            name: keypoints_names::openpose_point_name(group, count, at),
            at: place.filter(|_| seen),
            sure,
        });
    }
}

/// Adds landmarks: objects with x, y, z and an optional visibility; a list of such lists belongs to several hands or
/// people.
pub(super) fn add_mediapipe_landmarks(group: &str, value: &Value, points: &mut Vec<KeypointSample>) {
    let Value::Array(all) = value else { return };
    // A landmark may be a list of its coordinates too: x, y, z and perhaps its visibility.
    let is_numbers = |item: &Value| {
        item.as_array()
            .is_some_and(|numbers| (2..=5).contains(&numbers.len()) && numbers.iter().all(Value::is_number))
    };
    if all.iter().any(Value::is_array) && !all.iter().all(is_numbers) {
        for (at, list) in (1..).zip(all.iter().take(8)) {
            let group = if at == 1 {
                group.to_owned()
            } else {
                format!("{group} {at}")
            };
            if list.as_array().is_some_and(|items| !items.iter().any(Value::is_array)) {
                add_mediapipe_landmarks(&group, list, points);
            }
        }
        return;
    }
    for (at, mark) in all.iter().enumerate() {
        let column = |key: &str| match key {
            "x" => mark.get(0),
            "y" => mark.get(1),
            "z" => mark.get(2),
            "visibility" => mark.get(3),
            _ => None,
        };
        let field = |key: &str| mark.get(key).or_else(|| column(key)).and_then(number_from_json);
        let coordinates: Option<Vec<FileNumber>> = ["x", "y"].into_iter().map(field).collect();
        let place = coordinates.map(|mut place| {
            place.push(field("z").unwrap_or(FileNumber::ZERO_NUMBER));
            place
        });
        points.push(KeypointSample {
            group: group.to_owned(),
            name: keypoints_names::mediapipe_point_name(group, all.len(), at),
            at: place,
            sure: field("visibility").or_else(|| field("score")),
        });
    }
}

/// Returns the mean position of the points that are seen.
pub(super) fn mean_seen_position(points: &[KeypointSample]) -> DVec2 {
    let seen: Vec<DVec2> = points
        .iter()
        .filter_map(|point| match point.at.as_deref() {
            Some([x, y, ..]) => Some(DVec2::new(x.to_f64(), y.to_f64())),
            _ => None,
        })
        .collect();
    seen.iter().sum::<DVec2>() / seen.len().max(1) as f64
}

/// Returns the greater side of the box around the points that are seen.
fn seen_point_extent(points: &[KeypointSample]) -> f64 {
    let seen = points.iter().filter_map(|point| match point.at.as_deref() {
        Some([x, y, ..]) => Some(DVec2::new(x.to_f64(), y.to_f64())),
        _ => None,
    });
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for at in seen {
        (low, high) = (low.min(at), high.max(at));
    }
    let size = (high - low).max_element();
    if size.is_finite() { size } else { 0.0 }
}

/// The growing columns of one point: three coordinates and the confidence.
type KeypointColumns = [Vec<Option<FileNumber>>; 4];

/// The points of one person.
#[derive(Debug)]
pub(super) struct PersonCloud {
    kind: PointSpace,
    names: Vec<(String, String)>,
    known: BTreeMap<(String, String), usize>,
    columns: Vec<KeypointColumns>,
    rows: usize,
    last: Option<DVec2>,
    /// The greatest extent of the points in a frame.
    extent: f64,
    /// The person's number in the file.
    number: Option<u64>,
    least: f64,
    largest: [f64; 2],
}

/// The distance from a person's last place, as a share of the person's extent, that no person moves at once.
const MAX_LEAP_SHARE: f64 = 1.5;

impl PersonCloud {
    pub(super) fn new(kind: PointSpace) -> Self {
        Self {
            kind,
            names: Vec::new(),
            known: BTreeMap::new(),
            columns: Vec::new(),
            rows: 0,
            last: None,
            extent: 0.0,
            number: None,
            least: 0.0,
            largest: [1.0; 2],
        }
    }

    /// Returns an empty cloud of the person with this number.
    pub(super) fn of_person(number: u64) -> Self {
        Self {
            number: Some(number),
            ..Self::new(PointSpace::Pixels)
        }
    }

    pub(super) fn stated_person_number(&self) -> Option<u64> {
        self.number
    }

    pub(super) fn cloud_row_count(&self) -> usize {
        self.rows
    }

    /// Returns whether points are too far from the last ones for the same person.
    pub(super) fn is_person_leap(&self, points: &[KeypointSample]) -> bool {
        let most = self.extent.max(seen_point_extent(points)) * MAX_LEAP_SHARE;
        self.last.is_some() && most > 0.0 && self.distance_from_last(mean_seen_position(points)) > most
    }

    pub(super) fn cloud_point_space(&self) -> PointSpace {
        self.kind
    }

    /// Returns the distance of a position from the person's last one.
    pub(super) fn distance_from_last(&self, at: DVec2) -> f64 {
        self.last.map_or(f64::MAX, |last| last.distance(at))
    }

    /// Adds the points of a frame; if two frames have the same number, the first counts.
    pub(super) fn push_cloud_points(&mut self, row: usize, points: Vec<KeypointSample>) -> Result<(), KeypointError> {
        self.last = Some(mean_seen_position(&points));
        self.extent = self.extent.max(seen_point_extent(&points));
        self.extend_cloud_rows(row)?;
        if self.rows > row {
            return Ok(());
        }
        for point in points {
            let key = (point.group, point.name);
            let point_index = match self.known.get(&key) {
                Some(at) => *at,
                None => {
                    self.known.insert(key.clone(), self.names.len());
                    self.names.push(key);
                    self.columns.push([(); 4].map(|()| vec![None; self.rows]));
                    self.check_cloud_size(self.rows + 1)?;
                    self.names.len() - 1
                }
            };
            let [x, y, ..] = point.at.as_deref().unwrap_or_default() else {
                self.columns[point_index][3].push(point.sure);
                continue;
            };
            for (most, value) in self.largest.iter_mut().zip([x, y]) {
                *most = most.max(value.to_f64());
                self.least = self.least.min(value.to_f64());
            }
            // A name that occurs twice in a frame counts once.
            if self.columns[point_index][0].len() == row {
                let places = point.at.unwrap_or_default();
                for (column, value) in self.columns[point_index].iter_mut().zip(places) {
                    column.push(Some(value));
                }
                self.columns[point_index][3].resize(row, None);
                self.columns[point_index][3].push(point.sure);
            }
        }
        self.extend_cloud_rows(row + 1)
    }

    fn check_cloud_size(&self, rows: usize) -> Result<(), KeypointError> {
        match self.names.len().saturating_mul(rows) > MAX_CLOUD_COORDINATES {
            true => Err(KeypointError::Large(MAX_CLOUD_COORDINATES)),
            false => Ok(()),
        }
    }

    /// Adds gaps until there are `rows` frames.
    pub(super) fn extend_cloud_rows(&mut self, rows: usize) -> Result<(), KeypointError> {
        if rows <= self.rows {
            return Ok(());
        }
        self.check_cloud_size(rows)?;
        for column in self.columns.iter_mut().flatten() {
            column.resize(rows, None);
        }
        self.rows = rows;
        Ok(())
    }

    /// Returns the track; `None` if there is no point.
    pub(super) fn cloud_to_markers(
        self,
        times: FrameTimes,
        size: Option<[f64; 2]>,
        findings: &mut FindingTally,
    ) -> Result<Option<MarkerTrack>, KeypointError> {
        if self.names.is_empty() || self.rows == 0 {
            return Ok(None);
        }
        let space = self.cloud_marker_space(size, findings)?;
        let wide = space.space_coordinate_count();
        let has_quality = |columns: &KeypointColumns| columns[3].iter().any(Option::is_some);
        let named_columns = self.names.into_iter().zip(self.columns);
        let points = named_columns.map(|((group, name), columns)| {
            let quality = has_quality(&columns);
            let [x, y, z, sure] = columns;
            let place = [x, y, z].into_iter().take(wide);
            MotionMarker {
                group,
                name,
                place: place.map(FrameNumberColumn::from_decimals).collect(),
                quality: quality.then(|| FrameNumberColumn::from_decimals(sure)),
            }
        });
        let limbs = |points: &[MotionMarker]| keypoints_names::limbs_between_points(points);
        let points: Vec<MotionMarker> = points.collect();
        let limbs = limbs(&points);
        let markers = MarkerTrack::new(times, space, points)
            .and_then(|markers| markers.with_marker_limbs(limbs))
            .map_err(|error| KeypointError::Track(error.to_string()))?;
        Ok(Some(
            markers
                .with_capture_method(CaptureMethod::Estimated)
                .with_quality_meaning(QualityMeaning::Confidence),
        ))
    }

    fn cloud_marker_space(
        &self,
        size: Option<[f64; 2]>,
        findings: &mut FindingTally,
    ) -> Result<MarkerSpace, KeypointError> {
        let frame = |[width, height]: [f64; 2]| PointPictureSize { width, height };
        Ok(match self.kind {
            PointSpace::World => MarkerSpace::World(SpaceConvention {
                metres_per_unit: 1.0,
                axes: "-Y,+X".parse().map_err(|_| KeypointError::Track("axes".to_owned()))?,
            }),
            // No point of a picture is within its first pixel only.
            PointSpace::Pixels if self.largest == [1.0; 2] => {
                let text = match self.least < 0.0 {
                    true => {
                        "places are from -1 to 1 in the picture's width and height: angles between them need its proportions"
                    }
                    false => PICTURE_SHARES_MESSAGE,
                };
                findings.add_limited_note("shares of the picture", None, || text);
                MarkerSpace::Image(frame([1.0, 1.0]))
            }
            PointSpace::Pixels => MarkerSpace::Image(frame(size.unwrap_or_else(|| {
                let largest_size = self.largest.map(f64::ceil);
                findings.add_limited_note("pictures of unknown size", None, || {
                    format!(
                        "the size of the pictures is not stated; points reach {} by {} pixels",
                        largest_size[0], largest_size[1]
                    )
                });
                largest_size
            }))),
            PointSpace::Share => {
                findings.add_limited_note("shares of the picture", None, || PICTURE_SHARES_MESSAGE);
                MarkerSpace::Depth(frame([1.0, 1.0]))
            }
        })
    }
}
