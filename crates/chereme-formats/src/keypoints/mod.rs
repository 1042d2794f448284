//! JSON of points that were estimated from film: OpenPose, one file a frame or one for a film, and MediaPipe's landmarks.
//!
//! Every person of OpenPose becomes a track of its own; from frame to frame a person is the one with the same number, or
//! without numbers the one whose mean position is nearest. OpenPose states neither the rate of the film nor, in files of
//! one frame, the size of its pictures.
//!
//! ```
//! use chereme_formats::keypoints::{self, KeypointReader};
//! use chereme_motion::FrameRate;
//!
//! let frame = br#"{"version":1.3,"people":[{"pose_keypoints_2d":[10.5,20,0.9, 0,0,0]}]}"#;
//! assert!(keypoints::is_keypoints(frame));
//! let mut reader = KeypointReader::default();
//! reader.push_keypoint_document(Some(0), frame)?;
//! let (tracks, _) = reader.finish_keypoint_tracks(FrameRate::new(25, 1).ok())?;
//! assert_eq!(tracks.tracks.len(), 1);
//! # Ok::<(), keypoints::KeypointError>(())
//! ```

mod cloud;
mod keypoints_clock;
mod keypoints_hands;
mod keypoints_names;
#[cfg(test)]
mod tests;

use chereme_motion::FrameRate;
use serde_json::{Map, Value};

use crate::finding::ImportFinding;
use crate::tally::FindingTally;
use crate::tracks::{CapturedTrackContent, CapturedTracks, FileTrack};
use cloud::{KeypointSample, PersonCloud, PointSpace};
use keypoints_clock::KeypointClock;
pub(crate) use keypoints_hands::has_sides;

/// Frames a second if neither the file nor the caller has a rate.
pub const DEFAULT_KEYPOINT_FPS: u32 = 25;
/// The most people that are followed.
const MAX_FOLLOWED_PEOPLE: usize = 16;
/// The greatest number that a frame may have.
const MAX_FRAME_NUMBER: u64 = 5_184_000;

/// Why bytes could not be read as points from film.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum KeypointError {
    /// The bytes are not JSON.
    #[error("{0}")]
    Json(String),
    /// No frame has a point.
    #[error("the file holds no points")]
    Empty,
    /// There are more points than any film has.
    #[error("it has more than {0} places of points")]
    Large(usize),
    /// The number of a frame is out of range.
    #[error("frame {0} is beyond the last possible one")]
    Frame(u64),
    /// The points cannot be a track.
    #[error("{0}")]
    Track(String),
}

/// Returns whether a file that begins with these bytes holds points of OpenPose or MediaPipe.
#[must_use]
pub fn is_keypoints(head: &[u8]) -> bool {
    let head_text = String::from_utf8_lossy(&head[..head.len().min(1 << 14)]);
    let text = head_text.trim_start_matches('\u{feff}').trim_start();
    let lower = text.to_ascii_lowercase();
    text.starts_with(['{', '['])
        && (lower.contains("\"people\"") || lower.contains("_keypoints_") || lower.contains("landmarks\""))
        && (!lower.contains("\"categoryname\"") || keypoints_hands::has_sides(&lower))
}

/// Returns the prefix and the number of the name of an OpenPose file of one frame:
/// `take_000000000012_keypoints.json`.
#[must_use]
pub fn frame_of_name(name: &str) -> Option<(&str, u64)> {
    let stem = name.strip_suffix(".json")?.strip_suffix("_keypoints")?;
    let (prefix, number) = stem.rsplit_once('_')?;
    let digits = !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit());
    (digits && !prefix.is_empty()).then_some((prefix, number.parse().ok()?))
}

/// Collects frames of points.
#[derive(Debug, Default)]
pub struct KeypointReader {
    films: Vec<CameraFilm>,
    /// The number of the first frame, which counts as 0.
    first: Option<u64>,
    clock: KeypointClock,
    findings: FindingTally,
}

/// The people of one camera, and the landmarks that belong to no particular person.
#[derive(Debug, Default)]
struct CameraFilm {
    camera: String,
    size: Option<[f64; 2]>,
    people: Vec<PersonCloud>,
    marks: Vec<PersonCloud>,
}

impl KeypointReader {
    /// Adds a document: one frame with the number `frame`, or a whole film if its frames have numbers of their own.
    ///
    /// # Errors
    /// [`KeypointError`] if the bytes are not JSON of points, or there are too many of them.
    pub fn push_keypoint_document(&mut self, frame: Option<u64>, bytes: &[u8]) -> Result<(), KeypointError> {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let document: Value = serde_json::from_slice(bytes)
            .map_err(|error| KeypointError::Json(format!("line {}: {error}", error.line())))?;
        match &document {
            Value::Array(all) if all.iter().any(|camera| film_document_frames(camera).is_some()) => {
                // All cameras count from the first frame of any of them.
                for camera in all {
                    let first = first_number(camera)?;
                    self.first = self.first.into_iter().chain(first).min();
                }
                for camera in all {
                    self.add_camera_frames(camera)?;
                }
            }
            Value::Array(all) => self.add_film_frames(0, frame.unwrap_or(0), all)?,
            other if film_document_frames(other).is_some() => self.add_camera_frames(other)?,
            other => self.add_film_frame(0, frame.unwrap_or(0), other)?,
        }
        Ok(())
    }

    /// Adds frames with the numbers that all of them state, else one after the other from `begin` on.
    fn add_film_frames(&mut self, film: usize, begin: u64, frames: &[Value]) -> Result<(), KeypointError> {
        let stated = stated_frame_numbers(frames);
        for (at, one) in frames.iter().enumerate() {
            let number = stated.as_ref().map_or(begin + at as u64, |all| all[at]);
            self.add_film_frame(film, number, one)?;
        }
        Ok(())
    }

    /// Adds the frames of one camera: an object of frames by number, or an array.
    fn add_camera_frames(&mut self, document: &Value) -> Result<(), KeypointError> {
        let name = document.get("camera").map(|value| match value {
            Value::String(name) => name.clone(),
            other => other.to_string(),
        });
        let number = |key: &str| document.get(key).and_then(Value::as_f64);
        let rates = ["fps", "frame_rate", "frameRate", "framerate"];
        self.clock.take_stated_rate(rates.into_iter().find_map(number));
        let film = self.films.len();
        self.films.push(CameraFilm {
            camera: name.unwrap_or_default(),
            size: number("width")
                .zip(number("height"))
                .map(|(width, height)| [width, height]),
            ..CameraFilm::default()
        });
        match film_document_frames(document) {
            Some(Value::Object(frames)) => {
                for (number, value) in numbered_film_frames(frames)? {
                    self.add_film_frame(film, number, value)?;
                }
            }
            Some(Value::Array(frames)) => self.add_film_frames(film, 0, frames)?,
            _ => {}
        }
        Ok(())
    }

    fn add_film_frame(&mut self, film: usize, number: u64, document: &Value) -> Result<(), KeypointError> {
        let first = *self.first.get_or_insert(number);
        let row = number.checked_sub(first).unwrap_or(number);
        if row > MAX_FRAME_NUMBER {
            return Err(KeypointError::Frame(number));
        }
        while self.films.len() <= film {
            self.films.push(CameraFilm::default());
        }
        self.clock.take_frame_time(row, document);
        let film = &mut self.films[film];
        let row = row as usize;
        match document.get("people") {
            Some(Value::Array(people)) => {
                film.add_frame_people(row, people, &mut self.findings)?;
            }
            _ => {
                if let Value::Object(object) = document {
                    film.add_frame_landmarks(row, object, &mut self.findings)?;
                }
            }
        }
        film.extend_film_rows(row + 1)
    }

    /// Returns the tracks, one for each person, camera and space; `rate` is that of the film if the caller knows it.
    ///
    /// # Errors
    /// [`KeypointError::Empty`] if there is no point at all.
    pub fn finish_keypoint_tracks(
        mut self,
        rate: Option<FrameRate>,
    ) -> Result<(CapturedTracks, Vec<ImportFinding>), KeypointError> {
        let rows = self.films.iter().map(CameraFilm::film_row_count).max().unwrap_or(0);
        let (times, offset) = self.clock.keypoint_frame_times(rows, rate, &mut self.findings)?;
        if let Some(first) = self.first.filter(|first| *first > 0) {
            self.findings.push_note_finding(
                None,
                format!("it begins with frame {first} of its film; that is 0 s here"),
            );
        }
        let mut tracks = CapturedTracks::default();
        let several = self.films.len() > 1;
        for film in self.films {
            let prefix = match (several, film.camera.as_str()) {
                (true, camera) if !camera.is_empty() => format!("{camera} "),
                _ => String::new(),
            };
            let numbered_people = film.people.into_iter().enumerate();
            let people = numbered_people.map(|(at, cloud)| {
                let name = match at {
                    0 => "landmarks".to_owned(),
                    at => format!("landmarks {}", at + 1),
                };
                (name, cloud)
            });
            let marks = film.marks.into_iter().map(|cloud| {
                let name = match cloud.cloud_point_space() {
                    PointSpace::World => "world landmarks",
                    PointSpace::Pixels | PointSpace::Share => "landmarks",
                };
                (name.to_owned(), cloud)
            });
            // The findings are lent to each cloud in turn.
            for (name, cloud) in people.chain(marks).collect::<Vec<_>>() {
                let markers = cloud.cloud_to_markers(times.clone(), film.size, &mut self.findings)?;
                let Some(markers) = markers else { continue };
                let name = format!("{prefix}{name}");
                let mut track = FileTrack::new(name, CapturedTrackContent::Markers(markers));
                track.offset = offset;
                tracks.tracks.push(track);
            }
        }
        if tracks.tracks.is_empty() {
            return Err(KeypointError::Empty);
        }
        self.findings
            .push_note_finding(None, "the points are estimated from film");
        Ok((tracks, self.findings.finish_finding_tally()))
    }
}

/// Returns the frames of a document of a whole film.
fn film_document_frames(document: &Value) -> Option<&Value> {
    let named = ["frames", "results"].into_iter();
    named
        .filter_map(|key| document.get(key))
        .find(|value| value.is_array() || value.is_object())
}

/// Returns the frames of an object by their numbers.
fn numbered_film_frames(frames: &Map<String, Value>) -> Result<Vec<(u64, &Value)>, KeypointError> {
    let mut numbered = Vec::with_capacity(frames.len());
    for (key, value) in frames {
        let parsed_number = key.trim().parse();
        let number = parsed_number.map_err(|_| KeypointError::Json(format!("{key:?} is no number of a frame")))?;
        numbered.push((number, value));
    }
    numbered.sort_by_key(|(number, _)| *number);
    Ok(numbered)
}

/// Returns the number of the first frame of a camera.
fn first_number(camera: &Value) -> Result<Option<u64>, KeypointError> {
    Ok(match film_document_frames(camera) {
        Some(Value::Object(frames)) => numbered_film_frames(frames)?.first().map(|(number, _)| *number),
        Some(Value::Array(frames)) => stated_frame_numbers(frames).map_or(Some(0), |all| all.first().copied()),
        _ => None,
    })
}

/// Returns the numbers that frames state under the same name, each greater than the one before.
fn stated_frame_numbers(frames: &[Value]) -> Option<Vec<u64>> {
    let keys = [
        "frame",
        "frame_id",
        "frameId",
        "frame_number",
        "frameNumber",
        "frame_index",
        "frameIndex",
        "image_id",
    ];
    let stated = |key: &str| -> Option<Vec<u64>> {
        let numbers = frames.iter().map(|frame| frame.get(key)?.as_u64());
        numbers.collect()
    };
    let mut all = keys.into_iter().filter_map(stated);
    all.find(|numbers| !numbers.is_empty() && numbers.is_sorted_by(|a, b| a < b))
}

impl CameraFilm {
    fn film_row_count(&self) -> usize {
        let clouds = self.people.iter().chain(&self.marks);
        clouds.map(PersonCloud::cloud_row_count).max().unwrap_or(0)
    }

    /// Adds the people of a frame, each to the track of the person with the same number, or without numbers to that of
    /// the person whose last position was nearest.
    fn add_frame_people(
        &mut self,
        row: usize,
        people: &[Value],
        findings: &mut FindingTally,
    ) -> Result<(), KeypointError> {
        let mut bodies: Vec<Vec<KeypointSample>> = Vec::new();
        let mut free: Vec<usize> = (0..self.people.len()).collect();
        for person in people.iter().filter_map(Value::as_object) {
            let points = openpose_points(person, findings);
            if !points.iter().any(KeypointSample::is_seen) {
                continue;
            }
            match person_number(person).and_then(|number| self.numbered_person(number, &free)) {
                Some(numbered) => {
                    free.retain(|index| *index != numbered);
                    self.people[numbered].push_cloud_points(row, points)?;
                }
                None => bodies.push(points),
            }
        }
        free.retain(|index| self.people[*index].stated_person_number().is_none());
        self.add_unnumbered_people(row, bodies, free, findings)
    }

    /// Returns the index of the person with a number, who is new if nobody has it; `None` if another body of the frame
    /// is that person already, or no further person is followed.
    fn numbered_person(&mut self, number: u64, free: &[usize]) -> Option<usize> {
        let mut people = self.people.iter();
        match people.position(|person| person.stated_person_number() == Some(number)) {
            // A number that occurs twice in a frame identifies nobody.
            Some(known) => free.contains(&known).then_some(known),
            None if self.people.len() == MAX_FOLLOWED_PEOPLE => None,
            None => {
                self.people.push(PersonCloud::of_person(number));
                Some(self.people.len() - 1)
            }
        }
    }

    /// Adds bodies without a number, each to the nearest person of those who are free.
    fn add_unnumbered_people(
        &mut self,
        row: usize,
        mut bodies: Vec<Vec<KeypointSample>>,
        mut free: Vec<usize>,
        findings: &mut FindingTally,
    ) -> Result<(), KeypointError> {
        // Pairs the nearest first, so that two people who pass each other are not exchanged because of their order in
        // the file.
        while !bodies.is_empty() {
            let (body, known) = match self.nearest_person(&bodies, &free) {
                Some(nearest) => nearest,
                None if self.people.len() == MAX_FOLLOWED_PEOPLE => {
                    let left = bodies.len();
                    findings.add_limited_warning("people who are left out", None, || {
                        format!("frame {row} shows {left} more people than the {MAX_FOLLOWED_PEOPLE} who are followed")
                    });
                    return Ok(());
                }
                None => {
                    self.people.push(PersonCloud::new(PointSpace::Pixels));
                    (0, self.people.len() - 1)
                }
            };
            free.retain(|index| *index != known);
            let points = bodies.remove(body);
            if self.people[known].is_person_leap(&points) {
                findings.add_limited_warning("people who jump", None, || format!("in row {row} a person is far from the last place of the person who is nearest, and may be another one"));
            }
            self.people[known].push_cloud_points(row, points)?;
        }
        Ok(())
    }

    /// Returns the body and the free person that are nearest to each other, the first of several in the file's order.
    fn nearest_person(&self, bodies: &[Vec<KeypointSample>], free: &[usize]) -> Option<(usize, usize)> {
        let pairs = bodies.iter().enumerate().flat_map(|(body, points)| {
            let body_middle = cloud::mean_seen_position(points);
            free.iter()
                .map(move |&known| (self.people[known].distance_from_last(body_middle), body, known))
        });
        let nearest = pairs.reduce(|best, other| if other.0 < best.0 { other } else { best });
        nearest.map(|(_, body, known)| (body, known))
    }

    /// Adds MediaPipe's landmarks of a frame.
    fn add_frame_landmarks(
        &mut self,
        row: usize,
        frame: &Map<String, Value>,
        findings: &mut FindingTally,
    ) -> Result<(), KeypointError> {
        let mut space_points: [(PointSpace, Vec<KeypointSample>); 2] =
            [(PointSpace::Share, Vec::new()), (PointSpace::World, Vec::new())];
        let sides = keypoints_hands::hand_landmark_sides(frame);
        for (key, value) in frame {
            let lower = key.to_ascii_lowercase();
            if !lower.ends_with("landmarks") {
                continue;
            }
            let points = &mut space_points[usize::from(lower.contains("world"))].1;
            if !keypoints_hands::add_hand_landmarks(key, value, &sides, points, findings) {
                cloud::add_mediapipe_landmarks(key, value, points);
            }
        }
        for (kind, points) in space_points {
            if points.is_empty() {
                continue;
            }
            let cloud_index = match self.marks.iter().position(|cloud| cloud.cloud_point_space() == kind) {
                Some(at) => at,
                None => {
                    self.marks.push(PersonCloud::new(kind));
                    self.marks.len() - 1
                }
            };
            self.marks[cloud_index].push_cloud_points(row, points)?;
        }
        Ok(())
    }

    /// Extends every track with gaps to `rows` frames.
    fn extend_film_rows(&mut self, rows: usize) -> Result<(), KeypointError> {
        let mut all = self.people.iter_mut().chain(&mut self.marks);
        all.try_for_each(|cloud| cloud.extend_cloud_rows(rows))
    }
}

/// Returns the points of a person of OpenPose in the picture.
fn openpose_points(person: &Map<String, Value>, findings: &mut FindingTally) -> Vec<KeypointSample> {
    let mut points = Vec::new();
    for (group, values) in person {
        let Value::Array(values) = values else {
            continue;
        };
        if group.ends_with("_3d") && !values.is_empty() {
            findings.add_limited_warning("points in three dimensions", None, || {
                format!("the points {group:?} in three dimensions are left out: their unit is not stated")
            });
        }
        if group.ends_with("_keypoints_2d") || group.ends_with("_keypoints") {
            cloud::add_openpose_triples(group, values, &mut points);
        }
    }
    points
}

/// Returns the number of a person of OpenPose; -1 is none.
fn person_number(person: &Map<String, Value>) -> Option<u64> {
    match person.get("person_id")? {
        Value::Array(all) => all.first()?.as_u64(),
        other => other.as_u64(),
    }
}
