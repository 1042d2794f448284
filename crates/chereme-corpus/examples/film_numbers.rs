//! Prints the properties of a film and the SHA-256 of all its decoded numbers, for comparison with those of FFmpeg:
//!
//! ```sh
//! cargo run --release -p chereme-corpus --example film_numbers -- take.mp4
//! ```
//!
//! FFmpeg computes its hash by `ffmpeg -noautorotate -i take.mp4 -f rawvideo -pix_fmt yuv420p - | sha256sum`. With a
//! second argument the frames are decoded from the last to the first, which shows that seeking gives the same numbers.

use std::path::Path;
use std::time::Instant;

use chereme_corpus::FilmFile;
use sha2::{Digest, Sha256};

#[allow(clippy::print_stdout, reason = "a program for the terminal")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().ok_or("which film?")?;
    let backwards = arguments.next().is_some();
    let begun = Instant::now();
    let mut film = FilmFile::open_film(Path::new(&path))?;
    println!("opened in {:.1} ms", begun.elapsed().as_secs_f64() * 1e3);
    println!("{:#?}", film.film_facts());
    let frames = film.film_times().film_frame_count();
    let begun = Instant::now();
    if backwards {
        for frame in (0..frames).rev() {
            film.decoded_frame_planes(frame, &|| false)?;
        }
    }
    let mut hash = Sha256::new();
    for frame in 0..frames {
        let planes = film.decoded_frame_planes(frame, &|| false)?;
        hash.update(&planes.y);
        hash.update(&planes.u);
        hash.update(&planes.v);
    }
    let seconds = begun.elapsed().as_secs_f64();
    println!(
        "{frames} frames in {seconds:.2} s, {:.0} a second",
        frames as f64 / seconds
    );
    let hash: String = hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
    println!("sha256 {hash}");
    Ok(())
}
