//! The names for assistive technology: every widget that can be used has a name, in every pane, at every size.

mod common;

use std::collections::BTreeSet;

use chereme_studio::{InterfaceLanguage, StudioOptions};
use common::*;
use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers, vec2};
use egui_kittest::kittest::{NodeT, Queryable};

/// The roles of widgets that a person can use.
const USED: [Role; 14] = [
    Role::Button,
    Role::DefaultButton,
    Role::CheckBox,
    Role::RadioButton,
    Role::ComboBox,
    Role::Link,
    Role::ListItem,
    Role::MenuItem,
    Role::Slider,
    Role::SpinButton,
    Role::Tab,
    Role::TextInput,
    Role::MultilineTextInput,
    Role::ColorWell,
];

/// Returns the widgets without a name, and the number of all widgets.
fn nameless(window: &Window<'_>) -> (BTreeSet<String>, usize) {
    let mut all = 0;
    let mut found = BTreeSet::new();
    for node in window.root().children_recursive() {
        let kit = node.accesskit_node();
        if kit.is_hidden() || !USED.contains(&kit.role()) {
            continue;
        }
        all += 1;
        let label = kit.label().unwrap_or_default();
        let value = kit.value().unwrap_or_default();
        // The text in a field is not its name; the text on a list is the choice.
        let typed = matches!(kit.role(), Role::TextInput | Role::MultilineTextInput);
        let said = if typed || !label.trim().is_empty() {
            label
        } else {
            value
        };
        let symbol = said.trim().chars().all(|letter| !letter.is_alphanumeric());
        if symbol && said.trim() != "?" {
            let within = node.parent().and_then(|it| it.accesskit_node().label());
            found.insert(format!("{:?} {said:?} in {within:?}", kit.role()));
        }
    }
    (found, all)
}

/// The least height and width of a button, in points; smaller ones are easily missed.
const LEAST: f32 = 14.0;

/// Returns the buttons that are smaller; annotations are left out, as their width is their duration.
fn tiny(window: &Window<'_>) -> BTreeSet<String> {
    let all = window.root().children_recursive();
    let small = all.filter(|node| {
        let kit = node.accesskit_node();
        let is_button = kit.role() == Role::Button && !kit.is_hidden();
        is_button && node.rect().size().min_elem() < LEAST
    });
    let named = small.filter_map(|node| {
        let label = node.accesskit_node().label()?;
        (!label.contains(": ")).then(|| format!("{label:?} {}", node.rect().size()))
    });
    named.collect()
}

/// Visits every pane in every layout.
fn walk(window: &mut Window<'_>, label: &str) {
    const LAYOUTS: [Key; 3] = [Key::F1, Key::F2, Key::F3];
    const PANES: [(Modifiers, Key); 11] = [
        (Modifiers::SHIFT, Key::F1),
        (Modifiers::SHIFT, Key::F2),
        (Modifiers::SHIFT, Key::F3),
        (Modifiers::SHIFT, Key::F4),
        (Modifiers::COMMAND, Key::F),
        (Modifiers::COMMAND, Key::R),
        (Modifiers::COMMAND, Key::H),
        (Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::I),
        (Modifiers::COMMAND.plus(Modifiers::ALT), Key::B),
        (Modifiers::COMMAND.plus(Modifiers::ALT), Key::O),
        (Modifiers::COMMAND.plus(Modifiers::ALT), Key::I),
    ];
    for layout in LAYOUTS {
        window.key_press_modifiers(Modifiers::COMMAND, layout);
        window.run_steps(2);
        for (modifiers, pane) in PANES {
            window.key_press_modifiers(modifiers, pane);
            window.run_steps(3);
            let (found, all) = nameless(window);
            assert!(found.is_empty(), "{label}, {layout:?} {pane:?}: {found:#?}");
            let tiny = tiny(window);
            assert!(tiny.is_empty(), "{label}, {layout:?} {pane:?}: {tiny:#?}");
            assert!(all > 20, "{label}, {layout:?} {pane:?}: only {all}");
        }
    }
    for (modifiers, overlay) in [
        (Modifiers::NONE, Key::F1),
        (Modifiers::COMMAND, Key::Comma),
        (Modifiers::COMMAND | Modifiers::SHIFT, Key::P),
        (Modifiers::COMMAND | Modifiers::SHIFT, Key::E),
        (Modifiers::COMMAND | Modifiers::SHIFT | Modifiers::ALT, Key::U),
    ] {
        window.key_press_modifiers(modifiers, overlay);
        window.run_steps(3);
        let (found, _) = nameless(window);
        assert!(found.is_empty(), "{label}, {overlay:?}: {found:#?}");
        window.key_press(Key::Escape);
        window.run_steps(3);
    }
}

#[test]
fn every_widget_has_a_name_in_a_window_large_and_small() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    click(&mut window, "Tier Gloss");
    walk(&mut window, "large");
    window.set_size(vec2(800.0, 600.0));
    window.run_steps(3);
    walk(&mut window, "small");
}

#[test]
fn every_widget_has_a_name_with_hits_and_a_generated_sign() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    window.key_press_modifiers(Modifiers::COMMAND, Key::F2);
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::F);
    window.run_steps(3);
    let text = "handshape Y";
    window.event(eframe::egui::Event::Text(text.to_owned()));
    window.run_steps(3);
    window.key_press(Key::Enter);
    window.run_steps(2);
    idle(&mut window);
    window.key_press(Key::ArrowDown);
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND | Modifiers::ALT, Key::R);
    window.run_steps(2);
    idle(&mut window);
    for action in ["Change…", "Then…"] {
        click(&mut window, action);
        let (found, _) = nameless(&window);
        assert!(found.is_empty(), "{action}: {found:#?}");
        window.key_press(Key::Escape);
        window.run_steps(2);
    }
    walk(&mut window, "made");
}

#[test]
fn the_start_page_has_names_in_french() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window(StudioOptions {
        language: InterfaceLanguage::French,
        ..options(folder.path())
    });
    window.run_steps(3);
    let (found, all) = nameless(&window);
    assert!(found.is_empty() && all > 8, "{all}: {found:#?}");
}

/// Returns the buttons and fields that the left or right edge of the window cuts.
fn cut(window: &Window<'_>) -> BTreeSet<String> {
    let whole = window.ctx.content_rect().x_range();
    let all = window.root().children_recursive();
    let cut = all.filter(|node| {
        let role = node.accesskit_node().role();
        if !matches!(role, Role::Button | Role::TextInput | Role::ComboBox) {
            return false;
        }
        let rect = node.rect();
        rect.left() < whole.min - 0.5 || rect.right() > whole.max + 0.5
    });
    cut.filter_map(|node| node.accesskit_node().label()).collect()
}

#[test]
fn menus_and_dialogues_are_in_reach_in_small_windows_in_either_language() {
    let folder = tempfile::tempdir().expect("a folder");
    let corpus = small_corpus(folder.path());
    let menus: [(InterfaceLanguage, &[&str]); 2] = [
        (
            InterfaceLanguage::English,
            &["File", "Edit", "Stage", "View", "Panes", "Help"],
        ),
        (
            InterfaceLanguage::French,
            &["Fichier", "Scène", "Affichage", "Panneaux", "Aide"],
        ),
    ];
    for (language, menus) in menus {
        let mut window = window(StudioOptions {
            corpus: Some(corpus.clone()),
            asked_language: Some(language),
            ..options(folder.path())
        });
        until(&mut window, "the corpus", |it| it.state().shown_generation().is_some());
        // These are the sizes of usual screens at twice the scale.
        for size in [vec2(640.0, 400.0), vec2(512.0, 384.0), vec2(1280.0, 800.0)] {
            window.set_size(size);
            window.run_steps(4);
            let tops = menus.iter().map(|menu| {
                let mut all = window.get_all_by_label(menu);
                let rect = all.next().expect("a menu").rect();
                assert!(rect.left() >= 0.0 && rect.right() <= size.x, "{menu} {rect}");
                rect.top()
            });
            let lines: BTreeSet<i32> = tops.map(|top| top.round() as i32).collect();
            assert!(lines.len() <= 2, "{lines:?}");
            // The names of the layouts stand beside the menus, or are left out; the menu View has them too.
            let layouts = ["Annotating", "Searching", "Annoter", "Rechercher"];
            for layout in layouts.iter().flat_map(|it| window.query_all_by_label(it)) {
                for menu in menus.iter().flat_map(|it| window.query_all_by_label(it)) {
                    let both = layout.rect().intersects(menu.rect());
                    assert!(!both, "{size}: {layout:?} covers {menu:?}");
                }
            }
            let before = cut(&window);
            for (modifiers, overlay) in [
                (Modifiers::NONE, Key::F1),
                (Modifiers::COMMAND, Key::Comma),
                (Modifiers::COMMAND | Modifiers::SHIFT, Key::P),
                (Modifiers::COMMAND | Modifiers::SHIFT, Key::E),
                (Modifiers::COMMAND | Modifiers::SHIFT | Modifiers::ALT, Key::U),
            ] {
                window.key_press_modifiers(modifiers, overlay);
                window.run_steps(4);
                let more: Vec<String> = cut(&window).difference(&before).cloned().collect();
                assert!(more.is_empty(), "{size} {overlay:?}: {more:?}");
                window.key_press(Key::Escape);
                window.run_steps(3);
            }
        }
    }
}
