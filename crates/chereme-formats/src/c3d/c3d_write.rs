//! Markers as C3D, in the byte order of PCs and with places as 32-bit numbers.

use chereme_motion::glam::DVec3;
use chereme_motion::{MarkerSpace, MarkerTrack, QualityMeaning, RecordingInstant, SignerAxes};

use crate::reach::{TooFar, is_writable_place};

const C3D_WRITE_BLOCK_BYTES: usize = 512;
/// The first block of parameters, counted from 1; block 1 is the header.
const PARAMETER_START_BLOCK: u8 = 2;
/// The most labels in one parameter.
const MAX_LABELS_PER_PARAMETER: usize = 255;
/// The longest label.
const MAX_LABEL_BYTES: usize = 127;

/// The parameters under construction.
#[derive(Default)]
struct C3dParameterWriter {
    bytes: Vec<u8>,
    /// Position in `bytes` of the last record's offset to the next record.
    last: Option<usize>,
}

/// The value of a parameter.
enum WrittenParameterValue<'v> {
    Integer(i16),
    Integers(&'v [i16]),
    Float(f32),
    Text(&'v str),
    Texts(&'v [String]),
}

impl C3dParameterWriter {
    fn begin_parameter_record(&mut self, name: &str, id: i8) {
        self.link_parameter_record();
        self.bytes.push(name.len() as u8);
        self.bytes.push(id.to_le_bytes()[0]);
        self.bytes.extend(name.as_bytes());
        self.last = Some(self.bytes.len());
        self.bytes.extend([0, 0]);
    }

    /// Sets the last record's offset, so that it leads to the record that begins here.
    fn link_parameter_record(&mut self) {
        if let Some(at) = self.last {
            let distance = (self.bytes.len() - at) as u16;
            self.bytes[at..at + 2].copy_from_slice(&distance.to_le_bytes());
        }
    }

    fn write_parameter_group(&mut self, name: &str, id: i8) {
        self.begin_parameter_record(name, -id);
        self.bytes.push(0);
    }

    fn parameter(&mut self, group: i8, name: &str, value: &WrittenParameterValue<'_>) {
        self.begin_parameter_record(name, group);
        match value {
            WrittenParameterValue::Integer(number) => {
                self.bytes.extend([2, 0]);
                self.bytes.extend(number.to_le_bytes());
            }
            WrittenParameterValue::Integers(numbers) => {
                self.bytes.extend([2, 1, numbers.len() as u8]);
                self.bytes
                    .extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
            }
            WrittenParameterValue::Float(number) => {
                self.bytes.extend([4, 0]);
                self.bytes.extend(number.to_le_bytes());
            }
            WrittenParameterValue::Text(text) => {
                self.bytes.extend([255, 1, text.len() as u8]);
                self.bytes.extend(text.as_bytes());
            }
            WrittenParameterValue::Texts(texts) => {
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
pub fn write_c3d(markers: &MarkerTrack, offset: RecordingInstant) -> Result<Vec<u8>, String> {
    let MarkerSpace::World(convention) = markers.marker_space() else {
        return Err(format!(
            "C3D holds places in a room, and these are {}",
            markers.marker_space().marker_space_name()
        ));
    };
    let rate = markers
        .marker_times()
        .even_times_rate()
        .ok_or("C3D needs an even frame rate")?;
    let (frames, points) = (markers.marker_frame_count(), markers.marker_points().len());
    if points > 4 * MAX_LABELS_PER_PARAMETER {
        return Err(format!(
            "C3D files hold at most {} points here, and these are {points}",
            4 * MAX_LABELS_PER_PARAMETER
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
    let usual_unit = units
        .iter()
        .find(|(metres, _)| (metres - convention.metres_per_unit).abs() < 1e-12);
    let (factor, unit) = match usual_unit {
        Some((_, unit)) => (1.0, *unit),
        None => (convention.metres_per_unit * 1000.0, "mm"),
    };
    check_reach(markers, factor).map_err(|error| error.to_string())?;
    let first = (offset.instant_seconds() * rate.per_second()).round().max(0.0) as usize + 1;
    let last = first + frames.max(1) - 1;
    let scale = residual_scale(markers, factor);
    let labels = written_marker_labels(markers);
    let mut head = build_c3d_parameters(&labels, frames, rate.per_second() as f32, unit, scale, convention.axes);
    head.link_parameter_record();
    head.bytes.extend([0, 0]);
    // Four bytes of the section come before the parameters.
    head.bytes
        .resize((head.bytes.len() + 4).next_multiple_of(C3D_WRITE_BLOCK_BYTES) - 4, 0);
    let blocks = (head.bytes.len() + 4) / C3D_WRITE_BLOCK_BYTES;
    let data = usize::from(PARAMETER_START_BLOCK) + blocks;
    let word = |number: usize| (number.min(usize::from(u16::MAX)) as u16).to_le_bytes();
    set_start(&mut head.bytes, data, first, last);
    let mut out = vec![0u8; C3D_WRITE_BLOCK_BYTES];
    out[0] = PARAMETER_START_BLOCK;
    out[1] = 0x50;
    out[2..4].copy_from_slice(&word(points));
    out[6..8].copy_from_slice(&word(first));
    out[8..10].copy_from_slice(&word(last));
    // A negative scale says that points are floats.
    out[12..16].copy_from_slice(&(-scale).to_le_bytes());
    out[16..18].copy_from_slice(&word(data));
    out[20..24].copy_from_slice(&(rate.per_second() as f32).to_le_bytes());
    out.extend([1, 0x50, blocks as u8, 84]);
    out.extend(&head.bytes);
    for frame in 0..frames {
        for point in markers.marker_points() {
            let Some(at) = point.marker_position(frame) else {
                out.extend([0u8; 12]);
                // A negative fourth number marks a point that was not seen.
                out.extend((-1.0f32).to_le_bytes());
                continue;
            };
            for value in at.to_array() {
                out.extend(((value * factor) as f32).to_le_bytes());
            }
            let residual_value = point.quality.as_ref().and_then(|column| column.column_value_at(frame));
            let residual = residual_value.filter(|_| markers.marker_quality() == Some(QualityMeaning::Residual));
            let steps = residual.unwrap_or(0.0) * factor / f64::from(scale);
            out.extend((steps.round().clamp(0.0, 255.0) as f32).to_le_bytes());
        }
    }
    out.resize(out.len().next_multiple_of(C3D_WRITE_BLOCK_BYTES), 0);
    Ok(out)
}

/// Refuses markers with a place or residual that 32-bit numbers cannot hold.
fn check_reach(markers: &MarkerTrack, factor: f64) -> Result<(), TooFar> {
    let rated = markers.marker_quality() == Some(QualityMeaning::Residual);
    for frame in 0..markers.marker_frame_count() {
        for point in markers.marker_points() {
            let Some(at) = point.marker_position(frame) else {
                continue;
            };
            let residual_column = point.quality.as_ref().filter(|_| rated);
            let residual = residual_column.and_then(|column| column.column_value_at(frame));
            if !is_writable_place(at * factor) || !is_writable_place(DVec3::splat(residual.unwrap_or(0.0) * factor)) {
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
fn residual_scale(markers: &MarkerTrack, factor: f64) -> f32 {
    let rated = markers.marker_quality() == Some(QualityMeaning::Residual);
    let rated_points = markers.marker_points().iter().filter(|_| rated);
    let all = rated_points.filter_map(|point| point.quality.as_ref());
    let all_values = all.flat_map(|column| column.column_values().flatten().collect::<Vec<_>>());
    let most = all_values.fold(0.0, f64::max) * factor;
    if most > 0.0 && most.is_finite() {
        (most / 255.0) as f32
    } else {
        // Without residuals nothing is counted in this unit.
        0.01
    }
}

fn written_marker_labels(markers: &MarkerTrack) -> Vec<String> {
    let label = |group: &str, name: &str| {
        let full_label = match group {
            "" => name.to_owned(),
            group => format!("{group}:{name}"),
        };
        let mut end = full_label.len().min(MAX_LABEL_BYTES);
        while !full_label.is_char_boundary(end) {
            end -= 1;
        }
        full_label[..end].to_owned()
    };
    let points = markers.marker_points().iter();
    points.map(|point| label(&point.group, &point.name)).collect()
}

fn build_c3d_parameters(
    labels: &[String],
    frames: usize,
    rate: f32,
    unit: &str,
    scale: f32,
    axes: SignerAxes,
) -> C3dParameterWriter {
    let mut it = C3dParameterWriter::default();
    // Readers take these 16 bits as unsigned.
    let short = |number: usize| number.min(usize::from(u16::MAX)) as u16 as i16;
    it.write_parameter_group("POINT", 1);
    it.parameter(1, "USED", &WrittenParameterValue::Integer(short(labels.len())));
    it.parameter(1, "SCALE", &WrittenParameterValue::Float(-scale));
    it.parameter(1, "RATE", &WrittenParameterValue::Float(rate));
    // This and the two fields of TRIAL are set when the length of the parameters is known.
    it.parameter(1, "DATA_START", &WrittenParameterValue::Integer(0));
    it.parameter(1, "FRAMES", &WrittenParameterValue::Integer(short(frames)));
    it.parameter(1, "UNITS", &WrittenParameterValue::Text(unit));
    for (at, part) in labels.chunks(MAX_LABELS_PER_PARAMETER).enumerate() {
        let name = match at {
            0 => "LABELS".to_owned(),
            at => format!("LABELS{}", at + 1),
        };
        it.parameter(1, &name, &WrittenParameterValue::Texts(part));
    }
    // The axes of the laboratory on a screen: the one to the right, which is the left of a person who faces the viewer,
    // and the one up.
    it.parameter(
        1,
        "X_SCREEN",
        &WrittenParameterValue::Text(&axes.left_direction().to_string()),
    );
    it.parameter(
        1,
        "Y_SCREEN",
        &WrittenParameterValue::Text(&axes.up_direction().to_string()),
    );
    it.write_parameter_group("ANALOG", 2);
    it.parameter(2, "USED", &WrittenParameterValue::Integer(0));
    it.write_parameter_group("TRIAL", 3);
    it.parameter(3, "ACTUAL_START_FIELD", &WrittenParameterValue::Integers(&[0, 0]));
    it.parameter(3, "ACTUAL_END_FIELD", &WrittenParameterValue::Integers(&[0, 0]));
    it
}

/// Writes the numbers that are known only after the parameters have their final length.
fn set_start(bytes: &mut [u8], data: usize, first: usize, last: usize) {
    let mut set = |name: &str, words: &[u16]| {
        let name_start = bytes.windows(name.len()).position(|window| window == name.as_bytes());
        let Some(at) = name_start else { return };
        // After the name come two bytes of offset, one of type, and the number of dimensions.
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
