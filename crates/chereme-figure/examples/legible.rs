//! Measures how well handshapes are distinguished in small pictures: `cargo run --release --example legible -- FILE [VIEW]`.
//!
//! VIEW is `three-quarter` as usual, `palm`, `thumb`, `back`, or `two`: three-quarter and from the thumb's side, next
//! to each other, each of the measured size.
//!
//! FILE is an inventory of handshapes, such as `schema/inventories/configurations.json`. Draws every handshape at 24,
//! 48 and 96 pixels, and prints for each size the mean and the fifth percentile of the distance to the nearest other
//! shape, the pairs nearer than 0.08, and the share of noisy pictures (joints turned by up to 6 degrees) whose nearest
//! template is their own shape.

use std::error::Error;

use chereme_figure::{HandView, HandshapeOptions, RasterImage, handshape_picture};
use chereme_motion::{FingerAngles, HandAngles, ThumbAngles};
use serde_json::Value;

#[path = "common/likeness.rs"]
mod likeness;

use likeness::{Random, Tones, nearest, summary, tones};

/// The shapes of the noise test among the twelve that differ most.
const CLEAR: [&str; 12] = ["flat", "S", "1", "V", "Y", "claw", "F", "O", "L", "C", "5", "pinch"];
/// The number of noisy pictures of each shape.
const TRIES: usize = 3;

#[allow(clippy::print_stdout, reason = "the table is the program's result")]
fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).ok_or("name an inventory of handshapes")?;
    let view = std::env::args().nth(2).unwrap_or_default();
    let views: &[HandView] = match view.as_str() {
        "palm" => &[HandView::Palm],
        "thumb" => &[HandView::Thumb],
        "back" => &[HandView::Back],
        "two" => &[HandView::ThreeQuarter, HandView::Thumb],
        _ => &[HandView::ThreeQuarter],
    };
    let inventory: Value = serde_json::from_str(&std::fs::read_to_string(file)?)?;
    let values = inventory["values"].as_array().ok_or("no values")?;
    let shapes: Vec<(String, HandAngles)> = values
        .iter()
        .filter_map(|value| Some((value["id"].as_str()?.to_owned(), angles(&value["pose"])?)))
        .collect();
    println!("{} shapes", shapes.len());
    println!("| px | mean | p5 | pairs < .08 | noise, 12 | noise, all | nearest pairs |");
    println!("|---|---|---|---|---|---|---|");
    for size in [24, 48, 96] {
        let drawn = shapes.iter().map(|(_, it)| picture(it, (size, views)));
        let drawn: Result<Vec<Tones>, _> = drawn.collect();
        let drawn = drawn?;
        let all: Vec<usize> = (0..shapes.len()).collect();
        let clear: Vec<usize> = all
            .iter()
            .copied()
            .filter(|&i| CLEAR.contains(&shapes[i].0.as_str()))
            .collect();
        let names: Vec<&str> = shapes.iter().map(|it| it.0.as_str()).collect();
        let [few, many] = [clear, all].map(|set| noise(&shapes, &drawn, &set, (size, views)));
        let shares = [few?, many?].map(|share| format!("{:.0} %", share * 100.0));
        println!("| {size} | {} |", summary(&drawn, &names, &shares));
    }
    Ok(())
}

fn picture(angles: &HandAngles, (size, views): (usize, &[HandView])) -> Result<Tones, Box<dyn Error>> {
    let usual = HandshapeOptions::with_small_size(size);
    let mut all = RasterImage::new(size * views.len(), size, usual.style.theme.theme_paper_colour());
    for (at, view) in views.iter().enumerate() {
        let options = HandshapeOptions {
            view: *view,
            ..usual.clone()
        };
        all.paste_image(&handshape_picture(angles, &options)?, [at * size, 0]);
    }
    Ok(tones(&all))
}

/// Returns the share of noisy pictures whose nearest template is their own shape.
fn noise(
    shapes: &[(String, HandAngles)],
    drawn: &[Tones],
    set: &[usize],
    (size, views): (usize, &[HandView]),
) -> Result<f32, Box<dyn Error>> {
    let mut random = Random::default();
    let mut next = move || random.next();
    let (mut right, mut count) = (0, 0);
    for &index in set {
        for _ in 0..TRIES {
            let mut angles = shapes[index].1;
            let most = 6f64.to_radians();
            let thumb = &mut angles.thumb;
            for angle in [&mut thumb.radial, &mut thumb.palmar, &mut thumb.opposition] {
                *angle += next() * most;
            }
            for angle in &mut thumb.flexion {
                *angle += next() * most;
            }
            for finger in &mut angles.fingers {
                finger.spread += next() * most * 0.5;
                for angle in &mut finger.flexion {
                    *angle += next() * most;
                }
            }
            let noisy = picture(&angles, (size, views))?;
            let own = nearest(drawn, &noisy, set.iter().copied());
            right += usize::from(own.is_some_and(|(_, other)| other == index));
            count += 1;
        }
    }
    Ok(right as f32 / count.max(1) as f32)
}

fn angles(pose: &Value) -> Option<HandAngles> {
    let number = |value: &Value| value.as_f64().map(f64::to_radians);
    let thumb = &pose["thumb"];
    let finger = |name: &str| {
        let finger = &pose[name];
        let bent = |n: usize| number(&finger["flexion"][n]);
        Some(FingerAngles {
            spread: number(&finger["spread"])?,
            flexion: [bent(0)?, bent(1)?, bent(2)?],
        })
    };
    Some(HandAngles {
        thumb: ThumbAngles {
            radial: number(&thumb["radial"])?,
            palmar: number(&thumb["palmar"])?,
            opposition: number(&thumb["opposition"])?,
            flexion: [number(&thumb["flexion"][0])?, number(&thumb["flexion"][1])?],
        },
        fingers: [finger("index")?, finger("middle")?, finger("ring")?, finger("little")?],
    })
}
