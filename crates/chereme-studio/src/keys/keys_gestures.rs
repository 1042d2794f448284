//! The table of mouse gestures, which the help shows next to the keys.

use crate::action::ActionMenu;
use crate::words::{InterfaceLanguage, InterfaceText, gestures_words as words, key_names as names};

/// A key that is held during the gesture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum HeldKey {
    Ctrl,
    Shift,
    Alt,
}

/// The action of the mouse.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum MouseAct {
    Click,
    DoubleClick,
    RightClick,
    Drag,
    /// Drag with the right or the middle button.
    OtherDrag,
    Wheel,
}

/// A row of the table.
#[derive(Debug)]
pub(crate) struct MouseGesture {
    /// The group of keys in the help that lists the gesture.
    pub(crate) menu: ActionMenu,
    pub(crate) held: Option<HeldKey>,
    pub(crate) act: MouseAct,
    /// The object of the gesture.
    pub(crate) on: InterfaceText,
    pub(crate) does: InterfaceText,
}

macro_rules! gestures {
    ($($menu:ident $([$held:ident])? $act:ident $on:ident $does:ident;)*) => {
        /// Every gesture, menu by menu.
        pub(crate) const GESTURES: &[MouseGesture] = &[
            $(MouseGesture {
                menu: ActionMenu::$menu,
                held: gestures!(@ $($held)?),
                act: MouseAct::$act,
                on: words::$on,
                does: words::$does,
            },)*
        ];
    };
    (@ $held:ident) => { Some(HeldKey::$held) };
    (@) => { None };
}

gestures! {
    Edit Click HIT OPEN_HIT;
    Edit Drag HIT TO_CARD;
    Edit RightClick HIT MENU_OF_SIGN;
    Edit [Ctrl] Click VALUE DETAILS;
    Edit Drag CARD_HANDLE MOVE_CARD;
    Annotation Click ANNOTATION SELECT;
    Annotation [Ctrl] Click ANNOTATION ALSO;
    Annotation [Alt] Click ANNOTATION ALSO;
    Annotation [Shift] Click ANNOTATION UP_TO;
    Annotation [Shift] Drag LANE FRAME;
    Annotation RightClick LANE MENU_OF_ANNOTATION;
    Annotation DoubleClick ANNOTATION TYPE;
    Annotation DoubleClick SELECTION MAKE_ON_SELECTION;
    Annotation Drag SELECTED MOVE;
    Annotation [Alt] Drag ANNOTATION MOVE;
    Annotation [Alt] Drag EMPTY MAKE;
    Timing Drag LANE SELECT_TIME;
    Timing [Shift] Click EMPTY EXTEND;
    Timing Drag EDGE RESIZE;
    Tier Click TIER_NAME CHOOSE_TIER;
    Tier Drag TIER_NAME ORDER_TIERS;
    Tier RightClick TIER_NAME MENU_OF_TIER;
    Play Click LANE PLAYHEAD;
    Play Drag RULER SCRUB;
    Stage Drag FIGURE ORBIT;
    Stage [Shift] Drag FIGURE PAN;
    Stage OtherDrag FIGURE PAN;
    Stage Wheel FIGURE NEARER;
    Stage Click PLACE_ON_BODY CHOOSE_PLACE;
    Stage DoubleClick FIGURE RESET;
    View [Ctrl] Wheel TIMELINE ZOOM;
    View [Shift] Wheel TIMELINE SCROLL_TIME;
    View Wheel TIMELINE SCROLL_TIERS;
    View [Alt] Drag RULER SCROLL_TIME;
    View Drag STRIP MOVE_VIEW;
}

impl MouseGesture {
    /// Returns the gesture as people read it: `Ctrl+click on an annotation`.
    pub(crate) fn gesture_text(&self, language: InterfaceLanguage) -> String {
        let act = match self.act {
            MouseAct::Click => words::CLICK,
            MouseAct::DoubleClick => words::DOUBLE_CLICK,
            MouseAct::RightClick => words::RIGHT_CLICK,
            MouseAct::Drag => words::DRAG,
            MouseAct::OtherDrag => words::OTHER_DRAG,
            MouseAct::Wheel => words::WHEEL,
        };
        let held_key = match self.held {
            Some(HeldKey::Ctrl) => Some(names::CTRL),
            Some(HeldKey::Shift) => Some(names::SHIFT),
            Some(HeldKey::Alt) => Some(names::ALT),
            None => None,
        };
        let key_prefix = held_key.map_or(String::new(), |key| format!("{}+", key.text_in_language(language)));
        format!(
            "{key_prefix}{} · {}",
            act.text_in_language(language),
            self.on.text_in_language(language)
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_gesture_has_one_meaning() {
        for (at, one) in GESTURES.iter().enumerate() {
            let text = one.gesture_text(InterfaceLanguage::English);
            let same = |it: &&MouseGesture| it.gesture_text(InterfaceLanguage::English) == text;
            assert!(!GESTURES[at + 1..].iter().any(|it| same(&it)), "{text}");
        }
        let also = GESTURES.iter().find(|it| it.does == words::ALSO);
        let text = also.map(|it| it.gesture_text(InterfaceLanguage::English));
        assert_eq!(text.as_deref(), Some("Ctrl+click · annotation"));
    }
}
