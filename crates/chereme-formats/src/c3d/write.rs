//! Markers as C3D, in the byte order of PCs and with places as 32-bit numbers.

use chereme_motion::glam::DVec3;
use chereme_motion::{Axes, Instant, Markers, Quality, Space};

use crate::reach::{TooFar, reaches};

const BLOCK: usize = 512;
/// The first block of parameters, counted from 1; block 1 is the header.
const PARAMETERS: u8 = 2;
/// The most labels in one parameter.
const LABELS: usize = 255;
/// The longest label.
const WIDEST: usize = 127;

/// The parameters under construction.
#[derive(Default)]
struct Parameters {
    bytes: Vec<u8>,
    /// Position in `bytes` of the last record's offset to the next record.
    last: Option<usize>,
}

/// The value of a parameter.
enum Value<'v> {
    Integer(i16),
    Integers(&'v [i16]),
    Float(f32),
    Text(&'v str),
    Texts(&'v [String]),
}

impl Parameters {
    fn record(&mut self, name: &str, id: i8) {
        self.link();
        self.bytes.push(name.len() as u8);
        self.bytes.push(id.to_le_bytes()[0]);
        self.bytes.extend(name.as_bytes());
        self.last = Some(self.bytes.len());
        self.bytes.extend([0, 0]);
    }

    /// Sets the last record's offset, so that it leads to the record that begins here.
    fn link(&mut self) {
        if let Some(at) = self.last {
            let distance = (self.bytes.len() - at) as u16;
            self.bytes[at..at + 2].copy_from_slice(&distance.to_le_bytes());
        }
    }

    fn group(&mut self, name: &str, id: i8) {
        self.record(name, -id);
        self.bytes.push(0);
    }

    fn parameter(&mut self, group: i8, name: &str, value: &Value<'_>) {
        self.record(name, group);
        match value {
            Value::Integer(number) => {
                self.bytes.extend([2, 0]);
                self.bytes.extend(number.to_le_bytes());
            }
            Value::Integers(numbers) => {
                self.bytes.extend([2, 1, numbers.len() as u8]);
                self.bytes
                    .extend(numbers.iter().flat_map(|it| it.to_le_bytes()));
            }
            Value::Float(number) => {
                self.bytes.extend([4, 0]);
                self.bytes.extend(number.to_le_bytes());
            }
            Value::Text(text) => {
                self.bytes.extend([255, 1, text.len() as u8]);
                self.bytes.extend(text.as_bytes());
            }
            Value::Texts(texts) => {
                let width = texts.iter().map(String::len).max().unwrap_or(0).max(1);
                self.bytes.extend([255, 2, width as u8, texts.len() as u8]);
                for text in *texts {
                    let padded = text.bytes().chain(std::iter::repeat(b' '));
                    self.bytes.extend(padded.take(width));
                }
            }
        }
        self.bytes.push(0);
    }
}

/// Writes a track of markers in a room as C3D; gaps are points that the file calls invalid.
///
/// Units are those of the track if C3D has a name for them, else millimetres. Labels keep 127 bytes.
///
/// # Errors
/// Fails, with a sentence for the user, if the points are not in a room, the frames have no even rate, there are
/// more points than C3D can count, or a place does not fit into 32-bit numbers.
pub fn write(markers: &Markers, offset: Instant) -> Result<Vec<u8>, String> {
    let Space::World(convention) = markers.space() else {
        return Err(format!(
            "C3D holds places in a room, and these are {}",
            markers.space().name()
        ));
    };
    let rate = markers
        .times()
        .rate()
        .ok_or("C3D needs an even frame rate")?;
    let (frames, points) = (markers.frames(), markers.points().len());
    if points > 4 * LABELS {
        return Err(format!(
            "C3D files hold at most {} points here, and these are {points}",
            4 * LABELS
        ));
    }
    let units = [
        (0.001, "mm"),
        (0.01, "cm"),
        (1.0, "m"),
        (0.0254, "in"),
        (0.3048, "ft"),
        (0.1, "dm"),
    ];
    let known = units
        .iter()
        .find(|(metres, _)| (metres - convention.metres_per_unit).abs() < 1e-12);
    let (factor, unit) = match known {
        Some((_, unit)) => (1.0, *unit),
        None => (convention.metres_per_unit * 1000.0, "mm"),
    };
    check_reach(markers, factor).map_err(|error| error.to_string())?;
    let first = (offset.seconds() * rate.per_second()).round().max(0.0) as usize + 1;
    let last = first + frames.max(1) - 1;
    let scale = residual_scale(markers, factor);
    let labels = labels(markers);
    let mut head = parameters(
        &labels,
        (frames, rate.per_second() as f32),
        (unit, scale),
        convention.axes,
    );
    head.link();
    head.bytes.extend([0, 0]);
    head.bytes
        .resize((head.bytes.len() + 4).next_multiple_of(BLOCK) - 4, 0);
    let blocks = (head.bytes.len() + 4) / BLOCK;
    let data = usize::from(PARAMETERS) + blocks;
    let word = |number: usize| (number.min(usize::from(u16::MAX)) as u16).to_le_bytes();
    set_start(&mut head.bytes, data, (first, last));
    let mut out = vec![0u8; BLOCK];
    out[0] = PARAMETERS;
    out[1] = 0x50;
    out[2..4].copy_from_slice(&word(points));
    out[6..8].copy_from_slice(&word(first));
    out[8..10].copy_from_slice(&word(last));
    out[12..16].copy_from_slice(&(-scale).to_le_bytes());
    out[16..18].copy_from_slice(&word(data));
    out[20..24].copy_from_slice(&(rate.per_second() as f32).to_le_bytes());
    out.extend([1, 0x50, blocks as u8, 84]);
    out.extend(&head.bytes);
    for frame in 0..frames {
        for point in markers.points() {
            let Some(at) = point.at(frame) else {
                out.extend([0u8; 12]);
                out.extend((-1.0f32).to_le_bytes());
                continue;
            };
            for value in at.to_array() {
                out.extend(((value * factor) as f32).to_le_bytes());
            }
            let residual = point
                .quality
                .as_ref()
                .and_then(|column| column.value(frame));
            let residual = residual.filter(|_| markers.quality() == Some(Quality::Residual));
            let steps = residual.unwrap_or(0.0) * factor / f64::from(scale);
            out.extend((steps.round().clamp(0.0, 255.0) as f32).to_le_bytes());
        }
    }
    out.resize(out.len().next_multiple_of(BLOCK), 0);
    Ok(out)
}

/// Refuses markers with a place or residual that 32-bit numbers cannot hold.
fn check_reach(markers: &Markers, factor: f64) -> Result<(), TooFar> {
    let rated = markers.quality() == Some(Quality::Residual);
    for frame in 0..markers.frames() {
        for point in markers.points() {
            let Some(at) = point.at(frame) else { continue };
            let residual = point.quality.as_ref().filter(|_| rated);
            let residual = residual.and_then(|column| column.value(frame));
            if !reaches(at * factor) || !reaches(DVec3::splat(residual.unwrap_or(0.0) * factor)) {
                return Err(TooFar {
                    kind: "marker",
                    name: point.name.clone(),
                    frame: Some(frame),
                });
            }
        }
    }
    Ok(())
}

/// Returns the unit of the residuals in the file, which stores each residual as a count of up to 255 units.
fn residual_scale(markers: &Markers, factor: f64) -> f32 {
    let rated = markers.quality() == Some(Quality::Residual);
    let all = markers.points().iter().filter(|_| rated);
    let all = all.filter_map(|point| point.quality.as_ref());
    let most = all.flat_map(|column| column.values().flatten().collect::<Vec<_>>());
    let most = most.fold(0.0, f64::max) * factor;
    if most > 0.0 && most.is_finite() {
        (most / 255.0) as f32
    } else {
        0.01
    }
}

fn labels(markers: &Markers) -> Vec<String> {
    let label = |group: &str, name: &str| {
        let whole = match group {
            "" => name.to_owned(),
            group => format!("{group}:{name}"),
        };
        let mut end = whole.len().min(WIDEST);
        while !whole.is_char_boundary(end) {
            end -= 1;
        }
        whole[..end].to_owned()
    };
    let points = markers.points().iter();
    points
        .map(|point| label(&point.group, &point.name))
        .collect()
}

fn parameters(
    labels: &[String],
    (frames, rate): (usize, f32),
    (unit, scale): (&str, f32),
    axes: Axes,
) -> Parameters {
    let mut it = Parameters::default();
    let short = |number: usize| number.min(usize::from(u16::MAX)) as u16 as i16;
    it.group("POINT", 1);
    it.parameter(1, "USED", &Value::Integer(short(labels.len())));
    it.parameter(1, "SCALE", &Value::Float(-scale));
    it.parameter(1, "RATE", &Value::Float(rate));
    it.parameter(1, "DATA_START", &Value::Integer(0));
    it.parameter(1, "FRAMES", &Value::Integer(short(frames)));
    it.parameter(1, "UNITS", &Value::Text(unit));
    for (at, part) in labels.chunks(LABELS).enumerate() {
        let name = match at {
            0 => "LABELS".to_owned(),
            at => format!("LABELS{}", at + 1),
        };
        it.parameter(1, &name, &Value::Texts(part));
    }
    // The axes of the laboratory on a screen: the one to the right, which is the left of a person who faces the viewer,
    // and the one up.
    it.parameter(1, "X_SCREEN", &Value::Text(&axes.left().to_string()));
    it.parameter(1, "Y_SCREEN", &Value::Text(&axes.up().to_string()));
    it.group("ANALOG", 2);
    it.parameter(2, "USED", &Value::Integer(0));
    it.group("TRIAL", 3);
    it.parameter(3, "ACTUAL_START_FIELD", &Value::Integers(&[0, 0]));
    it.parameter(3, "ACTUAL_END_FIELD", &Value::Integers(&[0, 0]));
    it
}

/// Writes the numbers that are known only after the parameters have their final length.
fn set_start(bytes: &mut [u8], data: usize, (first, last): (usize, usize)) {
    let mut set = |name: &str, words: &[u16]| {
        let found = bytes
            .windows(name.len())
            .position(|it| it == name.as_bytes());
        let Some(at) = found else { return };
        let dims = usize::from(bytes[at + name.len() + 3]);
        let mut to = at + name.len() + 4 + dims;
        for word in words {
            bytes[to..to + 2].copy_from_slice(&word.to_le_bytes());
            to += 2;
        }
    };
    let halves = |number: usize| [(number & 0xffff) as u16, (number >> 16) as u16];
    set("DATA_START", &[data as u16]);
    set("ACTUAL_START_FIELD", &halves(first));
    set("ACTUAL_END_FIELD", &halves(last));
}
