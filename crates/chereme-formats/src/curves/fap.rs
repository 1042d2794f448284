//! MPEG-4 facial animation parameters as text (`.fap`).
//!
//! Two lines a frame: 68 masks, then the frame's number and a value for every parameter that its mask names.
//! Source: ISO/IEC 14496-2, table of facial animation parameters; the text form of the MPEG-4 tools.

use chereme_motion::column::FileNumber;

use super::{CurveChannels, CurveClock, CurveError};
use crate::tracks::rate_of;

/// The number of parameters.
const FAP_PARAMETER_COUNT: usize = 68;

/// Returns whether a line, in lower case, is the first line of a `.fap` file: version, name (which may hold blanks),
/// rate, frames.
pub(super) fn is_header(line: &str) -> bool {
    let words: Vec<&str> = line.split_whitespace().collect();
    let [version, _, .., rate, frames] = words.as_slice() else {
        return false;
    };
    ["2.0", "2.1"].contains(version) && rate.parse::<f64>().is_ok() && frames.parse::<u64>().is_ok()
}

pub(super) fn read_fap_channels(text: &str) -> Result<CurveChannels, CurveError> {
    let mut lines = (1u64..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty());
    let (_, head) = lines.next().ok_or(CurveError::Empty)?;
    let rate_word = head.split_whitespace().nth_back(1).and_then(|rate| rate.parse().ok());
    let rate = rate_word
        .and_then(rate_of)
        .ok_or_else(|| CurveError::curve_cell_error(1, head, "line of version, name, rate and frames"))?;
    let mut channels = CurveChannels::new((1..=FAP_PARAMETER_COUNT).map(|number| format!("FAP{number}")).collect());
    channels.clock = CurveClock::Rate(rate);
    while let Some((line, masks)) = lines.next() {
        let mut masks: Vec<&str> = masks.split_whitespace().collect();
        // Some programs write a meaningless mask after the last parameter.
        if masks.len() == FAP_PARAMETER_COUNT + 1 && masks.last() == Some(&"0") {
            masks.pop();
        }
        if masks.len() != FAP_PARAMETER_COUNT || masks.iter().any(|mask| !["0", "1"].contains(mask)) {
            return Err(CurveError::curve_cell_error(
                line,
                &masks.join(" "),
                "row of 68 masks 0 or 1",
            ));
        }
        if masks[0] == "1" || masks[1] == "1" {
            return Err(CurveError::curve_cell_error(
                line,
                "FAP 1 or 2",
                "single number; visemes and expressions are not read: write their low-level parameters",
            ));
        }
        let (line, values) = lines
            .next()
            .ok_or_else(|| CurveError::curve_cell_error(line, "", "line of values"))?;
        let mut values = values.split_whitespace().skip(1);
        for (mask, column) in masks.iter().zip(&mut channels.columns) {
            if *mask == "0" {
                column.push(None);
                continue;
            }
            let cell = values.next().unwrap_or_default();
            let number = FileNumber::parse_file_number(cell.as_bytes())
                .map_err(|_| CurveError::curve_cell_error(line, cell, "number"))?;
            column.push(Some(number));
        }
        if let Some(more) = values.next() {
            return Err(CurveError::curve_cell_error(
                line,
                more,
                "value of a parameter that is masked",
            ));
        }
    }
    // Parameters that no frame names have no values.
    let named: Vec<bool> = channels
        .columns
        .iter()
        .map(|column| column.iter().any(Option::is_some))
        .collect();
    let mut keep = named.iter();
    channels.names.retain(|_| *keep.next().unwrap_or(&false));
    let mut keep = named.iter();
    channels.columns.retain(|_| *keep.next().unwrap_or(&false));
    channels.units.truncate(channels.names.len());
    Ok(channels)
}
