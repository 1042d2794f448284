//! `.pose` files: points estimated from film, as the library *pose-format* writes them (versions 0.0 to 0.2).
//!
//! All components on the picture become one track of markers; landmarks in metres become another one. A point
//! with confidence 0 is a gap. Every person becomes tracks of its own: the one in the same place of every frame, in
//! version 0.0 the one with the same number.

#[cfg(test)]
mod tests;

use chereme_motion::column::{ColumnGaps, FrameNumberColumn};
use chereme_motion::markers::PointPictureSize;
use chereme_motion::{
    CaptureMethod, FrameTimes, MarkerSpace, MarkerTrack, MotionMarker, QualityMeaning, SpaceConvention,
};

use crate::finding::ImportFinding;
use crate::tally::FindingTally;
use crate::tracks::{CapturedTrackContent, CapturedTracks, FileTrack, rate_of};

/// Why bytes could not be read as a `.pose` file.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum PoseFileError {
    /// The version is not one of those known.
    #[error("version {0} of .pose is not known; 0.0, 0.1 and 0.2 are")]
    Version(String),
    /// The file ends within this part.
    #[error("the file ends within its {0}; it is cut short")]
    Short(&'static str),
    /// The file has no points or no frames.
    #[error("the file holds no points")]
    Empty,
    /// The frame rate is not a positive number.
    #[error("the frame rate is {0}, not a positive number")]
    Rate(String),
    /// A component's numbers are not written as coordinates and confidence.
    #[error("the component {name:?} has the format {format:?}; XYC and XYZC are known")]
    Format {
        /// The component.
        name: String,
        /// Its format.
        format: String,
    },
    /// The points cannot be a track.
    #[error("{0}")]
    Track(String),
}

/// The most people that become tracks.
const MAX_POSE_PEOPLE: usize = 16;
/// The most numbers of all people.
const MAX_POSE_NUMBERS: usize = 400_000_000;

/// Landmarks in metres are within this distance of the hips; greater numbers were multiplied by the
/// picture's size.
const FARTHEST_METRES: f32 = 10.0;

struct PoseFileBytes<'b>(&'b [u8]);

impl<'b> PoseFileBytes<'b> {
    fn take_pose_bytes(&mut self, count: usize, part: &'static str) -> Result<&'b [u8], PoseFileError> {
        let (taken, rest) = self.0.split_at_checked(count).ok_or(PoseFileError::Short(part))?;
        self.0 = rest;
        Ok(taken)
    }

    fn read_pose_u16(&mut self, part: &'static str) -> Result<usize, PoseFileError> {
        let bytes = self.take_pose_bytes(2, part)?;
        Ok(usize::from(u16::from_le_bytes([bytes[0], bytes[1]])))
    }

    fn read_pose_f32(&mut self, part: &'static str) -> Result<f32, PoseFileError> {
        let bytes = self.take_pose_bytes(4, part)?;
        Ok(f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]))
    }

    fn read_pose_text(&mut self, part: &'static str) -> Result<String, PoseFileError> {
        let length = self.read_pose_u16(part)?;
        Ok(String::from_utf8_lossy(self.take_pose_bytes(length, part)?).into_owned())
    }
}

struct PoseComponent {
    name: String,
    has_depth: bool,
    points: Vec<String>,
    limbs: Vec<[usize; 2]>,
}

struct PoseFileHeader {
    version: f32,
    size: [usize; 3],
    components: Vec<PoseComponent>,
}

/// The frames of all people.
struct PoseFileBody {
    rate: f64,
    frames: usize,
    dimensions: usize,
    people: Vec<PosePerson>,
    /// The most people in a frame.
    crowd: usize,
}

/// The numbers of one person, point after point and frame after frame.
#[derive(Default)]
struct PosePerson {
    /// Coordinates by `[frame][point][dimension]`.
    places: Vec<f32>,
    /// Confidence by `[frame][point]`.
    confidence: Vec<f32>,
}

impl PosePerson {
    fn is_seen(&self) -> bool {
        self.confidence.iter().any(|sure| *sure > 0.0)
    }

    /// Adds gaps until there are `frames` frames.
    fn pad_to_frames(&mut self, frames: usize, points: usize, dimensions: usize) {
        self.places.resize(frames * points * dimensions, 0.0);
        self.confidence.resize(frames * points, 0.0);
    }
}

/// Reads a `.pose` file.
///
/// # Errors
/// [`PoseFileError`] if the bytes are not a `.pose` file or are cut short.
pub fn read_pose_file(bytes: &[u8]) -> Result<(CapturedTracks, Vec<ImportFinding>), PoseFileError> {
    let mut findings = FindingTally::default();
    let mut bytes = PoseFileBytes(bytes);
    let header = read_pose_header(&mut bytes)?;
    let points = header.components.iter().map(|component| component.points.len()).sum();
    if points == 0 {
        return Err(PoseFileError::Empty);
    }
    let body = match header.version {
        version if is_pose_version(version, 0.0) => interleaved(&mut bytes, &header, points)?,
        version if is_pose_version(version, 0.1) || is_pose_version(version, 0.2) => {
            read_stacked_body(&mut bytes, &header, points)?
        }
        version => return Err(PoseFileError::Version(version.to_string())),
    };
    if body.frames == 0 {
        return Err(PoseFileError::Empty);
    }
    if body.crowd > MAX_POSE_PEOPLE {
        let others = body.crowd - MAX_POSE_PEOPLE;
        findings.push_warning_finding(
            None,
            format!("{others} more people are in the film; only the first {MAX_POSE_PEOPLE} were read"),
        );
    }
    let rate = rate_of(body.rate).ok_or_else(|| PoseFileError::Rate(body.rate.to_string()))?;
    let mut tracks = CapturedTracks::default();
    let nobody = !body.people.iter().any(PosePerson::is_seen);
    let seen = body.people.iter().filter(|person| person.is_seen());
    // If nobody is seen, the points of the first one are gaps.
    let people = seen.chain(body.people.first().filter(|_| nobody));
    for (number, person) in (1..).zip(people) {
        for is_world in [false, true] {
            let picked = |component: &PoseComponent| component.name.contains("WORLD") == is_world;
            let track = build_pose_track(&header, &body, person, picked, is_world, &mut findings).map(|space| {
                space.and_then(|(space, points, limbs)| {
                    MarkerTrack::new(FrameTimes::Even(rate), space, points)
                        .and_then(|markers| markers.with_marker_limbs(limbs))
                        .map_err(|error| PoseFileError::Track(error.to_string()))
                })
            });
            let Some(markers) = track else { continue };
            let markers = markers?
                .with_capture_method(CaptureMethod::Estimated)
                .with_quality_meaning(QualityMeaning::Confidence);
            let base_name = if is_world { "world landmarks" } else { "landmarks" };
            let name = match number {
                1 => base_name.to_owned(),
                number => format!("{base_name} {number}"),
            };
            tracks
                .tracks
                .push(FileTrack::new(name, CapturedTrackContent::Markers(markers)));
        }
    }
    let is_flat = !header.components.iter().any(|component| component.has_depth);
    let note = match is_flat {
        true => "the points are estimated from film; they have no depth",
        false => "the points are estimated from film",
    };
    findings.push_note_finding(None, note);
    Ok((tracks, findings.finish_finding_tally()))
}

fn is_pose_version(version: f32, known: f32) -> bool {
    (version - known).abs() < 1e-3
}

fn read_pose_header(bytes: &mut PoseFileBytes<'_>) -> Result<PoseFileHeader, PoseFileError> {
    let part = "header";
    let version = bytes.read_pose_f32(part)?;
    if ![0.0, 0.1, 0.2].iter().any(|known| is_pose_version(version, *known)) {
        return Err(PoseFileError::Version(version.to_string()));
    }
    let size = [
        bytes.read_pose_u16(part)?,
        bytes.read_pose_u16(part)?,
        bytes.read_pose_u16(part)?,
    ];
    let mut components = Vec::new();
    for _ in 0..bytes.read_pose_u16(part)? {
        let name = bytes.read_pose_text(part)?;
        let format = bytes.read_pose_text(part)?;
        let has_depth = match format.as_str() {
            "XYC" => false,
            "XYZC" => true,
            _ => return Err(PoseFileError::Format { name, format }),
        };
        let (points, limbs, colours) = (
            bytes.read_pose_u16(part)?,
            bytes.read_pose_u16(part)?,
            bytes.read_pose_u16(part)?,
        );
        let mut component = PoseComponent {
            name,
            has_depth,
            points: Vec::new(),
            limbs: Vec::new(),
        };
        for _ in 0..points {
            component.points.push(bytes.read_pose_text(part)?);
        }
        for _ in 0..limbs {
            component
                .limbs
                .push([bytes.read_pose_u16(part)?, bytes.read_pose_u16(part)?]);
        }
        bytes.take_pose_bytes(6 * colours, part)?;
        components.push(component);
    }
    Ok(PoseFileHeader {
        version,
        size,
        components,
    })
}

/// Reads the body of versions 0.1 and 0.2: all coordinates, then all confidences.
fn read_stacked_body(
    bytes: &mut PoseFileBytes<'_>,
    header: &PoseFileHeader,
    points: usize,
) -> Result<PoseFileBody, PoseFileError> {
    let part = "frames";
    let dimensions = dimensions(header);
    let second = is_pose_version(header.version, 0.2);
    let rate = if second {
        f64::from(bytes.read_pose_f32(part)?)
    } else {
        bytes.read_pose_u16(part)? as f64
    };
    let stated_frames = if second {
        let bytes = bytes.take_pose_bytes(4, part)?;
        u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]) as usize
    } else {
        bytes.read_pose_u16(part)?
    };
    let people = bytes.read_pose_u16(part)?;
    if people == 0 {
        return Err(PoseFileError::Empty);
    }
    let frame = people * points * (dimensions + 1) * 4;
    // The count of version 0.1 overflows, and the length of the file is right; but if the two differ by anything else
    // than overflows, the file is cut short, and what would be taken for its confidences are coordinates.
    let possible_frames = bytes.0.len().checked_div(frame).unwrap_or(0);
    let frames = if second { stated_frames } else { possible_frames };
    let overflow = usize::from(u16::MAX) + 1;
    if frames > possible_frames || (frame > 0 && possible_frames % overflow != stated_frames % overflow && !second) {
        return Err(PoseFileError::Short(part));
    }
    let values = frames * people * points;
    let places = decode_pose_floats(bytes.take_pose_bytes(4 * values * dimensions, part)?);
    let confidence = decode_pose_floats(bytes.take_pose_bytes(4 * values, part)?);
    let of_person = |all: &[f32], person: usize, width: usize| -> Vec<f32> {
        let of_frame = all.chunks(people * width);
        let person_numbers = of_frame.map(|frame| &frame[person * width..(person + 1) * width]);
        person_numbers.flatten().copied().collect()
    };
    let all_people = (0..people.min(MAX_POSE_PEOPLE)).map(|person| PosePerson {
        places: of_person(&places, person, points * dimensions),
        confidence: of_person(&confidence, person, points),
    });
    Ok(PoseFileBody {
        rate,
        frames,
        dimensions,
        people: all_people.collect(),
        crowd: people,
    })
}

/// Reads the body of version 0.0: frame after frame, person after person.
fn interleaved(
    bytes: &mut PoseFileBytes<'_>,
    header: &PoseFileHeader,
    points: usize,
) -> Result<PoseFileBody, PoseFileError> {
    let part = "frames";
    let dimensions = dimensions(header);
    let rate = bytes.read_pose_u16(part)? as f64;
    let frames = bytes.read_pose_u16(part)?;
    let mut numbered_people: Vec<(i64, PosePerson)> = Vec::new();
    let mut crowd = 0;
    for frame in 0..frames {
        let people = bytes.read_pose_u16(part)?;
        crowd = crowd.max(people);
        let mut here = Vec::new();
        for place in 0..people {
            let stated_number = bytes.read_pose_u16(part)? as u16 as i16;
            // People without numbers of their own are those in the same place of every frame.
            let number = match i64::from(stated_number) {
                number if number < 0 || here.contains(&number) => -1 - place as i64,
                number => number,
            };
            here.push(number);
            let person_index = match numbered_people.iter().position(|(known, _)| *known == number) {
                None if numbered_people.len() < MAX_POSE_PEOPLE => {
                    // Frames without people take two bytes and become gaps of every point.
                    let all = frames.saturating_mul(points) * (numbered_people.len() + 1);
                    if all > MAX_POSE_NUMBERS / 4 {
                        return Err(PoseFileError::Short(part));
                    }
                    numbered_people.push((number, PosePerson::default()));
                    Some(numbered_people.len() - 1)
                }
                known => known,
            };
            let mut person = person_index.map(|at| &mut numbered_people[at].1);
            if let Some(person) = &mut person {
                person.pad_to_frames(frame, points, dimensions);
            }
            for component in &header.components {
                let width = if component.has_depth { 4 } else { 3 };
                for _ in &component.points {
                    let values = decode_pose_floats(bytes.take_pose_bytes(4 * width, part)?);
                    if let Some(person) = &mut person {
                        let axes = (0..dimensions).map(|axis| values[..width - 1].get(axis).copied().unwrap_or(0.0));
                        person.places.extend(axes);
                        person.confidence.push(values[width - 1]);
                    }
                }
            }
        }
    }
    if numbered_people.is_empty() && frames.saturating_mul(points) <= MAX_POSE_NUMBERS / 4 {
        numbered_people.push((0, PosePerson::default()));
    }
    let people = numbered_people.into_iter().map(|(_, mut person)| {
        person.pad_to_frames(frames, points, dimensions);
        person
    });
    let people: Vec<PosePerson> = people.collect();
    Ok(PoseFileBody {
        rate,
        frames: if people.is_empty() { 0 } else { frames },
        dimensions,
        crowd: crowd.max(people.len()),
        people,
    })
}

fn dimensions(header: &PoseFileHeader) -> usize {
    let has_depth = header.components.iter().any(|component| component.has_depth);
    if has_depth { 3 } else { 2 }
}

fn decode_pose_floats(bytes: &[u8]) -> Vec<f32> {
    let words = bytes.chunks_exact(4);
    words
        .map(|word| f32::from_le_bytes([word[0], word[1], word[2], word[3]]))
        .collect()
}

type PoseTrackParts = (MarkerSpace, Vec<MotionMarker>, Vec<[usize; 2]>);

/// Returns the points of the picked components, if any.
fn build_pose_track(
    header: &PoseFileHeader,
    body: &PoseFileBody,
    person: &PosePerson,
    picked: impl Fn(&PoseComponent) -> bool,
    is_world: bool,
    findings: &mut FindingTally,
) -> Option<Result<PoseTrackParts, PoseFileError>> {
    let has_depth = header
        .components
        .iter()
        .any(|component| picked(component) && component.has_depth);
    let [width, height, _] = header.size.map(|size| size.max(1) as f64);
    let frame = PointPictureSize { width, height };
    let space = match (is_world, has_depth) {
        (true, _) => MarkerSpace::World(SpaceConvention {
            metres_per_unit: 1.0,
            axes: "-Y,+X".parse().ok()?,
        }),
        (false, true) => MarkerSpace::Depth(frame),
        (false, false) => MarkerSpace::Image(frame),
    };
    let count = space.space_coordinate_count();
    let all: usize = header.components.iter().map(|component| component.points.len()).sum();
    let (mut points, mut limbs) = (Vec::new(), Vec::new());
    let mut begin = 0;
    let component_names = header.components.iter().map(|component| component.name.as_str());
    let groups = crate::tracks::unique_track_names(component_names, "component");
    for (component, group) in header.components.iter().zip(&groups) {
        if !picked(component) {
            begin += component.points.len();
            continue;
        }
        let names = crate::tracks::unique_track_names(component.points.iter().map(String::as_str), "point");
        let first = points.len();
        // Files draw points as limbs to themselves, and name points that were left out.
        let is_limb = |limb: &&[usize; 2]| limb[0] != limb[1] && limb.iter().all(|end| *end < component.points.len());
        limbs.extend(
            component
                .limbs
                .iter()
                .filter(is_limb)
                .map(|[a, b]| [a + first, b + first]),
        );
        for (at, name) in names.into_iter().enumerate() {
            points.push(build_pose_marker(body, person, begin + at, all, count, group, name));
        }
        begin += component.points.len();
    }
    if points.is_empty() {
        return None;
    }
    if is_world {
        unscale(&mut points, [width, height], findings);
    }
    limbs.sort_unstable();
    limbs.dedup();
    Some(Ok((space, points, limbs)))
}

fn build_pose_marker(
    body: &PoseFileBody,
    person: &PosePerson,
    point: usize,
    points: usize,
    coordinates: usize,
    group: &str,
    name: String,
) -> MotionMarker {
    let point_index = |frame: usize| frame * points + point;
    let sure: Vec<f32> = (0..body.frames)
        .map(|frame| person.confidence[point_index(frame)])
        .collect();
    // The format has no gaps: a point without confidence has none of its numbers.
    let unsure_frames = (0u32..)
        .zip(&sure)
        .filter(|(_, sure)| !sure.is_finite() || **sure <= 0.0);
    let gaps = ColumnGaps::from_gap_frames(unsure_frames.map(|(frame, _)| frame));
    let axis = |axis: usize| {
        let values = (0..body.frames).map(|frame| {
            let coordinate = person.places.get(point_index(frame) * body.dimensions + axis);
            coordinate.copied().filter(|_| axis < body.dimensions).unwrap_or(0.0)
        });
        let column = FrameNumberColumn::from_single_floats(values.collect());
        column.clone().with_gaps(&gaps).unwrap_or(column)
    };
    MotionMarker {
        group: group.to_owned(),
        name,
        place: (0..coordinates).map(axis).collect(),
        quality: Some(FrameNumberColumn::from_single_floats(sure)),
    }
}

/// Divides landmarks in metres by the picture's size if the writer multiplied them by it.
fn unscale(points: &mut [MotionMarker], size: [f64; 2], findings: &mut FindingTally) {
    let largest = |point: &MotionMarker| {
        let values = point.place[..2]
            .iter()
            .flat_map(|column| column.column_values().flatten());
        values.fold(0.0, |most: f64, value| most.max(value.abs()))
    };
    if points.iter().map(largest).fold(0.0, f64::max) <= f64::from(FARTHEST_METRES) {
        return;
    }
    for point in points {
        for (column, size) in point.place.iter_mut().zip(size) {
            let metres = column
                .column_values()
                .map(|value| value.map_or(f64::NAN, |value| value / size));
            *column = FrameNumberColumn::from_double_floats(metres.collect());
        }
    }
    findings.push_note_finding(
        None,
        "the landmarks in metres were multiplied by the picture's width and height; they are divided by them again",
    );
}
