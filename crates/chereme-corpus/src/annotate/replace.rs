//! Finds and replaces values of annotations, and shifts whole tiers in time.

use chereme_formats::table::annotations::TableMoment;
use chereme_motion::RecordingInstant;
use chereme_sign::ErrorRemedy;
use chereme_sign::text::fold_text;
use chereme_sign::tier::tier_spans::{self, SpanItem};
use regex::{NoExpand, Regex};
use rusqlite::Connection;
use serde::Serialize;

use super::{
    AnnotateOptions, AnnotateReport, AnnotationAction, AnnotationChange, AnnotationChangeRun, AnnotationName,
    TierRequestName, annotate_names,
};
use crate::Corpus;
use crate::address::{self, RowName};
use crate::db::stored_columns::ValueState;
use crate::db::stored_recordings::{self, RecordingRow};
use crate::db::stored_tiers::{self as rows, TierRow};
use crate::error::{CorpusError, CorpusResult};
use crate::progress::ProgressReceiver;
use crate::words::effect::OperationEffect;

/// A text or pattern to look for in the values of annotations.
#[derive(Debug, Clone)]
pub enum ValueSearch {
    /// This text, anywhere in a value.
    Text(String),
    /// This text, and nothing else in the value.
    Whole(String),
    /// Matches of a regular expression; `$1` in the replacement is its first group, whatever follows.
    Pattern(Regex),
}

impl ValueSearch {
    /// Reads a regular expression.
    ///
    /// # Errors
    /// Fails if the text is not a regular expression.
    pub fn from_value_pattern(text: &str) -> CorpusResult<Self> {
        let advice =
            || ErrorRemedy::command_remedy("write a regular expression such as ^BO.*; a text is found without --regex");
        Regex::new(text).map(Self::Pattern).map_err(|error| {
            let error_text = error.to_string();
            // The expression itself and a mark below the fault come first, and would fill the message.
            let why = error_text.lines().last().unwrap_or_default().trim();
            let why = why.trim_start_matches("error: ");
            CorpusError::from_wrong_message(format!("{text:?} is no regular expression: {why}"))
                .with_error_place(text)
                .with_advice(advice())
        })
    }

    /// Returns the new text with each group that it names in braces, so that letters after a number do not belong to
    /// the name.
    ///
    /// # Errors
    /// Fails if the pattern has no group of that name.
    fn expansion(&self, with: &str) -> CorpusResult<String> {
        let Self::Pattern(pattern) = self else {
            return Ok(with.to_owned());
        };
        let mut text = String::with_capacity(with.len());
        let mut rest = with;
        while let Some((before, after)) = rest.split_once('$') {
            text.push_str(before);
            let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
            let digits = after.len() - after.trim_start_matches(|c: char| c.is_ascii_digit()).len();
            let word = after.find(|c| !is_word(c)).unwrap_or(after.len());
            let (name, length) = match after.strip_prefix('{').and_then(|tail| tail.split_once('}')) {
                _ if after.starts_with('$') => {
                    text.push_str("$$");
                    rest = &after[1..];
                    continue;
                }
                Some((name, _)) => (name, name.len() + 2),
                None if digits > 0 => (&after[..digits], digits),
                None => (&after[..word], word),
            };
            let is_known = match name.parse::<usize>() {
                Ok(group) => group < pattern.captures_len(),
                Err(_) => pattern.capture_names().flatten().any(|other| other == name),
            };
            // An unknown group would silently become an empty text.
            if !is_known {
                return Err(CorpusError::from_wrong_message(format!(
                    "the new text names the group {name:?}, which the expression does not have"
                ))
                .with_error_place(with)
                .with_advice("$1 is the first group in round brackets; a dollar sign is written $$"));
            }
            text.push_str(&format!("${{{name}}}"));
            rest = &after[length..];
        }
        text.push_str(rest);
        Ok(text)
    }

    /// Returns `value` with all matches replaced.
    fn replaced(&self, value: &str, with: &str) -> String {
        match self {
            // An empty text would match between all letters.
            Self::Text(text) if text.is_empty() => value.to_owned(),
            Self::Text(text) => value.replace(text.as_str(), with),
            Self::Whole(text) if value == text => with.to_owned(),
            Self::Whole(_) => value.to_owned(),
            Self::Pattern(pattern) if with.contains('$') => pattern.replace_all(value, with).into_owned(),
            Self::Pattern(pattern) => pattern.replace_all(value, NoExpand(with)).into_owned(),
        }
    }
}

/// The tiers in which values are searched or that are shifted.
#[derive(Debug, Clone, Default)]
pub struct TierSelection {
    /// The recording; nothing for all of them.
    pub recording: Option<RowName>,
    /// Names of tiers, with `*` for any letters, or `tier:12`; empty for all of them.
    pub tiers: Vec<String>,
}

/// A value that was replaced, or would be in a dry run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ReplacedValue {
    /// The annotation's row.
    pub annotation: i64,
    /// The recording's name.
    pub recording: String,
    /// The tier's name.
    pub tier: String,
    /// The start, in microseconds.
    pub start_us: i64,
    /// The value before.
    pub from: String,
    /// The value after.
    pub to: String,
}

/// The result of a replacement or of a dry run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ReplacementReport {
    /// Whether nothing was written.
    pub dry_run: bool,
    /// How many annotations change.
    pub changed: u64,
    /// Each of them, by recording, tier and time.
    pub values: Vec<ReplacedValue>,
}

impl Corpus {
    /// Replaces the matches of `find` in the values of annotations by `with`, as one operation.
    ///
    /// A value that becomes empty is unset. With `dry_run` the replacement is tried and nothing is written.
    ///
    /// # Errors
    /// Fails if a tier does not exist, or its inventory does not have a new value; nothing is changed then.
    pub fn replace_values(
        &mut self,
        find: &ValueSearch,
        with: &str,
        within: &TierSelection,
        dry_run: bool,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<ReplacementReport> {
        let mut values = Vec::new();
        let with = find.expansion(with)?;
        for (recording, tier) in tiers_within(self.store.read_connection(), within)? {
            for row in rows::load_tier_annotation_rows(self.store.read_connection(), tier.id)? {
                let to = find.replaced(&row.value, &with);
                // Reasons for missing values are no texts to be replaced.
                if row.state == ValueState::Value && to != row.value {
                    values.push(ReplacedValue {
                        annotation: row.id,
                        recording: recording.name.clone(),
                        tier: tier.name.clone(),
                        start_us: row.start_us,
                        from: row.value,
                        to,
                    });
                }
            }
        }
        let changes: Vec<AnnotationChange> = values.iter().map(replacement_change).collect();
        let report = match changes.is_empty() {
            true => AnnotateReport::default(),
            false => self.annotate_or_try(&changes, dry_run, progress)?,
        };
        Ok(ReplacementReport {
            dry_run,
            changed: report.changed,
            values,
        })
    }

    /// Moves all annotations of tiers by `by_us` microseconds, as one operation, together with all
    /// annotations below them.
    ///
    /// # Errors
    /// Fails if a tier does not exist or has no times of its own, or if an annotation would leave the recording or its
    /// parent annotation; nothing is changed then.
    pub fn shift_tiers(
        &mut self,
        within: &TierSelection,
        by_us: i64,
        dry_run: bool,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<AnnotateReport> {
        let connection = self.store.read_connection();
        let chosen = tiers_within(connection, within)?;
        let changes = plan_tier_shift(connection, &chosen, within.tiers.is_empty(), by_us)?;
        match changes.is_empty() {
            true => Ok(AnnotateReport::default()),
            false => self.annotate_or_try(&changes, dry_run, progress),
        }
    }

    /// Carries out changes; with `dry_run` it rolls them back.
    fn annotate_or_try(
        &mut self,
        changes: &[AnnotationChange],
        dry_run: bool,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<AnnotateReport> {
        let options = AnnotateOptions::default();
        if !dry_run {
            return self.annotate_corpus(changes, &options, progress);
        }
        let mut tried = None;
        let carry = |connection: &Connection, progress: &mut ProgressReceiver<'_>| {
            let mut work = AnnotationChangeRun::new(connection, &options)?;
            for change in changes {
                work.run_annotation_change(change)?;
            }
            tried = Some(work.finish_annotation_changes(changes.len(), progress)?);
            // An error rolls the attempt back.
            Err::<((), OperationEffect), _>(CorpusError::Stopped)
        };
        let done = self.store.operation_with_progress(progress, carry);
        match (done, tried) {
            (_, Some(report)) => Ok(report),
            (Err(error), None) => Err(error),
            (Ok(()), None) => Ok(AnnotateReport::default()),
        }
    }
}

/// Returns the changes that move tiers in time; of a whole recording those of its root tiers, which the others follow.
pub(super) fn plan_tier_shift(
    connection: &Connection,
    chosen: &[(RecordingRow, TierRow)],
    is_whole: bool,
    by_us: i64,
) -> CorpusResult<Vec<AnnotationChange>> {
    let ids: Vec<i64> = chosen.iter().map(|(_, tier)| tier.id).collect();
    let mut changes = Vec::new();
    for (recording, tier) in chosen {
        let goes_along = tier.parent_id.is_some_and(|above| ids.contains(&above));
        if goes_along || (is_whole && tier.parent_id.is_some()) {
            continue;
        }
        let old: Vec<SpanItem> = rows::load_tier_annotation_rows(connection, tier.id)?
            .iter()
            .map(|row| annotation_item(row.id, row.annotation_row_span()))
            .collect();
        let new: Vec<SpanItem> = old.iter().map(|item| shift_item_by(*item, by_us)).collect();
        check_shift_range(connection, recording, tier, &new, by_us)?;
        for item in tier_spans::order_span_changes(&old, &new) {
            changes.push(shifted_times_change(recording, tier, item));
        }
    }
    Ok(changes)
}

fn replacement_change(value: &ReplacedValue) -> AnnotationChange {
    let start_instant = RecordingInstant::from_micros(value.start_us);
    AnnotationChange {
        place: Some(format!(
            "{:?} at {start_instant} on {:?} of {:?}",
            value.from, value.tier, value.recording
        )),
        label: None,
        action: AnnotationAction::Set {
            annotation: AnnotationName::Number(value.annotation),
            start: None,
            end: None,
            value: Some(value.to.clone()),
        },
    }
}

fn shifted_times_change(recording: &RecordingRow, tier: &TierRow, item: SpanItem) -> AnnotationChange {
    let moment = |micros| Some(TableMoment::Time(RecordingInstant::from_micros(micros)));
    AnnotationChange {
        place: Some(format!("{:?} of {:?}", tier.name, recording.name)),
        label: None,
        action: AnnotationAction::Set {
            annotation: AnnotationName::Number(item.id),
            start: moment(item.start),
            end: moment(item.end),
            value: None,
        },
    }
}

pub(super) fn annotation_item(id: i64, span: chereme_motion::TimeSpan) -> SpanItem {
    SpanItem {
        id,
        start: span.span_start_instant().instant_micros(),
        end: span.span_end_instant().instant_micros(),
    }
}

fn shift_item_by(item: SpanItem, by: i64) -> SpanItem {
    SpanItem {
        start: item.start.saturating_add(by),
        end: item.end.saturating_add(by),
        ..item
    }
}

/// Fails if a shift would leave the recording; the error names the largest possible shift.
fn check_shift_range(
    connection: &Connection,
    recording: &RecordingRow,
    tier: &TierRow,
    new: &[SpanItem],
    by: i64,
) -> CorpusResult<()> {
    let first = new.iter().map(|item| item.start).min().unwrap_or(0);
    let last = new.iter().map(|item| item.end).max().unwrap_or(0);
    let moves = stored_recordings::body_track(connection, recording.id)?.is_some();
    // Without movement, the recording can become longer.
    let over = if moves { last - recording.duration_us } else { 0 };
    let most = match (first < 0, over > 0) {
        (true, _) => by - first,
        (_, true) => by - over,
        _ => return Ok(()),
    };
    Err(CorpusError::from_wrong_message(format!(
        "annotations of the tier {:?} would leave the recording {:?}",
        tier.name, recording.name
    ))
    .with_error_place(format!("{:?} of {:?}", tier.name, recording.name))
    .with_advice(format!("shift it by {:.3}s at most", most as f64 / 1e6)))
}

/// Returns the selected tiers with their recordings, in order.
fn tiers_within(connection: &Connection, within: &TierSelection) -> CorpusResult<Vec<(RecordingRow, TierRow)>> {
    let recordings = match &within.recording {
        Some(name) => vec![address::find_recording_by_name(connection, name)?],
        None => stored_recordings::load_recording_rows(connection)?,
    };
    let mut matching_tiers = Vec::new();
    let mut used = vec![false; within.tiers.len()];
    for recording in recordings {
        for tier in rows::load_tier_rows(connection, recording.id)? {
            let mut wanted = within.tiers.is_empty();
            for (text, used) in within.tiers.iter().zip(&mut used) {
                if tier.is_meant_by(text) {
                    (wanted, *used) = (true, true);
                }
            }
            if wanted {
                matching_tiers.push((recording.clone(), tier));
            }
        }
    }
    // A name that fits no tier is probably misspelt.
    if let Some((text, _)) = within.tiers.iter().zip(used).find(|(_, used)| !used) {
        return Err(match &within.recording {
            // Lists the existing tiers.
            Some(_) => {
                let name = TierRequestName::parse_tier_name(text, within.recording.as_ref())?;
                match annotate_names::find_named_tier(connection, &name) {
                    Err(error) => error,
                    Ok(_) => no_tier(text),
                }
            }
            None => no_tier(text),
        });
    }
    Ok(matching_tiers)
}

fn no_tier(text: &str) -> CorpusError {
    CorpusError::from_wrong_message(format!("no recording has a tier {text:?}"))
        .with_error_place(text)
        .with_command_advice("`chereme list CORPUS tiers` lists them")
}

impl TierRow {
    /// Returns whether the tier has that name or number; `*` matches any letters.
    pub(super) fn is_meant_by(&self, text: &str) -> bool {
        match text.parse() {
            Ok(crate::CorpusAddress::Tier(id)) => id == self.id,
            _ => is_meant(text, &self.name),
        }
    }
}

/// Returns whether a name is that text, ignoring case and accents; `*` matches any letters.
pub(super) fn is_meant(text: &str, name: &str) -> bool {
    let name = fold_text(name);
    let wanted = fold_text(text.trim());
    let mut parts = wanted.split('*');
    let first = parts.next().unwrap_or_default();
    let Some(mut rest) = name.strip_prefix(first) else {
        return false;
    };
    let parts: Vec<&str> = parts.collect();
    let Some((last, middle)) = parts.split_last() else {
        return rest.is_empty();
    };
    for part in middle {
        match rest.find(part) {
            Some(at) => rest = &rest[at + part.len()..],
            None => return false,
        }
    }
    rest.ends_with(last)
}
