//! Movement to a body to look at: its geometry, and pictures drawn without a window.
pub mod animation;
pub mod body;
pub mod camera;
pub mod error;
mod font;
pub mod image;
pub mod mesh;
pub mod palette;
mod quantize;
pub mod raster;
pub mod sheet;
pub mod view;
pub mod writer;
pub use body::Body;
pub use error::FigureError;
pub use image::Image;
pub use view::{Framing, View};
