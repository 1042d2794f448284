//! Draws contact sheets of signs from notation.

use std::fs::File;
use std::io::BufWriter;
use std::ops::ControlFlow;
use std::path::Path;

use chereme_compose::notation::{AnimatorSettings, animate_signs};
use chereme_figure::sheet::{SheetFrames, SheetOptions, contact_sheet};
use chereme_figure::writer::write_png;

use crate::{Result, bodies};

/// Returns the names of `count` signs of a folder that a seed chooses, in the order of the folder.
pub(crate) fn chosen(folder: &Path, count: usize, seed: u64) -> Result<Vec<String>> {
    let mut names: Vec<String> = bodies::signs(folder)?.into_iter().map(|it| it.0).collect();
    names.dedup();
    let mut state = seed;
    while names.len() > count {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        names.remove((state >> 33) as usize % names.len());
    }
    Ok(names)
}

/// The part of a movement that a sheet shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Shown {
    /// The sign alone.
    Sign,
    /// The whole movement, from rest to rest.
    Whole,
}

/// Draws a sheet `GLOSS.png` in `out` for each of these signs.
pub(crate) fn sheets(folder: &Path, body: &Path, out: &Path, (glosses, what): (&[&str], Shown)) -> Result<()> {
    std::fs::create_dir_all(out)?;
    let stage = bodies::stage(body)?;
    for (name, notated) in bodies::signs(folder)? {
        if !glosses.contains(&name.as_str()) {
            continue;
        }
        let made = animate_signs(&[&notated], &stage, &AnimatorSettings::default())?;
        let span = made
            .notes
            .iter()
            .find(|note| note.about == chereme_compose::NoteSubject::Gloss)
            .map(|note| made.clip.clip_frame_rate().frames_in(note.span));
        let frames = span
            .filter(|span| span.len() > 1 && what == Shown::Sign)
            .unwrap_or(0..made.clip.clip_frame_count());
        let most = if what == Shown::Sign { 7 } else { 12 };
        let count = most.min(frames.len());
        let shown = (0..count).map(|n| frames.start + n * (frames.len() - 1) / (count - 1).max(1));
        let options = SheetOptions {
            title: name.clone(),
            frames: SheetFrames::At(shown.map(|frame| frame.min(made.clip.clip_frame_count() - 1)).collect()),
            cell_height: 230,
            ..SheetOptions::default()
        };
        let mut progress = |_, _| ControlFlow::Continue(());
        let sheet = contact_sheet(&made.clip, &made.anatomy, &options, &mut progress)?;
        let file = File::create(out.join(format!("{name}.png")))?;
        write_png(&sheet, BufWriter::new(file))?;
        println!(
            "{name}: {} frames; {}",
            made.clip.clip_frame_count(),
            made.report.warnings.join("; ")
        );
    }
    Ok(())
}
