//! Praat's TextGrid files: long, short and binary.
//!
//! [`textgrid_raw`] mirrors the file: tiers of intervals or points in seconds. [`read_textgrid_file`] turns it into a
//! [`AnnotationTranscript`]: empty intervals are dropped and counted, a point becomes a short annotation on a tier
//! of the kind [`POINT_TIER_KIND`]. [`write_textgrid()`] fills the gaps again, so that a TextGrid comes back with the same
//! intervals, points and labels.

#[cfg(test)]
mod tests;
pub mod textgrid_raw;

use std::collections::BTreeSet;
use std::fmt::Write as _;

use chereme_motion::{RecordingInstant, TimeSpan};

pub use crate::transcript::POINT_TIER_KIND;

use crate::finding::ImportFinding;
use crate::tally::FindingTally;
use crate::transcript::{AnnotationTiming, AnnotationTranscript, TranscriptAnnotation, TranscriptTier};
use textgrid_raw::{GridTier, GridTierItem, RawTextGrid};

pub use textgrid_raw::{TextGridError, TextGridForm};

/// The kind of a tier of intervals.
pub const INTERVAL_TIER_KIND: &str = "IntervalTier";

/// The length of a point as an annotation, in microseconds, unless the next one begins before: one frame at 25 per
/// second.
const POINT_MICROS: i64 = 40_000;
/// The largest plausible time of a recording, in seconds.
const LONGEST_SECONDS: f64 = 1e9;

/// Reads a TextGrid in any of Praat's three forms.
///
/// # Errors
/// Fails if the bytes are no TextGrid, or are cut short.
pub fn read_textgrid_file(bytes: &[u8]) -> Result<(AnnotationTranscript, Vec<ImportFinding>), TextGridError> {
    let (grid, mut findings) = textgrid_raw::read_raw_textgrid(bytes)?;
    let transcript = grid_to_transcript(&grid, &mut findings);
    Ok((transcript, findings.finish_finding_tally()))
}

fn grid_to_transcript(grid: &RawTextGrid, findings: &mut FindingTally) -> AnnotationTranscript {
    let mut transcript = AnnotationTranscript::default();
    let mut names = BTreeSet::new();
    let (mut empty, mut next_id) = (0u64, 1u64);
    for (at, tier) in grid.tiers.iter().enumerate() {
        let name = unique_tier_name(&tier.name, at, &mut names, findings);
        let annotations = read_grid_annotations(tier, &name, &mut empty, &mut next_id, findings);
        transcript.tiers.push(TranscriptTier {
            name,
            kind: if tier.is_points {
                POINT_TIER_KIND
            } else {
                INTERVAL_TIER_KIND
            }
            .to_owned(),
            annotations,
            ..TranscriptTier::default()
        });
    }
    if empty > 0 {
        findings.push_note_finding(
            None,
            format!("{empty} empty intervals were left out; they are gaps now"),
        );
    }
    transcript
}

/// Returns a name that no earlier tier has.
fn unique_tier_name(name: &str, at: usize, names: &mut BTreeSet<String>, findings: &mut FindingTally) -> String {
    let wanted = if name.trim().is_empty() {
        format!("tier {}", at + 1)
    } else {
        name.to_owned()
    };
    let mut unique = wanted.clone();
    let mut count = 1;
    while !names.insert(unique.clone()) {
        count += 1;
        unique = format!("{wanted} ({count})");
    }
    if unique != name {
        findings.add_limited_note("renamed tiers", None, || {
            format!("tier {} is called {name:?}; here it is {unique:?}", at + 1)
        });
    }
    unique
}

fn read_grid_annotations(
    tier: &GridTier,
    name: &str,
    empty: &mut u64,
    next_id: &mut u64,
    findings: &mut FindingTally,
) -> Vec<TranscriptAnnotation> {
    let mut items: Vec<(TimeSpan, &GridTierItem)> = Vec::with_capacity(tier.items.len());
    for item in &tier.items {
        if !tier.is_points && item.text.is_empty() {
            *empty += 1;
            continue;
        }
        let length = |seconds: f64| seconds.is_finite() && seconds.abs() <= LONGEST_SECONDS;
        if !length(item.start) || !length(item.end) || item.end < item.start {
            findings.add_limited_finding("intervals without a time", || {
                ImportFinding::new_warning_finding(
                    item.line,
                    format!(
                        "{:?} on {name:?} lasts from {} to {} s; it was left out",
                        item.text, item.start, item.end
                    ),
                )
                .with_remedy("correct its times in Praat")
            });
            continue;
        }
        let start = RecordingInstant::from_seconds(item.start);
        let stated_end = RecordingInstant::from_seconds(item.end);
        let end = if tier.is_points {
            start.shifted_instant(POINT_MICROS)
        } else {
            stated_end
        };
        items.push((TimeSpan::span_between(start, end), item));
    }
    items.sort_by_key(|(span, _)| span.span_start_instant());
    for at in 1..items.len() {
        let start = items[at].0.span_start_instant();
        let (before, item) = items[at - 1];
        if before.span_end_instant() > start {
            // A point was given a length, which the next one may shorten without a word.
            items[at - 1].0 = TimeSpan::span_between(before.span_start_instant().min(start), start);
            if !tier.is_points {
                findings.add_limited_warning("overlapping intervals", item.line, || {
                    format!(
                        "{:?} on {name:?} ends after the next interval begins; it ends at {start} now",
                        item.text
                    )
                });
            }
        }
    }
    let make = |(span, item): (TimeSpan, &GridTierItem)| {
        let id = format!("a{next_id}");
        *next_id += 1;
        TranscriptAnnotation {
            id,
            span,
            timing: AnnotationTiming::Own,
            parent: None,
            order: 0,
            value: item.text.clone(),
            entry: None,
            language: None,
            external_ref: None,
            millis: None,
        }
    };
    items.into_iter().map(make).collect()
}

/// Writes tiers as a TextGrid in one of its two forms of text, and reports everything that a TextGrid cannot hold.
#[must_use]
pub fn write_textgrid(
    transcript: &AnnotationTranscript,
    form: TextGridForm,
    end: RecordingInstant,
) -> (String, Vec<ImportFinding>) {
    let mut findings = FindingTally::default();
    let mut first = RecordingInstant::RECORDING_START;
    let mut last = end.max(transcript.transcript_end());
    for annotation in transcript.tiers.iter().flat_map(|tier| &tier.annotations) {
        first = first.min(annotation.span.span_start_instant());
        last = last.max(annotation.span.span_end_instant());
    }
    let mut empty = 0;
    let tiers = transcript
        .tiers
        .iter()
        .map(|tier| grid_tier(tier, first, last, &mut empty, &mut findings))
        .collect();
    if empty > 0 {
        findings.push_warning_finding(
            None,
            format!(
                "annotations without text are not in the TextGrid, where an empty interval is a gap; \
                 an .eaf keeps them: {empty}"
            ),
        );
    }
    if transcript.tiers.iter().any(|tier| tier.parent.is_some()) {
        findings.push_note_finding(
            None,
            "a TextGrid has no hierarchy; tiers below others stand next to them",
        );
    }
    let grid = RawTextGrid {
        start: first.instant_seconds(),
        end: last.instant_seconds(),
        tiers,
    };
    (format_textgrid(&grid, form), findings.finish_finding_tally())
}

/// Returns a tier of intervals without gaps and overlaps, or one of points; counts annotations that become gaps.
fn grid_tier(
    tier: &TranscriptTier,
    first: RecordingInstant,
    last: RecordingInstant,
    empty: &mut u64,
    findings: &mut FindingTally,
) -> GridTier {
    let is_points = tier.kind == POINT_TIER_KIND;
    let mut annotations: Vec<&TranscriptAnnotation> = tier.annotations.iter().collect();
    annotations.sort_by_key(|annotation| annotation.span.span_start_instant());
    let mut items = Vec::new();
    let mut filled_end = first;
    for annotation in annotations {
        let (start, end) = (
            // Praat wants each tier filled from end to end without overlaps.
            annotation.span.span_start_instant().max(filled_end),
            annotation.span.span_end_instant(),
        );
        if is_points {
            let start = annotation.span.span_start_instant().instant_seconds();
            items.push(GridTierItem::new(start, start, &annotation.value));
            continue;
        }
        if annotation.value.is_empty() {
            *empty += 1;
            continue;
        }
        if end <= start {
            findings.add_limited_warning("annotations without room", None, || {
                format!(
                    "{:?} at {} on {:?} overlaps others; a TextGrid has no room for it",
                    annotation.value,
                    annotation.span.span_start_instant(),
                    tier.name
                )
            });
            continue;
        }
        if start > annotation.span.span_start_instant() {
            findings.add_limited_warning("annotations that overlap others and start later", None, || {
                format!(
                    "{:?} at {} on {:?} overlaps others; in the TextGrid it starts at {start}",
                    annotation.value,
                    annotation.span.span_start_instant(),
                    tier.name
                )
            });
        }
        if start > filled_end {
            items.push(GridTierItem::new(
                filled_end.instant_seconds(),
                start.instant_seconds(),
                "",
            ));
        }
        items.push(GridTierItem::new(
            start.instant_seconds(),
            end.instant_seconds(),
            &annotation.value,
        ));
        filled_end = end;
    }
    if !is_points && filled_end < last {
        items.push(GridTierItem::new(
            filled_end.instant_seconds(),
            last.instant_seconds(),
            "",
        ));
    }
    GridTier {
        name: tier.name.clone(),
        is_points,
        start: first.instant_seconds(),
        end: last.instant_seconds(),
        items,
    }
}

/// Returns a number of seconds with as many decimals as microseconds need.
fn format_grid_seconds(value: f64) -> String {
    let text = format!("{value:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn quote_grid_text(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}

fn format_textgrid(grid: &RawTextGrid, form: TextGridForm) -> String {
    let mut out = String::from("File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n");
    let long = form == TextGridForm::Long;
    let mut line = |indent: usize, key: &str, value: &str| {
        let indent = " ".repeat(4 * indent);
        if long && value.is_empty() {
            let _ = writeln!(out, "{indent}{key}");
        } else if long {
            let _ = writeln!(out, "{indent}{key}{value} ");
        } else {
            let _ = writeln!(out, "{value}");
        }
    };
    line(0, "xmin = ", &format_grid_seconds(grid.start));
    line(0, "xmax = ", &format_grid_seconds(grid.end));
    line(0, "tiers? ", "<exists>");
    line(0, "size = ", &grid.tiers.len().to_string());
    if long {
        line(0, "item []: ", "");
    }
    for (at, tier) in (1..).zip(&grid.tiers) {
        let (class, many) = match tier.is_points {
            true => (POINT_TIER_KIND, "points"),
            false => (INTERVAL_TIER_KIND, "intervals"),
        };
        if long {
            line(1, &format!("item [{at}]:"), "");
        }
        line(2, "class = ", &quote_grid_text(class));
        line(2, "name = ", &quote_grid_text(&tier.name));
        line(2, "xmin = ", &format_grid_seconds(tier.start));
        line(2, "xmax = ", &format_grid_seconds(tier.end));
        line(2, &format!("{many}: size = "), &tier.items.len().to_string());
        for (at, item) in (1..).zip(&tier.items) {
            if long {
                line(2, &format!("{many} [{at}]:"), "");
            }
            if tier.is_points {
                line(3, "number = ", &format_grid_seconds(item.start));
                line(3, "mark = ", &quote_grid_text(&item.text));
            } else {
                line(3, "xmin = ", &format_grid_seconds(item.start));
                line(3, "xmax = ", &format_grid_seconds(item.end));
                line(3, "text = ", &quote_grid_text(&item.text));
            }
        }
    }
    out
}
