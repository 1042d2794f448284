//! The board of all HamNoSys symbols, to write a notation by picking.

use chereme_sign::hamnosys::{Class, Symbol};
use eframe::egui::{
    Id, Key, Popup, PopupCloseBehavior, Role, ScrollArea, Sense, StrokeKind, TextEdit, Ui,
    WidgetInfo, vec2,
};

use super::hamnosys::{drawings, explain, paint, short};
use crate::context::PaneInput;
use crate::script::edit;
use crate::words::{Language, hamnosys as words};

/// The side of a symbol's cell, and the height of the symbol in it, in points.
const CELL: f32 = 36.0;
const EM: f32 = 24.0;

/// Draws the button that opens the board; returns whether a symbol was added to `text` or removed from it.
pub(crate) fn button(ui: &mut Ui, seen: &PaneInput<'_>, text: &mut String) -> bool {
    let response = ui.button(seen.say(words::BOARD));
    let screen = ui.ctx().content_rect().size();
    let filter = response.id.with("filter");
    let popup = Popup::from_toggle_button_response(&response)
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .accessible_name(seen.say(words::BOARD));
    let shown = popup.show(|ui| {
        ui.set_width((13.0 * (CELL + 4.0) + 12.0).min(screen.x - 48.0));
        ui.set_max_height((screen.y - 120.0).min(440.0));
        board(ui, seen, filter, response.clicked(), text)
    });
    shown.is_some_and(|it| it.inner)
}

fn board(ui: &mut Ui, seen: &PaneInput<'_>, id: Id, fresh: bool, text: &mut String) -> bool {
    let mut typed: String = ui.data(|data| data.get_temp(id)).unwrap_or_default();
    let hint = seen.say(words::FIND);
    let mut changed = false;
    ui.horizontal(|ui| {
        let width = ui.available_width() - 90.0;
        let field = TextEdit::singleline(&mut typed)
            .id(id.with("field"))
            .hint_text(hint)
            .desired_width(width);
        let field = edit::edged(ui, |ui| ui.add(field));
        field.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, hint));
        if fresh {
            field.request_focus();
        }
        changed = ui.button(seen.say(words::TAKE_BACK)).clicked() && take_back(text);
        let enter = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        if let Some(symbol) = fitting(&typed, seen.language)
            .first()
            .filter(|_| enter && !typed.is_empty())
        {
            add(text, *symbol);
            typed.clear();
            changed = true;
            field.request_focus();
        }
    });
    let all = fitting(&typed, seen.language);
    if all.is_empty() {
        ui.label(seen.say(words::NO_SYMBOL));
    }
    ScrollArea::vertical()
        .id_salt("symbols")
        .auto_shrink([false, true])
        .show(ui, |ui| {
            for (class, title) in words::CLASSES {
                let symbols: Vec<Symbol> = all
                    .iter()
                    .copied()
                    .filter(|it| it.class() == class)
                    .collect();
                if symbols.is_empty() {
                    continue;
                }
                ui.weak(seen.say(title));
                ui.horizontal_wrapped(|ui| {
                    ui.spacing_mut().item_spacing = vec2(4.0, 4.0);
                    for symbol in symbols {
                        if cell(ui, seen, symbol) {
                            add(text, symbol);
                            changed = true;
                        }
                    }
                });
            }
        });
    ui.data_mut(|data| data.insert_temp(id, typed));
    changed
}

fn cell(ui: &mut Ui, seen: &PaneInput<'_>, symbol: Symbol) -> bool {
    let (rect, response) = ui.allocate_exact_size(vec2(CELL, CELL), Sense::click());
    let meaning = words::meaning(short(symbol), seen.language).unwrap_or_default();
    response.widget_info(|| {
        WidgetInfo::labeled(Role::Button, true, format!("{}: {meaning}", short(symbol)))
    });
    let visuals = ui.style().interact(&response);
    ui.painter().rect(
        rect,
        4.0,
        visuals.weak_bg_fill,
        visuals.bg_stroke,
        StrokeKind::Inside,
    );
    let wide = drawings().get(&symbol).map_or(0.0, |it| it.width * EM);
    paint(ui, rect.center() - vec2(wide, EM) / 2.0, EM, symbol);
    response
        .on_hover_ui(|ui| explain(ui, seen, symbol))
        .clicked()
}

/// Returns the symbols whose name or meaning contains the typed text; names that begin with it come first.
fn fitting(typed: &str, language: Language) -> Vec<Symbol> {
    let typed = typed.trim().to_lowercase();
    let typed = typed.strip_prefix("ham").unwrap_or(&typed);
    let rank = |symbol: &Symbol| {
        let name = short(*symbol);
        let meaning = || {
            words::meaning(name, language)
                .unwrap_or_default()
                .to_lowercase()
        };
        match name.find(typed) {
            Some(0) => Some(0),
            Some(_) => Some(1),
            None => meaning().contains(typed).then_some(2),
        }
    };
    let mut all: Vec<(u8, Symbol)> = Symbol::all()
        .filter(|symbol| symbol.class() != Class::Punctuation)
        .filter_map(|symbol| Some((rank(&symbol)?, symbol)))
        .collect();
    all.sort_by_key(|(rank, _)| *rank);
    all.into_iter().map(|(_, symbol)| symbol).collect()
}

/// Appends a symbol: as a character if the text contains symbol characters, else by its name.
fn add(text: &mut String, symbol: Symbol) {
    if text.chars().any(is_symbol) {
        text.push(symbol.char());
        return;
    }
    if !text.is_empty() && !text.ends_with(' ') {
        text.push(' ');
    }
    text.push_str(symbol.name());
}

/// Removes the last symbol; returns whether there was one.
fn take_back(text: &mut String) -> bool {
    let kept = text.trim_end();
    let end = match kept.chars().next_back() {
        None => return false,
        Some(last) if is_symbol(last) => kept.len() - last.len_utf8(),
        Some(_) => kept.rfind(char::is_whitespace).unwrap_or(0),
    };
    text.truncate(end);
    text.truncate(text.trim_end().len());
    true
}

fn is_symbol(c: char) -> bool {
    ('\u{e000}'..='\u{f8ff}').contains(&c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_are_added_to_the_text_and_removed_again() {
        let [fist, up] =
            ["fist", "extfingeru"].map(|name| Symbol::from_name(name).expect("a symbol"));
        for (before, after) in [
            ("", "hamfist"),
            ("hamextfingeru", "hamextfingeru hamfist"),
            ("hamextfingeru ", "hamextfingeru hamfist"),
            ("\u{e020}", "\u{e020}\u{e000}"),
        ] {
            let mut text = before.to_owned();
            add(&mut text, fist);
            assert_eq!(text, after);
            assert!(take_back(&mut text));
            assert_eq!(text, before.trim_end());
        }
        let mut none = String::new();
        assert!(!take_back(&mut none));
        add(&mut none, up);
        assert_eq!(none, "hamextfingeru");
    }

    #[test]
    fn symbols_are_found_by_name_and_by_meaning() {
        assert_eq!(fitting("chin", Language::English)[0].name(), "hamchin");
        assert_eq!(fitting("hamchin", Language::English)[0].name(), "hamchin");
        let french: Vec<_> = fitting("menton", Language::French)
            .iter()
            .map(|it| it.name())
            .collect();
        assert!(french.contains(&"hamchin"), "{french:?}");
        assert_eq!(fitting("", Language::English).len(), 209 - 9);
        assert!(fitting("nothing such", Language::English).is_empty());
    }

    #[test]
    fn every_symbol_has_a_class_with_a_title() {
        for symbol in Symbol::all().filter(|it| it.class() != Class::Punctuation) {
            assert!(
                words::CLASSES
                    .iter()
                    .any(|(class, _)| *class == symbol.class()),
                "{symbol}"
            );
        }
    }
}
