//! Where the panes are.

use eframe::egui::Id;
use egui_tiles::{Container, Linear, LinearDir, Tile, TileId, Tiles, Tree};

use crate::panes::PaneKind;

const ID: &str = "panes";

/// What one is busy with, and so which panes want room.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Busy {
    /// The timeline goes from edge to edge, as annotators know it.
    Annotating,
    /// Hits have half of the window.
    Searching,
    /// The cards stand beside a large stage.
    Recombining,
}

/// Returns the usual layout.
pub(crate) fn usual() -> Tree<PaneKind> {
    of(Busy::Annotating)
}

/// Returns the layout for that work.
pub(crate) fn of(busy: Busy) -> Tree<PaneKind> {
    use LinearDir::{Horizontal, Vertical};
    use PaneKind::{History, Import, Inspector, Library, Recombine, Search, Stage, Timeline};
    let mut tiles = Tiles::default();
    let [left, stage, timeline, right] = [
        &[Library, Search, Recombine, Import][..],
        &[Stage],
        &[Timeline],
        &[Inspector, History],
    ]
    .map(|kinds| {
        let children: Vec<TileId> = kinds.iter().map(|kind| tiles.insert_pane(*kind)).collect();
        tiles.insert_tab_tile(children)
    });
    let tiles_of = &mut tiles;
    let root = match busy {
        Busy::Annotating => {
            let top = [(left, 0.26), (stage, 0.52), (right, 0.22)];
            let top = shares(tiles_of, Horizontal, &top);
            shares(tiles_of, Vertical, &[(top, 0.58), (timeline, 0.42)])
        }
        Busy::Searching => {
            let side = [(stage, 0.52), (timeline, 0.26), (right, 0.22)];
            let side = shares(tiles_of, Vertical, &side);
            shares(tiles_of, Horizontal, &[(left, 0.52), (side, 0.48)])
        }
        Busy::Recombining => {
            let side = [(stage, 0.64), (timeline, 0.2), (right, 0.16)];
            let side = shares(tiles_of, Vertical, &side);
            shares(tiles_of, Horizontal, &[(left, 0.38), (side, 0.62)])
        }
    };
    let mut tree = Tree::new(Id::unique(ID), root, tiles);
    bring(
        &mut tree,
        match busy {
            Busy::Annotating => Library,
            Busy::Searching => Search,
            Busy::Recombining => Recombine,
        },
    );
    tree
}

fn shares(tiles: &mut Tiles<PaneKind>, dir: LinearDir, parts: &[(TileId, f32)]) -> TileId {
    let mut linear = Linear::new(dir, parts.iter().map(|(tile, _)| *tile).collect());
    for (tile, share) in parts {
        linear.shares.set_share(*tile, *share);
    }
    tiles.insert_container(Container::Linear(linear))
}

/// Returns a remembered layout where every pane is in it once, else the usual one.
pub(crate) fn remembered(tree: Option<&Tree<PaneKind>>) -> Tree<PaneKind> {
    let whole = |tree: &&Tree<PaneKind>| {
        PaneKind::ALL.iter().all(|kind| {
            let is = |tile: &&Tile<PaneKind>| matches!(tile, Tile::Pane(pane) if pane == kind);
            tree.tiles.tiles().filter(is).count() == 1
        })
    };
    tree.filter(whole).cloned().unwrap_or_else(usual)
}

/// Returns whether a pane is in sight, and not behind another.
pub(crate) fn shows(tree: &Tree<PaneKind>, kind: PaneKind) -> bool {
    let tile = tree.tiles.find_pane(&kind);
    tile.is_some_and(|tile| tree.active_tiles().contains(&tile))
}

/// Puts all panes away but these, or brings all of them back where any is away.
pub(crate) fn enlarge(tree: &mut Tree<PaneKind>, kinds: &[PaneKind]) {
    let tiles = PaneKind::ALL.map(|kind| (kind, tree.tiles.find_pane(&kind)));
    let away = |tile: &Option<TileId>| tile.is_some_and(|tile| !tree.tiles.is_visible(tile));
    let all = tiles.iter().any(|(_, tile)| away(tile));
    for (kind, tile) in tiles {
        if let Some(tile) = tile {
            tree.set_visible(tile, all || kinds.contains(&kind));
        }
    }
    for kind in kinds {
        bring(tree, *kind);
    }
}

/// Brings a pane to the front of its tabs; one that was put away comes back with all others.
pub(crate) fn bring(tree: &mut Tree<PaneKind>, kind: PaneKind) {
    if let Some(tile) = tree.tiles.find_pane(&kind) {
        if !tree.tiles.is_visible(tile) {
            for other in PaneKind::ALL {
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

    #[test]
    fn a_layout_that_lacks_a_pane_is_not_taken() {
        let tree = usual();
        assert_eq!(remembered(Some(&tree)), tree);
        let mut lacking = usual();
        let stage = lacking.tiles.find_pane(&PaneKind::Stage).expect("a stage");
        lacking.remove_recursively(stage);
        assert_eq!(remembered(Some(&lacking)), tree);
        assert_eq!(remembered(None), tree);
        for busy in [Busy::Searching, Busy::Recombining] {
            let tree = of(busy);
            assert_eq!(remembered(Some(&tree)), tree);
        }
    }

    #[test]
    fn panes_are_put_away_and_come_back() {
        let mut tree = usual();
        enlarge(&mut tree, &[PaneKind::Timeline, PaneKind::Stage]);
        let shown = |tree: &Tree<PaneKind>| -> Vec<PaneKind> {
            let all = PaneKind::ALL.into_iter();
            all.filter(|kind| shows(tree, *kind)).collect()
        };
        assert_eq!(shown(&tree), [PaneKind::Stage, PaneKind::Timeline]);
        enlarge(&mut tree, &[PaneKind::Timeline]);
        assert_eq!(shown(&tree).len(), 4);
        enlarge(&mut tree, &[PaneKind::Timeline]);
        assert_eq!(shown(&tree), [PaneKind::Timeline]);
        assert_eq!(remembered(Some(&tree)), tree);
        bring(&mut tree, PaneKind::Inspector);
        assert_eq!(shown(&tree).len(), 4);
    }

    #[test]
    fn a_pane_behind_others_is_brought_to_the_front() {
        let mut tree = usual();
        let history = tree.tiles.find_pane(&PaneKind::History).expect("a history");
        assert!(!shows(&tree, PaneKind::History));
        bring(&mut tree, PaneKind::History);
        assert!(tree.active_tiles().contains(&history) && shows(&tree, PaneKind::History));
    }
}
