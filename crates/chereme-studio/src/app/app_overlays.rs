//! The windows above the panes: each gets its part of the window's state.

use eframe::egui::Context;

use super::Studio;

impl Studio {
    /// Draws the windows that need to see the corpus.
    fn draw_corpus_overlays(&mut self, ctx: &Context) {
        let mut export = std::mem::take(&mut self.overlays.export);
        let mut tiers = std::mem::take(&mut self.overlays.tiers);
        if let (Some(seen), Some(desk)) = (self.pane_input(ctx), &self.desk) {
            export.ui(ctx, &seen, &self.settings, &desk.path);
            tiers.ui(ctx, &seen);
        }
        (self.overlays.export, self.overlays.tiers) = (export, tiers);
    }

    /// Draws the open ones.
    pub(crate) fn draw_open_overlays(&mut self, ctx: &Context) {
        let place = self.snapshot.is_some();
        let Self {
            overlays,
            keys,
            settings,
            out,
            little,
            ..
        } = self;
        overlays.notices.ui(ctx, settings.language, out);
        overlays.palette.ui(ctx, keys, settings.language, place, out);
        overlays.keys.ui(ctx, keys, settings, out);
        overlays.settings.ui(ctx, settings, out);
        overlays.steps.ui(ctx, keys, little, settings.language);
        self.draw_corpus_overlays(ctx);
        let Self {
            overlays,
            settings,
            out,
            ..
        } = self;
        overlays.typed_path.ui(ctx, settings.language, out);
        self.overlays.notices.take_escape(ctx);
    }
}
