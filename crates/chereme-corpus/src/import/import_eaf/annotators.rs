//! Keeps the tiers of two annotators apart whose files give them one name.

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::eaf::eaf_convert::{AnnotationTranscript, TranscriptTier};
use chereme_formats::roles::TierGuess;

use super::{ImportJob, annotation_row, with_coded_state};
use crate::db::people;
use crate::db::stored_tiers::{self, AnnotationRow, TierRow};
use crate::error::CorpusResult;
use crate::report_finding::ReportFinding;

/// Gives tiers whose name a tier of another annotator has the name of theirs behind it: `Location (Ben)`. A tier that says
/// the same is one for both. `base` is the earlier version of this very file; returns notes about new names.
pub(super) fn keep_annotators_apart(
    job: &ImportJob<'_>,
    recording: i64,
    transcript: &mut AnnotationTranscript,
    mut base: Option<&mut AnnotationTranscript>,
    guesses: &[TierGuess],
) -> CorpusResult<Vec<ReportFinding>> {
    let rows = stored_tiers::load_tier_rows(job.connection, recording)?;
    let standing: BTreeMap<&str, &TierRow> = rows.iter().map(|row| (row.name.as_str(), row)).collect();
    let mut notes = Vec::new();
    let mut set_apart = BTreeSet::new();
    for place in transcript.tiers_parents_first() {
        let (tier, guess) = (&mut transcript.tiers[place], &guesses[place]);
        let Some((row, other)) = standing
            .get(&*tier.name)
            .and_then(|row| Some((*row, row.annotator.as_ref()?)))
        else {
            continue;
        };
        let annotator = people::known_person_name(job.connection, tier.annotator.as_deref())?;
        let Some(annotator) = annotator.filter(|name| name != other && !name.trim().is_empty()) else {
            continue;
        };
        let apart = format!("{} ({annotator})", tier.name);
        let is_known = standing
            .get(&*apart)
            .is_some_and(|row| row.annotator.as_ref() == Some(&annotator));
        // Annotations of one person stay below that person's.
        let is_below = tier.parent.is_some_and(|parent| set_apart.contains(&parent));
        // A file whose tier went to another person brings no second tier.
        if !is_known && (base.is_some() || !is_below && says_the_same(job, tier, guess, row)?) {
            continue;
        }
        set_apart.insert(place);
        if !is_known {
            notes.push(ReportFinding::finding_note(format!(
                "the tier {:?} is of {other}; that of {annotator} is called {apart:?} here",
                tier.name
            )));
        }
        let earlier = base.iter_mut().flat_map(|base| &mut base.tiers);
        for earlier in earlier.filter(|earlier| earlier.name == tier.name) {
            earlier.name.clone_from(&apart);
        }
        tier.name = apart;
    }
    Ok(notes)
}

/// Returns whether a tier of a file has the annotations of one of the corpus.
fn says_the_same(job: &ImportJob<'_>, tier: &TranscriptTier, guess: &TierGuess, row: &TierRow) -> CorpusResult<bool> {
    let said = |row: AnnotationRow| (row.start_us, row.end_us, row.value, row.state);
    let read = tier
        .annotations
        .iter()
        .map(|one| said(with_coded_state(annotation_row(one, 0, None), guess)));
    let stored = stored_tiers::load_tier_annotation_rows(job.connection, row.id)?;
    Ok(read.eq(stored.into_iter().map(said)))
}
