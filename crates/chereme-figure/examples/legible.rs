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

use chereme_figure::{HandView, HandshapeOptions, Image, handshape_picture};
use chereme_motion::{FingerAngles, HandAngles, ThumbAngles};
use serde_json::Value;

/// The shapes of the noise test among the twelve that differ most.
const CLEAR: [&str; 12] = [
    "flat", "S", "1", "V", "Y", "claw", "F", "O", "L", "C", "5", "pinch",
];
/// The number of noisy pictures of each shape.
const TRIES: usize = 3;

#[allow(clippy::print_stdout, reason = "the table is the program's result")]
fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args()
        .nth(1)
        .ok_or("name an inventory of handshapes")?;
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
        let mut near: Vec<(f32, usize, usize)> = (0..drawn.len())
            .filter_map(|a| nearest(&drawn, &drawn[a], Some(a)).map(|(far, b)| (far, a, b)))
            .collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mean = near.iter().map(|it| it.0).sum::<f32>() / near.len().max(1) as f32;
        let fifth = near.get(near.len() / 20).map_or(0.0, |it| it.0);
        let close = near.iter().filter(|it| it.0 < 0.08).count();
        let all: Vec<usize> = (0..shapes.len()).collect();
        let clear: Vec<usize> = all
            .iter()
            .copied()
            .filter(|&i| CLEAR.contains(&shapes[i].0.as_str()))
            .collect();
        let pairs: Vec<String> = near
            .iter()
            .step_by(2)
            .take(4)
            .map(|&(_, a, b)| format!("{}/{}", shapes[a].0, shapes[b].0))
            .collect();
        let [few, many] = [clear, all].map(|set| noise(&shapes, &drawn, &set, (size, views)));
        println!(
            "| {size} | {mean:.3} | {fifth:.3} | {close} | {:.0} % | {:.0} % | {} |",
            few? * 100.0,
            many? * 100.0,
            pairs.join(", ")
        );
    }
    Ok(())
}

/// Lightness of a picture, and which pixels differ from the paper.
struct Tones {
    /// Columns and rows.
    size: [usize; 2],
    light: Vec<f32>,
    inked: Vec<bool>,
}

fn picture(
    angles: &HandAngles,
    (size, views): (usize, &[HandView]),
) -> Result<Tones, Box<dyn Error>> {
    let usual = HandshapeOptions::small(size);
    let mut all = Image::new(size * views.len(), size, usual.style.theme.background());
    for (at, view) in views.iter().enumerate() {
        let options = HandshapeOptions {
            view: *view,
            ..usual.clone()
        };
        all.paste(&handshape_picture(angles, &options)?, [at * size, 0]);
    }
    Ok(tones(&all))
}

fn tones(image: &Image) -> Tones {
    let paper = image.pixel(0, 0);
    Tones {
        size: [image.width(), image.height()],
        light: image
            .pixels()
            .iter()
            .map(|pixel| lightness(pixel.0))
            .collect(),
        inked: image.pixels().iter().map(|&pixel| pixel != paper).collect(),
    }
}

/// Returns the lightness of a colour as in CIE L*a*b*, from 0 to 100.
fn lightness(rgb: [u8; 3]) -> f32 {
    let [r, g, b] = rgb.map(|part| {
        let part = f32::from(part) / 255.0;
        if part <= 0.04045 {
            part / 12.92
        } else {
            ((part + 0.055) / 1.055).powf(2.4)
        }
    });
    let bright = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    if bright > 0.008_856 {
        116.0 * bright.cbrt() - 16.0
    } else {
        903.3 * bright
    }
}

/// Returns the root mean square difference of lightness over the pixels of both hands, the least over small shifts.
fn distance(a: &Tones, b: &Tones) -> f32 {
    let [wide, high] = a.size.map(|side| side as i64);
    let most = (high / 32).max(1);
    let mut least = f32::INFINITY;
    for dy in -most..=most {
        for dx in -most..=most {
            let (mut sum, mut count) = (0.0f32, 0usize);
            for y in 0..high {
                for x in 0..wide {
                    let own = (y * wide + x) as usize;
                    let (u, v) = (x + dx, y + dy);
                    let inside = (0..wide).contains(&u) && (0..high).contains(&v);
                    let other = inside.then_some((v * wide + u) as usize);
                    let inked = a.inked[own] || other.is_some_and(|other| b.inked[other]);
                    if inked {
                        let light = other.map_or(b.light[0], |other| b.light[other]);
                        sum += (a.light[own] - light).powi(2);
                        count += 1;
                    }
                }
            }
            least = least.min((sum / count.max(1) as f32).sqrt() / 100.0);
        }
    }
    least
}

fn nearest(all: &[Tones], one: &Tones, without: Option<usize>) -> Option<(f32, usize)> {
    (0..all.len())
        .filter(|&index| Some(index) != without)
        .map(|index| (distance(&all[index], one), index))
        .min_by(|a, b| a.0.total_cmp(&b.0))
}

/// Returns the share of noisy pictures whose nearest template is their own shape.
fn noise(
    shapes: &[(String, HandAngles)],
    drawn: &[Tones],
    set: &[usize],
    (size, views): (usize, &[HandView]),
) -> Result<f32, Box<dyn Error>> {
    let mut random = 0x2545_F491_4F6C_DD1Du64;
    let mut next = move || {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        (random >> 40) as f64 / f64::from(1u32 << 24) * 2.0 - 1.0
    };
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
            let best = set
                .iter()
                .map(|&other| (distance(&drawn[other], &noisy), other))
                .min_by(|a, b| a.0.total_cmp(&b.0));
            right += usize::from(best.is_some_and(|(_, other)| other == index));
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
        fingers: [
            finger("index")?,
            finger("middle")?,
            finger("ring")?,
            finger("little")?,
        ],
    })
}
