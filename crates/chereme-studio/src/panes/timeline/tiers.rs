//! What actions do to tiers.

use chereme_corpus::{Name, Scheme, TierChange, TierName};

use super::edit::Scene;
use super::tier_box::{TierBox, What};
use super::{Timeline, ways};
use crate::action::Action;
use crate::context::Outbox;
use crate::panes::Acted;
use crate::words::timeline as words;
use crate::work::Work;

/// Does an action that is about tiers.
pub(super) fn act(
    timeline: &mut Timeline,
    action: Action,
    scene: &Scene<'_>,
    out: &mut Outbox,
) -> Acted {
    const MINE: [Action; 8] = [
        Action::AddTier,
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
        timeline.tier_box = Some(TierBox::add(scene));
        return Acted::Yes;
    }
    if action == Action::UsualTiers {
        let recording = Name::Number(scene.contents.recording.id);
        out.work(Work::AddTiers(recording, Scheme::Usual));
        return Acted::Yes;
    }
    let Some(tier) = scene.tier() else {
        return Acted::Cannot(words::NEEDS_TIER);
    };
    let mut ways = scene.seen.settings.timeline.clone();
    let (id, name) = (tier.row.id, tier.row.name.clone());
    match action {
        Action::ChangeTier | Action::RemoveTier => {
            let change = action == Action::ChangeTier;
            let what = if change {
                What::Change(id)
            } else {
                What::Remove(id)
            };
            timeline.tier_box = Some(TierBox::of(scene.contents, tier, what));
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
            out.work(Work::ChangeTier(TierName::Number(id), change));
            return Acted::Yes;
        }
        Action::HideTier => {
            ways.hidden.insert(name);
        }
        _ => ways::toggle(&mut ways.folded, name),
    }
    ways::change(scene.seen, out, ways);
    Acted::Yes
}

/// Returns the place that brings a tier beyond its next or previous sibling, from tiers as
/// `(id, parent)` in their order.
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
    }
}
