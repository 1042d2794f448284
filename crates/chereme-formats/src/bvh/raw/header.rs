//! The lines between MOTION and the first row.

use std::io::Read;

use super::oddity::{BvhOddities, BvhOddity};
use super::raw_source::{ByteSource, is_blank, shown_token_bytes};
use super::{BvhError, BvhErrorKind, FileNumber, NotANumber};

/// The header of the MOTION section.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BvhMotionHeader {
    /// Whether there is a MOTION section at all.
    pub has_motion: bool,
    /// The number of frames in the header; the rows decide.
    pub declared_frames: Option<u64>,
    /// The seconds per frame as written; `None` if missing, which only files of at most one frame may do.
    pub frame_time: Option<FileNumber>,
    /// The line of the frame time, or the line on which it is missing.
    pub(super) frame_time_line: u64,
}

impl BvhMotionHeader {
    /// Returns an error if there is more than one frame but no frame time.
    pub(super) fn check_timed(&self) -> Result<(), BvhError> {
        if self.is_timed() {
            return Ok(());
        }
        let stated_time = self.frame_time.as_ref().map(short_number_text);
        Err(BvhErrorKind::NoFrameTime { found: stated_time }.error_at_line(self.frame_time_line))
    }

    fn is_timed(&self) -> bool {
        self.frame_time.as_ref().is_some_and(|time| time.to_f64() > 0.0)
    }

    fn check_motion_header(&self, oddities: &mut BvhOddities) -> Result<(), BvhError> {
        match &self.frame_time {
            Some(time) if time.to_f64() > 1.0 => {
                oddities.note_oddity(BvhOddity::LongFrameTime, self.frame_time_line, short_number_text(time));
            }
            _ if self.is_timed() => {}
            time => {
                if self.declared_frames.is_some_and(|frames| frames > 1) {
                    self.check_timed()?;
                }
                let stated_time = time.as_ref().map_or_else(|| "missing".to_owned(), short_number_text);
                oddities.note_oddity(BvhOddity::NoFrameTime, self.frame_time_line, stated_time);
            }
        }
        Ok(())
    }
}

/// Returns a number as a message shows it.
fn short_number_text(number: &FileNumber) -> String {
    shown_token_bytes(number.to_string().as_bytes())
}

/// Reads the header after the word MOTION, up to the first number of the first row.
pub(super) fn read_header<R: Read>(
    source: &mut ByteSource<R>,
    oddities: &mut BvhOddities,
) -> Result<BvhMotionHeader, BvhError> {
    let mut header = BvhMotionHeader {
        has_motion: true,
        ..BvhMotionHeader::default()
    };
    let first_line = source.byte_source_line();
    let mut counted = false;
    while source.skip_blanks()?.is_some_and(|byte| byte.is_ascii_alphabetic()) {
        // A letter after both statements begins no further one, such as the n of `nan`.
        if counted && header.frame_time.is_some() {
            break;
        }
        let line = source.byte_source_line();
        let label =
            source.take_until(|b| matches!(b, b':' | b'\n' | b'\r' | b'.' | b'-' | b'+') || b.is_ascii_digit())?;
        let (label, plain) = (spelling(label), shown_token_bytes(label.trim_ascii()));
        let has_colon = source.peek_source_byte()? == Some(b':');
        if has_colon {
            source.take_source_byte();
        }
        // Some programs forget the blank, and their files are written back as they were.
        let spaced = matches!(source.peek_source_byte()?, Some(b' ' | b'\t'));
        while matches!(source.peek_source_byte()?, Some(b' ' | b'\t')) {
            source.take_source_byte();
        }
        let value = source.take_until(is_blank)?;
        match label.as_str() {
            "frames" => {
                counted = true;
                read_count(value, line, &mut header, oddities);
            }
            "frametime" => {
                header.frame_time_line = line;
                header.frame_time = Some(parse_header_number(value, line)?);
            }
            _ => {
                let expected = "\"Frames:\", \"Frame Time:\" or a row of numbers";
                return Err(BvhErrorKind::Unexpected { found: plain, expected }.error_at_line(line));
            }
        }
        note_spelling(&plain, has_colon, spaced, line, oddities);
    }
    if !counted {
        oddities.note_oddity(BvhOddity::NoFrameCount, first_line, "");
    }
    // Errors about the missing time name the line where it should stand.
    if header.frame_time.is_none() {
        header.frame_time_line = source.byte_source_line();
    }
    header.check_motion_header(oddities)?;
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

fn read_count(value: &[u8], line: u64, header: &mut BvhMotionHeader, oddities: &mut BvhOddities) {
    header.declared_frames = std::str::from_utf8(value).ok().and_then(|text| text.parse().ok());
    if header.declared_frames.is_none() {
        oddities.note_oddity(
            BvhOddity::BadFrameCount,
            line,
            format!("{:?}", shown_token_bytes(value)),
        );
    }
}

fn parse_header_number(value: &[u8], line: u64) -> Result<FileNumber, BvhError> {
    FileNumber::parse_file_number(value).map_err(|why: NotANumber| {
        BvhErrorKind::BadNumber {
            place: "Frame Time".to_owned(),
            found: shown_token_bytes(value),
            why,
        }
        .error_at_line(line)
    })
}

fn note_spelling(plain: &str, has_colon: bool, spaced: bool, line: u64, oddities: &mut BvhOddities) {
    if !matches!(plain, "Frames" | "Frame Time") {
        oddities.note_oddity(BvhOddity::KeywordCase, line, format!("{plain:?}"));
    } else if !has_colon || !spaced {
        oddities.note_oddity(BvhOddity::HeaderSpelling, line, format!("{plain:?}"));
    }
}
