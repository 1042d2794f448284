//! Measures drawing: `cargo run --release --example frame_time`.
//!
//! Prints the time of one picture of 400 by 500 pixels of a whole signer with full hands, posing
//! the body included, and of the body alone.

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use chereme_figure::mesh::Mesh;
use chereme_figure::raster::{Raster, Style};
use chereme_figure::{Body, Framing, View};
use chereme_motion::Anatomy;

#[path = "common/signer.rs"]
mod signer;

#[allow(clippy::print_stdout)]
fn main() -> Result<(), Box<dyn Error>> {
    let clip = signer::handshapes()?;
    let anatomy = Anatomy::detect(clip.skeleton());
    let body = Body::new(clip.skeleton(), &anatomy);
    let framing = Framing::of(&clip, &anatomy).ok_or("an empty clip")?;
    let (mut mesh, mut raster) = (Mesh::default(), Raster::default());
    let mut times = [Vec::new(), Vec::new()];
    for round in 0..10 * clip.frames() {
        let pose = clip.model_pose(round % clip.frames());
        let start = Instant::now();
        body.shape(&pose, &mut mesh);
        times[0].push(start.elapsed());
        let camera = framing.camera(View::Addressee, 0.8, &pose, &anatomy);
        black_box(raster.draw(&mesh, &camera, [400, 500], &Style::default()));
        times[1].push(start.elapsed());
    }
    println!(
        "{} vertices, {} triangles",
        mesh.vertices.len(),
        mesh.triangles.len()
    );
    for (name, mut times) in ["body", "body and picture"].into_iter().zip(times) {
        times.sort_unstable();
        println!(
            "{name}: median {:?}, least {:?}",
            times[times.len() / 2],
            times[0]
        );
    }
    Ok(())
}
