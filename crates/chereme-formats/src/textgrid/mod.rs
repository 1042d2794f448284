//! Praat's TextGrid files: long, short and binary.
//!
//! [`raw`] mirrors the file: tiers of intervals or points in seconds. [`read`] turns it into a
//! [`Transcript`]: empty intervals are dropped and counted, a point becomes a short annotation on a tier
//! of the kind [`POINTS`]. [`write()`] fills the gaps again, so that a TextGrid comes back with the same
//! intervals, points and labels.

pub mod raw;
#[cfg(test)]
mod tests;

use std::collections::BTreeSet;
use std::fmt::Write as _;

use chereme_motion::{Instant, Span};

use crate::eaf::convert::{Annotation, Tier, Timing, Transcript};
use crate::finding::Finding;
use crate::tally::Findings;
use raw::{Grid, GridTier, Item};

pub use raw::{Error, Form};

/// The kind of a tier whose annotations are points in time.
pub const POINTS: &str = "TextTier";
/// The kind of a tier of intervals.
pub const INTERVALS: &str = "IntervalTier";

/// The length of a point as an annotation, in microseconds, unless the next one begins before: one frame at 25 per
/// second.
const POINT_MICROS: i64 = 40_000;
/// The largest plausible time of a recording, in seconds.
const LONGEST_SECONDS: f64 = 1e9;

/// Reads a TextGrid in any of Praat's three forms.
///
/// # Errors
/// Fails if the bytes are no TextGrid, or are cut short.
pub fn read(bytes: &[u8]) -> Result<(Transcript, Vec<Finding>), Error> {
    let (grid, mut findings) = raw::read(bytes)?;
    let transcript = from_raw(&grid, &mut findings);
    Ok((transcript, findings.finish()))
}

fn from_raw(grid: &Grid, findings: &mut Findings) -> Transcript {
    let mut transcript = Transcript::default();
    let mut names = BTreeSet::new();
    let (mut empty, mut next_id) = (0u64, 1u64);
    for (at, tier) in grid.tiers.iter().enumerate() {
        let name = unique(&tier.name, at, &mut names, findings);
        let annotations = annotations(tier, &name, (&mut empty, &mut next_id), findings);
        transcript.tiers.push(Tier {
            name,
            kind: if tier.is_points { POINTS } else { INTERVALS }.to_owned(),
            annotations,
            ..Tier::default()
        });
    }
    if empty > 0 {
        findings.push(Finding::note(
            None,
            format!("{empty} empty intervals were left out; they are gaps now"),
        ));
    }
    transcript
}

/// Returns a name that no earlier tier has.
fn unique(name: &str, at: usize, names: &mut BTreeSet<String>, findings: &mut Findings) -> String {
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
        findings.add("renamed tiers", || {
            Finding::note(
                None,
                format!("tier {} is called {name:?}; here it is {unique:?}", at + 1),
            )
        });
    }
    unique
}

fn annotations(
    tier: &GridTier,
    name: &str,
    (empty, next_id): (&mut u64, &mut u64),
    findings: &mut Findings,
) -> Vec<Annotation> {
    let mut items: Vec<(Span, &Item)> = Vec::with_capacity(tier.items.len());
    for item in &tier.items {
        if !tier.is_points && item.text.is_empty() {
            *empty += 1;
            continue;
        }
        let length = |seconds: f64| seconds.is_finite() && seconds.abs() <= LONGEST_SECONDS;
        if !length(item.start) || !length(item.end) || item.end < item.start {
            findings.add("intervals without a time", || {
                Finding::warning(
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
        let start = Instant::from_seconds(item.start);
        let end = Instant::from_seconds(item.end);
        let end = if tier.is_points {
            start.shifted(POINT_MICROS)
        } else {
            end
        };
        items.push((Span::between(start, end), item));
    }
    items.sort_by_key(|(span, _)| span.start());
    for at in 1..items.len() {
        let start = items[at].0.start();
        let (before, item) = items[at - 1];
        if before.end() > start {
            items[at - 1].0 = Span::between(before.start().min(start), start);
            if !tier.is_points {
                findings.add("overlapping intervals", || {
                    Finding::warning(
                        item.line,
                        format!(
                            "{:?} on {name:?} ends after the next interval begins; it ends at {start} now",
                            item.text
                        ),
                    )
                });
            }
        }
    }
    let make = |(span, item): (Span, &Item)| {
        let id = format!("a{next_id}");
        *next_id += 1;
        Annotation {
            id,
            span,
            timing: Timing::Own,
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
pub fn write(transcript: &Transcript, form: Form, end: Instant) -> (String, Vec<Finding>) {
    let mut findings = Findings::default();
    let mut first = Instant::ZERO;
    let mut last = end.max(transcript.end());
    for annotation in transcript.tiers.iter().flat_map(|tier| &tier.annotations) {
        first = first.min(annotation.span.start());
        last = last.max(annotation.span.end());
    }
    let mut empty = 0;
    let tiers = transcript
        .tiers
        .iter()
        .map(|tier| grid_tier(tier, (first, last), &mut empty, &mut findings))
        .collect();
    if empty > 0 {
        findings.push(Finding::warning(
            None,
            format!(
                "annotations without text are not in the TextGrid, where an empty interval is a gap; \
                 an .eaf keeps them: {empty}"
            ),
        ));
    }
    if transcript.tiers.iter().any(|tier| tier.parent.is_some()) {
        findings.push(Finding::note(
            None,
            "a TextGrid has no hierarchy; tiers below others stand next to them",
        ));
    }
    let grid = Grid {
        start: first.seconds(),
        end: last.seconds(),
        tiers,
    };
    (text(&grid, form), findings.finish())
}

/// Returns a tier of intervals without gaps and overlaps, or one of points; counts annotations that become gaps.
fn grid_tier(
    tier: &Tier,
    (first, last): (Instant, Instant),
    empty: &mut u64,
    findings: &mut Findings,
) -> GridTier {
    let is_points = tier.kind == POINTS;
    let mut annotations: Vec<&Annotation> = tier.annotations.iter().collect();
    annotations.sort_by_key(|annotation| annotation.span.start());
    let mut items = Vec::new();
    let mut at = first;
    for annotation in annotations {
        let (start, end) = (annotation.span.start().max(at), annotation.span.end());
        if is_points {
            let start = annotation.span.start().seconds();
            items.push(Item::new(start, start, &annotation.value));
            continue;
        }
        if annotation.value.is_empty() {
            *empty += 1;
            continue;
        }
        if end <= start {
            findings.add("annotations without room", || {
                Finding::warning(
                    None,
                    format!(
                        "{:?} at {} on {:?} overlaps others; a TextGrid has no room for it",
                        annotation.value,
                        annotation.span.start(),
                        tier.name
                    ),
                )
            });
            continue;
        }
        if start > annotation.span.start() {
            findings.add("annotations that overlap others and start later", || {
                Finding::warning(
                    None,
                    format!(
                        "{:?} at {} on {:?} overlaps others; in the TextGrid it starts at {start}",
                        annotation.value,
                        annotation.span.start(),
                        tier.name
                    ),
                )
            });
        }
        if start > at {
            items.push(Item::new(at.seconds(), start.seconds(), ""));
        }
        items.push(Item::new(start.seconds(), end.seconds(), &annotation.value));
        at = end;
    }
    if !is_points && at < last {
        items.push(Item::new(at.seconds(), last.seconds(), ""));
    }
    GridTier {
        name: tier.name.clone(),
        is_points,
        start: first.seconds(),
        end: last.seconds(),
        items,
    }
}

/// Returns a number of seconds with as many decimals as microseconds need.
fn seconds(value: f64) -> String {
    let text = format!("{value:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}

fn text(grid: &Grid, form: Form) -> String {
    let mut out = String::from("File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n");
    let long = form == Form::Long;
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
    line(0, "xmin = ", &seconds(grid.start));
    line(0, "xmax = ", &seconds(grid.end));
    line(0, "tiers? ", "<exists>");
    line(0, "size = ", &grid.tiers.len().to_string());
    if long {
        line(0, "item []: ", "");
    }
    for (at, tier) in (1..).zip(&grid.tiers) {
        let (class, many) = match tier.is_points {
            true => (POINTS, "points"),
            false => (INTERVALS, "intervals"),
        };
        if long {
            line(1, &format!("item [{at}]:"), "");
        }
        line(2, "class = ", &quoted(class));
        line(2, "name = ", &quoted(&tier.name));
        line(2, "xmin = ", &seconds(tier.start));
        line(2, "xmax = ", &seconds(tier.end));
        line(
            2,
            &format!("{many}: size = "),
            &tier.items.len().to_string(),
        );
        for (at, item) in (1..).zip(&tier.items) {
            if long {
                line(2, &format!("{many} [{at}]:"), "");
            }
            if tier.is_points {
                line(3, "number = ", &seconds(item.start));
                line(3, "mark = ", &quoted(&item.text));
            } else {
                line(3, "xmin = ", &seconds(item.start));
                line(3, "xmax = ", &seconds(item.end));
                line(3, "text = ", &quoted(&item.text));
            }
        }
    }
    out
}
