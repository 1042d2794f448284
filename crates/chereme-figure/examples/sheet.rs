//! Draws a demo clip of handshapes: `cargo run --release --example sheet -- FOLDER`.

use std::error::Error;
use std::fs::File;
use std::io::BufWriter;
use std::ops::ControlFlow;
use std::path::Path;

use chereme_figure::animation::{Animation, AnimationOptions, write_gif};
use chereme_figure::chart::{ChartOptions, alignment_picture};
use chereme_figure::handshape::{HandshapeOptions, handshape_sheet};
use chereme_figure::sheet::{Frames, SheetOptions, contact_sheet};
use chereme_figure::{Image, writer};
use chereme_motion::{Anatomy, HandAngles, Side};

#[path = "common/signer.rs"]
mod signer;

#[allow(clippy::print_stdout)]
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
    writer::write_png(image, BufWriter::new(File::create(path)?))?;
    Ok(())
}
