//! Parses points in time as people and programs write them.

use chereme_motion::RecordingInstant;
use serde::Serialize;
use std::fmt;
use std::str::FromStr;

/// A point in time as a table gives it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum TableMoment {
    /// A time from the start of the recording.
    Time(RecordingInstant),
    /// A frame of the recording, counted from 0.
    Frame(u64),
}

/// A text that is not a [`TableMoment`].
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "{text:?} is no time: write 1.5, 1.5s, 1500ms, 0:01.500 or f12{}",
    moment_remark(text)
)]
pub struct MomentError {
    /// The text.
    pub text: String,
}

fn moment_remark(text: &str) -> &'static str {
    if text.matches(':').count() == 3 {
        "; the rate of hh:mm:ss:ff is not stated: export the times as hh:mm:ss.ms"
    } else if text.contains(',') {
        "; write a point before the decimals"
    } else {
        ""
    }
}

impl FromStr for TableMoment {
    type Err = MomentError;

    /// Reads seconds (`1.5`, `1.5s`), milliseconds (`1500ms`), minutes (`0:01.500`, `1:02:03.5`) or
    /// a frame (`f12`).
    fn from_str(text: &str) -> Result<Self, MomentError> {
        parse_moment_text(text).ok_or_else(|| MomentError { text: text.to_owned() })
    }
}

/// The unit of times that are bare numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum TableTimeUnit {
    /// Seconds.
    #[serde(rename = "s")]
    Seconds,
    /// Milliseconds.
    #[serde(rename = "ms")]
    Milliseconds,
    /// Frames of the recording, counted from 0.
    #[serde(rename = "frames")]
    Frames,
}

impl TableTimeUnit {
    /// Returns `s`, `ms` or `frames`.
    #[must_use]
    pub fn time_unit_name(self) -> &'static str {
        match self {
            Self::Seconds => "s",
            Self::Milliseconds => "ms",
            Self::Frames => "frames",
        }
    }

    /// Returns the unit that a word means.
    pub(super) fn of_word(word: &str) -> Option<Self> {
        match word {
            "s" | "sec" | "secs" | "second" | "seconds" | "seconde" | "secondes" | "sekunden" => Some(Self::Seconds),
            "ms" | "msec" | "msecs" | "millis" | "millisecond" | "milliseconds" | "millisecondes" | "millisekunden" => {
                Some(Self::Milliseconds)
            }
            "f" | "frame" | "frames" => Some(Self::Frames),
            _ => None,
        }
    }
}

impl fmt::Display for TableTimeUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.time_unit_name())
    }
}

impl FromStr for TableTimeUnit {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::of_word(&text.trim().to_lowercase())
            .ok_or_else(|| format!("{text:?} is no unit of time: write s, ms or frames"))
    }
}

impl TableMoment {
    /// Reads a moment whose bare number is in `unit`; a text with its own unit or with colons ignores `unit`.
    ///
    /// # Errors
    /// [`MomentError`] if the text is not a moment.
    pub fn parse_table_moment(text: &str, unit: TableTimeUnit) -> Result<Self, MomentError> {
        let bare = text.trim();
        if !is_bare(bare) {
            return text.parse();
        }
        let read = match unit {
            TableTimeUnit::Frames => bare.parse().ok().map(Self::Frame),
            TableTimeUnit::Milliseconds => parse_shifted_decimal(bare, 3).map(table_moment_from_micros),
            TableTimeUnit::Seconds => parse_shifted_decimal(bare, 6).map(table_moment_from_micros),
        };
        read.ok_or_else(|| MomentError { text: text.to_owned() })
    }
}

fn table_moment_from_micros(micros: i64) -> TableMoment {
    TableMoment::Time(RecordingInstant::from_micros(micros))
}

/// Returns whether a time is a number without a unit.
pub(super) fn is_bare(text: &str) -> bool {
    let digits = text.strip_prefix('-').unwrap_or(text);
    !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit() || b == b'.')
}

fn parse_moment_text(text: &str) -> Option<TableMoment> {
    let lower = text.trim().to_lowercase();
    if let Some(frame) = lower.strip_prefix('f') {
        return frame.trim().parse().map(TableMoment::Frame).ok();
    }
    let micros = if let Some(millis) = lower.strip_suffix("ms") {
        parse_shifted_decimal(millis.trim(), 3)
    } else if let Some(seconds) = lower.strip_suffix('s') {
        parse_shifted_decimal(seconds.trim(), 6)
    } else {
        parse_clock_micros(&lower)
    };
    Some(TableMoment::Time(RecordingInstant::from_micros(micros?)))
}

/// Reads `S.S`, `M:SS.S` or `H:MM:SS.S` as microseconds; a minus before it makes all of it negative.
fn parse_clock_micros(text: &str) -> Option<i64> {
    let (sign, text) = text.strip_prefix('-').map_or((1, text), |rest| (-1, rest));
    (!text.contains('-')).then_some(())?;
    let (rest, seconds) = text
        .rsplit_once(':')
        .map_or((None, text), |(rest, seconds)| (Some(rest), seconds));
    let seconds = match rest {
        Some(_) => seconds.replacen(',', ".", 1),
        None => seconds.to_owned(),
    };
    let micros = parse_shifted_decimal(&seconds, 6)?;
    let Some(rest) = rest else {
        return Some(sign * micros);
    };
    let (hours, minutes) = rest.split_once(':').unwrap_or(("0", rest));
    let whole_number = |text: &str| text.parse::<u32>().ok().map(i64::from);
    let minutes = whole_number(hours)?
        .checked_mul(60)?
        .checked_add(whole_number(minutes)?)?;
    (0..60_000_000).contains(&micros).then_some(())?;
    let micros = minutes.checked_mul(60_000_000)?.checked_add(micros)?;
    Some(sign * micros)
}

/// Reads a decimal number times ten to the power `shift`, with further decimals rounded.
fn parse_shifted_decimal(text: &str, shift: usize) -> Option<i64> {
    let (sign, digits) = text.strip_prefix('-').map_or((1, text), |digits| (-1, digits));
    let (whole, part) = digits.split_once('.').unwrap_or((digits, ""));
    let plain = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
    if (whole.is_empty() && part.is_empty()) || !plain(whole) || !plain(part) || whole.len() > 12 {
        return None;
    }
    let kept: String = part.chars().chain(std::iter::repeat('0')).take(shift).collect();
    let up = part.as_bytes().get(shift).is_some_and(|b| *b >= b'5');
    let value: i64 = format!("{whole}{kept}").parse().ok()?;
    Some(sign * (value + i64::from(up)))
}
