//! Pictures as files: PNG, byte for byte the same for the same picture.

use std::io::Write;

use crate::error::FigureError;
use crate::image::RasterImage;
use crate::quantize::ColourQuantizer;

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

/// Writes a picture as PNG with at most 256 colours, those nearest to its own, in about a quarter of the bytes.
///
/// # Errors
/// [`FigureError::Png`] if `out` cannot be written.
pub fn write_palette_png(image: &RasterImage, out: impl Write) -> Result<(), FigureError> {
    let mut quantizer = ColourQuantizer::default();
    quantizer.count_picture_colours(image.image_pixels());
    quantizer.choose_palette_colours(256);
    let mut encoder = png::Encoder::new(out, image.image_width() as u32, image.image_height() as u32);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(quantizer.palette_bytes());
    // Neighbouring indices are no similar numbers, so that differences between them only cost bytes.
    encoder.set_filter(png::Filter::NoFilter);
    encoder.set_compression(png::Compression::High);
    let mut writer = encoder.write_header()?;
    let indices: Vec<u8> = image
        .image_pixels()
        .iter()
        .map(|colour| quantizer.index(*colour))
        .collect();
    writer.write_image_data(&indices)?;
    writer.finish()?;
    Ok(())
}
