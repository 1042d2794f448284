//! Measures how well places and mouth pictures are distinguished in small pictures:
//! `cargo run --release --example legible_values -- [FOLDER]`.
//!
//! Draws every place of the built-in inventory, those of the head alone, and every mouth picture at 24, 48 and 96
//! pixels, as the window's cells and pickers do. Prints for each size the mean and the fifth percentile of the distance
//! to the nearest other picture, the pictures nearer than 0.08, and the share of noisy pictures whose nearest template
//! is their own: places with the camera turned by up to 6 degrees, faces with their numbers changed by up to 10 %.
//! FOLDER gets a sheet of the pictures of each size.

use std::error::Error;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use chereme_corpus::value_pictures::{PlacePanel, RestingBodyScene, facial_expression_of_value, turned_camera};
use chereme_figure::{PaperTheme, RasterImage, write_png};
use chereme_motion::FacePosture;
use chereme_sign::ComponentInventory;
use chereme_sign::inventory::{InventoryValue, builtin_by_id};

#[path = "../../chereme-figure/examples/common/likeness.rs"]
mod likeness;

use likeness::{Random, Tones, nearest, summary, tones};

/// The number of noisy pictures of each value.
const TRIES: usize = 3;
const SIZES: [usize; 3] = [24, 48, 96];

/// Draws the value at an index, as it is or noisy.
type Draw<'a> = Box<dyn Fn(usize, usize, Option<&mut Random>) -> Option<RasterImage> + 'a>;

/// A set of values to draw.
struct Set<'a> {
    name: &'static str,
    /// Whether the position in the picture counts, so that pictures are compared without shifts.
    placed: bool,
    names: Vec<&'a str>,
    draw: Draw<'a>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1);
    let scene = RestingBodyScene::new()?;
    let places = builtin_by_id("placements").ok_or("no places")?;
    let mouth = builtin_by_id("mouth").ok_or("no mouths")?;
    let on_head = |value: &&InventoryValue| {
        let landmark = value.landmark.as_ref();
        landmark.is_some_and(|it| PlacePanel::panel_of_landmark(it) == PlacePanel::Head)
    };
    let head: Vec<&InventoryValue> = places.values.iter().filter(on_head).collect();
    let all: Vec<&InventoryValue> = places.values.iter().collect();
    let sets = [
        set_of_places("places of the head", (&scene, places), &head),
        set_of_places("all places", (&scene, places), &all),
        set_of_faces("mouth", &scene, mouth),
    ];
    measure(&sets, folder.as_deref().map(Path::new))
}

#[allow(clippy::print_stdout, reason = "the table is the program's result")]
fn measure(sets: &[Set<'_>], folder: Option<&Path>) -> Result<(), Box<dyn Error>> {
    println!("| pictures | number | px | mean | p5 | < .08 | noise | nearest pairs |");
    println!("|---|---|---|---|---|---|---|---|");
    for set in sets {
        for size in SIZES {
            let count = set.names.len();
            let images: Option<Vec<RasterImage>> = (0..count).map(|at| (set.draw)(at, size, None)).collect();
            let images = images.ok_or("a value without a picture")?;
            let seen = |image: &RasterImage| match set.placed {
                true => tones(image).fixed(),
                false => tones(image),
            };
            let drawn: Vec<Tones> = images.iter().map(seen).collect();
            let (mut random, mut right) = (Random::default(), 0);
            for at in 0..count {
                for _ in 0..TRIES {
                    let noisy = (set.draw)(at, size, Some(&mut random)).ok_or("no picture")?;
                    let own = nearest(&drawn, &seen(&noisy), 0..count);
                    right += usize::from(own.is_some_and(|(_, other)| other == at));
                }
            }
            let share = 100.0 * right as f32 / (count * TRIES) as f32;
            let row = summary(&drawn, &set.names, &[format!("{share:.0} %")]);
            println!("| {} | {count} | {size} | {row} |", set.name);
            if let Some(folder) = folder {
                let file = folder.join(format!("{}-{size}.png", set.name.replace(' ', "-")));
                write_png(&sheet(&images, size), BufWriter::new(File::create(file)?))?;
            }
        }
    }
    Ok(())
}

fn set_of_places<'a>(
    name: &'static str,
    (scene, inventory): (&'a RestingBodyScene, &'a ComponentInventory),
    values: &[&'a InventoryValue],
) -> Set<'a> {
    let values = values.to_vec();
    let names = values.iter().map(|it| it.id.as_str()).collect();
    let draw = move |at: usize, size, noise: Option<&mut Random>| {
        let value = values[at];
        let mut camera = scene.panel_camera(PlacePanel::panel_of_landmark(value.landmark.as_ref()?), false)?;
        if let Some(random) = noise {
            let most = 6f64.to_radians();
            let mut next = || (random.next() * most) as f32;
            camera = turned_camera(&camera, [next(), next()]);
        }
        scene.place_from(inventory, value, &camera, size, PaperTheme::Light)
    };
    Set {
        name,
        placed: true,
        names,
        draw: Box::new(draw),
    }
}

fn set_of_faces<'a>(name: &'static str, scene: &'a RestingBodyScene, inventory: &'a ComponentInventory) -> Set<'a> {
    let values = inventory.values.iter();
    let mut faces: Vec<(&str, FacePosture)> = Vec::new();
    for value in values {
        // Two codes for the same face are one picture.
        if let Some(face) = facial_expression_of_value(inventory, value)
            && faces.iter().all(|(_, known)| *known != face)
        {
            faces.push((&value.id, face));
        }
    }
    let names = faces.iter().map(|it| it.0).collect();
    let feature = inventory.feature.clone().unwrap_or_default();
    let draw = move |at: usize, size, noise: Option<&mut Random>| {
        let mut face = faces[at].1;
        if let Some(random) = noise {
            let numbers = face.face_numbers().map(|it| it * (1.0 + 0.1 * random.next()));
            face = FacePosture::from_numbers(numbers);
        }
        scene.draw_expression_picture(&face, &feature, size, PaperTheme::Light)
    };
    Set {
        name,
        placed: false,
        names,
        draw: Box::new(draw),
    }
}

fn sheet(images: &[RasterImage], size: usize) -> RasterImage {
    const COLUMNS: usize = 12;
    let step = size + 4;
    let rows = images.len().div_ceil(COLUMNS);
    let paper = PaperTheme::Light.theme_paper_colour();
    let mut sheet = RasterImage::new(COLUMNS * step, rows * step, paper);
    for (at, image) in images.iter().enumerate() {
        sheet.paste_image(image, [at % COLUMNS * step, at / COLUMNS * step]);
    }
    sheet
}
