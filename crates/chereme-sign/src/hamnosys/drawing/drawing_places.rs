//! Draws places of the body and the arm, and their marks.

use super::super::symbol::SymbolKind;
use super::super::tree::BodyLocation as B;
use super::{DrawingPoint, SymbolDrawing, arc_points, oval};

/// The middle of the face, and half its width and height.
const FACE_OVAL: (DrawingPoint, [f32; 2]) = ([0.4, 0.46], [0.3, 0.42]);

fn draw_face_outline() -> SymbolDrawing {
    SymbolDrawing::new(0.8).thin(oval(FACE_OVAL.0, FACE_OVAL.1))
}

fn draw_trunk_outline() -> SymbolDrawing {
    SymbolDrawing::new(0.8).thin([
        [0.34, 0.0],
        [0.34, 0.14],
        [0.08, 0.22],
        [0.14, 0.98],
        [0.66, 0.98],
        [0.72, 0.22],
        [0.46, 0.14],
        [0.46, 0.0],
    ])
}

const SHOULDER_POINT: DrawingPoint = [0.14, 0.08];
const ELBOW_POINT: DrawingPoint = [0.3, 0.86];
const WRIST_POINT: DrawingPoint = [0.72, 0.3];

fn draw_arm_outline() -> SymbolDrawing {
    SymbolDrawing::new(0.8).thin([SHOULDER_POINT, ELBOW_POINT, WRIST_POINT])
}

/// Draws a place, or a mark of one.
pub(super) fn draw_place_symbol(kind: SymbolKind) -> SymbolDrawing {
    match kind {
        SymbolKind::Body(place) => draw_body_location(place),
        SymbolKind::Beside => SymbolDrawing::new(0.6)
            .thin([[0.3, 0.1], [0.3, 0.9]])
            .with_dot([0.08, 0.5])
            .with_dot([0.52, 0.5]),
        SymbolKind::At => SymbolDrawing::new(0.6)
            .thin([[0.3, 0.1], [0.3, 0.9]])
            .with_dot([0.2, 0.5])
            .with_dot([0.4, 0.5]),
        SymbolKind::Behind => SymbolDrawing::new(0.6).thin([[0.4, 0.1], [0.4, 0.9]]).with_arrow([
            [0.56, 0.3],
            [0.5, 0.06],
            [0.26, 0.06],
            [0.14, 0.3],
            [0.14, 0.62],
        ]),
        SymbolKind::Define => SymbolDrawing::new(0.5).with_line([[0.12, 1.0], [0.12, 0.06]]).solid([
            [0.12, 0.06],
            [0.46, 0.2],
            [0.12, 0.36],
        ]),
        SymbolKind::Refer => SymbolDrawing::new(0.7)
            .thin([[0.36, 1.0], [0.36, 0.06]])
            .thin([[0.36, 0.06], [0.68, 0.2], [0.36, 0.36]])
            .with_arrow([[0.02, 0.66], [0.28, 0.66]]),
        _ => SymbolDrawing::default(),
    }
}

fn draw_body_location(place: B) -> SymbolDrawing {
    let both = |drawing: SymbolDrawing, left: Vec<DrawingPoint>| {
        let right: Vec<DrawingPoint> = left.iter().map(|[x, y]| [0.8 - x, *y]).collect();
        drawing.with_line(left).with_line(right)
    };
    let level = |y: f32| draw_trunk_outline().with_line([[0.1, y], [0.7, y]]);
    match place {
        B::Head => SymbolDrawing::new(0.8).with_line(oval(FACE_OVAL.0, FACE_OVAL.1)),
        B::HeadTop => draw_face_outline().with_line(arc_points(FACE_OVAL.0, FACE_OVAL.1, 0.58, 0.92)),
        B::Forehead => draw_face_outline().with_line([[0.2, 0.24], [0.6, 0.24]]),
        B::Eyebrows => both(draw_face_outline(), arc_points([0.27, 0.34], [0.09, 0.08], 0.55, 0.95)),
        B::Eyes => draw_face_outline().with_dot([0.27, 0.4]).with_dot([0.53, 0.4]),
        B::UpperEyelid => both(draw_face_outline(), arc_points([0.27, 0.42], [0.09, 0.07], 0.5, 1.0)),
        B::LowerEyelid => both(draw_face_outline(), arc_points([0.27, 0.38], [0.09, 0.07], 0.0, 0.5)),
        B::Nose => draw_face_outline().with_line([[0.42, 0.3], [0.34, 0.56], [0.46, 0.56]]),
        B::Nostrils => draw_face_outline()
            .thin([[0.42, 0.3], [0.34, 0.56], [0.46, 0.56]])
            .solid(oval([0.35, 0.62], [0.04, 0.04]))
            .solid(oval([0.45, 0.62], [0.04, 0.04])),
        B::Ear => both(draw_face_outline(), arc_points([0.12, 0.46], [0.1, 0.13], 0.2, 0.8)),
        B::EarLobe => draw_face_outline()
            .thin(arc_points([0.12, 0.46], [0.1, 0.13], 0.2, 0.8))
            .thin(arc_points([0.68, 0.46], [0.1, 0.13], -0.3, 0.3))
            .with_dot([0.1, 0.6])
            .with_dot([0.7, 0.6]),
        B::Cheek => draw_face_outline()
            .with_line(oval([0.22, 0.56], [0.08, 0.08]))
            .with_line(oval([0.58, 0.56], [0.08, 0.08])),
        B::Lips | B::UpperLip | B::LowerLip => {
            let upper = arc_points([0.4, 0.72], [0.15, 0.09], 0.5, 1.0);
            let lower = arc_points([0.4, 0.66], [0.15, 0.09], 0.0, 0.5);
            match place {
                B::UpperLip => draw_face_outline().with_line(upper).thin(lower),
                B::LowerLip => draw_face_outline().thin(upper).with_line(lower),
                _ => draw_face_outline().with_line(upper).with_line(lower),
            }
        }
        B::Tongue => draw_face_outline().thin([[0.24, 0.64], [0.56, 0.64]]).solid(arc_points(
            [0.4, 0.66],
            [0.08, 0.16],
            0.0,
            0.5,
        )),
        B::Teeth | B::UpperTeeth | B::LowerTeeth => {
            let mouth = draw_face_outline().thin(oval([0.4, 0.68], [0.2, 0.13]));
            let row = |y: f32, drawing: SymbolDrawing| {
                [0.3, 0.4, 0.5]
                    .into_iter()
                    .fold(drawing, |drawing, x| drawing.with_line([[x, y - 0.05], [x, y + 0.05]]))
            };
            match place {
                B::UpperTeeth => row(0.64, mouth),
                B::LowerTeeth => row(0.74, mouth),
                _ => row(0.68, mouth).with_line([[0.22, 0.68], [0.58, 0.68]]),
            }
        }
        B::Chin => draw_face_outline().with_line(arc_points(FACE_OVAL.0, FACE_OVAL.1, 0.15, 0.35)),
        B::UnderChin => draw_face_outline().with_line([[0.22, 0.96], [0.58, 0.96]]),
        B::Neck => both(
            SymbolDrawing::new(0.8)
                .thin(arc_points([0.4, 0.1], [0.3, 0.42], 0.0, 0.5))
                .thin([[0.02, 0.98], [0.3, 0.86]])
                .thin([[0.78, 0.98], [0.5, 0.86]]),
            vec![[0.3, 0.46], [0.3, 0.86]],
        ),
        B::ShoulderTop => both(draw_trunk_outline(), vec![[0.3, 0.16], [0.08, 0.24]]),
        B::Shoulders => level(0.26),
        B::Chest => level(0.46),
        B::Stomach => level(0.66),
        B::BelowStomach => level(0.88),
        B::NeutralSpace => SymbolDrawing::new(0.8)
            .thin([[0.08, 0.06], [0.08, 0.94]])
            .with_line(oval([0.52, 0.5], [0.24, 0.3])),
        B::UpperArm => draw_arm_outline().with_line([SHOULDER_POINT, ELBOW_POINT]),
        B::LowerArm => draw_arm_outline().with_line([ELBOW_POINT, WRIST_POINT]),
        B::Elbow => draw_arm_outline().with_dot([0.24, 0.92]),
        B::ElbowInside => draw_arm_outline().with_dot([0.36, 0.68]),
    }
}
