//! Draws places of the body and the arm, and their marks.

use super::super::symbol::Kind;
use super::super::tree::BodyLocation as B;
use super::{Drawing, Point, arc, oval};

/// The middle of the face, and half its width and height.
const FACE: (Point, [f32; 2]) = ([0.4, 0.46], [0.3, 0.42]);

fn face() -> Drawing {
    Drawing::new(0.8).thin(oval(FACE.0, FACE.1))
}

fn trunk() -> Drawing {
    Drawing::new(0.8).thin([
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

const SHOULDER: Point = [0.14, 0.08];
const ELBOW: Point = [0.3, 0.86];
const WRIST: Point = [0.72, 0.3];

fn arm() -> Drawing {
    Drawing::new(0.8).thin([SHOULDER, ELBOW, WRIST])
}

/// Draws a place, or a mark of one.
pub(super) fn place(kind: Kind) -> Drawing {
    match kind {
        Kind::Body(place) => body(place),
        Kind::Beside => Drawing::new(0.6)
            .thin([[0.3, 0.1], [0.3, 0.9]])
            .dot([0.08, 0.5])
            .dot([0.52, 0.5]),
        Kind::At => Drawing::new(0.6)
            .thin([[0.3, 0.1], [0.3, 0.9]])
            .dot([0.2, 0.5])
            .dot([0.4, 0.5]),
        Kind::Behind => Drawing::new(0.6).thin([[0.4, 0.1], [0.4, 0.9]]).arrow([
            [0.56, 0.3],
            [0.5, 0.06],
            [0.26, 0.06],
            [0.14, 0.3],
            [0.14, 0.62],
        ]),
        Kind::Define => Drawing::new(0.5).line([[0.12, 1.0], [0.12, 0.06]]).solid([
            [0.12, 0.06],
            [0.46, 0.2],
            [0.12, 0.36],
        ]),
        Kind::Refer => Drawing::new(0.7)
            .thin([[0.36, 1.0], [0.36, 0.06]])
            .thin([[0.36, 0.06], [0.68, 0.2], [0.36, 0.36]])
            .arrow([[0.02, 0.66], [0.28, 0.66]]),
        _ => Drawing::default(),
    }
}

fn body(place: B) -> Drawing {
    let both = |drawing: Drawing, left: Vec<Point>| {
        let right: Vec<Point> = left.iter().map(|[x, y]| [0.8 - x, *y]).collect();
        drawing.line(left).line(right)
    };
    let level = |y: f32| trunk().line([[0.1, y], [0.7, y]]);
    match place {
        B::Head => Drawing::new(0.8).line(oval(FACE.0, FACE.1)),
        B::HeadTop => face().line(arc(FACE.0, FACE.1, 0.58, 0.92)),
        B::Forehead => face().line([[0.2, 0.24], [0.6, 0.24]]),
        B::Eyebrows => both(face(), arc([0.27, 0.34], [0.09, 0.08], 0.55, 0.95)),
        B::Eyes => face().dot([0.27, 0.4]).dot([0.53, 0.4]),
        B::UpperEyelid => both(face(), arc([0.27, 0.42], [0.09, 0.07], 0.5, 1.0)),
        B::LowerEyelid => both(face(), arc([0.27, 0.38], [0.09, 0.07], 0.0, 0.5)),
        B::Nose => face().line([[0.42, 0.3], [0.34, 0.56], [0.46, 0.56]]),
        B::Nostrils => face()
            .thin([[0.42, 0.3], [0.34, 0.56], [0.46, 0.56]])
            .solid(oval([0.35, 0.62], [0.04, 0.04]))
            .solid(oval([0.45, 0.62], [0.04, 0.04])),
        B::Ear => both(face(), arc([0.12, 0.46], [0.1, 0.13], 0.2, 0.8)),
        B::EarLobe => face()
            .thin(arc([0.12, 0.46], [0.1, 0.13], 0.2, 0.8))
            .thin(arc([0.68, 0.46], [0.1, 0.13], -0.3, 0.3))
            .dot([0.1, 0.6])
            .dot([0.7, 0.6]),
        B::Cheek => face()
            .line(oval([0.22, 0.56], [0.08, 0.08]))
            .line(oval([0.58, 0.56], [0.08, 0.08])),
        B::Lips | B::UpperLip | B::LowerLip => {
            let upper = arc([0.4, 0.72], [0.15, 0.09], 0.5, 1.0);
            let lower = arc([0.4, 0.66], [0.15, 0.09], 0.0, 0.5);
            match place {
                B::UpperLip => face().line(upper).thin(lower),
                B::LowerLip => face().thin(upper).line(lower),
                _ => face().line(upper).line(lower),
            }
        }
        B::Tongue => face().thin([[0.24, 0.64], [0.56, 0.64]]).solid(arc(
            [0.4, 0.66],
            [0.08, 0.16],
            0.0,
            0.5,
        )),
        B::Teeth | B::UpperTeeth | B::LowerTeeth => {
            let mouth = face().thin(oval([0.4, 0.68], [0.2, 0.13]));
            let row = |y: f32, drawing: Drawing| {
                [0.3, 0.4, 0.5].into_iter().fold(drawing, |drawing, x| {
                    drawing.line([[x, y - 0.05], [x, y + 0.05]])
                })
            };
            match place {
                B::UpperTeeth => row(0.64, mouth),
                B::LowerTeeth => row(0.74, mouth),
                _ => row(0.68, mouth).line([[0.22, 0.68], [0.58, 0.68]]),
            }
        }
        B::Chin => face().line(arc(FACE.0, FACE.1, 0.15, 0.35)),
        B::UnderChin => face().line([[0.22, 0.96], [0.58, 0.96]]),
        B::Neck => both(
            Drawing::new(0.8)
                .thin(arc([0.4, 0.1], [0.3, 0.42], 0.0, 0.5))
                .thin([[0.02, 0.98], [0.3, 0.86]])
                .thin([[0.78, 0.98], [0.5, 0.86]]),
            vec![[0.3, 0.46], [0.3, 0.86]],
        ),
        B::ShoulderTop => both(trunk(), vec![[0.3, 0.16], [0.08, 0.24]]),
        B::Shoulders => level(0.26),
        B::Chest => level(0.46),
        B::Stomach => level(0.66),
        B::BelowStomach => level(0.88),
        B::NeutralSpace => Drawing::new(0.8)
            .thin([[0.08, 0.06], [0.08, 0.94]])
            .line(oval([0.52, 0.5], [0.24, 0.3])),
        B::UpperArm => arm().line([SHOULDER, ELBOW]),
        B::LowerArm => arm().line([ELBOW, WRIST]),
        B::Elbow => arm().dot([0.24, 0.92]),
        B::ElbowInside => arm().dot([0.36, 0.68]),
    }
}
