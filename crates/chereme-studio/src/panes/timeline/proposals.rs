//! Values proposed from movement: they are hatched until a person accepts them.

use std::collections::BTreeSet;

use chereme_corpus::{
    Contents, Name, ProposeOptions, ProposeScope, Proposed, TierContents, accepting_tier,
    proposed_for,
};
use chereme_motion::Instant;

use super::detector_list::ChooseDetector;
use super::edit::{self, Scene};
use super::spans::Item;
use super::{Then, Timeline, data, tier_list};
use crate::action::Action;
use crate::command::Command;
use crate::context::Outbox;
use crate::panes::Acted;
use crate::words::{fill, timeline as words};
use crate::work::analysis;

/// A proposal is doubtful below this confidence, or if none is known.
const SURE: f64 = 0.75;

/// A proposal in a recording.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Proposal {
    start: i64,
    end: i64,
    tier: i64,
    id: i64,
    doubtful: bool,
}

/// Carries out an action on proposals.
pub(super) fn act(
    timeline: &mut Timeline,
    action: Action,
    scene: &Scene<'_>,
    out: &mut Outbox,
) -> Acted {
    match action {
        Action::Propose => {
            let options = ProposeOptions {
                components: Proposed::COMPONENTS.to_vec(),
                scope: scope(scene),
            };
            timeline.asked.proposing = Some(out.work(analysis::propose(options)));
        }
        Action::Detect => timeline.boxes.detectors = Some(ChooseDetector::default()),
        Action::NextProposal => match next(&all(scene.contents), here(scene), |_| true) {
            Some(next) => go(timeline, next, out),
            None => return Acted::Cannot(words::NO_PROPOSAL),
        },
        Action::AcceptProposal | Action::EnterValue => return accept(timeline, action, scene, out),
        _ => return Acted::No,
    }
    Acted::Yes
}

/// Accepts the selected proposals that have room on their tiers, and goes to the next one that has; at the end it says
/// that all are accepted, or which are left.
fn accept(timeline: &mut Timeline, action: Action, scene: &Scene<'_>, out: &mut Outbox) -> Acted {
    let chosen = chosen(scene);
    let reviewing =
        scene.seen.shown.annotations.is_empty() && scene.tier().is_some_and(edit::holds_proposals);
    if chosen.is_empty() && !reviewing {
        return match action {
            Action::EnterValue => Acted::No,
            _ => Acted::Cannot(words::NO_PROPOSAL),
        };
    }
    let has_room = |it: &Proposal| full_tier(scene, it).is_none();
    let (selected, mut left): (Vec<_>, Vec<_>) = all(scene.contents)
        .into_iter()
        .partition(|it| chosen.contains(&it.id));
    let (accepted, stuck): (Vec<_>, Vec<_>) = selected.into_iter().partition(has_room);
    let refused = &timeline.asked.refused;
    let next = next(&left, here(scene), |it| {
        !refused.contains(&it.id) && has_room(it)
    });
    if !accepted.is_empty() {
        let proposals: BTreeSet<i64> = accepted.iter().map(|it| it.id).collect();
        let id = out.work(analysis::accept(proposals.iter().copied().collect()));
        let then = Then {
            proposals,
            ..Then::default()
        };
        timeline.asked.pending.insert(id, then);
    }
    if let Some(next) = next {
        if let Some(text) = left_text(scene, &stuck) {
            out.send(Command::Say(text));
        }
        go(timeline, next, out);
        return Acted::Yes;
    }
    left.extend(stuck);
    left.sort_by_key(|it| (it.start, it.tier, it.id));
    if !accepted.is_empty() {
        // Another Enter begins nothing at the same time.
        out.send(Command::Span(None));
    }
    out.send(match left_text(scene, &left) {
        Some(text) => Command::Notify(text, words::LEFT_PROPOSALS_REMEDY),
        None => Command::Say(scene.seen.say(words::ALL_ACCEPTED).to_owned()),
    });
    Acted::Yes
}

/// Returns the tier on which a proposal is accepted, if there is one already.
fn tier_for<'a>(scene: &Scene<'a>, proposal: &Proposal) -> Option<&'a TierContents> {
    let rows = scene.contents.tiers.iter().map(|it| &it.row);
    let tier = scene.tier_of(proposal.tier)?;
    scene.tier_of(accepting_tier(&tier.row, rows)?.id)
}

/// Returns the tier on which a proposal is accepted, if it has no room for it.
fn full_tier<'a>(scene: &Scene<'a>, proposal: &Proposal) -> Option<&'a TierContents> {
    let tier = tier_for(scene, proposal)?;
    let Proposal { start, end, id, .. } = *proposal;
    let columns = &tier.annotations;
    let first = columns.ends.partition_point(|it| *it <= start);
    let taken = columns.starts.get(first).is_some_and(|it| *it < end);
    let unfit = || tier_list::unfit(scene, tier, &[Item { id, start, end }]).is_some();
    (taken || unfit()).then_some(tier)
}

/// Returns the sentence for proposals without room, if there are any: how many they are, and on which tiers.
fn left_text(scene: &Scene<'_>, left: &[Proposal]) -> Option<String> {
    let first = data::time_text(Instant::from_micros(left.first()?.start));
    let tiers = left.iter().filter_map(|it| tier_for(scene, it));
    let names: BTreeSet<&str> = tiers.map(|it| it.row.name.as_str()).collect();
    let names: Vec<&str> = names.into_iter().collect();
    let values: [(&str, &dyn std::fmt::Display); 3] = [
        ("n", &left.len()),
        ("time", &first),
        ("tiers", &names.join(", ")),
    ];
    Some(fill(scene.seen.say(words::LEFT_PROPOSALS), &values))
}

/// Returns the scope of proposals: the selected sign, the selected time, or else the recording.
pub(super) fn scope(scene: &Scene<'_>) -> ProposeScope {
    let shown = scene.seen.shown;
    let recording = Name::Number(scene.contents.recording.id);
    let token = shown.annotation().and_then(|annotation| {
        let mut tokens = scene.contents.tokens.iter();
        tokens.find(|it| it.annotation_id == Some(annotation))
    });
    match (token, shown.span) {
        (Some(token), _) => ProposeScope::Token(token.id),
        (None, Some(span)) => ProposeScope::Span(recording, span),
        (None, None) => ProposeScope::Recording(recording),
    }
}

/// Returns the proposals of a recording, in order of time.
fn all(contents: &Contents) -> Vec<Proposal> {
    let mut all = Vec::new();
    for tier in &contents.tiers {
        if proposed_for(&tier.row.name).is_none() {
            continue;
        }
        let columns = &tier.annotations;
        all.extend((0..columns.len()).map(|at| Proposal {
            start: columns.starts[at],
            end: columns.ends[at],
            tier: tier.row.id,
            id: columns.ids[at],
            doubtful: columns.confidences[at].is_none_or(|sure| sure < SURE),
        }));
    }
    all.sort_by_key(|it| (it.start, it.tier, it.id));
    all
}

/// Returns the selected annotations, if all of them are proposals.
fn chosen(scene: &Scene<'_>) -> BTreeSet<i64> {
    let chosen = &scene.seen.shown.annotations;
    let is_proposal = |id: &i64| {
        let found = scene.seen.snapshot.annotation(*id);
        found.is_some_and(|it| proposed_for(&it.tier.row.name).is_some())
    };
    if chosen.iter().all(is_proposal) {
        chosen.clone()
    } else {
        BTreeSet::new()
    }
}

/// Returns the present place in the order of proposals: the start of the selected annotation with its tier and id, else
/// the playhead.
fn here(scene: &Scene<'_>) -> (i64, i64, i64) {
    let found = scene.seen.shown.annotations.last().and_then(|id| {
        let found = scene.seen.snapshot.annotation(*id)?;
        let start = found.tier.annotations.starts[found.at];
        Some((start, found.tier.row.id, *id))
    });
    found.unwrap_or((scene.playhead(), i64::MIN, i64::MIN))
}

/// Returns the next doubtful proposal after a place that is wanted, cyclically; if none is doubtful, the next proposal.
fn next(
    all: &[Proposal],
    here: (i64, i64, i64),
    wanted: impl Fn(&Proposal) -> bool,
) -> Option<Proposal> {
    let later = all.partition_point(|it| (it.start, it.tier, it.id) <= here);
    let round = || all[later..].iter().chain(&all[..later]).copied();
    let doubtful = round().find(|it| it.doubtful && wanted(it));
    doubtful.or_else(|| round().find(wanted))
}

/// Brings the next doubtful proposal into sight.
pub(super) fn show_next(timeline: &mut Timeline, scene: &Scene<'_>) {
    if let Some(next) = next(&all(scene.contents), here(scene), |_| true) {
        let whole = scene.seen.shown.player.whole;
        let start = Instant::from_micros(next.start);
        timeline.view.bring_into_sight(next.tier, start, whole);
    }
}

/// Selects a proposal, and moves the playhead to it.
fn go(timeline: &mut Timeline, to: Proposal, out: &mut Outbox) {
    let micros = Instant::from_micros;
    out.send(Command::Tier(Some(to.tier)));
    out.send(Command::Annotations([to.id].into()));
    out.send(Command::Span(Some(chereme_motion::Span::between(
        micros(to.start),
        micros(to.end),
    ))));
    out.seek(micros(to.start + (to.end - to.start) / 2));
    timeline.show_tier();
    if !timeline.view.drawn {
        out.send(Command::Do(Action::ShowTimeline));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_next_proposal_is_an_uncertain_one_and_wraps_around() {
        let proposal = |start, id, doubtful| Proposal {
            start,
            end: start + 5,
            tier: 1,
            id,
            doubtful,
        };
        let all = [
            proposal(0, 10, true),
            proposal(10, 11, false),
            proposal(20, 12, true),
        ];
        let id = |here| next(&all, here, |_| true).map(|it| it.id);
        assert_eq!(id((-1, 0, 0)), Some(10));
        assert_eq!(id((0, 1, 10)), Some(12), "what is sure is passed over");
        assert_eq!(id((20, 1, 12)), Some(10), "it goes round");
        let sure = [proposal(0, 10, false), proposal(10, 11, false)];
        assert_eq!(next(&sure, (0, 1, 10), |_| true).map(|it| it.id), Some(11));
        assert_eq!(
            next(&all, (0, 1, 10), |it| it.id == 11).map(|it| it.id),
            Some(11)
        );
        assert_eq!(next(&[], (0, 1, 10), |_| true), None);
    }
}
