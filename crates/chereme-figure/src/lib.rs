//! Turns movement into a visible body: its geometry, and pictures drawn without a window.
//!
//! A [`SignerBody`] is built once for a skeleton and its anatomy, and then moved to any posture: a
//! [`TriangleMesh`](mesh::TriangleMesh) of some fifteen thousand triangles, for the window's stage and for the
//! [`FigureRaster`](raster::FigureRaster) here, which needs no GPU. Contact sheets, animations, thumbnails, pictures
//! of handshapes and the chart of an alignment build on it. The same input gives the same bytes. The crate
//! opens no window and no database, and knows nothing of the meaning of signs.
//!
//! ```
//! use std::ops::ControlFlow;
//! use chereme_figure::sheet::{SheetOptions, contact_sheet};
//! use chereme_figure::writer::write_png;
//! use chereme_motion::{BodyAnatomy, Clip, SkeletonJoint, FrameRate, Skeleton, glam::DVec3};
//!
//! let skeleton = Skeleton::new(vec![
//!     SkeletonJoint::new("root", None, DVec3::ZERO),
//!     SkeletonJoint::new("stick", Some(0), DVec3::Y).with_tip(DVec3::X),
//! ])?;
//! let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
//! let clip = Clip::from_rest_pose(skeleton.into(), FrameRate::new(25, 1)?, 50);
//! let options = SheetOptions { title: "a stick".into(), ..SheetOptions::default() };
//! let mut progress = |_done, _total| ControlFlow::Continue(());
//! let sheet = contact_sheet(&clip, &anatomy, &options, &mut progress)?;
//! let mut file = Vec::new();
//! write_png(&sheet, &mut file)?;
//! assert_eq!(&file[1..4], b"PNG");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | module | holds |
//! |---|---|
//! | [`body`] | the signer's surface from a skeleton's joints |
//! | [`mesh`] | triangles with colours and parts; trails |
//! | [`palette`] | colours of body and paper |
//! | [`camera`], [`view`] | the position of the eye; presets fitted to a clip |
//! | [`raster`] | triangles to pixels, with lines between parts |
//! | `buffers`, `fill`, `ink` | the steps of that: nearest surfaces, colours, lines and shade |
//! | [`image`], [`writer`] | pixels, and PNG |
//! | [`sheet`] | contact sheets, thumbnails |
//! | [`points`] | markers, and points from film, as dots and limbs |
//! | [`animation`] | moving pictures, and GIF |
//! | `points_film`, `quantize` | animations of points; the few colours of a GIF |
//! | [`strip`] | several of them next to each other, with captions |
//! | [`handshape`] | a hand alone, from joint angles |
//! | [`faces`] | a table of facial expressions |
//! | [`chart`] | a chart of the alignment of two clips |
//! | [`letters`], `font` | text in any script, and the fonts of the computer; small dotted letters |
//! | [`error`] | the reasons why a picture cannot be drawn |

pub mod animation;
pub mod body;
mod buffers;
pub mod camera;
pub mod chart;
pub mod error;
pub mod faces;
mod fill;
mod font;
pub mod handshape;
pub mod image;
mod ink;
pub mod letters;
pub mod mesh;
pub mod palette;
pub mod points;
mod points_film;
mod quantize;
pub mod raster;
pub mod sheet;
pub mod strip;
pub mod view;
pub mod writer;

pub use animation::{AnimationOptions, ClipAnimation, PictureSequence, write_gif};
pub use body::SignerBody;
pub use body::portable::{BoneMotion, FaceMorph, PortableBody, PortableBone, PortableVertex};
pub use body::skinned_figure::{BonePlacement, FigureBone, SkinnedFigure};
pub use chart::{ChartOptions, alignment_picture};
pub use error::{ANIMATION_SPEEDS, FigureError, MAX_FRAMES};
pub use faces::face_sheet;
pub use handshape::{HandView, HandshapeOptions, handshape_picture, handshape_sheet};
pub use image::RasterImage;
pub use palette::{FigurePalette, PaperTheme, RgbColour};
pub use points::{PointCloud, points_sheet};
pub use points_film::{PointsAnimation, PointsOptions};
pub use sheet::{PictureProgress, SheetFrames, SheetOptions, clip_thumbnail, contact_sheet};
pub use strip::{AnimationCaption, AnimationStrip};
pub use view::{ClipFraming, FigureView, SigningReach, active_signing_frames, has_hand_up, stroke_frame};
pub use writer::{write_palette_png, write_png};
