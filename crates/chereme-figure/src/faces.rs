//! Draws several facial expressions of the signer as a table, each above its name.

use chereme_motion::{BodyAnatomy, Clip, FacePosture};

use crate::body::SignerBody;
use crate::error::FigureError;
use crate::handshape::draw_cell_table;
use crate::image::RasterImage;
use crate::mesh::TriangleMesh;
use crate::raster::{FigureRaster, FigureStyle};
use crate::view::{ClipFraming, FigureView};

/// Draws faces as a table, `columns` in a row, each above its name and `size` pixels high and wide, on the
/// head of the signer in the first frame of `clip`.
///
/// # Errors
/// [`FigureError`] if there is no face or no frame, or the table would be too large.
pub fn face_sheet(
    clip: &Clip,
    anatomy: &BodyAnatomy,
    faces: &[(String, FacePosture)],
    columns: usize,
    size: usize,
) -> Result<RasterImage, FigureError> {
    if faces.is_empty() {
        return Err(FigureError::Nothing { what: "face" });
    }
    let framing = ClipFraming::framing_from_clip(clip, anatomy).ok_or(FigureError::Empty)?;
    let body = SignerBody::new(clip.clip_skeleton(), anatomy);
    let pose = clip.model_pose(0);
    let camera = framing.framing_camera(FigureView::Face, 1.0, &pose, anatomy);
    let (style, mut raster, mut mesh) = (FigureStyle::default(), FigureRaster::default(), TriangleMesh::default());
    draw_cell_table(faces, columns, size, style.theme, |face, cell| {
        body.shape_body_mesh(&pose, &mut mesh);
        body.apply_face_expression(&pose, face, &mut mesh);
        raster.draw_mesh_picture(&mesh, &camera, cell, &style)
    })
}
