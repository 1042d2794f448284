//! Copying, cutting, pasting and duplicating annotations.

use std::collections::BTreeSet;

use chereme_corpus::clipboard::{self, ClipboardText, CopiedAnnotation, OddLine, OddReason};
use chereme_corpus::paste::{PastePlan, PastedAnnotation, allows, plan};
use chereme_corpus::{AnnotationChange, Contents, TierContents, requests};

use super::data::time_text;
use super::dragged;
use super::edit::{self, Scene};
use super::{Ghost, Then, Timeline, paste_box, tier_list};
use crate::action::Action;
use crate::command::Command;
use crate::context::Outbox;
use crate::panes::Acted;
use crate::words::{Text, fill, shell, timeline as words};

/// Carries out an action of the clipboard.
pub(super) fn act(
    timeline: &mut Timeline,
    action: Action,
    scene: &Scene<'_>,
    out: &mut Outbox,
) -> Acted {
    match action {
        Action::Copy => copy(scene, false, out),
        Action::CopyWithBelow => copy(scene, true, out),
        Action::Cut => {
            let chosen = chosen(scene);
            let copied = copy(scene, true, out);
            if copied == Acted::Yes {
                let gone = requests::remove(scene.contents, &chosen);
                timeline.change(gone, Then::default(), out);
            }
            copied
        }
        Action::CopyTime => {
            let text = time_text(scene.seen.shown.player.playhead());
            let message = fill(scene.seen.say(words::TIME_COPIED), &[("time", &text)]);
            out.send(Command::Copy(text));
            out.send(Command::Say(message));
            Acted::Yes
        }
        Action::Paste | Action::PasteHere => match timeline.boxes.clip.take() {
            Some(text) => paste(timeline, scene, &text, action == Action::PasteHere, out),
            None => Acted::Cannot(words::NOTHING_TO_PASTE),
        },
        Action::Duplicate => duplicate(timeline, scene, out),
        _ => Acted::No,
    }
}

/// Returns the selected annotations, else the one at the playhead.
fn chosen(scene: &Scene<'_>) -> BTreeSet<i64> {
    let chosen = &scene.seen.shown.annotations;
    if chosen.is_empty() {
        return edit::alone(scene).into_iter().collect();
    }
    chosen.clone()
}

/// Returns annotations as lines of the clipboard's text, tier by tier.
fn copied_rows(contents: &Contents, chosen: &BTreeSet<i64>) -> Vec<CopiedAnnotation> {
    let mut all = Vec::new();
    for tier in &contents.tiers {
        let columns = &tier.annotations;
        all.extend(dragged::places(tier, chosen).map(|at| CopiedAnnotation {
            line: 0,
            tier: Some(tier.row.name.clone()),
            start: columns.starts[at],
            end: columns.ends[at],
            value: requests::typed(columns, at),
        }));
    }
    all
}

fn copy(scene: &Scene<'_>, with_below: bool, out: &mut Outbox) -> Acted {
    let mut chosen = chosen(scene);
    if chosen.is_empty() {
        return Acted::Cannot(shell::NEEDS_ANNOTATION);
    }
    if with_below {
        chosen = dragged::with_below(scene.contents, chosen);
    }
    let all = copied_rows(scene.contents, &chosen);
    let rows = all.iter().map(|it| {
        let tier = it.tier.as_deref().unwrap_or_default();
        (tier, it.start, it.end, it.value.clone())
    });
    out.send(Command::Copy(clipboard::write(rows)));
    let text = scene.seen.say(words::COPIED);
    out.send(Command::Say(fill(text, &[("n", &all.len())])));
    Acted::Yes
}

fn paste(
    timeline: &mut Timeline,
    scene: &Scene<'_>,
    text: &str,
    here: bool,
    out: &mut Outbox,
) -> Acted {
    let frames = scene.frames();
    let frame = |at: u64| frames.map(|it| it.start(at));
    let (rows, odd) = match clipboard::read(text, frame) {
        ClipboardText::Rows(rows, odd) => (rows, odd),
        ClipboardText::Values(values) => return say(timeline, scene, values, out),
    };
    let Some(tier) = scene.tier() else {
        return Acted::Cannot(words::NEEDS_TIER);
    };
    let here = here.then(|| scene.playhead());
    let mut plan = scene.plan(tier, rows, here);
    let mut tiers = plan.adds.iter().filter_map(|it| scene.tier_of(it.tier));
    if tiers.any(edit::holds_proposals) {
        return Acted::Cannot(words::HOLDS_PROPOSALS);
    }
    plan.odd.extend(odd);
    plan.odd.sort_by_key(|it| it.line);
    if plan.odd.is_empty() {
        return put(timeline, &plan.adds, out);
    }
    // Text that was copied here and has no free place needs no list of lines.
    let taken = plan.odd.iter().all(|it| it.why == OddReason::Taken);
    if plan.adds.is_empty() && taken {
        let why = if here.is_some() {
            words::NO_ROOM
        } else {
            words::PASTE_TAKEN
        };
        return Acted::Cannot(why);
    }
    timeline.boxes.paste_box = Some(paste_box::PasteBox { plan });
    Acted::Yes
}

/// Adds annotations as one operation, and selects the new ones.
pub(super) fn put(timeline: &mut Timeline, adds: &[PastedAnnotation], out: &mut Outbox) -> Acted {
    if adds.is_empty() {
        return Acted::Cannot(words::NOTHING_TO_PASTE);
    }
    let asked: Vec<AnnotationChange> = adds
        .iter()
        .map(|it| requests::add(it.tier, it.span, &it.value))
        .collect();
    let ghosts = adds.iter().map(|it| Ghost {
        tier: it.tier,
        id: None,
        start: it.span.0,
        end: it.span.1,
    });
    let then = Then {
        select: true,
        ghosts: ghosts.collect(),
        ..Then::default()
    };
    timeline.change(asked, then, out)
}

/// Gives values to the selected annotations, one after the other. If only one is selected, the values go to it and
/// those after it; if none is selected, the first value goes to a new annotation on the selected time.
fn say(
    timeline: &mut Timeline,
    scene: &Scene<'_>,
    values: Vec<(usize, String)>,
    out: &mut Outbox,
) -> Acted {
    let Some(tier) = scene.tier() else {
        return Acted::Cannot(words::NEEDS_TIER);
    };
    if edit::holds_proposals(tier) {
        return Acted::Cannot(words::HOLDS_PROPOSALS);
    }
    let shown = scene.seen.shown;
    let columns = &tier.annotations;
    let places: Vec<usize> = dragged::places(tier, &shown.annotations).collect();
    let places = match (places.as_slice(), values.as_slice()) {
        (_, []) => return Acted::Cannot(words::NOTHING_TO_PASTE),
        ([], [(_, value)]) => {
            let Some(span) = shown.span else {
                return Acted::Cannot(shell::NEEDS_ANNOTATION);
            };
            let wanted = (span.start().micros(), span.end().micros());
            return match dragged::room(scene.contents, tier, wanted) {
                Some(span) => {
                    let (tier, value) = (tier.row.id, value.clone());
                    put(timeline, &[PastedAnnotation { tier, span, value }], out)
                }
                None => Acted::Cannot(edit::no_room(tier)),
            };
        }
        ([], _) => return Acted::Cannot(shell::NEEDS_ANNOTATION),
        ([one], _) => (*one..columns.len()).collect(),
        _ => places,
    };
    let known = |value: &str| scene.knows(tier, value);
    let mut odd = Vec::new();
    let mut asked = Vec::new();
    let mut places = places.into_iter();
    for (line, text) in values {
        let Some(at) = places.next() else {
            let why = OddReason::Left;
            odd.push(OddLine {
                line,
                why,
                text,
                at: None,
            });
            continue;
        };
        if known(&text) {
            asked.extend(requests::set_value(
                &BTreeSet::from([columns.ids[at]]),
                &text,
            ));
        } else {
            let why = OddReason::Value;
            odd.push(OddLine {
                line,
                why,
                text,
                at: None,
            });
        }
    }
    if let Some(first) = odd.first() {
        let text = odd_text(scene, first);
        let what: [(&str, &dyn std::fmt::Display); 2] = [("n", &first.line), ("what", &text)];
        out.send(Command::Say(fill(scene.seen.say(words::PASTE_LINE), &what)));
    }
    if asked.is_empty() {
        return Acted::Yes;
    }
    timeline.change(asked, Then::default(), out)
}

/// Copies selected annotations on other tiers to the selected tier; those on the selected tier are copied behind
/// themselves if there is room.
fn duplicate(timeline: &mut Timeline, scene: &Scene<'_>, out: &mut Outbox) -> Acted {
    let chosen = chosen(scene);
    let (Some(tier), false) = (scene.tier(), chosen.is_empty()) else {
        return Acted::Cannot(shell::NEEDS_ANNOTATION);
    };
    let own: Vec<usize> = dragged::places(tier, &chosen).collect();
    let columns = &tier.annotations;
    let Some(last) = own.last() else {
        return match tier_list::put(timeline, scene, tier.row.id, false, out) {
            Some(why) => Acted::Cannot(why),
            None => Acted::Yes,
        };
    };
    if own.len() < chosen.len() {
        return Acted::Cannot(words::ONE_TIER);
    }
    if edit::holds_proposals(tier) {
        return Acted::Cannot(words::HOLDS_PROPOSALS);
    }
    let mut all = copied_rows(scene.contents, &chosen);
    let end = columns.ends[*last];
    if let [one] = all.as_mut_slice() {
        let until = dragged::limits(scene.contents, scene.frames().is_some()).to;
        let next = columns.starts.get(last + 1).map_or(until, |it| *it);
        one.end = one.end.min(one.start + (next - end).max(dragged::LEAST));
    }
    let plan = scene.plan(tier, all, Some(end));
    if plan.odd.is_empty() {
        put(timeline, &plan.adds, out)
    } else {
        Acted::Cannot(words::NO_ROOM_BESIDE)
    }
}

/// Returns the sentence for a line without a place.
pub(super) fn odd_text(scene: &Scene<'_>, odd: &OddLine) -> String {
    let text = odd.at.map_or_else(|| odd.text.clone(), time_text);
    fill(scene.seen.say(reason(odd.why)), &[("text", &text)])
}

/// Returns the sentence for a reason; `{text}` stands for what it concerns.
fn reason(why: OddReason) -> Text {
    match why {
        OddReason::Time => words::ODD_TIME,
        OddReason::Row => words::ODD_ROW,
        OddReason::Ends => words::ODD_ENDS,
        OddReason::Tier => words::ODD_TIER,
        OddReason::Value => words::ODD_VALUE,
        OddReason::Outside => words::ODD_OUTSIDE,
        OddReason::Parent => words::ODD_PARENT,
        OddReason::Taken => words::ODD_TAKEN,
        OddReason::Left => words::ODD_LEFT,
    }
}

impl Scene<'_> {
    /// Returns whether a tier allows a value.
    fn knows(&self, tier: &TierContents, value: &str) -> bool {
        allows(self.inventory(tier), value)
    }

    fn plan(&self, to: &TierContents, rows: Vec<CopiedAnnotation>, here: Option<i64>) -> PastePlan {
        let until = dragged::limits(self.contents, self.frames().is_some()).to;
        let knows = |tier: &TierContents, value: &str| self.knows(tier, value);
        plan(self.contents, Some(to), rows, (here, until), knows)
    }
}
