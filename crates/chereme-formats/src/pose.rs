//! `.pose` files: points estimated from film, as the library *pose-format* writes them (versions 0.0 to 0.2).
//!
//! All components on the picture become one track of markers; landmarks in metres become another one. A point
//! with confidence 0 is a gap. Every person becomes tracks of its own: the one in the same place of every frame, in
//! version 0.0 the one with the same number.

#[cfg(test)]
mod tests;

use chereme_motion::column::{Column, Gaps};
use chereme_motion::markers::Frame;
use chereme_motion::{Capture, Convention, Marker, Markers, Quality, Space, Times};

use crate::finding::Finding;
use crate::tally::Findings;
use crate::tracks::{Content, FileTrack, Tracks, rate_of};

/// Why bytes could not be read as a `.pose` file.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Error {
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
const PEOPLE: usize = 16;
/// The most numbers of all people.
const NUMBERS: usize = 400_000_000;

/// Landmarks in metres are within this distance of the hips; greater numbers were multiplied by the
/// picture's size.
const FARTHEST_METRES: f32 = 10.0;

struct Bytes<'b>(&'b [u8]);

impl<'b> Bytes<'b> {
    fn take(&mut self, count: usize, part: &'static str) -> Result<&'b [u8], Error> {
        let (taken, rest) = self.0.split_at_checked(count).ok_or(Error::Short(part))?;
        self.0 = rest;
        Ok(taken)
    }

    fn u16(&mut self, part: &'static str) -> Result<usize, Error> {
        let bytes = self.take(2, part)?;
        Ok(usize::from(u16::from_le_bytes([bytes[0], bytes[1]])))
    }

    fn f32(&mut self, part: &'static str) -> Result<f32, Error> {
        let bytes = self.take(4, part)?;
        Ok(f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]))
    }

    fn text(&mut self, part: &'static str) -> Result<String, Error> {
        let length = self.u16(part)?;
        Ok(String::from_utf8_lossy(self.take(length, part)?).into_owned())
    }
}

struct Component {
    name: String,
    has_depth: bool,
    points: Vec<String>,
    limbs: Vec<[usize; 2]>,
}

struct Header {
    version: f32,
    size: [usize; 3],
    components: Vec<Component>,
}

/// The frames of all people.
struct Body {
    rate: f64,
    frames: usize,
    dimensions: usize,
    people: Vec<Person>,
    /// The most people in a frame.
    crowd: usize,
}

/// The numbers of one person, point after point and frame after frame.
#[derive(Default)]
struct Person {
    /// Coordinates by `[frame][point][dimension]`.
    places: Vec<f32>,
    /// Confidence by `[frame][point]`.
    confidence: Vec<f32>,
}

impl Person {
    fn is_seen(&self) -> bool {
        self.confidence.iter().any(|sure| *sure > 0.0)
    }

    /// Adds gaps until there are `frames` frames.
    fn reach(&mut self, frames: usize, points: usize, dimensions: usize) {
        self.places.resize(frames * points * dimensions, 0.0);
        self.confidence.resize(frames * points, 0.0);
    }
}

/// Reads a `.pose` file.
///
/// # Errors
/// [`Error`] if the bytes are not a `.pose` file or are cut short.
pub fn read(bytes: &[u8]) -> Result<(Tracks, Vec<Finding>), Error> {
    let mut findings = Findings::default();
    let mut bytes = Bytes(bytes);
    let header = header(&mut bytes)?;
    let points = header.components.iter().map(|it| it.points.len()).sum();
    if points == 0 {
        return Err(Error::Empty);
    }
    let body = match header.version {
        version if near(version, 0.0) => interleaved(&mut bytes, &header, points)?,
        version if near(version, 0.1) || near(version, 0.2) => {
            stacked(&mut bytes, &header, points)?
        }
        version => return Err(Error::Version(version.to_string())),
    };
    if body.frames == 0 {
        return Err(Error::Empty);
    }
    if body.crowd > PEOPLE {
        let others = body.crowd - PEOPLE;
        findings.push(Finding::warning(
            None,
            format!("{others} more people are in the film; only the first {PEOPLE} were read"),
        ));
    }
    let rate = rate_of(body.rate).ok_or_else(|| Error::Rate(body.rate.to_string()))?;
    let mut tracks = Tracks::default();
    let nobody = !body.people.iter().any(Person::is_seen);
    let seen = body.people.iter().filter(|it| it.is_seen());
    // If nobody is seen, the points of the first one are gaps.
    let people = seen.chain(body.people.first().filter(|_| nobody));
    for (number, person) in (1..).zip(people) {
        for is_world in [false, true] {
            let picked = |component: &Component| component.name.contains("WORLD") == is_world;
            let of_person = (&body, person);
            let track = track(&header, of_person, picked, is_world, &mut findings).map(|space| {
                space.and_then(|(space, points, limbs)| {
                    Markers::new(Times::Even(rate), space, points)
                        .and_then(|it| it.joined(limbs))
                        .map_err(|error| Error::Track(error.to_string()))
                })
            });
            let Some(markers) = track else { continue };
            let markers = markers?
                .captured(Capture::Estimated)
                .rated(Quality::Confidence);
            let name = if is_world {
                "world landmarks"
            } else {
                "landmarks"
            };
            let name = match number {
                1 => name.to_owned(),
                number => format!("{name} {number}"),
            };
            tracks
                .tracks
                .push(FileTrack::new(name, Content::Markers(markers)));
        }
    }
    let is_flat = !header.components.iter().any(|it| it.has_depth);
    let note = match is_flat {
        true => "the points are estimated from film; they have no depth",
        false => "the points are estimated from film",
    };
    findings.push(Finding::note(None, note));
    Ok((tracks, findings.finish()))
}

fn near(version: f32, known: f32) -> bool {
    (version - known).abs() < 1e-3
}

fn header(bytes: &mut Bytes<'_>) -> Result<Header, Error> {
    let part = "header";
    let version = bytes.f32(part)?;
    if ![0.0, 0.1, 0.2].iter().any(|known| near(version, *known)) {
        return Err(Error::Version(version.to_string()));
    }
    let size = [bytes.u16(part)?, bytes.u16(part)?, bytes.u16(part)?];
    let mut components = Vec::new();
    for _ in 0..bytes.u16(part)? {
        let name = bytes.text(part)?;
        let format = bytes.text(part)?;
        let has_depth = match format.as_str() {
            "XYC" => false,
            "XYZC" => true,
            _ => return Err(Error::Format { name, format }),
        };
        let (points, limbs, colours) = (bytes.u16(part)?, bytes.u16(part)?, bytes.u16(part)?);
        let mut component = Component {
            name,
            has_depth,
            points: Vec::new(),
            limbs: Vec::new(),
        };
        for _ in 0..points {
            component.points.push(bytes.text(part)?);
        }
        for _ in 0..limbs {
            component.limbs.push([bytes.u16(part)?, bytes.u16(part)?]);
        }
        bytes.take(6 * colours, part)?;
        components.push(component);
    }
    Ok(Header {
        version,
        size,
        components,
    })
}

/// Reads the body of versions 0.1 and 0.2: all coordinates, then all confidences.
fn stacked(bytes: &mut Bytes<'_>, header: &Header, points: usize) -> Result<Body, Error> {
    let part = "frames";
    let dimensions = dimensions(header);
    let second = near(header.version, 0.2);
    let rate = if second {
        f64::from(bytes.f32(part)?)
    } else {
        bytes.u16(part)? as f64
    };
    let said = if second {
        let bytes = bytes.take(4, part)?;
        u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]) as usize
    } else {
        bytes.u16(part)?
    };
    let people = bytes.u16(part)?;
    if people == 0 {
        return Err(Error::Empty);
    }
    let frame = people * points * (dimensions + 1) * 4;
    // The count of version 0.1 overflows, and the length of the file is right; but if the two differ by anything else
    // than overflows, the file is cut short, and what would be taken for its confidences are coordinates.
    let held = bytes.0.len().checked_div(frame).unwrap_or(0);
    let frames = if second { said } else { held };
    let overflow = usize::from(u16::MAX) + 1;
    if frames > held || (frame > 0 && held % overflow != said % overflow && !second) {
        return Err(Error::Short(part));
    }
    let values = frames * people * points;
    let places = floats(bytes.take(4 * values * dimensions, part)?);
    let confidence = floats(bytes.take(4 * values, part)?);
    let of_person = |all: &[f32], person: usize, width: usize| -> Vec<f32> {
        let of_frame = all.chunks(people * width);
        let own = of_frame.map(|frame| &frame[person * width..(person + 1) * width]);
        own.flatten().copied().collect()
    };
    let found = (0..people.min(PEOPLE)).map(|person| Person {
        places: of_person(&places, person, points * dimensions),
        confidence: of_person(&confidence, person, points),
    });
    Ok(Body {
        rate,
        frames,
        dimensions,
        people: found.collect(),
        crowd: people,
    })
}

/// Reads the body of version 0.0: frame after frame, person after person.
fn interleaved(bytes: &mut Bytes<'_>, header: &Header, points: usize) -> Result<Body, Error> {
    let part = "frames";
    let dimensions = dimensions(header);
    let rate = bytes.u16(part)? as f64;
    let frames = bytes.u16(part)?;
    let mut found: Vec<(i64, Person)> = Vec::new();
    let mut crowd = 0;
    for frame in 0..frames {
        let people = bytes.u16(part)?;
        crowd = crowd.max(people);
        let mut here = Vec::new();
        for place in 0..people {
            let number = bytes.u16(part)? as u16 as i16;
            // People without numbers of their own are those in the same place of every frame.
            let number = match i64::from(number) {
                number if number < 0 || here.contains(&number) => -1 - place as i64,
                number => number,
            };
            here.push(number);
            let at = match found.iter().position(|(known, _)| *known == number) {
                None if found.len() < PEOPLE => {
                    // Frames without people take two bytes and become gaps of every point.
                    let all = frames.saturating_mul(points) * (found.len() + 1);
                    if all > NUMBERS / 4 {
                        return Err(Error::Short(part));
                    }
                    found.push((number, Person::default()));
                    Some(found.len() - 1)
                }
                known => known,
            };
            let mut person = at.map(|at| &mut found[at].1);
            if let Some(person) = &mut person {
                person.reach(frame, points, dimensions);
            }
            for component in &header.components {
                let width = if component.has_depth { 4 } else { 3 };
                for _ in &component.points {
                    let values = floats(bytes.take(4 * width, part)?);
                    if let Some(person) = &mut person {
                        let axes = (0..dimensions)
                            .map(|axis| values[..width - 1].get(axis).copied().unwrap_or(0.0));
                        person.places.extend(axes);
                        person.confidence.push(values[width - 1]);
                    }
                }
            }
        }
    }
    if found.is_empty() && frames.saturating_mul(points) <= NUMBERS / 4 {
        found.push((0, Person::default()));
    }
    let people = found.into_iter().map(|(_, mut person)| {
        person.reach(frames, points, dimensions);
        person
    });
    let people: Vec<Person> = people.collect();
    Ok(Body {
        rate,
        frames: if people.is_empty() { 0 } else { frames },
        dimensions,
        crowd: crowd.max(people.len()),
        people,
    })
}

fn dimensions(header: &Header) -> usize {
    let has_depth = header
        .components
        .iter()
        .any(|component| component.has_depth);
    if has_depth { 3 } else { 2 }
}

fn floats(bytes: &[u8]) -> Vec<f32> {
    let words = bytes.chunks_exact(4);
    words
        .map(|word| f32::from_le_bytes([word[0], word[1], word[2], word[3]]))
        .collect()
}

type Parts = (Space, Vec<Marker>, Vec<[usize; 2]>);

/// Returns the points of the picked components, if any.
fn track(
    header: &Header,
    of_person: (&Body, &Person),
    picked: impl Fn(&Component) -> bool,
    is_world: bool,
    findings: &mut Findings,
) -> Option<Result<Parts, Error>> {
    let has_depth = header
        .components
        .iter()
        .any(|it| picked(it) && it.has_depth);
    let [width, height, _] = header.size.map(|size| size.max(1) as f64);
    let frame = Frame { width, height };
    let space = match (is_world, has_depth) {
        (true, _) => Space::World(Convention {
            metres_per_unit: 1.0,
            axes: "-Y,+X".parse().ok()?,
        }),
        (false, true) => Space::Depth(frame),
        (false, false) => Space::Image(frame),
    };
    let count = space.coordinates();
    let all: usize = header.components.iter().map(|it| it.points.len()).sum();
    let (mut points, mut limbs) = (Vec::new(), Vec::new());
    let mut begin = 0;
    let groups = header.components.iter().map(|it| it.name.as_str());
    let groups = crate::tracks::unique(groups, "component");
    for (component, group) in header.components.iter().zip(&groups) {
        if !picked(component) {
            begin += component.points.len();
            continue;
        }
        let names = crate::tracks::unique(component.points.iter().map(String::as_str), "point");
        let first = points.len();
        let is_limb = |limb: &&[usize; 2]| {
            limb[0] != limb[1] && limb.iter().all(|end| *end < component.points.len())
        };
        limbs.extend(
            component
                .limbs
                .iter()
                .filter(is_limb)
                .map(|[a, b]| [a + first, b + first]),
        );
        for (at, name) in names.into_iter().enumerate() {
            points.push(marker(of_person, (begin + at, all), count, group, name));
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

fn marker(
    (body, person): (&Body, &Person),
    (point, points): (usize, usize),
    coordinates: usize,
    group: &str,
    name: String,
) -> Marker {
    let at = |frame: usize| frame * points + point;
    let sure: Vec<f32> = (0..body.frames)
        .map(|frame| person.confidence[at(frame)])
        .collect();
    let gaps = (0u32..)
        .zip(&sure)
        .filter(|(_, sure)| !sure.is_finite() || **sure <= 0.0);
    let gaps = Gaps::at(gaps.map(|(frame, _)| frame));
    let axis = |axis: usize| {
        let values = (0..body.frames).map(|frame| {
            let found = person.places.get(at(frame) * body.dimensions + axis);
            found
                .copied()
                .filter(|_| axis < body.dimensions)
                .unwrap_or(0.0)
        });
        let column = Column::singles(values.collect());
        column.clone().with_gaps(&gaps).unwrap_or(column)
    };
    Marker {
        group: group.to_owned(),
        name,
        place: (0..coordinates).map(axis).collect(),
        quality: Some(Column::singles(sure)),
    }
}

/// Divides landmarks in metres by the picture's size if the writer multiplied them by it.
fn unscale(points: &mut [Marker], size: [f64; 2], findings: &mut Findings) {
    let largest = |point: &Marker| {
        let values = point.place[..2]
            .iter()
            .flat_map(|column| column.values().flatten());
        values.fold(0.0, |most: f64, value| most.max(value.abs()))
    };
    if points.iter().map(largest).fold(0.0, f64::max) <= f64::from(FARTHEST_METRES) {
        return;
    }
    for point in points {
        for (column, size) in point.place.iter_mut().zip(size) {
            let metres = column
                .values()
                .map(|value| value.map_or(f64::NAN, |value| value / size));
            *column = Column::doubles(metres.collect());
        }
    }
    findings.push(Finding::note(
        None,
        "the landmarks in metres were multiplied by the picture's width and height; they are divided by them again",
    ));
}
