//! A sheet with the faces for SiGML's non-manuals.

use chereme_figure::face_sheet;
use chereme_sign::hamnosys::face::Expression;

use super::*;

/// The size of one face in pixels.
const FACE: usize = 160;

/// Draws every listed face of SiGML on the program's own body.
pub(super) fn draw(to: &Path, options: &PictureOptions) -> Result<Picture> {
    if extension(to) != "png" {
        return Err(ending(to, "faces are drawn to a .png"));
    }
    let face = |(code, means): (&str, &str)| {
        let (part, short) = code.split_once('.')?;
        let expression = Expression::of(part, short)?;
        Some((format!("{short} {means}"), expression.fullest()))
    };
    let faces: Vec<_> = Expression::listed().filter_map(face).collect();
    let (clip, anatomy) = built_in_body()?;
    let size = options.height.unwrap_or(FACE);
    let image = face_sheet((&clip, &anatomy), &faces, 8, size).map_err(figure)?;
    let bytes = write(to, options.force, |out| {
        write_png(&image, out).map_err(figure)
    })?;
    Ok(picture_report(to, FACES, bytes, faces.len()))
}
