//! Draws a demo clip of handshapes: `cargo run --release --example sheet -- FOLDER`.

use std::error::Error;
use std::fs::File;
use std::io::BufWriter;
use std::ops::ControlFlow;
use std::path::Path;

use chereme_figure::raster::FigureStyle;
use chereme_figure::{
    AnimationOptions, ChartOptions, ClipAnimation, FigureView, HandshapeOptions, PaperTheme, RasterImage, SheetFrames,
    SheetOptions, alignment_picture, clip_thumbnail, contact_sheet, handshape_sheet, write_gif, write_png,
};
use chereme_motion::{BodyAnatomy, BodySide, HandAngles};

#[path = "common/signer.rs"]
mod signer;

#[allow(clippy::print_stdout, reason = "a program prints its figures")]
fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).ok_or("name a folder for the pictures")?;
    let folder = Path::new(&folder);
    std::fs::create_dir_all(folder)?;
    let clip = signer::handshapes()?;
    let anatomy = BodyAnatomy::detect_anatomy(clip.clip_skeleton());
    let options = SheetOptions {
        title: "Handshapes: 5 B U V Y S O 1".into(),
        frames: SheetFrames::Spaced(8),
        ..SheetOptions::default()
    };
    let mut go = |_, _| ControlFlow::Continue(());
    let sheet = contact_sheet(&clip, &anatomy, &options.with_hands(), &mut go)?;
    save(&sheet, &folder.join("sheet.png"))?;
    let mut animation = ClipAnimation::new(&clip, &anatomy, AnimationOptions::default())?;
    let start = std::time::Instant::now();
    let out = BufWriter::new(File::create(folder.join("animation.gif"))?);
    write_gif(&mut animation, out, &mut go)?;
    println!(
        "{} pictures in {:?}",
        animation.animation_frame_count(),
        start.elapsed()
    );
    save(&animation.draw_animation_frame(20), &folder.join("frame.png"))?;
    let mut dark = SheetOptions {
        frames: SheetFrames::At(vec![2, 20, 36]),
        views: FigureView::ALL_FIGURE_VIEWS.to_vec(),
        ..SheetOptions::default()
    };
    dark.style.theme = PaperTheme::Dark;
    let views = contact_sheet(&clip, &anatomy, &dark, &mut go)?;
    save(&views, &folder.join("views.png"))?;
    let small = clip_thumbnail(&clip, &anatomy, [120, 120], &FigureStyle::default())?;
    save(&small, &folder.join("thumbnail.png"))?;
    let shapes: Vec<(String, HandAngles)> = (0..clip.clip_frame_count())
        .step_by(8)
        .zip("5 B U V Y S O 1".split(' '))
        .filter_map(|(frame, name)| {
            let pose = clip.clip_pose_at(frame);
            let angles = anatomy.hand_angles(clip.clip_skeleton(), BodySide::Right, &pose)?;
            Some((name.to_owned(), angles))
        })
        .collect();
    let hands = handshape_sheet(&shapes, 8, &HandshapeOptions::default())?;
    save(&hands, &folder.join("handshapes.png"))?;
    let path: Vec<(usize, usize)> = (0..60).map(|i| (i, i * i / 75)).collect();
    let chart = alignment_picture(&path, [60, 48], &ChartOptions::default())?;
    save(&chart, &folder.join("alignment.png"))?;
    Ok(())
}

fn save(image: &RasterImage, path: &Path) -> Result<(), Box<dyn Error>> {
    write_png(image, BufWriter::new(File::create(path)?))?;
    Ok(())
}
