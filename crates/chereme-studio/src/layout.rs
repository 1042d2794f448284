//! The panes by name, and their places.

use eframe::egui::{Context, Id, Vec2, vec2};
use egui_tiles::{Container, Linear, LinearDir, Tile, TileId, Tiles, Tree};
use serde::{Deserialize, Serialize};

use crate::words::{self, InterfaceText};

const LAYOUT_TREE_ID: &str = "panes";

/// One of the panes; its name is part of stored layouts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum PaneKind {
    Library,
    Map,
    Measures,
    Cue,
    Faces,
    Agreement,
    Studies,
    Stage,
    Timeline,
    Search,
    Recombine,
    Inspector,
    History,
    Import,
    Film,
}

impl PaneKind {
    pub(crate) const ALL_PANE_KINDS: [Self; 15] = [
        Self::Library,
        Self::Map,
        Self::Measures,
        Self::Cue,
        Self::Faces,
        Self::Agreement,
        Self::Studies,
        Self::Stage,
        Self::Timeline,
        Self::Search,
        Self::Recombine,
        Self::Inspector,
        Self::History,
        Self::Import,
        Self::Film,
    ];

    pub(crate) fn pane_title(self) -> InterfaceText {
        match self {
            Self::Library => words::library::TITLE,
            Self::Map => words::map_words::TITLE,
            Self::Measures => words::measures_words::TITLE,
            Self::Cue => words::cue_words::TITLE,
            Self::Faces => words::faces_words::TITLE,
            Self::Agreement => words::agreement::TITLE,
            Self::Studies => words::studies_words::TITLE,
            Self::Stage => words::stage_words::TITLE,
            Self::Timeline => words::timeline::TITLE,
            Self::Search => words::search_words::TITLE,
            Self::Recombine => words::recombine_words::TITLE,
            Self::Inspector => words::inspector::TITLE,
            Self::History => words::history_words::TITLE,
            Self::Import => words::import_words::TITLE,
            Self::Film => words::film_words::TITLE,
        }
    }

    /// Notes that the pane is in sight, so that others know what it shows.
    pub(crate) fn note_sight(self, ctx: &Context) {
        let pass = ctx.cumulative_pass_nr();
        ctx.data_mut(|data| data.insert_temp(Id::unique(("pane in sight", self as u8)), pass));
    }

    /// Returns whether the pane is in sight.
    pub(crate) fn is_in_sight(self, ctx: &Context) -> bool {
        let pass = ctx.cumulative_pass_nr();
        let last: Option<u64> = ctx.data(|data| data.get_temp(Id::unique(("pane in sight", self as u8))));
        // It may be drawn after the pane that asks.
        last.is_some_and(|last| last + 1 >= pass)
    }
}

/// The user's task, which decides the panes that get room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum BusyTask {
    /// The timeline has the full width, as annotators know it.
    #[default]
    Annotating,
    /// Hits have half of the window.
    Searching,
    /// The cards stand beside a large stage.
    Recombining,
}

/// The smallest size of a window, in points, that has room for panes on either side of the stage.
const MIN_ROOMY_POINTS: Vec2 = vec2(1000.0, 640.0);

/// Returns whether a window of that size gets the small layouts, which show fewer panes at once.
pub(crate) fn is_small(size: Vec2) -> bool {
    size.x < MIN_ROOMY_POINTS.x || size.y < MIN_ROOMY_POINTS.y
}

/// Returns the layout for a task. In a small window the stage and the pane of the task have all the room, and the other
/// panes are in tabs behind them.
pub(crate) fn layout_for_task(busy: BusyTask, small: bool) -> Tree<PaneKind> {
    use LinearDir::{Horizontal, Vertical};
    use PaneKind::{
        Agreement, Cue, Faces, Film, History, Import, Inspector, Library, Map, Measures, Recombine, Search, Stage,
        Studies, Timeline,
    };
    let mut tiles = Tiles::default();
    let mut tabs = |kinds: &[PaneKind]| {
        let children: Vec<TileId> = kinds.iter().map(|kind| tiles.insert_pane(*kind)).collect();
        tiles.insert_tab_tile(children)
    };
    let root = if small {
        match busy {
            BusyTask::Annotating => {
                let above = [
                    Stage, Film, Library, Search, Map, Measures, Faces, Agreement, Studies, Recombine, Cue, Import,
                    Inspector, History,
                ];
                let parts = [(tabs(&above), 0.6), (tabs(&[Timeline]), 0.4)];
                tile_with_shares(&mut tiles, Vertical, &parts)
            }
            BusyTask::Recombining => {
                let left = tabs(&[
                    Library, Search, Map, Measures, Faces, Agreement, Studies, Recombine, Cue, Import,
                ]);
                let side = tabs(&[Stage, Film, Timeline, Inspector, History]);
                tile_with_shares(&mut tiles, Horizontal, &[(left, 0.46), (side, 0.54)])
            }
            BusyTask::Searching => {
                let left = tabs(&[
                    Library, Search, Map, Measures, Faces, Agreement, Studies, Recombine, Cue, Import,
                ]);
                let side_parts = [
                    (tabs(&[Stage]), 0.64),
                    (tabs(&[Timeline, Inspector, Film, History]), 0.36),
                ];
                let side = tile_with_shares(&mut tiles, Vertical, &side_parts);
                tile_with_shares(&mut tiles, Horizontal, &[(left, 0.46), (side, 0.54)])
            }
        }
    } else {
        let left = tabs(&[
            Library, Search, Map, Measures, Faces, Agreement, Studies, Recombine, Cue, Import,
        ]);
        let stage = tabs(&[Stage]);
        // Three panes above each other would have too little height to read.
        let below = match busy {
            BusyTask::Annotating => tabs(&[Timeline]),
            _ => tabs(&[Timeline, Inspector, Film, History]),
        };
        match busy {
            BusyTask::Annotating => {
                let right = tabs(&[Inspector, Film, History]);
                let top_parts = [(left, 0.26), (stage, 0.52), (right, 0.22)];
                let top = tile_with_shares(&mut tiles, Horizontal, &top_parts);
                tile_with_shares(&mut tiles, Vertical, &[(top, 0.58), (below, 0.42)])
            }
            BusyTask::Searching => {
                let side_parts = [(stage, 0.58), (below, 0.42)];
                let side = tile_with_shares(&mut tiles, Vertical, &side_parts);
                tile_with_shares(&mut tiles, Horizontal, &[(left, 0.52), (side, 0.48)])
            }
            BusyTask::Recombining => {
                let side_parts = [(stage, 0.68), (below, 0.32)];
                let side = tile_with_shares(&mut tiles, Vertical, &side_parts);
                tile_with_shares(&mut tiles, Horizontal, &[(left, 0.38), (side, 0.62)])
            }
        }
    };
    let mut tree = Tree::new(Id::unique(LAYOUT_TREE_ID), root, tiles);
    bring_pane_to_front(
        &mut tree,
        match busy {
            BusyTask::Annotating if small => Stage,
            BusyTask::Annotating => Library,
            BusyTask::Searching => Search,
            BusyTask::Recombining => Recombine,
        },
    );
    tree
}

/// Scales the shares of all panes to an average of 1 within their container, so that the panes keep their relative
/// sizes when one is added or removed. egui_tiles gives a new pane a share of 1, the average of its neighbours.
pub(crate) fn settle_pane_shares(tree: &mut Tree<PaneKind>) {
    let ids: Vec<TileId> = tree.tiles.tile_ids().collect();
    for id in ids {
        let Some(Tile::Container(Container::Linear(linear))) = tree.tiles.get(id) else {
            continue;
        };
        let has_share = |child: &TileId| linear.shares.iter().any(|(tile, _)| tile == child);
        let shares: Vec<(TileId, f32)> = if linear.children.iter().any(has_share) {
            let children = linear.children.iter();
            children.map(|child| (*child, linear.shares[*child])).collect()
        } else {
            let weight = |child: &TileId| (*child, count_side_panes(tree, *child).clamp(1, 3) as f32);
            linear.children.iter().map(weight).collect()
        };
        let mean = shares.iter().map(|pair| pair.1).sum::<f32>() / shares.len().max(1) as f32;
        let even = (mean - 1.0).abs() < 1e-3 && linear.children.iter().all(has_share);
        // Nothing to settle, or nothing to divide by.
        if even || mean <= 0.0 {
            continue;
        }
        if let Some(Tile::Container(Container::Linear(linear))) = tree.tiles.get_mut(id) {
            for (child, share) in shares {
                linear.shares.set_share(child, share / mean);
            }
        }
    }
}

/// Returns how many panes stand side by side below a tile; panes in tabs count as one.
fn count_side_panes(tree: &Tree<PaneKind>, id: TileId) -> usize {
    match tree.tiles.get(id) {
        Some(Tile::Container(Container::Linear(linear))) => {
            linear.children.iter().map(|child| count_side_panes(tree, *child)).sum()
        }
        _ => 1,
    }
}

fn tile_with_shares(tiles: &mut Tiles<PaneKind>, dir: LinearDir, parts: &[(TileId, f32)]) -> TileId {
    let mut linear = Linear::new(dir, parts.iter().map(|(tile, _)| *tile).collect());
    for (tile, share) in parts {
        // A new pane has a share of 1: the average of the panes here.
        linear.shares.set_share(*tile, *share * parts.len() as f32);
    }
    tiles.insert_container(Container::Linear(linear))
}

/// Returns the remembered layout if it contains every pane once, else the layout for the task `busy` and the window
/// size.
pub(crate) fn remembered_layout(tree: Option<&Tree<PaneKind>>, busy: BusyTask, small: bool) -> Tree<PaneKind> {
    // A pane that was added in a later version is missing in older layouts.
    let is_complete = |tree: &&Tree<PaneKind>| {
        PaneKind::ALL_PANE_KINDS.iter().all(|kind| {
            let is = |tile: &&Tile<PaneKind>| matches!(tile, Tile::Pane(pane) if pane == kind);
            tree.tiles.tiles().filter(is).count() == 1
        })
    };
    tree.filter(is_complete)
        .cloned()
        .unwrap_or_else(|| layout_for_task(busy, small))
}

/// Returns whether a pane is in sight, and not behind another tab.
pub(crate) fn is_pane_in_sight(tree: &Tree<PaneKind>, kind: PaneKind) -> bool {
    let tile = tree.tiles.find_pane(&kind);
    tile.is_some_and(|tile| tree.active_tiles().contains(&tile))
}

/// Returns whether two panes are tabs of the same container, so that only one of them is in sight.
pub(crate) fn shares_tab_container(tree: &Tree<PaneKind>, kind: PaneKind, other: PaneKind) -> bool {
    let parent = |kind: PaneKind| tree.tiles.parent_of(tree.tiles.find_pane(&kind)?);
    kind != other && parent(kind).is_some_and(|container| Some(container) == parent(other))
}

/// Brings the stage into sight, and the timeline if only the inspector, the films or the history covers it.
pub(crate) fn bring_stage_into_sight(tree: &mut Tree<PaneKind>) {
    use PaneKind::{Film, History, Inspector, Stage, Timeline};
    if !is_pane_in_sight(tree, Stage) {
        bring_pane_to_front(tree, Stage);
    }
    let covering_kinds = [Inspector, Film, History];
    let covering = covering_kinds
        .into_iter()
        .find(|kind| shares_tab_container(tree, *kind, Timeline));
    if covering.is_some_and(|kind| is_pane_in_sight(tree, kind)) && !shares_tab_container(tree, Stage, Timeline) {
        bring_pane_to_front(tree, Timeline);
    }
}

/// Hides all panes but these, or shows all panes again if any is hidden.
pub(crate) fn enlarge_panes(tree: &mut Tree<PaneKind>, kinds: &[PaneKind]) {
    let tiles = PaneKind::ALL_PANE_KINDS.map(|kind| (kind, tree.tiles.find_pane(&kind)));
    let away = |tile: &Option<TileId>| tile.is_some_and(|tile| !tree.tiles.is_visible(tile));
    let all = tiles.iter().any(|(_, tile)| away(tile));
    for (kind, tile) in tiles {
        if let Some(tile) = tile {
            tree.set_visible(tile, all || kinds.contains(&kind));
        }
    }
    for kind in kinds {
        bring_pane_to_front(tree, *kind);
    }
}

/// Brings a pane to the front of its tabs; if it was hidden, shows all panes again.
pub(crate) fn bring_pane_to_front(tree: &mut Tree<PaneKind>, kind: PaneKind) {
    if let Some(tile) = tree.tiles.find_pane(&kind) {
        if !tree.tiles.is_visible(tile) {
            for other in PaneKind::ALL_PANE_KINDS {
                if let Some(other) = tree.tiles.find_pane(&other) {
                    tree.set_visible(other, true);
                }
            }
        }
        tree.make_active(|id, _| id == tile);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn as_usual(tree: Option<&Tree<PaneKind>>) -> Tree<PaneKind> {
        remembered_layout(tree, BusyTask::Annotating, false)
    }

    #[test]
    fn a_layout_that_lacks_a_pane_is_refused() {
        let tree = layout_for_task(BusyTask::Annotating, false);
        assert_eq!(as_usual(Some(&tree)), tree);
        let mut lacking = layout_for_task(BusyTask::Annotating, false);
        let stage = lacking.tiles.find_pane(&PaneKind::Stage).expect("a stage");
        lacking.remove_recursively(stage);
        assert_eq!(as_usual(Some(&lacking)), tree);
        assert_eq!(as_usual(None), tree);
        for busy in [BusyTask::Annotating, BusyTask::Searching, BusyTask::Recombining] {
            for small in [false, true] {
                let tree = layout_for_task(busy, small);
                assert_eq!(as_usual(Some(&tree)), tree);
            }
        }
    }

    /// Returns the width shares of the panes side by side above the timeline.
    fn widths(tree: &Tree<PaneKind>) -> Vec<f32> {
        let stage = tree.tiles.find_pane(&PaneKind::Stage).expect("a stage");
        let tabs = tree.tiles.parent_of(stage).expect("tabs");
        let row = tree.tiles.parent_of(tabs).expect("a row");
        match tree.tiles.get(row) {
            Some(Tile::Container(Container::Linear(row))) => row.shares.split(&row.children, 1.0),
            _ => Vec::new(),
        }
    }

    #[test]
    fn panes_keep_their_proportions_when_one_is_added() {
        let mut tree = layout_for_task(BusyTask::Annotating, false);
        settle_pane_shares(&mut tree);
        assert_eq!(
            tree,
            layout_for_task(BusyTask::Annotating, false),
            "nothing is to be settled"
        );
        let before = widths(&tree);
        let history = tree.tiles.find_pane(&PaneKind::History).expect("a history");
        let stage = tree.tiles.find_pane(&PaneKind::Stage).expect("a stage");
        let tabs = tree.tiles.parent_of(stage).expect("tabs");
        let row = tree.tiles.parent_of(tabs).expect("a row");
        tree.move_tile_to_container(history, row, 3, false);
        settle_pane_shares(&mut tree);
        let after = widths(&tree);
        assert_eq!(after.len(), 4);
        assert!(after[3] < 0.3, "it takes its part, not half: {after:?}");
        for (a, b) in before.iter().zip(&after) {
            assert!((b / a - after[0] / before[0]).abs() < 1e-3, "{before:?} {after:?}");
        }
        // A pane beside several others takes as much as one of them.
        let mut tree = layout_for_task(BusyTask::Annotating, false);
        let root = tree.root().expect("a root");
        let history = tree.tiles.find_pane(&PaneKind::History).expect("a history");
        let both = Linear::new(LinearDir::Horizontal, vec![root, history]);
        let both = tree.tiles.insert_container(Container::Linear(both));
        tree.root = Some(both);
        settle_pane_shares(&mut tree);
        let Some(Tile::Container(Container::Linear(both))) = tree.tiles.get(both) else {
            panic!("a row");
        };
        let split = both.shares.split(&both.children, 1.0);
        assert!((split[1] - 0.25).abs() < 1e-3, "{split:?}");
    }

    #[test]
    fn panes_are_closed_and_opened_again() {
        let mut tree = layout_for_task(BusyTask::Annotating, false);
        enlarge_panes(&mut tree, &[PaneKind::Timeline, PaneKind::Stage]);
        let shown = |tree: &Tree<PaneKind>| -> Vec<PaneKind> {
            let all = PaneKind::ALL_PANE_KINDS.into_iter();
            all.filter(|kind| is_pane_in_sight(tree, *kind)).collect()
        };
        assert_eq!(shown(&tree), [PaneKind::Stage, PaneKind::Timeline]);
        enlarge_panes(&mut tree, &[PaneKind::Timeline]);
        assert_eq!(shown(&tree).len(), 4);
        enlarge_panes(&mut tree, &[PaneKind::Timeline]);
        assert_eq!(shown(&tree), [PaneKind::Timeline]);
        assert_eq!(as_usual(Some(&tree)), tree);
        bring_pane_to_front(&mut tree, PaneKind::Inspector);
        assert_eq!(shown(&tree).len(), 4);
    }

    #[test]
    fn a_pane_behind_others_is_brought_to_the_front() {
        let mut tree = layout_for_task(BusyTask::Annotating, false);
        let history = tree.tiles.find_pane(&PaneKind::History).expect("a history");
        assert!(!is_pane_in_sight(&tree, PaneKind::History));
        bring_pane_to_front(&mut tree, PaneKind::History);
        assert!(tree.active_tiles().contains(&history) && is_pane_in_sight(&tree, PaneKind::History));
    }

    #[test]
    fn an_opened_pane_is_visible_wherever_the_stage_is() {
        use PaneKind::{Inspector, Library, Search, Stage, Timeline};
        for busy in [BusyTask::Annotating, BusyTask::Searching, BusyTask::Recombining] {
            for small in [false, true] {
                let mut tree = layout_for_task(busy, small);
                bring_pane_to_front(&mut tree, Inspector);
                bring_pane_to_front(&mut tree, Search);
                bring_stage_into_sight(&mut tree);
                assert!(is_pane_in_sight(&tree, Stage), "{busy:?} {small}");
                let beside = !shares_tab_container(&tree, Stage, Timeline);
                assert_eq!(is_pane_in_sight(&tree, Timeline), beside, "{busy:?} {small}");
            }
        }
        let tree = layout_for_task(BusyTask::Annotating, true);
        assert!(shares_tab_container(&tree, Search, Stage) && shares_tab_container(&tree, Search, Library));
        assert!(!shares_tab_container(&tree, Stage, Timeline) && !shares_tab_container(&tree, Stage, Stage));
    }

    #[test]
    fn a_small_window_shows_stage_and_work_pane_together() {
        for (busy, kind) in [
            (BusyTask::Annotating, PaneKind::Timeline),
            (BusyTask::Searching, PaneKind::Search),
            (BusyTask::Recombining, PaneKind::Recombine),
        ] {
            let tree = layout_for_task(busy, true);
            assert!(is_pane_in_sight(&tree, PaneKind::Stage) && is_pane_in_sight(&tree, kind));
        }
        assert!(is_small(vec2(800.0, 600.0)) && is_small(vec2(1280.0, 800.0) / 1.5));
        assert!(!is_small(vec2(1280.0, 720.0)));
    }
}
