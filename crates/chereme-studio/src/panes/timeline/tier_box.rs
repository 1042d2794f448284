//! The box that describes a tier, and adds, changes or removes it.

use chereme_corpus::{
    Contents, Copied, Hands, Name, NewTier, Stereotype, TierChange, TierContents, TierName,
    TierRole,
};
use chereme_sign::Field;
use eframe::egui::{
    Align2, ComboBox, Grid, Id, Key, Modifiers, Popup, Role, Ui, WidgetInfo, Window, vec2,
};

use super::Timeline;
use super::edit::Scene;
use crate::context::{Outbox, PaneInput};
use crate::panes::combo;
use crate::panes::search::field_text;
use crate::script::edit;
use crate::words::{Text, fill, shell, timeline as words};
use crate::work::{Job, editing};

/// The id of the name field.
const NAME_FIELD: &str = "timeline tier name";

/// The purpose of the box.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum What {
    Add,
    Change(i64),
    Remove(i64),
    Copy(i64),
}

/// The description of a tier in the box.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TierBox {
    what: What,
    name: String,
    /// The role as queries spell it.
    role: String,
    hand: Option<Hands>,
    /// The parent tier, and the relation to it.
    parent: Option<(String, Stereotype)>,
    fresh: bool,
    /// The last proposed name.
    proposed: String,
    /// The parts of a tier that a copy includes.
    copied: Copied,
}

/// The button pressed in the box.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Pressed {
    Nothing,
    Done,
    Cancel,
}

impl TierBox {
    /// Returns a box that adds a tier similar to the selected one.
    pub(super) fn add(scene: &Scene<'_>) -> Self {
        let like = scene
            .tier()
            .map(|tier| Self::of(scene.contents, tier, What::Add));
        let blank = Self {
            what: What::Add,
            name: String::new(),
            role: "gloss".to_owned(),
            hand: None,
            parent: None,
            fresh: true,
            proposed: String::new(),
            copied: Copied::All,
        };
        match like {
            Some(like) => Self {
                parent: like.parent,
                role: "free".to_owned(),
                ..blank
            },
            None => blank,
        }
    }

    /// Returns a box with the present description of a tier.
    pub(super) fn of(contents: &Contents, tier: &TierContents, what: What) -> Self {
        let row = &tier.row;
        let above = contents
            .tiers
            .iter()
            .find(|it| Some(it.row.id) == row.parent_id);
        Self {
            what,
            name: row.name.clone(),
            role: row.role.name(),
            hand: row.hand,
            parent: above.map(|it| it.row.name.clone()).zip(row.stereotype),
            fresh: true,
            proposed: String::new(),
            copied: Copied::All,
        }
    }

    /// Proposes parent and name for the role: a component belongs below the selected glosses, and has their hand.
    fn fit(&mut self, scene: &Scene<'_>) {
        let gloss = scene.tier().filter(|it| it.row.role == TierRole::Gloss);
        let component = !TierRole::PLAIN.iter().any(|role| role.kind() == self.role);
        if let Some(gloss) = gloss.filter(|_| component) {
            let below = (gloss.row.name.clone(), Stereotype::IncludedIn);
            self.parent.get_or_insert(below);
            if !self.role.starts_with("nonmanual") {
                self.hand = self.hand.or(gloss.row.hand);
            }
        }
        if !self.name.trim().is_empty() && self.name != self.proposed {
            return;
        }
        let names = roles(scene.seen);
        let role = names.iter().find(|(id, _)| *id == self.role);
        let role = role.map_or(self.role.as_str(), |(_, name)| name);
        let hand = HANDS.iter().find(|(id, _)| Hands::of(id) == self.hand);
        let hand = hand.filter(|_| component && self.hand.is_some());
        let name = match hand {
            Some((_, hand)) => format!("{role} · {}", scene.seen.say(*hand)),
            None => role.to_owned(),
        };
        let taken = |name: &str| scene.contents.tiers.iter().any(|it| it.row.name == name);
        let free = (2..100).map(|n| format!("{name} {n}"));
        let mut all = std::iter::once(name.clone()).chain(free);
        self.proposed = all.find(|it| !taken(it)).unwrap_or(name.clone());
        self.name.clone_from(&self.proposed);
    }

    /// Returns a box that copies a tier under another name.
    pub(super) fn copy(scene: &Scene<'_>, tier: &TierContents) -> Self {
        let name = scene.seen.say(words::COPY_TIER_NAME);
        Self {
            name: fill(name, &[("name", &tier.row.name)]),
            ..Self::of(scene.contents, tier, What::Copy(tier.row.id))
        }
    }

    /// Returns the name of the tier to add, if the box adds one.
    pub(super) fn added(self) -> Option<String> {
        let adds = matches!(self.what, What::Add | What::Copy(_));
        adds.then(|| self.name.trim().to_owned())
    }

    /// Returns the job to request; `None` if the role cannot be read.
    fn job(&self, recording: i64, before: Option<&Self>) -> Option<Job> {
        if let What::Copy(id) = self.what {
            let name = self.name.trim().to_owned();
            let copied = self.copied.clone();
            return Some(editing::copy_tier(TierName::Number(id), name, copied));
        }
        let role: TierRole = self.role.parse().ok()?;
        Some(match &self.what {
            What::Add => {
                let mut tier = NewTier::new(Name::Number(recording), self.name.trim(), role);
                tier.hand = self.hand;
                tier.parent.clone_from(&self.parent);
                editing::add_tier(tier)
            }
            What::Change(id) => {
                editing::change_tier(TierName::Number(*id), self.change(before?, role))
            }
            What::Remove(id) | What::Copy(id) => editing::remove_tier(TierName::Number(*id)),
        })
    }

    /// Returns the changes of the fields that differ from those of `before`.
    fn change(&self, before: &Self, role: TierRole) -> TierChange {
        TierChange {
            name: (self.name != before.name).then(|| self.name.clone()),
            role: (self.role != before.role).then_some(role),
            hand: (self.hand != before.hand).then_some(self.hand),
            values: (self.role != before.role).then(Default::default),
            parent: (self.parent != before.parent).then(|| self.parent.clone()),
            ..TierChange::default()
        }
    }
}

/// Returns the name of a role such as `right.configuration`.
pub(crate) fn role_text(role: &str, seen: &PaneInput<'_>) -> String {
    let (hand, rest) = match role.split_once('.') {
        Some((hand, rest)) => (HANDS.iter().find(|(id, _)| *id == hand), rest),
        None => (None, role),
    };
    let rest = if hand.is_some() { rest } else { role };
    let plain = TierRole::PLAIN.iter().find(|role| role.kind() == rest);
    let what = match (plain, rest.parse::<Field>()) {
        (Some(role), _) => seen.say(role.words().name).to_owned(),
        (None, Ok(field)) => field_text(&field, seen),
        _ => return role.to_owned(),
    };
    match hand {
        Some((_, hand)) => format!("{what} · {}", seen.say(*hand)),
        None => what,
    }
}

/// Returns the possible roles of a tier: those without components, then those with inventories.
fn roles(seen: &PaneInput<'_>) -> Vec<(String, String)> {
    let mut all: Vec<(String, String)> = TierRole::PLAIN
        .iter()
        .map(|role| {
            (
                role.kind().to_owned(),
                seen.say(role.words().name).to_owned(),
            )
        })
        .collect();
    for stored in &seen.snapshot.overview.inventories {
        let field = stored.inventory.field();
        let id = field.to_string();
        if all.iter().all(|(it, _)| *it != id) {
            all.push((id, field_text(&field, seen)));
        }
    }
    all
}

/// Returns the name of a relation between tiers, with ELAN's name for it.
pub(crate) fn how_text(how: Stereotype, seen: &PaneInput<'_>) -> String {
    let text = match how {
        Stereotype::TimeSubdivision => words::HOW_FILLED,
        Stereotype::IncludedIn => words::HOW_WITHIN,
        Stereotype::SymbolicSubdivision => words::HOW_LISTED,
        Stereotype::SymbolicAssociation => words::HOW_ONE,
    };
    let elan = how.elan_name().replace('_', " ");
    format!("{} ({elan})", seen.say(text))
}

/// Returns the names of the possible parents of a tier: not itself, nor its descendants.
fn parents(contents: &Contents, what: &What) -> Vec<String> {
    let own = match what {
        What::Change(id) => Some(*id),
        _ => None,
    };
    let is_below = |tier: &TierContents| {
        let mut at = Some(tier.row.id);
        for _ in 0..=contents.tiers.len() {
            if at.is_none() || at == own {
                break;
            }
            let above = contents.tiers.iter().find(|it| Some(it.row.id) == at);
            at = above.and_then(|it| it.row.parent_id);
        }
        own.is_some() && at == own
    };
    let fit = contents.tiers.iter().filter(|tier| !is_below(tier));
    fit.map(|tier| tier.row.name.clone()).collect()
}

/// Shows the box while it is open, and carries out its buttons.
pub(super) fn show(timeline: &mut Timeline, ui: &mut Ui, scene: &Scene<'_>, out: &mut Outbox) {
    let Some(mut tier) = timeline.boxes.tier_box.take() else {
        return;
    };
    let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    // An open list has these keys first; Enter belongs to the list or button with the focus.
    let open = Popup::is_any_open(ui.ctx());
    let focused = ui.memory(|memory| memory.focused());
    let own = focused.is_none_or(|it| it == Id::unique(NAME_FIELD));
    let enter = !open && own && pressed(Key::Enter);
    let escape = !open && pressed(Key::Escape);
    let say = |text| scene.seen.say(text);
    let title = match tier.what {
        What::Add => words::ADD_TITLE,
        What::Change(_) => words::CHANGE_TITLE,
        What::Remove(_) => words::REMOVE_TITLE,
        What::Copy(_) => words::COPY_TIER_TITLE,
    };
    let mut done = Pressed::Nothing;
    Window::new(say(title))
        .id(Id::unique("timeline tier"))
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, vec2(0.0, 0.0))
        .show(ui.ctx(), |ui| {
            match tier.what {
                What::Remove(id) => about(ui, scene, id, &tier.name),
                What::Copy(_) => copy_form(ui, scene.seen, &mut tier),
                _ => form(ui, scene, &mut tier),
            }
            ui.add_space(8.0);
            done = buttons(ui, scene.seen, &tier);
        });
    if escape || done == Pressed::Cancel {
        return;
    }
    let ready = matches!(tier.what, What::Remove(_)) || !tier.name.trim().is_empty();
    if !ready || !(enter || done == Pressed::Done) {
        timeline.boxes.tier_box = Some(tier);
        return;
    }
    let before = match tier.what {
        What::Change(id) => scene
            .tier_of(id)
            .map(|it| TierBox::of(scene.contents, it, What::Change(id))),
        _ => None,
    };
    if let Some(job) = tier.job(scene.contents.recording.id, before.as_ref()) {
        let id = out.work(job);
        timeline.boxes.tier_asked = Some((id, tier));
    }
}

/// Reports which tiers and annotations would be removed with a tier.
fn about(ui: &mut Ui, scene: &Scene<'_>, id: i64, name: &str) {
    let mut family = vec![id];
    let mut at = 0;
    while let Some(above) = family.get(at).copied() {
        let tiers = scene.contents.tiers.iter().map(|it| &it.row);
        let below = tiers.filter(|row| row.parent_id == Some(above) && row.id != id);
        family.extend(below.map(|row| row.id));
        at += 1;
    }
    let counts = family.iter().filter_map(|id| scene.tier_of(*id));
    let annotations: usize = counts.map(|it| it.annotations.len()).sum();
    let text = fill(
        scene.seen.say(words::REMOVE_ABOUT),
        &[
            ("name", &name),
            ("tiers", &(family.len() - 1)),
            ("n", &annotations),
        ],
    );
    ui.set_max_width(340.0);
    ui.label(text);
}

fn form(ui: &mut Ui, scene: &Scene<'_>, tier: &mut TierBox) {
    let seen = scene.seen;
    Grid::new("tier form")
        .num_columns(2)
        .spacing([12.0, 8.0])
        .show(ui, |ui| {
            name_field(ui, seen, tier);
            let roles = roles(seen);
            let now = roles.iter().find(|(id, _)| *id == tier.role);
            let now = now.map_or(tier.role.clone(), |(_, name)| name.clone());
            let mut chosen = false;
            choice(ui, seen.say(words::TIER_ROLE), &now, &roles, |role| {
                tier.role.clone_from(role);
                chosen = true;
            });
            if chosen && tier.what == What::Add {
                tier.fit(scene);
            }
            let mut hands = vec![(None, seen.say(words::HAND_NONE).to_owned())];
            for (hand, text) in HANDS {
                hands.push((Hands::of(hand), seen.say(text).to_owned()));
            }
            let now = hands.iter().find(|(hand, _)| *hand == tier.hand);
            let now = now.map_or(String::new(), |(_, name)| name.clone());
            choice(ui, seen.say(words::TIER_HAND), &now, &hands, |hand| {
                tier.hand = *hand
            });
            let mut above = vec![(None, seen.say(words::PARENT_NONE).to_owned())];
            let names = parents(scene.contents, &tier.what);
            above.extend(names.into_iter().map(|name| (Some(name.clone()), name)));
            let now = tier
                .parent
                .as_ref()
                .map_or(seen.say(words::PARENT_NONE), |(name, _)| name)
                .to_owned();
            let how = tier
                .parent
                .as_ref()
                .map_or(Stereotype::IncludedIn, |(_, how)| *how);
            choice(ui, seen.say(words::TIER_PARENT), &now, &above, |name| {
                tier.parent = name.clone().map(|name| (name, how));
            });
            if let Some((_, how)) = &mut tier.parent {
                let all = Stereotype::ALL.map(|it| (it, how_text(it, seen)));
                let now = how_text(*how, seen);
                choice(ui, seen.say(words::TIER_HOW), &now, &all, |it| *how = *it);
            }
        });
}

fn name_field(ui: &mut Ui, seen: &PaneInput<'_>, tier: &mut TierBox) {
    ui.label(seen.say(words::TIER_NAME));
    let field = edit::line(ui, &mut tier.name, |field| {
        field.desired_width(220.0).id(Id::unique(NAME_FIELD))
    });
    let response = field.response.response;
    response.widget_info(|| {
        let mut info = WidgetInfo::labeled(Role::TextInput, true, seen.say(words::TIER_NAME));
        info.current_text_value = Some(tier.name.clone());
        info
    });
    if std::mem::take(&mut tier.fresh) {
        response.request_focus();
    }
    ui.end_row();
}

fn copy_form(ui: &mut Ui, seen: &PaneInput<'_>, tier: &mut TierBox) {
    let text = match &tier.copied {
        Copied::Holding(text) => text.clone(),
        _ => String::new(),
    };
    let all = [
        (Copied::All, words::COPIED_ALL),
        (Copied::Times, words::COPIED_TIMES),
        (Copied::Nothing, words::COPIED_NOTHING),
        (Copied::Holding(text), words::COPIED_HOLDING),
    ];
    let all = all.map(|(it, text)| (it, seen.say(text).to_owned()));
    let now = all.iter().find(|(it, _)| *it == tier.copied);
    let now = now.map_or(String::new(), |(_, text)| text.clone());
    Grid::new("tier copy form")
        .num_columns(2)
        .spacing([12.0, 8.0])
        .show(ui, |ui| {
            name_field(ui, seen, tier);
            choice(ui, seen.say(words::COPIED_WHAT), &now, &all, |it| {
                tier.copied = it.clone();
            });
            if let Copied::Holding(text) = &mut tier.copied {
                let label = ui.label(seen.say(words::COPIED_TEXT));
                let field = edit::line(ui, text, |field| field.desired_width(220.0));
                field.response.response.labelled_by(label.id);
                ui.end_row();
            }
        });
}

const HANDS: [(&str, Text); 5] = [
    ("right", words::HAND_RIGHT),
    ("left", words::HAND_LEFT),
    ("dominant", words::HAND_DOMINANT),
    ("weak", words::HAND_WEAK),
    ("both", words::HAND_BOTH),
];

/// Shows a drop-down list.
fn choice<T>(ui: &mut Ui, name: &str, now: &str, all: &[(T, String)], mut choose: impl FnMut(&T)) {
    let label = ui.label(name);
    let combo = ComboBox::from_id_salt(name)
        .selected_text(now)
        .width(220.0)
        .show_ui(ui, |ui| {
            for (it, text) in all {
                if ui.selectable_label(text == now, text).clicked() {
                    choose(it);
                }
            }
        });
    let names: Vec<&str> = all.iter().map(|(_, name)| name.as_str()).collect();
    let at = names.iter().position(|name| *name == now);
    if let Some((it, _)) = combo::step(ui, &combo, &names, at).and_then(|at| all.get(at)) {
        choose(it);
    }
    combo.response.labelled_by(label.id);
    ui.end_row();
}

fn buttons(ui: &mut Ui, seen: &PaneInput<'_>, tier: &TierBox) -> Pressed {
    let text = match tier.what {
        What::Add => words::ADD,
        What::Change(_) => words::CHANGE,
        What::Remove(_) => words::REMOVE,
        What::Copy(_) => words::COPY,
    };
    let mut pressed = Pressed::Nothing;
    ui.horizontal(|ui| {
        let ready = !tier.name.trim().is_empty();
        if ui
            .add_enabled(ready, eframe::egui::Button::new(seen.say(text)))
            .clicked()
        {
            pressed = Pressed::Done;
        }
        if ui.button(seen.say(shell::CANCEL)).clicked() {
            pressed = Pressed::Cancel;
        }
    });
    pressed
}

#[cfg(test)]
mod tests {
    use super::super::dragged::tests::contents;
    use super::*;

    #[test]
    fn only_changed_fields_of_a_tier_are_requested() {
        let all = contents(&[(1, None, "", &[]), (2, Some(1), "Included_In", &[])]);
        let before = TierBox::of(&all, &all.tiers[1], What::Change(2));
        assert_eq!(
            before.parent,
            Some(("tier 1".into(), Stereotype::IncludedIn))
        );
        let after = TierBox {
            name: "new".into(),
            parent: None,
            ..before.clone()
        };
        let role = after.role.parse().expect("a role");
        let want = TierChange {
            name: Some("new".into()),
            parent: Some(None),
            ..TierChange::default()
        };
        assert_eq!(after.change(&before, role), want);
    }

    #[test]
    fn a_tier_cannot_be_its_own_parent() {
        let all = contents(&[
            (1, None, "", &[]),
            (2, Some(1), "Included_In", &[]),
            (3, Some(2), "Included_In", &[]),
            (4, None, "", &[]),
        ]);
        assert_eq!(parents(&all, &What::Change(2)), ["tier 1", "tier 4"]);
        assert_eq!(parents(&all, &What::Add).len(), 4);
    }
}
