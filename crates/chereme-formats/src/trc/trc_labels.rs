//! The line of labels of a TRC file.

use crate::tally::FindingTally;
use crate::tracks::unique_track_names;

/// The markers' names, and the columns before them.
pub(super) struct TrcLabels {
    /// The names, each once.
    pub(super) names: Vec<String>,
    /// Whether a column of times follows that of frame numbers.
    pub(super) has_times: bool,
}

impl TrcLabels {
    /// Reads the labels after `Frame#` and `Time`, for the `markers` of the line of axes or the header, and rows of at
    /// most `width` cells.
    pub(super) fn read_trc_labels(
        cells: &[&str],
        markers: Option<usize>,
        width: usize,
        findings: &mut FindingTally,
    ) -> Self {
        let filled = |cell: &&&str| !cell.is_empty();
        let is_frame = |cell: &str| cell.to_lowercase().starts_with("frame");
        let heads: Vec<&str> = cells.iter().filter(filled).take(2).copied().collect();
        let counted = heads.first().is_some_and(|cell| is_frame(cell));
        let timed = match heads[..] {
            [first, second] if is_frame(first) => is_time(second),
            [first, ..] => is_time(first),
            [] => false,
        };
        let before = usize::from(counted) + usize::from(timed);
        let mut filled_at = (0..cells.len()).filter(|at| !cells[*at].is_empty());
        // The labels begin beside the titles, or a column further on; the first markers may have none.
        let base = match before {
            0 => None,
            before => filled_at.nth(before - 1).map(|last| last + 1),
        };
        let Some(first) = filled_at.next() else {
            return Self {
                names: Vec::new(),
                has_times: true,
            };
        };
        let begin = base.map_or(first, |base| base + usize::from((first - base) % 3 == 1));
        let filled_cells: Vec<&str> = cells[first..].iter().filter(filled).copied().collect();
        let given = match markers {
            Some(markers) if filled_cells.len() == 3 * markers => {
                one_for_three(&filled_cells).unwrap_or_else(|| filled_cells.clone())
            }
            Some(markers) if filled_cells.len() < markers => {
                in_thirds(&cells[begin..], markers).unwrap_or_else(|| filled_cells.clone())
            }
            _ => filled_cells,
        };
        // Without a title, the width of the rows shows whether there are times.
        let has_times = timed || width != 1 + 3 * given.len();
        let names = unique_track_names(given.iter().copied(), "marker");
        for (name, unique) in given.iter().zip(&names) {
            if name == unique {
                continue;
            }
            let (kind, text) = match name.is_empty() {
                true => (
                    "markers without a label",
                    format!("a marker has no label; it is {unique:?} here"),
                ),
                false => (
                    "repeated labels",
                    format!("the label {name:?} occurs again; it is {unique:?} here"),
                ),
            };
            findings.add_limited_note(kind, 4, || text);
        }
        Self { names, has_times }
    }
}

/// Returns whether a title is that of times, such as `Time`, `Time (s)` or `time_s`.
fn is_time(title: &str) -> bool {
    let title = title.to_lowercase();
    let Some(rest) = title.strip_prefix("time") else {
        return false;
    };
    let unit = rest.trim_matches(|letter: char| !letter.is_alphabetic());
    matches!(
        unit,
        "" | "s" | "sec" | "secs" | "second" | "seconds" | "ms" | "msec" | "stamp"
    )
}

/// Returns one label for each three that name the coordinates of a marker: `A A A` or `A.X A.Y A.Z`.
fn one_for_three<'t>(labels: &[&'t str]) -> Option<Vec<&'t str>> {
    let stem = |label: &'t str, axis: char| {
        let bare = label.strip_suffix([axis, axis.to_ascii_uppercase()])?;
        Some(bare.trim_end_matches(['.', '_', ':', '-', ' ']))
    };
    let one = |three: &[&'t str]| match *three {
        [x, y, z] if x == y && y == z => Some(x),
        [x, y, z] => {
            let name = stem(x, 'x')?;
            (Some(name) == stem(y, 'y') && Some(name) == stem(z, 'z')).then_some(name)
        }
        _ => None,
    };
    labels.chunks(3).map(one).collect()
}

/// Returns the labels in every third cell, empty ones too, if no other cell holds one.
fn in_thirds<'t>(cells: &[&'t str], markers: usize) -> Option<Vec<&'t str>> {
    let has_other_cells = cells
        .iter()
        .enumerate()
        .any(|(at, cell)| !cell.is_empty() && (at % 3 != 0 || at / 3 >= markers));
    let label = |at: usize| cells.get(3 * at).copied().unwrap_or_default();
    (!has_other_cells && markers <= cells.len().div_ceil(3) + 1).then(|| (0..markers).map(label).collect())
}
