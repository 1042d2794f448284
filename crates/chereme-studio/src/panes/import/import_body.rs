//! A small body that shows which of its parts were found in a file.

use std::collections::BTreeMap;

use eframe::egui::{Color32, CursorIcon, Pos2, Role, Sense, Stroke, Ui, Vec2, WidgetInfo, vec2};

use super::import_people;
use crate::context::PaneInput;
use crate::words::{fill_text_braces, import_words as words};

/// Vertical positions of parts on the middle line of a body with height 1, from the top of the head. The signer's left
/// is to the right, as seen from the front.
const MIDLINE_PART_POSITIONS: [(&str, f32); 6] = [
    ("head", 0.08),
    ("jaw", 0.13),
    ("neck", 0.19),
    ("chest", 0.28),
    ("spine", 0.40),
    ("hips", 0.50),
];
const SIDE_PART_POSITIONS: [(&str, [f32; 2]); 9] = [
    ("eye", [0.025, 0.07]),
    ("clavicle", [0.06, 0.23]),
    ("upper arm", [0.13, 0.24]),
    ("forearm", [0.18, 0.38]),
    ("hand", [0.24, 0.50]),
    ("thigh", [0.07, 0.54]),
    ("shin", [0.08, 0.74]),
    ("foot", [0.08, 0.93]),
    ("toes", [0.10, 0.97]),
];
const BODY_MAP_FINGERS: [&str; 5] = ["thumb", "index", "middle", "ring", "little"];

/// A part on the map.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct MapPart {
    pub(super) part: String,
    /// Position in shares of the height, from the middle line and the top of the head.
    pub(super) at: Vec2,
    /// Whether a joint of the file is this part.
    pub(super) found: bool,
    pub(super) large: bool,
}

/// Returns the parts of a body, each found or not; the joints of a finger are one mark.
pub(super) fn body_map_marks(found: &BTreeMap<String, String>) -> Vec<MapPart> {
    let there = |part: &str| {
        found
            .keys()
            .any(|found_part| found_part == part || found_part.starts_with(&format!("{part} ")))
    };
    let mark = |part: String, at: Vec2, large: bool| MapPart {
        found: there(&part),
        part,
        at,
        large,
    };
    let mut all: Vec<MapPart> = MIDLINE_PART_POSITIONS
        .iter()
        .map(|(part, y)| mark((*part).to_owned(), vec2(0.0, *y), true))
        .collect();
    for (side, sign) in [("right", -1.0), ("left", 1.0)] {
        for (part, [x, y]) in &SIDE_PART_POSITIONS {
            let large = *part != "eye";
            all.push(mark(format!("{side} {part}"), vec2(sign * x, *y), large));
        }
        for (n, finger) in BODY_MAP_FINGERS.iter().enumerate() {
            let x = 0.20 + 0.025 * n as f32;
            let y = if n == 0 { 0.54 } else { 0.575 };
            all.push(mark(format!("{side} {finger}"), vec2(sign * x, y), false));
        }
    }
    all
}

/// Shows the map. If `points`, returns the part that was clicked, so that its joint can be named.
pub(super) fn show_body_map(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    found: &BTreeMap<String, String>,
    points: bool,
) -> Option<String> {
    let marks = body_map_marks(found);
    let height = 170.0;
    let (rect, response) = ui.allocate_exact_size(vec2(height * 0.72, height), Sense::click());
    let there = marks.iter().filter(|mark| mark.found).count();
    let values: [(&str, &dyn std::fmt::Display); 2] = [("n", &there), ("all", &marks.len())];
    let label = fill_text_braces(seen.say_text(words::BODY_MAP), &values);
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &label));
    let (painter, colours) = (ui.painter(), seen.pane_colours());
    let place = |at: Vec2| Pos2::new(rect.center().x + at.x * height, rect.top() + at.y * height);
    let bone = Stroke::new(2.0, colours.rule);
    let of = |part: &str| marks.iter().find(|mark| mark.part == part).map(|mark| place(mark.at));
    let line = |a: &str, b: &str| {
        if let (Some(a), Some(b)) = (of(a), of(b)) {
            painter.line_segment([a, b], bone);
        }
    };
    for (a, b) in [
        ("head", "neck"),
        ("neck", "chest"),
        ("chest", "spine"),
        ("spine", "hips"),
    ] {
        line(a, b);
    }
    for side in ["right", "left"] {
        let sided = |part: &str| format!("{side} {part}");
        line("neck", &sided("clavicle"));
        line("hips", &sided("thigh"));
        for (a, b) in [
            ("clavicle", "upper arm"),
            ("upper arm", "forearm"),
            ("forearm", "hand"),
            ("thigh", "shin"),
            ("shin", "foot"),
        ] {
            line(&sided(a), &sided(b));
        }
        for finger in BODY_MAP_FINGERS {
            line(&sided("hand"), &sided(finger));
        }
    }
    for mark in &marks {
        let radius = if mark.large { 4.5 } else { 3.0 };
        let centre = place(mark.at);
        if mark.found {
            painter.circle_filled(centre, radius, colours.good);
        } else {
            let hollow: Color32 = ui.visuals().panel_fill;
            painter.circle(centre, radius, hollow, Stroke::new(1.5, colours.trouble));
        }
    }
    let near = ui
        .input(|input| input.pointer.hover_pos())
        .filter(|at| rect.contains(*at));
    let mark = near.and_then(|at| nearest_body_mark(&marks, |mark| place(mark.at).distance(at)))?;
    let joint = found
        .iter()
        // A finger is one mark for all its joints.
        .find(|(part, _)| **part == mark.part || part.starts_with(&format!("{} ", mark.part)));
    let named = import_people::body_part_name(&mark.part, seen.language);
    let text = match joint {
        Some((_, joint)) => format!("{named} = {joint}"),
        None => fill_text_braces(seen.say_text(words::PART_MISSING), &[("part", &named)]),
    };
    // After the import the map only shows what was found.
    if !points {
        response.on_hover_text_at_pointer(text);
        return None;
    }
    let ring = Stroke::new(2.0, seen.pane_colours().accent);
    ui.painter().circle_stroke(place(mark.at), 7.0, ring);
    let clicked = response.clicked();
    let response = response.on_hover_cursor(CursorIcon::PointingHand);
    response.on_hover_text_at_pointer(format!("{text}\n{}", seen.say_text(words::POINT)));
    clicked.then(|| mark.part.clone())
}

fn nearest_body_mark(marks: &[MapPart], far: impl Fn(&MapPart) -> f32) -> Option<&MapPart> {
    let all = marks.iter().map(|mark| (far(mark), mark));
    all.filter(|(far, _)| *far < 12.0)
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, mark)| mark)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_found_by_their_names_and_fingers_by_any_of_their_joints() {
        let found: BTreeMap<String, String> = [("head", "Head"), ("right index base", "RI1")]
            .map(|(part, joint)| (part.to_owned(), joint.to_owned()))
            .into();
        let marks = body_map_marks(&found);
        let is = |part: &str| marks.iter().find(|it| it.part == part).map(|it| it.found);
        assert_eq!(is("head"), Some(true));
        assert_eq!(is("right index"), Some(true));
        assert_eq!((is("left index"), is("hips")), (Some(false), Some(false)));
        let right = marks.iter().find(|it| it.part == "right hand").expect("one");
        assert!(right.at.x < 0.0, "seen from the front");
    }
}
