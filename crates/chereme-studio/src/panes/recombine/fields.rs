//! Widgets for the parts of recipes: hands, lengths, times, directions, names.
//!
//! Each returns whether the user changed its value.

use std::sync::{Arc, Mutex, PoisonError};

use chereme_corpus::recipe::{
    Direction, Factor, Hands, Length, Node, Profile, Recipe, Seconds, Transition,
};
use chereme_corpus::{MadePart, Overview, SignGlance, TokenRow};
use chereme_sign::{Component, Inventory, InventoryValue};
use eframe::egui::{
    Button, ComboBox, DragValue, Id, Label, Response, RichText, Role, Slider, SliderClamping, Ui,
    WidgetInfo,
};

use crate::context::PaneInput;
use crate::panes::Carried;
use crate::panes::complete::{Line, complete, fitting};
use crate::panes::inspector::Thing;
use crate::panes::library::data;
use crate::pickers::{self, Picker};
use crate::words::{Text, recombine as words};

/// Key under which a picker stores the value whose details are requested.
const ASKED: &str = "asked of a card";
/// Key of the pending focus request for the first field of a new card.
const GIVEN: &str = "focus of a new card";

/// Requests the focus for the next field that takes it.
pub(super) fn give_focus(ui: &Ui) {
    ui.data_mut(|data| data.insert_temp(Id::unique(GIVEN), ()));
}

/// Returns whether the focus was requested, and clears the request: the first field that asks gets it.
pub(super) fn takes_focus(ui: &Ui) -> bool {
    ui.data_mut(|data| {
        let given = data.get_temp::<()>(Id::unique(GIVEN)).is_some();
        data.remove::<()>(Id::unique(GIVEN));
        given
    })
}

/// Shows a name before a field.
pub(super) fn caption(ui: &mut Ui, seen: &PaneInput<'_>, text: Text) -> Response {
    ui.weak(seen.say(text))
}

/// Shows a drop-down list of `all`.
pub(super) fn choose<T: PartialEq + Copy>(
    ui: &mut Ui,
    name: &str,
    value: &mut T,
    all: &[(T, &str)],
) -> bool {
    let now = all.iter().find(|(it, _)| it == value).map_or("", |it| it.1);
    let before = *value;
    let combo = ComboBox::from_id_salt(name).selected_text(now).width(0.0);
    let inner = combo.show_ui(ui, |ui| {
        for (it, text) in all {
            ui.selectable_value(value, *it, *text);
        }
    });
    inner
        .response
        .widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, format!("{name}: {now}")));
    *value != before
}

pub(super) fn hands_text(hands: Hands) -> Text {
    match hands {
        Hands::Right => words::RIGHT_HAND,
        Hands::Left => words::LEFT_HAND,
        Hands::Both => words::BOTH_HANDS,
        Hands::Dominant => words::DOMINANT_HAND,
        Hands::Weak => words::WEAK_HAND,
    }
}

/// Shows the choice of hands.
pub(super) fn hands(ui: &mut Ui, seen: &PaneInput<'_>, value: &mut Hands, both: bool) -> bool {
    let all: Vec<(Hands, &str)> = Hands::ALL
        .into_iter()
        .filter(|it| both || *it != Hands::Both)
        .map(|it| (it, seen.say(hands_text(it))))
        .collect();
    choose(ui, seen.say(words::HAND), value, &all)
}

/// Shows a number with a slider; a typed number may lie beyond the slider's range.
pub(super) fn slide(
    ui: &mut Ui,
    name: &str,
    value: &mut f64,
    range: std::ops::RangeInclusive<f64>,
    unit: &str,
) -> bool {
    ui.spacing_mut().slider_width = (ui.available_width() - 96.0).clamp(40.0, 160.0);
    let slider = Slider::new(value, range)
        .clamping(SliderClamping::Never)
        .max_decimals(2)
        .suffix(unit);
    let response = ui.add(slider);
    let now = *value;
    response.widget_info(|| WidgetInfo::slider(true, now, name));
    response.changed()
}

/// Shows a number of repetitions.
pub(super) fn count(
    ui: &mut Ui,
    name: &str,
    value: &mut u32,
    range: std::ops::RangeInclusive<u32>,
) -> bool {
    let mut number = f64::from(*value);
    let drag = DragValue::new(&mut number)
        .range(f64::from(*range.start())..=f64::from(*range.end()))
        .speed(0.05)
        .max_decimals(0)
        .suffix("×");
    let response = ui.add(drag);
    response.widget_info(|| WidgetInfo::slider(true, number, name));
    if response.changed() {
        *value = number.round().clamp(1.0, 1000.0) as u32;
    }
    response.changed()
}

/// Shows a length in centimetres or in shares of the arm.
pub(super) fn length(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    name: &str,
    value: &mut Length,
    most: f64,
) -> bool {
    let (mut number, arm) = match *value {
        Length::Metres(metres) => (tidy(metres * 100.0), false),
        Length::Arm(share) => (tidy(share * 100.0), true),
    };
    let mut of_arm = arm;
    let unit = if arm { " %" } else { " cm" };
    let least = if number < 0.0 { -most } else { 0.0 };
    let mut changed = slide(ui, name, &mut number, least..=most, unit);
    let units = [(false, "cm"), (true, seen.say(words::OF_ARM))];
    changed |= choose(ui, seen.say(words::UNIT), &mut of_arm, &units);
    if changed {
        *value = if of_arm {
            Length::Arm(number / 100.0)
        } else {
            Length::Metres(number / 100.0)
        };
    }
    changed
}

/// Rounds a number as it is shown, so that 0.07 m is 7 cm.
pub(super) fn tidy(number: f64) -> f64 {
    (number * 1e6).round() / 1e6
}

/// Shows a time; `None` leaves it to the operator.
pub(super) fn time(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    text: Text,
    value: &mut Option<Seconds>,
    usual: f64,
) -> bool {
    let mut said = value.is_some();
    let mut changed = ui.checkbox(&mut said, seen.say(text)).changed();
    if changed {
        *value = said.then_some(Seconds(usual));
    }
    if let Some(Seconds(seconds)) = value {
        let drag = DragValue::new(seconds)
            .range(0.0..=60.0)
            .speed(0.01)
            .max_decimals(3)
            .suffix(" s");
        let response = ui.add(drag);
        let now = *seconds;
        response.widget_info(|| WidgetInfo::slider(true, now, seen.say(text)));
        changed |= response.changed();
    }
    changed
}

/// Shows a factor; `None` means one.
pub(super) fn factor(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    text: Text,
    value: &mut Option<Factor>,
    usual: f64,
) -> bool {
    let mut said = value.is_some();
    let mut changed = ui.checkbox(&mut said, seen.say(text)).changed();
    if changed {
        *value = said.then_some(Factor(usual));
    }
    if let Some(Factor(factor)) = value {
        let drag = DragValue::new(factor)
            .range(0.05..=20.0)
            .speed(0.01)
            .max_decimals(2)
            .prefix("×");
        let response = ui.add(drag);
        let now = *factor;
        response.widget_info(|| WidgetInfo::slider(true, now, seen.say(text)));
        changed |= response.changed();
    }
    changed
}

fn profile_text(profile: Option<Profile>) -> Text {
    match profile {
        None => words::COURSE_USUAL,
        Some(Profile::Slerp) => words::COURSE_SLERP,
        Some(Profile::Cosine) => words::COURSE_COSINE,
        Some(Profile::Sigmoid) => words::COURSE_SIGMOID,
        Some(Profile::MinimumJerk) => words::COURSE_JERK,
        Some(Profile::Learned) => words::COURSE_LEARNED,
    }
}

/// Shows a transition from one posture to the next.
pub(super) fn transition(ui: &mut Ui, seen: &PaneInput<'_>, value: &mut Transition) -> bool {
    ui.horizontal_wrapped(|ui| {
        caption(ui, seen, words::VIA);
        let all: Vec<(Option<Profile>, &str)> = [None]
            .into_iter()
            .chain(Profile::ALL.map(Some))
            .map(|it| (it, seen.say(profile_text(it))))
            .collect();
        let changed = choose(ui, seen.say(words::COURSE), &mut value.profile, &all);
        time(ui, seen, words::LASTS, &mut value.time, 0.25) | changed
    })
    .inner
}

pub(super) fn direction_text(direction: Direction) -> Text {
    match direction {
        Direction::Left => words::LEFT,
        Direction::Right => words::RIGHT,
        Direction::Up => words::UP,
        Direction::Down => words::DOWN,
        Direction::Forward => words::FORWARD,
        Direction::Back => words::BACK,
    }
}

/// Shows the signer's six directions as switches; opposite ones exclude each other.
pub(super) fn directions(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    name: &str,
    value: &mut Vec<Direction>,
) -> bool {
    let mut changed = false;
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0;
        for direction in Direction::ALL {
            let chosen = value.contains(&direction);
            let text = seen.say(direction_text(direction));
            let response = ui.add(Button::selectable(chosen, text));
            let label = format!("{name}: {text}");
            response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, &label));
            if response.clicked() {
                let against = direction.vector() * -1.0;
                value.retain(|it| *it != direction && it.vector() != against);
                if !chosen {
                    value.push(direction);
                }
                changed = true;
            }
        }
    });
    changed
}

/// Returns the name of a value of an inventory, if it differs from its id.
fn called(value: &InventoryValue, seen: &PaneInput<'_>) -> Option<String> {
    value.names.get(seen.language.code()).cloned()
}

/// Shows a value from the inventories of a component: a text field with completion.
pub(super) fn of_inventory(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    id: Id,
    component: Component,
    text: &mut String,
) -> bool {
    let (name, hint) = match component {
        Component::Configuration => (words::HANDSHAPE, words::HANDSHAPE_HINT),
        _ => (words::PLACE_NAME, words::PLACE_HINT),
    };
    let inventories = seen.snapshot.overview.inventories.iter();
    let all: Vec<&Inventory> = inventories
        .map(|it| &it.inventory)
        .filter(|it| it.component == component && it.feature.is_none())
        .collect();
    let values = all.iter().flat_map(|it| &it.values);
    let candidates = |typed: &str| fitting(values.clone().map(|it| it.id.as_str()), typed);
    let about = |id: &str| called(values.clone().find(|it| it.id == id)?, seen);
    let line = Line {
        name: seen.say(name),
        hint: seen.say(hint),
        width: (ui.available_width() - 110.0).clamp(60.0, 100.0),
        takes_only: true,
        about: Some(&about),
    };
    let typed = complete(ui, id, line, text, &candidates);
    let held = all.iter().find(|it| it.find(text).is_some());
    let Some(inventory) = held.or(all.first()) else {
        return typed.changed;
    };
    let state: Arc<Mutex<Picker>> = ui.data_mut(|data| {
        let fresh = || Arc::new(Mutex::new(Picker::default()));
        data.get_temp_mut_or_insert_with(id.with("picker"), fresh)
            .clone()
    });
    let mut picker = state.lock().unwrap_or_else(PoisonError::into_inner);
    if takes_focus(ui) {
        if text.is_empty() {
            *picker = Picker::opening();
        } else {
            typed.response.request_focus();
        }
    }
    let chosen = Some(text.as_str()).filter(|text| inventory.find(text).is_some());
    let name = format!("{}…", seen.say(name));
    let picked = pickers::button(ui, &mut picker, seen, inventory, chosen, &name);
    if let Some(thing) = picker.asked(seen) {
        ui.data_mut(|data| data.insert_temp(Id::unique(ASKED), thing));
    }
    if let Some(value) = chosen.and_then(|id| inventory.find(id))
        && let Some(name) = called(value, seen)
        && name != *text
    {
        // A second line would move the card's other settings out of sight.
        let called = RichText::new(&name).weak();
        ui.add(Label::new(called).truncate()).on_hover_text(&name);
    }
    let changed = picked.is_some();
    if let Some(picked) = picked {
        *text = picked;
    }
    typed.changed | changed
}

/// Returns the value whose details the user requested in a picker of a card.
pub(super) fn asked(ui: &Ui) -> Option<Thing> {
    let id = Id::unique(ASKED);
    ui.data_mut(|data| {
        let thing = data.get_temp(id);
        data.remove::<Thing>(id);
        thing
    })
}

/// Returns the id and the gloss of the token that is selected or under the playhead.
pub(crate) fn selected_token(seen: &PaneInput<'_>) -> Option<(i64, String)> {
    let contents = seen.snapshot.contents(seen.shown.recording?)?;
    let by = |annotation: i64| {
        let own = contents.tokens.iter();
        own.clone()
            .find(|token| token.annotation_id == Some(annotation))
    };
    let at = seen.shown.player.playhead().micros();
    let under = |start: i64, end: i64| {
        contents.tokens.iter().find(move |token| {
            let span = token.start_us.zip(token.end_us);
            span.is_some_and(|(from, to)| from <= start && end <= to)
        })
    };
    let token = match (seen.shown.annotation(), seen.shown.span) {
        (Some(annotation), _) => by(annotation).or_else(|| {
            let found = seen.snapshot.annotation(annotation)?;
            let span = found.tier.annotations.span(found.at);
            under(span.start().micros(), span.end().micros())
        }),
        (None, Some(span)) => under(span.start().micros(), span.end().micros()),
        (None, None) => under(at, at),
    }?;
    Some((token.id, token.gloss.clone()))
}

/// Returns the first recipe and its gloss: the selection, or the notated sign on the stage.
pub(super) fn selected_recipe(seen: &PaneInput<'_>) -> Option<(String, String)> {
    if let Some(showing) = &seen.shown.made
        && let Some(token) = showing.made.token
    {
        let gloss = showing.made.name.clone();
        let signs = &seen.snapshot.overview.signs;
        let only = |gloss: &String| signs.iter().any(|it| it.gloss == *gloss && it.tokens == 1);
        // A gloss is easier to read, if it identifies the token.
        let recipe = match gloss.contains('"') || !only(&gloss) {
            true => format!("sigml \"token:{token}\""),
            false => format!("sigml \"{gloss}\""),
        };
        return Some((recipe, gloss));
    }
    let (token, gloss) = selected_token(seen)?;
    Some((recipe_of(&seen.snapshot.overview, token, &gloss), gloss))
}

/// Returns the recipe that consists of a token without changes.
pub(crate) fn recipe_of(overview: &Overview, token: i64, gloss: &str) -> String {
    quoted(&address(overview, token, gloss))
}

/// Returns the name of a token in recipes: its gloss if that means this token, else `token:` and its id.
pub(super) fn address(overview: &Overview, token: i64, gloss: &str) -> String {
    let mut named = overview.signs.iter().filter(|it| it.gloss == gloss);
    let means = named.next().is_some_and(|it| it.citation == Some(token));
    let text = quoted(gloss);
    let reads = text
        .parse::<Recipe>()
        .is_ok_and(|it| it.to_string() == text);
    if means && reads {
        gloss.to_owned()
    } else {
        format!("token:{token}")
    }
}

/// Returns a sign's name in the notation of recipes.
fn quoted(name: &str) -> String {
    Node::Sign(name.to_owned()).to_string()
}

/// Shows the choice of a sign by gloss: typed with completion, the selected token, or a result dropped on it.
pub(super) fn sign(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    id: Id,
    name: &str,
    text: &mut String,
) -> bool {
    let inner = ui.horizontal_wrapped(|ui| {
        let signs = &seen.snapshot.overview.signs;
        let candidates = |typed: &str| fitting(signs.iter().map(|it| it.gloss.as_str()), typed);
        let about = |gloss: &str| {
            let at = signs.binary_search_by(|it| it.gloss.as_str().cmp(gloss));
            let sign = &signs[at.ok()?];
            let recording = sign.place.and_then(|it| seen.snapshot.recording(it.0));
            let origin = recording.map(|it| it.row.origin);
            Some(data::about(sign, origin, seen.language))
        };
        let line = Line {
            name,
            hint: seen.say(words::SIGN_HINT),
            width: (ui.available_width() - 84.0).clamp(80.0, 200.0),
            takes_only: true,
            about: Some(&about),
        };
        let mut changed = false;
        match token_chip(ui, seen, id, name, text) {
            Some(cleared) => changed |= cleared,
            None => {
                let typed = complete(ui, id, line, text, &candidates);
                if takes_focus(ui) {
                    typed.response.request_focus();
                }
                changed |= typed.changed;
            }
        }
        let selected = selected_token(seen).map(|(token, gloss)| {
            let address = address(&seen.snapshot.overview, token, &gloss);
            (address, gloss)
        });
        if let Some((address, gloss)) = selected.filter(|it| it.0 != *text) {
            let tip = crate::words::fill(seen.say(words::TAKE_SELECTED), &[("gloss", &gloss)]);
            let button = ui.add(eframe::egui::Button::new(tip.as_str()).truncate());
            if button.on_hover_text(tip).clicked() {
                *text = address;
                changed = true;
            }
        }
        if let Some(when) = time_of(seen, text) {
            ui.weak(when);
        }
        changed
    });
    let dropped = inner.response.dnd_release_payload::<Carried>();
    if inner.response.dnd_hover_payload::<Carried>().is_some() {
        let stroke = eframe::egui::Stroke::new(2.0, seen.colours().accent);
        let kind = eframe::egui::StrokeKind::Outside;
        ui.painter()
            .rect_stroke(inner.response.rect, 5.0, stroke, kind);
    }
    if let Some(carried) = dropped {
        *text = address(&seen.snapshot.overview, carried.token, &carried.gloss);
        return true;
    }
    inner.inner
}

/// Shows a token by its gloss, as nobody remembers signs by numbers; a click lets the user type another sign. Returns
/// whether it was clicked; `None` if the text is not a known token.
fn token_chip(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    id: Id,
    name: &str,
    text: &mut String,
) -> Option<bool> {
    let gloss = gloss_of(seen, text).filter(|_| text.starts_with("token:"))?;
    if ui.memory(|memory| memory.has_focus(id)) {
        return None;
    }
    let response = ui.button(RichText::new(&gloss).strong());
    let label = format!("{name}: {gloss}");
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &label));
    let clicked = response
        .on_hover_text(seen.say(words::OTHER_SIGN))
        .clicked();
    if clicked {
        text.clear();
        ui.memory_mut(|memory| memory.request_focus(id));
    }
    Some(clicked)
}

/// Returns the gloss of a `token:…`: of the open recording, of a piece of the movement on the stage, or of a citation
/// form.
pub(super) fn gloss_of(seen: &PaneInput<'_>, text: &str) -> Option<String> {
    token_of(seen, text)
        .map(|token| token.gloss.clone())
        .or_else(|| Some(part_of(seen, text)?.gloss.clone()))
        .or_else(|| Some(sign_of(seen, text)?.gloss.clone()))
        .filter(|gloss| !gloss.is_empty())
}

fn token_of<'a>(seen: &PaneInput<'a>, text: &str) -> Option<&'a TokenRow> {
    let id: i64 = text.strip_prefix("token:")?.parse().ok()?;
    let contents = seen.snapshot.contents(seen.shown.recording?)?;
    contents.tokens.iter().find(|token| token.id == id)
}

/// Returns the sign whose citation form a token is.
fn sign_of<'a>(seen: &PaneInput<'a>, text: &str) -> Option<&'a SignGlance> {
    let id: i64 = text.strip_prefix("token:")?.parse().ok()?;
    let mut signs = seen.snapshot.overview.signs.iter();
    signs.find(|it| it.citation == Some(id))
}

fn part_of<'a>(seen: &PaneInput<'a>, text: &str) -> Option<&'a MadePart> {
    text.strip_prefix("token:")?;
    let made = &seen.shown.made.as_ref()?.made;
    made.parts.iter().find(|part| part.from == text)
}

/// Returns the time of a token in the open recording, or the duration of a piece of the movement on the stage.
fn time_of(seen: &PaneInput<'_>, text: &str) -> Option<String> {
    let seconds = |micros: i64| format!("{:.2}", micros as f64 / 1e6);
    if let Some((start, end)) = token_of(seen, text).and_then(|it| it.start_us.zip(it.end_us)) {
        return Some(format!("{}–{} s", seconds(start), seconds(end)));
    }
    let span = part_of(seen, text)?.span;
    Some(format!("{} s", seconds(span.micros())))
}

/// Shows the choice of the signer whose body is used, if the corpus has signers.
pub(super) fn signer(ui: &mut Ui, seen: &PaneInput<'_>, value: &mut Option<String>) -> bool {
    let signers = &seen.snapshot.overview.signers;
    if signers.is_empty() && value.is_none() {
        return false;
    }
    caption(ui, seen, words::ON_BODY);
    let now = value
        .clone()
        .unwrap_or_else(|| seen.say(words::ANY_BODY).to_owned());
    let before = value.clone();
    let combo = ComboBox::from_id_salt("signer")
        .selected_text(&now)
        .width(0.0);
    let inner = combo.show_ui(ui, |ui| {
        ui.selectable_value(value, None, seen.say(words::ANY_BODY));
        for signer in signers {
            let address = format!("signer:{}", signer.id);
            ui.selectable_value(value, Some(address), &signer.name);
        }
    });
    let name = format!("{}: {now}", seen.say(words::ON_BODY));
    inner
        .response
        .widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, &name));
    *value != before
}
