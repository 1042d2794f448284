//! Values picked by looking, driven by their labels.

mod common;

use common::*;
use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;

fn query(window: &Window<'_>) -> String {
    let field = window.get_by_role_and_label(Role::TextInput, "Query");
    field.value().unwrap_or_default()
}

#[test]
fn a_handshape_is_picked_from_its_picture_and_by_keys() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    window.key_press_modifiers(Modifiers::COMMAND, Key::F);
    window.run_steps(3);
    click(&mut window, "Pick a value of configuration");
    let cell = "U, index and middle finger together";
    window.get_by_label(cell).click_accesskit();
    window.run_steps(2);
    idle(&mut window);
    assert_eq!(query(&window), "configuration=U");
    assert!(!has(&window, "Type to find a value"));
    click(&mut window, "Pick a value of placement");
    window.get_by_label("Type to find a value").type_text("chi");
    window.run_steps(3);
    assert!(has(&window, "Enter picks chin"));
    window.key_press(Key::ArrowDown);
    window.run_steps(2);
    assert!(has(&window, "Enter picks under-chin, under the chin"));
    window.key_press(Key::ArrowUp);
    window.run_steps(2);
    window.key_press(Key::Enter);
    window.run_steps(2);
    assert_eq!(query(&window), "configuration=U placement=chin");
}

#[test]
fn a_place_is_clicked_on_the_body() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    window.key_press_modifiers(Modifiers::COMMAND, Key::F);
    window.run_steps(3);
    click(&mut window, "Pick a value of placement");
    until(&mut window, "the body", |window| {
        has(window, "forehead, on the picture")
    });
    click(&mut window, "forehead, on the picture");
    idle(&mut window);
    assert_eq!(query(&window), "placement=forehead");
}
