//! The default keys: for each action those of ELAN 6.9, of Praat, and of video editors.
//!
//! Several keys are parted by blanks; `none` is none; `=` is the same as ELAN's.

use super::Keymap;
use crate::action::Action;
use crate::keys::chord::Chord;

/// Rows of action, ELAN, Praat, video editor.
pub(crate) const DEFAULTS: &[(Action, [&str; 3])] = &[
    (Action::Open, ["Ctrl+O", "=", "="]),
    (Action::Import, ["Ctrl+Shift+I", "=", "Ctrl+I"]),
    (Action::Export, ["Ctrl+Shift+E", "=", "="]),
    (Action::Close, ["Ctrl+W", "=", "="]),
    (Action::Settings, ["Ctrl+Comma", "=", "="]),
    (Action::Quit, ["Ctrl+Q", "=", "="]),
    (Action::Undo, ["Ctrl+Z", "=", "="]),
    (Action::Redo, ["Ctrl+Y Ctrl+Shift+Z", "=", "="]),
    (Action::Search, ["Ctrl+F", "=", "="]),
    (Action::SearchLike, ["Ctrl+Shift+F", "=", "="]),
    (Action::SearchView, ["Ctrl+Shift+G", "=", "="]),
    (Action::ClearSelection, ["Shift+Alt+C", "=", "Ctrl+D"]),
    (Action::Copy, ["Ctrl+C", "=", "="]),
    (Action::CopyWithBelow, ["Ctrl+Alt+C", "=", "="]),
    (Action::Cut, ["Ctrl+X", "=", "="]),
    (Action::Paste, ["Ctrl+V", "=", "Ctrl+Shift+V"]),
    (Action::PasteHere, ["Ctrl+Shift+V", "=", "Ctrl+V"]),
    (Action::CopyTime, ["Ctrl+Alt+G", "=", "="]),
    (Action::NewBefore, ["Ctrl+Shift+N", "=", "="]),
    (Action::NewAfter, ["Shift+Alt+N", "=", "="]),
    (Action::NewBelow, ["Ctrl+Shift+Alt+D", "=", "="]),
    (Action::Duplicate, ["Ctrl+D", "=", "Alt+D"]),
    (Action::MergePrevious, ["Ctrl+Shift+B", "=", "="]),
    (Action::FirstAnnotation, ["Alt+Home", "=", "="]),
    (Action::LastAnnotation, ["Alt+End", "=", "="]),
    (Action::StartToNeighbour, ["Shift+Alt+J", "=", "="]),
    (Action::EndToNeighbour, ["Shift+Alt+U", "=", "="]),
    (Action::StepAndRepeat, ["Ctrl+Alt+Space", "=", "="]),
    (Action::GoToTime, ["Ctrl+G", "=", "="]),
    (Action::NewAnnotation, ["Ctrl+Alt+N", "=", "Ctrl+Alt+N N"]),
    (Action::BeginEndAnnotation, ["Shift+Enter", "=", "="]),
    (Action::SplitAnnotation, ["Ctrl+Alt+S", "=", "Ctrl+B S"]),
    (Action::MergeAnnotation, ["Ctrl+Shift+A", "=", "="]),
    (
        Action::DeleteAnnotation,
        ["Ctrl+Alt+D Delete", "Alt+Backspace Delete", "Delete"],
    ),
    (Action::CopyToTier, ["Ctrl+Shift+D", "=", "="]),
    (Action::MoveToTier, ["Ctrl+Shift+M", "=", "="]),
    (Action::NextAnnotation, ["Alt+Right", "=", "Alt+Right Tab"]),
    (
        Action::PreviousAnnotation,
        ["Alt+Left", "=", "Alt+Left Shift+Tab"],
    ),
    (Action::AnnotationBelow, ["Alt+Down", "=", "="]),
    (Action::AnnotationAbove, ["Alt+Up", "=", "="]),
    (Action::AlsoNext, ["Ctrl+Alt+Right", "=", "="]),
    (Action::AlsoPrevious, ["Ctrl+Alt+Left", "=", "="]),
    (Action::SelectOnTier, ["Ctrl+A", "Ctrl+Alt+A", "="]),
    (Action::EditValue, ["Enter F2 Ctrl+Alt+M", "=", "="]),
    (Action::PictureValue, ["F3", "=", "="]),
    (Action::ClearValue, ["Ctrl+Delete", "=", "="]),
    (Action::Value1, ["1", "=", "="]),
    (Action::Value2, ["2", "=", "="]),
    (Action::Value3, ["3", "=", "="]),
    (Action::Value4, ["4", "=", "="]),
    (Action::Value5, ["5", "=", "="]),
    (Action::Value6, ["6", "=", "="]),
    (Action::Value7, ["7", "=", "="]),
    (Action::Value8, ["8", "=", "="]),
    (Action::Value9, ["9", "=", "="]),
    (Action::StartHere, ["Alt+OpenBracket", "=", "="]),
    (Action::EndHere, ["Alt+CloseBracket", "=", "="]),
    (Action::ToSelection, ["Ctrl+Enter", "=", "="]),
    (Action::StartEarlier, ["Ctrl+J", "=", "="]),
    (Action::StartLater, ["Ctrl+U", "=", "="]),
    (Action::EndEarlier, ["Ctrl+Shift+J", "=", "="]),
    (Action::EndLater, ["Ctrl+Shift+U", "=", "="]),
    (Action::ShiftEarlier, ["Ctrl+Alt+J", "=", "="]),
    (Action::ShiftLater, ["Ctrl+Alt+U", "=", "="]),
    (Action::SelectFromHere, ["Ctrl+OpenBracket", "=", "I"]),
    (Action::SelectToHere, ["Ctrl+CloseBracket", "=", "O"]),
    (Action::ExtendFrameBack, ["Ctrl+Shift+Left", "=", "="]),
    (Action::ExtendFrameForward, ["Ctrl+Shift+Right", "=", "="]),
    (Action::ExtendSecondBack, ["Ctrl+Shift+PageUp", "=", "="]),
    (
        Action::ExtendSecondForward,
        ["Ctrl+Shift+PageDown", "=", "="],
    ),
    (Action::ModeNormal, ["F6", "=", "="]),
    (Action::ModeBulldozer, ["F7", "=", "="]),
    (Action::ModeShift, ["F8", "=", "="]),
    (Action::SnapFrames, ["Shift+F6", "=", "="]),
    (Action::SnapBoundaries, ["Shift+F7", "=", "="]),
    (Action::SnapMinima, ["Shift+F8", "=", "="]),
    (Action::NextTier, ["Ctrl+Down", "=", "="]),
    (Action::PreviousTier, ["Ctrl+Up", "=", "="]),
    (Action::AddTier, ["Ctrl+T", "=", "="]),
    (Action::ChangeTier, ["Ctrl+Shift+T", "=", "="]),
    (Action::CopyTier, ["Ctrl+Shift+Alt+T", "=", "="]),
    (Action::TiersByName, ["Shift+Alt+O", "=", "="]),
    (Action::TiersByKind, ["Shift+Alt+K", "=", "="]),
    (Action::HideEmptyTiers, ["Ctrl+Alt+E", "=", "="]),
    (Action::RemoveTier, ["Ctrl+Alt+T", "=", "="]),
    (Action::TierUp, ["Ctrl+Shift+Up", "=", "="]),
    (Action::TierDown, ["Ctrl+Shift+Down", "=", "="]),
    (Action::FoldTier, ["Ctrl+Alt+F", "=", "="]),
    (Action::HideTier, ["Ctrl+Alt+H", "=", "="]),
    (Action::ShowTiers, ["Ctrl+Shift+H", "=", "="]),
    (Action::Play, ["Ctrl+Space Space", "Tab Space", "Space"]),
    (Action::PlaySelection, ["Shift+Space", "=", "Shift+Space"]),
    (Action::PlayAround, ["Ctrl+Shift+Space", "=", "="]),
    (Action::OtherEnd, ["Ctrl+Slash", "=", "="]),
    (Action::ToCentre, ["Ctrl+Alt+Slash", "=", "="]),
    (Action::Loop, ["Ctrl+L", "=", "Ctrl+L"]),
    (Action::ShuttleBack, ["none", "none", "J"]),
    (Action::ShuttleStop, ["none", "none", "K"]),
    (Action::ShuttleForward, ["none", "none", "L"]),
    (Action::FrameBack, ["Ctrl+Left", "=", "Left Comma"]),
    (Action::FrameForward, ["Ctrl+Right", "=", "Right Period"]),
    (Action::SecondBack, ["Shift+Left", "=", "="]),
    (Action::SecondForward, ["Shift+Right", "=", "="]),
    (Action::ToStart, ["Ctrl+B Home", "Home", "Home"]),
    (Action::ToEnd, ["Ctrl+E End", "End", "End"]),
    (Action::Slower, ["Ctrl+5", "=", "OpenBracket"]),
    (Action::Faster, ["Ctrl+6", "=", "CloseBracket"]),
    (Action::NormalSpeed, ["Ctrl+Alt+0", "=", "="]),
    (Action::NextRecording, ["Ctrl+PageDown", "=", "="]),
    (Action::PreviousRecording, ["Ctrl+PageUp", "=", "="]),
    (Action::ViewFront, ["Alt+1", "=", "="]),
    (Action::ViewSigner, ["Alt+2", "=", "="]),
    (Action::ViewLeft, ["Alt+3", "=", "="]),
    (Action::ViewRight, ["Alt+4", "=", "="]),
    (Action::ViewTop, ["Alt+5", "=", "="]),
    (Action::ViewRightHand, ["Alt+6", "=", "="]),
    (Action::ViewLeftHand, ["Alt+7", "=", "="]),
    (Action::ViewFace, ["Alt+V", "=", "="]),
    (Action::StageSplit, ["Alt+8", "=", "="]),
    (Action::StageNextPane, ["Alt+9", "=", "="]),
    (Action::StageTrails, ["Alt+T", "=", "Alt+T"]),
    (Action::StageGhosts, ["Alt+G", "=", "="]),
    (Action::StagePlaces, ["Alt+P", "=", "="]),
    (Action::StageGrid, ["Alt+R", "=", "="]),
    (Action::StageCompare, ["Alt+O", "=", "="]),
    (Action::StageRecording, ["Alt+0", "=", "="]),
    (Action::OrbitLeft, ["Shift+Alt+Left", "=", "="]),
    (Action::OrbitRight, ["Shift+Alt+Right", "=", "="]),
    (Action::OrbitUp, ["Shift+Alt+Up", "=", "="]),
    (Action::OrbitDown, ["Shift+Alt+Down", "=", "="]),
    (Action::PanLeft, ["Ctrl+Shift+Alt+Left", "=", "="]),
    (Action::PanRight, ["Ctrl+Shift+Alt+Right", "=", "="]),
    (Action::PanUp, ["Ctrl+Shift+Alt+Up", "=", "="]),
    (Action::PanDown, ["Ctrl+Shift+Alt+Down", "=", "="]),
    (Action::Nearer, ["Alt+Equals Alt+Plus", "=", "="]),
    (Action::Farther, ["Alt+Minus", "=", "="]),
    (Action::StageReset, ["Shift+Alt+0", "=", "="]),
    (Action::ZoomIn, ["Ctrl+Equals Ctrl+Plus", "Ctrl+I", "="]),
    (Action::ZoomOut, ["Ctrl+Minus", "=", "="]),
    (Action::ZoomAll, ["Ctrl+0", "Ctrl+A", "="]),
    (Action::PageBack, ["PageUp", "=", "="]),
    (Action::PageForward, ["PageDown", "=", "="]),
    (Action::Overview, ["Ctrl+F9", "=", "="]),
    (Action::LaneSpeed, ["Ctrl+F5", "=", "="]),
    (Action::LaneAperture, ["Ctrl+F6", "=", "="]),
    (Action::LanePalm, ["Ctrl+F7", "=", "="]),
    (Action::LaneDistance, ["Ctrl+F8", "=", "="]),
    (Action::LaneFace, ["Ctrl+F10", "=", "="]),
    (Action::Larger, ["Ctrl+Alt+Equals Ctrl+Alt+Plus", "=", "="]),
    (Action::Smaller, ["Ctrl+Alt+Minus", "=", "="]),
    (Action::ShowLibrary, ["Shift+F1", "=", "="]),
    (Action::ShowStage, ["Shift+F2", "=", "="]),
    (Action::ShowTimeline, ["Shift+F3", "=", "="]),
    (Action::ShowRecombine, ["Ctrl+R", "=", "="]),
    (Action::StoreSign, ["Ctrl+S", "=", "="]),
    (Action::UseInRecipe, ["Ctrl+Alt+R", "=", "="]),
    (Action::RecombineSelected, ["Ctrl+Shift+R", "=", "="]),
    (Action::CardUp, ["Alt+Up", "=", "="]),
    (Action::CardDown, ["Alt+Down", "=", "="]),
    (Action::CardDuplicate, ["Ctrl+Shift+D", "=", "="]),
    (Action::CardSwitch, ["Alt+Enter", "=", "="]),
    (Action::CardRemove, ["Alt+Delete", "=", "="]),
    (Action::ShowInspector, ["Shift+F4", "=", "="]),
    (Action::ShowHistory, ["Ctrl+H", "=", "="]),
    (Action::OnlyPane, ["F11", "=", "="]),
    (Action::OnlyAnnotating, ["Shift+F11", "=", "="]),
    (Action::LayoutAnnotate, ["Ctrl+F1", "=", "="]),
    (Action::LayoutSearch, ["Ctrl+F2", "=", "="]),
    (Action::LayoutRecombine, ["Ctrl+F3", "=", "="]),
    (Action::Palette, ["Ctrl+Shift+P", "=", "="]),
    (Action::Keys, ["F1", "=", "="]),
];

/// Returns the keys that a keymap gives an action.
pub(crate) fn defaults(keymap: Keymap, action: Action) -> Vec<Chord> {
    let Some((_, keys)) = DEFAULTS.iter().find(|(of, _)| *of == action) else {
        return Vec::new();
    };
    let text = match (keymap, keys) {
        (Keymap::Elan, [elan, ..])
        | (Keymap::Praat, [elan, "=", _])
        | (Keymap::Editor, [elan, _, "="]) => elan,
        (Keymap::Praat, [_, praat, _]) => praat,
        (Keymap::Editor, [_, _, editor]) => editor,
    };
    text.split_whitespace()
        .filter(|word| *word != "none")
        .filter_map(|chord| chord.parse().ok())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_of_the_table_is_one() {
        for (action, keys) in DEFAULTS {
            for text in keys.iter().flat_map(|keys| keys.split_whitespace()) {
                let known = text == "=" || text == "none" || text.parse::<Chord>().is_ok();
                assert!(known, "{action:?}: {text}");
            }
        }
    }
}
