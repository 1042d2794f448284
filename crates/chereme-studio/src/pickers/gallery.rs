//! Pictures that are drawn once, on a separate thread, and kept.

use std::collections::BTreeMap;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};

use eframe::egui::{ColorImage, Context, Id, TextureHandle, TextureId, TextureOptions};

/// Draws a picture; returns `None` if it cannot be drawn.
type PictureDrawing = Box<dyn FnOnce() -> Option<ColorImage> + Send>;

struct PictureRequest {
    key: u64,
    draw: PictureDrawing,
    /// The context to repaint when the picture is drawn.
    ctx: Context,
}

/// The pictures of a window.
struct PictureGallery {
    wishes: Sender<PictureRequest>,
    drawn: Receiver<(u64, Option<ColorImage>)>,
    /// The requested pictures; `None` until drawn.
    textures: BTreeMap<u64, Option<TextureHandle>>,
}

impl PictureGallery {
    fn new() -> Self {
        let (wishes, orders) = channel::<PictureRequest>();
        let (sender, drawn) = channel();
        // The thread ends with the window, which holds the sender.
        std::thread::spawn(move || {
            while let Ok(PictureRequest { key, draw, ctx }) = orders.recv() {
                if sender.send((key, draw())).is_err() {
                    return;
                }
                ctx.request_repaint();
            }
        });
        Self {
            wishes,
            drawn,
            textures: BTreeMap::new(),
        }
    }

    fn take_drawn(&mut self, ctx: &Context) {
        while let Ok((key, image)) = self.drawn.try_recv() {
            let texture = image.map(|image| ctx.load_texture(format!("{key:x}"), image, TextureOptions::LINEAR));
            self.textures.insert(key, texture);
        }
    }
}

/// Returns the picture of that key once it is drawn; the first call starts the drawing.
pub(super) fn find_gallery_picture(
    ctx: &Context,
    key: u64,
    draw: impl FnOnce() -> Option<ColorImage> + Send + 'static,
) -> Option<TextureId> {
    let shared_gallery = ctx.data_mut(|data| {
        data.get_temp_mut_or_insert_with(Id::unique("gallery of values"), || {
            Arc::new(Mutex::new(PictureGallery::new()))
        })
        .clone()
    });
    let mut gallery = shared_gallery.lock().unwrap_or_else(PoisonError::into_inner);
    gallery.take_drawn(ctx);
    if let Some(texture) = gallery.textures.get(&key) {
        return texture.as_ref().map(TextureHandle::id);
    }
    gallery.textures.insert(key, None);
    let wish = PictureRequest {
        key,
        draw: Box::new(draw),
        ctx: ctx.clone(),
    };
    // If the thread has panicked, no further pictures are drawn, and names are shown instead.
    let _ = gallery.wishes.send(wish);
    None
}
