//! The lines between MOTION and the first row.

use std::io::Read;

use super::oddity::{Oddities, Oddity};
use super::source::{Source, is_blank, shown};
use super::{BvhError, BvhErrorKind, NotANumber, Number};

/// The header of the MOTION section.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Header {
    /// Whether there is a MOTION section at all.
    pub has_motion: bool,
    /// The number of frames in the header; the rows decide.
    pub declared_frames: Option<u64>,
    /// The seconds per frame as written; `None` if missing, which only files of at most one frame may do.
    pub frame_time: Option<Number>,
    /// The line of the frame time, or the line on which it is missing.
    pub(super) frame_time_line: u64,
}

impl Header {
    /// Returns an error if there is more than one frame but no frame time.
    pub(super) fn check_timed(&self) -> Result<(), BvhError> {
        if self.is_timed() {
            return Ok(());
        }
        let found = self.frame_time.as_ref().map(short);
        Err(BvhErrorKind::NoFrameTime { found }.at(self.frame_time_line))
    }

    fn is_timed(&self) -> bool {
        self.frame_time
            .as_ref()
            .is_some_and(|time| time.to_f64() > 0.0)
    }

    fn check(&self, oddities: &mut Oddities) -> Result<(), BvhError> {
        match &self.frame_time {
            Some(time) if time.to_f64() > 1.0 => {
                oddities.note(Oddity::LongFrameTime, self.frame_time_line, short(time));
            }
            _ if self.is_timed() => {}
            time => {
                if self.declared_frames.is_some_and(|frames| frames > 1) {
                    self.check_timed()?;
                }
                let found = time.as_ref().map_or_else(|| "missing".to_owned(), short);
                oddities.note(Oddity::NoFrameTime, self.frame_time_line, found);
            }
        }
        Ok(())
    }
}

/// Returns a number as a message shows it.
fn short(number: &Number) -> String {
    shown(number.to_string().as_bytes())
}

/// Reads the header after the word MOTION, up to the first number of the first row.
pub(super) fn read_header<R: Read>(
    source: &mut Source<R>,
    oddities: &mut Oddities,
) -> Result<Header, BvhError> {
    let mut header = Header {
        has_motion: true,
        ..Header::default()
    };
    let first_line = source.line();
    let mut counted = false;
    while source
        .skip_blanks()?
        .is_some_and(|byte| byte.is_ascii_alphabetic())
    {
        if counted && header.frame_time.is_some() {
            break;
        }
        let line = source.line();
        let label = source.take_until(|b| {
            matches!(b, b':' | b'\n' | b'\r' | b'.' | b'-' | b'+') || b.is_ascii_digit()
        })?;
        let (label, plain) = (spelling(label), shown(label.trim_ascii()));
        let has_colon = source.peek()? == Some(b':');
        if has_colon {
            source.take();
        }
        let spaced = matches!(source.peek()?, Some(b' ' | b'\t'));
        while matches!(source.peek()?, Some(b' ' | b'\t')) {
            source.take();
        }
        let value = source.take_until(is_blank)?;
        match label.as_str() {
            "frames" => {
                counted = true;
                read_count(value, line, &mut header, oddities);
            }
            "frametime" => {
                header.frame_time_line = line;
                header.frame_time = Some(number(value, line)?);
            }
            _ => {
                let expected = "\"Frames:\", \"Frame Time:\" or a row of numbers";
                return Err(BvhErrorKind::Unexpected {
                    found: plain,
                    expected,
                }
                .at(line));
            }
        }
        note_spelling(&plain, has_colon, spaced, line, oddities);
    }
    if !counted {
        oddities.note(Oddity::NoFrameCount, first_line, "");
    }
    if header.frame_time.is_none() {
        header.frame_time_line = source.line();
    }
    header.check(oddities)?;
    Ok(header)
}

/// Returns a label in lower case, without blanks.
fn spelling(label: &[u8]) -> String {
    label
        .iter()
        .filter(|&&b| !is_blank(b))
        .map(|&b| char::from(b.to_ascii_lowercase()))
        .collect()
}

fn read_count(value: &[u8], line: u64, header: &mut Header, oddities: &mut Oddities) {
    header.declared_frames = std::str::from_utf8(value)
        .ok()
        .and_then(|text| text.parse().ok());
    if header.declared_frames.is_none() {
        oddities.note(Oddity::BadFrameCount, line, format!("{:?}", shown(value)));
    }
}

fn number(value: &[u8], line: u64) -> Result<Number, BvhError> {
    Number::parse(value).map_err(|why: NotANumber| {
        BvhErrorKind::BadNumber {
            place: "Frame Time".to_owned(),
            found: shown(value),
            why,
        }
        .at(line)
    })
}

fn note_spelling(plain: &str, has_colon: bool, spaced: bool, line: u64, oddities: &mut Oddities) {
    if !matches!(plain, "Frames" | "Frame Time") {
        oddities.note(Oddity::KeywordCase, line, format!("{plain:?}"));
    } else if !has_colon || !spaced {
        oddities.note(Oddity::HeaderSpelling, line, format!("{plain:?}"));
    }
}
