//! Makes the starter corpus in `corpus/`: `cargo run -p chereme-corpus --example make_starter`.

use std::fs;
use std::io;
use std::path::Path;

#[path = "all.rs"]
mod all;

fn main() -> io::Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus");
    fs::create_dir_all(&folder)?;
    let performances = all::performances();
    for (take, performance) in &performances {
        let missed = performance.residual;
        if missed > 1e-6 {
            let what = format!("{}: a wrist misses its place by {missed} m", take.stem);
            return Err(io::Error::other(what));
        }
    }
    for (name, bytes) in all::files(&performances) {
        fs::write(folder.join(name), bytes)?;
    }
    Ok(())
}
