//! Landmarks and placement zones over the signer's body; a click on a zone chooses its place.

use chereme_corpus::CorpusOverview;
use chereme_figure::camera::CameraProjection;
use chereme_motion::{BodyAnatomy, BodySide};
use chereme_sign::component::SignComponent;
use eframe::egui::{Align2, Painter, Rect, Role, Sense, Stroke, Ui, Vec2, WidgetInfo, vec2};
use glam::DVec3;

use super::stage_scene::StageSubject;
use crate::command::WindowCommand;
use crate::context::PaneInput;
use crate::model::InspectedThing;

/// A placement value, as a position on a body.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PlacementZone {
    pub(super) id: String,
    /// The row id of its inventory.
    inventory: i64,
    landmark: String,
    /// Offset from the landmark to the left, up and forward, in shoulder widths.
    offset: [f64; 3],
}

/// Returns the zones of the corpus's placement inventories for a right hand, by id.
pub(super) fn placement_zones(overview: &CorpusOverview) -> Vec<PlacementZone> {
    let mut zones: Vec<PlacementZone> = Vec::new();
    for stored in &overview.inventories {
        if stored.inventory.component != SignComponent::Placement {
            continue;
        }
        for value in &stored.inventory.values {
            let Some(landmark) = &value.landmark else {
                continue;
            };
            let (landmark, offset) = landmark.resolve_landmark(BodySide::Right);
            // Inventories may share values; one zone for each is enough.
            if zones.iter().all(|zone| zone.id != value.id) {
                let id = value.id.clone();
                zones.push(PlacementZone {
                    id,
                    inventory: stored.id,
                    landmark,
                    offset,
                });
            }
        }
    }
    zones
}

/// A visible mark on the body.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct BodyMark {
    pub(super) name: String,
    /// The placement value, if it has one.
    pub(super) zone: Option<String>,
    /// The row id of its inventory; meaningless without a zone.
    inventory: i64,
    pub(super) at: DVec3,
}

/// Returns the marks on a body in its posture: all zones, then landmarks that are not at a zone.
pub(super) fn body_marks(
    subject: &StageSubject,
    pose: &chereme_motion::ModelPose,
    zones: &[PlacementZone],
    name: impl Fn(&str) -> String,
) -> Vec<BodyMark> {
    let Some(frame) = subject.anatomy.body_frame(pose) else {
        return Vec::new();
    };
    let width = subject
        // Without measures, the usual distance of an adult's shoulder joints.
        .anatomy
        .anatomy_measures()
        .map_or(0.35, |measures| measures.shoulder_width);
    let find = |landmark: &str| {
        subject
            .anatomy
            .landmark_place_position(&subject.skeleton, pose, landmark)
    };
    let mut marks: Vec<BodyMark> = Vec::new();
    for zone in zones {
        let [left, up, forward] = zone.offset.map(|share| share * width);
        let offset = frame.left * left + frame.up * up + frame.forward * forward;
        if let Some(at) = find(&zone.landmark) {
            marks.push(BodyMark {
                name: name(&zone.id),
                zone: Some(zone.id.clone()),
                inventory: zone.inventory,
                at: at + offset,
            });
        }
    }
    for landmark in BodyAnatomy::landmark_names() {
        if let Some(at) = find(&landmark)
            // Landmarks within a centimetre of a zone would only double its mark.
            && marks.iter().all(|mark| mark.at.distance(at) > 0.012)
        {
            marks.push(BodyMark {
                name: landmark.replace('-', " "),
                zone: None,
                inventory: 0,
                at,
            });
        }
    }
    marks
}

/// The distance within which the pointer selects a mark, and the radius of marks, in points.
const BODY_MARK_REACH_POINTS: f32 = 11.0;

/// Writes the name of a mark at the bottom of the picture, where it covers no other mark.
fn paint_body_mark_name(painter: &Painter, ui: &Ui, rect: Rect, name: &str) {
    let name_position = rect.center_bottom() - vec2(0.0, 34.0);
    super::stage_ui::chip_on(painter, ui, name_position, Align2::CENTER_BOTTOM, name);
}

/// Shows the marks over a picture; the name of the one under the pointer or with the focus is at the bottom.
pub(super) fn show_body_marks(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    rect: Rect,
    projection: &CameraProjection,
    scale: f32,
    marks: &[BodyMark],
) {
    let colours = seen.pane_colours();
    let painter = ui.painter().with_clip_rect(rect);
    let pointer = ui.input(|input| input.pointer.hover_pos());
    let mut pointed = false;
    for (index, mark) in marks.iter().enumerate() {
        let projected = projection.project_point(mark.at.as_vec3());
        let place = rect.min + vec2(projected.x, projected.y) * scale;
        // Marks behind the camera would be mirrored into the picture.
        if projected.depth <= 0.0 || !rect.shrink(4.0).contains(place) {
            continue;
        }
        let Some(zone) = &mark.zone else {
            // Of several small marks only the first under the pointer says its name, or names would lie over each
            // other.
            let near = pointer.is_some_and(|at| at.distance(place) < BODY_MARK_REACH_POINTS / 2.0) && !pointed;
            let radius = if near { 3.0 } else { 1.6 };
            painter.circle_filled(place, radius, colours.accent.gamma_multiply(0.7));
            if near {
                pointed = true;
                paint_body_mark_name(&painter, ui, rect, &mark.name);
            }
            continue;
        };
        let spot = Rect::from_center_size(place, Vec2::splat(BODY_MARK_REACH_POINTS));
        let id = ui
            .scope_id()
            .with(("mark", rect.min.x as i64, rect.min.y as i64, index));
        let response = ui.interact(spot, id, Sense::click());
        let chosen = seen.shown.spot.as_ref() == Some(zone);
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, &mark.name));
        let lit = response.hovered() || response.has_focus();
        let radius = if lit || chosen { 5.5 } else { 3.5 };
        let fill = if chosen {
            colours.playhead
        } else {
            colours.accent.gamma_multiply(if lit { 0.9 } else { 0.35 })
        };
        painter.circle(place, radius, fill, Stroke::new(1.2, colours.accent));
        if lit || chosen {
            paint_body_mark_name(&painter, ui, rect, &mark.name);
        }
        if response.clicked() {
            seen.send_command(WindowCommand::Spot(Some(zone.clone())));
            seen.send_command(WindowCommand::Inspect(InspectedThing::Value(
                mark.inventory,
                zone.clone(),
            )));
        }
    }
}
