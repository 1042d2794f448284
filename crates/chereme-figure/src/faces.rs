//! Draws several facial expressions of the signer as a table, each above its name.

use chereme_motion::{Anatomy, Clip, Face};

use crate::body::Body;
use crate::error::FigureError;
use crate::handshape::table;
use crate::image::Image;
use crate::mesh::Mesh;
use crate::raster::{Raster, Style};
use crate::view::{Framing, View};

/// Draws faces as a table, `columns` in a row, each above its name and `size` pixels high and wide, on the
/// head of the signer in the first frame of `clip`.
///
/// # Errors
/// [`FigureError`] if there is no face or no frame, or the table would be too large.
pub fn face_sheet(
    (clip, anatomy): (&Clip, &Anatomy),
    faces: &[(String, Face)],
    columns: usize,
    size: usize,
) -> Result<Image, FigureError> {
    if faces.is_empty() {
        return Err(FigureError::Nothing { what: "face" });
    }
    let framing = Framing::of(clip, anatomy).ok_or(FigureError::Empty)?;
    let body = Body::new(clip.skeleton(), anatomy);
    let pose = clip.model_pose(0);
    let camera = framing.camera(View::Face, 1.0, &pose, anatomy);
    let (style, mut raster, mut mesh) = (Style::default(), Raster::default(), Mesh::default());
    table(faces, (columns, size, style.theme), |face, cell| {
        body.shape(&pose, &mut mesh);
        body.express(&pose, face, &mut mesh);
        raster.draw(&mesh, &camera, cell, &style)
    })
}
