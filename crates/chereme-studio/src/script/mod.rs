//! Text in the scripts of the world: fonts of the computer for letters that ours lack, and right-to-left text.
//!
//! | module | holds |
//! |---|---|
//! | `fonts` | fonts for letters that ours lack, a placeholder for letters without a font, and a notice about them |
//! | `visual` | visual order of lines with right-to-left text |
//! | `edit` | the same while the text is edited: the place of the cursor |

pub(crate) mod script_edit;
pub(crate) mod script_fonts;
mod visual;

use std::sync::Arc;

use chereme_figure::letters::any_from_right;
use eframe::egui::layers::ShapeIdx;
use eframe::egui::{Context, Galley, LayerId, Plugin, Shape, Ui};

/// Gives a context fonts for all scripts, and makes it draw text in visual order.
pub(crate) fn install_script_support(ctx: &Context) {
    script_fonts::install_system_fonts(ctx);
    ctx.add_plugin(InOrder);
}

/// Plugin that puts right-to-left text in visual order after all of a frame was painted, so that it applies to labels,
/// buttons and text painted by hand alike.
struct InOrder;

impl Plugin for InOrder {
    fn debug_name(&self) -> &'static str {
        "text read from the right"
    }

    fn on_end_pass(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx();
        let mut layers: Vec<LayerId> = ctx.memory(|memory| memory.layer_ids().collect());
        layers.extend([LayerId::background(), LayerId::debug()]);
        layers.sort_by_key(|layer| (layer.order, layer.id.value()));
        layers.dedup();
        for layer in layers {
            let layer_galleys: Vec<(usize, Vec<Arc<Galley>>)> = ctx.graphics(|graphics| {
                let Some(list) = graphics.get(layer) else {
                    return Vec::new();
                };
                let texts = list.all_entries().enumerate().map(|(at, entry)| {
                    let mut texts = Vec::new();
                    gather_shape_texts(&entry.shape, &mut texts);
                    (at, texts)
                });
                texts.filter(|(_, texts)| !texts.is_empty()).collect()
            });
            for (at, texts) in layer_galleys {
                let turned: Vec<Arc<Galley>> = texts
                    .iter()
                    .map(|text| visual::text_in_visual_order(ctx, text))
                    .collect();
                ctx.graphics_mut(|graphics| {
                    let list = graphics.entry(layer);
                    list.mutate_shape(ShapeIdx(at), |entry| {
                        put_turned_texts(&mut entry.shape, &mut turned.into_iter());
                    });
                });
            }
        }
    }
}

/// Returns whether a text must be put in visual order.
fn is_turned(galley: &Galley) -> bool {
    any_from_right(&galley.job.text) && !script_edit::is_in_order(galley)
}

fn gather_shape_texts(shape: &Shape, texts: &mut Vec<Arc<Galley>>) {
    match shape {
        Shape::Text(text) if is_turned(&text.galley) => texts.push(text.galley.clone()),
        Shape::Vec(shapes) => shapes.iter().for_each(|shape| gather_shape_texts(shape, texts)),
        _ => {}
    }
}

fn put_turned_texts(shape: &mut Shape, turned: &mut std::vec::IntoIter<Arc<Galley>>) {
    match shape {
        Shape::Text(text) if is_turned(&text.galley) => {
            if let Some(galley) = turned.next() {
                text.galley = galley;
            }
        }
        Shape::Vec(shapes) => shapes.iter_mut().for_each(|shape| put_turned_texts(shape, turned)),
        _ => {}
    }
}
