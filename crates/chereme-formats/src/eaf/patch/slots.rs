//! Time slots: those of moved ends, those that nothing uses any more, and those of new annotations.

use super::{EafPatchWork, SlotReferences, annotation_end_millis, is_alignable};
use crate::eaf::eaf_output::render_eaf_elements;
use crate::eaf::eaf_raw::{AnnotationAnchor, TimeSlot};
use crate::transcript::AnnotationAddress;
use chereme_sign::TierStereotype;
use std::collections::{BTreeMap, HashMap};

/// One end of an annotation at a slot.
struct SlotUser {
    /// Its new place; `None` if it was left out on reading.
    place: Option<AnnotationAddress>,
    side: usize,
    /// Its new time, if it moved.
    moved: Option<Option<i64>>,
}

/// The time slots of the file, and their changes.
struct FileTimeSlots {
    names: Vec<String>,
    elements: Vec<usize>,
    values: Vec<Option<i64>>,
    retimed: Vec<bool>,
    removed: Vec<bool>,
    fresh: Vec<(String, i64)>,
    last: u64,
}

impl EafPatchWork<'_, '_> {
    /// Returns the slots of all new annotations, and changes the time order of the file.
    pub(super) fn patch_time_slots(&mut self) -> Option<SlotReferences> {
        let mut slots = self.slots_of_file()?;
        let index: HashMap<&str, usize> = self
            .document
            .time_order
            .iter()
            .enumerate()
            .rev()
            .map(|(at, slot)| (&*slot.id, at))
            .collect();
        let mut users: Vec<Vec<SlotUser>> = slots.names.iter().map(|_| Vec::new()).collect();
        let mut used = vec![false; slots.names.len()];
        let mut refs = SlotReferences::new();
        for (place, _, raw) in self.annotations_of_file() {
            let AnnotationAnchor::Slots { start, end } = &raw.anchor else {
                continue;
            };
            let new = match place {
                Some(old) => self.kept_annotation_place(old).map(Some),
                None => Some(None),
            };
            let moved = self.moved_annotation_ends(place, new.flatten());
            let both = [index.get(&**start), index.get(&**end)];
            if let [Some(from), Some(to)] = both
                && moved != [None; 2]
                // Ends that the file has the wrong way round were exchanged when it was read, and moving one of them
                // would move the other.
                && slots.values[*from].zip(slots.values[*to]).is_some_and(|(a, b)| a > b)
            {
                return None;
            }
            if let Some(Some(place)) = new {
                refs.insert(place, [start.to_string(), end.to_string()]);
            }
            for (side, slot) in both.into_iter().enumerate() {
                let Some(&slot) = slot else { continue };
                used[slot] = true;
                if let Some(place) = new {
                    let moved = moved[side];
                    users[slot].push(SlotUser { place, side, moved });
                }
            }
        }
        let mut order: Vec<usize> = (0..users.len()).collect();
        // Parts of a subdivision take over slots of their parents, which must be settled before.
        order.sort_by_key(|slot| users[*slot].iter().any(|user| self.divides(user.place)));
        for slot in order {
            slots.removed[slot] = used[slot] && users[slot].is_empty();
            self.place_users(slot, &users[slot], &mut slots, &mut refs)?;
        }
        self.place_added(&mut slots, &mut refs)?;
        let milliseconds = self.document.header.time_units.as_deref();
        // Times are written in milliseconds.
        if milliseconds.is_some_and(|units| units != "milliseconds") && slots.is_changed() {
            return None;
        }
        self.write_slots(slots)?;
        Some(refs)
    }

    fn slots_of_file(&self) -> Option<FileTimeSlots> {
        let all = &self.document.time_order;
        let element = |slot: &TimeSlot<'_>| self.layout.element_starting_at(slot.at.0 as usize);
        let number = |slot: &TimeSlot<'_>| slot.id.strip_prefix("ts")?.parse::<u64>().ok();
        Some(FileTimeSlots {
            names: all.iter().map(|slot| slot.id.to_string()).collect(),
            elements: all.iter().map(element).collect::<Option<_>>()?,
            values: all.iter().map(|slot| slot.value).collect(),
            retimed: vec![false; all.len()],
            removed: vec![false; all.len()],
            fresh: Vec::new(),
            last: all.iter().filter_map(number).max().unwrap_or(0).min(u64::MAX / 2),
        })
    }

    /// Returns the new times of the ends of an annotation that moved.
    fn moved_annotation_ends(
        &self,
        old: Option<AnnotationAddress>,
        new: Option<AnnotationAddress>,
    ) -> [Option<Option<i64>>; 2] {
        let Some((old, new)) = old.and_then(|old| self.before.annotation_at(old)).zip(new) else {
            return [None; 2];
        };
        let (before, after) = (
            annotation_end_millis(old),
            annotation_end_millis(self.wanted_annotation(new)),
        );
        [0, 1].map(|side| (before[side] != after[side]).then_some(after[side]))
    }

    fn divides(&self, place: Option<AnnotationAddress>) -> bool {
        place.is_some_and(|place| self.after.tiers[place.tier].stereotype == Some(TierStereotype::TimeSubdivision))
    }

    /// Finds slots for the ends at this slot that moved.
    fn place_users(
        &self,
        slot: usize,
        users: &[SlotUser],
        slots: &mut FileTimeSlots,
        refs: &mut SlotReferences,
    ) -> Option<()> {
        // A slot stays where it is as long as one of its annotations does.
        let mut stays = users.iter().any(|user| user.moved.is_none());
        let mut groups: BTreeMap<i64, Vec<&SlotUser>> = BTreeMap::new();
        for user in users {
            if let Some(time) = user.moved {
                groups.entry(time?).or_default().push(user);
            }
        }
        for (time, group) in groups {
            let shared = group.iter().find_map(|user| {
                let place = user.place.filter(|_| self.divides(user.place))?;
                let parent = self.wanted_annotation(place).parent?;
                let is_at_time = annotation_end_millis(self.wanted_annotation(parent))[user.side] == Some(time);
                let name = &refs.get(&parent).filter(|_| is_at_time)?[user.side];
                (*name != slots.names[slot]).then(|| name.clone())
            });
            let name = match shared {
                Some(name) => name,
                // Nobody else needs the slot any more, so that it moves instead of a new one.
                None if !stays => {
                    stays = true;
                    slots.values[slot] = Some(time);
                    slots.retimed[slot] = true;
                    slots.names[slot].clone()
                }
                None => slots.add_time_slot(time),
            };
            for user in group {
                if let Some(place) = user.place {
                    refs.get_mut(&place)?[user.side].clone_from(&name);
                }
            }
        }
        slots.removed[slot] |= !users.is_empty() && !stays;
        Some(())
    }

    /// Finds slots for new annotations; those of a Time_Subdivision share them.
    fn place_added(&self, slots: &mut FileTimeSlots, refs: &mut SlotReferences) -> Option<()> {
        for tier in self.after.tiers_parents_first() {
            if !is_alignable(self.after, tier) {
                continue;
            }
            let all = &self.after.tiers[tier].annotations;
            let divides = self.divides(Some(AnnotationAddress { tier, index: 0 }));
            let mut slot_names: HashMap<(Option<AnnotationAddress>, i64), String> = HashMap::new();
            let mut added: Vec<AnnotationAddress> = Vec::new();
            for (index, it) in all.iter().enumerate() {
                let place = AnnotationAddress { tier, index };
                match refs.get(&place) {
                    None => added.push(place),
                    Some(names) if divides => {
                        for (time, name) in annotation_end_millis(it).into_iter().zip(names) {
                            slot_names.insert((it.parent, time.unwrap_or(i64::MIN)), name.clone());
                        }
                    }
                    Some(_) => {}
                }
            }
            added.sort_by_key(|place| all[place.index].span);
            for place in added {
                let it = &all[place.index];
                let above = it.parent.filter(|_| divides);
                let above = above.and_then(|parent| {
                    Some((
                        annotation_end_millis(self.wanted_annotation(parent)),
                        refs.get(&parent)?,
                    ))
                });
                let mut names = [String::new(), String::new()];
                for (side, time) in annotation_end_millis(it).into_iter().enumerate() {
                    let time = time?;
                    let shared = slot_names.get(&(it.parent, time)).filter(|_| divides).cloned();
                    let of_parent = above
                        .as_ref()
                        .filter(|(times, _)| times[side] == Some(time))
                        .map(|(_, names)| names[side].clone());
                    names[side] = shared.or(of_parent).unwrap_or_else(|| slots.add_time_slot(time));
                    slot_names.insert((it.parent, time), names[side].clone());
                }
                refs.insert(place, names);
            }
        }
        Some(())
    }

    fn write_slots(&mut self, slots: FileTimeSlots) -> Option<()> {
        if !slots.is_changed() {
            return Some(());
        }
        let root = self.root_layout_element()?;
        let container = self.layout.first_child_named(root, "TIME_ORDER")?;
        let mut fresh = slots.fresh.clone();
        let gone = slots.out_of_order();
        for (slot, gone) in gone.iter().enumerate() {
            if slots.removed[slot] || *gone {
                let span = self.layout.element_line_span(slots.elements[slot]);
                self.edits.remove_text_span(span);
            }
            if let Some(time) = slots.values[slot].filter(|_| slots.retimed[slot]) {
                if *gone {
                    // It is written again where its time belongs.
                    fresh.push((slots.names[slot].clone(), time));
                } else {
                    let time = time.to_string();
                    self.patch_element_attribute(slots.elements[slot], "TIME_VALUE", Some(&time));
                }
            }
        }
        fresh.sort_by_key(|(_, time)| *time);
        let indent = self.indent_in(container);
        let mut added: BTreeMap<Option<usize>, Vec<String>> = BTreeMap::new();
        for (name, time) in fresh {
            let slot = TimeSlot {
                id: name.into(),
                value: Some(time),
                ..TimeSlot::default()
            };
            let block = render_eaf_elements(self.style, &indent, |xml| slot.write_leaf(xml))?;
            let mut earlier_slots = (0..slots.names.len()).rev().filter(|at| !gone[*at]);
            let before = earlier_slots.find(|at| slots.values[*at].is_some_and(|value| value <= time));
            let before = before.map(|at| slots.elements[at]);
            added.entry(before).or_default().push(block);
        }
        for (after, blocks) in added {
            self.insert_container_elements(container, after, &blocks);
        }
        Some(())
    }
}

impl FileTimeSlots {
    fn add_time_slot(&mut self, time: i64) -> String {
        self.last += 1;
        let name = format!("ts{}", self.last);
        self.fresh.push((name.clone(), time));
        name
    }

    fn is_changed(&self) -> bool {
        !self.fresh.is_empty() || self.removed.contains(&true) || self.retimed.contains(&true)
    }

    /// Returns which slots are removed, or have a new time beyond a neighbour's.
    fn out_of_order(&self) -> Vec<bool> {
        let mut gone = self.removed.clone();
        loop {
            let mut last = None;
            let mut next: Vec<Option<i64>> = vec![None; gone.len()];
            for slot in (0..gone.len()).rev() {
                next[slot] = last;
                last = self.values[slot].filter(|_| !gone[slot]).or(last);
            }
            let (mut before, mut more) = (None, false);
            for slot in 0..gone.len() {
                let Some(time) = self.values[slot].filter(|_| !gone[slot]) else {
                    continue;
                };
                let past = before.is_some_and(|other| other > time) || next[slot].is_some_and(|other| other < time);
                if past && self.retimed[slot] {
                    (gone[slot], more) = (true, true);
                } else {
                    before = Some(time);
                }
            }
            if !more {
                return gone;
            }
        }
    }
}
