//! A three-way merge of annotation documents.

mod removal;
mod tiers;

use super::apply::{in_order, loose, revalue};
use super::identity::{Matching, alike, matched};
use super::loose::Pieces;
use super::{Above, ComparedAnnotation, diff, get, is_symbolic, places};
use crate::eaf::Transcript;
use crate::eaf::convert::{Annotation, AnnotationAddress};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

/// Two documents brought together.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Merged {
    /// The merged document; it holds my side of each conflict.
    pub document: Transcript,
    /// The annotations on which they do not agree.
    pub conflicts: Vec<Conflict>,
}

/// An annotation on which two documents do not agree, or which has no room on its tier.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Conflict {
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
pub fn merge(base: &Transcript, mine: &Transcript, theirs: &Transcript) -> Merged {
    let own = matched(base, mine);
    let other = matched(base, theirs);
    let mut work = Work {
        base,
        mine,
        theirs,
        known: names(base, mine, &own).into_values().collect(),
        names: names(base, mine, &own),
        places: places(base)
            .into_iter()
            .map(|place| (get(base, place).id.clone(), place))
            .collect(),
        own,
        other,
        from_base: BTreeMap::new(),
        from_theirs: BTreeMap::new(),
        pieces: Pieces::of(mine),
        conflicts: Vec::new(),
        brought: Vec::new(),
        fresh: BTreeMap::new(),
    };
    for place in places(theirs) {
        work.pieces.note_id(&get(theirs, place).id);
    }
    let changes = diff(base, theirs);
    work.tiers(&changes);
    let mut touched: BTreeMap<String, [Option<ComparedAnnotation>; 2]> = BTreeMap::new();
    for moved in changes.moved {
        touched.entry(moved.id).or_default()[0] = Some(moved.annotation);
    }
    for revalued in changes.revalued {
        touched.entry(revalued.id).or_default()[1] = Some(revalued.annotation);
    }
    for annotation in in_order(changes.added.iter()) {
        work.add(annotation);
    }
    // A place in a chain is given by the sibling before, so the siblings come in the order of their chain.
    let mut touched: Vec<_> = touched.into_iter().collect();
    touched.sort_by_key(|(_, [moved, _])| moved.as_ref().map(|it| it.whole.order));
    for (id, [moved, revalued]) in &touched {
        work.change(id, moved.as_ref(), revalued.as_ref());
    }
    work.adopt();
    work.remove_all(&changes.removed);
    work.arrange();
    work.make_room();
    work.drop_tiers(&changes.tiers);
    work.list_orphans();
    work.rest();
    Merged {
        document: work.pieces.whole(),
        conflicts: work.conflicts,
    }
}

/// Merges two documents without a common state.
///
/// An annotation of one of them alone is taken; if it differs between the two, it is a conflict, and the document keeps
/// my state.
#[must_use]
pub fn merge_two(mine: &Transcript, theirs: &Transcript) -> Merged {
    let matching = matched(mine, theirs);
    let mut base = Pieces::of(theirs);
    let shared: BTreeSet<&str> = matching
        .back
        .keys()
        .map(|place| get(theirs, *place).id.as_str())
        .collect();
    base.all.retain(|id, _| shared.contains(id.as_str()));
    let tiers: BTreeSet<&str> = matching
        .tiers
        .iter()
        .flatten()
        .map(|at| theirs.tiers[*at].name.as_str())
        .collect();
    base.tiers
        .retain(|(tier, _)| tiers.contains(tier.name.as_str()));
    let base = base.whole();
    let mut merged = merge(&base, mine, theirs);
    let changes = diff(mine, theirs);
    let moved = changes.moved.into_iter().map(|it| (it.id, it.annotation));
    let revalued = changes
        .revalued
        .into_iter()
        .map(|it| (it.id, it.annotation));
    let differ: BTreeMap<String, ComparedAnnotation> = moved.chain(revalued).collect();
    let places: BTreeMap<&str, AnnotationAddress> = places(mine)
        .into_iter()
        .map(|place| (get(mine, place).id.as_str(), place))
        .collect();
    for (id, annotation) in differ {
        let own = places.get(id.as_str());
        let own = own.map(|place| super::compared((mine, None), *place));
        merged.conflicts.push(Conflict {
            tier: own.as_ref().map_or(&annotation.tier, |it| &it.tier).clone(),
            base: None,
            mine: own,
            theirs: Some(annotation),
        });
    }
    merged
}

/// Returns the merged document with the other side's candidates of its conflicts added on tiers called `NAME (theirs)`,
/// so that one file keeps both.
#[must_use]
pub fn with_candidates(merged: &Merged) -> Transcript {
    let mut pieces = Pieces::of(&merged.document);
    for conflict in &merged.conflicts {
        let Some(theirs) = &conflict.theirs else {
            continue;
        };
        let name = format!("{} (theirs)", conflict.tier);
        if pieces.tier(&name).is_none() {
            pieces.tiers.push((
                crate::eaf::convert::Tier {
                    name: name.clone(),
                    ..crate::eaf::convert::Tier::default()
                },
                None,
            ));
        }
        let mut it = theirs.whole.clone();
        it.parent = None;
        it.entry = None;
        it.timing = crate::eaf::convert::Timing::Own;
        it.id = String::new();
        pieces.add(super::loose::Loose {
            it,
            tier: name,
            above: None,
            rank: 0.0,
        });
    }
    pieces.whole()
}

/// Returns the id in `mine` of each annotation of the base that `mine` still has.
fn names(base: &Transcript, mine: &Transcript, own: &Matching) -> BTreeMap<String, String> {
    let pairs = own.pairs.iter();
    pairs
        .map(|(old, new)| (get(base, *old).id.clone(), get(mine, *new).id.clone()))
        .collect()
}

struct Work<'w> {
    base: &'w Transcript,
    mine: &'w Transcript,
    theirs: &'w Transcript,
    own: Matching,
    /// The annotations that the base and the other side share.
    other: Matching,
    names: BTreeMap<String, String>,
    /// The ids in `mine` of the annotations that come from the base.
    known: BTreeSet<String>,
    /// The annotations of the base by id.
    places: BTreeMap<String, AnnotationAddress>,
    /// The present name of each tier of the base that `mine` still has.
    from_base: BTreeMap<String, String>,
    /// The present name of each tier of the other side, if the merged document has the tier.
    from_theirs: BTreeMap<String, String>,
    pieces: Pieces,
    conflicts: Vec<Conflict>,
    /// Annotations from the other side: the id, its candidate, and my state of it before, if any.
    brought: Vec<(String, ComparedAnnotation, Option<ComparedAnnotation>)>,
    /// The new ids of annotations that the other side added.
    fresh: BTreeMap<String, String>,
}

impl Work<'_> {
    /// Returns an annotation of theirs with the ids and tier names of mine; `None` if its parent or its tier is gone.
    fn translated(&self, annotation: &ComparedAnnotation) -> Option<ComparedAnnotation> {
        let refer = |it: &Above| match it {
            Above::Known(id) => self.names.get(id).cloned().map(Above::Known),
            Above::New(id) => self.fresh.get(id).cloned().map(Above::Known),
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

    fn add(&mut self, annotation: &ComparedAnnotation) {
        let Some(new) = self.translated(annotation) else {
            return self.conflict(None, None, Some(annotation.clone()));
        };
        let above = match &new.above {
            Some(Above::Known(id)) => Some(id.clone()),
            _ => None,
        };
        let symbolic = self
            .theirs
            .tiers
            .iter()
            .position(|it| it.name == annotation.tier);
        let symbolic = symbolic.is_some_and(|tier| is_symbolic(self.theirs, tier));
        let twin = self.pieces.all.iter().find(|(id, it)| {
            let there = if symbolic {
                it.above == above
            } else {
                alike(&it.it, &new.whole)
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
        let mut loose = loose(&self.pieces, &new, &self.fresh);
        if symbolic {
            self.after_mine(&mut loose);
        }
        let id = self.pieces.add(loose);
        self.fresh.insert(annotation.id.clone(), id.clone());
        self.brought.push((id, new, None));
    }

    /// If both sides added annotations at the same position of a chain, sorts them by their texts.
    fn after_mine(&self, loose: &mut super::loose::Loose) {
        let siblings = self.pieces.all.values();
        let mut siblings: Vec<_> = siblings
            .filter(|it| it.tier == loose.tier && it.above == loose.above && it.rank > loose.rank)
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

    fn change(
        &mut self,
        id: &str,
        moved: Option<&ComparedAnnotation>,
        revalued: Option<&ComparedAnnotation>,
    ) {
        let Some(annotation) = moved.or(revalued) else {
            return;
        };
        let before = self.state_in_base(id);
        let own = self
            .names
            .get(id)
            .filter(|id| self.pieces.all.contains_key(*id));
        let Some(own) = own.cloned() else {
            return self.conflict(before, None, Some(annotation.clone()));
        };
        let Some(old) = before.as_ref().map(|it| it.whole.clone()) else {
            return;
        };
        let Some(new) = self.translated(annotation) else {
            let mine = self.state_now(&own);
            return self.conflict(before, mine, Some(annotation.clone()));
        };
        let mine = self.state_now(&own);
        let Some(mut loose_own) = self.pieces.all.get(&own).cloned() else {
            return;
        };
        let mut fails = false;
        if moved.is_some() {
            fails |= self.move_one(&mut loose_own, (&old, &new), before.as_ref());
        }
        if let Some(annotation) = revalued {
            let (value, entry) = (&old.value, &old.entry);
            if loose_own.it.value == *value && loose_own.it.entry == *entry {
                revalue(&mut loose_own, annotation);
            } else if loose_own.it.value != annotation.whole.value {
                fails = true;
            }
        }
        let empty = |it: &Annotation| it.span.end() <= it.span.start();
        if empty(&loose_own.it) && !empty(&old) && !empty(&new.whole) {
            fails = true;
            loose_own.it.span = self.pieces.all[&own].it.span;
        }
        self.pieces.all.insert(own.clone(), loose_own);
        if fails {
            self.conflict(before, mine, Some(new));
        } else if moved.is_some() {
            self.brought.push((own, new, mine));
        }
    }

    /// Moves an annotation as theirs did; returns whether mine moved the same end to another time.
    fn move_one(
        &self,
        own: &mut super::loose::Loose,
        (old, new): (&Annotation, &ComparedAnnotation),
        before: Option<&ComparedAnnotation>,
    ) -> bool {
        let near = |a: i64, b: i64| a.abs_diff(b) <= super::TOLERANCE.unsigned_abs();
        let (theirs, mine) = (&new.whole, own.it.clone());
        let mut fails = false;
        let mut merged = |old: i64, mine: i64, theirs: i64| {
            if near(old, theirs) || near(mine, theirs) {
                return mine;
            }
            fails |= !near(old, mine);
            if near(old, mine) { theirs } else { mine }
        };
        let micros = |it: &Annotation| [it.span.start().micros(), it.span.end().micros()];
        let ([a, b], [c, d], [e, f]) = (micros(old), micros(&mine), micros(theirs));
        let tier = self.pieces.tiers.iter().find(|it| it.0.name == new.tier);
        let symbolic = tier.is_some_and(|it| is_chained(&it.0));
        let (start, end) = (merged(a, c, e), merged(b, d, f));
        if !symbolic {
            let instant = chereme_motion::Instant::from_micros;
            if [start, end] == [e, f] {
                own.it.span = theirs.span;
                own.it.millis = theirs.millis;
                own.it.timing = theirs.timing;
            } else if [start, end] != [c, d] {
                own.it.span = chereme_motion::Span::between(instant(start), instant(end));
                own.it.millis = None;
            }
        } else {
            fails = false;
        }
        let base_tier = before.and_then(|it| self.from_base.get(&it.tier));
        if base_tier.is_none_or(|name| own.tier == *name && new.tier != *name) {
            own.tier.clone_from(&new.tier);
        }
        let known = before.and_then(|it| match &it.above {
            Some(Above::Known(id)) => self.names.get(id),
            _ => None,
        });
        if own.above.as_ref() == known {
            let placed = loose(&self.pieces, new, &self.fresh);
            own.above = placed.above;
            if symbolic {
                own.rank = placed.rank;
            }
        }
        fails
    }

    /// Reverts additions and moves of the other side that overlap an annotation that mine added or moved; each becomes
    /// a conflict.
    fn make_room(&mut self) {
        let mut by_tier: BTreeMap<String, Vec<(i64, i64, String)>> = BTreeMap::new();
        for (id, it) in &self.pieces.all {
            let span = it.it.span;
            let times = (span.start().micros(), span.end().micros(), id.clone());
            by_tier.entry(it.tier.clone()).or_default().push(times);
        }
        for all in by_tier.values_mut() {
            all.sort();
        }
        let came: BTreeSet<String> = self.brought.iter().map(|it| it.0.clone()).collect();
        let changes = diff(self.base, self.mine);
        let mut changed: BTreeSet<String> = changes.added.into_iter().map(|it| it.id).collect();
        changed.extend(changes.moved.into_iter().map(|it| it.annotation.id));
        let gone = self.conflicts.iter().filter(|it| it.theirs.is_none());
        changed.extend(gone.filter_map(|it| Some(it.mine.as_ref()?.id.clone())));
        for (id, annotation, before) in std::mem::take(&mut self.brought) {
            let Some(own) = self.pieces.all.get(&id).cloned() else {
                continue;
            };
            let symbolic = self
                .pieces
                .tier(&own.tier)
                .is_some_and(|(tier, _)| is_chained(tier));
            let (start, end) = (own.it.span.start().micros(), own.it.span.end().micros());
            let over = by_tier.get(&own.tier).into_iter().flatten().any(|it| {
                it.2 != id
                    && changed.contains(&it.2)
                    && !came.contains(&it.2)
                    && it.0 < end
                    && start < it.1
                    && self.pieces.all.contains_key(&it.2)
            });
            if symbolic || !over {
                continue;
            }
            match &before {
                None => {
                    for child in self.below(&id) {
                        let annotation = self.state_now(&child);
                        self.pieces.all.remove(&child);
                        self.conflict(None, None, annotation);
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
            self.conflict(None, before, Some(annotation));
        }
    }

    /// Takes properties, media and vocabularies that theirs alone changed or added.
    fn rest(&mut self) {
        let (base, theirs, own) = (self.base, self.theirs, &mut self.pieces.rest);
        take(&mut own.author, &base.author, &theirs.author);
        take(&mut own.media, &base.media, &theirs.media);
        take(
            &mut own.linked_files,
            &base.linked_files,
            &theirs.linked_files,
        );
        for (name, value) in &theirs.properties {
            let old = base.properties.iter().find(|it| it.0 == *name);
            match own.properties.iter_mut().find(|it| it.0 == *name) {
                Some(mine) if old == Some(&*mine) => value.clone_into(&mut mine.1),
                Some(_) => {}
                None if old.is_none() => own.properties.push((name.clone(), value.clone())),
                None => {}
            }
        }
        let kept = |it: &(String, String)| {
            !base.properties.contains(it) || theirs.properties.iter().any(|that| that.0 == it.0)
        };
        own.properties.retain(kept);
        let gone = |it: &crate::eaf::convert::Vocabulary| {
            base.vocabularies.contains(it)
                && theirs.vocabularies.iter().all(|that| that.id != it.id)
        };
        own.vocabularies.retain(|it| !gone(it));
        for vocabulary in &theirs.vocabularies {
            let old = base.vocabularies.iter().find(|it| it.id == vocabulary.id);
            match own
                .vocabularies
                .iter_mut()
                .find(|it| it.id == vocabulary.id)
            {
                Some(mine) if old == Some(&*mine) => mine.clone_from(vocabulary),
                Some(mine) => {
                    let more = vocabulary.entries.iter();
                    let more = more.filter(|entry| {
                        let known =
                            |it: &crate::eaf::convert::VocabularyEntry| it.values == entry.values;
                        !mine.entries.iter().any(known)
                            && !old.is_some_and(|old| old.entries.iter().any(known))
                    });
                    let more: Vec<_> = more.cloned().collect();
                    mine.entries.extend(more);
                }
                None if old.is_none() => own.vocabularies.push(vocabulary.clone()),
                None => {}
            }
        }
    }

    fn conflict(
        &mut self,
        base: Option<ComparedAnnotation>,
        mine: Option<ComparedAnnotation>,
        theirs: Option<ComparedAnnotation>,
    ) {
        let first = [&mine, &base, &theirs].into_iter().flatten().next();
        let tier = first.map(|it| it.tier.clone()).unwrap_or_default();
        self.conflicts.push(Conflict {
            tier,
            base,
            mine,
            theirs,
        });
    }

    fn state_in_base(&self, id: &str) -> Option<ComparedAnnotation> {
        let place = self.places.get(id)?;
        Some(super::compared((self.base, None), *place))
    }

    /// Returns the current state of an annotation in the merged document.
    fn state_now(&self, id: &str) -> Option<ComparedAnnotation> {
        let loose = self.pieces.all.get(id)?;
        Some(ComparedAnnotation {
            tier: loose.tier.clone(),
            id: id.to_owned(),
            start_us: loose.it.span.start().micros(),
            end_us: loose.it.span.end().micros(),
            value: loose.it.value.clone(),
            whole: loose.it.clone(),
            above: loose.above.clone().map(Above::Known),
            before: None,
        })
    }
}

/// Reports whether the annotations of a tier have a place below a parent instead of times.
fn is_chained(tier: &crate::eaf::convert::Tier) -> bool {
    tier.stereotype.is_some_and(|it| !it.is_alignable())
}

/// Takes the value of theirs if mine still has that of the base.
fn take<T: Clone + PartialEq>(mine: &mut T, base: &T, theirs: &T) {
    if mine == base {
        mine.clone_from(theirs);
    }
}
