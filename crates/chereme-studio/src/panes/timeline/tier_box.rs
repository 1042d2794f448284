//! The box that describes a tier, and adds, changes or removes it.

use chereme_corpus::{
    AnnotatedHands, CopiedAnnotations, NewTier, RecordingContents, RowName, TierContents, TierPropertyChange,
    TierRequestName, TierRole, TierStereotype,
};
use chereme_sign::ComponentField;
use eframe::egui::{ComboBox, Grid, Id, Key, Modifiers, Popup, Role, Ui, WidgetInfo};

use super::TimelinePane;
use super::timeline_edit::TimelineScene;
use super::timeline_parts::box_window;
use crate::context::PaneInput;
use crate::panes::combo;
use crate::panes::search::field_text;
use crate::script::script_edit;
use crate::words::{InterfaceText, fill_text_braces, shell, timeline as words};
use crate::work::{CorpusJob, editing};

/// The id of the name field.
const NAME_FIELD: &str = "timeline tier name";

/// The purpose of the box.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum TierBoxPurpose {
    Add,
    Change(i64),
    Remove(i64),
    Copy(i64),
}

/// The description of a tier in the box.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TierBox {
    what: TierBoxPurpose,
    name: String,
    /// The role as queries spell it.
    role: String,
    hand: Option<AnnotatedHands>,
    /// The parent tier, and the relation to it.
    parent: Option<(String, TierStereotype)>,
    fresh: bool,
    /// The last proposed name.
    proposed: String,
    /// The parts of a tier that a copy includes.
    copied: CopiedAnnotations,
}

/// The button pressed in the box.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum TierBoxButton {
    Nothing,
    Done,
    Cancel,
}

impl TierBox {
    /// Returns a box that adds a tier similar to the selected one.
    pub(super) fn box_for_new_tier(scene: &TimelineScene<'_>) -> Self {
        let like = scene
            .edited_tier()
            .map(|tier| Self::box_for_tier(scene.contents, tier, TierBoxPurpose::Add));
        let blank = Self {
            what: TierBoxPurpose::Add,
            name: String::new(),
            role: "gloss".to_owned(),
            hand: None,
            parent: None,
            fresh: true,
            proposed: String::new(),
            copied: CopiedAnnotations::All,
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
    pub(super) fn box_for_tier(contents: &RecordingContents, tier: &TierContents, what: TierBoxPurpose) -> Self {
        let row = &tier.row;
        let above = contents
            .tiers
            .iter()
            .find(|other_tier| Some(other_tier.row.id) == row.parent_id);
        Self {
            what,
            name: row.name.clone(),
            role: row.role.role_name(),
            hand: row.hand,
            parent: above
                .map(|parent_tier| parent_tier.row.name.clone())
                .zip(row.stereotype),
            fresh: true,
            proposed: String::new(),
            copied: CopiedAnnotations::All,
        }
    }

    /// Proposes parent and name for the role: a component belongs below the selected glosses, and has their hand.
    fn fit_role_defaults(&mut self, scene: &TimelineScene<'_>) {
        let gloss = scene.edited_tier().filter(|tier| tier.row.role == TierRole::Gloss);
        let component = !TierRole::PLAIN_TIER_ROLES
            .iter()
            .any(|role| role.role_kind_name() == self.role);
        if let Some(gloss) = gloss.filter(|_| component) {
            let below = (gloss.row.name.clone(), TierStereotype::IncludedIn);
            self.parent.get_or_insert(below);
            if !self.role.starts_with("nonmanual") {
                self.hand = self.hand.or(gloss.row.hand);
            }
        }
        // A name that the user typed is not overwritten.
        if !self.name.trim().is_empty() && self.name != self.proposed {
            return;
        }
        let names = possible_tier_roles(scene.seen);
        let role_entry = names.iter().find(|(id, _)| *id == self.role);
        let role = role_entry.map_or(self.role.as_str(), |(_, name)| name);
        let hand_entry = TIER_HAND_WORDS
            .iter()
            .find(|(id, _)| AnnotatedHands::from_hand_name(id) == self.hand);
        let hand = hand_entry.filter(|_| component && self.hand.is_some());
        let name = match hand {
            Some((_, hand)) => format!("{role} · {}", scene.seen.say_text(*hand)),
            None => role.to_owned(),
        };
        let taken = |name: &str| scene.contents.tiers.iter().any(|tier| tier.row.name == name);
        // Tiers need different names; the first free number is taken.
        let free = (2..100).map(|n| format!("{name} {n}"));
        let mut all = std::iter::once(name.clone()).chain(free);
        self.proposed = all.find(|candidate| !taken(candidate)).unwrap_or(name.clone());
        self.name.clone_from(&self.proposed);
    }

    /// Returns a box that copies a tier under another name.
    pub(super) fn box_for_tier_copy(scene: &TimelineScene<'_>, tier: &TierContents) -> Self {
        let name = scene.seen.say_text(words::COPY_TIER_NAME);
        Self {
            name: fill_text_braces(name, &[("name", &tier.row.name)]),
            ..Self::box_for_tier(scene.contents, tier, TierBoxPurpose::Copy(tier.row.id))
        }
    }

    /// Returns the name of the tier to add, if the box adds one.
    pub(super) fn added_tier_name(self) -> Option<String> {
        let adds = matches!(self.what, TierBoxPurpose::Add | TierBoxPurpose::Copy(_));
        adds.then(|| self.name.trim().to_owned())
    }

    /// Returns the job to request; `None` if the role cannot be read.
    fn job(&self, recording: i64, before: Option<&Self>) -> Option<CorpusJob> {
        if let TierBoxPurpose::Copy(id) = self.what {
            let name = self.name.trim().to_owned();
            let copied = self.copied.clone();
            return Some(editing::copy_tier(TierRequestName::Number(id), name, copied));
        }
        let role: TierRole = self.role.parse().ok()?;
        Some(match &self.what {
            TierBoxPurpose::Add => {
                let mut tier = NewTier::new(RowName::Number(recording), self.name.trim(), role);
                tier.hand = self.hand;
                tier.parent.clone_from(&self.parent);
                editing::add_tier(tier)
            }
            TierBoxPurpose::Change(id) => {
                editing::change_tier_job(TierRequestName::Number(*id), self.tier_changes_since(before?, role))
            }
            TierBoxPurpose::Remove(id) | TierBoxPurpose::Copy(id) => editing::remove_tier(TierRequestName::Number(*id)),
        })
    }

    /// Returns the changes of the fields that differ from those of `before`.
    fn tier_changes_since(&self, before: &Self, role: TierRole) -> TierPropertyChange {
        TierPropertyChange {
            name: (self.name != before.name).then(|| self.name.clone()),
            role: (self.role != before.role).then_some(role),
            hand: (self.hand != before.hand).then_some(self.hand),
            // Values of another role are those of another inventory.
            values: (self.role != before.role).then(Default::default),
            parent: (self.parent != before.parent).then(|| self.parent.clone()),
            ..TierPropertyChange::default()
        }
    }
}

/// Returns the name of a role such as `right.configuration`.
pub(crate) fn role_text(role: &str, seen: &PaneInput<'_>) -> String {
    let (hand, rest) = match role.split_once('.') {
        Some((hand, rest)) => (TIER_HAND_WORDS.iter().find(|(id, _)| *id == hand), rest),
        None => (None, role),
    };
    let rest = if hand.is_some() { rest } else { role };
    let plain = TierRole::PLAIN_TIER_ROLES
        .iter()
        .find(|role| role.role_kind_name() == rest);
    let what = match (plain, rest.parse::<ComponentField>()) {
        (Some(role), _) => seen.say_text(role.role_words().name).to_owned(),
        (None, Ok(field)) => field_text(&field, seen),
        _ => return role.to_owned(),
    };
    match hand {
        Some((_, hand)) => format!("{what} · {}", seen.say_text(*hand)),
        None => what,
    }
}

/// Returns the hands that a tier can describe, with no hand first.
pub(crate) fn tier_hand_choices(seen: &PaneInput<'_>) -> Vec<(Option<AnnotatedHands>, String)> {
    let hands = TIER_HAND_WORDS.map(|(hand, text)| (AnnotatedHands::from_hand_name(hand), text));
    let all = std::iter::once((None, words::HAND_NONE)).chain(hands);
    all.map(|(hand, text)| (hand, seen.say_text(text).to_owned())).collect()
}

/// Returns the possible roles of a tier: those without components, then those with inventories.
pub(crate) fn possible_tier_roles(seen: &PaneInput<'_>) -> Vec<(String, String)> {
    let mut all: Vec<(String, String)> = TierRole::PLAIN_TIER_ROLES
        .iter()
        .map(|role| {
            (
                role.role_kind_name().to_owned(),
                seen.say_text(role.role_words().name).to_owned(),
            )
        })
        .collect();
    for stored in &seen.snapshot.overview.inventories {
        let field = stored.inventory.inventory_field();
        let id = field.to_string();
        if all.iter().all(|(other_id, _)| *other_id != id) {
            all.push((id, field_text(&field, seen)));
        }
    }
    all
}

/// Returns the name of a relation between tiers, with ELAN's name for it.
pub(crate) fn how_text(how: TierStereotype, seen: &PaneInput<'_>) -> String {
    let text = match how {
        TierStereotype::TimeSubdivision => words::HOW_FILLED,
        TierStereotype::IncludedIn => words::HOW_WITHIN,
        TierStereotype::SymbolicSubdivision => words::HOW_LISTED,
        TierStereotype::SymbolicAssociation => words::HOW_ONE,
    };
    let elan = how.elan_name().replace('_', " ");
    format!("{} ({elan})", seen.say_text(text))
}

/// Returns the names of the possible parents of a tier: not itself, nor its descendants.
fn parents(contents: &RecordingContents, what: &TierBoxPurpose) -> Vec<String> {
    let changed_id = match what {
        TierBoxPurpose::Change(id) => Some(*id),
        _ => None,
    };
    let is_below = |tier: &TierContents| {
        // As many steps as there are tiers, since a broken file may have a ring of parents.
        let mut ancestor_id = Some(tier.row.id);
        for _ in 0..=contents.tiers.len() {
            if ancestor_id.is_none() || ancestor_id == changed_id {
                break;
            }
            let above = contents
                .tiers
                .iter()
                .find(|other_tier| Some(other_tier.row.id) == ancestor_id);
            ancestor_id = above.and_then(|parent_tier| parent_tier.row.parent_id);
        }
        changed_id.is_some() && ancestor_id == changed_id
    };
    let fit = contents.tiers.iter().filter(|tier| !is_below(tier));
    fit.map(|tier| tier.row.name.clone()).collect()
}

/// Shows the box while it is open, and carries out its buttons.
pub(super) fn show_tier_box(timeline: &mut TimelinePane, ui: &mut Ui, scene: &TimelineScene<'_>) {
    let Some(mut tier) = timeline.boxes.tier_box.take() else {
        return;
    };
    let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    // An open list has these keys first; Enter belongs to the list or button with the focus.
    let open = Popup::is_any_open(ui.ctx());
    let focused = ui.memory(|memory| memory.focused());
    let is_name_focused = focused.is_none_or(|widget| widget == Id::unique(NAME_FIELD));
    let enter = !open && is_name_focused && pressed(Key::Enter);
    let escape = !open && pressed(Key::Escape);
    let say = |text| scene.seen.say_text(text);
    let title = match tier.what {
        TierBoxPurpose::Add => words::ADD_TITLE,
        TierBoxPurpose::Change(_) => words::CHANGE_TITLE,
        TierBoxPurpose::Remove(_) => words::REMOVE_TITLE,
        TierBoxPurpose::Copy(_) => words::COPY_TIER_TITLE,
    };
    let mut done = TierBoxButton::Nothing;
    box_window(say(title), "timeline tier").show(ui.ctx(), |ui| {
        match tier.what {
            TierBoxPurpose::Remove(id) => report_removed_tiers(ui, scene, id, &tier.name),
            TierBoxPurpose::Copy(_) => copy_form(ui, scene.seen, &mut tier),
            _ => show_tier_form(ui, scene, &mut tier),
        }
        ui.add_space(8.0);
        done = show_tier_box_buttons(ui, scene.seen, &tier);
    });
    if escape || done == TierBoxButton::Cancel {
        return;
    }
    let ready = matches!(tier.what, TierBoxPurpose::Remove(_)) || !tier.name.trim().is_empty();
    if !ready || !(enter || done == TierBoxButton::Done) {
        timeline.boxes.tier_box = Some(tier);
        return;
    }
    let before = match tier.what {
        TierBoxPurpose::Change(id) => scene
            .tier_of(id)
            .map(|tier| TierBox::box_for_tier(scene.contents, tier, TierBoxPurpose::Change(id))),
        _ => None,
    };
    if let Some(job) = tier.job(scene.contents.recording.id, before.as_ref()) {
        let id = scene.seen.request_work(job);
        timeline.boxes.tier_asked = Some((id, tier));
    }
}

/// Reports which tiers and annotations would be removed with a tier.
fn report_removed_tiers(ui: &mut Ui, scene: &TimelineScene<'_>, id: i64, name: &str) {
    let mut family = vec![id];
    let mut index = 0;
    while let Some(above) = family.get(index).copied() {
        let tiers = scene.contents.tiers.iter().map(|tier| &tier.row);
        let below = tiers.filter(|row| row.parent_id == Some(above) && row.id != id);
        family.extend(below.map(|row| row.id));
        index += 1;
    }
    let counts = family.iter().filter_map(|id| scene.tier_of(*id));
    let annotations: usize = counts.map(|tier| tier.annotations.len()).sum();
    let text = fill_text_braces(
        scene.seen.say_text(words::REMOVE_ABOUT),
        &[("name", &name), ("tiers", &(family.len() - 1)), ("n", &annotations)],
    );
    ui.set_max_width(340.0);
    ui.label(text);
}

fn show_tier_form(ui: &mut Ui, scene: &TimelineScene<'_>, tier: &mut TierBox) {
    let seen = scene.seen;
    Grid::new("tier form")
        .num_columns(2)
        .spacing([12.0, 8.0])
        .show(ui, |ui| {
            name_field(ui, seen, tier);
            let roles = possible_tier_roles(seen);
            let role_entry = roles.iter().find(|(id, _)| *id == tier.role);
            let now = role_entry.map_or(tier.role.clone(), |(_, name)| name.clone());
            let mut chosen = false;
            show_tier_drop_down(ui, seen.say_text(words::TIER_ROLE), &now, &roles, |role| {
                tier.role.clone_from(role);
                chosen = true;
            });
            if chosen && tier.what == TierBoxPurpose::Add {
                tier.fit_role_defaults(scene);
            }
            let hands = tier_hand_choices(seen);
            let hand_entry = hands.iter().find(|(hand, _)| *hand == tier.hand);
            let now = hand_entry.map_or(String::new(), |(_, name)| name.clone());
            show_tier_drop_down(ui, seen.say_text(words::TIER_HAND), &now, &hands, |hand| {
                tier.hand = *hand
            });
            let mut above = vec![(None, seen.say_text(words::PARENT_NONE).to_owned())];
            let names = parents(scene.contents, &tier.what);
            above.extend(names.into_iter().map(|name| (Some(name.clone()), name)));
            let now = tier
                .parent
                .as_ref()
                .map_or(seen.say_text(words::PARENT_NONE), |(name, _)| name)
                .to_owned();
            let how = tier.parent.as_ref().map_or(TierStereotype::IncludedIn, |(_, how)| *how);
            show_tier_drop_down(ui, seen.say_text(words::TIER_PARENT), &now, &above, |name| {
                tier.parent = name.clone().map(|name| (name, how));
            });
            if let Some((_, how)) = &mut tier.parent {
                let all =
                    TierStereotype::ALL_TIER_STEREOTYPES.map(|stereotype| (stereotype, how_text(stereotype, seen)));
                let now = how_text(*how, seen);
                show_tier_drop_down(ui, seen.say_text(words::TIER_HOW), &now, &all, |stereotype| {
                    *how = *stereotype
                });
            }
        });
}

fn name_field(ui: &mut Ui, seen: &PaneInput<'_>, tier: &mut TierBox) {
    ui.label(seen.say_text(words::TIER_NAME));
    let field = script_edit::draw_text_line(ui, &mut tier.name, |field| {
        field.desired_width(220.0).id(Id::unique(NAME_FIELD))
    });
    let response = field.response.response;
    response.widget_info(|| {
        let mut info = WidgetInfo::labeled(Role::TextInput, true, seen.say_text(words::TIER_NAME));
        info.current_text_value = Some(tier.name.clone());
        info
    });
    if std::mem::take(&mut tier.fresh) {
        response.request_focus();
    }
    ui.end_row();
}

fn copy_form(ui: &mut Ui, seen: &PaneInput<'_>, tier: &mut TierBox) {
    Grid::new("tier copy form")
        .num_columns(2)
        .spacing([12.0, 8.0])
        .show(ui, |ui| {
            name_field(ui, seen, tier);
            show_copied_choice(ui, seen, &mut tier.copied);
        });
}

/// Shows the rows of a grid that choose the annotations to copy with a tier.
pub(crate) fn show_copied_choice(ui: &mut Ui, seen: &PaneInput<'_>, copied: &mut CopiedAnnotations) {
    let text = match &*copied {
        CopiedAnnotations::Holding(text) => text.clone(),
        _ => String::new(),
    };
    let copied_texts = [
        (CopiedAnnotations::All, words::COPIED_ALL),
        (CopiedAnnotations::Times, words::COPIED_TIMES),
        (CopiedAnnotations::Nothing, words::COPIED_NOTHING),
        (CopiedAnnotations::Holding(text), words::COPIED_HOLDING),
    ];
    let all = copied_texts.map(|(choice, text)| (choice, seen.say_text(text).to_owned()));
    let chosen_entry = all.iter().find(|(choice, _)| choice == copied);
    let now = chosen_entry.map_or(String::new(), |(_, text)| text.clone());
    show_tier_drop_down(ui, seen.say_text(words::COPIED_WHAT), &now, &all, |choice| {
        copied.clone_from(choice);
    });
    if let CopiedAnnotations::Holding(text) = copied {
        let label = ui.label(seen.say_text(words::COPIED_TEXT));
        let field = script_edit::draw_text_line(ui, text, |field| field.desired_width(220.0));
        field.response.response.labelled_by(label.id);
        ui.end_row();
    }
}

const TIER_HAND_WORDS: [(&str, InterfaceText); 5] = [
    ("right", words::HAND_RIGHT),
    ("left", words::HAND_LEFT),
    ("dominant", words::HAND_DOMINANT),
    ("weak", words::HAND_WEAK),
    ("both", words::HAND_BOTH),
];

/// Shows a drop-down list.
pub(crate) fn show_tier_drop_down<T>(
    ui: &mut Ui,
    name: &str,
    now: &str,
    all: &[(T, String)],
    mut choose: impl FnMut(&T),
) {
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
    let index = names.iter().position(|name| *name == now);
    if let Some((it, _)) = combo::step_combo_choice(ui, &combo, &names, index).and_then(|at| all.get(at)) {
        choose(it);
    }
    combo.response.labelled_by(label.id);
    ui.end_row();
}

fn show_tier_box_buttons(ui: &mut Ui, seen: &PaneInput<'_>, tier: &TierBox) -> TierBoxButton {
    let text = match tier.what {
        TierBoxPurpose::Add => words::ADD,
        TierBoxPurpose::Change(_) => words::CHANGE,
        TierBoxPurpose::Remove(_) => words::REMOVE,
        TierBoxPurpose::Copy(_) => words::COPY,
    };
    let mut pressed = TierBoxButton::Nothing;
    ui.horizontal(|ui| {
        let ready = !tier.name.trim().is_empty();
        if ui
            .add_enabled(ready, eframe::egui::Button::new(seen.say_text(text)))
            .clicked()
        {
            pressed = TierBoxButton::Done;
        }
        if ui.button(seen.say_text(shell::CANCEL)).clicked() {
            pressed = TierBoxButton::Cancel;
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
        let before = TierBox::box_for_tier(&all, &all.tiers[1], TierBoxPurpose::Change(2));
        assert_eq!(before.parent, Some(("tier 1".into(), TierStereotype::IncludedIn)));
        let after = TierBox {
            name: "new".into(),
            parent: None,
            ..before.clone()
        };
        let role = after.role.parse().expect("a role");
        let want = TierPropertyChange {
            name: Some("new".into()),
            parent: Some(None),
            ..TierPropertyChange::default()
        };
        assert_eq!(after.tier_changes_since(&before, role), want);
    }

    #[test]
    fn a_tier_cannot_be_its_own_parent() {
        let all = contents(&[
            (1, None, "", &[]),
            (2, Some(1), "Included_In", &[]),
            (3, Some(2), "Included_In", &[]),
            (4, None, "", &[]),
        ]);
        assert_eq!(parents(&all, &TierBoxPurpose::Change(2)), ["tier 1", "tier 4"]);
        assert_eq!(parents(&all, &TierBoxPurpose::Add).len(), 4);
    }
}
