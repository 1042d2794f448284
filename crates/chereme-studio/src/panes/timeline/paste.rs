//! Copying, cutting, pasting and duplicating annotations.

use std::collections::{BTreeMap, BTreeSet};

use chereme_corpus::{AnnotationChange, Contents, Stereotype, TierContents};
use chereme_motion::Instant;

use super::copied::{self, Clip, CopiedAnnotation, Odd};
use super::data::time_text;
use super::dragged::{self, TierTiming};
use super::edit::{self, Scene};
use super::{Ghost, Then, Timeline, changes, paste_box, tier_list};
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
                let gone = changes::remove(scene.contents, &chosen);
                timeline.change(gone, Then::default(), out);
            }
            copied
        }
        Action::CopyTime => {
            let text = time_text(scene.seen.shown.player.playhead());
            let said = fill(scene.seen.say(words::TIME_COPIED), &[("time", &text)]);
            out.send(Command::Copy(text));
            out.send(Command::Say(said));
            Acted::Yes
        }
        Action::Paste | Action::PasteHere => match timeline.clip.take() {
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
fn said_of(contents: &Contents, chosen: &BTreeSet<i64>) -> Vec<CopiedAnnotation> {
    let mut all = Vec::new();
    for tier in &contents.tiers {
        let columns = &tier.annotations;
        all.extend(dragged::places(tier, chosen).map(|at| CopiedAnnotation {
            line: 0,
            tier: Some(tier.row.name.clone()),
            start: columns.starts[at],
            end: columns.ends[at],
            value: changes::typed(columns, at),
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
    let all = said_of(scene.contents, &chosen);
    let rows = all.iter().map(|it| {
        let tier = it.tier.as_deref().unwrap_or_default();
        (tier, it.start, it.end, it.value.clone())
    });
    out.send(Command::Copy(copied::write(rows)));
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
    let frame = |at: u64| {
        let at = usize::try_from(at).ok()?;
        frames.map(|it| it.rate.instant(at).micros() + it.offset)
    };
    let (rows, odd) = match copied::read(text, frame) {
        Clip::Rows(rows, odd) => (rows, odd),
        Clip::Values(values) => return say(timeline, scene, values, out),
    };
    let Some(tier) = scene.tier() else {
        return Acted::Cannot(words::NEEDS_TIER);
    };
    let here = here.then(|| scene.playhead());
    let mut plan = scene.plan(tier, rows, here);
    plan.odd.extend(odd);
    plan.odd.sort_by_key(|it| it.line);
    if plan.odd.is_empty() {
        return put(timeline, &plan.adds, out);
    }
    // Text that was copied here and has no free place needs no list of lines.
    let taken = plan.odd.iter().all(|it| it.why == words::ODD_TAKEN);
    if plan.adds.is_empty() && taken {
        let why = if here.is_some() {
            words::NO_ROOM
        } else {
            words::PASTE_TAKEN
        };
        return Acted::Cannot(why);
    }
    timeline.paste_box = Some(paste_box::PasteBox { plan });
    Acted::Yes
}

/// Adds annotations as one operation, and selects the new ones.
pub(super) fn put(timeline: &mut Timeline, adds: &[Add], out: &mut Outbox) -> Acted {
    if adds.is_empty() {
        return Acted::Cannot(words::NOTHING_TO_PASTE);
    }
    let asked: Vec<AnnotationChange> = adds
        .iter()
        .map(|it| changes::add(it.tier, it.span, &it.value))
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
                    put(timeline, &[Add { tier, span, value }], out)
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
            let why = words::ODD_LEFT;
            odd.push(Odd { line, why, text });
            continue;
        };
        if known(&text) {
            asked.extend(changes::say(&BTreeSet::from([columns.ids[at]]), &text));
        } else {
            let why = words::ODD_VALUE;
            odd.push(Odd { line, why, text });
        }
    }
    if let Some(first) = odd.first() {
        let text = fill(scene.seen.say(first.why), &[("text", &first.text)]);
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
    let mut all = said_of(scene.contents, &chosen);
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

/// An annotation to add.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Add {
    pub(super) tier: i64,
    pub(super) span: (i64, i64),
    pub(super) value: String,
}

/// The plan of a paste: annotations to add, and lines that cannot be added.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct PastePlan {
    /// In an order in which they can be added: parents before children.
    pub(super) adds: Vec<Add>,
    pub(super) odd: Vec<Odd>,
}

impl Scene<'_> {
    /// Returns whether a tier allows a value.
    fn knows(&self, tier: &TierContents, value: &str) -> bool {
        const MISSING: [&str; 5] = ["", "unset", "n/a", "unclear", "?"];
        let value = value.trim();
        let stored = self.inventory(tier);
        stored.is_none_or(|it| MISSING.contains(&value) || it.inventory.find(value).is_some())
    }

    fn plan(&self, to: &TierContents, rows: Vec<CopiedAnnotation>, here: Option<i64>) -> PastePlan {
        let until = dragged::limits(self.contents, self.frames().is_some()).to;
        let knows = |tier: &TierContents, value: &str| self.knows(tier, value);
        plan(self.contents, to, rows, (here, until), knows)
    }
}

/// Plans where annotations go: at their own times, or with the first of them at `here`; on the tiers that they name.
/// Those without a tier name go to the tier `to`. So do all if they name only one tier, and `here` is given or the
/// recording lacks that tier.
pub(super) fn plan(
    contents: &Contents,
    to: &TierContents,
    mut rows: Vec<CopiedAnnotation>,
    (here, until): (Option<i64>, i64),
    knows: impl Fn(&TierContents, &str) -> bool,
) -> PastePlan {
    let names: BTreeSet<&str> = rows.iter().filter_map(|it| it.tier.as_deref()).collect();
    let named = |name: &str| contents.tiers.iter().position(|it| it.row.name == name);
    let own = contents.tiers.iter().position(|it| it.row.id == to.row.id);
    let one = names.len() <= 1;
    let place = |tier: Option<&str>| match tier {
        Some(name) if !(one && here.is_some()) => named(name).or(own.filter(|_| one)),
        _ => own,
    };
    let first = rows.iter().map(|it| it.start).min().unwrap_or_default();
    let by = here.map_or(0, |here| here - first);
    let mut plan = PastePlan::default();
    let mut placed = Vec::new();
    for mut row in rows.drain(..) {
        (row.start, row.end) = (row.start + by, row.end + by);
        match place(row.tier.as_deref()) {
            Some(at) => placed.push((depth(contents, at), at, row)),
            None => plan.odd.push(Odd {
                line: row.line,
                why: words::ODD_TIER,
                text: row.tier.unwrap_or_default(),
            }),
        }
    }
    placed.sort_by_key(|(depth, tier, row)| (*depth, *tier, row.start));
    let mut taken: BTreeMap<i64, Taken> = BTreeMap::new();
    for (_, at, row) in placed {
        let tier = &contents.tiers[at];
        let found = if !knows(tier, &row.value) {
            Err((words::ODD_VALUE, row.value.clone()))
        } else {
            fit(contents, tier, (row.start, row.end), until, &mut taken)
                .map_err(|why| (why, time_text(Instant::from_micros(row.start))))
        };
        match found {
            Ok(span) => plan.adds.push(Add {
                tier: tier.row.id,
                span,
                value: row.value,
            }),
            Err((why, text)) => plan.odd.push(Odd {
                line: row.line,
                why,
                text,
            }),
        }
    }
    plan
}

/// Returns the number of ancestors of a tier.
fn depth(contents: &Contents, at: usize) -> usize {
    let mut above = contents.tiers[at].row.parent_id;
    let tiers = &contents.tiers;
    (0..tiers.len())
        .take_while(|_| {
            let parent = tiers.iter().find(|it| Some(it.row.id) == above);
            above = parent.and_then(|it| it.row.parent_id);
            parent.is_some()
        })
        .count()
}

/// The occupied spans of a tier: their ends by their starts, in microseconds.
type Taken = BTreeMap<i64, i64>;

fn taken_by(tier: &TierContents) -> Taken {
    let columns = &tier.annotations;
    let pairs = columns.starts.iter().zip(&columns.ends);
    pairs.map(|(start, end)| (*start, *end)).collect()
}

/// Returns the times to request for an annotation, and marks them as occupied; or the reason why it cannot be added.
fn fit(
    contents: &Contents,
    tier: &TierContents,
    (start, end): (i64, i64),
    until: i64,
    taken: &mut BTreeMap<i64, Taken>,
) -> Result<(i64, i64), Text> {
    if start < 0 || end > until {
        return Err(words::ODD_OUTSIDE);
    }
    let kind = TierTiming::of(&tier.row);
    let tiers = &contents.tiers;
    let parent = tiers
        .iter()
        .find(|it| Some(it.row.id) == tier.row.parent_id);
    let mut above = (start, end);
    if let Some(parent) = parent.filter(|_| kind != TierTiming::Root) {
        let all = taken
            .entry(parent.row.id)
            .or_insert_with(|| taken_by(parent));
        let found = all.range(..=start).next_back();
        let found = found.filter(|(_, to)| end <= **to);
        above = found.map(|it| (*it.0, *it.1)).ok_or(words::ODD_PARENT)?;
    }
    let own = taken.entry(tier.row.id).or_insert_with(|| taken_by(tier));
    let meets = own.range(..end).next_back().filter(|(_, to)| **to > start);
    let meets = meets.map(|it| (*it.0, *it.1));
    let asked = match (kind, meets) {
        (TierTiming::Tiled, None) => above,
        (TierTiming::Tiled, Some((from, to))) if from < start => {
            own.insert(from, start);
            (start, to)
        }
        (TierTiming::Listed, None) => above,
        (TierTiming::Listed, Some(_)) if !is_association(tier) => above,
        (_, Some(_)) => return Err(words::ODD_TAKEN),
        (_, None) => (start, end),
    };
    let lies = if kind == TierTiming::Listed {
        (start, end)
    } else {
        asked
    };
    own.insert(lies.0, lies.1);
    Ok(asked)
}

/// Returns whether a tier has at most one annotation for each annotation of its parent tier.
pub(super) fn is_association(tier: &TierContents) -> bool {
    tier.row.stereotype == Some(Stereotype::SymbolicAssociation)
}

#[cfg(test)]
mod tests {
    use super::super::dragged::tests::contents;
    use super::*;

    fn said(tier: Option<&str>, start: i64, end: i64) -> CopiedAnnotation {
        CopiedAnnotation {
            line: 0,
            tier: tier.map(str::to_owned),
            start,
            end,
            value: String::new(),
        }
    }

    fn recording() -> Contents {
        contents(&[
            (1, None, "", &[(1, 0, 100, None), (2, 500, 600, None)]),
            (2, Some(1), "Included_In", &[(3, 10, 20, Some(1))]),
            (3, Some(1), "Time_Subdivision", &[]),
            (4, Some(1), "Symbolic_Association", &[(4, 0, 100, Some(1))]),
            (5, None, "", &[]),
        ])
    }

    /// Returns `(tier, start, end)` of the planned annotations, and the reasons for the refused lines.
    fn planned(
        to: usize,
        rows: Vec<CopiedAnnotation>,
        here: Option<i64>,
    ) -> (Vec<(i64, i64, i64)>, Vec<Text>) {
        let all = recording();
        let plan = plan(&all, &all.tiers[to], rows, (here, 1000), |_, _| true);
        let adds = plan.adds.iter().map(|it| (it.tier, it.span.0, it.span.1));
        (adds.collect(), plan.odd.iter().map(|it| it.why).collect())
    }

    #[test]
    fn offsets_are_kept_and_a_single_tier_is_pasted_into_the_selected_one() {
        let two = || {
            vec![
                said(Some("tier 1"), 500, 600),
                said(Some("tier 1"), 700, 750),
            ]
        };
        assert_eq!(
            planned(4, two(), Some(10)),
            (vec![(5, 10, 110), (5, 210, 260)], vec![])
        );
        assert_eq!(
            planned(4, two(), None),
            (vec![(1, 700, 750)], vec![words::ODD_TAKEN])
        );
        let other = vec![said(Some("elsewhere"), 5, 6), said(None, 7, 8)];
        assert_eq!(
            planned(4, other, None),
            (vec![(5, 5, 6), (5, 7, 8)], vec![])
        );
        let outside = vec![said(None, 0, 50)];
        assert_eq!(
            planned(4, outside, Some(960)),
            (vec![], vec![words::ODD_OUTSIDE])
        );
    }

    #[test]
    fn pasted_children_follow_their_pasted_parents() {
        let group = vec![
            said(Some("tier 2"), 10, 20),
            said(Some("tier 3"), 0, 40),
            said(Some("tier 3"), 40, 100),
            said(Some("tier 4"), 0, 100),
            said(Some("tier 1"), 0, 100),
            said(Some("tier 9"), 0, 100),
        ];
        let (adds, odd) = planned(4, group, Some(200));
        let want = [
            (1, 200, 300),
            (2, 210, 220),
            (3, 200, 300),
            (3, 240, 300),
            (4, 200, 300),
        ];
        assert_eq!((adds, odd), (want.to_vec(), vec![words::ODD_TIER]));
    }

    #[test]
    fn missing_and_occupied_parents_are_reported() {
        assert_eq!(
            planned(1, vec![said(None, 110, 120)], None).1,
            [words::ODD_PARENT]
        );
        assert_eq!(
            planned(3, vec![said(None, 0, 100)], None).1,
            [words::ODD_TAKEN]
        );
        assert_eq!(
            planned(2, vec![said(None, 30, 60)], None),
            (vec![(3, 0, 100)], vec![])
        );
    }
}
