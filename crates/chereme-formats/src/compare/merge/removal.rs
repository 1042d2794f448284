//! Removes what theirs removed, and gives parents and places to what remains.

use super::{Work, is_chained};
use crate::compare::identity::alike;
use crate::compare::{ComparedAnnotation, get, is_symbolic};
use crate::eaf::convert::AnnotationAddress;
use std::collections::{BTreeMap, BTreeSet};

impl Work<'_> {
    /// Removes annotations that theirs removed, each after those below it. One that mine changed, or that still has one
    /// below it, is a conflict.
    pub(super) fn remove_all(&mut self, removed: &[ComparedAnnotation]) {
        let mut below: BTreeMap<String, usize> = BTreeMap::new();
        for above in self.pieces.all.values().filter_map(|it| it.above.clone()) {
            *below.entry(above).or_default() += 1;
        }
        let mut left: Vec<&ComparedAnnotation> = removed.iter().rev().collect();
        loop {
            let before = left.len();
            left.retain(|it| !self.remove(it, &mut below));
            if left.len() == before {
                break;
            }
        }
        for annotation in left {
            let own = self.names.get(&annotation.id);
            let mine = own.and_then(|id| self.state_now(id));
            self.conflict(Some(annotation.clone()), mine, None);
        }
    }

    /// Removes an annotation, and returns whether it is gone; `below` counts the annotations below each.
    fn remove(
        &mut self,
        annotation: &ComparedAnnotation,
        below: &mut BTreeMap<String, usize>,
    ) -> bool {
        let own = self.names.get(&annotation.id);
        let Some((own, now)) = own.and_then(|id| Some((id, self.pieces.all.get(id)?))) else {
            return true;
        };
        let chained = self.pieces.tiers.iter();
        let mut chained = chained.filter(|it| it.0.name == now.tier);
        let chained = chained.next().is_some_and(|it| is_chained(&it.0));
        let same =
            now.it.value == annotation.value && (chained || alike(&now.it, &annotation.whole));
        if !same || below.get(own).is_some_and(|count| *count > 0) {
            return false;
        }
        if let Some(count) = now.above.as_ref().and_then(|above| below.get_mut(above)) {
            *count -= 1;
        }
        let own = own.clone();
        self.pieces.all.remove(&own);
        true
    }

    /// Gives annotations with times the parents that they have in theirs, unless mine gave them others: a parent that was
    /// split or replaced leaves its children to another.
    pub(super) fn adopt(&mut self) {
        for (old, new) in &self.other.pairs {
            if is_symbolic(self.theirs, new.tier) {
                continue;
            }
            let (old, new) = (get(self.base, *old), get(self.theirs, *new));
            let base = old.parent.map(|place| &get(self.base, place).id);
            let base = base.and_then(|id| self.names.get(id)).cloned();
            let theirs = new.parent.map(|place| self.name_of_theirs(place));
            let own = self.names.get(&old.id);
            let own = own.and_then(|id| self.pieces.all.get_mut(id));
            if let Some(own) = own.filter(|it| it.above == base) {
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
            Some(known) => self.names.get(&get(self.base, *known).id).cloned(),
            None => self.fresh.get(&get(self.theirs, place).id).cloned(),
        }
    }

    /// Puts the siblings of each chain in the order of theirs, if mine has the same siblings in the order of the base.
    pub(super) fn arrange(&mut self) {
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
                chain.sort_by_key(|place| get(self.theirs, *place).order);
                let ids = chain.iter().map(|place| self.name_of_theirs(*place));
                let Some((above, ids)) = self
                    .name_of_theirs(parent)
                    .zip(ids.collect::<Option<Vec<_>>>())
                else {
                    continue;
                };
                let own = families.get(&(name.as_str(), above.as_str()));
                let all: BTreeSet<&str> = ids.iter().map(String::as_str).collect();
                if own == Some(&all) && self.keeps_order(&chain) {
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
            let parent = get(self.base, *old).parent;
            let parent = parent.and_then(|place| self.own.pairs.get(&place)).copied();
            if get(self.mine, *own).parent != parent {
                return false;
            }
            places.push((*old, *own));
        }
        places.sort_by_key(|(old, _)| {
            let it = get(self.base, *old);
            (old.tier, it.parent, it.order)
        });
        places.windows(2).all(|pair| {
            let [(x, own_x), (y, own_y)] = [pair[0], pair[1]];
            (x.tier, get(self.base, x).parent) != (y.tier, get(self.base, y).parent)
                || get(self.mine, own_x).order < get(self.mine, own_y).order
        })
    }

    /// Returns all annotations below one, each before its parent.
    pub(super) fn below(&self, id: &str) -> Vec<String> {
        let mut found = vec![id.to_owned()];
        let mut at = 0;
        while at < found.len() {
            let own = self.pieces.all.iter();
            let own = own
                .filter(|(id, it)| it.above.as_deref() == Some(&found[at]) && !found.contains(*id));
            let own: Vec<String> = own.map(|(id, _)| id.clone()).collect();
            found.extend(own);
            at += 1;
        }
        found.remove(0);
        found.reverse();
        found
    }

    /// Lists annotations for which there is no parent, although their tier needs one: the merged document cannot hold
    /// them.
    pub(super) fn list_orphans(&mut self) {
        let tiers = self.pieces.tiers.iter();
        let chained = tiers.filter(|(tier, above)| is_chained(tier) && above.is_some());
        let chained: BTreeSet<String> = chained.map(|(tier, _)| tier.name.clone()).collect();
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
                self.conflict(None, None, annotation);
            }
        }
    }
}
