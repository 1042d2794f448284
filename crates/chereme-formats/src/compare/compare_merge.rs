//! A three-way merge of annotation documents.

mod merge_tiers;
mod removal;

use super::apply::{loosen_compared_annotation, order_by_references, revalue_loose_annotation};
use super::identity::{TranscriptMatching, has_same_times, match_transcripts};
use super::loose::TranscriptPieces;
use super::{
    ComparedAnnotation, ReferredAnnotation, compared_annotation_at, diff_transcripts, is_symbolic,
    list_annotation_addresses,
};
use crate::transcript::AnnotationTranscript;
use crate::transcript::{AnnotationAddress, TranscriptAnnotation};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

/// Two documents brought together.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct MergedTranscript {
    /// The merged document; it holds my side of each conflict.
    pub document: AnnotationTranscript,
    /// The annotations on which they do not agree.
    pub conflicts: Vec<MergeConflict>,
}

/// An annotation on which two documents do not agree, or which has no room on its tier.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct MergeConflict {
    /// The name of the tier.
    pub tier: String,
    /// Its state before both changes; `None` if it did not exist.
    pub base: Option<ComparedAnnotation>,
    /// My candidate, which the merged document keeps; `None` if my side removed it or never had it.
    pub mine: Option<ComparedAnnotation>,
    /// The other side's candidate; `None` if the other side removed it.
    pub theirs: Option<ComparedAnnotation>,
}

/// Merges `theirs` into `mine`; `base` is their common state.
///
/// A change of one side alone is taken, and equal changes of both count as one. If one side moves an end and the other
/// changes the text or the other end, both count. Two different changes of one thing, a change of something that the
/// other side removed, and an annotation without room on its tier are conflicts: the document keeps my state, and the
/// other candidate is in the list. Children follow their parents, and new ids follow the highest one in use on any
/// side.
#[must_use]
pub fn merge_transcripts(
    base: &AnnotationTranscript,
    mine: &AnnotationTranscript,
    theirs: &AnnotationTranscript,
) -> MergedTranscript {
    let my_matching = match_transcripts(base, mine);
    let other = match_transcripts(base, theirs);
    let mut work = TranscriptMergeWork {
        base,
        mine,
        theirs,
        known: kept_annotation_ids(base, mine, &my_matching).into_values().collect(),
        names: kept_annotation_ids(base, mine, &my_matching),
        places: list_annotation_addresses(base)
            .into_iter()
            .map(|place| (compared_annotation_at(base, place).id.clone(), place))
            .collect(),
        own: my_matching,
        other,
        from_base: BTreeMap::new(),
        from_theirs: BTreeMap::new(),
        pieces: TranscriptPieces::pieces_from_transcript(mine),
        conflicts: Vec::new(),
        brought: Vec::new(),
        fresh: BTreeMap::new(),
    };
    // New ids must be free on either side.
    for place in list_annotation_addresses(theirs) {
        work.pieces.note_id(&compared_annotation_at(theirs, place).id);
    }
    let changes = diff_transcripts(base, theirs);
    work.merge_tier_changes(&changes);
    let mut touched: BTreeMap<String, [Option<ComparedAnnotation>; 2]> = BTreeMap::new();
    for moved in changes.moved {
        touched.entry(moved.id).or_default()[0] = Some(moved.annotation);
    }
    for revalued in changes.revalued {
        touched.entry(revalued.id).or_default()[1] = Some(revalued.annotation);
    }
    for annotation in order_by_references(changes.added.iter()) {
        work.add_their_annotation(annotation);
    }
    // A place in a chain is given by the sibling before, so the siblings come in the order of their chain.
    let mut touched: Vec<_> = touched.into_iter().collect();
    touched.sort_by_key(|(_, [moved, _])| moved.as_ref().map(|annotation| annotation.whole.order));
    for (id, [moved, revalued]) in &touched {
        work.change_my_annotation(id, moved.as_ref(), revalued.as_ref());
    }
    work.adopt_their_parents();
    work.remove_all(&changes.removed);
    work.arrange_merged_siblings();
    work.revert_overlapping_changes();
    work.drop_tiers(&changes.tiers);
    work.list_orphans();
    work.merge_remaining_parts();
    MergedTranscript {
        document: work.pieces.reassemble_transcript(),
        conflicts: work.conflicts,
    }
}

/// Merges two documents without a common state.
///
/// An annotation of one of them alone is taken; if it differs between the two, it is a conflict, and the document keeps
/// my state.
#[must_use]
pub fn merge_two(mine: &AnnotationTranscript, theirs: &AnnotationTranscript) -> MergedTranscript {
    let matching = match_transcripts(mine, theirs);
    // The shared part of both serves as the state from which they have come.
    let mut base = TranscriptPieces::pieces_from_transcript(theirs);
    let shared: BTreeSet<&str> = matching
        .back
        .keys()
        .map(|place| compared_annotation_at(theirs, *place).id.as_str())
        .collect();
    base.all.retain(|id, _| shared.contains(id.as_str()));
    let tiers: BTreeSet<&str> = matching
        .tiers
        .iter()
        .flatten()
        .map(|at| theirs.tiers[*at].name.as_str())
        .collect();
    base.tiers.retain(|(tier, _)| tiers.contains(tier.name.as_str()));
    let base = base.reassemble_transcript();
    let mut merged = merge_transcripts(&base, mine, theirs);
    let changes = diff_transcripts(mine, theirs);
    let moved = changes.moved.into_iter().map(|change| (change.id, change.annotation));
    let revalued = changes
        .revalued
        .into_iter()
        .map(|change| (change.id, change.annotation));
    let differ: BTreeMap<String, ComparedAnnotation> = moved.chain(revalued).collect();
    let places: BTreeMap<&str, AnnotationAddress> = list_annotation_addresses(mine)
        .into_iter()
        .map(|place| (compared_annotation_at(mine, place).id.as_str(), place))
        .collect();
    for (id, annotation) in differ {
        let own_place = places.get(id.as_str());
        let own_annotation = own_place.map(|place| super::to_compared_annotation(mine, None, *place));
        merged.conflicts.push(MergeConflict {
            tier: own_annotation
                .as_ref()
                .map_or(&annotation.tier, |present| &present.tier)
                .clone(),
            base: None,
            mine: own_annotation,
            theirs: Some(annotation),
        });
    }
    merged
}

/// Returns the merged document with the other side's candidates of its conflicts added on tiers called `NAME (theirs)`,
/// so that one file keeps both.
#[must_use]
pub fn with_candidates(merged: &MergedTranscript) -> AnnotationTranscript {
    let mut pieces = TranscriptPieces::pieces_from_transcript(&merged.document);
    for conflict in &merged.conflicts {
        let Some(theirs) = &conflict.theirs else {
            continue;
        };
        let name = format!("{} (theirs)", conflict.tier);
        if pieces.find_loose_tier(&name).is_none() {
            pieces.tiers.push((
                crate::transcript::TranscriptTier {
                    name: name.clone(),
                    ..crate::transcript::TranscriptTier::default()
                },
                None,
            ));
        }
        let mut it = theirs.whole.clone();
        it.parent = None;
        it.entry = None;
        it.timing = crate::transcript::AnnotationTiming::Own;
        it.id = String::new();
        pieces.add_loose_annotation(super::loose::LooseAnnotation {
            it,
            tier: name,
            above: None,
            rank: 0.0,
        });
    }
    pieces.reassemble_transcript()
}

/// Returns the id in `mine` of each annotation of the base that `mine` still has.
fn kept_annotation_ids(
    base: &AnnotationTranscript,
    mine: &AnnotationTranscript,
    own: &TranscriptMatching,
) -> BTreeMap<String, String> {
    let pairs = own.pairs.iter();
    pairs
        .map(|(old, new)| {
            (
                compared_annotation_at(base, *old).id.clone(),
                compared_annotation_at(mine, *new).id.clone(),
            )
        })
        .collect()
}

struct TranscriptMergeWork<'w> {
    base: &'w AnnotationTranscript,
    mine: &'w AnnotationTranscript,
    theirs: &'w AnnotationTranscript,
    own: TranscriptMatching,
    /// The annotations that the base and the other side share.
    other: TranscriptMatching,
    names: BTreeMap<String, String>,
    /// The ids in `mine` of the annotations that come from the base.
    known: BTreeSet<String>,
    /// The annotations of the base by id.
    places: BTreeMap<String, AnnotationAddress>,
    /// The present name of each tier of the base that `mine` still has.
    from_base: BTreeMap<String, String>,
    /// The present name of each tier of the other side, if the merged document has the tier.
    from_theirs: BTreeMap<String, String>,
    pieces: TranscriptPieces,
    conflicts: Vec<MergeConflict>,
    /// Annotations from the other side: the id, its candidate, and my state of it before, if any.
    brought: Vec<(String, ComparedAnnotation, Option<ComparedAnnotation>)>,
    /// The new ids of annotations that the other side added.
    fresh: BTreeMap<String, String>,
}

impl TranscriptMergeWork<'_> {
    /// Returns an annotation of theirs with the ids and tier names of mine; `None` if its parent or its tier is gone.
    fn translate_their_annotation(&self, annotation: &ComparedAnnotation) -> Option<ComparedAnnotation> {
        let refer = |above: &ReferredAnnotation| match above {
            ReferredAnnotation::Known(id) => self.names.get(id).cloned().map(ReferredAnnotation::Known),
            ReferredAnnotation::New(id) => self.fresh.get(id).cloned().map(ReferredAnnotation::Known),
        };
        let mut new = annotation.clone();
        new.above = match &annotation.above {
            Some(above) => Some(refer(above)?),
            None => None,
        };
        new.before = annotation.before.as_ref().and_then(refer);
        new.tier = self.from_theirs.get(&annotation.tier)?.clone();
        Some(new)
    }

    fn add_their_annotation(&mut self, annotation: &ComparedAnnotation) {
        let Some(new) = self.translate_their_annotation(annotation) else {
            return self.record_merge_conflict(None, None, Some(annotation.clone()));
        };
        let above = match &new.above {
            Some(ReferredAnnotation::Known(id)) => Some(id.clone()),
            _ => None,
        };
        let tier_index = self.theirs.tiers.iter().position(|tier| tier.name == annotation.tier);
        let symbolic = tier_index.is_some_and(|tier| is_symbolic(self.theirs, tier));
        // Both sides may have added the same annotation, which then counts once.
        let twin = self.pieces.all.iter().find(|(id, it)| {
            let there = if symbolic {
                it.above == above
            } else {
                has_same_times(&it.it, &new.whole)
            };
            there
                && it.it.value == new.value
                && it.tier == new.tier
                && !self.known.contains(*id)
                && !self.fresh.values().any(|own| own == *id)
        });
        if let Some((id, _)) = twin {
            let id = id.clone();
            self.fresh.insert(annotation.id.clone(), id);
            return;
        }
        let mut loose = loosen_compared_annotation(&self.pieces, &new, &self.fresh);
        if symbolic {
            self.after_mine(&mut loose);
        }
        let id = self.pieces.add_loose_annotation(loose);
        self.fresh.insert(annotation.id.clone(), id.clone());
        self.brought.push((id, new, None));
    }

    /// If both sides added annotations at the same position of a chain, sorts them by their texts.
    fn after_mine(&self, loose: &mut super::loose::LooseAnnotation) {
        let all_loose = self.pieces.all.values();
        let mut siblings: Vec<_> = all_loose
            .filter(|sibling| sibling.tier == loose.tier && sibling.above == loose.above && sibling.rank > loose.rank)
            .collect();
        siblings.sort_by(|x, y| x.rank.total_cmp(&y.rank));
        for (at, it) in siblings.iter().enumerate() {
            if self.known.contains(&it.it.id) || it.it.value >= loose.it.value {
                break;
            }
            let next = siblings.get(at + 1).map_or(it.rank + 1.0, |next| next.rank);
            loose.rank = f64::midpoint(it.rank, next);
        }
    }

    fn change_my_annotation(
        &mut self,
        id: &str,
        moved: Option<&ComparedAnnotation>,
        revalued: Option<&ComparedAnnotation>,
    ) {
        let Some(annotation) = moved.or(revalued) else {
            return;
        };
        let before = self.state_in_base(id);
        let own_id = self.names.get(id).filter(|id| self.pieces.all.contains_key(*id));
        let Some(own) = own_id.cloned() else {
            return self.record_merge_conflict(before, None, Some(annotation.clone()));
        };
        let Some(old) = before.as_ref().map(|compared| compared.whole.clone()) else {
            return;
        };
        let Some(new) = self.translate_their_annotation(annotation) else {
            let mine = self.state_now(&own);
            return self.record_merge_conflict(before, mine, Some(annotation.clone()));
        };
        let mine = self.state_now(&own);
        let Some(mut loose_own) = self.pieces.all.get(&own).cloned() else {
            return;
        };
        let mut fails = false;
        if moved.is_some() {
            fails |= self.move_one(&mut loose_own, &old, &new, before.as_ref());
        }
        if let Some(annotation) = revalued {
            let (value, entry) = (&old.value, &old.entry);
            if loose_own.it.value == *value && loose_own.it.entry == *entry {
                revalue_loose_annotation(&mut loose_own, annotation);
            } else if loose_own.it.value != annotation.whole.value {
                fails = true;
            }
        }
        let empty = |annotation: &TranscriptAnnotation| {
            annotation.span.span_end_instant() <= annotation.span.span_start_instant()
        };
        // Two ends that were moved past each other leave no time between them.
        if empty(&loose_own.it) && !empty(&old) && !empty(&new.whole) {
            fails = true;
            loose_own.it.span = self.pieces.all[&own].it.span;
        }
        self.pieces.all.insert(own.clone(), loose_own);
        if fails {
            self.record_merge_conflict(before, mine, Some(new));
        } else if moved.is_some() && self.state_now(&own) != mine {
            // An annotation that both moved alike may overlap an addition of mine as much as it does in both documents.
            self.brought.push((own, new, mine));
        }
    }

    /// Moves an annotation as theirs did; returns whether mine moved the same end to another time.
    fn move_one(
        &self,
        own: &mut super::loose::LooseAnnotation,
        old: &TranscriptAnnotation,
        new: &ComparedAnnotation,
        before: Option<&ComparedAnnotation>,
    ) -> bool {
        let near = |a: i64, b: i64| a.abs_diff(b) <= super::TIME_TOLERANCE_MICROS.unsigned_abs();
        let (theirs, mine) = (&new.whole, own.it.clone());
        let mut fails = false;
        let mut merged = |old: i64, mine: i64, theirs: i64| {
            if near(old, theirs) || near(mine, theirs) {
                return mine;
            }
            fails |= !near(old, mine);
            if near(old, mine) { theirs } else { mine }
        };
        let micros = |annotation: &TranscriptAnnotation| {
            [
                annotation.span.span_start_instant().instant_micros(),
                annotation.span.span_end_instant().instant_micros(),
            ]
        };
        let ([a, b], [c, d], [e, f]) = (micros(old), micros(&mine), micros(theirs));
        let tier = self.pieces.tiers.iter().find(|entry| entry.0.name == new.tier);
        let symbolic = tier.is_some_and(|entry| is_chained(&entry.0));
        let (start, end) = (merged(a, c, e), merged(b, d, f));
        // Links of a chain have no times of their own.
        if !symbolic {
            let instant = chereme_motion::RecordingInstant::from_micros;
            if [start, end] == [e, f] {
                own.it.span = theirs.span;
                own.it.millis = theirs.millis;
                own.it.timing = theirs.timing;
            } else if [start, end] != [c, d] {
                own.it.span = chereme_motion::TimeSpan::span_between(instant(start), instant(end));
                own.it.millis = None;
            }
        } else {
            fails = false;
        }
        let base_tier = before.and_then(|annotation| self.from_base.get(&annotation.tier));
        if base_tier.is_none_or(|name| own.tier == *name && new.tier != *name) {
            own.tier.clone_from(&new.tier);
        }
        let base_parent = before.and_then(|annotation| match &annotation.above {
            Some(ReferredAnnotation::Known(id)) => self.names.get(id),
            _ => None,
        });
        if own.above.as_ref() == base_parent {
            let placed = loosen_compared_annotation(&self.pieces, new, &self.fresh);
            own.above = placed.above;
            if symbolic {
                own.rank = placed.rank;
            }
        }
        fails
    }

    /// Reverts additions and moves of the other side that overlap an annotation that mine added or moved; each becomes
    /// a conflict.
    fn revert_overlapping_changes(&mut self) {
        let mut by_tier: BTreeMap<String, Vec<(i64, i64, String)>> = BTreeMap::new();
        for (id, it) in &self.pieces.all {
            let span = it.it.span;
            let times = (
                span.span_start_instant().instant_micros(),
                span.span_end_instant().instant_micros(),
                id.clone(),
            );
            by_tier.entry(it.tier.clone()).or_default().push(times);
        }
        for all in by_tier.values_mut() {
            all.sort();
        }
        // Changes of theirs do not stand in each other's way, as they fit together in their document.
        let came: BTreeSet<String> = self.brought.iter().map(|entry| entry.0.clone()).collect();
        let changes = diff_transcripts(self.base, self.mine);
        let mut changed: BTreeSet<String> = changes.added.into_iter().map(|annotation| annotation.id).collect();
        changed.extend(changes.moved.into_iter().map(|change| change.annotation.id));
        // What mine keeps although theirs removed it is in the way, too.
        let gone = self.conflicts.iter().filter(|conflict| conflict.theirs.is_none());
        changed.extend(gone.filter_map(|conflict| Some(conflict.mine.as_ref()?.id.clone())));
        for (id, annotation, before) in std::mem::take(&mut self.brought) {
            let Some(own) = self.pieces.all.get(&id).cloned() else {
                continue;
            };
            let symbolic = self
                .pieces
                .find_loose_tier(&own.tier)
                .is_some_and(|(tier, _)| is_chained(tier));
            let (start, end) = own.it.span.span_bounds_micros();
            let over = by_tier.get(&own.tier).into_iter().flatten().any(|other| {
                other.2 != id
                    && changed.contains(&other.2)
                    && !came.contains(&other.2)
                    && other.0 < end
                    && start < other.1
                    && self.pieces.all.contains_key(&other.2)
            });
            if symbolic || !over {
                continue;
            }
            match &before {
                None => {
                    // Children of an addition that is taken back have no place without it.
                    for child in self.list_annotations_below(&id) {
                        let annotation = self.state_now(&child);
                        self.pieces.all.remove(&child);
                        self.record_merge_conflict(None, None, annotation);
                    }
                    self.pieces.all.remove(&id);
                }
                Some(mine) => {
                    if let Some(it) = self.pieces.all.get_mut(&id) {
                        it.it.span = mine.whole.span;
                        it.it.millis = mine.whole.millis;
                        it.it.timing = mine.whole.timing;
                        it.tier.clone_from(&mine.tier);
                    }
                }
            }
            self.record_merge_conflict(None, before, Some(annotation));
        }
    }

    /// Takes properties, media and vocabularies that theirs alone changed or added.
    fn merge_remaining_parts(&mut self) {
        let (base, theirs, own) = (self.base, self.theirs, &mut self.pieces.rest);
        take_their_value(&mut own.author, &base.author, &theirs.author);
        take_their_value(&mut own.media, &base.media, &theirs.media);
        take_their_value(&mut own.linked_files, &base.linked_files, &theirs.linked_files);
        for (name, value) in &theirs.properties {
            let old = base.properties.iter().find(|property| property.0 == *name);
            match own.properties.iter_mut().find(|property| property.0 == *name) {
                // Mine has not touched it, so that theirs counts.
                Some(mine) if old == Some(&*mine) => value.clone_into(&mut mine.1),
                Some(_) => {}
                // It is missing because mine has removed it, unless the base has none either.
                None if old.is_none() => own.properties.push((name.clone(), value.clone())),
                None => {}
            }
        }
        let kept = |property: &(String, String)| {
            !base.properties.contains(property) || theirs.properties.iter().any(|that| that.0 == property.0)
        };
        own.properties.retain(kept);
        let gone = |vocabulary: &crate::transcript::ControlledVocabulary| {
            base.vocabularies.contains(vocabulary) && theirs.vocabularies.iter().all(|that| that.id != vocabulary.id)
        };
        own.vocabularies.retain(|vocabulary| !gone(vocabulary));
        for vocabulary in &theirs.vocabularies {
            let old = base.vocabularies.iter().find(|candidate| candidate.id == vocabulary.id);
            match own
                .vocabularies
                .iter_mut()
                .find(|candidate| candidate.id == vocabulary.id)
            {
                Some(mine) if old == Some(&*mine) => mine.clone_from(vocabulary),
                Some(mine) => {
                    let all_entries = vocabulary.entries.iter();
                    // Both have changed the vocabulary: entries that theirs added are taken, and none is removed.
                    let more = all_entries.filter(|entry| {
                        let is_same =
                            |other_entry: &crate::transcript::VocabularyEntry| other_entry.values == entry.values;
                        !mine.entries.iter().any(is_same) && !old.is_some_and(|old| old.entries.iter().any(is_same))
                    });
                    let more: Vec<_> = more.cloned().collect();
                    mine.entries.extend(more);
                }
                None if old.is_none() => own.vocabularies.push(vocabulary.clone()),
                None => {}
            }
        }
    }

    fn record_merge_conflict(
        &mut self,
        base: Option<ComparedAnnotation>,
        mine: Option<ComparedAnnotation>,
        theirs: Option<ComparedAnnotation>,
    ) {
        let first = [&mine, &base, &theirs].into_iter().flatten().next();
        let tier = first.map(|annotation| annotation.tier.clone()).unwrap_or_default();
        self.conflicts.push(MergeConflict {
            tier,
            base,
            mine,
            theirs,
        });
    }

    fn state_in_base(&self, id: &str) -> Option<ComparedAnnotation> {
        let place = self.places.get(id)?;
        Some(super::to_compared_annotation(self.base, None, *place))
    }

    /// Returns the current state of an annotation in the merged document.
    fn state_now(&self, id: &str) -> Option<ComparedAnnotation> {
        let loose = self.pieces.all.get(id)?;
        Some(ComparedAnnotation {
            tier: loose.tier.clone(),
            id: id.to_owned(),
            start_us: loose.it.span.span_start_instant().instant_micros(),
            end_us: loose.it.span.span_end_instant().instant_micros(),
            value: loose.it.value.clone(),
            whole: loose.it.clone(),
            above: loose.above.clone().map(ReferredAnnotation::Known),
            before: None,
        })
    }
}

/// Reports whether the annotations of a tier have a place below a parent instead of times.
fn is_chained(tier: &crate::transcript::TranscriptTier) -> bool {
    tier.stereotype.is_some_and(|stereotype| !stereotype.is_alignable())
}

/// Takes the value of theirs if mine still has that of the base.
fn take_their_value<T: Clone + PartialEq>(mine: &mut T, base: &T, theirs: &T) {
    if mine == base {
        mine.clone_from(theirs);
    }
}
