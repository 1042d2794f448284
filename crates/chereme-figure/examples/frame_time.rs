//! Measures drawing: `cargo run --release --example frame_time -- [FRAMES]`.
//!
//! Prints the time of one picture of 400 by 500 pixels of a whole signer with full hands, posing the body included, of
//! the body alone, of the window's stage with two signers by one thread and by two, and of a little figure; each over
//! FRAMES frames, at most 64. With two threads, the time is that of the first one, as the other works at the same time.

use std::error::Error;
use std::hint::black_box;
use std::time::{Duration, Instant};

use chereme_figure::mesh::TriangleMesh;
use chereme_figure::raster::{FigureRaster, FigureStyle, RasterLayer};
use chereme_figure::{ClipFraming, FigureView, RasterImage, SignerBody};
use chereme_motion::BodyAnatomy;

#[path = "common/signer.rs"]
mod signer;

/// Returns the time on this thread's processor clock if the system has one, else the elapsed time: on a busy machine
/// only the first measures drawing.
fn now(begun: Instant) -> Duration {
    let statistics = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let used = statistics.and_then(|text| text.split(' ').next()?.parse().ok());
    used.map_or_else(|| begun.elapsed(), Duration::from_nanos)
}

#[allow(clippy::print_stdout, reason = "a program prints its figures")]
fn main() -> Result<(), Box<dyn Error>> {
    let clip = signer::handshapes()?;
    let anatomy = BodyAnatomy::detect_anatomy(clip.clip_skeleton());
    let body = SignerBody::new(clip.clip_skeleton(), &anatomy);
    let framing = ClipFraming::framing_from_clip(&clip, &anatomy).ok_or("an empty clip")?;
    let (mut mesh, mut raster) = (TriangleMesh::default(), FigureRaster::default());
    let frames = std::env::args().nth(1).map(|text| text.parse());
    let frames = frames
        .transpose()?
        .unwrap_or(clip.clip_frame_count())
        .min(clip.clip_frame_count());
    let begun = Instant::now();
    let mut times = [Vec::new(), Vec::new()];
    for round in 0..10 * frames {
        let pose = clip.model_pose(round % frames);
        let start = now(begun);
        body.shape_body_mesh(&pose, &mut mesh);
        times[0].push(now(begun) - start);
        let camera = framing.framing_camera(FigureView::Addressee, 0.8, &pose, &anatomy);
        black_box(raster.draw_mesh_picture(&mesh, &camera, [400, 500], &FigureStyle::default()));
        times[1].push(now(begun) - start);
    }
    println!("{} triangles", body.posed_mesh(&clip.model_pose(0)).triangles.len());
    let mut measure = |size: [usize; 2], count: usize, style: &FigureStyle| {
        let mut times = Vec::new();
        for frame in 0..frames {
            let pose = clip.model_pose(frame);
            let start = now(begun);
            let aspect = size[0] as f32 / size[1] as f32;
            let camera = framing.framing_camera(FigureView::Addressee, aspect, &pose, &anatomy);
            let mut image = RasterImage::new(size[0], size[1], style.theme.theme_paper_colour());
            for _ in 0..count {
                body.shape_body_mesh(&pose, &mut mesh);
                let layer = RasterLayer {
                    mesh: &mesh,
                    opacity: 0.6,
                    veiled: false,
                };
                raster.draw_over(&mut image, layer, &camera, style);
            }
            black_box(&image);
            times.push(now(begun) - start);
        }
        times
    };
    let style = |samples, threads| FigureStyle {
        samples,
        threads,
        ..FigureStyle::default()
    };
    let more = [
        measure([1280, 800], 2, &style(1, 1)),
        measure([1280, 800], 2, &style(1, 2)),
        measure([1280, 800], 2, &style(2, 2)),
        measure([152, 152], 1, &style(2, 1)),
    ];
    let names = [
        "body",
        "body and picture",
        "two at 1280x800",
        "two at 1280x800, two threads",
        "two at 1280x800, two threads, four samples",
        "little",
    ];
    for (name, mut times) in names.into_iter().zip(times.into_iter().chain(more)) {
        times.sort_unstable();
        println!("{name}: median {:?}, least {:?}", times[times.len() / 2], times[0]);
    }
    Ok(())
}
