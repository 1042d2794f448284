//! Draws contacts, manner, repetitions, brackets, marks between symbols, and punctuation.

use super::super::symbol::{BracketKind, MannerMark, SymbolKind};
use super::super::tree::{PlaceContact, RepeatKind};
use super::{DrawingPoint, SymbolDrawing, arc_points, oval};

/// Draws a mark next to or between movements.
pub(super) fn draw_movement_mark(kind: SymbolKind) -> SymbolDrawing {
    match kind {
        SymbolKind::Contact(contact) => draw_contact_mark(contact),
        SymbolKind::Manner(manner) => how(manner),
        SymbolKind::Repeat(repeat) => draw_repeat_mark(repeat),
        SymbolKind::Alternating => SymbolDrawing::new(0.7)
            .with_arrow([[0.2, 0.86], [0.2, 0.14]])
            .with_arrow([[0.5, 0.14], [0.5, 0.86]]),
        SymbolKind::Open(bracket) => fence(bracket, false),
        SymbolKind::Close(bracket) => fence(bracket, true),
        SymbolKind::Between => SymbolDrawing::new(0.5).with_line([[0.06, 0.08], [0.44, 0.92]]),
        SymbolKind::Plus => SymbolDrawing::new(0.6)
            .with_line([[0.3, 0.24], [0.3, 0.76]])
            .with_line([[0.04, 0.5], [0.56, 0.5]]),
        SymbolKind::Symmetry { left_right: true } => SymbolDrawing::new(0.6)
            .thin([[0.3, 0.2], [0.3, 0.8]])
            .with_dot([0.1, 0.5])
            .with_dot([0.5, 0.5]),
        SymbolKind::Symmetry { left_right: false } => {
            SymbolDrawing::new(0.4).with_dot([0.2, 0.32]).with_dot([0.2, 0.68])
        }
        SymbolKind::Nondominant => SymbolDrawing::new(0.9)
            .with_line(mitten(0.02, false))
            .thin(mitten(0.48, true)),
        SymbolKind::RealSpace => SymbolDrawing::new(0.8)
            .thin([[0.4, 0.06], [0.4, 0.94]])
            .with_arrow([[0.1, 0.5], [0.72, 0.5]]),
        SymbolKind::Approx => SymbolDrawing::new(0.7).with_line(
            (0..=20u8)
                .map(|step| {
                    let t = f32::from(step) / 20.0;
                    [0.06 + 0.58 * t, 0.5 - 0.12 * (t * std::f32::consts::TAU).sin()]
                })
                .collect::<Vec<_>>(),
        ),
        SymbolKind::Relative => SymbolDrawing::new(0.8)
            .with_line([[0.74, 0.86], [0.08, 0.86], [0.6, 0.2]])
            .thin(arc_points([0.08, 0.86], [0.36, 0.36], -0.145, 0.0)),
        SymbolKind::Version => SymbolDrawing::new(0.9)
            .with_line([[0.34, 0.9], [0.34, 0.1], [0.06, 0.64], [0.46, 0.64]])
            .with_dot([0.54, 0.86])
            .with_line(oval([0.74, 0.5], [0.13, 0.4])),
        SymbolKind::Space => SymbolDrawing::new(0.3),
        _ => SymbolDrawing::default(),
    }
}

/// A mitten in a box 0.4 wide, the thumb at the left or, mirrored, at the right.
fn mitten(at: f32, thumb_left: bool) -> Vec<DrawingPoint> {
    let outline = [
        [0.12, 0.96],
        [0.12, 0.76],
        [0.0, 0.52],
        [0.12, 0.58],
        [0.12, 0.22],
        [0.24, 0.08],
        [0.36, 0.22],
        [0.36, 0.96],
    ];
    let side = |x: f32| if thumb_left { x } else { 0.38 - x };
    outline.map(|[x, y]| [at + side(x), y]).to_vec()
}

fn draw_contact_mark(contact: PlaceContact) -> SymbolDrawing {
    let left = |x: f32| arc_points([x, 0.5], [0.22, 0.36], -0.2, 0.2);
    let right = |x: f32| arc_points([x, 0.5], [0.22, 0.36], 0.3, 0.7);
    match contact {
        PlaceContact::Touch => SymbolDrawing::new(0.7).with_line(left(0.13)).with_line(right(0.57)),
        PlaceContact::Close => SymbolDrawing::new(0.8).with_line(left(0.04)).with_line(right(0.76)),
        PlaceContact::Interlock => SymbolDrawing::new(0.9)
            .with_line(oval([0.34, 0.5], [0.24, 0.28]))
            .with_line(oval([0.56, 0.5], [0.24, 0.28])),
        PlaceContact::Cross => SymbolDrawing::new(0.8)
            .with_line([[0.1, 0.16], [0.7, 0.84]])
            .with_line([[0.7, 0.16], [0.1, 0.84]]),
        PlaceContact::ArmExtended => SymbolDrawing::new(1.0)
            .thin([[0.06, 0.08], [0.06, 0.92]])
            .with_line([[0.06, 0.3], [0.86, 0.3]])
            .with_dot([0.9, 0.3]),
        PlaceContact::Brushing => SymbolDrawing::new(0.9).thin([[0.06, 0.76], [0.84, 0.76]]).with_arrow([
            [0.08, 0.24],
            [0.3, 0.6],
            [0.54, 0.62],
            [0.82, 0.26],
        ]),
    }
}

fn how(manner: MannerMark) -> SymbolDrawing {
    match manner {
        MannerMark::Fast => SymbolDrawing::new(0.7)
            .with_line([[0.06, 0.24], [0.32, 0.5], [0.06, 0.76]])
            .with_line([[0.36, 0.24], [0.62, 0.5], [0.36, 0.76]]),
        MannerMark::Slow => SymbolDrawing::new(0.8)
            .with_dot([0.12, 0.5])
            .with_dot([0.4, 0.5])
            .with_dot([0.68, 0.5]),
        MannerMark::Tense => SymbolDrawing::new(0.5).with_line([[0.36, 0.04], [0.1, 0.52], [0.4, 0.48], [0.14, 0.96]]),
        MannerMark::Rest => SymbolDrawing::new(0.5)
            .with_line([[0.14, 0.2], [0.14, 0.8]])
            .with_line([[0.36, 0.2], [0.36, 0.8]]),
        MannerMark::Halt => SymbolDrawing::new(0.8)
            .with_arrow([[0.06, 0.5], [0.58, 0.5]])
            .with_line([[0.7, 0.16], [0.7, 0.84]]),
    }
}

fn draw_repeat_mark(repeat: RepeatKind) -> SymbolDrawing {
    // The colon and bar that repeat music, and arrows end to end for continuation.
    let from_start = |bars: &[f32], width: f32| {
        let colon = SymbolDrawing::new(width).with_dot([0.1, 0.36]).with_dot([0.1, 0.64]);
        bars.iter()
            .fold(colon, |drawing, x| drawing.with_line([[*x, 0.14], [*x, 0.86]]))
    };
    let onwards = |count: u8| {
        (0..count).fold(SymbolDrawing::new(0.3 * f32::from(count) + 0.1), |drawing, number| {
            let x = 0.04 + 0.3 * f32::from(number);
            drawing.with_arrow([[x, 0.5], [x + 0.26, 0.5]])
        })
    };
    match repeat {
        RepeatKind::FromStart => from_start(&[0.3], 0.4),
        RepeatKind::FromStartSeveral | RepeatKind::ManyRandom => from_start(&[0.3, 0.46, 0.62], 0.7),
        RepeatKind::Continue => onwards(2),
        RepeatKind::ContinueSeveral => onwards(3),
        RepeatKind::Reverse | RepeatKind::ToFro | RepeatKind::Swap => {
            let back = [[0.84, 0.5], [0.06, 0.5]];
            SymbolDrawing::new(0.9)
                .with_arrow([[0.06, 0.5], [0.84, 0.5]])
                .with_arrow_head(&back, super::ARROW_HEAD_LENGTH_EMS)
        }
    }
}

fn fence(bracket: BracketKind, close: bool) -> SymbolDrawing {
    let points: Vec<DrawingPoint> = match bracket {
        BracketKind::Seq => arc_points([0.42, 0.5], [0.34, 0.62], 0.35, 0.65),
        BracketKind::Par => vec![[0.34, 0.04], [0.1, 0.04], [0.1, 0.96], [0.34, 0.96]],
        BracketKind::Fusion => vec![[0.36, 0.04], [0.08, 0.5], [0.36, 0.96]],
    };
    let side = |x: f32| if close { 0.44 - x } else { x };
    SymbolDrawing::new(0.44).with_line(
        points
            .into_iter()
            .map(|[x, y]| [side(x), y.clamp(0.0, 1.0)])
            .collect::<Vec<_>>(),
    )
}

/// Draws a mark of text.
pub(super) fn draw_punctuation_mark(mark: char) -> SymbolDrawing {
    let hook = [
        [0.2, 0.3],
        [0.24, 0.12],
        [0.4, 0.06],
        [0.54, 0.18],
        [0.5, 0.34],
        [0.36, 0.5],
        [0.36, 0.66],
    ];
    let brace = |close: bool| {
        let side = |x: f32| if close { 0.44 - x } else { x };
        let points = [
            [0.38, 0.04],
            [0.22, 0.1],
            [0.22, 0.4],
            [0.06, 0.5],
            [0.22, 0.6],
            [0.22, 0.9],
            [0.38, 0.96],
        ];
        SymbolDrawing::new(0.44).with_line(points.map(|[x, y]| [side(x), y]))
    };
    match mark {
        '!' => SymbolDrawing::new(0.3)
            .with_line([[0.15, 0.06], [0.15, 0.66]])
            .with_dot([0.15, 0.88]),
        '?' => SymbolDrawing::new(0.7).with_line(hook).with_dot([0.36, 0.88]),
        ',' => SymbolDrawing::new(0.3).with_line([[0.18, 0.8], [0.08, 0.98]]),
        '{' => brace(false),
        '}' => brace(true),
        '|' => SymbolDrawing::new(0.3).with_line([[0.15, 0.04], [0.15, 0.96]]),
        _ => SymbolDrawing::new(0.3).with_dot([0.15, 0.88]),
    }
}
