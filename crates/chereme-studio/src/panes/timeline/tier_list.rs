//! The list to choose the tier that annotations are copied or moved to.

use chereme_corpus::{TierContents, requests};
use chereme_sign::text::fold_text;
use eframe::egui::{Button, Id, Key, Modifiers, Role, ScrollArea, Ui, WidgetInfo, vec2};

use super::dragged::{self, TierTiming};
use super::tier_spans::SpanItem;
use super::timeline_edit::{TimelineScene, holds_proposals, no_room};
use super::timeline_parts::box_window;
use super::{ChangeFollowUp, TimelinePane};
use crate::script::script_edit;
use crate::words::{InterfaceText, timeline as words};

/// The list while it is open.
#[derive(Debug)]
pub(super) struct TierChooser {
    /// Whether the annotations are moved rather than copied.
    moving: bool,
    text: String,
    chosen: usize,
    why: Option<InterfaceText>,
}

impl TierChooser {
    pub(super) fn new(moving: bool) -> Self {
        Self {
            moving,
            text: String::new(),
            chosen: 0,
            why: None,
        }
    }
}

/// Returns the tiers whose names contain the typed text, without those of proposals and of the annotations themselves.
fn tiers_matching_text<'a>(scene: &TimelineScene<'a>, text: &str) -> Vec<&'a TierContents> {
    let chosen = &scene.seen.shown.annotations;
    let wanted = fold_text(text.trim());
    let fits = |tier: &&TierContents| {
        fold_text(&tier.row.name).contains(&wanted)
            && !holds_proposals(tier)
            && dragged::chosen_annotation_indices(tier, chosen).next().is_none()
    };
    scene.contents.tiers.iter().filter(fits).collect()
}

/// Shows the list, and copies or moves the selection to the chosen tier.
pub(super) fn show_tier_chooser(timeline: &mut TimelinePane, ui: &mut Ui, scene: &TimelineScene<'_>) {
    let Some(mut choose) = timeline.boxes.choose.take() else {
        return;
    };
    let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    let (up, down) = (pressed(Key::ArrowUp), pressed(Key::ArrowDown));
    let (enter, escape) = (pressed(Key::Enter), pressed(Key::Escape));
    let tiers = tiers_matching_text(scene, &choose.text);
    choose.chosen = match (up, down) {
        (true, _) => choose.chosen.saturating_sub(1),
        (_, true) => choose.chosen + 1,
        _ => choose.chosen,
    }
    .min(tiers.len().saturating_sub(1));
    let mut done = tiers.get(choose.chosen).filter(|_| enter).map(|tier| tier.row.id);
    let title_text = if choose.moving {
        words::MOVE_TITLE
    } else {
        words::COPY_TITLE
    };
    let title = scene.seen.say_text(title_text);
    let window = box_window(title, "timeline tiers").fixed_size(vec2(320.0, 300.0));
    window.show(ui.ctx(), |ui| {
        let field = script_edit::draw_text_line(ui, &mut choose.text, |field| {
            field
                .id(Id::unique("timeline tiers field"))
                .hint_text(scene.seen.say_text(words::FILTER_TIERS))
                .desired_width(f32::INFINITY)
        });
        let response = field.response.response;
        let label = scene.seen.say_text(words::FILTER_TIERS);
        response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, label));
        response.request_focus();
        if response.changed() {
            (choose.chosen, choose.why) = (0, None);
        }
        if let Some(why) = choose.why {
            ui.colored_label(scene.seen.pane_colours().trouble, scene.seen.say_text(why));
        }
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            for (at, tier) in tiers.iter().enumerate() {
                let button =
                    Button::selectable(at == choose.chosen, &tier.row.name).min_size(vec2(ui.available_width(), 0.0));
                let response = ui.add(button);
                if at == choose.chosen && (up || down) {
                    response.scroll_to_me(None);
                }
                if response.clicked() {
                    done = Some(tier.row.id);
                }
            }
        });
        if ui.button(scene.seen.say_text(crate::words::shell::CANCEL)).clicked() {
            choose.chosen = usize::MAX;
        }
    });
    if let Some(tier) = done {
        match put_selection_on_tier(timeline, scene, tier, choose.moving) {
            None => return,
            Some(why) => choose.why = Some(why),
        }
    }
    if !escape && choose.chosen != usize::MAX {
        timeline.boxes.choose = Some(choose);
    }
}

/// Copies or moves the selection to a tier; returns the reason if it cannot be done.
pub(super) fn put_selection_on_tier(
    timeline: &mut TimelinePane,
    scene: &TimelineScene<'_>,
    to: i64,
    moving: bool,
) -> Option<InterfaceText> {
    let chosen = &scene.seen.shown.annotations;
    let tiers = scene.contents.tiers.iter();
    let items: Vec<SpanItem> = tiers
        .flat_map(|tier| dragged::timed_annotation_items(tier, None))
        .filter(|item| chosen.contains(&item.id))
        .collect();
    let tier = scene.tier_of(to)?;
    if moving && requests::has_below(scene.contents, chosen) {
        return Some(words::HAS_BELOW);
    }
    if let Some(why) = tier_misfit_reason(scene, tier, &items) {
        return Some(why);
    }
    let asked = requests::to_tier(scene.contents, &items, to, moving);
    let ghosts = items.iter().map(|item| super::GhostAnnotation {
        id: None,
        ..super::GhostAnnotation::ghost_from_item(to, item)
    });
    let then = ChangeFollowUp {
        select: items.len() == 1,
        ghosts: ghosts.collect(),
        ..ChangeFollowUp::default()
    };
    timeline.request_annotation_changes(asked, then, scene.seen.out);
    None
}

/// Returns the reason if annotations with these times cannot be put on a tier.
pub(super) fn tier_misfit_reason(
    scene: &TimelineScene<'_>,
    tier: &TierContents,
    items: &[SpanItem],
) -> Option<InterfaceText> {
    if holds_proposals(tier) {
        return Some(words::HOLDS_PROPOSALS);
    }
    // Annotations in lists take any time of their parent.
    let listed = TierTiming::timing_of_tier(&tier.row) == TierTiming::Listed;
    let fits = |item: &SpanItem| {
        let room = dragged::room_for_annotation(scene.contents, tier, (item.start, item.end));
        room.is_some_and(|room| listed || room == (item.start, item.end))
    };
    (!items.iter().all(fits)).then(|| no_room(tier))
}
