//! The effects of actions on tiers.

use std::collections::BTreeSet;

use chereme_corpus::{
    AnnotatedHands, RowName, TierContents, TierPropertyChange, TierRequestName, TierRole, TierRow, TierScheme,
};
use chereme_sign::text::fold_text;
use chereme_sign::{HandRef, SignComponent};

use super::tier_box::{TierBox, TierBoxPurpose};
use super::timeline_edit::TimelineScene;
use super::{TimelinePane, timeline_view_settings};
use crate::action::Action;
use crate::panes::ActionOutcome;
use crate::words::timeline as words;
use crate::work::editing;

/// Carries out an action on tiers.
pub(super) fn carry_out_tier_action(
    timeline: &mut TimelinePane,
    action: Action,
    scene: &TimelineScene<'_>,
) -> ActionOutcome {
    match action {
        Action::TiersByName | Action::TiersByKind => {
            return sort_scene_tiers(scene, action == Action::TiersByName);
        }
        Action::HideEmptyTiers => return hide_empty(scene),
        _ => {}
    }
    const OWN_TIER_ACTIONS: [Action; 9] = [
        Action::AddTier,
        Action::CopyTier,
        Action::UsualTiers,
        Action::ChangeTier,
        Action::RemoveTier,
        Action::TierUp,
        Action::TierDown,
        Action::FoldTier,
        Action::HideTier,
    ];
    if !OWN_TIER_ACTIONS.contains(&action) {
        return ActionOutcome::No;
    }
    if action == Action::AddTier {
        timeline.boxes.tier_box = Some(TierBox::box_for_new_tier(scene));
        return ActionOutcome::Yes;
    }
    if action == Action::UsualTiers {
        let recording = RowName::Number(scene.contents.recording.id);
        // If both hands have glosses, each has its own components.
        let glosses = scene.contents.tiers.iter();
        let several = glosses.filter(|tier| tier.row.role == TierRole::Gloss).count() > 1;
        let chosen = scene
            .edited_tier()
            .filter(|tier| tier.row.role == TierRole::Gloss && several);
        let scheme = chosen.map_or(TierScheme::Usual, |tier| {
            TierScheme::Below(TierRequestName::Number(tier.row.id))
        });
        scene.seen.request_work(editing::add_tiers(recording, scheme));
        return ActionOutcome::Yes;
    }
    let Some(tier) = scene.edited_tier() else {
        return ActionOutcome::Cannot(words::NEEDS_TIER);
    };
    let mut settings = scene.seen.settings.timeline.clone();
    let (id, name) = (tier.row.id, tier.row.name.clone());
    match action {
        Action::CopyTier => {
            timeline.boxes.tier_box = Some(TierBox::box_for_tier_copy(scene, tier));
            return ActionOutcome::Yes;
        }
        Action::ChangeTier | Action::RemoveTier => {
            let change = action == Action::ChangeTier;
            let what = if change {
                TierBoxPurpose::Change(id)
            } else {
                TierBoxPurpose::Remove(id)
            };
            timeline.boxes.tier_box = Some(TierBox::box_for_tier(scene.contents, tier, what));
            return ActionOutcome::Yes;
        }
        Action::TierUp | Action::TierDown => {
            let parents = scene.contents.tiers.iter();
            let all: Vec<_> = parents.map(|tier| (tier.row.id, tier.row.parent_id)).collect();
            let Some(place) = position_past_sibling(&all, id, action == Action::TierDown) else {
                return ActionOutcome::Cannot(words::TIER_AT_END);
            };
            let change = TierPropertyChange {
                place: Some(place),
                ..TierPropertyChange::default()
            };
            scene
                .seen
                .request_work(editing::change_tier_job(TierRequestName::Number(id), change));
            return ActionOutcome::Yes;
        }
        Action::HideTier => {
            settings.hidden.insert(name);
        }
        _ => timeline_view_settings::toggle_in_set(&mut settings.folded, name),
    }
    timeline_view_settings::change_timeline_settings(scene.seen, settings);
    ActionOutcome::Yes
}

/// Requests an order of the tiers, if it differs from the present one.
pub(super) fn request_tier_order(scene: &TimelineScene<'_>, order: Vec<i64>) -> ActionOutcome {
    let tiers = &scene.contents.tiers;
    if tiers.iter().map(|tier| tier.row.id).eq(order.iter().copied()) {
        return ActionOutcome::Cannot(words::SORTED_ALREADY);
    }
    let recording = RowName::Number(scene.contents.recording.id);
    scene.seen.request_work(editing::order_tiers(recording, order));
    ActionOutcome::Yes
}

fn sort_scene_tiers(scene: &TimelineScene<'_>, by_name: bool) -> ActionOutcome {
    let mut tiers: Vec<&TierContents> = scene.contents.tiers.iter().collect();
    if by_name {
        tiers.sort_by_cached_key(|tier| natural(&tier.row.name));
    } else {
        tiers.sort_by_key(|tier| tier_role_rank(&tier.row));
    }
    request_tier_order(scene, tiers.iter().map(|tier| tier.row.id).collect())
}

/// Returns the sort key of a name: its words, and its numbers by value.
fn natural(name: &str) -> Vec<(String, u64)> {
    let mut parts = vec![(String::new(), 0_u64)];
    let mut counting = false;
    for letter in fold_text(name).chars() {
        let digit = letter.to_digit(10);
        if counting && digit.is_none() {
            parts.push((String::new(), 0));
        }
        counting = digit.is_some();
        if let Some((word, number)) = parts.last_mut() {
            match digit {
                Some(digit) => *number = number.saturating_mul(10).saturating_add(digit.into()),
                None => word.push(letter),
            }
        }
    }
    parts
}

/// Returns the rank of a tier by its role: glosses, translations, components hand by hand, the rest.
fn tier_role_rank(row: &TierRow) -> (usize, usize, usize) {
    let role = row.role.role_rank();
    let hand = match row.hand {
        Some(AnnotatedHands::Both) => 0,
        Some(AnnotatedHands::One(HandRef::Right)) => 1,
        Some(AnnotatedHands::One(HandRef::Dominant)) => 2,
        Some(AnnotatedHands::One(HandRef::Left)) => 3,
        Some(AnnotatedHands::One(HandRef::Weak)) => 4,
        None => 5,
    };
    let component = row.role.role_component().map(|(component, _)| component);
    let place = |wanted| {
        SignComponent::ALL_COMPONENTS
            .iter()
            .position(|other| Some(*other) == wanted)
    };
    (
        role,
        hand,
        place(component).unwrap_or(SignComponent::ALL_COMPONENTS.len()),
    )
}

/// Hides every tier that has no annotations, and whose descendants have none.
fn hide_empty(scene: &TimelineScene<'_>) -> ActionOutcome {
    let mut settings = scene.seen.settings.timeline.clone();
    let before = settings.hidden.len();
    let tiers = &scene.contents.tiers;
    let mut full: BTreeSet<i64> = BTreeSet::new();
    for tier in tiers.iter().filter(|tier| !tier.annotations.is_empty()) {
        let mut ancestor_id = Some(tier.row.id);
        while let Some(id) = ancestor_id.filter(|id| full.insert(*id)) {
            let ancestor = scene.tier_of(id);
            ancestor_id = ancestor.and_then(|it| it.row.parent_id);
        }
    }
    let empty = tiers.iter().filter(|tier| !full.contains(&tier.row.id));
    settings.hidden.extend(empty.map(|tier| tier.row.name.clone()));
    if settings.hidden.len() == before {
        return ActionOutcome::Cannot(words::NONE_EMPTY);
    }
    timeline_view_settings::change_timeline_settings(scene.seen, settings);
    ActionOutcome::Yes
}

/// Returns whether a tier is `above` or a descendant of it.
pub(super) fn is_tier_within(tiers: &[(i64, Option<i64>)], id: i64, above: i64) -> bool {
    let mut ancestor_id = Some(id);
    for _ in 0..tiers.len() {
        if ancestor_id == Some(above) {
            return true;
        }
        ancestor_id = tiers
            .iter()
            .find(|entry| Some(entry.0) == ancestor_id)
            .and_then(|entry| entry.1);
    }
    false
}

/// Returns the order in which a tier comes before its sibling `before`, or after all its siblings; tiers are `(id,
/// parent)` in their order.
pub(super) fn order_before_sibling(tiers: &[(i64, Option<i64>)], id: i64, before: Option<i64>) -> Option<Vec<i64>> {
    let moved_entry = tiers.iter().find(|entry| entry.0 == id)?;
    let mut order: Vec<i64> = tiers
        .iter()
        .map(|entry| entry.0)
        .filter(|other_id| *other_id != id)
        .collect();
    let place = match before {
        Some(before) => order.iter().position(|other_id| *other_id == before)?,
        None => {
            let sibling = |entry: &&(i64, Option<i64>)| entry.1 == moved_entry.1 && entry.0 != id;
            let last = tiers.iter().rev().find(sibling)?.0;
            order.iter().position(|other_id| *other_id == last)? + 1
        }
    };
    order.insert(place, id);
    Some(order)
}

/// Returns the position that moves a tier past its next or previous sibling; tiers are `(id, parent)` in their order.
fn position_past_sibling(tiers: &[(i64, Option<i64>)], id: i64, down: bool) -> Option<u32> {
    let here = tiers.iter().position(|entry| entry.0 == id)?;
    let sibling = |at: &usize| tiers[*at].1 == tiers[here].1;
    let place = if down {
        (here + 1..tiers.len()).find(sibling)
    } else {
        (0..here).rev().find(sibling)
    };
    place.and_then(|place| u32::try_from(place).ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiers_move_among_their_siblings() {
        let all = [(1, None), (2, Some(1)), (3, Some(1)), (4, None)];
        assert_eq!(position_past_sibling(&all, 1, true), Some(3));
        assert_eq!(position_past_sibling(&all, 4, false), Some(0));
        assert_eq!(position_past_sibling(&all, 3, false), Some(1));
        assert_eq!(position_past_sibling(&all, 3, true), None);
        assert_eq!(position_past_sibling(&all, 9, true), None);
        assert_eq!(order_before_sibling(&all, 4, Some(1)), Some(vec![4, 1, 2, 3]));
        assert_eq!(order_before_sibling(&all, 1, None), Some(vec![2, 3, 4, 1]));
        assert_eq!(order_before_sibling(&all, 2, None), Some(vec![1, 3, 2, 4]));
        assert_eq!(order_before_sibling(&all, 9, None), None);
        assert!(is_tier_within(&all, 3, 1) && is_tier_within(&all, 4, 4) && !is_tier_within(&all, 4, 1));
    }

    #[test]
    fn names_sort_in_natural_order_and_kinds_in_the_order_of_the_components() {
        let mut names = ["Mo10", "école", "Mo2", "Eau", "Mo"];
        names.sort_by_key(|it| natural(it));
        assert_eq!(names, ["Eau", "école", "Mo", "Mo2", "Mo10"]);
        let row = |role: &str, component: Option<&str>, hand: Option<&str>| TierRow {
            role: TierRole::of_parts(role, component, None),
            hand: hand.and_then(AnnotatedHands::from_hand_name),
            ..TierRow::default()
        };
        let sorted = [
            row("gloss", None, Some("right")),
            row("gloss", None, Some("left")),
            row("translation", None, None),
            row("component", Some("configuration"), Some("right")),
            row("component", Some("placement"), Some("right")),
            row("component", Some("configuration"), Some("left")),
            row("component", Some("nonmanual"), None),
            row("comment", None, None),
            row("free", None, None),
        ];
        assert!(sorted.is_sorted_by_key(tier_role_rank));
    }
}
