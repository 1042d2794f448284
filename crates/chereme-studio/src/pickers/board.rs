//! The board of all HamNoSys symbols, to write a notation by picking.

use chereme_sign::hamnosys::{HamnosysSymbol, SymbolClass};
use eframe::egui::{
    Id, Key, Popup, PopupCloseBehavior, Role, ScrollArea, Sense, StrokeKind, TextEdit, Ui, WidgetInfo, vec2,
};

use super::pickers_hamnosys::{all_symbol_drawings, explain_hamnosys_symbol, paint_hamnosys_symbol, short_symbol_name};
use crate::context::PaneInput;
use crate::script::script_edit;
use crate::words::{InterfaceLanguage, hamnosys_words as words};

/// The side of a symbol's cell, and the height of the symbol in it, in points.
const SYMBOL_CELL_SIZE_POINTS: f32 = 36.0;
const SYMBOL_CELL_EM_POINTS: f32 = 24.0;

/// Draws the button that opens the board; returns whether a symbol was added to `text` or removed from it.
pub(crate) fn draw_symbol_board_button(ui: &mut Ui, seen: &PaneInput<'_>, text: &mut String) -> bool {
    let response = ui.button(seen.say_text(words::BOARD));
    let screen = ui.ctx().content_rect().size();
    let filter = response.id.with("filter");
    let popup = Popup::from_toggle_button_response(&response)
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .accessible_name(seen.say_text(words::BOARD));
    let shown = popup.show(|ui| {
        ui.set_width((13.0 * (SYMBOL_CELL_SIZE_POINTS + 4.0) + 12.0).min(screen.x - 48.0));
        ui.set_max_height((screen.y - 120.0).min(440.0));
        board(ui, seen, filter, response.clicked(), text)
    });
    shown.is_some_and(|popup| popup.inner)
}

fn board(ui: &mut Ui, seen: &PaneInput<'_>, id: Id, fresh: bool, text: &mut String) -> bool {
    let mut typed: String = ui.data(|data| data.get_temp(id)).unwrap_or_default();
    let hint = seen.say_text(words::FIND);
    let mut changed = false;
    ui.horizontal(|ui| {
        let width = ui.available_width() - 90.0;
        let text_edit = TextEdit::singleline(&mut typed)
            .id(id.with("field"))
            .hint_text(hint)
            .desired_width(width);
        let field = script_edit::draw_with_text_edge(ui, |ui| ui.add(text_edit));
        field.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, hint));
        if fresh {
            field.request_focus();
        }
        changed = ui.button(seen.say_text(words::TAKE_BACK)).clicked() && take_back(text);
        let enter = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        if let Some(symbol) = find_matching_symbols(&typed, seen.language)
            .first()
            // Enter takes the first of the symbols found; with nothing typed that would be any.
            .filter(|_| enter && !typed.is_empty())
        {
            append_symbol_text(text, *symbol);
            typed.clear();
            changed = true;
            field.request_focus();
        }
    });
    let all = find_matching_symbols(&typed, seen.language);
    if all.is_empty() {
        ui.label(seen.say_text(words::NO_SYMBOL));
    }
    ScrollArea::vertical()
        .id_salt("symbols")
        .auto_shrink([false, true])
        .show(ui, |ui| {
            for (class, title) in words::SYMBOL_CLASS_TITLES {
                let symbols: Vec<HamnosysSymbol> = all
                    .iter()
                    .copied()
                    .filter(|symbol| symbol.symbol_class() == class)
                    .collect();
                if symbols.is_empty() {
                    continue;
                }
                ui.weak(seen.say_text(title));
                ui.horizontal_wrapped(|ui| {
                    ui.spacing_mut().item_spacing = vec2(4.0, 4.0);
                    for symbol in symbols {
                        if draw_symbol_cell(ui, seen, symbol) {
                            append_symbol_text(text, symbol);
                            changed = true;
                        }
                    }
                });
            }
        });
    ui.data_mut(|data| data.insert_temp(id, typed));
    changed
}

fn draw_symbol_cell(ui: &mut Ui, seen: &PaneInput<'_>, symbol: HamnosysSymbol) -> bool {
    let (rect, response) =
        ui.allocate_exact_size(vec2(SYMBOL_CELL_SIZE_POINTS, SYMBOL_CELL_SIZE_POINTS), Sense::click());
    let meaning = words::symbol_meaning(short_symbol_name(symbol), seen.language).unwrap_or_default();
    response
        .widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("{}: {meaning}", short_symbol_name(symbol))));
    let visuals = ui.style().interact(&response);
    ui.painter()
        .rect(rect, 4.0, visuals.weak_bg_fill, visuals.bg_stroke, StrokeKind::Inside);
    let wide = all_symbol_drawings()
        .get(&symbol)
        .map_or(0.0, |drawing| drawing.width * SYMBOL_CELL_EM_POINTS);
    paint_hamnosys_symbol(
        ui,
        rect.center() - vec2(wide, SYMBOL_CELL_EM_POINTS) / 2.0,
        SYMBOL_CELL_EM_POINTS,
        symbol,
    );
    response
        .on_hover_ui(|ui| explain_hamnosys_symbol(ui, seen, symbol))
        .clicked()
}

/// Returns the symbols whose name or meaning contains the typed text; names that begin with it come first.
fn find_matching_symbols(typed: &str, language: InterfaceLanguage) -> Vec<HamnosysSymbol> {
    let lower_text = typed.trim().to_lowercase();
    let typed = lower_text.strip_prefix("ham").unwrap_or(&lower_text);
    let rank = |symbol: &HamnosysSymbol| {
        let name = short_symbol_name(*symbol);
        let meaning = || words::symbol_meaning(name, language).unwrap_or_default().to_lowercase();
        match name.find(typed) {
            Some(0) => Some(0),
            Some(_) => Some(1),
            None => meaning().contains(typed).then_some(2),
        }
    };
    let mut all: Vec<(u8, HamnosysSymbol)> = HamnosysSymbol::all_symbols()
        .filter(|symbol| symbol.symbol_class() != SymbolClass::Punctuation)
        .filter_map(|symbol| Some((rank(&symbol)?, symbol)))
        .collect();
    all.sort_by_key(|(rank, _)| *rank);
    all.into_iter().map(|(_, symbol)| symbol).collect()
}

/// Appends a symbol: as a character if the text contains symbol characters, else by its name.
fn append_symbol_text(text: &mut String, symbol: HamnosysSymbol) {
    if text.chars().any(is_symbol) {
        text.push(symbol.symbol_char());
        return;
    }
    if !text.is_empty() && !text.ends_with(' ') {
        text.push(' ');
    }
    text.push_str(symbol.symbol_name());
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
        let [fist, up] = ["fist", "extfingeru"].map(|name| HamnosysSymbol::from_symbol_name(name).expect("a symbol"));
        for (before, after) in [
            ("", "hamfist"),
            ("hamextfingeru", "hamextfingeru hamfist"),
            ("hamextfingeru ", "hamextfingeru hamfist"),
            ("\u{e020}", "\u{e020}\u{e000}"),
        ] {
            let mut text = before.to_owned();
            append_symbol_text(&mut text, fist);
            assert_eq!(text, after);
            assert!(take_back(&mut text));
            assert_eq!(text, before.trim_end());
        }
        let mut none = String::new();
        assert!(!take_back(&mut none));
        append_symbol_text(&mut none, up);
        assert_eq!(none, "hamextfingeru");
    }

    #[test]
    fn symbols_are_found_by_name_and_by_meaning() {
        assert_eq!(
            find_matching_symbols("chin", InterfaceLanguage::English)[0].symbol_name(),
            "hamchin"
        );
        assert_eq!(
            find_matching_symbols("hamchin", InterfaceLanguage::English)[0].symbol_name(),
            "hamchin"
        );
        let french: Vec<_> = find_matching_symbols("menton", InterfaceLanguage::French)
            .iter()
            .map(|it| it.symbol_name())
            .collect();
        assert!(french.contains(&"hamchin"), "{french:?}");
        assert_eq!(find_matching_symbols("", InterfaceLanguage::English).len(), 209 - 9);
        assert!(find_matching_symbols("nothing such", InterfaceLanguage::English).is_empty());
    }

    #[test]
    fn every_symbol_has_a_class_with_a_title() {
        for symbol in HamnosysSymbol::all_symbols().filter(|it| it.symbol_class() != SymbolClass::Punctuation) {
            assert!(
                words::SYMBOL_CLASS_TITLES
                    .iter()
                    .any(|(class, _)| *class == symbol.symbol_class()),
                "{symbol}"
            );
        }
    }
}
