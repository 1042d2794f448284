//! The effects of actions on tiers.

use std::collections::BTreeSet;

use chereme_corpus::{Hands, Name, Scheme, TierChange, TierContents, TierName, TierRole, TierRow};
use chereme_sign::text::fold;
use chereme_sign::{Component, HandRef};

use super::edit::Scene;
use super::tier_box::{TierBox, What};
use super::{Timeline, view_settings};
use crate::action::Action;
use crate::context::Outbox;
use crate::panes::Acted;
use crate::words::timeline as words;
use crate::work::editing;

/// Carries out an action on tiers.
pub(super) fn act(
    timeline: &mut Timeline,
    action: Action,
    scene: &Scene<'_>,
    out: &mut Outbox,
) -> Acted {
    match action {
        Action::TiersByName | Action::TiersByKind => {
            return sort(scene, action == Action::TiersByName, out);
        }
        Action::HideEmptyTiers => return hide_empty(scene, out),
        _ => {}
    }
    const MINE: [Action; 9] = [
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
    if !MINE.contains(&action) {
        return Acted::No;
    }
    if action == Action::AddTier {
        timeline.boxes.tier_box = Some(TierBox::add(scene));
        return Acted::Yes;
    }
    if action == Action::UsualTiers {
        let recording = Name::Number(scene.contents.recording.id);
        // If both hands have glosses, each has its own components.
        let glosses = scene.contents.tiers.iter();
        let several = glosses.filter(|it| it.row.role == TierRole::Gloss).count() > 1;
        let chosen = scene
            .tier()
            .filter(|it| it.row.role == TierRole::Gloss && several);
        let scheme = chosen.map_or(Scheme::Usual, |it| {
            Scheme::Below(TierName::Number(it.row.id))
        });
        out.work(editing::add_tiers(recording, scheme));
        return Acted::Yes;
    }
    let Some(tier) = scene.tier() else {
        return Acted::Cannot(words::NEEDS_TIER);
    };
    let mut settings = scene.seen.settings.timeline.clone();
    let (id, name) = (tier.row.id, tier.row.name.clone());
    match action {
        Action::CopyTier => {
            timeline.boxes.tier_box = Some(TierBox::copy(scene, tier));
            return Acted::Yes;
        }
        Action::ChangeTier | Action::RemoveTier => {
            let change = action == Action::ChangeTier;
            let what = if change {
                What::Change(id)
            } else {
                What::Remove(id)
            };
            timeline.boxes.tier_box = Some(TierBox::of(scene.contents, tier, what));
            return Acted::Yes;
        }
        Action::TierUp | Action::TierDown => {
            let parents = scene.contents.tiers.iter();
            let all: Vec<_> = parents.map(|it| (it.row.id, it.row.parent_id)).collect();
            let Some(place) = beside(&all, id, action == Action::TierDown) else {
                return Acted::Cannot(words::TIER_AT_END);
            };
            let change = TierChange {
                place: Some(place),
                ..TierChange::default()
            };
            out.work(editing::change_tier(TierName::Number(id), change));
            return Acted::Yes;
        }
        Action::HideTier => {
            settings.hidden.insert(name);
        }
        _ => view_settings::toggle(&mut settings.folded, name),
    }
    view_settings::change(scene.seen, out, settings);
    Acted::Yes
}

/// Requests an order of the tiers, if it differs from the present one.
pub(super) fn order(scene: &Scene<'_>, order: Vec<i64>, out: &mut Outbox) -> Acted {
    let tiers = &scene.contents.tiers;
    if tiers.iter().map(|it| it.row.id).eq(order.iter().copied()) {
        return Acted::Cannot(words::SORTED_ALREADY);
    }
    let recording = Name::Number(scene.contents.recording.id);
    out.work(editing::order_tiers(recording, order));
    Acted::Yes
}

fn sort(scene: &Scene<'_>, by_name: bool, out: &mut Outbox) -> Acted {
    let mut tiers: Vec<&TierContents> = scene.contents.tiers.iter().collect();
    if by_name {
        tiers.sort_by_cached_key(|it| natural(&it.row.name));
    } else {
        tiers.sort_by_key(|it| rank(&it.row));
    }
    order(scene, tiers.iter().map(|it| it.row.id).collect(), out)
}

/// Returns the sort key of a name: its words, and its numbers by value.
fn natural(name: &str) -> Vec<(String, u64)> {
    let mut parts = vec![(String::new(), 0_u64)];
    let mut counting = false;
    for letter in fold(name).chars() {
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
fn rank(row: &TierRow) -> (usize, usize, usize) {
    let role = row.role.rank();
    let hand = match row.hand {
        Some(Hands::Both) => 0,
        Some(Hands::One(HandRef::Right)) => 1,
        Some(Hands::One(HandRef::Dominant)) => 2,
        Some(Hands::One(HandRef::Left)) => 3,
        Some(Hands::One(HandRef::Weak)) => 4,
        None => 5,
    };
    let component = row.role.component().map(|(component, _)| component);
    let place = |wanted| Component::ALL.iter().position(|it| Some(*it) == wanted);
    (role, hand, place(component).unwrap_or(Component::ALL.len()))
}

/// Hides every tier that has no annotations, and whose descendants have none.
fn hide_empty(scene: &Scene<'_>, out: &mut Outbox) -> Acted {
    let mut settings = scene.seen.settings.timeline.clone();
    let before = settings.hidden.len();
    let tiers = &scene.contents.tiers;
    let mut full: BTreeSet<i64> = BTreeSet::new();
    for tier in tiers.iter().filter(|it| !it.annotations.is_empty()) {
        let mut at = Some(tier.row.id);
        while let Some(id) = at.filter(|id| full.insert(*id)) {
            let found = scene.tier_of(id);
            at = found.and_then(|it| it.row.parent_id);
        }
    }
    let empty = tiers.iter().filter(|it| !full.contains(&it.row.id));
    settings.hidden.extend(empty.map(|it| it.row.name.clone()));
    if settings.hidden.len() == before {
        return Acted::Cannot(words::NONE_EMPTY);
    }
    view_settings::change(scene.seen, out, settings);
    Acted::Yes
}

/// Returns whether a tier is `above` or a descendant of it.
pub(super) fn is_within(tiers: &[(i64, Option<i64>)], id: i64, above: i64) -> bool {
    let mut at = Some(id);
    for _ in 0..tiers.len() {
        if at == Some(above) {
            return true;
        }
        at = tiers.iter().find(|it| Some(it.0) == at).and_then(|it| it.1);
    }
    false
}

/// Returns the order in which a tier comes before its sibling `before`, or after all its siblings; tiers are `(id,
/// parent)` in their order.
pub(super) fn moved(
    tiers: &[(i64, Option<i64>)],
    id: i64,
    before: Option<i64>,
) -> Option<Vec<i64>> {
    let own = tiers.iter().find(|it| it.0 == id)?;
    let mut order: Vec<i64> = tiers.iter().map(|it| it.0).filter(|it| *it != id).collect();
    let place = match before {
        Some(before) => order.iter().position(|it| *it == before)?,
        None => {
            let sibling = |it: &&(i64, Option<i64>)| it.1 == own.1 && it.0 != id;
            let last = tiers.iter().rev().find(sibling)?.0;
            order.iter().position(|it| *it == last)? + 1
        }
    };
    order.insert(place, id);
    Some(order)
}

/// Returns the position that moves a tier past its next or previous sibling; tiers are `(id, parent)` in their order.
fn beside(tiers: &[(i64, Option<i64>)], id: i64, down: bool) -> Option<u32> {
    let here = tiers.iter().position(|it| it.0 == id)?;
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
        assert_eq!(beside(&all, 1, true), Some(3));
        assert_eq!(beside(&all, 4, false), Some(0));
        assert_eq!(beside(&all, 3, false), Some(1));
        assert_eq!(beside(&all, 3, true), None);
        assert_eq!(beside(&all, 9, true), None);
        assert_eq!(moved(&all, 4, Some(1)), Some(vec![4, 1, 2, 3]));
        assert_eq!(moved(&all, 1, None), Some(vec![2, 3, 4, 1]));
        assert_eq!(moved(&all, 2, None), Some(vec![1, 3, 2, 4]));
        assert_eq!(moved(&all, 9, None), None);
        assert!(is_within(&all, 3, 1) && is_within(&all, 4, 4) && !is_within(&all, 4, 1));
    }

    #[test]
    fn names_sort_in_natural_order_and_kinds_in_the_order_of_the_components() {
        let mut names = ["Mo10", "école", "Mo2", "Eau", "Mo"];
        names.sort_by_key(|it| natural(it));
        assert_eq!(names, ["Eau", "école", "Mo", "Mo2", "Mo10"]);
        let row = |role: &str, component: Option<&str>, hand: Option<&str>| TierRow {
            role: TierRole::of_parts(role, component, None),
            hand: hand.and_then(Hands::of),
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
        assert!(sorted.is_sorted_by_key(rank));
    }
}
