//! Pasting of copied annotations: their places on the tiers of a recording, and the reasons of those without one.

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::table::annotations::TableMoment;
use chereme_motion::RecordingInstant;
use chereme_sign::TierStereotype;

use super::annotate_clipboard::{self, ClipboardText, CopiedAnnotation, OddLine, OddReason};
use super::annotate_names::TierRequestName;
use super::drag_limits::{self, TierTiming};
use super::snap::RecordingFrameTimes;
use super::{AnnotateOptions, AnnotateReport, requests};
use crate::Corpus;
use crate::address::{self, RowName};
use crate::contents::{RecordingContents, TierContents};
use crate::db::stored_recordings;
use crate::error::{CorpusError, CorpusResult};
use crate::inventories::StoredInventory;
use crate::progress::ProgressReceiver;

/// An annotation to add.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PastedAnnotation {
    /// The row of its tier.
    pub tier: i64,
    /// The times to request, in microseconds.
    pub span: (i64, i64),
    /// Its value.
    pub value: String,
}

/// The plan of a paste: annotations to add, and lines that cannot be added.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct PastePlan {
    /// In an order in which they can be added: parents before children.
    pub adds: Vec<PastedAnnotation>,
    /// The lines without a place.
    pub odd: Vec<OddLine>,
}

/// The place and treatment of pasted annotations.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PasteOptions {
    /// The tier of annotations without a tier name, and of all if they name one tier only and `at` is given.
    pub tier: Option<TierRequestName>,
    /// The start of the first annotation; without it annotations keep their times.
    pub at: Option<TableMoment>,
    /// Paste the annotations that have a place even if others have none.
    pub partly: bool,
}

impl Corpus {
    /// Pastes copied annotations into a recording as one operation; returns also the lines without a place.
    ///
    /// `name` is the name of the text in errors; its form is that of [`annotate_clipboard`].
    ///
    /// # Errors
    /// [`CorpusError::Several`] with each line without a place, unless `partly` is set; fails if the text has no times, or
    /// nothing has a place.
    pub fn paste_annotations(
        &mut self,
        recording: &RowName,
        text: &str,
        name: &str,
        options: &PasteOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<(AnnotateReport, Vec<OddLine>)> {
        let connection = self.store.read_connection();
        let row = address::find_recording_by_name(connection, recording)?;
        let track = stored_recordings::body_track(connection, row.id)?;
        let frames = track.and_then(|track| {
            Some(RecordingFrameTimes {
                rate: chereme_motion::FrameRate::new(track.rate_frames, track.rate_seconds).ok()?,
                offset: track.offset_us,
            })
        });
        let inventories = self.load_corpus_overview(0)?.inventories;
        let to = match &options.tier {
            Some(tier) => Some(super::annotate_names::find_named_tier(self.store.read_connection(), tier)?.id),
            None => None,
        };
        let contents = self.load_recording_contents(row.id)?;
        let to = to.and_then(|id| contents.tiers.iter().find(|tier| tier.row.id == id));
        let frame = |at: u64| frames.map(|timing| timing.snap_frame_start(at));
        let ClipboardText::Rows(rows, mut odd) = annotate_clipboard::read_clipboard_text(text, frame) else {
            return Err(CorpusError::from_wrong_message("the text has no start and end times")
                .with_error_place(name)
                .with_advice("write tier, start, end and value in each line, with tabs between them"));
        };
        let here = match options.at {
            Some(TableMoment::Time(at)) => Some(at.instant_micros()),
            Some(TableMoment::Frame(at)) => Some(frame(at).ok_or_else(|| {
                CorpusError::from_wrong_message(format!("the recording {:?} has no frames", row.name))
                    .with_advice("give times in seconds")
            })?),
            None => None,
        };
        let until = drag_limits::annotation_time_limits(&contents, frames.is_some()).to;
        let knows = |tier: &TierContents, value: &str| {
            let stored = inventories
                .iter()
                .find(|candidate| Some(candidate.id) == tier.row.inventory_id);
            inventory_allows_value(stored, value)
        };
        let mut plan = plan_paste(&contents, to, rows, here, until, knows);
        odd.append(&mut plan.odd);
        odd.sort_by_key(|odd_line| odd_line.line);
        if !odd.is_empty() && (!options.partly || plan.adds.is_empty()) {
            let errors = odd.iter().map(|odd_line| {
                let error = CorpusError::from_wrong_message(odd_line.odd_line_fault())
                    .with_error_place(format!("{name}, line {}", odd_line.line));
                match odd_line.why {
                    OddReason::Tier => error.with_command_advice("add the tier, or name another one with --tier"),
                    _ => error,
                }
            });
            return Err(CorpusError::from_error_list(errors.collect()));
        }
        let changes: Vec<_> = plan
            .adds
            .iter()
            .map(|addition| {
                let (start, end) = addition.span;
                requests::add_annotation_change(addition.tier, start, end, &addition.value)
            })
            .collect();
        let report = self.annotate_corpus(&changes, &AnnotateOptions::default(), progress)?;
        Ok((report, odd))
    }
}

/// Returns whether a tier with that inventory allows a value.
#[must_use]
pub fn inventory_allows_value(inventory: Option<&StoredInventory>, value: &str) -> bool {
    const MISSING_VALUE_TEXTS: [&str; 5] = ["", "unset", "n/a", "unclear", "?"];
    let value = value.trim();
    inventory.is_none_or(|stored| {
        MISSING_VALUE_TEXTS.contains(&value) || stored.inventory.find_inventory_value(value).is_some()
    })
}

/// Plans where annotations go: at their own times, or with the first of them at `here`; on the tiers that they name.
/// Those without a tier name go to the tier `to`. So do all if they name only one tier, and `here` is given or the
/// recording lacks that tier. No annotation may end after `until`; times are in microseconds.
#[must_use]
pub fn plan_paste(
    contents: &RecordingContents,
    to: Option<&TierContents>,
    mut rows: Vec<CopiedAnnotation>,
    here: Option<i64>,
    until: i64,
    knows: impl Fn(&TierContents, &str) -> bool,
) -> PastePlan {
    let names: BTreeSet<&str> = rows.iter().filter_map(|row| row.tier.as_deref()).collect();
    let named = |name: &str| contents.tiers.iter().position(|tier| tier.row.name == name);
    let target_index = to.and_then(|to| contents.tiers.iter().position(|tier| tier.row.id == to.row.id));
    let one = names.len() <= 1;
    let place = |tier: Option<&str>| match tier {
        Some(name) if !(one && here.is_some() && target_index.is_some()) => {
            named(name).or(target_index.filter(|_| one))
        }
        _ => target_index,
    };
    let first = rows.iter().map(|row| row.start).min().unwrap_or_default();
    let by = here.map_or(0, |here| here - first);
    let mut plan = PastePlan::default();
    let mut placed = Vec::new();
    for mut row in rows.drain(..) {
        (row.start, row.end) = (row.start + by, row.end + by);
        match place(row.tier.as_deref()) {
            Some(at) => placed.push((tier_ancestor_count(contents, at), at, row)),
            None => plan.odd.push(OddLine {
                line: row.line,
                why: OddReason::Tier,
                text: row.tier.unwrap_or_default(),
                at: None,
            }),
        }
    }
    placed.sort_by_key(|(depth, tier, row)| (*depth, *tier, row.start));
    let mut taken: BTreeMap<i64, OccupiedTierSpans> = BTreeMap::new();
    for (_, at, row) in placed {
        let tier = &contents.tiers[at];
        let begins = RecordingInstant::from_micros(row.start);
        let outcome = if !knows(tier, &row.value) {
            Err((OddReason::Value, row.value.clone(), None))
        } else {
            fit_pasted_annotation(contents, tier, row.start, row.end, until, &mut taken)
                .map_err(|why| (why, begins.to_string(), Some(begins)))
        };
        match outcome {
            Ok(span) => plan.adds.push(PastedAnnotation {
                tier: tier.row.id,
                span,
                value: row.value,
            }),
            Err((why, text, at)) => plan.odd.push(OddLine {
                line: row.line,
                why,
                text,
                at,
            }),
        }
    }
    plan
}

/// Returns the number of ancestors of a tier.
fn tier_ancestor_count(contents: &RecordingContents, at: usize) -> usize {
    let mut above = contents.tiers[at].row.parent_id;
    let tiers = &contents.tiers;
    (0..tiers.len())
        .take_while(|_| {
            let parent = tiers.iter().find(|tier| Some(tier.row.id) == above);
            above = parent.and_then(|tier| tier.row.parent_id);
            parent.is_some()
        })
        .count()
}

/// The occupied spans of a tier: their ends by their starts, in microseconds.
type OccupiedTierSpans = BTreeMap<i64, i64>;

fn taken_by(tier: &TierContents) -> OccupiedTierSpans {
    let columns = &tier.annotations;
    let pairs = columns.starts.iter().zip(&columns.ends);
    pairs.map(|(start, end)| (*start, *end)).collect()
}

/// Returns the times to request for an annotation, and marks them as occupied; or the reason why it cannot be added.
fn fit_pasted_annotation(
    contents: &RecordingContents,
    tier: &TierContents,
    start: i64,
    end: i64,
    until: i64,
    taken: &mut BTreeMap<i64, OccupiedTierSpans>,
) -> std::result::Result<(i64, i64), OddReason> {
    if start < 0 || end > until {
        return Err(OddReason::Outside);
    }
    let kind = TierTiming::timing_of_tier(&tier.row);
    let tiers = &contents.tiers;
    let parent = tiers
        .iter()
        .find(|candidate| Some(candidate.row.id) == tier.row.parent_id);
    let mut above = (start, end);
    if let Some(parent) = parent.filter(|_| kind != TierTiming::Root) {
        let all = taken.entry(parent.row.id).or_insert_with(|| taken_by(parent));
        let range_before = all.range(..=start).next_back();
        let range_around = range_before.filter(|(_, to)| end <= **to);
        above = range_around
            .map(|range| (*range.0, *range.1))
            .ok_or(OddReason::Parent)?;
    }
    let taken_ranges = taken.entry(tier.row.id).or_insert_with(|| taken_by(tier));
    let overlap = taken_ranges.range(..end).next_back().filter(|(_, to)| **to > start);
    let meets = overlap.map(|range| (*range.0, *range.1));
    let asked = match (kind, meets) {
        (TierTiming::Tiled, None) => above,
        (TierTiming::Tiled, Some((from, to))) if from < start => {
            taken_ranges.insert(from, start);
            (start, to)
        }
        (TierTiming::Listed, None) => above,
        (TierTiming::Listed, Some(_)) if !is_association(tier) => above,
        (_, Some(_)) => return Err(OddReason::Taken),
        (_, None) => (start, end),
    };
    let lies = if kind == TierTiming::Listed {
        (start, end)
    } else {
        asked
    };
    taken_ranges.insert(lies.0, lies.1);
    Ok(asked)
}

/// Returns whether a tier has at most one annotation for each annotation of its parent tier.
#[must_use]
pub fn is_association(tier: &TierContents) -> bool {
    tier.row.stereotype == Some(TierStereotype::SymbolicAssociation)
}

#[cfg(test)]
mod tests {
    use super::super::testing::contents;
    use super::*;

    fn said(tier: Option<&str>, start: i64, end: i64) -> CopiedAnnotation {
        CopiedAnnotation {
            line: 0,
            tier: tier.map(str::to_owned),
            start,
            end,
            value: String::new(),
        }
    }

    fn recording() -> RecordingContents {
        contents(&[
            (1, None, "", &[(1, 0, 100, None), (2, 500, 600, None)]),
            (2, Some(1), "Included_In", &[(3, 10, 20, Some(1))]),
            (3, Some(1), "Time_Subdivision", &[]),
            (4, Some(1), "Symbolic_Association", &[(4, 0, 100, Some(1))]),
            (5, None, "", &[]),
        ])
    }

    /// Returns `(tier, start, end)` of the planned annotations, and the reasons for the refused lines.
    fn planned(to: usize, rows: Vec<CopiedAnnotation>, here: Option<i64>) -> (Vec<(i64, i64, i64)>, Vec<OddReason>) {
        let all = recording();
        let plan = plan_paste(&all, Some(&all.tiers[to]), rows, here, 1000, |_, _| true);
        let adds = plan.adds.iter().map(|it| (it.tier, it.span.0, it.span.1));
        (adds.collect(), plan.odd.iter().map(|it| it.why).collect())
    }

    #[test]
    fn offsets_are_kept_and_a_single_tier_is_pasted_into_the_selected_one() {
        let two = || vec![said(Some("tier 1"), 500, 600), said(Some("tier 1"), 700, 750)];
        assert_eq!(planned(4, two(), Some(10)), (vec![(5, 10, 110), (5, 210, 260)], vec![]));
        assert_eq!(planned(4, two(), None), (vec![(1, 700, 750)], vec![OddReason::Taken]));
        let other = vec![said(Some("elsewhere"), 5, 6), said(None, 7, 8)];
        assert_eq!(planned(4, other, None), (vec![(5, 5, 6), (5, 7, 8)], vec![]));
        let outside = vec![said(None, 0, 50)];
        assert_eq!(planned(4, outside, Some(960)), (vec![], vec![OddReason::Outside]));
    }

    #[test]
    fn pasted_children_follow_their_pasted_parents() {
        let group = vec![
            said(Some("tier 2"), 10, 20),
            said(Some("tier 3"), 0, 40),
            said(Some("tier 3"), 40, 100),
            said(Some("tier 4"), 0, 100),
            said(Some("tier 1"), 0, 100),
            said(Some("tier 9"), 0, 100),
        ];
        let (adds, odd) = planned(4, group, Some(200));
        let want = [
            (1, 200, 300),
            (2, 210, 220),
            (3, 200, 300),
            (3, 240, 300),
            (4, 200, 300),
        ];
        assert_eq!((adds, odd), (want.to_vec(), vec![OddReason::Tier]));
    }

    #[test]
    fn missing_and_occupied_parents_are_reported() {
        assert_eq!(planned(1, vec![said(None, 110, 120)], None).1, [OddReason::Parent]);
        assert_eq!(planned(3, vec![said(None, 0, 100)], None).1, [OddReason::Taken]);
        assert_eq!(planned(2, vec![said(None, 30, 60)], None), (vec![(3, 0, 100)], vec![]));
    }
}
