//! Widgets for the parts of recipes: hands, lengths, times, directions, names.
//!
//! Each returns whether the user changed its value.

use std::sync::{Arc, Mutex, PoisonError};

use chereme_corpus::recipe::{
    BUILT_IN_BODY, BodyDirection, HandChoice, PostureTransition, Recipe, RecipeFactor, RecipeLength, RecipeNode,
    RecipeSeconds, TransitionProfile,
};
use chereme_corpus::{CorpusOverview, MadePart, SignGlance, TokenRow};
use chereme_sign::{ComponentInventory, InventoryValue, SignComponent};
use eframe::egui::{
    Button, ComboBox, DragValue, Id, Label, Response, RichText, Role, Slider, SliderClamping, Ui, WidgetInfo,
};

use crate::command::DraggedToken;
use crate::context::PaneInput;
use crate::model::InspectedThing;
use crate::panes::complete_pane::{CompletionLine, fitting_candidates, show_completion_line};
use crate::panes::library::library_data;
use crate::pickers::{self, ValuePicker};
use crate::words::{InterfaceText, recombine_words as words};

/// Key under which a picker stores the value whose details are requested.
const REQUESTED_DETAILS_KEY: &str = "asked of a card";
/// Key of the pending focus request for the first field of a new card.
const PENDING_FOCUS_KEY: &str = "focus of a new card";

/// Requests the focus for the next field that takes it.
pub(super) fn give_focus(ui: &Ui) {
    ui.data_mut(|data| data.insert_temp(Id::unique(PENDING_FOCUS_KEY), ()));
}

/// Returns whether the focus was requested, and clears the request: the first field that asks gets it.
pub(super) fn takes_focus(ui: &Ui) -> bool {
    ui.data_mut(|data| {
        let given = data.get_temp::<()>(Id::unique(PENDING_FOCUS_KEY)).is_some();
        data.remove::<()>(Id::unique(PENDING_FOCUS_KEY));
        given
    })
}

/// Shows a name before a field.
pub(super) fn show_field_caption(ui: &mut Ui, seen: &PaneInput<'_>, text: InterfaceText) -> Response {
    ui.weak(seen.say_text(text))
}

/// Shows a drop-down list of `all`.
pub(super) fn show_value_choice<T: PartialEq + Copy>(
    ui: &mut Ui,
    name: &str,
    value: &mut T,
    all: &[(T, &str)],
) -> bool {
    let now = all.iter().find(|(other, _)| other == value).map_or("", |entry| entry.1);
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

pub(super) fn hands_text(hands: HandChoice) -> InterfaceText {
    match hands {
        HandChoice::Right => words::RIGHT_HAND,
        HandChoice::Left => words::LEFT_HAND,
        HandChoice::Both => words::BOTH_HANDS,
        HandChoice::Dominant => words::DOMINANT_HAND,
        HandChoice::Weak => words::WEAK_HAND,
    }
}

/// Shows the choice of hands.
pub(super) fn show_hands_choice(ui: &mut Ui, seen: &PaneInput<'_>, value: &mut HandChoice, both: bool) -> bool {
    let all: Vec<(HandChoice, &str)> = HandChoice::ALL_HAND_CHOICES
        .into_iter()
        .filter(|hand| both || *hand != HandChoice::Both)
        .map(|hand| (hand, seen.say_text(hands_text(hand))))
        .collect();
    show_value_choice(ui, seen.say_text(words::HAND), value, &all)
}

/// Shows a number with a slider; a typed number may lie beyond the slider's range.
pub(super) fn show_number_slider(
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
pub(super) fn show_repetition_count(
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
pub(super) fn show_length_field(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    name: &str,
    value: &mut RecipeLength,
    most: f64,
) -> bool {
    let (mut number, arm) = match *value {
        RecipeLength::Metres(metres) => (round_shown_number(metres * 100.0), false),
        RecipeLength::Arm(share) => (round_shown_number(share * 100.0), true),
    };
    let mut of_arm = arm;
    let unit = if arm { " %" } else { " cm" };
    let least = if number < 0.0 { -most } else { 0.0 };
    let mut changed = show_number_slider(ui, name, &mut number, least..=most, unit);
    let units = [(false, "cm"), (true, seen.say_text(words::OF_ARM))];
    changed |= show_value_choice(ui, seen.say_text(words::UNIT), &mut of_arm, &units);
    if changed {
        *value = if of_arm {
            RecipeLength::Arm(number / 100.0)
        } else {
            RecipeLength::Metres(number / 100.0)
        };
    }
    changed
}

/// Rounds a number as it is shown, so that 0.07 m is 7 cm.
pub(super) fn round_shown_number(number: f64) -> f64 {
    (number * 1e6).round() / 1e6
}

/// Shows a time; `None` leaves it to the operator.
pub(super) fn show_time_field(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    text: InterfaceText,
    value: &mut Option<RecipeSeconds>,
    usual: f64,
) -> bool {
    let mut is_set = value.is_some();
    let mut changed = ui.checkbox(&mut is_set, seen.say_text(text)).changed();
    if changed {
        *value = is_set.then_some(RecipeSeconds(usual));
    }
    if let Some(RecipeSeconds(seconds)) = value {
        let drag = DragValue::new(seconds)
            .range(0.0..=60.0)
            .speed(0.01)
            .max_decimals(3)
            .suffix(" s");
        let response = ui.add(drag);
        let now = *seconds;
        response.widget_info(|| WidgetInfo::slider(true, now, seen.say_text(text)));
        changed |= response.changed();
    }
    changed
}

/// Shows a factor; `None` means one.
pub(super) fn show_factor_field(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    text: InterfaceText,
    value: &mut Option<RecipeFactor>,
    usual: f64,
) -> bool {
    let mut is_set = value.is_some();
    let mut changed = ui.checkbox(&mut is_set, seen.say_text(text)).changed();
    if changed {
        *value = is_set.then_some(RecipeFactor(usual));
    }
    if let Some(RecipeFactor(factor)) = value {
        let drag = DragValue::new(factor)
            .range(0.05..=20.0)
            .speed(0.01)
            .max_decimals(2)
            .prefix("×");
        let response = ui.add(drag);
        let now = *factor;
        response.widget_info(|| WidgetInfo::slider(true, now, seen.say_text(text)));
        changed |= response.changed();
    }
    changed
}

fn profile_text(profile: Option<TransitionProfile>) -> InterfaceText {
    match profile {
        None => words::COURSE_USUAL,
        Some(TransitionProfile::Slerp) => words::COURSE_SLERP,
        Some(TransitionProfile::Cosine) => words::COURSE_COSINE,
        Some(TransitionProfile::Sigmoid) => words::COURSE_SIGMOID,
        Some(TransitionProfile::MinimumJerk) => words::COURSE_JERK,
        Some(TransitionProfile::Learned) => words::COURSE_LEARNED,
    }
}

/// Shows a transition from one posture to the next.
pub(super) fn show_transition_field(ui: &mut Ui, seen: &PaneInput<'_>, value: &mut PostureTransition) -> bool {
    ui.horizontal_wrapped(|ui| {
        show_field_caption(ui, seen, words::VIA);
        let all: Vec<(Option<TransitionProfile>, &str)> = [None]
            .into_iter()
            .chain(TransitionProfile::ALL_TRANSITION_PROFILES.map(Some))
            .map(|profile| (profile, seen.say_text(profile_text(profile))))
            .collect();
        let changed = show_value_choice(ui, seen.say_text(words::COURSE), &mut value.profile, &all);
        show_time_field(ui, seen, words::LASTS, &mut value.time, 0.25) | changed
    })
    .inner
}

pub(super) fn direction_text(direction: BodyDirection) -> InterfaceText {
    match direction {
        BodyDirection::Left => words::LEFT,
        BodyDirection::Right => words::RIGHT,
        BodyDirection::Up => words::UP,
        BodyDirection::Down => words::DOWN,
        BodyDirection::Forward => words::FORWARD,
        BodyDirection::Back => words::BACK,
    }
}

/// Shows the signer's six directions as switches; opposite ones exclude each other.
pub(super) fn show_direction_switches(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    name: &str,
    value: &mut Vec<BodyDirection>,
) -> bool {
    let mut changed = false;
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0;
        for direction in BodyDirection::ALL_BODY_DIRECTIONS {
            let chosen = value.contains(&direction);
            let text = seen.say_text(direction_text(direction));
            let response = ui.add(Button::selectable(chosen, text));
            let label = format!("{name}: {text}");
            response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, &label));
            if response.clicked() {
                let against = direction.direction_unit_vector() * -1.0;
                value.retain(|other| *other != direction && other.direction_unit_vector() != against);
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
fn inventory_value_name(value: &InventoryValue, seen: &PaneInput<'_>) -> Option<String> {
    value.names.get(seen.language.language_code()).cloned()
}

/// Shows a value from the inventories of a component: a text field with completion.
pub(super) fn of_inventory(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    id: Id,
    component: SignComponent,
    text: &mut String,
) -> bool {
    let (name, hint) = match component {
        SignComponent::Configuration => (words::HANDSHAPE, words::HANDSHAPE_HINT),
        _ => (words::PLACE_NAME, words::PLACE_HINT),
    };
    let inventories = seen.snapshot.overview.inventories.iter();
    let all: Vec<&ComponentInventory> = inventories
        .map(|stored| &stored.inventory)
        .filter(|inventory| inventory.component == component && inventory.feature.is_none())
        .collect();
    show_inventory_line(ui, seen, id, &all, [name, hint].map(|text| seen.say_text(text)), text)
}

/// Shows a value of some inventories: a text field with completion, and the picker of the inventory that has the value.
pub(super) fn show_inventory_line(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    id: Id,
    all: &[&ComponentInventory],
    [name, hint]: [&str; 2],
    text: &mut String,
) -> bool {
    let equal = &seen.snapshot.overview.equal_values;
    let stands_alone =
        |inventory: &ComponentInventory, id: &str| !equal.has_stand_in(all.iter().copied(), &inventory.id, id);
    let values = all.iter().flat_map(|inventory| {
        let values = inventory.values.iter();
        values.filter(|value| stands_alone(inventory, &value.id))
    });
    let candidates = |typed: &str| fitting_candidates(values.clone().map(|value| value.id.as_str()), typed);
    let about = |id: &str| inventory_value_name(values.clone().find(|value| value.id == id)?, seen);
    let line = CompletionLine {
        name,
        hint,
        width: (ui.available_width() - 110.0).clamp(60.0, 100.0),
        takes_only: true,
        about: Some(&about),
    };
    let typed = show_completion_line(ui, id, line, text, &candidates);
    let holding_inventory = all
        .iter()
        .find(|inventory| inventory.find_inventory_value(text).is_some());
    let Some(inventory) = holding_inventory.or(all.first()) else {
        return typed.changed;
    };
    let state: Arc<Mutex<ValuePicker>> = ui.data_mut(|data| {
        let fresh = || Arc::new(Mutex::new(ValuePicker::default()));
        data.get_temp_mut_or_insert_with(id.with("picker"), fresh).clone()
    });
    let mut picker = state.lock().unwrap_or_else(PoisonError::into_inner);
    if takes_focus(ui) {
        if text.is_empty() {
            *picker = ValuePicker::new_opening_picker();
        } else {
            typed.response.request_focus();
        }
    }
    let chosen = Some(text.as_str()).filter(|text| inventory.find_inventory_value(text).is_some());
    let name = format!("{name}…");
    let picked = pickers::show_picker_button(ui, &mut picker, seen, inventory, chosen, &name);
    if let Some(thing) = picker.take_requested_value(seen) {
        ui.data_mut(|data| data.insert_temp(Id::unique(REQUESTED_DETAILS_KEY), thing));
    }
    if let Some(value) = chosen.and_then(|id| inventory.find_inventory_value(id))
        && let Some(name) = inventory_value_name(value, seen)
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
pub(super) fn take_requested_details(ui: &Ui) -> Option<InspectedThing> {
    let id = Id::unique(REQUESTED_DETAILS_KEY);
    ui.data_mut(|data| {
        let thing = data.get_temp(id);
        data.remove::<InspectedThing>(id);
        thing
    })
}

/// Returns the id and the gloss of the token that is selected or under the playhead.
pub(crate) fn selected_token(seen: &PaneInput<'_>) -> Option<(i64, String)> {
    let contents = seen.snapshot.recording_contents(seen.shown.recording?)?;
    let by = |annotation: i64| {
        let all_tokens = contents.tokens.iter();
        all_tokens.clone().find(|token| token.annotation_id == Some(annotation))
    };
    let playhead_micros = seen.shown.player.player_playhead().instant_micros();
    let under = |start: i64, end: i64| {
        contents.tokens.iter().find(move |token| {
            let span = token.start_us.zip(token.end_us);
            span.is_some_and(|(from, to)| from <= start && end <= to)
        })
    };
    let token = match (seen.shown.selected_annotation(), seen.shown.span) {
        (Some(annotation), _) => by(annotation).or_else(|| {
            let selection = seen.snapshot.find_open_annotation(annotation)?;
            let span = selection.tier.annotations.annotation_span_at(selection.at);
            under(
                span.span_start_instant().instant_micros(),
                span.span_end_instant().instant_micros(),
            )
        }),
        (None, Some(span)) => under(
            span.span_start_instant().instant_micros(),
            span.span_end_instant().instant_micros(),
        ),
        (None, None) => under(playhead_micros, playhead_micros),
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
        let only = |gloss: &String| signs.iter().any(|sign| sign.gloss == *gloss && sign.tokens == 1);
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
pub(crate) fn recipe_of(overview: &CorpusOverview, token: i64, gloss: &str) -> String {
    quote_recipe_sign(&recipe_token_address(overview, token, gloss))
}

/// Returns whether a gloss alone means a token: the citation form of the only sign with that gloss.
pub(crate) fn gloss_means_token(overview: &CorpusOverview, token: i64, gloss: &str) -> bool {
    let mut named = overview.signs.iter().filter(|sign| sign.gloss == gloss);
    named.next().is_some_and(|sign| sign.citation == Some(token)) && named.next().is_none()
}

/// Returns the name of a token in recipes: its gloss if that means this token, else `token:` and its id.
pub(super) fn recipe_token_address(overview: &CorpusOverview, token: i64, gloss: &str) -> String {
    let means = gloss_means_token(overview, token, gloss);
    let text = quote_recipe_sign(gloss);
    let reads = text.parse::<Recipe>().is_ok_and(|parsed| parsed.to_string() == text);
    if means && reads {
        gloss.to_owned()
    } else {
        format!("token:{token}")
    }
}

/// Returns a sign's name in the notation of recipes.
fn quote_recipe_sign(name: &str) -> String {
    RecipeNode::Sign(name.to_owned()).to_string()
}

/// Shows the choice of a sign by gloss: typed with completion, the selected token, or a result dropped on it.
pub(super) fn show_sign_field(ui: &mut Ui, seen: &PaneInput<'_>, id: Id, name: &str, text: &mut String) -> bool {
    let inner = ui.horizontal_wrapped(|ui| {
        let signs = &seen.snapshot.overview.signs;
        let candidates = |typed: &str| fitting_candidates(signs.iter().map(|sign| sign.gloss.as_str()), typed);
        let about = |gloss: &str| {
            let position = signs.binary_search_by(|sign| sign.gloss.as_str().cmp(gloss));
            let sign = &signs[position.ok()?];
            let recording = sign.place.and_then(|place| seen.snapshot.recording_glance(place.0));
            let origin = recording.map(|glance| glance.row.origin);
            Some(library_data::describe_sign_origin(sign, origin, seen.language))
        };
        let line = CompletionLine {
            name,
            hint: seen.say_text(words::SIGN_HINT),
            width: (ui.available_width() - 84.0).clamp(80.0, 200.0),
            takes_only: true,
            about: Some(&about),
        };
        let mut changed = false;
        match token_chip(ui, seen, id, name, text) {
            Some(cleared) => changed |= cleared,
            None => {
                let typed = show_completion_line(ui, id, line, text, &candidates);
                if takes_focus(ui) {
                    typed.response.request_focus();
                }
                changed |= typed.changed;
            }
        }
        let selected = selected_token(seen).map(|(token, gloss)| {
            let address = recipe_token_address(&seen.snapshot.overview, token, &gloss);
            (address, gloss)
        });
        // The button would do nothing for the sign that stands there already.
        if let Some((address, gloss)) = selected.filter(|selection| selection.0 != *text) {
            let tip = crate::words::fill_text_braces(seen.say_text(words::TAKE_SELECTED), &[("gloss", &gloss)]);
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
    let dropped = inner.response.dnd_release_payload::<DraggedToken>();
    if inner.response.dnd_hover_payload::<DraggedToken>().is_some() {
        let stroke = eframe::egui::Stroke::new(2.0, seen.pane_colours().accent);
        let kind = eframe::egui::StrokeKind::Outside;
        ui.painter().rect_stroke(inner.response.rect, 5.0, stroke, kind);
    }
    if let Some(carried) = dropped {
        *text = recipe_token_address(&seen.snapshot.overview, carried.token, &carried.gloss);
        return true;
    }
    inner.inner
}

/// Shows a token by its gloss, as nobody remembers signs by numbers; a click lets the user type another sign. Returns
/// whether it was clicked; `None` if the text is not a known token.
fn token_chip(ui: &mut Ui, seen: &PaneInput<'_>, id: Id, name: &str, text: &mut String) -> Option<bool> {
    let gloss = gloss_of(seen, text).filter(|_| text.starts_with("token:"))?;
    if ui.memory(|memory| memory.has_focus(id)) {
        return None;
    }
    let response = ui.button(RichText::new(&gloss).strong());
    let label = format!("{name}: {gloss}");
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &label));
    let clicked = response.on_hover_text(seen.say_text(words::OTHER_SIGN)).clicked();
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
    let contents = seen.snapshot.recording_contents(seen.shown.recording?)?;
    contents.tokens.iter().find(|token| token.id == id)
}

/// Returns the sign whose citation form a token is.
fn sign_of<'a>(seen: &PaneInput<'a>, text: &str) -> Option<&'a SignGlance> {
    let id: i64 = text.strip_prefix("token:")?.parse().ok()?;
    let mut signs = seen.snapshot.overview.signs.iter();
    signs.find(|sign| sign.citation == Some(id))
}

fn part_of<'a>(seen: &PaneInput<'a>, text: &str) -> Option<&'a MadePart> {
    text.strip_prefix("token:")?;
    let made = &seen.shown.made.as_ref()?.made;
    made.parts.iter().find(|part| part.from == text)
}

/// Returns the time of a token in the open recording, or the duration of a piece of the movement on the stage.
fn time_of(seen: &PaneInput<'_>, text: &str) -> Option<String> {
    let seconds = |micros: i64| format!("{:.2}", micros as f64 / 1e6);
    if let Some((start, end)) = token_of(seen, text).and_then(|token| token.start_us.zip(token.end_us)) {
        return Some(format!("{}–{} s", seconds(start), seconds(end)));
    }
    let span = part_of(seen, text)?.span;
    Some(format!("{} s", seconds(span.span_micros())))
}

/// Shows the choice of the signer whose body is used, if the corpus has signers.
pub(super) fn show_signer_choice(ui: &mut Ui, seen: &PaneInput<'_>, value: &mut Option<String>) -> bool {
    let signers = &seen.snapshot.overview.signers;
    if signers.is_empty() && value.is_none() {
        return false;
    }
    show_field_caption(ui, seen, words::ON_BODY);
    let now = value
        .clone()
        .unwrap_or_else(|| seen.say_text(words::ANY_BODY).to_owned());
    let before = value.clone();
    let combo = ComboBox::from_id_salt("signer").selected_text(&now).width(0.0);
    let inner = combo.show_ui(ui, |ui| {
        ui.selectable_value(value, None, seen.say_text(words::ANY_BODY));
        for signer in signers {
            let address = format!("signer:{}", signer.id);
            ui.selectable_value(value, Some(address), &signer.name);
        }
        let built_in = Some(BUILT_IN_BODY.to_owned());
        ui.selectable_value(value, built_in, seen.say_text(words::BUILT_IN_BODY));
    });
    let name = format!("{}: {now}", seen.say_text(words::ON_BODY));
    inner
        .response
        .widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, &name));
    *value != before
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_corpus::SignGlance;

    #[test]
    fn a_gloss_of_two_lexicons_names_no_token() {
        let sign = |id: i64, gloss: &str, lexicon: &str| SignGlance {
            id,
            gloss: gloss.to_owned(),
            lexicon: Some(lexicon.to_owned()),
            notes: None,
            tokens: 1,
            citation: Some(10 + id),
            place: None,
            notated: false,
        };
        let overview = CorpusOverview {
            signs: vec![sign(1, "BOOK", "ASL"), sign(2, "BOOK", "BSL"), sign(3, "SNAIL", "ASL")],
            ..CorpusOverview::default()
        };
        assert_eq!(recipe_of(&overview, 11, "BOOK"), "token:11");
        assert_eq!(recipe_of(&overview, 12, "BOOK"), "token:12");
        assert_eq!(recipe_of(&overview, 13, "SNAIL"), "SNAIL");
    }
}
