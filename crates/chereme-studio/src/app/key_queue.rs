//! Keys that were pressed and have not been handed out, in their order, and who gets them.

use std::collections::VecDeque;
use std::time::Duration;

use eframe::egui::{Context, Event, InputState, Key, Popup};

use super::Studio;
use crate::action::{Action, ActionMenu, ActionOwner};
use crate::command::WindowCommand;
use crate::keys::KeyContext;
use crate::layout::PaneKind;
use crate::panes::timeline;
use crate::words::{fill_text_braces, timeline as words};
use crate::work::WorkLane;
use crate::{clipboard, layout};

/// The keys that wait.
#[derive(Debug, Default)]
pub(crate) struct KeyQueue {
    events: VecDeque<Event>,
    /// Whether the last frame handed out a key that may close a field, which loses the focus only in this frame.
    rests: bool,
}

impl KeyQueue {
    /// Moves the keys and the text of a frame to the end of the queue. While other keys wait there, the repeats of a key
    /// that is held are left out, so that it does not go on after it was released.
    pub(crate) fn collect_frame_keys(&mut self, input: &mut InputState) {
        let waiting = !self.events.is_empty();
        let mut left_out = false;
        let holds_alt = holds_alt_key(input);
        for mut event in std::mem::take(&mut input.events) {
            // The system may report AltGr as no modifier at all, and Ctrl+AltGr+Q would be Ctrl+Q.
            if let Event::Key { modifiers, .. } = &mut event {
                modifiers.alt |= holds_alt && (modifiers.ctrl || modifiers.command);
            }
            let was_left_out = std::mem::take(&mut left_out);
            match &event {
                Event::Key {
                    pressed: true,
                    repeat: true,
                    ..
                } if waiting => left_out = true,
                // The text that a held key types is left out with it.
                Event::Text(_) if was_left_out => {}
                Event::Key { pressed: true, .. }
                | Event::Text(_)
                | Event::Ime(_)
                | Event::Copy
                | Event::Cut
                | Event::Paste(_) => self.events.push_back(event),
                _ => input.events.push(event),
            }
        }
    }

    /// Returns the next key.
    pub(crate) fn next_event(&self) -> Option<&Event> {
        self.events.front()
    }

    /// Removes the next key, for the widgets.
    pub(crate) fn take_event(&mut self) -> Option<Event> {
        self.events.pop_front()
    }

    /// Removes the next key, which has an action, and returns the text to paste if it is a paste.
    pub(crate) fn take_shortcut(&mut self) -> Option<String> {
        match self.events.pop_front()? {
            Event::Paste(text) => Some(text),
            Event::Key { key, .. } => {
                // The letter of a shortcut is no text for a field that is open or that the action opens.
                let letter = key == Key::Space || key.symbol_or_name().chars().count() == 1;
                if letter && matches!(self.events.front(), Some(Event::Text(_))) {
                    self.events.pop_front();
                }
                None
            }
            _ => None,
        }
    }

    /// Forgets all keys, and returns the text among them.
    pub(crate) fn forget_text(&mut self) -> String {
        let all = self.events.drain(..).map(|event| match event {
            Event::Text(text) | Event::Paste(text) => text,
            _ => String::new(),
        });
        all.collect()
    }
}

impl Studio {
    /// Hands out the pressed keys in their order. A frame takes either keys with actions, or keys for widgets up to one
    /// that may close a field, so that each key meets what the keys before it made; keys that depend on a running change
    /// wait for its end.
    pub(crate) fn take_keys(&mut self, ctx: &Context) {
        ctx.input_mut(|input| self.waiting.collect_frame_keys(input));
        // The field that lost the focus in the last frame is still there in this one.
        if std::mem::take(&mut self.waiting.rests) {
            ctx.request_repaint();
            return;
        }
        let (mut acted, mut passed) = (false, Vec::new());
        while let Some(event) = self.waiting.next_event() {
            let listens = self.overlays.takes_keys();
            let place = self.key_context(ctx);
            let action = self.keys.action_of(event, place).filter(|_| !listens);
            let begins = !listens && self.begins_value(event, place, ctx);
            let next = action.map(|entry| entry.0).or(begins.then_some(Action::EditValue));
            if !listens && self.must_wait(next, place) {
                ctx.request_repaint_after(Duration::from_millis(100));
                break;
            }
            // Actions and widgets take turns, so that each key meets the state before it.
            if next.is_some() && !passed.is_empty() || next.is_none() && acted {
                ctx.request_repaint();
                break;
            }
            let Some(next) = next else {
                let Some(event) = self.waiting.take_event() else {
                    break;
                };
                if !listens && self.keys.edits_elsewhere(&event, place) {
                    self.out.send_command(WindowCommand::Cannot(words::EDITS_ELSEWHERE));
                }
                let closes = may_close_field(&event);
                self.overlays.notices.may_close = closes && !place.menu && !place.typing;
                passed.push(event);
                if closes {
                    self.waiting.rests = true;
                    ctx.request_repaint();
                    break;
                }
                continue;
            };
            acted = true;
            if !begins {
                let text = self.waiting.take_shortcut();
                self.clipboard.store_pasted_text(text);
            }
            // A held key repeats only actions that bear it.
            if action.is_none_or(|(action, repeat)| !repeat || action.action_row().repeats) {
                self.focus_timeline(next, place);
                self.out.send_command(WindowCommand::Do(next));
                self.carry_out_commands(ctx);
            }
            if begins && !self.panes.timeline.is_typing() {
                // No field takes the letter.
                self.waiting.take_event();
            }
        }
        ctx.input_mut(|input| input.events.extend(passed));
    }

    /// Returns the state of the window that the meaning of keys depends on.
    fn key_context(&self, ctx: &Context) -> KeyContext {
        let pane = self.pane.filter(|pane| layout::is_pane_in_sight(&self.tree, *pane));
        let focused = ctx.memory(|memory| memory.focused());
        let in_rows = focused.is_none_or(|id| self.panes.timeline.has_row_widget(ctx, id));
        KeyContext {
            corpus: self.snapshot.is_some(),
            pane,
            coding: pane == Some(PaneKind::Timeline) && in_rows,
            typing: ctx.text_edit_focused() || self.panes.timeline.is_typing(),
            focused: focused.is_some(),
            held: self.panes.stage.is_held(ctx),
            marked: clipboard::is_text_marked(ctx),
            menu: Popup::is_any_open(ctx),
        }
    }

    /// Returns whether the event is a letter that begins the value of a gloss.
    fn begins_value(&self, event: &Event, place: KeyContext, ctx: &Context) -> bool {
        let letter = matches!(event, Event::Text(text) if text.starts_with(char::is_alphabetic));
        let free = place.coding && !place.typing && !place.menu;
        let plain = ctx.input(|input| !input.modifiers.alt && !input.modifiers.command);
        letter && free && plain && self.pane_input(ctx).is_some_and(|seen| timeline::is_on_gloss(&seen))
    }

    /// Returns whether a key waits, since its effect depends on a change that is being carried out. What was typed waits
    /// in the timeline only, and the time of the playhead is not awaited.
    fn must_wait(&self, action: Option<Action>, place: KeyContext) -> bool {
        let mut running = self.desk.iter().flat_map(|desk| desk.running.values());
        let changing = running.any(|work| work.about.lane == WorkLane::Edit && !work.about.may_stop);
        if place.typing || !(changing || self.panes.timeline.awaits_selection()) {
            return false;
        }
        let Some(action) = action else {
            return place.coding;
        };
        let row = action.action_row();
        let looks = [ActionMenu::Stage, ActionMenu::View, ActionMenu::Play].contains(&row.menu);
        let selects = !looks && matches!(row.owner, ActionOwner::In(_) | ActionOwner::WithCorpus);
        (row.changes || selects) && !timeline::is_timed(action, &self.shown.player)
    }

    /// Gives the timeline the focus after a key that selects or changes something in it.
    fn focus_timeline(&mut self, action: Action, place: KeyContext) {
        let row = action.action_row();
        let coding = [
            ActionMenu::Annotation,
            ActionMenu::Value,
            ActionMenu::Timing,
            ActionMenu::Tier,
        ]
        .contains(&row.menu);
        let timeline = matches!(row.owner, ActionOwner::In(PaneKind::Timeline));
        if coding && timeline && !place.typing && layout::is_pane_in_sight(&self.tree, PaneKind::Timeline) {
            self.pane = Some(PaneKind::Timeline);
        }
    }

    /// Forgets the keys that waited for a change that was refused, and reports the text among them.
    pub(crate) fn forget_keys(&mut self) {
        let text = self.waiting.forget_text();
        if !text.is_empty() {
            let language = self.settings.language;
            let text = fill_text_braces(words::KEYS_FORGOTTEN.text_in_language(language), &[("text", &text)]);
            let remedy = words::KEYS_FORGOTTEN_REMEDY.text_in_language(language);
            self.overlays.notices.add_lasting_notice(&text, Some(remedy));
        }
    }
}

/// Returns whether an Alt key or AltGr is held in a frame, or was for a part of it.
fn holds_alt_key(input: &InputState) -> bool {
    let is_alt = |key: &Key| [Key::AltLeft, Key::AltRight].contains(key);
    let mut events = input.events.iter();
    input.keys_down.iter().any(is_alt) || events.any(|event| matches!(event, Event::Key { key, .. } if is_alt(key)))
}

/// Returns whether a key may close the field that gets it, so that the keys after it are for something else.
pub(crate) fn may_close_field(event: &Event) -> bool {
    matches!(
        event,
        Event::Key {
            key: Key::Enter | Key::Tab | Key::Escape,
            ..
        }
    )
}

#[cfg(test)]
mod tests {
    use std::path::{Path, PathBuf};
    use std::sync::Arc;

    use chereme_corpus::{
        AnnotationColumns, Corpus, ImportOptions, NewTier, ProgressReceiver, RowName, TierRole, ignore_progress_step,
        requests,
    };
    use eframe::egui::{Modifiers, ViewportCommand};
    use egui_kittest::Harness;

    use super::*;
    use crate::StudioOptions;
    use crate::key_chord::KeyChord;

    const CTRL: Modifiers = Modifiers::COMMAND;
    const SHIFT: Modifiers = Modifiers::SHIFT;

    /// Returns a corpus with a recording of a minute and a tier of glosses, all of them AIMER.
    fn corpus_of_glosses(folder: &Path, count: i64) -> PathBuf {
        let file = folder.join("take.eaf");
        let text = r#"<?xml version="1.0" encoding="UTF-8"?>
            <ANNOTATION_DOCUMENT AUTHOR="" DATE="2026-01-01T00:00:00+00:00" FORMAT="3.0" VERSION="3.0">
            <HEADER MEDIA_FILE="" TIME_UNITS="milliseconds"/>
            <TIME_ORDER><TIME_SLOT TIME_SLOT_ID="t1" TIME_VALUE="0"/>
            <TIME_SLOT TIME_SLOT_ID="t2" TIME_VALUE="60000"/></TIME_ORDER>
            <TIER LINGUISTIC_TYPE_REF="text" TIER_ID="Notes"><ANNOTATION>
            <ALIGNABLE_ANNOTATION ANNOTATION_ID="a1" TIME_SLOT_REF1="t1" TIME_SLOT_REF2="t2">
            <ANNOTATION_VALUE>take</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION></TIER>
            <LINGUISTIC_TYPE LINGUISTIC_TYPE_ID="text" TIME_ALIGNABLE="true" GRAPHIC_REFERENCES="false"/>
            </ANNOTATION_DOCUMENT>"#;
        std::fs::write(&file, text).expect("written");
        let path = folder.join("glosses.chereme");
        let mut corpus = Corpus::create_corpus(&path, "A").expect("made");
        let mut hear = ignore_progress_step;
        let mut progress = ProgressReceiver::new(&mut hear);
        let options = ImportOptions::default();
        let imported = corpus.import_paths(&[file], &options, &mut progress);
        imported.expect("imported");
        let gloss = NewTier::new(RowName::Text("take".into()), "Gloss", TierRole::Gloss);
        let tier = corpus.add_tier(&gloss).expect("a tier").id;
        let all: Vec<_> = (0..count)
            .map(|at| requests::add_annotation_change(tier, at * 100_000, at * 100_000 + 80_000, "AIMER"))
            .collect();
        if !all.is_empty() {
            let added = corpus.annotate_corpus(&all, &Default::default(), &mut progress);
            added.expect("annotated");
        }
        path
    }

    /// Returns the spans and values of the glosses.
    fn glosses(path: &Path) -> Vec<(i64, i64, String)> {
        let corpus = Corpus::open_corpus(path, "reader").expect("opened");
        let recording = corpus.load_corpus_overview(1).expect("read").recordings[0].row.id;
        let contents = corpus.load_recording_contents(recording).expect("read");
        let tier = contents.tiers.iter().find(|it| it.row.name == "Gloss");
        let columns: &AnnotationColumns = &tier.expect("a tier").annotations;
        let row = |at: usize| (columns.starts[at], columns.ends[at], columns.values[at].to_string());
        (0..columns.len()).map(row).collect()
    }

    #[test]
    fn only_ctrl_and_the_letter_alone_quit() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut window = opened(&corpus_of_glosses(folder.path(), 0), Duration::ZERO);
        let mut quits = |modifiers| {
            let mut commands = Vec::new();
            window.input_mut().events.extend(pressed(modifiers, Key::Q));
            for _ in 0..3 {
                window.step();
                let viewports = window.output().viewport_output.values();
                commands.extend(viewports.flat_map(|viewport| viewport.commands.clone()));
            }
            commands.contains(&ViewportCommand::Close)
        };
        assert!(!quits(CTRL | Modifiers::ALT) && !quits(CTRL | SHIFT));
        assert!(quits(CTRL));
    }

    #[test]
    fn a_shortcut_with_ctrl_is_another_one_while_alt_gr_is_held() {
        let chord_of_q = |held: Option<Key>, alt: bool| {
            let ctrl = Modifiers { alt, ..CTRL };
            let held = held.map(|key| pressed(Modifiers::NONE, key)[0].clone());
            let mut input = InputState::default();
            input.events = held.into_iter().chain([pressed(ctrl, Key::Q)[0].clone()]).collect();
            let mut queue = KeyQueue::default();
            queue.collect_frame_keys(&mut input);
            let Some(Event::Key { key, modifiers, .. }) = queue.events.pop_back() else {
                panic!("the key");
            };
            KeyChord::new(key, modifiers).to_string()
        };
        assert_eq!(chord_of_q(None, false), "Ctrl+Q");
        assert_eq!(chord_of_q(None, true), "Ctrl+Alt+Q");
        for alt in [Key::AltLeft, Key::AltRight] {
            assert_eq!(chord_of_q(Some(alt), false), "Ctrl+Alt+Q");
        }
        // A frame later the key is still held.
        let mut input = InputState::default();
        input.keys_down.insert(Key::AltRight);
        assert!(holds_alt_key(&input));
    }

    fn pressed(modifiers: Modifiers, key: Key) -> [Event; 2] {
        [true, false].map(|pressed| Event::Key {
            key,
            physical_key: None,
            pressed,
            repeat: false,
            modifiers,
        })
    }

    /// Returns the events of a text, typed letter by letter.
    fn typed(text: &str) -> Vec<Event> {
        let letter = |letter: char| {
            let key = Key::from_name(&letter.to_string()).expect("a key");
            let [down, up] = pressed(Modifiers::NONE, key);
            [down, Event::Text(letter.to_string()), up]
        };
        text.chars().flat_map(letter).collect()
    }

    /// Returns a window with a corpus; its threads rest that long after each message.
    fn opened<'a>(corpus: &Path, rest: Duration) -> Harness<'a, Studio> {
        let mut studio = Studio::new(StudioOptions {
            corpus: Some(corpus.to_owned()),
            ..StudioOptions::default()
        });
        studio.wake = Arc::new(move || std::thread::sleep(rest));
        let mut window = Harness::builder()
            .with_size([1000.0, 700.0])
            .with_step_dt(1.0 / 60.0)
            .build_ui_state(|ui, studio: &mut Studio| studio.ui(ui), studio);
        settle(&mut window);
        // The timeline alone, whose frames are quick.
        let keys = [pressed(SHIFT, Key::F3), pressed(Modifiers::NONE, Key::F11)];
        feed(&mut window, keys.as_flattened(), 1);
        window
    }

    /// Draws frames until the window is idle with its corpus.
    fn settle(window: &mut Harness<'_, Studio>) {
        for _ in 0..60_000 {
            window.step();
            let studio = window.state();
            let shown = studio.snapshot.as_ref().is_some_and(|it| it.open.is_some());
            if studio.is_idle() && shown {
                window.run_steps(2);
                return;
            }
            std::thread::sleep(Duration::from_millis(4));
        }
        panic!("never idle");
    }

    /// Draws frames that get this many events each.
    fn feed(window: &mut Harness<'_, Studio>, events: &[Event], pace: usize) {
        for part in events.chunks(pace) {
            window.input_mut().events.extend_from_slice(part);
            window.step();
        }
        settle(window);
    }

    /// Glosses that end in digits, which mean values on a tier.
    fn wanted(count: usize) -> Vec<String> {
        let stems = ["TEST", "HUIS-", "INDEX", "MAINS"].iter().cycle();
        let numbered = stems.zip(1..=count);
        numbered.map(|(stem, n)| format!("{stem}{n}")).collect()
    }

    #[test]
    fn glosses_typed_at_any_speed_replace_the_selected_ones_and_no_others() {
        for (count, pace, rest) in [(200, 9, 5), (20, 1, 0), (20, 900, 0)] {
            let folder = tempfile::tempdir().expect("a folder");
            let wanted = wanted(count);
            let path = corpus_of_glosses(folder.path(), count as i64);
            let mut window = opened(&path, Duration::from_millis(rest));
            let mut events = pressed(CTRL, Key::ArrowDown).to_vec();
            events.extend(pressed(Modifiers::ALT, Key::Home));
            for gloss in &wanted {
                events.extend(typed(gloss));
                events.extend(pressed(Modifiers::NONE, Key::Enter));
                events.extend(pressed(Modifiers::ALT, Key::ArrowRight));
            }
            feed(&mut window, &events, pace);
            let values: Vec<String> = glosses(&path).into_iter().map(|it| it.2).collect();
            assert_eq!(values, wanted, "{pace} {rest}");
        }
    }

    #[test]
    fn glosses_are_begun_ended_and_typed_without_waiting() {
        for (count, pace, rest) in [(200, 5, 5), (20, 1, 0)] {
            let folder = tempfile::tempdir().expect("a folder");
            let wanted = wanted(count);
            let path = corpus_of_glosses(folder.path(), 0);
            let mut window = opened(&path, Duration::from_millis(rest));
            let mut events = pressed(CTRL, Key::ArrowDown).to_vec();
            for gloss in &wanted {
                events.extend(pressed(SHIFT, Key::Enter));
                events.extend(pressed(CTRL, Key::ArrowRight));
                events.extend(pressed(CTRL, Key::ArrowRight));
                events.extend(pressed(SHIFT, Key::Enter));
                events.extend(typed(gloss));
                events.extend(pressed(Modifiers::NONE, Key::Enter));
            }
            feed(&mut window, &events, pace);
            let found = glosses(&path);
            for (at, (row, gloss)) in found.iter().zip(&wanted).enumerate() {
                let start = 80_000 * at as i64;
                assert_eq!(row, &(start, start + 80_000, gloss.clone()), "{pace} {rest}");
            }
            assert_eq!(found.len(), wanted.len());
        }
    }

    #[test]
    fn the_letter_of_a_shortcut_is_no_text() {
        let mut queue = KeyQueue::default();
        let mut input = InputState::default();
        let [down, up] = pressed(Modifiers::ALT, Key::N);
        let text = |text: &str| Event::Text(text.to_owned());
        input.events = vec![
            down,
            text("n"),
            up.clone(),
            pressed(SHIFT, Key::F2)[0].clone(),
            text("y"),
        ];
        queue.collect_frame_keys(&mut input);
        assert_eq!(input.events, [up]);
        assert_eq!(queue.take_shortcut(), None);
        assert_eq!(queue.take_shortcut(), None);
        assert_eq!(queue.take_event(), Some(text("y")));
    }

    #[test]
    fn a_held_key_does_not_go_on_behind_keys_that_wait() {
        let mut queue = KeyQueue::default();
        let mut input = InputState::default();
        let [mut held, _] = pressed(Modifiers::NONE, Key::A);
        let text = Event::Text("a".to_owned());
        for repeats in [false, true, true] {
            if let Event::Key { repeat, .. } = &mut held {
                *repeat = repeats;
            }
            input.events = vec![held.clone(), text.clone()];
            queue.collect_frame_keys(&mut input);
        }
        assert_eq!(queue.forget_text(), "a");
        queue.collect_frame_keys(&mut InputState::default());
        assert_eq!(queue.next_event(), None);
    }
}
