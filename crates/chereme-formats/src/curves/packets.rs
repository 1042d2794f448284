//! Network packets of Live Link Face as the program LLV records them (`.gesichter`), compressed with gzip or not.
//!
//! A byte 6, the number of frames, then for each the length of its packet and the packet: the version 6, the names of
//! device and subject, the frame's number, its fraction, the rate as two numbers, how many channels follow, and a number of
//! 32 bits for each. All numbers are big-endian. Channels have no names; their order is that of the packets, in which
//! JawLeft comes before JawRight and MouthLeft before MouthRight.

use std::io::Read as _;

use chereme_motion::column::FileNumber;
use flate2::read::GzDecoder;

use super::{CurveChannels, CurveClock, CurveError};
use crate::faces::FaceSystem;
use crate::tally::FindingTally;

/// The version of file and packets that is known.
const PACKET_VERSION: u8 = 6;
/// The first bytes of a file that is compressed with gzip.
const GZIP_FIRST_BYTES: [u8; 2] = [0x1f, 0x8b];
/// The most bytes of a file after decompression; an hour takes 70 MB.
const MAX_DECOMPRESSED_BYTES: u64 = 512 << 20;
/// The shortest and the longest packet, in bytes.
const PACKET_BYTES_RANGE: std::ops::RangeInclusive<usize> = 30..=4_096;

/// Returns whether bytes begin as such a file does.
pub(super) fn is_recording(bytes: &[u8]) -> bool {
    if !bytes.starts_with(&GZIP_FIRST_BYTES) {
        return is_packet_start(bytes);
    }
    let mut start = [0; 10];
    let read_result = GzDecoder::new(bytes).read_exact(&mut start);
    read_result.is_ok() && is_packet_start(&start)
}

fn is_packet_start(bytes: &[u8]) -> bool {
    let length_bytes = bytes.get(5..9).and_then(|slice| slice.try_into().ok());
    let length = length_bytes.map_or(0, |word: [u8; 4]| u32::from_be_bytes(word) as usize);
    bytes.first() == Some(&PACKET_VERSION)
        && PACKET_BYTES_RANGE.contains(&length)
        && bytes.get(9) == Some(&PACKET_VERSION)
}

struct PacketBytes<'b>(&'b [u8]);

impl<'b> PacketBytes<'b> {
    fn take_packet_bytes(&mut self, count: usize) -> Result<&'b [u8], CurveError> {
        let (taken, rest) = self.0.split_at_checked(count).ok_or_else(short_packet_error)?;
        self.0 = rest;
        Ok(taken)
    }

    fn u32(&mut self) -> Result<u32, CurveError> {
        let bytes = self.take_packet_bytes(4)?.try_into();
        bytes.map(u32::from_be_bytes).map_err(|_| short_packet_error())
    }

    fn take_packet_f32(&mut self) -> Result<f32, CurveError> {
        self.u32().map(f32::from_bits)
    }

    fn skip_text(&mut self) -> Result<(), CurveError> {
        let count = self.u32()? as usize;
        self.take_packet_bytes(count).map(drop)
    }
}

fn short_packet_error() -> CurveError {
    CurveError::Track("the file ends within a packet; it is cut short".to_owned())
}

fn odd_packet_error(what: String) -> CurveError {
    CurveError::Track(what)
}

/// One packet: its time in seconds, and its numbers.
fn packet(bytes: &[u8], number: usize) -> Result<(f64, Vec<f32>), CurveError> {
    let mut bytes = PacketBytes(bytes);
    let version = bytes.take_packet_bytes(1)?[0];
    if version != PACKET_VERSION {
        return Err(odd_packet_error(format!(
            "packet {number} is of version {version}; {PACKET_VERSION} is known"
        )));
    }
    bytes.skip_text()?;
    bytes.skip_text()?;
    let frame = f64::from(bytes.u32()?);
    let part = f64::from(bytes.take_packet_f32()?);
    let (count, seconds) = (f64::from(bytes.u32()?), f64::from(bytes.u32()?));
    if !(part.is_finite() && count > 0.0 && seconds > 0.0) {
        return Err(odd_packet_error(format!("packet {number} has no time")));
    }
    let channels = usize::from(bytes.take_packet_bytes(1)?[0]);
    let values = (0..channels).map(|_| bytes.take_packet_f32());
    Ok(((frame + part) * seconds / count, values.collect::<Result<_, _>>()?))
}

pub(super) fn read_packet_channels(bytes: &[u8], findings: &mut FindingTally) -> Result<CurveChannels, CurveError> {
    let mut unpacked = Vec::new();
    let bytes = match bytes.starts_with(&GZIP_FIRST_BYTES) {
        false => bytes,
        true => {
            // Compressed bytes may grow a thousandfold.
            let mut limited = GzDecoder::new(bytes).take(MAX_DECOMPRESSED_BYTES + 1);
            if limited.read_to_end(&mut unpacked).is_err() {
                findings.push_warning_finding(
                    None,
                    "its compressed bytes are damaged; what comes before the damage is read",
                );
            }
            if unpacked.len() as u64 > MAX_DECOMPRESSED_BYTES {
                return Err(odd_packet_error("the file holds more than 512 MB".to_owned()));
            }
            &unpacked
        }
    };
    let mut bytes = PacketBytes(bytes);
    bytes.take_packet_bytes(1)?;
    let announced = bytes.u32()? as usize;
    let arkit = FaceSystem::find_face_system("arkit").map_or(&[][..], |system| &system.channels);
    let mut channels = CurveChannels::new(Vec::new());
    let mut seconds: Vec<f64> = Vec::new();
    // A recording that broke off holds fewer packets than its head announces.
    while !bytes.0.is_empty() && seconds.len() < announced {
        let length = bytes.u32()? as usize;
        let number = seconds.len() + 1;
        let Ok(one) = bytes.take_packet_bytes(length) else {
            findings.push_warning_finding(None, format!("the file ends within packet {number} of {announced}"));
            break;
        };
        let (time, values) = packet(one, number)?;
        if seconds.is_empty() {
            let named = |at: usize| match arkit.get(at) {
                Some(name) => name.clone(),
                None => format!("channel {}", at + 1),
            };
            channels = CurveChannels::new((0..values.len()).map(named).collect());
        }
        if values.len() != channels.names.len() {
            return Err(odd_packet_error(format!(
                "packet {number} has {} channels, and the first has {}",
                values.len(),
                channels.names.len()
            )));
        }
        // Packets of a network may be repeated or overtake each other.
        if seconds.last().is_some_and(|last| *last >= time) {
            findings.push_warning_finding(
                None,
                format!("packet {number} is not later than the one before it; it was left out"),
            );
            continue;
        }
        for (column, value) in channels.columns.iter_mut().zip(values) {
            column.push(shortest_f32_decimal(value));
        }
        seconds.push(time);
    }
    for (name, unit) in channels.names.iter().zip(&mut channels.units) {
        if ["Yaw", "Pitch", "Roll"].iter().any(|turn| name.ends_with(turn)) {
            *unit = "rad";
        }
    }
    channels.clock = CurveClock::Seconds(seconds);
    Ok(channels)
}

/// Returns the shortest decimal that reads back as this 32-bit number; `None` if it is not finite.
fn shortest_f32_decimal(value: f32) -> Option<FileNumber> {
    value
        .is_finite()
        .then(|| FileNumber::parse_file_number(value.to_string().as_bytes()).ok())
        .flatten()
}
