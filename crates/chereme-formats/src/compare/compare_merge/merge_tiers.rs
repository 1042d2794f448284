//! Merges the tiers themselves: their names, parents and properties.

use super::{TranscriptMergeWork, take_their_value};
use crate::compare::{TranscriptDifference, TranscriptTierChange};
use crate::transcript::TranscriptTier;

impl TranscriptMergeWork<'_> {
    /// Renames, adds and changes tiers as theirs did, and notes the present name of each.
    pub(super) fn merge_tier_changes(&mut self, changes: &TranscriptDifference) {
        self.rename_tiers();
        let added = changes.tiers.iter().filter(|change| change.change == "added");
        // All names come first, because a new tier may stand below another new one.
        for change in added.clone() {
            let name = change.tier.clone();
            self.from_theirs.insert(name.clone(), name);
        }
        for change in added {
            if self.pieces.find_loose_tier(&change.tier).is_none() {
                let parent = self.tier_of_theirs(change.parent.as_deref());
                self.pieces.tiers.push((change.whole.clone(), parent));
            }
        }
        for change in changes.tiers.iter().filter(|change| change.change == "changed") {
            self.merge_tier_properties(change);
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
                if name == tier.name && *to != name && self.pieces.find_loose_tier(to).is_none() {
                    self.pieces.rename_loose_tier(&name, to);
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

    fn merge_tier_properties(&mut self, change: &TranscriptTierChange) {
        let base = self.base.tiers.iter().find(|tier| tier.name == change.tier);
        let Some((base, name)) = base.zip(self.from_base.get(&change.tier)) else {
            return;
        };
        let parent_name = base.parent.map(|at| self.base.tiers[at].name.as_str());
        let parent = parent_name.and_then(|name| self.from_base.get(name)).cloned();
        let new_parent = self.tier_of_theirs(change.parent.as_deref());
        let name = name.clone();
        let Some((tier, above)) = self.pieces.find_loose_tier(&name) else {
            return;
        };
        if change.fields.contains_key("parent") {
            take_their_value(above, &parent, &new_parent);
        }
        take_properties(tier, base, &change.whole);
    }

    /// Removes the tiers that theirs removed, if they are empty now; children go before their parents.
    pub(super) fn drop_tiers(&mut self, changes: &[TranscriptTierChange]) {
        let removed_changes = changes.iter().filter(|change| change.change == "removed");
        let mut gone: Vec<String> = removed_changes
            .filter_map(|change| self.from_base.get(&change.tier).cloned())
            .filter(|name| self.pieces.all.values().all(|loose| loose.tier != *name))
            .collect();
        // A tier that goes may have been the last below its parent.
        loop {
            let tiers = &mut self.pieces.tiers;
            let before = tiers.len();
            let parents: Vec<String> = tiers.iter().filter_map(|entry| entry.1.clone()).collect();
            tiers.retain(|(tier, _)| !gone.contains(&tier.name) || parents.contains(&tier.name));
            if tiers.len() == before {
                break;
            }
            gone.retain(|name| tiers.iter().any(|(tier, _)| tier.name == *name));
        }
    }
}

fn take_properties(tier: &mut TranscriptTier, base: &TranscriptTier, theirs: &TranscriptTier) {
    take_their_value(&mut tier.kind, &base.kind, &theirs.kind);
    take_their_value(&mut tier.stereotype, &base.stereotype, &theirs.stereotype);
    take_their_value(&mut tier.participant, &base.participant, &theirs.participant);
    take_their_value(&mut tier.annotator, &base.annotator, &theirs.annotator);
    take_their_value(&mut tier.language, &base.language, &theirs.language);
    take_their_value(&mut tier.locale, &base.locale, &theirs.locale);
    take_their_value(&mut tier.vocabulary, &base.vocabulary, &theirs.vocabulary);
}
