//! Draws a demo clip of handshapes: `cargo run --release --example sheet -- FOLDER`.

use std::error::Error;
use std::fs::File;
use std::io::BufWriter;
use std::ops::ControlFlow;
use std::path::Path;

use chereme_figure::raster::Style;
use chereme_figure::{
    Animation, AnimationOptions, ChartOptions, Frames, HandshapeOptions, Image, SheetOptions,
    Theme, View, alignment_picture, contact_sheet, handshape_sheet, thumbnail, write_gif,
    write_png,
};
use chereme_motion::{Anatomy, HandAngles, Side};

#[path = "common/signer.rs"]
mod signer;

#[allow(clippy::print_stdout, reason = "a program prints its figures")]
fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args()
        .nth(1)
        .ok_or("name a folder for the pictures")?;
    let folder = Path::new(&folder);
    std::fs::create_dir_all(folder)?;
    let clip = signer::handshapes()?;
    let anatomy = Anatomy::detect(clip.skeleton());
    let options = SheetOptions {
        title: "Handshapes: 5 B U V Y S O 1".into(),
        frames: Frames::Spaced(8),
        ..SheetOptions::default()
    };
    let mut go = |_, _| ControlFlow::Continue(());
    let sheet = contact_sheet(&clip, &anatomy, &options.with_hands(), &mut go)?;
    save(&sheet, &folder.join("sheet.png"))?;
    let mut animation = Animation::new(&clip, &anatomy, AnimationOptions::default())?;
    let start = std::time::Instant::now();
    let out = BufWriter::new(File::create(folder.join("animation.gif"))?);
    write_gif(&mut animation, out, &mut go)?;
    println!("{} pictures in {:?}", animation.frames(), start.elapsed());
    save(&animation.draw(20), &folder.join("frame.png"))?;
    let mut dark = SheetOptions {
        frames: Frames::At(vec![2, 20, 36]),
        views: View::ALL.to_vec(),
        ..SheetOptions::default()
    };
    dark.style.theme = Theme::Dark;
    let views = contact_sheet(&clip, &anatomy, &dark, &mut go)?;
    save(&views, &folder.join("views.png"))?;
    let small = thumbnail(&clip, &anatomy, [120, 120], &Style::default())?;
    save(&small, &folder.join("thumbnail.png"))?;
    let shapes: Vec<(String, HandAngles)> = (0..clip.frames())
        .step_by(8)
        .zip("5 B U V Y S O 1".split(' '))
        .filter_map(|(frame, name)| {
            let pose = clip.pose(frame);
            let angles = anatomy.hand_angles(clip.skeleton(), Side::Right, &pose)?;
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

fn save(image: &Image, path: &Path) -> Result<(), Box<dyn Error>> {
    write_png(image, BufWriter::new(File::create(path)?))?;
    Ok(())
}
