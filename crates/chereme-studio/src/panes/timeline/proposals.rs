//! Values proposed from movement: they are hatched until a person accepts them.

use std::collections::BTreeSet;

use chereme_corpus::{Contents, Name, ProposeOptions, ProposeScope, Proposed, proposed_for};
use chereme_motion::Instant;

use super::detector_list::ChooseDetector;
use super::edit::{self, Scene};
use super::{Then, Timeline};
use crate::action::Action;
use crate::command::Command;
use crate::context::Outbox;
use crate::panes::Acted;
use crate::words::timeline as words;
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
        Action::NextProposal => match next(&all(scene.contents), here(scene)) {
            Some(next) => go(timeline, next, out),
            None => return Acted::Cannot(words::NO_PROPOSAL),
        },
        Action::AcceptProposal | Action::EnterValue => {
            let chosen = chosen(scene);
            let mut left = all(scene.contents);
            left.retain(|it| !chosen.contains(&it.id));
            let next = next(&left, here(scene));
            if chosen.is_empty() {
                let reviewing = scene.seen.shown.annotations.is_empty()
                    && scene.tier().is_some_and(edit::holds_proposals);
                return match next {
                    Some(next) if reviewing => {
                        go(timeline, next, out);
                        Acted::Yes
                    }
                    None if reviewing => Acted::Cannot(words::ALL_ACCEPTED),
                    _ if action == Action::EnterValue => Acted::No,
                    _ => Acted::Cannot(words::NO_PROPOSAL),
                };
            }
            let id = out.work(analysis::accept(chosen.into_iter().collect()));
            timeline.asked.pending.insert(id, Then::default());
            match next {
                Some(next) => go(timeline, next, out),
                None => {
                    // Another Enter begins nothing at the same time.
                    out.send(Command::Span(None));
                    let text = scene.seen.say(words::ALL_ACCEPTED);
                    out.send(Command::Say(text.to_owned()));
                }
            }
        }
        _ => return Acted::No,
    }
    Acted::Yes
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

/// Returns the next doubtful proposal after a place, cyclically; if none is doubtful, the next proposal.
fn next(all: &[Proposal], here: (i64, i64, i64)) -> Option<Proposal> {
    let after = |it: &&Proposal| (it.start, it.tier, it.id) > here;
    let doubtful = || all.iter().filter(|it| it.doubtful);
    let found = doubtful().find(after).or_else(|| doubtful().next());
    let found = found.or_else(|| all.iter().find(after));
    found.or_else(|| all.first()).copied()
}

/// Brings the next doubtful proposal into sight.
pub(super) fn show_next(timeline: &mut Timeline, scene: &Scene<'_>) {
    if let Some(next) = next(&all(scene.contents), here(scene)) {
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
        let id = |here| next(&all, here).map(|it| it.id);
        assert_eq!(id((-1, 0, 0)), Some(10));
        assert_eq!(id((0, 1, 10)), Some(12), "what is sure is passed over");
        assert_eq!(id((20, 1, 12)), Some(10), "it goes round");
        let sure = [proposal(0, 10, false), proposal(10, 11, false)];
        assert_eq!(next(&sure, (0, 1, 10)).map(|it| it.id), Some(11));
        assert_eq!(next(&[], (0, 1, 10)), None);
    }
}
