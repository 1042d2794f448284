//! Where the panes are.

use eframe::egui::Id;
use egui_tiles::{Container, Linear, LinearDir, Tile, TileId, Tiles, Tree};

use crate::panes::PaneKind;

const ID: &str = "panes";

/// Returns the usual layout.
pub(crate) fn usual() -> Tree<PaneKind> {
    let mut tiles = Tiles::default();
    let tabs = |tiles: &mut Tiles<PaneKind>, kinds: &[PaneKind]| {
        let children: Vec<TileId> = kinds.iter().map(|kind| tiles.insert_pane(*kind)).collect();
        tiles.insert_tab_tile(children)
    };
    let left = tabs(
        &mut tiles,
        &[
            PaneKind::Library,
            PaneKind::Search,
            PaneKind::Recombine,
            PaneKind::Import,
        ],
    );
    let stage = tabs(&mut tiles, &[PaneKind::Stage]);
    let timeline = tabs(&mut tiles, &[PaneKind::Timeline]);
    let right = tabs(&mut tiles, &[PaneKind::Inspector, PaneKind::History]);
    let middle = shares(
        &mut tiles,
        LinearDir::Vertical,
        &[(stage, 0.62), (timeline, 0.38)],
    );
    let root = shares(
        &mut tiles,
        LinearDir::Horizontal,
        &[(left, 0.27), (middle, 0.53), (right, 0.20)],
    );
    Tree::new(Id::unique(ID), root, tiles)
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

/// Brings a pane to the front of its tabs.
pub(crate) fn bring(tree: &mut Tree<PaneKind>, kind: PaneKind) {
    if let Some(tile) = tree.tiles.find_pane(&kind) {
        tree.set_visible(tile, true);
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
    }

    #[test]
    fn a_pane_behind_others_is_brought_to_the_front() {
        let mut tree = usual();
        let history = tree.tiles.find_pane(&PaneKind::History).expect("a history");
        bring(&mut tree, PaneKind::History);
        assert!(tree.active_tiles().contains(&history));
    }
}
