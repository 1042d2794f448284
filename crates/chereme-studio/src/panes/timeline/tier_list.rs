//! The list to choose the tier that annotations are copied or moved to.

use chereme_corpus::{TierContents, requests};
use chereme_sign::text::fold;
use eframe::egui::{
    Align2, Button, Id, Key, Modifiers, Role, ScrollArea, Ui, WidgetInfo, Window, vec2,
};

use super::dragged::{self, TierTiming};
use super::edit::{Scene, holds_proposals, no_room};
use super::spans::Item;
use super::{Then, Timeline};
use crate::context::Outbox;
use crate::script::edit;
use crate::words::{Text, timeline as words};

/// The list while it is open.
#[derive(Debug)]
pub(super) struct Choose {
    /// Whether the annotations are moved rather than copied.
    moving: bool,
    text: String,
    chosen: usize,
    why: Option<Text>,
}

impl Choose {
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
fn fitting<'a>(scene: &Scene<'a>, text: &str) -> Vec<&'a TierContents> {
    let chosen = &scene.seen.shown.annotations;
    let wanted = fold(text.trim());
    let fits = |tier: &&TierContents| {
        fold(&tier.row.name).contains(&wanted)
            && !holds_proposals(tier)
            && dragged::places(tier, chosen).next().is_none()
    };
    scene.contents.tiers.iter().filter(fits).collect()
}

/// Shows the list, and copies or moves the selection to the chosen tier.
pub(super) fn show(timeline: &mut Timeline, ui: &mut Ui, scene: &Scene<'_>, out: &mut Outbox) {
    let Some(mut choose) = timeline.boxes.choose.take() else {
        return;
    };
    let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    let (up, down) = (pressed(Key::ArrowUp), pressed(Key::ArrowDown));
    let (enter, escape) = (pressed(Key::Enter), pressed(Key::Escape));
    let tiers = fitting(scene, &choose.text);
    choose.chosen = match (up, down) {
        (true, _) => choose.chosen.saturating_sub(1),
        (_, true) => choose.chosen + 1,
        _ => choose.chosen,
    }
    .min(tiers.len().saturating_sub(1));
    let mut done = tiers
        .get(choose.chosen)
        .filter(|_| enter)
        .map(|it| it.row.id);
    let title = if choose.moving {
        words::MOVE_TITLE
    } else {
        words::COPY_TITLE
    };
    let title = scene.seen.say(title);
    let window = Window::new(title)
        .id(Id::unique("timeline tiers"))
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, vec2(0.0, 0.0))
        .fixed_size(vec2(320.0, 300.0));
    window.show(ui.ctx(), |ui| {
        let field = edit::line(ui, &mut choose.text, |field| {
            field
                .id(Id::unique("timeline tiers field"))
                .hint_text(scene.seen.say(words::FILTER_TIERS))
                .desired_width(f32::INFINITY)
        });
        let response = field.response.response;
        let label = scene.seen.say(words::FILTER_TIERS);
        response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, label));
        response.request_focus();
        if response.changed() {
            (choose.chosen, choose.why) = (0, None);
        }
        if let Some(why) = choose.why {
            ui.colored_label(scene.seen.colours().trouble, scene.seen.say(why));
        }
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            for (at, tier) in tiers.iter().enumerate() {
                let button = Button::selectable(at == choose.chosen, &tier.row.name)
                    .min_size(vec2(ui.available_width(), 0.0));
                let response = ui.add(button);
                if at == choose.chosen && (up || down) {
                    response.scroll_to_me(None);
                }
                if response.clicked() {
                    done = Some(tier.row.id);
                }
            }
        });
        if ui
            .button(scene.seen.say(crate::words::shell::CANCEL))
            .clicked()
        {
            choose.chosen = usize::MAX;
        }
    });
    if let Some(tier) = done {
        match put(timeline, scene, tier, choose.moving, out) {
            None => return,
            Some(why) => choose.why = Some(why),
        }
    }
    if !escape && choose.chosen != usize::MAX {
        timeline.boxes.choose = Some(choose);
    }
}

/// Copies or moves the selection to a tier; returns the reason if it cannot be done.
pub(super) fn put(
    timeline: &mut Timeline,
    scene: &Scene<'_>,
    to: i64,
    moving: bool,
    out: &mut Outbox,
) -> Option<Text> {
    let chosen = &scene.seen.shown.annotations;
    let tiers = scene.contents.tiers.iter();
    let items: Vec<Item> = tiers
        .flat_map(|tier| dragged::items(tier, None))
        .filter(|item| chosen.contains(&item.id))
        .collect();
    let tier = scene.tier_of(to)?;
    if moving && requests::has_below(scene.contents, chosen) {
        return Some(words::HAS_BELOW);
    }
    if let Some(why) = unfit(scene, tier, &items) {
        return Some(why);
    }
    let asked = requests::to_tier(scene.contents, &items, to, moving);
    let ghosts = items.iter().map(|item| super::Ghost {
        id: None,
        ..super::Ghost::of(to, item)
    });
    let then = Then {
        select: items.len() == 1,
        ghosts: ghosts.collect(),
        ..Then::default()
    };
    timeline.change(asked, then, out);
    None
}

/// Returns the reason if annotations with these times cannot be put on a tier.
pub(super) fn unfit(scene: &Scene<'_>, tier: &TierContents, items: &[Item]) -> Option<Text> {
    if holds_proposals(tier) {
        return Some(words::HOLDS_PROPOSALS);
    }
    let listed = TierTiming::of(&tier.row) == TierTiming::Listed;
    let fits = |item: &Item| {
        let room = dragged::room(scene.contents, tier, (item.start, item.end));
        room.is_some_and(|room| listed || room == (item.start, item.end))
    };
    (!items.iter().all(fits)).then(|| no_room(tier))
}
