//! Pictures as files: PNG, byte for byte the same for the same picture.

use std::io::Write;

use crate::error::FigureError;
use crate::image::RasterImage;

/// Writes a picture as PNG, eight bits each of red, green and blue.
///
/// # Errors
/// [`FigureError::Png`] if `out` cannot be written.
pub fn write_png(image: &RasterImage, out: impl Write) -> Result<(), FigureError> {
    let mut encoder = png::Encoder::new(out, image.image_width() as u32, image.image_height() as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&image.to_rgb())?;
    writer.finish()?;
    Ok(())
}
