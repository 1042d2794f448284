//! Network packets of Live Link Face as the program LLV records them (`.gesichter`), compressed with gzip or not.
//!
//! A byte 6, the number of frames, then for each the length of its packet and the packet: the version 6, the names of
//! device and subject, the frame's number, its fraction, the rate as two numbers, how many channels follow, and a number of
//! 32 bits for each. All numbers are big-endian. Channels have no names; their order is that of the packets, in which
//! JawLeft comes before JawRight and MouthLeft before MouthRight.

use std::io::Read as _;

use chereme_motion::column::Number;
use flate2::read::GzDecoder;

use super::{Channels, Clock, Error};
use crate::faces::System;
use crate::finding::Finding;
use crate::tally::Findings;

/// The version of file and packets that is known.
const VERSION: u8 = 6;
/// The first bytes of a file that is compressed with gzip.
const GZIP: [u8; 2] = [0x1f, 0x8b];
/// The most bytes of a file after decompression; an hour takes 70 MB.
const LONGEST: u64 = 512 << 20;
/// The shortest and the longest packet, in bytes.
const PACKET: std::ops::RangeInclusive<usize> = 30..=4_096;

/// Returns whether bytes begin as such a file does.
pub(super) fn is_recording(bytes: &[u8]) -> bool {
    if !bytes.starts_with(&GZIP) {
        return begins(bytes);
    }
    let mut start = [0; 10];
    let whole = GzDecoder::new(bytes).read_exact(&mut start);
    whole.is_ok() && begins(&start)
}

fn begins(bytes: &[u8]) -> bool {
    let length = bytes.get(5..9).and_then(|it| it.try_into().ok());
    let length = length.map_or(0, |it: [u8; 4]| u32::from_be_bytes(it) as usize);
    bytes.first() == Some(&VERSION) && PACKET.contains(&length) && bytes.get(9) == Some(&VERSION)
}

struct Bytes<'b>(&'b [u8]);

impl<'b> Bytes<'b> {
    fn take(&mut self, count: usize) -> Result<&'b [u8], Error> {
        let (taken, rest) = self.0.split_at_checked(count).ok_or_else(short)?;
        self.0 = rest;
        Ok(taken)
    }

    fn u32(&mut self) -> Result<u32, Error> {
        let bytes = self.take(4)?.try_into();
        bytes.map(u32::from_be_bytes).map_err(|_| short())
    }

    fn f32(&mut self) -> Result<f32, Error> {
        self.u32().map(f32::from_bits)
    }

    fn skip_text(&mut self) -> Result<(), Error> {
        let count = self.u32()? as usize;
        self.take(count).map(drop)
    }
}

fn short() -> Error {
    Error::Track("the file ends within a packet; it is cut short".to_owned())
}

fn odd(what: String) -> Error {
    Error::Track(what)
}

/// One packet: its time in seconds, and its numbers.
fn packet(bytes: &[u8], number: usize) -> Result<(f64, Vec<f32>), Error> {
    let mut bytes = Bytes(bytes);
    let version = bytes.take(1)?[0];
    if version != VERSION {
        return Err(odd(format!(
            "packet {number} is of version {version}; {VERSION} is known"
        )));
    }
    bytes.skip_text()?;
    bytes.skip_text()?;
    let frame = f64::from(bytes.u32()?);
    let part = f64::from(bytes.f32()?);
    let (count, seconds) = (f64::from(bytes.u32()?), f64::from(bytes.u32()?));
    if !(part.is_finite() && count > 0.0 && seconds > 0.0) {
        return Err(odd(format!("packet {number} has no time")));
    }
    let channels = usize::from(bytes.take(1)?[0]);
    let values = (0..channels).map(|_| bytes.f32());
    Ok((
        (frame + part) * seconds / count,
        values.collect::<Result<_, _>>()?,
    ))
}

pub(super) fn read(bytes: &[u8], findings: &mut Findings) -> Result<Channels, Error> {
    let mut whole = Vec::new();
    let bytes = match bytes.starts_with(&GZIP) {
        false => bytes,
        true => {
            let mut limited = GzDecoder::new(bytes).take(LONGEST + 1);
            if limited.read_to_end(&mut whole).is_err() {
                findings.push(Finding::warning(
                    None,
                    "its compressed bytes are damaged; what comes before the damage is read",
                ));
            }
            if whole.len() as u64 > LONGEST {
                return Err(odd("the file holds more than 512 MB".to_owned()));
            }
            &whole
        }
    };
    let mut bytes = Bytes(bytes);
    bytes.take(1)?;
    let announced = bytes.u32()? as usize;
    let arkit = System::named("arkit").map_or(&[][..], |system| &system.channels);
    let mut channels = Channels::new(Vec::new());
    let mut seconds: Vec<f64> = Vec::new();
    while !bytes.0.is_empty() && seconds.len() < announced {
        let length = bytes.u32()? as usize;
        let number = seconds.len() + 1;
        let Ok(one) = bytes.take(length) else {
            findings.push(Finding::warning(
                None,
                format!("the file ends within packet {number} of {announced}"),
            ));
            break;
        };
        let (time, values) = packet(one, number)?;
        if seconds.is_empty() {
            let named = |at: usize| match arkit.get(at) {
                Some(name) => name.clone(),
                None => format!("channel {}", at + 1),
            };
            channels = Channels::new((0..values.len()).map(named).collect());
        }
        if values.len() != channels.names.len() {
            return Err(odd(format!(
                "packet {number} has {} channels, and the first has {}",
                values.len(),
                channels.names.len()
            )));
        }
        if seconds.last().is_some_and(|last| *last >= time) {
            findings.push(Finding::warning(
                None,
                format!("packet {number} is not later than the one before it; it was left out"),
            ));
            continue;
        }
        for (column, value) in channels.columns.iter_mut().zip(values) {
            column.push(decimal(value));
        }
        seconds.push(time);
    }
    for (name, unit) in channels.names.iter().zip(&mut channels.units) {
        if ["Yaw", "Pitch", "Roll"]
            .iter()
            .any(|turn| name.ends_with(turn))
        {
            *unit = "rad";
        }
    }
    channels.clock = Clock::Seconds(seconds);
    Ok(channels)
}

/// Returns the shortest decimal that reads back as this 32-bit number; `None` if it is not finite.
fn decimal(value: f32) -> Option<Number> {
    value
        .is_finite()
        .then(|| Number::parse(value.to_string().as_bytes()).ok())
        .flatten()
}
