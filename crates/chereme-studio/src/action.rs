//! The table of everything that keys, menus and the command palette can request; each row is an [`Action`].
//!
//! An action has no data; its object is the selection. To add one, write a row here and an arm in
//! [`perform`](crate::perform); give it keys in [`keys::table`](crate::keys::table).

use crate::panes::PaneKind;
use crate::words::{Text, actions as words, shell};

/// The menu that lists an action.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Menu {
    File,
    Edit,
    Annotation,
    Value,
    Timing,
    Tier,
    Play,
    Stage,
    View,
    Panes,
    Help,
}

#[allow(non_upper_case_globals, reason = "named as variants in the table")]
impl Context {
    const Recombine: Self = Self::Pane(PaneKind::Recombine);
}

impl Menu {
    pub(crate) const ALL: [(Self, Text); 11] = [
        (Self::File, shell::MENU_FILE),
        (Self::Edit, shell::MENU_EDIT),
        (Self::Annotation, shell::MENU_ANNOTATION),
        (Self::Value, shell::MENU_VALUE),
        (Self::Timing, shell::MENU_TIMING),
        (Self::Tier, shell::MENU_TIER),
        (Self::Play, shell::MENU_PLAY),
        (Self::Stage, shell::MENU_STAGE),
        (Self::View, shell::MENU_VIEW),
        (Self::Panes, shell::MENU_PANES),
        (Self::Help, shell::MENU_HELP),
    ];
}

/// Where the keys of an action have an effect.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Context {
    /// In the whole window.
    Everywhere,
    /// Only with a corpus open.
    Corpus,
    /// Only in that pane; there they take precedence over other actions with the same keys.
    #[allow(dead_code, reason = "the keys of a pane of its own")]
    Pane(PaneKind),
}

/// A row of the table of actions.
#[derive(Debug)]
pub(crate) struct ActionRow {
    pub(crate) action: Action,
    /// Name of the action in the settings file; it never changes.
    pub(crate) id: &'static str,
    pub(crate) name: Text,
    pub(crate) menu: Menu,
    pub(crate) context: Context,
    /// Whether holding its key repeats it.
    pub(crate) repeats: bool,
}

macro_rules! actions {
    ($($action:ident $id:literal $name:ident $menu:ident $context:ident $($repeats:ident)?;)*) => {
        /// Something a person can ask for without further words.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub(crate) enum Action {
            $(#[doc = concat!("`", $id, "`")] $action,)*
        }

        /// Every action, in the order of the menus.
        pub(crate) const ACTIONS: &[ActionRow] = &[
            $(ActionRow {
                action: Action::$action,
                id: $id,
                name: words::$name,
                menu: Menu::$menu,
                context: Context::$context,
                repeats: actions!(@ $($repeats)?),
            },)*
        ];
    };
    (@ repeats) => { true };
    (@) => { false };
}

actions! {
    OpenStarter "file.starter" STARTER File Everywhere;
    Open "file.open" OPEN File Everywhere;
    New "file.new" NEW File Everywhere;
    Import "file.import" SHOW_IMPORT File Corpus;
    ImportFiles "file.import-files" IMPORT_FILES File Corpus;
    ImportFolder "file.import-folder" IMPORT_FOLDER File Corpus;
    MergeCorpus "file.merge" MERGE_CORPUS File Corpus;
    Export "file.export" EXPORT File Corpus;
    Close "file.close" CLOSE File Corpus;
    Check "file.check" CHECK File Corpus;
    Settings "file.settings" SETTINGS File Everywhere;
    Quit "file.quit" QUIT File Everywhere;
    Undo "edit.undo" UNDO Edit Corpus repeats;
    Redo "edit.redo" REDO Edit Corpus repeats;
    Search "edit.search" SHOW_SEARCH Edit Corpus;
    SearchLike "edit.search-like" SEARCH_LIKE Edit Corpus;
    SearchView "edit.search-view" SEARCH_VIEW Edit Corpus;
    ClearSelection "edit.clear-selection" SELECTION_CLEAR Edit Corpus;
    Copy "edit.copy" COPY Edit Corpus;
    CopyWithBelow "edit.copy-with-below" COPY_WITH_BELOW Edit Corpus;
    Cut "edit.cut" CUT Edit Corpus;
    Paste "edit.paste" PASTE Edit Corpus;
    PasteHere "edit.paste-here" PASTE_HERE Edit Corpus;
    CopyTime "edit.copy-time" COPY_TIME Edit Corpus;
    NewAnnotation "annotation.new" ANNOTATION_NEW Annotation Corpus;
    NewBefore "annotation.new-before" ANNOTATION_NEW_BEFORE Annotation Corpus;
    NewAfter "annotation.new-after" ANNOTATION_NEW_AFTER Annotation Corpus;
    NewBelow "annotation.new-below" ANNOTATION_NEW_BELOW Annotation Corpus;
    Duplicate "annotation.duplicate" ANNOTATION_DUPLICATE Annotation Corpus;
    BeginEndAnnotation "annotation.begin-end" ANNOTATION_BEGIN_END Annotation Corpus;
    SplitAnnotation "annotation.split" ANNOTATION_SPLIT Annotation Corpus;
    MergeAnnotation "annotation.merge" ANNOTATION_MERGE Annotation Corpus;
    MergePrevious "annotation.merge-previous" ANNOTATION_MERGE_PREVIOUS Annotation Corpus;
    DeleteAnnotation "annotation.delete" ANNOTATION_DELETE Annotation Corpus;
    UseInRecipe "recombine.use" USE_IN_RECIPE Edit Corpus;
    OpenRecipe "recombine.open-recipe" OPEN_RECIPE Edit Corpus;
    RecombineSelected "recombine.selected" RECOMBINE_SELECTED Edit Corpus;
    StoreSign "recombine.store" STORE_SIGN Edit Corpus;
    CardUp "recombine.card-up" CARD_UP Edit Recombine repeats;
    CardDown "recombine.card-down" CARD_DOWN Edit Recombine repeats;
    CardDuplicate "recombine.card-duplicate" CARD_DUPLICATE Edit Recombine;
    CardSwitch "recombine.card-switch" CARD_SWITCH Edit Recombine;
    CardRemove "recombine.card-remove" CARD_REMOVE Edit Recombine;
    CopyToTier "annotation.copy-to-tier" ANNOTATION_COPY Annotation Corpus;
    MoveToTier "annotation.move-to-tier" ANNOTATION_MOVE Annotation Corpus;
    NextAnnotation "annotation.next" ANNOTATION_NEXT Annotation Corpus repeats;
    PreviousAnnotation "annotation.previous" ANNOTATION_PREVIOUS Annotation Corpus repeats;
    FirstAnnotation "annotation.first" ANNOTATION_FIRST Annotation Corpus;
    LastAnnotation "annotation.last" ANNOTATION_LAST Annotation Corpus;
    AnnotationBelow "annotation.below" ANNOTATION_BELOW Annotation Corpus repeats;
    AnnotationAbove "annotation.above" ANNOTATION_ABOVE Annotation Corpus repeats;
    AlsoNext "annotation.also-next" ALSO_NEXT Annotation Corpus repeats;
    AlsoPrevious "annotation.also-previous" ALSO_PREVIOUS Annotation Corpus repeats;
    SelectOnTier "annotation.select-on-tier" SELECT_ON_TIER Annotation Corpus;
    EditValue "value.edit" VALUE_EDIT Value Corpus;
    Propose "value.propose" VALUE_PROPOSE Value Corpus;
    AcceptProposal "value.accept" VALUE_ACCEPT Value Corpus;
    NextProposal "value.next-proposal" VALUE_NEXT_PROPOSAL Value Corpus repeats;
    PictureValue "value.picture" VALUE_PICTURE Value Corpus;
    ClearValue "value.clear" VALUE_CLEAR Value Corpus;
    Value1 "value.1" VALUE_1 Value Corpus;
    Value2 "value.2" VALUE_2 Value Corpus;
    Value3 "value.3" VALUE_3 Value Corpus;
    Value4 "value.4" VALUE_4 Value Corpus;
    Value5 "value.5" VALUE_5 Value Corpus;
    Value6 "value.6" VALUE_6 Value Corpus;
    Value7 "value.7" VALUE_7 Value Corpus;
    Value8 "value.8" VALUE_8 Value Corpus;
    Value9 "value.9" VALUE_9 Value Corpus;
    StartHere "timing.start-here" START_HERE Timing Corpus;
    EndHere "timing.end-here" END_HERE Timing Corpus;
    StartToNeighbour "timing.start-to-neighbour" START_TO_NEIGHBOUR Timing Corpus;
    EndToNeighbour "timing.end-to-neighbour" END_TO_NEIGHBOUR Timing Corpus;
    ToSelection "timing.to-selection" TO_SELECTION Timing Corpus;
    StartEarlier "timing.start-earlier" START_EARLIER Timing Corpus repeats;
    StartLater "timing.start-later" START_LATER Timing Corpus repeats;
    EndEarlier "timing.end-earlier" END_EARLIER Timing Corpus repeats;
    EndLater "timing.end-later" END_LATER Timing Corpus repeats;
    ShiftEarlier "timing.shift-earlier" SHIFT_EARLIER Timing Corpus repeats;
    ShiftLater "timing.shift-later" SHIFT_LATER Timing Corpus repeats;
    SelectFromHere "timing.select-from-here" SELECT_FROM_HERE Timing Corpus;
    SelectToHere "timing.select-to-here" SELECT_TO_HERE Timing Corpus;
    ExtendFrameBack "timing.extend-frame-back" EXTEND_FRAME_BACK Timing Corpus repeats;
    ExtendFrameForward "timing.extend-frame-forward" EXTEND_FRAME_FORWARD Timing Corpus repeats;
    ExtendSecondBack "timing.extend-second-back" EXTEND_SECOND_BACK Timing Corpus repeats;
    ExtendSecondForward "timing.extend-second-forward" EXTEND_SECOND_FORWARD Timing Corpus repeats;
    ModeNormal "timing.mode-normal" MODE_NORMAL Timing Corpus;
    ModeBulldozer "timing.mode-bulldozer" MODE_BULLDOZER Timing Corpus;
    ModeShift "timing.mode-shift" MODE_SHIFT Timing Corpus;
    SnapFrames "timing.snap-frames" SNAP_FRAMES Timing Corpus;
    SnapBoundaries "timing.snap-boundaries" SNAP_BOUNDARIES Timing Corpus;
    SnapMinima "timing.snap-minima" SNAP_MINIMA Timing Corpus;
    NextTier "tier.next" TIER_NEXT Tier Corpus repeats;
    PreviousTier "tier.previous" TIER_PREVIOUS Tier Corpus repeats;
    AddTier "tier.add" TIER_ADD Tier Corpus;
    UsualTiers "tier.usual" TIER_USUAL Tier Corpus;
    ChangeTier "tier.change" TIER_CHANGE Tier Corpus;
    CopyTier "tier.copy" TIER_COPY Tier Corpus;
    RemoveTier "tier.remove" TIER_REMOVE Tier Corpus;
    TierUp "tier.up" TIER_UP Tier Corpus repeats;
    TierDown "tier.down" TIER_DOWN Tier Corpus repeats;
    TiersByName "tier.by-name" TIERS_BY_NAME Tier Corpus;
    TiersByKind "tier.by-kind" TIERS_BY_KIND Tier Corpus;
    FoldTier "tier.fold" TIER_FOLD Tier Corpus;
    HideTier "tier.hide" TIER_HIDE Tier Corpus;
    HideEmptyTiers "tier.hide-empty" TIERS_HIDE_EMPTY Tier Corpus;
    ShowTiers "tier.show-all" TIER_SHOW_ALL Tier Corpus;
    Play "play.toggle" PLAY Play Corpus;
    PlaySelection "play.selection" PLAY_SELECTION Play Corpus;
    PlayAround "play.around" PLAY_AROUND Play Corpus;
    StepAndRepeat "play.step-and-repeat" STEP_AND_REPEAT Play Corpus;
    GoToTime "play.go-to-time" GO_TO_TIME Play Corpus;
    OtherEnd "play.other-end" OTHER_END Play Corpus;
    ToCentre "play.to-centre" TO_CENTRE Play Corpus;
    Loop "play.loop" LOOP Play Corpus;
    ShuttleBack "play.shuttle-back" SHUTTLE_BACK Play Corpus;
    ShuttleStop "play.shuttle-stop" SHUTTLE_STOP Play Corpus;
    ShuttleForward "play.shuttle-forward" SHUTTLE_FORWARD Play Corpus;
    FrameBack "play.frame-back" FRAME_BACK Play Corpus repeats;
    FrameForward "play.frame-forward" FRAME_FORWARD Play Corpus repeats;
    FilmBack "play.film-back" FILM_BACK Play Corpus repeats;
    FilmForward "play.film-forward" FILM_FORWARD Play Corpus repeats;
    SecondBack "play.second-back" SECOND_BACK Play Corpus repeats;
    SecondForward "play.second-forward" SECOND_FORWARD Play Corpus repeats;
    ToStart "play.to-start" TO_START Play Corpus;
    ToEnd "play.to-end" TO_END Play Corpus;
    Slower "play.slower" SLOWER Play Corpus repeats;
    Faster "play.faster" FASTER Play Corpus repeats;
    NormalSpeed "play.normal-speed" NORMAL_SPEED Play Corpus;
    NextRecording "play.next-recording" RECORDING_NEXT Play Corpus repeats;
    PreviousRecording "play.previous-recording" RECORDING_PREVIOUS Play Corpus repeats;
    ViewFront "view.front" VIEW_FRONT Stage Corpus;
    ViewSigner "view.signer" VIEW_SIGNER Stage Corpus;
    ViewLeft "view.left" VIEW_LEFT Stage Corpus;
    ViewRight "view.right" VIEW_RIGHT Stage Corpus;
    ViewTop "view.top" VIEW_TOP Stage Corpus;
    ViewRightHand "view.right-hand" VIEW_RIGHT_HAND Stage Corpus;
    ViewLeftHand "view.left-hand" VIEW_LEFT_HAND Stage Corpus;
    ViewFace "view.face" VIEW_FACE Stage Corpus;
    StageSplit "stage.split" STAGE_SPLIT Stage Corpus;
    StageNextPane "stage.next-view" STAGE_NEXT_PANE Stage Corpus;
    StageTrails "stage.trails" STAGE_TRAILS Stage Corpus;
    StageGhosts "stage.ghosts" STAGE_GHOSTS Stage Corpus;
    StagePlaces "stage.places" STAGE_PLACES Stage Corpus;
    StageHands "stage.hands" STAGE_HANDS Stage Corpus;
    StagePalms "stage.palms" STAGE_PALMS Stage Corpus;
    StageFace "stage.face" STAGE_FACE Stage Corpus;
    StageGrid "stage.grid" STAGE_GRID Stage Corpus;
    StageCompare "stage.compare" STAGE_COMPARE Stage Corpus;
    StageRecording "stage.recording" STAGE_RECORDING Stage Corpus;
    OrbitLeft "stage.orbit-left" ORBIT_LEFT Stage Corpus repeats;
    OrbitRight "stage.orbit-right" ORBIT_RIGHT Stage Corpus repeats;
    OrbitUp "stage.orbit-up" ORBIT_UP Stage Corpus repeats;
    OrbitDown "stage.orbit-down" ORBIT_DOWN Stage Corpus repeats;
    PanLeft "stage.pan-left" PAN_LEFT Stage Corpus repeats;
    PanRight "stage.pan-right" PAN_RIGHT Stage Corpus repeats;
    PanUp "stage.pan-up" PAN_UP Stage Corpus repeats;
    PanDown "stage.pan-down" PAN_DOWN Stage Corpus repeats;
    Nearer "stage.nearer" NEARER Stage Corpus repeats;
    Farther "stage.farther" FARTHER Stage Corpus repeats;
    ShareFilm "share.film" SHARE_FILM Stage Corpus;
    ShareGif "share.gif" SHARE_GIF Stage Corpus;
    SharePicture "share.picture" SHARE_PICTURE Stage Corpus;
    ShareGlb "share.glb" SHARE_GLB Stage Corpus;
    StageReset "stage.reset" STAGE_RESET Stage Corpus;
    ZoomIn "view.zoom-in" ZOOM_IN View Corpus repeats;
    ZoomOut "view.zoom-out" ZOOM_OUT View Corpus repeats;
    ZoomAll "view.zoom-all" ZOOM_ALL View Corpus;
    PageBack "view.page-back" PAGE_BACK View Corpus repeats;
    PageForward "view.page-forward" PAGE_FORWARD View Corpus repeats;
    Overview "view.overview" OVERVIEW View Corpus;
    LaneSpeed "view.lane-speed" LANE_SPEED View Corpus;
    LaneAperture "view.lane-aperture" LANE_APERTURE View Corpus;
    LanePalm "view.lane-palm" LANE_PALM View Corpus;
    LaneDistance "view.lane-distance" LANE_DISTANCE View Corpus;
    LaneFace "view.lane-face" LANE_FACE View Corpus;
    Larger "view.larger" LARGER View Everywhere repeats;
    Smaller "view.smaller" SMALLER View Everywhere repeats;
    Theme "view.theme" THEME View Everywhere;
    ShowLibrary "pane.library" SHOW_LIBRARY Panes Corpus;
    ShowStage "pane.stage" SHOW_STAGE Panes Corpus;
    ShowTimeline "pane.timeline" SHOW_TIMELINE Panes Corpus;
    ShowRecombine "pane.recombine" SHOW_RECOMBINE Panes Corpus;
    ShowInspector "pane.inspector" SHOW_INSPECTOR Panes Corpus;
    ShowFilm "pane.film" SHOW_FILM Panes Corpus;
    ShowMap "pane.map" SHOW_MAP Panes Corpus;
    ShowCue "pane.cue" SHOW_CUE Panes Corpus;
    ShowFaces "pane.faces" SHOW_FACES Panes Corpus;
    ShowHistory "pane.history" SHOW_HISTORY Panes Corpus;
    OnlyPane "pane.only" ONLY_PANE Panes Corpus;
    OnlyAnnotating "pane.only-annotating" ONLY_ANNOTATING Panes Corpus;
    LayoutAnnotate "pane.reset" LAYOUT_ANNOTATE Panes Corpus;
    LayoutSearch "layout.search" LAYOUT_SEARCH Panes Corpus;
    LayoutRecombine "layout.recombine" LAYOUT_RECOMBINE Panes Corpus;
    Palette "help.palette" PALETTE Help Everywhere;
    Keys "help.keys" KEYS Help Everywhere;
    FirstSteps "help.first-steps" FIRST_STEPS Help Everywhere;
}

impl Action {
    /// Returns whether the action changes the corpus, or begins to change it.
    pub(crate) fn changes(self) -> bool {
        use Action::{
            AddTier, BeginEndAnnotation, ChangeTier, CopyTier, CopyToTier, Cut, DeleteAnnotation,
            Duplicate, EndEarlier, EndHere, EndLater, EndToNeighbour, Import, ImportFiles,
            ImportFolder, MergeAnnotation, MergeCorpus, MergePrevious, MoveToTier, NewAfter,
            NewAnnotation, NewBefore, NewBelow, Paste, PasteHere, Redo, RemoveTier, ShiftEarlier,
            ShiftLater, SplitAnnotation, StartEarlier, StartHere, StartLater, StartToNeighbour,
            StoreSign, TierDown, TierUp, TiersByKind, TiersByName, ToSelection, Undo, UsualTiers,
        };
        self.row().menu == Menu::Value
            || matches!(
                self,
                Undo | Redo
                    | Cut
                    | Paste
                    | PasteHere
                    | Import
                    | ImportFiles
                    | ImportFolder
                    | MergeCorpus
                    | StoreSign
                    | NewAnnotation
                    | NewBefore
                    | NewAfter
                    | NewBelow
                    | Duplicate
                    | BeginEndAnnotation
                    | SplitAnnotation
                    | MergeAnnotation
                    | MergePrevious
                    | DeleteAnnotation
                    | CopyToTier
                    | MoveToTier
                    | StartHere
                    | EndHere
                    | StartToNeighbour
                    | EndToNeighbour
                    | ToSelection
                    | StartEarlier
                    | StartLater
                    | EndEarlier
                    | EndLater
                    | ShiftEarlier
                    | ShiftLater
                    | AddTier
                    | UsualTiers
                    | ChangeTier
                    | CopyTier
                    | RemoveTier
                    | TierUp
                    | TierDown
                    | TiersByName
                    | TiersByKind
            )
    }

    /// Returns the row of this action.
    pub(crate) fn row(self) -> &'static ActionRow {
        &ACTIONS[self as usize]
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn rows_are_found_by_their_action_and_ids_are_taken_once() {
        let ids: BTreeSet<&str> = ACTIONS.iter().map(|row| row.id).collect();
        assert_eq!(ids.len(), ACTIONS.len());
        for row in ACTIONS {
            assert_eq!(row.action.row().id, row.id);
        }
    }
}
