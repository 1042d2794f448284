//! Removes what theirs removed, and gives parents and places to what remains.

use super::{TranscriptMergeWork, is_chained};
use crate::compare::identity::has_same_times;
use crate::compare::{ComparedAnnotation, compared_annotation_at, is_symbolic};
use crate::transcript::AnnotationAddress;
use std::collections::{BTreeMap, BTreeSet};

impl TranscriptMergeWork<'_> {
    /// Removes annotations that theirs removed, each after those below it. One that mine changed, or that still has one
    /// below it, is a conflict.
    pub(super) fn remove_all(&mut self, removed: &[ComparedAnnotation]) {
        let mut below: BTreeMap<String, usize> = BTreeMap::new();
        for above in self.pieces.all.values().filter_map(|loose| loose.above.clone()) {
            *below.entry(above).or_default() += 1;
        }
        let mut left: Vec<&ComparedAnnotation> = removed.iter().rev().collect();
        loop {
            let before = left.len();
            left.retain(|annotation| !self.remove_merged_annotation(annotation, &mut below));
            if left.len() == before {
                break;
            }
        }
        for annotation in left {
            let own_id = self.names.get(&annotation.id);
            let mine = own_id.and_then(|id| self.state_now(id));
            self.record_merge_conflict(Some(annotation.clone()), mine, None);
        }
    }

    /// Removes an annotation, and returns whether it is gone; `below` counts the annotations below each.
    fn remove_merged_annotation(
        &mut self,
        annotation: &ComparedAnnotation,
        below: &mut BTreeMap<String, usize>,
    ) -> bool {
        let own_id = self.names.get(&annotation.id);
        let Some((own, now)) = own_id.and_then(|id| Some((id, self.pieces.all.get(id)?))) else {
            return true;
        };
        let named_tiers = self.pieces.tiers.iter();
        let mut chained = named_tiers.filter(|entry| entry.0.name == now.tier);
        let chained = chained.next().is_some_and(|entry| is_chained(&entry.0));
        let same = now.it.value == annotation.value && (chained || has_same_times(&now.it, &annotation.whole));
        if !same || below.get(own).is_some_and(|count| *count > 0) {
            return false;
        }
        if let Some(count) = now.above.as_ref().and_then(|above| below.get_mut(above)) {
            *count -= 1;
        }
        let removed_id = own.clone();
        self.pieces.all.remove(&removed_id);
        true
    }

    /// Gives annotations with times the parents that they have in theirs, unless mine gave them others: a parent that was
    /// split or replaced leaves its children to another.
    pub(super) fn adopt_their_parents(&mut self) {
        for (old, new) in &self.other.pairs {
            if is_symbolic(self.theirs, new.tier) {
                continue;
            }
            let (old, new) = (
                compared_annotation_at(self.base, *old),
                compared_annotation_at(self.theirs, *new),
            );
            let base_id = old.parent.map(|place| &compared_annotation_at(self.base, place).id);
            let base = base_id.and_then(|id| self.names.get(id)).cloned();
            let theirs = new.parent.map(|place| self.name_of_theirs(place));
            let own_id = self.names.get(&old.id);
            let own_loose = own_id.and_then(|id| self.pieces.all.get_mut(id));
            if let Some(own) = own_loose.filter(|loose| loose.above == base) {
                match theirs {
                    Some(None) => {}
                    Some(theirs) => own.above = theirs,
                    None => own.above = None,
                }
            }
        }
    }

    /// Returns the id in the merged document of an annotation of theirs.
    fn name_of_theirs(&self, place: AnnotationAddress) -> Option<String> {
        match self.other.back.get(&place) {
            Some(known) => self.names.get(&compared_annotation_at(self.base, *known).id).cloned(),
            None => self.fresh.get(&compared_annotation_at(self.theirs, place).id).cloned(),
        }
    }

    /// Puts the siblings of each chain in the order of theirs, if mine has the same siblings in the order of the base.
    pub(super) fn arrange_merged_siblings(&mut self) {
        let mut families: BTreeMap<(&str, &str), BTreeSet<&str>> = BTreeMap::new();
        for (id, it) in &self.pieces.all {
            if let Some(above) = &it.above {
                let family = families.entry((&it.tier, above)).or_default();
                family.insert(id);
            }
        }
        let mut ranks: Vec<(String, f64)> = Vec::new();
        for (tier, it) in self.theirs.tiers.iter().enumerate() {
            let Some(name) = self.from_theirs.get(&it.name).filter(|_| is_chained(it)) else {
                continue;
            };
            let mut chains: BTreeMap<AnnotationAddress, Vec<AnnotationAddress>> = BTreeMap::new();
            for (index, own) in it.annotations.iter().enumerate() {
                if let Some(parent) = own.parent {
                    let chain = chains.entry(parent).or_default();
                    chain.push(AnnotationAddress { tier, index });
                }
            }
            for (parent, mut chain) in chains.into_iter().filter(|(_, chain)| chain.len() > 1) {
                chain.sort_by_key(|place| compared_annotation_at(self.theirs, *place).order);
                let ids = chain.iter().map(|place| self.name_of_theirs(*place));
                let Some((above, ids)) = self.name_of_theirs(parent).zip(ids.collect::<Option<Vec<_>>>()) else {
                    continue;
                };
                let own_family = families.get(&(name.as_str(), above.as_str()));
                let all: BTreeSet<&str> = ids.iter().map(String::as_str).collect();
                // A family that either side changed otherwise keeps the order that the merge gave it.
                if own_family == Some(&all) && self.keeps_order(&chain) {
                    ranks.extend(ids.into_iter().zip((0u32..).map(f64::from)));
                }
            }
        }
        for (id, rank) in ranks {
            if let Some(own) = self.pieces.all.get_mut(&id) {
                own.rank = rank;
            }
        }
    }

    /// Reports whether the annotations of a chain of theirs have in mine the parents and the order that they had in the
    /// base.
    fn keeps_order(&self, chain: &[AnnotationAddress]) -> bool {
        let mut places: Vec<(AnnotationAddress, AnnotationAddress)> = Vec::new();
        for old in chain.iter().filter_map(|place| self.other.back.get(place)) {
            let Some(own) = self.own.pairs.get(old) else {
                return false;
            };
            let base_parent = compared_annotation_at(self.base, *old).parent;
            let parent = base_parent.and_then(|place| self.own.pairs.get(&place)).copied();
            if compared_annotation_at(self.mine, *own).parent != parent {
                return false;
            }
            places.push((*old, *own));
        }
        places.sort_by_key(|(old, _)| {
            let it = compared_annotation_at(self.base, *old);
            (old.tier, it.parent, it.order)
        });
        places.windows(2).all(|pair| {
            let [(x, own_x), (y, own_y)] = [pair[0], pair[1]];
            (x.tier, compared_annotation_at(self.base, x).parent)
                != (y.tier, compared_annotation_at(self.base, y).parent)
                || compared_annotation_at(self.mine, own_x).order < compared_annotation_at(self.mine, own_y).order
        })
    }

    /// Returns all annotations below one, each before its parent.
    pub(super) fn list_annotations_below(&self, id: &str) -> Vec<String> {
        let mut found_ids = vec![id.to_owned()];
        let mut next_index = 0;
        while next_index < found_ids.len() {
            let loose_entries = self.pieces.all.iter();
            let child_entries = loose_entries
                .filter(|(id, it)| it.above.as_deref() == Some(&found_ids[next_index]) && !found_ids.contains(*id));
            let child_ids: Vec<String> = child_entries.map(|(id, _)| id.clone()).collect();
            found_ids.extend(child_ids);
            next_index += 1;
        }
        found_ids.remove(0);
        found_ids.reverse();
        found_ids
    }

    /// Lists annotations for which there is no parent, although their tier needs one: the merged document cannot hold
    /// them.
    pub(super) fn list_orphans(&mut self) {
        let tiers = self.pieces.tiers.iter();
        let chained_tiers = tiers.filter(|(tier, above)| is_chained(tier) && above.is_some());
        let chained: BTreeSet<String> = chained_tiers.map(|(tier, _)| tier.name.clone()).collect();
        // An annotation that goes leaves those below it without a parent.
        loop {
            let all = &self.pieces.all;
            let lost = all.iter().filter(|(_, it)| {
                let above = it.above.as_ref().and_then(|id| all.get(id));
                chained.contains(&it.tier) && above.is_none()
            });
            let lost: Vec<String> = lost.map(|(id, _)| id.clone()).collect();
            if lost.is_empty() {
                break;
            }
            for id in lost {
                let annotation = self.state_now(&id);
                self.pieces.all.remove(&id);
                self.record_merge_conflict(None, None, annotation);
            }
        }
    }
}
