//! The preview hand, which takes the handshape under the pointer and turns smoothly from one to the next.

use std::sync::{Arc, Mutex, PoisonError};

use chereme_figure::raster::FigureStyle;
use chereme_figure::{HandshapeOptions, handshape_picture};
use chereme_motion::HandAngles;
use eframe::egui::{Color32, Id, Pos2, Rect, TextureHandle, TextureOptions, Ui, pos2};

use super::pickers_paint;

/// The share of the difference to a handshape that is left after a second.
const ANGLE_LEFT_PER_SECOND: f64 = 1e-9;
/// Largest angle difference to the handshape at which the hand stops moving, in radians.
const HAND_STOP_ANGLE_RADIANS: f64 = 0.02;
/// The largest side of the picture, in pixels.
const MAX_PREVIEW_HAND_PIXELS: f32 = 220.0;

/// The present state of the preview hand.
#[derive(Default)]
struct PreviewHandState {
    angles: Option<[f64; HandAngles::HAND_ANGLE_COUNT]>,
    drawn: Option<(bool, usize)>,
    texture: Option<TextureHandle>,
}

/// Shows the hand on its way to the posture `target`.
pub(super) fn show_preview_hand(ui: &Ui, rect: Rect, dark: bool, target: &HandAngles) {
    let shared = ui.ctx().data_mut(|data| {
        data.get_temp_mut_or_insert_with(Id::unique("worn hand"), Arc::<Mutex<PreviewHandState>>::default)
            .clone()
    });
    let mut worn = shared.lock().unwrap_or_else(PoisonError::into_inner);
    let target = target.to_array();
    // After a pause the hand continues its movement instead of jumping.
    let step = f64::from(ui.input(|input| input.stable_dt)).min(0.1);
    let (angles, moved) = turn_hand_angles(worn.angles, target, step);
    let pixels = rect.size().min_elem() * ui.ctx().pixels_per_point();
    let wanted = (dark, pixels.clamp(48.0, MAX_PREVIEW_HAND_PIXELS) as usize);
    if moved || worn.drawn != Some(wanted) || worn.texture.is_none() {
        let usual = HandshapeOptions::with_small_size(wanted.1);
        let options = HandshapeOptions {
            style: FigureStyle {
                theme: pickers_paint::picture_theme(dark),
                samples: 3,
                ..usual.style
            },
            ..usual
        };
        if let Ok(image) = handshape_picture(&HandAngles::from_array(angles), &options) {
            let image = pickers_paint::colour_image(&image);
            match &mut worn.texture {
                Some(texture) => texture.set(image, TextureOptions::LINEAR),
                none => {
                    let texture = ui.ctx().load_texture("worn", image, TextureOptions::LINEAR);
                    *none = Some(texture);
                }
            }
        }
        worn.drawn = Some(wanted);
    }
    worn.angles = Some(angles);
    if moved {
        ui.ctx().request_repaint();
    }
    if let Some(texture) = &worn.texture {
        let full_uv = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
        ui.painter().image(texture.id(), rect, full_uv, Color32::WHITE);
    }
}

/// Returns the angles `step` seconds later, and whether they differ from those before.
fn turn_hand_angles(
    now: Option<[f64; HandAngles::HAND_ANGLE_COUNT]>,
    target: [f64; HandAngles::HAND_ANGLE_COUNT],
    step: f64,
) -> ([f64; HandAngles::HAND_ANGLE_COUNT], bool) {
    let Some(mut angles) = now else {
        return (target, true);
    };
    if angles == target {
        return (angles, false);
    }
    let share = 1.0 - ANGLE_LEFT_PER_SECOND.powf(step);
    let mut near = true;
    for (angle, target) in angles.iter_mut().zip(target) {
        *angle += (target - *angle) * share;
        near &= (target - *angle).abs() < HAND_STOP_ANGLE_RADIANS;
    }
    (if near { target } else { angles }, true)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hand_reaches_its_shape_in_a_fifth_of_a_second_and_stays() {
        let fist = [1.5; HandAngles::HAND_ANGLE_COUNT];
        let mut now = Some([0.0; HandAngles::HAND_ANGLE_COUNT]);
        let mut frames = 0;
        loop {
            let (angles, moved) = turn_hand_angles(now, fist, 1.0 / 60.0);
            now = Some(angles);
            if !moved {
                break;
            }
            frames += 1;
            assert!(frames <= 14, "it never comes");
        }
        assert_eq!(now, Some(fist));
        assert!(frames > 3, "it turns, and does not jump");
        assert_eq!(turn_hand_angles(None, fist, 0.0), (fist, true));
    }
}
