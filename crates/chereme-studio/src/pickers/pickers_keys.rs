//! Keyboard input of a picker.

use eframe::egui::{Event, Key, Modifiers, Ui};

use super::pickers_data::StepDirection;

/// The keys pressed in a picker in this frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct PickerKeys {
    pub(super) direction: Option<StepDirection>,
    pub(super) enter: bool,
    /// The index of the cell picked by a digit key.
    pub(super) digit: Option<usize>,
}

const PICKER_DIGIT_KEYS: [Key; 9] = [
    Key::Num1,
    Key::Num2,
    Key::Num3,
    Key::Num4,
    Key::Num5,
    Key::Num6,
    Key::Num7,
    Key::Num8,
    Key::Num9,
];

/// Removes the picker's keys from the input; `digits` says whether digits work without Ctrl.
pub(super) fn take_picker_keys(ui: &Ui, digits: bool) -> PickerKeys {
    ui.input_mut(|input| {
        let mut pressed = |key| input.consume_key(Modifiers::NONE, key);
        let direction = [
            (Key::ArrowLeft, StepDirection::Left),
            (Key::ArrowRight, StepDirection::Right),
            (Key::ArrowUp, StepDirection::Up),
            (Key::ArrowDown, StepDirection::Down),
        ]
        .into_iter()
        .find(|(key, _)| pressed(*key))
        .map(|(_, direction)| direction);
        let enter = pressed(Key::Enter);
        let mut digit = PICKER_DIGIT_KEYS
            .iter()
            .position(|key| input.consume_key(Modifiers::COMMAND, *key));
        if digits && digit.is_none() {
            digit = PICKER_DIGIT_KEYS
                .iter()
                .position(|key| input.consume_key(Modifiers::NONE, *key));
            if let Some(digit) = digit {
                let typed = (digit + 1).to_string();
                input
                    .events
                    .retain(|event| !matches!(event, Event::Text(text) if *text == typed));
            }
        }
        PickerKeys {
            direction,
            enter,
            digit,
        }
    })
}
