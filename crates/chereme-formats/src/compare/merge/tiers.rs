//! Merges the tiers themselves: their names, parents and properties.

use super::{Work, take};
use crate::compare::{Difference, TierChange};
use crate::eaf::convert::Tier;

impl Work<'_> {
    /// Renames, adds and changes tiers as theirs did, and notes the present name of each.
    pub(super) fn tiers(&mut self, changes: &Difference) {
        self.rename_tiers();
        let added = changes.tiers.iter().filter(|it| it.change == "added");
        for change in added.clone() {
            let name = change.tier.clone();
            self.from_theirs.insert(name.clone(), name);
        }
        for change in added {
            if self.pieces.tier(&change.tier).is_none() {
                let parent = self.tier_of_theirs(change.parent.as_deref());
                self.pieces.tiers.push((change.whole.clone(), parent));
            }
        }
        for change in changes.tiers.iter().filter(|it| it.change == "changed") {
            self.change_tier(change);
        }
    }

    /// Takes the names that theirs gave to tiers, unless mine gave others.
    fn rename_tiers(&mut self) {
        for (at, tier) in self.base.tiers.iter().enumerate() {
            let Some(own) = self.own.tiers.get(at).copied().flatten() else {
                continue;
            };
            let mut name = self.mine.tiers[own].name.clone();
            if let Some(other) = self.other.tiers.get(at).copied().flatten() {
                let to = &self.theirs.tiers[other].name;
                if name == tier.name && *to != name && self.pieces.tier(to).is_none() {
                    self.pieces.rename(&name, to);
                    name.clone_from(to);
                }
                self.from_theirs.insert(to.clone(), name.clone());
            }
            self.from_base.insert(tier.name.clone(), name);
        }
    }

    fn tier_of_theirs(&self, name: Option<&str>) -> Option<String> {
        self.from_theirs.get(name?).cloned()
    }

    fn change_tier(&mut self, change: &TierChange) {
        let base = self.base.tiers.iter().find(|it| it.name == change.tier);
        let Some((base, name)) = base.zip(self.from_base.get(&change.tier)) else {
            return;
        };
        let parent = base.parent.map(|at| self.base.tiers[at].name.as_str());
        let parent = parent.and_then(|name| self.from_base.get(name)).cloned();
        let new_parent = self.tier_of_theirs(change.parent.as_deref());
        let name = name.clone();
        let Some((tier, above)) = self.pieces.tier(&name) else {
            return;
        };
        if change.fields.contains_key("parent") {
            take(above, &parent, &new_parent);
        }
        take_properties(tier, base, &change.whole);
    }

    /// Removes the tiers that theirs removed, if they are empty now; children go before their parents.
    pub(super) fn drop_tiers(&mut self, changes: &[TierChange]) {
        let gone = changes.iter().filter(|it| it.change == "removed");
        let mut gone: Vec<String> = gone
            .filter_map(|it| self.from_base.get(&it.tier).cloned())
            .filter(|name| self.pieces.all.values().all(|it| it.tier != *name))
            .collect();
        loop {
            let tiers = &mut self.pieces.tiers;
            let before = tiers.len();
            let parents: Vec<String> = tiers.iter().filter_map(|it| it.1.clone()).collect();
            tiers.retain(|(tier, _)| !gone.contains(&tier.name) || parents.contains(&tier.name));
            if tiers.len() == before {
                break;
            }
            gone.retain(|name| tiers.iter().any(|(tier, _)| tier.name == *name));
        }
    }
}

fn take_properties(tier: &mut Tier, base: &Tier, theirs: &Tier) {
    take(&mut tier.kind, &base.kind, &theirs.kind);
    take(&mut tier.stereotype, &base.stereotype, &theirs.stereotype);
    take(
        &mut tier.participant,
        &base.participant,
        &theirs.participant,
    );
    take(&mut tier.annotator, &base.annotator, &theirs.annotator);
    take(&mut tier.language, &base.language, &theirs.language);
    take(&mut tier.locale, &base.locale, &theirs.locale);
    take(&mut tier.vocabulary, &base.vocabulary, &theirs.vocabulary);
}
