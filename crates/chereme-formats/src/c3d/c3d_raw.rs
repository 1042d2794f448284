//! Mirrors a C3D file: header, parameters, and frames of points and analog samples.
//!
//! Source: the C3D user guide (c3d.org), sections on the header, parameter and data sections.

use std::collections::BTreeMap;

/// The size of a block of the file, in bytes.
const C3D_BLOCK_BYTES: usize = 512;
/// The second byte of the header of a C3D file.
const C3D_HEADER_KEY: u8 = 0x50;
/// The word of the header that says that it holds a table of events.
const EVENTS_KEY: u16 = 12345;
/// The number of frames at which a count of 16 bits begins again.
const FRAME_COUNT_WRAP: usize = 65_536;
/// The share by which the rates of header and parameter differ if they are two rates, not one that was rounded.
const RATES_DIFFER: f64 = 1e-3;
/// The most parameters; a file with more parameters, points or channels is not a capture.
const MOST_PARAMETERS: usize = 10_000;

/// Why bytes could not be read as C3D.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum C3dError {
    /// The bytes do not begin as a C3D file does.
    #[error("this is no C3D file: its second byte is not 80")]
    NoC3d,
    /// The processor that wrote the file is not one of three known ones.
    #[error("processor type {0} is not known; save the file again as C3D for Intel processors")]
    Processor(u8),
    /// The file ends before this part.
    #[error("the file ends within its {0}; it is cut short")]
    Short(&'static str),
    /// The file has no valid frame rate.
    #[error("the frame rate is {0}, not a positive number")]
    Rate(String),
    /// The file has neither points nor analog channels.
    #[error("the file holds neither points nor analog channels")]
    Empty,
}

/// How numbers are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum C3dProcessor {
    /// Intel: little endian, IEEE floats.
    Intel,
    /// DEC: little endian integers, VAX floats.
    Dec,
    /// SGI and MIPS: big endian.
    Mips,
}

impl C3dProcessor {
    fn u16_from_bytes(self, bytes: [u8; 2]) -> u16 {
        match self {
            Self::Mips => u16::from_be_bytes(bytes),
            _ => u16::from_le_bytes(bytes),
        }
    }

    fn f32_from_bytes(self, [a, b, c, d]: [u8; 4]) -> f32 {
        match self {
            Self::Intel => f32::from_le_bytes([a, b, c, d]),
            Self::Mips => f32::from_be_bytes([a, b, c, d]),
            // VAX floats have their halves swapped and an exponent that is greater by two.
            Self::Dec => f32::from_le_bytes([c, d, a, b]) / 4.0,
        }
    }
}

/// A parameter's value.
#[derive(Debug, Clone, PartialEq)]
pub enum C3dParameterValue {
    /// Texts of a fixed width, blanks at their ends cut off.
    Texts(Vec<String>),
    /// Bytes or 16-bit integers, read as unsigned.
    Integers(Vec<u16>),
    /// Floats.
    Reals(Vec<f32>),
}

/// The parameters by `GROUP:NAME` in capitals.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct C3dParameters(BTreeMap<String, C3dParameterValue>);

impl C3dParameters {
    /// Returns the texts of a parameter, with those of its continuations `NAME2`, `NAME3` and so on.
    #[must_use]
    pub fn parameter_texts(&self, name: &str) -> Vec<&str> {
        let mut texts = Vec::new();
        for part in continued_parameter_names(name) {
            let Some(C3dParameterValue::Texts(more)) = self.0.get(&part) else {
                break;
            };
            texts.extend(more.iter().map(String::as_str));
        }
        texts
    }

    /// Returns the first text of a parameter.
    #[must_use]
    pub fn parameter_text(&self, name: &str) -> Option<&str> {
        self.parameter_texts(name).into_iter().find(|text| !text.is_empty())
    }

    /// Returns the timecode of the first frame, `12:34:56:07`, that some programs write under names of their own.
    #[must_use]
    pub fn first_frame_timecode(&self) -> Option<&str> {
        let named = self.0.iter().filter(|(name, _)| name.contains("TIMECODE"));
        let mut texts = named.filter_map(|(_, value)| match value {
            C3dParameterValue::Texts(texts) => texts.first().map(String::as_str),
            _ => None,
        });
        texts.find(|text| text.matches([':', ';']).count() >= 2)
    }

    /// Returns the numbers of a parameter, with those of its continuations; integers are unsigned.
    #[must_use]
    pub fn unsigned_parameter_numbers(&self, name: &str) -> Vec<f64> {
        self.all_numbers(name, f64::from)
    }

    /// Returns the numbers of a parameter, with those of its continuations; integers are signed.
    #[must_use]
    pub fn signed_parameter_numbers(&self, name: &str) -> Vec<f64> {
        self.all_numbers(name, |word| f64::from(word as i16))
    }

    fn all_numbers(&self, name: &str, of_word: impl Fn(u16) -> f64) -> Vec<f64> {
        let mut numbers = Vec::new();
        for part in continued_parameter_names(name) {
            match self.0.get(&part) {
                Some(C3dParameterValue::Integers(values)) => {
                    numbers.extend(values.iter().map(|value| of_word(*value)));
                }
                Some(C3dParameterValue::Reals(values)) => numbers.extend(values.iter().map(|value| f64::from(*value))),
                _ => break,
            }
        }
        numbers
    }

    /// Returns the first number of a parameter.
    #[must_use]
    pub fn parameter_number(&self, name: &str) -> Option<f64> {
        self.unsigned_parameter_numbers(name).first().copied()
    }
}

/// Returns the names of a parameter and of its continuations; one holds at most 255 values.
fn continued_parameter_names(name: &str) -> impl Iterator<Item = String> + '_ {
    (1..=255).map(move |part| match part {
        1 => name.to_owned(),
        part => format!("{name}{part}"),
    })
}

/// The file: header, parameters and the position of the data.
#[derive(Debug, Clone, PartialEq)]
pub struct C3dDocument {
    /// How numbers are stored.
    pub processor: C3dProcessor,
    /// The parameters.
    pub parameters: C3dParameters,
    /// Points in each frame.
    pub points: usize,
    /// Analog channels.
    pub channels: usize,
    /// Analog samples of a channel in each frame.
    pub samples: usize,
    /// Analog numbers in each frame.
    per_frame: usize,
    /// The number of the first frame, counted from 1.
    pub first_frame: u32,
    /// The frames that header and parameters promise.
    pub promised_frames: usize,
    /// The frames that the data has room for, at most those promised; more if 16 bits are too few for the promise.
    pub frames: usize,
    /// The frames that the data has room for beyond those.
    pub unread_frames: usize,
    /// Frames a second.
    pub rate: f64,
    /// The frames a second of the header if they differ from those of the parameter, which count.
    pub other_rate: Option<f64>,
    /// The unit of points that are stored as integers; negative if points are floats.
    pub scale: f32,
    /// The events of the header: seconds and label.
    pub header_events: Vec<(f32, String)>,
    /// Where the data begins, in bytes.
    data_at: usize,
}

/// A point in one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct C3dPoint {
    /// The coordinates: integers of the file, or floats.
    pub at: [f32; 3],
    /// The residual byte; `None` if the point was not seen.
    pub residual: Option<u8>,
}

impl C3dDocument {
    /// Returns whether points and samples are floats.
    #[must_use]
    pub fn is_real(&self) -> bool {
        self.scale < 0.0
    }

    fn data_word_bytes(&self) -> usize {
        if self.is_real() { 4 } else { 2 }
    }

    fn frame_bytes(&self) -> usize {
        (self.points * 4 + self.per_frame) * self.data_word_bytes()
    }

    fn data_number_at(&self, bytes: &[u8], at: usize) -> Option<f32> {
        if self.is_real() {
            let word = bytes.get(at..at + 4)?.try_into().ok()?;
            Some(self.processor.f32_from_bytes(word))
        } else {
            let word = bytes.get(at..at + 2)?.try_into().ok()?;
            Some(f32::from(self.processor.u16_from_bytes(word) as i16))
        }
    }

    /// Returns a point of a frame.
    #[must_use]
    pub fn c3d_frame_point(&self, bytes: &[u8], frame: usize, point: usize) -> Option<C3dPoint> {
        let point_start = self.data_at + frame * self.frame_bytes() + point * 4 * self.data_word_bytes();
        let coordinate = |axis: usize| self.data_number_at(bytes, point_start + axis * self.data_word_bytes());
        let place = [coordinate(0)?, coordinate(1)?, coordinate(2)?];
        let last = coordinate(3)?;
        // The low byte is the residual, the high one the cameras; as one word it is negative for a gap.
        let word = if last.is_finite() {
            last.clamp(-32768.0, 32767.0) as i16
        } else {
            -1
        };
        let seen = word >= 0 && place.iter().all(|value| value.is_finite());
        Some(C3dPoint {
            at: place,
            residual: seen.then_some((word & 0xff) as u8),
        })
    }

    /// Returns a sample of an analog channel as the file stores it, `is_unsigned` for integers from 0 on.
    #[must_use]
    pub fn c3d_analog_sample(
        &self,
        bytes: &[u8],
        frame: usize,
        sample: usize,
        channel: usize,
        is_unsigned: bool,
    ) -> Option<f32> {
        let words = self.points * 4 + sample * self.channels + channel;
        let sample_start = self.data_at + frame * self.frame_bytes() + words * self.data_word_bytes();
        let value = self.data_number_at(bytes, sample_start)?;
        let turned = is_unsigned && !self.is_real() && value < 0.0;
        Some(if turned { value + 65536.0 } else { value })
    }
}

/// Reads header and parameters, and finds the data.
///
/// # Errors
/// [`C3dError`] if the bytes are no C3D file or end before the data.
pub fn read_c3d_document(bytes: &[u8]) -> Result<C3dDocument, C3dError> {
    if bytes.get(1) != Some(&C3D_HEADER_KEY) {
        return Err(C3dError::NoC3d);
    }
    let header = bytes.get(..C3D_BLOCK_BYTES).ok_or(C3dError::Short("header"))?;
    // Blocks count from 1.
    let parameters_at = usize::from(header[0].max(1) - 1) * C3D_BLOCK_BYTES;
    let section = bytes.get(parameters_at..).ok_or(C3dError::Short("parameters"))?;
    let kind = *section.get(3).ok_or(C3dError::Short("parameters"))?;
    let processor = match kind {
        84 => C3dProcessor::Intel,
        85 => C3dProcessor::Dec,
        86 => C3dProcessor::Mips,
        _ => return Err(C3dError::Processor(kind)),
    };
    let parameters = read_c3d_parameters(section, processor);
    let word = |number: usize| {
        let word_start = 2 * (number - 1);
        processor.u16_from_bytes([header[word_start], header[word_start + 1]])
    };
    let real = |number: usize| {
        let word_start = 2 * (number - 1);
        processor.f32_from_bytes([
            header[word_start],
            header[word_start + 1],
            header[word_start + 2],
            header[word_start + 3],
        ])
    };
    let points = parameters.parameter_number("POINT:USED").unwrap_or(f64::from(word(2))) as usize;
    let per_frame = usize::from(word(3));
    let (first, last) = first_last_frame_numbers(&parameters, word(4), word(5));
    let header_rate = f64::from(real(11));
    let stated = parameters.parameter_number("POINT:RATE").filter(|rate| *rate > 0.0);
    let samples = analog_samples_per_frame(&parameters, usize::from(word(10)), per_frame, stated);
    let channels = per_frame.checked_div(samples).unwrap_or(0);
    let of_analog = parameters
        .parameter_number("ANALOG:RATE")
        .filter(|_| samples > 0)
        .map(|rate| rate / samples as f64);
    let rate = stated
        .or(Some(header_rate).filter(|rate| *rate > 0.0))
        .or(of_analog)
        .unwrap_or(header_rate);
    if !rate.is_finite() || rate <= 0.0 {
        return Err(C3dError::Rate(rate.to_string()));
    }
    let differs = header_rate > 0.0 && (header_rate / rate - 1.0).abs() > RATES_DIFFER;
    let scale = parameters
        .parameter_number("POINT:SCALE")
        .map_or(real(7), |scale| scale as f32);
    // Block 1 is the header, so that a smaller number says nothing.
    let data_block = parameters
        .parameter_number("POINT:DATA_START")
        .filter(|block| *block >= 2.0)
        .unwrap_or(f64::from(word(9)));
    let mut document = C3dDocument {
        processor,
        points: points.min(MOST_PARAMETERS),
        channels: channels.min(MOST_PARAMETERS),
        samples,
        per_frame,
        first_frame: first,
        promised_frames: (last + 1).saturating_sub(first) as usize,
        frames: 0,
        unread_frames: 0,
        rate,
        other_rate: Some(header_rate).filter(|_| differs),
        scale,
        header_events: header_events(header, processor),
        data_at: (data_block as usize).saturating_sub(1) * C3D_BLOCK_BYTES,
        parameters,
    };
    let size = document.frame_bytes();
    if size == 0 {
        return Err(C3dError::Empty);
    }
    // The parameters may follow the data.
    let end = match parameters_at > document.data_at {
        true => parameters_at,
        false => bytes.len(),
    };
    let data = bytes.get(document.data_at..end).ok_or(C3dError::Short("data"))?;
    document.count_frames(data, size, word(5));
    Ok(document)
}

impl C3dDocument {
    /// Counts the frames of the data: those promised, or more if the header's 16 bits are too few for them.
    fn count_frames(&mut self, data: &[u8], size: usize, last: u16) {
        let blank = |frame: &[u8]| frame.iter().all(|byte| *byte == 0);
        let mut room = data.len() / size;
        // Zeros fill the last block.
        while room > self.promised_frames
            && (data.len() - (room - 1) * size) <= C3D_BLOCK_BYTES
            && blank(&data[(room - 1) * size..room * size])
        {
            room -= 1;
        }
        let named = self.parameters.parameter_number("POINT:FRAMES").unwrap_or(0.0) as usize;
        // The count in the header may have begun again at 65,536.
        let turned = room - room.saturating_sub(self.promised_frames) % FRAME_COUNT_WRAP;
        if (self.promised_frames + 1..=room).contains(&named) {
            self.promised_frames = named;
        }
        // A last frame of 65,535 in the header stands for any later one.
        let is_full = last == u16::MAX && self.promised_frames + self.first_frame as usize == FRAME_COUNT_WRAP;
        if room > self.promised_frames && is_full {
            self.promised_frames = room;
        } else if turned > self.promised_frames && (room - turned) * size < C3D_BLOCK_BYTES {
            self.promised_frames = turned;
        }
        self.frames = self.promised_frames.min(room);
        let spare = room - self.frames;
        // Less than a block only fills the last one up.
        self.unread_frames = match spare * size < C3D_BLOCK_BYTES {
            true => 0,
            false => spare,
        };
    }
}

/// Returns the analog samples of a channel in each frame: those of the header, else those that the parameters show.
fn analog_samples_per_frame(parameters: &C3dParameters, header: usize, per_frame: usize, rate: Option<f64>) -> usize {
    if header > 0 || per_frame == 0 {
        return header;
    }
    let used = parameters.parameter_number("ANALOG:USED").unwrap_or(0.0) as usize;
    if used > 0 && per_frame.is_multiple_of(used) {
        return per_frame / used;
    }
    let rates = parameters.parameter_number("ANALOG:RATE").zip(rate);
    let times = rates.map_or(0.0, |(analog, rate)| (analog / rate).round()) as usize;
    match times > 0 && per_frame.is_multiple_of(times) {
        true => times,
        false => 1,
    }
}

/// Returns the numbers of the first and last frame; TRIAL holds them if 16 bits are too few.
fn first_last_frame_numbers(parameters: &C3dParameters, first: u16, last: u16) -> (u32, u32) {
    let trial = |name: &str| {
        let words = parameters.unsigned_parameter_numbers(name);
        // Two words of 16 bits, the lower one first.
        match words[..] {
            [low, high, ..] => Some(low as u32 + ((high as u32) << 16)),
            [one] => Some(one as u32),
            [] => None,
        }
    };
    let first = trial("TRIAL:ACTUAL_START_FIELD").unwrap_or(u32::from(first));
    let header_last = u32::from(last);
    let last = trial("TRIAL:ACTUAL_END_FIELD").unwrap_or(header_last);
    let long = parameters
        .parameter_number("POINT:LONG_FRAMES")
        .filter(|count| *count >= 1.0);
    match long {
        Some(count) if last == header_last => (first, first.saturating_add(count as u32 - 1)),
        _ => (first, last.min(u32::MAX - 1)),
    }
}

fn header_events(header: &[u8], processor: C3dProcessor) -> Vec<(f32, String)> {
    let word = |number: usize| {
        let word_start = 2 * (number - 1);
        processor.u16_from_bytes([header[word_start], header[word_start + 1]])
    };
    if word(150) != EVENTS_KEY {
        return Vec::new();
    }
    // The header has room for 18 events.
    let count = usize::from(word(151)).min(18);
    let event = |at: usize| {
        let time = 2 * (153 - 1) + 4 * at;
        let label = 2 * (199 - 1) + 4 * at;
        let bytes = [header[time], header[time + 1], header[time + 2], header[time + 3]];
        let seconds = processor.f32_from_bytes(bytes);
        let text = String::from_utf8_lossy(&header[label..label + 4]);
        (seconds, text.trim_matches(['\0', ' ']).to_owned())
    };
    (0..count).map(event).collect()
}

/// Reads the chain of groups and parameters; it ends at an end mark, or at a record that makes no sense.
fn read_c3d_parameters(section: &[u8], processor: C3dProcessor) -> C3dParameters {
    let mut groups: BTreeMap<u8, String> = BTreeMap::new();
    let mut entries = Vec::new();
    let mut record_start = 4;
    while entries.len() < MOST_PARAMETERS {
        let Some(record) = read_parameter_record(section, record_start, processor) else {
            break;
        };
        // A group has the negative number of its parameters, which may come before it.
        if record.group < 0 {
            groups.insert(record.group.unsigned_abs(), record.name);
        } else if record.group > 0 {
            entries.push((record.group.unsigned_abs(), record.name, record.body));
        }
        match record.next {
            Some(next) => record_start = next,
            None => break,
        }
    }
    let mut parameters = C3dParameters::default();
    for (group, name, body) in entries {
        let (Some(group), Some(value)) = (groups.get(&group), read_parameter_value(body, processor)) else {
            continue;
        };
        parameters.0.insert(format!("{group}:{name}"), value);
    }
    parameters
}

struct C3dParameterRecord<'b> {
    group: i8,
    name: String,
    body: &'b [u8],
    next: Option<usize>,
}

fn read_parameter_record(section: &[u8], at: usize, processor: C3dProcessor) -> Option<C3dParameterRecord<'_>> {
    // A negative length means that the parameter is locked.
    let length = usize::from((*section.get(at)? as i8).unsigned_abs());
    let group = *section.get(at + 1)? as i8;
    if length == 0 {
        return None;
    }
    let name_at = at + 2;
    let name = String::from_utf8_lossy(section.get(name_at..name_at + length)?);
    let offset_at = name_at + length;
    let offset_bytes = section.get(offset_at..offset_at + 2)?;
    let offset = usize::from(processor.u16_from_bytes([offset_bytes[0], offset_bytes[1]]));
    Some(C3dParameterRecord {
        group,
        name: name.trim().to_uppercase(),
        body: &section[offset_at + 2..],
        // An offset that does not lead past itself ends the chain.
        next: (offset > 2).then_some(offset_at + offset),
    })
}

fn read_parameter_value(body: &[u8], processor: C3dProcessor) -> Option<C3dParameterValue> {
    let kind = *body.first()? as i8;
    let dimensions = usize::from(*body.get(1)?);
    let size_bytes = body.get(2..2 + dimensions)?;
    let sizes: Vec<usize> = size_bytes.iter().map(|size| usize::from(*size)).collect();
    let count = sizes.iter().try_fold(1usize, |all, size| all.checked_mul(*size))?;
    let width = match kind {
        -1 | 1 => 1,
        2 => 2,
        4 => 4,
        _ => return None,
    };
    let rest_bytes = body.get(2 + dimensions..)?;
    let data = rest_bytes.get(..count.checked_mul(width)?)?;
    Some(match kind {
        -1 => {
            // The first dimension is the length of each text.
            let width = sizes.first().copied().unwrap_or(1).max(1);
            let text = |bytes: &[u8]| readable(bytes).trim_matches(['\0', ' ']).to_owned();
            C3dParameterValue::Texts(data.chunks(width).map(text).collect())
        }
        1 => C3dParameterValue::Integers(data.iter().map(|byte| u16::from(*byte)).collect()),
        2 => {
            let words = data.chunks_exact(2);
            C3dParameterValue::Integers(words.map(|word| processor.u16_from_bytes([word[0], word[1]])).collect())
        }
        _ => {
            let words = data.chunks_exact(4);
            let real = |word: &[u8]| processor.f32_from_bytes([word[0], word[1], word[2], word[3]]);
            C3dParameterValue::Reals(words.map(real).collect())
        }
    })
}

/// Returns a text that is UTF-8, whose last letter its fixed width may cut, or else Latin-1.
fn readable(bytes: &[u8]) -> String {
    let utf8_text = match str::from_utf8(bytes) {
        Ok(text) => Some(text),
        Err(error) if error.error_len().is_none() => str::from_utf8(&bytes[..error.valid_up_to()]).ok(),
        Err(_) => None,
    };
    // A single byte at the end is a letter of Latin-1, not the first of a letter that is cut.
    let text = utf8_text.filter(|text| text.len() == bytes.len() || !text.is_ascii());
    text.map_or_else(|| bytes.iter().map(|byte| char::from(*byte)).collect(), str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_utf8_or_latin1_and_may_be_cut_within_a_letter() {
        let cases: [(&[u8], &str); 4] = [
            (b"LSHO", "LSHO"),
            ("Tête".as_bytes(), "Tête"),
            (b"T\xc3\xaate\xc3", "Tête"),
            (b"T\xeate\xe9", "Têteé"),
        ];
        for (bytes, expected) in cases {
            assert_eq!(readable(bytes), expected);
        }
    }
}
