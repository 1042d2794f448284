//! A sheet with the faces for SiGML's non-manuals.

use chereme_figure::face_sheet;
use chereme_sign::hamnosys::hamnosys_face::FacialExpression;

use super::*;

/// The size of one face in pixels.
const FACE_PICTURE_SIZE_PX: usize = 160;

/// Draws every listed face of SiGML on the program's own body.
pub(super) fn draw_face_sheet(to: &Path, options: &PictureOptions) -> CorpusResult<DrawnPicture> {
    if lowercase_extension(to) != "png" {
        return Err(missing_ending_error(to, "faces are drawn to a .png"));
    }
    let face = |(code, means): (&str, &str)| {
        let (part, short) = code.split_once('.')?;
        let expression = FacialExpression::from_nonmanual_code(part, short)?;
        Some((format!("{short} {means}"), expression.fullest_face()))
    };
    let faces: Vec<_> = FacialExpression::listed_expression_codes().filter_map(face).collect();
    let (clip, anatomy) = built_in_body()?;
    let size = options.height.unwrap_or(FACE_PICTURE_SIZE_PX);
    let image = face_sheet(&clip, &anatomy, &faces, 8, size).map_err(picture_figure_error)?;
    let bytes = write_atomically(to, options.force, |out| {
        write_png(&image, out).map_err(picture_figure_error)
    })?;
    Ok(picture_report(to, SIGML_FACE_INVENTORY, bytes, faces.len()))
}
