//! Values proposed from movement: they are hatched until a person accepts them.

use std::collections::BTreeSet;

use chereme_corpus::{
    ProposalResult, ProposeOptions, ProposeScope, RecordingContents, RowName, TierContents, accepting_tier,
    proposed_for,
};
use chereme_motion::RecordingInstant;

use super::detector_list::ChooseDetector;
use super::tier_spans::SpanItem;
use super::timeline_edit::{self, TimelineScene};
use super::{ChangeFollowUp, TimelinePane, tier_list, timeline_data};
use crate::action::Action;
use crate::command::{CommandOutbox, WindowCommand};
use crate::panes::ActionOutcome;
use crate::words::{fill_text_braces, timeline as words};
use crate::work::analysis;

/// A proposal is doubtful below this confidence, or if none is known.
const SURE_CONFIDENCE_THRESHOLD: f64 = 0.75;

/// A proposal in a recording.
#[derive(Debug, Clone, Copy, PartialEq)]
struct RecordingProposal {
    start: i64,
    end: i64,
    tier: i64,
    id: i64,
    doubtful: bool,
}

/// Carries out an action on proposals.
pub(super) fn carry_out_proposal_action(
    timeline: &mut TimelinePane,
    action: Action,
    scene: &TimelineScene<'_>,
) -> ActionOutcome {
    match action {
        Action::Propose => {
            let options = ProposeOptions {
                components: ProposalResult::READABLE_COMPONENTS.to_vec(),
                scope: current_propose_scope(scene),
            };
            timeline.asked.proposing = Some(scene.seen.request_work(analysis::propose_values_job(options)));
        }
        Action::Detect => timeline.boxes.detectors = Some(ChooseDetector::default()),
        Action::NextProposal => match next(
            &list_recording_proposals(scene.contents),
            current_proposal_place(scene),
            |_| true,
        ) {
            Some(next) => go_to_proposal(timeline, next, scene.seen.out),
            None => return ActionOutcome::Cannot(words::NO_PROPOSAL),
        },
        Action::AcceptProposal | Action::EnterValue => {
            return accept_selected_proposals(timeline, action, scene);
        }
        _ => return ActionOutcome::No,
    }
    ActionOutcome::Yes
}

/// Accepts the selected proposals that have room on their tiers, and goes to the next one that has; at the end it says
/// that all are accepted, or which are left.
fn accept_selected_proposals(timeline: &mut TimelinePane, action: Action, scene: &TimelineScene<'_>) -> ActionOutcome {
    let chosen = selected_proposal_ids(scene);
    // With its last proposal a tier of proposals disappears.
    timeline.asked.all_reviewed &= scene.seen.shown.annotations.is_empty();
    let on_proposals = scene.edited_tier().is_some_and(timeline_edit::holds_proposals);
    let reviewing = scene.seen.shown.annotations.is_empty() && (on_proposals || timeline.asked.all_reviewed);
    if chosen.is_empty() && !reviewing {
        return match action {
            Action::EnterValue => ActionOutcome::No,
            _ => ActionOutcome::Cannot(words::NO_PROPOSAL),
        };
    }
    let has_room = |proposal: &RecordingProposal| full_tier(scene, proposal).is_none();
    let (selected, mut left): (Vec<_>, Vec<_>) = list_recording_proposals(scene.contents)
        .into_iter()
        .partition(|proposal| chosen.contains(&proposal.id));
    // Proposals without room are left for the user to decide.
    let (accepted, stuck): (Vec<_>, Vec<_>) = selected.into_iter().partition(has_room);
    let refused = &timeline.asked.refused;
    let next = next(&left, current_proposal_place(scene), |proposal| {
        !refused.contains(&proposal.id) && has_room(proposal)
    });
    if !accepted.is_empty() {
        let proposals: BTreeSet<i64> = accepted.iter().map(|proposal| proposal.id).collect();
        let id = scene
            .seen
            .request_work(analysis::accept_proposals_job(proposals.iter().copied().collect()));
        let then = ChangeFollowUp {
            proposals,
            ..ChangeFollowUp::default()
        };
        timeline.asked.pending.insert(id, then);
    }
    if let Some(next) = next {
        if let Some(text) = left_text(scene, &stuck) {
            scene.seen.send_command(WindowCommand::Say(text));
        }
        go_to_proposal(timeline, next, scene.seen.out);
        return ActionOutcome::Yes;
    }
    left.extend(stuck);
    // The next round is in order of time again.
    left.sort_by_key(|proposal| (proposal.start, proposal.tier, proposal.id));
    if !accepted.is_empty() {
        // Another Enter begins nothing at the same time.
        scene.seen.send_command(WindowCommand::Span(None));
    }
    timeline.asked.all_reviewed = left.is_empty();
    scene.seen.send_command(match left_text(scene, &left) {
        Some(text) => WindowCommand::Notify(text, words::LEFT_PROPOSALS_REMEDY),
        None => WindowCommand::Say(scene.seen.say_text(words::ALL_ACCEPTED).to_owned()),
    });
    ActionOutcome::Yes
}

/// Rejects the selected annotations if all of them are proposals, and goes to the next one.
pub(super) fn reject_selected_proposals(timeline: &mut TimelinePane, scene: &TimelineScene<'_>) -> bool {
    let proposals = selected_proposal_ids(scene);
    if proposals.is_empty() {
        return false;
    }
    let mut left = list_recording_proposals(scene.contents);
    left.retain(|proposal| !proposals.contains(&proposal.id));
    let next = next(&left, current_proposal_place(scene), |_| true);
    let id = scene
        .seen
        .request_work(analysis::reject_proposals_job(proposals.iter().copied().collect()));
    let then = ChangeFollowUp {
        proposals,
        ..ChangeFollowUp::default()
    };
    timeline.asked.pending.insert(id, then);
    match next {
        Some(next) => go_to_proposal(timeline, next, scene.seen.out),
        None => scene.seen.send_command(WindowCommand::Span(None)),
    }
    true
}

/// Returns the tier on which a proposal is accepted, if there is one already.
fn tier_for<'a>(scene: &TimelineScene<'a>, proposal: &RecordingProposal) -> Option<&'a TierContents> {
    let rows = scene.contents.tiers.iter().map(|candidate| &candidate.row);
    let tier = scene.tier_of(proposal.tier)?;
    scene.tier_of(accepting_tier(&tier.row, rows, &scene.contents.acceptor)?.id)
}

/// Returns the tier on which a proposal is accepted, if it has no room for it.
fn full_tier<'a>(scene: &TimelineScene<'a>, proposal: &RecordingProposal) -> Option<&'a TierContents> {
    let tier = tier_for(scene, proposal)?;
    let RecordingProposal { start, end, id, .. } = *proposal;
    let columns = &tier.annotations;
    let first = columns.ends.partition_point(|other_end| *other_end <= start);
    // The first annotation that ends after the start is the only one that may be in the way, in order.
    let taken = columns.starts.get(first).is_some_and(|other_start| *other_start < end);
    let unfit = || tier_list::tier_misfit_reason(scene, tier, &[SpanItem { id, start, end }]).is_some();
    (taken || unfit()).then_some(tier)
}

/// Returns the sentence for proposals without room, if there are any: how many they are, and on which tiers.
fn left_text(scene: &TimelineScene<'_>, left: &[RecordingProposal]) -> Option<String> {
    let first = timeline_data::time_text(RecordingInstant::from_micros(left.first()?.start));
    let tiers = left.iter().filter_map(|proposal| tier_for(scene, proposal));
    let name_set: BTreeSet<&str> = tiers.map(|tier| tier.row.name.as_str()).collect();
    let names: Vec<&str> = name_set.into_iter().collect();
    let values: [(&str, &dyn std::fmt::Display); 3] =
        [("n", &left.len()), ("time", &first), ("tiers", &names.join(", "))];
    Some(fill_text_braces(scene.seen.say_text(words::LEFT_PROPOSALS), &values))
}

/// Returns the scope of proposals: the selected sign, the selected time, or else the recording.
pub(super) fn current_propose_scope(scene: &TimelineScene<'_>) -> ProposeScope {
    let shown = scene.seen.shown;
    let recording = RowName::Number(scene.contents.recording.id);
    let token = shown.selected_annotation().and_then(|annotation| {
        let mut tokens = scene.contents.tokens.iter();
        tokens.find(|token| token.annotation_id == Some(annotation))
    });
    match (token, shown.span) {
        (Some(token), _) => ProposeScope::Token(token.id),
        (None, Some(span)) => ProposeScope::Span(recording, span),
        (None, None) => ProposeScope::Recording(recording),
    }
}

/// Returns the proposals of a recording, in order of time.
fn list_recording_proposals(contents: &RecordingContents) -> Vec<RecordingProposal> {
    let mut all = Vec::new();
    for tier in &contents.tiers {
        if proposed_for(&tier.row.name).is_none() {
            continue;
        }
        let columns = &tier.annotations;
        all.extend((0..columns.len()).map(|at| RecordingProposal {
            start: columns.starts[at],
            end: columns.ends[at],
            tier: tier.row.id,
            id: columns.ids[at],
            doubtful: columns.confidences[at].is_none_or(|sure| sure < SURE_CONFIDENCE_THRESHOLD),
        }));
    }
    all.sort_by_key(|proposal| (proposal.start, proposal.tier, proposal.id));
    all
}

/// Returns the selected annotations, if all of them are proposals.
fn selected_proposal_ids(scene: &TimelineScene<'_>) -> BTreeSet<i64> {
    let chosen = &scene.seen.shown.annotations;
    let is_proposal = |id: &i64| {
        let located = scene.seen.snapshot.find_open_annotation(*id);
        located.is_some_and(|place| proposed_for(&place.tier.row.name).is_some())
    };
    if chosen.iter().all(is_proposal) {
        chosen.clone()
    } else {
        BTreeSet::new()
    }
}

/// Returns the present place in the order of proposals: the start of the selected annotation with its tier and id, else
/// the playhead.
fn current_proposal_place(scene: &TimelineScene<'_>) -> (i64, i64, i64) {
    let selected_place = scene.seen.shown.annotations.last().and_then(|id| {
        let annotation = scene.seen.snapshot.find_open_annotation(*id)?;
        let start = annotation.tier.annotations.starts[annotation.at];
        Some((start, annotation.tier.row.id, *id))
    });
    selected_place.unwrap_or((scene.scene_playhead_micros(), i64::MIN, i64::MIN))
}

/// Returns the next doubtful proposal after a place that is wanted, cyclically; if none is doubtful, the next proposal.
fn next(
    all: &[RecordingProposal],
    here: (i64, i64, i64),
    wanted: impl Fn(&RecordingProposal) -> bool,
) -> Option<RecordingProposal> {
    let later = all.partition_point(|proposal| (proposal.start, proposal.tier, proposal.id) <= here);
    let round = || all[later..].iter().chain(&all[..later]).copied();
    // Doubtful ones first: the others can be accepted at the end in one go.
    let doubtful = round().find(|proposal| proposal.doubtful && wanted(proposal));
    doubtful.or_else(|| round().find(wanted))
}

/// Brings the next doubtful proposal into sight.
pub(super) fn show_next(timeline: &mut TimelinePane, scene: &TimelineScene<'_>) {
    if let Some(next) = next(
        &list_recording_proposals(scene.contents),
        current_proposal_place(scene),
        |_| true,
    ) {
        let whole_span = scene.seen.shown.player.whole;
        let start = RecordingInstant::from_micros(next.start);
        timeline.view.bring_into_sight(next.tier, start, whole_span);
    }
}

/// Selects a proposal, and moves the playhead to it.
fn go_to_proposal(timeline: &mut TimelinePane, to: RecordingProposal, out: &CommandOutbox) {
    let micros = RecordingInstant::from_micros;
    out.send_command(WindowCommand::Tier(Some(to.tier)));
    out.send_command(WindowCommand::Annotations([to.id].into()));
    out.send_command(WindowCommand::Span(Some(chereme_motion::TimeSpan::span_between(
        micros(to.start),
        micros(to.end),
    ))));
    out.send_seek(micros(to.start + (to.end - to.start) / 2));
    timeline.show_tier();
    if !timeline.view.drawn {
        out.send_command(WindowCommand::Do(Action::ShowTimeline));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_next_proposal_is_an_uncertain_one_and_wraps_around() {
        let proposal = |start, id, doubtful| RecordingProposal {
            start,
            end: start + 5,
            tier: 1,
            id,
            doubtful,
        };
        let all = [proposal(0, 10, true), proposal(10, 11, false), proposal(20, 12, true)];
        let id = |here| next(&all, here, |_| true).map(|it| it.id);
        assert_eq!(id((-1, 0, 0)), Some(10));
        assert_eq!(id((0, 1, 10)), Some(12), "what is sure is passed over");
        assert_eq!(id((20, 1, 12)), Some(10), "it goes round");
        let sure = [proposal(0, 10, false), proposal(10, 11, false)];
        assert_eq!(next(&sure, (0, 1, 10), |_| true).map(|it| it.id), Some(11));
        assert_eq!(next(&all, (0, 1, 10), |it| it.id == 11).map(|it| it.id), Some(11));
        assert_eq!(next(&[], (0, 1, 10), |_| true), None);
    }
}
